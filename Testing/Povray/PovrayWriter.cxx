// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PovrayWriter.h"

#include <locale>

namespace meniscus::test
{

namespace
{

// Emission alone: neither light nor POV-Ray's ambient colour changes a flat colour.
const char* const FlatFinish = "finish { ambient 0 diffuse 0 emission 1 }";

std::string Join(const std::vector<std::string>& items)
{
  std::string result = std::to_string(items.size());
  for (const std::string& item : items)
  {
    result += ",\n    " + item;
  }
  return result;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::string PovrayNumber(double value)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  out << value;
  return out.str();
}

//------------------------------------------------------------------------------
std::string PovrayVector(const glm::dvec3& value)
{
  return '<' + PovrayNumber(value.x) + ", " + PovrayNumber(value.y) + ", " + PovrayNumber(value.z) +
    '>';
}

//------------------------------------------------------------------------------
std::string PovrayCamera(const SceneCamera& camera, const PictureWindow& window)
{
  const glm::dvec3 forward = glm::normalize(camera.Target - camera.Eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.Up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double width = 2.0 * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera.ViewAngle));
  return "camera {\n  perspective\n  location " + PovrayVector(camera.Eye) + "\n  direction " +
    PovrayVector(forward + width * (window.Right * right + window.Up * up)) + "\n  right " +
    PovrayVector(width * window.Size * right) + "\n  up " + PovrayVector(width * window.Size * up) +
    "\n}\n";
}

//------------------------------------------------------------------------------
std::string PovrayMesh(vtkPolyData* object)
{
  std::vector<std::string> points;
  for (vtkIdType i = 0; i < object->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 p;
    object->GetPoint(i, &p.x);
    points.push_back(PovrayVector(p));
  }
  vtkDataArray* colors = object->GetCellData()->GetArray(ColorArrayName);
  std::map<std::array<double, 3>, std::size_t> numbers;
  std::vector<std::string> textures;
  std::vector<std::string> faces;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < object->GetNumberOfCells(); ++i)
  {
    std::array<double, 3> color;
    colors->GetTuple(i, color.data());
    const auto found = numbers.emplace(color, textures.size());
    if (found.second)
    {
      const glm::dvec3 rgb = glm::dvec3(color[0], color[1], color[2]) / 255.0;
      textures.push_back(
        "texture { pigment { rgb " + PovrayVector(rgb) + " } " + FlatFinish + " }");
    }
    object->GetCellPoints(i, ids);
    std::ostringstream face;
    face << '<' << ids->GetId(0) << ", " << ids->GetId(1) << ", " << ids->GetId(2) << ">, "
         << found.first->second;
    faces.push_back(face.str());
  }
  // The lists of textures have no commas between their items.
  std::string list = std::to_string(textures.size());
  for (const std::string& texture : textures)
  {
    list += "\n    " + texture;
  }
  return "mesh2 {\n  vertex_vectors { " + Join(points) + " }\n  texture_list { " + list +
    " }\n  face_indices { " + Join(faces) + " }\n}\n";
}

//------------------------------------------------------------------------------
std::string PovraySurface(const RefractingSurface& surface)
{
  if (!surface.Membrane)
  {
    return "";
  }
  return surface.Primitive +
    "\n  pigment { rgbt <1, 1, 1, 1> }\n  finish { ambient 0 diffuse 0 emission 0 }\n  interior { "
    "ior " +
    PovrayNumber(surface.Interior / surface.Exterior) + " }\n}\n";
}

//------------------------------------------------------------------------------
std::string PovrayScene(const ComparisonScene& scene, const PictureWindow& window)
{
  std::string text = "// " + scene.Description + "\n#version 3.7;\n" +
    "global_settings { assumed_gamma 1 max_trace_level 20 }\n" +
    PovrayCamera(scene.Camera, window) + "background { rgb " + PovrayVector(scene.Background) +
    " }\n" + PovraySurface(scene.Surface);
  for (vtkPolyData* object : scene.Objects)
  {
    text += PovrayMesh(object);
  }
  return text;
}

//------------------------------------------------------------------------------
std::string PovrayOptions(const std::string& name, int pixels)
{
  const std::string size = std::to_string(pixels);
  return "Input_File_Name=" + name + ".pov\nOutput_File_Name=" + name +
    "-povray.png\nWidth=" + size + "\nHeight=" + size +
    "\nAntialias=off\nDither=off\nDisplay=off\nVerbose=off\nOutput_File_Type=N\nOutput_Alpha=off\n"
    "Bits_Per_Color=8\nFile_Gamma=1.0\n";
}

} // namespace meniscus::test

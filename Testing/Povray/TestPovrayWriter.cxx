// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// POV-Ray's scenes as text; POV-Ray itself is not needed.
#include "PovrayWriter.h"
#include "VTKTestBasics.h"

#include <cctype>

using namespace meniscus::test;

namespace
{

/** The numbers of a text in their order; digits of a name are none. */
std::vector<double> NumbersIn(const std::string& text)
{
  std::vector<double> numbers;
  for (std::size_t i = 0; i < text.size();)
  {
    const bool isInName =
      i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) || text[i - 1] == '_');
    const bool isSigned = text[i] == '-' && i + 1 < text.size() &&
      std::isdigit(static_cast<unsigned char>(text[i + 1]));
    if (isInName || !(isSigned || std::isdigit(static_cast<unsigned char>(text[i]))))
    {
      ++i;
      continue;
    }
    char* end = nullptr;
    numbers.push_back(std::strtod(text.c_str() + i, &end));
    i = static_cast<std::size_t>(end - text.c_str());
  }
  return numbers;
}

/** The text between the first `open` after `name` and the next `close`. */
std::string BlockOf(const std::string& text, const std::string& name, const std::string& close)
{
  const std::size_t begin = text.find(name);
  EXPECT_NE(begin, std::string::npos) << name;
  const std::size_t start = begin + name.size();
  return text.substr(start, text.find(close, start) - start);
}

glm::dvec3 VectorAfter(const std::string& text, const std::string& name)
{
  const std::vector<double> numbers = NumbersIn(BlockOf(text, name, ">"));
  EXPECT_EQ(numbers.size(), 3u) << name;
  return { numbers.at(0), numbers.at(1), numbers.at(2) };
}

ComparisonScene SceneOf(const std::string& name)
{
  for (const ComparisonScene& scene : MakeComparisonScenes())
  {
    if (scene.Name == name)
    {
      return scene;
    }
  }
  ADD_FAILURE() << name;
  return {};
}

/**
 * Every point of the membrane is a zero of the function, its normal is the gradient times `side`,
 * and triangles are wound to the side of their normals. The tolerances are roundings of a few
 * operations on coordinates of up to 100: 1e-16 of their squares.
 */
void ExpectMembrane(const RefractingSurface& surface, double side,
  const std::function<double(const glm::dvec3&)>& function,
  const std::function<glm::dvec3(const glm::dvec3&)>& gradient)
{
  vtkPolyData* const data = surface.Membrane;
  vtkDataArray* const normals = data->GetPointData()->GetNormals();
  ASSERT_GT(data->GetNumberOfPoints(), 50);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 p;
    glm::dvec3 n;
    data->GetPoint(i, &p.x);
    normals->GetTuple(i, &n.x);
    ASSERT_NEAR(function(p), 0.0, 1e-11) << i;
    ASSERT_LT(glm::length(n - side * glm::normalize(gradient(p))), 1e-12) << i;
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    glm::dvec3 p[3];
    glm::dvec3 n[3];
    data->GetCellPoints(cell, ids);
    for (vtkIdType i = 0; i < 3; ++i)
    {
      data->GetPoint(ids->GetId(i), &p[i].x);
      normals->GetTuple(ids->GetId(i), &n[i].x);
    }
    ASSERT_GT(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), n[0] + n[1] + n[2]), 0.0) << cell;
  }
}

} // anonymous namespace

TEST(PovrayWriter, NumbersKeepAllDigits)
{
  for (const double value : { 0.0, 1.0 / 3.0, -2.0 / 7.0, 1e-300, 6.02e23, 0.1, -1e-17 })
  {
    EXPECT_EQ(std::strtod(PovrayNumber(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(NumbersIn(PovrayVector({ 1.0, -2.5, 1e-3 })), (std::vector<double>{ 1.0, -2.5, 1e-3 }));
}

/** The ray through a place of the picture meets the same place of VTK's picture. */
TEST(PovrayWriter, CameraIsVtks)
{
  const SceneCamera camera{ { 3.0, -4.0, 7.0 }, { -1.0, 2.0, 0.5 }, { 0.1, 0.2, 1.0 }, 37.0 };
  vtkNew<vtkCamera> vtk;
  vtk->SetPosition(&camera.Eye.x);
  vtk->SetFocalPoint(&camera.Target.x);
  vtk->SetViewUp(&camera.Up.x);
  vtk->SetViewAngle(camera.ViewAngle);
  vtkMatrix4x4* const matrix = vtk->GetCompositeProjectionTransformMatrix(1.0, -1.0, 1.0);
  for (const PictureWindow& window : { PictureWindow(), PictureWindow{ 0.3, -0.2, 0.01 } })
  {
    const std::string text = PovrayCamera(camera, window);
    EXPECT_EQ(VectorAfter(text, "location"), camera.Eye);
    for (const glm::dvec3& place :
      { glm::dvec3(0.0), glm::dvec3(0.5, 0.5, 0.0), glm::dvec3(-0.5, 0.25, 0.0) })
    {
      const glm::dvec3 point = camera.Eye + VectorAfter(text, "direction") +
        place.x * VectorAfter(text, "right") + place.y * VectorAfter(text, "up");
      const double in[4] = { point.x, point.y, point.z, 1.0 };
      double out[4];
      matrix->MultiplyPoint(in, out);
      // VTK's picture goes from -1 to 1; a few roundings.
      EXPECT_NEAR(out[0] / out[3], 2.0 * (window.Right + window.Size * place.x), 1e-13);
      EXPECT_NEAR(out[1] / out[3], 2.0 * (window.Up + window.Size * place.y), 1e-13);
    }
  }
}

TEST(PovrayWriter, MeshHasEveryTriangleInItsColor)
{
  for (vtkPolyData* object : SceneOf("plane").Objects)
  {
    const std::string text = PovrayMesh(object);
    const std::vector<double> points = NumbersIn(BlockOf(text, "vertex_vectors {", "}"));
    const std::vector<double> faces = NumbersIn(BlockOf(text, "face_indices {", "}"));
    std::vector<glm::dvec3> colors;
    for (std::size_t at = text.find("rgb <"); at != std::string::npos;
         at = text.find("rgb <", at + 1))
    {
      colors.push_back(VectorAfter(text.substr(at), "rgb <"));
    }
    EXPECT_EQ(NumbersIn(BlockOf(text, "texture_list {", "texture")).at(0), colors.size());
    ASSERT_EQ(points.size(), 1u + 3u * static_cast<std::size_t>(object->GetNumberOfPoints()));
    ASSERT_EQ(faces.size(), 1u + 4u * static_cast<std::size_t>(object->GetNumberOfCells()));
    EXPECT_EQ(points[0], object->GetNumberOfPoints());
    EXPECT_EQ(faces[0], object->GetNumberOfCells());
    vtkDataArray* const wanted = object->GetCellData()->GetArray(ColorArrayName);
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < object->GetNumberOfCells(); ++cell)
    {
      const double* const face = faces.data() + 1 + 4 * cell;
      object->GetCellPoints(cell, ids);
      for (vtkIdType corner = 0; corner < 3; ++corner)
      {
        double p[3];
        object->GetPoint(ids->GetId(corner), p);
        const double* const written =
          points.data() + 1 + 3 * static_cast<std::size_t>(face[corner]);
        ASSERT_TRUE(std::equal(p, p + 3, written)) << cell;
      }
      const glm::dvec3 color = 255.0 * colors.at(static_cast<std::size_t>(face[3]));
      for (int c = 0; c < 3; ++c)
      {
        ASSERT_NEAR(color[c], wanted->GetComponent(cell, c), 1e-12) << cell; // a division by 255
      }
    }
  }
}

TEST(PovrayWriter, MembranesLieOnThePrimitives)
{
  const RefractingSurface plane = SceneOf("plane").Surface;
  EXPECT_EQ(NumbersIn(plane.Primitive), (std::vector<double>{ 0.0, 1.0, 0.0, 0.0 }));
  ExpectMembrane(
    plane, 1.0, [](const glm::dvec3& p) { return p.y; },
    [](const glm::dvec3&) { return glm::dvec3(0.0, 1.0, 0.0); });

  // POV-Ray's plane has its inside where the normal does not point to: the air above the water.
  const RefractingSurface window = SceneOf("window").Surface;
  EXPECT_EQ(NumbersIn(window.Primitive), (std::vector<double>{ 0.0, -1.0, 0.0, 0.0 }));
  ExpectMembrane(
    window, 1.0, [](const glm::dvec3& p) { return -p.y; },
    [](const glm::dvec3&) { return glm::dvec3(0.0, -1.0, 0.0); });

  const RefractingSurface sphere = SceneOf("sphere").Surface;
  const double radius = NumbersIn(sphere.Primitive).at(3);
  ExpectMembrane(
    sphere, 1.0, [=](const glm::dvec3& p) { return glm::length(p) - radius; },
    [](const glm::dvec3& p) { return p; });

  const RefractingSurface waves = SceneOf("waves").Surface;
  const std::vector<double> f = NumbersIn(BlockOf(waves.Primitive, "function {", "}"));
  ASSERT_EQ(f.size(), 3u);
  ExpectMembrane(
    waves, 1.0,
    [&f](const glm::dvec3& p) { return p.y - f[0] * std::sin(f[1] * p.x) * std::sin(f[2] * p.z); },
    [&f](const glm::dvec3& p)
    {
      return glm::dvec3(-f[0] * f[1] * std::cos(f[1] * p.x) * std::sin(f[2] * p.z), 1.0,
        -f[0] * f[2] * std::sin(f[1] * p.x) * std::cos(f[2] * p.z));
    });

  // The eye is where the quadric is negative, its inside; `inverse` puts the medium outside.
  const RefractingSurface bowl = SceneOf("bowl").Surface;
  const std::vector<double> q = NumbersIn(bowl.Primitive);
  ASSERT_EQ(q.size(), 10u);
  EXPECT_TRUE(HasText(bowl.Primitive, "inverse"));
  ExpectMembrane(
    bowl, -1.0,
    [&q](const glm::dvec3& p)
    { return (q[0] * p.x * p.x + q[2] * p.z * p.z + q[7] * p.y) / std::fabs(q[7]); },
    [&q](const glm::dvec3& p) { return glm::dvec3(2.0 * q[0] * p.x, q[7], 2.0 * q[2] * p.z); });
}

/** The bound on the gradient that POV-Ray's search for roots relies on. */
TEST(PovrayWriter, WavesAreNoSteeperThanStated)
{
  const std::string primitive = SceneOf("waves").Surface.Primitive;
  const std::vector<double> f = NumbersIn(BlockOf(primitive, "function {", "}"));
  const double bound = NumbersIn(BlockOf(primitive, "max_gradient", "}")).at(0);
  double steepest = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    for (int j = 0; j < 100; ++j)
    {
      const double x = 0.0314159 * i;
      const double z = 0.0314159 * j;
      steepest = std::max(steepest,
        std::hypot(
          f[0] * f[1] * std::cos(x) * std::sin(z), 1.0, f[0] * f[2] * std::sin(x) * std::cos(z)));
    }
  }
  EXPECT_LE(steepest, bound);
}

TEST(PovrayWriter, SceneHasAllParts)
{
  const ComparisonScene scene = SceneOf("window");
  const std::string text = PovrayScene(scene);
  EXPECT_EQ(NumbersIn(BlockOf(text, "ior", "}")).at(0), 1.0 / 1.333);
  EXPECT_TRUE(HasText(text, "assumed_gamma 1 "));
  EXPECT_EQ(VectorAfter(text, "background { rgb"), scene.Background);
  std::size_t meshes = 0;
  for (std::size_t at = text.find("mesh2"); at != std::string::npos;
       at = text.find("mesh2", at + 1))
  {
    ++meshes;
  }
  EXPECT_EQ(meshes, scene.Objects.size());
  EXPECT_EQ(PovraySurface(SceneOf("straight").Surface), "");
  const std::string options = PovrayOptions("window", 77);
  EXPECT_TRUE(HasText(options, "Width=77\nHeight=77\nAntialias=off"));
  EXPECT_TRUE(HasText(options, "File_Gamma=1.0"));
}

/** A colour says which object a pixel shows. */
TEST(PovrayWriter, ColorsAreOfOneObject)
{
  for (const ComparisonScene& scene : MakeComparisonScenes())
  {
    ObjectColors all;
    std::size_t sum = 0;
    for (vtkPolyData* object : scene.Objects)
    {
      double color[3];
      object->GetCellData()->GetArray(ColorArrayName)->GetTuple(0, color);
      const unsigned char bytes[3] = { static_cast<unsigned char>(color[0]),
        static_cast<unsigned char>(color[1]), static_cast<unsigned char>(color[2]) };
      const ObjectColors colors = FindObjectColors(scene, bytes);
      EXPECT_EQ(colors.size(), 2u) << scene.Name;
      sum += colors.size();
      all.insert(colors.begin(), colors.end());
    }
    EXPECT_EQ(all.size(), sum) << scene.Name;
    const unsigned char background[3] = { 51, 102, 153 };
    EXPECT_TRUE(FindObjectColors(scene, background).empty()) << scene.Name;
  }
}

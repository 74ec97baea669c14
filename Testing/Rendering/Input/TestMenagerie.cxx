// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Files in the manner of many programs, Testing/Data/Menagerie, through VTK's readers: volume and
// bounds of what is drawn.
#include "RayCastScene.h"

#include <vtkGenericDataObjectReader.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <cctype>

using namespace meniscus::test;

namespace
{

constexpr int Width = 80;
constexpr int Height = 40;
constexpr double Attenuation = 0.5;

/** A row of expected.csv. */
struct MenagerieFile
{
  std::string Name;
  double Volume = 0.0;
  std::array<double, 6> Bounds{};
  bool OfPoints = true;
  std::string Array;
  /** True if the file has cells that must be left out. */
  bool IsDamaged = false;
};

void PrintTo(const MenagerieFile& file, std::ostream* stream)
{
  *stream << file.Name;
}

std::vector<std::string> SplitRow(const std::string& row, char separator)
{
  std::vector<std::string> fields;
  std::istringstream stream(row);
  for (std::string field; std::getline(stream, field, separator);)
  {
    fields.push_back(field);
  }
  return fields;
}

/** Rows of the files for this test: "needs" is empty, "mapper" is "yes" or "damaged". */
std::vector<MenagerieFile> ReadTable()
{
  std::vector<MenagerieFile> files;
  std::ifstream table(std::string(MENISCUS_MENAGERIE_DIR) + "/expected.csv");
  for (std::string row; std::getline(table, row);)
  {
    const std::vector<std::string> fields = SplitRow(row, '|');
    if (fields.size() != 8 || !fields[6].empty() || (fields[7] != "yes" && fields[7] != "damaged"))
    {
      continue;
    }
    MenagerieFile file;
    file.Name = fields[0];
    file.Volume = std::stod(fields[1]);
    std::istringstream bounds(fields[2]);
    for (double& bound : file.Bounds)
    {
      bounds >> bound;
    }
    const std::string first = fields[3].substr(0, fields[3].find(','));
    file.OfPoints = first.rfind("cell ", 0) != 0;
    file.Array = first.empty() ? "T" : first.substr(first.find(' ') + 1);
    file.IsDamaged = fields[7] == "damaged";
    files.push_back(file);
  }
  return files;
}

template <class Reader>
vtkSmartPointer<vtkDataObject> ReadWith(const std::string& name)
{
  vtkNew<Reader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

vtkSmartPointer<vtkDataObject> Read(const std::string& file)
{
  const std::string name = std::string(MENISCUS_MENAGERIE_DIR) + "/" + file;
  return name.substr(name.rfind('.')) == ".vtk" ? ReadWith<vtkGenericDataObjectReader>(name)
                                                : ReadWith<vtkXMLGenericDataObjectReader>(name);
}

/** Looks along -z at a box that fills the height or the width of the window. Returns the area of a
 * pixel. */
double LookDown(vtkRenderer* renderer, const double bounds[6])
{
  const double height =
    std::max(bounds[3] - bounds[2], (bounds[1] - bounds[0]) * Height / static_cast<double>(Width));
  const double center[2] = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]) };
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * height);
  camera->SetFocalPoint(center[0], center[1], bounds[4]);
  camera->SetPosition(center[0], center[1], bounds[5] + 1.0);
  camera->SetViewUp(0, 1, 0);
  renderer->ResetCameraClippingRange();
  return height * height / (Height * Height);
}

/** Volume that a picture of a constant attenuation shows, from the depth of each pixel. */
double MeasureVolume(const FloatImage& image, double pixelArea)
{
  double depth = 0.0;
  for (const auto& [y, x] : Product(Height, Width))
  {
    depth -= std::log1p(-static_cast<double>(image.GetPixel(x, y)[3])) / Attenuation;
  }
  return depth * pixelArea;
}

std::string NameOf(const ::testing::TestParamInfo<MenagerieFile>& info)
{
  std::string name = info.param.Name;
  for (char& letter : name)
  {
    letter = std::isalnum(static_cast<unsigned char>(letter)) != 0 ? letter : '_';
  }
  return name;
}

}

class Menagerie : public ::testing::TestWithParam<MenagerieFile>
{
};

TEST_P(Menagerie, IsDrawn)
{
  const MenagerieFile& file = this->GetParam();
  const vtkSmartPointer<vtkDataObject> data = Read(file.Name);
  ASSERT_TRUE(data);
  RayCastScene scene(nullptr, MakeConstantProperty(Attenuation, 1.0, 1.0, 1.0, 1.0), Width, Height);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  const auto observer = ObserveErrors(mapper);
  mapper->SetInputDataObject(data);
  mapper->SetScalarMode(
    file.OfPoints ? VTK_SCALAR_MODE_USE_POINT_FIELD_DATA : VTK_SCALAR_MODE_USE_CELL_FIELD_DATA);
  mapper->SelectScalarArray(file.Array.c_str());
  if (file.IsDamaged)
  {
    scene.RenderFloat();
    EXPECT_GT(mapper->GetNumberOfRejectedCells(), 0);
    return;
  }
  const double* bounds = mapper->GetBounds();
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], file.Bounds[i], 1e-9) << i;
  }
  const double area = LookDown(scene.GetRenderer(), file.Bounds.data());
  // Pixels are floats, and so are transmittances of exp(-0.5): each depth is known to about 1e-6.
  EXPECT_NEAR(MeasureVolume(scene.RenderFloat(), area), file.Volume, 1e-5);
  EXPECT_EQ(mapper->GetNumberOfLostRays(), 0);
  EXPECT_TRUE(observer->Errors.empty()) << observer->GetText();
}

INSTANTIATE_TEST_SUITE_P(Files, Menagerie, ::testing::ValuesIn(ReadTable()), NameOf);

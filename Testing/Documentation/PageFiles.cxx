// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes the files that the pages of the documentation read, and checks the images that they
// produce: `write` writes object.vtp and water.vtp; `check` takes the names of images, each of
// which must show something different; `compare FOLDER` does the same and compares each image with
// that of its name in the folder.
#include "StrictImage.h"

#include <vtkParametricFunctionSource.h>
#include <vtkParametricTorus.h>
#include <vtkXMLPolyDataWriter.h>

namespace
{

// Smallest number of colours of an image, of at most 24 bits.
constexpr std::size_t FewestColors = 50;
// Largest difference of a pixel from the image that a page shows: processors round differently.
constexpr int LargestDifference = 4;

bool Write(vtkAlgorithm* source, const char* file)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(source->GetOutputPort());
  writer->SetFileName(file);
  return writer->Write() == 1;
}

// Adds waves to a plane, with their normals.
void MakeWaves(vtkPolyData* plane)
{
  for (vtkIdType p = 0; p < plane->GetNumberOfPoints(); ++p)
  {
    double x[3];
    plane->GetPoint(p, x);
    const double first = 4.0 * x[0] + x[1];
    const double second = 2.0 * x[0] - 5.0 * x[1];
    x[2] += 0.04 * std::sin(first) + 0.03 * std::sin(second);
    plane->GetPoints()->SetPoint(p, x);
    double normal[3] = { -0.16 * std::cos(first) - 0.06 * std::cos(second),
      -0.04 * std::cos(first) + 0.15 * std::cos(second), 1.0 };
    vtkMath::Normalize(normal);
    plane->GetPointData()->GetNormals()->SetTuple(p, normal);
  }
}

// Two of the files of Examples/Python/guide_files.py.
bool WriteFiles()
{
  vtkNew<vtkParametricTorus> shape;
  vtkNew<vtkParametricFunctionSource> torus;
  torus->SetParametricFunction(shape);
  vtkNew<vtkPlaneSource> water;
  water->SetOrigin(-2.0, -2.0, 0.2);
  water->SetPoint1(2.0, -2.0, 0.2);
  water->SetPoint2(-2.0, 2.0, 0.2);
  water->SetResolution(80, 80);
  water->Update();
  MakeWaves(water->GetOutput());
  return Write(torus, "object.vtp") && Write(water, "water.vtp");
}

bool ShowsSomething(const meniscus::test::ByteImage& image, const char* file)
{
  std::set<int> colors;
  for (std::size_t i = 0; i + 2 < image.Rgb.size(); i += 3)
  {
    colors.insert((image.Rgb[i] * 256 + image.Rgb[i + 1]) * 256 + image.Rgb[i + 2]);
  }
  std::printf("%s: %zu colours\n", file, colors.size());
  return colors.size() >= FewestColors;
}

bool EqualsShown(
  const meniscus::test::ByteImage& image, const char* file, const std::string& folder)
{
  const std::string shown = folder + "/" + file;
  const auto difference =
    meniscus::test::CompareStrictly(image, meniscus::test::ReadPng(shown), LargestDifference);
  const bool isEqual = difference.SameSize && difference.PixelsBeyond == 0;
  if (!isEqual)
  {
    std::printf("%s differs from %s in %zu pixels, by up to %d of 255%s; compare them, and copy it "
                "if it is right\n",
      file, shown.c_str(), difference.PixelsBeyond, difference.Largest,
      difference.SameSize ? "" : " (no such file, or another size)");
  }
  return isEqual;
}

}

int main(int argc, char* argv[])
{
  if (argc == 2 && std::strcmp(argv[1], "write") == 0)
  {
    return WriteFiles() ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  const bool isCompared = argc > 2 && std::strcmp(argv[1], "compare") == 0;
  const int first = isCompared ? 3 : 2;
  bool good = argc > first && (isCompared || std::strcmp(argv[1], "check") == 0);
  meniscus::test::ByteImage last;
  for (int i = first; i < argc && good; ++i)
  {
    const auto image = meniscus::test::ReadPng(argv[i]);
    good = ShowsSomething(image, argv[i]) && image.Rgb != last.Rgb &&
      (!isCompared || EqualsShown(image, argv[i], argv[2]));
    last = image;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

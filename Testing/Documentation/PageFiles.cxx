// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes the files that the pages of the documentation read, and checks the images that they
// produce: `write` writes object.vtp and water.vtp; `check` takes the names of images, each of
// which must show something different.
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkElevationFilter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <vector>

namespace
{

// Smallest number of colours of an image, of at most 24 bits.
constexpr std::size_t FewestColors = 50;

bool Write(vtkAlgorithm* source, const char* file)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(source->GetOutputPort());
  writer->SetFileName(file);
  return writer->Write() == 1;
}

bool WriteFiles()
{
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, 0.0, -1.0);
  ball->SetRadius(0.6);
  ball->SetThetaResolution(40);
  ball->SetPhiResolution(30);
  vtkNew<vtkElevationFilter> colors;
  colors->SetInputConnection(ball->GetOutputPort());
  colors->SetLowPoint(-0.6, 0.0, 0.0);
  colors->SetHighPoint(0.6, 0.0, 0.0);
  vtkNew<vtkPlaneSource> water;
  water->SetOrigin(-1.0, -1.0, 0.0);
  water->SetPoint1(1.0, -1.0, 0.0);
  water->SetPoint2(-1.0, 1.0, 0.0);
  water->SetResolution(16, 16);
  return Write(colors, "object.vtp") && Write(water, "water.vtp");
}

bool CheckResult(const char* file, std::vector<unsigned char>& pixels)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file);
  reader->Update();
  vtkDataArray* scalars = reader->GetOutput()->GetPointData()->GetScalars();
  std::set<int> colors;
  for (vtkIdType i = 0; scalars && i < scalars->GetNumberOfTuples(); ++i)
  {
    int color = 0;
    for (int c = 0; c < 3; ++c)
    {
      const auto value = static_cast<unsigned char>(scalars->GetComponent(i, c));
      pixels.push_back(value);
      color = 256 * color + value;
    }
    colors.insert(color);
  }
  std::printf("%s: %zu colours\n", file, colors.size());
  return colors.size() >= FewestColors;
}

}

int main(int argc, char* argv[])
{
  if (argc == 2 && std::strcmp(argv[1], "write") == 0)
  {
    return WriteFiles() ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  bool good = argc > 2 && std::strcmp(argv[1], "check") == 0;
  std::vector<unsigned char> last;
  for (int i = 2; i < argc && good; ++i)
  {
    std::vector<unsigned char> pixels;
    good = CheckResult(argv[i], pixels) && pixels != last;
    last = std::move(pixels);
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

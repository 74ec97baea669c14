// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A volume through a plane and through a dome, next to the image of rays refracted in double
// precision and the difference of both: the figure in the documentation.
#include "MembraneScene.h"
#include "RayCastScene.h"
#include "ReferenceImage.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 256;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr double Block[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
// Difference that is shown in black; equal pixels are white.
constexpr double LargestShown = 2e-6;
// Background of the images only, behind the volumes.
constexpr double Background = 0.95;
// Goal for the float error.
constexpr double Tolerance = 1e-4;

/** Three images side by side, one row per membrane. */
class Sheet
{
public:
  Sheet()
  {
    this->Image->SetDimensions(3 * Size, 2 * Size, 1);
    this->Image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  }

  void Set(int row, int column, int x, int y, int channel, double value)
  {
    auto* pixel = static_cast<unsigned char*>(
      this->Image->GetScalarPointer(column * Size + x, (1 - row) * Size + y, 0));
    pixel[channel] =
      static_cast<unsigned char>(std::lround(255.0 * std::min(std::max(value, 0.0), 1.0)));
  }

  void Write(const std::string& name)
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName((std::string(MENISCUS_TEMPORARY_DIR) + "/" + name).c_str());
    writer->SetInputData(this->Image);
    writer->Write();
  }

private:
  vtkNew<vtkImageData> Image;
};

/** Returns the largest difference; every pixel counts. */
double DrawRow(Sheet& sheet, int row, const MembraneCase& membrane)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  scene.GetRayCaster()->SetMembraneData(membrane.Mesh);
  LookAt(scene.GetRenderer(), Block, 30.0, 50.0);
  scene.GetWindow()->Render();
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  const auto integrator = MakeReference(grid);
  const auto function = ToReference(scene.GetVolume()->GetProperty());
  double largest = 0.0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const auto truth = Compose(Refract(membrane.Surface, rays.GetRay(x, y), 0.0, false),
        [&](const Ray& part) { return integrator->Trace(part, function); });
      for (int c = 0; c < 3; ++c)
      {
        const double ours = image.GetPixel(x, y)[c];
        const double difference = std::fabs(ours - truth[static_cast<std::size_t>(c)]);
        largest = std::max(largest, difference);
        const double behind[2] = { Background * (1.0 - image.GetPixel(x, y)[3]),
          Background * (1.0 - truth[3]) };
        sheet.Set(row, 0, x, y, c, ours + behind[0]);
        sheet.Set(row, 1, x, y, c, truth[static_cast<std::size_t>(c)] + behind[1]);
        sheet.Set(row, 2, x, y, c, 1.0 - difference / LargestShown);
      }
    }
  }
  return largest;
}

} // anonymous namespace

TEST(MembraneComparison, PlaneAndDomeBesideRefractedRays)
{
  Sheet sheet;
  const double plane = DrawRow(sheet, 0, MakePlaneCase(1.3, 3.0, 3));
  const double dome = DrawRow(sheet, 1, MakeDomeCase(1.6, 3.0, 2.0, 40));
  sheet.Write("membrane-comparison.png");
  EXPECT_LE(plane, Tolerance);
  EXPECT_LE(dome, Tolerance);
  RecordProperty("plane", std::to_string(plane));
  RecordProperty("dome", std::to_string(dome));
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Volumes through one membrane and through several, next to the images of rays refracted in double
// precision and the differences: figures in the documentation.
#include "ComparisonSheet.h"
#include "RayCastScene.h"
#include "StackScene.h"

using namespace meniscus::test;
using namespace meniscus::reference;
using meniscus::test::ComparisonSheet;

namespace
{

constexpr int Size = 256;
constexpr double Block[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
// Background of the images only, behind the volumes.
constexpr double Background = 0.95;

// Difference that is shown in black; equal pixels are white.
constexpr double LargestShown = 3e-6;

/** A backend and the goal for its float error. */
struct Column
{
  const char* Name;
  int Backend;
  double Tolerance;
};
constexpr std::array<Column, 2> Columns{ { { "native", vtkTetrahedraRayCastMapper::NATIVE, 2e-5 },
  { "OpenGL", vtkTetrahedraRayCastMapper::OPENGL, 1e-4 } } };

// Titles of the sheet's columns.
const std::vector<std::string> Titles{ "native", "traced rays", "error, native", "error, OpenGL" };

using Colors = std::vector<std::array<double, 4>>;

Colors Trace(RayCastScene& scene, const MembraneStack& stack)
{
  const PixelRays rays(scene.GetRenderer());
  const auto integrator = MakeReference(scene.MakeGrid());
  const auto function = ToReference(scene.GetVolume()->GetProperty());
  Colors colors(static_cast<std::size_t>(Size) * Size);
  vtkSMPTools::For(0, Size * Size,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const Ray ray = rays.GetRay(static_cast<int>(i % Size), static_cast<int>(i / Size));
        colors[static_cast<std::size_t>(i)] = ComposeParts(FindParts(stack, ray, false),
          [&](const Ray& part) { return integrator->Trace(part, function); });
      }
    });
  return colors;
}

template <typename Color>
glm::dvec3 OverBackground(const Color& color)
{
  return glm::dvec3(color[0], color[1], color[2]) + Background * (1.0 - color[3]);
}

/** The native image, that of traced rays, and the difference of each backend. */
void ExpectRow(ComparisonSheet& sheet, int row, const std::string& name, vtkUnstructuredGrid* grid,
  vtkVolumeProperty* property, const MembraneStack& stack)
{
  RayCastScene scene(grid, property, Size, Size);
  SetStack(scene.GetRayCaster(), stack);
  LookAt(scene.GetRenderer(), Block, 30.0, 50.0);
  scene.GetWindow()->Render();
  const Colors truth = Trace(scene, stack);
  for (std::size_t k = 0; k < Columns.size(); ++k)
  {
    scene.GetRayCaster()->SetBackend(Columns[k].Backend);
    const FloatImage image = scene.RenderFloat();
    EXPECT_EQ(scene.GetRayCaster()->GetActiveBackend(), Columns[k].Backend);
    double largest = 0.0;
    for (int i = 0; i < Size * Size; ++i)
    {
      const int x = i % Size;
      const int y = i / Size;
      const auto& exact = truth[static_cast<std::size_t>(i)];
      double error = 0.0;
      for (int c = 0; c < 4; ++c)
      {
        error =
          std::max(error, std::fabs(image.GetPixel(x, y)[c] - exact[static_cast<std::size_t>(c)]));
      }
      largest = std::max(largest, error);
      if (k == 0)
      {
        sheet.SetPixel(row, 0, x, y, OverBackground(image.GetPixel(x, y)));
        sheet.SetPixel(row, 1, x, y, OverBackground(exact));
      }
      sheet.SetPixel(row, 2 + static_cast<int>(k), x, y, glm::dvec3(1.0 - error / LargestShown));
    }
    std::printf("%s, %s: largest error %.1e\n", name.c_str(), Columns[k].Name, largest);
    EXPECT_LE(largest, Columns[k].Tolerance) << name << ", " << Columns[k].Name;
  }
}

/** Distance from a tilted circle of radius 0.6. */
double RingField(double x, double y, double z)
{
  const double up = 0.8 * y - 0.6 * z;
  const double across = 0.6 * y + 0.8 * z;
  return std::hypot(std::hypot(x, across) - 0.6, up);
}

/** A core, and a shell around it. */
vtkSmartPointer<vtkVolumeProperty> MakeShells()
{
  const auto color = MakeColors({ { 0.0, 1.0, 0.95, 0.3 }, { 0.15, 1.0, 0.35, 0.1 },
    { 0.35, 0.1, 0.5, 0.8 }, { 1.2, 0.2, 0.2, 0.6 } });
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(color);
  property->SetScalarOpacity(MakeOpacity({ { 0.0, 6.0 }, { 0.14, 9.0 }, { 0.2, 0.0 }, { 0.3, 0.0 },
    { 0.35, 1.6 }, { 0.42, 0.0 }, { 1.2, 0.25 } }));
  property->SetInterpolationTypeToLinear();
  return property;
}

} // anonymous namespace

TEST(MembraneComparison, PlaneAndDomeBesideRefractedRays)
{
  constexpr double range[2] = { -1.0, 1.0 };
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const auto property = MakeProperty(FunctionKind::Smooth, range, 3.4);
  ComparisonSheet sheet({ "plane", "dome" }, Titles, Size);
  ExpectRow(sheet, 0, "plane", grid, property, { MakePlaneCase(1.3, 3.0, 3) });
  ExpectRow(sheet, 1, "dome", grid, property, { MakeDomeCase(1.6, 3.0, 2.0, 40) });
  sheet.Write(MENISCUS_TEMPORARY_DIR "/membrane-comparison.png");
}

TEST(MembraneComparison, LayersPaneAndBallBesideRefractedRays)
{
  const Grid grid = MakeBlock(16, RingField);
  const auto property = MakeShells();
  const auto plane = [](double level, double half, double before, double behind)
  { return Between(MakePlaneCase(level, half, 3), before, behind); };
  const MembraneCase ball = Between(MakeBallCase({ 0.67, 1.6, 1.17 }, 0.6, 64), 1.0, 1.5);
  ComparisonSheet sheet({ "air, glass, water", "pane", "ball" }, Titles, Size);
  ExpectRow(sheet, 0, "air, glass, water", grid, property,
    { plane(0.6, 9.0, 1.0, 1.5), plane(-0.1, 9.0, 1.5, 1.333) });
  // Rays beside the pane are straight.
  ExpectRow(
    sheet, 1, "pane", grid, property, { plane(0.7, 0.7, 1.0, 1.5), plane(0.1, 9.0, 1.5, 1.0) });
  ExpectRow(sheet, 2, "ball", grid, property, { ball, ball });
  sheet.Write(MENISCUS_TEMPORARY_DIR "/volume-stack-comparison.png");
}

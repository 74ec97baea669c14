// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lighting in the medium with gradients of cells, on real and on graded meshes, whose cells have
// nearly equal scalars and very different sizes.
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 128;
// Number of midpoints per piece; the exact result is extrapolated from this number and twice as
// many.
constexpr int Steps = 6;

// Cells from 0.44 to 1/32,768 of the domain.
Grid MakeGradedBlock()
{
  Grid grid = MakeBlock(8, ConstantField(0.0));
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  const Field field = WavyField(3.0);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double p[3];
    grid->GetPoint(i, p);
    for (double& x : p)
    {
      x = std::copysign(std::pow(std::fabs(x), 7.0), x);
    }
    grid->GetPoints()->SetPoint(i, p);
    scalars->SetComponent(i, 0, field(p[0], p[1], p[2]));
  }
  return grid;
}

// All terms of lighting that are constant in a cell. The denser the medium, the more visible a
// single cell is.
TracedComparison CompareLit(vtkUnstructuredGrid* grid, int view, double density)
{
  const auto property = MakeProperty(FunctionKind::Smooth, grid, DiagonalOf(grid->GetBounds()));
  property->SetScalarOpacityUnitDistance(property->GetScalarOpacityUnitDistance() / density);
  SetMaterial(property);
  RayCastScene scene(grid, property, Size, Size);
  scene.GetRayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
  AddParallelLight(scene.GetRenderer(), 4.0, 2.0, 1.0)->SetDiffuseColor(1.0, 0.6, 0.2);
  const auto angles = ViewAngles(view);
  LookAt(scene.GetRenderer(), grid->GetBounds(), angles[0], angles[1]);
  scene.GetWindow()->Render();
  const auto integrator = MakeReference(grid);
  const ReferenceGradients gradients(integrator->MakeMesh(), false);
  const Material material = ToMaterial(property, scene.GetRenderer());
  const auto function = ToReference(property);
  const FloatImage image = scene.RenderFloat();
  return CompareToTrace(
    image, PixelRays(scene.GetRenderer()),
    [&](const Ray& ray)
    {
      std::vector<RaySegment> segments;
      integrator->FindSegments(ray, segments);
      const auto traced = [&](int steps)
      {
        return IntegrateShaded(
          ray, segments, function, gradients, &material, std::function<double(double)>(), steps);
      };
      // The error of the midpoint rule is a series in the square of the step.
      const auto coarse = traced(Steps);
      auto result = traced(2 * Steps);
      for (int c = 0; c < 4; ++c)
      {
        result[c] += (result[c] - coarse[c]) / 3.0;
      }
      return result;
    },
    // Silhouettes move with the rounding of rays and vertices.
    1e-4, RoundingDistance * DiagonalOf(grid->GetBounds()));
}

constexpr double LargestError = 2e-5;

void ExpectLit(vtkUnstructuredGrid* grid, const std::string& name)
{
  for (const auto& [density, view] : Product(List(1.0, 8.0), List(0, 1)))
  {
    const TracedComparison comparison = CompareLit(grid, view, density);
    std::ostringstream text;
    text << name << ", density " << density << ", view " << view << ": " << comparison.GetText();
    std::cout << text.str() << std::endl;
    EXPECT_GT(comparison.Visible, 1000u) << text.str();
    EXPECT_LE(comparison.Largest, LargestError) << text.str();
    EXPECT_LE(static_cast<double>(comparison.Excused),
      LargestSilhouetteShare * static_cast<double>(comparison.Visible))
      << text.str();
  }
}

class TetrahedraRayCastLightOnData : public ::testing::TestWithParam<const char*>
{
};

} // anonymous namespace

TEST_P(TetrahedraRayCastLightOnData, MatchesReference)
{
  const Grid grid = ReadDataMesh(GetParam());
  if (!grid)
  {
    GTEST_SKIP() << GetParam() << ".vtu not found: set MENISCUS_DATA_DIR";
  }
  ExpectLit(grid, GetParam());
}

INSTANTIATE_TEST_SUITE_P(, TetrahedraRayCastLightOnData,
  ::testing::Values("blunt_fin", "combustor", "crushed_can"),
  [](const ::testing::TestParamInfo<const char*>& mesh) { return std::string(mesh.param); });

TEST(TetrahedraRayCastLight, CellsOfAllSizes)
{
  ExpectLit(MakeGradedBlock(), "graded block");
}

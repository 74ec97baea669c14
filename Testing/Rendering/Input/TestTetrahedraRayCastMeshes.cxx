// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Generated meshes compared with the double-precision reference.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;

const std::vector<FunctionKind> AllKinds{ FunctionKind::Smooth, FunctionKind::Peaked,
  FunctionKind::Opaque, FunctionKind::Sparse };

vtkSmartPointer<vtkVolumeProperty> PropertyFor(vtkUnstructuredGrid* grid, FunctionKind kind)
{
  return MakeProperty(kind, grid, DiagonalOf(grid->GetBounds()));
}

// All kinds of functions in one perspective and one parallel view.
void ExpectMeshMatches(const Grid& grid, const std::string& name)
{
  for (const FunctionKind kind : AllKinds)
  {
    for (const bool parallel : { false, true })
    {
      RayCastScene scene(grid, PropertyFor(grid, kind), Size, Size);
      const auto angles = ViewAngles(parallel ? 3 : 1);
      LookAt(scene.GetRenderer(), grid->GetBounds(), angles[0], angles[1], 1.1, parallel);
      ExpectMatchesReference(scene,
        name + (parallel ? ", parallel" : ", perspective") + ", function " +
          std::to_string(static_cast<int>(kind)));
    }
  }
}

} // anonymous namespace

TEST(TetrahedraRayCastMeshes, SingleTetrahedron)
{
  ExpectMeshMatches(MakeSingleTetrahedron(LinearField(1, 2, 3)), "tetrahedron");
}

TEST(TetrahedraRayCastMeshes, CubesOfFiveAndSix)
{
  ExpectMeshMatches(MakeCubeOfFive(RadialField()), "cube of five");
  ExpectMeshMatches(MakeCubeOfSix(RadialField()), "cube of six");
}

TEST(TetrahedraRayCastMeshes, StructuredBlock)
{
  ExpectMeshMatches(MakeBlock(10, WavyField(3.0)), "block");
}

TEST(TetrahedraRayCastMeshes, JitteredBlock)
{
  // Moves of a tenth of a cube's side move no vertex through a face.
  const Grid grid = MakeBlock(10, WavyField(3.0));
  Jitter(grid, 0.02, 4711);
  ExpectMeshMatches(grid, "jittered block, seed 4711");
}

TEST(TetrahedraRayCastMeshes, NeedlesSeenAslant)
{
  // Needles with an aspect ratio of 1e4, whose edges are long in u and in v: most of the products
  // cancels in the areas by which depth is interpolated. The function is as narrow as the depth's
  // last digit allows.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  MapPoints(grid, [](const glm::dvec3& x) { return x * glm::dvec3(1e4, 1.0, 1.0); });
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, grid, 300.0), Size, Size);
  vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(2.0);
  camera->SetFocalPoint(700.0, 0.0, 0.0);
  camera->SetPosition(700.0 + 2e4, 1.7e4, 0.9e4);
  camera->SetViewUp(0.3, 0.2, 1.0);
  scene.GetRenderer()->ResetCameraClippingRange();
  scene.GetWindow()->Render();
  const SceneTruth truth = MakeTruth(scene);
  const Comparison comparison =
    CompareToReference(scene.RenderFloat(), truth.Image, *truth.Integrator, truth.RayOf);
  SCOPED_TRACE(comparison.GetText());
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  EXPECT_GT(comparison.Covered, static_cast<std::size_t>(2 * Size * Size / 5));
  EXPECT_EQ(comparison.CoverageMismatches, 0u);
  // Where a face is nearly edge-on, either side of its position in single precision may be drawn.
  EXPECT_LE(comparison.BeyondRounding, 1u);
  EXPECT_LT(comparison.Largest, 2e-4);
  // The shaders' grid has a unit of 2.4e-3, over which the optical depth changes by 7e-5.
  EXPECT_LT(comparison.Rms, 2e-5);
}

TEST(TetrahedraRayCastMeshes, LShape)
{
  ExpectMeshMatches(MakeBlock(8, RadialField(), LShape()), "L shape");
}

TEST(TetrahedraRayCastMeshes, Shell)
{
  ExpectMeshMatches(MakeBlock(14, WavyField(2.0), Shell(0.5, 1.0)), "shell");
}

TEST(TetrahedraRayCastMeshes, Torus)
{
  ExpectMeshMatches(MakeBlock(16, WavyField(2.0), Torus(0.65, 0.3)), "torus");
}

TEST(TetrahedraRayCastMeshes, TwoBlocks)
{
  ExpectMeshMatches(MakeBlock(9, WavyField(3.0), TwoBlocks(0.5)), "two blocks");
}

TEST(TetrahedraRayCastMeshes, FarFromTheOrigin)
{
  const Grid grid = MakeBlock(8, WavyField(3.0));
  TransformPoints(grid, { 1e6, -2e6, 1.5e6 }, 1.0);
  ExpectMeshMatches(grid, "offset by 1e6");
}

TEST(TetrahedraRayCastMeshes, VerySmallAndVeryLarge)
{
  for (const double scale : { 1e-6, 1e6 })
  {
    const Grid grid = MakeBlock(6, WavyField(3.0));
    TransformPoints(grid, { 0.0, 0.0, 0.0 }, scale);
    ExpectMeshMatches(grid, "scaled by " + std::to_string(scale));
  }
}

TEST(TetrahedraRayCastMeshes, RaysThroughVerticesAndEdges)
{
  // Pixel centres lie on multiples of 1/16 in both directions, vertices on multiples of 1/4, so
  // rays run along edges and faces. The outermost lie on the boundary: up to 4 * 33 silhouettes.
  constexpr int odd = 65;
  constexpr double pitch = 0.0625;
  const Grid grid = MakeBlock(8, WavyField(3.0));
  for (const auto& [kind, axis] :
    Product(std::vector<FunctionKind>{ FunctionKind::Smooth, FunctionKind::Peaked }, 3))
  {
    RayCastScene scene(grid, PropertyFor(grid, kind), odd, odd);
    LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), axis);
    scene.GetRenderer()->GetActiveCamera()->SetParallelScale(0.5 * odd * pitch);
    ExpectMatchesReference(
      scene, "along axis " + std::to_string(axis), SilhouetteAllowance{ 0.0, 4 * 33 });
  }
}

TEST(TetrahedraRayCastMeshes, OverlappingParts)
{
  // Two blocks that interpenetrate: the cell entered first is used up to its exit.
  const Grid grid = MakeBlock(1, ConstantField(0.0));
  std::vector<double> points;
  std::vector<vtkIdType> cells;
  for (int part = 0; part < 2; ++part)
  {
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      const double* x = grid->GetPoint(i);
      points.insert(points.end(), { x[0] + 0.31 * part, x[1] + 0.17 * part, x[2] + 0.53 * part });
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType id = 0; id < grid->GetNumberOfCells(); ++id)
    {
      grid->GetCellPoints(id, ids);
      for (const vtkIdType pointId : *ids)
      {
        cells.push_back(pointId + part * grid->GetNumberOfPoints());
      }
    }
  }
  ExpectMeshMatches(MakeGrid(points, cells, WavyField(2.0)), "overlapping blocks");
}

TEST(TetrahedraRayCastMeshes, FoldedMesh)
{
  // Vertices move through faces: some cells are inverted.
  const Grid grid = MakeBlock(6, WavyField(2.0));
  Jitter(grid, 0.22, 99);
  ExpectMeshMatches(grid, "folded block, seed 99");
}

TEST(TetrahedraRayCastMeshes, OpacityPerUnitDistance)
{
  // The mapper samples the logarithm between nodes to 1/32768 of alpha over the unit distance (see
  // its header); a ray is up to a diagonal long.
  const Grid grid = MakeBlock(8, WavyField(3.0));
  RayCastScene scene(grid, PropertyFor(grid, FunctionKind::Smooth), Size, Size);
  constexpr double unit = 0.8;
  const double tolerance = DiagonalOf(grid->GetBounds()) / unit / 32768.0;
  scene.GetVolume()->GetProperty()->SetScalarOpacityUnitDistance(unit);
  scene.GetRayCaster()->SetOpacityModel(vtkTetrahedraRayCastMapper::OPACITY_PER_UNIT_DISTANCE);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 25.0, 30.0);
  scene.GetWindow()->Render();
  const SceneTruth truth = MakeTruth(scene);
  ExpectMatch(
    CompareToReference(scene.RenderFloat(), truth.Image, *truth.Integrator, truth.RayOf, tolerance),
    "opacity per unit distance");
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Real meshes at 512 x 512, two views each, compared with the double-precision reference. Skipped
// with a message if the data folder does not exist.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 320;

class TetrahedraRayCastDataMeshes : public ::testing::TestWithParam<const char*>
{
};

// Largest error of a pixel in float. With the sharp function the native backend has one pixel of
// 2.0e-5, where the exact result changes as much when the ray moves by the rounding of coordinates.
double ToleranceOf(bool sharp)
{
  return sharp && BackendUnderTest() == vtkTetrahedraRayCastMapper::NATIVE ? 2.5e-5 : 1e-5;
}

// One view with all functions: the reference locates the cells of a ray once.
void ExpectViewMatches(vtkUnstructuredGrid* grid, int view, const std::string& name)
{
  double range[2];
  grid->GetPointData()->GetScalars()->GetFiniteRange(range);
  const double diagonal = DiagonalOf(grid->GetBounds());
  const std::vector<vtkSmartPointer<vtkVolumeProperty>> properties{
    MakeProperty(FunctionKind::Smooth, range, diagonal),
    MakeProperty(FunctionKind::Peaked, range, diagonal),
    MakeProperty(FunctionKind::Sharp, range, diagonal)
  };
  const char* const names[3] = { "smooth", "peaked", "sharp" };
  RayCastScene scene(grid, properties[0], Size, Size);
  const auto angles = ViewAngles(view);
  LookAt(scene.GetRenderer(), grid->GetBounds(), angles[0], angles[1], 1.0, view % 2 == 1);
  scene.GetWindow()->Render();

  const auto integrator = MakeReference(grid);
  const PixelRays rays(scene.GetRenderer());
  const RayOfPixel rayOf = [&rays](int x, int y) { return rays.GetRay(x, y); };
  const auto truth = RenderReference(*integrator, rays.GetWidth(), rays.GetHeight(), rayOf,
    { ToReference(properties[0]), ToReference(properties[1]), ToReference(properties[2]) });
  for (std::size_t f = 0; f < properties.size(); ++f)
  {
    const std::string what = name + ", view " + std::to_string(view) + ", " + names[f];
    scene.SetProperty(properties[f]);
    const Comparison floats =
      CompareToReference(scene.RenderFloat(), truth[f], *integrator, rayOf, ToleranceOf(f == 2));
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0) << what;
    const Comparison bytes =
      CompareToReference(scene.RenderBytes(), truth[f], *integrator, rayOf, { 0.0, 0.0, 0.0 });
    std::cout << what << ", float: " << floats.GetText() << '\n'
              << what << ", 8 bits: " << bytes.GetText() << std::endl;
    ExpectMatch(floats, what + " (float)");
    ExpectMatch(bytes, what + " (8 bits)");
  }
}

} // anonymous namespace

TEST_P(TetrahedraRayCastDataMeshes, MatchReference)
{
  const Grid grid = ReadDataMesh(GetParam());
  if (!grid)
  {
    GTEST_SKIP() << GetParam() << ".vtu not found: set MENISCUS_DATA_DIR";
  }
  for (const int view : { 0, 1 })
  {
    ExpectViewMatches(grid, view, GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(, TetrahedraRayCastDataMeshes,
  ::testing::Values("blunt_fin", "combustor", "crushed_can"),
  [](const ::testing::TestParamInfo<const char*>& mesh) { return std::string(mesh.param); });

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelPicture.h"

#include "Volume/Caster/PacketTables.h"
#include "Volume/Mesh/ScalarGradients.h"
#include "Volume/Rays/PlacedVertices.h"
#include "Volume/Rays/RayPivot.h"

#include <cctype>

namespace meniscus::test
{

//------------------------------------------------------------------------------
Picture CastPicture(const PictureScene& scene, int size, InstructionSet set, float windowDepth)
{
  const std::vector<float> depths(static_cast<std::size_t>(size) * size, windowDepth);
  return CastPicture(scene, size, set, depths);
}

//------------------------------------------------------------------------------
Picture CastPicture(
  const PictureScene& scene, int size, InstructionSet set, const std::vector<float>& windowDepths)
{
  PacketTables tables;
  const FixedPointRays rays(
    scene.Frame, size, size, FindPivot(scene.Frame, size, size, scene.Mesh));
  PlaceVertices(scene.Mesh, scene.Scalars, rays, SerialLoop, tables.Vertices);
  tables.Intervals = PackIntervals(scene.Intervals);
  tables.GradientIntervals = PackIntervals(scene.GradientIntervals);
  tables.Surfaces = scene.Surfaces;
  for (const std::vector<TransferFunctionInterval>& intervals : scene.OtherIntervals)
  {
    tables.OtherIntervals.push_back(PackIntervals(intervals));
  }
  TileCaster::Scene cast = scene.Optics;
  const std::vector<double> scalars(scene.Scalars.begin(), scene.Scalars.end());
  std::vector<glm::vec3> gradients;
  if (!cast.CellScalars && !cast.CellGradients)
  {
    gradients = ComputeCellGradients(scene.Mesh, scalars, 1.0);
    cast.CellGradients = gradients.data();
  }
  cast.GradientOpacity = !scene.GradientIntervals.empty();
  const std::vector<CellPassages> passages = FindPassages(scene.Mesh);
  cast.Mesh = &scene.Mesh;
  cast.Passages = &passages;
  cast.Boundary = &scene.Mesh.GetBoundary();
  cast.Tables = &tables;
  cast.Rays = rays;
  cast.Set = set;

  const std::size_t pixels = static_cast<std::size_t>(size) * size;
  Picture picture{ size, std::vector<float>(4 * pixels, 0.0f), RayStatistics() };
  const TileCaster caster(cast);
  TileCaster::Workspace workspace;
  for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
  {
    const RayStatistics sums =
      caster.Cast(tile, windowDepths.data(), picture.Rgba.data(), workspace);
    picture.Statistics.Steps += sums.Steps;
    picture.Statistics.Rays += sums.Rays;
    picture.Statistics.Lost += sums.Lost;
    picture.Statistics.Interpolated += sums.Interpolated;
  }
  return picture;
}

//------------------------------------------------------------------------------
std::string TestNameOf(const ::testing::TestParamInfo<InstructionSet>& tested)
{
  std::string name = NameOf(tested.param);
  const auto isOther = [](unsigned char letter) { return std::isalnum(letter) == 0; };
  name.erase(std::remove_if(name.begin(), name.end(), isOther), name.end());
  return name;
}

}

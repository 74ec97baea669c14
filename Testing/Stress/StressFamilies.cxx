// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HardMeshes.h"
#include "StressCase.h"
#include "TestMeshes.h"
#include "VolumeFunctions.h"
#include "VolumeScene.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace meniscus
{
namespace test
{

namespace
{

// Parameters of a case: the repetition of the family's variants, and its own random numbers.
struct CaseSeed
{
  int Variant;
  int Repetition;
  RandomNumbers Random;
};

using Maker = std::function<StressCase(CaseSeed&)>;

class FamilyList
{
public:
  FamilyList(double intensity, std::uint64_t seed)
    : Repetitions(std::max(1, static_cast<int>(std::lround(std::sqrt(intensity)))))
    , Seed(seed)
  {
  }

  void add(const std::string& name, int variants, const Maker& make)
  {
    this->add(name, variants, this->Repetitions, make);
  }

  void add(const std::string& name, int variants, int repetitions, const Maker& make)
  {
    // Every case has its own random stream, so that it can be run alone.
    const std::uint64_t stream = this->Seed + 0x1000003u * (this->Families.size() + 1);
    this->Families.push_back({ name, variants * repetitions,
      [=](int index)
      {
        CaseSeed seed{ index % variants, index / variants,
          RandomNumbers(stream ^ (static_cast<std::uint64_t>(index) << 32)) };
        return make(seed);
      } });
  }

  std::vector<StressFamily> done() { return std::move(this->Families); }

private:
  int Repetitions;
  std::uint64_t Seed;
  std::vector<StressFamily> Families;
};

// One perspective and one parallel view from random directions.
std::vector<VolumeView> randomViews(vtkUnstructuredGrid* grid, RandomNumbers& random)
{
  const double* bounds = grid->GetBounds();
  return { VolumeView::towards(bounds, random.direction(), false),
    VolumeView::towards(bounds, random.direction(), true) };
}

void takeFunction(StressCase& stress, const std::vector<NamedFunction>& functions, int i)
{
  const NamedFunction& function = functions[static_cast<std::size_t>(i) % functions.size()];
  stress.Function = function.Function;
  stress.Name += ", " + function.Name;
}

// A mesh with each of the usual functions in turn, from random views.
StressCase usual(const std::string& name, const Grid& mesh, CaseSeed& seed, int function)
{
  StressCase stress;
  stress.Name = name;
  stress.Mesh = mesh;
  takeFunction(stress, usualFunctions(mesh), function);
  stress.Views = randomViews(mesh, seed.Random);
  return stress;
}

StressCase dataMesh(CaseSeed& seed)
{
  const char* const names[3] = { "blunt_fin", "combustor", "crushed_can" };
  const char* const name = names[seed.Variant / 4];
  static std::map<std::string, Grid> read; // reading takes longer than drawing
  if (read.count(name) == 0)
  {
    read[name] = readDataMesh(name);
  }
  if (!read[name])
  {
    StressCase missing;
    missing.Name = name;
    return missing;
  }
  StressCase stress = usual(name, read[name], seed, seed.Variant);
  stress.Size = 128;
  return stress;
}

// Vertices on multiples of 1/4, rays on multiples of 1/16: along edges, in faces, through vertices.
StressCase alignedRays(CaseSeed& seed)
{
  const Grid mesh = makeBlock(8, wavyField(3.0));
  StressCase stress;
  stress.Name = "along axis " + std::to_string(seed.Variant % 3);
  stress.Mesh = mesh;
  takeFunction(stress, usualFunctions(mesh), seed.Variant / 3 + seed.Repetition);
  glm::dvec3 direction(0.0);
  direction[seed.Variant % 3] = seed.Repetition % 2 ? -1.0 : 1.0;
  VolumeView view = VolumeView::towards(mesh->GetBounds(), direction, true);
  stress.Size = 65;
  view.HalfHeight = 0.5 * 65 / 16.0;
  stress.Views = { view };
  // The border of the visible square: 4 * 32 of 33 * 33 rays.
  stress.SilhouetteShare = 0.12;
  return stress;
}

// Rays from a vertex, or towards vertices along diagonals of cubes and of faces.
StressCase diagonalRays(CaseSeed& seed)
{
  const glm::dvec3 directions[4] = { { 1, 1, 0 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, -1, 1 } };
  const Grid mesh = makeBlock(6, wavyField(3.0));
  StressCase stress;
  stress.Name = "along diagonal " + std::to_string(seed.Variant % 4);
  stress.Mesh = mesh;
  takeFunction(stress, usualFunctions(mesh), seed.Repetition);
  stress.Size = 65; // the ray in the middle runs through vertices
  VolumeView view =
    VolumeView::towards(mesh->GetBounds(), directions[seed.Variant % 4], seed.Variant < 4);
  view.HalfHeight *= seed.Repetition % 2 ? 0.1 : 1.0;
  if (seed.Variant >= 8)
  {
    stress.Name += ", from a vertex";
    const glm::dvec3 vertex(1.0 / 3.0, -1.0 / 3.0, 0.0);
    view.Focus = vertex + directions[seed.Variant % 4];
    view.Eye = vertex;
    view.HalfHeight = 0.8;
    view.Near = 1e-3;
    view.Far = 10.0;
  }
  stress.Views = { view };
  return stress;
}

StressCase tangled(CaseSeed& seed)
{
  const auto number = static_cast<unsigned int>(seed.Random.bits());
  const Grid mesh = makeTangledBlock(6 + 2 * (seed.Variant / 4), 0.19, number);
  StressCase stress = usual("jitter seed " + std::to_string(number), mesh, seed, seed.Variant);
  return stress;
}

// Variants: seen along the flattened side of 1e-7, or from a random direction; with the usual
// density, or increased in proportion to the flattening.
StressCase flattened(CaseSeed& seed)
{
  const int axis = seed.Variant % 3;
  const bool dense = seed.Variant % 2 == 1;
  const Grid mesh = makeBlock(8, wavyField(3.0));
  jitter(mesh, 0.02, static_cast<unsigned int>(seed.Random.bits()));
  StressCase stress = usual("flattened along " + std::to_string(axis), mesh, seed, seed.Variant);
  mapPoints(mesh,
    [axis](glm::dvec3 p)
    {
      p[axis] *= 1e-7;
      return p;
    });
  stress.Views = randomViews(mesh, seed.Random);
  glm::dvec3 direction(0.0);
  direction[axis] = 1.0;
  stress.Views.push_back(VolumeView::towards(mesh->GetBounds(), direction, true));
  direction[(axis + 1) % 3] = 1e-3;
  stress.Views.push_back(VolumeView::towards(mesh->GetBounds(), direction, false));
  if (dense)
  {
    stress.Name += ", dense";
    for (auto& node : stress.Function)
    {
      node.Value.Attenuation *= 1e7;
    }
    // Thinner than the positions of vertices in single precision: there is no exact reference.
    stress.Rule = StressRule::Bounds;
  }
  return stress;
}

StressCase farAndScaled(CaseSeed& seed)
{
  const double scales[6] = { 1.0, 1e-6, 1e6, 1e-20, 1e20, 1.0 }; // squares exceed the range of
                                                                 // float, too
  const int variant = seed.Variant % 6;
  const double offset = variant == 0 || variant == 5 ? 1e6 : 0.0;
  const int n = variant == 5 ? 12 : 8;
  const Grid mesh = makeBlock(n, wavyField(3.0), variant == 5 ? shell(0.4, 1.1) : nullptr);
  jitter(mesh, 0.1 / n, static_cast<unsigned int>(seed.Random.bits()));
  // Unit cells.
  const double scale = offset > 0.0 ? 0.5 * n : scales[variant];
  mapPoints(
    mesh, [=](const glm::dvec3& p) { return scale * p + offset * glm::dvec3(1.0, -2.0, 1.5); });
  return usual("scale " + std::to_string(scale) + ", offset " + std::to_string(offset), mesh, seed,
    seed.Variant / 6 + seed.Repetition);
}

StressCase slivers(CaseSeed& seed)
{
  const bool layers = seed.Variant % 2 == 0;
  const int axis = seed.Variant / 2 % 3;
  const Grid mesh = layers ? makeLayeredBlock(8, 1e-4) : makeBlock(6, wavyField(3.0));
  if (!layers)
  {
    mapPoints(mesh,
      [axis](glm::dvec3 p)
      {
        p[axis] *= 1e4;
        return p;
      });
  }
  StressCase stress =
    usual(layers ? "layers of 1e-4" : "needles of 1e4", mesh, seed, seed.Variant + seed.Repetition);
  if (!layers && seed.Variant >= 6)
  {
    // Seen from nearby, with a density in proportion to the thinness: a ray is in the mesh for 2 of
    // 1e4 units. The grid of 2^-22 of the radius to which vertices are rounded is 1/140 of a cell
    // there, so there is no exact reference.
    stress.Name += ", dense";
    stress.Rule = StressRule::Bounds;
    const glm::dvec3 direction = seed.Random.direction();
    stress.Views = { VolumeView::towards(mesh->GetBounds(), direction, false, 3000.0),
      VolumeView::towards(mesh->GetBounds(), direction, true, 3000.0) };
    for (auto& node : stress.Function)
    {
      node.Value.Attenuation *= 1e3;
    }
  }
  return stress;
}

StressCase zeroVolume(CaseSeed& seed)
{
  const bool runs = seed.Variant % 2 == 0;
  const Grid mesh = runs ? makeLayeredBlock(8, 0.0) : makeSeam(6);
  StressCase stress = usual(runs ? "layers of no thickness" : "seam of duplicate points", mesh,
    seed, seed.Variant / 2 + seed.Repetition);
  if (seed.Variant >= 8)
  {
    // Along the layers, in the plane of the flat cells.
    glm::dvec3 direction(0.0);
    direction[seed.Variant % 3] = 1.0;
    stress.Views = { VolumeView::towards(mesh->GetBounds(), direction, true) };
    stress.Size = 65;
    // Scalars on the two sides of a flat layer differ: a row and a column of 37 * 37 rays run where
    // the field jumps, and either side is correct.
    stress.SilhouetteShare = 0.06;
  }
  return stress;
}

StressCase degenerateFunction(CaseSeed& seed)
{
  const Grid mesh = makeBlock(6, wavyField(2.0), shell(0.2, 1.4));
  jitter(mesh, 0.03, static_cast<unsigned int>(seed.Random.bits()));
  StressCase stress;
  stress.Mesh = mesh;
  stress.Name = "shell";
  stress.Views = randomViews(mesh, seed.Random);
  double range[2];
  mesh->GetPointData()->GetScalars()->GetFiniteRange(range);
  const auto functions = degenerateFunctions(range, 2.0);
  takeFunction(stress, functions, seed.Variant);
  return stress;
}

// Fields: constant, with huge and with tiny values, with a small range far from 0, with NaN.
StressCase degenerateField(CaseSeed& seed)
{
  const char* const names[5] = { "constant", "times 1e30", "times 1e-30", "range 1e-3 at 1e3",
    "NaN at every 50th point" };
  const int variant = seed.Variant % 5;
  const Grid mesh = makeBlock(6, wavyField(2.0));
  jitter(mesh, 0.03, static_cast<unsigned int>(seed.Random.bits()));
  vtkDataArray* scalars = mesh->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    const double s = scalars->GetComponent(i, 0);
    const double values[5] = { 3.25, 1e30 * s, 1e-30 * s, 1e3 + 5e-4 * s,
      i % 50 ? s : std::numeric_limits<double>::quiet_NaN() };
    scalars->SetComponent(i, 0, values[variant]);
  }
  scalars->Modified();
  StressCase stress;
  stress.Mesh = mesh;
  stress.Name = names[variant];
  stress.Views = randomViews(mesh, seed.Random);
  double range[2];
  scalars->GetFiniteRange(range);
  stress.Function = randomFunction(range, 2.0, seed.Random);
  return stress;
}

StressCase randomSmall(CaseSeed& seed)
{
  StressCase stress;
  stress.Mesh = makeRandomMesh(seed.Random);
  stress.Name = "mesh " + std::to_string(seed.Repetition);
  double range[2];
  stress.Mesh->GetPointData()->GetScalars()->GetFiniteRange(range);
  stress.Function = randomFunction(range, diagonalOf(stress.Mesh->GetBounds()), seed.Random);
  stress.Views = { VolumeView::towards(
    stress.Mesh->GetBounds(), seed.Random.direction(), seed.Repetition % 3 == 0) };
  stress.Size = 32;
  return stress;
}

StressCase soup(CaseSeed& seed)
{
  StressCase stress;
  stress.Mesh = makeSoup(seed.Random);
  stress.Name = "soup " + std::to_string(seed.Repetition);
  takeFunction(stress, usualFunctions(stress.Mesh), seed.Repetition);
  stress.Views = randomViews(stress.Mesh, seed.Random);
  stress.Rule = StressRule::Bounds;
  stress.Size = 32;
  return stress;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<StressFamily> stressFamilies(double intensity, std::uint64_t seed)
{
  const int randomMeshes = std::max(10, static_cast<int>(std::lround(100.0 * intensity)));
  FamilyList list(intensity, seed);
  list.add("data meshes", 12, dataMesh);
  list.add("aligned rays", 12, alignedRays);
  list.add("diagonal rays", 12, diagonalRays);
  list.add("tangled, 19 %", 8, tangled);
  list.add("flattened by 1e-7", 12, flattened);
  list.add("far and scaled", 12, farAndScaled);
  list.add("slivers of 1e4", 12, slivers);
  list.add("zero volume", 12, zeroVolume);
  list.add("functions", 17, degenerateFunction);
  list.add("fields", 10, degenerateField);
  list.add("random meshes", 1, randomMeshes, randomSmall);
  list.add("soup", 1, randomMeshes / 4, soup);
  return list.done();
}

} // namespace test
} // namespace meniscus

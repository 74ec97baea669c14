// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HardMeshes.h"
#include "StressCase.h"
#include "VolumeScene.h"

namespace meniscus::test
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

  void Add(const std::string& name, int variants, const Maker& make)
  {
    this->Add(name, variants, this->Repetitions, make);
  }

  void Add(const std::string& name, int variants, int repetitions, const Maker& make)
  {
    // Every case has its own random stream, so that it can be run alone.
    const std::uint64_t stream = this->Seed + 0x1000003u * (this->Families.size() + 1);
    this->Families.push_back({ name, variants * repetitions,
      [=](int index)
      {
        CaseSeed seed{ index % variants, index / variants,
          RandomNumbers(stream ^ (static_cast<std::uint64_t>(index) << 32)) };
        StressCase stress = make(seed);
        stress.Number = index;
        return stress;
      } });
  }

  std::vector<StressFamily> Done() { return std::move(this->Families); }

private:
  int Repetitions;
  std::uint64_t Seed;
  std::vector<StressFamily> Families;
};

// One perspective and one parallel view from random directions.
std::vector<VolumeView> RandomViews(vtkUnstructuredGrid* grid, RandomNumbers& random)
{
  const double* bounds = grid->GetBounds();
  return { VolumeView::Towards(bounds, random.GetDirection(), false),
    VolumeView::Towards(bounds, random.GetDirection(), true) };
}

void TakeFunction(StressCase& stress, const std::vector<NamedFunction>& functions, int i)
{
  const NamedFunction& function = functions[static_cast<std::size_t>(i) % functions.size()];
  stress.Function = function.Function;
  stress.Name += ", " + function.Name;
}

// A mesh with each of the usual functions in turn, from random views.
StressCase Usual(const std::string& name, const Grid& mesh, CaseSeed& seed, int function)
{
  StressCase stress;
  stress.Name = name;
  stress.Mesh = mesh;
  TakeFunction(stress, UsualFunctions(mesh), function);
  stress.Views = RandomViews(mesh, seed.Random);
  return stress;
}

StressCase DataMesh(CaseSeed& seed)
{
  const char* const names[3] = { "blunt_fin", "combustor", "crushed_can" };
  const char* const name = names[seed.Variant / 4];
  static std::map<std::string, Grid> read; // reading takes longer than drawing
  if (read.count(name) == 0)
  {
    read[name] = ReadDataMesh(name);
  }
  if (!read[name])
  {
    StressCase missing;
    missing.Name = name;
    return missing;
  }
  StressCase stress = Usual(name, read[name], seed, seed.Variant);
  stress.Size = 128;
  return stress;
}

// Vertices on multiples of 1/4, rays on multiples of 1/16: along edges, in faces, through vertices.
StressCase AlignedRays(CaseSeed& seed)
{
  const Grid mesh = MakeBlock(8, WavyField(3.0));
  StressCase stress;
  stress.Name = "along axis " + std::to_string(seed.Variant % 3);
  stress.Mesh = mesh;
  TakeFunction(stress, UsualFunctions(mesh), seed.Variant / 3 + seed.Repetition);
  glm::dvec3 direction(0.0);
  direction[seed.Variant % 3] = seed.Repetition % 2 ? -1.0 : 1.0;
  VolumeView view = VolumeView::Towards(mesh->GetBounds(), direction, true);
  stress.Size = 65;
  view.HalfHeight = 0.5 * 65 / 16.0;
  stress.Views = { view };
  // The border of the visible square: 4 * 32 of 33 * 33 rays.
  stress.SilhouetteShare = 0.12;
  return stress;
}

// Rays from a vertex, or towards vertices along diagonals of cubes and of faces.
StressCase DiagonalRays(CaseSeed& seed)
{
  const glm::dvec3 directions[4] = { { 1, 1, 0 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, -1, 1 } };
  const Grid mesh = MakeBlock(6, WavyField(3.0));
  StressCase stress;
  stress.Name = "along diagonal " + std::to_string(seed.Variant % 4);
  stress.Mesh = mesh;
  TakeFunction(stress, UsualFunctions(mesh), seed.Repetition);
  stress.Size = 65; // the ray in the middle runs through vertices
  VolumeView view =
    VolumeView::Towards(mesh->GetBounds(), directions[seed.Variant % 4], seed.Variant < 4);
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

StressCase Tangled(CaseSeed& seed)
{
  const auto number = static_cast<unsigned int>(seed.Random.Bits());
  const Grid mesh = MakeTangledBlock(6 + 2 * (seed.Variant / 4), 0.19, number);
  StressCase stress = Usual("jitter seed " + std::to_string(number), mesh, seed, seed.Variant);
  return stress;
}

// Variants: seen along the flattened side of 1e-7, or from a random direction; with the usual
// density, or increased in proportion to the flattening.
StressCase Flattened(CaseSeed& seed)
{
  const int axis = seed.Variant % 3;
  const bool dense = seed.Variant % 2 == 1;
  const Grid mesh = MakeBlock(8, WavyField(3.0));
  Jitter(mesh, 0.02, static_cast<unsigned int>(seed.Random.Bits()));
  StressCase stress = Usual("flattened along " + std::to_string(axis), mesh, seed, seed.Variant);
  MapPoints(mesh,
    [axis](glm::dvec3 p)
    {
      p[axis] *= 1e-7;
      return p;
    });
  stress.Views = RandomViews(mesh, seed.Random);
  glm::dvec3 direction(0.0);
  direction[axis] = 1.0;
  stress.Views.push_back(VolumeView::Towards(mesh->GetBounds(), direction, true));
  direction[(axis + 1) % 3] = 1e-3;
  stress.Views.push_back(VolumeView::Towards(mesh->GetBounds(), direction, false));
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

StressCase FarAndScaled(CaseSeed& seed)
{
  const double scales[6] = { 1.0, 1e-6, 1e6, 1e-20, 1e20, 1.0 }; // squares exceed the range of
                                                                 // float, too
  const int variant = seed.Variant % 6;
  const double offset = variant == 0 || variant == 5 ? 1e6 : 0.0;
  const int n = variant == 5 ? 12 : 8;
  const Grid mesh = MakeBlock(n, WavyField(3.0), variant == 5 ? Shell(0.4, 1.1) : nullptr);
  Jitter(mesh, 0.1 / n, static_cast<unsigned int>(seed.Random.Bits()));
  // Unit cells.
  const double scale = offset > 0.0 ? 0.5 * n : scales[variant];
  MapPoints(
    mesh, [=](const glm::dvec3& p) { return scale * p + offset * glm::dvec3(1.0, -2.0, 1.5); });
  return Usual("scale " + std::to_string(scale) + ", offset " + std::to_string(offset), mesh, seed,
    seed.Variant / 6 + seed.Repetition);
}

StressCase Slivers(CaseSeed& seed)
{
  const bool layers = seed.Variant % 2 == 0;
  const int axis = seed.Variant / 2 % 3;
  const Grid mesh = layers ? MakeLayeredBlock(8, 1e-4) : MakeBlock(6, WavyField(3.0));
  if (!layers)
  {
    MapPoints(mesh,
      [axis](glm::dvec3 p)
      {
        p[axis] *= 1e4;
        return p;
      });
  }
  StressCase stress =
    Usual(layers ? "layers of 1e-4" : "needles of 1e4", mesh, seed, seed.Variant + seed.Repetition);
  if (!layers && seed.Variant >= 6)
  {
    // Seen from nearby, with a density in proportion to the thinness: a ray is in the mesh for 2 of
    // 1e4 units. The grid of 2^-22 of the radius to which vertices are rounded is 1/140 of a cell
    // there, so there is no exact reference.
    stress.Name += ", dense";
    stress.Rule = StressRule::Bounds;
    const glm::dvec3 direction = seed.Random.GetDirection();
    stress.Views = { VolumeView::Towards(mesh->GetBounds(), direction, false, 3000.0),
      VolumeView::Towards(mesh->GetBounds(), direction, true, 3000.0) };
    for (auto& node : stress.Function)
    {
      node.Value.Attenuation *= 1e3;
    }
  }
  return stress;
}

StressCase ZeroVolume(CaseSeed& seed)
{
  const bool runs = seed.Variant % 2 == 0;
  const Grid mesh = runs ? MakeLayeredBlock(8, 0.0) : MakeSeam(6);
  StressCase stress = Usual(runs ? "layers of no thickness" : "seam of duplicate points", mesh,
    seed, seed.Variant / 2 + seed.Repetition);
  if (seed.Variant >= 8)
  {
    // Along the layers, in the plane of the flat cells.
    glm::dvec3 direction(0.0);
    direction[seed.Variant % 3] = 1.0;
    stress.Views = { VolumeView::Towards(mesh->GetBounds(), direction, true) };
    stress.Size = 65;
    // Scalars on the two sides of a flat layer differ: a row and a column of 37 * 37 rays run where
    // the field jumps, and either side is correct.
    stress.SilhouetteShare = 0.06;
  }
  return stress;
}

StressCase DegenerateFunction(CaseSeed& seed)
{
  const Grid mesh = MakeBlock(6, WavyField(2.0), Shell(0.2, 1.4));
  Jitter(mesh, 0.03, static_cast<unsigned int>(seed.Random.Bits()));
  StressCase stress;
  stress.Mesh = mesh;
  stress.Name = "shell";
  stress.Views = RandomViews(mesh, seed.Random);
  double range[2];
  mesh->GetPointData()->GetScalars()->GetFiniteRange(range);
  const auto functions = DegenerateFunctions(range, 2.0);
  TakeFunction(stress, functions, seed.Variant);
  return stress;
}

// Fields: constant, with huge and with tiny values, with a small range far from 0, with NaN.
StressCase DegenerateField(CaseSeed& seed)
{
  const char* const names[5] = { "constant", "times 1e30", "times 1e-30", "range 1e-3 at 1e3",
    "NaN at every 50th point" };
  const int variant = seed.Variant % 5;
  const Grid mesh = MakeBlock(6, WavyField(2.0));
  Jitter(mesh, 0.03, static_cast<unsigned int>(seed.Random.Bits()));
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
  stress.Views = RandomViews(mesh, seed.Random);
  double range[2];
  scalars->GetFiniteRange(range);
  stress.Function = RandomFunction(range, 2.0, seed.Random);
  return stress;
}

StressCase RandomSmall(CaseSeed& seed)
{
  StressCase stress;
  stress.Mesh = MakeRandomMesh(seed.Random);
  stress.Name = "mesh " + std::to_string(seed.Repetition);
  double range[2];
  stress.Mesh->GetPointData()->GetScalars()->GetFiniteRange(range);
  stress.Function = RandomFunction(range, DiagonalOf(stress.Mesh->GetBounds()), seed.Random);
  stress.Views = { VolumeView::Towards(
    stress.Mesh->GetBounds(), seed.Random.GetDirection(), seed.Repetition % 3 == 0) };
  stress.Size = 32;
  return stress;
}

StressCase Soup(CaseSeed& seed)
{
  StressCase stress;
  stress.Mesh = MakeSoup(seed.Random);
  stress.Name = "soup " + std::to_string(seed.Repetition);
  TakeFunction(stress, UsualFunctions(stress.Mesh), seed.Repetition);
  stress.Views = RandomViews(stress.Mesh, seed.Random);
  stress.Rule = StressRule::Bounds;
  stress.Size = 32;
  return stress;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<StressFamily> StressFamilies(double intensity, std::uint64_t seed)
{
  const int randomMeshes = std::max(10, static_cast<int>(std::lround(100.0 * intensity)));
  FamilyList list(intensity, seed);
  list.Add("data meshes", 12, DataMesh);
  list.Add("aligned rays", 12, AlignedRays);
  list.Add("diagonal rays", 12, DiagonalRays);
  list.Add("tangled, 19 %", 8, Tangled);
  list.Add("flattened by 1e-7", 12, Flattened);
  list.Add("far and scaled", 12, FarAndScaled);
  list.Add("slivers of 1e4", 12, Slivers);
  list.Add("zero volume", 12, ZeroVolume);
  list.Add("functions", 17, DegenerateFunction);
  list.Add("fields", 10, DegenerateField);
  list.Add("random meshes", 1, randomMeshes, RandomSmall);
  list.Add("soup", 1, randomMeshes / 4, Soup);
  return list.Done();
}

} // namespace meniscus::test

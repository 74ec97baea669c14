// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackCase.h"

#include "ExactStack.h"
#include "SmoothSurface.h"

namespace meniscus::test
{

namespace
{

using reference::MembraneMesh;
using reference::SmoothSurface;

const double Pi = std::acos(-1.0);
constexpr double Side = 200.0;

// 10 to a random power between the two.
double Magnitude(StressRandom& random, double low, double high)
{
  return std::pow(10.0, random.Uniform(low, high));
}

//------------------------------------------------------------------------------
// Turns normals and windings around.
void Flip(MembraneMesh& mesh)
{
  for (double& value : mesh.Normals)
  {
    value = -value;
  }
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    std::swap(mesh.Triangles[i + 1], mesh.Triangles[i + 2]);
  }
}

// Turns the mesh about the x axis and then about the z axis.
void Tilt(MembraneMesh& mesh, double aboutX, double aboutZ)
{
  for (std::vector<double>* values : { &mesh.Points, &mesh.Normals })
  {
    for (std::size_t i = 0; i < values->size(); i += 3)
    {
      double* p = values->data() + i;
      const double y = std::cos(aboutX) * p[1] - std::sin(aboutX) * p[2];
      p[2] = std::sin(aboutX) * p[1] + std::cos(aboutX) * p[2];
      const double x = std::cos(aboutZ) * p[0] - std::sin(aboutZ) * y;
      p[1] = std::sin(aboutZ) * p[0] + std::cos(aboutZ) * y;
      p[0] = x;
    }
  }
}

MembraneMesh MakePane(StressRandom& random, double side)
{
  MembraneMesh mesh = SmoothSurface{ side, {}, {}, 0.0 }.MakeMesh(2 + random.Below(16));
  if (random.Below(3) > 0)
  {
    Tilt(mesh, random.Uniform(-0.15, 0.15), random.Uniform(-0.15, 0.15));
  }
  return mesh;
}

// Waves and hills with slopes of `slope` at most in all, and no higher than about 12.
MembraneMesh MakeWaves(StressRandom& random, double side, double slope)
{
  SmoothSurface surface;
  surface.Side = side;
  const int count = 1 + random.Below(3);
  for (int i = 0; i < count; ++i)
  {
    const double k = 2.0 * Pi / random.Uniform(50.0, 150.0);
    const double angle = random.Uniform(0.0, 2.0 * Pi);
    surface.Waves.push_back({ slope / count * random.Uniform(0.3, 1.0) / k, k * std::cos(angle),
      k * std::sin(angle), random.Uniform(0.0, 2.0 * Pi) });
  }
  if (random.Below(3) == 0)
  {
    surface.Hills.push_back({ random.Uniform(-8.0, 8.0), random.Uniform(0.015, 0.04),
      random.Uniform(-40.0, 40.0), random.Uniform(-40.0, 40.0) });
  }
  return surface.MakeMesh(6 + random.Below(12));
}

// Caps of a sphere; `bend` is +1 if it is concave to the eye, otherwise -1.
MembraneMesh MakeDome(StressRandom& random, double bend)
{
  SmoothSurface surface;
  surface.SphereRadius = bend * Side * random.Uniform(0.8, 4.0);
  return surface.MakeMesh(4 + random.Below(14));
}

//------------------------------------------------------------------------------
// An index from 0.6 to 2, sometimes the one before.
double NextIndex(StressRandom& random, double before)
{
  return random.Below(6) == 0 ? before : std::exp(random.Uniform(std::log(0.6), std::log(2.0)));
}

double GetLastIndex(const StackCase& test)
{
  return test.Layers.empty() ? 1.0 : test.Layers.back().GetBehind();
}

// Adds a surface at height y; its normals point up or down.
void AddLayer(StackCase& test, StressRandom& random, MembraneMesh mesh, double y, double behind)
{
  const double before = GetLastIndex(test);
  const bool fromFront = random.Below(3) > 0;
  if (!fromFront)
  {
    Flip(mesh);
  }
  mesh.Translate({ 0.0, y, 0.0 });
  test.Meshes.push_back(mesh);
  const InterfaceMedia media =
    fromFront ? InterfaceMedia{ before, behind } : InterfaceMedia{ behind, before };
  test.Layers.push_back({ test.Meshes.size() - 1, media, fromFront });
}

void SetEye(StackCase& test, StressRandom& random, double lowest)
{
  const double elevation = random.Uniform(lowest, 90.0) * Pi / 180.0;
  const double angle = random.Uniform(0.0, 2.0 * Pi);
  test.Eye = glm::dvec3(random.Uniform(-30.0, 30.0), 0.0, random.Uniform(-30.0, 30.0)) +
    Side * Magnitude(random, -0.2, 1.0) *
      glm::dvec3(std::cos(elevation) * std::cos(angle), std::sin(elevation),
        std::cos(elevation) * std::sin(angle));
}

// Two or three surfaces, one below the other, `make(number)`.
template <typename Make>
StackCase MakeSheets(StressRandom& random, double lowest, double highest, const Make& make)
{
  StackCase test;
  test.Seed = random.Bits();
  const int count = 2 + random.Below(2);
  double y = 0.0;
  for (int i = 0; i < count; ++i)
  {
    AddLayer(test, random, make(i), y, NextIndex(random, GetLastIndex(test)));
    y -= random.Uniform(lowest, highest);
  }
  SetEye(test, random, 25.0);
  return test;
}

//------------------------------------------------------------------------------
StackCase MakePanes(StressRandom& random)
{
  return MakeSheets(random, 35.0, 80.0, [&random](int) { return MakePane(random, Side); });
}

StackCase MakeWavySheets(StressRandom& random)
{
  return MakeSheets(random, 26.0, 80.0, [&random](int) { return MakeWaves(random, Side, 0.35); });
}

// Any surfaces, of different kinds and numbers of facets.
StackCase MakeMixed(StressRandom& random)
{
  return MakeSheets(random, 40.0, 90.0,
    [&random](int)
    {
      switch (random.Below(3))
      {
        case 0:
          return MakePane(random, Side);
        case 1:
          return MakeDome(random, random.Below(2) ? 1.0 : -1.0);
        default:
          return MakeWaves(random, Side, 0.35);
      }
    });
}

// Surfaces that cross each other.
StackCase MakeCrossing(StressRandom& random)
{
  return MakeSheets(random, 0.0, 6.0, [&random](int) { return MakeWaves(random, Side, 0.5); });
}

// Later surfaces that are smaller, and points on their borders and on the edges of facets.
StackCase MakeBorders(StressRandom& random)
{
  StackCase test = MakeSheets(random, 30.0, 60.0,
    [&random](int i)
    {
      const double side = i == 0 ? Side : Side * random.Uniform(0.2, 0.6);
      return random.Below(2) ? MakePane(random, side) : MakeWaves(random, side, 0.2);
    });
  test.BorderShare = 0.6;
  return test;
}

// Random heights and normals at every vertex.
StackCase MakeRough(StressRandom& random)
{
  return MakeSheets(random, 20.0, 60.0,
    [&random](int)
    {
      const int cells = 4 + random.Below(6);
      return reference::MakeRandom(Side, cells, Side / cells * Magnitude(random, -2.0, -0.7),
        Magnitude(random, -2.0, -0.5), static_cast<unsigned>(random.Bits()));
    });
}

//------------------------------------------------------------------------------
// Two caps of spheres, convex on both sides, or one of them flat or concave; sometimes a pane
// behind.
StackCase MakeLenses(StressRandom& random)
{
  StackCase test;
  test.Seed = random.Bits();
  const int shape = random.Below(4);
  const MembraneMesh first = shape == 1 ? MakePane(random, Side) : MakeDome(random, -1.0);
  const MembraneMesh second =
    shape == 2 ? MakePane(random, Side) : MakeDome(random, shape == 3 ? -1.0 : 1.0);
  AddLayer(test, random, first, 0.0, random.Uniform(1.3, 1.9));
  AddLayer(test, random, second, -random.Uniform(100.0, 220.0),
    random.Below(2) ? 1.0 : random.Uniform(1.2, 1.4));
  if (random.Below(3) == 0)
  {
    AddLayer(test, random, MakePane(random, Side), -Side * random.Uniform(1.7, 2.5),
      NextIndex(random, GetLastIndex(test)));
  }
  SetEye(test, random, 50.0);
  return test;
}

// A closed ball listed twice; the eye is outside of it or inside. Sometimes it is behind a pane.
StackCase MakeBalls(StressRandom& random)
{
  StackCase test;
  test.Seed = random.Bits();
  const bool inside = random.Below(5) == 0;
  const double radius = random.Uniform(30.0, 90.0);
  const glm::dvec3 centre(random.Uniform(-20.0, 20.0), -1.3 * radius, random.Uniform(-20.0, 20.0));
  if (!inside && random.Below(3) == 0)
  {
    AddLayer(test, random, MakePane(random, Side), 30.0, NextIndex(random, 1.0));
  }
  const bool outwards = random.Below(2) == 0;
  test.Meshes.push_back(reference::MakeSphere(centre, radius, 2 + random.Below(2), outwards));
  const double around = GetLastIndex(test);
  double glass = around;
  while (glass == around)
  {
    glass = NextIndex(random, around);
  }
  const double behind = random.Below(3) == 0 ? NextIndex(random, glass) : around;
  const auto media = [outwards](double outside, double within) {
    return outwards ? InterfaceMedia{ outside, within } : InterfaceMedia{ within, outside };
  };
  test.Layers.push_back({ test.Meshes.size() - 1, media(around, glass), outwards });
  test.Layers.push_back({ test.Meshes.size() - 1, media(behind, glass), !outwards });
  SetEye(test, random, 35.0);
  if (inside)
  {
    test.LayersBehindEye = 1;
    test.Eye = centre + 0.9 * radius * random.Uniform() * random.GetDirection();
  }
  return test;
}

// The eye between the first interface and the second one.
StackCase MakeEyesBetween(StressRandom& random)
{
  StackCase test =
    MakeSheets(random, 60.0, 90.0, [&random](int) { return MakeWaves(random, Side, 0.3); });
  test.LayersBehindEye = 1;
  test.Eye = glm::dvec3(
    random.Uniform(-40.0, 40.0), random.Uniform(-34.0, -26.0), random.Uniform(-40.0, 40.0));
  return test;
}

// Low eyes, and indices that fall: many rays are totally reflected at a later interface.
StackCase MakeCritical(StressRandom& random)
{
  StackCase test;
  test.Seed = random.Bits();
  const double indices[3] = { random.Uniform(1.2, 1.6), random.Uniform(0.7, 1.0),
    random.Uniform(0.6, 1.5) };
  double y = 0.0;
  for (const double index : indices)
  {
    AddLayer(test, random, random.Below(2) ? MakePane(random, Side) : MakeWaves(random, Side, 0.3),
      y, index);
    y -= random.Uniform(35.0, 60.0);
  }
  SetEye(test, random, 15.0);
  return test;
}

// Repeated facets, with and without their own points, facets without area, tiny ones, and corners
// that are not finite or do not exist.
void AddDirt(MembraneMesh& mesh, StressRandom& random)
{
  const auto facets = static_cast<int>(mesh.GetNumberOfFacets());
  const auto corner = [&mesh](int facet, int k)
  { return mesh.Triangles[static_cast<std::size_t>(3 * facet + k)]; };
  const auto get = [](const std::vector<double>& values, std::int64_t id)
  {
    const auto at = static_cast<std::size_t>(3 * id);
    return glm::dvec3(values[at], values[at + 1], values[at + 2]);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.AddPoint({ nan, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  const auto bad = static_cast<std::int64_t>(mesh.Points.size() / 3) - 1;
  for (int i = 0; i < std::max(1, facets / 8); ++i)
  {
    const int f = random.Below(facets);
    const std::int64_t ids[3] = { corner(f, 0), corner(f, 1), corner(f, 2) };
    switch (random.Below(5))
    {
      case 0:
        mesh.AddTriangle(ids[1], ids[2], ids[0]);
        break;
      case 1:
        mesh.AddTriangle(ids[0], ids[1], ids[1]);
        break;
      case 2:
        mesh.AddTriangle(ids[0], bad, ids[1]);
        break;
      case 3:
        mesh.AddTriangle(ids[0], ids[1], random.Below(2) ? -1 : 1000000000);
        break;
      default: // a tiny facet of its own inside of the facet, at a corner
      {
        const glm::dvec3 at = get(mesh.Points, ids[0]);
        const glm::dvec3 normal = get(mesh.Normals, ids[0]);
        const double size = Magnitude(random, -9.0, -3.0);
        mesh.AddPoint(at, normal);
        mesh.AddPoint(at + size * (get(mesh.Points, ids[1]) - at), normal);
        mesh.AddPoint(at + size * (get(mesh.Points, ids[2]) - at), normal);
        const auto last = static_cast<std::int64_t>(mesh.Points.size() / 3);
        mesh.AddTriangle(last - 3, last - 2, last - 1);
        break;
      }
    }
  }
}

StackCase MakeDirty(StressRandom& random)
{
  StackCase test = MakeMixed(random);
  for (MembraneMesh& mesh : test.Meshes)
  {
    AddDirt(mesh, random);
  }
  return test;
}

StackCase MakeOffset(StressRandom& random)
{
  StackCase test = random.Below(2) ? MakeMixed(random) : MakeBalls(random);
  test.Scale = Magnitude(random, -6.0, 6.0);
  test.Offset = test.Scale * Magnitude(random, 0.0, 6.0) * random.GetDirection();
  return test;
}

//------------------------------------------------------------------------------
MirrorCase MakeMirror(StressRandom& random, MembraneMesh mesh, double lowest)
{
  MirrorCase test;
  test.Seed = random.Bits();
  test.Mesh = std::move(mesh);
  StackCase eye;
  SetEye(eye, random, lowest);
  test.Eye = eye.Eye;
  return test;
}

MirrorCase MakePlaneMirror(StressRandom& random)
{
  return MakeMirror(random, MakePane(random, Side), 20.0);
}

MirrorCase MakeWavyMirror(StressRandom& random)
{
  return MakeMirror(random, MakeWaves(random, Side, 0.4), 30.0);
}

MirrorCase MakeDishMirror(StressRandom& random)
{
  return MakeMirror(random, MakeDome(random, 1.0), 60.0);
}

MirrorCase MakeDomeMirror(StressRandom& random)
{
  return MakeMirror(random, MakeDome(random, -1.0), 40.0);
}

// Closed balls, seen from outside or, with inner normals, from inside.
MirrorCase MakeBallMirror(StressRandom& random)
{
  const bool outwards = random.Below(2) == 0;
  const double radius = 0.5 * Side;
  MirrorCase test = MakeMirror(
    random, reference::MakeSphere(glm::dvec3(0.0), radius, 2 + random.Below(2), outwards), 20.0);
  if (!outwards)
  {
    test.Eye = 0.9 * radius * random.Uniform() * random.GetDirection();
  }
  else
  {
    test.Eye *= std::max(1.0, 1.2 * radius / glm::length(test.Eye));
  }
  return test;
}

MirrorCase MakeOffsetMirror(StressRandom& random)
{
  MirrorCase test = random.Below(2) ? MakeWavyMirror(random) : MakeBallMirror(random);
  test.Scale = Magnitude(random, -6.0, 6.0);
  test.Offset = test.Scale * Magnitude(random, 0.0, 6.0) * random.GetDirection();
  return test;
}

MirrorCase MakeDirtyMirror(StressRandom& random)
{
  MirrorCase test = MakeWavyMirror(random);
  AddDirt(test.Mesh, random);
  return test;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<StackFamily> StackFamilies()
{
  return { { "stacks of panes", 8, MakePanes }, { "stacks of waves", 8, MakeWavySheets },
    { "mixed stacks", 8, MakeMixed }, { "stacks that cross", 2, MakeCrossing },
    { "stacks with borders", 8, MakeBorders }, { "rough stacks", 8, MakeRough },
    { "lenses", 8, MakeLenses }, { "balls", 4, MakeBalls },
    { "eyes between interfaces", 8, MakeEyesBetween }, { "critical angles", 4, MakeCritical },
    { "dirty stacks", 8, MakeDirty }, { "offset and scaled stacks", 8, MakeOffset } };
}

//------------------------------------------------------------------------------
std::vector<MirrorFamily> MirrorFamilies()
{
  return { { "plane mirrors", 6, MakePlaneMirror }, { "wavy mirrors", 8, MakeWavyMirror },
    { "dish mirrors", 8, MakeDishMirror }, { "dome mirrors", 6, MakeDomeMirror },
    { "ball mirrors", 6, MakeBallMirror }, { "dirty mirrors", 6, MakeDirtyMirror },
    { "offset and scaled mirrors", 8, MakeOffsetMirror } };
}

} // namespace meniscus::test

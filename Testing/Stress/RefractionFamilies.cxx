// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackCheck.h"

namespace meniscus::test
{

namespace
{

using reference::MembraneMesh;
using reference::SmoothSurface;

const double Pi = std::acos(-1.0);
constexpr int PointsPerCase = 24;

// 10 to a random power between the two.
double Magnitude(StressRandom& random, double low, double high)
{
  return std::pow(10.0, random.Uniform(low, high));
}

//------------------------------------------------------------------------------
// Waves of several directions, with slopes of `slope` at most in all.
void AddWaves(RefractionCase& test, StressRandom& random, int count, double slope)
{
  double shortest = Side;
  for (int i = 0; i < count; ++i)
  {
    const double length = random.Uniform(30.0, 150.0);
    const double angle = random.Uniform(0.0, 2.0 * Pi);
    const double k = 2.0 * Pi / length;
    test.Surface.Waves.push_back({ slope / count * random.Uniform(0.3, 1.0) / k,
      k * std::cos(angle), k * std::sin(angle), random.Uniform(0.0, 2.0 * Pi) });
    shortest = std::min(shortest, length);
  }
  test.FacetSize = std::min(test.FacetSize, shortest / 16.0);
}

void AddHills(RefractionCase& test, StressRandom& random)
{
  const int count = 1 + random.Below(4);
  for (int i = 0; i < count; ++i)
  {
    const double k = random.Uniform(0.015, 0.04);
    // The steepest slope is 0.86 amplitude k.
    const double slope = random.Uniform(0.1, 0.8) / count * (random.Below(3) ? 1.0 : -1.0);
    test.Surface.Hills.push_back(
      { slope / k, k, random.Uniform(-60.0, 60.0), random.Uniform(-60.0, 60.0) });
    test.FacetSize = std::min(test.FacetSize, 1.0 / (8.0 * k));
  }
}

void MakeMesh(RefractionCase& test)
{
  const int cells = std::clamp(static_cast<int>(std::ceil(Side / test.FacetSize)), 6, 96);
  test.FacetSize = Side / cells;
  test.Mesh = test.Surface.MakeMesh(cells);
}

//------------------------------------------------------------------------------
RefractionCase MakeSurface(StressRandom& random, int kind)
{
  RefractionCase test;
  test.FacetSize = Side / 16;
  switch (kind)
  {
    case 0:
      AddWaves(test, random, 1 + random.Below(5), 0.5);
      break;
    case 1:
      AddHills(test, random);
      break;
    case 2:
      test.Surface.SphereRadius = Side * random.Uniform(0.8, 5.0) * (random.Below(2) ? 1.0 : -1.0);
      test.FacetSize = Side / (6 + random.Below(26));
      break;
    case 3:
      AddWaves(test, random, 16, 1.2);
      break;
    default: // flat
      break;
  }
  MakeMesh(test);
  return test;
}

// n1 / n2 from 0.3 to 3, sometimes 1.
void SetIndices(RefractionCase& test, StressRandom& random)
{
  const double ratio =
    random.Below(16) == 0 ? 1.0 : std::exp(random.Uniform(std::log(0.3), std::log(3.0)));
  test.Interior = random.Below(2) ? 1.0 : random.Uniform(0.5, 2.0);
  test.Exterior = test.Interior * ratio;
}

glm::dvec3 RandomSight(const RefractionCase& test, StressRandom& random)
{
  return test.Surface.GetPoint(
    random.Uniform(-0.5 * Side, 0.5 * Side), random.Uniform(-0.5 * Side, 0.5 * Side));
}

// Elevation in degrees.
void SetEye(RefractionCase& test, StressRandom& random, double low, double high, double distance)
{
  const double elevation = random.Uniform(low, high) * Pi / 180.0;
  const double angle = random.Uniform(0.0, 2.0 * Pi);
  test.Eye = 0.3 * RandomSight(test, random) +
    distance *
      glm::dvec3(std::cos(elevation) * std::cos(angle), std::sin(elevation),
        std::cos(elevation) * std::sin(angle));
}

// A point at `length` behind `sight` on the refracted ray; a random place below if there is none.
glm::dvec3 PointBehind(
  const RefractionCase& test, StressRandom& random, const glm::dvec3& sight, double length)
{
  const auto ray = test.Surface.Refract(test.Eye, sight, test.Exterior / test.Interior);
  if (ray)
  {
    return sight + length * *ray;
  }
  return sight + length * glm::dvec3(random.Uniform(-1.0, 1.0), -1.0, random.Uniform(-1.0, 1.0));
}

void AddPoints(RefractionCase& test, StressRandom& random, double low, double high)
{
  for (int i = 0; i < PointsPerCase; ++i)
  {
    const double length = Side * Magnitude(random, low, high);
    if (random.Below(4) == 0)
    {
      test.Points.push_back(RandomSight(test, random) - glm::dvec3(0.0, length, 0.0));
    }
    else
    {
      test.Points.push_back(PointBehind(test, random, RandomSight(test, random), length));
    }
  }
}

RefractionCase MakeOrdinary(StressRandom& random, int kind)
{
  RefractionCase test = MakeSurface(random, kind);
  SetIndices(test, random);
  SetEye(test, random, 20.0, 90.0, Side * Magnitude(random, 0.0, 1.0));
  AddPoints(test, random, -2.0, 0.5);
  return test;
}

//------------------------------------------------------------------------------
RefractionCase MakeFar(StressRandom& random)
{
  RefractionCase test = MakeSurface(random, random.Below(5));
  SetIndices(test, random);
  SetEye(test, random, 15.0, 90.0, 0.5 * Side * Magnitude(random, 0.0, 4.0));
  AddPoints(test, random, -1.0, 3.7);
  return test;
}

// The eye at a distance of a thousandth of a facet to one facet.
RefractionCase MakeNearEye(StressRandom& random)
{
  RefractionCase test = MakeSurface(random, 2 + 2 * random.Below(2));
  SetIndices(test, random);
  const double height = test.FacetSize * Magnitude(random, -3.0, 0.0);
  const glm::dvec3 foot = 0.9 * RandomSight(test, random);
  const glm::dvec3 below = test.Surface.GetPoint(foot.x, foot.z);
  test.Eye = below + height * test.Surface.GetNormal(foot.x, foot.z);
  for (int i = 0; i < PointsPerCase; ++i)
  {
    const double away = std::min(height * Magnitude(random, -1.0, 1.5), 0.25 * Side);
    const double angle = random.Uniform(0.0, 2.0 * Pi);
    const glm::dvec3 sight =
      test.Surface.GetPoint(below.x + away * std::cos(angle), below.z + away * std::sin(angle));
    test.Points.push_back(PointBehind(test, random, sight, height * Magnitude(random, -1.0, 3.0)));
  }
  return test;
}

RefractionCase MakeGrazing(StressRandom& random)
{
  RefractionCase test = MakeSurface(random, random.Below(5));
  SetIndices(test, random);
  SetEye(test, random, 0.2, 8.0, Side * Magnitude(random, 0.0, 1.0));
  AddPoints(test, random, -2.0, 0.3);
  return test;
}

// Points on the membrane, down to 1e-6 of a facet below it, and above it.
RefractionCase MakeNearObject(StressRandom& random)
{
  RefractionCase test = MakeSurface(random, random.Below(5));
  SetIndices(test, random);
  SetEye(test, random, 20.0, 90.0, Side * Magnitude(random, 0.0, 1.0));
  for (int i = 0; i < PointsPerCase; ++i)
  {
    const glm::dvec3 sight = RandomSight(test, random);
    const double length = test.FacetSize * Magnitude(random, -6.0, 0.0);
    const int where = random.Below(8);
    test.Points.push_back(where == 0 ? sight
        : where == 1                 ? sight + glm::dvec3(0.0, length, 0.0)
                                     : PointBehind(test, random, sight, length));
  }
  return test;
}

RefractionCase MakeOffset(StressRandom& random)
{
  RefractionCase test = MakeOrdinary(random, random.Below(5));
  test.Scale = Magnitude(random, -6.0, 6.0);
  test.Offset = test.Scale * Magnitude(random, 0.0, 7.0) * random.GetDirection();
  return test;
}

//------------------------------------------------------------------------------
// A valid mesh with facets that add nothing: repeated ones, with or without their own points, ones
// without area, with corners that are not finite or do not exist; all in another order.
RefractionCase MakeDirty(StressRandom& random)
{
  RefractionCase test = MakeOrdinary(random, random.Below(5));
  test.Layers = 3;
  MembraneMesh& mesh = test.Mesh;
  const auto facets = static_cast<int>(mesh.GetNumberOfFacets());
  const auto corner = [&mesh](int facet, int k)
  { return mesh.Triangles[static_cast<std::size_t>(3 * facet + k)]; };
  const auto addCopy = [&mesh](std::int64_t id)
  {
    const auto at = static_cast<std::size_t>(3 * id);
    mesh.AddPoint({ mesh.Points[at], mesh.Points[at + 1], mesh.Points[at + 2] },
      { mesh.Normals[at], mesh.Normals[at + 1], mesh.Normals[at + 2] });
    return static_cast<std::int64_t>(mesh.Points.size() / 3) - 1;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.AddPoint({ nan, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  const auto bad = static_cast<std::int64_t>(mesh.Points.size() / 3) - 1;
  for (int i = 0; i < facets / 8; ++i)
  {
    const int f = random.Below(facets);
    switch (random.Below(6))
    {
      case 0:
        mesh.AddTriangle(corner(f, 1), corner(f, 2), corner(f, 0));
        break;
      case 1:
        mesh.AddTriangle(corner(f, 0), corner(f, 1), corner(f, 1));
        break;
      case 2:
        mesh.AddTriangle(corner(f, 0), corner(f, 1), addCopy(corner(f, 1)));
        break;
      case 3:
        mesh.AddTriangle(corner(f, 0), bad, corner(f, 1));
        break;
      case 4:
        mesh.AddTriangle(corner(f, 0), corner(f, 1), random.Below(2) ? -1 : 1000000000);
        break;
      default:
      {
        const std::int64_t a = addCopy(corner(f, 0));
        const std::int64_t b = addCopy(corner(f, 1));
        mesh.AddTriangle(a, b, addCopy(corner(f, 2)));
        break;
      }
    }
  }
  for (std::size_t i = mesh.GetNumberOfFacets(); i > 1; --i)
  {
    const auto j = static_cast<std::size_t>(random.Below(static_cast<int>(i)));
    std::swap_ranges(mesh.Triangles.begin() + static_cast<std::ptrdiff_t>(3 * (i - 1)),
      mesh.Triangles.begin() + static_cast<std::ptrdiff_t>(3 * i),
      mesh.Triangles.begin() + static_cast<std::ptrdiff_t>(3 * j));
  }
  return test;
}

// Membranes without a tenth of their facets, in some cases a connected tenth.
RefractionCase MakeHoles(StressRandom& random)
{
  RefractionCase test = MakeOrdinary(random, random.Below(5));
  MembraneMesh& mesh = test.Mesh;
  const bool inOnePiece = random.Below(2) == 0;
  const glm::dvec3 middle = 0.7 * RandomSight(test, random);
  std::vector<std::int64_t> kept;
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    std::array<glm::dvec2, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto at = static_cast<std::size_t>(3 * mesh.Triangles[i + k]);
      corners[k] = glm::dvec2(mesh.Points[at], mesh.Points[at + 2]);
    }
    const bool drop = inOnePiece
      ? glm::length(corners[0] - glm::dvec2(middle.x, middle.z)) < 0.18 * Side
      : random.Below(10) == 0;
    if (drop)
    {
      test.Holes.push_back(corners);
    }
    else
    {
      kept.insert(kept.end(), { mesh.Triangles[i], mesh.Triangles[i + 1], mesh.Triangles[i + 2] });
    }
  }
  mesh.Triangles = kept;
  return test;
}

//------------------------------------------------------------------------------
// For surfaces that are their own reference: points in a box below, and eyes above.
void LookFromAbove(RefractionCase& test, StressRandom& random)
{
  test.Truth = RefractionTruth::Patches;
  SetIndices(test, random);
  SetEye(test, random, 20.0, 90.0, Side * Magnitude(random, 0.0, 1.0));
  for (int i = 0; i < PointsPerCase; ++i)
  {
    test.Points.emplace_back(random.Uniform(-80.0, 80.0), -Side * Magnitude(random, -1.0, 0.3),
      random.Uniform(-80.0, 80.0));
  }
}

// Random heights and normals at every vertex.
RefractionCase MakeRough(StressRandom& random)
{
  RefractionCase test;
  const int cells = 4 + random.Below(7);
  test.FacetSize = Side / cells;
  test.Mesh = reference::MakeRandom(Side, cells, test.FacetSize * Magnitude(random, -2.0, 0.0),
    Magnitude(random, -2.0, 0.3), static_cast<unsigned>(random.Bits()));
  LookFromAbove(test, random);
  return test;
}

// A sheet that overhangs: x swings back along it.
RefractionCase MakeFolded(StressRandom& random)
{
  RefractionCase test;
  const int cells = 8 + random.Below(6);
  test.FacetSize = Side / cells;
  test.Mesh = reference::MakeSquare(Side, cells, 0.0);
  const double k = 2.0 * Pi * random.Uniform(1.0, 2.0) / Side;
  const double swing = random.Uniform(0.5, 1.6) / k; // above 1 / k it overhangs
  const double height = random.Uniform(0.3, 1.5) / k;
  MembraneMesh& mesh = test.Mesh;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    const double u = mesh.Points[i];
    mesh.Points[i] = u + swing * std::sin(2.0 * k * u) * 0.5;
    mesh.Points[i + 1] = height * std::sin(k * u);
    const glm::dvec3 along(
      1.0 + swing * k * std::cos(2.0 * k * u), height * k * std::cos(k * u), 0.0);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-along.y, along.x, 0.0));
    std::copy(&normal.x, &normal.x + 3, mesh.Normals.begin() + static_cast<std::ptrdiff_t>(i));
  }
  LookFromAbove(test, random);
  return test;
}

// Fins on edges of a wavy sheet: three and four facets meet there.
RefractionCase MakeNonManifold(StressRandom& random)
{
  RefractionCase test;
  AddWaves(test, random, 2, 0.4);
  test.FacetSize = Side / 10;
  MakeMesh(test);
  MembraneMesh& mesh = test.Mesh;
  const std::size_t facets = mesh.GetNumberOfFacets();
  for (int i = 0; i < 40; ++i)
  {
    const auto f = static_cast<std::size_t>(random.Below(static_cast<int>(facets)));
    const std::int64_t a = mesh.Triangles[3 * f];
    const std::int64_t b = mesh.Triangles[3 * f + 1];
    const auto at = static_cast<std::size_t>(3 * a);
    const glm::dvec3 tip = glm::dvec3(mesh.Points[at], mesh.Points[at + 1], mesh.Points[at + 2]) +
      test.FacetSize *
        glm::dvec3(random.Uniform(-1.0, 1.0), random.Uniform(-0.5, 0.5), random.Uniform(-1.0, 1.0));
    mesh.AddPoint(tip, test.Surface.GetNormal(tip.x, tip.z));
    mesh.AddTriangle(a, b, static_cast<std::int64_t>(mesh.Points.size() / 3) - 1);
  }
  LookFromAbove(test, random);
  return test;
}

//------------------------------------------------------------------------------
// Triangles of all sizes, some of them large relative to the membrane, none of which crosses it.
RefractionCase MakeTriangles(StressRandom& random)
{
  RefractionCase test = MakeSurface(random, random.Below(5));
  SetIndices(test, random);
  SetEye(test, random, 30.0, 90.0, Side * Magnitude(random, 0.0, 0.7));
  for (int i = 0; i < 6; ++i)
  {
    const double depth = Side * Magnitude(random, -0.6, 0.2);
    const glm::dvec3 middle =
      PointBehind(test, random, 0.8 * RandomSight(test, random), depth) - glm::dvec3(0, 40, 0);
    const double size = std::min(Side * Magnitude(random, -1.7, 0.0), 0.6 * (-30.0 - middle.y));
    std::array<glm::dvec3, 3> triangle;
    for (glm::dvec3& corner : triangle)
    {
      corner = middle + size * random.GetDirection();
    }
    if (size > 0.0)
    {
      test.Triangles.push_back(triangle);
    }
  }
  return test;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<RefractionFamily> RefractionFamilies(double intensity, std::uint64_t seed)
{
  std::vector<RefractionFamily> families;
  const auto addCheck = [&](const std::string& name, double cases,
                          const std::function<RefractionTally(StressRandom&)>& check)
  {
    // Every case has its own random stream, so that it can be run alone.
    const std::uint64_t stream = seed + 0x1000003u * (families.size() + 1);
    families.push_back({ name, std::max(1, static_cast<int>(std::lround(cases * intensity))),
      [stream, check](int index)
      {
        StressRandom random(stream * 0x2545f4914f6cdd1du + static_cast<std::uint64_t>(index));
        return check(random);
      } });
  };
  const auto add = [&addCheck](const std::string& name, double cases,
                     const std::function<RefractionCase(StressRandom&)>& make)
  { addCheck(name, cases, [make](StressRandom& random) { return CheckCase(make(random)); }); };
  add("waves", 12, [](StressRandom& random) { return MakeOrdinary(random, 0); });
  add("domes", 12, [](StressRandom& random) { return MakeOrdinary(random, 1); });
  add("bowls", 12, [](StressRandom& random) { return MakeOrdinary(random, 2); });
  add("noise", 4, [](StressRandom& random) { return MakeOrdinary(random, 3); });
  add("flat", 8, [](StressRandom& random) { return MakeOrdinary(random, 4); });
  add("far eyes and objects", 16, MakeFar);
  add("near eyes", 16, MakeNearEye);
  add("grazing eyes", 16, MakeGrazing);
  add("near objects", 12, MakeNearObject);
  add("offset and scaled", 12, MakeOffset);
  add("dirty meshes", 12, MakeDirty);
  add("holes", 12, MakeHoles);
  add("rough", 12, MakeRough);
  add("folded", 12, MakeFolded);
  add("non-manifold", 12, MakeNonManifold);
  add("triangles", 12, MakeTriangles);
  for (const StackFamily& family : StackFamilies())
  {
    addCheck(family.Name, family.Cases,
      [make = family.Make](StressRandom& random) { return CheckStack(make(random)); });
  }
  for (const MirrorFamily& family : MirrorFamilies())
  {
    addCheck(family.Name, family.Cases,
      [make = family.Make](StressRandom& random) { return CheckMirror(make(random)); });
  }
  return families;
}

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Spherical surfaces with slivers around a pole and without normals: pictures with the normals that
// the library computes next to rays that are traced through the exact spheres.
#include "BoardScene.h"
#include "StackPicture.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;

constexpr double Glass = 1.52;
constexpr int Rings = 47;
constexpr int Sectors = 96;
const double Pi = std::acos(-1.0);

// A cap around the pole of a sphere as vtkSphereSource makes it, 8,928 facets: its edges along the
// meridians are up to 47 times as long as those along the circles. `side` is +1 for the upper pole,
// -1 for the lower one; `front` is +1 if the eye is outside of the sphere.
MembraneMesh MakePolarCap(
  const glm::dvec3& centre, double radius, double width, double side, double front)
{
  MembraneMesh mesh;
  const double widest = std::asin(0.5 * width / radius);
  const auto add = [&](double polar, double around)
  {
    const glm::dvec3 normal(std::sin(polar) * std::cos(around), side * std::cos(polar),
      std::sin(polar) * std::sin(around));
    mesh.AddPoint(centre + radius * normal, front * normal);
  };
  const auto addTriangle = [&](std::int64_t a, std::int64_t b, std::int64_t c)
  {
    const bool isTurned = side * front > 0.0;
    mesh.AddTriangle(a, isTurned ? c : b, isTurned ? b : c);
  };
  add(0.0, 0.0);
  for (int ring = 1; ring <= Rings; ++ring)
  {
    for (int sector = 0; sector < Sectors; ++sector)
    {
      add(widest * ring / Rings, 2.0 * Pi * sector / Sectors);
    }
  }
  const auto number = [](int ring, int sector) -> std::int64_t
  { return 1 + (ring - 1) * Sectors + sector % Sectors; };
  for (int sector = 0; sector < Sectors; ++sector)
  {
    addTriangle(0, number(1, sector), number(1, sector + 1));
    for (int ring = 1; ring < Rings; ++ring)
    {
      addTriangle(number(ring, sector), number(ring + 1, sector), number(ring + 1, sector + 1));
      addTriangle(number(ring, sector), number(ring + 1, sector + 1), number(ring, sector + 1));
    }
  }
  return mesh;
}

/** Part of the covered pixels that show another place, or are covered in one picture only. */
double Measure(const char* name, vtkRefractedGeometryFilter* filter, const PixelCamera& camera,
  const PlacePicture& traced)
{
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 0) << messages->Text;
  const PlaceComparison compared =
    ComparePlaces(traced, DrawPlaces(filter->GetOutput(), camera), camera);
  EXPECT_GT(compared.Covered, camera.GetPixels() * camera.GetPixels() / 20) << name;
  const double part = static_cast<double>(compared.Coverage + compared.Place) / compared.Covered;
  std::printf("%s: %d pixels, %d differ in coverage, %d in place, %.3f %%\n", name,
    compared.Covered, compared.Coverage, compared.Place, 100.0 * part);
  return part;
}

}

//------------------------------------------------------------------------------
TEST(NormalsInPixels, DomeAndLens)
{
  constexpr double width = 40.0;
  constexpr double size = 20.0;
  const glm::dvec3 upper(0.0, -52.0, 0.0);
  const glm::dvec3 lower(0.0, 72.0, 0.0);
  const ExactSurface in{ 1.0, Glass, upper, 60.0 };
  const ExactSurface out{ Glass, 1.0, lower, 80.0, glm::dvec3(0.0), true };
  const MembraneMesh front = MakePolarCap(upper, 60.0, width, 1.0, 1.0);
  const MembraneMesh back = MakePolarCap(lower, 80.0, width, -1.0, -1.0);
  const PixelCamera camera({ 2.0, 150.0, 1.0 }, glm::dvec3(0.0), 0.1, 256);
  struct Case
  {
    const char* Name;
    StackPicture View;
    std::vector<ExactSurface> Exact;
    double Most; ///< part of the pixels; nearly as much as with exact normals
  };
  const Case cases[] = { { "dome", { "dome", { front }, { { 1.0, Glass } }, camera }, { in },
                           2.8e-4 },
    { "lens", { "lens", { front, back }, { { 1.0, Glass }, { Glass, 1.0 } }, camera }, { in, out },
      3e-4 } };
  const auto object = MakeGrid(13, size, -40.0);
  AddPlaces(object);
  for (const Case& one : cases)
  {
    const PlacePicture traced =
      TraceRays(camera, MakeExactRays(one.Exact, camera.GetEye(), MakeRoundOutline(0.5 * width)),
        MakeSquareTracer(-40.0, size));
    for (const bool hasNormals : { true, false })
    {
      StackPicture view = one.View;
      view.HasNormals = hasNormals;
      EXPECT_LE(Measure(one.Name, view.MakeFilter(object, true), camera, traced), one.Most)
        << one.Name << (hasNormals ? " with normals" : " without normals");
    }
  }
}

//------------------------------------------------------------------------------
TEST(NormalsInPixels, ConcaveMirror)
{
  constexpr double radius = 100.0;
  constexpr double width = 100.0;
  constexpr double size = 30.0;
  const glm::dvec3 centre(0.0, radius, 0.0);
  const MembraneMesh dish = MakePolarCap(centre, radius, width, -1.0, -1.0);
  const PixelCamera camera({ 3.0, 220.0, 2.0 }, glm::dvec3(0.0), 0.15, 256);
  const glm::dvec3 eye = camera.GetEye();
  const auto rays = [&](const glm::dvec3& direction) -> std::optional<LastLeg>
  {
    const double middle = glm::dot(centre - eye, direction);
    const glm::dvec3 nearest = eye + middle * direction - centre;
    const double half = std::sqrt(radius * radius - glm::dot(nearest, nearest));
    const glm::dvec3 place = eye + (middle + half) * direction;
    if (std::hypot(place.x, place.z) > 0.5 * width)
    {
      return std::nullopt;
    }
    const glm::dvec3 normal = (centre - place) / radius;
    return LastLeg{ place, direction - 2.0 * glm::dot(direction, normal) * normal };
  };
  const auto object = MakeGrid(13, size, 35.0);
  AddPlaces(object);
  const PlacePicture traced = TraceRays(camera, rays, MakeSquareTracer(35.0, size));
  for (const bool hasNormals : { true, false })
  {
    const auto filter = MakeFilter(object, MakeMembrane(dish, hasNormals));
    filter->SetMembraneModelToCurved();
    filter->SetImagesToAllImages();
    filter->SetModeToReflection();
    filter->SetAngularTolerance(0.001); // a hundredth of a pixel: the object's sides run along rows
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    filter->SetEyePosition(eye.x, eye.y, eye.z);
    EXPECT_LE(Measure("concave mirror", filter, camera, traced), 3.5e-4)
      << (hasNormals ? " with normals" : " without normals");
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Errors of virtual vertices against patches as the exact surface.
#include "MembraneMeshes.h"
#include "Refraction/Membrane/Optics.h"
#include "Refraction/Stack/ErrorSamples.h"
#include "RefractionTestRandom.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using meniscus::test::Random;

constexpr double Water = 1.333;

/** The first intersection of a ray with the unit sphere. */
std::optional<glm::dvec3> MeetUnitSphere(const glm::dvec3& eye, const glm::dvec3& direction)
{
  const double nearest = -glm::dot(eye, direction);
  const glm::dvec3 across = eye + nearest * direction;
  const double squared = 1.0 - glm::dot(across, across);
  return squared > 0.0 ? std::optional(across - std::sqrt(squared) * direction) : std::nullopt;
}

/** Largest distance of a mesh's patches and their normals from the unit sphere. */
struct SphereDeviation
{
  double Position = 0.0;
  double Normal = 0.0;

  explicit SphereDeviation(const meniscus::RefractingSurface& geometry)
  {
    constexpr int parts = 8;
    const auto count = static_cast<std::int32_t>(geometry.GetMembrane().GetFacets().size());
    for (std::int32_t facet = 0; facet < count; ++facet)
    {
      const meniscus::CurvedPatch patch = geometry.GetPatches().GetPatch(facet);
      for (int i = 0; i <= parts; ++i)
      {
        for (int j = 0; i + j <= parts; ++j)
        {
          const PatchPoint at =
            patch.Evaluate({ static_cast<double>(i) / parts, static_cast<double>(j) / parts });
          const glm::dvec3 place = at.Position + geometry.GetMembrane().GetOrigin();
          this->Position = std::max(this->Position, std::fabs(glm::length(place) - 1.0));
          this->Normal =
            std::max(this->Normal, glm::length(glm::normalize(at.Normal) - glm::normalize(place)));
        }
      }
    }
  }
};

//------------------------------------------------------------------------------
// The sight rays of a sphere of radius 0.99 meet the unit sphere around it, at up to 82 degrees to
// its normal. All samples therefore have an exact point, on every mesh of the unit sphere.
TEST(ErrorSamples, NearlyTangentialRaysMeetTheExactSphere)
{
  const glm::dvec3 eye(2.1, 0.7, 1.3);
  MembraneMesh inner = MakeSphere(64, 1.0);
  std::for_each(inner.Points.begin(), inner.Points.end(), [](double& x) { x *= 0.99; });
  CurvedMembraneSolver approximate;
  approximate.SetMembrane(inner.AsInput());
  approximate.SetEye(eye, 1.0, Water);
  for (const int resolution : { 12, 16, 24, 48 })
  {
    const auto sphere = std::make_shared<meniscus::RefractingSurface>();
    sphere->SetMembrane(MakeSphere(resolution, 1.0).AsInput(), meniscus::SurfaceParts::Crossings);
    meniscus::RefractionStack reference;
    reference.SetInterfaces({ { sphere, { 1.0, Water } } });
    reference.SetEye(eye);
    const SphereDeviation deviation(*sphere);
    const meniscus::StackPatches exact(reference.GetLinks(), reference.GetOrigin());
    const meniscus::ErrorSampler sampler(eye, reference.GetLinks(), exact);
    Random random(static_cast<unsigned>(resolution));
    int measured = 0;
    int tangential = 0;
    for (int i = 0; i < 20000; ++i)
    {
      const glm::dvec3 point = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
      std::vector<VirtualVertex> images;
      if (glm::length(point) > 0.9 ||
        approximate.FindImages(point, images) != meniscus::ImageState::Found || images.size() != 1)
      {
        continue;
      }
      const meniscus::ErrorSample sample = sampler.Measure(approximate, point);
      ASSERT_EQ(sample.State, meniscus::SampleState::Measured)
        << resolution << ": " << point.x << " " << point.y << " " << point.z;
      ++measured;
      const glm::dvec3 direction = glm::normalize(images[0].Position - eye);
      const auto at = MeetUnitSphere(eye, direction);
      ASSERT_TRUE(at.has_value());
      const double depth = Water * glm::dot(images[0].Position - *at, direction);
      const double cosine = -glm::dot(*at, direction);
      const double error = glm::length(*at +
        depth * meniscus::ComputeRefractionRay(direction, *at, 1.0 / Water).Direction - point);
      // The distance of the patches, along the ray, moves its start and end and changes the length
      // in the ball, at most 2. Refracted directions change by less than normals, whose change
      // includes that of the place.
      const double moved = deviation.Position / cosine;
      const double bound = (1.0 + Water) * moved + 2.0 * Water * (deviation.Normal + moved);
      tangential += cosine < 0.2;
      ASSERT_NEAR(sample.Error, error, bound) << resolution << " " << cosine;
    }
    EXPECT_GT(measured, 4000);
    EXPECT_GT(tangential, 20);
  }
}

}

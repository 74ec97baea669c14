// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Shadows through waves, compared with rays and photons through the exact waves.
#include "WavePool.h"

using namespace meniscus::test;
using namespace meniscus::test::wavepool;

namespace
{

const Ball ShadingBall{ { 4.0, -45.0, -6.0 }, 14.0 };

/** A pool with a ball that casts a shadow. */
class ShadedPool : public WavePool
{
public:
  ShadedPool(const HeightField& waves, int pixels)
    : WavePool(waves, pixels)
  {
    vtkNew<vtkSphereSource> source;
    const glm::dvec3& middle = ShadingBall.Middle;
    source->SetCenter(middle.x, middle.y, middle.z);
    source->SetRadius(ShadingBall.Radius);
    source->SetThetaResolution(200);
    source->SetPhiResolution(101);
    vtkNew<vtkRefractedGeometryFilter> filter;
    filter->SetInputConnection(source->GetOutputPort());
    filter->SetMembraneData(this->Surface);
    filter->SetInteriorIndexOfRefraction(Water);
    filter->SetCamera(this->GetRenderer()->GetActiveCamera());
    filter->TrueGeometryOn();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(filter->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetProperty(this->Floor->GetProperty());
    this->Pass->AddRefraction(this->Membrane, actor, filter);
    this->Pass->ShadowsOn();
  }

  /** True if a pixel shows the floor, and not the ball or its edge. */
  bool ShowsFloor(int x, int y) const
  {
    const Ray ray = this->RayOf(x, y);
    return !ShadingBall.IsMet(ray.Start, ray.Along, 1.1 * ShadingBall.Radius);
  }
};

/**
 * The only way of the sun's light to a place below waves that focus it deeper, by steps to the
 * place on the water from which the ray there leads to.
 */
glm::dvec3 WayOfSun(const WavePool& pool, const glm::dvec3& sun, const glm::dvec3& place)
{
  glm::dvec3 water = place + AboveOf(sun) + glm::dvec3(0.0, Depth, 0.0);
  glm::dvec3 along(0.0);
  for (int i = 0; i < 60; ++i)
  {
    water.y = pool.Waves.GetHeight(water.x, water.z);
    along = *pool.Waves.Refract(water + 1e6 * sun, water, 1.0) - water;
    water = place + (water.y - place.y) / along.y * along;
  }
  return along;
}

} // anonymous namespace

/** Pixels of the floor against rays in double precision: the light is blocked or as without. */
TEST(RefractionPassWavesShadow, ABallHidesTheRaysThatItMeets)
{
  for (const double degrees : { 35.0, 60.0 })
  {
    SCOPED_TRACE(degrees);
    const glm::dvec3 sun = SunAt(degrees);
    ShadedPool pool(MakeWaves(0.3), 300);
    pool.AddLight(sun, 0.3, true);
    const ByteImage image = pool.Render();
    pool.Pass->ShadowsOff();
    const ByteImage plain = pool.Render();
    int off = 0;
    int dark = 0;
    int seen = 0;
    for (const auto& [y, x] : Product(pool.Pixels, pool.Pixels))
    {
      const glm::dvec3 place = pool.PlaceOf(x, y);
      if (pool.ShowsFloor(x, y) && std::max(std::fabs(place.x), std::fabs(place.z)) < Half - 1.0)
      {
        const bool isHidden =
          ShadingBall.IsMet(place, WayOfSun(pool, sun, place), ShadingBall.Radius);
        const int right = isHidden ? 0 : plain.GetPixel(x, y)[0];
        off += image.GetPixel(x, y)[0] != right ? 1 : 0;
        dark += isHidden ? 1 : 0;
        ++seen;
      }
    }
    RecordProperty("off " + std::to_string(degrees), off);
    RecordProperty("dark " + std::to_string(degrees), dark);
    RecordProperty("seen " + std::to_string(degrees), seen);
    EXPECT_GT(dark, 1200);
    EXPECT_LT(off, 0.001 * seen);
  }
}

/**
 * The share of the light that the ball lets pass, on cells of the floor, against photons that it
 * stops: below waves that focus the light below the floor, and above it, where light arrives on
 * several ways.
 */
TEST(RefractionPassWavesShadow, TheBallStopsTheShareOfPhotons)
{
  for (const double k : { 0.04, 0.12 })
  {
    const glm::dvec3 sun = SunAt(45.0);
    constexpr double intensity = 0.1;
    ShadedPool pool(MakeWaves(0.3, k), 600);
    pool.AddLight(sun, intensity, true);
    const auto draw = [&pool](bool hasShadows)
    {
      pool.Pass->SetShadows(hasShadows);
      const ByteImage image = pool.Render();
      Bins bins(pool.Middle);
      for (const auto& [y, x] : Product(pool.Pixels, pool.Pixels))
      {
        if (pool.ShowsFloor(x, y))
        {
          bins.Add(pool.PlaceOf(x, y), image.GetPixel(x, y)[0] / 255.0 / intensity);
        }
      }
      return bins;
    };
    const Bins drawn = draw(true);
    const Bins drawnPlain = draw(false);
    const Bins truth = ShinePhotons(pool, sun, AboveOf(sun), 1000000, &ShadingBall);
    const Bins truthPlain = ShinePhotons(pool, sun, AboveOf(sun), 1000000);
    int cells = 0;
    int shaded = 0;
    int off = 0;
    double stopped = 0.0;
    double stoppedTruth = 0.0;
    for (std::size_t i = 0; i < truth.Values.size(); ++i)
    {
      if (drawn.Counts[i] >= 4 && truthPlain.Values[i] > 0.0 && drawnPlain.Values[i] > 0.0)
      {
        const double share = drawn.Values[i] / drawnPlain.Values[i];
        const double right = truth.Values[i] / truthPlain.Values[i];
        ++cells;
        shaded += right < 0.9 ? 1 : 0;
        off += std::fabs(share - right) > 0.25 ? 1 : 0;
        stopped += (1.0 - share) * truthPlain.Values[i];
        stoppedTruth += (1.0 - right) * truthPlain.Values[i];
      }
    }
    const bool isFolded = k > 0.1;
    RecordProperty("off " + std::to_string(k), off);
    RecordProperty("stopped " + std::to_string(k), std::to_string(stopped / stoppedTruth));
    EXPECT_GT(shaded, 500);
    EXPECT_LE(off, isFolded ? cells / 300 : 0);
    EXPECT_NEAR(stopped / stoppedTruth, 1.0, isFolded ? 0.2 : 0.01);
  }
}

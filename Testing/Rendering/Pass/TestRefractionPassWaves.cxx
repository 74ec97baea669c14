// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lighting in true space behind waves: pictures of a floor compared with photons through exact
// waves, and waves without height compared with flat water.
#include "RefractionPicture.h"
#include "VTKTestBasics.h"
#include "VolumeScene.h"

#include <vtkAppendFilter.h>
#include <vtkParametricFunctionSource.h>
#include <vtkParametricTorus.h>
#include <vtkPolyDataNormals.h>
#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkRefractionPass.h>
#include <vtkSphereSource.h>
#include <vtkStripper.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>

using namespace meniscus::test;
using meniscus::reference::HeightField;

namespace
{

constexpr double Water = 1.333;
constexpr double Depth = 80.0;
constexpr double Half = 50.0; ///< of the floor
constexpr double EyeHeight = 260.0;
constexpr double ViewAngle = 24.0;

HeightField MakeWaves(double slope, double k = 0.04)
{
  HeightField waves;
  waves.Side = 400.0;
  waves.K = k;
  waves.Amplitude = slope / waves.K;
  waves.Interior = Water;
  return waves;
}

double TransmittanceOf(double cosine, double before, double behind)
{
  const double inner = std::sqrt(1.0 - (1.0 - cosine * cosine) * std::pow(before / behind, 2.0));
  const double s = (before * cosine - behind * inner) / (before * cosine + behind * inner);
  const double p = (behind * cosine - before * inner) / (behind * cosine + before * inner);
  return 1.0 - 0.5 * (s * s + p * p);
}

struct Ray
{
  glm::dvec3 Start;
  glm::dvec3 Along; ///< unit vector

  glm::dvec3 At(double distance) const { return this->Start + distance * this->Along; }
};

/** A square floor under waves, seen from above. The sun's rays reach it through the waves. */
class WavePool
{
public:
  WavePool(const HeightField& waves, int pixels, const glm::dvec3& middle = { 0.0, -Depth, 0.0 })
    : Waves(waves)
    , Middle(middle)
    , Pixels(pixels)
    , Surface(MakeMembrane(waves.MakeMesh(128)))
    , Scene(pixels, pixels)
  {
    this->Plane->SetOrigin(middle.x - Half, middle.y, middle.z - Half);
    this->Plane->SetPoint1(middle.x - Half, middle.y, middle.z + Half);
    this->Plane->SetPoint2(middle.x + Half, middle.y, middle.z - Half);
    this->Plane->SetResolution(3, 3);
    this->Filter->SetInputConnection(this->Plane->GetOutputPort());
    this->Filter->SetMembraneData(this->Surface);
    this->Filter->SetInteriorIndexOfRefraction(Water);
    this->Filter->TrueGeometryOn();
    vtkRenderer* renderer = this->Scene.GetRenderer();
    this->Filter->SetCamera(renderer->GetActiveCamera());
    vtkNew<vtkPolyDataMapper> water;
    water->SetInputData(this->Surface);
    this->Membrane->SetMapper(water);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(this->Filter->GetOutputPort());
    this->Floor->SetMapper(mapper);
    vtkProperty* property = this->Floor->GetProperty();
    property->SetAmbient(0.0);
    property->SetDiffuse(1.0);
    property->SetSpecular(0.0);
    this->Pass->AddRefraction(this->Membrane, this->Floor, this->Filter);
    this->Pass->SetReflectanceModel(vtkRefractionPass::NONE);
    this->Pass->SetLighting(vtkRefractionPass::TRUE_SPACE);
    renderer->SetPass(this->Pass);
    renderer->SetAutomaticLightCreation(false);
    this->LookFrom(middle.x, middle.z);
  }

  vtkRenderer* GetRenderer() { return this->Scene.GetRenderer(); }

  void LookFrom(double x, double z)
  {
    vtkCamera* camera = this->GetRenderer()->GetActiveCamera();
    camera->SetPosition(x, EyeHeight, z);
    camera->SetFocalPoint(this->Middle.x, 0.0, this->Middle.z);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(ViewAngle);
    camera->SetClippingRange(100.0, 600.0);
  }

  vtkSmartPointer<vtkLight> AddLight(const glm::dvec3& place, double intensity, bool isDistant)
  {
    auto light = vtkSmartPointer<vtkLight>::New();
    light->SetLightTypeToSceneLight();
    light->SetPositional(!isDistant);
    light->SetConeAngle(90.0);
    light->SetPosition(place.x, place.y, place.z);
    light->SetFocalPoint(
      isDistant ? 0.0 : place.x, isDistant ? 0.0 : place.y - 1.0, isDistant ? 0.0 : place.z);
    light->SetIntensity(intensity);
    this->GetRenderer()->AddLight(light);
    return light;
  }

  ByteImage Render()
  {
    this->Scene.GetWindow()->Render();
    return meniscus::test::ReadBytes(this->Scene.GetWindow());
  }

  /** Ray behind the waves that a pixel shows, by the exact waves. */
  Ray RayOf(int x, int y) const
  {
    const double scale =
      std::tan(vtkMath::RadiansFromDegrees(0.5 * ViewAngle)) * 2.0 / this->Pixels;
    const glm::dvec3 eye(this->Middle.x, EyeHeight, this->Middle.z);
    // Seen from above with z upwards in the picture, x is to the left.
    const glm::dvec3 sight = glm::normalize(glm::dvec3(
      -(x + 0.5 - 0.5 * this->Pixels) * scale, -1.0, (y + 0.5 - 0.5 * this->Pixels) * scale));
    const glm::dvec3 start = this->Waves.Intersect(eye, sight, EyeHeight);
    return { start, glm::normalize(*this->Waves.Refract(eye, start, 1.0) - start) };
  }

  /** Place on the floor that a pixel shows, by the exact waves. */
  glm::dvec3 PlaceOf(int x, int y) const
  {
    const Ray ray = this->RayOf(x, y);
    return ray.At((this->Middle.y - ray.Start.y) / ray.Along.y);
  }

  HeightField Waves;
  glm::dvec3 Middle;
  int Pixels;
  vtkSmartPointer<vtkPolyData> Surface;
  vtkNew<vtkPlaneSource> Plane;
  vtkNew<vtkRefractedGeometryFilter> Filter;
  vtkNew<vtkActor> Membrane;
  vtkNew<vtkActor> Floor;
  vtkNew<vtkRefractionPass> Pass;
  meniscus::test::VolumeScene Scene;
};

/** Ray of the sun behind the exact waves, from a place above (x, z). */
Ray ShineRay(const HeightField& waves, const glm::dvec3& sun, const glm::dvec2& at)
{
  const glm::dvec3 place(at.x, waves.GetHeight(at.x, at.y), at.y);
  return { place, glm::normalize(*waves.Refract(place + 1e6 * sun, place, 1.0) - place) };
}

/**
 * Light of the sun across its ray at a point, times the unit vector back along the ray. @pre rays
 * do not cross above the point
 */
glm::dvec3 LightAt(const HeightField& waves, const glm::dvec3& sun, const glm::dvec3& point)
{
  const auto arrive = [&](const glm::dvec2& at)
  {
    const Ray ray = ShineRay(waves, sun, at);
    const glm::dvec3 end = ray.At((point.y - ray.Start.y) / ray.Along.y);
    return glm::dvec2(end.x, end.z);
  };
  glm::dvec2 at(point.x, point.z);
  for (int i = 0; i < 60; ++i)
  {
    at += glm::dvec2(point.x, point.z) - arrive(at);
  }
  constexpr double step = 1e-3;
  const glm::dvec2 u = (arrive(at + glm::dvec2(step, 0.0)) - arrive(at - glm::dvec2(step, 0.0)));
  const glm::dvec2 v = (arrive(at + glm::dvec2(0.0, step)) - arrive(at - glm::dvec2(0.0, step)));
  const double spread = (u.x * v.y - u.y * v.x) / (4.0 * step * step);
  const glm::dvec3 normal = waves.GetNormal(at.x, at.y);
  const double cosine = glm::dot(sun, normal);
  const glm::dvec3 along = ShineRay(waves, sun, at).Along;
  const double level = cosine / normal.y * TransmittanceOf(cosine, 1.0, Water) / spread;
  return level / -along.y * -along;
}

/** Irradiance on cells of a square floor. */
class Bins
{
public:
  static constexpr int Side = 120;

  explicit Bins(const glm::dvec3& middle)
    : Middle(middle)
    , Values(static_cast<std::size_t>(Side) * Side, 0.0)
    , Counts(this->Values.size(), 0)
  {
  }

  void Add(const glm::dvec3& place, double value)
  {
    const double column = std::floor(0.5 * Side * ((place.x - this->Middle.x) / Half + 1.0));
    const double row = std::floor(0.5 * Side * ((place.z - this->Middle.z) / Half + 1.0));
    if (column >= 0.0 && column < Side && row >= 0.0 && row < Side)
    {
      const auto bin = static_cast<std::size_t>(row * Side + column);
      this->Values[bin] += value;
      ++this->Counts[bin];
    }
  }

  glm::dvec3 Middle;
  std::vector<double> Values;
  std::vector<int> Counts;
};

/** A ball in the water. */
struct Ball
{
  glm::dvec3 Middle;
  double Radius;

  /** True if a line comes as near to its middle. */
  bool IsMet(const glm::dvec3& start, const glm::dvec3& along, double radius) const
  {
    return glm::length(glm::cross(this->Middle - start, glm::normalize(along))) < radius;
  }
};
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
 * Irradiance by rays of the sun through the exact waves, at the `rays` places of a Fibonacci
 * lattice around those that lead to the floor. The surface hides nothing.
 */
Bins ShinePhotons(const WavePool& pool, const glm::dvec3& sun, const glm::dvec3& above, int rays,
  const Ball* ball = nullptr)
{
  Bins bins(pool.Middle);
  constexpr double reach = Half + 35.0;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  constexpr double bin = 2.0 * Half / Bins::Side;
  const double area = 4.0 * reach * reach / rays;
  for (int i = 0; i < rays; ++i)
  {
    const double across = i * golden;
    const double x = above.x + reach * (2.0 * (i + 0.5) / rays - 1.0);
    const double z = above.z + reach * (2.0 * (across - std::floor(across)) - 1.0);
    const glm::dvec3 place(x, pool.Waves.GetHeight(x, z), z);
    const glm::dvec3 normal = pool.Waves.GetNormal(x, z);
    const double cosine = glm::dot(sun, normal);
    if (cosine > 0.0)
    {
      const double power =
        area / normal.y * cosine * TransmittanceOf(cosine, 1.0, Water) / (bin * bin);
      const auto end = pool.Waves.Refract(place + 1e6 * sun, place, 1.0);
      const glm::dvec3 along = *end - place;
      if (!ball || !ball->IsMet(place, along, ball->Radius))
      {
        bins.Add(place + (pool.Middle.y - place.y) / along.y * along, power);
      }
    }
  }
  return bins;
}

glm::dvec3 SunAt(double degrees)
{
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  return { 0.8 * std::sin(angle), std::cos(angle), 0.6 * std::sin(angle) };
}

/** Where the sun's ray to a place at depth `Depth` below flat water meets the water. */
glm::dvec3 AboveOf(const glm::dvec3& sun)
{
  const double tangent = std::tan(std::asin(std::hypot(sun.x, sun.z) / Water));
  return { 0.8 * Depth * tangent, 0.0, 0.6 * Depth * tangent };
}

/** Largest difference of two pictures in colours from 0 to 1. */
double DifferenceOf(const ByteImage& a, const ByteImage& b)
{
  int largest = 0;
  for (std::size_t i = 0; i < a.Rgb.size(); ++i)
  {
    largest = std::max(largest, std::abs(static_cast<int>(a.Rgb[i]) - static_cast<int>(b.Rgb[i])));
  }
  return largest / 255.0;
}

double MeanOf(const ByteImage& image)
{
  double sum = 0.0;
  for (const unsigned char byte : image.Rgb)
  {
    sum += byte / 255.0;
  }
  return sum / static_cast<double>(image.Rgb.size());
}

/** Waves that are no plane for the pass and, within 1e-5 radians, for light. */
HeightField MakeRipples()
{
  return MakeWaves(1.0e-5);
}

} // anonymous namespace

/** A sun over waves with slopes up to 0.3. */
struct SunOverWaves
{
  double Degrees;
  double K;         ///< of the waves
  double Intensity; ///< the brightest lines are not cut off
};

/** Photons are summed, and the picture's pixels averaged, on 120 x 120 cells. */
class RefractionPassWaves : public ::testing::TestWithParam<SunOverWaves>
{
};
TEST_P(RefractionPassWaves, TheFloorHasTheLightOfPhotons)
{
  const glm::dvec3 sun = SunAt(GetParam().Degrees);
  const double intensity = GetParam().Intensity;
  const char* wanted = std::getenv("MENISCUS_TEST_PHOTONS");
  const int rays = wanted ? std::atoi(wanted) : 3000000;
  WavePool pool(MakeWaves(0.3, GetParam().K), 600);
  pool.AddLight(sun, intensity, true);
  const ByteImage image = pool.Render();
  EXPECT_EQ(pool.Pass->GetNumberOfLightUpdates(), 1);
  Bins drawn(pool.Middle);
  for (const auto& [y, x] : Product(pool.Pixels, pool.Pixels))
  {
    drawn.Add(pool.PlaceOf(x, y), image.GetPixel(x, y)[0] / 255.0 / intensity);
  }
  const Bins truth = ShinePhotons(pool, sun, AboveOf(sun), rays);
  double sum = 0.0;
  double right = 0.0;
  double squares = 0.0;
  double pattern = 0.0;
  int cells = 0;
  for (std::size_t i = 0; i < truth.Values.size(); ++i)
  {
    if (drawn.Counts[i] >= 4)
    {
      const double mean = drawn.Values[i] / drawn.Counts[i];
      sum += mean;
      right += truth.Values[i];
      squares += std::pow(mean - truth.Values[i], 2.0);
      pattern += std::pow(truth.Values[i], 2.0);
      ++cells;
    }
  }
  const double mean = right / cells;
  const double rms = std::sqrt(squares / cells) / mean;
  RecordProperty("mean", std::to_string(sum / right));
  RecordProperty("rms", std::to_string(rms));
  RecordProperty("pattern", std::to_string(std::sqrt(pattern / cells / mean / mean - 1.0)));
  RecordProperty("cells", cells);
  EXPECT_GT(cells, 12000);
  EXPECT_NEAR(sum / right, 1.0, 0.01);
  EXPECT_LT(rms, 0.03);
}
INSTANTIATE_TEST_SUITE_P(Sun, RefractionPassWaves,
  ::testing::Values(SunOverWaves{ 0.0, 0.04, 0.3 }, SunOverWaves{ 45.0, 0.04, 0.3 },
    SunOverWaves{ 75.0, 0.02, 0.38 }));

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

/** Ripples without visible height give the picture of the closed form, for lights of all kinds. */
TEST(RefractionPassWavesLimit, RipplesLightAsFlatWater)
{
  WavePool pool(MakeRipples(), 120);
  vtkProperty* property = pool.Floor->GetProperty();
  property->SetSpecular(0.3);
  property->SetSpecularPower(20.0);
  pool.Pass->SetAttenuationCoefficients(0.004, 0.001, 0.0002);
  vtkTypeInt64 updates = 0;
  const auto expectSame = [&](const std::string& what, int computed)
  {
    pool.Pass->SetNumberOfLightCells(20000);
    const ByteImage byTables = pool.Render();
    updates += computed;
    EXPECT_EQ(pool.Pass->GetNumberOfLightUpdates(), updates) << what;
    pool.Pass->SetNumberOfLightCells(0);
    const ByteImage byPlane = pool.Render();
    EXPECT_GT(MeanOf(byPlane), 0.05) << what;
    // Rounding to 8 bits twice.
    EXPECT_LT(DifferenceOf(byTables, byPlane), 2.5 / 255.0) << what;
    pool.GetRenderer()->RemoveAllLights();
  };
  pool.AddLight(SunAt(45.0), 0.8, true);
  expectSame("sun", 1);
  pool.AddLight(SunAt(75.0), 2.0, true);
  expectSame("low sun", 1);
  pool.AddLight({ 10.0, 60.0, -20.0 }, 0.8, false);
  expectSame("lamp", 1);
  pool.AddLight({ 10.0, 60.0, -20.0 }, 30.0, false)->SetAttenuationValues(1.0, 0.1, 0.001);
  expectSame("lamp with falloff", 1);
  const auto spot = pool.AddLight({ 10.0, 60.0, -20.0 }, 0.8, false);
  spot->SetConeAngle(60.0);
  spot->SetExponent(8.0);
  expectSame("spot", 1);
  pool.AddLight({ 5.0, -40.0, 5.0 }, 0.8, false);
  expectSame("lamp in the water", 0);
  pool.AddLight(SunAt(30.0), 0.3, true);
  pool.AddLight({ 5.0, -40.0, 5.0 }, 0.2, false);
  pool.AddLight({ 10.0, 60.0, -20.0 }, 0.2, false);
  expectSame("three together", 2);
  const auto atTheEye = pool.AddLight({ 0.0, 1.0, 0.0 }, 0.5, true);
  atTheEye->SetLightTypeToHeadlight();
  expectSame("light that follows the camera", 0);
}

/**
 * A torus has facets that the light grazes, some that face away from it, and some without area,
 * where its ends meet: VTK does not draw all of their triangles.
 */
TEST(RefractionPassWavesLimit, RipplesLightATorusAsFlatWater)
{
  WavePool pool(MakeRipples(), 300);
  vtkNew<vtkParametricTorus> shape;
  vtkNew<vtkParametricFunctionSource> torus;
  torus->SetParametricFunction(shape);
  vtkNew<vtkTransform> transform;
  transform->Translate(0.0, -60.0, 0.0);
  transform->Scale(30.0, 30.0, 30.0);
  transform->RotateX(70.0);
  vtkNew<vtkTransformPolyDataFilter> placed;
  placed->SetTransform(transform);
  placed->SetInputConnection(torus->GetOutputPort());
  pool.Filter->SetInputConnection(placed->GetOutputPort());
  const auto expectSame = [&](const std::string& what)
  {
    // The normals of the coarser one are up to 14 degrees off those of its facets.
    for (const int resolution : { 13, 50 })
    {
      torus->SetUResolution(resolution);
      torus->SetVResolution(resolution);
      pool.Pass->SetNumberOfLightCells(0);
      const ByteImage byPlane = pool.Render();
      EXPECT_GT(MeanOf(byPlane), 0.02) << what;
      pool.Pass->SetNumberOfLightCells(100000);
      EXPECT_LT(DifferenceOf(pool.Render(), byPlane), 2.5 / 255.0) << what << ", " << resolution;
    }
    pool.GetRenderer()->RemoveAllLights();
  };
  pool.AddLight(SunAt(0.0), 0.8, true);
  expectSame("sun above");
  pool.AddLight(SunAt(45.0), 0.8, true);
  expectSame("sun");
  pool.AddLight(SunAt(75.0), 1.2, true);
  expectSame("low sun");
  pool.AddLight({ 10.0, 60.0, -20.0 }, 0.8, false);
  expectSame("lamp");
}

/** A sphere, from where it faces the sun to where it faces away, has the light of exact rays. */
TEST(RefractionPassWavesLimit, ASphereHasTheLightOfRays)
{
  constexpr double radius = 35.0;
  constexpr double intensity = 0.4;
  const glm::dvec3 center(0.0, -60.0, 0.0);
  WavePool pool(MakeWaves(0.3), 300);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(center.x, center.y, center.z);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  pool.Filter->SetInputConnection(sphere->GetOutputPort());
  const glm::dvec3 sun = SunAt(60.0);
  pool.AddLight(sun, intensity, true);
  const ByteImage image = pool.Render();
  double largest = 0.0;
  int seen = 0;
  int grazed = 0;
  for (const auto& [y, x] : Product(pool.Pixels, pool.Pixels))
  {
    const Ray ray = pool.RayOf(x, y);
    const glm::dvec3 from = ray.Start - center;
    const double middle = -glm::dot(from, ray.Along);
    const double square = middle * middle - glm::dot(from, from) + radius * radius;
    // Not at the outline, where a pixel shows many places.
    if (square < 0.1 * radius * radius)
    {
      continue;
    }
    const glm::dvec3 place = ray.At(middle - std::sqrt(square));
    const glm::dvec3 normal = (place - center) / radius;
    const glm::dvec3 light = LightAt(pool.Waves, sun, place);
    const double cosine = glm::dot(normal, light) / glm::length(light);
    const double right = std::min(1.0, intensity * std::max(0.0, glm::dot(normal, light)));
    largest = std::max(largest, std::fabs(image.GetPixel(x, y)[0] / 255.0 - right));
    ++seen;
    grazed += std::fabs(cosine) < 0.05 ? 1 : 0;
  }
  RecordProperty("largest", std::to_string(255.0 * largest));
  EXPECT_GT(seen, 10000);
  EXPECT_GT(grazed, 200);
  EXPECT_LT(largest, 3.0 / 255.0);
}

/** Strips, triangles, the surface of a grid, and points without normals. */
TEST(RefractionPassWavesLimit, ObjectsOfAllKindsAreLit)
{
  WavePool pool(MakeRipples(), 120);
  pool.AddLight(SunAt(45.0), 0.8, true);
  pool.Pass->SetNumberOfLightCells(0);
  const ByteImage right = pool.Render();
  pool.Pass->SetNumberOfLightCells(3000);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(pool.Plane->GetOutputPort());
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(triangles->GetOutputPort());
  vtkNew<vtkAppendFilter> grid;
  grid->SetInputConnection(pool.Plane->GetOutputPort());
  for (vtkAlgorithm* object :
    { static_cast<vtkAlgorithm*>(pool.Plane), static_cast<vtkAlgorithm*>(triangles),
      static_cast<vtkAlgorithm*>(strips), static_cast<vtkAlgorithm*>(grid) })
  {
    pool.Filter->SetInputConnection(object->GetOutputPort());
    for (const bool allImages : { true, false })
    {
      pool.Filter->SetImages(allImages ? vtkRefractedGeometryFilter::ALL_IMAGES
                                       : vtkRefractedGeometryFilter::FIRST_IMAGE);
      EXPECT_LT(DifferenceOf(pool.Render(), right), 2.5 / 255.0)
        << object->GetClassName() << " " << allImages;
    }
  }
  EXPECT_EQ(pool.Pass->GetNumberOfLightUpdates(), 4);
}

/** A pane with a wavy front transmits as Stokes's plates do. */
TEST(RefractionPassWavesLimit, BehindAPaneTheLightOfBothSidesArrives)
{
  WavePool pool(MakeRipples(), 60);
  constexpr double glass = 1.5;
  vtkNew<vtkRefractingInterface> back;
  back->SetExteriorIndexOfRefraction(glass);
  back->SetInteriorIndexOfRefraction(1.0);
  pool.Filter->SetInteriorIndexOfRefraction(glass);
  pool.Filter->GetInterfaces()->AddItem(back);
  vtkNew<vtkPolyData> lower;
  lower->DeepCopy(pool.Surface);
  for (vtkIdType i = 0; i < lower->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 place = PointOf(lower, i);
    lower->GetPoints()->SetPoint(i, place[0], -2.0, place[2]);
  }
  pool.Filter->AddMembraneData(lower);
  pool.Filter->SetImagesToFirstImage();
  pool.Pass->SetNumberOfLightCells(500);
  const double cosine = 0.5;
  pool.AddLight(SunAt(60.0), 1.0, true);
  double passed = 0.0;
  const double inner = std::sqrt(1.0 - (1.0 - cosine * cosine) / (glass * glass));
  for (const double r : { (cosine - glass * inner) / (cosine + glass * inner),
         (glass * cosine - inner) / (glass * cosine + inner) })
  {
    passed += 0.5 * (1.0 - r * r) / (1.0 + r * r);
  }
  const ByteImage image = pool.Render();
  EXPECT_NEAR(image.GetPixel(30, 30)[0] / 255.0, cosine * passed, 1.5 / 255.0);
}

/** Work is done where its input changes. */
TEST(RefractionPassWavesLimit, TheLightIsComputedWhereItChanges)
{
  WavePool pool(MakeWaves(0.2), 60);
  pool.Pass->SetNumberOfLightCells(2000);
  const auto sun = pool.AddLight(SunAt(30.0), 0.5, true);
  const auto updates = [&pool]()
  {
    pool.Render();
    return pool.Pass->GetNumberOfLightUpdates();
  };
  EXPECT_EQ(updates(), 1);
  EXPECT_EQ(updates(), 1);
  pool.LookFrom(30.0, 10.0);
  EXPECT_EQ(updates(), 1) << "camera";
  sun->SetIntensity(0.7);
  sun->SetColor(1.0, 0.5, 0.2);
  pool.Pass->SetAttenuationCoefficients(0.01, 0.0, 0.0);
  pool.Floor->GetProperty()->SetColor(0.5, 0.5, 1.0);
  EXPECT_EQ(updates(), 1) << "colours";
  sun->SetPosition(0.1, 1.0, 0.2);
  EXPECT_EQ(updates(), 2) << "light";
  pool.Plane->SetResolution(4, 4);
  EXPECT_EQ(updates(), 3) << "object";
  pool.Surface->GetPoints()->SetPoint(0, -200.0, 0.1, -200.0);
  pool.Surface->GetPoints()->Modified();
  pool.Surface->Modified();
  EXPECT_EQ(updates(), 4) << "membrane";
  pool.Filter->SetInteriorIndexOfRefraction(1.4);
  EXPECT_EQ(updates(), 5) << "index";
  pool.Pass->SetNumberOfLightCells(3000);
  EXPECT_EQ(updates(), 6) << "cells";
  pool.AddLight(SunAt(10.0), 0.2, true);
  EXPECT_EQ(updates(), 7) << "another light";
  sun->SwitchOff();
  EXPECT_EQ(updates(), 8) << "it takes the place of the first";
  pool.Pass->SetLighting(vtkRefractionPass::VIRTUAL_SPACE);
  EXPECT_EQ(updates(), 8);
}

/** No light, lights that do not reach the floor, and more lights than the shader takes. */
TEST(RefractionPassWavesLimit, LightsWithoutEffect)
{
  WavePool pool(MakeWaves(0.2), 60);
  pool.Pass->SetNumberOfLightCells(2000);
  EXPECT_EQ(MeanOf(pool.Render()), 0.0);
  EXPECT_EQ(pool.Pass->GetNumberOfLightUpdates(), 0) << "no light";
  pool.AddLight({ 0.3, -1.0, 0.2 }, 0.5, true); // from below: the floor is lit on its back
  EXPECT_EQ(MeanOf(pool.Render()), 0.0);
  EXPECT_EQ(pool.Pass->GetNumberOfLightUpdates(), 0) << "light from below";
  pool.GetRenderer()->RemoveAllLights();
  pool.AddLight({ 1.0, 0.001, 0.0 }, 0.5, true);
  const double grazing = MeanOf(pool.Render());
  EXPECT_GE(grazing, 0.0);
  EXPECT_LT(grazing, 0.5);
  pool.GetRenderer()->RemoveAllLights();
  for (int i = 0; i < 30; ++i)
  {
    pool.AddLight(SunAt(2.0 * i), 0.02, true);
  }
  const vtkTypeInt64 before = pool.Pass->GetNumberOfLightUpdates();
  const vtkTypeInt64 skipped = pool.Pass->GetNumberOfSkippedLights();
  pool.Render();
  EXPECT_EQ(pool.Pass->GetNumberOfSkippedLights() - skipped, 14);
  EXPECT_EQ(pool.Pass->GetNumberOfLightUpdates() - before, 16);
}

/** From a denser medium, beyond the critical angle, no light arrives. */
TEST(RefractionPassWavesLimit, TotallyReflectedLightDoesNotArrive)
{
  HeightField ripples = MakeRipples();
  WavePool pool(ripples, 60);
  pool.Pass->SetNumberOfLightCells(2000);
  pool.Filter->SetExteriorIndexOfRefraction(Water);
  pool.Filter->SetInteriorIndexOfRefraction(1.0);
  pool.AddLight(SunAt(60.0), 1.0, true);
  EXPECT_EQ(MeanOf(pool.Render()), 0.0);
  EXPECT_EQ(pool.Pass->GetNumberOfLightUpdates(), 1);
  pool.GetRenderer()->RemoveAllLights();
  pool.AddLight(SunAt(30.0), 1.0, true);
  EXPECT_GT(MeanOf(pool.Render()), 0.3);
}

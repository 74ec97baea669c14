// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lighting in true space behind waves: pictures of a floor compared with photons through exact
// waves, and waves without height compared with flat water.
#include "StrictImage.h"
#include "WavePool.h"

#include <vtkAppendFilter.h>
#include <vtkParametricFunctionSource.h>
#include <vtkParametricTorus.h>
#include <vtkPolyDataNormals.h>
#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkRefractionPass.h>
#include <vtkStripper.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>

using namespace meniscus::test;
using namespace meniscus::test::wavepool;
using meniscus::reference::HeightField;

namespace
{

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
    EXPECT_LE(CompareStrictly(byTables, byPlane, 0).Largest, 2) << what;
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
      EXPECT_LE(CompareStrictly(pool.Render(), byPlane, 0).Largest, 2)
        << what << ", " << resolution;
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
      EXPECT_LE(CompareStrictly(pool.Render(), right, 0).Largest, 2)
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
  MapPoints(lower, [](const glm::dvec3& at) { return glm::dvec3(at.x, -2.0, at.z); });
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

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** A floor under waves seen through vtkRefractionPass, and photons through the exact waves. */
#pragma once

#include "ExactStack.h"
#include "RefractionPicture.h"
#include "VTKTestBasics.h"
#include "VolumeScene.h"

#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractionPass.h>

namespace meniscus::test::wavepool
{

using reference::HeightField;

constexpr double Water = 1.333;
constexpr double Depth = 80.0;
constexpr double Half = 50.0; ///< of the floor
constexpr double EyeHeight = 260.0;
constexpr double ViewAngle = 24.0;

inline HeightField MakeWaves(double slope, double k = 0.04)
{
  HeightField waves;
  waves.Side = 400.0;
  waves.K = k;
  waves.Amplitude = slope / waves.K;
  waves.Interior = Water;
  return waves;
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
inline Ray ShineRay(const HeightField& waves, const glm::dvec3& sun, const glm::dvec2& at)
{
  const glm::dvec3 place(at.x, waves.GetHeight(at.x, at.y), at.y);
  return { place, glm::normalize(*waves.Refract(place + 1e6 * sun, place, 1.0) - place) };
}

/**
 * Light of the sun across its ray at a point, times the unit vector back along the ray. @pre rays
 * do not cross above the point
 */
inline glm::dvec3 LightAt(const HeightField& waves, const glm::dvec3& sun, const glm::dvec3& point)
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
  const double level =
    cosine / normal.y * (1.0 - reference::MakeReflectance(cosine, 1.0, Water)) / spread;
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
/**
 * Irradiance by rays of the sun through the exact waves, at the `rays` places of a Fibonacci
 * lattice around those that lead to the floor. The surface hides nothing.
 */
inline Bins ShinePhotons(const WavePool& pool, const glm::dvec3& sun, const glm::dvec3& above,
  int rays, const Ball* ball = nullptr)
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
      const double power = area / normal.y * cosine *
        (1.0 - reference::MakeReflectance(cosine, 1.0, Water)) / (bin * bin);
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

inline glm::dvec3 SunAt(double degrees)
{
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  return { 0.8 * std::sin(angle), std::cos(angle), 0.6 * std::sin(angle) };
}

/** Where the sun's ray to a place at depth `Depth` below flat water meets the water. */
inline glm::dvec3 AboveOf(const glm::dvec3& sun)
{
  const double tangent = std::tan(std::asin(std::hypot(sun.x, sun.z) / Water));
  return { 0.8 * Depth * tangent, 0.0, 0.6 * Depth * tangent };
}

}

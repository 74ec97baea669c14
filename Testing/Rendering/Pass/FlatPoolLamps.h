// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Lights of a flat pool in true space, and the closed forms of their rays and colours. */
#pragma once

#include "FlatPool.h"
#include "Refraction/Membrane/Optics.h"

namespace meniscus::test::flatpool
{

constexpr double Ambient = 0.1;
constexpr double Diffuse = 0.7;
constexpr double Specular = 0.2;
constexpr double Power = 12.0;
inline const glm::dvec3 Albedo(0.9, 0.6, 0.3);

/** A light, and the ray by which it reaches a point of the floor. */
struct Lamp
{
  glm::dvec3 Color{ 1.0 };
  /** Place, or for a light at infinity the direction to it. */
  glm::dvec3 Place{ 0.0 };
  bool IsDistant = false;
  glm::dvec3 Axis{ 0.0, 0.0, -1.0 };
  double ConeAngle = 90.0;
  double Exponent = 1.0;
  glm::dvec3 Falloff{ 1.0, 0.0, 0.0 };

  vtkSmartPointer<vtkLight> Make() const
  {
    auto light = vtkSmartPointer<vtkLight>::New();
    light->SetLightTypeToSceneLight();
    light->SetColor(this->Color.r, this->Color.g, this->Color.b);
    const glm::dvec3 focus = this->IsDistant ? glm::dvec3(0.0) : this->Place + this->Axis;
    light->SetPosition(this->Place.x, this->Place.y, this->Place.z);
    light->SetFocalPoint(focus.x, focus.y, focus.z);
    light->SetPositional(!this->IsDistant);
    light->SetConeAngle(this->ConeAngle);
    light->SetExponent(this->Exponent);
    light->SetAttenuationValues(this->Falloff.x, this->Falloff.y, this->Falloff.z);
    return light;
  }
};

struct LampRay
{
  glm::dvec3 ToLamp;
  glm::dvec3 FromLamp;
  double Path;
  double InWater;
  /** Flux across the ray, relative to a straight ray of the same length. */
  double Flux = 1.0;
};

/**
 * Flux across the refracted beam as a share of the flux across the beam in air, for the angle in
 * air.
 */
inline double TransmittedFlux(double angle)
{
  const double cosine = std::cos(angle);
  const double refracted = std::cos(std::asin(std::sin(angle) / Water));
  return (1.0 - meniscus::FresnelReflectance(cosine, 1.0, Water)) * cosine / refracted;
}

/**
 * Flux of a lamp at a height across a ray that ends at a depth, as the solid angle of a thin beam
 * over its cross-section, times the square of the ray's length.
 */
inline double FluxOfLamp(double angle, double height, double depth)
{
  const auto across = [&](double at)
  { return height * std::tan(at) + depth * std::tan(std::asin(std::sin(at) / Water)); };
  const double step = 1.0e-4 * std::max(angle, 1.0e-2);
  const double low = std::max(angle - step, 0.0);
  const double high = std::min(angle + step, 0.5 * vtkMath::Pi() - 1.0e-9);
  const double solidAngle = std::cos(low) - std::cos(high);
  const double area = 0.5 * (across(high) * across(high) - across(low) * across(low));
  const double refracted = std::cos(std::asin(std::sin(angle) / Water));
  const double path = height / std::cos(angle) + depth / refracted;
  const double lost = meniscus::FresnelReflectance(std::cos(angle), 1.0, Water);
  return (1.0 - lost) * solidAngle / (area * refracted) * path * path;
}

/** Ray from a light to a point below the water z = 0, by Snell's law. */
inline LampRay TraceLamp(const Lamp& lamp, const glm::dvec3& point)
{
  const glm::dvec3 up(0.0, 0.0, 1.0);
  if (lamp.IsDistant)
  {
    const glm::dvec3 to = glm::normalize(lamp.Place);
    const glm::dvec3 across = glm::dvec3(to.x, to.y, 0.0) / Water;
    const double cosine = std::sqrt(1.0 - glm::dot(across, across));
    return { across + cosine * up, -to, 0.0, -point.z / cosine,
      TransmittedFlux(std::acos(glm::dot(to, up))) };
  }
  const glm::dvec3 between = lamp.Place - point;
  if (lamp.Place.z < 0.0)
  {
    const double path = glm::length(between);
    return { between / path, -between / path, path, path };
  }
  // The angle in air, by bisection: both parts of the way across add up to the distance.
  const glm::dvec3 level(between.x, between.y, 0.0);
  const double r = glm::length(level);
  const auto inWater = [](double angle) { return std::asin(std::sin(angle) / Water); };
  double low = 0.0;
  double high = 0.5 * vtkMath::Pi();
  for (int i = 0; i < 60; ++i)
  {
    const double angle = 0.5 * (low + high);
    const double across = lamp.Place.z * std::tan(angle) - point.z * std::tan(inWater(angle));
    (across > r ? high : low) = angle;
  }
  const glm::dvec3 along = r > 0.0 ? level / r : glm::dvec3(0.0);
  const double below = inWater(low);
  return { std::sin(below) * along + std::cos(below) * up,
    -(std::sin(low) * along + std::cos(low) * up),
    lamp.Place.z / std::cos(low) - point.z / std::cos(below), -point.z / std::cos(below),
    FluxOfLamp(low, lamp.Place.z, -point.z) };
}

/** The place of the floor that a pixel shows, and the direction from there to its sight point. */
struct FloorSight
{
  glm::dvec3 Place;
  glm::dvec3 ToViewer;
};

inline FloorSight FloorOf(vtkCamera* camera, const Sight& sight)
{
  const double* eye = camera->GetPosition();
  const glm::dvec3 surface(sight.Point[0], sight.Point[1], 0.0);
  const glm::dvec3 ray = glm::normalize(surface - glm::dvec3(eye[0], eye[1], eye[2]));
  const glm::dvec3 refracted(ray.x / Water, ray.y / Water, -sight.RefractedCosine);
  return { surface + Depth / sight.RefractedCosine * refracted, -refracted };
}

/** Phong's model with VTK's falloff. */
inline glm::dvec3 LitColor(
  const std::vector<Lamp>& lamps, const FloorSight& floor, const glm::dvec3& coefficients)
{
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  glm::dvec3 color = Ambient * Albedo;
  for (const Lamp& lamp : lamps)
  {
    const LampRay ray = TraceLamp(lamp, floor.Place);
    double strength = ray.Flux;
    if (!lamp.IsDistant)
    {
      strength /= lamp.Falloff.x + ray.Path * (lamp.Falloff.y + ray.Path * lamp.Falloff.z);
      const double inCone = glm::dot(ray.FromLamp, glm::normalize(lamp.Axis));
      if (lamp.ConeAngle < 90.0)
      {
        strength *= inCone < std::cos(vtkMath::RadiansFromDegrees(lamp.ConeAngle))
          ? 0.0
          : std::pow(inCone, lamp.Exponent);
      }
    }
    const double facing = std::max(glm::dot(normal, ray.ToLamp), 0.0);
    const glm::dvec3 mirrored = 2.0 * facing * normal - ray.ToLamp;
    const double highlight =
      facing > 0.0 ? std::pow(std::max(glm::dot(mirrored, floor.ToViewer), 0.0), Power) : 0.0;
    for (int c = 0; c < 3; ++c)
    {
      color[c] += strength * lamp.Color[c] * std::exp(-coefficients[c] * ray.InWater) *
        (Diffuse * facing * Albedo[c] + Specular * highlight);
    }
  }
  return color;
}

class LitPool : public Pool
{
public:
  LitPool()
  {
    this->Pass->SetReflectanceModel(vtkRefractionPass::NONE);
    this->Pass->SetLighting(vtkRefractionPass::TRUE_SPACE);
    this->Filter->TrueGeometryOn();
    vtkProperty* property = this->Floor->GetProperty();
    property->SetColor(Albedo.r, Albedo.g, Albedo.b);
    property->SetSpecularColor(1.0, 1.0, 1.0);
    property->SetAmbient(Ambient);
    property->SetDiffuse(Diffuse);
    property->SetSpecular(Specular);
    property->SetSpecularPower(Power);
    this->GetRenderer()->SetAutomaticLightCreation(false);
  }

  void SetLamps(const std::vector<Lamp>& lamps)
  {
    this->GetRenderer()->RemoveAllLights();
    for (const Lamp& lamp : lamps)
    {
      this->GetRenderer()->AddLight(lamp.Make());
    }
  }

  /** The medium attenuates sight rays, and the light on its way if `lightIsAttenuated`. */
  void ExpectLit(const std::string& what, const std::vector<Lamp>& lamps,
    const glm::dvec3& coefficients = glm::dvec3(0.0), bool lightIsAttenuated = true)
  {
    const glm::dvec3 ofLight = lightIsAttenuated ? coefficients : glm::dvec3(0.0);
    this->SetLamps(lamps);
    for (const double x : { 0.0, 1.5 })
    {
      this->LookFrom(x, -0.5 * x);
      ExpectColors(*this, what,
        [&](const Sight& sight, int channel)
        {
          const FloorSight floor = FloorOf(this->GetCamera(), sight);
          return std::clamp(LitColor(lamps, floor, ofLight)[channel] *
              std::exp(-coefficients[channel] *
                glm::distance(floor.Place, glm::dvec3(sight.Point[0], sight.Point[1], 0.0))),
            0.0, 1.0);
        });
    }
  }
};

/** A light at infinity in a direction. */
inline Lamp Distant(double x, double y, double z)
{
  Lamp lamp;
  lamp.IsDistant = true;
  lamp.Place = { x, y, z };
  return lamp;
}

/** A lamp that shines to all sides. */
inline Lamp Near(double x, double y, double z)
{
  Lamp lamp;
  lamp.Place = { x, y, z };
  lamp.Falloff = { 0.6, 0.2, 0.3 };
  return lamp;
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/VolumeIllumination.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/PacketScene.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Simd/InstructionSets.h"
#include "Volume/Illumination/FibonacciSphere.h"
#include "Volume/Illumination/VertexShadows.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meniscus
{
namespace
{

void AddAttenuation(
  const std::vector<TransferFunctionInterval>& intervals, std::vector<float>& attenuation)
{
  for (const TransferFunctionInterval& interval : intervals)
  {
    attenuation.insert(attenuation.end(),
      { interval.Lower, interval.Upper, interval.Attenuation, interval.AttenuationSlope });
  }
  attenuation.push_back(static_cast<float>(intervals.size()));
}

/** False for a light without a place or direction, which casts no shadow. */
bool CanCast(const glm::dvec4& position)
{
  const glm::dvec3 place(position);
  return std::isfinite(place.x + place.y + place.z) &&
    (position.w != 0.0 || glm::length(place) > 0.0);
}

double BrightnessOf(const RayCastLight& light)
{
  return light.Diffuse.r + light.Diffuse.g + light.Diffuse.b;
}

/** Light of a source at a place; finite. */
double BrightnessAt(const RayCastLight& light, const glm::dvec3& place)
{
  glm::dvec3 toLight;
  const double brightness = BrightnessOf(light) * StrengthAt(light, place, toLight);
  return brightness > 0.0 ? brightness : 0.0;
}

}

//------------------------------------------------------------------------------
bool VolumeIllumination::MediumKey::operator==(const MediumKey& other) const
{
  const auto members = [](const MediumKey& key)
  {
    return std::tie(key.Blending, key.CellScalars, key.Attenuation, key.Isovalues,
      key.SurfaceOpacities, key.GradientOpacity, key.VertexGradients, key.GradientMagnitude,
      key.Reach);
  };
  return this->Mesh == other.Mesh && this->Values == other.Values &&
    members(*this) == members(other) && this->ClippingPlanes == other.ClippingPlanes &&
    this->Base == other.Base;
}

//------------------------------------------------------------------------------
auto VolumeIllumination::KeyOf(const RayCastTables& tables, const Request& request) const
  -> MediumKey
{
  MediumKey key;
  const VolumeInput& input = tables.Input;
  const RayCastOptics& optics = request.Optics;
  const bool mixed = optics.HasComponents();
  key.Mesh = { input.GetMeshVersion(), input.GetLinkVersion() };
  key.Values = { input.GetScalarVersion(),
    mixed ? tables.Components.GetVersion() : TableVersion() };
  if (optics.Model().IsMedium())
  {
    AddAttenuation(tables.Property.GetIntervals(), key.Attenuation);
  }
  for (const std::vector<TransferFunctionInterval>& other : tables.Property.GetOtherIntervals())
  {
    AddAttenuation(other, key.Attenuation);
  }
  key.Attenuation.push_back(static_cast<float>(optics.Components));
  key.Blending = optics.Blending;
  key.CellScalars = optics.CellScalars;
  for (const Isosurface& surface : tables.Property.GetIsosurfaces())
  {
    key.Isovalues.push_back(surface.Scalar);
    key.SurfaceOpacities.push_back(surface.Opacity);
  }
  key.GradientOpacity = optics.GradientOpacity;
  if (optics.GradientOpacity)
  {
    AddAttenuation(tables.Property.GetGradientIntervals(), key.Attenuation);
    key.VertexGradients = optics.VertexGradients;
    key.GradientMagnitude = optics.GradientMagnitude;
  }
  key.ClippingPlanes = optics.ClippingPlanes;
  key.Base = request.Base;
  key.Reach = request.Reach;
  return key;
}

//------------------------------------------------------------------------------
/** Forgets all transmittances if they are of another medium. */
void VolumeIllumination::SetMediumOf(RayCastTables& tables, const Request& request)
{
  MediumKey key = this->KeyOf(tables, request);
  if (this->IsCombined && key == this->Medium)
  {
    return;
  }
  if (!(key == this->Medium))
  {
    // Isosurfaces and their scalars count where there are some.
    const bool newStarts = !(key.Mesh == this->Medium.Mesh) ||
      key.Blending != this->Medium.Blending || key.CellScalars != this->Medium.CellScalars ||
      key.Isovalues != this->Medium.Isovalues ||
      (!key.Isovalues.empty() && !(key.Values == this->Medium.Values));
    this->Medium = std::move(key);
    this->Lights.clear();
    this->AmbientDirections = 0;
    PackProperty(tables.Property, this->Packed);
    if (newStarts)
    {
      this->BuildStarts(tables);
    }
  }
  this->IsCombined = false;
}

//------------------------------------------------------------------------------
void VolumeIllumination::BuildStarts(RayCastTables& tables)
{
  if (this->AreInCells())
  {
    // Surfaces are faces of cells, and pass through their vertices.
    this->Starts.BuildInCells(tables.Input.GetMesh(), ThreadedLoop);
    return;
  }
  const StartSurfaces surfaces{ tables.Input.GetScalars(), this->Medium.Isovalues };
  this->Starts.Build(
    tables.Input.GetMesh(), ThreadedLoop, surfaces.Isovalues.empty() ? nullptr : &surfaces);
}

//------------------------------------------------------------------------------
/** Brings the known lights to the order of `lights`. Returns those that have to be cast. */
std::vector<std::size_t> VolumeIllumination::FindUnknown(const std::vector<RayCastLight>& lights)
{
  std::vector<KnownLight> known;
  std::vector<std::size_t> unknown;
  std::swap(known, this->Lights);
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const auto found = std::find_if(known.begin(), known.end(),
      [&](const KnownLight& light)
      { return light.Position == lights[i].Position && !light.Transmittance.empty(); });
    this->Lights.push_back({ lights[i].Position, {} });
    if (found != known.end())
    {
      this->Lights.back().Transmittance = found->Transmittance;
    }
    else
    {
      unknown.push_back(i);
    }
  }
  return unknown;
}

//------------------------------------------------------------------------------
void VolumeIllumination::CastLight(const ShadowScene& scene, KnownLight& light)
{
  std::vector<float> cast(this->Starts.GetSize(), 1.0f);
  if (CanCast(light.Position))
  {
    CastShadows(scene, light.Position, ThreadedLoop,
      [&cast](std::int32_t start, float transmittance)
      { cast[static_cast<std::size_t>(start)] = transmittance; });
    ++this->Casts;
  }
  light.Transmittance = std::move(cast);
}

//------------------------------------------------------------------------------
void VolumeIllumination::CastDirection(const ShadowScene& scene, int direction)
{
  std::vector<float>& sums = this->Ambient;
  if (direction == 0)
  {
    sums.assign(this->Starts.GetSize(), 0.0f);
  }
  CastShadows(scene, glm::dvec4(FibonacciDirection(direction, NumberOfDirections), 0.0),
    ThreadedLoop,
    [&sums](std::int32_t start, float transmittance)
    { sums[static_cast<std::size_t>(start)] += transmittance; });
  ++this->Casts;
  this->AmbientDirections = direction + 1;
}

//------------------------------------------------------------------------------
/** Makes the values of the transmittances. */
void VolumeIllumination::Combine(const Request& request)
{
  const std::vector<RayCastLight>& lights = request.Optics.Lighting.Lights;
  const glm::dmat3 rows(request.Base.RowX, request.Base.RowY, request.Base.RowDepth);
  this->Brightest = 0;
  for (std::size_t i = 1; i < lights.size(); ++i)
  {
    const auto brightest = static_cast<std::size_t>(this->Brightest);
    if (BrightnessAt(lights[i], glm::dvec3(0.0)) > BrightnessAt(lights[brightest], glm::dvec3(0.0)))
    {
      this->Brightest = static_cast<int>(i);
    }
  }
  // The half of the directions that is behind a surface lights it in no case.
  const bool isMedium = request.Optics.Model().IsMedium();
  const auto directions =
    static_cast<float>(isMedium ? NumberOfDirections : NumberOfDirections / 2);
  this->Values.assign(this->Starts.GetSize(), glm::vec3(1.0f));
  const std::vector<std::int32_t>& numbers = this->Starts.GetNumbers();
  ForEachInBlocks(numbers.size(), ThreadedLoop,
    [&](std::size_t i)
    {
      const auto start = static_cast<std::size_t>(numbers[i]);
      glm::vec3& value = this->Values[start];
      value.x = std::min(this->Ambient[start] / directions, 1.0f);
      double sum = 0.0;
      double weights = 0.0;
      for (std::size_t number = 0; number < lights.size(); ++number)
      {
        const float transmittance = this->Lights[number].Transmittance[start];
        if (static_cast<int>(number) == this->Brightest)
        {
          value.y = transmittance;
          continue;
        }
        const glm::dvec3 place = this->Starts.GetPlace(numbers[i]) * rows;
        const double weight = BrightnessAt(lights[number], place);
        sum += weight * transmittance;
        weights += weight;
      }
      value.z = weights > 0.0 ? static_cast<float>(sum / weights) : 1.0f;
    });
  this->CombinedLights = lights;
  this->IsCombined = true;
  this->Version.Bump();
}

//------------------------------------------------------------------------------
bool VolumeIllumination::Update(
  RayCastTables& tables, const Request& request, const std::function<bool(double)>& progress)
{
  const std::vector<RayCastLight>& lights = request.Optics.Lighting.Lights;
  this->SetMediumOf(tables, request);
  if (this->IsCombined && this->CombinedLights == lights)
  {
    return true;
  }
  this->IsCombined = false;
  ShadowScene scene;
  SetMedium(tables, request.Optics, scene.Medium);
  scene.Medium.Tables = &this->Packed;
  scene.Medium.Set = BestInstructionSet();
  scene.Scalars = &tables.Input.GetScalars();
  scene.Tree = &tables.Input.GetBoundaryTree();
  scene.Starts = &this->Starts;
  scene.Base = request.Base;
  // The mesh is within the unit of the frame.
  scene.Reach = 2.0 * request.Reach;
  const std::vector<std::size_t> unknown = this->FindUnknown(lights);
  const double total = static_cast<double>(unknown.size()) + NumberOfDirections;
  double done = 0.0;
  for (const std::size_t light : unknown)
  {
    if (!progress(done++ / total))
    {
      return false;
    }
    this->CastLight(scene, this->Lights[light]);
  }
  while (this->AmbientDirections < NumberOfDirections)
  {
    if (!progress((static_cast<double>(unknown.size()) + this->AmbientDirections) / total))
    {
      return false;
    }
    this->CastDirection(scene, this->AmbientDirections);
  }
  this->Combine(request);
  return true;
}

//------------------------------------------------------------------------------
std::int64_t VolumeIllumination::GetBytes() const
{
  std::int64_t bytes = BytesOf(this->Values) + BytesOf(this->Ambient) + this->Starts.GetBytes();
  for (const KnownLight& light : this->Lights)
  {
    bytes += BytesOf(light.Transmittance);
  }
  return bytes;
}

}

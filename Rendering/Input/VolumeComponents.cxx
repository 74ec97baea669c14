// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/VolumeComponents.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/ConcatenatedArray.h"

#include "vtkDataArray.h"
#include "vtkType.h"

#include <glm/common.hpp>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>

namespace meniscus
{
namespace
{

constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();

/**
 * Stored value of a colour's full intensity: 255 for bytes, by VTK's convention, and 1 otherwise.
 */
double FullIntensity(const InputBlocks& parts)
{
  return parts.Parts.front().Scalars->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
}

/** Components besides the main one that are scalars with their own functions. */
std::vector<int> OtherScalars(ComponentMixture mixture, int components)
{
  std::vector<int> others;
  if (mixture == ComponentMixture::ColorAndOpacity)
  {
    others.push_back(0);
  }
  for (int c = 1; mixture == ComponentMixture::Independent && c < components; ++c)
  {
    others.push_back(c);
  }
  return others;
}

/**
 * Sets all values of a vertex to NaN if one component is not finite, the main one included. Returns
 * the number of such vertices.
 */
std::int64_t MarkUnknown(const VolumeInput& input, const InputBlocks& parts, int components,
  std::vector<glm::vec3>& values)
{
  const std::vector<std::int32_t>& points = input.GetMesh().GetSourcePoints();
  std::vector<ConcatenatedArray> valuesOf;
  for (int c = 0; c < components; ++c)
  {
    valuesOf.emplace_back(parts, c, input.GetInterpolatedPoints(FieldAssociation::Points));
  }
  std::atomic<std::int64_t> unknown(0);
  ForEachItem(points.size(), PointLoop,
    [&](std::size_t v)
    {
      bool known = true;
      for (const ConcatenatedArray& valueOf : valuesOf)
      {
        known = known && std::isfinite(valueOf(points[v]));
      }
      if (!known)
      {
        values[v] = glm::vec3(NotANumber);
        ++unknown;
      }
    });
  return unknown;
}

}

//------------------------------------------------------------------------------
int MainComponent(ComponentMixture mixture)
{
  switch (mixture)
  {
    case ComponentMixture::ColorAndOpacity:
      return 1;
    case ComponentMixture::RedGreenBlueOpacity:
      return 3;
    default:
      return 0;
  }
}

//------------------------------------------------------------------------------
InputReport VolumeComponents::Update(const VolumeInput& input, const InputBlocks& parts,
  ComponentMixture mixture, const FunctionFeatures& features)
{
  const TableVersions versions{ input.GetBuildVersion(), input.GetScalarVersion() };
  const bool same =
    mixture == this->Mixture && (mixture == ComponentMixture::None || this->BuiltInput == versions);
  const TetrahedralMesh& mesh = input.GetMesh();
  InputReport report;
  if (same)
  {
    if (this->BuiltFeatures != features.Version && this->ChooseNormalizations(features, true))
    {
      this->Version.Bump();
      this->TakeScalars(input, parts);
      MarkUnknown(input, parts, this->NumberOfComponents, this->Values);
    }
    return report;
  }
  this->Mixture = mixture;
  this->BuiltInput = versions;
  this->NumberOfComponents =
    mixture == ComponentMixture::None ? 1 : parts.Parts.front().Scalars->GetNumberOfComponents();
  this->Values.clear();
  this->Others = OtherScalars(mixture, this->NumberOfComponents);
  this->Version.Bump();
  if (mixture == ComponentMixture::None)
  {
    return report;
  }
  this->Values.assign(mesh.GetSourcePoints().size(), glm::vec3(0.0f));
  if (mixture == ComponentMixture::RedGreenBlueOpacity)
  {
    this->TakeColors(input, parts);
  }
  for (std::size_t other = 0; other < this->Others.size(); ++other)
  {
    this->Distributions[other] =
      FiniteValues(GatherValues(parts, this->Others[other], mesh.GetSourcePoints(),
                     input.GetInterpolatedPoints(FieldAssociation::Points)))
        .Distribution;
  }
  this->ChooseNormalizations(features, false);
  this->TakeScalars(input, parts);
  const std::int64_t unknown = MarkUnknown(input, parts, this->NumberOfComponents, this->Values);
  if (unknown > 0)
  {
    report.Warning = std::to_string(unknown) + " of " + std::to_string(this->Values.size()) +
      " vertices have a component that is not finite; cells that use them are transparent.";
  }
  return report;
}

//------------------------------------------------------------------------------
/**
 * @param keep true: the present normalisations are kept as long as they are good enough.
 * @return true if one has changed.
 */
bool VolumeComponents::ChooseNormalizations(const FunctionFeatures& features, bool keep)
{
  bool changed = false;
  for (std::size_t other = 0; other < this->Others.size(); ++other)
  {
    ScalarNormalization& normalization = this->Normalizations[other];
    const ScalarNormalization chosen = ChooseNormalization(
      this->Distributions[other], features.Of(other + 1), keep ? &normalization : nullptr);
    changed = changed || chosen != normalization;
    normalization = chosen;
  }
  this->BuiltFeatures = features.Version;
  return changed;
}

//------------------------------------------------------------------------------
void VolumeComponents::TakeScalars(const VolumeInput& input, const InputBlocks& parts)
{
  const std::vector<std::int32_t>& points = input.GetMesh().GetSourcePoints();
  for (std::size_t other = 0; other < this->Others.size(); ++other)
  {
    const ConcatenatedArray valueOf(
      parts, this->Others[other], input.GetInterpolatedPoints(FieldAssociation::Points));
    const ScalarNormalization& normalization = this->Normalizations[other];
    const auto at = static_cast<int>(other);
    ForEachItem(points.size(), PointLoop,
      [&](std::size_t v)
      { this->Values[v][at] = static_cast<float>(normalization(valueOf(points[v]))); });
  }
}

//------------------------------------------------------------------------------
void VolumeComponents::TakeColors(const VolumeInput& input, const InputBlocks& parts)
{
  const std::vector<std::int32_t>& points = input.GetMesh().GetSourcePoints();
  const WeightedPoints* interpolated = input.GetInterpolatedPoints(FieldAssociation::Points);
  const double scale = 1.0 / FullIntensity(parts);
  const ConcatenatedArray red(parts, 0, interpolated);
  const ConcatenatedArray green(parts, 1, interpolated);
  const ConcatenatedArray blue(parts, 2, interpolated);
  ForEachItem(points.size(), PointLoop,
    [&](std::size_t v)
    {
      const glm::dvec3 color(red(points[v]), green(points[v]), blue(points[v]));
      this->Values[v] = glm::vec3(glm::clamp(scale * color, 0.0, 1.0));
    });
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/VolumePropertyTables.h"

#include "Rendering/Property/RayCastOptics.h"

#include "vtkContourValues.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

namespace meniscus
{
namespace
{

OpacityMeaning MeaningOf(int blendMode, bool perUnitDistance)
{
  switch (blendMode)
  {
    case vtkVolumeMapper::COMPOSITE_BLEND:
      return perUnitDistance ? OpacityMeaning::AlphaPerUnitDistance : OpacityMeaning::Attenuation;
    case vtkVolumeMapper::ADDITIVE_BLEND:
      return OpacityMeaning::Attenuation;
    default:
      return OpacityMeaning::Alpha;
  }
}

/**
 * Creates the property's default functions. VTK creates them on first access, which would change
 * the property's time later.
 */
void MakeDefaultFunctions(vtkVolumeProperty* property, int components)
{
  for (int component = 0; component < components; ++component)
  {
    property->GetScalarOpacity(component);
    if (property->GetColorChannels(component) == 1)
    {
      property->GetGrayTransferFunction(component);
    }
    else
    {
      property->GetRGBTransferFunction(component);
    }
  }
}

/** Number of components whose functions are used. */
int NumberOfUsedComponents(ComponentMixture mixture, int components)
{
  return mixture == ComponentMixture::Independent ? components : 1;
}

std::vector<TransferFunctionPoint> ReduceWeighted(
  vtkVolumeProperty* property, int component, OpacityMeaning meaning)
{
  std::vector<TransferFunctionPoint> points = ReducePropertyToPoints(property, component, meaning);
  for (TransferFunctionPoint& point : points)
  {
    point.Attenuation *= property->GetComponentWeight(component);
  }
  return points;
}

}

//------------------------------------------------------------------------------
void VolumePropertyTables::Reduce(vtkVolumeProperty* property, int blendMode, bool perUnitDistance,
  ComponentMixture mixture, int components)
{
  MakeDefaultFunctions(property, NumberOfUsedComponents(mixture, components));
  const ObjectVersion version(property);
  const ObjectVersion isovalues(property->GetIsoSurfaceValues());
  const OpacityMeaning meaning = MeaningOf(blendMode, perUnitDistance);
  const bool reduced = version == this->BuiltProperty && isovalues == this->BuiltIsovalues &&
    meaning == this->BuiltMeaning && blendMode == this->BuiltBlendMode &&
    mixture == this->BuiltMixture && components == this->BuiltNumberOfComponents;
  if (!reduced)
  {
    this->ReduceProperty(property, blendMode, meaning, mixture, components);
    this->BuiltProperty = version;
    this->BuiltIsovalues = isovalues;
    this->BuiltMeaning = meaning;
    this->BuiltBlendMode = blendMode;
    this->BuiltMixture = mixture;
    this->BuiltNumberOfComponents = components;
    this->FindFeatures();
  }
}

//------------------------------------------------------------------------------
void VolumePropertyTables::Normalize(
  const ScalarNormalization& normalization, const VolumeComponents& components)
{
  const TableVersions versions{ this->PointVersion, components.GetVersion() };
  if (versions != this->BuiltVersions || normalization != this->BuiltNormalization)
  {
    this->NormalizeTables(normalization, components);
    this->BuiltNormalization = normalization;
    this->BuiltVersions = versions;
    this->Version.Bump();
  }
}

//------------------------------------------------------------------------------
void VolumePropertyTables::ReduceProperty(vtkVolumeProperty* property, int blendMode,
  OpacityMeaning meaning, ComponentMixture mixture, int components)
{
  this->PointVersion.Bump();
  this->OtherPoints.clear();
  switch (mixture)
  {
    case ComponentMixture::Independent:
      this->Points = ReduceWeighted(property, 0, meaning);
      for (int component = 1; component < components; ++component)
      {
        this->OtherPoints.push_back(ReduceWeighted(property, component, meaning));
      }
      break;
    case ComponentMixture::ColorAndOpacity:
      this->Points = ReducePropertyToPoints(property, 0, meaning);
      this->OtherPoints.push_back(this->Points);
      break;
    default:
      this->Points = ReducePropertyToPoints(property, 0, meaning);
  }
  this->HasGradientOpacity =
    blendMode == vtkVolumeMapper::COMPOSITE_BLEND && UsesGradientOpacity(property);
  this->GradientPoints.clear();
  if (this->HasGradientOpacity)
  {
    this->GradientPoints = ReduceGradientOpacityToPoints(property);
  }
  this->SurfacePoints.clear();
  if (blendMode == vtkVolumeMapper::ISOSURFACE_BLEND)
  {
    vtkContourValues* values = property->GetIsoSurfaceValues();
    for (int i = 0; i < values->GetNumberOfContours(); ++i)
    {
      this->SurfacePoints.push_back(EvaluateProperty(property, values->GetValue(i)));
    }
  }
}

//------------------------------------------------------------------------------
void VolumePropertyTables::FindFeatures()
{
  this->Features.Version = this->PointVersion;
  this->Features.OfScalars.assign(1, FeaturesOf(this->Points));
  if (this->BuiltBlendMode == vtkVolumeMapper::ISOSURFACE_BLEND)
  {
    this->Features.OfScalars[0].clear();
    for (const TransferFunctionPoint& point : this->SurfacePoints)
    {
      this->Features.OfScalars[0].push_back({ point.Scalar, 0.0 });
    }
  }
  for (const auto& points : this->OtherPoints)
  {
    this->Features.OfScalars.push_back(FeaturesOf(points));
  }
}

//------------------------------------------------------------------------------
void VolumePropertyTables::NormalizeTables(
  const ScalarNormalization& normalization, const VolumeComponents& components)
{
  this->Intervals = BuildIntervals(this->Points, normalization);
  this->OtherIntervals.clear();
  for (const auto& points : this->OtherPoints)
  {
    const int other = static_cast<int>(this->OtherIntervals.size());
    this->OtherIntervals.push_back(BuildIntervals(points, components.GetNormalization(other)));
  }
  this->GradientIntervals.clear();
  if (this->HasGradientOpacity)
  {
    this->GradientIntervals = BuildIntervals(this->GradientPoints, ScalarNormalization());
  }
  this->Isosurfaces.clear();
  for (const TransferFunctionPoint& point : this->SurfacePoints)
  {
    const double scalar = normalization(point.Scalar);
    // No isosurface is met outside the range of the data, and NaN is not a value.
    if (scalar >= -1.0 && scalar <= 1.0)
    {
      this->Isosurfaces.push_back({ static_cast<float>(scalar),
        static_cast<float>(std::clamp(point.Attenuation, 0.0, 1.0)), glm::vec3(point.Color) });
    }
  }
  std::sort(this->Isosurfaces.begin(), this->Isosurfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Scalar < b.Scalar; });
  const auto end = std::unique(this->Isosurfaces.begin(), this->Isosurfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Scalar == b.Scalar; });
  this->Isosurfaces.erase(end, this->Isosurfaces.end());
}

//------------------------------------------------------------------------------
std::vector<VisibleScalars> VolumePropertyTables::GetVisibleOthers() const
{
  std::vector<VisibleScalars> visible;
  for (const auto& intervals : this->OtherIntervals)
  {
    if (this->BuiltMixture == ComponentMixture::Independent)
    {
      visible.emplace_back();
      visible.back().AddAttenuation(intervals);
    }
  }
  return visible;
}

//------------------------------------------------------------------------------
VisibleScalars VolumePropertyTables::GetVisibleScalars() const
{
  VisibleScalars visible;
  switch (this->BuiltBlendMode)
  {
    case vtkVolumeMapper::COMPOSITE_BLEND:
      visible.AddAttenuation(this->Intervals);
      return visible;
    case vtkVolumeMapper::ISOSURFACE_BLEND:
      for (const Isosurface& surface : this->Isosurfaces)
      {
        visible.AddIsovalue(surface.Scalar);
      }
      return visible;
    default:
      return VisibleScalars::All();
  }
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/VolumePropertyTables.h"

#include "Rendering/Property/FiniteFunctions.h"
#include "Rendering/Property/RayCastOptics.h"

#include "vtkContourValues.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <string>

namespace meniscus
{
namespace
{

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

PropertyPoints ReduceWeighted(vtkVolumeProperty* property, int component, OpacityMeaning meaning)
{
  PropertyPoints reduced = ReducePropertyToPoints(property, component, meaning);
  for (TransferFunctionPoint& point : reduced.Points)
  {
    point.Attenuation *= property->GetComponentWeight(component);
  }
  return reduced;
}

}

//------------------------------------------------------------------------------
InputReport VolumePropertyTables::Reduce(vtkVolumeProperty* property, BlendMode mode,
  bool perUnitDistance, ComponentMixture mixture, int components)
{
  MakeDefaultFunctions(property, NumberOfUsedComponents(mixture, components));
  const ObjectVersion version(property);
  const ObjectVersion isovalues(property->GetIsoSurfaceValues());
  const OpacityMeaning meaning = OpacityMeaningOf(mode, perUnitDistance);
  const bool reduced = version == this->BuiltProperty && isovalues == this->BuiltIsovalues &&
    meaning == this->BuiltMeaning && mode == this->BuiltMode && mixture == this->BuiltMixture &&
    components == this->BuiltNumberOfComponents;
  if (!reduced)
  {
    this->ReduceProperty(property, mode, meaning, mixture, components);
    this->BuiltProperty = version;
    this->BuiltIsovalues = isovalues;
    this->BuiltMeaning = meaning;
    this->BuiltMode = mode;
    this->BuiltMixture = mixture;
    this->BuiltNumberOfComponents = components;
    this->FindFeatures();
    const std::string told = this->Report.Warning;
    this->Report = this->Check(property);
    return { this->Report.Error, this->Report.Warning == told ? "" : this->Report.Warning };
  }
  return { this->Report.Error, std::string() };
}

//------------------------------------------------------------------------------
/** Report of the functions that are used. */
InputReport VolumePropertyTables::Check(vtkVolumeProperty* property) const
{
  InputReport report;
  const int functions = NumberOfUsedComponents(this->BuiltMixture, this->BuiltNumberOfComponents);
  for (int component = 0; component < functions; ++component)
  {
    const InputReport found = CheckFunctions(property, component, this->BuiltMeaning);
    const std::string where =
      functions > 1 ? "Component " + std::to_string(component) + ": " : std::string();
    if (report.Error.empty() && !found.Error.empty())
    {
      report.Error = where + found.Error;
    }
    if (!found.Warning.empty())
    {
      report.Warning += (report.Warning.empty() ? "" : " ") + where + found.Warning;
    }
  }
  if (GetBlendModel(this->BuiltMode).Visible == VisibleBy::Isovalues)
  {
    report.Warning += CheckIsovalues(property);
  }
  return report;
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
void VolumePropertyTables::ReduceProperty(vtkVolumeProperty* property, BlendMode mode,
  OpacityMeaning meaning, ComponentMixture mixture, int components)
{
  this->PointVersion.Bump();
  this->Others.clear();
  switch (mixture)
  {
    case ComponentMixture::Independent:
      this->Main = ReduceWeighted(property, 0, meaning);
      for (int component = 1; component < components; ++component)
      {
        this->Others.push_back(ReduceWeighted(property, component, meaning));
      }
      break;
    case ComponentMixture::ColorAndOpacity:
      this->Main = ReducePropertyToPoints(property, 0, meaning);
      this->Others.push_back(this->Main);
      break;
    default:
      this->Main = ReducePropertyToPoints(property, 0, meaning);
  }
  this->HasGradientOpacity = GetBlendModel(mode).IsMedium() && UsesGradientOpacity(property);
  this->GradientPoints.clear();
  if (this->HasGradientOpacity)
  {
    this->GradientPoints = ReduceGradientOpacityToPoints(property);
  }
  this->SurfacePoints.clear();
  if (GetBlendModel(mode).Visible == VisibleBy::Isovalues)
  {
    vtkContourValues* values = property->GetIsoSurfaceValues();
    std::vector<double> scalars;
    for (int i = 0; i < values->GetNumberOfContours(); ++i)
    {
      scalars.push_back(values->GetValue(i));
    }
    this->SurfacePoints = EvaluateProperty(property, scalars);
  }
}

//------------------------------------------------------------------------------
void VolumePropertyTables::FindFeatures()
{
  this->Features.Version = this->PointVersion;
  this->Features.OfScalars.assign(1, this->Main.Features);
  if (GetBlendModel(this->BuiltMode).Visible == VisibleBy::Isovalues)
  {
    this->Features.OfScalars[0].clear();
    for (const TransferFunctionPoint& point : this->SurfacePoints)
    {
      this->Features.OfScalars[0].push_back({ point.Scalar, 0.0 });
    }
  }
  for (const PropertyPoints& other : this->Others)
  {
    this->Features.OfScalars.push_back(other.Features);
  }
}

//------------------------------------------------------------------------------
void VolumePropertyTables::NormalizeTables(
  const ScalarNormalization& normalization, const VolumeComponents& components)
{
  this->Intervals = BuildIntervals(this->Main.Points, normalization);
  this->OtherIntervals.clear();
  for (const PropertyPoints& function : this->Others)
  {
    const int other = static_cast<int>(this->OtherIntervals.size());
    this->OtherIntervals.push_back(
      BuildIntervals(function.Points, components.GetNormalization(other)));
  }
  this->GradientIntervals.clear();
  if (this->HasGradientOpacity)
  {
    this->GradientIntervals = BuildIntervals(this->GradientPoints, ScalarNormalization());
  }
  this->Isosurfaces.clear();
  for (std::size_t i = 0; i < this->SurfacePoints.size(); ++i)
  {
    const TransferFunctionPoint& point = this->SurfacePoints[i];
    const double scalar = normalization(point.Scalar);
    // No isosurface is met outside the range of the data, and NaN is not a value.
    if (scalar >= -1.0 && scalar <= 1.0)
    {
      this->Isosurfaces.push_back(
        { static_cast<float>(scalar), static_cast<float>(std::clamp(point.Attenuation, 0.0, 1.0)),
          glm::vec3(point.Color), static_cast<std::int32_t>(i) });
    }
  }
  std::stable_sort(this->Isosurfaces.begin(), this->Isosurfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Scalar < b.Scalar; });
  const auto end = std::unique(this->Isosurfaces.begin(), this->Isosurfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Scalar == b.Scalar; });
  this->Isosurfaces.erase(end, this->Isosurfaces.end());
}

//------------------------------------------------------------------------------
PictureFunction VolumePropertyTables::GetPictureFunction() const
{
  PictureFunction function;
  if (this->BuiltMixture != ComponentMixture::None)
  {
    return function;
  }
  const BlendModel& model = GetBlendModel(this->BuiltMode);
  const bool hasSurfaces = model.Visible == VisibleBy::Isovalues;
  function.Use = hasSurfaces ? ScalarUse::Surfaces
    : model.IsMedium()       ? ScalarUse::Medium
                             : ScalarUse::Colors;
  function.Points = hasSurfaces ? this->SurfacePoints : this->Main.Points;
  function.Version = this->PointVersion;
  return function;
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
  switch (GetBlendModel(this->BuiltMode).Visible)
  {
    case VisibleBy::Attenuation:
      visible.AddAttenuation(this->Intervals);
      return visible;
    case VisibleBy::Isovalues:
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

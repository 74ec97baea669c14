// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumePropertyTables.h"

#include "RayCastOptics.h"

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

/** A property without functions makes default ones when asked: ask before taking its time. */
void MakeDefaultFunctions(vtkVolumeProperty* property)
{
  property->GetScalarOpacity(0);
  if (property->GetColorChannels(0) == 1)
  {
    property->GetGrayTransferFunction(0);
  }
  else
  {
    property->GetRGBTransferFunction(0);
  }
}

}

//------------------------------------------------------------------------------
void VolumePropertyTables::Update(vtkVolumeProperty* property, int blendMode, bool perUnitDistance,
  const ScalarNormalization& normalization)
{
  MakeDefaultFunctions(property);
  const ObjectVersion version(property);
  const ObjectVersion isovalues(property->GetIsoSurfaceValues());
  const OpacityMeaning meaning = MeaningOf(blendMode, perUnitDistance);
  const bool reduced = version == this->BuiltProperty && isovalues == this->BuiltIsovalues &&
    meaning == this->BuiltMeaning && blendMode == this->BuiltBlendMode;
  if (!reduced)
  {
    this->ReduceProperty(property, blendMode, meaning);
    this->BuiltProperty = version;
    this->BuiltIsovalues = isovalues;
    this->BuiltMeaning = meaning;
    this->BuiltBlendMode = blendMode;
  }
  if (!reduced || normalization != this->BuiltNormalization)
  {
    this->NormalizeTables(normalization);
    this->BuiltNormalization = normalization;
    ++this->Version;
  }
}

//------------------------------------------------------------------------------
void VolumePropertyTables::ReduceProperty(
  vtkVolumeProperty* property, int blendMode, OpacityMeaning meaning)
{
  ++this->Builds;
  this->Points = ReducePropertyToPoints(property, meaning);
  this->GradientPoints.clear();
  if (blendMode == vtkVolumeMapper::COMPOSITE_BLEND && UsesGradientOpacity(property))
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
void VolumePropertyTables::NormalizeTables(const ScalarNormalization& normalization)
{
  this->Intervals = BuildIntervals(this->Points, normalization);
  this->GradientIntervals.clear();
  if (!this->GradientPoints.empty())
  {
    this->GradientIntervals = BuildIntervals(this->GradientPoints, ScalarNormalization());
  }
  this->Isosurfaces.clear();
  for (const TransferFunctionPoint& point : this->SurfacePoints)
  {
    const double scalar = (point.Scalar - normalization.Offset) * normalization.Scale;
    // Nothing is met beyond the data, and a NaN is no value.
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

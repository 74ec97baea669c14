// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OpticsTruth.h"

#include <vtkLightCollection.h>

namespace meniscus::test
{

//------------------------------------------------------------------------------
reference::ReferenceTransferFunction ToAlphas(vtkVolumeProperty* property)
{
  vtkNew<vtkVolumeProperty> copy;
  copy->DeepCopy(property);
  copy->SetScalarOpacityUnitDistance(1.0);
  return ToReference(copy);
}

//------------------------------------------------------------------------------
reference::ReferenceTransferFunction FunctionOf(
  const ProjectionMode& mode, vtkVolumeProperty* property)
{
  return mode.OpacityPerDistance ? ToReference(property) : ToAlphas(property);
}

//------------------------------------------------------------------------------
reference::Material ToMaterial(vtkVolumeProperty* property, vtkRenderer* renderer)
{
  reference::Material material;
  material.Ambient = property->GetAmbient();
  material.Diffuse = property->GetDiffuse();
  material.Specular = property->GetSpecular();
  material.Power = property->GetSpecularPower();
  vtkLightCollection* lights = renderer->GetLights();
  lights->InitTraversal();
  while (vtkLight* source = lights->GetNextItem())
  {
    if (!source->GetSwitch())
    {
      continue;
    }
    reference::Light light;
    double position[3];
    double focus[3];
    source->GetTransformedPosition(position);
    source->GetTransformedFocalPoint(focus);
    for (int i = 0; i < 3; ++i)
    {
      light.Diffuse[i] = source->GetIntensity() * source->GetDiffuseColor()[i];
      light.Specular[i] = source->GetIntensity() * source->GetSpecularColor()[i];
      light.Axis[i] = focus[i] - position[i];
      light.Place[i] = source->GetPositional() ? position[i] : -light.Axis[i];
      light.Falloff[i] = source->GetAttenuationValues()[i];
    }
    light.Positional = source->GetPositional() != 0;
    if (light.Positional && source->GetConeAngle() < 90.0)
    {
      light.ConeCosine = std::cos(vtkMath::RadiansFromDegrees(source->GetConeAngle()));
      light.Exponent = source->GetExponent();
    }
    material.Lights.push_back(light);
  }
  return material;
}

//------------------------------------------------------------------------------
std::vector<reference::Surface> ToSurfaces(vtkVolumeProperty* property)
{
  const reference::ReferenceTransferFunction alphas = ToAlphas(property);
  std::vector<reference::Surface> surfaces;
  vtkContourValues* values = property->GetIsoSurfaceValues();
  for (int i = 0; i < values->GetNumberOfContours(); ++i)
  {
    const reference::OpticalSample sample = alphas.GetValue(values->GetValue(i));
    surfaces.push_back({ values->GetValue(i), sample.Attenuation, sample.Color });
  }
  return surfaces;
}

//------------------------------------------------------------------------------
TracedComparison ExpectTrace(RayCastScene& scene, const TraceRay& trace, const std::string& what,
  double tolerance, double excusedShare)
{
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  const double diagonal = scene.GetVolume()->GetLength();
  const TracedComparison comparison =
    CompareToTrace(image, rays, trace, tolerance, RoundingDistance * diagonal);
  SCOPED_TRACE(what + ": " + comparison.GetText());
  EXPECT_GT(comparison.Visible, 0u);
  EXPECT_EQ(comparison.Wrong, 0u);
  EXPECT_LE(static_cast<double>(comparison.Excused),
    std::max(1.0, excusedShare * static_cast<double>(comparison.Visible)));
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  ::testing::Test::RecordProperty(what, comparison.GetText());
  return comparison;
}

} // namespace meniscus::test

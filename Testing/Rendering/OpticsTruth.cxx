// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OpticsTruth.h"

#include <vtkContourValues.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMath.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace test
{

//------------------------------------------------------------------------------
reference::ReferenceTransferFunction toAlphas(vtkVolumeProperty* property)
{
  vtkNew<vtkVolumeProperty> copy;
  copy->DeepCopy(property);
  copy->SetScalarOpacityUnitDistance(1.0);
  return toReference(copy);
}

//------------------------------------------------------------------------------
reference::Material toMaterial(vtkVolumeProperty* property, vtkRenderer* renderer)
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
std::vector<reference::Surface> toSurfaces(vtkVolumeProperty* property)
{
  const reference::ReferenceTransferFunction alphas = toAlphas(property);
  std::vector<reference::Surface> surfaces;
  vtkContourValues* values = property->GetIsoSurfaceValues();
  for (int i = 0; i < values->GetNumberOfContours(); ++i)
  {
    const reference::OpticalSample sample = alphas.value(values->GetValue(i));
    surfaces.push_back({ values->GetValue(i), sample.Attenuation, sample.Color });
  }
  return surfaces;
}

//------------------------------------------------------------------------------
TracedComparison expectTrace(RayCastScene& scene, const TraceRay& trace, const std::string& what,
  double tolerance, double excusedShare)
{
  const FloatImage image = scene.renderFloat();
  const PixelRays rays(scene.renderer());
  const double diagonal = scene.volume()->GetLength();
  const TracedComparison comparison =
    compareToTrace(image, rays, trace, tolerance, RoundingDistance * diagonal);
  SCOPED_TRACE(what + ": " + comparison.text());
  EXPECT_GT(comparison.Visible, 0u);
  EXPECT_EQ(comparison.Wrong, 0u);
  EXPECT_LE(static_cast<double>(comparison.Excused),
    std::max(1.0, excusedShare * static_cast<double>(comparison.Visible)));
  EXPECT_EQ(scene.rayCaster()->GetNumberOfLostRays(), 0);
  testing::Test::RecordProperty(what, comparison.text());
  return comparison;
}

} // namespace test
} // namespace meniscus

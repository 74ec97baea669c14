// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/RayCastOptics.h"

#include "vtkCollection.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkRenderer.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

namespace meniscus
{
namespace
{

static_assert(static_cast<int>(BlendMode::Composite) == vtkVolumeMapper::COMPOSITE_BLEND &&
    static_cast<int>(BlendMode::MaximumIntensity) == vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND &&
    static_cast<int>(BlendMode::MinimumIntensity) == vtkVolumeMapper::MINIMUM_INTENSITY_BLEND &&
    static_cast<int>(BlendMode::AverageIntensity) == vtkVolumeMapper::AVERAGE_INTENSITY_BLEND &&
    static_cast<int>(BlendMode::Additive) == vtkVolumeMapper::ADDITIVE_BLEND &&
    static_cast<int>(BlendMode::Isosurfaces) == vtkVolumeMapper::ISOSURFACE_BLEND,
  "blend modes have VTK's numbers");

/** Converts view coordinates to the frame: depth is along -z. */
glm::dvec3 ToFrame(const glm::dvec3& view)
{
  return glm::dvec3(view.x, view.y, -view.z);
}

/** World length of a unit of the frame. */
double UnitOf(const RayFrame& frame)
{
  return glm::length(frame.ViewToWorld[0]);
}

RayCastLight ToFrame(vtkLight* source, const ViewContext& place)
{
  glm::dvec3 position;
  glm::dvec3 focus;
  source->GetTransformedPosition(&position[0]);
  source->GetTransformedFocalPoint(&focus[0]);
  const glm::dmat3 turn(place.WorldToView);
  const double unit = UnitOf(place.Frame);
  const double* diffuse = source->GetDiffuseColor();
  const double* specular = source->GetSpecularColor();

  RayCastLight light;
  light.Diffuse = source->GetIntensity() * glm::dvec3(diffuse[0], diffuse[1], diffuse[2]);
  light.Specular = source->GetIntensity() * glm::dvec3(specular[0], specular[1], specular[2]);
  const glm::dvec3 axis = glm::normalize(ToFrame(turn * (focus - position)));
  if (!source->GetPositional())
  {
    light.Position = glm::dvec4(-axis, 0.0);
    return light;
  }
  light.Position = glm::dvec4(ToFrame(turn * (position - place.CenterInWorld)) / unit, 1.0);
  const double* falloff = source->GetAttenuationValues();
  light.Falloff =
    glm::dvec4(falloff[0], falloff[1] * unit, falloff[2] * unit * unit, source->GetExponent());
  if (source->GetConeAngle() < 90.0)
  {
    light.Cone = glm::dvec4(axis, std::cos(vtkMath::RadiansFromDegrees(source->GetConeAngle())));
  }
  return light;
}

template <typename Vector>
bool IsFinite(const Vector& vector)
{
  // Infinity less itself is no number.
  return vector - vector == Vector(0.0);
}

bool IsFinite(const RayCastLight& light)
{
  return IsFinite(light.Position) && IsFinite(light.Diffuse) && IsFinite(light.Specular) &&
    IsFinite(light.Cone) && IsFinite(light.Falloff);
}

}

//------------------------------------------------------------------------------
bool UsesGradientOpacity(vtkVolumeProperty* property)
{
  if (!property->HasGradientOpacity() || property->GetDisableGradientOpacity() != 0)
  {
    return false;
  }
  // A copied property has a function that is 1 everywhere.
  vtkPiecewiseFunction* function = property->GetGradientOpacity(0);
  bool one = function->GetSize() > 0 && function->GetClamping() != 0;
  for (int i = 0; i < function->GetSize() && one; ++i)
  {
    double node[4];
    function->GetNodeValue(i, node);
    one = node[1] == 1.0;
  }
  return !one;
}

//------------------------------------------------------------------------------
bool operator==(const RayCastOptics& a, const RayCastOptics& b)
{
  const auto members = [](const RayCastOptics& optics)
  {
    return std::tie(optics.Blending, optics.CellScalars, optics.Components,
      optics.NumberOfFunctions, optics.DataRange, optics.PreIntegrated, optics.CompactCells,
      optics.WideCells, optics.NumberOfLegs, optics.LongLists, optics.Shading, optics.Illuminated,
      optics.GradientOpacity, optics.VertexGradients, optics.GradientToFrame,
      optics.GradientMagnitude, optics.Lighting, optics.ClippingPlanes, optics.Medium);
  };
  return members(a) == members(b);
}

//------------------------------------------------------------------------------
void GatherShading(vtkVolumeProperty* property, vtkRenderer* renderer, const ViewContext& place,
  RayCastOptics& optics)
{
  const bool hasGradients = optics.HasGradients();
  const bool isMedium = optics.Model().IsMedium();
  // Light that a medium scatters needs no normal.
  optics.Shading = property->GetShade() != 0 && optics.Model().IsLit() &&
    (hasGradients || optics.Illuminated || !isMedium);
  optics.GradientOpacity = isMedium && hasGradients && UsesGradientOpacity(property);
  if (!optics.UsesGradients())
  {
    return;
  }
  const RayFrame& frame = place.Frame;
  const glm::dmat3 rows(frame.RowX, frame.RowY, frame.RowDepth);
  optics.GradientToFrame = glm::inverse(rows); // the inverse of the transpose of the map
  optics.GradientMagnitude = 1.0 / (UnitOf(frame) * place.GradientScale);
  optics.Lighting.Ambient = property->GetAmbient();
  optics.Lighting.Diffuse = property->GetDiffuse();
  optics.Lighting.Specular = property->GetSpecular();
  optics.Lighting.SpecularPower = property->GetSpecularPower();
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator iterator;
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    if (optics.Shading && light->GetSwitch())
    {
      const RayCastLight own = ToFrame(light, place);
      optics.Lighting.Lights.push_back(IsFinite(own) ? own : RayCastLight());
      optics.HasUnusableLights |= !IsFinite(own);
    }
  }
}

//------------------------------------------------------------------------------
std::string DescribeUnlit(const RayCastOptics& optics)
{
  if (!optics.Shading)
  {
    return std::string();
  }
  std::ostringstream text;
  const SurfaceLighting& lighting = optics.Lighting;
  const std::pair<const char*, double> material[] = { { "Ambient", lighting.Ambient },
    { "Diffuse", lighting.Diffuse }, { "Specular", lighting.Specular },
    { "SpecularPower", lighting.SpecularPower }, { "ScatteringAnisotropy", lighting.Anisotropy } };
  for (const auto& [name, number] : material)
  {
    if (!std::isfinite(number))
    {
      text << "the " << name << " of the volume property is " << number
           << "; shading needs finite numbers";
      return text.str();
    }
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string GatherClippingPlanes(
  vtkPlaneCollection* planes, const ViewContext& place, RayCastOptics& optics)
{
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    vtkPlane* plane = planes->GetItem(i);
    glm::dvec3 normal;
    glm::dvec3 origin;
    plane->GetNormal(&normal[0]);
    plane->GetOrigin(&origin[0]);
    if (!IsFinite(normal) || !IsFinite(origin))
    {
      return "the origin or the normal of clipping plane " + std::to_string(i) + " is not finite";
    }
    optics.ClippingPlanes.push_back(
      ComputeClippingPlane(place.Frame, normal, glm::dot(normal, place.CenterInWorld - origin)));
  }
  return std::string();
}

}

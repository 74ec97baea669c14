// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/TrueSpaceLighting.h"

#include "Rendering/Common/Matrices.h"
#include "Rendering/Pass/PlateUniforms.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/** Relative rounding error of the numbers of the shader, which are floats. */
constexpr double Rounding = 1.0 / 16777216.0;

vtkPolyData* DataOf(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  return mapper ? vtkPolyData::SafeDownCast(mapper->GetInput()) : nullptr;
}

template <std::size_t Size, class Numbers>
std::array<float, Size> ToFloats(const Numbers& numbers)
{
  std::array<float, Size> floats;
  for (std::size_t i = 0; i < Size; ++i)
  {
    floats[i] = static_cast<float>(numbers[i]);
  }
  return floats;
}

/** Numbers that begin with a place, which becomes relative to an origin. */
template <std::size_t Size>
std::array<double, Size> Relative(std::array<double, Size> numbers, const glm::dvec3& origin)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    numbers[i] -= origin[static_cast<int>(i)];
  }
  return numbers;
}

//------------------------------------------------------------------------------
/**
 * True if the points of a surface are in a plane within the rounding errors of its points, and of
 * the floats in shaders, which are relative to a place near the surface. Its normals must equal the
 * plane's normal within the errors that this gives to normals of facets.
 */
bool LiesInPlane(vtkPolyData* surface, const double (&origin)[3], const double (&normal)[3])
{
  double bounds[6];
  surface->GetBounds(bounds);
  double reach = 0.0;
  double size = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    reach = std::max({ reach, std::fabs(bounds[2 * i]), std::fabs(bounds[2 * i + 1]) });
    size = std::max(size, 0.5 * (bounds[2 * i + 1] - bounds[2 * i]));
  }
  const bool areFloats = surface->GetPoints()->GetDataType() == VTK_FLOAT;
  const double rounding = areFloats ? Rounding : std::numeric_limits<double>::epsilon();
  const double slack = 4.0 * (rounding * reach + Rounding * size);
  const vtkIdType points = surface->GetNumberOfPoints();
  for (vtkIdType i = 0; i < points; ++i)
  {
    double place[3];
    surface->GetPoint(i, place);
    vtkMath::Subtract(place, origin, place);
    if (!(std::fabs(vtkMath::Dot(place, normal)) <= slack))
    {
      return false;
    }
  }
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  const double facet = surface->GetLength() / std::sqrt(static_cast<double>(points));
  for (vtkIdType i = 0; normals && i < points; ++i)
  {
    double own[3];
    double across[3];
    normals->GetTuple(i, own);
    vtkMath::Normalize(own);
    vtkMath::Cross(own, normal, across);
    if (!(vtkMath::Norm(across) * facet <= slack))
    {
      return false;
    }
  }
  return true;
}

}

//------------------------------------------------------------------------------
std::string TrueSpaceLighting::DescribeMissing(vtkActor* object)
{
  vtkPolyData* data = DataOf(object);
  // An output without points has no arrays and shows nothing.
  return !data || data->GetNumberOfPoints() == 0 || data->GetPointData()->HasArray("TruePosition")
    ? std::string()
    : "An object has no array TruePosition; turn on TrueGeometry of its filter";
}

//------------------------------------------------------------------------------
const TrueSpaceLighting::Fit& TrueSpaceLighting::FitOf(vtkPolyData* surface)
{
  Fit& fit = this->Fits[surface];
  if (surface && surface->GetNumberOfPoints() > 0 && fit.Time != surface->GetMTime())
  {
    vtkPlane::ComputeBestFittingPlane(surface->GetPoints(), fit.Origin, fit.Normal);
    fit.IsFlat = LiesInPlane(surface, fit.Origin, fit.Normal);
    fit.Time = surface->GetMTime();
  }
  return fit;
}

//------------------------------------------------------------------------------
std::vector<WaveSource> TrueSpaceLighting::ListWaveSources(vtkRefractedGeometryFilter* filter)
{
  bool isFlat = !filter->GetExactMembrane();
  const double* first = nullptr;
  for (int i = 0; isFlat && i < filter->GetNumberOfMembranes(); ++i)
  {
    const Fit& fit = this->FitOf(vtkPolyData::SafeDownCast(filter->GetInputDataObject(1, i)));
    first = first ? first : fit.Normal;
    double across[3];
    vtkMath::Cross(first, fit.Normal, across);
    isFlat = fit.IsFlat && vtkMath::Norm(across) <= std::sqrt(Rounding);
  }
  return isFlat ? std::vector<WaveSource>() : this->Waves;
}

//------------------------------------------------------------------------------
/** Finds the membrane's plane in world coordinates; its normal points to the eye. */
void TrueSpaceLighting::FitPlane(vtkActor* membrane)
{
  const Fit& fit = this->FitOf(DataOf(membrane));
  double place[4] = { fit.Origin[0], fit.Origin[1], fit.Origin[2], 1.0 };
  vtkMatrix4x4* matrix = membrane->GetMatrix();
  matrix->MultiplyPoint(place, place);
  // Normals are transformed by the cofactors: the inverse of the transpose, which a matrix has not
  // that makes things flat, times the determinant.
  const glm::dmat3 m(ToGlm(matrix));
  const glm::dmat3 cofactors(
    glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  glm::dvec3 normalInWorld = cofactors * glm::make_vec3(fit.Normal);
  double* const normal = &normalInWorld.x;
  vtkMath::Normalize(normal);
  const double height = vtkMath::Dot(normal, this->Eye.data()) - vtkMath::Dot(normal, place);
  const double sign = height < 0.0 ? -1.0 : 1.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->Plane[i] = sign * normal[i];
  }
  this->Plane[3] = -sign * vtkMath::Dot(normal, place);
  this->Reach = 0.0;
  if (const double* bounds = membrane->GetBounds())
  {
    for (int i = 0; i < 3; ++i)
    {
      this->Middle[i] = 0.5 * bounds[2 * i] + 0.5 * bounds[2 * i + 1];
      this->Reach = std::max(this->Reach, 0.5 * (bounds[2 * i + 1] - bounds[2 * i]));
    }
  }
}

//------------------------------------------------------------------------------
/** Height above the membrane of a light, or of the direction to it. */
double TrueSpaceLighting::HeightOf(const double (&position)[4]) const
{
  double height = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    height += this->Plane[i] * position[i];
  }
  return height;
}

//------------------------------------------------------------------------------
/**
 * True if the side of the surface on which a light is cannot be decided: its height is within the
 * rounding error of the sum of three products of floats, which are relative to a place behind the
 * membrane.
 */
bool TrueSpaceLighting::IsOnSurface(const double (&position)[4]) const
{
  double size = position[3] * this->Reach;
  for (int i = 0; i < 3; ++i)
  {
    size = std::max(size, std::fabs(position[i] - position[3] * this->Middle[i]));
  }
  return !(std::fabs(this->HeightOf(position)) > 4.0 * Rounding * size);
}

//------------------------------------------------------------------------------
/** Adds a light. Returns false if it is on the surface, or not finite. */
bool TrueSpaceLighting::Add(vtkLight* light)
{
  double position[4];
  double focus[3];
  double axis[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focus);
  vtkMath::Subtract(focus, position, axis);
  if (vtkMath::Normalize(axis) == 0.0 && !light->GetPositional())
  {
    return false;
  }
  const bool isPositional = light->GetPositional() != 0;
  position[3] = isPositional ? 1.0 : 0.0;
  for (int i = 0; i < 3; ++i)
  {
    position[i] = isPositional ? position[i] : -axis[i];
  }
  if (this->IsOnSurface(position))
  {
    return false;
  }
  const double* diffuse = light->GetDiffuseColor();
  const double color[3] = { light->GetIntensity() * diffuse[0], light->GetIntensity() * diffuse[1],
    light->GetIntensity() * diffuse[2] };
  const bool hasCone = isPositional && light->GetConeAngle() < 90.0;
  const double cone[4] = { axis[0], axis[1], axis[2],
    hasCone ? std::cos(vtkMath::RadiansFromDegrees(light->GetConeAngle())) : -2.0 };
  const double* values = light->GetAttenuationValues();
  const double falloff[4] = { values[0], values[1], values[2], light->GetExponent() };
  // The light of those that follow the camera would have to be computed for each frame.
  const bool isRead = this->HeightOf(position) > 0.0 && light->LightTypeIsSceneLight();
  const int table = isRead ? static_cast<int>(this->Waves.size()) : -1;
  this->Lights.push_back({ { position[0], position[1], position[2], position[3] },
    ToFloats<3>(color), ToFloats<4>(cone), ToFloats<4>(falloff), table });
  if (isRead)
  {
    this->Waves.push_back({ { position[0], position[1], position[2] }, isPositional });
  }
  return true;
}

//------------------------------------------------------------------------------
std::string TrueSpaceLighting::Update(vtkRenderer* renderer, vtkActor* membrane)
{
  renderer->GetActiveCamera()->GetPosition(this->Eye.data());
  this->FitPlane(membrane);
  this->Lights.clear();
  this->Waves.clear();
  this->Skipped = 0;
  int beyond = 0;
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator iterator;
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    if (!light->GetSwitch())
    {
      continue;
    }
    const bool hasRoom = this->Lights.size() < static_cast<std::size_t>(LargestNumber);
    beyond += hasRoom ? 0 : 1;
    this->Skipped += hasRoom && this->Add(light) ? 0 : 1;
  }
  std::string warning;
  if (beyond > 0)
  {
    warning = std::to_string(beyond) + " lights exceed the limit of " +
      std::to_string(LargestNumber) + "; they are left out";
  }
  else if (this->Skipped > 0)
  {
    warning = std::to_string(this->Skipped) +
      " lights are on the membrane's plane, along it or without a direction; they are left out";
  }
  return warning;
}

//------------------------------------------------------------------------------
void TrueSpaceLighting::SetUniforms(vtkShaderProgram* program, vtkActor* object,
  const std::vector<double>& indices, bool lightIsFaded, const glm::dvec3& origin) const
{
  if (!program->IsUniformUsed("surfacePlane"))
  {
    return;
  }
  std::vector<float> positions;
  std::vector<float> colors;
  std::vector<float> cones;
  std::vector<float> falloffs;
  std::vector<int> tables;
  const auto append = [](std::vector<float>& to, const auto& from)
  { to.insert(to.end(), from.begin(), from.end()); };
  for (const Light& light : this->Lights)
  {
    append(positions, ToFloats<4>(Relative(light.Position, light.Position[3] * origin)));
    append(colors, light.Color);
    append(cones, light.Cone);
    append(falloffs, light.Falloff);
    tables.push_back(light.Table);
  }
  const int number = static_cast<int>(this->Lights.size());
  program->SetUniformi("trueLights", number);
  if (number > 0)
  {
    program->SetUniform4fv("trueLightPosition", number, positions.data());
    program->SetUniform3fv("trueLightColor", number, colors.data());
    program->SetUniform4fv("trueLightCone", number, cones.data());
    program->SetUniform4fv("trueLightFalloff", number, falloffs.data());
    if (program->IsUniformUsed("trueLightTable"))
    {
      program->SetUniform1iv("trueLightTable", number, tables.data());
    }
  }
  vtkProperty* property = object->GetProperty();
  const double* color = property->GetSpecularColor();
  const double share = property->GetSpecular();
  const double specular[3] = { share * color[0], share * color[1], share * color[2] };
  std::array<double, 4> plane = this->Plane;
  for (std::size_t i = 0; i < 3; ++i)
  {
    plane[3] += plane[i] * origin[static_cast<int>(i)];
  }
  program->SetUniform4f("surfacePlane", ToFloats<4>(plane).data());
  program->SetUniformf("surfaceIndex", static_cast<float>(indices.back()));
  SetPlateUniforms(program, indices);
  program->SetUniform3f("trueEye", ToFloats<3>(Relative(this->Eye, origin)).data());
  program->SetUniform3f("trueSpecular", ToFloats<3>(specular).data());
  program->SetUniformf("trueSpecularPower", static_cast<float>(property->GetSpecularPower()));
  program->SetUniformi("lightIsFaded", lightIsFaded ? 1 : 0);
}

}

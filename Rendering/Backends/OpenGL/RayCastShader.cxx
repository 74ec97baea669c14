// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/RayCastShader.h"
#include "Rendering/Backends/OpenGL/ShaderConstants.h"
#include "Rendering/Property/MediumUniforms.h"

#include "TetrahedraShaderParts.h"

#include "vtkShaderProgram.h"

#include <glm/gtc/type_ptr.hpp>

#include <sstream>
#include <vector>

namespace meniscus
{
namespace
{

/** Optical model of a blend mode, for a scene without variants of its own. */
const char* PartOf(BlendMode mode)
{
  switch (mode)
  {
#define MENISCUS_PART(name, number, label, model, part, ...)                                       \
  case BlendMode::name:                                                                            \
    return vtkTetrahedra##part;
    MENISCUS_BLEND_MODES(MENISCUS_PART)
#undef MENISCUS_PART
  }
  return "";
}

/** The parts that make the optical model of a scene, each after those that it uses. */
std::string ModelSource(const RayCastOptics& optics)
{
  const BlendModel& model = optics.Model();
  std::string source = model.HidesBehind() ? vtkTetrahedraFrontToBack : "";
  if (optics.PreIntegrated)
  {
    return source + vtkTetrahedraPreIntegrated;
  }
  if (model.Visible != VisibleBy::Isovalues && !optics.HasComponents())
  {
    source += vtkTetrahedraTransferFunction;
  }
  source += optics.UsesGradients() ? vtkTetrahedraLights : "";
  if (optics.IsFaded() && optics.IsRefracting())
  {
    source += std::string(vtkMediumTransmittance) + vtkTetrahedraFading;
  }
  source += model.IsMedium() ? vtkTetrahedraMedium : "";
  return source + (optics.HasComponents() ? vtkTetrahedraComponents : PartOf(model.Mode));
}

/** An array of uniforms, one per item; none if there are no items. */
template <typename Item, typename Value>
std::vector<float> Collect(const std::vector<Item>& items, Value Item::*member)
{
  std::vector<float> values;
  for (const Item& item : items)
  {
    const Value& value = item.*member;
    for (int i = 0; i < Value::length(); ++i)
    {
      values.push_back(static_cast<float>(value[i]));
    }
  }
  return values;
}

}

//------------------------------------------------------------------------------
std::string DescribeExcess(const RayCastOptics& optics)
{
  const auto describe = [](std::size_t number, std::size_t maximum, const char* what)
  {
    return number <= maximum
      ? std::string()
      : std::to_string(number) + " " + what + " exceed the limit of " + std::to_string(maximum);
  };
  const std::string planes =
    describe(optics.ClippingPlanes.size(), MaximumNumberOfClippingPlanes, "clipping planes");
  return planes.empty() ? describe(optics.Lighting.Lights.size(), MaximumNumberOfLights, "lights")
                        : planes;
}

//------------------------------------------------------------------------------
std::string RayCastShaderOptions(const RayCastOptics& optics)
{
  std::ostringstream text;
  const auto define = [&text](const char* name, int value)
  { text << "#define " << name << " " << value << "\n"; };
  define("BLEND_MODE", static_cast<int>(optics.Blending));
  define("SEES_JUMPS", optics.Model().SeesJumps() ? 1 : 0);
  define("PRE_INTEGRATED", optics.PreIntegrated ? 1 : 0);
  define("SHADING", optics.Shading ? 1 : 0);
  define("GRADIENT_OPACITY", optics.GradientOpacity ? 1 : 0);
  define("VERTEX_GRADIENTS", optics.VertexGradients ? 1 : 0);
  define("CELL_GRADIENTS", optics.UsesCellGradients() ? 1 : 0);
  define("NUMBER_OF_LEGS", optics.NumberOfLegs);
  define("REFRACTED", optics.IsRefracting() ? 1 : 0);
  define("LONG_LISTS", optics.LongLists ? 1 : 0);
  define("COMPACT_CELLS", optics.CompactCells ? 1 : 0);
  define("WIDE_CELLS", optics.WideCells ? 1 : 0);
  define("CELL_SCALARS", optics.CellScalars ? 1 : 0);
  define("VERTEX_COMPONENTS", optics.HasComponents() ? 1 : 0);
  // A medium interpolates the light between all vertices, isosurfaces between those before them.
  const bool mediumLight = optics.Illuminated && optics.Model().IsMedium();
  define("VERTEX_LIGHT", optics.Illuminated ? 1 : 0);
  define("MEDIUM_LIGHT", mediumLight ? 1 : 0);
  define("VERTEX_VALUES",
    (optics.VertexGradients ? 1 : 0) + (mediumLight ? 1 : 0) + (optics.HasComponents() ? 1 : 0));
  define("COMPONENT_MIXTURE", static_cast<int>(optics.Components));
  define("NUMBER_OF_FUNCTIONS", optics.NumberOfFunctions);
  const bool faded = optics.IsFaded() && optics.IsRefracting();
  define("FADED", faded ? 1 : 0);
  define("NEEDS_POSITION", optics.UsesGradients() || faded ? 1 : 0);
  define("NUMBER_OF_LIGHTS", static_cast<int>(optics.Lighting.Lights.size()));
  define("NUMBER_OF_CLIPPING_PLANES", static_cast<int>(optics.ClippingPlanes.size()));
  return text.str();
}

//------------------------------------------------------------------------------
std::string RayCastShaderSource(const char* mainShader, const RayCastOptics& optics)
{
  std::string source(mainShader);
  vtkShaderProgram::Substitute(
    source, "//VTK::TetrahedraOptions::Dec", ShaderConstants() + RayCastShaderOptions(optics));
  vtkShaderProgram::Substitute(source, "//VTK::TetrahedraRays::Dec", vtkTetrahedraRays);
  vtkShaderProgram::Substitute(source, "//VTK::TetrahedraWalk::Dec", vtkTetrahedraWalk);
  vtkShaderProgram::Substitute(source, "//VTK::TetrahedraLegs::Dec", vtkTetrahedraLegs);
  vtkShaderProgram::Substitute(source, "//VTK::TetrahedraEntries::Dec", vtkTetrahedraEntries);
  vtkShaderProgram::Substitute(source, "//VTK::TetrahedraEntryTiles::Dec", vtkTetrahedraEntryTiles);
  vtkShaderProgram::Substitute(source, "//VTK::TetrahedraModel::Dec", ModelSource(optics));
  return source;
}

//------------------------------------------------------------------------------
std::string EntryListerSource(const char* mainShader, int legs, bool behind)
{
  RayCastOptics optics;
  optics.NumberOfLegs = legs;
  std::string source = RayCastShaderSource(mainShader, optics);
  vtkShaderProgram::Substitute(
    source, "//VTK::TetrahedraBehind::Dec", behind ? "#define BEHIND 1" : "#define BEHIND 0");
  return source;
}

//------------------------------------------------------------------------------
void SetOpticsUniforms(vtkShaderProgram* program, const RayCastOptics& optics)
{
  const auto set3 = [program](const char* name, const std::vector<float>& values)
  { program->SetUniform3fv(name, static_cast<int>(values.size() / 3), values.data()); };
  const auto set4 = [program](const char* name, const std::vector<float>& values)
  { program->SetUniform4fv(name, static_cast<int>(values.size() / 4), values.data()); };
  if (!optics.ClippingPlanes.empty())
  {
    set3("clippingConstant", Collect(optics.ClippingPlanes, &RayClippingPlane::Constant));
    set3("clippingPerDepth", Collect(optics.ClippingPlanes, &RayClippingPlane::PerDepth));
    set4("clippingInFrame", Collect(optics.ClippingPlanes, &RayClippingPlane::InFrame));
  }
  if (program->IsUniformUsed("rangeShare"))
  {
    const double width = optics.DataRange.Highest - optics.DataRange.Lowest;
    const float share[2] = { static_cast<float>(-optics.DataRange.Lowest / width),
      static_cast<float>(1.0 / width) };
    program->SetUniform2f("rangeShare", share);
  }
  SetMediumUniforms(program, optics.Medium);
  if (!optics.UsesGradients())
  {
    return;
  }
  glm::mat3 gradientToFrame(optics.GradientToFrame);
  program->SetUniformMatrix3x3("gradientToFrame", glm::value_ptr(gradientToFrame));
  program->SetUniformf("gradientMagnitude", static_cast<float>(optics.GradientMagnitude));
  program->SetUniformf("ambient", static_cast<float>(optics.Lighting.Ambient));
  program->SetUniformf("diffuse", static_cast<float>(optics.Lighting.Diffuse));
  program->SetUniformf("specular", static_cast<float>(optics.Lighting.Specular));
  program->SetUniformf("specularPower", static_cast<float>(optics.Lighting.SpecularPower));
  if (optics.Illuminated)
  {
    program->SetUniformi("brightestLight", optics.Lighting.BrightestLight);
    program->SetUniformf("scattering", static_cast<float>(optics.Lighting.Scattering));
    program->SetUniformf("anisotropy", static_cast<float>(optics.Lighting.Anisotropy));
  }
  if (!optics.Lighting.Lights.empty())
  {
    set4("lightPosition", Collect(optics.Lighting.Lights, &RayCastLight::Position));
    set3("lightDiffuse", Collect(optics.Lighting.Lights, &RayCastLight::Diffuse));
    set3("lightSpecular", Collect(optics.Lighting.Lights, &RayCastLight::Specular));
    set4("lightCone", Collect(optics.Lighting.Lights, &RayCastLight::Cone));
    set4("lightFalloff", Collect(optics.Lighting.Lights, &RayCastLight::Falloff));
  }
}

}

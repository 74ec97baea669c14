// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/ObjectShader.h"

#include "Rendering/Pass/PlateUniforms.h"

#include "vtkMediumTransmittance.h"
#include "vtkRefractionShadows.h"
#include "vtkTrueSpaceLighting.h"

#include "vtkDataObject.h"
#include "vtkPolyDataMapper.h"
#include "vtkShaderProgram.h"

namespace meniscus
{
namespace
{

constexpr const char* Declarations = "//VTK::Normal::Dec";
constexpr const char* Code = "//VTK::Normal::Impl";

void Map(vtkPolyDataMapper* mapper, const char* attribute, const char* array)
{
  mapper->MapDataArrayToVertexAttribute(attribute, array, vtkDataObject::FIELD_ASSOCIATION_POINTS);
}

/**
 * Passes a vertex attribute on to the fragment shader, as the attribute's name with VSOutput.
 * Without its array OpenGL reads 0.
 */
void PassOn(const ShaderSources& sources, const std::string& type, const std::string& name)
{
  const std::string fromVertex = name + "VSOutput";
  const std::string fromGeometry = name + "GSOutput";
  const std::string declaration = type + " " + fromVertex;
  AppendToShader(
    sources.Vertex, Declarations, "in " + type + " " + name + ";\nout " + declaration + ";");
  AppendToShader(sources.Vertex, Code, "  " + fromVertex + " = " + name + ";");
  AppendToShader(sources.Geometry, Declarations,
    "in " + declaration + "[];\nout " + type + " " + fromGeometry + ";");
  AppendToShader(sources.Geometry, Code, fromGeometry + " = " + fromVertex + "[i];");
  AppendToShader(sources.Fragment, Declarations, "in " + declaration + ";");
}

}

//------------------------------------------------------------------------------
void AppendToShader(std::string& source, const std::string& tag, const std::string& code)
{
  vtkShaderProgram::Substitute(source, tag, tag + "\n" + code + "\n", false);
}

//------------------------------------------------------------------------------
void MapMediumArrays(vtkPolyDataMapper* mapper)
{
  Map(mapper, "refractionDepth", "RefractionDepth");
  Map(mapper, "innerReflectance", "InnerReflectance"); // behind several interfaces
}

//------------------------------------------------------------------------------
void SeeThroughMedium(const ShaderSources& sources, const SeenThrough& seen)
{
  PassOn(sources, "float", "refractionDepth");
  // The functions of the medium come first in the source: others use them.
  AppendToShader(sources.Fragment, Declarations,
    std::string(vtkMediumTransmittance) + "uniform float innerReflects;");
  // Behind VTK's textures, which multiply the colour; the last step is inserted first.
  constexpr const char* textured = "  //VTK::TCoord::Impl";
  if (seen.HasInnerInterfaces)
  {
    PassOn(sources, "float", "innerReflectance");
    AppendToShader(sources.Fragment, textured,
      "  gl_FragData[0].rgb *= 1.0 - innerReflects * innerReflectanceVSOutput;");
  }
  if (seen.HasMedium)
  {
    AppendToShader(sources.Fragment, textured,
      "  gl_FragData[0].rgb = inMedium(gl_FragData[0].rgb, max(refractionDepthVSOutput, 0.0));");
  }
}

//------------------------------------------------------------------------------
void MapTrueArrays(vtkPolyDataMapper* mapper, const std::string& sightPoint)
{
  Map(mapper, "truePosition", "TruePosition");
  Map(mapper, "trueNormal", "TrueNormal");
  Map(mapper, "sightPoint", sightPoint.c_str());
}

//------------------------------------------------------------------------------
void LightInTrueSpace(const ShaderSources& sources, bool readsTables, bool hasShadows)
{
  PassOn(sources, "vec3", "truePosition");
  PassOn(sources, "vec3", "trueNormal");
  PassOn(sources, "vec3", "sightPoint");
  AppendToShader(sources.Fragment, Declarations,
    std::string("#define HAS_LIT_TABLES ") + (readsTables ? "1\n" : "0\n") +
      "#define HAS_SHADOWS " + (hasShadows ? "1\n" : "0\n") + PlateShaderSource() +
      (hasShadows ? vtkRefractionShadows : "") + vtkTrueSpaceLighting);
  AppendToShader(sources.Fragment, "  //VTK::Light::Impl",
    "  gl_FragData[0].rgb = lightInTrueSpace(ambientColor, diffuseColor, truePositionVSOutput,\n"
    "    trueNormalVSOutput, sightPointVSOutput, refractionDepthVSOutput > 0.0);");
}

}

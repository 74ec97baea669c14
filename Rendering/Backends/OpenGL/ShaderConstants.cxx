// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/ShaderConstants.h"

#include "Rendering/Backends/OpenGL/OpenGLEntryLists.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/ComponentMixture.h"
#include "Volume/Optics/MediumConstants.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Refracted/RefractedRayTexels.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cctype>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

namespace meniscus
{
namespace
{

/** Literal of GLSL; with as many digits as tell one float from all others. */
std::string LiteralOf(float value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::scientific << std::setprecision(std::numeric_limits<float>::max_digits10 - 1)
       << value;
  return text.str();
}

std::string Define(const std::string& name, const std::string& value)
{
  return "#define " + name + " " + value + "\n";
}

std::string Define(const std::string& name, float value)
{
  return Define(name, LiteralOf(value));
}

template <class Enumeration>
std::string DefineNumber(const std::string& name, Enumeration value)
{
  return Define(name, std::to_string(static_cast<int>(value)));
}

/** Name of an enumerator in shaders: MAXIMUM_INTENSITY for MaximumIntensity. */
std::string CapitalsOf(const char* name)
{
  std::string capitals;
  for (const char* letter = name; *letter != '\0'; ++letter)
  {
    const bool begins = std::isupper(static_cast<unsigned char>(*letter)) != 0;
    capitals += begins && !capitals.empty() ? "_" : "";
    capitals += static_cast<char>(std::toupper(static_cast<unsigned char>(*letter)));
  }
  return capitals;
}

/** Defines a polynomial of t in Horner's form. Zeros at the end are no terms. */
template <std::size_t Size>
std::string DefinePolynomial(const std::string& name, const float (&coefficients)[Size])
{
  std::size_t terms = Size;
  while (terms > 1 && coefficients[terms - 1] == 0.0f)
  {
    --terms;
  }
  std::string text = LiteralOf(coefficients[terms - 1]);
  for (std::size_t i = terms - 1; i > 0; --i)
  {
    text = LiteralOf(coefficients[i - 1]) + " + (t) * (" + text + ")";
  }
  return Define(name + "(t)", "(" + text + ")");
}

std::string MediumConstants()
{
  std::string text = Define("LARGEST_DEPTH", LargestDepth) +
    Define("LARGEST_LIGHT_STRENGTH", LargestLightStrength) +
    Define("LARGEST_GAUSS_DEPTH", LargestGaussDepth) + Define("GAUSS_PLACE", GaussPlace) +
    Define("OUTER_GAUSS_WEIGHT", GaussWeights[0]) + Define("MIDDLE_GAUSS_WEIGHT", GaussWeights[1]) +
    Define("LARGEST_FADED_DEPTH", LargestFadedDepth) + Define("INVISIBLE_DEPTH", InvisibleDepth) +
    Define("LARGEST_CHANGE", LargestChange) + Define("SMALLEST_TURN", SmallestTurn) +
    DefinePolynomial("ABSORBED_PER_DEPTH", AbsorptionFit::ThickAbsorbed);
  int power = 0;
  for (const auto& row : AbsorptionFit::ThickMean)
  {
    text += DefinePolynomial("MEAN_ABSORBED_" + std::to_string(power++), row);
  }
  return text;
}

std::string Enumerators()
{
  std::string text;
#define MENISCUS_DEFINE(name, ...) text += DefineNumber(CapitalsOf(#name), BlendMode::name);
  MENISCUS_BLEND_MODES(MENISCUS_DEFINE)
#undef MENISCUS_DEFINE
  return text + DefineNumber("INDEPENDENT", ComponentMixture::Independent) +
    DefineNumber("COLOR_AND_OPACITY", ComponentMixture::ColorAndOpacity);
}

}

//------------------------------------------------------------------------------
std::string ShaderConstants()
{
  return Enumerators() + MediumConstants() +
    Define("GRID_PER_DEPTH", static_cast<float>(FixedPointRays::GridPerDepth)) +
    Define("LARGEST_LENGTH_PER_DEPTH", FixedPointRays::LargestLengthPerDepth) +
    Define("MODEL_UNIT", static_cast<float>(TetrahedralMesh::PositionUnit)) +
    Define("NOWHERE", RefractedRayLine::Nowhere) +
    DefineNumber("NUMBER_OF_FRAMES", RefractionFrames::Number) +
    DefineNumber("TILE_CAPACITY", OpenGLEntryLists::TileCapacity);
}

}

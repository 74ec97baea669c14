// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Description of each blend mode, read by the packet kernels, the shader's composition, the tables
 * of the volume property, the mapper and the plugin. Volume/Optics/BlendModes.cmake has one line
 * per mode.
 *
 * Packet kernels include this header: constants and enumerations only at run time, since inline
 * functions that files of different instruction sets share could be merged by the linker.
 */
#pragma once

#include "Volume/Optics/BlendModeList.h"

#include <cstddef>

namespace meniscus
{

#define MENISCUS_ENUMERATOR(name, number, ...) name = number,
/** Blend modes by the numbers of vtkVolumeMapper::BlendModes. */
enum class BlendMode
{
  MENISCUS_BLEND_MODES(MENISCUS_ENUMERATOR)
};
#undef MENISCUS_ENUMERATOR

/** Meaning of an opacity o of the transfer function, with the property's unit distance u. */
enum class OpacityMeaning
{
  /** An attenuation coefficient o / u. */
  Attenuation,
  /** The alpha of one unit distance: an attenuation coefficient -ln(1 - o) / u. */
  AlphaPerUnitDistance,
  /** An alpha as it is. */
  Alpha
};

/** Scalars that a mode makes visible. Rays skip cells without any. */
enum class VisibleBy
{
  /** Scalars whose attenuation is positive. */
  Attenuation,
  /** The isovalues. */
  Isovalues,
  /** Every finite scalar. */
  Everything
};

/** Result that a ray keeps of a part of its way, and how the results of two parts are joined. */
enum class KeptResult
{
  /** Colour and transmittance; the part in front hides the part behind it. */
  Color,
  /** A number and the length of the part; the largest, smallest or summed number counts. */
  Largest,
  Smallest,
  Sum
};

/** Subject of the picture. */
enum class BlendSubject
{
  /**
   * A medium that attenuates and emits. Components mix, gradients light it and change its opacity,
   * OpacityModel and Integration of the mapper apply.
   */
  Medium,
  /** Surfaces, lit by their normals, between cells too where cells have scalars. */
  Surfaces,
  /** Scalars, not lit. */
  Scalars
};

struct BlendModel
{
  BlendMode Mode;
  /** Name for people. */
  const char* Label;
  /** Class template of the packet kernels, in Volume/Packet/Models. */
  const char* PacketModel;
  /** Optical model of the shader: Rendering/glsl/vtkTetrahedra<ShaderPart>.glsl. */
  const char* ShaderPart;
  OpacityMeaning Opacity;
  VisibleBy Visible;
  KeptResult Kept;
  BlendSubject Subject;

  /** Whether a ray ends where next to nothing shines through. */
  constexpr bool HidesBehind() const { return this->Kept == KeptResult::Color; }
  /**
   * Whether a ray has an opacity up to each of its places: of the picture, or, in additive
   * blending, of the same medium in a composite picture. Other modes show a place or a mean.
   */
  constexpr bool AccumulatesOpacity() const
  {
    return this->HidesBehind() || this->Opacity == OpacityMeaning::Attenuation;
  }
  /** Whether pictures of several ranks can be put one over the other. */
  constexpr bool RanksComposite() const { return this->HidesBehind(); }
  constexpr bool IsMedium() const { return this->Subject == BlendSubject::Medium; }
  /** Whether gradients light the subject. */
  constexpr bool IsLit() const { return this->Subject != BlendSubject::Scalars; }
  /** Whether jumps of scalars between cells show, where cells have scalars. */
  constexpr bool SeesJumps() const { return this->Subject == BlendSubject::Surfaces; }
};

#define MENISCUS_MODEL(name, number, label, model, part, opacity, visible, kept, subject)          \
  { BlendMode::name, label, #model, #part, OpacityMeaning::opacity, VisibleBy::visible,            \
    KeptResult::kept, BlendSubject::subject },
/** The modes, ascending by number. */
inline constexpr BlendModel BlendModels[] = { MENISCUS_BLEND_MODES(MENISCUS_MODEL) };
#undef MENISCUS_MODEL

/** Description of a mode. */
constexpr const BlendModel& GetBlendModel(BlendMode mode)
{
  std::size_t index = 0;
  while (BlendModels[index].Mode != mode)
  {
    ++index;
  }
  return BlendModels[index];
}

/** Description of the mode of this number; null if there is none. */
const BlendModel* FindBlendModel(int number);

/** Meaning of opacity in a mode. @param perUnitDistance  OpacityModel of the mapper. */
OpacityMeaning OpacityMeaningOf(BlendMode mode, bool perUnitDistance);

}

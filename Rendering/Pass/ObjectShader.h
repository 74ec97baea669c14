// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkPolyDataMapper;

namespace meniscus
{

/** Sources of the shaders of a mapper, with VTK's tags. */
struct ShaderSources
{
  std::string& Vertex;
  std::string& Geometry;
  std::string& Fragment;
};

/** Inserts code behind a tag of a source. */
void AppendToShader(std::string& source, const std::string& tag, const std::string& code);

/** Maps the arrays of a refracted object to the vertex attributes that SeeThroughMedium() reads. */
void MapMediumArrays(vtkPolyDataMapper* mapper);
/** Parts of the way from the first interface to a refracted object that change its colour. */
struct SeenThrough
{
  /** True if the medium takes light. */
  bool HasMedium = true;
  /** True if interfaces behind the first one reflect light. */
  bool HasInnerInterfaces = true;

  bool operator==(const SeenThrough& other) const
  {
    return this->HasMedium == other.HasMedium &&
      this->HasInnerInterfaces == other.HasInnerInterfaces;
  }
};
/** Replaces the colour of a refracted object by that which is seen. */
void SeeThroughMedium(const ShaderSources& sources, const SeenThrough& seen);

/**
 * Maps the arrays of true positions to the vertex attributes that LightInTrueSpace() reads.
 * @param sightPoint name of the array of the points of refraction next to the object.
 */
void MapTrueArrays(vtkPolyDataMapper* mapper, const std::string& sightPoint);
/**
 * Replaces the lighting of a refracted object; before SeeThroughMedium().
 * @param readsTables whether lights have tables: WaveLight.
 * @param hasShadows whether objects hide light: ShadowCasters.
 */
void LightInTrueSpace(const ShaderSources& sources, bool readsTables, bool hasShadows);

}

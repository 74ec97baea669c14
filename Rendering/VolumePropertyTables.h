// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef VolumePropertyTables_h
#define VolumePropertyTables_h

#include "Volume/TransferFunction.h"
#include "Volume/VisibleScalars.h"
#include "VolumeInput.h"
#include "VolumePropertyPoints.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

class vtkVolumeProperty;

namespace meniscus
{

/** An isosurface in normalised scalars. */
struct Isosurface
{
  float Scalar;
  float Opacity;
  glm::vec3 Color;
};

/** What a volume property asks for, as tables; made again only where the property changed. */
class VolumePropertyTables
{
public:
  /**
   * @param blendMode  a number of vtkVolumeMapper::BlendModes; says how opacity is meant.
   * @param perUnitDistance  for composite blending: opacity is the alpha of one unit distance.
   */
  void Update(vtkVolumeProperty* property, int blendMode, bool perUnitDistance,
    const ScalarNormalization& normalization);

  const std::vector<TransferFunctionPoint>& GetPoints() const { return this->Points; }
  /** Of the scalar. */
  const std::vector<TransferFunctionInterval>& GetIntervals() const { return this->Intervals; }
  /** Of the gradient's magnitude, per world length; empty without gradient opacity. */
  const std::vector<TransferFunctionInterval>& GetGradientIntervals() const
  {
    return this->GradientIntervals;
  }
  /** Ascending; empty unless blending isosurfaces. */
  const std::vector<Isosurface>& GetIsosurfaces() const { return this->Isosurfaces; }

  /** The scalars that a ray must visit. */
  VisibleScalars GetVisibleScalars() const;

  /** Changes with the tables. */
  std::int64_t GetVersion() const { return this->Version; }
  /** Reductions of a property to points. */
  std::int64_t GetNumberOfBuilds() const { return this->Builds; }

private:
  void ReduceProperty(vtkVolumeProperty* property, int blendMode, OpacityMeaning meaning);
  void NormalizeTables(const ScalarNormalization& normalization);

  std::vector<TransferFunctionPoint> Points;
  std::vector<TransferFunctionPoint> GradientPoints;
  std::vector<TransferFunctionPoint> SurfacePoints;
  std::vector<TransferFunctionInterval> Intervals;
  std::vector<TransferFunctionInterval> GradientIntervals;
  std::vector<Isosurface> Isosurfaces;
  ObjectVersion BuiltProperty;
  ObjectVersion BuiltIsovalues;
  OpacityMeaning BuiltMeaning = OpacityMeaning::Attenuation;
  int BuiltBlendMode = -1;
  ScalarNormalization BuiltNormalization;
  std::int64_t Version = 0;
  std::int64_t Builds = 0;
};

}

#endif

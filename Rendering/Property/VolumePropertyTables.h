// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Rendering/Input/VolumeComponents.h"
#include "Rendering/Input/VolumeInput.h"
#include "Rendering/Property/VolumePropertyPoints.h"
#include "Volume/Optics/ErrorScale.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Optics/VisibleScalars.h"

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
  /** Position in the property's list; of equal values, the first one. */
  std::int32_t Index;
};

/** Tables of a volume property; rebuilt only when the property has changed. */
class VolumePropertyTables
{
public:
  /**
   * Reduces a property to points, without using scalars. Returns an error as long as numbers of the
   * property permit no picture, and once a warning about numbers that are left out.
   * @param mode blend mode; determines the meaning of opacity.
   * @param perUnitDistance for composite blending: opacity is the alpha of one unit distance.
   * @param components number of components of the scalars, used if they are independent.
   */
  InputReport Reduce(vtkVolumeProperty* property, BlendMode mode, bool perUnitDistance,
    ComponentMixture mixture, int components);
  /**
   * Converts the tables to normalised scalars.
   * @param normalization of the main scalar; the components have their own.
   */
  void Normalize(const ScalarNormalization& normalization, const VolumeComponents& components);

  const std::vector<TransferFunctionPoint>& GetPoints() const { return this->Main.Points; }
  /** Scalars at which the functions change, or surfaces are; for the normalisation of scalars. */
  const FunctionFeatures& GetFeatures() const { return this->Features; }
  /**
   * Function by which the errors of a single scalar are seen; several components are measured as
   * values.
   */
  PictureFunction GetPictureFunction() const;
  /** Intervals of the main scalar's function. */
  const std::vector<TransferFunctionInterval>& GetIntervals() const { return this->Intervals; }
  /** Intervals of the functions of the other components that are scalars. */
  const std::vector<std::vector<TransferFunctionInterval>>& GetOtherIntervals() const
  {
    return this->OtherIntervals;
  }
  /**
   * Intervals of gradient opacity, by the gradient's magnitude per world length; empty without
   * gradient opacity.
   */
  const std::vector<TransferFunctionInterval>& GetGradientIntervals() const
  {
    return this->GradientIntervals;
  }
  /** Ascending; empty unless the blend mode shows isovalues. */
  const std::vector<Isosurface>& GetIsosurfaces() const { return this->Isosurfaces; }

  /** Scalars for which rays must visit a cell. */
  VisibleScalars GetVisibleScalars() const;
  /** Visible scalars of each other component that has an opacity. */
  std::vector<VisibleScalars> GetVisibleOthers() const;

  /** Changes with the tables. */
  TableVersion GetVersion() const { return this->Version; }
  /** Reductions of a property to points. */
  std::int64_t GetNumberOfBuilds() const { return this->PointVersion.GetChanges(); }

private:
  void ReduceProperty(vtkVolumeProperty* property, BlendMode mode, OpacityMeaning meaning,
    ComponentMixture mixture, int components);
  InputReport Check(vtkVolumeProperty* property) const;
  void FindFeatures();
  void NormalizeTables(
    const ScalarNormalization& normalization, const VolumeComponents& components);

  /** Functions of the main scalar, and of the other components that are scalars. */
  PropertyPoints Main;
  std::vector<PropertyPoints> Others;
  std::vector<TransferFunctionPoint> GradientPoints;
  /** True if a gradient opacity function is used; without points it is 0 everywhere. */
  bool HasGradientOpacity = false;
  std::vector<TransferFunctionPoint> SurfacePoints;
  FunctionFeatures Features;
  std::vector<TransferFunctionInterval> Intervals;
  std::vector<std::vector<TransferFunctionInterval>> OtherIntervals;
  std::vector<TransferFunctionInterval> GradientIntervals;
  std::vector<Isosurface> Isosurfaces;
  ObjectVersion BuiltProperty;
  ObjectVersion BuiltIsovalues;
  /** Report of the last property that was reduced. */
  InputReport Report;
  OpacityMeaning BuiltMeaning = OpacityMeaning::Attenuation;
  BlendMode BuiltMode = BlendMode::Composite;
  ScalarNormalization BuiltNormalization;
  ComponentMixture BuiltMixture = ComponentMixture::None;
  int BuiltNumberOfComponents = 1;
  /** Versions of the points and of the components that the tables were made of. */
  TableVersions BuiltVersions;
  TableVersion PointVersion;
  TableVersion Version;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/ComponentMixture.h"
#include "Volume/Optics/RefractionMedium.h"
#include "Volume/Optics/ScalarNormalization.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/RayFrame.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkPlaneCollection;
class vtkRenderer;
class vtkVolumeProperty;

namespace meniscus
{

/** Optical parameters of rays, besides the transfer function's tables. */
struct RayCastOptics
{
  BlendMode Blending = BlendMode::Composite;
  /** True: one scalar per cell instead of one per vertex. */
  bool CellScalars = false;
  /** None unless the blend mode shows a medium. */
  ComponentMixture Components = ComponentMixture::None;
  /** Number of functions of the scalars' components, the main one first. */
  int NumberOfFunctions = 1;
  /** Normalised scalars that additive blending maps to 0 and to 1. */
  ScalarRange DataRange;
  /** Composite blending by a table of segments; without shading and gradient opacity. */
  bool PreIntegrated = false;
  /** Layout of the table of cells: see OpenGLTables::UploadCells(). */
  bool CompactCells = false;
  bool WideCells = false;
  /** Number of legs of the rays (RayLegs) for shaders: see OpenGLRefractedRays. */
  int NumberOfLegs = 1;
  /** True if lists of entries per tile of any length have been uploaded; for one leg only. */
  bool LongLists = false;
  bool Shading = false;
  /** True if the volume attenuates its own light: see VolumeIllumination. */
  bool Illuminated = false;
  bool GradientOpacity = false;
  /**
   * True: gradients interpolated between vertices; false: one gradient per cell. Used with Shading
   * or GradientOpacity.
   */
  bool VertexGradients = false;
  /** Matrix from gradients in normalised model coordinates to the frame's. */
  glm::dmat3 GradientToFrame{ 1.0 };
  /** Factor from a gradient's length in the frame to scalar per world length. */
  double GradientMagnitude = 1.0;
  SurfaceLighting Lighting;
  /** True if a light has no direction or a number that is not finite; it is black. */
  bool HasUnusableLights = false;
  std::vector<RayClippingPlane> ClippingPlanes;
  /** Medium behind the first interface; clear for blend modes that show no light. */
  RefractionMedium Medium;

  bool IsFaded() const { return !this->Medium.IsClear(); }
  bool IsRefracting() const { return this->NumberOfLegs > 1; }
  bool HasComponents() const { return this->Components != ComponentMixture::None; }
  bool UsesGradients() const { return this->Shading || this->GradientOpacity; }
  /** False for scalars of cells, and for mixed components, which have a gradient each. */
  bool HasGradients() const
  {
    return !this->CellScalars && this->Components != ComponentMixture::Independent;
  }
  /**
   * True if gradients per cell are used, instead of gradients per vertex. Scalars of cells have no
   * gradient.
   */
  bool UsesCellGradients() const
  {
    return this->UsesGradients() && !this->VertexGradients && this->HasGradients();
  }
  /** Description of the blend mode. */
  const BlendModel& Model() const { return GetBlendModel(this->Blending); }
  /**
   * True for a medium of one scalar of the vertices by the transfer function alone, seen through
   * no other medium.
   */
  bool IsPlainMedium() const
  {
    return this->Model().IsMedium() && !this->UsesGradients() && !this->HasComponents() &&
      !this->CellScalars && !this->IsFaded();
  }
};

/** True if both have the same effect on rays. */
bool operator==(const RayCastOptics& a, const RayCastOptics& b);

/**
 * Place of the mesh for optics: its centre in world and view coordinates, and the view
 * transformation.
 */
struct ViewContext
{
  RayFrame Frame;
  glm::dvec3 CenterInWorld{ 0.0 };
  glm::dmat4 WorldToView{ 1.0 };
  glm::dmat4 ViewToClip{ 1.0 };
  /** Unit of gradients: scalars are multiplied by it. */
  double GradientScale = 1.0;
};

/**
 * Sets shading, its material and the active lights, and gradient opacity if there is one. Scalars
 * of cells have no gradient: only their isosurfaces have a normal, and a medium of them, or of
 * independent components, is lit with global illumination alone. The other members of the optics,
 * on which these depend, must be set; Illuminated if global illumination is wanted.
 */
void GatherShading(vtkVolumeProperty* property, vtkRenderer* renderer, const ViewContext& place,
  RayCastOptics& optics);

/**
 * Describes a number of the material that is not finite; empty if there is none or no shading.
 */
std::string DescribeUnlit(const RayCastOptics& optics);

/** True if a property uses a gradient opacity function. */
bool UsesGradientOpacity(vtkVolumeProperty* property);

/**
 * Sets the clipping planes of a mapper, in world coordinates; null for none. Returns an error,
 * empty if there is none.
 */
std::string GatherClippingPlanes(
  vtkPlaneCollection* planes, const ViewContext& place, RayCastOptics& optics);

}

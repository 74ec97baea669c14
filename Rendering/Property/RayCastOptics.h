// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Property_RayCastOptics_h
#define meniscus_Rendering_Property_RayCastOptics_h

#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/ComponentMixture.h"
#include "Volume/Optics/ScalarNormalization.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/RayFrame.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

class vtkPlaneCollection;
class vtkRenderer;
class vtkVolumeProperty;

namespace meniscus
{

/** What becomes of scalars along a ray, beside the transfer function's tables. */
struct RayCastOptics
{
  BlendMode Blending = BlendMode::Composite;
  /** One scalar per cell, in place of those of the vertices. */
  bool CellScalars = false;
  /** None unless the blend mode shows a medium. */
  ComponentMixture Components = ComponentMixture::None;
  /** Of the scalars' components, the main one first. */
  int NumberOfFunctions = 1;
  /** Normalised scalars that additive blending counts as 0 and as 1. */
  ScalarRange DataRange;
  /** Composite blending by a table of segments; neither shading nor gradient opacity. */
  bool PreIntegrated = false;
  /** How the table of cells is laid out: see RayCastOpenGL::UploadCells(). */
  bool CompactCells = false;
  /** Whether rays go on behind a membrane, for shaders: see OpenGLRefractedRays. */
  bool Refracting = false;
  /** Whether lists of entries per tile of any length have been uploaded; not with Refracting. */
  bool LongLists = false;
  bool Shading = false;
  bool GradientOpacity = false;
  /** Gradients interpolated between vertices, not those of the cells; only with one of the above.
   */
  bool VertexGradients = false;
  /** Gradient in normalised model coordinates to the frame's. */
  glm::dmat3 GradientToFrame{ 1.0 };
  /** From a gradient's length in the frame to scalar per world length. */
  double GradientMagnitude = 1.0;
  SurfaceLighting Lighting;
  std::vector<RayClippingPlane> ClippingPlanes;

  bool HasComponents() const { return this->Components != ComponentMixture::None; }
  bool UsesGradients() const { return this->Shading || this->GradientOpacity; }
  /** Gradients of the cells; without those of vertices. Scalars of cells have no gradient. */
  bool UsesCellGradients() const
  {
    return this->UsesGradients() && !this->VertexGradients && !this->CellScalars;
  }
  /** Description of the blend mode. */
  const BlendModel& Model() const { return GetBlendModel(this->Blending); }
  /** Whether a medium of one scalar of the vertices follows the transfer function as it is. */
  bool IsPlainMedium() const
  {
    return this->Model().IsMedium() && !this->UsesGradients() && !this->HasComponents() &&
      !this->CellScalars;
  }
};

/** Where the mesh lies for optics: its centre in world and view coordinates, and view coordinates.
 */
struct ViewContext
{
  RayFrame Frame;
  glm::dvec3 CenterInWorld{ 0.0 };
  glm::dmat4 WorldToView{ 1.0 };
  /** Unit of gradients, times which a scalar counts. */
  double GradientScale = 1.0;
};

/**
 * Sets shading, its material and the lights that are on; gradient opacity where there is one.
 * Scalars of cells have no gradient, only their isosurfaces a normal. Wants the other members of
 * the optics that do not follow from this.
 */
void GatherShading(vtkVolumeProperty* property, vtkRenderer* renderer, const ViewContext& place,
  RayCastOptics& optics);

/** Whether a property has a gradient opacity function in use. */
bool UsesGradientOpacity(vtkVolumeProperty* property);

/** Sets the clipping planes of a mapper, in world coordinates; null for none. */
void GatherClippingPlanes(
  vtkPlaneCollection* planes, const ViewContext& place, RayCastOptics& optics);

}

#endif

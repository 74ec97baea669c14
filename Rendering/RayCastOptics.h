// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef RayCastOptics_h
#define RayCastOptics_h

#include "Volume/ClippingPlanes.h"
#include "Volume/RayFrame.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

class vtkPlaneCollection;
class vtkRenderer;
class vtkVolumeProperty;

namespace meniscus
{

/** A light in the frame of the rays (RayFrame): x, y, depth about the mesh's centre. */
struct RayCastLight
{
  /** Position and 1, or the direction towards the light and 0. */
  glm::dvec4 Position{ 0.0 };
  /** Colours times intensity. */
  glm::dvec3 Diffuse{ 0.0 };
  glm::dvec3 Specular{ 0.0 };
  /** Axis and cosine of the cone's half angle; -2 without a cone. */
  glm::dvec4 Cone{ 0.0, 0.0, 1.0, -2.0 };
  /** Coefficients of the powers 0, 1, 2 of the distance, then the exponent within the cone. */
  glm::dvec4 Falloff{ 1.0, 0.0, 0.0, 0.0 };
};

/** What becomes of scalars along a ray, beside the transfer function's tables. */
struct RayCastOptics
{
  /** A number of vtkVolumeMapper::BlendModes up to ISOSURFACE_BLEND. */
  int BlendMode = 0;
  /** One scalar per cell, in place of those of the vertices. */
  bool CellScalars = false;
  bool Shading = false;
  bool GradientOpacity = false;
  /** Gradients interpolated between vertices, not those of the cells; only with one of the above.
   */
  bool VertexGradients = false;
  double Ambient = 0.0;
  double Diffuse = 0.0;
  double Specular = 0.0;
  double SpecularPower = 1.0;
  /** Gradient in normalised model coordinates to the frame's. */
  glm::dmat3 GradientToFrame{ 1.0 };
  /** From a gradient's length in the frame to scalar per world length. */
  double GradientMagnitude = 1.0;
  std::vector<RayCastLight> Lights;
  std::vector<RayClippingPlane> ClippingPlanes;

  bool UsesGradients() const { return this->Shading || this->GradientOpacity; }
  /** Composite blending of the transfer function as it is, by scalars of the vertices. */
  bool IsPlain() const
  {
    return this->BlendMode == 0 && !this->UsesGradients() && !this->CellScalars;
  }
};

/** Where the mesh lies for optics: its centre in world and view coordinates, and view coordinates.
 */
struct OpticsPlace
{
  RayFrame Frame;
  glm::dvec3 CenterInWorld{ 0.0 };
  glm::dmat4 WorldToView{ 1.0 };
  /** Normalised scalars per scalar. */
  double ScalarScale = 1.0;
};

/**
 * Sets shading, its material and the lights that are on; gradient opacity where there is one.
 * Scalars of cells have no gradient, only their isosurfaces a normal. Wants the other members of
 * the optics that do not follow from this.
 */
void GatherShading(vtkVolumeProperty* property, vtkRenderer* renderer, const OpticsPlace& place,
  RayCastOptics& optics);

/** Whether a property has a gradient opacity function in use. */
bool UsesGradientOpacity(vtkVolumeProperty* property);

/** Sets the clipping planes of a mapper, in world coordinates; null for none. */
void GatherClippingPlanes(
  vtkPlaneCollection* planes, const OpticsPlace& place, RayCastOptics& optics);

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Optical models other than plain compositing, in double precision, on the segments of
 * ReferenceRayIntegrator: projections, isosurfaces and lighting.
 */
#pragma once

#include "ReferenceMesh.h"
#include "ReferenceRayIntegrator.h"
#include "ReferenceTransferFunction.h"

#include <array>
#include <functional>
#include <vector>

namespace meniscus::reference
{

enum class Projection
{
  Maximum, ///< largest scalar, mapped by the function (attenuation is taken as alpha)
  Minimum,
  Average, ///< mean over the length
  Additive ///< integral of attenuation times the scalar mapped from the range to [0, 1], grey,
           ///< alpha 1
};

/** Premultiplied colour of a projection. The range, used by Additive, is that of the data. */
std::array<double, 4> Project(const Ray& ray, const std::vector<RaySegment>& segments,
  Projection projection, const ReferenceTransferFunction& function, const double range[2]);

/** A half space, kept where Normal . (x - Origin) >= 0. */
struct HalfSpace
{
  Vector3 Normal;
  Vector3 Origin;
};

/** The part of a ray inside half spaces; Begin >= End if there is none. */
Ray ClipRay(const Ray& ray, const std::vector<HalfSpace>& halfSpaces);
/** The same for the cube [-1, 1]^3. */
Ray ClipToCube(const Ray& ray);

struct Light
{
  /** Position, or direction towards the light. */
  Vector3 Place;
  bool Positional = false;
  Vector3 Diffuse{ 1.0, 1.0, 1.0 };
  Vector3 Specular{ 1.0, 1.0, 1.0 };
  /** Coefficients of the powers 0, 1, 2 of the distance. */
  Vector3 Falloff{ 1.0, 0.0, 0.0 };
  /** Cosine of the half angle of a cone about Axis, -2 without a cone; exponent inside the cone. */
  double ConeCosine = -2.0;
  Vector3 Axis{ 0.0, 0.0, 1.0 };
  double Exponent = 0.0;
};

struct Material
{
  double Ambient = 0.1;
  double Diffuse = 0.7;
  double Specular = 0.2;
  double Power = 10.0;
  std::vector<Light> Lights;
};

/** Gradients of the scalar in world coordinates. */
class ReferenceGradients
{
public:
  /** Gradients of the cells, or interpolated between the volume-weighted means about each point. */
  ReferenceGradients(const ReferenceMesh& mesh, bool smooth);

  Vector3 At(std::int64_t cell, const Vector3& position) const;

private:
  Vector3 OfCell(std::int64_t cell) const;

  const ReferenceMesh& Mesh;
  std::vector<Vector3> AtPoints;
};

/** Phong's model, two-sided: lit colour of a point with an emitted colour, as seen along a ray. */
std::array<double, 3> Shade(const Material& material, const Ray& ray, const Vector3& position,
  const Vector3& gradient, const std::array<double, 3>& emitted);

struct Surface
{
  double Scalar;
  double Alpha;
  std::array<double, 3> Color;
};

/** Surfaces in front-to-back order. Without gradients they have their own colour. */
std::array<double, 4> BlendSurfaces(const Ray& ray, const std::vector<RaySegment>& segments,
  const std::vector<Surface>& surfaces, const ReferenceGradients* gradients,
  const Material& material);

/**
 * The density-emitter integral with lighting, and a factor of the attenuation by the gradient's
 * length (null: 1), by midpoints of many equal steps per segment between the function's nodes.
 */
std::array<double, 4> IntegrateShaded(const Ray& ray, const std::vector<RaySegment>& segments,
  const ReferenceTransferFunction& function, const ReferenceGradients& gradients,
  const Material* material, const std::function<double(double)>& gradientOpacity,
  int stepsPerPiece);

} // namespace meniscus::reference

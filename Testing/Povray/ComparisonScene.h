// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Scenes that Meniscus and POV-Ray draw: coloured triangles behind an exact refracting surface.
 * Light plays no part, so that pictures differ by the geometry of refraction alone. All rays of a
 * camera meet the surface, or miss its body as a whole: the rim of a membrane is not in view.
 */
#pragma once

#include "VTKBasics.h"

namespace meniscus::test
{

/** Name of the cell array of an object with the colours, 3 unsigned chars. */
extern const char* const ColorArrayName;

/** A refracting surface as a membrane and as a primitive of POV-Ray, both of one formula. */
struct RefractingSurface
{
  /** Triangles with exact points and normals; null for a scene without refraction. */
  vtkSmartPointer<vtkPolyData> Membrane;
  /**
   * Statement of POV-Ray without its closing brace; materials follow. The solid's inside is the
   * interior medium.
   */
  std::string Primitive;
  /**
   * Area between the outlines of the exact surface and of its triangles as the eye sees them, in
   * world units at the camera's target: vtkRefractionPass shows the membrane as far as its
   * triangles go. 0 where no outline is in view.
   */
  double OutlineArea = 0.0;
  double Exterior = 1.0;
  double Interior = 1.333;
};

struct SceneCamera
{
  glm::dvec3 Eye{ 0.0 };
  glm::dvec3 Target{ 0.0 };
  glm::dvec3 Up{ 0.0, 1.0, 0.0 };
  double ViewAngle = 30.0; ///< degrees, vertical and horizontal: pictures are square
};

struct ComparisonScene
{
  std::string Name;
  std::string Description;
  SceneCamera Camera;
  RefractingSurface Surface;
  /** Triangles with the cell array `ColorArrayName`. */
  std::vector<vtkSmartPointer<vtkPolyData>> Objects;
  glm::dvec3 Background{ 0.2, 0.4, 0.6 }; ///< multiples of 1/255
};

/** The colours of an object's triangles, each once. */
using ObjectColors = std::set<std::array<unsigned char, 3>>;

/** Colours of the object that has a colour; none for the background. No two objects share one. */
ObjectColors FindObjectColors(const ComparisonScene& scene, const unsigned char* color);

/**
 * Objects without a refracting surface; behind a plane, from both sides, a sphere, waves, a bowl.
 */
std::vector<ComparisonScene> MakeComparisonScenes();

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Pass_TrueSpaceLighting_h
#define meniscus_Rendering_Pass_TrueSpaceLighting_h

#include "vtkType.h"

#include <array>
#include <map>
#include <string>
#include <vector>

class vtkActor;
class vtkLight;
class vtkRenderer;
class vtkShaderProgram;

namespace meniscus
{

/**
 * Lights of a renderer for objects behind a membrane, whose fragments are lit at their true
 * positions (vtkTrueSpaceLighting.glsl). Lights in front of the membrane are refracted at the plane
 * that fits its points best, which is the membrane itself if that is flat.
 */
class TrueSpaceLighting
{
public:
  /** Number of lights in the shader. */
  static constexpr int LargestNumber = 16;

  /**
   * Takes the lights of a renderer over, and the plane of a membrane. Returns the text of a warning
   * about lights that are left out; empty if there are none.
   */
  std::string Update(vtkRenderer* renderer, vtkActor* membrane);
  /** Number of lights that the last Update() left out. */
  int GetNumberOfSkippedLights() const { return this->Skipped; }

  /** Text of the error if the object has no true positions; empty if it has. */
  static std::string DescribeMissing(vtkActor* object);

  /**
   * Sets the uniforms of vtkTrueSpaceLighting.glsl, if the program uses them.
   * @param index index of refraction behind the membrane relative to that in front of it.
   */
  void SetUniforms(
    vtkShaderProgram* program, vtkActor* object, double index, bool lightIsFaded) const;

private:
  /** A light in world coordinates, as the shader has it. */
  struct Light
  {
    std::array<float, 4> Position;
    std::array<float, 3> Color;
    std::array<float, 4> Cone;
    std::array<float, 4> Falloff;
  };

  void FitPlane(vtkActor* membrane);
  bool IsOnSurface(const double (&position)[4], const double (&about)[3]) const;
  bool Add(vtkLight* light);

  /** Plane of a membrane's points in its own coordinates, and the time of these points. */
  struct Fit
  {
    double Origin[3] = { 0.0, 0.0, 0.0 };
    double Normal[3] = { 0.0, 0.0, 1.0 };
    vtkMTimeType Time = 0;
  };
  std::map<vtkActor*, Fit> Fits;
  std::vector<Light> Lights;
  int Skipped = 0;
  std::array<double, 3> Eye{ 0.0, 0.0, 0.0 };
  /** Unit normal towards the eye, and the height of the origin. */
  std::array<double, 4> Plane{ 0.0, 0.0, 1.0, 0.0 };
  /** Largest absolute coordinate of the membrane. */
  double Reach = 0.0;
};

}

#endif

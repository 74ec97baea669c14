// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Pass/WaveLight.h"

#include "vtkType.h"

#include <glm/vec3.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

class vtkActor;
class vtkLight;
class vtkPolyData;
class vtkRefractedGeometryFilter;
class vtkRenderer;
class vtkShaderProgram;

namespace meniscus
{

/**
 * Lights of a renderer for objects behind a membrane, whose fragments are lit at their true
 * positions (vtkTrueSpaceLighting.glsl). Lights in front of a flat membrane are refracted by
 * Snell's law in the shader, and so are those that follow the camera, at the plane that fits the
 * membrane's points best. The light of others comes from tables: WaveLight.
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
   * Lights in front of the membrane of an object whose light depends on its waves; none if all
   * surfaces in front of the object are flat.
   */
  std::vector<WaveSource> ListWaveSources(vtkRefractedGeometryFilter* filter);

  /**
   * Sets the uniforms of vtkTrueSpaceLighting.glsl, if the program uses them.
   * @param indices index of refraction behind each interface, relative to the medium in front of
   * the first.
   * @param lightIsFaded whether the medium attenuates light on its way to the object.
   * @param origin point that the object's places are relative to.
   */
  void SetUniforms(vtkShaderProgram* program, vtkActor* object, const std::vector<double>& indices,
    bool lightIsFaded, const glm::dvec3& origin) const;

private:
  /** A light in world coordinates. */
  struct Light
  {
    std::array<double, 4> Position;
    std::array<float, 3> Color;
    std::array<float, 4> Cone;
    std::array<float, 4> Falloff;
    int Table; ///< number of its tables; -1 if its rays are traced in the shader
  };
  /** Plane that fits the points of a surface best, and the time of these points. */
  struct Fit
  {
    double Origin[3] = { 0.0, 0.0, 0.0 };
    double Normal[3] = { 0.0, 0.0, 1.0 };
    bool IsFlat = true;
    vtkMTimeType Time = 0;
  };

  const Fit& FitOf(vtkPolyData* surface);
  void FitPlane(vtkActor* membrane);
  double HeightOf(const double (&position)[4]) const;
  bool IsOnSurface(const double (&position)[4]) const;
  bool Add(vtkLight* light);

  /** By surface; a surface of another time is fitted again. */
  std::map<vtkPolyData*, Fit> Fits;
  std::vector<Light> Lights;
  std::vector<WaveSource> Waves;
  int Skipped = 0;
  std::array<double, 3> Eye{ 0.0, 0.0, 0.0 };
  /** Unit normal towards the eye, and the height of the origin. */
  std::array<double, 4> Plane{ 0.0, 0.0, 1.0, 0.0 };
  /** Middle of the membrane's bounds, and half of their longest side. */
  glm::dvec3 Middle{ 0.0 };
  double Reach = 0.0;
};

}

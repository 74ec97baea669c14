// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A pool of water with waves, textured walls and three objects, under a sky that it reflects: drawn
 * by vtkRefractionPass, and traced through the exact waves in double.
 */
#ifndef meniscus_PoolScene_h
#define meniscus_PoolScene_h

#include "HeightField.h"
#include "RefractionPicture.h"
#include "VolumeScene.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

class vtkActor;
class vtkImageData;
class vtkPolyData;
class vtkRefractedGeometryFilter;
class vtkRefractionPass;
class vtkTexture;

namespace meniscus
{
namespace testing
{

/// What the water does besides refracting.
struct PoolOptics
{
  bool Fresnel = false;
  bool Sky = false;
  glm::dvec3 Attenuation{ 0.0 };
};

/// Colour of the sky in a direction, smooth.
glm::dvec3 skyColor(const glm::dvec3& direction);

/// Colours from 0 to 1 of each pixel, rows upwards; `isWater` where the ray meets the water.
struct PoolPicture
{
  std::vector<glm::dvec3> Colors;
  std::vector<bool> isWater;
};

class PoolScene
{
public:
  static constexpr int Pixels = 512;

  /// `cells` x `cells` x 2 facets of water.
  explicit PoolScene(int cells, double time = 0.0);
  ~PoolScene();

  void setOptics(const PoolOptics& optics);
  /// Other waves.
  void moveWater(double time);

  vtkRenderWindow* window() const { return this->Window.window(); }
  vtkRefractionPass* pass() const { return this->Pass; }
  const PixelCamera& camera() const { return this->Camera; }

  test::ByteImage draw();

  /// What rays through the exact waves see, refracted once.
  PoolPicture trace() const;

private:
  struct Part
  {
    vtkSmartPointer<vtkPolyData> Data;
    vtkSmartPointer<vtkImageData> Image; ///< none: a colour
    glm::dvec3 Color{ 1.0 };
    vtkSmartPointer<vtkRefractedGeometryFilter> Filter;
    vtkSmartPointer<vtkActor> Actor;
  };

  void addPart(vtkPolyData* data, vtkImageData* image, const glm::dvec3& color);

  reference::HeightField Field;
  int Cells;
  PixelCamera Camera;
  PoolOptics Optics;
  vtkSmartPointer<vtkPolyData> Water;
  std::vector<Part> Parts;
  vtkSmartPointer<vtkActor> WaterActor;
  vtkSmartPointer<vtkTexture> Sky;
  vtkNew<vtkRefractionPass> Pass;
  test::VolumeScene Window;
};

} // namespace testing
} // namespace meniscus

#endif

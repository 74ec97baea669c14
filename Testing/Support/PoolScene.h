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

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <array>
#include <vector>

class vtkActor;
class vtkImageData;

class vtkRefractedGeometryFilter;
class vtkRefractionPass;
class vtkTexture;

namespace meniscus
{
namespace testing
{

/** What the water does besides refracting. */
struct PoolOptics
{
  bool Fresnel = false;
  bool Sky = false;
  glm::dvec3 Attenuation{ 0.0 };
};

/** Colour of the sky in a direction, smooth. */
glm::dvec3 skyColor(const glm::dvec3& direction);

/** Colours from 0 to 1 of each pixel, rows upwards; `isWater` where the ray meets the water. */
struct PoolPicture
{
  std::vector<glm::dvec3> Colors;
  std::vector<bool> IsWater;
};

/** What a ray from the eye meets. */
struct PoolSight
{
  glm::dvec3 Ray;    ///< from the eye, a unit vector
  glm::dvec3 Normal; ///< of the water where it is met
  int Part = -1;     ///< behind the water; -1 for nothing
  vtkIdType Cell = -1;
  glm::dvec3 Weights{ 0.0 }; ///< of the cell's corners
  double Distance = 0.0;     ///< behind the water
};

class PoolScene
{
public:
  static constexpr int Pixels = 512;

  /** `cells` x `cells` x 2 facets of water. */
  explicit PoolScene(int cells, double time = 0.0);
  ~PoolScene();

  void setOptics(const PoolOptics& optics);
  /** Of all filters: all images or one, and the tolerance in degrees. */
  void setAccuracy(bool allImages, double tolerance);
  /** The walls alone, or the objects as well. */
  void showObjects(bool show);
  /** Other waves. */
  void moveWater(double time);

  vtkRenderWindow* window() const { return this->Window.window(); }
  vtkRefractionPass* pass() const { return this->Pass; }
  const PixelCamera& camera() const { return this->Camera; }

  test::ByteImage draw();

  /** What rays through the exact waves see, refracted once. */
  PoolPicture trace() const;

  /** The colour of a pixel, for rays that somebody else has traced. */
  glm::dvec3 shade(const PoolSight& sight) const;
  int numberOfParts() const { return static_cast<int>(this->Parts.size()); }
  /** Triangles. */
  vtkPolyData* partData(int part) const { return this->Parts[static_cast<std::size_t>(part)].Data; }
  const reference::HeightField& field() const { return this->Field; }

private:
  struct Part
  {
    vtkSmartPointer<vtkPolyData> Data;
    vtkSmartPointer<vtkImageData> Image;                ///< none: a colour
    std::vector<std::array<glm::dvec2, 3>> Coordinates; ///< in the image, of the cells' corners
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

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A pool of water with waves, textured walls and three objects, under a sky that it reflects: drawn
 * by vtkRefractionPass, and traced through the exact waves in double precision.
 */
#pragma once

#include "RefractionPicture.h"
#include "VolumeScene.h"

class vtkRefractedGeometryFilter;
class vtkRefractionPass;
class vtkTexture;

namespace meniscus::test
{

/** Optical effects of the water besides refraction. */
struct PoolOptics
{
  bool Fresnel = false;
  bool Sky = false;
  glm::dvec3 Attenuation{ 0.0 };
  /** True: a lamp in the water lights the parts, otherwise they are of one brightness. */
  bool Lamp = false;
  /** Colour that the medium scatters. */
  glm::dvec3 Scattered{ 0.0 };
};

/** Colour of the sky in a direction, smooth. */
glm::dvec3 SkyColor(const glm::dvec3& direction);

/**
 * Colours from 0 to 1 of each pixel, in rows upwards; `IsWater` is set where the ray meets the
 * water.
 */
struct PoolPicture
{
  std::vector<glm::dvec3> Colors;
  std::vector<bool> IsWater;
};

/** Hit of a ray from the eye. */
struct PoolSight
{
  glm::dvec3 Ray;    ///< from the eye, a unit vector
  glm::dvec3 Normal; ///< normal of the water at the intersection
  int Part = -1;     ///< part behind the water; -1 for none
  vtkIdType Cell = -1;
  glm::dvec3 Weights{ 0.0 }; ///< barycentric weights of the cell's corners
  double Distance = 0.0;     ///< distance behind the water
  glm::dvec3 Start{ 0.0 };   ///< place where the ray meets the water
  glm::dvec3 Behind{ 0.0 };  ///< direction behind the water, a unit vector; used with a lamp
};

class PoolScene
{
public:
  static constexpr int Pixels = 512;

  /** The water has `cells` x `cells` x 2 facets. */
  explicit PoolScene(int cells, double time = 0.0);
  ~PoolScene();

  void SetOptics(const PoolOptics& optics);
  /**
   * Sets, for all filters, whether all images are computed or one, and the tolerance in degrees.
   */
  void SetAccuracy(bool allImages, double tolerance);
  /** Shows the walls alone, or the objects as well. */
  void ShowObjects(bool show);
  /** Sets other waves. */
  void MoveWater(double time);

  vtkRenderWindow* GetWindow() const { return this->Window.GetWindow(); }
  vtkRefractionPass* GetPass() const { return this->Pass; }
  const PixelCamera& GetCamera() const { return this->Camera; }

  test::ByteImage Draw();

  /** Image of rays through the exact waves, refracted once. */
  PoolPicture Trace() const;

  /** Colour of a pixel, for rays traced by the caller. */
  glm::dvec3 Shade(const PoolSight& sight) const;
  int NumberOfParts() const { return static_cast<int>(this->Parts.size()); }
  /** The part's triangles. */
  vtkPolyData* PartData(int part) const { return this->Parts[static_cast<std::size_t>(part)].Data; }
  const reference::HeightField& MakeField() const { return this->Field; }

private:
  void SetLamp(bool isOn);
  double LampAt(const PoolSight& sight) const;

  struct Part
  {
    vtkSmartPointer<vtkPolyData> Data;
    vtkSmartPointer<vtkImageData> Image;                ///< null: the part has a single colour
    std::vector<std::array<glm::dvec2, 3>> Coordinates; ///< texture coordinates of the cells'
                                                        ///< corners
    glm::dvec3 Color{ 1.0 };
    vtkSmartPointer<vtkRefractedGeometryFilter> Filter;
    vtkSmartPointer<vtkActor> Actor;
  };

  void AddPart(vtkPolyData* data, vtkImageData* image, const glm::dvec3& color);

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

} // namespace meniscus::test

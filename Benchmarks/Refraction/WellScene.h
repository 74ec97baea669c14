// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "HeightField.h"
#include "RefractionPicture.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRefractedGeometryFilter;
class vtkRenderWindow;
class vtkRenderer;

namespace meniscus::benchmark
{

/** Forms of the well's membrane. */
enum class WellSurface
{
  Waves,
  Plane,
  HemisphereUp,  ///< concave to the eye
  HemisphereDown ///< convex to the eye
};

/**
 * The thesis's well: four walls and a bottom of coloured quads below waves or one of the thesis's
 * refractors, drawn at 512 x 512 pixels through the filter for an eye above it.
 */
class WellScene
{
public:
  static constexpr double HalfWidth = 60.0;
  static constexpr double Depth = 100.0;
  static constexpr double Top = -5.0;

  /** `cells` x `cells` x 2 facets, `quads` x `quads` quads on each of five sides. */
  WellScene(int cells, int quads, WellSurface surface = WellSurface::Waves);
  ~WellScene();

  vtkRefractedGeometryFilter* GetFilter() { return this->Filter; }
  vtkPolyData* GetWell() { return this->Well; }
  /** The waves at rest. */
  const reference::HeightField& MakeField() const { return this->Field; }
  /** The membrane at its first place. */
  reference::MembraneMesh MakeMesh() const;

  /** Waves at a given time. */
  reference::HeightField FieldAt(double time) const;
  /** Changes the amplitude of waves, or moves another surface up and down. */
  void MoveMembrane(double time);
  /** Moves the eye on a circle. */
  void MoveEye(double time);
  void ChangeColors(int number);
  /** Moves the well itself up and down. */
  void MoveWell(double time);
  /** Moves the well to the far side of the membrane, where its outer facets show it. */
  void MoveWellAside();

  test::PixelCamera GetCamera() const;

  /** Runs the filter and draws, until the image is complete. */
  void Draw();
  /** Runs the filter alone. */
  void Update();

  /** Place where a ray leaves the well through a wall or the bottom. */
  static test::PlacePixel Meet(const glm::dvec3& start, const glm::dvec3& direction);

  /**
   * Draws the well itself through one matrix instead of the filter's output: depths below the water
   * at rest are divided by the ratio of the indices, as Diefenbach does for flat water.
   */
  void UseMatrix();
  /** Draws other data instead of the filter's output, without a change. */
  void DrawInstead(vtkPolyData* data) { this->Instead = data; }
  /** Whether opaque geometry is blended, as VTK does. */
  void SetBlending(bool isOn) { this->Blends = isOn; }

  /**
   * Places of the well that the present eye sees through the present membrane, by rays in double
   * precision.
   */
  test::PlacePicture Trace() const;
  /** The same places from the filter's output, or through the matrix. */
  test::PlacePicture DrawPlaces();

private:
  void SetUpWindow();
  double GetScale() const;
  /** Sets VTK's state before the actors are drawn. */
  void PrepareState();

  WellSurface Surface;
  reference::HeightField Field;
  reference::HeightField Present;
  int Cells;
  glm::dvec3 Eye{ 0.0 };
  vtkSmartPointer<vtkPolyData> Well;
  vtkSmartPointer<vtkPolyData> Membrane;
  vtkSmartPointer<vtkPolyData> Instead;
  vtkNew<vtkRefractedGeometryFilter> Filter;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  bool HasWindow = false;
  bool HasMatrix = false;
  bool Blends = true;
};

} // namespace meniscus::benchmark

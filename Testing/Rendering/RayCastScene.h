// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceImage.h"
#include "ReferenceOptics.h"
#include "SceneParts.h"
#include "TestMeshes.h"
#include "TestTransferFunctions.h"
#include "VTKTestBasics.h"

#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
{

/**
 * A scene whose volume is a mesh drawn by vtkTetrahedraRayCastMapper, seen from an azimuth of 30
 * degrees and an elevation of 20.
 */
class RayCastScene : public VolumeScene
{
public:
  RayCastScene(vtkUnstructuredGrid* grid, vtkVolumeProperty* property, int width, int height,
    int multiSamples = 0);

  vtkTetrahedraRayCastMapper* GetRayCaster() const { return this->RayCaster; }
  vtkUnstructuredGrid* MakeGrid() const { return this->Grid; }

private:
  vtkNew<vtkTetrahedraRayCastMapper> RayCaster;
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
};

/**
 * Backend selected by the environment variable MENISCUS_TEST_BACKEND: OpenGL, Compute, Native;
 * otherwise automatic.
 */
int BackendUnderTest();

/**
 * Adds a black square across the view, `offset` behind the camera's focal point. Returns its
 * distance from the camera.
 */
double AddBlackSquare(vtkRenderer* renderer, double offset);

/** Adds a light of the scene at infinity, in the direction (x, y, z). */
vtkSmartPointer<vtkLight> AddParallelLight(vtkRenderer* renderer, double x, double y, double z);

/** Keeps a half of space; the origin of its plane may be left out. */
void AddClippingPlane(vtkAbstractMapper* mapper, const reference::HalfSpace& half);

/**
 * Fraction of covered pixels that may be excused as silhouettes, or a number of pixels if that is
 * larger.
 */
struct SilhouetteAllowance
{
  double Share = LargestSilhouetteShare;
  std::size_t Pixels = 1;
};

void ExpectMatch(const Comparison& comparison, const std::string& what,
  const SilhouetteAllowance& allowance = SilhouetteAllowance());

/** Results of the reference for a scene's volume in its present view. */
struct SceneTruth
{
  std::unique_ptr<reference::ReferenceRayIntegrator> Integrator;
  RayOfPixel RayOf;
  ReferenceImage Image;
};

SceneTruth MakeTruth(const RayCastScene& scene);

/** Expects all values to be equal within 2e-5, and at least one of them not to be transparent. */
void ExpectSamePicture(const FloatImage& a, const FloatImage& b, const std::string& what);

/**
 * Renders in float and in 8 bits and expects every pixel to match the reference; no ray may be
 * lost. The scene must contain only the volume, and its renderer must fill the window.
 */
void ExpectMatchesReference(RayCastScene& scene, const std::string& what,
  const SilhouetteAllowance& allowance = SilhouetteAllowance());

/** Collects error and warning events of objects, and the text in VTK's output window. */
class ErrorObserver : public vtkCommand
{
public:
  static ErrorObserver* New() { return new ErrorObserver; }
  void Execute(vtkObject* caller, unsigned long event, void* data) override;
  void Observe(vtkObject* object);

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;

  std::string GetText() const;
};

/** A new observer of an object. */
vtkSmartPointer<ErrorObserver> ObserveErrors(vtkObject* object);

/** Updates a filter; expects one error with a text in it, and nothing in the output. */
void ExpectError(vtkAlgorithm* filter, const std::string& text);

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Parts that the regression tests share. They use VTK and the public classes only, so that the
 * tests build inside VTK and against an installed package as well.
 */
#pragma once

#include "SceneParts.h"
#include "TestMeshes.h"
#include "TestTransferFunctions.h"
#include "VolumeScene.h"

class vtkImageData;
class vtkTetrahedraRayCastMapper;

namespace meniscus::test
{

/** Width and height of all pictures in pixels. */
constexpr int RegressionSize = 300;

/** A window of that size with one renderer. */
class RegressionScene : public VolumeScene
{
public:
  RegressionScene()
    : VolumeScene(RegressionSize, RegressionSize)
  {
  }
};

/**
 * Draws the scene and returns the exit status of its test by vtkRegressionTestImage. Opens the
 * window if the test is interactive (-I). With the argument --strict, each pixel must also be
 * within one grey level of the baseline or of one of its alternates.
 */
int Finish(int argc, char* argv[], VolumeScene& scene);

/** Mapper of the scene's volume, for a mesh, seen from a direction in degrees. */
vtkSmartPointer<vtkTetrahedraRayCastMapper> ShowMesh(
  VolumeScene& scene, vtkUnstructuredGrid* mesh, double azimuth, double elevation);

/** Shows one component of a point array, black at range[0] and white at range[1]. */
void ShowImage(VolumeScene& scene, vtkImageData* image, const char* name, const double range[2],
  int component = 0);

/** A square of checks in two colours, which are cell data. */
vtkSmartPointer<vtkPolyData> MakeCheckedPlane(double halfWidth, double height, int checks);

/** A square of waves z(x, y) about a height, with exact normals. */
vtkSmartPointer<vtkPolyData> MakeWaves(double halfWidth, double height, int cells);

/** Adds an actor of a data set in its cells' colours or, without such, in the given one. */
vtkSmartPointer<vtkActor> AddSurface(VolumeScene& scene, vtkAlgorithmOutput* port, double red = 1.0,
  double green = 1.0, double blue = 1.0);

/** Camera of the scenes with water in the plane z = 0: from above, looking at a place below it. */
void LookAtWater(VolumeScene& scene, double distance);

} // namespace meniscus::test

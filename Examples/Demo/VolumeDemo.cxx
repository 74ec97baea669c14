// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeDemo.h"

#include "DemoPictures.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace
{

/** The scalar below which `fraction` of the points lie. */
class Quantiles
{
public:
  explicit Quantiles(vtkDataArray* scalars)
  {
    for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
    {
      const double value = scalars->GetComponent(i, 0);
      if (std::isfinite(value))
      {
        this->Sorted.push_back(value);
      }
    }
    std::sort(this->Sorted.begin(), this->Sorted.end());
  }

  double At(double fraction) const
  {
    return this->Sorted.empty()
      ? 0.0
      : this->Sorted[static_cast<std::size_t>(fraction * (this->Sorted.size() - 1))];
  }

private:
  std::vector<double> Sorted;
};

void SetColors(vtkVolumeProperty* property, const Quantiles& quantiles)
{
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  colors->RemoveAllPoints();
  colors->AddRGBPoint(quantiles.At(0.00), 0.08, 0.20, 0.55);
  colors->AddRGBPoint(quantiles.At(0.35), 0.15, 0.60, 0.75);
  colors->AddRGBPoint(quantiles.At(0.65), 0.95, 0.85, 0.45);
  colors->AddRGBPoint(quantiles.At(0.90), 0.90, 0.40, 0.10);
  colors->AddRGBPoint(quantiles.At(1.00), 0.55, 0.05, 0.05);
}

/** Opacity that rises smoothly with the scalar. */
void SetSmoothOpacity(vtkVolumeProperty* property, const Quantiles& quantiles)
{
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  opacity->RemoveAllPoints();
  opacity->AddPoint(quantiles.At(0.0), 0.05);
  opacity->AddPoint(quantiles.At(0.5), 0.12);
  opacity->AddPoint(quantiles.At(0.9), 1.0);
  opacity->AddPoint(quantiles.At(1.0), 3.0);
}

/** Narrow peaks: sharp shells about three values. */
void SetPeakedOpacity(vtkVolumeProperty* property, const Quantiles& quantiles)
{
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  opacity->RemoveAllPoints();
  const double halfWidth = 0.006 * (quantiles.At(1.0) - quantiles.At(0.0));
  for (const double fraction : { 0.3, 0.7, 0.95 })
  {
    const double center = quantiles.At(fraction);
    opacity->AddPoint(center - halfWidth, 0.0);
    opacity->AddPoint(center, 40.0 * fraction * fraction);
    opacity->AddPoint(center + halfWidth, 0.0);
  }
}

void PrintCounters(vtkTetrahedraRayCastMapper* mapper)
{
  std::printf(
    "  %lld cells (%lld left out), mesh builds %lld, scalar updates %lld, transfer function "
    "builds %lld, uploaded %lld bytes; last frame: %lld rays, %lld steps, %lld lost\n",
    mapper->GetNumberOfActiveCells(), mapper->GetNumberOfRejectedCells(),
    mapper->GetNumberOfMeshBuilds(), mapper->GetNumberOfScalarUpdates(),
    mapper->GetNumberOfTransferFunctionBuilds(), mapper->GetUploadedBytes(),
    mapper->GetNumberOfRays(), mapper->GetNumberOfTraversalSteps(), mapper->GetNumberOfLostRays());
}

/** Looks at the mesh from a corner, so that it fills the picture. */
void LookFromOutside(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetPosition(1.0, -1.6, 1.1);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->ResetCamera();
  camera->Zoom(1.15);
}

/** Looks from a point inside the mesh's bounding box to its centre. */
void LookFromInside(vtkRenderer* renderer, const double bounds[6])
{
  double from[3];
  double to[3];
  const double fractions[3] = { 0.78, 0.30, 0.62 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* range = bounds + 2 * axis;
    from[axis] = range[0] + fractions[axis] * (range[1] - range[0]);
    to[axis] = 0.5 * (range[0] + range[1]);
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(from);
  camera->SetFocalPoint(to);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->OrthogonalizeViewUp();
  camera->SetViewAngle(70.0);
}

/** An opaque ball at the centre of the bounds. */
vtkSmartPointer<vtkActor> MakeBall(const double bounds[6], double length)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(
    0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]), 0.5 * (bounds[4] + bounds[5]));
  sphere->SetRadius(0.045 * length);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(32);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  auto ball = vtkSmartPointer<vtkActor>::New();
  ball->SetMapper(mapper);
  ball->GetProperty()->SetColor(0.2, 0.7, 0.3);
  ball->GetProperty()->SetSpecular(0.4);
  return ball;
}

}

//------------------------------------------------------------------------------
bool RunVolumeDemo(vtkUnstructuredGrid* mesh, const std::string& folder)
{
  vtkDataArray* scalars = mesh->GetPointData()->GetScalars();
  std::printf("Volume: %lld tetrahedra, %lld points, scalar '%s'\n",
    static_cast<long long>(mesh->GetNumberOfCells()),
    static_cast<long long>(mesh->GetNumberOfPoints()), scalars->GetName());
  const Quantiles quantiles(scalars);
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->SetScalarOpacityUnitDistance(mesh->GetLength() / 8.0);
  SetColors(volume->GetProperty(), quantiles);
  SetSmoothOpacity(volume->GetProperty(), quantiles);

  DemoPictures pictures(folder);
  vtkRenderer* renderer = pictures.GetRenderer();
  renderer->AddVolume(volume);
  LookFromOutside(renderer);
  bool written = pictures.Write("volume", "the mesh, smooth transfer function");
  PrintCounters(mapper);

  SetPeakedOpacity(volume->GetProperty(), quantiles);
  written = pictures.Write("volume-peaks", "narrow opacity peaks at three values") && written;
  PrintCounters(mapper);

  SetSmoothOpacity(volume->GetProperty(), quantiles);
  renderer->AddActor(MakeBall(mesh->GetBounds(), mesh->GetLength()));
  LookFromInside(renderer, mesh->GetBounds());
  written =
    pictures.Write("volume-inside", "from inside its bounds, an opaque ball in it") && written;
  PrintCounters(mapper);
  return written;
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeDemo.h"

#include "DemoPictures.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPointLocator.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace
{

/** Quantiles of the scalars: the scalar below which a given fraction of the points lie. */
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

/** Opacity that rises smoothly with the scalar, times a factor. */
void SetSmoothOpacity(vtkVolumeProperty* property, const Quantiles& quantiles, double factor)
{
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  opacity->RemoveAllPoints();
  opacity->AddPoint(quantiles.At(0.0), factor * 0.05);
  opacity->AddPoint(quantiles.At(0.5), factor * 0.12);
  opacity->AddPoint(quantiles.At(0.9), factor * 1.0);
  opacity->AddPoint(quantiles.At(1.0), factor * 3.0);
}

/** Narrow peaks: sharp shells at three values. */
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

/** A constant opacity. */
void SetEvenOpacity(vtkVolumeProperty* property, const Quantiles& quantiles, double value)
{
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  opacity->RemoveAllPoints();
  opacity->AddPoint(quantiles.At(0.0), value);
  opacity->AddPoint(quantiles.At(1.0), value);
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

/** Looks at the mesh from a corner, so that it fills the image. */
void LookFromOutside(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetViewAngle(30.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetPosition(0.8, -1.4, 1.3);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->ResetCamera();
  camera->Zoom(1.25);
}

/** A point of the mesh, and its distance from the surface's points. */
struct DeepPoint
{
  double Place[3];
  double Depth;
};

/** Some points of the mesh, the deepest first. */
std::vector<DeepPoint> FindDeepPoints(vtkUnstructuredGrid* mesh)
{
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(mesh);
  surface->Update();
  vtkNew<vtkPointLocator> locator;
  locator->SetDataSet(surface->GetOutput());
  locator->BuildLocator();
  std::vector<DeepPoint> points;
  constexpr vtkIdType tried = 2000;
  const vtkIdType step = std::max<vtkIdType>(1, mesh->GetNumberOfPoints() / tried);
  for (vtkIdType p = 0; p < mesh->GetNumberOfPoints(); p += step)
  {
    DeepPoint point;
    double nearest[3];
    mesh->GetPoint(p, point.Place);
    surface->GetOutput()->GetPoint(locator->FindClosestPoint(point.Place), nearest);
    point.Depth = std::sqrt(vtkMath::Distance2BetweenPoints(point.Place, nearest));
    points.push_back(point);
  }
  std::sort(points.begin(), points.end(),
    [](const DeepPoint& a, const DeepPoint& b) { return a.Depth > b.Depth; });
  return points;
}

/** An opaque ball where the mesh is thickest, as large as fits. */
vtkSmartPointer<vtkActor> MakeBall(const DeepPoint& place, double length)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(place.Place[0], place.Place[1], place.Place[2]);
  sphere->SetRadius(std::max(0.8 * place.Depth, 0.02 * length));
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(48);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  auto ball = vtkSmartPointer<vtkActor>::New();
  ball->SetMapper(mapper);
  ball->GetProperty()->SetColor(0.25, 0.75, 0.35);
  ball->GetProperty()->SetSpecular(0.5);
  ball->GetProperty()->SetSpecularPower(30.0);
  return ball;
}

/**
 * Looks at the first place from inside the mesh: from another deep place, at a third of the
 * distance.
 */
void LookFromInside(vtkRenderer* renderer, const std::vector<DeepPoint>& places, double length)
{
  const DeepPoint& to = places.front();
  const DeepPoint* from = &places.back();
  double best = HUGE_VAL;
  for (const DeepPoint& place : places)
  {
    const double apart = std::sqrt(vtkMath::Distance2BetweenPoints(place.Place, to.Place));
    const double missed = std::fabs(apart - 0.33 * length);
    if (place.Depth > 0.5 * to.Depth && missed < best)
    {
      best = missed;
      from = &place;
    }
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(from->Place);
  camera->SetFocalPoint(to.Place);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->OrthogonalizeViewUp();
  camera->SetViewAngle(75.0);
}

/** Images of one mesh. Each begins with the settings of the first. */
class VolumePictures
{
public:
  VolumePictures(vtkUnstructuredGrid* mesh, const std::string& folder)
    : Mesh(mesh)
    , Scalars(mesh->GetPointData()->GetScalars())
    , Pictures(folder)
    , Places(FindDeepPoints(mesh))
    , Ball(MakeBall(this->Places.front(), mesh->GetLength()))
  {
    this->Mapper->SetInputData(mesh);
    this->Volume->SetMapper(this->Mapper);
    this->Renderer()->AddVolume(this->Volume);
    this->Renderer()->AddActor(this->Ball);
    LookFromOutside(this->Renderer());
  }

  bool WriteAll()
  {
    this->Begin();
    this->Write("volume", "the mesh, smooth transfer function");

    this->Begin();
    SetPeakedOpacity(this->Property(), this->Scalars);
    this->Write("volume-peaks", "narrow opacity peaks at three values");

    this->Begin();
    this->Light(0.35, 0.75, 0.35, 24.0);
    SetSmoothOpacity(this->Property(), this->Scalars, 6.0);
    this->Write("volume-shading", "light in the medium");

    this->Begin();
    this->ShowIsosurfaces();
    this->Write("volume-isosurfaces", "three isosurfaces, translucent and lit");

    this->Begin();
    this->ShowMaximum();
    this->Write("volume-maximum", "maximum intensity");

    this->Begin();
    this->Clip();
    this->Write("volume-clipping", "cut by two clipping planes");

    this->Begin();
    this->Ball->VisibilityOn();
    this->Light(0.5, 0.6, 0.2, 24.0);
    SetSmoothOpacity(this->Property(), this->Scalars, 1.5);
    this->Write("volume-opaque", "an opaque ball in the mesh");

    this->Begin();
    this->Ball->VisibilityOn();
    this->Light(0.5, 0.6, 0.2, 24.0);
    SetSmoothOpacity(this->Property(), this->Scalars, 2.0);
    LookFromInside(this->Renderer(), this->Places, this->Mesh->GetLength());
    this->Write("volume-inside", "from inside the mesh, at the ball");
    return this->Written;
  }

private:
  vtkRenderer* Renderer() { return this->Pictures.GetRenderer(); }
  vtkVolumeProperty* Property() { return this->Volume->GetProperty(); }

  void Begin()
  {
    this->Mapper->SetBlendMode(vtkVolumeMapper::COMPOSITE_BLEND);
    this->Mapper->RemoveAllClippingPlanes();
    this->Property()->ShadeOff();
    this->Property()->SetScalarOpacityUnitDistance(this->Mesh->GetLength() / 8.0);
    SetColors(this->Property(), this->Scalars);
    SetSmoothOpacity(this->Property(), this->Scalars, 1.5);
    this->Ball->VisibilityOff();
  }

  void Light(double ambient, double diffuse, double specular, double power)
  {
    this->Property()->ShadeOn();
    this->Property()->SetAmbient(ambient);
    this->Property()->SetDiffuse(diffuse);
    this->Property()->SetSpecular(specular);
    this->Property()->SetSpecularPower(power);
  }

  void ShowIsosurfaces()
  {
    this->Mapper->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    this->Light(0.35, 0.7, 0.5, 40.0);
    vtkPiecewiseFunction* opacity = this->Property()->GetScalarOpacity();
    opacity->RemoveAllPoints();
    this->Property()->GetIsoSurfaceValues()->SetNumberOfContours(0);
    int number = 0;
    for (const double fraction : { 0.35, 0.7, 0.95 })
    {
      const double value = this->Scalars.At(fraction);
      this->Property()->GetIsoSurfaceValues()->SetValue(number++, value);
      opacity->AddPoint(value, 0.2 + 0.8 * fraction * fraction);
    }
  }

  void ShowMaximum()
  {
    this->Mapper->SetBlendMode(vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND);
    vtkPiecewiseFunction* opacity = this->Property()->GetScalarOpacity();
    opacity->RemoveAllPoints();
    opacity->AddPoint(this->Scalars.At(0.0), 0.0);
    opacity->AddPoint(this->Scalars.At(0.4), 0.4);
    opacity->AddPoint(this->Scalars.At(0.8), 1.0);
  }

  /** A dense medium, clipped by two planes to its back part. */
  void Clip()
  {
    this->Light(0.6, 0.5, 0.1, 10.0);
    SetEvenOpacity(this->Property(), this->Scalars, 12.0);
    const double* center = this->Mesh->GetCenter();
    const double normals[2][3] = { { -0.35, 1.0, -0.1 }, { 0.0, 0.25, -1.0 } };
    const double shifts[2] = { -0.08, -0.06 };
    for (int i = 0; i < 2; ++i)
    {
      vtkNew<vtkPlane> plane;
      const double along = shifts[i] * this->Mesh->GetLength();
      plane->SetNormal(normals[i]);
      plane->SetOrigin(center[0] + along * normals[i][0], center[1] + along * normals[i][1],
        center[2] + along * normals[i][2]);
      this->Mapper->AddClippingPlane(plane);
    }
  }

  void Write(const std::string& name, const std::string& caption)
  {
    this->Written = this->Pictures.Write(name, caption) && this->Written;
    PrintCounters(this->Mapper);
  }

  vtkUnstructuredGrid* Mesh;
  Quantiles Scalars;
  DemoPictures Pictures;
  vtkNew<vtkTetrahedraRayCastMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  std::vector<DeepPoint> Places;
  vtkSmartPointer<vtkActor> Ball;
  bool Written = true;
};

}

//------------------------------------------------------------------------------
bool RunVolumeDemo(vtkUnstructuredGrid* mesh, const std::string& folder)
{
  std::printf("Volume: %lld cells, %lld points, scalar '%s'\n",
    static_cast<long long>(mesh->GetNumberOfCells()),
    static_cast<long long>(mesh->GetNumberOfPoints()),
    mesh->GetPointData()->GetScalars()->GetName());
  VolumePictures pictures(mesh, folder);
  return pictures.WriteAll();
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RegressionScene.h"
#include "StrictImage.h"

#include <vtkActor2D.h>
#include <vtkAlgorithmOutput.h>
#include <vtkImageMapper.h>
#include <vtkRegressionTestImage.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkTetrahedraRayCastMapper.h>

#include <vtksys/SystemTools.hxx>

namespace meniscus::test
{

namespace
{

/** Folder of the baseline that the argument -V names; empty without it. */
std::string FolderOfBaselines(int argc, char* argv[])
{
  char** const end = argv + argc;
  char** const option = std::find(argv, end, std::string("-V"));
  return end - option > 1 ? vtksys::SystemTools::GetFilenamePath(option[1]) : std::string();
}

}

//------------------------------------------------------------------------------
int Finish(int argc, char* argv[], VolumeScene& scene)
{
  constexpr int threshold = 1; // grey levels: rounding to 8 bits
  scene.GetWindow()->Render();
  const int result = vtkRegressionTestImage(scene.GetWindow());
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    scene.GetWindow()->SetOffScreenRendering(0);
    scene.GetWindow()->MakeRenderWindowInteractor()->Start();
    return EXIT_SUCCESS;
  }
  if (result == vtkRegressionTester::PASSED &&
    std::find(argv, argv + argc, std::string("--strict")) != argv + argc)
  {
    const BaselineResult strict = CompareToBaseline(
      ReadBytes(scene.GetWindow()), argv[0], threshold, FolderOfBaselines(argc, argv));
    std::cout << strict.Message << "\n";
    return strict.Passed ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return result == vtkRegressionTester::PASSED ? EXIT_SUCCESS : EXIT_FAILURE;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTetrahedraRayCastMapper> ShowMesh(
  VolumeScene& scene, vtkUnstructuredGrid* mesh, double azimuth, double elevation)
{
  auto mapper = vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
  mapper->SetInputData(mesh);
  scene.SetMapper(mapper);
  LookAt(scene.GetRenderer(), mesh->GetBounds(), azimuth, elevation);
  return mapper;
}

//------------------------------------------------------------------------------
void ShowImage(
  VolumeScene& scene, vtkImageData* image, const char* name, const double range[2], int component)
{
  vtkDataArray* values = image->GetPointData()->GetArray(name);
  vtkNew<vtkImageData> grey;
  grey->SetDimensions(image->GetDimensions());
  grey->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    const double share = (values->GetComponent(i, component) - range[0]) / (range[1] - range[0]);
    grey->GetPointData()->GetScalars()->SetTuple1(
      i, std::round(255.0 * vtkMath::ClampValue(share, 0.0, 1.0)));
  }
  vtkNew<vtkImageMapper> mapper;
  mapper->SetInputData(grey);
  mapper->SetColorWindow(255.0);
  mapper->SetColorLevel(127.5);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  scene.GetRenderer()->AddActor2D(actor);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeCheckedPlane(double halfWidth, double height, int checks)
{
  const auto plane = MakePlane(halfWidth, height, checks);
  plane->Update();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < checks * checks; ++i)
  {
    const bool isLight = (i / checks + i % checks) % 2 == 0;
    const unsigned char color[3] = { static_cast<unsigned char>(isLight ? 235 : 40),
      static_cast<unsigned char>(isLight ? 225 : 90),
      static_cast<unsigned char>(isLight ? 200 : 120) };
    colors->InsertNextTypedTuple(color);
  }
  vtkPolyData* result = plane->GetOutput();
  result->GetCellData()->SetScalars(colors);
  return result;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeWaves(double halfWidth, double height, int cells)
{
  constexpr double amplitude = 0.04;
  constexpr double waveNumber = 7.0;
  const auto plane = MakePlane(halfWidth, height, cells);
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->Update();
  vtkPolyData* result = plane->GetOutput();
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < result->GetNumberOfPoints(); ++i)
  {
    double p[3];
    result->GetPoint(i, p);
    const double x = waveNumber * p[0];
    const double y = waveNumber * p[1];
    p[2] += amplitude * std::sin(x) * std::sin(y);
    result->GetPoints()->SetPoint(i, p);
    double normal[3] = { -amplitude * waveNumber * std::cos(x) * std::sin(y),
      -amplitude * waveNumber * std::sin(x) * std::cos(y), 1.0 };
    vtkMath::Normalize(normal);
    normals->InsertNextTuple(normal);
  }
  result->GetPointData()->SetNormals(normals);
  return result;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkActor> AddSurface(
  VolumeScene& scene, vtkAlgorithmOutput* port, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(port);
  mapper->SetScalarModeToUseCellData();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  scene.GetRenderer()->AddActor(actor);
  return actor;
}

//------------------------------------------------------------------------------
void LookAtWater(VolumeScene& scene, double distance)
{
  vtkRenderer* renderer = scene.GetRenderer();
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0.2 * distance, -0.7 * distance, 0.7 * distance);
  camera->SetFocalPoint(0.0, 0.0, -0.4);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetClippingRange(0.01 * distance, 10.0 * distance);
  renderer->SetBackground(0.6, 0.7, 0.8);
}

} // namespace meniscus::test

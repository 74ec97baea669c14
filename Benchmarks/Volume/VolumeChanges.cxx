// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeChanges.h"

#include "TestMeshes.h"
#include "TestTransferFunctions.h"
#include "VolumeComparison.h"
#include "VolumeOptions.h"
#include "VolumeOutput.h"
#include "VolumeScene.h"

#include <vtkCamera.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <ostream>

namespace meniscus
{
namespace benchmark
{

namespace
{

using Mapper = vtkTetrahedraRayCastMapper;

/** Twisted hexahedra, whose faces are curved, of a field that is not linear along their edges. */
test::Grid MakeCurvedBlock(int cubes)
{
  test::Grid grid = test::Grid::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(test::ScalarName);
  const test::Field field = test::WavyField(3.0);
  const int side = cubes + 1;
  for (int i = 0; i < side * side * side; ++i)
  {
    const auto coordinate = [cubes](int number) { return 2.0 * number / cubes - 1.0; };
    const double x = coordinate(i % side);
    const double y = coordinate(i / side % side);
    const double z = coordinate(i / side / side);
    const double angle = 0.5 * z;
    points->InsertNextPoint(
      std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y, z);
    scalars->InsertNextValue(field(x, y, z));
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  grid->Allocate(vtkIdType{ cubes } * cubes * cubes);
  for (int z = 0; z < cubes; ++z)
  {
    for (int y = 0; y < cubes; ++y)
    {
      for (int x = 0; x < cubes; ++x)
      {
        const vtkIdType low = (vtkIdType{ z } * side + y) * side + x;
        const vtkIdType high = low + vtkIdType{ side } * side;
        const vtkIdType corners[8] = { low, low + 1, low + side + 1, low + side, high, high + 1,
          high + side + 1, high + side };
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
      }
    }
  }
  return grid;
}

/** One window, whose volume is drawn natively. */
class ChangeRun
{
public:
  ChangeRun(vtkUnstructuredGrid* mesh, const VolumeOptions& options)
    : Scene(options.Width, options.Height)
    , Mesh(mesh)
    , Repetitions(options.Repetitions)
  {
    mesh->GetPointData()->GetScalars()->GetFiniteRange(this->Range);
    this->Kind = test::FunctionKind::Smooth;
    FindFunctionKind(options.Function, this->Kind);
    this->Scene.SetProperty(this->MakeProperty());
    test::LookAt(this->Scene.GetRenderer(), mesh->GetBounds(), 30.0, 20.0);
    this->SetNewMapper();
  }

  Mapper* GetMapper() { return Mapper::SafeDownCast(this->Scene.GetMapper()); }
  vtkRenderer* GetRenderer() { return this->Scene.GetRenderer(); }
  vtkVolume* GetVolume() { return this->Scene.GetVolume(); }
  void Turn() { this->GetRenderer()->GetActiveCamera()->Azimuth(0.2); }

  void SetNewMapper()
  {
    vtkNew<Mapper> mapper;
    mapper->SetBackendToNative();
    mapper->SetCellDivisionToAdaptive();
    mapper->AutoAdjustSampleDistancesOff();
    mapper->SetInputData(static_cast<vtkDataSet*>(this->Mesh));
    this->Scene.SetMapper(mapper);
  }

  /** Moves a point of the opacity by a share of its height. */
  void MoveOpacity(double share)
  {
    vtkVolumeProperty* property = this->GetVolume()->GetProperty();
    vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
    double node[4];
    opacity->GetNodeValue(opacity->GetSize() / 2, node);
    node[1] *= 1.0 + share;
    opacity->SetNodeValue(opacity->GetSize() / 2, node);
  }

  /** Least processor time of frames after a change, in milliseconds; the first is not counted. */
  double Measure(const std::function<void(int)>& change)
  {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= this->Repetitions; ++i)
    {
      change(i);
      const double begin = CpuMilliseconds();
      this->Scene.GetWindow()->Render();
      this->Scene.GetWindow()->WaitForCompletion();
      least = i > 0 ? std::min(least, CpuMilliseconds() - begin) : least;
    }
    return least;
  }

private:
  vtkSmartPointer<vtkVolumeProperty> MakeProperty()
  {
    return test::MakeProperty(this->Kind, this->Range, test::DiagonalOf(this->Mesh->GetBounds()));
  }

  test::VolumeScene Scene;
  vtkUnstructuredGrid* Mesh;
  int Repetitions;
  double Range[2];
  test::FunctionKind Kind;
};

/**
 * Frames of a camera that moves, by the distance of rays in pixels. The mapper chooses the largest
 * distance that it may, as in an interaction that wants more frames than it can have.
 */
void MeasureTurning(ChangeRun& run, NamedTimes& times)
{
  vtkRenderWindow* window = run.GetRenderer()->GetRenderWindow();
  const double rate = window->GetDesiredUpdateRate();
  const auto turn = [&run](int) { run.Turn(); };
  run.GetVolume()->VisibilityOff();
  times.emplace_back("window without the volume", run.Measure(turn));
  run.GetVolume()->VisibilityOn();
  run.GetMapper()->AutoAdjustSampleDistancesOn();
  window->SetDesiredUpdateRate(1.0e6);
  for (const float distance : { 8.0f, 2.0f, 1.0f })
  {
    run.GetMapper()->SetMaximumImageSampleDistance(distance);
    times.emplace_back(
      "turning, rays " + std::to_string(static_cast<int>(distance)) + " apart", run.Measure(turn));
  }
  window->SetDesiredUpdateRate(rate);
  run.GetMapper()->AutoAdjustSampleDistancesOff();
  run.GetMapper()->SetImageSampleDistance(0.25f);
  times.emplace_back("still, several rays at edges", run.Measure(turn));
  run.GetMapper()->SetImageSampleDistance(1.0f);
}

/** Frames of a lit volume with shadows. */
void MeasureShadows(ChangeRun& run, NamedTimes& times)
{
  vtkNew<vtkLight> light;
  light->SetPositional(false);
  run.GetRenderer()->RemoveAllLights();
  run.GetRenderer()->AddLight(light);
  run.GetRenderer()->AutomaticLightCreationOff();
  run.GetVolume()->GetProperty()->ShadeOn();
  run.GetMapper()->SetGlobalIlluminationReach(1.0f);
  times.emplace_back("shadows, light moved",
    run.Measure([&light](int i) { light->SetPosition(1.0, 2.0, 0.1 * i); }));
  times.emplace_back(
    "shadows, opacity moved", run.Measure([&run](int) { run.MoveOpacity(-0.01); }));
  run.GetMapper()->SetGlobalIlluminationReach(0.0f);
  run.GetVolume()->GetProperty()->ShadeOff();
}

NamedTimes MeasureAll(vtkUnstructuredGrid* mesh, const VolumeOptions& options)
{
  NamedTimes times;
  {
    ChangeRun run(mesh, options);
    MeasureTurning(run, times);
    MeasureShadows(run, times);
    times.emplace_back("opacity moved", run.Measure([&run](int) { run.MoveOpacity(-0.01); }));
    times.emplace_back("first frame", run.Measure([&run](int) { run.SetNewMapper(); }));
  }
  const test::Grid curved = MakeCurvedBlock(options.Cubes / 2 + 1);
  ChangeRun run(curved, options);
  times.emplace_back(
    "first frame, divided cells", run.Measure([&run](int) { run.SetNewMapper(); }));
  return times;
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool PrintChanges(std::ostream& out, const VolumeOptions& options)
{
  const test::Grid mesh = MakeVolumeMesh(options);
  const NamedTimes times = MeasureAll(mesh, options);
  out << "| " << mesh->GetNumberOfCells() << " cells, " << options.Width << " x " << options.Height
      << " | ms CPU |\n|---|---|\n"
      << std::fixed << std::setprecision(1);
  for (const auto& [name, time] : times)
  {
    out << "| " << name << " | " << time << " |\n";
  }
  return options.Json.empty() || WriteTimes(options.Json, times);
}

} // namespace benchmark
} // namespace meniscus

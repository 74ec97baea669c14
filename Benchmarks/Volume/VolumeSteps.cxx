// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeSteps.h"

#include "TestMeshes.h"
#include "TestTransferFunctions.h"
#include "VolumeComparison.h"
#include "VolumeOptions.h"
#include "VolumeOutput.h"
#include "VolumeScene.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>
#include <iomanip>
#include <ostream>
#include <string>

namespace meniscus::benchmark
{

namespace
{

using Mapper = vtkTetrahedraRayCastMapper;

constexpr int Size = 8;

/** The arrays that differ between two steps in their values. */
struct StepKind
{
  const char* Name;
  bool Scalars;
  bool Points;
};

constexpr StepKind Kinds[4] = { { "scalars", true, false }, { "points", false, true },
  { "both", true, true }, { "equal values", false, false } };

/** A copy of the mesh with new arrays; those of the kind have other values. */
test::Grid MakeStep(vtkUnstructuredGrid* mesh, const StepKind& kind, int number)
{
  test::Grid step = test::Grid::New();
  step->DeepCopy(mesh);
  const double share = 1e-3 * (1 + number % 7);
  vtkDataArray* scalars = step->GetPointData()->GetScalars();
  vtkDataArray* points = step->GetPoints()->GetData();
  const double radius = 0.5 * mesh->GetLength();
  for (vtkIdType p = 0; p < step->GetNumberOfPoints(); ++p)
  {
    if (kind.Scalars)
    {
      scalars->SetTuple1(p, scalars->GetTuple1(p) * (1.0 + share * std::sin(0.01 * p)));
    }
    if (kind.Points)
    {
      double at[3];
      points->GetTuple(p, at);
      at[0] += share * radius * std::sin(3.0 * at[1] / radius);
      points->SetTuple(p, at);
    }
  }
  return step;
}

/** Frames of one mapper after another in one window. */
class StepRun
{
public:
  StepRun(vtkUnstructuredGrid* mesh, int backend, bool lit)
    : Scene(Size, Size)
    , Mesh(mesh)
    , Backend(backend)
  {
    const auto property =
      test::MakeProperty(test::FunctionKind::Smooth, mesh, test::DiagonalOf(mesh->GetBounds()));
    property->SetShade(lit);
    this->Scene.SetProperty(property);
    test::LookAt(this->Scene.GetRenderer(), mesh->GetBounds(), 30.0, 20.0);
  }

  /** Processor time of the first frame of a new mapper, without the compilation of shaders. */
  double MeasureSetUp(int repetitions)
  {
    std::vector<double> times;
    for (int i = 0; i <= repetitions; ++i)
    {
      vtkNew<Mapper> mapper;
      mapper->SetBackend(this->Backend);
      mapper->SetInputData(static_cast<vtkDataSet*>(this->Mesh));
      this->Scene.SetMapper(mapper);
      const double time = this->MeasureFrame();
      if (i > 0)
      {
        times.push_back(time);
      }
    }
    return SpreadOf(times).Median;
  }

  double MeasureSteps(const StepKind& kind, int count)
  {
    auto* mapper = Mapper::SafeDownCast(this->Scene.GetMapper());
    std::vector<double> times;
    for (int i = 0; i <= count; ++i)
    {
      const test::Grid step = MakeStep(this->Mesh, kind, i);
      mapper->SetInputData(static_cast<vtkDataSet*>(step));
      const double time = this->MeasureFrame();
      if (i > 0) // the first may differ in all arrays from the last of another kind
      {
        times.push_back(time);
      }
    }
    return SpreadOf(times).Median;
  }

private:
  double MeasureFrame()
  {
    const double begin = CpuMilliseconds();
    this->Scene.GetWindow()->Render();
    return CpuMilliseconds() - begin;
  }

  test::VolumeScene Scene;
  vtkUnstructuredGrid* Mesh;
  int Backend;
};

}

//------------------------------------------------------------------------------
bool PrintSteps(std::ostream& out, const VolumeOptions& options)
{
  const test::Grid mesh = MakeVolumeMesh(options);
  constexpr int steps = 20;
  NamedTimes times;
  out << "| " << mesh->GetNumberOfCells()
      << " cells | set-up, ms CPU | scalars, % | points, % | both, % | equal values, % |\n"
      << "|---|---|---|---|---|---|\n"
      << std::fixed;
  for (const bool lit : { false, true })
  {
    for (const int backend : { Mapper::NATIVE, Mapper::OPENGL })
    {
      StepRun run(mesh, backend, lit);
      const double setUp = run.MeasureSetUp(options.SetUpRepetitions);
      const std::string name =
        std::string(backend == Mapper::NATIVE ? "native" : "OpenGL") + (lit ? ", lit" : "");
      out << "| " << name << " | " << std::setprecision(1) << setUp;
      times.emplace_back(name + ": set-up", setUp);
      for (const StepKind& kind : Kinds)
      {
        const double time = run.MeasureSteps(kind, steps);
        out << " | " << std::setprecision(1) << 100.0 * time / setUp;
        times.emplace_back(name + ": step with new " + kind.Name, time);
      }
      out << " |" << std::endl;
    }
  }
  return options.Json.empty() || WriteTimes(options.Json, times);
}

} // namespace meniscus::benchmark

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cost of the imaginary cells of Weiler et al. (2003): vtkImaginaryCellFilter fills the space
 * between a mesh's boundary and its convex hull with cells, so that every ray enters once and no
 * list of entries is needed. Both meshes are drawn alternately by vtkTetrahedraRayCastMapper with
 * one constant scalar; on the filled mesh it finds one entry per ray. Unlike a renderer with
 * imaginary cells, it also integrates in these cells.
 *
 * TetGen is under the AGPL and runs as the program meniscus_tetgen: this program is built only with
 * MENISCUS_WITH_TETGEN, and no installed file uses it.
 */
#include "Volume/VolumeComparison.h"
#include "Volume/VolumeOptions.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkImaginaryCellFilter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolumeProperty.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <vector>

using namespace meniscus::benchmark;
using namespace meniscus::test;

namespace
{

/** Seconds after which TetGen is ended. */
constexpr double TimeLimit = 3600.0;

//------------------------------------------------------------------------------
// The mesh with its imaginary cells, which are no longer hidden: the ray caster would leave them
// out. All scalars are 0. Null if TetGen fails.
Grid Convexify(vtkUnstructuredGrid* grid, double& seconds, vtkIdType& imaginary)
{
  vtkNew<vtkImaginaryCellFilter> filter;
  filter->SetInputData(grid);
  filter->SetTimeLimit(TimeLimit);
  const auto begin = std::chrono::steady_clock::now();
  filter->Update();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const Grid filled = filter->GetOutput();
  if (filled->GetNumberOfCells() == 0)
  {
    return nullptr;
  }
  imaginary = filter->GetNumberOfImaginaryCells();
  filled->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  filled->GetPointData()->GetScalars()->Fill(0.0);
  return filled;
}

//------------------------------------------------------------------------------
int Run(const VolumeOptions& options)
{
  const Grid mesh = MakeVolumeMesh(options);
  if (!mesh)
  {
    std::cerr << "no cells or no point array in " << options.Mesh << '\n';
    return EXIT_FAILURE;
  }
  double seconds = 0.0;
  vtkIdType imaginary = 0;
  const Grid filled = Convexify(mesh, seconds, imaginary);
  if (!filled)
  {
    std::cerr << "no imaginary cells for "
              << (options.Mesh.empty() ? "the generated block" : options.Mesh) << '\n';
    return EXIT_FAILURE;
  }
  const DisplayHold hold;
  mesh->GetPointData()->GetScalars()->Fill(0.0); // as in the filled mesh
  std::cout << mesh->GetNumberOfCells() << " cells, " << imaginary
            << " imaginary ones; the filter took " << seconds << " s\n";
  for (const int backend :
    { vtkTetrahedraRayCastMapper::OPENGL, vtkTetrahedraRayCastMapper::NATIVE })
  {
    VolumeComparison entries(options, mesh);
    VolumeComparison convex(options, filled);
    const std::vector<Contestant> ours{ MakeOurs(backend, "ours") };
    std::vector<double> ratios;
    std::vector<double> times;
    entries.Enter(ours);
    convex.Enter(ours);
    // They alternate, so that both meet the same load.
    for (int turn = 0; turn < options.Repetitions; ++turn)
    {
      entries.MeasureTimes();
      convex.MeasureTimes();
      ratios.push_back(convex.GetFigures()[0].SteadyMs / entries.GetFigures()[0].SteadyMs);
      times.push_back(entries.GetFigures()[0].SteadyMs);
    }
    const auto steps = [](const VolumeComparison& c)
    { return static_cast<double>(c.GetOurs(0)->GetNumberOfTraversalSteps()); };
    std::cout << (backend == vtkTetrahedraRayCastMapper::OPENGL ? "opengl" : "native")
              << ": with entries per ray " << SpreadOf(times).Median << " ms/frame and "
              << entries.GetFigures()[0].SetUpMs << " ms to the first frame; filled "
              << SpreadOf(ratios).Median << " times the time per frame (" << SpreadOf(ratios).Low
              << " - " << SpreadOf(ratios).High << "), " << steps(convex) / steps(entries)
              << " times the steps, " << convex.GetFigures()[0].SetUpMs + 1e3 * seconds
              << " ms to the first frame\n";
  }
  return EXIT_SUCCESS;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const VolumeOptions options = ParseVolumeOptions(argc, argv);
  if (options.Help || !options.Problem.empty() || !HasDisplay())
  {
    std::cerr << options.Problem << "\nmeniscus_benchmark_convexification [options], under a "
              << "display; the options --mesh, --cubes, --size, --views, --repetitions of\n\n"
              << VolumeUsage;
    return options.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return Run(options);
}

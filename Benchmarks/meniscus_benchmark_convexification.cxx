// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cost of the imaginary cells of Weiler et al. (2003): TetGen fills the space between a mesh's
 * boundary and its convex hull with cells, so that every ray enters once and no list of entries is
 * needed. Both meshes are drawn alternately by vtkTetrahedraRayCastMapper with one constant scalar;
 * on the filled mesh it finds one entry per ray. Unlike a renderer with imaginary cells, it also
 * integrates in these cells.
 *
 * TetGen is under the AGPL and runs as the program meniscus_tetgen: this program is built only with
 * MENISCUS_WITH_TETGEN, and no installed file uses it.
 */
#include "Filters/Mesher/MesherProcess.h"
#include "Volume/VolumeComparison.h"
#include "Volume/VolumeOptions.h"

#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>
#include <vector>

using namespace meniscus::benchmark;
using namespace meniscus::test;

namespace
{

/** Seconds after which TetGen is ended. */
constexpr double TimeLimit = 3600.0;

/** A mesh without coincident points: where it touches itself along a seam, it is one piece. */
struct JoinedMesh
{
  std::vector<double> Points;
  std::vector<meniscus::Tetrahedron> Cells;
};

//------------------------------------------------------------------------------
JoinedMesh JoinPoints(vtkUnstructuredGrid* grid)
{
  JoinedMesh mesh;
  std::map<std::array<double, 3>, int> known;
  std::vector<int> place;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    std::array<double, 3> x;
    grid->GetPoint(p, x.data());
    const auto found = known.emplace(x, static_cast<int>(known.size()));
    if (found.second)
    {
      mesh.Points.insert(mesh.Points.end(), x.begin(), x.end());
    }
    place.push_back(found.first->second);
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    meniscus::Tetrahedron cell;
    std::transform(ids->begin(), ids->end(), cell.begin(),
      [&](vtkIdType id) { return place[static_cast<std::size_t>(id)]; });
    meniscus::Tetrahedron sorted = cell;
    std::sort(sorted.begin(), sorted.end());
    // Cells without volume that were between coincident points are gone.
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
    {
      mesh.Cells.push_back(cell);
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
// Faces that belong to one cell only.
std::vector<meniscus::Triangle> BoundaryOf(const JoinedMesh& mesh)
{
  std::map<meniscus::Triangle, int> count;
  for (const meniscus::Tetrahedron& cell : mesh.Cells)
  {
    for (std::size_t without = 0; without < 4; ++without)
    {
      meniscus::Triangle face{ cell[(without + 1) % 4], cell[(without + 2) % 4],
        cell[(without + 3) % 4] };
      std::sort(face.begin(), face.end());
      ++count[face];
    }
  }
  std::vector<meniscus::Triangle> boundary;
  for (const auto& face : count)
  {
    if (face.second == 1)
    {
      boundary.push_back(face.first);
    }
  }
  return boundary;
}

//------------------------------------------------------------------------------
// The mesh and its filling as one grid; null if TetGen fails. TetGen numbers the part outside of
// all facets -1.
Grid Convexify(vtkUnstructuredGrid* grid, double& seconds, vtkIdType& imaginary)
{
  const JoinedMesh mesh = JoinPoints(grid);
  std::vector<glm::dvec3> places;
  for (std::size_t p = 0; p < mesh.Points.size(); p += 3)
  {
    places.emplace_back(mesh.Points[p], mesh.Points[p + 1], mesh.Points[p + 2]);
  }
  meniscus::MeshingTask task;
  task.Surface = meniscus::JoinCoincidentPoints(places, BoundaryOf(mesh));
  task.KeepsSurface = true;
  task.FillsHull = true;
  meniscus::MesherProcess process;
  process.Program = meniscus::FindTetGenProgram();
  process.TimeLimit = TimeLimit;
  process.GoesOn = [](double) { return true; };
  meniscus::MeshingAnswer answer;
  const auto begin = std::chrono::steady_clock::now();
  const meniscus::ProcessEnd end = process.Run(task, answer);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (end != meniscus::ProcessEnd::Answered || answer.End != meniscus::MeshingEnd::Done)
  {
    std::cerr << "end of the process " << static_cast<int>(end) << ", of TetGen "
              << static_cast<int>(answer.End) << " (3: the boundary crosses itself)\n";
    return nullptr;
  }
  std::vector<double> points = mesh.Points;
  const std::size_t own = task.Surface.Points.size();
  for (std::size_t p = own; p < answer.Cells.Points.size(); ++p)
  {
    const glm::dvec3& x = answer.Cells.Points[p];
    points.insert(points.end(), { x.x, x.y, x.z });
  }
  std::vector<vtkIdType> cells;
  for (const meniscus::Tetrahedron& cell : mesh.Cells)
  {
    cells.insert(cells.end(), cell.begin(), cell.end());
  }
  for (std::size_t c = 0; c < answer.Cells.Cells.size(); ++c)
  {
    if (answer.Cells.Regions[c] >= 0)
    {
      continue;
    }
    ++imaginary;
    for (const int corner : answer.Cells.Cells[c])
    {
      const auto id = static_cast<std::size_t>(corner);
      cells.push_back(static_cast<vtkIdType>(
        id < own ? task.Surface.Sources[id] : mesh.Points.size() / 3 + id - own));
    }
  }
  return MakeGrid(points, cells, ConstantField(0.0));
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
    std::cerr << "TetGen crashed or gave up on the boundary of "
              << (options.Mesh.empty() ? "the generated block" : options.Mesh) << '\n';
    return EXIT_FAILURE;
  }
  const DisplayHold hold;
  mesh->GetPointData()->GetScalars()->Fill(0.0); // as in the filled mesh
  std::cout << mesh->GetNumberOfCells() << " cells, " << imaginary
            << " imaginary ones; TetGen took " << seconds << " s\n";
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

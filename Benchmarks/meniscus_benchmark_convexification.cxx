// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cost of the imaginary cells of Weiler et al. (2003): TetGen fills the space between a mesh's
 * boundary and its convex hull with cells, so that every ray enters once and no list of entries is
 * needed. Both meshes are drawn alternately by vtkTetrahedraRayCastMapper with one constant scalar;
 * on the filled mesh it finds one entry per ray. Unlike a renderer with imaginary cells, it also
 * integrates in these cells.
 *
 * TetGen crashes on boundaries that touch or intersect themselves, so it runs in a separate
 * process. It is under the AGPL: this program is built only with MENISCUS_WITH_TETGEN, and no
 * installed file uses it.
 */
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

#define TETLIBRARY
#include <tetgen.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <vector>

using namespace meniscus::benchmark;
using namespace meniscus::test;

namespace
{

using Triangle = std::array<vtkIdType, 3>;

/** Points (the used points of the mesh, then TetGen's own) and cells outside of the mesh. */
struct Filling
{
  std::vector<double> Points;
  std::vector<int> Cells;
  double Seconds = 0.0;
};

//------------------------------------------------------------------------------
// Faces that belong to one cell only.
std::vector<Triangle> boundaryOf(vtkUnstructuredGrid* grid)
{
  std::map<Triangle, int> count;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    for (int without = 0; without < 4; ++without)
    {
      Triangle face{ ids->GetId((without + 1) % 4), ids->GetId((without + 2) % 4),
        ids->GetId((without + 3) % 4) };
      std::sort(face.begin(), face.end());
      ++count[face];
    }
  }
  std::vector<Triangle> boundary;
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
template <typename Value>
bool sendAll(int out, const std::vector<Value>& values)
{
  const std::size_t size = values.size();
  bool good = write(out, &size, sizeof size) == static_cast<ssize_t>(sizeof size);
  const char* at = reinterpret_cast<const char*>(values.data());
  for (std::size_t left = size * sizeof(Value); good && left > 0;)
  {
    const ssize_t sent = write(out, at, left);
    good = sent > 0;
    at += sent;
    left -= static_cast<std::size_t>(std::max<ssize_t>(sent, 0));
  }
  return good;
}

//------------------------------------------------------------------------------
bool receive(int in, char* at, std::size_t left)
{
  while (left > 0)
  {
    const ssize_t size = read(in, at, left);
    if (size <= 0)
    {
      return false;
    }
    at += size;
    left -= static_cast<std::size_t>(size);
  }
  return true;
}

//------------------------------------------------------------------------------
template <typename Value>
bool receiveAll(int in, std::vector<Value>& values)
{
  std::size_t size = 0;
  if (!receive(in, reinterpret_cast<char*>(&size), sizeof size))
  {
    return false;
  }
  values.resize(size);
  return receive(in, reinterpret_cast<char*>(values.data()), size * sizeof(Value));
}

//------------------------------------------------------------------------------
// The boundary in TetGen's form: facets of one triangle, and the points that they use.
void describe(const std::vector<double>& points, const std::vector<Triangle>& faces, tetgenio& in)
{
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(points.size() / 3);
  in.pointlist = new REAL[points.size()];
  std::copy(points.begin(), points.end(), in.pointlist);
  in.numberoffacets = static_cast<int>(faces.size());
  in.facetlist = new tetgenio::facet[faces.size()];
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    tetgenio::facet& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3];
    std::copy(faces[i].begin(), faces[i].end(), facet.polygonlist->vertexlist);
  }
}

//------------------------------------------------------------------------------
// Runs in the child: constrained Delaunay cells up to the hull, with the facets unchanged. The part
// outside of all closed facets has the region -1. J keeps the indices of coincident points.
[[noreturn]] void runTetGen(
  const std::vector<double>& points, const std::vector<Triangle>& faces, int out)
{
  tetgenio in;
  describe(points, faces, in);
  tetgenio result;
  char switches[] = "pYcAJQ";
  tetrahedralize(switches, &in, &result);
  std::vector<int> cells;
  for (int c = 0; c < result.numberoftetrahedra; ++c)
  {
    if (result.tetrahedronattributelist[c * result.numberoftetrahedronattributes] < 0.0)
    {
      const int* ids = result.tetrahedronlist + 4 * c;
      cells.insert(cells.end(), ids, ids + 4);
    }
  }
  const std::vector<double> all(result.pointlist, result.pointlist + 3 * result.numberofpoints);
  _exit(sendAll(out, all) && sendAll(out, cells) ? EXIT_SUCCESS : EXIT_FAILURE);
}

//------------------------------------------------------------------------------
bool fill(const std::vector<double>& points, const std::vector<Triangle>& faces, Filling& filling)
{
  int ends[2];
  if (pipe(ends) != 0)
  {
    return false;
  }
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0)
  {
    close(ends[0]);
    runTetGen(points, faces, ends[1]);
  }
  close(ends[1]);
  const bool good =
    child > 0 && receiveAll(ends[0], filling.Points) && receiveAll(ends[0], filling.Cells);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  filling.Seconds = time.count();
  return good;
}

//------------------------------------------------------------------------------
// The mesh and its filling as one grid; null if TetGen fails.
Grid convexify(vtkUnstructuredGrid* grid, double& seconds, vtkIdType& imaginary)
{
  std::vector<Triangle> faces = boundaryOf(grid);
  std::map<vtkIdType, vtkIdType> local;
  std::vector<vtkIdType> source;
  std::vector<double> points;
  for (Triangle& face : faces)
  {
    for (vtkIdType& id : face)
    {
      const auto known = local.emplace(id, static_cast<vtkIdType>(source.size()));
      if (known.second)
      {
        const double* x = grid->GetPoint(id);
        points.insert(points.end(), x, x + 3);
        source.push_back(id);
      }
      id = known.first->second;
    }
  }
  Filling filling;
  if (!fill(points, faces, filling))
  {
    return nullptr;
  }
  seconds = filling.Seconds;
  imaginary = static_cast<vtkIdType>(filling.Cells.size() / 4);
  std::vector<double> allPoints;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double* x = grid->GetPoint(p);
    allPoints.insert(allPoints.end(), x, x + 3);
  }
  allPoints.insert(allPoints.end(),
    filling.Points.begin() + static_cast<std::ptrdiff_t>(points.size()), filling.Points.end());
  std::vector<vtkIdType> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    cells.insert(cells.end(), ids->begin(), ids->end());
  }
  const auto own = static_cast<vtkIdType>(source.size());
  for (const int id : filling.Cells)
  {
    cells.push_back(id < own ? source[id] : grid->GetNumberOfPoints() + id - own);
  }
  return makeGrid(allPoints, cells, constantField(0.0));
}

//------------------------------------------------------------------------------
int run(const VolumeOptions& options)
{
  const Grid mesh = makeVolumeMesh(options);
  if (!mesh)
  {
    std::cerr << "no cells or no point array in " << options.Mesh << '\n';
    return EXIT_FAILURE;
  }
  double seconds = 0.0;
  vtkIdType imaginary = 0;
  const Grid filled = convexify(mesh, seconds, imaginary);
  if (!filled)
  {
    std::cout << "TetGen crashed or gave up on the boundary of "
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
    const std::vector<Contestant> ours{ makeOurs(backend, "ours") };
    std::vector<double> ratios;
    std::vector<double> times;
    entries.enter(ours);
    convex.enter(ours);
    // They alternate, so that both meet the same load.
    for (int turn = 0; turn < options.Repetitions; ++turn)
    {
      entries.measureTimes();
      convex.measureTimes();
      ratios.push_back(convex.figures()[0].SteadyMs / entries.figures()[0].SteadyMs);
      times.push_back(entries.figures()[0].SteadyMs);
    }
    const auto steps = [](const VolumeComparison& c)
    { return static_cast<double>(c.ours(0)->GetNumberOfTraversalSteps()); };
    std::cout << (backend == vtkTetrahedraRayCastMapper::OPENGL ? "opengl" : "native")
              << ": with entries per ray " << spreadOf(times).Median << " ms/frame and "
              << entries.figures()[0].SetUpMs << " ms to the first frame; filled "
              << spreadOf(ratios).Median << " times the time per frame (" << spreadOf(ratios).Low
              << " - " << spreadOf(ratios).High << "), " << steps(convex) / steps(entries)
              << " times the steps, " << convex.figures()[0].SetUpMs + 1e3 * seconds
              << " ms to the first frame\n";
  }
  return EXIT_SUCCESS;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const VolumeOptions options = parseVolumeOptions(argc, argv);
  if (options.Help || !options.Problem.empty() || !hasDisplay())
  {
    std::cerr << options.Problem << "\nmeniscus_benchmark_convexification [options], under a "
              << "display; the options --mesh, --cubes, --size, --views, --repetitions of\n\n"
              << VolumeUsage;
    return options.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return run(options);
}

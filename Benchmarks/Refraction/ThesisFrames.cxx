// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Frames.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "Timing.h"
#include "WellScene.h"

#include <vtkPolyData.h>
#include <vtkRefractedGeometryFilter.h>

#include <algorithm>
#include <functional>
#include <iomanip>
#include <limits>
#include <utility>
#include <vector>

namespace meniscus::benchmark
{

namespace
{

constexpr int Frames = 40;
constexpr int SharedQuads = 18; // 1,805 vertices, for the thesis's 1,820 of Table 4.9
const glm::dvec3 SharedEye(20.0, 300.0, 0.0);

struct ThesisFrames
{
  int Facets;
  int Vertices;
  const char* Complete[3];    ///< Table 4.6: planar, hemisphere up, hemisphere down
  const char* Containment[2]; ///< Table 4.7: centred, at the side
  const char* Drawing;        ///< Table 4.8
};

const ThesisFrames Printed[] = {
  { 120, 105, { "492-530", "450-495", "480-535" }, { "520-560", "271-272" }, "705-709" },
  { 120, 528, { "200-226", "188-222", "187-220" }, { "273-290", "76-77" }, "584-586" },
  { 120, 2628, { "46-55", "47-57", "45-51" }, { "76-77", "16-17" }, "233-234" },
  { 484, 105, { "430-485", "407-440", "400-450" }, { "485-525", "140-142" }, "681-685" },
  { 484, 528, { "172-200", "176-200", "142-177" }, { "245-258", "33-34" }, "568-571" },
  { 484, 2628, { "41-54", "44-52", "33-41" }, { "67-68", "6-7" }, "232-233" },
  { 1820, 105, { "338-390", "335-375", "310-370" }, { "443-484", "67-68" }, "653-656" },
  { 1820, 528, { "136-150", "145-180", "107-139" }, { "221-236", "14-15" }, "549-551" },
  { 1820, 2628, { "31-37", "37-47", "30-38" }, { "61-62", "2-3" }, "229-230" },
};

/** A row of Table 4.9: shares in cell creation, in containment and in its inner function. */
struct ThesisShares
{
  int Facets;
  bool Aside;
  const char* Text;
};

const ThesisShares PrintedShares[] = {
  { 120, false, "0.3, 51.3 (33.1)" },
  { 120, true, "0.1, 92.9 (73.8)" },
  { 484, false, "0.5, 55.5 (37.2)" },
  { 484, true, "0.1, 96.8 (78.4)" },
  { 1820, false, "1.2, 58.5 (40.5)" },
  { 1820, true, "0.2, 98.3 (79.6)" },
};

// Squares and wells with the nearest numbers of facets.
int CellsFor(int facets)
{
  return facets == 120 ? 8 : (facets == 484 ? 16 : 30);
}

int QuadsFor(int vertices)
{
  return vertices == 105 ? 4 : (vertices == 528 ? 9 : 22);
}

using Change = std::function<void(WellScene&, int frame)>;

/** Frames per second of processor time, so that other programs do not count. */
double FramesPerSecond(WellScene& scene, const Change& change)
{
  std::vector<Seconds> times;
  for (int i = 0; i < Frames; ++i)
  {
    times.push_back(TimeOnce(
      [&]
      {
        change(scene, i);
        scene.Draw();
      }));
  }
  return 1.0 / MedianOf(times).Cpu;
}

/** Frames per second of both membrane models, as cells of a table. */
void PrintModels(
  std::ostream& out, const ThesisFrames& row, WellSurface surface, bool aside, const Change& change)
{
  for (const int model :
    { vtkRefractedGeometryFilter::FLAT_FACETS, vtkRefractedGeometryFilter::CURVED })
  {
    WellScene scene(CellsFor(row.Facets), QuadsFor(row.Vertices), surface);
    if (aside)
    {
      scene.MoveWellAside();
    }
    scene.GetFilter()->SetMembraneModel(model);
    scene.GetFilter()->SetImagesToFirstImage();
    scene.Draw();
    out << " | " << FramesPerSecond(scene, change);
  }
}

void PrintComplete(std::ostream& out)
{
  const Change all = [](WellScene& scene, int i)
  {
    scene.MoveMembrane(0.1 * i);
    scene.MoveEye(0.01 * i);
  };
  const std::pair<const char*, WellSurface> shapes[] = { { "planar", WellSurface::Plane },
    { "hemisphere up", WellSurface::HemisphereUp },
    { "hemisphere down", WellSurface::HemisphereDown } };
  out << "Table 4.6, everything recomputed, frames per second of processor time\n| shape | facets "
         "| vertices | thesis | "
         "FLAT_FACETS | CURVED, one image |\n|---|---|---|---|---|---|\n";
  for (std::size_t shape = 0; shape < 3; ++shape)
  {
    for (const ThesisFrames& row : Printed)
    {
      out << "| " << shapes[shape].first << " | " << row.Facets << " | " << row.Vertices << " | "
          << row.Complete[shape];
      PrintModels(out, row, shapes[shape].second, false, all);
      out << " |" << std::endl;
    }
  }
}

void PrintContainment(std::ostream& out)
{
  const Change object = [](WellScene& scene, int i) { scene.MoveWell(0.1 * i); };
  out << "\nTable 4.7, cell creation skipped: the object moves, frames per second of processor "
         "time\n| facets | vertices | "
         "thesis, centre | FLAT_FACETS | CURVED | thesis, side | FLAT_FACETS | CURVED "
         "|\n|---|---|---|---|---|---|---|---|\n";
  for (const ThesisFrames& row : Printed)
  {
    out << "| " << row.Facets << " | " << row.Vertices;
    for (const bool aside : { false, true })
    {
      out << " | " << row.Containment[aside];
      PrintModels(out, row, WellSurface::Plane, aside, object);
    }
    out << " |" << std::endl;
  }
}

void PrintDrawing(std::ostream& out)
{
  out << "\nTable 4.8, drawing alone, frames per second of processor time\n| facets | vertices | "
         "thesis | FLAT_FACETS | "
         "CURVED, one image |\n|---|---|---|---|---|\n";
  for (const ThesisFrames& row : Printed)
  {
    out << "| " << row.Facets << " | " << row.Vertices << " | " << row.Drawing;
    PrintModels(out, row, WellSurface::Plane, false, [](WellScene&, int) {});
    out << " |" << std::endl;
  }
}

using CellTest = std::pair<std::size_t, std::int32_t>; ///< number of a point, number of a facet

glm::dvec3 PointAt(const std::vector<double>& points, std::size_t i)
{
  return { points[3 * i], points[3 * i + 1], points[3 * i + 2] };
}

/** The tests of FlatMembraneSolver::SolvePoint: those of the facets that its tree suggests. */
std::vector<CellTest> ListTests(const FlatMembraneSolver& solver, const std::vector<double>& points)
{
  const Membrane& membrane = solver.GetMembrane();
  std::vector<glm::dvec3> centroids;
  for (const Membrane::Facet& facet : membrane.GetFacets())
  {
    glm::dvec3 sum(0.0);
    for (const std::int32_t vertex : facet)
    {
      sum += membrane.GetPositions()[static_cast<std::size_t>(vertex)];
    }
    centroids.push_back(sum / 3.0);
  }
  RayTubeTree tree;
  tree.Build(centroids, membrane.GetRadius());
  tree.Refit(
    [&solver](std::int32_t facet) { return solver.GetCells().GetBounds(facet); }, SerialLoop);
  std::vector<CellTest> tests;
  for (std::size_t i = 0; 3 * i < points.size(); ++i)
  {
    const glm::dvec3 local = PointAt(points, i) - membrane.GetOrigin();
    std::int32_t first = std::numeric_limits<std::int32_t>::max();
    tree.Visit(local, glm::dvec3(0.0),
      [&](std::int32_t facet)
      {
        tests.emplace_back(i, facet);
        CellHit hit;
        first = solver.GetCells().Contains(facet, local, hit) ? facet : first;
        return first;
      });
  }
  return tests;
}

double TimeTests(const FlatMembraneSolver& solver, const std::vector<double>& points,
  const std::vector<CellTest>& tests)
{
  const glm::dvec3 origin = solver.GetMembrane().GetOrigin();
  volatile int sink = 0; // keeps the tests
  return TimeMedian(
    [&]
    {
      int held = 0;
      for (const CellTest& test : tests)
      {
        CellHit hit;
        held += solver.GetCells().Contains(test.second, PointAt(points, test.first) - origin, hit);
      }
      sink = held;
    })
    .Cpu;
}

/** Processor time of a frame in which cells and virtual vertices are computed again. */
double TimeFrame(WellScene& scene, int model)
{
  scene.GetFilter()->SetMembraneModel(model);
  scene.GetFilter()->SetImagesToFirstImage();
  int frame = 0;
  return TimeMedian(
    [&]
    {
      scene.MoveEye(0.01 * ++frame);
      scene.Draw();
    },
    Frames)
    .Cpu;
}

/** Shares of a frame that also has `rest` seconds of other work, in percent. */
void PrintShare(std::ostream& out, double eye, double solve, double inner, double rest)
{
  const double percent = 100.0 / (eye + solve + rest);
  out << " | " << percent * eye << ", " << percent * solve;
  if (inner > 0.0)
  {
    out << " (" << percent * inner << ")";
  }
}

void PrintSharesOf(std::ostream& out, const ThesisShares& row)
{
  WellScene scene(CellsFor(row.Facets), SharedQuads, WellSurface::Plane);
  if (row.Aside)
  {
    scene.MoveWellAside();
  }
  std::vector<double> points;
  for (vtkIdType p = 0; p < scene.GetWell()->GetNumberOfPoints(); ++p)
  {
    const double* x = scene.GetWell()->GetPoint(p);
    points.insert(points.end(), x, x + 3);
  }
  std::vector<VirtualVertex> vertices(points.size() / 3);
  const auto mesh = scene.MakeMesh();
  const auto time = [&](auto& solver, double& eye, double& solve)
  {
    solver.SetMembrane(mesh.AsInput());
    eye = TimeMedian([&] { solver.SetEye(SharedEye, 1.0, 1.333); }).Cpu;
    solve =
      TimeMedian([&] { solver.Solve(points.data(), 0, vertices.size(), vertices.data()); }).Cpu;
  };
  double eye = 0.0;
  double solve = 0.0;
  FlatMembraneSolver flat;
  time(flat, eye, solve);
  const double rest =
    std::max(TimeFrame(scene, vtkRefractedGeometryFilter::FLAT_FACETS) - eye - solve, 0.0);
  const double loop = TimeMedian(
    [&]
    {
      for (std::size_t i = 0; i < vertices.size(); ++i)
      {
        vertices[i] = flat.SolvePointByBruteForce(PointAt(points, i));
      }
    }).Cpu;
  PrintShare(out, eye, loop, 0.0, rest);
  PrintShare(out, eye, solve, TimeTests(flat, points, ListTests(flat, points)), rest);
  CurvedMembraneSolver curved;
  time(curved, eye, solve);
  PrintShare(out, eye, solve, 0.0,
    std::max(TimeFrame(scene, vtkRefractedGeometryFilter::CURVED) - eye - solve, 0.0));
}

void PrintShares(std::ostream& out)
{
  out << "\nTable 4.9, 1,805 vertices: % of a frame in cell creation and cell containment (in the "
         "tests of a point in a cell)\n| facets | object | thesis | its loop over the facets | "
         "FLAT_FACETS | CURVED |\n|---|---|---|---|---|---|\n";
  for (const ThesisShares& row : PrintedShares)
  {
    out << "| " << row.Facets << " | " << (row.Aside ? "offset" : "centred") << " | " << row.Text;
    PrintSharesOf(out, row);
    out << " |" << std::endl;
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
void PrintThesisFrames(std::ostream& out)
{
  out << std::fixed << std::setprecision(0);
  PrintComplete(out);
  PrintContainment(out);
  PrintDrawing(out);
  out << std::setprecision(1);
  PrintShares(out);
}

} // namespace meniscus::benchmark

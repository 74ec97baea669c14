// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Growth.h"

#include "Accuracy.h"
#include "Chart.h"
#include "Common/CoherentOrder.h"
#include "MembraneMeshes.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "Refraction/Images/ObjectImages.h"
#include "Timing.h"

#include <vtkSMPTools.h>
#include <vtkType.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <numeric>
#include <random>
#include <sstream>
#include <vector>

namespace meniscus::benchmark
{

namespace
{

using reference::MembraneMesh;

const glm::dvec3 Eye(20.0, 300.0, 10.0);
constexpr double Exterior = 1.0;
constexpr double Interior = 1.333;

// A box of n^3 points below the waves, in grid order.
std::vector<double> MakePoints(int n)
{
  std::vector<double> points;
  for (int i = 0; i < n * n * n; ++i)
  {
    points.push_back(160.0 * ((i % n + 0.5) / n - 0.5));
    points.push_back(-10.0 - 100.0 * (i / n % n + 0.5) / n);
    points.push_back(160.0 * ((i / (n * n) + 0.5) / n - 0.5));
  }
  return points;
}

std::vector<double> Shuffle(const std::vector<double>& points)
{
  std::vector<std::size_t> order(points.size() / 3);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  std::vector<double> shuffled;
  for (std::size_t i : order)
  {
    shuffled.insert(shuffled.end(), points.begin() + static_cast<std::ptrdiff_t>(3 * i),
      points.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
  }
  return shuffled;
}

MembraneMesh MakeWaves(int cells)
{
  return reference::MakeWaves(200.0, cells, 3.0, 2.0);
}

template <typename Geometry>
double MicrosecondsPerVertex(const Geometry& geometry, const std::vector<double>& points)
{
  const std::size_t count = points.size() / 3;
  std::vector<VirtualVertex> vertices(count);
  // Found once per object, solved for each eye.
  const std::vector<std::uint32_t> order = FindCoherentOrder(points.data(), count);
  const auto solve = [&geometry](const double* some, std::size_t begin, std::size_t end,
                       VirtualVertex* answers) { geometry.Solve(some, begin, end, answers); };
  return 1e6 / static_cast<double>(count) *
    TimeMedian(
      [&]
      {
        SolveInOrder<CurvedMembraneSolver::Chain * CurvedMembraneSolver::ChainsAtOnce>(
          points.data(), order, 0, count, vertices.data(), solve);
      })
      .Cpu;
}

double MicrosecondsPerOrderedPoint(const std::vector<double>& points)
{
  return 3e6 / static_cast<double>(points.size()) *
    TimeMedian([&] { FindCoherentOrder(points.data(), points.size() / 3); }).Cpu;
}

void MeasureFlat(
  const MembraneMesh& mesh, const std::vector<double>& points, GrowthFigures& figures)
{
  FlatMembraneSolver geometry;
  figures.FlatShape = TimeMedian([&] { geometry.SetMembrane(mesh.AsInput()); }).Cpu;
  figures.FlatEye = TimeMedian([&] { geometry.SetEye(Eye, Exterior, Interior); }).Cpu;
  figures.FlatCoherent = MicrosecondsPerVertex(geometry, points);
  const std::vector<double> shuffled = Shuffle(points);
  figures.FlatScattered = MicrosecondsPerVertex(geometry, shuffled);
  // About 4e6 cell tests in all.
  const std::size_t sample = std::max<std::size_t>(4000000 / figures.Facets, 4);
  double sink = 0.0;
  const double seconds = TimeOnce(
    [&]
    {
      for (std::size_t i = 0; i < sample; ++i)
      {
        const double* p = shuffled.data() + 3 * (i % (shuffled.size() / 3));
        sink += geometry.SolvePointByBruteForce({ p[0], p[1], p[2] }).Depth;
      }
    }).Cpu;
  figures.FlatBruteForce = sink >= 0.0 ? 1e6 * seconds / static_cast<double>(sample) : 0.0;
}

void MeasureCurved(
  const MembraneMesh& mesh, const std::vector<double>& points, GrowthFigures& figures)
{
  CurvedMembraneSolver geometry;
  figures.CurvedShape = TimeMedian(
    [&]
    {
      geometry.Clear();
      geometry.SetMembrane(mesh.AsInput());
    }).Cpu;
  MembraneMesh moved = mesh;
  figures.CurvedDeform = TimeMedian(
    [&]
    {
      moved.Points[1] += 1e-6;
      geometry.SetMembrane(moved.AsInput());
    }).Cpu;
  geometry.SetMembrane(mesh.AsInput());
  figures.CurvedEye = TimeMedian([&] { geometry.SetEye(Eye, Exterior, Interior); }).Cpu;
  figures.CurvedOne = MicrosecondsPerVertex(geometry, points);
  const std::vector<double> shuffled = Shuffle(points);
  figures.CurvedScattered = MicrosecondsPerVertex(geometry, shuffled);
  figures.PointOrder = MicrosecondsPerOrderedPoint(shuffled);
  figures.CurvedAll = 3e6 / static_cast<double>(points.size()) *
    TimeMedian(
      [&]
      {
        geometry.PrepareField();
        ObjectImages object(geometry);
        object.SetPoints(points.data(), points.size() / 3, false);
        object.PrepareUnique(points.size() / 3, 0, SerialLoop);
        object.SolvePoints(0, points.size() / 3);
        object.FinishPoints();
      })
      .Cpu;
  std::vector<VirtualVertex> images;
  figures.CurvedSearch = 3e6 / static_cast<double>(points.size()) *
    TimeMedian(
      [&]
      {
        for (std::size_t i = 0; i < points.size(); i += 3)
        {
          geometry.FindImages({ points[i], points[i + 1], points[i + 2] }, images);
        }
      })
      .Cpu;
}

std::vector<GrowthFigures> GrowByFacets()
{
  std::printf("%9s | %9s %9s %9s %9s %10s %9s | %9s %9s %9s %9s %9s %9s %9s %9s\n", "facets",
    "flat shape", "eye s", "us grid", "us random", "us brute", "error", "curved s", "deform s",
    "eye s", "us one", "us random", "us order", "us all", "error");
  std::vector<GrowthFigures> all;
  for (const int cells : { 7, 23, 64, 128, 226, 400, 708 })
  {
    GrowthFigures f = MeasureGrowth(cells);
    const WaveError error = MeasureWaveError(cells);
    f.FlatError = error.Flat;
    f.CurvedError = error.Curved;
    std::printf("%9zu | %9.4f %9.4f %9.3f %9.3f %10.1f %9.2e | %9.4f %9.4f %9.4f %9.3f %9.3f %9.3f "
                "%9.3f %9.2e\n",
      f.Facets, f.FlatShape, f.FlatEye, f.FlatCoherent, f.FlatScattered, f.FlatBruteForce,
      f.FlatError, f.CurvedShape, f.CurvedDeform, f.CurvedEye, f.CurvedOne, f.CurvedScattered,
      f.PointOrder, f.CurvedAll, f.CurvedError);
    std::fflush(stdout);
    all.push_back(f);
  }
  return all;
}

std::string GrowByVertices()
{
  std::ostringstream json;
  json << "  \"vertices\": [\n";
  const MembraneMesh mesh = MakeWaves(128);
  CurvedMembraneSolver geometry;
  geometry.SetMembrane(mesh.AsInput());
  geometry.SetEye(Eye, Exterior, Interior);
  std::printf("\n32768 facets, CURVED\n%9s | %9s\n", "vertices", "us one");
  const int sizes[] = { 10, 22, 46, 100 };
  for (const int n : sizes)
  {
    const double one = MicrosecondsPerVertex(geometry, MakePoints(n));
    std::printf("%9d | %9.3f\n", n * n * n, one);
    json << "    { \"vertices\": " << n * n * n << ", \"curved_us_per_vertex_one_image\": " << one
         << " }" << (n != 100 ? ",\n" : "\n");
  }
  json << "  ]";
  return json.str();
}

std::string ToJson(const std::vector<GrowthFigures>& all)
{
  std::ostringstream json;
  json << "  \"growth\": [\n";
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const GrowthFigures& f = all[i];
    json << "    { \"facets\": " << f.Facets << ", \"shape_s\": " << f.FlatShape
         << ", \"eye_s\": " << f.FlatEye << ", \"us_per_vertex_grid_order\": " << f.FlatCoherent
         << ", \"us_per_vertex_random_order\": " << f.FlatScattered
         << ", \"us_per_vertex_brute_force\": " << f.FlatBruteForce
         << ", \"mean_error\": " << f.FlatError << ", \"curved_shape_s\": " << f.CurvedShape
         << ", \"curved_deform_s\": " << f.CurvedDeform << ", \"curved_eye_s\": " << f.CurvedEye
         << ", \"curved_us_per_vertex_one_image\": " << f.CurvedOne
         << ", \"curved_us_per_vertex_random_order\": " << f.CurvedScattered
         << ", \"us_per_vertex_order\": " << f.PointOrder
         << ", \"curved_us_per_vertex_all_images\": " << f.CurvedAll
         << ", \"curved_mean_error\": " << f.CurvedError << " }"
         << (i + 1 < all.size() ? ",\n" : "\n");
  }
  json << "  ]";
  return json.str();
}

bool WriteCsv(const std::string& file, const std::vector<GrowthFigures>& all)
{
  std::ofstream out(file);
  out << "facets,method,us_per_vertex,mean_error\n";
  for (const GrowthFigures& f : all)
  {
    out << f.Facets << ",flat brute force," << f.FlatBruteForce << ',' << f.FlatError << '\n'
        << f.Facets << ",flat," << f.FlatCoherent << ',' << f.FlatError << '\n'
        << f.Facets << ",curved one image," << f.CurvedOne << ',' << f.CurvedError << '\n'
        << f.Facets << ",curved all images," << f.CurvedAll << ',' << f.CurvedError << '\n';
  }
  return out.good();
}

bool Plot(const std::string& file, const std::vector<GrowthFigures>& all)
{
  std::vector<ChartSeries> series = { { "thesis: flat, brute force", {} }, { "flat, tree", {} },
    { "curved, one image", {} }, { "curved, all images", {} } };
  for (const GrowthFigures& f : all)
  {
    series[0].Points.emplace_back(f.FlatBruteForce, f.FlatError);
    series[1].Points.emplace_back(f.FlatCoherent, f.FlatError);
    series[2].Points.emplace_back(f.CurvedOne, f.CurvedError);
    series[3].Points.emplace_back(f.CurvedAll, f.CurvedError);
  }
  return WriteChart(file, "Waves of 98 to 1M facets, one thread", "microseconds per virtual vertex",
    "mean error (membrane 200 wide)", series);
}

} // anonymous namespace

//------------------------------------------------------------------------------
GrowthFigures MeasureGrowth(int cells)
{
  const MembraneMesh mesh = MakeWaves(cells);
  const std::vector<double> points = MakePoints(48);
  GrowthFigures figures;
  figures.Facets = mesh.GetNumberOfFacets();
  MeasureFlat(mesh, points, figures);
  MeasureCurved(mesh, points, figures);
  return figures;
}

//------------------------------------------------------------------------------
ThreadedFigures MeasureThreaded(int cells)
{
  const RangeLoop loop = [](std::size_t count, const RangeBody& body)
  {
    constexpr vtkIdType grain = 512;
    vtkSMPTools::For(0, static_cast<vtkIdType>(count), grain,
      [&body](vtkIdType begin, vtkIdType end)
      { body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
  };
  MembraneMesh mesh = MakeWaves(cells);
  CurvedMembraneSolver geometry;
  geometry.SetMembrane(mesh.AsInput(), loop);
  ThreadedFigures figures;
  figures.Facets = mesh.GetNumberOfFacets();
  const Seconds eye = TimeMedian([&] { geometry.SetEye(Eye, Exterior, Interior, loop); });
  const Seconds deform = TimeMedian(
    [&]
    {
      mesh.Points[1] += 1e-6;
      geometry.SetMembrane(mesh.AsInput(), loop);
    });
  figures.EyeWall = eye.Wall;
  figures.EyeCpu = eye.Cpu;
  figures.DeformWall = deform.Wall;
  figures.DeformCpu = deform.Cpu;
  return figures;
}

//------------------------------------------------------------------------------
std::string RunGrowth(const RefractionOptions& options)
{
  const std::vector<GrowthFigures> all = GrowByFacets();
  const std::string json = ToJson(all) + ",\n" + GrowByVertices();
  if (!options.Csv.empty() && !WriteCsv(options.Csv, all))
  {
    std::cerr << "cannot write " << options.Csv << '\n';
    return {};
  }
  if (!options.Plot.empty() && !Plot(options.Plot, all))
  {
    std::cerr << "cannot write " << options.Plot << '\n';
    return {};
  }
  return json;
}

} // namespace meniscus::benchmark

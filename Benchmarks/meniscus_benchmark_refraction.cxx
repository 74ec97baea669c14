// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Accuracy of FLAT_FACETS and CURVED against the thesis's tables, and their cost as the membrane
 * grows. Nothing is judged here: the program prints what it measured.
 */
#include "MembraneMeshes.h"
#include "Refraction/CurvedGeometry.h"
#include "Refraction/VirtualGeometry.h"
#include "ThesisTables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using meniscus::reference::ErrorStatistics;
using meniscus::reference::MembraneMesh;
using meniscus::reference::ThesisRow;

// The acceptance counts rows whose mean is this close to the printed one.
constexpr double AcceptedPercent = 3.0;

struct Options
{
  bool thesis = false;
  bool growth = false;
  bool help = false;
  std::string json;
  std::string error;
};

void PrintHelp()
{
  std::cout << "usage: meniscus_benchmark_refraction [--thesis] [--growth] [--json FILE] [--help]\n"
               "\n"
               "  --thesis     error of virtual vertices, thesis Tables 4.1 to 4.5 side by side\n"
               "  --growth     microseconds per virtual vertex, 128 to 1M facets, one thread\n"
               "  --json FILE  also write the results to FILE\n"
               "  --help       this text\n"
               "\n"
               "Without --thesis and --growth both are run.\n";
}

Options Parse(int argc, char* argv[])
{
  Options options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    if (argument == "--thesis")
    {
      options.thesis = true;
    }
    else if (argument == "--growth")
    {
      options.growth = true;
    }
    else if (argument == "--help" || argument == "-h")
    {
      options.help = true;
    }
    else if (argument == "--json" && i + 1 < argc)
    {
      options.json = argv[++i];
    }
    else
    {
      options.error = argument == "--json" ? "--json needs a file name" : "unknown " + argument;
      return options;
    }
  }
  if (!options.thesis && !options.growth)
  {
    options.thesis = true;
    options.growth = true;
  }
  return options;
}

// Processor time: the program has one thread, and others may run beside it.
double Seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

//------------------------------------------------------------------------------
std::string Describe(const ThesisRow& row)
{
  std::ostringstream text;
  const char* kind =
    row.sphereRatio == 0.0 ? "planar" : (row.sphereRatio == 1.0 ? "hemisphere" : "bowl");
  text << kind;
  if (row.shape == meniscus::reference::MembraneShape::Square)
  {
    text << " " << row.squareCells << "x" << row.squareCells;
  }
  else if (row.sphereRatio > 1.0)
  {
    text << " r=" << 142.0 * row.sphereRatio;
  }
  text << " h=" << row.eyeHeight;
  if (row.eyeOffset > 0.0)
  {
    text << " off=" << row.eyeOffset;
  }
  text << " " << row.exterior << "/" << row.interior;
  return text.str();
}

std::string RunThesis()
{
  std::ostringstream json;
  json << "  \"thesis\": [\n";
  std::printf("%-5s %-30s | %10s %10s %7s | %10s %10s %7s | %8s | %9s %9s %7s\n", "table", "set-up",
    "thesis mean", "deviation", "points", "our mean", "deviation", "points", "mean", "curved",
    "largest", "points");
  int close = 0;
  int counted = 0;
  const auto& rows = meniscus::reference::GetThesisRows();
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const ThesisRow& row = rows[i];
    const ErrorStatistics ours = meniscus::reference::MeasureThesisRow(row);
    const ErrorStatistics curved = meniscus::reference::MeasureThesisRowCurved(row);
    const double percent = 100.0 * (ours.mean / row.mean - 1.0);
    const bool accepted = std::fabs(percent) <= AcceptedPercent;
    const bool counts = meniscus::reference::IsReproducible(row);
    counted += counts;
    close += counts && accepted;
    const std::string points = row.points > 0 ? std::to_string(row.points) : "-";
    std::printf(
      "%-5s %-30s | %11.4f %10.4f %7s | %10.4f %10.4f %7zu | %+7.2f%%%s | %9.2e %9.2e %7zu\n",
      row.table, Describe(row).c_str(), row.mean, row.deviation, points.c_str(), ours.mean,
      ours.deviation, ours.points, percent, accepted ? " " : "*", curved.mean, curved.largest,
      curved.points);
    std::fflush(stdout);
    json << "    { \"table\": \"" << row.table << "\", \"setup\": \"" << Describe(row)
         << "\", \"thesis_mean\": " << row.mean << ", \"thesis_deviation\": " << row.deviation
         << ", \"thesis_points\": " << row.points << ", \"mean\": " << ours.mean
         << ", \"deviation\": " << ours.deviation << ", \"points\": " << ours.points
         << ", \"curved_mean\": " << curved.mean << ", \"curved_largest\": " << curved.largest
         << ", \"curved_points\": " << curved.points << " }"
         << (i + 1 < rows.size() ? ",\n" : "\n");
  }
  json << "  ],\n  \"rows_within_3_percent\": " << close << ",\n  \"rows_counted\": " << counted;
  std::printf("%d of %d rows of Tables 4.1, 4.2, 4.3 and 4.5 have their mean within %g %%"
              " (* marks rows that do not)\n",
    close, counted, AcceptedPercent);
  return json.str();
}

//------------------------------------------------------------------------------
struct GrowthResult
{
  std::size_t facets = 0;
  double shapeSeconds = 0.0;
  double eyeSeconds = 0.0;
  double scattered = 0.0; ///< microseconds per vertex, random order
  double coherent = 0.0;  ///< microseconds per vertex, grid order
  double bruteForce = 0.0;
  double curvedShapeSeconds = 0.0;  ///< a new topology
  double curvedDeformSeconds = 0.0; ///< the same topology, other points
  double curvedEyeSeconds = 0.0;
  double curvedCoherent = 0.0; ///< microseconds per vertex, one image, grid order
  double curvedAll = 0.0;      ///< microseconds per vertex, all images
};

void MeasureCurved(const MembraneMesh& mesh, const glm::dvec3& eye,
  const std::vector<double>& points, GrowthResult& result);

// Median of five runs after one warm-up.
template <typename Work>
double MedianSeconds(const Work& work)
{
  work();
  std::array<double, 5> times{};
  for (double& time : times)
  {
    const double start = Seconds();
    work();
    time = Seconds() - start;
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

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
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  std::vector<double> shuffled;
  for (std::size_t i : order)
  {
    shuffled.insert(shuffled.end(), points.begin() + static_cast<std::ptrdiff_t>(3 * i),
      points.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
  }
  return shuffled;
}

GrowthResult MeasureGrowth(int cells)
{
  const MembraneMesh mesh = meniscus::reference::MakeWaves(200.0, cells, 3.0, 2.0);
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  meniscus::VirtualGeometry geometry;
  GrowthResult result;
  result.facets = mesh.GetNumberOfFacets();
  result.shapeSeconds = MedianSeconds([&geometry, &mesh] { geometry.SetMembrane(mesh.AsInput()); });
  result.eyeSeconds = MedianSeconds([&geometry, &eye] { geometry.SetEye(eye, 1.0, 1.333); });

  const std::vector<double> points = MakePoints(48);
  const std::vector<double> shuffled = Shuffle(points);
  std::vector<meniscus::VirtualVertex> vertices(points.size() / 3);
  const auto perVertex = [&geometry, &vertices](const std::vector<double>& p)
  {
    return 1e6 / static_cast<double>(vertices.size()) *
      MedianSeconds([&] { geometry.Solve(p.data(), 0, vertices.size(), vertices.data()); });
  };
  result.coherent = perVertex(points);
  result.scattered = perVertex(shuffled);

  MeasureCurved(mesh, eye, points, result);

  // About 4e6 cell tests in all.
  const std::size_t sample = std::max<std::size_t>(4000000 / result.facets, 4);
  const double start = Seconds();
  for (std::size_t i = 0; i < sample; ++i)
  {
    const double* p = shuffled.data() + 3 * (i % vertices.size());
    vertices[i % vertices.size()] = geometry.SolvePointByBruteForce(glm::dvec3(p[0], p[1], p[2]));
  }
  result.bruteForce = 1e6 * (Seconds() - start) / static_cast<double>(sample);
  return result;
}

void MeasureCurved(const MembraneMesh& mesh, const glm::dvec3& eye,
  const std::vector<double>& points, GrowthResult& result)
{
  meniscus::CurvedGeometry geometry;
  result.curvedShapeSeconds = MedianSeconds(
    [&geometry, &mesh]
    {
      geometry.Clear();
      geometry.SetMembrane(mesh.AsInput());
    });
  MembraneMesh moved = mesh;
  result.curvedDeformSeconds = MedianSeconds(
    [&geometry, &moved]
    {
      moved.points[1] += 1e-6;
      geometry.SetMembrane(moved.AsInput());
    });
  geometry.SetMembrane(mesh.AsInput());
  result.curvedEyeSeconds = MedianSeconds([&geometry, &eye] { geometry.SetEye(eye, 1.0, 1.333); });
  std::vector<meniscus::VirtualVertex> vertices(points.size() / 3);
  const double micro = 1e6 / static_cast<double>(vertices.size());
  result.curvedCoherent = micro *
    MedianSeconds([&] { geometry.Solve(points.data(), 0, vertices.size(), vertices.data()); });
  std::vector<meniscus::VirtualVertex> images;
  result.curvedAll = micro *
    MedianSeconds(
      [&geometry, &points, &images]
      {
        for (std::size_t i = 0; i < points.size(); i += 3)
        {
          geometry.FindImages({ points[i], points[i + 1], points[i + 2] }, images);
        }
      });
}

std::string RunGrowth()
{
  std::ostringstream json;
  json << "  \"growth\": [\n";
  std::printf("%9s | %9s %9s | %12s %12s %12s | %9s %9s %9s %9s %9s\n", "facets", "shape s",
    "eye s", "us/v grid", "us/v random", "us/v brute", "curved s", "deform s", "eye s", "us/v one",
    "us/v all");
  const std::array<int, 7> sizes = { 8, 23, 64, 128, 226, 400, 708 };
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    const GrowthResult r = MeasureGrowth(sizes[i]);
    std::printf("%9zu | %9.4f %9.4f | %12.3f %12.3f %12.1f | %9.4f %9.4f %9.4f %9.3f %9.3f\n",
      r.facets, r.shapeSeconds, r.eyeSeconds, r.coherent, r.scattered, r.bruteForce,
      r.curvedShapeSeconds, r.curvedDeformSeconds, r.curvedEyeSeconds, r.curvedCoherent,
      r.curvedAll);
    std::fflush(stdout);
    json << "    { \"facets\": " << r.facets << ", \"shape_s\": " << r.shapeSeconds
         << ", \"eye_s\": " << r.eyeSeconds << ", \"us_per_vertex_grid_order\": " << r.coherent
         << ", \"us_per_vertex_random_order\": " << r.scattered
         << ", \"us_per_vertex_brute_force\": " << r.bruteForce
         << ", \"curved_shape_s\": " << r.curvedShapeSeconds
         << ", \"curved_deform_s\": " << r.curvedDeformSeconds
         << ", \"curved_eye_s\": " << r.curvedEyeSeconds
         << ", \"curved_us_per_vertex_one_image\": " << r.curvedCoherent
         << ", \"curved_us_per_vertex_all_images\": " << r.curvedAll << " }"
         << (i + 1 < sizes.size() ? ",\n" : "\n");
  }
  json << "  ]";
  return json.str();
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const Options options = Parse(argc, argv);
  if (!options.error.empty())
  {
    std::cerr << "meniscus_benchmark_refraction: " << options.error << "\n";
    PrintHelp();
    return EXIT_FAILURE;
  }
  if (options.help)
  {
    PrintHelp();
    return EXIT_SUCCESS;
  }
  std::string json = "{\n  \"program\": \"meniscus_benchmark_refraction\",\n"
                     "  \"compiler\": \"" __VERSION__ "\",\n  \"threads\": 1";
  if (options.thesis)
  {
    json += ",\n" + RunThesis();
  }
  if (options.growth)
  {
    json += ",\n" + RunGrowth();
  }
  json += "\n}\n";
  if (!options.json.empty())
  {
    std::ofstream file(options.json);
    if (!(file << json).flush())
    {
      std::cerr << "meniscus_benchmark_refraction: cannot write " << options.json << "\n";
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Accuracy.h"

#include "AnalyticMembrane.h"
#include "HeightField.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "SightOracle.h"
#include "ThesisTables.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>
#include <vector>

namespace meniscus::benchmark
{

namespace
{

using reference::ErrorStatistics;
using reference::HeightField;
using reference::OracleAnswer;
using reference::OracleImage;
using reference::SmoothSurface;
using reference::ThesisRow;

// The acceptance counts rows whose mean is within this distance of the printed one.
constexpr double AcceptedPercent = 3.0;

const double Pi = std::acos(-1.0);

class Random
{
public:
  double operator()(double low, double high)
  {
    return low + (high - low) * (this->Engine() / 4294967296.0);
  }

private:
  std::mt19937 Engine{ 5 };
};

std::string Describe(const ThesisRow& row)
{
  std::ostringstream text;
  const char* kind =
    row.SphereRatio == 0.0 ? "planar" : (row.SphereRatio == 1.0 ? "hemisphere" : "bowl");
  text << kind;
  if (row.Shape == reference::MembraneShape::Square)
  {
    text << " " << row.SquareCells << "x" << row.SquareCells;
  }
  else if (row.SphereRatio > 1.0)
  {
    text << " r=" << 142.0 * row.SphereRatio;
  }
  text << " h=" << row.EyeHeight;
  if (row.EyeOffset > 0.0)
  {
    text << " off=" << row.EyeOffset;
  }
  text << " " << row.Exterior << "/" << row.Interior;
  return text.str();
}

// Error of the virtual vertex of a sight point: its distance from the point behind it on the exact
// surface.
double ErrorOf(const HeightField& field, const glm::dvec3& eye, const glm::dvec3& point,
  const VirtualVertex& vertex)
{
  const glm::dvec3 sight = vertex.SightPoint - eye;
  const glm::dvec3 exact = field.Intersect(eye, glm::normalize(sight), glm::length(sight));
  const auto behind = field.Refract(
    eye, exact, glm::length(vertex.Position - exact) * field.Interior / field.Exterior);
  return behind ? glm::length(*behind - point) : 0.0;
}

struct ImageScene
{
  SmoothSurface Surface;
  double Exterior;
  double Interior;
  glm::dvec3 Eye;
  int Cells;
  double Reach;
};

std::vector<ImageScene> MakeImageScenes()
{
  // sin(kx) sin(kz) as a sum of two waves.
  const auto waves = [](double amplitude, double k)
  {
    SmoothSurface surface;
    surface.Waves = { { 0.5 * amplitude, k, -k, 0.5 * Pi }, { -0.5 * amplitude, k, k, 0.5 * Pi } };
    return surface;
  };
  SmoothSurface dome;
  dome.Hills = { { 30.0, 0.025, 0.0, 0.0 } };
  return { { waves(5.0, 0.03 * Pi), 1.0, 1.333, { 20.0, 300.0, 10.0 }, 64, 80.0 },
    { waves(5.0, 0.03 * Pi), 1.333, 1.0, { 20.0, 300.0, 10.0 }, 64, 80.0 },
    { dome, 1.0, 1.5, { 5.0, 400.0, 3.0 }, 64, 20.0 },
    { waves(3.0, 0.04 * Pi), 1.0, 1.333, { 120.0, 90.0, 20.0 }, 96, 80.0 } };
}

reference::SurfaceError ErrorOf(const CurvedMembraneSolver& geometry, const SmoothSurface& surface)
{
  reference::SurfaceError error;
  const auto facets = static_cast<std::int32_t>(geometry.GetMembrane().GetFacets().size());
  for (std::int32_t f = 0; f < facets; ++f)
  {
    const CurvedPatch patch = geometry.GetPatches().GetPatch(f);
    for (const glm::dvec2& b : { glm::dvec2(1.0 / 3.0, 1.0 / 3.0), glm::dvec2(0.5, 0.0),
           glm::dvec2(0.0, 0.5), glm::dvec2(0.5, 0.5) })
    {
      const PatchPoint at = patch.Evaluate(b);
      const glm::dvec3 p = at.Position + geometry.GetMembrane().GetOrigin();
      error.Position = std::max(error.Position, std::fabs(p.y - surface.At(p.x, p.z).F));
      error.Normal = std::max(
        error.Normal, glm::length(glm::normalize(at.Normal) - surface.GetNormal(p.x, p.z)));
    }
  }
  return { 1.5 * error.Position, 1.5 * error.Normal };
}

void Compare(const OracleAnswer& answer, const std::vector<VirtualVertex>& images,
  const reference::SurfaceError& error, ImageCount& count)
{
  const auto matches = [&error](const OracleImage& image, const VirtualVertex& vertex)
  {
    return glm::length(vertex.SightPoint - image.Sight) <=
      2.0 * image.Radius + 2.0 * error.Position + 1e-7;
  };
  ++count.Points;
  count.Uncertain += !answer.Uncertain.empty();
  count.Images += static_cast<int>(answer.Images.size());
  for (const OracleImage& image : answer.Images)
  {
    count.Missed += std::none_of(images.begin(), images.end(),
      [&](const VirtualVertex& vertex) { return matches(image, vertex); });
  }
  for (const VirtualVertex& vertex : images)
  {
    count.False += !answer.IsUncertain(vertex.SightPoint.x, vertex.SightPoint.z, 1e-7) &&
      std::none_of(answer.Images.begin(), answer.Images.end(),
        [&](const OracleImage& image) { return matches(image, vertex); });
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::string RunThesisTables()
{
  std::ostringstream json;
  json << "  \"thesis\": [\n";
  std::printf("%-5s %-30s | %10s %10s %7s | %10s %10s %7s | %8s | %9s %9s %7s\n", "table", "set-up",
    "thesis mean", "deviation", "points", "our mean", "deviation", "points", "mean", "curved",
    "largest", "points");
  int close = 0;
  int counted = 0;
  const auto& rows = reference::GetThesisRows();
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const ThesisRow& row = rows[i];
    const ErrorStatistics ours = reference::MeasureThesisRow(row);
    const ErrorStatistics curved = reference::MeasureThesisRowCurved(row);
    const double percent = 100.0 * (ours.Mean / row.Mean - 1.0);
    const bool accepted = std::fabs(percent) <= AcceptedPercent;
    const bool counts = reference::IsReproducible(row);
    counted += counts;
    close += counts && accepted;
    const std::string points = row.Points > 0 ? std::to_string(row.Points) : "-";
    std::printf(
      "%-5s %-30s | %11.4f %10.4f %7s | %10.4f %10.4f %7zu | %+7.2f%%%s | %9.2e %9.2e %7zu\n",
      row.Table, Describe(row).c_str(), row.Mean, row.Deviation, points.c_str(), ours.Mean,
      ours.Deviation, ours.Points, percent, accepted ? " " : "*", curved.Mean, curved.Largest,
      curved.Points);
    std::fflush(stdout);
    json << "    { \"table\": \"" << row.Table << "\", \"setup\": \"" << Describe(row)
         << "\", \"thesis_mean\": " << row.Mean << ", \"thesis_deviation\": " << row.Deviation
         << ", \"thesis_points\": " << row.Points << ", \"mean\": " << ours.Mean
         << ", \"deviation\": " << ours.Deviation << ", \"points\": " << ours.Points
         << ", \"curved_mean\": " << curved.Mean << ", \"curved_largest\": " << curved.Largest
         << ", \"curved_points\": " << curved.Points << " }"
         << (i + 1 < rows.size() ? ",\n" : "\n");
  }
  json << "  ],\n  \"rows_within_3_percent\": " << close << ",\n  \"rows_counted\": " << counted;
  std::printf("%d of %d rows of Tables 4.1, 4.2, 4.3 and 4.5 have their mean within %g %%"
              " (* marks rows that do not)\n",
    close, counted, AcceptedPercent);
  return json.str();
}

//------------------------------------------------------------------------------
WaveError MeasureWaveError(int cells)
{
  const HeightField field{ HeightField::Shape::Waves, 200.0, 3.0, 0.02 * Pi, 1.0, 1.333 };
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  const auto mesh = field.MakeMesh(cells);
  CurvedMembraneSolver curved;
  curved.SetMembrane(mesh.AsInput());
  curved.SetEye(eye, field.Exterior, field.Interior);
  FlatMembraneSolver flat;
  flat.SetMembrane(mesh.AsInput());
  flat.SetEye(eye, field.Exterior, field.Interior);
  Random random;
  double sums[2] = { 0.0, 0.0 };
  int counts[2] = { 0, 0 };
  for (int i = 0; i < 4000; ++i)
  {
    const glm::dvec3 point(random(-60.0, 60.0), random(-60.0, -10.0), random(-60.0, 60.0));
    VirtualVertex vertex[2];
    vertex[0] = flat.SolvePoint(point);
    curved.Solve(&point.x, 0, 1, &vertex[1]);
    for (int k = 0; k < 2; ++k)
    {
      if (vertex[k].State == ImageState::Found)
      {
        sums[k] += ErrorOf(field, eye, point, vertex[k]);
        ++counts[k];
      }
    }
  }
  return { sums[0] / std::max(counts[0], 1), sums[1] / std::max(counts[1], 1) };
}

//------------------------------------------------------------------------------
ImageCount CountImages()
{
  ImageCount count;
  Random random;
  for (const ImageScene& scene : MakeImageScenes())
  {
    CurvedMembraneSolver geometry;
    const auto mesh = scene.Surface.MakeMesh(scene.Cells);
    geometry.SetMembrane(mesh.AsInput());
    geometry.SetEye(scene.Eye, scene.Exterior, scene.Interior);
    const auto error = ErrorOf(geometry, scene.Surface);
    const reference::SightOracle oracle(
      scene.Surface, scene.Eye, scene.Exterior, scene.Interior, error);
    std::vector<VirtualVertex> images;
    for (int i = 0; i < 500; ++i)
    {
      const glm::dvec3 point(random(-scene.Reach, scene.Reach), random(-250.0, -40.0),
        random(-scene.Reach, scene.Reach));
      geometry.FindImages(point, images);
      Compare(oracle.Find(point), images, error, count);
    }
  }
  return count;
}

//------------------------------------------------------------------------------
double MeasureHemispherePixels()
{
  constexpr double radius = 141.5;
  const glm::dvec3 eye(0.0, 450.0, 0.0);
  const reference::AnalyticMembrane exact{ radius, 1.0, 1.51 };
  const auto mesh = reference::MakeDisc(radius, 5, radius);
  CurvedMembraneSolver geometry;
  geometry.SetMembrane(mesh.AsInput());
  geometry.SetEye(eye, 1.0, 1.51);
  // The opening is at the height of the sphere's centre.
  const double pixel = 2.0 * radius / (512.0 * (eye.y - radius));
  double largest = 0.0;
  Random random;
  std::vector<VirtualVertex> images;
  for (int i = 0; i < 5000; ++i)
  {
    const glm::dvec3 point(random(-400, 380), random(-800, -20), random(-400, 380));
    geometry.FindImages(point, images);
    const auto sights = exact.FindSightPoints(eye, point);
    if (images.size() != 1 || sights.size() != 1)
    {
      continue;
    }
    const glm::dvec3 a = images[0].SightPoint - eye;
    const glm::dvec3 b = sights[0] - eye;
    const glm::dvec3 apart = a / a.y - b / b.y;
    largest = std::max(largest, glm::length(apart) / pixel);
  }
  return largest;
}

} // namespace meniscus::benchmark

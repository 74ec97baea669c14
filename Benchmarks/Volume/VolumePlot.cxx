// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Chart.h"
#include "VolumeOutput.h"

#include <algorithm>

namespace meniscus::benchmark
{

namespace
{

/** RMS error of a picture that is exact up to its rounding to whole steps of 1/255. */
constexpr double RoundingRms = 0.0015;

/** A way to draw: the settings that are joined to a curve. */
struct PlotCurve
{
  const char* Label;
  std::vector<std::string> Names;
};

const std::vector<PlotCurve>& GetCurves()
{
  static const std::vector<PlotCurve> curves{
    { "resampled to an image (64, 128, 256)",
      { "resampled/64", "resampled/128", "resampled/256" } },
    { "Open VKL (1/16, 1/4, 1, 4)", { "openvkl/1:16", "openvkl/1:4", "openvkl/1", "openvkl/4" } },
    { "projected tetrahedra", { "projected" } },
    { "Bunyk, pre-integrated", { "raycast/pre-integration" } },
    { "Bunyk, partly pre-integrated", { "raycast/partial" } },
    { "Bunyk, linear", { "raycast/linear" } },
    { "Bunyk, constant", { "raycast/homogeneous" } },
    { "Z sweep", { "zsweep" } },
    { "native", { "meniscus/native/exact" } },
    { "native, 3-D",
      { "meniscus/native/pre-integrated/64x16", "meniscus/native/pre-integrated",
        "meniscus/native/pre-integrated/512x64" } },
    { "native, 2-D", { "meniscus/native/pre-integrated/256x1" } },
    { "OpenGL", { "meniscus/opengl/exact" } },
    { "OpenGL, 3-D",
      { "meniscus/opengl/pre-integrated/64x16", "meniscus/opengl/pre-integrated",
        "meniscus/opengl/pre-integrated/512x64" } },
    { "OpenGL, 2-D", { "meniscus/opengl/pre-integrated/256x1" } },
    { "compute", { "meniscus/compute/exact" } },
  };
  return curves;
}

ChartSeries MakeSeries(const PlotCurve& curve, const std::vector<Figures>& all)
{
  ChartSeries series{ curve.Label, {} };
  for (const std::string& name : curve.Names)
  {
    for (const Figures& f : all)
    {
      if (f.Name == name && f.Survives)
      {
        series.Points.emplace_back(f.CpuMs, f.HasFloat ? f.Float.Rms : f.Bytes.Rms);
      }
    }
  }
  return series;
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool WritePlot(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all)
{
  std::vector<ChartSeries> series;
  ChartSeries rounding{ "rounding to 8 bits", { { 1e300, RoundingRms }, { 0.0, RoundingRms } } };
  for (const PlotCurve& curve : GetCurves())
  {
    ChartSeries next = MakeSeries(curve, all);
    for (const auto& point : next.Points)
    {
      rounding.Points[0].first = std::min(rounding.Points[0].first, point.first);
      rounding.Points[1].first = std::max(rounding.Points[1].first, point.first);
    }
    if (!next.Points.empty())
    {
      series.push_back(next);
    }
  }
  series.push_back(rounding);
  const std::string mesh = description.Mesh.substr(description.Mesh.find_last_of('/') + 1);
  return WriteChart(options.Plot,
    mesh + ", " + std::to_string(description.Cells) + " tetrahedra, " +
      std::to_string(options.Width) + " x " + std::to_string(options.Height) + " pixels, " +
      options.Function + " function",
    "milliseconds of processor time per frame", "RMS error", series);
}

} // namespace meniscus::benchmark

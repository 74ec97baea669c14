// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Chart.h"
#include "VolumeOutput.h"

namespace meniscus
{
namespace benchmark
{

//------------------------------------------------------------------------------
bool WritePlot(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all)
{
  std::vector<ChartSeries> points;
  for (const Figures& f : all)
  {
    if (f.Survives)
    {
      points.push_back({ f.Name + ", 8 bits", { { f.SteadyMs, f.Bytes.Rms } } });
      if (f.HasFloat)
      {
        points.push_back({ f.Name + ", float", { { f.SteadyMs, f.Float.Rms } } });
      }
    }
  }
  return WriteChart(options.Plot,
    description.Mesh + ", " + std::to_string(description.Cells) + " tetrahedra, " +
      std::to_string(options.Width) + " x " + std::to_string(options.Height) + ", " +
      options.Function,
    "ms per frame", "RMS error", points);
}

} // namespace benchmark
} // namespace meniscus

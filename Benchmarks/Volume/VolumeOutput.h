// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeComparison.h"

#include <vtkType.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace meniscus::benchmark
{

/** Conditions under which figures were measured. */
struct RunDescription
{
  std::string Mesh;
  vtkIdType Cells = 0;
  std::string Device;
  double CopyBandwidth = 0.0; // bytes per second; 0: not measured
  double EmptyMs = 0.0;       // of a frame without the mesh; 0: not measured
};

/** Mesh, window, device, versions, threads. */
void PrintDescription(
  std::ostream& out, const VolumeOptions& options, const RunDescription& description);

/** One line per mapper, then the ratios of our mapper to the others. */
void PrintTable(std::ostream& out, const std::vector<Figures>& all);

bool WriteJson(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all);

/** Names of rows and their milliseconds of processor time. */
using NamedTimes = std::vector<std::pair<std::string, double>>;

/** Writes times to a file of JSON; returns false if that fails. */
bool WriteTimes(const std::string& file, const NamedTimes& times);

/**
 * Appends rows of a Markdown table, one per mapper, to a file, and its heading if there is no file.
 * A figure that was not measured is a dash.
 */
bool AppendTimeRows(const std::string& file, const VolumeOptions& options,
  const RunDescription& description, const std::vector<Figures>& all);
bool AppendErrorRows(const std::string& file, const VolumeOptions& options,
  const RunDescription& description, const std::vector<Figures>& all);

/**
 * Plots milliseconds of processor time per frame against the RMS error of an image, both
 * logarithmic: a curve per way to draw, the sizes of tables and images along it. Errors are those
 * of float images where the mapper makes them, of 8-bit images otherwise.
 */
bool WritePlot(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all);

} // namespace meniscus::benchmark

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_VolumeOutput_h
#define meniscus_VolumeOutput_h

#include "VolumeComparison.h"

#include <vtkType.h>

#include <ostream>
#include <string>
#include <vector>

namespace meniscus
{
namespace benchmark
{

/** What figures belong to. */
struct RunDescription
{
  std::string Mesh;
  vtkIdType Cells = 0;
  std::string Device;
};

/** Mesh, window, device, versions, threads. */
void printDescription(
  std::ostream& out, const VolumeOptions& options, const RunDescription& description);

/** One line per mapper, then ratios of ours to the others. */
void printTable(std::ostream& out, const std::vector<Figures>& all);

bool writeJson(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all);

/**
 * Milliseconds per frame against RMS error in a picture, both logarithmic: 8-bit and float
 * pictures of every mapper.
 */
bool writePlot(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all);

} // namespace benchmark
} // namespace meniscus

#endif

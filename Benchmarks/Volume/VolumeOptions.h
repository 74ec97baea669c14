// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestMeshes.h"
#include "TestTransferFunctions.h"
#include "VolumeModes.h"

#include <string>
#include <vector>

namespace meniscus::benchmark
{

/** Options of the command line. */
struct VolumeOptions
{
  std::string Mesh; // file, or empty for the generated block
  std::string Json;
  std::string Plot;
  std::string Function = "smooth";
  VolumeMode Mode = VolumeMode::Composite;
  std::vector<std::string> Mappers; // parts of names; empty: all
  int Width = 512;
  int Height = 512;
  int Views = 8;
  int Repetitions = 3;
  int ErrorViews = 2;
  int Cubes = 32; // per side of the generated block
  int Hollow = 1; // 0: a full block
  int Threads = 0;
  std::string Instructions; // instruction set of native frames; empty: the widest
  int ProbeSeconds = 60;    // 0: no probes
  int SetUpRepetitions = 3;
  bool Bandwidth = false;
  bool Device = false;  // names of the graphics device instead of a comparison
  std::string Paper;    // folder of the charts like the paper's
  std::string Picture;  // first part of the names of pictures
  std::string TimeRows; // file to which rows of a Markdown table are appended
  std::string ErrorRows;
  bool ZSweep = false;
  bool Growth = false;
  int GrowthLimit = 5000; // in thousands of cells
  bool Steps = false;
  bool Changes = false;
  bool Report = false;
  std::string Row;
  std::string Probe; // name of the mapper that this process tests
  bool Help = false;
  std::string Problem;
};

extern const char* const VolumeUsage;

VolumeOptions ParseVolumeOptions(int argc, char* argv[]);

/**
 * Finds a function by name: smooth, peaked, sharp, opaque, sparse. Returns false for other names.
 */
bool FindFunctionKind(const std::string& name, test::FunctionKind& kind);

/** The requested mesh; null if it cannot be read. */
test::Grid MakeVolumeMesh(const VolumeOptions& options);

} // namespace meniscus::benchmark

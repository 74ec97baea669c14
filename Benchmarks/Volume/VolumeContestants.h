// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestTransferFunctions.h"
#include "VolumeOptions.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGridVolumeMapper.h>

#include <functional>
#include <string>
#include <vector>

namespace meniscus::benchmark
{

using MapperPointer = vtkSmartPointer<vtkUnstructuredGridVolumeMapper>;

/** A mapper with its settings. */
struct Contestant
{
  std::string Name;
  std::function<MapperPointer()> Make;
  /**
   * True if its image in a float framebuffer is the window's image with higher precision, as for
   * our mapper. The ray cast mapper and Z sweep create 8-bit images, and projected tetrahedra
   * differ from those in a window.
   */
  bool HasFloat = false;
  /** Transfer function that it draws; the error is measured for the function of the run only. */
  test::FunctionKind Function = test::FunctionKind::Smooth;
  /** False if the mapper crashes when it gets a larger mesh, as Z sweep does in VTK 9.1. */
  bool CanChangeMesh = true;
};

/**
 * VTK's mappers, Open VKL where it is installed, and ours with every backend and integration that
 * is available, which is tested by a small image. Ours is also included with rays that end at an
 * opacity of 0.99. Needs a display.
 */
std::vector<Contestant> MakeContestants(const VolumeOptions& options);

/** Our mapper with one backend and exact integration. */
Contestant MakeOurs(int backend, const std::string& name);

/** True if a name contains the word or, if the word ends in $, ends with the rest of it. */
bool IsSelected(const std::string& name, const std::string& word);

/** Contestants whose names one of the words selects; all of them without words. */
std::vector<Contestant> SelectContestants(
  const std::vector<Contestant>& all, const std::vector<std::string>& words);

} // namespace meniscus::benchmark

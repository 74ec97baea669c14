// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_VolumeContestants_h
#define meniscus_VolumeContestants_h

#include "TestTransferFunctions.h"
#include "VolumeOptions.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGridVolumeMapper.h>

#include <functional>
#include <string>
#include <vector>

namespace meniscus
{
namespace benchmark
{

using MapperPointer = vtkSmartPointer<vtkUnstructuredGridVolumeMapper>;

/** A mapper with its settings. */
struct Contestant
{
  std::string Name;
  std::function<MapperPointer()> Make;
  /**
   * Whether its picture in a float framebuffer is that of the window, only finer: ours. The ray
   * cast mapper and Z sweep make 8-bit images, projected tetrahedra come out otherwise than in a
   * window.
   */
  bool HasFloat = false;
  /** The transfer function it draws; the error is measured for that of the run only. */
  test::FunctionKind Function = test::FunctionKind::Smooth;
};

/**
 * VTK's mappers and ours with every backend and integration that this build has: ours is asked, by
 * a small picture. Ours comes also with rays that end at an opacity of 0.99. Needs a display.
 */
std::vector<Contestant> makeContestants(const VolumeOptions& options);

/** Ours with one backend, exact. */
Contestant makeOurs(int backend, const std::string& name);

/** Those whose names contain one of the words; all without words. */
std::vector<Contestant> selectContestants(
  const std::vector<Contestant>& all, const std::vector<std::string>& words);

} // namespace benchmark
} // namespace meniscus

#endif

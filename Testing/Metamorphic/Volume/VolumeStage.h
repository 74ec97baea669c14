// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeCase.h"

class vtkDataObject;
class vtkTetrahedraRayCastMapper;

namespace meniscus::test
{

/**
 * An off-screen window in which cases are drawn, each by its own mapper. The window and its
 * compiled shaders are kept.
 */
class VolumeStage
{
public:
  VolumeStage();
  ~VolumeStage();

  /** Sets up a case with new objects, which later calls may change. */
  void GetPlace(const VolumeCase& test);
  /** Renders the case set up by place(). */
  FloatImage Render();
  /** place() and render(). */
  FloatImage Draw(const VolumeCase& test);

  vtkTetrahedraRayCastMapper* GetMapper() const;
  VolumeScene& MakeScene() { return this->Scene; }
  /** Block 0 as passed to the mapper. */
  vtkUnstructuredGrid* MakeGrid() const;
  /** Uses another input instead of the case's own. */
  void SetInput(vtkDataObject* input);

  /** Errors of the mapper and lost rays since the last call; empty if there are none. */
  std::string Complaints();

private:
  class Listener;

  DisplayHold Hold;
  VolumeScene Scene;
  vtkSmartPointer<vtkTetrahedraRayCastMapper> Mapper;
  Grid FirstGrid;
  vtkSmartPointer<Listener> Errors;
  long long Lost = 0;
};

} // namespace meniscus::test

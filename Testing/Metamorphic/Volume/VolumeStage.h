// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_VolumeStage_h
#define meniscus_VolumeStage_h

#include "VolumeCase.h"
#include "VolumeScene.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <vector>

class vtkDataObject;
class vtkTetrahedraRayCastMapper;

namespace meniscus
{
namespace test
{

/**
 * An off-screen window in which cases are drawn, each by a mapper of its own. The window and its
 * compiled shaders stay.
 */
class VolumeStage
{
public:
  VolumeStage();
  ~VolumeStage();

  /** Sets up a case with new objects, which the next calls may change. */
  void place(const VolumeCase& test);
  /** Renders what place() has set up. */
  FloatImage render();
  /** place() and render(). */
  FloatImage draw(const VolumeCase& test);

  vtkTetrahedraRayCastMapper* mapper() const;
  VolumeScene& scene() { return this->Scene; }
  /** Block 0 as the mapper has it. */
  vtkUnstructuredGrid* grid() const;
  /** Uses another input in place of the case's own. */
  void setInput(vtkDataObject* input);

  /** Errors of the mapper and rays that were lost since the last call; empty without any. */
  std::string complaints();

private:
  class Listener;

  DisplayHold Hold;
  VolumeScene Scene;
  vtkSmartPointer<vtkTetrahedraRayCastMapper> Mapper;
  Grid FirstGrid;
  vtkSmartPointer<Listener> Errors;
  long long Lost = 0;
};

} // namespace test
} // namespace meniscus

#endif

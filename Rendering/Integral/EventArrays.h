// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Input/InputCells.h"
#include "Rendering/Property/VolumePropertyTables.h"
#include "Volume/Caster/MeasuredRays.h"
#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/ScalarNormalization.h"
#include "Volume/Packet/Data/RayEvents.h"

#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

class vtkImageData;

namespace meniscus
{

/** Names of the events; the names of their arrays begin with them. */
constexpr const char* EventNames[NumberOfRayEvents] = { "FirstVisible", "OpacityReached",
  "LargestContribution" };

/** Events of rays that are wanted, and the blend mode that defines them. */
struct EventChoice
{
  std::array<bool, NumberOfRayEvents> Wanted{};
  BlendMode Blending = BlendMode::Composite;
  /** Accumulated opacity of OpacityReachedEvent. */
  double Opacity = 0.5;
  /** True if the input is a composite data set. */
  bool HasBlocks = false;

  bool IsAnyWanted() const;
  bool HasSurfaces() const { return this->Blending == BlendMode::Isosurfaces; }
  /** True if events depend on a volume property. */
  bool NeedsProperty() const;
  /** Size of all arrays per pixel, in numbers of 32 bits. */
  std::int64_t GetNumbersPerPixel() const;
};

/** Conversion of measured events to the numbers of the input. */
struct EventContext
{
  const InputCells& Cells;
  /** Running index of the input's cell for each cell of the mesh. */
  const std::vector<std::int32_t>& Sources;
  ScalarNormalization Normalization;
  /** Position of each isosurface in the property's list. */
  std::vector<std::int32_t> Surfaces;
  /** World coordinates of a place in the frame of the view: Center + ViewToWorld * place. */
  glm::dvec3 Center{ 0.0 };
  glm::dmat3 ViewToWorld{ 1.0 };
};

/** Positions of isosurfaces in the property's list. */
std::vector<std::int32_t> IndicesOf(const std::vector<Isosurface>& surfaces);

/** An event in the terms of the input. */
struct InputEvent
{
  double Distance;
  glm::dvec3 Position;
  double Value;
  InputCell Cell;
  /** Position of the isosurface in the property's list; -1 for none. */
  int Surface;
};

/** @pre event.IsFound() */
InputEvent ConvertEvent(const MeasuredEvent& event, const EventContext& context);

/** The arrays of an image of events, filled pixel by pixel. */
class EventArrays
{
public:
  /** Makes the arrays that are wanted, with the values of rays without events. */
  EventArrays(const EventChoice& choice, std::int64_t pixels);

  void Set(std::int64_t pixel, const MeasuredEvents& measured, const EventContext& context);

  /** Adds the arrays to the points of an image. */
  void AddTo(vtkImageData* image);

private:
  struct OfEvent
  {
    vtkNew<vtkFloatArray> Depth;
    vtkNew<vtkFloatArray> Value;
    vtkNew<vtkFloatArray> Position;
    vtkNew<vtkIdTypeArray> CellId;
    vtkNew<vtkIntArray> Block;
    vtkNew<vtkIntArray> Surface;
  };
  EventChoice Choice;
  std::array<OfEvent, NumberOfRayEvents> Arrays;
};

}

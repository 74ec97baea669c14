// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLEntryLists.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/OpenGL/OpenGLTables.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Input/VolumeInput.h"

#include <glm/geometric.hpp>

namespace meniscus
{

//------------------------------------------------------------------------------
/**
 * Whether rays of a tile are expected to enter by more faces than the lists hold that are made on
 * the device. Those of tiles with more search the tree of the boundary one by one.
 */
bool OpenGLEntryLists::AreWanted(const VolumeInput& input, const RayCastFrame& frame)
{
  if (this->Measured != input.GetBoundaryVersions())
  {
    this->Boundary = MeasureBoundary(input.GetMesh());
    this->Measured = input.GetBoundaryVersions();
  }
  // Half of the tiles have more than the mean.
  constexpr double most = 0.5 * TileCapacity;
  const double side = TileSize * glm::length(frame.Rays.Origin.PerColumn);
  return ExpectedEntriesPerTile(this->Boundary, side) > most;
}

//------------------------------------------------------------------------------
bool OpenGLEntryLists::Update(VolumeInput& input, const RayCastFrame& frame, OpenGLTables& tables)
{
  if (!this->AreWanted(input, frame))
  {
    return false;
  }
  const FixedPointRays rays(frame.Rays, frame.Output.ImageSize[0], frame.Output.ImageSize[1]);
  if (this->BoundaryOfTiles != input.GetBoundaryVersions() || !rays.SeesAs(this->RaysOfTiles))
  {
    this->Fit = this->Tiles.Build(
      input.GetMesh(), input.GetBoundaryTree().GetFaces(), rays, LongListTileSize, ThreadedLoop);
    this->RaysOfTiles = rays;
    this->BoundaryOfTiles = input.GetBoundaryVersions();
    this->Version.Bump();
  }
  const bool uploaded = tables.HasEntryTiles() && this->Uploaded == this->Version;
  if (this->Fit && !uploaded)
  {
    this->Fit = tables.UploadEntryTiles(this->Tiles).empty();
    this->Uploaded = this->Version;
  }
  return this->Fit;
}

}

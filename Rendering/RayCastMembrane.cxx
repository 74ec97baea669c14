// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCastMembrane.h"

#include "ThreadedLoop.h"

namespace meniscus
{

//------------------------------------------------------------------------------
BentScene RayCastMembrane::See(const MembraneSight::View& view, VolumeInput& input)
{
  if (this->SightOf != this->GetBuilds() || !(this->Sight.GetView() == view))
  {
    const CurvedGeometry& surface = this->Surface.GetCurved();
    this->Sight.Build(surface.GetMembrane(), surface.GetPatches(), view, ThreadedLoop);
    this->Frames.Turn(this->Sight, view.Frame, ThreadedLoop);
    this->SightOf = this->GetBuilds();
    ++this->SightUpdates;
  }
  BentScene scene;
  if (!this->Sight.IsSeen())
  {
    return scene;
  }
  const PlacedVersion version{ input.GetMeshBuilds(), input.GetScalarUpdates(),
    this->SightUpdates };
  if (version != this->Placed)
  {
    this->Frames.Place(input.GetMesh(), input.GetScalars(), ThreadedLoop);
    this->Placed = version;
  }
  if (this->InvertedOf != input.GetMeshBuilds())
  {
    this->Inverted = HasInvertedCells(input.GetMesh(), ThreadedLoop);
    this->InvertedOf = input.GetMeshBuilds();
  }
  scene.BeginsInside = !this->Inverted;
  scene.Sight = &this->Sight;
  scene.Frames = &this->Frames;
  scene.Tree = &input.GetBoundaryTree();
  return scene;
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/RayCastMembrane.h"

#include "Filters/Common/ThreadedLoop.h"

#include <cmath>

namespace meniscus
{

//------------------------------------------------------------------------------
InputReport RayCastMembrane::Update(
  vtkPolyData* membrane, double exterior, double interior, bool wanted)
{
  const auto isIndex = [](double index) { return index > 0.0 && std::isfinite(index); };
  if (!membrane)
  {
    return { "The membrane is not a vtkPolyData", std::string() };
  }
  if (!isIndex(exterior) || !isIndex(interior))
  {
    return { "Indices of refraction must be positive and finite", std::string() };
  }
  SceneMessages messages;
  if ((exterior != interior || wanted) && !this->Surface.SetMembrane(membrane, true, messages))
  {
    return { messages.Error, std::string() };
  }
  if (messages.Warning.empty() || messages.Warning == this->Told)
  {
    return {};
  }
  this->Told = messages.Warning;
  return { std::string(), messages.Warning };
}

//------------------------------------------------------------------------------
bool RayCastMembrane::Trace(RefractedRayField::View view, VolumeInput& input)
{
  view.Mesh = BoxOf(input.GetBoundaryTree(), view.Frame);
  if (this->SightOf != this->GetShapeVersion() || !(this->Sight.GetView() == view))
  {
    const CurvedMembraneSolver& surface = this->Surface.GetCurved();
    this->Sight.Build(surface.GetMembrane(), surface.GetPatches(), view, ThreadedLoop);
    this->Frames.Turn(this->GetLegs(), this->Sight.GetMeanDirection(), ThreadedLoop);
    this->SightOf = this->GetShapeVersion();
    this->SightVersion.Bump();
  }
  return this->Sight.IsSeen();
}

//------------------------------------------------------------------------------
std::vector<const RefractedRayTiles*> RayCastMembrane::ListRefracted() const
{
  return { &this->Sight.GetRays() };
}

//------------------------------------------------------------------------------
RayLegs RayCastMembrane::GetLegs() const
{
  const RefractedRayField::View& view = this->Sight.GetView();
  return RayLegs(view.Frame, view.Width, view.Height, this->ListRefracted());
}

//------------------------------------------------------------------------------
bool RayCastMembrane::BeginsInside(VolumeInput& input)
{
  if (this->InvertedOf != input.GetMeshVersion())
  {
    this->Inverted = HasInvertedCells(input.GetMesh(), ThreadedLoop);
    this->InvertedOf = input.GetMeshVersion();
  }
  return !this->Inverted;
}

//------------------------------------------------------------------------------
RefractedScene RayCastMembrane::See(VolumeInput& input)
{
  const TableVersions version{ input.GetMeshVersion(), input.GetScalarVersion(),
    this->SightVersion };
  if (version != this->Placed)
  {
    this->Frames.Place(input.GetMesh(), input.GetScalars(), ThreadedLoop);
    this->Placed = version;
  }
  RefractedScene scene;
  scene.BeginsInside = this->BeginsInside(input);
  scene.Legs = this->ListRefracted();
  scene.Frames = &this->Frames;
  scene.Tree = &input.GetBoundaryTree();
  return scene;
}

}

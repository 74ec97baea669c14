// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/RefractionScene.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/StackValidation.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meniscus
{

namespace
{

/** True if an open surface has no facet that faces the eye; false for an eye that is not finite. */
bool IsBehind(const Membrane& surface, const glm::dvec3& eye)
{
  const glm::dvec3 local = eye - surface.GetOrigin();
  return !surface.IsClosed() && std::isfinite(local.x + local.y + local.z) &&
    !surface.ShowsSide(local, 1.0);
}

}

//------------------------------------------------------------------------------
RefractionScene::RefractionScene()
  : Prepared(std::make_shared<PreparedMembrane>())
{
}

//------------------------------------------------------------------------------
RefractionScene::Loan::Loan(RefractionScene& scene, vtkPolyData* membrane, bool curved,
  vtkImplicitFunction* function, const MembraneView& view)
  : Scene(scene)
{
  scene.Prepared =
    BorrowMembrane(scene.Prepared, scene.Version, { membrane, function, curved }, view);
  scene.HasLoan = true;
  scene.UndecidedBefore = scene.CountUndecided();
}

//------------------------------------------------------------------------------
RefractionScene::Loan::~Loan()
{
  this->Scene.Undecided = this->Scene.GetNumberOfUndecided();
  this->Scene.HasLoan = false;
  ReturnMembrane(*this->Scene.Prepared);
}

//------------------------------------------------------------------------------
vtkTypeInt64 RefractionScene::CountUndecided() const
{
  const CurvedMembraneSolver& solver = this->Prepared->Curved;
  return solver.GetNumberOfUndecidedSearches() + solver.GetNumberOfUndecidedSides();
}

//------------------------------------------------------------------------------
vtkTypeInt64 RefractionScene::GetNumberOfUndecided() const
{
  return this->Undecided + (this->HasLoan ? this->CountUndecided() - this->UndecidedBefore : 0);
}

//------------------------------------------------------------------------------
bool RefractionScene::SetMembrane(
  vtkPolyData* membrane, bool curved, SceneMessages& messages, vtkImplicitFunction* function)
{
  PreparedMembrane& prepared = *this->Prepared;
  if (prepared.Surface.Update(membrane, function, curved))
  {
    this->SetShape();
  }
  if (this->Version.Shape == prepared.Version.Shape)
  {
    return true;
  }
  this->Version.Shape = prepared.Version.Shape;
  this->SkippedFacets = this->GetMembrane().GetReport().Skipped();
  return prepared.Surface.Report(messages);
}

//------------------------------------------------------------------------------
/** Sets the solvers to the new shape of the surface. */
void RefractionScene::SetShape()
{
  PreparedMembrane& prepared = *this->Prepared;
  if (this->IsCurved())
  {
    prepared.Curved.SetSurface(prepared.Surface.GetSurface());
    prepared.Flat = FlatMembraneSolver();
  }
  else
  {
    prepared.Flat.SetSurface(prepared.Surface.GetSurface());
    prepared.Curved.Clear();
  }
  prepared.HasRays = false;
  prepared.Version.Shape = MembraneVersion::MakeNumber();
  ++this->PatchBuilds;
}

//------------------------------------------------------------------------------
/** Turns the membrane round if the view demands it, or back. */
void RefractionScene::TurnMembrane(const MembraneView& view)
{
  PreparedMembrane& prepared = *this->Prepared;
  const glm::dvec3 eye(view.Eye[0], view.Eye[1], view.Eye[2]);
  const bool isTurned =
    view.Turns && prepared.Surface.IsTurned() != IsBehind(this->GetMembrane(), eye);
  if (isTurned != prepared.Surface.IsTurned())
  {
    prepared.Surface.Turn();
    this->SetShape();
    this->Version.Shape = prepared.Version.Shape;
  }
}

//------------------------------------------------------------------------------
bool RefractionScene::SetEye(const MembraneView& view, SceneMessages& messages)
{
  PreparedMembrane& prepared = *this->Prepared;
  const Eye& eye = view.Eye;
  if (!prepared.HasRays || !(prepared.View == view))
  {
    prepared.HasRays = false; // stale until the update succeeds
    this->View = MembraneView();
    this->TurnMembrane(view);
    const glm::dvec3 position(eye[0], eye[1], eye[2]);
    const EyeStatus status = this->IsCurved()
      ? prepared.Curved.SetEye(position, eye[3], eye[4], FacetLoop, view.Reflects)
      : prepared.Flat.SetEye(position, eye[3], eye[4], FacetLoop);
    if (status != EyeStatus::Ready)
    {
      messages.Error = status == EyeStatus::BadIndex ? DescribeBadIndices(eye[3], eye[4])
                                                     : DescribeBadEye(status, position);
      return false;
    }
    prepared.View = view;
    prepared.HasRays = true;
    prepared.Version.Rays = MembraneVersion::MakeNumber();
    ++this->EyeUpdates;
  }
  if (this->Version.Rays != prepared.Version.Rays)
  {
    this->Version.Rays = prepared.Version.Rays;
    this->View = view;
    this->ReportEye(messages);
  }
  return true;
}

//------------------------------------------------------------------------------
void RefractionScene::ReportEye(SceneMessages& messages)
{
  // The test takes a few microseconds per point. Two sheets one behind the other overlap in many
  // consecutive points.
  constexpr std::size_t mostPoints = 256;
  const bool isCurved = this->IsCurved();
  const CurvedMembraneSolver& curved = this->GetCurved();
  const bool isEnclosed = isCurved && curved.IsClosed() && !curved.FacesEye();
  const bool reflects = this->View.Reflects;
  const bool isBehind = IsBehind(
    this->GetMembrane(), glm::dvec3(this->View.Eye[0], this->View.Eye[1], this->View.Eye[2]));
  const auto behind = static_cast<vtkTypeInt64>(
    isCurved && !reflects ? curved.CountVerticesBehindOtherPieces(mostPoints) : 0);
  const bool isNew = this->EyeReportOf != this->Version.Shape;
  std::ostringstream text;
  if (isEnclosed && (isNew || !this->EyeEnclosed))
  {
    text << "The eye is inside of a closed membrane whose normals point outwards: "
         << (reflects ? "it sees the back of the mirror only. To mirror its inside"
                      : "geometry outside passes unchanged. For a bubble around the eye")
         << ", reverse the normals. ";
  }
  if (isBehind && (isNew || !this->EyeBehind))
  {
    text << "No facet of the membrane faces the eye: its normals point to the other side, and "
         << (reflects ? "the eye sees the back of the mirror only. "
                      : "everything passes unchanged. ")
         << "Unless the eye is really behind the membrane, reverse the normals and the order of "
            "the corners, or use TurnTowardsEye of the vtkRefractingInterface. ";
  }
  if (behind > 0 && (isNew || this->PointsBehind == 0))
  {
    text
      << "Pieces of the membrane lie behind each other as seen from the eye: rays that meet two "
         "of them are refracted at one only, and objects behind both have an image through each. "
         "Use one piece, or a filter for each. ";
  }
  this->EyeEnclosed = isEnclosed;
  this->EyeBehind = isBehind;
  this->PointsBehind = behind;
  this->EyeReportOf = this->Version.Shape;
  messages.Warning = text.str();
}

//------------------------------------------------------------------------------
bool RefractionScene::SetView(const std::vector<ViewPlane>& planes)
{
  const Membrane& membrane = this->GetMembrane();
  const auto& facets = membrane.GetFacets();
  // Rounding of a sum of three products of coordinates, with planes that are computed from two
  // matrices.
  constexpr double rounding = 1e-12;
  const auto getBulge = [this](std::size_t facet)
  {
    return this->IsCurved()
      ? BoundBulge(this->GetCurved().GetPatches().GetPatch(static_cast<std::int32_t>(facet)))
      : 0.0;
  };
  std::vector<double> reaches;
  std::vector<double> heights; // above all planes, vertex by vertex
  for (const glm::dvec3& position : membrane.GetPositions())
  {
    const glm::dvec3 point = position + membrane.GetOrigin();
    reaches.push_back(glm::length(point));
    for (const ViewPlane& plane : planes)
    {
      heights.push_back(glm::dot(plane.Normal, point) + plane.Offset);
    }
  }
  std::vector<bool> inView(facets.size(), true);
  bool any = false;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    for (std::size_t k = 0; k < planes.size() && inView[i]; ++k)
    {
      double most = std::numeric_limits<double>::lowest();
      double reach = std::fabs(planes[k].Offset);
      for (const std::int32_t vertex : facets[i])
      {
        const auto v = static_cast<std::size_t>(vertex);
        most = std::max(most, heights[v * planes.size() + k]);
        reach = std::max(reach, reaches[v]);
      }
      // With NaN nothing is known, so the facet counts as in view.
      inView[i] = !(most < -rounding * reach && most < -getBulge(i) - rounding * reach);
    }
    any = any || !inView[i];
  }
  if (inView != this->FacetsInView)
  {
    this->FacetsInView = std::move(inView);
    ++this->ViewChange;
  }
  return any;
}

//------------------------------------------------------------------------------
bool RefractionScene::MayBeInView(const glm::dvec3& low, const glm::dvec3& high) const
{
  if (this->IsCurved())
  {
    return this->GetCurved().MayShow(low, high, this->FacetsInView);
  }
  const glm::dvec3 half = 0.5 * high - 0.5 * low;
  return this->GetFlat().MayShow(
    0.5 * low + 0.5 * high, std::max({ half.x, half.y, half.z }), this->FacetsInView);
}

//------------------------------------------------------------------------------
void RefractionScene::Solve(
  const double* points, std::size_t from, std::size_t to, VirtualVertex* vertices) const
{
  if (this->IsCurved())
  {
    this->GetCurved().Solve(points, from, to, vertices);
  }
  else
  {
    this->GetFlat().Solve(points, from, to, vertices);
  }
}

}

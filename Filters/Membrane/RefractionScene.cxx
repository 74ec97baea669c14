// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/RefractionScene.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/StackValidation.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include "vtkImplicitFunction.h"
#include "vtkPolyData.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meniscus
{

//------------------------------------------------------------------------------
bool RefractionScene::SetMembrane(
  vtkPolyData* membrane, bool curved, SceneMessages& messages, vtkImplicitFunction* function)
{
  const vtkMTimeType membraneTime = GetMembraneTime(membrane);
  const vtkMTimeType functionTime = function ? function->GetMTime() : 0;
  const bool known = this->MembraneReady && this->Curves == curved;
  if (known && this->MembraneSource == membrane && this->MembraneTime == membraneTime &&
    this->Function == function && this->FunctionTime == functionTime)
  {
    return true;
  }
  MembraneArrays arrays = ExtractMembrane(membrane);
  const std::size_t lost = function ? FitToFunction(function, arrays) : 0;
  this->MembraneSource = membrane;
  this->MembraneTime = membraneTime;
  this->Function = function;
  this->FunctionTime = functionTime;
  if (known && arrays == this->Arrays)
  {
    return true;
  }
  this->Arrays = std::move(arrays);
  const MembraneStatus status = this->BuildMembrane(curved);
  this->MembraneReady = status == MembraneStatus::Ready;
  ++this->PatchBuilds;
  return ReportMembrane(status, this->GetMembrane().GetReport(), this->Arrays, lost, messages);
}

//------------------------------------------------------------------------------
MembraneStatus RefractionScene::BuildMembrane(bool curved)
{
  if (curved != this->Curves)
  {
    this->Flat = FlatMembraneSolver();
    this->Curved.Clear();
    this->Curves = curved;
  }
  const MembraneInput input = this->Arrays.AsInput();
  return curved ? this->Curved.SetMembrane(input, FacetLoop) : this->Flat.SetMembrane(input);
}

//------------------------------------------------------------------------------
bool RefractionScene::SetEye(const Eye& eye, SceneMessages& messages, bool reflects)
{
  if (eye == this->Key.Values && this->PatchBuilds == this->Key.MembraneBuild &&
    reflects == this->Key.Reflects)
  {
    return true;
  }
  this->Key = EyeKey(); // stale until the update succeeds
  const glm::dvec3 position(eye[0], eye[1], eye[2]);
  const EyeStatus status = this->Curves
    ? this->Curved.SetEye(position, eye[3], eye[4], FacetLoop, reflects)
    : this->Flat.SetEye(position, eye[3], eye[4], FacetLoop);
  if (status == EyeStatus::Ready)
  {
    this->Key = { eye, this->PatchBuilds, reflects };
    ++this->EyeUpdates;
    this->ReportEye(messages);
    return true;
  }
  messages.Error = status == EyeStatus::BadIndex ? DescribeBadIndices(eye[3], eye[4])
                                                 : DescribeBadEye(status, position);
  return false;
}

//------------------------------------------------------------------------------
void RefractionScene::ReportEye(SceneMessages& messages)
{
  // The test takes a few microseconds per point. Two sheets one behind the other overlap in many
  // consecutive points.
  constexpr std::size_t mostPoints = 256;
  const bool isEnclosed = this->Curves && this->Curved.IsClosed() && !this->Curved.FacesEye();
  const bool reflects = this->Key.Reflects;
  const auto behind = static_cast<vtkTypeInt64>(
    this->Curves && !reflects ? this->Curved.CountVerticesBehindOtherPieces(mostPoints) : 0);
  const bool isNew = this->EyeReportOf != this->PatchBuilds;
  std::ostringstream text;
  if (isEnclosed && (isNew || !this->EyeEnclosed))
  {
    text << "The eye is inside of a closed membrane whose normals point outwards: "
         << (reflects ? "it sees the back of the mirror only. To mirror its inside"
                      : "geometry outside passes unchanged. For a bubble around the eye")
         << ", reverse the normals. ";
  }
  if (behind > 0 && (isNew || this->PointsBehind == 0))
  {
    text
      << "Pieces of the membrane lie behind each other as seen from the eye: rays that meet two "
         "of them are refracted at one only, and objects behind both have an image through each. "
         "Use one piece, or a filter for each. ";
  }
  this->EyeEnclosed = isEnclosed;
  this->PointsBehind = behind;
  this->EyeReportOf = this->PatchBuilds;
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
  std::vector<bool> inView(facets.size(), true);
  bool any = false;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    const double bulge = this->Curves
      ? BoundBulge(this->Curved.GetPatches().GetPatch(static_cast<std::int32_t>(i)))
      : 0.0;
    for (const ViewPlane& plane : planes)
    {
      double most = std::numeric_limits<double>::lowest();
      double reach = std::fabs(plane.Offset);
      for (const std::int32_t vertex : facets[i])
      {
        const glm::dvec3 point =
          membrane.GetPositions()[static_cast<std::size_t>(vertex)] + membrane.GetOrigin();
        most = std::max(most, glm::dot(plane.Normal, point) + plane.Offset);
        reach = std::max(reach, glm::length(point));
      }
      // With NaN nothing is known, so the facet counts as in view.
      inView[i] = inView[i] && !(most < -bulge - rounding * reach);
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
  if (this->Curves)
  {
    return this->Curved.MayShow(low, high, this->FacetsInView);
  }
  const glm::dvec3 half = 0.5 * high - 0.5 * low;
  return this->Flat.MayShow(
    0.5 * low + 0.5 * high, std::max({ half.x, half.y, half.z }), this->FacetsInView);
}

//------------------------------------------------------------------------------
void RefractionScene::Solve(
  const double* points, std::size_t from, std::size_t to, VirtualVertex* vertices) const
{
  if (this->Curves)
  {
    this->Curved.Solve(points, from, to, vertices);
  }
  else
  {
    this->Flat.Solve(points, from, to, vertices);
  }
}

}

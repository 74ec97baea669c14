// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/RefractionScene.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkImplicitFunction.h"
#include "vtkPolyData.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meniscus
{
namespace
{

const char* NameFault(MembraneStatus status)
{
  switch (status)
  {
    case MembraneStatus::TooLarge:
      return "The membrane has more points or triangles than 32-bit indices can address";
    case MembraneStatus::OneSided:
      return "The membrane is one-sided, like a Moebius band, so it has no side for the eye";
    case MembraneStatus::Empty:
    case MembraneStatus::Ready:
      break;
  }
  return "The membrane has no usable triangle";
}

/**
 * Latest modification time of a membrane and of the objects that hold its values. The time of a
 * vtkPolyData itself does not cover the arrays of its cells.
 */
vtkMTimeType TimeOf(vtkPolyData* membrane)
{
  vtkMTimeType time = membrane->GetMTime();
  for (vtkCellArray* cells : { membrane->GetPolys(), membrane->GetStrips() })
  {
    time = std::max(
      { time, cells->GetConnectivityArray()->GetMTime(), cells->GetOffsetsArray()->GetMTime() });
  }
  return time;
}

}

//------------------------------------------------------------------------------
bool RefractionScene::SetMembrane(
  vtkPolyData* membrane, bool curved, SceneMessages& messages, vtkImplicitFunction* function)
{
  const vtkMTimeType membraneTime = TimeOf(membrane);
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
  return this->ReportMembrane(status, lost, messages);
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
bool RefractionScene::ReportMembrane(
  MembraneStatus status, std::size_t lost, SceneMessages& messages) const
{
  const MembraneReport& report = this->GetMembrane().GetReport();
  const std::size_t triangles = this->Arrays.Triangles.size() / 3;
  const std::size_t points = this->Arrays.Points.size() / 3;
  std::ostringstream text;
  if (status != MembraneStatus::Ready)
  {
    text << NameFault(status) << " (" << report.Skipped() << " of " << triangles
         << " triangles skipped)";
    messages.Error = text.str();
    return false;
  }
  if (report.Skipped() > 0)
  {
    text << report.Skipped() << " of " << triangles
         << " membrane triangles skipped: " << report.ZeroArea << " without area, "
         << report.NotFinite << " with coordinates that are not finite, " << report.OutOfRange
         << " with points that do not exist, " << report.Duplicated << " repeated. ";
  }
  if (lost > 0)
  {
    text << lost << " of " << points
         << " membrane points cannot be moved onto the exact membrane's zero set; they keep their "
            "positions. ";
  }
  if (this->Arrays.NormalsRejected)
  {
    text << "The membrane's normals do not have 3 components for each of its " << points
         << " points; normals are computed. ";
  }
  else if (report.ComputedNormals > lost && !this->Arrays.Normals.empty())
  {
    text << report.ComputedNormals << " of " << points
         << " membrane normals are zero or not finite; these are computed. ";
  }
  if (report.TurnedFacets > 0)
  {
    text << report.TurnedFacets << " of " << triangles
         << " membrane triangles have another winding than their neighbours; it is reversed. ";
  }
  if (report.TurnedNormals > 0)
  {
    text << report.TurnedNormals << " of " << points
         << " membrane normals point to another side than their neighbours; they are reversed. ";
  }
  if (report.Normals.AreMost())
  {
    text
      << report.Normals.Foreign << " of " << report.Normals.Examined
      << " membrane normals do not fit the triangles around them, as if points had been moved and "
         "normals had not; they are used nevertheless. To refract by the triangles themselves, "
         "remove the normals or compute them by vtkPolyDataNormals. ";
  }
  messages.Warning = text.str();
  return true;
}

//------------------------------------------------------------------------------
bool RefractionScene::SetEye(const Eye& eye, SceneMessages& messages)
{
  if (eye == this->Key.Values && this->PatchBuilds == this->Key.MembraneBuild)
  {
    return true;
  }
  this->Key = EyeKey(); // stale until the update succeeds
  const glm::dvec3 position(eye[0], eye[1], eye[2]);
  const EyeStatus status = this->Curves ? this->Curved.SetEye(position, eye[3], eye[4], FacetLoop)
                                        : this->Flat.SetEye(position, eye[3], eye[4], FacetLoop);
  std::ostringstream text;
  switch (status)
  {
    case EyeStatus::Ready:
      this->Key = { eye, this->PatchBuilds };
      ++this->EyeUpdates;
      this->ReportEye(messages);
      return true;
    case EyeStatus::BadIndex:
      text << "Indices of refraction must be positive and finite, not " << eye[3] << " and "
           << eye[4];
      break;
    case EyeStatus::NotFinite:
      text << "The eye (" << eye[0] << ", " << eye[1] << ", " << eye[2] << ") is not finite";
      break;
    case EyeStatus::OnTheMembrane:
      text << "The eye (" << eye[0] << ", " << eye[1] << ", " << eye[2] << ") lies on the membrane";
      break;
  }
  messages.Error = text.str();
  return false;
}

//------------------------------------------------------------------------------
void RefractionScene::ReportEye(SceneMessages& messages)
{
  // The test takes a few microseconds per point. Two sheets one behind the other overlap in many
  // consecutive points.
  constexpr std::size_t mostPoints = 256;
  const bool isEnclosed = this->Curves && this->Curved.IsClosed() && !this->Curved.FacesEye();
  const auto behind = static_cast<vtkTypeInt64>(
    this->Curves ? this->Curved.CountVerticesBehindOtherPieces(mostPoints) : 0);
  const bool isNew = this->EyeReportOf != this->PatchBuilds;
  std::ostringstream text;
  if (isEnclosed && (isNew || !this->EyeEnclosed))
  {
    text << "The eye is inside of a closed membrane whose normals point outwards: geometry "
            "outside passes unchanged. For a bubble around the eye, reverse the normals. ";
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

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/SourceSurface.h"

#include "Filters/Common/ThreadedLoop.h"

#include "vtkImplicitFunction.h"
#include "vtkPolyData.h"

#include <sstream>
#include <utility>

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

/** Points, triangles and normals that cannot be used as they are given. */
void DescribeOmissions(
  std::ostream& text, const MembraneReport& report, const MembraneArrays& arrays, std::size_t lost)
{
  const std::size_t triangles = arrays.Triangles.size() / 3;
  const std::size_t points = arrays.Points.size() / 3;
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
  if (arrays.NormalsRejected)
  {
    text << "The membrane's normals do not have 3 components for each of its " << points
         << " points; normals are computed. ";
  }
  else if (report.ComputedNormals > lost + report.DifferentNormals && !arrays.Normals.empty())
  {
    text << report.ComputedNormals - report.DifferentNormals << " of " << points
         << " membrane normals are zero or not finite; these are computed. ";
  }
}

/** Triangles and normals that do not fit their neighbours. */
void DescribeMisfits(
  std::ostream& text, const MembraneReport& report, std::size_t triangles, std::size_t points)
{
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
  if (report.WildNormals > 0)
  {
    text << report.WildNormals << " of " << points
         << " membrane normals deviate by more than 30 degrees from the triangles around them and "
            "from the normals next to them; they are replaced by computed ones. ";
  }
  if (report.NonManifoldFacets > 0)
  {
    text << report.NonManifoldFacets << " of " << triangles
         << " membrane triangles have an edge that three or more of them share, such as a fin on a "
            "surface; the surface is taken to end there, and rays are refracted at each sheet "
            "alone. ";
  }
  if (report.Normals.AreMost())
  {
    text
      << report.Normals.Foreign << " of " << report.Normals.Examined
      << " membrane normals do not fit the triangles around them, as if points had been moved and "
         "normals had not; they are used nevertheless. To refract by the triangles themselves, "
         "remove the normals or compute them by vtkPolyDataNormals. ";
  }
}

}

//------------------------------------------------------------------------------
MembraneOrigin::MembraneOrigin(vtkPolyData* source, vtkImplicitFunction* function, bool curves)
  : Source(source)
  , SourceTime(GetMembraneTime(source))
  , Function(function)
  , FunctionTime(function ? function->GetMTime() : 0)
  , Curves(curves)
{
}

//------------------------------------------------------------------------------
bool MembraneOrigin::operator==(const MembraneOrigin& other) const
{
  return this->Source == other.Source && this->SourceTime == other.SourceTime &&
    this->Function == other.Function && this->FunctionTime == other.FunctionTime &&
    this->Curves == other.Curves;
}

//------------------------------------------------------------------------------
bool SourceSurface::Update(vtkPolyData* source, vtkImplicitFunction* function, bool curves)
{
  const MembraneOrigin origin(source, function, curves);
  if (this->IsReady() && this->Origin == origin)
  {
    return false;
  }
  MembraneArrays arrays = ExtractMembrane(source);
  const std::size_t lost = function ? FitToFunction(function, arrays) : 0;
  if (this->Turned)
  {
    arrays.Turn();
  }
  const bool isKnown = this->IsReady() && this->Origin.Curves == curves && arrays == this->Arrays;
  this->Origin = origin;
  if (isKnown)
  {
    return false;
  }
  this->Arrays = std::move(arrays);
  this->Lost = lost;
  this->Build();
  return true;
}

//------------------------------------------------------------------------------
void SourceSurface::Turn()
{
  this->Turned = !this->Turned;
  this->Arrays.Turn();
  this->Build();
}

//------------------------------------------------------------------------------
void SourceSurface::Build()
{
  if (this->UsedChange == Change::NewObject)
  {
    this->Surface = std::make_shared<RefractingSurface>();
  }
  this->Status = this->Surface->SetMembrane(this->Arrays.AsInput(),
    this->Origin.Curves ? SurfaceParts::Patches : SurfaceParts::Facets, FacetLoop);
  ++this->Builds;
}

//------------------------------------------------------------------------------
bool SourceSurface::Report(SceneMessages& messages) const
{
  const MembraneReport& report = this->GetMembrane().GetReport();
  const std::size_t triangles = this->Arrays.Triangles.size() / 3;
  std::ostringstream text;
  if (!this->IsReady())
  {
    text << NameFault(this->Status) << " (" << report.Skipped() << " of " << triangles
         << " triangles skipped)";
    messages.Error = text.str();
    return false;
  }
  DescribeOmissions(text, report, this->Arrays, this->Lost);
  DescribeMisfits(text, report, triangles, this->Arrays.Points.size() / 3);
  messages.Warning = text.str();
  return true;
}

}

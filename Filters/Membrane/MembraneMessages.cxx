// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/MembraneMessages.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
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

}

//------------------------------------------------------------------------------
bool ReportMembrane(MembraneStatus status, const MembraneReport& report,
  const MembraneArrays& arrays, std::size_t lost, SceneMessages& messages)
{
  const std::size_t triangles = arrays.Triangles.size() / 3;
  const std::size_t points = arrays.Points.size() / 3;
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
  messages.Warning = text.str();
  return true;
}

//------------------------------------------------------------------------------
std::string DescribeNoImage(
  const Membrane& surface, const glm::dvec3& eye, double side, double before, double behind)
{
  bool isSeen = false;
  bool isReflected = true;
  for (const Membrane::Facet& facet : surface.GetFacets())
  {
    for (const std::int32_t vertex : facet)
    {
      const auto i = static_cast<std::size_t>(vertex);
      const glm::dvec3 sight = eye - surface.GetPositions()[i];
      const double cosine = side * glm::dot(sight, surface.GetNormals()[i]) / glm::length(sight);
      if (cosine > 0.0)
      {
        isSeen = true;
        isReflected = isReflected && before * std::sqrt(1.0 - cosine * cosine) > behind;
      }
    }
  }
  if (isSeen && isReflected)
  {
    std::ostringstream text;
    text << "Everything is totally reflected: the eye sees each point of the membrane at more than "
            "the critical angle, "
         << glm::degrees(std::asin(behind / before))
         << " degrees from the normal, from the medium with the index " << before
         << " to the medium with the index " << behind << ".";
    return text.str();
  }
  return "Is the eye on the side that the membrane's normals point to, and are geometry (port 0) "
         "and membrane (port 1) at the right ports?";
}

//------------------------------------------------------------------------------
std::string DescribeBadEye(EyeStatus status, const glm::dvec3& eye)
{
  std::ostringstream text;
  text << "The eye (" << eye.x << ", " << eye.y << ", " << eye.z << ") "
       << (status == EyeStatus::OnTheMembrane ? "lies on the membrane" : "is not finite");
  return text.str();
}

}

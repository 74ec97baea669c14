// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesher/SurfaceMessages.h"

#include <sstream>

namespace meniscus
{

//------------------------------------------------------------------------------
std::string DescribeSurfaceFault(const SurfaceReport& report)
{
  std::ostringstream text;
  switch (report.Fault)
  {
    case SurfaceFault::None:
      break;
    case SurfaceFault::Empty:
      text << "The surface is empty: it has no polygon with an area.";
      break;
    case SurfaceFault::NotFinite:
      text << "The surface has " << report.Count << " points that are not finite.";
      break;
    case SurfaceFault::Open:
      text << "The surface is open: " << report.Count
           << " edges belong to one triangle only. vtkFillHolesFilter may close it; points that "
              "should coincide must have equal coordinates (vtkCleanPolyData).";
      break;
    case SurfaceFault::NonManifold:
      text << "The surface is not a manifold: " << report.Count
           << " edges belong to more than two triangles.";
      break;
    case SurfaceFault::Winding:
      text << "The surface has no common outside: neighbouring triangles are wound differently at "
           << report.Count
           << " edges. vtkPolyDataNormals with ConsistencyOn() can wind them alike.";
      break;
    case SurfaceFault::InsideOut:
      text << "The surface is inside out: its triangles must be counterclockwise as seen from "
              "outside. vtkReverseSense turns them.";
      break;
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::string DescribeProcessEnd(ProcessEnd end, const MesherProcess& process)
{
  std::ostringstream text;
  switch (end)
  {
    case ProcessEnd::Answered:
    case ProcessEnd::Aborted:
      break;
    case ProcessEnd::NoFiles:
      text << "The files for TetGen could not be written to the folder of temporary files.";
      break;
    case ProcessEnd::NotStarted:
      text << "The program of TetGen could not be started: " << process.Program << '.';
      break;
    case ProcessEnd::Crashed:
      text << "TetGen crashed on this surface; its triangles may touch or cross each other.";
      break;
    case ProcessEnd::NoAnswer:
      text << "The program of TetGen ended without an answer: " << process.Program << '.';
      break;
    case ProcessEnd::TimedOut:
      text << "TetGen was ended after " << process.TimeLimit
           << " s, the time limit; allow more, or larger cells.";
      break;
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::string DescribeMeshingEnd(MeshingEnd end)
{
  switch (end)
  {
    case MeshingEnd::Done:
      return {};
    case MeshingEnd::OutOfMemory:
      return "TetGen has run out of memory.";
    case MeshingEnd::SelfIntersection:
      return "The surface crosses itself.";
    case MeshingEnd::SmallFeature:
      return "The surface has details that are too small for TetGen.";
    case MeshingEnd::CloseFacets:
      return "Parts of the surface are too close to each other for TetGen.";
    case MeshingEnd::InternalError:
    case MeshingEnd::BadInput:
    case MeshingEnd::OtherError:
      break;
  }
  return "TetGen gave up on this surface, with error " + std::to_string(static_cast<int>(end)) +
    "; its triangles may touch or cross each other.";
}

//------------------------------------------------------------------------------
std::string DescribeSolidFault(SolidFault fault)
{
  switch (fault)
  {
    case SolidFault::None:
      return {};
    case SolidFault::LostFacets:
      return "The Delaunay cells of the surface's points do not have all of its triangles as "
             "faces: the surface crosses itself, is too coarse for vtkDelaunay3D, or has points "
             "that are almost on a common sphere. Refine it, or use TetGen.";
    case SolidFault::Nesting:
      return "Parts of the surface are nested or overlap in a way that leaves inside and outside "
             "undefined: cavities must be wound the other way round.";
    case SolidFault::FlatCells:
      return "The mesher made cells without volume.";
    case SolidFault::WrongVolume:
      break;
  }
  return "The mesher's cells do not have the volume of the surface; it may cross itself.";
}

} // namespace meniscus

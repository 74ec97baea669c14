// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/BitTable.h"
#include "Common/TableVersion.h"
#include "Filters/Membrane/SourceSurface.h"
#include "Refraction/Surface/Interface.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Caster/RefractedLegEntries.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractedRayStack.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;
class vtkRefractingInterfaceCollection;

namespace meniscus
{

/**
 * Membrane at which a mapper's rays are refracted: one surface, or several in the order in which
 * rays meet them. Interfaces with the same medium on both sides are left out. The patches of a
 * surface are kept until its shape changes, the refracted rays until a shape, the view or indices
 * change, and the vertices in their frames until those or the mesh change.
 */
class RayCastMembrane
{
public:
  /**
   * Takes the surfaces at port 1 of the owner, none without a membrane, and their interfaces, and
   * reads the shapes of those that refract; if none does and the membrane is `wanted` anyway, that
   * of the first. A data object of another type than vtkPolyData is null. With an error the
   * membrane cannot be used; a warning is reported once.
   */
  InputReport Update(const std::vector<vtkPolyData*>& surfaces,
    vtkRefractingInterfaceCollection* interfaces, bool wanted);

  /** Number of interfaces at which rays are traced; 0 if the membrane changes nothing. */
  int GetNumberOfInterfaces() const { return static_cast<int>(this->Used.size()); }

  /**
   * Traces an image's rays through the interfaces. Returns false if none of them meets the first.
   * @param view everything but its Mesh.
   * @param input mesh through which the rays pass.
   */
  bool Trace(RefractedRayStack::View view, VolumeInput& input);
  /**
   * Error in the order of the media that Trace() has found, by the side of the first interface from
   * which rays come; empty if there is none.
   */
  std::string DescribeMismatch() const;
  /**
   * Warning that the first interface shows the eye its back alone, after Trace(); empty if it does
   * not, and after the first until it has shown its front.
   */
  std::string WarnOfSide();
  /** Frames of the refracted rays, after Trace(). */
  const RefractionFrames& GetFrames() const { return this->Frames; }
  /** Legs of the image's rays: the sight rays, and the rays behind each interface. */
  RayLegs GetLegs() const;
  /** True if a refracted ray may begin inside the mesh. */
  bool BeginsInside(VolumeInput& input);
  /**
   * Result of Trace() for the native caster, with the vertices in the frames.
   * @pre Trace()
   */
  RefractedScene See(VolumeInput& input);

  /** Changes when a shape is taken in. */
  TableVersion GetShapeVersion() const;
  /** Changes when rays are traced. */
  TableVersion GetSightVersion() const { return this->SightVersion; }
  /** Bytes of the refracted rays. */
  std::int64_t GetSightBytes() const { return this->Rays.GetBytes(); }
  /** Bytes of the rays and of the vertices about them. */
  std::int64_t GetBytes() const { return this->GetSightBytes() + this->Frames.GetBytes(); }
  /** Rays of the last image, see RefractedRayStack; 0 if the membrane changes nothing. */
  RefractedRayStack::Counts GetCounts() const;

private:
  bool IsOnWrongSide() const;

  struct Shape
  {
    SourceSurface Source;
    /**
     * Last warning, so that it is not repeated when the same triangles are left out of the next
     * wave.
     */
    std::string Told;
  };

  /** Rays behind each interface in the order in which rays meet them: legs 1 and following. */
  std::vector<const RefractedRayTiles*> ListRefracted() const;
  InputReport ReadShape(vtkPolyData* surface, std::size_t number, const std::string& name);

  /** Surfaces by the number of the first interface that has them. */
  std::vector<Shape> Shapes;
  /** Interfaces at which rays are traced. */
  std::vector<Interface> Used;
  /** True if the media match along the list for rays from the exterior of the first interface. */
  bool FitsFromExterior = true;
  /** True from the warning about the side of the first interface on, until it is right. */
  bool IsSideReported = false;
  RefractedRayStack Rays;
  RefractionFrames Frames;
  /** View, interfaces and version of their shapes that the rays were traced for. */
  RefractedRayStack::View View;
  std::vector<Interface> SightOf;
  TableVersion SightShapes;
  /** Mesh whose active cells rays were traced for, and links for which that is known to do. */
  TableVersion SightMesh;
  TableVersion SightLinks;
  BitTable SightCells;
  TableVersion SightVersion;
  /** Versions of the mesh, of its scalars and of the sight that vertices were placed for. */
  TableVersions Placed;
  /** Whether the mesh has inverted cells, and the version of the mesh that was examined. */
  bool Inverted = false;
  TableVersion InvertedOf;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_RayCastMembrane_h
#define meniscus_Rendering_Backends_RayCastMembrane_h

#include "Common/TableVersion.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Caster/RefractedLegEntries.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace meniscus
{

/**
 * Membrane at which a mapper's rays are refracted. Its patches are kept until its shape changes,
 * the refracted rays until shape, view or indices change, and the vertices in their frames until
 * those or the mesh change.
 */
class RayCastMembrane
{
public:
  /**
   * Reads the membrane's shape if the indices of refraction differ, or if it is `wanted` anyway.
   * With an error it cannot be used; a warning is reported once.
   * @param membrane null for none.
   */
  InputReport Update(vtkPolyData* membrane, double exterior, double interior, bool wanted);

  /**
   * Traces an image's rays to the membrane. Returns false if none of them meets it.
   * @param view everything but its Mesh.
   * @param input mesh through which the rays pass.
   */
  bool Trace(RefractedRayField::View view, VolumeInput& input);
  /** Result of Trace(), and the frames of the refracted rays. */
  const RefractedRayField& GetSight() const { return this->Sight; }
  const RefractionFrames& GetFrames() const { return this->Frames; }
  /** Legs of the image's rays: the sight rays, and the rays behind the membrane. */
  RayLegs GetLegs() const;
  /** True if a refracted ray may begin inside the mesh. */
  bool BeginsInside(VolumeInput& input);
  /**
   * Result of Trace() for the native caster, with the vertices in the frames.
   * @pre Trace()
   */
  RefractedScene See(VolumeInput& input);

  /** Changes when the shape is taken in. */
  TableVersion GetShapeVersion() const
  {
    return TableVersion(this->Surface.GetNumberOfPatchBuilds());
  }
  /** Changes when rays are traced to the membrane. */
  TableVersion GetSightVersion() const { return this->SightVersion; }
  /** Bytes of the rays and of the vertices about them. */
  std::int64_t GetBytes() const { return this->Sight.GetBytes() + this->Frames.GetBytes(); }

private:
  /** Rays behind each interface in the order in which rays meet them: legs 1 and following. */
  std::vector<const RefractedRayTiles*> ListRefracted() const;

  RefractionScene Surface;
  /**
   * Last warning, so that it is not repeated when the same triangles are left out of the next wave.
   */
  std::string Told;
  RefractedRayField Sight;
  RefractionFrames Frames;
  /** Version of the shape that the sight was traced for. */
  TableVersion SightOf;
  TableVersion SightVersion;
  /** Versions of the mesh, of its scalars and of the sight that vertices were placed for. */
  TableVersions Placed;
  /** Whether the mesh has inverted cells, and the version of the mesh that was examined. */
  bool Inverted = false;
  TableVersion InvertedOf;
};

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_RayCastMembrane_h
#define meniscus_Rendering_Backends_RayCastMembrane_h

#include "Common/TableVersion.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Caster/RefractedRayCaster.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstdint>
#include <string>

class vtkPolyData;

namespace meniscus
{

/**
 * The membrane that a mapper's rays bend at. Its patches are kept as long as its shape, the rays
 * behind it as long as shape, view and indices, the vertices about them as long as those and the
 * mesh.
 */
class RayCastMembrane
{
public:
  /**
   * Takes the membrane's shape, if the indices of refraction differ or it is `wanted` all the same.
   * With an error it cannot be used; a warning is told once.
   * @param membrane  null if it is none.
   */
  InputReport Update(vtkPolyData* membrane, double exterior, double interior, bool wanted);

  /**
   * Traces an image's rays to the membrane. False if none of them meets it.
   * @param view   but its Mesh.
   * @param input  what the rays go through.
   */
  bool Trace(RefractedRayField::View view, VolumeInput& input);
  /** What was traced, and the frames of the rays behind the membrane. */
  const RefractedRayField& GetSight() const { return this->Sight; }
  const RefractionFrames& GetFrames() const { return this->Frames; }
  /** Whether a ray behind the membrane may begin within the mesh. */
  bool BeginsInside(VolumeInput& input);
  /** What was traced for the native caster, with the vertices about the rays. @pre Trace() */
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
  RefractionScene Surface;
  /** What was last said of it: the same triangles are left out of the next wave. */
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

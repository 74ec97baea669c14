// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Pipeline_RayCastMembrane_h
#define meniscus_Rendering_Pipeline_RayCastMembrane_h

#include "Filters/Membrane/RefractionScene.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Caster/RefractedRayCaster.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <array>
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

  /** Times that the shape was taken in. */
  std::int64_t GetBuilds() const { return this->Surface.GetNumberOfPatchBuilds(); }
  /** Times that rays were traced to the membrane. */
  std::int64_t GetSightUpdates() const { return this->SightUpdates; }
  /** Bytes of the rays and of the vertices about them. */
  std::int64_t GetBytes() const { return this->Sight.GetBytes() + this->Frames.GetBytes(); }

private:
  /** Of the input's mesh and of its scalars, and of the sight; what vertices were placed for. */
  using PlacedVersion = std::array<std::int64_t, 3>;

  RefractionScene Surface;
  /** What was last said of it: the same triangles are left out of the next wave. */
  std::string Told;
  RefractedRayField Sight;
  RefractionFrames Frames;
  std::int64_t SightOf = 0;
  std::int64_t SightUpdates = 0;
  PlacedVersion Placed{ 0, 0, 0 };
  /** Whether the mesh has inverted cells, and of which build that is known. */
  bool Inverted = false;
  std::int64_t InvertedOf = 0;
};

}

#endif

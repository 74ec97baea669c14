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
  /** True if a refracted ray may begin inside the mesh. */
  bool BeginsInside(VolumeInput& input);
  /**
   * Result of Trace() for the native caster, with the vertices in the frames.
   * @pre Trace()
   */
  RefractedScene See(VolumeInput& input);

  /** Number of times that the shape was read. */
  std::int64_t GetBuilds() const { return this->Surface.GetNumberOfPatchBuilds(); }
  /** Number of times that rays were traced to the membrane. */
  std::int64_t GetSightUpdates() const { return this->SightUpdates; }
  /** Bytes of the rays and of the vertices in their frames. */
  std::int64_t GetBytes() const { return this->Sight.GetBytes() + this->Frames.GetBytes(); }

private:
  /** Versions of the input's mesh and scalars and of the sight for which vertices were placed. */
  using PlacedVersion = std::array<std::int64_t, 3>;

  RefractionScene Surface;
  /**
   * Last warning, so that it is not repeated when the same triangles are left out of the next wave.
   */
  std::string Told;
  RefractedRayField Sight;
  RefractionFrames Frames;
  std::int64_t SightOf = 0;
  std::int64_t SightUpdates = 0;
  PlacedVersion Placed{ 0, 0, 0 };
  /** True if the mesh has inverted cells, and the build for which that was determined. */
  bool Inverted = false;
  std::int64_t InvertedOf = 0;
};

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_RayCastMembrane_h
#define meniscus_Rendering_Backends_RayCastMembrane_h

#include "Common/TableVersion.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Caster/RefractedLegEntries.h"
#include "Volume/Refracted/PatchTree.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractedRayField.h"
#include "Volume/Refracted/RefractedRayStack.h"
#include "Volume/Refracted/RefractionFrames.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace meniscus
{

/** One of the interfaces at which a mapper's rays are refracted. */
struct MembraneInterface
{
  /** Null for a data object of another type. */
  vtkPolyData* Surface = nullptr;
  /** Indices of refraction on the side that the normals point to, and on the other side. */
  double Exterior = 1.0;
  double Interior = 1.0;
};

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
   * Takes the interfaces, none without a membrane, and reads the shapes of those that refract; if
   * none does and the membrane is `wanted` anyway, that of the first. With an error the membrane
   * cannot be used; a warning is reported once.
   */
  InputReport Update(const std::vector<MembraneInterface>& interfaces, bool wanted);

  /** Number of interfaces at which rays are traced; 0 if the membrane changes nothing. */
  int GetNumberOfInterfaces() const { return static_cast<int>(this->Used.size()); }

  /**
   * Traces an image's rays through the interfaces. Returns false if none of them meets the first.
   * @param view everything but its Mesh and indices.
   * @param input mesh through which the rays pass.
   */
  bool Trace(RefractedRayField::View view, VolumeInput& input);
  /**
   * Error in the order of the media that Trace() has found, by the side of the first interface from
   * which rays come; empty if there is none.
   */
  std::string DescribeMismatch() const;
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
  std::int64_t GetSightBytes() const { return this->Sight.GetBytes() + this->Stack.GetBytes(); }
  /** Bytes of the rays and of the vertices about them. */
  std::int64_t GetBytes() const { return this->GetSightBytes() + this->Frames.GetBytes(); }
  /** Rays of the last image, see RefractedRayStack; 0 if the membrane changes nothing. */
  RefractedRayStack::Counts GetCounts() const;

private:
  /** A surface, with the tree of its patches if there are several interfaces. */
  struct SurfaceShape
  {
    RefractionScene Scene;
    PatchTree Tree;
    /** Build of the scene's patches that the tree is for. */
    std::int64_t TreeOf = -1;
    /**
     * Last warning, so that it is not repeated when the same triangles are left out of the next
     * wave.
     */
    std::string Told;
  };
  /** An interface at which rays are traced. */
  struct UsedInterface
  {
    /** Number of its surface in Shapes. */
    std::size_t Shape;
    double Exterior;
    double Interior;

    bool operator==(const UsedInterface& other) const
    {
      return this->Shape == other.Shape && this->Exterior == other.Exterior &&
        this->Interior == other.Interior;
    }
  };

  /** Rays behind each interface in the order in which rays meet them: legs 1 and following. */
  std::vector<const RefractedRayTiles*> ListRefracted() const;
  InputReport ReadShape(vtkPolyData* surface, std::size_t number, const std::string& name);
  void TraceStack(const RefractedRayField::View& view);

  /** Surfaces by the number of the first interface that has them. */
  std::vector<std::unique_ptr<SurfaceShape>> Shapes;
  std::vector<UsedInterface> Used;
  /** True if the media match along the list for rays from the exterior of the first interface. */
  bool FitsFromExterior = true;
  /** Rays behind one interface. */
  RefractedRayField Sight;
  /** Rays behind several interfaces. */
  RefractedRayStack Stack;
  RefractionFrames Frames;
  /** View, interfaces and version of their shapes that the rays were traced for. */
  RefractedRayField::View View;
  std::vector<UsedInterface> SightOf;
  TableVersion SightShapes;
  TableVersion SightVersion;
  /** Versions of the mesh, of its scalars and of the sight that vertices were placed for. */
  TableVersions Placed;
  /** Whether the mesh has inverted cells, and the version of the mesh that was examined. */
  bool Inverted = false;
  TableVersion InvertedOf;
};

}

#endif

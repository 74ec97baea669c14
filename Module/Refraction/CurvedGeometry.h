// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Virtual vertices behind a membrane of curved patches: a membrane, its patches, a tree of ray
 * tubes over them, and Newton's method on Snell's law. World coordinates outside, local ones
 * inside.
 *
 * Patches are kept as long as the shape, the tree's bounds as long as eye and indices. Solving
 * changes nothing and may run on any number of threads at once.
 */
#ifndef meniscus_Refraction_CurvedGeometry_h
#define meniscus_Refraction_CurvedGeometry_h

#include "Refraction/CellTree.h"
#include "Refraction/CurvedPatches.h"
#include "Refraction/Membrane.h"
#include "Refraction/SightEquation.h"
#include "Refraction/VirtualGeometry.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/// A sight point and the facet whose patch it lies in.
struct SightPlace
{
  std::int32_t facet = CurvedPatches::NoFacet;
  SightRoot root{};
};

class CurvedGeometry
{
public:
  CurvedGeometry() = default;
  CurvedGeometry(const CurvedGeometry&) = delete; ///< the patches point to the membrane
  CurvedGeometry& operator=(const CurvedGeometry&) = delete;

  /// Points that share a chain of warm starts. Ranges that begin and end at multiples of it give
  /// the same result whoever solves them.
  static constexpr std::size_t Chain = 128;

  /// Takes a shape. If only points and normals differ from the last one, patches are refitted and
  /// the topology is kept. The eye must be set again afterwards.
  MembraneStatus SetMembrane(const MembraneInput& input, const RangeLoop& loop = SerialLoop);

  /// Forgets the membrane.
  void Clear();

  const Membrane& GetMembrane() const { return this->Surface; }
  const CurvedPatches& GetPatches() const { return this->Patches; }

  /// Fits the tree for an eye in world coordinates. Unless `Ready`, nothing may be solved.
  EyeStatus SetEye(
    const glm::dvec3& eye, double exterior, double interior, const RangeLoop& loop = SerialLoop);

  /// One image of each of `points` (x, y, z each) in [begin, end), written to the same places of
  /// `vertices`. Of several images it is the one that continues that of the point before, or, at
  /// the start of a chain and where this ends, the first that the tree meets.
  void Solve(
    const double* points, std::size_t begin, std::size_t end, VirtualVertex* vertices) const;

  /// Replaces `images` by every image of a point, in the order of their facets. `Found` if there is
  /// any.
  ImageState FindImages(const glm::dvec3& point, std::vector<VirtualVertex>& images) const;

private:
  /// What a chain remembers: the last two answers.
  struct Memory
  {
    SightPlace place;
    glm::dvec3 point{ 0.0 };
    glm::dvec3 pointStep{ 0.0 };
    glm::dvec3 sightStep{ 0.0 };
  };

  bool IsInReach(const glm::dvec3& local) const;
  bool IsEyeOnPatch(std::int32_t facet) const;
  VirtualVertex SolvePoint(const glm::dvec3& point, Memory& memory) const;
  bool Follow(const SightEquation& equation, const glm::dvec3& local, const Memory& memory,
    SightPlace& place) const;
  bool FindFirst(const SightEquation& equation, const glm::dvec3& local, SightPlace& place) const;
  void FindPlaces(
    const SightEquation& equation, const glm::dvec3& local, std::vector<SightPlace>& places) const;
  VirtualVertex MakeVertex(
    const glm::dvec3& local, const CurvedPatch& patch, const SightPlace& place) const;

  Membrane Surface;
  CurvedPatches Patches;
  CellTree Tree;
  glm::dvec3 Eye{ 0.0 };
  double Exterior = 1.0;
  double Interior = 1.0;
};

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The refracting surface: validated triangles with one unit normal per vertex, relative to a local
 * origin. It holds all data that depend on the shape alone and are built once per shape; data that
 * depend on the eye are in RefractionCells.
 */
#pragma once

#include "Refraction/Membrane/MembraneOrientation.h"
#include "Refraction/Membrane/MismatchedNormals.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meniscus
{

/** A triangle surface as plain arrays, borrowed for the length of a call. */
struct MembraneInput
{
  const double* Points = nullptr; ///< x, y, z per point
  std::size_t NumberOfPoints = 0;
  const std::int64_t* Triangles = nullptr; ///< three point indices per triangle
  std::size_t NumberOfTriangles = 0;
  const std::int64_t* CellIds = nullptr; ///< caller's id of each triangle; null: its index
  const double* Normals = nullptr; ///< x, y, z per point, of any length; null: normals are computed
};

enum class MembraneStatus
{
  Ready,
  Empty,    ///< no triangles, or none that is valid
  TooLarge, ///< more points or triangles than 32-bit indices can address
  OneSided  ///< the surface has one side only, as a Moebius band has
};

/** Result of the validation. A skipped triangle is counted once, under the first fault found. */
struct MembraneReport
{
  std::size_t OutOfRange = 0;        ///< skipped: refers to a point that does not exist
  std::size_t NotFinite = 0;         ///< skipped: a corner with a NaN or infinite coordinate
  std::size_t ZeroArea = 0;          ///< skipped: area within the rounding of its cross product or
                                     ///< of the membrane's local coordinates
  std::size_t Duplicated = 0;        ///< skipped: same three points as an earlier triangle
  std::size_t ComputedNormals = 0;   ///< vertices whose normal was missing, zero, not finite or
                                     ///< different at joined vertices
  std::size_t DifferentNormals = 0;  ///< given normals that differ between joined vertices, or are
                                     ///< a facet's; computed
  std::size_t WildNormals = 0;       ///< given normals that cannot belong to the surface; computed
  std::size_t JoinedVertices = 0;    ///< replaced by another vertex at the same place
  std::size_t NonManifoldFacets = 0; ///< kept, but not joined across edges of three or more facets
  std::size_t TurnedFacets = 0;  ///< kept; the winding was reversed to agree with the neighbours
  std::size_t TurnedNormals = 0; ///< kept; reversed to the side of the neighbours
  MismatchedNormals Normals;     ///< kept; given normals that do not fit the facets

  std::size_t Skipped() const
  {
    return this->OutOfRange + this->NotFinite + this->ZeroArea + this->Duplicated;
  }
};

class Membrane
{
public:
  using Facet = std::array<std::int32_t, 3>;

  /** Replaces the surface. The membrane is empty afterwards unless the result is `Ready`. */
  MembraneStatus Build(const MembraneInput& input);

  /**
   * Centre of the bounding box of the used vertices. All positions below are relative to it, so
   * that large coordinate offsets cost no accuracy after the subtraction.
   */
  const glm::dvec3& GetOrigin() const { return this->Origin; }

  /** Largest absolute local coordinate of a used vertex; positive if the membrane is ready. */
  double GetRadius() const { return this->Radius; }

  /**
   * Rounding error of a position on the surface that has been at `distance` from the origin of the
   * coordinates. It is a sum of a few products of coordinates; Newton's method adds a few more
   * roundings.
   */
  double GetSlack(double distance) const
  {
    return 256.0 * std::numeric_limits<double>::epsilon() * std::max(this->Radius, distance);
  }

  const std::vector<glm::dvec3>& GetPositions() const { return this->Positions; }
  const std::vector<glm::dvec3>& GetNormals() const { return this->Normals; }
  const std::vector<Facet>& GetFacets() const { return this->Facets; }
  std::int64_t GetCellId(std::int32_t facet) const
  {
    return this->CellIds[static_cast<std::size_t>(facet)];
  }
  /** True if the surface has no border, so that it has an inside. */
  bool IsClosed() const
  {
    return this->GetPieces().Borders.empty() && this->GetPieces().NonManifoldFacets == 0;
  }
  /** Centroids of the facets. */
  std::vector<glm::dvec3> ComputeCentroids() const;
  /**
   * True if a point, in local coordinates, is on the given side of the surface at any vertex of its
   * facets: on the side of the normals for +1, on the other for -1.
   */
  bool ShowsSide(const glm::dvec3& local, double side) const;
  const MembraneReport& GetReport() const { return this->Report; }
  /** Connected pieces of the surface. */
  const SurfacePieces& GetPieces() const
  {
    return this->HasJoined ? this->Joined.Pieces : this->Given.Pieces;
  }

private:
  double AcceptFacets(const MembraneInput& input);
  void DropDuplicates();
  bool OrientFacets(std::size_t points);
  void JoinNormals(const std::vector<std::int32_t>& target);
  void MoveToLocalOrigin(const MembraneInput& input);
  bool DropFlattened(double leastHeight);
  void TakeGivenNormals(const MembraneInput& input);
  std::size_t ComputeMissingNormals();
  void CompleteNormals(bool areGiven);

  glm::dvec3 Origin{ 0.0 };
  double Radius = 0.0;
  std::vector<glm::dvec3> Positions;
  std::vector<glm::dvec3> Normals;
  std::vector<Facet> Facets;
  std::vector<std::int64_t> CellIds;
  MembraneReport Report;

  /** Facets and their pieces, kept when the shape changes: a deforming membrane keeps both. */
  struct OrientedFacets
  {
    std::vector<Facet> Wound; ///< before the winding was made consistent
    std::vector<Facet> Facets;
    SurfacePieces Pieces;

    void Update(const std::vector<Facet>& wound, std::size_t points);
  };

  OrientedFacets Given;
  OrientedFacets Joined; ///< after coincident vertices were joined; empty if there are none
  bool HasJoined = false;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus::reference
{

/** A mesh in a field of n^2, with lengths in units of its radius. */
struct GradedField
{
  std::vector<Vector3> Points;
  std::vector<std::array<std::int64_t, 4>> Cells;
  /** n^2 of each point. */
  std::vector<double> SquaredIndices;
  /** Factors of the products of weights of the edges 01, 02, 03, 12, 13, 23 of each cell. */
  std::vector<std::array<double, 6>> EdgeTerms;
  /** Faces of one cell each: vertices, whose normal points out of the mesh, and the cell. */
  std::vector<std::array<std::int64_t, 4>> Boundary;
  /** Index outside; with 0, rays pass the boundary in their directions. */
  double OutsideIndex = 0.0;
};

/** A place on a ray, its direction of unit length there, and the optical path up to there. */
struct PlaceOnRay
{
  Vector3 Position{};
  Vector3 Direction{};
  double OpticalPath = 0.0;
};

/**
 * Judges a path of light piece by piece, in extended precision: each piece must be a solution of
 * the ray equation in one cell, from the place at which the piece before has ended to the cell's
 * boundary. So a path is judged even where a field magnifies rounding so much, from cell to cell,
 * that two integrators end at different places.
 *
 * The solution in a cell is a sum of sines and hyperbolic sines along the axes of the second
 * derivatives of n^2. Cells are found by the place alone, not by links.
 */
class GradedPathCheck
{
public:
  explicit GradedPathCheck(GradedField field);

  /** Begins a path outside of the mesh. */
  void Begin(const PlaceOnRay& ray);
  /**
   * Goes on to a place that the path under test has after one cell more, with a gap before it or
   * none. Returns false if no such path exists.
   * @param glides true if the ray may have been taken along a face, to the rounding of positions.
   */
  bool GoTo(const PlaceOnRay& next, bool glides);
  /**
   * Tells that the ray has passed an inverted cell, in which light goes backwards. From then on it
   * may pass over faces on its straight ways: no crossing is certain.
   */
  void PassFold() { this->HasPassedFold = true; }
  /** True if the straight ray from the last place meets the mesh for certain. */
  bool MeetsMesh() const;

private:
  using Real = long double;
  using Vector = std::array<Real, 3>;
  struct Cell
  {
    std::array<Vector, 4> Gradients;
    std::array<Real, 4> Offsets;
    /** Sizes of the gradients. */
    std::array<Real, 4> Steepness;
    /** grad(n^2) / 2 and n^2 at the origin, without the terms of the edges. */
    Vector Force;
    Real Square;
    std::array<Real, 6> Terms;
    /** Length of the longest edge. */
    Real Size;
    /** Cube of the length of the longest edge over six times the volume. */
    Real Slenderness;
    bool IsFlat;
    /** A flat cell's normal; unit length or 0. */
    Vector Normal;
  };
  struct Crossing
  {
    Real Distance;
    /** Error of the distance: that of a place over the angle at which the ray meets the face. */
    Real Error;
    std::int64_t Face;
    bool IsCertain;
  };
  struct Flow;

  Cell MakeCell(std::size_t number) const;
  Vector ForceAt(const Cell& cell, const Vector& place) const;
  Real SquareAt(const Cell& cell, const Vector& place) const;
  std::array<Real, 4> WeightsAt(const Cell& cell, const Vector& place) const;
  bool Contains(const Cell& cell, const Vector& place, Real tolerance) const;
  std::vector<std::int64_t> CellsAround(const std::vector<std::int64_t>& cells) const;
  std::vector<Crossing> FindCrossings() const;
  bool GoThroughCell(std::int64_t number, const PlaceOnRay& from, const PlaceOnRay& next,
    bool glides, bool knowsPath) const;
  PlaceOnRay Enter(const PlaceOnRay& from, const Crossing& crossing) const;
  bool StaysAt(const PlaceOnRay& next);
  bool MatchesDirection(
    const Vector& momentum, const Vector& place, const PlaceOnRay& next, Real tolerance) const;
  bool IsRefracted(const Vector& momentum, const Vector& normal, const Vector& direction,
    Real square, Real side, Real tolerance) const;
  Vector NormalOf(std::int64_t face) const;

  GradedField Field;
  /** Error of the last place. */
  Real LastError;
  std::vector<Cell> Cells;
  std::vector<std::vector<std::int64_t>> CellsOfPoints;
  PlaceOnRay Last;
  bool HasPassedFold = false;
  /** Cells near the last place; none outside. */
  std::vector<std::int64_t> Near;
};

}

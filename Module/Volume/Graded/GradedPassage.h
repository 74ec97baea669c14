// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Way of a ray through one tetrahedron with a linear or quadratic n^2.
 *
 * With a linear n^2 the place is the parabola x + p s + Force s^2 / 2, and each barycentric weight
 * is a quadratic function of s. With a quadratic one, the force is Force + A (place - x) with the
 * constant matrix A of second derivatives over 2, and the place is the power series with the
 * coefficients c_1 = p, c_2 = Force / 2, c_k+2 = A c_k / ((k + 1) (k + 2)): sines, cosines and
 * their hyperbolic kin. It is summed to rounding, so that a ray back takes the same way.
 */
#pragma once

#include "Volume/Graded/GradedCell.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace meniscus
{

/** Where a ray is in its cell. */
struct PlaceInCell
{
  /** Barycentric weights, >= 0, with the sum 1. */
  std::array<double, 4> Weights{};
  /** Face by which the ray has come; -1 for none. */
  int Entry = -1;
};

class GradedPassage
{
public:
  /** Highest order of the power series. */
  static constexpr int HighestOrder = 16;
  /**
   * Largest |A| s^2 of one step. The first terms left out are a share of |A s^2|^8 / 17! of the
   * way, 2^-52; longer ways are divided.
   */
  static constexpr double LargestExponent = 0.7;

  /** Rounding of a sum of a few numbers, relative to the largest of them. */
  static constexpr double Rounding = 0x1p-51;
  /** The error of a step of Newton's method is about the square of the change: this one is the
   * last, relative to the time. */
  static constexpr double LastChange = 0x1p-27;
  /**
   * Longest step of a zigzag in units of the cell. Longer ones are so few that no ray has to glide.
   */
  static constexpr double LongestShare = 1.0 / 64.0;

  /**
   * @param cell, begin must outlive this object.
   * @param momentum in the direction in which the parameter rises.
   * @param isBent false for a straight way.
   */
  GradedPassage(
    const GradedCell& cell, const PlaceInCell& begin, const glm::dvec3& momentum, bool isBent);

  /**
   * Largest height of a zigzag along which a ray glides, in units of the mesh's radius: the
   * rounding of the mesh's positions, within which it is not known where a face is. A ray in a
   * plane of symmetry has a zigzag of that height.
   */
  static constexpr double GlideHeight = 0.5 * TetrahedralMesh::PositionUnit;

  /**
   * Keeps the ray on the face or, for two constraints, on the edge of the cell at which it is and
   * which is nearest to its direction. Returns false if the ray does not zigzag there. A way that
   * is held is a parabola.
   */
  bool Hold(int constraints);

  /**
   * Chooses the face by which the ray leaves the cell, and the time: the face whose weight is the
   * first to fall below 0; of several at the same time, the face of the lowest rank. If the power
   * series does not reach so far, -1 with the time that it reaches; without any way out, -1 with an
   * infinite time.
   * @param step number of the ray's step, a seed.
   * @param atRandom choose among the faces that are reached within the short time: a ray that goes
   *   in circles about an edge or a vertex, without a zigzag, finds its way out so.
   */
  int FindExit(std::int64_t step, bool atRandom, double shortTime, double& time);

  /** Moves to the time that FindExit() has found, or to any time on a straight way. */
  void MoveTo(double time);
  /** Weights where the ray has moved to; the weight of the face (-1 for none) is 0. */
  std::array<double, 4> GetWeights(int face) const;
  /** Momentum there. */
  const glm::dvec3& GetMomentum() const { return this->EndMomentum; }
  /** Way there from the beginning. */
  const glm::dvec3& GetWay() const { return this->EndWay; }
  const GradedCell& GetCell() const { return this->Cell; }
  /** At least the norm of the force's derivative; 0 for a parabola. */
  double GetForceNorm() const { return this->Norm; }
  /** At least the size of the force within a time, which is at most the time of the exit found. */
  double GetLargestForce(double time) const;
  /** Integral of n^2 along the way there, from its value at the beginning. */
  double IntegrateSquare(double square) const;
  /** grad(n^2) / 2 at the beginning, or its component along the faces that hold the ray. */
  const glm::dvec3& GetForce() const { return this->Force; }

private:
  void SetRates();
  void SetFlatRates();
  int ChooseExit(std::int64_t step, bool atRandom, double shortTime, double& time) const;
  double Extend(double time);
  double WeightOfWay(int i) const;
  bool IsFirst(int face, double time) const;
  int SearchExit(double& time) const;
  bool Refine(int face, double& time);
  int FollowCurve(int face, double& time);

  const GradedCell& Cell;
  const PlaceInCell& Begin;
  /** True if the way is a power series beyond the second order. */
  bool IsCurved;
  /** Faces that the ray stays on. */
  std::array<bool, 4> IsHeld{};
  glm::dvec3 Momentum;
  glm::dvec3 Force;
  /** Rates of the weights and halves of their curvatures at the beginning. */
  std::array<double, 4> Rates;
  std::array<double, 4> HalfCurvatures;
  int Order = 2;
  /** At least the norm of the force's derivative. */
  double Norm = 0.0;
  /** Coefficients of the place from the third order on. */
  std::array<glm::dvec3, HighestOrder + 1> Terms;
  /** End of the way: the time, -1 before the first move, the place from the beginning and the
   * momentum. */
  double EndTime = -1.0;
  glm::dvec3 EndWay;
  glm::dvec3 EndMomentum;
};

}

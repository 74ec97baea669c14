// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Division of curved cells for isosurfaces: as accurate as wanted, with few pieces.
#include "DivisionBlock.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Twisted hexahedra with a standing wave that has four of them per wavelength. */
Block MakeTwistedWave()
{
  Block block(6, 0.0, 5);
  block.SetValues(
    [](const glm::dvec3& at)
    {
      constexpr double turn = 3.0 * 3.14159265358979;
      return std::cos(turn * (at.x - 0.5)) * std::cos(turn * (at.y - 0.5)) *
        std::cos(turn * (at.z - 0.5));
    });
  for (std::size_t p = 0; p < block.Points.size(); p += 3)
  {
    double* const at = block.Points.data() + p;
    const double angle = 0.6 * (at[2] - 0.5);
    const double x = at[0];
    at[0] = x * std::cos(angle) - at[1] * std::sin(angle);
    at[1] = x * std::sin(angle) + at[1] * std::cos(angle);
  }
  block.Fields.Points = block.Points.data();
  return block;
}

/** Errors of the surface of one value that is drawn in the pieces. */
struct DrawnSurface
{
  /** Largest distance of the middles of its polygons from the surface, to the first order. */
  double Displacement = 0.0;
  /** Pieces that are inside out. */
  int Turned = 0;
};

DrawnSurface CheckSurface(const CellDivision& division, const Block& block, double value)
{
  CellSampler sampler(block.Fields, block.GetFunctions());
  DrawnSurface found;
  for (const CellPiece& piece : division.GetPieces())
  {
    const auto spanOf = [](const auto& of)
    { return glm::dmat3(of(1) - of(0), of(2) - of(0), of(3) - of(0)); };
    std::array<CellSample, 4> at;
    for (std::size_t i = 0; i < 4; ++i)
    {
      at[i] = sampler.Sample(piece.Cell, piece.Places[i]);
    }
    const auto placeOf = [&](std::size_t i) { return glm::dvec3(piece.Places[i]); };
    const auto pointOf = [&](std::size_t i) { return at[i].Position; };
    found.Turned += glm::determinant(spanOf(placeOf)) * glm::determinant(spanOf(pointOf)) < 0.0;
    glm::dvec3 middle(0.0);
    int corners = 0;
    for (const auto& ends : EdgeEnds)
    {
      const auto from = static_cast<std::size_t>(ends[0]);
      const auto to = static_cast<std::size_t>(ends[1]);
      const double above = at[from].Values[0] - value;
      const double below = value - at[to].Values[0];
      if (above * below > 0.0)
      {
        middle += glm::mix(placeOf(from), placeOf(to), above / (above + below));
        ++corners;
      }
    }
    if (corners < 3)
    {
      continue;
    }
    constexpr double step = 1.0e-5;
    middle /= corners;
    const CellSample here = sampler.Sample(piece.Cell, middle);
    glm::dmat3 span;
    glm::dvec3 change;
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 next = middle;
      next[axis] += step;
      const CellSample there = sampler.Sample(piece.Cell, next);
      span[axis] = there.Position - here.Position;
      change[axis] = there.Values[0] - here.Values[0];
    }
    const double slope = glm::length(glm::inverse(glm::transpose(span)) * change);
    found.Displacement = std::max(found.Displacement, std::abs(here.Values[0] - value) / slope);
  }
  return found;
}

}

// Differences count by the displacement that they cause across the surface, also inside of pieces.
TEST(DividedSurfaces, TakeNoMorePiecesThanTheyNeed)
{
  const Block block = MakeTwistedWave();
  constexpr double value = 0.12;
  // The defaults of pictures: a displacement counts four times as a share of the diagonal, 1.73.
  for (const double share : { 1.0 / 256.0, 1.0e-3 })
  {
    const double tolerance = share * 1.73 / 4.0;
    DivisionLimits limits = LimitsOf(tolerance, 1.0);
    limits.Measure.OfValues.fill(ErrorScale({ { value, 0.0 }, { value, 0.0 }, { value, 256.0 } }));
    limits.Measure.ValuesMayMove = true;
    limits.Measure.HasSurfaces = true;
    CellDivision division;
    ASSERT_EQ(block.Divide(division, limits), DivisionStatus::Ok);
    const DrawnSurface surface = CheckSurface(division, block, value);
    // In the middle of a polygon, at most 3/2 of the largest difference in an edge.
    EXPECT_LE(surface.Displacement, 1.5 * tolerance);
    EXPECT_GE(surface.Displacement, 0.5 * tolerance);
    EXPECT_EQ(surface.Turned, 0);
    // A piece at the surface is as long as a cap of this height allows; the surface has the area of
    // 27 balls with a radius of about a sixth, and a third of the pieces lead to smaller ones.
    EXPECT_LT(static_cast<double>(division.GetCounts().Pieces), 400.0 / share);
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/SubCellBend.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// A function whose second derivatives along a side are `f''` deviates by f'' / 8 at most.
constexpr double OfSecond = 0.125;

// Second derivatives of the terms b_i b_j and b_i b_j (b_i - b_j) along a side.
constexpr double OfSymmetric = 2.0;
constexpr double OfAsymmetric = 6.0;

template <typename Value>
double GetLargestChange(const std::array<Value, 3>& at)
{
  const auto squared = [&at](std::size_t i, std::size_t j)
  {
    const Value change = at[i] - at[j];
    return glm::dot(change, change);
  };
  return std::sqrt(std::max({ squared(0, 1), squared(1, 2), squared(2, 0) }));
}

}

//------------------------------------------------------------------------------
PatchBend::PatchBend(const CurvedPatch& patch, const Media& media)
  : Medium(media)
  , Ratio(media.Exterior / media.Interior)
  , Position(0.0)
  , Normal(0.0)
{
  for (int k = 0; k < 3; ++k)
  {
    this->Position += OfSecond *
      (OfSymmetric * std::fabs(patch.Symmetric[k]) + OfAsymmetric * std::fabs(patch.Asymmetric[k]));
    this->Normal += OfSecond * OfSymmetric * glm::length(patch.Bend[k]);
  }
}

//------------------------------------------------------------------------------
// The ray is R = ratio D + g N with g = ratio c - r, where c and r are the cosines before and
// behind the surface. With the deviations d and changes t of D and N, the deviation of c is dD + dN
// + tD tN / 4, that of g is |g'| times it and |g''| (tD + tN)^2 / 8, with g' = ratio g / r and g''
// = ratio^2 (1 - ratio^2) / r^3, and the product g N adds tg tN / 4. A reflected ray is R = D + 2 c
// N.
SubCellBend PatchBend::Measure(const SubCell& nodes) const
{
  std::array<glm::dvec3, 3> places;
  std::array<glm::dvec3, 3> normals;
  std::array<glm::dvec3, 3> rays;
  double nearest = std::numeric_limits<double>::max();
  double least = 1.0; // cosine behind the surface
  double most = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const RefractedPoint& from = nodes[k].From;
    places[k] = from.At.Position;
    normals[k] = glm::normalize(from.At.Normal);
    rays[k] = from.Ray;
    const double cosine = std::fabs(glm::dot(from.Ray, normals[k]));
    least = std::min(least, cosine);
    most = std::max(most, cosine);
    nearest = std::min(nearest, glm::length(places[k] - this->Medium.Eye));
  }
  const double part = GetLargestChange(std::array{ nodes[0].B, nodes[1].B, nodes[2].B });
  const double squared = 0.5 * part * part; // 1 for the entire patch
  SubCellBend bend;
  bend.Size = GetLargestChange(places);
  bend.Turn = GetLargestChange(rays);
  bend.Position = squared * this->Position;
  const double turnD = bend.Size / nearest;
  const double turnN = GetLargestChange(normals);
  // Along a side the distance from the eye changes by up to the size: twice the arc's share.
  const double sight = 2.0 * OfSecond * turnD * turnD;
  const double normal = squared * this->Normal + 2.0 * OfSecond * turnN * turnN;
  const double cosine = sight + normal + 0.25 * turnD * turnN;
  const double turn = turnD + turnN;
  if (this->Medium.Reflects)
  {
    bend.Direction = sight + 2.0 * (normal + cosine) + 0.5 * turn * turnN;
    return bend;
  }
  const double behind = 0.5 * (least + most);
  const double factor = 1.0 - this->Ratio * this->Ratio;
  const double g = std::fabs(std::sqrt(std::max(least * least - factor, 0.0)) - least);
  const double first = this->Ratio * g / behind;
  const double second = this->Ratio * this->Ratio * std::fabs(factor) / (behind * behind * behind);
  bend.Direction = this->Ratio * sight + g * normal + first * (cosine + 0.25 * turn * turnN) +
    OfSecond * second * turn * turn;
  return bend;
}

}

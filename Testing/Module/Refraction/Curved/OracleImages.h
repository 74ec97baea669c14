// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "HeightField.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "TestBasics.h"

namespace meniscus::test
{

/** Images that were compared, and points with several images, or too close to a caustic. */
struct OracleCounts
{
  int Images = 0;
  int Several = 0;
  int Close = 0;
};

/** True if two images are close to each other, on a caustic, where the number of images changes. */
inline bool HasClosePair(const std::vector<glm::dvec3>& sights, double distance)
{
  for (std::size_t i = 0; i < sights.size(); ++i)
  {
    const auto isNear = [&](const glm::dvec3& other)
    { return glm::length(sights[i] - other) < distance; };
    if (std::any_of(sights.begin(), sights.begin() + static_cast<std::ptrdiff_t>(i), isNear))
    {
      return true;
    }
  }
  return false;
}

/**
 * Expects the images of a point in a mesh of the field with that number of cells to be the field's
 * own. Points closer to a caustic than the distance of the two surfaces may gain or lose a pair of
 * images: such images appear as two close ones of the oracle or of the solver. The others may move
 * by a part of that distance.
 */
inline void ExpectImagesOfTheField(const CurvedMembraneSolver& geometry,
  const reference::HeightField& field, int cells, const glm::dvec3& eye, const glm::dvec3& point,
  OracleCounts& counts)
{
  const auto exact = field.FindSightPoints(eye, point);
  std::vector<VirtualVertex> found;
  geometry.FindImages(point, found);
  std::vector<glm::dvec3> ours;
  for (const VirtualVertex& vertex : found)
  {
    ours.push_back(vertex.SightPoint);
  }
  const double pair = 0.5 * field.Side / cells;
  const bool atBorder = std::any_of(exact.begin(), exact.end(),
    [](const glm::dvec3& s) { return std::max(std::fabs(s.x), std::fabs(s.z)) > 100.0 - 1e-3; });
  if (HasClosePair(exact, pair) || HasClosePair(ours, pair) || atBorder)
  {
    ++counts.Close;
    return;
  }
  const auto where = [&point](::testing::Message message)
  { return message << "point (" << point.x << ", " << point.y << ", " << point.z << ")"; };
  ASSERT_EQ(ours.size(), exact.size()) << where({});
  for (const glm::dvec3& s : exact)
  {
    EXPECT_TRUE(std::any_of(ours.begin(), ours.end(),
      [&s, pair](const glm::dvec3& other) { return glm::length(other - s) < 0.25 * pair; }))
      << where({});
  }
  counts.Images += static_cast<int>(exact.size());
  counts.Several += exact.size() > 1;
}

} // namespace meniscus::test

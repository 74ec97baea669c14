// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Common/CoherentOrder.h"

#include "Common/BlockLoop.h"
#include "Common/FiniteVector.h"
#include "Common/HilbertCurve.h"
#include "Common/MortonOrder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/** Bounding box of finite points, and the sum of the steps from one to the next. */
struct PointExtent
{
  glm::dvec3 Lower{ std::numeric_limits<double>::infinity() };
  glm::dvec3 Upper{ -std::numeric_limits<double>::infinity() };
  double Steps = 0.0;
};

glm::dvec3 PointAt(const double* points, std::size_t i)
{
  return { points[3 * i], points[3 * i + 1], points[3 * i + 2] };
}

PointExtent MeasurePoints(const double* points, std::size_t count, const RangeLoop& loop)
{
  std::vector<PointExtent> parts(NumberOfBlocks(count));
  ForEachBlock(count, loop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      PointExtent part;
      glm::dvec3 before = PointAt(points, first > 0 ? first - 1 : 0);
      for (std::size_t i = first; i < last; ++i)
      {
        const glm::dvec3 point = PointAt(points, i);
        const double step = glm::length(point - before);
        part.Steps += std::isfinite(step) ? step : 0.0;
        if (IsFinite(point))
        {
          part.Lower = glm::min(part.Lower, point);
          part.Upper = glm::max(part.Upper, point);
        }
        before = point;
      }
      parts[block] = part;
    });
  PointExtent all;
  for (const PointExtent& part : parts)
  {
    all.Lower = glm::min(all.Lower, part.Lower);
    all.Upper = glm::max(all.Upper, part.Upper);
    all.Steps += part.Steps;
  }
  return all;
}

}

//------------------------------------------------------------------------------
std::vector<std::uint32_t> FindCoherentOrder(
  const double* points, std::size_t count, const RangeLoop& loop)
{
  std::vector<std::uint32_t> order;
  const PointExtent extent = MeasurePoints(points, count, loop);
  const double number = static_cast<double>(count);
  const double diagonal = glm::length(extent.Upper - extent.Lower);
  if (!(extent.Steps > 2.0 * diagonal * std::cbrt(number * number)) ||
    count > std::numeric_limits<std::uint32_t>::max())
  {
    return order;
  }
  const HilbertCurve curve(extent.Lower, extent.Upper);
  std::vector<MortonKey> keys(count);
  ForEachInBlocks(count, loop,
    [&](std::size_t i)
    {
      const glm::dvec3 point = PointAt(points, i);
      keys[i] = MakeMortonKey(IsFinite(point) ? curve.Code(point) : 0, i);
    });
  SortByCode(keys, loop);
  order.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    order[i] = static_cast<std::uint32_t>(IndexOf(keys[i]));
  }
  return order;
}

}

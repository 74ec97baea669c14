// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Source: C. Hamilton, "Compact Hilbert Indices", Dalhousie University, CS-2006-07, section 2.
#include "Common/HilbertCurve.h"

#include <algorithm>
#include <array>

namespace meniscus
{
namespace
{

/** Octants are numbers of 3 bits, one per axis. A rotation by n moves bit i to bit i + n mod 3. */
std::uint32_t Rotated(std::uint32_t octant, std::uint32_t n)
{
  return ((octant << n) | (octant >> (3 - n))) & 7u;
}

/** Octant that the curve visits as number `i`: neighbours differ in one bit (Gray code). */
std::uint32_t Gray(std::uint32_t i)
{
  return i ^ (i >> 1);
}

/** Inverse of Gray(). */
std::uint32_t NumberOf(std::uint32_t octant)
{
  return octant ^ (octant >> 1) ^ (octant >> 2);
}

/** Corner of the octant visited as number `i` where the curve enters it. */
std::uint32_t EntryOf(std::uint32_t i)
{
  return i == 0 ? 0 : Gray((i - 1) & ~1u);
}

/** Axis from the entry of the octant visited as number `i` to its exit: 3 bits of each `i`. */
std::uint32_t DirectionOf(std::uint32_t i)
{
  constexpr std::uint32_t directions[8] = { 0, 1, 1, 2, 2, 1, 1, 0 };
  return directions[i];
}

/** One step down: the number of an octant, and how the curve passes through it. */
struct Step
{
  std::uint8_t Number;
  std::uint8_t Next;
};
/** By the way through a cube, 3 * entry + direction, and octant. */
using StepTable = std::array<std::array<Step, 8>, 24>;

StepTable MakeSteps()
{
  StepTable steps{};
  for (std::uint32_t way = 0; way < steps.size(); ++way)
  {
    const std::uint32_t entry = way / 3;
    // The curve of this cube is the standard one, turned by its direction and reflected at entry.
    const std::uint32_t turn = (way % 3 + 1) % 3;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
    {
      const std::uint32_t number = NumberOf(Rotated(octant ^ entry, 3 - turn));
      const std::uint32_t nextEntry = entry ^ Rotated(EntryOf(number), turn);
      const std::uint32_t nextDirection = (turn + DirectionOf(number)) % 3;
      steps[way][octant] = { static_cast<std::uint8_t>(number),
        static_cast<std::uint8_t>(3 * nextEntry + nextDirection) };
    }
  }
  return steps;
}

}

//------------------------------------------------------------------------------
std::uint32_t HilbertCode(const std::uint32_t (&cell)[3])
{
  static const StepTable steps = MakeSteps();
  std::uint32_t way = 0;
  std::uint32_t code = 0;
  for (int bit = HilbertCurve::BitsPerAxis - 1; bit >= 0; --bit)
  {
    const std::uint32_t octant =
      (cell[0] >> bit & 1u) | (cell[1] >> bit & 1u) << 1 | (cell[2] >> bit & 1u) << 2;
    const Step& step = steps[way][octant];
    code = code << 3 | step.Number;
    way = step.Next;
  }
  return code;
}

//------------------------------------------------------------------------------
HilbertCurve::HilbertCurve(const glm::dvec3& lower, const glm::dvec3& upper)
  : Lower(lower)
{
  const glm::dvec3 extent = upper - lower;
  const double longest = std::max({ extent.x, extent.y, extent.z });
  this->CellsPerUnit = longest > 0.0 ? (1 << BitsPerAxis) / longest : 0.0;
}

//------------------------------------------------------------------------------
std::uint32_t HilbertCurve::Code(const glm::dvec3& position) const
{
  constexpr double lastCell = (1 << BitsPerAxis) - 1;
  std::uint32_t cell[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = (position[axis] - this->Lower[axis]) * this->CellsPerUnit;
    // NaN, from boxes whose length or scale is beyond the range of double, becomes 0.
    cell[axis] = static_cast<std::uint32_t>(std::min(std::max(0.0, place), lastCell));
  }
  return HilbertCode(cell);
}

}

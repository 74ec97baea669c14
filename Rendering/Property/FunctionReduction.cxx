// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/PropertyFunction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace meniscus
{
namespace
{

/** Largest accepted deviation of linear interpolation, in colour and in alpha per unit distance. */
constexpr double SamplingBound = 1.0 / 32768.0;
/** Halvings of an interval: 2^12 samples resolve a unit step of a smooth function to the bound. */
constexpr int MaximumHalvings = 12;

/**
 * Smaller jumps cannot be distinguished from the change of a continuous function between adjacent
 * doubles.
 */
constexpr double SmallestJump = 1.0 / 1073741824.0;

/**
 * Halvings of an interval that tables hold, in the order in which they are tried: 8 pieces show
 * whether a piece is straight, and the last resolves the deepest pieces to be tested.
 */
constexpr int TableHalvings[] = { 3, 8, 14 };
/** The only table where each table has a high cost. */
constexpr int CostlyHalvings[] = { MaximumHalvings };

TransferFunctionPoint Interpolate(
  const TransferFunctionPoint& a, const TransferFunctionPoint& b, double fraction)
{
  return { a.Scalar + fraction * (b.Scalar - a.Scalar),
    a.Attenuation + fraction * (b.Attenuation - a.Attenuation),
    a.Color + fraction * (b.Color - a.Color) };
}

/** Chooses the entries of a table between which the function is straight. */
class TableReduction
{
public:
  TableReduction(
    const PropertyFunction& function, const std::vector<TransferFunctionPoint>& table, bool isLast)
    : Function(function)
    , Table(table)
    , IsLast(isLast)
  {
  }

  /**
   * Collects the entries strictly between the ends. Returns false if the table is too coarse to
   * tell; never for the last table.
   */
  bool Run(std::vector<TransferFunctionPoint>& points)
  {
    return this->Refine(0, this->Table.size() - 1, MaximumHalvings, points);
  }

private:
  /** True if the entries at the eighths between two entries are on the straight line. */
  bool IsStraight(std::size_t first, std::size_t last) const
  {
    const std::size_t width = last - first;
    const double range = this->Table[last].Scalar - this->Table[first].Scalar;
    for (std::size_t eighths = 1; eighths < 8; ++eighths)
    {
      if (eighths * width % 8 != 0)
      {
        continue;
      }
      const TransferFunctionPoint& entry = this->Table[first + eighths * width / 8];
      const TransferFunctionPoint onLine = Interpolate(
        this->Table[first], this->Table[last], (entry.Scalar - this->Table[first].Scalar) / range);
      // False for NaN.
      if (!(this->Function.Difference(entry, onLine) < SamplingBound))
      {
        return false;
      }
    }
    return true;
  }

  bool Refine(
    std::size_t first, std::size_t last, int halvings, std::vector<TransferFunctionPoint>& points)
  {
    const std::size_t width = last - first;
    if (halvings == 0 || width < 2)
    {
      return true;
    }
    if (width < 8 && !this->IsLast)
    {
      return false;
    }
    if (this->IsStraight(first, last))
    {
      return true;
    }
    const std::size_t middle = first + width / 2;
    if (!this->Refine(first, middle, halvings - 1, points))
    {
      return false;
    }
    points.push_back(this->Table[middle]);
    return this->Refine(middle, last, halvings - 1, points);
  }

  const PropertyFunction& Function;
  const std::vector<TransferFunctionPoint>& Table;
  bool IsLast;
};

/** The function between two nodes: its limits there and the points between them. */
struct Stretch
{
  TransferFunctionPoint First;
  TransferFunctionPoint Last;
  std::vector<TransferFunctionPoint> Between;
};

/**
 * Finds a table whose scalars are all between two nodes, as close to both as its rounding permits.
 * Returns false if there is none.
 */
bool FindRange(
  const PropertyFunction& function, double node, double next, double& first, double& last)
{
  first = std::nextafter(node, HUGE_VAL);
  double away = first - node;
  while (!(function.GetSampledScalar(first, first, 1, 0) > node))
  {
    away *= 2.0;
    first = node + away;
    if (!(first < next))
    {
      return false;
    }
  }
  last = std::nextafter(next, -HUGE_VAL);
  away = next - last;
  while (last >= first && !(function.GetSampledScalar(first, last, 2, 1) < next))
  {
    away *= 2.0;
    last = next - away;
  }
  return last >= first;
}

/** The value next to an end of the nodes, on the side of `direction`: -1 or 1. */
TransferFunctionPoint SampleOutside(const PropertyFunction& function, double node, double direction)
{
  double outside = std::nextafter(node, direction * HUGE_VAL);
  double away = std::abs(outside - node);
  while (!(direction * function.GetSampledScalar(outside, outside, 1, 0) > direction * node) &&
    std::isfinite(outside))
  {
    away *= 2.0;
    outside = node + direction * away;
  }
  return function.Sample(outside, outside, 1).front();
}

/** Removes points that equal both neighbours, as between the steps of a staircase. */
void RemoveRepetitions(Stretch& stretch)
{
  const auto equal = [](const TransferFunctionPoint& a, const TransferFunctionPoint& b)
  { return a.Attenuation == b.Attenuation && a.Color == b.Color; };
  std::vector<TransferFunctionPoint> kept;
  for (std::size_t i = 0; i < stretch.Between.size(); ++i)
  {
    const TransferFunctionPoint& point = stretch.Between[i];
    const TransferFunctionPoint& before = i > 0 ? stretch.Between[i - 1] : stretch.First;
    const TransferFunctionPoint& after =
      i + 1 < stretch.Between.size() ? stretch.Between[i + 1] : stretch.Last;
    if (!equal(point, before) || !equal(point, after))
    {
      kept.push_back(point);
    }
  }
  stretch.Between = std::move(kept);
}

/** Returns false if no scalar between the nodes can be sampled, or if their distance is no number.
 */
bool Follow(const PropertyFunction& function, double node, double next, Stretch& stretch)
{
  if (!std::isfinite(next - node))
  {
    // VTK's tables are wrong between such nodes.
    return false;
  }
  double first = node;
  double last = next;
  if (!FindRange(function, node, next, first, last))
  {
    return false;
  }
  const bool costly = function.HasCostlyCalls();
  const int* begin = costly ? std::begin(CostlyHalvings) : std::begin(TableHalvings);
  const int* end = costly ? std::end(CostlyHalvings) : std::end(TableHalvings);
  for (const int* halvings = begin; halvings != end; ++halvings)
  {
    const std::vector<TransferFunctionPoint> table =
      function.Sample(first, last, (1 << *halvings) + 1);
    stretch.First = table.front();
    stretch.Last = table.back();
    stretch.Between.clear();
    if (TableReduction(function, table, halvings + 1 == end).Run(stretch.Between))
    {
      break;
    }
  }
  RemoveRepetitions(stretch);
  return true;
}

/**
 * Where only few numbers lie between two nodes, the samples next to them are no limits. The values
 * of the nodes are, and the samples are points between them.
 */
void TakeNodesAsLimits(const FunctionNode& node, const FunctionNode& next, Stretch& stretch)
{
  const double width = next.Scalar - node.Scalar;
  const double away =
    std::max(stretch.First.Scalar - node.Scalar, next.Scalar - stretch.Last.Scalar);
  if (away <= SamplingBound * width)
  {
    return;
  }
  stretch.Between.insert(stretch.Between.begin(), stretch.First);
  if (stretch.First.Scalar < stretch.Last.Scalar)
  {
    stretch.Between.push_back(stretch.Last);
  }
  stretch.First = node.Values.back();
  stretch.Last = next.Values.front();
}

/** The value of a node where the limit is that, but for rounding; otherwise the limit. */
TransferFunctionPoint Settle(
  const PropertyFunction& function, const FunctionNode& node, TransferFunctionPoint limit)
{
  for (const TransferFunctionPoint& value : node.Values)
  {
    if (function.Difference(value, limit) <= SmallestJump)
    {
      return value;
    }
  }
  limit.Scalar = node.Scalar;
  return limit;
}

}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> ReduceToPoints(const PropertyFunction& function)
{
  const std::vector<FunctionNode> nodes = function.GetNodes();
  std::vector<TransferFunctionPoint> points;
  if (nodes.empty())
  {
    return points;
  }
  TransferFunctionPoint below = SampleOutside(function, nodes.front().Scalar, -1.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    Stretch stretch;
    TransferFunctionPoint& above = stretch.First;
    if (i + 1 == nodes.size())
    {
      above = SampleOutside(function, nodes[i].Scalar, 1.0);
    }
    else if (!Follow(function, nodes[i].Scalar, nodes[i + 1].Scalar, stretch))
    {
      stretch.Between.clear();
      above = nodes[i].Values.back();
      stretch.Last = nodes[i + 1].Values.front();
    }
    else
    {
      TakeNodesAsLimits(nodes[i], nodes[i + 1], stretch);
    }
    const bool jump = function.Difference(below, above) > SmallestJump;
    points.push_back(Settle(function, nodes[i], below));
    if (jump)
    {
      points.push_back(Settle(function, nodes[i], above));
    }
    points.insert(points.end(), stretch.Between.begin(), stretch.Between.end());
    below = stretch.Last;
  }
  return points;
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/StackImages/SightSheet.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace meniscus
{

/** Divides one patch of a sheet. */
class SightSheet::Builder
{
public:
  Builder(const SightSheet& sheet, std::int32_t facet, Patch& patch)
    : Sheet(sheet)
    , Stack(sheet.Solver.GetStack())
    , Facet(facet)
    , Result(patch)
    , Links(static_cast<int>(sheet.Links))
  {
    const RefractionStack::Link& link = this->Stack.GetLinks().front();
    patch.Surface = link.Surface->GetPatch(facet, !link.Passage.FromFront);
    this->Near = sheet.Borders.FindNear(sheet.Solver.GetBeams(), facet);
  }

  /** Divides the patch into cells, and bounds their rays. */
  void Run();

private:
  static constexpr std::int32_t NotSplit = -1;

  const Node& Get(std::int32_t node) const
  {
    return this->Result.Nodes[static_cast<std::size_t>(node)];
  }

  std::size_t GetRay(std::int32_t node, std::size_t leg) const
  {
    return static_cast<std::size_t>(node) * (this->Sheet.Links + 1) + leg;
  }

  const glm::dvec3& GetPoint(std::int32_t node, int leg) const
  {
    return this->Result.Points[this->GetRay(node, static_cast<std::size_t>(leg))];
  }

  /** @{ */
  /** Nodes and sides: SightSheetSides.cxx. */
  int Trace(const glm::dvec2& b, StackPath& path) const;
  std::int32_t Add(const glm::dvec2& b);
  std::int32_t Add(const glm::dvec2& b, const StackPath& path, int legs);
  int GetLegs(std::int32_t node, std::int32_t other) const;
  std::int32_t Split(std::int32_t a, std::int32_t b);
  std::int32_t FindSplit(std::int32_t a, std::int32_t b);
  double GetAngle(const glm::dvec2& a, const glm::dvec2& b) const;
  bool IsLong(const glm::dvec2& a, const glm::dvec2& b, double least) const;
  bool IsWide(std::int32_t a, std::int32_t b) const;
  RefractedPoint GetFrom(std::int32_t node, std::size_t leg) const;
  std::int32_t SplitAtBorders(std::int32_t a, std::int32_t b, int legs);
  double GetDepth(const std::array<std::int32_t, 3>& nodes, const glm::dvec2& place) const;
  int FindCorner(const std::array<std::int32_t, 3>& nodes, const std::vector<int>& tried,
    glm::dvec2& place) const;
  std::int32_t AddCorner(const std::array<std::int32_t, 3>& nodes);
  std::int32_t AddNear(const StackPath& at);
  std::int32_t FindLimit(std::int32_t seen, std::int32_t other, int legs);
  bool IsOffLimit(std::int32_t a, std::int32_t b, double at, int legs) const;
  bool IsBent(std::int32_t a, std::int32_t b, double low, double high, const StackPath& path,
    int legs, int depth) const;
  /** @} */

  bool MayPassMore(const Cell& cell, int depth) const;
  void Divide(std::size_t index, int depth);

  using Triangles = std::vector<std::array<std::int32_t, 3>>;
  void AddChildren(std::size_t index, const Triangles& children, int depth);
  void BoundCell(const LegCell& cell, bool isLast, TubeBounds& rays, AxisBox& ends) const;
  void BoundCells();

  const SightSheet& Sheet;
  const RefractionStack& Stack;
  std::int32_t Facet;
  Patch& Result;
  int Links;
  std::unordered_map<std::uint64_t, std::int32_t> Sides;
  SightBorders::Borders Near; ///< borders that the patch may show
  std::vector<double> Crossings;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PatchSearch.h"

namespace meniscus::test
{

namespace
{

// Samples along a side of a facet, with one more beyond each border.
constexpr int Cells = 16;
constexpr int Nodes = Cells + 3;

glm::dvec2 NodeAt(int i, int j)
{
  return { static_cast<double>(i - 1) / Cells, static_cast<double>(j - 1) / Cells };
}

double Cross(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

} // anonymous namespace

//------------------------------------------------------------------------------
// n1 a / |a| - n2 p / |p|, whose part along the surface vanishes (Fermat).
glm::dvec3 PatchSearch::Misfit(const PatchPoint& at, const glm::dvec3& point) const
{
  return this->Exterior * glm::normalize(at.Position - this->Eye) -
    this->Interior * glm::normalize(point - at.Position);
}

//------------------------------------------------------------------------------
glm::dvec2 PatchSearch::GetEquation(
  const CurvedPatch& patch, const glm::dvec3& point, const glm::dvec2& b) const
{
  const PatchPoint at = patch.Evaluate(b);
  const glm::dvec3 normal = glm::normalize(at.Normal);
  const glm::dvec3 v = this->Misfit(at, point);
  const glm::dvec3 along = v - normal * glm::dot(v, normal);
  return { glm::dot(along, glm::normalize(patch.Corner[1] - patch.Corner[0])),
    glm::dot(along, glm::normalize(patch.Corner[2] - patch.Corner[0])) };
}

//------------------------------------------------------------------------------
bool PatchSearch::Solve(
  const CurvedPatch& patch, const glm::dvec3& point, glm::dvec2& b, double& condition) const
{
  constexpr double h = 1e-6;
  const glm::dvec2 start = b;
  for (int i = 0; i < 40; ++i)
  {
    const glm::dvec2 f = this->GetEquation(patch, point, b);
    const glm::dvec2 fx = (this->GetEquation(patch, point, b + glm::dvec2(h, 0.0)) -
                            this->GetEquation(patch, point, b - glm::dvec2(h, 0.0))) /
      (2.0 * h);
    const glm::dvec2 fy = (this->GetEquation(patch, point, b + glm::dvec2(0.0, h)) -
                            this->GetEquation(patch, point, b - glm::dvec2(0.0, h))) /
      (2.0 * h);
    const double determinant = Cross(fx, fy);
    condition = std::fabs(determinant) / (glm::length(fx) * glm::length(fy));
    const glm::dvec2 step(-Cross(f, fy) / determinant, -Cross(fx, f) / determinant);
    b += step;
    if (!(glm::length(b - start) < 4.0 / Cells))
    {
      return false;
    }
    if (glm::length(step) < 1e-11)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void PatchSearch::SearchImages(
  std::int32_t facet, const glm::dvec3& point, std::vector<Sight>& found) const
{
  const CurvedPatch patch = this->Patches.GetPatch(facet);
  std::array<glm::dvec2, Nodes * Nodes> values;
  for (int j = 0; j < Nodes; ++j)
  {
    for (int i = 0; i < Nodes - j + 2 && i < Nodes; ++i)
    {
      values[static_cast<std::size_t>(j * Nodes + i)] =
        this->GetEquation(patch, point, NodeAt(i, j));
    }
  }
  for (int j = 1; j <= Cells; ++j)
  {
    for (int i = 1; i + j <= Cells + 1; ++i)
    {
      // Values at the nodes of the cell and around it: at a root in the cell the values hardly
      // exceed their range.
      glm::dvec2 low(std::numeric_limits<double>::max());
      glm::dvec2 high(std::numeric_limits<double>::lowest());
      for (int n = 0; n < 16; ++n)
      {
        const int column = i - 1 + n % 4;
        const int row = j - 1 + n / 4;
        if (row < Nodes && column < Nodes - row + 2 && column < Nodes)
        {
          const glm::dvec2& v = values[static_cast<std::size_t>(row * Nodes + column)];
          low = glm::dvec2(std::min(low.x, v.x), std::min(low.y, v.y));
          high = glm::dvec2(std::max(high.x, v.x), std::max(high.y, v.y));
        }
      }
      if (low.x > 0.0 || low.y > 0.0 || high.x < 0.0 || high.y < 0.0)
      {
        continue;
      }
      glm::dvec2 b = NodeAt(i, j) + glm::dvec2(0.4 / Cells);
      double condition = 0.0;
      if (!this->Solve(patch, point, b, condition))
      {
        continue;
      }
      const PatchPoint at = patch.Evaluate(b);
      const glm::dvec3 normal = glm::normalize(at.Normal);
      const double facing = std::min(-glm::dot(glm::normalize(at.Position - this->Eye), normal),
        -glm::dot(glm::normalize(point - at.Position), normal));
      const double inside = FindOutside(b).Least;
      // Where the normal lies in the facet's plane, the two components may vanish although the
      // third does not.
      const glm::dvec3 v = this->Misfit(at, point);
      const bool isRoot =
        glm::length(v - normal * glm::dot(v, normal)) < 1e-8 * (this->Exterior + this->Interior);
      const bool known = std::any_of(found.begin(), found.end(),
        [&at, &patch](const Sight& other)
        {
          return glm::length(other.Place - at.Position) <
            1e-6 * glm::length(patch.Corner[1] - patch.Corner[0]);
        });
      if (!known && isRoot && inside >= 0.0 && facing > 0.0 &&
        glm::length(at.Normal) > CurvedPatch::ShortestNormal)
      {
        found.push_back({ at.Position, condition, inside, facing, facet });
      }
    }
  }
}

//------------------------------------------------------------------------------
std::vector<PatchSearch::Sight> PatchSearch::Find(const glm::dvec3& point) const
{
  std::vector<Sight> found;
  for (std::size_t facet = 0; facet < this->Facets; ++facet)
  {
    this->SearchImages(static_cast<std::int32_t>(facet), point, found);
  }
  return found;
}

//------------------------------------------------------------------------------
double PatchSearch::Residual(
  const glm::dvec3& point, const glm::dvec3& place, std::int32_t facet) const
{
  // The nearest place on the patch, by finite differences.
  const CurvedPatch patch = this->Patches.GetPatch(facet);
  glm::dvec2 b(1.0 / 3.0);
  for (int i = 0; i < 30; ++i)
  {
    const PatchPoint at = patch.Evaluate(b);
    constexpr double h = 1e-6;
    const glm::dvec3 u = (patch.Evaluate(b + glm::dvec2(h, 0.0)).Position - at.Position) / h;
    const glm::dvec3 v = (patch.Evaluate(b + glm::dvec2(0.0, h)).Position - at.Position) / h;
    const glm::dvec3 rest = place - at.Position;
    const double uu = glm::dot(u, u);
    const double uv = glm::dot(u, v);
    const double vv = glm::dot(v, v);
    const double determinant = uu * vv - uv * uv;
    b += glm::dvec2((vv * glm::dot(u, rest) - uv * glm::dot(v, rest)) / determinant,
      (uu * glm::dot(v, rest) - uv * glm::dot(u, rest)) / determinant);
  }
  const PatchPoint at = patch.Evaluate(b);
  const double away =
    glm::length(at.Position - place) / glm::length(patch.Corner[1] - patch.Corner[0]);
  const glm::dvec3 normal = glm::normalize(at.Normal);
  const glm::dvec3 v = this->Misfit(at, point);
  return away + glm::length(v - normal * glm::dot(v, normal)) / (this->Exterior + this->Interior) +
    std::max(0.0, -FindOutside(b).Least);
}

} // namespace meniscus::test

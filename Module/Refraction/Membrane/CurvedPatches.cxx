// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Membrane/CurvedPatches.h"

#include "Common/GroupedItems.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// cos 60 degrees: limit of the angle between the normals at the two ends of an edge. A cubic
// approximates a longer arc badly.
constexpr double SmoothCosine = 0.5;

// sin 30 degrees: lean of a normal along an edge that is an arc of 60 degrees.
constexpr double LargestLean = 0.5;

// Largest deflection of the normal at the middle of an edge: 5.7 degrees away from linear
// interpolation. On a mesh that resolves its surface the deflection is the square of the angle per
// facet over eight, which is far smaller.
constexpr double LargestDeflection = 0.1;

// A regular vertex has six neighbours; five give ten equations for the seven unknowns.
constexpr std::size_t FewNeighbours = 5;

// Determinant of the normal equations, scaled to diagonals of 1, below which they are singular. The
// smallest eigenvalue of n such equations is at least (1 - 1 / n)^(n - 1) > 0.36 of the
// determinant. Cholesky's method is exact for equations that differ from the given ones by a few
// times 2^-53, so half of the digits are right above this, and singular equations are far below it
// in any frame. (A single pivot is not: after a pivot that is small by the choice of the frame, the
// next ones are rounding.)
constexpr double SmallestDeterminant = 0x1p-26;

constexpr int Unknowns = 7;
using Matrix = double[Unknowns][Unknowns];

glm::dvec3 Apply(const std::array<double, 6>& w, const glm::dvec3& e)
{
  return { w[0] * e.x + w[1] * e.y + w[2] * e.z, w[1] * e.x + w[3] * e.y + w[4] * e.z,
    w[2] * e.x + w[4] * e.y + w[5] * e.z };
}

// Solves the leading `size` equations by Cholesky's method, in place. Equation j and its unknown
// are scaled by the root of scale[j] for the determinant. False if singular.
bool SolveSymmetric(Matrix& a, const double* scale, double* x, int size)
{
  double determinant = 1.0;
  for (int j = 0; j < size; ++j)
  {
    double pivot = a[j][j];
    for (int k = 0; k < j; ++k)
    {
      pivot -= a[j][k] * a[j][k];
    }
    determinant *= scale[j] * pivot;
    if (!(pivot > 0.0))
    {
      return false;
    }
    const double inverse = 1.0 / std::sqrt(pivot);
    a[j][j] = inverse;
    for (int i = j + 1; i < size; ++i)
    {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k)
      {
        sum -= a[i][k] * a[j][k];
      }
      a[i][j] = sum * inverse;
    }
    double right = x[j];
    for (int k = 0; k < j; ++k)
    {
      right -= a[j][k] * x[k];
    }
    x[j] = right * inverse;
  }
  if (!(determinant > SmallestDeterminant))
  {
    return false;
  }
  for (int j = size; j-- > 0;)
  {
    for (int i = j + 1; i < size; ++i)
    {
      x[j] -= a[i][j] * x[i];
    }
    x[j] *= a[j][j];
  }
  return true;
}

/**
 * Least squares for (nx, ny) = gradient of a x^2/2 + b xy + c y^2/2 + d x^3/3 + e x^2 y + f x y^2
 * + g y^3/3. All normal equations are moments of the neighbours' places.
 */
class GradientFit
{
public:
  void Add(double x, double y, double nx, double ny)
  {
    const double xx = x * x;
    const double xy = x * y;
    const double yy = y * y;
    const double weight = 1.0 / (xx + yy);
    const double wxx = weight * xx;
    const double wxy = weight * xy;
    const double wyy = weight * yy;
    this->Second[0] += wxx;
    this->Second[1] += wxy;
    this->Second[2] += wyy;
    this->Third[0] += wxx * x;
    this->Third[1] += wxx * y;
    this->Third[2] += wyy * x;
    this->Third[3] += wyy * y;
    this->Fourth[0] += wxx * xx;
    this->Fourth[1] += wxx * xy;
    this->Fourth[2] += wxx * yy;
    this->Fourth[3] += wyy * xy;
    this->Fourth[4] += wyy * yy;
    nx *= weight;
    ny *= weight;
    this->Right[0] += nx * x;
    this->Right[1] += nx * y + ny * x;
    this->Right[2] += ny * y;
    this->Right[3] += nx * xx;
    this->Right[4] += 2.0 * nx * xy + ny * xx;
    this->Right[5] += nx * yy + 2.0 * ny * xy;
    this->Right[6] += ny * yy;
  }

  /**
   * Sets x to the solution of the whole. False if it is singular, and sometimes if it is not: all
   * equations have one scale here, which no choice of the frame changes, while the determinant is
   * largest with diagonals of 1.
   */
  bool SolveInAnyFrame(double* x) const
  {
    // Coordinates in which a rotation of the frame is orthogonal: second and third derivatives are
    // symmetric tensors, b stands for two of their components, e and f for three.
    constexpr double inverseCount[Unknowns] = { 1.0, 0.5, 1.0, 1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 };
    Matrix matrix;
    this->Fill(matrix);
    double trace = 0.0;
    for (int j = 0; j < Unknowns; ++j)
    {
      trace += inverseCount[j] * matrix[j][j];
    }
    double scale[Unknowns];
    for (int j = 0; j < Unknowns; ++j)
    {
      scale[j] = inverseCount[j] * (Unknowns / trace);
    }
    std::copy(this->Right, this->Right + Unknowns, x);
    return SolveSymmetric(matrix, scale, x, Unknowns);
  }

  /**
   * Sets x to the solution, or, if that is singular, a, b and c to that of second degree; false if
   * not even this is determined. The decision depends on the frame, which must be that of the
   * neighbours themselves.
   */
  bool SolveInOwnFrame(double* x) const
  {
    for (const int size : { Unknowns, 3 })
    {
      Matrix matrix;
      this->Fill(matrix);
      double scale[Unknowns];
      for (int j = 0; j < size; ++j)
      {
        scale[j] = 1.0 / matrix[j][j];
      }
      std::copy(this->Right, this->Right + Unknowns, x);
      if (SolveSymmetric(matrix, scale, x, size))
      {
        return true;
      }
    }
    return false;
  }

private:
  // Fills the lower triangle.
  void Fill(Matrix& m) const
  {
    const double* s = this->Second;
    const double* t = this->Third;
    const double* f = this->Fourth;
    const double lower[] = { s[0],                                                       //
      s[1], s[0] + s[2],                                                                 //
      0.0, s[1], s[2],                                                                   //
      t[0], t[1], 0.0, f[0],                                                             //
      2.0 * t[1], 2.0 * t[2] + t[0], t[1], 2.0 * f[1], 4.0 * f[2] + f[0],                //
      t[2], t[3] + 2.0 * t[1], 2.0 * t[2], f[2], 2.0 * (f[3] + f[1]), f[4] + 4.0 * f[2], //
      0.0, t[2], t[3], 0.0, f[2], 2.0 * f[3], f[4] };
    const double* from = lower;
    for (int i = 0; i < Unknowns; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        m[i][j] = *from++;
      }
    }
  }

  double Second[3] = {}; ///< x2, xy, y2
  double Third[4] = {};  ///< x3, x2y, xy2, y3
  double Fourth[5] = {}; ///< x4, x3y, x2y2, xy3, y4
  double Right[Unknowns] = {};
};

/** Two directions across a unit normal and each other. */
struct TangentFrame
{
  glm::dvec3 First;
  glm::dvec3 Second;

  explicit TangentFrame(const glm::dvec3& normal)
  {
    const int axis = std::fabs(normal.x) < 0.6 ? 0 : 1;
    glm::dvec3 aside(0.0);
    aside[axis] = 1.0;
    this->First = glm::normalize(aside - normal * normal[axis]);
    this->Second = glm::cross(normal, this->First);
  }

  /** Turns to the principal axes of points with the sums xx, xy and yy. */
  void TurnToAxes(const glm::dvec3& moments)
  {
    const double angle = 0.5 * std::atan2(2.0 * moments.y, moments.x - moments.z);
    const glm::dvec3 first = this->First;
    this->First = std::cos(angle) * first + std::sin(angle) * this->Second;
    this->Second = std::cos(angle) * this->Second - std::sin(angle) * first;
  }
};

}

//------------------------------------------------------------------------------
void CurvedPatches::Build(const Membrane& membrane, const RangeLoop& loop)
{
  this->Surface = &membrane;
  this->Patches.assign(membrane.GetFacets().size(), Patch());
  for (std::size_t i = 0; i < this->Patches.size(); ++i)
  {
    const auto& neighbours = membrane.GetPieces().Neighbours[i];
    std::copy(
      membrane.GetFacets()[i].begin(), membrane.GetFacets()[i].end(), this->Patches[i].Vertex);
    std::copy(neighbours.begin(), neighbours.end(), this->Patches[i].Neighbour);
  }
  this->FindRings();
  this->AddSecondRings();
  this->Refit(loop);
}

//------------------------------------------------------------------------------
void CurvedPatches::Refit(const RangeLoop& loop)
{
  this->Curvature.resize(this->Surface->GetPositions().size());
  ForEachItem(this->Curvature.size(), loop,
    [this](std::size_t i)
    { this->Curvature[i] = this->FitCurvature(static_cast<std::int32_t>(i)); });
  ForEachItem(
    this->Patches.size(), loop, [this](std::size_t i) { this->FitFacet(this->Patches[i]); });
}

//------------------------------------------------------------------------------
// Finds the neighbours of each vertex, the vertices that share a facet with it, in the order of
// their indices.
void CurvedPatches::FindRings()
{
  const std::size_t count = this->Surface->GetPositions().size();
  GroupedItems rings;
  rings.Set(count,
    [this](const auto& visit)
    {
      for (const Patch& patch : this->Patches)
      {
        for (int k = 0; k < 3; ++k)
        {
          const auto vertex = static_cast<std::size_t>(patch.Vertex[k]);
          visit(vertex, patch.Vertex[(k + 1) % 3]);
          visit(vertex, patch.Vertex[(k + 2) % 3]);
        }
      }
    });
  this->RingStart.assign(1, 0);
  this->Ring.clear();
  this->Ring.reserve(3 * this->Patches.size() + count);
  std::vector<std::int32_t> ring;
  for (std::size_t i = 0; i < count; ++i)
  {
    ring.assign(rings[i].begin(), rings[i].end());
    std::sort(ring.begin(), ring.end());
    this->Ring.insert(this->Ring.end(), ring.begin(), std::unique(ring.begin(), ring.end()));
    this->RingStart.push_back(static_cast<std::int32_t>(this->Ring.size()));
  }
}

//------------------------------------------------------------------------------
// For vertices of borders and vertices with few neighbours, also adds the neighbours of these.
void CurvedPatches::AddSecondRings()
{
  const std::size_t count = this->RingStart.size() - 1;
  std::vector<bool> border(count, false);
  for (const Patch& patch : this->Patches)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (patch.Neighbour[k] == NoFacet)
      {
        border[static_cast<std::size_t>(patch.Vertex[(k + 1) % 3])] = true;
        border[static_cast<std::size_t>(patch.Vertex[(k + 2) % 3])] = true;
      }
    }
  }
  const std::vector<std::int32_t> start = this->RingStart;
  const std::vector<std::int32_t> ring = this->Ring;
  const auto append = [&start, &ring](std::vector<std::int32_t>& to, std::size_t vertex)
  { to.insert(to.end(), ring.begin() + start[vertex], ring.begin() + start[vertex + 1]); };
  this->Ring.clear();
  std::vector<std::int32_t> all;
  for (std::size_t i = 0; i < count; ++i)
  {
    all.clear();
    append(all, i);
    const std::size_t first = all.size();
    if (first > 0 && (border[i] || first < FewNeighbours))
    {
      for (std::size_t k = 0; k < first; ++k)
      {
        append(all, static_cast<std::size_t>(all[k]));
      }
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      all.erase(std::find(all.begin(), all.end(), static_cast<std::int32_t>(i)));
    }
    this->Ring.insert(this->Ring.end(), all.begin(), all.end());
    this->RingStart[i + 1] = static_cast<std::int32_t>(this->Ring.size());
  }
}

//------------------------------------------------------------------------------
bool CurvedPatches::IsSmooth(std::int32_t from, std::int32_t to) const
{
  const auto i = static_cast<std::size_t>(from);
  const auto j = static_cast<std::size_t>(to);
  const glm::dvec3& a = this->Surface->GetNormals()[i];
  const glm::dvec3& b = this->Surface->GetNormals()[j];
  const glm::dvec3 edge = this->Surface->GetPositions()[j] - this->Surface->GetPositions()[i];
  const double limit = LargestLean * LargestLean * glm::dot(edge, edge);
  const double first = glm::dot(edge, a);
  const double second = glm::dot(edge, b);
  return glm::dot(a, b) >= SmoothCosine && first * first <= limit && second * second <= limit;
}

//------------------------------------------------------------------------------
// Calls `visit(edge, normal)` for the neighbours that the surface is smooth to.
template <typename Visit>
void CurvedPatches::VisitSmoothNeighbours(std::int32_t vertex, const Visit& visit) const
{
  const auto index = static_cast<std::size_t>(vertex);
  for (std::int32_t k = this->RingStart[index]; k < this->RingStart[index + 1]; ++k)
  {
    const std::int32_t other = this->Ring[static_cast<std::size_t>(k)];
    if (this->IsSmooth(vertex, other))
    {
      const auto to = static_cast<std::size_t>(other);
      visit(this->Surface->GetPositions()[to] - this->Surface->GetPositions()[index],
        this->Surface->GetNormals()[to]);
    }
  }
}

//------------------------------------------------------------------------------
CurvedPatches::Tensor CurvedPatches::FitCurvature(std::int32_t vertex) const
{
  const auto index = static_cast<std::size_t>(vertex);
  double longest = 0.0;
  for (std::int32_t k = this->RingStart[index]; k < this->RingStart[index + 1]; ++k)
  {
    const auto other = static_cast<std::size_t>(this->Ring[static_cast<std::size_t>(k)]);
    const glm::dvec3 edge =
      this->Surface->GetPositions()[other] - this->Surface->GetPositions()[index];
    longest = std::max(longest, glm::dot(edge, edge));
  }
  const double scale = longest > 0.0 ? 1.0 / std::sqrt(longest) : 0.0;
  const auto fitIn = [this, vertex, scale](const TangentFrame& frame)
  {
    GradientFit fit;
    this->VisitSmoothNeighbours(vertex,
      [scale, &frame, &fit](const glm::dvec3& edge, const glm::dvec3& normal)
      {
        const double x = scale * glm::dot(edge, frame.First);
        const double y = scale * glm::dot(edge, frame.Second);
        if (x * x + y * y > 0.0)
        {
          fit.Add(x, y, glm::dot(normal, frame.First), glm::dot(normal, frame.Second));
        }
      });
    return fit;
  };
  TangentFrame frame(this->Surface->GetNormals()[index]);
  double s[Unknowns];
  if (!fitIn(frame).SolveInAnyFrame(s))
  {
    glm::dvec3 moments(0.0); // xx, xy, yy
    this->VisitSmoothNeighbours(vertex,
      [scale, &frame, &moments](const glm::dvec3& edge, const glm::dvec3&)
      {
        const double x = scale * glm::dot(edge, frame.First);
        const double y = scale * glm::dot(edge, frame.Second);
        moments += glm::dvec3(x * x, x * y, y * y);
      });
    frame.TurnToAxes(moments);
    if (!fitIn(frame).SolveInOwnFrame(s))
    {
      return Tensor{};
    }
  }
  const glm::dvec3 a = scale * (s[0] * frame.First + s[1] * frame.Second);
  const glm::dvec3 b = scale * (s[1] * frame.First + s[2] * frame.Second);
  const glm::dvec3& first = frame.First;
  const glm::dvec3& second = frame.Second;
  return { a.x * first.x + b.x * second.x, a.x * first.y + b.x * second.y,
    a.x * first.z + b.x * second.z, a.y * first.y + b.y * second.y, a.y * first.z + b.y * second.z,
    a.z * first.z + b.z * second.z };
}

//------------------------------------------------------------------------------
void CurvedPatches::FitFacet(Patch& patch) const
{
  patch.Straight = 0;
  for (int k = 0; k < 3; ++k)
  {
    // The ends are in the same order on both sides of the edge, so both patches round alike.
    const std::int32_t low = std::min(patch.Vertex[(k + 1) % 3], patch.Vertex[(k + 2) % 3]);
    const std::int32_t high = std::max(patch.Vertex[(k + 1) % 3], patch.Vertex[(k + 2) % 3]);
    const auto i = static_cast<std::size_t>(low);
    const auto j = static_cast<std::size_t>(high);
    glm::dvec3 bend(0.0);
    if (this->IsSmooth(low, high))
    {
      const glm::dvec3 edge = this->Surface->GetPositions()[j] - this->Surface->GetPositions()[i];
      const glm::dvec3 sum = this->Surface->GetNormals()[i] + this->Surface->GetNormals()[j];
      bend = 0.125 * (Apply(this->Curvature[i], edge) - Apply(this->Curvature[j], edge));
      bend -= sum * (glm::dot(bend, sum) / glm::dot(sum, sum));
      const double squared = glm::dot(bend, bend);
      if (squared > LargestDeflection * LargestDeflection)
      {
        bend *= LargestDeflection / std::sqrt(squared);
      }
    }
    else
    {
      patch.Straight |= 1u << k;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      patch.Bend[k][axis] = static_cast<float>(4.0 * bend[axis]);
    }
  }
}

//------------------------------------------------------------------------------
std::size_t CurvedPatches::GetNumberOfStraightEdges() const
{
  std::size_t count = 0;
  for (const Patch& patch : this->Patches)
  {
    count += (patch.Straight & 1u) + (patch.Straight >> 1 & 1u) + (patch.Straight >> 2 & 1u);
  }
  return count;
}

}

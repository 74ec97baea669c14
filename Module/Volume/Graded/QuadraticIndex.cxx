// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/QuadraticIndex.h"

#include "Common/GroupedItems.h"
#include "Volume/Graded/GradedCell.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace meniscus
{
namespace
{

/** Terms of a quadratic function without its constant, the linear ones first. */
constexpr std::size_t Terms = 9;

/**
 * Least share of a column that must be independent of those before it. The remainder of a fit is
 * multiplied by up to the inverse of it. The remainder is smaller than the quadratic terms by the
 * cell's size over the length on which the field varies. On ten cells per length, a fit that
 * multiplies by more than 16 is no better than one without the column.
 */
constexpr double IndependentShare = 1.0 / 16.0;

/**
 * Neighbours of a vertex: cells around each vertex, and the vertices of these. Flat cells join no
 * neighbours: the field may jump in them.
 */
class Neighbourhoods
{
public:
  Neighbourhoods(const TetrahedralMesh& mesh, const std::vector<double>& values)
    : Mesh(mesh)
  {
    this->Cells.Set(static_cast<std::size_t>(mesh.GetNumberOfVertices()),
      [&mesh, &values](const auto& visit)
      {
        for (std::size_t c = 0; c < mesh.GetCells().size(); ++c)
        {
          const auto number = static_cast<std::int64_t>(c);
          if (mesh.IsActiveCell(number) && !MakeGradedCell(mesh, values, nullptr, number).IsFlat)
          {
            for (const std::int32_t vertex : mesh.GetCells()[c].Vertices)
            {
              visit(static_cast<std::size_t>(vertex), static_cast<std::int32_t>(c));
            }
          }
        }
      });
  }

  /** Adds the vertices of the cells around a vertex to a list, with repetitions. */
  void AddRing(std::int32_t vertex, std::vector<std::int32_t>& ring) const
  {
    for (const std::int32_t cell : this->Cells[static_cast<std::size_t>(vertex)])
    {
      const auto& vertices = this->Mesh.GetCells()[static_cast<std::size_t>(cell)].Vertices;
      ring.insert(ring.end(), vertices.begin(), vertices.end());
    }
  }

private:
  const TetrahedralMesh& Mesh;
  GroupedItems Cells; ///< around each vertex
};

void RemoveRepetitions(std::vector<std::int32_t>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/** Least squares fit of a quadratic function to differences from its value at a vertex. */
class QuadraticFit
{
public:
  /** @param ring vertices around the vertex, which may be among them. */
  void Read(const TetrahedralMesh& mesh, const std::vector<double>& values, std::int32_t vertex,
    const std::vector<std::int32_t>& ring)
  {
    for (auto& column : this->Columns)
    {
      column.clear();
    }
    this->Right.clear();
    const glm::dvec3 middle = mesh.GetPosition(vertex);
    double squaredSize = 0.0;
    this->Spread = 0.0;
    const double value = values[static_cast<std::size_t>(vertex)];
    for (const std::int32_t other : ring)
    {
      const glm::dvec3 way = mesh.GetPosition(other) - middle;
      squaredSize = std::max(squaredSize, glm::dot(way, way));
      this->Spread =
        std::max(this->Spread, std::abs(values[static_cast<std::size_t>(other)] - value));
    }
    this->Scale = squaredSize > 0.0 ? 1.0 / std::sqrt(squaredSize) : 0.0;
    for (const std::int32_t other : ring)
    {
      const glm::dvec3 p = this->Scale * (mesh.GetPosition(other) - middle);
      const double length = glm::length(p);
      if (!(length > 0.0))
      {
        continue;
      }
      // Near vertices count more: each row is a mean slope on the way to a vertex.
      const double row[Terms] = { p.x, p.y, p.z, p.x * p.x, p.x * p.y, p.x * p.z, p.y * p.y,
        p.y * p.z, p.z * p.z };
      for (std::size_t k = 0; k < Terms; ++k)
      {
        this->Columns[k].push_back(row[k] / length);
      }
      this->Right.push_back((values[static_cast<std::size_t>(other)] - value) / length);
    }
  }

  /** Largest difference of a value from that at the vertex. */
  double GetSpread() const { return this->Spread; }

  /**
   * Computes the gradient, by the method of Gram and Schmidt. Columns that depend on those before
   * them have no part in the fit. Returns the number of columns that have; without all three linear
   * ones, the gradient is not a number.
   */
  int Solve(glm::dvec3& gradient)
  {
    double triangle[Terms][Terms] = {};
    double right[Terms] = {};
    bool isUsed[Terms] = {};
    int used = 0;
    for (std::size_t k = 0; k < Terms; ++k)
    {
      std::vector<double>& column = this->Columns[k];
      const double before = Product(column, column);
      for (std::size_t j = 0; j < k; ++j)
      {
        if (isUsed[j])
        {
          triangle[j][k] = Product(this->Columns[j], column);
          Subtract(triangle[j][k], this->Columns[j], column);
        }
      }
      const double after = Product(column, column);
      isUsed[k] = after > IndependentShare * IndependentShare * before;
      if (isUsed[k])
      {
        ++used;
        triangle[k][k] = std::sqrt(after);
        for (double& value : column)
        {
          value /= triangle[k][k];
        }
        right[k] = Product(column, this->Right);
      }
    }
    double solution[Terms] = {};
    for (std::size_t k = Terms; k-- > 0;)
    {
      if (isUsed[k])
      {
        double rest = right[k];
        for (std::size_t j = k + 1; j < Terms; ++j)
        {
          rest -= triangle[k][j] * solution[j];
        }
        solution[k] = rest / triangle[k][k];
      }
    }
    const bool isKnown = isUsed[0] && isUsed[1] && isUsed[2];
    gradient = isKnown ? this->Scale * glm::dvec3(solution[0], solution[1], solution[2])
                       : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    return used;
  }

private:
  static double Product(const std::vector<double>& a, const std::vector<double>& b)
  {
    // Four sums, none of which waits for another one.
    double sums[4] = {};
    const std::size_t whole = a.size() / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4)
    {
      for (std::size_t k = 0; k < 4; ++k)
      {
        sums[k] += a[i + k] * b[i + k];
      }
    }
    for (std::size_t i = whole; i < a.size(); ++i)
    {
      sums[0] += a[i] * b[i];
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
  static void Subtract(double factor, const std::vector<double>& a, std::vector<double>& b)
  {
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      b[i] -= factor * a[i];
    }
  }

  std::array<std::vector<double>, Terms> Columns;
  std::vector<double> Right;
  double Scale = 0.0;
  double Spread = 0.0;
};

/** Values around a vertex. */
struct Surroundings
{
  /** Not a number where the values do not determine it. */
  glm::dvec3 Gradient;
  /** Largest difference of one of them from that at the vertex. */
  double Spread;
};

/** Fits gradients to the values around each vertex. */
std::vector<Surroundings> FitGradients(
  const TetrahedralMesh& mesh, const std::vector<double>& values, const RangeLoop& loop)
{
  const Neighbourhoods neighbourhoods(mesh, values);
  std::vector<Surroundings> fits(values.size());
  loop(values.size(),
    [&](std::size_t begin, std::size_t end)
    {
      QuadraticFit fit;
      std::vector<std::int32_t> ring;
      std::vector<std::int32_t> rings;
      for (std::size_t v = begin; v < end; ++v)
      {
        const auto vertex = static_cast<std::int32_t>(v);
        ring.clear();
        neighbourhoods.AddRing(vertex, ring);
        RemoveRepetitions(ring);
        fit.Read(mesh, values, vertex, ring);
        const bool isWhole = fit.Solve(fits[v].Gradient) == static_cast<int>(Terms);
        fits[v].Spread = fit.GetSpread();
        if (isWhole)
        {
          continue;
        }
        // At the boundary, the neighbours alone do not tell a quadratic function.
        rings = ring;
        for (const std::int32_t other : ring)
        {
          neighbourhoods.AddRing(other, rings);
        }
        RemoveRepetitions(rings);
        fit.Read(mesh, values, vertex, rings);
        fit.Solve(fits[v].Gradient);
        fits[v].Spread = fit.GetSpread();
      }
    });
  return fits;
}

/** The smaller of two numbers of the same sign; otherwise 0. */
double SmallerOf(double a, double b)
{
  if (a > 0.0 && b > 0.0)
  {
    return std::min(a, b);
  }
  return a < 0.0 && b < 0.0 ? std::max(a, b) : 0.0;
}

}

//------------------------------------------------------------------------------
std::vector<EdgeTerms> ComputeEdgeTerms(
  const TetrahedralMesh& mesh, const std::vector<double>& squaredIndices, const RangeLoop& loop)
{
  const std::vector<Surroundings> fits = FitGradients(mesh, squaredIndices, loop);
  const auto& cells = mesh.GetCells();
  std::vector<EdgeTerms> terms(cells.size(), EdgeTerms{});
  const auto termOf = [&](std::int32_t a, std::int32_t b)
  {
    const auto first = static_cast<std::size_t>(a);
    const auto second = static_cast<std::size_t>(b);
    const glm::dvec3 edge = mesh.GetPosition(b) - mesh.GetPosition(a);
    const double change = squaredIndices[second] - squaredIndices[first];
    const double term = SmallerOf(glm::dot(fits[first].Gradient, edge) - change,
      change - glm::dot(fits[second].Gradient, edge));
    // In cells that are much longer than thick, a gradient that is hardly wrong across them is far
    // off along an edge. A quadratic function on an edge from a vertex at which it is stationary
    // differs from its chord by a quarter of its change, which is a term as large as the change.
    const double most = std::min(fits[first].Spread, fits[second].Spread);
    return static_cast<float>(std::max(std::max(std::min(term, most), -most),
      -std::min(squaredIndices[first], squaredIndices[second])));
  };
  ForEachItem(cells.size(), loop,
    [&](std::size_t c)
    {
      if (!mesh.IsActiveCell(static_cast<std::int64_t>(c)))
      {
        return;
      }
      const auto& vertices = cells[c].Vertices;
      std::size_t edge = 0;
      for (std::size_t i = 0; i < 4; ++i)
      {
        for (std::size_t k = i + 1; k < 4; ++k)
        {
          terms[c][edge++] = termOf(vertices[i], vertices[k]);
        }
      }
    });
  return terms;
}

}

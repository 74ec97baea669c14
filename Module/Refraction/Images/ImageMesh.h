// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Refraction_Images_ImageMesh_h
#define meniscus_Refraction_Images_ImageMesh_h

#include "Refraction/Flat/FlatMembraneSolver.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/// A virtual vertex and its place in the object: a mean of at most three of its points. The weights
/// are not negative, fall from the first on, and add up to 1.
struct ImagePoint
{
  VirtualVertex vertex;
  std::array<std::int64_t, 3> source{ -1, -1, -1 };
  std::array<double, 3> weight{ 1.0, 0.0, 0.0 };

  /// The point of the object that this is an image of; -1 for a point made in between.
  std::int64_t GetSource() const { return this->weight[0] == 1.0 ? this->source[0] : -1; }

  /// Points with a weight; they come first.
  std::size_t GetNumberOfSources() const
  {
    return this->weight[1] == 0.0 ? 1 : (this->weight[2] == 0.0 ? 2 : 3);
  }

  /// The largest weight first, so that a whole one is told at once. None may be negative.
  void SetSource(const std::array<std::int64_t, 3>& ids, const glm::dvec3& weights)
  {
    std::array<glm::length_t, 3> order = { 0, 1, 2 };
    std::sort(order.begin(), order.end(),
      [&weights](glm::length_t i, glm::length_t j) { return weights[i] > weights[j]; });
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->source[k] = ids[static_cast<std::size_t>(order[k])];
      this->weight[k] = weights[order[k]];
    }
  }
};

/// Images of cells: points, and cells of one kind as lists of them.
struct ImageMesh
{
  std::vector<ImagePoint> points;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> ends; ///< one past the last entry of each cell in `connectivity`
  std::vector<std::int64_t> sourceCells;
  std::vector<signed char> orientations;

  std::size_t GetNumberOfCells() const { return this->ends.size(); }

  /// Ends a cell whose points have been added to the connectivity.
  void EndCell(std::int64_t sourceCell, int orientation)
  {
    this->ends.push_back(static_cast<std::int64_t>(this->connectivity.size()));
    this->sourceCells.push_back(sourceCell);
    this->orientations.push_back(static_cast<signed char>(orientation));
  }

  /// A state to return to, when what has been added since turns out wrong.
  struct Mark
  {
    std::size_t points;
    std::size_t entries;
    std::size_t cells;
  };
  Mark GetMark() const
  {
    return { this->points.size(), this->connectivity.size(), this->ends.size() };
  }
  void ReturnTo(const Mark& mark)
  {
    this->points.resize(mark.points);
    this->connectivity.resize(mark.entries);
    this->ends.resize(mark.cells);
    this->sourceCells.resize(mark.cells);
    this->orientations.resize(mark.cells);
  }

  void Append(const ImageMesh& other)
  {
    const auto firstPoint = static_cast<std::int64_t>(this->points.size());
    const auto firstEntry = static_cast<std::int64_t>(this->connectivity.size());
    this->points.insert(this->points.end(), other.points.begin(), other.points.end());
    for (const std::int64_t id : other.connectivity)
    {
      this->connectivity.push_back(firstPoint + id);
    }
    for (const std::int64_t end : other.ends)
    {
      this->ends.push_back(firstEntry + end);
    }
    this->sourceCells.insert(
      this->sourceCells.end(), other.sourceCells.begin(), other.sourceCells.end());
    this->orientations.insert(
      this->orientations.end(), other.orientations.begin(), other.orientations.end());
  }
};

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Refraction/Sight/VirtualVertex.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * A virtual vertex and its place in the object: a weighted mean of at most three of the object's
 * points. The weights are not negative, do not increase, and add up to 1.
 */
struct ImagePoint
{
  VirtualVertex Vertex;
  std::array<std::int64_t, 3> Source{ -1, -1, -1 };
  std::array<double, 3> Weight{ 1.0, 0.0, 0.0 };
  std::int32_t Passed = 0; ///< interfaces in front of it; set with several interfaces only

  /** Index of the object's point that this is an image of; -1 for a point made in between. */
  std::int64_t GetSource() const { return this->Weight[0] == 1.0 ? this->Source[0] : -1; }

  /** Number of points with a non-zero weight; they come first. */
  std::size_t GetNumberOfSources() const
  {
    return this->Weight[1] == 0.0 ? 1 : (this->Weight[2] == 0.0 ? 2 : 3);
  }

  /**
   * Sets the sources with the largest weight first, so that GetSource needs only the first. No
   * weight may be negative.
   */
  void SetSource(const std::array<std::int64_t, 3>& ids, const glm::dvec3& weights)
  {
    std::array<glm::length_t, 3> order = { 0, 1, 2 };
    std::sort(order.begin(), order.end(),
      [&weights](glm::length_t i, glm::length_t j) { return weights[i] > weights[j]; });
    for (std::size_t k = 0; k < 3; ++k)
    {
      this->Source[k] = ids[static_cast<std::size_t>(order[k])];
      this->Weight[k] = weights[order[k]];
    }
  }
};

/** Images of cells: points, and cells of one kind as lists of point indices. */
struct ImageMesh
{
  std::vector<ImagePoint> Points;
  std::vector<std::int64_t> Connectivity;
  std::vector<std::int64_t> Ends; ///< one past the last entry of each cell in `Connectivity`
  std::vector<std::int64_t> SourceCells;
  std::vector<signed char> Orientations;

  std::size_t GetNumberOfCells() const { return this->Ends.size(); }

  /** Ends a cell whose points have been added to the connectivity. */
  void EndCell(std::int64_t sourceCell, int orientation)
  {
    this->Ends.push_back(static_cast<std::int64_t>(this->Connectivity.size()));
    this->SourceCells.push_back(sourceCell);
    this->Orientations.push_back(static_cast<signed char>(orientation));
  }

  /** Adds a cell with points of its own, pointOf(0) to pointOf(count - 1), or turned round. */
  template <typename PointOf>
  void AddCell(std::size_t count, const PointOf& pointOf, bool turned, std::int64_t sourceCell,
    int orientation)
  {
    const std::size_t first = this->Points.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Points.push_back(pointOf(i));
      this->Connectivity.push_back(static_cast<std::int64_t>(first + (turned ? count - 1 - i : i)));
    }
    this->EndCell(sourceCell, orientation);
  }

  /** Sizes of all arrays, to return to if later additions have to be discarded. */
  struct Mark
  {
    std::size_t Points;
    std::size_t Entries;
    std::size_t Cells;
  };
  Mark GetMark() const
  {
    return { this->Points.size(), this->Connectivity.size(), this->Ends.size() };
  }
  void ReturnTo(const Mark& mark)
  {
    this->Points.resize(mark.Points);
    this->Connectivity.resize(mark.Entries);
    this->Ends.resize(mark.Cells);
    this->SourceCells.resize(mark.Cells);
    this->Orientations.resize(mark.Cells);
  }

  void Append(const ImageMesh& other)
  {
    const auto firstPoint = static_cast<std::int64_t>(this->Points.size());
    const auto firstEntry = static_cast<std::int64_t>(this->Connectivity.size());
    this->Points.insert(this->Points.end(), other.Points.begin(), other.Points.end());
    for (const std::int64_t id : other.Connectivity)
    {
      this->Connectivity.push_back(firstPoint + id);
    }
    for (const std::int64_t end : other.Ends)
    {
      this->Ends.push_back(firstEntry + end);
    }
    this->SourceCells.insert(
      this->SourceCells.end(), other.SourceCells.begin(), other.SourceCells.end());
    this->Orientations.insert(
      this->Orientations.end(), other.Orientations.begin(), other.Orientations.end());
  }
};

}

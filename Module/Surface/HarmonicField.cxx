// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/HarmonicField.h"

#include "Surface/TetrahedronShape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus
{

namespace
{

/** Largest residual, relative to the right-hand side: sixteen times below single precision. */
constexpr double RelativeResidual = 1.0 / 16.0 / 16777216.0;

double Dot(const std::vector<double>& a, const std::vector<double>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += a[i] * b[i];
  }
  return sum;
}

// Gradients of the four barycentric coordinates, times six volumes.
std::array<glm::dvec3, 4> ScaledGradients(const std::array<glm::dvec3, 4>& corner)
{
  std::array<glm::dvec3, 4> gradients;
  gradients[1] = glm::cross(corner[2] - corner[0], corner[3] - corner[0]);
  gradients[2] = glm::cross(corner[3] - corner[0], corner[1] - corner[0]);
  gradients[3] = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  gradients[0] = -gradients[1] - gradients[2] - gradients[3];
  return gradients;
}

} // anonymous namespace

//------------------------------------------------------------------------------
HarmonicField::HarmonicField(const TetrahedronCells& cells, const std::vector<bool>& given)
  : RowBegin(cells.Points.size() + 1, 0)
  , Diagonal(cells.Points.size(), 0.0)
  , Given(given)
{
  std::vector<std::pair<std::pair<int, int>, double>> parts;
  parts.reserve(12 * cells.Cells.size());
  for (const Tetrahedron& cell : cells.Cells)
  {
    std::array<glm::dvec3, 4> corner;
    for (std::size_t i = 0; i < 4; ++i)
    {
      corner[i] = cells.Points[static_cast<std::size_t>(cell[i])];
    }
    const auto gradients = ScaledGradients(corner);
    const double scale = 6.0 * SixfoldVolume(corner[0], corner[1], corner[2], corner[3]);
    for (std::size_t i = 0; i < 4; ++i)
    {
      this->Diagonal[static_cast<std::size_t>(cell[i])] +=
        glm::dot(gradients[i], gradients[i]) / scale;
      for (std::size_t j = 0; j < 4; ++j)
      {
        if (i != j)
        {
          parts.push_back({ { cell[i], cell[j] }, glm::dot(gradients[i], gradients[j]) / scale });
        }
      }
    }
  }
  // Stable, so that the sums do not depend on the sorting.
  std::stable_sort(
    parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    if (p > 0 && parts[p - 1].first == parts[p].first)
    {
      this->Entries.back() += parts[p].second;
      continue;
    }
    this->Columns.push_back(parts[p].first.second);
    this->Entries.push_back(parts[p].second);
    ++this->RowBegin[static_cast<std::size_t>(parts[p].first.first) + 1];
  }
  for (std::size_t row = 1; row < this->RowBegin.size(); ++row)
  {
    this->RowBegin[row] += this->RowBegin[row - 1];
  }
}

//------------------------------------------------------------------------------
void HarmonicField::Multiply(const std::vector<double>& x, std::vector<double>& product) const
{
  for (std::size_t row = 0; row < x.size(); ++row)
  {
    double sum = this->Given[row] ? 0.0 : this->Diagonal[row] * x[row];
    for (std::size_t e = this->RowBegin[row]; !this->Given[row] && e < this->RowBegin[row + 1]; ++e)
    {
      sum += this->Entries[e] * x[static_cast<std::size_t>(this->Columns[e])];
    }
    product[row] = sum;
  }
}

//------------------------------------------------------------------------------
// Conjugate gradients, preconditioned by the diagonal, on the points without given values.
bool HarmonicField::Continue(std::vector<double>& values) const
{
  const std::size_t count = values.size();
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (this->Given[i])
    {
      if (!std::isfinite(values[i]))
      {
        return false;
      }
      lowest = std::min(lowest, values[i]);
      highest = std::max(highest, values[i]);
    }
  }
  const auto isFree = [&](std::size_t i) { return !this->Given[i] && this->Diagonal[i] > 0.0; };
  // If all given values are equal, this is the solution.
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = this->Given[i] ? values[i] : lowest;
  }
  std::vector<double> residual(count);
  this->Multiply(values, residual);
  double bound = 0.0;
  std::vector<double> scaled(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    residual[i] = -residual[i];
    scaled[i] = isFree(i) ? residual[i] / this->Diagonal[i] : 0.0;
  }
  std::vector<double> direction = scaled;
  std::vector<double> product(count);
  double energy = Dot(residual, scaled);
  bound = RelativeResidual * RelativeResidual * energy;
  // Exact arithmetic ends after as many steps as there are free points.
  for (std::size_t step = 0; energy > bound && step <= 2 * count; ++step)
  {
    this->Multiply(direction, product);
    const double length = energy / Dot(direction, product);
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] += length * direction[i];
      residual[i] -= length * product[i];
      scaled[i] = isFree(i) ? residual[i] / this->Diagonal[i] : 0.0;
    }
    const double next = Dot(residual, scaled);
    for (std::size_t i = 0; i < count; ++i)
    {
      direction[i] = scaled[i] + next / energy * direction[i];
    }
    energy = next;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = this->Given[i] ? values[i] : std::clamp(values[i], lowest, highest);
  }
  return energy <= bound;
}

} // namespace meniscus

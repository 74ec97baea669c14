// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>

namespace meniscus
{

/**
 * Coordinates of points in the caller's memory, which are not copied: as triples or as one array
 * per axis, in single or double precision. The memory must outlive the view.
 */
class PointsView
{
public:
  /** No points. */
  PointsView() = default;
  /** @param triples x, y and z of each point in turn; may be null if there are none. */
  PointsView(const double* triples)
    : PointsView(triples, After(triples, 1), After(triples, 2), 3, false)
  {
  }
  PointsView(const float* triples)
    : PointsView(triples, After(triples, 1), After(triples, 2), 3, true)
  {
  }
  /** @param x, y, z one value per point each. */
  PointsView(const double* x, const double* y, const double* z)
    : PointsView(x, y, z, 1, false)
  {
  }
  PointsView(const float* x, const float* y, const float* z)
    : PointsView(x, y, z, 1, true)
  {
  }

  glm::dvec3 operator[](std::size_t index) const
  {
    return this->IsFloat ? this->Get<float>(index) : this->Get<double>(index);
  }

private:
  // Offsets to null are undefined.
  template <typename T>
  static const T* After(const T* first, int count)
  {
    return first ? first + count : nullptr;
  }

  PointsView(const void* x, const void* y, const void* z, std::size_t stride, bool isFloat)
    : Axes{ x, y, z }
    , Stride(stride)
    , IsFloat(isFloat)
  {
  }

  template <typename T>
  glm::dvec3 Get(std::size_t index) const
  {
    const std::size_t i = this->Stride * index;
    return { static_cast<const T*>(this->Axes[0])[i], static_cast<const T*>(this->Axes[1])[i],
      static_cast<const T*>(this->Axes[2])[i] };
  }

  const void* Axes[3] = { nullptr, nullptr, nullptr };
  /** Values from one point to the next. */
  std::size_t Stride = 0;
  bool IsFloat = false;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/VolumePreIntegration.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/VolumeInput.h"
#include "Rendering/Property/VolumePropertyTables.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** Factor for the rounding of lengths while a volume rotates. */
constexpr double Allowance = 1.0 + 1.0 / 1024.0;

/** Largest factor by which a matrix lengthens a vector. */
double LargestStretch(const glm::dmat4& matrix)
{
  double a[3][3];
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      a[row][column] = matrix[column][row];
    }
  }
  double left[3][3];
  double stretches[3];
  double right[3][3];
  vtkMath::SingularValueDecomposition3x3(a, left, stretches, right);
  return std::max({ std::abs(stretches[0]), std::abs(stretches[1]), std::abs(stretches[2]) });
}

}

//------------------------------------------------------------------------------
void VolumePreIntegration::Update(const VolumeInput& input, const VolumePropertyTables& property,
  const glm::dmat4& modelToWorld, const TableSize& size)
{
  const TetrahedralMesh& mesh = input.GetMesh();
  const double needed =
    mesh.GetLongestEdge() * mesh.GetRadius() * LargestStretch(modelToWorld) * Allowance;
  const double built = this->Table.GetLongest();
  const bool lengthsServe = needed <= built * Allowance && needed >= 0.25 * built;
  if (this->Version != TableVersion() && lengthsServe &&
    this->BuiltProperty == property.GetVersion() && this->BuiltSize.Scalars == size.Scalars &&
    this->BuiltSize.Lengths == size.Lengths)
  {
    return;
  }
  const ScalarRange range =
    SampledRange(input.GetDistribution(), property.GetFeatures().Of(0), input.GetNormalization());
  this->Table.Build(
    property.GetIntervals(), needed, size.Scalars, size.Lengths, ThreadedLoop, range);
  this->BuiltProperty = property.GetVersion();
  this->BuiltSize = size;
  this->Version.Bump();
}

}

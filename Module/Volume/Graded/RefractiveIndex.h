// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Squared index of refraction at the vertices of a mesh, and the cells that it is known in. */
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <cstdint>
#include <vector>

namespace meniscus
{

/**
 * Gladstone-Dale constant of dry air at a wavelength of 589.3 nm, in m^3/kg: n = 1 + K * density.
 *
 * It is the quotient of n - 1 = 2.77147e-4 and the density 1.22546 kg/m^3 of dry air with 450 ppm
 * of carbon dioxide at 15 degrees Celsius and 101325 Pa: P. E. Ciddor, "Refractive index of air:
 * new equations for the visible and near infrared", Applied Optics 35 (1996), 1566-1573.
 */
constexpr double GladstoneDaleOfAir = 2.26157e-4;

/** Numbers of vertices whose index of refraction is unusable or unusual. */
struct IndexFaults
{
  /** The value or its square is NaN or infinite. Cells with a vertex of this kind are left out. */
  std::int64_t NotFinite = 0;
  /** The index is 0 or negative, or the density is negative. Cells with it are left out. */
  std::int64_t NotPositive = 0;
  /** The index is below 1, as in a plasma. It is used. */
  std::int64_t BelowOne = 0;

  std::int64_t GetNumberOfUnusable() const { return this->NotFinite + this->NotPositive; }
};

/**
 * Squared index of each vertex, NaN if it is unusable.
 * @param indices index of refraction of each vertex.
 * @param faults replaced by the counts.
 */
std::vector<double> SquareIndices(const std::vector<double>& indices, IndexFaults& faults);

/**
 * Squared index of each vertex of a gas, n = 1 + constant * density; NaN if it is unusable.
 * @param constant Gladstone-Dale constant, volume per mass.
 */
std::vector<double> SquareIndicesOfGas(
  const std::vector<double>& densities, double constant, IndexFaults& faults);

/**
 * Activates the cells of the mesh whose four vertices have an index and deactivates all others.
 * Returns the number of cells without an index.
 */
std::int64_t ActivateCellsWithIndex(TetrahedralMesh& mesh,
  const std::vector<double>& squaredIndices, const RangeLoop& loop = SerialLoop);

}

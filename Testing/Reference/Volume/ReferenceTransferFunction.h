// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace meniscus::reference
{

/** Attenuation per world length and emitted colour of a medium. */
struct OpticalSample
{
  double Attenuation = 0.0;
  std::array<double, 3> Color{ 0.0, 0.0, 0.0 };
};

struct TransferFunctionNode
{
  double Scalar = 0.0;
  OpticalSample Value;
};

/**
 * Piecewise linear transfer function in double precision.
 *
 * Two nodes with the same scalar make a jump. Beyond the outer nodes the function keeps the value
 * of the outer node (Clamped) or is transparent (Zero). A function without nodes is transparent.
 */
class ReferenceTransferFunction
{
public:
  enum class Outside
  {
    Clamped,
    Zero
  };

  ReferenceTransferFunction() = default;
  ReferenceTransferFunction(
    std::vector<TransferFunctionNode> nodes, Outside outside = Outside::Clamped);

  const std::vector<TransferFunctionNode>& GetNodes() const { return this->Nodes; }

  /**
   * Index of the linear piece that holds a scalar: the number of nodes at or below it. The last
   * node belongs to the piece below it where the function ends.
   */
  std::size_t PieceOf(double scalar) const;

  /** Value of one linear piece, extended beyond its ends (so that a jump has two limits). */
  OpticalSample ValueInPiece(std::size_t piece, double scalar) const;

  OpticalSample GetValue(double scalar) const
  {
    return this->ValueInPiece(this->PieceOf(scalar), scalar);
  }

private:
  std::vector<TransferFunctionNode> Nodes;
  Outside Beyond = Outside::Clamped;
};

} // namespace meniscus::reference

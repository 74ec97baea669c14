// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceTransferFunction.h"

#include <algorithm>
#include <utility>

namespace meniscus::reference
{

//------------------------------------------------------------------------------
ReferenceTransferFunction::ReferenceTransferFunction(
  std::vector<TransferFunctionNode> nodes, Outside outside)
  : Nodes(std::move(nodes))
  , Beyond(outside)
{
  // A stable sort keeps the order of the two nodes of a jump.
  std::stable_sort(this->Nodes.begin(), this->Nodes.end(),
    [](const TransferFunctionNode& a, const TransferFunctionNode& b)
    { return a.Scalar < b.Scalar; });
}

//------------------------------------------------------------------------------
std::size_t ReferenceTransferFunction::PieceOf(double scalar) const
{
  if (this->Beyond == Outside::Zero && !this->Nodes.empty() && scalar == this->Nodes.back().Scalar)
  {
    return this->Nodes.size() - 1;
  }
  const auto above = std::upper_bound(this->Nodes.begin(), this->Nodes.end(), scalar,
    [](double s, const TransferFunctionNode& node) { return s < node.Scalar; });
  return static_cast<std::size_t>(above - this->Nodes.begin());
}

//------------------------------------------------------------------------------
OpticalSample ReferenceTransferFunction::ValueInPiece(std::size_t piece, double scalar) const
{
  const std::size_t count = this->Nodes.size();
  if (count == 0)
  {
    return OpticalSample{};
  }
  if (piece == 0 || piece >= count)
  {
    const TransferFunctionNode& outer = piece == 0 ? this->Nodes.front() : this->Nodes.back();
    return this->Beyond == Outside::Clamped ? outer.Value : OpticalSample{};
  }
  const TransferFunctionNode& low = this->Nodes[piece - 1];
  const TransferFunctionNode& high = this->Nodes[piece];
  const double width = high.Scalar - low.Scalar;
  const double weight = width > 0.0 ? (scalar - low.Scalar) / width : 0.0;
  OpticalSample sample;
  sample.Attenuation =
    low.Value.Attenuation + weight * (high.Value.Attenuation - low.Value.Attenuation);
  for (int c = 0; c < 3; ++c)
  {
    sample.Color[c] = low.Value.Color[c] + weight * (high.Value.Color[c] - low.Value.Color[c]);
  }
  return sample;
}

} // namespace meniscus::reference

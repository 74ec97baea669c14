// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/VolumeGradients.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/ConcatenatedArray.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Mesh/ScalarGradients.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void VolumeGradients::Update(const VolumeInput& input, const InputBlocks& parts)
{
  const TableVersions versions{ input.GetMeshVersion(), input.GetScalarVersion() };
  if (this->BuiltInput == versions)
  {
    return;
  }
  const std::vector<double> scalars =
    GatherValues(parts, input.GetComponent(), input.GetSources(FieldAssociation::Points),
      input.GetInterpolatedPoints(FieldAssociation::Points));
  const double scale = input.GetNormalization().GradientScale;
  this->Values = this->Place == FieldAssociation::Points
    ? ComputeVertexGradients(input.GetMesh(), scalars, scale, ThreadedLoop)
    : ComputeCellGradients(input.GetMesh(), scalars, scale, ThreadedLoop);
  this->BuiltInput = versions;
  this->Version.Bump();
}

//------------------------------------------------------------------------------
std::int64_t VolumeGradients::GetBytes() const
{
  return BytesOf(this->Values);
}

}

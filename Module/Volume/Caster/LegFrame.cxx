// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/LegFrame.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void LegFrame::Set(
  const FixedPointRays& grid, const std::vector<PacketVertex>& vertices, const FrameOptics& optics)
{
  this->GridUnit = grid.GetGridUnit();
  this->Pivot = grid.GetPivot();
  this->RaysAreFine = grid.AreFine();
  this->Vertices = &vertices;
  this->Lit = optics.Lighting != nullptr;
  this->Lighting = this->Lit ? *optics.Lighting : SurfaceLighting();
  this->GradientToFrame = optics.GradientToFrame;
  this->Medium.Pack(this->Lit ? &this->Lighting : nullptr, optics.GradientToFrame,
    optics.GradientMagnitude, optics.GradientOpacity);
}

//------------------------------------------------------------------------------
void LegFrame::Describe(PacketJob& job) const
{
  job.GridUnit = this->GridUnit;
  job.Pivot = this->Pivot;
  job.RaysAreFine = this->RaysAreFine;
  job.Vertices = this->Vertices->data();
  job.Lighting = this->Lit ? &this->Lighting : nullptr;
  job.GradientToFrame = &this->GradientToFrame;
  job.Medium = GetBlendModel(job.Blending).IsMedium() ? this->Medium.Get() : nullptr;
}

}

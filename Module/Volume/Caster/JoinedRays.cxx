// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Caster/JoinedRays.h"
#include "Volume/Packet/Kernels/KeptValues.h"

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
void JoinedRays::Clear(BlendMode mode)
{
  float empty[4];
  ClearValues(mode, empty);
  this->Values.fill({ empty[0], empty[1], empty[2], empty[3] });
  this->Ends.fill(PacketResult::Outside);
  this->Steps.fill(0);
  this->Hides = GetBlendModel(mode).HidesBehind();
}

//------------------------------------------------------------------------------
void JoinedRays::Join(const LegBatch::Origin& origin, BlendMode mode, const PacketResult& result)
{
  std::array<float, 4>& joined = this->Values[static_cast<std::size_t>(origin.Pixel)];
  float values[4];
  std::copy_n(joined.data(), 4, values);
  JoinValues(mode, result.Color, values);
  std::copy_n(values, 4, joined.data());
}

//------------------------------------------------------------------------------
void JoinedRays::Finish(const PacketJob& job, const BoundaryRaster::PixelBox& box, int width,
  float* image, RayStatistics& sums) const
{
  for (int row = box.Bottom; row < box.Top; ++row)
  {
    for (int column = box.Left; column < box.Right; ++column)
    {
      const auto pixel =
        static_cast<std::size_t>((row - box.Bottom) * BoundaryRaster::TileSize + column - box.Left);
      if (this->Steps[pixel] == 0)
      {
        continue;
      }
      sums.Steps += this->Steps[pixel];
      ++sums.Rays;
      float values[4];
      float color[4];
      std::copy_n(this->Values[pixel].data(), 4, values);
      FinishValues(job, values, color);
      std::copy_n(color, 4, image + 4 * (std::int64_t{ row } * width + column));
    }
  }
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Illumination/LightFrames.h"

#include "Common/BlockLoop.h"
#include "Refraction/Membrane/HeightField.h"
#include "Volume/Rays/PlacedVertices.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <atomic>

namespace meniscus
{

//------------------------------------------------------------------------------
void LightFrames::Set(const RayFrame& base, const glm::dvec4& light)
{
  const glm::dvec3 place(light);
  const double distance = glm::length(place);
  this->ToBase = glm::transpose(glm::dmat3(base.RowX, base.RowY, base.RowDepth));
  // A light at the centre of the mesh has no direction from there.
  const glm::dvec3 along = distance > 0.0 ? place / distance : glm::dvec3(0.0, 0.0, 1.0);
  this->Light = light.w == 0.0 ? glm::dvec4(along, 0.0) : light;
  const HeightFrame height(along);
  this->Axes = glm::dmat3(height.First, height.Second, height.Axis);
  this->Frames.clear();
  const int count = this->IsParallel() ? 1 : RefractionFrames::Number;
  // Lines towards a light at infinity are along the depth.
  const double steepest = this->IsParallel() ? 0.0 : 1.0;
  for (int index = 0; index < count; ++index)
  {
    this->Frames.push_back(RefractionFrame::Make(
      base, RefractionFrames::RotationTo(this->Axes, index), steepest, 0.0, 1.0));
  }
  this->Needed = 0;
}

//------------------------------------------------------------------------------
void LightFrames::Place(const TetrahedralMesh& mesh, const std::vector<float>& scalars,
  const ShadowStarts& starts, const RangeLoop& loop)
{
  std::atomic<unsigned int> needed{ this->IsParallel() ? 1u : 0u };
  if (!this->IsParallel())
  {
    const std::vector<std::int32_t>& numbers = starts.GetNumbers();
    ForEachBlock(numbers.size(), loop,
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        unsigned int bits = 0;
        for (std::size_t i = first; i < last; ++i)
        {
          bits |= 1u << this->IndexOf(this->StepFrom(this->ToBase * starts.GetPlace(numbers[i])));
        }
        needed |= bits;
      });
  }
  this->Needed = needed;
  for (int index = 0; index < this->GetNumberOfFrames(); ++index)
  {
    if (this->IsNeeded(index))
    {
      RefractionFrame& frame = this->Frames[static_cast<std::size_t>(index)];
      PlaceVertices(mesh, scalars, frame.Rays, loop, frame.Vertices);
    }
  }
}

}

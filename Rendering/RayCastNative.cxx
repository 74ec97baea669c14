// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCastNative.h"

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>

namespace meniscus
{
namespace
{

/** Rows of an image; every row notes its own sums. */
class RowCaster
{
public:
  RowCaster(const RayCastScene& scene, int width, int height, const std::vector<float>& opaqueDepth,
    std::vector<float>& image)
    : Scene(scene)
    , Width(width)
    , Height(height)
    , OpaqueDepth(opaqueDepth)
    , Image(image)
    , RowStatistics(height)
  {
  }

  void operator()(vtkIdType first, vtkIdType last)
  {
    RayWalk walk(this->Scene);
    for (vtkIdType row = first; row < last; ++row)
    {
      for (int column = 0; column < this->Width; ++column)
      {
        const std::size_t pixel = static_cast<std::size_t>(row) * this->Width + column;
        const double clipDepth = 2.0 * this->OpaqueDepth[pixel] - 1.0;
        const glm::vec2 fromCenter(
          column + 0.5f - 0.5f * this->Width, row + 0.5f - 0.5f * this->Height);
        const RayResult result =
          walk.Cast(fromCenter, static_cast<float>(this->Scene.Frame.DepthAt(clipDepth)));
        std::copy_n(&result.Color[0], 4, this->Image.begin() + 4 * pixel);
        RayStatistics& sums = this->RowStatistics[row];
        sums.Steps += result.Steps;
        sums.Rays += result.Steps > 0 ? 1 : 0;
        sums.Lost += result.Lost ? 1 : 0;
      }
    }
  }

  RayStatistics Sum() const
  {
    RayStatistics total;
    for (const RayStatistics& row : this->RowStatistics)
    {
      total.Steps += row.Steps;
      total.Rays += row.Rays;
      total.Lost += row.Lost;
    }
    return total;
  }

private:
  const RayCastScene& Scene;
  int Width;
  int Height;
  const std::vector<float>& OpaqueDepth;
  std::vector<float>& Image;
  std::vector<RayStatistics> RowStatistics;
};

}

//------------------------------------------------------------------------------
RayStatistics CastRaysNative(const RayCastScene& scene, int width, int height,
  const std::vector<float>& opaqueDepth, std::vector<float>& image)
{
  image.resize(std::size_t{ 4 } * width * height);
  RowCaster caster(scene, width, height, opaqueDepth, image);
  // Rows differ in cost: small grains let threads share it.
  vtkSMPTools::For(0, height, 4, caster);
  return caster.Sum();
}

}

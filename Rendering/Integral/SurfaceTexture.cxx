// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/SurfaceTexture.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTexture.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnsignedCharArray> MapToColors(
  vtkDataArray* scalars, vtkScalarsToColors* table, int colorMode)
{
  vtkNew<vtkLookupTable> ofRange;
  if (!table)
  {
    ofRange->SetRange(scalars->GetRange());
    ofRange->Build();
    table = ofRange;
  }
  vtkSmartPointer<vtkUnsignedCharArray> colors;
  colors.TakeReference(table->MapScalars(scalars, colorMode, 0));
  return colors;
}

//------------------------------------------------------------------------------
glm::dvec3 GetColor(vtkUnsignedCharArray* colors, vtkIdType tuple)
{
  glm::dvec3 color;
  for (int k = 0; k < 3; ++k)
  {
    color[k] = colors->GetTypedComponent(tuple, k) / 255.0;
  }
  return color;
}

//------------------------------------------------------------------------------
std::string SurfaceTexture::Read(vtkTexture* texture)
{
  this->Texels = nullptr;
  if (!texture)
  {
    return {};
  }
  if (vtkAlgorithm* source = texture->GetInputAlgorithm())
  {
    source->Update();
  }
  vtkImageData* image = texture->GetInput();
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars)
  {
    return "The texture has no image";
  }
  int used = 0;
  this->Size[0] = this->Size[1] = 1;
  for (const int size :
    { image->GetDimensions()[0], image->GetDimensions()[1], image->GetDimensions()[2] })
  {
    if (size > 1 && used < 2)
    {
      this->Size[used] = size;
    }
    used += size > 1 ? 1 : 0;
  }
  if (used > 2 || texture->GetCubeMap())
  {
    return "The texture is a volume or a cube map instead of an image";
  }
  if (scalars->GetNumberOfTuples() != this->Size[0] * this->Size[1])
  {
    return "The texture's image does not have one value per point";
  }
  this->Texels = MapToColors(scalars, texture->GetLookupTable(), texture->GetColorMode());
  this->WrapMode = texture->GetWrap();
  this->IsInterpolated = texture->GetInterpolate() != 0;
  this->Border = glm::make_vec3(texture->GetBorderColor());
  return {};
}

//------------------------------------------------------------------------------
/** Number of the texel in the image, or -1 for the border. */
vtkIdType SurfaceTexture::Wrap(vtkIdType texel, int axis) const
{
  const vtkIdType size = this->Size[axis];
  const vtkIdType period = this->WrapMode == vtkTexture::MirroredRepeat ? 2 * size : size;
  const vtkIdType inPeriod = (texel % period + period) % period;
  switch (this->WrapMode)
  {
    case vtkTexture::Repeat:
    case vtkTexture::MirroredRepeat:
      return std::min(inPeriod, 2 * size - 1 - inPeriod);
    case vtkTexture::ClampToBorder:
      return texel == glm::clamp<vtkIdType>(texel, 0, size - 1) ? texel : -1;
    default:
      return glm::clamp<vtkIdType>(texel, 0, size - 1);
  }
}

//------------------------------------------------------------------------------
glm::dvec3 SurfaceTexture::GetTexel(vtkIdType column, vtkIdType row) const
{
  column = this->Wrap(column, 0);
  row = this->Wrap(row, 1);
  return column < 0 || row < 0 ? this->Border
                               : GetColor(this->Texels, row * this->Size[0] + column);
}

//------------------------------------------------------------------------------
glm::dvec3 SurfaceTexture::At(const glm::dvec2& coordinates) const
{
  if (!std::isfinite(coordinates.x) || !std::isfinite(coordinates.y))
  {
    return glm::dvec3(1.0);
  }
  const bool isPeriodic =
    this->WrapMode == vtkTexture::Repeat || this->WrapMode == vtkTexture::MirroredRepeat;
  // Numbers of texels fit into integers: both patterns have the period 2, and without them no
  // coordinate beyond -1 and 2 differs from these.
  const glm::dvec2 near =
    isPeriodic ? glm::mod(coordinates, 2.0) : glm::clamp(coordinates, -1.0, 2.0);
  const double half = this->IsInterpolated ? 0.5 : 0.0;
  const glm::dvec2 place =
    near * glm::dvec2(double(this->Size[0]), double(this->Size[1])) - glm::dvec2(half);
  const glm::dvec2 low = glm::floor(place);
  const auto column = static_cast<vtkIdType>(low.x);
  const auto row = static_cast<vtkIdType>(low.y);
  if (!this->IsInterpolated)
  {
    return this->GetTexel(column, row);
  }
  const glm::dvec2 share = place - low;
  const auto mixRow = [&](vtkIdType number)
  { return glm::mix(this->GetTexel(column, number), this->GetTexel(column + 1, number), share.x); };
  return glm::mix(mixRow(row), mixRow(row + 1), share.y);
}

}

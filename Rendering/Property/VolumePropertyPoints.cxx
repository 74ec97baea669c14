// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/VolumePropertyPoints.h"

#include "Rendering/Property/PropertyFunction.h"

#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace meniscus
{
namespace
{

/** Values of straight pieces at scalars in ascending order. */
class PieceReader
{
public:
  explicit PieceReader(const std::vector<TransferFunctionPoint>& points)
    : Points(points)
  {
  }

  struct Limits
  {
    TransferFunctionPoint Below;
    TransferFunctionPoint Above;
    bool IsJump = false;
  };

  /** @param scalar not less than in the last call. */
  Limits Read(double scalar)
  {
    const std::size_t size = this->Points.size();
    while (this->Next < size && this->Points[this->Next].Scalar < scalar)
    {
      ++this->Next;
    }
    if (size == 0)
    {
      const TransferFunctionPoint none{ scalar, 0.0, glm::dvec3(0.0) };
      return { none, none };
    }
    // Before the first point, after the last one, or not a number.
    if (this->Next == size || (this->Next == 0 && this->Points[0].Scalar != scalar))
    {
      const TransferFunctionPoint& end = this->Points[this->Next == 0 ? 0 : size - 1];
      return { end, end };
    }
    const TransferFunctionPoint& next = this->Points[this->Next];
    if (next.Scalar == scalar)
    {
      std::size_t last = this->Next;
      while (last + 1 < size && this->Points[last + 1].Scalar == scalar)
      {
        ++last;
      }
      return { next, this->Points[last], last != this->Next };
    }
    const TransferFunctionPoint& before = this->Points[this->Next - 1];
    // Halves keep the difference of scalars in the range of double.
    const double fraction =
      (0.5 * scalar - 0.5 * before.Scalar) / (0.5 * next.Scalar - 0.5 * before.Scalar);
    const TransferFunctionPoint between{ scalar,
      before.Attenuation + fraction * (next.Attenuation - before.Attenuation),
      before.Color + fraction * (next.Color - before.Color) };
    return { between, between };
  }

private:
  const std::vector<TransferFunctionPoint>& Points;
  std::size_t Next = 0;
};

std::vector<double> ScalarsOf(
  const std::vector<TransferFunctionPoint>& a, const std::vector<TransferFunctionPoint>& b)
{
  std::vector<double> scalars;
  scalars.reserve(a.size() + b.size());
  for (const auto* points : { &a, &b })
  {
    for (const TransferFunctionPoint& point : *points)
    {
      scalars.push_back(point.Scalar);
    }
  }
  std::sort(scalars.begin(), scalars.end());
  scalars.erase(std::unique(scalars.begin(), scalars.end()), scalars.end());
  return scalars;
}

/** Points of both functions: straight pieces of one are divided where the other one has a point. */
std::vector<TransferFunctionPoint> Merge(const std::vector<TransferFunctionPoint>& opacity,
  const std::vector<TransferFunctionPoint>& color)
{
  std::vector<TransferFunctionPoint> merged;
  PieceReader opacities(opacity);
  PieceReader colors(color);
  for (const double scalar : ScalarsOf(opacity, color))
  {
    const PieceReader::Limits attenuation = opacities.Read(scalar);
    const PieceReader::Limits shade = colors.Read(scalar);
    merged.push_back({ scalar, attenuation.Below.Attenuation, shade.Below.Color });
    if (attenuation.IsJump || shade.IsJump)
    {
      merged.push_back({ scalar, attenuation.Above.Attenuation, shade.Above.Color });
    }
  }
  return merged;
}

std::unique_ptr<PropertyFunction> ColorsOf(vtkVolumeProperty* property, int component)
{
  if (property->GetColorChannels(component) == 1)
  {
    return std::make_unique<GrayFunction>(property->GetGrayTransferFunction(component));
  }
  return std::make_unique<ColorFunction>(property->GetRGBTransferFunction(component));
}

}

//------------------------------------------------------------------------------
PropertyPoints ReducePropertyToPoints(
  vtkVolumeProperty* property, int component, OpacityMeaning meaning)
{
  PropertyPoints result;
  const std::vector<TransferFunctionPoint> opacity =
    ReduceToPoints(OpacityFunction(property->GetScalarOpacity(component), meaning,
      property->GetScalarOpacityUnitDistance(component)));
  if (opacity.empty())
  {
    return result;
  }
  const std::vector<TransferFunctionPoint> color = ReduceToPoints(*ColorsOf(property, component));
  result.Points = Merge(opacity, color);
  result.Features = FeaturesOf(opacity);
  const std::vector<ScalarFeature> ofColor = FeaturesOf(color);
  result.Features.insert(result.Features.end(), ofColor.begin(), ofColor.end());
  return result;
}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> EvaluateProperty(
  vtkVolumeProperty* property, const std::vector<double>& scalars)
{
  const std::unique_ptr<PropertyFunction> colors = ColorsOf(property, 0);
  const OpacityFunction opacity(property->GetScalarOpacity(0), OpacityMeaning::Alpha, 1.0);
  // Interpolated colours where each evaluation has a high cost.
  std::vector<TransferFunctionPoint> reduced;
  if (colors->HasCostlyCalls())
  {
    reduced = ReduceToPoints(*colors);
  }
  std::vector<TransferFunctionPoint> points;
  for (const double scalar : scalars)
  {
    TransferFunctionPoint point = opacity.Sample(scalar, scalar, 1).front();
    point.Color = colors->HasCostlyCalls() ? PieceReader(reduced).Read(scalar).Below.Color
                                           : colors->Sample(scalar, scalar, 1).front().Color;
    points.push_back(point);
  }
  return points;
}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> ReduceGradientOpacityToPoints(vtkVolumeProperty* property)
{
  return ReduceToPoints(
    OpacityFunction(property->GetGradientOpacity(0), OpacityMeaning::Alpha, 1.0));
}

}

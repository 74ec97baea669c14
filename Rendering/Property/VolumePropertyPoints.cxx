// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/VolumePropertyPoints.h"

#include "vtkColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace meniscus
{
namespace
{

/** Largest accepted deviation of linear interpolation, in colour and in alpha per unit distance. */
constexpr double SamplingBound = 1.0 / 32768.0;
/** Halvings of an interval: 2^12 samples resolve a unit step of a smooth function to the bound. */
constexpr int MaximumHalvings = 12;
/** Largest opacity below 1 that a float can represent. */
constexpr double LargestOpacity = 1.0 - 1.0 / 16777216.0;

/**
 * Smaller jumps cannot be distinguished from the change of a continuous function between adjacent
 * doubles.
 */
constexpr double SmallestJump = 1.0 / 1073741824.0;

/** The property's functions, evaluated on a given side of jumps. */
class PropertyCurve
{
public:
  PropertyCurve(vtkVolumeProperty* property, int component, OpacityMeaning meaning)
    : Opacity(property->GetScalarOpacity(component))
    , Gray(property->GetColorChannels(component) == 1 ? property->GetGrayTransferFunction(component)
                                                      : nullptr)
    , Color(this->Gray ? nullptr : property->GetRGBTransferFunction(component))
    , Unit(property->GetScalarOpacityUnitDistance(component))
    , Meaning(meaning)
  {
  }

  /** A function of opacity without colour. */
  explicit PropertyCurve(vtkPiecewiseFunction* opacity)
    : Opacity(opacity)
  {
  }

  /** Scalars where a function has a node. */
  std::set<double> Nodes() const
  {
    std::set<double> nodes;
    AddNodes(this->Opacity, nodes);
    AddNodes(this->Gray, nodes);
    double node[6];
    for (int i = 0; this->Color && i < this->Color->GetSize(); ++i)
    {
      this->Color->GetNodeValue(i, node);
      nodes.insert(node[0]);
    }
    return nodes;
  }

  bool HasOpacity() const { return this->Opacity->GetSize() > 0; }

  TransferFunctionPoint At(double scalar) const
  {
    TransferFunctionPoint point{ scalar, this->AttenuationOf(this->Opacity->GetValue(scalar)),
      glm::dvec3(0.0) };
    if (this->Gray)
    {
      point.Color = glm::dvec3(this->Gray->GetValue(scalar));
    }
    else if (this->Color)
    {
      this->Color->GetColor(scalar, &point.Color[0]);
    }
    return point;
  }

  /** Largest difference in colour and in alpha over the unit distance. */
  double Difference(const TransferFunctionPoint& a, const TransferFunctionPoint& b) const
  {
    const glm::dvec3 color = glm::abs(a.Color - b.Color);
    const double alpha = this->Meaning == OpacityMeaning::Alpha
      ? std::abs(a.Attenuation - b.Attenuation)
      : std::abs(std::exp(-a.Attenuation * this->Unit) - std::exp(-b.Attenuation * this->Unit));
    return std::max({ color.r, color.g, color.b, alpha });
  }

private:
  static void AddNodes(vtkPiecewiseFunction* function, std::set<double>& nodes)
  {
    double node[4];
    for (int i = 0; function && i < function->GetSize(); ++i)
    {
      function->GetNodeValue(i, node);
      nodes.insert(node[0]);
    }
  }

  double AttenuationOf(double opacity) const
  {
    const double positive = opacity > 0.0 ? opacity : 0.0;
    switch (this->Meaning)
    {
      case OpacityMeaning::Attenuation:
        return positive / this->Unit;
      case OpacityMeaning::AlphaPerUnitDistance:
        return -std::log1p(-std::min(positive, LargestOpacity)) / this->Unit;
      default:
        return positive;
    }
  }

  vtkPiecewiseFunction* Opacity;
  vtkPiecewiseFunction* Gray = nullptr;
  vtkColorTransferFunction* Color = nullptr;
  double Unit = 1.0;
  OpacityMeaning Meaning = OpacityMeaning::Alpha;
};

TransferFunctionPoint Middle(const TransferFunctionPoint& a, const TransferFunctionPoint& b)
{
  return { 0.5 * a.Scalar + 0.5 * b.Scalar, 0.5 * (a.Attenuation + b.Attenuation),
    0.5 * (a.Color + b.Color) };
}

/** Appends the points strictly between a and b that linear interpolation needs. */
void Refine(const PropertyCurve& curve, const TransferFunctionPoint& a,
  const TransferFunctionPoint& b, int halvings, std::vector<TransferFunctionPoint>& points)
{
  const TransferFunctionPoint linear = Middle(a, b);
  if (halvings == 0 || !(linear.Scalar > a.Scalar && linear.Scalar < b.Scalar))
  {
    return;
  }
  // Besides the middle, two places that are not symmetric about it are tested, so that an odd curve
  // is detected.
  const TransferFunctionPoint quarter = Middle(a, linear);
  const TransferFunctionPoint fiveEighths = Middle(linear, Middle(linear, b));
  const auto isClose = [&curve](const TransferFunctionPoint& p)
  { return curve.Difference(curve.At(p.Scalar), p) < SamplingBound; };
  const bool straight = isClose(linear) && isClose(quarter) && isClose(fiveEighths);
  if (straight)
  {
    return;
  }
  const TransferFunctionPoint middle = curve.At(linear.Scalar);
  Refine(curve, a, middle, halvings - 1, points);
  points.push_back(middle);
  Refine(curve, middle, b, halvings - 1, points);
}

/** The curve's limit at `node` from the side of `toward`. */
TransferFunctionPoint LimitAt(const PropertyCurve& curve, double node, double toward)
{
  TransferFunctionPoint limit = curve.At(std::nextafter(node, toward));
  limit.Scalar = node;
  return limit;
}

std::vector<TransferFunctionPoint> ReduceToPoints(const PropertyCurve& curve)
{
  std::vector<TransferFunctionPoint> points;
  if (!curve.HasOpacity())
  {
    return points;
  }
  for (const double node : curve.Nodes())
  {
    if (!std::isfinite(node))
    {
      continue;
    }
    const TransferFunctionPoint below = LimitAt(curve, node, -HUGE_VAL);
    const TransferFunctionPoint above = LimitAt(curve, node, HUGE_VAL);
    const bool jump = curve.Difference(below, above) > SmallestJump;
    const TransferFunctionPoint end = jump ? below : curve.At(node);
    if (!points.empty())
    {
      const TransferFunctionPoint previous = points.back();
      Refine(curve, previous, end, MaximumHalvings, points);
    }
    points.push_back(end);
    if (jump)
    {
      points.push_back(above);
    }
  }
  return points;
}

}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> ReducePropertyToPoints(
  vtkVolumeProperty* property, int component, OpacityMeaning meaning)
{
  return ReduceToPoints(PropertyCurve(property, component, meaning));
}

//------------------------------------------------------------------------------
TransferFunctionPoint EvaluateProperty(vtkVolumeProperty* property, double scalar)
{
  return PropertyCurve(property, 0, OpacityMeaning::Alpha).At(scalar);
}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> ReduceGradientOpacityToPoints(vtkVolumeProperty* property)
{
  return ReduceToPoints(PropertyCurve(property->GetGradientOpacity(0)));
}

}

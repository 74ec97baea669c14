// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeFunctions.h"

#include "TestTransferFunctions.h"
#include "VolumeScene.h"

#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace test
{

namespace
{

using Node = reference::TransferFunctionNode;

// Builds functions with scalars as fractions u of the range and attenuations per length of a ray.
class Builder
{
public:
  Builder(const double range[2], double length)
    : Low(range[0])
    , Width(range[1] > range[0] ? range[1] - range[0] : 1.0)
    , Length(length)
  {
  }

  Builder& add(double u, double depth)
  {
    // Colours depend on the place, so that those of neighbouring points differ.
    const double hue = 7.0 * u;
    Node node;
    node.Scalar = this->Low + u * this->Width;
    node.Value.Attenuation = depth / this->Length;
    node.Value.Color = { 0.5 + 0.5 * std::sin(hue), 0.5 + 0.5 * std::sin(hue + 2.0),
      0.5 + 0.5 * std::sin(hue + 4.0) };
    this->Nodes.push_back(node);
    return *this;
  }

  VolumeFunction done() { return std::move(this->Nodes); }

private:
  double Low;
  double Width;
  double Length;
  VolumeFunction Nodes;
};

VolumeFunction manyPoints(Builder builder)
{
  for (int i = 0; i < 1000; ++i)
  {
    builder.add(i / 999.0, i % 3 ? 0.3 : 9.0);
  }
  return builder.done();
}

VolumeFunction manySteps(Builder builder)
{
  for (int i = 0; i <= 20; ++i)
  {
    builder.add(i / 20.0, i % 2 ? 0.0 : 8.0).add(i / 20.0, i % 2 ? 8.0 : 0.0);
  }
  return builder.done();
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<NamedFunction> usualFunctions(vtkUnstructuredGrid* grid)
{
  double range[2];
  grid->GetPointData()->GetScalars()->GetFiniteRange(range);
  const double diagonal = diagonalOf(grid->GetBounds());
  const std::pair<const char*, FunctionKind> kinds[4] = { { "smooth", FunctionKind::Smooth },
    { "peaked", FunctionKind::Peaked }, { "opaque", FunctionKind::Opaque },
    { "sparse", FunctionKind::Sparse } };
  std::vector<NamedFunction> functions;
  for (const auto& kind : kinds)
  {
    const auto property = makeProperty(kind.second, range, diagonal);
    functions.push_back({ kind.first, toReference(property).nodes() });
  }
  return functions;
}

//------------------------------------------------------------------------------
std::vector<NamedFunction> degenerateFunctions(const double range[2], double length)
{
  const Builder b(range, length);
  const auto from = [&b]() { return Builder(b); };
  return {
    { "none", {} },
    { "one point", from().add(0.4, 2.0).done() },
    { "one point, below the range", from().add(-3.0, 2.0).done() },
    { "one jump only", from().add(0.5, 0.0).add(0.5, 3.0).done() },
    { "zero", from().add(0.0, 0.0).add(1.0, 0.0).done() },
    { "20 steps", manySteps(b) },
    { "jump and ramp",
      from().add(0.0, 0.5).add(0.3, 0.5).add(0.3, 6.0).add(0.7, 0.0).add(0.7, 4.0).done() },
    { "step at the lowest scalar", from().add(0.0, 0.0).add(0.0, 2.0).add(1.0, 1.0).done() },
    { "step at the highest scalar", from().add(0.0, 1.0).add(1.0, 2.0).add(1.0, 50.0).done() },
    { "1000 points", manyPoints(b) },
    { "all below the range", from().add(-9.0, 1.0).add(-5.0, 3.0).add(-2.0, 2.0).done() },
    { "all above the range", from().add(2.0, 1.5).add(5.0, 3.0).add(9.0, 2.0).done() },
    { "across the range", from().add(-1e3, 0.0).add(1e3, 4.0).done() },
    { "a window of 1e-6", from().add(0.5, 0.0).add(0.5 + 5e-7, 1e4).add(0.5 + 1e-6, 0.0).done() },
    { "nearly solid", from().add(0.0, 1e6).add(1.0, 2e6).done() },
    { "solid in a shell", from().add(0.45, 0.0).add(0.5, 1e5).add(0.55, 0.0).done() },
    { "faint", from().add(0.0, 1e-6).add(1.0, 1e-5).done() },
  };
}

//------------------------------------------------------------------------------
VolumeFunction randomFunction(const double range[2], double length, RandomNumbers& random)
{
  Builder builder(range, length);
  std::vector<double> places(1 + random.below(12));
  for (double& place : places)
  {
    place = random.uniform(-0.2, 1.2);
  }
  std::sort(places.begin(), places.end());
  const double depth = std::pow(10.0, random.uniform(-1.0, 1.5));
  for (const double place : places)
  {
    builder.add(place, random.below(4) ? random.uniform(0.0, depth) : 0.0);
    if (random.below(4) == 0)
    {
      builder.add(place, random.uniform(0.0, depth));
    }
  }
  return builder.done();
}

//------------------------------------------------------------------------------
double largestAttenuation(const VolumeFunction& function)
{
  double largest = 0.0;
  for (const Node& node : function)
  {
    largest = std::max(largest, node.Value.Attenuation);
  }
  return largest;
}

//------------------------------------------------------------------------------
double brightestColor(const VolumeFunction& function)
{
  double brightest = 0.0;
  for (const Node& node : function)
  {
    brightest =
      std::max({ brightest, node.Value.Color[0], node.Value.Color[1], node.Value.Color[2] });
  }
  return brightest;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> toProperty(const VolumeFunction& function)
{
  // Opacities up to 1, over a unit distance that gives the largest attenuation.
  const double largest = largestAttenuation(function);
  const double unit = largest > 0.0 ? 1.0 / largest : 1.0;
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AllowDuplicateScalarsOn();
  vtkNew<vtkColorTransferFunction> color;
  color->AllowDuplicateScalarsOn();
  for (const Node& node : function)
  {
    const auto& c = node.Value.Color;
    opacity->AddPoint(node.Scalar, node.Value.Attenuation * unit);
    color->AddRGBPoint(node.Scalar, c[0], c[1], c[2]);
  }
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetScalarOpacity(opacity);
  property->SetColor(color);
  property->SetScalarOpacityUnitDistance(unit);
  property->SetInterpolationTypeToLinear();
  return property;
}

} // namespace test
} // namespace meniscus

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeFunctions.h"

#include "TestTransferFunctions.h"
#include "VolumeScene.h"

namespace meniscus::test
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

  Builder& Add(double u, double depth)
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

  VolumeFunction Done() { return std::move(this->Nodes); }

private:
  double Low;
  double Width;
  double Length;
  VolumeFunction Nodes;
};

VolumeFunction ManyPoints(Builder builder)
{
  for (int i = 0; i < 1000; ++i)
  {
    builder.Add(i / 999.0, i % 3 ? 0.3 : 9.0);
  }
  return builder.Done();
}

VolumeFunction ManySteps(Builder builder)
{
  for (int i = 0; i <= 20; ++i)
  {
    builder.Add(i / 20.0, i % 2 ? 0.0 : 8.0).Add(i / 20.0, i % 2 ? 8.0 : 0.0);
  }
  return builder.Done();
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<NamedFunction> UsualFunctions(vtkUnstructuredGrid* grid)
{
  const double diagonal = DiagonalOf(grid->GetBounds());
  const std::pair<const char*, FunctionKind> kinds[4] = { { "smooth", FunctionKind::Smooth },
    { "peaked", FunctionKind::Peaked }, { "opaque", FunctionKind::Opaque },
    { "sparse", FunctionKind::Sparse } };
  std::vector<NamedFunction> functions;
  for (const auto& kind : kinds)
  {
    const auto property = MakeProperty(kind.second, grid, diagonal);
    functions.push_back({ kind.first, ToReference(property).GetNodes() });
  }
  return functions;
}

//------------------------------------------------------------------------------
std::vector<NamedFunction> DegenerateFunctions(const double range[2], double length)
{
  const Builder b(range, length);
  const auto from = [&b]() { return Builder(b); };
  return {
    { "none", {} },
    { "one point", from().Add(0.4, 2.0).Done() },
    { "one point, below the range", from().Add(-3.0, 2.0).Done() },
    { "one jump only", from().Add(0.5, 0.0).Add(0.5, 3.0).Done() },
    { "zero", from().Add(0.0, 0.0).Add(1.0, 0.0).Done() },
    { "20 steps", ManySteps(b) },
    { "jump and ramp",
      from().Add(0.0, 0.5).Add(0.3, 0.5).Add(0.3, 6.0).Add(0.7, 0.0).Add(0.7, 4.0).Done() },
    { "step at the lowest scalar", from().Add(0.0, 0.0).Add(0.0, 2.0).Add(1.0, 1.0).Done() },
    { "step at the highest scalar", from().Add(0.0, 1.0).Add(1.0, 2.0).Add(1.0, 50.0).Done() },
    { "1000 points", ManyPoints(b) },
    { "all below the range", from().Add(-9.0, 1.0).Add(-5.0, 3.0).Add(-2.0, 2.0).Done() },
    { "all above the range", from().Add(2.0, 1.5).Add(5.0, 3.0).Add(9.0, 2.0).Done() },
    { "across the range", from().Add(-1e3, 0.0).Add(1e3, 4.0).Done() },
    { "a window of 1e-6", from().Add(0.5, 0.0).Add(0.5 + 5e-7, 1e4).Add(0.5 + 1e-6, 0.0).Done() },
    { "nearly solid", from().Add(0.0, 1e6).Add(1.0, 2e6).Done() },
    { "solid in a shell", from().Add(0.45, 0.0).Add(0.5, 1e5).Add(0.55, 0.0).Done() },
    { "faint", from().Add(0.0, 1e-6).Add(1.0, 1e-5).Done() },
  };
}

//------------------------------------------------------------------------------
VolumeFunction RandomFunction(const double range[2], double length, RandomNumbers& random)
{
  Builder builder(range, length);
  std::vector<double> places(1 + random.Below(12));
  for (double& place : places)
  {
    place = random.Uniform(-0.2, 1.2);
  }
  std::sort(places.begin(), places.end());
  const double depth = std::pow(10.0, random.Uniform(-1.0, 1.5));
  for (const double place : places)
  {
    builder.Add(place, random.Below(4) ? random.Uniform(0.0, depth) : 0.0);
    if (random.Below(4) == 0)
    {
      builder.Add(place, random.Uniform(0.0, depth));
    }
  }
  return builder.Done();
}

//------------------------------------------------------------------------------
double LargestAttenuation(const VolumeFunction& function)
{
  double largest = 0.0;
  for (const Node& node : function)
  {
    largest = std::max(largest, node.Value.Attenuation);
  }
  return largest;
}

//------------------------------------------------------------------------------
double BrightestColor(const VolumeFunction& function)
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
vtkSmartPointer<vtkVolumeProperty> ToProperty(const VolumeFunction& function)
{
  // Opacities up to 1, over a unit distance that gives the largest attenuation.
  const double largest = LargestAttenuation(function);
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

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestTransferFunctions.h"

namespace meniscus::test
{

namespace
{

void AddColors(vtkColorTransferFunction* color, const double range[2])
{
  const auto at = [range](double u) { return range[0] + u * (range[1] - range[0]); };
  color->AddRGBPoint(at(0.0), 0.10, 0.15, 0.70);
  color->AddRGBPoint(at(0.25), 0.10, 0.75, 0.85);
  color->AddRGBPoint(at(0.5), 0.95, 0.90, 0.30);
  color->AddRGBPoint(at(0.8), 0.90, 0.20, 0.10);
  color->AddRGBPoint(at(1.0), 1.00, 0.85, 0.80);
}

// Opacity nodes (u, opacity), with u as a fraction of the range, and the unit distance as a
// fraction of the diagonal.
struct OpacityShape
{
  std::vector<std::pair<double, double>> Nodes;
  double Unit;
};

OpacityShape ShapeOf(FunctionKind kind)
{
  switch (kind)
  {
    case FunctionKind::Peaked:
    case FunctionKind::Sharp:
    {
      OpacityShape shape{ { { 0.0, 0.0 } }, kind == FunctionKind::Sharp ? 0.01 : 0.1 };
      for (const double u : { 0.12, 0.31, 0.52, 0.77 })
      {
        shape.Nodes.insert(
          shape.Nodes.end(), { { u - 0.01, 0.0 }, { u, 0.5 + 0.5 * u }, { u + 0.01, 0.0 } });
      }
      shape.Nodes.push_back({ 1.0, 0.0 });
      return shape;
    }
    case FunctionKind::Opaque:
      return { { { 0.0, 0.8 }, { 1.0, 1.0 } }, 0.02 };
    case FunctionKind::Sparse:
      return { { { 0.0, 0.0 }, { 0.55, 0.0 }, { 0.6, 0.6 }, { 0.7, 0.4 }, { 0.72, 0.0 },
                 { 1.0, 0.0 } },
        0.02 };
    default:
      return { { { 0.0, 0.02 }, { 0.3, 0.2 }, { 0.65, 0.15 }, { 1.0, 0.9 } }, 0.1 };
  }
}

// One-sided values at a node: a function without clamping jumps to 0 at its ends.
struct OneSided
{
  double Below;
  double Above;
};

OneSided LimitsOf(vtkPiecewiseFunction* function, double scalar)
{
  const double value = function->GetValue(scalar);
  OneSided limits{ value, value };
  if (!function->GetClamping())
  {
    // At its first node itself such a function is 0, so it is evaluated next to the node.
    limits.Below = function->GetValue(std::nextafter(scalar, -HUGE_VAL));
    limits.Above = function->GetValue(std::nextafter(scalar, HUGE_VAL));
  }
  return limits;
}

double AttenuationOf(double opacity, double unit, OpacityModel model)
{
  if (model == OpacityModel::AttenuationCoefficient)
  {
    return opacity / unit;
  }
  // Full opacity is replaced by the largest one below 1 that a float can hold.
  return -std::log1p(-std::min(opacity, 1.0 - 5.9604644775390625e-8)) / unit;
}

std::vector<double> SortedNodes(vtkVolumeProperty* property, OpacityModel model)
{
  std::vector<double> scalars;
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  for (int i = 0; i < opacity->GetSize(); ++i)
  {
    double node[4];
    opacity->GetNodeValue(i, node);
    scalars.push_back(node[0]);
  }
  const bool gray = property->GetColorChannels() == 1;
  const int colors = gray ? property->GetGrayTransferFunction()->GetSize()
                          : property->GetRGBTransferFunction()->GetSize();
  for (int i = 0; i < colors; ++i)
  {
    double node[6];
    gray ? property->GetGrayTransferFunction()->GetNodeValue(i, node)
         : property->GetRGBTransferFunction()->GetNodeValue(i, node);
    scalars.push_back(node[0]);
  }
  std::sort(scalars.begin(), scalars.end());
  scalars.erase(std::unique(scalars.begin(), scalars.end()), scalars.end());
  if (model == OpacityModel::OpacityPerUnitDistance)
  {
    constexpr int parts = 512;
    const std::vector<double> coarse = scalars;
    for (std::size_t i = 0; i + 1 < coarse.size(); ++i)
    {
      for (int part = 1; part < parts; ++part)
      {
        scalars.push_back(coarse[i] + (coarse[i + 1] - coarse[i]) * part / parts);
      }
    }
    std::sort(scalars.begin(), scalars.end());
  }
  return scalars;
}

} // anonymous namespace

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> MakeProperty(
  FunctionKind kind, const double range[2], double diagonal)
{
  const OpacityShape shape = ShapeOf(kind);
  vtkNew<vtkPiecewiseFunction> opacity;
  for (const auto& node : shape.Nodes)
  {
    opacity->AddPoint(range[0] + node.first * (range[1] - range[0]), node.second);
  }
  vtkNew<vtkColorTransferFunction> color;
  AddColors(color, range);
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetScalarOpacity(opacity);
  property->SetColor(color);
  property->SetScalarOpacityUnitDistance(shape.Unit * diagonal);
  property->SetInterpolationTypeToLinear();
  return property;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> MakeProperty(
  FunctionKind kind, vtkDataSet* mesh, double diagonal)
{
  double range[2];
  mesh->GetPointData()->GetScalars()->GetFiniteRange(range);
  return MakeProperty(kind, range, diagonal);
}

void SetPoints(vtkPiecewiseFunction* function, const OpacityNodes& nodes)
{
  function->RemoveAllPoints();
  for (const auto& [scalar, opacity] : nodes)
  {
    function->AddPoint(scalar, opacity);
  }
}

void SetPoints(vtkColorTransferFunction* function, const ColorNodes& nodes)
{
  function->RemoveAllPoints();
  for (const auto& [scalar, red, green, blue] : nodes)
  {
    function->AddRGBPoint(scalar, red, green, blue);
  }
}

vtkSmartPointer<vtkPiecewiseFunction> MakeOpacity(const OpacityNodes& nodes)
{
  auto function = vtkSmartPointer<vtkPiecewiseFunction>::New();
  SetPoints(function, nodes);
  return function;
}

vtkSmartPointer<vtkColorTransferFunction> MakeColors(const ColorNodes& nodes)
{
  auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
  SetPoints(function, nodes);
  return function;
}

//------------------------------------------------------------------------------
void SetMaterial(vtkVolumeProperty* property, bool shade)
{
  property->SetShade(shade);
  property->SetAmbient(0.2);
  property->SetDiffuse(0.6);
  property->SetSpecular(0.4);
  property->SetSpecularPower(12.0);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> MakeConstantProperty(
  double opacity, double red, double green, double blue, double unitDistance)
{
  vtkNew<vtkPiecewiseFunction> opacityFunction;
  vtkNew<vtkColorTransferFunction> color;
  for (const double scalar : { -1e3, 1e3 })
  {
    opacityFunction->AddPoint(scalar, opacity);
    color->AddRGBPoint(scalar, red, green, blue);
  }
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetScalarOpacity(opacityFunction);
  property->SetColor(color);
  property->SetScalarOpacityUnitDistance(unitDistance);
  property->SetInterpolationTypeToLinear();
  return property;
}

//------------------------------------------------------------------------------
reference::ReferenceTransferFunction ToReference(vtkVolumeProperty* property, OpacityModel model)
{
  const double unit = property->GetScalarOpacityUnitDistance();
  std::vector<reference::TransferFunctionNode> nodes;
  for (const double scalar : SortedNodes(property, model))
  {
    const OneSided opacity = LimitsOf(property->GetScalarOpacity(), scalar);
    reference::TransferFunctionNode node;
    node.Scalar = scalar;
    if (property->GetColorChannels() == 1)
    {
      node.Value.Color.fill(property->GetGrayTransferFunction()->GetValue(scalar));
    }
    else
    {
      property->GetRGBTransferFunction()->GetColor(scalar, node.Value.Color.data());
    }
    node.Value.Attenuation = AttenuationOf(opacity.Below, unit, model);
    nodes.push_back(node);
    if (opacity.Above != opacity.Below)
    {
      node.Value.Attenuation = AttenuationOf(opacity.Above, unit, model);
      nodes.push_back(node);
    }
  }
  return reference::ReferenceTransferFunction(nodes);
}

} // namespace meniscus::test

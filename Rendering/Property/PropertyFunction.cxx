// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/PropertyFunction.h"

#include "Rendering/Property/FiniteFunctions.h"

#include "vtkColorTransferFunction.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meniscus
{
namespace
{

/** Largest opacity below 1 that a float can represent. */
constexpr double LargestOpacity = 1.0 - 1.0 / 16777216.0;

std::vector<double> TableOf(vtkPiecewiseFunction* function, double first, double last, int count)
{
  std::vector<double> table(static_cast<std::size_t>(count));
  function->GetTable(first, count > 1 ? last : first, count, table.data());
  return table;
}

/** Nodes of a function, whose node of number i is read by nodeAt(i). */
template <typename NodeAt>
std::vector<FunctionNode> CollectNodes(int count, NodeAt&& nodeAt)
{
  std::vector<FunctionNode> nodes;
  for (int i = 0; i < count; ++i)
  {
    const TransferFunctionPoint value = nodeAt(i);
    if (nodes.empty() || nodes.back().Scalar != value.Scalar)
    {
      nodes.push_back({ value.Scalar, {} });
    }
    nodes.back().Values.push_back(value);
  }
  return nodes;
}

}

//------------------------------------------------------------------------------
double PropertyFunction::GetSampledScalar(double first, double last, int count, int i) const
{
  // As VTK computes it, bit by bit.
  return count > 1
    ? first + (static_cast<double>(i) / static_cast<double>(count - 1)) * (last - first)
    : first;
}

//------------------------------------------------------------------------------
double PropertyFunction::Difference(
  const TransferFunctionPoint& a, const TransferFunctionPoint& b) const
{
  const glm::dvec3 difference = glm::abs(a.Color - b.Color);
  return std::max({ difference.r, difference.g, difference.b });
}

//------------------------------------------------------------------------------
/** Points of a table; colorAt(i) is the colour of entry i. */
template <typename ColorAt>
std::vector<TransferFunctionPoint> PropertyFunction::ListPoints(
  double first, double last, int count, ColorAt&& colorAt) const
{
  std::vector<TransferFunctionPoint> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    points.push_back({ this->GetSampledScalar(first, last, count, i), 0.0, colorAt(i) });
  }
  return points;
}

//------------------------------------------------------------------------------
OpacityFunction::OpacityFunction(
  vtkPiecewiseFunction* opacity, OpacityMeaning meaning, double unitDistance)
  : Opacity(KeepFiniteNodes(opacity))
  , Meaning(meaning)
  , Unit(unitDistance)
{
}

//------------------------------------------------------------------------------
TransferFunctionPoint OpacityFunction::MakePoint(double scalar, double opacity) const
{
  double attenuation = opacity > 0.0 ? opacity : 0.0;
  if (this->Meaning == OpacityMeaning::Attenuation)
  {
    attenuation /= this->Unit;
  }
  else if (this->Meaning == OpacityMeaning::AlphaPerUnitDistance)
  {
    attenuation = -std::log1p(-std::min(attenuation, LargestOpacity)) / this->Unit;
  }
  return { scalar, attenuation, glm::dvec3(0.0) };
}

//------------------------------------------------------------------------------
std::vector<FunctionNode> OpacityFunction::GetNodes() const
{
  return CollectNodes(this->Opacity->GetSize(),
    [this](int i)
    {
      double node[4];
      this->Opacity->GetNodeValue(i, node);
      return this->MakePoint(node[0], node[1]);
    });
}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> OpacityFunction::Sample(
  double first, double last, int count) const
{
  const std::vector<double> table = TableOf(this->Opacity, first, last, count);
  std::vector<TransferFunctionPoint> points;
  points.reserve(table.size());
  for (int i = 0; i < count; ++i)
  {
    points.push_back(this->MakePoint(this->GetSampledScalar(first, last, count, i), table[i]));
  }
  return points;
}

//------------------------------------------------------------------------------
double OpacityFunction::Difference(
  const TransferFunctionPoint& a, const TransferFunctionPoint& b) const
{
  return this->Meaning == OpacityMeaning::Alpha
    ? std::abs(a.Attenuation - b.Attenuation)
    : std::abs(std::exp(-a.Attenuation * this->Unit) - std::exp(-b.Attenuation * this->Unit));
}

//------------------------------------------------------------------------------
GrayFunction::GrayFunction(vtkPiecewiseFunction* gray)
  : Gray(KeepFiniteNodes(gray))
{
}

//------------------------------------------------------------------------------
std::vector<FunctionNode> GrayFunction::GetNodes() const
{
  return CollectNodes(this->Gray->GetSize(),
    [this](int i)
    {
      double node[4];
      this->Gray->GetNodeValue(i, node);
      return TransferFunctionPoint{ node[0], 0.0, glm::dvec3(node[1]) };
    });
}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> GrayFunction::Sample(double first, double last, int count) const
{
  const std::vector<double> table = TableOf(this->Gray, first, last, count);
  return this->ListPoints(first, last, count, [&table](int i) { return glm::dvec3(table[i]); });
}

//------------------------------------------------------------------------------
ColorFunction::ColorFunction(vtkColorTransferFunction* color)
  : Color(KeepFiniteNodes(color))
{
  auto* discrete = vtkDiscretizableColorTransferFunction::SafeDownCast(this->Color);
  this->IsDiscrete = discrete && (discrete->GetDiscretize() || discrete->GetIndexedLookup());
  if (this->IsDiscrete)
  {
    discrete->Build();
  }
  this->IsLogarithmic = !this->IsDiscrete && this->Color->GetScale() == VTK_CTF_LOG10 &&
    this->Color->GetRange()[0] > 0.0;
}

//------------------------------------------------------------------------------
std::vector<FunctionNode> ColorFunction::GetNodes() const
{
  return CollectNodes(this->Color->GetSize(),
    [this](int i)
    {
      double node[6];
      this->Color->GetNodeValue(i, node);
      return TransferFunctionPoint{ node[0], 0.0, glm::dvec3(node[1], node[2], node[3]) };
    });
}

//------------------------------------------------------------------------------
std::vector<TransferFunctionPoint> ColorFunction::Sample(double first, double last, int count) const
{
  const auto size = 3 * static_cast<std::size_t>(count);
  if (this->IsDiscrete)
  {
    // GetTable() ignores the discrete colours, which have 8 bits.
    std::vector<double> scalars;
    for (int i = 0; i < count; ++i)
    {
      scalars.push_back(this->GetSampledScalar(first, last, count, i));
    }
    std::vector<unsigned char> colors(size);
    this->Color->MapScalarsThroughTable2(
      scalars.data(), colors.data(), VTK_DOUBLE, count, 1, VTK_RGB);
    return this->ListPoints(first, last, count,
      [&colors](int i) { return glm::dvec3(glm::make_vec3(&colors[3 * i])) / 255.0; });
  }
  std::vector<double> table(size);
  this->Color->GetTable(first, count > 1 ? last : first, count, table.data());
  return this->ListPoints(
    first, last, count, [&table](int i) { return glm::make_vec3(&table[3 * i]); });
}

//------------------------------------------------------------------------------
double ColorFunction::GetSampledScalar(double first, double last, int count, int i) const
{
  if (!this->IsLogarithmic)
  {
    return PropertyFunction::GetSampledScalar(first, last, count, i);
  }
  const double start = std::log10(first);
  const double end = std::log10(count > 1 ? last : first);
  return std::pow(10.0, PropertyFunction::GetSampledScalar(start, end, count, i));
}

//------------------------------------------------------------------------------
bool ColorFunction::HasCostlyCalls() const
{
  return !this->IsDiscrete && this->Color->GetColorSpace() == VTK_CTF_LAB_CIEDE2000;
}

}

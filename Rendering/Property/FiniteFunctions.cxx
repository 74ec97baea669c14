// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Property/FiniteFunctions.h"

#include "Rendering/Property/RayCastOptics.h"

#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

namespace meniscus
{
namespace
{

/** Scalar, values, midpoint and sharpness of a node, as VTK's functions return them. */
using OpacityNode = std::array<double, 4>;
using ColorNode = std::array<double, 6>;

OpacityNode NodeOf(vtkPiecewiseFunction* function, int i)
{
  OpacityNode node;
  function->GetNodeValue(i, node.data());
  return node;
}

ColorNode NodeOf(vtkColorTransferFunction* function, int i)
{
  ColorNode node;
  function->GetNodeValue(i, node.data());
  return node;
}

void AddNode(vtkPiecewiseFunction* function, const OpacityNode& node)
{
  function->AddPoint(node[0], node[1], node[2], node[3]);
}

void AddNode(vtkColorTransferFunction* function, const ColorNode& node)
{
  function->AddRGBPoint(node[0], node[1], node[2], node[3], node[4], node[5]);
}

template <std::size_t Size>
bool IsFinite(const std::array<double, Size>& node)
{
  return std::all_of(node.begin(), node.end(), [](double number) { return std::isfinite(number); });
}

template <typename Function>
vtkSmartPointer<Function> KeepFinite(Function* function)
{
  const int size = function->GetSize();
  int finite = 0;
  for (int i = 0; i < size; ++i)
  {
    finite += IsFinite(NodeOf(function, i)) ? 1 : 0;
  }
  if (finite == size)
  {
    return function;
  }
  auto kept = vtkSmartPointer<Function>::Take(function->NewInstance());
  kept->DeepCopy(function);
  kept->RemoveAllPoints();
  for (int i = 0; i < size; ++i)
  {
    if (IsFinite(NodeOf(function, i)))
    {
      AddNode(kept.Get(), NodeOf(function, i));
    }
  }
  return kept;
}

/** Sentence about the nodes of a function that are not finite; empty if there are none. */
template <typename Function>
std::string DescribeNodes(const std::string& name, Function* function)
{
  int count = 0;
  std::ostringstream first;
  for (int i = 0; i < function->GetSize(); ++i)
  {
    const auto node = NodeOf(function, i);
    if (!IsFinite(node) && ++count == 1)
    {
      // Midpoint and sharpness come last, and mostly are defaults.
      const std::size_t last = node.size() - 1;
      const bool hasShape = std::isfinite(node[last - 1]) && std::isfinite(node[last]);
      for (std::size_t j = 0; j < (hasShape ? last - 1 : last + 1); ++j)
      {
        first << (j == 0 ? "" : ", ") << node[j];
      }
    }
  }
  if (count == 0)
  {
    return std::string();
  }
  std::ostringstream text;
  text << count << " of the " << function->GetSize() << " nodes of the " << name
       << (count == 1 ? " is" : " are") << " not finite"
       << (count == 1 ? ", (" : ", the first of them (") << first.str() << ")";
  return text.str();
}

/** Sentence about the nodes of a function that are negative; empty if there are none. */
std::string DescribeNegative(const std::string& name, vtkPiecewiseFunction* function)
{
  int count = 0;
  for (int i = 0; i < function->GetSize(); ++i)
  {
    const OpacityNode node = NodeOf(function, i);
    count += IsFinite(node) && node[1] < 0.0 ? 1 : 0;
  }
  return count == 0 ? std::string()
                    : std::to_string(count) + " of the " + std::to_string(function->GetSize()) +
      " nodes of the " + name + (count == 1 ? " is" : " are") + " negative";
}

/** True if the values between nodes are the means of theirs. */
bool IsStraight(vtkPiecewiseFunction*)
{
  return true;
}

bool IsStraight(vtkColorTransferFunction* function)
{
  return function->GetColorSpace() == VTK_CTF_RGB && function->GetScale() == VTK_CTF_LINEAR;
}

/**
 * Sentence about two nodes, the first ones whose distance exceeds the largest number, and between
 * which the function is not straight; empty if there are none.
 */
template <typename Function>
std::string DescribeWidths(const std::string& name, Function* function)
{
  for (int i = 0; i + 1 < function->GetSize(); ++i)
  {
    const auto node = NodeOf(function, i);
    const auto next = NodeOf(function, i + 1);
    // Midpoint and sharpness come last.
    const bool isLinear = node[node.size() - 2] == 0.5 && node.back() == 0.0;
    if (IsFinite(node) && IsFinite(next) && !std::isfinite(next[0] - node[0]) &&
      !(isLinear && IsStraight(function)))
    {
      std::ostringstream text;
      text << "The nodes of the " << name << " at " << node[0] << " and " << next[0]
           << " are too far apart for a curve between them";
      return text.str();
    }
  }
  return std::string();
}

void AddSentence(const std::string& sentence, const std::string& remedy, InputReport& report)
{
  if (!sentence.empty())
  {
    report.Warning += (report.Warning.empty() ? "" : " ") + sentence + remedy;
  }
}

template <typename Function>
void AddNodes(const std::string& name, Function* function, InputReport& report)
{
  AddSentence(DescribeNodes(name, function), ": left out; set finite numbers.", report);
  AddSentence(DescribeWidths(name, function), ": it is straight; use smaller scalars.", report);
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPiecewiseFunction> KeepFiniteNodes(vtkPiecewiseFunction* function)
{
  return KeepFinite(function);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkColorTransferFunction> KeepFiniteNodes(vtkColorTransferFunction* function)
{
  vtkSmartPointer<vtkColorTransferFunction> kept = KeepFinite(function);
  auto* discrete = vtkDiscretizableColorTransferFunction::SafeDownCast(function);
  if (discrete && kept != function)
  {
    // These are not among the things that VTK copies.
    auto* copy = vtkDiscretizableColorTransferFunction::SafeDownCast(kept);
    copy->SetDiscretize(discrete->GetDiscretize());
    copy->SetNumberOfValues(discrete->GetNumberOfValues());
    copy->SetUseLogScale(discrete->GetUseLogScale());
  }
  return kept;
}

//------------------------------------------------------------------------------
InputReport CheckFunctions(vtkVolumeProperty* property, int component, OpacityMeaning meaning)
{
  InputReport report;
  const double unit = property->GetScalarOpacityUnitDistance(component);
  if (meaning != OpacityMeaning::Alpha && !(unit > 0.0 && std::isfinite(unit)))
  {
    std::ostringstream text;
    text << "The ScalarOpacityUnitDistance of the volume property is " << unit
         << "; it must be a finite length above 0";
    report.Error = text.str();
    return report;
  }
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity(component);
  const std::string ofOpacity = DescribeNodes("scalar opacity", opacity);
  if (!ofOpacity.empty() && KeepFiniteNodes(opacity)->GetSize() == 0)
  {
    report.Error = ofOpacity + ", and no other node is left; set finite numbers";
    return report;
  }
  AddNodes("scalar opacity", opacity, report);
  AddSentence(
    DescribeNegative("scalar opacity", opacity), ": negative opacities count as 0.", report);
  if (property->GetColorChannels(component) == 1)
  {
    AddNodes("grey levels", property->GetGrayTransferFunction(component), report);
  }
  else
  {
    AddNodes("colour function", property->GetRGBTransferFunction(component), report);
  }
  if (component == 0 && UsesGradientOpacity(property))
  {
    AddNodes("gradient opacity", property->GetGradientOpacity(0), report);
  }
  return report;
}

//------------------------------------------------------------------------------
std::string CheckIsovalues(vtkVolumeProperty* property)
{
  vtkContourValues* values = property->GetIsoSurfaceValues();
  for (int i = 0; i < values->GetNumberOfContours(); ++i)
  {
    if (!std::isfinite(values->GetValue(i)))
    {
      std::ostringstream text;
      text << "The isovalue of number " << i << " is " << values->GetValue(i)
           << " and shows no surface; set a finite number.";
      return text.str();
    }
  }
  return std::string();
}

}

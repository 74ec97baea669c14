// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/PlaneLanes.h"

#include "Refraction/Membrane/Optics.h"
#include "Simd/LaneLoop.h"

namespace meniscus
{
namespace
{

/** Thickness of the part of a layer that is in front of a point. */
inline double GetThickness(const PlaneLayer& layer, double depth)
{
  return std::min(layer.End, depth) - layer.Begin;
}

/** Loop bodies, for one lane each. */
struct ClearKernel
{
  void operator()(PlaneLanes& lanes, int i) const
  {
    lanes.Reached[i] = 0.0;
    lanes.Slope[i] = 0.0;
    lanes.Bend[i] = 0.0;
  }
};

struct AddKernel
{
  PlaneLayer Layer;

  void operator()(PlaneLanes& lanes, int i) const
  {
    LateralSum sum{ lanes.Reached[i], lanes.Slope[i], lanes.Bend[i] };
    sum.Add(GetThickness(this->Layer, lanes.Depth[i]), this->Layer.Squared, lanes.Tangent[i]);
    lanes.Reached[i] = sum.Reached;
    lanes.Slope[i] = sum.Slope;
    lanes.Bend[i] = sum.Bend;
  }
};

struct StepKernel
{
  void operator()(PlaneLanes& lanes, int i) const
  {
    const LateralSum sum{ lanes.Reached[i], lanes.Slope[i], lanes.Bend[i] };
    const double step = sum.GetStep(lanes.Distance[i], lanes.Tangent[i]);
    // The straight way has the least tangent.
    const double t = std::max(lanes.Tangent[i] + step, lanes.Distance[i] / lanes.Depth[i]);
    lanes.Tangent[i] = t;
    lanes.IsOpen[i] = std::fabs(step) > LateralSum::LastStep * t ? 1.0 : 0.0;
  }
};

struct PassKernel
{
  PlaneLayer Layer;

  void operator()(PlaneLanes& lanes, int i) const
  {
    const double t = lanes.Tangent[i];
    const double scale = LateralSum::GetScale(this->Layer.Squared, t);
    const double thickness = GetThickness(this->Layer, lanes.Depth[i]);
    // Sines are t / sqrt(1 + t^2) / r, and tangents t scale.
    const double secant = scale * std::sqrt(this->Layer.Squared * (1.0 + t * t));
    lanes.Cosine[i] = 1.0 / secant;
    lanes.Length[i] = thickness * secant;
    lanes.Side[i] += thickness * scale * t;
    lanes.Geometric[i] += lanes.Length[i];
    lanes.Optical[i] += lanes.Length[i] / this->Layer.Index;
  }
};

/** Passes the plane behind a layer. */
struct TransmitKernel
{
  double Before;
  double Behind;

  void operator()(PlaneLanes& lanes, int i) const
  {
    PlateTransmittance light;
    light.Across = { lanes.Passed[0][i], lanes.ReflectedBack[0][i] };
    light.Within = { lanes.Passed[1][i], lanes.ReflectedBack[1][i] };
    light.Add(lanes.Cosine[i], this->Before, this->Behind);
    lanes.Passed[0][i] = light.Across.Passed;
    lanes.ReflectedBack[0][i] = light.Across.ReflectedBack;
    lanes.Passed[1][i] = light.Within.Passed;
    lanes.ReflectedBack[1][i] = light.Within.ReflectedBack;
  }
};

/** Starts the sums behind the first layer. */
struct FirstKernel
{
  double Before;
  double Behind;

  void operator()(PlaneLanes& lanes, int i) const
  {
    lanes.FirstCosine[i] = lanes.Cosine[i];
    lanes.Reflectance[i] = FresnelReflectance(lanes.Cosine[i], this->Before, this->Behind);
    lanes.Geometric[i] = 0.0;
    lanes.Optical[i] = 0.0;
  }
};

}

//------------------------------------------------------------------------------
// Searches begin at the tangents that the slope on the axis gives: too small, since lateral
// distances are concave.
void PlaneLanes::FindTangents(const std::vector<PlaneLayer>& layers, InstructionSet set)
{
  std::fill(this->Tangent, this->Tangent + Most, 0.0);
  this->RefineTangents(layers, set);
}

//------------------------------------------------------------------------------
void PlaneLanes::RefineTangents(const std::vector<PlaneLayer>& layers, InstructionSet set)
{
  bool isOpen = true;
  for (int i = 0; i < LateralSum::MostSteps && isOpen; ++i)
  {
    RunLanes(ClearKernel{}, set, *this);
    for (const PlaneLayer& layer : layers)
    {
      RunLanes(AddKernel{ layer }, set, *this);
    }
    RunLanes(StepKernel{}, set, *this);
    isOpen =
      std::any_of(this->IsOpen, this->IsOpen + this->Count, [](double open) { return open > 0.0; });
  }
}

//------------------------------------------------------------------------------
void PlaneLanes::Pass(const std::vector<PlaneLayer>& layers, std::size_t layer, InstructionSet set)
{
  if (layer == 0)
  {
    std::fill(this->Side, this->Side + Most, 0.0);
    std::fill(this->Geometric, this->Geometric + Most, 0.0);
    std::fill(this->Optical, this->Optical + Most, 0.0);
    for (int polarisation = 0; polarisation < 2; ++polarisation)
    {
      std::fill(this->Passed[polarisation], this->Passed[polarisation] + Most, 1.0);
      std::fill(this->ReflectedBack[polarisation], this->ReflectedBack[polarisation] + Most, 0.0);
    }
  }
  RunLanes(PassKernel{ layers[layer] }, set, *this);
  if (layer == 0)
  {
    RunLanes(FirstKernel{ layers[0].Index, layers[1].Index }, set, *this);
  }
  if (layer + 1 < layers.size())
  {
    RunLanes(TransmitKernel{ layers[layer].Index, layers[layer + 1].Index }, set, *this);
  }
}

}

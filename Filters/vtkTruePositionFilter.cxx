// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTruePositionFilter.h"

#include "Common/CoherentOrder.h"
#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Filters/Common/NamedArray.h"
#include "Filters/Common/PointCoordinates.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Membrane/PointEyes.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Refraction/Stack/StackInverse.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace
{

// Points per task of a thread, which share a chain of crossings.
constexpr vtkIdType Chain = 512;

static_assert(
  vtkTruePositionFilter::UNREFRACTED == static_cast<int>(meniscus::SeenState::Unrefracted) &&
    vtkTruePositionFilter::REFRACTED == static_cast<int>(meniscus::SeenState::Refracted) &&
    vtkTruePositionFilter::TOTALLY_REFLECTED ==
      static_cast<int>(meniscus::SeenState::TotallyReflected) &&
    vtkTruePositionFilter::NOT_FINITE == static_cast<int>(meniscus::SeenState::NotFinite) &&
    vtkTruePositionFilter::MISSED == static_cast<int>(meniscus::SeenState::Missed),
  "the same states");

static_assert(vtkTruePositionFilter::APPARENT == static_cast<int>(meniscus::SeenDepth::Apparent) &&
    vtkTruePositionFilter::OPTICAL == static_cast<int>(meniscus::SeenDepth::Optical) &&
    vtkTruePositionFilter::GEOMETRIC == static_cast<int>(meniscus::SeenDepth::Geometric),
  "the same depths");

/** Arrays of the output. */
struct SeenPointArrays
{
  vtkSmartPointer<vtkDoubleArray> Positions;
  vtkSmartPointer<vtkUnsignedCharArray> States;
  vtkSmartPointer<vtkDoubleArray> SightPoints;
  vtkSmartPointer<vtkDoubleArray> Paths;

  explicit SeenPointArrays(std::size_t count)
    : Positions(meniscus::MakeArray<vtkDoubleArray>(nullptr, 3, count))
    , States(meniscus::MakeArray<vtkUnsignedCharArray>("SeenState", 1, count))
    , SightPoints(meniscus::MakeArray<vtkDoubleArray>("SightPoint", 3, count))
    , Paths(meniscus::MakeArray<vtkDoubleArray>("OpticalPath", 1, count))
  {
  }
};

}

//------------------------------------------------------------------------------
class vtkTruePositionFilter::vtkInternals
{
public:
  /** Coordinates of the points, and the order in which they are solved: see FindCoherentOrder(). */
  std::vector<double> Coordinates;
  std::vector<std::uint32_t> Order;
  vtkTypeInt64 TotallyReflected = 0;
  vtkTypeInt64 Missed = 0;

  /** The order is kept while no coordinate changes. */
  void UpdatePoints(vtkPointSet* points)
  {
    std::vector<double> coordinates = meniscus::CopyPoints(points);
    if (coordinates != this->Coordinates)
    {
      this->Coordinates = std::move(coordinates);
      this->Order = meniscus::FindCoherentOrder(
        this->Coordinates.data(), this->Coordinates.size() / 3, meniscus::ThreadedLoop);
    }
  }
};

vtkStandardNewMacro(vtkTruePositionFilter);
meniscusSetClampMacro(vtkTruePositionFilter, Depth, int, APPARENT, GEOMETRIC);
meniscusGetInternalMacro(
  vtkTruePositionFilter, vtkTypeInt64, NumberOfTotallyReflectedPoints() const, TotallyReflected);
meniscusGetInternalMacro(vtkTruePositionFilter, vtkTypeInt64, NumberOfMissedPoints() const, Missed);

//------------------------------------------------------------------------------
vtkTruePositionFilter::vtkTruePositionFilter()
  : Internals(std::make_unique<vtkInternals>())
{
}

//------------------------------------------------------------------------------
vtkTruePositionFilter::~vtkTruePositionFilter() = default;

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfEyeUpdates() const
{
  return this->GetScene().GetNumberOfEyeUpdates();
}

//------------------------------------------------------------------------------
// The output has the type of the input.
int vtkTruePositionFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  return this->vtkPointSetAlgorithm::FillOutputPortInformation(port, info);
}

//------------------------------------------------------------------------------
int vtkTruePositionFilter::RequestDataObject(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return this->vtkPointSetAlgorithm::RequestDataObject(request, inputs, outputs);
}

//------------------------------------------------------------------------------
int vtkTruePositionFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  this->Internals->TotallyReflected = 0;
  this->Internals->Missed = 0;
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  vtkPointSet* output = vtkPointSet::GetData(outputs);
  meniscus::PointEyes eyes;
  if (!this->UpdateScene(input, inputs[1], eyes))
  {
    return 0;
  }
  output->ShallowCopy(input);
  if (input->GetNumberOfPoints() > 0 && !this->MovePoints(input, eyes, output))
  {
    output->Initialize();
  }
  return 1;
}

//------------------------------------------------------------------------------
/** Returns false after an abort. */
bool vtkTruePositionFilter::MovePoints(
  vtkPointSet* input, const meniscus::PointEyes& eyes, vtkPointSet* output)
{
  const vtkIdType count = input->GetNumberOfPoints();
  SeenPointArrays arrays(static_cast<std::size_t>(count));
  this->Internals->UpdatePoints(input);
  const std::vector<double>& coordinates = this->Internals->Coordinates;
  const std::vector<std::uint32_t>& order = this->Internals->Order;
  const double medium = this->GetExteriorIndexOfRefraction();
  const auto depth = static_cast<meniscus::SeenDepth>(this->Depth);
  // One chain.
  const auto move = [&](vtkIdType begin, vtkIdType end)
  {
    meniscus::SightRayTracer tracer(this->GetStack(), medium);
    meniscus::StackChain chain;
    for (vtkIdType number = begin; number < end; ++number)
    {
      const vtkIdType i = order.empty() ? number : order[static_cast<std::size_t>(number)];
      const double* p = coordinates.data() + 3 * i;
      const glm::dvec3 seen(p[0], p[1], p[2]);
      const meniscus::TruePosition found = eyes.IsPerPoint()
        ? meniscus::FindTruePosition(tracer, eyes.Get(i), seen, &chain, depth)
        : meniscus::FindTruePosition(this->GetStack(), medium, seen, &chain, depth);
      arrays.Positions->SetTypedTuple(i, &found.Position.x);
      arrays.SightPoints->SetTypedTuple(i, &found.SightPoint.x);
      arrays.States->SetValue(i, static_cast<unsigned char>(found.State));
      arrays.Paths->SetValue(i, found.OpticalPath);
    }
  };
  // Threads take whole chains, so that results do not depend on the threads.
  const auto moveChains = [&move](vtkIdType begin, vtkIdType end)
  {
    meniscus::ThreadedFor(0, (end - begin + Chain - 1) / Chain, 1,
      [&](vtkIdType first, vtkIdType last)
      {
        for (vtkIdType i = first; i < last; ++i)
        {
          move(begin + i * Chain, std::min(begin + (i + 1) * Chain, end));
        }
      });
  };
  if (!this->RunInSteps(count, moveChains))
  {
    return false;
  }
  const unsigned char* states = arrays.States->GetPointer(0);
  const auto countState = [states, count](SeenStates state)
  { return std::count(states, states + count, static_cast<unsigned char>(state)); };
  this->Internals->TotallyReflected = countState(TOTALLY_REFLECTED);
  this->Internals->Missed = countState(MISSED);
  vtkNew<vtkPoints> points;
  points->SetData(arrays.Positions);
  output->SetPoints(points);
  output->GetPointData()->AddArray(arrays.States);
  output->GetPointData()->AddArray(arrays.SightPoints);
  output->GetPointData()->AddArray(arrays.Paths);
  return true;
}

//------------------------------------------------------------------------------
void vtkTruePositionFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Depth: " << this->Depth << "\n";
  os << indent << "NumberOfTotallyReflectedPoints: " << this->GetNumberOfTotallyReflectedPoints()
     << "\n";
  os << indent << "NumberOfMissedPoints: " << this->GetNumberOfMissedPoints() << "\n";
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTruePositionFilter.h"

#include "Common/CoherentOrder.h"
#include "Filters/Common/PointCoordinates.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Filters/Membrane/PointEyes.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Filters/Membrane/StackInput.h"
#include "Refraction/Curved/TruePositions.h"
#include "Refraction/Stack/StackInverse.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace
{

// Points per task of a thread.
constexpr auto Chain = static_cast<vtkIdType>(meniscus::TruePositions::Chain);

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
struct PointArrays
{
  vtkNew<vtkDoubleArray> Positions;
  vtkNew<vtkUnsignedCharArray> States;
  vtkNew<vtkDoubleArray> SightPoints;
  vtkNew<vtkDoubleArray> Paths;

  explicit PointArrays(vtkIdType count)
  {
    this->States->SetName("SeenState");
    this->SightPoints->SetName("SightPoint");
    this->Paths->SetName("OpticalPath");
    for (vtkDoubleArray* vectors : { this->Positions.Get(), this->SightPoints.Get() })
    {
      vectors->SetNumberOfComponents(3);
    }
    for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{
           this->Positions, this->States, this->SightPoints, this->Paths })
    {
      array->SetNumberOfTuples(count);
    }
  }
};

}

//------------------------------------------------------------------------------
class vtkTruePositionFilter::vtkInternals
{
public:
  meniscus::RefractionScene Scene; ///< one interface; several are in GetStackScene()
  // State and indices in the last run.
  bool HasStack = false; ///< several interfaces, or several eyes
  meniscus::PointEyes Eyes;
  double Exterior = 1.0;
  double Interior = 1.0;
  /** Properties of the membrane: see PatchBuild. */
  meniscus::SteepDirections Steep;
  vtkTypeInt64 PatchBuild = -1;
  /** Search of sight rays, made for an eye and a membrane: see EyeUpdate. */
  std::unique_ptr<meniscus::TruePositions> Truth;
  vtkTypeInt64 EyeUpdate = -1;
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

  void UpdateTruth()
  {
    const meniscus::CurvedMembraneSolver& solver = this->Scene.GetCurved();
    if (this->PatchBuild != this->Scene.GetNumberOfPatchBuilds())
    {
      this->Steep.Build(solver.GetMembrane(), solver.GetPatches());
      this->PatchBuild = this->Scene.GetNumberOfPatchBuilds();
    }
    if (this->EyeUpdate != this->Scene.GetNumberOfEyeUpdates())
    {
      this->Truth = std::make_unique<meniscus::TruePositions>(solver, this->Steep);
      this->EyeUpdate = this->Scene.GetNumberOfEyeUpdates();
    }
  }

  /** True position behind one interface, after the points of `chain`. */
  meniscus::StackTruePosition FindOne(
    const glm::dvec3& seen, meniscus::CrossingChain& chain, meniscus::SeenDepth depth) const
  {
    const glm::dvec3 eye = this->Eyes.Get(0);
    meniscus::TruePosition found = this->Truth->Find(seen, chain, depth);
    const bool refracted = found.State == meniscus::SeenState::Refracted;
    const double path = refracted ? this->Exterior * glm::length(found.SightPoint - eye) +
        this->Interior * glm::length(found.Position - found.SightPoint)
                                  : this->Exterior * glm::length(seen - eye);
    // Equal indices change no bit.
    found.Position = this->Exterior == this->Interior ? seen : found.Position;
    return { found, path };
  }
};

vtkStandardNewMacro(vtkTruePositionFilter);

//------------------------------------------------------------------------------
vtkTruePositionFilter::vtkTruePositionFilter()
  : Internals(std::make_unique<vtkInternals>())
{
}

//------------------------------------------------------------------------------
vtkTruePositionFilter::~vtkTruePositionFilter() = default;

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfTotallyReflectedPoints() const
{
  return this->Internals->TotallyReflected;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfMissedPoints() const
{
  return this->Internals->Missed;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfPatchBuilds() const
{
  return this->Internals->Scene.GetNumberOfPatchBuilds() +
    this->Superclass::GetNumberOfPatchBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfEyeUpdates() const
{
  return this->Internals->Scene.GetNumberOfEyeUpdates() +
    this->GetStackScene().GetNumberOfEyeUpdates();
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
  this->Internals->TotallyReflected = 0;
  this->Internals->Missed = 0;
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  vtkPolyData* membrane = vtkPolyData::GetData(inputs[1]);
  vtkPointSet* output = vtkPointSet::GetData(outputs);
  if (!input || !membrane || !output)
  {
    vtkErrorMacro("The points are missing, or the membrane is not a vtkPolyData; the output is "
                  "empty.");
    return 0;
  }
  if (!this->UpdateRefraction(input, inputs[1]))
  {
    return 0;
  }
  output->ShallowCopy(input);
  if (input->GetNumberOfPoints() > 0 && !this->MovePoints(input, output))
  {
    output->Initialize();
  }
  return 1;
}

//------------------------------------------------------------------------------
/** Sets membranes and eye. Returns false after an error. */
bool vtkTruePositionFilter::UpdateRefraction(vtkPointSet* points, vtkInformationVector* membranes)
{
  vtkInternals& internals = *this->Internals;
  meniscus::SceneMessages messages;
  const double* place = this->GetEyePosition();
  internals.Eyes = meniscus::PointEyes(place);
  messages.Error = internals.Eyes.UseArray(points, this->GetEyeArrayName());
  const bool hasEyes = internals.Eyes.IsPerPoint();
  vtkRefractingInterfaceCollection* interfaces = this->GetInterfaces();
  internals.HasStack = hasEyes || meniscus::HasStack(interfaces, membranes);
  internals.Exterior = this->GetExteriorIndexOfRefraction();
  internals.Interior = this->GetInteriorIndexOfRefraction();
  bool ready = messages.Error.empty();
  if (!ready)
  {
    // The error is reported below.
  }
  else if (hasEyes)
  {
    ready = meniscus::UpdateSurfaces(this->GetStackScene(), membranes, 1, interfaces, messages);
    if (ready)
    {
      this->GetStackScene().ReportEyes(
        internals.Eyes.GetSample(points->GetNumberOfPoints()), messages);
    }
  }
  else if (internals.HasStack)
  {
    ready = meniscus::UpdateStack(
      this->GetStackScene(), membranes, 1, interfaces, { place[0], place[1], place[2] }, messages);
  }
  else
  {
    const meniscus::RefractionScene::Eye eye = { place[0], place[1], place[2], internals.Exterior,
      internals.Interior };
    ready = internals.Scene.SetMembrane(vtkPolyData::GetData(membranes), true, messages,
              interfaces->GetFirstInterface()->GetExactSurface()) &&
      internals.Scene.SetEye(
        { eye, false, interfaces->GetFirstInterface()->GetTurnTowardsEye() }, messages);
  }
  if (ready && !internals.HasStack)
  {
    internals.UpdateTruth();
  }
  meniscus::Report(this, messages);
  return ready;
}

//------------------------------------------------------------------------------
/** Returns false after an abort. */
bool vtkTruePositionFilter::MovePoints(vtkPointSet* input, vtkPointSet* output)
{
  const vtkIdType count = input->GetNumberOfPoints();
  PointArrays arrays(count);
  const vtkInternals& internals = *this->Internals;
  this->Internals->UpdatePoints(input);
  const std::vector<double>& coordinates = internals.Coordinates;
  const std::vector<std::uint32_t>& order = internals.Order;
  const auto depth = static_cast<meniscus::SeenDepth>(this->Depth);
  // One chain.
  const auto move = [&](vtkIdType begin, vtkIdType end)
  {
    meniscus::SightRayTracer tracer(this->GetStack(), internals.Exterior);
    meniscus::StackChain chains;
    meniscus::CrossingChain chain;
    for (vtkIdType number = begin; number < end; ++number)
    {
      const vtkIdType i = order.empty() ? number : order[static_cast<std::size_t>(number)];
      const double* p = coordinates.data() + 3 * i;
      const glm::dvec3 seen(p[0], p[1], p[2]);
      const meniscus::StackTruePosition found = internals.Eyes.IsPerPoint()
        ? meniscus::FindTruePosition(tracer, internals.Eyes.Get(i), seen, &chains, depth)
        : (internals.HasStack ? meniscus::FindTruePosition(
                                  tracer.GetStack(), internals.Exterior, seen, &chains, depth)
                              : internals.FindOne(seen, chain, depth));
      arrays.Positions->SetTypedTuple(i, &found.Position.x);
      arrays.SightPoints->SetTypedTuple(i, &found.SightPoint.x);
      arrays.States->SetValue(i, static_cast<unsigned char>(found.State));
      arrays.Paths->SetValue(i, found.OpticalPath);
    }
  };
  // Threads take whole chains, so that results do not depend on the threads.
  const auto moveChains = [&move](vtkIdType begin, vtkIdType end)
  {
    vtkSMPTools::For(0, (end - begin + Chain - 1) / Chain, 1,
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

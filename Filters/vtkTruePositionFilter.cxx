// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTruePositionFilter.h"

#include "Filters/Interface/InterfaceProperties.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Refraction/Curved/TruePositions.h"

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

namespace
{

// Points between two reports of progress, at least, and per task of a thread.
constexpr vtkIdType SmallestStep = 16384;
constexpr vtkIdType ProgressSteps = 20;
constexpr vtkIdType Grain = 512;

static_assert(
  vtkTruePositionFilter::UNREFRACTED == static_cast<int>(meniscus::SeenState::Unrefracted) &&
    vtkTruePositionFilter::REFRACTED == static_cast<int>(meniscus::SeenState::Refracted) &&
    vtkTruePositionFilter::TOTALLY_REFLECTED ==
      static_cast<int>(meniscus::SeenState::TotallyReflected) &&
    vtkTruePositionFilter::NOT_FINITE == static_cast<int>(meniscus::SeenState::NotFinite),
  "the same states");

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
  meniscus::RefractionScene Scene;
  /** Search of sight rays, made for an eye and a membrane: see EyeUpdate. */
  std::unique_ptr<meniscus::TruePositions> Truth;
  vtkTypeInt64 EyeUpdate = -1;
  vtkTypeInt64 TotallyReflected = 0;

  const meniscus::TruePositions& GetTruth()
  {
    if (this->EyeUpdate != this->Scene.GetNumberOfEyeUpdates())
    {
      this->Truth = std::make_unique<meniscus::TruePositions>(this->Scene.GetCurved());
      this->EyeUpdate = this->Scene.GetNumberOfEyeUpdates();
    }
    return *this->Truth;
  }
};

vtkStandardNewMacro(vtkTruePositionFilter);
meniscusInterfacePropertiesMacro(vtkTruePositionFilter);
meniscusMembranePortMacro(vtkTruePositionFilter, 1);

//------------------------------------------------------------------------------
vtkTruePositionFilter::vtkTruePositionFilter()
  : Interfaces(meniscus::MakeInterfaces())
  , Internals(std::make_unique<vtkInternals>())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkTruePositionFilter::~vtkTruePositionFilter() = default;

//------------------------------------------------------------------------------
void vtkTruePositionFilter::SetMembraneData(vtkPolyData* membrane)
{
  this->SetInputDataInternal(1, membrane);
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfTotallyReflectedPoints() const
{
  return this->Internals->TotallyReflected;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfPatchBuilds() const
{
  return this->Internals->Scene.GetNumberOfPatchBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTruePositionFilter::GetNumberOfEyeUpdates() const
{
  return this->Internals->Scene.GetNumberOfEyeUpdates();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTruePositionFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Interfaces->GetMTime());
}

//------------------------------------------------------------------------------
int vtkTruePositionFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 1 ? "vtkPolyData" : "vtkPointSet");
  return 1;
}

//------------------------------------------------------------------------------
// Every piece of the points needs the whole membrane.
int vtkTruePositionFilter::ComputeInputUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int result = this->Superclass::ComputeInputUpdateExtent(request, inputs, outputs);
  if (vtkInformation* info = inputs[1]->GetInformationObject(0))
  {
    info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return result;
}

//------------------------------------------------------------------------------
int vtkTruePositionFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Internals->TotallyReflected = 0;
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  vtkPolyData* membrane = vtkPolyData::GetData(inputs[1]);
  vtkPointSet* output = vtkPointSet::GetData(outputs);
  if (!input || !membrane || !output)
  {
    vtkErrorMacro("The points are missing, or the membrane is not a vtkPolyData; the output is "
                  "empty.");
    return 0;
  }
  if (!this->UpdateScene(membrane))
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
/** Sets membrane and eye. Returns false after an error. */
bool vtkTruePositionFilter::UpdateScene(vtkPolyData* membrane)
{
  if (const char* fault = meniscus::FindFault(this->Interfaces))
  {
    vtkErrorMacro(<< fault << "; the output is empty.");
    return false;
  }
  meniscus::RefractionScene& scene = this->Internals->Scene;
  const meniscus::RefractionScene::Eye eye = { this->EyePosition[0], this->EyePosition[1],
    this->EyePosition[2], this->GetExteriorIndexOfRefraction(),
    this->GetInteriorIndexOfRefraction() };
  meniscus::SceneMessages messages;
  const bool ready = scene.SetMembrane(membrane, true, messages,
                       this->Interfaces->GetFirstInterface()->GetExactSurface()) &&
    scene.SetEye(eye, messages);
  if (!messages.Error.empty())
  {
    vtkErrorMacro(<< messages.Error << "; the output is empty.");
  }
  if (!messages.Warning.empty())
  {
    vtkWarningMacro(<< messages.Warning);
  }
  return ready;
}

//------------------------------------------------------------------------------
/** Returns false after an abort. */
bool vtkTruePositionFilter::MovePoints(vtkPointSet* input, vtkPointSet* output)
{
  const vtkIdType count = input->GetNumberOfPoints();
  const glm::dvec3 eye(this->EyePosition[0], this->EyePosition[1], this->EyePosition[2]);
  const double exterior = this->GetExteriorIndexOfRefraction();
  const double interior = this->GetInteriorIndexOfRefraction();
  const meniscus::TruePositions& truth = this->Internals->GetTruth();
  PointArrays arrays(count);
  const auto move = [&](vtkIdType i)
  {
    glm::dvec3 seen;
    input->GetPoint(i, &seen.x);
    meniscus::TruePosition found = truth.Find(seen);
    const bool refracted = found.State == meniscus::SeenState::Refracted;
    const double path = refracted ? exterior * glm::length(found.SightPoint - eye) +
        interior * glm::length(found.Position - found.SightPoint)
                                  : exterior * glm::length(seen - eye);
    // Equal indices change no bit.
    found.Position = exterior == interior ? seen : found.Position;
    arrays.Positions->SetTypedTuple(i, &found.Position.x);
    arrays.SightPoints->SetTypedTuple(i, &found.SightPoint.x);
    arrays.States->SetValue(i, static_cast<unsigned char>(found.State));
    arrays.Paths->SetValue(i, path);
  };
  const vtkIdType step = std::max(count / ProgressSteps, SmallestStep);
  for (vtkIdType first = 0; first < count; first += step)
  {
    const vtkIdType last = std::min(first + step, count);
    vtkSMPTools::For(first, last, Grain,
      [&move](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          move(i);
        }
      });
    this->UpdateProgress(static_cast<double>(last) / static_cast<double>(count));
    if (this->GetAbortExecute())
    {
      return false;
    }
  }
  const unsigned char* states = arrays.States->GetPointer(0);
  this->Internals->TotallyReflected =
    std::count(states, states + count, static_cast<unsigned char>(TOTALLY_REFLECTED));
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
  os << indent << "EyePosition: (" << this->EyePosition[0] << ", " << this->EyePosition[1] << ", "
     << this->EyePosition[2] << ")\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
  os << indent << "NumberOfTotallyReflectedPoints: " << this->GetNumberOfTotallyReflectedPoints()
     << "\n";
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTriangulatedPositionFilter.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Membrane/PointEyes.h"
#include "Refraction/Stack/StackTriangulation.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

static_assert(
  vtkTriangulatedPositionFilter::FOUND == static_cast<int>(meniscus::TriangulationState::Found) &&
    vtkTriangulatedPositionFilter::TOO_FEW_RAYS ==
      static_cast<int>(meniscus::TriangulationState::TooFewRays) &&
    vtkTriangulatedPositionFilter::PARALLEL ==
      static_cast<int>(meniscus::TriangulationState::Parallel) &&
    vtkTriangulatedPositionFilter::NO_MEDIUM ==
      static_cast<int>(meniscus::TriangulationState::NoMedium),
  "the same states");

vtkStandardNewMacro(vtkTriangulatedPositionFilter);

namespace
{

// Points per task of a thread, a few microseconds each.
constexpr vtkIdType TriangulationGrain = 256;

/** Observations in the order of the points that they see, and the first one of each point. */
struct Tracks
{
  std::vector<vtkIdType> Observations;
  std::vector<std::size_t> Begins; ///< and the number of observations
  std::vector<vtkIdType> Ids;
};

/** True if all values are whole numbers that vtkIdType can hold. */
bool AreWhole(vtkDataArray* ids)
{
  if (ids->GetDataType() != VTK_FLOAT && ids->GetDataType() != VTK_DOUBLE)
  {
    return true;
  }
  // The first power of two that is too large; exact as a double.
  const double end = std::ldexp(1.0, std::numeric_limits<vtkIdType>::digits);
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    const double id = ids->GetTuple1(i);
    if (!(id == std::floor(id) && std::fabs(id) < end))
    {
      return false;
    }
  }
  return true;
}

Tracks CollectTracks(vtkDataArray* ids)
{
  Tracks tracks;
  vtkNew<vtkIdTypeArray> exact; // doubles cannot hold numbers above 2^53
  exact->DeepCopy(ids);
  const vtkIdType* values = exact->GetPointer(0);
  tracks.Observations.resize(static_cast<std::size_t>(ids->GetNumberOfTuples()));
  std::iota(tracks.Observations.begin(), tracks.Observations.end(), vtkIdType(0));
  std::stable_sort(tracks.Observations.begin(), tracks.Observations.end(),
    [values](vtkIdType a, vtkIdType b) { return values[a] < values[b]; });
  for (std::size_t i = 0; i < tracks.Observations.size(); ++i)
  {
    const vtkIdType id = values[tracks.Observations[i]];
    if (tracks.Ids.empty() || tracks.Ids.back() != id)
    {
      tracks.Ids.push_back(id);
      tracks.Begins.push_back(i);
    }
  }
  tracks.Begins.push_back(tracks.Observations.size());
  return tracks;
}

/** Points and arrays of the output. */
struct TriangulatedPointArrays
{
  vtkNew<vtkDoubleArray> Positions;
  vtkNew<vtkIdTypeArray> Ids;
  vtkNew<vtkIntArray> Rays;
  vtkNew<vtkDoubleArray> Residuals;
  vtkNew<vtkDoubleArray> Angles;
  vtkNew<vtkUnsignedCharArray> States;

  explicit TriangulatedPointArrays(const std::vector<vtkIdType>& ids)
  {
    this->Positions->SetNumberOfComponents(3);
    this->Ids->SetName("PointId");
    this->Rays->SetName("NumberOfRays");
    this->Residuals->SetName("Residual");
    this->Angles->SetName("RayAngle");
    this->States->SetName("TriangulationState");
    for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{
           this->Positions, this->Ids, this->Rays, this->Residuals, this->Angles, this->States })
    {
      array->SetNumberOfTuples(static_cast<vtkIdType>(ids.size()));
    }
    std::copy(ids.begin(), ids.end(), this->Ids->GetPointer(0));
  }

  void Set(vtkIdType i, const meniscus::TriangulatedPoint& point, std::size_t rays)
  {
    const bool isFound = point.State == meniscus::TriangulationState::Found;
    const glm::dvec3 position =
      isFound ? point.Position : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    this->Positions->SetTypedTuple(i, &position.x);
    this->Rays->SetValue(i, static_cast<int>(rays));
    this->Residuals->SetValue(i, point.Residual);
    this->Angles->SetValue(i, vtkMath::DegreesFromRadians(point.Angle));
    this->States->SetValue(i, static_cast<unsigned char>(point.State));
  }

  void MoveTo(vtkPolyData* output)
  {
    vtkNew<vtkPoints> points;
    points->SetData(this->Positions);
    output->SetPoints(points);
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType i = 0; i < this->Ids->GetNumberOfTuples(); ++i)
    {
      vertices->InsertNextCell(1, &i);
    }
    output->SetVerts(vertices);
    for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{
           this->Ids, this->Rays, this->Residuals, this->Angles, this->States })
    {
      output->GetPointData()->AddArray(array);
    }
  }
};

/** Traces the ray of an observation. Returns false if it has none. */
bool TraceObservation(meniscus::SightRayTracer& tracer, const glm::dvec3& eye,
  const glm::dvec3& seen, meniscus::StackSightRay& ray)
{
  const double distance = glm::length(seen - eye);
  if (!std::isfinite(distance) || distance == 0.0 ||
    tracer.SetEye(eye) != meniscus::EyeStatus::Ready || !tracer.IsMediumKnown())
  {
    return false;
  }
  tracer.Trace((seen - eye) / distance, ray);
  return true;
}

}

//------------------------------------------------------------------------------
vtkTriangulatedPositionFilter::vtkTriangulatedPositionFilter()
{
  this->SetEyeArrayName("Eye");
}

//------------------------------------------------------------------------------
void vtkTriangulatedPositionFilter::SetPointIdArrayName(const std::string& name)
{
  if (this->PointIdArrayName != name)
  {
    this->PointIdArrayName = name;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
std::string vtkTriangulatedPositionFilter::GetPointIdArrayName()
{
  return this->PointIdArrayName;
}

//------------------------------------------------------------------------------
int vtkTriangulatedPositionFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  this->WithoutPosition = 0;
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  meniscus::PointEyes eyes;
  if (!this->UpdateScene(input, inputs[1], eyes))
  {
    return 0;
  }
  vtkDataArray* ids = input->GetPointData()->GetArray(this->PointIdArrayName.c_str());
  if (!ids || ids->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("The observations have no array \"" << this->PointIdArrayName
                                                      << "\" with one component; the output is "
                                                         "empty.");
    return 0;
  }
  if (!AreWhole(ids))
  {
    vtkErrorMacro("The array \"" << this->PointIdArrayName
                                 << "\" has values that are not whole numbers, or are too large; "
                                    "the output is empty.");
    return 0;
  }
  const Tracks tracks = CollectTracks(ids);
  TriangulatedPointArrays arrays(tracks.Ids);
  const double medium = this->GetExteriorIndexOfRefraction();
  const auto triangulate = [&](vtkIdType begin, vtkIdType end)
  {
    meniscus::EyeTracers tracers(this->GetStack(), medium);
    std::vector<meniscus::StackSightRay> rays;
    for (vtkIdType i = begin; i < end; ++i)
    {
      const auto track = static_cast<std::size_t>(i);
      std::size_t count = 0;
      rays.resize(tracks.Begins[track + 1] - tracks.Begins[track]);
      for (std::size_t k = tracks.Begins[track]; k < tracks.Begins[track + 1]; ++k)
      {
        const vtkIdType observation = tracks.Observations[k];
        glm::dvec3 seen;
        input->GetPoint(observation, &seen.x);
        const glm::dvec3 eye = eyes.Get(observation);
        count += TraceObservation(tracers.Get(eye), eye, seen, rays[count]) ? 1 : 0;
      }
      rays.resize(count);
      arrays.Set(i, meniscus::Triangulate(rays), count);
    }
  };
  if (!this->RunInSteps(static_cast<vtkIdType>(tracks.Ids.size()),
        [&](vtkIdType begin, vtkIdType end)
        { meniscus::ThreadedFor(begin, end, TriangulationGrain, triangulate); }))
  {
    return 1;
  }
  const unsigned char* states = arrays.States->GetPointer(0);
  this->WithoutPosition = std::count_if(states, states + arrays.States->GetNumberOfTuples(),
    [](unsigned char state) { return state != FOUND; });
  arrays.MoveTo(vtkPolyData::GetData(outputs));
  return 1;
}

//------------------------------------------------------------------------------
void vtkTriangulatedPositionFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PointIdArrayName: " << this->PointIdArrayName << "\n";
  os << indent << "NumberOfPointsWithoutPosition: " << this->WithoutPosition << "\n";
}

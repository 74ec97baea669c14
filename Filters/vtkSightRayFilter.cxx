// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSightRayFilter.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Membrane/PointEyes.h"
#include "Refraction/Stack/StackInverse.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <glm/geometric.hpp>

#include <cmath>

vtkStandardNewMacro(vtkSightRayFilter);

namespace
{

/** Lines of rays and their arrays. */
class RayLines
{
public:
  RayLines()
  {
    this->Points->SetDataTypeToDouble();
    this->Paths->SetName("OpticalPath");
    this->Ids->SetName("PointId");
    this->Legs->SetName("Leg");
    this->Indices->SetName("IndexOfRefraction");
    this->States->SetName("SeenState");
  }

  /** Adds the legs of a ray up to leg `last`, which ends at `end`. */
  void Add(vtkIdType id, const meniscus::StackSightRay& ray, std::size_t last,
    const glm::dvec3& end, meniscus::SeenState state)
  {
    double path = 0.0;
    vtkIdType from = this->AddPoint(ray.Legs.front().Origin, path);
    for (std::size_t k = 0; k <= last; ++k)
    {
      const meniscus::SightLeg& leg = ray.Legs[k];
      const glm::dvec3 to = k < last ? ray.Legs[k + 1].Origin : end;
      path += leg.Index * glm::length(to - leg.Origin);
      const vtkIdType ends[2] = { from, this->AddPoint(to, path) };
      this->Lines->InsertNextCell(2, ends);
      this->Ids->InsertNextValue(id);
      this->Legs->InsertNextValue(static_cast<int>(k));
      this->Indices->InsertNextValue(leg.Index);
      this->States->InsertNextValue(static_cast<unsigned char>(state));
      from = ends[1];
    }
  }

  void MoveTo(vtkPolyData* output)
  {
    output->SetPoints(this->Points);
    output->SetLines(this->Lines);
    output->GetPointData()->AddArray(this->Paths);
    for (vtkDataArray* array :
      std::initializer_list<vtkDataArray*>{ this->Ids, this->Legs, this->Indices, this->States })
    {
      output->GetCellData()->AddArray(array);
    }
  }

private:
  vtkIdType AddPoint(const glm::dvec3& point, double path)
  {
    this->Paths->InsertNextValue(path);
    return this->Points->InsertNextPoint(&point.x);
  }

  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Lines;
  vtkNew<vtkDoubleArray> Paths;
  vtkNew<vtkIdTypeArray> Ids;
  vtkNew<vtkIntArray> Legs;
  vtkNew<vtkDoubleArray> Indices;
  vtkNew<vtkUnsignedCharArray> States;
};

/** Adds the lines of the sight ray to point `id`, unless the point has the state NOT_FINITE. */
void TraceLines(meniscus::SightRayTracer& tracer, const glm::dvec3& eye, const glm::dvec3& seen,
  vtkIdType id, RayLines& lines)
{
  const double distance = glm::length(seen - eye);
  if (!std::isfinite(distance) || distance == 0.0 ||
    tracer.SetEye(eye) != meniscus::EyeStatus::Ready)
  {
    return;
  }
  meniscus::StackSightRay ray;
  tracer.Trace((seen - eye) / distance, ray);
  std::size_t last = 0;
  const meniscus::TruePosition found = meniscus::WalkSightRay(ray, seen, last);
  glm::dvec3 end = found.Position;
  if (found.State == meniscus::SeenState::Missed)
  {
    end = ray.Legs[last--].Origin;
  }
  else if (found.State == meniscus::SeenState::TotallyReflected)
  {
    end = ray.Legs[last].Origin + ray.Legs[last].Length * ray.Legs[last].Direction;
  }
  lines.Add(id, ray, last, end, found.State);
}

}

//------------------------------------------------------------------------------
int vtkSightRayFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  meniscus::PointEyes eyes;
  if (!this->UpdateScene(input, inputs[1], eyes))
  {
    return 0;
  }
  meniscus::SightRayTracer tracer(this->GetStack(), this->GetExteriorIndexOfRefraction());
  RayLines lines;
  const auto trace = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType i = begin; i < end; ++i)
    {
      glm::dvec3 seen;
      input->GetPoint(i, &seen.x);
      TraceLines(tracer, eyes.Get(i), seen, i, lines);
    }
  };
  if (this->RunInSteps(input->GetNumberOfPoints(), trace))
  {
    lines.MoveTo(vtkPolyData::GetData(outputs));
  }
  return 1;
}

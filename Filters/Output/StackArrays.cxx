// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/StackArrays.h"

#include "Refraction/Membrane/VirtualNormal.h"

#include "Refraction/Membrane/Optics.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>

namespace meniscus
{
namespace
{

// Normals that are lit by a light at the eye as the true ones are.
void AddVirtualNormals(vtkPolyData* input, const std::vector<vtkIdType>& sources,
  const std::vector<VirtualVertex>& vertices, const StackDetails& details, const glm::dvec3& eye,
  vtkPolyData* output)
{
  vtkDataArray* trueNormals = output->GetPointData()->GetNormals();
  if (!trueNormals)
  {
    return;
  }
  const auto normals = MakeArray<vtkDoubleArray>("VirtualNormals", 3, sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    const auto source = static_cast<std::size_t>(sources[k]);
    glm::dvec3 normal(0.0);
    glm::dvec3 point(0.0);
    trueNormals->GetTuple(static_cast<vtkIdType>(k), &normal.x);
    input->GetPoint(sources[k], &point.x);
    const double length = glm::length(normal);
    const glm::dvec3 inside = details.Points[source].LastSightPoint - point;
    if (length > 0.0 && std::isfinite(length) && glm::length(inside) > 0.0)
    {
      normal = TurnAlong(
        normal / length, glm::normalize(inside), glm::normalize(eye - vertices[source].SightPoint));
    }
    normals->SetTypedTuple(static_cast<vtkIdType>(k), &normal.x);
  }
  output->GetPointData()->AddArray(normals);
  output->GetPointData()->SetActiveNormals(normals->GetName());
}

}

//------------------------------------------------------------------------------
void AddStackArrays(vtkPolyData* input, const std::vector<VirtualVertex>& vertices,
  const StackDetails& details, const OutputOptions& options, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  auto* ids = vtkIdTypeArray::SafeDownCast(data->GetArray("SourcePointId"));
  const std::vector<vtkIdType> sources(
    ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfTuples());
  const auto transmittance = MakeArray<vtkDoubleArray>("Transmittance", 1, sources.size());
  const auto inner = MakeArray<vtkDoubleArray>("InnerReflectance", 1, sources.size());
  const auto last = MakeArray<vtkDoubleArray>("LastSightPoint", 3, sources.size());
  const auto legs =
    MakeArray<vtkDoubleArray>("LegLengths", static_cast<int>(details.Interfaces), sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    const auto i = static_cast<vtkIdType>(k);
    const auto source = static_cast<std::size_t>(sources[k]);
    const StackDetail& detail = details.Points[source];
    transmittance->SetValue(i, detail.Transmittance);
    const double first = 1.0 -
      (detail.Passed > 0
          ? FresnelReflectance(vertices[source].Cosine, options.Exterior, options.Interior)
          : 0.0);
    inner->SetValue(i, 1.0 - detail.Transmittance / first);
    last->SetTypedTuple(i, &detail.LastSightPoint.x);
    if (details.Interfaces > 0)
    {
      legs->SetTypedTuple(i, details.Legs.data() + details.Interfaces * source);
    }
  }
  data->AddArray(transmittance);
  data->AddArray(inner);
  data->AddArray(last);
  if (details.Interfaces > 0)
  {
    data->AddArray(legs);
  }
  if (options.VirtualNormals)
  {
    AddVirtualNormals(input, sources, vertices, details, options.Eye, output);
  }
}

}

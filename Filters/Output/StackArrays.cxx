// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/StackArrays.h"

#include "Refraction/Membrane/Optics.h"
#include "Refraction/Membrane/VirtualNormal.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace meniscus
{
namespace
{

// A point of the output.
struct StackPoint
{
  glm::dvec3 Point; ///< where it is in the object
  const VirtualVertex* Vertex;
  StackDetail Detail;
};

// Share of the light behind the first interface that the others keep from the eye.
double ComputeInnerReflectance(const StackPoint& point, const OutputOptions& options)
{
  const double first = point.Detail.Passed > 0
    ? FresnelReflectance(point.Vertex->Cosine, options.Exterior, options.Interior)
    : 0.0;
  // Nothing passes the first one at grazing incidence.
  return first < 1.0 ? 1.0 - point.Detail.Transmittance / (1.0 - first) : 0.0;
}

// `legs` has `interfaces` lengths per point.
void AddArrays(const std::vector<StackPoint>& points, const std::vector<double>& legs,
  std::size_t interfaces, const OutputOptions& options, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  const auto transmittance = MakeArray<vtkDoubleArray>("Transmittance", 1, points.size());
  const auto inner = MakeArray<vtkDoubleArray>("InnerReflectance", 1, points.size());
  const auto last = MakeArray<vtkDoubleArray>("LastSightPoint", 3, points.size());
  const auto lengths =
    MakeArray<vtkDoubleArray>("LegLengths", static_cast<int>(interfaces), points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const auto i = static_cast<vtkIdType>(k);
    transmittance->SetValue(i, points[k].Detail.Transmittance);
    inner->SetValue(i, ComputeInnerReflectance(points[k], options));
    last->SetTypedTuple(i, &points[k].Detail.LastSightPoint.x);
    if (interfaces > 0)
    {
      lengths->SetTypedTuple(i, legs.data() + interfaces * k);
    }
  }
  data->AddArray(transmittance);
  data->AddArray(inner);
  data->AddArray(last);
  if (interfaces > 0)
  {
    data->AddArray(lengths);
  }
  if (options.VirtualNormals)
  {
    // Lit by a light at the eye as the true ones are.
    AddVirtualNormals(
      points.size(),
      [&](std::size_t k, const glm::dvec3& normal, glm::dvec3& turned)
      {
        const glm::dvec3 inside = points[k].Detail.LastSightPoint - points[k].Point;
        if (glm::length(inside) > 0.0)
        {
          turned = TurnAlong(normal, glm::normalize(inside),
            glm::normalize(options.Eye - points[k].Vertex->SightPoint));
        }
      },
      output);
  }
}

}

//------------------------------------------------------------------------------
void AddStackArrays(vtkPolyData* input, const std::vector<VirtualVertex>& vertices,
  const StackDetails& details, const OutputOptions& options, vtkPolyData* output)
{
  auto* ids = vtkIdTypeArray::SafeDownCast(output->GetPointData()->GetArray("SourcePointId"));
  const auto count = static_cast<std::size_t>(ids->GetNumberOfTuples());
  std::vector<StackPoint> points;
  std::vector<double> legs;
  points.reserve(count);
  legs.reserve(count * details.Interfaces);
  for (vtkIdType k = 0; k < ids->GetNumberOfTuples(); ++k)
  {
    const auto source = static_cast<std::size_t>(ids->GetValue(k));
    StackPoint point{ {}, &vertices[source], details.Points[source] };
    input->GetPoint(ids->GetValue(k), &point.Point.x);
    points.push_back(point);
    const double* own = details.Legs.data() + details.Interfaces * source;
    legs.insert(legs.end(), own, own + details.Interfaces);
  }
  AddArrays(points, legs, details.Interfaces, options, output);
}

//------------------------------------------------------------------------------
void AddStackImageArrays(vtkPolyData* input, const StackImages& images, const AllImages& cells,
  const StackSolver& solver, const OutputOptions& options, vtkPolyData* output)
{
  const std::size_t interfaces = solver.GetStack().GetNumberOfInterfaces();
  std::vector<double> legs = images.GetLegs();
  std::vector<StackPoint> points;
  points.reserve(images.GetPointImages().size());
  for (const ImagePoint& image : images.GetPointImages())
  {
    points.push_back(
      { FindTruePoint(input, image), &image.Vertex, images.GetDetails()[points.size()] });
  }
  StackPath path;
  for (const std::vector<ImagePoint>* list : { &cells.Lines.Points, &cells.Polygons.Points })
  {
    for (const ImagePoint& image : *list)
    {
      // A ray at a critical angle may be lost by rounding. Its transmittance is 0.
      const glm::dvec3 point = FindTruePoint(input, image);
      const auto passed = static_cast<std::size_t>(image.Passed);
      solver.Retrace(image.Vertex.SightPoint, image.Vertex.Facet, passed, path);
      StackPoint own{ point, &image.Vertex, solver.MakeVertex(point, path) };
      own.Detail.Transmittance = path.Count == passed ? own.Detail.Transmittance : 0.0;
      points.push_back(own);
      legs.resize(legs.size() + interfaces);
      solver.MeasureLegs(point, path, legs.data() + legs.size() - interfaces);
    }
  }
  AddArrays(points, legs, interfaces, options, output);
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMembraneCellFilter.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Refraction/Stack/RefractionStack.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{

/** Way of the ray at a vertex of the first surface. World coordinates. */
struct VertexRay
{
  std::vector<glm::dvec3> Places; ///< on the interfaces that it passes, then its end
  std::size_t Count = 0;          ///< number of interfaces that it passes
  bool IsBackFacing = false;
  meniscus::PathEnd End = meniscus::PathEnd::Passed;
  vtkIdType FirstPoint = -1; ///< of its places in the output; -1 until they are needed
};

/** Traces the rays at the vertices of the first surface of a stack. */
std::vector<VertexRay> TraceVertices(const meniscus::RefractionStack& stack, double length)
{
  const auto& links = stack.GetLinks();
  const meniscus::Membrane& first = links.front().Surface->GetMembrane();
  const double side = links.front().Passage.FromFront ? 1.0 : -1.0;
  std::vector<VertexRay> rays(first.GetPositions().size());
  meniscus::StackPath path;
  for (std::size_t v = 0; v < rays.size(); ++v)
  {
    VertexRay& ray = rays[v];
    const meniscus::PatchPoint at{ first.GetPositions()[v], side * first.GetNormals()[v] };
    const glm::dvec3 sight = at.Position + links.front().Shift - stack.GetEye();
    // Written so that the NaN of a vertex without a facet fails.
    ray.IsBackFacing = !(glm::dot(sight, at.Normal) < 0.0);
    if (ray.IsBackFacing)
    {
      continue;
    }
    ray.End = stack.TraceFrom(meniscus::StackPlace(), at, links.size(), path);
    ray.Count = path.Count;
    for (std::size_t k = 0; k < path.Count; ++k)
    {
      ray.Places.push_back(path.Points[k].Ray.Origin + stack.GetOrigin());
    }
    if (path.Count == links.size())
    {
      ray.Places.push_back(ray.Places.back() + length * path.GetLast().Direction);
    }
  }
  return rays;
}

/** 1 if two triangles, whose corners lie on three rays, have the same side in front; else -1. */
signed char CompareSides(
  const std::array<glm::dvec3, 3>& near, const std::array<glm::dvec3, 3>& far)
{
  const glm::dvec3 ray = far[0] + far[1] + far[2] - near[0] - near[1] - near[2];
  const auto side = [&ray](const std::array<glm::dvec3, 3>& p)
  { return glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), ray); };
  return side(near) * side(far) < 0.0 ? -1 : 1;
}

/** Wedges and their arrays. */
class Cells
{
public:
  Cells(const meniscus::RefractionStack& stack, std::vector<VertexRay>& rays)
    : Stack(stack)
    , Rays(rays)
  {
    this->Points->SetDataTypeToDouble();
    this->Paths->SetName("OpticalPath");
    this->Facets->SetName("FacetId");
    this->Legs->SetName("Leg");
    this->Indices->SetName("IndexOfRefraction");
    this->Orientations->SetName("Orientation");
  }

  /** Adds the wedge between the interfaces `leg` - 1 and `leg`, or behind the last of them. */
  void Add(vtkUnstructuredGrid* grid, const meniscus::Membrane::Facet& facet, vtkIdType id,
    std::size_t leg)
  {
    // The near side of a wedge is counter-clockwise as seen from outside, as facets are from the
    // side of their normals.
    const bool fromFront = this->Stack.GetLinks().front().Passage.FromFront;
    vtkIdType ids[6];
    std::array<glm::dvec3, 3> near;
    std::array<glm::dvec3, 3> far;
    for (std::size_t i = 0; i < 3; ++i)
    {
      VertexRay& ray = this->Rays[static_cast<std::size_t>(facet[fromFront ? i : 2 - i])];
      this->AddPlaces(ray);
      ids[i] = ray.FirstPoint + static_cast<vtkIdType>(leg) - 1;
      ids[i + 3] = ids[i] + 1;
      near[i] = ray.Places[leg - 1];
      far[i] = ray.Places[leg];
    }
    grid->InsertNextCell(VTK_WEDGE, 6, ids);
    this->Facets->InsertNextValue(id);
    this->Legs->InsertNextValue(static_cast<int>(leg));
    this->Indices->InsertNextValue(this->Stack.GetLinks()[leg - 1].Passage.Behind);
    this->Orientations->InsertNextValue(CompareSides(near, far));
  }

  void MoveTo(vtkUnstructuredGrid* grid)
  {
    grid->SetPoints(this->Points);
    grid->GetPointData()->AddArray(this->Paths);
    for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{
           this->Facets, this->Legs, this->Indices, this->Orientations })
    {
      grid->GetCellData()->AddArray(array);
    }
  }

private:
  void AddPlaces(VertexRay& ray)
  {
    if (ray.FirstPoint >= 0)
    {
      return;
    }
    ray.FirstPoint = this->Points->GetNumberOfPoints();
    glm::dvec3 from = this->Stack.GetEye() + this->Stack.GetOrigin();
    double path = 0.0;
    for (std::size_t k = 0; k < ray.Places.size(); ++k)
    {
      const auto& links = this->Stack.GetLinks();
      const double index = k == 0 ? links[0].Passage.Before : links[k - 1].Passage.Behind;
      path += index * glm::length(ray.Places[k] - from);
      from = ray.Places[k];
      this->Points->InsertNextPoint(&from.x);
      this->Paths->InsertNextValue(path);
    }
  }

  const meniscus::RefractionStack& Stack;
  std::vector<VertexRay>& Rays;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Paths;
  vtkNew<vtkIdTypeArray> Facets;
  vtkNew<vtkIntArray> Legs;
  vtkNew<vtkDoubleArray> Indices;
  vtkNew<vtkSignedCharArray> Orientations;
};

}

vtkStandardNewMacro(vtkMembraneCellFilter);
meniscusInterfacePropertiesMacro(vtkMembraneCellFilter);
meniscusInterfaceTimeMacro(vtkMembraneCellFilter);
meniscusMembranePortMacro(vtkMembraneCellFilter, 0);

//------------------------------------------------------------------------------
class vtkMembraneCellFilter::vtkInternals
{
public:
  meniscus::RefractionScene Scene{ meniscus::RefractionScene::Fitting::Exact,
    meniscus::RefractionScene::Use::Rays };
};

//------------------------------------------------------------------------------
vtkMembraneCellFilter::vtkMembraneCellFilter()
  : Interfaces(meniscus::MakeInterfaces())
  , Internals(std::make_unique<vtkInternals>())
{
}

//------------------------------------------------------------------------------
vtkMembraneCellFilter::~vtkMembraneCellFilter() = default;

//------------------------------------------------------------------------------
int vtkMembraneCellFilter::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  return meniscus::AcceptSurfaces(info);
}

//------------------------------------------------------------------------------
int vtkMembraneCellFilter::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputs, vtkInformationVector* vtkNotUsed(outputs))
{
  meniscus::RequestWhole(inputs[0]);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkMembraneCellFilter::UpdateScene(vtkInformationVector* membranes)
{
  meniscus::SceneMessages messages;
  // Written so that a NaN fails.
  if (!(this->CellLength > 0.0) || !std::isfinite(this->CellLength))
  {
    messages.Error = "CellLength must be positive and finite";
  }
  const std::array<double, 3> eye = { this->EyePosition[0], this->EyePosition[1],
    this->EyePosition[2] };
  meniscus::RefractionScene& scene = this->Internals->Scene;
  bool ready = scene.Update({ membranes, 0, this->Interfaces }, eye, messages);
  if (ready && scene.GetStack().GetLinks().empty())
  {
    messages.Error = "No interface in front of the eye refracts";
    ready = false;
  }
  if (ready && messages.Warning.empty())
  {
    scene.ReportEyes({ scene.GetEye() }, messages);
  }
  meniscus::Report(this, messages);
  return ready;
}

//------------------------------------------------------------------------------
int vtkMembraneCellFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  this->NumberOfBackFacingFacets = 0;
  this->NumberOfTotallyReflectedFacets = 0;
  this->NumberOfMissedFacets = 0;
  if (!this->UpdateScene(inputs[0]))
  {
    return 0;
  }
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs);
  const meniscus::RefractionStack& stack = this->Internals->Scene.GetStack();
  const meniscus::Membrane& membrane = stack.GetLinks().front().Surface->GetMembrane();
  std::vector<VertexRay> rays = TraceVertices(stack, this->CellLength);
  Cells cells(stack, rays);
  output->Allocate(static_cast<vtkIdType>(membrane.GetFacets().size()));
  for (std::size_t f = 0; f < membrane.GetFacets().size(); ++f)
  {
    const meniscus::Membrane::Facet& facet = membrane.GetFacets()[f];
    std::size_t last = stack.GetLinks().size();
    bool faces = true;
    bool reflects = false;
    for (const std::int32_t vertex : facet)
    {
      const VertexRay& ray = rays[static_cast<std::size_t>(vertex)];
      faces = faces && !ray.IsBackFacing;
      reflects = reflects || ray.End == meniscus::PathEnd::Reflected;
      // The leg in front of an interface that the ray does not pass has no end.
      last = std::min(last, ray.Places.empty() ? 0 : ray.Places.size() - 1);
    }
    for (std::size_t leg = 1; leg <= last; ++leg)
    {
      cells.Add(output, facet, membrane.GetCellId(static_cast<std::int32_t>(f)), leg);
    }
    const bool whole = last == stack.GetLinks().size();
    this->NumberOfBackFacingFacets += !faces;
    this->NumberOfTotallyReflectedFacets += faces && !whole && reflects;
    this->NumberOfMissedFacets += faces && !whole && !reflects;
  }
  cells.MoveTo(output);
  return 1;
}

//------------------------------------------------------------------------------
void vtkMembraneCellFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EyePosition: (" << this->EyePosition[0] << ", " << this->EyePosition[1] << ", "
     << this->EyePosition[2] << ")\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
  os << indent << "CellLength: " << this->CellLength << "\n";
  os << indent << "NumberOfBackFacingFacets: " << this->NumberOfBackFacingFacets << "\n";
  os << indent << "NumberOfTotallyReflectedFacets: " << this->NumberOfTotallyReflectedFacets
     << "\n";
  os << indent << "NumberOfMissedFacets: " << this->NumberOfMissedFacets << "\n";
}

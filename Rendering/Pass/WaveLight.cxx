// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pass/WaveLight.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkShaderProgram.h"

namespace meniscus
{
namespace
{

/** Vector and path at a point of lit geometry; zeros after an error. */
std::array<float, 4> ValueAt(vtkPolyData* lit, vtkIdType point)
{
  vtkDataArray* vectors = lit->GetPointData()->GetArray("RefractionLightVector");
  vtkDataArray* paths = lit->GetPointData()->GetArray("RefractionLightPath");
  std::array<float, 4> value{};
  for (int c = 0; vectors && paths && c < 4; ++c)
  {
    value[static_cast<std::size_t>(c)] =
      static_cast<float>(c < 3 ? vectors->GetComponent(point, c) : paths->GetComponent(point, 0));
  }
  return value;
}

}

//------------------------------------------------------------------------------
/** Divides the object if it or the number of cells changed. Returns false without an object. */
bool WaveLight::UpdateMesh(vtkRefractedGeometryFilter* filter, int cells)
{
  vtkDataSet* object = vtkDataSet::SafeDownCast(filter->GetInputDataObject(0, 0));
  if (!object || cells < 1)
  {
    return false;
  }
  const ObjectSurface surface = this->Surfaces.Get(object);
  if (surface.Data != this->MeshSurface || surface.Data->GetMTime() != this->MeshTime ||
    cells != this->MeshCells)
  {
    this->Mesh.Build(surface.Data, surface.Cells, cells);
    this->MeshSurface = surface.Data;
    this->MeshTime = surface.Data->GetMTime();
    this->MeshCells = cells;
    this->IsUploaded = false;
  }
  return this->Mesh.GetCells()->GetNumberOfCells() > 0;
}

//------------------------------------------------------------------------------
/** Computes the light of a source on triangles behind the membranes of the object. */
void WaveLight::Compute(vtkRefractedLightFilter* light, vtkRefractedGeometryFilter* filter,
  const WaveSource& source, vtkPolyData* lit)
{
  const int membranes = filter->GetNumberOfMembranes();
  bool isKnown = light->GetNumberOfMembranes() == membranes;
  for (int i = 0; isKnown && i < membranes; ++i)
  {
    isKnown = light->GetInputDataObject(1, i) == filter->GetInputDataObject(1, i);
  }
  if (!isKnown)
  {
    light->RemoveAllMembranes();
    for (int i = 0; i < membranes; ++i)
    {
      light->AddMembraneData(vtkPolyData::SafeDownCast(filter->GetInputDataObject(1, i)));
    }
  }
  if (light->GetInputDataObject(0, 0) != lit)
  {
    light->SetInputData(lit);
  }
  light->SetInterfaces(filter->GetInterfaces());
  light->LightVectorsOn();
  light->SetLightPosition(source.Place.data());
  light->SetPositional(source.IsPositional);
  light->Update();
}

//------------------------------------------------------------------------------
/** Reads the light at the points of the mesh; of those with a patch, on the patch. */
void WaveLight::ReadValues(
  Source& source, vtkRefractedGeometryFilter* filter, const WaveSource& wanted)
{
  vtkPolyData* output = source.Filter->GetOutput();
  source.Values.resize(static_cast<std::size_t>(output->GetNumberOfPoints()));
  for (std::size_t i = 0; i < source.Values.size(); ++i)
  {
    source.Values[i] = ValueAt(output, static_cast<vtkIdType>(i));
  }
  source.Patches.Build(output);
  const std::vector<vtkIdType>& points = source.Patches.GetPoints();
  if (points.empty())
  {
    return;
  }
  Compute(source.PatchFilter, filter, wanted, source.Patches.GetPatches());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    source.Values[static_cast<std::size_t>(points[i])] =
      ValueAt(source.PatchFilter->GetOutput(), LightPatches::MiddleOf(i));
  }
}

//------------------------------------------------------------------------------
void WaveLight::Update(
  vtkRefractedGeometryFilter* filter, const std::vector<WaveSource>& sources, int cells)
{
  const std::size_t lights = this->UpdateMesh(filter, cells) ? sources.size() : 0;
  this->IsUploaded = this->IsUploaded && lights == this->Sources.size();
  while (this->Sources.size() > lights)
  {
    this->Sources.pop_back();
  }
  while (this->Sources.size() < lights)
  {
    this->Sources.emplace_back();
  }
  std::size_t number = 0;
  for (Source& source : this->Sources)
  {
    const WaveSource& wanted = sources[number++];
    Compute(source.Filter, filter, wanted, this->Mesh.GetCells());
    const vtkMTimeType time = source.Filter->GetOutput()->GetMTime();
    if (time != source.Time)
    {
      source.Time = time;
      ReadValues(source, filter, wanted);
      ++this->Updates;
      this->IsUploaded = false;
    }
  }
}

//------------------------------------------------------------------------------
/** Vector and path at the places of all grids, for one light after another. */
std::vector<float> WaveLight::ListPlaces() const
{
  const std::vector<vtkIdType>& places = this->Mesh.GetPlaces();
  std::vector<float> values;
  values.reserve(4 * places.size() * this->Sources.size());
  for (const Source& source : this->Sources)
  {
    for (const vtkIdType place : places)
    {
      const auto point = static_cast<std::size_t>(place);
      const std::array<float, 4> value =
        point < source.Values.size() ? source.Values[point] : std::array<float, 4>{};
      values.insert(values.end(), value.begin(), value.end());
    }
  }
  return values;
}

//------------------------------------------------------------------------------
std::string WaveLight::Upload(vtkOpenGLRenderWindow* window, vtkPolyData* images)
{
  std::string error;
  if (!this->IsUploaded)
  {
    const std::vector<float>& faces = this->Mesh.GetFaces();
    const std::vector<float> places = this->ListPlaces();
    error = this->Faces.Upload(window, faces.data(), faces.size(), 4, 3);
    error = error.empty() ? this->Places.Upload(window, places.data(), places.size(), 4, 1) : error;
    this->ImagesTime = 0;
    this->IsUploaded = error.empty();
  }
  if (error.empty() && this->ImagesTime != images->GetMTime())
  {
    std::vector<std::int32_t> primitives = this->Mesh.ListPrimitives(images);
    primitives.push_back(-1); // a table is never empty
    error = this->Primitives.Upload(window, primitives.data(), primitives.size(), 1, 1);
    this->ImagesTime = error.empty() ? images->GetMTime() : 0;
  }
  return error;
}

//------------------------------------------------------------------------------
void WaveLight::Activate(vtkShaderProgram* program, bool areSurfaces, const glm::dvec3& origin)
{
  const glm::dvec3 offset = origin - this->Mesh.GetOrigin();
  const float between[3] = { static_cast<float>(offset.x), static_cast<float>(offset.y),
    static_cast<float>(offset.z) };
  program->SetUniform3f("litOffset", between);
  this->Faces.Activate(program, "litFaces");
  this->Places.Activate(program, "litPlaces");
  this->Primitives.Activate(program, "litPrimitives");
  program->SetUniformi("litPlacesOfLight", static_cast<int>(this->Mesh.GetPlaces().size()));
  program->SetUniformi("litNumberOfPrimitives",
    areSurfaces ? static_cast<int>(this->Primitives.GetNumberOfRows()) : 0);
}

//------------------------------------------------------------------------------
void WaveLight::Deactivate()
{
  this->Faces.Deactivate();
  this->Places.Deactivate();
  this->Primitives.Deactivate();
}

//------------------------------------------------------------------------------
void WaveLight::Release(vtkWindow* window)
{
  this->Faces.Release(window);
  this->Places.Release(window);
  this->Primitives.Release(window);
  this->IsUploaded = false;
}

}

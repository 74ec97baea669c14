// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/OutputArrays.h"

#include "Filters/Common/ThreadedLoop.h"

#include "Refraction/Membrane/Optics.h"
#include "Refraction/Membrane/VirtualNormal.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// The list of an array of floats or of doubles with a name, which most arrays are.
template <typename Value>
vtkAOSDataArrayTemplate<Value>* AsPlain(vtkAbstractArray* array)
{
  return array && array->GetName() ? vtkAOSDataArrayTemplate<Value>::FastDownCast(array) : nullptr;
}

bool IsPlain(vtkAbstractArray* array)
{
  return AsPlain<float>(array) || AsPlain<double>(array);
}

// Sums in double precision, as VTK does. Does nothing for arrays of other values.
template <typename Value>
void InterpolateValues(
  vtkAbstractArray* from, const std::vector<const ImagePoint*>& points, vtkAbstractArray* to)
{
  auto* source = AsPlain<Value>(from);
  auto* target = AsPlain<Value>(to);
  if (!source || !target)
  {
    return;
  }
  target->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  const auto components = static_cast<std::size_t>(source->GetNumberOfComponents());
  const Value* const values = source->GetPointer(0);
  Value* const result = target->GetPointer(0);
  PointLoop(points.size(),
    [&points, components, values, result](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const ImagePoint& point = *points[i];
        const std::size_t count = point.GetNumberOfSources();
        for (std::size_t c = 0; c < components; ++c)
        {
          double sum = 0.0;
          for (std::size_t k = 0; k < count; ++k)
          {
            const auto id = static_cast<std::size_t>(point.Source[k]);
            sum += point.Weight[k] * static_cast<double>(values[components * id + c]);
          }
          result[components * i + c] = static_cast<Value>(sum);
        }
      }
    });
}

}

//------------------------------------------------------------------------------
bool OutputOptions::operator==(const OutputOptions& other) const
{
  return this->PointsPrecision == other.PointsPrecision && this->Schlick == other.Schlick &&
    this->VirtualNormals == other.VirtualNormals && this->TrueGeometry == other.TrueGeometry &&
    this->Reflects == other.Reflects && this->IsLightAtEye == other.IsLightAtEye &&
    this->Light == other.Light && this->Eye == other.Eye && this->Exterior == other.Exterior &&
    this->Interior == other.Interior;
}

//------------------------------------------------------------------------------
int GetPointType(vtkPolyData* input, int precision)
{
  if (precision == vtkAlgorithm::DEFAULT_PRECISION)
  {
    return input->GetPoints() && input->GetPoints()->GetDataType() == VTK_DOUBLE ? VTK_DOUBLE
                                                                                 : VTK_FLOAT;
  }
  return precision == vtkAlgorithm::DOUBLE_PRECISION ? VTK_DOUBLE : VTK_FLOAT;
}

//------------------------------------------------------------------------------
void MakePoints(vtkPolyData* input, const std::vector<const VirtualVertex*>& vertices,
  const std::vector<vtkIdType>& sources, const Membrane& membrane, const OutputOptions& options,
  vtkPolyData* output)
{
  const std::size_t count = vertices.size();
  vtkNew<vtkPoints> points;
  points->SetDataType(GetPointType(input, options.PointsPrecision));
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  const auto sightPoint = MakeArray<vtkDoubleArray>("SightPoint", 3, count);
  const auto depth = MakeArray<vtkDoubleArray>("RefractionDepth", 1, count);
  const auto reflectance = MakeArray<vtkDoubleArray>("Reflectance", 1, count);
  const auto facet = MakeArray<vtkIdTypeArray>("SightFacet", 1, count);
  const auto source = MakeArray<vtkIdTypeArray>("SourcePointId", 1, count);
  const auto fill = [&](std::size_t begin, std::size_t end)
  {
    for (std::size_t k = begin; k < end; ++k)
    {
      const auto i = static_cast<vtkIdType>(k);
      const VirtualVertex& vertex = *vertices[k];
      points->SetPoint(i, vertex.Position.x, vertex.Position.y, vertex.Position.z);
      sightPoint->SetTypedTuple(i, &vertex.SightPoint.x);
      depth->SetValue(i, vertex.Depth);
      reflectance->SetValue(i,
        options.Schlick && vertex.Facet >= 0
          ? SchlickReflectance(vertex.Cosine, options.Exterior, options.Interior)
          : vertex.Reflectance);
      facet->SetValue(
        i, vertex.Facet < 0 ? -1 : static_cast<vtkIdType>(membrane.GetCellId(vertex.Facet)));
      source->SetValue(i, sources[k]);
    }
  };
  PointLoop(count, fill);
  output->SetPoints(points);
  vtkPointData* data = output->GetPointData();
  data->AddArray(sightPoint);
  data->AddArray(depth);
  data->AddArray(reflectance);
  data->AddArray(facet);
  data->AddArray(source);
}

//------------------------------------------------------------------------------
void AddTrueGeometry(const std::vector<glm::dvec3>& truePoints, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  vtkDataArray* inputNormals = data->GetNormals();
  const auto positions = MakeArray<vtkDoubleArray>("TruePosition", 3, truePoints.size());
  const auto normals =
    MakeArray<vtkDoubleArray>("TrueNormal", 3, inputNormals ? truePoints.size() : 0);
  for (std::size_t k = 0; k < truePoints.size(); ++k)
  {
    const auto i = static_cast<vtkIdType>(k);
    positions->SetTypedTuple(i, &truePoints[k].x);
    if (inputNormals)
    {
      glm::dvec3 normal(0.0);
      inputNormals->GetTuple(i, &normal.x);
      const double length = glm::length(normal);
      normal = length > 0.0 && std::isfinite(length) ? normal / length : glm::dvec3(0.0);
      normals->SetTypedTuple(i, &normal.x);
    }
  }
  data->AddArray(positions);
  if (inputNormals)
  {
    data->AddArray(normals);
  }
}

//------------------------------------------------------------------------------
void UseTruePoints(const std::vector<const VirtualVertex*>& vertices,
  const std::vector<glm::dvec3>& truePoints, const OutputOptions& options, vtkPolyData* output)
{
  if (options.TrueGeometry)
  {
    AddTrueGeometry(truePoints, output);
  }
  if (options.VirtualNormals)
  {
    MakeVirtualNormals(vertices, truePoints, options, output);
  }
  else if (options.Reflects)
  {
    MirrorNormals(vertices, truePoints, options, output);
  }
}

//------------------------------------------------------------------------------
void AddVirtualNormals(std::size_t count,
  const std::function<void(std::size_t, const glm::dvec3&, glm::dvec3&)>& turn, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  vtkDataArray* trueNormals = data->GetNormals();
  if (!trueNormals)
  {
    return;
  }
  const auto normals = MakeArray<vtkDoubleArray>("VirtualNormals", 3, count);
  for (std::size_t k = 0; k < count; ++k)
  {
    const auto i = static_cast<vtkIdType>(k);
    glm::dvec3 normal(0.0);
    trueNormals->GetTuple(i, &normal.x);
    const double length = glm::length(normal);
    if (length > 0.0 && std::isfinite(length))
    {
      turn(k, normal / length, normal);
    }
    normals->SetTypedTuple(i, &normal.x);
  }
  data->AddArray(normals);
  data->SetActiveNormals(normals->GetName()); // SetNormals would drop the true ones
}

//------------------------------------------------------------------------------
void MakeVirtualNormals(const std::vector<const VirtualVertex*>& vertices,
  const std::vector<glm::dvec3>& truePoints, const OutputOptions& options, vtkPolyData* output)
{
  const glm::dvec3* light = options.IsLightAtEye ? nullptr : &options.Light;
  AddVirtualNormals(
    vertices.size(),
    [&](std::size_t k, const glm::dvec3& normal, glm::dvec3& turned)
    {
      const VirtualVertex& vertex = *vertices[k];
      if (vertex.Facet >= 0)
      {
        turned = options.Reflects
          ? ComputeReflectedNormal(normal, truePoints[k], vertex.SightPoint, options.Eye, light)
          : ComputeVirtualNormal(normal, truePoints[k], vertex.SightPoint, options.Eye,
              options.Exterior, options.Interior, light);
      }
    },
    output);
}

//------------------------------------------------------------------------------
void MirrorNormals(const std::vector<const VirtualVertex*>& vertices,
  const std::vector<glm::dvec3>& truePoints, const OutputOptions& options, vtkPolyData* output)
{
  vtkDataArray* trueNormals = output->GetPointData()->GetNormals();
  if (!trueNormals)
  {
    return;
  }
  const auto normals = vtk::TakeSmartPointer(trueNormals->NewInstance());
  normals->DeepCopy(trueNormals); // the input may share the array
  for (std::size_t k = 0; k < vertices.size(); ++k)
  {
    const auto i = static_cast<vtkIdType>(k);
    glm::dvec3 normal(0.0);
    trueNormals->GetTuple(i, &normal.x);
    if (vertices[k]->Facet >= 0)
    {
      normal = ComputeMirroredNormal(normal, truePoints[k], vertices[k]->SightPoint, options.Eye);
      normals->SetTuple(i, &normal.x);
    }
  }
  output->GetPointData()->SetNormals(normals);
}

//------------------------------------------------------------------------------
glm::dvec3 FindTruePoint(vtkPolyData* input, const ImagePoint& image)
{
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < image.GetNumberOfSources(); ++k)
  {
    glm::dvec3 corner;
    input->GetPoint(image.Source[k], &corner.x);
    sum += image.Weight[k] * corner;
  }
  return sum;
}

//------------------------------------------------------------------------------
void MakeCellArrays(const std::vector<vtkIdType>& sources,
  const std::vector<signed char>& orientations, vtkPolyData* output)
{
  const auto source = MakeArray<vtkIdTypeArray>("SourceCellId", 1, sources.size());
  const auto orientation = MakeArray<vtkSignedCharArray>("ImageOrientation", 1, sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    source->SetValue(static_cast<vtkIdType>(k), sources[k]);
    orientation->SetValue(static_cast<vtkIdType>(k), orientations[k]);
  }
  output->GetCellData()->AddArray(source);
  output->GetCellData()->AddArray(orientation);
}

//------------------------------------------------------------------------------
int TakeFittingArrays(vtkDataSetAttributes* from, vtkIdType tuples, vtkDataSetAttributes* fitting)
{
  int removed = 0;
  fitting->ShallowCopy(from);
  for (int i = fitting->GetNumberOfArrays(); i-- > 0;)
  {
    if (fitting->GetAbstractArray(i)->GetNumberOfTuples() != tuples)
    {
      fitting->RemoveArray(i);
      ++removed;
    }
  }
  return removed;
}

//------------------------------------------------------------------------------
void CopyTuples(vtkDataSetAttributes* from, vtkIdType tuples, const std::vector<vtkIdType>& sources,
  vtkDataSetAttributes* to)
{
  to->CopyAllOn();
  const auto count = static_cast<vtkIdType>(sources.size());
  bool same = count == tuples;
  for (vtkIdType i = 0; same && i < count; ++i)
  {
    same = sources[static_cast<std::size_t>(i)] == i;
  }
  if (same)
  {
    to->PassData(from);
    return;
  }
  to->CopyAllocate(from, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    to->CopyData(from, sources[static_cast<std::size_t>(i)], i);
  }
  if (to->GetGlobalIds())
  {
    std::vector<vtkIdType> sorted = sources;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    {
      to->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
    }
  }
}

//------------------------------------------------------------------------------
void InterpolateTuples(vtkDataSetAttributes* from, const std::vector<const ImagePoint*>& points,
  vtkDataSetAttributes* to)
{
  to->InterpolateAllocate(from, static_cast<vtkIdType>(points.size()));
  bool arePlain = true;
  for (int k = 0; k < to->GetNumberOfArrays(); ++k)
  {
    arePlain = arePlain && IsPlain(to->GetAbstractArray(k));
  }
  for (int k = 0; k < to->GetNumberOfArrays() && arePlain; ++k)
  {
    vtkAbstractArray* const target = to->GetAbstractArray(k);
    vtkAbstractArray* const source = from->GetAbstractArray(target->GetName());
    InterpolateValues<float>(source, points, target);
    InterpolateValues<double>(source, points, target);
  }
  vtkNew<vtkIdList> ids;
  for (std::size_t i = 0; i < points.size() && !arePlain; ++i)
  {
    double weights[3];
    ids->Reset();
    for (std::size_t k = 0; k < points[i]->GetNumberOfSources(); ++k)
    {
      ids->InsertNextId(points[i]->Source[k]);
      weights[k] = points[i]->Weight[k];
    }
    to->InterpolatePoint(from, static_cast<vtkIdType>(i), ids, weights);
  }
}

}

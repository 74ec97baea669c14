// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VirtualPolyData.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkSmartPointer.h"

namespace meniscus
{
namespace
{

template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

class Builder
{
public:
  Builder(vtkPolyData* input, const std::vector<VirtualVertex>& vertices, const Membrane& membrane,
    vtkPolyData* output)
    : Input(input)
    , Vertices(vertices)
    , Surface(membrane)
    , Output(output)
  {
  }

  VirtualPolyDataReport Run(int pointsPrecision)
  {
    this->Output->GetFieldData()->PassData(this->Input->GetFieldData());
    this->NumberPoints();
    this->MakePoints(pointsPrecision);
    this->CopyArrays(this->Input->GetPointData(), this->Output->GetPointData(),
      this->Input->GetNumberOfPoints(), this->SourcePoints);
    this->MakePointArrays();

    this->Output->SetVerts(this->CopyVertices(this->Input->GetVerts()));
    this->Output->SetLines(this->CopyCells(this->Input->GetLines()));
    this->Output->SetPolys(this->CopyCells(this->Input->GetPolys()));
    this->Output->SetStrips(this->CopyCells(this->Input->GetStrips()));
    this->CopyArrays(this->Input->GetCellData(), this->Output->GetCellData(),
      this->Input->GetNumberOfCells(), this->SourceCells);
    this->MakeCellArrays();
    return this->Report;
  }

private:
  // Places of the points that have an image; -1 for the others.
  void NumberPoints()
  {
    const auto count = static_cast<vtkIdType>(this->Vertices.size());
    this->NewIds.resize(this->Vertices.size(), -1);
    vtkNew<vtkIdTypeArray> without;
    without->SetName("PointsWithoutImage");
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (this->GetVertex(i).state == ImageState::Found)
      {
        this->NewIds[static_cast<std::size_t>(i)] = this->SourcePoints->GetNumberOfIds();
        this->SourcePoints->InsertNextId(i);
      }
      else
      {
        without->InsertNextValue(i);
      }
    }
    this->Output->GetFieldData()->AddArray(without);
  }

  void MakePoints(int precision)
  {
    vtkNew<vtkPoints> points;
    if (precision == vtkAlgorithm::DEFAULT_PRECISION)
    {
      const bool isDouble =
        this->Input->GetPoints() && this->Input->GetPoints()->GetDataType() == VTK_DOUBLE;
      points->SetDataType(isDouble ? VTK_DOUBLE : VTK_FLOAT);
    }
    else
    {
      points->SetDataType(precision == vtkAlgorithm::DOUBLE_PRECISION ? VTK_DOUBLE : VTK_FLOAT);
    }
    const vtkIdType count = this->SourcePoints->GetNumberOfIds();
    points->SetNumberOfPoints(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const glm::dvec3& p = this->GetSource(i).position;
      points->SetPoint(i, p.x, p.y, p.z);
    }
    this->Output->SetPoints(points);
  }

  void MakePointArrays()
  {
    const vtkIdType count = this->SourcePoints->GetNumberOfIds();
    const auto sightPoint = MakeArray<vtkDoubleArray>("SightPoint", 3, count);
    const auto depth = MakeArray<vtkDoubleArray>("RefractionDepth", 1, count);
    const auto reflectance = MakeArray<vtkDoubleArray>("Reflectance", 1, count);
    const auto facet = MakeArray<vtkIdTypeArray>("SightFacet", 1, count);
    const auto source = MakeArray<vtkIdTypeArray>("SourcePointId", 1, count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const VirtualVertex& vertex = this->GetSource(i);
      sightPoint->SetTypedTuple(i, &vertex.sightPoint.x);
      depth->SetValue(i, vertex.depth);
      reflectance->SetValue(i, vertex.reflectance);
      facet->SetValue(i, static_cast<vtkIdType>(this->Surface.GetCellId(vertex.facet)));
      source->SetValue(i, this->SourcePoints->GetId(i));
    }
    vtkPointData* data = this->Output->GetPointData();
    data->AddArray(sightPoint);
    data->AddArray(depth);
    data->AddArray(reflectance);
    data->AddArray(facet);
    data->AddArray(source);
  }

  void MakeCellArrays()
  {
    const vtkIdType count = this->SourceCells->GetNumberOfIds();
    const auto source = MakeArray<vtkIdTypeArray>("SourceCellId", 1, count);
    const auto orientation = MakeArray<vtkSignedCharArray>("ImageOrientation", 1, count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      source->SetValue(i, this->SourceCells->GetId(i));
      orientation->SetValue(i, this->Orientations[static_cast<std::size_t>(i)]);
    }
    this->Output->GetCellData()->AddArray(source);
    this->Output->GetCellData()->AddArray(orientation);
  }

  // Arrays are shared if every tuple stays in its place. Such an array of the wrong size is passed
  // on neither way: reading it by index would leave it.
  void CopyArrays(
    vtkDataSetAttributes* from, vtkDataSetAttributes* to, vtkIdType tuples, vtkIdList* sources)
  {
    vtkNew<vtkDataSetAttributes> fitting;
    fitting->ShallowCopy(from);
    for (int i = fitting->GetNumberOfArrays(); i-- > 0;)
    {
      if (fitting->GetAbstractArray(i)->GetNumberOfTuples() != tuples)
      {
        fitting->RemoveArray(i);
        ++this->Report.arraysOfWrongSize;
      }
    }
    to->CopyAllOn();
    const vtkIdType count = sources->GetNumberOfIds();
    bool same = count == tuples;
    for (vtkIdType i = 0; same && i < count; ++i)
    {
      same = sources->GetId(i) == i;
    }
    if (same)
    {
      to->PassData(fitting);
      return;
    }
    to->CopyAllocate(fitting, count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      to->CopyData(fitting, sources->GetId(i), i);
    }
  }

  bool IsPoint(vtkIdType id) const
  {
    return id >= 0 && id < static_cast<vtkIdType>(this->Vertices.size());
  }
  const VirtualVertex& GetVertex(vtkIdType id) const
  {
    return this->Vertices[static_cast<std::size_t>(id)];
  }
  const VirtualVertex& GetSource(vtkIdType newId) const
  {
    return this->GetVertex(this->SourcePoints->GetId(newId));
  }

  void AddSource(vtkIdType cell, vtkIdType firstPoint)
  {
    this->SourceCells->InsertNextId(cell);
    this->Orientations.push_back(this->GetVertex(firstPoint).orientation);
  }

  vtkSmartPointer<vtkCellArray> CopyVertices(vtkCellArray* cells)
  {
    auto copy = vtkSmartPointer<vtkCellArray>::New();
    const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      iterator->GetCurrentCell(count, ids);
      bool broken = false;
      for (vtkIdType i = 0; i < count; ++i)
      {
        if (!this->IsPoint(ids[i]))
        {
          broken = true;
        }
        else if (const vtkIdType id = this->NewIds[static_cast<std::size_t>(ids[i])]; id >= 0)
        {
          copy->InsertNextCell(1, &id);
          this->AddSource(this->Cell, ids[i]);
        }
        else
        {
          ++this->Report.skippedCells;
        }
      }
      this->Report.brokenCells += broken;
      ++this->Cell;
    }
    return copy;
  }

  vtkSmartPointer<vtkCellArray> CopyCells(vtkCellArray* cells)
  {
    auto copy = vtkSmartPointer<vtkCellArray>::New();
    vtkNew<vtkIdList> points;
    const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      iterator->GetCurrentCell(count, ids);
      bool broken = count == 0;
      bool complete = true;
      points->Reset();
      for (vtkIdType i = 0; i < count; ++i)
      {
        broken = broken || !this->IsPoint(ids[i]);
        const vtkIdType id = broken ? -1 : this->NewIds[static_cast<std::size_t>(ids[i])];
        complete = complete && id >= 0;
        points->InsertNextId(id);
      }
      if (!broken && complete)
      {
        copy->InsertNextCell(points);
        this->AddSource(this->Cell, ids[0]);
      }
      this->Report.brokenCells += broken;
      this->Report.skippedCells += !broken && !complete;
      ++this->Cell;
    }
    return copy;
  }

  vtkPolyData* Input;
  const std::vector<VirtualVertex>& Vertices;
  const Membrane& Surface;
  vtkPolyData* Output;
  std::vector<vtkIdType> NewIds;
  vtkNew<vtkIdList> SourcePoints;
  vtkNew<vtkIdList> SourceCells;
  std::vector<signed char> Orientations;
  vtkIdType Cell = 0; // of the input: vertices, lines, polygons, strips
  VirtualPolyDataReport Report;
};

}

//------------------------------------------------------------------------------
VirtualPolyDataReport BuildVirtualPolyData(vtkPolyData* input,
  const std::vector<VirtualVertex>& vertices, const Membrane& membrane, int pointsPrecision,
  vtkPolyData* output)
{
  return Builder(input, vertices, membrane, output).Run(pointsPrecision);
}

}

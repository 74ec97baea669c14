// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/VirtualPolyData.h"

#include "Filters/Common/CellLoop.h"
#include "Filters/Object/ViewSelection.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>

namespace meniscus
{
namespace
{

class VirtualBuilder
{
public:
  VirtualBuilder(vtkPolyData* input, const std::vector<VirtualVertex>& vertices,
    const ViewSelection& selection, const Membrane& membrane, vtkPolyData* output)
    : Input(input)
    , Vertices(vertices)
    , Selection(selection)
    , Surface(membrane)
    , Output(output)
  {
  }

  VirtualPolyDataReport Run(const OutputOptions& options)
  {
    this->Output->GetFieldData()->PassData(this->Input->GetFieldData());
    this->NumberPoints();
    this->CopyArrays(this->Input->GetPointData(), this->Input->GetNumberOfPoints(),
      this->SourcePoints, this->Output->GetPointData());
    MakePoints(this->Input, this->Images, this->SourcePoints, this->Surface, options, this->Output);
    if (NeedsTruePoints(options))
    {
      std::vector<glm::dvec3> truePoints(this->SourcePoints.size());
      for (std::size_t i = 0; i < truePoints.size(); ++i)
      {
        this->Input->GetPoint(this->SourcePoints[i], &truePoints[i].x);
      }
      UseTruePoints(this->Images, truePoints, options, this->Output);
    }

    this->Output->SetVerts(this->CopyVertices(this->Input->GetVerts()));
    this->Output->SetLines(this->CopyCells(this->Input->GetLines(), Winding::Kept));
    this->Output->SetPolys(this->CopyCells(
      this->Input->GetPolys(), options.Reflects ? Winding::Reversed : Winding::Kept));
    this->Output->SetStrips(this->CopyCells(
      this->Input->GetStrips(), options.Reflects ? Winding::ReversedStrip : Winding::Kept));
    this->CopyArrays(this->Input->GetCellData(), this->Input->GetNumberOfCells(), this->SourceCells,
      this->Output->GetCellData());
    MakeCellArrays(this->SourceCells, this->Orientations, this->Output);
    return this->Report;
  }

private:
  /** Winding of output cells relative to the input's. Mirror images have the reversed winding. */
  enum class Winding
  {
    Kept,
    Reversed,
    ReversedStrip
  };

  // Numbers the points that have an image; others get -1.
  void NumberPoints()
  {
    const auto count = static_cast<vtkIdType>(this->Vertices.size());
    this->NewIds.resize(this->Vertices.size(), -1);
    vtkNew<vtkIdTypeArray> without;
    without->SetName("PointsWithoutImage");
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (!this->Selection.HasPoint(static_cast<std::size_t>(i)))
      {
        continue; // not solved, so it is not known whether it has an image
      }
      if (this->GetVertex(i).State == ImageState::Found)
      {
        this->NewIds[static_cast<std::size_t>(i)] =
          static_cast<vtkIdType>(this->SourcePoints.size());
        this->SourcePoints.push_back(i);
        this->Images.push_back(&this->GetVertex(i));
      }
      else
      {
        without->InsertNextValue(i);
      }
    }
    this->Output->GetFieldData()->AddArray(without);
  }

  void CopyArrays(vtkDataSetAttributes* from, vtkIdType tuples,
    const std::vector<vtkIdType>& sources, vtkDataSetAttributes* to)
  {
    vtkNew<vtkDataSetAttributes> fitting;
    this->Report.ArraysOfWrongSize += TakeFittingArrays(from, tuples, fitting);
    CopyTuples(fitting, tuples, sources, to);
  }

  bool IsPoint(vtkIdType id) const
  {
    return id >= 0 && id < static_cast<vtkIdType>(this->Vertices.size());
  }
  const VirtualVertex& GetVertex(vtkIdType id) const
  {
    return this->Vertices[static_cast<std::size_t>(id)];
  }
  void AddSource(vtkIdType cell, vtkIdType firstPoint)
  {
    this->SourceCells.push_back(cell);
    this->Orientations.push_back(this->GetVertex(firstPoint).Orientation);
  }

  vtkSmartPointer<vtkCellArray> CopyVertices(vtkCellArray* cells)
  {
    auto copy = vtkSmartPointer<vtkCellArray>::New();
    ForEachCell(cells,
      [&](vtkIdType count, const vtkIdType* ids)
      {
        bool broken = false;
        for (vtkIdType i = 0; i < count; ++i)
        {
          if (!this->IsPoint(ids[i]))
          {
            broken = true;
          }
          else if (!this->Selection.HasCell(this->Cell))
          {
            continue;
          }
          else if (const vtkIdType id = this->NewIds[static_cast<std::size_t>(ids[i])]; id >= 0)
          {
            copy->InsertNextCell(1, &id);
            this->AddSource(this->Cell, ids[i]);
          }
          else
          {
            ++this->Report.SkippedCells;
          }
        }
        this->Report.BrokenCells += broken;
        ++this->Cell;
      });
    return copy;
  }

  vtkSmartPointer<vtkCellArray> CopyCells(vtkCellArray* cells, Winding winding)
  {
    auto copy = vtkSmartPointer<vtkCellArray>::New();
    vtkNew<vtkIdList> points;
    ForEachCell(cells,
      [&](vtkIdType count, const vtkIdType* ids)
      {
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
        const bool selected = this->Selection.HasCell(this->Cell);
        if (!broken && complete && selected)
        {
          InsertCell(copy, points, winding);
          this->AddSource(this->Cell, ids[0]);
        }
        this->Report.BrokenCells += broken;
        this->Report.SkippedCells += !broken && !complete && selected;
        ++this->Cell;
      });
    return copy;
  }

  // A strip changes the winding of all its triangles with its first point doubled, whatever its
  // length.
  static void InsertCell(vtkCellArray* cells, vtkIdList* points, Winding winding)
  {
    const vtkIdType* first = points->GetPointer(0);
    const vtkIdType* last = first + points->GetNumberOfIds();
    std::vector<vtkIdType> ids(first, last);
    if (winding == Winding::Reversed)
    {
      std::reverse(ids.begin(), ids.end());
    }
    else if (winding == Winding::ReversedStrip)
    {
      ids.insert(ids.begin(), *first);
    }
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }

  vtkPolyData* Input;
  const std::vector<VirtualVertex>& Vertices;
  const ViewSelection& Selection;
  const Membrane& Surface;
  vtkPolyData* Output;
  std::vector<vtkIdType> NewIds;
  std::vector<vtkIdType> SourcePoints;
  std::vector<const VirtualVertex*> Images;
  std::vector<vtkIdType> SourceCells;
  std::vector<signed char> Orientations;
  vtkIdType Cell = 0; // of the input: vertices, lines, polygons, strips
  VirtualPolyDataReport Report;
};

}

//------------------------------------------------------------------------------
VirtualPolyDataReport BuildVirtualPolyData(vtkPolyData* input,
  const std::vector<VirtualVertex>& vertices, const ViewSelection& selection,
  const Membrane& membrane, const OutputOptions& options, vtkPolyData* output)
{
  return VirtualBuilder(input, vertices, selection, membrane, output).Run(options);
}

}

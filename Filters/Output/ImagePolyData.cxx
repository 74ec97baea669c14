// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Output/ImagePolyData.h"

#include "Filters/Common/ThreadedLoop.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>

namespace meniscus
{
namespace
{

// Number of cells whose results are collected together: enough work for a thread. A cell may have
// thousands of pieces, so a few cells are that many parts. It depends on the number of cells alone,
// so that the results do not depend on the threads.
std::size_t GetCellsPerPart(std::size_t count)
{
  return std::clamp<std::size_t>(count / 64, 1, 64);
}

// True if the diagonal from corner 0 to corner 2 splits a quad into two triangles that face the
// same way.
bool IsSplitByDiagonal(vtkPolyData* input, const std::int64_t* ids)
{
  glm::dvec3 corner[4];
  for (int i = 0; i < 4; ++i)
  {
    input->GetPoint(ids[i], &corner[i].x);
  }
  const glm::dvec3 diagonal = corner[2] - corner[0];
  return glm::dot(glm::cross(corner[1] - corner[0], diagonal),
           glm::cross(diagonal, corner[3] - corner[0])) > 0.0;
}

// Ear clipping, which also splits polygons that are not convex. A polygon that crosses itself
// cannot be split: it is a fan about its first corner, as VTK draws it. One with fewer than three
// points has no area.
void SplitPolygon(vtkPolyData* input, const std::int64_t* ids, std::size_t count,
  std::vector<std::int64_t>& triangles)
{
  triangles.clear();
  if (count < 3)
  {
    return;
  }
  if (count == 4 && IsSplitByDiagonal(input, ids))
  {
    triangles = { 0, 1, 2, 0, 2, 3 };
    return;
  }
  vtkNew<vtkPolygon> polygon;
  polygon->GetPoints()->SetDataTypeToDouble();
  for (std::size_t i = 0; i < count; ++i)
  {
    double p[3];
    input->GetPoints()->GetPoint(ids[i], p);
    polygon->GetPoints()->InsertNextPoint(p);
    polygon->GetPointIds()->InsertNextId(static_cast<vtkIdType>(i));
  }
  vtkNew<vtkIdList> corners;
  vtkNew<vtkPoints> places; // the overload that all versions of VTK have
  polygon->Triangulate(0, corners, places);
  for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
  {
    triangles.push_back(corners->GetId(i));
  }
  const auto last = static_cast<std::int64_t>(count) - 1;
  for (std::int64_t i = 1; i < last && corners->GetNumberOfIds() == 0; ++i)
  {
    triangles.insert(triangles.end(), { 0, i, i + 1 });
  }
}

/** Results of one part of the cells; parts are concatenated in their order. */
struct Part
{
  ImageMesh Pieces;
  ImageMesh Whole;
  CellReport Report;
};

template <typename MapRange>
bool MapParts(std::size_t count, const ProgressLoop& loop, const MapRange& map, ImageMesh& pieces,
  ImageMesh& whole, AllImages& result)
{
  const std::size_t size = GetCellsPerPart(count);
  std::vector<Part> parts((count + size - 1) / size);
  const bool done = loop(parts.size(),
    [&parts, &map, count, size](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        map(i * size, std::min((i + 1) * size, count), parts[i]);
      }
    });
  std::size_t points = 0;
  for (const Part& part : parts)
  {
    points += part.Pieces.Points.size();
  }
  pieces.Points.reserve(pieces.Points.size() + points);
  for (const Part& part : parts)
  {
    pieces.Append(part.Pieces);
    whole.Append(part.Whole);
    result.CellsWithoutImage += static_cast<vtkIdType>(part.Report.Without);
    result.CoarseTriangles += static_cast<vtkIdType>(part.Report.Coarse);
  }
  return done;
}

/** Collects points and cells of the output. */
class ImageBuilder
{
public:
  ImageBuilder(vtkPolyData* input, const ObjectTopology& topology, const CellImages& images,
    const AllImages& cells, ImageAssembly& assembly, vtkPolyData* output)
    : Input(input)
    , Topology(topology)
    , Images(images)
    , Cells(cells)
    , Assembly(assembly)
    , Output(output)
  {
  }

  /** Makes all that does not depend on arrays of the input. */
  void Assemble(const Membrane& membrane, const OutputOptions& options)
  {
    this->Assembly.Points.clear();
    this->Assembly.Origins.clear();
    this->Assembly.PointSources.clear();
    this->Assembly.CellSources.clear();
    this->Assembly.Report = VirtualPolyDataReport();
    this->TakePoints(this->Images.GetPointImages());
    const vtkIdType firstOfLines = this->TakePoints(this->Cells.Lines.Points);
    const vtkIdType firstOfPolygons = this->TakePoints(this->Cells.Polygons.Points);
    vtkPolyData* geometry = this->Assembly.Geometry;
    geometry->Initialize();
    std::vector<signed char> orientations;
    vtkNew<vtkCellArray> vertices;
    this->MakeVertices(vertices, orientations);
    CellLists lines;
    this->AddCells(this->Cells.WholeLines, 0, false, lines, orientations);
    this->AddCells(this->Cells.Lines, firstOfLines, false, lines, orientations);
    CellLists polygons;
    this->AddCells(this->Cells.WholePolygons, 0, options.Reflects, polygons, orientations);
    this->AddCells(this->Cells.Polygons, firstOfPolygons, options.Reflects, polygons, orientations);
    geometry->SetVerts(vertices);
    geometry->SetLines(lines.MakeCells());
    geometry->SetPolys(polygons.MakeCells());
    MakePoints(
      this->Input, this->Assembly.Points, this->Assembly.PointSources, membrane, options, geometry);
    MakeCellArrays(this->Assembly.CellSources, orientations, geometry);
    this->Assembly.Report.BrokenCells = this->Topology.BrokenCells;
    this->Assembly.Report.SkippedCells += this->Cells.CellsWithoutImage;
    this->Assembly.Report.CoarseTriangles = this->Cells.CoarseTriangles;
    this->Assembly.Options = options;
    this->Assembly.IsReady = true;
  }

  VirtualPolyDataReport Run()
  {
    vtkPolyData* geometry = this->Assembly.Geometry;
    const OutputOptions& options = this->Assembly.Options;
    this->Output->GetFieldData()->PassData(this->Input->GetFieldData());
    this->ListPointsWithoutImage();
    this->Output->SetPoints(geometry->GetPoints());
    this->Output->SetVerts(geometry->GetVerts());
    this->Output->SetLines(geometry->GetLines());
    this->Output->SetPolys(geometry->GetPolys());
    VirtualPolyDataReport report = this->Assembly.Report;
    this->InterpolatePointArrays(report);
    AddArrays(geometry->GetPointData(), this->Output->GetPointData());
    if (NeedsTruePoints(options))
    {
      UseTruePoints(this->Assembly.Points, this->FindTruePoints(), options, this->Output);
    }
    vtkNew<vtkDataSetAttributes> fitting;
    const vtkIdType cells = this->Input->GetNumberOfCells();
    report.ArraysOfWrongSize += TakeFittingArrays(this->Input->GetCellData(), cells, fitting);
    CopyTuples(fitting, cells, this->Assembly.CellSources, this->Output->GetCellData());
    AddArrays(geometry->GetCellData(), this->Output->GetCellData());
    return report;
  }

private:
  void ListPointsWithoutImage()
  {
    vtkNew<vtkIdTypeArray> without;
    without->SetName("PointsWithoutImage");
    for (vtkIdType i = 0; i < this->Input->GetNumberOfPoints(); ++i)
    {
      const auto point = static_cast<std::size_t>(i);
      if (this->Images.IsWanted(point) && this->Images.GetNumberOfImages(point) == 0)
      {
        without->InsertNextValue(i);
      }
    }
    this->Output->GetFieldData()->AddArray(without);
  }

  static void AddArrays(vtkDataSetAttributes* from, vtkDataSetAttributes* to)
  {
    for (int k = 0; k < from->GetNumberOfArrays(); ++k)
    {
      to->AddArray(from->GetAbstractArray(k));
    }
  }

  // Returns the index of the first one.
  vtkIdType TakePoints(const std::vector<ImagePoint>& points)
  {
    ImageAssembly& assembly = this->Assembly;
    const std::size_t first = assembly.Points.size();
    assembly.Points.resize(first + points.size());
    assembly.PointSources.resize(first + points.size());
    assembly.Origins.resize(first + points.size());
    PointLoop(points.size(),
      [&assembly, &points, first](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          assembly.Points[first + i] = &points[i].Vertex;
          assembly.PointSources[first + i] = points[i].GetSource();
          assembly.Origins[first + i] = &points[i];
        }
      });
    return static_cast<vtkIdType>(first);
  }

  std::vector<glm::dvec3> FindTruePoints() const
  {
    std::vector<glm::dvec3> points;
    points.reserve(this->Assembly.Origins.size());
    for (const ImagePoint* origin : this->Assembly.Origins)
    {
      points.push_back(FindTruePoint(this->Input, *origin));
    }
    return points;
  }

  void MakeVertices(vtkCellArray* vertices, std::vector<signed char>& orientations)
  {
    // Images of the same point are consecutive.
    std::vector<vtkIdType> first(static_cast<std::size_t>(this->Input->GetNumberOfPoints()) + 1, 0);
    for (std::size_t i = 0; i + 1 < first.size(); ++i)
    {
      first[i + 1] = first[i] + static_cast<vtkIdType>(this->Images.GetNumberOfImages(i));
    }
    const ObjectTopology::Cells& cells = this->Topology.Vertices;
    for (std::size_t i = 0; i < cells.GetCount(); ++i)
    {
      const auto point = static_cast<std::size_t>(cells.Connectivity[i]);
      this->Assembly.Report.SkippedCells += first[point] == first[point + 1];
      for (vtkIdType id = first[point]; id < first[point + 1]; ++id)
      {
        vertices->InsertNextCell(1, &id);
        this->Assembly.CellSources.push_back(cells.Ids[i]);
        orientations.push_back(this->Assembly.Points[static_cast<std::size_t>(id)]->Orientation);
      }
    }
  }

  /** Cells as vtkCellArray stores them. */
  struct CellLists
  {
    vtkNew<vtkTypeInt64Array> Offsets;
    vtkNew<vtkTypeInt64Array> Connectivity;

    CellLists() { this->Offsets->InsertNextValue(0); }
    vtkSmartPointer<vtkCellArray> MakeCells()
    {
      auto cells = vtkSmartPointer<vtkCellArray>::New();
      cells->SetData(this->Offsets, this->Connectivity);
      return cells;
    }
  };

  // Mirror images of polygons have the reversed winding.
  void AddCells(const ImageMesh& mesh, vtkIdType firstPoint, bool areReversed, CellLists& cells,
    std::vector<signed char>& orientations)
  {
    const std::size_t count = mesh.GetNumberOfCells();
    const vtkIdType before = cells.Connectivity->GetNumberOfValues();
    vtkTypeInt64* const ends = cells.Offsets->WritePointer(
      cells.Offsets->GetNumberOfValues(), static_cast<vtkIdType>(count));
    vtkTypeInt64* const ids =
      cells.Connectivity->WritePointer(before, static_cast<vtkIdType>(mesh.Connectivity.size()));
    PointLoop(count,
      [&mesh, ends, ids, before, firstPoint, areReversed](std::size_t from, std::size_t to)
      {
        std::int64_t begin = from > 0 ? mesh.Ends[from - 1] : 0;
        for (std::size_t i = from; i < to; ++i)
        {
          const std::int64_t end = mesh.Ends[i];
          for (std::int64_t k = begin; k < end; ++k)
          {
            const std::int64_t at = areReversed ? begin + end - 1 - k : k;
            ids[k] = firstPoint + mesh.Connectivity[static_cast<std::size_t>(at)];
          }
          ends[i] = before + end;
          begin = end;
        }
      });
    std::vector<vtkIdType>& sources = this->Assembly.CellSources;
    sources.insert(sources.end(), mesh.SourceCells.begin(), mesh.SourceCells.end());
    orientations.insert(orientations.end(), mesh.Orientations.begin(), mesh.Orientations.end());
  }

  void InterpolatePointArrays(VirtualPolyDataReport& report)
  {
    const std::vector<const ImagePoint*>& origins = this->Assembly.Origins;
    vtkNew<vtkDataSetAttributes> fitting;
    const vtkIdType points = this->Input->GetNumberOfPoints();
    report.ArraysOfWrongSize += TakeFittingArrays(this->Input->GetPointData(), points, fitting);
    vtkPointData* to = this->Output->GetPointData();
    const bool copiesOnly = this->Cells.Lines.Points.empty() && this->Cells.Polygons.Points.empty();
    if (copiesOnly)
    {
      CopyTuples(fitting, points, this->Assembly.PointSources, to);
      return;
    }
    if (fitting->GetNumberOfArrays() == 0)
    {
      return;
    }
    InterpolateTuples(fitting, origins, to);
    this->CopyIds(fitting);
  }

  // Copies id arrays, which VTK does not interpolate because ids have no intermediate values: the
  // id of the nearest point is taken.
  void CopyIds(vtkDataSetAttributes* fitting)
  {
    vtkPointData* to = this->Output->GetPointData();
    for (int k = 0; k < fitting->GetNumberOfArrays(); ++k)
    {
      vtkAbstractArray* from = fitting->GetAbstractArray(k);
      if (!from->GetName() || to->HasArray(from->GetName()))
      {
        continue;
      }
      const auto copy = vtk::TakeSmartPointer(from->NewInstance());
      copy->SetName(from->GetName());
      copy->SetNumberOfComponents(from->GetNumberOfComponents());
      copy->SetNumberOfTuples(static_cast<vtkIdType>(this->Assembly.Origins.size()));
      for (std::size_t i = 0; i < this->Assembly.Origins.size(); ++i)
      {
        copy->SetTuple(static_cast<vtkIdType>(i), this->Assembly.Origins[i]->Source[0], from);
      }
      to->AddArray(copy);
    }
  }

  vtkPolyData* Input;
  const ObjectTopology& Topology;
  const CellImages& Images;
  const AllImages& Cells;
  ImageAssembly& Assembly;
  vtkPolyData* Output;
};

}

//------------------------------------------------------------------------------
bool MapCells(vtkPolyData* input, const ObjectTopology& topology, const CellImages& images,
  bool closesSeams, const ProgressLoop& loop, AllImages& result)
{
  const auto split =
    [input](const std::int64_t* ids, std::size_t count, std::vector<std::int64_t>& triangles)
  { SplitPolygon(input, ids, count, triangles); };
  const bool linesDone = MapParts(
    topology.Lines.GetCount(), loop,
    [&topology, &images](std::size_t begin, std::size_t end, Part& part)
    {
      part.Report = images.MapLines(
        topology.Lines.AsObject(), topology.Lines.Ids.data(), begin, end, part.Pieces, part.Whole);
    },
    result.Lines, result.WholeLines, result);
  std::vector<unsigned char> isMapped(topology.Polygons.GetCount(), 0);
  const bool done = linesDone &&
    MapParts(
      topology.Polygons.GetCount(), loop,
      [&topology, &images, &split, &isMapped](std::size_t begin, std::size_t end, Part& part)
      {
        part.Report = images.MapPolygons(topology.Polygons.AsObject(), topology.Polygons.Ids.data(),
          begin, end, split, part.Pieces, part.Whole, isMapped.data());
      },
      result.Polygons, result.WholePolygons, result);
  if (done)
  {
    images.MeetNeighbours(topology.Polygons.AsObject(), topology.Polygons.GetCount(),
      isMapped.data(), closesSeams, result.WholePolygons, result.Polygons, ThreadedLoop);
  }
  return done;
}

//------------------------------------------------------------------------------
VirtualPolyDataReport BuildImagePolyData(vtkPolyData* input, const ObjectTopology& topology,
  const CellImages& images, const AllImages& cells, const Membrane& membrane,
  const OutputOptions& options, ImageAssembly& assembly, vtkPolyData* output)
{
  ImageBuilder builder(input, topology, images, cells, assembly, output);
  if (!assembly.IsReady || !(assembly.Options == options) ||
    assembly.Geometry->GetPoints()->GetDataType() != GetPointType(input, options.PointsPrecision))
  {
    builder.Assemble(membrane, options);
  }
  return builder.Run();
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/TetrahedraSource.h"

#include "Rendering/Common/VTKVersions.h"

#include "Common/BlockLoop.h"
#include "Rendering/Input/CellShapes.h"
#include "Rendering/Input/GridLayout.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>
#include <sstream>

namespace meniscus
{
namespace
{

constexpr int NoPoint = -1;

/** A cell type with a rule of its own for its division, and its number of points. */
struct CellRule
{
  int Type;
  vtkIdType Size;
  void (Tetrahedralizer::*Add)(const std::int64_t* points);
};

constexpr CellRule CellRules[] = {
  { VTK_TETRA, 4, &Tetrahedralizer::AddTetrahedron },
  { VTK_VOXEL, 8, &Tetrahedralizer::AddVoxel },
  { VTK_HEXAHEDRON, 8, &Tetrahedralizer::AddHexahedron },
  { VTK_WEDGE, 6, &Tetrahedralizer::AddWedge },
  { VTK_PYRAMID, 5, &Tetrahedralizer::AddPyramid },
  { VTK_QUADRATIC_TETRA, 10, &Tetrahedralizer::AddQuadraticTetrahedron },
  { VTK_QUADRATIC_HEXAHEDRON, 20, &Tetrahedralizer::AddQuadraticHexahedron },
  { VTK_QUADRATIC_WEDGE, 15, &Tetrahedralizer::AddQuadraticWedge },
  { VTK_QUADRATIC_LINEAR_WEDGE, 12, &Tetrahedralizer::AddQuadraticLinearWedge },
  { VTK_QUADRATIC_PYRAMID, 13, &Tetrahedralizer::AddQuadraticPyramid },
};
/** Largest number of points of a cell with a rule. */
constexpr vtkIdType MostPointsOfRules = 20;

/** Parts into which a face is split, by the indices of its points in the face. */
struct FaceSplit
{
  /** Polygons; empty for an unknown type. */
  std::vector<std::vector<int>> Parts;
  /** Index of the point inside the face, or NoPoint. */
  int Center = NoPoint;
};

/** Triangles between the point inside a face and the points around it. */
FaceSplit SplitAbout(int center, const std::vector<int>& around)
{
  FaceSplit split{ {}, center };
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    split.Parts.push_back({ center, around[i], around[(i + 1) % around.size()] });
  }
  return split;
}

/**
 * Splitting of a face. It depends on the face alone, so it is the same on both sides, and agrees
 * with Tetrahedralizer's rules for the cells that it knows.
 */
FaceSplit SplitFace(vtkCell* face)
{
  switch (face->GetCellType())
  {
    case VTK_TRIANGLE:
      return { { { 0, 1, 2 } } };
    case VTK_QUAD:
      return { { { 0, 1, 2, 3 } } };
    case VTK_PIXEL:
      return { { { 0, 1, 3, 2 } } };
    case VTK_QUADRATIC_TRIANGLE:
      return { { { 0, 3, 5 }, { 1, 4, 3 }, { 2, 5, 4 }, { 3, 4, 5 } } };
    case VTK_QUADRATIC_QUAD:
      return { { { 0, 4, 7 }, { 1, 5, 4 }, { 2, 6, 5 }, { 3, 7, 6 }, { 4, 5, 6, 7 } } };
    case VTK_BIQUADRATIC_TRIANGLE:
      return SplitAbout(6, { 0, 3, 1, 4, 2, 5 });
    case VTK_BIQUADRATIC_QUAD:
      return SplitAbout(8, { 0, 4, 1, 5, 2, 6, 3, 7 });
    case VTK_POLYGON: // of prisms
    {
      std::vector<int> around(face->GetNumberOfPoints());
      std::iota(around.begin(), around.end(), 0);
      return { { around } };
    }
    default:
      return {};
  }
}

/** The three points that edges join to each corner, in an order that turns the same way at all. */
using CornerEdges = std::array<int, 3>;

/** Edges at the corners of a linear cell whose corners can be folded; empty for other types. */
const std::vector<CornerEdges>& EdgesAtCorners(int type)
{
  static const std::vector<CornerEdges> none;
  static const std::vector<CornerEdges> hexahedron = { { 1, 3, 4 }, { 2, 0, 5 }, { 3, 1, 6 },
    { 0, 2, 7 }, { 7, 5, 0 }, { 4, 6, 1 }, { 5, 7, 2 }, { 6, 4, 3 } };
  static const std::vector<CornerEdges> wedge = { { 1, 2, 3 }, { 2, 0, 4 }, { 0, 1, 5 },
    { 5, 4, 0 }, { 3, 5, 1 }, { 4, 3, 2 } };
  static const std::vector<CornerEdges> pyramid = { { 1, 3, 4 }, { 2, 0, 4 }, { 3, 1, 4 },
    { 0, 2, 4 } };
  switch (type)
  {
    case VTK_HEXAHEDRON:
      return hexahedron;
    case VTK_WEDGE:
      return wedge;
    case VTK_PYRAMID:
      return pyramid;
    default:
      return none;
  }
}

/** Orientations of the trihedra that were given, apart from those within rounding of a plane. */
class Orientations
{
public:
  void Add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
  {
    // A determinant of three edges has six products, each with the rounding of three differences
    // of coordinates in single precision.
    constexpr double rounding = 64.0 * std::numeric_limits<float>::epsilon();
    const double volume = glm::dot(a, glm::cross(b, c));
    const double least = rounding * rounding * glm::dot(a, a) * glm::dot(b, b) * glm::dot(c, c);
    if (volume * volume > least)
    {
      this->Found[volume > 0.0 ? 1 : 0] = true;
    }
  }
  bool AreBoth() const { return this->Found[0] && this->Found[1]; }

private:
  std::array<bool, 2> Found{ false, false };
};

/** Reason why cells of a type are not drawn, with the cure. */
std::string ReasonOf(int type)
{
  if (!HasCellClass(type))
  {
    return "VTK cannot evaluate this type; write linear or quadratic cells";
  }
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(type);
  return cell->GetCellDimension() < 3 ? "without a volume"
                                      : "its points or faces do not fit its type";
}

/**
 * True for types whose faces are read from a cell object: those without a rule of their own that
 * are drawn, and types with more points than their rule takes.
 */
bool HasFaceObjects(int type)
{
  return KindOf(type).Tetrahedra > 1 || type == VTK_TETRA || type == VTK_PENTAGONAL_PRISM ||
    type == VTK_HEXAGONAL_PRISM || type == VTK_CONVEX_POINT_SET;
}

}

/** Tetrahedra of a block of cells. */
struct TetrahedraSource::Part
{
  Tetrahedralizer Tetrahedra;
  std::vector<std::int32_t> Sources;
  std::map<int, std::int64_t> Omitted;
  UnusableCells Unusable;
  bool SplitsByPosition = false;
  std::int64_t Folded = 0;
  /** Offsets that are added to the data set's point and cell indices. */
  std::int64_t FirstPoint = 0;
  std::int64_t FirstCell = 0;
  CellPoints Used = CellPoints::All;
  /** Points of all data sets. */
  PointsView Points;
  std::int64_t NumberOfPoints = 0;

  void AddBlock(const CellReader& cells, std::size_t first, std::size_t last);

private:
  void AddCell(const CellReader& cells, vtkIdType cell, vtkIdList* ids);
  void AddPolyhedron(const CellReader& cells, vtkIdType cell);
  void AddOther(const CellReader& cells, vtkIdType cell, int type);
  bool AddByFaces(vtkCell* cell);
  bool IsPoint(std::int64_t id) const { return id >= 0 && id < this->NumberOfPoints; }
  bool HasOverlaps(std::size_t firstId) const;
  bool HasFoldedCorners(int type, vtkIdList* points) const;

  std::vector<std::int64_t> Faces;
};

//------------------------------------------------------------------------------
void TetrahedraSource::Part::AddBlock(const CellReader& cells, std::size_t first, std::size_t last)
{
  vtkNew<vtkIdList> ids;
  for (std::size_t c = first; c < last; ++c)
  {
    const auto cell = static_cast<vtkIdType>(c);
    if (!cells.IsLeftOut(cell))
    {
      const std::size_t firstId = this->Tetrahedra.GetTetrahedra().size();
      this->AddCell(cells, cell, ids);
      if (this->Used == CellPoints::All &&
        ShapeOf(cells.GetType(cell)).Degree >= CellShape::SecondOrder)
      {
        this->Folded += this->HasOverlaps(firstId) ? 1 : 0;
      }
      this->Sources.resize(this->Tetrahedra.GetTetrahedra().size() / 4,
        static_cast<std::int32_t>(this->FirstCell + cell));
    }
  }
}

//------------------------------------------------------------------------------
/**
 * True if tetrahedra of the last cell have either orientation: those of a cell that is not folded
 * have one, whichever it is.
 */
bool TetrahedraSource::Part::HasOverlaps(std::size_t firstId) const
{
  const std::vector<std::int64_t>& ids = this->Tetrahedra.GetTetrahedra();
  Orientations found;
  for (std::size_t t = firstId; t + 3 < ids.size(); t += 4)
  {
    std::array<glm::dvec3, 4> at;
    for (std::size_t i = 0; i < 4; ++i)
    {
      if (!this->IsPoint(ids[t + i]))
      {
        return false;
      }
      at[i] = this->Points[static_cast<std::size_t>(ids[t + i])];
    }
    found.Add(at[1] - at[0], at[2] - at[0], at[3] - at[0]);
  }
  return found.AreBoth();
}

//------------------------------------------------------------------------------
/**
 * True if the edges at the corners of a linear cell have either orientation. Its tetrahedra are no
 * evidence: faces that are not planes may turn one of a cell that is not folded.
 */
bool TetrahedraSource::Part::HasFoldedCorners(int type, vtkIdList* points) const
{
  const std::vector<CornerEdges>& edges = EdgesAtCorners(type);
  constexpr std::size_t mostCorners = 8;
  std::array<glm::dvec3, mostCorners> at;
  for (vtkIdType i = 0; !edges.empty() && i < points->GetNumberOfIds(); ++i)
  {
    const std::int64_t id = this->FirstPoint + points->GetId(i);
    if (!this->IsPoint(id))
    {
      return false;
    }
    at[static_cast<std::size_t>(i)] = this->Points[static_cast<std::size_t>(id)];
  }
  Orientations found;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const auto edge = [&](std::size_t k)
    { return at[static_cast<std::size_t>(edges[i][k])] - at[i]; };
    found.Add(edge(0), edge(1), edge(2));
  }
  return found.AreBoth();
}

//------------------------------------------------------------------------------
void TetrahedraSource::Part::AddCell(const CellReader& cells, vtkIdType cell, vtkIdList* ids)
{
  int type = cells.GetType(cell);
  if (type == VTK_EMPTY_CELL)
  {
    return; // blanked cell
  }
  if (!HasVolume(type))
  {
    ++this->Omitted[type];
    return;
  }
  if (type == VTK_POLYHEDRON)
  {
    this->AddPolyhedron(cells, cell);
    return;
  }
  if (!cells.ReadPoints(cell, ids, this->Unusable))
  {
    return;
  }
  vtkIdType size = ids->GetNumberOfIds();
  type = ResolveCellType(type, size);
  if (this->Used == CellPoints::All && size <= 8)
  {
    this->Folded += this->HasFoldedCorners(type, ids) ? 1 : 0;
  }
  const CellShape shape = this->Used == CellPoints::Corners ? ShapeOf(type) : CellShape();
  if (shape.IsKnown() && size >= shape.NumberOfCorners)
  {
    type = shape.LinearType;
    size = shape.NumberOfCorners;
  }
  const auto* rule = std::find_if(std::begin(CellRules), std::end(CellRules),
    [type, size](const CellRule& known) { return known.Type == type && known.Size == size; });
  if (rule == std::end(CellRules))
  {
    this->AddOther(cells, cell, type);
    return;
  }
  std::array<std::int64_t, MostPointsOfRules> points;
  for (vtkIdType i = 0; i < size; ++i)
  {
    points[static_cast<std::size_t>(i)] = this->FirstPoint + ids->GetId(i);
  }
  (this->Tetrahedra.*rule->Add)(points.data());
}

//------------------------------------------------------------------------------
/** Adds a cell of a type without a rule of its own, by its faces. */
void TetrahedraSource::Part::AddOther(const CellReader& cells, vtkIdType cell, int type)
{
  // The faces of a VTK_CONVEX_POINT_SET are the faces of the convex hull of its points.
  this->SplitsByPosition = this->SplitsByPosition || type == VTK_CONVEX_POINT_SET;
  vtkNew<vtkGenericCell> generic;
  if (HasFaceObjects(type))
  {
    cells.GetGrid()->GetCell(cell, generic);
  }
  if (!this->AddByFaces(generic))
  {
    ++this->Omitted[type];
  }
}

//------------------------------------------------------------------------------
void TetrahedraSource::Part::AddPolyhedron(const CellReader& cells, vtkIdType cell)
{
  std::size_t numberOfFaces = 0;
  if (!cells.ReadFaces(cell, this->Faces, numberOfFaces, this->Unusable))
  {
    return;
  }
  std::int64_t* face = this->Faces.data();
  for (std::size_t f = 0; f < numberOfFaces; ++f, face += 1 + face[0])
  {
    for (std::int64_t k = 1; k <= face[0]; ++k)
    {
      face[k] += this->FirstPoint;
    }
  }
  this->Tetrahedra.AddPolyhedron(this->Faces.data(), numberOfFaces);
}

//------------------------------------------------------------------------------
bool TetrahedraSource::Part::AddByFaces(vtkCell* cell)
{
  const auto pointOf = [this](vtkCell* of, int place)
  { return this->FirstPoint + static_cast<std::int64_t>(of->GetPointId(place)); };
  std::vector<std::int64_t> faces;
  std::size_t numberOfFaces = 0;
  // A point inside the cell or, if there is none, the lowest-numbered point inside a face: it lies
  // in no plane of another face.
  const int inside = KindOf(cell->GetCellType()).Center;
  std::int64_t apex = inside == NoPoint ? NoPoint : pointOf(cell, inside);
  // Asked once: a vtkConvexPointSet of VTK 9.1 has no faces when asked again.
  const int size = cell->GetNumberOfFaces();
  for (int f = 0; f < size; ++f)
  {
    vtkCell* face = cell->GetFace(f);
    const FaceSplit split = SplitFace(face);
    if (split.Parts.empty())
    {
      return false;
    }
    for (const std::vector<int>& part : split.Parts)
    {
      faces.push_back(static_cast<std::int64_t>(part.size()));
      for (const int place : part)
      {
        faces.push_back(pointOf(face, place));
      }
    }
    numberOfFaces += split.Parts.size();
    if (inside == NoPoint && split.Center != NoPoint)
    {
      const std::int64_t center = pointOf(face, split.Center);
      apex = apex == NoPoint ? center : std::min(apex, center);
    }
  }
  if (apex == NoPoint)
  {
    this->Tetrahedra.AddPolyhedron(faces.data(), numberOfFaces);
  }
  else
  {
    this->Tetrahedra.AddCone(apex, faces.data(), numberOfFaces);
  }
  return numberOfFaces > 0;
}

//------------------------------------------------------------------------------
TetrahedraSource::TetrahedraSource(
  const std::vector<vtkDataSet*>& grids, const RangeLoop& loop, CellPoints used)
  : Points(grids, loop)
{
  this->View.Points = this->Points.GetView();
  this->View.NumberOfPoints = this->Points.GetNumberOfPoints();
  this->View.MatchPositions = grids.size() > 1;
  auto* single = grids.size() == 1 ? vtkUnstructuredGrid::SafeDownCast(grids[0]) : nullptr;
  if (single && CellReader(single).HasOnlyTetrahedra())
  {
    this->ViewTetrahedra(single);
  }
  else
  {
    this->Tetrahedralize(grids, loop, used);
  }
}

//------------------------------------------------------------------------------
void TetrahedraSource::ViewTetrahedra(vtkUnstructuredGrid* grid)
{
  this->View.NumberOfCells = grid->GetNumberOfCells();
  this->Stored = IdView(grid->GetCells()->GetConnectivityArray());
  this->View.ShortCells = this->Stored.GetInts();
  this->View.Cells = this->View.ShortCells ? nullptr : this->Stored.GetLongs();
  if (vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray())
  {
    this->View.CellFlags = ghosts->GetPointer(0);
    this->View.LeftOutBits = CellReader::GetLeftOutFlags();
  }
}

//------------------------------------------------------------------------------
void TetrahedraSource::Tetrahedralize(
  const std::vector<vtkDataSet*>& grids, const RangeLoop& loop, CellPoints used)
{
  std::vector<Part> parts;
  std::int64_t firstPoint = 0;
  std::int64_t firstCell = 0;
  for (vtkDataSet* grid : grids)
  {
    const auto size = static_cast<std::size_t>(grid->GetNumberOfCells());
    const std::size_t firstPart = parts.size();
    parts.resize(firstPart + NumberOfBlocks(size));
    // Objects that VTK creates on first access must exist before several threads access them.
    grid->GetCellType(0);
    const CellReader cells(grid);
    ForEachBlock(size, IsThreadSafe(grid) ? loop : SerialLoop,
      [&](std::size_t block, std::size_t first, std::size_t last)
      {
        Part& part = parts[firstPart + block];
        part.FirstPoint = firstPoint;
        part.FirstCell = firstCell;
        part.Used = used;
        part.Points = this->Points.GetView();
        part.NumberOfPoints = this->View.NumberOfPoints;
        part.AddBlock(cells, first, last);
      });
    firstPoint += grid->GetNumberOfPoints();
    firstCell += grid->GetNumberOfCells();
  }
  this->TakeParts(parts, loop);
}

//------------------------------------------------------------------------------
void TetrahedraSource::TakeParts(const std::vector<Part>& parts, const RangeLoop& loop)
{
  std::vector<std::size_t> starts;
  std::size_t size = 0;
  for (const Part& part : parts)
  {
    starts.push_back(size);
    size += part.Sources.size();
    this->PositionsDecide = this->PositionsDecide || part.SplitsByPosition;
    this->Folded += part.Folded;
    this->Unusable.Add(part.Unusable);
    for (const auto& omitted : part.Omitted)
    {
      this->Omitted[omitted.first] += omitted.second;
    }
  }
  this->Ids.resize(4 * size);
  this->Sources.resize(size);
  ForEachItem(parts.size(), loop,
    [&](std::size_t i)
    {
      const std::vector<std::int64_t>& ids = parts[i].Tetrahedra.GetTetrahedra();
      std::copy(ids.begin(), ids.end(), this->Ids.begin() + 4 * starts[i]);
      std::copy(
        parts[i].Sources.begin(), parts[i].Sources.end(), this->Sources.begin() + starts[i]);
    });
  this->View.Cells = this->Ids.data();
  this->View.SourceCells = this->Sources.data();
  this->View.NumberOfCells = static_cast<std::int64_t>(size);
}

//------------------------------------------------------------------------------
std::string TetrahedraSource::DescribeOmitted() const
{
  std::ostringstream text;
  for (const auto& omitted : this->Omitted)
  {
    const char* name = NameOfCellType(omitted.first);
    text << (text.tellp() > 0 ? ", " : "") << omitted.second << " "
         << (name ? name : "of an unknown type") << " (" << ReasonOf(omitted.first) << ")";
  }
  return text.str();
}

//------------------------------------------------------------------------------
GridSize MeasureGrids(const std::vector<vtkDataSet*>& grids)
{
  GridSize size;
  vtkNew<vtkIdList> ids;
  for (vtkDataSet* grid : grids)
  {
    size.Points += grid->GetNumberOfPoints();
    const vtkIdType cells = grid->GetNumberOfCells();
    if (HasOneType(grid))
    {
      // For structured data this includes blanked cells: counting them would take time.
      size.Tetrahedra += KindOf(VTK_VOXEL).Tetrahedra * cells;
      continue;
    }
    const CellReader reader(grid);
    if (reader.HasOnlyTetrahedra())
    {
      size.Tetrahedra += cells;
      continue;
    }
    for (vtkIdType c = 0; c < cells; ++c)
    {
      const int type = reader.GetType(c);
      size.Tetrahedra += KindOf(type).Tetrahedra;
      UnusableCells counted;
      if (ShapeOf(type).Degree == CellShape::Varying && reader.ReadPoints(c, ids, counted))
      {
        size.HigherOrder += ResolveCellType(type, ids->GetNumberOfIds()) == type;
      }
    }
  }
  return size;
}

}

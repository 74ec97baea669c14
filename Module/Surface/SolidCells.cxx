// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/SolidCells.h"

#include "Common/DisjointSets.h"
#include "Common/FiniteVector.h"
#include "Surface/TetrahedronShape.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace meniscus
{

namespace
{

/** A face by its sorted corners, and the cell that has it. */
using FaceOfCell = std::pair<Triangle, std::size_t>;

Triangle Sorted(Triangle face)
{
  std::sort(face.begin(), face.end());
  return face;
}

// All faces of all cells; the two cells of a face are neighbours in the list.
std::vector<FaceOfCell> ListFaces(const std::vector<Tetrahedron>& cells)
{
  std::vector<FaceOfCell> faces;
  faces.reserve(4 * cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    const Tetrahedron& cell = cells[c];
    for (std::size_t without = 0; without < 4; ++without)
    {
      faces.emplace_back(
        Sorted({ cell[(without + 1) % 4], cell[(without + 2) % 4], cell[(without + 3) % 4] }), c);
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

double SixfoldVolumeOf(const TetrahedronCells& cells, const Tetrahedron& cell)
{
  const auto point = [&](std::size_t i) { return cells.Points[static_cast<std::size_t>(cell[i])]; };
  return SixfoldVolume(point(0), point(1), point(2), point(3));
}

bool IsCellFlat(const TetrahedronCells& cells, const Tetrahedron& cell)
{
  const auto point = [&](std::size_t i) { return cells.Points[static_cast<std::size_t>(cell[i])]; };
  return IsFlat(point(0), point(1), point(2), point(3));
}

// Winding number of each region, at the centroid of its largest cell: far from the surface, so that
// rounding of the solid angles is far from half a turn.
std::map<int, int> FindWindings(const TriangleSurface& surface, const TetrahedronCells& cells)
{
  std::map<int, std::pair<double, std::size_t>> largest;
  for (std::size_t c = 0; c < cells.Cells.size(); ++c)
  {
    const double volume = SixfoldVolumeOf(cells, cells.Cells[c]);
    auto& best = largest.emplace(cells.Regions[c], std::make_pair(-1.0, c)).first->second;
    if (volume > best.first)
    {
      best = { volume, c };
    }
  }
  std::map<int, int> windings;
  for (const auto& region : largest)
  {
    glm::dvec3 center(0.0);
    for (const int corner : cells.Cells[region.second.second])
    {
      center += 0.25 * cells.Points[static_cast<std::size_t>(corner)];
    }
    windings[region.first] = ComputeWindingNumber(surface, center);
  }
  return windings;
}

// Bound of the difference of volumes: points that the mesher adds to triangles are off their planes
// by at most `distance`, so that the volume between both surfaces is at most area times distance.
double BoundVolumeError(const TriangleSurface& surface, double relativeTolerance)
{
  double area = 0.0;
  glm::dvec3 lower = surface.Points.front();
  glm::dvec3 upper = lower;
  for (const glm::dvec3& point : surface.Points)
  {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  for (const Triangle& triangle : surface.Triangles)
  {
    const auto point = [&](std::size_t i)
    { return surface.Points[static_cast<std::size_t>(triangle[i])]; };
    area += 0.5 * glm::length(glm::cross(point(1) - point(0), point(2) - point(0)));
  }
  return area * relativeTolerance * glm::length(upper - lower);
}

// Removes points that no cell has, except for the first ones, which are the surface's.
void DropUnusedPoints(std::size_t first, TetrahedronCells& cells)
{
  std::vector<int> place(cells.Points.size(), -1);
  for (const Tetrahedron& cell : cells.Cells)
  {
    for (const int corner : cell)
    {
      place[static_cast<std::size_t>(corner)] = 0;
    }
  }
  std::size_t kept = 0;
  for (std::size_t p = 0; p < place.size(); ++p)
  {
    if (p < first || place[p] == 0)
    {
      cells.Points[kept] = cells.Points[p];
      place[p] = static_cast<int>(kept++);
    }
  }
  cells.Points.resize(kept);
  for (Tetrahedron& cell : cells.Cells)
  {
    for (int& corner : cell)
    {
      corner = place[static_cast<std::size_t>(corner)];
    }
  }
}

// Keeps the regions of one winding number, 0 or 1, and compares the volume of those of 1 with that
// of the surface.
SolidFault KeepRegions(
  const TriangleSurface& surface, double relativeTolerance, int winding, TetrahedronCells& cells)
{
  for (Tetrahedron& cell : cells.Cells)
  {
    if (SixfoldVolumeOf(cells, cell) < 0.0)
    {
      std::swap(cell[2], cell[3]);
    }
  }
  const std::map<int, int> windings = FindWindings(surface, cells);
  for (const auto& region : windings)
  {
    if (region.second != 0 && region.second != 1)
    {
      return SolidFault::Nesting;
    }
  }
  std::size_t kept = 0;
  double sixfold = 0.0;
  bool flat = false;
  for (std::size_t c = 0; c < cells.Cells.size(); ++c)
  {
    const int own = windings.at(cells.Regions[c]);
    sixfold += own == 1 ? SixfoldVolumeOf(cells, cells.Cells[c]) : 0.0;
    if (own == winding)
    {
      // Cells outside are not seen, so that they may be flat.
      flat = flat || (own == 1 && IsCellFlat(cells, cells.Cells[c]));
      cells.Cells[kept] = cells.Cells[c];
      cells.Regions[kept] = cells.Regions[c];
      ++kept;
    }
  }
  cells.Cells.resize(kept);
  cells.Regions.resize(kept);
  DropUnusedPoints(surface.Points.size(), cells);
  const double difference = std::abs(sixfold / 6.0 - ComputeEnclosedVolume(surface));
  if (flat)
  {
    return SolidFault::FlatCells;
  }
  return difference <= BoundVolumeError(surface, relativeTolerance) ? SolidFault::None
                                                                    : SolidFault::WrongVolume;
}

// Cells with the first of all points of equal coordinates; without those that lose a corner by
// that.
std::vector<Tetrahedron> JoinCorners(
  const std::vector<glm::dvec3>& points, const std::vector<Tetrahedron>& cells)
{
  std::map<std::array<double, 3>, int> known;
  std::vector<int> first(points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    const glm::dvec3& x = points[p];
    const int own = static_cast<int>(p);
    // Numbers that are not finite have no place in an order.
    const bool isFinite = IsFinite(x);
    first[p] =
      isFinite ? known.emplace(std::array<double, 3>{ x.x, x.y, x.z }, own).first->second : own;
  }
  std::vector<Tetrahedron> joined;
  joined.reserve(cells.size());
  for (Tetrahedron cell : cells)
  {
    for (int& corner : cell)
    {
      corner = first[static_cast<std::size_t>(corner)];
    }
    Tetrahedron sorted = cell;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
    {
      joined.push_back(cell);
    }
  }
  return joined;
}

// A face of a cell in VTK's order of corners, counterclockwise as seen from outside.
Triangle SeenFromOutside(const Tetrahedron& cell, const Triangle& face)
{
  const std::array<Triangle, 4> without{ { { cell[1], cell[2], cell[3] },
    { cell[0], cell[3], cell[2] }, { cell[0], cell[1], cell[3] }, { cell[0], cell[2], cell[1] } } };
  return *std::find_if(without.begin(), without.end(),
    [&](const Triangle& candidate) { return Sorted(candidate) == face; });
}

bool IsEvenPermutation(const Triangle& face)
{
  return ((face[0] > face[1]) + (face[0] > face[2]) + (face[1] > face[2])) % 2 == 0;
}

// Cells whose corners are in the other order than VTK's: neighbours agree, and the volume of
// connected cells is positive. A cell that is inverted in a mesh of the right order is not turned,
// so that it counts with a negative volume.
std::vector<bool> FindTurnedCells(
  const TetrahedronCells& mesh, const std::vector<FaceOfCell>& faces)
{
  std::vector<std::vector<std::pair<std::size_t, bool>>> neighbors(mesh.Cells.size());
  for (std::size_t f = 1; f < faces.size(); ++f)
  {
    if (faces[f - 1].first == faces[f].first)
    {
      const std::size_t a = faces[f - 1].second;
      const std::size_t b = faces[f].second;
      const bool differ = IsEvenPermutation(SeenFromOutside(mesh.Cells[a], faces[f].first)) ==
        IsEvenPermutation(SeenFromOutside(mesh.Cells[b], faces[f].first));
      neighbors[a].emplace_back(b, differ);
      neighbors[b].emplace_back(a, differ);
    }
  }
  std::vector<bool> turned(mesh.Cells.size(), false);
  std::vector<bool> known(mesh.Cells.size(), false);
  std::vector<std::size_t> piece;
  for (std::size_t seed = 0; seed < mesh.Cells.size(); ++seed)
  {
    if (known[seed])
    {
      continue;
    }
    known[seed] = true;
    piece.assign(1, seed);
    double sixfold = 0.0;
    for (std::size_t i = 0; i < piece.size(); ++i)
    {
      const std::size_t cell = piece[i];
      sixfold += (turned[cell] ? -1.0 : 1.0) * SixfoldVolumeOf(mesh, mesh.Cells[cell]);
      for (const auto& neighbor : neighbors[cell])
      {
        if (!known[neighbor.first])
        {
          known[neighbor.first] = true;
          turned[neighbor.first] = turned[cell] != neighbor.second;
          piece.push_back(neighbor.first);
        }
      }
    }
    for (const std::size_t cell : piece)
    {
      turned[cell] = turned[cell] != (sixfold < 0.0);
    }
  }
  return turned;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::size_t NumberRegions(const TriangleSurface& surface, TetrahedronCells& cells)
{
  std::set<Triangle> walls;
  for (const Triangle& triangle : surface.Triangles)
  {
    walls.insert(Sorted(triangle));
  }
  DisjointSets sets(cells.Cells.size());
  const std::vector<FaceOfCell> faces = ListFaces(cells.Cells);
  std::set<Triangle> found;
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const bool shared = f > 0 && faces[f - 1].first == faces[f].first;
    if (walls.count(faces[f].first) > 0)
    {
      found.insert(faces[f].first);
    }
    else if (shared)
    {
      sets.Join(faces[f - 1].second, faces[f].second);
    }
  }
  cells.Regions.resize(cells.Cells.size());
  for (std::size_t c = 0; c < cells.Cells.size(); ++c)
  {
    cells.Regions[c] = static_cast<int>(sets.Find(c));
  }
  return walls.size() - found.size();
}

//------------------------------------------------------------------------------
SolidFault KeepSolid(
  const TriangleSurface& surface, double relativeTolerance, TetrahedronCells& cells)
{
  return KeepRegions(surface, relativeTolerance, 1, cells);
}

//------------------------------------------------------------------------------
SolidFault KeepOutside(
  const TriangleSurface& surface, double relativeTolerance, TetrahedronCells& cells)
{
  return KeepRegions(surface, relativeTolerance, 0, cells);
}

//------------------------------------------------------------------------------
TriangleSurface FindBoundary(
  const std::vector<glm::dvec3>& points, const std::vector<Tetrahedron>& cells)
{
  TetrahedronCells joined;
  joined.Points = points;
  joined.Cells = JoinCorners(points, cells);
  const std::vector<FaceOfCell> faces = ListFaces(joined.Cells);
  const std::vector<bool> turned = FindTurnedCells(joined, faces);
  std::vector<Triangle> boundary;
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const bool before = f > 0 && faces[f - 1].first == faces[f].first;
    const bool after = f + 1 < faces.size() && faces[f + 1].first == faces[f].first;
    if (!before && !after)
    {
      Triangle face = SeenFromOutside(joined.Cells[faces[f].second], faces[f].first);
      if (turned[faces[f].second])
      {
        std::swap(face[1], face[2]);
      }
      boundary.push_back(face);
    }
  }
  return JoinCoincidentPoints(points, boundary);
}

//------------------------------------------------------------------------------
std::vector<bool> FindBoundaryPoints(const TetrahedronCells& cells)
{
  std::vector<bool> boundary(cells.Points.size(), false);
  const std::vector<FaceOfCell> faces = ListFaces(cells.Cells);
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    const bool before = f > 0 && faces[f - 1].first == faces[f].first;
    const bool after = f + 1 < faces.size() && faces[f + 1].first == faces[f].first;
    for (std::size_t i = 0; !before && !after && i < 3; ++i)
    {
      boundary[static_cast<std::size_t>(faces[f].first[i])] = true;
    }
  }
  return boundary;
}

//------------------------------------------------------------------------------
CellQuality MeasureQuality(const TetrahedronCells& cells, double bound)
{
  CellQuality quality;
  for (const Tetrahedron& cell : cells.Cells)
  {
    const auto point = [&](std::size_t i)
    { return cells.Points[static_cast<std::size_t>(cell[i])]; };
    const double ratio = RadiusEdgeRatio(point(0), point(1), point(2), point(3));
    quality.LargestRadiusEdgeRatio = std::max(quality.LargestRadiusEdgeRatio, ratio);
    quality.CellsAboveBound += ratio > bound ? 1 : 0;
  }
  return quality;
}

} // namespace meniscus

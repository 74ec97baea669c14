// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/SolidCells.h"

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

/** Sets of cells that are joined one by one. */
class CellSets
{
public:
  explicit CellSets(std::size_t count)
    : Parents(count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Parents[i] = i;
    }
  }

  std::size_t Find(std::size_t cell)
  {
    while (this->Parents[cell] != cell)
    {
      this->Parents[cell] = this->Parents[this->Parents[cell]];
      cell = this->Parents[cell];
    }
    return cell;
  }

  void Join(std::size_t a, std::size_t b) { this->Parents[this->Find(a)] = this->Find(b); }

private:
  std::vector<std::size_t> Parents;
};

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

// Removes points that no cell has, except for the first ones, those of the surface.
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

} // anonymous namespace

//------------------------------------------------------------------------------
std::size_t NumberRegions(const TriangleSurface& surface, TetrahedronCells& cells)
{
  std::set<Triangle> walls;
  for (const Triangle& triangle : surface.Triangles)
  {
    walls.insert(Sorted(triangle));
  }
  CellSets sets(cells.Cells.size());
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
    if (windings.at(cells.Regions[c]) == 1)
    {
      const double volume = SixfoldVolumeOf(cells, cells.Cells[c]);
      flat = flat || IsCellFlat(cells, cells.Cells[c]);
      sixfold += volume;
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

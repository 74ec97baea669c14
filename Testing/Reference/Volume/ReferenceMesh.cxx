// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus::reference
{

namespace
{

// Faces of a tetrahedron, each opposite the vertex with its index, outward for a positive volume.
constexpr int FaceVertices[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

// Distance by which every half-space is widened, relative to the mesh's diagonal, so that rounding
// opens no crack between neighbours: 1e-16 for each of the about 10 operations, with a factor of
// 100.
constexpr double WideningDistance = 1e-13;

// A cell is flat if its height is below this fraction of the mesh's diagonal: ten times the
// widening, which would otherwise dominate its shape.
constexpr double FlatHeight = 10.0 * WideningDistance;

using Exact = long double;
using ExactVector = std::array<Exact, 3>;

struct FaceKey
{
  std::array<std::int64_t, 3> Ids;
  std::int64_t CellFace;
  int Parity;
};

ExactVector GetEdge(const double* from, const double* to)
{
  return { Exact(to[0]) - from[0], Exact(to[1]) - from[1], Exact(to[2]) - from[2] };
}

ExactVector Cross(const ExactVector& a, const ExactVector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Exact Dot(const ExactVector& a, const ExactVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Sorts the ids of a face; the parity of the sorting distinguishes the face's two sides.
FaceKey MakeFaceKey(const std::int64_t* cell, std::int64_t cellId, int face)
{
  const int* local = FaceVertices[face];
  FaceKey key{ { cell[local[0]], cell[local[1]], cell[local[2]] }, 4 * cellId + face, 1 };
  const auto order = [&key](int a, int b)
  {
    if (key.Ids[a] > key.Ids[b])
    {
      std::swap(key.Ids[a], key.Ids[b]);
      key.Parity = -key.Parity;
    }
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return key;
}

struct Neighbor
{
  std::int64_t CellFace = -1;
  int Orientation = 1;
};

// Pairs faces with the same ids. Of a face shared by more than two cells, only pairs are linked.
std::vector<Neighbor> LinkFaces(std::vector<FaceKey>& keys, std::size_t cells, std::size_t& single)
{
  std::sort(keys.begin(), keys.end(),
    [](const FaceKey& a, const FaceKey& b)
    { return a.Ids != b.Ids ? a.Ids < b.Ids : a.CellFace < b.CellFace; });
  std::vector<Neighbor> neighbors(4 * cells);
  single = 0;
  for (std::size_t i = 0; i < keys.size();)
  {
    if (i + 1 == keys.size() || keys[i].Ids != keys[i + 1].Ids)
    {
      ++single;
      ++i;
      continue;
    }
    const int same = keys[i].Parity == keys[i + 1].Parity ? -1 : 1;
    neighbors[keys[i].CellFace] = { keys[i + 1].CellFace, same };
    neighbors[keys[i + 1].CellFace] = { keys[i].CellFace, same };
    i += 2;
  }
  return neighbors;
}

} // anonymous namespace

//------------------------------------------------------------------------------
ReferenceMesh::ReferenceMesh(
  std::vector<double> points, std::vector<std::int64_t> cells, std::vector<double> scalars)
  : Points(std::move(points))
  , Cells(std::move(cells))
  , Scalars(std::move(scalars))
  , Planes(Cells.size() / 4)
{
  std::vector<char> usable(this->GetNumberOfCells());
  for (std::size_t id = 0; id < usable.size(); ++id)
  {
    usable[id] = this->IsUsable(id);
  }
  this->FindBounds(usable);
  this->FindKinds(this->VolumeSigns(usable));
  for (std::size_t id = 0; id < this->Kinds.size(); ++id)
  {
    if (this->Kinds[id] == CellKind::Contributing || this->Kinds[id] == CellKind::Inverted)
    {
      this->FindPlanes(id);
    }
  }
}

//------------------------------------------------------------------------------
bool ReferenceMesh::IsUsable(std::size_t id) const
{
  const std::int64_t* ids = this->GetCell(id);
  const auto points = static_cast<std::int64_t>(this->Points.size() / 3);
  for (int i = 0; i < 4; ++i)
  {
    if (ids[i] < 0 || ids[i] >= points || !std::isfinite(this->Scalars[ids[i]]))
    {
      return false;
    }
    const double* x = this->GetPoint(ids[i]);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Sign of each cell's volume; 0 for a flat cell, 2 for an unusable one.
std::vector<int> ReferenceMesh::VolumeSigns(const std::vector<char>& usable) const
{
  std::vector<int> signs(this->GetNumberOfCells(), 2);
  for (std::size_t id = 0; id < signs.size(); ++id)
  {
    if (!usable[id])
    {
      continue;
    }
    const std::int64_t* ids = this->GetCell(id);
    const double* origin = this->GetPoint(ids[0]);
    const ExactVector a = GetEdge(origin, this->GetPoint(ids[1]));
    const ExactVector b = GetEdge(origin, this->GetPoint(ids[2]));
    const ExactVector c = GetEdge(origin, this->GetPoint(ids[3]));
    const Exact volume = Dot(Cross(a, b), c);
    const Exact longestSquared = std::max({ Dot(a, a), Dot(b, b), Dot(c, c) });
    const Exact flat = FlatHeight * this->Diagonal * longestSquared;
    signs[id] = volume > flat ? 1 : (volume < -flat ? -1 : 0);
  }
  return signs;
}

//------------------------------------------------------------------------------
// Orientation (+1 or -1) of the stored vertex order that makes all cells of a component agree.
std::vector<int> ReferenceMesh::Orient(const std::vector<int>& signs)
{
  std::vector<FaceKey> keys;
  keys.reserve(4 * signs.size());
  for (std::size_t id = 0; id < signs.size(); ++id)
  {
    for (int face = 0; signs[id] != 2 && face < 4; ++face)
    {
      keys.push_back(MakeFaceKey(this->GetCell(id), static_cast<std::int64_t>(id), face));
    }
  }
  const std::vector<Neighbor> neighbors = LinkFaces(keys, signs.size(), this->BoundaryFaces);
  this->Neighbors.reserve(neighbors.size());
  for (const Neighbor& neighbor : neighbors)
  {
    this->Neighbors.push_back(neighbor.CellFace);
  }

  std::vector<int> orientation(signs.size(), 0);
  std::vector<std::size_t> component;
  for (std::size_t seed = 0; seed < signs.size(); ++seed)
  {
    if (signs[seed] == 2 || orientation[seed] != 0)
    {
      continue;
    }
    component.assign(1, seed);
    orientation[seed] = 1;
    std::int64_t balance = 0;
    for (std::size_t next = 0; next < component.size(); ++next)
    {
      const std::size_t id = component[next];
      balance += orientation[id] * signs[id];
      for (int face = 0; face < 4; ++face)
      {
        const Neighbor& neighbor = neighbors[4 * id + face];
        const std::int64_t other = neighbor.CellFace / 4;
        if (neighbor.CellFace >= 0 && orientation[other] == 0)
        {
          orientation[other] = orientation[id] * neighbor.Orientation;
          component.push_back(static_cast<std::size_t>(other));
        }
      }
    }
    for (const std::size_t id : component)
    {
      orientation[id] = balance < 0 ? -orientation[id] : orientation[id];
    }
  }
  return orientation;
}

//------------------------------------------------------------------------------
void ReferenceMesh::FindKinds(const std::vector<int>& signs)
{
  const std::vector<int> orientation = this->Orient(signs);
  this->Kinds.reserve(signs.size());
  for (std::size_t id = 0; id < signs.size(); ++id)
  {
    const bool inverted = signs[id] * orientation[id] < 0;
    const CellKind kind = signs[id] == 2 ? CellKind::Rejected
      : signs[id] == 0                   ? CellKind::Flat
      : inverted                         ? CellKind::Inverted
                                         : CellKind::Contributing;
    this->Kinds.push_back(kind);
    this->RejectedCells += kind == CellKind::Rejected;
    this->ZeroVolumeCells += kind == CellKind::Flat;
    this->InvertedCells += kind == CellKind::Inverted;
    if (kind == CellKind::Contributing)
    {
      this->Contributing.push_back(static_cast<std::int64_t>(id));
    }
  }
}

//------------------------------------------------------------------------------
void ReferenceMesh::FindBounds(const std::vector<char>& usable)
{
  if (std::find(usable.begin(), usable.end(), 1) == usable.end())
  {
    return;
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector3 low{ infinity, infinity, infinity };
  Vector3 high{ -infinity, -infinity, -infinity };
  for (std::size_t id = 0; id < usable.size(); ++id)
  {
    for (int i = 0; usable[id] && i < 4; ++i)
    {
      const double* x = this->GetPoint(this->GetCell(id)[i]);
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], x[axis]);
        high[axis] = std::max(high[axis], x[axis]);
      }
    }
  }
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Center[axis] = 0.5 * (low[axis] + high[axis]);
    square += (high[axis] - low[axis]) * (high[axis] - low[axis]);
  }
  this->Diagonal = std::sqrt(square);
}

//------------------------------------------------------------------------------
void ReferenceMesh::FindPlanes(std::size_t id)
{
  const std::int64_t* ids = this->GetCell(id);
  CellPlanes& planes = this->Planes[id];
  for (int i = 0; i < 4; ++i)
  {
    const double* base = this->GetPoint(ids[FaceVertices[i][0]]);
    const ExactVector normal = Cross(GetEdge(base, this->GetPoint(ids[FaceVertices[i][1]])),
      GetEdge(base, this->GetPoint(ids[FaceVertices[i][2]])));
    const Exact height = Dot(normal, GetEdge(base, this->GetPoint(ids[i])));
    const ExactVector toBase = { Exact(base[0]) - this->Center[0], Exact(base[1]) - this->Center[1],
      Exact(base[2]) - this->Center[2] };
    for (int axis = 0; axis < 3; ++axis)
    {
      planes.Gradient[i][axis] = static_cast<double>(normal[axis] / height);
    }
    planes.Offset[i] = static_cast<double>(-Dot(normal, toBase) / height);
    planes.Slack[i] = static_cast<double>(std::sqrt(Dot(normal, normal)) / std::fabs(height)) *
      WideningDistance * this->Diagonal;
  }
}

} // namespace meniscus::reference

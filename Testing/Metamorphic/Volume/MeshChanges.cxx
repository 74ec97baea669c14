// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChanges.h"

#include "MeshFamilies.h"

namespace meniscus::test
{

namespace
{

// The same mesh without points, cells and values.
MeshArrays EmptyLike(const MeshArrays& mesh)
{
  MeshArrays result;
  result.Components = mesh.Components;
  result.OnCells = mesh.OnCells;
  return result;
}

// Points between points of a mesh, each created once.
class MiddlePoints
{
public:
  explicit MiddlePoints(MeshArrays& mesh)
    : Mesh(mesh)
  {
  }

  vtkIdType Of(std::vector<vtkIdType> ids)
  {
    std::sort(ids.begin(), ids.end());
    const auto known = this->Known.find(ids);
    if (known != this->Known.end())
    {
      return known->second;
    }
    const double share = 1.0 / static_cast<double>(ids.size());
    glm::dvec3 middle(0.0);
    std::vector<double> values(static_cast<std::size_t>(this->Mesh.Components), 0.0);
    for (const vtkIdType id : ids)
    {
      middle += share * this->Mesh.Points[static_cast<std::size_t>(id)];
      for (int c = 0; c < this->Mesh.Components && !this->Mesh.OnCells; ++c)
      {
        values[static_cast<std::size_t>(c)] +=
          share * this->Mesh.GetValue(static_cast<std::size_t>(id), c);
      }
    }
    const auto added = static_cast<vtkIdType>(this->Mesh.Points.size());
    this->Mesh.Points.push_back(middle);
    if (!this->Mesh.OnCells)
    {
      this->Mesh.Values.insert(this->Mesh.Values.end(), values.begin(), values.end());
    }
    return this->Known[ids] = added;
  }

private:
  MeshArrays& Mesh;
  std::map<std::vector<vtkIdType>, vtkIdType> Known;
};

} // anonymous namespace

//------------------------------------------------------------------------------
void ShuffleCells(MeshArrays& mesh, RandomNumbers& random)
{
  std::vector<std::size_t> order(mesh.Cells.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  Shuffle(order, random);
  MeshArrays result = EmptyLike(mesh);
  result.Points = mesh.Points;
  result.Values = mesh.OnCells ? std::vector<double>() : mesh.Values;
  for (const std::size_t cell : order)
  {
    result.AddCell(mesh, cell);
  }
  mesh = result;
}

//------------------------------------------------------------------------------
void TurnCells(MeshArrays& mesh, RandomNumbers& random)
{
  for (MeshCell& cell : mesh.Cells)
  {
    Shuffle(cell.Ids, random);
  }
}

//------------------------------------------------------------------------------
void ShufflePoints(MeshArrays& mesh, RandomNumbers& random)
{
  std::vector<std::size_t> order(mesh.Points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  Shuffle(order, random);
  std::vector<vtkIdType> newId(order.size());
  MeshArrays result = EmptyLike(mesh);
  for (const std::size_t point : order)
  {
    newId[point] = result.AddPoint(mesh, point);
  }
  for (std::size_t c = 0; c < mesh.Cells.size(); ++c)
  {
    result.AddCell(mesh, c);
    for (vtkIdType& id : result.Cells.back().Ids)
    {
      id = newId[static_cast<std::size_t>(id)];
    }
  }
  mesh = result;
}

//------------------------------------------------------------------------------
void AddIdlePoints(MeshArrays& mesh, RandomNumbers& random)
{
  const MeshArrays before = mesh;
  for (int i = 0; i < 20; ++i)
  {
    mesh.AddPoint(
      before, static_cast<std::size_t>(random.Below(static_cast<int>(before.Points.size()))));
  }
}

//------------------------------------------------------------------------------
void UnsharePoints(MeshArrays& mesh)
{
  MeshArrays result = EmptyLike(mesh);
  for (std::size_t c = 0; c < mesh.Cells.size(); ++c)
  {
    result.AddCell(mesh, c);
    std::vector<vtkIdType> sorted = mesh.Cells[c].Ids;
    std::sort(sorted.begin(), sorted.end());
    std::map<vtkIdType, vtkIdType> own;
    for (const vtkIdType id : sorted)
    {
      own[id] = result.AddPoint(mesh, static_cast<std::size_t>(id));
    }
    for (vtkIdType& id : result.Cells.back().Ids)
    {
      id = own[id];
    }
  }
  mesh = result;
}

//------------------------------------------------------------------------------
std::vector<MeshArrays> SplitMesh(const MeshArrays& mesh, int parts, RandomNumbers& random)
{
  // Half-spaces, or scattered cells.
  const bool scattered = random.Below(2) == 0;
  const glm::dvec3 normal = random.GetDirection();
  std::vector<std::vector<std::size_t>> cells(static_cast<std::size_t>(parts));
  for (std::size_t c = 0; c < mesh.Cells.size(); ++c)
  {
    const glm::dvec3& p = mesh.Points[static_cast<std::size_t>(mesh.Cells[c].Ids[0])];
    const double height = 0.5 + 0.4 * glm::dot(normal, p);
    const int part =
      scattered ? random.Below(parts) : std::clamp(static_cast<int>(height * parts), 0, parts - 1);
    cells[static_cast<std::size_t>(part)].push_back(c);
  }
  std::vector<MeshArrays> result;
  for (const std::vector<std::size_t>& own : cells)
  {
    if (own.empty())
    {
      continue;
    }
    std::vector<vtkIdType> newId(mesh.Points.size(), -1);
    for (const std::size_t c : own)
    {
      for (const vtkIdType id : mesh.Cells[c].Ids)
      {
        newId[static_cast<std::size_t>(id)] = 0;
      }
    }
    MeshArrays block = EmptyLike(mesh);
    for (std::size_t p = 0; p < newId.size(); ++p)
    {
      newId[p] = newId[p] < 0 ? -1 : block.AddPoint(mesh, p);
    }
    for (const std::size_t c : own)
    {
      block.AddCell(mesh, c);
      for (vtkIdType& id : block.Cells.back().Ids)
      {
        id = newId[static_cast<std::size_t>(id)];
      }
    }
    result.push_back(block);
  }
  return result;
}

//------------------------------------------------------------------------------
MeshArrays AppendMeshes(const std::vector<MeshArrays>& meshes)
{
  MeshArrays result = EmptyLike(meshes.front());
  for (const MeshArrays& mesh : meshes)
  {
    const auto shift = static_cast<vtkIdType>(result.Points.size());
    for (std::size_t p = 0; p < mesh.Points.size(); ++p)
    {
      result.AddPoint(mesh, p);
    }
    for (std::size_t c = 0; c < mesh.Cells.size(); ++c)
    {
      result.AddCell(mesh, c);
      for (vtkIdType& id : result.Cells.back().Ids)
      {
        id += shift;
      }
    }
  }
  return result;
}

//------------------------------------------------------------------------------
void DivideTetrahedra(MeshArrays& mesh, int parts)
{
  const MeshArrays before = mesh;
  mesh.Cells.clear();
  mesh.Values = mesh.OnCells ? std::vector<double>() : mesh.Values;
  MiddlePoints middles(mesh);
  for (std::size_t c = 0; c < before.Cells.size(); ++c)
  {
    const std::vector<vtkIdType>& v = before.Cells[c].Ids;
    std::vector<std::vector<vtkIdType>> pieces;
    if (parts == 4)
    {
      const vtkIdType m = middles.Of(v);
      pieces = { { m, v[1], v[2], v[3] }, { v[0], m, v[2], v[3] }, { v[0], v[1], m, v[3] },
        { v[0], v[1], v[2], m } };
    }
    else
    {
      const vtkIdType a = middles.Of({ v[0], v[1] });
      const vtkIdType b = middles.Of({ v[0], v[2] });
      const vtkIdType d = middles.Of({ v[0], v[3] });
      const vtkIdType e = middles.Of({ v[1], v[2] });
      const vtkIdType f = middles.Of({ v[1], v[3] });
      const vtkIdType g = middles.Of({ v[2], v[3] });
      // Corners, then the octahedron between them about its axis from a to g.
      pieces = { { v[0], a, b, d }, { a, v[1], e, f }, { b, e, v[2], g }, { d, f, g, v[3] },
        { a, g, b, d }, { a, g, d, f }, { a, g, f, e }, { a, g, e, b } };
    }
    for (const std::vector<vtkIdType>& piece : pieces)
    {
      mesh.Cells.push_back({ VTK_TETRA, piece });
      if (mesh.OnCells)
      {
        mesh.AddTuple(before, c);
      }
    }
  }
}

namespace
{

/** Type of a cell of second order with the shape of a linear one, drawn by lot. */
int SecondOrderOf(int type, RandomNumbers& random)
{
  switch (type)
  {
    case VTK_TETRA:
      return VTK_QUADRATIC_TETRA;
    case VTK_PYRAMID:
      return VTK_QUADRATIC_PYRAMID;
    case VTK_WEDGE:
      return random.Below(2) ? VTK_BIQUADRATIC_QUADRATIC_WEDGE : VTK_QUADRATIC_WEDGE;
    default:
    {
      const int types[3] = { VTK_QUADRATIC_HEXAHEDRON, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON,
        VTK_TRIQUADRATIC_HEXAHEDRON };
      return types[random.Below(3)];
    }
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
void MakeQuadratic(MeshArrays& mesh, RandomNumbers& random)
{
  MiddlePoints middles(mesh);
  for (MeshCell& cell : mesh.Cells)
  {
    cell.Type = SecondOrderOf(cell.Type, random);
    const std::vector<vtkIdType> corners = cell.Ids;
    for (const std::vector<int>& places : FurtherPoints(cell.Type))
    {
      std::vector<vtkIdType> ids;
      for (const int place : places)
      {
        ids.push_back(corners[static_cast<std::size_t>(place)]);
      }
      cell.Ids.push_back(middles.Of(ids));
    }
  }
}

//------------------------------------------------------------------------------
MeshArrays MakeRectilinearCells(RandomNumbers& random)
{
  std::array<std::vector<double>, 3> at;
  for (std::vector<double>& places : at)
  {
    const int count = 2 + random.Below(5);
    for (int i = 0; i < count; ++i)
    {
      places.push_back(-1.0 + 2.0 * (i + 0.4 * random.Uniform()) / count);
    }
  }
  MeshArrays mesh;
  const std::array<vtkIdType, 3> n{ vtkIdType(at[0].size()), vtkIdType(at[1].size()),
    vtkIdType(at[2].size()) };
  for (const double z : at[2])
  {
    for (const double y : at[1])
    {
      for (const double x : at[0])
      {
        mesh.Points.emplace_back(x, y, z);
      }
    }
  }
  const bool voxels = random.Below(2) == 0;
  for (vtkIdType k = 0; k + 1 < n[2]; ++k)
  {
    for (vtkIdType j = 0; j + 1 < n[1]; ++j)
    {
      for (vtkIdType i = 0; i + 1 < n[0]; ++i)
      {
        const vtkIdType a = i + n[0] * (j + n[1] * k);
        const vtkIdType b = a + n[0];
        const vtkIdType c = a + n[0] * n[1];
        const vtkIdType d = c + n[0];
        mesh.Cells.push_back(voxels
            ? MeshCell{ VTK_VOXEL, { a, a + 1, b, b + 1, c, c + 1, d, d + 1 } }
            : MeshCell{ VTK_HEXAHEDRON, { a, a + 1, b + 1, b, c, c + 1, d + 1, d } });
      }
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRectilinearGrid> ToRectilinear(const MeshArrays& mesh)
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  int dimensions[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> places;
    for (const glm::dvec3& p : mesh.Points)
    {
      places.push_back(p[axis]);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    dimensions[axis] = static_cast<int>(places.size());
    vtkNew<vtkDoubleArray> coordinates;
    for (const double place : places)
    {
      coordinates->InsertNextValue(place);
    }
    axis == 0     ? grid->SetXCoordinates(coordinates)
      : axis == 1 ? grid->SetYCoordinates(coordinates)
                  : grid->SetZCoordinates(coordinates);
  }
  grid->SetDimensions(dimensions);
  const Grid cells = ToGrid(mesh);
  if (mesh.OnCells)
  {
    grid->GetCellData()->SetScalars(cells->GetCellData()->GetScalars());
  }
  else
  {
    grid->GetPointData()->SetScalars(cells->GetPointData()->GetScalars());
  }
  return grid;
}

//------------------------------------------------------------------------------
void SetRandomFieldsLike(MeshArrays& mesh, const MeshArrays& other, RandomNumbers& random)
{
  SetRandomFields(mesh, other.Components, false, random);
  for (int c = 0; c < other.Components; ++c)
  {
    const auto from = mesh.MakeRange(c);
    const auto to = other.MakeRange(c);
    const double width = from[1] > from[0] ? from[1] - from[0] : 1.0;
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      double& value = mesh.Values[i * static_cast<std::size_t>(mesh.Components) + c];
      value = to[0] + (value - from[0]) / width * (to[1] - to[0]);
    }
  }
  if (other.OnCells)
  {
    MoveToCells(mesh);
  }
}

} // namespace meniscus::test

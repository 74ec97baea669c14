// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TrueCellMeshes.h"

namespace meniscus::test
{

namespace
{

using Ids = std::vector<vtkIdType>;

/** Builder of MakeMixedBlock(). */
class MixedBlock
{
public:
  MixedBlock(int n, bool quadratic, unsigned int seed)
    : N(n)
    , Quadratic(quadratic)
    , Random(seed)
    , Move(-0.2 / n, 0.2 / n)
  {
    this->Points->SetDataTypeToDouble();
    this->Scalars->SetName("s");
  }

  Grid Make()
  {
    const int row = this->N + 1;
    for (int i = 0; i < row * row * row; ++i)
    {
      const glm::dvec3 at(i % row, i / row % row, i / row / row);
      this->Corners.push_back(this->AddPoint(2.0 / this->N * at - 1.0));
    }
    this->Mesh->SetPoints(this->Points);
    for (int cube = 0; cube < this->N * this->N * this->N; ++cube)
    {
      this->AddCube(cube);
    }
    this->Mesh->GetPointData()->SetScalars(this->Scalars);
    return this->Mesh;
  }

private:
  vtkIdType AddPoint(glm::dvec3 at)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      at[axis] += std::abs(at[axis]) < 1.0 - 1e-9 ? this->Move(this->Random) : 0.0;
    }
    this->Scalars->InsertNextValue(this->Value(this->Random));
    return this->Points->InsertNextPoint(at.x, at.y, at.z);
  }

  glm::dvec3 PointAt(vtkIdType id) const
  {
    const glm::dvec3 at = PointOf(this->Points, id);
    return at;
  }

  vtkIdType MiddleOf(vtkIdType a, vtkIdType b)
  {
    const std::pair<vtkIdType, vtkIdType> key = std::minmax(a, b);
    auto found = this->Middles.find(key);
    if (found == this->Middles.end())
    {
      const glm::dvec3 middle = 0.5 * (this->PointAt(a) + this->PointAt(b));
      found = this->Middles.emplace(key, this->AddPoint(middle)).first;
    }
    return found->second;
  }

  void AddCell(int linear, int curved, Ids ids)
  {
    const Ids ends = ids;
    for (const auto& edge :
      this->Quadratic ? FurtherPoints(curved) : std::vector<std::vector<int>>())
    {
      ids.push_back(this->MiddleOf(ends[edge[0]], ends[edge[1]]));
    }
    this->Mesh->InsertNextCell(
      this->Quadratic ? curved : linear, static_cast<vtkIdType>(ids.size()), ids.data());
  }

  /** Corners of a cube in the order of VTK_HEXAHEDRON. */
  std::array<vtkIdType, 8> CornersOf(int cube) const
  {
    constexpr int places[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
      { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
    std::array<vtkIdType, 8> ids{};
    const int row = this->N + 1;
    for (std::size_t i = 0; i < 8; ++i)
    {
      const int x = cube % this->N + places[i][0];
      const int y = cube / this->N % this->N + places[i][1];
      const int z = cube / this->N / this->N + places[i][2];
      ids[i] = this->Corners[static_cast<std::size_t>((z * row + y) * row + x)];
    }
    return ids;
  }

  void AddCube(int cube)
  {
    const std::array<vtkIdType, 8> h = this->CornersOf(cube);
    // Columns along y: wedges share their triangles with wedges only.
    switch ((cube % this->N + cube / this->N / this->N) % 3)
    {
      case 0:
        this->AddCell(VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, { h.begin(), h.end() });
        break;
      case 1:
        this->AddCell(VTK_WEDGE, VTK_QUADRATIC_WEDGE, { h[0], h[1], h[4], h[3], h[2], h[7] });
        this->AddCell(VTK_WEDGE, VTK_QUADRATIC_WEDGE, { h[1], h[5], h[4], h[2], h[6], h[7] });
        break;
      default:
        this->AddPyramids(h);
    }
  }

  void AddPyramids(const std::array<vtkIdType, 8>& h)
  {
    glm::dvec3 center(0.0);
    for (const vtkIdType id : h)
    {
      center += this->PointAt(id) / 8.0;
    }
    const vtkIdType apex = this->AddPoint(center);
    for (const std::array<std::size_t, 4>& f : { std::array<std::size_t, 4>{ 0, 1, 2, 3 },
           { 4, 7, 6, 5 }, { 0, 4, 5, 1 }, { 3, 2, 6, 7 }, { 0, 3, 7, 4 }, { 1, 5, 6, 2 } })
    {
      this->AddCell(
        VTK_PYRAMID, VTK_QUADRATIC_PYRAMID, { h[f[0]], h[f[1]], h[f[2]], h[f[3]], apex });
    }
  }

  int N;
  bool Quadratic;
  std::mt19937 Random;
  std::uniform_real_distribution<double> Move;
  std::uniform_real_distribution<double> Value{ 0.0, 1.0 };
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Scalars;
  Ids Corners;
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> Middles;
  Grid Mesh = Grid::New();
};

}

Grid MakeCell(const CellCase& shape, double displacement, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < shape.Points; ++i)
  {
    ids->InsertNextId(i);
  }
  // The points where the type expects them.
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(shape.Points);
  for (vtkIdType i = 0; i < shape.Points; ++i)
  {
    points->SetPoint(i, 0.0, 0.0, 0.0);
  }
  Grid grid = Grid::New();
  grid->SetPoints(points);
  grid->InsertNextCell(shape.Type, ids);
  vtkCell* cell = grid->GetCell(0);
  const double* places = cell->GetParametricCoords();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  for (vtkIdType i = 0; i < shape.Points; ++i)
  {
    glm::dvec3 place(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    if (shape.Type == VTK_PYRAMID || shape.Type == VTK_QUADRATIC_PYRAMID)
    {
      // Reference coordinates of pyramids are those of a cube with one side collapsed.
      place.x *= 1.0 - place.z;
      place.y *= 1.0 - place.z;
    }
    const glm::dvec3 moved = displacement * glm::dvec3(share(random), share(random), share(random));
    const glm::dvec3 at = 1.2 * (place - 0.4) + moved;
    points->SetPoint(i, at.x, at.y, at.z);
    // The larger the curved part, the more pieces.
    const double curved = at.x * at.y + 0.5 * at.z * at.z * at.x;
    scalars->InsertNextValue(2.0 + at.x - 0.7 * at.y + 0.4 * at.z + 0.15 * curved);
  }
  grid->GetPointData()->SetScalars(scalars);
  return grid;
}

Grid MakeMixedBlock(int n, bool quadratic, unsigned int seed)
{
  return MixedBlock(n, quadratic, seed).Make();
}

}

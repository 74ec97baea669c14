// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HardMeshes.h"

namespace meniscus::test
{

namespace
{

using Tetrahedron = std::array<vtkIdType, 4>;

struct Arrays
{
  std::vector<glm::dvec3> Points;
  std::vector<Tetrahedron> Cells;

  explicit Arrays(vtkUnstructuredGrid* grid = nullptr)
  {
    for (vtkIdType p = 0; grid && p < grid->GetNumberOfPoints(); ++p)
    {
      const double* x = grid->GetPoint(p);
      this->Points.emplace_back(x[0], x[1], x[2]);
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; grid && c < grid->GetNumberOfCells(); ++c)
    {
      grid->GetCellPoints(c, ids);
      this->Cells.push_back({ ids->GetId(0), ids->GetId(1), ids->GetId(2), ids->GetId(3) });
    }
  }

  Grid ToGrid(const Field& field) const
  {
    std::vector<double> points;
    for (const glm::dvec3& p : this->Points)
    {
      points.insert(points.end(), { p.x, p.y, p.z });
    }
    std::vector<vtkIdType> cells;
    for (const Tetrahedron& cell : this->Cells)
    {
      cells.insert(cells.end(), cell.begin(), cell.end());
    }
    return MakeGrid(points, cells, field);
  }

  double GetVolume(const Tetrahedron& cell) const
  {
    const glm::dvec3& o = this->Points[cell[0]];
    return glm::dot(
      this->Points[cell[1]] - o, glm::cross(this->Points[cell[2]] - o, this->Points[cell[3]] - o));
  }
};

template <typename Sequence>
void Shuffle(Sequence& sequence, RandomNumbers& random)
{
  for (std::size_t i = sequence.size(); i > 1; --i)
  {
    std::swap(sequence[i - 1], sequence[random.Below(static_cast<int>(i))]);
  }
}

// Renumbers points and cells, and inverts cells.
void Scramble(Arrays& arrays, RandomNumbers& random)
{
  std::vector<vtkIdType> newId(arrays.Points.size());
  std::iota(newId.begin(), newId.end(), vtkIdType(0));
  Shuffle(newId, random);
  std::vector<glm::dvec3> points(arrays.Points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[newId[i]] = arrays.Points[i];
  }
  arrays.Points = points;
  for (Tetrahedron& cell : arrays.Cells)
  {
    for (vtkIdType& id : cell)
    {
      id = newId[id];
    }
    Shuffle(cell, random);
  }
  Shuffle(arrays.Cells, random);
}

// A random part of a block whose points have been moved by less than inverts a cell.
Arrays PartOfBlock(RandomNumbers& random)
{
  const int n = 1 + random.Below(4);
  const Grid block = MakeBlock(n, ConstantField(0.0));
  // The smallest width of the tetrahedra of a unit cube is 0.577, between opposite edges. Moves of
  // up to a along each axis from both sides close it for a >= 0.167.
  Jitter(block, 2.0 / n * 0.1 * random.Uniform(), static_cast<unsigned int>(random.Bits()));
  Arrays all(block);
  Arrays arrays;
  arrays.Points = all.Points;
  const double keep = random.Below(2) ? 1.0 : random.Uniform(0.3, 1.0);
  for (const Tetrahedron& cell : all.Cells)
  {
    if (random.Uniform() <= keep)
    {
      arrays.Cells.push_back(cell);
    }
  }
  if (arrays.Cells.empty())
  {
    arrays.Cells.push_back(all.Cells.front());
  }
  return arrays;
}

// A tetrahedron with points inserted into random cells; cells become arbitrarily thin.
Arrays DividedTetrahedron(RandomNumbers& random)
{
  Arrays arrays;
  arrays.Points = { { -1, -1, -1 }, { 1, -1, -0.9 }, { -0.2, 1, -1 }, { 0.1, 0, 1 } };
  arrays.Cells = { { 0, 1, 2, 3 } };
  const int divisions = 1 + random.Below(30);
  for (int i = 0; i < divisions; ++i)
  {
    const int at = random.Below(static_cast<int>(arrays.Cells.size()));
    const Tetrahedron old = arrays.Cells[at];
    double weights[4];
    double sum = 0.0;
    for (double& weight : weights)
    {
      weight = random.Uniform(0.05, 1.0);
      sum += weight;
    }
    glm::dvec3 inside(0.0);
    for (int k = 0; k < 4; ++k)
    {
      inside += weights[k] / sum * arrays.Points[old[k]];
    }
    const auto middle = static_cast<vtkIdType>(arrays.Points.size());
    arrays.Points.push_back(inside);
    for (int k = 0; k < 4; ++k)
    {
      Tetrahedron part = old;
      part[k] = middle;
      if (k == 0)
      {
        arrays.Cells[at] = part;
      }
      else
      {
        arrays.Cells.push_back(part);
      }
    }
  }
  return arrays;
}

} // anonymous namespace

//------------------------------------------------------------------------------
double InvertedShare(vtkUnstructuredGrid* grid)
{
  const Arrays arrays(grid);
  const auto negative = std::count_if(arrays.Cells.begin(), arrays.Cells.end(),
    [&arrays](const Tetrahedron& cell) { return arrays.GetVolume(cell) < 0.0; });
  const double share = static_cast<double>(negative) / static_cast<double>(arrays.Cells.size());
  return std::min(share, 1.0 - share);
}

//------------------------------------------------------------------------------
Grid MakeTangledBlock(int n, double share, unsigned int seed)
{
  const double cube = 2.0 / n;
  for (double amount = 0.3;; amount += 0.02)
  {
    const Grid grid = MakeBlock(n, WavyField(3.0));
    Jitter(grid, amount * cube, seed);
    // Half of all cells are inverted once the moves are much larger than a cube.
    if (InvertedShare(grid) >= share || amount > 10.0)
    {
      return grid;
    }
  }
}

//------------------------------------------------------------------------------
Grid MakeLayeredBlock(int n, double share)
{
  const Grid grid = MakeBlock(n, WavyField(3.0));
  std::vector<double> at(1, 0.0);
  for (int i = 0; i < n; ++i)
  {
    at.push_back(at.back() + (i % 2 ? share : 1.0));
  }
  const auto place = [&at, n](double x) {
    return 2.0 * at[static_cast<std::size_t>(std::lround(0.5 * n * (x + 1.0)))] / at.back() - 1.0;
  };
  MapPoints(
    grid, [&place](const glm::dvec3& p) { return glm::dvec3(place(p.x), place(p.y), place(p.z)); });
  return grid;
}

//------------------------------------------------------------------------------
Grid MakeSeam(int n)
{
  Arrays both(MakeBlock(n, ConstantField(0.0)));
  const std::size_t points = both.Points.size();
  const std::size_t cells = both.Cells.size();
  for (std::size_t i = 0; i < points; ++i)
  {
    both.Points.push_back(both.Points[i] + glm::dvec3(2.0, 0.0, 0.0));
  }
  for (std::size_t i = 0; i < cells; ++i)
  {
    Tetrahedron cell = both.Cells[i];
    for (vtkIdType& id : cell)
    {
      id += static_cast<vtkIdType>(points);
    }
    both.Cells.push_back(cell);
  }
  return both.ToGrid(WavyField(2.0));
}

//------------------------------------------------------------------------------
Grid MakeScrambled(vtkUnstructuredGrid* grid, const Field& field, RandomNumbers& random)
{
  Arrays arrays(grid);
  Scramble(arrays, random);
  return arrays.ToGrid(field);
}

Grid MakeRandomMesh(RandomNumbers& random)
{
  Arrays arrays = random.Below(2) ? PartOfBlock(random) : DividedTetrahedron(random);
  // A random affine map, stretched by up to 10.
  glm::dmat3 map(1.0);
  for (int column = 0; column < 3; ++column)
  {
    map[column] = random.GetDirection() * std::pow(10.0, random.Uniform(-0.5, 0.5));
  }
  const bool flattens = std::fabs(glm::dot(map[0], glm::cross(map[1], map[2]))) < 0.01;
  const glm::dvec3 offset = std::pow(10.0, random.Uniform(-3.0, 3.0)) * random.GetDirection();
  for (glm::dvec3& point : arrays.Points)
  {
    point = (flattens ? point : map * point) + offset;
  }
  Scramble(arrays, random);
  const glm::dvec3 slope = random.GetDirection();
  const double frequency = random.Uniform(0.5, 4.0);
  return arrays.ToGrid(
    [=](double x, double y, double z)
    {
      const glm::dvec3 p = glm::dvec3(x, y, z) - offset;
      return glm::dot(slope, p) + 0.5 * std::sin(frequency * p.x) * std::cos(frequency * p.y);
    });
}

//------------------------------------------------------------------------------
Grid MakeSoup(RandomNumbers& random)
{
  Arrays arrays;
  const int points = 5 + random.Below(20);
  for (int i = 0; i < points; ++i)
  {
    // Some points coincide, and some lie on a coarse lattice.
    glm::dvec3 p(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    p = random.Below(3) ? p : glm::dvec3(random.Below(3), random.Below(3), random.Below(3)) - 1.0;
    arrays.Points.push_back(p);
  }
  const int cells = 1 + random.Below(60);
  for (int i = 0; i < cells; ++i)
  {
    Tetrahedron cell;
    for (vtkIdType& id : cell)
    {
      id = random.Below(points);
    }
    arrays.Cells.push_back(cell);
  }
  return arrays.ToGrid(WavyField(2.0));
}

} // namespace meniscus::test

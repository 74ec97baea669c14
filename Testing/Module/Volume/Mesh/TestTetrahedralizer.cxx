// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra of other cells: they fill the same volume and match across shared faces.
#include "TestBasics.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Mesh/Tetrahedralizer.h"

using namespace meniscus::test;
using namespace meniscus;

namespace
{

using Ids = std::vector<std::int64_t>;

/** Sum of the absolute volumes of tetrahedra. */
double VolumeOf(const Ids& tetrahedra, const std::vector<double>& points)
{
  double volume = 0.0;
  for (std::size_t t = 0; t < tetrahedra.size(); t += 4)
  {
    glm::dvec3 p[4];
    for (int i = 0; i < 4; ++i)
    {
      const double* x = points.data() + 3 * tetrahedra[t + i];
      p[i] = { x[0], x[1], x[2] };
    }
    volume += std::abs(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0])) / 6.0;
  }
  return volume;
}

/** n^3 cubes with their points in random order; each column has another cell type. */
class MixedBlock
{
public:
  std::vector<double> Points;
  Tetrahedralizer Cells;

  MixedBlock(int n, unsigned int seed)
    : Size(n)
    , Random(seed)
  {
    // Corners, then the centres of cubes, numbered at random.
    const int total = (n + 1) * (n + 1) * (n + 1) + n * n * n;
    this->Number.resize(total);
    std::iota(this->Number.begin(), this->Number.end(), 0);
    for (int i = total - 1; i > 0; --i)
    {
      std::swap(this->Number[i], this->Number[this->Random() % (i + 1)]);
    }
    this->Points.assign(3 * total, 0.0);
    for (const auto& [k, j, i] : Product(n, n, n))
    {
      this->AddCube(i, j, k, (i + 2 * j) % 5);
    }
  }

private:
  std::int64_t Place(std::size_t index, double x, double y, double z)
  {
    const std::int64_t id = this->Number[index];
    this->Points[3 * id] = x;
    this->Points[3 * id + 1] = y;
    this->Points[3 * id + 2] = z;
    return id;
  }

  std::int64_t Corner(int i, int j, int k)
  {
    const int m = this->Size + 1;
    return this->Place((k * m + j) * m + i, i, j, k);
  }

  void AddCube(int i, int j, int k, int kind)
  {
    const std::int64_t p[8] = { this->Corner(i, j, k), this->Corner(i + 1, j, k),
      this->Corner(i + 1, j + 1, k), this->Corner(i, j + 1, k), this->Corner(i, j, k + 1),
      this->Corner(i + 1, j, k + 1), this->Corner(i + 1, j + 1, k + 1),
      this->Corner(i, j + 1, k + 1) };
    const int faces[6][4] = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 },
      { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
    const int n = this->Size;
    if (kind == 0)
    {
      this->Cells.AddHexahedron(p);
    }
    else if (kind == 1)
    {
      const std::int64_t voxel[8] = { p[0], p[1], p[3], p[2], p[4], p[5], p[7], p[6] };
      this->Cells.AddVoxel(voxel);
    }
    else if (kind == 2)
    {
      const std::int64_t a[6] = { p[0], p[1], p[2], p[4], p[5], p[6] };
      const std::int64_t b[6] = { p[0], p[2], p[3], p[4], p[6], p[7] };
      this->Cells.AddWedge(a);
      this->Cells.AddWedge(b);
    }
    else if (kind == 3)
    {
      const std::int64_t center =
        this->Place((n + 1) * (n + 1) * (n + 1) + (k * n + j) * n + i, i + 0.5, j + 0.5, k + 0.5);
      for (const auto& face : faces)
      {
        const std::int64_t pyramid[5] = { p[face[0]], p[face[1]], p[face[2]], p[face[3]], center };
        this->Cells.AddPyramid(pyramid);
      }
    }
    else
    {
      Ids stream;
      for (const auto& face : faces)
      {
        stream.insert(stream.end(), { 4, p[face[0]], p[face[1]], p[face[2]], p[face[3]] });
      }
      this->Cells.AddPolyhedron(stream.data(), 6);
    }
  }

  int Size;
  std::mt19937 Random;
  std::vector<std::int64_t> Number;
};

TetrahedralMesh BuildMesh(const std::vector<double>& points, const Ids& tetrahedra)
{
  TetrahedralMesh mesh;
  mesh.Build({ points.data(), static_cast<std::int64_t>(points.size() / 3), tetrahedra.data(),
    static_cast<std::int64_t>(tetrahedra.size() / 4) });
  return mesh;
}

}

TEST(Tetrahedralizer, MixedCellsFitAcrossFacesWhateverTheNumbersOfPoints)
{
  const int n = 5;
  for (unsigned int seed = 1; seed <= 20; ++seed)
  {
    const MixedBlock block(n, seed);
    const Ids& tetrahedra = block.Cells.GetTetrahedra();
    EXPECT_NEAR(VolumeOf(tetrahedra, block.Points), n * n * n, 1e-9);
    const TetrahedralMesh mesh = BuildMesh(block.Points, tetrahedra);
    // If a square were split in two ways, all four triangles would be boundary.
    EXPECT_EQ(mesh.GetBoundary().size(), std::size_t(6 * 2 * n * n)) << "seed " << seed;
    EXPECT_EQ(mesh.GetNumberOfCutLinks(), 0);
    EXPECT_EQ(mesh.GetRejectedCells().Total(), 0);
  }
}

TEST(Tetrahedralizer, MergedCornersGiveNoCellsWithoutVolume)
{
  // A hexahedron whose top is merged into an edge, which makes it a wedge.
  const std::vector<double> points = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1 };
  const std::int64_t hexahedron[8] = { 0, 1, 2, 3, 4, 5, 5, 4 };
  Tetrahedralizer cells;
  cells.AddHexahedron(hexahedron);
  EXPECT_NEAR(VolumeOf(cells.GetTetrahedra(), points), 0.5, 1e-12);
  const TetrahedralMesh mesh = BuildMesh(points, cells.GetTetrahedra());
  EXPECT_EQ(mesh.GetRejectedCells().Total(), 0);
  EXPECT_EQ(mesh.GetBoundary().size(), 8u);
}

TEST(Tetrahedralizer, QuadraticTetrahedron)
{
  std::vector<double> points = { 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2 };
  const int edges[6][2] = { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 1, 3 }, { 2, 3 } };
  for (const auto& edge : edges)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      points.push_back(0.5 * (points[3 * edge[0] + axis] + points[3 * edge[1] + axis]));
    }
  }
  const std::int64_t ids[10] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 };
  Tetrahedralizer cells;
  cells.AddQuadraticTetrahedron(ids);
  EXPECT_EQ(cells.GetTetrahedra().size(), 4u * 8u);
  EXPECT_NEAR(VolumeOf(cells.GetTetrahedra(), points), 8.0 / 6.0, 1e-12);
  EXPECT_EQ(BuildMesh(points, cells.GetTetrahedra()).GetBoundary().size(), 16u);
}

TEST(Tetrahedralizer, QuadraticCellsHaveNoFlatTetrahedra)
{
  // Corners of a cell of known volume, and the edges that have a point in the middle. Whatever the
  // numbering of the points, the tetrahedra are not flat and fill the cell.
  struct Case
  {
    std::vector<glm::dvec3> Points;
    std::vector<std::array<int, 2>> Edges;
    void (Tetrahedralizer::*Add)(const std::int64_t*);
    double Volume;
    std::size_t Most;
  };
  const std::vector<glm::dvec3> cube{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
    { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
  const std::vector<glm::dvec3> wedge{ cube[0], cube[1], cube[3], cube[4], cube[5], cube[7] };
  const std::vector<std::array<int, 2>> wedgeEdges{ { 0, 1 }, { 1, 2 }, { 2, 0 }, { 3, 4 },
    { 4, 5 }, { 5, 3 }, { 0, 3 }, { 1, 4 }, { 2, 5 } };
  const Case cases[] = { { cube,
                           { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 4, 5 }, { 5, 6 }, { 6, 7 },
                             { 7, 4 }, { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } },
                           &Tetrahedralizer::AddQuadraticHexahedron, 1.0, 22 },
    { wedge, wedgeEdges, &Tetrahedralizer::AddQuadraticWedge, 0.5, 15 },
    { wedge, { wedgeEdges.begin(), wedgeEdges.begin() + 6 },
      &Tetrahedralizer::AddQuadraticLinearWedge, 0.5, 12 },
    { { cube[0], cube[1], cube[2], cube[3], { 0.4, 0.6, 1.0 } },
      { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 0, 4 }, { 1, 4 }, { 2, 4 }, { 3, 4 } },
      &Tetrahedralizer::AddQuadraticPyramid, 1.0 / 3.0, 13 } };
  std::mt19937 random(7);
  for (const Case& item : cases)
  {
    std::vector<glm::dvec3> all = item.Points;
    for (const auto& edge : item.Edges)
    {
      all.push_back(0.5 * (all[edge[0]] + all[edge[1]]));
    }
    for (int repetition = 0; repetition < 50; ++repetition)
    {
      Ids ids(all.size());
      std::iota(ids.begin(), ids.end(), 0);
      std::shuffle(ids.begin(), ids.end(), random);
      std::vector<double> points(3 * all.size());
      for (const auto& [i, axis] : Product(Below<std::size_t>(all.size()), 3))
      {
        points[3 * static_cast<std::size_t>(ids[i]) + axis] = all[i][axis];
      }
      Tetrahedralizer cells;
      (cells.*item.Add)(ids.data());
      const Ids& tetrahedra = cells.GetTetrahedra();
      EXPECT_LE(tetrahedra.size(), 4 * item.Most);
      // Products of numbers with few digits: sums are exact to rounding.
      EXPECT_NEAR(VolumeOf(tetrahedra, points), item.Volume, 1e-14);
      for (std::size_t t = 0; t < tetrahedra.size(); t += 4)
      {
        EXPECT_GT(VolumeOf({ tetrahedra.begin() + static_cast<std::ptrdiff_t>(t),
                             tetrahedra.begin() + static_cast<std::ptrdiff_t>(t + 4) },
                    points),
          1e-3);
      }
    }
  }
}

//------------------------------------------------------------------------------
// A face without points has no part in its cell, wherever it is in the list.
TEST(Tetrahedralizer, FacesWithoutPointsAreNotThere)
{
  // A pyramid, whose points are numbered above all sizes of faces.
  const std::vector<Ids> faces = { { 10, 11, 12, 13 }, { 10, 14, 11 }, { 11, 14, 12 },
    { 12, 14, 13 }, { 13, 14, 10 } };
  const auto split = [&faces](std::size_t emptyAt)
  {
    Ids stream;
    for (std::size_t i = 0; i <= faces.size(); ++i)
    {
      if (i == emptyAt)
      {
        stream.push_back(0);
      }
      if (i < faces.size())
      {
        stream.push_back(static_cast<std::int64_t>(faces[i].size()));
        stream.insert(stream.end(), faces[i].begin(), faces[i].end());
      }
    }
    Tetrahedralizer cells;
    cells.AddPolyhedron(stream.data(), faces.size() + (emptyAt <= faces.size() ? 1 : 0));
    return cells.GetTetrahedra();
  };
  const Ids expected = split(faces.size() + 1);
  ASSERT_EQ(expected.size(), 8u);
  for (std::size_t emptyAt = 0; emptyAt <= faces.size(); ++emptyAt)
  {
    EXPECT_EQ(split(emptyAt), expected) << emptyAt;
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// TetGen's program fills the inside of a surface, or its convex hull with the surface in it.
#include "Surface/MeshingFiles.h"
#include "TestBasics.h"

#include <filesystem>

#ifdef MENISCUS_TETGEN_PROGRAM

using namespace meniscus;

namespace
{

/**
 * Prism of height 1 over an L of three unit squares. Its volume is 3, that of its hull 3.5: the
 * corner between the ends of the L is half a square.
 */
TriangleSurface MakePrism()
{
  const std::array<std::array<double, 2>, 6> corners{ { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 },
    { 1, 2 }, { 0, 2 } } };
  TriangleSurface surface;
  for (int z = 0; z < 2; ++z)
  {
    for (const auto& corner : corners)
    {
      surface.Points.emplace_back(corner[0], corner[1], z);
    }
  }
  const std::array<std::array<int, 3>, 4> cap{ { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 5 },
    { 3, 4, 5 } } };
  for (const auto& t : cap)
  {
    surface.Triangles.push_back({ t[0], t[2], t[1] });
    surface.Triangles.push_back({ t[0] + 6, t[1] + 6, t[2] + 6 });
  }
  for (int i = 0; i < 6; ++i)
  {
    const int j = (i + 1) % 6;
    surface.Triangles.push_back({ i, j, j + 6 });
    surface.Triangles.push_back({ i, j + 6, i + 6 });
  }
  return surface;
}

MeshingAnswer RunTetGen(const MeshingTask& task)
{
  const std::string folder = std::string(MENISCUS_TEMPORARY_DIR) + "/FilledHull";
  std::filesystem::create_directories(folder);
  MeshingAnswer answer;
  EXPECT_TRUE(WriteMeshingTask(folder + "/task", task));
  const std::string command =
    std::string(MENISCUS_TETGEN_PROGRAM) + " '" + folder + "/task' '" + folder + "/answer'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(ReadMeshingAnswer(folder + "/answer", answer));
  EXPECT_EQ(answer.End, MeshingEnd::Done);
  return answer;
}

/** Volume of each region. */
std::map<int, double> VolumesOf(const TetrahedronCells& cells)
{
  std::map<int, double> volumes;
  for (std::size_t c = 0; c < cells.Cells.size(); ++c)
  {
    std::array<glm::dvec3, 4> p;
    std::transform(cells.Cells[c].begin(), cells.Cells[c].end(), p.begin(),
      [&](int id) { return cells.Points[static_cast<std::size_t>(id)]; });
    volumes[cells.Regions[c]] +=
      std::abs(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0])) / 6.0;
  }
  return volumes;
}

std::set<std::set<int>> FacesOf(const TetrahedronCells& cells)
{
  std::set<std::set<int>> faces;
  for (const Tetrahedron& cell : cells.Cells)
  {
    for (std::size_t left = 0; left < 4; ++left)
    {
      std::set<int> face(cell.begin(), cell.end());
      face.erase(cell[left]);
      faces.insert(face);
    }
  }
  return faces;
}

} // anonymous namespace

TEST(TetGenProgram, FillsTheInsideOfASurface)
{
  MeshingTask task;
  task.Surface = MakePrism();
  const auto volumes = VolumesOf(RunTetGen(task).Cells);
  ASSERT_EQ(volumes.size(), 1u);
  EXPECT_NEAR(volumes.begin()->second, 3.0, 1e-12);
}

TEST(TetGenProgram, FillsTheHullWithTheSurfaceInIt)
{
  MeshingTask task;
  task.Surface = MakePrism();
  task.KeepsSurface = true;
  task.FillsHull = true;
  const TetrahedronCells cells = RunTetGen(task).Cells;
  // A point may be added, but not on the surface, whose triangles are faces of cells.
  ASSERT_GE(cells.Points.size(), task.Surface.Points.size());
  EXPECT_TRUE(
    std::equal(task.Surface.Points.begin(), task.Surface.Points.end(), cells.Points.begin()));
  const auto faces = FacesOf(cells);
  for (const Triangle& triangle : task.Surface.Triangles)
  {
    EXPECT_EQ(faces.count({ triangle.begin(), triangle.end() }), 1u);
  }
  // Cells inside of the surface and the imaginary ones outside are different regions.
  const auto volumes = VolumesOf(cells);
  ASSERT_EQ(volumes.size(), 2u);
  std::array<double, 2> sorted{ volumes.begin()->second, volumes.rbegin()->second };
  std::sort(sorted.begin(), sorted.end());
  EXPECT_NEAR(sorted[0], 0.5, 1e-12);
  EXPECT_NEAR(sorted[1], 3.0, 1e-12);
}

#endif

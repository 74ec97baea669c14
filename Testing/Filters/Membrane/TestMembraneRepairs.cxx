// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Membranes whose triangles have corners of their own, and membranes with wild normals.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;
using meniscus::reference::MembraneMesh;

glm::dvec3 Load(const std::vector<double>& array, std::int64_t index)
{
  const auto i = 3 * static_cast<std::size_t>(index);
  return { array[i], array[i + 1], array[i + 2] };
}

void Store(const glm::dvec3& value, std::int64_t index, std::vector<double>& array)
{
  std::copy(&value.x, &value.x + 3, array.begin() + 3 * index);
}

// Each triangle of the waves has its own corners and its own normal, as in an STL file.
TEST(MembraneRepairs, SeparateTrianglesShowEveryPoint)
{
  const MembraneMesh waves = meniscus::reference::MakeWaves(200.0, 40, 2.0, 3.0);
  MembraneMesh soup;
  for (std::size_t i = 0; i < waves.Triangles.size(); i += 3)
  {
    const glm::dvec3 a = Load(waves.Points, waves.Triangles[i]);
    const glm::dvec3 b = Load(waves.Points, waves.Triangles[i + 1]);
    const glm::dvec3 c = Load(waves.Points, waves.Triangles[i + 2]);
    for (const glm::dvec3& corner : { a, b, c })
    {
      soup.AddPoint(corner, glm::normalize(glm::cross(b - a, c - a)));
    }
    const auto first = static_cast<std::int64_t>(i);
    soup.AddTriangle(first, first + 1, first + 2);
  }
  const auto grid = MakeGrid(81, 100.0, -30.0);
  const auto merged = MakeMembrane(waves);
  merged->GetPointData()->SetNormals(nullptr);
  const auto expected = MakeAllImages(grid, merged);
  expected->Update();
  for (const bool withNormals : { false, true })
  {
    const auto separate = MakeMembrane(soup);
    if (!withNormals)
    {
      separate->GetPointData()->SetNormals(nullptr);
    }
    const auto view = MakeAllImages(grid, separate);
    ExpectQuiet(view);
    EXPECT_EQ(view->GetStatistic("NumberOfVerticesWithoutImage"), 0);
    vtkPolyData* seen = view->GetOutput();
    ASSERT_EQ(seen->GetNumberOfPoints(), expected->GetOutput()->GetNumberOfPoints());
    double worst = 0.0;
    for (vtkIdType i = 0; i < seen->GetNumberOfPoints(); ++i)
    {
      const glm::dvec3 ours = PointOf(seen, i);
      const glm::dvec3 theirs = PointOf(expected->GetOutput(), i);
      worst = std::max(worst, glm::length(ours - theirs));
    }
    EXPECT_LT(worst, 1e-9);
  }
}

TEST(MembraneRepairs, WildNormalsAreReportedAndReplaced)
{
  MembraneMesh mesh = meniscus::reference::MakeWaves(200.0, 40, 2.0, 3.0);
  vtkNew<vtkPolyData> grid; // points alone: cells would be divided as finely as they bend
  grid->SetPoints(MakeGrid(21, 100.0, -30.0)->GetPoints());
  const auto right = MakeAllImages(grid, MakeMembrane(mesh));
  right->Update();
  int wild = 0;
  for (std::int64_t i = 50; i < 1681; i += 101)
  {
    Store(glm::normalize(glm::dvec3(1.0, 0.3, -0.4)), i, mesh.Normals);
    ++wild;
  }
  const auto view = MakeAllImages(grid, MakeMembrane(mesh));
  const auto told = UpdateAndObserve(view);
  EXPECT_EQ(told->Warnings, 1);
  EXPECT_TRUE(HasText(told->Text, std::to_string(wild) + " of 1681 membrane normals deviate"));
  ASSERT_EQ(view->GetOutput()->GetNumberOfPoints(), right->GetOutput()->GetNumberOfPoints());
  for (vtkIdType i = 0; i < view->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 ours = PointOf(view->GetOutput(), i);
    const glm::dvec3 theirs = PointOf(right->GetOutput(), i);
    EXPECT_LT(glm::length(ours - theirs), 0.2);
  }
}

// A dome over a ball, whose normals at the rim point outwards as if the dome went on below it.
// Patches that turn by so much took minutes.
TEST(MembraneRepairs, DomesWithWildNormalsAtTheRimEnd)
{
  for (const double degrees : { 25.0, 60.0, 89.0 })
  {
    // Upside down, the disc is convex to the eye; its winding stays.
    MembraneMesh dome = meniscus::reference::MakeDisc(100.0, 5, 160.0);
    for (std::size_t i = 0; i < dome.Points.size(); i += 3)
    {
      dome.Points[i + 1] = -dome.Points[i + 1];
      dome.Normals[i] = -dome.Normals[i];
      dome.Normals[i + 2] = -dome.Normals[i + 2];
    }
    const double tilt = degrees * std::acos(-1.0) / 180.0;
    int rim = 0;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(dome.Points.size() / 3); ++i)
    {
      const glm::dvec3 point = Load(dome.Points, i);
      const double radius = std::hypot(point.x, point.z);
      if (radius > 99.0)
      {
        const glm::dvec3 outwards(point.x / radius, 0.0, point.z / radius);
        const glm::dvec3 normal = Load(dome.Normals, i);
        const glm::dvec3 along = glm::normalize(outwards - glm::dot(outwards, normal) * normal);
        Store(std::cos(tilt) * normal + std::sin(tilt) * along, i, dome.Normals);
        ++rim;
      }
    }
    ASSERT_EQ(rim, 64);
    vtkNew<vtkSphereSource> ball;
    ball->SetCenter(0.0, -90.0, 0.0);
    ball->SetRadius(25.0);
    ball->SetThetaResolution(12);
    ball->SetPhiResolution(12);
    ball->Update();
    const auto view = MakeAllImages(ball->GetOutput(), MakeMembrane(dome));
    const auto told = UpdateAndObserve(view);
    EXPECT_GT(view->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(
      told->Text.find("64 of 125 membrane normals deviate") == std::string::npos, degrees < 30.0)
      << told->Text;
  }
}

}

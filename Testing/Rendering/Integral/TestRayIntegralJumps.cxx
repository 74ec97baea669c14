// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Fields that are linear in each cell and jump between cells: one point per corner of each cell.
// Integrals compared with closed forms.
#include "IntegralScene.h"

using namespace meniscus::test;

namespace
{

/** A tetrahedron with a value per corner. */
struct CornerValues
{
  std::array<glm::dvec3, 4> Points;
  std::array<double, 4> Values;

  /** Integral of the linear field along a ray: the clipped way times the mean of its ends. */
  double Integrate(const WorldRay& ray) const
  {
    glm::dmat4 corners;
    for (int i = 0; i < 4; ++i)
    {
      corners[i] = glm::dvec4(this->Points[static_cast<std::size_t>(i)], 1.0);
    }
    const glm::dmat4 barycentric = glm::inverse(corners);
    const glm::dvec4 start = barycentric * glm::dvec4(ray.Origin, 1.0);
    const glm::dvec4 slope = barycentric * glm::dvec4(ray.Direction, 0.0);
    double begin = -std::numeric_limits<double>::infinity();
    double end = -begin;
    for (int i = 0; i < 4; ++i)
    {
      const double cut = -start[i] / slope[i];
      (slope[i] > 0.0 ? begin : end) = slope[i] > 0.0 ? std::max(begin, cut) : std::min(end, cut);
    }
    const glm::dvec4 values(this->Values[0], this->Values[1], this->Values[2], this->Values[3]);
    const double middle = 0.5 * (begin + end);
    return end > begin ? (end - begin) * glm::dot(values, start + middle * slope) : 0.0;
  }
};

Grid MakeGrid(const std::vector<CornerValues>& cells)
{
  Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  grid->SetPoints(points);
  for (const CornerValues& cell : cells)
  {
    vtkIdType ids[4];
    for (std::size_t i = 0; i < 4; ++i)
    {
      const glm::dvec3& at = cell.Points[i];
      ids[i] = points->InsertNextPoint(at.x, at.y, at.z);
      scalars->InsertNextValue(cell.Values[i]);
    }
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  grid->GetPointData()->SetScalars(scalars);
  return grid;
}

void ExpectIntegrals(const std::vector<CornerValues>& cells, const glm::dvec3& direction)
{
  const Filter rays = MakeFilter(MakeGrid(cells), 48, 48, { "Integral" });
  SetRectangle(rays, direction, 1.1);
  rays->Update();
  EXPECT_EQ(rays->GetStatistic("NumberOfLostRays"), 0);
  EXPECT_LE(WorstError(rays, "Integral",
              [&cells](const WorldRay& ray)
              {
                double sum = 0.0;
                for (const CornerValues& cell : cells)
                {
                  sum += cell.Integrate(ray);
                }
                return sum;
              }),
    1.0e-6);
}

}

TEST(RayIntegralJumps, TwoCells)
{
  const glm::dvec3 a(-0.8, -0.7, 0.1);
  const glm::dvec3 b(0.9, -0.6, -0.1);
  const glm::dvec3 c(0.1, 0.9, 0.05);
  ExpectIntegrals({ { { a, b, c, { 0.0, 0.1, 0.9 } }, { { 1.0, 2.0, 3.0, 4.0 } } },
                    { { a, c, b, { 0.1, 0.0, -0.9 } }, { { 10.0, 30.0, 20.0, 40.0 } } } },
    { 0.3, -0.2, -1.0 });
}

/** A block of tetrahedra in which no two cells agree on a value. */
TEST(RayIntegralJumps, ManyCells)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(1.0, 2.0);
  const Grid block = MakeBlock(4, [](double, double, double) { return 0.0; });
  std::vector<CornerValues> cells(static_cast<std::size_t>(block->GetNumberOfCells()));
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    block->GetCellPoints(static_cast<vtkIdType>(cell), ids);
    for (std::size_t i = 0; i < 4; ++i)
    {
      block->GetPoint(ids->GetId(static_cast<vtkIdType>(i)), &cells[cell].Points[i].x);
      cells[cell].Values[i] = value(random);
    }
  }
  ExpectIntegrals(cells, { 0.31, -0.23, -1.0 });
}

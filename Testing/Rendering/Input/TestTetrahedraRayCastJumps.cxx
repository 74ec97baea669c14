// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A colour and an opacity per cell: one point per corner of each cell, with the cell's values at
// all of its points. Frames compared with the closed form of two homogeneous cells.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 64;
constexpr double UnitDistance = 0.5;
/** Red, green, blue and opacity of the cells: the nearer one first. */
const glm::dvec4 Colors[2] = { { 255.0, 51.0, 0.0, 204.0 }, { 0.0, 102.0, 255.0, 102.0 } };

/** Tetrahedra above and below the triangle (0, 0), (1, 0), (0, 1) in the plane z = 0. */
Grid MakeTwoCells()
{
  Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("colors");
  colors->SetNumberOfComponents(4);
  grid->SetPoints(points);
  for (int cell = 0; cell < 2; ++cell)
  {
    const glm::dvec3 apex(0.0, 0.0, cell == 0 ? 1.0 : -1.0);
    vtkIdType ids[4];
    int corner = 0;
    for (const glm::dvec3& at : { glm::dvec3(0.0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), apex })
    {
      ids[corner++] = points->InsertNextPoint(at.x, at.y, at.z);
      colors->InsertNextTuple(&Colors[cell].x);
    }
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  grid->GetPointData()->SetScalars(colors);
  return grid;
}

vtkSmartPointer<vtkVolumeProperty> MakeDirectProperty()
{
  auto property = MakeConstantProperty(1.0, 1.0, 1.0, 1.0, UnitDistance);
  property->SetScalarOpacity(MakeOpacity({ { 0.0, 0.0 }, { 255.0, 1.0 } }));
  property->IndependentComponentsOff();
  return property;
}

/** Premultiplied colour and opacity of a ray that passes the same way through either cell. */
glm::dvec4 Blend(double way)
{
  glm::dvec4 sum(0.0);
  double transmittance = 1.0;
  for (const glm::dvec4& color : Colors)
  {
    const double passed = std::exp(-way * color.a / 255.0 / UnitDistance);
    sum += transmittance * (1.0 - passed) * glm::dvec4(glm::dvec3(color) / 255.0, 1.0);
    transmittance *= passed;
  }
  return sum;
}

}

TEST(TetrahedraRayCastJumps, ColorsPerCell)
{
  RayCastScene scene(MakeTwoCells(), MakeDirectProperty(), Size, Size);
  vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetPosition(0.5, 0.5, 5.0);
  camera->SetFocalPoint(0.5, 0.5, 0.0);
  camera->SetParallelScale(0.5);
  camera->SetClippingRange(0.1, 100.0);
  const FloatImage image = scene.RenderFloat();
  int compared = 0;
  for (const auto& [row, column] : Product(Size, Size))
  {
    // The way through either cell.
    const double way = 1.0 - (row + column + 1.0) / Size;
    // Rays of the diagonal pass along the cells' sides.
    if (way > 1e-6)
    {
      const glm::dvec4 truth = Blend(way);
      for (int i = 0; i < 4; ++i)
      {
        ASSERT_NEAR(image.GetPixel(column, row)[i], truth[i], 2e-5) << column << " " << row;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, Size * (Size - 1) / 2 - 1);
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Inputs other than tetrahedra with one scalar: the image equals that of tetrahedra with one
// scalar.
#include "RayCastScene.h"

#include <vtkLinearToQuadraticCellsFilter.h>
#include <vtkSOADataArrayTemplate.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -2.0, 2.0 };

// A linear field is represented equally by any tetrahedra; only the walk's rounding differs.

Field MakeLinear()
{
  return LinearField(0.7, -0.4, 0.5);
}

vtkSmartPointer<vtkVolumeProperty> Smooth()
{
  return MakeProperty(FunctionKind::Smooth, Range, 3.5);
}

FloatImage PictureOf(vtkUnstructuredGrid* grid, int* warnings = nullptr)
{
  RayCastScene scene(grid, Smooth(), Size, Size);
  const auto observer = ObserveErrors(scene.GetRayCaster());
  const double bounds[6] = { -1, 1, -1, 1, -1, 1 };
  LookAt(scene.GetRenderer(), bounds, 25.0, 15.0);
  const FloatImage image = scene.RenderFloat();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  EXPECT_TRUE(observer->Errors.empty()) << observer->GetText();
  if (warnings)
  {
    *warnings = static_cast<int>(observer->Warnings.size());
  }
  return image;
}

/** The cube [-1, 1]^3 as n^3 cells of a type with the 8 corners of a cube in its own order. */
Grid MakeCubes(int n, int type, const Field& field)
{
  std::vector<double> points;
  for (const auto& [k, j, i] : Product(n + 1, n + 1, n + 1))
  {
    points.insert(points.end(), { 2.0 * i / n - 1.0, 2.0 * j / n - 1.0, 2.0 * k / n - 1.0 });
  }
  const Grid result = MakeGrid(points, {}, field);
  const vtkIdType step[3] = { 1, n + 1, vtkIdType(n + 1) * (n + 1) };
  for (const auto& [k, j, i] : Product(n, n, n))
  {
    const vtkIdType o = i + j * step[1] + k * step[2];
    const vtkIdType q = o + step[1];
    vtkIdType ids[8] = { o, o + 1, q + 1, q, o + step[2], o + 1 + step[2], q + 1 + step[2],
      q + step[2] };
    if (type == VTK_VOXEL)
    {
      std::swap(ids[2], ids[3]);
      std::swap(ids[6], ids[7]);
    }
    if (type == VTK_POLYHEDRON)
    {
      const vtkIdType faces[30] = { 4, ids[0], ids[4], ids[7], ids[3], 4, ids[1], ids[2], ids[6],
        ids[5], 4, ids[0], ids[1], ids[5], ids[4], 4, ids[3], ids[7], ids[6], ids[2], 4, ids[0],
        ids[3], ids[2], ids[1], 4, ids[4], ids[5], ids[6], ids[7] };
      result->InsertNextCell(VTK_POLYHEDRON, 8, ids, 6, faces);
    }
    else
    {
      result->InsertNextCell(type, 8, ids);
    }
  }
  return result;
}

} // anonymous namespace

TEST(TetrahedraRayCastInputs, OtherCellsGiveThePictureOfTetrahedra)
{
  const FloatImage expected = PictureOf(MakeBlock(4, MakeLinear()));
  for (const int type : { VTK_HEXAHEDRON, VTK_VOXEL, VTK_POLYHEDRON })
  {
    ExpectSamePicture(
      PictureOf(MakeCubes(4, type, MakeLinear())), expected, "type " + std::to_string(type));
  }
}

TEST(TetrahedraRayCastInputs, HiddenHexahedraAreLeftOut)
{
  const Grid grid = MakeCubes(4, VTK_HEXAHEDRON, MakeLinear());
  vtkUnsignedCharArray* ghosts = grid->AllocateCellGhostArray();
  ghosts->SetValue(3, vtkDataSetAttributes::HIDDENCELL);
  ghosts->SetValue(9, vtkDataSetAttributes::DUPLICATECELL);
  RayCastScene scene(grid, Smooth(), Size, Size);
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), 6 * (4 * 4 * 4 - 2));
}

TEST(TetrahedraRayCastInputs, CellsWithoutVolumeAreLeftOutWithAWarning)
{
  const Grid grid = MakeBlock(4, MakeLinear());
  const FloatImage expected = PictureOf(grid);
  const vtkIdType ids[3] = { 0, 1, 2 };
  grid->InsertNextCell(VTK_TRIANGLE, 3, ids);
  grid->InsertNextCell(VTK_VERTEX, 1, ids);
  int warnings = 0;
  ExpectSamePicture(PictureOf(grid, &warnings), expected, "with a triangle and a vertex");
  EXPECT_EQ(warnings, 1);
}

TEST(TetrahedraRayCastInputs, StorageDoesNotMatter)
{
  const Grid grid = MakeBlock(4, MakeLinear());
  const FloatImage expected = PictureOf(grid);
  grid->GetCells()->ConvertTo32BitStorage();
  ExpectSamePicture(PictureOf(grid), expected, "32-bit cells");
  grid->GetCells()->ConvertTo64BitStorage();
  ExpectSamePicture(PictureOf(grid), expected, "64-bit cells");
  vtkNew<vtkPoints> floats;
  floats->SetDataTypeToFloat();
  floats->DeepCopy(grid->GetPoints());
  const auto single = Grid::New();
  single->ShallowCopy(grid);
  single->SetPoints(floats);
  ExpectSamePicture(PictureOf(single), expected, "single precision points");
  vtkNew<vtkSOADataArrayTemplate<double>> axes;
  axes->DeepCopy(grid->GetPoints()->GetData());
  vtkNew<vtkPoints> perAxis;
  perAxis->SetData(axes);
  single->SetPoints(perAxis);
  ExpectSamePicture(PictureOf(single), expected, "an array of points per axis");
  vtkNew<vtkPoints> integers;
  integers->SetDataTypeToShort();
  integers->DeepCopy(grid->GetPoints()); // only the block's middle plane and its sides have integer
                                         // coordinates
  single->SetPoints(integers);
  const FloatImage coarse = PictureOf(single);
  EXPECT_EQ(coarse.Width, Size);
}

TEST(TetrahedraRayCastInputs, VectorMagnitudeAndComponent)
{
  const Grid grid = MakeBlock(4, MakeLinear());
  const FloatImage expected = PictureOf(grid);
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  vtkNew<vtkFloatArray> vectors;
  vectors->SetName("Vectors");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(grid->GetNumberOfPoints());
  vtkNew<vtkDoubleArray> lengths;
  lengths->SetName("Lengths");
  lengths->SetNumberOfTuples(grid->GetNumberOfPoints());
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    const double s = scalars->GetComponent(i, 0);
    vectors->SetTuple3(i, 0.5, s, 0.25);
    lengths->SetValue(i,
      std::sqrt(
        0.5 * 0.5 + vectors->GetComponent(i, 1) * vectors->GetComponent(i, 1) + 0.25 * 0.25));
  }
  vtkNew<vtkDoubleArray> single;
  single->SetName("Single");
  single->SetNumberOfTuples(vectors->GetNumberOfTuples());
  single->CopyComponent(0, vectors, 1);
  grid->GetPointData()->AddArray(vectors);
  grid->GetPointData()->AddArray(lengths);
  grid->GetPointData()->AddArray(single);

  RayCastScene scene(grid, Smooth(), Size, Size);
  const double bounds[6] = { -1, 1, -1, 1, -1, 1 };
  LookAt(scene.GetRenderer(), bounds, 25.0, 15.0);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray("Vectors");
  mapper->SetVectorMode(vtkTetrahedraRayCastMapper::COMPONENT);
  mapper->SetVectorComponent(1);
  ExpectSamePicture(scene.RenderFloat(), expected, "component 1");
  mapper->SetVectorMode(vtkTetrahedraRayCastMapper::MAGNITUDE);
  const FloatImage magnitude = scene.RenderFloat();
  mapper->SelectScalarArray("Lengths");
  ExpectSamePicture(magnitude, scene.RenderFloat(), "magnitude");
  mapper->SelectScalarArray("Single");
  ExpectSamePicture(scene.RenderFloat(), expected, "a single component with its sign");
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);

  const auto observer = ObserveErrors(mapper);
  mapper->SelectScalarArray("Vectors");
  mapper->SetVectorMode(vtkTetrahedraRayCastMapper::COMPONENT);
  mapper->SetVectorComponent(3);
  scene.GetWindow()->Render();
  EXPECT_EQ(observer->Errors.size(), 1u);
}

TEST(TetrahedraRayCastInputs, QuadraticTetrahedraGiveThePictureOfTetrahedra)
{
  const Grid block = MakeBlock(4, MakeLinear());
  vtkNew<vtkLinearToQuadraticCellsFilter> filter;
  filter->SetInputData(block);
  filter->Update();
  const Grid quadratic = vtkUnstructuredGrid::SafeDownCast(filter->GetOutput());
  ASSERT_EQ(quadratic->GetCellType(0), VTK_QUADRATIC_TETRA);
  ASSERT_EQ(quadratic->GetNumberOfCells(), block->GetNumberOfCells());
  int warnings = 0;
  ExpectSamePicture(PictureOf(quadratic, &warnings), PictureOf(block), "quadratic tetrahedra");
  EXPECT_EQ(warnings, 0);
}

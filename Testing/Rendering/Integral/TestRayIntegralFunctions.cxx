// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Transfer functions of all kinds against VTK's own evaluation: opaque cells of constant scalars
// show the colour of each scalar, thin cells its attenuation. Work grows with the nodes of a
// function, not with the number of its samples.
#include "IntegralScene.h"

#include <vtkDiscretizableColorTransferFunction.h>

using namespace meniscus::test;

namespace
{

/** Largest error of a reduced function: 1/32768, and the rounding of colours to floats. */
constexpr double Bound = 1.0 / 32768.0 + 1.0e-6;

/** Scalars from 0.06 to 1.94, none of which is a node. */
constexpr int NumberOfCells = 200;
double ScalarOf(int cell)
{
  return 0.06 + 1.88 * (cell + 0.37) / NumberOfCells;
}

/** A row of cells of size 1, each with a scalar. */
vtkSmartPointer<vtkImageData> MakeRow()
{
  auto row = vtkSmartPointer<vtkImageData>::New();
  row->SetDimensions(NumberOfCells + 1, 2, 2);
  row->GetCellData()->SetScalars(
    MakeArray("s", NumberOfCells, [&](vtkIdType cell) { return ScalarOf(cell); }));
  return row;
}

/** Colours and opacities of the cells, four numbers each. */
std::vector<double> Render(vtkVolumeProperty* property, bool perUnitDistance = false)
{
  const Filter rays = MakeFilter(MakeRow(), NumberOfCells, 1, { "RGBA" });
  rays->SetVolumeProperty(property);
  rays->SetOpacityModel(perUnitDistance);
  rays->SetFrameModeToParallel();
  rays->SetFrameOrigin(0.0, 0.0, 2.0);
  rays->SetFrameAxis1(NumberOfCells, 0.0, 0.0);
  rays->Update();
  return ValuesOf(rays, "RGBA");
}

/** A property that is opaque in a cell. */
vtkSmartPointer<vtkVolumeProperty> MakeOpaque(vtkColorTransferFunction* color)
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(color);
  property->SetScalarOpacity(MakeOpacity({ { 0.0, 1.0 }, { 2.0, 1.0 } }));
  property->SetScalarOpacityUnitDistance(1.0e-3);
  return property;
}

void AddNodes(vtkColorTransferFunction* color)
{
  color->AddRGBPoint(0.1, 0.9, 0.1, 0.2);
  color->AddRGBPoint(0.5, 0.2, 0.3, 0.9);
  color->AddRGBPoint(1.3, 1.0, 0.0, 0.1);
  color->AddRGBPoint(1.9, 0.1, 0.8, 0.3);
}

struct ColorCase
{
  const char* Name;
  std::function<void(vtkColorTransferFunction*)> Change;
};

std::vector<ColorCase> ColorCases()
{
  return { { "RGB", [](vtkColorTransferFunction* f) { f->SetColorSpaceToRGB(); } },
    { "HSV", [](vtkColorTransferFunction* f) { f->SetColorSpaceToHSV(); } },
    { "HSVNoWrap",
      [](vtkColorTransferFunction* f)
      {
        f->SetColorSpaceToHSV();
        f->HSVWrapOff();
      } },
    { "Lab", [](vtkColorTransferFunction* f) { f->SetColorSpaceToLab(); } },
    { "Diverging", [](vtkColorTransferFunction* f) { f->SetColorSpaceToDiverging(); } },
    { "Step", [](vtkColorTransferFunction* f) { f->SetColorSpaceToStep(); } },
    { "LogLab",
      [](vtkColorTransferFunction* f)
      {
        f->SetColorSpaceToLab();
        f->SetScaleToLog10();
      } },
    { "Sharp", [](vtkColorTransferFunction* f) { f->AddRGBPoint(0.7, 0.3, 0.9, 0.2, 0.3, 0.8); } },
    { "Constant",
      [](vtkColorTransferFunction* f) { f->AddRGBPoint(0.7, 0.3, 0.9, 0.2, 0.6, 1.0); } },
    { "Outside",
      [](vtkColorTransferFunction* f)
      {
        f->SetBelowRangeColor(0.4, 0.5, 0.6);
        f->UseBelowRangeColorOn();
        f->SetAboveRangeColor(0.7, 0.1, 0.3);
        f->UseAboveRangeColorOn();
      } },
    { "ClampingOff", [](vtkColorTransferFunction* f) { f->ClampingOff(); } } };
}

}

class FunctionColors : public ::testing::TestWithParam<ColorCase>
{
};

TEST_P(FunctionColors, AgreeWithVTK)
{
  vtkNew<vtkColorTransferFunction> color;
  AddNodes(color);
  GetParam().Change(color);
  const std::vector<double> image = Render(MakeOpaque(color));
  ASSERT_EQ(image.size(), 4u * NumberOfCells);
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    const double* expected = color->GetColor(ScalarOf(cell));
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(image[4 * cell + k], expected[k], Bound) << "at " << ScalarOf(cell);
    }
    EXPECT_NEAR(image[4 * cell + 3], 1.0, 1.0e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, FunctionColors, ::testing::ValuesIn(ColorCases()),
  [](const ::testing::TestParamInfo<ColorCase>& of) { return std::string(of.param.Name); });

TEST(FunctionSampling, DiscreteColors)
{
  vtkNew<vtkDiscretizableColorTransferFunction> color;
  AddNodes(color);
  color->DiscretizeOn();
  color->SetNumberOfValues(16);
  color->Build();
  const std::vector<double> image = Render(MakeOpaque(color));
  int steps = 0;
  for (int cell = 0; cell < NumberOfCells; ++cell)
  {
    double expected[3];
    color->GetColor(ScalarOf(cell), expected);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(image[4 * cell + k], expected[k], Bound) << "at " << ScalarOf(cell);
    }
    steps += cell > 0 && std::abs(image[4 * cell] - image[4 * cell - 4]) > 0.01 ? 1 : 0;
  }
  EXPECT_LE(steps, 15);
}

/**
 * Each evaluation of a function in CIEDE2000 searches for a path between two colours, which takes
 * 0.1 s. VTK's table has 8 bits.
 */
TEST(FunctionSampling, ColorsOfCiede2000TakeFewTables)
{
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0.1, 0.9, 0.1, 0.2);
  color->AddRGBPoint(0.8, 0.2, 0.3, 0.9);
  color->AddRGBPoint(1.9, 0.1, 0.8, 0.3);
  color->SetColorSpaceToLabCIEDE2000();
  std::vector<double> table(3 * 4096);
  const std::clock_t start = std::clock();
  color->GetTable(0.0, 2.0, 4096, table.data());
  const std::clock_t reference = std::clock() - start;
  const auto property = MakeOpaque(color);
  // Nodes of the opacity do not ask for further colours.
  for (int i = 0; i < 64; ++i)
  {
    property->GetScalarOpacity()->AddPoint(2.0 * i / 63.0, 0.9 + 0.001 * i);
  }
  const std::clock_t before = std::clock();
  const std::vector<double> image = Render(property);
  EXPECT_LE(std::clock() - before, 10 * reference);
  std::vector<double> expected(3 * NumberOfCells);
  color->GetTable(ScalarOf(0), ScalarOf(NumberOfCells - 1), NumberOfCells, expected.data());
  for (const auto& [cell, k] : Product(NumberOfCells, 3))
  {
    EXPECT_NEAR(image[4 * cell + k], expected[3 * cell + k], 1.0 / 255.0 + Bound) << ScalarOf(cell);
  }
}

TEST(FunctionSampling, OpacitiesAgreeWithVTK)
{
  for (const auto& [perUnitDistance, isLogarithmic] : Product(List(false, true), List(false, true)))
  {
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->SetUseLogScale(isLogarithmic);
    opacity->AddPoint(0.1, 0.9, 0.3, 0.0);
    opacity->AddPoint(0.4, 0.2, 0.5, 0.6);
    opacity->AddPoint(0.9, 0.8, 0.7, 1.0);
    opacity->AddPoint(1.9, 0.1);
    const auto color = MakeColors({ { 0.0, 1.0, 1.0, 1.0 } });
    const auto property = MakeOpaque(color);
    property->SetScalarOpacity(opacity);
    property->SetScalarOpacityUnitDistance(1.0);
    const std::vector<double> image = Render(property, perUnitDistance);
    for (int cell = 0; cell < NumberOfCells; ++cell)
    {
      const double value = opacity->GetValue(ScalarOf(cell));
      const double alpha = perUnitDistance ? value : 1.0 - std::exp(-value);
      EXPECT_NEAR(image[4 * cell + 3], alpha, Bound) << "at " << ScalarOf(cell);
    }
  }
}

/** The width between these nodes is not finite. The function is straight; VTK's own is not. */
TEST(FunctionSampling, NodesAtTheEndsOfTheRange)
{
  const auto color = MakeColors({ { -1.7e308, 0.0, 0.2, 0.4 }, { 1.7e308, 1.0, 0.2, 0.6 } });
  const std::vector<double> image = Render(MakeOpaque(color));
  const double middle[3] = { 0.5, 0.2, 0.5 };
  for (const auto& [cell, k] : Product(NumberOfCells, 3))
  {
    EXPECT_NEAR(image[4 * cell + k], middle[k], Bound) << "at " << ScalarOf(cell);
  }
}

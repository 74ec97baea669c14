// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are measured, but not as their owner may expect: a warning with numbers, once.
#include "HardMeshes.h"
#include "IntegralScene.h"

using namespace meniscus::test;

namespace
{

/** The cube [0, 1]^3 in n x n x 2 hexahedra; the upper ones have a thickness. */
Grid MakeLayers(int n, double thickness)
{
  const double heights[3] = { 0.0, 1.0 - thickness, 1.0 };
  Grid grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  for (const auto& [k, j, i] : Product(3, n + 1, n + 1))
  {
    points->InsertNextPoint(static_cast<double>(i) / n, static_cast<double>(j) / n, heights[k]);
    scalars->InsertNextValue(1.0);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  const auto at = [n](int i, int j, int k)
  { return static_cast<vtkIdType>(i + (n + 1) * (j + (n + 1) * k)); };
  for (const auto& [k, j, i] : Product(2, n, n))
  {
    const vtkIdType ids[8] = { at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
      at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1) };
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  }
  return grid;
}

/** Warnings of a filter's update. */
std::vector<std::string> UpdateAndListen(vtkTetrahedraRayIntegral* rays)
{
  const auto observer = ObserveErrors(rays);
  rays->Update();
  rays->RemoveObserver(observer);
  EXPECT_TRUE(observer->Errors.empty()) << observer->GetText();
  return observer->Warnings;
}

/** Largest relative error of the way through the upper layer alone, seen aslant. */
double ErrorOfLayer(int n, double thickness)
{
  Grid grid = MakeLayers(n, thickness);
  // The lower cells do not count.
  for (vtkIdType i = 0; i < (n + 1) * (n + 1); ++i)
  {
    grid->GetPointData()->GetScalars()->SetComponent(i, 0, std::nan(""));
  }
  const Filter rays = MakeFilter(grid, 64, 64, { "PathLength" });
  rays->SetFrameModeToParallel();
  rays->SetFrameOrigin(0.25, 0.25, 3.0);
  rays->SetFrameAxis1(0.5, 0.0, 0.0);
  rays->SetFrameAxis2(0.0, 0.5, 0.0);
  UpdateAndListen(rays);
  double error = 0.0;
  for (const double length : ValuesOf(rays, "PathLength"))
  {
    error = std::max(error, std::abs(length / thickness - 1.0));
  }
  return error;
}

}

/** Layers below the precision of coordinates are counted; others are measured to 1 %. */
TEST(MeshWarnings, ThinLayers)
{
  for (const auto& [n, thickness] :
    Product(List(1, 4, 16), List(1.0e-2, 1.0e-4, 1.0e-5, 1.0e-6, 1.0e-8, 1.0e-12)))
  {
    const std::string what = std::to_string(n) + ", " + std::to_string(std::log10(thickness));
    const Grid grid = MakeLayers(n, thickness);
    const Filter rays = MakeFilter(grid, 4, 4, { "PathLength" });
    const std::vector<std::string> warnings = UpdateAndListen(rays);
    const double error = ErrorOfLayer(n, thickness);
    std::printf("%s: error %.2g, %zu warnings\n", what.c_str(), error, warnings.size());
    if (warnings.empty())
    {
      EXPECT_LE(error, 0.01) << what;
      EXPECT_GE(thickness, 1.0e-6) << what;
      continue;
    }
    EXPECT_LE(thickness, 1.0e-5) << what;
    ASSERT_EQ(warnings.size(), 1u) << what;
    const std::string count = std::to_string(6 * n * n) + " of " + std::to_string(12 * n * n);
    EXPECT_TRUE(HasText(warnings[0], count + " cells have an edge shorter than"));
    // The warning is about the mesh, and is not repeated for other rays.
    rays->SetImageSize(5, 5);
    EXPECT_TRUE(UpdateAndListen(rays).empty());
  }
}

/** Points given twice make edges without length, and flat cells have no layer. */
TEST(MeshWarnings, NoThinLayers)
{
  const Grid grid = MakeLayers(2, 0.5);
  const vtkIdType twice = grid->GetPoints()->InsertNextPoint(0.0, 0.0, 0.0);
  vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetScalars())->InsertNextValue(1.0);
  const vtkIdType ids[2][4] = { { 0, twice, 1, 9 }, { 0, 1, 2, 3 } };
  grid->InsertNextCell(VTK_TETRA, 4, ids[0]);
  grid->InsertNextCell(VTK_TETRA, 4, ids[1]);
  const Filter rays = MakeFilter(grid, 4, 4, { "PathLength" });
  EXPECT_TRUE(UpdateAndListen(rays).empty());
}

/** Lengths are right in meshes of 1e-30 to 1e37; smaller and larger ones cause a warning. */
TEST(MeshWarnings, SizesBeyondSinglePrecision)
{
  const Grid unit = MakeLayers(2, 0.5);
  const std::vector<double> expected =
    ValuesOf(MakeFilter(unit, 4, 4, { "PathLength" }), "PathLength");
  const std::vector<std::pair<double, bool>> scales = { { 1e-36, false }, { 1e-30, true },
    { 1e-10, true }, { 1e10, true }, { 1e37, true }, { 1e38, false } };
  for (const auto& [scale, isHeld] : scales)
  {
    const Grid grid = MakeLayers(2, 0.5);
    MapPoints(grid, [by = scale](const glm::dvec3& x) { return by * x; });
    const Filter rays = MakeFilter(grid, 4, 4, { "PathLength" });
    const std::vector<std::string> warnings = UpdateAndListen(rays);
    if (!isHeld)
    {
      ASSERT_EQ(warnings.size(), 1u) << scale;
      EXPECT_TRUE(HasText(warnings[0], "The mesh has a radius of "));
      continue;
    }
    EXPECT_TRUE(warnings.empty()) << scale;
    const std::vector<double> lengths = ValuesOf(rays, "PathLength");
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_NEAR(lengths[i] / scale, expected[i], 1e-6) << scale;
    }
  }
}

/** A filled body in a filled body: rays count the first one that they enter. */
TEST(MeshWarnings, OverlappingBodies)
{
  const Grid outer = MakeBlock(4, ConstantField(1.0));
  const Grid inner = MakeBlock(3, ConstantField(5.0));
  TransformPoints(inner, { 0.0, 0.0, 0.0 }, 0.5);
  const Grid beside = MakeBlock(2, ConstantField(5.0));
  TransformPoints(beside, { 2.0, 0.0, 0.0 }, 1.0);
  for (const bool overlaps : { true, false })
  {
    const auto blocks = MakeBlocks({ outer, overlaps ? inner : beside });
    const Filter rays = MakeFilter(blocks, 64, 64, { "Integral" });
    rays->SetDirection(0.11, 0.07, -1.0);
    const std::vector<std::string> warnings = UpdateAndListen(rays);
    if (!overlaps)
    {
      EXPECT_TRUE(warnings.empty());
      continue;
    }
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(HasText(warnings[0], "parts of the mesh overlap"));
    EXPECT_TRUE(HasText(warnings[0], "ray integral of its own"));
    // The inner body covers a quarter of the outer one's front, seen nearly along an axis.
    const double share = std::stod(warnings[0].substr(warnings[0].find("): ") + 3)) / (64.0 * 64.0);
    EXPECT_GT(share, 0.15);
    EXPECT_LT(share, 0.35);
    rays->SetImageSize(32, 32);
    EXPECT_TRUE(UpdateAndListen(rays).empty());
  }
}

/** A mesh that overlaps because cells are inside out: their number is the advice. */
TEST(MeshWarnings, InvertedCells)
{
  const Grid grid = MakeTangledBlock(5, 0.15, 11);
  const double cells = static_cast<double>(grid->GetNumberOfCells());
  const auto inverted = static_cast<long>(std::lround(InvertedShare(grid) * cells));
  const Filter rays = MakeFilter(grid, 64, 64, { "PathLength" });
  rays->SetDirection(0.11, 0.07, -1.0);
  const std::vector<std::string> warnings = UpdateAndListen(rays);
  ASSERT_EQ(warnings.size(), 1u);
  const std::string expected = std::to_string(inverted) + " of " +
    std::to_string(grid->GetNumberOfCells()) + " tetrahedra are inside out";
  EXPECT_TRUE(HasText(warnings[0], expected));
  EXPECT_FALSE(HasText(warnings[0], "ray integral of its own"));
}

/** Bodies with filters of their own, over the same rays: their integrals are those of the sum. */
TEST(MeshWarnings, OverlappingBodiesAddUpOverTheSameRays)
{
  const Grid outer = MakeBlock(4, ConstantField(1.0));
  const Grid inner = MakeBlock(3, ConstantField(5.0));
  TransformPoints(inner, { 0.0, 0.0, 0.0 }, 0.5);
  std::vector<std::vector<double>> integrals;
  for (const Grid& body : { outer, inner })
  {
    const Filter rays = MakeFilter(body, 8, 8);
    rays->SetFrameModeToParallel();
    const double* bounds = outer->GetBounds();
    const double width = bounds[1] - bounds[0];
    rays->SetFrameOrigin(bounds[0] + 0.1 * width, bounds[2] + 0.1 * width, bounds[5] + width);
    rays->SetFrameAxis1(0.8 * width, 0.0, 0.0);
    rays->SetFrameAxis2(0.0, 0.8 * width, 0.0);
    rays->GetArraySelection()->EnableArray("Integral");
    EXPECT_TRUE(UpdateAndListen(rays).empty());
    integrals.push_back(ValuesOf(rays, "Integral"));
  }
  const double outerLength = outer->GetBounds()[5] - outer->GetBounds()[4];
  const double innerLength = inner->GetBounds()[5] - inner->GetBounds()[4];
  double largest = 0.0;
  for (std::size_t i = 0; i < integrals[0].size(); ++i)
  {
    EXPECT_NEAR(integrals[0][i], outerLength, 1e-5) << i;
    largest = std::max(largest, integrals[0][i] + integrals[1][i]);
  }
  EXPECT_NEAR(largest, outerLength + 5.0 * innerLength, 1e-5);
}

/** A surface upside down is drawn as it is seen from the medium behind it. */
TEST(MeshWarnings, SurfacesThatTurnTheirBackToTheRays)
{
  for (const bool isUpsideDown : { false, true })
  {
    vtkNew<vtkPlaneSource> water;
    water->SetOrigin(-9.0, -9.0, 2.0);
    water->SetPoint1(isUpsideDown ? -9.0 : 9.0, isUpsideDown ? 9.0 : -9.0, 2.0);
    water->SetPoint2(isUpsideDown ? 9.0 : -9.0, isUpsideDown ? -9.0 : 9.0, 2.0);
    const Filter rays = MakeFilter(MakeLayers(2, 0.5), 4, 4, { "PathLength" });
    rays->SetMembraneConnection(water->GetOutputPort());
    const std::vector<std::string> warnings = UpdateAndListen(rays);
    ASSERT_EQ(warnings.size(), isUpsideDown ? 1u : 0u);
    if (isUpsideDown)
    {
      EXPECT_TRUE(HasText(warnings[0], "No facet of the membrane faces the eye"));
    }
    // Once, until rays have come from the other side.
    rays->SetImageSize(5, 5);
    EXPECT_TRUE(UpdateAndListen(rays).empty());
    rays->SetDirection(0.0, 0.0, 1.0);
    EXPECT_EQ(UpdateAndListen(rays).size(), isUpsideDown ? 0u : 1u);
    rays->SetDirection(0.3, 0.0, -1.0);
    EXPECT_EQ(UpdateAndListen(rays).size(), isUpsideDown ? 1u : 0u);
    // Nothing is refracted.
    rays->SetInteriorIndexOfRefraction(1.0);
    EXPECT_TRUE(UpdateAndListen(rays).empty());
  }
}

/** Scalars that 32-bit floats cannot represent cause a warning with the cure. */
TEST(MeshWarnings, ScalarsThatFloatsDoNotHold)
{
  struct Scalars
  {
    double Offset;
    double Width;
    const char* Fault;
  };
  for (const Scalars& scalars :
    { Scalars{ 1.0, 1.0, nullptr }, { 0.0, 1e37, nullptr }, { 1e30, 1e37, nullptr },
      { -1e300, 2e300, "beyond the range" }, { 1e300, 0.0, "beyond the range" },
      { -1e39, 1e30, "beyond the range" }, { 0.0, 1e-30, nullptr },
      { 0.0, 1e-40, "below the range" }, { 0.0, 1e-300, "below the range" },
      { 1e9, 1.0, "too close together" }, { 1e3, 1.0, nullptr },
      { 1e15, 1.0, "too close together" }, { 1e9, 0.0, nullptr }, { 0.0, 0.0, nullptr } })
  {
    const std::string what = std::to_string(scalars.Offset) + ", " + std::to_string(scalars.Width);
    const Grid grid = MakeLayers(2, 0.5);
    vtkDataArray* values = grid->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      values->SetComponent(i, 0, scalars.Offset + scalars.Width * grid->GetPoint(i)[2]);
    }
    const Filter rays = MakeFilter(grid, 4, 4, { "Integral" });
    const std::vector<std::string> warnings = UpdateAndListen(rays);
    ASSERT_EQ(warnings.size(), scalars.Fault ? 1u : 0u) << what;
    if (scalars.Fault)
    {
      EXPECT_TRUE(HasText(warnings[0], scalars.Fault)) << what;
    }
    else
    {
      const double right = scalars.Offset + 0.5 * scalars.Width;
      EXPECT_NEAR(ValuesOf(rays, "Integral")[5], right, 2e-5 * right) << what;
    }
    // Lengths do not depend on the scalars.
    rays->GetArraySelection()->DisableArray("Integral");
    rays->GetArraySelection()->EnableArray("PathLength");
    EXPECT_TRUE(UpdateAndListen(rays).empty()) << what;
  }
}

/** A bin that shows nothing of the mesh, or amplifies rays, causes a warning with the reason. */
TEST(MeshWarnings, EnergyBinsThatShowNothing)
{
  struct Case
  {
    double Attenuation;
    double Emission;
    double Intensity;
    const char* Fault;
  };
  for (const Case& bin : { Case{ 1.0, 0.0, 1.0, nullptr }, { 8.0, 0.0, 1.0, nullptr },
         { 20.0, 0.0, 1.0, "16 of 16 rays through the mesh are absorbed" },
         { 1e300, 0.0, 1.0, "16 of 16 rays through the mesh are absorbed" },
         { 20.0, 1.0, 1.0, nullptr }, { 20.0, 0.0, 0.0, nullptr }, { 0.0, 0.0, 1.0, nullptr },
         { -1.0, 0.0, 1.0, "16 of 16 rays are amplified: the attenuation, or the scalar" },
         { -1e3, 0.0, 1.0, "16 numbers are not finite: the attenuation, or the scalar" },
         { 1.0, 1e300, 1.0, "16 numbers are not finite" } })
  {
    const std::string what = std::to_string(bin.Attenuation);
    const Filter rays = MakeFilter(MakeLayers(2, 0.5), 4, 4, { "EnergyBins" });
    rays->SetBinAttenuation(1, bin.Attenuation);
    rays->SetBinEmission(1, bin.Emission);
    rays->SetBinIntensity(1, bin.Intensity);
    const std::vector<std::string> warnings = UpdateAndListen(rays);
    ASSERT_EQ(warnings.size(), bin.Fault ? 1u : 0u) << what;
    if (bin.Fault)
    {
      EXPECT_TRUE(HasText(warnings[0], std::string("Energy bin 1: ") + bin.Fault)) << what;
      // The diagonal of the cube is the square root of 3.
      EXPECT_EQ(static_cast<bool>(HasText(warnings[0], "with 0.57735 the optical depth of the")),
        bin.Attenuation > 1.0)
        << what;
    }
  }
}

/** The same for arrays of attenuation, which have no coefficient that could be another one. */
TEST(MeshWarnings, AttenuationsThatAbsorbAllRays)
{
  for (const double attenuation : { 1.0, 20.0 })
  {
    const Grid grid = MakeLayers(2, 0.5);
    vtkNew<vtkDoubleArray> array;
    array->SetName("mu");
    array->SetNumberOfTuples(grid->GetNumberOfCells());
    array->Fill(attenuation);
    grid->GetCellData()->AddArray(array);
    const Filter rays = MakeFilter(grid, 4, 4, { "EnergyBins" });
    rays->SetAttenuationArrayName("mu");
    const std::vector<std::string> warnings = UpdateAndListen(rays);
    ASSERT_EQ(warnings.size(), attenuation > 1.0 ? 1u : 0u);
    EXPECT_TRUE(warnings.empty() || HasText(warnings[0], "are absorbed but for less than"));
    EXPECT_TRUE(warnings.empty() || !HasText(warnings[0], "the optical depth"));
    // Light of the mesh itself comes through.
    rays->SetEmissionArrayName("mu");
    EXPECT_TRUE(UpdateAndListen(rays).empty());
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Irradiance through a membrane: photons through exact waves, and its input. TestStackLight.cxx has
// closed forms for flat water.
#include "ExactStack.h"
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"

#include <vtkTriangleFilter.h>

namespace
{

using namespace meniscus::test;
using meniscus::reference::HeightField;

const double Pi = std::acos(-1.0);
constexpr double Water = 1.333;
// The light is at a distance of ten thousand sizes of the scene.
constexpr double Parallel = 2e-4;

/** 1 - F of unpolarised light. */
double MakeTransmittance(double cosine)
{
  return 1.0 - meniscus::reference::MakeReflectance(cosine, 1.0, Water);
}

vtkSmartPointer<vtkRefractedLightFilter> MakeLight(
  vtkPolyData* geometry, vtkPolyData* membrane, const glm::dvec3& light)
{
  auto filter = vtkSmartPointer<vtkRefractedLightFilter>::New();
  filter->SetInputData(geometry);
  filter->SetMembraneData(membrane);
  filter->SetLightPosition(light.x, light.y, light.z);
  filter->SetInteriorIndexOfRefraction(Water);
  return filter;
}

vtkDataArray* OfCells(vtkRefractedLightFilter* filter)
{
  return filter->GetOutput()->GetCellData()->GetArray("RefractionIrradiance");
}

vtkDataArray* OfPoints(vtkRefractedLightFilter* filter)
{
  return filter->GetOutput()->GetPointData()->GetArray("RefractionIrradiance");
}

/** Irradiance of the cells of MakeGrid(cells + 1, size, y) by 10^6 rays of the sun. */
std::vector<double> ShinePhotons(
  const HeightField& waves, const glm::dvec3& sun, int cells, double size, double y, double& total)
{
  constexpr int rays = 1000;
  std::vector<double> flux(static_cast<std::size_t>(cells) * cells, 0.0);
  const double step = waves.Side / rays;
  total = 0.0;
  for (const auto& [j, i] : Product(rays, rays))
  {
    const double x = (i + 0.5) * step - 0.5 * waves.Side;
    const double z = (j + 0.5) * step - 0.5 * waves.Side;
    const glm::dvec3 place(x, waves.GetHeight(x, z), z);
    const glm::dvec3 normal = waves.GetNormal(x, z);
    const double cosine = glm::dot(sun, normal);
    const double power = step * step / normal.y * cosine * MakeTransmittance(cosine);
    total += power;
    const auto end = waves.Refract(place + 1e6 * sun, place, 1.0);
    const glm::dvec3 along = *end - place;
    const glm::dvec3 hit = place + (y - place.y) / along.y * along;
    const double column = std::floor((hit.x / size + 0.5) * cells);
    const double row = std::floor((hit.z / size + 0.5) * cells);
    if (column >= 0.0 && column < cells && row >= 0.0 && row < cells)
    {
      flux[static_cast<std::size_t>(row * cells + column)] += power;
    }
  }
  for (double& f : flux)
  {
    f *= cells * cells / (size * size);
  }
  return flux;
}

} // anonymous namespace

TEST(RefractedLight, CausticsOfWavesAreThoseOfPhotons)
{
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 3.0, 0.02 * Pi, 1.0, Water };
  auto membrane = MakeMembrane(waves.MakeMesh(64));
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.2, 1.0, 0.1));
  constexpr int cells = 40;
  constexpr double size = 500.0;
  // Before the light is folded, near its focus, and behind it.
  for (const double depth : { 150.0, 300.0, 700.0 })
  {
    auto floor = MakeGrid(cells + 1, size, -depth);
    auto filter = MakeLight(floor, membrane, sun);
    filter->Update();
    double total = 0.0;
    const std::vector<double> truth = ShinePhotons(waves, sun, cells, size, -depth, total);
    const std::vector<double> measured = ValuesOf(OfCells(filter));
    const double sum = std::accumulate(measured.begin(), measured.end(), 0.0);
    EXPECT_NEAR(sum * size * size / (cells * cells) / total, 1.0, 5e-4) << depth;
    ExpectSameLight(filter, truth, size);
  }
}

/** Light vectors of cells that a flat membrane cuts: their parts are lit through it and without. */
TEST(RefractedLight, CellsCutByTheMembraneHaveTheLightOfTheirParts)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(MakeGrid(41, 60.0, 0.0));
  triangles->Update();
  vtkPolyData* slope = triangles->GetOutput();
  MapPoints(slope,
    [](const glm::dvec3& place)
    { return glm::dvec3(place.x, 0.31 * place.x + 0.17 * place.z + 0.1, place.z); });
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, 1.0, 0.2));
  auto filter = MakeLight(slope, MakeFlatMembrane(), sun);
  filter->LightVectorsOn();
  filter->Update();
  const double cosine = std::sqrt(1.0 - (1.0 - sun.y * sun.y) / (Water * Water));
  const glm::dvec3 behind =
    MakeTransmittance(sun.y) * sun.y / cosine * glm::dvec3(sun.x / Water, cosine, sun.z / Water);
  vtkDataArray* vectors = filter->GetOutput()->GetCellData()->GetArray("RefractionLightVector");
  int cut = 0;
  for (vtkIdType i = 0; i < slope->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> ids;
    slope->GetCellPoints(i, ids);
    std::array<double, 3> heights;
    for (int k = 0; k < 3; ++k)
    {
      heights[static_cast<std::size_t>(k)] = PointOf(slope, ids->GetId(k)).y;
    }
    std::sort(heights.begin(), heights.end());
    const auto [low, middle, high] = heights;
    double inFront = low > 0.0 ? 1.0 : 0.0;
    if (low < 0.0 && high > 0.0)
    {
      ++cut;
      inFront = middle < 0.0 ? high * high / ((high - low) * (high - middle))
                             : 1.0 - low * low / ((high - low) * (middle - low));
    }
    // Corners in front that are less than a fiftieth of a cell are not cut off.
    const double tolerance = inFront > 0.0 && inFront < 0.02 ? 0.05 : 5.0 * Parallel;
    const glm::dvec3 expected = inFront * sun + (1.0 - inFront) * behind;
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(vectors->GetComponent(i, c), expected[c], tolerance) << i << " " << inFront;
    }
  }
  EXPECT_GE(cut, 80);
}

TEST(RefractedLight, OneSideOfAClosedSurface)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, -20.0, 0.0);
  ball->SetRadius(5.0);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(48);
  ball->Update();
  auto filter = MakeLight(ball->GetOutput(), MakeFlatMembrane(), { 0.0, 1.0, 0.0 });
  filter->OneSidedOn();
  filter->Update();
  for (vtkIdType i = 0; i < ball->GetOutput()->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    ball->GetOutput()->GetCellBounds(i, bounds);
    const double irradiance = OfCells(filter)->GetComponent(i, 0);
    if (bounds[3] < -20.0)
    {
      EXPECT_EQ(irradiance, 0.0);
    }
    else if (bounds[2] > -19.5)
    {
      EXPECT_GT(irradiance, 0.05);
    }
  }
  filter->OneSidedOff();
  filter->Update();
  double least = 1.0;
  for (vtkIdType i = 0; i < ball->GetOutput()->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    ball->GetOutput()->GetCellBounds(i, bounds);
    least = bounds[3] < -20.5 ? std::min(least, OfCells(filter)->GetComponent(i, 0)) : least;
  }
  EXPECT_GT(least, 0.05);
}

TEST(RefractedLight, StripsAreTheSameAsTriangles)
{
  const std::vector<Point> points{ { -5, -20, -5 }, { -5, -20, 5 }, { 0, -20, -5 }, { 0, -20, 5 },
    { 5, -20, -5 }, { 5, -20, 5 } };
  auto strip = MakePoints(points);
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 0, 1, 2, 3, 4, 5 });
  strip->SetStrips(strips);
  const double angle = 0.5;
  auto filter = MakeLight(strip, MakeFlatMembrane(), { std::sin(angle), std::cos(angle), 0.0 });
  filter->Update();
  const double expected = std::cos(angle) * MakeTransmittance(std::cos(angle));
  ASSERT_EQ(OfCells(filter)->GetNumberOfTuples(), 1);
  EXPECT_NEAR(OfCells(filter)->GetComponent(0, 0), expected, Parallel);
  EXPECT_NEAR(OfPoints(filter)->GetComponent(3, 0), expected, Parallel);
}

TEST(RefractedLight, WorkIsDoneWhereItsInputChanges)
{
  auto filter = MakeLight(MakeGrid(9, 60.0, -20.0), MakeFlatMembrane(), { 0.0, 1.0, 0.1 });
  filter->Update();
  const auto solved = filter->GetView()->GetNumberOfSolvedVertices();
  const auto patches = filter->GetView()->GetNumberOfPatchBuilds();
  EXPECT_GT(solved, 0);
  filter->Update();
  filter->OneSidedOn();
  filter->Update();
  EXPECT_EQ(filter->GetView()->GetNumberOfSolvedVertices(), solved);
  filter->SetLightPosition(0.0, 1.0, 0.2);
  filter->Update();
  EXPECT_GT(filter->GetView()->GetNumberOfSolvedVertices(), solved);
  EXPECT_EQ(filter->GetView()->GetNumberOfPatchBuilds(), patches);
}

TEST(RefractedLight, BadInput)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto grid = MakeGrid(3, 60.0, -20.0);
  const auto empty = vtkSmartPointer<vtkPolyData>::New();
  const glm::dvec3 sun(0.0, 1.0, 0.0);
  const auto countErrors = [](vtkAlgorithm* filter) { return UpdateAndObserve(filter)->Errors; };
  for (const glm::dvec3& light : { glm::dvec3(0.0), glm::dvec3(nan, 1.0, 0.0),
         glm::dvec3(0.0, std::numeric_limits<double>::infinity(), 0.0) })
  {
    EXPECT_GT(countErrors(MakeLight(grid, MakeFlatMembrane(), light)), 0);
  }
  const auto badIndex = MakeLight(grid, MakeFlatMembrane(), sun);
  badIndex->SetInteriorIndexOfRefraction(-1.0);
  EXPECT_GT(countErrors(badIndex), 0);
  EXPECT_GT(countErrors(MakeLight(grid, empty, sun)), 0);
  const auto ofNothing = MakeLight(empty, MakeFlatMembrane(), sun);
  EXPECT_EQ(countErrors(ofNothing), 0);
  EXPECT_EQ(OfCells(ofNothing)->GetNumberOfTuples(), 0);
  {
    // A cell without area, one whose points do not exist, a line, a point that is not finite.
    auto broken = MakePoints({ { 0, -20, 0 }, { 5, -20, 0 }, { 5, -20, 5 }, { nan, -20, 0 } });
    vtkNew<vtkCellArray> polys;
    polys->InsertNextCell({ 0, 2, 1 });
    polys->InsertNextCell({ 0, 1, 1 });
    polys->InsertNextCell({ 0, 1, 7 });
    polys->InsertNextCell({ 0, 1, 3 });
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell({ 0, 1 });
    broken->SetPolys(polys);
    broken->SetLines(lines);
    auto filter = MakeLight(broken, MakeFlatMembrane(), sun);
    UpdateAndObserve(filter);
    ASSERT_EQ(OfCells(filter)->GetNumberOfTuples(), 5);
    EXPECT_EQ(OfCells(filter)->GetComponent(0, 0), 0.0);
    EXPECT_NEAR(OfCells(filter)->GetComponent(1, 0), MakeTransmittance(1.0), Parallel);
    for (vtkIdType i = 2; i < 5; ++i)
    {
      EXPECT_EQ(OfCells(filter)->GetComponent(i, 0), 0.0);
    }
  }
}

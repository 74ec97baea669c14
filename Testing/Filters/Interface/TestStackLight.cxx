// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Light through several interfaces: closed forms for panes, rays through an exact lens, and the
// energy that arrives.
#include "ExactStack.h"
#include "StackFilterHelpers.h"

namespace
{

using namespace meniscus::test;
namespace reference = meniscus::reference;

const glm::dvec3 Up(0.0, 1.0, 0.0);
constexpr double Glass = 1.5;
constexpr double Water = 1.333;
// The light is at a distance of ten thousand sizes of the scene.
constexpr double Parallel = 2e-4;

/** Transmittance of glass for unpolarised light. */
double MakeTransmittance(double sine, double inFront, double behind)
{
  return reference::MakePlateTransmittance(sine, inFront, Glass, behind);
}

/** Transmittance of the surface of water, or of a pane of glass on it. */
double MakeTransmittanceBelow(double thickness, double sine)
{
  return thickness > 0.0
    ? MakeTransmittance(sine, 1.0, Water)
    : 1.0 - reference::MakeReflectance(std::sqrt(1.0 - sine * sine), 1.0, Water);
}

vtkSmartPointer<vtkRefractedLightFilter> MakeLight(vtkPolyData* geometry, const glm::dvec3& light)
{
  auto filter = vtkSmartPointer<vtkRefractedLightFilter>::New();
  filter->SetInputData(geometry);
  filter->SetLightPosition(light.x, light.y, light.z);
  filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  return filter;
}

/** Air, glass from 0 to -thickness, if there is any, and water. */
vtkSmartPointer<vtkRefractedLightFilter> MakePaneLight(
  vtkPolyData* geometry, const glm::dvec3& light, double thickness = 10.0)
{
  auto filter = MakeLight(geometry, light);
  if (thickness > 0.0)
  {
    AddInterface(filter, MakePlaneAt(0.0), 1.0, Glass);
  }
  AddInterface(filter, MakePlaneAt(-thickness), thickness > 0.0 ? Glass : 1.0, Water);
  return filter;
}

std::array<vtkDataSetAttributes*, 2> AttributesOf(vtkRefractedLightFilter* filter)
{
  return { filter->GetOutput()->GetCellData(), filter->GetOutput()->GetPointData() };
}

double CellOf(vtkRefractedLightFilter* filter, vtkIdType i)
{
  return filter->GetOutput()->GetCellData()->GetArray("RefractionIrradiance")->GetTuple1(i);
}

/** Irradiance of all cells times their area, which is the same for all. */
double SumOf(vtkRefractedLightFilter* filter, double area)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfCells(); ++i)
  {
    sum += CellOf(filter, i) * area;
  }
  return sum;
}

/** A ball of glass of radius 40 in water, under light from above. */
const std::vector<reference::ExactSurface> Ball{ { 1.0, Glass, glm::dvec3(0.0), 40.0 },
  { Glass, 1.0, glm::dvec3(0.0), 40.0, glm::dvec3(0.0), true } };
vtkSmartPointer<vtkRefractedLightFilter> MakeBallLight(vtkPolyData* floor)
{
  auto filter = MakeLight(floor, Up);
  const auto ball = MakeMembrane(reference::MakeSphere(glm::dvec3(0.0), 40.0, 4, true));
  AddInterface(filter, ball, 1.0, Glass);
  AddInterface(filter, ball, 1.0, Glass);
  return filter;
}

/**
 * Transmittance of the ball at a distance from its axis, and radius of the ray at height y;
 * infinite if the ray goes up.
 */
double TraceBall(double radius, double y, double& at)
{
  const auto path = reference::TraceExactly(Ball, { radius, 1e3, 0.0 }, { 0.0, -1.0, 0.0 });
  EXPECT_TRUE(path.has_value());
  const glm::dvec3& direction = path->Directions.back();
  at = direction.y < 0.0
    ? path->Points.back().x + (y - path->Points.back().y) / direction.y * direction.x
    : std::numeric_limits<double>::infinity();
  return MakeTransmittance(
    radius / 40.0, 1.0, 1.0); // by symmetry, the angles at the sides are equal
}

/** Share of a circle around the middle of a square that is inside it. */
double GetShare(double radius, double side)
{
  const double ratio = 0.5 * side / std::fabs(radius);
  return ratio >= 1.0 ? 1.0 : std::max(1.0 - 4.0 / std::acos(-1.0) * std::acos(ratio), 0.0);
}

} // anonymous namespace

TEST(StackLight, PlanesUnderTheSun)
{
  for (const auto& [thickness, angle] : Product(List(0.0, 10.0), List(0.0, 0.3, 0.9, 1.3, 1.4)))
  {
    const auto filter =
      MakePaneLight(MakeGrid(9, 60.0, -20.0), { std::sin(angle), std::cos(angle), 0.0 }, thickness);
    ExpectQuiet(filter);
    const double expected = std::cos(angle) * MakeTransmittanceBelow(thickness, std::sin(angle));
    for (vtkDataSetAttributes* data : AttributesOf(filter))
    {
      for (const double value : ValuesOf(data->GetArray("RefractionIrradiance")))
      {
        EXPECT_NEAR(value, expected, Parallel) << angle;
      }
    }
  }
}

/** Light across the rays, back along them, and their length; on walls as well. */
TEST(StackLight, VectorsOfTheLightBehindPlanes)
{
  constexpr double depth = 20.0; // in the water
  for (const auto& [thickness, angle, isWall] :
    Product(List(0.0, 10.0), List(0.0, 0.3, 0.9, 1.3), List(false, true)))
  {
    if (isWall && angle == 0.0)
    {
      continue; // the light passes it
    }
    const double y = -thickness - depth;
    auto object = MakeGrid(5, 20.0, y);
    if (isWall)
    {
      object = MakePoints({ { 0, y - 2, -2 }, { 0, y - 2, 2 }, { 0, y + 2, 2 }, { 0, y + 2, -2 } });
      vtkNew<vtkCellArray> polys;
      polys->InsertNextCell({ 0, 1, 2, 3 });
      object->SetPolys(polys);
    }
    const auto filter = MakePaneLight(object, { std::sin(angle), std::cos(angle), 0.0 }, thickness);
    filter->Update();
    EXPECT_FALSE(filter->GetOutput()->GetCellData()->HasArray("RefractionLightVector"));
    filter->LightVectorsOn();
    filter->Update();
    const double sine = std::sin(angle) / Water;
    const double cosine = std::sqrt(1.0 - sine * sine);
    const double inGlass = std::sqrt(1.0 - std::pow(std::sin(angle) / Glass, 2.0));
    const double across =
      std::cos(angle) * MakeTransmittanceBelow(thickness, std::sin(angle)) / cosine;
    for (vtkDataSetAttributes* data : AttributesOf(filter))
    {
      vtkDataArray* vectors = data->GetArray("RefractionLightVector");
      vtkDataArray* paths = data->GetArray("RefractionLightPath");
      ASSERT_TRUE(vectors && paths);
      for (vtkIdType i = 0; i < vectors->GetNumberOfTuples(); ++i)
      {
        const glm::dvec3 vector = TupleOf(vectors, i);
        EXPECT_NEAR(vector[0], across * sine, 2.0 * Parallel) << angle;
        EXPECT_NEAR(vector[1], across * cosine, 2.0 * Parallel) << angle;
        EXPECT_NEAR(vector[2], 0.0, 2.0 * Parallel) << angle;
        EXPECT_NEAR(paths->GetTuple1(i), thickness / inGlass + depth / cosine, 0.01) << angle;
      }
    }
  }
}

/** A floor at the very end of vertical rays, where its bounds end: no cell is dark. */
TEST(StackLight, NoCellIsLeftOut)
{
  for (int i = 0; i < 20; ++i)
  {
    const double y = -10.0 - 90.0 * std::pow(0.7, i); // of any rounding
    const auto filter = MakePaneLight(MakeGrid(11, 20.0, y), Up);
    filter->Update();
    for (vtkIdType cell = 0; cell < 100; ++cell)
    {
      EXPECT_NEAR(CellOf(filter, cell), MakeTransmittance(0.0, 1.0, Water), Parallel) << y;
    }
  }
}

TEST(StackLight, GeometryInThePaneHasTheLightOfTheFirstSurface)
{
  const auto filter = MakePaneLight(MakeGrid(9, 60.0, -5.0), Up);
  filter->Update();
  for (vtkIdType i = 0; i < 64; ++i)
  {
    EXPECT_NEAR(CellOf(filter, i), MakeTransmittance(0.0, 1.0, Glass), Parallel);
  }
  // In front of the pane there is no light through it.
  filter->SetInputData(MakeGrid(9, 60.0, 5.0));
  filter->Update();
  EXPECT_EQ(SumOf(filter, 1.0), 0.0);
}

/** Rings: light at the angle a passes the first surface at Height tan a and ends at r(a). */
TEST(StackLight, LampAbovePlanes)
{
  constexpr double height = 40.0;
  constexpr double depth = 30.0;
  for (const double thickness : { 0.0, 10.0 })
  {
    const auto floor = MakeGrid(81, 80.0, -thickness - depth);
    const auto filter = MakePaneLight(floor, { 0.0, height, 0.0 }, thickness);
    filter->PositionalOn();
    filter->Update();
    const auto tangent = [](double a, double index)
    { return std::tan(std::asin(std::sin(a) / index)); };
    const auto radius = [&](double a)
    { return height * std::tan(a) + thickness * tangent(a, Glass) + depth * tangent(a, Water); };
    const double largest = FindLargestLampError(filter, height, radius,
      [thickness](double a) { return MakeTransmittanceBelow(thickness, std::sin(a)); });
    EXPECT_LT(largest, 1e-3) << thickness; // the mean of the cells around a point
  }
}

/**
 * All light that the ball transmits to the floor arrives, in front of its focus, next to it and
 * behind it, where it is folded. Truth: an integral over the exact ball. The rim, where 2^-7 of a
 * patch is lost, has hardly any light.
 */
TEST(StackLight, ABallTransmitsAllItsLight)
{
  constexpr int rings = 20000;
  constexpr int cells = 100;
  constexpr double size = 1000.0;
  for (const double y : { -45.0, -60.0, -150.0 })
  {
    double total = 0.0;
    for (int i = 0; i < rings; ++i)
    {
      const double r = 40.0 * (i + 0.5) / rings;
      double at = 0.0;
      const double transmittance = TraceBall(r, y, at);
      total += transmittance * GetShare(at, size) * 2.0 * std::acos(-1.0) * r * 40.0 / rings;
    }
    const auto filter = MakeBallLight(MakeGrid(cells + 1, size, y));
    filter->Update();
    EXPECT_NEAR(SumOf(filter, size * size / (cells * cells)) / total, 1.0, 1e-3) << y;
  }
}

/** Cell by cell, 4 x 10^6 exact rays: in front of the focus 20 behind the ball, and behind it. */
TEST(StackLight, ABallConcentratesLightAsExactRaysDo)
{
  constexpr int cells = 40;
  constexpr double size = 120.0;
  for (const double y : { -45.0, -120.0 })
  {
    const auto filter = MakeBallLight(MakeGrid(cells + 1, size, y));
    filter->Update();
    std::vector<double> truth(cells * cells, 0.0);
    constexpr int rays = 2000;
    for (const auto& [j, i] : Product(rays, rays))
    {
      const glm::dvec2 place(80.0 * (i + 0.5) / rays - 40.0, 80.0 * (j + 0.5) / rays - 40.0);
      const double radius = glm::length(place);
      if (radius >= 40.0)
      {
        continue;
      }
      double at = 0.0;
      const double power = TraceBall(radius, y, at);
      const glm::dvec2 hit = place * (at / radius);
      // Infinite for rays that go up.
      const double column = std::floor((hit.x / size + 0.5) * cells);
      const double row = std::floor((hit.y / size + 0.5) * cells);
      if (column >= 0.0 && column < cells && row >= 0.0 && row < cells)
      {
        truth[static_cast<std::size_t>(row * cells + column)] +=
          power * std::pow(80.0 / rays * cells / size, 2.0);
      }
    }
    ExpectSameLight(filter, truth, size);
  }
}

TEST(StackLight, OneSideOfAFloor)
{
  // The grid's quads are seen counter-clockwise from one side only.
  double sums[2];
  for (const bool fromBelow : { false, true })
  {
    const auto filter =
      MakeLight(MakeGrid(5, 20.0, fromBelow ? 20.0 : -20.0), fromBelow ? -Up : Up);
    AddInterface(filter, MakePlaneAt(fromBelow ? 10.0 : 0.0), 1.0, Glass);
    AddInterface(filter, MakePlaneAt(fromBelow ? 0.0 : -10.0), Glass, 1.0);
    if (fromBelow)
    {
      // From below the list is passed from the back, in the other order.
      filter->GetInterfaces()->RemoveAllItems();
      filter->RemoveAllMembranes();
      AddInterface(filter, MakePlaneAt(0.0), Glass, 1.0);
      AddInterface(filter, MakePlaneAt(10.0), 1.0, Glass);
    }
    filter->OneSidedOn();
    filter->Update();
    sums[fromBelow ? 1 : 0] = SumOf(filter, 1.0);
  }
  EXPECT_GT(std::max(sums[0], sums[1]), 10.0);
  EXPECT_EQ(std::min(sums[0], sums[1]), 0.0);
}

TEST(StackLight, EqualIndicesAreLightWithoutRefraction)
{
  const auto filter = MakeLight(MakeGrid(9, 60.0, -20.0), { 0.6, 0.8, 0.0 });
  AddInterface(filter, MakePlaneAt(0.0), Water, Water);
  AddInterface(filter, MakePlaneAt(-10.0), Water, Water);
  filter->Update();
  for (vtkIdType i = 0; i < 64; ++i)
  {
    EXPECT_NEAR(CellOf(filter, i), 0.8, Parallel);
  }
}

TEST(StackLight, ResultsDoNotDependOnTheNumberOfThreads)
{
  ExpectSameOnThreads(
    []
    {
      const auto filter = MakeBallLight(MakeGrid(21, 200.0, -60.0));
      filter->Update();
      return ValuesOf(filter->GetOutput()->GetCellData()->GetArray("RefractionIrradiance"));
    });
}

TEST(StackLight, ListsThatCannotBeUsed)
{
  ExpectBadLists([]() { return MakeLight(MakeGrid(9, 60.0, -20.0), Up); },
    [](vtkRefractedLightFilter* filter) { return filter->GetOutput()->GetNumberOfPoints(); });
}

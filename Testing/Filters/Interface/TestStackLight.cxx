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

/** Reflectances of both polarisations for an angle of incidence with this sine in a vacuum. */
glm::dvec2 MakeReflectances(double sine, double before, double behind)
{
  const double c = std::sqrt(1.0 - std::pow(sine / before, 2.0));
  const double d = std::sqrt(1.0 - std::pow(sine / behind, 2.0));
  const double s = (before * c - behind * d) / (before * c + behind * d);
  const double p = (behind * c - before * d) / (behind * c + before * d);
  return { s * s, p * p };
}

/**
 * Transmittance of glass for unpolarised light: the sum of the geometric series of the light that
 * is reflected between its sides, for each polarisation.
 */
double MakeTransmittance(double sine, double inFront, double behind)
{
  const glm::dvec2 upper = MakeReflectances(sine, inFront, Glass);
  const glm::dvec2 lower = MakeReflectances(sine, Glass, behind);
  const glm::dvec2 passed = (1.0 - upper) * (1.0 - lower) / (1.0 - upper * lower);
  return 0.5 * (passed.x + passed.y);
}

vtkSmartPointer<vtkRefractedLightFilter> MakeLight(vtkPolyData* geometry, const glm::dvec3& light)
{
  auto filter = vtkSmartPointer<vtkRefractedLightFilter>::New();
  filter->SetInputData(geometry);
  filter->SetLightPosition(light.x, light.y, light.z);
  filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  return filter;
}

/** Air, glass from 0 to -10, and water. */
vtkSmartPointer<vtkRefractedLightFilter> MakePaneLight(
  vtkPolyData* geometry, const glm::dvec3& light)
{
  auto filter = MakeLight(geometry, light);
  AddInterface(filter, MakePlaneAt(0.0), 1.0, Glass);
  AddInterface(filter, MakePlaneAt(-10.0), Glass, Water);
  return filter;
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

TEST(StackLight, PaneUnderTheSun)
{
  for (const double angle : { 0.0, 0.3, 0.9, 1.3, 1.4 })
  {
    const auto filter =
      MakePaneLight(MakeGrid(9, 60.0, -20.0), { std::sin(angle), std::cos(angle), 0.0 });
    ExpectQuiet(filter);
    const double expected = std::cos(angle) * MakeTransmittance(std::sin(angle), 1.0, Water);
    for (vtkIdType i = 0; i < 64; ++i)
    {
      EXPECT_NEAR(CellOf(filter, i), expected, Parallel) << angle;
    }
  }
}

/** The path is that behind the first side. */
TEST(StackLight, VectorsOfTheLightBehindAPane)
{
  const double angle = 0.9;
  const auto filter =
    MakePaneLight(MakeGrid(5, 20.0, -30.0), { std::sin(angle), std::cos(angle), 0.0 });
  filter->LightVectorsOn();
  filter->Update();
  const double sine = std::sin(angle) / Water;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double inGlass = std::sqrt(1.0 - std::pow(std::sin(angle) / Glass, 2.0));
  const double across = std::cos(angle) * MakeTransmittance(std::sin(angle), 1.0, Water) / cosine;
  vtkDataSetAttributes* data = filter->GetOutput()->GetCellData();
  for (vtkIdType i = 0; i < 16; ++i)
  {
    const glm::dvec3 vector = TupleOf(data->GetArray("RefractionLightVector"), i);
    EXPECT_NEAR(vector[0], across * sine, 2.0 * Parallel);
    EXPECT_NEAR(vector[1], across * cosine, 2.0 * Parallel);
    EXPECT_NEAR(vector[2], 0.0, 2.0 * Parallel);
    EXPECT_NEAR(
      data->GetArray("RefractionLightPath")->GetTuple1(i), 10.0 / inGlass + 20.0 / cosine, 0.01);
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

/** Rings: light at the angle a passes the pane at Height tan a and ends at the radius r(a). */
TEST(StackLight, LampAboveAPane)
{
  constexpr double height = 40.0;
  constexpr double thickness = 10.0;
  constexpr double depth = 30.0;
  const auto floor = MakeGrid(81, 80.0, -thickness - depth);
  const auto filter = MakePaneLight(floor, { 0.0, height, 0.0 });
  filter->PositionalOn();
  filter->Update();
  const auto tangent = [](double a, double index)
  { return std::tan(std::asin(std::sin(a) / index)); };
  const auto radius = [&](double a)
  { return height * std::tan(a) + thickness * tangent(a, Glass) + depth * tangent(a, Water); };
  const double largest = FindLargestLampError(
    filter, height, radius, [](double a) { return MakeTransmittance(std::sin(a), 1.0, Water); });
  EXPECT_LT(largest, 1e-3); // the mean of the cells around a point, as for one interface
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
    const auto floor = MakeGrid(cells + 1, size, y);
    const auto filter = MakeBallLight(floor);
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
    double squares = 0.0;
    double signal = 0.0;
    for (vtkIdType i = 0; i < floor->GetNumberOfCells(); ++i)
    {
      double bounds[6];
      floor->GetCellBounds(i, bounds);
      const auto bin = [](double low, double high)
      { return static_cast<std::size_t>((0.5 * (low + high) / size + 0.5) * cells); };
      const double expected = truth[bin(bounds[4], bounds[5]) * cells + bin(bounds[0], bounds[1])];
      squares += std::pow(CellOf(filter, i) - expected, 2.0);
      signal += expected * expected;
    }
    EXPECT_LT(std::sqrt(squares / signal), 5e-3) << y; // as for photons through waves
    RecordProperty("relative_rms_" + std::to_string(static_cast<int>(-y)),
      std::to_string(std::sqrt(squares / signal)));
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
  std::vector<double> light;
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::Initialize(threads);
    const auto filter = MakeBallLight(MakeGrid(21, 200.0, -60.0));
    filter->Update();
    for (vtkIdType i = 0; i < 400; ++i)
    {
      if (threads == 1)
      {
        light.push_back(CellOf(filter, i));
      }
      else
      {
        EXPECT_EQ(CellOf(filter, i), light[static_cast<std::size_t>(i)]);
      }
    }
  }
  vtkSMPTools::Initialize(0);
}

TEST(StackLight, ListsThatCannotBeUsed)
{
  ExpectBadLists([]() { return MakeLight(MakeGrid(9, 60.0, -20.0), Up); },
    [](vtkRefractedLightFilter* filter) { return filter->GetOutput()->GetNumberOfPoints(); });
}

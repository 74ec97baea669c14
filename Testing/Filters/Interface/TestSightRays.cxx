// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Sight rays of several eyes through panes and waves: true positions, triangulation and lines.
// Truth: exact paths through planes and spheres, and the way there and back.
#include "AbortedUpdate.h"
#include "ExactStack.h"
#include "StackFilterHelpers.h"

#include "vtkDepthImagePoints.h"
#include "vtkSightRayFilter.h"
#include "vtkTriangulatedPositionFilter.h"
#include "vtkTruePositionFilter.h"

namespace
{

using namespace meniscus::test;
namespace reference = meniscus::reference;

const glm::dvec3 Up(0.0, 1.0, 0.0);

/** Air, glass from 0 to -10, and water. */
const std::vector<reference::ExactSurface> Pane{ { 1.0, 1.5, glm::dvec3(0.0), 0.0, Up },
  { 1.5, 1.333, glm::dvec3(0.0, -10.0, 0.0), 0.0, Up } };

const std::vector<glm::dvec3> Cameras{ { 20.0, 300.0, 10.0 }, { -90.0, 220.0, 35.0 },
  { 15.0, 250.0, -120.0 } };

double GetRandom(unsigned& seed)
{
  seed = 1664525u * seed + 1013904223u;
  return seed / 4294967296.0;
}

/** Points that are seen, the eye of each, and its number. */
struct Observations
{
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Eyes;
  vtkNew<vtkIdTypeArray> Ids;

  Observations()
  {
    this->Points->SetDataTypeToDouble();
    this->Eyes->SetName("Eye");
    this->Eyes->SetNumberOfComponents(3);
    this->Ids->SetName("PointId");
    this->Data->SetPoints(this->Points);
    this->Data->GetPointData()->AddArray(this->Eyes);
    this->Data->GetPointData()->AddArray(this->Ids);
  }
  void Add(const glm::dvec3& seen, const glm::dvec3& eye, vtkIdType id)
  {
    this->Points->InsertNextPoint(&seen.x);
    this->Eyes->InsertNextTuple(&eye.x);
    this->Ids->InsertNextValue(id);
  }
};

template <typename Filter>
vtkSmartPointer<Filter> MakePaneFilter(vtkPointSet* seen)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputData(seen);
  filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  filter->SetEyeArrayName("Eye");
  AddInterface(filter, MakePlaneAt(0.0), 1.0, 1.5);
  AddInterface(filter, MakePlaneAt(-10.0), 1.5, 1.333);
  return filter;
}

double ValueOf(vtkDataSetAttributes* data, const char* name, vtkIdType i)
{
  return data->GetArray(name)->GetTuple1(i);
}

/**
 * Direction in which an eye sees a point behind planes, by bisection of the distance at which the
 * ray meets the first plane: the exact path's radius at the point's depth increases with it, up to
 * total reflection.
 */
glm::dvec3 FindDirection(const std::vector<reference::ExactSurface>& surfaces,
  const glm::dvec3& eye, const glm::dvec3& point)
{
  const glm::dvec3 foot(eye.x, 0.0, eye.z);
  const glm::dvec3 across(point.x - eye.x, 0.0, point.z - eye.z);
  const double target = glm::length(across);
  const auto aim = [&](double r) { return foot + (r / target) * across - eye; };
  double low = 0.0;
  double high = target;
  for (int i = 0; i < 80; ++i)
  {
    const double middle = 0.5 * (low + high);
    const auto path = reference::TraceExactly(surfaces, eye, aim(middle));
    if (!path)
    {
      high = middle;
      continue;
    }
    const glm::dvec3& from = path->Points.back();
    const glm::dvec3& direction = path->Directions.back();
    const glm::dvec3 end = from + (point.y - from.y) / direction.y * direction;
    (glm::length(glm::dvec3(end.x - eye.x, 0.0, end.z - eye.z)) < target ? low : high) = middle;
  }
  return glm::normalize(aim(0.5 * (low + high)));
}

} // anonymous namespace

//------------------------------------------------------------------------------
TEST(SightRays, PointsHaveTheirOwnEyesBehindAPane)
{
  Observations seen;
  std::vector<glm::dvec3> truth;
  unsigned seed = 1;
  for (vtkIdType i = 0; i < 600; ++i)
  {
    const glm::dvec3& eye = Cameras[static_cast<std::size_t>(i) / 20 % 3];
    const glm::dvec3 aim(80.0 * GetRandom(seed) - 40.0, 0.0, 80.0 * GetRandom(seed) - 40.0);
    const auto path = reference::TraceExactly(Pane, eye, aim - eye);
    const auto image = reference::MakeImage(Pane, *path, 1.0 + 60.0 * GetRandom(seed));
    seen.Add(image.Virtual, eye, i);
    truth.push_back(image.Point);
  }
  const auto filter = MakePaneFilter<vtkTruePositionFilter>(seen.Data);
  ExpectQuiet(filter);
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(i);
    ASSERT_EQ(ValueOf(filter->GetOutput()->GetPointData(), "SeenState", id),
      vtkTruePositionFilter::REFRACTED);
    EXPECT_LT(glm::length(PointOf(filter->GetOutput(), id) - truth[i]), 1e-11);
  }
}

//------------------------------------------------------------------------------
TEST(SightRays, EyesThatCannotBeUsedAreMarked)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Observations seen;
  seen.Add({ 5.0, -30.0, 3.0 }, Cameras[0], 0);
  seen.Add({ 5.0, -30.0, 3.0 }, { nan, 300.0, 0.0 }, 1);
  seen.Add({ 5.0, -30.0, 3.0 }, { 5.0, 0.0, 3.0 }, 2); // on a surface
  seen.Add({ 5.0, -30.0, 3.0 }, { 5.0, -30.0, 3.0 }, 3);
  const auto filter = MakePaneFilter<vtkTruePositionFilter>(seen.Data);
  filter->Update();
  const int states[4] = { vtkTruePositionFilter::REFRACTED, vtkTruePositionFilter::NOT_FINITE,
    vtkTruePositionFilter::NOT_FINITE, vtkTruePositionFilter::NOT_FINITE };
  for (vtkIdType i = 0; i < 4; ++i)
  {
    EXPECT_EQ(ValueOf(filter->GetOutput()->GetPointData(), "SeenState", i), states[i]) << i;
  }
  vtkNew<vtkSightRayFilter> rays;
  rays->SetInputData(seen.Data);
  rays->SetInterfaces(filter->GetInterfaces());
  rays->SetEyeArrayName("Eye");
  rays->AddMembraneData(MakePlaneAt(0.0));
  rays->AddMembraneData(MakePlaneAt(-10.0));
  rays->Update();
  EXPECT_EQ(rays->GetOutput()->GetNumberOfCells(), 3); // the legs of the first point
}

//------------------------------------------------------------------------------
// An aborted run has no output, and the next one is whole.
template <typename Filter>
class SightRaySteps : public ::testing::Test
{
};
using StepFilters =
  ::testing::Types<vtkTruePositionFilter, vtkSightRayFilter, vtkTriangulatedPositionFilter>;
TYPED_TEST_SUITE(SightRaySteps, StepFilters);

TYPED_TEST(SightRaySteps, ProgressIsReportedAndAbortObeyed)
{
  constexpr int count = 40000;
  Observations seen;
  for (vtkIdType i = 0; i < count; ++i)
  {
    seen.Add({ 0.001 * static_cast<double>(i), -30.0, 3.0 }, Cameras[0], i);
  }
  const auto filter = MakePaneFilter<TypeParam>(seen.Data);
  UpdateWithAbort(filter, 0.2);
  EXPECT_GE(filter->GetOutput()->GetNumberOfPoints(), count);
}

//------------------------------------------------------------------------------
TEST(SightRays, ArraysThatAreMissingAreErrors)
{
  Observations seen;
  seen.Add({ 5.0, -30.0, 3.0 }, Cameras[0], 0);
  const auto expectError = [](auto filter, const std::string& text)
  {
    const auto messages = UpdateAndObserve(filter);
    EXPECT_TRUE(HasText(messages->Text, text));
    EXPECT_TRUE(HasText(messages->Text, "the output is empty"));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  };
  const auto truth = MakePaneFilter<vtkTruePositionFilter>(seen.Data);
  truth->SetEyeArrayName("Cameras");
  expectError(truth, "no array \"Cameras\"");
  const auto rays = MakePaneFilter<vtkSightRayFilter>(seen.Data);
  rays->SetEyeArrayName("PointId");
  expectError(rays, "no array \"PointId\" with three components");
  const auto points = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
  points->SetPointIdArrayName("Eye");
  expectError(points, "no array \"Eye\" with one component");
  const auto two = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
  two->GetInterfaces()->RemoveItem(0);
  expectError(two, "interface");
}

//------------------------------------------------------------------------------
// Points in water, in the glass and in air, seen by three cameras.
TEST(SightRays, TriangulatePointsThroughAPane)
{
  Observations seen;
  std::vector<glm::dvec3> truth;
  unsigned seed = 3;
  for (vtkIdType i = 0; i < 90; ++i)
  {
    glm::dvec3 point(60.0 * GetRandom(seed) - 30.0, 0.0, 60.0 * GetRandom(seed) - 30.0);
    const double heights[3] = { -12.0 - 60.0 * GetRandom(seed), -1.0 - 8.0 * GetRandom(seed),
      1.0 + 20.0 * GetRandom(seed) };
    point.y = heights[i % 3];
    truth.push_back(point);
    for (const glm::dvec3& eye : Cameras)
    {
      const std::size_t surfaces = static_cast<std::size_t>(2 - i % 3);
      const glm::dvec3 direction = surfaces == 0
        ? glm::normalize(point - eye)
        : FindDirection({ Pane.begin(), Pane.begin() + static_cast<long>(surfaces) }, eye, point);
      seen.Add(eye + (1.0 + 300.0 * GetRandom(seed)) * direction, eye, 1000 - i);
    }
  }
  const auto filter = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
  ExpectQuiet(filter);
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 90);
  vtkPointData* arrays = filter->GetOutput()->GetPointData();
  for (vtkIdType i = 0; i < 90; ++i)
  {
    EXPECT_EQ(ValueOf(arrays, "PointId", i), 911.0 + static_cast<double>(i));
    EXPECT_EQ(ValueOf(arrays, "TriangulationState", i), vtkTriangulatedPositionFilter::FOUND);
    EXPECT_EQ(ValueOf(arrays, "NumberOfRays", i), 3.0);
    // Rounding of numbers up to 300, and of the directions' bisection, over the rays' angles.
    EXPECT_LT(
      glm::length(PointOf(filter->GetOutput(), i) - truth[static_cast<std::size_t>(89 - i)]),
      1e-10);
    EXPECT_LT(ValueOf(arrays, "Residual", i), 1e-10);
    EXPECT_GT(ValueOf(arrays, "RayAngle", i), 10.0);
  }
  EXPECT_EQ(filter->GetNumberOfPointsWithoutPosition(), 0);
}

/** As FindDirection, for an eye in water at y < 0 and a point in air: mirrored at y = 0. */
glm::dvec3 FindDirectionFromBelow(const glm::dvec3& eye, const glm::dvec3& point)
{
  const glm::dvec3 mirror(1.0, -1.0, 1.0);
  return mirror *
    FindDirection({ { 1.333, 1.0, glm::dvec3(0.0), 0.0, Up } }, mirror * eye, mirror * point);
}

//------------------------------------------------------------------------------
// Eyes in air and in water, one or two of each, see points in water and in air.
TEST(SightRays, EyesOnBothSidesOfASurface)
{
  const std::vector<reference::ExactSurface> surface{ { 1.0, 1.333, glm::dvec3(0.0), 0.0, Up } };
  const std::vector<glm::dvec3> above{ { 20.0, 60.0, 10.0 }, { -30.0, 45.0, 5.0 } };
  const std::vector<glm::dvec3> below{ { -25.0, -50.0, 40.0 }, { 35.0, -20.0, -15.0 } };
  Observations seen;
  std::vector<glm::dvec3> truth;
  unsigned seed = 4;
  vtkIdType rays = 0;
  for (vtkIdType i = 0; i < 120; ++i)
  {
    const bool isInWater = i % 2 == 0;
    const glm::dvec3 point(20.0 * GetRandom(seed) - 10.0,
      (isInWater ? -1.0 : 1.0) * (2.0 + 40.0 * GetRandom(seed)), 20.0 * GetRandom(seed) - 10.0);
    truth.push_back(point);
    for (std::size_t k = 0; k < 2; ++k)
    {
      if (k == 0 || i % 3 != 0)
      {
        const glm::dvec3 direction =
          isInWater ? FindDirection(surface, above[k], point) : glm::normalize(point - above[k]);
        seen.Add(above[k] + (1.0 + 90.0 * GetRandom(seed)) * direction, above[k], i);
        ++rays;
      }
      if (k == 0 || i % 3 != 1)
      {
        const glm::dvec3 direction =
          isInWater ? glm::normalize(point - below[k]) : FindDirectionFromBelow(below[k], point);
        seen.Add(below[k] + (1.0 + 90.0 * GetRandom(seed)) * direction, below[k], i);
        ++rays;
      }
    }
  }
  vtkNew<vtkTriangulatedPositionFilter> filter;
  filter->SetInputData(seen.Data);
  filter->SetMembraneData(MakePlaneAt(0.0));
  filter->SetInteriorIndexOfRefraction(1.333);
  filter->Update();
  vtkPointData* arrays = filter->GetOutput()->GetPointData();
  for (vtkIdType i = 0; i < 120; ++i)
  {
    EXPECT_EQ(ValueOf(arrays, "TriangulationState", i), vtkTriangulatedPositionFilter::FOUND);
    // Rounding of numbers up to 100, and of the directions' bisection, over the rays' angles.
    EXPECT_LT(
      glm::length(PointOf(filter->GetOutput(), i) - truth[static_cast<std::size_t>(i)]), 1e-10)
      << i;
    EXPECT_LT(ValueOf(arrays, "Residual", i), 1e-10);
    rays -= static_cast<vtkIdType>(ValueOf(arrays, "NumberOfRays", i));
  }
  EXPECT_EQ(rays, 0);
}

//------------------------------------------------------------------------------
// A pane in air, whose glass is seen from both sides. The list can be passed from either.
TEST(SightRays, EyesOnBothSidesOfAPane)
{
  const glm::dvec3 above(20.0, 60.0, 10.0);
  const glm::dvec3 below(-25.0, -70.0, 40.0);
  const glm::dvec3 mirror(1.0, -1.0, 1.0);
  const glm::dvec3 shift(0.0, 10.0, 0.0); // the lower side of the pane to y = 0
  const std::vector<reference::ExactSurface> side{ { 1.0, 1.5, glm::dvec3(0.0), 0.0, Up } };
  Observations seen;
  const std::vector<glm::dvec3> truth{ { 3.0, -4.0, 2.0 }, { 5.0, -22.0, -9.0 } };
  seen.Add(above + FindDirection(side, above, truth[0]), above, 0);
  seen.Add(
    below + mirror * FindDirection(side, mirror * (below + shift), mirror * (truth[0] + shift)),
    below, 0);
  // Below the pane: one eye sees the point through it.
  std::vector<reference::ExactSurface> both(Pane);
  both[1].Behind = 1.0;
  seen.Add(above + FindDirection(both, above, truth[1]), above, 1);
  seen.Add(truth[1], below, 1);
  const auto filter = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
  filter->GetInterfaces()->GetInterface(1)->SetInteriorIndexOfRefraction(1.0);
  filter->Update();
  for (vtkIdType i = 0; i < 2; ++i)
  {
    EXPECT_LT(
      glm::length(PointOf(filter->GetOutput(), i) - truth[static_cast<std::size_t>(i)]), 1e-10)
      << i;
  }
}

//------------------------------------------------------------------------------
// From an eye in the water no ray passes the list of air, glass and water, so that the medium
// around it is not known.
TEST(SightRays, EyesBehindAListHaveNoRays)
{
  const glm::dvec3 point(5.0, -30.0, 3.0);
  const glm::dvec3 diver(-40.0, -60.0, 7.0);
  Observations seen;
  for (const glm::dvec3& eye : { Cameras[0], Cameras[1] })
  {
    seen.Add(eye + FindDirection(Pane, eye, point), eye, 0);
  }
  seen.Add(point, diver, 0);
  const auto filter = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
  filter->Update();
  EXPECT_EQ(ValueOf(filter->GetOutput()->GetPointData(), "NumberOfRays", 0), 2.0);
  EXPECT_LT(glm::length(PointOf(filter->GetOutput(), 0) - point), 1e-10);
}

//------------------------------------------------------------------------------
// Numbers that only differ in bits that a double does not have.
TEST(SightRays, NumbersOfPointsMayBeLarge)
{
  const vtkIdType large = vtkIdType(1) << 60;
  Observations seen;
  for (const vtkIdType id : { large + 8, large + 7 })
  {
    const glm::dvec3 point(static_cast<double>(id - large), 20.0, 5.0);
    seen.Add(point, Cameras[0], id);
    seen.Add(point, Cameras[1], id);
  }
  const auto filter = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 2);
  auto* ids =
    vtkIdTypeArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("PointId"));
  EXPECT_EQ(ids->GetValue(0), large + 7);
  EXPECT_EQ(ids->GetValue(1), large + 8);
  EXPECT_LT(glm::length(PointOf(filter->GetOutput(), 0) - glm::dvec3(7.0, 20.0, 5.0)), 1e-10);
}

//------------------------------------------------------------------------------
TEST(SightRays, NumbersOfPointsAreWhole)
{
  for (const double bad : { std::nan(""), -std::numeric_limits<double>::infinity(), 1e19, 0.5 })
  {
    Observations seen;
    seen.Add({ 5.0, 20.0, 3.0 }, Cameras[0], 0);
    seen.Add({ 5.0, 20.0, 3.0 }, Cameras[1], 0);
    vtkNew<vtkDoubleArray> ids;
    ids->SetName("PointId");
    ids->InsertNextValue(7.0);
    ids->InsertNextValue(7.0);
    seen.Data->GetPointData()->AddArray(ids);
    const auto filter = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
    const auto messages = UpdateAndObserve(filter);
    EXPECT_EQ(messages->Errors, 0) << messages->Text;
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 1);
    ids->SetValue(1, bad);
    ids->Modified();
    filter->Update();
    EXPECT_TRUE(HasText(messages->Text, "not whole numbers"));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  }
}

//------------------------------------------------------------------------------
// Two skew rays in air, a distance of 6 apart and at right angles, and rays without a position.
TEST(SightRays, ResidualIsTheDistanceOfTheRays)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Observations seen;
  seen.Add({ 10.0, 23.0, 5.0 }, { -50.0, 23.0, 5.0 }, 0);
  seen.Add({ 4.0, 29.0, 1.0 }, { 4.0, 29.0, -80.0 }, 0);
  seen.Add({ 10.0, 23.0, 5.0 }, { -50.0, 23.0, 5.0 }, 1);
  seen.Add({ 10.0, 24.0, 5.0 }, { -50.0, 24.0, 5.0 }, 1);
  seen.Add({ 10.0, 23.0, 5.0 }, { -50.0, 23.0, 5.0 }, 2);
  seen.Add({ nan, 24.0, 5.0 }, { -50.0, 24.0, 5.0 }, 2);
  const auto filter = MakePaneFilter<vtkTriangulatedPositionFilter>(seen.Data);
  filter->Update();
  vtkPolyData* found = filter->GetOutput();
  ASSERT_EQ(found->GetNumberOfPoints(), 3);
  EXPECT_LT(glm::length(PointOf(found, 0) - glm::dvec3(4.0, 26.0, 5.0)), 1e-12);
  EXPECT_NEAR(ValueOf(found->GetPointData(), "Residual", 0), 3.0, 1e-12);
  EXPECT_NEAR(ValueOf(found->GetPointData(), "RayAngle", 0), 90.0, 1e-12);
  const int states[3] = { vtkTriangulatedPositionFilter::FOUND,
    vtkTriangulatedPositionFilter::PARALLEL, vtkTriangulatedPositionFilter::TOO_FEW_RAYS };
  const double rays[3] = { 2.0, 2.0, 1.0 };
  for (vtkIdType i = 0; i < 3; ++i)
  {
    EXPECT_EQ(ValueOf(found->GetPointData(), "TriangulationState", i), states[i]);
    EXPECT_EQ(ValueOf(found->GetPointData(), "NumberOfRays", i), rays[i]);
  }
  EXPECT_TRUE(std::isnan(PointOf(found, 1).x));
  EXPECT_EQ(filter->GetNumberOfPointsWithoutPosition(), 2);
}

//------------------------------------------------------------------------------
TEST(SightRays, LinesFollowTheExactPath)
{
  const glm::dvec3& eye = Cameras[1];
  const auto path = reference::TraceExactly(Pane, eye, glm::dvec3(20.0, 0.0, -15.0) - eye);
  const auto image = reference::MakeImage(Pane, *path, 25.0);
  Observations seen;
  seen.Add(image.Virtual, eye, 0);
  // The straight line to this point passes the pane without meeting it.
  seen.Add({ 900.0, -20.0, 0.0 }, eye, 1);
  const auto filter = MakePaneFilter<vtkSightRayFilter>(seen.Data);
  filter->Update();
  vtkPolyData* lines = filter->GetOutput();
  ASSERT_EQ(lines->GetNumberOfLines(), 4);
  const std::vector<glm::dvec3> corners{ eye, path->Points[0], path->Points[1], image.Point };
  const double indices[3] = { 1.0, 1.5, 1.333 };
  double optical = 0.0;
  for (vtkIdType leg = 0; leg < 3; ++leg)
  {
    const auto k = static_cast<std::size_t>(leg);
    vtkNew<vtkIdList> ends;
    lines->GetCellPoints(leg, ends);
    EXPECT_LT(glm::length(PointOf(lines, ends->GetId(0)) - corners[k]), 1e-11);
    EXPECT_LT(glm::length(PointOf(lines, ends->GetId(1)) - corners[k + 1]), 1e-11);
    optical += indices[k] * glm::length(corners[k + 1] - corners[k]);
    EXPECT_NEAR(ValueOf(lines->GetPointData(), "OpticalPath", ends->GetId(1)), optical, 1e-10);
    EXPECT_EQ(ValueOf(lines->GetCellData(), "IndexOfRefraction", leg), indices[k]);
    EXPECT_EQ(ValueOf(lines->GetCellData(), "Leg", leg), static_cast<double>(leg));
    EXPECT_EQ(ValueOf(lines->GetCellData(), "PointId", leg), 0.0);
  }
  EXPECT_EQ(ValueOf(lines->GetCellData(), "SeenState", 3), vtkTruePositionFilter::UNREFRACTED);
  EXPECT_EQ(PointOf(lines, lines->GetNumberOfPoints() - 1), glm::dvec3(900.0, -20.0, 0.0));
}

//------------------------------------------------------------------------------
// From glass into air, and through a pane whose second side is small.
TEST(SightRays, LinesEndWhereRaysEnd)
{
  vtkNew<vtkSightRayFilter> filter;
  const auto seen = MakePoints({ { 90.0, -0.5, 10.0 } });
  filter->SetInputData(seen);
  filter->SetMembraneData(MakeFlatMembrane());
  filter->SetEyePosition(20.0, 20.0, 10.0);
  filter->SetExteriorIndexOfRefraction(1.5);
  filter->SetInteriorIndexOfRefraction(1.0);
  filter->Update();
  vtkPolyData* lines = filter->GetOutput();
  ASSERT_EQ(lines->GetNumberOfLines(), 1);
  EXPECT_EQ(
    ValueOf(lines->GetCellData(), "SeenState", 0), vtkTruePositionFilter::TOTALLY_REFLECTED);
  EXPECT_NEAR(PointOf(lines, 1).y, 0.0, 1e-12);
  const double length = std::hypot(70.0, 20.5) * 20.0 / 20.5;
  EXPECT_NEAR(ValueOf(lines->GetPointData(), "OpticalPath", 1), 1.5 * length, 1e-11);

  Observations aside;
  aside.Add({ 99.0, -60.0, 0.0 }, { 90.0, 5.0, 0.0 }, 0);
  const auto through = MakePaneFilter<vtkSightRayFilter>(aside.Data);
  through->RemoveAllMembranes();
  through->AddMembraneData(MakePlaneAt(0.0));
  const auto small = MakeMembrane(meniscus::reference::MakePlane(-10.0, 20.0, 4));
  through->AddMembraneData(small);
  through->Update();
  ASSERT_EQ(through->GetOutput()->GetNumberOfLines(), 1);
  EXPECT_EQ(
    ValueOf(through->GetOutput()->GetCellData(), "SeenState", 0), vtkTruePositionFilter::MISSED);
}

//------------------------------------------------------------------------------
// A plane at a height, seen straight from above and at a slant: depths of each type in closed form.
TEST(DepthImage, PixelsLieWhereTheCameraSeesThem)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(20.0, 300.0, 10.0);
  camera->SetFocalPoint(-5.0, -20.0, 30.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(24.0);
  constexpr int width = 40;
  constexpr int height = 30;
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(-5.0, -20.0, 30.0) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(right, axis);
  const double half = std::tan(vtkMath::RadiansFromDegrees(12.0));
  for (const int type : { vtkDepthImagePoints::DEPTH_BUFFER, vtkDepthImagePoints::VIEW_DEPTH,
         vtkDepthImagePoints::RANGE })
  {
    // Only the depth buffer depends on the clipping range; the other one is that of a new camera.
    const bool isBuffer = type == vtkDepthImagePoints::DEPTH_BUFFER;
    camera->SetClippingRange(isBuffer ? 100.0 : 0.01, isBuffer ? 500.0 : 1000.01);
    vtkNew<vtkImageData> image;
    image->SetDimensions(width, height, 1);
    vtkNew<vtkDoubleArray> depths;
    depths->SetName("Depth");
    std::vector<glm::dvec3> truth;
    for (int i = 0; i < width * height; ++i)
    {
      const double x = (2.0 * (i % width + 0.5) / width - 1.0) * half * width / height;
      const double y = (2.0 * (i / width + 0.5) / height - 1.0) * half;
      const glm::dvec3 way = axis + x * right + y * up; // of depth 1
      const double depth = (-20.0 - eye.y) / way.y;
      truth.push_back(eye + depth * way);
      const double values[3] = { 500.0 / 400.0 * (1.0 - 100.0 / depth), depth,
        depth * glm::length(way) };
      depths->InsertNextValue(values[type]);
    }
    depths->SetValue(3, std::numeric_limits<double>::quiet_NaN());
    depths->SetValue(4, isBuffer ? 1.0 : 0.0);
    image->GetPointData()->SetScalars(depths);
    vtkNew<vtkDepthImagePoints> filter;
    filter->SetInputData(image);
    filter->SetCamera(camera);
    filter->SetDepthType(type);
    filter->Update();
    vtkPolyData* points = filter->GetOutput();
    ASSERT_EQ(points->GetNumberOfPoints(), width * height - 2);
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      const double pixel = ValueOf(points->GetPointData(), "PixelId", i);
      EXPECT_EQ(ValueOf(points->GetPointData(), "Depth", i),
        depths->GetValue(static_cast<vtkIdType>(pixel)));
      // The inverse of a projection whose clipping planes differ by a factor of 5; without them,
      // rounding of numbers up to 350 in some steps.
      EXPECT_LT(glm::length(PointOf(points, i) - truth[static_cast<std::size_t>(pixel)]),
        isBuffer ? 1e-9 : 5e-12)
        << type;
    }
  }
}

//------------------------------------------------------------------------------
TEST(DepthImage, BadInputIsAnError)
{
  vtkNew<vtkCamera> camera;
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 3, 1);
  const auto expectError = [](vtkDepthImagePoints* filter, const std::string& text)
  {
    const auto messages = UpdateAndObserve(filter);
    EXPECT_TRUE(HasText(messages->Text, text));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  };
  vtkNew<vtkDepthImagePoints> filter;
  filter->SetInputData(image);
  expectError(filter, "no camera");
  filter->SetCamera(camera);
  expectError(filter, "no point array of depths");
  image->AllocateScalars(VTK_FLOAT, 1);
  camera->ParallelProjectionOn();
  expectError(filter, "perspective");
  camera->ParallelProjectionOff();
  vtkNew<vtkImageData> slices;
  slices->SetDimensions(2, 3, 2);
  slices->AllocateScalars(VTK_FLOAT, 1);
  filter->SetInputData(slices);
  expectError(filter, "one slice");
}

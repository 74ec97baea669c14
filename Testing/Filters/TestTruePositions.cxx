// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// True positions of points that are seen through a membrane: closed forms for flat water, and the
// way there and back through waves.
#include "RefractedGeometryTestHelpers.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkSMPTools.h"
#include "vtkTruePositionFilter.h"
#include "vtkUnstructuredGrid.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace meniscus::testing;

constexpr double Water = 1.333;
const glm::dvec3 Eye(20.0, 300.0, 10.0);

vtkSmartPointer<vtkTruePositionFilter> MakeInverse(vtkPointSet* points, vtkPolyData* membrane)
{
  auto filter = vtkSmartPointer<vtkTruePositionFilter>::New();
  filter->SetInputData(points);
  filter->SetMembraneData(membrane);
  filter->SetEyePosition(Eye.x, Eye.y, Eye.z);
  filter->SetInteriorIndexOfRefraction(Water);
  return filter;
}

glm::dvec3 PointOf(vtkPointSet* data, vtkIdType i)
{
  glm::dvec3 point;
  data->GetPoint(i, &point.x);
  return point;
}

int StateOf(vtkPointSet* data, vtkIdType i)
{
  return static_cast<int>(data->GetPointData()->GetArray("SeenState")->GetTuple1(i));
}

/** Points below the membrane, in the middle of it. */
std::vector<Point> MakeDeepPoints(int count)
{
  std::mt19937 engine(7);
  const auto between = [&engine](double low, double high)
  { return low + (high - low) * (engine() / 4294967296.0); };
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
  {
    const double x = between(-50.0, 50.0);
    const double y = between(-60.0, -10.0);
    points.push_back({ x, y, between(-50.0, 50.0) });
  }
  return points;
}

/** Largest distance between points and their images, moved back. */
double MeasureWayBack(vtkPolyData* membrane, int count, vtkTypeInt64& refracted)
{
  const auto truth = MakePoints(MakeDeepPoints(count));
  const auto forward = MakeFilter(truth, membrane);
  forward->SetMembraneModelToCurved();
  forward->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  forward->SetInteriorIndexOfRefraction(Water);
  forward->Update();
  const auto back = MakeInverse(forward->GetOutput(), membrane);
  back->Update();
  vtkPointSet* found = back->GetOutput();
  double largest = 0.0;
  refracted = 0;
  for (vtkIdType i = 0; i < found->GetNumberOfPoints(); ++i)
  {
    if (StateOf(found, i) == vtkTruePositionFilter::REFRACTED)
    {
      ++refracted;
      largest = std::max(largest, glm::length(PointOf(found, i) - PointOf(truth, i)));
    }
  }
  return largest;
}

} // anonymous namespace

TEST(TruePositions, AreThoseOfSnellsLawUnderFlatWater)
{
  const auto membrane = MakeFlatMembrane();
  const auto seen = MakePoints(MakeDeepPoints(200));
  const auto filter = MakeInverse(seen, membrane);
  const auto messages = Observe(filter);
  filter->Update();
  EXPECT_EQ(messages->Errors + messages->Warnings, 0) << messages->Text;
  vtkPointSet* found = filter->GetOutput();
  ASSERT_EQ(found->GetNumberOfPoints(), 200);
  vtkDataArray* sights = found->GetPointData()->GetArray("SightPoint");
  vtkDataArray* paths = found->GetPointData()->GetArray("OpticalPath");
  for (vtkIdType i = 0; i < found->GetNumberOfPoints(); ++i)
  {
    ASSERT_EQ(StateOf(found, i), vtkTruePositionFilter::REFRACTED);
    const glm::dvec3 at = PointOf(seen, i);
    const glm::dvec3 direction = glm::normalize(at - Eye);
    const glm::dvec3 sight = Eye - Eye.y / direction.y * direction;
    const double cosine = std::sqrt(1.0 - (1.0 - direction.y * direction.y) / (Water * Water));
    const glm::dvec3 refracted(direction.x / Water, -cosine, direction.z / Water);
    const double depth = Water * glm::length(at - sight);
    EXPECT_LT(glm::length(PointOf(found, i) - (sight + depth * refracted)), 1e-11);
    glm::dvec3 met;
    sights->GetTuple(i, &met.x);
    EXPECT_LT(glm::length(met - sight), 1e-11);
    EXPECT_NEAR(paths->GetTuple1(i), glm::length(sight - Eye) + Water * depth, 1e-10);
  }
}

TEST(TruePositions, UndoTheRefractionOfWaves)
{
  const auto membrane = MakeMembrane(meniscus::reference::MakeWaves(200.0, 40, 2.0, 3.0));
  vtkTypeInt64 refracted = 0;
  // Newton's method ends 1e-12 of the membrane's size from the sight point.
  EXPECT_LT(MeasureWayBack(membrane, 2000, refracted), 1e-9);
  EXPECT_EQ(refracted, 2000);
}

// Rays to points in rows start where the last one met the surface, those to points far apart are
// searched: from patch to patch, beyond the border, behind rough and steep waves, and through a
// ball.
TEST(TruePositions, DoNotDependOnTheOrderOfPoints)
{
  using namespace meniscus::reference;
  MembraneMesh ball = MakeSphere(24, 1.0);
  for (double& coordinate : ball.Points)
  {
    coordinate *= 60.0;
  }
  std::mt19937 engine(5);
  for (const MembraneMesh& mesh : { MakeWaves(200.0, 40, 2.0, 3.0), MakeWaves(200.0, 12, 2.0, 3.0),
         MakeRandom(200.0, 20, 0.5, 0.05, 1), MakeWaves(200.0, 40, 15.0, 4.0), ball })
  {
    const auto membrane = MakeMembrane(mesh);
    std::vector<Point> rows;
    for (int row = 0; row < 40; ++row)
    {
      for (int i = 0; i < 100; ++i)
      {
        rows.push_back({ -150.0 + 3.0 * i, -70.3 + 2.0 * row, -100.0 + 5.0 * row });
      }
    }
    std::vector<std::size_t> order(rows.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), engine);
    std::vector<Point> shuffled;
    for (const std::size_t i : order)
    {
      shuffled.push_back(rows[i]);
    }
    const auto inRows = MakeInverse(MakePoints(rows), membrane);
    const auto apart = MakeInverse(MakePoints(shuffled), membrane);
    inRows->Update();
    apart->Update();
    int refracted = 0;
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const auto here = static_cast<vtkIdType>(order[i]);
      const auto there = static_cast<vtkIdType>(i);
      ASSERT_EQ(StateOf(inRows->GetOutput(), here), StateOf(apart->GetOutput(), there)) << here;
      refracted += StateOf(inRows->GetOutput(), here) == vtkTruePositionFilter::REFRACTED;
      // Newton's method ends 1e-14 of a facet from the root, except where rays are tangential.
      EXPECT_LT(
        glm::length(PointOf(inRows->GetOutput(), here) - PointOf(apart->GetOutput(), there)), 1e-10)
        << here;
    }
    EXPECT_GT(refracted, 500);
  }
}

TEST(TruePositions, ThreadsChangeNoBit)
{
  const auto membrane = MakeMembrane(meniscus::reference::MakeWaves(200.0, 40, 2.0, 3.0));
  const auto seen = MakePoints(MakeDeepPoints(20000)); // more than one step of progress
  const auto one = MakeInverse(seen, membrane);
  const auto two = MakeInverse(seen, membrane);
  vtkSMPTools::Initialize(1);
  one->Update();
  vtkSMPTools::Initialize(2);
  two->Update();
  vtkSMPTools::Initialize(0);
  for (vtkIdType i = 0; i < seen->GetNumberOfPoints(); ++i)
  {
    ASSERT_EQ(PointOf(one->GetOutput(), i), PointOf(two->GetOutput(), i)) << i;
  }
}

TEST(TruePositions, KeepPointsInFrontAndBeside)
{
  const double inf = std::numeric_limits<double>::infinity();
  const auto seen = MakePoints({ { 5.0, 10.0, 3.0 }, { 400.0, -20.0, 0.0 }, { inf, 0.0, 0.0 },
    { Eye.x, Eye.y, Eye.z }, { 5.0, -10.0, 3.0 } });
  const auto filter = MakeInverse(seen, MakeFlatMembrane());
  filter->Update();
  const int states[5] = { vtkTruePositionFilter::UNREFRACTED, vtkTruePositionFilter::UNREFRACTED,
    vtkTruePositionFilter::NOT_FINITE, vtkTruePositionFilter::NOT_FINITE,
    vtkTruePositionFilter::REFRACTED };
  for (vtkIdType i = 0; i < 5; ++i)
  {
    EXPECT_EQ(StateOf(filter->GetOutput(), i), states[i]) << i;
    if (i < 4)
    {
      EXPECT_EQ(PointOf(filter->GetOutput(), i), PointOf(seen, i)) << i;
    }
  }
}

TEST(TruePositions, CountPointsBeyondTheCriticalAngle)
{
  // From the water into air: sines above 1 / 1.333 are totally reflected.
  const auto seen = MakePoints({ { 20.0, -5.0, 10.0 }, { 90.0, -0.5, 10.0 } });
  const auto filter = MakeInverse(seen, MakeFlatMembrane());
  filter->SetEyePosition(20.0, 20.0, 10.0);
  filter->SetExteriorIndexOfRefraction(Water);
  filter->SetInteriorIndexOfRefraction(1.0);
  filter->Update();
  EXPECT_EQ(StateOf(filter->GetOutput(), 0), vtkTruePositionFilter::REFRACTED);
  EXPECT_EQ(StateOf(filter->GetOutput(), 1), vtkTruePositionFilter::TOTALLY_REFLECTED);
  EXPECT_EQ(PointOf(filter->GetOutput(), 1), PointOf(seen, 1));
  EXPECT_EQ(filter->GetNumberOfTotallyReflectedPoints(), 1);
}

TEST(TruePositions, EqualIndicesChangeNoBit)
{
  const auto seen = MakePoints(MakeDeepPoints(50));
  const auto filter =
    MakeInverse(seen, MakeMembrane(meniscus::reference::MakeWaves(200.0, 10, 2.0, 3.0)));
  filter->SetInteriorIndexOfRefraction(1.0);
  filter->Update();
  for (vtkIdType i = 0; i < 50; ++i)
  {
    EXPECT_EQ(PointOf(filter->GetOutput(), i), PointOf(seen, i));
  }
}

TEST(TruePositions, TakeAnyPointSetAndKeepItsArrays)
{
  vtkNew<vtkUnstructuredGrid> grid;
  const auto points = MakePoints(MakeDeepPoints(4));
  grid->SetPoints(points->GetPoints());
  const vtkIdType corners[4] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_TETRA, 4, corners);
  const auto filter = MakeInverse(grid, MakeFlatMembrane());
  filter->Update();
  auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutput());
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetNumberOfCells(), 1);
  EXPECT_EQ(StateOf(output, 0), vtkTruePositionFilter::REFRACTED);
}

TEST(TruePositions, PatchesAreBuiltOncePerMembrane)
{
  const auto filter = MakeInverse(MakePoints(MakeDeepPoints(4)), MakeFlatMembrane());
  filter->Update();
  filter->SetEyePosition(0.0, 200.0, 0.0);
  filter->Update();
  filter->SetInteriorIndexOfRefraction(1.5);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 1);
  EXPECT_EQ(filter->GetNumberOfEyeUpdates(), 3);
  filter->SetInputData(MakePoints(MakeDeepPoints(5)));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 5);
  EXPECT_EQ(filter->GetNumberOfEyeUpdates(), 3);
}

TEST(TruePositions, BadInputIsAnError)
{
  const auto points = MakePoints(MakeDeepPoints(4));
  const auto expectError = [&](vtkTruePositionFilter* filter, const char* what)
  {
    const auto messages = Observe(filter);
    filter->Update();
    EXPECT_NE(messages->Text.find("the output is empty"), std::string::npos)
      << what << ": " << messages->Text;
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << what;
  };
  auto filter = MakeInverse(points, MakeFlatMembrane());
  filter->SetInteriorIndexOfRefraction(0.0);
  expectError(filter, "index 0");
  filter = MakeInverse(points, MakeFlatMembrane());
  filter->SetEyePosition(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  expectError(filter, "eye");
  filter = MakeInverse(points, MakePoints({ { 0.0, 0.0, 0.0 } }));
  expectError(filter, "membrane without triangles");
  filter = MakeInverse(points, MakeFlatMembrane());
  vtkNew<vtkRefractingInterface> second;
  filter->GetInterfaces()->AddItem(second);
  expectError(filter, "two interfaces");
}

// A path of the length a in air and b in water is seen at a + b / n, a + n b or a + b.
TEST(TruePositions, DepthsAreApparentOpticalOrGeometric)
{
  const auto membrane = MakeFlatMembrane();
  const double factors[] = { 1.0 / Water, Water, 1.0 };
  const glm::dvec3 sightPoint(-40.0, 0.0, 25.0);
  const glm::dvec3 sight = glm::normalize(sightPoint - Eye);
  glm::dvec3 refracted(sight.x / Water, 0.0, sight.z / Water);
  refracted.y = -std::sqrt(1.0 - glm::dot(refracted, refracted));
  constexpr double path = 30.0;
  const glm::dvec3 truth = sightPoint + path * refracted;
  for (int depth = 0; depth < 3; ++depth)
  {
    const glm::dvec3 seen = sightPoint + factors[depth] * path * sight;
    // The second point has its own index around the eye: only the ratio counts.
    for (const double scale : { 1.0, 1.2 })
    {
      for (const bool isStack : { false, true })
      {
        const auto filter = MakeInverse(MakePoints({ { seen.x, seen.y, seen.z } }), membrane);
        filter->SetDepth(depth);
        filter->SetExteriorIndexOfRefraction(scale);
        filter->SetInteriorIndexOfRefraction(scale * Water);
        if (isStack)
        {
          // A second surface far below, which the ray does not reach.
          auto bottom = vtkSmartPointer<vtkPolyData>::New();
          bottom->DeepCopy(membrane);
          for (vtkIdType i = 0; i < bottom->GetNumberOfPoints(); ++i)
          {
            double point[3];
            bottom->GetPoint(i, point);
            bottom->GetPoints()->SetPoint(i, point[0], -100.0, point[2]);
          }
          filter->AddMembraneData(bottom);
          filter->GetInterfaces()->AddInterface(scale * Water, 1.5);
        }
        filter->Update();
        EXPECT_EQ(StateOf(filter->GetOutput(), 0), vtkTruePositionFilter::REFRACTED);
        EXPECT_LT(glm::length(PointOf(filter->GetOutput(), 0) - truth), 1e-10)
          << depth << " " << scale << " " << isStack;
      }
    }
  }
}

// A laser scanner above a pool of depth 1: with the apparent depth it was 1.777.
TEST(TruePositions, LaserScansShowTheBottom)
{
  const auto scan = MakePoints({ { Eye.x, Eye.y - (Eye.y + Water * 1.0), Eye.z } });
  const auto filter = MakeInverse(scan, MakeFlatMembrane());
  filter->SetDepthToOptical();
  filter->Update();
  EXPECT_NEAR(PointOf(filter->GetOutput(), 0).y, -1.0, 1e-10);
  filter->SetDepthToApparent();
  filter->Update();
  EXPECT_NEAR(PointOf(filter->GetOutput(), 0).y, -Water * Water, 1e-10);
}

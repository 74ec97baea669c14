// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// True positions of points that are seen through one interface or several: closed forms for planes
// and balls, the way there and back through waves, and lists that cannot be used.
#include "ExactStack.h"
#include "StackFilterHelpers.h"

#include "vtkTruePositionFilter.h"

namespace
{

using namespace meniscus::test;
namespace reference = meniscus::reference;

constexpr double Water = 1.333;
const glm::dvec3 Eye(20.0, 300.0, 10.0);

/** Air, and layers of a thickness of 10 below each other; the last one has no end. */
std::vector<reference::ExactSurface> MakeLayers(int interfaces)
{
  constexpr double indices[] = { 1.0, 1.5, Water, 1.4 };
  std::vector<reference::ExactSurface> layers;
  for (int i = 0; i < interfaces; ++i)
  {
    layers.push_back({ indices[i], indices[i + 1], glm::dvec3(0.0, -10.0 * i, 0.0), 0.0,
      glm::dvec3(0.0, 1.0, 0.0) });
  }
  return layers;
}

/** Images of points in several depths behind surfaces, on rays from the eye to a disc around 0. */
std::vector<reference::ExactImage> MakeImages(
  const std::vector<reference::ExactSurface>& surfaces, double radius)
{
  std::vector<reference::ExactImage> images;
  for (int i = 0; i < 300; ++i)
  {
    const double r = radius * std::sqrt((i + 0.5) / 300.0);
    const glm::dvec3 aim(r * std::cos(2.4 * i), 0.0, r * std::sin(2.4 * i));
    const auto path = reference::TraceExactly(surfaces, Eye, aim - Eye);
    EXPECT_TRUE(path.has_value());
    images.push_back(reference::MakeImage(surfaces, *path, 1.0 + i % 60));
  }
  return images;
}

vtkSmartPointer<vtkTruePositionFilter> MakeInverse(vtkPointSet* points, vtkPolyData* membrane)
{
  auto filter = vtkSmartPointer<vtkTruePositionFilter>::New();
  filter->SetInputData(points);
  filter->SetMembraneData(membrane);
  filter->SetEyePosition(Eye.x, Eye.y, Eye.z);
  filter->SetInteriorIndexOfRefraction(Water);
  return filter;
}

/** A filter without interfaces. */
vtkSmartPointer<vtkTruePositionFilter> MakeInverse(vtkPointSet* points)
{
  auto filter = vtkSmartPointer<vtkTruePositionFilter>::New();
  filter->SetInputData(points);
  filter->SetEyePosition(Eye.x, Eye.y, Eye.z);
  filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  return filter;
}

vtkSmartPointer<vtkTruePositionFilter> MakeLayerInverse(
  vtkPointSet* points, const std::vector<reference::ExactSurface>& layers)
{
  auto filter = MakeInverse(points);
  for (const reference::ExactSurface& layer : layers)
  {
    AddInterface(filter.Get(), MakePlaneAt(layer.Centre.y), layer.Before, layer.Behind);
  }
  return filter;
}

vtkSmartPointer<vtkPolyData> MakeSeen(const std::vector<reference::ExactImage>& images)
{
  std::vector<Point> points;
  for (const reference::ExactImage& image : images)
  {
    points.push_back({ image.Virtual.x, image.Virtual.y, image.Virtual.z });
  }
  return MakePoints(points);
}

int StateOf(vtkPointSet* data, vtkIdType i)
{
  return static_cast<int>(data->GetPointData()->GetArray("SeenState")->GetTuple1(i));
}

/** Largest distance of the positions found from those of the images; all must be refracted. */
double MeasureInverse(
  vtkTruePositionFilter* filter, const std::vector<reference::ExactImage>& images)
{
  ExpectQuiet(filter);
  double largest = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(i);
    EXPECT_EQ(StateOf(filter->GetOutput(), id), vtkTruePositionFilter::REFRACTED);
    largest = std::max(largest, glm::length(PointOf(filter->GetOutput(), id) - images[i].Point));
  }
  return largest;
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

/** The parameter is the number of interfaces. */
class TruePositionsThrough : public ::testing::TestWithParam<int>
{
};

} // anonymous namespace

//------------------------------------------------------------------------------
TEST_P(TruePositionsThrough, LayersObeySnellsLaw)
{
  const auto layers = MakeLayers(this->GetParam());
  const auto images = MakeImages(layers, 80.0);
  const auto filter = MakeLayerInverse(MakeSeen(images), layers);
  // Rounding of numbers up to 300, in a few steps.
  EXPECT_LT(MeasureInverse(filter, images), 1e-11);
  vtkDataArray* paths = filter->GetOutput()->GetPointData()->GetArray("OpticalPath");
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(i);
    const glm::dvec3 sight =
      TupleOf(filter->GetOutput()->GetPointData()->GetArray("SightPoint"), id);
    const auto path = reference::TraceExactly(layers, Eye, images[i].Virtual - Eye);
    EXPECT_LT(glm::length(sight - path->Points[0]), 1e-11);
    double optical = glm::length(path->Points[0] - Eye);
    for (std::size_t k = 0; k < layers.size(); ++k)
    {
      const glm::dvec3& next = k + 1 < layers.size() ? path->Points[k + 1] : images[i].Point;
      optical += layers[k].Behind * glm::length(next - path->Points[k]);
    }
    EXPECT_NEAR(paths->GetTuple1(id), optical, 1e-10);
  }
}

TEST_P(TruePositionsThrough, WavesAreUndone)
{
  const auto truth = MakePoints(MakeDeepPoints(1000));
  vtkNew<vtkRefractedGeometryFilter> forward;
  forward->SetInputData(0, MoveBy(truth, -30.0));
  forward->SetEyePosition(Eye.x, Eye.y, Eye.z);
  forward->SetImagesToFirstImage();
  forward->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  forward->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  const auto back = MakeInverse(nullptr);
  back->SetInterfaces(forward->GetInterfaces());
  for (int i = 0; i < this->GetParam(); ++i)
  {
    const auto layer = MakeLayers(i + 1).back();
    const auto waves =
      MoveBy(MakeMembrane(reference::MakeWaves(200.0, 40 - 5 * i, 2.0 - 0.5 * i, 3.0)),
        1.5 * layer.Centre.y);
    AddInterface(forward.Get(), waves, layer.Before, layer.Behind);
    back->AddMembraneData(waves);
  }
  forward->Update();
  ASSERT_EQ(forward->GetOutput()->GetNumberOfPoints(), 1000);
  back->SetInputData(forward->GetOutput());
  back->Update();
  double largest = 0.0;
  for (vtkIdType i = 0; i < 1000; ++i)
  {
    ASSERT_EQ(StateOf(back->GetOutput(), i), vtkTruePositionFilter::REFRACTED);
    largest = std::max(largest, glm::length(PointOf(back->GetOutput(), i) - PointOf(truth, i)));
  }
  // Newton's method ends 1e-12 of the membrane's size from the sight point.
  EXPECT_LT(largest, 1e-9);
}

TEST_P(TruePositionsThrough, EqualIndicesChangeNoBit)
{
  const auto seen = MakePoints(MakeDeepPoints(50));
  const auto filter = MakeInverse(seen);
  for (int i = 0; i < this->GetParam(); ++i)
  {
    AddInterface(filter.Get(),
      MoveBy(MakeMembrane(reference::MakeWaves(200.0, 10, 2.0, 3.0)), -10.0 * i), Water, Water);
  }
  filter->Update();
  for (vtkIdType i = 0; i < 50; ++i)
  {
    EXPECT_EQ(PointOf(filter->GetOutput(), i), PointOf(seen, i));
    EXPECT_NEAR(filter->GetOutput()->GetPointData()->GetArray("OpticalPath")->GetTuple1(i),
      Water * glm::length(PointOf(seen, i) - Eye), 1e-10);
  }
}

// The eye is in the water, and sees through the air above it: the ray from there is the ray from
// the other side, backwards.
TEST_P(TruePositionsThrough, EyesBehindTheSurfacesAreInTheLastMedium)
{
  const auto layers = MakeLayers(this->GetParam());
  const glm::dvec3 point(25.0, 120.0, -8.0);
  const auto path = reference::TraceExactly(layers, point, glm::dvec3(-0.2, -1.0, 0.1));
  const glm::dvec3 last = path->Points.back();
  const glm::dvec3 eye = last + 60.0 * path->Directions.back();
  // The reverse list, from the eye on; geometric depths.
  double length = glm::length(last - eye);
  const auto filter = MakeInverse(nullptr);
  for (std::size_t k = layers.size(); k-- > 0;)
  {
    AddInterface(filter.Get(), MakePlaneAt(layers[k].Centre.y), layers[k].Before, layers[k].Behind);
    length += glm::length(path->Points[k] - (k > 0 ? path->Points[k - 1] : point));
  }
  const glm::dvec3 seen = eye + length * glm::normalize(last - eye);
  filter->SetInputData(MakePoints({ { seen.x, seen.y, seen.z } }));
  filter->SetEyePosition(eye.x, eye.y, eye.z);
  filter->SetDepthToGeometric();
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(StateOf(filter->GetOutput(), 0), vtkTruePositionFilter::REFRACTED);
  EXPECT_LT(glm::length(PointOf(filter->GetOutput(), 0) - point), 1e-10);
  // The media of several interfaces tell that the eye is there. That is not known of one, of which
  // the warning is given once.
  const int warnings = this->GetParam() == 1 ? 1 : 0;
  EXPECT_EQ(messages->Warnings, warnings) << messages->Text;
  filter->SetEyePosition(eye.x + 1.0, eye.y, eye.z);
  filter->Update();
  EXPECT_EQ(messages->Warnings + messages->Errors, warnings) << messages->Text;
}

INSTANTIATE_TEST_SUITE_P(TruePositions, TruePositionsThrough, ::testing::Values(1, 2, 3));

//------------------------------------------------------------------------------
// Rays to points in rows start where the last one met the surface, those to points far apart are
// searched: from patch to patch, beyond the border, behind rough and steep waves, and through a
// ball.
TEST(TruePositions, DoNotDependOnTheOrderOfPoints)
{
  using namespace reference;
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
    for (const auto& [row, i] : Product(40, 100))
    {
      rows.push_back({ -150.0 + 3.0 * i, -70.3 + 2.0 * row, -100.0 + 5.0 * row });
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
  ExpectSameOnThreads(
    [&]
    {
      const auto filter = MakeInverse(seen, membrane);
      filter->Update();
      return ValuesOf(filter->GetOutput()->GetPoints()->GetData());
    });
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
    const auto messages = UpdateAndObserve(filter);
    EXPECT_TRUE(HasText(messages->Text, "the output is empty")) << what;
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
    for (const auto& [scale, isStack] : Product(List(1.0, 1.2), List(false, true)))
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
        MapPoints(bottom, [](const glm::dvec3& p) { return glm::dvec3(p.x, -100.0, p.z); });
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

TEST(TruePositions, PointsInThePaneAreRefractedOnce)
{
  const auto first = MakeLayers(1);
  std::vector<reference::ExactImage> images;
  for (const double length : { 0.5, 4.0, 9.5 })
  {
    const auto path = reference::TraceExactly(first, Eye, -Eye);
    images.push_back(reference::MakeImage(first, *path, length));
  }
  const auto filter = MakeLayerInverse(MakeSeen(images), MakeLayers(2));
  EXPECT_LT(MeasureInverse(filter, images), 1e-11);
}

TEST(TruePositions, ABallIsListedTwice)
{
  const auto images = MakeImages({ { 1.0, 1.5, glm::dvec3(0.0), 40.0 },
                                   { 1.5, 1.0, glm::dvec3(0.0), 40.0, glm::dvec3(0.0), true } },
    25.0);
  const auto filter = MakeInverse(MakeSeen(images));
  const auto ball = MakeMembrane(reference::MakeSphere(glm::dvec3(0.0), 40.0, 3, true));
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(40.0);
  for (int i = 0; i < 2; ++i)
  {
    AddInterface(filter.Get(), ball, 1.0, 1.5);
    filter->GetInterfaces()->GetInterface(i)->SetExactSurface(sphere);
  }
  EXPECT_LT(MeasureInverse(filter, images), 1e-9);
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 1);
}

TEST(TruePositions, EveryRayThatEndsIsCounted)
{
  const double inf = std::numeric_limits<double>::infinity();
  // In front; beside the pane; through the first surface, and past the second one, which is
  // smaller; not finite; without a direction.
  const auto seen = MakePoints({ { 5.0, 10.0, 3.0 }, { 400.0, -20.0, 0.0 }, { 98.0, -30.0, 0.0 },
    { inf, 0.0, 0.0 }, { Eye.x, Eye.y, Eye.z } });
  const auto filter = MakeInverse(seen);
  AddInterface(filter.Get(), MakePlaneAt(0.0), 1.0, 1.5);
  AddInterface(filter.Get(), MakeMembrane(reference::MakePlane(-10.0, 100.0, 4)), 1.5, 1.333);
  filter->Update();
  const int states[5] = { vtkTruePositionFilter::UNREFRACTED, vtkTruePositionFilter::UNREFRACTED,
    vtkTruePositionFilter::MISSED, vtkTruePositionFilter::NOT_FINITE,
    vtkTruePositionFilter::NOT_FINITE };
  for (vtkIdType i = 0; i < 5; ++i)
  {
    EXPECT_EQ(StateOf(filter->GetOutput(), i), states[i]) << i;
    EXPECT_EQ(PointOf(filter->GetOutput(), i), PointOf(seen, i)) << i;
  }
  EXPECT_EQ(filter->GetNumberOfMissedPoints(), 1);

  // Out of water through glass into air: beyond the critical angle of both, in glass 41.8 degrees.
  const auto flat = MakePoints({ { -60.0, -12.0, 10.0 }, { 15.0, -3.0, 10.0 } });
  const auto out = MakeInverse(flat);
  AddInterface(out.Get(), MakePlaneAt(0.0), 1.333, 1.5);
  AddInterface(out.Get(), MakePlaneAt(-10.0), 1.5, 1.0);
  out->SetEyePosition(-60.0, 20.0, 10.0);
  out->Update();
  EXPECT_EQ(StateOf(out->GetOutput(), 0), vtkTruePositionFilter::REFRACTED);
  // Refracted by the first surface; seen in the glass, at a depth of less than 10.
  EXPECT_EQ(StateOf(out->GetOutput(), 1), vtkTruePositionFilter::REFRACTED);
  out->SetInputData(MakePoints({ { 15.0, -16.0, 10.0 } }));
  out->Update();
  EXPECT_EQ(StateOf(out->GetOutput(), 0), vtkTruePositionFilter::TOTALLY_REFLECTED);
  EXPECT_EQ(PointOf(out->GetOutput(), 0), glm::dvec3(15.0, -16.0, 10.0));
  EXPECT_EQ(out->GetNumberOfTotallyReflectedPoints(), 1);
}

TEST(TruePositions, ListsThatCannotBeUsed)
{
  ExpectBadLists(
    []() {
      return MakeInverse(MakePoints({ { 1.0, -20.0, 2.0 } }));
    },
    [](vtkTruePositionFilter* filter) { return filter->GetOutput()->GetNumberOfPoints(); });
}

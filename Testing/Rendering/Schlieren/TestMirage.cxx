// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Pictures of objects through a medium that bends light, and objects where they are seen.
#include "MirageScene.h"

#include <vtkApparentGeometryFilter.h>

using namespace meniscus::test;

namespace
{

/** Air over a road: n^2 rises with the height, 100 units from one end to the other. */
constexpr double Base = 1.6;
constexpr double Rise = 2.4e-4;
constexpr double Half = 50.0;
constexpr double Eye = 60.0;

Grid MakeAir()
{
  const Grid air =
    MakeBlock(5, [](double, double y, double) { return std::sqrt(Base + Rise * y); });
  MapPoints(air, [](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, Half * p.z); });
  return air;
}

/** Place and direction, at a depth z, of a ray from the eye (0, 0, Eye) in closed form. */
glm::dvec3 FollowParabola(const glm::dvec3& direction, double z)
{
  glm::dvec3 place = glm::dvec3(0.0, 0.0, Eye) + (Eye - Half) / -direction.z * direction;
  const glm::dvec3 momentum = std::sqrt(Base + Rise * place.y) * glm::normalize(direction);
  const double time = (std::max(z, -Half) - Half) / momentum.z;
  place += time * momentum + 0.25 * Rise * time * time * glm::dvec3(0, 1, 0);
  const glm::dvec3 end = momentum + 0.5 * Rise * time * glm::dvec3(0, 1, 0);
  return place + std::min(z + Half, 0.0) / end.z * end;
}

Object MakeSphere(const glm::dvec3& middle, double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(middle.x, middle.y, middle.z);
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  sphere->Update();
  return sphere->GetOutput();
}

/** Expects equal arrays, numbers that are NaN alike, within a tolerance. */
void ExpectSame(vtkTetrahedraMirage* a, vtkTetrahedraMirage* b, double tolerance)
{
  for (const char* name : { "Color", "Seen", "CellId", "Position", "Depth", "Direction" })
  {
    vtkDataArray* first = ArrayOf(a, name);
    vtkDataArray* second = ArrayOf(b, name);
    for (vtkIdType i = 0; i < first->GetNumberOfValues(); ++i)
    {
      const double values[2] = { first->GetVariantValue(i).ToDouble(),
        second->GetVariantValue(i).ToDouble() };
      ASSERT_EQ(std::isnan(values[0]), std::isnan(values[1])) << name << " " << i;
      if (!std::isnan(values[0]))
      {
        ASSERT_NEAR(values[0], values[1], tolerance) << name << " " << i;
      }
    }
  }
}

vtkSmartPointer<vtkApparentGeometryFilter> MakeApparent(vtkDataObject* mesh, vtkPointSet* object)
{
  auto filter = vtkSmartPointer<vtkApparentGeometryFilter>::New();
  filter->SetInputDataObject(object);
  filter->SetMediumData(mesh);
  filter->SetQuantityToRefractiveIndex();
  return filter;
}

}

// Walls in the air, and behind it: the places that are seen are those of parabolas.
TEST(Mirage, WallsAreSeenAlongParabolas)
{
  constexpr double tangent = 6.0e-3;
  for (const double z : { 20.0, -49.0, -80.0 })
  {
    Filter filter = MakeFilter(MakeAir(), MakePlane(z, 3.0));
    filter->SetCamera(MakeCamera({ 0, 0, Eye }, { 0, 0, 0 }, tangent));
    filter->Update();
    int compared = 0;
    for (const auto& [row, column] : Product(Size, Size))
    {
      const double step = 2.0 * tangent / Size;
      const glm::dvec3 direction(
        step * (column + 0.5 - 0.5 * Size), step * (row + 0.5 - 0.5 * Size), -1.0);
      const glm::dvec3 place = FollowParabola(direction, z);
      const glm::dvec3 last = FollowParabola(direction, -Half);
      if (std::max(std::abs(last.x), std::abs(last.y)) > 0.95)
      {
        continue;
      }
      const vtkIdType pixel = row * Size + column;
      ASSERT_EQ(ValueAt(filter, "Seen", pixel), vtkTetrahedraMirage::OBJECT);
      // Positions of the mesh are rounded to 2^-31 of its radius of 50, and bend by as much.
      EXPECT_NEAR(glm::distance(VectorAt(filter, "Position", pixel), place), 0.0, 2.0e-7);
      EXPECT_NEAR(
        ValueAt(filter, "Depth", pixel), glm::distance(place, glm::dvec3(0.0, 0.0, Eye)), 1.0e-5);
      ++compared;
    }
    EXPECT_GT(compared, Size * Size / 4) << z;
    EXPECT_EQ(filter->GetStatistic("NumberOfLostRays"), 0);
  }
}

// An index that is the same everywhere is no medium, with objects inside and outside.
TEST(Mirage, NothingBendsIsTheStraightPicture)
{
  const Grid air = MakeBlock(5, ConstantField(1.3));
  for (const glm::dvec3& middle :
    { glm::dvec3(0.1, 0.2, 0.1), glm::dvec3(0.1, 0.0, -2.5), glm::dvec3(0.2, 0.1, 0.9) })
  {
    Filter filter = MakeFilter(air, MakeSphere(middle, 0.6));
    filter->SetCamera(MakeCamera({ 0.2, 0.1, 5.0 }, { 0, 0, 0 }, 0.2));
    filter->Update();
    Filter straight = MakeFilter(air, MakeSphere(middle, 0.6));
    straight->SetCamera(filter->GetCamera());
    straight->BendRaysOff();
    straight->Update();
    // Directions and depths are stored in single precision.
    ExpectSame(filter, straight, 1.0e-6);
    EXPECT_GT(straight->GetStatistic("NumberOfObjectPixels"), 100);
    for (vtkIdType pixel = 0; pixel < Size * Size; ++pixel)
    {
      if (ValueAt(straight, "Seen", pixel) > 0.0)
      {
        const glm::dvec3 place = VectorAt(straight, "Position", pixel);
        const glm::dvec3 way = glm::normalize(place - glm::dvec3(0.2, 0.1, 5.0));
        EXPECT_NEAR(glm::distance(way, VectorAt(straight, "Direction", pixel)), 0.0, 1.0e-6);
        EXPECT_LT(glm::distance(place, middle), 0.6 + 1.0e-9);
      }
    }
  }
}

// Luneburg's lens, n^2 = 2 - r^2, brings parallel rays to one place of its surface: a small disc
// there fills the whole lens.
TEST(Mirage, LuneburgsLensShowsOnePlace)
{
  const Grid lens = MakeBlock(16,
    [](double x, double y, double z)
    {
      const glm::dvec3 p(x, y, z);
      const double r = std::max(std::abs(x), std::max(std::abs(y), std::abs(z)));
      return std::sqrt(std::max(1.0, 2.0 - r * r));
    });
  MapPoints(lens,
    [](const glm::dvec3& p)
    {
      const double length = glm::length(p);
      const glm::dvec3 size = glm::abs(p);
      return length > 0.0 ? std::max(size.x, std::max(size.y, size.z)) / length * p : p;
    });
  Filter filter = MakeFilter(lens, MakePlane(-1.0, 0.05));
  filter->Update();
  int inside = 0;
  int shown = 0;
  for (vtkIdType pixel = 0; pixel < Size * Size; ++pixel)
  {
    const double x = 2.0 * ((pixel % Size) + 0.5) / Size - 1.0;
    const double y = 2.0 * ((pixel / Size) + 0.5) / Size - 1.0;
    if (x * x + y * y < 0.81)
    {
      ++inside;
      shown += ValueAt(filter, "Seen", pixel) > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 900);
  EXPECT_EQ(shown, inside);
}

TEST(Mirage, ColoursAndCellsAreThoseOfTheObject)
{
  const Grid air = MakeBlock(3, ConstantField(1.0));
  const Object wall = MakePlane(0.3, 1.0);
  wall->GetCellData()->SetScalars(MakeArray<vtkUnsignedCharArray>(nullptr, wall->GetNumberOfCells(),
    [&](vtkIdType cell) { return glm::dvec3(7.0 * cell, 100.0, 255.0 - cell); }));
  Filter filter = MakeFilter(air, wall);
  filter->SetAmbient(1.0);
  filter->SetBackgroundColor(1.0, 0.5, 0.0);
  filter->Update();
  for (vtkIdType pixel = 0; pixel < Size * Size; ++pixel)
  {
    // Seven by five rectangles over the whole image.
    const auto column = static_cast<vtkIdType>((pixel % Size + 0.5) / Size * 7.0);
    const auto row = static_cast<vtkIdType>((pixel / Size + 0.5) / Size * 5.0);
    const vtkIdType cell = 7 * row + column;
    ASSERT_EQ(ValueAt(filter, "CellId", pixel), cell);
    EXPECT_EQ(VectorAt(filter, "Color", pixel), glm::dvec3(7.0 * cell, 100.0, 255.0 - cell));
  }
  // Light from the side: 60 degrees from the normal.
  wall->GetCellData()->SetScalars(nullptr);
  filter->SetAmbient(0.2);
  filter->SetLightDirection(std::sqrt(3.0), 0.0, -1.0);
  filter->Update();
  EXPECT_EQ(ValueAt(filter, "Color", 5), std::floor(255.0 * (0.2 + 0.8 * 0.5) + 0.5));
  // From behind.
  filter->SetLightDirection(0.0, 0.0, 1.0);
  filter->Update();
  EXPECT_EQ(ValueAt(filter, "Color", 5), 51.0);
  // Scalars of points, mapped: the lookup table's ends at both sides.
  wall->GetPointData()->SetScalars(
    MakeArray<vtkUnsignedCharArray>(nullptr, wall->GetNumberOfPoints(),
      [&](vtkIdType point)
      {
        const double tone = 127.5 + 127.5 * wall->GetPoint(point)[0];
        return glm::dvec3(tone, tone, tone);
      }));
  filter->SetAmbient(1.0);
  filter->Update();
  EXPECT_NEAR(ValueAt(filter, "Color", 0), 127.5 + 127.5 * (1.0 / Size - 1.0), 1.5);
  EXPECT_NEAR(ValueAt(filter, "Color", 30), 127.5 + 127.5 * (61.0 / Size - 1.0), 1.5);
}

TEST(Mirage, ThreadsDoNotMatter)
{
  ExpectSameOnThreads(
    []
    {
      Filter filter = MakeFilter(MakeBlock(6,
                                   [](double x, double y, double z) {
                                     return 1.3 + 0.2 * std::sin(3.0 * x + y) * std::cos(4.0 * z);
                                   }),
        MakeSphere({ 0.1, 0.2, -0.3 }, 0.5));
      filter->SetDirection(0.3, -0.4, -1.0);
      filter->Update();
      return ValuesOf(filter->GetOutput()->GetPointData());
    });
}

TEST(Mirage, EyesMayBeAnywhere)
{
  // In the mesh, and in a closed object in it: its back is seen everywhere.
  Filter filter = MakeFilter(MakeAir(), MakeSphere({ 0, 0, 0 }, 0.8));
  filter->SetCamera(MakeCamera({ 0.1, 0.0, 0.2 }, { 1, 2, 3 }, 0.7));
  filter->Update();
  EXPECT_EQ(filter->GetStatistic("NumberOfObjectPixels"), Size * Size);
  EXPECT_EQ(filter->GetStatistic("NumberOfBackPixels"), Size * Size);
  // In the mesh, before the object.
  filter->SetCamera(MakeCamera({ 0.0, 0.0, 3.0 }, { 0, 0, 0 }, 0.2));
  filter->Update();
  EXPECT_GT(filter->GetStatistic("NumberOfObjectPixels"), Size);
  EXPECT_EQ(filter->GetStatistic("NumberOfBackPixels"), 0);
}

TEST(Mirage, OddObjectsAreWarnings)
{
  const Grid air = MakeBlock(3, ConstantField(1.2));
  vtkNew<vtkPolyData> nothing;
  const Object broken = MakePlane(0.0, 0.7);
  broken->GetPoints()->SetPoint(9, NaN, 0.0, 0.0);
  const std::pair<vtkPolyData*, const char*> cases[] = { { nothing, "no polygons" },
    { broken, "not finite" } };
  for (const auto& one : cases)
  {
    Filter filter = MakeFilter(air, one.first);
    const auto observer = ObserveErrors(filter);
    filter->Update();
    EXPECT_EQ(observer->Errors.size(), 0u);
    ASSERT_EQ(observer->Warnings.size(), 1u) << one.second;
    EXPECT_TRUE(HasText(observer->Warnings[0], one.second));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), Size * Size);
    // Four of 35 rectangles have the point.
    EXPECT_EQ(filter->GetStatistic("NumberOfBrokenCells"), one.first == nothing ? 0 : 4);
    EXPECT_EQ(filter->GetStatistic("NumberOfObjectPixels") > 0.0, one.first != nothing);
  }
}

TEST(Mirage, RaysThatStayAreStoppedWithAWarning)
{
  Filter filter = MakeFilter(MakeBlock(2, ConstantField(3.0)), MakeSphere({ 0, 0, 0 }, 5.0));
  filter->SetCamera(MakeCamera({ 0.1, 0.15, 0.3 }, { 1.1, 1.25, -0.9 }, 0.02));
  filter->SetImageSize(2, 2);
  filter->SetOutsideIndex(1.0);
  const auto observer = ObserveErrors(filter);
  filter->Update();
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(observer->Warnings[0], "4 rays were stopped"));
  EXPECT_EQ(filter->GetStatistic("NumberOfStoppedRays"), 4);
  EXPECT_EQ(filter->GetStatistic("NumberOfRaysStoppedInFolds"), 0);
  EXPECT_EQ(ValueAt(filter, "Seen", 2), vtkTetrahedraMirage::STOPPED);
}

TEST(Mirage, BadInputIsAnError)
{
  const Object sphere = MakeSphere({ 0, 0, 0 }, 0.5);
  vtkNew<vtkUnstructuredGrid> nothing;
  Filter filters[4] = { MakeFilter(nothing, sphere),
    MakeFilter(MakeBlock(2, ConstantField(0.0)), sphere),
    MakeFilter(MakeBlock(2, ConstantField(1.0)), sphere),
    MakeFilter(MakeBlock(2, ConstantField(1.0)), sphere) };
  filters[2]->SetImageSize(3, 0);
  filters[3]->SetLightDirection(NaN, 0.0, 1.0);
  for (const Filter& filter : filters)
  {
    ExpectError(filter, "");
  }
}

// Where a point of the road's side is seen, the picture shows that point.
TEST(ApparentGeometry, PointsAreWhereThePictureShowsThem)
{
  const Grid air = MakeAir();
  const Object wall = MakePlane(-30.0, 0.5);
  auto apparent = MakeApparent(air, wall);
  apparent->SetEyePosition(0.0, 0.0, Eye);
  apparent->SetSearchAngle(0.5);
  apparent->SetSearchResolution(16);
  const auto observer = ObserveErrors(apparent);
  apparent->Update();
  EXPECT_EQ(observer->Warnings.size() + observer->Errors.size(), 0u) << observer->GetText();
  EXPECT_EQ(apparent->GetStatistic("NumberOfPointsWithOneImage"), wall->GetNumberOfPoints());
  vtkDataSet* seen = vtkDataSet::SafeDownCast(apparent->GetOutput());
  ASSERT_EQ(seen->GetNumberOfCells(), wall->GetNumberOfCells());
  const glm::dvec3 eye(0.0, 0.0, Eye);
  double largest = 0.0;
  for (vtkIdType point = 0; point < wall->GetNumberOfPoints(); ++point)
  {
    const glm::dvec3 there = glm::make_vec3(wall->GetPoint(point));
    const glm::dvec3 image = glm::make_vec3(seen->GetPoint(point));
    EXPECT_NEAR(glm::distance(image, eye), glm::distance(there, eye), 1.0e-9);
    EXPECT_NEAR(glm::distance(FollowParabola(image - eye, there.z), there), 0.0, 2.0e-7);
    largest = std::max(largest, glm::distance(image, there));
    EXPECT_EQ(seen->GetPointData()->GetArray("NumberOfImages")->GetComponent(point, 0), 1.0);
    EXPECT_EQ(seen->GetPointData()->GetArray("ImageOrientation")->GetComponent(point, 0), 1.0);
    // One ray of the picture goes there.
    Filter picture = MakeFilter(air, wall);
    picture->SetCamera(MakeCamera(eye, image, 1.0e-3));
    picture->SetImageSize(1, 1);
    picture->Update();
    const glm::dvec3 found = VectorAt(picture, "Position", 0);
    EXPECT_TRUE(std::abs(there.x) > 0.499 || std::abs(there.y) > 0.499 ||
      glm::distance(found, there) < 2.0e-7)
      << point;
  }
  EXPECT_GT(largest, 0.05);
}

TEST(ApparentGeometry, PointsWithoutOneImageAreMarkedAndTold)
{
  // A stone's way (see ApparentPlaces): nothing below a parabola is seen.
  const Grid air = MakeBlock(6, [](double, double y, double) { return std::sqrt(1.0 + 0.9 * y); });
  vtkNew<vtkPolyData> object;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(0.1, -0.95, -0.95);
  points->InsertNextPoint(0.1, 0.3, -0.95);
  points->InsertNextPoint(NaN, 0.3, -0.95);
  object->SetPoints(points);
  auto apparent = MakeApparent(air, object);
  apparent->SetEyePosition(0.0, 0.0, 0.95);
  apparent->SetSearchAngle(35.0);
  const auto observer = ObserveErrors(apparent);
  apparent->Update();
  // One warning tells of an index below 1, in the lower half.
  ASSERT_EQ(observer->Warnings.size(), 2u);
  EXPECT_TRUE(HasText(observer->Warnings[1], "2 points have no image"));
  EXPECT_EQ(apparent->GetStatistic("NumberOfPointsWithoutImage"), 2);
  vtkDataSet* seen = vtkDataSet::SafeDownCast(apparent->GetOutput());
  EXPECT_EQ(seen->GetPoint(0)[1], -0.95);
  EXPECT_NE(seen->GetPoint(1)[1], 0.3);
}

TEST(ApparentGeometry, BadInputIsAnError)
{
  const Object sphere = MakeSphere({ 0, 0, -3 }, 0.5);
  vtkNew<vtkUnstructuredGrid> nothing;
  vtkSmartPointer<vtkApparentGeometryFilter> filters[3] = { MakeApparent(nothing, sphere),
    MakeApparent(MakeBlock(2, ConstantField(1.0)), sphere),
    MakeApparent(MakeBlock(2, ConstantField(1.0)), sphere) };
  filters[1]->SetEyePosition(0.0, NaN, 1.0);
  filters[2]->SetSearchAngle(90.0);
  for (const auto& filter : filters)
  {
    ExpectError(filter, "");
  }
  // Nothing to move is no error.
  vtkNew<vtkPolyData> empty;
  auto filter = MakeApparent(MakeBlock(2, ConstantField(1.0)), empty);
  filter->Update();
  EXPECT_EQ(vtkDataSet::SafeDownCast(filter->GetOutput())->GetNumberOfPoints(), 0);
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// ALL_IMAGES in a pipeline: arrays at new points, and images without cracks.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;
using meniscus::reference::HeightField;

const double Pi = std::acos(-1.0);

struct PiecesCase
{
  const char* Name;
  HeightField Field;
  int Cells;
  glm::dvec3 Eye;
};

const PiecesCase Cases[] = {
  { "plane", { HeightField::Shape::Waves, 200.0, 0.0, 0.03 * Pi, 1.0, 1.333 }, 8,
    { 20.0, 130.0, 10.0 } },
  { "waves", { HeightField::Shape::Waves, 200.0, 4.0, 0.03 * Pi, 1.0, 1.333 }, 48,
    { 20.0, 300.0, 10.0 } },
  { "dome", { HeightField::Shape::Dome, 200.0, 25.0, 0.02, 1.0, 1.5 }, 32, { 5.0, 250.0, 90.0 } },
  { "hollow", { HeightField::Shape::Dome, 200.0, -20.0, 0.02, 1.0, 1.5 }, 32,
    { 5.0, 250.0, 30.0 } },
  { "waves from below", { HeightField::Shape::Waves, 200.0, 3.0, 0.03 * Pi, 1.333, 1.0 }, 48,
    { 20.0, 200.0, 10.0 } },
};

vtkSmartPointer<vtkRefractedGeometryFilter> MakePieces(const PiecesCase& test, vtkPolyData* data)
{
  auto filter = MakeAllImages(data, MakeMembrane(test.Field.MakeMesh(test.Cells)));
  filter->SetEyePosition(test.Eye.x, test.Eye.y, test.Eye.z);
  filter->SetExteriorIndexOfRefraction(test.Field.Exterior);
  filter->SetInteriorIndexOfRefraction(test.Field.Interior);
  return filter;
}

class RefractedGeometryPieces : public ::testing::TestWithParam<PiecesCase>
{
};

// An array of ones stays one; texture coordinates are those of the true position, which is on the
// floor at the end of the refracted path; and no piece extends beyond its tile.
TEST_P(RefractedGeometryPieces, ArraysAreThoseOfTheTruePosition)
{
  const PiecesCase& test = GetParam();
  constexpr double side = 120.0;
  constexpr int count = 9;
  const double depth = -90.0;
  const auto floor = MakeGrid(count, side, depth);
  AddTruth(floor);
  const vtkIdType points = floor->GetNumberOfPoints();
  floor->GetPointData()->AddArray(MakeArray("Ones", points, 1.0));
  floor->GetPointData()->SetTCoords(MakeArray("Texture", points,
    [&](vtkIdType i)
    {
      const double* p = floor->GetPoint(i);
      return glm::dvec2(p[0] / side + 0.5, p[2] / side + 0.5);
    }));
  const auto filter = MakePieces(test, floor);
  filter->Update();
  vtkPointData* output = filter->GetOutput()->GetPointData();
  ASSERT_GE(filter->GetOutput()->GetNumberOfPoints(), count * count);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double worstOne = 0.0;
  double worstTexture = 0.0;
  double worstPath = 0.0;
  double worstFloor = 0.0;
  double farthest = 0.0;
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
  {
    double at[2];
    const glm::dvec3 truth = TupleOf(output->GetArray("Truth"), i);
    const glm::dvec3 sight = TupleOf(output->GetArray("SightPoint"), i);
    output->GetTCoords()->GetTuple(i, at);
    const glm::dvec3 place(truth[0], truth[1], truth[2]);
    const glm::dvec3 from(sight[0], sight[1], sight[2]);
    worstOne = std::max(worstOne, std::fabs(output->GetArray("Ones")->GetTuple1(i) - 1.0));
    worstTexture = std::max({ worstTexture, std::fabs(at[0] - (place.x / side + 0.5)),
      std::fabs(at[1] - (place.z / side + 0.5)) });
    worstFloor = std::max(worstFloor, std::fabs(place.y - depth));
    worstPath = std::max(worstPath,
      std::fabs(glm::length(place - from) - output->GetArray("RefractionDepth")->GetTuple1(i)));
    farthest = std::max({ farthest, std::fabs(place.x), std::fabs(place.z) });
  }
  // Three products and their sum.
  EXPECT_LE(worstOne, 4.0 * epsilon);
  EXPECT_LE(worstTexture, 8.0 * epsilon);
  EXPECT_LE(worstFloor, 4.0 * epsilon * std::fabs(depth));
  EXPECT_LE(farthest, 0.5 * side * (1.0 + 4.0 * epsilon));
  EXPECT_LE(worstPath, 1e-9);
}

// Arrays of floats and doubles are interpolated here, and by VTK if there are others. The results
// are the same to the last bit.
TEST(RefractedGeometryPieceArrays, AreThoseOfVTK)
{
  const auto floor = MakeGrid(5, 120.0, -90.0);
  const vtkIdType points = floor->GetNumberOfPoints();
  vtkPointData* input = floor->GetPointData();
  const auto value = [](vtkIdType i) { return std::sin(0.7 * static_cast<double>(i)); };
  input->AddArray(MakeArray("Double", points, value));
  input->AddArray(MakeArray<vtkFloatArray>("Float", points, value));
  const auto first = MakePieces(Cases[1], floor);
  first->Update();
  input->AddArray(MakeArray<vtkIntArray>("Whole", points, [](vtkIdType i) { return i; }));
  const auto second = MakePieces(Cases[1], floor);
  second->Update();
  vtkPolyData* own = first->GetOutput();
  vtkPolyData* byVTK = second->GetOutput();
  ASSERT_TRUE(byVTK->GetPointData()->HasArray("Whole"));
  ASSERT_GT(byVTK->GetNumberOfPoints(), points);
  ASSERT_EQ(byVTK->GetNumberOfPoints(), own->GetNumberOfPoints());
  for (const char* const name : { "Double", "Float" })
  {
    ASSERT_EQ(ValuesOf(own->GetPointData()->GetArray(name)),
      ValuesOf(byVTK->GetPointData()->GetArray(name)));
  }
}

// Triangles of a torus about the y axis.
vtkSmartPointer<vtkPolyData> MakeRing(const glm::dvec3& center, double radius, double thickness)
{
  constexpr int around = 48;
  constexpr int across = 18;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const auto& [j, i] : Product(across, around))
  {
    const double u = 2.0 * Pi * i / around;
    const double v = 2.0 * Pi * j / across;
    const double reach = radius + thickness * std::cos(v);
    points->InsertNextPoint(center.x + reach * std::cos(u), center.y + thickness * std::sin(v),
      center.z + reach * std::sin(u));
    const vtkIdType a = j * around + i;
    const vtkIdType b = j * around + (i + 1) % around;
    const vtkIdType c = (j + 1) % across * around + (i + 1) % around;
    const vtkIdType d = (j + 1) % across * around + i;
    cells->InsertNextCell({ a, b, c });
    cells->InsertNextCell({ a, c, d });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

// Largest violation of Snell's law by a point of the pieces behind a level plane.
double GetLargestResidual(const PiecesCase& test, vtkPolyData* pieces)
{
  double worst = 0.0;
  for (vtkIdType i = 0; i < pieces->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 place = TupleOf(pieces->GetPointData()->GetArray("Truth"), i);
    const glm::dvec3 from = TupleOf(pieces->GetPointData()->GetArray("SightPoint"), i);
    const glm::dvec3 law = test.Field.Exterior * glm::normalize(from - test.Eye) -
      test.Field.Interior * glm::normalize(place - from);
    worst = std::max(worst, std::hypot(law.x, law.z));
  }
  return worst;
}

// A plane shows at most one image of a point, so every point of every piece obeys Snell's law, also
// at a silhouette and near total reflection. Sub-cells are exact at their corners and points
// between them are solved to rounding; 1e-6 is far above that, and a thousandth of a pixel.
TEST(RefractedGeometryPiecesBehindPlanes, ObeySnellsLaw)
{
  const PiecesCase planes[] = {
    { "from above", { HeightField::Shape::Waves, 800.0, 0.0, 0.03 * Pi, 1.0, 1.333 }, 8,
      { 2.0, 20.0, -3.0 } },
    { "from below", { HeightField::Shape::Waves, 800.0, 0.0, 0.03 * Pi, 1.333, 1.0 }, 8,
      { 2.0, 20.0, -3.0 } },
  };
  for (const PiecesCase& test : planes)
  {
    for (int i = 0; i < 12; ++i)
    {
      SCOPED_TRACE(test.Name + (" " + std::to_string(i)));
      // Around the eye, nearer and farther, lower and higher.
      const double away = 11.0 + i;
      const auto ring =
        MakeRing({ 2.0 + away * std::cos(5.2 + i), -9.0 + i % 4, -3.0 + away * std::sin(5.2 + i) },
          8.0, 2.5);
      AddTruth(ring);
      const auto filter = MakePieces(test, ring);
      filter->SetAngularTolerance(0.001);
      filter->Update();
      ASSERT_GT(filter->GetOutput()->GetNumberOfPoints(), 500);
      EXPECT_LT(GetLargestResidual(test, filter->GetOutput()), 1e-6);
    }
  }
}

// An empty pixel between pixels that show the ball, at most two away on either side.
TEST_P(RefractedGeometryPieces, NoPixelShowsThroughABall)
{
  const PiecesCase& test = GetParam();
  vtkNew<vtkSphereSource> source;
  source->SetCenter(3.0, -85.0, 2.0);
  source->SetRadius(45.0);
  source->SetThetaResolution(60);
  source->SetPhiResolution(40);
  source->Update();
  vtkNew<vtkPolyData> ball;
  ball->DeepCopy(source->GetOutput());
  AddPlaces(ball);
  const auto filter = MakePieces(test, ball);
  filter->Update();
  constexpr int pixels = 700;
  const PixelCamera camera(test.Eye, { 3.0, -30.0, 2.0 }, 0.2, pixels);
  const PlacePicture picture = DrawPlaces(filter->GetOutput(), camera);
  const auto covers = [&picture](int x, int y)
  { return picture[static_cast<std::size_t>(y * pixels + x)].Covered; };
  int covered = 0;
  int cracks = 0;
  for (int y = 2; y + 2 < pixels; ++y)
  {
    for (int x = 2; x + 2 < pixels; ++x)
    {
      covered += covers(x, y);
      cracks += !covers(x, y) && (covers(x - 1, y) || covers(x - 2, y)) &&
        (covers(x + 1, y) || covers(x + 2, y)) && (covers(x, y - 1) || covers(x, y - 2)) &&
        (covers(x, y + 1) || covers(x, y + 2));
    }
  }
  EXPECT_GT(covered, pixels * pixels / 40);
  EXPECT_EQ(cracks, 0) << covered << " pixels show the ball";
}

INSTANTIATE_TEST_SUITE_P(Membranes, RefractedGeometryPieces, ::testing::ValuesIn(Cases));

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Balls and lenses: the filter's virtual points and pictures against rays that are traced in double
// precision through the analytic spheres and planes. Writes the figure of the page on stacks.
#include "BoardScene.h"
#include "RandomNumbers.h"
#include "StackPicture.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;
using meniscus::test::RandomNumbers;

constexpr int Pixels = 512;

// An optical system in front of a horizontal square.
struct LensScene
{
  StackPicture View;
  std::vector<ExactSurface> Passed; // in front of the square
  meniscus::test::Outline Outline;
  double Depth; // the square is at y = -Depth
  double Size;
  double Farthest; // length of the last legs to points
};

constexpr double Glass = 1.52;

PixelCamera MakeCamera(const glm::dvec3& eye, double halfTangent)
{
  return { eye, glm::dvec3(0.0), halfTangent, Pixels };
}

// With `isInside` the square is in the ball.
LensScene MakeBall(const std::string& name, bool isInside, double depth, double size)
{
  constexpr double radius = 40.0;
  const auto mesh = MakeSphere(glm::dvec3(0.0), radius, 4, true); // 5,120 facets
  std::vector<ExactSurface> passed{ { 1.0, Glass, glm::dvec3(0.0), radius } };
  if (!isInside)
  {
    passed.push_back({ Glass, 1.0, glm::dvec3(0.0), radius, glm::dvec3(0.0), true });
  }
  return { { name, { mesh, mesh }, { { 1.0, Glass }, { 1.0, Glass } },
             MakeCamera({ 4.0, 200.0, -3.0 }, 0.23) },
    passed, MakeRoundOutline(2.0 * radius), depth, size, 20.0 };
}

// Convex above, with its vertex at y = 8; below a sphere of `radius`, or a plane if it is 0,
// through y = -8. 5,000 facets each.
LensScene MakeLens(const std::string& name, double radius, double depth, double size)
{
  constexpr double side = 40.0;
  const glm::dvec3 up(0.0, 1.0, 0.0);
  const glm::dvec3 first(0.0, 8.0 - 60.0, 0.0);
  const glm::dvec3 second(0.0, radius - 8.0, 0.0);
  const ExactSurface in{ 1.0, Glass, first, 60.0 };
  const ExactSurface out = radius > 0.0
    ? ExactSurface{ Glass, 1.0, second, radius, glm::dvec3(0.0), true }
    : ExactSurface{ Glass, 1.0, { 0.0, -8.0, 0.0 }, 0.0, up };
  return {
    { name,
      { MakeCap(first, 60.0, up, up, side, 50),
        radius > 0.0 ? MakeCap(second, radius, -up, up, side, 50) : MakePlane(-8.0, side, 50) },
      { { 1.0, Glass }, { Glass, 1.0 } }, MakeCamera({ 2.0, 150.0, 1.0 }, 0.16) },
    { in, out }, MakeSquareOutline(side), depth, size, 30.0
  };
}

std::vector<LensScene> GetScenes()
{
  constexpr double radius = 40.0;
  // The focus is about 86 behind the centre. Near it, the ball magnifies the error of linear
  // interpolation, too: the default tolerance, a tenth of a pixel, is visible.
  LensScene focus = MakeBall("ball lens near its focus", false, 75.0, 30.0);
  focus.View.Tolerance = 0.0005;
  return { MakeBall("aplanatic ball", true, radius / Glass, 40.0),
    MakeBall("ball lens", false, 58.0, 30.0), focus, MakeLens("biconvex lens", 80.0, 55.0, 30.0),
    MakeLens("plano-convex lens", 0.0, 75.0, 36.0) };
}

}

//------------------------------------------------------------------------------
// All images of a square, zones of caustics included.
TEST(StackPictures, BallsAndLensesAgreeWithTracedRays)
{
  const std::vector<LensScene> scenes = GetScenes();
  ComparisonSheet sheet = MakeSceneSheet(scenes.size(), Pixels / 2);
  for (std::size_t i = 0; i < scenes.size(); ++i)
  {
    const LensScene& scene = scenes[i];
    const PixelCamera& camera = scene.View.Camera;
    const auto object = MakeGrid(13, scene.Size, -scene.Depth);
    AddPlaces(object);
    const PlacePicture traced =
      TraceRays(camera, MakeExactRays(scene.Passed, camera.GetEye(), scene.Outline),
        MakeSquareTracer(-scene.Depth, scene.Size));
    const Board board = MakeBoard(-scene.Depth, scene.Size);
    ExpectSameView(sheet, static_cast<int>(i), scene.View, object, traced,
      [&board](const glm::dvec3& place) { return board.GetColour(place); });
  }
  sheet.Write(MENISCUS_TEMPORARY_DIR "/lens-comparison.png");
}

//------------------------------------------------------------------------------
// Points on exact rays. A point behind the ball may have several images; whichever is found, the
// exact path of its sight ray leads to the point, and gives its virtual point.
TEST(StackPictures, VirtualPointsOfBallsAndLensesAreExact)
{
  RandomNumbers random(31);
  for (const LensScene& scene : GetScenes())
  {
    const PixelCamera& camera = scene.View.Camera;
    const std::vector<ExactSurface>& passed = scene.Passed;
    std::vector<Point> points;
    while (points.size() < 2000)
    {
      const glm::dvec3 ray =
        glm::normalize(camera.GetForward() + random.Uniform(-0.95, 0.95) * camera.GetRight() +
          random.Uniform(-0.95, 0.95) * camera.GetUp());
      const auto path = TraceWithin(passed, scene.Outline, camera.GetEye(), ray);
      if (path)
      {
        const auto image = MakeImage(passed, *path, random.Uniform(0.5, scene.Farthest));
        points.push_back({ image.Point.x, image.Point.y, image.Point.z });
      }
    }
    const auto filter = scene.View.MakeFilter(MakePoints(points), false);
    filter->Update();
    vtkPolyData* seen = filter->GetOutput();
    ASSERT_EQ(seen->GetNumberOfPoints(), static_cast<vtkIdType>(points.size()));
    EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 0);
    double farthest = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto id = static_cast<vtkIdType>(i);
      const glm::dvec3 point(points[i][0], points[i][1], points[i][2]);
      glm::dvec3 position(0.0);
      glm::dvec3 sight(0.0);
      seen->GetPoint(id, &position.x);
      seen->GetPointData()->GetArray("SightPoint")->GetTuple(id, &sight.x);
      const auto path = TraceExactly(passed, camera.GetEye(), sight - camera.GetEye());
      ASSERT_TRUE(path) << scene.View.Name;
      const double length = glm::length(point - path->Points.back());
      const auto image = MakeImage(passed, *path, length);
      farthest = std::max(farthest, glm::length(image.Point - point));
      largest = std::max(largest, glm::length(image.Virtual - position));
    }
    std::printf("%s: points within %.1e of the exact ray, virtual points within %.1e\n",
      scene.View.Name.c_str(), farthest, largest);
    EXPECT_LT(farthest, 1e-6) << scene.View.Name;
    EXPECT_LT(largest, 1e-6) << scene.View.Name;
  }
}

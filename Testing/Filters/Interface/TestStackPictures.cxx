// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Balls and lenses: the filter's virtual points and pictures against rays that are traced in double
// precision through the analytic spheres and planes. Writes the figure of the page on stacks.
#include "ExactStack.h"
#include "RandomNumbers.h"
#include "Refraction/Stack/MediaChain.h"
#include "StackFilterHelpers.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace
{

using namespace meniscus::testing;
using meniscus::reference::ExactPath;
using meniscus::reference::ExactSurface;
using meniscus::reference::MakeCap;
using meniscus::reference::MakeImage;
using meniscus::reference::MakePlane;
using meniscus::reference::MakeSphere;
using meniscus::reference::TraceExactly;
using meniscus::test::RandomNumbers;

constexpr int Pixels = 512;

// An optical system in front of a horizontal square.
struct LensScene
{
  std::string Name;
  std::vector<meniscus::reference::MembraneMesh> Meshes; // one per interface
  std::vector<meniscus::InterfaceMedia> Media;
  std::vector<ExactSurface> Exact;
  std::size_t Passed; // interfaces in front of the square
  double Outline;     // side of the square outline of caps and planes
  glm::dvec3 Eye;
  double HalfTangent;
  double Depth; // the square is at y = -Depth
  double Size;
  double Farthest;          // length of the last legs to points
  double Tolerance = 0.005; // default of the filter

  PixelCamera GetCamera() const
  {
    return { this->Eye, { 0.0, 0.0, 0.0 }, this->HalfTangent, Pixels };
  }
};

constexpr double Glass = 1.52;

LensScene MakeBall(const std::string& name, std::size_t passed, double depth, double size)
{
  constexpr double radius = 40.0;
  const auto mesh = MakeSphere(glm::dvec3(0.0), radius, 4, true); // 5,120 facets
  const ExactSurface in{ 1.0, Glass, glm::dvec3(0.0), radius };
  const ExactSurface out{ Glass, 1.0, glm::dvec3(0.0), radius, glm::dvec3(0.0), true };
  return { name, { mesh, mesh }, { { 1.0, Glass }, { 1.0, Glass } }, { in, out }, passed, 1e9,
    { 4.0, 200.0, -3.0 }, 0.23, depth, size, 20.0 };
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
  return { name,
    { MakeCap(first, 60.0, up, up, side, 50),
      radius > 0.0 ? MakeCap(second, radius, -up, up, side, 50) : MakePlane(-8.0, side, 50) },
    { { 1.0, Glass }, { Glass, 1.0 } }, { in, out }, 2, side, { 2.0, 150.0, 1.0 }, 0.16, depth,
    size, 30.0 };
}

std::vector<LensScene> GetScenes()
{
  constexpr double radius = 40.0;
  // The focus is about 86 behind the centre. Near it, the ball magnifies the error of linear
  // interpolation, too: the default tolerance, a tenth of a pixel, is visible.
  LensScene focus = MakeBall("ball lens near its focus", 2, 75.0, 30.0);
  focus.Tolerance = 0.0005;
  return { MakeBall("aplanatic ball", 1, radius / Glass, 40.0),
    MakeBall("ball lens", 2, 58.0, 30.0), focus, MakeLens("biconvex lens", 80.0, 55.0, 30.0),
    MakeLens("plano-convex lens", 0.0, 75.0, 36.0) };
}

vtkSmartPointer<vtkRefractedGeometryFilter> MakeSceneFilter(
  const LensScene& scene, vtkPolyData* object, bool all)
{
  auto filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  filter->SetInputData(object);
  filter->SetMembraneModelToCurved();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetEyePosition(scene.Eye.x, scene.Eye.y, scene.Eye.z);
  filter->SetImages(
    all ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
  filter->SetAngularTolerance(scene.Tolerance);
  filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  // Interfaces of one closed body share its data set.
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  for (std::size_t i = 0; i < scene.Meshes.size(); ++i)
  {
    const bool shared = i > 0 && scene.Meshes[i].Points == scene.Meshes[i - 1].Points;
    surfaces.push_back(shared ? surfaces.back() : MakeMembrane(scene.Meshes[i]));
    AddInterface(filter.Get(), surfaces.back(), scene.Media[i].Exterior, scene.Media[i].Interior);
  }
  return filter;
}

// The path of a sight ray to the object: through the interfaces in front of it and inside of their
// outlines.
std::optional<ExactPath> TraceScene(const LensScene& scene, const glm::dvec3& direction)
{
  const std::vector<ExactSurface> passed(
    scene.Exact.begin(), scene.Exact.begin() + static_cast<std::ptrdiff_t>(scene.Passed));
  auto path = TraceExactly(passed, scene.Eye, direction);
  if (path)
  {
    for (const glm::dvec3& point : path->Points)
    {
      if (std::max(std::fabs(point.x), std::fabs(point.z)) > 0.5 * scene.Outline)
      {
        return std::nullopt;
      }
    }
  }
  return path;
}

PlacePicture TraceSquare(const LensScene& scene, const PixelCamera& camera)
{
  const auto square = MakeSquareTracer(-scene.Depth, scene.Size);
  PlacePicture picture(static_cast<std::size_t>(Pixels) * Pixels);
  for (int y = 0; y < Pixels; ++y)
  {
    for (int x = 0; x < Pixels; ++x)
    {
      const auto path = TraceScene(scene, camera.GetRay(x, y));
      if (path)
      {
        picture[static_cast<std::size_t>(y * Pixels + x)] =
          square(path->Points.back(), path->Directions.back());
      }
    }
  }
  return picture;
}

//------------------------------------------------------------------------------
// A board of coloured squares; one row of the figure per scene: the picture, rays, their
// difference.
class Figure
{
public:
  explicit Figure(int rows)
    : Rows(rows)
  {
    this->Image->SetDimensions(3 * Side, rows * Side, 1);
    this->Image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  }

  void SetRow(int row, const LensScene& scene, const PixelCamera& camera, const PlacePicture& drawn,
    const PlacePicture& traced)
  {
    for (int y = 0; y < Side; ++y)
    {
      for (int x = 0; x < Side; ++x)
      {
        std::array<std::array<double, 3>, 3> sums{};
        for (int k = 0; k < Part * Part; ++k)
        {
          const auto i =
            static_cast<std::size_t>((y * Part + k / Part) * Pixels + x * Part + k % Part);
          const auto a = GetColour(scene, drawn[i]);
          const auto b = GetColour(scene, traced[i]);
          const bool differs = drawn[i].Covered != traced[i].Covered ||
            (drawn[i].Covered &&
              glm::length(drawn[i].Place - traced[i].Place) >
                0.5 * GetFootprint(traced, camera, i));
          for (std::size_t c = 0; c < 3; ++c)
          {
            sums[0][c] += a[c];
            sums[1][c] += b[c];
            sums[2][c] += differs ? 0.0 : 255.0;
          }
        }
        for (int column = 0; column < 3; ++column)
        {
          auto* pixel = static_cast<unsigned char*>(
            this->Image->GetScalarPointer(column * Side + x, (this->Rows - 1 - row) * Side + y, 0));
          for (std::size_t c = 0; c < 3; ++c)
          {
            const double mean = sums[static_cast<std::size_t>(column)][c] / (Part * Part);
            pixel[c] = static_cast<unsigned char>(std::lround(mean));
          }
        }
      }
    }
  }

  void Write() const
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(MENISCUS_TEMPORARY_DIR "/lens-comparison.png");
    writer->SetInputData(this->Image);
    writer->Write();
  }

private:
  static constexpr int Part = 2; // pixels along a side of one of the figure's pixels
  static constexpr int Side = Pixels / Part;

  static std::array<double, 3> GetColour(const LensScene& scene, const PlacePixel& pixel)
  {
    if (!pixel.Covered)
    {
      return { 232.0, 236.0, 240.0 };
    }
    const double u = pixel.Place.x / scene.Size + 0.5;
    const double v = pixel.Place.z / scene.Size + 0.5;
    const bool isDark = (static_cast<int>(10.0 * u) + static_cast<int>(10.0 * v)) % 2 == 1;
    const double shade = isDark ? 0.45 : 1.0;
    return { shade * (70.0 + 170.0 * u), shade * 150.0, shade * (70.0 + 170.0 * v) };
  }

  int Rows;
  vtkNew<vtkImageData> Image;
};

}

//------------------------------------------------------------------------------
// All images of a square, zones of caustics included. At most 0.1 % of the covered pixels may show
// another place, by more than half a pixel, or be covered in one of the two pictures only.
TEST(StackPictures, BallsAndLensesAgreeWithTracedRays)
{
  const std::vector<LensScene> scenes = GetScenes();
  Figure figure(static_cast<int>(scenes.size()));
  for (std::size_t i = 0; i < scenes.size(); ++i)
  {
    const LensScene& scene = scenes[i];
    const PixelCamera camera = scene.GetCamera();
    const auto object = MakeGrid(13, scene.Size, -scene.Depth);
    AddPlaces(object);
    const auto filter = MakeSceneFilter(scene, object, true);
    const auto messages = Observe(filter);
    filter->Update();
    EXPECT_EQ(messages->Errors, 0) << messages->Text;
    const PlacePicture drawn = DrawPlaces(filter->GetOutput(), camera);
    const PlacePicture traced = TraceSquare(scene, camera);
    const PlaceComparison compared = ComparePlaces(traced, drawn, camera);
    figure.SetRow(static_cast<int>(i), scene, camera, drawn, traced);
    std::printf("%s: %d pixels, %d differ in coverage, %d in place, %lld cells\n",
      scene.Name.c_str(), compared.Covered, compared.Coverage, compared.Place,
      static_cast<long long>(filter->GetOutput()->GetNumberOfCells()));
    EXPECT_GT(compared.Covered, Pixels * Pixels / 20) << scene.Name;
    EXPECT_LE(compared.Coverage + compared.Place, compared.Covered / 1000) << scene.Name;
  }
  figure.Write();
}

//------------------------------------------------------------------------------
// Points on exact rays. A point behind the ball may have several images; whichever is found, the
// exact path of its sight ray leads to the point, and gives its virtual point.
TEST(StackPictures, VirtualPointsOfBallsAndLensesAreExact)
{
  RandomNumbers random(31);
  for (const LensScene& scene : GetScenes())
  {
    const PixelCamera camera = scene.GetCamera();
    std::vector<Point> points;
    const std::vector<ExactSurface> passed(
      scene.Exact.begin(), scene.Exact.begin() + static_cast<std::ptrdiff_t>(scene.Passed));
    while (points.size() < 2000)
    {
      const glm::dvec3 ray =
        glm::normalize(camera.GetForward() + random.Uniform(-0.95, 0.95) * camera.GetRight() +
          random.Uniform(-0.95, 0.95) * camera.GetUp());
      const auto path = TraceScene(scene, ray);
      if (path)
      {
        const auto image = MakeImage(passed, *path, random.Uniform(0.5, scene.Farthest));
        points.push_back({ image.Point.x, image.Point.y, image.Point.z });
      }
    }
    const auto filter = MakeSceneFilter(scene, MakePoints(points), false);
    filter->Update();
    vtkPolyData* seen = filter->GetOutput();
    ASSERT_EQ(seen->GetNumberOfPoints(), static_cast<vtkIdType>(points.size()));
    EXPECT_EQ(filter->GetNumberOfVerticesWithoutImage(), 0);
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
      const auto path = TraceExactly(passed, scene.Eye, sight - scene.Eye);
      ASSERT_TRUE(path) << scene.Name;
      const double length = glm::length(point - path->Points.back());
      const auto image = MakeImage(passed, *path, length);
      farthest = std::max(farthest, glm::length(image.Point - point));
      largest = std::max(largest, glm::length(image.Virtual - position));
    }
    std::printf("%s: points within %.1e of the exact ray, virtual points within %.1e\n",
      scene.Name.c_str(), farthest, largest);
    EXPECT_LT(farthest, 1e-6) << scene.Name;
    EXPECT_LT(largest, 1e-6) << scene.Name;
  }
}

//------------------------------------------------------------------------------
// A point at R / n from the centre of a ball is seen in the direction of n R on the same radius.
TEST(StackPictures, AplanaticPointsAreSeenFartherOut)
{
  constexpr double radius = 40.0;
  RandomNumbers random(32);
  LensScene scene = MakeBall("aplanatic ball", 1, radius / Glass, 40.0);
  std::vector<Point> points;
  std::vector<glm::dvec3> truth;
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 axis =
      glm::normalize(glm::dvec3(random.Uniform(-0.6, 0.6), -1.0, random.Uniform(-0.6, 0.6)));
    const glm::dvec3 point = (radius / Glass) * axis;
    points.push_back({ point.x, point.y, point.z });
    truth.push_back(radius * Glass * axis);
  }
  const auto filter = MakeSceneFilter(scene, MakePoints(points), false);
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 500);
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    glm::dvec3 p(0.0);
    filter->GetOutput()->GetPoint(static_cast<vtkIdType>(i), &p.x);
    const glm::dvec3 sight = glm::normalize(p - scene.Eye);
    largest = std::max(largest, glm::length(glm::cross(truth[i] - scene.Eye, sight)));
  }
  std::printf("aplanatic points: sight rays within %.1e\n", largest);
  EXPECT_LT(largest, 1e-6);
}

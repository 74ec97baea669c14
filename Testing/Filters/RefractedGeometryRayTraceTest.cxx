// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The filter's output, drawn, against ray tracing the analytic membrane pixel by pixel.
#include "HeightField.h"
#include "RefractedGeometryTestHelpers.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using namespace meniscus::testing;
using meniscus::reference::HeightField;

constexpr int Pixels = 512;

/// A pinhole camera at the eye that looks at a point.
class PixelCamera
{
public:
  PixelCamera(const glm::dvec3& eye, const glm::dvec3& target, double halfTangent)
    : Eye(eye)
    , Forward(glm::normalize(target - eye))
  {
    this->Right = halfTangent * glm::normalize(glm::cross(this->Forward, glm::dvec3(0, 0, 1)));
    this->Up = glm::cross(this->Right, this->Forward);
  }
  glm::dvec3 GetRay(int x, int y) const
  {
    return glm::normalize(this->Forward + (2.0 * (x + 0.5) / Pixels - 1.0) * this->Right +
      (2.0 * (y + 0.5) / Pixels - 1.0) * this->Up);
  }
  // Pixel coordinates and depth along the view.
  glm::dvec3 Project(const glm::dvec3& point) const
  {
    const glm::dvec3 d = point - this->Eye;
    const double depth = glm::dot(d, this->Forward);
    const double scale = 1.0 / (depth * glm::dot(this->Right, this->Right));
    return { 0.5 * Pixels * (1.0 + glm::dot(d, this->Right) * scale),
      0.5 * Pixels * (1.0 + glm::dot(d, this->Up) * scale), depth };
  }

private:
  glm::dvec3 Eye;
  glm::dvec3 Forward;
  glm::dvec3 Right;
  glm::dvec3 Up;
};

/// What a pixel shows of the object: a place, or nothing.
struct Pixel
{
  bool covered = false;
  double depth = std::numeric_limits<double>::max();
  glm::dvec2 place{ 0.0 };
};
using Picture = std::vector<Pixel>;

// Draws the polygons as a fan of triangles, with perspective-correct interpolation of "Place".
Picture Draw(vtkPolyData* data, const PixelCamera& camera)
{
  Picture picture(Pixels * Pixels);
  vtkDataArray* places = data->GetPointData()->GetArray("Place");
  const auto iterator = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    iterator->GetCurrentCell(count, ids);
    for (vtkIdType k = 2; k < count; ++k)
    {
      glm::dvec3 p[3];
      glm::dvec2 t[3];
      for (int i = 0; i < 3; ++i)
      {
        const vtkIdType id = ids[i == 0 ? 0 : k - 2 + i];
        double x[3];
        data->GetPoint(id, x);
        p[i] = camera.Project({ x[0], x[1], x[2] });
        t[i] = glm::dvec2(places->GetComponent(id, 0), places->GetComponent(id, 1));
      }
      const double area =
        (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
      const auto bound = [](double value) { return std::min(std::max(value, 0.0), Pixels - 1.0); };
      const int x0 = static_cast<int>(bound(std::min({ p[0].x, p[1].x, p[2].x }) - 1.0));
      const int x1 = static_cast<int>(bound(std::max({ p[0].x, p[1].x, p[2].x }) + 1.0));
      const int y0 = static_cast<int>(bound(std::min({ p[0].y, p[1].y, p[2].y }) - 1.0));
      const int y1 = static_cast<int>(bound(std::max({ p[0].y, p[1].y, p[2].y }) + 1.0));
      for (int y = y0; y <= y1; ++y)
      {
        for (int x = x0; x <= x1; ++x)
        {
          double w[3];
          for (int i = 0; i < 3; ++i)
          {
            const glm::dvec3& a = p[(i + 1) % 3];
            const glm::dvec3& b = p[(i + 2) % 3];
            w[i] = ((b.x - a.x) * (y + 0.5 - a.y) - (b.y - a.y) * (x + 0.5 - a.x)) / area / p[i].z;
          }
          // Borders belong to both sides; the depth decides and is the same there.
          constexpr double border = -1e-12;
          if (!(w[0] * p[0].z >= border && w[1] * p[1].z >= border && w[2] * p[2].z >= border))
          {
            continue;
          }
          const double sum = w[0] + w[1] + w[2];
          Pixel& pixel = picture[static_cast<std::size_t>(y * Pixels + x)];
          if (1.0 / sum < pixel.depth)
          {
            pixel = { true, 1.0 / sum, (w[0] * t[0] + w[1] * t[1] + w[2] * t[2]) / sum };
          }
        }
      }
    }
  }
  return picture;
}

struct Scene
{
  const char* name;
  HeightField field;
  glm::dvec3 eye;
  int cells;    ///< of the membrane
  double depth; ///< of the object, a horizontal square
  double size;  ///< its side
  int tiles;    ///< quads a side
};

Picture Trace(const Scene& scene, const PixelCamera& camera)
{
  Picture picture(Pixels * Pixels);
  for (int y = 0; y < Pixels; ++y)
  {
    for (int x = 0; x < Pixels; ++x)
    {
      const glm::dvec3 ray = camera.GetRay(x, y);
      const glm::dvec3 s =
        scene.field.Intersect(scene.eye, ray, -scene.eye.y / std::min(ray.y, -1e-3));
      const auto behind = scene.field.Refract(scene.eye, s, 1.0);
      if (!behind || !(std::max(std::fabs(s.x), std::fabs(s.z)) <= 0.5 * scene.field.side) ||
        !(behind->y < s.y))
      {
        continue;
      }
      const glm::dvec3 hit = s + (*behind - s) * ((s.y + scene.depth) / (s.y - behind->y));
      Pixel& pixel = picture[static_cast<std::size_t>(y * Pixels + x)];
      pixel.covered = std::max(std::fabs(hit.x), std::fabs(hit.z)) <= 0.5 * scene.size;
      pixel.place = glm::dvec2(hit.x, hit.z);
    }
  }
  return picture;
}

vtkSmartPointer<vtkPolyData> MakeObject(const Scene& scene)
{
  const auto grid = MakeGrid(scene.tiles + 1, scene.size, -scene.depth);
  vtkNew<vtkDoubleArray> place;
  place->SetName("Place");
  place->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double p[3];
    grid->GetPoint(i, p);
    place->InsertNextTuple2(p[0], p[2]);
  }
  grid->GetPointData()->AddArray(place);
  return grid;
}

const double Pi = std::acos(-1.0);

std::vector<Scene> MakeScenes()
{
  const HeightField dome{ HeightField::Shape::Dome, 200.0, 30.0, 0.025, 1.0, 1.5 };
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 4.0, 0.03 * Pi, 1.0, 1.333 };
  return {
    { "dome, object centred", dome, { 0.0, 500.0, 0.0 }, 64, 120.0, 60.0, 8 },
    { "dome, object aside", dome, { 60.0, 450.0, 30.0 }, 64, 120.0, 80.0, 8 },
    { "dome, near its focus", dome, { 0.0, 500.0, 10.0 }, 64, 75.0, 30.0, 4 },
    { "waves with caustics", waves, { 20.0, 300.0, 10.0 }, 96, 180.0, 120.0, 6 },
    { "waves, one large tile beyond the border", waves, { 20.0, 300.0, 10.0 }, 96, 60.0, 400.0, 1 },
  };
}

class RefractedGeometryRayTrace : public ::testing::TestWithParam<int>
{
};

// An image error, in pixels.
constexpr double AcceptedPixels = 0.5;

// What a pixel covers of the object: the largest step to a neighbour's place. Neighbours off the
// object have places in its plane as well.
double GetFootprint(const Picture& picture, std::size_t i)
{
  double largest = 0.0;
  for (const std::size_t j : { i - 1, i + 1, i - Pixels, i + Pixels })
  {
    if (j < picture.size())
    {
      largest = std::max(largest, glm::length(picture[j].place - picture[i].place));
    }
  }
  return largest;
}

// A pixel differs if only one of the two shows the object there, or if what it shows is more than
// half a pixel away. Printed as well: how many are in another square of a checkerboard with 20
// squares a side, which any shift of its many edges changes.
TEST_P(RefractedGeometryRayTrace, PixelsAgree)
{
  const Scene scene = MakeScenes()[static_cast<std::size_t>(GetParam())];
  const PixelCamera camera(scene.eye, { 0.0, 0.0, 0.0 }, 100.0 / scene.eye.y);
  const auto filter =
    MakeFilter(MakeObject(scene), MakeMembrane(scene.field.MakeMesh(scene.cells)));
  filter->SetMembraneModelToCurved();
  filter->SetImagesToAllImages();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetEyePosition(scene.eye.x, scene.eye.y, scene.eye.z);
  filter->SetExteriorIndexOfRefraction(scene.field.exterior);
  filter->SetInteriorIndexOfRefraction(scene.field.interior);
  const auto messages = Observe(filter);
  filter->Update();
  EXPECT_EQ(messages->errors + messages->warnings, 0) << messages->text;

  const Picture drawn = Draw(filter->GetOutput(), camera);
  const Picture traced = Trace(scene, camera);
  const auto square = [&scene](const glm::dvec2& place)
  {
    const double unit = scene.size / 20.0;
    return static_cast<int>(std::floor(place.x / unit) + std::floor(place.y / unit)) & 1;
  };
  int covered = 0;
  int coverage = 0;
  int place = 0;
  int colour = 0;
  for (std::size_t i = 0; i < traced.size(); ++i)
  {
    covered += traced[i].covered;
    coverage += traced[i].covered != drawn[i].covered;
    if (traced[i].covered && drawn[i].covered)
    {
      const double error = glm::length(traced[i].place - drawn[i].place);
      place += error > AcceptedPixels * GetFootprint(traced, i);
      colour += square(traced[i].place) != square(drawn[i].place);
    }
  }
  std::printf("%s: %d pixels, %d differ in coverage, %d in place, %d in colour, %lld cells\n",
    scene.name, covered, coverage, place, colour,
    static_cast<long long>(filter->GetOutput()->GetNumberOfCells()));
  EXPECT_GT(covered, Pixels * Pixels / 20);
  EXPECT_LE(coverage + place, covered / 1000);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RefractedGeometryRayTrace, ::testing::Range(0, 5));

}

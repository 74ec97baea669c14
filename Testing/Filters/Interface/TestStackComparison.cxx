// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Panes, ports, a cornea and waves: all images of an object next to rays that are traced in double
// precision through the exact surfaces. Writes a figure of the page on stacks.
#include "BoardScene.h"
#include "SchematicEye.h"
#include "StackPicture.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;

constexpr int Pixels = 512;
constexpr double Glass = 1.5;
constexpr double Water = 1.333;
const glm::dvec3 Up(0.0, 1.0, 0.0);
const double Pi = std::acos(-1.0);

// A board with a ring that leans on it.
BoardScene MakeBoardAndRing(double y, double size)
{
  return { MakeBoard(y, size),
    Ring{ { 0.1 * size, y + 0.26 * size, -0.05 * size }, glm::normalize(glm::dvec3(0.5, 0.6, 0.6)),
      0.22 * size, 0.07 * size } };
}

void ExpectScene(ComparisonSheet& sheet, int column, const StackPicture& view,
  const BoardScene& scene, const RayTracer& rays)
{
  const auto object = scene.MakeData();
  ExpectSameView(sheet, column, view, object, TraceRays(view.Camera, rays, MakeMeshTracer(object)),
    [&scene](const glm::dvec3& place) { return scene.GetColour(place); });
}

//------------------------------------------------------------------------------
void ExpectPane(ComparisonSheet& sheet, int column)
{
  constexpr double side = 400.0;
  const StackPicture view{ "air, glass, water",
    { MakePlane(0.0, side, 8), MakePlane(-20.0, side, 8) }, { { 1.0, Glass }, { Glass, Water } },
    { { 60.0, 130.0, -190.0 }, { 0.0, -62.0, 0.0 }, 0.30, Pixels }, 0.005, 5e-5 };
  const std::vector<ExactSurface> exact{ { 1.0, Glass, glm::dvec3(0.0), 0.0, Up },
    { Glass, Water, { 0.0, -20.0, 0.0 }, 0.0, Up } };
  ExpectScene(sheet, column, view, MakeBoardAndRing(-100.0, 120.0),
    MakeExactRays(exact, view.Camera.GetEye(), MakeSquareOutline(side)));
}

// Spheres around `centre`, with air inside and water outside.
void ExpectPort(ComparisonSheet& sheet, int column, const std::string& name, const glm::dvec3& eye,
  const glm::dvec3& centre)
{
  const StackPicture view{ name,
    { MakeSphere(centre, 10.0, 4, true), MakeSphere(centre, 11.0, 4, true) },
    { { Glass, 1.0 }, { Water, Glass } }, { eye, { 8.0, -95.0, 0.0 }, 0.42, Pixels } };
  const std::vector<ExactSurface> exact{ { 1.0, Glass, centre, 10.0, glm::dvec3(0.0), true },
    { Glass, Water, centre, 11.0, glm::dvec3(0.0), true } };
  const BoardScene scene = MakeBoardAndRing(-100.0, 120.0);
  if (eye == centre)
  {
    // No ray is refracted.
    ExpectScene(sheet, column, view, scene,
      [&eye](const glm::dvec3& direction) {
        return LastLeg{ eye, direction };
      });
    return;
  }
  ExpectScene(
    sheet, column, view, scene, MakeExactRays(exact, eye, [](const glm::dvec3&) { return true; }));
}

//------------------------------------------------------------------------------
// An iris with a round pupil, and the white of the eye around it.
glm::dvec3 GetIrisColour(const glm::dvec3& place)
{
  constexpr double pupil = 1.5;
  constexpr double iris = 3.6;
  const double r = std::hypot(place.x, place.z);
  const double angle = std::atan2(place.z, place.x);
  if (r < pupil)
  {
    return glm::dvec3(0.03);
  }
  if (r > iris)
  {
    return { 0.96, 0.94, 0.92 };
  }
  const double fibre =
    0.5 + 0.25 * std::sin(40.0 * angle + 3.0 * std::sin(5.0 * r)) + 0.25 * std::sin(23.0 * angle);
  const double part = (r - pupil) / (iris - pupil);
  const double rim = part > 0.9 ? 0.45 : 1.0;
  return rim * ((1.0 - part) * glm::dvec3(0.75, 0.5, 0.15) + part * glm::dvec3(0.15, 0.5, 0.6)) *
    (0.55 + 0.45 * fibre);
}

void ExpectEye(ComparisonSheet& sheet, int column)
{
  const StackPicture view{ "Navarro's eye", { MakeCornea(Anterior, 50), MakeCornea(Posterior, 50) },
    { { 1.0, Anterior.Behind }, { Anterior.Behind, Posterior.Behind } },
    { { 8.0, 36.0, -14.0 }, { 0.0, -2.0, 0.0 }, 0.14, Pixels }, 0.005, 2e-4 };
  const auto object = BoardScene{ MakeBoard(-Pupil, 12.0), std::nullopt }.MakeData();
  const auto rays =
    MakeExactRays({ MakeExactCornea(Anterior, 1.0), MakeExactCornea(Posterior, Anterior.Behind) },
      view.Camera.GetEye(), MakeRoundOutline(CorneaRadius));
  ExpectSameView(sheet, column, view, object,
    TraceRays(view.Camera, rays, MakeSquareTracer(-Pupil, 12.0)), GetIrisColour);
}

//------------------------------------------------------------------------------
// Waves on water, and waves on the glass below it.
void ExpectWaves(ComparisonSheet& sheet, int column)
{
  constexpr double lower = -40.0;
  constexpr int cells = 128;
  const HeightField first{ HeightField::Shape::Waves, 200.0, 1.6, 0.05 * Pi, 1.0, Water };
  const HeightField second{ HeightField::Shape::Waves, 200.0, 4.0, 0.02 * Pi, Water, 1.7 };
  auto below = second.MakeMesh(cells);
  below.Translate({ 0.0, lower, 0.0 });
  const StackPicture view{ "two wavy surfaces", { first.MakeMesh(cells), below },
    { { 1.0, Water }, { Water, 1.7 } }, { { 20.0, 300.0, 10.0 }, glm::dvec3(0.0), 0.25, Pixels },
    0.0025 };
  const glm::dvec3 eye = view.Camera.GetEye();
  ExpectScene(sheet, column, view, MakeBoardAndRing(-170.0, 160.0),
    [=](const glm::dvec3& direction) -> std::optional<LastLeg>
    {
      const glm::dvec3 down(0.0, lower, 0.0);
      const glm::dvec3 a = first.Intersect(eye, direction, -eye.y / direction.y);
      const auto along = first.Refract(eye, a, 1.0);
      if (!along)
      {
        return std::nullopt;
      }
      const glm::dvec3 inner = *along - a;
      const glm::dvec3 b = second.Intersect(a - down, inner, (lower - a.y) / inner.y);
      const auto behind = second.Refract(a - down, b, 1.0);
      if (!behind ||
        std::max({ std::fabs(a.x), std::fabs(a.z), std::fabs(b.x), std::fabs(b.z) }) > 100.0)
      {
        return std::nullopt;
      }
      return LastLeg{ b + down, *behind - b };
    });
}

}

//------------------------------------------------------------------------------
TEST(StackComparison, PanesPortsCorneasAndWaves)
{
  ComparisonSheet sheet = MakeSceneSheet(5, Pixels / 2);
  ExpectPane(sheet, 0);
  const glm::dvec3 eye(50.0, 70.0, -120.0);
  ExpectPort(sheet, 1, "dome port, eye in its centre", eye, eye);
  ExpectPort(sheet, 2, "dome port, eye off its centre", eye, eye + glm::dvec3(3.0, -1.0, 4.0));
  ExpectEye(sheet, 3);
  ExpectWaves(sheet, 4);
  sheet.Write(MENISCUS_TEMPORARY_DIR "/stack-comparison.png");
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ComparisonScene.h"

#include "PovrayWriter.h"

#include <vtkCleanPolyData.h>

namespace meniscus::test
{

const char* const ColorArrayName = "Colors";

namespace
{

const double Pi = vtkMath::Pi();

using Color = std::array<unsigned char, 3>;

/** A point of a surface for parameters from 0 to 1. */
using Surface = std::function<glm::dvec3(double u, double v)>;

/** Divisions of a parametric surface: tiles and triangle pairs per tile, along u and along v. */
struct Tiling
{
  int Tiles[2];
  int Pairs[2];
};

//------------------------------------------------------------------------------
/**
 * Triangles of a grid of points, but for those that two equal corners leave without area; `take`
 * gets the row and the column of each.
 */
void AddTriangles(
  vtkPolyData* data, int columns, int rows, const std::function<void(int column, int row)>& take)
{
  vtkNew<vtkCellArray> cells;
  const auto isSame = [data](vtkIdType a, vtkIdType b)
  {
    double p[3];
    double q[3];
    data->GetPoint(a, p);
    data->GetPoint(b, q);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
  };
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const vtkIdType a = static_cast<vtkIdType>(row) * (columns + 1) + column;
      const vtkIdType b = a + columns + 1;
      for (const auto& ids :
        { std::array<vtkIdType, 3>{ a, a + 1, b + 1 }, std::array<vtkIdType, 3>{ a, b + 1, b } })
      {
        if (!isSame(ids[0], ids[1]) && !isSame(ids[1], ids[2]) && !isSame(ids[2], ids[0]))
        {
          cells->InsertNextCell(3, ids.data());
          take(column, row);
        }
      }
    }
  }
  data->SetPolys(cells);
}

//------------------------------------------------------------------------------
/** A checkered surface in two colours. */
vtkSmartPointer<vtkPolyData> MakeTiles(
  const Surface& surface, const Tiling& tiling, const Color& even, const Color& odd)
{
  const int columns = tiling.Tiles[0] * tiling.Pairs[0];
  const int rows = tiling.Tiles[1] * tiling.Pairs[1];
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int row = 0; row <= rows; ++row)
  {
    for (int column = 0; column <= columns; ++column)
    {
      const glm::dvec3 p = surface(double(column) / columns, double(row) / rows);
      points->InsertNextPoint(p.x, p.y, p.z);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(ColorArrayName);
  colors->SetNumberOfComponents(3);
  AddTriangles(data, columns, rows,
    [&](int column, int row)
    {
      const bool isOdd = (column / tiling.Pairs[0] + row / tiling.Pairs[1]) % 2 != 0;
      colors->InsertNextTypedTuple((isOdd ? odd : even).data());
    });
  data->GetCellData()->AddArray(colors);
  return data;
}

//------------------------------------------------------------------------------
/** The parallelogram from `origin` along two edges. */
Surface Parallelogram(const glm::dvec3& origin, const glm::dvec3& along, const glm::dvec3& across)
{
  return [=](double u, double v) { return origin + u * along + v * across; };
}

/** A direction about the y axis, exactly the same for 0 and 1. */
glm::dvec3 Around(double u)
{
  const double angle = u < 1.0 ? 2.0 * Pi * u : 0.0;
  return { std::cos(angle), 0.0, std::sin(angle) };
}

Surface MakeBall(const glm::dvec3& center, double radius)
{
  return [=](double u, double v)
  {
    if (v <= 0.0 || v >= 1.0)
    {
      return center + glm::dvec3(0.0, v <= 0.0 ? -radius : radius, 0.0);
    }
    return center + radius * std::sin(Pi * v) * Around(u) -
      glm::dvec3(0.0, radius * std::cos(Pi * v), 0.0);
  };
}

/** The side of a cone stump from a circle about `foot` to one about `top`; both are horizontal. */
Surface Stump(const glm::dvec3& foot, double footRadius, const glm::dvec3& top, double topRadius)
{
  return [=](double u, double v)
  { return (1.0 - v) * foot + v * top + ((1.0 - v) * footRadius + v * topRadius) * Around(u); };
}

/** A torus about the y axis. */
Surface Torus(const glm::dvec3& center, double radius, double thickness)
{
  return [=](double u, double v)
  {
    const glm::dvec3 section = Around(v);
    return center + (radius + thickness * section.x) * Around(u) +
      glm::dvec3(0.0, thickness * section.z, 0.0);
  };
}

constexpr Color White{ 240, 235, 220 };
constexpr Color Slate{ 40, 60, 90 };
constexpr Color Red{ 200, 40, 30 };
constexpr Color Yellow{ 245, 200, 60 };
constexpr Color Green{ 30, 140, 70 };
constexpr Color Lime{ 170, 230, 120 };
constexpr Color Purple{ 130, 40, 150 };
constexpr Color Pink{ 250, 170, 210 };
constexpr Color Sand{ 210, 180, 140 };
constexpr Color Brown{ 100, 70, 50 };

//------------------------------------------------------------------------------
/**
 * Triangles with normals, joined where the parameters end. The normal is on the side of the cross
 * product of the derivatives by u and by v, so that facets and normals agree.
 */
vtkSmartPointer<vtkPolyData> MakeMembrane(
  const Surface& surface, const Surface& normal, int columns, int rows)
{
  const auto data = MakeTiles(surface, { { columns, rows }, { 1, 1 } }, White, White);
  data->GetCellData()->Initialize();
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (int row = 0; row <= rows; ++row)
  {
    for (int column = 0; column <= columns; ++column)
    {
      const glm::dvec3 n = glm::normalize(normal(double(column) / columns, double(row) / rows));
      normals->InsertNextTuple(&n.x);
    }
  }
  data->GetPointData()->SetNormals(normals);
  vtkNew<vtkCleanPolyData> joined;
  joined->SetInputData(data);
  joined->ToleranceIsAbsoluteOn();
  joined->SetAbsoluteTolerance(0.0);
  joined->Update();
  return joined->GetOutput();
}

//------------------------------------------------------------------------------
RefractingSurface MakePlane(double half)
{
  RefractingSurface result;
  result.Membrane = MakeMembrane(
    Parallelogram({ -half, 0.0, -half }, { 0.0, 0.0, 2.0 * half }, { 2.0 * half, 0.0, 0.0 }),
    [](double, double) { return glm::dvec3(0.0, 1.0, 0.0); }, 8, 8);
  result.Primitive = "plane { <0, 1, 0>, 0";
  return result;
}

//------------------------------------------------------------------------------
/**
 * Glass; the part of the surface that faces away from the eye shows nothing in Meniscus, and
 * nothing but the background in POV-Ray.
 */
RefractingSurface MakeSphere(double radius)
{
  RefractingSurface result;
  result.Interior = 1.5;
  const auto outwards = [](double size)
  {
    const Surface inwards = MakeBall(glm::dvec3(0.0), size);
    return [inwards](double u, double v) { return inwards(1.0 - u, v); };
  };
  constexpr int meridians = 256;
  result.Membrane = MakeMembrane(outwards(radius), outwards(1.0), meridians, meridians / 2);
  // At most the circle's length times the sagitta of a triangle's longest edge, the diagonal of a
  // square of 2 pi / meridians.
  result.OutlineArea =
    2.0 * Pi * radius * radius * (1.0 - std::cos(std::sqrt(2.0) * Pi / meridians));
  result.Primitive = "sphere { <0, 0, 0>, " + PovrayNumber(radius);
  return result;
}

//------------------------------------------------------------------------------
/** y = amplitude sin(k x) sin(k z). */
RefractingSurface MakeWaves(double amplitude, double k, double half, int cells)
{
  RefractingSurface result;
  const auto place = [half](double u, double v)
  { return half * glm::dvec3(2.0 * v - 1.0, 0.0, 2.0 * u - 1.0); };
  result.Membrane = MakeMembrane(
    [=](double u, double v)
    {
      glm::dvec3 p = place(u, v);
      p.y = amplitude * std::sin(k * p.x) * std::sin(k * p.z);
      return p;
    },
    [=](double u, double v)
    {
      const glm::dvec3 p = place(u, v);
      return glm::dvec3(-amplitude * k * std::cos(k * p.x) * std::sin(k * p.z), 1.0,
        -amplitude * k * std::sin(k * p.x) * std::cos(k * p.z));
    },
    cells, cells);
  const std::string a = PovrayNumber(amplitude);
  const std::string factor = PovrayNumber(k);
  const std::string reach = PovrayNumber(half);
  // The body of water is deeper than all objects. Its gradient is at most the one given here; the
  // accuracy is that of the step of POV-Ray's differences for the normal, too: an error of
  // accuracy * curvature / 2, and of 1e-16 / accuracy from rounding.
  result.Primitive = "isosurface { function { y - " + a + " * sin(" + factor + " * x) * sin(" +
    factor + " * z) }\n  contained_by { box { <-" + reach + ", -1000, -" + reach + ">, <" + reach +
    ", " + PovrayNumber(2.0 * amplitude) + ", " + reach + "> } }\n  accuracy 1e-7 max_gradient " +
    PovrayNumber(std::sqrt(1.0 + 2.0 * std::pow(amplitude * k, 2.0)));
  return result;
}

//------------------------------------------------------------------------------
/** The paraboloid x^2 + z^2 = 2 p y, the eye within, up to where it is `steepest` degrees steep. */
RefractingSurface MakeBowl(double p, double steepest, int rings)
{
  RefractingSurface result;
  const double rim = p * std::tan(vtkMath::RadiansFromDegrees(steepest));
  // Rings of equal steps in slope.
  const auto radius = [=](double v) { return rim * v; };
  result.Membrane = MakeMembrane(
    [=](double u, double v)
    {
      const double r = radius(v);
      return r * Around(u) + glm::dvec3(0.0, r * r / (2.0 * p), 0.0);
    },
    [=](double u, double v) { return glm::dvec3(0.0, p, 0.0) - radius(v) * Around(u); }, 4 * rings,
    rings);
  result.Primitive =
    "quadric { <1, 0, 1>, <0, 0, 0>, <0, " + PovrayNumber(-2.0 * p) + ", 0>, 0 inverse";
  return result;
}

//------------------------------------------------------------------------------
ComparisonScene MakePlaneScene()
{
  ComparisonScene scene;
  scene.Name = "plane";
  scene.Description = "checkered objects below plane water, seen at up to 78 degrees to its normal";
  scene.Camera = { { 15.0, 22.0, -55.0 }, { 0.0, -10.0, 3.0 }, { 0.0, 1.0, 0.0 }, 40.0 };
  scene.Surface = MakePlane(400.0);
  scene.Objects = { MakeTiles(Parallelogram(
                                { -47.0, -31.0, -43.0 }, { 100.0, 0.0, 3.0 }, { -2.0, 0.0, 120.0 }),
                      { { 20, 24 }, { 1, 1 } }, White, Slate),
    MakeTiles(MakeBall({ -9.0, -15.0, 5.0 }, 10.0), { { 12, 6 }, { 4, 4 } }, Red, Yellow),
    MakeTiles(Stump({ 16.0, -30.0, 20.0 }, 6.0, { 13.0, -3.0, 16.0 }, 2.5), { { 10, 8 }, { 4, 1 } },
      Green, Lime),
    MakeTiles(Torus({ 2.0, -22.0, -17.0 }, 7.0, 2.0), { { 16, 6 }, { 3, 3 } }, Purple, Pink) };
  return scene;
}

//------------------------------------------------------------------------------
ComparisonScene MakeWindowScene()
{
  ComparisonScene scene;
  scene.Name = "window";
  scene.Description = "objects above plane water, seen from below through Snell's window";
  scene.Camera = { { 2.0, -20.0, -3.0 }, { 0.0, 0.0, 4.0 }, { 0.0, 0.0, 1.0 }, 110.0 };
  scene.Surface.Membrane = MakeMembrane(
    Parallelogram({ -60.0, 0.0, -60.0 }, { 120.0, 0.0, 0.0 }, { 0.0, 0.0, 120.0 }),
    [](double, double) { return glm::dvec3(0.0, -1.0, 0.0); }, 120, 120);
  scene.Surface.Primitive = "plane { <0, -1, 0>, 0";
  scene.Surface.Exterior = 1.333;
  scene.Surface.Interior = 1.0;
  scene.Objects = { MakeTiles(
                      Parallelogram({ -41.0, 34.0, -37.0 }, { 83.0, 3.0, 0.0 }, { 0.0, 2.0, 71.0 }),
                      { { 16, 14 }, { 1, 1 } }, White, Slate),
    MakeTiles(MakeBall({ -19.0, 13.0, 9.0 }, 9.0), { { 12, 6 }, { 4, 4 } }, Red, Yellow),
    MakeTiles(Stump({ 21.0, 1.0, 13.0 }, 3.0, { 25.0, 36.0, 10.0 }, 7.0), { { 10, 12 }, { 4, 1 } },
      Green, Lime),
    MakeTiles(Torus({ 7.0, 9.0, -13.0 }, 8.0, 2.5), { { 16, 6 }, { 3, 3 } }, Purple, Pink) };
  return scene;
}

//------------------------------------------------------------------------------
ComparisonScene MakeSphereScene()
{
  ComparisonScene scene;
  scene.Name = "sphere";
  scene.Description = "objects within a ball of glass, seen from outside";
  scene.Camera = { { 7.0, 11.0, -29.0 }, { 0.2, 0.1, 0.0 }, { 0.0, 1.0, 0.0 }, 40.0 };
  scene.Surface = MakeSphere(10.0);
  scene.Objects = { MakeTiles(
                      Parallelogram({ -5.5, -3.7, -6.1 }, { 10.9, 0.7, 0.0 }, { 0.0, 0.9, 11.7 }),
                      { { 11, 12 }, { 1, 1 } }, White, Slate),
    MakeTiles(MakeBall({ 2.3, 1.4, 1.7 }, 3.1), { { 12, 6 }, { 4, 4 } }, Red, Yellow),
    MakeTiles(Torus({ -3.1, 2.2, -1.0 }, 2.6, 0.7), { { 16, 6 }, { 3, 3 } }, Purple, Pink),
    MakeTiles(Stump({ -1.0, -9.1, 0.6 }, 1.9, { 0.5, 8.7, 3.9 }, 0.6), { { 8, 14 }, { 4, 1 } },
      Green, Lime) };
  return scene;
}

//------------------------------------------------------------------------------
ComparisonScene MakeWavesScene()
{
  ComparisonScene scene;
  scene.Name = "waves";
  scene.Description = "objects below waves that focus in front of the floor, and through them";
  scene.Camera = { { 31.0, 62.0, -57.0 }, { 1.0, -12.0, 2.0 }, { 0.0, 1.0, 0.0 }, 36.0 };
  scene.Surface = MakeWaves(1.4, 0.24, 120.0, 256);
  scene.Objects = { MakeTiles(Parallelogram(
                                { -73.0, -61.0, -71.0 }, { 150.0, 0.0, 3.0 }, { -2.0, 0.0, 150.0 }),
                      { { 15, 15 }, { 2, 2 } }, White, Slate),
    MakeTiles(MakeBall({ -11.0, -2.0, 7.0 }, 10.0), { { 12, 6 }, { 4, 4 } }, Red, Yellow),
    MakeTiles(Stump({ 19.0, -60.0, 12.0 }, 7.0, { 14.0, 12.0, 9.0 }, 2.0), { { 10, 18 }, { 4, 1 } },
      Green, Lime),
    MakeTiles(Torus({ 3.0, -24.0, -15.0 }, 9.0, 2.5), { { 16, 6 }, { 3, 3 } }, Purple, Pink) };
  return scene;
}

//------------------------------------------------------------------------------
ComparisonScene MakeBowlScene()
{
  ComparisonScene scene;
  scene.Name = "bowl";
  scene.Description = "objects that pierce a parabolic bowl where it is up to 70 degrees steep";
  scene.Camera = { { -12.0, 34.0, -3.0 }, { 16.0, 14.0, 2.0 }, { 0.0, 1.0, 0.0 }, 60.0 };
  // The rim, at 75 degrees, is behind the edge of the picture.
  scene.Surface = MakeBowl(10.0, 75.0, 64);
  scene.Objects = { MakeTiles(Parallelogram(
                                { -61.0, -22.0, -57.0 }, { 130.0, 3.0, 0.0 }, { 2.0, 0.0, 120.0 }),
                      { { 19, 18 }, { 1, 1 } }, Sand, Brown),
    MakeTiles(Parallelogram({ 56.0, -15.0, -61.0 }, { -1.0, 0.0, 120.0 }, { 3.0, 70.0, 1.0 }),
      { { 17, 10 }, { 1, 1 } }, White, Slate),
    MakeTiles(MakeBall({ 24.0, 29.0, 6.0 }, 5.5), { { 12, 6 }, { 4, 4 } }, Red, Yellow),
    MakeTiles(Stump({ 9.0, -12.0, -3.0 }, 5.0, { 5.0, 17.0, -2.0 }, 1.5), { { 10, 10 }, { 4, 1 } },
      Green, Lime),
    MakeTiles(Torus({ 14.0, 17.0, -9.0 }, 7.0, 2.0), { { 16, 6 }, { 3, 3 } }, Purple, Pink) };
  return scene;
}

} // anonymous namespace

//------------------------------------------------------------------------------
ObjectColors FindObjectColors(const ComparisonScene& scene, const unsigned char* color)
{
  for (vtkPolyData* object : scene.Objects)
  {
    auto* colors =
      vtkUnsignedCharArray::SafeDownCast(object->GetCellData()->GetArray(ColorArrayName));
    ObjectColors found;
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      Color one;
      colors->GetTypedTuple(i, one.data());
      found.insert(one);
    }
    if (found.count({ color[0], color[1], color[2] }) > 0)
    {
      return found;
    }
  }
  return {};
}

//------------------------------------------------------------------------------
std::vector<ComparisonScene> MakeComparisonScenes()
{
  ComparisonScene straight = MakeBowlScene();
  straight.Name = "straight";
  straight.Description = "the objects of the bowl without a refracting surface";
  straight.Surface = RefractingSurface();
  return { straight, MakePlaneScene(), MakeWindowScene(), MakeSphereScene(), MakeWavesScene(),
    MakeBowlScene() };
}

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Shadows of objects behind a membrane, compared with rays in double precision: balls above the
// floor of a pool.
#include "FlatPoolLamps.h"
#include "VTKTestBasics.h"

#include <vtkAppendFilter.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkStripper.h>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

namespace
{

constexpr int Facets = 64; ///< of a ball's circumference

/** A ball in the water. Its facets are inside by up to its sagitta. */
struct Ball
{
  glm::dvec3 Middle;
  double Radius;

  double GetSagitta() const { return this->Radius * (1.0 - std::pow(std::cos(Pi / Facets), 2.0)); }

  /**
   * Where a ray meets the ball of a radius, as a distance; nothing if it passes or if it is on its
   * far side.
   */
  std::optional<double> Meet(
    const glm::dvec3& start, const glm::dvec3& along, double radius, double most) const
  {
    const glm::dvec3 between = this->Middle - start;
    const double way = glm::dot(between, along);
    const double square = radius * radius - glm::dot(between, between) + way * way;
    const double near = square > 0.0 ? way - std::sqrt(square) : -1.0;
    return square > 0.0 && near > 0.0 && near < most ? std::optional<double>(near) : std::nullopt;
  }

private:
  static constexpr double Pi = 3.14159265358979323846;
};

/** The part that a pixel shows: the floor, -1, or a ball. */
struct Shown
{
  glm::dvec3 Place;
  int Ball = -1;
  bool IsCertain = true;
};

/** A flat pool with balls. */
class BallPool : public LitPool
{
public:
  explicit BallPool(const std::vector<Ball>& balls)
    : Balls(balls)
  {
    this->Floor->GetProperty()->SetSpecular(0.0);
    for (const Ball& ball : balls)
    {
      vtkNew<vtkSphereSource> source;
      source->SetCenter(ball.Middle.x, ball.Middle.y, ball.Middle.z);
      source->SetRadius(ball.Radius);
      source->SetThetaResolution(Facets);
      source->SetPhiResolution(Facets / 2 + 1);
      vtkNew<vtkRefractedGeometryFilter> filter;
      filter->SetInputConnection(source->GetOutputPort());
      filter->SetMembraneConnection(this->Surface->GetOutputPort());
      filter->SetInteriorIndexOfRefraction(Water);
      filter->SetCamera(this->GetCamera());
      filter->TrueGeometryOn();
      const auto actor = MakeActor(filter->GetOutputPort());
      actor->GetProperty()->DeepCopy(this->Floor->GetProperty());
      actor->GetProperty()->LightingOn();
      this->Pass->AddRefraction(this->Membrane, actor, filter);
      this->Sources.emplace_back(source);
      this->Actors.push_back(actor);
      this->Filters.emplace_back(filter);
    }
  }

  Shown ShownBy(const Sight& sight)
  {
    const FloorSight floor = FloorOf(this->GetCamera(), sight);
    const glm::dvec3 start(sight.Point[0], sight.Point[1], 0.0);
    const double most = glm::distance(start, floor.Place);
    Shown shown{ floor.Place };
    double nearest = most;
    for (std::size_t i = 0; i < this->Balls.size(); ++i)
    {
      const Ball& ball = this->Balls[i];
      // Places on facets are off those on the ball, which matters at its edge.
      const double step = 0.06 * ball.Radius;
      const auto way = ball.Meet(start, -floor.ToViewer, ball.Radius, most);
      const bool isSure = ball.Meet(start, -floor.ToViewer, ball.Radius - step, most).has_value() ==
          way.has_value() &&
        ball.Meet(start, -floor.ToViewer, ball.Radius + step, most).has_value() == way.has_value();
      shown.IsCertain = shown.IsCertain && isSure;
      if (way && *way < nearest)
      {
        nearest = *way;
        shown.Ball = static_cast<int>(i);
        shown.Place = start - *way * floor.ToViewer;
      }
    }
    return shown;
  }

  /** True if a ball of radii that differ by `change` is on the light's way to a place in water. */
  bool IsHidden(const Lamp& lamp, const Shown& shown, double change) const
  {
    const LampRay ray = TraceLamp(lamp, shown.Place);
    const bool isStraight = !lamp.IsDistant && lamp.Place.z < 0.0;
    const glm::dvec3 bend = shown.Place + ray.InWater * ray.ToLamp;
    bool isHidden = false;
    for (std::size_t i = 0; i < this->Balls.size(); ++i)
    {
      const Ball& ball = this->Balls[i];
      const double radius = ball.Radius + (change < 0.0 ? change - ball.GetSagitta() : change);
      const bool isOther = static_cast<int>(i) != shown.Ball;
      const bool isHit =
        ball.Meet(shown.Place, ray.ToLamp, radius, ray.InWater).has_value() && isOther;
      const double beyond = lamp.IsDistant ? 1.0e9 : ray.Path - ray.InWater;
      const bool isHitAbove = !isStraight && ball.Meet(bend, -ray.FromLamp, radius, beyond);
      isHidden = isHidden || isHit || isHitAbove;
    }
    return isHidden;
  }

  /** Pictures with shadows and without are the same, but for the pixels in shadow. */
  void ExpectShadows(const std::string& what, const Lamp& lamp, int expectedDark)
  {
    SCOPED_TRACE(what);
    this->SetLamps({ lamp });
    this->Pass->ShadowsOff();
    const ByteImage plain = this->Render();
    this->Pass->ShadowsOn();
    const ByteImage image = this->Render();
    int dark = 0;
    int uncertain = 0;
    for (const auto& [y, x] : Product(Size, Size))
    {
      const Sight sight = SightOf(this->GetCamera(), x, y);
      if (!sight.OnMembrane || IsBorder(sight))
      {
        continue;
      }
      const Shown shown = this->ShownBy(sight);
      const bool isHidden = this->IsHidden(lamp, shown, -Slack);
      if (!shown.IsCertain || isHidden != this->IsHidden(lamp, shown, Slack))
      {
        ++uncertain;
        continue;
      }
      for (int c = 0; c < 3; ++c)
      {
        const int wanted = static_cast<int>(std::lround(255.0 * Ambient * Albedo[c]));
        const int unshadowed = plain.GetPixel(x, y)[c];
        ASSERT_NEAR(image.GetPixel(x, y)[c], isHidden ? wanted : unshadowed, 1)
          << x << " " << y << " ball " << shown.Ball << (isHidden ? " hidden" : " lit");
      }
      dark += isHidden ? 1 : 0;
    }
    ::testing::Test::RecordProperty(what + " dark", dark);
    ::testing::Test::RecordProperty(what + " uncertain", uncertain);
    EXPECT_GT(dark, expectedDark);
    EXPECT_LT(uncertain, 150 + dark / 10);
  }

  /**
   * Change of a ball's radius that moves the edge of its shadow by a tenth of a cell, of 100,000
   * on the floor.
   */
  static constexpr double Slack = 0.1 * 12.0 / 316.0;

  std::vector<Ball> Balls;
  std::vector<vtkSmartPointer<vtkSphereSource>> Sources;
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  std::vector<vtkSmartPointer<vtkRefractedGeometryFilter>> Filters;
};

Lamp SunAt(double degrees)
{
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  return Distant(0.8 * std::sin(angle), 0.6 * std::sin(angle), std::cos(angle));
}

/** A sheet of quadrilaterals with a twist, z = middle + twist x y, on [-1, 1]^2. */
vtkSmartPointer<vtkPolyData> MakeTwistedSheet(double middle, double twist, int cells)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> polygons;
  for (const auto& [j, i] : Product(cells + 1, cells + 1))
  {
    const double x = 2.0 * i / cells - 1.0;
    const double y = 2.0 * j / cells - 1.0;
    points->InsertNextPoint(x, y, middle + twist * x * y);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-twist * y, -twist * x, 1.0));
    normals->InsertNextTuple(&normal.x);
    const vtkIdType corner = j * (cells + 1) + i;
    if (i < cells && j < cells)
    {
      polygons->InsertNextCell({ corner, corner + 1, corner + cells + 2, corner + cells + 1 });
    }
  }
  auto sheet = vtkSmartPointer<vtkPolyData>::New();
  sheet->SetPoints(points);
  sheet->SetPolys(polygons);
  sheet->GetPointData()->SetNormals(normals);
  return sheet;
}

int CountDifferences(const ByteImage& a, const ByteImage& b)
{
  return std::inner_product(
    a.Rgb.begin(), a.Rgb.end(), b.Rgb.begin(), 0, std::plus<>(), std::not_equal_to<>());
}

} // anonymous namespace

TEST(RefractionPassShadows, ABallUnderASun)
{
  BallPool pool({ { { 0.1, -0.05, -0.8 }, 0.35 } });
  pool.LookFrom(1.5, -0.8);
  pool.ExpectShadows("sun at 0 degrees", SunAt(0.0), 10);
  pool.ExpectShadows("sun at 45 degrees", SunAt(45.0), 60);
  pool.ExpectShadows("sun at 75 degrees", SunAt(75.0), 100);
  EXPECT_EQ(pool.Pass->GetNumberOfShadowUpdates(), 3) << "shadows were off in between";
}

TEST(RefractionPassShadows, BallsShadeEachOther)
{
  BallPool pool(
    { { { 0.25, 0.15, -0.45 }, 0.2 }, { { 0.0, 0.0, -0.9 }, 0.3 }, { { -0.6, 0.5, -1.3 }, 0.2 } });
  pool.LookFrom(-1.2, 1.0);
  for (const double degrees : { 0.0, 30.0, 45.0 })
  {
    pool.ExpectShadows("sun at " + std::to_string(degrees), SunAt(degrees), 15);
  }
}

TEST(RefractionPassShadows, LampsInTheWaterAndAboveIt)
{
  BallPool pool({ { { 0.25, 0.15, -0.5 }, 0.2 }, { { -0.3, -0.2, -1.0 }, 0.3 } });
  pool.LookFrom(-1.0, 0.8);
  pool.ExpectShadows("lamp in the water", Near(0.7, 0.5, -0.3), 100);
  pool.ExpectShadows("lamp between the balls and the floor", Near(0.2, 0.2, -1.15), 100);
  pool.ExpectShadows("lamp above", Near(0.7, -0.4, 0.8), 100);
  pool.ExpectShadows("lamp far to the side", Near(6.0, 3.0, 0.5), 100);
  Lamp spot = Near(0.5, 0.4, 0.6);
  spot.Axis = { -0.4, -0.3, -1.0 };
  spot.ConeAngle = 40.0;
  pool.ExpectShadows("spot", spot, 100);
}

/** The part of an object above the water shades what is in it. */
TEST(RefractionPassShadows, AnObjectPartlyAboveTheWater)
{
  BallPool pool({ { { 0.2, 0.1, 0.1 }, 0.3 } });
  pool.LookFrom(-1.0, 0.8);
  pool.ExpectShadows("sun", SunAt(60.0), 100);
  pool.ExpectShadows("lamp", Near(1.4, 0.9, 0.7), 100);
}

/** Facets without normals, and normals that turn inwards. */
TEST(RefractionPassShadows, NormalsOfAllKinds)
{
  BallPool pool({ { { 0.1, -0.05, -0.8 }, 0.35 } });
  pool.LookFrom(1.5, -0.8);
  pool.Sources[0]->GenerateNormalsOff();
  pool.ExpectShadows("facets", SunAt(45.0), 60);
  pool.Sources[0]->GenerateNormalsOn();
  pool.Sources[0]->SetThetaResolution(8);
  pool.Sources[0]->SetPhiResolution(6);
  pool.SetLamps({ SunAt(45.0) });
  pool.Floor->VisibilityOff();
  pool.Pass->ShadowsOff();
  const ByteImage plain = pool.Render();
  pool.Pass->ShadowsOn();
  EXPECT_EQ(CountDifferences(pool.Render(), plain), 0) << "a coarse ball shades itself";
}

TEST(RefractionPassShadows, TheTreeIsMadeWhereObjectsChange)
{
  BallPool pool({ { { 0.1, -0.05, -0.8 }, 0.35 }, { { -0.7, 0.5, -0.6 }, 0.2 } });
  pool.SetLamps({ SunAt(30.0) });
  const ByteImage plain = pool.Render();
  EXPECT_EQ(pool.Pass->GetNumberOfShadowUpdates(), 0) << "off";
  pool.Pass->ShadowsOn();
  const auto updates = [&pool]()
  {
    pool.Render();
    return pool.Pass->GetNumberOfShadowUpdates();
  };
  const ByteImage both = pool.Render();
  EXPECT_GT(CountDifferences(both, plain), 300);
  EXPECT_EQ(updates(), 1);
  pool.LookFrom(1.0, 0.4);
  EXPECT_EQ(updates(), 1) << "camera";
  pool.LookFrom(0.0, 0.0);
  pool.SetLamps({ SunAt(50.0), Near(0.7, -0.4, -0.6) });
  EXPECT_EQ(updates(), 1) << "lights";
  pool.SetLamps({ SunAt(30.0) });
  pool.Filter->SetInteriorIndexOfRefraction(1.3);
  EXPECT_EQ(updates(), 1) << "index";
  pool.Filter->SetInteriorIndexOfRefraction(Water);
  pool.Actors[1]->GetProperty()->SetColor(0.2, 0.3, 0.4);
  EXPECT_EQ(updates(), 1) << "colour";
  pool.Actors[1]->GetProperty()->SetColor(Albedo.r, Albedo.g, Albedo.b);
  EXPECT_EQ(CountDifferences(pool.Render(), both), 0);
  pool.Sources[1]->SetRadius(0.25);
  EXPECT_EQ(updates(), 2) << "object";
  pool.Sources[1]->SetRadius(0.2);
  EXPECT_EQ(updates(), 3);
  pool.Actors[1]->VisibilityOff();
  const ByteImage one = pool.Render();
  EXPECT_EQ(pool.Pass->GetNumberOfShadowUpdates(), 4) << "hidden";
  pool.Pass->ShadowsOff();
  const ByteImage plainOne = pool.Render();
  EXPECT_LT(CountDifferences(one, plainOne), CountDifferences(both, plain));
  EXPECT_EQ(pool.Pass->GetNumberOfShadowUpdates(), 4);
  pool.Pass->ShadowsOn();
  pool.Actors[1]->VisibilityOn();
  EXPECT_EQ(CountDifferences(pool.Render(), both), 0);
  for (vtkActor* actor : { pool.Actors[0].Get(), pool.Actors[1].Get(), pool.Floor.Get() })
  {
    actor->VisibilityOff();
  }
  pool.Render();
  pool.Floor->VisibilityOn();
  pool.Actors[0]->VisibilityOn();
  EXPECT_EQ(CountDifferences(pool.Render(), one), 0);
  pool.Pass->SetLighting(vtkRefractionPass::VIRTUAL_SPACE);
  pool.Render();
  pool.Pass->SetLighting(vtkRefractionPass::TRUE_SPACE);
  EXPECT_EQ(CountDifferences(pool.Render(), one), 0);
  pool.Pass->ShadowsOff();
  EXPECT_EQ(CountDifferences(pool.Render(), plainOne), 0);
}

/** Translucent objects and wireframes cast no shadow. */
TEST(RefractionPassShadows, OnlyOpaqueSurfacesCastShadows)
{
  BallPool pool({ { { 0.1, -0.05, -0.8 }, 0.35 } });
  pool.SetLamps({ SunAt(45.0) });
  vtkProperty* property = pool.Actors[0]->GetProperty();
  const auto differences = [&pool]()
  {
    pool.Pass->ShadowsOff();
    const ByteImage plain = pool.Render();
    pool.Pass->ShadowsOn();
    return CountDifferences(pool.Render(), plain);
  };
  EXPECT_GT(differences(), 300);
  property->SetOpacity(0.5);
  EXPECT_EQ(differences(), 0);
  property->SetOpacity(1.0);
  property->SetRepresentationToWireframe();
  EXPECT_EQ(differences(), 0);
  property->SetRepresentationToSurface();
  EXPECT_GT(differences(), 300);
}

/** Strips, the surface of a grid, and blocks cast the shadow of polygons. */
TEST(RefractionPassShadows, ObjectsOfAllKindsCastShadows)
{
  BallPool pool({ { { 0.1, -0.05, -0.8 }, 0.35 } });
  const auto messages = ObserveErrors(pool.Pass);
  pool.LookFrom(1.5, -0.8);
  pool.SetLamps({ SunAt(45.0) });
  pool.Pass->ShadowsOn();
  const ByteImage right = pool.Render();
  const auto countOnFloor = [&]()
  {
    const ByteImage image = pool.Render();
    int count = 0;
    for (const auto& [y, x] : Product(Size, Size))
    {
      const Sight sight = SightOf(pool.GetCamera(), x, y);
      const Shown shown = pool.ShownBy(sight);
      const bool isFloor = sight.OnMembrane && shown.IsCertain && shown.Ball < 0;
      count += isFloor && image.GetPixel(x, y)[0] != right.GetPixel(x, y)[0] ? 1 : 0;
    }
    return count;
  };
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(pool.Sources[0]->GetOutputPort());
  strips->Update();
  pool.Filters[0]->SetInputConnection(strips->GetOutputPort());
  EXPECT_EQ(countOnFloor(), 0) << "strips";
  vtkNew<vtkAppendFilter> grid;
  grid->SetInputConnection(pool.Sources[0]->GetOutputPort());
  pool.Filters[0]->SetInputConnection(grid->GetOutputPort());
  EXPECT_EQ(countOnFloor(), 0) << "grid";
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(1, strips->GetOutput());
  pool.Filters[0]->SetInputDataObject(0, blocks);
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputConnection(pool.Filters[0]->GetOutputPort());
  pool.Actors[0]->SetMapper(mapper);
  EXPECT_EQ(countOnFloor(), 0) << "blocks";
  EXPECT_TRUE(messages->Errors.empty()) << messages->GetText();
}

/** Polygons are divided in other ways where they are drawn than where light is followed. */
TEST(RefractionPassShadows, TwistedPolygonsDoNotShadeThemselves)
{
  BallPool pool({});
  const auto countDifferences = [&pool]()
  {
    pool.Pass->ShadowsOff();
    const ByteImage plain = pool.Render();
    pool.Pass->ShadowsOn();
    return CountDifferences(pool.Render(), plain);
  };
  for (const double twist : { 0.3, -0.3 })
  {
    pool.Filter->SetInputData(MakeTwistedSheet(-0.8, twist, 5));
    for (const double degrees : { 0.0, 50.0 })
    {
      pool.SetLamps({ SunAt(degrees) });
      EXPECT_EQ(countDifferences(), 0) << twist << " " << degrees;
    }
  }
}

/** Places that are not finite, cells without area and without points, and objects without cells. */
TEST(RefractionPassShadows, BadObjectsCastNoShadow)
{
  BallPool pool({ { { 0.1, -0.05, -0.8 }, 0.35 } });
  pool.SetLamps({ SunAt(45.0) });
  pool.Pass->ShadowsOn();
  pool.Actors[0]->VisibilityOff();
  const ByteImage floor = pool.Render();
  pool.Actors[0]->VisibilityOn();
  vtkNew<vtkPolyData> empty;
  pool.Filters[0]->SetInputData(empty);
  EXPECT_EQ(CountDifferences(pool.Render(), floor), 0) << "empty";
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, -0.5);
  points->InsertNextPoint(0.5, 0.0, -0.5);
  points->InsertNextPoint(1.0, 0.0, -0.5);
  points->InsertNextPoint(0.0, std::nan(""), -0.5);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1, 2 });
  cells->InsertNextCell({ 0, 1, 3 });
  cells->InsertNextCell({ 0, 1, 3, 2 });
  cells->InsertNextCell({ 1, 1 });
  vtkNew<vtkPolyData> bad;
  bad->SetPoints(points);
  bad->SetPolys(cells);
  pool.Filters[0]->SetInputData(bad);
  pool.Filters[0]->SetGlobalWarningDisplay(0);
  EXPECT_LT(CountDifferences(pool.Render(), floor), 30) << "bad cells";
  pool.Filters[0]->SetGlobalWarningDisplay(1);
  // Nothing at all.
  pool.Floor->VisibilityOff();
  pool.Actors[0]->VisibilityOff();
  pool.Render();
}

/** Objects that VTK does not light cast shadows, too. */
TEST(RefractionPassShadows, ObjectsWithoutLightingCastShadows)
{
  BallPool pool({ { { 0.1, -0.05, -0.8 }, 0.35 } });
  pool.SetLamps({ SunAt(60.0) });
  pool.Pass->ShadowsOn();
  const ByteImage lit = pool.Render();
  pool.Actors[0]->GetProperty()->LightingOff();
  const ByteImage flat = pool.Render();
  int dark = 0;
  for (const auto& [y, x] : Product(Size, Size))
  {
    const Sight sight = SightOf(pool.GetCamera(), x, y);
    const Shown shown = pool.ShownBy(sight);
    if (sight.OnMembrane && shown.IsCertain && shown.Ball < 0)
    {
      ASSERT_EQ(flat.GetPixel(x, y)[0], lit.GetPixel(x, y)[0]) << x << " " << y;
      dark += flat.GetPixel(x, y)[0] < 255.0 * Ambient * Albedo[0] + 1.5 ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 60);
}

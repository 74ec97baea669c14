// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Shadows and occlusion of isosurfaces, and of independent components, against closed forms.
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr double Radius = 0.35;
constexpr double Height = -0.75;

/** Distance from a ball above a floor, the isosurface 0. */
double BallAndFloor(double x, double y, double z)
{
  return std::min(std::sqrt(x * x + y * y + (z - 0.2) * (z - 0.2)) - Radius, z - Height);
}

vtkSmartPointer<vtkLight> AddSun(vtkRenderer* renderer, double x, double y, double z)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToSceneLight();
  light->SetPosition(x, y, z);
  renderer->AddLight(light);
  return light;
}

/** White, opaque isosurface 0. */
vtkSmartPointer<vtkVolumeProperty> MakeSurface(double ambient, double diffuse)
{
  auto property = MakeConstantProperty(1.0, 1.0, 1.0, 1.0, 1.0);
  property->GetIsoSurfaceValues()->SetValue(0, 0.0);
  property->ShadeOn();
  property->SetAmbient(ambient);
  property->SetDiffuse(diffuse);
  property->SetSpecular(0.0);
  return property;
}

struct SurfaceScene
{
  SurfaceScene(int n, const Field& field, double ambient, double diffuse)
    : Mesh(MakeBlock(n, field))
    , Property(MakeSurface(ambient, diffuse))
    , Scene(Mesh, Property, 97, 97)
  {
    this->Scene.GetRayCaster()->SetBlendMode(5);
    this->Scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
    this->Scene.GetRenderer()->AutomaticLightCreationOff();
    LookAlongAxis(this->Scene.GetRenderer(), this->Mesh->GetBounds(), 2);
  }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  RayCastScene Scene;
};

struct ShadowOnFloor
{
  /** Pixels of the floor in light and in shadow, more than two cells from the shadow's border. */
  int Lit = 0;
  int Dark = 0;
  /** Those of them that are off by more than one of 255 levels. */
  int Wrong = 0;
  /** Mean error of all pixels of the floor. */
  double Mean = 0.0;
};

/** The floor below the ball, seen from above, in light from the direction (0.8, 0.3, 1). */
ShadowOnFloor CastOnFloor(int n)
{
  SurfaceScene drawn(n, BallAndFloor, 0.0, 1.0);
  AddSun(drawn.Scene.GetRenderer(), 0.8, 0.3, 1.0);
  const FloatImage image = drawn.Scene.RenderFloat();
  const PixelRays rays(drawn.Scene.GetRenderer());
  const double size = std::sqrt(0.8 * 0.8 + 0.3 * 0.3 + 1.0);
  const double cell = 2.0 / n;
  ShadowOnFloor result;
  int floor = 0;
  for (const auto& [y, x] : Product(image.Height, image.Width))
  {
    const Ray ray = rays.GetRay(x, y);
    const double place[2] = { ray.Origin[0], ray.Origin[1] };
    // Near the ball the floor is hidden.
    if (std::max(std::fabs(place[0]), std::fabs(place[1])) > 0.999 - cell ||
      std::hypot(place[0], place[1]) < Radius + cell)
    {
      continue;
    }
    // Distance of the ball's centre from the line to the light.
    const double to[3] = { -place[0], -place[1], 0.2 - Height };
    const double along = (0.8 * to[0] + 0.3 * to[1] + to[2]) / size;
    const double distance =
      std::sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2] - along * along);
    const bool lit = distance > Radius;
    const double error = std::fabs(image.GetPixel(x, y)[0] - (lit ? 1.0 / size : 0.0));
    result.Mean += error;
    ++floor;
    // Vertices on the side of the light are within a cell's diagonal of the surface, and the
    // polygons are inside of the ball by up to cell^2 / (2 Radius).
    if (std::fabs(distance - Radius) > 2.0 * cell)
    {
      ++(lit ? result.Lit : result.Dark);
      result.Wrong += error > 1.0 / 255.0 ? 1 : 0;
    }
  }
  result.Mean /= std::max(floor, 1);
  return result;
}

} // anonymous namespace

// The shadow of a ball on a plane; with 16 and 32 cubes, vertices are on the plane, with 27 not.
TEST(TetrahedraRayCastSurfaceShadows, BallOnFloorHasClosedForm)
{
  for (const int n : { 16, 27, 32 })
  {
    const ShadowOnFloor shadow = CastOnFloor(n);
    EXPECT_GT(shadow.Lit, 1000) << n;
    EXPECT_GT(shadow.Dark, n == 16 ? 5 : 100) << n;
    EXPECT_EQ(shadow.Wrong, 0) << n;
  }
  // The border is a cell wide: an error of the first order.
  EXPECT_LE(CastOnFloor(32).Mean, 0.65 * CastOnFloor(16).Mean);
}

// The half of the sky that a plane faces lights it, whatever side it is seen from.
TEST(TetrahedraRayCastSurfaceShadows, OpenPlaneHasAllAmbientLight)
{
  for (const double sign : { 1.0, -1.0 })
  {
    for (const double height : { 0.0, 0.1 })
    {
      SurfaceScene drawn(
        8, [=](double, double, double z) { return sign * (z - height); }, 0.5, 0.0);
      const float seen = drawn.Scene.RenderFloat().GetPixel(48, 48)[0];
      // One of the 16 directions above the plane more or less.
      EXPECT_NEAR(seen, 0.5, 0.5 / 16.0 + 1e-6) << sign << " " << height;
    }
  }
}

// At the bottom of a slot in a block most of the sky is hidden.
TEST(TetrahedraRayCastSurfaceShadows, SlotIsDarker)
{
  SurfaceScene drawn(
    20, [](double x, double, double z) { return std::fabs(x) > 0.25 ? z - 0.7 : z + 0.7; }, 1.0,
    0.0);
  const FloatImage image = drawn.Scene.RenderFloat();
  // The bottom, 0.5 wide and 1.4 deep, sees 1/6 of the light of a plane's half of the sky or less:
  // the angle that it sees is 2 atan(0.25 / 1.4) of 180 degrees, and 2 of 16 directions stand for
  // the error of their number.
  EXPECT_LE(image.GetPixel(48, 48)[0], 1.0 / 6.0 + 2.0 / 16.0);
}

TEST(TetrahedraRayCastSurfaceShadows, WorkFollowsChanges)
{
  SurfaceScene drawn(6, BallAndFloor, 0.3, 0.7);
  const auto sun = AddSun(drawn.Scene.GetRenderer(), 1.0, 2.0, 3.0);
  vtkTetrahedraRayCastMapper* mapper = drawn.Scene.GetRayCaster();
  double casts = 0.0;
  const auto expectCasts = [&](double expected, const char* change)
  {
    drawn.Scene.GetWindow()->Render();
    const double now = mapper->GetStatistic("NumberOfShadowCasts");
    EXPECT_EQ(now - casts, expected) << change;
    casts = now;
  };
  constexpr double all = 33.0;
  expectCasts(all, "on");
  drawn.Scene.GetRenderer()->GetActiveCamera()->Azimuth(20.0);
  expectCasts(0.0, "camera");
  sun->SetIntensity(0.5);
  expectCasts(0.0, "intensity");
  sun->SetPosition(3.0, 2.0, 1.0);
  expectCasts(1.0, "place of the light");
  drawn.Property->GetRGBTransferFunction()->AddRGBPoint(0.0, 1.0, 0.5, 0.25);
  expectCasts(0.0, "colour");
  drawn.Property->GetIsoSurfaceValues()->SetValue(0, 0.1);
  expectCasts(all, "isovalue");
  drawn.Property->GetScalarOpacity()->AddPoint(0.1, 0.5);
  expectCasts(all, "opacity");
  mapper->SetBlendMode(0);
  expectCasts(all, "blend mode");
  mapper->SetGlobalIlluminationReach(0.0f);
  expectCasts(0.0, "off");
}

// Independent components have no common gradient: all of their light is scattered.
TEST(TetrahedraRayCastSurfaceShadows, IndependentComponentsHaveClosedForm)
{
  const Grid grid = MakeBlock(8, ConstantField(0.0));
  grid->GetPointData()->SetScalars(
    MakeArray("two", grid->GetNumberOfPoints(), glm::dvec2(1.0, 1.0)));
  constexpr double attenuation = 0.2; // of each component
  const auto property = MakeConstantProperty(1.0, 1.0, 0.5, 0.25, 1.0 / attenuation);
  property->IndependentComponentsOn();
  property->SetColor(1, MakeColors({ { 0.0, 1.0, 0.5, 0.25 } }));
  property->SetScalarOpacity(1, MakeOpacity({ { 0.0, 1.0 } }));
  property->SetScalarOpacityUnitDistance(1, 1.0 / attenuation);
  property->ShadeOn();
  property->SetAmbient(0.0);
  property->SetDiffuse(1.0);
  property->SetSpecular(0.0);
  RayCastScene scene(grid, property, 33, 33);
  scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
  scene.GetRayCaster()->SetEarlyTerminationOpacity(1.0);
  AddSun(scene.GetRenderer(), 0.0, 0.0, 1.0);
  LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), 0);
  const auto observer = ObserveErrors(scene.GetRayCaster());
  const FloatImage image = scene.RenderFloat();
  EXPECT_EQ(observer->GetText(), "");
  const PixelRays rays(scene.GetRenderer());
  int visible = 0;
  for (int y = 0; y < image.Height; ++y)
  {
    const Ray ray = rays.GetRay(16, y);
    const double z = ray.Origin[2];
    if (std::max(std::fabs(ray.Origin[1]), std::fabs(z)) > 0.999)
    {
      continue;
    }
    constexpr double sum = 2.0 * attenuation;
    const double truth = std::exp(-sum * (1.0 - z)) * (1.0 - std::exp(-2.0 * sum));
    // As in the cube of one component: 0.1 is the optical depth of a cell.
    ASSERT_NEAR(image.GetPixel(16, y)[0], truth, 0.1 * 0.1 / 8.0 + 0.1 / 2048.0) << z;
    ASSERT_NEAR(image.GetPixel(16, y)[2], 0.25 * truth, 0.1 * 0.1 / 8.0 + 0.1 / 2048.0) << z;
    ++visible;
  }
  EXPECT_GT(visible, 10);
}

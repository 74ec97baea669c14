// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Volumes through several refracting interfaces, compared with closed forms and with rays that are
// refracted in double precision.
#include "OpticsTruth.h"
#include "StackScene.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 96;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr double Block[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };

double Tolerance()
{
  return BackendUnderTest() == vtkTetrahedraRayCastMapper::NATIVE ? 2e-5 : 1e-4;
}

struct StackTest
{
  std::vector<MembraneCase> Stack;
  RayCastScene Scene;

  StackTest(const std::vector<MembraneCase>& stack, vtkUnstructuredGrid* grid,
    vtkVolumeProperty* property = MakeProperty(FunctionKind::Smooth, Range, 3.4))
    : Stack(stack)
    , Scene(grid, property, Size, Size)
  {
    SetStack(this->Scene.GetRayCaster(), stack);
  }

  TracedComparison ExpectComposite(const std::string& what)
  {
    this->Scene.GetWindow()->Render();
    const auto integrator = MakeReference(this->Scene.MakeGrid());
    const auto function = ToReference(this->Scene.GetVolume()->GetProperty());
    return ExpectTrace(
      this->Scene,
      [&](const Ray& ray)
      {
        return ComposeParts(FindParts(this->Stack, ray, false),
          [&](const Ray& part) { return integrator->Trace(part, function); });
      },
      what, Tolerance());
  }
};

/** A horizontal layer's lower side, and the index of refraction behind it. */
struct Layer
{
  double Level;
  double Index;
};

/**
 * Alpha of the block behind and between horizontal planes, in closed form: n sin(t) is constant,
 * and the attenuation a + b y is linear along each leg, so that its integral is the length of the
 * leg in the block times the value in its middle.
 */
double AlphaOfLayers(const Ray& ray, const std::vector<Layer>& layers, double a, double b)
{
  double place[3];
  double direction[3];
  const double size = std::hypot(ray.Direction[0], ray.Direction[1], ray.Direction[2]);
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = ray.Origin[axis];
    direction[axis] = ray.Direction[axis] / size;
  }
  const double x = direction[0];
  const double z = direction[2];
  double sum = 0.0;
  for (std::size_t k = 0; k <= layers.size(); ++k)
  {
    const bool isLast = k == layers.size();
    const double whole = isLast ? 1e6 : (layers[k].Level - place[1]) / direction[1];
    double begin = 0.0;
    double end = whole;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double first = (-1.0 - place[axis]) / direction[axis];
      const double second = (1.0 - place[axis]) / direction[axis];
      begin = std::max(begin, std::min(first, second));
      end = std::min(end, std::max(first, second));
    }
    if (begin < end)
    {
      sum += (end - begin) * (a + b * (place[1] + 0.5 * (begin + end) * direction[1]));
    }
    for (int axis = 0; axis < 3 && !isLast; ++axis)
    {
      place[axis] += whole * direction[axis];
    }
    if (!isLast)
    {
      direction[0] = x / layers[k].Index;
      direction[2] = z / layers[k].Index;
      direction[1] = -std::sqrt(1.0 - direction[0] * direction[0] - direction[2] * direction[2]);
    }
  }
  return -std::expm1(-sum);
}

/** White, with an attenuation coefficient that is linear in the scalar. */
vtkSmartPointer<vtkVolumeProperty> MakeLinearProperty(double atLowest, double atHighest)
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(MakeColors({ { -1.0, 1.0, 1.0, 1.0 } }));
  property->SetScalarOpacity(MakeOpacity({ { -1.0, atLowest }, { 1.0, atHighest } }));
  property->SetInterpolationTypeToLinear();
  return property;
}

} // anonymous namespace

TEST(TetrahedraRayCastMembraneStack, LayersAreTheClosedForm)
{
  const std::vector<std::vector<Layer>> cases{
    { { 1.6, 1.5 }, { 1.3, 1.0 } },                  // a pane in front of the mesh
    { { 0.4, 1.5 }, { -0.2, 1.0 } },                 // inside
    { { 1.2, 1.5 }, { 0.1, 1.333 } },                // air, glass, water
    { { 1.5, 1.333 }, { 0.3, 1.5 }, { -0.4, 1.1 } }, // three planes
  };
  for (const bool isLinear : { false, true })
  {
    const Grid grid =
      MakeBlock(4, isLinear ? [](double, double y, double) { return y; } : ConstantField(0.5));
    // 0.875 for a constant 0.5; 0.65 + 0.45 y otherwise.
    const double a = isLinear ? 0.65 : 0.875;
    const double b = isLinear ? 0.45 : 0.0;
    for (const std::vector<Layer>& layers : cases)
    {
      std::vector<MembraneCase> stack;
      double before = 1.0;
      for (const Layer& layer : layers)
      {
        stack.push_back(Between(MakePlaneCase(layer.Level, 9.0, 3), before, layer.Index));
        before = layer.Index;
      }
      StackTest test(stack, grid, MakeLinearProperty(0.2, 1.1));
      LookAt(test.Scene.GetRenderer(), Block, 20.0, 40.0);
      ExpectTrace(
        test.Scene,
        [&](const Ray& ray)
        {
          const double alpha = AlphaOfLayers(ray, layers, a, b);
          return std::array<double, 4>{ alpha, alpha, alpha, alpha };
        },
        std::to_string(layers.size()) + " planes from " + std::to_string(layers[0].Level),
        Tolerance());
      EXPECT_EQ(test.Scene.GetRayCaster()->GetActiveBackend(), BackendUnderTest());
      EXPECT_EQ(test.Scene.GetRayCaster()->GetStatistic("NumberOfRaysMissingAnInterface"), 0);
      EXPECT_EQ(test.Scene.GetRayCaster()->GetStatistic("NumberOfTotallyReflectedRays"), 0);
    }
  }
}

TEST(TetrahedraRayCastMembraneStack, GlassBallIsEnteredAndLeft)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  // In front of the mesh, and inside it.
  for (const double level : { 1.7, 0.2 })
  {
    const MembraneCase ball = Between(MakeBallCase({ 0.1, level, 0.05 }, 0.6, 48), 1.0, 1.5);
    StackTest test({ ball, ball }, grid);
    LookAt(test.Scene.GetRenderer(), Block, 30.0, 50.0);
    test.ExpectComposite("ball at " + std::to_string(level));
    EXPECT_EQ(test.Scene.GetRayCaster()->GetStatistic("NumberOfMembraneBuilds"), 1);
    EXPECT_EQ(test.Scene.GetRayCaster()->GetStatistic("NumberOfRaysMissingAnInterface"), 0);
    EXPECT_EQ(test.Scene.GetRayCaster()->GetStatistic("NumberOfTotallyReflectedRays"), 0);
  }
}

TEST(TetrahedraRayCastMembraneStack, BallBehindAPane)
{
  const Grid grid = MakeBlock(6, WavyField(3.0), Torus(0.6, 0.3));
  const MembraneCase ball = Between(MakeBallCase({ 0.1, 0.2, 0.05 }, 0.5, 48), 1.333, 1.5);
  StackTest test({ Between(MakePlaneCase(1.4, 4.0, 3), 1.0, 1.5),
                   Between(MakePlaneCase(1.2, 4.0, 5), 1.5, 1.333), ball, ball },
    grid);
  LookAt(test.Scene.GetRenderer(), Block, 30.0, 60.0);
  test.ExpectComposite("ball behind a pane");
  // Most rays pass the ball and end at the pane.
  EXPECT_GT(test.Scene.GetRayCaster()->GetStatistic("NumberOfRaysMissingAnInterface"), Size);
}

TEST(TetrahedraRayCastMembraneStack, WavesOnGlass)
{
  // Patches interpolate waves, so the error is theirs.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  StackTest test({ Between(MakeWavesCase(1.5, 0.05, 3.0, 4.0, 384), 1.0, 1.333),
                   Between(MakePlaneCase(1.2, 4.0, 3), 1.333, 1.5),
                   Between(MakePlaneCase(1.1, 4.0, 4), 1.5, 1.0) },
    grid);
  LookAt(test.Scene.GetRenderer(), Block, 30.0, 60.0);
  test.ExpectComposite("waves on glass");
}

TEST(TetrahedraRayCastMembraneStack, SmallPaneAndTotalReflection)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  // A pane that covers part of the view: rays beside it are straight, and rays that leave by its
  // edges end there. Behind water, light is reflected at the second face.
  for (const double behind : { 1.0, 1.45 })
  {
    StackTest test({ Between(MakePlaneCase(1.25, 0.7, 3), 1.3, 1.9),
                     Between(MakePlaneCase(1.05, 0.7, 2), 1.9, behind) },
      grid);
    LookAt(test.Scene.GetRenderer(), Block, 30.0, 35.0);
    test.ExpectComposite("small pane, " + std::to_string(behind));
    EXPECT_GT(test.Scene.GetRayCaster()->GetStatistic("NumberOfRaysMissingAnInterface"), 100);
    EXPECT_EQ(
      test.Scene.GetRayCaster()->GetStatistic("NumberOfTotallyReflectedRays") > 100, behind == 1.0);
  }
}

TEST(TetrahedraRayCastMembraneStack, ConcentricDomeIsNotSeen)
{
  RayCastScene scene(
    MakeBlock(6, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  LookAt(scene.GetRenderer(), Block, 30.0, 40.0);
  // In water the mesh is drawn nearer to the eye (Eq. 2.4); the near plane must not cut it.
  scene.GetRenderer()->GetActiveCamera()->SetClippingRange(0.3, 20.0);
  const FloatImage straight = scene.RenderFloat();
  Vector3 eye;
  scene.GetRenderer()->GetActiveCamera()->GetPosition(eye.data());
  // Air, glass, water.
  SetStack(scene.GetRayCaster(),
    { Between(MakeBallCase(eye, 0.4, 64), 1.5, 1.0),
      Between(MakeBallCase(eye, 0.5, 48), 1.333, 1.5) });
  ExpectSamePicture(scene.RenderFloat(), straight, "dome");
  EXPECT_EQ(scene.GetRayCaster()->GetStatistic("NumberOfRaysMissingAnInterface"), 0);
  // Off the centre it is seen.
  SetStack(scene.GetRayCaster(),
    { Between(MakeBallCase({ eye[0] + 0.1, eye[1], eye[2] }, 0.4, 64), 1.5, 1.0),
      Between(MakeBallCase(eye, 0.5, 48), 1.333, 1.5) });
  EXPECT_NE(scene.RenderFloat().Rgba, straight.Rgba);
}

TEST(TetrahedraRayCastMembraneStack, EqualIndicesChangeNothing)
{
  RayCastScene scene(MakeBlock(6, WavyField(3.0), Torus(0.6, 0.3)),
    MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  LookAt(scene.GetRenderer(), Block, 30.0, 40.0);
  const FloatImage straight = scene.RenderFloat();
  const MembraneCase upper = MakePlaneCase(1.3, 4.0, 2);
  const MembraneCase middle = MakePlaneCase(0.1, 4.0, 2);
  const MembraneCase lower = MakePlaneCase(-0.3, 4.0, 2);
  for (const MembraneStack& equal :
    { MembraneStack{ Between(upper, 1.333, 1.333) }, { Between(middle, 1.333, 1.333) },
      { Between(upper, 1.333, 1.333), Between(middle, 1.333, 1.333),
        Between(lower, 1.333, 1.333) } })
  {
    SetStack(mapper, equal);
    EXPECT_EQ(scene.RenderFloat().Rgba, straight.Rgba);
  }
  EXPECT_EQ(mapper->GetStatistic("NumberOfSightUpdates"), 0);
  EXPECT_EQ(mapper->GetStatistic("NumberOfMembraneBuilds"), 0);

  SetStack(mapper, { Between(middle, 1.0, 1.333) });
  const FloatImage refracted = scene.RenderFloat();
  EXPECT_NE(refracted.Rgba, straight.Rgba);
  SetStack(mapper,
    { Between(upper, 1.0, 1.0), Between(middle, 1.0, 1.333), Between(lower, 1.333, 1.333) });
  EXPECT_EQ(scene.RenderFloat().Rgba, refracted.Rgba);

  // Nearly equal indices: the code for refraction runs, but rays keep their direction.
  const double near = 1.0 + 1e-15;
  for (const MembraneStack& nearly :
    { MembraneStack{ Between(upper, 1.0, near) }, { Between(middle, 1.0, near) },
      { Between(middle, 1.0, near), Between(lower, near, 1.0) } })
  {
    SetStack(mapper, nearly);
    ExpectSamePicture(scene.RenderFloat(), straight, "nearly equal indices");
  }
}

TEST(TetrahedraRayCastMembraneStack, VirtualGeometryHidesAndPlanesClip)
{
  // A rectangle across the view, from the front of the first surface to the end of the block. Each
  // length behind the first interface is drawn by the ratio of the indices shorter (Eq. 2.4).
  // Clipping planes are where the mesh is.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  const std::vector<HalfSpace> planes{ { { 0.3, -1.0, 0.2 }, { 0.1, 0.6, 0.0 } },
    { { -2.0, 0.1, 0.7 }, { 0.5, 0.0, 0.1 } } };
  const std::vector<MembraneStack> stacks{ { MakePlaneCase(0.1, 4.0, 2) },
    { MakePlaneCase(1.2, 4.0, 2) },
    { Between(MakePlaneCase(0.5, 4.0, 2), 1.0, 1.5),
      Between(MakePlaneCase(0.0, 4.0, 3), 1.5, 1.333) } };
  for (const auto& [number, offset] :
    Product(Below<std::size_t>(stacks.size()), List(-1.5, -0.7, -0.1, 0.5, 1.6)))
  {
    StackTest test(stacks[number], grid);
    for (const HalfSpace& half : planes)
    {
      AddClippingPlane(test.Scene.GetRayCaster(), half);
    }
    LookAt(test.Scene.GetRenderer(), Block, 30.0, 50.0);
    test.Scene.GetWindow()->Render();
    const double depth = AddBlackSquare(test.Scene.GetRenderer(), offset);
    const auto integrator = MakeReference(grid);
    const auto function = ToReference(test.Scene.GetVolume()->GetProperty());
    ExpectTrace(
      test.Scene,
      [&](const Ray& ray)
      {
        Ray ended = ray;
        ended.End = depth;
        std::array<double, 4> color = ComposeParts(FindParts(test.Stack, ended, true),
          [&](const Ray& part)
          {
            const Ray clipped = ClipRay(part, planes);
            return clipped.Begin < clipped.End ? integrator->Trace(clipped, function)
                                               : std::array<double, 4>{ 0.0, 0.0, 0.0, 0.0 };
          });
        color[3] = 1.0;
        return color;
      },
      "rectangle at " + std::to_string(offset) + ", list " + std::to_string(number), Tolerance());
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces, lighting of surfaces and of the medium, gradient opacity.
#include "HardMeshes.h"
#include "MembraneScene.h"
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -1.0, 1.0 };
// Midpoints per piece of the reference: its error decreases with the square, and is 3e-4 with 8.
constexpr int Steps = 40;

// A headlight, a coloured directional light and a spot light near the mesh.
void AddLights(vtkRenderer* renderer)
{
  vtkNew<vtkLight> head;
  head->SetLightTypeToHeadlight();
  head->SetIntensity(0.5);
  renderer->AddLight(head);
  vtkNew<vtkLight> side;
  side->SetLightTypeToSceneLight();
  side->SetPosition(4.0, 2.0, 1.0);
  side->SetFocalPoint(0.0, 0.0, 0.0);
  side->SetDiffuseColor(1.0, 0.6, 0.2);
  side->SetSpecularColor(0.3, 0.6, 1.0);
  renderer->AddLight(side);
  vtkNew<vtkLight> spot;
  spot->SetLightTypeToSceneLight();
  spot->SetPositional(1);
  spot->SetPosition(-2.0, 2.0, 2.5);
  spot->SetFocalPoint(0.0, 0.0, 0.0);
  spot->SetConeAngle(20.0);
  spot->SetExponent(2.0);
  spot->SetAttenuationValues(0.5, 0.1, 0.05);
  renderer->AddLight(spot);
  vtkNew<vtkLight> off;
  off->SetSwitch(0);
  renderer->AddLight(off);
}

vtkSmartPointer<vtkVolumeProperty> SurfaceProperty(bool shade)
{
  auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  SetMaterial(property, shade);
  const double values[5] = { 0.45, -0.3, 0.1, 0.1, 55.0 };
  for (int i = 0; i < 5; ++i)
  {
    property->GetIsoSurfaceValues()->SetValue(i, values[i]);
  }
  return property;
}

struct ShadingTruth
{
  std::unique_ptr<ReferenceRayIntegrator> Integrator;
  std::unique_ptr<ReferenceGradients> Gradients;
  Material Light;

  explicit ShadingTruth(RayCastScene& scene)
  {
    scene.GetWindow()->Render();
    this->Integrator = MakeReference(scene.MakeGrid(), scene.GetVolume()->GetMatrix());
    const bool smooth =
      scene.GetRayCaster()->GetGradients() == vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS;
    this->Gradients = std::make_unique<ReferenceGradients>(this->Integrator->MakeMesh(), smooth);
    this->Light = ToMaterial(scene.GetVolume()->GetProperty(), scene.GetRenderer());
  }
};

void ExpectSurfaces(RayCastScene& scene, const std::string& what)
{
  const ShadingTruth truth(scene);
  std::vector<Surface> surfaces = ToSurfaces(scene.GetVolume()->GetProperty());
  // Two equal values are blended as one.
  const auto same = [](const Surface& a, const Surface& b) { return a.Scalar == b.Scalar; };
  std::sort(surfaces.begin(), surfaces.end(),
    [](const Surface& a, const Surface& b) { return a.Scalar < b.Scalar; });
  surfaces.erase(std::unique(surfaces.begin(), surfaces.end(), same), surfaces.end());
  const bool lit = scene.GetVolume()->GetProperty()->GetShade() != 0;
  ExpectTrace(
    scene,
    [&](const Ray& ray)
    {
      std::vector<RaySegment> segments;
      truth.Integrator->FindSegments(ray, segments);
      return BlendSurfaces(
        ray, segments, surfaces, lit ? truth.Gradients.get() : nullptr, truth.Light);
    },
    what);
}

double GradientFactor(double size)
{
  return std::min(std::max((size - 0.5) / 2.0, 0.0), 1.0) * 0.9 + 0.05;
}

void ExpectShadedMedium(RayCastScene& scene, bool factor, double tolerance, const std::string& what)
{
  const ShadingTruth truth(scene);
  const auto function = ToReference(scene.GetVolume()->GetProperty());
  const bool lit = scene.GetVolume()->GetProperty()->GetShade() != 0;
  ExpectTrace(
    scene,
    [&](const Ray& ray)
    {
      std::vector<RaySegment> segments;
      truth.Integrator->FindSegments(ray, segments);
      return IntegrateShaded(ray, segments, function, *truth.Gradients,
        lit ? &truth.Light : nullptr, factor ? GradientFactor : std::function<double(double)>(),
        Steps);
    },
    what, tolerance);
}

// Comparison where the medium's lighting is not exact.
TracedComparison CompareShadedMedium(RayCastScene& scene, const MembraneCase& membrane)
{
  scene.GetRayCaster()->SetMembraneData(membrane.Mesh);
  const ShadingTruth truth(scene);
  const auto function = ToReference(scene.GetVolume()->GetProperty());
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  return CompareToTrace(image, rays,
    membrane.BendMembrane(
      [&](const Ray& ray)
      {
        std::vector<RaySegment> segments;
        truth.Integrator->FindSegments(ray, segments);
        return IntegrateShaded(
          ray, segments, function, *truth.Gradients, &truth.Light, GradientFactor, 8);
      }),
    1.0, 0.0);
}

vtkSmartPointer<vtkVolumeProperty> MediumProperty(bool shade, bool factor)
{
  auto property = SurfaceProperty(shade);
  if (factor)
  {
    property->SetGradientOpacity(
      MakeOpacity({ { 0.5, GradientFactor(0.5) }, { 2.5, GradientFactor(2.5) } }));
  }
  return property;
}

} // anonymous namespace

TEST(TetrahedraRayCastIsosurfaces, PlanesOfALinearField)
{
  // Isosurfaces of x in the box are squares that face the viewer, who looks along x: the headlight
  // gives ambient + diffuse of the colour plus specular, at the angle of the ray.
  const Grid grid = MakeBlock(5, LinearField(1.0, 0.0, 0.0));
  for (const int gradients : { 0, 1 })
  {
    RayCastScene scene(grid, SurfaceProperty(true), Size, Size);
    scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    scene.GetRayCaster()->SetGradients(gradients);
    LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), 0);
    const std::vector<Surface> surfaces = ToSurfaces(scene.GetVolume()->GetProperty());
    ExpectTrace(
      scene,
      [&surfaces](const Ray& ray)
      {
        std::array<double, 4> color{ 0.0, 0.0, 0.0, 0.0 };
        if (std::fabs(ray.Origin[1]) > 1.0 || std::fabs(ray.Origin[2]) > 1.0)
        {
          return color;
        }
        for (const int i : { 0, 2, 1 }) // 0.45, 0.1, -0.3
        {
          const double share = (1.0 - color[3]) * surfaces[i].Alpha;
          for (int c = 0; c < 3; ++c)
          {
            color[c] += share * ((0.2 + 0.6) * surfaces[i].Color[c] + 0.4);
          }
          color[3] += share;
        }
        return color;
      },
      gradients ? "vertex gradients" : "cell gradients");
  }
}

TEST(TetrahedraRayCastIsosurfaces, SeveralTransparentSurfaces)
{
  for (const auto& [shade, gradients] : Product(List(false, true), List(0, 1)))
  {
    RayCastScene scene(MakeBlock(8, WavyField(3.0), gradients ? Region() : Torus(0.6, 0.35)),
      SurfaceProperty(shade), Size, Size);
    scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    scene.GetRayCaster()->SetGradients(gradients);
    AddLights(scene.GetRenderer());
    ExpectSurfaces(scene,
      std::string(shade ? "lit, " : "unlit, ") + (gradients ? "vertex" : "cell") + " gradients");
  }
}

TEST(TetrahedraRayCastIsosurfaces, TransformedVolumeAndClippedRange)
{
  RayCastScene scene(MakeBlock(6, WavyField(3.0)), SurfaceProperty(true), Size, Size);
  scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  scene.GetVolume()->SetScale(-0.7, 1.5, 1.0);
  scene.GetVolume()->RotateWXYZ(37.0, 0.3, 1.0, 0.2);
  AddLights(scene.GetRenderer());
  LookAt(scene.GetRenderer(), scene.GetVolume()->GetBounds(), 30.0, 20.0);
  ExpectSurfaces(scene, "mirrored and stretched");
}

// Isovalue 0 of a block with scalar x runs through vertices and along faces: a ray along x meets it
// once, whatever it passes. Rays in the surface, along y, do not meet it, nor do rays next to it;
// where the scene is turned, rounding decides about rays in the surface, and they are left out.
void ExpectMetOnce(const Grid& grid, vtkTransform* turn, const std::string& words)
{
  auto property = MakeConstantProperty(0.25, 1, 1, 1, 1.0);
  property->GetIsoSurfaceValues()->SetValue(0, 0.0);
  for (const int axis : { 0, 1 })
  {
    if (turn && axis == 1)
    {
      continue;
    }
    RayCastScene scene(grid, property, Size + 1, Size + 1);
    scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), axis);
    const PixelRays rays(scene.GetRenderer());
    if (turn)
    {
      scene.GetVolume()->SetUserTransform(turn);
      scene.GetRenderer()->GetActiveCamera()->ApplyTransform(turn);
    }
    const FloatImage image = scene.RenderFloat();
    for (const auto& [y, x] : Product(image.Height, image.Width))
    {
      const Ray ray = rays.GetRay(x, y);
      const bool met =
        axis == 0 && std::fabs(ray.Origin[1]) < 0.999 && std::fabs(ray.Origin[2]) < 0.999;
      if (met)
      {
        EXPECT_FLOAT_EQ(image.GetPixel(x, y)[3], 0.25f) << words << ": " << x << ", " << y;
      }
      else if (axis == 1)
      {
        EXPECT_EQ(image.GetPixel(x, y)[3], 0.0f) << words << ": " << x << ", " << y;
      }
    }
  }
}

TEST(TetrahedraRayCastIsosurfaces, ValueOfVerticesIsMetOnce)
{
  const Field field = LinearField(1.0, 0.0, 0.0);
  for (const int n : { 2, 4, 6, 8, 10, 16 })
  {
    ExpectMetOnce(MakeBlock(n, field), nullptr, std::to_string(n) + " cubes");
  }
  const Grid grid = MakeBlock(4, field);
  for (std::uint64_t seed = 0; seed < 4; ++seed)
  {
    RandomNumbers random(seed);
    ExpectMetOnce(MakeScrambled(grid, field, random), nullptr, "order " + std::to_string(seed));
    const glm::dvec3 axis = random.GetDirection();
    vtkNew<vtkTransform> turn;
    turn->RotateWXYZ(random.Uniform(10.0, 170.0), axis.x, axis.y, axis.z);
    ExpectMetOnce(grid, turn, "turn " + std::to_string(seed));
  }
}

// Cells are above or below the plane z = 0, on which the isosurface of their scalars is. Rays
// through vertices and along edges pass cells in a point; the surface has its own normal and light
// there, too, and not those of a face inside the mesh.
TEST(TetrahedraRayCastIsosurfaces, FacesOfCellDataAreLitAlikeOnEdges)
{
  const Grid grid = MakeBlock(4, ConstantField(0.0));
  grid->GetPointData()->SetScalars(nullptr);
  grid->GetCellData()->SetScalars(MakeArray("heights", grid->GetNumberOfCells(),
    [&](vtkIdType cell)
    {
      double bounds[6];
      grid->GetCellBounds(cell, bounds);
      return 0.5 * (bounds[4] + bounds[5]);
    }));
  auto property = MakeConstantProperty(1.0, 1, 1, 1, 1.0);
  property->GetIsoSurfaceValues()->SetValue(0, 0.0);
  property->ShadeOn();
  property->SetAmbient(0.0);
  property->SetDiffuse(1.0);
  property->SetSpecular(0.0);
  constexpr int size = 33;
  struct View
  {
    Vector3 ToCamera;
    Vector3 Up;
  };
  const std::vector<View> views = { { { 0, 0, 1 }, { 0, 1, 0 } }, { { 0, 0, -1 }, { 0, 1, 0 } },
    { { 1, 0, 1 }, { 0, 1, 0 } }, { { 0, 1, -1 }, { 1, 0, 0 } }, { { 1, 1, 1 }, { 1, -1, 0 } },
    { { -1, -1, -1 }, { 1, -1, 0 } }, { { -1, 1, 1 }, { 0, 1, -1 } },
    { { 1, -1, -1 }, { 0, 1, -1 } }, { { 1, 2, 2 }, { 0, 1, -1 } } };
  for (const auto& [view, reach] : Product(views, List(0.0f, 1.0f)))
  {
    const Vector3& toCamera = view.ToCamera;
    RayCastScene scene(grid, property, size, size);
    scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    scene.GetRayCaster()->SetScalarModeToUseCellData();
    scene.GetRayCaster()->SetGlobalIlluminationReach(reach);
    vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetPosition(5.0 * toCamera[0], 5.0 * toCamera[1], 5.0 * toCamera[2]);
    camera->SetViewUp(view.Up.data());
    // Pixels are a quarter of a cube's edge apart: along an axis, many rays meet vertices.
    camera->SetParallelScale(0.5 * size * 0.125);
    scene.GetRenderer()->ResetCameraClippingRange();
    const double facing = std::fabs(toCamera[2]) / MakeLength(toCamera);
    const PixelRays rays(scene.GetRenderer());
    const FloatImage image = scene.RenderFloat();
    int met = 0;
    for (const auto& [y, x] : Product(image.Height, image.Width))
    {
      const Ray ray = rays.GetRay(x, y);
      const double at = -ray.Origin[2] / ray.Direction[2];
      const auto along = [&](int axis)
      { return std::fabs(ray.Origin[axis] + at * ray.Direction[axis]); };
      if (along(0) < 0.999 && along(1) < 0.999)
      {
        ++met;
        EXPECT_NEAR(image.GetPixel(x, y)[0], facing, 1.0e-4)
          << toCamera[0] << toCamera[1] << toCamera[2] << ", reach " << reach << ": " << x << ", "
          << y;
      }
    }
    EXPECT_GT(met, 100);
  }
}

TEST(TetrahedraRayCastIsosurfaces, NoValues)
{
  RayCastScene scene(
    MakeBlock(3, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  scene.GetVolume()->GetProperty()->GetIsoSurfaceValues()->SetNumberOfContours(0);
  scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  for (const float value : scene.RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
}

TEST(TetrahedraRayCastShading, CellGradientsAreExact)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const bool factor : { false, true })
  {
    RayCastScene scene(grid, MediumProperty(true, factor), 72, 72);
    scene.GetRayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
    AddParallelLight(scene.GetRenderer(), 4.0, 2.0, 1.0)->SetDiffuseColor(1.0, 0.6, 0.2);
    ExpectShadedMedium(scene, factor, FloatTolerance, factor ? "with factor" : "shading");
  }
}

TEST(TetrahedraRayCastShading, GradientOpacityAlone)
{
  RayCastScene scene(MakeBlock(6, WavyField(3.0)), MediumProperty(false, true), 72, 72);
  scene.GetRayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
  scene.GetVolume()->SetScale(0.5, 1.0, 2.0);
  LookAt(scene.GetRenderer(), scene.GetVolume()->GetBounds(), 30.0, 20.0);
  ExpectShadedMedium(scene, true, FloatTolerance, "scaled volume");
}

TEST(TetrahedraRayCastShading, GradientOpacityWithoutPointsHidesAll)
{
  // A function without points evaluates to 0, for gradient opacity as for scalar opacity.
  const Grid grid = MakeBlock(4, WavyField(3.0));
  for (const auto& [gradients, shade] : Product(List(0, 1), List(false, true)))
  {
    RayCastScene scene(grid, MediumProperty(shade, false), 64, 64);
    scene.GetRayCaster()->SetGradients(gradients);
    const FloatImage without = scene.RenderFloat();
    vtkNew<vtkPiecewiseFunction> empty;
    scene.GetVolume()->GetProperty()->SetGradientOpacity(empty);
    const FloatImage hidden = scene.RenderFloat();
    EXPECT_EQ(std::count(hidden.Rgba.begin(), hidden.Rgba.end(), 0.0f),
      static_cast<std::ptrdiff_t>(hidden.Rgba.size()));
    scene.GetVolume()->GetProperty()->SetGradientOpacity(MakeOpacity({ { 0.0, 1.0 } }));
    ExpectSamePicture(scene.RenderFloat(), without, "a factor of 1");
    scene.GetVolume()->GetProperty()->SetGradientOpacity(empty);
    scene.GetVolume()->GetProperty()->SetDisableGradientOpacity(1);
    ExpectSamePicture(scene.RenderFloat(), without, "switched off");
  }
}

TEST(TetrahedraRayCastShading, VertexGradientsComeCloserOnFinerMeshes)
{
  // Lighting is linear between the ends of a cell's segment, which differs from lighting by the
  // interpolated normal inside, most of all where the gradient reverses.
  double last = 0.0;
  for (const int cubes : { 4, 8, 16 })
  {
    RayCastScene scene(MakeBlock(cubes, WavyField(2.0)), MediumProperty(true, true), 64, 64);
    AddParallelLight(scene.GetRenderer(), 4.0, 2.0, 1.0);
    const TracedComparison comparison = CompareShadedMedium(scene, MembraneCase());
    RecordProperty("cubes" + std::to_string(cubes), comparison.GetText());
    EXPECT_TRUE(last == 0.0 || comparison.Rms < 0.75 * last) << comparison.Rms << " after " << last;
    last = comparison.Rms;
  }
  EXPECT_LT(last, 0.002);
}

TEST(TetrahedraRayCastShading, ThroughAMembrane)
{
  // Lights near and far with gradients of vertices: the error is as without a membrane.
  const Grid grid = MakeBlock(16, WavyField(2.0));
  RayCastScene scene(grid, MediumProperty(true, true), 64, 64);
  AddLights(scene.GetRenderer());
  LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 50.0);
  const TracedComparison straight = CompareShadedMedium(scene, MembraneCase());
  for (const MembraneCase& membrane :
    { MakePlaneCase(0.1, 4.0, 2), MakeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    const TracedComparison refracted = CompareShadedMedium(scene, membrane);
    RecordProperty("lit", refracted.GetText());
    EXPECT_GT(refracted.Visible, 1000u);
    EXPECT_LT(refracted.Rms, 1.5 * straight.Rms)
      << refracted.GetText() << "; straight " << straight.GetText();
    EXPECT_LT(refracted.Rms, 0.002) << refracted.GetText();
  }
}

TEST(TetrahedraRayCastShading, GradientsAreComputedOnlyForLight)
{
  const Grid grid = MakeBlock(4, WavyField(3.0));
  RayCastScene scene(grid, MediumProperty(false, false), 64, 64);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  for (const int mode : AllBlendModes())
  {
    mapper->SetBlendMode(mode);
    scene.GetWindow()->Render();
  }
  EXPECT_EQ(mapper->GetStatistic("NumberOfGradientBuilds"), 0);
  mapper->SetBlendModeToComposite();
  scene.GetVolume()->GetProperty()->ShadeOn();
  mapper->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfGradientBuilds"), 0);
  mapper->SetGradients(vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS);
  scene.GetWindow()->Render();
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfGradientBuilds"), 1);
  grid->GetPointData()->GetScalars()->SetComponent(0, 0, 0.5);
  grid->GetPointData()->GetScalars()->Modified();
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetStatistic("NumberOfGradientBuilds"), 2);
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
}

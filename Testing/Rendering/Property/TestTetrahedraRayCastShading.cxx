// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces, lighting of surfaces and of the medium, gradient opacity.
#include "MembraneScene.h"
#include "OpticsTruth.h"

#include <vtkContourValues.h>
#include <vtkLight.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 160;
constexpr double Range[2] = { -1.0, 1.0 };
// Midpoints per piece of the reference: its error decreases with the square, and is 3e-4 with 8.
constexpr int Steps = 40;

// A headlight, a coloured directional light and a spot light near the mesh.
void addLights(vtkRenderer* renderer)
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

vtkSmartPointer<vtkVolumeProperty> surfaceProperty(bool shade)
{
  auto property = makeProperty(FunctionKind::Smooth, Range, 3.4);
  property->SetShade(shade);
  property->SetAmbient(0.2);
  property->SetDiffuse(0.6);
  property->SetSpecular(0.4);
  property->SetSpecularPower(12.0);
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
    scene.window()->Render();
    this->Integrator = makeReference(scene.grid(), scene.volume()->GetMatrix());
    const bool smooth =
      scene.rayCaster()->GetGradients() == vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS;
    this->Gradients = std::make_unique<ReferenceGradients>(this->Integrator->mesh(), smooth);
    this->Light = toMaterial(scene.volume()->GetProperty(), scene.renderer());
  }
};

void expectSurfaces(RayCastScene& scene, const std::string& what)
{
  const ShadingTruth truth(scene);
  std::vector<Surface> surfaces = toSurfaces(scene.volume()->GetProperty());
  // Two equal values are blended as one.
  const auto same = [](const Surface& a, const Surface& b) { return a.Scalar == b.Scalar; };
  std::sort(surfaces.begin(), surfaces.end(),
    [](const Surface& a, const Surface& b) { return a.Scalar < b.Scalar; });
  surfaces.erase(std::unique(surfaces.begin(), surfaces.end(), same), surfaces.end());
  const bool lit = scene.volume()->GetProperty()->GetShade() != 0;
  expectTrace(
    scene,
    [&](const Ray& ray)
    {
      std::vector<RaySegment> segments;
      truth.Integrator->findSegments(ray, segments);
      return blendSurfaces(
        ray, segments, surfaces, lit ? truth.Gradients.get() : nullptr, truth.Light);
    },
    what);
}

double gradientFactor(double size)
{
  return std::min(std::max((size - 0.5) / 2.0, 0.0), 1.0) * 0.9 + 0.05;
}

void expectShadedMedium(RayCastScene& scene, bool factor, double tolerance, const std::string& what)
{
  const ShadingTruth truth(scene);
  const auto function = toReference(scene.volume()->GetProperty());
  const bool lit = scene.volume()->GetProperty()->GetShade() != 0;
  expectTrace(
    scene,
    [&](const Ray& ray)
    {
      std::vector<RaySegment> segments;
      truth.Integrator->findSegments(ray, segments);
      return integrateShaded(ray, segments, function, *truth.Gradients,
        lit ? &truth.Light : nullptr, factor ? gradientFactor : std::function<double(double)>(),
        Steps);
    },
    what, tolerance);
}

// Comparison where the medium's lighting is not exact.
TracedComparison compareShadedMedium(RayCastScene& scene, const MembraneCase& membrane)
{
  scene.rayCaster()->SetMembraneData(membrane.Mesh);
  const ShadingTruth truth(scene);
  const auto function = toReference(scene.volume()->GetProperty());
  const FloatImage image = scene.renderFloat();
  const PixelRays rays(scene.renderer());
  return compareToTrace(image, rays,
    membrane.bend(
      [&](const Ray& ray)
      {
        std::vector<RaySegment> segments;
        truth.Integrator->findSegments(ray, segments);
        return integrateShaded(
          ray, segments, function, *truth.Gradients, &truth.Light, gradientFactor, 8);
      }),
    1.0, 0.0);
}

vtkSmartPointer<vtkVolumeProperty> mediumProperty(bool shade, bool factor)
{
  auto property = surfaceProperty(shade);
  if (factor)
  {
    vtkNew<vtkPiecewiseFunction> function;
    function->AddPoint(0.5, gradientFactor(0.5));
    function->AddPoint(2.5, gradientFactor(2.5));
    property->SetGradientOpacity(function);
  }
  return property;
}

} // anonymous namespace

TEST(TetrahedraRayCastIsosurfaces, PlanesOfALinearField)
{
  // Isosurfaces of x in the box are squares that face the viewer, who looks along x: the headlight
  // gives ambient + diffuse of the colour plus specular, at the angle of the ray.
  const Grid grid = makeBlock(5, linearField(1.0, 0.0, 0.0));
  for (const int gradients : { 0, 1 })
  {
    RayCastScene scene(grid, surfaceProperty(true), Size, Size);
    scene.rayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    scene.rayCaster()->SetGradients(gradients);
    lookAlongAxis(scene.renderer(), grid->GetBounds(), 0);
    const std::vector<Surface> surfaces = toSurfaces(scene.volume()->GetProperty());
    expectTrace(
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
  for (const bool shade : { false, true })
  {
    for (const int gradients : { 0, 1 })
    {
      const Grid grid = makeBlock(8, wavyField(3.0), gradients ? Region() : torus(0.6, 0.35));
      RayCastScene scene(grid, surfaceProperty(shade), Size, Size);
      scene.rayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
      scene.rayCaster()->SetGradients(gradients);
      addLights(scene.renderer());
      lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
      expectSurfaces(scene,
        std::string(shade ? "lit, " : "unlit, ") + (gradients ? "vertex" : "cell") + " gradients");
    }
  }
}

TEST(TetrahedraRayCastIsosurfaces, TransformedVolumeAndClippedRange)
{
  const Grid grid = makeBlock(6, wavyField(3.0));
  RayCastScene scene(grid, surfaceProperty(true), Size, Size);
  scene.rayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  scene.volume()->SetScale(-0.7, 1.5, 1.0);
  scene.volume()->RotateWXYZ(37.0, 0.3, 1.0, 0.2);
  addLights(scene.renderer());
  lookAt(scene.renderer(), scene.volume()->GetBounds(), 30.0, 20.0);
  expectSurfaces(scene, "mirrored and stretched");
}

TEST(TetrahedraRayCastIsosurfaces, ValueOfVerticesIsMetOnce)
{
  // Isovalue 0 runs through vertices and along faces: a ray meets it once, whatever it passes.
  const Grid grid = makeBlock(4, linearField(1.0, 0.0, 0.0));
  auto property = makeConstantProperty(0.25, 1, 1, 1, 1.0);
  property->GetIsoSurfaceValues()->SetValue(0, 0.0);
  for (const int axis : { 0, 1 })
  {
    RayCastScene scene(grid, property, Size + 1, Size + 1);
    scene.rayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    lookAlongAxis(scene.renderer(), grid->GetBounds(), axis);
    const FloatImage image = scene.renderFloat();
    const PixelRays rays(scene.renderer());
    for (int y = 0; y < image.Height; ++y)
    {
      for (int x = 0; x < image.Width; ++x)
      {
        const Ray ray = rays.ray(x, y);
        const bool met =
          axis == 0 && std::fabs(ray.Origin[1]) < 0.999 && std::fabs(ray.Origin[2]) < 0.999;
        if (met)
        {
          ASSERT_FLOAT_EQ(image.pixel(x, y)[3], 0.25f) << x << ", " << y;
        }
        else if (axis == 1)
        {
          // Rays inside the surface do not meet it, nor do rays next to it.
          ASSERT_EQ(image.pixel(x, y)[3], 0.0f) << x << ", " << y;
        }
      }
    }
  }
}

TEST(TetrahedraRayCastIsosurfaces, NoValues)
{
  const Grid grid = makeBlock(3, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  scene.volume()->GetProperty()->GetIsoSurfaceValues()->SetNumberOfContours(0);
  scene.rayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  for (const float value : scene.renderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
}

TEST(TetrahedraRayCastShading, CellGradientsAreExact)
{
  const Grid grid = makeBlock(6, wavyField(3.0));
  for (const bool factor : { false, true })
  {
    RayCastScene scene(grid, mediumProperty(true, factor), 72, 72);
    scene.rayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(4.0, 2.0, 1.0);
    light->SetDiffuseColor(1.0, 0.6, 0.2);
    scene.renderer()->AddLight(light);
    lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
    expectShadedMedium(scene, factor, FloatTolerance, factor ? "with factor" : "shading");
  }
}

TEST(TetrahedraRayCastShading, GradientOpacityAlone)
{
  const Grid grid = makeBlock(6, wavyField(3.0));
  RayCastScene scene(grid, mediumProperty(false, true), 72, 72);
  scene.rayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
  scene.volume()->SetScale(0.5, 1.0, 2.0);
  lookAt(scene.renderer(), scene.volume()->GetBounds(), 30.0, 20.0);
  expectShadedMedium(scene, true, FloatTolerance, "scaled volume");
}

TEST(TetrahedraRayCastShading, GradientOpacityWithoutPointsHidesAll)
{
  // A function without points evaluates to 0, for gradient opacity as for scalar opacity.
  const Grid grid = makeBlock(4, wavyField(3.0));
  for (const int gradients : { 0, 1 })
  {
    for (const bool shade : { false, true })
    {
      RayCastScene scene(grid, mediumProperty(shade, false), 64, 64);
      scene.rayCaster()->SetGradients(gradients);
      lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
      const FloatImage without = scene.renderFloat();
      vtkNew<vtkPiecewiseFunction> empty;
      scene.volume()->GetProperty()->SetGradientOpacity(empty);
      const FloatImage hidden = scene.renderFloat();
      EXPECT_EQ(std::count(hidden.Rgba.begin(), hidden.Rgba.end(), 0.0f),
        static_cast<std::ptrdiff_t>(hidden.Rgba.size()));
      vtkNew<vtkPiecewiseFunction> one;
      one->AddPoint(0.0, 1.0);
      scene.volume()->GetProperty()->SetGradientOpacity(one);
      expectSamePicture(scene.renderFloat(), without, "a factor of 1");
      scene.volume()->GetProperty()->SetGradientOpacity(empty);
      scene.volume()->GetProperty()->SetDisableGradientOpacity(1);
      expectSamePicture(scene.renderFloat(), without, "switched off");
    }
  }
}

TEST(TetrahedraRayCastShading, VertexGradientsComeCloserOnFinerMeshes)
{
  // Lighting is linear between the ends of a cell's segment, which differs from lighting by the
  // interpolated normal inside, most of all where the gradient reverses.
  double last = 0.0;
  for (const int cubes : { 4, 8, 16 })
  {
    const Grid grid = makeBlock(cubes, wavyField(2.0));
    RayCastScene scene(grid, mediumProperty(true, true), 64, 64);
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(4.0, 2.0, 1.0);
    scene.renderer()->AddLight(light);
    lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
    const TracedComparison comparison = compareShadedMedium(scene, MembraneCase());
    RecordProperty("cubes" + std::to_string(cubes), comparison.text());
    EXPECT_TRUE(last == 0.0 || comparison.Rms < 0.75 * last) << comparison.Rms << " after " << last;
    last = comparison.Rms;
  }
  EXPECT_LT(last, 0.002);
}

TEST(TetrahedraRayCastShading, ThroughAMembrane)
{
  // Lights near and far with gradients of vertices: the error is as without a membrane.
  const Grid grid = makeBlock(16, wavyField(2.0));
  RayCastScene scene(grid, mediumProperty(true, true), 64, 64);
  addLights(scene.renderer());
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 50.0);
  const TracedComparison straight = compareShadedMedium(scene, MembraneCase());
  for (const MembraneCase& membrane :
    { makePlaneCase(0.1, 4.0, 2), makeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    const TracedComparison refracted = compareShadedMedium(scene, membrane);
    RecordProperty("lit", refracted.text());
    EXPECT_GT(refracted.Visible, 1000u);
    EXPECT_LT(refracted.Rms, 1.5 * straight.Rms)
      << refracted.text() << "; straight " << straight.text();
    EXPECT_LT(refracted.Rms, 0.002) << refracted.text();
  }
}

TEST(TetrahedraRayCastShading, GradientsAreComputedOnlyForLight)
{
  const Grid grid = makeBlock(4, wavyField(3.0));
  RayCastScene scene(grid, mediumProperty(false, false), 64, 64);
  vtkTetrahedraRayCastMapper* mapper = scene.rayCaster();
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  for (const int mode : { 0, 1, 2, 3, 4, 5 })
  {
    mapper->SetBlendMode(mode);
    scene.window()->Render();
  }
  EXPECT_EQ(mapper->GetNumberOfGradientBuilds(), 0);
  mapper->SetBlendModeToComposite();
  scene.volume()->GetProperty()->ShadeOn();
  mapper->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfGradientBuilds(), 0);
  mapper->SetGradients(vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS);
  scene.window()->Render();
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfGradientBuilds(), 1);
  grid->GetPointData()->GetScalars()->SetComponent(0, 0, 0.5);
  grid->GetPointData()->GetScalars()->Modified();
  scene.window()->Render();
  EXPECT_EQ(mapper->GetNumberOfGradientBuilds(), 2);
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
}

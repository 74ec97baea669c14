// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Compute and fragment shaders consist of the same functions and give the same image.
#include "MembraneScene.h"
#include "RayCastScene.h"

#include <vtkCamera.h>
#include <vtkContourValues.h>
#include <vtkLight.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -1.0, 1.0 };
// Largest difference in float between runs of the ray caster.
constexpr double Agreement = 2e-5;

vtkSmartPointer<vtkVolumeProperty> litProperty()
{
  auto property = makeProperty(FunctionKind::Smooth, Range, 3.4);
  property->ShadeOn();
  property->SetSpecular(0.4);
  vtkNew<vtkPiecewiseFunction> factor;
  factor->AddPoint(0.0, 0.2);
  factor->AddPoint(3.0, 1.0);
  property->SetGradientOpacity(factor);
  property->GetIsoSurfaceValues()->SetValue(0, 0.2);
  property->GetIsoSurfaceValues()->SetValue(1, -0.2);
  return property;
}

// Two lights that depend on the position, one of them a cone with a fractional exponent.
void addLights(vtkRenderer* renderer)
{
  vtkNew<vtkLight> head;
  head->SetLightTypeToHeadlight();
  head->SetIntensity(0.5);
  renderer->AddLight(head);
  for (const double exponent : { 0.0, 2.5 })
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPositional(1);
    light->SetPosition(exponent - 2.0, 2.0, 2.5);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetConeAngle(exponent > 0.0 ? 30.0 : 180.0);
    light->SetExponent(exponent);
    light->SetAttenuationValues(0.5, 0.1, 0.05);
    light->SetDiffuseColor(1.0, 0.6, 0.2);
    renderer->AddLight(light);
  }
}

bool hasCompute(vtkRenderWindow* window)
{
  const std::string device = deviceName(window);
  const std::size_t at = device.rfind(", ");
  int version[2] = { 0, 0 };
  return at != std::string::npos &&
    std::sscanf(device.c_str() + at + 2, "%d.%d", &version[0], &version[1]) == 2 &&
    version[0] * 10 + version[1] >= 43;
}

void expectAgreement(RayCastScene& scene, int backend, const std::string& what)
{
  vtkTetrahedraRayCastMapper* mapper = scene.rayCaster();
  // Inside the mesh, rays behind a membrane may begin in one cell or its neighbour.
  const bool sameSteps =
    backend != vtkTetrahedraRayCastMapper::NATIVE || mapper->GetMembrane() == nullptr;
  mapper->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const FloatImage fragment = scene.renderFloat();
  const vtkTypeInt64 steps = mapper->GetNumberOfTraversalSteps();
  mapper->SetBackend(backend);
  const FloatImage other = scene.renderFloat();
  EXPECT_EQ(mapper->GetActiveBackend(), backend) << what;
  const double difference =
    std::fabs(static_cast<double>(mapper->GetNumberOfTraversalSteps() - steps));
  EXPECT_LE(difference, sameSteps ? 0.0 : 0.02 * static_cast<double>(steps)) << what;
  EXPECT_EQ(mapper->GetNumberOfLostRays(), 0) << what;
  double largest = 0.0;
  double brightest = 0.0;
  for (std::size_t i = 0; i < fragment.Rgba.size(); ++i)
  {
    const double d = std::fabs(fragment.Rgba[i] - other.Rgba[i]);
    largest = d <= largest ? largest : d;
    brightest = std::max(brightest, static_cast<double>(fragment.Rgba[i]));
  }
  EXPECT_GT(brightest, 0.1) << what;
  EXPECT_LE(largest, Agreement) << what;
}

void expectAgreementOfModes(RayCastScene& scene, int backend, const std::vector<int>& modes)
{
  for (const int mode : modes)
  {
    for (const int gradients : { 0, 1 })
    {
      scene.rayCaster()->SetBlendMode(mode);
      scene.rayCaster()->SetGradients(gradients);
      expectAgreement(scene, backend,
        "mode " + std::to_string(mode) + ", gradients " + std::to_string(gradients));
    }
  }
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.3, 1.0, 0.2);
  scene.rayCaster()->AddClippingPlane(plane);
  scene.rayCaster()->SetBlendMode(modes.front());
  expectAgreement(scene, backend, "clipped");
  scene.rayCaster()->RemoveAllClippingPlanes();
}

} // anonymous namespace

TEST(TetrahedraRayCastBackends, ComputeAgreesWithFragmentsInEveryMode)
{
  const Grid grid = makeBlock(7, wavyField(3.0), torus(0.6, 0.35));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  scene.window()->Render();
  if (!hasCompute(scene.window()))
  {
    GTEST_SKIP() << "no OpenGL 4.3";
  }
  const int backend = vtkTetrahedraRayCastMapper::COMPUTE;
  expectAgreement(scene, backend, "plain");
  scene.volume()->SetProperty(litProperty());
  expectAgreementOfModes(scene, backend, { 0, 1, 2, 3, 4, 5 });
}

TEST(TetrahedraRayCastBackends, NativeAgreesWithFragmentsInEveryMode)
{
  // A convex mesh, since rays next to a silhouette may count as inside or outside.
  const Grid grid = makeBlock(7, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  const int backend = vtkTetrahedraRayCastMapper::NATIVE;
  expectAgreement(scene, backend, "plain");
  scene.volume()->SetProperty(litProperty());
  expectAgreementOfModes(scene, backend, { 0, 1, 2, 3, 4, 5 });
  addLights(scene.renderer());
  expectAgreementOfModes(scene, backend, { 0, 5 });
  // Fractional exponents; lighting alone, then gradient opacity alone.
  scene.volume()->GetProperty()->SetSpecularPower(7.25);
  scene.volume()->GetProperty()->SetDisableGradientOpacity(1);
  expectAgreementOfModes(scene, backend, { 0 });
  scene.volume()->GetProperty()->SetDisableGradientOpacity(0);
  scene.volume()->GetProperty()->ShadeOff();
  expectAgreementOfModes(scene, backend, { 0 });
}

TEST(TetrahedraRayCastBackends, AllAgreeThroughAMembraneInEveryMode)
{
  const Grid grid = makeBlock(7, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 50.0);
  scene.window()->Render();
  const bool compute = hasCompute(scene.window());
  addLights(scene.renderer());
  for (const MembraneCase& membrane :
    { makePlaneCase(0.1, 4.0, 2), makeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    scene.rayCaster()->SetMembraneData(membrane.Mesh);
    for (const int backend :
      { vtkTetrahedraRayCastMapper::NATIVE, vtkTetrahedraRayCastMapper::COMPUTE })
    {
      if (compute || backend == vtkTetrahedraRayCastMapper::NATIVE)
      {
        scene.volume()->SetProperty(makeProperty(FunctionKind::Smooth, Range, 3.4));
        scene.rayCaster()->SetBlendMode(vtkVolumeMapper::COMPOSITE_BLEND);
        expectAgreement(scene, backend, "plain");
        scene.rayCaster()->CompactTablesOn();
        expectAgreement(scene, backend, "compact tables");
        scene.rayCaster()->CompactTablesOff();
        scene.volume()->SetProperty(litProperty());
        expectAgreementOfModes(scene, backend, { 0, 1, 2, 3, 4, 5 });
      }
    }
  }
}

TEST(TetrahedraRayCastBackends, AutomaticIsNativeOnASoftwareRasteriser)
{
  const Grid grid = makeBlock(4, wavyField(3.0));
  RayCastScene scene(grid, litProperty(), Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  vtkTetrahedraRayCastMapper* mapper = scene.rayCaster();
  mapper->SetBackend(vtkTetrahedraRayCastMapper::AUTOMATIC);
  scene.window()->Render();
  const bool software = deviceName(scene.window()).find("llvmpipe") != std::string::npos;
  const int expected =
    software ? vtkTetrahedraRayCastMapper::NATIVE : vtkTetrahedraRayCastMapper::OPENGL;
  EXPECT_EQ(mapper->GetActiveBackend(), expected) << "light and gradient opacity";
  scene.volume()->SetProperty(makeProperty(FunctionKind::Smooth, Range, 3.4));
  scene.window()->Render();
  EXPECT_EQ(mapper->GetActiveBackend(), expected) << "plain";
  mapper->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
  scene.window()->Render();
  EXPECT_EQ(mapper->GetActiveBackend(), expected) << "pre-integrated";
}

TEST(TetrahedraRayCastBackends, NativeAgreesFromWithinAMeshOfManyParts)
{
  // Visible cells are in front of the eye, next to it and behind it, and cross the plane of the
  // eye.
  const Grid grid = makeBlock(6, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0, 1.0);
  vtkCamera* camera = scene.renderer()->GetActiveCamera();
  camera->SetPosition(0.31, 0.12, 0.43);
  camera->SetFocalPoint(-1.0, -0.2, -0.6);
  camera->SetViewAngle(70.0);
  camera->SetClippingRange(0.05, 5.0);
  vtkNew<vtkPiecewiseFunction> opacity;
  for (const double center : { -0.6, 0.0, 0.5 })
  {
    opacity->AddPoint(center - 0.1, 0.0);
    opacity->AddPoint(center, 4.0);
    opacity->AddPoint(center + 0.1, 0.0);
  }
  scene.volume()->GetProperty()->SetScalarOpacity(opacity);
  expectAgreement(scene, vtkTetrahedraRayCastMapper::NATIVE, "from within");
  EXPECT_LT(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells());
}

TEST(TetrahedraRayCastBackends, ComputeOrFragmentsAsTheWindowAllows)
{
  // This test runs a second time with OpenGL limited to 3.2.
  const Grid grid = makeBlock(4, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::COMPUTE);
  const auto warnings = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  warnings->observe(scene.rayCaster());
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  expectMatchesReference(scene, "compute asked for");
  const bool compute = hasCompute(scene.window());
  EXPECT_EQ(scene.rayCaster()->GetActiveBackend(),
    compute ? vtkTetrahedraRayCastMapper::COMPUTE : vtkTetrahedraRayCastMapper::OPENGL);
  EXPECT_EQ(warnings->Warnings.size(), compute ? 0u : 1u);
  EXPECT_TRUE(warnings->Errors.empty()) << warnings->text();
}

TEST(TetrahedraRayCastBackends, SwitchingKeepsTheTables)
{
  const Grid grid = makeBlock(4, wavyField(3.0));
  RayCastScene scene(grid, makeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.rayCaster();
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  const auto drawWithEach = [&]()
  {
    for (const int backend : { 3, 1, 2 })
    {
      mapper->SetBackend(backend);
      scene.window()->Render();
    }
  };
  drawWithEach();
  const vtkTypeInt64 bytes = mapper->GetUploadedBytes();
  drawWithEach();
  EXPECT_EQ(mapper->GetUploadedBytes(), bytes);
  mapper->ReleaseGraphicsResources(scene.window());
  const ByteImage again = scene.renderBytes();
  EXPECT_GT(*std::max_element(again.Rgb.begin(), again.Rgb.end()), 50);
}

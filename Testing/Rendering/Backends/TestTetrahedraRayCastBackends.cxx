// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Compute and fragment shaders consist of the same functions and give the same image.
#include "DeviceTableLimits.h"
#include "MembraneScene.h"
#include "ProjectionModes.h"
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 64;
constexpr double Range[2] = { -1.0, 1.0 };
// Largest difference in float between runs of the ray caster.
constexpr double Agreement = 2e-5;

vtkSmartPointer<vtkVolumeProperty> LitProperty()
{
  auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  property->ShadeOn();
  property->SetSpecular(0.4);
  property->SetGradientOpacity(MakeOpacity({ { 0.0, 0.2 }, { 3.0, 1.0 } }));
  property->GetIsoSurfaceValues()->SetValue(0, 0.2);
  property->GetIsoSurfaceValues()->SetValue(1, -0.2);
  return property;
}

// Two lights that depend on the position, one of them a cone with a fractional exponent.
void AddLights(vtkRenderer* renderer)
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

bool HasCompute(vtkRenderWindow* window)
{
  const std::string device = DeviceName(window);
  const std::size_t at = device.rfind(", ");
  int version[2] = { 0, 0 };
  return at != std::string::npos &&
    std::sscanf(device.c_str() + at + 2, "%d.%d", &version[0], &version[1]) == 2 &&
    version[0] * 10 + version[1] >= 43;
}

// Compares the picture of fragment shaders with those of other backends.
void ExpectAgreement(
  RayCastScene& scene, const std::vector<int>& backends, const std::string& settings)
{
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const FloatImage fragment = scene.RenderFloat();
  const vtkTypeInt64 steps = mapper->GetNumberOfTraversalSteps();
  for (const int backend : backends)
  {
    const std::string what = settings + ", backend " + std::to_string(backend);
    // Inside the mesh, rays behind a membrane may begin in one cell or its neighbour.
    const bool sameSteps =
      backend != vtkTetrahedraRayCastMapper::NATIVE || mapper->GetMembrane() == nullptr;
    mapper->SetBackend(backend);
    const FloatImage other = scene.RenderFloat();
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
}

void ExpectAgreementOfModes(
  RayCastScene& scene, const std::vector<int>& backends, const std::vector<int>& modes)
{
  for (const int mode : modes)
  {
    for (const int gradients : { 0, 1 })
    {
      scene.GetRayCaster()->SetBlendMode(mode);
      scene.GetRayCaster()->SetGradients(gradients);
      ExpectAgreement(scene, backends,
        "mode " + std::to_string(mode) + ", gradients " + std::to_string(gradients));
    }
  }
  AddClippingPlane(scene.GetRayCaster(), { { 0.3, 1.0, 0.2 }, {} });
  scene.GetRayCaster()->SetBlendMode(modes.front());
  ExpectAgreement(scene, backends, "clipped");
  scene.GetRayCaster()->RemoveAllClippingPlanes();
}

} // anonymous namespace

TEST(TetrahedraRayCastBackends, ComputeAgreesWithFragmentsInEveryMode)
{
  RayCastScene scene(MakeBlock(7, WavyField(3.0), Torus(0.6, 0.35)),
    MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  scene.GetWindow()->Render();
  if (!HasCompute(scene.GetWindow()))
  {
    GTEST_SKIP() << "no OpenGL 4.3";
  }
  const std::vector<int> backends{ vtkTetrahedraRayCastMapper::COMPUTE };
  ExpectAgreement(scene, backends, "plain");
  scene.GetVolume()->SetProperty(LitProperty());
  ExpectAgreementOfModes(scene, backends, AllBlendModes());
}

TEST(TetrahedraRayCastBackends, NativeAgreesWithFragmentsInEveryMode)
{
  // A convex mesh, since rays next to a silhouette may count as inside or outside.
  RayCastScene scene(
    MakeBlock(7, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  const std::vector<int> backends{ vtkTetrahedraRayCastMapper::NATIVE };
  ExpectAgreement(scene, backends, "plain");
  scene.GetVolume()->SetProperty(LitProperty());
  ExpectAgreementOfModes(scene, backends, AllBlendModes());
  AddLights(scene.GetRenderer());
  ExpectAgreementOfModes(scene, backends, { 0, 5 });
  // Fractional exponents; lighting alone, then gradient opacity alone.
  scene.GetVolume()->GetProperty()->SetSpecularPower(7.25);
  scene.GetVolume()->GetProperty()->SetDisableGradientOpacity(1);
  ExpectAgreementOfModes(scene, backends, { 0 });
  scene.GetVolume()->GetProperty()->SetDisableGradientOpacity(0);
  scene.GetVolume()->GetProperty()->ShadeOff();
  ExpectAgreementOfModes(scene, backends, { 0 });
}

TEST(TetrahedraRayCastBackends, AllAgreeThroughAMembraneInEveryMode)
{
  const Grid grid = MakeBlock(7, WavyField(3.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 50.0);
  scene.GetWindow()->Render();
  std::vector<int> backends{ vtkTetrahedraRayCastMapper::NATIVE };
  if (HasCompute(scene.GetWindow()))
  {
    backends.push_back(vtkTetrahedraRayCastMapper::COMPUTE);
  }
  AddLights(scene.GetRenderer());
  for (const MembraneCase& membrane :
    { MakePlaneCase(0.1, 4.0, 2), MakeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    scene.GetRayCaster()->SetMembraneData(membrane.Mesh);
    scene.GetVolume()->SetProperty(MakeProperty(FunctionKind::Smooth, Range, 3.4));
    scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::COMPOSITE_BLEND);
    ExpectAgreement(scene, backends, "plain");
    meniscus::DeviceTableLimits::SetCompact(scene.GetRayCaster(), true);
    ExpectAgreement(scene, backends, "compact tables");
    meniscus::DeviceTableLimits::SetCompact(scene.GetRayCaster(), false);
    scene.GetVolume()->SetProperty(LitProperty());
    ExpectAgreementOfModes(scene, backends, AllBlendModes());
  }
}

TEST(TetrahedraRayCastBackends, AutomaticIsNativeOnASoftwareRasteriser)
{
  RayCastScene scene(MakeBlock(4, WavyField(3.0)), LitProperty(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetBackend(vtkTetrahedraRayCastMapper::AUTOMATIC);
  scene.GetWindow()->Render();
  const bool software = DeviceName(scene.GetWindow()).find("llvmpipe") != std::string::npos;
  const int expected =
    software ? vtkTetrahedraRayCastMapper::NATIVE : vtkTetrahedraRayCastMapper::COMPUTE;
  EXPECT_EQ(mapper->GetActiveBackend(), expected) << "light and gradient opacity";
  scene.GetVolume()->SetProperty(MakeProperty(FunctionKind::Smooth, Range, 3.4));
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetActiveBackend(), expected) << "plain";
  mapper->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED);
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetActiveBackend(), expected) << "pre-integrated";
}

TEST(TetrahedraRayCastBackends, NativeAgreesFromWithinAMeshOfManyParts)
{
  // Visible cells are in front of the eye, next to it and behind it, and cross the plane of the
  // eye.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size + 3);
  LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 20.0, 1.0);
  vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
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
  scene.GetVolume()->GetProperty()->SetScalarOpacity(opacity);
  ExpectAgreement(scene, { vtkTetrahedraRayCastMapper::NATIVE }, "from within");
  EXPECT_LT(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells());
}

TEST(TetrahedraRayCastBackends, ComputeOrFragmentsAsTheWindowAllows)
{
  // This test runs a second time with OpenGL limited to 3.2.
  RayCastScene scene(
    MakeBlock(4, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::COMPUTE);
  const auto warnings = ObserveErrors(scene.GetRayCaster());
  ExpectMatchesReference(scene, "compute asked for");
  const bool compute = HasCompute(scene.GetWindow());
  EXPECT_EQ(scene.GetRayCaster()->GetActiveBackend(),
    compute ? vtkTetrahedraRayCastMapper::COMPUTE : vtkTetrahedraRayCastMapper::OPENGL);
  EXPECT_EQ(warnings->Warnings.size(), compute ? 0u : 1u);
  EXPECT_TRUE(warnings->Errors.empty()) << warnings->GetText();
}

TEST(TetrahedraRayCastBackends, SwitchingKeepsTheTables)
{
  RayCastScene scene(
    MakeBlock(4, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  const auto drawWithEach = [&]()
  {
    for (const int backend : { 3, 1, 2 })
    {
      mapper->SetBackend(backend);
      scene.GetWindow()->Render();
    }
  };
  drawWithEach();
  const vtkTypeInt64 bytes = mapper->GetUploadedBytes();
  drawWithEach();
  EXPECT_EQ(mapper->GetUploadedBytes(), bytes);
  mapper->ReleaseGraphicsResources(scene.GetWindow());
  const ByteImage again = scene.RenderBytes();
  EXPECT_GT(*std::max_element(again.Rgb.begin(), again.Rgb.end()), 50);
}

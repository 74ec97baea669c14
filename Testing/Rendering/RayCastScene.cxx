// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCastScene.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
RayCastScene::RayCastScene(
  vtkUnstructuredGrid* grid, vtkVolumeProperty* property, int width, int height, int multiSamples)
  : VolumeScene(width, height, multiSamples)
  , Grid(grid)
{
  if (grid)
  {
    this->RayCaster->SetInputDataObject(grid);
    if (grid->GetNumberOfPoints() > 0)
    {
      LookAt(this->GetRenderer(), grid->GetBounds(), 30.0, 20.0);
    }
  }
  this->RayCaster->SetBackend(BackendUnderTest());
  this->SetMapper(this->RayCaster);
  this->SetProperty(property);
}

//------------------------------------------------------------------------------
double AddBlackSquare(vtkRenderer* renderer, double offset)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double depth = camera->GetDistance() + offset;
  double center[3];
  double forward[3];
  camera->GetDirectionOfProjection(forward);
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = camera->GetPosition()[axis] + depth * forward[axis];
  }
  const auto source = MakePlane(9.0, 0.0, 1);
  source->SetCenter(center);
  source->SetNormal(forward);
  const auto actor = MakeActor(source->GetOutputPort());
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  renderer->AddActor(actor);
  return depth;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLight> AddParallelLight(vtkRenderer* renderer, double x, double y, double z)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToSceneLight();
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetPosition(x, y, z);
  renderer->AddLight(light);
  return light;
}

//------------------------------------------------------------------------------
void AddClippingPlane(vtkAbstractMapper* mapper, const reference::HalfSpace& half)
{
  vtkNew<vtkPlane> plane;
  plane->SetNormal(half.Normal.data());
  plane->SetOrigin(half.Origin.data());
  mapper->AddClippingPlane(plane);
}

//------------------------------------------------------------------------------
int BackendUnderTest()
{
  const char* name = std::getenv("MENISCUS_TEST_BACKEND");
  const std::string backend(name ? name : "");
  const std::pair<const char*, int> backends[] = { { "Native", vtkTetrahedraRayCastMapper::NATIVE },
    { "OpenGL", vtkTetrahedraRayCastMapper::OPENGL },
    { "Compute", vtkTetrahedraRayCastMapper::COMPUTE } };
  for (const auto& known : backends)
  {
    if (backend == known.first)
    {
      return known.second;
    }
  }
  return vtkTetrahedraRayCastMapper::AUTOMATIC;
}

//------------------------------------------------------------------------------
void ExpectMatch(
  const Comparison& comparison, const std::string& what, const SilhouetteAllowance& allowance)
{
  SCOPED_TRACE(what + ": " + comparison.GetText());
  EXPECT_GT(comparison.Covered, 0u);
  EXPECT_EQ(comparison.Wrong, 0u);
  EXPECT_EQ(comparison.CoverageMismatches, 0u);
  const double share = allowance.Share * static_cast<double>(comparison.Covered);
  EXPECT_LE(static_cast<double>(comparison.Silhouettes),
    std::max(share, static_cast<double>(allowance.Pixels)));
}

//------------------------------------------------------------------------------
void ExpectSamePicture(const FloatImage& a, const FloatImage& b, const std::string& what)
{
  ASSERT_EQ(a.Rgba.size(), b.Rgba.size());
  constexpr float tolerance = 2e-5f;
  float largest = 0.0f;
  float opacity = 0.0f;
  for (std::size_t i = 0; i < a.Rgba.size(); ++i)
  {
    largest = std::max(largest, std::abs(a.Rgba[i] - b.Rgba[i]));
    opacity = std::max(opacity, a.Rgba[i]);
  }
  EXPECT_LE(largest, tolerance) << what;
  EXPECT_GT(opacity, 0.1f) << what;
}

//------------------------------------------------------------------------------
SceneTruth MakeTruth(const RayCastScene& scene)
{
  scene.GetVolume()->ComputeMatrix();
  SceneTruth truth;
  truth.Integrator = MakeReference(scene.MakeGrid(), scene.GetVolume()->GetMatrix());
  const PixelRays rays(scene.GetRenderer());
  truth.RayOf = [rays](int x, int y) { return rays.GetRay(x, y); };
  const auto model =
    scene.GetRayCaster()->GetOpacityModel() == vtkTetrahedraRayCastMapper::ATTENUATION_COEFFICIENT
    ? OpacityModel::AttenuationCoefficient
    : OpacityModel::OpacityPerUnitDistance;
  truth.Image = RenderReference(*truth.Integrator, rays.GetWidth(), rays.GetHeight(), truth.RayOf,
    { ToReference(scene.GetVolume()->GetProperty(), model) })[0];
  return truth;
}

//------------------------------------------------------------------------------
void ExpectMatchesReference(
  RayCastScene& scene, const std::string& what, const SilhouetteAllowance& allowance)
{
  // Pixels have rays only after the window has its size.
  scene.GetWindow()->Render();
  const SceneTruth truth = MakeTruth(scene);
  const FloatImage floats = scene.RenderFloat();
  ASSERT_EQ(floats.Width, truth.Image.Width);
  ASSERT_EQ(floats.Height, truth.Image.Height);
  ExpectMatch(CompareToReference(floats, truth.Image, *truth.Integrator, truth.RayOf),
    what + " (float)", allowance);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0) << what;

  double background[3];
  scene.GetRenderer()->GetBackground(background);
  const ByteImage bytes = scene.RenderBytes();
  ASSERT_EQ(bytes.Width, truth.Image.Width);
  ExpectMatch(CompareToReference(bytes, truth.Image, *truth.Integrator, truth.RayOf,
                { background[0], background[1], background[2] }),
    what + " (8 bits)", allowance);
}

//------------------------------------------------------------------------------
void ErrorObserver::Execute(vtkObject* vtkNotUsed(caller), unsigned long event, void* data)
{
  const char* message = static_cast<const char*>(data);
  (event == vtkCommand::WarningEvent ? this->Warnings : this->Errors)
    .emplace_back(message ? message : "");
}

//------------------------------------------------------------------------------
void ErrorObserver::Observe(vtkObject* object)
{
  object->AddObserver(vtkCommand::ErrorEvent, this);
  object->AddObserver(vtkCommand::WarningEvent, this);
}

//------------------------------------------------------------------------------
vtkSmartPointer<ErrorObserver> ObserveErrors(vtkObject* object)
{
  auto observer = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  observer->Observe(object);
  return observer;
}

//------------------------------------------------------------------------------
void ExpectError(vtkAlgorithm* filter, const std::string& text)
{
  const auto observer = ObserveErrors(filter);
  const auto executive = ObserveErrors(filter->GetExecutive()); // "Algorithm returned failure"
  filter->Update();
  filter->RemoveObserver(observer);
  ASSERT_EQ(observer->Errors.size(), 1u) << text << ": " << observer->GetText();
  EXPECT_TRUE(HasText(observer->Errors[0], text));
  auto* output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(output) << text;
  EXPECT_EQ(output->GetNumberOfPoints(), 0) << text;
}

//------------------------------------------------------------------------------
std::string ErrorObserver::GetText() const
{
  std::string all;
  for (const std::string& error : this->Errors)
  {
    all += error + "\n";
  }
  return all;
}

} // namespace meniscus::test

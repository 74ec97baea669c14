// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RayCastScene.h"

#include <vtkMatrix4x4.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace meniscus
{
namespace test
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
  }
  this->RayCaster->SetBackend(backendUnderTest());
  this->setMapper(this->RayCaster);
  this->setProperty(property);
}

//------------------------------------------------------------------------------
int backendUnderTest()
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
void expectMatch(
  const Comparison& comparison, const std::string& what, const SilhouetteAllowance& allowance)
{
  SCOPED_TRACE(what + ": " + comparison.text());
  EXPECT_GT(comparison.Covered, 0u);
  EXPECT_EQ(comparison.Wrong, 0u);
  EXPECT_EQ(comparison.CoverageMismatches, 0u);
  const double share = allowance.Share * static_cast<double>(comparison.Covered);
  EXPECT_LE(static_cast<double>(comparison.Silhouettes),
    std::max(share, static_cast<double>(allowance.Pixels)));
}

//------------------------------------------------------------------------------
void expectSamePicture(const FloatImage& a, const FloatImage& b, const std::string& what)
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
SceneTruth makeTruth(const RayCastScene& scene)
{
  scene.volume()->ComputeMatrix();
  SceneTruth truth;
  truth.Integrator = makeReference(scene.grid(), scene.volume()->GetMatrix());
  const PixelRays rays(scene.renderer());
  truth.RayOf = [rays](int x, int y) { return rays.ray(x, y); };
  const auto model =
    scene.rayCaster()->GetOpacityModel() == vtkTetrahedraRayCastMapper::ATTENUATION_COEFFICIENT
    ? OpacityModel::AttenuationCoefficient
    : OpacityModel::OpacityPerUnitDistance;
  truth.Image = renderReference(*truth.Integrator, rays.width(), rays.height(), truth.RayOf,
    { toReference(scene.volume()->GetProperty(), model) })[0];
  return truth;
}

//------------------------------------------------------------------------------
void expectMatchesReference(
  RayCastScene& scene, const std::string& what, const SilhouetteAllowance& allowance)
{
  // Pixels have rays only after the window has its size.
  scene.window()->Render();
  const SceneTruth truth = makeTruth(scene);
  const FloatImage floats = scene.renderFloat();
  ASSERT_EQ(floats.Width, truth.Image.Width);
  ASSERT_EQ(floats.Height, truth.Image.Height);
  expectMatch(compareToReference(floats, truth.Image, *truth.Integrator, truth.RayOf),
    what + " (float)", allowance);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfLostRays(), 0) << what;

  double background[3];
  scene.renderer()->GetBackground(background);
  const ByteImage bytes = scene.renderBytes();
  ASSERT_EQ(bytes.Width, truth.Image.Width);
  expectMatch(compareToReference(bytes, truth.Image, *truth.Integrator, truth.RayOf,
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
void ErrorObserver::observe(vtkObject* object)
{
  object->AddObserver(vtkCommand::ErrorEvent, this);
  object->AddObserver(vtkCommand::WarningEvent, this);
}

//------------------------------------------------------------------------------
std::string ErrorObserver::text() const
{
  std::string all;
  for (const std::string& error : this->Errors)
  {
    all += error + "\n";
  }
  return all;
}

} // namespace test
} // namespace meniscus

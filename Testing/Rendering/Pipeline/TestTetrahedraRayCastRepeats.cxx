// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Frames in which nothing has changed, or only opaque geometry: the last image is shown again, or
// the part of it that changed is cast. After every change the image equals that of a new mapper.
#include "MembraneScene.h"
#include "RayCastScene.h"

#include <vtkHardwareSelector.h>
#include <vtkSelection.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 160;

/** A ball that is drawn opaque. */
vtkSmartPointer<vtkActor> MakeBall(double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  return MakeActor(sphere->GetOutputPort());
}

class TetrahedraRayCastRepeats : public ::testing::Test
{
protected:
  TetrahedraRayCastRepeats()
    : Mesh(MakeBlock(6, WavyField(3.0)))
    , Ball(MakeBall(0.4))
  {
    const double range[2] = { -1.5, 1.5 };
    this->Property = MakeProperty(FunctionKind::Smooth, range, 3.5);
    this->Property->ShadeOn();
    this->Scene = std::make_unique<RayCastScene>(this->Mesh, this->Property, Size, Size);
    LookAt(this->Scene->GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
    this->Scene->GetRenderer()->AddActor(this->Ball);
    this->Light->SetPosition(3.0, 2.0, 4.0);
    this->Scene->GetRenderer()->AddLight(this->Light);
  }

  vtkTetrahedraRayCastMapper* Mapper() const { return this->Scene->GetRayCaster(); }

  bool IsNative() const
  {
    return this->Mapper()->GetActiveBackend() == vtkTetrahedraRayCastMapper::NATIVE;
  }

  /** Renders until the frame is known to be repeated. */
  FloatImage Settle()
  {
    this->Scene->RenderFloat();
    return this->Scene->RenderFloat();
  }

  /** Image of a mapper that has no earlier image. */
  FloatImage RenderAnew()
  {
    this->Mapper()->ReleaseGraphicsResources(this->Scene->GetWindow());
    return this->Scene->RenderFloat();
  }

  Grid Mesh;
  vtkSmartPointer<vtkActor> Ball;
  vtkNew<vtkLight> Light;
  vtkSmartPointer<vtkVolumeProperty> Property;
  std::unique_ptr<RayCastScene> Scene;
};

void ExpectEqualBits(const FloatImage& a, const FloatImage& b, const std::string& what)
{
  ASSERT_EQ(a.Rgba.size(), b.Rgba.size()) << what;
  EXPECT_TRUE(a.Rgba == b.Rgba) << what;
}

} // anonymous namespace

TEST_F(TetrahedraRayCastRepeats, NothingChangedNothingCast)
{
  const FloatImage expected = this->Settle();
  const double images = this->Mapper()->GetStatistic("NumberOfCastImages");
  const double pixels = this->Mapper()->GetStatistic("NumberOfCastPixels");
  const vtkTypeInt64 steps = this->Mapper()->GetNumberOfTraversalSteps();
  EXPECT_GT(images, 0);
  EXPECT_EQ(pixels, images * Size * Size);
  for (int i = 0; i < 3; ++i)
  {
    ExpectEqualBits(this->Scene->RenderFloat(), expected, "repetition");
  }
  EXPECT_EQ(this->Mapper()->GetStatistic("NumberOfCastImages"), images);
  EXPECT_EQ(this->Mapper()->GetStatistic("NumberOfCastPixels"), pixels);
  EXPECT_EQ(this->Mapper()->GetNumberOfTraversalSteps(), steps);
}

TEST_F(TetrahedraRayCastRepeats, EveryChangeIsCast)
{
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1.0, 0.2, 0.0);
  vtkRenderer* renderer = this->Scene->GetRenderer();
  vtkVolume* volume = this->Scene->GetVolume();
  const std::vector<std::pair<const char*, std::function<void()>>> changes = {
    { "camera", [&] { renderer->GetActiveCamera()->Azimuth(5.0); } },
    { "clipping range", [&] { renderer->GetActiveCamera()->SetClippingRange(3.0, 20.0); } },
    { "scalars",
      [&]
      {
        vtkDataArray* scalars = this->Mesh->GetPointData()->GetScalars();
        scalars->SetComponent(40, 0, scalars->GetComponent(40, 0) + 1.0);
        scalars->Modified();
      } },
    { "points",
      [&]
      {
        this->Mesh->GetPoints()->SetPoint(0, -1.2, -1.1, -1.3);
        this->Mesh->GetPoints()->Modified();
      } },
    { "opacity", [&] { this->Property->GetScalarOpacity()->AddPoint(0.3, 0.7); } },
    { "colour", [&] { this->Property->GetRGBTransferFunction()->AddRGBPoint(0.1, 1, 0, 1); } },
    { "unit distance", [&] { this->Property->SetScalarOpacityUnitDistance(1.7); } },
    { "material", [&] { this->Property->SetDiffuse(0.4); } },
    { "light", [&] { this->Light->SetPosition(-3.0, 1.0, 2.0); } },
    { "light's colour", [&] { this->Light->SetColor(0.5, 1.0, 0.2); } },
    { "gradients",
      [&] { this->Mapper()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS); } },
    { "clipping plane", [&] { this->Mapper()->AddClippingPlane(plane); } },
    { "place of the clipping plane", [&] { plane->SetOrigin(0.3, 0.0, 0.0); } },
    { "matrix of the volume", [&] { volume->SetPosition(0.1, 0.0, 0.2); } },
    { "shading", [&] { this->Property->ShadeOff(); } },
    { "termination", [&] { this->Mapper()->SetEarlyTerminationOpacity(0.02); } },
    { "blend mode", [&] { this->Mapper()->SetBlendModeToMaximumIntensity(); } },
    { "ball", [&] { this->Ball->SetPosition(0.3, 0.4, 0.9); } },
    { "size of the image",
      [&]
      {
        this->Mapper()->AutoAdjustSampleDistancesOff();
        this->Mapper()->SetImageSampleDistance(2.0f);
      } },
  };
  for (const auto& change : changes)
  {
    const FloatImage before = this->Settle();
    change.second();
    const double images = this->Mapper()->GetStatistic("NumberOfCastImages");
    const FloatImage after = this->Scene->RenderFloat();
    EXPECT_GT(this->Mapper()->GetStatistic("NumberOfCastImages"), images) << change.first;
    EXPECT_FALSE(before.Rgba == after.Rgba) << change.first << " does not show";
    ExpectEqualBits(after, this->RenderAnew(), change.first);
  }
}

/** The error of a pixel is at most the transmittance at which its ray ends, and steps are saved. */
TEST_F(TetrahedraRayCastRepeats, TerminationKeepsItsErrorAndSavesSteps)
{
  constexpr float rounding = 2.0e-5f;
  this->Property->ShadeOff();
  this->Property->SetScalarOpacityUnitDistance(
    0.05 * this->Property->GetScalarOpacityUnitDistance());
  this->Mapper()->SetEarlyTerminationOpacity(1.0);
  const FloatImage whole = this->Settle();
  vtkTypeInt64 steps = this->Mapper()->GetNumberOfTraversalSteps();
  for (const double opacity : { 1.0 - 1.0 / 131072.0, 0.999, 0.99, 0.9, 0.5 })
  {
    this->Mapper()->SetEarlyTerminationOpacity(opacity);
    const FloatImage image = this->Settle();
    float worst = 0.0f;
    for (std::size_t i = 0; i < image.Rgba.size(); ++i)
    {
      worst = std::max(worst, std::abs(image.Rgba[i] - whole.Rgba[i]));
    }
    EXPECT_LE(worst, static_cast<float>(1.0 - opacity) + rounding) << opacity;
    // At least a tenth of the error that is accepted is made.
    EXPECT_GE(worst, static_cast<float>(0.1 * (1.0 - opacity)) - rounding) << opacity;
    const vtkTypeInt64 saved = steps - this->Mapper()->GetNumberOfTraversalSteps();
    EXPECT_GT(saved, steps / 50) << opacity;
    steps = this->Mapper()->GetNumberOfTraversalSteps();
  }
}

TEST_F(TetrahedraRayCastRepeats, MovedBallIsCastWhereItWasAndIs)
{
  this->Settle();
  const double pixels = this->Mapper()->GetStatistic("NumberOfCastPixels");
  this->Ball->SetScale(0.3);
  this->Ball->SetPosition(0.2, 0.1, 1.1);
  this->Settle();
  const double first = this->Mapper()->GetStatistic("NumberOfCastPixels");
  EXPECT_GT(first, pixels);
  this->Ball->SetPosition(0.25, 0.1, 1.1);
  const FloatImage moved = this->Scene->RenderFloat();
  const double cast = this->Mapper()->GetStatistic("NumberOfCastPixels") - first;
  EXPECT_GT(cast, 0);
  if (this->IsNative())
  {
    EXPECT_LT(cast, Size * Size / 4);
  }
  const vtkTypeInt64 steps = this->Mapper()->GetNumberOfTraversalSteps();
  ExpectEqualBits(moved, this->RenderAnew(), "moved ball");
  EXPECT_EQ(this->Mapper()->GetNumberOfTraversalSteps(), steps);
}

/** Depths of the window depend on the planes; rays that end outside of the mesh are the same. */
TEST_F(TetrahedraRayCastRepeats, ClippingRangeThatCutsNothingCastsNothing)
{
  vtkCamera* camera = this->Scene->GetRenderer()->GetActiveCamera();
  const double position[3] = { camera->GetPosition()[0], camera->GetPosition()[1],
    camera->GetPosition()[2] };
  double range[2];
  camera->GetClippingRange(range);
  const auto castPixels = [this] { return this->Mapper()->GetStatistic("NumberOfCastPixels"); };
  this->Ball->SetScale(0.1);
  for (const bool isParallel : { false, true })
  {
    camera->SetParallelProjection(isParallel);
    // In front of the mesh and behind it: its corners are at 1.63, its centre at 0.
    for (const double distance : { 1.68, -1.68 })
    {
      const double share = distance / vtkMath::Norm(position);
      this->Ball->SetPosition(share * position[0], share * position[1], share * position[2]);
      camera->SetClippingRange(range);
      const FloatImage expected = this->Settle();
      const double pixels = castPixels();
      for (const double nearer : { 0.9, 0.77, 0.31, 0.1003, 1.0 })
      {
        camera->SetClippingRange(nearer * range[0], range[1] / nearer);
        ExpectEqualBits(this->Scene->RenderFloat(), expected, "clipping range");
        EXPECT_EQ(castPixels(), pixels) << nearer;
      }
    }
  }
}

TEST_F(TetrahedraRayCastRepeats, ClippingRangeWithABallInTheMeshCastsTheBall)
{
  vtkCamera* camera = this->Scene->GetRenderer()->GetActiveCamera();
  double range[2];
  camera->GetClippingRange(range);
  this->Ball->SetScale(0.4);
  this->Ball->SetPosition(0.3, 0.2, 0.4);
  const FloatImage expected = this->Settle();
  const double pixels = this->Mapper()->GetStatistic("NumberOfCastPixels");
  camera->SetClippingRange(0.1 * range[0], 10.0 * range[1]);
  const FloatImage image = this->Scene->RenderFloat();
  const double cast = this->Mapper()->GetStatistic("NumberOfCastPixels") - pixels;
  EXPECT_GT(cast, 0);
  if (this->IsNative())
  {
    EXPECT_LT(cast, Size * Size / 4);
  }
  // A step of the window's depth, of 24 bits, is 6e-6 at the ball; the medium absorbs less than 10
  // times that. A new mapper places vertices by a projection that is rounded otherwise.
  const FloatImage anew = this->RenderAnew();
  for (std::size_t i = 0; i < image.Rgba.size(); ++i)
  {
    ASSERT_NEAR(image.Rgba[i], expected.Rgba[i], 6.0e-5) << i;
    ASSERT_NEAR(image.Rgba[i], anew.Rgba[i], 1.0e-6) << i;
  }
}

TEST_F(TetrahedraRayCastRepeats, BackgroundAndSelectionShowTheSameImage)
{
  this->Scene->GetWindow()->Render();
  this->Scene->GetWindow()->Render();
  const double images = this->Mapper()->GetStatistic("NumberOfCastImages");
  this->Scene->GetRenderer()->SetBackground(0.3, 0.5, 0.1);
  this->Scene->GetWindow()->Render();
  EXPECT_EQ(this->Mapper()->GetStatistic("NumberOfCastImages"), images);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Scene->GetRenderer());
  selector->SetArea(0, 0, Size - 1, Size - 1);
  vtkSmartPointer<vtkSelection> selection;
  selection.TakeReference(selector->Select());
  EXPECT_GT(selection->GetNumberOfNodes(), 0u);
  // Selections are made in another framebuffer, which may round depths differently: its passes may
  // need one image of their own.
  EXPECT_LE(
    this->Mapper()->GetStatistic("NumberOfCastImages"), images + (this->IsNative() ? 1 : 2));
}

TEST_F(TetrahedraRayCastRepeats, ModifiedMapperIsCast)
{
  const FloatImage expected = this->Settle();
  const double images = this->Mapper()->GetStatistic("NumberOfCastImages");
  this->Mapper()->Modified();
  ExpectEqualBits(this->Scene->RenderFloat(), expected, "modified");
  EXPECT_EQ(this->Mapper()->GetStatistic("NumberOfCastImages"), images + 1);
}

TEST_F(TetrahedraRayCastRepeats, MembraneThatChanges)
{
  this->Scene->GetRenderer()->RemoveActor(this->Ball);
  vtkNew<vtkPlaneSource> water;
  water->SetOrigin(-3.0, 1.2, 3.0);
  water->SetPoint1(3.0, 1.2, 3.0);
  water->SetPoint2(-3.0, 1.2, -3.0);
  water->SetResolution(6, 6);
  this->Mapper()->SetInputConnection(1, water->GetOutputPort());
  this->Mapper()->SetInteriorIndexOfRefraction(1.333);
  LookAt(this->Scene->GetRenderer(), this->Mesh->GetBounds(), 10.0, 80.0);
  this->Settle();
  const double images = this->Mapper()->GetStatistic("NumberOfCastImages");
  const FloatImage before = this->Scene->RenderFloat();
  EXPECT_EQ(this->Mapper()->GetStatistic("NumberOfCastImages"), images);
  for (const std::function<void()>& change :
    std::vector<std::function<void()>>{ [&] { this->Mapper()->SetInteriorIndexOfRefraction(1.5); },
      [&] { water->SetNormal(0.1, 1.0, 0.0); } })
  {
    const double settled = this->Mapper()->GetStatistic("NumberOfCastImages");
    change();
    const FloatImage after = this->Scene->RenderFloat();
    EXPECT_GT(this->Mapper()->GetStatistic("NumberOfCastImages"), settled);
    EXPECT_FALSE(after.Rgba == before.Rgba);
    ExpectEqualBits(after, this->RenderAnew(), "membrane");
    this->Settle();
  }
}

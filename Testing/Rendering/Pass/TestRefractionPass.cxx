// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRefractionPass compared with closed forms: a plane of water, seen from above.
#include "FlatPool.h"

#include <vtkLightCollection.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkSSAAPass.h>
#include <vtkTexture.h>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

namespace
{

/** A cube map of one colour. */
vtkSmartPointer<vtkTexture> MakeSky(unsigned char red, unsigned char green, unsigned char blue)
{
  auto sky = vtkSmartPointer<vtkTexture>::New();
  sky->CubeMapOn();
  for (int side = 0; side < 6; ++side)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 2, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int i = 0; i < 4; ++i)
    {
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(i % 2, i / 2, 0));
      pixel[0] = red;
      pixel[1] = green;
      pixel[2] = blue;
    }
    sky->SetInputDataObject(side, image);
  }
  return sky;
}

} // anonymous namespace

TEST(RefractionPass, ClearWaterShowsTheFloor)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  ExpectColors(pool, "from above", [](const Sight&, int) { return 1.0; });
  pool.LookFrom(2.5, -1.5);
  ExpectColors(pool, "aside", [](const Sight&, int) { return 1.0; });
  EXPECT_EQ(pool.Pass->GetNumberOfMembranesDrawn(), 2);
}

// VTK passes no normals to shaders where no light is on.
TEST(RefractionPass, WithoutLights)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  const auto isFloor = [](const Sight&, int) { return 1.0; }; // it does not need light
  pool.GetRenderer()->AutomaticLightCreationOff();
  ExpectColors(pool, "no light", isFloor);
  vtkNew<vtkLight> light;
  light->SwitchOff();
  pool.GetRenderer()->AddLight(light);
  ExpectColors(pool, "a light that is off", isFloor);
  EXPECT_EQ(pool.GetRenderer()->GetLights()->GetNumberOfItems(), 1);
  light->SwitchOn();
  ExpectColors(pool, "a light that is on", isFloor);
}

TEST(RefractionPass, ReflectanceIsFresnels)
{
  Pool pool;
  const double sky[3] = { 1.0, 0.0, 51.0 / 255.0 };
  pool.Pass->SetReflectionTexture(MakeSky(255, 0, 51));
  SetFlatColor(pool.Floor, 0.0, 1.0, 0.0);
  const double floor[3] = { 0.0, 1.0, 0.0 };
  for (const double x : { 0.0, 4.0 })
  {
    pool.LookFrom(x, 0.3);
    pool.Pass->SetReflectanceModel(vtkRefractionPass::FRESNEL);
    ExpectColors(pool, "Fresnel",
      [&](const Sight& sight, int channel)
      {
        const double f = MakeFresnel(sight);
        return (1.0 - f) * floor[channel] + f * sky[channel];
      });
    pool.Pass->SetReflectanceModel(vtkRefractionPass::SCHLICK);
    ExpectColors(pool, "Schlick",
      [&](const Sight& sight, int channel)
      {
        const double f = Schlick(sight);
        return (1.0 - f) * floor[channel] + f * sky[channel];
      });
  }
}

/**
 * The layout of the faces, as documented for SetReflectionTexture(), seen in mirrors that face
 * along each axis: the sky's colour is a function of the direction.
 */
TEST(RefractionPass, CubeMapFacesLieAsDocumented)
{
  constexpr int faceSize = 64;
  const auto colorOf = [](const double* direction, int channel)
  {
    const double longest =
      std::max({ std::fabs(direction[0]), std::fabs(direction[1]), std::fabs(direction[2]) });
    return 0.5 + 0.4 * direction[channel] / longest;
  };
  vtkNew<vtkTexture> sky;
  sky->CubeMapOn();
  sky->InterpolateOn();
  for (int face = 0; face < 6; ++face)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(faceSize, faceSize, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (const auto& [j, i] : Product(faceSize, faceSize))
    {
      const double u = (2.0 * i + 1.0) / faceSize - 1.0;
      const double v = (2.0 * j + 1.0) / faceSize - 1.0;
      const double table[6][3] = { { 1, -v, -u }, { -1, -v, u }, { u, 1, v }, { u, -1, -v },
        { u, -v, 1 }, { -u, -v, -1 } };
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(i, j, 0));
      for (int channel = 0; channel < 3; ++channel)
      {
        pixel[channel] =
          static_cast<unsigned char>(std::lround(255.0 * colorOf(table[face], channel)));
      }
    }
    sky->SetInputDataObject(face, image);
  }
  constexpr double index = 20.0; // reflects more than four fifths
  for (int face = 0; face < 6; ++face)
  {
    SCOPED_TRACE(face);
    double axis[3] = { 0.0, 0.0, 0.0 };
    axis[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
    Pool pool;
    pool.GetRenderer()->SetBackground(0.0, 0.0, 0.0);
    SetFlatColor(pool.Floor, 0.0, 0.0, 0.0);
    pool.Filter->SetInteriorIndexOfRefraction(index);
    pool.Pass->SetReflectionTexture(sky);
    pool.Surface->SetNormal(axis);
    pool.Bottom->SetCenter(-axis[0], -axis[1], -axis[2]);
    pool.Bottom->SetNormal(axis);
    vtkCamera* camera = pool.GetCamera();
    camera->SetPosition(EyeHeight * axis[0], EyeHeight * axis[1], EyeHeight * axis[2]);
    camera->SetViewUp(axis[1], axis[2], axis[0]);
    const ByteImage image = pool.Render();
    double up[3];
    double forward[3];
    camera->GetViewUp(up);
    camera->GetDirectionOfProjection(forward);
    double right[3];
    vtkMath::Cross(forward, up, right);
    const double scale = std::tan(vtkMath::RadiansFromDegrees(30.0)) / (0.5 * Size);
    for (int y = 20; y < Size - 20; y += 3)
    {
      for (int x = 20; x < Size - 20; x += 3)
      {
        double mirrored[3];
        for (int i = 0; i < 3; ++i)
        {
          mirrored[i] = -forward[i] + (x + 0.5 - 0.5 * Size) * scale * right[i] +
            (y + 0.5 - 0.5 * Size) * scale * up[i];
        }
        const double cosine = 1.0 / vtkMath::Norm(mirrored);
        const double reflectance = meniscus::reference::MakeReflectance(cosine, 1.0, index);
        for (int channel = 0; channel < 3; ++channel)
        {
          // The texture's bytes are also rounded.
          ASSERT_NEAR(image.GetPixel(x, y)[channel] / 255.0,
            reflectance * colorOf(mirrored, channel), Rounding + 0.5 / 255.0)
            << x << " " << y << " " << channel;
        }
      }
    }
  }
}

TEST(RefractionPass, WithoutACubeMapTheBackgroundIsReflected)
{
  Pool pool;
  ExpectColors(pool, "Fresnel",
    [](const Sight& sight, int channel)
    { return 1.0 - MakeFresnel(sight) * (1.0 - Background[channel]); });
}

TEST(RefractionPass, WhatIsInFrontHidesTheMembrane)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  vtkNew<vtkCubeSource> cube;
  cube->SetCenter(0.0, 0.0, 0.5);
  cube->SetXLength(0.6);
  cube->SetYLength(0.6);
  cube->SetZLength(0.2);
  const auto actor = MakeActor(cube->GetOutputPort());
  SetFlatColor(actor, 1.0, 0.0, 0.0);
  pool.GetRenderer()->AddActor(actor);
  const ByteImage above = pool.Render();
  const unsigned char* middle = above.GetPixel(Size / 2, Size / 2);
  EXPECT_EQ(middle[0], 255);
  EXPECT_EQ(middle[1], 0);
  // Below the membrane it is occluded: only the filter's output is visible behind the water.
  cube->SetCenter(0.0, 0.0, -0.5);
  const ByteImage below = pool.Render();
  EXPECT_EQ(below.GetPixel(Size / 2, Size / 2)[1], 255);
}

TEST(RefractionPass, APiercingObjectIsSeenAboveAndBelow)
{
  // Red as an actor of the renderer; green as seen through the membrane.
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  vtkNew<vtkCubeSource> post;
  post->SetXLength(0.6);
  post->SetYLength(0.6);
  const auto above = MakeActor(post->GetOutputPort());
  SetFlatColor(above, 1.0, 0.0, 0.0);
  pool.GetRenderer()->AddActor(above);
  vtkNew<vtkRefractedGeometryFilter> filter;
  filter->SetInputConnection(post->GetOutputPort());
  filter->SetMembraneConnection(pool.Surface->GetOutputPort());
  filter->SetInteriorIndexOfRefraction(Water);
  filter->SetCamera(pool.GetCamera());
  const auto below = MakeActor(filter->GetOutputPort());
  SetFlatColor(below, 0.0, 1.0, 0.0);
  pool.Pass->AddRefraction(pool.Membrane, below, filter);
  pool.LookFrom(4.0, 0.0);
  const ByteImage image = pool.Render();
  int red = 0;
  int green = 0;
  for (const auto& [y, x] : Product(Size, Size))
  {
    const unsigned char* pixel = image.GetPixel(x, y);
    red += pixel[0] > 250 && pixel[1] < 5 ? 1 : 0;
    green += pixel[0] < 5 && pixel[1] > 250 ? 1 : 0;
  }
  EXPECT_GT(red, 50);
  EXPECT_GT(green, 20);
  // The side facing the eye: red just above the water, green just below.
  const Sight foot = SightOf(pool.GetCamera(), Size / 2, Size / 2);
  EXPECT_NEAR(foot.Point[0], 0.0, 0.1); // the middle of the image is the water inside the post
  EXPECT_EQ(image.GetPixel(Size / 2, Size / 2)[0], 255);
}

TEST(RefractionPass, OtherActorsAreNotChanged)
{
  // The image is the same to the bit at pixels without the membrane: with the pass, without it, and
  // after it.
  Pool pool;
  const auto ball = MakePlane(20.0, -3.0, 1);
  const auto actor = MakeActor(ball->GetOutputPort());
  actor->GetProperty()->SetColor(0.9, 0.6, 0.2);
  pool.GetRenderer()->AddActor(actor);
  pool.GetRenderer()->SetPass(nullptr);
  const ByteImage plain = pool.Render();
  pool.GetRenderer()->SetPass(pool.Pass);
  const ByteImage with = pool.Render();
  pool.GetRenderer()->SetPass(nullptr);
  EXPECT_EQ(pool.Render().Rgb, plain.Rgb);
  int changed = 0;
  for (const auto& [y, x] : Product(Size, Size))
  {
    const Sight sight = SightOf(pool.GetCamera(), x, y);
    const bool same =
      std::equal(with.GetPixel(x, y), with.GetPixel(x, y) + 3, plain.GetPixel(x, y));
    ASSERT_TRUE(same || sight.OnMembrane || IsBorder(sight)) << x << " " << y;
    changed += same ? 0 : 1;
  }
  EXPECT_GT(changed, Size * Size / 8);
}

TEST(RefractionPass, AMembraneOutOfViewCostsNothing)
{
  Pool pool;
  pool.GetCamera()->SetPosition(0.0, 0.0, EyeHeight);
  pool.GetCamera()->SetFocalPoint(0.0, 0.0, 2.0 * EyeHeight);
  pool.Render();
  EXPECT_EQ(pool.Pass->GetNumberOfMembranesDrawn(), 0);
  EXPECT_EQ(pool.Pass->GetNumberOfMembranesSkipped(), 1);
  EXPECT_EQ(pool.Filter->GetNumberOfSolvedVertices(), 0);
  pool.LookFrom(0.0, 0.0);
  pool.Membrane->VisibilityOff();
  pool.Render();
  EXPECT_EQ(pool.Pass->GetNumberOfMembranesDrawn(), 0);
  EXPECT_EQ(pool.Pass->GetNumberOfMembranesSkipped(), 2);
}

// Only the pixels that the membrane's bounds may cover are drawn.
TEST(RefractionPass, MembranesInAnyPartOfThePicture)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  const auto isFloor = [](const Sight&, int) { return 1.0; };
  vtkCamera* camera = pool.GetCamera();
  // Half of it out of the picture, on each side, above and below.
  for (const double at : { -3.0, 3.0 })
  {
    camera->SetFocalPoint(at, 0.0, 0.0);
    camera->SetPosition(at, 0.0, EyeHeight);
    ExpectColors(pool, "aside", isFloor);
    camera->SetFocalPoint(0.0, at, 0.0);
    camera->SetPosition(0.0, at, EyeHeight);
    ExpectColors(pool, "above and below", isFloor);
  }
  // A part of it behind the eye.
  camera->SetPosition(0.0, -2.0, 1.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  ExpectColors(pool, "around the eye", isFloor);
  // A small part of a picture in a small part of the window.
  camera->SetPosition(0.0, 0.0, 2.0 * EyeHeight);
  camera->SetFocalPoint(1.0, -2.0, 0.0);
  pool.GetRenderer()->SetViewport(0.4, 0.2, 1.0, 0.8);
  const ByteImage small = pool.Render();
  pool.GetRenderer()->SetViewport(0.0, 0.0, 1.0, 1.0);
  pool.Scene.GetWindow()->SetSize(Size * 3 / 5, Size * 3 / 5);
  const ByteImage alone = pool.Render();
  for (const auto& [y, x] : Product(Size * 3 / 5, Size * 3 / 5))
  {
    ASSERT_EQ(small.GetPixel(x + Size * 2 / 5, y + Size / 5)[0], alone.GetPixel(x, y)[0])
      << x << " " << y;
  }
}

TEST(RefractionPass, TheClippingRangeHoldsWhatTheRendererDoesNotKnow)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  const ByteImage whole = pool.Render();
  double range[2];
  pool.GetCamera()->GetClippingRange(range);
  EXPECT_EQ(range[0], 0.1); // wide enough: untouched
  EXPECT_EQ(range[1], 20.0);
  // As the renderer would set it for a small actor in front.
  pool.GetCamera()->SetClippingRange(0.5, 1.0);
  EXPECT_EQ(pool.Render().Rgb, whole.Rgb);
  pool.GetCamera()->GetClippingRange(range);
  EXPECT_EQ(range[0], 0.5);
  EXPECT_GT(range[1], EyeHeight + 0.5);
  const vtkTypeInt64 eyes = pool.Filter->GetNumberOfEyeUpdates();
  const vtkMTimeType time = pool.GetCamera()->GetMTime();
  pool.Render();
  EXPECT_EQ(pool.Filter->GetNumberOfEyeUpdates(), eyes);
  EXPECT_EQ(pool.GetCamera()->GetMTime(), time);

  pool.Pass->AdjustClippingRangeOff();
  pool.GetCamera()->SetClippingRange(0.5, 1.0);
  pool.Render();
  pool.GetCamera()->GetClippingRange(range);
  EXPECT_EQ(range[1], 1.0);
}

TEST(RefractionPass, CountersOfWhatMoves)
{
  Pool pool;
  pool.Render();
  const vtkTypeInt64 patches = pool.Filter->GetNumberOfPatchBuilds();
  const vtkTypeInt64 eyes = pool.Filter->GetNumberOfEyeUpdates();
  const vtkTypeInt64 solved = pool.Filter->GetNumberOfSolvedVertices();
  EXPECT_EQ(patches, 1);
  EXPECT_EQ(eyes, 1);
  pool.Render();
  EXPECT_EQ(pool.Filter->GetNumberOfSolvedVertices(), solved);
  pool.LookFrom(1.0, 0.0);
  pool.Render();
  EXPECT_EQ(pool.Filter->GetNumberOfPatchBuilds(), patches);
  EXPECT_EQ(pool.Filter->GetNumberOfEyeUpdates(), eyes + 1);
  pool.Pass->SetAttenuationCoefficients(0.1, 0.1, 0.1);
  const vtkTypeInt64 now = pool.Filter->GetNumberOfSolvedVertices();
  pool.Render();
  EXPECT_EQ(pool.Filter->GetNumberOfSolvedVertices(), now);
}

TEST(RefractionPass, TwoMembranes)
{
  // Side by side, each with its own object.
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  pool.Surface->SetPoint1(-0.2, -3.0, 0.0); // x from -3 to -0.2
  const auto surface = MakePlane(3.0, 0.0, 4);
  surface->SetOrigin(0.2, -3.0, 0.0);
  surface->SetPoint2(0.2, 3.0, 0.0);
  vtkNew<vtkRefractedGeometryFilter> filter;
  filter->SetInputConnection(pool.Bottom->GetOutputPort());
  filter->SetMembraneConnection(surface->GetOutputPort());
  filter->SetCamera(pool.GetCamera());
  const auto membrane = MakeActor(surface->GetOutputPort());
  const auto floor = MakeActor(filter->GetOutputPort());
  SetFlatColor(floor, 1.0, 1.0, 0.0);
  pool.Pass->AddRefraction(membrane, floor, filter);
  const ByteImage image = pool.Render();
  EXPECT_EQ(pool.Pass->GetNumberOfMembranesDrawn(), 2);
  EXPECT_EQ(image.GetPixel(Size / 4, Size / 2)[2], 255);
  EXPECT_EQ(image.GetPixel(3 * Size / 4, Size / 2)[2], 0);
  EXPECT_EQ(image.GetPixel(3 * Size / 4, Size / 2)[1], 255);
  EXPECT_NEAR(image.GetPixel(Size / 2, Size / 2)[2], 255.0 * Background[2], 1.0);
  pool.Pass->RemoveRefraction(floor);
  EXPECT_EQ(pool.Pass->GetNumberOfRefractions(), 1);
  EXPECT_NEAR(pool.Render().GetPixel(3 * Size / 4, Size / 2)[1], 255.0 * Background[1], 1.0);
}

TEST(RefractionPass, WindowsOfAllKinds)
{
  for (const auto& [samples, stencil] : Product(List(0, 4), List(0, 1)))
  {
    Pool pool(samples);
    pool.Scene.GetWindow()->SetStencilCapable(stencil);
    pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
    ExpectColors(pool, "samples " + std::to_string(samples), [](const Sight&, int) { return 1.0; });
    pool.Scene.GetWindow()->SetSize(Size + 37, Size - 20);
    pool.Render();
    pool.Scene.GetWindow()->SetSize(Size, Size);
    ExpectColors(pool, "resized", [](const Sight&, int) { return 1.0; });
    pool.Pass->ReleaseGraphicsResources(pool.Scene.GetWindow());
    ExpectColors(pool, "released", [](const Sight&, int) { return 1.0; });
  }
}

TEST(RefractionPass, SeveralViewports)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  pool.GetRenderer()->SetViewport(0.5, 0.25, 1.0, 0.75);
  vtkNew<vtkRenderer> other;
  other->SetViewport(0.0, 0.0, 0.5, 1.0);
  other->SetBackground(0.0, 0.0, 0.0);
  pool.Scene.GetWindow()->AddRenderer(other);
  const ByteImage image = pool.Render();
  EXPECT_EQ(image.GetPixel(Size / 4, Size / 2)[0], 0);
  EXPECT_EQ(image.GetPixel(3 * Size / 4, Size / 2)[0], 255);
}

// The pass inside other passes, and with other passes inside it.
TEST(RefractionPass, ComposesWithOtherPasses)
{
  const auto expectFloor =
    [](Pool& pool, const std::string& name, double slack = Rounding, int blur = 0)
  {
    ExpectColors(
      pool, name, [](const Sight&, int) { return 1.0; }, slack, blur);
  };
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  pool.LookFrom(2.5, -1.5);
  expectFloor(pool, "alone");
  vtkNew<vtkOpenGLFXAAPass> fxaa;
  fxaa->SetDelegatePass(pool.Pass);
  pool.GetRenderer()->SetPass(fxaa);
  expectFloor(pool, "FXAA");
  vtkNew<vtkSSAAPass> ssaa;
  ssaa->SetDelegatePass(pool.Pass);
  pool.GetRenderer()->SetPass(ssaa);
  // Filtered across and down, rounded each time.
  expectFloor(pool, "SSAA", Rounding + 1.0 / 255.0, 3);

  // A translucent actor in front of the water, blended with it by peeling: half red, half white.
  pool.GetRenderer()->SetPass(pool.Pass);
  const auto plane = MakePlane(0.5, 1.0, 1);
  const auto glass = MakeActor(plane->GetOutputPort());
  SetFlatColor(glass, 1.0, 0.0, 0.0);
  glass->GetProperty()->SetOpacity(0.5);
  pool.GetRenderer()->AddActor(glass);
  pool.GetRenderer()->UseDepthPeelingOn();
  pool.Render(); // must not fail; where the water is nearer, it occludes geometry drawn before
  pool.GetRenderer()->RemoveActor(glass);
  pool.GetRenderer()->UseDepthPeelingOff();
  expectFloor(pool, "after peeling");
}

TEST(RefractionPass, NothingToDraw)
{
  Pool pool;
  pool.Pass->RemoveAllRefractions();
  const ByteImage image = pool.Render();
  EXPECT_NEAR(image.GetPixel(Size / 2, Size / 2)[2], 255.0 * Background[2], 1.0);
  EXPECT_EQ(pool.Pass->GetNumberOfMembranesDrawn(), 0);
}

TEST(RefractionPass, NullPartsAreAnError)
{
  Pool pool;
  const auto errors = ObserveErrors(pool.Pass);
  pool.Pass->AddRefraction(nullptr, pool.Floor, pool.Filter);
  pool.Pass->AddRefraction(pool.Membrane, nullptr, pool.Filter);
  pool.Pass->AddRefraction(pool.Membrane, pool.Floor, nullptr);
  EXPECT_EQ(errors->Errors.size(), 3u);
  EXPECT_EQ(pool.Pass->GetNumberOfRefractions(), 1);
}

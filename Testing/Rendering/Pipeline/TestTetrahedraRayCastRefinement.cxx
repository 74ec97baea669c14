// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Still pictures that the application gives up: the window shows the last picture of the view, and
// the next frames cast the tiles that are missing.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

/** 8 x 8 tiles. */
constexpr int Size = 256;
constexpr double Moving = 1e6;
constexpr double Still = 1e-4;
constexpr double Range[2] = { -1.0, 1.0 };

/** Gives up every frame of a window, while it is wanted, at the first question. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    static_cast<vtkRenderWindow*>(caller)->SetAbortRender(this->Wanted ? 1 : 0);
  }

  bool Wanted = false;
};

class TetrahedraRayCastRefinement : public ::testing::Test
{
protected:
  TetrahedraRayCastRefinement()
    : Mesh(MakeBlock(6, WavyField(3.0)))
    , Property(MakeProperty(FunctionKind::Smooth, Range, 3.5))
    , Scene(Mesh, Property, Size, Size)
  {
    this->Mapper()->SetBackend(vtkTetrahedraRayCastMapper::NATIVE);
    LookAt(this->Scene.GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
    this->Scene.GetWindow()->Render();
    // VTK asks five times a second; a frame that is given up at its start needs no waiting.
    this->Scene.GetWindow()->AddObserver(vtkCommand::StartEvent, this->Abort);
    this->Scene.GetWindow()->AddObserver(vtkCommand::AbortCheckEvent, this->Abort);
  }

  vtkTetrahedraRayCastMapper* Mapper() const { return this->Scene.GetRayCaster(); }
  double Images() const { return this->Mapper()->GetStatistic("NumberOfCastImages"); }
  double Pixels() const { return this->Mapper()->GetStatistic("NumberOfCastPixels"); }

  ByteImage Render(double rate, bool aborted = false)
  {
    this->Scene.GetWindow()->SetDesiredUpdateRate(rate);
    this->Abort->Wanted = aborted;
    return this->Scene.RenderBytes();
  }

  /** Picture of a mapper that has no earlier image. */
  ByteImage RenderAnew()
  {
    this->Mapper()->ReleaseGraphicsResources(this->Scene.GetWindow());
    return this->Render(Still);
  }

  void Turn() { this->Scene.GetRenderer()->GetActiveCamera()->Azimuth(10.0); }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  RayCastScene Scene;
  vtkNew<Aborter> Abort;
};

} // anonymous namespace

TEST_F(TetrahedraRayCastRefinement, GivenUpFramesShowTheCoarsePictureAndCastNothingTwice)
{
  for (const float distance : { 1.0f, 0.25f })
  {
    this->Mapper()->SetImageSampleDistance(distance);
    this->Turn();
    const ByteImage coarse = this->Render(Moving);
    const double images = this->Images();
    const double pixels = this->Pixels();
    double before = pixels;
    int frames = 0;
    for (ByteImage picture = this->Render(Still, true); this->Images() == images;
         picture = this->Render(Still, true))
    {
      ASSERT_LT(++frames, 100);
      EXPECT_TRUE(picture.Rgb == coarse.Rgb) << "frame " << frames;
      EXPECT_TRUE(this->Pixels() > before || this->Pixels() == pixels + Size * Size);
      before = this->Pixels();
    }
    // One part at least in each frame, of the edges as well.
    EXPECT_GT(frames, distance < 1.0f ? 16 : 8);
    EXPECT_EQ(this->Pixels(), pixels + Size * Size);
    const ByteImage refined = this->Render(Still);
    EXPECT_EQ(this->Images(), images + 1);
    EXPECT_EQ(this->Pixels(), pixels + Size * Size);
    EXPECT_FALSE(refined.Rgb == coarse.Rgb);
    EXPECT_TRUE(refined.Rgb == this->RenderAnew().Rgb);
  }
}

TEST_F(TetrahedraRayCastRefinement, RefinedPictureIsTheStillPictureToTheBit)
{
  this->Turn();
  this->Render(Moving);
  this->Render(Still, true);
  this->Render(Still, true);
  this->Abort->Wanted = false;
  const FloatImage refined = this->Scene.RenderFloat();
  this->Mapper()->ReleaseGraphicsResources(this->Scene.GetWindow());
  EXPECT_TRUE(refined.Rgba == this->Scene.RenderFloat().Rgba);
}

TEST_F(TetrahedraRayCastRefinement, MovedCameraLeavesNothingOfTheGivenUpImage)
{
  const ByteImage first = this->Render(Still);
  this->Turn();
  const ByteImage none = this->Render(Still, true);
  EXPECT_FALSE(none.Rgb == first.Rgb) << "the picture of another view";
  this->Turn();
  const double pixels = this->Pixels();
  const ByteImage turned = this->Render(Still);
  EXPECT_EQ(this->Pixels(), pixels + Size * Size);
  EXPECT_TRUE(turned.Rgb == this->RenderAnew().Rgb);
}

/** Tiles that were done are cast again where opaque geometry has moved in the meantime. */
TEST_F(TetrahedraRayCastRefinement, GeometryMovesBetweenGivenUpFrames)
{
  this->Mapper()->SetImageSampleDistance(0.5f);
  vtkNew<vtkSphereSource> sphere;
  const auto ball = MakeActor(sphere->GetOutputPort());
  this->Scene.GetRenderer()->AddActor(ball);
  for (int frames = 0; frames < 12; ++frames)
  {
    ball->SetPosition(0.2 * frames - 1.2, -0.3, 1.1);
    this->Render(Still, true);
  }
  const ByteImage finished = this->Render(Still);
  EXPECT_TRUE(finished.Rgb == this->RenderAnew().Rgb);
  // The next ball moves over a finished image, whose refinement is given up.
  for (int frames = 0; frames < 12; ++frames)
  {
    ball->SetPosition(0.2 * frames - 1.2, 0.2, 1.1);
    this->Render(Still, true);
    ball->SetPosition(0.2 * frames - 1.1, 0.2, 1.1);
    const ByteImage picture = this->Render(Still);
    if (frames % 4 == 3)
    {
      EXPECT_TRUE(picture.Rgb == this->RenderAnew().Rgb) << frames;
    }
  }
}

/** Frames of an interaction are fast enough; they would show nothing if each event ended them. */
TEST_F(TetrahedraRayCastRefinement, FramesOfAnInteractionAreNotGivenUp)
{
  this->Turn();
  const double images = this->Images();
  this->Render(Moving, true);
  EXPECT_EQ(this->Images(), images + 1);
}

TEST_F(TetrahedraRayCastRefinement, WithoutAnObserverEveryFrameIsFinished)
{
  this->Scene.GetWindow()->RemoveObservers(vtkCommand::AbortCheckEvent);
  this->Turn();
  const double images = this->Images();
  this->Render(Still, true);
  EXPECT_EQ(this->Images(), images + 1);
}

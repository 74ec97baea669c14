// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Volumes behind the membranes of vtkRefractionPass: the image equals that of the mapper alone,
// apart from Fresnel's transmittance.
#include "RayCastScene.h"
#include "SceneParts.h"
#include "StrictImage.h"

#include <vtkRefractedGeometryFilter.h>
#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkRefractionPass.h>
#include <vtkSSAAPass.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Water = 1.333;
constexpr double Range[2] = { -1.0, 1.0 };

/** A block of [-1, 1]^3 in water up to a level, above a floor, seen from above. */
class Basin
{
public:
  explicit Basin(double level, double halfWidth = 6.0)
    : Mesh(MakeBlock(6, WavyField(3.0)))
    , Surface(MakePlane(halfWidth, level, 4))
    , Bottom(MakePlane(2.0, -1.5, 40))
    , Scene(Size, Size)
  {
    this->Mapper->SetBackend(BackendUnderTest());
    this->Mapper->SetInputData(this->Mesh);
    this->Mapper->SetMembraneConnection(this->Surface->GetOutputPort());
    this->Mapper->SetInteriorIndexOfRefraction(Water);
    this->Volume->SetMapper(this->Mapper);
    this->Volume->SetProperty(MakeProperty(FunctionKind::Smooth, Range, 3.4));
    this->Filter->SetInputConnection(this->Bottom->GetOutputPort());
    this->Filter->SetMembraneConnection(this->Surface->GetOutputPort());
    this->Filter->SetInteriorIndexOfRefraction(Water);
    this->Filter->SetCamera(this->GetCamera());
    this->Floor = MakeActor(this->Filter->GetOutputPort());
    SetFlatColor(this->Floor, 0.9, 0.7, 0.2);
    this->Membrane = MakeActor(this->Surface->GetOutputPort());
    this->Pass->SetReflectanceModel(vtkRefractionPass::NONE);
    this->GetRenderer()->SetBackground(0.2, 0.3, 0.5);
    this->GetCamera()->SetPosition(1.5, 2.5, 5.0);
    this->GetCamera()->SetFocalPoint(0.0, 0.0, 0.0);
    this->GetCamera()->SetViewUp(0.0, 1.0, 0.0);
    this->GetCamera()->SetViewAngle(40.0);
    this->GetCamera()->SetClippingRange(0.5, 20.0);
  }

  vtkRenderer* GetRenderer() { return this->Scene.GetRenderer(); }
  vtkCamera* GetCamera() { return this->GetRenderer()->GetActiveCamera(); }

  /** Image by the mapper alone, with the virtual floor as an actor. */
  ByteImage RenderPlain()
  {
    this->Pass->RemoveAllRefractions();
    this->GetRenderer()->SetPass(nullptr);
    this->GetRenderer()->AddActor(this->Floor);
    this->GetRenderer()->AddVolume(this->Volume);
    this->Scene.GetWindow()->Render();
    const ByteImage image = ReadBytes(this->Scene.GetWindow());
    this->GetRenderer()->RemoveActor(this->Floor);
    this->GetRenderer()->RemoveVolume(this->Volume);
    return image;
  }

  ByteImage RenderPass()
  {
    this->Pass->RemoveAllRefractions();
    this->Pass->AddRefraction(this->Membrane, this->Floor, this->Filter);
    this->Pass->AddVolume(this->Membrane, this->Volume);
    this->GetRenderer()->SetPass(this->Pass);
    this->Scene.GetWindow()->Render();
    return ReadBytes(this->Scene.GetWindow());
  }

  Grid Mesh;
  vtkSmartPointer<vtkPlaneSource> Surface;
  vtkSmartPointer<vtkPlaneSource> Bottom;
  vtkNew<vtkTetrahedraRayCastMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRefractedGeometryFilter> Filter;
  vtkSmartPointer<vtkActor> Floor;
  vtkSmartPointer<vtkActor> Membrane;
  vtkNew<vtkRefractionPass> Pass;
  VolumeScene Scene;
};

/** Allows for the rounding of two parts of a picture. */
StrictDifference Compare(const ByteImage& a, const ByteImage& b)
{
  return CompareStrictly(a, b, 2);
}

} // anonymous namespace

TEST(RefractionPassVolume, IsThePictureOfTheMapperAlone)
{
  // Below, across and above the water; each part is rounded to 8 bits.
  for (const double level : { 1.3, 0.2, -1.2 })
  {
    Basin basin(level);
    const ByteImage plain = basin.RenderPlain();
    const StrictDifference off = Compare(basin.RenderPass(), plain);
    EXPECT_LE(off.Largest, 2) << level;
    EXPECT_EQ(basin.Mapper->GetNumberOfLostRays(), 0);
  }
}

/** With several interfaces the parts meet at the first, which is the one that the pass draws. */
TEST(RefractionPassVolume, PaneIsThePictureOfTheMapperAlone)
{
  for (const double level : { 1.3, 0.2 })
  {
    Basin basin(level);
    const ByteImage once = basin.RenderPlain();
    const auto lower = MakePlane(4.0, level - 0.4, 3);
    basin.Mapper->AddMembraneConnection(lower->GetOutputPort());
    vtkNew<vtkRefractingInterfaceCollection> list;
    for (const double index : { 1.0, 1.5 })
    {
      vtkNew<vtkRefractingInterface> interface;
      interface->SetExteriorIndexOfRefraction(index);
      interface->SetInteriorIndexOfRefraction(2.5 - index);
      list->AddItem(interface);
    }
    basin.Mapper->SetInterfaces(list);
    const ByteImage plain = basin.RenderPlain();
    EXPECT_GT(Compare(once, plain).PixelsBeyond, 100u);
    EXPECT_LE(Compare(basin.RenderPass(), plain).Largest, 2) << level;
    EXPECT_EQ(basin.Mapper->GetNumberOfLostRays(), 0);
  }
}

TEST(RefractionPassVolume, EveryBlendModeBehindWater)
{
  for (const int mode : { vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, vtkVolumeMapper::ADDITIVE_BLEND,
         vtkVolumeMapper::ISOSURFACE_BLEND })
  {
    Basin basin(1.3);
    basin.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.12);
    basin.Mapper->SetBlendMode(mode);
    const ByteImage plain = basin.RenderPlain();
    EXPECT_LE(Compare(basin.RenderPass(), plain).Largest, 2) << mode;
  }
}

TEST(RefractionPassVolume, BesideTheMembraneItIsSeenAsItIs)
{
  Basin basin(0.2, 0.7);
  basin.Floor->VisibilityOff(); // without a membrane, the pass would draw it where there is none
  const ByteImage plain = basin.RenderPlain();
  const StrictDifference off = Compare(basin.RenderPass(), plain);
  // At the membrane's border the pass decides by the pixel's centre, as rays do, up to rounding.
  EXPECT_LE(off.PixelsBeyond, 8u) << off.Largest;
}

TEST(RefractionPassVolume, FresnelTakesItsShare)
{
  Basin basin(1.3);
  basin.GetCamera()->SetPosition(0.0, 0.0, 5.0);
  const ByteImage through = basin.RenderPass();
  basin.Pass->SetReflectanceModel(vtkRefractionPass::FRESNEL);
  const ByteImage with = basin.RenderPass();
  const double share = std::pow((Water - 1.0) / (Water + 1.0), 2.0);
  double background[3];
  basin.GetRenderer()->GetBackground(background);
  for (int c = 0; c < 3; ++c)
  {
    const double expected =
      (1.0 - share) * through.GetPixel(Size / 2, Size / 2)[c] + share * 255.0 * background[c];
    EXPECT_NEAR(with.GetPixel(Size / 2, Size / 2)[c], expected, 1.5);
  }
}

TEST(RefractionPassVolume, BehindAMembraneThatIsNotVisibleNothingIsSeen)
{
  // The whole volume is above the water, then all of it below.
  Basin above(-1.2);
  above.Membrane->VisibilityOff();
  above.Floor->VisibilityOff();
  const ByteImage plain = above.RenderPlain();
  EXPECT_LE(Compare(above.RenderPass(), plain).Largest, 1);
  EXPECT_EQ(above.Pass->GetNumberOfMembranesDrawn(), 0);
  EXPECT_EQ(above.Pass->GetNumberOfMembranesSkipped(), 1);

  Basin below(1.3);
  below.Membrane->VisibilityOff();
  const ByteImage hidden = below.RenderPass();
  double background[3];
  below.GetRenderer()->GetBackground(background);
  for (std::size_t i = 0; i < hidden.Rgb.size(); ++i)
  {
    ASSERT_NEAR(hidden.Rgb[i], 255.0 * background[i % 3], 1.0);
  }
}

TEST(RefractionPassVolume, EqualIndicesAreNoMembrane)
{
  Basin basin(0.2);
  basin.Floor->VisibilityOff();
  basin.Mapper->SetInteriorIndexOfRefraction(1.0);
  basin.Filter->SetInteriorIndexOfRefraction(1.0);
  const ByteImage plain = basin.RenderPlain();
  EXPECT_LE(Compare(basin.RenderPass(), plain).Largest, 2);
}

TEST(RefractionPassVolume, RaysAreTracedOnceForBothParts)
{
  Basin basin(0.2);
  basin.RenderPass();
  EXPECT_EQ(basin.Mapper->GetStatistic("NumberOfSightUpdates"), 1);
  EXPECT_EQ(basin.Mapper->GetStatistic("UsedImageSampleDistance"), 1.0);
  basin.Scene.GetWindow()->Render();
  EXPECT_EQ(basin.Mapper->GetStatistic("NumberOfSightUpdates"), 1);
  EXPECT_EQ(basin.Mapper->GetNumberOfMeshBuilds(), 1);
  basin.GetCamera()->Azimuth(5.0);
  basin.Scene.GetWindow()->Render();
  EXPECT_EQ(basin.Mapper->GetStatistic("NumberOfSightUpdates"), 2);
}

TEST(RefractionPassVolume, WithinSSAA)
{
  // Its images are larger than the window. The result is smoother, and covers the same pixels.
  Basin basin(0.2);
  basin.Floor->VisibilityOff();
  const ByteImage plain = basin.RenderPass();
  vtkNew<vtkSSAAPass> ssaa;
  ssaa->SetDelegatePass(basin.Pass);
  basin.GetRenderer()->SetPass(ssaa);
  basin.Scene.GetWindow()->Render();
  const ByteImage smooth = ReadBytes(basin.Scene.GetWindow());
  double sum = 0.0;
  for (std::size_t i = 0; i < plain.Rgb.size(); ++i)
  {
    sum += std::abs(int{ plain.Rgb[i] } - int{ smooth.Rgb[i] });
  }
  EXPECT_LT(sum / static_cast<double>(plain.Rgb.size()), 1.0);
}

TEST(RefractionPassVolume, BadInputIsAnError)
{
  Basin basin(0.2);
  const auto errors = ObserveErrors(basin.Pass);
  vtkNew<vtkVolume> empty;
  basin.Pass->AddVolume(nullptr, basin.Volume);
  basin.Pass->AddVolume(basin.Membrane, nullptr);
  basin.Pass->AddVolume(basin.Membrane, empty);
  EXPECT_EQ(errors->Errors.size(), 3u);
  EXPECT_EQ(basin.Pass->GetNumberOfRefractions(), 0);
  basin.Pass->AddVolume(basin.Membrane, basin.Volume);
  EXPECT_EQ(basin.Pass->GetNumberOfRefractions(), 1);
  basin.Pass->RemoveRefraction(basin.Volume);
  EXPECT_EQ(basin.Pass->GetNumberOfRefractions(), 0);
}

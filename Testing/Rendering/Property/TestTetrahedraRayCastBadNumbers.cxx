// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a volume property that are not finite: a warning names them, and the picture is drawn
// without them.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 64;
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

using Edit = std::function<void(vtkVolumeProperty*)>;

vtkPiecewiseFunction* OpacityOf(vtkVolumeProperty* property)
{
  return property->GetScalarOpacity();
}

struct Drawn
{
  ByteImage Picture;
  vtkSmartPointer<ErrorObserver> Told;
};

/** The second of two frames, and what both of them told. */
Drawn Draw(int blendMode, const Edit& edit)
{
  const Grid grid = MakeBlock(4, WavyField(2.0));
  vtkNew<vtkVolumeProperty> property;
  property->SetScalarOpacityUnitDistance(1.0);
  property->SetScalarOpacity(MakeOpacity({ { -1.0, 0.1 }, { 0.2, 0.9 }, { 1.0, 0.4 } }));
  property->SetColor(MakeColors({ { -1.0, 1.0, 0.2, 0.1 }, { 1.0, 0.1, 0.5, 1.0 } }));
  property->GetIsoSurfaceValues()->SetValue(0, 0.1);
  edit(property);
  RayCastScene scene(grid, property, Size, Size);
  scene.GetRayCaster()->SetBlendMode(blendMode);
  Drawn drawn;
  drawn.Told = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  drawn.Told->Observe(scene.GetRayCaster());
  scene.RenderBytes();
  drawn.Picture = scene.RenderBytes();
  return drawn;
}

/** Expects the picture of another edit of the property, and one warning with these words. */
void ExpectWarning(
  int blendMode, const Edit& edit, const Edit& same, const std::vector<std::string>& words)
{
  const Drawn drawn = Draw(blendMode, edit);
  const Drawn expected = Draw(blendMode, same);
  EXPECT_TRUE(expected.Told->Warnings.empty());
  EXPECT_TRUE(drawn.Picture.Rgb == expected.Picture.Rgb) << words.front();
  EXPECT_TRUE(drawn.Told->Errors.empty());
  ASSERT_EQ(drawn.Told->Warnings.size(), 1u) << words.front();
  for (const std::string& word : words)
  {
    EXPECT_TRUE(HasText(drawn.Told->Warnings.front(), word)) << "no \"" << word << "\" in: ";
  }
}

/** Expects an empty picture, and an error with these words. */
void ExpectError(const Edit& edit, const std::vector<std::string>& words)
{
  const Drawn drawn = Draw(vtkVolumeMapper::COMPOSITE_BLEND, edit);
  const Drawn empty = Draw(vtkVolumeMapper::COMPOSITE_BLEND,
    [](vtkVolumeProperty* property) { OpacityOf(property)->RemoveAllPoints(); });
  EXPECT_TRUE(drawn.Picture.Rgb == empty.Picture.Rgb);
  EXPECT_FALSE(drawn.Told->Errors.empty());
  for (const std::string& word : words)
  {
    EXPECT_TRUE(HasText(drawn.Told->GetText(), word)) << "no \"" << word << "\" in: ";
  }
}

void Keep(vtkVolumeProperty*) {}

} // anonymous namespace

TEST(TetrahedraRayCastBadNumbers, NodesOfTheOpacity)
{
  const int composite = vtkVolumeMapper::COMPOSITE_BLEND;
  for (const double bad : { NaN, Infinity, -Infinity })
  {
    ExpectWarning(composite,
      [&](vtkVolumeProperty* property) { OpacityOf(property)->AddPoint(bad, 0.7); }, Keep,
      { "1 of the 4 nodes of the scalar opacity is not finite", ", 0.7)" });
    ExpectWarning(composite,
      [&](vtkVolumeProperty* property) { OpacityOf(property)->AddPoint(0.5, bad); }, Keep,
      { "1 of the 4 nodes of the scalar opacity is not finite", "(0.5, " });
  }
  ExpectWarning(vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND,
    [](vtkVolumeProperty* property)
    {
      OpacityOf(property)->AddPoint(0.5, NaN);
      OpacityOf(property)->AddPoint(0.6, NaN);
      OpacityOf(property)->AddPoint(0.7, 0.2, NaN, 0.0);
    },
    Keep,
    { "3 of the 6 nodes of the scalar opacity are not finite, the first of them (0.5, nan)" });
}

/** Negative opacities count as 0, as those of a function whose negative part is cut off. */
TEST(TetrahedraRayCastBadNumbers, NegativeOpacities)
{
  ExpectWarning(
    vtkVolumeMapper::COMPOSITE_BLEND,
    [](vtkVolumeProperty* property) {
      property->SetScalarOpacity(MakeOpacity({ { -1.0, -0.5 }, { 0.0, -0.5 }, { 1.0, 0.5 } }));
    },
    [](vtkVolumeProperty* property) {
      property->SetScalarOpacity(MakeOpacity({ { -1.0, 0.0 }, { 0.5, 0.0 }, { 1.0, 0.5 } }));
    },
    { "2 of the 3 nodes of the scalar opacity are negative: negative opacities count as 0" });
}

TEST(TetrahedraRayCastBadNumbers, NodesOfTheColor)
{
  for (const double bad : { NaN, Infinity, -Infinity })
  {
    ExpectWarning(vtkVolumeMapper::COMPOSITE_BLEND,
      [&](vtkVolumeProperty* property)
      { property->GetRGBTransferFunction()->AddRGBPoint(0.1, 0.2, bad, 0.3); },
      Keep, { "1 of the 3 nodes of the colour function is not finite, (0.1, 0.2, " });
    ExpectWarning(vtkVolumeMapper::AVERAGE_INTENSITY_BLEND,
      [&](vtkVolumeProperty* property)
      { property->GetRGBTransferFunction()->AddRGBPoint(bad, 0.2, 0.3, 0.3); },
      Keep, { "1 of the 3 nodes of the colour function is not finite" });
  }
  const auto setGray = [](vtkVolumeProperty* property, bool bad)
  {
    const auto gray = MakeOpacity({ { -1.0, 0.2 }, { 1.0, 0.9 } });
    if (bad)
    {
      gray->AddPoint(0.0, NaN);
    }
    property->SetColor(gray);
  };
  ExpectWarning(
    vtkVolumeMapper::COMPOSITE_BLEND, [&](vtkVolumeProperty* property) { setGray(property, true); },
    [&](vtkVolumeProperty* property) { setGray(property, false); },
    { "1 of the 3 nodes of the grey levels is not finite, (0, nan)" });
}

TEST(TetrahedraRayCastBadNumbers, NodesOfTheGradientOpacity)
{
  const auto setGradient = [](vtkVolumeProperty* property, bool bad)
  {
    const auto opacity = MakeOpacity({ { 0.0, 0.1 }, { 4.0, 1.0 } });
    if (bad)
    {
      opacity->AddPoint(2.0, NaN);
    }
    property->SetGradientOpacity(opacity);
  };
  ExpectWarning(
    vtkVolumeMapper::COMPOSITE_BLEND,
    [&](vtkVolumeProperty* property) { setGradient(property, true); },
    [&](vtkVolumeProperty* property) { setGradient(property, false); },
    { "1 of the 3 nodes of the gradient opacity is not finite, (2, nan)" });
}

TEST(TetrahedraRayCastBadNumbers, Isovalues)
{
  ExpectWarning(vtkVolumeMapper::ISOSURFACE_BLEND,
    [](vtkVolumeProperty* property) { property->GetIsoSurfaceValues()->SetValue(1, NaN); }, Keep,
    { "isovalue of number 1 is nan" });
}

TEST(TetrahedraRayCastBadNumbers, NothingIsLeft)
{
  ExpectError(
    [](vtkVolumeProperty* property) {
      SetPoints(OpacityOf(property), { { 0.0, NaN }, { 1.0, NaN } });
    },
    { "2 of the 2 nodes of the scalar opacity are not finite", "(0, nan)", "no other node",
      "nothing is rendered" });
}

// A field of whole steps, and functions of it, in other units: the same picture.
TEST(TetrahedraRayCastBadNumbers, ScalarsOfAnySize)
{
  constexpr int steps = 16;
  const auto draw = [](double offset, double step)
  {
    const Grid grid = MakeBlock(4, WavyField(2.0));
    // Halves, because the width may be larger than the largest number.
    const auto at = [offset, step](double number)
    { return 2.0 * (0.5 * offset + 0.5 * step * number); };
    grid->GetPointData()->SetScalars(MakeArray(ScalarName, grid->GetNumberOfPoints(),
      [&](vtkIdType i) { return at(static_cast<double>(7 * i * i % (steps + 1))); }));
    vtkNew<vtkVolumeProperty> property;
    property->SetScalarOpacity(
      MakeOpacity({ { at(0.0), 0.1 }, { at(4.0), 0.9 }, { at(steps), 0.3 } }));
    property->SetColor(MakeColors({ { at(0.0), 1.0, 0.2, 0.1 }, { at(steps), 0.1, 0.5, 1.0 } }));
    RayCastScene scene(grid, property, Size, Size);
    return scene.RenderBytes();
  };
  const double smallest = std::numeric_limits<double>::denorm_min();
  const ByteImage expected = draw(0.0, 1.0);
  for (const auto& [offset, step] : std::vector<std::pair<double, double>>{ { 1.0e+15, 0.125 },
         { -1.0e+300, 8.0 * (1.0e+300 - std::nextafter(1.0e+300, 0.0)) }, { 0.0, 1.0e+307 },
         { -0.8e+308, 1.0e+307 }, { -1.6e+308, 2.0e+307 }, { 0.0, 1.0e-305 },
         { 0.0, 4096.0 * smallest } })
  {
    const ByteImage picture = draw(offset, step);
    int worst = 0;
    for (std::size_t i = 0; i < picture.Rgb.size(); ++i)
    {
      worst = std::max(worst, std::abs(int{ picture.Rgb[i] } - int{ expected.Rgb[i] }));
    }
    EXPECT_LE(worst, 1) << offset << " + " << step;
  }
}

// The difference of two nodes exceeds the largest number.
TEST(TetrahedraRayCastBadNumbers, CurvesOfAnyWidth)
{
  const auto setOpacity = [](vtkVolumeProperty* property, double sharpness)
  {
    OpacityOf(property)->RemoveAllPoints();
    OpacityOf(property)->AddPoint(-1.0e+308, 0.2, 0.5, sharpness);
    OpacityOf(property)->AddPoint(1.0e+308, 0.8);
  };
  ExpectWarning(
    vtkVolumeMapper::COMPOSITE_BLEND,
    [&](vtkVolumeProperty* property) { setOpacity(property, 0.7); },
    [&](vtkVolumeProperty* property) { setOpacity(property, 0.0); },
    { "nodes of the scalar opacity at -1e+308 and 1e+308 are too far apart" });
  const auto setColor = [](vtkVolumeProperty* property, bool curved)
  {
    vtkColorTransferFunction* color = property->GetRGBTransferFunction();
    color->RemoveAllPoints();
    color->AddRGBPoint(-1.0e+308, 1.0, 0.2, 0.1);
    color->AddRGBPoint(1.0e+308, 0.1, 0.5, 1.0);
    if (curved)
    {
      color->SetColorSpaceToLab();
    }
  };
  ExpectWarning(
    vtkVolumeMapper::COMPOSITE_BLEND,
    [&](vtkVolumeProperty* property) { setColor(property, true); },
    [&](vtkVolumeProperty* property) { setColor(property, false); },
    { "nodes of the colour function at -1e+308 and 1e+308 are too far apart" });
}

TEST(TetrahedraRayCastBadNumbers, Shading)
{
  using Setter = void (vtkVolumeProperty::*)(double);
  const std::pair<const char*, Setter> setters[] = { { "Ambient", &vtkVolumeProperty::SetAmbient },
    { "Diffuse", &vtkVolumeProperty::SetDiffuse }, { "Specular", &vtkVolumeProperty::SetSpecular },
    { "SpecularPower", &vtkVolumeProperty::SetSpecularPower } };
  for (const auto& [name, setter] : setters)
  {
    for (const double bad : { NaN, Infinity, -Infinity })
    {
      const Edit edit = [setter = setter, bad](vtkVolumeProperty* property)
      { (property->*setter)(bad); };
      ExpectError(
        [&edit](vtkVolumeProperty* property)
        {
          edit(property);
          property->ShadeOn();
        },
        { "Nothing is rendered", name, "finite numbers" });
      // Without shading they are not used.
      const Drawn unlit = Draw(vtkVolumeMapper::COMPOSITE_BLEND, edit);
      EXPECT_TRUE(unlit.Told->Errors.empty());
      EXPECT_TRUE(unlit.Picture.Rgb == Draw(vtkVolumeMapper::COMPOSITE_BLEND, Keep).Picture.Rgb);
    }
  }
}

TEST(TetrahedraRayCastBadNumbers, Lights)
{
  const std::pair<const char*, std::function<void(vtkLight*)>> edits[] = { { "", [](vtkLight*) {} },
    { "number that is not finite", [](vtkLight* light) { light->SetIntensity(NaN); } },
    { "number that is not finite",
      [](vtkLight* light) { light->SetDiffuseColor(1.0, Infinity, 1.0); } },
    { "number that is not finite",
      [](vtkLight* light)
      {
        light->PositionalOn();
        light->SetAttenuationValues(1.0, NaN, 0.0);
      } },
    { "no direction", [](vtkLight* light) { light->SetPosition(light->GetFocalPoint()); } },
    { "",
      [](vtkLight* light)
      {
        light->SetIntensity(NaN);
        light->SwitchOff();
      } } };
  for (const auto& [words, edit] : edits)
  {
    const Grid grid = MakeBlock(4, WavyField(2.0));
    vtkNew<vtkVolumeProperty> property;
    property->ShadeOn();
    RayCastScene scene(grid, property, Size, Size);
    LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 20.0);
    vtkNew<vtkLight> light;
    light->SetPosition(1.0, 2.0, 3.0);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    edit(light);
    scene.GetRenderer()->AddLight(light);
    const auto told = ObserveErrors(scene.GetRayCaster());
    scene.RenderBytes();
    EXPECT_TRUE(told->Errors.empty()) << told->GetText();
    ASSERT_EQ(told->Warnings.empty(), std::string(words).empty()) << words;
    EXPECT_TRUE(told->Warnings.empty() || HasText(told->Warnings.front(), words));
  }
}

TEST(TetrahedraRayCastBadNumbers, UnitDistance)
{
  for (const double bad : { 0.0, -1.0, NaN, Infinity, -Infinity })
  {
    std::ostringstream number;
    number << bad;
    const Edit edit = [bad](vtkVolumeProperty* property)
    { property->SetScalarOpacityUnitDistance(bad); };
    ExpectError(edit, { "ScalarOpacityUnitDistance", number.str(), "above 0" });
    // A projection does not use it.
    const Drawn projected = Draw(vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, edit);
    const Drawn expected = Draw(vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND, Keep);
    EXPECT_TRUE(projected.Picture.Rgb == expected.Picture.Rgb);
    EXPECT_TRUE(projected.Told->Errors.empty());
  }
}

TEST(TetrahedraRayCastBadNumbers, ClippingPlanes)
{
  const Grid grid = MakeBlock(2, ConstantField(0.5));
  for (const bool isOrigin : { true, false })
  {
    vtkNew<vtkPlane> good;
    vtkNew<vtkPlane> bad;
    isOrigin ? bad->SetOrigin(NaN, 0.0, 0.0) : bad->SetNormal(1.0, Infinity, 0.0);
    RayCastScene scene(grid, MakeConstantProperty(0.7, 1, 1, 1, 0.8), Size, Size);
    scene.GetRayCaster()->AddClippingPlane(good);
    scene.GetRayCaster()->AddClippingPlane(bad);
    const auto told = ObserveErrors(scene.GetRayCaster());
    const ByteImage image = scene.RenderBytes();
    EXPECT_TRUE(HasText(told->GetText(), "clipping plane 1 is not finite"));
    EXPECT_EQ(*std::max_element(image.Rgb.begin(), image.Rgb.end()), 0);
  }
}

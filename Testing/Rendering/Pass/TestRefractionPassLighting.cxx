// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lighting in true space, compared with closed forms: the floor of a pool under flat water.
#include "FlatPoolLamps.h"

#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

TEST(RefractionPassLighting, LightsAtInfinityAreRefracted)
{
  LitPool pool;
  pool.ExpectLit("from above", { Distant(0.0, 0.0, 1.0) });
  pool.ExpectLit("aslant", { Distant(0.8, -0.3, 0.4) });
  pool.ExpectLit("grazing", { Distant(1.0, 0.2, 0.01) });
}

/** Light of a sun on a floor under flat water: cos i (1 - F), of light across the sun's rays. */
TEST(RefractionPassLighting, TheFloorHasTheFluxThatTheWaterTransmits)
{
  LitPool pool;
  const std::pair<double, double> expected[] = { { 0.0, 0.9796 }, { 45.0, 0.6874 },
    { 75.0, 0.2039 } };
  for (const auto& [degrees, share] : expected)
  {
    const double angle = vtkMath::RadiansFromDegrees(degrees);
    const Lamp sun = Distant(std::sin(angle), 0.0, std::cos(angle));
    const LampRay ray = TraceLamp(sun, glm::dvec3(0.0, 0.0, -Depth));
    EXPECT_NEAR(ray.Flux * ray.ToLamp.z, share, 1.0e-4) << degrees;
    pool.ExpectLit("sun", { sun });
  }
}

/** Behind a flat pane in air: no turn of the rays, and the loss at both sides. */
TEST(RefractionPassLighting, APaneTransmitsTheLightOfBothSides)
{
  constexpr double glass = 1.5;
  LitPool pool;
  vtkNew<vtkRefractingInterface> back;
  back->SetExteriorIndexOfRefraction(glass);
  back->SetInteriorIndexOfRefraction(1.0);
  pool.Filter->SetInteriorIndexOfRefraction(glass);
  pool.Filter->GetInterfaces()->AddItem(back);
  pool.Filter->AddMembraneConnection(MakePlane(5.0, -0.1, 4)->GetOutputPort());
  pool.Filter->SetImagesToFirstImage();
  const std::pair<double, double> expected[] = { { 0.0, 0.9231 }, { 75.0, 0.6182 } };
  for (const auto& [degrees, share] : expected)
  {
    const double angle = vtkMath::RadiansFromDegrees(degrees);
    pool.Floor->GetProperty()->SetSpecular(0.0);
    pool.SetLamps({ Distant(std::sin(angle), 0.0, std::cos(angle)) });
    const ByteImage image = pool.Render();
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(image.GetPixel(Size / 2, Size / 2)[c] / 255.0,
        Albedo[c] * (Ambient + Diffuse * share * std::cos(angle)), Rounding);
    }
  }
}

TEST(RefractionPassLighting, LampsInTheWater)
{
  LitPool pool;
  pool.ExpectLit("lamp", { Near(0.7, -0.4, -0.6) });
  pool.ExpectLit("next to the floor", { Near(-0.5, 0.3, -1.3) });
}

TEST(RefractionPassLighting, LampsAboveTheWater)
{
  LitPool pool;
  pool.ExpectLit("lamp", { Near(0.7, -0.4, 0.8) });
  pool.ExpectLit("far to the side", { Near(-6.0, 3.0, 0.5) });
  pool.ExpectLit("next to the water", { Near(0.2, 0.1, 0.01) });
}

TEST(RefractionPassLighting, SpotLights)
{
  // Exponents make the light vanish at the edge of the cone, which is then smooth.
  LitPool pool;
  for (const double height : { -0.4, 1.0 })
  {
    Lamp lamp = Near(0.3, 0.2, height);
    lamp.Axis = { 0.2, -0.1, -1.0 };
    lamp.ConeAngle = 89.0;
    lamp.Exponent = 20.0;
    pool.ExpectLit("spot at " + std::to_string(height), { lamp });
  }
}

TEST(RefractionPassLighting, SeveralLightsAddUp)
{
  LitPool pool;
  std::vector<Lamp> lamps{ Distant(0.8, -0.3, 0.4), Near(0.7, -0.4, -0.6), Near(-1.0, 0.5, 0.8) };
  const glm::dvec3 colors[3] = { { 0.5, 0.1, 0.1 }, { 0.1, 0.6, 0.2 }, { 0.1, 0.2, 0.7 } };
  for (std::size_t i = 0; i < 3; ++i)
  {
    lamps[i].Color = colors[i];
  }
  pool.ExpectLit("three", lamps);
}

TEST(RefractionPassLighting, TheMediumAttenuatesLightOnItsWay)
{
  LitPool pool;
  const glm::dvec3 coefficients(0.8, 0.2, 0.05);
  pool.Pass->SetAttenuationCoefficients(coefficients.r, coefficients.g, coefficients.b);
  const std::vector<Lamp> lamps{ Distant(0.8, -0.3, 0.4), Near(0.7, -0.4, -0.6),
    Near(-1.0, 0.5, 0.8) };
  for (const Lamp& lamp : lamps)
  {
    pool.ExpectLit("attenuated", { lamp }, coefficients);
  }
}

/** Without LightAttenuation the medium dims only what is seen, not the light. */
TEST(RefractionPassLighting, LightAttenuationCanBeLeftOut)
{
  LitPool pool;
  const glm::dvec3 coefficients(0.8, 0.2, 0.05);
  pool.Pass->SetAttenuationCoefficients(coefficients.r, coefficients.g, coefficients.b);
  EXPECT_TRUE(pool.Pass->GetLightAttenuation());
  pool.Pass->LightAttenuationOff();
  pool.ExpectLit("sun", { Distant(0.8, -0.3, 0.4) }, coefficients, false);
  pool.ExpectLit("lamp", { Near(0.7, -0.4, -0.6) }, coefficients, false);
  pool.Pass->LightAttenuationOn();
  pool.ExpectLit("attenuated again", { Near(0.7, -0.4, -0.6) }, coefficients);
}

TEST(RefractionPassLighting, WithoutNormalsFacetsAreLit)
{
  LitPool pool;
  pool.Bottom->Update();
  const auto bare = vtkSmartPointer<vtkPolyData>::New();
  bare->ShallowCopy(pool.Bottom->GetOutput());
  bare->GetPointData()->Initialize();
  pool.Filter->SetInputData(bare);
  pool.ExpectLit("facets", { Near(0.7, -0.4, -0.6), Distant(0.8, -0.3, 0.4) });
}

TEST(RefractionPassLighting, BothSidesOfASurfaceAreLit)
{
  LitPool pool;
  pool.Bottom->Update();
  const auto turned = vtkSmartPointer<vtkPolyData>::New();
  turned->DeepCopy(pool.Bottom->GetOutput());
  vtkDataArray* normals = turned->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    normals->SetTuple3(i, 0.0, 0.0, -1.0);
  }
  pool.Filter->SetInputData(turned);
  pool.ExpectLit("turned normals", { Near(0.7, -0.4, -0.6) });
}

TEST(RefractionPassLighting, LightsOnTheSurfaceAreLeftOut)
{
  LitPool pool;
  const auto messages = ObserveErrors(pool.Pass);
  const Lamp good = Near(0.7, -0.4, -0.6);
  pool.SetLamps({ Near(0.3, 0.1, 0.0), good, Distant(1.0, 0.5, 0.0) });
  ExpectColors(pool, "two of three left out",
    [&](const Sight& sight, int channel)
    { return LitColor({ good }, FloorOf(pool.GetCamera(), sight), glm::dvec3(0.0))[channel]; });
  EXPECT_EQ(messages->Warnings.size(), 1u);
  EXPECT_EQ(pool.Pass->GetNumberOfSkippedLights(), 2);
  pool.Render();
  EXPECT_EQ(messages->Warnings.size(), 1u) << "one warning for the same lights";
  std::vector<Lamp> many(18, good);
  for (Lamp& lamp : many)
  {
    lamp.Color = glm::dvec3(1.0 / 16.0);
  }
  pool.SetLamps(many);
  ExpectColors(pool, "more than there is room for",
    [&](const Sight& sight, int channel)
    { return LitColor({ good }, FloorOf(pool.GetCamera(), sight), glm::dvec3(0.0))[channel]; });
  EXPECT_EQ(messages->Warnings.size(), 2u);
  EXPECT_TRUE(messages->Errors.empty()) << messages->GetText();
}

/** The matrix of its actor may make a membrane flat: here, a wall is turned to become the water. */
TEST(RefractionPassLighting, AMembraneThatItsMatrixMakesFlat)
{
  LitPool pool;
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(-3.0, 0.0, -3.0);
  wall->SetPoint1(3.0, 0.0, -3.0);
  wall->SetPoint2(-3.0, 0.0, 3.0);
  pool.Membrane = MakeActor(wall->GetOutputPort());
  pool.Membrane->RotateX(-90.0);
  pool.Membrane->SetScale(1.0, 0.0, 1.0);
  pool.Pass->RemoveAllRefractions();
  pool.Pass->AddRefraction(pool.Membrane, pool.Floor, pool.Filter);
  pool.ExpectLit("aslant", { Distant(0.8, -0.3, 0.4) });
}

TEST(RefractionPassLighting, WithoutTruePositionsThereIsAnError)
{
  LitPool pool;
  const auto messages = ObserveErrors(pool.Pass);
  pool.SetLamps({ Near(0.7, -0.4, -0.6) });
  pool.Filter->TrueGeometryOff();
  const ByteImage without = pool.Render();
  EXPECT_EQ(messages->Errors.size(), 1u);
  pool.Pass->SetLighting(vtkRefractionPass::VIRTUAL_SPACE);
  EXPECT_EQ(pool.Render().Rgb, without.Rgb);
  EXPECT_EQ(messages->Errors.size(), 1u);
  // The arrays may come later.
  pool.Pass->SetLighting(vtkRefractionPass::TRUE_SPACE);
  pool.Filter->TrueGeometryOn();
  pool.ExpectLit("again", { Near(0.7, -0.4, -0.6) });
  EXPECT_EQ(messages->Errors.size(), 1u);
}

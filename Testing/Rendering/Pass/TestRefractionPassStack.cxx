// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Fresnel's equations at every interface of a pane of glass above water, in closed form.
#include "ExactStack.h"
#include "FlatPool.h"

#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;
using meniscus::reference::MakePlateTransmittance;
using meniscus::reference::MakeReflectances;

namespace
{

constexpr double Glass = 1.5;
constexpr double Thickness = 0.3;

/** The pool, with a pane of glass on the water: glass from 0 to -0.3, and water below it. */
void AddPane(Pool& pool)
{
  vtkNew<vtkRefractingInterface> lower;
  lower->SetExteriorIndexOfRefraction(Glass);
  lower->SetInteriorIndexOfRefraction(Water);
  pool.Filter->SetInteriorIndexOfRefraction(Glass);
  pool.Filter->GetInterfaces()->AddItem(lower);
  pool.Filter->SetImagesToFirstImage();
  const auto surface = MakePlane(5.0, -Thickness, 4);
  pool.Filter->AddMembraneConnection(surface->GetOutputPort());
  // Cells at the edge of the pane have no image: they must lie in the border that is not compared.
  pool.Bottom->SetResolution(240, 240);
}

double SineOf(const Sight& sight)
{
  return std::sqrt(1.0 - sight.Cosine * sight.Cosine);
}

}

/** White objects behind a pane, on water and in air, and the background that it reflects. */
TEST(RefractionPassStack, APaneReflectsByBothSides)
{
  for (const double behind : { Water, 1.0 })
  {
    Pool pool;
    AddPane(pool);
    pool.Filter->GetInterfaces()->GetInterface(1)->SetInteriorIndexOfRefraction(behind);
    // To the side, where the second interface reflects most.
    for (const double x : { 0.0, 3.0, 6.0 })
    {
      pool.LookFrom(x, 0.0);
      ExpectColors(pool, "pane",
        [&](const Sight& sight, int channel)
        {
          const double passed = MakePlateTransmittance(SineOf(sight), 1.0, Glass, behind);
          return passed + (1.0 - passed) * Background[channel];
        });
    }
  }
}

/**
 * The middle of the picture, seen at an angle, for several stacks of plates. m panes in air
 * transmit (1 - R) / (1 + (2 m - 1) R) of each polarisation: Stokes's pile of plates.
 */
TEST(RefractionPassStack, StacksOfPlatesInClosedForm)
{
  struct Stack
  {
    std::string Name;
    std::vector<double> Media; // behind each surface
  };
  const std::vector<Stack> stacks{ { "water", { Water } }, { "a pane in air", { Glass, 1.0 } },
    { "a pane on water", { Glass, Water } }, { "two panes", { Glass, 1.0, Glass, 1.0 } },
    { "dense glass", { 2.4, 1.0 } } };
  for (const Stack& stack : stacks)
  {
    Pool pool;
    pool.GetCamera()->SetViewAngle(10.0);
    pool.Filter->SetImagesToFirstImage();
    pool.Filter->SetInteriorIndexOfRefraction(stack.Media[0]);
    for (std::size_t i = 1; i < stack.Media.size(); ++i)
    {
      vtkNew<vtkRefractingInterface> next;
      next->SetExteriorIndexOfRefraction(stack.Media[i - 1]);
      next->SetInteriorIndexOfRefraction(stack.Media[i]);
      pool.Filter->GetInterfaces()->AddItem(next);
      pool.Filter->AddMembraneConnection(
        MakePlane(5.0, -0.1 * static_cast<double>(i), 4)->GetOutputPort());
    }
    for (const double degrees : { 0.0, 45.0, 60.0, 75.0 })
    {
      SCOPED_TRACE(stack.Name + " at " + std::to_string(degrees));
      const double angle = degrees * std::acos(-1.0) / 180.0;
      const double sine = std::sin(angle);
      pool.GetCamera()->SetPosition(4.0 * sine, 0.0, 4.0 * std::cos(angle));
      double passed = 0.0;
      for (int k = 0; k < 2; ++k)
      {
        const double r = MakeReflectances(sine, 1.0, stack.Media[0])[k];
        const double last =
          stack.Media.size() > 1 ? MakeReflectances(sine, stack.Media[0], stack.Media[1])[k] : 0.0;
        const double panes = 0.5 * static_cast<double>(stack.Media.size());
        passed += stack.Media.back() == 1.0 ? (1.0 - r) / (1.0 + (2.0 * panes - 1.0) * r)
                                            : (1.0 - r) * (1.0 - last) / (1.0 - r * last);
      }
      passed *= 0.5;
      const ByteImage image = pool.Render();
      for (int channel = 0; channel < 3; ++channel)
      {
        EXPECT_NEAR(image.GetPixel(Size / 2, Size / 2)[channel] / 255.0,
          passed + (1.0 - passed) * Background[channel], Rounding);
      }
    }
  }
}

/** The background is seen through the pane as objects are, and in it. */
TEST(RefractionPassStack, TheBackgroundIsNotDimmed)
{
  Pool pool;
  AddPane(pool);
  pool.Floor->SetVisibility(false);
  ExpectColors(pool, "empty", [&](const Sight&, int channel) { return Background[channel]; });
}

/** The second interface of a glass that is much denser dims visibly: more than the rounding. */
TEST(RefractionPassStack, TheSecondInterfaceCounts)
{
  Pool pool;
  AddPane(pool);
  constexpr double dense = 2.4;
  pool.Filter->SetInteriorIndexOfRefraction(dense);
  pool.Filter->GetInterfaces()->GetInterface(1)->SetExteriorIndexOfRefraction(dense);
  const double second = MakeReflectances(0.0, dense, Water)[0];
  ASSERT_GT(second, 10.0 * Rounding);
  ExpectColors(pool, "dense",
    [&](const Sight& sight, int channel)
    {
      const double passed = MakePlateTransmittance(SineOf(sight), 1.0, dense, Water);
      return passed + (1.0 - passed) * Background[channel];
    });
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  ExpectColors(pool, "clear", [](const Sight&, int) { return 1.0; });
}

TEST(RefractionPassStack, FromTwoInterfacesBackToOne)
{
  Pool pool;
  AddPane(pool);
  pool.Render();
  pool.Filter->GetInterfaces()->RemoveItem(1);
  pool.Filter->SetMembraneConnection(pool.Surface->GetOutputPort());
  pool.Filter->SetInteriorIndexOfRefraction(Water);
  ExpectColors(pool, "one interface",
    [](const Sight& sight, int channel)
    { return 1.0 - MakeFresnel(sight) + MakeFresnel(sight) * Background[channel]; });
}

/** Interfaces with equal indices neither refract nor reflect, wherever they are in the list. */
TEST(RefractionPassStack, TheFirstThatRefractsReflects)
{
  Pool pool;
  AddPane(pool);
  pool.Filter->SetInteriorIndexOfRefraction(1.0); // air on both sides of the upper surface
  pool.Filter->GetInterfaces()->GetInterface(1)->SetExteriorIndexOfRefraction(1.0);
  ExpectColors(pool, "lower surface",
    [](const Sight& sight, int channel)
    { return 1.0 - MakeFresnel(sight) + MakeFresnel(sight) * Background[channel]; });
}

/** Nine panes one behind the other: the shader has room for the reflections at 16 interfaces. */
TEST(RefractionPassStack, MoreInterfacesThanReflectAreReported)
{
  Pool pool;
  AddPane(pool);
  const auto messages = ObserveErrors(pool.Pass);
  vtkRefractingInterfaceCollection* list = pool.Filter->GetInterfaces();
  for (int i = 2; i < 18; ++i)
  {
    if (i == 16)
    {
      pool.Render();
      EXPECT_TRUE(messages->Warnings.empty()) << "16 interfaces";
    }
    const bool isGlass = i % 2 == 0;
    list->AddInterface(isGlass ? Water : Glass, isGlass ? Glass : Water);
    pool.Filter->AddMembraneConnection(MakePlane(5.0, -Thickness - 0.01 * i, 4)->GetOutputPort());
  }
  pool.Render();
  ASSERT_EQ(messages->Warnings.size(), 1u);
  EXPECT_NE(messages->Warnings[0].find("16 of 18 interfaces"), std::string::npos)
    << messages->Warnings[0];
  pool.Render();
  EXPECT_EQ(messages->Warnings.size(), 1u) << "repeated";
}

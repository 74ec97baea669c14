// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Fresnel's equations at every interface of a pane of glass above water, in closed form.
#include "FlatPool.h"

#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

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

/** Reflectance of unpolarised light for an angle of incidence with this sine in air. */
double MakeFresnelAt(double sine, double before, double behind)
{
  const double c = std::sqrt(1.0 - std::pow(sine / before, 2.0));
  const double d = std::sqrt(1.0 - std::pow(sine / behind, 2.0));
  const double s = (before * c - behind * d) / (before * c + behind * d);
  const double p = (behind * c - before * d) / (behind * c + before * d);
  return 0.5 * (s * s + p * p);
}

double SineOf(const Sight& sight)
{
  return std::sqrt(1.0 - sight.Cosine * sight.Cosine);
}

}

TEST(RefractionPassStack, FresnelsProductAlongAPane)
{
  Pool pool;
  AddPane(pool);
  // To the side, where the second interface reflects most.
  for (const double x : { 0.0, 3.0, 6.0 })
  {
    pool.LookFrom(x, 0.0);
    ExpectColors(pool, "product",
      [&](const Sight& sight, int channel)
      {
        const double first = MakeFresnelAt(SineOf(sight), 1.0, Glass);
        const double second = MakeFresnelAt(SineOf(sight), Glass, Water);
        return (1.0 - first) * (1.0 - second) + first * Background[channel];
      });
  }
}

/** The second interface of a glass that is much denser dims visibly: more than the rounding. */
TEST(RefractionPassStack, TheSecondInterfaceCounts)
{
  Pool pool;
  AddPane(pool);
  constexpr double dense = 2.4;
  pool.Filter->SetInteriorIndexOfRefraction(dense);
  pool.Filter->GetInterfaces()->GetInterface(1)->SetExteriorIndexOfRefraction(dense);
  const double second = MakeFresnelAt(0.0, dense, Water);
  ASSERT_GT(second, 10.0 * Rounding);
  ExpectColors(pool, "dense",
    [&](const Sight& sight, int channel)
    {
      const double first = MakeFresnelAt(SineOf(sight), 1.0, dense);
      const double behind = MakeFresnelAt(SineOf(sight), dense, Water);
      return (1.0 - first) * (1.0 - behind) + first * Background[channel];
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

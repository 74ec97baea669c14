// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The medium behind a membrane, compared with closed forms: a plane of water, seen from above.
#include "FlatPool.h"
#include "RayCastScene.h"

#include <vtkActor.h>
#include <vtkMath.h>
#include <vtkRefractionPass.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

TEST(RefractionPassMedium, AttenuationGoesWithTheTruePath)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  const double coefficients[3] = { 0.8, 0.2, 0.0 };
  pool.Pass->SetAttenuationCoefficients(coefficients);
  for (const double x : { 0.0, 3.0 })
  {
    pool.LookFrom(x, 0.0);
    ExpectColors(pool, "attenuated",
      [&](const Sight& sight, int channel)
      { return std::exp(-coefficients[channel] * Depth / sight.RefractedCosine); });
  }
}

TEST(RefractionPassMedium, TheMediumScattersItsColor)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  const double coefficients[3] = { 0.8, 0.2, 0.0 };
  const double color[3] = { 0.2, 0.9, 0.5 };
  pool.Pass->SetAttenuationCoefficients(coefficients);
  pool.Pass->SetMediumColor(color);
  for (const double x : { 0.0, 3.0 })
  {
    pool.LookFrom(x, 0.0);
    ExpectColors(pool, "exponential",
      [&](const Sight& sight, int channel)
      {
        const double seen = std::exp(-coefficients[channel] * Depth / sight.RefractedCosine);
        return seen + (1.0 - seen) * color[channel];
      });
  }
}

TEST(RefractionPassMedium, ALinearMediumHidesWithinItsRange)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  const double color[3] = { 0.2, 0.9, 0.5 };
  pool.Pass->SetMediumModel(vtkRefractionPass::LINEAR);
  pool.Pass->SetMediumColor(color);
  // The floor is at distances from 1.5 to 1.9: within the range, before it and behind it.
  constexpr double ranges[4][2] = { { 1.0, 2.0 }, { 1.55, 1.7 }, { 3.0, 5.0 }, { 0.5, 0.5 } };
  for (const auto& range : ranges)
  {
    pool.Pass->SetMediumRange(range[0], range[1]);
    ExpectColors(pool, "linear from " + std::to_string(range[0]),
      [&](const Sight& sight, int channel)
      {
        const double distance = Depth / sight.RefractedCosine;
        const double seen = range[1] > range[0]
          ? std::min(std::max((range[1] - distance) / (range[1] - range[0]), 0.0), 1.0)
          : 0.0;
        return seen + (1.0 - seen) * color[channel];
      });
  }
}

TEST(RefractionPassMedium, AnInfiniteMediumHidesTheBackground)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  pool.Floor->VisibilityOff();
  const double color[3] = { 0.2, 0.9, 0.5 };
  pool.Pass->SetAttenuationCoefficients(0.8, 0.2, 0.0);
  pool.Pass->SetMediumColor(color);
  ExpectColors(pool, "not infinite", [](const Sight&, int channel) { return Background[channel]; });
  pool.Pass->InfiniteMediumOn();
  // Blue is not attenuated.
  ExpectColors(pool, "infinite",
    [&](const Sight&, int channel) { return channel < 2 ? color[channel] : Background[2]; });
  pool.Pass->SetMediumModel(vtkRefractionPass::LINEAR);
  ExpectColors(pool, "infinite, linear", [&](const Sight&, int channel) { return color[channel]; });
}

TEST(RefractionPassMedium, AMediumWithoutMeaningIsAnError)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  const auto errors = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  errors->Observe(pool.Pass);
  const auto expectClear = [&](const char* what)
  {
    errors->Errors.clear();
    ExpectColors(pool, what, [](const Sight&, int) { return 1.0; });
    EXPECT_EQ(errors->Errors.size(), 1u) << what;
  };
  pool.Pass->SetAttenuationCoefficients(-1.0, 0.0, 0.0);
  expectClear("negative coefficient");
  pool.Pass->SetAttenuationCoefficients(vtkMath::Nan(), 0.0, 0.0);
  expectClear("coefficient that is not a number");
  pool.Pass->SetAttenuationCoefficients(0.0, 0.0, 0.0);
  pool.Pass->SetMediumColor(0.0, vtkMath::Inf(), 0.0);
  expectClear("infinite colour");
  pool.Pass->SetMediumColor(0.0, 0.0, 0.0);
  pool.Pass->SetMediumModel(vtkRefractionPass::LINEAR);
  pool.Pass->SetMediumRange(2.0, 1.0);
  expectClear("descending range");
}

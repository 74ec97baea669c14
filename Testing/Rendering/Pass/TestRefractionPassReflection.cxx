// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRefractionPass with the scene in front of the water, compared with closed forms.
#include "FlatPool.h"

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

namespace
{

// A square ceiling above the water, seen from below the eye's height: its mirror image is a square
// of the same size at the same distance behind the water.
constexpr double CeilingHeight = 2.0;
constexpr double CeilingHalf = 1.6;
constexpr double CeilingColor[3] = { 1.0, 0.8, 0.2 };

class MirroringPool : public Pool
{
public:
  MirroringPool()
    : Ceiling(MakePlane(CeilingHalf, CeilingHeight, 8))
  {
    this->Reflection->SetInputConnection(this->Ceiling->GetOutputPort());
    this->Reflection->SetMembraneConnection(this->Surface->GetOutputPort());
    this->Reflection->SetInteriorIndexOfRefraction(Water);
    this->Reflection->SetCamera(this->GetCamera());
    this->Reflection->SetModeToReflection();
    this->Image = MakeActor(this->Reflection->GetOutputPort());
    SetFlatColor(this->Image, CeilingColor[0], CeilingColor[1], CeilingColor[2]);
    this->Pass->AddReflection(this->Membrane, this->Image, this->Reflection);
  }

  vtkSmartPointer<vtkPlaneSource> Ceiling;
  vtkNew<vtkRefractedGeometryFilter> Reflection;
  vtkSmartPointer<vtkActor> Image;
};

/** Distance of the place where a reflected ray meets the ceiling's plane from its border. */
double GetReach(vtkCamera* camera, const Sight& sight)
{
  double eye[3];
  camera->GetPosition(eye);
  double reach = 0.0;
  for (int i = 0; i < 2; ++i)
  {
    // By similar triangles, the ray goes on over the water as it came.
    const double place = sight.Point[i] + (sight.Point[i] - eye[i]) * CeilingHeight / eye[2];
    reach = std::max(reach, std::fabs(place));
  }
  return reach - CeilingHalf;
}

template <typename ReflectanceOf>
void ExpectMirrored(MirroringPool& pool, const char* what, const ReflectanceOf& reflectanceOf)
{
  SCOPED_TRACE(what);
  constexpr double floor[3] = { 1.0, 1.0, 1.0 };
  constexpr double border = 0.15; // as that of the membrane
  const ByteImage image = pool.Render();
  int mirrored = 0;
  int empty = 0;
  for (const auto& [y, x] : Product(Size, Size))
  {
    const Sight sight = SightOf(pool.GetCamera(), x, y);
    const double reach = GetReach(pool.GetCamera(), sight);
    if (IsBorder(sight) || !sight.OnMembrane || std::fabs(reach) < border)
    {
      continue;
    }
    ++(reach < 0.0 ? mirrored : empty);
    const double f = reflectanceOf(sight);
    for (int channel = 0; channel < 3; ++channel)
    {
      const double seen = reach < 0.0 ? CeilingColor[channel] : Background[channel];
      ASSERT_NEAR(
        image.GetPixel(x, y)[channel] / 255.0, (1.0 - f) * floor[channel] + f * seen, Rounding)
        << x << " " << y;
    }
  }
  EXPECT_GT(mirrored, 800);
  EXPECT_GT(empty, 800);
}

/** Counts errors without printing them. */
class ErrorCounter : public vtkCommand
{
public:
  static ErrorCounter* New() { return new ErrorCounter; }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Errors; }

  int Errors = 0;
};

} // anonymous namespace

TEST(RefractionPassReflection, FlatWaterMirrorsTheScene)
{
  MirroringPool pool;
  for (const double x : { 0.0, 3.0 })
  {
    pool.LookFrom(x, 0.3);
    pool.Pass->SetReflectanceModel(vtkRefractionPass::FRESNEL);
    ExpectMirrored(pool, "Fresnel", [](const Sight& sight) { return MakeFresnel(sight); });
    pool.Pass->SetReflectanceModel(vtkRefractionPass::SCHLICK);
    ExpectMirrored(pool, "Schlick", [](const Sight& sight) { return Schlick(sight); });
    pool.Pass->SetReflectanceModel(vtkRefractionPass::MIRROR);
    ExpectMirrored(pool, "mirror", [](const Sight&) { return 1.0; });
    pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
    ExpectMirrored(pool, "none", [](const Sight&) { return 0.0; });
  }
}

TEST(RefractionPassReflection, TheMediumIsBehindTheWaterOnly)
{
  MirroringPool pool;
  pool.LookFrom(3.0, 0.3);
  pool.Pass->SetAttenuationCoefficients(50.0, 50.0, 50.0);
  pool.Pass->SetMediumColor(1.0, 1.0, 1.0); // hides the floor, which is as white
  ExpectMirrored(pool, "Fresnel", [](const Sight& sight) { return MakeFresnel(sight); });
}

TEST(RefractionPassReflection, MirrorsNeedNothingBehindThem)
{
  MirroringPool pool;
  pool.LookFrom(3.0, 0.3);
  pool.Pass->RemoveRefraction(pool.Floor);
  EXPECT_EQ(pool.Pass->GetNumberOfRefractions(), 1);
  pool.Pass->SetReflectanceModel(vtkRefractionPass::MIRROR);
  ExpectMirrored(pool, "mirror", [](const Sight&) { return 1.0; });
}

TEST(RefractionPassReflection, HiddenAndRemovedReflectionsAreNotDrawn)
{
  MirroringPool pool;
  pool.LookFrom(3.0, 0.3);
  const auto expectNone = [&pool](const char* what)
  {
    ExpectColors(pool, what,
      [](const Sight& sight, int channel)
      {
        const double f = MakeFresnel(sight);
        return (1.0 - f) + f * Background[channel];
      });
  };
  pool.Image->VisibilityOff();
  expectNone("hidden");
  pool.Image->VisibilityOn();
  ExpectMirrored(pool, "shown", [](const Sight& sight) { return MakeFresnel(sight); });
  pool.Pass->RemoveRefraction(pool.Image);
  expectNone("removed");
}

TEST(RefractionPassReflection, FiltersOfTheOtherModeAreErrors)
{
  MirroringPool pool;
  vtkNew<ErrorCounter> errors;
  pool.Pass->AddObserver(vtkCommand::ErrorEvent, errors);
  pool.Pass->AddReflection(pool.Membrane, pool.Image, pool.Filter);
  pool.Pass->AddRefraction(pool.Membrane, pool.Image, pool.Reflection);
  pool.Pass->AddReflection(pool.Membrane, pool.Image, nullptr);
  EXPECT_EQ(errors->Errors, 3);
  EXPECT_EQ(pool.Pass->GetNumberOfRefractions(), 2);
}

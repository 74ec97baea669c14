// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The medium behind a membrane, compared with closed forms: a plane of water, seen from above.
#include "FlatPool.h"
#include "StrictImage.h"

#include <vtkTexture.h>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

namespace
{

constexpr double Yellow[3] = { 1.0, 0.8, 0.3 };

/** A block of water below the plane z = -Depth, wider than the view, in the pool. */
class Block
{
public:
  Block(Pool& pool, const Field& field, vtkVolumeProperty* property)
    : Owner(pool)
    , Mesh(MakeBlock(3, field))
  {
    // The cube [-1, 1]^3 becomes [-6, 6]^2 x [-Depth - 12, -Depth].
    TransformPoints(this->Mesh, { 0.0, 0.0, -1.0 - Depth / 6.0 }, 6.0);
    this->Mapper->SetBackend(BackendUnderTest());
    this->Mapper->SetInputData(this->Mesh);
    this->Mapper->SetMembraneConnection(pool.Surface->GetOutputPort());
    this->Mapper->SetInteriorIndexOfRefraction(Water);
    this->Volume->SetMapper(this->Mapper);
    this->Volume->SetProperty(property);
  }

  void Add() { this->Owner.Pass->AddVolume(this->Owner.Membrane, this->Volume); }

  Pool& Owner;
  Grid Mesh;
  vtkNew<vtkTetrahedraRayCastMapper> Mapper;
  vtkNew<vtkVolume> Volume;
};

struct PassMedium
{
  const char* Name;
  int Model;
  double Coefficients[3];
  double Range[2];
  double Color[3];

  void Set(vtkRefractionPass* pass) const
  {
    pass->SetMediumModel(this->Model);
    pass->SetAttenuationCoefficients(
      this->Coefficients[0], this->Coefficients[1], this->Coefficients[2]);
    pass->SetMediumRange(this->Range[0], this->Range[1]);
    pass->SetMediumColor(this->Color[0], this->Color[1], this->Color[2]);
  }
  double Share(double distance, int channel) const
  {
    if (this->Model == vtkRefractionPass::EXPONENTIAL)
    {
      return std::exp(-this->Coefficients[channel] * distance);
    }
    return this->Range[1] > this->Range[0]
      ? std::clamp((this->Range[1] - distance) / (this->Range[1] - this->Range[0]), 0.0, 1.0)
      : (distance < this->Range[1] ? 1.0 : 0.0);
  }
};

// The floor is at distances from 1.5 to 1.9.
constexpr PassMedium Media[] = {
  { "clear", vtkRefractionPass::EXPONENTIAL, { 0.0, 0.0, 0.0 }, { 0.0, 1.0 }, { 0.2, 0.9, 0.5 } },
  { "coloured", vtkRefractionPass::EXPONENTIAL, { 0.8, 0.2, 0.0 }, { 0.0, 1.0 },
    { 0.2, 0.9, 0.5 } },
  { "black", vtkRefractionPass::EXPONENTIAL, { 0.8, 0.2, 0.1 }, { 0.0, 1.0 }, { 0.0, 0.0, 0.0 } },
  { "linear", vtkRefractionPass::LINEAR, { 0.0, 0.0, 0.0 }, { 1.0, 2.0 }, { 0.2, 0.9, 0.5 } },
  { "linear, bends", vtkRefractionPass::LINEAR, { 0.0, 0.0, 0.0 }, { 1.55, 1.7 },
    { 0.2, 0.9, 0.5 } },
  { "step", vtkRefractionPass::LINEAR, { 0.0, 0.0, 0.0 }, { 0.5, 0.5 }, { 0.2, 0.9, 0.5 } },
};

} // anonymous namespace

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
  const auto errors = ObserveErrors(pool.Pass);
  const auto expectClear = [&](const char* what)
  {
    errors->Errors.clear();
    ExpectColors(pool, what, [](const Sight&, int) { return 1.0; });
    EXPECT_EQ(errors->Errors.size(), 1u) << what;
    pool.Render();
    EXPECT_EQ(errors->Errors.size(), 1u) << what << ", next frame";
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

TEST(RefractionPassMedium, AFieldAndAnObjectLookAlike)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  SetFlatColor(pool.Floor, Yellow[0], Yellow[1], Yellow[2]);
  // Opaque within 1e-3, and an isosurface at the depth of the floor.
  Block dense(
    pool, ConstantField(0.5), MakeConstantProperty(1.0, Yellow[0], Yellow[1], Yellow[2], 1e-4));
  Block surface(pool, LinearField(0.0, 0.0, 1.0),
    MakeConstantProperty(1.0, Yellow[0], Yellow[1], Yellow[2], 1.0));
  surface.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 1.0 - 1e-4);
  surface.Mapper->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  for (const PassMedium& medium : Media)
  {
    for (const bool isInfinite : { false, true })
    {
      medium.Set(pool.Pass);
      pool.Pass->SetInfiniteMedium(isInfinite);
      const auto expected = [&](const Sight& sight, int channel)
      {
        const double seen = medium.Share(Depth / sight.RefractedCosine, channel);
        return seen * Yellow[channel] + (1.0 - seen) * medium.Color[channel];
      };
      pool.Pass->RemoveAllRefractions();
      pool.Pass->AddRefraction(pool.Membrane, pool.Floor, pool.Filter);
      ExpectColors(pool, std::string("object, ") + medium.Name, expected);
      const ByteImage object = pool.Render();
      for (Block* block : { &dense, &surface })
      {
        pool.Pass->RemoveAllRefractions();
        block->Add();
        ExpectColors(pool, std::string("field, ") + medium.Name, expected);
        EXPECT_LE(CompareStrictly(pool.Render(), object, 0).Largest, 1) << medium.Name;
        EXPECT_EQ(block->Mapper->GetNumberOfLostRays(), 0);
      }
    }
  }
}

TEST(RefractionPassMedium, ObjectsInsideAFieldAndTheBackgroundBehindIt)
{
  constexpr double tau = 0.4;
  constexpr double floorDepth = 3.0;
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  pool.Bottom = MakePlane(12.0, -floorDepth, 60);
  pool.Filter->SetInputConnection(pool.Bottom->GetOutputPort());
  Block block(pool, ConstantField(0.5),
    MakeConstantProperty(1.0, Yellow[0], Yellow[1], Yellow[2], 1.0 / tau));
  block.Add();
  pool.Pass->SetInfiniteMedium(true);
  pool.GetCamera()->SetViewAngle(40.0); // all rays leave the block by its bottom
  for (const bool hasFloor : { true, false })
  {
    pool.Floor->SetVisibility(hasFloor);
    for (const PassMedium& medium : Media)
    {
      medium.Set(pool.Pass);
      if (medium.Model != vtkRefractionPass::EXPONENTIAL)
      {
        continue;
      }
      ExpectColors(pool, std::string(medium.Name) + (hasFloor ? ", floor" : ", background"),
        [&](const Sight& sight, int channel)
        {
          // The block ends 12 below its top; light is that of block, medium and white floor.
          const double begin = Depth / sight.RefractedCosine;
          const double end = (hasFloor ? floorDepth : Depth + 12.0) / sight.RefractedCosine;
          const double k = medium.Coefficients[channel];
          const double left = std::exp(-tau * (end - begin));
          const double own =
            tau / (tau + k) * std::exp(-k * begin) * -std::expm1(-(tau + k) * (end - begin));
          const double seen = hasFloor ? medium.Share(floorDepth / sight.RefractedCosine, channel)
                                       : (k > 0.0 ? 0.0 : 1.0);
          const double behind = hasFloor ? 1.0 : Background[channel];
          return own * Yellow[channel] + (1.0 - left - own) * medium.Color[channel] +
            left * (seen * behind + (1.0 - seen) * medium.Color[channel]);
        });
    }
  }
}

TEST(RefractionPassMedium, TheMediumOfAMapperComesFirst)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  Media[1].Set(pool.Pass);
  Block block(pool, ConstantField(0.5), MakeConstantProperty(1.0, 1.0, 1.0, 1.0, 1e-4));
  pool.Pass->RemoveAllRefractions();
  block.Add();
  block.Mapper->SetMediumAttenuationCoefficients(0.1, 0.1, 0.9);
  block.Mapper->SetMediumColor(0.9, 0.1, 0.1);
  ExpectColors(pool, "of the mapper",
    [&](const Sight& sight, int channel)
    {
      const double seen = std::exp((channel < 2 ? -0.1 : -0.9) * Depth / sight.RefractedCosine);
      return seen + (1.0 - seen) * (channel < 1 ? 0.9 : 0.1);
    });
}

TEST(RefractionPassMedium, TexturesDoNotColourTheMedium)
{
  Pool pool;
  pool.Pass->SetReflectanceModel(vtkRefractionPass::NONE);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const double shade[3] = { 1.0, 0.2, 0.6 };
  for (int i = 0; i < 12; ++i)
  {
    static_cast<unsigned char*>(image->GetScalarPointer())[i] =
      static_cast<unsigned char>(255.0 * shade[i % 3]);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  pool.Floor->SetTexture(texture);
  const PassMedium& medium = Media[1];
  medium.Set(pool.Pass);
  ExpectColors(pool, "textured",
    [&](const Sight& sight, int channel)
    {
      const double seen = medium.Share(Depth / sight.RefractedCosine, channel);
      return seen * shade[channel] + (1.0 - seen) * medium.Color[channel];
    });
}

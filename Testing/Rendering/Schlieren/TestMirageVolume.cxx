// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A medium that bends light and is seen itself: smoke and glowing gas in pictures of mirages.
#include "AbortedUpdate.h"
#include "MirageScene.h"
#include "VolumeFunctions.h"

#include <vtkTetrahedraRayIntegral.h>

using namespace meniscus::test;

namespace
{

/** Largest error of a channel of the ray caster's pictures. */
constexpr double PictureError = 2.0e-5;

/** Adds an array of the field's values at the points. */
void AddValues(const Grid& grid, const char* name, const Field& field)
{
  grid->GetPointData()->AddArray(MakeArray(name, grid->GetNumberOfPoints(),
    [&](vtkIdType point)
    {
      const double* p = grid->GetPoint(point);
      return field(p[0], p[1], p[2]);
    }));
}

double Waves(double x, double y, double z)
{
  return std::sin(2.0 * x + 0.7) * std::cos(1.3 * y) + 0.5 * z;
}

/** A block with an index n and the scalar "smoke", which is active. */
Grid MakeSmoke(int n, const Field& index, const Field& smoke = Waves)
{
  const Grid grid = MakeBlock(n, smoke);
  grid->GetPointData()->GetScalars()->SetName("smoke");
  AddValues(grid, "n", index);
  return grid;
}

Filter MakeVolume(vtkDataObject* mesh, vtkVolumeProperty* property, vtkDataSet* objects = nullptr)
{
  Filter filter = MakeFilter(mesh, objects ? objects : MakePlane(-5.0, 1.0e-3));
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "n");
  filter->SetVolumeArrayName("smoke");
  filter->SetVolumeProperty(property);
  filter->SetCamera(MakeCamera({ 1.0, 2.0, 6.0 }, { 0, 0, 0 }, 0.3));
  return filter;
}

/** A property of one attenuation and one colour. */
vtkSmartPointer<vtkVolumeProperty> MakePlain(double attenuation, const glm::dvec3& color)
{
  return ToProperty({ { 0.0, { attenuation, { color.r, color.g, color.b } } } });
}

/** Picture of the same volume without bending, by the caster that the mapper has. */
vtkSmartPointer<vtkTetrahedraRayIntegral> MakeStraight(const Filter& filter)
{
  auto rays = vtkSmartPointer<vtkTetrahedraRayIntegral>::New();
  rays->SetInputDataObject(filter->GetInputDataObject(0, 0));
  rays->SetVolumeProperty(filter->GetVolumeProperty());
  rays->SetOpacityModel(filter->GetOpacityModel());
  rays->GetArraySelection()->DisableAllArrays();
  rays->GetArraySelection()->EnableArray("RGBA");
  rays->SetCamera(filter->GetCamera());
  rays->SetImageSize(filter->GetImageSize());
  rays->Update();
  return rays;
}

/** Expects the medium's array to be that of the straight picture. */
void ExpectStraight(const Filter& filter, const std::string& what)
{
  const auto straight = MakeStraight(filter);
  vtkDataArray* truth = straight->GetOutput()->GetPointData()->GetArray("RGBA");
  vtkDataArray* found = ArrayOf(filter, "RGBA");
  ASSERT_TRUE(truth && found) << what;
  for (vtkIdType i = 0; i < truth->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      ASSERT_NEAR(found->GetComponent(i, k), truth->GetComponent(i, k), PictureError)
        << what << " " << i;
    }
  }
}

}

TEST(MirageVolume, ConstantIndexIsThePictureOfTheRayCaster)
{
  const Grid grid = MakeSmoke(6, ConstantField(1.3));
  Jitter(grid, 0.05, 3);
  for (const NamedFunction& named : UsualFunctions(grid))
  {
    const auto property = ToProperty(named.Function);
    Filter filter = MakeVolume(grid, property);
    filter->Update();
    ExpectStraight(filter, named.Name);
    filter->BendRaysOff();
    filter->Update();
    ExpectStraight(filter, named.Name + ", straight");
  }
}

TEST(MirageVolume, OpacityPerUnitDistanceIsVTKs)
{
  const Grid grid = MakeSmoke(4, ConstantField(1.0));
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.0, 0.4);
  vtkNew<vtkVolumeProperty> property;
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(0.7);
  Filter filter = MakeVolume(grid, property);
  filter->SetOpacityModelToOpacityPerUnitDistance();
  filter->SetCamera(nullptr);
  filter->Update();
  // Parallel rays cross the block over the length 2.
  EXPECT_NEAR(ValueAt(filter, "RGBA", 700, 3), 1.0 - std::pow(0.6, 2.0 / 0.7), PictureError);
  filter->SetOpacityModelToAttenuationCoefficient();
  filter->Update();
  EXPECT_NEAR(ValueAt(filter, "RGBA", 700, 3), 1.0 - std::exp(-0.4 / 0.7 * 2.0), PictureError);
  property->SetScalarOpacityUnitDistance(1.4);
  filter->Update();
  EXPECT_NEAR(ValueAt(filter, "RGBA", 700, 3), 1.0 - std::exp(-0.4 / 1.4 * 2.0), PictureError);
}

TEST(MirageVolume, CellDataAndBlocks)
{
  const Grid grid = MakeSmoke(5, ConstantField(1.1));
  const VolumeFunction function = { { -0.5, { 0.0, { 1.0, 0.0, 0.0 } } },
    { 0.2, { 1.0, { 0.8, 0.9, 0.1 } } }, { 0.9, { 0.1, { 0.0, 0.2, 1.0 } } } };
  Filter filter = MakeVolume(grid, ToProperty(function));
  filter->Update();
  // The filter has a mesh of which it does not know the cells.
  grid->GetPointData()->RemoveArray("smoke");
  grid->GetCellData()->SetScalars(MakeArray<vtkFloatArray>("smoke", grid->GetNumberOfCells(),
    [&](vtkIdType cell) { return static_cast<float>((cell * 37) % 101) / 50.0f - 1.0f; }));
  filter->Update();
  ExpectStraight(filter, "cells");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, grid);
  filter->SetInputDataObject(blocks);
  filter->Update();
  ExpectStraight(filter, "blocks");
}

// Changes are seen; all else is kept.
TEST(MirageVolume, FollowsItsSettings)
{
  const Grid grid = MakeSmoke(5, ConstantField(1.1));
  const VolumeFunction narrow = { { 0.4, { 0.0, { 1.0, 0.0, 0.0 } } },
    { 0.5, { 3.0, { 0.8, 0.9, 0.1 } } }, { 0.6, { 0.0, { 0.0, 0.2, 1.0 } } } };
  Filter filter = MakeVolume(grid, ToProperty(narrow));
  filter->Update();
  ExpectStraight(filter, "narrow");
  // Few cells are seen; then the index is read again.
  vtkDataArray* index = grid->GetPointData()->GetArray("n");
  index->Fill(1.4);
  index->Modified();
  grid->Modified();
  filter->Update();
  ExpectStraight(filter, "another index");
  filter->SetVolumeProperty(MakePlain(0.5, { 1, 1, 1 }));
  filter->Update();
  ExpectStraight(filter, "another property");
  filter->GetVolumeProperty()->SetScalarOpacityUnitDistance(3.0);
  filter->Update();
  ExpectStraight(filter, "another distance");
  filter->SetVolumeProperty(nullptr);
  filter->Update();
  EXPECT_EQ(ArrayOf(filter, "RGBA"), nullptr);
  EXPECT_EQ(ValueAt(filter, "Color", 820), 0.0);
}

TEST(MirageVolume, LiesOverObjectsAndBackground)
{
  const Grid grid = MakeSmoke(4, ConstantField(1.0));
  const glm::dvec3 smoke(0.9, 0.5, 0.1);
  const glm::dvec3 behind(0.2, 0.4, 1.0);
  const double attenuation = 0.8;
  // Walls before, in and behind the block.
  const std::pair<double, double> walls[] = { { 2.0, 0.0 }, { 0.25, 0.75 }, { -2.0, 2.0 } };
  for (const auto& [depth, length] : walls)
  {
    Filter filter = MakeVolume(grid, MakePlain(attenuation, smoke), MakePlane(depth, 3.0));
    filter->SetCamera(nullptr);
    filter->SetAmbient(1.0);
    filter->Update();
    const double left = std::exp(-attenuation * length);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(ValueAt(filter, "RGBA", 33, k), (1.0 - left) * smoke[k], PictureError);
      EXPECT_NEAR(ValueAt(filter, "Color", 33, k), 255.0 * ((1.0 - left) * smoke[k] + left), 0.51);
    }
    EXPECT_EQ(ValueAt(filter, "Seen", 33), vtkTetrahedraMirage::OBJECT);
    EXPECT_NEAR(VectorAt(filter, "Position", 33).z, depth, 1.0e-7);
  }
  Filter filter = MakeVolume(grid, MakePlain(attenuation, smoke));
  filter->SetCamera(nullptr);
  filter->SetBackgroundColor(behind.r, behind.g, behind.b);
  filter->Update();
  const double left = std::exp(-2.0 * attenuation);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(
      ValueAt(filter, "Color", 33, k), 255.0 * ((1.0 - left) * smoke[k] + left * behind[k]), 0.51);
  }
}

// n^2 = 1.6 + 0.9 y: parallel rays along z are parabolas with the force (0, 0.45, 0).
TEST(MirageVolume, SmokeIsAsDenseAsTheArcIsLong)
{
  const Grid grid = MakeSmoke(6, [](double, double y, double) { return std::sqrt(1.6 + 0.9 * y); });
  const double attenuation = 0.6;
  Filter filter = MakeVolume(grid, MakePlain(attenuation, { 1, 1, 1 }));
  filter->SetCamera(nullptr);
  filter->Update();
  constexpr double force = 0.45;
  for (int row = 0; row < Size; ++row)
  {
    const double y = 2.0 * (row + 0.5) / Size - 1.0;
    const double n = std::sqrt(1.6 + 0.9 * y);
    const double time = 2.0 / n;
    if (y + 0.5 * force * time * time > 0.999)
    {
      continue; // leaves by the upper side
    }
    const double rate = force * time;
    const double length = 0.5 * (time * std::hypot(n, rate) + n * n / force * std::asinh(rate / n));
    EXPECT_GT(length, 2.005);
    EXPECT_NEAR(
      ValueAt(filter, "RGBA", row * Size + 7, 3), 1.0 - std::exp(-attenuation * length), 2.0e-6);
  }
}

TEST(MirageVolume, OddVolumesAreWarnings)
{
  const Grid grid = MakeSmoke(5, ConstantField(1.2));
  vtkDataArray* smoke = grid->GetPointData()->GetArray("smoke");
  smoke->SetComponent(100, 0, NaN);
  smoke->SetComponent(50, 0, std::numeric_limits<double>::infinity());
  auto property = ToProperty(UsualFunctions(MakeSmoke(5, ConstantField(1.2)))[0].Function);
  property->ShadeOn();
  Filter filter = MakeVolume(grid, property);
  const auto observer = ObserveErrors(filter);
  filter->Update();
  EXPECT_EQ(observer->Errors.size(), 0u) << observer->GetText();
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(observer->Warnings[0], "2 of 216 scalars"));
  EXPECT_TRUE(HasText(observer->Warnings[0], "Shading"));
  ExpectStraight(filter, "not finite");
  // A function without points shows nothing.
  vtkNew<vtkVolumeProperty> empty;
  empty->SetScalarOpacity(vtkNew<vtkPiecewiseFunction>());
  filter->SetVolumeProperty(empty);
  filter->Update();
  EXPECT_EQ(ArrayOf(filter, "RGBA")->GetMaxNorm(), 0.0);
  // One without functions has VTK's.
  filter->SetVolumeProperty(vtkNew<vtkVolumeProperty>());
  filter->Update();
  ExpectStraight(filter, "no functions");
}

TEST(MirageVolume, NeedsNoObjects)
{
  const Grid grid = MakeSmoke(4, ConstantField(1.2));
  Filter filter = MakeVolume(grid, MakePlain(0.5, { 1, 1, 1 }));
  filter->SetObjectData(nullptr);
  auto observer = ObserveErrors(filter);
  filter->Update();
  EXPECT_EQ(observer->Errors.size() + observer->Warnings.size(), 0u) << observer->GetText();
  ExpectStraight(filter, "no objects");
  filter->SetVolumeProperty(nullptr);
  filter->Update();
  ASSERT_EQ(observer->Errors.size(), 1u);
  EXPECT_TRUE(HasText(observer->Errors[0], "neither objects nor a volume"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(MirageVolume, BadVolumesAreErrors)
{
  const auto plain = MakePlain(1.0, { 1, 1, 1 });
  const Grid grid = MakeSmoke(2, ConstantField(1.2));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, grid);
  blocks->SetBlock(1, MakeBlock(2, ConstantField(1.2)));
  blocks->GetBlock(1);
  const auto unknown = MakePlain(1.0, { 1, 1, 1 });
  unknown->SetScalarOpacityUnitDistance(0.0);
  Filter filters[4] = { MakeVolume(grid, plain), MakeVolume(grid, unknown),
    MakeVolume(MakeBlock(2, ConstantField(1.2)), plain), MakeVolume(blocks, plain) };
  filters[0]->SetVolumeArrayName("soot");
  filters[3]->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  const char* texts[] = { "named 'soot'", "UnitDistance", "named 'smoke'", "same data sets" };
  for (int i = 0; i < 4; ++i)
  {
    ExpectError(filters[i], texts[i]);
  }
}

// An abort while the mesh is read, and while rays are followed; then the whole picture.
TEST(MirageVolume, AbortEmptiesTheOutput)
{
  const Grid grid = MakeSmoke(4, ConstantField(1.2));
  for (const double most : { 0.0, 0.5 })
  {
    Filter filter = MakeVolume(grid, MakePlain(0.5, { 1, 1, 1 }));
    filter->SetImageSize(Size, 200);
    UpdateWithAbort(filter, most);
    ExpectStraight(filter, "after an abort");
  }
}

// Cells that are inside out, where light goes back: the smoke is neither negative nor endless.
TEST(MirageVolume, FoldedMeshes)
{
  const Grid grid = MakeTangledBlock(6, 0.1, 5);
  grid->GetPointData()->GetScalars()->SetName("smoke");
  AddValues(grid, "n", [](double x, double y, double z) { return 1.3 + 0.1 * x - 0.2 * y * z; });
  Filter filter = MakeVolume(grid, MakePlain(0.5, { 1.0, 0.5, 0.0 }));
  filter->SetCamera(nullptr);
  filter->Update();
  double largest = 0.0;
  for (vtkIdType pixel = 0; pixel < Size * Size; ++pixel)
  {
    const double opacity = ValueAt(filter, "RGBA", pixel, 3);
    largest = std::max(largest, opacity);
    // Colour and opacity are sums of the same numbers.
    EXPECT_NEAR(ValueAt(filter, "RGBA", pixel, 0), opacity, 1.0e-5);
    EXPECT_NEAR(ValueAt(filter, "RGBA", pixel, 1), 0.5 * opacity, 1.0e-5);
    EXPECT_GE(opacity, 0.0);
  }
  EXPECT_GT(largest, 0.5);
  EXPECT_LT(largest, 1.0 - std::exp(-0.5 * 6.0));
}

TEST(MirageVolume, ThreadsDoNotMatter)
{
  ExpectSameOnThreads(
    []
    {
      const Grid grid = MakeSmoke(
        6, [](double x, double y, double z) { return 1.3 + 0.2 * std::sin(3.0 * x + y) * z; });
      Filter filter = MakeVolume(grid, ToProperty(UsualFunctions(grid)[0].Function));
      filter->Update();
      return ValuesOf(ArrayOf(filter, "RGBA"));
    });
}

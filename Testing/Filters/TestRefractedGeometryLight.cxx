// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Reflectance by either model, and normals for the lighting of virtual geometry.
#include "RefractedGeometryTestHelpers.h"
#include "VTKTestBasics.h"

namespace
{

using namespace meniscus::test;
using meniscus::reference::HeightField;

const double Pi = std::acos(-1.0);
const HeightField Waves{ HeightField::Shape::Waves, 200.0, 3.0, 0.02 * Pi, 1.0, 1.333 };
const glm::dvec3 Eye(20.0, 300.0, 10.0);

/** A grid with normals. */
vtkSmartPointer<vtkPolyData> MakeLitGrid(double y)
{
  auto grid = MakeGrid(9, 80.0, y);
  AddBumps(grid);
  return grid;
}

vtkSmartPointer<vtkRefractedGeometryFilter> MakeCurved(vtkPolyData* geometry, vtkPolyData* membrane)
{
  auto filter = MakeFilter(geometry, membrane);
  filter->SetMembraneModelToCurved();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return filter;
}

/** True point, true and virtual normal, and other data of each point of an output. */
struct Lit
{
  glm::dvec3 Point;
  glm::dvec3 SightPoint;
  glm::dvec3 VirtualPoint;
  glm::dvec3 Normal;
  glm::dvec3 VirtualNormal;
};

std::vector<Lit> Read(vtkPolyData* grid, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  std::vector<Lit> result;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<vtkIdType>(data->GetArray("SourcePointId")->GetTuple1(i));
    result.push_back({ PointOf(grid, id), TupleOf(data->GetArray("SightPoint"), i),
      PointOf(output, i), TupleOf(data->GetArray("Bumps"), i), TupleOf(data->GetNormals(), i) });
    EXPECT_EQ(result.back().Normal, TupleOf(grid->GetPointData()->GetNormals(), id));
  }
  return result;
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryLight, SchlickIsItsClosedForm)
{
  const auto filter = MakeCurved(MakeGrid(9, 150.0, -60.0), MakeFlatMembrane());
  filter->SetEyePosition(150.0, 40.0, 10.0);
  filter->Update();
  const vtkTypeInt64 solved = filter->GetNumberOfSolvedVertices();
  vtkNew<vtkDoubleArray> fresnel;
  fresnel->DeepCopy(filter->GetOutput()->GetPointData()->GetArray("Reflectance"));
  filter->SetReflectanceModelToSchlick();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), solved);
  vtkPointData* data = filter->GetOutput()->GetPointData();
  ASSERT_EQ(data->GetArray("Reflectance")->GetNumberOfTuples(), fresnel->GetNumberOfTuples());
  double largest = 0.0;
  for (vtkIdType i = 0; i < fresnel->GetNumberOfTuples(); ++i)
  {
    const glm::dvec3 away =
      glm::dvec3(150.0, 40.0, 10.0) - TupleOf(data->GetArray("SightPoint"), i);
    const double cosine = away.y / glm::length(away);
    const double r = std::pow(0.333 / 2.333, 2);
    const double value = data->GetArray("Reflectance")->GetTuple1(i);
    EXPECT_NEAR(value, r + (1.0 - r) * std::pow(1.0 - cosine, 5), 1e-12);
    // The approximation is near the exact value, but not equal.
    largest = std::max(largest, std::fabs(value - fresnel->GetTuple1(i)));
  }
  EXPECT_GT(largest, 0.01);
  EXPECT_LT(largest, 0.1);
  filter->SetInteriorIndexOfRefraction(1.0);
  filter->Update();
  data = filter->GetOutput()->GetPointData();
  EXPECT_EQ(data->GetArray("Reflectance")->GetRange()[1], 0.0);
}

//------------------------------------------------------------------------------
// A light at the eye: exact on any membrane, in both modes of images.
TEST(RefractedGeometryLight, HeadlightsSeeTheTrueAngles)
{
  for (const int images :
    { vtkRefractedGeometryFilter::FIRST_IMAGE, vtkRefractedGeometryFilter::ALL_IMAGES })
  {
    const auto grid = MakeLitGrid(-60.0);
    const auto filter = MakeCurved(grid, MakeMembrane(Waves.MakeMesh(64)));
    filter->SetImages(images);
    filter->SetAngularTolerance(10.0); // no new points, which have no true normal of their own
    filter->VirtualNormalsOn();
    filter->Update();
    const auto lit = Read(grid, filter->GetOutput());
    EXPECT_GE(lit.size(), 81u);
    double largest = 0.0;
    for (const Lit& point : lit)
    {
      EXPECT_NEAR(glm::length(point.VirtualNormal), 1.0, 1e-12);
      const glm::dvec3 inside = glm::normalize(point.SightPoint - point.Point);
      const glm::dvec3 outside = glm::normalize(Eye - point.VirtualPoint);
      EXPECT_NEAR(glm::dot(point.VirtualNormal, outside), glm::dot(point.Normal, inside), 1e-9);
      largest = std::max(largest, glm::length(point.VirtualNormal - point.Normal));
    }
    EXPECT_GT(largest, 0.01);
  }
}

//------------------------------------------------------------------------------
// A light at infinity above a plane: its refracted ray follows from n1 sin a = n2 sin b.
TEST(RefractedGeometryLight, DistantLightsAreExactUnderPlanes)
{
  const auto grid = MakeLitGrid(-60.0);
  const auto filter = MakeCurved(grid, MakeFlatMembrane());
  filter->VirtualNormalsOn();
  for (const glm::dvec3& light :
    { glm::dvec3(3.0, 2.0, -1.0), glm::dvec3(0.0, 5.0, 0.0), glm::dvec3(-40.0, 1.0, 3.0) })
  {
    filter->SetLightDirection(light.x, light.y, light.z);
    filter->Update();
    const glm::dvec3 unit = glm::normalize(light);
    glm::dvec3 refracted(unit.x / 1.333, 0.0, unit.z / 1.333);
    refracted.y = std::sqrt(1.0 - glm::dot(refracted, refracted));
    int both = 0;
    for (const Lit& point : Read(grid, filter->GetOutput()))
    {
      const double diffuse = glm::dot(point.VirtualNormal, unit);
      const double wanted = glm::dot(point.Normal, refracted);
      const glm::dvec3 inside = glm::normalize(point.SightPoint - point.Point);
      const glm::dvec3 outside = glm::normalize(Eye - point.VirtualPoint);
      EXPECT_NEAR(diffuse, wanted, 1e-9);
      // Both dot products, where a unit normal can have them.
      both +=
        std::fabs(glm::dot(point.VirtualNormal, outside) - glm::dot(point.Normal, inside)) < 1e-9;
      EXPECT_NEAR(glm::length(point.VirtualNormal), 1.0, 1e-12);
    }
    EXPECT_GE(both, light.y > 1.0 ? 55 : 10);
  }
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 81);
}

TEST(RefractedGeometryLight, LightFromBelowTheHorizonLightsNothing)
{
  const auto grid = MakeLitGrid(-60.0);
  const auto filter = MakeCurved(grid, MakeFlatMembrane());
  filter->VirtualNormalsOn();
  filter->SetLightDirection(1.0, -0.5, 0.0);
  filter->Update();
  for (const Lit& point : Read(grid, filter->GetOutput()))
  {
    EXPECT_LT(glm::dot(point.VirtualNormal, glm::dvec3(1.0, -0.5, 0.0)), 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryLight, NothingTurnsWhereNothingIsRefracted)
{
  for (const double light : { 0.0, 1.0 })
  {
    const auto grid = MakeLitGrid(-60.0);
    const auto filter = MakeCurved(grid, MakeMembrane(Waves.MakeMesh(32)));
    filter->SetInteriorIndexOfRefraction(1.0);
    filter->VirtualNormalsOn();
    filter->SetLightDirection(light, light, 0.0);
    filter->Update();
    for (const Lit& point : Read(grid, filter->GetOutput()))
    {
      EXPECT_LT(glm::length(point.VirtualNormal - point.Normal), 1e-15);
    }
    // In front of the membrane normals are unchanged.
    filter->SetInteriorIndexOfRefraction(1.333);
    filter->SetImagesToAllImages();
    const auto front = MakeLitGrid(30.0);
    filter->SetInputData(0, front);
    filter->Update();
    const auto lit = Read(front, filter->GetOutput());
    EXPECT_EQ(lit.size(), 81u);
    for (const Lit& point : lit)
    {
      EXPECT_EQ(point.VirtualNormal, point.Normal);
    }
  }
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryLight, NormalsAreOffByDefaultAndWarnWhereThereAreNone)
{
  const auto grid = MakeLitGrid(-60.0);
  const auto filter = MakeCurved(grid, MakeFlatMembrane());
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("VirtualNormals"), nullptr);
  const auto bare = MakeCurved(MakeGrid(9, 80.0, -60.0), MakeFlatMembrane());
  bare->VirtualNormalsOn();
  const auto messages = UpdateAndObserve(bare);
  bare->SetEyePosition(0.0, 200.0, 0.0);
  bare->Update();
  EXPECT_EQ(messages->Warnings, 1) << messages->Text;
  EXPECT_EQ(bare->GetOutput()->GetNumberOfPoints(), 81);
  EXPECT_EQ(bare->GetOutput()->GetPointData()->GetNormals(), nullptr);
}

TEST(RefractedGeometryLight, BadNormalsAndLights)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto grid = MakeLitGrid(-60.0);
  grid->GetPointData()->GetNormals()->SetTuple3(3, 0.0, 0.0, 0.0);
  grid->GetPointData()->GetNormals()->SetTuple3(4, nan, 0.0, 0.0);
  const auto filter = MakeCurved(grid, MakeFlatMembrane());
  filter->VirtualNormalsOn();
  filter->Update();
  vtkDataArray* normals = filter->GetOutput()->GetPointData()->GetNormals();
  EXPECT_EQ(TupleOf(normals, 3), glm::dvec3(0.0)); // unchanged
  EXPECT_TRUE(std::isnan(TupleOf(normals, 4).x));
  const auto messages = Observe(filter);
  filter->SetLightDirection(0.0, nan, 0.0);
  filter->Update();
  EXPECT_GE(messages->Errors, 1);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  filter->VirtualNormalsOff();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 81);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryLight, TrueGeometryIsThatOfTheImages)
{
  const auto grid = MakeLitGrid(-60.0);
  AddTruth(grid); // "Truth", which the filter interpolates as it does any array
  vtkDataArray* given = grid->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < given->GetNumberOfTuples(); ++i)
  {
    const glm::dvec3 longer = 3.0 * TupleOf(given, i);
    given->SetTuple(i, &longer.x);
  }
  for (const int images :
    { vtkRefractedGeometryFilter::FIRST_IMAGE, vtkRefractedGeometryFilter::ALL_IMAGES })
  {
    const auto filter = MakeCurved(grid, MakeMembrane(Waves.MakeMesh(32)));
    filter->SetImages(images);
    filter->VirtualNormalsOn(); // TrueNormal stays the true one
    filter->Update();
    EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("TruePosition"));
    const vtkTypeInt64 solved = filter->GetNumberOfSolvedVertices();
    filter->TrueGeometryOn();
    filter->Update();
    EXPECT_EQ(filter->GetNumberOfSolvedVertices(), solved);
    vtkPointData* data = filter->GetOutput()->GetPointData();
    vtkDataArray* positions = data->GetArray("TruePosition");
    vtkDataArray* normals = data->GetArray("TrueNormal");
    ASSERT_TRUE(positions && normals) << images;
    ASSERT_GT(positions->GetNumberOfTuples(), 0);
    for (vtkIdType i = 0; i < positions->GetNumberOfTuples(); ++i)
    {
      const glm::dvec3 place = TupleOf(positions, i);
      // Sums of weighted coordinates below 100: a few roundings of 2^-53.
      EXPECT_LT(glm::distance(place, TupleOf(data->GetArray("Truth"), i)), 1e-12);
      EXPECT_NEAR(glm::distance(place, TupleOf(data->GetArray("SightPoint"), i)),
        data->GetArray("RefractionDepth")->GetTuple1(i), 1e-9);
      const glm::dvec3 normal = TupleOf(data->GetArray("Bumps"), i);
      EXPECT_LT(glm::distance(TupleOf(normals, i), glm::normalize(normal)), 1e-14);
    }
  }
  grid->GetPointData()->SetNormals(nullptr);
  grid->GetPointData()->RemoveArray("Bumps");
  const auto filter = MakeCurved(grid, MakeFlatMembrane());
  filter->TrueGeometryOn();
  filter->Update();
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("TruePosition"));
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("TrueNormal"));
}

}

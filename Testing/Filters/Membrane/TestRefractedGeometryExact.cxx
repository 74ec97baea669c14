// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Membranes that have a formula.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkImplicitFunction.h"
#include "vtkObjectFactory.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;

/** y - f(x, z). */
class HeightFunction : public vtkImplicitFunction
{
public:
  static HeightFunction* New();
  vtkTypeMacro(HeightFunction, vtkImplicitFunction);
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override { return x[1] - this->Field.GetHeight(x[0], x[2]); }
  void EvaluateGradient(double x[3], double g[3]) override
  {
    double dx = 0.0;
    double dz = 0.0;
    this->Field.GetSlopes(x[0], x[2], dx, dz);
    g[0] = -dx;
    g[1] = 1.0;
    g[2] = -dz;
  }

  HeightField Field;
};
vtkStandardNewMacro(HeightFunction);

/** A function without a zero, or without a gradient. */
class NowhereZero : public vtkImplicitFunction
{
public:
  static NowhereZero* New();
  vtkTypeMacro(NowhereZero, vtkImplicitFunction);
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override
  {
    return this->HasGradient ? 1.0 + x[1] * x[1] : 1.0;
  }
  void EvaluateGradient(double x[3], double g[3]) override
  {
    g[0] = 0.0;
    g[1] = this->HasGradient ? 2.0 * x[1] : 0.0;
    g[2] = 0.0;
  }

  bool HasGradient = true;
};
vtkStandardNewMacro(NowhereZero);

std::vector<Point> MakeDepths()
{
  std::vector<Point> points;
  for (const auto& [i, k] : Product(5, 5))
  {
    points.push_back({ -40.0 + 20.0 * i, -30.0 - 5.0 * k, -40.0 + 20.0 * k });
  }
  return points;
}

vtkSmartPointer<vtkRefractedGeometryFilter> MakeCurved(vtkPolyData* membrane)
{
  auto filter = MakeFilter(MakePoints(MakeDepths()), membrane);
  filter->SetMembraneModelToCurved();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return filter;
}

double FindLargestDifference(vtkPolyData* a, vtkPolyData* b)
{
  EXPECT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  double largest = 0.0;
  for (vtkIdType i = 0; i < std::min(a->GetNumberOfPoints(), b->GetNumberOfPoints()); ++i)
  {
    const glm::dvec3 p = PointOf(a, i);
    const glm::dvec3 q = PointOf(b, i);
    largest = std::max(largest, glm::length(p - q));
  }
  return largest;
}

}

//------------------------------------------------------------------------------
// A flat sheet with the waves' formula gives the same result as the waves' own mesh with exact
// normals. The sheet's points move along the gradient, not upwards, so the patches differ, but are
// equally accurate.
TEST(RefractedGeometryExact, SheetTakesTheShapeOfTheFormula)
{
  HeightField field;
  field.Amplitude = 1.0;
  field.K = 0.02 * std::acos(-1.0);
  vtkNew<HeightFunction> waves;
  waves->Field = field;
  HeightField flat = field;
  flat.Amplitude = 0.0;
  const auto exact = MakeCurved(MakeMembrane(field.MakeMesh(128)));
  exact->Update();
  ASSERT_EQ(exact->GetOutput()->GetNumberOfPoints(), 25);
  double before = 0.0;
  for (const int cells : { 16, 32 })
  {
    const auto filter = MakeCurved(MakeMembrane(flat.MakeMesh(cells), false));
    filter->SetExactMembrane(waves);
    ExpectQuiet(filter);
    const double error = FindLargestDifference(filter->GetOutput(), exact->GetOutput());
    const auto own = MakeCurved(MakeMembrane(field.MakeMesh(cells)));
    own->Update();
    EXPECT_LT(error, 1.5 * FindLargestDifference(own->GetOutput(), exact->GetOutput()));
    EXPECT_LT(error, before > 0.0 ? before / 6.0 : 1.0); // third order: an eighth
    before = error;
  }
}

//------------------------------------------------------------------------------
// Four facets that are only approximately on a sphere, with normals that are only approximately its
// own.
TEST(RefractedGeometryExact, SpheresAreExactFromAnyMesh)
{
  const double radius = 400.0;
  MembraneMesh rough;
  MembraneMesh fine;
  const auto onSphere = [radius](double x, double z)
  { return glm::dvec3(x, std::sqrt(radius * radius - x * x - z * z) - radius, z); };
  for (const int cells : { 2, 40 })
  {
    MembraneMesh& mesh = cells == 2 ? rough : fine;
    for (const auto& [j, i] : Product(cells + 1, cells + 1))
    {
      const double x = 300.0 * i / cells - 150.0;
      const double z = 300.0 * j / cells - 150.0;
      const glm::dvec3 p = onSphere(x, z);
      const glm::dvec3 off = cells == 2 ? glm::dvec3(i - 1.0, 3.0 - j, j - i) : glm::dvec3(0.0);
      const glm::dvec3 center(0.0, -radius, 0.0);
      mesh.AddPoint(p + off, glm::normalize(p - center + 20.0 * off));
    }
    const int row = cells + 1;
    for (const auto& [j, i] : Product(cells, cells))
    {
      const std::int64_t a = j * row + i;
      mesh.Triangles.insert(
        mesh.Triangles.end(), { a, a + row, a + 1, a + 1, a + row, a + row + 1 });
    }
  }
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(0.0, -radius, 0.0);
  sphere->SetRadius(radius);
  const auto truth = MakeCurved(MakeMembrane(fine));
  truth->Update();
  const auto filter = MakeCurved(MakeMembrane(rough));
  filter->SetExactMembrane(sphere);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 25);
  EXPECT_LT(FindLargestDifference(filter->GetOutput(), truth->GetOutput()), 1e-7);

  // Its inside counts as the other side only if the membrane's normals say so.
  const auto turned = vtkSmartPointer<vtkPolyData>::New();
  turned->DeepCopy(MakeMembrane(rough));
  vtkDataArray* normals = turned->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const glm::dvec3 n = TupleOf(normals, i);
    normals->SetTuple3(i, -n[0], -n[1], -n[2]);
  }
  const auto below = MakeCurved(turned);
  below->SetExactMembrane(sphere);
  const auto messages = UpdateAndObserve(below);
  EXPECT_EQ(below->GetOutput()->GetNumberOfPoints(), 0);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryExact, NothingIsFittedAgainWithoutNeed)
{
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.0, 1.0, 0.0);
  const auto filter = MakeCurved(MakeFlatMembrane());
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 1);
  filter->SetExactMembrane(plane); // the same surface
  filter->Update();
  filter->SetExteriorIndexOfRefraction(1.1);
  filter->Update();
  const vtkTypeInt64 builds = filter->GetNumberOfPatchBuilds();
  plane->SetOrigin(0.0, -1.0, 0.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), builds + 1);
  const double* sight = filter->GetOutput()->GetPointData()->GetArray("SightPoint")->GetTuple3(0);
  EXPECT_NEAR(sight[1], -1.0, 1e-9);
  filter->SetEyePosition(0.0, 100.0, 0.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), builds + 1);
  filter->SetExactMembrane(nullptr);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), builds + 2);
  EXPECT_NEAR(
    filter->GetOutput()->GetPointData()->GetArray("SightPoint")->GetComponent(0, 1), 0.0, 1e-9);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryExact, FunctionsWithoutAZeroLeaveTheMembraneWithAWarning)
{
  const auto plain = MakeCurved(MakeFlatMembrane());
  plain->Update();
  for (const bool hasGradient : { true, false })
  {
    vtkNew<NowhereZero> nowhere;
    nowhere->HasGradient = hasGradient;
    const auto filter = MakeCurved(MakeFlatMembrane());
    filter->SetExactMembrane(nowhere);
    const auto messages = UpdateAndObserve(filter);
    EXPECT_EQ(messages->Errors, 0) << messages->Text;
    EXPECT_EQ(messages->Warnings, 1);
    EXPECT_TRUE(HasText(messages->Text, "81 of 81"));
    EXPECT_LT(FindLargestDifference(filter->GetOutput(), plain->GetOutput()), 1e-9);
  }
}

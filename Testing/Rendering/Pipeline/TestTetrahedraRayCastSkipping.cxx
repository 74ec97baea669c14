// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Invisible cells: they are not visited, not rebuilt without need, and do not change the image.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -1.0, 1.0 };

class TetrahedraRayCastSkipping : public ::testing::TestWithParam<int>
{
protected:
  TetrahedraRayCastSkipping()
    : Mesh(MakeBlock(10, WavyField(3.0)))
    , Property(MakeProperty(FunctionKind::Sparse, Range, 3.5))
    , Scene(this->Mesh, this->Property, Size, Size)
  {
    Jitter(this->Mesh, 0.03, 5);
    this->Scene.GetRayCaster()->SetBackend(this->GetParam());
    LookAt(this->Scene.GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  }

  /** Sets the window of visible scalars, opaque enough to be seen. */
  void SetWindow(double lower, double upper)
  {
    vtkPiecewiseFunction* opacity = this->Property->GetScalarOpacity();
    SetPoints(opacity, { { lower, 0.0 }, { 0.5 * (lower + upper), 1.0 }, { upper, 0.0 } });
  }

  vtkTypeInt64 Builds() { return this->Scene.GetRayCaster()->GetNumberOfActiveSetBuilds(); }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  RayCastScene Scene;
};

INSTANTIATE_TEST_SUITE_P(Backends, TetrahedraRayCastSkipping,
  ::testing::Values(
    int(vtkTetrahedraRayCastMapper::OPENGL), int(vtkTetrahedraRayCastMapper::NATIVE)));

} // anonymous namespace

TEST_P(TetrahedraRayCastSkipping, FewerCellsAndStepsTheSamePicture)
{
  this->SetWindow(0.3, 0.4);
  ExpectMatchesReference(this->Scene, "sparse");
  const vtkTypeInt64 active = this->Scene.GetRayCaster()->GetNumberOfActiveCells();
  const vtkTypeInt64 steps = this->Scene.GetRayCaster()->GetNumberOfTraversalSteps();
  EXPECT_GT(active, 0);
  EXPECT_LT(active, this->Mesh->GetNumberOfCells() / 2);

  this->Property->GetScalarOpacity()->AddPoint(-2.0, 1e-9); // everything is visible, but barely
  this->Property->GetScalarOpacity()->AddPoint(2.0, 1e-9);
  ExpectMatchesReference(this->Scene, "dense");
  EXPECT_EQ(this->Scene.GetRayCaster()->GetNumberOfActiveCells(), this->Mesh->GetNumberOfCells());
  EXPECT_LT(steps, this->Scene.GetRayCaster()->GetNumberOfTraversalSteps() / 2);
}

TEST_P(TetrahedraRayCastSkipping, BuiltOnlyWhenOtherScalarsBecomeVisible)
{
  this->SetWindow(0.3, 0.4);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Builds(), 1);
  this->Scene.GetRenderer()->GetActiveCamera()->Azimuth(10.0);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Builds(), 1);
  this->Property->GetRGBTransferFunction()->AddRGBPoint(-0.9, 1.0, 0.0, 1.0);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Builds(), 1); // a change of a colour
  this->Property->GetScalarOpacity()->AddPoint(0.35, 0.5);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Builds(), 1); // a change of an opacity of scalars that were visible before
  this->SetWindow(-0.4, -0.3);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Builds(), 2);
  vtkDataArray* scalars = this->Mesh->GetPointData()->GetScalars();
  scalars->Modified();
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Builds(), 2); // the same values
  scalars->SetComponent(0, 0, scalars->GetComponent(0, 0) + 0.01);
  scalars->Modified();
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Builds(), 3);
  EXPECT_EQ(this->Scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST_P(TetrahedraRayCastSkipping, NothingVisibleDrawsNothing)
{
  this->SetWindow(0.3, 0.4);
  this->Scene.GetWindow()->Render();
  EXPECT_GT(this->Scene.GetRayCaster()->GetNumberOfRays(), 0);
  this->SetWindow(5.0, 6.0);
  for (const float value : this->Scene.RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_EQ(this->Scene.GetRayCaster()->GetNumberOfActiveCells(), 0);
  EXPECT_EQ(this->Scene.GetRayCaster()->GetNumberOfRays(), 0);
  EXPECT_EQ(this->Scene.GetRayCaster()->GetNumberOfTraversalSteps(), 0);
  this->SetWindow(0.3, 0.4);
  ExpectMatchesReference(this->Scene, "visible again");
}

TEST_P(TetrahedraRayCastSkipping, CellsWithoutScalarAreNotVisited)
{
  this->Property = MakeConstantProperty(0.3, 1.0, 0.5, 0.2, 1.0);
  this->Scene.SetProperty(this->Property);
  auto* scalars = vtkDoubleArray::SafeDownCast(this->Mesh->GetPointData()->GetScalars());
  scalars->SetValue(0, std::numeric_limits<double>::quiet_NaN()); // a corner of the block
  vtkNew<vtkIdList> cells;
  this->Mesh->BuildLinks();
  this->Mesh->GetPointCells(0, cells);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Scene.GetRayCaster()->GetNumberOfActiveCells(),
    this->Mesh->GetNumberOfCells() - cells->GetNumberOfIds());
  EXPECT_EQ(this->Scene.GetRayCaster()->GetNumberOfLostRays(), 0);
}

TEST_P(TetrahedraRayCastSkipping, JumpsAtTheScalarsOfVertices)
{
  // Scalars are whole tenths; the function jumps at two of them.
  auto* scalars = vtkDoubleArray::SafeDownCast(this->Mesh->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetValue(i, std::round(10.0 * scalars->GetValue(i)) / 10.0);
  }
  scalars->Modified();
  vtkPiecewiseFunction* opacity = this->Property->GetScalarOpacity();
  opacity->RemoveAllPoints();
  opacity->ClampingOff(); // nothing is visible outside of the points
  opacity->AddPoint(0.2, 0.7);
  opacity->AddPoint(0.3, 0.7);
  this->Scene.GetWindow()->Render();
  EXPECT_GT(this->Scene.GetRayCaster()->GetNumberOfActiveCells(), 0);
  EXPECT_LT(this->Scene.GetRayCaster()->GetNumberOfActiveCells(), this->Mesh->GetNumberOfCells());
  ExpectMatchesReference(this->Scene, "steps at vertex scalars");
}

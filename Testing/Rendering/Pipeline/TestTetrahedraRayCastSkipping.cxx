// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Invisible cells: they are not visited, not rebuilt without need, and do not change the image.
#include "RayCastScene.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>

#include <cmath>
#include <limits>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -1.0, 1.0 };

class TetrahedraRayCastSkipping : public testing::TestWithParam<int>
{
protected:
  TetrahedraRayCastSkipping()
    : Mesh(makeBlock(10, wavyField(3.0)))
    , Property(makeProperty(FunctionKind::Sparse, Range, 3.5))
    , Scene(this->Mesh, this->Property, Size, Size)
  {
    jitter(this->Mesh, 0.03, 5);
    this->Scene.rayCaster()->SetBackend(this->GetParam());
    lookAt(this->Scene.renderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  }

  /** Sets the window of visible scalars, opaque enough to be seen. */
  void setWindow(double lower, double upper)
  {
    vtkPiecewiseFunction* opacity = this->Property->GetScalarOpacity();
    opacity->RemoveAllPoints();
    opacity->AddPoint(lower, 0.0);
    opacity->AddPoint(0.5 * (lower + upper), 1.0);
    opacity->AddPoint(upper, 0.0);
  }

  vtkTypeInt64 builds() { return this->Scene.rayCaster()->GetNumberOfActiveSetBuilds(); }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  RayCastScene Scene;
};

INSTANTIATE_TEST_SUITE_P(Backends, TetrahedraRayCastSkipping,
  testing::Values(
    int(vtkTetrahedraRayCastMapper::OPENGL), int(vtkTetrahedraRayCastMapper::NATIVE)));

} // anonymous namespace

TEST_P(TetrahedraRayCastSkipping, FewerCellsAndStepsTheSamePicture)
{
  this->setWindow(0.3, 0.4);
  expectMatchesReference(this->Scene, "sparse");
  const vtkTypeInt64 active = this->Scene.rayCaster()->GetNumberOfActiveCells();
  const vtkTypeInt64 steps = this->Scene.rayCaster()->GetNumberOfTraversalSteps();
  EXPECT_GT(active, 0);
  EXPECT_LT(active, this->Mesh->GetNumberOfCells() / 2);

  this->Property->GetScalarOpacity()->AddPoint(-2.0, 1e-9); // everything is visible, but barely
  this->Property->GetScalarOpacity()->AddPoint(2.0, 1e-9);
  expectMatchesReference(this->Scene, "dense");
  EXPECT_EQ(this->Scene.rayCaster()->GetNumberOfActiveCells(), this->Mesh->GetNumberOfCells());
  EXPECT_LT(steps, this->Scene.rayCaster()->GetNumberOfTraversalSteps() / 2);
}

TEST_P(TetrahedraRayCastSkipping, BuiltOnlyWhenOtherScalarsBecomeVisible)
{
  this->setWindow(0.3, 0.4);
  this->Scene.window()->Render();
  EXPECT_EQ(this->builds(), 1);
  this->Scene.renderer()->GetActiveCamera()->Azimuth(10.0);
  this->Scene.window()->Render();
  EXPECT_EQ(this->builds(), 1);
  this->Property->GetRGBTransferFunction()->AddRGBPoint(-0.9, 1.0, 0.0, 1.0);
  this->Scene.window()->Render();
  EXPECT_EQ(this->builds(), 1); // a change of a colour
  this->Property->GetScalarOpacity()->AddPoint(0.35, 0.5);
  this->Scene.window()->Render();
  EXPECT_EQ(this->builds(), 1); // a change of an opacity of scalars that were visible before
  this->setWindow(-0.4, -0.3);
  this->Scene.window()->Render();
  EXPECT_EQ(this->builds(), 2);
  vtkDataArray* scalars = this->Mesh->GetPointData()->GetScalars();
  scalars->Modified();
  this->Scene.window()->Render();
  EXPECT_EQ(this->builds(), 2); // the same values
  scalars->SetComponent(0, 0, scalars->GetComponent(0, 0) + 0.01);
  scalars->Modified();
  this->Scene.window()->Render();
  EXPECT_EQ(this->builds(), 3);
  EXPECT_EQ(this->Scene.rayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST_P(TetrahedraRayCastSkipping, NothingVisibleDrawsNothing)
{
  this->setWindow(0.3, 0.4);
  this->Scene.window()->Render();
  EXPECT_GT(this->Scene.rayCaster()->GetNumberOfRays(), 0);
  this->setWindow(5.0, 6.0);
  for (const float value : this->Scene.renderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_EQ(this->Scene.rayCaster()->GetNumberOfActiveCells(), 0);
  EXPECT_EQ(this->Scene.rayCaster()->GetNumberOfRays(), 0);
  EXPECT_EQ(this->Scene.rayCaster()->GetNumberOfTraversalSteps(), 0);
  this->setWindow(0.3, 0.4);
  expectMatchesReference(this->Scene, "visible again");
}

TEST_P(TetrahedraRayCastSkipping, CellsWithoutScalarAreNotVisited)
{
  this->Property = makeConstantProperty(0.3, 1.0, 0.5, 0.2, 1.0);
  this->Scene.setProperty(this->Property);
  auto* scalars = vtkDoubleArray::SafeDownCast(this->Mesh->GetPointData()->GetScalars());
  scalars->SetValue(0, std::numeric_limits<double>::quiet_NaN()); // a corner of the block
  vtkNew<vtkIdList> cells;
  this->Mesh->BuildLinks();
  this->Mesh->GetPointCells(0, cells);
  this->Scene.window()->Render();
  EXPECT_EQ(this->Scene.rayCaster()->GetNumberOfActiveCells(),
    this->Mesh->GetNumberOfCells() - cells->GetNumberOfIds());
  EXPECT_EQ(this->Scene.rayCaster()->GetNumberOfLostRays(), 0);
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
  this->Scene.window()->Render();
  EXPECT_GT(this->Scene.rayCaster()->GetNumberOfActiveCells(), 0);
  EXPECT_LT(this->Scene.rayCaster()->GetNumberOfActiveCells(), this->Mesh->GetNumberOfCells());
  expectMatchesReference(this->Scene, "steps at vertex scalars");
}

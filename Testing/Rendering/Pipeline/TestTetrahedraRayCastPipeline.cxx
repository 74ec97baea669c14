// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Work after each kind of change, measured by the mapper's counters.
#include "RayCastScene.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;

struct Counters
{
  vtkTypeInt64 MeshBuilds;
  vtkTypeInt64 ScalarUpdates;
  vtkTypeInt64 FunctionBuilds;
  vtkTypeInt64 Bytes;

  explicit Counters(vtkTetrahedraRayCastMapper* mapper)
    : MeshBuilds(mapper->GetNumberOfMeshBuilds())
    , ScalarUpdates(mapper->GetNumberOfScalarUpdates())
    , FunctionBuilds(mapper->GetNumberOfTransferFunctionBuilds())
    , Bytes(mapper->GetUploadedBytes())
  {
  }
};

// True if a counter is expected to increase (by one for builds).
struct Expected
{
  int MeshBuilds;
  int ScalarUpdates;
  int FunctionBuilds;
  bool Uploads;
};

void expectChange(RayCastScene& scene, const Expected& expected, const std::string& what)
{
  const Counters before(scene.rayCaster());
  scene.window()->Render();
  const Counters after(scene.rayCaster());
  EXPECT_EQ(after.MeshBuilds - before.MeshBuilds, expected.MeshBuilds) << what;
  EXPECT_EQ(after.ScalarUpdates - before.ScalarUpdates, expected.ScalarUpdates) << what;
  EXPECT_EQ(after.FunctionBuilds - before.FunctionBuilds, expected.FunctionBuilds) << what;
  EXPECT_EQ(after.Bytes != before.Bytes, expected.Uploads) << what;
}

class TetrahedraRayCastPipeline : public testing::Test
{
protected:
  TetrahedraRayCastPipeline()
    : Mesh(makeBlock(6, wavyField(3.0)))
  {
    const double range[2] = { -1.5, 1.5 };
    this->Property = makeProperty(FunctionKind::Smooth, range, 3.5);
    this->Scene = std::make_unique<RayCastScene>(this->Mesh, this->Property, Size, Size);
    lookAt(this->Scene->renderer(), this->Mesh->GetBounds(), 30.0, 20.0);
    this->Scene->window()->Render();
  }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  std::unique_ptr<RayCastScene> Scene;
};

} // anonymous namespace

TEST_F(TetrahedraRayCastPipeline, FirstFrameBuildsEverythingOnce)
{
  const Counters counters(this->Scene->rayCaster());
  EXPECT_EQ(counters.MeshBuilds, 1);
  EXPECT_EQ(counters.ScalarUpdates, 1);
  EXPECT_EQ(counters.FunctionBuilds, 1);
  EXPECT_GT(counters.Bytes, 0);
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfActiveCells(), this->Mesh->GetNumberOfCells());
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfRejectedCells(), 0);
  EXPECT_GT(this->Scene->rayCaster()->GetNumberOfRays(), 0);
  EXPECT_GT(this->Scene->rayCaster()->GetNumberOfTraversalSteps(),
    this->Scene->rayCaster()->GetNumberOfRays());
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfLostRays(), 0);
  EXPECT_NE(
    this->Scene->rayCaster()->GetActiveBackend(), int(vtkTetrahedraRayCastMapper::AUTOMATIC));
}

TEST_F(TetrahedraRayCastPipeline, NothingChangedRebuildsNothing)
{
  for (int i = 0; i < 3; ++i)
  {
    expectChange(*this->Scene, { 0, 0, 0, false }, "nothing changed");
  }
}

TEST_F(TetrahedraRayCastPipeline, CameraMoveUploadsNothing)
{
  for (int i = 0; i < 3; ++i)
  {
    this->Scene->renderer()->GetActiveCamera()->Azimuth(15.0);
    expectChange(*this->Scene, { 0, 0, 0, false }, "camera moved");
  }
  this->Scene->renderer()->GetActiveCamera()->SetParallelProjection(true);
  expectChange(*this->Scene, { 0, 0, 0, false }, "projection changed");
}

TEST_F(TetrahedraRayCastPipeline, VolumeMoveUploadsNothing)
{
  this->Scene->volume()->RotateX(20.0);
  expectChange(*this->Scene, { 0, 0, 0, false }, "volume moved");
}

TEST_F(TetrahedraRayCastPipeline, TransferFunctionEditRebuildsOnlyIt)
{
  this->Property->GetScalarOpacity()->AddPoint(0.4, 0.6);
  expectChange(*this->Scene, { 0, 0, 1, true }, "opacity node added");
  this->Property->GetRGBTransferFunction()->AddRGBPoint(0.1, 1.0, 0.0, 1.0);
  expectChange(*this->Scene, { 0, 0, 1, true }, "colour node added");
  this->Property->SetScalarOpacityUnitDistance(0.2);
  expectChange(*this->Scene, { 0, 0, 1, true }, "unit distance changed");
  expectMatchesReference(*this->Scene, "after the edits");
}

TEST_F(TetrahedraRayCastPipeline, NewPropertyIsSeen)
{
  this->Scene->setProperty(makeConstantProperty(0.5, 1.0, 0.2, 0.1, 1.0));
  expectChange(*this->Scene, { 0, 0, 1, true }, "another property");
  expectMatchesReference(*this->Scene, "another property");
}

TEST_F(TetrahedraRayCastPipeline, ScalarChangeUpdatesOnlyScalars)
{
  auto* scalars = vtkDoubleArray::SafeDownCast(this->Mesh->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetValue(i, -0.7 * scalars->GetValue(i));
  }
  scalars->Modified();
  expectChange(*this->Scene, { 0, 1, 0, true }, "scalars changed");
  expectMatchesReference(*this->Scene, "scalars changed");
}

TEST_F(TetrahedraRayCastPipeline, OtherArrayUpdatesOnlyScalars)
{
  vtkNew<vtkDoubleArray> other;
  other->SetName("Other");
  other->SetNumberOfTuples(this->Mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < other->GetNumberOfTuples(); ++i)
  {
    other->SetValue(i, this->Mesh->GetPoint(i)[0]);
  }
  this->Mesh->GetPointData()->AddArray(other);
  this->Scene->window()->Render();
  this->Scene->rayCaster()->SetScalarModeToUsePointFieldData();
  this->Scene->rayCaster()->SelectScalarArray("Other");
  expectChange(*this->Scene, { 0, 1, 0, true }, "another array selected");
  this->Mesh->GetPointData()->SetActiveScalars("Other");
  expectMatchesReference(*this->Scene, "another array selected");
}

TEST_F(TetrahedraRayCastPipeline, PointChangeRebuildsTheMesh)
{
  jitter(this->Mesh, 0.02, 7);
  this->Mesh->Modified();
  const Counters before(this->Scene->rayCaster());
  this->Scene->window()->Render();
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfMeshBuilds(), before.MeshBuilds + 1);
  expectMatchesReference(*this->Scene, "points moved");
}

TEST_F(TetrahedraRayCastPipeline, SetUpTellsProgressAndCanBeAborted)
{
  class Observer : public vtkCommand
  {
  public:
    static Observer* New() { return new Observer; }
    void Execute(vtkObject* caller, unsigned long, void* data) override
    {
      ++this->Events;
      if (*static_cast<double*>(data) >= this->AbortAt)
      {
        vtkTetrahedraRayCastMapper::SafeDownCast(caller)->AbortExecuteOn();
      }
    }
    int Events = 0;
    double AbortAt = 0.4;
  };
  vtkNew<Observer> observer;
  vtkTetrahedraRayCastMapper* mapper = this->Scene->rayCaster();
  mapper->AddObserver(vtkCommand::ProgressEvent, observer);
  this->Scene->window()->Render();
  EXPECT_EQ(observer->Events, 0); // nothing to build

  jitter(this->Mesh, 0.02, 7);
  this->Mesh->Modified();
  for (const float value : this->Scene->renderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_GT(observer->Events, 0);
  EXPECT_EQ(mapper->GetNumberOfActiveCells(), 0);
  observer->AbortAt = 2.0;
  expectMatchesReference(*this->Scene, "set up after an abort");
}

TEST_F(TetrahedraRayCastPipeline, NewInputRebuildsTheMesh)
{
  const Grid other = makeBlock(5, wavyField(2.0), lShape());
  this->Scene->rayCaster()->SetInputData(other);
  this->Scene->window()->Render();
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfMeshBuilds(), 2);
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfActiveCells(), other->GetNumberOfCells());
}

TEST_F(TetrahedraRayCastPipeline, ReleasedResourcesGiveTheSamePicture)
{
  const FloatImage before = this->Scene->renderFloat();
  this->Scene->rayCaster()->ReleaseGraphicsResources(this->Scene->window());
  this->Scene->rayCaster()->ReleaseGraphicsResources(this->Scene->window());
  const FloatImage after = this->Scene->renderFloat();
  EXPECT_EQ(before.Rgba, after.Rgba);
  this->Scene->rayCaster()->ReleaseGraphicsResources(nullptr);
  EXPECT_EQ(before.Rgba, this->Scene->renderFloat().Rgba);
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST_F(TetrahedraRayCastPipeline, SameFrameTwiceIsTheSameBitForBit)
{
  EXPECT_EQ(this->Scene->renderFloat().Rgba, this->Scene->renderFloat().Rgba);
}

TEST_F(TetrahedraRayCastPipeline, TwoWindowsShareAMapper)
{
  const ByteImage first = this->Scene->renderBytes();
  VolumeScene other(Size, Size);
  other.setMapper(this->Scene->rayCaster());
  other.setProperty(this->Property);
  lookAt(other.renderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  EXPECT_EQ(other.renderBytes().Rgb, first.Rgb);
  EXPECT_EQ(this->Scene->renderBytes().Rgb, first.Rgb);
  EXPECT_EQ(this->Scene->rayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST_F(TetrahedraRayCastPipeline, MapperOutlivesItsWindow)
{
  const ByteImage first = this->Scene->renderBytes();
  vtkSmartPointer<vtkTetrahedraRayCastMapper> mapper = this->Scene->rayCaster();
  this->Scene.reset();
  VolumeScene other(Size, Size);
  other.setMapper(mapper);
  other.setProperty(this->Property);
  lookAt(other.renderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  EXPECT_EQ(other.renderBytes().Rgb, first.Rgb);
}

TEST_F(TetrahedraRayCastPipeline, LostContext)
{
  // The window releases its context and creates a new one.
  const ByteImage first = this->Scene->renderBytes();
  this->Scene->window()->Finalize();
  EXPECT_EQ(this->Scene->renderBytes().Rgb, first.Rgb);
}

TEST_F(TetrahedraRayCastPipeline, TransferFunctionEditedDuringARenderOfAnotherWindow)
{
  RayCastScene other(this->Mesh, this->Property, Size, Size);
  lookAt(other.renderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  this->Scene->window()->Render();
  other.window()->Render();
  // After the other renderer has drawn its volume, and before its window shows it.
  vtkNew<vtkCallbackCommand> edit;
  edit->SetClientData(this->Property.Get());
  edit->SetCallback(
    [](vtkObject*, unsigned long, void* property, void*)
    {
      static_cast<vtkVolumeProperty*>(property)->GetScalarOpacity()->RemoveAllPoints();
      static_cast<vtkVolumeProperty*>(property)->GetScalarOpacity()->AddPoint(0.0, 0.0);
    });
  const unsigned long tag = other.renderer()->AddObserver(vtkCommand::EndEvent, edit);
  other.window()->Render();
  other.renderer()->RemoveObserver(tag);
  // Now nothing is visible in either window.
  for (RayCastScene* scene : { this->Scene.get(), &other })
  {
    for (const float value : scene->renderFloat().Rgba)
    {
      ASSERT_EQ(value, 0.0f);
    }
  }
}

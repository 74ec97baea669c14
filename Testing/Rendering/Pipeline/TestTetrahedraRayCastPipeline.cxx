// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Work after each kind of change, measured by the mapper's counters.
#include "RayCastScene.h"

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

void ExpectChange(RayCastScene& scene, const Expected& expected, const std::string& what)
{
  const Counters before(scene.GetRayCaster());
  scene.GetWindow()->Render();
  const Counters after(scene.GetRayCaster());
  EXPECT_EQ(after.MeshBuilds - before.MeshBuilds, expected.MeshBuilds) << what;
  EXPECT_EQ(after.ScalarUpdates - before.ScalarUpdates, expected.ScalarUpdates) << what;
  EXPECT_EQ(after.FunctionBuilds - before.FunctionBuilds, expected.FunctionBuilds) << what;
  EXPECT_EQ(after.Bytes != before.Bytes, expected.Uploads) << what;
}

class TetrahedraRayCastPipeline : public ::testing::Test
{
protected:
  TetrahedraRayCastPipeline()
    : Mesh(MakeBlock(6, WavyField(3.0)))
  {
    const double range[2] = { -1.5, 1.5 };
    this->Property = MakeProperty(FunctionKind::Smooth, range, 3.5);
    this->Scene = std::make_unique<RayCastScene>(this->Mesh, this->Property, Size, Size);
    LookAt(this->Scene->GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
    this->Scene->GetWindow()->Render();
  }

  Grid Mesh;
  vtkSmartPointer<vtkVolumeProperty> Property;
  std::unique_ptr<RayCastScene> Scene;
};

} // anonymous namespace

TEST_F(TetrahedraRayCastPipeline, FirstFrameBuildsEverythingOnce)
{
  const Counters counters(this->Scene->GetRayCaster());
  EXPECT_EQ(counters.MeshBuilds, 1);
  EXPECT_EQ(counters.ScalarUpdates, 1);
  EXPECT_EQ(counters.FunctionBuilds, 1);
  EXPECT_GT(counters.Bytes, 0);
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfActiveCells(), this->Mesh->GetNumberOfCells());
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfRejectedCells(), 0);
  EXPECT_GT(this->Scene->GetRayCaster()->GetNumberOfRays(), 0);
  EXPECT_GT(this->Scene->GetRayCaster()->GetNumberOfTraversalSteps(),
    this->Scene->GetRayCaster()->GetNumberOfRays());
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfLostRays(), 0);
  EXPECT_NE(
    this->Scene->GetRayCaster()->GetActiveBackend(), int(vtkTetrahedraRayCastMapper::AUTOMATIC));
}

TEST_F(TetrahedraRayCastPipeline, NothingChangedRebuildsNothing)
{
  for (int i = 0; i < 3; ++i)
  {
    ExpectChange(*this->Scene, { 0, 0, 0, false }, "nothing changed");
  }
}

TEST_F(TetrahedraRayCastPipeline, CameraMoveUploadsNothing)
{
  for (int i = 0; i < 3; ++i)
  {
    this->Scene->GetRenderer()->GetActiveCamera()->Azimuth(15.0);
    ExpectChange(*this->Scene, { 0, 0, 0, false }, "camera moved");
  }
  this->Scene->GetRenderer()->GetActiveCamera()->SetParallelProjection(true);
  ExpectChange(*this->Scene, { 0, 0, 0, false }, "projection changed");
}

TEST_F(TetrahedraRayCastPipeline, VolumeMoveUploadsNothing)
{
  this->Scene->GetVolume()->RotateX(20.0);
  ExpectChange(*this->Scene, { 0, 0, 0, false }, "volume moved");
}

TEST_F(TetrahedraRayCastPipeline, TransferFunctionEditRebuildsOnlyIt)
{
  this->Property->GetScalarOpacity()->AddPoint(0.4, 0.6);
  ExpectChange(*this->Scene, { 0, 0, 1, true }, "opacity node added");
  this->Property->GetRGBTransferFunction()->AddRGBPoint(0.1, 1.0, 0.0, 1.0);
  ExpectChange(*this->Scene, { 0, 0, 1, true }, "colour node added");
  this->Property->SetScalarOpacityUnitDistance(0.2);
  ExpectChange(*this->Scene, { 0, 0, 1, true }, "unit distance changed");
  ExpectMatchesReference(*this->Scene, "after the edits");
}

TEST_F(TetrahedraRayCastPipeline, NewPropertyIsSeen)
{
  this->Scene->SetProperty(MakeConstantProperty(0.5, 1.0, 0.2, 0.1, 1.0));
  ExpectChange(*this->Scene, { 0, 0, 1, true }, "another property");
  ExpectMatchesReference(*this->Scene, "another property");
}

TEST_F(TetrahedraRayCastPipeline, ScalarChangeUpdatesOnlyScalars)
{
  auto* scalars = vtkDoubleArray::SafeDownCast(this->Mesh->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetValue(i, -0.7 * scalars->GetValue(i));
  }
  scalars->Modified();
  ExpectChange(*this->Scene, { 0, 1, 0, true }, "scalars changed");
  ExpectMatchesReference(*this->Scene, "scalars changed");
}

TEST_F(TetrahedraRayCastPipeline, OtherArrayUpdatesOnlyScalars)
{
  this->Mesh->GetPointData()->AddArray(MakeArray("Other", this->Mesh->GetNumberOfPoints(),
    [&](vtkIdType i) { return this->Mesh->GetPoint(i)[0]; }));
  this->Scene->GetWindow()->Render();
  this->Scene->GetRayCaster()->SetScalarModeToUsePointFieldData();
  this->Scene->GetRayCaster()->SelectScalarArray("Other");
  ExpectChange(*this->Scene, { 0, 1, 0, true }, "another array selected");
  this->Mesh->GetPointData()->SetActiveScalars("Other");
  ExpectMatchesReference(*this->Scene, "another array selected");
}

TEST_F(TetrahedraRayCastPipeline, PointChangeMovesTheMesh)
{
  Jitter(this->Mesh, 0.02, 7);
  this->Mesh->Modified();
  const Counters before(this->Scene->GetRayCaster());
  this->Scene->GetWindow()->Render();
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfMeshBuilds(), before.MeshBuilds);
  EXPECT_EQ(this->Scene->GetRayCaster()->GetStatistic("NumberOfPointUpdates"), 1);
  ExpectMatchesReference(*this->Scene, "points moved");
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
  vtkTetrahedraRayCastMapper* mapper = this->Scene->GetRayCaster();
  mapper->AddObserver(vtkCommand::ProgressEvent, observer);
  this->Scene->GetWindow()->Render();
  EXPECT_EQ(observer->Events, 0); // nothing to build

  // The same cell with two corners exchanged.
  vtkDataArray* ids = this->Mesh->GetCells()->GetConnectivityArray();
  const double first = ids->GetComponent(0, 0);
  ids->SetComponent(0, 0, ids->GetComponent(1, 0));
  ids->SetComponent(1, 0, first);
  this->Mesh->Modified();
  for (const float value : this->Scene->RenderFloat().Rgba)
  {
    ASSERT_EQ(value, 0.0f);
  }
  EXPECT_GT(observer->Events, 0);
  EXPECT_EQ(mapper->GetNumberOfActiveCells(), 0);
  observer->AbortAt = 2.0;
  ExpectMatchesReference(*this->Scene, "set up after an abort");
}

TEST_F(TetrahedraRayCastPipeline, NewInputRebuildsTheMesh)
{
  const Grid other = MakeBlock(5, WavyField(2.0), LShape());
  this->Scene->GetRayCaster()->SetInputData(other);
  this->Scene->GetWindow()->Render();
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfMeshBuilds(), 2);
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfActiveCells(), other->GetNumberOfCells());
}

TEST_F(TetrahedraRayCastPipeline, ReleasedResourcesGiveTheSamePicture)
{
  const FloatImage before = this->Scene->RenderFloat();
  this->Scene->GetRayCaster()->ReleaseGraphicsResources(this->Scene->GetWindow());
  this->Scene->GetRayCaster()->ReleaseGraphicsResources(this->Scene->GetWindow());
  const FloatImage after = this->Scene->RenderFloat();
  EXPECT_EQ(before.Rgba, after.Rgba);
  this->Scene->GetRayCaster()->ReleaseGraphicsResources(nullptr);
  EXPECT_EQ(before.Rgba, this->Scene->RenderFloat().Rgba);
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST_F(TetrahedraRayCastPipeline, SameFrameTwiceIsTheSameBitForBit)
{
  EXPECT_EQ(this->Scene->RenderFloat().Rgba, this->Scene->RenderFloat().Rgba);
}

TEST_F(TetrahedraRayCastPipeline, TwoWindowsShareAMapper)
{
  const ByteImage first = this->Scene->RenderBytes();
  VolumeScene other(Size, Size);
  other.SetMapper(this->Scene->GetRayCaster());
  other.SetProperty(this->Property);
  LookAt(other.GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  EXPECT_EQ(other.RenderBytes().Rgb, first.Rgb);
  EXPECT_EQ(this->Scene->RenderBytes().Rgb, first.Rgb);
  EXPECT_EQ(this->Scene->GetRayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST_F(TetrahedraRayCastPipeline, MapperOutlivesItsWindow)
{
  const ByteImage first = this->Scene->RenderBytes();
  vtkSmartPointer<vtkTetrahedraRayCastMapper> mapper = this->Scene->GetRayCaster();
  this->Scene.reset();
  VolumeScene other(Size, Size);
  other.SetMapper(mapper);
  other.SetProperty(this->Property);
  LookAt(other.GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  EXPECT_EQ(other.RenderBytes().Rgb, first.Rgb);
}

TEST_F(TetrahedraRayCastPipeline, LostContext)
{
  // The window releases its context and creates a new one.
  const ByteImage first = this->Scene->RenderBytes();
  this->Scene->GetWindow()->Finalize();
  EXPECT_EQ(this->Scene->RenderBytes().Rgb, first.Rgb);
}

TEST_F(TetrahedraRayCastPipeline, TransferFunctionEditedDuringARenderOfAnotherWindow)
{
  RayCastScene other(this->Mesh, this->Property, Size, Size);
  LookAt(other.GetRenderer(), this->Mesh->GetBounds(), 30.0, 20.0);
  this->Scene->GetWindow()->Render();
  other.GetWindow()->Render();
  // After the other renderer has drawn its volume, and before its window shows it.
  vtkNew<vtkCallbackCommand> edit;
  edit->SetClientData(this->Property.Get());
  edit->SetCallback(
    [](vtkObject*, unsigned long, void* property, void*) {
      SetPoints(static_cast<vtkVolumeProperty*>(property)->GetScalarOpacity(), { { 0.0, 0.0 } });
    });
  const unsigned long tag = other.GetRenderer()->AddObserver(vtkCommand::EndEvent, edit);
  other.GetWindow()->Render();
  other.GetRenderer()->RemoveObserver(tag);
  // Now nothing is visible in either window.
  for (RayCastScene* scene : { this->Scene.get(), &other })
  {
    for (const float value : scene->RenderFloat().Rgba)
    {
      ASSERT_EQ(value, 0.0f);
    }
  }
}

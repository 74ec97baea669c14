// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Recomputation after a change, measured by the counters; eye, camera, composite data, abort.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace
{

using namespace meniscus::test;

struct Counters
{
  vtkTypeInt64 Patches;
  vtkTypeInt64 Eyes;
  vtkTypeInt64 Vertices;
  bool operator==(const Counters& o) const
  {
    return this->Patches == o.Patches && this->Eyes == o.Eyes && this->Vertices == o.Vertices;
  }
};

std::ostream& operator<<(std::ostream& os, const Counters& c)
{
  return os << c.Patches << " patch builds, " << c.Eyes << " eye updates, " << c.Vertices
            << " vertices";
}

Counters Read(vtkRefractedGeometryFilter* filter)
{
  return { filter->GetNumberOfPatchBuilds(), filter->GetNumberOfEyeUpdates(),
    filter->GetNumberOfSolvedVertices() };
}

class RefractedGeometryCache : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Grid = MakeGrid(9, 80.0, -50.0);
    this->Membrane = MakeFlatMembrane();
    this->Filter = MakeFilter(this->Grid, this->Membrane);
    this->Filter->Update();
    ASSERT_EQ(Read(this->Filter), (Counters{ 1, 1, 81 }));
  }

  void ExpectAfterUpdate(const Counters& expected)
  {
    const vtkMTimeType before = this->Filter->GetOutput()->GetMTime();
    this->Filter->Update();
    EXPECT_EQ(Read(this->Filter), expected);
    this->Executed = this->Filter->GetOutput()->GetMTime() != before;
  }

  vtkSmartPointer<vtkPolyData> Grid;
  vtkSmartPointer<vtkPolyData> Membrane;
  vtkSmartPointer<vtkRefractedGeometryFilter> Filter;
  bool Executed = false;
};

//------------------------------------------------------------------------------
TEST_F(RefractedGeometryCache, NothingChangedNothingRuns)
{
  this->ExpectAfterUpdate({ 1, 1, 81 });
  EXPECT_FALSE(this->Executed);
}

TEST_F(RefractedGeometryCache, MovedObjectIsNoticedByTheDataSetsTimeAlone)
{
  const glm::dvec3 before = PointOf(this->Filter->GetOutput(), 0);
  this->Grid->GetPoints()->SetPoint(0, 1.0, -20.0, 3.0);
  this->Grid->Modified();
  this->ExpectAfterUpdate({ 1, 1, 162 });
  const glm::dvec3 after = PointOf(this->Filter->GetOutput(), 0);
  EXPECT_NE(before[1], after[1]);
}

TEST_F(RefractedGeometryCache, RecolouredObjectKeepsItsVirtualVertices)
{
  this->Grid->GetPointData()->AddArray(MakeArray<vtkFloatArray>("Colour", 81, 0.5));
  this->ExpectAfterUpdate({ 1, 1, 81 });
  EXPECT_TRUE(this->Executed);
  EXPECT_NE(this->Filter->GetOutput()->GetPointData()->GetArray("Colour"), nullptr);
}

TEST_F(RefractedGeometryCache, ChangedConnectivityKeepsTheVirtualVertices)
{
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell({ 0, 1, 2 });
  this->Grid->SetPolys(polys);
  this->Grid->GetCellData()->Initialize();
  this->ExpectAfterUpdate({ 1, 1, 81 });
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPolys(), 1);
}

TEST_F(RefractedGeometryCache, MovedEyeKeepsTheMembrane)
{
  this->Filter->SetEyePosition(0.0, 250.0, 0.0);
  this->ExpectAfterUpdate({ 1, 2, 162 });
}

TEST_F(RefractedGeometryCache, ChangedIndexIsANewEye)
{
  this->Filter->SetInteriorIndexOfRefraction(1.5);
  this->ExpectAfterUpdate({ 1, 2, 162 });
  this->Filter->SetExteriorIndexOfRefraction(1.1);
  this->ExpectAfterUpdate({ 1, 3, 243 });
}

TEST_F(RefractedGeometryCache, ChangedMembraneRebuildsEverything)
{
  this->Membrane->GetPoints()->SetPoint(40, 0.0, 1.0, 0.0);
  this->Membrane->GetPoints()->Modified();
  this->ExpectAfterUpdate({ 2, 2, 162 });
}

TEST_F(RefractedGeometryCache, ChangedMembraneNormalsRebuildEverything)
{
  this->Membrane->GetPointData()->GetNormals()->SetTuple3(40, 0.1, 1.0, 0.0);
  this->Membrane->GetPointData()->GetNormals()->Modified();
  this->ExpectAfterUpdate({ 2, 2, 162 });
}

TEST_F(RefractedGeometryCache, TouchedMembraneOfTheSameShapeRebuildsNothing)
{
  this->Membrane->Modified();
  this->ExpectAfterUpdate({ 1, 1, 81 });
  const auto copy = MakeFlatMembrane();
  this->Filter->SetMembraneData(copy);
  this->ExpectAfterUpdate({ 1, 1, 81 });
}

TEST_F(RefractedGeometryCache, BrokenMembraneIsNotRemembered)
{
  const auto messages = Observe(this->Filter);
  vtkNew<vtkPolyData> empty;
  this->Filter->SetMembraneData(empty);
  this->Filter->Update();
  EXPECT_GE(messages->Errors, 1);
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 0);
  this->Filter->SetMembraneData(this->Membrane);
  this->Filter->Update();
  EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfPoints(), 81);
}

//------------------------------------------------------------------------------
TEST_F(RefractedGeometryCache, EyeFollowsTheCamera)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(20.0, 300.0, 10.0); // where the eye already is
  this->Filter->SetCamera(camera);
  EXPECT_EQ(this->Filter->GetCamera(), camera);
  this->ExpectAfterUpdate({ 1, 1, 81 });
  camera->SetPosition(0.0, 250.0, 0.0);
  this->ExpectAfterUpdate({ 1, 2, 162 });
  // The same as by SetEyePosition.
  const auto other = MakeFilter(this->Grid, this->Membrane);
  other->SetEyePosition(0.0, 250.0, 0.0);
  other->Update();
  const glm::dvec3 a = PointOf(this->Filter->GetOutput(), 5);
  const glm::dvec3 b = PointOf(other->GetOutput(), 5);
  EXPECT_TRUE(a[0] == b[0] && a[1] == b[1] && a[2] == b[2]);
  // The camera is rotated, not moved: nothing is solved again.
  camera->SetFocalPoint(10.0, 0.0, 0.0);
  camera->Zoom(2.0);
  this->ExpectAfterUpdate({ 1, 2, 162 });
  this->Filter->SetCamera(nullptr);
  this->ExpectAfterUpdate({ 1, 3, 243 });
}

// The eye is at infinity: it depends on the direction, not on the position.
TEST_F(RefractedGeometryCache, MovesOfAParallelCameraSolveNothing)
{
  const auto messages = Observe(this->Filter);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 250.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->ParallelProjectionOn();
  this->Filter->SetCamera(camera);
  this->Filter->Update();
  const vtkTypeInt64 solved = this->Filter->GetNumberOfSolvedVertices();
  camera->SetPosition(0.0, 240.0, 0.0);
  this->Filter->Update();
  EXPECT_EQ(this->Filter->GetNumberOfSolvedVertices(), solved);
  EXPECT_EQ(messages->Warnings, 0) << messages->Text;
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryPipeline, MultiBlockBuildsTheMembraneOnce)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  std::vector<vtkSmartPointer<vtkPolyData>> leaves;
  for (unsigned int i = 0; i < 5; ++i)
  {
    leaves.push_back(MakeGrid(5, 80.0, -20.0 - 10.0 * i));
    blocks->SetBlock(i, leaves.back());
  }
  vtkNew<vtkRefractedGeometryFilter> filter;
  filter->SetMembraneModelToFlatFacets();
  filter->SetImagesToFirstImage();
  filter->SetEyePosition(20.0, 300.0, 10.0);
  filter->SetInputDataObject(0, blocks);
  filter->SetMembraneData(MakeFlatMembrane());
  filter->Update();
  EXPECT_EQ(Read(filter), (Counters{ 1, 1, 125 }));

  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  ASSERT_EQ(output->GetNumberOfBlocks(), 5u);
  for (unsigned int i = 0; i < 5; ++i)
  {
    auto* leaf = vtkPolyData::SafeDownCast(output->GetBlock(i));
    ASSERT_NE(leaf, nullptr);
    EXPECT_EQ(leaf->GetNumberOfPoints(), 25);
    EXPECT_EQ(leaf->GetNumberOfPolys(), 16);
    const glm::dvec3 p = PointOf(leaf, 0);
    EXPECT_NEAR(p[1], -(20.0 + 10.0 * i) / 1.333, 4.0); // about the apparent depth
  }

  // One block moves: only its points are solved again.
  leaves[2]->GetPoints()->SetPoint(0, 1.0, -20.0, 3.0);
  leaves[2]->GetPoints()->Modified();
  blocks->Modified();
  filter->Update();
  EXPECT_EQ(Read(filter), (Counters{ 1, 1, 150 }));

  filter->SetEyePosition(0.0, 250.0, 0.0);
  filter->Update();
  EXPECT_EQ(Read(filter), (Counters{ 1, 2, 275 }));
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryPipeline, CachesGoWithTheirData)
{
  const auto filter = MakeFilter(MakeGrid(5, 80.0, -20.0), MakeFlatMembrane());
  filter->Update();
  for (int i = 0; i < 20; ++i)
  {
    filter->SetInputData(0, MakeGrid(5, 80.0, -21.0 - i)); // deletes the previous one
    filter->Update();
  }
  EXPECT_EQ(Read(filter), (Counters{ 1, 1, 21 * 25 }));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 25);
}

//------------------------------------------------------------------------------
TEST(RefractedGeometryPipeline, ProgressRisesToTheEndAndAbortLeavesNothing)
{
  const auto filter = MakeFilter(MakeGrid(400, 150.0, -60.0), MakeFlatMembrane());
  vtkNew<ProgressWatch> aborting;
  aborting->Aborts = true;
  const auto observer = filter->AddObserver(vtkCommand::ProgressEvent, aborting);
  filter->Update();
  EXPECT_LT(aborting->Calls, 5);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetNumberOfSolvedVertices(), 0);
  filter->RemoveObserver(observer);
  vtkNew<ProgressWatch> watch;
  filter->AddObserver(vtkCommand::ProgressEvent, watch);
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 160000);
  EXPECT_GE(watch->Calls, 4);
  EXPECT_FALSE(watch->Falls);
  EXPECT_EQ(watch->Last, 1.0);
}

//------------------------------------------------------------------------------
// A producer that records the piece that is requested.
class PieceRecorder : public vtkTrivialProducer
{
public:
  static PieceRecorder* New();
  vtkTypeMacro(PieceRecorder, vtkTrivialProducer);
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation* info = outputs->GetInformationObject(0);
    if (request->Has(Pipeline::REQUEST_UPDATE_EXTENT()))
    {
      this->Piece = info->Get(Pipeline::UPDATE_PIECE_NUMBER());
      this->Pieces = info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
    }
    return this->Superclass::ProcessRequest(request, inputs, outputs);
  }
  int Piece = -1;
  int Pieces = -1;
};
vtkStandardNewMacro(PieceRecorder);

TEST(RefractedGeometryPipeline, MembraneIsAskedForWhole)
{
  vtkNew<PieceRecorder> geometry;
  vtkNew<PieceRecorder> membrane;
  geometry->SetOutput(MakeGrid(5, 80.0, -20.0));
  membrane->SetOutput(MakeFlatMembrane());
  vtkNew<vtkRefractedGeometryFilter> filter;
  filter->SetMembraneModelToFlatFacets();
  filter->SetImagesToFirstImage();
  filter->SetEyePosition(20.0, 300.0, 10.0);
  filter->SetInputConnection(0, geometry->GetOutputPort());
  filter->SetMembraneConnection(membrane->GetOutputPort());
  filter->UpdatePiece(1, 3, 0);
  EXPECT_EQ(geometry->Piece, 1);
  EXPECT_EQ(geometry->Pieces, 3);
  EXPECT_EQ(membrane->Piece, 0);
  EXPECT_EQ(membrane->Pieces, 1);
}

}

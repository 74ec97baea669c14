// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Filters with the same membrane and eye prepare it once, and have the results of filters that do
// not share it.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

namespace
{

using namespace meniscus::test;

/** Waves whose heights, but not their triangles, depend on `amplitude`. */
vtkSmartPointer<vtkPolyData> MakeWater(double amplitude)
{
  meniscus::reference::HeightField field;
  field.Shape = meniscus::reference::HeightField::Shape::Waves;
  field.Side = 200.0;
  field.Amplitude = amplitude;
  field.K = 0.05;
  return MakeMembrane(field.MakeMesh(12));
}

vtkSmartPointer<vtkPolyData> Copy(vtkPolyData* data)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(data);
  return copy;
}

/** Numbers of shapes and of eyes that filters have computed. */
using Work = std::pair<vtkTypeInt64, vtkTypeInt64>;

Work GetWork(vtkRefractedGeometryFilter* filter)
{
  return { filter->GetNumberOfPatchBuilds(), filter->GetNumberOfEyeUpdates() };
}

/** Two filters with objects of their own and one membrane. */
class SharedMembrane : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->First = this->Make(-50.0);
    this->Second = this->Make(-80.0);
  }

  vtkSmartPointer<vtkRefractedGeometryFilter> Make(double height) const
  {
    auto filter = MakeFilter(MakeGrid(5, 60.0, height), this->Water);
    filter->SetMembraneModelToCurved();
    filter->SetImagesToAllImages();
    return filter;
  }

  Work GetSum() const
  {
    const Work first = GetWork(this->First);
    const Work second = GetWork(this->Second);
    return { first.first + second.first, first.second + second.second };
  }

  /** Compares both with filters that have a membrane of their own. */
  void ExpectRight(vtkRefractedGeometryFilter* filter) const
  {
    vtkNew<vtkRefractedGeometryFilter> alone;
    alone->SetInputData(0, filter->GetInputDataObject(0, 0));
    alone->SetMembraneData(Copy(vtkPolyData::SafeDownCast(filter->GetInputDataObject(1, 0))));
    alone->SetEyePosition(filter->GetEyePosition());
    alone->SetInteriorIndexOfRefraction(filter->GetInteriorIndexOfRefraction());
    alone->SetMode(filter->GetMode());
    alone->Update();
    vtkPolyData* expected = alone->GetOutput();
    vtkPolyData* found = filter->GetOutput();
    ASSERT_GT(expected->GetNumberOfPoints(), 0);
    ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints());
    ASSERT_EQ(found->GetNumberOfCells(), expected->GetNumberOfCells());
    double largest = 0.0;
    for (vtkIdType i = 0; i < found->GetNumberOfPoints(); ++i)
    {
      const glm::dvec3 a = PointOf(found, i);
      const glm::dvec3 b = PointOf(expected, i);
      for (int k = 0; k < 3; ++k)
      {
        largest = std::max(largest, std::fabs(a[k] - b[k]));
      }
    }
    // Newton's method starts elsewhere if the tree over the facets has another shape: a few
    // roundings of coordinates up to 300.
    EXPECT_LT(largest, 1e-10);
  }

  void Update()
  {
    this->First->Update();
    this->Second->Update();
    this->ExpectRight(this->First);
    this->ExpectRight(this->Second);
  }

  vtkSmartPointer<vtkPolyData> Water = MakeWater(2.0);
  vtkSmartPointer<vtkRefractedGeometryFilter> First;
  vtkSmartPointer<vtkRefractedGeometryFilter> Second;
};

//------------------------------------------------------------------------------
TEST_F(SharedMembrane, ListsOfInterfacesAreShared)
{
  const auto below = MakeFlatMembrane();
  MapPoints(below, [](const glm::dvec3& p) { return p - glm::dvec3(0.0, 10.0, 0.0); });
  const auto alone = this->Make(-50.0);
  alone->SetMembraneData(Copy(this->Water));
  for (vtkRefractedGeometryFilter* filter : { this->First.Get(), this->Second.Get(), alone.Get() })
  {
    filter->AddMembraneData(filter == alone ? Copy(below) : below);
    filter->GetInterfaces()->GetFirstInterface()->SetInteriorIndexOfRefraction(1.5);
    filter->GetInterfaces()->AddInterface(1.5, 1.333);
    filter->SetInputData(0, this->First->GetInputDataObject(0, 0));
    filter->SetImagesToFirstImage();
    filter->Update();
  }
  EXPECT_EQ(GetWork(this->First), Work(2, 1));
  EXPECT_EQ(GetWork(this->Second), Work(0, 0));
  EXPECT_EQ(GetWork(alone), Work(2, 1));
  vtkPolyData* found = this->Second->GetOutput();
  ASSERT_EQ(found->GetNumberOfPoints(), 25);
  for (vtkIdType i = 0; i < 25; ++i)
  {
    const glm::dvec3 expected = PointOf(alone->GetOutput(), i);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(found->GetPoint(i)[k], expected[k]);
    }
  }
}

TEST_F(SharedMembrane, IsPreparedOnce)
{
  this->Update();
  EXPECT_EQ(GetWork(this->First), (Work{ 1, 1 }));
  EXPECT_EQ(GetWork(this->Second), (Work{ 0, 0 }));
}

TEST_F(SharedMembrane, IsPreparedOncePerFrame)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(20.0, 300.0, 10.0);
  this->First->SetCamera(camera);
  this->Second->SetCamera(camera);
  this->First->Update();
  this->Second->Update();
  for (int frame = 1; frame < 4; ++frame)
  {
    const auto waves = MakeWater(2.0 + 0.5 * frame);
    this->Water->SetPoints(waves->GetPoints());
    this->Water->GetPointData()->SetNormals(waves->GetPointData()->GetNormals());
    // Whichever comes first.
    (frame % 2 ? this->Second : this->First)->Update();
    (frame % 2 ? this->First : this->Second)->Update();
    EXPECT_EQ(this->GetSum(), (Work{ 1 + frame, 1 + frame }));
  }
  camera->SetPosition(0.0, 280.0, 0.0);
  this->First->SetEyePosition(0.0, 280.0, 0.0); // for ExpectRight
  this->Second->SetEyePosition(0.0, 280.0, 0.0);
  this->Update();
  EXPECT_EQ(this->GetSum(), (Work{ 4, 5 }));
}

TEST_F(SharedMembrane, ForgetsNothingIfItIsTouched)
{
  this->Update();
  this->Water->Modified();
  this->Update();
  EXPECT_EQ(this->GetSum(), (Work{ 1, 1 }));
}

//------------------------------------------------------------------------------
// One filter gets an eye, an index or a mode of its own; the other one runs again unchanged.
TEST_F(SharedMembrane, IsSplitByDifferentViews)
{
  this->Update();
  const auto change = [this](int i)
  {
    switch (i)
    {
      case 0:
        this->First->SetEyePosition(0.0, 250.0, 0.0);
        return Work{ 2, 3 }; // the second one prepares the shape and its rays for itself
      case 1:
        this->First->SetInteriorIndexOfRefraction(1.5);
        return Work{ 2, 4 };
      case 2:
        this->Second->SetEyePosition(0.0, 250.0, 0.0);
        return Work{ 2, 5 };
      default:
        this->Second->SetInteriorIndexOfRefraction(1.5); // both have the same values again
        return Work{ 2, 5 };
    }
  };
  for (int i = 0; i < 4; ++i)
  {
    const Work expected = change(i);
    this->First->Modified();
    this->Second->Modified();
    this->Update();
    EXPECT_EQ(this->GetSum(), expected) << i;
    // Nothing is prepared again while both run in turns.
    for (int again = 0; again < 3; ++again)
    {
      this->First->Modified();
      this->Second->Modified();
      this->Update();
    }
    EXPECT_EQ(this->GetSum(), expected) << i;
  }
}

TEST_F(SharedMembrane, IsKeptByTheOtherFilter)
{
  this->Update();
  const vtkSmartPointer<vtkPolyData> other = MakeWater(4.0);
  this->First->SetMembraneData(other);
  this->Second->Modified();
  this->Update();
  EXPECT_EQ(GetWork(this->First), (Work{ 2, 2 }));
  EXPECT_EQ(GetWork(this->Second), (Work{ 0, 0 }));
}

//------------------------------------------------------------------------------
TEST_F(SharedMembrane, OutlivesTheFilterThatPreparedIt)
{
  this->Update();
  this->First = nullptr;
  this->Second->Modified();
  this->Second->Update();
  this->ExpectRight(this->Second);
  EXPECT_EQ(GetWork(this->Second), (Work{ 0, 0 }));
  // A new filter takes it over.
  this->First = this->Make(-50.0);
  this->Update();
  EXPECT_EQ(this->GetSum(), (Work{ 0, 0 }));
}

TEST_F(SharedMembrane, IsDeletedWithItsLastFilter)
{
  this->Update();
  this->First = nullptr;
  this->Second = nullptr;
  this->SetUp();
  this->Update();
  EXPECT_EQ(this->GetSum(), (Work{ 1, 1 }));
}

TEST_F(SharedMembrane, IsNotFoundByANewObject)
{
  for (int i = 0; i < 20; ++i)
  {
    // The allocator may return the address of the deleted object.
    this->First->SetMembraneData(nullptr);
    this->Second->SetMembraneData(nullptr);
    this->Water = nullptr;
    this->Water = MakeWater(1.0 + 0.1 * i);
    this->First->SetMembraneData(this->Water);
    this->Second->SetMembraneData(this->Water);
    this->Update();
  }
}

//------------------------------------------------------------------------------
// A filter that runs while the other one does must not touch its membrane.
TEST_F(SharedMembrane, IsNotUsedByTwoFiltersAtOnce)
{
  this->Update();
  vtkNew<vtkCallbackCommand> callback;
  callback->SetClientData(this->Second);
  callback->SetCallback(
    [](vtkObject* running, unsigned long, void* data, void*)
    {
      if (!(static_cast<vtkAlgorithm*>(running)->GetProgress() > 0.0))
      {
        return; // it has not begun to work
      }
      auto* other = static_cast<vtkRefractedGeometryFilter*>(data);
      other->SetEyePosition(0.0, 250.0, 0.0);
      other->Update();
    });
  this->First->AddObserver(vtkCommand::ProgressEvent, callback);
  this->First->SetEyePosition(5.0, 300.0, 0.0);
  this->First->Update();
  this->ExpectRight(this->First);
  this->ExpectRight(this->Second);
  EXPECT_EQ(GetWork(this->Second), (Work{ 1, 1 }));
}

TEST_F(SharedMembrane, MessagesComeFromEachFilter)
{
  this->Water->GetPointData()->GetNormals()->Resize(3); // too few of them
  for (const auto& filter : { this->First, this->Second })
  {
    const auto messages = UpdateAndObserve(filter);
    EXPECT_GE(messages->Warnings + messages->Errors, 1);
  }
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The list of refracting interfaces, and filters that share it.
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkRefractionErrorVolume.h"

namespace
{

using namespace meniscus::test;

// Depth of a virtual point at vertical sight, Eq. 2.4: the true depth times n1 / n2.
double DepthBelowTheEye(vtkRefractedGeometryFilter* filter)
{
  filter->Update();
  return -filter->GetOutput()->GetPoint(0)[1];
}

}

TEST(RefractingInterface, ListIsNeverWithoutAnInterface)
{
  vtkNew<vtkRefractingInterfaceCollection> list;
  EXPECT_EQ(list->GetNumberOfItems(), 0);
  ASSERT_NE(list->GetFirstInterface(), nullptr);
  EXPECT_EQ(list->GetNumberOfItems(), 1);
  EXPECT_EQ(list->GetFirstInterface(), list->GetInterface(0));
  EXPECT_EQ(list->GetInterface(1), nullptr);
  EXPECT_EQ(list->GetFirstInterface()->GetExteriorIndexOfRefraction(), 1.0);
  EXPECT_EQ(list->GetFirstInterface()->GetInteriorIndexOfRefraction(), 1.333);
}

TEST(RefractingInterface, ListsGrowByTheIndicesOfAnInterface)
{
  vtkNew<vtkRefractingInterfaceCollection> list;
  const vtkMTimeType before = list->GetMTime();
  vtkRefractingInterface* first = list->AddInterface(1.0, 1.5);
  vtkRefractingInterface* second = list->AddInterface(1.5, 1.333);
  EXPECT_EQ(second, list->GetInterface(1));
  EXPECT_GT(list->GetMTime(), before);
  EXPECT_EQ(list->GetNumberOfItems(), 2);
  EXPECT_EQ(first, list->GetFirstInterface());
  EXPECT_EQ(first->GetExteriorIndexOfRefraction(), 1.0);
  EXPECT_EQ(first->GetInteriorIndexOfRefraction(), 1.5);
  EXPECT_EQ(second->GetInteriorIndexOfRefraction(), 1.333);
  // The interface is the only owner of its indices: later changes are those of the list.
  first->SetInteriorIndexOfRefraction(1.6);
  EXPECT_EQ(list->GetInterface(0)->GetInteriorIndexOfRefraction(), 1.6);
}

TEST(RefractingInterface, PropertiesOfAFilterAreThoseOfItsFirstInterface)
{
  vtkNew<vtkRefractedGeometryFilter> filter;
  vtkRefractingInterface* first = filter->GetInterfaces()->GetFirstInterface();
  filter->SetInteriorIndexOfRefraction(1.5);
  EXPECT_EQ(first->GetInteriorIndexOfRefraction(), 1.5);
  first->SetExteriorIndexOfRefraction(1.2);
  EXPECT_EQ(filter->GetExteriorIndexOfRefraction(), 1.2);
  vtkNew<vtkPlane> plane;
  filter->SetExactMembrane(plane);
  EXPECT_EQ(first->GetExactSurface(), plane.Get());
  filter->SetInterfaces(nullptr);
  EXPECT_EQ(filter->GetInteriorIndexOfRefraction(), 1.333);
  EXPECT_EQ(filter->GetExactMembrane(), nullptr);
}

TEST(RefractingInterface, ChangesReachEveryOwner)
{
  vtkNew<vtkRefractingInterfaceCollection> list;
  const auto geometry = MakeFilter(MakePoints({ { 20.0, -4.0, 10.0 } }), MakeFlatMembrane());
  geometry->SetMembraneModelToCurved(); // exact for a plane
  geometry->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  geometry->SetInterfaces(list);
  vtkNew<vtkRefractedLightFilter> light;
  light->SetInterfaces(list);
  vtkNew<vtkRefractionErrorVolume> volume;
  volume->SetInterfaces(list);
  for (const double index : { 1.25, 2.0 })
  {
    const vtkMTimeType before = light->GetMTime();
    list->GetFirstInterface()->SetInteriorIndexOfRefraction(index);
    EXPECT_GT(light->GetMTime(), before);
    EXPECT_EQ(light->GetInteriorIndexOfRefraction(), index);
    EXPECT_EQ(volume->GetInteriorIndexOfRefraction(), index);
    // A point straight below the eye; rounding of a sum and a quotient of numbers up to 300.
    EXPECT_NEAR(DepthBelowTheEye(geometry), 4.0 / index, 1e-9);
  }
  vtkNew<vtkPlane> plane;
  const vtkMTimeType before = volume->GetMTime();
  list->GetFirstInterface()->SetExactSurface(plane);
  plane->SetOrigin(0.0, 1.0, 0.0);
  EXPECT_GT(volume->GetMTime(), before);
}

TEST(RefractingInterface, MoreThanItsSurfacesIsAnErrorAndTheOutputIsEmpty)
{
  const auto filter = MakeFilter(MakeGrid(3, 10.0, -5.0), MakeFlatMembrane());
  vtkNew<vtkRefractingInterface> second;
  filter->GetInterfaces()->GetFirstInterface();
  filter->GetInterfaces()->AddItem(second);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 1) << messages->Text;
  EXPECT_TRUE(HasText(messages->Text, "2 refracting interfaces, and port 1 has 1 surfaces"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  filter->GetInterfaces()->RemoveItem(second);
  filter->Update();
  EXPECT_EQ(messages->Errors, 1);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 9);
}

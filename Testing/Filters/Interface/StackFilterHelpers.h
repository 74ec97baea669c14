// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Lists of interfaces for every filter that has one. */
#pragma once

#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

namespace meniscus::test
{

/** Moves a surface along y. */
inline vtkSmartPointer<vtkPolyData> MoveBy(vtkSmartPointer<vtkPolyData> surface, double y)
{
  vtkNew<vtkPoints> points;
  points->DeepCopy(surface->GetPoints());
  surface->SetPoints(points);
  MapPoints(surface, [y](const glm::dvec3& p) { return glm::dvec3(p.x, p.y + y, p.z); });
  return surface;
}

/** The flat membrane of side 200, moved to height y. */
inline vtkSmartPointer<vtkPolyData> MakePlaneAt(double y)
{
  return MoveBy(MakeFlatMembrane(), y);
}

/** Adds an interface and its surface. */
template <typename Filter>
void AddInterface(const Filter& filter, vtkPolyData* surface, double exterior, double interior)
{
  vtkNew<vtkRefractingInterface> interface;
  interface->SetExteriorIndexOfRefraction(exterior);
  interface->SetInteriorIndexOfRefraction(interior);
  filter->GetInterfaces()->AddItem(interface);
  filter->AddMembraneData(surface);
}

/**
 * Lists that are an error of every filter. `make` makes a filter without interfaces, and `measure`
 * is 0 for its output if that is empty.
 */
template <typename Make, typename Measure>
void ExpectBadLists(const Make& make, const Measure& measure)
{
  const auto expectError = [&measure](auto filter, const std::string& text)
  {
    const auto messages = UpdateAndObserve(filter);
    EXPECT_TRUE(HasText(messages->Text, text));
    EXPECT_TRUE(HasText(messages->Text, "the output is empty"));
    EXPECT_EQ(measure(filter.Get()), 0) << text;
  };
  const auto makePane = [&make](double before, double glass, double again, double behind)
  {
    auto filter = make();
    AddInterface(filter, MakePlaneAt(0.0), before, glass);
    AddInterface(filter, MakePlaneAt(-10.0), again, behind);
    return filter;
  };
  {
    // A list that can be used gives an output, so that the cases below fail for their own reasons.
    const auto filter = makePane(1.0, 1.5, 1.5, 1.333);
    filter->Update();
    EXPECT_GT(measure(filter.Get()), 0);
  }
  auto filter = makePane(1.0, 1.5, 1.5, 1.333);
  filter->AddMembraneData(MakePlaneAt(-20.0));
  expectError(filter, "The list has 2 refracting interfaces, and port");
  filter = makePane(1.0, 1.5, 1.5, 1.333);
  filter->GetInterfaces()->RemoveItem(1);
  expectError(filter, "has 2 surfaces; one for each is needed");
  expectError(makePane(1.0, 1.5, 1.4, 1.333), "do not match along the list");
  for (const double bad : { std::nan(""), -1.333, 0.0, std::numeric_limits<double>::infinity() })
  {
    expectError(
      makePane(1.0, 1.5, 1.5, bad), "Interface 1: Indices of refraction must be positive");
    expectError(
      makePane(bad, 1.5, 1.5, 1.0), "Interface 0: Indices of refraction must be positive");
  }
  filter = make();
  AddInterface(filter, MakePlaneAt(0.0), 1.0, 1.5);
  AddInterface(filter, vtkNew<vtkPolyData>(), 1.5, 1.333);
  expectError(filter, "Interface 1: The membrane has no usable triangle");
}

}

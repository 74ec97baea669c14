// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells of membranes: their corners on exact rays through planes and spheres, and facets that are
// left out.
#include "ExactStack.h"
#include "StackFilterHelpers.h"

#include "vtkMembraneCellFilter.h"

namespace
{

using namespace meniscus::test;
namespace reference = meniscus::reference;

const glm::dvec3 Eye(20.0, 300.0, 10.0);
const glm::dvec3 Up(0.0, 1.0, 0.0);
constexpr double Length = 80.0;

double ValueOf(vtkDataSetAttributes* data, const char* name, vtkIdType i)
{
  return data->GetArray(name)->GetTuple1(i);
}

/** Corner i of a cell; the first three are on the eye's side. */
vtkIdType CornerOf(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdType i)
{
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  return ids->GetId(i);
}

vtkSmartPointer<vtkMembraneCellFilter> MakeFilter(
  vtkPolyData* membrane, const glm::dvec3& eye, double exterior, double interior)
{
  auto filter = vtkSmartPointer<vtkMembraneCellFilter>::New();
  filter->AddMembraneData(membrane);
  filter->SetEyePosition(eye.x, eye.y, eye.z);
  filter->SetExteriorIndexOfRefraction(exterior);
  filter->SetInteriorIndexOfRefraction(interior);
  filter->SetCellLength(Length);
  return filter;
}

/**
 * Compares every cell with the exact rays through the corners of its facet, which a wedge has in
 * reverse order if its rays go the way of the facet's normal (`fromBehind`). Positions are sums of
 * a few products of coordinates of up to 500, whose rounding is 1e-13 each.
 */
void ExpectExactCells(vtkMembraneCellFilter* filter, vtkPolyData* first,
  const std::vector<reference::ExactSurface>& surfaces, const glm::dvec3& eye,
  bool fromBehind = false)
{
  constexpr double rounding = 1e-11;
  filter->Update();
  vtkUnstructuredGrid* grid = filter->GetOutput();
  const auto legs = static_cast<int>(surfaces.size());
  ASSERT_EQ(grid->GetNumberOfCells(), legs * first->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    ASSERT_EQ(grid->GetCellType(cell), VTK_WEDGE);
    const auto leg = static_cast<std::size_t>(ValueOf(grid->GetCellData(), "Leg", cell));
    EXPECT_EQ(ValueOf(grid->GetCellData(), "IndexOfRefraction", cell), surfaces[leg - 1].Behind);
    vtkNew<vtkIdList> corners;
    first->GetCellPoints(
      static_cast<vtkIdType>(ValueOf(grid->GetCellData(), "FacetId", cell)), corners);
    for (vtkIdType i = 0; i < 3; ++i)
    {
      const glm::dvec3 corner = PointOf(first, corners->GetId(fromBehind ? 2 - i : i));
      auto path = reference::TraceExactly(surfaces, eye, glm::normalize(corner - eye));
      ASSERT_TRUE(path);
      path->Points.push_back(path->Points.back() + Length * path->Directions.back());
      double optical = surfaces[0].Before * glm::length(path->Points[0] - eye);
      for (std::size_t k = 1; k <= leg; ++k)
      {
        optical += surfaces[k - 1].Behind * glm::length(path->Points[k] - path->Points[k - 1]);
      }
      EXPECT_LT(
        glm::length(PointOf(grid, CornerOf(grid, cell, i)) - path->Points[leg - 1]), rounding);
      const vtkIdType far = CornerOf(grid, cell, i + 3);
      EXPECT_LT(glm::length(PointOf(grid, far) - path->Points[leg]), rounding);
      EXPECT_NEAR(ValueOf(grid->GetPointData(), "OpticalPath", far), optical, rounding);
    }
    EXPECT_EQ(ValueOf(grid->GetCellData(), "Orientation", cell), 1.0);
    // VTK's order of a wedge: the normal of the first triangle points out of the cell.
    const glm::dvec3 near = PointOf(grid, CornerOf(grid, cell, 0));
    const glm::dvec3 normal = glm::cross(
      PointOf(grid, CornerOf(grid, cell, 1)) - near, PointOf(grid, CornerOf(grid, cell, 2)) - near);
    EXPECT_LT(glm::dot(normal, PointOf(grid, CornerOf(grid, cell, 3)) - near), 0.0);
  }
  EXPECT_EQ(filter->GetNumberOfBackFacingFacets() + filter->GetNumberOfTotallyReflectedFacets() +
      filter->GetNumberOfMissedFacets(),
    0);
}

//------------------------------------------------------------------------------
TEST(MembraneCells, PlaneAndSphere)
{
  const auto plane = MakeFlatMembrane();
  const auto flat = MakeFilter(plane, Eye, 1.0, 1.333);
  ExpectExactCells(flat, plane, { { 1.0, 1.333, glm::dvec3(0.0), 0.0, Up } }, Eye);
  // Rays share their points.
  EXPECT_EQ(flat->GetOutput()->GetNumberOfPoints(), 2 * plane->GetNumberOfPoints());

  const auto bowl = MakeMembrane(reference::MakeDisc(100.0, 4, 250.0));
  const glm::dvec3 above(10.0, 450.0, -5.0);
  const auto curved = MakeFilter(bowl, above, 1.0, 1.51);
  ExpectExactCells(curved, bowl,
    { { 1.0, 1.51, glm::dvec3(0.0, 250.0, 0.0), 250.0, glm::dvec3(0.0), true } }, above);
}

//------------------------------------------------------------------------------
// The side of a surface that the eye is on follows from its normals.
TEST(MembraneCells, FromBehind)
{
  const auto plane = MakeFlatMembrane();
  const glm::dvec3 below(20.0, -300.0, 10.0);
  const auto filter = MakeFilter(plane, below, 1.333, 1.0);
  ExpectExactCells(filter, plane, { { 1.0, 1.333, glm::dvec3(0.0), 0.0, -Up } }, below, true);
}

//------------------------------------------------------------------------------
TEST(MembraneCells, Pane)
{
  const auto front = MakeMembrane(reference::MakePlane(0.0, 100.0, 6));
  const auto filter = MakeFilter(front, Eye, 1.0, 1.5);
  filter->RemoveAllMembranes();
  filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  AddInterface(filter, front, 1.0, 1.5);
  AddInterface(filter, MakePlaneAt(-10.0), 1.5, 1.333);
  ExpectExactCells(filter, front,
    { { 1.0, 1.5, glm::dvec3(0.0), 0.0, Up },
      { 1.5, 1.333, glm::dvec3(0.0, -10.0, 0.0), 0.0, Up } },
    Eye);
}

//------------------------------------------------------------------------------
// From glass into air through a sphere of radius 300, concave to an eye 3000 away: the image is
// 1 / (0.5 / 300 - 1.5 / 3000) = 857 behind it on the axis, and nearer elsewhere.
TEST(MembraneCells, FocusTurnsCellsOver)
{
  const auto bowl = MakeMembrane(reference::MakeDisc(60.0, 3, 300.0));
  const auto filter = MakeFilter(bowl, glm::dvec3(0.0, 3000.0, 0.0), 1.5, 1.0);
  for (const double length : { 300.0, 2000.0 })
  {
    filter->SetCellLength(length);
    filter->Update();
    vtkUnstructuredGrid* grid = filter->GetOutput();
    ASSERT_EQ(grid->GetNumberOfCells(), bowl->GetNumberOfCells());
    // All rays through a point of the axis cross near it: the far side is turned by 180 degrees
    // about the axis, which mirrors nothing.
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      EXPECT_EQ(ValueOf(grid->GetCellData(), "Orientation", cell), 1.0);
    }
    const glm::dvec3 rim = PointOf(grid, CornerOf(grid, grid->GetNumberOfCells() - 1, 1));
    const glm::dvec3 far = PointOf(grid, CornerOf(grid, grid->GetNumberOfCells() - 1, 4));
    EXPECT_EQ(rim.x * far.x + rim.z * far.z > 0.0, length < 500.0);
  }
}

//------------------------------------------------------------------------------
// A cylindrical lens focuses in one direction, and so mirrors.
TEST(MembraneCells, CylindersMirror)
{
  const auto gutter = MakeMembrane(reference::MakePlane(0.0, 100.0, 6));
  vtkDataArray* normals = gutter->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < gutter->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 p = PointOf(gutter, i);
    const double y = 300.0 - std::sqrt(300.0 * 300.0 - p.x * p.x);
    gutter->GetPoints()->SetPoint(i, p.x, y, p.z);
    normals->SetTuple3(i, -p.x / 300.0, (300.0 - y) / 300.0, 0.0);
  }
  const auto filter = MakeFilter(gutter, glm::dvec3(0.0, 3000.0, 0.0), 1.5, 1.0);
  for (const double length : { 300.0, 2000.0 })
  {
    filter->SetCellLength(length);
    filter->Update();
    vtkUnstructuredGrid* grid = filter->GetOutput();
    ASSERT_EQ(grid->GetNumberOfCells(), gutter->GetNumberOfCells());
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      EXPECT_EQ(ValueOf(grid->GetCellData(), "Orientation", cell), length < 500.0 ? 1.0 : -1.0);
    }
  }
}

//------------------------------------------------------------------------------
TEST(MembraneCells, FacetsThatAreLeftOutAreCounted)
{
  // From glass into air: beyond the critical angle, sin a > 1 / 1.5.
  const glm::dvec3 low(0.0, 50.0, 0.0);
  const auto plane = MakeFlatMembrane();
  const auto flat = MakeFilter(plane, low, 1.5, 1.0);
  flat->Update();
  vtkIdType reflected = 0;
  for (vtkIdType cell = 0; cell < plane->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    plane->GetCellPoints(cell, ids);
    bool all = true;
    for (vtkIdType i = 0; i < 3; ++i)
    {
      const glm::dvec3 p = PointOf(plane, ids->GetId(i)) - low;
      all = all && std::hypot(p.x, p.z) < glm::length(p) / 1.5;
    }
    reflected += !all;
  }
  EXPECT_GT(reflected, 0);
  EXPECT_EQ(flat->GetNumberOfTotallyReflectedFacets(), reflected);
  EXPECT_EQ(flat->GetOutput()->GetNumberOfCells(), plane->GetNumberOfCells() - reflected);

  // A ball from outside: a vertex p of the unit ball faces the eye if dot(p, eye) > 1.
  const auto ball = MakeMembrane(reference::MakeSphere(glm::dvec3(0.0), 1.0, 3, true));
  const glm::dvec3 eye(0.3, 2.0, 0.1);
  const auto closed = MakeFilter(ball, eye, 1.0, 1.5);
  closed->Update();
  vtkIdType behind = 0;
  for (vtkIdType cell = 0; cell < ball->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    ball->GetCellPoints(cell, ids);
    bool all = true;
    for (vtkIdType i = 0; i < 3; ++i)
    {
      all = all && glm::dot(PointOf(ball, ids->GetId(i)), eye) > 1.0;
    }
    behind += !all;
  }
  EXPECT_EQ(closed->GetNumberOfBackFacingFacets(), behind);
  EXPECT_EQ(closed->GetOutput()->GetNumberOfCells(), ball->GetNumberOfCells() - behind);

  // A pane whose far side is small, and one of all sizes.
  const auto pane = MakeFilter(plane, Eye, 1.0, 1.5);
  pane->RemoveAllMembranes();
  pane->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
  AddInterface(pane, plane, 1.0, 1.5);
  AddInterface(pane, MakeMembrane(reference::MakePlane(-10.0, 60.0, 4)), 1.5, 1.333);
  pane->Update();
  const vtkIdType missed = pane->GetNumberOfMissedFacets();
  EXPECT_GT(missed, 0);
  EXPECT_EQ(pane->GetOutput()->GetNumberOfCells(), 2 * (plane->GetNumberOfCells() - missed));
}

//------------------------------------------------------------------------------
TEST(MembraneCells, BadInputIsAnError)
{
  const auto plane = MakeFlatMembrane();
  const auto expectError =
    [&plane](const std::function<void(vtkMembraneCellFilter*)>& spoil, const std::string& text)
  {
    const auto filter = MakeFilter(plane, Eye, 1.0, 1.333);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), plane->GetNumberOfCells());
    const auto messages = Observe(filter);
    spoil(filter);
    filter->Update();
    EXPECT_TRUE(HasText(messages->Text, text));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectError([](auto* f) { f->SetCellLength(0.0); }, "CellLength must be positive");
  expectError([nan](auto* f) { f->SetCellLength(nan); }, "CellLength must be positive");
  expectError([](auto* f) { f->SetInteriorIndexOfRefraction(1.0); }, "No interface");
  expectError([](auto* f) { f->SetInteriorIndexOfRefraction(-1.0); }, "Indices");
  expectError([nan](auto* f) { f->SetEyePosition(0.0, nan, 0.0); }, "eye");
}

//------------------------------------------------------------------------------
TEST(MembraneCells, BadLists)
{
  ExpectBadLists(
    []
    {
      auto filter = vtkSmartPointer<vtkMembraneCellFilter>::New();
      filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
      filter->SetEyePosition(Eye.x, Eye.y, Eye.z);
      return filter;
    },
    [](vtkMembraneCellFilter* filter) { return filter->GetOutput()->GetNumberOfCells(); });
}

}

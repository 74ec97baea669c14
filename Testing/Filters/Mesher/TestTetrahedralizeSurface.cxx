// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/ClosedSurfaces.h"
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkImplicitPolyDataDistance.h"
#include "vtkTetra.h"
#include "vtkTetrahedralizeSurface.h"

using namespace meniscus::test;

namespace
{

/** TetGen's tolerance for points on a plane, relative to the size of the surface. */
constexpr double Coplanar = 1e-8;

/** Figures of a mesh, from its output alone. */
struct MeshFigures
{
  double Volume = 0.0;
  double SmallestVolume = 1e300;
  double LargestVolume = 0.0;
  double LargestRatio = 0.0;
  std::vector<double> Ratios; ///< radius to shortest edge of each cell
  std::set<std::array<vtkIdType, 3>> Boundary;

  vtkIdType CountAbove(double bound) const
  {
    return std::count_if(
      this->Ratios.begin(), this->Ratios.end(), [bound](double ratio) { return ratio > bound; });
  }
};

MeshFigures Measure(vtkUnstructuredGrid* grid)
{
  MeshFigures figures;
  std::map<std::array<vtkIdType, 3>, int> faces;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    EXPECT_EQ(grid->GetCellType(c), VTK_TETRA);
    grid->GetCellPoints(c, ids);
    double corner[4][3];
    for (int i = 0; i < 4; ++i)
    {
      grid->GetPoint(ids->GetId(i), corner[i]);
      std::array<vtkIdType, 3> face{ ids->GetId((i + 1) % 4), ids->GetId((i + 2) % 4),
        ids->GetId((i + 3) % 4) };
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
    const double volume = vtkTetra::ComputeVolume(corner[0], corner[1], corner[2], corner[3]);
    figures.Volume += volume;
    figures.SmallestVolume = std::min(figures.SmallestVolume, volume);
    figures.LargestVolume = std::max(figures.LargestVolume, volume);
    double center[3];
    const double radius2 =
      vtkTetra::Circumsphere(corner[0], corner[1], corner[2], corner[3], center);
    double shortest2 = 1e300;
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        shortest2 = std::min(shortest2, vtkMath::Distance2BetweenPoints(corner[i], corner[j]));
      }
    }
    figures.Ratios.push_back(std::sqrt(radius2 / shortest2));
    figures.LargestRatio = std::max(figures.LargestRatio, figures.Ratios.back());
  }
  for (const auto& face : faces)
  {
    EXPECT_LE(face.second, 2);
    if (face.second == 1)
    {
      figures.Boundary.insert(face.first);
    }
  }
  return figures;
}

/** Sum of the areas of faces. */
double SumAreas(vtkUnstructuredGrid* grid, const std::set<std::array<vtkIdType, 3>>& faces)
{
  double sum = 0.0;
  for (const auto& face : faces)
  {
    double corner[3][3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      grid->GetPoint(face[i], corner[i]);
    }
    sum += vtkTriangle::TriangleArea(corner[0], corner[1], corner[2]);
  }
  return sum;
}

/** Area of a surface of triangles. */
double AreaOf(vtkPolyData* surface)
{
  double sum = 0.0;
  for (vtkIdType c = 0; c < surface->GetNumberOfCells(); ++c)
  {
    sum += static_cast<vtkTriangle*>(surface->GetCell(c))->ComputeArea();
  }
  return sum;
}

vtkSmartPointer<vtkTetrahedralizeSurface> MakeFilter(vtkPolyData* surface, int mesher)
{
  auto filter = vtkSmartPointer<vtkTetrahedralizeSurface>::New();
  filter->SetInputData(surface);
  filter->SetMesher(mesher);
  return filter;
}

/** Runs the filter and returns its messages; the output must be empty. */
std::string FailureOf(vtkTetrahedralizeSurface* filter)
{
  const auto messages = UpdateAndObserve(filter);
  EXPECT_GE(messages->Errors, 1) << messages->Text;
  EXPECT_EQ(messages->Warnings, 0) << messages->Text;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  return messages->Text;
}

::testing::AssertionResult Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos
    ? ::testing::AssertionSuccess()
    : ::testing::AssertionFailure() << '"' << part << "\" is not in: " << text;
}

/** Tests that need TetGen's program. */
class TetGenMeshes : public ::testing::Test
{
protected:
  void SetUp() override
  {
    if (!vtkNew<vtkTetrahedralizeSurface>()->HasTetGen())
    {
      GTEST_SKIP() << "built without MENISCUS_WITH_TETGEN";
    }
  }
};

/** A surface and the volume of its polyhedron in closed form. */
struct KnownSolid
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Surface;
  double Volume;
};

/**
 * Adds point arrays: keys that a double cannot hold, named components, ids, strings, and one array
 * for each kind of value that is not finite.
 */
void AddArrays(vtkPolyData* surface)
{
  vtkNew<vtkIdTypeArray> keys;
  keys->SetName("keys");
  vtkNew<vtkDoubleArray> named;
  named->SetName("named");
  named->SetNumberOfComponents(3);
  vtkNew<vtkStringArray> strings;
  strings->SetName("strings");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  const char* const names[3] = { "east", "north", "up" };
  for (int i = 0; i < 3; ++i)
  {
    named->SetComponentName(i, names[i]);
  }
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    keys->InsertNextValue((vtkIdType(1) << 60) + p);
    named->InsertNextTuple(surface->GetPoint(p));
    strings->InsertNextValue("text");
    ids->InsertNextValue(p);
  }
  surface->GetPointData()->AddArray(keys);
  surface->GetPointData()->SetVectors(named);
  surface->GetPointData()->AddArray(strings);
  surface->GetPointData()->SetGlobalIds(ids);
  for (const double bad : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    const auto array = MakeArray(std::to_string(bad).c_str(), surface->GetNumberOfPoints(), 1.0);
    array->SetValue(3, bad);
    surface->GetPointData()->AddArray(array);
  }
}

/** Checks the arrays of AddArrays at the surface's points. */
void CheckArrays(vtkUnstructuredGrid* grid, vtkPolyData* surface)
{
  vtkPointData* arrays = grid->GetPointData();
  ASSERT_EQ(arrays->GetNumberOfArrays(), 5);
  EXPECT_EQ(arrays->GetArray("ids"), nullptr);
  auto* keys = vtkIdTypeArray::SafeDownCast(arrays->GetArray("keys"));
  vtkDataArray* named = arrays->GetVectors();
  ASSERT_NE(keys, nullptr);
  ASSERT_NE(named, nullptr);
  EXPECT_STREQ(named->GetName(), "named");
  EXPECT_STREQ(named->GetComponentName(1), "north");
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    double expected[3];
    surface->GetPoint(p, expected);
    const vtkIdType at = grid->FindPoint(expected);
    EXPECT_EQ(keys->GetValue(at), (vtkIdType(1) << 60) + p);
    EXPECT_EQ(named->GetComponent(at, 2), expected[2]);
    EXPECT_EQ(arrays->GetArray("inf")->GetComponent(at, 0), p == 3 ? HUGE_VAL : 1.0);
  }
}

/** A geodesic sphere of radius 1, stretched along y and z. */
vtkSmartPointer<vtkPolyData> MakeEllipsoid(int levels, double y, double z)
{
  const auto surface = MakeGeodesicSphere(1.0, levels);
  MapPoints(surface, [y, z](const glm::dvec3& x) { return x * glm::dvec3(1.0, y, z); });
  return surface;
}

std::vector<KnownSolid> KnownSolids()
{
  return { { "box", MakeBox(2.0, 3.0, 5.0), 30.0 },
    { "sphere", MakeGeodesicSphere(1.5, 3), GeodesicSphereVolume(1.5, 3) },
    { "torus", MakeTorus(2.0, 0.5, 40, 16), TorusVolume(2.0, 0.5, 40, 16) } };
}

} // anonymous namespace

//------------------------------------------------------------------------------
TEST_F(TetGenMeshes, FillTheSurface)
{
  for (const KnownSolid& solid : KnownSolids())
  {
    SCOPED_TRACE(solid.Name);
    const auto filter = MakeFilter(solid.Surface, vtkTetrahedralizeSurface::TETGEN);
    ExpectQuiet(filter);
    vtkUnstructuredGrid* grid = filter->GetOutput();
    const MeshFigures figures = Measure(grid);
    ASSERT_GT(grid->GetNumberOfCells(), 0);
    const double size = solid.Surface->GetLength();
    const double area = AreaOf(solid.Surface);
    EXPECT_NEAR(figures.Volume, solid.Volume, area * Coplanar * size);
    EXPECT_GT(figures.SmallestVolume, 0.0);
    EXPECT_NEAR(filter->GetLargestRadiusEdgeRatio(), figures.LargestRatio, 1e-9);
    EXPECT_EQ(filter->GetNumberOfCellsAboveRatio(), figures.CountAbove(2.0));
    EXPECT_LE(figures.CountAbove(2.0), 0.02 * static_cast<double>(figures.Ratios.size()));
    EXPECT_EQ(filter->GetUsedMesher(), vtkTetrahedralizeSurface::TETGEN);
    // The boundary is the surface: its points are on it, and it has its area.
    vtkNew<vtkImplicitPolyDataDistance> distance;
    distance->SetInput(solid.Surface);
    for (const auto& face : figures.Boundary)
    {
      for (const vtkIdType point : face)
      {
        ASSERT_NEAR(distance->EvaluateFunction(grid->GetPoint(point)), 0.0, Coplanar * size);
      }
    }
    EXPECT_NEAR(SumAreas(grid, figures.Boundary), area, area * Coplanar);
  }
}

//------------------------------------------------------------------------------
TEST_F(TetGenMeshes, PreserveTheSurface)
{
  for (const KnownSolid& solid : KnownSolids())
  {
    SCOPED_TRACE(solid.Name);
    const auto filter = MakeFilter(solid.Surface, vtkTetrahedralizeSurface::TETGEN);
    filter->PreserveSurfaceOn();
    filter->Update();
    const MeshFigures figures = Measure(filter->GetOutput());
    EXPECT_NEAR(figures.Volume, solid.Volume, 1e-12 * solid.Volume);
    std::set<std::array<vtkIdType, 3>> triangles;
    for (vtkIdType c = 0; c < solid.Surface->GetNumberOfCells(); ++c)
    {
      vtkIdList* ids = solid.Surface->GetCell(c)->GetPointIds();
      std::array<vtkIdType, 3> face{ ids->GetId(0), ids->GetId(1), ids->GetId(2) };
      std::sort(face.begin(), face.end());
      triangles.insert(face);
    }
    // Points may be numbered otherwise; here all are used, and the surfaces use them in order.
    EXPECT_EQ(figures.Boundary.size(), triangles.size());
    EXPECT_NEAR(SumAreas(filter->GetOutput(), figures.Boundary), AreaOf(solid.Surface),
      1e-12 * AreaOf(solid.Surface));
    for (vtkIdType p = 0; p < solid.Surface->GetNumberOfPoints(); ++p)
    {
      double expected[3];
      solid.Surface->GetPoint(p, expected);
      EXPECT_GE(filter->GetOutput()->FindPoint(expected), 0);
    }
  }
}

//------------------------------------------------------------------------------
TEST_F(TetGenMeshes, KeepTheBoundsOfCells)
{
  const auto sphere = MakeGeodesicSphere(1.0, 3);
  const auto filter = MakeFilter(sphere, vtkTetrahedralizeSurface::TETGEN);
  vtkIdType before = 0;
  for (const double volume : { 0.01, 0.001 })
  {
    filter->SetMaximumVolume(volume);
    filter->SetMaximumRadiusEdgeRatio(1.4);
    filter->Update();
    const MeshFigures figures = Measure(filter->GetOutput());
    EXPECT_LE(figures.LargestVolume, volume * (1.0 + 1e-12));
    EXPECT_LE(figures.CountAbove(1.4), 0.01 * static_cast<double>(figures.Ratios.size()));
    EXPECT_LE(figures.LargestRatio, 2.0);
    EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), before);
    before = filter->GetOutput()->GetNumberOfCells();
  }
}

//------------------------------------------------------------------------------
// Triangles that meet at 15 degrees allow no bound next to them; cells above it are counted.
TEST_F(TetGenMeshes, CountCellsAboveTheBound)
{
  const auto filter = MakeFilter(MakeSphere(1.0, 24, 16), vtkTetrahedralizeSurface::TETGEN);
  filter->Update();
  EXPECT_NEAR(Measure(filter->GetOutput()).Volume, SphereVolume(1.0, 24, 16), 1e-7);
  EXPECT_GT(filter->GetNumberOfCellsAboveRatio(), 0);
  EXPECT_LT(filter->GetNumberOfCellsAboveRatio(), filter->GetOutput()->GetNumberOfCells() / 5);
}

//------------------------------------------------------------------------------
// Triangles at 179.99 degrees are not taken for one plane.
TEST_F(TetGenMeshes, KeepShallowBumps)
{
  const auto filter = MakeFilter(MakeEllipsoid(3, 1.0, 1e-4), vtkTetrahedralizeSurface::TETGEN);
  filter->PreserveSurfaceOn();
  ExpectQuiet(filter);
  const double volume = 1e-4 * GeodesicSphereVolume(1.0, 3);
  EXPECT_NEAR(Measure(filter->GetOutput()).Volume, volume, 1e-9 * volume);
}

//------------------------------------------------------------------------------
// Cavities are wound the other way round; separate bodies are parts of one mesh.
TEST_F(TetGenMeshes, LeaveCavitiesEmpty)
{
  const auto outside = MakeSphere(2.0, 24, 16);
  const auto cavity = Reversed(MakeSphere(1.0, 24, 16));
  const auto apart = Moved(MakeBox(1.0, 1.0, 1.0), { 5.0, 0.0, 0.0 });
  const auto filter =
    MakeFilter(Joined({ outside, cavity, apart }), vtkTetrahedralizeSurface::TETGEN);
  filter->Update();
  const double expected = SphereVolume(2.0, 24, 16) - SphereVolume(1.0, 24, 16) + 1.0;
  EXPECT_NEAR(Measure(filter->GetOutput()).Volume, expected, 1e-6);
}

//------------------------------------------------------------------------------
TEST_F(TetGenMeshes, ContinueArrays)
{
  const auto sphere = MakeSphere(1.0, 24, 16);
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("linear");
  linear->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> labels;
  labels->SetName("labels");
  vtkNew<vtkDoubleArray> holes;
  holes->SetName("holes");
  const auto at = [](const double x[3]) { return 3.0 + 2.0 * x[0] - x[1] + 0.5 * x[2]; };
  for (vtkIdType p = 0; p < sphere->GetNumberOfPoints(); ++p)
  {
    double x[3];
    sphere->GetPoint(p, x);
    linear->InsertNextTuple2(at(x), -at(x));
    labels->InsertNextValue(7);
    holes->InsertNextValue(p == 5 ? std::nan("") : 1.0);
  }
  sphere->GetPointData()->AddArray(linear);
  sphere->GetPointData()->SetScalars(labels);
  const auto filter = MakeFilter(sphere, vtkTetrahedralizeSurface::TETGEN);
  filter->SetMaximumVolume(0.002);
  filter->Update();
  vtkUnstructuredGrid* grid = filter->GetOutput();
  ASSERT_GT(filter->GetNumberOfAddedPoints(), 100);
  vtkDataArray* result = grid->GetPointData()->GetArray("linear");
  ASSERT_NE(result, nullptr);
  EXPECT_STREQ(grid->GetPointData()->GetScalars()->GetName(), "labels");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    // The residual of the iteration is 4e-9 of the right-hand side; the condition number of this
    // mesh is below 100.
    EXPECT_NEAR(result->GetComponent(p, 0), at(grid->GetPoint(p)), 1e-6);
    EXPECT_NEAR(result->GetComponent(p, 1), -at(grid->GetPoint(p)), 1e-6);
    EXPECT_EQ(grid->GetPointData()->GetScalars()->GetComponent(p, 0), 7.0);
  }
  // A value that is not a number has no continuation.
  sphere->GetPointData()->AddArray(holes);
  sphere->Modified();
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Warnings, 1);
  EXPECT_TRUE(Contains(messages->Text, "1 point arrays cannot be continued"));
  grid = filter->GetOutput();
  std::set<vtkIdType> surface;
  for (const auto& face : Measure(grid).Boundary)
  {
    surface.insert(face.begin(), face.end());
  }
  vtkDataArray* filled = grid->GetPointData()->GetArray("holes");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double value = filled->GetComponent(p, 0);
    EXPECT_TRUE(surface.count(p) > 0 ? std::abs(value - 1.0) < 1e-12 || std::isnan(value)
                                     : std::isnan(value));
  }
}

//------------------------------------------------------------------------------
// Arrays with a value that is not finite have no continuation, whichever value it is.
TEST_F(TetGenMeshes, KeepArraysAtThePointsOfTheSurface)
{
  const auto surface = MakeGeodesicSphere(1.0, 2);
  AddArrays(surface);
  const auto filter = MakeFilter(surface, vtkTetrahedralizeSurface::TETGEN);
  filter->SetMaximumVolume(0.01);
  filter->PreserveSurfaceOn();
  const auto messages = UpdateAndObserve(filter);
  EXPECT_TRUE(Contains(messages->Text, "3 point arrays cannot be continued"));
  EXPECT_GT(filter->GetNumberOfAddedPoints(), 0);
  CheckArrays(filter->GetOutput(), surface);
}

//------------------------------------------------------------------------------
TEST_F(TetGenMeshes, ReportSurfacesThatCross)
{
  const auto crossing =
    Joined({ MakeBox(1.0, 1.0, 1.0), Moved(MakeBox(1.0, 1.0, 1.0), { 0.3, 0.4, 0.2 }) });
  EXPECT_TRUE(Contains(FailureOf(MakeFilter(crossing, vtkTetrahedralizeSurface::TETGEN)),
    "The surface crosses itself."));
  const auto nested = Joined({ MakeSphere(2.0, 24, 16), MakeSphere(1.0, 24, 16) });
  EXPECT_TRUE(Contains(FailureOf(MakeFilter(nested, vtkTetrahedralizeSurface::TETGEN)), "nested"));
}

//------------------------------------------------------------------------------
// Delaunay cells have the boundary of the points' convex hull; here that is the surface.
TEST(DelaunayMeshes, FillTheSurface)
{
  const auto surface = MakeEllipsoid(2, 1.3, 0.8);
  const double volume = GeodesicSphereVolume(1.0, 2) * 1.3 * 0.8;
  const auto filter = MakeFilter(surface, vtkTetrahedralizeSurface::DELAUNAY);
  ExpectQuiet(filter);
  const MeshFigures figures = Measure(filter->GetOutput());
  EXPECT_NEAR(figures.Volume, volume, 1e-12 * volume);
  EXPECT_GT(figures.SmallestVolume, 0.0);
  EXPECT_EQ(static_cast<vtkIdType>(figures.Boundary.size()), surface->GetNumberOfCells());
  EXPECT_EQ(filter->GetNumberOfAddedPoints(), 0);
  EXPECT_EQ(filter->GetUsedMesher(), vtkTetrahedralizeSurface::DELAUNAY);
}

//------------------------------------------------------------------------------
// Far from the origin, where squares of coordinates lose the digits of the surface.
TEST(DelaunayMeshes, FillSurfacesFarAway)
{
  for (const double distance : { 1e4, 1e5, 1e6 })
  {
    SCOPED_TRACE(distance);
    const auto surface = Moved(MakeEllipsoid(2, 1.3, 0.8), { distance, 0.7 * distance, 0.0 });
    const auto filter = MakeFilter(surface, vtkTetrahedralizeSurface::DELAUNAY);
    ExpectQuiet(filter);
    double volume = 0.0;
    vtkUnstructuredGrid* grid = filter->GetOutput();
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      double corner[4][3];
      for (int i = 0; i < 4; ++i)
      {
        grid->GetPoint(grid->GetCell(c)->GetPointId(i), corner[i]);
        corner[i][0] -= distance;
        corner[i][1] -= 0.7 * distance;
      }
      volume += vtkTetra::ComputeVolume(corner[0], corner[1], corner[2], corner[3]);
    }
    // The coordinates are rounded to epsilon times the distance; the area is below 20.
    EXPECT_NEAR(volume, GeodesicSphereVolume(1.0, 2) * 1.3 * 0.8, 20.0 * 3e-16 * distance);
  }
}

//------------------------------------------------------------------------------
// Without added points nothing is continued.
TEST(DelaunayMeshes, KeepArraysAtThePointsOfTheSurface)
{
  const auto surface = MakeEllipsoid(2, 1.3, 0.8);
  AddArrays(surface);
  const auto filter = MakeFilter(surface, vtkTetrahedralizeSurface::DELAUNAY);
  ExpectQuiet(filter);
  CheckArrays(filter->GetOutput(), surface);
}

//------------------------------------------------------------------------------
// Triangles of a convex surface are Delaunay faces, with empty spheres that here are much larger
// than the surface.
TEST(DelaunayMeshes, FillFlatConvexSurfaces)
{
  for (const double height : { 0.5, 0.2, 0.05 })
  {
    SCOPED_TRACE(height);
    const auto filter =
      MakeFilter(MakeEllipsoid(3, 1.3, height), vtkTetrahedralizeSurface::DELAUNAY);
    ExpectQuiet(filter);
    const double volume = GeodesicSphereVolume(1.0, 3) * 1.3 * height;
    EXPECT_NEAR(Measure(filter->GetOutput()).Volume, volume, 1e-12 * volume);
  }
}

//------------------------------------------------------------------------------
TEST(DelaunayMeshes, ReportLostTriangles)
{
  const auto crossing =
    Joined({ MakeBox(1.0, 1.0, 1.0), Moved(MakeBox(1.0, 1.0, 1.0), { 0.3, 0.4, 0.2 }) });
  EXPECT_TRUE(Contains(
    FailureOf(MakeFilter(crossing, vtkTetrahedralizeSurface::DELAUNAY)), "crosses itself"));
}

//------------------------------------------------------------------------------
TEST(BadSurfaces, AreErrors)
{
  struct Case
  {
    vtkSmartPointer<vtkPolyData> Surface;
    const char* Message;
  };
  const auto box = MakeBox(1.0, 1.0, 1.0);
  auto open = MakeBox(1.0, 1.0, 1.0);
  RemoveTriangle(open, 3);
  auto broken = MakeBox(1.0, 1.0, 1.0);
  broken->GetPoints()->SetPoint(2, std::nan(""), 0.0, 0.0);
  auto infinite = MakeBox(1.0, 1.0, 1.0);
  infinite->GetPoints()->SetPoint(2, HUGE_VAL, 0.0, 0.0);
  auto mixed = MakeBox(1.0, 1.0, 1.0);
  TurnTriangle(mixed, 4);
  // Two boxes with a common edge, and a box without height.
  const auto touching = Joined({ box, Moved(MakeBox(1.0, 1.0, 1.0), { 1.0, 1.0, 0.0 }) });
  const std::vector<Case> cases = { { vtkSmartPointer<vtkPolyData>::New(), "empty" },
    { MakePoints({ { 0.0, 0.0, 0.0 } }), "empty" }, { open, "open: 3 edges" },
    { broken, "1 points that are not finite" }, { infinite, "1 points that are not finite" },
    { mixed, "wound differently at 3 edges" }, { touching, "not a manifold: 1 edges" },
    { Reversed(box), "inside out" }, { Flattened(box), "inside out" } };
  for (const int mesher : { vtkTetrahedralizeSurface::TETGEN, vtkTetrahedralizeSurface::DELAUNAY })
  {
    for (const Case& bad : cases)
    {
      EXPECT_TRUE(Contains(FailureOf(MakeFilter(bad.Surface, mesher)), bad.Message));
    }
  }
}

//------------------------------------------------------------------------------
TEST(BadSettings, AreErrors)
{
  const double nan = std::nan("");
  const auto box = MakeBox(1.0, 1.0, 1.0);
  for (const double ratio : { 0.0, -2.0, 0.9, nan, HUGE_VAL })
  {
    const auto filter = MakeFilter(box, vtkTetrahedralizeSurface::DELAUNAY);
    filter->SetMaximumRadiusEdgeRatio(ratio);
    EXPECT_TRUE(Contains(FailureOf(filter), "MaximumRadiusEdgeRatio must"));
  }
  for (const double volume : { -1.0, nan, HUGE_VAL })
  {
    const auto filter = MakeFilter(box, vtkTetrahedralizeSurface::DELAUNAY);
    filter->SetMaximumVolume(volume);
    EXPECT_TRUE(Contains(FailureOf(filter), "MaximumVolume must"));
  }
  for (const double limit : { 0.0, -1.0, nan })
  {
    const auto filter = MakeFilter(box, vtkTetrahedralizeSurface::DELAUNAY);
    filter->SetTimeLimit(limit);
    EXPECT_TRUE(Contains(FailureOf(filter), "TimeLimit must"));
  }
}

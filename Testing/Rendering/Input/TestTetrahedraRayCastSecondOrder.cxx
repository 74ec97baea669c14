// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Quadratic cells, alone and next to each other: the image of linear cells with the same corners,
// whose field is the same if it is linear; links across all shared faces; closed forms where the
// points inside a face or a cell have their own values.
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

constexpr int Size = 80;
using Corners = std::vector<int>;

struct LinearCell
{
  int LinearType;
  /** Type of the quadratic cell. */
  int Type;
  /** Indices of points of the mesh. */
  Corners Points;
};

struct LinearMesh
{
  std::vector<std::array<double, 3>> Points;
  std::vector<LinearCell> Cells;
};

double FieldAt(const double* x)
{
  return 0.7 * x[0] - 0.4 * x[1] + 0.5 * x[2];
}

// The mesh with quadratic or with linear cells; cell data counts 0, 1, 0, 1. Points are numbered at
// random, since the splitting depends on the numbers.
Grid MakeMesh(const LinearMesh& mesh, bool secondOrder, unsigned int seed)
{
  std::map<Corners, int> places;
  std::vector<std::vector<int>> cells;
  for (const LinearCell& cell : mesh.Cells)
  {
    std::vector<Corners> sets;
    for (const int point : cell.Points)
    {
      sets.push_back({ point });
    }
    for (const Corners& further : secondOrder ? FurtherPoints(cell.Type) : std::vector<Corners>())
    {
      Corners set;
      for (const int corner : further)
      {
        set.push_back(cell.Points[corner]);
      }
      std::sort(set.begin(), set.end());
      sets.push_back(set);
    }
    std::vector<int> ids;
    for (const Corners& set : sets)
    {
      ids.push_back(places.emplace(set, static_cast<int>(places.size())).first->second);
    }
    cells.push_back(ids);
  }
  std::vector<vtkIdType> numbers(places.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(seed));
  auto grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(places.size()));
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  scalars->SetNumberOfTuples(points->GetNumberOfPoints());
  for (const auto& place : places)
  {
    double mean[3] = { 0.0, 0.0, 0.0 };
    for (const int corner : place.first)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        mean[axis] += mesh.Points[corner][axis] / static_cast<double>(place.first.size());
      }
    }
    points->SetPoint(numbers[place.second], mean);
    scalars->SetValue(numbers[place.second], FieldAt(mean));
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  vtkNew<vtkDoubleArray> ofCells;
  ofCells->SetName("cells");
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    std::vector<vtkIdType> ids;
    for (const int id : cells[c])
    {
      ids.push_back(numbers[id]);
    }
    grid->InsertNextCell(secondOrder ? mesh.Cells[c].Type : mesh.Cells[c].LinearType,
      static_cast<vtkIdType>(ids.size()), ids.data());
    ofCells->InsertNextValue(static_cast<double>(c % 2));
  }
  grid->GetCellData()->AddArray(ofCells);
  return grid;
}

enum Shape
{
  Hexahedron,
  Wedges,
  Pyramids
};

// A box of n[0] x n[1] x n[2] cubes in [-1, 1], each of a shape and a type.
LinearMesh MakeBox(
  const int (&n)[3], const std::function<std::pair<Shape, int>(int i, int j, int k)>& typeOf)
{
  LinearMesh mesh;
  for (const auto& [k, j, i] : Product(n[2] + 1, n[1] + 1, n[0] + 1))
  {
    mesh.Points.push_back({ 2.0 * i / n[0] - 1.0, 2.0 * j / n[1] - 1.0, 2.0 * k / n[2] - 1.0 });
  }
  for (int cube = 0; cube < n[0] * n[1] * n[2]; ++cube)
  {
    const int i = cube % n[0];
    const int j = cube / n[0] % n[1];
    const int k = cube / (n[0] * n[1]);
    const int dy = n[0] + 1;
    const int dz = dy * (n[1] + 1);
    const int o = i + j * dy + k * dz;
    const int p[8] = { o, o + 1, o + dy + 1, o + dy, o + dz, o + dz + 1, o + dz + dy + 1,
      o + dz + dy };
    const std::pair<Shape, int> what = typeOf(i, j, k);
    if (what.first == Hexahedron)
    {
      mesh.Cells.push_back({ VTK_HEXAHEDRON, what.second, Corners(p, p + 8) });
    }
    else if (what.first == Wedges)
    {
      mesh.Cells.push_back({ VTK_WEDGE, what.second, { p[0], p[1], p[3], p[4], p[5], p[7] } });
      mesh.Cells.push_back({ VTK_WEDGE, what.second, { p[1], p[2], p[3], p[5], p[6], p[7] } });
    }
    else
    {
      const int apex = static_cast<int>(mesh.Points.size());
      mesh.Points.push_back({ (2.0 * i + 1.0) / n[0] - 1.0, (2.0 * j + 1.0) / n[1] - 1.0,
        (2.0 * k + 1.0) / n[2] - 1.0 });
      const int sides[6][4] = { { 0, 1, 2, 3 }, { 7, 6, 5, 4 }, { 0, 4, 5, 1 }, { 1, 5, 6, 2 },
        { 2, 6, 7, 3 }, { 3, 7, 4, 0 } };
      for (const auto& s : sides)
      {
        mesh.Cells.push_back(
          { VTK_PYRAMID, what.second, { p[s[0]], p[s[1]], p[s[2]], p[s[3]], apex } });
      }
    }
  }
  return mesh;
}

std::unique_ptr<RayCastScene> MakeScene(vtkUnstructuredGrid* grid, vtkVolumeProperty* property)
{
  auto scene = std::make_unique<RayCastScene>(grid, property, Size, Size);
  const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  LookAt(scene->GetRenderer(), bounds, 25.0, 15.0);
  return scene;
}

void ExpectLinearTwin(const LinearMesh& mesh, const std::string& what)
{
  const double range[2] = { -2.0, 2.0 };
  const auto property = MakeProperty(FunctionKind::Smooth, range, 3.5);
  property->GetIsoSurfaceValues()->SetValue(0, 0.5);
  for (const unsigned int seed : { 1u, 2u })
  {
    const Grid linear = MakeMesh(mesh, false, seed);
    const Grid quadratic = MakeMesh(mesh, true, seed + 10);
    const auto expected = MakeScene(linear, property);
    const auto scene = MakeScene(quadratic, property);
    const auto told = ObserveErrors(scene->GetRayCaster());
    ExpectSamePicture(scene->RenderFloat(), expected->RenderFloat(), what);
    EXPECT_TRUE(told->Warnings.empty()) << what << ": " << told->Warnings.front();
    EXPECT_TRUE(told->Errors.empty()) << what << ": " << told->GetText();
    EXPECT_EQ(scene->GetRayCaster()->GetNumberOfLostRays(), 0) << what;
    // Isosurfaces of cell data are the faces between cells of value 0 and 1: those that are linked.
    for (RayCastScene* both : { scene.get(), expected.get() })
    {
      both->GetRayCaster()->SetScalarModeToUseCellFieldData();
      both->GetRayCaster()->SelectScalarArray("cells");
      both->GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    }
    ExpectSamePicture(scene->RenderFloat(), expected->RenderFloat(), what + ", shared faces");
  }
}

// Alpha of the pixel in the middle, whose ray goes through the centre of the box along an axis,
// with an attenuation equal to the scalar.
double AlphaAlong(vtkUnstructuredGrid* grid, int axis)
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetScalarOpacity(MakeOpacity({ { 0.0, 0.0 }, { 1.0, 1.0 } }));
  RayCastScene scene(grid, property, 33, 33);
  LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), axis);
  return scene.RenderFloat().GetPixel(16, 16)[3];
}

} // anonymous namespace

TEST(TetrahedraRayCastSecondOrder, EachTypeAlone)
{
  const std::pair<Shape, int> types[] = { { Hexahedron, VTK_QUADRATIC_HEXAHEDRON },
    { Hexahedron, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON },
    { Hexahedron, VTK_TRIQUADRATIC_HEXAHEDRON }, { Wedges, VTK_QUADRATIC_LINEAR_WEDGE },
    { Wedges, VTK_QUADRATIC_WEDGE }, { Wedges, VTK_BIQUADRATIC_QUADRATIC_WEDGE },
    { Pyramids, VTK_QUADRATIC_PYRAMID }, { Pyramids, VTK_TRIQUADRATIC_PYRAMID } };
  for (const auto& type : types)
  {
    ExpectLinearTwin(
      MakeBox({ 2, 2, 2 }, [&type](int, int, int) { return type; }), std::to_string(type.second));
  }
}

TEST(TetrahedraRayCastSecondOrder, NeighboursThatShareBiquadraticFaces)
{
  ExpectLinearTwin(
    MakeBox({ 3, 3, 1 },
      [](int i, int j, int)
      {
        const std::pair<Shape, int> types[] = { { Hexahedron, VTK_TRIQUADRATIC_HEXAHEDRON },
          { Wedges, VTK_BIQUADRATIC_QUADRATIC_WEDGE }, { Pyramids, VTK_TRIQUADRATIC_PYRAMID },
          { Hexahedron, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON } };
        return types[(i + 2 * j) % 4];
      }),
    "biquadratic faces");
}

TEST(TetrahedraRayCastSecondOrder, NeighboursThatShareQuadraticFaces)
{
  ExpectLinearTwin(MakeBox({ 2, 2, 4 },
                     [](int, int, int k)
                     {
                       return std::make_pair(Hexahedron,
                         static_cast<int>(k % 2 == 0 ? VTK_QUADRATIC_HEXAHEDRON
                                                     : VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON));
                     }),
    "quadratic quadrilaterals");
  const int wedges[] = { VTK_BIQUADRATIC_QUADRATIC_WEDGE, VTK_QUADRATIC_WEDGE,
    VTK_QUADRATIC_LINEAR_WEDGE };
  ExpectLinearTwin(
    MakeBox({ 2, 2, 3 }, [&wedges](int, int, int k) { return std::make_pair(Wedges, wedges[k]); }),
    "quadratic triangles");
  // A wedge of each type with a tetrahedron on top.
  for (const int wedge : wedges)
  {
    LinearMesh mesh;
    mesh.Points = { { -0.8, -0.8, -0.9 }, { 0.9, -0.7, -0.9 }, { 0.0, 0.9, -0.9 },
      { -0.8, -0.8, 0.1 }, { 0.9, -0.7, 0.1 }, { 0.0, 0.9, 0.1 }, { 0.0, 0.0, 0.9 } };
    mesh.Cells = { { VTK_WEDGE, wedge, { 0, 1, 2, 3, 4, 5 } },
      { VTK_TETRA, VTK_QUADRATIC_TETRA, { 3, 4, 5, 6 } } };
    ExpectLinearTwin(mesh, "a tetrahedron on a wedge of type " + std::to_string(wedge));
  }
}

TEST(TetrahedraRayCastSecondOrder, CurvedFacesFitWithoutGapsOrOverlaps)
{
  // Points inside the box are moved: faces are no longer planar, and every ray still crosses the
  // box once. Its chord gives alpha, as without the moves.
  const std::pair<Shape, int> types[] = { { Hexahedron, VTK_TRIQUADRATIC_HEXAHEDRON },
    { Wedges, VTK_BIQUADRATIC_QUADRATIC_WEDGE }, { Pyramids, VTK_TRIQUADRATIC_PYRAMID },
    { Hexahedron, VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON }, { Hexahedron, VTK_QUADRATIC_HEXAHEDRON },
    { Wedges, VTK_QUADRATIC_WEDGE }, { Pyramids, VTK_QUADRATIC_PYRAMID },
    { Wedges, VTK_QUADRATIC_LINEAR_WEDGE } };
  std::vector<LinearMesh> meshes{ MakeBox(
    { 3, 3, 1 }, [&types](int i, int j, int) { return types[(i + j) % 3]; }) };
  for (const auto& type : types)
  {
    meshes.push_back(MakeBox({ 2, 2, 2 }, [&type](int, int, int) { return type; }));
  }
  const auto property = MakeConstantProperty(0.5, 1.0, 0.2, 0.1, 1.0);
  for (std::size_t m = 0; m < meshes.size(); ++m)
  {
    const Grid grid = MakeMesh(meshes[m], true, 3);
    const FloatImage expected = MakeScene(grid, property)->RenderFloat();
    std::mt19937 random(4);
    std::uniform_real_distribution<double> move(-0.04, 0.04);
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      double x[3];
      grid->GetPoint(p, x);
      if (std::max({ std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2]) }) < 0.999)
      {
        for (double& coordinate : x)
        {
          coordinate += move(random);
        }
        grid->GetPoints()->SetPoint(p, x);
      }
    }
    const auto scene = MakeScene(grid, property);
    ExpectSamePicture(scene->RenderFloat(), expected, "moved, mesh " + std::to_string(m));
    EXPECT_EQ(scene->GetRayCaster()->GetNumberOfLostRays(), 0);
  }
}

TEST(TetrahedraRayCastSecondOrder, PointsInsideFacesAndCellsCount)
{
  // A cell of edge 2 with the scalar 1 at one point inside and 0 elsewhere: along an axis through
  // that point the scalar rises from 0 to 1 and falls again, so the optical depth is 2 * 1/2.
  const double expected = 1.0 - std::exp(-1.0);
  const auto withOne = [](int type, const double(&at)[3])
  {
    const Grid grid = MakeMesh(
      MakeBox({ 1, 1, 1 }, [type](int, int, int) { return std::make_pair(Hexahedron, type); }),
      true, 5);
    auto* scalars = vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetScalars());
    scalars->Fill(0.0);
    vtkIdType found = 0;
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      const double* x = grid->GetPoint(p);
      if (x[0] == at[0] && x[1] == at[1] && x[2] == at[2])
      {
        scalars->SetValue(p, 1.0);
        ++found;
      }
    }
    EXPECT_EQ(found, 1);
    return grid;
  };
  for (const int axis : { 0, 1, 2 })
  {
    EXPECT_NEAR(AlphaAlong(withOne(VTK_TRIQUADRATIC_HEXAHEDRON, { 0.0, 0.0, 0.0 }), axis), expected,
      FloatTolerance);
    // Through the centres of two faces: if the cell has an inner point, the scalar is back at 0
    // there.
    double face[3] = { 0.0, 0.0, 0.0 };
    face[axis] = 1.0;
    EXPECT_NEAR(AlphaAlong(withOne(VTK_TRIQUADRATIC_HEXAHEDRON, face), axis), 1.0 - std::exp(-0.5),
      FloatTolerance);
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cell data: a constant scalar in each cell, in every blend mode.
#include "MembraneScene.h"
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 80;
constexpr double Range[2] = { -1.0, 1.0 };
const char* const CellScalarName = "cell scalar";

/** Gives every cell the field's value at the mean of its points. */
vtkDoubleArray* AddCellScalars(vtkUnstructuredGrid* grid, const Field& field)
{
  vtkNew<vtkDoubleArray> values;
  values->SetName(CellScalarName);
  values->SetNumberOfTuples(grid->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    double middle[3] = { 0.0, 0.0, 0.0 };
    for (const auto& [i, axis] : Product(Below<vtkIdType>(ids->GetNumberOfIds()), 3))
    {
      middle[axis] += grid->GetPoint(ids->GetId(i))[axis] / ids->GetNumberOfIds();
    }
    values->SetValue(c, field(middle[0], middle[1], middle[2]));
  }
  grid->GetCellData()->SetScalars(values);
  return values;
}

vtkDoubleArray* MakeCellScalars(vtkUnstructuredGrid* grid)
{
  return vtkDoubleArray::SafeDownCast(grid->GetCellData()->GetScalars());
}

Grid MakeCellBlock(int n, const Region& region = nullptr)
{
  const Grid grid = MakeBlock(n, ConstantField(0.0), region);
  Jitter(grid, 0.3 / n, 3);
  AddCellScalars(grid, WavyField(3.0));
  return grid;
}

/** Cells of a ray with their own scalars; cells without a scalar are left out. */
std::vector<RaySegment> FindCells(
  const ReferenceRayIntegrator& integrator, vtkDataArray* values, const Ray& ray)
{
  std::vector<RaySegment> segments;
  integrator.FindSegments(ray, segments);
  std::vector<RaySegment> known;
  for (RaySegment segment : segments)
  {
    segment.ScalarBegin = segment.ScalarEnd = values->GetComponent(segment.Cell, 0);
    if (std::isfinite(segment.ScalarBegin))
    {
      known.push_back(segment);
    }
  }
  return known;
}

/** Normal of the face that two cells share. */
Vector3 NormalBetween(const ReferenceMesh& mesh, std::int64_t a, std::int64_t b)
{
  const std::int64_t* other = mesh.GetCell(static_cast<std::size_t>(b));
  std::vector<const double*> corners;
  for (int i = 0; i < 4; ++i)
  {
    const std::int64_t id = mesh.GetCell(static_cast<std::size_t>(a))[i];
    if (std::find(other, other + 4, id) != other + 4)
    {
      corners.push_back(mesh.GetPoint(id));
    }
  }
  Vector3 u;
  Vector3 v;
  for (int axis = 0; axis < 3; ++axis)
  {
    u[axis] = corners[1][axis] - corners[0][axis];
    v[axis] = corners[2][axis] - corners[0][axis];
  }
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

/**
 * Isosurfaces of cell scalars: the places where a ray passes from one cell to the next across
 * isovalues.
 */
std::array<double, 4> BlendJumps(const ReferenceMesh& mesh, const Ray& ray,
  const std::vector<RaySegment>& segments, std::vector<Surface> surfaces, const Material* material)
{
  std::sort(surfaces.begin(), surfaces.end(),
    [](const Surface& a, const Surface& b) { return a.Scalar < b.Scalar; });
  std::array<double, 4> total{ 0.0, 0.0, 0.0, 0.0 };
  for (std::size_t i = 1; i < segments.size(); ++i)
  {
    const RaySegment& from = segments[i - 1];
    const RaySegment& to = segments[i];
    if (to.Begin - from.End > 1e-9)
    {
      continue; // left the mesh and came back
    }
    std::vector<Surface> met;
    for (const Surface& surface : surfaces)
    {
      if ((from.ScalarEnd < surface.Scalar) != (to.ScalarBegin < surface.Scalar))
      {
        met.push_back(surface);
      }
    }
    if (to.ScalarBegin < from.ScalarEnd)
    {
      std::reverse(met.begin(), met.end());
    }
    for (const Surface& surface : met)
    {
      std::array<double, 3> color = surface.Color;
      if (material)
      {
        Vector3 x;
        for (int axis = 0; axis < 3; ++axis)
        {
          x[axis] = ray.Origin[axis] + to.Begin * ray.Direction[axis];
        }
        color = Shade(*material, ray, x, NormalBetween(mesh, from.Cell, to.Cell), color);
      }
      const double share = (1.0 - total[3]) * surface.Alpha;
      for (int c = 0; c < 3; ++c)
      {
        total[c] += share * color[c];
      }
      total[3] += share;
    }
  }
  return total;
}

/** A scene of a grid's cell scalars. */
class CellScene : public RayCastScene
{
public:
  CellScene(vtkUnstructuredGrid* grid, vtkVolumeProperty* property)
    : RayCastScene(grid, property, Size, Size)
  {
    this->GetRayCaster()->SetScalarModeToUseCellData();
    LookAt(this->GetRenderer(), grid->GetBounds(), 30.0, 20.0);
  }

  void RefractionAt(const MembraneCase& membrane)
  {
    this->Membrane = membrane;
    this->GetRayCaster()->SetMembraneData(membrane.Mesh);
    LookAt(this->GetRenderer(), this->MakeGrid()->GetBounds(), 30.0, 50.0);
  }

  /** Compares with traces of the parts of the rays that the given clipping planes leave. */
  TracedComparison ExpectComposite(
    const std::string& what, const std::vector<HalfSpace>& halves = {})
  {
    const auto function = ToReference(this->GetVolume()->GetProperty());
    return this->ExpectOfCells(
      [&](const ReferenceMesh&, const Ray& ray, const std::vector<RaySegment>& cells)
      { return ReferenceRayIntegrator::Integrate(ray, cells, function); },
      what, halves);
  }

  TracedComparison ExpectSurfaces(
    const std::string& what, const std::vector<HalfSpace>& halves = {})
  {
    this->GetWindow()->Render();
    vtkVolumeProperty* property = this->GetVolume()->GetProperty();
    const Material material = ToMaterial(property, this->GetRenderer());
    const std::vector<Surface> surfaces = ToSurfaces(property);
    return this->ExpectOfCells(
      [&](const ReferenceMesh& mesh, const Ray& ray, const std::vector<RaySegment>& cells) {
        return BlendJumps(mesh, ray, cells, surfaces, property->GetShade() ? &material : nullptr);
      },
      what, halves);
  }

private:
  using ShowCells = std::function<std::array<double, 4>(
    const ReferenceMesh&, const Ray&, const std::vector<RaySegment>&)>;

  TracedComparison ExpectOfCells(
    const ShowCells& show, const std::string& what, const std::vector<HalfSpace>& halves)
  {
    this->GetWindow()->Render();
    const auto integrator = MakeReference(this->MakeGrid(), this->GetVolume()->GetMatrix());
    return ExpectTrace(*this,
      this->Membrane.BendMembrane(
        [&](const Ray& whole)
        {
          const Ray ray = ClipRay(whole, halves);
          return ray.Begin < ray.End
            ? show(integrator->MakeMesh(), ray,
                FindCells(*integrator, MakeCellScalars(this->MakeGrid()), ray))
            : std::array<double, 4>{ 0.0, 0.0, 0.0, 0.0 };
        }),
      what);
  }

  MembraneCase Membrane;
};

vtkSmartPointer<vtkVolumeProperty> SurfaceProperty()
{
  auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  const double values[3] = { 0.3, -0.2, 0.05 };
  for (int i = 0; i < 3; ++i)
  {
    property->GetIsoSurfaceValues()->SetValue(i, values[i]);
  }
  return property;
}

std::vector<HalfSpace> AddPlane(RayCastScene& scene)
{
  const HalfSpace half{ Vector3{ 0.4, -0.3, -0.8 }, Vector3{ 0.05, 0.02, 0.11 } };
  AddClippingPlane(scene.GetRayCaster(), half);
  return { half };
}

} // anonymous namespace

TEST(TetrahedraRayCastCellData, TwoSlabs)
{
  // x < 0: attenuation 0.5 and red; x > 0: attenuation 2 and blue.
  const Grid grid = MakeBlock(4, ConstantField(0.0));
  AddCellScalars(grid, [](double x, double, double) { return x < 0.0 ? -1.0 : 1.0; });
  auto property = MakeConstantProperty(0.0, 1, 1, 1, 1.0);
  SetPoints(property->GetScalarOpacity(), { { -1.0, 0.5 }, { 1.0, 2.0 } });
  SetPoints(
    property->GetRGBTransferFunction(), { { -1.0, 1.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0, 1.0 } });
  CellScene scene(grid, property);
  LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), 0, 1.3);
  const FloatImage image = scene.RenderFloat();
  // Along x, in either direction: a length of 1 in each half.
  const float* middle = image.GetPixel(Size / 2, Size / 2);
  const bool redFirst = middle[0] > 0.3f;
  const double red = (1.0 - std::exp(-0.5)) * (redFirst ? 1.0 : std::exp(-2.0));
  const double blue = (1.0 - std::exp(-2.0)) * (redFirst ? std::exp(-0.5) : 1.0);
  for (const int x : { Size / 4, Size / 2, 16 * Size / 25 })
  {
    const float* pixel = image.GetPixel(x, 17 * Size / 40);
    EXPECT_NEAR(pixel[0], red, 2e-6);
    EXPECT_NEAR(pixel[1], 0.0, 2e-6);
    EXPECT_NEAR(pixel[2], blue, 2e-6);
    EXPECT_NEAR(pixel[3], 1.0 - std::exp(-2.5), 2e-6);
  }
}

TEST(TetrahedraRayCastCellData, CompositeIsThatOfTheReference)
{
  for (const bool hollow : { false, true })
  {
    const Grid grid = MakeCellBlock(6, hollow ? Shell(0.5, 0.95) : Region());
    for (const FunctionKind kind :
      { FunctionKind::Smooth, FunctionKind::Peaked, FunctionKind::Sparse, FunctionKind::Opaque })
    {
      CellScene scene(grid, MakeProperty(kind, Range, 3.4));
      scene.ExpectComposite(
        "function " + std::to_string(int(kind)) + (hollow ? ", shell" : ", block"));
    }
    CellScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4));
    scene.ExpectComposite("clipped", AddPlane(scene));
  }
}

TEST(TetrahedraRayCastCellData, ThroughAMembrane)
{
  const Grid grid = MakeCellBlock(6);
  for (const MembraneCase& membrane :
    { MakePlaneCase(0.1, 4.0, 2), MakeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    CellScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4));
    scene.RefractionAt(membrane);
    scene.ExpectComposite("composite");
    scene.ExpectComposite("clipped", AddPlane(scene));
    CellScene surfaces(grid, SurfaceProperty());
    surfaces.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    surfaces.RefractionAt(membrane);
    surfaces.ExpectSurfaces("isosurfaces");
    surfaces.GetVolume()->GetProperty()->ShadeOn();
    surfaces.ExpectSurfaces("lit isosurfaces");
  }
}

TEST(TetrahedraRayCastCellData, ThroughAMembraneNextToTheBoundary)
{
  // Refracted legs begin in the cells by which sight rays enter the mesh, within the margin in
  // which shaders look for entries. No cell may count twice.
  const Grid grid = MakeCellBlock(6);
  CellScene surfaces(grid, SurfaceProperty());
  surfaces.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  for (const double below : { 1e-5, 1e-4, 3e-4 })
  {
    surfaces.RefractionAt(MakePlaneCase(1.0 - below, 4.0, 2));
    surfaces.ExpectSurfaces(std::to_string(below) + " below the top");
  }
}

TEST(TetrahedraRayCastCellData, Projections)
{
  const Grid grid = MakeCellBlock(6);
  for (const ProjectionMode& mode : ProjectionModes)
  {
    CellScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4));
    scene.GetRayCaster()->SetBlendMode(mode.Number);
    scene.GetWindow()->Render();
    const auto integrator = MakeReference(grid);
    vtkVolumeProperty* property = scene.GetVolume()->GetProperty();
    const auto function = FunctionOf(mode, property);
    double range[2];
    MakeCellScalars(grid)->GetFiniteRange(range);
    ExpectTrace(
      scene,
      [&](const Ray& ray)
      {
        return Project(
          ray, FindCells(*integrator, MakeCellScalars(grid), ray), mode.Truth, function, range);
      },
      mode.Name, FloatTolerance, 0.01);
  }
}

TEST(TetrahedraRayCastCellData, IsosurfacesAreFacesBetweenCells)
{
  for (const bool hollow : { false, true })
  {
    const Grid grid = MakeCellBlock(6, hollow ? Shell(0.5, 0.95) : Region());
    for (const bool lit : { false, true })
    {
      auto property = SurfaceProperty();
      property->SetShade(lit);
      CellScene scene(grid, property);
      scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
      AddParallelLight(scene.GetRenderer(), 4.0, 2.0, 1.0);
      const std::string what =
        std::string(lit ? "lit" : "unlit") + (hollow ? ", shell" : ", block");
      scene.ExpectSurfaces(what);
      scene.ExpectSurfaces(what + ", clipped", AddPlane(scene));
    }
  }
}

TEST(TetrahedraRayCastCellData, IsosurfacesVisitTheCellsOnBothSides)
{
  const Grid grid = MakeBlock(8, ConstantField(0.0));
  AddCellScalars(grid, [](double x, double, double) { return x < 0.0 ? -1.0 : 1.0; });
  auto property = SurfaceProperty();
  CellScene scene(grid, property);
  scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  scene.ExpectSurfaces("between two slabs");
  // A side of a cube is two faces; each has a cell on both sides.
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), 8 * 8 * 4);
}

TEST(TetrahedraRayCastCellData, FromWithinTheMesh)
{
  const Grid grid = MakeCellBlock(5);
  for (const bool surfaces : { false, true })
  {
    CellScene scene(grid, SurfaceProperty());
    LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 20.0, 1.0);
    scene.GetRenderer()->GetActiveCamera()->SetPosition(0.31, 0.12, 0.43);
    scene.GetRenderer()->GetActiveCamera()->SetFocalPoint(-1.0, -0.2, -0.6);
    scene.GetRenderer()->GetActiveCamera()->SetClippingRange(0.05, 5.0);
    if (surfaces)
    {
      scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
      scene.ExpectSurfaces("surfaces");
    }
    else
    {
      scene.ExpectComposite("composite");
    }
  }
}

TEST(TetrahedraRayCastCellData, CellsWithoutValueAreTransparentAndCounted)
{
  const Grid grid = MakeCellBlock(5);
  const std::set<vtkIdType> unknown{ 17, 18, 100, 101, 102, 400, 555 };
  for (const vtkIdType cell : unknown)
  {
    MakeCellScalars(grid)->SetValue(cell,
      cell == 100 ? std::numeric_limits<double>::infinity()
                  : std::numeric_limits<double>::quiet_NaN());
  }
  CellScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4));
  const auto warnings = ObserveErrors(scene.GetRayCaster());
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  scene.ExpectComposite("with holes");
  EXPECT_EQ(scene.GetRayCaster()->GetStatistic("NumberOfTransparentCells"), 7);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() - 7);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfRejectedCells(), 0);
  EXPECT_EQ(warnings->Warnings.size(), 1u);

  CellScene surfaces(grid, SurfaceProperty());
  surfaces.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  surfaces.ExpectSurfaces("surfaces with holes");
}

TEST(TetrahedraRayCastCellData, OnlyCellsThatCanBeSeenAreVisited)
{
  const Grid grid = MakeCellBlock(6);
  auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  SetPoints(property->GetScalarOpacity(), { { 0.1, 0.0 }, { 0.2, 0.9 }, { 0.3, 0.0 } });
  vtkTypeInt64 expected = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const double value = MakeCellScalars(grid)->GetValue(c);
    expected += value > 0.1 && value < 0.3;
  }
  CellScene scene(grid, property);
  scene.ExpectComposite("a window of values");
  EXPECT_GT(expected, 0);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), expected);
}

TEST(TetrahedraRayCastCellData, TetrahedraInheritTheirCellsValue)
{
  const Grid tetrahedra = MakeBlock(4, ConstantField(0.0));
  AddCellScalars(tetrahedra,
    [](double x, double y, double z)
    {
      const auto cube = [](double a) { return std::floor(2.0 * a) + 2.0; }; // 0 to 3
      return -1.0 + (cube(x) * 16.0 + cube(y) * 4.0 + cube(z)) / 32.0;
    });
  const Grid hexahedra = Grid::New();
  hexahedra->SetPoints(tetrahedra->GetPoints());
  const vtkIdType triangle[3] = { 0, 1, 2 };
  hexahedra->InsertNextCell(VTK_TRIANGLE, 3, triangle); // not drawn, and must not shift the cell
                                                        // data
  for (const auto& [k, j, i] : Product(4, 4, 4))
  {
    vtkIdType ids[8];
    for (int corner = 0; corner < 8; ++corner)
    {
      const double x[3] = { -1.0 + 0.5 * (i + (corner & 1)), -1.0 + 0.5 * (j + (corner >> 1 & 1)),
        -1.0 + 0.5 * (k + (corner >> 2)) };
      ids[corner] = hexahedra->FindPoint(const_cast<double*>(x));
    }
    hexahedra->InsertNextCell(VTK_VOXEL, 8, ids);
  }
  AddCellScalars(hexahedra,
    [](double x, double y, double z)
    {
      const auto cube = [](double a) { return std::floor(2.0 * a) + 2.0; };
      return -1.0 + (cube(x) * 16.0 + cube(y) * 4.0 + cube(z)) / 32.0;
    });
  CellScene expected(tetrahedra, MakeProperty(FunctionKind::Smooth, Range, 3.4));
  CellScene scene(hexahedra, MakeProperty(FunctionKind::Smooth, Range, 3.4));
  const FloatImage a = expected.RenderFloat();
  const FloatImage b = scene.RenderFloat();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), 6 * 64);
  for (std::size_t i = 0; i < a.Rgba.size(); ++i)
  {
    ASSERT_NEAR(a.Rgba[i], b.Rgba[i], 2e-5);
  }
}

TEST(TetrahedraRayCastCellData, NewValuesUpdateOnlyThem)
{
  const Grid grid = MakeCellBlock(5);
  CellScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4));
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  scene.GetWindow()->Render();
  const vtkTypeInt64 bytes = scene.GetRayCaster()->GetUploadedBytes();
  vtkDoubleArray* values = MakeCellScalars(grid);
  for (vtkIdType c = 1; c < values->GetNumberOfTuples(); c += 2)
  {
    std::swap(*values->GetPointer(c), *values->GetPointer(c - 1)); // the range does not change
  }
  values->Modified();
  scene.ExpectComposite("other values");
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), 2);
  EXPECT_EQ(mapper->GetNumberOfTransferFunctionBuilds(), 1);
  EXPECT_EQ(mapper->GetUploadedBytes() - bytes, 4 * grid->GetNumberOfCells());
}

TEST(TetrahedraRayCastCellData, PointDataAndBack)
{
  const Grid grid = MakeBlock(4, WavyField(3.0));
  AddCellScalars(grid, WavyField(2.0));
  RayCastScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  // By default point data is used, if there is any.
  const FloatImage points = scene.RenderFloat();
  ExpectMatchesReference(scene, "point data");
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 1);
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectScalarArray(CellScalarName);
  const FloatImage cells = scene.RenderFloat();
  EXPECT_NE(cells.Rgba, points.Rgba);
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 2); // now with each tetrahedron's cell
  mapper->SetScalarModeToDefault();
  EXPECT_EQ(scene.RenderFloat().Rgba, points.Rgba);
  mapper->SetScalarModeToUseCellData();
  EXPECT_EQ(scene.RenderFloat().Rgba, cells.Rgba);
  EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), 2);
  grid->GetPointData()->Initialize();
  mapper->SetScalarModeToDefault();
  EXPECT_EQ(scene.RenderFloat().Rgba, cells.Rgba);
}

TEST(TetrahedraRayCastCellData, LightChangesNothingInTheMedium)
{
  const Grid grid = MakeCellBlock(4);
  CellScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4));
  const FloatImage unlit = scene.RenderFloat();
  scene.GetVolume()->GetProperty()->ShadeOn();
  scene.GetVolume()->GetProperty()->GetGradientOpacity()->AddPoint(0.0, 0.0);
  scene.GetVolume()->GetProperty()->GetGradientOpacity()->AddPoint(1.0, 1.0);
  EXPECT_EQ(scene.RenderFloat().Rgba, unlit.Rgba);
  EXPECT_EQ(scene.GetRayCaster()->GetStatistic("NumberOfGradientBuilds"), 0);
}

TEST(TetrahedraRayCastCellData, ComputeIsTheFragmentShadersTwin)
{
  const Grid grid = MakeCellBlock(5);
  for (const bool surfaces : { false, true })
  {
    CellScene scene(grid, SurfaceProperty());
    scene.GetRayCaster()->SetBlendMode(
      surfaces ? vtkVolumeMapper::ISOSURFACE_BLEND : vtkVolumeMapper::COMPOSITE_BLEND);
    scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
    const FloatImage fragments = scene.RenderFloat();
    scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::COMPUTE);
    const FloatImage compute = scene.RenderFloat();
    for (std::size_t i = 0; i < compute.Rgba.size(); ++i)
    {
      ASSERT_NEAR(compute.Rgba[i], fragments.Rgba[i], 2e-5);
    }
  }
}

TEST(TetrahedraRayCastCellData, WrongArraysAreErrors)
{
  const Grid grid = MakeCellBlock(3);
  CellScene scene(grid, MakeProperty(FunctionKind::Smooth, Range, 3.4));
  const auto errors = ObserveErrors(scene.GetRayCaster());
  MakeCellScalars(grid)->SetNumberOfTuples(5);
  scene.GetWindow()->Render();
  ASSERT_EQ(errors->Errors.size(), 1u);
  EXPECT_TRUE(HasText(errors->GetText(), " cells"));

  vtkNew<vtkDoubleArray> field;
  field->SetName("field");
  field->SetNumberOfTuples(grid->GetNumberOfCells());
  grid->GetFieldData()->AddArray(field);
  scene.GetRayCaster()->SetScalarMode(VTK_SCALAR_MODE_USE_FIELD_DATA);
  scene.GetRayCaster()->SelectScalarArray("field");
  scene.GetWindow()->Render();
  ASSERT_EQ(errors->Errors.size(), 2u);
  EXPECT_TRUE(HasText(errors->Errors[1], "field data"));
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestMeshes.h"

#include <vtkXMLUnstructuredGridReader.h>

namespace meniscus::test
{

const char* const ScalarName = "Scalar";

//------------------------------------------------------------------------------
Field ConstantField(double value)
{
  return [value](double, double, double) { return value; };
}

//------------------------------------------------------------------------------
Field LinearField(double x, double y, double z)
{
  return [=](double px, double py, double pz) { return x * px + y * py + z * pz; };
}

//------------------------------------------------------------------------------
Field RadialField()
{
  return [](double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); };
}

//------------------------------------------------------------------------------
Field WavyField(double frequency)
{
  return [frequency](double x, double y, double z)
  { return std::sin(frequency * x) * std::cos(frequency * y) + 0.5 * std::sin(2 * z + x); };
}

//------------------------------------------------------------------------------
Grid MakeGrid(
  const std::vector<double>& points, const std::vector<vtkIdType>& cells, const Field& field)
{
  const auto numberOfPoints = static_cast<vtkIdType>(points.size() / 3);
  vtkNew<vtkPoints> coordinates;
  coordinates->SetDataTypeToDouble();
  coordinates->SetNumberOfPoints(numberOfPoints);
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(ScalarName);
  scalars->SetNumberOfTuples(numberOfPoints);
  for (vtkIdType i = 0; i < numberOfPoints; ++i)
  {
    const double* x = &points[3 * i];
    coordinates->SetPoint(i, x);
    scalars->SetValue(i, field(x[0], x[1], x[2]));
  }
  Grid grid = Grid::New();
  grid->SetPoints(coordinates);
  grid->GetPointData()->SetScalars(scalars);
  grid->Allocate(static_cast<vtkIdType>(cells.size() / 4));
  for (std::size_t i = 0; i + 3 < cells.size(); i += 4)
  {
    grid->InsertNextCell(VTK_TETRA, 4, &cells[i]);
  }
  return grid;
}

//------------------------------------------------------------------------------
Grid MakeSingleTetrahedron(const Field& field)
{
  return MakeGrid({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 1, 2, 3 }, field);
}

namespace
{

const std::vector<double> CubeCorners{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, //
  0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1 };

// Paths from corner (0,0,0) to (1,1,1) of a cube along its axes: one tetrahedron each. Neighbouring
// cubes that are split in this way match face to face.
constexpr int Paths[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
  { 2, 1, 0 } };

template <typename CornerId>
void AppendCube(const CornerId& cornerId, std::vector<vtkIdType>& cells)
{
  for (const auto& path : Paths)
  {
    int corner[3] = { 0, 0, 0 };
    vtkIdType ids[4];
    ids[0] = cornerId(0, 0, 0);
    for (int i = 0; i < 3; ++i)
    {
      corner[path[i]] = 1;
      ids[i + 1] = cornerId(corner[0], corner[1], corner[2]);
    }
    // Odd paths have a negative volume: swap two vertices.
    const bool odd = (path[1] - path[0] + 3) % 3 != 1;
    cells.insert(cells.end(), { ids[0], ids[odd ? 2 : 1], ids[odd ? 1 : 2], ids[3] });
  }
}

// Omits points that no cell uses, so that the bounds are those of the region.
Grid MakeCompactGrid(
  const std::vector<double>& points, std::vector<vtkIdType> cells, const Field& field)
{
  std::vector<vtkIdType> newId(points.size() / 3, -1);
  std::vector<double> used;
  for (vtkIdType& id : cells)
  {
    if (newId[id] < 0)
    {
      newId[id] = static_cast<vtkIdType>(used.size() / 3);
      used.insert(used.end(), points.begin() + 3 * id, points.begin() + 3 * id + 3);
    }
    id = newId[id];
  }
  return MakeGrid(used, cells, field);
}

} // anonymous namespace

//------------------------------------------------------------------------------
Grid MakeCubeOfFive(const Field& field)
{
  return MakeGrid(
    CubeCorners, { 0, 1, 2, 4, 3, 2, 1, 7, 5, 4, 7, 1, 6, 7, 4, 2, 1, 2, 4, 7 }, field);
}

//------------------------------------------------------------------------------
Grid MakeCubeOfSix(const Field& field)
{
  std::vector<vtkIdType> cells;
  AppendCube([](int x, int y, int z) { return vtkIdType(x + 2 * y + 4 * z); }, cells);
  return MakeGrid(CubeCorners, cells, field);
}

//------------------------------------------------------------------------------
Grid MakeBlock(int n, const Field& field, const Region& region)
{
  std::vector<double> points;
  points.reserve(3 * static_cast<std::size_t>(n + 1) * (n + 1) * (n + 1));
  const auto at = [n](double i) { return -1.0 + 2.0 * i / n; };
  for (const auto& [k, j, i] : Product(n + 1, n + 1, n + 1))
  {
    points.insert(points.end(), { at(i), at(j), at(k) });
  }
  std::vector<vtkIdType> cells;
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    const int i = cube % n;
    const int j = cube / n % n;
    const int k = cube / (n * n);
    if (!region || region(at(i + 0.5), at(j + 0.5), at(k + 0.5)))
    {
      AppendCube([=](int x, int y, int z)
        { return vtkIdType(i + x) + vtkIdType(n + 1) * (j + y + vtkIdType(n + 1) * (k + z)); },
        cells);
    }
  }
  return MakeCompactGrid(points, cells, field);
}

//------------------------------------------------------------------------------
Region LShape()
{
  return [](double x, double y, double) { return x < 0.0 || y < 0.0; };
}

//------------------------------------------------------------------------------
Region Shell(double inner, double outer)
{
  return [=](double x, double y, double z)
  {
    const double r = std::sqrt(x * x + y * y + z * z);
    return r >= inner && r <= outer;
  };
}

//------------------------------------------------------------------------------
Region Torus(double ringRadius, double tubeRadius)
{
  return [=](double x, double y, double z)
  { return std::hypot(std::hypot(x, y) - ringRadius, z) <= tubeRadius; };
}

//------------------------------------------------------------------------------
Region TwoBlocks(double gap)
{
  return [gap](double x, double, double) { return std::fabs(x) > 0.5 * gap; };
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> FurtherPoints(int type)
{
  using Corners = std::vector<int>;
  static const std::vector<Corners> hexahedron{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 4, 5 },
    { 5, 6 }, { 6, 7 }, { 7, 4 }, { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 }, { 0, 4, 7, 3 },
    { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 },
    { 0, 1, 2, 3, 4, 5, 6, 7 } };
  static const std::vector<Corners> wedge{ { 0, 1 }, { 1, 2 }, { 2, 0 }, { 3, 4 }, { 4, 5 },
    { 5, 3 }, { 0, 3 }, { 1, 4 }, { 2, 5 }, { 0, 3, 4, 1 }, { 1, 4, 5, 2 }, { 2, 5, 3, 0 } };
  static const std::vector<Corners> pyramid{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 0, 4 },
    { 1, 4 }, { 2, 4 }, { 3, 4 }, { 0, 1, 2, 3 }, { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 },
    { 3, 0, 4 }, { 0, 1, 2, 3, 4 } };
  static const std::vector<Corners> tetrahedron{ { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 1, 3 },
    { 2, 3 } };
  const auto first = [](const std::vector<Corners>& all, std::size_t count)
  { return std::vector<Corners>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)); };
  switch (type)
  {
    case VTK_QUADRATIC_HEXAHEDRON:
      return first(hexahedron, 12);
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
      return first(hexahedron, 16);
    case VTK_TRIQUADRATIC_HEXAHEDRON:
      return hexahedron;
    case VTK_QUADRATIC_LINEAR_WEDGE:
      return first(wedge, 6);
    case VTK_QUADRATIC_WEDGE:
      return first(wedge, 9);
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
      return wedge;
    case VTK_QUADRATIC_PYRAMID:
      return first(pyramid, 8);
    case VTK_TRIQUADRATIC_PYRAMID:
      return pyramid;
    case VTK_QUADRATIC_TETRA:
      return tetrahedron;
    default:
      return {};
  }
}

//------------------------------------------------------------------------------
void Jitter(vtkUnstructuredGrid* grid, double amount, unsigned int seed)
{
  // std::uniform_real_distribution is not used: its values may differ between libraries.
  std::mt19937 random(seed);
  const auto draw = [&random, amount]() { return amount * (random() / 2147483648.0 - 1.0); };
  MapPoints(grid,
    [&draw](const glm::dvec3& at)
    {
      const double x = draw();
      const double y = draw();
      return at + glm::dvec3(x, y, draw());
    });
}

//------------------------------------------------------------------------------
void TransformPoints(vtkUnstructuredGrid* grid, const std::array<double, 3>& offset, double scale)
{
  MapPoints(grid,
    [&](const glm::dvec3& at)
    { return scale * (at + glm::dvec3(offset[0], offset[1], offset[2])); });
}

//------------------------------------------------------------------------------
Grid ReadMesh(const std::string& path)
{
  if (!std::ifstream(path).good())
  {
    return nullptr;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  Grid grid = reader->GetOutput();
  vtkPointData* data = grid->GetPointData();
  if (!data->GetScalars() && data->GetNumberOfArrays() > 0)
  {
    data->SetActiveScalars(data->GetArrayName(0));
  }
  return grid->GetNumberOfCells() > 0 ? grid : nullptr;
}

//------------------------------------------------------------------------------
Grid ReadDataMesh(const std::string& name)
{
  const char* folder = std::getenv("MENISCUS_DATA_DIR");
  return ReadMesh(std::string(folder ? folder : MENISCUS_DEFAULT_DATA_DIR) + "/" + name + ".vtu");
}

} // namespace meniscus::test

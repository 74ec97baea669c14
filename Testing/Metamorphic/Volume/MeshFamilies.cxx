// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFamilies.h"

#include "HardMeshes.h"

#include <vtkDelaunay3D.h>

namespace meniscus::test
{

namespace
{

using PointField = std::function<double(const glm::dvec3&)>;

// A field in about the box [-1, 1]^3: linear, waves, a peak, a radius, steps.
PointField RandomField(bool linear, RandomNumbers& random)
{
  const glm::dvec3 slope = random.Uniform(0.5, 2.0) * random.GetDirection();
  const glm::dvec3 place = 0.7 * random.GetDirection();
  const double frequency = random.Uniform(1.0, 5.0);
  const double base = random.Uniform(-1.0, 1.0);
  switch (linear ? 0 : random.Below(6))
  {
    case 0:
      return [=](const glm::dvec3& p) { return base + glm::dot(slope, p); };
    case 1:
      return [=](const glm::dvec3& p)
      { return base + std::sin(frequency * p.x) * std::cos(frequency * p.y) + 0.3 * p.z; };
    case 2:
      return [=](const glm::dvec3& p)
      {
        const double r = glm::distance(p, place);
        return base + 3.0 * std::exp(-4.0 * r * r);
      };
    case 3:
      return [=](const glm::dvec3& p) { return base + glm::distance(p, place); };
    case 4: // integer steps: cells without a gradient next to steep ones
      return [=](const glm::dvec3& p) { return std::floor(2.0 * glm::dot(slope, p)); };
    default: // nearly constant in large parts
      return [=](const glm::dvec3& p) { return std::tanh(6.0 * glm::dot(slope, p)); };
  }
}

MeshArrays RandomPoints(RandomNumbers& random)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const int count = 12 + random.Below(150);
  for (int i = 0; i < count; ++i)
  {
    const double x[3] = { random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1) };
    points->InsertNextPoint(x);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkDelaunay3D> delaunay;
  delaunay->SetInputData(cloud);
  delaunay->Update();
  MeshArrays mesh = ToArrays(delaunay->GetOutput());
  const auto isFlat = [](const auto& cell) { return cell.Type != VTK_TETRA; };
  mesh.Cells.erase(std::remove_if(mesh.Cells.begin(), mesh.Cells.end(), isFlat), mesh.Cells.end());
  return mesh;
}

// Cubes of a block: the corners of cube (i, j, k) in the order of VTK_HEXAHEDRON.
class CubeBlock
{
public:
  CubeBlock(int n)
    : N(n)
  {
    for (const auto& [k, j, i] : Product(n + 1, n + 1, n + 1))
    {
      this->Mesh.Points.push_back(2.0 / n * glm::dvec3(i, j, k) - 1.0);
    }
  }

  std::array<vtkIdType, 8> MakeCorners(int cube) const
  {
    const int i = cube % this->N;
    const int j = cube / this->N % this->N;
    const int k = cube / (this->N * this->N);
    const auto id = [this](int x, int y, int z)
    { return vtkIdType(x) + (this->N + 1) * (y + vtkIdType(this->N + 1) * z); };
    return { id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1),
      id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1) };
  }

  void AddHexahedron(int cube)
  {
    const auto c = this->MakeCorners(cube);
    this->Mesh.Cells.push_back({ VTK_HEXAHEDRON, { c.begin(), c.end() } });
  }

  void AddWedges(int cube)
  {
    const auto c = this->MakeCorners(cube);
    this->Mesh.Cells.push_back({ VTK_WEDGE, { c[0], c[1], c[2], c[4], c[5], c[6] } });
    this->Mesh.Cells.push_back({ VTK_WEDGE, { c[0], c[2], c[3], c[4], c[6], c[7] } });
  }

  void AddPyramids(int cube)
  {
    const auto c = this->MakeCorners(cube);
    glm::dvec3 middle(0.0);
    for (const vtkIdType id : c)
    {
      middle += 0.125 * this->Mesh.Points[static_cast<std::size_t>(id)];
    }
    const auto apex = static_cast<vtkIdType>(this->Mesh.Points.size());
    this->Mesh.Points.push_back(middle);
    const int bases[6][4] = { { 0, 1, 2, 3 }, { 4, 7, 6, 5 }, { 0, 4, 5, 1 }, { 1, 5, 6, 2 },
      { 2, 6, 7, 3 }, { 3, 7, 4, 0 } };
    for (const auto& b : bases)
    {
      this->Mesh.Cells.push_back({ VTK_PYRAMID, { c[b[0]], c[b[1]], c[b[2]], c[b[3]], apex } });
    }
  }

  int N;
  MeshArrays Mesh;
};

// Wedges in whole columns, so that their triangles match.
MeshArrays MakeCubes(MeshFamily family, RandomNumbers& random)
{
  const int n = 1 + random.Below(5);
  CubeBlock block(n);
  const bool holes = random.Below(4) == 0;
  std::vector<int> column(static_cast<std::size_t>(n * n));
  for (int& kind : column)
  {
    kind = random.Below(3);
  }
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    if (holes && cube > 0 && random.Below(4) == 0)
    {
      continue;
    }
    const bool wedges = column[static_cast<std::size_t>(cube % (n * n))] == 0;
    if (family == MeshFamily::Wedges || (family == MeshFamily::Mixed && wedges))
    {
      block.AddWedges(cube);
    }
    else if (family == MeshFamily::Pyramids || (family == MeshFamily::Mixed && random.Below(2)))
    {
      block.AddPyramids(cube);
    }
    else
    {
      block.AddHexahedron(cube);
    }
  }
  return block.Mesh;
}

// Moves points inside the box by up to a fraction of a cell.
void Shake(MeshArrays& mesh, double amount, RandomNumbers& random)
{
  for (glm::dvec3& p : mesh.Points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] += random.Uniform(-amount, amount);
    }
  }
}

// A random affine map about the origin that changes lengths by at most a factor of 2.
void Shear(MeshArrays& mesh, RandomNumbers& random)
{
  glm::dmat3 map(1.0);
  for (int column = 0; column < 3; ++column)
  {
    map[column] += 0.25 * random.GetDirection();
  }
  for (glm::dvec3& p : mesh.Points)
  {
    p = map * p;
  }
}

MeshArrays Graded(RandomNumbers& random)
{
  const int n = 4 + random.Below(5);
  const Grid grid = MakeBlock(n, ConstantField(0.0));
  Jitter(grid, 0.15 / n, static_cast<unsigned int>(random.Bits()));
  MeshArrays mesh = ToArrays(grid);
  // The size of the first of n cells is n^-power of the domain: down to 1 / 30,000.
  const double power = random.Uniform(1.5, std::log(3e4) / std::log(n));
  for (glm::dvec3& p : mesh.Points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double u = 0.5 * (p[axis] + 1.0);
      p[axis] = 2.0 * std::copysign(std::pow(std::fabs(u), power), u) - 1.0;
    }
  }
  return mesh;
}

MeshArrays Slivers(RandomNumbers& random)
{
  const int n = 3 + random.Below(4);
  if (random.Below(2))
  {
    return ToArrays(MakeLayeredBlock(n, std::pow(10.0, random.Uniform(-4.0, -1.0))));
  }
  const Grid grid = MakeBlock(n, ConstantField(0.0));
  Jitter(grid, 0.2 / n, static_cast<unsigned int>(random.Bits()));
  const int axis = random.Below(3);
  const double factor = std::pow(10.0, random.Uniform(-4.0, -1.0));
  MeshArrays mesh = ToArrays(grid);
  for (glm::dvec3& p : mesh.Points)
  {
    p[axis] *= factor;
  }
  return mesh;
}

MeshArrays GetParts(RandomNumbers& random)
{
  const Region regions[4] = { LShape(), Shell(0.4, 1.2), Torus(0.6, 0.35), TwoBlocks(0.6) };
  const int n = 5 + random.Below(4);
  const Grid grid = MakeBlock(n, ConstantField(0.0), regions[random.Below(4)]);
  Jitter(grid, 0.2 / n, static_cast<unsigned int>(random.Bits()));
  return ToArrays(grid);
}

// Moves the centre of the bounds to the origin and scales the longest side to 2.
void Normalise(MeshArrays& mesh)
{
  double b[6];
  mesh.GetBounds(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  const double side = std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] });
  for (glm::dvec3& p : mesh.Points)
  {
    p = 2.0 / side * (p - center);
  }
}

bool TakeData(FamilyMesh& result, RandomNumbers& random)
{
  const char* const names[3] = { "blunt_fin", "combustor", "crushed_can" };
  const char* const name = names[random.Below(3)];
  static std::map<std::string, Grid> read; // reading takes longer than drawing
  if (read.count(name) == 0)
  {
    read[name] = ReadDataMesh(name);
  }
  if (!read[name] || !read[name]->GetPointData()->GetScalars() ||
    read[name]->GetPointData()->GetScalars()->GetNumberOfComponents() != 1)
  {
    return false;
  }
  result.Name = name;
  result.Mesh = ToArrays(read[name]);
  Normalise(result.Mesh);
  return true;
}

const char* NameOf(MeshFamily family)
{
  const char* const names[] = { "random points", "hexahedra", "wedges", "pyramids", "mixed cells",
    "slivers", "graded", "parts", "random", "data" };
  return names[static_cast<int>(family)];
}

void MakeMesh(MeshFamily family, FamilyMesh& result, bool linear, RandomNumbers& random)
{
  switch (family)
  {
    case MeshFamily::Hexahedra:
    case MeshFamily::Wedges:
    case MeshFamily::Pyramids:
    case MeshFamily::Mixed:
      result.Mesh = MakeCubes(family, random);
      if (linear || random.Below(2))
      {
        Shear(result.Mesh, random);
      }
      else
      {
        // A cube split in five has 0.4; less than a sixth inverts no tetrahedron.
        Shake(result.Mesh, 0.06, random);
      }
      return;
    case MeshFamily::Slivers:
      result.Mesh = Slivers(random);
      return;
    case MeshFamily::Graded:
      result.Mesh = Graded(random);
      return;
    case MeshFamily::Parts:
      result.Mesh = GetParts(random);
      return;
    case MeshFamily::Random:
      result.Mesh = ToArrays(MakeRandomMesh(random));
      Normalise(result.Mesh);
      return;
    default:
      result.Mesh = RandomPoints(random);
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
void SetRandomFields(MeshArrays& mesh, int components, bool linear, RandomNumbers& random)
{
  std::vector<PointField> fields;
  for (int c = 0; c < components; ++c)
  {
    fields.push_back(RandomField(linear, random));
  }
  const double noise = !linear && random.Below(4) == 0 ? 0.5 : 0.0;
  mesh.Components = components;
  mesh.OnCells = false;
  mesh.Values.clear();
  for (const glm::dvec3& p : mesh.Points)
  {
    for (const PointField& field : fields)
    {
      mesh.Values.push_back(field(p) + noise * random.Uniform(-1.0, 1.0));
    }
  }
}

//------------------------------------------------------------------------------
void MoveToCells(MeshArrays& mesh)
{
  std::vector<double> values;
  for (const MeshCell& cell : mesh.Cells)
  {
    for (int c = 0; c < mesh.Components; ++c)
    {
      double sum = 0.0;
      for (const vtkIdType id : cell.Ids)
      {
        sum += mesh.GetValue(static_cast<std::size_t>(id), c);
      }
      values.push_back(sum / static_cast<double>(cell.Ids.size()));
    }
  }
  mesh.OnCells = true;
  mesh.Values = values;
}

//------------------------------------------------------------------------------
MeshFamily RandomFamily(RandomNumbers& random)
{
  return random.Below(30) == 0 ? MeshFamily::Data : static_cast<MeshFamily>(random.Below(9));
}

//------------------------------------------------------------------------------
FamilyMesh MakeFamilyMesh(MeshFamily family, bool linear, RandomNumbers& random)
{
  FamilyMesh result;
  result.Name = NameOf(family);
  result.Linear = linear;
  if (family == MeshFamily::Data && !linear && TakeData(result, random))
  {
    return result;
  }
  MakeMesh(family, result, linear, random);
  SetRandomFields(result.Mesh, 1, linear, random);
  return result;
}

} // namespace meniscus::test

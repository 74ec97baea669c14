// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChanges.h"
#include "VolumeRelation.h"

#include <vtkDataSetTriangleFilter.h>

namespace meniscus::test
{

namespace
{

CaseNeeds MakeTetrahedra(bool vertexGradients)
{
  CaseNeeds needs;
  needs.Tetrahedra = true;
  needs.NoVertexGradients = !vertexGradients;
  return needs;
}

CaseNeeds NoVertexGradients()
{
  CaseNeeds needs;
  needs.NoVertexGradients = true;
  return needs;
}

CaseNeeds MakeLinear()
{
  CaseNeeds needs;
  needs.Linear = true;
  return needs;
}

//------------------------------------------------------------------------------
void DoubleCells(VolumeCase& test, RandomNumbers& random)
{
  const MeshArrays before = test.MakeMesh();
  MeshArrays& mesh = test.MakeMesh();
  // A A B B, or everything twice, or some cells twice.
  const int kind = random.Below(3);
  if (kind == 0)
  {
    mesh.Cells.clear();
    mesh.Values = mesh.OnCells ? std::vector<double>() : mesh.Values;
  }
  for (std::size_t c = 0; c < before.Cells.size(); ++c)
  {
    if (kind == 2 && random.Below(3) > 0)
    {
      continue;
    }
    mesh.AddCell(before, c);
    if (kind == 0)
    {
      mesh.AddCell(before, c);
    }
  }
}

void DoubleAcrossBlocks(VolumeCase& test, RandomNumbers& random)
{
  test.Blocks = SplitMesh(test.MakeMesh(), 2, random);
  const MeshArrays second = test.Blocks.back();
  // Some cells of the second block, with their points, are added to the first one.
  MeshArrays& first = test.Blocks[0];
  const auto shift = static_cast<vtkIdType>(first.Points.size());
  for (std::size_t p = 0; p < second.Points.size(); ++p)
  {
    first.AddPoint(second, p);
  }
  for (std::size_t c = 0; c < second.Cells.size(); ++c)
  {
    if (random.Below(2))
    {
      first.AddCell(second, c);
      for (vtkIdType& id : first.Cells.back().Ids)
      {
        id += shift;
      }
    }
  }
}

//------------------------------------------------------------------------------
// Hexahedra and others converted to tetrahedra by VTK's filter, which uses its own rule.
void MakeTriangles(VolumeCase& test, RandomNumbers&)
{
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->SetInputData(ToGrid(test.MakeMesh()));
  filter->Update();
  test.MakeMesh() = ToArrays(filter->GetOutput());
}

// Adds cells that have no volume or cannot be drawn.
void AddUselessCells(VolumeCase& test, RandomNumbers& random)
{
  const MeshArrays before = test.MakeMesh();
  MeshArrays& mesh = test.MakeMesh();
  const auto points = static_cast<int>(before.Points.size());
  for (int i = 0; i < 10; ++i)
  {
    const vtkIdType a = random.Below(points);
    const vtkIdType b = random.Below(points);
    const vtkIdType c = random.Below(points);
    const MeshCell cells[5] = { { VTK_TRIANGLE, { a, b, c } }, { VTK_VERTEX, { a } },
      { VTK_LINE, { a, b } }, { VTK_QUAD, { a, b, c, a } }, { VTK_TETRA, { a, b, a, c } } };
    const auto at = static_cast<std::ptrdiff_t>(random.Below(static_cast<int>(mesh.Cells.size())));
    mesh.Cells.insert(mesh.Cells.begin() + at, cells[random.Below(5)]);
    if (mesh.OnCells)
    {
      mesh.Values.insert(
        mesh.Values.begin() + at * mesh.Components, std::size_t(mesh.Components), 0.5);
    }
  }
}

//------------------------------------------------------------------------------
// A function that ends with 0 above the data, so that larger values are invisible.
void EndInvisible(VolumeCase& test, RandomNumbers&)
{
  const auto range = test.MakeMesh().MakeRange(0);
  const double width = range[1] > range[0] ? range[1] - range[0] : 1.0;
  LookFunction& function = test.Look.Functions.front();
  while (!function.Opacity.empty() && function.Opacity.back().Scalar > range[1])
  {
    function.Opacity.pop_back();
  }
  function.Opacity.push_back({ range[1] + 0.01 * width, 0.7 });
  function.Opacity.push_back({ range[1] + 0.02 * width, 0.0 });
}

// A tetrahedron of fill values, or of NaN, next to the mesh or a few diagonals away.
void AddFilledCell(VolumeCase& test, RandomNumbers& random)
{
  MeshArrays& mesh = test.MakeMesh();
  double b[6];
  mesh.GetBounds(b);
  const double diagonal = DiagonalOf(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  const glm::dvec3 place = center + random.Uniform(0.6, 1.0) * diagonal * random.GetDirection();
  const double fills[6] = { 1e3, 1e6, 1e10, 1e20, 9.97e36,
    std::numeric_limits<double>::quiet_NaN() };
  const double fill = fills[random.Below(6)];
  MeshCell cell;
  for (int i = 0; i < 4; ++i)
  {
    cell.Ids.push_back(static_cast<vtkIdType>(mesh.Points.size()));
    mesh.Points.push_back(place + 0.05 * diagonal * random.GetDirection());
    mesh.Values.insert(mesh.Values.end(), std::size_t(mesh.OnCells ? 0 : mesh.Components), fill);
  }
  mesh.Cells.push_back(cell);
  mesh.Values.insert(mesh.Values.end(), std::size_t(mesh.OnCells ? mesh.Components : 0), fill);
}

//------------------------------------------------------------------------------
// Largest opacity of a function over a range of scalars: at its ends and at points between them.
double LargestOpacity(const LookFunction& function, double low, double high)
{
  const auto& points = function.Opacity;
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    // A piece that the range touches, or the part outside the outer points.
    const double begin = i == 0 ? -HUGE_VAL : points[i - 1].Scalar;
    const double end = i + 1 == points.size() ? HUGE_VAL : points[i + 1].Scalar;
    largest = begin <= high && end >= low ? std::max(largest, points[i].Opacity) : largest;
  }
  return largest;
}

void RemoveInvisibleCells(VolumeCase& test, RandomNumbers&)
{
  const MeshArrays before = test.MakeMesh();
  MeshArrays& mesh = test.MakeMesh();
  mesh.Cells.clear();
  mesh.Values = mesh.OnCells ? std::vector<double>() : mesh.Values;
  for (std::size_t c = 0; c < before.Cells.size(); ++c)
  {
    double low = before.OnCells ? before.GetValue(c, 0) : HUGE_VAL;
    double high = before.OnCells ? before.GetValue(c, 0) : -HUGE_VAL;
    for (const vtkIdType id : before.Cells[c].Ids)
    {
      if (!before.OnCells)
      {
        low = std::min(low, before.GetValue(static_cast<std::size_t>(id), 0));
        high = std::max(high, before.GetValue(static_cast<std::size_t>(id), 0));
      }
    }
    if (LargestOpacity(test.Look.Functions.front(), low, high) > 0.0)
    {
      mesh.AddCell(before, c);
    }
  }
}

//------------------------------------------------------------------------------
// Compares cells marked as ghosts with the same mesh without them.
void CheckGhosts(VolumeTrial& trial)
{
  VolumeCase changed = trial.MakeScene();
  const MeshArrays before = changed.MakeMesh();
  // More cells than the scene has: some are repeated with an offset, all as ghosts.
  MeshArrays& mesh = changed.MakeMesh();
  const std::size_t real = mesh.Cells.size();
  for (int i = 0; i < 20; ++i)
  {
    const auto c = static_cast<std::size_t>(trial.MakeRandom().Below(static_cast<int>(real)));
    mesh.AddCell(before, c);
    for (vtkIdType& id : mesh.Cells.back().Ids)
    {
      id = mesh.AddPoint(before, static_cast<std::size_t>(id));
      mesh.Points.back() += glm::dvec3(0.1, 0.2, 0.05);
    }
  }
  trial.MakePicture();
  trial.GetStage().GetPlace(changed);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(static_cast<vtkIdType>(mesh.Cells.size()));
  for (vtkIdType c = 0; c < ghosts->GetNumberOfTuples(); ++c)
  {
    const unsigned char kinds[2] = { vtkDataSetAttributes::DUPLICATECELL,
      vtkDataSetAttributes::HIDDENCELL };
    ghosts->SetValue(c, c < vtkIdType(real) ? 0 : kinds[trial.MakeRandom().Below(2)]);
  }
  trial.GetStage().MakeGrid()->GetCellData()->AddArray(ghosts);
  trial.ExpectSame(trial.GetStage().Render(), "ghost cells");
}

//------------------------------------------------------------------------------
// A rectilinear grid converted to hexahedra or voxels.
void MakeRectilinear(VolumeCase& test, RandomNumbers& random)
{
  const MeshArrays old = test.MakeMesh();
  test.MakeMesh() = MakeRectilinearCells(random);
  SetRandomFieldsLike(test.MakeMesh(), old, random);
}

void CheckRectilinear(VolumeTrial& trial)
{
  trial.MakePicture();
  trial.GetStage().GetPlace(trial.MakeScene());
  trial.GetStage().SetInput(ToRectilinear(trial.MakeScene().MakeMesh()));
  trial.ExpectSame(trial.GetStage().Render(), "rectilinear grid");
}

// Isosurfaces that run through vertices.
void TakeValuesOfVertices(VolumeCase& test, RandomNumbers& random)
{
  test.Look.Blend = vtkVolumeMapper::ISOSURFACE_BLEND;
  test.Look.IsoValues.clear();
  for (int i = 1 + random.Below(3); i > 0; --i)
  {
    const auto vertex = random.Below(static_cast<int>(test.MakeMesh().Tuples()));
    test.Look.IsoValues.push_back(test.MakeMesh().GetValue(static_cast<std::size_t>(vertex), 0));
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<VolumeRelation> MeshRelations()
{
  CaseNeeds vertexValues;
  vertexValues.Tetrahedra = true;
  vertexValues.OneComponent = true;
  vertexValues.NoCellData = true;
  vertexValues.NoGradients = true;
  CaseNeeds opaqueOutside = NoVertexGradients();
  opaqueOutside.Composite = true;
  opaqueOutside.OneComponent = true;
  CaseNeeds linearTetrahedra = MakeLinear();
  linearTetrahedra.Tetrahedra = true;
  CaseNeeds divisible = MakeTetrahedra(false);
  divisible.Small = true;
  CaseNeeds free = NoVertexGradients();
  free.Small = true;
  free.NoFolds = true;
  CaseNeeds noFolds = NoVertexGradients();
  noFolds.NoFolds = true;
  const auto divided = [](int parts) {
    return [parts](VolumeCase& test, RandomNumbers&) { DivideTetrahedra(test.MakeMesh(), parts); };
  };
  return {
    RelationOf("order of cells", 3, CaseNeeds(),
      [](VolumeCase& test, RandomNumbers& random) { ShuffleCells(test.MakeMesh(), random); }),
    RelationOf("orientation of cells", 3, MakeTetrahedra(true),
      [](VolumeCase& test, RandomNumbers& random) { TurnCells(test.MakeMesh(), random); }),
    RelationOf("order of points", 3, MakeTetrahedra(true),
      [](VolumeCase& test, RandomNumbers& random) { ShufflePoints(test.MakeMesh(), random); }),
    RelationOf("order of points, linear", 3, MakeLinear(),
      [](VolumeCase& test, RandomNumbers& random) { ShufflePoints(test.MakeMesh(), random); }),
    { "order of points and cells, isovalues of vertices", 4, vertexValues,
      [](VolumeTrial& trial)
      {
        VolumeCase changed = trial.MakeScene();
        ShufflePoints(changed.MakeMesh(), trial.MakeRandom());
        ShuffleCells(changed.MakeMesh(), trial.MakeRandom());
        trial.ExpectSame(changed, "isovalues of vertices");
      },
      TakeValuesOfVertices },
    RelationOf("points of no cell", 2, CaseNeeds(),
      [](VolumeCase& test, RandomNumbers& random) { AddIdlePoints(test.MakeMesh(), random); }),
    RelationOf("points given per cell", 4, noFolds,
      [](VolumeCase& test, RandomNumbers&) { UnsharePoints(test.MakeMesh()); }),
    RelationOf("cells doubled", 4, NoVertexGradients(), DoubleCells),
    RelationOf("cells doubled across blocks", 4, free, DoubleAcrossBlocks),
    RelationOf("blocks", 4, noFolds,
      [](VolumeCase& test, RandomNumbers& random)
      { test.Blocks = SplitMesh(test.MakeMesh(), 2 + random.Below(4), random); }),
    RelationOf("blocks appended", 3, noFolds,
      [](VolumeCase& test, RandomNumbers& random)
      { test.Blocks = { AppendMeshes(SplitMesh(test.MakeMesh(), 2 + random.Below(4), random)) }; }),
    RelationOf("tetrahedra in 4", 3, divisible, divided(4)),
    RelationOf("tetrahedra in 8", 3, divisible, divided(8)),
    RelationOf("tetrahedra in 8, linear", 2, linearTetrahedra, divided(8)),
    RelationOf("cells as VTK's tetrahedra", 4, MakeLinear(), MakeTriangles),
    RelationOf("second-order cells", 3, MakeLinear(),
      [](VolumeCase& test, RandomNumbers& random) { MakeQuadratic(test.MakeMesh(), random); }),
    RelationOf("cells without a volume", 3, NoVertexGradients(), AddUselessCells),
    { "a cell of fill values", 6, opaqueOutside,
      [](VolumeTrial& trial)
      {
        VolumeCase changed = trial.MakeScene();
        AddFilledCell(changed, trial.MakeRandom());
        trial.ExpectSame(changed, "a cell of fill values");
      },
      EndInvisible },
    RelationOf("invisible cells removed", 3, opaqueOutside, RemoveInvisibleCells),
    { "ghost cells", 3, NoVertexGradients(), CheckGhosts, nullptr },
    { "rectilinear grid", 3, free, CheckRectilinear, MakeRectilinear },
  };
}

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChanges.h"
#include "VolumeRelation.h"

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace test
{

namespace
{

CaseNeeds tetrahedra(bool vertexGradients)
{
  CaseNeeds needs;
  needs.Tetrahedra = true;
  needs.NoVertexGradients = !vertexGradients;
  return needs;
}

CaseNeeds noVertexGradients()
{
  CaseNeeds needs;
  needs.NoVertexGradients = true;
  return needs;
}

CaseNeeds linear()
{
  CaseNeeds needs;
  needs.Linear = true;
  return needs;
}

//------------------------------------------------------------------------------
void doubleCells(VolumeCase& test, RandomNumbers& random)
{
  const MeshArrays before = test.mesh();
  MeshArrays& mesh = test.mesh();
  // A A B B, or everything twice, or some cells twice.
  const int kind = random.below(3);
  if (kind == 0)
  {
    mesh.Cells.clear();
    mesh.Values = mesh.OnCells ? std::vector<double>() : mesh.Values;
  }
  for (std::size_t c = 0; c < before.Cells.size(); ++c)
  {
    if (kind == 2 && random.below(3) > 0)
    {
      continue;
    }
    mesh.addCell(before, c);
    if (kind == 0)
    {
      mesh.addCell(before, c);
    }
  }
}

void doubleAcrossBlocks(VolumeCase& test, RandomNumbers& random)
{
  test.Blocks = splitMesh(test.mesh(), 2, random);
  const MeshArrays second = test.Blocks.back();
  // Some cells of the second block, with their points, are added to the first one.
  MeshArrays& first = test.Blocks[0];
  const auto shift = static_cast<vtkIdType>(first.Points.size());
  for (std::size_t p = 0; p < second.Points.size(); ++p)
  {
    first.addPoint(second, p);
  }
  for (std::size_t c = 0; c < second.Cells.size(); ++c)
  {
    if (random.below(2))
    {
      first.addCell(second, c);
      for (vtkIdType& id : first.Cells.back().Ids)
      {
        id += shift;
      }
    }
  }
}

//------------------------------------------------------------------------------
// Hexahedra and others converted to tetrahedra by VTK's filter, which uses its own rule.
void triangulate(VolumeCase& test, RandomNumbers&)
{
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->SetInputData(toGrid(test.mesh()));
  filter->Update();
  test.mesh() = toArrays(filter->GetOutput());
}

// Adds cells that have no volume or cannot be drawn.
void addUselessCells(VolumeCase& test, RandomNumbers& random)
{
  const MeshArrays before = test.mesh();
  MeshArrays& mesh = test.mesh();
  const auto points = static_cast<int>(before.Points.size());
  for (int i = 0; i < 10; ++i)
  {
    const vtkIdType a = random.below(points);
    const vtkIdType b = random.below(points);
    const vtkIdType c = random.below(points);
    const MeshCell cells[5] = { { VTK_TRIANGLE, { a, b, c } }, { VTK_VERTEX, { a } },
      { VTK_LINE, { a, b } }, { VTK_QUAD, { a, b, c, a } }, { VTK_TETRA, { a, b, a, c } } };
    const auto at = static_cast<std::ptrdiff_t>(random.below(static_cast<int>(mesh.Cells.size())));
    mesh.Cells.insert(mesh.Cells.begin() + at, cells[random.below(5)]);
    if (mesh.OnCells)
    {
      mesh.Values.insert(
        mesh.Values.begin() + at * mesh.Components, std::size_t(mesh.Components), 0.5);
    }
  }
}

//------------------------------------------------------------------------------
// A function that ends with 0 above the data, so that larger values are invisible.
void endInvisible(VolumeCase& test, RandomNumbers&)
{
  const auto range = test.mesh().range(0);
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
void addFilledCell(VolumeCase& test, RandomNumbers& random)
{
  MeshArrays& mesh = test.mesh();
  double b[6];
  mesh.bounds(b);
  const double diagonal = diagonalOf(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  const glm::dvec3 place = center + random.uniform(0.6, 1.0) * diagonal * random.direction();
  const double fills[6] = { 1e3, 1e6, 1e10, 1e20, 9.97e36,
    std::numeric_limits<double>::quiet_NaN() };
  const double fill = fills[random.below(6)];
  MeshCell cell;
  for (int i = 0; i < 4; ++i)
  {
    cell.Ids.push_back(static_cast<vtkIdType>(mesh.Points.size()));
    mesh.Points.push_back(place + 0.05 * diagonal * random.direction());
    mesh.Values.insert(mesh.Values.end(), std::size_t(mesh.OnCells ? 0 : mesh.Components), fill);
  }
  mesh.Cells.push_back(cell);
  mesh.Values.insert(mesh.Values.end(), std::size_t(mesh.OnCells ? mesh.Components : 0), fill);
}

//------------------------------------------------------------------------------
// Largest opacity of a function over a range of scalars: at its ends and at points between them.
double largestOpacity(const LookFunction& function, double low, double high)
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

void removeInvisibleCells(VolumeCase& test, RandomNumbers&)
{
  const MeshArrays before = test.mesh();
  MeshArrays& mesh = test.mesh();
  mesh.Cells.clear();
  mesh.Values = mesh.OnCells ? std::vector<double>() : mesh.Values;
  for (std::size_t c = 0; c < before.Cells.size(); ++c)
  {
    double low = before.OnCells ? before.value(c, 0) : HUGE_VAL;
    double high = before.OnCells ? before.value(c, 0) : -HUGE_VAL;
    for (const vtkIdType id : before.Cells[c].Ids)
    {
      if (!before.OnCells)
      {
        low = std::min(low, before.value(static_cast<std::size_t>(id), 0));
        high = std::max(high, before.value(static_cast<std::size_t>(id), 0));
      }
    }
    if (largestOpacity(test.Look.Functions.front(), low, high) > 0.0)
    {
      mesh.addCell(before, c);
    }
  }
}

//------------------------------------------------------------------------------
// Compares cells marked as ghosts with the same mesh without them.
void checkGhosts(VolumeTrial& trial)
{
  VolumeCase changed = trial.scene();
  const MeshArrays before = changed.mesh();
  // More cells than the scene has: some are repeated with an offset, all as ghosts.
  MeshArrays& mesh = changed.mesh();
  const std::size_t real = mesh.Cells.size();
  for (int i = 0; i < 20; ++i)
  {
    const auto c = static_cast<std::size_t>(trial.random().below(static_cast<int>(real)));
    mesh.addCell(before, c);
    for (vtkIdType& id : mesh.Cells.back().Ids)
    {
      id = mesh.addPoint(before, static_cast<std::size_t>(id));
      mesh.Points.back() += glm::dvec3(0.1, 0.2, 0.05);
    }
  }
  trial.picture();
  trial.stage().place(changed);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(static_cast<vtkIdType>(mesh.Cells.size()));
  for (vtkIdType c = 0; c < ghosts->GetNumberOfTuples(); ++c)
  {
    const unsigned char kinds[2] = { vtkDataSetAttributes::DUPLICATECELL,
      vtkDataSetAttributes::HIDDENCELL };
    ghosts->SetValue(c, c < vtkIdType(real) ? 0 : kinds[trial.random().below(2)]);
  }
  trial.stage().grid()->GetCellData()->AddArray(ghosts);
  trial.expectSame(trial.stage().render(), "ghost cells");
}

//------------------------------------------------------------------------------
// A rectilinear grid converted to hexahedra or voxels.
void makeRectilinear(VolumeCase& test, RandomNumbers& random)
{
  const MeshArrays old = test.mesh();
  test.mesh() = makeRectilinearCells(random);
  setRandomFieldsLike(test.mesh(), old, random);
}

void checkRectilinear(VolumeTrial& trial)
{
  trial.picture();
  trial.stage().place(trial.scene());
  trial.stage().setInput(toRectilinear(trial.scene().mesh()));
  trial.expectSame(trial.stage().render(), "rectilinear grid");
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<VolumeRelation> meshRelations()
{
  CaseNeeds opaqueOutside = noVertexGradients();
  opaqueOutside.Composite = true;
  opaqueOutside.OneComponent = true;
  CaseNeeds linearTetrahedra = linear();
  linearTetrahedra.Tetrahedra = true;
  CaseNeeds divisible = tetrahedra(false);
  divisible.Small = true;
  CaseNeeds free = noVertexGradients();
  free.Small = true;
  const auto divided = [](int parts)
  { return [parts](VolumeCase& test, RandomNumbers&) { divideTetrahedra(test.mesh(), parts); }; };
  return {
    relationOf("order of cells", 3, CaseNeeds(),
      [](VolumeCase& test, RandomNumbers& random) { shuffleCells(test.mesh(), random); }),
    relationOf("orientation of cells", 3, tetrahedra(true),
      [](VolumeCase& test, RandomNumbers& random) { turnCells(test.mesh(), random); }),
    relationOf("order of points", 3, tetrahedra(true),
      [](VolumeCase& test, RandomNumbers& random) { shufflePoints(test.mesh(), random); }),
    relationOf("order of points, linear", 3, linear(),
      [](VolumeCase& test, RandomNumbers& random) { shufflePoints(test.mesh(), random); }),
    relationOf("points of no cell", 2, CaseNeeds(),
      [](VolumeCase& test, RandomNumbers& random) { addIdlePoints(test.mesh(), random); }),
    relationOf("points given per cell", 4, noVertexGradients(),
      [](VolumeCase& test, RandomNumbers&) { unsharePoints(test.mesh()); }),
    relationOf("cells doubled", 4, noVertexGradients(), doubleCells),
    relationOf("cells doubled across blocks", 4, free, doubleAcrossBlocks),
    relationOf("blocks", 4, noVertexGradients(),
      [](VolumeCase& test, RandomNumbers& random)
      { test.Blocks = splitMesh(test.mesh(), 2 + random.below(4), random); }),
    relationOf("blocks appended", 3, noVertexGradients(),
      [](VolumeCase& test, RandomNumbers& random)
      { test.Blocks = { appendMeshes(splitMesh(test.mesh(), 2 + random.below(4), random)) }; }),
    relationOf("tetrahedra in 4", 3, divisible, divided(4)),
    relationOf("tetrahedra in 8", 3, divisible, divided(8)),
    relationOf("tetrahedra in 8, linear", 2, linearTetrahedra, divided(8)),
    relationOf("cells as VTK's tetrahedra", 4, linear(), triangulate),
    relationOf("second-order cells", 3, linear(),
      [](VolumeCase& test, RandomNumbers& random) { makeQuadratic(test.mesh(), random); }),
    relationOf("cells without a volume", 3, noVertexGradients(), addUselessCells),
    { "a cell of fill values", 6, opaqueOutside,
      [](VolumeTrial& trial)
      {
        VolumeCase changed = trial.scene();
        addFilledCell(changed, trial.random());
        trial.expectSame(changed, "a cell of fill values");
      },
      endInvisible },
    relationOf("invisible cells removed", 3, opaqueOutside, removeInvisibleCells),
    { "ghost cells", 3, noVertexGradients(), checkGhosts, nullptr },
    { "rectilinear grid", 3, free, checkRectilinear, makeRectilinear },
  };
}

} // namespace test
} // namespace meniscus

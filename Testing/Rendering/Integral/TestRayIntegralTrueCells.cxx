// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Adaptive division of cells: integrals through cells of all types compared with an integrator that
// evaluates the shape functions of the cell itself, in double precision.
#include "IntegralScene.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkGenericCell.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTransform.h>
#include <vtkUnstructuredGrid.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace meniscus::test;

namespace
{

const double NaN = std::numeric_limits<double>::quiet_NaN();

using Corners = std::vector<glm::dvec3>;

const Corners Hexahedron{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
  { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
const Corners Wedge{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 } };
const Corners Pyramid{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0.5, 1 } };
const Corners Tetrahedron{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };

struct CellCase
{
  std::string Name;
  int Type;
  vtkIdType Points;
  /** Random displacement of the points. Cells of high order take more pieces. */
  double Displacement = 0.02;
};

const CellCase Cases[] = { { "hexahedron", VTK_HEXAHEDRON, 8 }, { "wedge", VTK_WEDGE, 6 },
  { "pyramid", VTK_PYRAMID, 5 }, { "quadratic tetrahedron", VTK_QUADRATIC_TETRA, 10 },
  { "quadratic hexahedron", VTK_QUADRATIC_HEXAHEDRON, 20 },
  { "triquadratic hexahedron", VTK_TRIQUADRATIC_HEXAHEDRON, 27 },
  { "quadratic wedge", VTK_QUADRATIC_WEDGE, 15 },
  { "biquadratic wedge", VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18 },
  { "quadratic pyramid", VTK_QUADRATIC_PYRAMID, 13 },
  { "Lagrange tetrahedron of order 3", VTK_LAGRANGE_TETRAHEDRON, 20, 0.01 },
  { "Lagrange hexahedron of order 3", VTK_LAGRANGE_HEXAHEDRON, 64, 0.003 },
  { "Bezier tetrahedron of order 3", VTK_BEZIER_TETRAHEDRON, 20, 0.005 } };

/** A cell with points displaced at random in [-0.8, 0.8]^3, and the values of a cubic field. */
Grid MakeCell(const CellCase& shape, double displacement, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < shape.Points; ++i)
  {
    ids->InsertNextId(i);
  }
  // The points where the type expects them.
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(shape.Points);
  for (vtkIdType i = 0; i < shape.Points; ++i)
  {
    points->SetPoint(i, 0.0, 0.0, 0.0);
  }
  Grid grid = Grid::New();
  grid->SetPoints(points);
  grid->InsertNextCell(shape.Type, ids);
  vtkCell* cell = grid->GetCell(0);
  const double* places = cell->GetParametricCoords();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  for (vtkIdType i = 0; i < shape.Points; ++i)
  {
    glm::dvec3 place(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    if (shape.Type == VTK_PYRAMID || shape.Type == VTK_QUADRATIC_PYRAMID)
    {
      // Reference coordinates of pyramids are those of a cube with one side collapsed.
      place.x *= 1.0 - place.z;
      place.y *= 1.0 - place.z;
    }
    const glm::dvec3 moved = displacement * glm::dvec3(share(random), share(random), share(random));
    const glm::dvec3 at = 1.2 * (place - 0.4) + moved;
    points->SetPoint(i, at.x, at.y, at.z);
    // The larger the curved part, the more pieces: each halving of it takes a third of the time.
    const double curved = at.x * at.y + 0.5 * at.z * at.z * at.x;
    scalars->InsertNextValue(2.0 + at.x - 0.7 * at.y + 0.4 * at.z + 0.15 * curved);
  }
  grid->GetPointData()->SetScalars(scalars);
  return grid;
}

/** Integrates along rays through one cell by its shape functions, in double precision. */
class CellIntegrator
{
public:
  CellIntegrator(vtkUnstructuredGrid* grid, vtkIdType cell)
    : Scalars(grid->GetPointData()->GetScalars())
  {
    grid->GetCell(cell, this->Cell);
    this->Weights.resize(static_cast<std::size_t>(this->Cell->GetNumberOfPoints()));
    this->Corner = this->Cell->GetCellType() == VTK_HEXAHEDRON ? 0.5 : 0.25;
  }

  /** Scalar times length, and the length, in the cell. */
  glm::dvec2 Integrate(const WorldRay& ray)
  {
    // The cells lie within 2 of the origin, and the ray is parametrised from its nearest point.
    const double middle = -glm::dot(ray.Origin, ray.Direction);
    constexpr int samples = 80;
    constexpr int fine = 16;
    constexpr double half = 2.0;
    constexpr double step = 2.0 * half / samples;
    // Next to a side the ray may leave the cell and come back between two samples.
    constexpr double near = 0.1;
    glm::dvec2 sum(0.0);
    double begin = 0.0;
    double last = middle - half;
    double before = this->DepthInside(ray, last);
    for (int i = 1; i <= samples; ++i)
    {
      const double end = middle - half + step * i;
      const double there = this->DepthInside(ray, end);
      const int parts = std::min(std::abs(before), std::abs(there)) < near ? fine : 1;
      for (int part = 1; part <= parts; ++part)
      {
        const double s = end - step * (parts - part) / parts;
        const double now = part == parts ? there : this->DepthInside(ray, s);
        if (before < 0.0 && now >= 0.0)
        {
          begin = this->FindEnd(ray, last, s);
        }
        else if (before >= 0.0 && now < 0.0)
        {
          sum += this->Sum(ray, begin, this->FindEnd(ray, s, last));
        }
        before = now;
        last = s;
      }
    }
    return sum;
  }

private:
  glm::dvec3 Position(const glm::dvec3& place)
  {
    this->Weigh(place);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < this->Weights.size(); ++i)
    {
      double at[3];
      this->Cell->GetPoints()->GetPoint(static_cast<vtkIdType>(i), at);
      sum += this->Weights[i] * glm::dvec3(at[0], at[1], at[2]);
    }
    return sum;
  }
  void Weigh(const glm::dvec3& place)
  {
    const double at[3] = { place.x, place.y, place.z };
    this->Cell->InterpolateFunctions(at, this->Weights.data());
  }

  /** Finds the parametric coordinates of a point of the ray by Newton's method. */
  bool Invert(const WorldRay& ray, double s)
  {
    const glm::dvec3 target = ray.Origin + s * ray.Direction;
    glm::dvec3 place(this->Corner);
    for (int i = 0; i < 60; ++i)
    {
      const glm::dvec3 miss = target - this->Position(place);
      constexpr double h = 1e-5;
      glm::dmat3 slope;
      for (int axis = 0; axis < 3; ++axis)
      {
        glm::dvec3 step(0.0);
        step[axis] = h;
        slope[axis] = (this->Position(place + step) - this->Position(place - step)) / (2.0 * h);
      }
      glm::dvec3 move = glm::inverse(slope) * miss;
      const double length = glm::length(move);
      move *= length > 0.3 ? 0.3 / length : 1.0;
      place += move;
      if (!(length < 1e3))
      {
        return false;
      }
      if (length < 1e-12)
      {
        this->Place = place;
        return true;
      }
    }
    return false;
  }

  /** Smallest distance from a side in parametric coordinates; negative outside. */
  double DepthInside(const WorldRay& ray, double s)
  {
    if (!this->Invert(ray, s))
    {
      return -1.0;
    }
    const glm::dvec3& p = this->Place;
    double depth = std::min({ p.x, p.y, p.z });
    switch (this->Cell->GetCellType())
    {
      case VTK_HEXAHEDRON:
      case VTK_QUADRATIC_HEXAHEDRON:
      case VTK_TRIQUADRATIC_HEXAHEDRON:
      case VTK_LAGRANGE_HEXAHEDRON:
      case VTK_PYRAMID:
      case VTK_QUADRATIC_PYRAMID:
        return std::min({ depth, 1.0 - p.x, 1.0 - p.y, 1.0 - p.z });
      case VTK_WEDGE:
      case VTK_QUADRATIC_WEDGE:
      case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
        return std::min({ depth, 1.0 - p.x - p.y, 1.0 - p.z });
      default:
        return std::min(depth, 1.0 - p.x - p.y - p.z);
    }
  }

  /** The end of the stretch between a place outside and one inside. */
  double FindEnd(const WorldRay& ray, double outside, double inside)
  {
    for (int i = 0; i < 36; ++i)
    {
      const double middle = 0.5 * (outside + inside);
      (this->DepthInside(ray, middle) >= 0.0 ? inside : outside) = middle;
    }
    return inside;
  }

  /** Gauss' rule of three points in panels. */
  glm::dvec2 Sum(const WorldRay& ray, double begin, double end)
  {
    constexpr int panels = 4;
    constexpr double nodes[3] = { -0.7745966692414834, 0.0, 0.7745966692414834 };
    constexpr double weights[3] = { 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
    const double width = (end - begin) / panels;
    double sum = 0.0;
    for (int panel = 0; panel < panels; ++panel)
    {
      for (int i = 0; i < 3; ++i)
      {
        EXPECT_TRUE(this->Invert(ray, begin + width * (panel + 0.5 + 0.5 * nodes[i])));
        this->Weigh(this->Place);
        double value = 0.0;
        for (std::size_t k = 0; k < this->Weights.size(); ++k)
        {
          value += this->Weights[k] *
            this->Scalars->GetTuple1(this->Cell->GetPointId(static_cast<int>(k)));
        }
        sum += weights[i] * width * value;
      }
    }
    return { sum, end - begin };
  }

  vtkDataArray* Scalars;
  vtkNew<vtkGenericCell> Cell;
  std::vector<double> Weights;
  double Corner;
  glm::dvec3 Place{ 0.0 };
};

Filter MakeAdaptive(vtkDataObject* input, int size)
{
  Filter rays = MakeFilter(input, size, size);
  rays->ComputeIntegralOn();
  rays->ComputePathLengthOn();
  rays->SetCellDivisionToAdaptive();
  SetRectangle(rays, { 0.3, -0.5, -1.0 }, 1.2);
  return rays;
}

/** Adaptive division with tolerances that take few pieces, for tests of other things. */
Filter MakeCoarse(vtkDataObject* input, int size)
{
  Filter rays = MakeAdaptive(input, size);
  rays->SetDivisionPlaceTolerance(5e-3);
  rays->SetDivisionScalarTolerance(2e-2);
  return rays;
}

/** Truth of each pixel. */
std::vector<glm::dvec2> TruthOf(vtkTetrahedraRayIntegral* rays, vtkUnstructuredGrid* grid)
{
  std::vector<glm::dvec2> truth;
  CellIntegrator integrator(grid, 0);
  int size[2];
  rays->GetImageSize(size);
  for (int row = 0; row < size[1]; ++row)
  {
    for (int column = 0; column < size[0]; ++column)
    {
      truth.push_back(integrator.Integrate(RayOf(rays, column, row)));
    }
  }
  return truth;
}

/**
 * Largest difference of the integrals from the truth, divided by the largest truth. Rays with a
 * short way through the cell are skipped: where a ray touches a curved side, the length of its way
 * changes by the root of the displacement.
 */
double ErrorOf(vtkTetrahedraRayIntegral* rays, const std::vector<glm::dvec2>& truth)
{
  const std::vector<double> found = ValuesOf(rays, "Integral");
  glm::dvec2 most(0.0);
  for (const glm::dvec2& one : truth)
  {
    most = glm::max(most, one);
  }
  double worst = 0.0;
  int compared = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    if (truth[i].y > 0.5 * most.y)
    {
      worst = std::max(worst, std::abs(found[i] - truth[i].x));
      ++compared;
    }
  }
  EXPECT_GT(compared, 5);
  return worst / most.x;
}

/** n^3 cubes in [-1, 1]^3, each column of one cell type, with inner points moved. */
Grid MakeMixedBlock(int n, bool quadratic, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-0.2 / n, 0.2 / n);
  std::uniform_real_distribution<double> value(0.0, 1.0);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  const auto add = [&](glm::dvec3 at)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      at[axis] += std::abs(at[axis]) < 1.0 - 1e-9 ? move(random) : 0.0;
    }
    scalars->InsertNextValue(value(random));
    return points->InsertNextPoint(at.x, at.y, at.z);
  };
  std::vector<vtkIdType> corners;
  for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i)
  {
    corners.push_back(
      add(2.0 / n * glm::dvec3(i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1) / (n + 1)) - 1.0));
  }
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> middles;
  const auto middleOf = [&](vtkIdType a, vtkIdType b)
  {
    const auto key = std::minmax(a, b);
    auto found = middles.find(key);
    if (found == middles.end())
    {
      glm::dvec3 p[2];
      points->GetPoint(a, &p[0].x);
      points->GetPoint(b, &p[1].x);
      found = middles.emplace(key, add(0.5 * (p[0] + p[1]))).first;
    }
    return found->second;
  };
  Grid grid = Grid::New();
  grid->SetPoints(points);
  const auto addCell = [&](int linear, int curved, std::vector<vtkIdType> ids)
  {
    static const std::map<int, std::vector<std::pair<int, int>>> edges{
      { VTK_TETRA, { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 1, 3 }, { 2, 3 } } },
      { VTK_PYRAMID,
        { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 0, 4 }, { 1, 4 }, { 2, 4 }, { 3, 4 } } },
      { VTK_WEDGE,
        { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 3, 4 }, { 4, 5 }, { 5, 3 }, { 0, 3 }, { 1, 4 },
          { 2, 5 } } },
      { VTK_HEXAHEDRON,
        { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 4, 5 }, { 5, 6 }, { 6, 7 }, { 7, 4 }, { 0, 4 },
          { 1, 5 }, { 2, 6 }, { 3, 7 } } }
    };
    const std::vector<vtkIdType> ends = ids;
    for (const auto& edge : edges.at(linear))
    {
      if (quadratic)
      {
        ids.push_back(middleOf(
          ends[static_cast<std::size_t>(edge.first)], ends[static_cast<std::size_t>(edge.second)]));
      }
    }
    grid->InsertNextCell(
      quadratic ? curved : linear, static_cast<vtkIdType>(ids.size()), ids.data());
  };
  for (int c = 0; c < n * n * n; ++c)
  {
    vtkIdType h[8];
    for (std::size_t i = 0; i < 8; ++i)
    {
      const int x = c % n + static_cast<int>(Hexahedron[i].x);
      const int y = c / n % n + static_cast<int>(Hexahedron[i].y);
      const int z = c / n / n + static_cast<int>(Hexahedron[i].z);
      h[i] = corners[static_cast<std::size_t>((z * (n + 1) + y) * (n + 1) + x)];
    }
    // Columns along y: wedges share their triangles with wedges only.
    switch ((c % n + c / n / n) % 3)
    {
      case 0:
        addCell(VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, { h, h + 8 });
        break;
      case 1:
        addCell(VTK_WEDGE, VTK_QUADRATIC_WEDGE, { h[0], h[1], h[4], h[3], h[2], h[7] });
        addCell(VTK_WEDGE, VTK_QUADRATIC_WEDGE, { h[1], h[5], h[4], h[2], h[6], h[7] });
        break;
      default:
      {
        glm::dvec3 center(0.0);
        for (const vtkIdType id : h)
        {
          glm::dvec3 p;
          points->GetPoint(id, &p.x);
          center += p / 8.0;
        }
        const vtkIdType apex = add(center);
        for (const std::array<int, 4>& f : { std::array<int, 4>{ 0, 1, 2, 3 }, { 4, 7, 6, 5 },
               { 0, 4, 5, 1 }, { 3, 2, 6, 7 }, { 0, 3, 7, 4 }, { 1, 5, 6, 2 } })
        {
          addCell(VTK_PYRAMID, VTK_QUADRATIC_PYRAMID, { h[f[0]], h[f[1]], h[f[2]], h[f[3]], apex });
        }
      }
    }
  }
  grid->GetPointData()->SetScalars(scalars);
  return grid;
}

void ExpectOneError(vtkTetrahedraRayIntegral* rays, const std::string& text)
{
  vtkNew<ErrorObserver> observer;
  vtkNew<ErrorObserver> executive; // "Algorithm returned failure"
  observer->Observe(rays);
  executive->Observe(rays->GetExecutive());
  rays->Modified();
  rays->Update();
  ASSERT_EQ(observer->Errors.size(), 1u) << text << ": " << observer->GetText();
  EXPECT_NE(observer->Errors[0].find(text), std::string::npos) << observer->GetText();
  EXPECT_EQ(rays->GetOutput()->GetNumberOfPoints(), 0);
}

double SmoothField(const glm::dvec3& p)
{
  return 2.0 + 0.5 * p.x + 0.8 * p.z + 0.6 * std::sin(p.x + 0.5 * p.y - 0.7 * p.z);
}

vtkSmartPointer<vtkImageData> MakeImage(int n)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n + 1, n + 1, n + 1);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->SetSpacing(2.0 / n, 2.0 / n, 2.0 / n);
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 at;
    image->GetPoint(i, &at.x);
    scalars->InsertNextValue(SmoothField(at));
  }
  image->GetPointData()->SetScalars(scalars);
  return image;
}

/** Integral of the trilinear field of an image in [-1, 1]^3: a cubic in each voxel. */
double IntegrateImage(vtkImageData* image, int n, const WorldRay& ray)
{
  std::vector<double> cuts;
  double begin = -1e30;
  double end = 1e30;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double o = ray.Origin[axis];
    const double d = ray.Direction[axis];
    begin = std::max(begin, std::min((-1.0 - o) / d, (1.0 - o) / d));
    end = std::min(end, std::max((-1.0 - o) / d, (1.0 - o) / d));
    for (int i = 0; i <= n; ++i)
    {
      cuts.push_back((-1.0 + 2.0 * i / n - o) / d);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  const auto valueAt = [&](double s)
  {
    const glm::dvec3 at = 0.5 * n * (ray.Origin + s * ray.Direction + 1.0);
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(at)), 0, n - 1);
    const glm::dvec3 t = at - glm::dvec3(cell);
    double value = 0.0;
    for (const glm::dvec3& c : Hexahedron)
    {
      const glm::dvec3 w = c * t + (1.0 - c) * (1.0 - t);
      const glm::ivec3 p = cell + glm::ivec3(c);
      value += w.x * w.y * w.z *
        image->GetPointData()->GetScalars()->GetTuple1((p.z * (n + 1) + p.y) * (n + 1) + p.x);
    }
    return value;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    const double a = std::max(cuts[i], begin);
    const double b = std::min(cuts[i + 1], end);
    // Gauss' rule of two points is exact for cubics.
    const double offset = 0.5 * (b - a) / std::sqrt(3.0);
    sum += b > a
      ? 0.5 * (b - a) * (valueAt(0.5 * (a + b) - offset) + valueAt(0.5 * (a + b) + offset))
      : 0.0;
  }
  return sum;
}

void SetScalars(vtkDataSet* grid, const std::function<double(const glm::dvec3&)>& field)
{
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("s");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 at;
    grid->GetPoint(i, &at.x);
    scalars->InsertNextValue(field(at));
  }
  grid->GetPointData()->SetScalars(scalars);
}

}

class TrueCellTypes : public testing::TestWithParam<std::size_t>
{
};

TEST_P(TrueCellTypes, IntegralsFollowTheShapeFunctions)
{
  const CellCase& shape = Cases[GetParam()];
  const Grid grid = MakeCell(shape, shape.Displacement, 3);
  const Filter rays = MakeAdaptive(grid, 10);
  rays->Update();
  EXPECT_EQ(rays->GetNumberOfCellDivisions(), 1);
  EXPECT_EQ(rays->GetNumberOfFoldedCells(), 0);
  EXPECT_EQ(rays->GetNumberOfUnresolvedEdges(), 0);
  const std::vector<glm::dvec2> truth = TruthOf(rays, grid);
  const double adaptive = ErrorOf(rays, truth);
  // The error that is stated for the default tolerances.
  EXPECT_LE(adaptive, 1.0e-4);
  std::printf("%-34s %8lld tetrahedra, error %.2g", shape.Name.c_str(),
    static_cast<long long>(rays->GetNumberOfTetrahedra()), adaptive);
  rays->SetCellDivisionToFixed();
  rays->Update();
  // VTK's higher-order cells are not drawn without division.
  if (rays->GetOutput()->GetNumberOfPoints() > 0)
  {
    std::printf("; fixed %.2g", ErrorOf(rays, truth));
    EXPECT_GT(ErrorOf(rays, truth), 5.0 * adaptive);
  }
  std::printf("\n");
}

INSTANTIATE_TEST_SUITE_P(
  AllTypes, TrueCellTypes, testing::Range(std::size_t{ 0 }, std::size(Cases)));

TEST(TrueCells, TheErrorConvergesWithTheTolerances)
{
  for (const std::size_t i : { 0, 3, 9 })
  {
    const CellCase& shape = Cases[i];
    SCOPED_TRACE(shape.Name);
    const Grid grid = MakeCell(shape, 0.06, 5);
    const Filter rays = MakeAdaptive(grid, 12);
    rays->SetDivisionPlaceTolerance(0.1);
    rays->SetDivisionScalarTolerance(0.1);
    rays->Update();
    const std::vector<glm::dvec2> truth = TruthOf(rays, grid);
    double first = 0.0;
    double error = 0.0;
    for (const double tolerance : { 1.6e-2, 4e-3, 1e-3, 2.5e-4 })
    {
      rays->SetDivisionPlaceTolerance(0.25 * tolerance);
      rays->SetDivisionScalarTolerance(tolerance);
      rays->Update();
      error = ErrorOf(rays, truth);
      first = first == 0.0 ? error : first;
      std::printf("%-34s tolerance %.2g: %8lld tetrahedra, error %.2g\n", shape.Name.c_str(),
        tolerance, static_cast<long long>(rays->GetNumberOfTetrahedra()), error);
      // The displaced ends of a ray's way, which meets sides at an angle, and the value.
      EXPECT_LE(error, 4.0 * tolerance);
      EXPECT_EQ(rays->GetNumberOfUnresolvedEdges(), 0);
    }
    // First order in the tolerance, which is 64 times smaller in the end; that is second order in
    // the size of the pieces. Differences are between a quarter of the tolerance and all of it.
    EXPECT_LE(error, 4.0 / 64.0 * first);
  }
}

TEST(TrueCells, SmoothFieldsTakeFewPieces)
{
  constexpr int n = 32;
  const auto image = MakeImage(n);
  const Filter rays = MakeAdaptive(image, 40);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "s");
  rays->Update();
  const double pieces = static_cast<double>(rays->GetNumberOfTetrahedra()) / (6.0 * n * n * n);
  const auto truth = [&image](const WorldRay& ray) { return IntegrateImage(image, n, ray); };
  const double adaptive = WorstError(rays, "Integral", truth);
  rays->SetCellDivisionToFixed();
  rays->Update();
  const double fixed = WorstError(rays, "Integral", truth);
  std::printf("image of %d^3: %.2f times the tetrahedra, error %.2g, fixed %.2g\n", n, pieces,
    adaptive, fixed);
  EXPECT_GT(pieces, 1.0);
  EXPECT_LE(pieces, 4.0);
  EXPECT_LE(adaptive, 1.0e-4);
  EXPECT_LT(adaptive, fixed);
}

TEST(TrueCells, NeighboursOfAllTypesDoNotCrack)
{
  for (const bool quadratic : { false, true })
  {
    for (const unsigned int seed : { 1U, 2U })
    {
      const Grid grid = MakeMixedBlock(3, quadratic, seed);
      const Filter rays = MakeAdaptive(grid, 96);
      // So coarse that triangles of either side would lie far apart if they were not the same.
      rays->SetDivisionPlaceTolerance(4e-3);
      rays->SetDivisionScalarTolerance(0.1);
      rays->Update();
      EXPECT_GT(rays->GetNumberOfTetrahedra(), 500);
      EXPECT_EQ(rays->GetNumberOfLostRays(), 0);
      EXPECT_EQ(rays->GetNumberOfFoldedCells(), 0);
      // The sides are plane, so each ray's way is that in the cube: a crack would shorten it.
      ConvexSolid cube;
      for (int axis = 0; axis < 3; ++axis)
      {
        glm::dvec3 normal(0.0);
        normal[axis] = 1.0;
        cube.Planes.push_back({ normal, 1.0 });
        cube.Planes.push_back({ -normal, 1.0 });
      }
      EXPECT_LE(WorstError(rays, "PathLength",
                  [&cube](const WorldRay& ray) { return cube.Clip(ray).GetLength(); }),
        1.0e-6);
    }
  }
}

TEST(TrueCells, ScalarsAndPointsKeepTheDivision)
{
  const Grid grid = MakeMixedBlock(2, true, 9);
  SetScalars(grid, SmoothField);
  const Filter rays = MakeAdaptive(grid, 16);
  rays->SetDivisionPlaceTolerance(2e-3);
  rays->SetDivisionScalarTolerance(5e-3);
  rays->Update();
  const vtkTypeInt64 pieces = rays->GetNumberOfTetrahedra();
  EXPECT_EQ(rays->GetNumberOfUnresolvedEdges(), 0);
  rays->SetImageSize(24, 24);
  rays->Update();
  EXPECT_EQ(rays->GetNumberOfMeshBuilds(), 1);
  // New arrays of scalars, as a reader makes them.
  for (int step = 1; step <= 5; ++step)
  {
    SetScalars(grid, [step](const glm::dvec3& at) { return 1.0 + (1.0 + step) * SmoothField(at); });
    rays->Update();
    EXPECT_EQ(rays->GetNumberOfScalarUpdates(), 1 + step);
  }
  EXPECT_EQ(rays->GetNumberOfCellDivisions(), 1);
  EXPECT_EQ(rays->GetNumberOfMeshBuilds(), 1);
  // The same scalars from the start lead to the same pieces.
  const Filter fresh = MakeAdaptive(grid, 24);
  fresh->SetDivisionPlaceTolerance(2e-3);
  fresh->SetDivisionScalarTolerance(5e-3);
  fresh->Update();
  EXPECT_EQ(fresh->GetNumberOfTetrahedra(), pieces);
  EXPECT_EQ(ValuesOf(rays, "Integral"), ValuesOf(fresh, "Integral"));
  // Stretched points keep the division: the positions of all points are interpolated.
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double at[3];
    grid->GetPoint(i, at);
    grid->GetPoints()->SetPoint(i, 0.9 * at[0], 0.9 * at[1], 0.9 * at[2]);
  }
  grid->GetPoints()->Modified();
  rays->Update();
  fresh->Update();
  EXPECT_EQ(rays->GetNumberOfCellDivisions(), 1);
  EXPECT_EQ(rays->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(rays->GetNumberOfPointUpdates(), 1);
  const Filter moved = MakeAdaptive(grid, 24);
  moved->SetDivisionPlaceTolerance(2e-3);
  moved->SetDivisionScalarTolerance(5e-3);
  moved->Update();
  const std::vector<double> kept = ValuesOf(rays, "Integral");
  const std::vector<double> again = ValuesOf(moved, "Integral");
  const double most = *std::max_element(again.begin(), again.end());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    EXPECT_NEAR(kept[i], again[i], 5e-3 * most);
  }
  // Scalars of another shape exceed the tolerance.
  SetScalars(
    grid, [](const glm::dvec3& at) { return std::sin(9.0 * at.x) * std::cos(7.0 * at.z); });
  rays->Update();
  EXPECT_EQ(rays->GetNumberOfUnresolvedEdges(), 0);
  EXPECT_EQ(rays->GetNumberOfCellDivisions(), 2);
  EXPECT_EQ(rays->GetNumberOfMeshBuilds(), 2);
  // So do other tolerances.
  rays->SetDivisionScalarTolerance(1e-2);
  rays->Update();
  EXPECT_EQ(rays->GetNumberOfCellDivisions(), 3);
}

TEST(TrueCells, CellsOfTheInputAreKnown)
{
  const Grid grid = MakeMixedBlock(2, false, 4);
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("number");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    numbers->InsertNextValue(1.0 + static_cast<double>(c));
  }
  grid->GetCellData()->AddArray(numbers);
  const Filter rays = MakeCoarse(grid, 24);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "number");
  rays->ComputeMinimumOn();
  rays->ComputeMaximumOn();
  rays->Update();
  EXPECT_GT(rays->GetNumberOfTetrahedra(), 6 * 8);
  const double mostNumber = static_cast<double>(grid->GetNumberOfCells());
  for (const char* name : { "Minimum", "Maximum" })
  {
    for (const double value : ValuesOf(rays, name))
    {
      // Values are normalised in single precision, with the range of the numbers as unit.
      EXPECT_TRUE(std::isnan(value) || std::abs(value - std::round(value)) < 1e-5) << value;
      EXPECT_TRUE(std::isnan(value) || (value > 0.5 && value < mostNumber + 0.5)) << value;
    }
  }
}

TEST(TrueCells, BadSettingsAreErrors)
{
  const Grid grid = MakeCell(Cases[0], 0.05, 2);
  const Filter rays = MakeCoarse(grid, 8);
  for (const double bad : { 0.0, -1.0, NaN })
  {
    rays->SetDivisionScalarTolerance(bad);
    ExpectOneError(rays, "tolerances of the division of cells must be positive");
    rays->SetDivisionScalarTolerance(2e-2);
    rays->SetDivisionPlaceTolerance(bad);
    ExpectOneError(rays, "tolerances of the division of cells must be positive");
    rays->SetDivisionPlaceTolerance(5e-3);
  }
  rays->SetMaximumNumberOfPieces(10);
  ExpectOneError(rays, "takes more than 10 tetrahedra");
  rays->SetMaximumNumberOfPieces(1000000);
  rays->Update();
  EXPECT_GT(rays->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(TrueCells, OddCellsAreCounted)
{
  // Folded: one corner is pushed through the opposite one.
  Grid grid = MakeCell(Cases[0], 0.0, 2);
  const auto movePoint = [&grid](vtkIdType i, double x, double y, double z)
  {
    grid->GetPoints()->SetPoint(i, x, y, z);
    grid->GetPoints()->Modified();
  };
  movePoint(0, 0.7, 0.7, 0.7);
  Filter rays = MakeCoarse(grid, 16);
  vtkNew<ErrorObserver> observer;
  observer->Observe(rays);
  rays->Update();
  EXPECT_EQ(rays->GetNumberOfFoldedCells(), 1);
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_NE(observer->Warnings[0].find("1 cells are folded inside out"), std::string::npos)
    << observer->Warnings[0];
  // A point that is not finite, and a repeated one: linear, without the parts that cannot be drawn.
  for (const bool repeated : { false, true })
  {
    grid = MakeCell(Cases[0], 0.0, 2);
    vtkIdType ids[8] = { 0, 1, 2, 2, 4, 5, 6, 6 };
    if (repeated)
    {
      grid->GetCells()->ReplaceCellAtId(0, 8, ids);
      grid->Modified();
    }
    else
    {
      movePoint(5, NaN, 0.0, 0.0);
    }
    rays = MakeCoarse(grid, 16);
    vtkNew<ErrorObserver> quiet;
    quiet->Observe(rays);
    rays->Update();
    EXPECT_LE(rays->GetNumberOfTetrahedra(), 6);
    EXPECT_GT(rays->GetNumberOfTetrahedra(), 0);
    EXPECT_EQ(rays->GetNumberOfCellDivisions(), 0);
  }
  // A point out of range is not read.
  grid = MakeCell(Cases[0], 0.05, 2);
  const vtkIdType bad[8] = { 0, 1, 2, 3, 4, 5, 6, 1000000 };
  const vtkIdType good[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  grid->GetCells()->ReplaceCellAtId(0, 8, bad);
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, good);
  rays = MakeCoarse(grid, 16);
  vtkNew<ErrorObserver> third;
  third->Observe(rays);
  rays->Update();
  EXPECT_GT(rays->GetNumberOfRejectedCells(), 0);
  EXPECT_GT(rays->GetNumberOfTetrahedra(), 6);
  // A type without a volume is left out, and the others are drawn.
  grid = MakeCell(Cases[0], 0.05, 2);
  grid->InsertNextCell(VTK_QUAD, 4, good);
  rays = MakeCoarse(grid, 16);
  vtkNew<ErrorObserver> fourth;
  fourth->Observe(rays);
  rays->Update();
  ASSERT_EQ(fourth->Warnings.size(), 1u);
  EXPECT_NE(fourth->Warnings[0].find("1 vtkQuad"), std::string::npos) << fourth->Warnings[0];
  EXPECT_GT(rays->GetNumberOfTetrahedra(), 6);
}

TEST(TrueCells, LengthsOfInterpolatedVectorsAreDrawn)
{
  // A vector that turns along z: its length is 1 at the points and less between them.
  const Grid grid = MakeCell(Cases[0], 0.0, 2);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("v");
  vectors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < 8; ++i)
  {
    i < 4 ? vectors->InsertNextTuple3(1.0, 0.0, 0.0) : vectors->InsertNextTuple3(0.0, 2.0, 0.0);
  }
  grid->GetPointData()->AddArray(vectors);
  const Filter rays = MakeAdaptive(grid, 12);
  SetRectangle(rays, { 0.0, 0.0, -1.0 }, 0.3);
  rays->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "v");
  rays->SetArrayComponent(-1);
  rays->Update();
  // Integral over [0, 1] of sqrt((1 - t)^2 + 4 t^2), times the height of the cell.
  double truth = 0.0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i)
  {
    const double t = (i + 0.5) / steps;
    truth += 1.2 / steps * std::hypot(1.0 - t, 2.0 * t);
  }
  for (const double value : ValuesOf(rays, "Integral"))
  {
    EXPECT_NEAR(value, truth, 1e-4 * truth);
  }
}

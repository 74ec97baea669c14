// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Integrals along rays compared with other integrals: over the volume, from the opposite side, and
// through refracting interfaces.
#include "IntegralScene.h"
#include "MembraneScene.h"

#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>

using namespace meniscus::test;

namespace
{

constexpr double Tolerance = 1.0e-6;
/** Bound of the relative error of sums over the pixels of an image of 1024 x 1024. */
constexpr double VolumeTolerance = 1.0e-5;

double SumTimesArea(vtkTetrahedraRayIntegral* filter, const char* name)
{
  double sum = 0.0;
  for (const double value : ValuesOf(filter, name))
  {
    sum += value;
  }
  const double* spacing = filter->GetOutput()->GetSpacing();
  return sum * spacing[0] * spacing[1];
}

/** Relative errors of the two volume integrals, of the scalar and of 1. */
void ExpectVolume(vtkUnstructuredGrid* grid, double tolerance)
{
  Filter rays = MakeFilter(grid, 1024, 1024);
  rays->SetDirection(0.31, -0.47, -0.83);
  rays->SetViewUp(0.2, 1.0, 0.1);
  Enable(rays, { "Integral", "PathLength" });
  const double volume = IntegrateCells(grid, false);
  const double integral = IntegrateCells(grid, true);
  const double volumeError = SumTimesArea(rays, "PathLength") / volume - 1.0;
  const double integralError = SumTimesArea(rays, "Integral") / integral - 1.0;
  std::cout << grid->GetNumberOfCells() << " cells: relative error of the volume " << volumeError
            << ", of the integral " << integralError << ", lost rays "
            << rays->GetStatistic("NumberOfLostRays") << "\n";
  EXPECT_LT(std::abs(volumeError), tolerance);
  EXPECT_LT(std::abs(integralError), tolerance);
}

Grid MakeUnevenShell()
{
  Grid grid = MakeBlock(12, WavyField(2.0), Shell(0.4, 0.97));
  Jitter(grid, 0.02, 11);
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scalars->SetTuple1(i, 2.0 + scalars->GetTuple1(i));
  }
  return grid;
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralRelations, SumOfPixelsIsTheVolumeIntegral)
{
  ExpectVolume(MakeUnevenShell(), VolumeTolerance);
}

//------------------------------------------------------------------------------
// Meshes of the data folder whose cells do not overlap, up to two of the combustor.
TEST(RayIntegralRelations, SumOfPixelsOfDataMeshes)
{
  for (const char* name : { "blunt_fin", "combustor" })
  {
    Grid grid = ReadDataMesh(name);
    if (!grid)
    {
      GTEST_SKIP() << "no data meshes";
    }
    SCOPED_TRACE(name);
    std::cout << name << ": ";
    ExpectVolume(grid, VolumeTolerance);
  }
}

namespace
{

/** A tetrahedron as a convex solid, whatever its orientation. */
ConvexSolid MakeSolid(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkIdList* ids = grid->GetCell(cell)->GetPointIds();
  glm::dvec3 corners[4];
  for (int k = 0; k < 4; ++k)
  {
    const glm::dvec3 p = PointOf(grid, ids->GetId(k));
    corners[k] = { p[0], p[1], p[2] };
  }
  ConvexSolid solid;
  for (int k = 0; k < 4; ++k)
  {
    const glm::dvec3& a = corners[(k + 1) % 4];
    glm::dvec3 normal = glm::cross(corners[(k + 2) % 4] - a, corners[(k + 3) % 4] - a);
    normal = glm::dot(normal, corners[k] - a) > 0.0 ? -normal : normal;
    solid.Planes.push_back({ normal, glm::dot(normal, a) });
  }
  return solid;
}

/** Length of a ray's parts in all cells; infinite if parts overlap. */
double LengthInCells(const std::vector<ConvexSolid>& cells, const WorldRay& ray)
{
  std::vector<std::pair<double, double>> parts;
  for (const ConvexSolid& cell : cells)
  {
    const Stretch in = cell.Clip(ray);
    if (in.GetLength() > 0.0)
    {
      parts.emplace_back(in.Begin, in.End);
    }
  }
  std::sort(parts.begin(), parts.end());
  double length = 0.0;
  double overlap = 0.0;
  double reached = -1.0e30;
  for (const auto& part : parts)
  {
    length += part.second - part.first;
    overlap += std::max(0.0, std::min(reached, part.second) - part.first);
    reached = std::max(reached, part.second);
  }
  return overlap > 1.0e-9 * length ? HUGE_VAL : length;
}

}

//------------------------------------------------------------------------------
// Cells of the can are inverted and overlap where it is crushed; the other rays are compared.
TEST(RayIntegralRelations, PathLengthInAFoldedMesh)
{
  Grid grid = ReadDataMesh("crushed_can");
  if (!grid)
  {
    GTEST_SKIP() << "no data meshes";
  }
  std::vector<ConvexSolid> cells;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    cells.push_back(MakeSolid(grid, i));
  }
  constexpr int size = 20;
  const double* box = grid->GetBounds();
  const glm::dvec3 middle(
    0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]), 0.5 * (box[4] + box[5]));
  Filter rays = MakeFilter(grid, size, size);
  const double diagonal = DiagonalOf(box);
  SetRectangle(rays, { 0.31, -0.47, -0.83 }, 0.4 * diagonal);
  const glm::dvec3 origin =
    glm::dvec3(rays->GetFrameOrigin()[0], rays->GetFrameOrigin()[1], rays->GetFrameOrigin()[2]) +
    middle;
  rays->SetFrameOrigin(origin.x, origin.y, origin.z);
  rays->GetArraySelection()->EnableArray("PathLength");
  int met = 0;
  EXPECT_LT(WorstError(rays, "PathLength",
              [&](const WorldRay& ray)
              {
                const double length = LengthInCells(cells, ray);
                met += length > 0.0 && length < HUGE_VAL;
                return length;
              }),
    Tolerance);
  EXPECT_GT(met, size * size / 10);
}

//------------------------------------------------------------------------------
// The same lines in the other direction; the rectangle is mirrored, so rows run backwards.
TEST(RayIntegralRelations, OppositeViews)
{
  Grid grid = MakeUnevenShell();
  constexpr int size = 150;
  Filter there = MakeFilter(grid, size, size);
  Filter back = MakeFilter(grid, size, size);
  SetRectangle(there, { 0.4, -0.3, -1.0 }, 1.8);
  const double* origin = there->GetFrameOrigin();
  const double* axis1 = there->GetFrameAxis1();
  const double* axis2 = there->GetFrameAxis2();
  back->SetFrameModeToParallel();
  back->SetFrameOrigin(origin[0] + axis1[0], origin[1] + axis1[1], origin[2] + axis1[2]);
  back->SetFrameAxis1(-axis1[0], -axis1[1], -axis1[2]);
  back->SetFrameAxis2(axis2[0], axis2[1], axis2[2]);
  for (vtkTetrahedraRayIntegral* filter : { there.Get(), back.Get() })
  {
    Enable(filter,
      { "Integral", "PathLength", "FirstDepth", "LastDepth", "Minimum", "MinimumDepth", "Maximum",
        "MaximumDepth" });
  }
  const std::pair<const char*, const char*> same[] = { { "Integral", "Integral" },
    { "PathLength", "PathLength" }, { "Minimum", "Minimum" }, { "Maximum", "Maximum" } };
  const auto mirrored = [](std::size_t i) { return i / size * size + (size - 1 - i % size); };
  for (const auto& names : same)
  {
    const std::vector<double> a = ValuesOf(there, names.first);
    const std::vector<double> b = ValuesOf(back, names.second);
    ASSERT_EQ(a.size(), b.size());
    double largest = 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      const double other = b[mirrored(i)];
      ASSERT_EQ(std::isnan(a[i]), std::isnan(other)) << names.first;
      if (!std::isnan(a[i]))
      {
        largest = std::max(largest, std::abs(a[i]));
        worst = std::max(worst, std::abs(a[i] - other));
      }
    }
    EXPECT_LT(worst, Tolerance * largest) << names.first;
  }
  // Distances from the same plane.
  const std::vector<double> first = ValuesOf(there, "FirstDepth");
  const std::vector<double> last = ValuesOf(back, "LastDepth");
  int met = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    if (!std::isnan(first[i]))
    {
      ASSERT_NEAR(first[i], -last[mirrored(i)], Tolerance * 4.0);
      ++met;
    }
  }
  EXPECT_GT(met, size * size / 10);
}

namespace
{

double FieldAt(const glm::dvec3& p)
{
  return 3.0 + 0.8 * p.x - 0.6 * p.y + 0.5 * p.z;
}

ConvexSolid MakeBlockSolid()
{
  ConvexSolid box;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    box.Planes.push_back({ normal, 1.0 });
    box.Planes.push_back({ -normal, 1.0 });
  }
  return box;
}

/** Measurements of a ray up to and behind planes y = level, in closed form. */
struct PathTruth
{
  double Length = 0.0;
  double Integral = 0.0;
  double Last = 0.0;
};

struct PlaneInterface
{
  double Level;
  /** Index above over index below. */
  double Ratio;
};

PathTruth TracePlanes(WorldRay ray, const std::vector<PlaneInterface>& planes)
{
  const ConvexSolid block = MakeBlockSolid();
  PathTruth truth;
  double travelled = 0.0;
  for (std::size_t leg = 0; leg <= planes.size(); ++leg)
  {
    const double end =
      leg < planes.size() ? (planes[leg].Level - ray.Origin.y) / ray.Direction.y : 1.0e30;
    Stretch in = block.Clip(ray, leg == 0 ? -1.0e30 : 0.0);
    in.End = std::min(in.End, end);
    if (in.GetLength() > 0.0)
    {
      const glm::dvec3 a = ray.Origin + in.Begin * ray.Direction;
      const glm::dvec3 b = ray.Origin + in.End * ray.Direction;
      truth.Length += in.GetLength();
      truth.Integral += in.GetLength() * 0.5 * (FieldAt(a) + FieldAt(b));
      truth.Last = travelled + in.End;
    }
    if (leg < planes.size())
    {
      travelled += end;
      ray.Origin += end * ray.Direction;
      // Snell's law at a horizontal plane met from above.
      glm::dvec3 along = planes[leg].Ratio * glm::dvec3(ray.Direction.x, 0.0, ray.Direction.z);
      along.y = -std::sqrt(1.0 - glm::dot(along, along));
      ray.Direction = along;
    }
  }
  return truth;
}

void ExpectPlanes(vtkTetrahedraRayIntegral* rays, const std::vector<PlaneInterface>& planes)
{
  Enable(rays, { "Integral", "PathLength", "LastDepth" });
  EXPECT_LT(WorstError(rays, "PathLength",
              [&](const WorldRay& ray) { return TracePlanes(ray, planes).Length; }),
    Tolerance);
  EXPECT_LT(WorstError(rays, "Integral",
              [&](const WorldRay& ray) { return TracePlanes(ray, planes).Integral; }),
    Tolerance);
  EXPECT_LT(
    WorstError(rays, "LastDepth",
      [&](const WorldRay& ray)
      {
        const PathTruth truth = TracePlanes(ray, planes);
        return truth.Length > 1.0e-5 ? truth.Last : truth.Length > 0.0 ? HUGE_VAL : std::nan("");
      }),
    Tolerance);
  EXPECT_EQ(rays->GetStatistic("NumberOfLostRays"), 0);
}

Filter MakeThroughWater(vtkDataObject* block)
{
  Filter rays = MakeFilter(block, 97, 83);
  SetRectangle(rays, { 0.45, -1.0, -0.3 }, 1.6);
  return rays;
}

Field BlockField()
{
  return [](double x, double y, double z) { return FieldAt({ x, y, z }); };
}

}

//------------------------------------------------------------------------------
TEST(RayIntegralRelations, ThroughAPlane)
{
  Grid block = MakeBlock(4, BlockField());
  Filter rays = MakeThroughWater(block);
  rays->SetMembraneData(MakePlaneCase(0.25, 6.0, 3).Mesh);
  ExpectPlanes(rays, { { 0.25, 1.0 / 1.333 } });
  EXPECT_EQ(rays->GetStatistic("NumberOfMembraneBuilds"), 1);
}

//------------------------------------------------------------------------------
TEST(RayIntegralRelations, ThroughAPane)
{
  Grid block = MakeBlock(4, BlockField());
  Filter rays = MakeThroughWater(block);
  vtkNew<vtkRefractingInterfaceCollection> interfaces;
  for (const auto& media : { std::pair<double, double>{ 1.0, 1.52 }, { 1.52, 1.333 } })
  {
    vtkNew<vtkRefractingInterface> interface;
    interface->SetExteriorIndexOfRefraction(media.first);
    interface->SetInteriorIndexOfRefraction(media.second);
    interfaces->AddItem(interface);
  }
  rays->SetInterfaces(interfaces);
  rays->AddMembraneData(MakePlaneCase(0.4, 6.0, 3).Mesh);
  rays->AddMembraneData(MakePlaneCase(-0.1, 6.0, 3).Mesh);
  ExpectPlanes(rays, { { 0.4, 1.0 / 1.52 }, { -0.1, 1.52 / 1.333 } });
}

//------------------------------------------------------------------------------
// Light of a medium with constant attenuation and emission passes through both legs.
TEST(RayIntegralRelations, EmissionThroughAPlane)
{
  Grid block = MakeBlock(4, BlockField());
  for (const auto& constant : { std::pair<const char*, double>{ "mu", 0.7 }, { "light", 0.4 } })
  {
    block->GetPointData()->AddArray(
      MakeArray<vtkFloatArray>(constant.first, block->GetNumberOfPoints(), constant.second));
  }
  Filter rays = MakeThroughWater(block);
  rays->SetMembraneData(MakePlaneCase(0.25, 6.0, 3).Mesh);
  rays->GetArraySelection()->EnableArray("EnergyBins");
  rays->SetAttenuationArrayName("mu");
  rays->SetEmissionArrayName("light");
  EXPECT_LT(WorstError(rays, "EnergyBins",
              [](const WorldRay& ray)
              {
                const double depth = 0.7 * TracePlanes(ray, { { 0.25, 1.0 / 1.333 } }).Length;
                return std::exp(-depth) - 0.4 / 0.7 * std::expm1(-depth);
              }),
    Tolerance);
}

//------------------------------------------------------------------------------
// The blocks of a composite data set are one mesh.
TEST(RayIntegralRelations, CompositeInput)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 2; ++i)
  {
    Grid half = MakeBlock(2, BlockField());
    TransformPoints(half, { i == 0 ? -1.0 : 1.0, 0.0, 0.0 }, 0.5);
    blocks->SetBlock(i, half);
  }
  Filter rays = MakeFilter(blocks, 97, 83);
  SetRectangle(rays, { 0.2, -0.4, -1.0 }, 1.2);
  rays->GetArraySelection()->EnableArray("PathLength");
  ConvexSolid solid = MakeBlockSolid();
  for (ConvexSolid::Plane& plane : solid.Planes)
  {
    plane.Offset = plane.Normal.x != 0.0 ? 1.0 : 0.5;
  }
  EXPECT_LT(WorstError(rays, "PathLength",
              [&solid](const WorldRay& ray) { return solid.Clip(ray).GetLength(); }),
    Tolerance);
  EXPECT_EQ(rays->GetStatistic("NumberOfMeshBuilds"), 1);
}

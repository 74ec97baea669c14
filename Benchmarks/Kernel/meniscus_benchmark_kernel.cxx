// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Times of single parts of the kernel on one thread, by Google Benchmark: for changes of the code.
// The other programs compare whole frames with their peers.
#include "KernelMeshes.h"
#include "KernelPicture.h"
#include "MembraneMeshes.h"
#include "RefractionTestRandom.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Simd/InstructionSets.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Mesh/ScalarGradients.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketJob.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Cubes along an edge of the mesh: 82,944 cells. */
constexpr int Cubes = 24;
constexpr int Pixels = 256;

MeshArrays MakeArrays()
{
  MeshArrays arrays = KuhnGrid(Cubes);
  Jitter(arrays, 0.2 / Cubes, 1);
  return arrays;
}

/** Builds all tables of the mesh. */
void BuildMesh(benchmark::State& state)
{
  const MeshArrays arrays = MakeArrays();
  for (auto step : state)
  {
    TetrahedralMesh mesh;
    benchmark::DoNotOptimize(mesh.Build(arrays.View()));
  }
  const auto cells = static_cast<std::int64_t>(arrays.Cells.size() / 4);
  state.SetItemsProcessed(state.iterations() * cells);
}

/** Gradients of the vertices of a smooth field, as for light. Items are cells. */
void VertexGradients(benchmark::State& state)
{
  const MeshArrays arrays = MakeArrays();
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  std::vector<double> scalars;
  for (const std::int64_t point : mesh.GetSourcePoints())
  {
    const glm::dvec3 at = arrays.PointAt(point);
    scalars.push_back(at.x * at.y + at.z);
  }
  for (auto step : state)
  {
    benchmark::DoNotOptimize(ComputeVertexGradients(mesh, scalars, 1.0));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.GetCells().size()));
}

/** Optics of a frame. */
struct FrameKind
{
  const char* Name;
  BlendMode Mode;
  double Attenuation;
  bool IsLit;
  /** True for rays as in a mesh with small cells. */
  bool IsFine = false;
};

/** A frame: places the vertices, finds the entries and casts the rays. Items are cells crossed. */
void CastFrame(benchmark::State& state, InstructionSet set, const FrameKind& kind)
{
  const MeshArrays arrays = MakeArrays();
  PictureScene scene;
  scene.Mesh.Build(arrays.View());
  scene.Intervals = ConstantFunction(kind.Attenuation);
  for (const std::int64_t point : scene.Mesh.GetSourcePoints())
  {
    scene.Scalars.push_back(static_cast<float>(arrays.PointAt(point).z));
  }
  scene.Frame = FrameAlongZ(scene.Mesh, 0.55, Pixels);
  scene.Frame.SmallestCell = kind.IsFine ? 0.0 : 1.0;
  scene.Optics.Blending = kind.Mode;
  scene.Optics.TerminationTransmittance = 1.0f / 131072.0f; // the mapper's default
  const std::vector<double> scalars(scene.Scalars.begin(), scene.Scalars.end());
  const std::vector<glm::vec3> ofCells = ComputeCellGradients(scene.Mesh, scalars, 1.0);
  const std::vector<glm::vec3> ofVertices = ComputeVertexGradients(scene.Mesh, scalars, 1.0);
  scene.Optics.CellGradients = ofCells.data();
  SurfaceLighting lighting{ 0.1, 0.6, 0.3, 10.0, std::vector<RayCastLight>(1) };
  lighting.Lights[0].Position = glm::dvec4(0.6, 0.0, -0.8, 0.0);
  lighting.Lights[0].Diffuse = lighting.Lights[0].Specular = glm::dvec3(1.0);
  if (kind.IsLit)
  {
    scene.Optics.Lighting = &lighting;
    scene.Optics.VertexGradients = ofVertices.data();
  }
  std::int64_t cells = 0;
  for (auto step : state)
  {
    cells += CastPicture(scene, Pixels, set).Statistics.Steps;
  }
  state.SetItemsProcessed(cells);
}

/**
 * Rays that the density of a gas bends, one per pixel; each alone or in the lanes of a set. Items
 * are cells crossed.
 */
void BendRays(benchmark::State& state, bool isAlone, InstructionSet set)
{
  const MeshArrays arrays = MakeArrays();
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  std::vector<double> squares;
  for (const std::int64_t point : mesh.GetSourcePoints())
  {
    const glm::dvec3 at = arrays.PointAt(point);
    const double index = 1.0005 + 2.0e-4 * std::sin(6.0 * at.x) * std::cos(5.0 * at.y + at.z);
    squares.push_back(index * index);
  }
  BoundaryTree tree;
  tree.Build(mesh);
  const std::vector<EdgeTerms> terms = ComputeEdgeTerms(mesh, squares);
  GradedCellTable table;
  table.Build(mesh, squares, &terms);
  GradedMedium medium;
  medium.Mesh = &mesh;
  medium.Tree = &tree;
  medium.SquaredIndices = &squares;
  medium.Terms = &terms;
  medium.Table = isAlone ? nullptr : &table;
  const GradedRayWalk walk(medium);
  std::vector<GradedRay> rays;
  for (int i = 0; i < Pixels * Pixels; ++i)
  {
    const glm::dvec2 place(i % Pixels + 0.5, i / Pixels + 0.5);
    rays.push_back({ glm::dvec3(place * (2.0 / Pixels) - 1.0, -2.0), glm::dvec3(0.1, 0.05, 1.0) });
  }
  std::vector<GradedRayResult> results(rays.size());
  GradedRayStatistics statistics;
  for (auto step : state)
  {
    walk.WalkAll(rays, statistics, results.data(), set);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(statistics.Steps);
}

/** A membrane of waves with `cells` x `cells` x 2 facets, and an eye above it. */
void SetWaves(CurvedMembraneSolver& solver, int cells)
{
  solver.SetMembrane(reference::MakeWaves(200.0, cells, 2.0, 3.0).AsInput());
  solver.SetEye(glm::dvec3(20.0, 300.0, 10.0), 1.0, 1.333);
}

/** Points in random order below the waves, as x, y and z in turn. */
std::vector<double> MakePoints()
{
  constexpr std::size_t number = 16 * CurvedMembraneSolver::Chain;
  meniscus::test::Random random(5);
  std::vector<double> points;
  for (std::size_t i = 0; i < number; ++i)
  {
    const glm::dvec3 point = random.Point(glm::dvec3(-60.0), glm::dvec3(60.0, -10.0, 60.0));
    points.insert(points.end(), { point.x, point.y, point.z });
  }
  return points;
}

/** One image of each point. */
void SolvePoints(benchmark::State& state)
{
  CurvedMembraneSolver solver;
  SetWaves(solver, static_cast<int>(state.range(0)));
  const std::vector<double> points = MakePoints();
  std::vector<VirtualVertex> vertices(points.size() / 3);
  for (auto step : state)
  {
    solver.Solve(points.data(), 0, vertices.size(), vertices.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(vertices.size()));
}

/** All images of each point. */
void FindAllImages(benchmark::State& state)
{
  CurvedMembraneSolver solver;
  SetWaves(solver, static_cast<int>(state.range(0)));
  const std::vector<double> points = MakePoints();
  std::vector<VirtualVertex> images;
  for (auto step : state)
  {
    for (std::size_t i = 0; i < points.size(); i += 3)
    {
      const glm::dvec3 point(points[i], points[i + 1], points[i + 2]);
      benchmark::DoNotOptimize(solver.FindImages(point, images));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size() / 3));
}

void RegisterFrames()
{
  benchmark::RegisterBenchmark("BendRays/alone", BendRays, true, InstructionSet::Portable)
    ->Unit(benchmark::kMillisecond);
  for (const InstructionSet set : GetInstructionSets())
  {
    const std::string name = std::string("CastFrame/") + NameOf(set);
    benchmark::RegisterBenchmark(
      (std::string("BendRays/") + NameOf(set)).c_str(), BendRays, false, set)
      ->Unit(benchmark::kMillisecond);
    for (const FrameKind& kind : { FrameKind{ "/Translucent", BlendMode::Composite, 1.0, false },
           FrameKind{ "/Fine", BlendMode::Composite, 1.0, false, true },
           FrameKind{ "/Lit", BlendMode::Composite, 1.0, true },
           FrameKind{ "/Opaque", BlendMode::Composite, 1000.0, false },
           FrameKind{ "/Maximum", BlendMode::MaximumIntensity, 1.0, false } })
    {
      benchmark::RegisterBenchmark((name + kind.Name).c_str(), CastFrame, set, kind)
        ->Unit(benchmark::kMillisecond);
    }
  }
}

BENCHMARK(BuildMesh)->Unit(benchmark::kMillisecond);
BENCHMARK(VertexGradients)->Unit(benchmark::kMillisecond);
BENCHMARK(SolvePoints)->Arg(40)->Arg(160)->Unit(benchmark::kMillisecond);
BENCHMARK(FindAllImages)->Arg(40)->Arg(160)->Unit(benchmark::kMillisecond);

}

int main(int argc, char** argv)
{
  RegisterFrames();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

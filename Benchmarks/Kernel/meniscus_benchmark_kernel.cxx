// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Times of single parts of the kernel on one thread, by Google Benchmark: for changes of the code.
// The other programs compare whole frames with their peers.
#include "KernelMeshes.h"
#include "KernelPicture.h"
#include "MembraneMeshes.h"
#include "RefractionTestRandom.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Curved/TruePositions.h"
#include "Refraction/Stack/StackInverse.h"
#include "Refraction/Stack/StackSolver.h"
#include "Refraction/Surface/SteepDirections.h"
#include "Simd/InstructionSets.h"
#include "Volume/Mesh/ScalarGradients.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketJob.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
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
  meniscus::testing::Random random(5);
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

/** Points of a grid below the waves, as x, y and z in turn. */
std::vector<double> MakeGridPoints()
{
  constexpr int across = 128;
  constexpr double spacing = 1.0;
  std::vector<double> points;
  for (int layer = 0; layer < 4; ++layer)
  {
    for (int row = 0; row < 32; ++row)
    {
      for (int column = 0; column < across; ++column)
      {
        points.insert(points.end(),
          { spacing * (column - across / 2), -60.0 - 10.0 * layer, spacing * (row - 16) });
      }
    }
  }
  return points;
}

/** Wavy surfaces below each other. */
std::vector<Interface> MakeInterfaces(std::int64_t number)
{
  std::vector<Interface> interfaces;
  for (int i = 0; i < number; ++i)
  {
    reference::MembraneMesh waves = reference::MakeWaves(200.0, 50, 2.0 + i, 3.0);
    waves.Translate(glm::dvec3(0.0, -15.0 * i, 0.0));
    auto surface = std::make_shared<RefractingSurface>();
    surface->SetMembrane(waves.AsInput(), SurfaceParts::Crossings);
    interfaces.push_back({ surface, { 1.0 + 0.2 * i, 1.2 + 0.2 * i } });
  }
  return interfaces;
}

/** One image of each point of a grid behind wavy surfaces; Arg is their number. */
void SolveThroughInterfaces(benchmark::State& state)
{
  const std::vector<Interface> interfaces = MakeInterfaces(state.range(0));
  const glm::dvec3 eye(20.0, 300.0, 10.0);
  CurvedMembraneSolver one;
  StackSolver several;
  if (interfaces.size() == 1)
  {
    one.SetMembrane(reference::MakeWaves(200.0, 50, 2.0, 3.0).AsInput());
    one.SetEye(eye, 1.0, 1.2);
  }
  else
  {
    several.SetInterfaces(interfaces);
    several.SetEye(eye);
  }
  const std::vector<double> points = MakeGridPoints();
  const std::size_t count = points.size() / 3;
  std::vector<VirtualVertex> vertices(count);
  std::vector<StackDetail> details(count);
  std::vector<double> legs(count * interfaces.size());
  for (auto step : state)
  {
    if (interfaces.size() == 1)
    {
      one.Solve(points.data(), 0, count, vertices.data());
    }
    else
    {
      several.Solve(points.data(), 0, count, vertices.data(), details.data(), legs.data());
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/** True positions of the points of a grid; Arg is the number of cells along the waves' side. */
void FindTruePositions(benchmark::State& state)
{
  CurvedMembraneSolver solver;
  SetWaves(solver, static_cast<int>(state.range(0)));
  SteepDirections steep;
  steep.Build(solver.GetMembrane(), solver.GetPatches());
  const TruePositions truth(solver, steep);
  const std::vector<double> points = MakeGridPoints();
  const std::size_t count = points.size() / 3;
  for (auto step : state)
  {
    CrossingChain chain;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (i % TruePositions::Chain == 0)
      {
        chain.Forget();
      }
      const double* p = points.data() + 3 * i;
      benchmark::DoNotOptimize(truth.Find({ p[0], p[1], p[2] }, chain));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/** True positions of the points of a grid behind wavy surfaces; Arg is their number. */
void FindTruePositionsThroughInterfaces(benchmark::State& state)
{
  StackSolver solver;
  solver.SetInterfaces(MakeInterfaces(state.range(0)));
  solver.SetEye(glm::dvec3(20.0, 300.0, 10.0));
  const std::vector<double> points = MakeGridPoints();
  const std::size_t count = points.size() / 3;
  for (auto step : state)
  {
    StackChain chain;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (i % TruePositions::Chain == 0)
      {
        chain.clear();
      }
      const double* p = points.data() + 3 * i;
      benchmark::DoNotOptimize(
        FindTruePosition(solver.GetStack(), 1.0, { p[0], p[1], p[2] }, &chain));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void RegisterFrames()
{
  for (const InstructionSet set : GetInstructionSets())
  {
    const std::string name = std::string("CastFrame/") + NameOf(set);
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
BENCHMARK(SolveThroughInterfaces)->DenseRange(1, 3)->Unit(benchmark::kMillisecond);
BENCHMARK(FindTruePositions)->Arg(40)->Arg(160)->Unit(benchmark::kMillisecond);
BENCHMARK(FindTruePositionsThroughInterfaces)->DenseRange(2, 3)->Unit(benchmark::kMillisecond);
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

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Times of refraction at wavy surfaces below each other; Arg is the number of surfaces. Rows named
// ...AtMembrane measure the code for one membrane with the same arguments as a list with one
// surface; rows named ...ByList use a list of one where it decides. The surfaces of
// ...Plane and ...Planes are flat.
#include "KernelSurfaces.h"
#include "MembraneMeshes.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ObjectImages.h"
#include "Refraction/Stack/PlaneImages.h"
#include "Refraction/Stack/StackInverse.h"
#include "Refraction/Stack/StackSolver.h"
#include "Refraction/StackImages/StackImages.h"
#include "Volume/Refracted/RefractedRayStack.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

using namespace meniscus;

namespace
{

const glm::dvec3 Eye(20.0, 300.0, 10.0);

enum class Shape
{
  Waves,
  Planes
};

/** Surfaces of 5,000 facets below each other. */
std::vector<Interface> MakeInterfaces(std::int64_t number, Shape shape = Shape::Waves)
{
  std::vector<Interface> interfaces;
  for (int i = 0; i < number; ++i)
  {
    const double amplitude = shape == Shape::Waves ? 2.0 + i : 0.0;
    reference::MembraneMesh waves = reference::MakeWaves(200.0, 50, amplitude, 3.0);
    waves.Translate(glm::dvec3(0.0, -15.0 * i, 0.0));
    auto surface = std::make_shared<RefractingSurface>();
    surface->SetMembrane(waves.AsInput(), SurfaceParts::Crossings);
    interfaces.push_back({ surface, { 1.0 + 0.2 * i, 1.2 + 0.2 * i } });
  }
  return interfaces;
}

/** Solver of the first surface alone, and as an exact plane, if it is one. */
struct OneMembrane
{
  Interface First;
  CurvedMembraneSolver Solver;
  RefractionStack Stack;
  ParallelPlanes Plane;

  explicit OneMembrane(Shape shape = Shape::Waves)
    : First(MakeInterfaces(1, shape).front())
  {
    this->Solver.SetSurface(this->First.Surface);
    this->Stack.SetInterfaces({ this->First });
    this->SetEye();
    this->SetEyeOfPlane();
  }

  EyeStatus SetEye()
  {
    return this->Solver.SetEye(Eye, this->First.Media.Exterior, this->First.Media.Interior);
  }

  EyeStatus SetEyeOfPlane()
  {
    const EyeStatus status = this->Stack.SetEye(Eye);
    this->Plane.Set(this->Stack);
    return status;
  }
};

/** Solver of a list. */
struct Interfaces
{
  StackSolver Solver;

  explicit Interfaces(std::int64_t number, Shape shape = Shape::Waves)
  {
    this->Solver.SetInterfaces(MakeInterfaces(number, shape));
    this->Solver.SetEye(Eye);
  }
};

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

/** Calls `find(point, isFirst)` for all points of the grid; `isFirst` begins a chain. */
template <typename Find>
void ForEachPoint(benchmark::State& state, const Find& find)
{
  const std::vector<double> points = MakeGridPoints();
  const std::size_t count = points.size() / 3;
  for (auto step : state)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const double* p = points.data() + 3 * i;
      find(glm::dvec3(p[0], p[1], p[2]), i % StackSolver::Chain == 0);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/** One image of each point of the grid. */
void SolveAtShape(benchmark::State& state, Shape shape)
{
  const OneMembrane one(shape);
  const std::vector<double> points = MakeGridPoints();
  std::vector<VirtualVertex> vertices(points.size() / 3);
  for (auto step : state)
  {
    one.Solver.Solve(points.data(), 0, vertices.size(), vertices.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(vertices.size()));
}

void SolveAtMembrane(benchmark::State& state)
{
  SolveAtShape(state, Shape::Waves);
}

void SolveAtPlane(benchmark::State& state)
{
  SolveAtShape(state, Shape::Planes);
}

void SolveAtPlaneByList(benchmark::State& state)
{
  const OneMembrane one(Shape::Planes);
  const std::vector<double> points = MakeGridPoints();
  std::vector<VirtualVertex> vertices(points.size() / 3);
  std::vector<unsigned char> isOpen(vertices.size());
  for (auto step : state)
  {
    std::fill(isOpen.begin(), isOpen.end(), 1);
    benchmark::DoNotOptimize(meniscus::SolveAtPlane(
      one.Plane, points.data(), 0, vertices.size(), vertices.data(), isOpen.data()));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(vertices.size()));
}

void SolveThroughShapes(benchmark::State& state, Shape shape)
{
  const Interfaces list(state.range(0), shape);
  const std::vector<double> points = MakeGridPoints();
  const std::size_t count = points.size() / 3;
  std::vector<VirtualVertex> vertices(count);
  std::vector<StackDetail> details(count);
  std::vector<double> legs(count * static_cast<std::size_t>(state.range(0)));
  for (auto step : state)
  {
    list.Solver.Solve(points.data(), 0, count, vertices.data(), details.data(), legs.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void SolveThroughInterfaces(benchmark::State& state)
{
  SolveThroughShapes(state, Shape::Waves);
}

void SolveThroughPlanes(benchmark::State& state)
{
  SolveThroughShapes(state, Shape::Planes);
}

/** All images of each point of the grid. */
void FindAllImagesAtMembrane(benchmark::State& state)
{
  const OneMembrane one;
  std::vector<VirtualVertex> images;
  ForEachPoint(state,
    [&](const glm::dvec3& point, bool)
    { benchmark::DoNotOptimize(one.Solver.FindImages(point, images)); });
}

void FindAllImagesThroughInterfaces(benchmark::State& state)
{
  const Interfaces list(state.range(0));
  std::vector<StackPath> images;
  StackSolver::Memory memory;
  ForEachPoint(state,
    [&](const glm::dvec3& point, bool isFirst)
    {
      memory = isFirst ? StackSolver::Memory() : memory;
      benchmark::DoNotOptimize(list.Solver.FindImages(point, memory, images));
    });
}

/** A change of the eye. */
void SetEyeAtMembrane(benchmark::State& state)
{
  OneMembrane one;
  for (auto step : state)
  {
    benchmark::DoNotOptimize(one.SetEye());
  }
}

void SetEyeAtPlaneByList(benchmark::State& state)
{
  OneMembrane one(Shape::Planes);
  for (auto step : state)
  {
    benchmark::DoNotOptimize(one.Solver.PlaceEye(Eye, 1.0, 1.2));
    benchmark::DoNotOptimize(one.SetEyeOfPlane());
  }
}

void SetEyeThroughInterfaces(benchmark::State& state)
{
  Interfaces list(state.range(0));
  for (auto step : state)
  {
    benchmark::DoNotOptimize(list.Solver.SetEye(Eye));
  }
}

/** A square of 32 x 32 x 2 triangles below the waves. */
struct Square
{
  static constexpr std::int64_t Side = 32;

  std::vector<double> Points;
  std::vector<std::int64_t> Connectivity;
  std::vector<std::int64_t> Offsets{ 0 };
  std::vector<std::int64_t> Names;

  Square()
  {
    for (std::int64_t row = 0; row <= Side; ++row)
    {
      for (std::int64_t column = 0; column <= Side; ++column)
      {
        this->Points.insert(this->Points.end(),
          { 2.5 * static_cast<double>(column) - 40.0, -80.0,
            2.5 * static_cast<double>(row) - 40.0 });
      }
    }
    for (std::int64_t row = 0; row < Side; ++row)
    {
      for (std::int64_t column = 0; column < Side; ++column)
      {
        const std::int64_t a = row * (Side + 1) + column;
        const std::int64_t b = a + Side + 1;
        this->Connectivity.insert(this->Connectivity.end(), { a, a + 1, b, a + 1, b + 1, b });
        this->Offsets.insert(
          this->Offsets.end(), { this->Offsets.back() + 3, this->Offsets.back() + 6 });
      }
    }
    this->Names.resize(this->Offsets.size() - 1);
    std::iota(this->Names.begin(), this->Names.end(), 0);
  }

  /** Maps the triangles by images whose points are set. */
  template <typename Images>
  void Map(Images& images) const
  {
    const std::size_t count = this->Names.size();
    images.SolvePoints(0, this->Points.size() / 3);
    images.FinishPoints();
    images.SetTolerance(1e-3);
    std::vector<unsigned char> isMapped(count);
    ImageMesh pieces;
    ImageMesh whole;
    const auto noPolygons = [](const std::int64_t*, std::size_t, std::vector<std::int64_t>& t)
    { t.clear(); };
    images.MapPolygons({ this->Offsets.data(), this->Connectivity.data() }, this->Names.data(), 0,
      count, noPolygons, pieces, whole, isMapped.data());
  }
};

/** Images of the square's triangles; at planes, with a new eye for each. */
void MapTrianglesAt(benchmark::State& state, Shape shape, bool byList)
{
  OneMembrane one(shape);
  one.Solver.PrepareField();
  const Square square;
  const std::size_t points = square.Points.size() / 3;
  for (auto step : state)
  {
    if (byList)
    {
      one.Solver.PlaceEye(Eye, 1.0, 1.2);
      one.SetEyeOfPlane();
    }
    else if (shape == Shape::Planes)
    {
      one.SetEye();
    }
    ObjectImages images(one.Solver, byList ? &one.Plane : nullptr);
    images.SetPoints(square.Points.data(), points, false);
    if (shape == Shape::Planes)
    {
      images.PrepareUnique(points, square.Names.size(), SerialLoop);
    }
    square.Map(images);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(square.Names.size()));
}

void MapTrianglesAtMembrane(benchmark::State& state)
{
  MapTrianglesAt(state, Shape::Waves, false);
}

void MapTrianglesAtPlane(benchmark::State& state)
{
  MapTrianglesAt(state, Shape::Planes, false);
}

void MapTrianglesAtPlaneByList(benchmark::State& state)
{
  MapTrianglesAt(state, Shape::Planes, true);
}

void MapTrianglesThrough(benchmark::State& state, Shape shape)
{
  Interfaces list(state.range(0), shape);
  const Square square;
  for (auto step : state)
  {
    if (shape == Shape::Planes)
    {
      list.Solver.SetEye(Eye);
    }
    StackImages images(list.Solver);
    images.SetPoints(square.Points.data(), square.Points.size() / 3);
    square.Map(images);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(square.Names.size()));
}

void MapTrianglesThroughInterfaces(benchmark::State& state)
{
  MapTrianglesThrough(state, Shape::Waves);
}

void MapTrianglesThroughPlanes(benchmark::State& state)
{
  MapTrianglesThrough(state, Shape::Planes);
}

/** View of 256 x 256 pixels of a mesh below the waves. */
RefractedRayStack::View MakeView()
{
  RefractedRayStack::View view = test::LookAt(Eye, glm::dvec3(0.0, -15.0, 0.0), 160.0, false, 256);
  test::SetMesh(view, { glm::dvec3(0.0, -80.0, 0.0), glm::dvec3(60.0, 20.0, 60.0) });
  return view;
}

/** Refracted rays of an image. */
void TraceRaysThroughInterfaces(benchmark::State& state)
{
  const std::vector<Interface> list = MakeInterfaces(state.range(0));
  RefractedRayStack rays;
  for (auto step : state)
  {
    rays.Build(list, MakeView());
  }
}

/** True positions of the points of the grid. */
void FindTruePositionsThroughInterfaces(benchmark::State& state)
{
  const Interfaces list(state.range(0));
  StackChain chain;
  ForEachPoint(state,
    [&](const glm::dvec3& point, bool isFirst)
    {
      if (isFirst)
      {
        chain.clear();
      }
      benchmark::DoNotOptimize(FindTruePosition(list.Solver.GetStack(), 1.0, point, &chain));
    });
}

void ForOneToThree(benchmark::internal::Benchmark* row)
{
  row->DenseRange(1, 3)->Unit(benchmark::kMillisecond);
}

BENCHMARK(SetEyeAtMembrane)->Unit(benchmark::kMillisecond);
BENCHMARK(SetEyeThroughInterfaces)->Apply(ForOneToThree);
BENCHMARK(SolveAtMembrane)->Unit(benchmark::kMillisecond);
BENCHMARK(SolveThroughInterfaces)->Apply(ForOneToThree);
BENCHMARK(SetEyeAtPlaneByList)->Unit(benchmark::kMillisecond);
BENCHMARK(SolveAtPlane)->Unit(benchmark::kMillisecond);
BENCHMARK(SolveAtPlaneByList)->Unit(benchmark::kMillisecond);
BENCHMARK(SolveThroughPlanes)->Apply(ForOneToThree);
BENCHMARK(FindAllImagesAtMembrane)->Unit(benchmark::kMillisecond);
BENCHMARK(FindAllImagesThroughInterfaces)->Apply(ForOneToThree);
BENCHMARK(MapTrianglesAtMembrane)->Unit(benchmark::kMillisecond);
BENCHMARK(MapTrianglesAtPlane)->Unit(benchmark::kMillisecond);
BENCHMARK(MapTrianglesAtPlaneByList)->Unit(benchmark::kMillisecond);
BENCHMARK(MapTrianglesThroughInterfaces)->Apply(ForOneToThree);
BENCHMARK(MapTrianglesThroughPlanes)->Apply(ForOneToThree);
BENCHMARK(TraceRaysThroughInterfaces)->Apply(ForOneToThree);
BENCHMARK(FindTruePositionsThroughInterfaces)->Apply(ForOneToThree);

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Frames.h"

#ifdef MENISCUS_HAS_EMBREE

#include "Timing.h"
#include "TracedWell.h"

#include <vtkRefractedGeometryFilter.h>

#include <functional>
#include <limits>
#include <sstream>

#endif

namespace meniscus::benchmark
{

#ifdef MENISCUS_HAS_EMBREE

namespace
{

constexpr double AcceptedPixels = 0.5;
constexpr int Frames = 40;
constexpr int LargestTried = 64;
constexpr int Sizes[] = { 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256 };

// The well's own resolution, for the tracer. The filter may get a finer well, since its output is
// straight between points.
constexpr int Quads = 16;
constexpr int FinerQuads[] = { 16, 32, 48 };

// Half a pixel of 512 pixels and 29 degrees is 0.028 degrees.
constexpr double Tolerances[] = { 0.015, 0.03, 0.06 };

//------------------------------------------------------------------------------
class RaceTrack
{
public:
  explicit RaceTrack(bool all)
    : All(all)
  {
    WellScene scene(Sizes[0], Quads);
    this->Truth = scene.Trace();
  }

  RaceReport Run()
  {
    this->FindOurs();
    const int traced = this->FindTraced();
    RaceReport report;
    std::ostringstream text;
    text << "CURVED, " << (this->All ? "ALL_IMAGES" : "FIRST_IMAGE");
    if (this->All)
    {
      text << ", tolerance " << this->Ours.Tolerance << " degrees";
    }
    text << ", " << 2 * this->Ours.Cells * this->Ours.Cells << " facets, "
         << 5 * this->Ours.Quads * this->Ours.Quads << " quads: image error " << this->Ours.Error
         << " pixels";
    report.Ours = text.str();
    text.str("");
    text << "Embree, " << 2 * traced * traced << " facets, " << 5 * Quads * Quads
         << " quads: image error " << this->TracedError << " pixels";
    report.Traced = text.str();

    WellScene scene(this->Ours.Cells, this->Ours.Quads);
    this->Prepare(scene, this->Ours.Tolerance);
    WellScene tracedScene(Sizes[0], Quads);
    RefractionTracer tracer;
    this->Prepare(tracer, tracedScene, traced);
    const auto race = [&](const char* name, const std::function<void(int)>& move,
                        const std::function<void(int)>& moveTraced)
    { report.Races.push_back(this->RunRace(name, scene, tracer, move, moveTraced)); };
    race(
      "the eye", [&](int i) { scene.MoveEye(0.01 * i); }, [](int) {});
    race(
      "nothing but colours", [&](int i) { scene.ChangeColors(i); },
      [&](int i) { this->Colors.Colors[static_cast<std::size_t>(i)] ^= 0xffu; });
    // The arrays of both are prepared outside of the measured time: in practice, water comes from a
    // simulation.
    std::vector<TracedMesh> meshes;
    for (int i = 0; i < Frames; ++i)
    {
      meshes.push_back(MembraneOf(scene.FieldAt(0.1 * i).MakeMesh(traced)));
    }
    race(
      "the membrane", [&](int i) { scene.MoveMembrane(0.1 * i); },
      [&](int i) { tracer.MoveMembrane(meshes[static_cast<std::size_t>(i)]); });
    return report;
  }

private:
  struct SetUp
  {
    int Cells = 0;
    int Quads = 0;
    double Tolerance = 0.0;
    double Error = 0.0;
    double Seconds = std::numeric_limits<double>::max();
  };

  void Prepare(WellScene& scene, double tolerance) const
  {
    scene.GetFilter()->SetImages(this->All);
    scene.GetFilter()->SetAngularTolerance(tolerance);
  }

  void Prepare(RefractionTracer& tracer, WellScene& scene, int cells)
  {
    tracer.SetIndices(scene.MakeField().Exterior, scene.MakeField().Interior);
    tracer.SetMembrane(MembraneOf(scene.MakeField().MakeMesh(cells)));
    tracer.SetObject(ObjectOf(scene.GetWell()));
    this->Colors = ColorsOf(scene.GetWell());
  }

  // Finds the fastest of several wells and tolerances, each with the coarsest membrane whose image
  // is right to half a pixel.
  void FindOurs()
  {
    for (const int quads : FinerQuads)
    {
      for (const double tolerance : Tolerances)
      {
        if (this->All || tolerance == Tolerances[0])
        {
          this->TryOurs(quads, tolerance);
        }
      }
    }
  }

  void TryOurs(int quads, double tolerance)
  {
    for (const int cells : Sizes)
    {
      WellScene scene(cells, quads);
      this->Prepare(scene, tolerance);
      const double error =
        test::ComparePlaces(this->Truth, scene.DrawPlaces(), scene.GetCamera()).Error;
      if (error <= AcceptedPixels)
      {
        int frame = 0;
        const auto work = [&]
        {
          scene.MoveEye(0.01 * ++frame);
          scene.Update();
        };
        const double seconds = TimeMedian(work, 3).Cpu;
        if (seconds < this->Ours.Seconds)
        {
          this->Ours = { cells, quads, tolerance, error, seconds };
        }
        return;
      }
      if (cells >= LargestTried)
      {
        return; // the remaining error does not come from the membrane
      }
    }
  }

  int FindTraced()
  {
    WellScene scene(Sizes[0], Quads);
    for (const int cells : Sizes)
    {
      RefractionTracer tracer;
      this->Prepare(tracer, scene, cells);
      const auto picture = PlacesOf(tracer, scene.GetCamera());
      this->TracedError = test::ComparePlaces(this->Truth, picture, scene.GetCamera()).Error;
      if (this->TracedError <= AcceptedPixels)
      {
        return cells;
      }
    }
    return Sizes[std::size(Sizes) - 1];
  }

  // Frames alternate between both, so that both meet the same load.
  Race RunRace(const char* name, WellScene& scene, RefractionTracer& tracer,
    const std::function<void(int)>& move, const std::function<void(int)>& moveTraced)
  {
    std::vector<unsigned char> rgba(std::size_t(4) * 512 * 512);
    std::vector<Seconds> ours;
    std::vector<Seconds> traced;
    scene.Draw();
    for (int i = 0; i < Frames; ++i)
    {
      move(i);
      ours.push_back(TimeOnce([&] { scene.Draw(); }));
      const TracedView view = ViewOf(scene.GetCamera());
      traced.push_back(TimeOnce(
        [&]
        {
          moveTraced(i);
          tracer.Trace(view, this->Colors, rgba.data());
        }));
    }
    const Seconds a = MedianOf(ours);
    const Seconds b = MedianOf(traced);
    return { name, 1e3 * a.Wall, 1e3 * b.Wall, 1e3 * a.Cpu, 1e3 * b.Cpu };
  }

  bool All;
  SetUp Ours;
  test::PlacePicture Truth;
  TriangleColors Colors;
  double TracedError = 0.0;
};

} // anonymous namespace

#endif

//------------------------------------------------------------------------------
std::vector<RaceReport> RunRaces()
{
  std::vector<RaceReport> reports;
#ifdef MENISCUS_HAS_EMBREE
  for (const bool all : { true, false })
  {
    reports.push_back(RaceTrack(all).Run());
  }
#endif
  return reports;
}

} // namespace meniscus::benchmark

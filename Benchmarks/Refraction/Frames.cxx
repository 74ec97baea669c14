// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Frames.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "Timing.h"
#include "WellScene.h"

#include <vtkPolyData.h>
#include <vtkRefractedGeometryFilter.h>

#include <functional>
#include <iomanip>
#include <sstream>

namespace meniscus
{
namespace benchmark
{

namespace
{

struct ThesisFrames
{
  int Facets;
  int Vertices;
  const char* Complete;    ///< Table 4.6
  const char* Containment; ///< Table 4.7, centred
  const char* Drawing;     ///< Table 4.8
};

// Figures for planar refractors.
const ThesisFrames Printed[] = { { 120, 105, "492-530", "520-560", "705-709" },
  { 120, 528, "200-226", "273-290", "584-586" }, { 120, 2628, "46-55", "76-77", "233-234" },
  { 484, 105, "430-485", "485-525", "681-685" }, { 484, 528, "172-200", "245-258", "568-571" },
  { 484, 2628, "41-54", "67-68", "232-233" }, { 1820, 105, "338-390", "443-484", "653-656" },
  { 1820, 528, "136-150", "221-236", "549-551" }, { 1820, 2628, "31-37", "61-62", "229-230" } };

// Squares and wells with the nearest numbers of facets.
int CellsFor(int facets)
{
  return facets == 120 ? 8 : (facets == 484 ? 16 : 30);
}

int QuadsFor(int vertices)
{
  return vertices == 105 ? 4 : (vertices == 528 ? 9 : 22);
}

constexpr int Frames = 40;

using Change = std::function<void(WellScene&, int frame)>;

double FramesPerSecond(WellScene& scene, const Change& change)
{
  std::vector<Seconds> times;
  for (int i = 0; i < Frames; ++i)
  {
    times.push_back(TimeOnce(
      [&]
      {
        change(scene, i);
        scene.Draw();
      }));
  }
  return 1.0 / MedianOf(times).Wall;
}

void PrintShares(std::ostream& out)
{
  out << "\nTable 4.9, 1,805 vertices: % of a frame in cell creation and cell containment\n"
         "| facets | thesis centred | FLAT_FACETS | CURVED |\n|---|---|---|---|\n";
  const char* const printed[] = { "0.3, 51.3", "0.5, 55.5", "1.2, 58.5" };
  for (int i = 0; i < 3; ++i)
  {
    const int facets = i == 0 ? 120 : (i == 1 ? 484 : 1820);
    WellScene scene(CellsFor(facets), 18);
    out << "| " << facets << " | " << printed[i];
    std::vector<double> points;
    for (vtkIdType p = 0; p < scene.GetWell()->GetNumberOfPoints(); ++p)
    {
      const double* x = scene.GetWell()->GetPoint(p);
      points.insert(points.end(), x, x + 3);
    }
    std::vector<VirtualVertex> vertices(points.size() / 3);
    const auto mesh = scene.MakeField().MakeMesh(CellsFor(facets));
    const auto share = [&](auto& geometry, int model)
    {
      scene.GetFilter()->SetMembraneModel(model);
      scene.GetFilter()->SetImagesToFirstImage();
      geometry.SetMembrane(mesh.AsInput());
      const double eye = TimeMedian(
        [&] {
          geometry.SetEye({ 20.0, 300.0, 10.0 }, 1.0, 1.333);
        }).Cpu;
      const double solve =
        TimeMedian([&] { geometry.Solve(points.data(), 0, vertices.size(), vertices.data()); }).Cpu;
      int frame = 0;
      const double all = TimeMedian(
        [&]
        {
          scene.MoveEye(0.01 * ++frame);
          scene.Draw();
        },
        Frames)
                           .Cpu;
      out << " | " << 100.0 * eye / all << ", " << 100.0 * solve / all;
    };
    FlatMembraneSolver flat;
    share(flat, vtkRefractedGeometryFilter::FLAT_FACETS);
    CurvedMembraneSolver curved;
    share(curved, vtkRefractedGeometryFilter::CURVED);
    out << " |\n";
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
void PrintThesisFrames(std::ostream& out)
{
  const struct
  {
    const char* Name;
    const char* ThesisFrames::*Column;
    Change Make;
  } tables[] = {
    { "Table 4.6, everything recomputed", &ThesisFrames::Complete,
      [](WellScene& scene, int i)
      {
        scene.MoveMembrane(0.1 * i);
        scene.MoveEye(0.01 * i);
      } },
    { "Table 4.7, cell creation skipped: the object moves", &ThesisFrames::Containment,
      [](WellScene& scene, int i) { scene.MoveWell(0.1 * i); } },
    { "Table 4.8, drawing alone", &ThesisFrames::Drawing, [](WellScene&, int) {} },
  };
  out << std::fixed << std::setprecision(0);
  for (const auto& table : tables)
  {
    out << table.Name
        << ", frames/s\n| facets | vertices | thesis | FLAT_FACETS | CURVED, one "
           "image |\n|---|---|---|---|---|\n";
    for (const ThesisFrames& row : Printed)
    {
      out << "| " << row.Facets << " | " << row.Vertices << " | " << row.*table.Column;
      for (const int model :
        { vtkRefractedGeometryFilter::FLAT_FACETS, vtkRefractedGeometryFilter::CURVED })
      {
        WellScene scene(CellsFor(row.Facets), QuadsFor(row.Vertices));
        scene.GetFilter()->SetMembraneModel(model);
        scene.GetFilter()->SetImagesToFirstImage();
        scene.Draw();
        out << " | " << FramesPerSecond(scene, table.Make);
      }
      out << " |" << std::endl;
    }
    out << '\n';
  }
  out << std::setprecision(1);
  PrintShares(out);
}

//------------------------------------------------------------------------------
std::vector<WellFrames> MeasureWell()
{
  std::vector<WellFrames> result;
  const struct
  {
    const char* Name;
    bool All;
    double Tolerance;
  } modes[] = { { "FIRST_IMAGE", false, 0.005 }, { "ALL_IMAGES, 0.05 degrees", true, 0.05 },
    { "ALL_IMAGES, 0.005 degrees", true, 0.005 } };
  for (const auto& mode : modes)
  {
    WellScene scene(16, 16);
    scene.GetFilter()->SetImages(mode.All);
    scene.GetFilter()->SetAngularTolerance(mode.Tolerance);
    std::vector<Seconds> times;
    for (int i = 0; i < 4 * Frames; ++i)
    {
      scene.MoveMembrane(0.1 * i);
      times.push_back(TimeOnce([&] { scene.Update(); }));
    }
    const Seconds frame = MedianOf(times);
    result.push_back({ mode.Name, 1.0 / frame.Wall, 1e3 * frame.Cpu });
  }
  return result;
}

//------------------------------------------------------------------------------
void PrintRaces(std::ostream& out)
{
  const auto reports = RunRaces();
  if (reports.empty())
  {
    out << "against Embree: skipped, built without it\n";
  }
  out << std::fixed << std::setprecision(2);
  for (const RaceReport& report : reports)
  {
    out << report.Ours << "\nagainst " << report.Traced
        << "\n| what moves | filter and drawing ms | tracing ms | ratio | CPU ms | CPU ms | ratio "
           "|\n|---|---|---|---|---|---|---|\n";
    for (const Race& race : report.Races)
    {
      out << "| " << race.Change << " | " << race.OursMs << " | " << race.TracedMs << " | "
          << race.TracedMs / race.OursMs << " | " << race.OursCpuMs << " | " << race.TracedCpuMs
          << " | " << race.TracedCpuMs / race.OursCpuMs << " |\n";
    }
    out << '\n';
  }
}

} // namespace benchmark
} // namespace meniscus

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionReport.h"

#include "Accuracy.h"
#include "DrawingFloor.h"
#include "Frames.h"
#include "Growth.h"
#include "Pool.h"
#include "RefractionPicture.h"
#include "ThesisTables.h"
#include "WellScene.h"

#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkRefractedGeometryFilter.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iomanip>
#include <sstream>

namespace meniscus::benchmark
{

namespace
{

std::string MakeNumber(double value, int digits = 2)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

class Report
{
public:
  Report(std::ostream& out, const RefractionOptions& options)
    : Out(out)
    , Options(options)
  {
  }

  void Print()
  {
    this->Out << "| row | goal | measured |\n|---|---|---|\n";
    this->GetRow("planar error", "mean <= 1e-8", [this] { return this->Planar(); });
    this->GetRow(
      "bowl errors", "mean <= 1e-5 / 1e-4 / 4e-4 / 2e-3", [this] { return this->Bowls(); });
    this->GetRow(
      "hemisphere error", "mean <= 0.05, pixels <= 0.2", [this] { return this->Hemisphere(); });
    this->GetRow("wave error", "<= 1e-5 at 51,200 facets, order >= 2.8", [] { return GetWaves(); });
    this->GetRow("vertex cost",
      "one image <= 250 ns to 32k facets, 500 ns at 1M; all <= 1.5 us to "
      "131k",
      [] { return GetVertices(); });
    this->GetRow("membrane cost",
      "new eye of 1M facets <= 150 ms, deforming <= 1 us a facet, 2 "
      "threads",
      [] { return GetMembranes(); });
    this->GetRow("images", "all, none false", [] { return GetImages(); });
    this->GetRow("pictures", "<= 0.1 % of covered pixels differ", [] { return GetPictures(); });
    this->GetRow("well", ">= 500 frames/s of filter time", [] { return GetWell(); });
    this->GetRow("pass", ">= 30 frames/s, everything on", [] { return GetPass(); });
    this->GetRow(
      "pool picture", "< 0.5 % of the water differs by more than 8/255", [] { return MakePool(); });
    this->GetRow("Embree", "eye moving >= 2x, colours alone >= 10x", [] { return GetRaces(); });
    this->GetRow("drawing floor", "", [] { return GetFloor(); });
  }

private:
  void GetRow(const char* name, const char* goal, const std::function<std::string()>& measure)
  {
    if (std::strstr(name, this->Options.Row.c_str()))
    {
      this->Out << "| " << name << " | " << goal << " | " << std::flush << measure() << " |"
                << std::endl;
    }
  }

  using Choice = std::function<bool(const reference::ThesisRow&)>;

  static std::string Means(const Choice& choice, bool largestOnly)
  {
    std::string text;
    double largest = 0.0;
    for (const reference::ThesisRow& row : reference::GetThesisRows())
    {
      if (choice(row))
      {
        const double mean = reference::MeasureThesisRowCurved(row).Mean;
        largest = std::max(largest, mean);
        text += (text.empty() ? "" : " / ") + MakeNumber(mean);
      }
    }
    return largestOnly ? "at most " + MakeNumber(largest) : text;
  }

  std::string Planar() const
  {
    return Means([](const reference::ThesisRow& row) { return row.SphereRatio == 0.0; }, true);
  }

  std::string Bowls() const
  {
    return Means([](const reference::ThesisRow& row)
      { return std::strcmp(row.Table, "4.2") == 0 && row.SphereRatio > 1.0; },
      false);
  }

  std::string Hemisphere() const
  {
    return "mean " +
      Means([](const reference::ThesisRow& row)
        { return std::strcmp(row.Table, "4.2") == 0 && row.SphereRatio == 1.0; },
        false) +
      ", largest " + MakeNumber(MeasureHemispherePixels()) + " pixels";
  }

  static std::string GetWaves()
  {
    const int cells[] = { 20, 40, 80, 160, 320 };
    std::string text;
    double last = 0.0;
    std::string orders;
    for (const int n : cells)
    {
      const double error = MeasureWaveError(n).Curved;
      if (n == 160)
      {
        text = MakeNumber(error);
      }
      if (last > 0.0)
      {
        orders += (orders.empty() ? "" : ", ") + MakeNumber(std::log2(last / error));
      }
      last = error;
    }
    return text + "; orders from 800 to 204,800 facets " + orders;
  }

  static std::string GetVertices()
  {
    std::string text;
    for (const int cells : { 23, 128, 256, 708 })
    {
      const GrowthFigures f = MeasureGrowth(cells);
      text += (text.empty() ? "" : "; ") + std::to_string(f.Facets) + " facets: one " +
        MakeNumber(1e3 * f.CurvedOne, 3) + " ns, all " + MakeNumber(1e3 * f.CurvedAll, 4) +
        " ns, searched " + MakeNumber(1e3 * f.CurvedSearch, 4) + " ns";
    }
    return text;
  }

  static std::string GetMembranes()
  {
    const ThreadedFigures f = MeasureThreaded(708);
    const auto facets = static_cast<double>(f.Facets);
    return "eye " + MakeNumber(1e3 * f.EyeWall, 3) + " ms (" + MakeNumber(1e3 * f.EyeCpu, 3) +
      " ms CPU); deforming " + MakeNumber(1e6 * f.DeformWall / facets) + " us a facet (" +
      MakeNumber(1e6 * f.DeformCpu / facets) + " us CPU)";
  }

  static std::string GetImages()
  {
    const ImageCount count = CountImages();
    return std::to_string(count.Images) + " images of " + std::to_string(count.Points) +
      " points: " + std::to_string(count.Missed) + " missed, " + std::to_string(count.False) +
      " false, " + std::to_string(count.Uncertain) + " points uncertain";
  }

  static std::string GetPictures()
  {
    std::string text;
    for (const test::PictureScene& scene : test::GetPictureScenes())
    {
      vtkNew<vtkPlaneSource> plane;
      const double half = 0.5 * scene.Size;
      plane->SetOrigin(-half, -scene.Depth, -half);
      plane->SetPoint1(-half, -scene.Depth, half);
      plane->SetPoint2(half, -scene.Depth, -half);
      plane->SetResolution(scene.Tiles, scene.Tiles);
      plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      plane->Update();
      test::AddPlaces(plane->GetOutput());
      vtkNew<vtkRefractedGeometryFilter> filter;
      filter->SetInputData(0, plane->GetOutput());
      filter->SetMembraneData(test::MakeMembrane(scene.Field.MakeMesh(scene.Cells)));
      filter->SetEyePosition(scene.Eye.x, scene.Eye.y, scene.Eye.z);
      filter->SetExteriorIndexOfRefraction(scene.Field.Exterior);
      filter->SetInteriorIndexOfRefraction(scene.Field.Interior);
      filter->Update();
      const test::PixelCamera camera = scene.GetCamera();
      const auto compared = test::ComparePlaces(
        test::TracePlaces(scene.Field, camera, test::MakeSquareTracer(-scene.Depth, scene.Size)),
        test::DrawPlaces(filter->GetOutput(), camera), camera);
      text += (text.empty() ? "" : "; ") + scene.Name + " " +
        MakeNumber(100.0 * (compared.Coverage + compared.Place) / compared.Covered) + " %";
    }
    return text;
  }

  static std::string GetWell()
  {
    std::string text;
    for (const WellFrames& frames : MeasureWell())
    {
      text += (text.empty() ? "" : "; ") + frames.Mode + " " + MakeNumber(frames.PerSecond, 3) +
        " (" + MakeNumber(frames.CpuMs, 3) + " ms CPU)";
    }
    return text;
  }

  static std::string GetPass()
  {
    std::string text;
    for (const PassFrames& frames : MeasurePass())
    {
      text += (text.empty() ? "" : "; ") + frames.Mode + " " + MakeNumber(frames.PerSecond, 3) +
        " (" + MakeNumber(frames.CpuMs, 3) + " ms CPU)";
    }
    return text;
  }

  static std::string MakePool()
  {
    const PoolPictures pictures = ComparePool();
    const auto describe = [](const char* name, const PoolFigures& figures)
    {
      return name + (", " + figures.SetUp) + ": " + MakeNumber(figures.Percent, 2) + " % in " +
        MakeNumber(figures.Ms, 3) + " ms (" + MakeNumber(figures.CpuMs, 3) + " ms CPU)";
    };
    return "new waves. Default tolerance: " + describe("pass", pictures.Pass) +
      (pictures.HasTraced ? "; " + describe("Embree", pictures.Traced) +
            ". At most the error of Embree: " + describe("pass", pictures.EqualPass)
                          : "") +
      ". Coarsest settings below " + MakeNumber(PoolPictures::AcceptedPercent) +
      " %: " + describe("pass", pictures.CoarsePass) +
      (pictures.HasTraced ? "; " + describe("Embree", pictures.CoarseTraced)
                          : std::string("; built without Embree"));
  }

  static std::string GetRaces()
  {
    std::string text;
    for (const RaceReport& report : RunRaces())
    {
      text += (text.empty() ? "" : "; ") + report.Ours + " against " + report.Traced;
      for (const Race& race : report.Races)
      {
        text += ", " + race.Change + " " + MakeNumber(race.TracedMs / race.OursMs, 3) + "x (" +
          MakeNumber(race.OursMs, 3) + " against " + MakeNumber(race.TracedMs, 3) + " ms; CPU " +
          MakeNumber(race.TracedCpuMs / race.OursCpuMs, 3) + "x, " + MakeNumber(race.OursCpuMs, 3) +
          " against " + MakeNumber(race.TracedCpuMs, 3) + " ms)";
      }
    }
    return text.empty() ? "skipped: built without Embree" : text;
  }

  static std::string GetFloor()
  {
    std::string text;
    for (const FloorFrame& frame : MeasureDrawingFloor())
    {
      text += (text.empty() ? "" : "; ") + frame.What + " " + MakeNumber(frame.Ms, 3) +
        " ms CPU, not blended " + MakeNumber(frame.UnblendedMs, 3);
    }
    return text;
  }

  std::ostream& Out;
  const RefractionOptions& Options;
};

} // anonymous namespace

//------------------------------------------------------------------------------
void PrintRefractionReport(std::ostream& out, const RefractionOptions& options)
{
  Report(out, options).Print();
}

} // namespace meniscus::benchmark

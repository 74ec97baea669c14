// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DrawingFloor.h"

#include "Timing.h"
#include "WellScene.h"

#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkRefractedGeometryFilter.h>

#include <functional>

namespace meniscus::benchmark
{

namespace
{

constexpr int Frames = 40;

// The set-up that the race of new colours chooses with all images.
constexpr int Cells = 32;
constexpr int Quads = 16;
constexpr double Tolerance = 0.015;

/** A kind of frame, in a window of its own. */
struct Kind
{
  std::string What;
  std::function<void(int)> Change; ///< before the measured time
  std::function<void(bool)> Draw;  ///< with blending or without
  std::vector<Seconds> Times[2];
};

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<FloorFrame> MeasureDrawingFloor()
{
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkPlaneSource> quad;
  quad->SetOrigin(-WellScene::HalfWidth * 3.0, 0.0, -WellScene::HalfWidth * 3.0);
  quad->SetPoint1(WellScene::HalfWidth * 3.0, 0.0, -WellScene::HalfWidth * 3.0);
  quad->SetPoint2(-WellScene::HalfWidth * 3.0, 0.0, WellScene::HalfWidth * 3.0);
  quad->Update();
  WellScene empty(Cells, Quads);
  WellScene one(Cells, Quads);
  WellScene well(Cells, Quads);
  WellScene water(Cells, Quads);
  empty.DrawInstead(nothing);
  one.DrawInstead(quad->GetOutput());
  well.DrawInstead(well.GetWell());
  water.GetFilter()->SetImages(vtkRefractedGeometryFilter::ALL_IMAGES);
  water.GetFilter()->SetAngularTolerance(Tolerance);

  std::vector<Kind> kinds;
  const auto add = [&kinds](const char* what, WellScene& scene, bool changes)
  {
    Kind kind;
    kind.What = what;
    kind.Change = [&scene, changes](int i)
    {
      if (changes)
      {
        scene.ChangeColors(i);
      }
    };
    kind.Draw = [&scene](bool blends)
    {
      scene.SetBlending(blends);
      scene.Draw();
    };
    kinds.push_back(kind);
  };
  add("an empty window", empty, false);
  add("one quad", one, false);
  add("the well without water, new colours", well, true);
  add("the well through water, unchanged", water, false);
  add("the well through water, new colours", water, true);
  for (int i = 0; i < Frames; ++i)
  {
    for (Kind& kind : kinds)
    {
      for (const bool blends : { true, false })
      {
        kind.Draw(blends); // what another kind has changed in the same scene
        kind.Change(2 * i + (blends ? 0 : 1));
        kind.Times[blends ? 0 : 1].push_back(TimeOnce([&] { kind.Draw(blends); }));
      }
    }
  }
  std::vector<FloorFrame> frames;
  for (const Kind& kind : kinds)
  {
    frames.push_back(
      { kind.What, 1e3 * MedianOf(kind.Times[0]).Cpu, 1e3 * MedianOf(kind.Times[1]).Cpu });
  }
  return frames;
}

} // namespace meniscus::benchmark

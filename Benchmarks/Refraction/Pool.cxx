// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pool.h"

#include "PoolScene.h"
#include "Timing.h"

#ifdef MENISCUS_HAS_EMBREE
#include "RefractionTracer.h"
#include "TracedWell.h"
#endif

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace meniscus::benchmark
{

namespace
{

constexpr int Cells = 16;
constexpr int PictureCells = 96;
constexpr int Frames = 60;
constexpr double Accepted = 8.0 / 255.0;

// An even number: the last frame has the waves that the truth is traced through, at time 0.
constexpr int PictureFrames = 10;
// Other waves, lower by one part in two million. If their points were equal, the filters would keep
// their results.
constexpr double OtherTime = 1e-3;

// Settings that are tried, the coarsest first.
constexpr int CoarseCells[] = { 8, 12, 16, 24, 32, 48, 64, PictureCells };
const std::vector<double> CoarseTolerances{ 0.08, 0.06, 0.04, 0.03, 0.02, 0.015, 0.01, 0.005 };
// Those around the default, for the error of the tracer.
const std::vector<double> FineTolerances{ 0.009, 0.008, 0.007, 0.0065, 0.006, 0.0055, 0.005 };
constexpr int TriedFrames = 3;

std::string NameFacets(int cells)
{
  return std::to_string(2 * cells * cells) + " facets";
}

test::PoolOptics Everything()
{
  return { true, true, glm::dvec3(0.02, 0.008, 0.004) };
}

double PercentOff(const std::vector<glm::dvec3>& colors, const test::PoolPicture& truth)
{
  double water = 0.0;
  double off = 0.0;
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    if (truth.IsWater[i])
    {
      const glm::dvec3 difference = glm::abs(colors[i] - truth.Colors[i]);
      water += 1.0;
      off += std::max({ difference.r, difference.g, difference.b }) > Accepted;
    }
  }
  return 100.0 * off / water;
}

template <typename Bytes>
std::vector<glm::dvec3> ToColors(const Bytes& bytes, std::size_t stride)
{
  std::vector<glm::dvec3> colors(bytes.size() / stride);
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    colors[i] = glm::dvec3(bytes[stride * i], bytes[stride * i + 1], bytes[stride * i + 2]) / 255.0;
  }
  return colors;
}

#ifdef MENISCUS_HAS_EMBREE

/** Shades Embree's hits as the scene does. */
class PoolShader : public TracedShader
{
public:
  explicit PoolShader(const test::PoolScene& scene)
    : Scene(scene)
  {
    for (int part = 0; part < scene.NumberOfParts(); ++part)
    {
      this->First.push_back(static_cast<std::uint32_t>(this->Mesh.Triangles.size() / 3));
      const auto firstPoint = static_cast<std::uint32_t>(this->Mesh.Points.size() / 3);
      vtkPolyData* data = scene.PartData(part);
      for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
      {
        this->Mesh.AddPoint(data->GetPoint(i));
      }
      vtkNew<vtkIdList> ids;
      for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
      {
        data->GetCellPoints(i, ids);
        for (vtkIdType k = 0; k < 3; ++k)
        {
          this->Mesh.Triangles.push_back(firstPoint + static_cast<std::uint32_t>(ids->GetId(k)));
        }
      }
    }
    this->Mesh.Finish();
  }

  const TracedMesh& MakeMesh() const { return this->Mesh; }

  void Shade(const TracedPacket& packet, unsigned char* rgba) const override
  {
    for (int k = 0; k < packet.Count; ++k)
    {
      glm::dvec3 color(0.0);
      if (packet.Facet[k] != TracedPacket::None)
      {
        test::PoolSight sight;
        sight.Ray = { packet.Sight[0][k], packet.Sight[1][k], packet.Sight[2][k] };
        sight.Normal = { packet.Normal[0][k], packet.Normal[1][k], packet.Normal[2][k] };
        if (packet.Triangle[k] != TracedPacket::None)
        {
          const auto next =
            std::upper_bound(this->First.begin(), this->First.end(), packet.Triangle[k]);
          sight.Part = static_cast<int>(next - this->First.begin()) - 1;
          sight.Cell = packet.Triangle[k] - *(next - 1);
          sight.Weights = { 1.0 - packet.U[k] - packet.V[k], packet.U[k], packet.V[k] };
          sight.Distance = packet.Depth[k];
        }
        color = this->Scene.Shade(sight);
      }
      for (int c = 0; c < 3; ++c)
      {
        rgba[4 * k + c] =
          static_cast<unsigned char>(std::lround(255.0 * std::clamp(color[c], 0.0, 1.0)));
      }
      rgba[4 * k + 3] = 255;
    }
  }

private:
  const test::PoolScene& Scene;
  TracedMesh Mesh;
  std::vector<std::uint32_t> First; ///< triangle of each part
};

PoolFigures TraceWithEmbree(
  const test::PoolScene& scene, const test::PoolPicture& truth, int cells, int frames)
{
  const PoolShader shader(scene);
  reference::HeightField other = scene.MakeField();
  other.Amplitude *= std::cos(OtherTime);
  const TracedMesh water[2] = { MembraneOf(scene.MakeField().MakeMesh(cells)),
    MembraneOf(other.MakeMesh(cells)) };
  RefractionTracer tracer;
  tracer.SetIndices(scene.MakeField().Exterior, scene.MakeField().Interior);
  tracer.SetMembrane(water[0]);
  tracer.SetObject(shader.MakeMesh());
  const test::PixelCamera& camera = scene.GetCamera();
  const TracedView view{ camera.GetEye(), camera.GetForward(), camera.GetRight(), camera.GetUp(),
    camera.GetPixels() };
  std::vector<unsigned char> picture(4 * truth.Colors.size());
  std::vector<Seconds> times;
  for (int i = 0; i < frames; ++i)
  {
    times.push_back(TimeOnce(
      [&]
      {
        tracer.MoveMembrane(water[i % 2 ? 0 : 1]);
        tracer.Trace(view, shader, picture.data());
      }));
  }
  const Seconds frame = MedianOf(times);
  return { NameFacets(cells), PercentOff(ToColors(picture, 4), truth), 1e3 * frame.Wall,
    1e3 * frame.Cpu };
}

PoolFigures FindCoarsestTraced(const test::PoolScene& scene, const test::PoolPicture& truth)
{
  for (const int cells : CoarseCells)
  {
    if (TraceWithEmbree(scene, truth, cells, 2).Percent <= PoolPictures::AcceptedPercent)
    {
      return TraceWithEmbree(scene, truth, cells, PictureFrames);
    }
  }
  return {};
}

#endif

PoolFigures DrawWithPass(test::PoolScene& scene, const test::PoolPicture& truth, int frames)
{
  PoolFigures result;
  std::vector<Seconds> times;
  test::ByteImage drawn;
  for (int i = 0; i < frames; ++i)
  {
    scene.MoveWater(i % 2 ? 0.0 : OtherTime);
    times.push_back(TimeOnce([&] { drawn = scene.Draw(); }));
  }
  const Seconds frame = MedianOf(times);
  result.Ms = 1e3 * frame.Wall;
  result.CpuMs = 1e3 * frame.Cpu;
  result.Percent = PercentOff(ToColors(drawn.Rgb, 3), truth);
  return result;
}

PoolFigures DrawCoarsely(const test::PoolPicture& truth, int cells, double tolerance, int frames)
{
  test::PoolScene scene(cells);
  scene.SetOptics(Everything());
  scene.SetAccuracy(true, tolerance);
  PoolFigures result = DrawWithPass(scene, truth, frames);
  std::ostringstream text;
  text << NameFacets(cells) << ", tolerance " << tolerance << " degrees";
  result.SetUp = text.str();
  return result;
}

// The cheapest of several tolerances, each with the coarsest membrane that reaches the error.
PoolFigures FindCoarsestPass(
  const test::PoolPicture& truth, double accepted, const std::vector<double>& tolerances)
{
  double least = std::numeric_limits<double>::max();
  int chosen = PictureCells;
  double chosenTolerance = tolerances.back();
  for (const double tolerance : tolerances)
  {
    for (const int cells : CoarseCells)
    {
      if (DrawCoarsely(truth, cells, tolerance, 2).Percent > accepted)
      {
        continue;
      }
      const double ms = DrawCoarsely(truth, cells, tolerance, TriedFrames).CpuMs;
      if (ms < least)
      {
        least = ms;
        chosen = cells;
        chosenTolerance = tolerance;
      }
      break;
    }
  }
  return DrawCoarsely(truth, chosen, chosenTolerance, PictureFrames);
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<PassFrames> MeasurePass()
{
  const struct
  {
    const char* Name;
    bool All;
    double Tolerance;
    bool Objects;
  } modes[] = { { "well, FIRST_IMAGE", false, 0.005, false },
    { "well, ALL_IMAGES, 0.05 degrees", true, 0.05, false },
    { "well, ALL_IMAGES, 0.005 degrees", true, 0.005, false },
    { "with three objects, ALL_IMAGES, 0.05 degrees", true, 0.05, true } };
  std::vector<PassFrames> result;
  for (const auto& mode : modes)
  {
    test::PoolScene scene(Cells);
    scene.SetOptics(Everything());
    scene.SetAccuracy(mode.All, mode.Tolerance);
    scene.ShowObjects(mode.Objects);
    std::vector<Seconds> times;
    for (int i = 0; i < Frames; ++i)
    {
      times.push_back(TimeOnce(
        [&]
        {
          scene.MoveWater(0.02 * i);
          scene.GetWindow()->Render();
          scene.GetWindow()->WaitForCompletion();
        }));
    }
    const Seconds frame = MedianOf(times);
    result.push_back({ mode.Name, 1.0 / frame.Wall, 1e3 * frame.Cpu });
  }
  return result;
}

//------------------------------------------------------------------------------
PoolPictures ComparePool()
{
  test::PoolScene scene(PictureCells);
  scene.SetOptics(Everything());
  const test::PoolPicture truth = scene.Trace();
  PoolPictures result;
  result.Pass = DrawWithPass(scene, truth, PictureFrames);
  result.Pass.SetUp = NameFacets(PictureCells) + ", default tolerance";
  result.CoarsePass = FindCoarsestPass(truth, PoolPictures::AcceptedPercent, CoarseTolerances);
#ifdef MENISCUS_HAS_EMBREE
  result.HasTraced = true;
  result.Traced = TraceWithEmbree(scene, truth, PictureCells, PictureFrames);
  result.EqualPass = FindCoarsestPass(truth, result.Traced.Percent, FineTolerances);
  result.CoarseTraced = FindCoarsestTraced(scene, truth);
#endif
  return result;
}

} // namespace meniscus::benchmark

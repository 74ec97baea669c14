// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals.h"

#ifdef MENISCUS_HAS_EMBREE

#include "Chart.h"
#include "Timing.h"
#include "TracedWell.h"

#include <vtkRefractedGeometryFilter.h>

#include <cmath>
#include <utility>
#include <vector>

#endif

namespace meniscus::benchmark
{

#ifdef MENISCUS_HAS_EMBREE

namespace
{

constexpr int Frames = 9;

// Facets along a side of the waves. Flat water needs no more than the fewest.
constexpr int WaveCells[] = { 8, 16, 32, 64, 128 };
constexpr int FlatCells = 8;

// Quads along a side of the well: lines of virtual geometry are straight between points, unless the
// filter divides them.
constexpr int Quads = 16;
constexpr int FinerQuads[] = { 16, 32, 64 };
constexpr int FewCells = 32; ///< of which 32 quads do not add to the error
// Tolerances in degrees, each with as many facets along a side of the waves as it deserves.
constexpr std::pair<double, int> Tolerances[] = { { 0.06, 16 }, { 0.03, 32 }, { 0.015, 32 },
  { 0.005, 64 } };
constexpr int MapSize = 512;

/** One setting of a way to draw. */
struct RivalPoint
{
  std::string Setting;
  double CpuMs = 0.0;
  double Pixels = 0.0; ///< error of 99 % of the pixels that both pictures cover
  int Coverage = 0;    ///< pixels that only one of the pictures covers
};

struct Rival
{
  std::string Name;
  std::vector<RivalPoint> Points;
};

/** Places and colours by a direction, or by a place in a plane. */
struct PlaceMap
{
  std::vector<test::PlacePixel> Places;
  std::vector<std::uint32_t> Colors;

  void Add(const test::PlacePixel& place)
  {
    this->Places.push_back(place);
    this->Colors.push_back(0xff000000u + static_cast<std::uint32_t>(this->Colors.size()));
  }
};

/** A picture of which each pixel is looked up by the refracted ray. */
class LookUp : public TracedShader
{
public:
  explicit LookUp(PlaceMap map)
    : Map(std::move(map))
  {
  }

  void Shade(const TracedPacket& packet, unsigned char* rgba) const override
  {
    auto* colors = reinterpret_cast<std::uint32_t*>(rgba);
    for (int k = 0; k < packet.Count; ++k)
    {
      const long texel = packet.Facet[k] == TracedPacket::None ? -1 : this->Find(packet, k);
      colors[k] = texel < 0 ? 0u : this->Map.Colors[static_cast<std::size_t>(texel)];
    }
  }

  test::PlacePicture MakePicture(const RefractionTracer& tracer, const TracedView& view) const
  {
    test::PlacePicture picture(static_cast<std::size_t>(view.Pixels) * view.Pixels);
    TracePixels(tracer, view,
      [this, &picture](const TracedPacket& packet, int k, std::size_t number)
      {
        const long texel = packet.Facet[k] == TracedPacket::None ? -1 : this->Find(packet, k);
        if (texel >= 0)
        {
          picture[number] = this->Map.Places[static_cast<std::size_t>(texel)];
        }
      });
    return picture;
  }

protected:
  /** Texel of a pixel of the packet, or -1. */
  virtual long Find(const TracedPacket& packet, int k) const = 0;

private:
  PlaceMap Map;
};

/** Direction of a texel of a cube map; the largest component has the face. */
glm::dvec3 DirectionOf(int face, double s, double t)
{
  glm::dvec3 direction;
  direction[face / 2] = face % 2 ? -1.0 : 1.0;
  direction[(face / 2 + 1) % 3] = s;
  direction[(face / 2 + 2) % 3] = t;
  return direction;
}

/** The well as seen from the middle of the water at rest. */
PlaceMap MakeEnvironment()
{
  PlaceMap map;
  for (int face = 0; face < 6; ++face)
  {
    for (int j = 0; j < MapSize; ++j)
    {
      for (int i = 0; i < MapSize; ++i)
      {
        map.Add(WellScene::Meet(glm::dvec3(0.0),
          DirectionOf(face, 2.0 * (i + 0.5) / MapSize - 1.0, 2.0 * (j + 0.5) / MapSize - 1.0)));
      }
    }
  }
  return map;
}

/** Refraction mapping: the direction of the refracted ray alone decides on the place. */
class EnvironmentMap : public LookUp
{
public:
  EnvironmentMap()
    : LookUp(MakeEnvironment())
  {
  }

protected:
  long Find(const TracedPacket& packet, int k) const override
  {
    const float d[3] = { packet.Refracted[0][k], packet.Refracted[1][k], packet.Refracted[2][k] };
    int axis = 0;
    for (int i = 1; i < 3; ++i)
    {
      axis = std::fabs(d[i]) > std::fabs(d[axis]) ? i : axis;
    }
    const float scale = 1.0f / std::fabs(d[axis]);
    const auto texel = [&](int i)
    {
      const float at = 0.5f * (scale * d[(axis + i) % 3] + 1.0f) * MapSize;
      return std::min(static_cast<long>(at), MapSize - 1L);
    };
    const long face = 2 * axis + (d[axis] < 0.0f);
    return (face * MapSize + texel(2)) * MapSize + texel(1);
  }
};

constexpr double BackdropHalfWidth = 2.5 * WellScene::HalfWidth;

/** Straight lines from the eye to a plane at the depth of the bottom. */
PlaceMap MakeBackdrop(const glm::dvec3& eye)
{
  PlaceMap map;
  for (int j = 0; j < 2 * MapSize; ++j)
  {
    for (int i = 0; i < 2 * MapSize; ++i)
    {
      const auto at = [](int texel) { return ((texel + 0.5) / MapSize - 1.0) * BackdropHalfWidth; };
      map.Add(WellScene::Meet(eye, glm::dvec3(at(i), -WellScene::Depth, at(j)) - eye));
    }
  }
  return map;
}

/** Warped backdrop: the refracted ray is looked up where it meets the plane of the bottom. */
class WarpedBackdrop : public LookUp
{
public:
  explicit WarpedBackdrop(const glm::dvec3& eye)
    : LookUp(MakeBackdrop(eye))
  {
  }

protected:
  long Find(const TracedPacket& packet, int k) const override
  {
    const float depth =
      (static_cast<float>(-WellScene::Depth) - packet.Place[1][k]) / packet.Refracted[1][k];
    const auto texel = [&](int axis)
    {
      const float at = packet.Place[axis][k] + depth * packet.Refracted[axis][k];
      return static_cast<long>(
        std::floor((at / static_cast<float>(BackdropHalfWidth) + 1.0f) * MapSize));
    };
    const long i = texel(0);
    const long j = texel(2);
    constexpr long size = 2 * MapSize;
    return i < 0 || j < 0 || i >= size || j >= size ? -1 : j * size + i;
  }
};

//------------------------------------------------------------------------------
class RivalTrack
{
public:
  explicit RivalTrack(WellSurface surface)
    : Surface(surface)
    , IsFlat(surface == WellSurface::Plane)
  {
    const WellScene scene(FlatCells, Quads, surface);
    this->Truth = scene.Trace();
    this->Cells = { std::begin(WaveCells), std::end(WaveCells) };
    if (this->IsFlat)
    {
      this->Cells = { FlatCells };
    }
  }

  std::vector<Rival> Run()
  {
    std::vector<Rival> rivals;
    const WellScene scene(FlatCells, Quads, this->Surface);
    const EnvironmentMap environment;
    const WarpedBackdrop backdrop(scene.GetCamera().GetEye());
    rivals.push_back(this->RunTraced("refraction mapping", &environment));
    rivals.push_back(this->RunTraced("warped backdrop", &backdrop));
    rivals.push_back(this->RunMatrix());
    rivals.push_back(this->RunFirst("flat facets", vtkRefractedGeometryFilter::FLAT_FACETS));
    rivals.push_back(this->RunFirst("curved, first image", vtkRefractedGeometryFilter::CURVED));
    rivals.push_back(this->RunAll());
    rivals.push_back(this->RunTraced("Embree tracer", nullptr));
    return rivals;
  }

private:
  RivalPoint Judge(const std::string& setting, const test::PlacePicture& picture,
    const test::PixelCamera& camera, const Seconds& time) const
  {
    const test::PlaceComparison comparison = test::ComparePlaces(this->Truth, picture, camera);
    return { setting, 1e3 * time.Cpu, comparison.Error, comparison.Coverage };
  }

  // Times of frames of a scene that draws geometry.
  RivalPoint Measure(const std::string& setting, WellScene& scene) const
  {
    const test::PlacePicture picture = scene.DrawPlaces();
    const test::PixelCamera camera = scene.GetCamera();
    std::vector<Seconds> times;
    scene.Draw();
    for (int i = 0; i < Frames; ++i)
    {
      scene.MoveMembrane(0.1 * (i + 1));
      times.push_back(TimeOnce([&] { scene.Draw(); }));
    }
    return this->Judge(setting, picture, camera, MedianOf(times));
  }

  Rival RunMatrix() const
  {
    WellScene scene(FlatCells, Quads, this->Surface);
    scene.UseMatrix();
    return { "one matrix (Diefenbach)", { this->Measure("", scene) } };
  }

  Rival RunFirst(const char* name, int model) const
  {
    Rival rival{ name, {} };
    // Behind waves as many quads as the facets deserve.
    for (const int cells : this->Cells)
    {
      for (const int quads : FinerQuads)
      {
        if (!this->IsFlat && quads != FinerQuads[cells <= FewCells ? 1 : 2])
        {
          continue;
        }
        WellScene scene(cells, quads, this->Surface);
        scene.GetFilter()->SetMembraneModel(model);
        scene.GetFilter()->SetImages(vtkRefractedGeometryFilter::FIRST_IMAGE);
        rival.Points.push_back(this->Measure(std::to_string(2 * cells * cells) + " facets, " +
            std::to_string(5 * quads * quads) + " quads",
          scene));
      }
    }
    return rival;
  }

  Rival RunAll() const
  {
    Rival rival{ "curved, all images", {} };
    for (const auto& setting : Tolerances)
    {
      const double tolerance = setting.first;
      const int cells = this->IsFlat ? FlatCells : setting.second;
      WellScene scene(cells, Quads, this->Surface);
      scene.GetFilter()->SetImages(vtkRefractedGeometryFilter::ALL_IMAGES);
      scene.GetFilter()->SetAngularTolerance(tolerance);
      std::string text = std::to_string(tolerance);
      text.erase(text.find_last_not_of('0') + 1);
      rival.Points.push_back(
        this->Measure(std::to_string(2 * cells * cells) + " facets, " + text + " degrees", scene));
    }
    return rival;
  }

  // A picture by rays: looked up, or traced if there is no map.
  Rival RunTraced(const char* name, const LookUp* map) const
  {
    Rival rival{ name, {} };
    for (const int cells : this->Cells)
    {
      WellScene scene(cells, Quads, this->Surface);
      std::vector<TracedMesh> water;
      for (int i = 0; i <= Frames; ++i)
      {
        reference::HeightField field = scene.FieldAt(0.1 * i);
        field.Amplitude = this->IsFlat ? 0.0 : field.Amplitude;
        water.push_back(MembraneOf(field.MakeMesh(cells)));
      }
      TracedMesh object = ObjectOf(scene.GetWell());
      if (map)
      {
        object.Triangles.resize(3); // the rays behind the membrane meet next to nothing
      }
      const TriangleColors colors = ColorsOf(scene.GetWell());
      RefractionTracer tracer;
      tracer.SetIndices(scene.MakeField().Exterior, scene.MakeField().Interior);
      tracer.SetMembrane(water[0]);
      tracer.SetObject(object);
      const TracedView view = ViewOf(scene.GetCamera());
      const test::PlacePicture picture =
        map ? map->MakePicture(tracer, view) : PlacesOf(tracer, scene.GetCamera());
      const TracedShader* shader = &colors;
      if (map)
      {
        shader = map;
      }
      std::vector<unsigned char> rgba(std::size_t(4) * 512 * 512);
      std::vector<Seconds> times;
      for (int i = 1; i <= Frames; ++i)
      {
        times.push_back(TimeOnce(
          [&]
          {
            tracer.MoveMembrane(water[static_cast<std::size_t>(i)]);
            tracer.Trace(view, *shader, rgba.data());
          }));
      }
      rival.Points.push_back(this->Judge(std::to_string(2 * cells * cells) + " facets", picture,
        scene.GetCamera(), MedianOf(times)));
    }
    return rival;
  }

  WellSurface Surface;
  bool IsFlat;
  std::vector<int> Cells;
  test::PlacePicture Truth;
};

// Diefenbach's matrix by the angle of incidence: the direction in which it shows a point of the
// well's bottom, against the sight ray of that angle. The eye is as high above flat water as the
// well's.
void PrintMatrixByAngle(std::ostream& out)
{
  constexpr double index = 1.333;
  constexpr double height = 300.0;
  constexpr double radian = 0.017453292519943295;
  out << "one matrix: degrees of incidence, error in degrees\n";
  for (int angle = 0; angle <= 75; angle += 15)
  {
    const double incidence = angle * radian;
    const double behind = std::asin(std::sin(incidence) / index);
    const double across = height * std::tan(incidence) + WellScene::Depth * std::tan(behind);
    // The line from the point to the apparent eye, `index` times as high, meets the water here.
    const double sight = across * index * height / (index * height + WellScene::Depth);
    out << angle << " | " << (std::atan2(sight, height) - incidence) / radian << '\n';
  }
}

bool Compare(
  WellSurface surface, const std::string& title, const std::string& file, std::ostream& out)
{
  std::vector<ChartSeries> series;
  out << title << "\nms of processor time, error in pixels, pixels covered by one only\n";
  for (const Rival& rival : RivalTrack(surface).Run())
  {
    ChartSeries line{ rival.Name, {} };
    for (const RivalPoint& point : rival.Points)
    {
      line.Points.emplace_back(point.CpuMs, point.Pixels);
      out << rival.Name << " | " << point.Setting << " | " << point.CpuMs << " | " << point.Pixels
          << " | " << point.Coverage << std::endl;
    }
    series.push_back(line);
  }
  return WriteChart(file, title, "milliseconds of processor time per frame",
    "error of 99 % of the pixels, in pixels", series);
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool CompareRivals(const std::string& folder, std::ostream& out)
{
  const bool pool =
    Compare(WellSurface::Waves, "The well below waves", folder + "/rivals-pool.png", out);
  PrintMatrixByAngle(out);
  return Compare(
           WellSurface::Plane, "The well below flat water", folder + "/rivals-flat.png", out) &&
    pool;
}

#else

//------------------------------------------------------------------------------
bool CompareRivals(const std::string&, std::ostream&)
{
  return false;
}

#endif

} // namespace meniscus::benchmark

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumePaper.h"

#include "Chart.h"
#include "VolumeComparison.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkSMPTools.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>

namespace meniscus::benchmark
{

using namespace meniscus::test;

namespace
{

constexpr double Pi = 3.14159265358979324;
constexpr double EarlyOpacity = 0.99;

using Curve = std::vector<double>;

double MeanOf(const Curve& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double CorrelationOf(const Curve& a, const Curve& b)
{
  const double means[2] = { MeanOf(a), MeanOf(b) };
  double products[3] = {};
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double d[2] = { a[i] - means[0], b[i] - means[1] };
    products[0] += d[0] * d[0];
    products[1] += d[1] * d[1];
    products[2] += d[0] * d[1];
  }
  return products[2] / std::sqrt(products[0] * products[1]);
}

ChartSeries RelativeTo(double unit, const std::string& label, const Curve& values)
{
  ChartSeries series{ label, {} };
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    series.Points.emplace_back(static_cast<double>(i), values[i] / unit);
  }
  return series;
}

/** The mesh in a window, drawn natively. */
class PaperScene
{
public:
  PaperScene(const VolumeOptions& options, vtkUnstructuredGrid* mesh)
    : Mesh(mesh)
    , Scene(options.Width, options.Height)
  {
    FunctionKind kind = FunctionKind::Smooth;
    FindFunctionKind(options.Function, kind);
    this->Property = MakeProperty(kind, mesh, DiagonalOf(mesh->GetBounds()));
    this->Mapper = vtkTetrahedraRayCastMapper::SafeDownCast(
      MakeOurs(vtkTetrahedraRayCastMapper::NATIVE, "").Make());
    this->Mapper->SetInputData(mesh);
    this->Scene.SetMapper(this->Mapper);
    this->Scene.SetProperty(this->Property);
  }

  void Look(double azimuth, double elevation)
  {
    LookAt(this->Scene.GetRenderer(), this->Mesh->GetBounds(), azimuth, elevation);
  }

  /** Processor time of a frame in milliseconds. */
  double Draw()
  {
    this->Mapper->Modified(); // otherwise the last image is shown again
    const double begin = CpuMilliseconds();
    this->Scene.GetWindow()->Render();
    return CpuMilliseconds() - begin;
  }

  double CountSteps(double terminationOpacity)
  {
    this->Mapper->SetEarlyTerminationOpacity(terminationOpacity);
    this->Draw();
    return static_cast<double>(this->Mapper->GetNumberOfTraversalSteps());
  }

  vtkTetrahedraRayCastMapper* GetMapper() const { return this->Mapper; }
  VolumeScene& GetScene() { return this->Scene; }
  vtkVolumeProperty* GetProperty() const { return this->Property; }

private:
  vtkUnstructuredGrid* Mesh;
  VolumeScene Scene;
  vtkSmartPointer<vtkVolumeProperty> Property;
  vtkSmartPointer<vtkTetrahedraRayCastMapper> Mapper;
};

//------------------------------------------------------------------------------
bool DrawViews(std::ostream& out, const VolumeOptions& options, PaperScene& scene)
{
  constexpr int frames = 90;
  Curve times(frames, std::numeric_limits<double>::infinity());
  Curve steps(frames);
  scene.Look(0.0, 0.0);
  scene.Draw();
  // Rounds over all views: what disturbs the processor for a while disturbs one round of a view.
  for (int round = 0; round < options.Repetitions; ++round)
  {
    for (int i = 0; i < frames; ++i)
    {
      const double turn = 2.0 * Pi * i / frames;
      scene.Look(360.0 * i / frames, 75.0 * std::sin(3.0 * turn));
      times[i] = std::min(times[i], scene.Draw());
      steps[i] = static_cast<double>(scene.GetMapper()->GetNumberOfTraversalSteps());
    }
  }
  const auto ends = std::minmax_element(times.begin(), times.end());
  out << "views: " << *ends.first << " to " << *ends.second << " ms of processor time, mean "
      << MeanOf(times) << "; " << MeanOf(steps) << " steps, " << 1e3 * MeanOf(steps) / MeanOf(times)
      << " per second of processor time; correlation " << CorrelationOf(times, steps) << std::endl;
  return WriteChart(options.Paper + "/paper-views.png", "Frames of a turning camera", "frame",
    "relative to the mean",
    { RelativeTo(MeanOf(times), "processor time", times),
      RelativeTo(MeanOf(steps), "steps", steps) },
    ChartScale::Linear);
}

/** Numbers of steps of the rays: of all that meet the mesh, to their ends and to an opacity. */
struct StepCounts
{
  std::vector<int> Whole;
  std::vector<int> Early;
};

StepCounts CountSteps(const reference::ReferenceRayIntegrator& integrator, const PixelRays& rays,
  const reference::ReferenceTransferFunction& function)
{
  const auto pixels = static_cast<std::size_t>(rays.GetWidth()) * rays.GetHeight();
  StepCounts counts{ std::vector<int>(pixels), std::vector<int>(pixels) };
  vtkSMPTools::For(0, rays.GetHeight(),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<reference::RaySegment> segments;
      for (auto y = static_cast<int>(begin); y < end; ++y)
      {
        for (int x = 0; x < rays.GetWidth(); ++x)
        {
          const auto pixel = static_cast<std::size_t>(y) * rays.GetWidth() + x;
          const reference::Ray ray = rays.GetRay(x, y);
          integrator.FindVisibleSegments(ray, function, segments);
          counts.Whole[pixel] = static_cast<int>(segments.size());
          double passing = 1.0;
          std::size_t step = 0;
          while (step < segments.size() && passing > 1.0 - EarlyOpacity)
          {
            passing *= 1.0 - integrator.Integrate(ray, { segments[step] }, function)[3];
            ++step;
          }
          counts.Early[pixel] = static_cast<int>(step);
        }
      }
    });
  return counts;
}

/** Number of rays that take a step, by the number of the step. */
Curve WalkingRays(const std::vector<int>& counts)
{
  Curve rays(static_cast<std::size_t>(*std::max_element(counts.begin(), counts.end())) + 1);
  for (const int count : counts)
  {
    std::for_each(rays.begin(), rays.begin() + count, [](double& number) { ++number; });
  }
  return rays;
}

bool DrawSteps(
  std::ostream& out, const VolumeOptions& options, PaperScene& scene, vtkUnstructuredGrid* mesh)
{
  const auto angles = ViewAngles(0);
  scene.Look(angles[0], angles[1]);
  const double whole = scene.CountSteps(1.0);
  const double early = scene.CountSteps(EarlyOpacity);
  const StepCounts counts = CountSteps(*MakeReference(mesh),
    PixelRays(scene.GetScene().GetRenderer()), ToReference(scene.GetProperty()));
  const Curve walking = WalkingRays(counts.Whole);
  const Curve walkingEarly = WalkingRays(counts.Early);
  const auto sum = [](const Curve& values)
  { return std::accumulate(values.begin(), values.end(), 0.0); };
  Curve brute(walking.size(), walking.front());
  brute.back() = 0.0;
  out << "steps: " << walking.size() - 1 << " passes and " << sum(walking)
      << " steps of the reference (mapper: " << whole << "), to an opacity of " << EarlyOpacity
      << " " << walkingEarly.size() - 1 << " and " << sum(walkingEarly) << " (mapper: " << early
      << "), without ends " << sum(brute) << std::endl;
  return WriteChart(options.Paper + "/paper-steps.png",
    "Rays that walk, " + options.Function + " function", "step", "rays",
    { RelativeTo(1.0, "all rays until the last ends", brute),
      RelativeTo(1.0, "rays in the mesh", walking),
      RelativeTo(1.0, "until an opacity of 0.99", walkingEarly) },
    ChartScale::Linear);
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool DrawPaper(std::ostream& out, const VolumeOptions& options)
{
  const Grid mesh = MakeVolumeMesh(options);
  if (!mesh)
  {
    out << "no cells or no point array in " << options.Mesh << '\n';
    return false;
  }
  PaperScene scene(options, mesh);
  return DrawViews(out, options, scene) && DrawSteps(out, options, scene, mesh);
}

} // namespace meniscus::benchmark

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeComparison.h"

#include "PixelRays.h"
#include "VolumeDevice.h"

#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace meniscus::benchmark
{

using namespace meniscus::test;

namespace
{

//------------------------------------------------------------------------------
// Accumulates |image - reference| over the pixels of several views.
class ErrorSum
{
public:
  void Add(double difference, bool covered)
  {
    this->Largest = std::max(this->Largest, difference);
    if (covered)
    {
      this->Squares += difference * difference;
      this->Off += difference > 2.0 / 255.0;
      ++this->Covered;
    }
  }

  PictureError GetResult() const
  {
    const double covered = std::max<double>(1.0, static_cast<double>(this->Covered));
    return { this->Largest, std::sqrt(this->Squares / covered),
      static_cast<double>(this->Off) / covered };
  }

private:
  double Largest = 0.0;
  double Squares = 0.0;
  std::size_t Covered = 0;
  std::size_t Off = 0;
};

} // anonymous namespace

//------------------------------------------------------------------------------
double CpuMilliseconds()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1e3 * (usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
    1e-3 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

//------------------------------------------------------------------------------
Spread SpreadOf(std::vector<double> values)
{
  if (values.empty())
  {
    return {};
  }
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share)
  {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return { at(0.5), at(0.25), at(0.75) };
}

//------------------------------------------------------------------------------
Spread RatioOf(const Figures& slow, const Figures& fast, bool cpu)
{
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(slow.Frames.size(), fast.Frames.size()); ++i)
  {
    ratios.push_back(cpu ? slow.Frames[i].CpuMs / fast.Frames[i].CpuMs
                         : slow.Frames[i].WallMs / fast.Frames[i].WallMs);
  }
  return SpreadOf(ratios);
}

//------------------------------------------------------------------------------
VolumeComparison::VolumeComparison(const VolumeOptions& options, vtkUnstructuredGrid* grid)
  : Settings(options)
  , Grid(grid)
{
}

//------------------------------------------------------------------------------
VolumeComparison::~VolumeComparison() = default;

//------------------------------------------------------------------------------
void VolumeComparison::LookFrom(VolumeScene& scene, int view) const
{
  const auto angles = ViewAnglesOf(this->Settings.Mode, view);
  LookAt(scene.GetRenderer(), this->Grid->GetBounds(), angles[0], angles[1]);
}

//------------------------------------------------------------------------------
FrameTime VolumeComparison::TimeFrame(Arena& arena) const
{
  const double cpu = CpuMilliseconds();
  const auto begin = std::chrono::steady_clock::now();
  arena.Scene->GetWindow()->Render();
  arena.Scene->GetWindow()->WaitForCompletion();
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - begin;
  return { wall.count(), CpuMilliseconds() - cpu };
}

//------------------------------------------------------------------------------
// Every frame differs slightly from the last one, so that every mapper does the work for a moving
// camera and none can show its last image again.
FrameTime VolumeComparison::TimeSteady(Arena& arena, int view) const
{
  constexpr double degrees = 1.0e-3;
  this->LookFrom(*arena.Scene, view);
  arena.Turned = !arena.Turned;
  arena.Scene->GetRenderer()->GetActiveCamera()->Azimuth(arena.Turned ? degrees : -degrees);
  return this->TimeFrame(arena);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkVolumeProperty> VolumeComparison::PropertyOf(FunctionKind kind) const
{
  return MakeProperty(kind, this->Grid, DiagonalOf(this->Grid->GetBounds()));
}

//------------------------------------------------------------------------------
void VolumeComparison::Enter(const std::vector<Contestant>& contestants)
{
  this->Arenas.clear();
  this->Results.clear();
  std::vector<double> emptyMs;
  for (const Contestant& contestant : contestants)
  {
    Arena arena{ contestant, contestant.Make(),
      std::make_unique<VolumeScene>(this->Settings.Width, this->Settings.Height) };
    this->LookFrom(*arena.Scene, 0);
    arena.Scene->GetVolume()->SetVisibility(false);
    this->TimeFrame(arena); // opens the window
    constexpr int emptyFrames = 5;
    for (int i = 0; i < emptyFrames; ++i)
    {
      emptyMs.push_back(this->TimeSteady(arena, 0).WallMs);
    }
    this->Device = DeviceName(arena.Scene->GetWindow());
    Figures figures;
    figures.Name = contestant.Name;
    figures.HasFloat = contestant.HasFloat;
    arena.Mapper->SetInputDataObject(this->Grid);
    arena.Scene->SetMapper(arena.Mapper);
    const auto property = this->PropertyOf(contestant.Function);
    ApplyMode(this->Settings.Mode, this->Grid, arena.Mapper, property);
    arena.Scene->SetProperty(property);
    arena.Scene->GetVolume()->SetVisibility(true);
    figures.ColdMs = this->TimeFrame(arena).WallMs;
    this->Arenas.push_back(std::move(arena));
    this->Results.push_back(figures);
  }
  this->EmptyMs = SpreadOf(emptyMs).Median;
  if (this->Settings.Bandwidth && !this->Arenas.empty())
  {
    this->CopyBandwidth = MeasureCopyBandwidth(this->Arenas.front().Scene->GetWindow());
  }
}

//------------------------------------------------------------------------------
bool VolumeComparison::WritePictures(const std::string& start)
{
  bool written = true;
  for (Arena& arena : this->Arenas)
  {
    this->LookFrom(*arena.Scene, 0);
    const ByteImage picture = arena.Scene->RenderBytes();
    vtkNew<vtkImageData> image;
    image->SetDimensions(picture.Width, picture.Height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    std::copy(picture.Rgb.begin(), picture.Rgb.end(),
      static_cast<unsigned char*>(image->GetScalarPointer()));
    std::string name = arena.Player.Name;
    std::replace(name.begin(), name.end(), '/', '-');
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName((start + "-" + name + ".png").c_str());
    writer->SetInputData(image);
    writer->Write();
    written = written && writer->GetErrorCode() == 0;
  }
  return written;
}

//------------------------------------------------------------------------------
void VolumeComparison::AddCounters(std::size_t contestant, double& steps)
{
  auto* mapper = this->GetOurs(contestant);
  if (!mapper)
  {
    return;
  }
  Figures& figures = this->Results[contestant];
  steps += static_cast<double>(mapper->GetNumberOfTraversalSteps());
  figures.LostRays += static_cast<double>(mapper->GetNumberOfLostRays());
  figures.DeviceBytes = mapper->GetStatistic("DeviceBytes");
  figures.HostBytes = mapper->GetStatistic("HostBytes");
  if (mapper->GetActiveBackend() != vtkTetrahedraRayCastMapper::NATIVE)
  {
    figures.TableBytesPerStep = 32.0 + 16.0;
  }
}

//------------------------------------------------------------------------------
void VolumeComparison::TimeRound(int view)
{
  for (std::size_t i = 0; i < this->Arenas.size(); ++i)
  {
    this->Results[i].Frames.push_back(this->TimeSteady(this->Arenas[i], view));
  }
}

//------------------------------------------------------------------------------
void VolumeComparison::MeasureTimes()
{
  std::vector<double> steps(this->Arenas.size(), 0.0);
  for (Figures& figures : this->Results)
  {
    figures.Frames.clear();
    figures.ViewMs.clear();
    figures.LostRays = 0.0;
  }
  for (int view = 0; view < this->Settings.Views; ++view)
  {
    for (Arena& arena : this->Arenas)
    {
      this->TimeSteady(arena, view); // warm-up
    }
    for (int round = 0; round < this->Settings.Repetitions; ++round)
    {
      this->TimeRound(view);
    }
    for (std::size_t i = 0; i < this->Arenas.size(); ++i)
    {
      this->AddCounters(i, steps[i]);
    }
  }
  for (std::size_t i = 0; i < this->Arenas.size(); ++i)
  {
    Figures& figures = this->Results[i];
    std::vector<double> cpu;
    double sum = 0.0;
    for (int view = 0; view < this->Settings.Views; ++view)
    {
      std::vector<double> rounds;
      for (int round = 0; round < this->Settings.Repetitions; ++round)
      {
        const FrameTime& frame =
          figures.Frames[static_cast<std::size_t>(view) * this->Settings.Repetitions + round];
        rounds.push_back(frame.WallMs);
        cpu.push_back(frame.CpuMs);
      }
      figures.ViewMs.push_back(SpreadOf(rounds).Median);
      sum += figures.ViewMs.back();
    }
    figures.SteadyMs = SpreadOf(figures.ViewMs).Median;
    figures.CpuMs = SpreadOf(cpu).Median;
    figures.StepsPerSecond = steps[i] / (1e-3 * sum);
    if (this->Settings.SetUpRepetitions > 0)
    {
      figures.SetUpMs =
        SpreadOf(this->MeasureSetUp(i, this->Settings.SetUpRepetitions).ChangedMs).Median;
    }
  }
}

//------------------------------------------------------------------------------
VolumeComparison::Change VolumeComparison::MeasureChange(
  std::size_t contestant, int times, const std::function<void(Arena&, int)>& change)
{
  Arena& arena = this->Arenas[contestant];
  Change result;
  for (int i = 0; i < times; ++i)
  {
    this->TimeSteady(arena, i % this->Settings.Views);
    result.SteadyMs.push_back(this->TimeSteady(arena, i % this->Settings.Views).WallMs);
    change(arena, i);
    result.ChangedMs.push_back(this->TimeFrame(arena).WallMs);
  }
  arena.Mapper->SetInputDataObject(this->Grid);
  return result;
}

//------------------------------------------------------------------------------
VolumeComparison::Change VolumeComparison::MeasureEdit(std::size_t contestant, int times)
{
  return this->MeasureChange(contestant, times,
    [](Arena& arena, int i)
    {
      vtkPiecewiseFunction* opacity = arena.Scene->GetVolume()->GetProperty()->GetScalarOpacity();
      double node[4];
      opacity->GetNodeValue(opacity->GetSize() / 2, node);
      node[1] *= i % 2 ? 1.25 : 0.8;
      opacity->SetNodeValue(opacity->GetSize() / 2, node);
    });
}

//------------------------------------------------------------------------------
VolumeComparison::Change VolumeComparison::MeasureScalars(std::size_t contestant, int times)
{
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> grids;
  for (int i = 0; i < times; ++i)
  {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->ShallowCopy(this->Grid);
    vtkDataArray* old = this->Grid->GetPointData()->GetScalars();
    auto scalars = vtkSmartPointer<vtkDataArray>::Take(old->NewInstance());
    scalars->DeepCopy(old);
    grid->GetPointData()->SetScalars(scalars);
    grids.push_back(grid);
  }
  return this->MeasureChange(contestant, times,
    [&grids](Arena& arena, int i)
    { arena.Mapper->SetInputDataObject(grids[static_cast<std::size_t>(i)]); });
}

//------------------------------------------------------------------------------
VolumeComparison::Change VolumeComparison::MeasureSetUp(std::size_t contestant, int times)
{
  vtkSmartPointer<vtkUnstructuredGrid> grid; // one at a time, since they may be large
  return this->MeasureChange(contestant, times,
    [this, &grid](Arena& arena, int)
    {
      grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
      grid->DeepCopy(this->Grid);
      arena.Mapper->SetInputDataObject(grid);
    });
}

//------------------------------------------------------------------------------
VolumeComparison::Moves VolumeComparison::MeasureMoves()
{
  Moves moves{ this->Results, this->Results };
  for (int view = 0; view < this->Settings.Views; ++view)
  {
    // From 35 to 75 degrees above.
    const auto angles = ViewAngles(view);
    const double elevation = 55.0 + angles[1] / 3.0;
    for (int round = 0; round <= this->Settings.Repetitions; ++round)
    {
      for (std::size_t i = 0; i < this->Arenas.size(); ++i)
      {
        Arena& arena = this->Arenas[i];
        const auto frame = [&](std::vector<FrameTime>& frames)
        {
          LookAt(arena.Scene->GetRenderer(), this->Grid->GetBounds(), angles[0] + 0.2 * round,
            elevation);
          const FrameTime time = this->TimeFrame(arena);
          if (round > 0) // the round before is the warm-up
          {
            frames.push_back(time);
          }
        };
        frame(moves.Moving[i].Frames);
        // Otherwise the resting camera would show the last image again.
        arena.Mapper->Modified();
        frame(moves.Resting[i].Frames);
      }
    }
  }
  return moves;
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper* VolumeComparison::GetOurs(std::size_t contestant) const
{
  return vtkTetrahedraRayCastMapper::SafeDownCast(this->Arenas[contestant].Mapper);
}

//------------------------------------------------------------------------------
void VolumeComparison::MeasureErrors()
{
  if (this->Settings.ErrorViews < 1 || this->Arenas.empty())
  {
    return;
  }
  const auto integrator = MakeReference(this->Grid);
  FunctionKind kind = FunctionKind::Smooth;
  FindFunctionKind(this->Settings.Function, kind);
  std::vector<ReferenceImage> truth;
  VolumeScene& scene = *this->Arenas.front().Scene;
  for (int view = 0; view < this->Settings.ErrorViews; ++view)
  {
    this->LookFrom(scene, view);
    const PixelRays rays(scene.GetRenderer());
    truth.push_back(RenderReference(*integrator, rays.GetWidth(), rays.GetHeight(),
      [&rays](int x, int y) { return rays.GetRay(x, y); },
      { ToReference(this->PropertyOf(kind)) })[0]);
  }
  for (std::size_t i = 0; i < this->Arenas.size(); ++i)
  {
    this->FindError(this->Arenas[i], truth, this->Results[i]);
  }
}

//------------------------------------------------------------------------------
void VolumeComparison::FindError(
  Arena& arena, const std::vector<ReferenceImage>& truth, Figures& figures)
{
  ErrorSum bytes;
  ErrorSum floats;
  for (std::size_t view = 0; view < truth.size(); ++view)
  {
    this->LookFrom(*arena.Scene, static_cast<int>(view));
    const ByteImage byteImage = arena.Scene->RenderBytes();
    const FloatImage floatImage = figures.HasFloat ? arena.Scene->RenderFloat() : FloatImage{};
    for (std::size_t pixel = 0; pixel < truth[view].Rgba.size(); ++pixel)
    {
      double byteError = 0.0;
      double floatError = 0.0;
      for (int c = 0; c < 3; ++c)
      {
        const double exact = truth[view].Rgba[pixel][c];
        byteError = std::max(byteError, std::fabs(byteImage.Rgb[3 * pixel + c] / 255.0 - exact));
        floatError = figures.HasFloat
          ? std::max(floatError, std::fabs(floatImage.Rgba[4 * pixel + c] - exact))
          : 0.0;
      }
      const bool covered = truth[view].Covered[pixel] != 0;
      bytes.Add(byteError, covered);
      floats.Add(floatError, covered);
    }
  }
  figures.Bytes = bytes.GetResult();
  figures.Float = floats.GetResult();
  figures.IsCompared = true;
}

} // namespace meniscus::benchmark

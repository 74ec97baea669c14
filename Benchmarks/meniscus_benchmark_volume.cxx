// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Times vtkTetrahedraRayCastMapper and two of VTK's unstructured volume mappers in one run on the
 * same mesh, views and transfer function, and measures each one's error against the
 * double-precision reference. Prints a table; --json FILE writes the same figures.
 *
 * Bunyk: vtkUnstructuredGridVolumeRayCastMapper with its default ray cast function, one ray per
 * pixel (ImageSampleDistance 1, AutoAdjustSampleDistances off). It samples at pixel corners, so its
 * error contains half a pixel of displacement; it is reported as it is.
 */
#include "ReferenceImage.h"
#include "TestMeshes.h"
#include "TestTransferFunctions.h"
#include "VolumeScene.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkVersion.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace meniscus::test;

namespace
{

struct Options
{
  std::string Mesh; // file, or empty for the built-in block
  std::string Json;
  std::string Function = "smooth";
  int Size = 512;
  int Views = 8;
  int Repetitions = 3;
  int ErrorViews = 2;
  int Cubes = 32; // per side of the built-in block
  bool Help = false;
  std::string Problem;
};

struct View
{
  double WallMs = 0.0; // median over the repetitions
  double CpuMs = 0.0;  // of the repetition with the median wall time, all threads
  double Steps = 0.0;  // traversal steps of a frame, ours only
};

struct Error
{
  double Largest = 0.0;
  double Rms = 0.0;      // over the pixels that the reference covers
  double OffShare = 0.0; // share of covered pixels off by more than 2/255
};

struct Figures
{
  std::string Name;
  double SetUpMs = 0.0;
  double SteadyMs = 0.0;
  double FastestMs = 0.0;
  double SlowestMs = 0.0;
  double CpuMs = 0.0;
  double StepsPerSecond = 0.0;
  Error Bytes;
  Error Float;
  bool HasFloat = false;
};

const char* const Usage =
  "meniscus_benchmark_volume [options]\n"
  "  --mesh FILE        tetrahedral .vtu file, first point array (default: a generated block)\n"
  "  --cubes N          the generated block has 6 N^3 tetrahedra (default 32)\n"
  "  --size N           window of N x N pixels (default 512)\n"
  "  --views N          views timed (default 8)\n"
  "  --error-views N    views compared with the reference (default 2)\n"
  "  --repetitions N    frames per view, after a warm-up frame (default 3)\n"
  "  --function KIND    smooth, peaked, opaque or sparse (default smooth)\n"
  "  --json FILE        write the figures to a file\n"
  "  --help             this text\n";

//------------------------------------------------------------------------------
bool readNumber(const std::string& text, int& value)
{
  char* end = nullptr;
  const long number = std::strtol(text.c_str(), &end, 10);
  value = static_cast<int>(number);
  return end && *end == '\0' && number >= 1 && number <= 16384;
}

//------------------------------------------------------------------------------
Options parse(int argc, char* argv[])
{
  Options options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string key = argv[i];
    if (key == "--help" || key == "-h")
    {
      options.Help = true;
      return options;
    }
    if (i + 1 >= argc)
    {
      options.Problem = "unknown option or missing value: " + key;
      return options;
    }
    const std::string value = argv[++i];
    bool good = true;
    if (key == "--mesh")
      options.Mesh = value;
    else if (key == "--json")
      options.Json = value;
    else if (key == "--function")
      options.Function = value;
    else if (key == "--size")
      good = readNumber(value, options.Size);
    else if (key == "--views")
      good = readNumber(value, options.Views);
    else if (key == "--error-views")
      good = readNumber(value, options.ErrorViews);
    else if (key == "--repetitions")
      good = readNumber(value, options.Repetitions);
    else if (key == "--cubes")
      good = readNumber(value, options.Cubes);
    else
      good = false;
    if (!good)
    {
      options.Problem = "unknown option or bad value: " + key + " " + value;
      return options;
    }
  }
  options.ErrorViews = std::min(options.ErrorViews, options.Views);
  return options;
}

//------------------------------------------------------------------------------
bool kindOf(const std::string& name, FunctionKind& kind)
{
  const std::vector<std::pair<std::string, FunctionKind>> kinds{ { "smooth", FunctionKind::Smooth },
    { "peaked", FunctionKind::Peaked }, { "opaque", FunctionKind::Opaque },
    { "sparse", FunctionKind::Sparse } };
  for (const auto& candidate : kinds)
  {
    if (candidate.first == name)
    {
      kind = candidate.second;
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// User and system time of all threads of the process, in milliseconds.
double cpuMilliseconds()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1e3 * (usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
    1e-3 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

//------------------------------------------------------------------------------
// One frame until the device is done, as (wall, CPU) milliseconds.
std::pair<double, double> timeFrame(VolumeScene& scene)
{
  const double cpu = cpuMilliseconds();
  const auto begin = std::chrono::steady_clock::now();
  scene.window()->Render();
  scene.window()->WaitForCompletion();
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - begin;
  return { wall.count(), cpuMilliseconds() - cpu };
}

//------------------------------------------------------------------------------
double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

//------------------------------------------------------------------------------
class Benchmark
{
public:
  Benchmark(const Options& options, vtkUnstructuredGrid* grid, FunctionKind kind)
    : Settings(options)
    , Grid(grid)
    , Reference(makeReference(grid))
  {
    double range[2];
    grid->GetPointData()->GetScalars()->GetFiniteRange(range);
    this->Property = makeProperty(kind, range, diagonalOf(grid->GetBounds()));
  }

  /// The reference of the first views, made once for all mappers.
  void makeTruth()
  {
    VolumeScene scene(this->Settings.Size, this->Settings.Size);
    const auto function = toReference(this->Property);
    for (int i = 0; i < this->Settings.ErrorViews; ++i)
    {
      this->look(scene, i);
      const PixelRays rays(scene.renderer());
      this->Truth.push_back(renderReference(*this->Reference, rays.width(), rays.height(),
        [&rays](int x, int y) { return rays.ray(x, y); }, { function })[0]);
    }
  }

  Figures run(const std::string& name, vtkUnstructuredGridVolumeMapper* mapper, bool hasFloat);

  std::string Device;

private:
  void look(VolumeScene& scene, int i) const
  {
    const auto angles = viewAngles(i);
    lookAt(scene.renderer(), this->Grid->GetBounds(), angles[0], angles[1]);
  }

  View timeView(VolumeScene& scene, int i) const;
  void findErrors(VolumeScene& scene, Figures& figures) const;

  Options Settings;
  vtkUnstructuredGrid* Grid;
  std::unique_ptr<meniscus::reference::ReferenceRayIntegrator> Reference;
  vtkSmartPointer<vtkVolumeProperty> Property;
  std::vector<ReferenceImage> Truth;
};

//------------------------------------------------------------------------------
View Benchmark::timeView(VolumeScene& scene, int i) const
{
  this->look(scene, i);
  timeFrame(scene); // warm-up
  std::vector<std::pair<double, double>> frames;
  for (int repetition = 0; repetition < this->Settings.Repetitions; ++repetition)
  {
    // A new camera time makes every mapper do what a moving camera asks for.
    this->look(scene, i + 1);
    this->look(scene, i);
    frames.push_back(timeFrame(scene));
  }
  std::sort(frames.begin(), frames.end());
  View view{ frames[frames.size() / 2].first, frames[frames.size() / 2].second, 0.0 };
  auto* ours = vtkTetrahedraRayCastMapper::SafeDownCast(scene.mapper());
  if (ours)
  {
    view.Steps = static_cast<double>(ours->GetNumberOfTraversalSteps());
  }
  return view;
}

//------------------------------------------------------------------------------
// Adds up |image - truth| over the pixels of several views.
class ErrorSum
{
public:
  void add(double difference, bool covered)
  {
    this->Largest = std::max(this->Largest, difference);
    if (covered)
    {
      this->Squares += difference * difference;
      this->Off += difference > 2.0 / 255.0;
      ++this->Covered;
    }
  }

  Error result() const
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

//------------------------------------------------------------------------------
void Benchmark::findErrors(VolumeScene& scene, Figures& figures) const
{
  ErrorSum bytes;
  ErrorSum floats;
  for (std::size_t i = 0; i < this->Truth.size(); ++i)
  {
    const ReferenceImage& truth = this->Truth[i];
    this->look(scene, static_cast<int>(i));
    const ByteImage byteImage = scene.renderBytes();
    const FloatImage floatImage = figures.HasFloat ? scene.renderFloat() : FloatImage{};
    for (std::size_t pixel = 0; pixel < truth.Rgba.size(); ++pixel)
    {
      double byteError = 0.0;
      double floatError = 0.0;
      for (int c = 0; c < 3; ++c)
      {
        const double exact = truth.Rgba[pixel][c];
        byteError = std::max(byteError, std::fabs(byteImage.Rgb[3 * pixel + c] / 255.0 - exact));
        floatError = figures.HasFloat
          ? std::max(floatError, std::fabs(floatImage.Rgba[4 * pixel + c] - exact))
          : 0.0;
      }
      bytes.add(byteError, truth.Covered[pixel] != 0);
      floats.add(floatError, truth.Covered[pixel] != 0);
    }
  }
  figures.Bytes = bytes.result();
  figures.Float = floats.result();
}

//------------------------------------------------------------------------------
Figures Benchmark::run(
  const std::string& name, vtkUnstructuredGridVolumeMapper* mapper, bool hasFloat)
{
  std::cerr << "  " << name << " ..." << std::endl;
  Figures figures;
  figures.Name = name;
  figures.HasFloat = hasFloat;
  VolumeScene scene(this->Settings.Size, this->Settings.Size);
  this->look(scene, 0);
  scene.volume()->SetVisibility(false);
  timeFrame(scene); // opens the window
  this->Device = deviceName(scene.window());
  mapper->SetInputDataObject(this->Grid);
  scene.setMapper(mapper);
  scene.setProperty(this->Property);
  scene.volume()->SetVisibility(true);
  figures.SetUpMs = timeFrame(scene).first;

  std::vector<double> wall;
  std::vector<double> cpu;
  std::vector<double> steps;
  for (int i = 0; i < this->Settings.Views; ++i)
  {
    const View view = this->timeView(scene, i);
    wall.push_back(view.WallMs);
    cpu.push_back(view.CpuMs);
    steps.push_back(view.Steps / (1e-3 * view.WallMs));
  }
  figures.SteadyMs = median(wall);
  figures.FastestMs = *std::min_element(wall.begin(), wall.end());
  figures.SlowestMs = *std::max_element(wall.begin(), wall.end());
  figures.CpuMs = median(cpu);
  figures.StepsPerSecond = median(steps);
  this->findErrors(scene, figures);
  return figures;
}

//------------------------------------------------------------------------------
void printTable(const std::vector<Figures>& all)
{
  std::cout << std::left << std::setw(12) << "mapper" << std::right << std::setw(11) << "set-up ms"
            << std::setw(10) << "ms/frame" << std::setw(17) << "spread" << std::setw(9) << "CPU ms"
            << std::setw(11) << "Msteps/s" << std::setw(11) << "max" << std::setw(11) << "RMS"
            << std::setw(10) << ">2/255 %" << '\n';
  for (const Figures& f : all)
  {
    std::ostringstream spread;
    spread << std::fixed << std::setprecision(1) << f.FastestMs << " - " << f.SlowestMs;
    std::cout << std::fixed << std::setprecision(1) << std::left << std::setw(12) << f.Name
              << std::right << std::setw(11) << f.SetUpMs << std::setw(10) << f.SteadyMs
              << std::setw(17) << spread.str() << std::setw(9) << f.CpuMs << std::setw(11);
    if (f.StepsPerSecond > 0.0)
      std::cout << f.StepsPerSecond * 1e-6;
    else
      std::cout << "-";
    std::cout << std::setprecision(5) << std::setw(11) << f.Bytes.Largest << std::setw(11)
              << f.Bytes.Rms << std::setprecision(2) << std::setw(10) << 100.0 * f.Bytes.OffShare
              << '\n';
  }
  for (const Figures& f : all)
  {
    if (f.HasFloat)
    {
      std::cout << std::scientific << std::setprecision(2) << f.Name << ", float framebuffer: max "
                << f.Float.Largest << ", RMS " << f.Float.Rms << '\n';
    }
  }
  const Figures& ours = all.back();
  for (std::size_t i = 0; i + 1 < all.size(); ++i)
  {
    std::cout << std::fixed << std::setprecision(2) << "against " << all[i].Name << ": "
              << all[i].SteadyMs / ours.SteadyMs << " x the frame rate, "
              << all[i].CpuMs / ours.CpuMs << " x less CPU time; RMS error " << std::setprecision(4)
              << ours.Bytes.Rms / all[i].Bytes.Rms << " of its in 8 bits, " << std::scientific
              << std::setprecision(1) << ours.Float.Rms / all[i].Bytes.Rms << " in float\n";
  }
  std::cout
    << "Errors: 8-bit picture against the double reference. Bunyk samples at pixel corners: "
       "half a pixel of its error is displacement. Rounding to 8 bits alone gives "
       "an RMS of about 0.0015 (largest of three channels).\n";
}

//------------------------------------------------------------------------------
std::string quoted(const std::string& text)
{
  std::string result = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      result += '\\';
    }
    result += c;
  }
  return result + "\"";
}

//------------------------------------------------------------------------------
void writeError(std::ostream& out, const char* name, const Error& error)
{
  out << ", \"" << name << "\": {\"max\": " << error.Largest << ", \"rms\": " << error.Rms
      << ", \"share_off_by_2\": " << error.OffShare << "}";
}

//------------------------------------------------------------------------------
bool writeJson(const Options& options, const Benchmark& benchmark, vtkIdType cells,
  const std::vector<Figures>& all)
{
  std::ofstream out(options.Json);
  out << "{\"mesh\": " << quoted(options.Mesh.empty() ? "block" : options.Mesh)
      << ", \"tetrahedra\": " << cells << ", \"size\": " << options.Size
      << ", \"views\": " << options.Views << ", \"repetitions\": " << options.Repetitions
      << ", \"function\": " << quoted(options.Function)
      << ", \"gl_renderer\": " << quoted(benchmark.Device)
      << ", \"vtk\": " << quoted(vtkVersion::GetVTKVersion())
      << ", \"threads\": " << vtkSMPTools::GetEstimatedNumberOfThreads() << ", \"mappers\": [";
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const Figures& f = all[i];
    out << (i ? ",\n" : "\n") << "  {\"name\": " << quoted(f.Name)
        << ", \"set_up_ms\": " << f.SetUpMs << ", \"ms_per_frame\": " << f.SteadyMs
        << ", \"fastest_ms\": " << f.FastestMs << ", \"slowest_ms\": " << f.SlowestMs
        << ", \"cpu_ms\": " << f.CpuMs << ", \"steps_per_second\": " << f.StepsPerSecond;
    writeError(out, "error_8_bit", f.Bytes);
    if (f.HasFloat)
    {
      writeError(out, "error_float", f.Float);
    }
    out << "}";
  }
  out << "\n]}\n";
  return out.good();
}

//------------------------------------------------------------------------------
int runAll(const Options& options, FunctionKind kind)
{
  const Grid grid = options.Mesh.empty() ? makeBlock(options.Cubes, wavyField(3.0), shell(0.3, 1.3))
                                         : readMesh(options.Mesh);
  if (!grid || !grid->GetPointData()->GetScalars())
  {
    std::cerr << "no cells or no point array in " << options.Mesh << '\n';
    return EXIT_FAILURE;
  }
  Benchmark benchmark(options, grid, kind);
  std::cerr << "  reference ..." << std::endl;
  benchmark.makeTruth();

  vtkNew<vtkProjectedTetrahedraMapper> projected;
  vtkNew<vtkUnstructuredGridVolumeRayCastMapper> bunyk;
  bunyk->SetImageSampleDistance(1.0);
  bunyk->AutoAdjustSampleDistancesOff();
  vtkNew<vtkTetrahedraRayCastMapper> ours;
  std::vector<Figures> all;
  all.push_back(benchmark.run("projected", projected, false));
  all.push_back(benchmark.run("bunyk", bunyk, false));
  all.push_back(benchmark.run("meniscus", ours, true));

  std::cout << (options.Mesh.empty() ? "generated block" : options.Mesh) << ": "
            << grid->GetNumberOfCells() << " tetrahedra, " << options.Size << " x " << options.Size
            << ", " << options.Views << " views, " << options.Function << " function\n"
            << benchmark.Device << "; " << vtkVersion::GetVTKSourceVersion() << "; "
            << vtkSMPTools::GetEstimatedNumberOfThreads() << " threads\n";
  printTable(all);
  if (!options.Json.empty() && !writeJson(options, benchmark, grid->GetNumberOfCells(), all))
  {
    std::cerr << "cannot write " << options.Json << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const Options options = parse(argc, argv);
  FunctionKind kind = FunctionKind::Smooth;
  if (options.Help || !options.Problem.empty() || !kindOf(options.Function, kind))
  {
    (options.Help ? std::cout : std::cerr) << options.Problem << '\n' << Usage;
    return options.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (!hasDisplay())
  {
    std::cerr << "no display: run under xvfb-run\n";
    return EXIT_FAILURE;
  }
  const DisplayHold hold;
  return runAll(options, kind);
}

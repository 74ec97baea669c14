// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeProbe.h"

#include "VolumeScene.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <vector>

namespace meniscus::benchmark
{

using namespace meniscus::test;

namespace
{

//------------------------------------------------------------------------------
std::vector<std::string> ProbeArguments(const std::string& name, const VolumeOptions& options)
{
  std::vector<std::string> arguments{ "--probe", name, "--size",
    std::to_string(options.Width) + "x" + std::to_string(options.Height), "--mode",
    NameOf(options.Mode), "--views", std::to_string(options.Views), "--function", options.Function,
    "--cubes", std::to_string(options.Cubes), "--hollow", std::to_string(options.Hollow),
    "--threads", std::to_string(options.Threads) };
  if (!options.Mesh.empty())
  {
    arguments.insert(arguments.end(), { "--mesh", options.Mesh });
  }
  if (options.ZSweep)
  {
    arguments.push_back("--zsweep");
  }
  return arguments;
}

//------------------------------------------------------------------------------
[[noreturn]] void ExecuteProbe(const std::string& name, const VolumeOptions& options, int out)
{
  dup2(out, STDOUT_FILENO);
  std::vector<std::string> arguments = ProbeArguments(name, options);
  std::vector<char*> pointers;
  std::string program = "/proc/self/exe";
  pointers.push_back(program.data());
  for (std::string& argument : arguments)
  {
    pointers.push_back(argument.data());
  }
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  _exit(EXIT_FAILURE);
}

//------------------------------------------------------------------------------
// Reads everything until the other end closes; returns false if that takes too long.
bool ReadAll(int in, int seconds, std::string& text)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  for (;;)
  {
    const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd waiting{ in, POLLIN, 0 };
    if (left.count() <= 0 || poll(&waiting, 1, static_cast<int>(left.count())) <= 0)
    {
      return false;
    }
    char buffer[256];
    const ssize_t size = read(in, buffer, sizeof buffer);
    if (size <= 0)
    {
      return true;
    }
    text.append(buffer, static_cast<std::size_t>(size));
  }
}

//------------------------------------------------------------------------------
double ResidentBytes()
{
  malloc_trim(0);
  std::ifstream in("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  in >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

} // anonymous namespace

//------------------------------------------------------------------------------
ProbeResult ProbeContestant(const std::string& name, const VolumeOptions& options)
{
  ProbeResult result;
  int ends[2];
  if (pipe(ends) != 0)
  {
    result.Fate = "not tried";
    return result;
  }
  const pid_t child = fork();
  if (child == 0)
  {
    close(ends[0]);
    ExecuteProbe(name, options, ends[1]);
  }
  close(ends[1]);
  std::string text;
  const bool inTime = child > 0 && ReadAll(ends[0], options.ProbeSeconds, text);
  close(ends[0]);
  if (!inTime && child > 0)
  {
    kill(child, SIGKILL);
  }
  int status = -1;
  waitpid(child, &status, 0);
  result.Survives = inTime && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
  result.Fate = result.Survives ? ""
    : inTime                    ? "crashed"
                                : "no end in " + std::to_string(options.ProbeSeconds) + " s";
  std::istringstream(text) >> result.BytesPerCell;
  return result;
}

//------------------------------------------------------------------------------
int RunProbe(const Contestant& contestant, const VolumeOptions& options)
{
  // Large blocks are returned to the system when they are freed.
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  const test::Grid grid = MakeVolumeMesh(options);
  if (!grid)
  {
    return EXIT_FAILURE;
  }
  // A small mesh comes first: shaders, framebuffers and threads are not part of the cost of a mesh.
  const test::Grid small = MakeCubeOfFive(RadialField());
  VolumeScene scene(options.Width, options.Height);
  MapperPointer mapper = contestant.Make();
  mapper->SetInputDataObject(small);
  scene.SetMapper(mapper);
  const auto property = MakeProperty(contestant.Function, grid, DiagonalOf(grid->GetBounds()));
  ApplyMode(options.Mode, grid, mapper, property);
  scene.SetProperty(property);
  LookAt(scene.GetRenderer(), small->GetBounds(), 20.0, 30.0);
  scene.GetWindow()->Render();
  if (!contestant.CanChangeMesh)
  {
    mapper = contestant.Make();
    scene.SetMapper(mapper);
  }
  const double before = ResidentBytes();
  mapper->SetInputDataObject(grid);
  for (int view = 0; view < options.Views; ++view)
  {
    const auto angles = ViewAnglesOf(options.Mode, view);
    LookAt(scene.GetRenderer(), grid->GetBounds(), angles[0], angles[1]);
    scene.GetWindow()->Render();
    scene.GetWindow()->WaitForCompletion();
    if (view == 0)
    {
      std::cout << (ResidentBytes() - before) / static_cast<double>(grid->GetNumberOfCells())
                << std::endl;
    }
  }
  return EXIT_SUCCESS;
}

} // namespace meniscus::benchmark

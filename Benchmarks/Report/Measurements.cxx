// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Measurements.h"

#include "ChildProgram.h"
#include "Machine.h"

#include <dirent.h>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace meniscus::report
{

namespace
{

using Words = std::vector<std::string>;

const char* const Backends =
  "meniscus/opengl/exact$,meniscus/compute/exact$,meniscus/native/exact$";
const char* const Windows[] = { "512x512", "1920x1080", "3840x2160" };
const char* const Modes[] = { "composite", "lit", "isosurface", "membrane" };

// Main memory per cell of a process that makes a mesh and draws it with one backend, with software
// rendering, where the device's tables are in main memory, too. 256 were seen with 30 million cells
// and two backends; the rest is room for temporary arrays and other programs. Reports have the
// peaks of their runs (peak_bytes).
constexpr double BytesPerCell = 400.0;

/** A mesh by name, with the options that select it. */
struct MeshChoice
{
  std::string Name;
  Words Options;
};

//------------------------------------------------------------------------------
// Meshes of the data folder, the blunt fin first; then the generated one.
std::vector<MeshChoice> FindMeshes(const std::string& folder)
{
  Words names;
  if (DIR* directory = folder.empty() ? nullptr : opendir(folder.c_str()))
  {
    while (const dirent* entry = readdir(directory))
    {
      const std::string name = entry->d_name;
      if (name.size() > 4 && name.compare(name.size() - 4, 4, ".vtu") == 0)
      {
        names.push_back(name.substr(0, name.size() - 4));
      }
    }
    closedir(directory);
  }
  std::sort(names.begin(), names.end());
  std::stable_partition(
    names.begin(), names.end(), [](const std::string& name) { return name == "blunt_fin"; });
  std::vector<MeshChoice> meshes;
  for (const std::string& name : names)
  {
    meshes.push_back({ name, { "--mesh", folder + "/" + name + ".vtu" } });
  }
  meshes.push_back({ "block", {} });
  return meshes;
}

//------------------------------------------------------------------------------
class Measurements
{
public:
  Measurements(const ReportOptions& options, ReportText& report)
    : Options(options)
    , Report(report)
    , Meshes(FindMeshes(options.Data))
  {
  }

  void MeasureErrors()
  {
    this->Begin("errors", "Errors",
      "Pictures against the double-precision reference; premultiplied colours from 0 to 1. "
      "Projected "
      "tetrahedra have 8 bits only.");
    for (const MeshChoice& mesh : this->Meshes)
    {
      for (const char* function : { "smooth", "peaked", "sharp", "opaque", "sparse" })
      {
        const std::string name = "errors-" + mesh.Name + "-" + function;
        if (this->Options.Quick &&
          (&mesh != &this->Meshes.front() || function != std::string("smooth")))
        {
          this->Report.LeaveOut(name, "--quick");
          continue;
        }
        const char* const views = this->Options.Quick ? "1" : "2";
        this->RunVolume(name, mesh,
          { "--function", function, "--mappers", std::string(Backends) + ",projected$", "--size",
            this->Options.Quick ? "128" : "512", "--views", views, "--error-views", views,
            "--repetitions", "1", "--set-up", "0", "--error-rows", this->Table() });
      }
    }
    this->End();
  }

  void MeasureFrames()
  {
    this->Begin("frames", "Frames",
      "Medians over views of a moving camera. The first frame is that of a new window, with the "
      "compilation of shaders; the frame of a new mesh includes preparing and uploading its "
      "tables. "
      "Reads are those of a walk in which no read is served by a cache: steps times the bytes of a "
      "cell's record and a vertex. Their share of the bandwidth of copies on the same device is "
      "therefore an upper bound, not measured traffic of the memory.");
    const MeshChoice& mesh = this->Meshes.front();
    std::string races;
    for (const char* window : Windows)
    {
      for (const char* mode : Modes)
      {
        const bool small = window == Windows[0];
        const bool plain = mode == Modes[0];
        const std::string name = std::string("frames-") + window + "-" + mode;
        if (this->Options.Quick && !small && (!plain || window == Windows[2]))
        {
          this->Report.LeaveOut(name, "--quick");
          continue;
        }
        Words arguments{ "--mode", mode, "--size", window, "--error-views", "0", "--bandwidth",
          "--mappers", plain ? std::string(Backends) + ",projected$" : Backends, "--set-up",
          small && plain ? (this->Options.Quick ? "1" : "3") : "0", "--rows", this->Table() };
        this->AddRepetitions(arguments);
        if (small)
        {
          arguments.insert(
            arguments.end(), { "--picture", this->Options.Output + "/pictures/" + mode });
        }
        races += this->RunVolume(name, mesh, arguments) ? this->RacesOf(name) : "";
      }
    }
    this->End();
    this->Report.Write("\n" + races + "\n### Pictures\n\n");
    for (const char* mode : Modes)
    {
      for (const char* backend : { "opengl", "compute", "native" })
      {
        this->AddPicture(std::string(mode) + "-meniscus-" + backend + "-exact.png");
      }
    }
  }

  void MeasureLargeMeshes()
  {
    this->Begin("meshes", "Large meshes",
      "Generated blocks, one backend per process. The first frame includes preparing and uploading "
      "the tables.");
    const struct
    {
      int Cubes;
      const char* Name;
    } blocks[] = { { 79, "3M" }, { 119, "10M" }, { 171, "30M" } };
    for (const auto& block : blocks)
    {
      for (const char* backend : { "opengl", "compute", "native" })
      {
        const std::string name = std::string("mesh-") + block.Name + "-" + backend;
        const double needed = BytesPerCell * 6.0 * block.Cubes * block.Cubes * block.Cubes;
        const double available = AvailableMemory();
        if (this->Options.Quick && (block.Cubes > 79 || *backend == 'c'))
        {
          this->Report.LeaveOut(name, "--quick");
        }
        else if (available < needed)
        {
          this->Report.LeaveOut(name,
            "needs " + FormatNumber(1e-9 * needed, 1) + " GB of main memory; " +
              FormatNumber(1e-9 * available, 1) + " GB are available");
        }
        else
        {
          Words arguments{ "--cubes", std::to_string(block.Cubes), "--hollow", "0", "--size",
            this->Options.Quick ? "512" : "1920x1080", "--error-views", "0", "--bandwidth",
            "--mappers", std::string("meniscus/") + backend + "/exact$", "--set-up", "0", "--rows",
            this->Table() };
          this->AddRepetitions(arguments);
          this->RunVolume(name, { block.Name, {} }, arguments);
        }
      }
    }
    this->End();
  }

  void MeasureRefraction()
  {
    this->Begin("refraction", "Refraction", "");
    this->Run("refraction", "meniscus_benchmark_refraction",
      { "--pass", "--threads", std::to_string(std::max(1U, std::thread::hardware_concurrency())),
        "--picture", this->Options.Output + "/pictures/pool.png" });
    this->End();
    this->Report.Write(ReadText(this->LogName("refraction") + ".txt"));
    this->AddPicture("pool.png");
  }

private:
  std::string LogName(const std::string& name) const
  {
    return this->Options.Output + "/logs/" + name;
  }
  std::string Table() const { return this->LogName("rows-" + this->Section) + ".md"; }

  void Begin(const std::string& section, const std::string& title, const std::string& text)
  {
    this->Section = section;
    this->Json.clear();
    this->Report.Write("\n## " + title + "\n\n" + (text.empty() ? "" : text + "\n\n"));
  }

  void End()
  {
    this->Report.Write(ReadText(this->Table()));
    this->Report.AddMember(this->Section, "{\n" + this->Json + "\n}");
  }

  void AddRepetitions(Words& arguments) const
  {
    arguments.insert(arguments.end(),
      { "--views", this->Options.Quick ? "1" : "8", "--repetitions",
        this->Options.Quick ? "1" : "3" });
  }

  // Without --quick every mapper is tried in a process of its own first.
  bool RunVolume(const std::string& name, const MeshChoice& mesh, Words arguments)
  {
    arguments.insert(arguments.end(), mesh.Options.begin(), mesh.Options.end());
    arguments.insert(arguments.end(), { "--probe-seconds", this->Options.Quick ? "0" : "1800" });
    return this->Run(name, "meniscus_benchmark_volume", arguments);
  }

  bool Run(const std::string& name, const std::string& program, const Words& arguments)
  {
    std::cerr << name << std::endl;
    ChildProgram child;
    child.Command = { this->Options.Programs + "/" + program };
    child.Command.insert(child.Command.end(), arguments.begin(), arguments.end());
    child.Command.insert(child.Command.end(), { "--json", this->LogName(name) + ".json" });
    child.Output = this->LogName(name) + ".txt";
    child.Errors = this->LogName(name) + ".err";
    child.SilentSeconds = 7200.0;
    const ChildEnd end = RunChild(child);
    const std::string json = ReadText(this->LogName(name) + ".json");
    const bool measured = end.Fate.empty() && !json.empty();
    if (!measured)
    {
      this->Report.Miss(name, end.Fate.empty() ? "no figures were written" : end.Fate);
    }
    this->Json += (this->Json.empty() ? "" : ",\n") + Quoted(name) +
      ": {\"seconds\": " + FormatNumber(end.Seconds, 1) +
      ", \"peak_bytes\": " + FormatNumber(end.PeakBytes, 0) +
      (measured ? ", \"figures\": " + json : ", \"missing\": " + Quoted(end.Fate)) + "}";
    return measured;
  }

  // Lines that compare our mapper with a peer.
  std::string RacesOf(const std::string& name) const
  {
    std::istringstream in(ReadText(this->LogName(name) + ".txt"));
    std::string text;
    for (std::string line; std::getline(in, line);)
    {
      text += line.find(" against ") != std::string::npos && line.compare(0, 8, "meniscus") == 0
        ? "- " + name.substr(7) + ": " + line + "\n"
        : "";
    }
    return text;
  }

  void AddPicture(const std::string& name)
  {
    if (ReadText(this->Options.Output + "/pictures/" + name).empty())
    {
      this->Report.Miss("picture " + name, "it was not written");
      return;
    }
    this->Report.Write("![" + name + "](pictures/" + name + ")\n");
  }

  const ReportOptions& Options;
  ReportText& Report;
  std::vector<MeshChoice> Meshes;
  std::string Section;
  std::string Json;
};

} // anonymous namespace

//------------------------------------------------------------------------------
void MeasureAll(const ReportOptions& options, ReportText& report)
{
  Measurements measurements(options, report);
  measurements.MeasureErrors();
  measurements.MeasureFrames();
  measurements.MeasureLargeMeshes();
  measurements.MeasureRefraction();
}

} // namespace meniscus::report

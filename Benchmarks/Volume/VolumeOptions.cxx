// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeOptions.h"

#include "Simd/InstructionSets.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

namespace meniscus::benchmark
{

const char* const VolumeUsage =
  "meniscus_benchmark_volume [options]\n"
  "  --mesh FILE        tetrahedral .vtu file, first point array (default: a generated block)\n"
  "  --cubes N          the generated block has 6 N^3 tetrahedra less a hollow (default 32)\n"
  "  --hollow 0         the generated block has no hollow (default 1)\n"
  "  --size N, WxH      window of N x N or W x H pixels (default 512)\n"
  "  --mode NAME        composite, lit, isosurface (three of them) or membrane (waves above the\n"
  "                     mesh; views from above); only our mapper draws the others than composite,\n"
  "                     and without errors (default composite)\n"
  "  --views N          views timed (default 8)\n"
  "  --repetitions N    rounds per view, after a warm-up; in each, every mapper draws one frame\n"
  "                     (default 3)\n"
  "  --error-views N    views compared with the reference (default 2)\n"
  "  --function KIND    smooth, peaked, sharp, opaque or sparse (default smooth)\n"
  "  --mappers LIST     only mappers whose names contain one of the words, e.g.\n"
  "                     projected,meniscus/native; a word with $ at its end must be the name's\n"
  "                     end (default: all)\n"
  "  --zsweep           VTK's Z sweep, too: it may take minutes a frame\n"
  "  --probe-seconds N  every mapper is tried in a process of its own first, since some crash or\n"
  "                     do not end on some meshes; N seconds at most (default 60; 0: not tried)\n"
  "  --set-up N         new meshes whose first frame is timed, per mapper (default 3)\n"
  "  --bandwidth        measure copies on the graphics device, too, to compare with the walk's\n"
  "                     reads\n"
  "  --instructions SET instruction set of native frames: AVX-512, AVX2, NEON or portable\n"
  "                     (default: the widest of the processor)\n"
  "  --threads N        threads of vtkSMPTools, of VTK's ray cast mapper and of llvmpipe\n"
  "  --json FILE        write the figures to a file\n"
  "  --plot FILE.png    draw time against error, a curve per way to draw\n"
  "  --paper FOLDER     charts like Figs. 7 and 8 of Weiler et al.: time and steps over views, "
  "rays\n"
  "                     that still walk after each step\n"
  "  --picture START    write the first view of every mapper to START-MAPPER.png\n"
  "  --rows FILE        append a row per mapper, times, to a table in Markdown\n"
  "  --error-rows FILE  the same, errors\n"
  "  --device           only print names and limits of the graphics device, one per line\n"
  "  --growth           ms per frame for generated blocks of 10k to 5M tetrahedra\n"
  "  --growth-limit N   up to N thousand tetrahedra (default 5000)\n"
  "  --steps            shares of the first frame that time steps of the mesh take (processor "
  "time)\n"
  "  --changes          native frames after a moved camera, light or opacity, and first frames\n"
  "                     (processor time)\n"
  "  --report           the goals of the mapper, each beside what is measured\n"
  "  --row NAME         only this row of the report: native, native-1024, opengl, sparse, opaque,\n"
  "                     setup, edit, scalars, memory, membrane, growth, error\n"
  "  --help             this text\n";

namespace
{

//------------------------------------------------------------------------------
bool ReadNumber(const std::string& text, int& value)
{
  char* end = nullptr;
  const long number = std::strtol(text.c_str(), &end, 10);
  value = static_cast<int>(number);
  return end && *end == '\0' && !text.empty() && number >= 0 && number <= 16384;
}

//------------------------------------------------------------------------------
bool IsInstructionSet(const std::string& name)
{
  const auto& sets = GetInstructionSets();
  return std::any_of(
    sets.begin(), sets.end(), [&name](InstructionSet set) { return name == NameOf(set); });
}

//------------------------------------------------------------------------------
// N or WxH.
bool ReadSize(const std::string& text, VolumeOptions& options)
{
  const std::size_t cross = text.find('x');
  return ReadNumber(text.substr(0, cross), options.Width) &&
    ReadNumber(cross == std::string::npos ? text : text.substr(cross + 1), options.Height);
}

//------------------------------------------------------------------------------
std::vector<std::string> Split(const std::string& text)
{
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');)
  {
    words.push_back(word);
  }
  return words;
}

//------------------------------------------------------------------------------
bool ReadFlag(const std::string& key, VolumeOptions& options)
{
  const std::map<std::string, bool*> flags{ { "--help", &options.Help }, { "-h", &options.Help },
    { "--zsweep", &options.ZSweep }, { "--growth", &options.Growth },
    { "--report", &options.Report }, { "--bandwidth", &options.Bandwidth },
    { "--device", &options.Device }, { "--steps", &options.Steps },
    { "--changes", &options.Changes } };
  const auto flag = flags.find(key);
  if (flag != flags.end())
  {
    *flag->second = true;
  }
  return flag != flags.end();
}

//------------------------------------------------------------------------------
bool ReadValue(const std::string& key, const std::string& value, VolumeOptions& options)
{
  const std::map<std::string, int*> numbers{ { "--hollow", &options.Hollow },
    { "--set-up", &options.SetUpRepetitions }, { "--views", &options.Views },
    { "--error-views", &options.ErrorViews }, { "--repetitions", &options.Repetitions },
    { "--cubes", &options.Cubes }, { "--threads", &options.Threads },
    { "--probe-seconds", &options.ProbeSeconds }, { "--growth-limit", &options.GrowthLimit } };
  const std::map<std::string, std::string*> texts{ { "--mesh", &options.Mesh },
    { "--json", &options.Json }, { "--plot", &options.Plot }, { "--function", &options.Function },
    { "--row", &options.Row }, { "--probe", &options.Probe }, { "--picture", &options.Picture },
    { "--rows", &options.TimeRows }, { "--error-rows", &options.ErrorRows },
    { "--instructions", &options.Instructions }, { "--paper", &options.Paper } };
  const auto number = numbers.find(key);
  if (number != numbers.end())
  {
    return ReadNumber(value, *number->second);
  }
  if (key == "--size")
  {
    return ReadSize(value, options);
  }
  if (key == "--mode")
  {
    return FindVolumeMode(value, options.Mode);
  }
  if (key == "--mappers")
  {
    options.Mappers = Split(value);
    return true;
  }
  const auto text = texts.find(key);
  if (text != texts.end())
  {
    *text->second = value;
  }
  return text != texts.end();
}

} // anonymous namespace

//------------------------------------------------------------------------------
VolumeOptions ParseVolumeOptions(int argc, char* argv[])
{
  VolumeOptions options;
  for (int i = 1; i < argc && !options.Help; ++i)
  {
    const std::string key = argv[i];
    if (ReadFlag(key, options))
    {
      continue;
    }
    const std::string value = i + 1 < argc ? argv[i + 1] : "";
    if (++i >= argc || !ReadValue(key, value, options))
    {
      options.Problem = "unknown option, or bad or missing value: " + key + " " + value;
      return options;
    }
  }
  test::FunctionKind kind;
  if (!FindFunctionKind(options.Function, kind))
  {
    options.Problem = "no such function: " + options.Function;
  }
  if (!options.Instructions.empty() && !IsInstructionSet(options.Instructions))
  {
    options.Problem = "no such instruction set here: " + options.Instructions;
  }
  if (options.Width < 1 || options.Height < 1 || options.Views < 1 || options.Repetitions < 1 ||
    options.Cubes < 1)
  {
    options.Problem = "--size, --views, --repetitions and --cubes are at least 1";
  }
  options.ErrorViews =
    options.Mode == VolumeMode::Composite ? std::min(options.ErrorViews, options.Views) : 0;
  return options;
}

//------------------------------------------------------------------------------
bool FindFunctionKind(const std::string& name, test::FunctionKind& kind)
{
  using test::FunctionKind;
  const std::map<std::string, FunctionKind> kinds{ { "smooth", FunctionKind::Smooth },
    { "peaked", FunctionKind::Peaked }, { "sharp", FunctionKind::Sharp },
    { "opaque", FunctionKind::Opaque }, { "sparse", FunctionKind::Sparse } };
  const auto found = kinds.find(name);
  if (found != kinds.end())
  {
    kind = found->second;
  }
  return found != kinds.end();
}

//------------------------------------------------------------------------------
test::Grid MakeVolumeMesh(const VolumeOptions& options)
{
  const test::Grid grid = options.Mesh.empty()
    ? test::MakeBlock(options.Cubes, test::WavyField(3.0),
        options.Hollow ? test::Shell(0.3, 1.3) : test::Region())
    : test::ReadMesh(options.Mesh);
  return grid && grid->GetPointData()->GetScalars() ? grid : nullptr;
}

} // namespace meniscus::benchmark

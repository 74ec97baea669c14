// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Machine.h"

#include "ChildProgram.h"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

namespace meniscus::report
{

namespace
{

using Lines = std::vector<std::pair<std::string, std::string>>;

//------------------------------------------------------------------------------
// Value of the first line "name : value" of a file.
std::string ValueIn(const std::string& file, const std::string& name)
{
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
  {
    const std::size_t colon = line.find(':');
    if (line.compare(0, name.size(), name) == 0 && colon != std::string::npos)
    {
      const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
      return begin == std::string::npos ? "" : line.substr(begin);
    }
  }
  return {};
}

//------------------------------------------------------------------------------
// Instruction sets for which the native backend has code.
std::string InstructionSets()
{
  std::istringstream flags(ValueIn("/proc/cpuinfo", "flags"));
  std::string found;
  for (std::string flag; flags >> flag;)
  {
    if (flag == "avx2" || flag == "fma" || flag == "avx512f")
    {
      found += (found.empty() ? "" : " ") + flag;
    }
  }
  return found;
}

//------------------------------------------------------------------------------
double MemoryValue(const std::string& name)
{
  double kibibytes = 0.0;
  std::istringstream(ValueIn("/proc/meminfo", name)) >> kibibytes;
  return 1024.0 * kibibytes;
}

//------------------------------------------------------------------------------
Lines SystemLines()
{
  Lines lines;
  char date[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  lines.emplace_back("date", date);
  utsname system = {};
  if (uname(&system) == 0)
  {
    lines.emplace_back("system", std::string(system.sysname) + " " + system.release);
  }
  lines.emplace_back("glibc", gnu_get_libc_version());
  lines.emplace_back("processor",
    ValueIn("/proc/cpuinfo", "model name") + ", " +
      std::to_string(std::thread::hardware_concurrency()) + " processors");
  lines.emplace_back("instruction sets", InstructionSets());
  lines.emplace_back("memory, GiB",
    FormatNumber(MemoryValue("MemTotal") / 1073741824.0, 1) + ", available " +
      FormatNumber(AvailableMemory() / 1073741824.0, 1));
  return lines;
}

//------------------------------------------------------------------------------
void AppendLines(const std::string& text, Lines& lines)
{
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
  {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos)
    {
      lines.emplace_back(line.substr(0, colon), line.substr(colon + 2));
    }
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
double AvailableMemory()
{
  return MemoryValue("MemAvailable");
}

//------------------------------------------------------------------------------
bool IsSoftware(const std::string& renderer)
{
  for (const char* name : { "llvmpipe", "softpipe", "SWR", "Software" })
  {
    if (renderer.find(name) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::string DescribeMachine(const ReportOptions& options, ReportText& report)
{
  Lines lines = SystemLines();
  if (!options.Driver.empty())
  {
    lines.emplace_back("driver", options.Driver);
  }
  ChildProgram program;
  program.Command = { options.Programs + "/meniscus_benchmark_volume", "--device" };
  program.Output = options.Output + "/logs/device.txt";
  program.Errors = options.Output + "/logs/device.err";
  const ChildEnd end = RunChild(program);
  if (!end.Fate.empty())
  {
    report.Miss("graphics device", end.Fate);
  }
  AppendLines(ReadText(program.Output), lines);
  if (!options.About.empty())
  {
    AppendLines(ReadText(options.About), lines);
  }
  std::string renderer;
  std::string json;
  report.Write("## Machine\n\n| | |\n|---|---|\n");
  for (const auto& line : lines)
  {
    report.Write("| " + line.first + " | " + line.second + " |\n");
    json += (json.empty() ? "" : ", ") + Quoted(line.first) + ": " + Quoted(line.second);
    renderer = line.first == "GL_RENDERER" ? line.second : renderer;
  }
  report.AddMember("machine", "{" + json + "}");
  return renderer;
}

} // namespace meniscus::report

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Meshes, rays and transfer functions that are hard on a tetrahedral ray caster, judged by the
 * double reference. Reports lost, stuck and wrong per family; the exit status is 0 without any.
 */
#include "StressRun.h"

#include <algorithm>
#include <cstdint>
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

const char* const Usage =
  "meniscus_stress_volume [options]\n"
  "  --intensity X      1 (default) takes about a minute, 100 includes 10,000 random meshes\n"
  "  --seed N           seed of all random numbers (default 1)\n"
  "  --casters LIST     of kernel, opengl, native (the mapper's backends); default all; the last\n"
  "                     two take part of the cases and are left out without a display\n"
  "  --family TEXT      only families whose names contain the text\n"
  "  --case N           only this case of each family\n"
  "  --every N          every N-th case through the mapper (default 5)\n"
  "  --seconds N        a case that takes longer is stuck (default 300)\n"
  "  --report FILE      write the tables to a file, too\n"
  "Real meshes are those of the folder in the environment's MENISCUS_DATA_DIR, or ../shared/data\n"
  "beside the sources.\n";

struct Options
{
  double Intensity = 1.0;
  std::uint64_t Seed = 1;
  std::string Casters = "kernel,opengl,native";
  std::string Family;
  int Case = -1;
  int Every = 5;
  double Seconds = 300.0;
  std::string Report;
  bool Help = false;
  std::string Problem;
};

//------------------------------------------------------------------------------
template <typename Number>
bool readNumber(const std::string& text, Number& value)
{
  std::istringstream in(text);
  return in >> value && in.eof() && value >= Number(0);
}

//------------------------------------------------------------------------------
bool readOption(const std::string& key, const std::string& value, Options& options)
{
  if (key == "--intensity")
    return readNumber(value, options.Intensity) && options.Intensity > 0.0;
  if (key == "--seed")
    return readNumber(value, options.Seed);
  if (key == "--case")
    return readNumber(value, options.Case);
  if (key == "--every")
    return readNumber(value, options.Every) && options.Every > 0;
  if (key == "--seconds")
    return readNumber(value, options.Seconds) && options.Seconds > 0.0;
  std::string* const text = key == "--casters" ? &options.Casters
    : key == "--family"                        ? &options.Family
    : key == "--report"                        ? &options.Report
                                               : nullptr;
  if (text)
  {
    *text = value;
  }
  return text != nullptr;
}

//------------------------------------------------------------------------------
Options parse(int argc, char* argv[])
{
  Options options;
  for (int i = 1; i < argc; i += 2)
  {
    const std::string key = argv[i];
    if (key == "--help" || key == "-h")
    {
      options.Help = true;
      return options;
    }
    if (i + 1 >= argc || !readOption(key, argv[i + 1], options))
    {
      options.Problem = "unknown option, or bad or missing value: " + key +
        (i + 1 < argc ? std::string(" ") + argv[i + 1] : "");
      return options;
    }
  }
  return options;
}

//------------------------------------------------------------------------------
std::vector<std::string> castersOf(const Options& options, std::ostream& out)
{
  std::vector<std::string> casters;
  std::istringstream list(options.Casters);
  for (std::string name; std::getline(list, name, ',');)
  {
    if (name != "kernel" && name != "opengl" && name != "native")
    {
      std::cerr << "no such caster: " << name << '\n';
      std::exit(EXIT_FAILURE);
    }
    if (name != "kernel" && !hasDisplay())
    {
      out << name << ": skipped, no display (run under xvfb-run)\n";
      continue;
    }
    casters.push_back(name);
  }
  return casters;
}

//------------------------------------------------------------------------------
void printHead(std::ostream& out)
{
  out << "| caster | family | cases | rays | steps | lost | stuck | crashed | wrong | rounding | "
         "silhouettes | max error | RMS | s |\n"
      << "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

//------------------------------------------------------------------------------
void printRow(
  std::ostream& out, const std::string& caster, const std::string& family, const FamilyResult& r)
{
  std::ostringstream row;
  row << "| " << caster << " | " << family << " | " << r.Cases - r.Skipped;
  if (r.Skipped > 0)
  {
    row << " (" << r.Skipped << " skipped)";
  }
  const StressTally& t = r.Tally;
  row << " | " << t.Rays << " | " << t.Steps << " | " << t.Lost << " | " << r.Stuck << " | "
      << r.Crashed << " | " << t.Wrong << " | " << t.Rounding << " | " << t.Silhouettes << " | ";
  if (t.Largest > 0.0)
  {
    row << std::scientific << std::setprecision(1) << t.Largest << " | " << t.Rms;
  }
  else
  {
    row << " | ";
  }
  row << " | " << std::fixed << std::setprecision(1) << r.Seconds << " |\n";
  out << row.str() << std::flush;
}

//------------------------------------------------------------------------------
// The same cases under another name, so that they count and print alike.
StressFamily onlyCase(const StressFamily& family, int index)
{
  return { family.Name, index < family.Cases ? 1 : 0, [=](int) { return family.Make(index); } };
}

//------------------------------------------------------------------------------
bool runAll(const Options& options, std::ostream& out)
{
  const std::vector<std::string> casters = castersOf(options, out);
  std::vector<std::string> notes;
  bool good = true;
  printHead(out);
  for (const std::string& caster : casters)
  {
    for (const StressFamily& family : stressFamilies(options.Intensity, options.Seed))
    {
      if (family.Name.find(options.Family) == std::string::npos)
      {
        continue;
      }
      const int stride = caster == "kernel" || options.Case >= 0 ? 1 : options.Every;
      const FamilyResult result =
        runFamily(options.Case < 0 ? family : onlyCase(family, options.Case), caster, stride,
          options.Seconds);
      printRow(out, caster, family.Name, result);
      good = good && result.isGood();
      for (const std::string& note : result.Notes)
      {
        notes.push_back(caster + ", " + family.Name + ", " + note);
      }
    }
  }
  for (const std::string& note : notes)
  {
    out << note << '\n';
  }
  return good;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const Options options = parse(argc, argv);
  if (options.Help || !options.Problem.empty())
  {
    (options.Help ? std::cout : std::cerr) << options.Problem << '\n' << Usage;
    return options.Help ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  std::cout << "intensity " << options.Intensity << ", seed " << options.Seed << "\n\n";
  std::ostringstream text;
  const bool good = options.Report.empty() ? runAll(options, std::cout) : runAll(options, text);
  if (!options.Report.empty())
  {
    std::cout << text.str();
    std::ofstream file(options.Report);
    file << text.str();
    if (!file.good())
    {
      std::cerr << "cannot write " << options.Report << '\n';
      return EXIT_FAILURE;
    }
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

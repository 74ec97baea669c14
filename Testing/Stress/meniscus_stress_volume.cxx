// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Meshes, rays and transfer functions that are difficult for a tetrahedral ray caster, checked by
 * the double-precision reference. Reports lost, stuck and wrong rays per family; the exit status is
 * 0 if there are none.
 */
#include "ProgrammeOptions.h"
#include "StressRun.h"

using namespace meniscus::test;

namespace
{

const char* const Usage =
  "meniscus_stress_volume [options]\n"
  "Real meshes are those of the folder in the environment's MENISCUS_DATA_DIR, or ../shared/data\n"
  "beside the sources.\n"
  "  --family TEXT      only families whose names contain the text\n"
  "  --intensity X      1 (default) takes about a minute, 100 includes 10,000 random meshes\n"
  "  --casters LIST     of kernel, bent (rays bent by fields of refractive indices), opengl, "
  "native\n"
  "                     (the mapper's backends); default all; the last two take part of the cases\n"
  "                     and are left out without a display\n"
  "  --every N          every N-th case through the mapper (default 5)\n";

struct Options : ProgrammeOptions
{
  std::string Casters = "kernel,bent,opengl,native";
  int Every = 5;
};

//------------------------------------------------------------------------------
std::vector<std::string> CastersOf(const Options& options, std::ostream& out)
{
  std::vector<std::string> casters;
  std::istringstream list(options.Casters);
  for (std::string name; std::getline(list, name, ',');)
  {
    if (name != "kernel" && name != "bent" && name != "opengl" && name != "native")
    {
      std::cerr << "no such caster: " << name << '\n';
      std::exit(EXIT_FAILURE);
    }
    if (name != "kernel" && name != "bent" && !HasDisplay())
    {
      out << name << ": skipped, no display (run under xvfb-run)\n";
      continue;
    }
    casters.push_back(name);
  }
  return casters;
}

//------------------------------------------------------------------------------
void PrintHead(std::ostream& out)
{
  out << "| caster | family | cases | rays | steps | lost | stopped | in folds | stuck | crashed | "
         "wrong | "
         "rounding | "
         "silhouettes | max error | RMS | s |\n"
      << "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

//------------------------------------------------------------------------------
void PrintRow(
  std::ostream& out, const std::string& caster, const std::string& family, const FamilyResult& r)
{
  std::ostringstream row;
  row << "| " << caster << " | " << family << " | " << r.Cases - r.Skipped;
  if (r.Skipped > 0)
  {
    row << " (" << r.Skipped << " skipped)";
  }
  const StressTally& t = r.Tally;
  row << " | " << t.Rays << " | " << t.Steps << " | " << t.Lost << " | " << t.Stopped << " | "
      << t.StoppedInFolds << " | " << r.Stuck << " | " << r.Crashed << " | " << t.Wrong << " | "
      << t.Rounding << " | " << t.Silhouettes << " | ";
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
// The same cases under another name, so that they are counted and printed alike.
StressFamily OnlyCase(const StressFamily& family, int index)
{
  return { family.Name, index < family.Cases ? 1 : 0, [=](int) { return family.Make(index); } };
}

//------------------------------------------------------------------------------
bool RunAll(const Options& options, std::ostream& out)
{
  const std::vector<std::string> casters = CastersOf(options, out);
  std::vector<std::string> notes;
  bool good = true;
  PrintHead(out);
  for (const std::string& caster : casters)
  {
    for (const StressFamily& family : StressFamilies(options.Intensity, options.Seed))
    {
      if (!options.Has(family.Name))
      {
        continue;
      }
      const int stride =
        caster == "kernel" || caster == "bent" || options.Case >= 0 ? 1 : options.Every;
      const FamilyResult result =
        RunFamily(options.Case < 0 ? family : OnlyCase(family, options.Case), caster, stride,
          options.Seconds);
      PrintRow(out, caster, family.Name, result);
      good = good && result.IsGood();
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
  Options options;
  return RunProgramme(
    argc, argv, Usage, options,
    [&options](const std::string& key, const std::string& value)
    {
      if (key == "--casters")
      {
        options.Casters = value;
        return true;
      }
      return key == "--every" && ReadNumber(value, options.Every) && options.Every > 0;
    },
    [&options](std::ostream& out) { return RunAll(options, out); });
}

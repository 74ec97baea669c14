// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Membranes, lists of interfaces, mirrors, eyes and objects that are difficult for virtual geometry
 * with curved patches. One membrane is checked by an interval Newton method on the smooth surface
 * or a dense search on the patches, lists and mirrors by rays through every patch. Reports missed,
 * false, wrong and failed answers per family; the exit status is 0 if there are none.
 */
#include "CaseProcess.h"
#include "ProgrammeOptions.h"
#include "RefractionCheck.h"

using namespace meniscus::test;

namespace
{

const char* const Usage = "meniscus_stress_refraction [options]\n"
                          "  --family TEXT      only families whose names contain the text\n"
                          "  --intensity X      1 (default) takes a minute; cases grow with it\n";

struct FamilyResult : ProcessResult
{
  RefractionTally Tally;
};

//------------------------------------------------------------------------------
std::string Encode(const RefractionTally& t)
{
  std::ostringstream line;
  line.precision(std::numeric_limits<double>::max_digits10);
  line << t.Points << ' ' << t.Images << ' ' << t.Uncertain << ' ' << t.GivenUp << ' ' << t.Missed
       << ' ' << t.False << ' ' << t.Wrong << ' ' << t.Failed << ' ' << t.Largest << ' '
       << t.RaysMissed << ' ' << t.RaysReflected << ' ' << t.Undecided << ' ' << t.RoundTrips << ' '
       << t.LargestRoundTrip << ' ' << t.First;
  return line.str();
}

RefractionTally Decode(const std::string& text)
{
  std::istringstream line(text);
  RefractionTally t;
  line >> t.Points >> t.Images >> t.Uncertain >> t.GivenUp >> t.Missed >> t.False >> t.Wrong >>
    t.Failed >> t.Largest >> t.RaysMissed >> t.RaysReflected >> t.Undecided >> t.RoundTrips >>
    t.LargestRoundTrip;
  line.ignore(1);
  std::getline(line, t.First);
  return t;
}

//------------------------------------------------------------------------------
FamilyResult RunFamily(const RefractionFamily& family, const ProgrammeOptions& options)
{
  FamilyResult result;
  const int only = options.Case;
  const auto start = [&family, only]() -> CaseWork
  { return [&family, only](int index) { return Encode(family.Check(only < 0 ? index : only)); }; };
  const auto take = [&result, only](int index, const std::string& line)
  {
    const RefractionTally tally = Decode(line);
    result.Tally.Add(tally);
    if (!tally.First.empty())
    {
      result.Note("case " + std::to_string(only < 0 ? index : only) + ": " + tally.First);
    }
  };
  const int cases = only < 0 ? family.Cases : (only < family.Cases ? 1 : 0);
  RunCases(cases, 1, options.Seconds, start, take, result);
  return result;
}

//------------------------------------------------------------------------------
void PrintRow(std::ostream& out, const std::string& family, const FamilyResult& r)
{
  const RefractionTally& t = r.Tally;
  std::ostringstream row;
  row << "| " << family << " | " << r.Cases << " | " << t.Points << " | " << t.Images << " | "
      << t.Uncertain << " | " << t.GivenUp << " | " << t.Missed << " | " << t.False << " | "
      << t.Wrong << " | " << t.Failed << " | " << r.Stuck << " | " << r.Crashed << " | "
      << std::scientific << std::setprecision(1) << t.Largest << " | ";
  if (t.RoundTrips > 0)
  {
    row << t.RaysMissed << " | " << t.RaysReflected << " | " << t.Undecided << " | " << t.RoundTrips
        << " | " << t.LargestRoundTrip << " | ";
  }
  else
  {
    row << "| | " << t.Undecided << " | | | ";
  }
  row << std::fixed << r.Seconds << " |\n";
  out << row.str() << std::flush;
}

//------------------------------------------------------------------------------
bool RunAll(const ProgrammeOptions& options, std::ostream& out)
{
  out << "| family | cases | points | images | uncertain | given up | missed | false | wrong | "
         "failed | stuck | crashed | max error | rays missed | rays reflected | undecided | round "
         "trips | "
         "largest | s |\n"
      << "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  std::vector<std::string> notes;
  FamilyResult sum;
  bool good = true;
  for (const RefractionFamily& family : RefractionFamilies(options.Intensity, options.Seed))
  {
    if (!options.Has(family.Name))
    {
      continue;
    }
    const FamilyResult result = RunFamily(family, options);
    PrintRow(out, family.Name, result);
    good = good && result.Tally.IsGood() && result.Crashed == 0 && result.Stuck == 0;
    for (const std::string& note : result.Notes)
    {
      notes.push_back(family.Name + ", " + note);
    }
    sum.Tally.Add(result.Tally);
    sum.Cases += result.Cases;
    sum.Stuck += result.Stuck;
    sum.Crashed += result.Crashed;
    sum.Seconds += result.Seconds;
  }
  PrintRow(out, "all", sum);
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
  ProgrammeOptions options;
  return RunProgramme(
    argc, argv, Usage, options, [](const std::string&, const std::string&) { return false; },
    [&options](std::ostream& out) { return RunAll(options, out); });
}

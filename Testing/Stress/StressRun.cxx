// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StressRun.h"

#include "StressBentRays.h"

namespace meniscus::test
{

namespace
{

// One case in the child's report: a line of numbers, then the text.
std::string Encode(bool skipped, const StressTally& t)
{
  std::ostringstream line;
  line.precision(std::numeric_limits<double>::max_digits10);
  line << skipped << ' ' << t.Views << ' ' << t.Rays << ' ' << t.Steps << ' ' << t.Lost << ' '
       << t.Stopped << ' ' << t.StoppedInFolds << ' ' << t.Wrong << ' ' << t.Rounding << ' '
       << t.Silhouettes << ' ' << t.Largest << ' ' << t.Rms << ' ' << t.FirstWrong;
  return line.str();
}

void Decode(int index, const std::string& text, FamilyResult& result)
{
  std::istringstream line(text);
  StressTally t;
  bool skipped = false;
  line >> skipped >> t.Views >> t.Rays >> t.Steps >> t.Lost >> t.Stopped >> t.StoppedInFolds >>
    t.Wrong >> t.Rounding >> t.Silhouettes >> t.Largest >> t.Rms;
  line.ignore(1);
  std::getline(line, t.FirstWrong);
  result.Skipped += skipped;
  result.Tally.Add(t);
  if (!t.FirstWrong.empty())
  {
    result.Note("case " + std::to_string(index) + ": " + t.FirstWrong);
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
FamilyResult RunFamily(
  const StressFamily& family, const std::string& caster, int stride, double secondsPerCase)
{
  FamilyResult result;
  const auto start = [&family, &caster]() -> CaseWork
  {
    if (caster == "bent")
    {
      return [&family](int index)
      {
        const StressCase stress = family.Make(index);
        return Encode(!stress.Mesh, CheckBentRays(stress));
      };
    }
    const std::shared_ptr<StressCaster> shared = MakeStressCaster(caster);
    return [&family, shared](int index)
    {
      const StressCase stress = family.Make(index);
      return Encode(!stress.Mesh, CheckCase(*shared, stress));
    };
  };
  RunCases(
    family.Cases, stride, secondsPerCase, start,
    [&result](int index, const std::string& line) { Decode(index, line, result); }, result);
  return result;
}

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RelationRun.h"

#include "CaseProcess.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace meniscus
{
namespace test
{

namespace
{

struct RelationResult : ProcessResult
{
  RelationTally Tally;

  bool isGood() const
  {
    return this->Tally.Failures == 0 && this->Crashed == 0 && this->Stuck == 0;
  }
};

// One case as the child reports it: a line of numbers, then the words.
std::string encode(const RelationTally& t)
{
  std::ostringstream line;
  line.precision(std::numeric_limits<double>::max_digits10);
  line << t.Scenes << ' ' << t.Comparisons << ' ' << t.Values << ' ' << t.Conditioned << ' '
       << t.Wrong << ' ' << t.Failures << ' ' << t.Deviation << ' ' << t.Tolerance << ' '
       << t.FirstFailure;
  return line.str();
}

RelationTally decode(const std::string& text)
{
  std::istringstream line(text);
  RelationTally t;
  line >> t.Scenes >> t.Comparisons >> t.Values >> t.Conditioned >> t.Wrong >> t.Failures >>
    t.Deviation >> t.Tolerance;
  line.ignore(1);
  std::getline(line, t.FirstFailure);
  return t;
}

RelationResult runRelation(const Relation& relation, const ProgrammeOptions& options)
{
  RelationResult result;
  const int only = options.Case;
  const auto nameOf = [only](int index) { return only < 0 ? index : only; };
  const auto start = [&relation, nameOf]() -> CaseWork
  {
    const RelationWork work = relation.Start();
    return [work, nameOf](int index) { return encode(work(nameOf(index))); };
  };
  const auto take = [&result, nameOf](int index, const std::string& line)
  {
    const RelationTally tally = decode(line);
    result.Tally.add(tally);
    if (!tally.FirstFailure.empty())
    {
      result.note("case " + std::to_string(nameOf(index)) + ": " + tally.FirstFailure);
    }
  };
  const int cases = only < 0 ? relation.Cases : (only < relation.Cases ? 1 : 0);
  runCases(cases, 1, options.Seconds, start, take, result);
  return result;
}

// Whether a deviation is a larger part of its tolerance than another; NaN is. A tolerance below 0:
// there is no other yet.
bool outranks(double deviation, double tolerance, double other, double toleranceOfOther)
{
  return toleranceOfOther < 0.0 || !(deviation * toleranceOfOther <= other * tolerance);
}

void printHead(std::ostream& out)
{
  out << "| relation | scenes | comparisons | values | conditioned | largest deviation | of "
         "tolerance | wrong values | failures | stuck | crashed | s |\n"
      << "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

void printRow(std::ostream& out, const std::string& name, const RelationResult& r)
{
  const RelationTally& t = r.Tally;
  std::ostringstream row;
  row << "| " << name << " | " << t.Scenes << " | " << t.Comparisons << " | " << t.Values << " | "
      << t.Conditioned << " | " << std::scientific << std::setprecision(1);
  if (t.Tolerance >= 0.0)
  {
    row << t.Deviation << " | " << t.Tolerance;
  }
  else
  {
    row << " | ";
  }
  row << " | " << t.Wrong << " | " << t.Failures << " | " << r.Stuck << " | " << r.Crashed << " | "
      << std::fixed << r.Seconds << " |\n";
  out << row.str() << std::flush;
}

bool runAll(
  const std::vector<Relation>& relations, const ProgrammeOptions& options, std::ostream& out)
{
  printHead(out);
  RelationResult sum;
  std::vector<std::string> notes;
  bool good = true;
  for (const Relation& relation : relations)
  {
    if (!options.has(relation.Name))
    {
      continue;
    }
    const RelationResult result = runRelation(relation, options);
    printRow(out, relation.Name, result);
    good = good && result.isGood();
    for (const std::string& note : result.Notes)
    {
      notes.push_back(relation.Name + ", " + note);
    }
    sum.Tally.add(result.Tally);
    sum.Stuck += result.Stuck;
    sum.Crashed += result.Crashed;
    sum.Seconds += result.Seconds;
  }
  printRow(out, "all", sum);
  for (const std::string& note : notes)
  {
    out << note << '\n';
  }
  // Options that choose nothing must not pass as a success.
  return good && sum.Tally.Comparisons > 0;
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool RelationTally::compare(double deviation, double tolerance)
{
  ++this->Values;
  const bool good = deviation <= tolerance; // false for NaN
  this->Wrong += !good;
  if (outranks(deviation, tolerance, this->Deviation, this->Tolerance))
  {
    this->Deviation = deviation;
    this->Tolerance = tolerance;
  }
  return good;
}

//------------------------------------------------------------------------------
void RelationTally::add(const RelationTally& other)
{
  this->Scenes += other.Scenes;
  this->Comparisons += other.Comparisons;
  this->Values += other.Values;
  this->Conditioned += other.Conditioned;
  this->Wrong += other.Wrong;
  this->Failures += other.Failures;
  if (other.Tolerance >= 0.0 &&
    outranks(other.Deviation, other.Tolerance, this->Deviation, this->Tolerance))
  {
    this->Deviation = other.Deviation;
    this->Tolerance = other.Tolerance;
  }
  this->FirstFailure = this->FirstFailure.empty() ? other.FirstFailure : this->FirstFailure;
}

//------------------------------------------------------------------------------
int runMetamorphicProgramme(int argc, char* argv[], const char* usage, ProgrammeOptions& options,
  const OptionReader& readMore, const RelationMaker& make)
{
  options.GroupOption = "--relation";
  return runProgramme(argc, argv, usage, options, readMore,
    [&options, &make](std::ostream& out) { return runAll(make(), options, out); });
}

//------------------------------------------------------------------------------
int casesAt(double intensity, int atOne)
{
  return std::max(1, static_cast<int>(std::lround(intensity * atOne)));
}

//------------------------------------------------------------------------------
std::uint64_t seedOfCase(std::uint64_t seed, const std::string& relation, int index)
{
  // FNV-1a of the name: a relation's scenes do not change when another one is added before it.
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : relation)
  {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  RandomNumbers mix(seed ^ hash);
  return RandomNumbers(mix.bits() + static_cast<std::uint64_t>(index)).bits();
}

} // namespace test
} // namespace meniscus

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RelationRun.h"

#include "CaseProcess.h"
#include "RandomNumbers.h"

#include <chrono>

namespace meniscus::test
{

namespace
{

struct RelationResult
{
  RelationTally Tally;
  int Crashed = 0;
  int Stuck = 0;
  double Seconds = 0.0;

  bool IsGood() const
  {
    return this->Tally.Failures == 0 && this->Crashed == 0 && this->Stuck == 0;
  }

  void Add(const RelationResult& other)
  {
    this->Tally.Add(other.Tally);
    this->Crashed += other.Crashed;
    this->Stuck += other.Stuck;
    this->Seconds += other.Seconds;
  }
};

// One case in the child's report: a line of numbers, then the text.
std::string Encode(const RelationTally& t)
{
  std::ostringstream line;
  line.precision(std::numeric_limits<double>::max_digits10);
  line << t.Scenes << ' ' << t.Comparisons << ' ' << t.Values << ' ' << t.Conditioned << ' '
       << t.Wrong << ' ' << t.Failures << ' ' << t.Deviation << ' ' << t.Tolerance << ' '
       << t.FirstFailure;
  return line.str();
}

RelationTally Decode(const std::string& text)
{
  std::istringstream line(text);
  RelationTally t;
  std::string deviation;
  line >> t.Scenes >> t.Comparisons >> t.Values >> t.Conditioned >> t.Wrong >> t.Failures >>
    deviation >> t.Tolerance;
  // A result that is missing is infinitely far away, which a stream writes but does not read.
  t.Deviation = std::strtod(deviation.c_str(), nullptr);
  line.ignore(1);
  std::getline(line, t.FirstFailure);
  return t;
}

// True if a deviation is a larger fraction of its tolerance than another one; NaN is. A tolerance
// below 0 means that there is no other yet.
bool Outranks(double deviation, double tolerance, double other, double toleranceOfOther)
{
  return toleranceOfOther < 0.0 || !(deviation * toleranceOfOther <= other * tolerance);
}

void PrintHead(std::ostream& out)
{
  out << "| relation | scenes | comparisons | values | conditioned | largest deviation | of "
         "tolerance | wrong values | failures | stuck | crashed | s |\n"
      << "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

void PrintRow(std::ostream& out, const std::string& name, const RelationResult& r)
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

// The selected cases of the selected relations in a row, and their results.
class RelationTable
{
public:
  RelationTable(
    const std::vector<Relation>& relations, const ProgrammeOptions& options, std::ostream& out)
    : Relations(relations)
    , Out(out)
    , Results(relations.size())
    , Begin(std::chrono::steady_clock::now())
  {
    for (std::size_t r = 0; r < relations.size(); ++r)
    {
      const bool chosen = options.Has(relations[r].Name);
      for (int i = 0; i < relations[r].Cases && chosen; ++i)
      {
        if (options.Case < 0 || options.Case == i)
        {
          this->Cases.emplace_back(r, i);
        }
      }
    }
  }

  int NumberOfCases() const { return static_cast<int>(this->Cases.size()); }

  // All cases of a process, of all relations.
  CaseWork GetStart() const
  {
    const auto works = std::make_shared<std::map<std::size_t, RelationWork>>();
    return [this, works](int index)
    {
      const auto& one = this->Cases[static_cast<std::size_t>(index)];
      RelationWork& work = (*works)[one.first];
      work = work ? work : this->Relations[one.first].Start();
      return Encode(work(one.second));
    };
  }

  void Take(int index, const std::string& line)
  {
    RelationResult result;
    result.Tally = Decode(line);
    this->Take(index, result, result.Tally.FirstFailure);
  }

  void Lose(int index, bool stuck)
  {
    RelationResult result;
    ++(stuck ? result.Stuck : result.Crashed);
    this->Take(index, result, stuck ? "no end" : "the process ended by a signal");
  }

  // Prints the remaining output; returns true if no relation failed.
  bool Finish()
  {
    RelationResult sum;
    for (const RelationResult& result : this->Results)
    {
      sum.Add(result);
    }
    PrintRow(this->Out, "all", sum);
    for (const std::string& note : this->Notes)
    {
      this->Out << note << '\n';
    }
    // Options that select nothing must not count as a success.
    return sum.IsGood() && sum.Tally.Comparisons > 0;
  }

private:
  void Take(int index, const RelationResult& result, const std::string& words)
  {
    const auto at = static_cast<std::size_t>(index);
    const std::size_t relation = this->Cases[at].first;
    const std::string& name = this->Relations[relation].Name;
    RelationResult& total = this->Results[relation];
    total.Add(result);
    if (!words.empty())
    {
      this->Notes.push_back(
        name + ", case " + std::to_string(this->Cases[at].second) + ": " + words);
    }
    if (at + 1 == this->Cases.size() || this->Cases[at + 1].first != relation)
    {
      const auto now = std::chrono::steady_clock::now();
      total.Seconds = std::chrono::duration<double>(now - this->Begin).count();
      this->Begin = now;
      PrintRow(this->Out, name, total);
    }
  }

  const std::vector<Relation>& Relations;
  std::ostream& Out;
  std::vector<RelationResult> Results;
  // Relation and number.
  std::vector<std::pair<std::size_t, int>> Cases;
  std::vector<std::string> Notes;
  std::chrono::steady_clock::time_point Begin;
};

bool RunAll(
  const std::vector<Relation>& relations, const ProgrammeOptions& options, std::ostream& out)
{
  PrintHead(out);
  RelationTable table(relations, options, out);
  ProcessResult processes;
  RunCases(
    table.NumberOfCases(), 1, options.Seconds, [&table]() { return table.GetStart(); },
    [&table](int index, const std::string& line) { table.Take(index, line); }, processes,
    [&table](int index, bool stuck) { table.Lose(index, stuck); });
  return table.Finish();
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool RelationTally::Compare(double deviation, double tolerance)
{
  ++this->Values;
  const bool good = deviation <= tolerance; // false for NaN
  this->Wrong += !good;
  if (Outranks(deviation, tolerance, this->Deviation, this->Tolerance))
  {
    this->Deviation = deviation;
    this->Tolerance = tolerance;
  }
  return good;
}

//------------------------------------------------------------------------------
void RelationTally::Add(const RelationTally& other)
{
  this->Scenes += other.Scenes;
  this->Comparisons += other.Comparisons;
  this->Values += other.Values;
  this->Conditioned += other.Conditioned;
  this->Wrong += other.Wrong;
  this->Failures += other.Failures;
  if (other.Tolerance >= 0.0 &&
    Outranks(other.Deviation, other.Tolerance, this->Deviation, this->Tolerance))
  {
    this->Deviation = other.Deviation;
    this->Tolerance = other.Tolerance;
  }
  this->FirstFailure = this->FirstFailure.empty() ? other.FirstFailure : this->FirstFailure;
}

//------------------------------------------------------------------------------
int RunMetamorphicProgramme(int argc, char* argv[], const char* usage, ProgrammeOptions& options,
  const OptionReader& readMore, const RelationMaker& make)
{
  options.GroupOption = "--relation";
  return RunProgramme(argc, argv, usage, options, readMore,
    [&options, &make](std::ostream& out) { return RunAll(make(), options, out); });
}

//------------------------------------------------------------------------------
int CasesAt(double intensity, int atOne)
{
  return std::max(1, static_cast<int>(std::lround(intensity * atOne)));
}

//------------------------------------------------------------------------------
std::uint64_t SeedOfCase(std::uint64_t seed, const std::string& relation, int index)
{
  // FNV-1a of the name: a relation's scenes do not change when another one is added before it.
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : relation)
  {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  RandomNumbers mix(seed ^ hash);
  return RandomNumbers(mix.Bits() + static_cast<std::uint64_t>(index)).Bits();
}

} // namespace meniscus::test

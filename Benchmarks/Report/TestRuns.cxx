// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestRuns.h"

#include "ChildProgram.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace meniscus::report
{

namespace
{

constexpr std::size_t QuickStride = 32;

struct TestProgram
{
  const char* Title;
  const char* Program;
  const char* Backend; ///< value of MENISCUS_TEST_BACKEND; empty: none
};

const TestProgram Programs[] = {
  { "numeric, fragment shader", "meniscus_rendering_numeric_tests", "OpenGL" },
  { "numeric, compute shader", "meniscus_rendering_numeric_tests", "Compute" },
  { "numeric, native", "meniscus_rendering_numeric_tests", "Native" },
  { "kernel", "meniscus_kernel_tests", "" },
  { "reference", "meniscus_volume_reference_tests", "" },
  { "filters", "meniscus_filter_tests", "" },
};

enum class Outcome
{
  NotRun,
  Passed,
  Failed,
  Skipped,
  Crashed ///< or without end
};

struct TestRecord
{
  std::string Name;
  Outcome Result = Outcome::NotRun;
  std::string Note;
};

struct TestRun
{
  std::vector<TestRecord> Tests;
  double Seconds = 0.0;

  int Count(Outcome result) const
  {
    return static_cast<int>(std::count_if(this->Tests.begin(), this->Tests.end(),
      [result](const TestRecord& test) { return test.Result == result; }));
  }
};

//------------------------------------------------------------------------------
// Names in the output of --gtest_list_tests: suites, and their tests indented.
std::vector<TestRecord> ParseList(const std::string& text)
{
  std::vector<TestRecord> tests;
  std::istringstream in(text);
  std::string suite;
  for (std::string line; std::getline(in, line);)
  {
    const std::size_t end = std::min(line.find("  #"), line.size());
    if (line.compare(0, 2, "  ") == 0)
    {
      tests.push_back({ suite + line.substr(2, end - 2), Outcome::NotRun, "" });
    }
    else
    {
      suite = line.substr(0, end);
    }
  }
  return tests;
}

//------------------------------------------------------------------------------
// A line that ends a test has a mark in brackets, a name and a time; those of the summary have no
// time.
bool ParseEnd(const std::string& line, const char* mark, std::string& name)
{
  const std::string start(mark);
  if (line.compare(0, start.size(), start) != 0 || line.find(" ms)") == std::string::npos)
  {
    return false;
  }
  name = line.substr(start.size(), line.find_first_of(", (", start.size()) - start.size());
  return true;
}

//------------------------------------------------------------------------------
// Records the tests that a log contains. The one that began and did not end has crashed.
void ParseLog(const std::string& text, const std::string& fate, std::vector<TestRecord>& tests)
{
  const std::map<const char*, Outcome> marks{ { "[       OK ] ", Outcome::Passed },
    { "[  FAILED  ] ", Outcome::Failed }, { "[  SKIPPED ] ", Outcome::Skipped } };
  const auto record = [&tests](const std::string& name, Outcome result, const std::string& note)
  {
    for (TestRecord& test : tests)
    {
      if (test.Name == name)
      {
        test.Result = result;
        test.Note = result == Outcome::Passed ? "" : note;
      }
    }
  };
  std::istringstream in(text);
  std::string running;
  std::string note;
  for (std::string line; std::getline(in, line);)
  {
    std::string name;
    const std::string begin = "[ RUN      ] ";
    if (line.compare(0, begin.size(), begin) == 0)
    {
      running = line.substr(begin.size());
      note.clear();
      continue;
    }
    for (const auto& mark : marks)
    {
      if (ParseEnd(line, mark.first, name))
      {
        record(name, mark.second, note);
        running.clear();
      }
    }
    note += note.size() < 300 ? (note.empty() ? "" : " ") + line : "";
  }
  if (!running.empty())
  {
    record(running, Outcome::Crashed, fate);
  }
}

//------------------------------------------------------------------------------
// Runs the tests that have no outcome yet; returns false if none got one.
bool RunSome(const ChildProgram& program, TestRun& run, std::size_t stride)
{
  std::string filter;
  for (std::size_t i = 0; i < run.Tests.size(); i += stride)
  {
    if (run.Tests[i].Result == Outcome::NotRun &&
      run.Tests[i].Name.find("DISABLED_") == std::string::npos)
    {
      filter += (filter.empty() ? "" : ":") + run.Tests[i].Name;
    }
  }
  if (filter.empty())
  {
    return false;
  }
  ChildProgram some = program;
  some.Command.push_back("--gtest_filter=" + filter);
  some.Command.push_back("--gtest_color=no");
  const int before = run.Count(Outcome::NotRun);
  const ChildEnd end = RunChild(some);
  run.Seconds += end.Seconds;
  ParseLog(ReadText(some.Output), end.Fate, run.Tests);
  return run.Count(Outcome::NotRun) < before;
}

//------------------------------------------------------------------------------
TestRun RunAll(const TestProgram& description, const ReportOptions& options)
{
  const std::string start =
    options.Output + "/logs/" + description.Program + "-" + description.Backend;
  ChildProgram program;
  program.Command = { options.Programs + "/" + description.Program };
  program.Variable =
    *description.Backend ? std::string("MENISCUS_TEST_BACKEND=") + description.Backend : "";
  program.Errors = start + ".err";
  ChildProgram list = program;
  list.Command.push_back("--gtest_list_tests");
  list.Output = start + "-list.txt";
  RunChild(list);
  TestRun run;
  run.Tests = ParseList(ReadText(list.Output));
  for (int part = 0;; ++part)
  {
    program.Output = start + (part ? "-" + std::to_string(part) : "") + ".txt";
    if (!RunSome(program, run, options.Quick ? QuickStride : 1))
    {
      return run;
    }
  }
}

//------------------------------------------------------------------------------
std::string NotesOf(const TestRun& run, Outcome result, const char* title)
{
  std::string text;
  for (const TestRecord& test : run.Tests)
  {
    if (test.Result == result)
    {
      text += "- " + std::string(title) + ": `" + test.Name + "` " + test.Note + "\n";
    }
  }
  return text;
}

//------------------------------------------------------------------------------
std::string JsonOf(const TestProgram& program, const TestRun& run)
{
  const std::pair<const char*, Outcome> names[] = { { "failed", Outcome::Failed },
    { "skipped", Outcome::Skipped }, { "crashed", Outcome::Crashed } };
  std::string text = "{\"name\": " + Quoted(program.Title) +
    ", \"program\": " + Quoted(program.Program) + ", \"backend\": " + Quoted(program.Backend) +
    ", \"tests\": " + std::to_string(run.Tests.size()) +
    ", \"passed\": " + std::to_string(run.Count(Outcome::Passed)) +
    ", \"not_run\": " + std::to_string(run.Count(Outcome::NotRun)) +
    ", \"seconds\": " + FormatNumber(run.Seconds, 1);
  for (const auto& name : names)
  {
    text += ", " + Quoted(name.first) + ": [";
    bool first = true;
    for (const TestRecord& test : run.Tests)
    {
      if (test.Result == name.second)
      {
        text += (first ? "" : ", ") +
          ("{\"name\": " + Quoted(test.Name) + ", \"note\": " + Quoted(test.Note) + "}");
        first = false;
      }
    }
    text += "]";
  }
  return text + "}";
}

//------------------------------------------------------------------------------
// Tests without an outcome that no option explains.
int CountLost(const TestRun& run, bool quick)
{
  int lost = 0;
  for (std::size_t i = 0; i < run.Tests.size(); i += quick ? QuickStride : 1)
  {
    lost += run.Tests[i].Result == Outcome::NotRun &&
      run.Tests[i].Name.find("DISABLED_") == std::string::npos;
  }
  return lost;
}

} // anonymous namespace

//------------------------------------------------------------------------------
void RunTests(const ReportOptions& options, ReportText& report)
{
  report.Write(
    "\n## Tests\n\n| tests | number | passed | failed | skipped | crashed or without end "
    "| not run | s |\n|---|---|---|---|---|---|---|---|\n");
  std::string notes;
  std::string json;
  for (const TestProgram& program : Programs)
  {
    std::cerr << "tests: " << program.Title << std::endl;
    const TestRun run = RunAll(program, options);
    report.Write("| " + std::string(program.Title) + " | " + std::to_string(run.Tests.size()));
    for (const Outcome result :
      { Outcome::Passed, Outcome::Failed, Outcome::Skipped, Outcome::Crashed, Outcome::NotRun })
    {
      report.Write(" | " + std::to_string(run.Count(result)));
    }
    report.Write(" | " + FormatNumber(run.Seconds, 1) + " |\n");
    const std::string title = program.Title;
    notes += NotesOf(run, Outcome::Failed, (title + ", failed").c_str()) +
      NotesOf(run, Outcome::Crashed, (title + ", crashed").c_str()) +
      NotesOf(run, Outcome::Skipped, (title + ", skipped").c_str());
    json += (json.empty() ? "" : ",\n") + JsonOf(program, run);
    report.CountFailedTests(run.Count(Outcome::Failed) + run.Count(Outcome::Crashed));
    const int lost = CountLost(run, options.Quick);
    if (run.Tests.empty() || lost > 0)
    {
      report.Miss("tests: " + title,
        run.Tests.empty() ? "the program lists no tests"
                          : std::to_string(lost) + " tests could not be run");
    }
  }
  if (options.Quick)
  {
    report.LeaveOut("31 of 32 tests of every program", "--quick");
  }
  report.Write("\n" + notes);
  report.AddMember("tests", "[\n" + json + "\n]");
}

} // namespace meniscus::report

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StressRun.h"

#include <vtkUnstructuredGrid.h>

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace meniscus
{
namespace test
{

namespace
{

// One case as the child reports it: a line of numbers, then the words.
std::string encode(int index, bool skipped, const StressTally& t)
{
  std::ostringstream line;
  line.precision(std::numeric_limits<double>::max_digits10);
  std::string words = t.FirstWrong;
  std::replace(words.begin(), words.end(), '\n', ' ');
  line << index << ' ' << skipped << ' ' << t.Views << ' ' << t.Rays << ' ' << t.Steps << ' '
       << t.Lost << ' ' << t.Wrong << ' ' << t.Rounding << ' ' << t.Silhouettes << ' ' << t.Largest
       << ' ' << t.Rms << ' ' << words << '\n';
  return line.str();
}

void decode(const std::string& text, FamilyResult& result, int& index)
{
  std::istringstream line(text);
  StressTally t;
  bool skipped = false;
  line >> index >> skipped >> t.Views >> t.Rays >> t.Steps >> t.Lost >> t.Wrong >> t.Rounding >>
    t.Silhouettes >> t.Largest >> t.Rms;
  line.ignore(1);
  std::getline(line, t.FirstWrong);
  ++result.Cases;
  result.Skipped += skipped;
  result.Tally.add(t);
  if (!t.FirstWrong.empty() && result.Notes.size() < FamilyResult::MostNotes)
  {
    result.Notes.push_back("case " + std::to_string(index) + ": " + t.FirstWrong);
  }
}

[[noreturn]] void runChild(
  const StressFamily& family, const std::string& casterName, int first, int stride, int out)
{
  const auto caster = makeStressCaster(casterName);
  for (int i = first; i < family.Cases; i += stride)
  {
    const StressCase stress = family.Make(i);
    const std::string line = encode(i, !stress.Mesh, checkCase(*caster, stress));
    if (write(out, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    {
      break;
    }
  }
  // Not exit(): the parent's buffers and static objects are not this process's to flush.
  _exit(EXIT_SUCCESS);
}

// Reads lines until the child ends or is silent for too long; returns the last case it finished.
int followChild(int in, double secondsPerCase, FamilyResult& result, bool& silent)
{
  int last = -1;
  std::string text;
  for (;;)
  {
    pollfd waiting{ in, POLLIN, 0 };
    if (poll(&waiting, 1, static_cast<int>(1e3 * secondsPerCase)) <= 0)
    {
      silent = true;
      return last;
    }
    char buffer[4096];
    const ssize_t size = read(in, buffer, sizeof buffer);
    if (size <= 0)
    {
      return last;
    }
    text.append(buffer, static_cast<std::size_t>(size));
    for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n'))
    {
      decode(text.substr(0, end), result, last);
      text.erase(0, end + 1);
    }
  }
}

// Runs cases from the first one on; returns the case after the last one done or given up.
int runSome(const StressFamily& family, const std::string& caster, int first, int stride,
  double secondsPerCase, FamilyResult& result)
{
  int ends[2];
  if (pipe(ends) != 0)
  {
    std::perror("pipe");
    std::exit(EXIT_FAILURE);
  }
  const pid_t child = fork();
  if (child < 0)
  {
    std::perror("fork");
    std::exit(EXIT_FAILURE);
  }
  if (child == 0)
  {
    close(ends[0]);
    runChild(family, caster, first, stride, ends[1]);
  }
  close(ends[1]);
  bool silent = false;
  const int last = followChild(ends[0], secondsPerCase, result, silent);
  close(ends[0]);
  if (silent)
  {
    kill(child, SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  const int next = last < 0 ? first : last + stride;
  if (!silent && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS)
  {
    return family.Cases;
  }
  ++result.Cases;
  ++(silent ? result.Stuck : result.Crashed);
  if (result.Notes.size() < FamilyResult::MostNotes)
  {
    result.Notes.push_back("case " + std::to_string(next) +
      (silent ? ": no end after " + std::to_string(secondsPerCase) + " s"
              : ": ended by signal or exit, status " + std::to_string(status)));
  }
  return next + stride;
}

} // anonymous namespace

//------------------------------------------------------------------------------
FamilyResult runFamily(
  const StressFamily& family, const std::string& caster, int stride, double secondsPerCase)
{
  const auto begin = std::chrono::steady_clock::now();
  FamilyResult result;
  for (int first = 0; first < family.Cases;)
  {
    first = runSome(family, caster, first, stride, secondsPerCase, result);
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  result.Seconds = time.count();
  return result;
}

} // namespace test
} // namespace meniscus

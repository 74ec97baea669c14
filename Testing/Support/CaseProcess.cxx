// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CaseProcess.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

namespace meniscus::test
{

namespace
{

[[noreturn]] void RunChild(int cases, int first, int stride, const CaseStart& start, int out)
{
  const CaseWork work = start();
  for (int i = first; i < cases; i += stride)
  {
    std::string line = std::to_string(i) + ' ' + work(i);
    std::replace(line.begin(), line.end(), '\n', ' ');
    line += '\n';
    if (write(out, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    {
      break;
    }
  }
  // _exit(), not exit(): this process must not flush the parent's buffers or destroy its static
  // objects.
  _exit(EXIT_SUCCESS);
}

// Reads lines until the child ends or is silent for too long; returns the last case that it
// finished.
int FollowChild(
  int in, double secondsPerCase, const CaseTaker& take, ProcessResult& result, bool& silent)
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
      std::istringstream line(text.substr(0, end));
      text.erase(0, end + 1);
      std::string words;
      line >> last;
      line.ignore(1);
      std::getline(line, words);
      ++result.Cases;
      take(last, words);
    }
  }
}

// Runs cases from the first one on; returns the case after the last one that was finished or
// abandoned.
int RunSome(int cases, int first, int stride, double secondsPerCase, const CaseStart& start,
  const CaseTaker& take, ProcessResult& result, const CaseLoss& lose)
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
    RunChild(cases, first, stride, start, ends[1]);
  }
  close(ends[1]);
  bool silent = false;
  const int last = FollowChild(ends[0], secondsPerCase, take, result, silent);
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
    return cases;
  }
  ++result.Cases;
  ++(silent ? result.Stuck : result.Crashed);
  result.Note("case " + std::to_string(next) +
    (silent ? ": no end after " + std::to_string(secondsPerCase) + " s"
            : ": ended by signal or exit, status " + std::to_string(status)));
  if (lose)
  {
    lose(next, silent);
  }
  return next + stride;
}

} // anonymous namespace

//------------------------------------------------------------------------------
void RunCases(int cases, int stride, double secondsPerCase, const CaseStart& start,
  const CaseTaker& take, ProcessResult& result, const CaseLoss& lose)
{
  const auto begin = std::chrono::steady_clock::now();
  for (int first = 0; first < cases;)
  {
    first = RunSome(cases, first, stride, secondsPerCase, start, take, result, lose);
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  result.Seconds = time.count();
}

} // namespace meniscus::test

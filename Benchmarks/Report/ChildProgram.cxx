// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChildProgram.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace meniscus::report
{

namespace
{

using Clock = std::chrono::steady_clock;

//------------------------------------------------------------------------------
void Redirect(const std::string& file, int descriptor)
{
  const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (out < 0 || dup2(out, descriptor) < 0)
  {
    _exit(EXIT_FAILURE);
  }
  close(out);
}

//------------------------------------------------------------------------------
// A process group of its own, so that processes that the program started end with it.
[[noreturn]] void Execute(const ChildProgram& program)
{
  setpgid(0, 0);
  Redirect(program.Output, STDOUT_FILENO);
  Redirect(program.Errors, STDERR_FILENO);
  std::string variable = program.Variable;
  if (!variable.empty())
  {
    putenv(variable.data());
  }
  std::vector<std::string> words = program.Command;
  std::vector<char*> pointers;
  for (std::string& word : words)
  {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  execv(pointers.front(), pointers.data());
  _exit(EXIT_FAILURE);
}

//------------------------------------------------------------------------------
long SizeOf(const std::string& file)
{
  struct stat data;
  return stat(file.c_str(), &data) == 0 ? static_cast<long>(data.st_size) : 0;
}

//------------------------------------------------------------------------------
// Waits for the end; returns false if the program was silent for too long and was ended.
bool WaitFor(pid_t child, const ChildProgram& program, int& status, rusage& usage)
{
  long size = 0;
  auto grown = Clock::now();
  while (wait4(child, &status, WNOHANG, &usage) == 0)
  {
    const long now = SizeOf(program.Output) + SizeOf(program.Errors);
    if (now != size)
    {
      size = now;
      grown = Clock::now();
    }
    if (std::chrono::duration<double>(Clock::now() - grown).count() > program.SilentSeconds)
    {
      kill(-child, SIGKILL);
      wait4(child, &status, 0, &usage);
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

} // anonymous namespace

//------------------------------------------------------------------------------
ChildEnd RunChild(const ChildProgram& program)
{
  ChildEnd end;
  const auto begin = Clock::now();
  const pid_t child = fork();
  if (child == 0)
  {
    Execute(program);
  }
  if (child < 0)
  {
    end.Fate = "no process could be started";
    return end;
  }
  int status = 0;
  rusage usage = {};
  const bool inTime = WaitFor(child, program, status, usage);
  end.Seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  end.PeakBytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  end.Exited = inTime && WIFEXITED(status);
  end.Status = end.Exited ? WEXITSTATUS(status) : -1;
  if (!inTime)
  {
    end.Fate = "ended after " + std::to_string(static_cast<int>(program.SilentSeconds)) +
      " s without output";
  }
  else if (!end.Exited)
  {
    end.Fate = "ended by signal " + std::to_string(WTERMSIG(status));
  }
  else if (end.Status != 0)
  {
    end.Fate = "exit status " + std::to_string(end.Status);
  }
  return end;
}

//------------------------------------------------------------------------------
std::string ReadText(const std::string& name)
{
  std::ifstream in(name);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

} // namespace meniscus::report

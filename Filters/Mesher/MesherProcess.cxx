// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesher/MesherProcess.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>

extern char** environ;

namespace meniscus
{

namespace
{

/** A folder that exists as long as this object. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "meniscus-XXXXXX").string();
    if (!error && mkdtemp(&name[0]))
    {
      this->Path = name;
    }
  }
  ~TemporaryFolder()
  {
    std::error_code error;
    if (!this->Path.empty())
    {
      std::filesystem::remove_all(this->Path, error);
    }
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  void operator=(const TemporaryFolder&) = delete;

  bool Exists() const { return !this->Path.empty(); }
  std::string File(const char* name) const { return this->Path + '/' + name; }

private:
  std::string Path;
};

// Starts a program in a process group of its own, without input and output. Returns 0 on failure.
pid_t Start(const std::string& program, std::string task, std::string answer)
{
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::string name = program;
  char* arguments[] = { &name[0], &task[0], &answer[0], nullptr };
  pid_t process = 0;
  const int failure =
    posix_spawn(&process, program.c_str(), &files, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return failure == 0 ? process : 0;
}

// Ends the process and those that it started.
void Stop(pid_t process)
{
  kill(-process, SIGKILL);
  while (waitpid(process, nullptr, 0) < 0 && errno == EINTR)
  {
  }
}

// Waits for the process. Answered: it ended by itself.
ProcessEnd Follow(pid_t process, const MesherProcess& run)
{
  const auto begin = std::chrono::steady_clock::now();
  std::chrono::milliseconds pause(1);
  for (;;)
  {
    int status = 0;
    const pid_t ended = waitpid(process, &status, WNOHANG);
    // A host that ignores SIGCHLD gets no status: the answer then tells how the program ended.
    if (ended == process || (ended < 0 && errno != EINTR))
    {
      return ended == process && WIFSIGNALED(status) ? ProcessEnd::Crashed : ProcessEnd::Answered;
    }
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    const bool late = time.count() > run.TimeLimit;
    if (late || !run.GoesOn(time.count()))
    {
      Stop(process);
      return late ? ProcessEnd::TimedOut : ProcessEnd::Aborted;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(50));
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
ProcessEnd MesherProcess::Run(const MeshingTask& task, MeshingAnswer& answer) const
{
  const TemporaryFolder folder;
  const std::string taskFile = folder.File("task");
  const std::string answerFile = folder.File("answer");
  if (!folder.Exists() || !WriteMeshingTask(taskFile, task))
  {
    return ProcessEnd::NoFiles;
  }
  const pid_t process = Start(this->Program, taskFile, answerFile);
  if (process == 0)
  {
    return ProcessEnd::NotStarted;
  }
  const ProcessEnd end = Follow(process, *this);
  return end == ProcessEnd::Answered && !ReadMeshingAnswer(answerFile, answer)
    ? ProcessEnd::NoAnswer
    : end;
}

//------------------------------------------------------------------------------
std::string FindTetGenProgram()
{
  Dl_info library;
  if (!dladdr(reinterpret_cast<const void*>(&FindTetGenProgram), &library) || !library.dli_fname)
  {
    return {};
  }
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(library.dli_fname, error);
  if (error)
  {
    return {};
  }
  const std::filesystem::path program =
    file.parent_path() / MENISCUS_MESHER_FOLDER / "meniscus_tetgen";
  return std::filesystem::exists(program, error) ? program.lexically_normal().string()
                                                 : std::string();
}

} // namespace meniscus

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PovrayProcess.h"

#include "StrictImage.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace meniscus::test
{

namespace
{

bool WriteText(const std::string& path, const std::string& text)
{
  std::ofstream file(path);
  return static_cast<bool>((file << text).flush());
}

//------------------------------------------------------------------------------
/** The child's part: POV-Ray in a folder, with all its messages in a file. Never returns. */
[[noreturn]] void BecomeProgram(const std::string& program, const std::string& argument,
  const std::string& folder, const std::string& log)
{
  constexpr int notFound = 127; // as a shell says it
  const int output = open((folder + "/" + log).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (output >= 0 && dup2(output, STDOUT_FILENO) >= 0 && dup2(output, STDERR_FILENO) >= 0 &&
    chdir(folder.c_str()) == 0)
  {
    execlp(program.c_str(), program.c_str(), argument.c_str(), nullptr);
  }
  _exit(notFound);
}

//------------------------------------------------------------------------------
/** True if the program ran and ended with status 0. */
bool RunProgram(const std::string& program, const std::string& argument, const std::string& folder,
  const std::string& log)
{
  const pid_t child = fork();
  if (child == 0)
  {
    BecomeProgram(program, argument, folder, log);
  }
  int status = 0;
  pid_t ended = -1;
  do
  {
    ended = child > 0 ? waitpid(child, &status, 0) : -1;
  } while (ended < 0 && child > 0 && errno == EINTR);
  return ended == child && child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // anonymous namespace

//------------------------------------------------------------------------------
ByteImage PovrayProcess::Draw(const ComparisonScene& scene, const std::string& name, int pixels,
  const PictureWindow& window) const
{
  const std::string path = this->Folder + "/" + name;
  const std::string picture = path + "-povray.png";
  unlink(picture.c_str()); // so that an old picture is not taken for a new one
  if (!WriteText(path + ".pov", PovrayScene(scene, window)) ||
    !WriteText(path + ".ini", PovrayOptions(name, pixels)) ||
    !RunProgram(this->Program, name + ".ini", this->Folder, name + ".log"))
  {
    return ByteImage();
  }
  return ReadPng(picture);
}

} // namespace meniscus::test

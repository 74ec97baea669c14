// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Programs that crash, do not end or do not answer, in the place of TetGen's.
#include "Mesher/ClosedSurfaces.h"
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkTetrahedralizeSurface.h"

#include <chrono>
#include <filesystem>
#include <thread>

#ifdef __linux__
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace meniscus::test;

namespace
{

/** A shell script in the place of the mesher, and a folder for its temporary files. */
class MesherScripts : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    this->Folder = std::filesystem::path(MENISCUS_TEMPORARY_DIR) / ("Mesher" + name);
    std::filesystem::remove_all(this->Folder);
    std::filesystem::create_directories(this->Folder / "tmp");
    setenv("TMPDIR", (this->Folder / "tmp").c_str(), 1);
    this->Filter->SetInputData(MakeBox(1.0, 1.0, 1.0));
    this->Filter->SetMesherToTetGen();
  }

  void TearDown() override
  {
    // No file remains.
    EXPECT_TRUE(std::filesystem::is_empty(this->Folder / "tmp"));
    unsetenv("TMPDIR");
  }

  /** Runs the filter with a program of these commands and returns its messages. */
  std::string Run(const std::string& commands)
  {
    const std::filesystem::path program = this->Folder / "program";
    std::ofstream(program) << "#!/bin/sh\n" << commands << '\n';
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    this->Filter->SetMesherProgram(program.c_str());
    return this->Update();
  }

  std::string Update()
  {
    const auto messages = Observe(this->Filter);
    this->Filter->Modified(); // the program has changed, not its name
    this->Filter->Update();
    EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfCells(), 0);
    return messages->Text;
  }

  std::filesystem::path Folder;
  vtkNew<vtkTetrahedralizeSurface> Filter;
};

/** Asks the filter to stop at its first report of progress. */
void AbortAtOnce(vtkObject* caller, unsigned long, void*, void*)
{
  static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
}

} // anonymous namespace

//------------------------------------------------------------------------------
TEST_F(MesherScripts, ThatCrash)
{
  EXPECT_TRUE(HasText(this->Run("kill -SEGV $$"), "TetGen crashed"));
}

//------------------------------------------------------------------------------
// The time limit ends the program and those that it has started.
TEST_F(MesherScripts, ThatDoNotEnd)
{
  this->Filter->SetTimeLimit(0.3);
  const auto begin = std::chrono::steady_clock::now();
  const std::filesystem::path late = this->Folder / "late";
  const std::string text = this->Run("(sleep 3; touch '" + late.string() + "')");
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  EXPECT_TRUE(HasText(text, "ended after 0.3 s, the time limit"));
  EXPECT_LT(time.count(), 2.5);
  std::this_thread::sleep_for(std::chrono::seconds(4));
  EXPECT_FALSE(std::filesystem::exists(late));
}

//------------------------------------------------------------------------------
TEST_F(MesherScripts, ThatAreAborted)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(AbortAtOnce);
  this->Filter->AddObserver(vtkCommand::ProgressEvent, abort);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(this->Run("sleep 20"), "");
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(time.count(), 10.0);
}

//------------------------------------------------------------------------------
TEST_F(MesherScripts, ThatDoNotAnswer)
{
  for (const char* commands : { "exit 3", "exit 0", "echo nonsense > \"$2\"", ": > \"$2\"" })
  {
    const std::string text = this->Run(commands);
    EXPECT_TRUE(HasText(text, "ended without an answer")) << commands;
  }
}

//------------------------------------------------------------------------------
// TetGen's errors come as numbers in the answer.
TEST_F(MesherScripts, ThatGiveUp)
{
  const std::pair<const char*, const char*> ends[] = { { "\\001", "out of memory" },
    { "\\002", "gave up on this surface, with error 2" }, { "\\003", "crosses itself" },
    { "\\004", "too small" }, { "\\005", "too close" }, { "\\012", "with error 10" } };
  const std::string zeros = "\\000\\000\\000\\000\\000\\000\\000\\000";
  for (const auto& end : ends)
  {
    const std::string text = this->Run("printf 'MNS_ANS1" + std::string(end.first) +
      "\\000\\000\\000" + zeros + zeros + zeros + "' > \"$2\"");
    EXPECT_TRUE(HasText(text, end.second));
  }
}

//------------------------------------------------------------------------------
TEST_F(MesherScripts, ThatAreNotThere)
{
  this->Filter->SetMesherProgram("/no/such/program");
  EXPECT_TRUE(HasText(this->Update(), "could not be started: /no/such/program"));
  std::ofstream(this->Folder / "plain") << "text\n";
  this->Filter->SetMesherProgram((this->Folder / "plain").c_str());
  EXPECT_TRUE(HasText(this->Update(), "could not be started"));
}

//------------------------------------------------------------------------------
TEST_F(MesherScripts, WithoutPlaceForFiles)
{
  setenv("TMPDIR", (this->Folder / "missing").c_str(), 1);
  EXPECT_TRUE(HasText(this->Run("exit 0"), "could not be written"));
}

#if defined(__linux__) && defined(MENISCUS_TETGEN_PROGRAM)
//------------------------------------------------------------------------------
// A host starts TetGen's program, and is killed while the program writes to a pipe that is full.
TEST_F(MesherScripts, TetGenEndsWithItsHost)
{
  std::string program = MENISCUS_TETGEN_PROGRAM;
  if (!std::filesystem::exists(program))
  {
    GTEST_SKIP() << "not in the build tree";
  }
  std::string task = (this->Folder / "task").string();
  std::string answer = (this->Folder / "answer").string();
  this->Filter->SetMaximumVolume(1e-4); // an answer of more bytes than a pipe can hold
  this->Run("cp \"$1\" '" + task + "'");
  ASSERT_EQ(mkfifo(answer.c_str(), S_IRUSR | S_IWUSR), 0);
  char* arguments[] = { &program[0], &task[0], &answer[0], nullptr };
  const pid_t host = fork();
  ASSERT_GE(host, 0);
  if (host == 0)
  {
    pid_t process = 0;
    posix_spawn(&process, program.c_str(), nullptr, nullptr, arguments, environ);
    for (;;)
    {
      pause();
    }
  }
  // Succeeds as soon as the program opens its answer.
  const int pipe = open(answer.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(pipe, 0);
  kill(host, SIGKILL);
  waitpid(host, nullptr, 0);
  // No process writes any more when the program has ended.
  pollfd state{ pipe, 0, 0 };
  EXPECT_EQ(poll(&state, 1, 10000), 1) << "the program goes on";
  close(pipe);
}
#endif

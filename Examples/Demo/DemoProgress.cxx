// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DemoProgress.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace
{

constexpr int BarWidth = 30;

void OnProgress(vtkObject* caller, unsigned long, void* clientData, void*)
{
  const double progress = static_cast<vtkAlgorithm*>(caller)->GetProgress();
  if (progress < 1.0) // the last state is drawn once, after the update
  {
    ShowProgress(*static_cast<const std::string*>(clientData), progress);
  }
}

}

//------------------------------------------------------------------------------
void ShowProgress(const std::string& what, double progress)
{
  // A log keeps every state of the bar, so only the last one is printed.
  if (progress < 1.0 && !isatty(fileno(stderr)))
  {
    return;
  }
  const int full = static_cast<int>(BarWidth * std::min(std::max(progress, 0.0), 1.0));
  const std::string bar = std::string(full, '#') + std::string(BarWidth - full, '.');
  std::fprintf(stderr, "\r  %-38s [%s] %3d %%", what.c_str(), bar.c_str(),
    static_cast<int>(100.0 * progress + 0.5));
}

//------------------------------------------------------------------------------
void UpdateWithProgress(vtkAlgorithm* algorithm, const std::string& what)
{
  std::string label = what;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(OnProgress);
  observer->SetClientData(&label);
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ProgressEvent, observer);
  const double start = vtkTimerLog::GetUniversalTime();
  ShowProgress(what, 0.0);
  algorithm->Update();
  algorithm->RemoveObserver(tag);
  ShowProgress(what, 1.0);
  std::fprintf(stderr, "  %.2f s\n", vtkTimerLog::GetUniversalTime() - start);
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VTKTestBasics.h"

namespace meniscus::test
{

/**
 * Expects that an update that is aborted after this progress ends soon and without output; then
 * updates anew.
 */
template <typename Algorithm>
void UpdateWithAbort(const Algorithm& algorithm, double after)
{
  double progress[2] = { after, 0.0 };
  vtkNew<vtkCallbackCommand> abort;
  abort->SetClientData(progress);
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto* running = static_cast<vtkAlgorithm*>(caller);
      auto* known = static_cast<double*>(data);
      const double now = running->GetProgress();
      running->SetAbortExecute(now > known[0] ? 1 : running->GetAbortExecute());
      known[1] = now < 1.0 ? now : known[1]; // VTK 9.3 reports an end even so
    });
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ProgressEvent, abort);
  algorithm->Update();
  EXPECT_LT(progress[1], 0.9) << after;
  EXPECT_EQ(algorithm->GetOutput()->GetNumberOfPoints(), 0) << after;
  algorithm->RemoveObserver(tag);
  algorithm->SetAbortExecute(0);
  algorithm->Modified();
  algorithm->Update();
}

} // namespace meniscus::test

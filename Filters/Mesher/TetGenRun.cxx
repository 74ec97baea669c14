// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Mesher/TetGenRun.h"

#include "Filters/Mesher/MesherProcess.h"
#include "Filters/Mesher/SurfaceMessages.h"

#include "vtkAlgorithm.h"

#include <cmath>
#include <utility>

namespace meniscus
{

//------------------------------------------------------------------------------
std::string ChooseTetGenProgram(const char* set)
{
  return set && *set ? std::string(set) : FindTetGenProgram();
}

//------------------------------------------------------------------------------
bool RunTetGen(vtkAlgorithm* filter, const std::string& program, double timeLimit,
  const MeshingTask& task, TetrahedronCells& cells)
{
  MesherProcess process;
  process.Program = program;
  process.TimeLimit = timeLimit;
  // TetGen reports no progress: each tenth of the time limit shows half of the remainder as done.
  process.GoesOn = [filter, timeLimit](double seconds)
  {
    filter->UpdateProgress(1.0 - std::exp2(-10.0 * seconds / timeLimit));
    return !filter->GetAbortExecute();
  };
  MeshingAnswer answer;
  const ProcessEnd end = process.Run(task, answer);
  if (end == ProcessEnd::Aborted)
  {
    return false;
  }
  std::string fault = DescribeProcessEnd(end, process);
  if (fault.empty())
  {
    fault = DescribeMeshingEnd(answer.End);
  }
  if (!fault.empty())
  {
    vtkErrorWithObjectMacro(filter, << fault << " The output is empty.");
    return false;
  }
  cells = std::move(answer.Cells);
  return true;
}

} // namespace meniscus

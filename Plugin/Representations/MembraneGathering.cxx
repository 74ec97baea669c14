// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MembraneGathering.h"

#include "vtkAlgorithm.h"
#include "vtkAppendPolyData.h"
#include "vtkCleanPolyData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meniscus
{
namespace
{

using Pieces = std::vector<vtkSmartPointer<vtkPolyData>>;

/**
 * Rounding that may separate two equal numbers of this size: half a unit in the last place each.
 */
constexpr double Rounding = std::numeric_limits<float>::epsilon();

/** Adds the surfaces in the data object, without ghost cells. */
void AddPieces(vtkDataObject* data, Pieces& pieces)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      AddPieces(iterator->GetCurrentDataObject(), pieces);
    }
    return;
  }
  auto* surface = vtkPolyData::SafeDownCast(data);
  if (!surface || surface->GetNumberOfCells() == 0)
  {
    return;
  }
  vtkNew<vtkPolyData> piece;
  piece->ShallowCopy(surface);
  piece->RemoveGhostCells();
  if (piece->GetNumberOfCells() > 0)
  {
    pieces.emplace_back(piece);
  }
}

/** One surface of all pieces, joined where points coincide. */
vtkSmartPointer<vtkPolyData> Join(const Pieces& pieces)
{
  if (pieces.empty())
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  if (pieces.size() == 1)
  {
    return pieces.front();
  }
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* piece : pieces)
  {
    append->AddInputData(piece);
  }
  vtkNew<vtkCleanPolyData> sew;
  sew->SetInputConnection(append->GetOutputPort());
  sew->ToleranceIsAbsoluteOn();
  sew->SetAbsoluteTolerance(0.0);
  sew->ConvertLinesToPointsOff();
  sew->ConvertPolysToLinesOff();
  sew->ConvertStripsToPolysOff();
  sew->Update();
  return sew->GetOutput();
}

}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> GatherMembrane(vtkDataObject* local)
{
  Pieces pieces;
  AddPieces(local, pieces);
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || controller->GetNumberOfProcesses() == 1)
  {
    return Join(pieces);
  }
  // Blocks are joined locally first: ranks may have different numbers of them.
  std::vector<vtkSmartPointer<vtkDataObject>> all;
  if (!controller->AllGather(Join(pieces), all))
  {
    return nullptr;
  }
  pieces.clear();
  for (vtkDataObject* data : all)
  {
    AddPieces(data, pieces);
  }
  return Join(pieces);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkInformationVector> GatherMembranes(vtkInformationVector* port)
{
  auto gathered = vtkSmartPointer<vtkInformationVector>::New();
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    const vtkSmartPointer<vtkPolyData> membrane = GatherMembrane(vtkDataObject::GetData(port, i));
    if (!membrane)
    {
      return nullptr;
    }
    gathered->Append(WrapData(membrane)->GetInformationObject(0));
  }
  return gathered;
}

//------------------------------------------------------------------------------
bool IsPlaneAcrossAxis(vtkPolyData* surface)
{
  double bounds[6];
  surface->GetBounds(bounds);
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* range = bounds + 2 * axis;
    const double largest = std::max(std::fabs(range[0]), std::fabs(range[1]));
    if (range[1] - range[0] > Rounding * largest)
    {
      continue;
    }
    bool along = true;
    for (int other = 0; normals && other < 3; ++other)
    {
      const double* tilt = other == axis ? nullptr : normals->GetRange(other);
      along = along && (!tilt || std::max(-tilt[0], tilt[1]) <= Rounding);
    }
    if (along)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void AcceptComposite(vtkInformation* port)
{
  port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
}

//------------------------------------------------------------------------------
int MakeOutputLikeInput(vtkInformationVector* inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs);
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  if (!input)
  {
    return 0;
  }
  if (!output || !output->IsA(input->GetClassName()))
  {
    auto made = vtkSmartPointer<vtkDataObject>::Take(input->NewInstance());
    info->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
void AskForPiece(vtkInformationVector* membranes, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* output = outputs->GetInformationObject(0);
  for (int i = 0; i < membranes->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* info = membranes->GetInformationObject(i);
    info->CopyEntry(output, Pipeline::UPDATE_PIECE_NUMBER());
    info->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_PIECES());
  }
}

//------------------------------------------------------------------------------
void KeepOutputOfFirstRank(vtkInformationVector* outputs)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (controller && controller->GetLocalProcessId() > 0)
  {
    vtkDataObject::GetData(outputs)->Initialize();
  }
}

//------------------------------------------------------------------------------
bool RunBlocks(const char* type, vtkInformationVector** inputs, vtkInformationVector* outputs,
  vtkInformationVector* membranes,
  const std::function<int(vtkInformationVector**, vtkInformationVector*)>& run)
{
  const auto runBlock = [&](vtkDataObject* geometry, vtkDataObject* output)
  {
    const auto first = WrapData(geometry);
    vtkInformationVector* ports[] = { first, membranes };
    return run(ports, WrapData(output)) != 0;
  };
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    return runBlock(input, output);
  }
  auto* compositeOutput = vtkCompositeDataSet::SafeDownCast(output);
  compositeOutput->CopyStructure(composite);
  auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  bool succeeded = true;
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    vtkDataObject* geometry = block->GetCurrentDataObject();
    if (geometry && geometry->IsA(type))
    {
      const auto made = vtkSmartPointer<vtkDataObject>::Take(geometry->NewInstance());
      succeeded = runBlock(geometry, made) && succeeded;
      compositeOutput->SetDataSet(block, made);
    }
  }
  return succeeded;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkInformationVector> WrapData(vtkDataObject* data)
{
  auto vector = vtkSmartPointer<vtkInformationVector>::New();
  vtkNew<vtkInformation> info;
  info->Set(vtkDataObject::DATA_OBJECT(), data);
  vector->Append(info);
  return vector;
}

}

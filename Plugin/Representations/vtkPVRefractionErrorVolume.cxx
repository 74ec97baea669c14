// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVRefractionErrorVolume.h"

#include "MembraneGathering.h"

#include "vtkCommunicator.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkPVRefractionErrorVolume);
meniscusInterfaceTableMacro(vtkPVRefractionErrorVolume);

namespace
{

using Extent = std::array<int, 6>;

//------------------------------------------------------------------------------
bool Contains(const Extent& extent, int i, int j, int k)
{
  return extent[0] <= i && i <= extent[1] && extent[2] <= j && j <= extent[3] && extent[4] <= k &&
    k <= extent[5];
}

//------------------------------------------------------------------------------
/**
 * Errors measured here, without those of samples that an earlier rank also has: the parts of
 * neighbours share a layer.
 */
std::vector<double> CollectOwnErrors(vtkImageData* output, const std::vector<Extent>& earlier)
{
  std::vector<double> errors;
  auto* all = vtkDoubleArray::SafeDownCast(output->GetPointData()->GetArray("RefractionError"));
  if (!all)
  {
    return errors;
  }
  const int* extent = output->GetExtent();
  vtkIdType sample = 0;
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i, ++sample)
      {
        const double error = all->GetValue(sample);
        const bool own = std::none_of(earlier.begin(), earlier.end(),
          [i, j, k](const Extent& other) { return Contains(other, i, j, k); });
        if (own && !std::isnan(error)) // NaN: not measured
        {
          errors.push_back(error);
        }
      }
    }
  }
  return errors;
}

}

//------------------------------------------------------------------------------
vtkPVRefractionErrorVolume::vtkPVRefractionErrorVolume()
{
  this->SetInterfaces(this->Table.GetInterfaces());
}

//------------------------------------------------------------------------------
vtkPVRefractionErrorVolume::~vtkPVRefractionErrorVolume() = default;

//------------------------------------------------------------------------------
void vtkPVRefractionErrorVolume::SetExactMembrane(vtkImplicitFunction* function)
{
  this->Table.SetExactSurface(function);
}

//------------------------------------------------------------------------------
int vtkPVRefractionErrorVolume::FillInputPortInformation(int port, vtkInformation* info)
{
  const int filled = this->Superclass::FillInputPortInformation(port, info);
  meniscus::AcceptComposite(info);
  return filled;
}

//------------------------------------------------------------------------------
int vtkPVRefractionErrorVolume::RequestUpdateExtent(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Each rank requests its own piece of the membranes, whatever part of the box it measures.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* output = outputs->GetInformationObject(0);
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(i);
      info->CopyEntry(output, Pipeline::UPDATE_PIECE_NUMBER());
      info->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_PIECES());
      info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      info->Remove(Pipeline::UPDATE_EXTENT());
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVRefractionErrorVolume::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkSmartPointer<vtkInformationVector> gathered[2];
  for (int port = 0; port < 2; ++port)
  {
    std::string fault;
    gathered[port] = this->Table.GatherSurfaces(inputs[port], port == 1, fault);
    if (!gathered[port])
    {
      vtkErrorMacro(<< fault << "; the output is empty.");
      return 0;
    }
  }
  vtkInformationVector* ports[] = { gathered[0], gathered[1] };
  const int measured = this->Superclass::RequestData(request, ports, outputs);
  this->ReduceStatistics(vtkImageData::GetData(outputs)); // also after an abort of this rank alone
  return measured;
}

//------------------------------------------------------------------------------
// Computes the statistics in two passes, like those of one rank, so that nothing cancels. Must be
// called by all ranks alike.
void vtkPVRefractionErrorVolume::ReduceStatistics(vtkImageData* output)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const int ranks = controller ? controller->GetNumberOfProcesses() : 1;
  if (ranks == 1)
  {
    return;
  }
  Extent own;
  output->GetExtent(own.data());
  std::vector<Extent> extents(static_cast<std::size_t>(ranks));
  controller->AllGather(own.data(), extents.front().data(), 6);
  extents.resize(static_cast<std::size_t>(controller->GetLocalProcessId()));
  const std::vector<double> errors = CollectOwnErrors(output, extents);

  double local[2] = { 0.0, static_cast<double>(errors.size()) };
  double largestHere = 0.0;
  for (const double error : errors)
  {
    local[0] += error;
    largestHere = std::max(largestHere, error);
  }
  double sums[2] = { 0.0, 0.0 };
  double largest = 0.0;
  controller->AllReduce(local, sums, 2, vtkCommunicator::SUM_OP);
  controller->AllReduce(&largestHere, &largest, 1, vtkCommunicator::MAX_OP);
  const double mean = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;

  double squaresHere = 0.0;
  for (const double error : errors)
  {
    squaresHere += (error - mean) * (error - mean);
  }
  double squares = 0.0;
  controller->AllReduce(&squaresHere, &squares, 1, vtkCommunicator::SUM_OP);
  const double deviation = sums[1] > 0.0 ? std::sqrt(squares / sums[1]) : 0.0;
  if (output->GetFieldData()->HasArray("MeanError"))
  {
    this->SetStatistics(output, mean, deviation, largest, static_cast<vtkTypeInt64>(sums[1]));
  }
}

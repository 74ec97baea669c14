// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/ImagePlace.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace meniscus
{

//------------------------------------------------------------------------------
ImagePlace PlaceOf(const ParallelRectangle& rectangle, const int size[2])
{
  const glm::dvec3 steps[2] = { rectangle.Axis1 / static_cast<double>(size[0]),
    rectangle.Axis2 / static_cast<double>(size[1]) };
  const glm::dvec3 columns[3] = { glm::normalize(steps[0]), glm::normalize(steps[1]),
    -rectangle.GetDirection() };
  ImagePlace place;
  for (int axis = 0; axis < 3; ++axis)
  {
    place.Origin[axis] = rectangle.Origin[axis] + 0.5 * (steps[0][axis] + steps[1][axis]);
    place.Spacing[axis] = axis < 2 ? glm::length(steps[axis]) : 1.0;
    for (int column = 0; column < 3; ++column)
    {
      place.Direction[3 * axis + column] = columns[column][axis];
    }
  }
  return place;
}

//------------------------------------------------------------------------------
std::string DescribeBadSize(const int size[2])
{
  return size[0] > 0 && size[1] > 0 ? std::string()
                                    : "ImageSize must be at least 1 by 1, not " +
      std::to_string(size[0]) + " by " + std::to_string(size[1]);
}

//------------------------------------------------------------------------------
void AnnounceImage(vtkInformation* output, const int size[2])
{
  const int extent[6] = { 0, std::max(size[0], 1) - 1, 0, std::max(size[1], 1) - 1, 0, 0 };
  output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  vtkDataObject::SetPointDataActiveScalarInfo(output, VTK_FLOAT, -1);
}

//------------------------------------------------------------------------------
void RequestWholeInputs(vtkInformationVector** inputs, int ports)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < ports; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(i);
      info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      // The executive has copied the extent of the output.
      info->Remove(Pipeline::UPDATE_EXTENT());
      if (info->Has(Pipeline::WHOLE_EXTENT()))
      {
        info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
      }
    }
  }
}

}

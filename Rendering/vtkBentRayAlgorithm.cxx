// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBentRayAlgorithm.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Integral/BentMedium.h"
#include "Rendering/Integral/BentRayView.h"
#include "Rendering/Integral/ImagePlace.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <string>

namespace
{

/** Rows of the image that are cast between two reports of the progress. */
constexpr std::size_t RowsPerReport = 32;
/** Rows of a block of rays. */
constexpr std::size_t RowsPerBlock = 8;

}

//------------------------------------------------------------------------------
vtkBentRayAlgorithm::vtkBentRayAlgorithm()
  : View(new meniscus::BentRayView)
{
}

//------------------------------------------------------------------------------
vtkBentRayAlgorithm::~vtkBentRayAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkBentRayAlgorithm::SetCamera(vtkCamera* camera)
{
  if (this->Camera != camera)
  {
    this->Camera = camera;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkCamera* vtkBentRayAlgorithm::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkBentRayAlgorithm::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Camera ? std::max(time, this->Camera->GetMTime()) : time;
}

//------------------------------------------------------------------------------
int vtkBentRayAlgorithm::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputs), vtkInformationVector* outputs)
{
  // An error in the size is reported in RequestData, when there is an output to empty.
  const int extent[6] = { 0, std::max(this->ImageSize[0], 1) - 1, 0,
    std::max(this->ImageSize[1], 1) - 1, 0, 0 };
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, -1);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkBentRayAlgorithm::UpdateView(vtkDataObject* input, double share)
{
  if (this->ImageSize[0] < 1 || this->ImageSize[1] < 1)
  {
    return this->TellError("ImageSize must be at least 1 by 1, not " +
      std::to_string(this->ImageSize[0]) + " by " + std::to_string(this->ImageSize[1]));
  }
  if (!this->UpdateMedium(input, share))
  {
    return false;
  }
  const meniscus::TetrahedralMesh& mesh = this->Medium->GetMesh();
  if (this->Camera)
  {
    return this->TellError(
      meniscus::ComputeCameraView(this->Camera, this->ImageSize, mesh, this->View->Rays));
  }
  meniscus::ParallelRectangle& rectangle = this->View->Rectangle;
  std::string error = meniscus::FitRectangle(mesh.GetCenter(), mesh.GetHalfSize(),
    glm::make_vec3(this->Direction), glm::make_vec3(this->ViewUp), this->ImageSize, rectangle);
  error = error.empty() ? meniscus::DescribeFault(rectangle) : error;
  error = error.empty()
    ? meniscus::ComputeParallelView(rectangle, this->ImageSize, mesh, {}, this->View->Rays)
    : error;
  return this->TellError(error);
}

//------------------------------------------------------------------------------
bool vtkBentRayAlgorithm::RunRows(
  const std::function<void(std::size_t, std::size_t)>& body, double from, double share)
{
  const auto height = static_cast<std::size_t>(this->ImageSize[1]);
  for (std::size_t first = 0; first < height; first += RowsPerReport)
  {
    const std::size_t rows = std::min(RowsPerReport, height - first);
    meniscus::ThreadedLoop((rows + RowsPerBlock - 1) / RowsPerBlock,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t block = begin; block < end; ++block)
        {
          const std::size_t row = first + block * RowsPerBlock;
          body(row, std::min(row + RowsPerBlock, first + rows));
        }
      });
    this->UpdateProgress(
      from + share * static_cast<double>(first + rows) / static_cast<double>(height));
    if (this->GetAbortExecute())
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkBentRayAlgorithm::PlaceImage(vtkImageData* image)
{
  image->SetExtent(0, this->ImageSize[0] - 1, 0, this->ImageSize[1] - 1, 0, 0);
  const meniscus::ImagePlace place =
    this->Camera ? meniscus::ImagePlace() : PlaceOf(this->View->Rectangle, this->ImageSize);
  image->SetOrigin(place.Origin);
  image->SetSpacing(place.Spacing);
  image->SetDirectionMatrix(place.Direction);
}

//------------------------------------------------------------------------------
void vtkBentRayAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BendRays: " << this->BendRays << "\n";
  os << indent << "Direction: (" << this->Direction[0] << ", " << this->Direction[1] << ", "
     << this->Direction[2] << ")\n";
  os << indent << "ViewUp: (" << this->ViewUp[0] << ", " << this->ViewUp[1] << ", "
     << this->ViewUp[2] << ")\n";
  os << indent << "Camera: " << this->Camera << "\n";
  os << indent << "ImageSize: (" << this->ImageSize[0] << ", " << this->ImageSize[1] << ")\n";
}

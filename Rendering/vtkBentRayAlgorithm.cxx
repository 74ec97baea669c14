// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBentRayAlgorithm.h"

#include "Filters/Common/Accessors.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Integral/BentMedium.h"
#include "Rendering/Integral/BentRayView.h"
#include "Rendering/Integral/ImagePlace.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSMPTools.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstddef>
#include <string>

namespace
{

/** Rows of a block of rays. Higher blocks share fewer cells with the next one. */
constexpr std::size_t RowsPerBlock = 16;
/** Blocks between two reports of the progress, for each thread: threads wait for each other then.
 */
constexpr std::size_t BlocksPerThread = 4;

}

meniscusObjectMacro(vtkBentRayAlgorithm, Camera, vtkCamera, Camera);

//------------------------------------------------------------------------------
vtkBentRayAlgorithm::vtkBentRayAlgorithm()
  : View(new meniscus::BentRayView)
{
}

//------------------------------------------------------------------------------
vtkBentRayAlgorithm::~vtkBentRayAlgorithm() = default;

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
  meniscus::AnnounceImage(outputs->GetInformationObject(0), this->ImageSize);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkBentRayAlgorithm::UpdateView(vtkDataObject* input, double share)
{
  if (!this->TellError(meniscus::DescribeBadSize(this->ImageSize)) ||
    !this->UpdateMedium(input, share))
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
  const auto threads =
    static_cast<std::size_t>(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()));
  const std::size_t rowsPerReport = RowsPerBlock * BlocksPerThread * threads;
  for (std::size_t first = 0; first < height; first += rowsPerReport)
  {
    const std::size_t rows = std::min(rowsPerReport, height - first);
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

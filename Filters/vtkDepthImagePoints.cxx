// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthImagePoints.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace
{

/** Rays through the pixels of an image. */
class PixelRays
{
public:
  PixelRays(vtkCamera* camera, int width, int height)
    : Width(width)
    , Height(height)
  {
    camera->GetPosition(&this->Eye.x);
    camera->GetDirectionOfProjection(&this->Axis.x);
    const double aspect = static_cast<double>(width) / height;
    this->ToWorld->DeepCopy(camera->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0));
    // Coordinates x, y and w of the view give the direction: unlike z they do not depend on the
    // clipping range, and so have no rounding error of its ratio.
    constexpr int rows[3] = { 0, 1, 3 };
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        this->ToDirection[i][j] = this->ToWorld->GetElement(rows[i], j);
      }
    }
    vtkMath::Invert3x3(this->ToDirection, this->ToDirection);
    this->ToWorld->Invert();
  }

  /** The place of a pixel at a value of the depth buffer. */
  glm::dvec3 Unproject(int column, int row, double depth) const
  {
    const glm::dvec2 pixel = this->GetViewCoordinates(column, row);
    const double view[4] = { pixel.x, pixel.y, 2.0 * depth - 1.0, 1.0 };
    double world[4];
    this->ToWorld->MultiplyPoint(view, world);
    return glm::dvec3(world[0], world[1], world[2]) / world[3];
  }

  /** Unit direction from the eye through a pixel. */
  glm::dvec3 GetDirection(int column, int row) const
  {
    const glm::dvec2 pixel = this->GetViewCoordinates(column, row);
    const double view[3] = { pixel.x, pixel.y, 1.0 };
    glm::dvec3 direction;
    vtkMath::Multiply3x3(this->ToDirection, view, &direction.x);
    return glm::normalize(direction);
  }

  /** The place of a pixel at a depth of a type of vtkDepthImagePoints. */
  glm::dvec3 GetPlace(int column, int row, double depth, int type) const
  {
    if (type == vtkDepthImagePoints::DEPTH_BUFFER)
    {
      return this->Unproject(column, row, depth);
    }
    const glm::dvec3 direction = this->GetDirection(column, row);
    const double range =
      type == vtkDepthImagePoints::RANGE ? depth : depth / glm::dot(direction, this->Axis);
    return this->Eye + range * direction;
  }

private:
  /** From -1 to 1 across the view. */
  glm::dvec2 GetViewCoordinates(int column, int row) const
  {
    return { 2.0 * (column + 0.5) / this->Width - 1.0, 2.0 * (row + 0.5) / this->Height - 1.0 };
  }

  int Width;
  int Height;
  glm::dvec3 Eye;
  glm::dvec3 Axis;
  vtkNew<vtkMatrix4x4> ToWorld;
  double ToDirection[3][3];
};

}

vtkStandardNewMacro(vtkDepthImagePoints);
meniscusSetClampMacro(vtkDepthImagePoints, DepthType, int, DEPTH_BUFFER, RANGE);
meniscusObjectMacro(vtkDepthImagePoints, Camera, vtkCamera, Camera);

//------------------------------------------------------------------------------
vtkDepthImagePoints::vtkDepthImagePoints()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkDepthImagePoints::~vtkDepthImagePoints() = default;

//------------------------------------------------------------------------------
vtkMTimeType vtkDepthImagePoints::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Camera ? std::max(own, this->Camera->GetMTime()) : own;
}

//------------------------------------------------------------------------------
int vtkDepthImagePoints::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
/** Text of the error for an input that cannot be used; null if it can. */
const char* vtkDepthImagePoints::FindFault(vtkImageData* image, vtkDataArray* depths) const
{
  if (!this->Camera || this->Camera->GetParallelProjection())
  {
    return "There is no camera with a perspective projection";
  }
  if (!image || image->GetDimensions()[2] != 1)
  {
    return "The input is not an image of one slice";
  }
  return depths && depths->GetNumberOfComponents() == 1
    ? nullptr
    : "The image has no point array of depths with one component";
}

//------------------------------------------------------------------------------
int vtkDepthImagePoints::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkImageData* image = vtkImageData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  vtkDataArray* depths = this->GetInputArrayToProcess(0, inputs);
  const char* fault = this->FindFault(image, depths);
  if (fault)
  {
    vtkErrorMacro(<< fault << "; the output is empty.");
    return 0;
  }
  int size[3];
  image->GetDimensions(size);
  const PixelRays rays(this->Camera, size[0], size[1]);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> pixels;
  pixels->SetName("PixelId");
  const double most = this->DepthType == DEPTH_BUFFER ? 1.0 : VTK_DOUBLE_MAX;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double depth = depths->GetTuple1(i);
    // Written so that a NaN fails.
    if (depth > 0.0 && depth < most)
    {
      const glm::dvec3 place = rays.GetPlace(
        static_cast<int>(i % size[0]), static_cast<int>(i / size[0]), depth, this->DepthType);
      points->InsertNextPoint(&place.x);
      pixels->InsertNextValue(i);
    }
  }
  vtkNew<vtkCellArray> vertices;
  vtkPointData* arrays = output->GetPointData();
  arrays->CopyAllocate(image->GetPointData(), points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    arrays->CopyData(image->GetPointData(), pixels->GetValue(i), i);
    vertices->InsertNextCell(1, &i);
  }
  output->SetPoints(points);
  output->SetVerts(vertices);
  arrays->AddArray(pixels);
  return 1;
}

//------------------------------------------------------------------------------
void vtkDepthImagePoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DepthType: " << this->DepthType << "\n";
  os << indent << "Camera: " << this->Camera.Get() << "\n";
}

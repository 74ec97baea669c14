// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackPicture.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRefractedGeometryFilter> StackPicture::MakeFilter(
  vtkPolyData* object, bool all) const
{
  auto filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  const glm::dvec3& eye = this->Camera.GetEye();
  filter->SetInputData(object);
  filter->SetMembraneModelToCurved();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetEyePosition(eye.x, eye.y, eye.z);
  filter->SetImages(
    all ? vtkRefractedGeometryFilter::ALL_IMAGES : vtkRefractedGeometryFilter::FIRST_IMAGE);
  filter->SetAngularTolerance(this->Tolerance);
  this->SetInterfaces(filter.Get());
  return filter;
}

//------------------------------------------------------------------------------
Outline MakeSquareOutline(double side)
{
  return [side](const glm::dvec3& point)
  { return std::max(std::fabs(point.x), std::fabs(point.z)) <= 0.5 * side; };
}

//------------------------------------------------------------------------------
Outline MakeRoundOutline(double radius)
{
  return [radius](const glm::dvec3& point) { return std::hypot(point.x, point.z) <= radius; };
}

//------------------------------------------------------------------------------
std::optional<reference::ExactPath> TraceWithin(
  const std::vector<reference::ExactSurface>& surfaces, const Outline& outline,
  const glm::dvec3& eye, const glm::dvec3& direction)
{
  auto path = reference::TraceExactly(surfaces, eye, direction);
  if (path && !std::all_of(path->Points.begin(), path->Points.end(), outline))
  {
    return std::nullopt;
  }
  return path;
}

//------------------------------------------------------------------------------
RayTracer MakeExactRays(const std::vector<reference::ExactSurface>& surfaces, const glm::dvec3& eye,
  const Outline& outline)
{
  return [surfaces, eye, outline](const glm::dvec3& direction) -> std::optional<LastLeg>
  {
    const auto path = TraceWithin(surfaces, outline, eye, direction);
    return path ? std::optional<LastLeg>({ path->Points.back(), path->Directions.back() })
                : std::nullopt;
  };
}

//------------------------------------------------------------------------------
void ExpectSameView(ComparisonSheet& sheet, int column, const StackPicture& picture,
  vtkPolyData* object, const PlacePicture& traced, const PlaceColour& colour)
{
  const auto filter = picture.MakeFilter(object, true);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors, 0) << messages->Text;
  const PlacePicture drawn = DrawPlaces(filter->GetOutput(), picture.Camera);
  const PlaceComparison compared =
    AddComparison(sheet, column, picture.Name, picture.Camera, drawn, traced, colour);
  const int pixels = picture.Camera.GetPixels();
  EXPECT_GT(compared.Covered, pixels * pixels / 20) << picture.Name;
  EXPECT_LE(compared.Coverage + compared.Place, picture.Differing * compared.Covered)
    << picture.Name;
}

}

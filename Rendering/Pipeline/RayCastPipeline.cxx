// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Pipeline/RayCastPipeline.h"

#include "Rendering/Common/Matrices.h"
#include "Volume/Rays/ClippingPlanes.h"
#include "Volume/Rays/MeshPixels.h"
#include "Volume/Rays/RayFrame.h"

#include "vtkCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

/**
 * Frame with one ray per pixel for one of the several rays of a pixel.
 * @param number of the ray, row by row; ray 0 of 1 is at the centre.
 */
RayCastFrame FrameOfRay(const RayCastFrame& frame, int number)
{
  RayCastFrame ofRay = frame;
  const int across = frame.Output.RaysAcross;
  const glm::dvec2 place(number % across, number / across);
  ofRay.Rays = Shifted(frame.Rays, (place + 0.5) / static_cast<double>(across) - 0.5);
  for (RayClippingPlane& plane : ofRay.Optics.ClippingPlanes)
  {
    plane = ForRays(plane, ofRay.Rays);
  }
  ofRay.Output.RaysAcross = 1;
  return ofRay;
}

/**
 * A projection, with the rows of the last one that the rays depend on if these differ by rounding
 * only. VTK computes them from the near plane, by less than 8 roundings of numbers of the order of
 * the row or of the homogeneous coordinate. Rays differ by less than 2^-48 of the image.
 */
glm::dmat4 KeepLines(const glm::dmat4& projection, const glm::dmat4& last)
{
  glm::dmat4 kept = last;
  for (int column = 0; column < 4; ++column)
  {
    const glm::dvec4& now = projection[column];
    for (const int row : { 0, 1, 3 })
    {
      const double size = std::max(std::abs(now[row]), std::abs(now[3]));
      const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * size;
      if (!(std::abs(now[row] - last[column][row]) <= rounding))
      {
        return projection;
      }
    }
    kept[column][2] = now[2];
  }
  return kept;
}

}

//------------------------------------------------------------------------------
std::string RayCastPipeline::SetWindow(vtkOpenGLRenderWindow* window)
{
  if (window != this->Presenter.GetWindow())
  {
    this->ReleaseGraphicsResources(nullptr);
  }
  return this->Presenter.SetWindow(window);
}

//------------------------------------------------------------------------------
void RayCastPipeline::UpdateGradients(const InputBlocks& parts, const RayCastOptics& optics)
{
  if (optics.VertexGradients)
  {
    this->VertexGradients.Update(this->Input, parts);
  }
  else if (optics.UsesCellGradients())
  {
    this->CellGradients.Update(this->Input, parts);
  }
}

//------------------------------------------------------------------------------
RayCastBackendChoice RayCastPipeline::ChooseBackend(
  const RayCastFrame& frame, const RayCastBackendWish& wish)
{
  const RayCastRequest request(*this, frame, this->Presenter.GetWindow());
  return this->Backends.Choose(request, wish);
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::Draw(RayCastFrame frame, RayCastBackend& backend)
{
  frame.Refracting.Met = frame.Refracting.Wanted && this->Trace(FrameOfRay(frame, 0));
  const std::string mismatch = this->Membrane.DescribeMismatch();
  if (!mismatch.empty())
  {
    return mismatch;
  }
  if (!frame.Refracting.Met && frame.Refracting.Part == MembranePart::Behind)
  {
    this->ClearStatistics();
    return std::string();
  }
  frame.Output.Meeting = this->FindMeeting(frame);
  const RayCastRequest request(*this, frame, this->Presenter.GetWindow());
  std::string error = backend.Update(request);
  if (error.empty())
  {
    ImageSource source{ &backend, frame, this->ListWanted(frame) };
    const RayFrame before = this->Shown.Frame.Rays;
    const bool repeated = this->IsRepeated(source);
    this->Shown = ImageSource();
    error =
      this->Presenter.Present(frame, repeated ? &before : nullptr, this->View == frame.ModelToClip,
        [this, &frame, &backend, &request](RayCastTarget& target)
        {
          this->Whole = target.GetDepthsOfImage() == nullptr;
          if (frame.Output.RaysAcross > 1 && !backend.CastsSeveralRays(request))
          {
            return this->CastMean(frame, backend);
          }
          std::string failure = backend.Cast(request, target);
          this->Casts += this->Presenter.IsFinished() ? 1 : 0;
          return failure;
        });
    // Refracted rays may have been traced while the image was made.
    source.Tables = this->ListWanted(frame);
    this->Shown = error.empty() ? std::move(source) : ImageSource();
    if (this->Presenter.IsFinished())
    {
      const bool whole = frame.Refracting.Part == MembranePart::Whole;
      this->View = whole ? std::make_optional(frame.ModelToClip) : std::nullopt;
    }
  }
  this->Active = error.empty() ? &backend : this->Active;
  return error;
}

//------------------------------------------------------------------------------
/** Refracted rays may meet the mesh anywhere. */
RayCastImageBox RayCastPipeline::FindMeeting(const RayCastFrame& frame) const
{
  const int(&size)[2] = frame.Output.ImageSize;
  if (frame.Refracting.Wanted)
  {
    return { 0, size[0], 0, size[1] };
  }
  const ProjectedFaces::PixelBox box =
    FindMeshPixels(frame.Rays, size[0], size[1], this->Input.GetMesh());
  return { box.Left, box.Right, box.Bottom, box.Top };
}

//------------------------------------------------------------------------------
/** Casts an image for each of the rays of a pixel; their mean is the image. */
std::string RayCastPipeline::CastMean(const RayCastFrame& frame, RayCastBackend& backend)
{
  const int count = frame.Output.RaysAcross * frame.Output.RaysAcross;
  return this->Presenter.MakeMean(count,
    [this, &frame, &backend, count](int i, RayCastTarget& target)
    {
      // The last one is traced first in the next frame: its refracted rays are still there.
      RayCastFrame ofRay = FrameOfRay(frame, count - 1 - i);
      ofRay.Refracting.Met = ofRay.Refracting.Wanted && this->Trace(ofRay);
      const RayCastRequest request(*this, ofRay, this->Presenter.GetWindow());
      const std::string error = backend.Update(request);
      ++this->Casts;
      return error.empty() ? backend.Cast(request, target) : error;
    });
}

//------------------------------------------------------------------------------
/** True if the image that the presenter holds was made of the same things, but for the depths. */
bool RayCastPipeline::IsRepeated(const ImageSource& source) const
{
  return source.Backend == this->Shown.Backend && source.Backend->IsRepeatable() &&
    source.Tables == this->Shown.Tables && HaveSameImage(source.Frame, this->Shown.Frame);
}

//------------------------------------------------------------------------------
/** Traces the rays to the membrane. Returns whether one of them meets it. */
bool RayCastPipeline::Trace(const RayCastFrame& frame)
{
  const RayCastRefraction& refracting = frame.Refracting;
  const int(&size)[2] = frame.Output.ImageSize;
  RefractedRayStack::View view;
  view.Frame = frame.Rays;
  view.Width = size[0];
  view.Height = size[1];
  view.Center = refracting.Center;
  view.EyeDepth = refracting.EyeDepth;
  return this->Membrane.Trace(view, this->Input);
}

//------------------------------------------------------------------------------
RayCastStatistics RayCastPipeline::GetStatistics() const
{
  return this->Active ? this->Active->GetStatistics() : RayCastStatistics();
}

//------------------------------------------------------------------------------
std::int64_t RayCastPipeline::CountOverlaps() const
{
  return this->Active && this->Active->CountsOverlaps() ? this->Active->GetStatistics().Overlaps
                                                        : 0;
}

//------------------------------------------------------------------------------
double RayCastPipeline::GetShareOfCastRays() const
{
  if (!this->Active || !this->Active->CountsOverlaps())
  {
    return 1.0;
  }
  const RayCastStatistics sums = this->Active->GetStatistics();
  const auto rays = static_cast<double>(std::max<std::int64_t>(sums.Rays, 1));
  // At least a ray of 4 x 4 is cast, but is no ray that entered the mesh if it is hidden.
  return std::max(1.0 - static_cast<double>(sums.Interpolated) / rays, 1.0 / 16.0);
}

//------------------------------------------------------------------------------
void RayCastPipeline::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Shown = ImageSource();
  this->View.reset();
  this->Projection = glm::dmat4(0.0);
  this->Backends.ReleaseGraphicsResources(window);
  this->Presenter.Release(window);
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::ComputeFrame(
  vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], ViewContext& place)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  RayFrameInput input;
  input.ModelToWorld = ToGlm(volume->GetMatrix());
  input.WorldToView = ToGlm(camera->GetModelViewTransformMatrix());
  this->Projection = KeepLines(
    ToGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0)),
    this->Projection);
  place.ViewToClip = input.ViewToClip = this->Projection;
  input.ImageSize = glm::dvec2(imageSize[0], imageSize[1]);
  return this->PlaceIn(input, place);
}

//------------------------------------------------------------------------------
std::string RayCastPipeline::ComputeWorldFrame(vtkVolume* volume, ViewContext& place) const
{
  RayFrameInput input;
  input.ModelToWorld = ToGlm(volume->GetMatrix());
  const std::string error = this->PlaceIn(input, place);
  // It has no image: its frame is the same wherever the volume is.
  place.Frame.Origin = AffinePixelMap();
  place.Frame.Slope = AffinePixelMap();
  place.Frame.NearDepth = 0.0;
  place.Frame.FarDepth = RayFrame::FarthestDepth;
  place.Frame.DepthNumerator = glm::dvec2(0.0);
  place.Frame.DepthDenominator = glm::dvec2(1.0);
  return error;
}

//------------------------------------------------------------------------------
/** Adds the mesh to the input and computes the frame. */
std::string RayCastPipeline::PlaceIn(RayFrameInput& input, ViewContext& place) const
{
  input.Center = this->Input.GetMesh().GetCenter();
  input.Radius = this->Input.GetMesh().GetRadius();
  input.SmallestCell = this->Input.GetMesh().GetSmallestCell();
  input.HalfSize = this->Input.GetMesh().GetHalfSize() / input.Radius;
  place.CenterInWorld = glm::dvec3(input.ModelToWorld * glm::dvec4(input.Center, 1.0));
  place.WorldToView = input.WorldToView;
  place.GradientScale = this->Input.GetNormalization().GradientScale;
  switch (ComputeRayFrame(input, place.Frame))
  {
    case RayFrameStatus::Ok:
      return std::string();
    case RayFrameStatus::Singular:
      return HasInverse(input.ModelToWorld)
        ? "the matrix of the camera is singular or not finite"
        : "the matrix of the volume is singular, as with a scale of 0, or not finite";
    default:
      return "the camera's projection is not that of a plane image";
  }
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/RayPicker.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Integral/TilePixels.h"

#include "vtkSMPThreadLocal.h"
#include "vtkType.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace meniscus
{
namespace
{

/** Reduces the rays and clipping planes of a frame, affine functions of the pixel, to one pixel. */
void CropToPixel(const PickedPixel& pixel, RayCastFrame& frame)
{
  const int(&size)[2] = frame.Output.ImageSize;
  const double column = pixel.Column + 0.5 - 0.5 * size[0];
  const double row = pixel.Row + 0.5 - 0.5 * size[1];
  frame.Rays.Origin.Base = frame.Rays.Origin.At(column, row);
  frame.Rays.Slope.Base = frame.Rays.Slope.At(column, row);
  const glm::dvec3 place(1.0, column, row);
  for (RayClippingPlane& plane : frame.Optics.ClippingPlanes)
  {
    plane.Constant.x = glm::dot(plane.Constant, place);
    plane.PerDepth.x = glm::dot(plane.PerDepth, place);
  }
}

/** Window depth of a depth of the frame: the inverse of RayFrame::DepthAt(). */
float WindowDepthOf(const RayFrame& frame, double depth)
{
  // The window depth is the share of the far plane.
  const glm::dvec2 distance = depth * frame.DepthDenominator - frame.DepthNumerator;
  const double share = distance.y / (distance.y - distance.x);
  return static_cast<float>(std::clamp(share, 0.0, 1.0));
}

}

//------------------------------------------------------------------------------
/** Makes the scene of events of an image with the rays of a frame. */
std::string RayPicker::MakeScene(RayCastTables& tables, RayCastFrame& frame, const int (&size)[2],
  double opacity, TileCaster::Scene& scene)
{
  frame.Refracting.Part = MembranePart::Whole;
  frame.Refracting.Met = false;
  // Events depend on the exact functions.
  frame.Optics.PreIntegrated = false;
  this->Scenes.UpdateProperty(tables.Property);
  scene = this->Scenes.Make(tables, frame, size[0], size[1]);
  if (this->Membrane.GetNumberOfInterfaces() > 0)
  {
    RefractedRayStack::View view;
    view.Frame = frame.Rays;
    view.Width = size[0];
    view.Height = size[1];
    view.Center = frame.Refracting.Center;
    view.EyeDepth = frame.Refracting.EyeDepth;
    const bool meets = this->Membrane.Trace(view, tables.Input);
    const std::string mismatch = this->Membrane.DescribeMismatch();
    if (!mismatch.empty())
    {
      return mismatch;
    }
    if (meets)
    {
      scene.Refracted = this->Membrane.See(tables.Input);
    }
  }
  scene.Measuring = RayMeasuring::Events;
  scene.EventOpacity = opacity;
  scene.MeasuredFrom = frame.Refracting.EyeDepth;
  return std::string();
}

//------------------------------------------------------------------------------
std::string RayPicker::Cast(RayCastTables& tables, RayCastFrame frame, const PickedPixel& pixel,
  double opacity, MeasuredEvents& events)
{
  CropToPixel(pixel, frame);
  TileCaster::Scene scene;
  const int size[2] = { 1, 1 };
  std::string error = this->MakeScene(tables, frame, size, opacity, scene);
  if (error.empty())
  {
    const TileCaster caster(scene, ThreadedLoop);
    caster.Measure(0, this->Workspace, &pixel.OpaqueDepth);
    events = this->Workspace.Measured.Events.front();
  }
  return error;
}

//------------------------------------------------------------------------------
std::string RayPicker::CastDepths(RayCastTables& tables, RayCastFrame frame, double opacity,
  RayEventKind kind, std::vector<float>& depths)
{
  const int(&size)[2] = frame.Output.ImageSize;
  TileCaster::Scene scene;
  std::string error = this->MakeScene(tables, frame, size, opacity, scene);
  if (!error.empty())
  {
    return error;
  }
  scene.WantedEvents = 1u << kind;
  const std::size_t pixels = static_cast<std::size_t>(size[0]) * size[1];
  depths.assign(pixels, 2.0f);
  const std::vector<float> farPlane(pixels, 1.0f);
  const TileCaster caster(scene, ThreadedLoop);
  vtkSMPThreadLocal<TileCaster::Workspace> workspaces;
  ThreadedFor(0, caster.GetNumberOfTiles(), 1,
    [&](vtkIdType first, vtkIdType last)
    {
      TileCaster::Workspace& workspace = workspaces.Local();
      for (auto tile = static_cast<int>(first); tile < last; ++tile)
      {
        caster.Measure(tile, workspace, farPlane.data());
        ForEachPixel(caster, tile,
          [&](std::int64_t pixel, std::size_t inTile)
          {
            const MeasuredEvent& event = workspace.Measured.Events[inTile].Events[kind];
            if (event.IsFound())
            {
              depths[static_cast<std::size_t>(pixel)] = WindowDepthOf(frame.Rays, event.DrawnDepth);
            }
          });
      }
    });
  return error;
}

//------------------------------------------------------------------------------
std::int64_t RayPicker::GetBytes() const
{
  return this->Scenes.GetVertexBytes() + this->Scenes.GetPropertyBytes() +
    this->Membrane.GetBytes();
}

}

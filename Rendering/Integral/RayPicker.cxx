// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/RayPicker.h"

#include "Filters/Common/ThreadedLoop.h"

namespace meniscus
{
namespace
{

/** The rays of an image of one pixel. */
RayFrame CropToPixel(const RayFrame& image, const int (&size)[2], const PickedPixel& pixel)
{
  const double column = pixel.Column + 0.5 - 0.5 * size[0];
  const double row = pixel.Row + 0.5 - 0.5 * size[1];
  RayFrame rays = image;
  rays.Origin.Base = image.Origin.At(column, row);
  rays.Slope.Base = image.Slope.At(column, row);
  return rays;
}

}

//------------------------------------------------------------------------------
std::string RayPicker::Cast(RayCastTables& tables, RayCastFrame frame, const PickedPixel& pixel,
  double opacity, MeasuredEvents& events)
{
  frame.Rays = CropToPixel(frame.Rays, frame.Output.ImageSize, pixel);
  frame.Refracting.Part = MembranePart::Whole;
  frame.Refracting.Met = false;
  // Events depend on the exact functions.
  frame.Optics.PreIntegrated = false;
  this->Scenes.UpdateProperty(tables.Property);
  TileCaster::Scene scene = this->Scenes.Make(tables, frame, 1, 1);
  if (this->Membrane.GetNumberOfInterfaces() > 0)
  {
    RefractedRayField::View view;
    view.Frame = frame.Rays;
    view.Width = 1;
    view.Height = 1;
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
  const TileCaster caster(scene, ThreadedLoop);
  caster.Measure(0, this->Workspace, &pixel.OpaqueDepth);
  events = this->Workspace.Measured.Events.front();
  return std::string();
}

//------------------------------------------------------------------------------
std::int64_t RayPicker::GetBytes() const
{
  return this->Scenes.GetVertexBytes() + this->Scenes.GetPropertyBytes() +
    this->Membrane.GetBytes();
}

}

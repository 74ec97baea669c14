// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Rendering/Pipeline/RayCastBackendSet.h"
#include "Rendering/Present/RayCastPresenter.h"
#include "Rendering/Property/RayCastOptics.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkVolume;
class vtkWindow;

namespace meniscus
{

/**
 * From a mapper's input to a picture: the tables made of mesh, scalars, membrane and property, the
 * backends that draw them, and the presenter that takes the image to the window. Errors are texts,
 * empty if there is none.
 */
class RayCastPipeline : public RayCastTables
{
public:
  /** Binds to a window; on a change of window all that is on the graphics device is gone. */
  std::string SetWindow(vtkOpenGLRenderWindow* window);

  /**
   * Computes the frame of the rays, and the place of the mesh in it, for an image of the given
   * size.
   */
  std::string ComputeFrame(
    vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], ViewContext& place);

  /**
   * As above, for a frame of the world, which does not depend on the camera: with x and y as in the
   * world and depth along -z.
   */
  std::string ComputeWorldFrame(vtkVolume* volume, ViewContext& place) const;

  /**
   * Updates the gradients that the optics need.
   * @param parts source of the input's scalars.
   */
  void UpdateGradients(const InputBlocks& parts, const RayCastOptics& optics);

  /** Chooses the backend that draws a frame. */
  RayCastBackendChoice ChooseBackend(const RayCastFrame& frame, const RayCastBackendWish& wish);
  /** Draws a frame into the current viewport of the window's framebuffer. */
  std::string Draw(RayCastFrame frame, RayCastBackend& backend);

  /** Statistics of the last frame; zeros after one without rays. */
  RayCastStatistics GetStatistics() const;
  /** Rays of the last frame through overlapping cells; 0 from a backend that does not count them.
   */
  std::int64_t CountOverlaps() const;
  /** Share of the last frame's rays that were not interpolated, at least 1/16. */
  double GetShareOfCastRays() const;
  /** Notes a frame without rays. */
  void ClearStatistics() { this->Active = nullptr; }

  /** Images cast since construction. A frame equal to the last one shows its image again. */
  std::int64_t GetNumberOfCasts() const { return this->Casts; }
  /** False if the application has given up the last frame, so that its image is not finished. */
  bool IsFinished() const { return this->Presenter.IsFinished(); }
  /** True if the last cast computed a whole image, false if only some of its tiles. */
  bool WasWhole() const { return this->Whole; }

  RayCastCounters GetCounters() const { return this->Backends.GetCounters(); }
  RayCastPresenter& GetPresenter() { return this->Presenter; }

  /** Frees all graphics resources of a window; null for the window last drawn to. */
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /** Everything but depths that the presenter's image was made of. */
  struct ImageSource
  {
    const RayCastBackend* Backend = nullptr;
    RayCastFrame Frame;
    std::vector<RayCastTableState> Tables;
  };

  std::string PlaceIn(RayFrameInput& input, ViewContext& place) const;
  bool Trace(const RayCastFrame& frame);
  std::string CastMean(const RayCastFrame& frame, RayCastBackend& backend);
  bool IsRepeated(const ImageSource& source) const;
  RayCastImageBox FindMeeting(const RayCastFrame& frame) const;

  RayCastPresenter Presenter;
  RayCastBackendSet Backends;
  /** Backend of the last frame; null after one without rays. */
  RayCastBackend* Active = nullptr;
  /** Source of the image that the presenter holds; without a backend if it holds none. */
  ImageSource Shown;
  /** ModelToClip of the image that the presenter holds; none if it holds none. */
  std::optional<glm::dmat4> View;
  /** The camera's projection; zeros before the first frame. */
  glm::dmat4 Projection{ 0.0 };
  std::int64_t Casts = 0;
  bool Whole = false;
};

}

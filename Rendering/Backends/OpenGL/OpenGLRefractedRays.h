// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Refracted/RefractedRayTexels.h"
#include "Volume/Refracted/RefractionFrames.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace meniscus
{

/**
 * The refracted legs of an image's rays for shaders: a line per pixel and leg, and the frames of
 * the lines.
 */
class OpenGLRefractedRays
{
public:
  std::int64_t GetBytes() const { return this->Bytes; }

  /**
   * Description of the limit, in texels or of the device, that an image of the given size exceeds
   * whose rays have that many legs; empty if none.
   */
  static std::string DescribeExcess(const int (&imageSize)[2], int legs, std::int64_t limit);

  /**
   * Replaces the contents. Returns an error or an empty string.
   * @param lines result of LayOutRefractedRays() for an image of the given width.
   */
  std::string Upload(vtkOpenGLRenderWindow* window, const std::vector<RefractedRayLine>& lines,
    int width, const RefractionFrames& frames);

  /**
   * Rows of the frames with lines, in the order in which their vertices follow the view's vertices.
   */
  const std::vector<FixedPointRays::FixedPointRows>& GetFixedPointRows() const
  {
    return this->FixedRows;
  }

  /**
   * Sets the uniforms of vtkTetrahedraRays with REFRACTED.
   * @param vertices  number of vertices of a frame.
   */
  void Activate(vtkShaderProgram* program, std::int64_t vertices);
  void Deactivate() { this->Texture->Deactivate(); }
  /** Requires the window's context to be current. */
  void Release(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  std::int64_t Bytes = 0;
  /** Rows of each frame, and its axes in the frame of the view; three numbers each. */
  std::vector<float> Rows[3];
  std::vector<float> Axes[3];
  /** Grid units of x and y per unit of each frame; index of its rows in FixedRows, from 1. */
  std::vector<float> GridPerUnit;
  std::vector<int> Places;
  std::vector<FixedPointRays::FixedPointRows> FixedRows;
};

}

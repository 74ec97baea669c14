// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VTKBasics.h"

class vtkDataSet;
class vtkFramebufferPass;
class vtkUnstructuredGridVolumeMapper;

namespace meniscus::test
{

/** Premultiplied float RGBA, in rows from the bottom. */
struct FloatImage
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Rgba;

  const float* GetPixel(int x, int y) const
  {
    return &this->Rgba[4 * (static_cast<std::size_t>(y) * this->Width + x)];
  }
};

/** 8-bit RGB, in rows from the bottom. */
struct ByteImage
{
  int Width = 0;
  int Height = 0;
  std::vector<unsigned char> Rgb;

  const unsigned char* GetPixel(int x, int y) const
  {
    return &this->Rgb[3 * (static_cast<std::size_t>(y) * this->Width + x)];
  }
};

/** True if a window can be opened (VTK 9.1 aborts without a display). */
bool HasDisplay();

/**
 * Keeps a connection to the display. An X server resets when its last client leaves (as Xvfb does
 * without -noreset), and a window that is opened at that moment fails. A program that opens one
 * window after another therefore holds one of these.
 */
class DisplayHold
{
public:
  DisplayHold();
  ~DisplayHold();

private:
  vtkNew<vtkRenderWindow> Window;
};

/** An off-screen window with one renderer (black, transparent background) and one volume. */
class VolumeScene
{
public:
  VolumeScene(int width, int height, int multiSamples = 0);
  ~VolumeScene();
  VolumeScene(const VolumeScene&) = delete;
  VolumeScene& operator=(const VolumeScene&) = delete;

  vtkRenderWindow* GetWindow() const { return this->Window; }
  vtkRenderer* GetRenderer() const { return this->Renderer; }
  vtkVolume* GetVolume() const { return this->Volume; }
  vtkUnstructuredGridVolumeMapper* GetMapper() const;

  void SetMapper(vtkUnstructuredGridVolumeMapper* mapper);
  void SetProperty(vtkVolumeProperty* property);

  /** Renders through a float framebuffer and reads it back (only the renderer's viewport). */
  FloatImage RenderFloat();

  /** Renders the window as a user would and reads back all of it. */
  ByteImage RenderBytes();

private:
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkFramebufferPass> FloatPass;
};

/** Reads the window's front buffer without rendering. */
ByteImage ReadBytes(vtkRenderWindow* window);

/**
 * Looks at the middle of a bounding box from a direction given by angles in degrees. The box fills
 * the view for zoom 1; the clipping range contains the whole box.
 */
void LookAt(vtkRenderer* renderer, const double bounds[6], double azimuth, double elevation,
  double zoom = 1.0, bool parallel = false);

/** Looks along an axis (0, 1, 2), without perspective, so that rays are parallel to it. */
void LookAlongAxis(vtkRenderer* renderer, const double bounds[6], int axis, double zoom = 1.0);

/** Angles (azimuth, elevation) of the i-th of a set of views that avoid symmetry. */
std::array<double, 2> ViewAngles(int i);

/** OpenGL renderer and version of a window that has rendered. */
std::string DeviceName(vtkRenderWindow* window);

double DiagonalOf(const double bounds[6]);

} // namespace meniscus::test

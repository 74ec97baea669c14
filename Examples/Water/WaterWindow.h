// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <string>

class vtkActor;
class vtkActor2D;
class vtkImageMapper;
class vtkPolyData;
class vtkRefractedGeometryFilter;
class vtkRefractionPass;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextActor;

/** Settings that keys change. */
struct WaterSettings
{
  double Time = 0.0;
  double WaveHeight = 1.0;   ///< 0 to 2
  double Index = 1.333;      ///< index of the water, 1 to 2.5
  double Attenuation = 0.25; ///< attenuation of red light per length; green and blue are attenuated
                             ///< less
  bool Curved = true;        ///< false: the thesis's flat facets
  bool Refracts = true;      ///< false: the unrefracted well
  bool ShowsRays = false;    ///< the ray-traced image next to it, both without reflection and
                             ///< attenuation
};

/**
 * A well of water in a window: refracted by vtkRefractedGeometryFilter, drawn by
 * vtkRefractionPass.
 */
class WaterWindow
{
public:
  explicit WaterWindow(int size);
  ~WaterWindow();

  vtkRenderWindow* GetWindow() { return this->Window; }
  vtkRenderer* GetRenderer() { return this->Renderer; }

  /** Rotates the eye around the well by an angle in degrees. */
  void SetEyeAngle(double angle);

  /** Draws an image with these settings. */
  void Show(const WaterSettings& settings);

  /** Writes the current image to a PNG file. Returns false on failure. */
  bool Write(const std::string& file);

private:
  void ShowRays(const WaterSettings& settings);

  int Size;
  vtkSmartPointer<vtkPolyData> Well;
  vtkNew<vtkRefractedGeometryFilter> Filter;
  vtkNew<vtkRefractionPass> Pass;
  vtkNew<vtkActor> Water;
  vtkNew<vtkActor> Virtual;
  vtkNew<vtkActor> Solid;
  vtkNew<vtkTextActor> Text;
  vtkNew<vtkImageMapper> TracedPicture;
  vtkNew<vtkActor2D> Traced;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderer> TracedRenderer;
  vtkNew<vtkRenderWindow> Window;
};

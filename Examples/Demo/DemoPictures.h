// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <string>

/** An off-screen window whose images go to a folder; prints the size and time of each. */
class DemoPictures
{
public:
  explicit DemoPictures(const std::string& folder);

  vtkRenderer* GetRenderer() { return this->Renderer; }

  /**
   * Renders twice, for the first and the steady time, and writes NAME.png. Returns false on
   * failure.
   */
  bool Write(const std::string& name, const std::string& caption);

private:
  std::string Folder;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

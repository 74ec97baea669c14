// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DemoPictures.h"

#include "vtkPNGWriter.h"
#include "vtkTimerLog.h"
#include "vtkWindowToImageFilter.h"

#include <cstdio>

namespace
{

constexpr int PictureSize = 640;

/** Time of a frame in milliseconds, until its pixels are available. */
double RenderMilliseconds(vtkRenderWindow* window)
{
  const double start = vtkTimerLog::GetUniversalTime();
  window->Render();
  window->WaitForCompletion();
  return 1.0e3 * (vtkTimerLog::GetUniversalTime() - start);
}

}

//------------------------------------------------------------------------------
DemoPictures::DemoPictures(const std::string& folder)
  : Folder(folder)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(4);
  this->Window->SetSize(PictureSize, PictureSize);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.93, 0.94, 0.96);
  this->Renderer->SetBackground2(0.70, 0.76, 0.84);
  this->Renderer->GradientBackgroundOn();
}

//------------------------------------------------------------------------------
bool DemoPictures::Write(const std::string& name, const std::string& caption)
{
  this->Renderer->ResetCameraClippingRange();
  const double first = RenderMilliseconds(this->Window);
  const double steady = RenderMilliseconds(this->Window);

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(this->Window);
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  const std::string file = this->Folder + "/" + name + ".png";
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    std::fprintf(stderr, "error: %s cannot be written\n", file.c_str());
    return false;
  }
  std::printf("wrote %s (%d x %d): %s; first frame %.0f ms, next %.0f ms\n", file.c_str(),
    PictureSize, PictureSize, caption.c_str(), first, steady);
  return true;
}

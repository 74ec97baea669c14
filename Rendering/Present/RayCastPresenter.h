// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Backends/RayCastBackend.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Present/OpenGLColorCopy.h"
#include "Rendering/Present/OpenGLDepthCopy.h"
#include "Rendering/Present/OpenGLImageMean.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace meniscus
{

/**
 * Way of an image into the window, whichever backend makes it: a copy of the depths of opaque
 * geometry to begin with, the image as a float texture, and its blending into the framebuffer. All
 * calls want the window's context to be current. Errors are texts, empty if there is none.
 */
class RayCastPresenter : public RayCastTarget
{
public:
  RayCastPresenter();
  ~RayCastPresenter() override;
  RayCastPresenter(const RayCastPresenter&) = delete;
  void operator=(const RayCastPresenter&) = delete;

  /** Binds to a window and makes its context current; all textures of another window are freed. */
  std::string SetWindow(vtkOpenGLRenderWindow* window);
  vtkOpenGLRenderWindow* GetWindow() const;

  /** Whether the current OpenGL runs on the processor: Mesa's llvmpipe, softpipe or swr. */
  static bool IsSoftware();

  /** Viewport of the current framebuffer: x, y, width, height. */
  void GetViewport(int viewport[4]) const;

  /**
   * Has an image of the current viewport made and blends it into the current framebuffer.
   * @param before rays of the frame of the image that is held or begun, if that frame differs at
   *   most in the depths of opaque geometry and in the clipping range, which does not cut the mesh;
   *   otherwise null. If rays end at the same places and the image is finished, `makeImage` is not
   *   called.
   * @param sameView true if the image held shows the same view, perhaps with fewer rays: it is
   *   shown again if the application gives up the frame. Nothing is drawn then if it does not.
   */
  std::string Present(const RayCastFrame& frame, const RayFrame* before, bool sameView,
    const std::function<std::string(RayCastTarget&)>& makeImage);
  /** False if the application has given up the last frame. */
  bool IsFinished() const { return this->Finished; }

  /**
   * Writes depths to the depth buffer of the current viewport where they are nearer than
   * those there.
   * @param depths window depths of an image of the given size, rows from below; 2 for none.
   */
  std::string WriteDepths(const std::vector<float>& depths, const int size[2]);

  /**
   * Makes the mean of several images, which then is the image to present.
   * @param makeImage makes image number i of `count`, from 0; called from Present()'s makeImage.
   */
  std::string MakeMean(int count, const std::function<std::string(int, RayCastTarget&)>& makeImage);

  /** Waits until the device has executed all drawing commands. */
  void Finish();

  int GetWidth() const override { return this->Size[0]; }
  int GetHeight() const override { return this->Size[1]; }
  const std::vector<float>& ReadDepths() override;
  using RayCastTarget::WriteImage;
  std::string WriteImage(const std::vector<float>& rgba, const RayCastImageBox& filled) override;
  const std::vector<float>* GetDepthsOfImage() override
  {
    return this->HasDepthsOfImage ? &this->DepthsOfImage : nullptr;
  }
  bool MayStop() override;
  bool GoOn() override;
  vtkTextureObject* GetDepthTexture() override { return this->Depth.GetTexture(); }
  vtkTextureObject* GetImageTexture() override { return this->Image; }

  /**
   * Frees all graphics resources in the context of their window; null for the window last drawn to.
   * A window that is being destroyed must be given, weak pointers to it are empty by then.
   */
  void Release(vtkWindow* window);

private:
  /** An image with its size, and the box outside of which it is zero. */
  struct HeldImage
  {
    vtkSmartPointer<vtkTextureObject> Image;
    int Size[2];
    RayCastImageBox Filled;
  };

  bool HoldsImageOfDepths(const RayFrame& rays, const RayFrame* before);
  void ReadMeetingDepths();
  void ShowAgain(const HeldImage& last, bool sameView);
  std::string Resize(int width, int height);
  std::string Blend(const RayCastOutput& output, const int viewport[4]);
  bool BlendsSamples(const RayCastOutput& output, const int viewport[4]) const;
  bool MayHaveSteps() const;
  void DrawSamples(vtkOpenGLQuadHelper& composer);
  void LimitToFilled(const int viewport[4]);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  OpenGLDepthCopy Depth;
  OpenGLColorCopy Under;
  vtkSmartPointer<vtkTextureObject> Image;
  OpenGLImageMean Mean;
  std::unique_ptr<vtkOpenGLQuadHelper> Composer;
  std::unique_ptr<vtkOpenGLQuadHelper> BiasedComposer;
  std::unique_ptr<vtkOpenGLQuadHelper> SampleComposer;
  std::unique_ptr<vtkOpenGLQuadHelper> Selector;
  std::unique_ptr<vtkOpenGLQuadHelper> DepthWriter;
  int Size[2] = { 0, 0 };
  /** Box outside of which the image is zero. */
  RayCastImageBox Filled{ 0, 0, 0, 0 };
  /** RayCastOutput::Meeting of the frame at hand. */
  RayCastImageBox Meeting{ 0, 0, 0, 0 };
  /** Depths of the frame at hand, as soon as they are read. */
  std::vector<float> Depths;
  bool HasDepths = false;
  /** Depths that the rays of the image end at, if they were read. */
  std::vector<float> DepthsOfImage;
  bool HasDepthsOfImage = false;
  /** RayCastOutput::MayStop of the frame at hand. */
  bool Stoppable = false;
  /** False while the image of DepthsOfImage is begun only. */
  bool Finished = true;
};

}

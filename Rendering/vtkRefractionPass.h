// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractionPass
 * @brief   draws what lies behind refracting surfaces, with Fresnel, reflection and attenuation
 *
 * A render pass for vtkRenderer::SetPass(). It draws the renderer's scene by another pass, then,
 * for each membrane, the virtual geometry that a vtkRefractedGeometryFilter makes, where the
 * membrane is seen:
 *
 *     filter->SetInputConnection(object->GetOutputPort());
 *     filter->SetMembraneConnection(water->GetOutputPort());
 *     filter->SetCamera(renderer->GetActiveCamera());
 *     virtualMapper->SetInputConnection(filter->GetOutputPort());
 *     pass->AddRefraction(waterActor, virtualActor, filter);
 *     renderer->SetPass(pass);
 *
 * The camera is the filter's eye, so that everything follows it on Render(). Neither the membrane's
 * nor the virtual actor is added to the renderer. Actors of the renderer are drawn as they are:
 * geometry in front of the membrane, and the part on the eye's side of objects that pierce it, hide
 * the membrane, what lies behind it is hidden by it.
 *
 * Each pixel of a membrane is, after section 3 of the thesis "Refraction by geometric
 * transforms",
 *
 *     (1 - F) T + F R.
 *
 * T is the virtual geometry, lit by the renderer's lights and attenuated by exp(-k d) per channel
 * (Beer-Lambert), where d is the array RefractionDepth, the true path from sight point to object;
 * or the renderer's background where there is none. F is Fresnel's reflectance of unpolarised light
 * at the membrane's interpolated normal, exact or by Schlick. R is a cube map, seen in the
 * direction of the mirrored ray, or the background.
 *
 * Deviation from the thesis: T is drawn to a picture of its own, which the membrane then shows,
 * instead of to the stencil of the window. So windows without stencil and with multisampling show
 * the same, membranes do not interfere, and the state of the window is left alone.
 *
 * Volumes behind the membrane, drawn by a vtkTetrahedraRayCastMapper with the same membrane, come
 * to AddVolume(). Attenuation is that of their own colours.
 *
 * @note The membrane and the picture behind it have one sample per pixel.
 * @note A membrane seen through another one is hidden by it.
 *
 * @sa vtkRefractedGeometryFilter
 */
#ifndef vtkRefractionPass_h
#define vtkRefractionPass_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkOpenGLRenderPass.h"

#include <memory> // For std::unique_ptr

class vtkActor;
class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkProp3D;
class vtkRefractedGeometryFilter;
class vtkRenderer;
class vtkTexture;
class vtkVolume;

class VTKMENISCUS_EXPORT vtkRefractionPass : public vtkOpenGLRenderPass
{
public:
  static vtkRefractionPass* New();
  vtkTypeMacro(vtkRefractionPass, vtkOpenGLRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** How much light a membrane reflects. */
  enum ReflectanceModels
  {
    NONE = 0,    ///< nothing: the membrane is clear
    SCHLICK = 1, ///< Schlick's approximation, Eq. 2.7
    FRESNEL = 2  ///< exact, of unpolarised light, Eq. 2.6
  };

  /** @{ */
  /**
   * Set/Get the pass that draws the renderer's scene. Default is a vtkRenderStepsPass: lights,
   * opaque, translucent and volumetric geometry, overlays.
   */
  void SetScenePass(vtkRenderPass* pass);
  vtkRenderPass* GetScenePass();
  /** @} */

  /**
   * Adds an object behind a membrane. Objects with the same membrane actor hide each other.
   * @param membrane  shows the surface that the filter refracts at; of its property and its
   *                  visibility only the visibility counts.
   * @param object    shows the filter's output; drawn with its property, textures and mapper.
   * @param filter    where the indices of refraction are taken from. Null is an error, like a null
   *                  actor.
   */
  void AddRefraction(vtkActor* membrane, vtkActor* object, vtkRefractedGeometryFilter* filter);
  /**
   * Adds a volume that lies behind a membrane, in part or as a whole. What is behind is seen
   * through the membrane together with its objects, what is in front or beside as it is.
   * @param membrane  as above.
   * @param volume    with a vtkTetrahedraRayCastMapper, which has the same surface as its membrane
   *                  (SetMembraneConnection()) and the indices of refraction; else an error. Not to
   *                  be added to the renderer.
   */
  void AddVolume(vtkActor* membrane, vtkVolume* volume);
  /** @{ */
  /**
   * Removes an object or a volume that was added, or all of them; a membrane without is no longer
   * drawn. How many objects and volumes there are.
   */
  void RemoveRefraction(vtkProp3D* object);
  void RemoveAllRefractions();
  int GetNumberOfRefractions();
  /** @} */

  /** @{ */
  /**
   * Set/Get how much light membranes reflect: NONE, SCHLICK or FRESNEL. Default is FRESNEL.
   */
  vtkSetClampMacro(ReflectanceModel, int, NONE, FRESNEL);
  vtkGetMacro(ReflectanceModel, int);
  /** @} */

  /** @{ */
  /**
   * Set/Get a cube map (vtkTexture::CubeMapOn(), world axes) that membranes reflect. Default is
   * none: the renderer's environment texture if that is a cube map, else its background colour.
   *
   * Inputs 0 to 5 of the texture are the faces +x, -x, +y, -y, +z, -z, laid out as OpenGL has them.
   * Pixel (i, j) of a vtkImageData of n x n, (0, 0) its lower left one, with
   * u = (2 i + 1) / n - 1 and v = (2 j + 1) / n - 1, is the sky in the direction
   *
   *     +x: (1, -v, -u)   +y: (u,  1,  v)   +z: ( u, -v,  1)
   *     -x: (-1, -v, u)   -y: (u, -1, -v)   -z: (-u, -v, -1)
   *
   * so that sides of a sky with y upwards stand on their heads: pictures from files go through
   * vtkImageFlip with SetFilteredAxis(1).
   */
  void SetReflectionTexture(vtkTexture* texture);
  vtkTexture* GetReflectionTexture();
  /** @} */

  /** @{ */
  /**
   * Set/Get the attenuation coefficients of the medium behind the membranes for red, green and
   * blue, per world length, >= 0. Default is (0, 0, 0), clear.
   */
  vtkSetVector3Macro(AttenuationCoefficients, double);
  vtkGetVector3Macro(AttenuationCoefficients, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the camera's clipping range is widened, where it does not hold the membranes in
   * view and the objects behind them, which the renderer does not know. It is never narrowed.
   * Default is on.
   */
  vtkSetMacro(AdjustClippingRange, bool);
  vtkGetMacro(AdjustClippingRange, bool);
  vtkBooleanMacro(AdjustClippingRange, bool);
  /** @} */

  /** @{ */
  /**
   * Counters since construction: membranes drawn, and membranes that were not because none of their
   * bounds is in view, or because they are not visible.
   */
  vtkTypeInt64 GetNumberOfMembranesDrawn() const;
  vtkTypeInt64 GetNumberOfMembranesSkipped() const;
  /** @} */

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  /** @{ */
  /**
   * What the mappers of objects and membranes ask for while they are drawn.
   */
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* vao = nullptr) override;
  /** @} */

protected:
  vtkRefractionPass();
  ~vtkRefractionPass() override;

private:
  vtkRefractionPass(const vtkRefractionPass&) = delete;
  void operator=(const vtkRefractionPass&) = delete;

  void DrawMembrane(const vtkRenderState* drawn, vtkOpenGLRenderWindow* window, vtkActor* membrane);
  void DrawInFront(const vtkRenderState* drawn, vtkOpenGLRenderWindow* window, vtkActor* membrane);
  void DrawObjects(vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane);
  void DrawVolumes(vtkRenderer* renderer, vtkActor* membrane, int part);
  void DrawSurface(vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane);
  void Compose(vtkRenderer* renderer, vtkOpenGLRenderWindow* window, vtkActor* membrane);
  void SetOptics(vtkRenderer* renderer, vtkActor* membrane, vtkShaderProgram* program);

  bool AdjustClippingRange = true;
  int ReflectanceModel = FRESNEL;
  double AttenuationCoefficients[3] = { 0.0, 0.0, 0.0 };

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

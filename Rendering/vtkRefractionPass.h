// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractionPass
 * @brief   draws geometry behind refracting surfaces, with Fresnel reflection and attenuation
 *
 * A render pass for vtkRenderer::SetPass(). It draws the renderer's scene by another pass and then,
 * for each membrane, the virtual geometry of a vtkRefractedGeometryFilter at the pixels where the
 * membrane is visible:
 *
 *     filter->SetInputConnection(object->GetOutputPort());
 *     filter->SetMembraneConnection(water->GetOutputPort());
 *     filter->SetCamera(renderer->GetActiveCamera());
 *     virtualMapper->SetInputConnection(filter->GetOutputPort());
 *     pass->AddRefraction(waterActor, virtualActor, filter);
 *     renderer->SetPass(pass);
 *
 * The camera is the filter's eye, so that the output follows it on Render(). Neither the membrane's
 * nor the virtual actor is added to the renderer. Actors of the renderer are drawn without
 * refraction: geometry in front of the membrane, including the eye's side of objects that intersect
 * it, occludes the membrane, and the membrane occludes geometry behind it.
 *
 * The colour of each pixel of a membrane is, following section 3 of the thesis "Refraction by
 * geometric transforms",
 *
 *     (1 - F) T + F R.
 *
 * T is the colour of the virtual geometry, lit by the renderer's lights (Lighting) and seen through
 * the medium behind the membrane: L s + M (1 - s) with the object's light L, the colour M that the
 * medium scatters towards the eye (MediumColor), and the transmittance s of the medium. The
 * transmittance is exp(-k d) per channel (Beer-Lambert) or linear in d (MediumModel), where d is
 * the array RefractionDepth, the true path from sight point to object. Where there is no virtual
 * geometry, T is the renderer's background, or the colour of an infinite medium (InfiniteMedium). F
 * is the Fresnel reflectance of unpolarised light at the membrane's interpolated normal, exact or
 * by Schlick's approximation. R is the colour of the mirror images of AddReflection(). Where there
 * are none, R is the colour of a cube map in the direction of the reflected ray, or the background.
 *
 * Behind several interfaces (vtkRefractedGeometryFilter::SetInterfaces()), T also contains
 * Fresnel's transmittance of the interfaces behind the first one that are in front of the object,
 * from the array InnerReflectance, with either model of the reflectance. The share of R and of the
 * background is the reflectance of all interfaces; of more than 16, the first 16 count, with a
 * warning. It includes light that is reflected between them, as for parallel plates: a pane in air
 * reflects 0.077 of the light at vertical incidence. The membrane's actor shows the surface of the
 * first interface.
 *
 * Deviation from the thesis: T is drawn to a separate image, which is then composited at the
 * membrane's pixels, instead of using the stencil buffer of the window. The result is therefore the
 * same for windows without stencil and with multisampling, membranes do not interfere with each
 * other, and the state of the window is not changed.
 *
 * Volumes behind the membrane, drawn by a vtkTetrahedraRayCastMapper with the same membrane, are
 * added by AddVolume(). They are seen through the same medium, so that a volume and an object at
 * the same depth look alike, unless their mapper has a medium of its own.
 *
 * @note The membrane and the image behind it have one sample per pixel.
 * @note Volumes are dimmed by the first of several interfaces only.
 * @note A membrane behind another one is not visible through it.
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
class vtkRecti;
class vtkRefractedGeometryFilter;
class vtkRenderer;
class vtkTexture;
class vtkVolume;

namespace meniscus
{
struct Refraction;
enum class MembranePart;
}

class VTKMENISCUS_EXPORT vtkRefractionPass : public vtkOpenGLRenderPass
{
public:
  static vtkRefractionPass* New();
  vtkTypeMacro(vtkRefractionPass, vtkOpenGLRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Model of the light that a membrane reflects. */
  enum
  {
    FRESNEL = 0, ///< exact reflectance of unpolarised light, Eq. 2.6
    SCHLICK = 1, ///< Schlick's approximation, Eq. 2.7
    NONE = 2,    ///< no reflection: the membrane is clear
    MIRROR = 3   ///< all light is reflected
  };

  /** @{ */
  /**
   * Set/Get the pass that draws the renderer's scene. Default is a vtkRenderStepsPass, which draws
   * lights, opaque, translucent and volumetric geometry, and overlays.
   */
  void SetScenePass(vtkRenderPass* pass);
  vtkRenderPass* GetScenePass();
  /** @} */

  /**
   * Adds an object behind a membrane. Objects with the same membrane actor occlude each other.
   * @param membrane actor of the surface at which the filter refracts; its property is ignored, its
   *   visibility is used.
   * @param object actor of the filter's output; drawn with its property, textures and mapper.
   * @param filter source of the indices of refraction. Null is an error, like a null actor.
   */
  void AddRefraction(vtkActor* membrane, vtkActor* object, vtkRefractedGeometryFilter* filter);
  /**
   * Adds an object that a membrane reflects: the scene in front of it. The medium behind the
   * membrane does not attenuate it. The object itself is drawn where it is added, for instance to
   * the renderer.
   * @param membrane as in AddRefraction(); may be a membrane without anything behind it.
   * @param object actor of the filter's output.
   * @param filter in Mode REFLECTION; otherwise, and if it is null, it is an error.
   */
  void AddReflection(vtkActor* membrane, vtkActor* object, vtkRefractedGeometryFilter* filter);
  /**
   * Adds a volume of which at least a part lies behind a membrane. The part behind it is drawn
   * through the membrane together with the membrane's objects; the part in front of it, or next to
   * it in the image, is drawn without refraction.
   * @param membrane as in AddRefraction().
   * @param volume its mapper must be a vtkTetrahedraRayCastMapper with the same surface as its
   *   membrane (SetMembraneConnection()) and the same indices of refraction; otherwise it is an
   *   error. Must not be added to the renderer.
   */
  void AddVolume(vtkActor* membrane, vtkVolume* volume);
  /** @{ */
  /**
   * Remove an object or a volume that was added, or all of them. A membrane that has neither is no
   * longer drawn. Get the number of objects and volumes.
   */
  void RemoveRefraction(vtkProp3D* object);
  void RemoveAllRefractions();
  int GetNumberOfRefractions();
  /** @} */

  /** @{ */
  /**
   * Set/Get the model of the light that membranes reflect: NONE, SCHLICK, FRESNEL or MIRROR.
   * Default is FRESNEL.
   */
  virtual void SetReflectanceModel(int model);
  vtkGetMacro(ReflectanceModel, int);
  void SetReflectanceModelToFresnel() { this->SetReflectanceModel(FRESNEL); }
  void SetReflectanceModelToSchlick() { this->SetReflectanceModel(SCHLICK); }
  void SetReflectanceModelToNone() { this->SetReflectanceModel(NONE); }
  void SetReflectanceModelToMirror() { this->SetReflectanceModel(MIRROR); }
  /** @} */

  /** @{ */
  /**
   * Set/Get a cube map (vtkTexture::CubeMapOn(), world axes) that membranes reflect where they do
   * not reflect an object. Default is none: the renderer's environment texture is used if it is a
   * cube map, otherwise its background colour.
   *
   * Inputs 0 to 5 of the texture are the faces +x, -x, +y, -y, +z, -z, in OpenGL's layout. Pixel
   * (i, j) of a vtkImageData of n x n, (0, 0) its lower left one, with u = (2 i + 1) / n - 1 and v
   * = (2 j + 1) / n - 1, is the sky in the direction
   *
   *     +x: (1, -v, -u)   +y: (u,  1,  v)   +z: ( u, -v,  1)
   *     -x: (-1, -v, u)   -y: (u, -1, -v)   -z: (-u, -v, -1)
   *
   * so that the side faces of a sky with y upwards are upside down: flip images from files by
   * vtkImageFlip with SetFilteredAxis(1).
   */
  void SetReflectionTexture(vtkTexture* texture);
  vtkTexture* GetReflectionTexture();
  /** @} */

  /** @{ */
  /**
   * Set/Get the attenuation coefficients of the medium behind the membranes for red, green and
   * blue, per world length, >= 0, for the model EXPONENTIAL. Default is (0, 0, 0), a clear medium.
   * If AttenuationCoefficients, MediumColor or MediumRange is out of its range or not finite,
   * Render() reports an error and draws a clear medium.
   */
  vtkSetVector3Macro(AttenuationCoefficients, double);
  vtkGetVector3Macro(AttenuationCoefficients, double);
  /** @} */

  /** Share of an object's light that the medium transmits over a distance d. */
  enum
  {
    EXPONENTIAL = 0, ///< exp(-k d), with k of AttenuationCoefficients
    LINEAR = 1       ///< 1 up to MediumRange[0], 0 from MediumRange[1] on, linear in between
  };

  /** @{ */
  /** Set/Get the model of the medium behind the membranes. Default is EXPONENTIAL. */
  virtual void SetMediumModel(int model);
  vtkGetMacro(MediumModel, int);
  void SetMediumModelToExponential() { this->SetMediumModel(EXPONENTIAL); }
  void SetMediumModelToLinear() { this->SetMediumModel(LINEAR); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the distances between which the LINEAR medium hides objects, in world lengths along the
   * true path: 0 <= MediumRange[0] <= MediumRange[1]. Default is (0, 1).
   */
  vtkSetVector2Macro(MediumRange, double);
  vtkGetVector2Macro(MediumRange, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the colour that the medium scatters towards the eye: red, green and blue, each from 0
   * to 1. Objects at a large distance have this colour. Default is (0, 0, 0): objects fade to
   * black.
   */
  vtkSetVector3Macro(MediumColor, double);
  vtkGetVector3Macro(MediumColor, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the medium has no end where no object lies behind the membrane: it then hides
   * the background, in the channels in which it attenuates light at all. Default is off.
   */
  vtkSetMacro(InfiniteMedium, bool);
  vtkGetMacro(InfiniteMedium, bool);
  vtkBooleanMacro(InfiniteMedium, bool);
  /** @} */

  /** Space in which objects behind membranes are lit. */
  enum
  {
    VIRTUAL_SPACE = 0, ///< by VTK: at the virtual position, with the normals of the filter's output
    TRUE_SPACE = 1     ///< at the true position, with the true normal and refracted directions
  };

  /** @{ */
  /**
   * Set/Get how objects behind membranes are lit. With VIRTUAL_SPACE, the default, VTK's lighting
   * is exact for a light at the eye with VirtualNormals of the filter; for other lights it is only
   * plausible.
   *
   * TRUE_SPACE lights each fragment at its true position, with its true normal (the normal of its
   * facet, if the object has no point normals) and the direction back along the refracted ray to
   * its sight point. TrueGeometry of the filter must be on; otherwise there is an error, and the
   * object is lit in virtual space. The renderer's lights are used, up to 16: directional,
   * positional and spot, with VTK's falloff and Phong's model, on both sides of a surface. Lights
   * behind the membrane shine straight. The plane that fits the membrane's points best decides on
   * which side a light is. Lights on it (within rounding), or along it at infinity, are left out,
   * with a warning; GetNumberOfSkippedLights() counts them in each drawing of a membrane.
   *
   * The rays of lights in front of a flat membrane are refracted by Snell's law, and have the flux
   * that it transmits: Fresnel's loss and the change of a beam's width. A light at infinity at the
   * angle of incidence i gives an area across the refracted rays, whose angle is r, the share
   * (1 - F) cos i / cos r of its irradiance. Behind several flat interfaces, F is the reflectance
   * of all of them, and lights are refracted as if the media between were not there, which is exact
   * for parallel planes and lights at infinity.
   *
   * Through a membrane that is not flat, or a list with such a surface, a vtkRefractedLightFilter
   * computes the light of scene lights in front of it on each object: the pattern of waves, with
   * all paths of the light to a point. Only light through the membrane arrives then. Highlights
   * have the mean direction of the light at a point. The light is computed again when a light, a
   * membrane or an object changes, not when the camera moves; NumberOfLightCells is its resolution.
   * Lights that follow the camera, and objects of several blocks, are lit by the plane above.
   *
   * Not modelled: light that the membrane reflects back into the medium behind it. The material
   * has ambient, diffuse and specular shares; physically based shading has no effect.
   */
  void SetLighting(int lighting);
  vtkGetMacro(Lighting, int);
  void SetLightingToVirtualSpace() { this->SetLighting(VIRTUAL_SPACE); }
  void SetLightingToTrueSpace() { this->SetLighting(TRUE_SPACE); }
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the medium also attenuates light on its way to the object, with TRUE_SPACE:
   * from a positional light in it, or from the membrane. Default is on.
   */
  vtkSetMacro(LightAttenuation, bool);
  vtkGetMacro(LightAttenuation, bool);
  vtkBooleanMacro(LightAttenuation, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether objects behind a membrane cast shadows on each other and on themselves, with
   * TRUE_SPACE: in the light of all lights, in the medium and in front of it. All visible objects
   * of the same membrane whose actors are opaque surfaces cast shadows; wireframes, translucent
   * objects, volumes, mirror images and actors of the renderer cast none. Points in shadow get the
   * light's ambient part only.
   *
   * The shader follows the path of the light from each pixel through a tree of the objects'
   * triangles, so that edges are as sharp as the pixels. The path is that of the light's ray:
   * straight, or bent at the flat membrane or at the plane that fits its points best. Through waves
   * it is the mean ray at the point that vtkRefractedLightFilter has found; where waves send light
   * to a point along several paths, all of it or none is in shadow. The part of an object in front
   * of the membrane casts a shadow on the objects behind the membrane.
   *
   * On facets that face away from a light while their smooth normals do not, the object's next
   * facet on the path casts no shadow: the lit side of round objects ends smoothly. The tree is
   * made again if an object changes, appears or disappears, not for lights, membranes or the
   * camera. The time of a frame grows with the pixels of the objects and the lights. Default is
   * off.
   */
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the number of cells into which each object is divided for its light through a membrane
   * that is not flat, with TRUE_SPACE. Details of the light that are smaller than a cell are not
   * resolved. The time that a light, a membrane or an object that changed takes is proportional to
   * it: vtkRefractedLightFilter computes each cell. With 0, such membranes refract light at the
   * plane that fits their points best. Default is 100000. Range 0 to 4000000.
   */
  virtual void SetNumberOfLightCells(int cells);
  vtkGetMacro(NumberOfLightCells, int);
  /** @} */

  /**
   * Number of times since construction that the light of one source on one object was computed
   * through a membrane that is not flat. A camera that moves does not add to it.
   */
  vtkTypeInt64 GetNumberOfLightUpdates() const;

  /** Number of times since construction that a tree of the objects that cast shadows was made. */
  vtkTypeInt64 GetNumberOfShadowUpdates() const;

  /** Number of lights left out since construction: see SetLighting(). */
  vtkTypeInt64 GetNumberOfSkippedLights() const;

  /** @{ */
  /**
   * Set/Get whether the camera's clipping range is widened if it does not contain the membranes in
   * view and the objects behind them, which are unknown to the renderer. It is never narrowed.
   * Default is on.
   */
  vtkSetMacro(AdjustClippingRange, bool);
  vtkGetMacro(AdjustClippingRange, bool);
  vtkBooleanMacro(AdjustClippingRange, bool);
  /** @} */

  /** @{ */
  /**
   * Counters since construction: number of membranes drawn, and number of membranes skipped because
   * they are not visible or because their bounds are out of view.
   */
  vtkTypeInt64 GetNumberOfMembranesDrawn() const;
  vtkTypeInt64 GetNumberOfMembranesSkipped() const;
  /** @} */

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  /** @{ */
  /**
   * Shader code and uniforms for the mappers of objects and membranes, which call these while they
   * are drawn.
   */
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* vao = nullptr) override;
  /** Time of the last change of an object's shader code. */
  vtkMTimeType GetShaderStageMTime() override;
  /** @} */

protected:
  vtkRefractionPass();
  ~vtkRefractionPass() override;

private:
  vtkRefractionPass(const vtkRefractionPass&) = delete;
  void operator=(const vtkRefractionPass&) = delete;

  void DrawMembrane(const vtkRenderState* drawn, vtkOpenGLRenderWindow* window, vtkActor* membrane);
  void DrawInFront(const vtkRenderState* drawn, vtkOpenGLRenderWindow* window, vtkActor* membrane);
  void DrawObjects(
    vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane, const vtkRecti& part);
  void DrawVolumes(vtkRenderer* renderer, vtkActor* membrane, meniscus::MembranePart part);
  void DrawSurface(
    vtkRenderer* renderer, vtkOpenGLState* state, vtkActor* membrane, const vtkRecti& part);
  void Compose(vtkRenderer* renderer, vtkOpenGLRenderWindow* window, vtkActor* membrane);
  void ReportPlates(std::size_t interfaces);
  void UpdateMedium();
  void ChooseLighting();
  void UpdateLighting(vtkRenderer* renderer, vtkActor* membrane);
  void UpdateWaves(vtkRenderer* renderer, meniscus::Refraction& refraction);
  bool UpdateShadows(vtkRenderer* renderer, vtkActor* membrane);

  bool AdjustClippingRange = true;
  int ReflectanceModel = FRESNEL;
  double AttenuationCoefficients[3] = { 0.0, 0.0, 0.0 };
  int MediumModel = EXPONENTIAL;
  double MediumRange[2] = { 0.0, 1.0 };
  double MediumColor[3] = { 0.0, 0.0, 0.0 };
  bool InfiniteMedium = false;
  int Lighting = VIRTUAL_SPACE;
  bool LightAttenuation = true;
  bool Shadows = false;
  int NumberOfLightCells = 100000;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastMapper
 * @brief   volume-renders a tetrahedral vtkUnstructuredGrid by exact ray casting
 *
 * Casts one ray per pixel through the mesh, from cell to cell across shared faces, and integrates
 * the density-emitter model in closed form. The image does not depend on a sampling distance.
 *
 * Input: a vtkUnstructuredGrid, structured, rectilinear or image grid, or a composite data set of
 * such (whose leaves make one mesh, so that they may interlock; leaves without the array are left
 * out with a warning) with a point or cell array, chosen by the scalar mode and array selection of
 * vtkAbstractVolumeMapper. Of several components, SetVectorMode() or the colour function chooses
 * one or the length; or two to four mix as described below. Point data is linear within each
 * tetrahedron, cell data constant within each cell. Tetrahedra are drawn as they are; voxels,
 * hexahedra, wedges, pyramids, prisms, polyhedra and cells of second order as tetrahedra that have
 * the same points and fit across shared faces, whatever the cells (each cell is pulled to its point
 * of the smallest number). Other cells are left out with a warning. Any mesh is accepted:
 * non-convex, disconnected, cyclic, with inverted cells, cells of zero volume, duplicate points and
 * faces of more than two cells. Cells that vtkGhostType marks as duplicate or hidden are left out.
 * Cells with a point index out of range, a repeated point or a point that is not finite are left
 * out and counted. Cells with a scalar that is not finite, their own or that of a vertex, are
 * transparent and counted.
 *
 * Optical model, by SetBlendMode() with the numbers of vtkVolumeMapper::BlendModes:
 * - COMPOSITE_BLEND: colour and opacity come from the vtkVolumeProperty. Opacity becomes an
 *   attenuation coefficient as SetOpacityModel() says, per ScalarOpacityUnitDistance. Emitted
 *   colour is weighted by the attenuation. Shade and the property's material light the colour (by
 *   Phong's model, two-sided, by the renderer's lights); the gradient opacity function, of the
 *   gradient's length in scalar per world length, multiplies the attenuation; without points it is
 *   0, as in VTK. See SetGradients().
 * - MAXIMUM_INTENSITY_BLEND, MINIMUM_INTENSITY_BLEND, AVERAGE_INTENSITY_BLEND: the largest or
 *   smallest scalar of the ray, or its mean over the length, shown by colour and opacity of the
 *   property; lengths do not count.
 * - ADDITIVE_BLEND: the integral of opacity / ScalarOpacityUnitDistance times the scalar's place in
 *   the data's range [0, 1], as an opaque grey level.
 * - ISOSURFACE_BLEND: surfaces at the property's IsoSurfaceValues, with its colour and opacity at
 *   these values; lit if Shade is on. Of cell data, the faces shared by two cells whose values lie
 *   on either side of an isovalue.
 *
 * Cell data has no gradient: of Shade and gradient opacity, only light on isosurfaces is left.
 *
 * Several components, with COMPOSITE_BLEND, by vtkVolumeProperty's IndependentComponents: if on,
 * and if a component beyond the first has a colour or opacity function (see SetVectorMode()), two
 * to four scalars, each with its own functions and weight, as media in the same place (attenuations
 * add up, emissions too; not lit). If off, two: colour by the first, opacity by the second; or
 * four: the first three are the colour (unsigned char, or 0 to 1), opacity by the fourth. Light
 * then goes by the gradient of the last. See Documentation/volume.md.
 *
 * Lengths are measured in world coordinates. Output is premultiplied RGBA, blended over what is in
 * the framebuffer; rays end at the opaque geometry there. Clipping planes cut cells exactly. A
 * transfer function that is not piecewise linear (HSV, Lab or diverging space, logarithmic scale,
 * midpoint, sharpness, OPACITY_PER_UNIT_DISTANCE) is sampled between its nodes until linear
 * interpolation is off by less than 1/32768 of the full range of colour and of alpha over the unit
 * distance.
 *
 * Method:
 * 1. Vertices and cells are ordered along a Morton curve; cells are linked across faces. Once per
 *    mesh. 32 bytes per cell, 16 per vertex, 80 per boundary face of GPU memory.
 * 2. The entries of a ray are found in a bounding volume hierarchy over the boundary faces.
 * 3. In the projection along the ray the exit of a cell follows from the signs of its edges, which
 *    are exact (vertices are rounded to a grid of 2^-22 of the mesh's radius about the ray). A ray
 *    through an edge or a vertex counts as displaced by (e, e^2) for an arbitrarily small e. A walk
 *    that begins on the boundary therefore ends on the boundary: no ray is lost, none runs for
 * ever.
 * 4. Within a cell the scalar is linear along the ray. The segment is split at the transfer
 *    function's nodes; every piece has linear attenuation and colour and is integrated in closed
 *    form up to an error of 3e-7. With several components, at the nodes of all functions; every
 *    piece then by Gauss' rule of three points, up to 1e-6. Or by SetIntegration().
 *
 * Where cells overlap (inverted cells, overlapping parts), the cell that the ray entered first
 * counts up to its exit. Cells that cannot be seen, because the transfer function has no opacity
 * anywhere in their range of scalars, are not visited and hide nothing.
 *
 * After: M. Weiler, M. Kraus, M. Merz, T. Ertl, "Hardware-Based Ray Casting for Tetrahedral
 * Meshes", IEEE Visualization 2003. Deviations: one pass with a loop instead of one pass per cell;
 * edge signs instead of plane equations (Eq. 1); closed-form integration (K. Moreland, E. Angel, "A
 * Fast High Accuracy Volume Renderer for Unstructured Data", 2004) instead of pre-integrated tables
 * (Eqs. 3, 4) unless PRE_INTEGRATED is asked for; boundary entries instead of imaginary cells.
 *
 * Needs OpenGL 3.2; the native backend casts rays on the CPU and needs it to show the image. Work
 * is done where its input changes: see the counters.
 *
 * @note Limits of this version: up to 32 clipping planes and 16 lights; several components with
 * composite blending of point data only; fewer than 2^29 tetrahedra; on the graphics device, tables
 * within GL_MAX_TEXTURE_BUFFER_SIZE (see SetMaximumTableSize()). All backends draw the
 * same.
 *
 * @sa vtkProjectedTetrahedraMapper vtkUnstructuredGridVolumeRayCastMapper vtkVolumeProperty
 */
#ifndef vtkTetrahedraRayCastMapper_h
#define vtkTetrahedraRayCastMapper_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkUnstructuredGridVolumeMapper.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkCompositeDataSet;
class vtkDataSet;
class vtkPolyData;
class vtkRenderWindow;

namespace meniscus
{
struct BlendModel;
struct InputBlocks;
struct InputReport;
struct RayCastFrame;
struct ViewContext;
struct RayCastOptics;
struct ScalarSelection;
}

class VTKMENISCUS_EXPORT vtkTetrahedraRayCastMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  static vtkTetrahedraRayCastMapper* New();
  vtkTypeMacro(vtkTetrahedraRayCastMapper, vtkUnstructuredGridVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkUnstructuredGridVolumeMapper::SetInputData;
  /** @{ */
  /**
   * Sets what is drawn, without a pipeline: a data set with cells that have volume, or a composite
   * one of such, all of whose leaves are drawn as one mesh.
   */
  void SetInputData(vtkDataSet* input) override;
  void SetInputData(vtkCompositeDataSet* input);
  /** @} */

  /** @{ */
  /**
   * Sets a surface that rays bend at, port 1, from a pipeline or without: triangles, or what
   * triangulates, in world coordinates. Its point normals are used if present, else computed; it is
   * curved between its points, as in vtkRefractedGeometryFilter::CURVED. Null, the default: none.
   *
   * A pixel's ray goes straight to where it first meets the membrane, so a part of the mesh in
   * front of it is seen as ever; there it bends by Snell's law, once, and goes on through the mesh.
   * Where it is totally reflected nothing behind the membrane is seen; beside the membrane rays are
   * straight. What is in the framebuffer behind the membrane counts as virtual geometry, such as
   * vtkRefractedGeometryFilter makes: at a distance l behind the sight point it hides what is
   * n2 / n1 * l along the refracted ray and farther (the thesis's Eq. 2.4). A membrane that is
   * drawn opaque itself hides all that is behind it.
   *
   * Bounds of the mapper include those of the membrane, where the volume is seen. A membrane that
   * cannot be used is an error, and nothing is rendered.
   *
   * @sa SetExteriorIndexOfRefraction
   */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMembraneData(vtkPolyData* membrane);
  void SetMembrane(vtkPolyData* membrane) { this->SetMembraneData(membrane); }
  vtkPolyData* GetMembrane();
  /** @} */

  /** @{ */
  /**
   * Indices of refraction: exterior, on the side that the membrane's normals point to, default 1.0,
   * and interior, on the other side, default 1.333. Positive and finite; others are an error when
   * there is a membrane. A ray that meets the membrane from behind leaves the interior. If they are
   * equal the membrane changes nothing and costs nothing.
   */
  vtkSetMacro(ExteriorIndexOfRefraction, double);
  vtkGetMacro(ExteriorIndexOfRefraction, double);
  vtkSetMacro(InteriorIndexOfRefraction, double);
  vtkGetMacro(InteriorIndexOfRefraction, double);
  /** @} */

  /** @{ */
  /** Bounds of the input, of all leaves of a composite one, and of the membrane. */
  double* GetBounds() VTK_SIZEHINT(6) override;
  void GetBounds(double bounds[6]) override { this->Superclass::GetBounds(bounds); }
  /** @} */

  /** What is drawn of an array of several components. */
  enum VectorModes
  {
    DISABLED = -1,
    MAGNITUDE = 0,
    COMPONENT = 1
  };

  /** @{ */
  /**
   * Selects the part of an array of several components that is drawn, as in vtkSmartVolumeMapper:
   * MAGNITUDE, the length of the vector (a single component with its sign); COMPONENT, the one of
   * number VectorComponent (from 0, the default). Both take precedence over the volume's property.
   *
   * DISABLED, the default, leaves it to the property. If its IndependentComponents are off, two or
   * four components mix (see the class). If they are on, the first colour function decides, as in
   * vtkProjectedTetrahedraMapper: MAGNITUDE of vtkScalarsToColors::SetVectorMode() draws the
   * length, COMPONENT the component of SetVectorComponent(), with the functions of the first
   * component. With COMPONENT 0, which every colour function has unless told otherwise, two to four
   * components mix if the property has a colour or opacity function for one beyond the first; if it
   * has none, the first component is drawn.
   */
  vtkSetClampMacro(VectorMode, int, DISABLED, COMPONENT);
  vtkGetMacro(VectorMode, int);
  vtkSetClampMacro(VectorComponent, int, 0, VTK_INT_MAX);
  vtkGetMacro(VectorComponent, int);
  /** @} */

  /** What an opacity means over a length. */
  enum OpacityModels
  {
    AttenuationCoefficient = 0,
    OpacityPerUnitDistance = 1
  };

  /** @{ */
  /**
   * What an opacity of the transfer function means over a length L, with the property's
   * ScalarOpacityUnitDistance as unit. ATTENUATION_COEFFICIENT, the default, is what VTK's
   * unstructured grid mappers do: alpha = 1 - exp(-L * opacity / unit). OPACITY_PER_UNIT_DISTANCE
   * is what its image data mappers do: alpha = 1 - (1 - opacity)^(L / unit); there, opacities above
   * 1 - 2^-24 count as that.
   */
  vtkSetClampMacro(OpacityModel, int, AttenuationCoefficient, OpacityPerUnitDistance);
  vtkGetMacro(OpacityModel, int);
  /** @} */

  /** What casts the rays. */
  enum Backends
  {
    AUTOMATIC = 0,
    OPENGL = 1,
    NATIVE = 2,
    COMPUTE = 3
  };

  /** @{ */
  /**
   * What runs the ray caster: OPENGL, a fragment shader; COMPUTE, a compute shader of the same
   * functions (OpenGL 4.3; on a window without, OPENGL after a warning); NATIVE, the CPU, in SIMD
   * packets (AVX-512, AVX2 or what there is) on all threads of vtkSMPTools; AUTOMATIC, the default,
   * OPENGL, or NATIVE where OpenGL is a software rasteriser. The choice depends on nothing else:
   * every backend has every optical model.
   */
  vtkSetClampMacro(Backend, int, AUTOMATIC, COMPUTE);
  vtkGetMacro(Backend, int);
  /** @} */

  /** The backend of the last Render(); AUTOMATIC if nothing has been rendered. */
  vtkGetMacro(ActiveBackend, int);

  /** How segments of rays are integrated. */
  enum Integrations
  {
    EXACT = 0,
    PreIntegrated = 1
  };

  /** @{ */
  /**
   * How ray segments are integrated: EXACT, the default, in closed form; PRE_INTEGRATED, by a table
   * as in the paper, over the scalars at both ends of a segment and its length (SetPreIntegration-
   * ScalarSize(), SetPreIntegrationLengthSize()). The table is made when the transfer function, a
   * size or the longest edge of the volume in the world changed. It is there for composite blending
   * of one component without light and gradient opacity; else segments are integrated exactly,
   * after a warning where PRE_INTEGRATED would have made a difference.
   */
  vtkSetClampMacro(Integration, int, EXACT, PreIntegrated);
  vtkGetMacro(Integration, int);
  /** @} */

  /** @{ */
  /**
   * Samples of the pre-integration table: of the range of the data's scalars, in [2, 1024], default
   * 256, and of the length of a segment, in [1, 128], default 16. One length neglects what a
   * segment absorbs of itself in its colour, not in its opacity. Where that is as good, because all
   * that can be seen has one colour or because no segment is deeper than 1/64, the table has one
   * length whatever is set. It takes 16 bytes times the lengths times the square of the scalars.
   */
  vtkSetClampMacro(PreIntegrationScalarSize, int, 2, 1024);
  vtkGetMacro(PreIntegrationScalarSize, int);
  vtkSetClampMacro(PreIntegrationLengthSize, int, 1, 128);
  vtkGetMacro(PreIntegrationLengthSize, int);
  /** @} */

  /** Which gradients light and gradient opacity go by. */
  enum GradientLocations
  {
    CellGradients = 0,
    VertexGradients = 1
  };

  /** @{ */
  /**
   * Which gradients shading and gradient opacity use: CELL_GRADIENTS, that of each cell (flat), or
   * VERTEX_GRADIENTS, the default, means around each vertex, interpolated (smooth). They are
   * computed when first needed and after a change of mesh or scalars. Lengths are measured in world
   * coordinates.
   */
  vtkSetClampMacro(Gradients, int, CellGradients, VertexGradients);
  vtkGetMacro(Gradients, int);
  /** @} */

  /** @{ */
  /**
   * Whether the table of cells on the graphics device takes 20 bytes per tetrahedron in place
   * of 32. The picture is the same. Default off.
   */
  vtkSetMacro(CompactTables, vtkTypeBool);
  vtkGetMacro(CompactTables, vtkTypeBool);
  vtkBooleanMacro(CompactTables, vtkTypeBool);
  /** @} */

  /** @{ */
  /**
   * Texels that a table on the graphics device may have, beside the limit that the device names
   * (GL_MAX_TEXTURE_BUFFER_SIZE): for drivers that promise more than they hold. A mesh with a table
   * beyond, of 8 texels per tetrahedron or 5 if compact, is drawn by the native backend, after a
   * warning with the numbers; so is an image through a membrane, which takes 2 texels per pixel.
   * Default: no limit.
   */
  vtkSetClampMacro(MaximumTableSize, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MaximumTableSize, vtkTypeInt64);
  /** @} */

  /**
   * Whether pictures of parts of a volume in this blend mode can be put one over the other: those
   * of several ranks, for example.
   */
  static bool CanRanksComposite(int blendMode);

  /** @{ */
  /**
   * Bias of pictures that are composited afterwards by arithmetic that drops fractions, as IceT's
   * does, in steps of 8 bits, 1/255. It is added to the colours and the opacity of pixels that are
   * not transparent, before these are rounded. Of N pictures, each of N - 1 blends drops half a
   * step on average, for which a bias of (N - 1) / (2 N) in every picture makes up. With a bias
   * greater than 0 no colour exceeds the opacity in any pixel of the framebuffer, so that sums do
   * not pass 255; brighter highlights of lit volumes are limited to that. In [0, 0.5], default 0:
   * the picture is not changed.
   */
  vtkSetClampMacro(ColorBias, double, 0.0, 0.5);
  vtkGetMacro(ColorBias, double);
  /** @} */

  /** @{ */
  /**
   * Opacity at which a ray ends, in [0, 1]. A pixel is off by at most 1 minus this. Default
   * 1 - 2^-17; 1 integrates every ray to its end.
   */
  vtkSetClampMacro(EarlyTerminationOpacity, double, 0.0, 1.0);
  vtkGetMacro(EarlyTerminationOpacity, double);
  /** @} */

  /** @{ */
  /**
   * Pixels between neighbouring rays, along each axis, >= 1; pixels between are interpolated.
   * Default 1. Only without AutoAdjustSampleDistances.
   */
  vtkSetClampMacro(ImageSampleDistance, float, 1.0f, 100.0f);
  vtkGetMacro(ImageSampleDistance, float);
  /** @} */

  /** @{ */
  /**
   * Whether the distance between rays follows from the time that the volume is allocated (the
   * window's desired update rate) and that the last frame took: rays are apart during interaction,
   * by up to MaximumImageSampleDistance (default 8), and one per pixel when still. Default on.
   */
  vtkSetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkSetClampMacro(MaximumImageSampleDistance, float, 1.0f, 100.0f);
  vtkGetMacro(MaximumImageSampleDistance, float);
  /** @} */

  /** Pixels between neighbouring rays in the last frame. */
  vtkGetMacro(UsedImageSampleDistance, double);

  /** @{ */
  /**
   * Work done since construction: builds of the mesh tables and updates of the scalars (when the
   * values changed, whichever object of the input was told of it by Modified(): where a
   * modification time moved, values are compared by a digest), reductions of the volume property to
   * control points, builds of the set of active cells (on a new mesh, new scalars, or when other
   * scalars become visible), computations of vertex gradients, builds of the pre-integration table;
   * of a membrane, times that its shape was taken in and fitted, and that it was found where the
   * rays meet it (when shape, view or indices changed), and that the graphics device listed where
   * they enter the mesh behind it (then, and for other active cells); times that the processor
   * listed for shaders where rays enter a mesh of which they cross many layers, such as cells that
   * share no points (for other rays or other active cells).
   */
  vtkTypeInt64 GetNumberOfMeshBuilds();
  vtkTypeInt64 GetNumberOfScalarUpdates();
  vtkTypeInt64 GetNumberOfTransferFunctionBuilds();
  vtkTypeInt64 GetNumberOfActiveSetBuilds();
  vtkTypeInt64 GetNumberOfGradientBuilds();
  vtkTypeInt64 GetNumberOfPreIntegrationBuilds();
  vtkTypeInt64 GetNumberOfMembraneBuilds();
  vtkTypeInt64 GetNumberOfSightUpdates();
  vtkTypeInt64 GetNumberOfRefractedEntryLists();
  vtkTypeInt64 GetNumberOfEntryListBuilds();
  /** @} */

  /**
   * Bytes of tables that backends took in because an input changed, since construction: mesh,
   * scalars, gradients, components, transfer function, pre-integration table. OPENGL and COMPUTE
   * count them as they are sent to the graphics device. NATIVE reads the same tables in the
   * computer's memory and counts each once when it first draws with it. A camera move adds nothing,
   * but with a membrane in view the refracted rays: 32 bytes per pixel of the image on the graphics
   * device, per pixel that the membrane covers (by tiles) natively. Images, and vertices as NATIVE
   * places them for a view, do not count.
   */
  vtkTypeInt64 GetUploadedBytes();

  /** @{ */
  /**
   * Bytes of the tables that are kept now: in the computer's memory (mesh, scalars, gradients,
   * those of the native backend; not the input itself) and on the graphics device. Images and what
   * a frame or a build takes in passing do not count.
   */
  vtkTypeInt64 GetHostBytes();
  vtkTypeInt64 GetDeviceBytes();
  /** @} */

  /** @{ */
  /**
   * Of the current mesh: tetrahedra that rays can visit, which are those that the transfer function
   * lets be seen and whose scalars are finite; tetrahedra with a scalar that is not finite; and
   * tetrahedra left out because of a point index out of range, a repeated point or a point that is
   * not finite, or because they have the points of one before them.
   */
  vtkTypeInt64 GetNumberOfActiveCells();
  vtkTypeInt64 GetNumberOfTransparentCells();
  vtkTypeInt64 GetNumberOfRejectedCells();
  /** @} */

  /** @{ */
  /**
   * Of the last frame, or part of one (RenderPart()): cells crossed, rays that entered the mesh,
   * and rays whose walk did not end on the boundary (0, as long as the graphics driver computes
   * what the shader says). Read back from the graphics device when first asked for after a frame; 0
   * without one.
   */
  vtkTypeInt64 GetNumberOfTraversalSteps();
  vtkTypeInt64 GetNumberOfRays();
  vtkTypeInt64 GetNumberOfLostRays();
  /** @} */

  /**
   * Draws the volume into the current framebuffer and viewport; in a hardware selection pass, the
   * prop's id wherever the volume is visible. Input that cannot be drawn gives an error and leaves
   * the picture as it is. While a mesh's tables are built, ProgressEvent is invoked;
   * AbortExecuteOn(), called by an observer, or the window's abort status ends that. Then nothing
   * is drawn, and the next call begins again.
   */
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  /** What RenderPart() draws. */
  enum MembraneParts
  {
    WHOLE = 0,   ///< all that there is to see
    InFront = 1, ///< what rays come to before the membrane or beside it
    BEHIND = 2   ///< what rays come to behind the membrane; nothing without one
  };
  /**
   * Render(), but one part only, for those who draw the membrane between them: vtkRefractionPass.
   */
  void RenderPart(vtkRenderer* renderer, vtkVolume* volume, int part);

  /** Frees all graphics resources; the next Render() makes them again. */
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkTetrahedraRayCastMapper();
  ~vtkTetrahedraRayCastMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkTetrahedraRayCastMapper(const vtkTetrahedraRayCastMapper&) = delete;
  void operator=(const vtkTetrahedraRayCastMapper&) = delete;

  meniscus::ScalarSelection SelectedScalars();
  bool CollectInput(meniscus::InputBlocks& parts);
  bool Tell(const meniscus::InputReport& report);
  bool ChooseMixture(const meniscus::InputBlocks& parts, vtkVolume* volume);
  bool HasChosenComponent(const meniscus::InputBlocks& parts);
  void WarnOnce(bool condition, bool& warned, const char* text);
  void WarnAboutUnavailable();
  void ChooseIntegration(vtkVolume* volume, meniscus::RayCastOptics& optics);
  bool HasMembrane();
  bool UpdateMembrane();
  void PrepareRefraction(const meniscus::ViewContext& place, meniscus::RayCastFrame& frame);
  bool UpdateInput(vtkRenderWindow* window, vtkVolume* volume, const meniscus::InputBlocks& parts);
  void UpdateTransferFunction();
  const meniscus::BlendModel& GetBlendModel();
  int ChooseBackend();
  bool FallsBackToNative(const meniscus::RayCastFrame& frame, std::string& error);
  double ChooseImageSampleDistance(vtkVolume* volume);
  std::string PrepareFrame(vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame);
  bool Draw(vtkRenderer* renderer, vtkVolume* volume, const meniscus::InputBlocks& parts);

  int VectorMode = DISABLED;
  int VectorComponent = 0;
  int OpacityModel = AttenuationCoefficient;
  int Backend = AUTOMATIC;
  int ActiveBackend = AUTOMATIC;
  int Integration = EXACT;
  int PreIntegrationScalarSize = 256;
  int PreIntegrationLengthSize = 16;
  int Gradients = VertexGradients;
  double ExteriorIndexOfRefraction = 1.0;
  double InteriorIndexOfRefraction = 1.333;
  int MembranePart = WHOLE;
  double EarlyTerminationOpacity = 1.0 - 1.0 / 131072.0;
  float ImageSampleDistance = 1.0f;
  float MaximumImageSampleDistance = 8.0f;
  vtkTypeBool AutoAdjustSampleDistances = 1;
  vtkTypeBool CompactTables = 0;
  double ColorBias = 0.0;
  vtkTypeInt64 MaximumTableSize; // VTK's wrapper generator stumbles over its default here
  double UsedImageSampleDistance = 1.0;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

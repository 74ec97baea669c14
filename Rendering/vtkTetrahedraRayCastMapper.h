// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastMapper
 * @brief   volume-renders a tetrahedral vtkUnstructuredGrid by exact ray casting
 *
 * Casts one ray per pixel through the mesh, from cell to cell across shared faces, and integrates
 * the density-emitter model in closed form. The image does not depend on a sampling distance.
 *
 * Input: a vtkUnstructuredGrid, structured, rectilinear or image grid, or a composite data set
 * whose leaves make one mesh and may interlock; leaves without the array are left out with a
 * warning. The scalar mode and array selection of vtkAbstractVolumeMapper choose a point or cell
 * array. SetVectorMode() or the colour function chooses one of several components or their length,
 * or two to four are mixed as described below. Point data is linear within each tetrahedron, cell
 * data constant within each cell. Tetrahedra are drawn directly; voxels, hexahedra, wedges,
 * pyramids, prisms, polyhedra and quadratic cells are split into tetrahedra that have the same
 * points and match across shared faces. With SetCellDivision() they are divided until the
 * tetrahedra follow the cells' shape functions, also of Lagrange and Bezier cells. Other cells are
 * left out with a warning. Any mesh is accepted: non-convex, disconnected, cyclic, with inverted
 * cells, cells of zero volume, duplicate points and faces of more than two cells. Cells that
 * vtkGhostType marks as duplicate, hidden or refined are left out. Cells with a point index out of
 * range, a repeated point, a point that is not finite, a number of points that their type does not
 * have, or faces that are incomplete are left out and counted. Cells with a scalar that is not
 * finite, their own or a vertex's, are transparent and counted.
 *
 * Optical model, selected by SetBlendMode() with the values of vtkVolumeMapper::BlendModes:
 * - COMPOSITE_BLEND: colour and opacity come from the vtkVolumeProperty. Opacity is converted to an
 *   attenuation coefficient per ScalarOpacityUnitDistance, as selected by SetOpacityModel().
 *   Emitted colour is weighted by the attenuation. If Shade is on, the colour is lit by the
 *   renderer's lights with the property's material (Phong's model, two-sided). The gradient opacity
 *   function, whose argument is the gradient's length in scalar per world length, multiplies the
 *   attenuation; without points it is 0, as in VTK. See SetGradients().
 * - MAXIMUM_INTENSITY_BLEND, MINIMUM_INTENSITY_BLEND, AVERAGE_INTENSITY_BLEND: the largest or
 *   smallest scalar along the ray, or its mean over the length, mapped to colour and opacity by the
 *   property; opacity does not depend on the length.
 * - ADDITIVE_BLEND: the integral of opacity / ScalarOpacityUnitDistance times the scalar, mapped
 *   from the data's range to [0, 1], as an opaque grey level.
 * - ISOSURFACE_BLEND: surfaces at the property's IsoSurfaceValues, with its colour and opacity at
 *   these values; lit if Shade is on. For cell data, they are the faces shared by two cells whose
 *   values lie on either side of an isovalue.
 *
 * Cell data has no gradient: Shade applies to isosurfaces, and with GlobalIlluminationReach to the
 * light that a medium scatters; gradient opacity has no effect.
 *
 * Several components, with COMPOSITE_BLEND, by vtkVolumeProperty's IndependentComponents: if on,
 * and if a component beyond the first has a colour or opacity function (see SetVectorMode()), two
 * to four scalars, each with its own functions and weight, as media in the same place (attenuations
 * and emissions are added). Such media are lit with GlobalIlluminationReach only. If off, there are
 * two components, the first for colour and the second for opacity, or four: the first three are the
 * colour (unsigned char, or 0 to 1), the fourth is for opacity. Lighting then uses the gradient of
 * the last component. See Documentation/volume.md.
 *
 * Lengths are measured in world coordinates. Output is premultiplied RGBA, blended over the
 * contents of the framebuffer; rays end at opaque geometry in it. Clipping planes cut cells
 * exactly. A transfer function that is not piecewise linear (HSV, Lab or diverging space,
 * logarithmic scale, midpoint, sharpness, OPACITY_PER_UNIT_DISTANCE) is sampled between its nodes
 * until the error of linear interpolation is less than 1/32768 of the full range of colour and of
 * alpha over the unit distance.
 *
 * A segment is split at the transfer function's nodes, and each piece is integrated in closed form
 * up to an error of 3e-7; with several components, by Gauss' rule up to 1e-6. SetIntegration()
 * selects a table instead. See Documentation/volume-method.md.
 *
 * Where cells overlap (inverted cells, overlapping parts), the cell that the ray entered first is
 * used up to its exit. Cells that cannot be seen, because the transfer function has no opacity
 * anywhere in their range of scalars, are not visited and occlude nothing.
 *
 * After: M. Weiler, M. Kraus, M. Merz, T. Ertl, "Hardware-Based Ray Casting for Tetrahedral
 * Meshes", IEEE Visualization 2003; K. Moreland, E. Angel, "A Fast High Accuracy Volume Renderer
 * for Unstructured Data", 2004.
 *
 * Requires OpenGL 3.2; the native backend casts rays on the CPU and uses OpenGL only to show the
 * image. Tables are built only when their input changes: see the counters.
 *
 * @note Limits: 32 clipping planes; 16 lights; several components with composite blending of
 *   point data only; fewer than 2^29 tetrahedra; on the graphics device, tables within
 *   GL_MAX_TEXTURE_BUFFER_SIZE.
 *
 * @sa vtkProjectedTetrahedraMapper vtkUnstructuredGridVolumeRayCastMapper vtkVolumeProperty
 */
#ifndef vtkTetrahedraRayCastMapper_h
#define vtkTetrahedraRayCastMapper_h

#include "OpacityModel.h"      // For meniscusOpacityModelMacro
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // for vtkSmartPointer
#include "vtkUnstructuredGridVolumeMapper.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkRefractingInterfaceCollection;
class vtkCompositeDataSet;
class vtkDataSet;
class vtkPolyData;
class vtkRenderWindow;
class vtkTable;

namespace meniscus
{
struct BlendModel;
struct DeviceTableLimits;
struct InputBlocks;
struct InputReport;
enum class MembranePart;
struct PointBox;
class RayCastMembrane;
struct RayCastFrame;
struct ViewContext;
struct RayCastOptics;
struct RefractionMedium;
struct ScalarSelection;
struct VolumePick;
}

class VTKMENISCUS_EXPORT vtkTetrahedraRayCastMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  static vtkTetrahedraRayCastMapper* New();
  vtkTypeMacro(vtkTetrahedraRayCastMapper, vtkUnstructuredGridVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkUnstructuredGridVolumeMapper::SetInputData;
  /** @{ */
  /** Set the input without a pipeline: a data set with three-dimensional cells, or a composite. */
  void SetInputData(vtkDataSet* input) override;
  void SetInputData(vtkCompositeDataSet* input);
  /** @} */

  /** @{ */
  /**
   * Set a surface at which rays are refracted (the membrane, port 1), by connection or as data:
   * triangles, or polygons and strips, which are split into triangles, in world coordinates. Its
   * point normals are used if present, otherwise they are computed; it is curved between its
   * points, as in vtkRefractedGeometryFilter::CURVED. Default is null: no membrane. The port is
   * repeatable; see SetInterfaces() for several surfaces.
   *
   * A pixel's ray is straight up to its first intersection with the membrane, so the part of the
   * mesh in front of it is drawn as without a membrane. There it is refracted by Snell's law and
   * continues through the mesh. Where it is totally reflected, nothing behind the membrane is
   * drawn; rays that miss the membrane are straight. Geometry in the framebuffer behind the
   * membrane is taken as virtual geometry, see SetInterfaces(). A membrane that is itself drawn
   * opaque occludes everything behind it.
   *
   * The mapper's bounds include the membrane's, where the volume is seen. A membrane that cannot be
   * used is an error, and nothing is rendered.
   */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMembraneData(vtkPolyData* membrane);
  void AddMembraneConnection(vtkAlgorithmOutput* output) { this->AddInputConnection(1, output); }
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes() { this->RemoveAllInputConnections(1); }
  vtkPolyData* GetMembrane();
  vtkPolyData* GetMembrane(int i);
  int GetNumberOfMembranes();
  /** @} */

  /** @{ */
  /**
   * Set/Get the indices of refraction: exterior, on the side to which the membrane's normals point,
   * default 1.0; and interior, on the other side, default 1.333. If there are several interfaces,
   * these are the indices of the first one. Must be positive and finite; other values are an error
   * if there is a membrane. If the indices are equal, the membrane changes nothing and costs
   * nothing.
   */
  virtual void SetExteriorIndexOfRefraction(double index);
  virtual double GetExteriorIndexOfRefraction();
  virtual void SetInteriorIndexOfRefraction(double index);
  virtual double GetInteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the refracting interfaces, such as the two faces of a pane, in the order in which rays
   * meet them; vtkRefractingInterfaceCollection describes how rays pass the list. The interface of
   * number i has the surface of connection i of port 1, and the list must be as long as there are
   * connections. Null, the default, stands for a list of one with default values.
   *
   * Rays that miss the first interface are straight. Those that are totally reflected at an
   * interface, or miss a further one, are counted: see GetStatistics(). Geometry in the framebuffer
   * behind the first interface is virtual geometry, such as vtkRefractedGeometryFilter's: a point
   * in the medium of index n is drawn at n0 / n times the length of its path behind the interface
   * (n0: index of the eye's medium; the thesis's Eq. 2.4), and these lengths add up.
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /** Modification time of this mapper and of the interfaces. */
  vtkMTimeType GetMTime() override;

  /** @{ */
  /**
   * Bounds of the cells of the input that are drawn (of all leaves of a composite data set) and of
   * all membranes. Points that no cells use, or only hidden cells and cells without volume, do not
   * count. Not initialized if there are no cells to draw.
   */
  double* GetBounds() VTK_SIZEHINT(6) override;
  void GetBounds(double bounds[6]) override { this->Superclass::GetBounds(bounds); }
  /** @} */

  /** Part of an array of several components that is drawn. */
  enum
  {
    DISABLED = -1,
    MAGNITUDE = 0,
    COMPONENT = 1
  };

  /** @{ */
  /**
   * Set/Get the part of an array of several components that is drawn, as in vtkSmartVolumeMapper.
   * MAGNITUDE is the length of the vector (a single component keeps its sign). COMPONENT is the
   * component with the number VectorComponent (from 0, the default). Both take precedence over the
   * volume's property.
   *
   * DISABLED, the default, leaves the choice to the property. If its IndependentComponents is off,
   * two or four components are mixed (see the class). If it is on, the first colour function
   * decides, as in vtkProjectedTetrahedraMapper: with MAGNITUDE of
   * vtkScalarsToColors::SetVectorMode() the length is drawn, with COMPONENT the component of
   * SetVectorComponent(), using the functions of the first component. With COMPONENT 0, the default
   * of every colour function, two to four components are mixed if the property has a colour or
   * opacity function for a further one; otherwise the first component is drawn.
   */
  virtual void SetVectorMode(int mode);
  vtkGetMacro(VectorMode, int);
  void SetVectorModeToDisabled() { this->SetVectorMode(DISABLED); }
  void SetVectorModeToMagnitude() { this->SetVectorMode(MAGNITUDE); }
  void SetVectorModeToComponent() { this->SetVectorMode(COMPONENT); }
  virtual void SetVectorComponent(int component);
  vtkGetMacro(VectorComponent, int);
  /** @} */

  /** Division of cells that are not linear tetrahedra. */
  enum
  {
    FIXED_DIVISION = 0,   ///< into tetrahedra between the points of the cell
    ADAPTIVE_DIVISION = 1 ///< into tetrahedra that follow its shape functions
  };

  /** @{ */
  /**
   * Set/Get the division of cells. FIXED_DIVISION, the default, adds no points: the scalar is
   * linear in each of the tetrahedra, whose edges can be seen in hexahedra. ADAPTIVE_DIVISION
   * halves edges until the tetrahedra follow VTK's shape functions of the cells (voxels, hexahedra,
   * wedges, pyramids, quadratic, Lagrange and Bezier cells) within the tolerance, without cracks
   * between neighbours. Cells are divided when the mesh is built, and again only if moved points,
   * other scalars or another property exceed twice the error; otherwise the values of the new
   * points are interpolated. Lagrange and Bezier cells above order 1 have no fixed division: if
   * there are any, all cells above order 1 are divided adaptively. See Documentation/true-cells.md.
   */
  virtual void SetCellDivision(int division);
  vtkGetMacro(CellDivision, int);
  void SetCellDivisionToFixed() { this->SetCellDivision(FIXED_DIVISION); }
  void SetCellDivisionToAdaptive() { this->SetCellDivision(ADAPTIVE_DIVISION); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the tolerance of ADAPTIVE_DIVISION, > 0: the largest error of the picture along edges
   * of the tetrahedra, as a fraction of full colour or opacity. Differences of the scalar are seen
   * through the volume's property: for a medium, relative to its density, or to one optical depth
   * per length of the mesh's diagonal if that is more. With several components that are mixed they
   * are fractions of each component's range. A displacement counts four times, as a fraction of the
   * diagonal. Default is 1/256: a step of an 8-bit channel, and a pixel of a picture in which the
   * mesh is 1024 pixels long. A tolerance that is not positive is an error.
   */
  vtkSetMacro(DivisionTolerance, double);
  vtkGetMacro(DivisionTolerance, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the budget of ADAPTIVE_DIVISION: the largest number of tetrahedra that it makes. They
   * are spent where errors are largest. If the budget ends the division before the tolerance is
   * reached, a warning reports the error, which is the statistic "DivisionError". While cells are
   * divided, each takes up to 250 bytes. Default is 0: twice as many as FIXED_DIVISION makes, but
   * at least 100,000.
   */
  virtual void SetMaximumNumberOfPieces(vtkTypeInt64 pieces);
  vtkGetMacro(MaximumNumberOfPieces, vtkTypeInt64);
  /** @} */

  /** @{ */
  /**
   * Set/Get the meaning of an opacity of the transfer function over a length L, with the property's
   * ScalarOpacityUnitDistance as unit: ATTENUATION_COEFFICIENT, the default and VTK's definition
   * for unstructured grids, alpha = 1 - exp(-L * opacity / unit); OPACITY_PER_UNIT_DISTANCE, VTK's
   * definition for image data, alpha = 1 - (1 - opacity)^(L / unit), for opacities up to 1 - 2^-24.
   */
  meniscusOpacityModelMacro();
  /** @} */

  /** Implementation that casts the rays. */
  enum
  {
    AUTOMATIC = 0,
    OPENGL = 1,
    NATIVE = 2,
    COMPUTE = 3,
    REGISTERED = 1000 ///< registered from outside; a value of GetActiveBackend() only
  };

  /** @{ */
  /**
   * Set/Get the implementation of the ray caster: OPENGL, a fragment shader; COMPUTE, a compute
   * shader with the same functions (OpenGL 4.3); NATIVE, the CPU, in SIMD packets on all threads of
   * vtkSMPTools; AUTOMATIC, the default: backends that were registered from outside (see
   * RayCastBackendRegistry.h), then NATIVE where OpenGL is a software rasteriser, else COMPUTE
   * where the window has OpenGL 4.3, else OPENGL. If a backend cannot draw a frame, the next one
   * does, after a warning with the reason.
   */
  virtual void SetBackend(int backend);
  vtkGetMacro(Backend, int);
  void SetBackendToAutomatic() { this->SetBackend(AUTOMATIC); }
  void SetBackendToOpenGL() { this->SetBackend(OPENGL); }
  void SetBackendToNative() { this->SetBackend(NATIVE); }
  void SetBackendToCompute() { this->SetBackend(COMPUTE); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the name of the backend to use in place of SetBackend(): "OpenGL", "Compute", "Native"
   * or a registered name; others warn and draw as AUTOMATIC. Empty, the default: SetBackend()
   * decides.
   */
  vtkSetStdStringFromCharMacro(BackendName);
  vtkGetCharFromStdStringMacro(BackendName);
  /** @} */

  /** @{ */
  /** Backend of the last Render() and its name; AUTOMATIC and empty before the first. */
  vtkGetMacro(ActiveBackend, int);
  vtkGetCharFromStdStringMacro(ActiveBackendName);
  /** @} */

  /** Integration of ray segments. */
  enum
  {
    EXACT = 0,
    PRE_INTEGRATED = 1
  };

  /** @{ */
  /**
   * Set/Get the integration of ray segments: EXACT, the default, in closed form; PRE_INTEGRATED, by
   * a table as in the paper, over the scalars at both ends of a segment and its length
   * (SetPreIntegrationScalarSize(), SetPreIntegrationLengthSize()). The table is built when the
   * transfer function, a size or the longest edge of the volume in world coordinates has changed.
   * It exists for composite blending of one component, without lighting, without gradient opacity
   * and without a medium behind a membrane; otherwise segments are integrated exactly, after a
   * warning if PRE_INTEGRATED would have made a difference.
   */
  virtual void SetIntegration(int integration);
  vtkGetMacro(Integration, int);
  void SetIntegrationToExact() { this->SetIntegration(EXACT); }
  void SetIntegrationToPreIntegrated() { this->SetIntegration(PRE_INTEGRATED); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the number of samples of the pre-integration table: of the range of the data's scalars,
   * in [2, 1024], default 256, and of the length of a segment, in [1, 128], default 16. With one
   * length, the absorption of a segment's own emission is neglected in its colour, but not in its
   * opacity. The table has one length, whatever the setting, if that is as accurate: if all visible
   * scalars have one colour, or if no segment is deeper than 1/64. It takes 16 bytes times the
   * number of lengths times the square of the number of scalars.
   */
  virtual void SetPreIntegrationScalarSize(int size);
  vtkGetMacro(PreIntegrationScalarSize, int);
  virtual void SetPreIntegrationLengthSize(int size);
  vtkGetMacro(PreIntegrationLengthSize, int);
  /** @} */

  /** Gradients that lighting and gradient opacity use. */
  enum
  {
    CELL_GRADIENTS = 0,
    VERTEX_GRADIENTS = 1
  };

  /** @{ */
  /**
   * Set/Get the gradients that lighting and gradient opacity use: CELL_GRADIENTS, constant in each
   * cell (flat), or VERTEX_GRADIENTS, the default, means around each vertex, interpolated (smooth).
   * They are computed when first needed and after a change of mesh or scalars. Lengths are measured
   * in world coordinates.
   */
  virtual void SetGradients(int gradients);
  vtkGetMacro(Gradients, int);
  void SetGradientsToCellGradients() { this->SetGradients(CELL_GRADIENTS); }
  void SetGradientsToVertexGradients() { this->SetGradients(VERTEX_GRADIENTS); }
  /** @} */

  /** True if pictures of parts of a volume, such as pictures by several ranks, can be blended. */
  static bool CanRanksComposite(int blendMode);

  /** @{ */
  /**
   * Set/Get the bias of images that are composited afterwards by arithmetic that truncates
   * fractions, such as IceT's, in steps of 8 bits, 1/255. It is added to the colours and the
   * opacity of pixels that are not transparent, before these are rounded. With N images, each of
   * the N - 1 blends loses half a step on average, for which a bias of (N - 1) / (2 N) in every
   * image compensates. With a bias greater than 0, no colour exceeds the opacity in any pixel of
   * the framebuffer, so that sums do not exceed 255; brighter highlights of lit volumes are limited
   * to that. In [0, 0.5]. Default is 0.
   */
  virtual void SetColorBias(double bias);
  vtkGetMacro(ColorBias, double);
  /** @} */

  /** Depths that frames write; the places have the numbers of vtkTetrahedraVolumePicker. */
  enum
  {
    NO_DEPTH = -1,
    FIRST_VISIBLE_DEPTH = 0,
    OPACITY_DEPTH = 1
  };

  /** @{ */
  /**
   * Set/Get the depth that a frame writes to the window's depth buffer, so that everything that
   * reads it afterwards sees the volume: props that are drawn later, render passes,
   * vtkWorldPointPicker. FIRST_VISIBLE_DEPTH and OPACITY_DEPTH are the places of
   * vtkTetrahedraVolumePicker, the latter at the accumulated opacity DepthOpacity. Behind
   * refracting surfaces it is the depth at which the place is drawn.
   *
   * The depths are computed on the processor whatever the backend is, by one more cast of every
   * image. Volumes that are drawn after this one end at its depth. Default is NO_DEPTH, which costs
   * nothing; the default of DepthOpacity is 0.5.
   */
  virtual void SetDepthWriting(int writing);
  vtkGetMacro(DepthWriting, int);
  void SetDepthWritingToNoDepth() { this->SetDepthWriting(NO_DEPTH); }
  void SetDepthWritingToFirstVisibleDepth() { this->SetDepthWriting(FIRST_VISIBLE_DEPTH); }
  void SetDepthWritingToOpacityDepth() { this->SetDepthWriting(OPACITY_DEPTH); }
  virtual void SetDepthOpacity(double opacity);
  vtkGetMacro(DepthOpacity, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the opacity at which a ray ends, in [0, 1]. The error of a pixel is at most 1 minus
   * this. Default is 1 - 2^-17, or 1 - 2^-9 in images that AutoAdjustSampleDistances makes coarse.
   * With 1, every ray is integrated to its end.
   */
  virtual void SetEarlyTerminationOpacity(double opacity);
  vtkGetMacro(EarlyTerminationOpacity, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get how far shadows reach in a volume whose property shades, as a fraction of the diameter
   * of a sphere about the volume, in [0, 1]; VTK's name and range. Each light is attenuated by the
   * medium, or by the isosurfaces, on this part of its way to the vertices of the mesh (isosurfaces
   * of cell data: to the middles of the cells), and the ambient light by the mean over 32
   * directions (ambient occlusion); Documentation/volume.md has the rules for several lights and
   * for changes. Default is 0: light is not attenuated; NaN counts as 0. Media of cell data and of
   * independent components, which have no gradient, are lit by scattered light alone.
   */
  void SetGlobalIlluminationReach(float reach);
  vtkGetMacro(GlobalIlluminationReach, float);
  /** @} */

  /** @{ */
  /**
   * Set/Get the share of light that a medium scatters, in [0, 2]; VTK's name and range. 0, the
   * default: light is reflected at the gradient, as without shadows; 2: it is scattered, once, by
   * Henyey and Greenstein's phase function of the property's ScatteringAnisotropy (0 in VTK before
   * 9.2); 1: half of each; linear in between. Used with GlobalIlluminationReach only. NaN counts as
   * 0.
   */
  void SetVolumetricScatteringBlending(float blending);
  vtkGetMacro(VolumetricScatteringBlending, float);
  /** @} */

  /** @{ */
  /**
   * Set/Get the number of pixels between neighbouring rays, along each axis, in [0.1, 100]; NaN
   * counts as 1, the default. With more than 1, the pixels between are interpolated. With less than
   * 1, pixels at edges, which differ from their neighbours, get a square of rays at most this
   * distance apart, and the mean of their colours: 0.25 stands for 16 rays. With
   * AutoAdjustSampleDistances, distances below 1 are for still images, and others are ignored.
   */
  virtual void SetImageSampleDistance(float distance);
  vtkGetMacro(ImageSampleDistance, float);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the distance between rays is computed from the time allocated to the volume
   * (the window's desired update rate) and the time of the last frame: during interaction rays are
   * up to MaximumImageSampleDistance pixels apart (default 8), in still images (less than one
   * frame per second is wanted) there is one per pixel, or more with an ImageSampleDistance below
   * 1. The native backend interpolates rays of such coarse images between others that differ
   * little, unless EarlyTerminationOpacity has been set. Default is on. If an observer of the
   * window's AbortCheckEvent gives up a still image, the native backend keeps the tiles that it has
   * cast; the next frames of this view cast the others.
   */
  vtkSetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  virtual void SetMaximumImageSampleDistance(float distance);
  vtkGetMacro(MaximumImageSampleDistance, float);
  /** @} */

  /** @{ */
  /**
   * Counters of work done since construction, see GetStatistics(). Equal cells in new arrays, as
   * readers make them in each time step, are the same mesh.
   */
  vtkTypeInt64 GetNumberOfMeshBuilds();
  vtkTypeInt64 GetNumberOfScalarUpdates();
  vtkTypeInt64 GetNumberOfTransferFunctionBuilds();
  vtkTypeInt64 GetNumberOfActiveSetBuilds();
  /** @} */

  /**
   * Number of bytes of tables that backends have read because an input changed, since construction:
   * mesh, scalars, gradients, components, transfer function, pre-integration table. NATIVE counts
   * each when it first draws with it. A camera move adds nothing, except for the refracted rays if
   * a membrane is in view, for each interface: 32 bytes per pixel of the image on the graphics
   * device, per pixel that the membrane covers (by tiles) natively. Images are not counted.
   */
  vtkTypeInt64 GetUploadedBytes();

  /** @{ */
  /**
   * Numbers of tetrahedra of the current mesh: visible ones with finite scalars, which rays can
   * visit; and those left out because they are not valid (see the class) or have the points of an
   * earlier tetrahedron. Cells that cannot be divided into tetrahedra count once each.
   */
  vtkTypeInt64 GetNumberOfActiveCells();
  vtkTypeInt64 GetNumberOfRejectedCells();
  /** @} */

  /** @{ */
  /**
   * Numbers of the image of the last frame: cells crossed, rays that entered the mesh, and rays
   * whose walk did not end on the boundary (0 unless the graphics driver deviates from the shader's
   * arithmetic). They are read back from the graphics device when first requested after a frame; 0
   * before the first frame.
   */
  vtkTypeInt64 GetNumberOfTraversalSteps();
  vtkTypeInt64 GetNumberOfRays();
  vtkTypeInt64 GetNumberOfLostRays();
  /** @} */

  /** @{ */
  /**
   * Counters, sizes and errors by name: a table with one row each and the columns Name, Meaning and
   * Value, which belongs to this object and is filled anew by each call; and the value of one name,
   * such as "NumberOfCastImages". An unknown name is an error, and the value is not a number.
   *
   * A frame that differs from the last one neither in camera, mesh, scalars, property, lights,
   * clipping planes, membrane, settings nor in the depths of opaque geometry casts no rays and
   * shows the last image again. If only depths differ, the native backend casts the tiles of 32 x
   * 32 pixels in which they differ; other backends cast the whole image. OpenGL backends need two
   * repetitions. After Modified() the next frame is cast in any case.
   */
  vtkTable* GetStatistics();
  double GetStatistic(const char* name);
  /** @} */

  /**
   * Draws the volume into the current framebuffer and viewport; in a hardware selection pass, the
   * prop's id wherever the volume is visible. Input that cannot be drawn causes an error and leaves
   * the image unchanged. While the tables of a mesh are built, ProgressEvent is invoked; an
   * observer's AbortExecuteOn() or the window's abort status ends the build: nothing is drawn, and
   * the next call begins again.
   */
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  /** Share of the light that the medium behind the membrane transmits over a distance d. */
  enum
  {
    EXPONENTIAL = 0, ///< exp(-k d), with k of MediumAttenuationCoefficients
    LINEAR = 1       ///< 1 up to MediumRange[0], 0 from MediumRange[1] on, linear in between
  };

  /** @{ */
  /**
   * Set/Get the medium behind the membrane, through which refracted rays see the volume, with
   * COMPOSITE_BLEND and ISOSURFACE_BLEND: light of the colour c that is emitted at a path length d
   * behind the first sight point is seen as s c + (1 - s) M, with the medium's colour M
   * (MediumColor, default black) and the share s of the medium's model (MediumModel, default
   * EXPONENTIAL). The opacity of the volume is not changed. So a volume looks like an object of the
   * same colour that vtkRefractionPass draws at the same place, and what lies behind the volume
   * must have been faded by its own distance, as by that pass.
   *
   * The coefficients per world length, of red, green and blue, belong to EXPONENTIAL and are >= 0.
   * Zeros, the default, stand for the medium of the vtkRefractionPass that draws the volume, and
   * for a clear medium without one. The range of LINEAR is 0 <= MediumRange[0] <= MediumRange[1],
   * default (0, 1). Numbers without a meaning are an error of Render(), which then draws a clear
   * medium. A clear medium, straight rays and other blend modes cost nothing.
   */
  virtual void SetMediumModel(int model);
  vtkGetMacro(MediumModel, int);
  void SetMediumModelToExponential() { this->SetMediumModel(EXPONENTIAL); }
  void SetMediumModelToLinear() { this->SetMediumModel(LINEAR); }
  vtkSetVector3Macro(MediumAttenuationCoefficients, double);
  vtkGetVector3Macro(MediumAttenuationCoefficients, double);
  vtkSetVector2Macro(MediumRange, double);
  vtkGetVector2Macro(MediumRange, double);
  vtkSetVector3Macro(MediumColor, double);
  vtkGetVector3Macro(MediumColor, double);
  /** @} */

  /** Frees all graphics resources; the next Render() creates them again. */
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkTetrahedraRayCastMapper();
  ~vtkTetrahedraRayCastMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkTetrahedraRayCastMapper(const vtkTetrahedraRayCastMapper&) = delete;
  void operator=(const vtkTetrahedraRayCastMapper&) = delete;

  meniscus::ScalarSelection SelectedScalars();
  meniscus::PointBox MeasureInput();
  bool CollectInput(meniscus::InputBlocks& parts);
  bool Tell(const meniscus::InputReport& report);
  bool ChooseMixture(const meniscus::InputBlocks& parts, vtkVolume* volume);
  bool HasChosenComponent(const meniscus::InputBlocks& parts);
  void WarnOnce(bool condition, bool& warned, const char* text);
  void WarnAboutUnavailable();
  void ChooseIntegration(vtkVolume* volume, meniscus::RayCastOptics& optics);
  bool UpdateMembrane(meniscus::RayCastMembrane& membrane);
  void UpdateMedium();
  void PrepareRefraction(const meniscus::ViewContext& place, meniscus::RayCastFrame& frame);
  bool UpdateInput(vtkRenderWindow* window, vtkVolume* volume, const meniscus::InputBlocks& parts);
  void UpdateTransferFunction();
  const meniscus::BlendModel& GetBlendModel();
  double ChooseImageSampleDistance(vtkVolume* volume);
  bool IsCoarse(vtkVolume* volume, double sampleDistance);
  double GetShareOfOneRay(vtkTypeInt64 casts);
  std::string PrepareView(vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame);
  std::string PrepareFrame(vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame);
  std::string DrawFrame(meniscus::RayCastFrame& frame, const meniscus::InputBlocks& parts);
  bool GoOn(vtkRenderWindow* window, double fraction);
  void PrepareIllumination(vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame);
  bool UpdateIllumination(meniscus::RayCastFrame& frame);
  bool Draw(vtkRenderer* renderer, vtkVolume* volume, const meniscus::InputBlocks& parts);
  friend class vtkTetrahedraVolumePicker;
  friend class vtkRefractionPass;
  friend struct meniscus::DeviceTableLimits; // of the tests
  /** As Render(), but only a part of the volume, behind a medium if the mapper's own is clear. */
  void RenderPart(vtkRenderer* renderer, vtkVolume* volume, meniscus::MembranePart part,
    const meniscus::RefractionMedium& surroundings);
  std::string WriteDepths(const meniscus::RayCastFrame& frame);
  bool UpdateForPick(vtkRenderer* renderer, vtkVolume* volume, meniscus::InputBlocks& parts);
  bool CastPick(vtkRenderer* renderer, vtkVolume* volume, meniscus::VolumePick& pick);

  int CellDivision = FIXED_DIVISION;
  double DivisionTolerance = 1.0 / 256.0;
  vtkTypeInt64 MaximumNumberOfPieces = 0;
  int VectorMode = DISABLED;
  int VectorComponent = 0;
  int OpacityModel = ATTENUATION_COEFFICIENT;
  int Backend = AUTOMATIC;
  int ActiveBackend = AUTOMATIC;
  std::string BackendName;
  std::string ActiveBackendName;
  int Integration = EXACT;
  int PreIntegrationScalarSize = 256;
  int PreIntegrationLengthSize = 16;
  int Gradients = VERTEX_GRADIENTS;
  int MediumModel = EXPONENTIAL;
  double MediumAttenuationCoefficients[3] = { 0.0, 0.0, 0.0 };
  double MediumRange[2] = { 0.0, 1.0 };
  double MediumColor[3] = { 0.0, 0.0, 0.0 };
  double EarlyTerminationOpacity;
  float GlobalIlluminationReach = 0.0f;
  float VolumetricScatteringBlending = 0.0f;
  float ImageSampleDistance = 1.0f;
  float MaximumImageSampleDistance = 8.0f;
  vtkTypeBool AutoAdjustSampleDistances = 1;
  bool CompactCells = false;     // even if the table of full cells fits on the device
  vtkTypeInt64 MaximumTableSize; // VTK's wrapper generator cannot parse its default here
  double ColorBias = 0.0;
  int DepthWriting = NO_DEPTH;
  double DepthOpacity = 0.5;
  double UsedImageSampleDistance = 1.0;
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

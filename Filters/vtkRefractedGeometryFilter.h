// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractedGeometryFilter
 * @brief   virtual geometry of what lies behind a refracting surface
 *
 * Moves every point of the geometry to where an eye sees it through a refracting surface, the
 * membrane: into the right pixel, at the apparent depth. Drawn with the same eye, the output shows
 * the refracted scene without tracing a ray.
 *
 * Input port 0 is the geometry, a vtkPolyData with vertices, lines, polygons and triangle strips;
 * composite data runs block by block. Input port 1 is the membrane, a vtkPolyData with triangles,
 * polygons or strips that separate the eye's medium (exterior) from that of the geometry
 * (interior). Its normals point to the eye's side: its point normals are used where they are valid,
 * others are computed from the facets' winding; where most do not fit the triangles around them, as
 * after a filter that moves points only, a warning says so. Facets that are wound the other way
 * than most of their piece, and normals on the other side than most, are turned, with a warning; a
 * one-sided surface (a Moebius band) is an error. A closed membrane is a body of the interior
 * medium, or a bubble of the exterior one, as its normals say; what is beyond it is shown
 * unchanged. Ghost levels of the membrane are not asked for.
 *
 * The output shows every image of the geometry (ALL_IMAGES), or one per point with the input's own
 * connectivity (FIRST_IMAGE), with all point and cell arrays. Each image of a point of a vertex
 * cell is a cell of its own. With ALL_IMAGES a line or polygon whose points have one image each,
 * and which is straight enough between them, keeps its points; any other becomes the pieces that
 * the membrane shows of it, strips as triangles, and what it has on the eye's side of the membrane
 * passes unchanged. Arrays are interpolated at the points that this makes; arrays of ids, of which
 * there are none in between, take the nearest point's. Point arrays added:
 * - `SightPoint` (3 doubles, world): where the light leaves the membrane towards the eye;
 * - `RefractionDepth` (1 double, world length, >= 0): from sight point to true point, the path in
 * the interior that attenuation should use;
 * - `Reflectance` (1 double, 0 to 1): unpolarised Fresnel reflectance at the sight point, 1 beyond
 *   the critical angle; or Schlick's approximation of it;
 * - `SightFacet` (1 id): the membrane's cell that holds the sight point, -1 for a point on the
 * eye's side that passed unchanged;
 * - `SourcePointId` (1 id): the point of the input, -1 for a point that clipping made.
 *
 * Cell arrays added: `SourceCellId` (1 id), and `ImageOrientation` (1 signed char, +1 or -1): -1
 * where the image is mirrored, as behind a caustic; with FIRST_IMAGE that of the cell's first
 * point.
 *
 * A point without an image (outside the visible volume, in front of the membrane with FIRST_IMAGE,
 * not finite) is no point of the output: the field data array `PointsWithoutImage` lists its id.
 * With FIRST_IMAGE, lines, polygons and strips that need such a point are left out whole. Both are
 * counted; points that are not finite, and a geometry without any image, are warned of.
 *
 * Method of CURVED (Documentation/refraction.md has the equations):
 * 1. A patch per facet, from the vertices and their normals: cubic edges, a quadratic normal whose
 *    value in the middle of an edge is fitted to the curvature at its ends. Planes and spheres are
 *    reproduced, other surfaces met to third order.
 * 2. A sight point is a root of Snell's law without the root of Eq. 2.2, found by Newton's method
 *    from the answer of the point before (FIRST_IMAGE), or in every patch that a tree of ray tubes
 *    names, by subdivision until there is one root at most (ALL_IMAGES).
 * 3. Lines and polygons with several images are mapped from the membrane: rays of sub-cells of the
 *    patches cut pieces out of them.
 * 4. The virtual vertex lies on the sight ray, behind the sight point by the true distance times
 *    n1 / n2, Eq. 2.4.
 *
 * Method of FLAT_FACETS (Equations of the thesis "Refraction by geometric transforms"):
 * 1. A refraction ray at each vertex of the membrane, Eq. 2.2, extrapolated by Eq. 3.1 where the
 *    surface faces away and by Eq. 3.2 under total internal reflection.
 * 2. A cell per facet, bounded by the three rays at its corners. A tree of ray tubes finds the
 *    first facet, in the order of the membrane's cells, whose cell holds a point: the plane through
 *    the point, normal to the mean of the three rays, cuts them in a triangle around it.
 * 3. Barycentric coordinates in that triangle give the sight point in the facet; Eq. 2.4.
 *
 * Deviations of FLAT_FACETS from the thesis: the tree in place of a loop over facets (same result);
 * points in front of a facet are not in its cell; borders belong to a cell within derived rounding
 * bounds; Fresnel's equations are exact (Eq. 2.6) and evaluated at the sight point.
 *
 * Work is kept as long as it holds: facets and tree as long as the membrane keeps its points,
 * triangles and normals, refraction rays as long as eye and indices keep their values, virtual
 * vertices as long as both hold and the points of the geometry keep their places. Values are
 * compared, not only modification times, and each block of composite data has a cache of its own.
 * The counters prove it. Memory: about 400 bytes per facet of the membrane and 100 per point of the
 * geometry, 150 per image.
 *
 * @note A camera in parallel projection has no eye position; its position is used with a warning.
 * @note The membrane does not hide itself: a sight ray may cross it before its sight point, a
 * refracted ray behind it. The normals decide where there is an image.
 * @note A side is told along the mean of the membrane's normals: where the membrane overhangs along
 * it (ALL_IMAGES, geometry on both sides) the side of a point may be wrong.
 * @note Between the rays of the vertices FLAT_FACETS interpolates linearly. The error is of second
 * order in the size of the facets; Documentation/refraction.md has measurements. Cells of
 * neighbouring facets may overlap or leave thin gaps, and zones of convergence show the first image
 * only.
 * @note Normals of the input are passed through although the virtual surface is bent, unless
 * VirtualNormals are wanted.
 *
 * @sa vtkTetrahedraRayCastMapper
 */
#ifndef vtkRefractedGeometryFilter_h
#define vtkRefractedGeometryFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For the camera

#include <memory> // For std::unique_ptr

class vtkCamera;
class vtkImplicitFunction;

class VTKMENISCUS_EXPORT vtkRefractedGeometryFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkRefractedGeometryFilter* New();
  vtkTypeMacro(vtkRefractedGeometryFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** How the membrane's surface is understood between its vertices. */
  enum MembraneModels
  {
    FlatFacets = 0, ///< linear interpolation in each facet, the thesis's method
    CURVED = 1      ///< smooth patches from positions and normals
  };

  /** Which images of a point are made where the membrane shows several. */
  enum ImageModes
  {
    FirstImage = 0, ///< one: with FLAT_FACETS that of the first facet, in the order of the
                    ///< membrane's cells; with CURVED that which continues the last point's
    AllImages = 1   ///< every one
  };

  /** What the array Reflectance holds. */
  enum ReflectanceModels
  {
    FRESNEL = 0, ///< exact, of unpolarised light, Eq. 2.6
    SCHLICK = 1  ///< Schlick's approximation, Eq. 2.7, as the thesis draws
  };

  /** @{ */
  /**
   * Set/Get the eye's position in the world coordinates of the membrane and the geometry. Used
   * unless a camera is set. Default is (0, 0, 1). A coordinate that is not finite, or an eye on the
   * membrane, is an error when the filter runs, and its output empty.
   */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get a camera whose position is the eye. Changes of the camera modify the filter; only a
   * change of its position, or of what it shows of the membrane, costs more than a comparison.
   * Default is none.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  /** @} */

  /** @{ */
  /**
   * Set/Get whether, with a camera, cells and points that it cannot show through the membrane are
   * left out unsolved: those that no facet in its view may show, told by bounds, and that are not
   * in front of the membrane. What is in view is not changed by it. For output that other cameras
   * look at turn it off. Without a camera, or with one in parallel projection, it does nothing.
   * Default is on.
   */
  vtkSetMacro(ViewCulling, bool);
  vtkGetMacro(ViewCulling, bool);
  vtkBooleanMacro(ViewCulling, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the width of the camera's viewport over its height, for ViewCulling. 0 says that it is
   * not known: nothing is culled left and right of the view then (above and below it, if the view
   * angle is horizontal). Default is 0. Range 0 to 1000.
   */
  vtkSetClampMacro(ViewAspectRatio, double, 0.0, 1000.0);
  vtkGetMacro(ViewAspectRatio, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the index of refraction on the eye's side of the membrane. Any positive finite number;
   * others are an error when the filter runs. Default is 1.0, that of air.
   */
  vtkSetMacro(ExteriorIndexOfRefraction, double);
  vtkGetMacro(ExteriorIndexOfRefraction, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the index of refraction on the geometry's side of the membrane. Any positive finite
   * number; others are an error when the filter runs. Default is 1.333, that of water.
   */
  vtkSetMacro(InteriorIndexOfRefraction, double);
  vtkGetMacro(InteriorIndexOfRefraction, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the membrane model, FLAT_FACETS or CURVED. Default is CURVED.
   */
  vtkSetClampMacro(MembraneModel, int, FlatFacets, CURVED);
  vtkGetMacro(MembraneModel, int);
  void SetMembraneModelToFlatFacets() { this->SetMembraneModel(FlatFacets); }
  void SetMembraneModelToCurved() { this->SetMembraneModel(CURVED); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the exact surface of a membrane that has a formula: its zero set. The membrane's points
   * are moved onto it along the function's gradient, and their normals are that gradient, on the
   * side of the membrane's own. The membrane says how far the surface reaches and how finely it is
   * represented: planes and spheres are exact then, others off by the third order of a facet's
   * size. Points that have no place on the zero set stay where they are, with a warning. Default is
   * none.
   */
  void SetExactMembrane(vtkImplicitFunction* function);
  vtkImplicitFunction* GetExactMembrane();
  /** @} */

  /** @{ */
  /**
   * Set/Get which images are made, FIRST_IMAGE or ALL_IMAGES. Default is ALL_IMAGES; with
   * FLAT_FACETS it warns and FIRST_IMAGE is computed.
   */
  vtkSetClampMacro(Images, int, FirstImage, AllImages);
  vtkGetMacro(Images, int);
  void SetImagesToFirstImage() { this->SetImages(FirstImage); }
  void SetImagesToAllImages() { this->SetImages(AllImages); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the angle in degrees at the eye that an image may be off where lines and polygons are
   * drawn straight between their points (ALL_IMAGES). A pixel of an image of 512 pixels and 30
   * degrees is 0.06. Default is 0.005. Range 1e-8, for eyes
   * far away, to 10.
   */
  vtkSetClampMacro(AngularTolerance, double, 1e-8, 10.0);
  vtkGetMacro(AngularTolerance, double);
  /** @} */

  /** @{ */
  /**
   * With ALL_IMAGES, whether gaps and overlaps between the images of neighbouring polygons, which
   * are within AngularTolerance, are covered by cells of their own, so that no pixel shows through.
   * Such a cell has no extent at the true positions. Turn it off for sums over the cells of the
   * output: gaps and overlaps cancel out on average, covered ones count twice. Default is on.
   */
  vtkSetMacro(CloseSeams, bool);
  vtkGetMacro(CloseSeams, bool);
  vtkBooleanMacro(CloseSeams, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the model of the array Reflectance, FRESNEL or SCHLICK. Default is FRESNEL. Nothing is
   * solved again for it. SCHLICK knows no critical angle: from a denser exterior (n1 > n2) it is
   * wrong near and beyond it.
   */
  vtkSetClampMacro(ReflectanceModel, int, FRESNEL, SCHLICK);
  vtkGetMacro(ReflectanceModel, int);
  void SetReflectanceModelToFresnel() { this->SetReflectanceModel(FRESNEL); }
  void SetReflectanceModelToSchlick() { this->SetReflectanceModel(SCHLICK); }
  /** @} */

  /** @{ */
  /**
   * Set/Get whether point normals of the geometry are replaced by normals that make standard
   * lighting of the virtual surface look like the true surface, lit and seen through the membrane:
   * the array `VirtualNormals` becomes the active one, the true normals stay as an array. Default
   * is off. Geometry without point normals gets none, with a warning. Nothing is solved again for
   * it.
   *
   * The normal n at a virtual point has n.w' = N.w and n.v' = N.v, where N, w and v are the normal
   * and the directions of the refracted rays to light and viewer at the true point, w' and v' the
   * straight ones at the virtual point. So diffuse light is exact, and a highlight up to the angle
   * between light and viewer, which refraction changes; where no normal does both (light and viewer
   * far apart), diffuse light is exact. Exact for a light at the eye, whatever the membrane; for a
   * light at infinity where the membrane is plane between the light's ray and the sight ray. What
   * the membrane focuses or reflects of the light is not in a normal.
   */
  vtkSetMacro(VirtualNormals, bool);
  vtkGetMacro(VirtualNormals, bool);
  vtkBooleanMacro(VirtualNormals, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the direction to a light at infinity that VirtualNormals are for, of any length, in
   * world coordinates. (0, 0, 0) is a light at the eye, a headlight. Default is (0, 0, 0). A
   * coordinate that is not finite is an error when the filter runs with VirtualNormals.
   */
  vtkSetVector3Macro(LightDirection, double);
  vtkGetVector3Macro(LightDirection, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the precision of the output points, one of vtkAlgorithm::DesiredOutputPrecision.
   * Default is DEFAULT_PRECISION, that of the input points. Everything is computed in double.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  /** @} */

  /**
   * Set the membrane's pipeline connection, port 1.
   */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  /**
   * Set the membrane, port 1, without a pipeline connection.
   */
  void SetMembraneData(vtkPolyData* membrane);

  /** @{ */
  /**
   * Counters since construction: how often the membrane's shape was taken in, how often refraction
   * rays were computed for it, how many points were solved, how many of these had no answer because
   * a coordinate was not finite or out of range, how many had no image, and how many cells were
   * left out because a point that they need has no image or does not exist. Undecided searches
   * looked for all images of a point, or for its side, and may have missed some: at a focus, which
   * shows a ring of images, or within rounding of a caustic or of the membrane. They are counted
   * each time, with a warning once per shape of the membrane.
   */
  vtkTypeInt64 GetNumberOfPatchBuilds() const;
  vtkTypeInt64 GetNumberOfEyeUpdates() const;
  vtkTypeInt64 GetNumberOfSolvedVertices() const;
  vtkTypeInt64 GetNumberOfFailedSolves() const;
  vtkTypeInt64 GetNumberOfUndecidedSearches() const;
  vtkTypeInt64 GetNumberOfVerticesWithoutImage() const;
  vtkTypeInt64 GetNumberOfSkippedCells() const;
  /** @} */

  /** @{ */
  /**
   * Counters since construction, summed over the runs: points that were not solved and cells that
   * were left out because the camera cannot show them through the membrane (ViewCulling).
   */
  vtkTypeInt64 GetNumberOfCulledVertices() const;
  vtkTypeInt64 GetNumberOfCulledCells() const;
  /** @} */

  /**
   * Triangles of the present membrane that were skipped: no area, a coordinate that is not finite,
   * a point that does not exist, or the same points as an earlier one.
   */
  vtkTypeInt64 GetNumberOfSkippedFacets() const;

  /** @{ */
  /**
   * State of the last run with CURVED: whether the eye is inside of a closed membrane whose normals
   * point outwards, so that all outside of it passes unchanged; and how many points of the
   * membrane, of up to 256 that are looked at, the eye sees through another piece of it. Rays that
   * meet both pieces are refracted at one of them only. A warning says so once per change.
   */
  bool IsEyeEnclosed() const;
  vtkTypeInt64 GetNumberOfMembranePointsBehind() const;
  /** @} */

  /**
   * Covers the camera and the exact membrane.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkRefractedGeometryFilter();
  ~vtkRefractedGeometryFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkRefractedGeometryFilter(const vtkRefractedGeometryFilter&) = delete;
  void operator=(const vtkRefractedGeometryFilter&) = delete;

  void WarnOfModes();
  void ReportPoints(vtkTypeInt64 failed, bool hasImage, vtkPolyData* input);
  void ReportUndecided(vtkTypeInt64 searches);
  bool HasValidLight();
  bool UpdateMembrane(vtkPolyData* membrane);
  bool UpdateEye();

  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  bool ViewCulling = true;
  double ViewAspectRatio = 0.0;
  double ExteriorIndexOfRefraction = 1.0;
  double InteriorIndexOfRefraction = 1.333;
  int MembraneModel = CURVED;
  vtkSmartPointer<vtkImplicitFunction> ExactMembrane;
  int Images = AllImages;
  double AngularTolerance = 0.005;
  bool CloseSeams = true;
  int ReflectanceModel = FRESNEL;
  bool VirtualNormals = false;
  double LightDirection[3] = { 0.0, 0.0, 0.0 };
  int OutputPointsPrecision = DEFAULT_PRECISION;
  vtkSmartPointer<vtkCamera> Camera;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

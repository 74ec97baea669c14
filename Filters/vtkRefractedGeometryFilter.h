// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractedGeometryFilter
 * @brief   virtual geometry behind a refracting surface
 *
 * Moves every point of the geometry to where an eye sees it through a refracting surface, the
 * membrane: at the right pixel and at the apparent depth. Drawn with the same eye, the output shows
 * the refracted scene without tracing a ray.
 *
 * Input port 0 is the geometry: a vtkPolyData with vertices, lines, polygons and triangle strips,
 * or a grid, whose surface is taken. Polygons that are not convex, which VTK would draw as fans,
 * are divided into triangles. Composite data runs block by block.
 *
 * Input port 1 is the membrane, a vtkPolyData with triangles, polygons or strips that separate the
 * eye's medium (exterior) from the geometry's (interior). Its normals point to the eye's side: its
 * point normals are used where they are valid, others are computed from the facets' winding. If
 * most of them do not fit the triangles around them, for example after a filter that moves points
 * only, the filter warns. Facets whose winding is opposite to most of their piece, and normals that
 * point to the other side than most, are reversed, with a warning; a one-sided surface (a Moebius
 * band) is an error. A closed membrane is a body of the interior medium if its normals point
 * outwards, or a bubble of the exterior medium if they point inwards; geometry on the eye's side of
 * it is shown unchanged. Ghost levels of the membrane are not requested.
 *
 * The output shows every image of the geometry (ALL_IMAGES), or one per point with the input's own
 * connectivity (FIRST_IMAGE), with all point and cell arrays. Each image of a point of a vertex
 * cell is a cell of its own. With ALL_IMAGES a line or polygon whose points have one image each,
 * and whose image is straight within the tolerance, keeps its points. Any other is replaced by the
 * pieces of it that the membrane shows (strips as triangles), and its part on the eye's side of the
 * membrane passes unchanged. Arrays are interpolated at new points, except arrays of ids, which
 * take the id of the nearest point. Point arrays added:
 * - `SightPoint` (3 doubles, world): where the light leaves the membrane towards the eye;
 * - `RefractionDepth` (1 double, world length, >= 0): distance from the sight point to the true
 *   point: the path in the interior, for attenuation;
 * - `Reflectance` (1 double, 0 to 1): unpolarised Fresnel reflectance at the sight point, 1 beyond
 *   the critical angle; or Schlick's approximation of it;
 * - `SightFacet` (1 id): the membrane's cell that holds the sight point, -1 for a point on the
 *   eye's side, which passes unchanged;
 * - `SourcePointId` (1 id): the point of the input, -1 for a point that clipping made.
 *
 * Cell arrays added: `SourceCellId` (1 id), and `ImageOrientation` (1 signed char, +1 or -1): -1
 * where the image is mirrored, as behind a caustic; with FIRST_IMAGE, -1 if the image of the cell's
 * first point is mirrored.
 *
 * A point without an image (outside the visible volume, in front of the membrane with FIRST_IMAGE,
 * not finite) is not in the output; the field data array `PointsWithoutImage` lists its id. With
 * FIRST_IMAGE, lines, polygons and strips that need such a point are left out whole. Both are
 * counted. The filter warns of points that are not finite, and of a geometry without any image.
 *
 * Method of CURVED (Documentation/refraction-method.md has the equations):
 * 1. A patch per facet, from the vertices and their normals: cubic edges, and a quadratic normal
 *    whose value in the middle of an edge is fitted to the curvature at its ends. Planes and
 *    spheres are reproduced exactly, other surfaces to third order.
 * 2. A sight point is a root of Snell's law without the root of Eq. 2.2, found by Newton's method
 *    from the answer for the previous point (FIRST_IMAGE), or in every patch that a tree of ray
 *    tubes returns, by subdivision until there is at most one root (ALL_IMAGES).
 * 3. Lines and polygons with several images are mapped from the membrane: the rays of each sub-cell
 *    of a patch cut a piece out of them.
 * 4. The virtual vertex lies on the sight ray, behind the sight point by the true distance times
 *    n1 / n2, Eq. 2.4.
 *
 * Method of FLAT_FACETS (Equations of the thesis "Refraction by geometric transforms"):
 * 1. A refracted ray at each vertex of the membrane, Eq. 2.2, extrapolated by Eq. 3.1 where the
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
 * Results are kept as long as they are valid: facets and tree as long as the membrane's points,
 * triangles and normals do not change, refracted rays as long as the eye and the indices do not
 * change, and virtual vertices as long as both are valid and the points of the geometry do not
 * change. Values are compared, not only modification times, and each block of composite data has
 * its own cache. The counters show when work was done. Memory: about 400 bytes per facet of the
 * membrane and 100 per point of the geometry, 150 per image.
 *
 * @note Occlusion of the membrane by itself is not modelled: a sight ray may cross the membrane in
 *   front of its sight point, and a refracted ray may cross it again behind. The normals decide
 *   where there is an image.
 * @note The side of a point is determined along the mean of the membrane's normals: where the
 *   membrane overhangs in this direction (ALL_IMAGES, geometry on both sides), it may be wrong.
 * @note Between the rays of the vertices FLAT_FACETS interpolates linearly. The error is of second
 *   order in the size of the facets; Documentation/refraction-measurements.md has measurements.
 *   Cells of neighbouring facets may overlap or leave thin gaps, and zones of convergence show the
 *   first image only.
 * @note Normals of the input are passed unchanged, although the virtual surface has other ones,
 *   unless VirtualNormals is on.
 *
 * @sa vtkTetrahedraRayCastMapper
 */
#ifndef vtkRefractedGeometryFilter_h
#define vtkRefractedGeometryFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For the camera

#include <array>  // For std::array
#include <memory> // For std::unique_ptr
#include <string> // For std::string
#include <vector> // For std::vector

class vtkRefractingInterfaceCollection;
class vtkCamera;
class vtkImplicitFunction;
class vtkTable;

namespace meniscus
{
struct VirtualPolyDataReport;
}

class VTKMENISCUS_EXPORT vtkRefractedGeometryFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkRefractedGeometryFilter* New();
  vtkTypeMacro(vtkRefractedGeometryFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Rays that the eye sees the geometry by. */
  enum
  {
    REFRACTION = 0, ///< through the membrane
    REFLECTION = 1  ///< in the membrane, a mirror
  };

  /** Representation of the membrane's surface between its vertices. */
  enum
  {
    FLAT_FACETS = 0, ///< linear interpolation in each facet, the thesis's method
    CURVED = 1       ///< smooth patches from positions and normals
  };

  /** Images of a point that are computed where the membrane shows several. */
  enum
  {
    FIRST_IMAGE = 0, ///< one: with FLAT_FACETS the image in the first facet, in the order of the
                     ///< membrane's cells; with CURVED the continuation of the previous point's
    ALL_IMAGES = 1   ///< all images
  };

  /** Formula for the array Reflectance. */
  enum
  {
    FRESNEL = 0, ///< exact reflectance of unpolarised light, Eq. 2.6
    SCHLICK = 1  ///< Schlick's approximation, Eq. 2.7, which the thesis uses for drawing
  };

  /** @{ */
  /**
   * Set/Get whether the output is the geometry as it is seen through the membrane, REFRACTION, or
   * as it is seen mirrored by it, REFLECTION. Default is REFRACTION.
   *
   * With REFLECTION the geometry is on the eye's side. Its mirror image lies behind the membrane:
   * on the sight ray, as far behind the sight point as the true point is in front of it. This
   * distance is the array RefractionDepth. Points behind the mirror have no image and cells are cut
   * along the mirror; points on it are their own images. Polygons have the reversed winding, and
   * point normals are mirrored, so that the front of a polygon stays its front; ImageOrientation is
   * +1 for images as a plane mirror shows them. VirtualNormals are for light that comes to the
   * geometry directly. The indices of refraction give the array Reflectance only.
   *
   * One interface can mirror, with MembraneModel CURVED; other settings are an error when the
   * filter runs. A ray that meets the mirror again, in front of the sight point or behind it, is
   * not blocked: the mirror does not occlude itself, and there are no second reflections. Cell
   * normals are passed unchanged.
   */
  virtual void SetMode(int mode);
  vtkGetMacro(Mode, int);
  void SetModeToRefraction() { this->SetMode(REFRACTION); }
  void SetModeToReflection() { this->SetMode(REFLECTION); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the eye's position in the world coordinates of the membrane and the geometry. Used
   * unless a camera is set. Default is (0, 0, 1). With a coordinate that is not finite, or with an
   * eye on the membrane, the filter reports an error when it runs, and its output is empty.
   */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get a camera whose position is the eye. In parallel projection its eye is at infinity: the
   * filter uses a point 1e5 sizes of the membrane away, and AngularTolerance, as a part of the
   * picture's height, is taken for a view angle of 30 degrees. Changes of the camera modify the
   * filter; only a change of its position, or of the part of the membrane in its view, costs more
   * than a comparison. Default is none.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  /** @} */

  /** @{ */
  /**
   * Set/Get whether cells and points that the camera cannot show through the membrane are left out
   * without being solved: by conservative bounds, no facet in its view shows them, and they are not
   * in front of the membrane. The part in view does not change. Turn this off if other cameras look
   * at the output. It has no effect without a camera, or with one in parallel projection. Default
   * is on.
   */
  vtkSetMacro(ViewCulling, bool);
  vtkGetMacro(ViewCulling, bool);
  vtkBooleanMacro(ViewCulling, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the width of the camera's viewport over its height, for ViewCulling. 0 means unknown:
   * in that case nothing is culled to the left and right of the view (above and below it, if the
   * view angle is horizontal). Default is 0. Range 0 to 1000.
   */
  virtual void SetViewAspectRatio(double ratio);
  vtkGetMacro(ViewAspectRatio, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the index of refraction on the eye's side of the membrane. Must be positive and finite;
   * other values are an error when the filter runs. Default is 1.0 (air).
   */
  virtual void SetExteriorIndexOfRefraction(double index);
  virtual double GetExteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the index of refraction on the geometry's side of the membrane. Must be positive and
   * finite; other values are an error when the filter runs. Default is 1.333 (water).
   */
  virtual void SetInteriorIndexOfRefraction(double index);
  virtual double GetInteriorIndexOfRefraction();
  /** @} */

  /** @{ */
  /**
   * Set/Get the refracting interfaces, in the order in which sight rays meet them. The list may be
   * shared with other filters and mappers. Its first interface has the indices of refraction and
   * the exact surface that SetExteriorIndexOfRefraction(), SetInteriorIndexOfRefraction() and
   * SetExactMembrane() set. Interface i has the surface of connection i of port 1; another number
   * of connections is an error when the filter runs. Null, the default, stands for a list of one
   * with default values.
   *
   * With several interfaces, the medium behind each is the medium in front of the next one; a ray
   * takes the side of a surface by its direction against the normals, so that a closed body may be
   * listed twice, entered and left. Rays that miss a later surface, or are totally reflected at it,
   * show nothing. Points between interfaces are refracted by the interfaces in front of them, and
   * an eye between interfaces looks through the interfaces behind it. Interfaces with equal indices
   * are left out. MembraneModel must be CURVED, and the light of VirtualNormals must be at the eye;
   * ViewCulling has no effect. With ALL_IMAGES, the part of a cell in front of all interfaces is
   * drawn only where the sight rays through it go on to the first interface. RefractionDepth is the
   * sum of the legs behind the first sight point. Point arrays added: `LegLengths` (a length behind
   * each refracting interface), `LastSightPoint` (3 doubles, world), `Transmittance` (share of
   * unpolarised light, with the reflections between the interfaces as parallel plates have them)
   * and `InnerReflectance` (1 minus Transmittance / (1 - Reflectance)).
   */
  void SetInterfaces(vtkRefractingInterfaceCollection* interfaces);
  vtkRefractingInterfaceCollection* GetInterfaces();
  /** @} */

  /**
   * Index of refraction behind each interface that sight rays meet, relative to the medium in front
   * of the first interface. With several interfaces, the eye of the last update has chosen the
   * first one.
   */
  std::vector<double> GetRelativeIndicesOfRefraction();

  /** @{ */
  /**
   * Set/Get the membrane model, FLAT_FACETS or CURVED. Default is CURVED.
   */
  virtual void SetMembraneModel(int model);
  vtkGetMacro(MembraneModel, int);
  void SetMembraneModelToFlatFacets() { this->SetMembraneModel(FLAT_FACETS); }
  void SetMembraneModelToCurved() { this->SetMembraneModel(CURVED); }
  /** @} */

  /** @{ */
  /**
   * Set/Get an implicit function whose zero set is the exact surface of the membrane. The
   * membrane's points are moved onto it along the function's gradient, and their normals are that
   * gradient, on the side of the membrane's own normals. The membrane determines the extent of the
   * surface and the resolution: planes and spheres are then exact, and other surfaces have an error
   * of third order in the size of a facet. Points for which no place on the zero set is found stay
   * where they are, with a warning. Default is none.
   */
  void SetExactMembrane(vtkImplicitFunction* function);
  vtkImplicitFunction* GetExactMembrane();
  /** @} */

  /** @{ */
  /**
   * Set/Get the images to compute, FIRST_IMAGE or ALL_IMAGES. Default is ALL_IMAGES; with
   * FLAT_FACETS, the filter warns and computes FIRST_IMAGE.
   */
  virtual void SetImages(int images);
  vtkGetMacro(Images, int);
  void SetImagesToFirstImage() { this->SetImages(FIRST_IMAGE); }
  void SetImagesToAllImages() { this->SetImages(ALL_IMAGES); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the largest error, in degrees at the eye, where images of lines and polygons are drawn
   * straight between their points (ALL_IMAGES). For comparison, a pixel is 0.06 degrees in an image
   * of 512 pixels and a view angle of 30 degrees. A triangle is divided until it has 65,536 points;
   * a warning states how many triangles then have larger errors. Default is 0.005. Range 1e-8, for
   * eyes far away, to 10.
   */
  virtual void SetAngularTolerance(double tolerance);
  vtkGetMacro(AngularTolerance, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether, with ALL_IMAGES, gaps and overlaps between the images of neighbouring
   * polygons, which are within AngularTolerance, are covered by additional cells, so that the
   * background does not show through at any pixel. Such a cell has no extent at the true positions.
   * Turn it off for sums over the cells of the output: gaps and overlaps cancel out on average,
   * covered ones count twice. Default is on.
   */
  vtkSetMacro(CloseSeams, bool);
  vtkGetMacro(CloseSeams, bool);
  vtkBooleanMacro(CloseSeams, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the model of the array Reflectance, FRESNEL or SCHLICK. Changing it does not solve any
   * point again. SCHLICK ignores the critical angle: from a denser exterior (n1 > n2) it is wrong
   * near this angle and beyond it. Default is FRESNEL.
   */
  virtual void SetReflectanceModel(int model);
  vtkGetMacro(ReflectanceModel, int);
  void SetReflectanceModelToFresnel() { this->SetReflectanceModel(FRESNEL); }
  void SetReflectanceModelToSchlick() { this->SetReflectanceModel(SCHLICK); }
  /** @} */

  /** @{ */
  /**
   * Set/Get whether point normals of the geometry are replaced by normals with which standard
   * lighting of the virtual surface looks like the true surface, lit and seen through the membrane:
   * the array `VirtualNormals` becomes the active one, and the true normals are kept as an array.
   * Geometry without point normals gets none, with a warning. Changing it does not solve any point
   * again. Default is off.
   *
   * The normal n at a virtual point has n.w' = N.w and n.v' = N.v, where N, w and v are the normal
   * and the directions of the refracted rays to light and viewer at the true point, and w' and v'
   * are the straight directions at the virtual point. Diffuse light is therefore exact, and a
   * highlight is exact up to the angle between light and viewer, which refraction changes. If no
   * normal satisfies both equations (light and viewer far apart), diffuse light is exact. This
   * holds for a light at the eye with any membrane, and for a light at infinity where the membrane
   * is plane between the light's ray and the sight ray. Focusing and reflection of the light by the
   * membrane are not part of a normal.
   */
  vtkSetMacro(VirtualNormals, bool);
  vtkGetMacro(VirtualNormals, bool);
  vtkBooleanMacro(VirtualNormals, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the direction to the light at infinity for which VirtualNormals are computed, of any
   * length, in world coordinates. (0, 0, 0) is a light at the eye, a headlight. Default is (0, 0,
   * 0). A coordinate that is not finite is an error when the filter runs with VirtualNormals.
   */
  vtkSetVector3Macro(LightDirection, double);
  vtkGetVector3Macro(LightDirection, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the output has the point arrays `TruePosition` (3 doubles, world), the place of
   * the point that is seen, and, for a geometry with point normals, `TrueNormal` (3 doubles, unit
   * length), its own normal there. vtkRefractionPass lights objects by them. Changing it does not
   * solve any point again. Default is off.
   */
  vtkSetMacro(TrueGeometry, bool);
  vtkGetMacro(TrueGeometry, bool);
  vtkBooleanMacro(TrueGeometry, bool);
  /** @} */

  /** @{ */
  /**
   * Set/Get the precision of the output points, one of vtkAlgorithm::DesiredOutputPrecision.
   * Default is DEFAULT_PRECISION, the precision of the input points. All computations use double
   * precision.
   */
  virtual void SetOutputPointsPrecision(int precision);
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
   * Add the surface of the next interface of the list to port 1, by connection or as data; remove
   * all surfaces; get their number. SetInterfaces() has the indices of refraction.
   */
  void AddMembraneConnection(vtkAlgorithmOutput* output);
  void AddMembraneData(vtkPolyData* membrane);
  void RemoveAllMembranes();
  int GetNumberOfMembranes();
  /** @} */

  /** @{ */
  /**
   * Counters since construction: number of times that the membrane's shape was read, number of
   * times that refracted rays were computed for it, number of points solved, and number of these
   * that had no answer because a coordinate was not finite or out of range.
   *
   * Filters with the same membrane object, exact surface, eye, indices and mode share its shape and
   * its rays. The filter that runs first after a change computes and counts them.
   */
  vtkTypeInt64 GetNumberOfPatchBuilds() const;
  vtkTypeInt64 GetNumberOfEyeUpdates() const;
  vtkTypeInt64 GetNumberOfSolvedVertices() const;
  vtkTypeInt64 GetNumberOfFailedSolves() const;
  /** @} */

  /** @{ */
  /**
   * Counters, sizes and errors by name: a table with one row each and the columns Name, Meaning and
   * Value, which belongs to this object and is filled anew by each call; and the value of one name,
   * such as "NumberOfSkippedCells". An unknown name is an error, and the value is not a number.
   *
   * For each shape of the membrane, the filter warns once if a search may have missed an image.
   * After each change of the eye, it warns once if the membrane encloses the eye, or if the eye
   * sees the membrane through another piece of it: rays that meet both pieces are refracted at one
   * of them only.
   */
  vtkTable* GetStatistics();
  double GetStatistic(const char* name);
  /** @} */

  /** @{ */
  /**
   * The virtual geometry. For composite data, whose output is composite too
   * (GetOutputDataObject()), it has all blocks in one object, with the arrays that all of them
   * have. Call Update() before.
   */
  vtkPolyData* GetOutput();
  vtkPolyData* GetOutput(int port) { return port == 0 ? this->GetOutput() : nullptr; }
  /** @} */

  /** Includes the times of the camera and of the exact membrane. */
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
  bool UpdateScene(vtkInformationVector* membranes);
  std::array<double, 3> GetEye();
  double GetTolerance();
  void ReportCells(const meniscus::VirtualPolyDataReport& report, vtkPolyData* input);
  std::string FindUnsupported();
  void WriteImages(vtkPolyData* input, vtkPolyData* output);

  int Mode = REFRACTION;
  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  bool ViewCulling = true;
  double ViewAspectRatio = 0.0;
  int MembraneModel = CURVED;
  int Images = ALL_IMAGES;
  double AngularTolerance = 0.005;
  bool CloseSeams = true;
  int ReflectanceModel = FRESNEL;
  bool VirtualNormals = false;
  bool TrueGeometry = false;
  double LightDirection[3] = { 0.0, 0.0, 0.0 };
  int OutputPointsPrecision = DEFAULT_PRECISION;
  vtkSmartPointer<vtkCamera> Camera;
  vtkSmartPointer<vtkRefractingInterfaceCollection> Interfaces;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

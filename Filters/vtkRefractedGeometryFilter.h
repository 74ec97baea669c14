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
 * (interior). It is open, its normals point to the eye's side: its point normals are used where
 * they are valid, others are computed from the facets' winding. Ghost levels of the membrane are
 * not asked for.
 *
 * The output has the cells of the input, with the same connectivity and all point and cell arrays,
 * at the virtual points. Each point of a vertex cell becomes a cell of its own. Point arrays added:
 * - `SightPoint` (3 doubles, world): where the light leaves the membrane towards the eye;
 * - `RefractionDepth` (1 double, world length, >= 0): from sight point to true point, the path in
 * the interior that attenuation should use;
 * - `Reflectance` (1 double, 0 to 1): unpolarised Fresnel reflectance at the sight point, 1 beyond
 *   the critical angle;
 * - `SightFacet` (1 id): the membrane's cell that holds the sight point;
 * - `SourcePointId` (1 id): the point of the input.
 *
 * Cell arrays added: `SourceCellId` (1 id), and `ImageOrientation` (1 signed char, +1 or -1): -1
 * where the image of the cell's first point is mirrored, as behind a caustic.
 *
 * A point without an image (outside the visible volume, in front of the membrane, not finite) is no
 * point of the output: the field data array `PointsWithoutImage` lists its id. Lines, polygons and
 * strips that need such a point are left out whole. Both are counted.
 *
 * Method (Equations of the thesis "Refraction by geometric transforms"):
 * 1. A refraction ray at each vertex of the membrane, Eq. 2.2, extrapolated by Eq. 3.1 where the
 *    surface faces away and by Eq. 3.2 under total internal reflection.
 * 2. A cell per facet, bounded by the three rays at its corners. A tree of ray tubes finds the
 * first facet, in the order of the membrane's cells, whose cell holds a point: the plane through
 * the point, normal to the mean of the three rays, cuts them in a triangle around it.
 * 3. Barycentric coordinates in that triangle give the sight point in the facet.
 * 4. The virtual vertex lies on the sight ray, behind the sight point by the true distance times
 *    n1 / n2, Eq. 2.4.
 *
 * Deviations from the thesis: the tree in place of a loop over facets (same result); points in
 * front of a facet are not in its cell; borders belong to a cell within derived rounding bounds;
 * Fresnel's equations are exact (Eq. 2.6) and evaluated at the sight point.
 *
 * Work is kept as long as it holds: facets and tree as long as the membrane keeps its points,
 * triangles and normals, refraction rays as long as eye and indices keep their values, virtual
 * vertices as long as both hold and the points of the geometry keep their places. Values are
 * compared, not only modification times, and each block of composite data has a cache of its own.
 * The counters prove it. Memory: about 400 bytes per facet of the membrane and 100 per point of the
 * geometry.
 *
 * @note Images ALL_IMAGES, the default, is not there yet: a warning says once that FIRST_IMAGE is
 * computed in its place.
 * @note A camera in parallel projection has no eye position; its position is used with a warning.
 * @note Between the rays of the vertices FLAT_FACETS interpolates linearly. The error is of second
 * order in the size of the facets; Documentation/refraction.md has measurements. Cells of
 * neighbouring facets may overlap or leave thin gaps, and zones of convergence show the first image
 * only.
 * @note Normals of the input are passed through although the virtual surface is bent.
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

class VTKMENISCUS_EXPORT vtkRefractedGeometryFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkRefractedGeometryFilter* New();
  vtkTypeMacro(vtkRefractedGeometryFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How the membrane's surface is understood between its vertices.
  enum MembraneModels
  {
    FLAT_FACETS = 0, ///< linear interpolation in each facet, the thesis's method
    CURVED = 1       ///< smooth patches from positions and normals
  };

  /// Which images of a point are made where the membrane shows several.
  enum ImageModes
  {
    FIRST_IMAGE = 0, ///< that of the first facet, in the order of the membrane's cells
    ALL_IMAGES = 1   ///< every one
  };

  ///@{
  /**
   * Set/Get the eye's position in the world coordinates of the membrane and the geometry. Used
   * unless a camera is set. Default is (0, 0, 1). A coordinate that is not finite, or an eye on the
   * membrane, is an error when the filter runs, and its output empty.
   */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  ///@}

  ///@{
  /**
   * Set/Get a camera whose position is the eye. Changes of the camera modify the filter; only a
   * change of its position costs more than a comparison. Default is none.
   */
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera();
  ///@}

  ///@{
  /**
   * Set/Get the index of refraction on the eye's side of the membrane. Any positive finite number;
   * others are an error when the filter runs. Default is 1.0, that of air.
   */
  vtkSetMacro(ExteriorIndexOfRefraction, double);
  vtkGetMacro(ExteriorIndexOfRefraction, double);
  ///@}

  ///@{
  /**
   * Set/Get the index of refraction on the geometry's side of the membrane. Any positive finite
   * number; others are an error when the filter runs. Default is 1.333, that of water.
   */
  vtkSetMacro(InteriorIndexOfRefraction, double);
  vtkGetMacro(InteriorIndexOfRefraction, double);
  ///@}

  ///@{
  /**
   * Set/Get the membrane model, FLAT_FACETS or CURVED. Default is CURVED.
   */
  vtkSetClampMacro(MembraneModel, int, FLAT_FACETS, CURVED);
  vtkGetMacro(MembraneModel, int);
  void SetMembraneModelToFlatFacets() { this->SetMembraneModel(FLAT_FACETS); }
  void SetMembraneModelToCurved() { this->SetMembraneModel(CURVED); }
  ///@}

  ///@{
  /**
   * Set/Get which images are made, FIRST_IMAGE or ALL_IMAGES. Default is ALL_IMAGES, for which
   * FIRST_IMAGE is computed with a warning until it exists.
   */
  vtkSetClampMacro(Images, int, FIRST_IMAGE, ALL_IMAGES);
  vtkGetMacro(Images, int);
  void SetImagesToFirstImage() { this->SetImages(FIRST_IMAGE); }
  void SetImagesToAllImages() { this->SetImages(ALL_IMAGES); }
  ///@}

  ///@{
  /**
   * Set/Get the precision of the output points, one of vtkAlgorithm::DesiredOutputPrecision.
   * Default is DEFAULT_PRECISION, that of the input points. Everything is computed in double.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  /**
   * Set the membrane's pipeline connection, port 1.
   */
  void SetMembraneConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  /**
   * Set the membrane, port 1, without a pipeline connection.
   */
  void SetMembraneData(vtkPolyData* membrane);

  ///@{
  /**
   * Counters since construction: how often the membrane's shape was taken in, how often refraction
   * rays were computed for it, how many points were solved, how many of these had no answer because
   * a coordinate was not finite or out of range, how many had no image, and how many cells were
   * left out because a point that they need has no image or does not exist.
   */
  vtkTypeInt64 GetNumberOfPatchBuilds() const;
  vtkTypeInt64 GetNumberOfEyeUpdates() const;
  vtkTypeInt64 GetNumberOfSolvedVertices() const;
  vtkTypeInt64 GetNumberOfFailedSolves() const;
  vtkTypeInt64 GetNumberOfVerticesWithoutImage() const;
  vtkTypeInt64 GetNumberOfSkippedCells() const;
  ///@}

  /**
   * Triangles of the present membrane that were skipped: no area, a coordinate that is not finite,
   * a point that does not exist, or the same points as an earlier one.
   */
  vtkTypeInt64 GetNumberOfSkippedFacets() const;

  /**
   * Covers the camera.
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

  void WarnOfMissingModes();
  bool UpdateMembrane(vtkPolyData* membrane);
  bool UpdateEye();

  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  double ExteriorIndexOfRefraction = 1.0;
  double InteriorIndexOfRefraction = 1.333;
  int MembraneModel = CURVED;
  int Images = ALL_IMAGES;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  vtkSmartPointer<vtkCamera> Camera;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

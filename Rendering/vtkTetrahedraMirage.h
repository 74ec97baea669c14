// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraMirage
 * @brief   picture of opaque objects in or behind a medium that bends light
 *
 * Traces one ray per pixel backwards through a mesh in which the index of refraction n varies,
 * until it meets an object: a mirage over a road, things behind the hot air above a fire, or behind
 * a lens of graded index. Objects may stand in front of, behind and in the mesh. It needs neither a
 * window nor OpenGL. vtkBentRayAlgorithm describes the mesh, the rays and the image; with BendRays
 * off, rays are straight, as without a medium.
 *
 * Input port 1 has the objects, a vtkDataSet: its polygons, seen from both sides, or the outer
 * faces of a grid. Lines and vertices are not seen. With a volume, the port is optional. Objects
 * are coloured by the active scalars of their cells or, without any, of their points, as by
 * vtkMapper: unsigned char values are colours, and others are mapped by LookupTable. Objects
 * without scalars are white. A Texture multiplies these colours by those of its image at the
 * texture coordinates of the points. Polygons are flat: their colour is multiplied by Ambient +
 * (1 - Ambient) times the cosine of the angle between their normal and the light of LightDirection.
 *
 * With a VolumeProperty, the medium itself is seen as well: smoke, glowing gas. Its array
 * VolumeArrayName, mapped by the property's functions of component 0, is drawn as by composite
 * blending of vtkTetrahedraRayCastMapper, but along the bent rays and up to the objects, which it
 * hides by its opacity. A cell with a value of that array that is not finite is transparent; it
 * bends light all the same. Shading, gradient opacity and other blend modes have no effect. Arcs
 * are cut where needed: their bend changes a colour by less than 1e-5, or the scalar by no more
 * than 2^-23 of its range.
 *
 * The output has ImageSize points, one per pixel, and these point arrays. Brackets name the values
 * of pixels that show no object:
 * - `Color`, 3 unsigned char [BackgroundColor];
 * - `Seen`, unsigned char: BACKGROUND, OBJECT or STOPPED, for a ray that stayed in the mesh;
 * - `CellId`, vtkIdType: cell of port 1 [-1];
 * - `Position`, 3 double: place of the object that is seen, where it is [NaN];
 * - `Depth`, float: straight distance of that place from the eye, or from the plane on which
 *   parallel rays begin [NaN];
 * - `Direction`, 3 float: unit vector of the ray where it ends, for a picture of things far away;
 * - `RGBA`, 4 float, with a VolumeProperty: premultiplied colour and opacity of the medium in front
 *   of the object, or on the whole ray.
 *
 * `Color` has the medium over the object or the background; the other arrays are those of the
 * object, also where the medium hides it.
 *
 * **Bad input.** Warnings: objects without polygons, which show the background alone; a texture for
 * objects without texture coordinates, which is not seen; points that are not finite, whose
 * polygons are left out; rays that were stopped. GetStatistics() counts them, and the pixels that
 * see the back of a polygon, which all do if the eye is in a closed object. An eye in the mesh is
 * allowed. Errors, with an empty output, besides those of the base class: neither objects nor a
 * volume property; a texture without an image of two dimensions; a volume without its array, or
 * with one in other data sets than the index; a property with numbers that cannot be used.
 *
 * Rays are traced in parallel by vtkSMPTools; results do not depend on the number of threads.
 *
 * @sa vtkTetrahedraSchlieren vtkApparentGeometryFilter
 */
#ifndef vtkTetrahedraMirage_h
#define vtkTetrahedraMirage_h

#include "OpacityModel.h" // For meniscusOpacityModelMacro
#include "vtkBentRayAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro
#include "vtkSmartPointer.h"   // For members

class vtkDataSet;
class vtkScalarsToColors;
class vtkTable;
class vtkTexture;
class vtkVolumeProperty;

class VTKMENISCUS_EXPORT vtkTetrahedraMirage : public vtkBentRayAlgorithm
{
public:
  static vtkTetrahedraMirage* New();
  vtkTypeMacro(vtkTetrahedraMirage, vtkBentRayAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Values of the array Seen. */
  enum
  {
    BACKGROUND = 0, ///< no object
    OBJECT = 1,     ///< an object
    STOPPED = 2     ///< the ray stayed in the mesh and was stopped
  };

  /** @{ */
  /** Set the objects, port 1. */
  void SetObjectConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetObjectData(vtkDataSet* objects);
  /** @} */

  /** @{ */
  /**
   * Set/Get the function that maps scalars of the objects to colours. Null, the default, stands for
   * a vtkLookupTable over the range of the scalars.
   */
  void SetLookupTable(vtkScalarsToColors* table);
  vtkScalarsToColors* GetLookupTable();
  /** @} */

  /** @{ */
  /**
   * Set/Get the texture of the objects: an image of two dimensions, which the point data's texture
   * coordinates place, wrapped and interpolated as the vtkTexture says. Its opacity is ignored, and
   * so are UseSRGBColorSpace and Mipmap. Null, the default, stands for none.
   */
  void SetTexture(vtkTexture* texture);
  vtkTexture* GetTexture();
  /** @} */

  /** @{ */
  /**
   * Set/Get the direction in which parallel light travels to the objects, of any length: (0, 0, -1)
   * comes from above. With (0, 0, 0), the default, it comes along the ray, as from a lamp at the
   * eye.
   */
  vtkSetVector3Macro(LightDirection, double);
  vtkGetVector3Macro(LightDirection, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the share of the light that has no direction, in [0, 1]. With 1, objects have the
   * colours of their scalars. Default is 0.3.
   */
  virtual void SetAmbient(double share);
  vtkGetMacro(Ambient, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the colour of pixels that show no object: red, green and blue, each from 0 to 1.
   * Default is (0, 0, 0).
   */
  vtkSetVector3Macro(BackgroundColor, double);
  vtkGetVector3Macro(BackgroundColor, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the property by which the medium is seen: its opacity and colour functions, and
   * ScalarOpacityUnitDistance. Null, the default, stands for a medium that is clear.
   */
  void SetVolumeProperty(vtkVolumeProperty* property);
  vtkVolumeProperty* GetVolumeProperty();
  /** @} */

  /** @{ */
  /**
   * Set/Get the name of the array that the property maps, of the mesh's points or, if they have
   * none of that name, of its cells; of several components the first one counts. Default is none,
   * as with an empty name: the array of the medium, which SetInputArrayToProcess() chooses.
   */
  vtkSetStringMacro(VolumeArrayName);
  vtkGetStringMacro(VolumeArrayName);
  /** @} */

  /** @{ */
  /**
   * Set/Get the meaning of the property's opacity, as vtkTetrahedraRayCastMapper::SetOpacityModel()
   * defines it. Default is ATTENUATION_COEFFICIENT.
   */
  meniscusOpacityModelMacro();
  /** @} */

  /** @{ */
  /**
   * Counters by name: a table with one row each and the columns Name, Meaning and Value, which
   * belongs to this object and is filled anew by each call; and the value of one name, such as
   * "NumberOfStoppedRays". An unknown name is an error, and the value is not a number.
   */
  vtkTable* GetStatistics();
  double GetStatistic(const char* name);
  /** @} */

  /** Includes the times of camera, lookup table, texture with its source, and volume property. */
  vtkMTimeType GetMTime() override;

protected:
  vtkTetrahedraMirage();
  ~vtkTetrahedraMirage() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTetrahedraMirage(const vtkTetrahedraMirage&) = delete;
  void operator=(const vtkTetrahedraMirage&) = delete;

  class vtkInternals;

  bool CollectVolume(vtkDataObject* mesh);
  bool ReadVolume();
  bool ReadObjects(vtkDataSet* objects);
  bool TraceRays();
  void WriteArrays(vtkImageData* output);

  double LightDirection[3] = { 0.0, 0.0, 0.0 };
  double Ambient = 0.3;
  double BackgroundColor[3] = { 0.0, 0.0, 0.0 };
  vtkSmartPointer<vtkScalarsToColors> LookupTable;
  vtkSmartPointer<vtkTexture> Texture;
  vtkSmartPointer<vtkVolumeProperty> VolumeProperty;
  char* VolumeArrayName = nullptr;
  int OpacityModel = ATTENUATION_COEFFICIENT;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

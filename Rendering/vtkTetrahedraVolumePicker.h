// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraVolumePicker
 * @brief   picks volumes of vtkTetrahedraRayCastMapper by the part that is seen in a pixel
 *
 * Pick() casts the ray of one pixel through each volume of the renderer whose mapper is a
 * vtkTetrahedraRayCastMapper, and finds three places on it. Their meaning follows the mapper's
 * blend mode:
 *
 * - composite: FIRST_VISIBLE is the first place with opacity; OPACITY_REACHED the place at which
 *   the accumulated opacity reaches OpacityThreshold; LARGEST_CONTRIBUTION the place with the
 *   largest product of attenuation and transmittance, which is the contribution per length;
 * - isosurface: the first visible surface; the surface with which the opacity reaches
 *   OpacityThreshold; the surface that contributes most;
 * - maximum, minimum: the first place of the extreme, for all three;
 * - average: the first place with a scalar, for all three;
 * - additive: as composite blending with the same functions.
 *
 * Opacity is computed as in the picture, by the opacity functions of the scalar or of its
 * components and by gradient opacity. The volume's matrix, the mapper's clipping planes, the
 * camera's clipping range and the mapper's refracting surfaces are taken into account; behind such
 * surfaces the true place is picked. Early termination and pre-integration have no effect.
 *
 * Place chooses the place that the getters without an argument return. If the ray meets several
 * volumes, the picker takes the one whose place has the smallest depth. Volumes of other mappers
 * and other props are not picked. As in VTK's pickers, only visible and pickable props count, or
 * the props of the pick list, and StartPickEvent, PickEvent and EndPickEvent are sent.
 *
 * A pick needs neither a frame nor OpenGL, but a render window with a size. It brings the mapper's
 * tables up to date, as a frame does, so that a frame after a pick finds them ready, and a pick
 * after a frame too. The places of the vertices relative to the ray are computed once per pick.
 * Identifying the input's cells takes a table of 4 bytes per tetrahedron, made at the first pick of
 * a mesh.
 *
 * @sa vtkTetrahedraRayCastMapper vtkTetrahedraRayIntegral vtkVolumePicker
 */
#ifndef vtkTetrahedraVolumePicker_h
#define vtkTetrahedraVolumePicker_h

#include "vtkAbstractPropPicker.h"
#include "vtkMeniscusModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkCompositeDataSet;
class vtkDataSet;
class vtkTetrahedraRayCastMapper;

class VTKMENISCUS_EXPORT vtkTetrahedraVolumePicker : public vtkAbstractPropPicker
{
public:
  static vtkTetrahedraVolumePicker* New();
  vtkTypeMacro(vtkTetrahedraVolumePicker, vtkAbstractPropPicker);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Places on a ray. The class comment describes them for each blend mode. */
  enum
  {
    FIRST_VISIBLE = 0,       ///< first place with opacity
    OPACITY_REACHED = 1,     ///< the accumulated opacity reaches OpacityThreshold
    LARGEST_CONTRIBUTION = 2 ///< largest contribution to the pixel
  };

  /** @{ */
  /** Set/Get the place that is picked. Default is LARGEST_CONTRIBUTION. */
  virtual void SetPlace(int place);
  vtkGetMacro(Place, int);
  void SetPlaceToFirstVisible() { this->SetPlace(FIRST_VISIBLE); }
  void SetPlaceToOpacityReached() { this->SetPlace(OPACITY_REACHED); }
  void SetPlaceToLargestContribution() { this->SetPlace(LARGEST_CONTRIBUTION); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the accumulated opacity of OPACITY_REACHED, from 0 to 1. A medium never reaches 1.
   * Default is 0.5.
   */
  virtual void SetOpacityThreshold(double threshold);
  vtkGetMacro(OpacityThreshold, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether the ray ends at the opaque geometry of the last frame, whose depth is read from
   * the window. Before the first frame it has no effect. Default is off.
   */
  vtkSetMacro(UseOpaqueDepth, vtkTypeBool);
  vtkGetMacro(UseOpaqueDepth, vtkTypeBool);
  vtkBooleanMacro(UseOpaqueDepth, vtkTypeBool);
  /** @} */

  /**
   * Picks at a place in display coordinates, by the ray through the centre of the pixel that
   * contains it. selectionZ has no effect. Returns 1 if a volume was picked; otherwise, and for
   * pixels outside the renderer's viewport, 0.
   */
  int Pick(double selectionX, double selectionY, double selectionZ, vtkRenderer* renderer) override;
  /** As above. */
  int Pick(double selectionPt[3], vtkRenderer* renderer)
  {
    return this->Pick(selectionPt[0], selectionPt[1], selectionPt[2], renderer);
  }

  /** @{ */
  /** Picked place in the coordinates of the mapper's input; GetPickPosition() is in the world. */
  vtkGetVectorMacro(MapperPosition, double, 3);
  /** @} */

  /** @{ */
  /** Mapper and data set that were picked; null if there is none. */
  vtkGetObjectMacro(Mapper, vtkTetrahedraRayCastMapper);
  vtkGetObjectMacro(DataSet, vtkDataSet);
  vtkGetObjectMacro(CompositeDataSet, vtkCompositeDataSet);
  /** @} */

  /** @{ */
  /**
   * Properties of the picked place: index of its cell in the data set, the flat index of the data
   * set in a composite one, the index of its isosurface in the property, the scalar, and the depth,
   * which is the distance in world coordinates along the ray from the camera (with parallel
   * projection, from the plane through it). Indices are -1 and numbers NaN if there is none.
   */
  vtkIdType GetCellId() { return this->GetCellIdOf(this->Place); }
  vtkIdType GetFlatBlockIndex() { return this->GetFlatBlockIndexOf(this->Place); }
  int GetSurfaceIndex() { return this->GetSurfaceIndexOf(this->Place); }
  double GetValue() { return this->GetValueOf(this->Place); }
  double GetDepth() { return this->GetDepthOf(this->Place); }
  /** @} */

  /** @{ */
  /**
   * Properties of any of the three places on the ray through the picked volume, and their positions
   * in world coordinates. GetPositionOf() returns false if the ray has no such place.
   */
  vtkIdType GetCellIdOf(int place);
  vtkIdType GetFlatBlockIndexOf(int place);
  int GetSurfaceIndexOf(int place);
  double GetValueOf(int place);
  double GetDepthOf(int place);
  bool GetPositionOf(int place, double position[3]);
  /** @} */

protected:
  vtkTetrahedraVolumePicker();
  ~vtkTetrahedraVolumePicker() override;

  void Initialize() override;

private:
  vtkTetrahedraVolumePicker(const vtkTetrahedraVolumePicker&) = delete;
  void operator=(const vtkTetrahedraVolumePicker&) = delete;

  class vtkInternals;

  bool FindPixel(double x, double y);
  float ReadOpaqueDepth(double x, double y);
  void PickProp(vtkProp* prop);
  void PickVolume(vtkAssemblyPath* path);

  int Place = LARGEST_CONTRIBUTION;
  double OpacityThreshold = 0.5;
  vtkTypeBool UseOpaqueDepth = 0;
  double MapperPosition[3] = { 0.0, 0.0, 0.0 };
  vtkTetrahedraRayCastMapper* Mapper = nullptr;
  vtkDataSet* DataSet = nullptr;
  vtkCompositeDataSet* CompositeDataSet = nullptr;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

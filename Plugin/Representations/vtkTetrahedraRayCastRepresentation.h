// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastRepresentation
 * @brief   ParaView's volume representation of unstructured grids, drawn by
 *          vtkTetrahedraRayCastMapper
 *
 * ParaView fills the list of mappers of vtkUnstructuredGridVolumeRepresentation in C++; this class
 * adds vtkTetrahedraRayCastMapper under the name `Tetrahedra ray cast` and forwards its settings.
 * The surface shown during interaction is inherited. On one rank the mapper gets the cells as they
 * are; ParaView's own volumes divide them into tetrahedra first, in every time step.
 *
 * For an array of several components, the colour map selects one or the length, as for ParaView's
 * volumes of image data. With MultiComponentsMapping, without MapScalars, or with a separate
 * opacity array, components are mixed as vtkTetrahedraRayCastMapper documents.
 *
 * On several ranks, each gets the cells of a box, cut at its sides. ParaView's own representation
 * assigns whole cells to one box, so that parts outside the box are composited in the wrong order.
 * Cells of a rank that does not have the selected array are left out, with a warning; ParaView
 * would drop the array on all ranks.
 *
 * Ports 1 to 3 are optional membranes at which rays are refracted: vtkPolyData, or composite data
 * of it. Several of them, and closed bodies, need a table of interfaces (SetInterfaceRow()), which
 * numbers those that are set from 0, in the order of the ports. The parts of all ranks are gathered
 * and delivered to every process that renders. Images of several ranks are composited in the order
 * of straight rays, which is also right for rays refracted at planes across an axis; any other
 * membrane causes a warning, once for each change of it. See Documentation/parallel.md.
 *
 * When a view resets its camera, it shows all cells that have a volume, and the membranes. Points
 * without such a cell do not count, in contrast to ParaView's own volumes.
 *
 * While this representation is visible, the view does not peel volumes: translucent geometry is
 * drawn first and the volume over it. ParaView peels volumes by default, which mappers of
 * unstructured grids do not support.
 */
#ifndef vtkTetrahedraRayCastRepresentation_h
#define vtkTetrahedraRayCastRepresentation_h

#include "InterfaceTable.h"                   // For the interfaces
#include "vtkContourValues.h"                 // For the isosurfaces
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkNew.h"                           // For the mapper
#include "vtkSmartPointer.h"                  // For the membranes
#include "vtkTetrahedraRayCastMapper.h"       // For the settings
#include "vtkUnstructuredGridVolumeRepresentation.h"
#include "vtkVolumeProperty.h" // For the settings

class vtkExtractBlockUsingDataAssembly;
class vtkMultiBlockDataSet;
class vtkPolyData;

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkTetrahedraRayCastRepresentation
  : public vtkUnstructuredGridVolumeRepresentation
{
public:
  static vtkTetrahedraRayCastRepresentation* New();
  vtkTypeMacro(vtkTetrahedraRayCastRepresentation, vtkUnstructuredGridVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inputs, vtkInformation* outputs) override;
  void SetVisibility(bool visible) override;

  /** @{ */
  /** Choice of the blocks of a composite data set, as in the superclass. */
  void SetActiveAssembly(const char* name);
  void AddBlockSelector(const char* selector);
  void RemoveAllBlockSelectors();
  /** @} */

  /** @{ */
  /** Forwarded to the mapper. */
  void SetBackend(int backend) { this->Mapper->SetBackend(backend); }
  void SetBlendMode(int mode);
  void SetIntegration(int integration) { this->Mapper->SetIntegration(integration); }
  void SetPreIntegrationScalarSize(int size) { this->Mapper->SetPreIntegrationScalarSize(size); }
  void SetPreIntegrationLengthSize(int size) { this->Mapper->SetPreIntegrationLengthSize(size); }
  void SetOpacityModel(int model) { this->Mapper->SetOpacityModel(model); }
  void SetGradients(int location) { this->Mapper->SetGradients(location); }
  void SetGlobalIlluminationReach(double reach)
  {
    this->Mapper->SetGlobalIlluminationReach(static_cast<float>(reach));
  }
  void SetVolumetricScatteringBlending(double blending)
  {
    this->Mapper->SetVolumetricScatteringBlending(static_cast<float>(blending));
  }
  void SetCellDivision(int division) { this->Mapper->SetCellDivision(division); }
  void SetDivisionTolerance(double tolerance) { this->Mapper->SetDivisionTolerance(tolerance); }
  void SetMaximumNumberOfPieces(int pieces) { this->Mapper->SetMaximumNumberOfPieces(pieces); }
  void SetEarlyTerminationOpacity(double opacity)
  {
    this->Mapper->SetEarlyTerminationOpacity(opacity);
  }
  void SetAutoAdjustSampleDistances(bool adjust)
  {
    this->Mapper->SetAutoAdjustSampleDistances(adjust);
  }
  void SetImageSampleDistance(double distance)
  {
    this->Mapper->SetImageSampleDistance(static_cast<float>(distance));
  }
  void SetMaximumImageSampleDistance(double distance)
  {
    this->Mapper->SetMaximumImageSampleDistance(static_cast<float>(distance));
  }
  /** @} */

  /** @{ */
  /** Indices of refraction of a single membrane. */
  void SetExteriorIndexOfRefraction(double index)
  {
    this->Table.GetSingle()->SetExteriorIndexOfRefraction(index);
  }
  void SetInteriorIndexOfRefraction(double index)
  {
    this->Table.GetSingle()->SetInteriorIndexOfRefraction(index);
  }
  /** @} */

  /** @{ */
  /** Medium behind the membrane; forwarded to the mapper. */
  void SetMediumModel(int model) { this->Mapper->SetMediumModel(model); }
  void SetMediumAttenuationCoefficients(double red, double green, double blue)
  {
    this->Mapper->SetMediumAttenuationCoefficients(red, green, blue);
  }
  void SetMediumRange(double begin, double end) { this->Mapper->SetMediumRange(begin, end); }
  void SetMediumColor(double red, double green, double blue)
  {
    this->Mapper->SetMediumColor(red, green, blue);
  }
  /** @} */

  /** @{ */
  /** Table of interfaces, in the order in which rays meet them; see meniscus::InterfaceTable. */
  void SetNumberOfInterfaceRows(int rows);
  void SetInterfaceRow(int row, double surface, double exterior, double interior);
  /** @} */

  /** @{ */
  /** Forwarded to the volume's property. */
  void SetShade(bool shade) { this->Property->SetShade(shade); }
  void SetAmbient(double ambient) { this->Property->SetAmbient(ambient); }
  void SetDiffuse(double diffuse) { this->Property->SetDiffuse(diffuse); }
  void SetSpecular(double specular) { this->Property->SetSpecular(specular); }
  void SetSpecularPower(double power) { this->Property->SetSpecularPower(power); }
  void SetNumberOfIsosurfaces(int number)
  {
    this->Property->GetIsoSurfaceValues()->SetNumberOfContours(number);
  }
  void SetIsosurfaceValue(int number, double value)
  {
    this->Property->GetIsoSurfaceValues()->SetValue(number, value);
  }
  /** @} */

protected:
  vtkTetrahedraRayCastRepresentation();
  ~vtkTetrahedraRayCastRepresentation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void UpdateMapperParameters() override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkTetrahedraRayCastRepresentation(const vtkTetrahedraRayCastRepresentation&) = delete;
  void operator=(const vtkTetrahedraRayCastRepresentation&) = delete;

  /**
   * Hands the cells of the input over as they are. Returns false if the superclass has to prepare
   * them: for other mappers, and on several ranks, which exchange and cut cells.
   */
  bool TakeWholeCells(vtkInformationVector* input);
  void LeaveOutWithoutArray();
  bool UpdateMembranes(vtkInformationVector** inputs);
  void SetMapperMembranes(vtkMultiBlockDataSet* delivered);
  void WarnOfOrder(vtkMTimeType time);
  void LetViewPeelVolumes(bool peel);

  vtkNew<vtkTetrahedraRayCastMapper> Mapper;
  /** Has this rank's cells before they are delivered, and measures those that are drawn. */
  vtkNew<vtkTetrahedraRayCastMapper> Measuring;
  /** Chooses the blocks of a composite data set. */
  vtkNew<vtkExtractBlockUsingDataAssembly> Blocks;
  meniscus::InterfaceTable Table;
  /**
   * Membranes gathered on this rank, a block for each row of the table; a surface that is in
   * several rows is in the first of them. One empty block if there is no membrane, because every
   * process must receive a data object.
   */
  vtkSmartPointer<vtkMultiBlockDataSet> Membranes;
  /** Time of the inputs for which the user was last warned. */
  vtkMTimeType MembraneTime = 0;
  bool HasStoppedPeeling = false;
};

#endif

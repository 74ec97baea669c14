// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastRepresentation
 * @brief   ParaView's volume representation of unstructured grids, drawn by
 *          vtkTetrahedraRayCastMapper
 *
 * ParaView fills the list of mappers of vtkUnstructuredGridVolumeRepresentation in C++; this class
 * adds ours under the name `Tetrahedra ray cast`. Everything else (splitting cells into tetrahedra,
 * the surface shown during interaction, redistribution between ranks) is inherited.
 */
#ifndef vtkTetrahedraRayCastRepresentation_h
#define vtkTetrahedraRayCastRepresentation_h

#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkUnstructuredGridVolumeRepresentation.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkTetrahedraRayCastRepresentation
  : public vtkUnstructuredGridVolumeRepresentation
{
public:
  static vtkTetrahedraRayCastRepresentation* New();
  vtkTypeMacro(vtkTetrahedraRayCastRepresentation, vtkUnstructuredGridVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkTetrahedraRayCastRepresentation();
  ~vtkTetrahedraRayCastRepresentation() override;

private:
  vtkTetrahedraRayCastRepresentation(const vtkTetrahedraRayCastRepresentation&) = delete;
  void operator=(const vtkTetrahedraRayCastRepresentation&) = delete;
};

#endif

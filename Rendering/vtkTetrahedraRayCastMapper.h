// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastMapper
 * @brief   ray casts a tetrahedral vtkUnstructuredGrid
 */
#ifndef vtkTetrahedraRayCastMapper_h
#define vtkTetrahedraRayCastMapper_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkUnstructuredGridVolumeMapper.h"

#include <memory> // For std::unique_ptr

class VTKMENISCUS_EXPORT vtkTetrahedraRayCastMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  static vtkTetrahedraRayCastMapper* New();
  vtkTypeMacro(vtkTetrahedraRayCastMapper, vtkUnstructuredGridVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkTetrahedraRayCastMapper();
  ~vtkTetrahedraRayCastMapper() override;

private:
  vtkTetrahedraRayCastMapper(const vtkTetrahedraRayCastMapper&) = delete;
  void operator=(const vtkTetrahedraRayCastMapper&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif

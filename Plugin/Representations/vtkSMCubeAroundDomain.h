// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMCubeAroundDomain
 * @brief   default box around a surface, with room on both sides of a flat one
 *
 * For a property of six numbers, minimum and maximum along each axis. The range along each axis is
 * as long as the longest side of the input's bounds and centred in them.
 */
#ifndef vtkSMCubeAroundDomain_h
#define vtkSMCubeAroundDomain_h

#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkSMBoundsDomain.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkSMCubeAroundDomain : public vtkSMBoundsDomain
{
public:
  static vtkSMCubeAroundDomain* New();
  vtkTypeMacro(vtkSMCubeAroundDomain, vtkSMBoundsDomain);

  void Update(vtkSMProperty* property) override;

protected:
  vtkSMCubeAroundDomain();
  ~vtkSMCubeAroundDomain() override;

private:
  vtkSMCubeAroundDomain(const vtkSMCubeAroundDomain&) = delete;
  void operator=(const vtkSMCubeAroundDomain&) = delete;
};

#endif

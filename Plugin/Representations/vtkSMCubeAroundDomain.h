// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMCubeAroundDomain
 * @brief   ParaView's default of a box around a surface: with room on both sides of a flat one
 *
 * For a property of six numbers, least and most along each axis. The range of each axis is as long
 * as the longest side of the input's bounds, around the middle of its own.
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
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Update(vtkSMProperty* property) override;

protected:
  vtkSMCubeAroundDomain();
  ~vtkSMCubeAroundDomain() override;

private:
  vtkSMCubeAroundDomain(const vtkSMCubeAroundDomain&) = delete;
  void operator=(const vtkSMCubeAroundDomain&) = delete;
};

#endif

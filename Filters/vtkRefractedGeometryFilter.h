// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefractedGeometryFilter
 * @brief   virtual geometry of what lies behind a refracting surface
 */
#ifndef vtkRefractedGeometryFilter_h
#define vtkRefractedGeometryFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKMENISCUS_EXPORT vtkRefractedGeometryFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkRefractedGeometryFilter* New();
  vtkTypeMacro(vtkRefractedGeometryFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkRefractedGeometryFilter();
  ~vtkRefractedGeometryFilter() override;

private:
  vtkRefractedGeometryFilter(const vtkRefractedGeometryFilter&) = delete;
  void operator=(const vtkRefractedGeometryFilter&) = delete;
};

#endif

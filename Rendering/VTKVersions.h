// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The one place where versions of VTK differ for us.
#ifndef VTKVersions_h
#define VTKVersions_h

#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

namespace meniscus
{

/** The object that holds the faces of polyhedra; none if there are no polyhedra. */
inline vtkObject* FacesOf(vtkUnstructuredGrid* grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  return grid->GetPolyhedronFaces();
#else
  return grid->GetFaces();
#endif
}

}

#endif

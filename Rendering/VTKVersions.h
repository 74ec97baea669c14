// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The one place where versions of VTK differ for us.
#ifndef VTKVersions_h
#define VTKVersions_h

#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
#include "vtkCellTypeUtilities.h"
#else
#include "vtkCellTypes.h"
#endif

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

/** What a type of cells is called, such as "vtkWedge"; may be null. */
inline const char* NameOfCellType(int type)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return vtkCellTypeUtilities::GetClassNameFromTypeId(type);
#else
  return vtkCellTypes::GetClassNameFromTypeId(type);
#endif
}

}

#endif

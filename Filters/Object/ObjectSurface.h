// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <list>

class vtkDataSet;
class vtkIdTypeArray;
class vtkPolyData;

namespace meniscus
{

/** Surface of a data set, and where its points and cells come from. */
struct ObjectSurface
{
  vtkSmartPointer<vtkPolyData> Data;      ///< the data set itself if nothing has to be changed
  vtkSmartPointer<vtkIdTypeArray> Points; ///< ids in the data set; null if they are the same
  vtkSmartPointer<vtkIdTypeArray> Cells;

  /** Replaces ids of the surface in the arrays of a filter's output by ids of the data set. */
  void RestoreIds(vtkPolyData* output) const;
};

/**
 * Surfaces of the data sets that a filter takes: of a grid its outer faces, of a vtkPolyData itself
 * with triangles in place of polygons that are not convex, which VTK would draw as fans. They are
 * kept as long as the data sets exist and do not change.
 */
class ObjectSurfaces
{
public:
  ObjectSurface Get(vtkDataSet* input);

private:
  struct Entry
  {
    vtkWeakPointer<vtkDataSet> Source;
    vtkMTimeType Time = 0;
    ObjectSurface Surface; ///< without data if it is the source itself, which is not kept alive
  };

  std::list<Entry> Entries;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_InputBlocks_h
#define meniscus_Rendering_Input_InputBlocks_h

#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;

namespace meniscus
{

/** What is to be told about an input; empty texts if nothing is. */
struct InputReport
{
  /** Why nothing can be drawn. */
  std::string Error;
  /** What is left out of the picture. */
  std::string Warning;
};

/** What scalars belong to. */
enum class FieldAssociation
{
  Points,
  Cells
};

/** Which array is drawn, in the terms of vtkAbstractVolumeMapper, and what of it. */
struct ScalarSelection
{
  int ScalarMode = 0;
  int AccessMode = 0;
  int ArrayId = -1;
  const char* ArrayName = nullptr;
  /** The length of the tuple. */
  static constexpr int Magnitude = -1;
  /** The one component that there is, or all if they mix. */
  static constexpr int Only = -2;
  /** A component, from 0, or one of these. */
  int Component = Only;
};

/** A data set with cells, and its scalars: a tuple per point or cell. */
struct InputPart
{
  vtkDataSet* Grid = nullptr;
  vtkDataArray* Scalars = nullptr;
};

/** What is drawn: one data set, or the leaves of a composite one. */
struct InputBlocks
{
  std::vector<InputPart> Parts;
  FieldAssociation Place = FieldAssociation::Points;
};

/**
 * Finds the data sets and scalars of an input. Leaves of a composite data set that have no usable
 * scalars, or have them in another place than the first that has some, are left out with a warning;
 * leaves without cells and surfaces (vtkPolyData) without. No part and no error: there is nothing.
 */
InputReport CollectInputBlocks(
  vtkDataObject* input, const ScalarSelection& selection, InputBlocks& parts);

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkInformation;

namespace meniscus
{

/** Messages about an input; empty if there are none. */
struct InputReport
{
  /** Reason why nothing can be drawn. */
  std::string Error;
  /** Parts of the input that are not drawn. */
  std::string Warning;
};

/** Association of scalars with points or cells. */
enum class FieldAssociation
{
  Points,
  Cells
};

/**
 * Selection of the array to draw, in the terms of vtkAbstractVolumeMapper, and of its component.
 */
struct ScalarSelection
{
  int ScalarMode = 0;
  int AccessMode = 0;
  int ArrayId = -1;
  const char* ArrayName = nullptr;
  /** Length of the tuple. */
  static constexpr int Magnitude = -1;
  /** The only component, or all components if they are mixed. */
  static constexpr int Only = -2;
  /** A component, from 0, or one of the constants above. */
  int Component = Only;
};

/** A data set with cells, and its scalars: one tuple per point or cell. */
struct InputPart
{
  vtkDataSet* Grid = nullptr;
  vtkDataArray* Scalars = nullptr;
};

/** Input blocks to draw: one data set, or the leaves of a composite one. */
struct InputBlocks
{
  std::vector<InputPart> Parts;
  FieldAssociation Place = FieldAssociation::Points;
};

/** Makes a port accept data sets and composite data, which comes whole. Returns 1. */
int AcceptDataSets(vtkInformation* port);

/**
 * Finds the data sets and scalars of an input. Leaves of a composite data set are left out with a
 * warning if they have no usable scalars or if their scalars have another association (points or
 * cells) than the scalars of the first leaf that has some; leaves without cells, and surfaces
 * (vtkPolyData), are left out without a warning. If there is no part and no error, there is nothing
 * to draw.
 */
InputReport CollectInputBlocks(
  vtkDataObject* input, const ScalarSelection& selection, InputBlocks& parts);

/**
 * Finds an array of points by its name or, if the points have none, of cells.
 * @param component as in ScalarSelection.
 */
InputReport CollectNamedArray(
  vtkDataObject* input, const char* name, int component, InputBlocks& parts);

/**
 * Data sets with cells that can be drawn, without scalars: the input itself or the leaves of a
 * composite one. Surfaces (vtkPolyData) and data sets whose arrays contradict each other are left
 * out.
 */
InputBlocks CollectGrids(vtkDataObject* input);

/** True if both have the same data sets in the same order. */
bool HaveSameGrids(const InputBlocks& a, const InputBlocks& b);

/** The data sets of the parts, in their order. */
std::vector<vtkDataSet*> GetGrids(const InputBlocks& input);

}

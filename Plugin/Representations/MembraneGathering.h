// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MembraneGathering_h
#define MembraneGathering_h

#include "vtkSmartPointer.h"

#include <functional> // For the function to run

class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
class vtkPolyData;

namespace meniscus
{

/**
 * The whole membrane on every rank of ParaView's server: the parts of all ranks, and all blocks if
 * it is composite, without ghost cells and in the order of the ranks. Points of different pieces
 * that coincide bit by bit become one, so that the surface is connected across seams; a single
 * piece is not changed. Must be called by all ranks alike. Returns null if the ranks could not
 * exchange data.
 */
vtkSmartPointer<vtkPolyData> GatherMembrane(vtkDataObject* local);

/**
 * All membranes of a port, gathered one after the other, as an input that holds only data. Returns
 * null if the ranks could not exchange data.
 */
vtkSmartPointer<vtkInformationVector> GatherMembranes(vtkInformationVector* port);

/**
 * True if the surface is a plane across a coordinate axis: all its points have the same coordinate,
 * and its point normals, if any, have no other component, up to the rounding of single precision.
 * Refraction at such a plane reverses no component of a ray, so refracted rays meet boxes along the
 * axes in the order of straight ones.
 */
bool IsPlaneAcrossAxis(vtkPolyData* surface);

/** Makes a port accept composite data besides vtkPolyData, without a loop over its blocks. */
void AcceptComposite(vtkInformation* port);

/** Makes an output composite if the input is. */
int MakeOutputLikeInput(vtkInformationVector* inputs, vtkInformationVector* outputs);

/**
 * Requests this rank's piece of the membranes: filters that distribute data cannot deliver the
 * whole.
 */
void AskForPiece(vtkInformationVector* membranes, vtkInformationVector* outputs);

/** Empties the output on all ranks but the first. */
void KeepOutputOfFirstRank(vtkInformationVector* outputs);

/**
 * Calls `run` with the first input and the output, or with each block of them of class `type`
 * (other blocks stay empty), and with the membranes as the second input. Returns false if any call
 * does.
 */
bool RunBlocks(const char* type, vtkInformationVector** inputs, vtkInformationVector* outputs,
  vtkInformationVector* membranes,
  const std::function<int(vtkInformationVector** inputs, vtkInformationVector* outputs)>& run);

/** An input or output that holds only the data object. */
vtkSmartPointer<vtkInformationVector> WrapData(vtkDataObject* data);

}

#endif

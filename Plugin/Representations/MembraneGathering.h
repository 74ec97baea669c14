// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MembraneGathering_h
#define MembraneGathering_h

#include "vtkSmartPointer.h"

#include <functional> // For what is run

class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
class vtkPolyData;

namespace meniscus
{

/**
 * The whole membrane on every rank of ParaView's server: what all ranks have of it, and all blocks
 * if it is composite, without ghost cells and in the order of the ranks. Points of different pieces
 * that coincide bit by bit become one, so that the surface hangs together across seams; of one
 * piece nothing is changed. To be called by all ranks alike. Null if the ranks could not exchange.
 */
vtkSmartPointer<vtkPolyData> GatherMembrane(vtkDataObject* local);

/**
 * Whether the surface is a plane across a coordinate axis: all its points have the same coordinate,
 * and its point normals, if it has them, no other component, up to the rounding of single
 * precision. Refraction turns no component of a ray round there, so bent rays meet boxes along the
 * axes in the order of straight ones.
 */
bool IsPlaneAcrossAxis(vtkPolyData* surface);

/** Lets a port take composite data beside vtkPolyData, without a loop over its blocks. */
void AcceptComposite(vtkInformation* port);

/** Lets an output be composite as the input is. */
int MakeOutputLikeInput(vtkInformationVector* inputs, vtkInformationVector* outputs);

/**
 * Asks for this rank's piece of the membrane: all of it is not to be had from filters that
 * distribute data.
 */
void AskForPiece(vtkInformationVector* membrane, vtkInformationVector* outputs);

/**
 * Calls `run` with the first input and the output, or with each block of them that is vtkPolyData
 * and nothing in place of others, and with the membrane as second input. False if it does so for
 * any.
 */
bool RunBlocks(vtkInformationVector** inputs, vtkInformationVector* outputs, vtkPolyData* membrane,
  const std::function<int(vtkInformationVector** inputs, vtkInformationVector* outputs)>& run);

/** An input or output that holds the data object alone. */
vtkSmartPointer<vtkInformationVector> WrapData(vtkDataObject* data);

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MembraneGathering_h
#define MembraneGathering_h

#include "vtkSmartPointer.h"

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

/** Lets a port take composite data beside vtkPolyData, without a loop over its blocks. */
void AcceptComposite(vtkInformation* port);

/** An input or output that holds the data object alone. */
vtkSmartPointer<vtkInformationVector> WrapData(vtkDataObject* data);

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTriangulatedPositionFilter.h"

#include "MembraneGathering.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

meniscusSurfaceGatheringMacro(vtkPVTriangulatedPositionFilter, ComputeInputUpdateExtent, 1, false);

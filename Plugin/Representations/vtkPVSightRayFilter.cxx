// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVSightRayFilter.h"

#include "MembraneGathering.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

meniscusSurfaceGatheringMacro(vtkPVSightRayFilter, ComputeInputUpdateExtent, 1, false);

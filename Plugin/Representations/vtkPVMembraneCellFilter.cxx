// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVMembraneCellFilter.h"

#include "MembraneGathering.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

meniscusSurfaceGatheringMacro(vtkPVMembraneCellFilter, RequestUpdateExtent, 0, false);

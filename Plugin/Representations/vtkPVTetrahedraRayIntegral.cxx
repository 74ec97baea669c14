// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVTetrahedraRayIntegral.h"

#include "MembraneGathering.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"

meniscusSurfaceGatheringMacro(vtkPVTetrahedraRayIntegral, RequestUpdateExtent, 1, true);

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Counters and statistics of vtkTetrahedraRayCastMapper.
#include "Rendering/RayCastMapperInternals.h"

#include "vtkTetrahedraRayCastMapper.h"

#include <cstddef>

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfMeshBuilds()
{
  return this->Internals->Input.GetMeshBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfScalarUpdates()
{
  return this->Internals->Input.GetScalarUpdates();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfTransferFunctionBuilds()
{
  return this->Internals->Property.GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfGradientBuilds()
{
  return this->Internals->GetGradientBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfPreIntegrationBuilds()
{
  return this->Internals->PreIntegration.GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfMembraneBuilds()
{
  return this->Internals->Membrane.GetBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfSightUpdates()
{
  return this->Internals->Membrane.GetSightUpdates();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfRefractedEntryLists()
{
  return this->Internals->OpenGL.GetNumberOfRefractedEntryLists();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfBentEntryLists()
{
  return this->GetNumberOfRefractedEntryLists();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfEntryListBuilds()
{
  return this->Internals->GetEntryListBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfActiveSetBuilds()
{
  return this->Internals->Input.GetActiveSetBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetUploadedBytes()
{
  return this->Internals->GetUploadedBytes();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetHostBytes()
{
  const vtkInternals& internals = *this->Internals;
  const std::size_t vectors = internals.Components.GetValues().size();
  const std::size_t table = internals.PreIntegration.GetTable().GetValues().size();
  return internals.Input.GetBytes() + internals.Native.GetBytes() + internals.Membrane.GetBytes() +
    internals.GetEntryListBytes() + internals.GetGradientBytes() +
    static_cast<vtkTypeInt64>(vectors * sizeof(glm::vec3) + table * sizeof(float));
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetDeviceBytes()
{
  return this->Internals->OpenGL.GetTables().GetTableBytes();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfActiveCells()
{
  return this->Internals->Input.GetMesh().GetNumberOfActiveCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfTransparentCells()
{
  return this->Internals->Input.GetMesh().GetNumberOfUnknownCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfRejectedCells()
{
  return this->Internals->Input.GetMesh().GetRejectedCells().Total();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfTraversalSteps()
{
  return this->Internals->OpenGL.GetStatistics().Steps;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfRays()
{
  return this->Internals->OpenGL.GetStatistics().Rays;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfLostRays()
{
  return this->Internals->OpenGL.GetStatistics().Lost;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "VectorMode: " << this->VectorMode << "\n";
  os << indent << "VectorComponent: " << this->VectorComponent << "\n";
  os << indent << "OpacityModel: " << this->OpacityModel << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "ActiveBackend: " << this->ActiveBackend << "\n";
  os << indent << "Integration: " << this->Integration << "\n";
  os << indent << "PreIntegrationScalarSize: " << this->PreIntegrationScalarSize << "\n";
  os << indent << "PreIntegrationLengthSize: " << this->PreIntegrationLengthSize << "\n";
  os << indent << "Gradients: " << this->Gradients << "\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
  os << indent << "ImageSampleDistance: " << this->ImageSampleDistance << "\n";
  os << indent << "MaximumImageSampleDistance: " << this->MaximumImageSampleDistance << "\n";
  os << indent << "AutoAdjustSampleDistances: " << this->AutoAdjustSampleDistances << "\n";
  os << indent << "UsedImageSampleDistance: " << this->UsedImageSampleDistance << "\n";
  os << indent << "EarlyTerminationOpacity: " << this->EarlyTerminationOpacity << "\n";
  os << indent << "NumberOfMeshBuilds: " << this->GetNumberOfMeshBuilds() << "\n";
  os << indent << "NumberOfScalarUpdates: " << this->GetNumberOfScalarUpdates() << "\n";
  os << indent << "NumberOfTransferFunctionBuilds: " << this->GetNumberOfTransferFunctionBuilds()
     << "\n";
  os << indent << "NumberOfGradientBuilds: " << this->GetNumberOfGradientBuilds() << "\n";
  os << indent << "NumberOfPreIntegrationBuilds: " << this->GetNumberOfPreIntegrationBuilds()
     << "\n";
  os << indent << "NumberOfMembraneBuilds: " << this->GetNumberOfMembraneBuilds() << "\n";
  os << indent << "NumberOfSightUpdates: " << this->GetNumberOfSightUpdates() << "\n";
  os << indent << "NumberOfRefractedEntryLists: " << this->GetNumberOfRefractedEntryLists() << "\n";
  os << indent << "NumberOfEntryListBuilds: " << this->GetNumberOfEntryListBuilds() << "\n";
  os << indent << "NumberOfActiveSetBuilds: " << this->GetNumberOfActiveSetBuilds() << "\n";
  os << indent << "UploadedBytes: " << this->GetUploadedBytes() << "\n";
  os << indent << "CompactTables: " << this->CompactTables << "\n";
  os << indent << "ColorBias: " << this->ColorBias << "\n";
  os << indent << "MaximumTableSize: " << this->MaximumTableSize << "\n";
  os << indent << "HostBytes: " << this->GetHostBytes() << "\n";
  os << indent << "DeviceBytes: " << this->GetDeviceBytes() << "\n";
  os << indent << "NumberOfActiveCells: " << this->GetNumberOfActiveCells() << "\n";
  os << indent << "NumberOfTransparentCells: " << this->GetNumberOfTransparentCells() << "\n";
  os << indent << "NumberOfRejectedCells: " << this->GetNumberOfRejectedCells() << "\n";
}

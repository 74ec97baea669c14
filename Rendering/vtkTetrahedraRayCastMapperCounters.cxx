// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Counters and properties of vtkTetrahedraRayCastMapper as it reports them.
#include "Rendering/RayCastMapperInternals.h"

#include "vtkRefractingInterfaceCollection.h"
#include "vtkTetrahedraRayCastMapper.h"

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfMeshBuilds()
{
  return this->Internals->Input.GetBuildVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfPointUpdates()
{
  return this->Internals->Input.GetNumberOfPointUpdates();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfScalarUpdates()
{
  return this->Internals->Input.GetScalarVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfTransferFunctionBuilds()
{
  return this->Internals->Property.GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfGradientBuilds()
{
  return this->Internals->VertexGradients.GetVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfPreIntegrationBuilds()
{
  return this->Internals->PreIntegration.GetVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfMembraneBuilds()
{
  return this->Internals->Membrane.GetShapeVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfSightUpdates()
{
  return this->Internals->Membrane.GetSightVersion().GetChanges();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfRefractedEntryLists()
{
  return this->Internals->GetCounters().RefractedEntryLists;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfBentEntryLists()
{
  return this->GetNumberOfRefractedEntryLists();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfEntryListBuilds()
{
  return this->Internals->GetCounters().EntryListBuilds;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfActiveSetBuilds()
{
  return this->Internals->Input.GetActiveSetBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetUploadedBytes()
{
  return this->Internals->GetCounters().UploadedBytes;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetHostBytes()
{
  const vtkInternals& internals = *this->Internals;
  return internals.GetBytes() + internals.GetCounters().HostBytes +
    (internals.Picker ? internals.Picker->GetBytes() : 0) +
    (internals.DepthCaster ? internals.DepthCaster->GetBytes() : 0) +
    meniscus::BytesOf(internals.Depths);
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetDeviceBytes()
{
  return this->Internals->GetCounters().DeviceBytes;
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
  return this->Internals->Input.GetNumberOfRejectedCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfTraversalSteps()
{
  return this->Internals->GetStatistics().Steps;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfRays()
{
  return this->Internals->GetStatistics().Rays;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfLostRays()
{
  return this->Internals->GetStatistics().Lost;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfCastImages()
{
  return this->Internals->GetNumberOfCasts();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfCastPixels()
{
  return this->Internals->GetCounters().CastPixels;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfUndecidedRays()
{
  return this->Internals->Membrane.GetCounts().Undecided;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfRaysMissingAnInterface()
{
  return this->Internals->Membrane.GetCounts().Missing;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfTotallyReflectedRays()
{
  return this->Internals->Membrane.GetCounts().Reflected;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfTetrahedra()
{
  return this->Internals->Input.GetMesh().GetNumberOfCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfCellDivisions()
{
  return this->Internals->Input.GetDivision().GetNumberOfDivisions();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfFoldedCells()
{
  return this->Internals->Input.GetNumberOfFoldedCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfUnresolvedEdges()
{
  return this->Internals->Input.GetDivision().GetCounts().UnresolvedEdges;
}

//------------------------------------------------------------------------------
double vtkTetrahedraRayCastMapper::GetDivisionError()
{
  return this->Internals->Input.GetDivision().GetCounts().Error;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "VectorMode: " << this->VectorMode << "\n";
  os << indent << "VectorComponent: " << this->VectorComponent << "\n";
  os << indent << "CellDivision: " << this->CellDivision << "\n";
  os << indent << "DivisionTolerance: " << this->DivisionTolerance << "\n";
  os << indent << "MaximumNumberOfPieces: " << this->MaximumNumberOfPieces << "\n";
  os << indent << "OpacityModel: " << this->OpacityModel << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "ActiveBackend: " << this->ActiveBackend << "\n";
  os << indent << "BackendName: " << this->BackendName << "\n";
  os << indent << "ActiveBackendName: " << this->ActiveBackendName << "\n";
  os << indent << "Integration: " << this->Integration << "\n";
  os << indent << "PreIntegrationScalarSize: " << this->PreIntegrationScalarSize << "\n";
  os << indent << "PreIntegrationLengthSize: " << this->PreIntegrationLengthSize << "\n";
  os << indent << "Gradients: " << this->Gradients << "\n";
  os << indent << "NumberOfInterfaces: " << this->Interfaces->GetNumberOfItems() << "\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
  const auto& coefficients = this->MediumAttenuationCoefficients;
  os << indent << "MediumModel: " << this->MediumModel << "\n";
  os << indent << "MediumAttenuationCoefficients: " << coefficients[0] << " " << coefficients[1]
     << " " << coefficients[2] << "\n";
  os << indent << "MediumRange: " << this->MediumRange[0] << " " << this->MediumRange[1] << "\n";
  os << indent << "MediumColor: " << this->MediumColor[0] << " " << this->MediumColor[1] << " "
     << this->MediumColor[2] << "\n";
  os << indent << "GlobalIlluminationReach: " << this->GlobalIlluminationReach << "\n";
  os << indent << "VolumetricScatteringBlending: " << this->VolumetricScatteringBlending << "\n";
  os << indent << "NumberOfShadowCasts: " << this->Internals->Illumination.GetNumberOfCasts()
     << "\n";
  os << indent << "ImageSampleDistance: " << this->ImageSampleDistance << "\n";
  os << indent << "MaximumImageSampleDistance: " << this->MaximumImageSampleDistance << "\n";
  os << indent << "AutoAdjustSampleDistances: " << this->AutoAdjustSampleDistances << "\n";
  os << indent << "UsedImageSampleDistance: " << this->UsedImageSampleDistance << "\n";
  os << indent << "EarlyTerminationOpacity: " << this->EarlyTerminationOpacity << "\n";
  os << indent << "NumberOfMeshBuilds: " << this->GetNumberOfMeshBuilds() << "\n";
  os << indent << "NumberOfPointUpdates: " << this->GetNumberOfPointUpdates() << "\n";
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
  os << indent << "DepthWriting: " << this->DepthWriting << "\n";
  os << indent << "DepthOpacity: " << this->DepthOpacity << "\n";
  os << indent << "MaximumTableSize: " << this->MaximumTableSize << "\n";
  os << indent << "HostBytes: " << this->GetHostBytes() << "\n";
  os << indent << "DeviceBytes: " << this->GetDeviceBytes() << "\n";
  os << indent << "NumberOfTetrahedra: " << this->GetNumberOfTetrahedra() << "\n";
  os << indent << "NumberOfCellDivisions: " << this->GetNumberOfCellDivisions() << "\n";
  os << indent << "NumberOfFoldedCells: " << this->GetNumberOfFoldedCells() << "\n";
  os << indent << "NumberOfUnresolvedEdges: " << this->GetNumberOfUnresolvedEdges() << "\n";
  os << indent << "DivisionError: " << this->GetDivisionError() << "\n";
  os << indent << "NumberOfActiveCells: " << this->GetNumberOfActiveCells() << "\n";
  os << indent << "NumberOfTransparentCells: " << this->GetNumberOfTransparentCells() << "\n";
  os << indent << "NumberOfRejectedCells: " << this->GetNumberOfRejectedCells() << "\n";
  os << indent << "NumberOfCastImages: " << this->GetNumberOfCastImages() << "\n";
  os << indent << "NumberOfCastPixels: " << this->GetNumberOfCastPixels() << "\n";
  os << indent << "NumberOfUndecidedRays: " << this->GetNumberOfUndecidedRays() << "\n";
  os << indent << "NumberOfRaysMissingAnInterface: " << this->GetNumberOfRaysMissingAnInterface()
     << "\n";
  os << indent << "NumberOfTotallyReflectedRays: " << this->GetNumberOfTotallyReflectedRays()
     << "\n";
}

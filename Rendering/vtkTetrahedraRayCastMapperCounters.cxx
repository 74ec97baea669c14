// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Counters and properties of vtkTetrahedraRayCastMapper as it reports them.
#include "Rendering/RayCastMapperInternals.h"

#include "Filters/Common/Accessors.h"

#include "vtkRefractingInterfaceCollection.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <cmath>

meniscusStatisticsMacro(vtkTetrahedraRayCastMapper);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, VectorMode, int, DISABLED, COMPONENT);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, VectorComponent, int, 0, VTK_INT_MAX);
meniscusSetClampMacro(
  vtkTetrahedraRayCastMapper, CellDivision, int, FIXED_DIVISION, ADAPTIVE_DIVISION);
meniscusSetClampMacro(
  vtkTetrahedraRayCastMapper, MaximumNumberOfPieces, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, OpacityModel, int, ATTENUATION_COEFFICIENT,
  OPACITY_PER_UNIT_DISTANCE);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, Backend, int, AUTOMATIC, COMPUTE);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, Integration, int, EXACT, PRE_INTEGRATED);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, PreIntegrationScalarSize, int, 2, 1024);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, PreIntegrationLengthSize, int, 1, 128);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, Gradients, int, CELL_GRADIENTS, VERTEX_GRADIENTS);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, ColorBias, double, 0.0, 0.5);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, DepthWriting, int, NO_DEPTH, OPACITY_DEPTH);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, DepthOpacity, double, 0.0, 1.0);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, EarlyTerminationOpacity, double, 0.0, 1.0);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, MaximumImageSampleDistance, float, 1.0f, 100.0f);
meniscusSetClampMacro(vtkTetrahedraRayCastMapper, MediumModel, int, EXPONENTIAL, LINEAR);
meniscusGetInternalMacro(vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfMeshBuilds(),
  Input.GetBuildVersion().GetChanges());
meniscusGetInternalMacro(vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfScalarUpdates(),
  Input.GetScalarVersion().GetChanges());
meniscusGetInternalMacro(vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfTransferFunctionBuilds(),
  Property.GetNumberOfBuilds());
meniscusGetInternalMacro(
  vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfActiveSetBuilds(), Input.GetActiveSetBuilds());
meniscusGetInternalMacro(
  vtkTetrahedraRayCastMapper, vtkTypeInt64, UploadedBytes(), GetCounters().UploadedBytes);
meniscusGetInternalMacro(vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfActiveCells(),
  Input.GetMesh().GetNumberOfActiveCells());
meniscusGetInternalMacro(vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfRejectedCells(),
  Input.GetNumberOfRejectedCells());
meniscusGetInternalMacro(
  vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfTraversalSteps(), GetStatistics().Steps);
meniscusGetInternalMacro(
  vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfRays(), GetStatistics().Rays);
meniscusGetInternalMacro(
  vtkTetrahedraRayCastMapper, vtkTypeInt64, NumberOfLostRays(), GetStatistics().Lost);

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetImageSampleDistance(float distance)
{
  const float clamped = std::isnan(distance) ? 1.0f : std::min(std::max(distance, 0.1f), 100.0f);
  if (clamped != this->ImageSampleDistance)
  {
    this->ImageSampleDistance = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
std::int64_t vtkTetrahedraRayCastMapper::vtkInternals::GetHostBytes() const
{
  return this->GetBytes() + this->GetCounters().HostBytes +
    (this->Picker ? this->Picker->GetBytes() : 0) +
    (this->DepthCaster ? this->DepthCaster->GetBytes() : 0) + meniscus::BytesOf(this->Depths);
}

//------------------------------------------------------------------------------
/** All numbers that the class reports. */
const std::vector<meniscus::Statistic<vtkTetrahedraRayCastMapper>>&
vtkTetrahedraRayCastMapper::vtkInternals::List()
{
  using Self = vtkTetrahedraRayCastMapper;
  static const std::vector<meniscus::Statistic<Self>> list =
    meniscus::JoinStatistics<Self, meniscus::RayCastTables>(
      meniscus::RayCastTables::ListStatistics(),
      [](Self& self) -> meniscus::RayCastTables& { return *self.Internals; },
      {
        { "NumberOfBoundsBuilds", "boxes around the drawn cells: other points or cells",
          [](Self& self) { return double(self.Internals->Bounds.GetNumberOfBuilds()); } },
        { "NumberOfGradientBuilds", "computations of vertex gradients",
          [](Self& self)
          { return double(self.Internals->VertexGradients.GetVersion().GetChanges()); } },
        { "NumberOfPreIntegrationBuilds", "builds of the pre-integration table",
          [](Self& self)
          { return double(self.Internals->PreIntegration.GetVersion().GetChanges()); } },
        { "NumberOfSightUpdates",
          "intersections of the rays with all membranes: new shape, view or index",
          [](Self& self)
          { return double(self.Internals->Membrane.GetSightVersion().GetChanges()); } },
        { "NumberOfRefractedEntryLists",
          "lists, made on the graphics device, of the entries of refracted rays into the mesh",
          [](Self& self) { return double(self.Internals->GetCounters().RefractedEntryLists); } },
        { "NumberOfEntryListBuilds",
          "lists, made on the CPU for shaders, of the entries of rays that cross many layers",
          [](Self& self) { return double(self.Internals->GetCounters().EntryListBuilds); } },
        { "NumberOfShadowCasts", "casts of the shadows of a light or of the ambient light",
          [](Self& self) { return double(self.Internals->Illumination.GetNumberOfCasts()); } },
        { "NumberOfCastImages", "images whose rays were cast, since construction",
          [](Self& self) { return double(self.Internals->GetNumberOfCasts()); } },
        { "NumberOfCastPixels", "pixels of these images",
          [](Self& self) { return double(self.Internals->GetCounters().CastPixels); } },
        { "UploadedBytes", "bytes of tables that backends have read because an input changed",
          [](Self& self) { return double(self.GetUploadedBytes()); } },
        { "HostBytes", "bytes of the tables that are kept in main memory, without the input",
          [](Self& self) { return double(self.Internals->GetHostBytes()); } },
        { "DeviceBytes", "bytes of the tables that are kept on the graphics device",
          [](Self& self) { return double(self.Internals->GetCounters().DeviceBytes); } },
        { "NumberOfActiveCells", "tetrahedra that rays can visit",
          [](Self& self) { return double(self.GetNumberOfActiveCells()); } },
        { "NumberOfTraversalSteps", "cells that the rays of the last frame crossed",
          [](Self& self) { return double(self.GetNumberOfTraversalSteps()); } },
        { "NumberOfRays", "rays of the last frame that entered the mesh",
          [](Self& self) { return double(self.GetNumberOfRays()); } },
        { "NumberOfLostRays", "rays of the last frame whose walk did not end on the boundary",
          [](Self& self) { return double(self.GetNumberOfLostRays()); } },
        { "NumberOfUndecidedRays",
          "pairs of a ray and a facet's patch that touch within rounding, in the last view",
          [](Self& self) { return double(self.Internals->Membrane.GetCounts().Undecided); } },
        { "NumberOfRaysMissingAnInterface",
          "rays of the last view that were refracted and miss the next interface",
          [](Self& self) { return double(self.Internals->Membrane.GetCounts().Missing); } },
        { "NumberOfTotallyReflectedRays",
          "rays of the last view that are totally reflected behind the first interface",
          [](Self& self) { return double(self.Internals->Membrane.GetCounts().Reflected); } },
        { "NumberOfRefinedPixels",
          "pixels at edges of the last image, which got several rays (native backend)",
          [](Self& self) { return double(self.Internals->GetStatistics().RefinedPixels); } },
        { "NumberOfInterpolatedRays",
          "rays of the last frame, part of NumberOfRays, that were interpolated (native backend)",
          [](Self& self) { return double(self.Internals->GetStatistics().Interpolated); } },
        { "UsedImageSampleDistance", "smallest distance of rays in the last frame, in pixels",
          [](Self& self) { return double(self.UsedImageSampleDistance); } },
      });
  return list;
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
  os << indent << "ImageSampleDistance: " << this->ImageSampleDistance << "\n";
  os << indent << "MaximumImageSampleDistance: " << this->MaximumImageSampleDistance << "\n";
  os << indent << "AutoAdjustSampleDistances: " << this->AutoAdjustSampleDistances << "\n";
  os << indent << "EarlyTerminationOpacity: " << this->EarlyTerminationOpacity << "\n";
  os << indent << "ColorBias: " << this->ColorBias << "\n";
  os << indent << "DepthWriting: " << this->DepthWriting << "\n";
  os << indent << "DepthOpacity: " << this->DepthOpacity << "\n";
  meniscus::PrintStatistics(meniscus::MeasureStatistics(*this, vtkInternals::List()), os, indent);
}

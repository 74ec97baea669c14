// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/RayIntegralInternals.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Rendering/Integral/ImagePlace.h"

#include "vtkAbstractMapper.h"
#include "vtkCamera.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolumeProperty.h"
#include <vtksys/SystemInformation.hxx>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace
{

/** Share of the progress that the mesh takes, if it is built. */
constexpr double ShareOfMesh = 0.5;

/** True if a name is set; an empty one stands for none, as in user interfaces. */
bool HasText(const char* name)
{
  return name && *name;
}

/** Error for an image that exceeds the computer's memory; empty if it fits. */
std::string DescribeExcess(const meniscus::IntegralChoice& choice, const int size[2])
{
  const double bytes = static_cast<double>(sizeof(float)) * size[0] * size[1] *
    static_cast<double>(choice.GetNumbersPerPixel());
  vtksys::SystemInformation system;
  const double memory = 1024.0 * static_cast<double>(system.GetHostMemoryTotal());
  if (bytes <= memory)
  {
    return std::string();
  }
  std::ostringstream text;
  text << "An image of " << size[0] << " by " << size[1] << " pixels with "
       << choice.GetNumbersPerPixel() << " numbers each needs " << bytes / 1.0e9
       << " GB; the computer's memory has " << memory / 1.0e9 << " GB";
  return text.str();
}

/**
 * Collects the scalars that SetInputArrayToProcess() describes. A component of -1 stands for the
 * length of the tuple.
 */
meniscus::InputReport FindScalars(
  vtkDataObject* input, vtkInformation* wanted, int component, meniscus::InputBlocks& blocks)
{
  const int association = wanted->Get(vtkDataObject::FIELD_ASSOCIATION());
  const bool ofPoints = association == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  const bool ofCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
  meniscus::ScalarSelection selection;
  selection.Component = component == -1 ? meniscus::ScalarSelection::Magnitude : component;
  if (!wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    selection.ScalarMode = ofPoints ? VTK_SCALAR_MODE_USE_POINT_DATA
      : ofCells                     ? VTK_SCALAR_MODE_USE_CELL_DATA
                                    : VTK_SCALAR_MODE_DEFAULT;
    return meniscus::CollectInputBlocks(input, selection, blocks);
  }
  selection.ArrayName = wanted->Get(vtkDataObject::FIELD_NAME());
  if (!ofPoints && !ofCells)
  {
    return meniscus::CollectNamedArray(input, selection.ArrayName, selection.Component, blocks);
  }
  selection.AccessMode = VTK_GET_ARRAY_BY_NAME;
  selection.ScalarMode =
    ofCells ? VTK_SCALAR_MODE_USE_CELL_FIELD_DATA : VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
  return meniscus::CollectInputBlocks(input, selection, blocks);
}

/**
 * Sets the number of energy bins to the number of the attenuation's components. Returns an error if
 * another number is wanted, or the attenuation is not in the scalars' data sets.
 */
std::string CountBins(
  const meniscus::InputBlocks& scalars, const meniscus::InputBlocks& attenuation, int& number)
{
  if (!meniscus::HaveSameGrids(attenuation, scalars))
  {
    return "The attenuation array and the scalar are not in the same data sets";
  }
  const int components = attenuation.Parts.front().Scalars->GetNumberOfComponents();
  if (number != 0 && number != components)
  {
    return "The attenuation array has " + std::to_string(components) + " components for " +
      std::to_string(number) + " energy bins";
  }
  number = components;
  return std::string();
}

}

/** One execution of the filter. */
struct vtkTetrahedraRayIntegral::Request
{
  meniscus::IntegralChoice Choice;
  meniscus::InputBlocks Scalars;
  meniscus::InputBlocks Attenuation;
  meniscus::InputBlocks Emission;
  /** True if the attenuation is used as the scalar. */
  bool BinsAlone = false;
  std::vector<vtkPolyData*> Surfaces;
  meniscus::ParallelRectangle Rectangle;
  meniscus::IntegralView View;
};

vtkStandardNewMacro(vtkTetrahedraRayIntegral);
meniscusInterfacePropertiesMacro(vtkTetrahedraRayIntegral);

//------------------------------------------------------------------------------
vtkTetrahedraRayIntegral::vtkTetrahedraRayIntegral()
  : Internals(new vtkInternals)
{
  this->Interfaces = meniscus::MakeInterfaces();
  for (const char* name : meniscus::ListArrayNames())
  {
    this->Internals->Arrays->AddArray(name, name == std::string("Integral"));
  }
  this->SetNumberOfInputPorts(2);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkTetrahedraRayIntegral::~vtkTetrahedraRayIntegral()
{
  this->SetAttenuationArrayName(nullptr);
  this->SetEmissionArrayName(nullptr);
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayIntegral::FillInputPortInformation(int port, vtkInformation* info)
{
  return port == 1 ? meniscus::AcceptSurfaces(info, true) : meniscus::AcceptDataSets(info);
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayIntegral::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputs), vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  meniscus::AnnounceImage(info, this->ImageSize);
  const meniscus::ParallelRectangle rectangle{ glm::make_vec3(this->FrameOrigin),
    glm::make_vec3(this->FrameAxis1), glm::make_vec3(this->FrameAxis2) };
  meniscus::ImagePlace place;
  // The rectangle of FITTED is known when the input is.
  if (this->FrameMode == PARALLEL && meniscus::DescribeBadSize(this->ImageSize).empty() &&
    meniscus::DescribeFault(rectangle).empty())
  {
    place = meniscus::PlaceOf(rectangle, this->ImageSize);
  }
  info->Set(vtkDataObject::ORIGIN(), place.Origin, 3);
  info->Set(vtkDataObject::SPACING(), place.Spacing, 3);
  info->Set(vtkDataObject::DIRECTION(), place.Direction, 9);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayIntegral::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputs, vtkInformationVector* vtkNotUsed(outputs))
{
  meniscus::RequestWholeInputs(inputs, this->GetNumberOfInputPorts());
  return 1;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayIntegral::Tell(const meniscus::InputReport& report)
{
  if (!report.Warning.empty())
  {
    vtkWarningMacro(<< report.Warning);
  }
  return this->TellError(report.Error);
}

//------------------------------------------------------------------------------
/** Reports an error, if there is one. Returns true if there is none. */
bool vtkTetrahedraRayIntegral::TellError(const std::string& error)
{
  if (!error.empty())
  {
    vtkErrorMacro(<< error << "; the output is empty.");
  }
  return error.empty();
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayIntegral::ChooseEvents(Request& request)
{
  meniscus::IntegralChoice& choice = request.Choice;
  meniscus::EventChoice& events = choice.Events;
  events.Opacity = this->EventOpacity;
  const meniscus::BlendModel* model = meniscus::FindBlendModel(this->EventBlendMode);
  if (events.IsAnyWanted() && !model)
  {
    return this->TellError(
      "There is no blend mode of number " + std::to_string(this->EventBlendMode) + " for events");
  }
  events.Blending = model ? model->Mode : meniscus::BlendMode::Composite;
  if (events.IsAnyWanted() && events.HasSurfaces() && choice.NeedsComposite())
  {
    return this->TellError("Events of isosurfaces cannot be in the same image as RGBA or "
                           "OpticalDepth, which are those of composite blending");
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayIntegral::ChooseArrays(Request& request)
{
  meniscus::IntegralChoice& choice = request.Choice;
  const std::string unknown = choice.Want(this->Internals->Arrays);
  if (!unknown.empty())
  {
    return this->TellError("There is no array '" + unknown + "'");
  }
  if (!this->ChooseEvents(request))
  {
    return false;
  }
  choice.HasBinArrays = HasText(this->AttenuationArrayName);
  choice.NumberOfBins = this->GetNumberOfEnergyBins();
  request.BinsAlone = choice.NeedsBinArrays() && !choice.NeedsScalars() &&
    !choice.NeedsProperty() && !choice.Events.IsAnyWanted();
  if (!this->TellError(meniscus::DescribeBadSize(this->ImageSize)))
  {
    return false;
  }
  if (choice.GetNumbersPerPixel() == 0 && !choice.NeedsBinArrays())
  {
    return this->TellError(choice.Has(meniscus::IntegralArray::EnergyBins)
        ? "There are no energy bins; set their number, or an attenuation array"
        : "No array is switched on");
  }
  if (choice.NeedsProperty() && !this->VolumeProperty)
  {
    return this->TellError(choice.NeedsComposite()
        ? "RGBA and OpticalDepth need a volume property"
        : "Events need a volume property in this blend mode");
  }
  const std::vector<meniscus::EnergyBin>& bins = this->Internals->EnergyBins;
  const bool finite = std::all_of(bins.begin(), bins.end(),
    [](const meniscus::EnergyBin& bin)
    {
      return vtkMath::IsFinite(bin.Attenuation) && vtkMath::IsFinite(bin.Emission) &&
        vtkMath::IsFinite(bin.Intensity);
    });
  return this->TellError(finite ? std::string() : "A number of an energy bin is not finite");
}

//------------------------------------------------------------------------------
/** Collects the scalars. Lengths need none: constants stand in if no array is named or active. */
meniscus::InputReport vtkTetrahedraRayIntegral::CollectScalars(
  vtkDataObject* input, Request& request)
{
  vtkInformation* wanted = this->GetInputArrayInformation(0);
  const meniscus::InputReport report =
    FindScalars(input, wanted, this->ArrayComponent, request.Scalars);
  const bool needsNone = !request.Choice.NeedsScalarValues() && !request.Choice.NeedsProperty();
  if (report.Error.empty() || !needsNone || wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    return report;
  }
  meniscus::InputBlocks grids = meniscus::CollectGrids(input);
  if (grids.Parts.empty())
  {
    return report;
  }
  std::vector<vtkSmartPointer<vtkDataArray>>& constants = this->Internals->Constants;
  constants.clear();
  for (meniscus::InputPart& part : grids.Parts)
  {
    auto zeros = vtkSmartPointer<vtkUnsignedCharArray>::New();
    zeros->SetNumberOfTuples(part.Grid->GetNumberOfPoints());
    zeros->Fill(0.0);
    part.Scalars = zeros;
    constants.push_back(zeros);
  }
  request.Scalars = grids;
  return meniscus::InputReport();
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayIntegral::CollectInput(vtkDataObject* input, Request& request)
{
  const bool withArrays = request.Choice.NeedsBinArrays();
  if (withArrays &&
    !this->Tell(
      meniscus::CollectNamedArray(input, this->AttenuationArrayName, 0, request.Attenuation)))
  {
    return false;
  }
  if (withArrays && HasText(this->EmissionArrayName) &&
    !this->Tell(meniscus::CollectNamedArray(input, this->EmissionArrayName, 0, request.Emission)))
  {
    return false;
  }
  if (request.BinsAlone)
  {
    request.Scalars = request.Attenuation;
  }
  else if (!this->Tell(this->CollectScalars(input, request)))
  {
    return false;
  }
  if (request.Scalars.Parts.empty())
  {
    return this->TellError("The input has no cells");
  }
  request.Choice.Events.HasBlocks = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
  return !withArrays ||
    this->TellError(CountBins(request.Scalars, request.Attenuation, request.Choice.NumberOfBins));
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayIntegral::UpdateTables(Request& request)
{
  vtkInternals& internals = *this->Internals;
  meniscus::VolumeInput& input = internals.Input;
  const bool binsOfCells = request.Choice.NeedsBinArrays() &&
    request.Attenuation.Place == meniscus::FieldAssociation::Cells;
  meniscus::InputBlocks meshOf = request.Scalars;
  meshOf.Place = binsOfCells ? meniscus::FieldAssociation::Cells : meshOf.Place;
  const auto goOn = [this](double fraction)
  {
    this->UpdateProgress(ShareOfMesh * fraction);
    return !this->GetAbortExecute();
  };
  const int component = request.BinsAlone ? 0
    : this->ArrayComponent == -1          ? meniscus::ScalarSelection::Magnitude
                                          : this->ArrayComponent;
  meniscus::DivisionRequest division;
  division.Settings = { this->CellDivision == ADAPTIVE_DIVISION, this->DivisionTolerance,
    this->MaximumNumberOfPieces };
  division.Fields = request.Scalars;
  division.Component = component;
  if (!this->Tell(input.UpdateMesh(meshOf, goOn, division)) || this->GetAbortExecute())
  {
    return false;
  }
  if (input.GetMesh().GetNumberOfCells() == 0)
  {
    return this->TellError("The input has no cells that can be used");
  }
  const bool usesProperty = request.Choice.NeedsProperty();
  const meniscus::EventChoice& events = request.Choice.Events;
  const bool hasSurfaces = events.IsAnyWanted() && events.HasSurfaces();
  const meniscus::InputReport ofProperty = internals.Property.Reduce(
    usesProperty ? this->VolumeProperty.Get() : internals.NoProperty.Get(),
    hasSurfaces ? meniscus::BlendMode::Isosurfaces : meniscus::BlendMode::Composite,
    this->OpacityModel == OPACITY_PER_UNIT_DISTANCE, meniscus::ComponentMixture::None, 1);
  if (!this->Tell(ofProperty) ||
    !this->Tell(input.UpdateScalars(request.Scalars, component,
      usesProperty ? internals.Property.GetFeatures() : internals.NoFeatures)))
  {
    return false;
  }
  if (input.GetNormalization().Farthest > 1.0 && request.Choice.NeedsScalarValues())
  {
    return this->TellError("The scalars reach too far beyond the changes of the volume property "
                           "for integrals in the same image; switch off RGBA and OpticalDepth, or "
                           "the other arrays");
  }
  if (events.IsAnyWanted())
  {
    input.FindInputCells(request.Scalars);
  }
  internals.Property.Normalize(input.GetNormalization(), internals.Components);
  input.UpdateActiveCells(
    meniscus::VisibleScalars::All(), meniscus::TetrahedralMesh::CellJumps::Hidden);
  return !request.Choice.NeedsBinArrays() ||
    this->TellError(internals.Bins.Update(input, request.Attenuation, request.Emission));
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayIntegral::UpdateMembranes(vtkInformationVector* membranes, Request& request)
{
  for (int i = 0; i < membranes->GetNumberOfInformationObjects(); ++i)
  {
    request.Surfaces.push_back(vtkPolyData::GetData(membranes, i));
  }
  return this->Tell(this->Internals->Membrane.Update(request.Surfaces, this->Interfaces, false));
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayIntegral::ComputeView(Request& request)
{
  const meniscus::TetrahedralMesh& mesh = this->Internals->Input.GetMesh();
  if (this->FrameMode == CAMERA)
  {
    return this->Camera ? this->TellError(meniscus::ComputeCameraView(
                            this->Camera, this->ImageSize, mesh, request.View))
                        : this->TellError("There is no camera");
  }
  request.Rectangle = { glm::make_vec3(this->FrameOrigin), glm::make_vec3(this->FrameAxis1),
    glm::make_vec3(this->FrameAxis2) };
  if (this->FrameMode == FITTED &&
    !this->TellError(
      meniscus::FitRectangle(mesh.GetCenter(), mesh.GetHalfSize(), glm::make_vec3(this->Direction),
        glm::make_vec3(this->ViewUp), this->ImageSize, request.Rectangle)))
  {
    return false;
  }
  if (!this->TellError(meniscus::DescribeFault(request.Rectangle)))
  {
    return false;
  }
  std::vector<glm::dvec3> corners;
  for (vtkPolyData* surface : request.Surfaces)
  {
    double b[6];
    surface->GetBounds(b);
    for (int c = 0; c < 8; ++c)
    {
      corners.emplace_back(b[c & 1], b[2 + (c >> 1 & 1)], b[4 + (c >> 2 & 1)]);
    }
  }
  return this->TellError(
    meniscus::ComputeParallelView(request.Rectangle, this->ImageSize, mesh, corners, request.View));
}

//------------------------------------------------------------------------------
/** Returns false after an error or an abort. */
bool vtkTetrahedraRayIntegral::Measure(Request& request, vtkDataObject* input, vtkImageData* output)
{
  vtkInternals& internals = *this->Internals;
  std::vector<meniscus::EnergyBin> bins = internals.EnergyBins;
  bins.resize(static_cast<std::size_t>(request.Choice.NumberOfBins));
  const std::int64_t pixels = std::int64_t{ this->ImageSize[0] } * this->ImageSize[1];
  meniscus::IntegralArrays arrays(request.Choice, bins, pixels);
  const meniscus::InputCells cells(input, request.Scalars);
  const auto goOn = [this](double fraction)
  {
    this->UpdateProgress(ShareOfMesh + (1.0 - ShareOfMesh) * fraction);
    return !this->GetAbortExecute();
  };
  internals.ClearStatistics();
  // Without a cell that counts, or without extent, no ray meets anything.
  const meniscus::TetrahedralMesh& mesh = internals.Input.GetMesh();
  if (mesh.GetNumberOfActiveCells() > 0 && mesh.GetRadius() > 0.0 &&
    (!this->ComputeView(request) ||
      !this->TellError(
        internals.Measure(request.Choice, request.View, this->ImageSize, cells, arrays, goOn)) ||
      internals.WasAborted()))
  {
    return false;
  }
  this->Tell({ "", internals.Input.WarnOfOverlaps(internals.GetStatistics().Overlaps) });
  this->Tell({ "", internals.Membrane.WarnOfSide() });
  output->SetExtent(0, this->ImageSize[0] - 1, 0, this->ImageSize[1] - 1, 0, 0);
  const meniscus::ImagePlace place = this->FrameMode == CAMERA
    ? meniscus::ImagePlace()
    : meniscus::PlaceOf(request.Rectangle, this->ImageSize);
  output->SetOrigin(place.Origin);
  output->SetSpacing(place.Spacing);
  output->SetDirectionMatrix(place.Direction);
  arrays.AddTo(output);
  const meniscus::ScalarDistribution& scalars = internals.Input.GetDistribution();
  this->Tell({ "", arrays.WarnOfPrecision(scalars) });
  const bool hasScalars = !request.Choice.HasBinArrays && !scalars.IsEmpty();
  const double largest =
    hasScalars ? std::max(std::abs(scalars.GetLowest()), std::abs(scalars.GetHighest())) : 0.0;
  const bool isEmitting = request.Choice.HasBinArrays && internals.Bins.IsEmitting();
  this->Tell({ "", arrays.WarnOfBins(isEmitting, 2.0 * mesh.GetRadius() * largest) });
  return true;
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayIntegral::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->Initialize();
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  Request request;
  const bool measured = this->ChooseArrays(request) && this->CollectInput(input, request) &&
    this->TellError(DescribeExcess(request.Choice, this->ImageSize)) &&
    this->UpdateMembranes(inputs[1], request) && this->UpdateTables(request) &&
    this->Measure(request, input, output);
  if (!measured)
  {
    output->Initialize();
  }
  return measured || this->GetAbortExecute() ? 1 : 0;
}

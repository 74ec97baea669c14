// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraSchlieren.h"

#include "Filters/Common/ClampedSetter.h"
#include "Filters/Common/Statistics.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/ConcatenatedArray.h"
#include "Rendering/Input/InputContent.h"
#include "Rendering/Input/VolumeInput.h"
#include "Rendering/Integral/ImagePlace.h"
#include "Rendering/Integral/IntegralView.h"
#include "Rendering/Integral/SchlierenArrays.h"
#include "Volume/Graded/GradedCellTable.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Graded/RefractiveIndex.h"

#include "vtkAbstractMapper.h"
#include "vtkCamera.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace
{

/** Shares of the progress that the medium and the rays take; the images take the rest. */
constexpr double ShareOfMedium = 0.3;
constexpr double ShareOfRays = 0.6;
/** Rows of the image that are cast between two reports of the progress. */
constexpr std::size_t RowsPerReport = 32;
/** Rows of a block of rays. */
constexpr std::size_t RowsPerBlock = 8;

/** Everything that the index of refraction at the vertices depends on but the input's values. */
struct MediumKey
{
  meniscus::TableVersions Mesh;
  int Quantity = -1;
  /** 0 if the values are indices. */
  double GladstoneDale = 0.0;

  bool operator==(const MediumKey& other) const
  {
    return this->Mesh == other.Mesh && this->Quantity == other.Quantity &&
      this->GladstoneDale == other.GladstoneDale;
  }
};

/** Everything that rays depend on. */
struct RayKey
{
  meniscus::TableVersion Medium;
  meniscus::RayFrame Frame;
  double BeginDepth = 0.0;
  glm::ivec2 Size{ 0 };
  double OutsideIndex = 0.0;
  bool IsStraight = false;

  bool operator==(const RayKey& other) const
  {
    return this->Medium == other.Medium && this->Frame == other.Frame &&
      this->BeginDepth == other.BeginDepth && this->Size == other.Size &&
      this->OutsideIndex == other.OutsideIndex && this->IsStraight == other.IsStraight;
  }
};

}

/** Tables of the input, and the rays of the last image. */
class vtkTetrahedraSchlieren::vtkInternals
{
public:
  static const std::vector<meniscus::Statistic<vtkTetrahedraSchlieren>>& List();

  meniscus::VolumeInput Input;
  meniscus::ContentWatch ValueWatch;
  MediumKey Medium;
  /** Bumped when the medium is read. */
  meniscus::TableVersion MediumVersion;
  /** A copy of the input's mesh, in which cells without an index are inactive. */
  meniscus::TetrahedralMesh Mesh;
  meniscus::BoundaryTree Tree;
  std::vector<double> SquaredIndices;
  std::vector<meniscus::EdgeTerms> Terms;
  /** Coefficients of the same field, for rays that are bent. */
  meniscus::GradedCellTable Table;
  meniscus::IndexFaults Faults;

  meniscus::ParallelRectangle Rectangle;
  meniscus::IntegralView View;
  /** Not equal to any key before the first cast and after one that was not finished. */
  RayKey CastFor;
  std::vector<meniscus::GradedRayResult> Rays;
  meniscus::GradedRayStatistics Statistics;
  std::int64_t Casts = 0;
  vtkNew<vtkTable> StatisticsTable;
};

vtkStandardNewMacro(vtkTetrahedraSchlieren);
meniscusStatisticsMacro(vtkTetrahedraSchlieren);
meniscusSetClampMacro(vtkTetrahedraSchlieren, Quantity, int, DENSITY, REFRACTIVE_INDEX);
meniscusSetClampMacro(vtkTetrahedraSchlieren, OutsideIndex, double, 0.0, VTK_DOUBLE_MAX);
meniscusSetClampMacro(vtkTetrahedraSchlieren, KnifeCutOff, double, 0.0, 1.0);
meniscusSetClampMacro(vtkTetrahedraSchlieren, KnifeRange, double, 0.0, VTK_DOUBLE_MAX);

//------------------------------------------------------------------------------
vtkTetrahedraSchlieren::vtkTetrahedraSchlieren()
  : GladstoneDale(meniscus::GladstoneDaleOfAir)
  , Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkTetrahedraSchlieren::~vtkTetrahedraSchlieren() = default;

//------------------------------------------------------------------------------
void vtkTetrahedraSchlieren::SetCamera(vtkCamera* camera)
{
  if (this->Camera != camera)
  {
    this->Camera = camera;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkCamera* vtkTetrahedraSchlieren::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTetrahedraSchlieren::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Camera ? std::max(time, this->Camera->GetMTime()) : time;
}

//------------------------------------------------------------------------------
const std::vector<meniscus::Statistic<vtkTetrahedraSchlieren>>&
vtkTetrahedraSchlieren::vtkInternals::List()
{
  using Self = vtkTetrahedraSchlieren;
  static const std::vector<meniscus::Statistic<Self>> list = {
    { "NumberOfMediumUpdates", "readings of the index of refraction",
      [](Self& self) { return double(self.Internals->MediumVersion.GetChanges()); } },
    { "NumberOfCasts", "casts of all rays of an image",
      [](Self& self) { return double(self.Internals->Casts); } },
    { "NumberOfRays", "rays of the last image that met the mesh",
      [](Self& self) { return double(self.Internals->Statistics.Rays); } },
    { "NumberOfTraversalSteps", "cells that the rays of the last image crossed",
      [](Self& self) { return double(self.Internals->Statistics.Steps); } },
    { "NumberOfStoppedRays", "rays of the last image that stayed in the mesh and were stopped",
      [](Self& self) { return double(self.Internals->Statistics.Trapped); } },
    { "NumberOfLostRays",
      "rays of the last image without a way out of a cell, caused by numbers beyond the range of "
      "doubles",
      [](Self& self) { return double(self.Internals->Statistics.Lost); } },
    { "NumberOfUnusablePoints", "points whose value cannot be used",
      [](Self& self) { return double(self.Internals->Faults.GetNumberOfUnusable()); } },
  };
  return list;
}

//------------------------------------------------------------------------------
int vtkTetrahedraSchlieren::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  // The executive looks at the first type only; otherwise it would iterate over the blocks.
  for (const char* type : { "vtkCompositeDataSet", "vtkDataSet" })
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTetrahedraSchlieren::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputs), vtkInformationVector* outputs)
{
  // An error in the size is reported in RequestData, when there is an output to empty.
  const int extent[6] = { 0, std::max(this->ImageSize[0], 1) - 1, 0,
    std::max(this->ImageSize[1], 1) - 1, 0, 0 };
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, -1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTetrahedraSchlieren::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputs, vtkInformationVector* vtkNotUsed(outputs))
{
  meniscus::RequestWholeInputs(inputs);
  return 1;
}

//------------------------------------------------------------------------------
/** Reports an error, if there is one. Returns true if there is none. */
bool vtkTetrahedraSchlieren::TellError(const std::string& error)
{
  if (!error.empty())
  {
    vtkErrorMacro(<< error << "; the output is empty.");
  }
  return error.empty();
}

//------------------------------------------------------------------------------
bool vtkTetrahedraSchlieren::CheckSettings(vtkImageData* background)
{
  if (this->ImageSize[0] < 1 || this->ImageSize[1] < 1)
  {
    return this->TellError("ImageSize must be at least 1 by 1, not " +
      std::to_string(this->ImageSize[0]) + " by " + std::to_string(this->ImageSize[1]));
  }
  if (!(this->Wavelength > 0.0) || !std::isfinite(this->Wavelength))
  {
    return this->TellError("The wavelength must be positive and finite");
  }
  if (!std::isfinite(this->GladstoneDale) || !std::isfinite(this->ReferenceIndex) ||
    !std::isfinite(this->ScreenDistance) || !std::isfinite(this->BackgroundDistance) ||
    !std::isfinite(this->KnifeAngle))
  {
    return this->TellError("A setting is not finite");
  }
  const bool hasPixels = !background ||
    (background->GetNumberOfPoints() > 0 && background->GetPointData()->GetScalars());
  return this->TellError(hasPixels ? std::string() : "The background has no pixels");
}

//------------------------------------------------------------------------------
/** Reads mesh and indices. Returns false after an error or an abort. */
bool vtkTetrahedraSchlieren::UpdateMedium(vtkDataObject* input)
{
  vtkInternals& internals = *this->Internals;
  vtkInformation* wanted = this->GetInputArrayInformation(0);
  meniscus::ScalarSelection selection;
  selection.Component = 0;
  selection.ScalarMode = VTK_SCALAR_MODE_USE_POINT_DATA;
  if (wanted->Has(vtkDataObject::FIELD_NAME()))
  {
    selection.ScalarMode = VTK_SCALAR_MODE_USE_POINT_FIELD_DATA;
    selection.AccessMode = VTK_GET_ARRAY_BY_NAME;
    selection.ArrayName = wanted->Get(vtkDataObject::FIELD_NAME());
  }
  meniscus::InputBlocks blocks;
  meniscus::InputReport report = meniscus::CollectInputBlocks(input, selection, blocks);
  if (report.Error.empty() && blocks.Parts.empty())
  {
    report.Error = "The input has no cells";
  }
  const auto goOn = [this](double fraction)
  {
    this->UpdateProgress(ShareOfMedium * fraction);
    return !this->GetAbortExecute();
  };
  if (report.Error.empty())
  {
    meniscus::DivisionRequest division;
    division.Fields = blocks;
    division.Component = 0;
    internals.Input.SetHasSingleDepths(false);
    const meniscus::InputReport ofMesh = internals.Input.UpdateMesh(blocks, goOn, division);
    report.Error = ofMesh.Error;
    report.Warning += ofMesh.Warning;
  }
  if (!report.Warning.empty())
  {
    vtkWarningMacro(<< report.Warning);
  }
  if (!this->TellError(report.Error) || this->GetAbortExecute())
  {
    return false;
  }
  const bool hasNewValues = internals.ValueWatch.HasChanged(
    meniscus::ScalarVersions(blocks), [&blocks]() { return meniscus::DigestScalars(blocks); });
  MediumKey key;
  key.Mesh = { internals.Input.GetBuildVersion(), internals.Input.GetMeshVersion() };
  key.Quantity = this->Quantity;
  key.GladstoneDale = this->Quantity == DENSITY ? this->GladstoneDale : 0.0;
  if (hasNewValues || !(key == internals.Medium))
  {
    internals.Medium = key;
    this->ReadIndices(blocks);
  }
  return this->TellError(internals.Mesh.GetNumberOfActiveCells() > 0
      ? std::string()
      : "No cell has an index of refraction in all of its points");
}

//------------------------------------------------------------------------------
/** Reads the indices of refraction and the mesh of the cells that have them. */
void vtkTetrahedraSchlieren::ReadIndices(const meniscus::InputBlocks& blocks)
{
  vtkInternals& internals = *this->Internals;
  internals.MediumVersion.Bump();
  const std::vector<double> values = meniscus::GatherValues(blocks, 0,
    internals.Input.GetSources(meniscus::FieldAssociation::Points),
    internals.Input.GetInterpolatedPoints(meniscus::FieldAssociation::Points));
  internals.SquaredIndices = this->Quantity == DENSITY
    ? meniscus::SquareIndicesOfGas(values, this->GladstoneDale, internals.Faults)
    : meniscus::SquareIndices(values, internals.Faults);
  internals.Mesh = internals.Input.GetMesh();
  const std::int64_t holes = meniscus::ActivateCellsWithIndex(
    internals.Mesh, internals.SquaredIndices, meniscus::ThreadedLoop);
  internals.Tree.Build(internals.Mesh);
  internals.Terms =
    meniscus::ComputeEdgeTerms(internals.Mesh, internals.SquaredIndices, meniscus::FacetLoop);
  internals.Table.Build(
    internals.Mesh, internals.SquaredIndices, &internals.Terms, meniscus::ThreadedLoop);
  if (holes > 0 && internals.Mesh.GetNumberOfActiveCells() > 0)
  {
    vtkWarningMacro(<< internals.Faults.NotFinite << " points have a value that is not finite and "
                    << internals.Faults.NotPositive << " a negative density or an index of 0 or "
                    << "less; " << holes << " tetrahedra at them are left out.");
  }
  if (internals.Faults.BelowOne > 0)
  {
    vtkWarningMacro(<< internals.Faults.BelowOne << " points have an index of refraction below 1.");
  }
}

//------------------------------------------------------------------------------
/** Computes the rays of the image before they are bent. Returns false after an error. */
bool vtkTetrahedraSchlieren::UpdateView()
{
  vtkInternals& internals = *this->Internals;
  const meniscus::TetrahedralMesh& mesh = internals.Mesh;
  std::string error;
  if (this->Camera)
  {
    error = meniscus::ComputeCameraView(this->Camera, this->ImageSize, mesh, internals.View);
  }
  else
  {
    error =
      meniscus::FitRectangle(mesh.GetCenter(), mesh.GetHalfSize(), glm::make_vec3(this->Direction),
        glm::make_vec3(this->ViewUp), this->ImageSize, internals.Rectangle);
    error = error.empty() ? meniscus::DescribeFault(internals.Rectangle) : error;
    error = error.empty() ? meniscus::ComputeParallelView(
                              internals.Rectangle, this->ImageSize, mesh, {}, internals.View)
                          : error;
  }
  return this->TellError(error);
}

//------------------------------------------------------------------------------
/** Follows the rays of all pixels, unless it has done so. Returns false after an abort. */
bool vtkTetrahedraSchlieren::UpdateRays()
{
  vtkInternals& internals = *this->Internals;
  RayKey key;
  key.Medium = internals.MediumVersion;
  key.Frame = internals.View.Rays;
  key.BeginDepth = internals.View.BeginDepth;
  key.Size = glm::make_vec2(this->ImageSize);
  key.OutsideIndex = this->OutsideIndex;
  key.IsStraight = this->BendRays == 0;
  if (key == internals.CastFor)
  {
    return true;
  }
  internals.CastFor = RayKey();
  internals.Statistics = meniscus::GradedRayStatistics();
  ++internals.Casts;
  meniscus::GradedMedium medium;
  medium.Mesh = &internals.Mesh;
  medium.Tree = &internals.Tree;
  medium.SquaredIndices = &internals.SquaredIndices;
  medium.Terms = &internals.Terms;
  medium.Table = &internals.Table;
  medium.OutsideIndex = key.OutsideIndex;
  medium.IsStraight = key.IsStraight;
  const meniscus::GradedRayWalk walk(medium);
  const meniscus::SchlierenRays rays(internals.View, this->ImageSize);
  const auto width = static_cast<std::size_t>(this->ImageSize[0]);
  const auto height = static_cast<std::size_t>(this->ImageSize[1]);
  internals.Rays.assign(width * height, {});
  std::vector<meniscus::GradedRayStatistics> ofRows(height);
  // The rays of a block of pixels, which are in the same cells, go on at the same time.
  const auto castBlock = [&](std::size_t firstRow, std::size_t endRow)
  {
    std::vector<meniscus::GradedRay> ofBlock;
    std::vector<std::size_t> pixels;
    for (std::size_t column = 0; column < width; ++column)
    {
      for (std::size_t row = firstRow; row < endRow; ++row)
      {
        const glm::dvec2 pixel(static_cast<double>(column), static_cast<double>(row));
        ofBlock.push_back({ rays.GetOrigin(pixel), rays.GetDirection(pixel) });
        pixels.push_back(row * width + column);
      }
    }
    std::vector<meniscus::GradedRayResult> results(ofBlock.size());
    walk.WalkAll(ofBlock, ofRows[firstRow], results.data());
    for (std::size_t i = 0; i < results.size(); ++i)
    {
      internals.Rays[pixels[i]] = results[i];
    }
  };
  for (std::size_t first = 0; first < height; first += RowsPerReport)
  {
    const std::size_t rows = std::min(RowsPerReport, height - first);
    meniscus::ThreadedRanges((rows + RowsPerBlock - 1) / RowsPerBlock, 1,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t block = begin; block < end; ++block)
        {
          const std::size_t row = first + block * RowsPerBlock;
          castBlock(row, std::min(row + RowsPerBlock, first + rows));
        }
      });
    this->UpdateProgress(ShareOfMedium +
      ShareOfRays * static_cast<double>(first + rows) / static_cast<double>(height));
    if (this->GetAbortExecute())
    {
      return false;
    }
  }
  for (const meniscus::GradedRayStatistics& row : ofRows)
  {
    internals.Statistics.Add(row);
  }
  internals.CastFor = key;
  if (internals.Statistics.Trapped + internals.Statistics.Lost > 0)
  {
    vtkWarningMacro(<< internals.Statistics.Trapped + internals.Statistics.Lost
                    << " rays were stopped in the mesh; their light is missing.");
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraSchlieren::MakeImages(vtkImageData* background, vtkImageData* output)
{
  vtkInternals& internals = *this->Internals;
  const int width = this->ImageSize[0];
  const int height = this->ImageSize[1];
  output->SetExtent(0, width - 1, 0, height - 1, 0, 0);
  const meniscus::ImagePlace place =
    this->Camera ? meniscus::ImagePlace() : PlaceOf(internals.Rectangle, this->ImageSize);
  output->SetOrigin(place.Origin);
  output->SetSpacing(place.Spacing);
  output->SetDirectionMatrix(place.Direction);
  meniscus::Instruments instruments;
  instruments.ReferenceIndex = this->ReferenceIndex;
  instruments.ScreenDistance = this->ScreenDistance;
  instruments.BackgroundDistance = this->BackgroundDistance;
  instruments.Knife = { this->KnifeAngle, this->KnifeCutOff, this->KnifeRange };
  instruments.Meter = { this->Wavelength, glm::dvec2(this->Fringes[0], this->Fringes[1]) };
  instruments.Background = background;
  const meniscus::SchlierenRays rays(internals.View, this->ImageSize);
  if (!meniscus::WriteImages(rays, internals.Rays, internals.Mesh, instruments, output))
  {
    vtkWarningMacro(<< "The knife edge cuts off all light, of all pixels; KnifeCutOff is "
                    << this->KnifeCutOff << ".");
  }
  output->GetPointData()->SetActiveScalars("Schlieren");
  this->UpdateProgress(1.0);
}

//------------------------------------------------------------------------------
int vtkTetrahedraSchlieren::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->Initialize();
  vtkImageData* background =
    inputs[1]->GetNumberOfInformationObjects() > 0 ? vtkImageData::GetData(inputs[1]) : nullptr;
  if (this->CheckSettings(background) && this->UpdateMedium(vtkDataObject::GetData(inputs[0])) &&
    this->UpdateView() && this->UpdateRays())
  {
    this->MakeImages(background, output);
    return 1;
  }
  return this->GetAbortExecute() ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkTetrahedraSchlieren::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Quantity: " << (this->Quantity == DENSITY ? "DENSITY" : "REFRACTIVE_INDEX")
     << "\n";
  os << indent << "GladstoneDale: " << this->GladstoneDale << "\n";
  os << indent << "BendRays: " << this->BendRays << "\n";
  os << indent << "OutsideIndex: " << this->OutsideIndex << "\n";
  os << indent << "ReferenceIndex: " << this->ReferenceIndex << "\n";
  os << indent << "Direction: (" << this->Direction[0] << ", " << this->Direction[1] << ", "
     << this->Direction[2] << ")\n";
  os << indent << "ViewUp: (" << this->ViewUp[0] << ", " << this->ViewUp[1] << ", "
     << this->ViewUp[2] << ")\n";
  os << indent << "Camera: " << this->Camera << "\n";
  os << indent << "ImageSize: (" << this->ImageSize[0] << ", " << this->ImageSize[1] << ")\n";
  os << indent << "ScreenDistance: " << this->ScreenDistance << "\n";
  os << indent << "KnifeAngle: " << this->KnifeAngle << "\n";
  os << indent << "KnifeCutOff: " << this->KnifeCutOff << "\n";
  os << indent << "KnifeRange: " << this->KnifeRange << "\n";
  os << indent << "Wavelength: " << this->Wavelength << "\n";
  os << indent << "Fringes: (" << this->Fringes[0] << ", " << this->Fringes[1] << ")\n";
  os << indent << "BackgroundDistance: " << this->BackgroundDistance << "\n";
  meniscus::PrintStatistics(meniscus::MeasureStatistics(*this, vtkInternals::List()), os, indent);
}

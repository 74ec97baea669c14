// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraMirage.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Filters/Common/NamedArray.h"
#include "Filters/Common/Statistics.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Integral/BentMedium.h"
#include "Rendering/Integral/BentRayView.h"
#include "Rendering/Integral/BentVolume.h"
#include "Rendering/Integral/SchlierenArrays.h"
#include "Rendering/Integral/SeenObjects.h"
#include "Rendering/Integral/SurfaceTexture.h"

#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkScalarsToColors.h"
#include "vtkTable.h"
#include "vtkTexture.h"
#include "vtkVolumeProperty.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/** The objects, and the rays of the last image. */
class vtkTetrahedraMirage::vtkInternals
{
public:
  static const std::vector<meniscus::Statistic<vtkTetrahedraMirage>>& List();

  double CountSights(bool (*isCounted)(const meniscus::OpaqueSight& sight)) const
  {
    return double(std::count_if(this->Sights.begin(), this->Sights.end(), isCounted));
  }

  /** Scalars of the volume, and their data sets, during an update. */
  meniscus::InputBlocks VolumeScalars;
  meniscus::BentVolume Volume;
  meniscus::SeenObjects Objects;
  meniscus::SurfaceTexture Texture;
  std::vector<meniscus::OpaqueSight> Sights;
  std::vector<glm::dvec3> Eyes;
  meniscus::GradedRayStatistics Statistics;
  vtkNew<vtkTable> StatisticsTable;
};

vtkStandardNewMacro(vtkTetrahedraMirage);
meniscusStatisticsMacro(vtkTetrahedraMirage);
meniscusSetClampMacro(vtkTetrahedraMirage, Ambient, double, 0.0, 1.0);
meniscusSetClampMacro(
  vtkTetrahedraMirage, OpacityModel, int, ATTENUATION_COEFFICIENT, OPACITY_PER_UNIT_DISTANCE);
meniscusObjectMacro(vtkTetrahedraMirage, LookupTable, vtkScalarsToColors, LookupTable);
meniscusObjectMacro(vtkTetrahedraMirage, Texture, vtkTexture, Texture);
meniscusObjectMacro(vtkTetrahedraMirage, VolumeProperty, vtkVolumeProperty, VolumeProperty);

//------------------------------------------------------------------------------
vtkTetrahedraMirage::vtkTetrahedraMirage()
  : Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkTetrahedraMirage::~vtkTetrahedraMirage()
{
  this->SetVolumeArrayName(nullptr);
}

//------------------------------------------------------------------------------
const std::vector<meniscus::Statistic<vtkTetrahedraMirage>>&
vtkTetrahedraMirage::vtkInternals::List()
{
  using Self = vtkTetrahedraMirage;
  using Sight = meniscus::OpaqueSight;
  static const std::vector<meniscus::Statistic<Self>> list = meniscus::ListBentRays<Self>(
    [](Self& self) -> meniscus::GradedRayStatistics& { return self.Internals->Statistics; },
    {
      { "NumberOfObjectPixels", "pixels of the last image that show an object",
        [](Self& self) {
          return self.Internals->CountSights([](const Sight& s) { return s.Hit.Triangle >= 0; });
        } },
      { "NumberOfBackPixels", "pixels of the last image that show the back of a polygon",
        [](Self& self)
        {
          return self.Internals->CountSights(
            [](const Sight& s) { return s.Hit.Triangle >= 0 && !s.Hit.IsFront; });
        } },
      { "NumberOfUnusablePoints", "points of the mesh whose value cannot be used",
        [](Self& self) { return double(self.Medium->GetFaults().GetNumberOfUnusable()); } },
      { "NumberOfBrokenCells",
        "polygons of the objects with a point that is not finite or is missing",
        [](Self& self) { return double(self.Internals->Objects.GetNumberOfBrokenCells()); } },
    });
  return list;
}

//------------------------------------------------------------------------------
void vtkTetrahedraMirage::SetObjectData(vtkDataSet* objects)
{
  this->SetInputDataInternal(1, objects);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkTetrahedraMirage::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  const auto include = [&time](vtkObject* object)
  { time = object ? std::max(time, object->GetMTime()) : time; };
  include(this->LookupTable);
  include(this->VolumeProperty);
  include(this->Texture);
  include(this->Texture ? this->Texture->GetInputAlgorithm() : nullptr);
  include(this->Texture ? this->Texture->GetInput() : nullptr);
  return time;
}

//------------------------------------------------------------------------------
int vtkTetrahedraMirage::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    return 1;
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
int vtkTetrahedraMirage::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::RequestInformation(request, inputs, outputs);
  vtkDataObject::SetPointDataActiveScalarInfo(
    outputs->GetInformationObject(0), VTK_UNSIGNED_CHAR, 3);
  return result;
}

//------------------------------------------------------------------------------
/** Finds the scalars of the volume. Returns false after an error, which has been reported. */
bool vtkTetrahedraMirage::CollectVolume(vtkDataObject* mesh)
{
  this->Medium->SetScalars(nullptr);
  if (!this->VolumeProperty)
  {
    return true;
  }
  meniscus::InputBlocks& scalars = this->Internals->VolumeScalars;
  const bool isNamed = this->VolumeArrayName && *this->VolumeArrayName;
  const meniscus::InputReport report = isNamed
    ? meniscus::CollectNamedArray(mesh, this->VolumeArrayName, 0, scalars)
    : meniscus::CollectInputBlocks(
        mesh, meniscus::SelectPointValues(this->GetInputArrayInformation(0)), scalars);
  if (!report.Warning.empty())
  {
    vtkWarningMacro(<< report.Warning);
  }
  if (!scalars.Parts.empty())
  {
    this->Medium->SetScalars(&scalars);
  }
  return this->TellError(report.Error.empty() ? "" : "Volume: " + report.Error);
}

//------------------------------------------------------------------------------
/** Reads scalars and property of the volume. Returns false after an error. */
bool vtkTetrahedraMirage::ReadVolume()
{
  if (!this->VolumeProperty)
  {
    return true;
  }
  const meniscus::InputReport report =
    this->Internals->Volume.Update(this->Internals->VolumeScalars, this->VolumeProperty,
      this->OpacityModel == OPACITY_PER_UNIT_DISTANCE, *this->Medium);
  if (!report.Warning.empty())
  {
    vtkWarningMacro(<< report.Warning);
  }
  return this->TellError(report.Error);
}

//------------------------------------------------------------------------------
/** Reads the objects and their texture. Returns false after an error. */
bool vtkTetrahedraMirage::ReadObjects(vtkDataSet* objects)
{
  if (!this->TellError(this->Internals->Texture.Read(this->Texture)))
  {
    return false;
  }
  meniscus::SeenObjects& read = this->Internals->Objects;
  vtkNew<vtkPolyData> nothing;
  read.Read(objects ? objects : nothing.GetPointer(), this->Medium->GetMesh());
  if (read.GetNumberOfBrokenCells() > 0)
  {
    vtkWarningMacro(<< read.GetNumberOfBrokenCells()
                    << " polygons with a point that is not finite or is missing are left out.");
  }
  else if (objects && read.GetTriangles().IsEmpty())
  {
    vtkWarningMacro(<< "The objects have no polygons; the picture shows the background alone.");
  }
  else if (objects && this->Texture && !read.HasTextureCoordinates())
  {
    vtkWarningMacro(<< "The objects have no texture coordinates; the texture is not seen.");
  }
  return true;
}

//------------------------------------------------------------------------------
/** Traces the rays of all pixels. Returns false after an abort. */
bool vtkTetrahedraMirage::TraceRays()
{
  vtkInternals& internals = *this->Internals;
  const bool isStraight = this->GetBendRays() == 0;
  const meniscus::GradedRayWalk walk(this->Medium->MakeField(this->GetOutsideIndex(), isStraight));
  const meniscus::SchlierenRays rays(this->View->Rays, this->GetImageSize());
  const auto width = static_cast<std::size_t>(this->GetImageSize()[0]);
  const auto height = static_cast<std::size_t>(this->GetImageSize()[1]);
  internals.Statistics = meniscus::GradedRayStatistics();
  internals.Sights.assign(width * height, {});
  internals.Eyes.assign(width * height, {});
  std::vector<meniscus::GradedRayStatistics> ofRows(height);
  const bool hasVolume = this->VolumeProperty != nullptr;
  const bool isWatched = isStraight || hasVolume || internals.Objects.MayBeInMesh();
  std::vector<std::uint8_t> cells = isWatched
    ? internals.Objects.GetTriangles().FindCells(this->Medium->GetMesh(), meniscus::ThreadedLoop)
    : std::vector<std::uint8_t>();
  if (hasVolume)
  {
    internals.Volume.MarkCells(cells);
  }
  const meniscus::EntryRaster raster = this->Medium->DrawBoundary(rays.GetImage());
  const auto traceBlock = [&](std::size_t firstRow, std::size_t endRow)
  {
    std::vector<meniscus::GradedRay> ofBlock;
    const std::size_t first = firstRow * width;
    for (std::size_t i = first; i < endRow * width; ++i)
    {
      const glm::dvec2 pixel(static_cast<double>(i % width), static_cast<double>(i / width));
      ofBlock.push_back({ rays.GetOrigin(pixel), rays.GetDirection(pixel) });
      internals.Eyes[i] = ofBlock.back().Origin;
    }
    meniscus::OpaqueSight* sights = internals.Sights.data() + first;
    const meniscus::EntryFaces faces = raster.Collect({ 0, firstRow }, { width, endRow },
      [width, first](int column, int row)
      { return static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column) - first; });
    meniscus::SeeTriangles(walk, internals.Objects.GetTriangles(), isWatched ? &cells : nullptr,
      ofBlock, ofRows[firstRow], sights, raster.IsUsable() ? &faces : nullptr,
      hasVolume ? &internals.Volume.GetMedium() : nullptr);
    for (std::size_t i = 0; isStraight && i < ofBlock.size(); ++i)
    {
      // Without the turn that stands for the bending.
      sights[i].Direction = glm::normalize(ofBlock[i].Direction);
    }
  };
  if (!this->RunRows(traceBlock, meniscus::ShareOfMedium, meniscus::ShareOfRays))
  {
    return false;
  }
  for (const meniscus::GradedRayStatistics& row : ofRows)
  {
    internals.Statistics.Add(row);
  }
  const std::int64_t stopped = internals.Statistics.Trapped + internals.Statistics.Lost;
  if (stopped > 0)
  {
    vtkWarningMacro(<< stopped << " rays were stopped in the mesh; their pixels have the colour of "
                    << "the background.");
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraMirage::WriteArrays(vtkImageData* output)
{
  this->PlaceImage(output);
  meniscus::ObjectShading shading;
  shading.LookupTable = this->LookupTable;
  shading.Texture = &this->Internals->Texture;
  shading.LightDirection = glm::make_vec3(this->LightDirection);
  shading.Ambient = this->Ambient;
  shading.Background = glm::make_vec3(this->BackgroundColor);
  this->Internals->Objects.Write(this->Internals->Sights, this->Internals->Eyes, shading, output);
  if (this->VolumeProperty)
  {
    auto* colors = meniscus::AddPointArray<vtkFloatArray>(output, "RGBA", 4);
    for (std::size_t i = 0; i < this->Internals->Sights.size(); ++i)
    {
      float values[4];
      std::copy_n(this->Internals->Sights[i].Light.Values, 4, values);
      values[3] = 1.0f - values[3];
      colors->SetTypedTuple(static_cast<vtkIdType>(i), values);
    }
  }
  output->GetPointData()->SetActiveScalars("Color");
  this->UpdateProgress(1.0);
}

//------------------------------------------------------------------------------
int vtkTetrahedraMirage::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->Initialize();
  const double* settings[2] = { this->LightDirection, this->BackgroundColor };
  const bool isFinite = std::all_of(settings, settings + 2,
    [](const double* values) { return std::isfinite(values[0] + values[1] + values[2]); });
  vtkDataSet* objects = vtkDataSet::GetData(inputs[1]);
  const bool hasSubject = objects || this->VolumeProperty;
  if (this->TellError(isFinite ? "" : "A setting is not finite") &&
    this->TellError(hasSubject ? "" : "There are neither objects nor a volume property") &&
    this->CollectVolume(vtkDataObject::GetData(inputs[0])) &&
    this->UpdateView(vtkDataObject::GetData(inputs[0]), meniscus::ShareOfMedium) &&
    this->ReadVolume() && this->ReadObjects(objects) && this->TraceRays())
  {
    this->WriteArrays(output);
    return 1;
  }
  return this->GetAbortExecute() ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkTetrahedraMirage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LookupTable: " << this->LookupTable << "\n";
  os << indent << "Texture: " << this->Texture << "\n";
  os << indent << "VolumeProperty: " << this->VolumeProperty << "\n";
  os << indent << "VolumeArrayName: " << (this->VolumeArrayName ? this->VolumeArrayName : "(none)")
     << "\n";
  os << indent << "OpacityModel: "
     << (this->OpacityModel == OPACITY_PER_UNIT_DISTANCE ? "OPACITY_PER_UNIT_DISTANCE"
                                                         : "ATTENUATION_COEFFICIENT")
     << "\n";
  os << indent << "LightDirection: (" << this->LightDirection[0] << ", " << this->LightDirection[1]
     << ", " << this->LightDirection[2] << ")\n";
  os << indent << "Ambient: " << this->Ambient << "\n";
  os << indent << "BackgroundColor: (" << this->BackgroundColor[0] << ", "
     << this->BackgroundColor[1] << ", " << this->BackgroundColor[2] << ")\n";
  meniscus::PrintStatistics(meniscus::MeasureStatistics(*this, vtkInternals::List()), os, indent);
}

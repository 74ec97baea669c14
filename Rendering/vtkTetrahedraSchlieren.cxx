// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraSchlieren.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Filters/Common/Statistics.h"
#include "Rendering/Integral/BentMedium.h"
#include "Rendering/Integral/BentRayView.h"
#include "Rendering/Integral/SchlierenArrays.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace
{

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

/** Rows of an image, and the number of its columns. */
struct RowsOfImage
{
  std::size_t First;
  std::size_t End;
  std::size_t Width;
};

/** Follows the rays of some rows at the same time. `raster` knows which of them meet the mesh. */
void CastRows(const meniscus::GradedRayWalk& walk, const meniscus::SchlierenRays& rays,
  const meniscus::EntryRaster& raster, const RowsOfImage& part,
  meniscus::GradedRayStatistics& statistics, meniscus::LightOfImage& light)
{
  // Rays are numbered column by column.
  const std::size_t rows = part.End - part.First;
  const auto numberOf = [&](int column, int row)
  { return static_cast<std::size_t>(column) * rows + static_cast<std::size_t>(row) - part.First; };
  const auto pixelOf = [&](std::size_t number)
  { return glm::dvec2(number / rows, part.First + number % rows); };
  meniscus::EntryFaces faces;
  std::vector<std::size_t> numbers;
  if (raster.IsUsable())
  {
    // The other rays miss the mesh.
    faces = raster.Collect({ 0, part.First }, { part.Width, part.End }, numberOf);
    numbers = faces.KeepRaysWithFaces();
  }
  else
  {
    numbers.resize(rows * part.Width);
    std::iota(numbers.begin(), numbers.end(), std::size_t{ 0 });
  }
  std::vector<meniscus::GradedRay> ofPart;
  ofPart.reserve(numbers.size());
  for (const std::size_t number : numbers)
  {
    const glm::dvec2 pixel = pixelOf(number);
    ofPart.push_back({ rays.GetOrigin(pixel), rays.GetDirection(pixel) });
  }
  std::vector<meniscus::GradedRayResult> results(ofPart.size());
  walk.WalkAll(ofPart, statistics, results.data(), meniscus::BestInstructionSet(),
    raster.IsUsable() ? &faces : nullptr);
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    const std::size_t number = numbers[i];
    const std::size_t pixel = (part.First + number % rows) * part.Width + number / rows;
    light.States[pixel] = results[i].State;
    light.Behind[pixel] = rays.Measure(pixelOf(number), results[i]);
  }
}

}

/** The light of the last image. */
class vtkTetrahedraSchlieren::vtkInternals
{
public:
  static const std::vector<meniscus::Statistic<vtkTetrahedraSchlieren>>& List();

  /** Not equal to any key before the first cast and after one that was not finished. */
  RayKey CastFor;
  meniscus::LightOfImage Light;
  meniscus::Shadowgraph Shadows;
  meniscus::GradedRayStatistics Statistics;
  std::int64_t Casts = 0;
  vtkNew<vtkTable> StatisticsTable;
};

vtkStandardNewMacro(vtkTetrahedraSchlieren);
meniscusStatisticsMacro(vtkTetrahedraSchlieren);
meniscusSetClampMacro(vtkTetrahedraSchlieren, KnifeCutOff, double, 0.0, 1.0);
meniscusSetClampMacro(vtkTetrahedraSchlieren, KnifeRange, double, 0.0, VTK_DOUBLE_MAX);

//------------------------------------------------------------------------------
vtkTetrahedraSchlieren::vtkTetrahedraSchlieren()
  : Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkTetrahedraSchlieren::~vtkTetrahedraSchlieren() = default;

//------------------------------------------------------------------------------
const std::vector<meniscus::Statistic<vtkTetrahedraSchlieren>>&
vtkTetrahedraSchlieren::vtkInternals::List()
{
  using Self = vtkTetrahedraSchlieren;
  static const std::vector<meniscus::Statistic<Self>> list = meniscus::ListBentRays<Self>(
    [](Self& self) -> meniscus::GradedRayStatistics& { return self.Internals->Statistics; },
    {
      { "NumberOfMediumUpdates", "readings of the index of refraction",
        [](Self& self) { return double(self.Medium->GetVersion().GetChanges()); } },
      { "NumberOfCasts", "casts of all rays of an image",
        [](Self& self) { return double(self.Internals->Casts); } },
      { "NumberOfUnusablePoints", "points whose value cannot be used",
        [](Self& self) { return double(self.Medium->GetFaults().GetNumberOfUnusable()); } },
    });
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
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
bool vtkTetrahedraSchlieren::CheckSettings(vtkImageData* background)
{
  if (!(this->Wavelength > 0.0) || !std::isfinite(this->Wavelength))
  {
    return this->TellError("The wavelength must be positive and finite");
  }
  if (!std::isfinite(this->ReferenceIndex) || !std::isfinite(this->ScreenDistance) ||
    !std::isfinite(this->BackgroundDistance) || !std::isfinite(this->KnifeAngle))
  {
    return this->TellError("A setting is not finite");
  }
  const bool hasPixels = !background ||
    (background->GetNumberOfPoints() > 0 && background->GetPointData()->GetScalars());
  return this->TellError(hasPixels ? std::string() : "The background has no pixels");
}

//------------------------------------------------------------------------------
/** Follows the rays of all pixels, unless it has done so. Returns false after an abort. */
bool vtkTetrahedraSchlieren::UpdateRays()
{
  vtkInternals& internals = *this->Internals;
  RayKey key;
  const meniscus::IntegralView& view = this->View->Rays;
  key.Medium = this->Medium->GetVersion();
  key.Frame = view.Rays;
  key.BeginDepth = view.BeginDepth;
  key.Size = glm::make_vec2(this->GetImageSize());
  key.OutsideIndex = this->GetOutsideIndex();
  key.IsStraight = this->GetBendRays() == 0;
  if (key == internals.CastFor)
  {
    return true;
  }
  internals.CastFor = RayKey();
  internals.Statistics = meniscus::GradedRayStatistics();
  ++internals.Casts;
  const meniscus::GradedRayWalk walk(this->Medium->MakeField(key.OutsideIndex, key.IsStraight));
  const meniscus::SchlierenRays rays(view, this->GetImageSize());
  const auto width = static_cast<std::size_t>(key.Size.x);
  const auto height = static_cast<std::size_t>(key.Size.y);
  internals.Light.States.assign(width * height, meniscus::GradedRayState::Missed);
  internals.Light.Behind.resize(width * height);
  const meniscus::EntryRaster raster = this->Medium->DrawBoundary(rays.GetImage());
  std::vector<meniscus::GradedRayStatistics> ofRows(height);
  // The rays of a block of pixels, which are in the same cells, go on at the same time.
  const auto castBlock = [&](std::size_t firstRow, std::size_t endRow) {
    CastRows(walk, rays, raster, { firstRow, endRow, width }, ofRows[firstRow], internals.Light);
  };
  if (!this->RunRows(castBlock, meniscus::ShareOfMedium, meniscus::ShareOfRays))
  {
    return false;
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
  this->PlaceImage(output);
  meniscus::Instruments instruments;
  instruments.ReferenceIndex = this->ReferenceIndex;
  instruments.ScreenDistance = this->ScreenDistance;
  instruments.BackgroundDistance = this->BackgroundDistance;
  instruments.Knife.SetAngle(this->KnifeAngle);
  instruments.Knife.CutOff = this->KnifeCutOff;
  instruments.Knife.Range = this->KnifeRange;
  instruments.Meter = { this->Wavelength, glm::dvec2(this->Fringes[0], this->Fringes[1]) };
  instruments.Background = background;
  const meniscus::SchlierenRays rays(this->View->Rays, this->GetImageSize());
  if (!meniscus::WriteImages(
        rays, internals.Light, this->Medium->GetMesh(), instruments, internals.Shadows, output))
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
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->Initialize();
  vtkImageData* background =
    inputs[1]->GetNumberOfInformationObjects() > 0 ? vtkImageData::GetData(inputs[1]) : nullptr;
  if (this->CheckSettings(background) &&
    this->UpdateView(vtkDataObject::GetData(inputs[0]), meniscus::ShareOfMedium) &&
    this->UpdateRays())
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
  os << indent << "ReferenceIndex: " << this->ReferenceIndex << "\n";
  os << indent << "ScreenDistance: " << this->ScreenDistance << "\n";
  os << indent << "KnifeAngle: " << this->KnifeAngle << "\n";
  os << indent << "KnifeCutOff: " << this->KnifeCutOff << "\n";
  os << indent << "KnifeRange: " << this->KnifeRange << "\n";
  os << indent << "Wavelength: " << this->Wavelength << "\n";
  os << indent << "Fringes: (" << this->Fringes[0] << ", " << this->Fringes[1] << ")\n";
  os << indent << "BackgroundDistance: " << this->BackgroundDistance << "\n";
  meniscus::PrintStatistics(meniscus::MeasureStatistics(*this, vtkInternals::List()), os, indent);
}

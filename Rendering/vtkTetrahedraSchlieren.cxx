// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraSchlieren.h"

#include "Filters/Common/ClampedSetter.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/ConcatenatedArray.h"
#include "Rendering/Input/VolumeInput.h"
#include "Rendering/Integral/ImagePlace.h"
#include "Rendering/Integral/IntegralView.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/RefractiveIndex.h"
#include "Volume/Graded/SchlierenImages.h"

#include "vtkAbstractMapper.h"
#include "vtkCamera.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace
{

/** Shares of the progress that the medium and the rays take; the rest is that of the images. */
constexpr double ShareOfMedium = 0.3;
constexpr double ShareOfRays = 0.6;
/** Rows of the image that are cast between two reports of the progress. */
constexpr int RowsPerReport = 32;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/** Rays of an image's pixels in the mesh's units, and places in the image that they reach. */
class PixelRays
{
public:
  PixelRays(const meniscus::IntegralView& view, const int size[2])
    : View(view)
    , ToFrame(glm::transpose(glm::dmat3(view.Rays.RowX, view.Rays.RowY, view.Rays.RowDepth)))
    , FromFrame(glm::inverse(this->ToFrame))
    , Middle(0.5 * (size[0] - 1), 0.5 * (size[1] - 1))
  {
  }

  glm::dvec2 GetSlope(const glm::dvec2& pixel) const
  {
    const glm::dvec2 p = pixel - this->Middle;
    return this->View.Rays.Slope.At(p.x, p.y);
  }
  glm::dvec3 GetOrigin(const glm::dvec2& pixel) const
  {
    const glm::dvec2 p = pixel - this->Middle;
    const double depth = this->View.BeginDepth;
    return this->FromFrame *
      glm::dvec3(this->View.Rays.Origin.At(p.x, p.y) + depth * this->GetSlope(pixel), depth);
  }
  glm::dvec3 GetDirection(const glm::dvec2& pixel) const
  {
    return this->FromFrame * glm::dvec3(this->GetSlope(pixel), 1.0);
  }
  /** Depth in the frame at a distance in world coordinates behind a box about the centre. */
  double GetDepthBehind(const glm::dvec3& half, double distance) const
  {
    return glm::dot(glm::abs(this->View.Rays.RowDepth), half) +
      distance / glm::length(this->View.Rays.ViewToWorld[2]);
  }
  /** Change of a direction's slope against that of the pixel's ray; NaN for a ray that returns. */
  glm::dvec2 Deflect(const glm::dvec2& pixel, const glm::dvec3& direction) const
  {
    const glm::dvec3 d = this->ToFrame * direction;
    return d.z > 0.0 ? glm::dvec2(d) / d.z - this->GetSlope(pixel) : glm::dvec2(NaN);
  }
  /** Pixel whose undisturbed ray reaches the place at a depth that this ray reaches. */
  glm::dvec2 Land(const meniscus::GradedRayResult& ray, double depth) const
  {
    const glm::dvec3 place = this->ToFrame * ray.Exit;
    const glm::dvec3 d = this->ToFrame * ray.Direction;
    if (!(d.z > 0.0))
    {
      return glm::dvec2(NaN);
    }
    const glm::dvec2 there = glm::dvec2(place) + (depth - place.z) / d.z * glm::dvec2(d);
    const auto& origin = this->View.Rays.Origin;
    const auto& slope = this->View.Rays.Slope;
    const glm::dmat2 steps(
      origin.PerColumn + depth * slope.PerColumn, origin.PerRow + depth * slope.PerRow);
    return this->Middle + glm::inverse(steps) * (there - origin.Base - depth * slope.Base);
  }

private:
  const meniscus::IntegralView& View;
  glm::dmat3 ToFrame;
  glm::dmat3 FromFrame;
  glm::dvec2 Middle;
};

/** An array of the output. */
vtkFloatArray* AddArray(vtkImageData* image, const char* name, int components)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return array;
}

/** A picture as numbers, row by row. */
struct Picture
{
  std::vector<float> Values;
  int Width = 0;
  int Height = 0;
};

Picture ReadPicture(vtkImageData* image)
{
  Picture picture;
  const int* size = image->GetDimensions();
  picture.Width = size[0];
  picture.Height = size[1];
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < vtkIdType{ size[0] } * size[1]; ++i)
  {
    picture.Values.push_back(static_cast<float>(scalars->GetComponent(i, 0)));
  }
  return picture;
}

}

/** Tables of the input, and the rays of the last image. */
class vtkTetrahedraSchlieren::vtkInternals
{
public:
  meniscus::VolumeInput Input;
  /** A copy of the input's mesh, in which cells without an index are inactive. */
  meniscus::TetrahedralMesh Mesh;
  meniscus::BoundaryTree Tree;
  std::vector<double> SquaredIndices;
  meniscus::IndexFaults Faults;
  meniscus::ParallelRectangle Rectangle;
  meniscus::IntegralView View;
  std::vector<meniscus::GradedRayResult> Rays;
  meniscus::GradedRayStatistics Statistics;
};

vtkStandardNewMacro(vtkTetrahedraSchlieren);
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
vtkTypeInt64 vtkTetrahedraSchlieren::GetNumberOfRays()
{
  return this->Internals->Statistics.Rays;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraSchlieren::GetNumberOfTraversalSteps()
{
  return this->Internals->Statistics.Steps;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraSchlieren::GetNumberOfStoppedRays()
{
  return this->Internals->Statistics.Trapped;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraSchlieren::GetNumberOfLostRays()
{
  return this->Internals->Statistics.Lost;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraSchlieren::GetNumberOfUnusablePoints()
{
  return this->Internals->Faults.GetNumberOfUnusable();
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
  return this->TellError(internals.Mesh.GetNumberOfActiveCells() > 0
      ? std::string()
      : "No cell has an index of refraction in all of its points");
}

//------------------------------------------------------------------------------
/** Follows the rays of all pixels. Returns false after an error or an abort. */
bool vtkTetrahedraSchlieren::CastRays()
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
  if (!this->TellError(error))
  {
    return false;
  }
  meniscus::GradedMedium medium;
  medium.Mesh = &mesh;
  medium.Tree = &internals.Tree;
  medium.SquaredIndices = &internals.SquaredIndices;
  medium.OutsideIndex = this->OutsideIndex;
  medium.IsStraight = this->BendRays == 0;
  const meniscus::GradedRayWalk walk(medium);
  const PixelRays rays(internals.View, this->ImageSize);
  const int width = this->ImageSize[0];
  const int height = this->ImageSize[1];
  internals.Rays.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
  std::vector<meniscus::GradedRayStatistics> ofRows(static_cast<std::size_t>(height));
  for (int first = 0; first < height; first += RowsPerReport)
  {
    const int rows = std::min(RowsPerReport, height - first);
    meniscus::ThreadedRanges(static_cast<std::size_t>(rows), 1,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t row = begin + static_cast<std::size_t>(first);
             row < end + static_cast<std::size_t>(first); ++row)
        {
          for (int column = 0; column < width; ++column)
          {
            const glm::dvec2 pixel(column, static_cast<double>(row));
            internals
              .Rays[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] =
              walk.Walk(rays.GetOrigin(pixel), rays.GetDirection(pixel), ofRows[row]);
          }
        }
      });
    this->UpdateProgress(ShareOfMedium + ShareOfRays * (first + rows) / height);
    if (this->GetAbortExecute())
    {
      return false;
    }
  }
  for (const meniscus::GradedRayStatistics& row : ofRows)
  {
    internals.Statistics.Add(row);
  }
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
  const PixelRays rays(internals.View, this->ImageSize);
  const double radius = internals.Mesh.GetRadius();
  const glm::dvec3 half = internals.Mesh.GetHalfSize() / radius;
  const double screen = rays.GetDepthBehind(half, this->ScreenDistance);
  const double behind = rays.GetDepthBehind(half, this->BackgroundDistance);
  output->SetExtent(0, width - 1, 0, height - 1, 0, 0);
  const meniscus::ImagePlace place =
    this->Camera ? meniscus::ImagePlace() : PlaceOf(internals.Rectangle, this->ImageSize);
  output->SetOrigin(place.Origin);
  output->SetSpacing(place.Spacing);
  output->SetDirectionMatrix(place.Direction);
  vtkFloatArray* deflections = AddArray(output, "Deflection", 2);
  vtkFloatArray* paths = AddArray(output, "OpticalPathDifference", 1);
  vtkFloatArray* shadows = AddArray(output, "Shadowgraph", 1);
  vtkFloatArray* knives = AddArray(output, "Schlieren", 1);
  vtkFloatArray* fringes = AddArray(output, "Interferogram", 1);
  vtkFloatArray* shifts = AddArray(output, "Displacement", 2);
  vtkFloatArray* warped = background ? AddArray(output, "Background", 1) : nullptr;
  const Picture picture = background ? ReadPicture(background) : Picture();
  meniscus::KnifeEdge knife{ this->KnifeAngle, this->KnifeCutOff, this->KnifeRange };
  const meniscus::Interferometer meter{ this->Wavelength,
    glm::dvec2(this->Fringes[0], this->Fringes[1]) };
  std::vector<glm::dvec2> turned(internals.Rays.size(), glm::dvec2(0.0));
  std::vector<glm::dvec2> landings(internals.Rays.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < internals.Rays.size(); ++i)
  {
    const meniscus::GradedRayResult& ray = internals.Rays[i];
    const auto number = static_cast<vtkIdType>(i);
    const glm::dvec2 pixel(static_cast<double>(i % static_cast<std::size_t>(width)),
      static_cast<double>(i / static_cast<std::size_t>(width)));
    glm::dvec2 seen = pixel;
    landings[i] = pixel;
    double path = 0.0;
    if (ray.State == meniscus::GradedRayState::Left)
    {
      landings[i] = rays.Land(ray, screen);
      seen = rays.Land(ray, behind);
      turned[i] = rays.Deflect(pixel, ray.Direction);
      path = radius *
        (ray.OpticalPath -
          this->ReferenceIndex *
            glm::dot(ray.Exit - ray.Entry, glm::normalize(rays.GetDirection(pixel))));
    }
    const bool isLost = ray.State == meniscus::GradedRayState::Trapped ||
      ray.State == meniscus::GradedRayState::Lost || std::isnan(turned[i].x);
    if (isLost)
    {
      landings[i] = glm::dvec2(NaN);
      turned[i] = glm::dvec2(0.0);
      seen = pixel;
    }
    largest = std::max(largest, std::abs(knife.Along(turned[i])));
    deflections->SetTuple2(number, turned[i].x, turned[i].y);
    paths->SetValue(number, static_cast<float>(path));
    shifts->SetTuple2(number, seen.x - pixel.x, seen.y - pixel.y);
    const glm::dvec2 size(width, height);
    fringes->SetValue(number, static_cast<float>(meter.Interfere(path, (pixel + 0.5) / size)));
    if (warped)
    {
      const glm::dvec2 pixels(picture.Width, picture.Height);
      warped->SetValue(number,
        static_cast<float>(meniscus::SamplePicture(
          picture.Values, picture.Width, picture.Height, (seen + 0.5) / size * pixels - 0.5)));
    }
  }
  if (!(knife.Range > 0.0))
  {
    knife.Range = largest > 0.0 ? 2.0 * largest : 1.0;
  }
  double offScreen = 0.0;
  const std::vector<double> light =
    meniscus::ComputeShadowgraph(landings, width, height, meniscus::ThreadedLoop, offScreen);
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    shadows->SetValue(static_cast<vtkIdType>(i), static_cast<float>(light[i]));
    knives->SetValue(static_cast<vtkIdType>(i), static_cast<float>(knife.Transmit(turned[i])));
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
  this->Internals->Statistics = meniscus::GradedRayStatistics();
  this->Internals->Faults = meniscus::IndexFaults();
  vtkImageData* background =
    inputs[1]->GetNumberOfInformationObjects() > 0 ? vtkImageData::GetData(inputs[1]) : nullptr;
  if (this->CheckSettings(background) && this->UpdateMedium(vtkDataObject::GetData(inputs[0])) &&
    this->CastRays())
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
  os << indent << "NumberOfRays: " << this->GetNumberOfRays() << "\n";
  os << indent << "NumberOfTraversalSteps: " << this->GetNumberOfTraversalSteps() << "\n";
  os << indent << "NumberOfStoppedRays: " << this->GetNumberOfStoppedRays() << "\n";
  os << indent << "NumberOfLostRays: " << this->GetNumberOfLostRays() << "\n";
  os << indent << "NumberOfUnusablePoints: " << this->GetNumberOfUnusablePoints() << "\n";
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractionErrorVolume.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Filters/Common/NamedArray.h"
#include "Filters/Common/ProgressSteps.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Filters/Membrane/ImplicitSurface.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Refraction/Stack/ErrorSamples.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace
{

// Number of samples that a thread takes at once. Progress is reported about a hundred times, but
// not for fewer samples than keep all threads of a large machine busy.
constexpr vtkIdType SampleGrain = 128;
constexpr vtkIdType SampleProgressSteps = 100;
constexpr vtkIdType SmallestSampleStep = 64 * SampleGrain;

using Links = std::vector<meniscus::RefractionStack::Link>;

/** Interfaces that rays pass, relative to a place in world coordinates. */
struct PassedLinks
{
  Links List;
  glm::dvec3 Origin{ 0.0 };

  PassedLinks() = default;
  explicit PassedLinks(const meniscus::RefractionScene& scene)
    : List(scene.ListLinks())
    , Origin(scene.GetOrigin())
  {
  }
};

/** Exact surfaces of interfaces: a function where there is one, otherwise the finer patches. */
class ExactSurfaces : public meniscus::StackSurfaces
{
public:
  ExactSurfaces(
    vtkRefractingInterfaceCollection* interfaces, const Links& links, const PassedLinks& finer)
    : Finer(finer.List, finer.Origin)
  {
    for (const meniscus::RefractionStack::Link& link : links)
    {
      this->Functions.emplace_back();
      vtkRefractingInterface* interface = interfaces->GetInterface(static_cast<int>(link.Index));
      if (interface->GetExactSurface())
      {
        this->Functions.back() = std::make_unique<meniscus::ImplicitSurface>(
          interface->GetExactSurface(), link.Surface->GetMembrane());
        if (!link.Passage.FromFront)
        {
          this->Functions.back()->Turn();
        }
      }
    }
  }

  bool Meet(std::size_t link, const glm::dvec3& origin, const glm::dvec3& direction,
    const glm::dvec3& near, meniscus::PatchPoint& at) const override
  {
    return this->Functions[link] ? this->Functions[link]->Meet(origin, direction, near, at)
                                 : this->Finer.Meet(link, origin, direction, near, at);
  }

private:
  std::vector<std::unique_ptr<meniscus::ImplicitSurface>> Functions;
  meniscus::StackPatches Finer;
};

bool HasAllFunctions(vtkRefractingInterfaceCollection* interfaces)
{
  for (int i = 0; i < interfaces->GetNumberOfItems(); ++i)
  {
    if (!interfaces->GetInterface(i)->GetExactSurface())
    {
      return false;
    }
  }
  return true;
}

/** True if two stacks pass the same interfaces of a list in the same way. */
bool PassAlike(const Links& a, const Links& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const auto& one, const auto& other)
    { return one.Index == other.Index && one.Passage.FromFront == other.Passage.FromFront; });
}

/** Colour of an error, see vtkRefractionErrorVolume::SetColorLimits(). */
std::array<unsigned char, 3> ColorOf(double error, const double limits[3])
{
  // Brightness of an error of 0 in the first band, of 255: its colour must not look black.
  constexpr double darkest = 80.0;
  constexpr std::size_t channels[3] = { 1, 2, 0 }; // green, blue, red
  for (std::size_t band = 0; band < 3; ++band)
  {
    if (error < limits[band])
    {
      std::array<unsigned char, 3> color{};
      color[channels[band]] =
        static_cast<unsigned char>(darkest + (255.0 - darkest) * error / limits[band]);
      return color;
    }
  }
  return { 255, 255, 255 };
}

}

//------------------------------------------------------------------------------
class vtkRefractionErrorVolume::vtkInternals
{
public:
  using Scene = meniscus::RefractionScene;

  // Exact surfaces are compared with the meshes as they are given.
  Scene Measured{ Scene::Fitting::AsGiven };
  /** The finer meshes, or the same mesh if the scene has flat facets. */
  Scene Reference{ Scene::Fitting::AsGiven, Scene::Use::Rays };
  /** Interfaces of the solvers, and of the meshes that are exact surfaces. */
  PassedLinks Passed;
  PassedLinks Finer;
  std::vector<meniscus::ErrorSample> Samples;
  meniscus::ErrorSummary Summary;
  bool WarnedOfNoReference = false;
};

vtkStandardNewMacro(vtkRefractionErrorVolume);
meniscusInterfacePropertiesMacro(vtkRefractionErrorVolume);
meniscusExactMembraneMacro(vtkRefractionErrorVolume);
meniscusInterfaceTimeMacro(vtkRefractionErrorVolume);
meniscusMembranePortMacro(vtkRefractionErrorVolume, 0);
meniscusSetClampMacro(vtkRefractionErrorVolume, MembraneModel, int, FLAT_FACETS, CURVED);
meniscusGetInternalMacro(vtkRefractionErrorVolume, double, MeanError() const, Summary.Mean);
meniscusGetInternalMacro(
  vtkRefractionErrorVolume, double, StandardDeviation() const, Summary.Deviation);
meniscusGetInternalMacro(vtkRefractionErrorVolume, double, LargestError() const, Summary.Largest);
meniscusGetInternalMacro(
  vtkRefractionErrorVolume, vtkTypeInt64, NumberOfMeasuredSamples() const, Summary.Count);
meniscusGetInternalMacro(vtkRefractionErrorVolume, vtkTypeInt64, NumberOfPatchBuilds() const,
  Measured.GetNumberOfPatchBuilds());
meniscusGetInternalMacro(vtkRefractionErrorVolume, vtkTypeInt64, NumberOfEyeUpdates() const,
  Measured.GetNumberOfEyeUpdates());

//------------------------------------------------------------------------------
vtkRefractionErrorVolume::vtkRefractionErrorVolume()
  : Internals(new vtkInternals)
{
  this->Interfaces = meniscus::MakeInterfaces();
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkRefractionErrorVolume::~vtkRefractionErrorVolume() = default;

//------------------------------------------------------------------------------
void vtkRefractionErrorVolume::SetReferenceData(vtkPolyData* membrane)
{
  this->SetInputData(1, membrane);
}

//------------------------------------------------------------------------------
void vtkRefractionErrorVolume::AddReferenceData(vtkPolyData* membrane)
{
  this->AddInputDataInternal(1, membrane);
}

//------------------------------------------------------------------------------
void vtkRefractionErrorVolume::RemoveAllReferences()
{
  this->SetInputConnection(1, nullptr);
}

//------------------------------------------------------------------------------
int vtkRefractionErrorVolume::FillInputPortInformation(int port, vtkInformation* info)
{
  return meniscus::AcceptSurfaces(info, port == 1);
}

//------------------------------------------------------------------------------
bool vtkRefractionErrorVolume::HasValidBox()
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* range = this->ModelBounds + 2 * axis;
    if (!std::isfinite(range[0]) || !std::isfinite(range[1]) || range[0] > range[1])
    {
      vtkErrorMacro("ModelBounds " << range[0] << " to " << range[1] << " along axis " << axis
                                   << " are not finite or not in order; the output is empty.");
      return false;
    }
    if (this->SampleDimensions[axis] < 1)
    {
      vtkErrorMacro("SampleDimensions must be at least 1, not "
        << this->SampleDimensions[axis] << " along axis " << axis << "; the output is empty.");
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRefractionErrorVolume::HasValidLimits()
{
  const double* limits = this->ColorLimits;
  // Written so that a NaN fails.
  if (!(0.0 < limits[0] && limits[0] <= limits[1] && limits[1] <= limits[2] &&
        std::isfinite(limits[2])))
  {
    vtkErrorMacro("ColorLimits " << limits[0] << ", " << limits[1] << " and " << limits[2]
                                 << " are not positive, finite and in ascending order; the output "
                                    "is empty.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkRefractionErrorVolume::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputs), vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  int extent[6];
  double origin[3];
  double spacing[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    // Errors in the box are reported in RequestData, when there is an output to empty.
    const double* range = this->ModelBounds + 2 * axis;
    const int last = std::max(this->SampleDimensions[axis], 1) - 1;
    extent[2 * axis] = 0;
    extent[2 * axis + 1] = last;
    origin[axis] = range[0];
    const double step = last > 0 ? (range[1] - range[0]) / last : 0.0;
    spacing[axis] = step > 0.0 ? step : 1.0;
  }
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::ORIGIN(), origin, 3);
  info->Set(vtkDataObject::SPACING(), spacing, 3);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_DOUBLE, 1);
  return 1;
}

//------------------------------------------------------------------------------
// Every part of the volume needs all membranes whole.
int vtkRefractionErrorVolume::RequestUpdateExtent(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputs, vtkInformationVector* vtkNotUsed(outputs))
{
  meniscus::RequestWhole(inputs[0]);
  meniscus::RequestWhole(inputs[1]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractionErrorVolume::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  this->Internals->Summary = meniscus::ErrorSummary();
  vtkPolyData* membrane = vtkPolyData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  if (!membrane || !output)
  {
    vtkErrorMacro("The membrane is missing or is not a vtkPolyData; the output is empty.");
    return 0;
  }
  if (!this->HasValidBox() || !this->HasValidLimits() || !this->UpdateScenes(inputs[0], inputs[1]))
  {
    return 0;
  }
  vtkInformation* info = outputs->GetInformationObject(0);
  output->SetExtent(info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
  output->SetOrigin(info->Get(vtkDataObject::ORIGIN()));
  output->SetSpacing(info->Get(vtkDataObject::SPACING()));
  this->Internals->Samples.assign(
    static_cast<std::size_t>(output->GetNumberOfPoints()), meniscus::ErrorSample());
  if (this->MeasureSamples(output))
  {
    this->FillOutput(output);
  }
  else
  {
    output->Initialize();
  }
  std::vector<meniscus::ErrorSample>().swap(this->Internals->Samples);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkRefractionErrorVolume::UpdateScenes(
  vtkInformationVector* membranes, vtkInformationVector* references)
{
  vtkInternals& internals = *this->Internals;
  const bool isCurved = this->MembraneModel == CURVED;
  const std::array<double, 3> eye = { this->EyePosition[0], this->EyePosition[1],
    this->EyePosition[2] };
  meniscus::SceneMessages messages;
  if (!isCurved && this->Interfaces->GetNumberOfItems() > 1)
  {
    messages.Error = "Several refracting interfaces need the membrane model CURVED";
  }
  bool isReady =
    internals.Measured.Update({ membranes, 0, this->Interfaces, isCurved }, eye, messages);
  const bool hasFunctions = HasAllFunctions(this->Interfaces);
  const bool hasFiner = references->GetNumberOfInformationObjects() > 0;
  const bool hasReference = !hasFunctions && (hasFiner || !isCurved);
  if (isReady)
  {
    internals.Measured.PrepareCrossings();
    internals.Passed = PassedLinks(internals.Measured);
    internals.Finer = internals.Passed;
  }
  if (isReady && hasReference)
  {
    isReady = internals.Reference.Update(
      { hasFiner ? references : membranes, hasFiner ? 1 : 0, this->Interfaces }, eye, messages);
  }
  if (isReady && hasReference)
  {
    internals.Finer = PassedLinks(internals.Reference);
    if (!PassAlike(internals.Passed.List, internals.Finer.List))
    {
      messages.Error = "The eye lies between a membrane and the finer one";
      isReady = false;
    }
  }
  meniscus::Report(this, messages);
  if (isReady && !hasFunctions && !hasReference && !internals.WarnedOfNoReference)
  {
    internals.WarnedOfNoReference = true;
    vtkWarningMacro("Interfaces without an exact surface are compared with themselves: set exact "
                    "surfaces, or finer membranes on port 1, to measure the error of the meshes.");
  }
  return isReady;
}

//------------------------------------------------------------------------------
// Returns false after an abort.
bool vtkRefractionErrorVolume::MeasureSamples(vtkImageData* output)
{
  vtkInternals& internals = *this->Internals;
  const glm::dvec3 eye(this->EyePosition[0], this->EyePosition[1], this->EyePosition[2]);
  const Links& links = internals.Passed.List;
  const ExactSurfaces exact(this->Interfaces, links, internals.Finer);
  const meniscus::ErrorSampler sampler(eye, links, exact, this->AngularErrors);
  const auto measure = [&internals, &sampler, output](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType i = begin; i < end; ++i)
    {
      glm::dvec3 point;
      output->GetPoint(i, &point.x);
      internals.Samples[static_cast<std::size_t>(i)] = internals.Measured.Visit(
        [&](const auto& solver) { return sampler.Measure(solver, point); });
    }
  };
  return meniscus::RunInSteps(this, output->GetNumberOfPoints(), SampleProgressSteps,
    SmallestSampleStep,
    [&measure](vtkIdType first, vtkIdType last)
    { meniscus::ThreadedFor(first, last, SampleGrain, measure); });
}

//------------------------------------------------------------------------------
void vtkRefractionErrorVolume::FillOutput(vtkImageData* output)
{
  const std::vector<meniscus::ErrorSample>& samples = this->Internals->Samples;
  auto* errors = meniscus::AddPointArray<vtkDoubleArray>(output, "RefractionError", 1);
  auto* states = meniscus::AddPointArray<vtkUnsignedCharArray>(output, "SampleState", 1);
  auto* colors = meniscus::AddPointArray<vtkUnsignedCharArray>(output, "ErrorColor", 3);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const bool measured = samples[i].State == meniscus::SampleState::Measured;
    colors->SetTypedTuple(static_cast<vtkIdType>(i),
      (measured ? ColorOf(samples[i].Error, this->ColorLimits) : std::array<unsigned char, 3>{})
        .data());
    errors->SetValue(static_cast<vtkIdType>(i),
      measured ? samples[i].Error : std::numeric_limits<double>::quiet_NaN());
    states->SetValue(static_cast<vtkIdType>(i), static_cast<unsigned char>(samples[i].State));
  }
  output->GetPointData()->SetScalars(errors);
  if (this->AngularErrors)
  {
    this->AddAngles(output);
  }
  const meniscus::ErrorSummary summary = meniscus::Summarize(samples.data(), samples.size());
  this->SetStatistics(output, summary.Mean, summary.Deviation, summary.Largest,
    static_cast<vtkTypeInt64>(summary.Count));
}

//------------------------------------------------------------------------------
void vtkRefractionErrorVolume::AddAngles(vtkImageData* output)
{
  vtkNew<vtkDoubleArray> angles;
  angles->SetName("AngularError");
  for (const meniscus::ErrorSample& sample : this->Internals->Samples)
  {
    angles->InsertNextValue(vtkMath::DegreesFromRadians(sample.Angle));
  }
  output->GetPointData()->AddArray(angles);
}

//------------------------------------------------------------------------------
void vtkRefractionErrorVolume::SetStatistics(vtkImageData* output, double meanError,
  double standardDeviation, double largestError, vtkTypeInt64 numberOfMeasuredSamples)
{
  this->Internals->Summary = { meanError, standardDeviation, largestError,
    static_cast<std::size_t>(numberOfMeasuredSamples) };
  const auto addNumber = [output](const char* name, double value)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    output->GetFieldData()->AddArray(array);
  };
  addNumber("MeanError", this->GetMeanError());
  addNumber("StandardDeviation", this->GetStandardDeviation());
  addNumber("LargestError", this->GetLargestError());
  vtkNew<vtkIdTypeArray> measured;
  measured->SetName("NumberOfMeasuredSamples");
  measured->InsertNextValue(static_cast<vtkIdType>(this->GetNumberOfMeasuredSamples()));
  output->GetFieldData()->AddArray(measured);
}

//------------------------------------------------------------------------------
void vtkRefractionErrorVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EyePosition: (" << this->EyePosition[0] << ", " << this->EyePosition[1] << ", "
     << this->EyePosition[2] << ")\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
  os << indent << "MembraneModel: " << (this->MembraneModel == CURVED ? "CURVED" : "FLAT_FACETS")
     << "\n";
  os << indent << "ExactMembrane: " << this->GetExactMembrane() << "\n";
  os << indent << "ModelBounds: (" << this->ModelBounds[0] << ", " << this->ModelBounds[1] << ", "
     << this->ModelBounds[2] << ", " << this->ModelBounds[3] << ", " << this->ModelBounds[4] << ", "
     << this->ModelBounds[5] << ")\n";
  os << indent << "SampleDimensions: (" << this->SampleDimensions[0] << ", "
     << this->SampleDimensions[1] << ", " << this->SampleDimensions[2] << ")\n";
  os << indent << "AngularErrors: " << this->AngularErrors << "\n";
  os << indent << "ColorLimits: (" << this->ColorLimits[0] << ", " << this->ColorLimits[1] << ", "
     << this->ColorLimits[2] << ")\n";
  os << indent << "MeanError: " << this->GetMeanError() << "\n";
  os << indent << "StandardDeviation: " << this->GetStandardDeviation() << "\n";
  os << indent << "LargestError: " << this->GetLargestError() << "\n";
  os << indent << "NumberOfMeasuredSamples: " << this->GetNumberOfMeasuredSamples() << "\n";
}

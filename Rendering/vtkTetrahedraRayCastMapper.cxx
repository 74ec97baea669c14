// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Rendering/Backends/OpenGL/RayCastShader.h"
#include "Rendering/Common/Matrices.h"
#include "Rendering/Input/ComponentChoice.h"
#include "Rendering/RayCastMapperInternals.h"

#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkHardwareSelector.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkTetrahedraRayCastMapper);
meniscusInterfacePropertiesMacro(vtkTetrahedraRayCastMapper);
meniscusInterfaceTimeMacro(vtkTetrahedraRayCastMapper);

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::vtkTetrahedraRayCastMapper()
  : EarlyTerminationOpacity(meniscus::DefaultTerminationOpacity)
  , MaximumTableSize(VTK_TYPE_INT64_MAX)
  , Internals(new vtkInternals)
{
  this->Interfaces = meniscus::MakeInterfaces();
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::~vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastMapper::FillInputPortInformation(int port, vtkInformation* info)
{
  return port == 1 ? meniscus::AcceptSurfaces(info, true) : meniscus::AcceptDataSets(info);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetInputData(vtkDataSet* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::SetInputData(vtkCompositeDataSet* input)
{
  this->SetInputDataInternal(0, input);
}

//------------------------------------------------------------------------------
/** Box of the cells that are drawn; without usable scalars, of all cells that could be. */
meniscus::PointBox vtkTetrahedraRayCastMapper::MeasureInput()
{
  if (this->GetNumberOfInputConnections(0) == 0)
  {
    return meniscus::PointBox();
  }
  this->GetInputAlgorithm()->Update();
  meniscus::InputBlocks parts;
  meniscus::CollectInputBlocks(this->GetDataObjectInput(), this->SelectedScalars(), parts);
  return this->Internals->Bounds.Update(
    parts.Parts.empty() ? meniscus::CollectGrids(this->GetDataObjectInput()) : parts,
    this->Internals->Input.GetDigests());
}

//------------------------------------------------------------------------------
double* vtkTetrahedraRayCastMapper::GetBounds()
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkMath::UninitializeBounds(this->Bounds);
  const meniscus::PointBox ofInput = this->MeasureInput();
  if (ofInput.IsEmpty())
  {
    return this->Bounds;
  }
  // Told here, because renderers ask for bounds first, and do not render what no camera sees.
  const std::string tooSmall = meniscus::DescribeSmallBox(ofInput);
  this->WarnOnce(!tooSmall.empty(), this->Internals->WarnedSize, tooSmall.c_str());
  vtkBoundingBox box(ofInput.Lower.x, ofInput.Upper.x, ofInput.Lower.y, ofInput.Upper.y,
    ofInput.Lower.z, ofInput.Upper.z);
  for (int i = 0; i < this->GetNumberOfMembranes(); ++i)
  {
    this->GetInputAlgorithm(1, i)->Update();
    vtkPolyData* membrane = this->GetMembrane(i);
    if (!membrane || membrane->GetNumberOfPoints() == 0)
    {
      continue;
    }
    // The volume's matrix transforms these to world coordinates, in which the membrane is given.
    double corners[6];
    membrane->GetBounds(corners);
    for (int c = 0; c < 8; ++c)
    {
      const glm::dvec4 corner = this->Internals->WorldToModel *
        glm::dvec4(corners[c & 1], corners[2 + (c >> 1 & 1)], corners[4 + (c >> 2 & 1)], 1.0);
      box.AddPoint(corner.x, corner.y, corner.z);
    }
  }
  box.GetBounds(this->Bounds);
  return this->Bounds;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::Tell(const meniscus::InputReport& report)
{
  if (!report.Error.empty())
  {
    vtkErrorMacro(<< report.Error << "; nothing is rendered.");
  }
  if (!report.Warning.empty())
  {
    vtkWarningMacro(<< report.Warning);
  }
  return report.Error.empty();
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::CollectInput(meniscus::InputBlocks& parts)
{
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->Update();
  }
  meniscus::InputReport report =
    meniscus::CollectInputBlocks(this->GetDataObjectInput(), this->SelectedScalars(), parts);
  // The warning is not repeated in every frame if the same parts are left out.
  const bool told = report.Warning == this->Internals->LastInputWarning;
  this->Internals->LastInputWarning = report.Warning;
  report.Warning = told ? std::string() : report.Warning;
  return this->Tell(report);
}

//------------------------------------------------------------------------------
meniscus::ScalarSelection vtkTetrahedraRayCastMapper::SelectedScalars()
{
  meniscus::ScalarSelection selection;
  selection.ScalarMode = this->ScalarMode;
  selection.AccessMode = this->ArrayAccessMode;
  selection.ArrayId = this->ArrayId;
  selection.ArrayName = this->ArrayName;
  if (this->VectorMode != DISABLED)
  {
    selection.Component =
      this->VectorMode == MAGNITUDE ? meniscus::ScalarSelection::Magnitude : this->VectorComponent;
  }
  return selection;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::ChooseMixture(
  const meniscus::InputBlocks& parts, vtkVolume* volume)
{
  using Mixture = meniscus::ComponentMixture;
  vtkInternals& internals = *this->Internals;
  internals.Mixture = Mixture::None;
  internals.Component = this->SelectedScalars().Component;
  vtkDataArray* scalars = parts.Parts.front().Scalars;
  const int components = scalars->GetNumberOfComponents();
  int most = components;
  bool same = true;
  for (const meniscus::InputPart& part : parts.Parts)
  {
    most = std::max(most, part.Scalars->GetNumberOfComponents());
    same = same && part.Scalars->GetNumberOfComponents() == components;
  }
  if (this->VectorMode != DISABLED || most == 1)
  {
    return true;
  }
  const bool independent = volume->GetProperty()->GetIndependentComponents() != 0;
  if (independent)
  {
    internals.Component = meniscus::ChooseComponent(volume->GetProperty(), most);
  }
  if (internals.Component != meniscus::ScalarSelection::Only)
  {
    return this->HasChosenComponent(parts);
  }
  const bool fits = independent ? components <= 4 : components == 2 || components == 4;
  const char* problem = nullptr;
  if (!same)
  {
    problem = ", and another data set not as many";
  }
  else if (!fits)
  {
    problem = independent ? "; 1 to 4 are needed, or a VectorMode"
                          : "; 1, 2 or 4 are needed, or a VectorMode";
  }
  else if (parts.Place == meniscus::FieldAssociation::Cells || !this->GetBlendModel().IsMedium())
  {
    problem = "; cell data and other than composite blending need 1, or a VectorMode";
  }
  if (problem)
  {
    const char* name = scalars->GetName();
    vtkErrorMacro("The array '" << (name ? name : "without a name") << "' has " << components
                                << " components" << problem << "; nothing is rendered.");
    return false;
  }
  internals.Mixture = independent ? Mixture::Independent
    : components == 2             ? Mixture::ColorAndOpacity
                                  : Mixture::RedGreenBlueOpacity;
  return true;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::HasChosenComponent(const meniscus::InputBlocks& parts)
{
  const int chosen = this->Internals->Component;
  for (const meniscus::InputPart& part : parts.Parts)
  {
    const int components = part.Scalars->GetNumberOfComponents();
    if (components > 1 && chosen >= components)
    {
      const char* name = part.Scalars->GetName();
      vtkErrorMacro("The array '" << (name ? name : "without a name") << "' has " << components
                                  << " components, none of number " << chosen
                                  << ", which the colour function selects; nothing is rendered.");
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::WarnOnce(bool condition, bool& warned, const char* text)
{
  if (condition && !warned)
  {
    warned = true;
    vtkWarningMacro(<< text);
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::WarnAboutUnavailable()
{
  vtkInternals& internals = *this->Internals;
  this->WarnOnce(!meniscus::FindBlendModel(this->BlendMode), internals.WarnedBlendMode,
    "The blend mode is not available for meshes; rendering with composite blending.");
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::UpdateInput(
  vtkRenderWindow* window, vtkVolume* volume, const meniscus::InputBlocks& parts)
{
  vtkInternals& internals = *this->Internals;
  meniscus::VolumeInput& input = internals.Input;
  this->SetAbortExecute(0);
  const auto goOn = [this, window](double fraction) { return this->GoOn(window, fraction); };
  const bool mixed = internals.Mixture != meniscus::ComponentMixture::None;
  const int component = mixed ? MainComponent(internals.Mixture) : internals.Component;
  meniscus::DivisionRequest division;
  division.Settings = { this->CellDivision == ADAPTIVE_DIVISION, this->DivisionTolerance,
    this->MaximumNumberOfPieces };
  division.Fields = parts;
  division.Component = mixed ? meniscus::ScalarSelection::Only : component;
  const meniscus::InputReport ofProperty = internals.Property.Reduce(volume->GetProperty(),
    this->GetBlendModel().Mode, this->OpacityModel == OPACITY_PER_UNIT_DISTANCE, internals.Mixture,
    mixed ? parts.Parts.front().Scalars->GetNumberOfComponents() : 1);
  if (!this->Tell(ofProperty))
  {
    return false;
  }
  division.Picture = internals.Property.GetPictureFunction();
  division.UnitLength =
    std::cbrt(std::abs(glm::determinant(glm::dmat3(meniscus::ToGlm(volume->GetMatrix())))));
  if (!this->Tell(input.UpdateMesh(parts, goOn, division)) ||
    input.GetMesh().GetNumberOfCells() == 0)
  {
    return false;
  }
  const meniscus::FunctionFeatures& features = internals.Property.GetFeatures();
  return this->Tell(input.UpdateScalars(parts, component, features)) &&
    this->Tell(internals.Components.Update(input, parts, internals.Mixture, features));
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::UpdateMembrane(meniscus::RayCastMembrane& membrane)
{
  // The list is never shorter than one; the interface of a mapper without a membrane is not used.
  this->Interfaces->GetFirstInterface();
  std::vector<vtkPolyData*> surfaces;
  for (int i = 0; i < this->GetNumberOfMembranes(); ++i)
  {
    this->GetInputAlgorithm(1, i)->Update();
    surfaces.push_back(this->GetMembrane(i));
  }
  const bool isPart = this->Internals->Part != meniscus::MembranePart::Whole;
  return this->Tell(membrane.Update(surfaces, this->Interfaces, isPart));
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::PrepareRefraction(
  const meniscus::ViewContext& place, meniscus::RayCastFrame& frame)
{
  meniscus::RayCastRefraction& refracting = frame.Refracting;
  refracting.Part = this->Internals->Part;
  refracting.Wanted = this->Internals->Membrane.GetNumberOfInterfaces() > 0;
  refracting.Center = place.CenterInWorld;
  const glm::dvec3 eye(glm::inverse(place.WorldToView) * glm::dvec4(0.0, 0.0, 0.0, 1.0));
  refracting.EyeDepth = (glm::inverse(frame.Rays.ViewToWorld) * (eye - refracting.Center)).z;
}

//------------------------------------------------------------------------------
const meniscus::BlendModel& vtkTetrahedraRayCastMapper::GetBlendModel()
{
  const meniscus::BlendModel* model = meniscus::FindBlendModel(this->BlendMode);
  return model ? *model : meniscus::GetBlendModel(meniscus::BlendMode::Composite);
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::CanRanksComposite(int blendMode)
{
  const meniscus::BlendModel* model = meniscus::FindBlendModel(blendMode);
  return !model || model->RanksComposite(); // composite blending replaces an unknown mode
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::UpdateTransferFunction()
{
  vtkInternals& internals = *this->Internals;
  internals.Property.Normalize(internals.Input.GetNormalization(), internals.Components);
  const meniscus::VisibleScalars visible = internals.Property.GetVisibleScalars();
  if (internals.Mixture != meniscus::ComponentMixture::None)
  {
    internals.Input.UpdateActiveCells(visible,
      { &internals.Components.GetValues(), internals.Components.GetVersion(),
        internals.Property.GetVisibleOthers() });
    return;
  }
  using Jumps = meniscus::TetrahedralMesh::CellJumps;
  internals.Input.UpdateActiveCells(
    visible, this->GetBlendModel().SeesJumps() ? Jumps::Visible : Jumps::Hidden);
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::ChooseIntegration(
  vtkVolume* volume, meniscus::RayCastOptics& optics)
{
  const bool wanted = this->Integration == PRE_INTEGRATED && optics.Model().IsMedium();
  // No warning for scalars of cells: they are constant in each cell, so the table would hold the
  // exact values.
  this->WarnOnce(wanted && !optics.IsPlainMedium() && !optics.CellScalars,
    this->Internals->WarnedIntegration,
    "Pre-integration is not available with shading, gradient opacity, several components and a "
    "medium behind a membrane; integrating exactly.");
  optics.PreIntegrated = wanted && optics.IsPlainMedium();
  if (optics.PreIntegrated)
  {
    vtkInternals& internals = *this->Internals;
    internals.PreIntegration.Update(internals.Input, internals.Property,
      meniscus::ToGlm(volume->GetMatrix()),
      { this->PreIntegrationScalarSize, this->PreIntegrationLengthSize });
  }
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::DrawFrame(
  meniscus::RayCastFrame& frame, const meniscus::InputBlocks& parts)
{
  using Number = meniscus::RayCastBackendNumber;
  static_assert(int(Number::Automatic) == AUTOMATIC && int(Number::OpenGL) == OPENGL &&
      int(Number::Native) == NATIVE && int(Number::Compute) == COMPUTE &&
      int(Number::Registered) == REGISTERED,
    "the same numbers");
  vtkInternals& internals = *this->Internals;
  const meniscus::RayCastBackendChoice choice =
    internals.ChooseBackend(frame, { this->BackendName, static_cast<Number>(this->Backend) });
  if (!choice.Backend)
  {
    return "no backend can draw it: " + choice.Reasons;
  }
  std::string fallback;
  for (const std::string& refused : choice.Refused)
  {
    fallback += refused + " -> ";
  }
  if (!fallback.empty() && internals.WarnedFallbacks.insert(fallback + choice.Name).second)
  {
    vtkWarningMacro("Rendering with the backend " << choice.Name << ": " << choice.Reasons << ".");
  }
  internals.UpdateGradients(parts, frame.Optics);
  if (frame.Optics.Illuminated && !this->UpdateIllumination(frame))
  {
    internals.ClearStatistics();
    return std::string(); // aborted
  }
  const std::string error = internals.Draw(frame, *choice.Backend);
  if (error.empty())
  {
    this->ActiveBackend = static_cast<int>(choice.Number);
    this->ActiveBackendName = choice.Name;
  }
  return error;
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::PrepareFrame(
  vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame)
{
  vtkInternals& internals = *this->Internals;
  vtkHardwareSelector* selector = renderer->GetSelector();
  const double sampleDistance = selector ? 1.0 : this->ChooseImageSampleDistance(volume);
  int viewport[4];
  internals.GetPresenter().GetViewport(viewport);
  // Several rays per pixel do not make the image larger.
  const double pixels = std::max(sampleDistance, 1.0);
  for (int i = 0; i < 2; ++i)
  {
    frame.Output.ImageSize[i] = std::max(1, static_cast<int>(std::ceil(viewport[2 + i] / pixels)));
  }
  // In single precision, the reciprocal of the distance 1 / n is n.
  frame.Output.RaysAcross =
    std::max(1, static_cast<int>(std::ceil(1.0f / static_cast<float>(sampleDistance))));
  frame.Output.MayStop =
    !selector && internals.Part == meniscus::MembranePart::Whole && vtkInternals::IsStill(volume);
  frame.Output.ColorBias = static_cast<float>(this->ColorBias);
  frame.MaximumTableSize = this->MaximumTableSize;
  frame.SettingsTime = this->vtkObject::GetMTime();
  this->UsedImageSampleDistance = pixels / frame.Output.RaysAcross;
  if (selector)
  {
    // Other passes distinguish parts of a prop: this one has a single part with id 0.
    const bool propPass = selector->GetCurrentPass() == vtkHardwareSelector::ACTOR_PASS;
    const float* value = selector->GetPropColorValue();
    frame.Output.Selecting = true;
    frame.Output.SelectionValue =
      propPass ? glm::vec3(value[0], value[1], value[2]) : glm::vec3(0.0f);
  }
  const std::string error = this->PrepareView(renderer, volume, frame);
  if (!error.empty())
  {
    return error;
  }
  if (!selector && this->IsCoarse(volume, sampleDistance) &&
    this->EarlyTerminationOpacity == meniscus::DefaultTerminationOpacity)
  {
    frame.EarlyTerminationOpacity = meniscus::CoarseTerminationOpacity;
    frame.Output.Interpolating = true;
  }
  this->ChooseIntegration(volume, frame.Optics);
  return meniscus::DescribeExcess(frame.Optics);
}

//------------------------------------------------------------------------------
/** Rays and optics of a frame of a given size, but for the way of integration. */
std::string vtkTetrahedraRayCastMapper::PrepareView(
  vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame)
{
  vtkInternals& internals = *this->Internals;
  meniscus::ViewContext place;
  const std::string error = internals.ComputeFrame(renderer, volume, frame.Output.ImageSize, place);
  if (!error.empty())
  {
    return error;
  }
  frame.Rays = place.Frame;
  frame.ModelToClip = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 0.0)) * place.ViewToClip *
    place.WorldToView * meniscus::ToGlm(volume->GetMatrix());
  this->PrepareRefraction(place, frame);
  frame.EarlyTerminationOpacity = this->EarlyTerminationOpacity;
  frame.Optics.Blending = this->GetBlendModel().Mode;
  frame.Optics.Components = internals.Mixture;
  frame.Optics.NumberOfFunctions =
    1 + static_cast<int>(internals.Property.GetOtherIntervals().size());
  frame.Optics.DataRange = internals.Input.GetNormalizedRange();
  frame.Optics.CompactCells = this->CompactCells;
  frame.Optics.CellScalars =
    internals.Input.GetFieldAssociation() == meniscus::FieldAssociation::Cells;
  frame.Optics.Illuminated = this->GlobalIlluminationReach > 0.0f && frame.Optics.Model().IsLit();
  meniscus::GatherShading(volume->GetProperty(), renderer, place, frame.Optics);
  this->WarnOnce(frame.Optics.HasUnusableLights, internals.WarnedLights,
    "A light that is switched on has no direction, or a number that is not finite; it does not "
    "shine.");
  this->WarnOnce(internals.Mixture == meniscus::ComponentMixture::Independent &&
      ((volume->GetProperty()->GetShade() != 0 && !frame.Optics.Illuminated) ||
        meniscus::UsesGradientOpacity(volume->GetProperty())),
    internals.WarnedComponents,
    "Independent components have no common gradient, which could light them or change their "
    "opacity; rendering without. A GlobalIlluminationReach above 0 lights them.");
  const std::string ofPlanes =
    meniscus::GatherClippingPlanes(this->ClippingPlanes, place, frame.Optics);
  frame.Optics.VertexGradients = frame.Optics.UsesGradients() && frame.Optics.HasGradients() &&
    this->Gradients == VERTEX_GRADIENTS;
  this->PrepareIllumination(renderer, volume, frame);
  // Rays that are refracted nowhere see through no medium; other modes show no light.
  if (frame.Refracting.Wanted && frame.Optics.Model().HidesBehind())
  {
    frame.Optics.Medium = internals.Medium;
  }
  return ofPlanes.empty() ? meniscus::DescribeUnlit(frame.Optics) : ofPlanes;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::Draw(
  vtkRenderer* renderer, vtkVolume* volume, const meniscus::InputBlocks& parts)
{
  vtkInternals& internals = *this->Internals;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    vtkErrorMacro("The renderer has no OpenGL window; nothing is rendered.");
    return false;
  }
  this->UpdateMedium();
  const meniscus::TetrahedralMesh& mesh = internals.Input.GetMesh();
  // A mesh without extent has no cell that a ray could cross.
  if (mesh.GetNumberOfActiveCells() == 0 || mesh.GetRadius() == 0.0)
  {
    internals.ClearStatistics();
    return true;
  }
  vtkOpenGLClearErrorMacro();
  meniscus::RayCastFrame frame;
  std::string error = internals.SetWindow(window);
  if (error.empty())
  {
    error = this->PrepareFrame(renderer, volume, frame);
  }
  if (error.empty())
  {
    error = this->DrawFrame(frame, parts);
  }
  if (error.empty() && internals.IsFinished() && this->DepthWriting != NO_DEPTH &&
    internals.Part == meniscus::MembranePart::Whole)
  {
    error = this->WriteDepths(frame);
  }
  // Once for each change, not for each frame.
  const vtkMTimeType time = std::max(this->vtkObject::GetMTime(), volume->GetMTime());
  const bool isTold = error == internals.DrawFault && time == internals.DrawFaultTime;
  internals.DrawFault = error;
  internals.DrawFaultTime = time;
  if (!error.empty())
  {
    internals.ClearStatistics();
    if (!isTold)
    {
      vtkErrorMacro("Nothing is rendered: " << error << ".");
    }
    return false;
  }
  this->Tell({ "", internals.Input.WarnOfOverlaps(internals.CountOverlaps()) });
  this->Tell({ "", internals.Membrane.WarnOfSide() });
  vtkOpenGLCheckErrorMacro("failed after Render");
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::RenderPart(vtkRenderer* renderer, vtkVolume* volume,
  meniscus::MembranePart part, const meniscus::RefractionMedium& surroundings)
{
  this->Internals->Part = part;
  this->Internals->Surroundings = surroundings;
  this->Render(renderer, volume);
  this->Internals->Part = meniscus::MembranePart::Whole;
  this->Internals->Surroundings = meniscus::RefractionMedium();
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkInformation* keys = volume->GetPropertyKeys();
  const bool peeled = renderer->GetUseDepthPeelingForVolumes() && keys &&
    keys->Has(vtkOpenGLRenderPass::RenderPasses());
  this->WarnOnce(peeled, this->Internals->WarnedPeeling,
    "A renderer with UseDepthPeelingForVolumes does not show this volume together with "
    "translucent geometry; turn it off to draw the volume over that geometry.");
  if (peeled)
  {
    return;
  }
  meniscus::InputBlocks parts;
  if (!this->CollectInput(parts) || parts.Parts.empty() || !this->ChooseMixture(parts, volume) ||
    !this->UpdateMembrane(this->Internals->Membrane) ||
    !this->UpdateInput(renderer->GetRenderWindow(), volume, parts))
  {
    return;
  }
  this->Internals->SetPlace(volume);
  this->WarnAboutUnavailable();
  this->UpdateTransferFunction();
  vtkHardwareSelector* selector = renderer->GetSelector();
  if (selector)
  {
    selector->BeginRenderProp();
    this->Draw(renderer, volume, parts);
    selector->EndRenderProp();
    return;
  }
  const double start = vtkTimerLog::GetUniversalTime();
  const std::int64_t casts = this->Internals->GetNumberOfCasts();
  // The time of a frame that shows the last image again says nothing about the next one.
  if (this->Draw(renderer, volume, parts) && this->Internals->GetNumberOfCasts() != casts)
  {
    // Drawing is over when the device says so, not when the commands are sent.
    this->Internals->GetPresenter().Finish();
    this->TimeToDraw = std::max(vtkTimerLog::GetUniversalTime() - start, 1.0e-9);
    if (this->Internals->WasWhole())
    {
      vtkInternals& internals = *this->Internals;
      internals.FullImageTime = this->TimeToDraw * this->GetShareOfOneRay(casts);
      internals.AllRaysTime = internals.FullImageTime / internals.GetShareOfCastRays();
    }
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internals->ReleaseGraphicsResources(window);
}

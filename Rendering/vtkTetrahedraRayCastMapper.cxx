// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "RayCastNative.h"
#include "RayCastOpenGL.h"
#include "RayCastOptics.h"
#include "RayCastShader.h"
#include "Volume/RayFrame.h"
#include "Volume/VertexGradients.h"
#include "VolumeInput.h"
#include "VolumePropertyTables.h"

#include "vtkCamera.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkHardwareSelector.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace
{

glm::dmat4 ToGlm(vtkMatrix4x4* matrix)
{
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      result[column][row] = matrix->GetElement(row, column);
    }
  }
  return result;
}

}

class vtkTetrahedraRayCastMapper::vtkInternals
{
public:
  meniscus::VolumeInput Input;
  meniscus::VolumePropertyTables Property;
  std::vector<glm::vec3> Gradients;
  meniscus::RayCastOpenGL OpenGL;
  meniscus::RayCastNative Native;

  /** What the gradients were computed from, by the input's counters. */
  std::int64_t GradientsOfMesh = 0;
  std::int64_t GradientsOfScalars = 0;

  /** What the tables on the graphics device were made of, by counters. */
  std::int64_t UploadedLinks = 0;
  std::int64_t UploadedMesh = 0;
  std::int64_t UploadedScalars = 0;
  std::int64_t UploadedCellScalars = 0;
  std::int64_t UploadedGradients = 0;
  std::int64_t UploadedProperty = 0;
  /** The same of the native backend's. */
  std::int64_t NativeProperty = 0;

  vtkTypeInt64 GradientBuilds = 0;
  /** Seconds that the last frame would have taken with a ray per pixel; 0 before it. */
  double FullImageTime = 0.0;

  /** What was last said of data sets that are left out. */
  std::string ToldOfParts;
  bool WarnedIntegration = false;
  bool WarnedBlendMode = false;
  bool WarnedNative = false;
  bool WarnedCompute = false;
  bool WarnedTableSize = false;

  void UpdateGradients();
  std::string Upload(const meniscus::RayCastOptics& optics);
  void UpdateNative();
  std::string DrawOpenGL(const meniscus::RayCastFrame& frame);
  std::string DrawNative(const meniscus::RayCastFrame& frame);
  std::string ComputeFrame(
    vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], meniscus::OpticsPlace& place);
};

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::Upload(const meniscus::RayCastOptics& optics)
{
  meniscus::VolumeInput& input = this->Input;
  std::string error;
  const bool linksStale = this->UploadedLinks != input.GetLinkChanges();
  if (linksStale || !this->OpenGL.HasCells(optics.CompactCells))
  {
    error = this->OpenGL.UploadCells(input.GetMesh(), optics.CompactCells);
  }
  if (error.empty() && (linksStale || !this->OpenGL.HasBoundary()))
  {
    error = this->OpenGL.UploadBoundary(input.GetBoundaryTree());
  }
  if (linksStale || !error.empty())
  {
    this->UploadedLinks = error.empty() ? input.GetLinkChanges() : 0;
  }
  const bool ofCells = input.GetScalarPlace() == meniscus::ScalarPlace::Cells;
  const bool verticesStale = this->UploadedMesh != input.GetMeshBuilds() ||
    (!ofCells && this->UploadedScalars != input.GetScalarUpdates());
  if (error.empty() && (verticesStale || !this->OpenGL.HasVertices()))
  {
    error = this->OpenGL.UploadVertices(input.GetMesh(), input.GetScalars());
    this->UploadedMesh = error.empty() ? input.GetMeshBuilds() : 0;
    this->UploadedScalars = input.GetScalarUpdates();
  }
  const bool cellScalarsStale = this->UploadedCellScalars != input.GetScalarUpdates();
  if (error.empty() && ofCells && (cellScalarsStale || !this->OpenGL.HasCellScalars()))
  {
    error = this->OpenGL.UploadCellScalars(input.GetCellScalars());
    this->UploadedCellScalars = error.empty() ? input.GetScalarUpdates() : 0;
  }
  const bool gradientsStale = this->UploadedGradients != this->GradientBuilds;
  if (error.empty() && optics.VertexGradients && (gradientsStale || !this->OpenGL.HasGradients()))
  {
    error = this->OpenGL.UploadGradients(this->Gradients);
    this->UploadedGradients = error.empty() ? this->GradientBuilds : 0;
  }
  const bool propertyStale = this->UploadedProperty != this->Property.GetVersion();
  if (error.empty() && (propertyStale || !this->OpenGL.HasProperty()))
  {
    error = this->OpenGL.UploadProperty(this->Property);
    this->UploadedProperty = error.empty() ? this->Property.GetVersion() : 0;
  }
  return error;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::vtkInternals::UpdateGradients()
{
  const meniscus::VolumeInput& input = this->Input;
  if (this->GradientsOfMesh != input.GetMeshBuilds() ||
    this->GradientsOfScalars != input.GetScalarUpdates())
  {
    this->Gradients = meniscus::ComputeVertexGradients(input.GetMesh(), input.GetScalars());
    this->GradientsOfMesh = input.GetMeshBuilds();
    this->GradientsOfScalars = input.GetScalarUpdates();
    ++this->GradientBuilds;
  }
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::DrawOpenGL(
  const meniscus::RayCastFrame& frame)
{
  if (frame.Optics.VertexGradients)
  {
    this->UpdateGradients();
  }
  const std::string error = this->Upload(frame.Optics);
  return error.empty() ? this->OpenGL.Draw(frame) : error;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::vtkInternals::UpdateNative()
{
  if (this->NativeProperty != this->Property.GetVersion())
  {
    this->Native.UpdateProperty(this->Property);
    this->NativeProperty = this->Property.GetVersion();
  }
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::DrawNative(
  const meniscus::RayCastFrame& frame)
{
  this->UpdateNative();
  meniscus::TileCaster::Scene scene;
  scene.Mesh = &this->Input.GetMesh();
  scene.Boundary = &this->Input.GetMesh().GetBoundary();
  scene.CellScalars = frame.Optics.CellScalars ? this->Input.GetCellScalars().data() : nullptr;
  scene.Lighting = frame.Optics.Shading ? &frame.Optics.Lighting : nullptr;
  if (frame.Optics.VertexGradients)
  {
    this->UpdateGradients();
    scene.VertexGradients = this->Gradients.data();
    scene.GradientToFrame = frame.Optics.GradientToFrame;
  }
  // The numbers are the same.
  scene.Blending = static_cast<meniscus::PacketBlending>(frame.Optics.BlendMode);
  scene.ClippingPlanes = frame.Optics.ClippingPlanes;
  scene.TerminationTransmittance = static_cast<float>(1.0 - frame.EarlyTerminationOpacity);
  return this->OpenGL.DrawImageOf(
    [this, &scene, &frame](
      int width, int height, const std::vector<float>& depths, std::vector<float>& image)
    {
      scene.Rays = meniscus::PixelRays(frame.Rays, width, height);
      const meniscus::VertexVersion version{ this->Input.GetMeshBuilds(),
        this->Input.GetScalarUpdates() };
      return this->Native.Cast(scene, this->Input.GetScalars(), version, depths, image);
    },
    frame.Output);
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::ComputeFrame(
  vtkRenderer* renderer, vtkVolume* volume, const int imageSize[2], meniscus::OpticsPlace& place)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  meniscus::RayFrameInput input;
  input.ModelToWorld = ToGlm(volume->GetMatrix());
  input.WorldToView = ToGlm(camera->GetModelViewTransformMatrix());
  input.ViewToClip =
    ToGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  input.Center = this->Input.GetMesh().GetCenter();
  input.Radius = this->Input.GetMesh().GetRadius();
  input.ImageSize = glm::dvec2(imageSize[0], imageSize[1]);
  place.CenterInWorld = glm::dvec3(input.ModelToWorld * glm::dvec4(input.Center, 1.0));
  place.WorldToView = input.WorldToView;
  place.ScalarScale = this->Input.GetNormalization().Scale;
  switch (meniscus::ComputeRayFrame(input, place.Frame))
  {
    case meniscus::RayFrameStatus::Ok:
      return std::string();
    case meniscus::RayFrameStatus::Singular:
      return "the matrix of the volume or of the camera is singular or not finite";
    default:
      return "the camera's projection is not that of a plane image";
  }
}

vtkStandardNewMacro(vtkTetrahedraRayCastMapper);

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::vtkTetrahedraRayCastMapper()
  : MaximumTableSize(VTK_TYPE_INT64_MAX)
  , Internals(new vtkInternals)
{
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::~vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastMapper::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  for (const char* type : { "vtkDataSet", "vtkCompositeDataSet" })
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  return 1;
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
double* vtkTetrahedraRayCastMapper::GetBounds()
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(this->GetDataObjectInput());
  if (!composite)
  {
    return this->Superclass::GetBounds();
  }
  this->GetInputAlgorithm()->Update();
  composite = vtkCompositeDataSet::SafeDownCast(this->GetDataObjectInput());
  composite->GetBounds(this->Bounds);
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
bool vtkTetrahedraRayCastMapper::CollectInput(meniscus::InputParts& parts)
{
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->Update();
  }
  meniscus::InputReport report =
    meniscus::CollectInputParts(this->GetDataObjectInput(), this->SelectedScalars(), parts);
  // The same parts are left out again in every frame.
  const bool told = report.Warning == this->Internals->ToldOfParts;
  this->Internals->ToldOfParts = report.Warning;
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
  this->WarnOnce(this->Integration == PRE_INTEGRATED, internals.WarnedIntegration,
    "Pre-integration is not available; integrating exactly.");
  this->WarnOnce(this->GetUsedBlendMode() != this->BlendMode, internals.WarnedBlendMode,
    "There is no such blend mode for meshes; rendering with composite blending.");
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::UpdateInput(
  vtkRenderWindow* window, const meniscus::InputParts& parts)
{
  meniscus::VolumeInput& input = this->Internals->Input;
  this->SetAbortExecute(0);
  const auto goOn = [this, window](double fraction)
  {
    this->UpdateProgress(fraction);
    return !this->GetAbortExecute() && !window->CheckAbortStatus();
  };
  return this->Tell(input.UpdateMesh(parts, goOn)) && input.GetMesh().GetNumberOfCells() > 0 &&
    this->Tell(input.UpdateScalars(parts, this->SelectedScalars().Component));
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastMapper::GetUsedBlendMode()
{
  const bool known = this->BlendMode >= vtkVolumeMapper::COMPOSITE_BLEND &&
    this->BlendMode <= vtkVolumeMapper::ISOSURFACE_BLEND;
  return known ? this->BlendMode : vtkVolumeMapper::COMPOSITE_BLEND;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::UpdateTransferFunction(vtkVolume* volume)
{
  vtkInternals& internals = *this->Internals;
  internals.Property.Update(volume->GetProperty(), this->GetUsedBlendMode(),
    this->OpacityModel == OPACITY_PER_UNIT_DISTANCE, internals.Input.GetNormalization());
  using Jumps = meniscus::TetrahedralMesh::CellJumps;
  const bool isosurfaces = this->GetUsedBlendMode() == vtkVolumeMapper::ISOSURFACE_BLEND;
  internals.Input.UpdateActiveCells(
    internals.Property.GetVisibleScalars(), isosurfaces ? Jumps::Visible : Jumps::Hidden);
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastMapper::ChooseBackend(bool plainOptics)
{
  if (this->Backend == AUTOMATIC)
  {
    return plainOptics && this->Internals->OpenGL.IsSoftware() ? NATIVE : OPENGL;
  }
  const bool nativeLacks = this->Backend == NATIVE && !plainOptics;
  const bool computeLacks = this->Backend == COMPUTE && !this->Internals->OpenGL.HasCompute();
  this->WarnOnce(nativeLacks, this->Internals->WarnedNative,
    "The native backend has no gradient opacity and no shading but of isosurfaces; rendering with "
    "OpenGL.");
  this->WarnOnce(computeLacks, this->Internals->WarnedCompute,
    "The window has no OpenGL 4.3, which compute shaders need; rendering with fragment shaders.");
  return nativeLacks || computeLacks ? OPENGL : this->Backend;
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::FallsBackToNative(bool plainOptics, std::string& error)
{
  vtkInternals& internals = *this->Internals;
  error = internals.OpenGL.DescribeExcess(
    internals.Input.GetMesh(), this->CompactTables != 0, this->MaximumTableSize);
  if (error.empty() || !plainOptics)
  {
    return false;
  }
  this->WarnOnce(
    true, internals.WarnedTableSize, ("Rendering with the native backend: " + error + ".").c_str());
  error.clear();
  return true;
}

//------------------------------------------------------------------------------
double vtkTetrahedraRayCastMapper::ChooseImageSampleDistance(vtkVolume* volume)
{
  if (!this->AutoAdjustSampleDistances)
  {
    return this->ImageSampleDistance;
  }
  // Time goes with the number of rays, the inverse square of the distance.
  const double allocated = volume->GetAllocatedRenderTime();
  const double full = this->Internals->FullImageTime;
  const double distance = allocated > 0.0 && full > allocated ? std::sqrt(full / allocated) : 1.0;
  return std::min(distance, static_cast<double>(this->MaximumImageSampleDistance));
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::PrepareFrame(
  vtkRenderer* renderer, vtkVolume* volume, meniscus::RayCastFrame& frame)
{
  vtkInternals& internals = *this->Internals;
  vtkHardwareSelector* selector = renderer->GetSelector();
  const double sampleDistance = selector ? 1.0 : this->ChooseImageSampleDistance(volume);
  int viewport[4];
  internals.OpenGL.GetViewport(viewport);
  for (int i = 0; i < 2; ++i)
  {
    frame.Output.ImageSize[i] =
      std::max(1, static_cast<int>(std::ceil(viewport[2 + i] / sampleDistance)));
  }
  this->UsedImageSampleDistance = sampleDistance;
  if (selector)
  {
    // Other passes tell parts of a prop apart: this one has one part, of id 0.
    const bool propPass = selector->GetCurrentPass() == vtkHardwareSelector::ACTOR_PASS;
    const float* value = selector->GetPropColorValue();
    frame.Output.Selecting = true;
    frame.Output.SelectionValue =
      propPass ? glm::vec3(value[0], value[1], value[2]) : glm::vec3(0.0f);
  }

  meniscus::OpticsPlace place;
  const std::string error = internals.ComputeFrame(renderer, volume, frame.Output.ImageSize, place);
  if (!error.empty())
  {
    return error;
  }
  frame.Rays = place.Frame;
  frame.EarlyTerminationOpacity = this->EarlyTerminationOpacity;
  frame.Optics.BlendMode = this->GetUsedBlendMode();
  frame.Optics.CompactCells = this->CompactTables != 0;
  frame.Optics.CellScalars = internals.Input.GetScalarPlace() == meniscus::ScalarPlace::Cells;
  meniscus::GatherShading(volume->GetProperty(), renderer, place, frame.Optics);
  meniscus::GatherClippingPlanes(this->ClippingPlanes, place, frame.Optics);
  frame.Optics.VertexGradients = frame.Optics.UsesGradients() && !frame.Optics.CellScalars &&
    this->Gradients == VERTEX_GRADIENTS;
  return meniscus::DescribeExcess(frame.Optics);
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::Draw(vtkRenderer* renderer, vtkVolume* volume)
{
  vtkInternals& internals = *this->Internals;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    vtkErrorMacro("The renderer has no OpenGL window; nothing is rendered.");
    return false;
  }
  const meniscus::TetrahedralMesh& mesh = internals.Input.GetMesh();
  // A mesh without extent has no cell that a ray could cross.
  if (mesh.GetNumberOfActiveCells() == 0 || mesh.GetRadius() == 0.0)
  {
    internals.OpenGL.ClearStatistics();
    return true;
  }
  vtkOpenGLClearErrorMacro();
  meniscus::RayCastFrame frame;
  std::string error = internals.OpenGL.SetWindow(window);
  if (error.empty())
  {
    error = this->PrepareFrame(renderer, volume, frame);
  }
  int backend = OPENGL;
  if (error.empty())
  {
    backend = this->ChooseBackend(frame.Optics.IsPlain());
    if (backend != NATIVE && this->FallsBackToNative(frame.Optics.IsPlain(), error))
    {
      backend = NATIVE;
    }
  }
  if (error.empty())
  {
    frame.Compute = backend == COMPUTE;
    error = backend == NATIVE ? internals.DrawNative(frame) : internals.DrawOpenGL(frame);
  }
  if (!error.empty())
  {
    vtkErrorMacro("Nothing is rendered: " << error << ".");
    return false;
  }
  vtkOpenGLCheckErrorMacro("failed after Render");
  this->ActiveBackend = backend;
  return true;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  meniscus::InputParts parts;
  if (!this->CollectInput(parts) || parts.Parts.empty() ||
    !this->UpdateInput(renderer->GetRenderWindow(), parts))
  {
    return;
  }
  this->WarnAboutUnavailable();
  this->UpdateTransferFunction(volume);
  vtkHardwareSelector* selector = renderer->GetSelector();
  if (selector)
  {
    selector->BeginRenderProp();
    this->Draw(renderer, volume);
    selector->EndRenderProp();
    return;
  }
  const double start = vtkTimerLog::GetUniversalTime();
  if (this->Draw(renderer, volume))
  {
    // Drawing is over when the device says so, not when the commands are sent.
    this->Internals->OpenGL.Finish();
    this->TimeToDraw = std::max(vtkTimerLog::GetUniversalTime() - start, 1.0e-9);
    this->Internals->FullImageTime =
      this->TimeToDraw * this->UsedImageSampleDistance * this->UsedImageSampleDistance;
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internals->OpenGL.Release(window);
}

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
  return this->Internals->GradientBuilds;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfActiveSetBuilds()
{
  return this->Internals->Input.GetActiveSetBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetUploadedBytes()
{
  return this->Internals->OpenGL.GetUploadedBytes() + this->Internals->Native.GetTableBytes();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetHostBytes()
{
  const vtkInternals& internals = *this->Internals;
  const std::size_t gradients = internals.Gradients.size() * sizeof(glm::vec3);
  return internals.Input.GetBytes() + internals.Native.GetBytes() +
    static_cast<vtkTypeInt64>(gradients);
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetDeviceBytes()
{
  return this->Internals->OpenGL.GetTableBytes();
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
  os << indent << "Gradients: " << this->Gradients << "\n";
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
  os << indent << "NumberOfActiveSetBuilds: " << this->GetNumberOfActiveSetBuilds() << "\n";
  os << indent << "UploadedBytes: " << this->GetUploadedBytes() << "\n";
  os << indent << "CompactTables: " << this->CompactTables << "\n";
  os << indent << "MaximumTableSize: " << this->MaximumTableSize << "\n";
  os << indent << "HostBytes: " << this->GetHostBytes() << "\n";
  os << indent << "DeviceBytes: " << this->GetDeviceBytes() << "\n";
  os << indent << "NumberOfActiveCells: " << this->GetNumberOfActiveCells() << "\n";
  os << indent << "NumberOfTransparentCells: " << this->GetNumberOfTransparentCells() << "\n";
  os << indent << "NumberOfRejectedCells: " << this->GetNumberOfRejectedCells() << "\n";
}

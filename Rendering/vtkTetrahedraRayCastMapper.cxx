// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "RayCastOpenGL.h"
#include "Volume/RayFrame.h"
#include "Volume/TransferFunction.h"
#include "VolumeInput.h"
#include "VolumePropertyPoints.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPlaneCollection.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
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
  std::vector<meniscus::TransferFunctionPoint> Points;
  std::vector<meniscus::TransferFunctionInterval> Intervals;
  meniscus::RayCastOpenGL OpenGL;

  meniscus::ObjectVersion BuiltProperty;
  int BuiltOpacityModel = -1;
  meniscus::ScalarNormalization IntervalNormalization;
  bool IntervalsStale = true;

  /** What the tables on the graphics device were made of, by the input's counters. */
  std::int64_t UploadedLinks = 0;
  std::int64_t UploadedMesh = 0;
  std::int64_t UploadedScalars = 0;
  bool IntervalUploadStale = true;

  vtkTypeInt64 TransferFunctionBuilds = 0;

  bool WarnedIntegration = false;
  bool WarnedBlendMode = false;
  bool WarnedShading = false;
  bool WarnedClipping = false;

  void UpdateIntervals();
  void UpdateActiveCells();
  std::string Upload();
  std::string DrawOpenGL(const meniscus::RayFrame& frame, double terminationOpacity);
  std::string DrawNative(const meniscus::RayFrame& frame, double terminationOpacity);
  std::string ComputeFrame(
    vtkRenderer* renderer, vtkVolume* volume, const int viewport[4], meniscus::RayFrame& frame);
};

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::Upload()
{
  meniscus::VolumeInput& input = this->Input;
  std::string error;
  const bool linksStale = this->UploadedLinks != input.GetLinkChanges();
  if (linksStale || !this->OpenGL.HasCells() || !this->OpenGL.HasBoundary())
  {
    error = this->OpenGL.UploadCells(input.GetMesh());
    error = error.empty() ? this->OpenGL.UploadBoundary(input.GetBoundaryTree()) : error;
    this->UploadedLinks = error.empty() ? input.GetLinkChanges() : 0;
  }
  const bool verticesStale = this->UploadedMesh != input.GetMeshBuilds() ||
    this->UploadedScalars != input.GetScalarUpdates();
  if (error.empty() && (verticesStale || !this->OpenGL.HasVertices()))
  {
    error = this->OpenGL.UploadVertices(input.GetMesh(), input.GetScalars());
    this->UploadedMesh = error.empty() ? input.GetMeshBuilds() : 0;
    this->UploadedScalars = input.GetScalarUpdates();
  }
  if (error.empty() && (this->IntervalUploadStale || !this->OpenGL.HasIntervals()))
  {
    error = this->OpenGL.UploadIntervals(this->Intervals);
    this->IntervalUploadStale = !error.empty();
  }
  return error;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::vtkInternals::UpdateIntervals()
{
  const meniscus::ScalarNormalization& normalization = this->Input.GetNormalization();
  if (this->IntervalsStale || normalization != this->IntervalNormalization)
  {
    this->Intervals = meniscus::BuildIntervals(this->Points, normalization);
    this->IntervalNormalization = normalization;
    this->IntervalsStale = false;
    this->IntervalUploadStale = true;
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::vtkInternals::UpdateActiveCells()
{
  meniscus::VisibleScalars visible;
  visible.AddAttenuation(this->Intervals);
  this->Input.UpdateActiveCells(visible);
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::DrawOpenGL(
  const meniscus::RayFrame& frame, double terminationOpacity)
{
  const std::string error = this->Upload();
  return error.empty() ? this->OpenGL.Draw({ frame, terminationOpacity }) : error;
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::DrawNative(
  const meniscus::RayFrame& frame, double terminationOpacity)
{
  return this->OpenGL.DrawNative(
    { &this->Input.GetMesh(), &this->Input.GetBoundaryTree(), &this->Input.GetScalars(),
      &this->Intervals, frame, static_cast<float>(1.0 - terminationOpacity) });
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::ComputeFrame(
  vtkRenderer* renderer, vtkVolume* volume, const int viewport[4], meniscus::RayFrame& frame)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  meniscus::RayFrameInput input;
  input.ModelToWorld = ToGlm(volume->GetMatrix());
  input.WorldToView = ToGlm(camera->GetModelViewTransformMatrix());
  input.ViewToClip =
    ToGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  input.Center = this->Input.GetMesh().GetCenter();
  input.Radius = this->Input.GetMesh().GetRadius();
  input.ImageSize = glm::dvec2(viewport[2], viewport[3]);
  switch (meniscus::ComputeRayFrame(input, frame))
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
  : Internals(new vtkInternals)
{
}

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper::~vtkTetrahedraRayCastMapper() = default;

//------------------------------------------------------------------------------
vtkUnstructuredGrid* vtkTetrahedraRayCastMapper::ValidateInput()
{
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->Update();
  }
  vtkUnstructuredGridBase* input = this->GetInput();
  if (!input)
  {
    vtkErrorMacro("No input; nothing is rendered.");
    return nullptr;
  }
  vtkUnstructuredGrid* grid = vtkUnstructuredGrid::SafeDownCast(input);
  if (!grid)
  {
    vtkErrorMacro("The input is a " << input->GetClassName()
                                    << ", not a vtkUnstructuredGrid; nothing is rendered.");
  }
  return grid;
}

//------------------------------------------------------------------------------
vtkDataArray* vtkTetrahedraRayCastMapper::ValidateScalars(vtkUnstructuredGrid* grid)
{
  int cellFlag = 0;
  vtkDataArray* scalars = vtkAbstractMapper::GetScalars(
    grid, this->ScalarMode, this->ArrayAccessMode, this->ArrayId, this->ArrayName, cellFlag);
  if (!scalars)
  {
    const bool byName = this->ArrayAccessMode == VTK_GET_ARRAY_BY_NAME && this->ArrayName;
    vtkErrorMacro("The input has no scalar array"
      << (byName ? std::string(" named '") + this->ArrayName + "'" : std::string())
      << "; nothing is rendered.");
    return nullptr;
  }
  const std::string name = scalars->GetName() ? scalars->GetName() : "without a name";
  if (cellFlag != 0)
  {
    vtkErrorMacro("The array '" << name
                                << "' is cell or field data; point data is needed (see "
                                   "vtkCellDataToPointData). Nothing is rendered.");
    return nullptr;
  }
  const int components = scalars->GetNumberOfComponents();
  if (this->VectorMode == DISABLED && components != 1)
  {
    vtkErrorMacro(
      "The array '" << name << "' has " << components
                    << " components; 1 is needed, or a VectorMode. Nothing is rendered.");
    return nullptr;
  }
  if (this->VectorMode == COMPONENT && this->VectorComponent >= components)
  {
    vtkErrorMacro("The array '" << name << "' has " << components << " components, none of number "
                                << this->VectorComponent << ". Nothing is rendered.");
    return nullptr;
  }
  if (scalars->GetNumberOfTuples() != grid->GetNumberOfPoints())
  {
    vtkErrorMacro("The array '" << name << "' has " << scalars->GetNumberOfTuples()
                                << " values for " << grid->GetNumberOfPoints()
                                << " points; nothing is rendered.");
    return nullptr;
  }
  return scalars;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::WarnAboutUnavailable(vtkVolume* volume)
{
  const auto warnOnce = [this](bool condition, bool& warned, const char* text)
  {
    if (condition && !warned)
    {
      warned = true;
      vtkWarningMacro(<< text);
    }
  };
  vtkInternals& internals = *this->Internals;
  warnOnce(this->Integration == PRE_INTEGRATED, internals.WarnedIntegration,
    "Pre-integration is not available; integrating exactly.");
  warnOnce(this->BlendMode != COMPOSITE_BLEND, internals.WarnedBlendMode,
    "This blend mode is not available; rendering with composite blending.");
  vtkVolumeProperty* property = volume->GetProperty();
  warnOnce(property->GetShade() != 0 || property->HasGradientOpacity(), internals.WarnedShading,
    "Shading and gradient opacity are not available; rendering without.");
  warnOnce(this->ClippingPlanes && this->ClippingPlanes->GetNumberOfItems() > 0,
    internals.WarnedClipping, "Clipping planes are not available; rendering without.");
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::UpdateInput(
  vtkRenderWindow* window, vtkUnstructuredGrid* grid, vtkDataArray* scalars)
{
  meniscus::VolumeInput& input = this->Internals->Input;
  const auto tell = [this](const meniscus::InputReport& report)
  {
    if (!report.Error.empty())
    {
      vtkErrorMacro(<< report.Error << " Nothing is rendered.");
    }
    if (!report.Warning.empty())
    {
      vtkWarningMacro(<< report.Warning);
    }
    return report.Error.empty();
  };
  const int component = this->VectorMode == MAGNITUDE
    ? meniscus::VolumeInput::Magnitude
    : (this->VectorMode == COMPONENT ? this->VectorComponent : 0);
  this->SetAbortExecute(0);
  const auto goOn = [this, window](double fraction)
  {
    this->UpdateProgress(fraction);
    return !this->GetAbortExecute() && !window->CheckAbortStatus();
  };
  return tell(input.UpdateMesh(grid, goOn)) && input.GetMesh().GetNumberOfCells() > 0 &&
    tell(input.UpdateScalars(scalars, component));
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::UpdateTransferFunction(vtkVolume* volume)
{
  vtkInternals& internals = *this->Internals;
  vtkVolumeProperty* property = volume->GetProperty();
  // A property without functions makes default ones when asked: ask before taking its time.
  property->GetScalarOpacity(0);
  if (property->GetColorChannels(0) == 1)
  {
    property->GetGrayTransferFunction(0);
  }
  else
  {
    property->GetRGBTransferFunction(0);
  }
  const meniscus::ObjectVersion version(property);
  if (version == internals.BuiltProperty && internals.BuiltOpacityModel == this->OpacityModel)
  {
    return;
  }
  internals.Points =
    meniscus::ReducePropertyToPoints(property, this->OpacityModel == OPACITY_PER_UNIT_DISTANCE);
  internals.BuiltProperty = version;
  internals.BuiltOpacityModel = this->OpacityModel;
  internals.IntervalsStale = true;
  ++internals.TransferFunctionBuilds;
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
  const int backend = this->Backend == NATIVE ? NATIVE : OPENGL;
  const meniscus::TetrahedralMesh& mesh = internals.Input.GetMesh();
  // A mesh without extent has no cell that a ray could cross.
  if (mesh.GetNumberOfActiveCells() == 0 || mesh.GetRadius() == 0.0)
  {
    internals.OpenGL.ClearStatistics();
    this->ActiveBackend = backend;
    return true;
  }
  vtkOpenGLClearErrorMacro();
  meniscus::RayFrame frame;
  std::string error = internals.OpenGL.SetWindow(window);
  if (error.empty())
  {
    int viewport[4];
    internals.OpenGL.GetViewport(viewport);
    error = internals.ComputeFrame(renderer, volume, viewport, frame);
  }
  if (error.empty())
  {
    error = backend == NATIVE ? internals.DrawNative(frame, this->EarlyTerminationOpacity)
                              : internals.DrawOpenGL(frame, this->EarlyTerminationOpacity);
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
  if (renderer->GetSelector())
  {
    return;
  }
  const double start = vtkTimerLog::GetUniversalTime();
  vtkUnstructuredGrid* grid = this->ValidateInput();
  if (!grid || grid->GetNumberOfCells() == 0)
  {
    return;
  }
  vtkDataArray* scalars = this->ValidateScalars(grid);
  if (!scalars || !this->UpdateInput(renderer->GetRenderWindow(), grid, scalars))
  {
    return;
  }
  this->WarnAboutUnavailable(volume);
  this->UpdateTransferFunction(volume);
  this->Internals->UpdateIntervals();
  this->Internals->UpdateActiveCells();
  if (this->Draw(renderer, volume))
  {
    this->TimeToDraw = std::max(vtkTimerLog::GetUniversalTime() - start, 1.0e-9);
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
  return this->Internals->TransferFunctionBuilds;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfActiveSetBuilds()
{
  return this->Internals->Input.GetActiveSetBuilds();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetUploadedBytes()
{
  return this->Internals->OpenGL.GetUploadedBytes();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfActiveCells()
{
  return this->Internals->Input.GetMesh().GetNumberOfActiveCells();
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
  os << indent << "EarlyTerminationOpacity: " << this->EarlyTerminationOpacity << "\n";
  os << indent << "NumberOfMeshBuilds: " << this->GetNumberOfMeshBuilds() << "\n";
  os << indent << "NumberOfScalarUpdates: " << this->GetNumberOfScalarUpdates() << "\n";
  os << indent << "NumberOfTransferFunctionBuilds: " << this->GetNumberOfTransferFunctionBuilds()
     << "\n";
  os << indent << "NumberOfActiveSetBuilds: " << this->GetNumberOfActiveSetBuilds() << "\n";
  os << indent << "UploadedBytes: " << this->GetUploadedBytes() << "\n";
  os << indent << "NumberOfActiveCells: " << this->GetNumberOfActiveCells() << "\n";
  os << indent << "NumberOfRejectedCells: " << this->GetNumberOfRejectedCells() << "\n";
}

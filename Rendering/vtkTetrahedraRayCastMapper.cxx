// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "ObjectVersion.h"
#include "RayCastOpenGL.h"
#include "RayCastOptics.h"
#include "RayCastShader.h"
#include "Volume/BoundaryTree.h"
#include "Volume/RayFrame.h"
#include "Volume/TetrahedralMesh.h"
#include "Volume/TransferFunction.h"
#include "Volume/VertexGradients.h"
#include "VolumePropertyTables.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCellTypes.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPlaneCollection.h"
#include "vtkPoints.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using Version = meniscus::ObjectVersion;

/** What the mesh tables were built from. Another grid that shares these objects has the same mesh.
 */
struct MeshVersion
{
  Version Points;
  Version Coordinates;
  Version Cells;
  Version Ghosts;

  bool operator==(const MeshVersion& other) const
  {
    return this->Points == other.Points && this->Coordinates == other.Coordinates &&
      this->Cells == other.Cells && this->Ghosts == other.Ghosts;
  }
};

/** Cell types other than tetrahedra with their numbers, as text; empty if there are none. */
std::string DescribeOtherCells(vtkUnstructuredGrid* grid)
{
  std::map<int, vtkIdType> others;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const int type = grid->GetCellType(c);
    if (type != VTK_TETRA)
    {
      ++others[type];
    }
  }
  std::ostringstream text;
  for (const auto& other : others)
  {
    const char* name = vtkCellTypes::GetClassNameFromTypeId(other.first);
    text << (text.tellp() > 0 ? ", " : "") << other.second << " " << (name ? name : "unknown");
  }
  return text.str();
}

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

/** Points and tetrahedra of a grid as plain arrays. */
struct GridArrays
{
  std::vector<double> Points;
  std::vector<std::int64_t> Cells;

  explicit GridArrays(vtkUnstructuredGrid* grid)
    : Points(3 * static_cast<std::size_t>(grid->GetNumberOfPoints()))
  {
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      grid->GetPoint(p, this->Points.data() + 3 * p);
    }
    vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
    const unsigned char leftOut =
      vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    this->Cells.reserve(4 * static_cast<std::size_t>(grid->GetNumberOfCells()));
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      if (ghosts && (ghosts->GetValue(c) & leftOut))
      {
        continue;
      }
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      grid->GetCells()->GetCellAtId(c, size, ids);
      this->Cells.insert(this->Cells.end(), ids, ids + 4);
    }
  }
};

}

class vtkTetrahedraRayCastMapper::vtkInternals
{
public:
  meniscus::TetrahedralMesh Mesh;
  meniscus::BoundaryTree Tree;
  std::vector<float> Scalars;
  meniscus::ScalarNormalization Normalization;
  std::vector<glm::vec3> Gradients;
  meniscus::VolumePropertyTables Property;
  meniscus::RayCastOpenGL OpenGL;

  MeshVersion BuiltMesh;
  Version BuiltScalars;

  bool MeshUploadStale = true;
  bool VertexUploadStale = true;
  bool GradientsStale = true;
  bool GradientUploadStale = true;
  vtkTypeInt64 UploadedProperty = -1;

  vtkTypeInt64 MeshBuilds = 0;
  vtkTypeInt64 ScalarUpdates = 0;
  vtkTypeInt64 GradientBuilds = 0;

  bool WarnedIntegration = false;
  bool WarnedBlendMode = false;
  bool WarnedNative = false;

  void UpdateGradients();
  std::string Upload(bool gradients);
  std::string DrawOpenGL(const meniscus::RayCastFrame& frame);
  std::string DrawNative(const meniscus::RayCastFrame& frame);
  std::string ComputeFrame(
    vtkRenderer* renderer, vtkVolume* volume, const int viewport[4], meniscus::OpticsPlace& place);
};

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::Upload(bool gradients)
{
  std::string error;
  if (this->MeshUploadStale || !this->OpenGL.HasMesh())
  {
    error = this->OpenGL.UploadMesh(this->Mesh, this->Tree);
    this->MeshUploadStale = !error.empty();
  }
  if (error.empty() && (this->VertexUploadStale || !this->OpenGL.HasVertices()))
  {
    error = this->OpenGL.UploadVertices(this->Mesh, this->Scalars);
    this->VertexUploadStale = !error.empty();
  }
  if (error.empty() && gradients && (this->GradientUploadStale || !this->OpenGL.HasGradients()))
  {
    error = this->OpenGL.UploadGradients(this->Gradients);
    this->GradientUploadStale = !error.empty();
  }
  if (error.empty() &&
    (this->UploadedProperty != this->Property.GetVersion() || !this->OpenGL.HasProperty()))
  {
    error = this->OpenGL.UploadProperty(this->Property);
    this->UploadedProperty = error.empty() ? this->Property.GetVersion() : -1;
  }
  return error;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::vtkInternals::UpdateGradients()
{
  if (this->GradientsStale)
  {
    this->Gradients = meniscus::ComputeVertexGradients(this->Mesh, this->Scalars);
    this->GradientsStale = false;
    this->GradientUploadStale = true;
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
  const std::string error = this->Upload(frame.Optics.VertexGradients);
  return error.empty() ? this->OpenGL.Draw(frame) : error;
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::DrawNative(
  const meniscus::RayCastFrame& frame)
{
  return this->OpenGL.DrawNative(
    { &this->Mesh, &this->Tree, &this->Scalars, &this->Property.GetIntervals(), frame.Rays,
      static_cast<float>(1.0 - frame.EarlyTerminationOpacity) });
}

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::ComputeFrame(
  vtkRenderer* renderer, vtkVolume* volume, const int viewport[4], meniscus::OpticsPlace& place)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  meniscus::RayFrameInput input;
  input.ModelToWorld = ToGlm(volume->GetMatrix());
  input.WorldToView = ToGlm(camera->GetModelViewTransformMatrix());
  input.ViewToClip =
    ToGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  input.Center = this->Mesh.GetCenter();
  input.Radius = this->Mesh.GetRadius();
  input.ImageSize = glm::dvec2(viewport[2], viewport[3]);
  place.CenterInWorld = glm::dvec3(input.ModelToWorld * glm::dvec4(input.Center, 1.0));
  place.WorldToView = input.WorldToView;
  place.ScalarScale = this->Normalization.Scale;
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
  if (scalars->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("The array '" << name << "' has " << scalars->GetNumberOfComponents()
                                << " components; 1 is needed. Nothing is rendered.");
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
void vtkTetrahedraRayCastMapper::WarnAboutUnavailable()
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
  warnOnce(this->GetUsedBlendMode() != this->BlendMode, internals.WarnedBlendMode,
    "There is no such blend mode for meshes; rendering with composite blending.");
}

//------------------------------------------------------------------------------
bool vtkTetrahedraRayCastMapper::UpdateMesh(vtkUnstructuredGrid* grid)
{
  vtkInternals& internals = *this->Internals;
  MeshVersion version;
  version.Points = Version(grid->GetPoints());
  version.Coordinates = Version(grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr);
  version.Cells = Version(grid->GetCells());
  version.Ghosts = Version(grid->GetCellGhostArray());
  if (internals.MeshBuilds > 0 && version == internals.BuiltMesh)
  {
    return internals.Mesh.GetNumberOfCells() > 0;
  }

  const std::string others = DescribeOtherCells(grid);
  if (!others.empty())
  {
    vtkErrorMacro("Only tetrahedra can be rendered, the input also has "
      << others << ". Put a vtkDataSetTriangleFilter with TetrahedraOnlyOn before the mapper. "
      << "Nothing is rendered.");
    return false;
  }
  const GridArrays arrays(grid);
  const meniscus::TetrahedraView view{ arrays.Points.data(), grid->GetNumberOfPoints(),
    arrays.Cells.data(), static_cast<std::int64_t>(arrays.Cells.size() / 4) };
  const meniscus::MeshStatus status = internals.Mesh.Build(view);
  internals.Tree.Build(internals.Mesh);
  internals.BuiltMesh = version;
  internals.BuiltScalars = Version();
  internals.MeshUploadStale = true;
  ++internals.MeshBuilds;

  if (status == meniscus::MeshStatus::TooLarge)
  {
    vtkErrorMacro("A mesh of " << view.NumberOfCells << " cells and " << view.NumberOfPoints
                               << " points exceeds the limit of "
                               << meniscus::TetrahedralMesh::MaximumNumberOfCells
                               << " cells and 2^31 points. Nothing is rendered.");
    return false;
  }
  const meniscus::RejectedCells& rejected = internals.Mesh.GetRejectedCells();
  if (rejected.Total() > 0)
  {
    vtkWarningMacro(<< rejected.Total() << " of " << view.NumberOfCells << " cells are left out: "
                    << rejected.IndexOutOfRange << " with a point index out of range, "
                    << rejected.RepeatedVertex << " with a repeated point, "
                    << rejected.PointNotFinite << " with a point that is not finite.");
  }
  return status == meniscus::MeshStatus::Ok;
}

//------------------------------------------------------------------------------
void vtkTetrahedraRayCastMapper::UpdateScalars(vtkDataArray* scalars)
{
  vtkInternals& internals = *this->Internals;
  const Version version(scalars);
  if (version == internals.BuiltScalars)
  {
    return;
  }
  const std::vector<std::int64_t>& points = internals.Mesh.GetSourcePoints();
  std::vector<double> values(points.size());
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -minimum;
  vtkTypeInt64 notFinite = 0;
  for (std::size_t v = 0; v < points.size(); ++v)
  {
    values[v] = scalars->GetComponent(points[v], 0);
    if (std::isfinite(values[v]))
    {
      minimum = std::min(minimum, values[v]);
      maximum = std::max(maximum, values[v]);
    }
    else
    {
      values[v] = std::numeric_limits<double>::quiet_NaN();
      ++notFinite;
    }
  }
  if (notFinite > 0)
  {
    vtkWarningMacro(<< notFinite << " of " << values.size()
                    << " scalars are not finite; cells that use them are transparent.");
  }

  const auto normalization = notFinite == static_cast<vtkTypeInt64>(values.size())
    ? meniscus::ScalarNormalization()
    : meniscus::NormalizeRange(minimum, maximum);
  internals.Normalization = normalization;
  internals.Scalars.resize(values.size());
  std::transform(values.begin(), values.end(), internals.Scalars.begin(),
    [&normalization](double value)
    { return static_cast<float>((value - normalization.Offset) * normalization.Scale); });
  internals.BuiltScalars = version;
  internals.VertexUploadStale = true;
  internals.GradientsStale = true;
  ++internals.ScalarUpdates;
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
    this->OpacityModel == OPACITY_PER_UNIT_DISTANCE, internals.Normalization);
}

//------------------------------------------------------------------------------
int vtkTetrahedraRayCastMapper::ChooseBackend(bool plainOptics)
{
  bool& warned = this->Internals->WarnedNative;
  if (this->Backend == NATIVE && !plainOptics && !warned)
  {
    warned = true;
    vtkWarningMacro("The native backend has composite blending only, without shading, gradient "
                    "opacity and clipping planes; rendering with OpenGL.");
  }
  return this->Backend == NATIVE && plainOptics ? NATIVE : OPENGL;
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
  vtkOpenGLClearErrorMacro();
  meniscus::OpticsPlace place;
  meniscus::RayCastFrame frame;
  std::string error = internals.OpenGL.SetWindow(window);
  if (error.empty())
  {
    int viewport[4];
    internals.OpenGL.GetViewport(viewport);
    error = internals.ComputeFrame(renderer, volume, viewport, place);
  }
  int backend = OPENGL;
  if (error.empty())
  {
    frame.Rays = place.Frame;
    frame.EarlyTerminationOpacity = this->EarlyTerminationOpacity;
    frame.Optics.BlendMode = this->GetUsedBlendMode();
    meniscus::GatherShading(volume->GetProperty(), renderer, place, frame.Optics);
    meniscus::GatherClippingPlanes(this->ClippingPlanes, place, frame.Optics);
    frame.Optics.VertexGradients =
      frame.Optics.UsesGradients() && this->Gradients == VERTEX_GRADIENTS;
    error = meniscus::DescribeExcess(frame.Optics);
  }
  if (error.empty())
  {
    backend = this->ChooseBackend(frame.Optics.IsPlain());
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
  if (!scalars || !this->UpdateMesh(grid))
  {
    return;
  }
  this->WarnAboutUnavailable();
  this->UpdateScalars(scalars);
  this->UpdateTransferFunction(volume);
  // A mesh without extent has no cell that a ray could cross.
  if (this->Internals->Mesh.GetRadius() > 0.0 && this->Draw(renderer, volume))
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
  return this->Internals->MeshBuilds;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfScalarUpdates()
{
  return this->Internals->ScalarUpdates;
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
  return this->Internals->MeshBuilds;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetUploadedBytes()
{
  return this->Internals->OpenGL.GetUploadedBytes();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfActiveCells()
{
  return this->Internals->Mesh.GetNumberOfCells();
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkTetrahedraRayCastMapper::GetNumberOfRejectedCells()
{
  return this->Internals->Mesh.GetRejectedCells().Total();
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
  os << indent << "OpacityModel: " << this->OpacityModel << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "ActiveBackend: " << this->ActiveBackend << "\n";
  os << indent << "Integration: " << this->Integration << "\n";
  os << indent << "Gradients: " << this->Gradients << "\n";
  os << indent << "EarlyTerminationOpacity: " << this->EarlyTerminationOpacity << "\n";
  os << indent << "NumberOfMeshBuilds: " << this->GetNumberOfMeshBuilds() << "\n";
  os << indent << "NumberOfScalarUpdates: " << this->GetNumberOfScalarUpdates() << "\n";
  os << indent << "NumberOfTransferFunctionBuilds: " << this->GetNumberOfTransferFunctionBuilds()
     << "\n";
  os << indent << "NumberOfGradientBuilds: " << this->GetNumberOfGradientBuilds() << "\n";
  os << indent << "NumberOfActiveSetBuilds: " << this->GetNumberOfActiveSetBuilds() << "\n";
  os << indent << "UploadedBytes: " << this->GetUploadedBytes() << "\n";
  os << indent << "NumberOfActiveCells: " << this->GetNumberOfActiveCells() << "\n";
  os << indent << "NumberOfRejectedCells: " << this->GetNumberOfRejectedCells() << "\n";
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayCastMapper.h"

#include "RayCastNative.h"
#include "RayCastOpenGL.h"
#include "Volume/BoundaryTree.h"
#include "Volume/RayFrame.h"
#include "Volume/TetrahedralMesh.h"
#include "Volume/TransferFunction.h"
#include "VolumePropertyPoints.h"

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

/** An object and its modification time: equal as long as it is the same object, unmodified. */
struct Version
{
  const vtkObject* Object = nullptr;
  vtkMTimeType Time = 0;

  Version() = default;
  explicit Version(vtkObject* object)
    : Object(object)
    , Time(object ? object->GetMTime() : 0)
  {
  }
  bool operator==(const Version& other) const
  {
    return this->Object == other.Object && this->Time == other.Time;
  }
};

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
  std::vector<meniscus::TransferFunctionPoint> Points;
  std::vector<meniscus::TransferFunctionInterval> Intervals;
  meniscus::RayCastOpenGL OpenGL;
  meniscus::RayCastNative Native;

  MeshVersion BuiltMesh;
  Version BuiltScalars;
  Version BuiltProperty;
  int BuiltOpacityModel = -1;

  bool MeshUploadStale = true;
  bool VertexUploadStale = true;
  bool IntervalUploadStale = true;
  bool IntervalsStale = true;

  vtkTypeInt64 MeshBuilds = 0;
  vtkTypeInt64 ScalarUpdates = 0;
  vtkTypeInt64 TransferFunctionBuilds = 0;

  bool WarnedIntegration = false;
  bool WarnedBlendMode = false;
  bool WarnedShading = false;
  bool WarnedClipping = false;

  void UpdateIntervals();
  std::string Upload();
  std::string DrawOpenGL(const meniscus::RayFrame& frame, double terminationOpacity);
  std::string DrawNative(const meniscus::RayFrame& frame, double terminationOpacity);
  std::string ComputeFrame(
    vtkRenderer* renderer, vtkVolume* volume, const int viewport[4], meniscus::RayFrame& frame);
};

//------------------------------------------------------------------------------
std::string vtkTetrahedraRayCastMapper::vtkInternals::Upload()
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
  if (this->IntervalsStale)
  {
    this->Intervals = meniscus::BuildIntervals(this->Points, this->Normalization);
    this->IntervalsStale = false;
    this->IntervalUploadStale = true;
    this->Native.InvalidateIntervals();
  }
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
  if (!this->Native.HasVertices())
  {
    this->Native.UpdateVertices(this->Mesh, this->Scalars);
  }
  if (!this->Native.HasIntervals())
  {
    this->Native.UpdateIntervals(this->Intervals);
  }
  meniscus::TileCaster::Scene scene;
  scene.Mesh = &this->Mesh;
  scene.Boundary = &this->Mesh.GetBoundary();
  scene.Frame = frame;
  scene.TerminationTransmittance = static_cast<float>(1.0 - terminationOpacity);
  return this->OpenGL.DrawImageOf(
    [this, &scene](
      int width, int height, const std::vector<float>& depths, std::vector<float>& image)
    {
      scene.Width = width;
      scene.Height = height;
      return this->Native.Cast(scene, depths, image);
    });
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
  input.Center = this->Mesh.GetCenter();
  input.Radius = this->Mesh.GetRadius();
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
  internals.IntervalsStale = internals.IntervalsStale ||
    normalization.Offset != internals.Normalization.Offset ||
    normalization.Scale != internals.Normalization.Scale;
  internals.Normalization = normalization;
  internals.Scalars.resize(values.size());
  std::transform(values.begin(), values.end(), internals.Scalars.begin(),
    [&normalization](double value)
    { return static_cast<float>((value - normalization.Offset) * normalization.Scale); });
  internals.BuiltScalars = version;
  internals.VertexUploadStale = true;
  internals.Native.InvalidateVertices();
  ++internals.ScalarUpdates;
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
  const Version version(property);
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
  vtkOpenGLClearErrorMacro();
  internals.UpdateIntervals();
  const int backend = this->Backend == NATIVE ? NATIVE : OPENGL;
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
  if (!scalars || !this->UpdateMesh(grid))
  {
    return;
  }
  this->WarnAboutUnavailable(volume);
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
  return this->Internals->TransferFunctionBuilds;
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

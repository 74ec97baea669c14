// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StressCasters.h"

#include "Simd/InstructionSets.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Optics/VisibleScalars.h"
#include "Volume/Rays/PlacedVertices.h"
#include "Volume/Rays/RayFrame.h"
#include "Volume/Rays/RayPivot.h"

#include <vtkLogger.h>
#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
{

namespace
{

/** Input of ComputeRayFrame except for the mesh's centre and radius. */
RayFrameInput FrameInput(const VolumeView& view, int size)
{
  RayFrameInput input;
  input.WorldToView = glm::lookAt(view.Eye, view.Focus, view.Up);
  const double h = view.HalfHeight;
  input.ViewToClip = view.Parallel ? glm::ortho(-h, h, -h, h, view.Near, view.Far)
                                   : glm::frustum(-h * view.Near, h * view.Near, -h * view.Near,
                                       h * view.Near, view.Near, view.Far);
  input.ImageSize = glm::dvec2(size);
  return input;
}

/** The kernel alone, without VTK's pipeline and without a window. */
class KernelCaster : public StressCaster
{
public:
  void Take(const StressCase& stress) override
  {
    this->Size = stress.Size;
    BuildKernelMesh(stress.Mesh, this->Mesh);
    vtkDataArray* scalars = stress.Mesh->GetPointData()->GetScalars();
    double range[2];
    scalars->GetFiniteRange(range);
    const ScalarNormalization normalization = NormalizeRange(range[0], range[1]);
    this->Scalars.clear();
    for (const std::int64_t point : this->Mesh.GetSourcePoints())
    {
      const double scalar = scalars->GetComponent(point, 0);
      this->Scalars.push_back(
        static_cast<float>((scalar - normalization.Offset) * normalization.Scale));
    }
    std::vector<TransferFunctionPoint> points;
    for (const auto& node : stress.Function)
    {
      const auto& c = node.Value.Color;
      points.push_back({ node.Scalar, node.Value.Attenuation, { c[0], c[1], c[2] } });
    }
    this->Intervals = BuildIntervals(points, normalization);
    VisibleScalars visible;
    visible.AddAttenuation(this->Intervals);
    this->Mesh.UpdateActiveCells(this->Scalars, visible);
    this->Passages = FindPassages(this->Mesh);
    this->Tables.Intervals = PackIntervals(this->Intervals);
  }

  StressImage Cast(const VolumeView& view) override
  {
    StressImage result;
    result.Image.Width = result.Image.Height = this->Size;
    result.Image.Rgba.assign(std::size_t{ 4 } * this->Size * this->Size, 0.0f);
    TileCaster::Scene scene;
    scene.Mesh = &this->Mesh;
    scene.Passages = &this->Passages;
    scene.Boundary = &this->Mesh.GetBoundary();
    scene.Tables = &this->Tables;
    scene.TerminationTransmittance = Transmittance;
    scene.Set = BestInstructionSet();
    RayFrameInput input = FrameInput(view, this->Size);
    input.Center = this->Mesh.GetCenter();
    input.Radius = this->Mesh.GetRadius();
    input.SmallestCell = this->Mesh.GetSmallestCell();
    RayFrame frame;
    if (this->Mesh.GetNumberOfCells() == 0 || this->Mesh.GetRadius() == 0.0 ||
      ComputeRayFrame(input, frame) != RayFrameStatus::Ok)
    {
      return result;
    }
    scene.Rays = FixedPointRays(
      frame, this->Size, this->Size, FindPivot(frame, this->Size, this->Size, *scene.Mesh));
    PlaceVertices(this->Mesh, this->Scalars, scene.Rays, SerialLoop, this->Tables.Vertices);
    const TileCaster caster(scene);
    TileCaster::Workspace workspace;
    const std::vector<float> farPlane(std::size_t(this->Size) * this->Size, 1.0f);
    for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
    {
      const RayStatistics sums =
        caster.Cast(tile, farPlane.data(), result.Image.Rgba.data(), workspace);
      result.Steps += sums.Steps;
      result.Rays += sums.Rays;
      result.Lost += sums.Lost;
    }
    return result;
  }

private:
  // The mapper's default.
  static constexpr float Transmittance = 1.0f / 131072.0f;

  int Size = 0;
  TetrahedralMesh Mesh;
  std::vector<CellPassages> Passages;
  PacketTables Tables;
  std::vector<float> Scalars;
  std::vector<TransferFunctionInterval> Intervals;
};

/** The mapper in an off-screen window, read back in float. */
class MapperCaster : public StressCaster
{
public:
  explicit MapperCaster(int backend)
    : Scene(8, 8)
  {
    // Soups cause a warning of the mapper for every mesh.
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_ERROR);
    this->Mapper->SetBackend(backend);
    this->Scene.SetMapper(this->Mapper);
  }

  void Take(const StressCase& stress) override
  {
    this->Mapper->SetInputDataObject(stress.Mesh);
    this->Scene.SetProperty(ToProperty(stress.Function));
    this->Scene.GetWindow()->SetSize(stress.Size, stress.Size);
  }

  StressImage Cast(const VolumeView& view) override
  {
    view.ApplyTo(this->Scene.GetRenderer());
    StressImage result;
    result.Image = this->Scene.RenderFloat();
    result.Steps = this->Mapper->GetNumberOfTraversalSteps();
    result.Rays = this->Mapper->GetNumberOfRays();
    result.Lost = this->Mapper->GetNumberOfLostRays();
    return result;
  }

private:
  DisplayHold Hold;
  VolumeScene Scene;
  vtkNew<vtkTetrahedraRayCastMapper> Mapper;
};

} // anonymous namespace

//------------------------------------------------------------------------------
void BuildKernelMesh(vtkUnstructuredGrid* grid, TetrahedralMesh& mesh)
{
  std::vector<double> points;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double* x = grid->GetPoint(p);
    points.insert(points.end(), x, x + 3);
  }
  std::vector<std::int64_t> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, ids);
    cells.insert(cells.end(), ids->begin(), ids->end());
  }
  mesh.Build({ points.data(), grid->GetNumberOfPoints(), cells.data(),
    static_cast<std::int64_t>(cells.size() / 4) });
}

//------------------------------------------------------------------------------
std::unique_ptr<StressCaster> MakeStressCaster(const std::string& name)
{
  if (name == "kernel")
  {
    return std::make_unique<KernelCaster>();
  }
  if (name == "opengl")
  {
    return std::make_unique<MapperCaster>(vtkTetrahedraRayCastMapper::OPENGL);
  }
  if (name == "native")
  {
    return std::make_unique<MapperCaster>(vtkTetrahedraRayCastMapper::NATIVE);
  }
  return nullptr;
}

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Meshes, cameras, functions and modes through the native ray caster.
#include "ByteReader.h"
#include "FuzzMesh.h"
#include "FuzzOptics.h"
#include "FuzzTarget.h"

#include "Simd/InstructionSets.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Mesh/ScalarGradients.h"
#include "Volume/Optics/VisibleScalars.h"
#include "Volume/Rays/PlacedVertices.h"
#include "Volume/Rays/RayPivot.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meniscus::test
{
namespace
{

constexpr int MostPixels = 20;
/** Error that the packets promise of a colour. */
constexpr float PromisedError = 2.0e-5f;

/** Scalars and optics of a scene; they outlive the caster. */
struct Optics
{
  std::vector<double> Scalars;
  std::vector<float> Normalized;
  std::vector<float> NormalizedOfCells;
  ScalarNormalization Normalization;
  std::vector<TransferFunctionInterval> Intervals;
  PacketTables Tables;
  std::vector<glm::vec3> Components;
  std::vector<glm::vec3> CellGradients;
  std::vector<glm::vec3> VertexGradients;
  std::vector<glm::vec3> CellBins;
  SurfaceLighting Lighting;
  PreIntegrationTable PreIntegration;
  std::vector<float> Depths;
};

/** A normalised number; NaN for a value that does not exist. */
float NormalizedNumber(ByteReader& reader)
{
  const int byte = reader.Below(256);
  return byte == 255 ? std::numeric_limits<float>::quiet_NaN()
                     : static_cast<float>(byte) / 127.0f - 1.0f;
}

class VolumeRun
{
public:
  explicit VolumeRun(ByteReader& reader)
    : Reader(reader)
  {
  }

  void Run();

private:
  bool ReadScalars(const TetrahedralMesh& mesh);
  void ReadOptics(const TetrahedralMesh& mesh);
  void ReadComponents(const TetrahedralMesh& mesh);
  void ReadPlanes(const RayFrame& frame);
  void Activate(TetrahedralMesh& mesh);
  void Cast(const TetrahedralMesh& mesh);
  void Draw(InstructionSet set, RayStatistics& sums);
  void Measure(InstructionSet set, RayStatistics& sums);

  ByteReader& Reader;
  Optics Input;
  TileCaster::Scene Scene;
  int Width = 1;
  int Height = 1;
};

//------------------------------------------------------------------------------
/** Scalars of vertices, or also of cells; as the input of the mapper normalises them. */
bool VolumeRun::ReadScalars(const TetrahedralMesh& mesh)
{
  const bool ofCells = this->Reader.Below(4) == 3;
  this->Input.Scalars.resize(
    static_cast<std::size_t>(ofCells ? mesh.GetNumberOfCells() : mesh.GetNumberOfVertices()));
  for (double& scalar : this->Input.Scalars)
  {
    scalar = this->Reader.Number();
  }
  const ScalarDistribution distribution = DistributionOf(this->Input.Scalars);
  const std::vector<TransferFunctionPoint> function = ReadFunction(this->Reader);
  this->Input.Normalization = ChooseNormalization(distribution, FeaturesOf(function), nullptr);
  this->Input.Intervals = BuildIntervals(function, this->Input.Normalization);
  std::vector<float>& normalized = ofCells ? this->Input.NormalizedOfCells : this->Input.Normalized;
  for (const double scalar : this->Input.Scalars)
  {
    normalized.push_back(std::isfinite(scalar)
        ? static_cast<float>(this->Input.Normalization(scalar))
        : std::numeric_limits<float>::quiet_NaN());
    Require(!(std::fabs(normalized.back()) > 1.0f), "normalised scalars are within [-1, 1]");
  }
  return ofCells;
}

//------------------------------------------------------------------------------
void VolumeRun::ReadComponents(const TetrahedralMesh& mesh)
{
  this->Scene.Mixture = static_cast<ComponentMixture>(this->Reader.Below(4));
  if (this->Scene.Mixture == ComponentMixture::None)
  {
    return;
  }
  for (std::int64_t v = 0; v < mesh.GetNumberOfVertices(); ++v)
  {
    const float x = NormalizedNumber(this->Reader);
    const float y = NormalizedNumber(this->Reader);
    const glm::vec3 values(x, y, NormalizedNumber(this->Reader));
    // As in the mapper, a vertex without one of its values has no scalar.
    if (std::isnan(values.x) || std::isnan(values.y) || std::isnan(values.z))
    {
      this->Input.Normalized[static_cast<std::size_t>(v)] = std::numeric_limits<float>::quiet_NaN();
    }
    this->Input.Components.push_back(
      this->Scene.Mixture == ComponentMixture::RedGreenBlueOpacity ? glm::abs(values) : values);
  }
  const int functions =
    this->Scene.Mixture == ComponentMixture::Independent ? 1 + this->Reader.Below(3) : 1;
  for (int i = 0; i < functions; ++i)
  {
    this->Input.Tables.OtherIntervals.push_back(
      PackIntervals(BuildIntervals(ReadFunction(this->Reader), ScalarNormalization())));
  }
  this->Input.Components.emplace_back(0.0f);
  this->Scene.Components = this->Input.Components.data();
}

//------------------------------------------------------------------------------
void VolumeRun::ReadOptics(const TetrahedralMesh& mesh)
{
  const bool ofCells = this->ReadScalars(mesh);
  Optics& input = this->Input;
  input.Tables.Intervals = PackIntervals(input.Intervals);
  const BlendModel& model =
    BlendModels[this->Reader.Below(static_cast<int>(std::size(BlendModels)))];
  this->Scene.Blending = model.Mode;
  if (ofCells)
  {
    input.NormalizedOfCells.push_back(0.0f);
    this->Scene.CellScalars = input.NormalizedOfCells.data();
  }
  const std::vector<double> none(static_cast<std::size_t>(mesh.GetNumberOfVertices()), 0.0);
  const std::vector<double>& scalars = ofCells ? none : input.Scalars;
  input.CellGradients = ComputeCellGradients(mesh, scalars, input.Normalization.GradientScale);
  input.CellGradients.emplace_back(0.0f);
  this->Scene.CellGradients = input.CellGradients.data();
  if (this->Reader.Flag())
  {
    input.VertexGradients =
      ComputeVertexGradients(mesh, scalars, input.Normalization.GradientScale);
    input.VertexGradients.emplace_back(0.0f);
    this->Scene.VertexGradients = input.VertexGradients.data();
  }
  if (this->Reader.Flag())
  {
    input.Lighting = ReadLighting(this->Reader);
    this->Scene.Lighting = &input.Lighting;
  }
  if (model.Visible == VisibleBy::Isovalues)
  {
    for (int i = this->Reader.Below(5); i > 0; --i)
    {
      const float scalar = static_cast<float>(this->Reader.Below(256)) / 127.5f - 1.0f;
      const auto opacity = static_cast<float>(this->Reader.Share());
      const glm::vec3 color(this->Reader.Color());
      input.Tables.Surfaces.push_back({ scalar, opacity, { color.r, color.g, color.b } });
    }
    std::sort(input.Tables.Surfaces.begin(), input.Tables.Surfaces.end(),
      [](const PacketSurface& a, const PacketSurface& b) { return a.Scalar < b.Scalar; });
    const auto end = std::unique(input.Tables.Surfaces.begin(), input.Tables.Surfaces.end(),
      [](const PacketSurface& a, const PacketSurface& b) { return a.Scalar == b.Scalar; });
    input.Tables.Surfaces.erase(end, input.Tables.Surfaces.end());
  }
  if (!model.IsMedium() || ofCells)
  {
    return;
  }
  this->ReadComponents(mesh);
  if (this->Reader.Flag())
  {
    this->Scene.GradientOpacity = true;
    this->Scene.GradientMagnitude = std::fabs(this->Reader.FiniteNumber());
    input.Tables.GradientIntervals =
      PackIntervals(BuildIntervals(ReadFunction(this->Reader), ScalarNormalization()));
  }
  else if (!this->Scene.Lighting && this->Scene.Mixture == ComponentMixture::None &&
    this->Reader.Flag())
  {
    const int samples = 2 + this->Reader.Below(9);
    const double longest = std::fabs(this->Reader.FiniteNumber());
    input.PreIntegration.Build(input.Intervals,
      longest > 0.0 && std::isfinite(2.0 * longest) ? longest : 1.0, samples,
      1 + this->Reader.Below(5));
    this->Scene.PreIntegration = &input.PreIntegration;
  }
}

//------------------------------------------------------------------------------
void VolumeRun::ReadPlanes(const RayFrame& frame)
{
  for (int i = this->Reader.Below(4); i > 0; --i)
  {
    const glm::dvec3 normal = this->Reader.FiniteVector();
    this->Scene.ClippingPlanes.push_back(
      ComputeClippingPlane(frame, normal, this->Reader.FiniteNumber()));
  }
}

//------------------------------------------------------------------------------
void VolumeRun::Activate(TetrahedralMesh& mesh)
{
  VisibleScalars visible;
  switch (GetBlendModel(this->Scene.Blending).Visible)
  {
    case VisibleBy::Attenuation:
      visible.AddAttenuation(this->Input.Intervals);
      break;
    case VisibleBy::Isovalues:
      for (const PacketSurface& surface : this->Input.Tables.Surfaces)
      {
        visible.AddIsovalue(surface.Scalar);
      }
      break;
    default:
      visible = VisibleScalars::All();
  }
  if (this->Scene.CellScalars)
  {
    const std::vector<float> ofCells(
      this->Input.NormalizedOfCells.begin(), this->Input.NormalizedOfCells.end() - 1);
    mesh.UpdateActiveCells(ofCells,
      this->Reader.Flag() ? TetrahedralMesh::CellJumps::Visible
                          : TetrahedralMesh::CellJumps::Hidden,
      visible);
  }
  else
  {
    mesh.UpdateActiveCells(this->Input.Normalized, visible);
  }
}

//------------------------------------------------------------------------------
void VolumeRun::Draw(InstructionSet set, RayStatistics& sums)
{
  this->Scene.Set = set;
  const std::size_t pixels = this->Input.Depths.size();
  std::vector<float> image(4 * pixels, 0.0f);
  const TileCaster caster(this->Scene);
  TileCaster::Workspace workspace;
  for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
  {
    const RayStatistics ofTile =
      caster.Cast(tile, this->Input.Depths.data(), image.data(), workspace);
    const BoundaryRaster::PixelBox box = caster.GetBox(tile);
    Require(ofTile.Rays >= 0 && ofTile.Rays <= (box.Right - box.Left) * (box.Top - box.Bottom),
      "a tile has one ray per pixel at most");
    sums.Steps += ofTile.Steps;
    sums.Rays += ofTile.Rays;
    sums.Lost += ofTile.Lost;
  }
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    const float* rgba = &image[4 * pixel];
    for (int channel = 0; channel < 4; ++channel)
    {
      Require(std::isfinite(rgba[channel]), "colours are finite");
      Require(rgba[channel] >= -PromisedError, "colours are not negative");
    }
    Require(rgba[3] <= 1.0f + PromisedError, "opacity is at most 1");
  }
}

//------------------------------------------------------------------------------
void VolumeRun::Measure(InstructionSet set, RayStatistics& sums)
{
  this->Scene.Set = set;
  const TileCaster caster(this->Scene);
  TileCaster::Workspace workspace;
  for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
  {
    const RayStatistics ofTile = caster.Measure(tile, workspace, this->Input.Depths.data());
    sums.Rays += ofTile.Rays;
    sums.Lost += ofTile.Lost;
    if (this->Scene.Measuring != RayMeasuring::Scalars &&
      this->Scene.Measuring != RayMeasuring::ScalarsAndOpticalDepth)
    {
      continue;
    }
    for (const MeasuredScalar& ray : workspace.Measured.Scalars)
    {
      Require(ray.Length >= 0.0, "lengths are not negative");
      Require(!(ray.Length > 0.0) || ray.Lowest <= ray.Highest, "extremes are in order");
      Require(!(ray.Length > 0.0) || std::fabs(ray.Lowest) <= 1.0f + PromisedError,
        "extremes are scalars");
    }
  }
}

//------------------------------------------------------------------------------
/** All instruction sets, which have the same rays. */
void VolumeRun::Cast(const TetrahedralMesh& mesh)
{
  RayFrameInput camera =
    ReadCamera(this->Reader, mesh.GetCenter(), mesh.GetRadius(), this->Width, this->Height);
  camera.SmallestCell = mesh.GetSmallestCell();
  RayFrame frame;
  if (ComputeRayFrame(camera, frame) != RayFrameStatus::Ok)
  {
    return;
  }
  this->ReadPlanes(frame);
  const std::vector<CellPassages> passages = FindPassages(mesh);
  this->Scene.Mesh = &mesh;
  this->Scene.Passages = &passages;
  this->Scene.Boundary = &mesh.GetBoundary();
  this->Scene.Tables = &this->Input.Tables;
  this->Scene.Rays = FixedPointRays(frame, this->Width, this->Height,
    FindPivot(frame, this->Width, this->Height, *this->Scene.Mesh));
  PlaceVertices(
    mesh, this->Input.Normalized, this->Scene.Rays, SerialLoop, this->Input.Tables.Vertices);
  this->Scene.TerminationTransmittance = this->Reader.Flag() ? 0.0f : 0.01f;
  const bool hasDepths = this->Reader.Flag();
  for (int i = 0; i < this->Width * this->Height; ++i)
  {
    this->Input.Depths.push_back(hasDepths ? static_cast<float>(this->Reader.Share()) : 1.0f);
  }
  const int measuring = this->Reader.Below(12);
  if (measuring >= 1 && measuring <= 3)
  {
    constexpr RayMeasuring kinds[] = { RayMeasuring::Scalars, RayMeasuring::ScalarsAndOpticalDepth,
      RayMeasuring::Events };
    this->Scene.Measuring = kinds[measuring - 1];
    this->Scene.Mixture = ComponentMixture::None;
    this->Scene.GradientOpacity = false;
    this->Scene.PreIntegration = nullptr;
  }
  std::vector<RayStatistics> sums;
  for (const InstructionSet set : GetInstructionSets())
  {
    sums.emplace_back();
    if (this->Scene.Measuring == RayMeasuring::None)
    {
      this->Draw(set, sums.back());
    }
    else
    {
      this->Measure(set, sums.back());
    }
    Require(sums.back().Lost == 0, "every ray ends on the boundary");
    Require(sums.back().Rays == sums.front().Rays, "every instruction set has the same rays");
  }
}

//------------------------------------------------------------------------------
void VolumeRun::Run()
{
  this->Width = 1 + this->Reader.Below(MostPixels);
  this->Height = 1 + this->Reader.Below(MostPixels);
  FuzzMesh arrays(this->Reader);
  TetrahedralMesh mesh;
  CheckMesh(mesh, arrays.GetView(), mesh.Build(arrays.GetView()));
  if (this->Reader.Flag())
  {
    arrays.ReadPoints(this->Reader);
    if (!mesh.MovePoints(arrays.GetView().Points))
    {
      mesh.Build(arrays.GetView());
    }
  }
  if (mesh.GetNumberOfCells() == 0)
  {
    return;
  }
  this->ReadOptics(mesh);
  this->Activate(mesh);
  if (mesh.GetNumberOfActiveCells() > 0 && mesh.GetRadius() > 0.0)
  {
    this->Cast(mesh);
  }
}

}

//------------------------------------------------------------------------------
void FuzzVolume(const std::uint8_t* bytes, std::size_t size)
{
  ByteReader reader(bytes, size);
  VolumeRun(reader).Run();
}

}

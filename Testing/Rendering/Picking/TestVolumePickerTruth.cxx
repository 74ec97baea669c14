// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Picks and images of events compared with the double-precision reference, pixel by pixel. No frame
// is drawn and no display is needed.
#include "EventTruth.h"
#include "MembraneScene.h"
#include "RayCastScene.h"

#include <vtkTetrahedraRayIntegral.h>
#include <vtkTetrahedraVolumePicker.h>

using namespace meniscus::test;
namespace reference = meniscus::reference;

namespace
{

constexpr int Width = 48;
constexpr int Height = 40;
/** Largest error of a depth, in units of the diagonal. */
constexpr double DepthTolerance = 1.0e-6;
const char* const Names[3] = { "FirstVisible", "OpacityReached", "LargestContribution" };

/** Results of a pixel, from a pick or from an image. */
struct FoundEvent
{
  double Distance;
  vtkIdType Cell;
  double Value;
  int Surface;
  glm::dvec3 Position;
};

/** Counts of a comparison. */
struct Tally
{
  int Compared = 0;
  int Seen = 0;
  int CellsCompared = 0;
  double Worst = 0.0;
};

Grid MakeScrambledBlock()
{
  Grid grid = MakeBlock(6, WavyField(2.0));
  Jitter(grid, 0.05, 11);
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  const Field field = WavyField(2.0);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    const double* p = grid->GetPoint(i);
    scalars->SetTuple1(i, field(p[0], p[1], p[2]));
  }
  return grid;
}

/** Truth of a scene: all rays, and the events along each. */
struct Truth
{
  Truth(RayCastScene& scene, FindEvents find)
    : Rays(scene.GetRenderer())
    , Find(std::move(find))
  {
    scene.GetVolume()->ComputeMatrix();
    this->Integrator = MakeReference(scene.MakeGrid(), scene.GetVolume()->GetMatrix());
    double range[2];
    scene.MakeGrid()->GetPointData()->GetScalars()->GetRange(range);
    this->ScalarRange = range[1] - range[0];
    vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
    // The diagonal of the picture is wider than its height.
    this->Slope = camera->GetParallelProjection()
      ? 0.0
      : 2.0 * std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle()));
  }

  double Diagonal() const { return this->Integrator->MakeMesh().GetDiagonal(); }
  /** A pixel's ray from the camera, so that distances count from there. */
  RobustEvents At(int column, int row) const
  {
    const double rounding = DepthTolerance * this->Diagonal();
    return FindRobustEvents(*this->Integrator, this->Rays.GetRay(column, row), this->Find,
      this->Slope, this->ScalarRange, rounding);
  }
  /** True if a cell contains a point, up to rounding. */
  bool Contains(vtkIdType cell, const glm::dvec3& point) const
  {
    const reference::ReferenceMesh& mesh = this->Integrator->MakeMesh();
    const reference::CellPlanes& planes = mesh.GetPlanes(static_cast<std::size_t>(cell));
    for (std::size_t face = 0; face < 4; ++face)
    {
      double weight = planes.Offset[face];
      double length = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double gradient = planes.Gradient[face][static_cast<std::size_t>(axis)];
        weight += gradient * (point[axis] - mesh.GetCenter()[static_cast<std::size_t>(axis)]);
        length += gradient * gradient;
      }
      // Twice the tolerance: across and along the ray.
      if (weight < -2.0 * DepthTolerance * this->Diagonal() * std::sqrt(length))
      {
        return false;
      }
    }
    return true;
  }

  std::unique_ptr<reference::ReferenceRayIntegrator> Integrator;
  PixelRays Rays;
  FindEvents Find;
  double ScalarRange = 1.0;
  double Slope = 0.0;
};

/** Compares the event of a pixel. `found` is null if the kernel has none. */
void Compare(const Truth& truth, const RobustEvents& robust, std::size_t kind,
  const FoundEvent* found, Tally& tally)
{
  const TrueEvent& event = robust.Events[kind];
  tally.Seen += event.IsFound();
  // Input rounding alone moves the exact place by more than the tolerance.
  if (robust.Change[kind] > DepthTolerance * truth.Diagonal())
  {
    return;
  }
  ASSERT_EQ(found != nullptr, event.IsFound()) << Names[kind];
  if (!found)
  {
    return;
  }
  ++tally.Compared;
  tally.Worst = std::max(tally.Worst, std::abs(found->Distance - event.Distance));
  EXPECT_NEAR(found->Value, event.Scalar, 1.0e-5 * truth.ScalarRange) << Names[kind];
  EXPECT_EQ(found->Surface, event.Surface) << Names[kind];
  EXPECT_TRUE(truth.Contains(found->Cell, found->Position)) << Names[kind];
  if (robust.StaysInCell[kind])
  {
    ++tally.CellsCompared;
    EXPECT_EQ(found->Cell, event.Cell) << Names[kind];
  }
}

/**
 * @param cells smallest share of the compared events whose cells are compared.
 * @param compared smallest share of the events that are compared.
 */
void ExpectGood(const Truth& truth, const std::array<Tally, 3>& tallies, const std::string& what,
  double cells, double compared)
{
  for (std::size_t kind = 0; kind < 3; ++kind)
  {
    const Tally& tally = tallies[kind];
    EXPECT_LE(tally.Worst, DepthTolerance * truth.Diagonal()) << what << " " << Names[kind];
    EXPECT_GT(tally.Compared, 50) << what << " " << Names[kind];
    EXPECT_GE(tally.Compared, compared * tally.Seen) << what << " " << Names[kind];
    EXPECT_GE(tally.CellsCompared, cells * tally.Compared) << what << " " << Names[kind];
    ::testing::Test::RecordProperty(
      what + Names[kind] + "Worst", std::to_string(1.0e6 * tally.Worst / truth.Diagonal()));
    ::testing::Test::RecordProperty(what + Names[kind] + "Seen", tally.Seen);
    ::testing::Test::RecordProperty(what + Names[kind] + "Compared", tally.Compared);
    ::testing::Test::RecordProperty(what + Names[kind] + "Cells", tally.CellsCompared);
  }
}

/** Picks every `step`-th pixel. */
void ExpectPicks(RayCastScene& scene, const FindEvents& find, double opacity, int step,
  const std::string& what, double cells = 0.9, double compared = 0.8)
{
  const Truth truth(scene, find);
  vtkNew<vtkTetrahedraVolumePicker> picker;
  picker->SetOpacityThreshold(opacity);
  picker->SetPlaceToFirstVisible();
  std::array<Tally, 3> tallies;
  for (int pixel = 0; pixel < Width * Height; pixel += step)
  {
    const int column = pixel % Width;
    const int row = pixel / Width;
    const int picked = picker->Pick(column, row, 0.0, scene.GetRenderer());
    const RobustEvents robust = truth.At(column, row);
    for (int kind = 0; kind < 3; ++kind)
    {
      FoundEvent found{ picker->GetDepthOf(kind), picker->GetCellIdOf(kind),
        picker->GetValueOf(kind), picker->GetSurfaceIndexOf(kind), glm::dvec3(0.0) };
      const bool isFound = picker->GetPositionOf(kind, &found.Position.x);
      EXPECT_LE(isFound, picked == 1);
      Compare(truth, robust, static_cast<std::size_t>(kind), isFound ? &found : nullptr,
        tallies[static_cast<std::size_t>(kind)]);
    }
  }
  ExpectGood(truth, tallies, what, cells, compared);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.GetRayCaster()->GetStatistic("NumberOfCellSearches"), 1);
  EXPECT_EQ(scene.GetRayCaster()->GetStatistic("NumberOfCastImages"), 0);
}

double ValueOf(vtkImageData* image, const std::string& name, int pixel, int component = 0)
{
  vtkDataArray* array = image->GetPointData()->GetArray(name.c_str());
  return array ? array->GetComponent(pixel, component) : -1.0;
}

/**
 * All pixels of an image of events. Its depths are floats, which are rounded by 2^-24 of the
 * distance from the camera, here below 4 diagonals: 2.4e-7 of the diagonal are added to the bound
 * of the distance, and as much to that of the place.
 */
void ExpectImage(RayCastScene& scene, vtkTetrahedraRayIntegral* filter, const FindEvents& find,
  const std::string& what, double compared = 0.8)
{
  const Truth truth(scene, find);
  filter->SetInputData(scene.MakeGrid());
  filter->SetImageSize(Width, Height);
  filter->SetCamera(scene.GetRenderer()->GetActiveCamera());
  filter->SetVolumeProperty(scene.GetVolume()->GetProperty());
  filter->GetArraySelection()->DisableArray("Integral");
  filter->GetArraySelection()->EnableArray("FirstVisible");
  filter->GetArraySelection()->EnableArray("OpacityReached");
  filter->GetArraySelection()->EnableArray("LargestContribution");
  filter->Update();
  vtkImageData* image = filter->GetOutput();
  std::array<Tally, 3> tallies;
  for (int pixel = 0; pixel < Width * Height; ++pixel)
  {
    const RobustEvents robust = truth.At(pixel % Width, pixel / Width);
    for (std::size_t kind = 0; kind < 3; ++kind)
    {
      const std::string name = Names[kind];
      const bool hasSurface = image->GetPointData()->HasArray((name + "Surface").c_str()) != 0;
      FoundEvent found{ ValueOf(image, name + "Depth", pixel),
        static_cast<vtkIdType>(ValueOf(image, name + "CellId", pixel)),
        ValueOf(image, name + "Value", pixel),
        hasSurface ? static_cast<int>(ValueOf(image, name + "Surface", pixel)) : -1,
        glm::dvec3(0.0) };
      for (int axis = 0; axis < 3; ++axis)
      {
        found.Position[axis] = ValueOf(image, name + "Position", pixel, axis);
      }
      Compare(truth, robust, kind, found.Cell >= 0 ? &found : nullptr, tallies[kind]);
      EXPECT_EQ(found.Cell < 0, std::isnan(found.Distance));
    }
  }
  for (Tally& tally : tallies)
  {
    tally.Worst = std::max(0.0, tally.Worst - 2.4e-7 * truth.Diagonal());
  }
  ExpectGood(truth, tallies, what, 0.9, compared);
  EXPECT_EQ(filter->GetStatistic("NumberOfCellSearches"), 1);
}

FindEvents MediumOf(RayCastScene& scene, double opacity)
{
  const auto function = ToReference(scene.GetVolume()->GetProperty());
  return [function, opacity](
           const reference::Ray& ray, const std::vector<reference::RaySegment>& segments)
  { return EventsOfMedium(ray, segments, function, opacity); };
}

struct BlockScene
{
  explicit BlockScene(FunctionKind kind, bool parallel, double density = 1.0)
    : Mesh(MakeScrambledBlock())
    , Scene(Mesh, MakeProperty(kind, Range, DiagonalOf(Mesh->GetBounds()) / density), Width, Height)
  {
    LookAt(this->Scene.GetRenderer(), this->Mesh->GetBounds(), 32.0, 21.0, 1.0, parallel);
  }
  static constexpr double Range[2] = { -1.0, 1.0 };
  Grid Mesh;
  RayCastScene Scene;
};

}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, MediumPerspective)
{
  for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Opaque })
  {
    BlockScene block(kind, false, 2.0);
    ExpectPicks(block.Scene, MediumOf(block.Scene, 0.3), 0.3, 3, "perspective");
  }
}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, MediumParallel)
{
  BlockScene block(FunctionKind::Smooth, true, 2.0);
  ExpectPicks(block.Scene, MediumOf(block.Scene, 0.2), 0.2, 3, "parallel");
}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, VolumeMatrix)
{
  BlockScene block(FunctionKind::Smooth, false, 2.0);
  vtkVolume* volume = block.Scene.GetVolume();
  volume->SetPosition(0.3, -0.2, 0.4);
  volume->RotateWXYZ(40.0, 1.0, 2.0, 3.0);
  volume->SetScale(1.5, 0.7, -1.2);
  volume->ComputeMatrix();
  LookAt(block.Scene.GetRenderer(), volume->GetBounds(), 32.0, 21.0);
  ExpectPicks(block.Scene, MediumOf(block.Scene, 0.3), 0.3, 1, "matrix");
}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, ClippingPlanes)
{
  BlockScene block(FunctionKind::Smooth, false, 2.0);
  AddClippingPlane(block.Scene.GetRayCaster(), { { -0.5, -0.3, -0.8 }, { 0.1, 0.2, 0.1 } });
  const reference::HalfSpace half{ { -0.5, -0.3, -0.8 }, { 0.1, 0.2, 0.1 } };
  const FindEvents medium = MediumOf(block.Scene, 0.2);
  const FindEvents clipped =
    [&](const reference::Ray& ray, const std::vector<reference::RaySegment>& segments)
  {
    const reference::Ray rest = reference::ClipRay(ray, { half });
    std::vector<reference::RaySegment> kept;
    for (reference::RaySegment segment : segments)
    {
      const double length = segment.End - segment.Begin;
      const double change = segment.ScalarEnd - segment.ScalarBegin;
      const double from = std::clamp(rest.Begin, segment.Begin, segment.End);
      const double to = std::clamp(rest.End, segment.Begin, segment.End);
      if (from < to)
      {
        kept.push_back({ from, to, segment.ScalarBegin + (from - segment.Begin) / length * change,
          segment.ScalarBegin + (to - segment.Begin) / length * change, segment.Cell });
      }
    }
    return medium(ray, kept);
  };
  ExpectPicks(block.Scene, clipped, 0.2, 3, "clipped");
}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, Isosurfaces)
{
  BlockScene block(FunctionKind::Smooth, false);
  vtkVolumeProperty* property = block.Scene.GetVolume()->GetProperty();
  // Not in the order of their values; one lies outside of the data.
  std::vector<reference::Surface> surfaces;
  const double values[4] = { 0.4, -0.5, 7.0, 0.05 };
  const auto function = ToReference(property);
  for (int i = 0; i < 4; ++i)
  {
    property->GetIsoSurfaceValues()->SetValue(i, values[i]);
    const double alpha = property->GetScalarOpacity()->GetValue(values[i]);
    surfaces.push_back({ values[i], alpha, { 1.0, 1.0, 1.0 } });
  }
  block.Scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  const FindEvents find =
    [surfaces](const reference::Ray& ray, const std::vector<reference::RaySegment>& segments)
  { return EventsOfSurfaces(ray, segments, surfaces, 0.2); };
  // Rays are rounded by up to 2.8e-7 of the diagonal, which moves the place by more than the bound
  // where a surface is steeper than 74 degrees: in 8 % of the picture of a sphere.
  constexpr double compared = 0.8;
  ExpectPicks(block.Scene, find, 0.2, 3, "surfaces", 0.9, compared);
  vtkNew<vtkTetrahedraRayIntegral> filter;
  filter->SetEventBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  filter->SetEventOpacity(0.2);
  ExpectImage(block.Scene, filter, find, "surfaceImage", compared);
}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, Extremes)
{
  for (const bool isMaximum : { true, false })
  {
    BlockScene block(FunctionKind::Smooth, isMaximum);
    block.Scene.GetRayCaster()->SetBlendMode(isMaximum ? vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND
                                                       : vtkVolumeMapper::MINIMUM_INTENSITY_BLEND);
    const FindEvents find =
      [isMaximum](const reference::Ray& ray, const std::vector<reference::RaySegment>& segments)
    { return EventsOfExtreme(ray, segments, isMaximum); };
    // Extremes lie on faces, which belong to two cells: either contains the place.
    ExpectPicks(block.Scene, find, 0.5, 3, isMaximum ? "maximum" : "minimum", 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, ImageOfEvents)
{
  BlockScene block(FunctionKind::Smooth, false, 2.0);
  vtkNew<vtkTetrahedraRayIntegral> filter;
  filter->SetEventOpacity(0.3);
  ExpectImage(block.Scene, filter, MediumOf(block.Scene, 0.3), "image");
  EXPECT_EQ(filter->GetStatistic("NumberOfCasts"), 1);
}

//------------------------------------------------------------------------------
/** The true place behind a plane surface of water, along both parts of the ray. */
TEST(VolumePickerTruth, ThroughAMembrane)
{
  BlockScene block(FunctionKind::Smooth, false, 2.0);
  const MembraneCase water = MakePlaneCase(0.3, 8.0, 8);
  block.Scene.GetRayCaster()->SetMembraneData(water.Mesh);
  const Truth truth(block.Scene, MediumOf(block.Scene, 0.3));
  vtkNew<vtkTetrahedraVolumePicker> picker;
  picker->SetOpacityThreshold(0.3);
  Tally tally;
  int behind = 0;
  for (int pixel = 0; pixel < Width * Height; pixel += 3)
  {
    const int column = pixel % Width;
    const int row = pixel / Width;
    const reference::RefractedRay bent =
      reference::Refract(water.Surface, truth.Rays.GetRay(column, row), 0.0, false);
    picker->Pick(column, row, 0.0, block.Scene.GetRenderer());
    const std::vector<reference::RaySegment> segments =
      reference::FindSegments(*truth.Integrator, bent);
    reference::Ray unit = bent.Straight;
    const TrueEvents events = truth.Find(unit, segments);
    for (int kind = 0; kind < 3; ++kind)
    {
      const TrueEvent& event = events[static_cast<std::size_t>(kind)];
      double found[3];
      if (!event.IsFound() || !picker->GetPositionOf(kind, found))
      {
        continue;
      }
      ++tally.Seen;
      const bool isBehind = bent.Bent.Begin < bent.Bent.End && event.Distance > bent.Straight.End;
      const reference::Ray& part = isBehind ? bent.Bent : bent.Straight;
      double off = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        // Distances on the refracted part count from the surface.
        const double along = isBehind ? event.Distance - bent.Straight.End : event.Distance;
        const double place = part.Origin[axis] + along * part.Direction[axis];
        off += (found[axis] - place) * (found[axis] - place);
      }
      // Places that jump with the rounding of the ray are far away from the truth.
      if (std::sqrt(off) < 1.0e-4 * truth.Diagonal())
      {
        ++tally.Compared;
        behind += isBehind;
        tally.Worst = std::max(tally.Worst, std::sqrt(off));
        EXPECT_NEAR(picker->GetDepthOf(kind), event.Distance, 1.0e-4 * truth.Diagonal());
      }
    }
  }
  EXPECT_GE(tally.Compared, 0.98 * tally.Seen);
  EXPECT_GT(behind, 100);
  RecordProperty("Worst", std::to_string(1.0e6 * tally.Worst / truth.Diagonal()));
  EXPECT_LE(tally.Worst, DepthTolerance * truth.Diagonal());
  EXPECT_EQ(block.Scene.GetRayCaster()->GetStatistic("NumberOfSightUpdates"), 0);
}

//------------------------------------------------------------------------------
TEST(VolumePickerTruth, DataMeshes)
{
  for (const char* name : { "blunt_fin", "combustor" })
  {
    Grid grid = ReadDataMesh(name);
    if (!grid)
    {
      GTEST_SKIP() << "no mesh " << name;
    }
    double range[2];
    grid->GetPointData()->GetScalars()->GetRange(range);
    RayCastScene scene(grid,
      MakeProperty(FunctionKind::Smooth, range, DiagonalOf(grid->GetBounds()) / 8.0), Width,
      Height);
    LookAt(scene.GetRenderer(), grid->GetBounds(), 32.0, 21.0);
    ExpectPicks(scene, MediumOf(scene, 0.3), 0.3, 5, name, 0.8, 0.8);
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells from a third down to 1/30,000 of the domain, seen whole and from as near as the smallest
// ones require, in every blend mode, straight and through a membrane, compared with the
// double-precision reference.
#include "MembraneScene.h"
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 80;
constexpr int Cubes = 14;
constexpr double Range[2] = { -1.0, 1.0 };

// Fractions of the domain that the images show. The smallest cells are 1/30,000 of it.
constexpr double Views[4] = { 1.0, 3e-2, 1e-3, 2e-4 };

const double Radius = std::sqrt(3.0);

// Distance by which a ray may miss a feature in an image of a part of the domain. Vertices are
// placed to 2^-30 of the radius times 1 + the steepest slope, less than 2^-29, and coordinates
// about a ray are rounded to 2^-24 of themselves: those of the needles between large and small
// cells are as large as the image. A pixel may be excused if the exact result itself changes by
// half of the pixel's error when the ray moves by this distance: where a ray only touches an
// isosurface, or passes a silhouette.
double RoundingOf(double part)
{
  return Radius * (std::pow(2.0, -29) + part * std::pow(2.0, -24));
}

// The cube [-1, 1]^3, with cubes that become smaller towards the corner (1, 1, 1): their sides grow
// by a constant factor. The scalar is a wave in the cubes' numbers, so that it varies in cells of
// every size.
Grid MakeGradedBlock()
{
  // (q - 1) / (q^n - 1) is the smallest side over that of the domain.
  double low = 1.5;
  double high = 3.0;
  for (int i = 0; i < 60; ++i)
  {
    const double q = 0.5 * (low + high);
    const bool larger = (q - 1.0) / (std::pow(q, Cubes) - 1.0) > 1.0 / 30000.0;
    low = larger ? q : low;
    high = larger ? high : q;
  }
  const double factor = low;
  const Grid grid = MakeBlock(Cubes, WavyField(3.0));
  MapPoints(grid,
    [factor](const glm::dvec3& x)
    {
      const glm::dvec3 fromCorner = 0.5 * (1.0 - x) * double{ Cubes };
      return 1.0 -
        2.0 * (glm::pow(glm::dvec3(factor), fromCorner) - 1.0) / (std::pow(factor, Cubes) - 1.0);
    });
  return grid;
}

// A part of the domain at the corner with the smallest cells, and a function for its size.
enum class Projecting
{
  Perspective,
  Parallel,
  // Parallel, along an edge of the domain from far away: rays begin before the mesh.
  FromAfar
};

struct CornerScene
{
  RayCastScene Scene;
  double Part;
  bool IsAfar;

  CornerScene(vtkUnstructuredGrid* grid, double part, FunctionKind kind,
    Projecting projecting = Projecting::Perspective)
    : Scene(grid, MakeProperty(kind, Range, 3.4 * part), Size, Size)
    , Part(part)
    , IsAfar(projecting == Projecting::FromAfar)
  {
    const double near = 1.0 - 2.0 * part;
    const double bounds[6] = { near, 1.0, near, 1.0, near, 1.0 };
    LookAt(this->Scene.GetRenderer(), bounds, this->IsAfar ? 1.0 : 30.0, this->IsAfar ? 2.0 : 35.0,
      1.2, projecting != Projecting::Perspective);
    vtkCamera* camera = this->Scene.GetRenderer()->GetActiveCamera();
    if (this->IsAfar)
    {
      camera->Dolly(camera->GetDistance() / 6.0);
    }
    camera->SetClippingRange(0.3 * camera->GetDistance(), camera->GetDistance() + 8.0);
    for (const double value : { -0.31, 0.12, 0.43 })
    {
      vtkContourValues* values = this->Scene.GetVolume()->GetProperty()->GetIsoSurfaceValues();
      values->SetValue(values->GetNumberOfContours(), value);
    }
  }
};

using TraceSegments =
  std::function<std::array<double, 4>(const Ray&, const std::vector<RaySegment>&)>;

// Largest error of a pixel.
double ToleranceOf(const CornerScene& corner, int mode)
{
  if (corner.Scene.GetRayCaster()->GetActiveBackend() == vtkTetrahedraRayCastMapper::NATIVE)
  {
    return corner.IsAfar ? 4e-5 : 2e-5;
  }
  return mode == vtkVolumeMapper::COMPOSITE_BLEND ? 4e-5 : 2e-5;
}

// Renders and compares all pixels.
void ExpectSegments(RayCastScene& scene, double part, const ReferenceRayIntegrator& integrator,
  const RefractingSurface* membrane, const TraceSegments& show, const std::string& what,
  double tolerance)
{
  const TraceRay trace = [&](const Ray& ray)
  {
    if (membrane)
    {
      const RefractedRay refracted = Refract(*membrane, ray, 0.0, false);
      return show(refracted.Straight, FindSegments(integrator, refracted));
    }
    std::vector<RaySegment> segments;
    integrator.FindSegments(ray, segments);
    return show(ray, segments);
  };
  const FloatImage image = scene.RenderFloat();
  const TracedComparison comparison =
    CompareToTrace(image, PixelRays(scene.GetRenderer()), trace, tolerance, RoundingOf(part));
  SCOPED_TRACE(what + ": " + comparison.GetText());
  EXPECT_GT(comparison.Visible, static_cast<std::size_t>(Size * Size / 4));
  EXPECT_EQ(comparison.Wrong, 0u);
  EXPECT_LE(comparison.Excused, 1u);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  ::testing::Test::RecordProperty(what, comparison.GetText());
}

void ExpectMode(CornerScene& corner, const ReferenceRayIntegrator& integrator,
  const RefractingSurface* membrane, int mode, const std::string& what)
{
  RayCastScene& scene = corner.Scene;
  scene.GetRayCaster()->SetBlendMode(mode);
  scene.GetWindow()->Render();
  vtkVolumeProperty* property = scene.GetVolume()->GetProperty();
  const std::vector<Surface> surfaces = ToSurfaces(property);
  const ProjectionMode* projection = FindProjectionMode(mode);
  const ReferenceTransferFunction function =
    projection ? FunctionOf(*projection, property) : ToReference(property);
  double range[2];
  scene.MakeGrid()->GetPointData()->GetScalars()->GetFiniteRange(range);
  ExpectSegments(
    scene, corner.Part, integrator, membrane,
    [&](const Ray& ray, const std::vector<RaySegment>& segments) -> std::array<double, 4>
    {
      if (projection)
      {
        return Project(ray, segments, projection->Truth, function, range);
      }
      return mode == vtkVolumeMapper::ISOSURFACE_BLEND
        ? BlendSurfaces(ray, segments, surfaces, nullptr, Material())
        : ReferenceRayIntegrator::Integrate(ray, segments, function);
    },
    what + ", mode " + std::to_string(mode), ToleranceOf(corner, mode));
}

} // anonymous namespace

TEST(TetrahedraRayCastSmallCells, CompositeInEveryView)
{
  const Grid grid = MakeGradedBlock();
  const auto integrator = MakeReference(grid);
  for (const double part : Views)
  {
    for (const FunctionKind kind :
      { FunctionKind::Smooth, FunctionKind::Peaked, FunctionKind::Opaque })
    {
      // Peaks are a tenth of a cell wide: 2^-30 of the radius is 2.5e-4 of one in the smallest
      // cells.
      if (kind == FunctionKind::Peaked && part < 1e-3)
      {
        continue;
      }
      for (const Projecting projecting :
        { Projecting::Perspective, Projecting::Parallel, Projecting::FromAfar })
      {
        CornerScene corner(grid, part, kind, projecting);
        ExpectMode(corner, *integrator, nullptr, vtkVolumeMapper::COMPOSITE_BLEND,
          "part " + std::to_string(part) + ", function " + std::to_string(static_cast<int>(kind)) +
            ", projection " + std::to_string(static_cast<int>(projecting)));
      }
    }
  }
}

TEST(TetrahedraRayCastSmallCells, OtherModes)
{
  const Grid grid = MakeGradedBlock();
  const auto integrator = MakeReference(grid);
  for (const double part : Views)
  {
    CornerScene corner(grid, part, FunctionKind::Smooth);
    for (const int mode : AllBlendModes())
    {
      if (mode == vtkVolumeMapper::COMPOSITE_BLEND)
      {
        continue;
      }
      ExpectMode(corner, *integrator, nullptr, mode, "part " + std::to_string(part));
    }
  }
}

TEST(TetrahedraRayCastSmallCells, RefractedRays)
{
  // Above the corner, and through the visible cells.
  const Grid grid = MakeGradedBlock();
  const auto integrator = MakeReference(grid);
  for (const double part : Views)
  {
    for (const double above : { 0.1, -0.7 })
    {
      const MembraneCase membrane = MakePlaneCase(1.0 + above * part, 8.0, 2);
      for (const int mode : AllBlendModes())
      {
        CornerScene corner(grid, part,
          mode == vtkVolumeMapper::COMPOSITE_BLEND ? FunctionKind::Opaque : FunctionKind::Smooth);
        corner.Scene.GetRayCaster()->SetMembraneData(membrane.Mesh);
        ExpectMode(corner, *integrator, &membrane.Surface, mode,
          "membrane at " + std::to_string(above) + ", part " + std::to_string(part));
      }
    }
  }
}

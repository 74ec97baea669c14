// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Volumes through a membrane, compared with rays refracted in double precision.
#include "MembraneScene.h"
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 112;
const double Range[2] = { -1.0, 1.0 };
constexpr double Block[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };

struct MembraneTest
{
  MembraneCase Membrane;
  RayCastScene Scene;

  MembraneTest(const MembraneCase& membrane, vtkUnstructuredGrid* grid,
    FunctionKind kind = FunctionKind::Smooth)
    : Membrane(membrane)
    , Scene(grid, MakeProperty(kind, Range, 3.4), Size, Size)
  {
    this->Scene.GetRayCaster()->SetMembraneData(membrane.Mesh);
  }

  void SetIndices(double exterior, double interior)
  {
    this->Scene.GetRayCaster()->SetExteriorIndexOfRefraction(exterior);
    this->Scene.GetRayCaster()->SetInteriorIndexOfRefraction(interior);
    this->Membrane.Surface.Exterior = exterior;
    this->Membrane.Surface.Interior = interior;
  }

  void LookAtBlock(double azimuth, double elevation, double zoom = 1.0, bool parallel = false)
  {
    LookAt(this->Scene.GetRenderer(), Block, azimuth, elevation, zoom, parallel);
  }

  // Compares with the exact result of composite blending.
  TracedComparison ExpectComposite(const std::string& what, double tolerance = FloatTolerance)
  {
    this->Scene.GetWindow()->Render();
    const auto integrator =
      MakeReference(this->Scene.MakeGrid(), this->Scene.GetVolume()->GetMatrix());
    const auto function = ToReference(this->Scene.GetVolume()->GetProperty());
    const TracedComparison result = ExpectTrace(this->Scene,
      this->Membrane.BendMembrane(
        [&](const Ray& part) { return integrator->Trace(part, function); }),
      what, tolerance);
    // Measured: 1.6e-6 through waves, because of the patches' error; otherwise 1.3e-7 natively and
    // 8.7e-7 with shaders.
    EXPECT_LT(result.Rms, 2e-6) << what << ": " << result.GetText();
    return result;
  }
};

// Compares isosurfaces, with or without lighting.
void ExpectSurfaces(MembraneTest& test, const std::string& what)
{
  RayCastScene& scene = test.Scene;
  scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  scene.GetWindow()->Render();
  vtkVolumeProperty* property = scene.GetVolume()->GetProperty();
  const auto integrator = MakeReference(scene.MakeGrid(), scene.GetVolume()->GetMatrix());
  const std::vector<Surface> surfaces = ToSurfaces(property);
  const Material material = ToMaterial(property, scene.GetRenderer());
  const ReferenceGradients gradients(
    integrator->MakeMesh(), scene.GetRayCaster()->GetGradients() != 0);
  ExpectTrace(
    scene,
    [&](const Ray& ray)
    {
      return Compose(Refract(test.Membrane.Surface, ray, 0.0, false),
        [&](const Ray& part)
        {
          std::vector<RaySegment> segments;
          integrator->FindSegments(part, segments);
          return BlendSurfaces(
            part, segments, surfaces, property->GetShade() ? &gradients : nullptr, material);
        });
    },
    what);
}

vtkSmartPointer<vtkVolumeProperty> SurfaceProperty(bool shade)
{
  auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  property->GetIsoSurfaceValues()->SetValue(0, -0.31);
  property->GetIsoSurfaceValues()->SetValue(1, 0.12);
  property->GetIsoSurfaceValues()->SetValue(2, 0.43);
  property->SetShade(shade);
  property->SetSpecular(0.4);
  return property;
}

} // anonymous namespace

TEST(TetrahedraRayCastMembrane, ThroughAPlane)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const auto& [kind, elevation] :
    Product(std::vector<FunctionKind>{ FunctionKind::Smooth, FunctionKind::Peaked },
      List(25.0, 60.0, 90.0)))
  {
    MembraneTest test(MakePlaneCase(1.3, 3.0, 3), grid, kind);
    test.LookAtBlock(30.0, elevation);
    test.ExpectComposite("plane from " + std::to_string(elevation));
    EXPECT_EQ(test.Scene.GetRayCaster()->GetActiveBackend(), BackendUnderTest());
  }
}

TEST(TetrahedraRayCastMembrane, ThroughADome)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const auto& [kind, parallel] :
    Product(
      std::vector<FunctionKind>{ FunctionKind::Smooth, FunctionKind::Peaked }, List(false, true)))
  {
    MembraneTest test(MakeDomeCase(1.4, 4.0, 2.8, 16), grid, kind);
    test.LookAtBlock(30.0, 55.0, 1.0, parallel);
    test.ExpectComposite(parallel ? "dome, parallel" : "dome, perspective");
  }
}

TEST(TetrahedraRayCastMembrane, ThroughWaves)
{
  // Patches interpolate waves, so the error is theirs: of third order in the size of a facet.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  MembraneTest test(MakeWavesCase(1.3, 0.08, 3.0, 3.0, 192), grid);
  test.LookAtBlock(30.0, 50.0);
  test.ExpectComposite("waves");
}

TEST(TetrahedraRayCastMembrane, ConstantMediumUnderAPlane)
{
  // Closed form: 1 - exp(-tau l), with the length l of the refracted ray in the box.
  RayCastScene scene(
    MakeBlock(4, ConstantField(0.5)), MakeConstantProperty(0.7, 1, 1, 1, 0.8), Size, Size);
  const MembraneCase plane = MakePlaneCase(1.5, 4.0, 2);
  scene.GetRayCaster()->SetMembraneData(plane.Mesh);
  LookAt(scene.GetRenderer(), Block, 20.0, 40.0);
  ExpectTrace(
    scene,
    [](const Ray& ray)
    {
      const double size = std::sqrt(ray.Direction[0] * ray.Direction[0] +
        ray.Direction[1] * ray.Direction[1] + ray.Direction[2] * ray.Direction[2]);
      const double at = (1.5 - ray.Origin[1]) / ray.Direction[1];
      const double ratio = 1.0 / (1.333 * size);
      const double x = ray.Direction[0] * ratio;
      const double z = ray.Direction[2] * ratio;
      const double direction[3] = { x, -std::sqrt(1.0 - x * x - z * z), z };
      double begin = 0.0;
      double end = 1e6;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double origin = ray.Origin[axis] + at * ray.Direction[axis];
        const double a = (-1.0 - origin) / direction[axis];
        const double b = (1.0 - origin) / direction[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
      }
      const double alpha = -std::expm1(-std::max(0.0, end - begin) * 0.7 / 0.8);
      return std::array<double, 4>{ alpha, alpha, alpha, alpha };
    },
    "closed form");
}

TEST(TetrahedraRayCastMembrane, MeshPartlyAbove)
{
  for (const Region& region : { Region(), Torus(0.6, 0.3), TwoBlocks(0.4), LShape() })
  {
    const Grid grid = MakeBlock(6, WavyField(3.0), region);
    // Through cells, along their faces, along the mesh's own top.
    for (const double level : { -0.55, 0.0, 0.1, 1.0 })
    {
      MembraneTest test(MakePlaneCase(level, 4.0, 2), grid);
      test.LookAtBlock(30.0, 35.0);
      test.ExpectComposite("plane at " + std::to_string(level));
    }
    MembraneTest test(MakeDomeCase(0.3, 4.0, 2.8, 16), grid);
    test.LookAtBlock(30.0, 35.0);
    test.ExpectComposite("dome in the mesh");
  }
}

TEST(TetrahedraRayCastMembrane, CellsInDisorder)
{
  // Inverted and overlapping cells around the membrane: no walk may get lost. The image of such a
  // mesh depends on the order of its cells, so only statistics are compared.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  Jitter(grid, 0.3, 5);
  MembraneTest test(MakePlaneCase(0.1, 4.0, 2), grid);
  test.LookAtBlock(30.0, 35.0);
  test.Scene.RenderFloat();
  EXPECT_GT(test.Scene.GetRayCaster()->GetNumberOfRays(), 1000);
  EXPECT_EQ(test.Scene.GetRayCaster()->GetNumberOfLostRays(), 0);
}

TEST(TetrahedraRayCastMembrane, CellsFlatterThanRounding)
{
  // Two layers of cells, which rounding may invert, around the membrane: rays begin in them.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  MapPoints(grid,
    [](const glm::dvec3& x)
    { return glm::dvec3(x.x, std::fabs(x.y) < 0.5 ? 3e-8 * x.y : x.y, x.z); });
  for (const double level : { 0.0, 5e-9, -2e-8 })
  {
    MembraneTest test(MakePlaneCase(level, 4.0, 2), grid);
    test.LookAtBlock(30.0, 35.0);
    test.ExpectComposite("flat cells, plane at " + std::to_string(1e9 * level) + "e-9");
  }
}

TEST(TetrahedraRayCastMembrane, RaysOfSeveralFrames)
{
  // At the corners of this dome rays turn by more than 50 degrees, and come from all sides. The
  // border of its patches bulges along the normals: between two vertices, 0.066 apart next to a
  // corner, it is up to 3e-4 outside of the square that the truth knows. With 100 x 100 pixels the
  // ray of (7, 54) meets the sphere 1.3e-4 outside of it, at 5 degrees, and is refracted.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  MembraneTest test(MakeDomeCase(2.3, 1.3, 0.9, 96), grid);
  test.SetIndices(1.0, 3.0);
  for (const double elevation : { 90.0, 70.0 })
  {
    test.LookAtBlock(30.0, elevation);
    test.ExpectComposite("steep dome from " + std::to_string(elevation));
  }
}

TEST(TetrahedraRayCastMembrane, PartOfTheScreen)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const double level : { 0.2, 1.2 })
  {
    MembraneTest test(MakePlaneCase(level, 0.7, 3), grid);
    test.LookAtBlock(30.0, 40.0);
    test.ExpectComposite("small plane at " + std::to_string(level));
  }
}

TEST(TetrahedraRayCastMembrane, TotalReflection)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const double elevation : { 20.0, 45.0 })
  {
    // The critical angle is 41.8 degrees.
    MembraneTest test(MakePlaneCase(0.1, 4.0, 2), grid);
    test.SetIndices(1.5, 1.0);
    test.LookAtBlock(30.0, elevation);
    test.ExpectComposite("from " + std::to_string(elevation));
  }
}

TEST(TetrahedraRayCastMembrane, FromTheOtherSide)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const double level : { -1.3, 0.1 })
  {
    MembraneTest test(MakePlaneCase(level, 4.0, 2), grid);
    test.LookAtBlock(30.0, -65.0);
    test.ExpectComposite("from below, at " + std::to_string(level));
  }
}

TEST(TetrahedraRayCastMembrane, BehindTheEyeAndBeforeTheNearPlane)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  MembraneTest behind(MakePlaneCase(9.0, 30.0, 2), grid);
  behind.LookAtBlock(30.0, 35.0);
  behind.ExpectComposite("behind the eye");

  for (const double level : { 0.4, 1.5 })
  {
    MembraneTest near(MakePlaneCase(level, 9.0, 2), grid);
    vtkCamera* camera = near.Scene.GetRenderer()->GetActiveCamera();
    camera->SetPosition(0.1, level + 0.4, 0.9);
    camera->SetFocalPoint(0.0, level - 1.0, -0.2);
    camera->SetViewUp(0.0, 0.0, -1.0);
    camera->SetViewAngle(70.0);
    camera->SetClippingRange(0.8, 10.0);
    near.ExpectComposite("before the near plane, at " + std::to_string(level));
  }
}

TEST(TetrahedraRayCastMembrane, TransformedVolume)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  MembraneTest test(MakeDomeCase(0.9, 4.0, 2.7, 16), grid);
  vtkVolume* volume = test.Scene.GetVolume();
  volume->SetScale(-0.7, 1.5, 1.0);
  volume->RotateWXYZ(37.0, 0.3, 1.0, 0.2);
  volume->SetPosition(0.1, -0.2, 0.1);
  test.LookAtBlock(30.0, 60.0, 0.8);
  test.ExpectComposite("mirrored and stretched");
}

TEST(TetrahedraRayCastMembrane, Projections)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  double range[2];
  grid->GetPointData()->GetScalars()->GetFiniteRange(range);
  const std::vector<MembraneCase> membranes{ MakePlaneCase(1.3, 3.0, 3), MakePlaneCase(0.1, 4.0, 2),
    MakeDomeCase(1.4, 4.0, 2.8, 16) };
  for (const ProjectionMode& mode : ProjectionModes)
  {
    for (const MembraneCase& membrane : membranes)
    {
      MembraneTest test(membrane, grid);
      RayCastScene& scene = test.Scene;
      scene.GetRayCaster()->SetBlendMode(mode.Number);
      test.LookAtBlock(30.0, 55.0);
      const auto integrator = MakeReference(grid);
      vtkVolumeProperty* property = scene.GetVolume()->GetProperty();
      const auto function = FunctionOf(mode, property);
      ExpectTrace(
        scene,
        [&](const Ray& ray)
        {
          const RefractedRay refracted = Refract(membrane.Surface, ray, 0.0, false);
          return Project(
            refracted.Straight, FindSegments(*integrator, refracted), mode.Truth, function, range);
        },
        mode.Name);
    }
  }
}

TEST(TetrahedraRayCastMembrane, Isosurfaces)
{
  const Grid grid = MakeBlock(8, WavyField(3.0));
  const std::vector<MembraneCase> membranes{ MakePlaneCase(0.1, 4.0, 2),
    MakeDomeCase(1.4, 4.0, 2.8, 16) };
  for (const bool shade : { false, true })
  {
    for (const MembraneCase& membrane : membranes)
    {
      for (const int gradients : { 0, 1 })
      {
        MembraneTest test(membrane, grid);
        test.Scene.SetProperty(SurfaceProperty(shade));
        test.Scene.GetRayCaster()->SetGradients(gradients);
        vtkNew<vtkLight> lamp;
        lamp->SetPositional(true);
        lamp->SetPosition(1.5, 2.5, 1.0);
        lamp->SetFocalPoint(0.0, 0.0, 0.0);
        lamp->SetConeAngle(40.0);
        lamp->SetAttenuationValues(0.4, 0.2, 0.05);
        test.Scene.GetRenderer()->AddLight(lamp);
        AddParallelLight(test.Scene.GetRenderer(), -1.0, 2.0, 0.5);
        test.LookAtBlock(30.0, 50.0);
        ExpectSurfaces(test, shade ? "lit" : "unlit");
      }
    }
  }
}

TEST(TetrahedraRayCastMembrane, LightAndGradientOpacityInTheMedium)
{
  // Gradients of cells and directional light, for which the lighting of the medium is exact.
  const Grid grid = MakeBlock(6, WavyField(3.0));
  for (const MembraneCase& membrane :
    { MakePlaneCase(0.1, 4.0, 2), MakeDomeCase(1.4, 4.0, 2.8, 16) })
  {
    MembraneTest test(membrane, grid);
    vtkVolumeProperty* property = test.Scene.GetVolume()->GetProperty();
    property->ShadeOn();
    property->SetSpecular(0.0);
    property->SetGradientOpacity(MakeOpacity({ { 0.0, 0.2 }, { 4.0, 1.0 } }));
    test.Scene.GetRayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
    AddParallelLight(test.Scene.GetRenderer(), -1.0, 2.0, 0.5);
    test.LookAtBlock(30.0, 50.0);
    test.Scene.GetWindow()->Render();
    const auto integrator = MakeReference(grid);
    const auto function = ToReference(property);
    const Material material = ToMaterial(property, test.Scene.GetRenderer());
    const ReferenceGradients gradients(integrator->MakeMesh(), false);
    ExpectTrace(
      test.Scene,
      [&](const Ray& ray)
      {
        return Compose(Refract(membrane.Surface, ray, 0.0, false),
          [&](const Ray& part)
          {
            std::vector<RaySegment> segments;
            integrator->FindSegments(part, segments);
            return IntegrateShaded(
              part, segments, function, gradients, &material,
              [](double length) { return std::min(0.2 + 0.2 * length, 1.0); }, 40);
          });
      },
      "lit medium");
  }
}

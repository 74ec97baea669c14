// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Global illumination: shadows of lights, occlusion of the ambient light, and scattering.
#include "ComparisonSheet.h"
#include "OpticsTruth.h"

#include <vtkLightCollection.h>

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

/** Number of shadow casts of a mapper so far. */
int CastsOf(vtkTetrahedraRayCastMapper* mapper)
{
  return static_cast<int>(mapper->GetStatistic("NumberOfShadowCasts"));
}

/** A medium that only scatters light: its colour times the light that reaches a place. */
vtkSmartPointer<vtkVolumeProperty> MakeScatteringProperty(double attenuation)
{
  auto property = MakeConstantProperty(1.0, 1.0, 0.5, 0.25, 1.0 / attenuation);
  property->ShadeOn();
  property->SetAmbient(0.0);
  property->SetDiffuse(1.0);
  property->SetSpecular(0.0);
  return property;
}

/** Length of the ray from a point in the cube [-1, 1]^3 to its border. */
double LengthInCube(const Vector3& place, const Vector3& direction)
{
  double length = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    if (direction[i] != 0.0)
    {
      length = std::min(length, ((direction[i] > 0.0 ? 1.0 : -1.0) - place[i]) / direction[i]);
    }
  }
  return std::max(length, 0.0);
}

/** Largest error of a picture of the cube along x, with light from above, in n^3 cubes. */
double ErrorOfCube(int n, double attenuation)
{
  const Grid grid = MakeBlock(n, ConstantField(1.0));
  RayCastScene scene(grid, MakeScatteringProperty(attenuation), 33, 33);
  scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
  scene.GetRayCaster()->SetVolumetricScatteringBlending(2.0f);
  scene.GetRayCaster()->SetEarlyTerminationOpacity(1.0);
  AddParallelLight(scene.GetRenderer(), 0.0, 0.0, 1.0);
  LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), 0);
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  double largest = 0.0;
  int visible = 0;
  for (const auto& [y, x] : Product(image.Height, image.Width))
  {
    const Ray ray = rays.GetRay(x, y);
    const Vector3 place{ 0.0, ray.Origin[1], ray.Origin[2] };
    if (std::max(std::fabs(place[1]), std::fabs(place[2])) > 0.999)
    {
      continue;
    }
    const double truth = std::exp(-attenuation * LengthInCube(place, { 0.0, 0.0, 1.0 })) *
      (1.0 - std::exp(-2.0 * attenuation));
    largest = std::max(largest, std::fabs(image.GetPixel(x, y)[0] - truth));
    ++visible;
  }
  EXPECT_GT(visible, 100);
  return largest;
}

/** Optical depth along a ray. */
double OpticalDepth(const ReferenceRayIntegrator& integrator,
  const ReferenceTransferFunction& function, const Vector3& from, const Vector3& direction,
  double length, std::vector<RaySegment>& segments)
{
  Ray ray{};
  ray.Origin = from;
  ray.Direction = direction;
  ray.Begin = 0.0;
  ray.End = length;
  integrator.FindSegments(ray, segments);
  const auto color = ReferenceRayIntegrator::Integrate(ray, segments, function);
  return -std::log(std::max(1.0 - color[3], 1e-30));
}

} // anonymous namespace

// The transmittance of the light is linear in cells: an error of the second order in their size.
TEST(TetrahedraRayCastShadows, CubeHasClosedForm)
{
  constexpr double attenuation = 0.4;
  double before = 0.0;
  for (const int n : { 2, 4, 8 })
  {
    const double error = ErrorOfCube(n, attenuation);
    const double depth = attenuation * 2.0 / n;
    // At most depth^2 / 8 along an edge, and 2^-11 of the cell for the start of lines.
    EXPECT_LE(error, depth * depth / 8.0 + depth / 2048.0) << n;
    if (before > 0.0)
    {
      EXPECT_LE(error, 0.35 * before) << n;
    }
    before = error;
  }
  EXPECT_LE(ErrorOfCube(8, attenuation), 1.0e-3) << "at an optical depth of 0.1 per cell";
}

TEST(TetrahedraRayCastShadows, OffByDefaultAndClamped)
{
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  EXPECT_EQ(mapper->GetGlobalIlluminationReach(), 0.0f);
  EXPECT_EQ(mapper->GetVolumetricScatteringBlending(), 0.0f);
  const float values[][3] = { { -1.0f, 0.0f, 0.0f }, { 0.25f, 0.25f, 0.25f }, { 7.0f, 1.0f, 2.0f },
    { std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f } };
  for (const auto& value : values)
  {
    mapper->SetGlobalIlluminationReach(value[0]);
    mapper->SetVolumetricScatteringBlending(value[0]);
    EXPECT_EQ(mapper->GetGlobalIlluminationReach(), value[1]);
    EXPECT_EQ(mapper->GetVolumetricScatteringBlending(), value[2]);
  }
}

// Shadows are cast again only if something changed that they depend on.
TEST(TetrahedraRayCastShadows, WorkFollowsChanges)
{
  const Grid grid = MakeBlock(4, WavyField(2.0));
  const double range[2] = { -1.0, 1.0 };
  const auto property = MakeProperty(FunctionKind::Smooth, range, 3.0);
  property->ShadeOn();
  RayCastScene scene(grid, property, 32, 32);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  vtkRenderer* renderer = scene.GetRenderer();
  const auto light = AddParallelLight(renderer, 1.0, 2.0, 3.0);
  const auto lamp = AddParallelLight(renderer, 0.0, 0.0, 2.0);
  lamp->PositionalOn();
  LookAt(renderer, grid->GetBounds(), 30.0, 20.0);
  int casts = 0;
  const auto expectCasts = [&](int expected, const char* change)
  {
    scene.GetWindow()->Render();
    const int now = CastsOf(mapper);
    EXPECT_EQ(now - casts, expected) << change;
    casts = now;
  };
  constexpr int ambient = 32;
  expectCasts(0, "off");
  mapper->SetGlobalIlluminationReach(1.0f);
  expectCasts(2 + ambient, "on");
  expectCasts(0, "nothing");
  renderer->GetActiveCamera()->Azimuth(20.0);
  expectCasts(0, "camera");
  light->SetIntensity(0.5);
  expectCasts(0, "intensity of a light");
  light->SetPosition(3.0, 2.0, 1.0);
  expectCasts(1, "a light at infinity");
  lamp->SetPosition(0.0, 0.5, 2.0);
  expectCasts(1, "a lamp");
  double node[6];
  property->GetRGBTransferFunction()->GetNodeValue(1, node);
  node[1] = 1.0 - node[1];
  property->GetRGBTransferFunction()->SetNodeValue(1, node);
  expectCasts(0, "colours");
  mapper->SetVolumetricScatteringBlending(1.0f);
  expectCasts(0, "scattering");
  property->GetScalarOpacity()->AddPoint(0.3, 0.7);
  expectCasts(2 + ambient, "opacity");
  grid->GetPointData()->GetScalars()->SetComponent(5, 0, 0.9);
  grid->GetPointData()->GetScalars()->Modified();
  grid->Modified();
  expectCasts(2 + ambient, "scalars");
  grid->GetPoints()->SetPoint(0, -1.2, -1.0, -1.0);
  grid->GetPoints()->Modified();
  grid->Modified();
  expectCasts(2 + ambient, "points");
  AddClippingPlane(mapper, { { 0.0, 0.0, -1.0 }, {} });
  expectCasts(2 + ambient, "a clipping plane");
  mapper->SetGlobalIlluminationReach(0.5f);
  expectCasts(2 + ambient, "reach");
  scene.GetVolume()->SetOrientation(0.0, 0.0, 30.0);
  expectCasts(2 + ambient, "orientation of the volume");
  scene.GetVolume()->SetPosition(0.1, 0.0, 0.0);
  expectCasts(1, "position of the volume: the lamp alone");
  mapper->SetGlobalIlluminationReach(0.0f);
  expectCasts(0, "off again");
}

// Scalars of cells have no gradient: all their light is scattered, whatever the blending. The upper
// half of the cube is twice as dense as the lower one.
TEST(TetrahedraRayCastShadows, ScalarsOfCellsHaveClosedForm)
{
  const Grid grid = MakeBlock(8, ConstantField(0.0));
  vtkNew<vtkDoubleArray> values;
  values->SetName("half");
  double bounds[6];
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    grid->GetCellBounds(cell, bounds);
    values->InsertNextValue(bounds[4] + bounds[5] > 0.0 ? 1.0 : 0.0);
  }
  grid->GetCellData()->SetScalars(values);
  constexpr double dense = 0.4;
  const auto property = MakeScatteringProperty(dense);
  SetPoints(property->GetScalarOpacity(), { { 0.0, 0.5 }, { 1.0, 1.0 } });
  RayCastScene scene(grid, property, 33, 33);
  scene.GetRayCaster()->SetScalarModeToUseCellData();
  scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
  scene.GetRayCaster()->SetEarlyTerminationOpacity(1.0);
  AddParallelLight(scene.GetRenderer(), 0.0, 0.0, 1.0);
  LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), 0);
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  int visible = 0;
  for (const auto& [y, x] : Product(image.Height, image.Width))
  {
    const Ray ray = rays.GetRay(x, y);
    const double z = ray.Origin[2];
    if (std::max(std::fabs(ray.Origin[1]), std::fabs(z)) > 0.999 || std::fabs(z) < 1e-3)
    {
      continue;
    }
    const double above = z > 0.0 ? dense * (1.0 - z) : dense * (1.0 - 0.5 * z);
    const double depth = z > 0.0 ? 2.0 * dense : dense;
    // At most depth^2 / 8 along an edge, and 2^-11 of the cell for the start of lines.
    ASSERT_NEAR(image.GetPixel(x, y)[0], std::exp(-above) * (1.0 - std::exp(-depth)),
      0.1 * 0.1 / 8.0 + 0.1 / 2048.0)
      << z;
    ++visible;
  }
  EXPECT_GT(visible, 100);

  const int casts = CastsOf(scene.GetRayCaster());
  scene.GetRenderer()->GetActiveCamera()->Azimuth(10.0);
  scene.GetWindow()->Render();
  EXPECT_EQ(CastsOf(scene.GetRayCaster()), casts) << "a camera changes no shadow";
  values->SetValue(0, 0.5);
  values->Modified();
  grid->Modified();
  scene.GetWindow()->Render();
  EXPECT_EQ(CastsOf(scene.GetRayCaster()), casts + 1 + 32) << "a value of a cell does";
}

// A clipped half casts no shadow.
TEST(TetrahedraRayCastShadows, ClippedPartCastsNoShadow)
{
  const Grid grid = MakeBlock(8, ConstantField(1.0));
  constexpr double attenuation = 0.5;
  RayCastScene scene(grid, MakeScatteringProperty(attenuation), 33, 33);
  scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
  scene.GetRayCaster()->SetVolumetricScatteringBlending(2.0f);
  AddClippingPlane(scene.GetRayCaster(), { { 0.0, 0.0, -1.0 }, { 0.0, 0.0, 0.1 } });
  AddParallelLight(scene.GetRenderer(), 0.0, 0.0, 1.0);
  LookAlongAxis(scene.GetRenderer(), grid->GetBounds(), 0);
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  for (int y = 0; y < image.Height; ++y)
  {
    const Ray ray = rays.GetRay(16, y);
    const double z = ray.Origin[2];
    if (std::fabs(z + 0.475) < 0.5 && std::fabs(ray.Origin[1]) < 0.999)
    {
      const double truth =
        std::exp(-attenuation * (0.1 - z)) * (1.0 - std::exp(-2.0 * attenuation));
      // Vertices of the cells at the plane are lit as on its other side.
      EXPECT_NEAR(image.GetPixel(16, y)[0], truth, z > -0.25 ? 0.06 : 4.0e-3) << z;
    }
  }
}

// Lights anywhere, none, and too many.
TEST(TetrahedraRayCastShadows, LightsAnywhere)
{
  const Grid grid = MakeBlock(3, WavyField(2.0));
  const double range[2] = { -1.0, 1.0 };
  const auto property = MakeProperty(FunctionKind::Smooth, range, 3.0);
  property->ShadeOn();
  for (const int number : { 0, 1, 16, 30 })
  {
    RayCastScene scene(grid, property, 24, 24);
    scene.GetRenderer()->AutomaticLightCreationOff();
    scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
    scene.GetRayCaster()->SetVolumetricScatteringBlending(1.0f);
    for (int i = 0; i < number; ++i)
    {
      const auto light =
        AddParallelLight(scene.GetRenderer(), std::cos(1.0 * i), std::sin(1.0 * i), 0.1 * i - 1.0);
      light->SetIntensity(1.0 / number);
      light->SetPositional(i % 3 != 0 ? 1 : 0);
      if (i == 1)
      {
        light->SetPosition(1.0 / 3.0, 1.0 / 3.0, -1.0 / 3.0); // a vertex
      }
      else if (i == 2)
      {
        light->SetPosition(0.0, 0.0, 0.0); // in a cell, at its focus
      }
      else if (i == 4)
      {
        light->SetPosition(std::numeric_limits<double>::infinity(), 0.0, 0.0);
      }
    }
    LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 20.0);
    if (number > 16)
    {
      const auto observer = ObserveErrors(scene.GetRayCaster());
      scene.GetWindow()->Render();
      EXPECT_TRUE(HasText(observer->GetText(), "30 lights exceed the limit of 16"));
      continue;
    }
    const FloatImage image = scene.RenderFloat();
    float largest = 0.0f;
    for (const float value : image.Rgba)
    {
      ASSERT_TRUE(std::isfinite(value)) << number;
      largest = std::max(largest, value);
    }
    EXPECT_GT(largest, 0.01f) << number;
  }
}

// One cell; no opacity anywhere; scalars missing in a part.
TEST(TetrahedraRayCastShadows, OddMeshes)
{
  const double range[2] = { -1.0, 1.0 };
  const auto property = MakeProperty(FunctionKind::Smooth, range, 1.0);
  property->ShadeOn();
  const auto expectFinite = [](RayCastScene& scene, bool visible)
  {
    scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
    AddParallelLight(scene.GetRenderer(), 1.0, 1.0, 1.0);
    LookAt(scene.GetRenderer(), scene.MakeGrid()->GetBounds(), 30.0, 20.0);
    const FloatImage image = scene.RenderFloat();
    float largest = 0.0f;
    for (const float value : image.Rgba)
    {
      ASSERT_TRUE(std::isfinite(value));
      largest = std::max(largest, value);
    }
    EXPECT_EQ(largest > 0.0f, visible);
  };
  RayCastScene one(MakeSingleTetrahedron(LinearField(1.0, 0.5, 0.2)), property, 24, 24);
  expectFinite(one, true);
  const auto clear = MakeConstantProperty(0.0, 1.0, 1.0, 1.0, 1.0);
  clear->ShadeOn();
  RayCastScene none(MakeBlock(2, WavyField(2.0)), clear, 24, 24);
  expectFinite(none, false);
  const Grid holes = MakeBlock(4, WavyField(2.0));
  for (vtkIdType i = 0; i < holes->GetNumberOfPoints(); i += 9)
  {
    holes->GetPointData()->GetScalars()->SetComponent(
      i, 0, std::numeric_limits<double>::quiet_NaN());
  }
  RayCastScene some(holes, property, 24, 24);
  expectFinite(some, true);
}

// A user who aborts sees no picture; the next frame goes on.
TEST(TetrahedraRayCastShadows, AbortedCastGoesOn)
{
  const Grid grid = MakeBlock(3, WavyField(2.0));
  const double range[2] = { -1.0, 1.0 };
  const auto property = MakeProperty(FunctionKind::Smooth, range, 3.0);
  property->ShadeOn();
  RayCastScene scene(grid, property, 24, 24);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  AddParallelLight(scene.GetRenderer(), 1.0, 1.0, 1.0);
  scene.GetWindow()->Render();
  mapper->SetGlobalIlluminationReach(1.0f);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void* progress)
    {
      if (*static_cast<double*>(progress) > 0.5)
      {
        static_cast<vtkTetrahedraRayCastMapper*>(caller)->SetAbortExecute(1);
      }
    });
  const unsigned long tag = mapper->AddObserver(vtkCommand::ProgressEvent, abort);
  scene.GetWindow()->Render();
  const int casts = CastsOf(mapper);
  EXPECT_GT(casts, 10);
  EXPECT_LT(casts, 33);
  mapper->RemoveObserver(tag);
  scene.GetWindow()->Render();
  EXPECT_EQ(CastsOf(mapper), 33);
}

namespace
{

/** The directions of ambient light: see FibonacciDirection() of the kernel. */
std::vector<Vector3> AmbientDirections()
{
  constexpr int count = 32;
  std::vector<Vector3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double height = 1.0 - (2.0 * i + 1.0) / count;
    const double radius = std::sqrt(1.0 - height * height);
    const double angle = 2.399963229728653 * i;
    const double v[3] = { radius * std::cos(angle), radius * std::sin(angle), height };
    const double size = std::sqrt(14.0);
    const double axis[3] = { 1.0 / size, 2.0 / size, 3.0 / size };
    const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    double turned[3];
    for (int k = 0; k < 3; ++k)
    {
      const int l = (k + 1) % 3;
      const int m = (k + 2) % 3;
      turned[k] = v[k] * std::cos(1.0) + (axis[l] * v[m] - axis[m] * v[l]) * std::sin(1.0) +
        axis[k] * along * (1.0 - std::cos(1.0));
    }
    // The depth of the frame is along -z.
    directions.push_back({ turned[0], turned[1], -turned[2] });
  }
  return directions;
}

/** Errors of the pixels that show something, as shares of full scale. */
struct ShadowErrors
{
  double Rms = 0.0;
  double Within = 0.0;
  int Visible = 0;
};

/**
 * Compares every `step`-th pixel with shadow rays from each place on its ray.
 * @param sheet gets the picture, the reference and ten times the difference; null for none.
 */
ShadowErrors CompareToShadowRays(RayCastScene& scene, vtkUnstructuredGrid* grid,
  vtkVolumeProperty* property, int step, meniscus::test::ComparisonSheet* sheet)
{
  const FloatImage image = scene.RenderFloat();
  const PixelRays rays(scene.GetRenderer());
  const auto integrator = MakeReference(grid);
  const auto function = ToReference(property);
  const ReferenceGradients gradients(integrator->MakeMesh(), true);
  const Material material = ToMaterial(property, scene.GetRenderer());
  const double length = 2.0 * DiagonalOf(grid->GetBounds());
  const std::vector<Vector3> ambient = AmbientDirections();
  std::vector<RaySegment> shadow;
  const auto materialAt = [&](const Vector3& x)
  {
    Material here = material;
    double open = 0.0;
    for (const Vector3& direction : ambient)
    {
      open += std::exp(-OpticalDepth(*integrator, function, x, direction, length, shadow)) / 32.0;
    }
    here.Ambient *= open;
    for (Light& light : here.Lights)
    {
      const double size = MakeLength(light.Place);
      const Vector3 direction{ light.Place[0] / size, light.Place[1] / size,
        light.Place[2] / size };
      const double reached =
        std::exp(-OpticalDepth(*integrator, function, x, direction, length, shadow));
      for (int c = 0; c < 3; ++c)
      {
        light.Diffuse[c] *= reached;
        light.Specular[c] *= reached;
      }
    }
    return here;
  };
  ShadowErrors errors;
  int within = 0;
  std::vector<RaySegment> segments;
  for (int y = step / 2; y < image.Height; y += step)
  {
    for (int x = step / 2; x < image.Width; x += step)
    {
      const Ray ray = rays.GetRay(x, y);
      integrator->FindSegments(ray, segments);
      std::array<double, 3> total{};
      double transmittance = 1.0;
      for (const RaySegment& segment : segments)
      {
        if (transmittance < 1e-3)
        {
          break;
        }
        // The material of the segment's middle, and the medium exactly.
        const double middle = 0.5 * (segment.Begin + segment.End);
        Vector3 place;
        for (int i = 0; i < 3; ++i)
        {
          place[i] = ray.Origin[i] + middle * ray.Direction[i];
        }
        const auto emitted = ReferenceRayIntegrator::Integrate(ray, { segment }, function);
        if (emitted[3] < 1e-9)
        {
          continue;
        }
        const std::array<double, 3> color{ emitted[0] / emitted[3], emitted[1] / emitted[3],
          emitted[2] / emitted[3] };
        const auto lit =
          Shade(materialAt(place), ray, place, gradients.At(segment.Cell, place), color);
        for (int c = 0; c < 3; ++c)
        {
          total[c] += transmittance * emitted[3] * lit[c];
        }
        transmittance *= 1.0 - emitted[3];
      }
      if (transmittance > 0.999)
      {
        continue;
      }
      double largest = 0.0;
      double sum = 0.0;
      for (int c = 0; c < 3; ++c)
      {
        const double error = std::fabs(image.GetPixel(x, y)[c] - total[c]);
        largest = std::max(largest, error);
        sum += error * error / 3.0;
      }
      if (sheet)
      {
        const auto colorOf = [&](const auto& channel)
        { return glm::dvec3(channel(0), channel(1), channel(2)); };
        const auto drawn = [&](int c) { return image.GetPixel(x, y)[c] + transmittance; };
        const auto traced = [&](int c) { return total[c] + transmittance; };
        const auto change = [&](int c) { return 1.0 - 10.0 * std::fabs(drawn(c) - traced(c)); };
        sheet->SetPixel(0, 0, x / step, y / step, colorOf(drawn));
        sheet->SetPixel(0, 1, x / step, y / step, colorOf(traced));
        sheet->SetPixel(0, 2, x / step, y / step, colorOf(change));
      }
      errors.Rms += sum;
      within += largest <= 0.03 ? 1 : 0;
      ++errors.Visible;
    }
  }
  errors.Rms = std::sqrt(errors.Rms / std::max(errors.Visible, 1));
  errors.Within = static_cast<double>(within) / std::max(errors.Visible, 1);
  return errors;
}

struct ShadowCase
{
  const char* Mesh;
  /** Pixels on a side, and step between those compared. */
  int Size;
  int Step;
};

void PrintTo(const ShadowCase& tested, std::ostream* os)
{
  *os << tested.Mesh;
}

class TetrahedraRayCastShadowRays : public ::testing::TestWithParam<ShadowCase>
{
};

} // anonymous namespace

// One light with shadows and 32 directions of ambient light, against shadow rays from every cell
// that a pixel's ray crosses. With the environment variable MENISCUS_TEST_SHADOW_STEP, every such
// pixel is compared, and shadows-MESH.png in the folder of temporary files shows both and their
// difference: 1 takes minutes.
TEST_P(TetrahedraRayCastShadowRays, MatchesBruteForce)
{
  const std::string mesh = GetParam().Mesh;
  const Grid grid = mesh == "block" ? MakeBlock(24, WavyField(2.0)) : ReadDataMesh(mesh);
  if (!grid)
  {
    GTEST_SKIP() << mesh << ".vtu not found: set MENISCUS_DATA_DIR";
  }
  const auto property = MakeProperty(FunctionKind::Smooth, grid, DiagonalOf(grid->GetBounds()));
  property->ShadeOn();
  property->SetAmbient(0.4);
  property->SetDiffuse(0.6);
  property->SetSpecular(0.2);
  RayCastScene scene(grid, property, GetParam().Size, GetParam().Size);
  scene.GetRayCaster()->SetGlobalIlluminationReach(1.0f);
  AddParallelLight(scene.GetRenderer(), 1.0, 2.0, 3.0);
  const char* const wanted = std::getenv("MENISCUS_TEST_SHADOW_STEP");
  const int step = wanted ? std::max(std::atoi(wanted), 1) : GetParam().Step;
  std::unique_ptr<meniscus::test::ComparisonSheet> sheet;
  if (wanted)
  {
    const std::vector<std::string> titles{ "drawn", "shadow rays", "10 x difference" };
    sheet = std::make_unique<meniscus::test::ComparisonSheet>(
      std::vector<std::string>{ mesh }, titles, GetParam().Size / step);
  }
  const ShadowErrors errors = CompareToShadowRays(scene, grid, property, step, sheet.get());
  if (sheet)
  {
    sheet->Write(std::string(MENISCUS_TEMPORARY_DIR) + "/shadows-" + mesh + ".png");
  }
  std::ostringstream text;
  text << mesh << ": RMS " << errors.Rms << ", within 3 %: " << errors.Within << " of "
       << errors.Visible;
  RecordProperty("Errors", text.str());
  SCOPED_TRACE(text.str());
  EXPECT_GT(errors.Visible, 8);
  EXPECT_LE(errors.Rms, 0.01);
  EXPECT_GE(errors.Within, 0.99);
}

INSTANTIATE_TEST_SUITE_P(Meshes, TetrahedraRayCastShadowRays,
  ::testing::Values(ShadowCase{ "block", 64, 7 }, ShadowCase{ "blunt_fin", 64, 9 },
    ShadowCase{ "combustor", 64, 9 }),
  [](const auto& tested) { return std::string(tested.param.Mesh); });

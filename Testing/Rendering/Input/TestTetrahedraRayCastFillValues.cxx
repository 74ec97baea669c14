// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Fill values far outside of the transfer function's range at a few vertices: the rest of the image
// must be right, in every mode.
#include "OpticsTruth.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 72;
constexpr double Range[2] = { -1.0, 1.0 };
// A fraction of pixels may have an error of more than two levels of 255.
constexpr double TwoLevels = 2.0 / 255.0;
constexpr double LargestShare = 0.005;

struct Fill
{
  double First;
  double Second; // 0: none
};

const std::vector<Fill> Fills = { { 1.0e6, 0.0 }, { -1.0e6, 0.0 }, { 1.0e10, 0.0 }, { 1.0e20, 0.0 },
  { -1.0e20, 0.0 }, { 9.97e36, 0.0 }, { -1.0e36, 0.0 }, { 1.0e36, -1.0e36 }, { 1.0e36, -1.0e34 },
  { 1.0e300, 0.0 } };

// Fill values for the reference, reduced to 1e8 in the same proportion: larger values do not affect
// anything visible, and in double precision weights rounded to 1e-16 times 1e36 would also exceed
// the scalars.
Fill ForTruth(const Fill& fill)
{
  const double largest = std::max(std::fabs(fill.First), std::fabs(fill.Second));
  const double factor = std::min(1.0, 1.0e8 / largest);
  return { factor * fill.First, factor * fill.Second };
}

Grid MakeFilled(const Fill& fill)
{
  const Grid grid = MakeBlock(6, WavyField(3.0));
  vtkNew<vtkDoubleArray> scalars;
  scalars->DeepCopy(grid->GetPointData()->GetScalars());
  scalars->SetName(ScalarName);
  // Points inside of the block and on its boundary.
  scalars->SetValue(171, fill.First);
  scalars->SetValue(30, fill.First);
  if (fill.Second != 0.0)
  {
    scalars->SetValue(250, fill.Second);
  }
  grid->GetPointData()->SetScalars(scalars);
  return grid;
}

vtkSmartPointer<vtkVolumeProperty> MakeFunction(bool shade)
{
  auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  SetMaterial(property, shade);
  property->GetIsoSurfaceValues()->SetValue(0, 0.45);
  property->GetIsoSurfaceValues()->SetValue(1, -0.3);
  return property;
}

using SceneMaker = std::function<void(RayCastScene& scene)>;
using TraceMaker = std::function<TraceRay(RayCastScene& scene,
  const ReferenceRayIntegrator& integrator, const ReferenceGradients& gradients)>;

// Compares the mapper's image for each fill value with the exact one.
void ExpectFills(const std::string& mode, vtkVolumeProperty* property, const SceneMaker& prepare,
  const TraceMaker& makeTrace, double tolerance = TwoLevels)
{
  for (const Fill& fill : Fills)
  {
    const Grid grid = MakeFilled(fill);
    RayCastScene scene(grid, property, Size, Size);
    AddParallelLight(scene.GetRenderer(), 4.0, 2.0, 1.0);
    prepare(scene);
    scene.GetWindow()->Render();
    const Grid trueGrid = MakeFilled(ForTruth(fill));
    const auto integrator = MakeReference(trueGrid);
    const ReferenceGradients gradients(integrator->MakeMesh(), false);
    const FloatImage image = scene.RenderFloat();
    const TracedComparison comparison = CompareToTrace(image, PixelRays(scene.GetRenderer()),
      makeTrace(scene, *integrator, gradients), tolerance, 0.0);
    std::ostringstream text;
    text << mode << ", fill " << fill.First << ", " << fill.Second << ": " << comparison.GetText();
    const std::string what = text.str();
    EXPECT_GT(comparison.Visible, 1000u) << what;
    EXPECT_LE(
      static_cast<double>(comparison.Wrong), LargestShare * static_cast<double>(comparison.Visible))
      << what;
    EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0) << what;
  }
}

TraceRay TraceMedium(RayCastScene& scene, const ReferenceRayIntegrator& integrator,
  const ReferenceGradients& gradients, const std::function<double(double)>& factor)
{
  const auto function = ToReference(scene.GetVolume()->GetProperty());
  const bool lit = scene.GetVolume()->GetProperty()->GetShade() != 0;
  const Material material = ToMaterial(scene.GetVolume()->GetProperty(), scene.GetRenderer());
  return [=, &integrator, &gradients](const Ray& ray)
  {
    std::vector<RaySegment> segments;
    integrator.FindSegments(ray, segments);
    return IntegrateShaded(
      ray, segments, function, gradients, lit ? &material : nullptr, factor, 16);
  };
}

double GradientFactor(double size)
{
  return std::min(std::max((size - 0.5) / 2.0, 0.0), 1.0) * 0.9 + 0.05;
}

} // anonymous namespace

TEST(TetrahedraRayCastFillValues, Composite)
{
  for (const FunctionKind kind : { FunctionKind::Smooth, FunctionKind::Peaked })
  {
    const auto property = MakeProperty(kind, Range, 3.4);
    ExpectFills(
      kind == FunctionKind::Smooth ? "smooth" : "peaked", property, [](RayCastScene&) {},
      [](RayCastScene& scene, const ReferenceRayIntegrator& integrator, const ReferenceGradients&)
      {
        const auto function = ToReference(scene.GetVolume()->GetProperty());
        return [function, &integrator](const Ray& ray) { return integrator.Trace(ray, function); };
      });
  }
}

TEST(TetrahedraRayCastFillValues, PreIntegrated)
{
  const auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  ExpectFills(
    "pre-integrated", property,
    [](RayCastScene& scene)
    { scene.GetRayCaster()->SetIntegration(vtkTetrahedraRayCastMapper::PRE_INTEGRATED); },
    [](RayCastScene& scene, const ReferenceRayIntegrator& integrator, const ReferenceGradients&)
    {
      const auto function = ToReference(scene.GetVolume()->GetProperty());
      return [function, &integrator](const Ray& ray) { return integrator.Trace(ray, function); };
    });
}

TEST(TetrahedraRayCastFillValues, LightInTheMedium)
{
  const auto property = MakeFunction(true);
  ExpectFills(
    "lit", property,
    [](RayCastScene& scene)
    { scene.GetRayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS); },
    [](RayCastScene& scene, const ReferenceRayIntegrator& integrator,
      const ReferenceGradients& gradients)
    { return TraceMedium(scene, integrator, gradients, nullptr); });
}

TEST(TetrahedraRayCastFillValues, GradientOpacity)
{
  const auto property = MakeFunction(false);
  property->SetGradientOpacity(
    MakeOpacity({ { 0.5, GradientFactor(0.5) }, { 2.5, GradientFactor(2.5) } }));
  ExpectFills(
    "gradient opacity", property,
    [](RayCastScene& scene)
    { scene.GetRayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS); },
    [](RayCastScene& scene, const ReferenceRayIntegrator& integrator,
      const ReferenceGradients& gradients)
    { return TraceMedium(scene, integrator, gradients, GradientFactor); });
}

TEST(TetrahedraRayCastFillValues, Isosurfaces)
{
  const auto property = MakeFunction(true);
  ExpectFills(
    "isosurfaces", property,
    [](RayCastScene& scene)
    {
      scene.GetRayCaster()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
      scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
    },
    [](RayCastScene& scene, const ReferenceRayIntegrator& integrator,
      const ReferenceGradients& gradients)
    {
      const std::vector<Surface> surfaces = ToSurfaces(scene.GetVolume()->GetProperty());
      const Material material = ToMaterial(scene.GetVolume()->GetProperty(), scene.GetRenderer());
      return [=, &integrator, &gradients](const Ray& ray)
      {
        std::vector<RaySegment> segments;
        integrator.FindSegments(ray, segments);
        return BlendSurfaces(ray, segments, surfaces, &gradients, material);
      };
    });
}

TEST(TetrahedraRayCastFillValues, Projections)
{
  const auto property = MakeFunction(false);
  for (const ProjectionMode& mode : ProjectionModes)
  {
    ExpectFills(
      mode.Name, property,
      [&mode](RayCastScene& scene) { scene.GetRayCaster()->SetBlendMode(mode.Number); },
      [&mode](
        RayCastScene& scene, const ReferenceRayIntegrator& integrator, const ReferenceGradients&)
      {
        const auto function = FunctionOf(mode, scene.GetVolume()->GetProperty());
        std::array<double, 2> range{ 0.0, 0.0 };
        for (const auto& [c, i] :
          Product(Below<std::size_t>(integrator.MakeMesh().GetNumberOfCells()), 4))
        {
          const double scalar =
            integrator.MakeMesh().GetScalar(integrator.MakeMesh().GetCell(c)[i]);
          range = { std::min(range[0], scalar), std::max(range[1], scalar) };
        }
        return [=, &mode, &integrator](const Ray& ray)
        {
          std::vector<RaySegment> segments;
          integrator.FindSegments(ray, segments);
          return Project(ray, segments, mode.Truth, function, range.data());
        };
      });
  }
}

TEST(TetrahedraRayCastFillValues, CellData)
{
  // A cell has one value: all fill values outside the function's range give exactly the same image.
  const auto property = MakeFunction(true);
  for (const int mode : { vtkVolumeMapper::COMPOSITE_BLEND, vtkVolumeMapper::ISOSURFACE_BLEND })
  {
    FloatImage images[3];
    const double fills[3] = { 3.0, 1.0e10, 1.0e36 };
    for (int i = 0; i < 3; ++i)
    {
      const Grid grid = MakeBlock(5, WavyField(3.0));
      grid->GetPointData()->Initialize();
      grid->GetCellData()->SetScalars(MakeArray(nullptr, grid->GetNumberOfCells(),
        [&](vtkIdType c)
        { return c % 97 == 5 ? fills[i] : std::sin(0.37 * static_cast<double>(c)); }));
      RayCastScene scene(grid, property, Size, Size);
      scene.GetRayCaster()->SetBlendMode(mode);
      images[i] = scene.RenderFloat();
    }
    ExpectSamePicture(images[0], images[1], "1e10");
    ExpectSamePicture(images[0], images[2], "1e36");
  }
}

TEST(TetrahedraRayCastFillValues, Components)
{
  // Fill values in either component. In a cell with a fill value, the rest of the function covers
  // 1e-5 of the cell for the first and 1e-36 for the second.
  const auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  const auto second = MakeProperty(FunctionKind::Peaked, Range, 3.4);
  property->SetColor(1, second->GetRGBTransferFunction());
  property->SetScalarOpacity(1, second->GetScalarOpacity());
  property->SetScalarOpacityUnitDistance(1, second->GetScalarOpacityUnitDistance());
  FloatImage images[2];
  const double fills[2] = { 1.0e5, 1.0e36 };
  for (int i = 0; i < 2; ++i)
  {
    const Grid grid = MakeBlock(6, WavyField(3.0));
    vtkDataArray* scalars = grid->GetPointData()->GetScalars();
    vtkNew<vtkDoubleArray> pairs;
    pairs->SetNumberOfComponents(2);
    pairs->SetNumberOfTuples(grid->GetNumberOfPoints());
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      const double scalar = scalars->GetComponent(p, 0);
      pairs->SetTuple2(p, p == 171 ? fills[i] : scalar, p == 30 ? -fills[i] : 0.5 - scalar);
    }
    grid->GetPointData()->SetScalars(pairs);
    RayCastScene scene(grid, property, Size, Size);
    images[i] = scene.RenderFloat();
  }
  ASSERT_EQ(images[0].Rgba.size(), images[1].Rgba.size());
  float opacity = 0.0f;
  for (std::size_t i = 0; i < images[0].Rgba.size(); ++i)
  {
    ASSERT_NEAR(images[0].Rgba[i], images[1].Rgba[i], 2e-4) << i;
    opacity = std::max(opacity, images[0].Rgba[i]);
  }
  EXPECT_GT(opacity, 0.5f);
}

TEST(TetrahedraRayCastFillValues, EditsDoNotResendScalars)
{
  const Grid grid = MakeFilled({ 1.0e20, 0.0 });
  const auto property = MakeProperty(FunctionKind::Smooth, Range, 3.4);
  RayCastScene scene(grid, property, Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  scene.GetWindow()->Render();
  EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), 1);
  // A node moved through the data, and out of it.
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  double last = 0.1;
  opacity->AddPoint(last, 0.9);
  for (const double at : { 0.15, 0.3, 0.5, -0.2, -0.9, -1.3, 1.7, 3.0 })
  {
    opacity->RemovePoint(last);
    opacity->AddPoint(at, 0.9);
    last = at;
    scene.GetWindow()->Render();
    EXPECT_EQ(mapper->GetNumberOfScalarUpdates(), 1) << at;
  }
  // A function at the fill value causes one.
  SetPoints(property->GetScalarOpacity(), { { 0.0, 0.0 }, { 1.0e20, 1.0 } });
  SetPoints(property->GetRGBTransferFunction(), { { 0.0, 1.0, 1.0, 1.0 } });
  scene.GetWindow()->Render();
  scene.GetWindow()->Render();
  EXPECT_LE(mapper->GetNumberOfScalarUpdates(), 2);
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Scalars of several components: independent ones, colour and opacity, and direct colours.
#include "MembraneScene.h"
#include "OpticsTruth.h"
#include "ReferenceComponents.h"

#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

using namespace meniscus::test;
using meniscus::reference::integrateComponents;
using meniscus::reference::Mixture;
using meniscus::reference::Ray;
using meniscus::reference::RaySegment;
using meniscus::reference::ReferenceRayIntegrator;
using meniscus::reference::ReferenceTransferFunction;

namespace
{

constexpr int Size = 128;

// Four unrelated fields, in about [0, 1].
std::vector<Field> fields()
{
  const Field wavy = wavyField(3.0);
  return { [wavy](double x, double y, double z) { return 0.5 + 0.5 * wavy(x, y, z); },
    [](double x, double y, double z) { return std::sqrt((x * x + y * y + z * z) / 3.0); },
    [](double x, double y, double z) { return 0.5 + 0.2 * x - 0.2 * y + 0.1 * z; },
    [wavy](double x, double y, double z) { return 0.5 + 0.5 * wavy(y + 0.4, z, x - 0.3); } };
}

// A block whose active array has some of the fields as components, times a factor.
template <typename Array>
Grid makeComponents(const std::vector<int>& ofFields, double factor)
{
  const Grid grid = makeBlock(6, constantField(0.0));
  vtkNew<Array> array;
  array->SetName(ScalarName);
  array->SetNumberOfComponents(static_cast<int>(ofFields.size()));
  array->SetNumberOfTuples(grid->GetNumberOfPoints());
  const std::vector<Field> all = fields();
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double* x = grid->GetPoint(p);
    for (std::size_t c = 0; c < ofFields.size(); ++c)
    {
      const double value = std::clamp(all[ofFields[c]](x[0], x[1], x[2]), 0.0, 1.0);
      array->SetComponent(p, static_cast<int>(c), factor * value);
    }
  }
  grid->GetPointData()->SetScalars(array);
  return grid;
}

// The reference's mesh with one component, times a factor.
std::unique_ptr<ReferenceRayIntegrator> referenceOf(
  vtkUnstructuredGrid* grid, int component, double factor)
{
  vtkNew<vtkUnstructuredGrid> copy;
  copy->ShallowCopy(grid);
  vtkNew<vtkDoubleArray> values;
  values->SetName(ScalarName);
  values->SetNumberOfTuples(grid->GetNumberOfPoints());
  vtkDataArray* all = grid->GetPointData()->GetScalars();
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    values->SetValue(p, factor * all->GetComponent(p, component));
  }
  copy->GetPointData()->SetScalars(values);
  return makeReference(copy);
}

ReferenceTransferFunction weighted(const ReferenceTransferFunction& function, double weight)
{
  auto nodes = function.nodes();
  for (auto& node : nodes)
  {
    node.Value.Attenuation *= weight;
  }
  return ReferenceTransferFunction(nodes);
}

TracedComparison expectMixture(RayCastScene& scene, Mixture mixture,
  const std::vector<ReferenceTransferFunction>& functions, double colorFactor,
  const std::string& what, const MembraneCase& membrane = MembraneCase())
{
  scene.rayCaster()->SetMembraneData(membrane.Mesh);
  scene.window()->Render();
  std::vector<std::unique_ptr<ReferenceRayIntegrator>> integrators;
  for (int c = 0; c < scene.grid()->GetPointData()->GetScalars()->GetNumberOfComponents(); ++c)
  {
    const bool isColor = mixture == Mixture::RedGreenBlueOpacity && c < 3;
    integrators.push_back(referenceOf(scene.grid(), c, isColor ? colorFactor : 1.0));
  }
  return expectTrace(scene,
    membrane.bend(
      [&](const Ray& ray)
      {
        std::vector<std::vector<RaySegment>> segments(integrators.size());
        for (std::size_t c = 0; c < integrators.size(); ++c)
        {
          integrators[c]->findSegments(ray, segments[c]);
        }
        return integrateComponents(ray, segments, mixture, functions);
      }),
    what);
}

// A property whose components have the functions of some others.
vtkSmartPointer<vtkVolumeProperty> combine(
  const std::vector<vtkSmartPointer<vtkVolumeProperty>>& parts, const std::vector<double>& weights)
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  for (int c = 0; c < static_cast<int>(parts.size()); ++c)
  {
    property->SetColor(c, parts[c]->GetRGBTransferFunction());
    property->SetScalarOpacity(c, parts[c]->GetScalarOpacity());
    property->SetScalarOpacityUnitDistance(c, parts[c]->GetScalarOpacityUnitDistance());
    property->SetComponentWeight(c, weights[c]);
  }
  return property;
}

const std::vector<double> Weights{ 0.7, 1.0, 0.4, 0.25 };

std::vector<vtkSmartPointer<vtkVolumeProperty>> makeParts(int number, FunctionKind kind)
{
  std::vector<vtkSmartPointer<vtkVolumeProperty>> parts;
  for (int c = 0; c < number; ++c)
  {
    const double range[2] = { 0.0 - 0.05 * c, 1.0 + 0.1 * c };
    parts.push_back(makeProperty(c == 1 ? FunctionKind::Sparse : kind, range, 3.4));
    parts.back()->GetRGBTransferFunction()->AddRGBPoint(
      0.31 + 0.1 * c, c == 0, c == 1, 1.0 - 0.3 * c);
  }
  return parts;
}

double largestDifference(const FloatImage& a, const FloatImage& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.Rgba.size(); ++i)
  {
    largest = std::max(largest, std::fabs(double{ a.Rgba[i] } - b.Rgba[i]));
  }
  return largest;
}

} // anonymous namespace

TEST(TetrahedraRayCastComponents, IndependentComponents)
{
  for (const FunctionKind kind :
    { FunctionKind::Smooth, FunctionKind::Peaked, FunctionKind::Opaque })
  {
    for (const int number : { 2, 3, 4 })
    {
      const std::vector<int> ofFields{ 0, 1, 2, 3 };
      const Grid grid = makeComponents<vtkDoubleArray>(
        std::vector<int>(ofFields.begin(), ofFields.begin() + number), 1.0);
      const auto parts = makeParts(number, kind);
      std::vector<ReferenceTransferFunction> functions;
      for (int c = 0; c < number; ++c)
      {
        functions.push_back(weighted(toReference(parts[c]), Weights[c]));
      }
      RayCastScene scene(grid, combine(parts, Weights), Size, Size);
      lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
      expectMixture(scene, Mixture::Independent, functions, 1.0,
        std::to_string(number) + " independent, function " +
          std::to_string(static_cast<int>(kind)));
    }
  }
}

TEST(TetrahedraRayCastComponents, ColorByTheFirstOpacityByTheSecond)
{
  const Grid grid = makeComponents<vtkFloatArray>({ 0, 3 }, 1.0);
  for (const FunctionKind kind :
    { FunctionKind::Smooth, FunctionKind::Peaked, FunctionKind::Opaque })
  {
    const auto part = makeParts(1, kind)[0];
    auto property = combine({ part }, Weights);
    property->IndependentComponentsOff();
    RayCastScene scene(grid, property, Size, Size);
    lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
    const ReferenceTransferFunction function = toReference(part);
    expectMixture(scene, Mixture::ColorAndOpacity, { function, function }, 1.0,
      "colour and opacity, function " + std::to_string(static_cast<int>(kind)));
  }
}

TEST(TetrahedraRayCastComponents, ColorsAsTheyAre)
{
  for (const bool bytes : { true, false })
  {
    const double factor = bytes ? 255.0 : 1.0;
    const Grid grid = bytes ? makeComponents<vtkUnsignedCharArray>({ 0, 1, 2, 3 }, factor)
                            : makeComponents<vtkFloatArray>({ 0, 1, 2, 3 }, factor);
    const double range[2] = { 0.0, factor };
    const auto part = makeProperty(FunctionKind::Smooth, range, 3.4);
    auto property = combine({ part }, Weights);
    property->IndependentComponentsOff();
    RayCastScene scene(grid, property, Size, Size);
    lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
    const ReferenceTransferFunction opacity = toReference(part);
    const ReferenceTransferFunction none;
    expectMixture(scene, Mixture::RedGreenBlueOpacity, { none, none, none, opacity }, 1.0 / factor,
      bytes ? "bytes" : "floats");
  }
}

TEST(TetrahedraRayCastComponents, ThroughAMembrane)
{
  const MembraneCase membranes[] = { makePlaneCase(0.1, 4.0, 2), makeDomeCase(1.4, 4.0, 2.8, 16) };
  for (const MembraneCase& membrane : membranes)
  {
    for (const int number : { 2, 4 })
    {
      const std::vector<int> ofFields{ 0, 1, 2, 3 };
      const Grid grid = makeComponents<vtkDoubleArray>(
        std::vector<int>(ofFields.begin(), ofFields.begin() + number), 1.0);
      const auto parts = makeParts(number, FunctionKind::Smooth);
      std::vector<ReferenceTransferFunction> functions;
      for (int c = 0; c < number; ++c)
      {
        functions.push_back(weighted(toReference(parts[c]), Weights[c]));
      }
      RayCastScene scene(grid, combine(parts, Weights), Size, Size);
      lookAt(scene.renderer(), grid->GetBounds(), 30.0, 50.0);
      expectMixture(scene, Mixture::Independent, functions, 1.0,
        std::to_string(number) + " independent", membrane);
    }
    const auto part = makeParts(1, FunctionKind::Smooth)[0];
    auto property = combine({ part }, Weights);
    property->IndependentComponentsOff();
    const ReferenceTransferFunction function = toReference(part);
    const ReferenceTransferFunction none;
    RayCastScene two(makeComponents<vtkFloatArray>({ 0, 3 }, 1.0), property, Size, Size);
    lookAt(two.renderer(), two.grid()->GetBounds(), 30.0, 50.0);
    expectMixture(
      two, Mixture::ColorAndOpacity, { function, function }, 1.0, "colour and opacity", membrane);
    RayCastScene four(makeComponents<vtkFloatArray>({ 0, 1, 2, 3 }, 1.0), property, Size, Size);
    lookAt(four.renderer(), four.grid()->GetBounds(), 30.0, 50.0);
    expectMixture(four, Mixture::RedGreenBlueOpacity, { none, none, none, function }, 1.0,
      "colours as they are", membrane);
  }
}

TEST(TetrahedraRayCastComponents, ComputeShadersDrawTheSame)
{
  const Grid grid = makeComponents<vtkDoubleArray>({ 0, 1, 2 }, 1.0);
  RayCastScene scene(grid, combine(makeParts(3, FunctionKind::Smooth), Weights), Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const FloatImage fragments = scene.renderFloat();
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::COMPUTE);
  EXPECT_LT(largestDifference(scene.renderFloat(), fragments), 2e-5);
}

TEST(TetrahedraRayCastComponents, PartsOfOneMediumMakeTheWhole)
{
  // The same field four times, with weights that sum up to 1.
  const std::vector<double> shares{ 0.5, 0.25, 0.125, 0.125 };
  const auto part = makeParts(1, FunctionKind::Smooth)[0];
  const Grid one = makeComponents<vtkDoubleArray>({ 0 }, 1.0);
  const Grid four = makeComponents<vtkDoubleArray>({ 0, 0, 0, 0 }, 1.0);
  RayCastScene single(one, part, Size, Size);
  RayCastScene mixed(four, combine({ part, part, part, part }, shares), Size, Size);
  lookAt(single.renderer(), one->GetBounds(), 30.0, 20.0);
  lookAt(mixed.renderer(), one->GetBounds(), 30.0, 20.0);
  EXPECT_LT(largestDifference(mixed.renderFloat(), single.renderFloat()), 2e-5);
}

TEST(TetrahedraRayCastComponents, LightOnDependentComponents)
{
  // Both components are equal: the image is that of one scalar, with the gradient of the second.
  const Grid one = makeComponents<vtkDoubleArray>({ 0 }, 1.0);
  const Grid two = makeComponents<vtkDoubleArray>({ 0, 0 }, 1.0);
  for (const int gradients :
    { vtkTetrahedraRayCastMapper::CELL_GRADIENTS, vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS })
  {
    const auto part = makeParts(1, FunctionKind::Smooth)[0];
    if (gradients == vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS)
    {
      // Varying light times varying colour along a piece is integrated in another way.
      part->GetRGBTransferFunction()->RemoveAllPoints();
      part->GetRGBTransferFunction()->AddRGBPoint(0.0, 0.8, 0.6, 0.4);
    }
    part->ShadeOn();
    part->GetGradientOpacity()->RemoveAllPoints();
    part->GetGradientOpacity()->AddPoint(0.0, 0.2);
    part->GetGradientOpacity()->AddPoint(2.0, 1.0);
    RayCastScene single(one, part, Size, Size);
    vtkNew<vtkVolumeProperty> property;
    property->DeepCopy(part);
    property->IndependentComponentsOff();
    RayCastScene mixed(two, property, Size, Size);
    for (RayCastScene* scene : { &single, &mixed })
    {
      scene->rayCaster()->SetGradients(gradients);
      lookAt(scene->renderer(), one->GetBounds(), 30.0, 20.0);
    }
    EXPECT_LT(largestDifference(mixed.renderFloat(), single.renderFloat()), 5e-5) << gradients;
  }
}

TEST(TetrahedraRayCastComponents, LightOnIndependentOnesWarnsAndIsLeftOut)
{
  const Grid grid = makeComponents<vtkDoubleArray>({ 0, 1 }, 1.0);
  const auto property = combine(makeParts(2, FunctionKind::Smooth), Weights);
  RayCastScene scene(grid, property, Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const FloatImage plain = scene.renderFloat();
  const auto warnings = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  warnings->observe(scene.rayCaster());
  property->ShadeOn();
  EXPECT_EQ(scene.renderFloat().Rgba, plain.Rgba);
  EXPECT_EQ(scene.renderFloat().Rgba, plain.Rgba);
  EXPECT_EQ(warnings->Warnings.size(), 1u);
}

TEST(TetrahedraRayCastComponents, CellsThatSomeComponentShowsAreActive)
{
  // x and y, each visible above 0.5 of [-1, 1]; the third is invisible.
  const Grid grid = makeBlock(8, constantField(0.0));
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double* x = grid->GetPoint(p);
    array->InsertNextTuple3(x[0], x[1], x[2]);
  }
  grid->GetPointData()->SetScalars(array);
  std::vector<vtkSmartPointer<vtkVolumeProperty>> parts;
  for (int c = 0; c < 3; ++c)
  {
    parts.push_back(makeConstantProperty(0.0, c == 0, c == 1, 1, 1.0));
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(-1.0, 0.0);
    opacity->AddPoint(0.5, 0.0);
    opacity->AddPoint(1.0, c < 2 ? 1.0 : 0.0);
    parts.back()->SetScalarOpacity(opacity);
  }
  const std::vector<double> ones(3, 1.0);
  RayCastScene scene(grid, combine(parts, ones), Size, Size);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  scene.window()->Render();
  // Two of the 8 layers along x reach above 0.5, and two along y: 1 - (3/4)^2 of the cubes are
  // visible.
  EXPECT_EQ(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() * 7 / 16);
  expectMixture(scene, Mixture::Independent,
    { toReference(parts[0]), toReference(parts[1]), toReference(parts[2]) }, 1.0, "sparse");
  EXPECT_EQ(scene.rayCaster()->GetNumberOfActiveSetBuilds(), 1);
  // A value that is not finite hides its cells, whichever component it is.
  array->SetComponent(0, 2, std::numeric_limits<double>::quiet_NaN());
  array->SetComponent(grid->GetNumberOfPoints() - 1, 1, std::numeric_limits<double>::infinity());
  array->Modified();
  const auto warnings = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  warnings->observe(scene.rayCaster());
  scene.window()->Render();
  EXPECT_EQ(std::count_if(warnings->Warnings.begin(), warnings->Warnings.end(),
              [](const std::string& text) { return text.find("2 of 729 vert") != text.npos; }),
    1);
  EXPECT_LT(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() * 7 / 16);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfLostRays(), 0);
  // Back to one component.
  scene.rayCaster()->SetVectorMode(vtkTetrahedraRayCastMapper::COMPONENT);
  scene.window()->Render();
  EXPECT_EQ(scene.rayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() / 4);
}

TEST(TetrahedraRayCastComponents, OnlyWhatChangedIsSent)
{
  const Grid grid = makeComponents<vtkDoubleArray>({ 0, 1 }, 1.0);
  const auto property = combine(makeParts(2, FunctionKind::Smooth), Weights);
  RayCastScene scene(grid, property, Size, Size);
  scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  scene.window()->Render();
  const vtkTypeInt64 bytes = scene.rayCaster()->GetUploadedBytes();
  lookAt(scene.renderer(), grid->GetBounds(), 80.0, 20.0);
  scene.window()->Render();
  EXPECT_EQ(scene.rayCaster()->GetUploadedBytes(), bytes);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfTransferFunctionBuilds(), 1);
  property->SetComponentWeight(1, 0.5);
  scene.window()->Render();
  EXPECT_EQ(scene.rayCaster()->GetNumberOfTransferFunctionBuilds(), 2);
  EXPECT_LT(scene.rayCaster()->GetUploadedBytes(), bytes + 48 * 200);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.rayCaster()->GetNumberOfScalarUpdates(), 1);
}

TEST(TetrahedraRayCastComponents, NumbersThatDoNotFitAreErrors)
{
  struct Case
  {
    int Components;
    bool Independent;
    int BlendMode;
  };
  for (const Case& item : { Case{ 3, false, 0 }, Case{ 5, false, 0 }, Case{ 5, true, 0 },
         Case{ 2, true, 1 }, Case{ 4, false, 5 } })
  {
    const Grid grid = makeComponents<vtkDoubleArray>(std::vector<int>(item.Components, 0), 1.0);
    // With functions for components beyond the first, with which independent components would be
    // mixed.
    auto property = combine(makeParts(2, FunctionKind::Smooth), Weights);
    property->SetIndependentComponents(item.Independent);
    RayCastScene scene(grid, property, Size, Size);
    scene.rayCaster()->SetBlendMode(item.BlendMode);
    const auto errors = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
    errors->observe(scene.rayCaster());
    lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
    const FloatImage image = scene.renderFloat();
    EXPECT_EQ(errors->Errors.size(), 1u) << item.Components;
    EXPECT_EQ(std::count(image.Rgba.begin(), image.Rgba.end(), 0.0f),
      static_cast<std::ptrdiff_t>(image.Rgba.size()));
  }
}

namespace
{

// The same mesh with one component of its scalars as the only one, or with their length for -1.
Grid extract(vtkUnstructuredGrid* grid, int component, bool ofCells)
{
  auto copy = Grid::New();
  copy->CopyStructure(grid);
  vtkDataSetAttributes* from =
    ofCells ? static_cast<vtkDataSetAttributes*>(grid->GetCellData()) : grid->GetPointData();
  vtkDataSetAttributes* to =
    ofCells ? static_cast<vtkDataSetAttributes*>(copy->GetCellData()) : copy->GetPointData();
  vtkNew<vtkDoubleArray> values;
  values->SetName(ScalarName);
  for (vtkIdType i = 0; i < from->GetScalars()->GetNumberOfTuples(); ++i)
  {
    double square = 0.0;
    for (int c = 0; c < from->GetScalars()->GetNumberOfComponents(); ++c)
    {
      square += std::pow(from->GetScalars()->GetComponent(i, c), 2);
    }
    values->InsertNextValue(
      component < 0 ? std::sqrt(square) : from->GetScalars()->GetComponent(i, component));
  }
  to->SetScalars(values);
  return copy;
}

FloatImage draw(vtkUnstructuredGrid* grid, vtkVolumeProperty* property, int blendMode,
  const std::function<void(vtkTetrahedraRayCastMapper*)>& prepare = nullptr)
{
  RayCastScene scene(grid, property, 32, 32);
  scene.rayCaster()->SetBlendMode(blendMode);
  if (prepare)
  {
    prepare(scene.rayCaster());
  }
  const auto errors = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  errors->observe(scene.rayCaster());
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  const FloatImage image = scene.renderFloat();
  EXPECT_TRUE(errors->Errors.empty()) << errors->text();
  return image;
}

} // anonymous namespace

TEST(TetrahedraRayCastComponents, ColorFunctionChoosesTheComponent)
{
  // As vtkAbstractVolumeMapper documents and vtkProjectedTetrahedraMapper does, for every blend
  // mode, for points and cells, for numbers of components that can be mixed and others.
  const auto property = makeParts(1, FunctionKind::Smooth)[0];
  // Values that components of up to 0.5 reach, and so does their length.
  property->GetIsoSurfaceValues()->SetValue(0, 0.3);
  property->GetIsoSurfaceValues()->SetValue(1, 0.6);
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  for (const std::vector<int>& ofFields : { std::vector<int>{ 0, 3, 2 }, { 0, 1, 2, 3, 1 } })
  {
    const Grid points = makeComponents<vtkDoubleArray>(ofFields, 0.5);
    const auto cells = Grid::New();
    cells->CopyStructure(points);
    vtkNew<vtkDoubleArray> ofCells;
    ofCells->SetName(ScalarName);
    ofCells->SetNumberOfComponents(static_cast<int>(ofFields.size()));
    ofCells->SetNumberOfTuples(cells->GetNumberOfCells());
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c)
    {
      cells->GetCellPoints(c, ids);
      ofCells->SetTuple(c, ids->GetId(0), points->GetPointData()->GetScalars());
    }
    cells->GetCellData()->SetScalars(ofCells);
    for (const bool isOfCells : { false, true })
    {
      const Grid& grid = isOfCells ? cells : points;
      for (const int blendMode : { 0, 1, 5 })
      {
        for (const int chosen : { 0, 1, 2, -1 })
        {
          const std::string what = std::to_string(ofFields.size()) + " components, of cells " +
            std::to_string(isOfCells) + ", mode " + std::to_string(blendMode) + ", component " +
            std::to_string(chosen);
          colors->SetVectorModeToComponent();
          colors->SetVectorComponent(0);
          const FloatImage expected = draw(extract(grid, chosen, isOfCells), property, blendMode);
          colors->SetVectorComponent(std::max(chosen, 0));
          if (chosen < 0)
          {
            colors->SetVectorModeToMagnitude();
          }
          expectSamePicture(draw(grid, property, blendMode), expected, what);
          if (blendMode != 0)
          {
            continue;
          }
          // The mapper's own choice takes precedence.
          const FloatImage other = draw(grid, property, blendMode,
            [](vtkTetrahedraRayCastMapper* mapper)
            {
              mapper->SetVectorMode(vtkTetrahedraRayCastMapper::COMPONENT);
              mapper->SetVectorComponent(2);
            });
          EXPECT_EQ(largestDifference(other, expected) == 0.0, chosen == 2) << what;
        }
      }
    }
  }
}

TEST(TetrahedraRayCastComponents, ChoiceOrMixture)
{
  const Grid grid = makeComponents<vtkDoubleArray>({ 0, 3 }, 1.0);
  const auto parts = makeParts(2, FunctionKind::Smooth);
  const auto property = combine(parts, { 1.0, 1.0 });
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  const FloatImage first = draw(extract(grid, 0, false), parts[0], 0);
  const FloatImage second = draw(extract(grid, 1, false), parts[0], 0);
  // A function for the second component mixes both, unless the first colour function selects one.
  const FloatImage mixture = draw(grid, property, 0);
  EXPECT_GT(largestDifference(mixture, first), 0.1);
  colors->SetVectorComponent(1);
  expectSamePicture(draw(grid, property, 0), second, "chosen in spite of other functions");
  colors->SetVectorComponent(0);
  expectSamePicture(draw(grid, property, 0), mixture, "mixed again");
  // An opacity function alone is enough to mix the second component.
  vtkNew<vtkVolumeProperty> opacityOnly;
  opacityOnly->SetColor(0, parts[0]->GetRGBTransferFunction());
  opacityOnly->SetScalarOpacity(0, parts[0]->GetScalarOpacity());
  opacityOnly->SetScalarOpacityUnitDistance(0, parts[0]->GetScalarOpacityUnitDistance());
  expectSamePicture(draw(grid, opacityOnly, 0), first, "nothing but functions of the first");
  opacityOnly->SetScalarOpacity(1, parts[1]->GetScalarOpacity());
  EXPECT_GT(largestDifference(draw(grid, opacityOnly, 0), first), 0.1);
  // Dependent components have their roles whatever the vector mode.
  property->IndependentComponentsOff();
  const FloatImage dependent = draw(grid, property, 0);
  colors->SetVectorModeToMagnitude();
  expectSamePicture(draw(grid, property, 0), dependent, "dependent");
  // In an array of one component there is nothing to select.
  colors->SetVectorModeToComponent();
  colors->SetVectorComponent(2);
  property->IndependentComponentsOn();
  expectSamePicture(draw(extract(grid, 0, false), property, 0), first, "a single component");
}

TEST(TetrahedraRayCastComponents, ChosenComponentOutOfRangeIsAnError)
{
  const Grid grid = makeComponents<vtkDoubleArray>({ 0, 3 }, 1.0);
  const auto property = makeParts(1, FunctionKind::Smooth)[0];
  property->GetRGBTransferFunction()->SetVectorComponent(2);
  RayCastScene scene(grid, property, Size, Size);
  const auto errors = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
  errors->observe(scene.rayCaster());
  scene.window()->Render();
  ASSERT_EQ(errors->Errors.size(), 1u);
  EXPECT_NE(errors->Errors[0].find("none of number 2"), std::string::npos) << errors->text();
}

TEST(TetrahedraRayCastComponents, NativeDrawsTheSame)
{
  const auto drawBoth = [](RayCastScene& scene, const std::string& what)
  {
    lookAt(scene.renderer(), scene.grid()->GetBounds(), 30.0, 20.0);
    const auto warnings = vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New());
    warnings->observe(scene.rayCaster());
    scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
    const FloatImage fragments = scene.renderFloat();
    scene.rayCaster()->SetBackend(vtkTetrahedraRayCastMapper::NATIVE);
    expectSamePicture(scene.renderFloat(), fragments, what);
    EXPECT_EQ(scene.rayCaster()->GetActiveBackend(), vtkTetrahedraRayCastMapper::NATIVE) << what;
    EXPECT_EQ(scene.rayCaster()->GetNumberOfLostRays(), 0) << what;
    EXPECT_TRUE(warnings->Warnings.empty()) << what;
  };
  for (const int number : { 2, 3, 4 })
  {
    const std::vector<int> all{ 0, 1, 2, 3 };
    const Grid grid = makeComponents<vtkDoubleArray>({ all.begin(), all.begin() + number }, 1.0);
    RayCastScene scene(grid, combine(makeParts(number, FunctionKind::Smooth), Weights), Size, Size);
    drawBoth(scene, std::to_string(number) + " independent");
  }
  // Dependent components, with and without gradients, seen from inside and clipped as well.
  for (const std::vector<int>& components : { std::vector<int>{ 0, 3 }, { 0, 1, 2, 3 } })
  {
    for (const int gradients : { -1, 0, 1 })
    {
      const Grid grid = makeComponents<vtkFloatArray>(components, 1.0);
      const auto property = combine(makeParts(1, FunctionKind::Smooth), Weights);
      property->IndependentComponentsOff();
      property->SetShade(gradients >= 0);
      if (gradients >= 0)
      {
        property->GetGradientOpacity()->AddPoint(0.0, 0.2);
        property->GetGradientOpacity()->AddPoint(2.0, 1.0);
      }
      RayCastScene scene(grid, property, Size, Size);
      scene.rayCaster()->SetGradients(std::max(gradients, 0));
      const std::string what =
        std::to_string(components.size()) + " dependent, gradients " + std::to_string(gradients);
      drawBoth(scene, what);
      vtkNew<vtkPlane> plane;
      plane->SetNormal(0.3, 1.0, 0.2);
      scene.rayCaster()->AddClippingPlane(plane);
      drawBoth(scene, what + ", clipped");
    }
  }
}

TEST(TetrahedraRayCastComponents, DenseBeyondMeasureEnds)
{
  // An attenuation beyond all resolution, and rays without early termination.
  const Grid grid = makeComponents<vtkDoubleArray>({ 0, 1 }, 1.0);
  auto part = makeConstantProperty(1.0, 1, 0.5, 0.25, 1e-30);
  const std::vector<double> ones(2, 1.0);
  RayCastScene scene(grid, combine({ part, part }, ones), Size, Size);
  scene.rayCaster()->SetEarlyTerminationOpacity(1.0);
  lookAt(scene.renderer(), grid->GetBounds(), 30.0, 20.0);
  const FloatImage image = scene.renderFloat();
  const float* middle = image.pixel(Size / 2, Size / 2);
  EXPECT_NEAR(middle[0], 1.0f, 2e-6);
  EXPECT_NEAR(middle[1], 0.5f, 2e-6);
  EXPECT_NEAR(middle[3], 1.0f, 2e-6);
}

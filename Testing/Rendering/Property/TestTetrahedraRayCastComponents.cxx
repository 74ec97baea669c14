// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Scalars of several components: independent ones, colour and opacity, and direct colours.
#include "MembraneScene.h"
#include "OpticsTruth.h"
#include "ReferenceComponents.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 88;

// Four unrelated fields, in about [0, 1].
std::vector<Field> GetFields()
{
  const Field wavy = WavyField(3.0);
  return { [wavy](double x, double y, double z) { return 0.5 + 0.5 * wavy(x, y, z); },
    [](double x, double y, double z) { return std::sqrt((x * x + y * y + z * z) / 3.0); },
    [](double x, double y, double z) { return 0.5 + 0.2 * x - 0.2 * y + 0.1 * z; },
    [wavy](double x, double y, double z) { return 0.5 + 0.5 * wavy(y + 0.4, z, x - 0.3); } };
}

// A block whose active array has some of the fields as components, times a factor.
template <typename Array>
Grid MakeComponents(const std::vector<int>& ofFields, double factor)
{
  const Grid grid = MakeBlock(6, ConstantField(0.0));
  vtkNew<Array> array;
  array->SetName(ScalarName);
  array->SetNumberOfComponents(static_cast<int>(ofFields.size()));
  array->SetNumberOfTuples(grid->GetNumberOfPoints());
  const std::vector<Field> all = GetFields();
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
std::unique_ptr<ReferenceRayIntegrator> ReferenceOf(
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
  return MakeReference(copy);
}

ReferenceTransferFunction Weighted(const ReferenceTransferFunction& function, double weight)
{
  auto nodes = function.GetNodes();
  for (auto& node : nodes)
  {
    node.Value.Attenuation *= weight;
  }
  return ReferenceTransferFunction(nodes);
}

TracedComparison ExpectMixture(RayCastScene& scene, Mixture mixture,
  const std::vector<ReferenceTransferFunction>& functions, double colorFactor,
  const std::string& what, const MembraneCase& membrane = MembraneCase())
{
  scene.GetRayCaster()->SetMembraneData(membrane.Mesh);
  scene.GetWindow()->Render();
  std::vector<std::unique_ptr<ReferenceRayIntegrator>> integrators;
  for (int c = 0; c < scene.MakeGrid()->GetPointData()->GetScalars()->GetNumberOfComponents(); ++c)
  {
    const bool isColor = mixture == Mixture::RedGreenBlueOpacity && c < 3;
    integrators.push_back(ReferenceOf(scene.MakeGrid(), c, isColor ? colorFactor : 1.0));
  }
  return ExpectTrace(scene,
    membrane.BendMembrane(
      [&](const Ray& ray)
      {
        std::vector<std::vector<RaySegment>> segments(integrators.size());
        for (std::size_t c = 0; c < integrators.size(); ++c)
        {
          integrators[c]->FindSegments(ray, segments[c]);
        }
        return IntegrateComponents(ray, segments, mixture, functions);
      }),
    what);
}

// A property whose components have the functions of some others.
vtkSmartPointer<vtkVolumeProperty> Combine(
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

std::vector<vtkSmartPointer<vtkVolumeProperty>> MakeParts(int number, FunctionKind kind)
{
  std::vector<vtkSmartPointer<vtkVolumeProperty>> parts;
  for (int c = 0; c < number; ++c)
  {
    const double range[2] = { 0.0 - 0.05 * c, 1.0 + 0.1 * c };
    parts.push_back(MakeProperty(c == 1 ? FunctionKind::Sparse : kind, range, 3.4));
    parts.back()->GetRGBTransferFunction()->AddRGBPoint(
      0.31 + 0.1 * c, c == 0, c == 1, 1.0 - 0.3 * c);
  }
  return parts;
}

double LargestDifference(const FloatImage& a, const FloatImage& b)
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
  for (const auto& [kind, number] : Product(std::vector<FunctionKind>{ FunctionKind::Smooth,
                                              FunctionKind::Peaked, FunctionKind::Opaque },
         List(2, 3, 4)))
  {
    const std::vector<int> ofFields{ 0, 1, 2, 3 };
    const Grid grid = MakeComponents<vtkDoubleArray>(
      std::vector<int>(ofFields.begin(), ofFields.begin() + number), 1.0);
    const auto parts = MakeParts(number, kind);
    std::vector<ReferenceTransferFunction> functions;
    for (int c = 0; c < number; ++c)
    {
      functions.push_back(Weighted(ToReference(parts[c]), Weights[c]));
    }
    RayCastScene scene(grid, Combine(parts, Weights), Size, Size);
    ExpectMixture(scene, Mixture::Independent, functions, 1.0,
      std::to_string(number) + " independent, function " + std::to_string(static_cast<int>(kind)));
  }
}

TEST(TetrahedraRayCastComponents, ColorByTheFirstOpacityByTheSecond)
{
  const Grid grid = MakeComponents<vtkFloatArray>({ 0, 3 }, 1.0);
  for (const FunctionKind kind :
    { FunctionKind::Smooth, FunctionKind::Peaked, FunctionKind::Opaque })
  {
    const auto part = MakeParts(1, kind)[0];
    auto property = Combine({ part }, Weights);
    property->IndependentComponentsOff();
    RayCastScene scene(grid, property, Size, Size);
    const ReferenceTransferFunction function = ToReference(part);
    ExpectMixture(scene, Mixture::ColorAndOpacity, { function, function }, 1.0,
      "colour and opacity, function " + std::to_string(static_cast<int>(kind)));
  }
}

TEST(TetrahedraRayCastComponents, ColorsAsTheyAre)
{
  for (const bool bytes : { true, false })
  {
    const double factor = bytes ? 255.0 : 1.0;
    const Grid grid = bytes ? MakeComponents<vtkUnsignedCharArray>({ 0, 1, 2, 3 }, factor)
                            : MakeComponents<vtkFloatArray>({ 0, 1, 2, 3 }, factor);
    const double range[2] = { 0.0, factor };
    const auto part = MakeProperty(FunctionKind::Smooth, range, 3.4);
    auto property = Combine({ part }, Weights);
    property->IndependentComponentsOff();
    RayCastScene scene(grid, property, Size, Size);
    const ReferenceTransferFunction opacity = ToReference(part);
    const ReferenceTransferFunction none;
    ExpectMixture(scene, Mixture::RedGreenBlueOpacity, { none, none, none, opacity }, 1.0 / factor,
      bytes ? "bytes" : "floats");
  }
}

TEST(TetrahedraRayCastComponents, ThroughAMembrane)
{
  const MembraneCase membranes[] = { MakePlaneCase(0.1, 4.0, 2), MakeDomeCase(1.4, 4.0, 2.8, 16) };
  for (const MembraneCase& membrane : membranes)
  {
    for (const int number : { 2, 4 })
    {
      const std::vector<int> ofFields{ 0, 1, 2, 3 };
      const Grid grid = MakeComponents<vtkDoubleArray>(
        std::vector<int>(ofFields.begin(), ofFields.begin() + number), 1.0);
      const auto parts = MakeParts(number, FunctionKind::Smooth);
      std::vector<ReferenceTransferFunction> functions;
      for (int c = 0; c < number; ++c)
      {
        functions.push_back(Weighted(ToReference(parts[c]), Weights[c]));
      }
      RayCastScene scene(grid, Combine(parts, Weights), Size, Size);
      LookAt(scene.GetRenderer(), grid->GetBounds(), 30.0, 50.0);
      ExpectMixture(scene, Mixture::Independent, functions, 1.0,
        std::to_string(number) + " independent", membrane);
    }
    const auto part = MakeParts(1, FunctionKind::Smooth)[0];
    auto property = Combine({ part }, Weights);
    property->IndependentComponentsOff();
    const ReferenceTransferFunction function = ToReference(part);
    const ReferenceTransferFunction none;
    RayCastScene two(MakeComponents<vtkFloatArray>({ 0, 3 }, 1.0), property, Size, Size);
    LookAt(two.GetRenderer(), two.MakeGrid()->GetBounds(), 30.0, 50.0);
    ExpectMixture(
      two, Mixture::ColorAndOpacity, { function, function }, 1.0, "colour and opacity", membrane);
    RayCastScene four(MakeComponents<vtkFloatArray>({ 0, 1, 2, 3 }, 1.0), property, Size, Size);
    LookAt(four.GetRenderer(), four.MakeGrid()->GetBounds(), 30.0, 50.0);
    ExpectMixture(four, Mixture::RedGreenBlueOpacity, { none, none, none, function }, 1.0,
      "colours as they are", membrane);
  }
}

TEST(TetrahedraRayCastComponents, ComputeShadersDrawTheSame)
{
  const Grid grid = MakeComponents<vtkDoubleArray>({ 0, 1, 2 }, 1.0);
  RayCastScene scene(grid, Combine(MakeParts(3, FunctionKind::Smooth), Weights), Size, Size);
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const FloatImage fragments = scene.RenderFloat();
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::COMPUTE);
  EXPECT_LT(LargestDifference(scene.RenderFloat(), fragments), 2e-5);
}

TEST(TetrahedraRayCastComponents, PartsOfOneMediumMakeTheWhole)
{
  // The same field four times, with weights that sum up to 1.
  const std::vector<double> shares{ 0.5, 0.25, 0.125, 0.125 };
  const auto part = MakeParts(1, FunctionKind::Smooth)[0];
  const Grid one = MakeComponents<vtkDoubleArray>({ 0 }, 1.0);
  const Grid four = MakeComponents<vtkDoubleArray>({ 0, 0, 0, 0 }, 1.0);
  RayCastScene single(one, part, Size, Size);
  RayCastScene mixed(four, Combine({ part, part, part, part }, shares), Size, Size);
  LookAt(mixed.GetRenderer(), one->GetBounds(), 30.0, 20.0);
  EXPECT_LT(LargestDifference(mixed.RenderFloat(), single.RenderFloat()), 2e-5);
}

TEST(TetrahedraRayCastComponents, LightOnDependentComponents)
{
  // Both components are equal: the image is that of one scalar, with the gradient of the second.
  const Grid one = MakeComponents<vtkDoubleArray>({ 0 }, 1.0);
  const Grid two = MakeComponents<vtkDoubleArray>({ 0, 0 }, 1.0);
  for (const int gradients :
    { vtkTetrahedraRayCastMapper::CELL_GRADIENTS, vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS })
  {
    const auto part = MakeParts(1, FunctionKind::Smooth)[0];
    if (gradients == vtkTetrahedraRayCastMapper::VERTEX_GRADIENTS)
    {
      // Varying light times varying colour along a piece is integrated in another way.
      SetPoints(part->GetRGBTransferFunction(), { { 0.0, 0.8, 0.6, 0.4 } });
    }
    part->ShadeOn();
    SetPoints(part->GetGradientOpacity(), { { 0.0, 0.2 }, { 2.0, 1.0 } });
    RayCastScene single(one, part, Size, Size);
    vtkNew<vtkVolumeProperty> property;
    property->DeepCopy(part);
    property->IndependentComponentsOff();
    RayCastScene mixed(two, property, Size, Size);
    for (RayCastScene* scene : { &single, &mixed })
    {
      scene->GetRayCaster()->SetGradients(gradients);
      LookAt(scene->GetRenderer(), one->GetBounds(), 30.0, 20.0);
    }
    EXPECT_LT(LargestDifference(mixed.RenderFloat(), single.RenderFloat()), 5e-5) << gradients;
  }
}

TEST(TetrahedraRayCastComponents, LightOnIndependentOnesWarnsAndIsLeftOut)
{
  const Grid grid = MakeComponents<vtkDoubleArray>({ 0, 1 }, 1.0);
  const auto property = Combine(MakeParts(2, FunctionKind::Smooth), Weights);
  RayCastScene scene(grid, property, Size, Size);
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  const FloatImage plain = scene.RenderFloat();
  const auto warnings = ObserveErrors(scene.GetRayCaster());
  property->ShadeOn();
  EXPECT_EQ(scene.RenderFloat().Rgba, plain.Rgba);
  EXPECT_EQ(scene.RenderFloat().Rgba, plain.Rgba);
  EXPECT_EQ(warnings->Warnings.size(), 1u);
}

TEST(TetrahedraRayCastComponents, CellsThatSomeComponentShowsAreActive)
{
  // x and y, each visible above 0.5 of [-1, 1]; the third is invisible.
  const Grid grid = MakeBlock(8, ConstantField(0.0));
  const auto array =
    MakeArray(nullptr, grid->GetNumberOfPoints(), [&](vtkIdType p) { return PointOf(grid, p); });
  grid->GetPointData()->SetScalars(array);
  std::vector<vtkSmartPointer<vtkVolumeProperty>> parts;
  for (int c = 0; c < 3; ++c)
  {
    parts.push_back(MakeConstantProperty(0.0, c == 0, c == 1, 1, 1.0));
    parts.back()->SetScalarOpacity(
      MakeOpacity({ { -1.0, 0.0 }, { 0.5, 0.0 }, { 1.0, c < 2 ? 1.0 : 0.0 } }));
  }
  const std::vector<double> ones(3, 1.0);
  RayCastScene scene(grid, Combine(parts, ones), Size, Size);
  scene.GetWindow()->Render();
  // Two of the 8 layers along x reach above 0.5, and two along y: 1 - (3/4)^2 of the cubes are
  // visible.
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() * 7 / 16);
  ExpectMixture(scene, Mixture::Independent,
    { ToReference(parts[0]), ToReference(parts[1]), ToReference(parts[2]) }, 1.0, "sparse");
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveSetBuilds(), 1);
  // A value that is not finite hides its cells, whichever component it is.
  array->SetComponent(0, 2, std::numeric_limits<double>::quiet_NaN());
  array->SetComponent(grid->GetNumberOfPoints() - 1, 1, std::numeric_limits<double>::infinity());
  array->Modified();
  const auto warnings = ObserveErrors(scene.GetRayCaster());
  scene.GetWindow()->Render();
  EXPECT_EQ(std::count_if(warnings->Warnings.begin(), warnings->Warnings.end(),
              [](const std::string& text) { return text.find("2 of 729 vert") != text.npos; }),
    1);
  EXPECT_LT(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() * 7 / 16);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  // Back to one component.
  scene.GetRayCaster()->SetVectorMode(vtkTetrahedraRayCastMapper::COMPONENT);
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells() / 4);
}

TEST(TetrahedraRayCastComponents, OnlyWhatChangedIsSent)
{
  const Grid grid = MakeComponents<vtkDoubleArray>({ 0, 1 }, 1.0);
  const auto property = Combine(MakeParts(2, FunctionKind::Smooth), Weights);
  RayCastScene scene(grid, property, Size, Size);
  scene.GetRayCaster()->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
  scene.GetWindow()->Render();
  const vtkTypeInt64 bytes = scene.GetRayCaster()->GetUploadedBytes();
  LookAt(scene.GetRenderer(), grid->GetBounds(), 80.0, 20.0);
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetUploadedBytes(), bytes);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfTransferFunctionBuilds(), 1);
  property->SetComponentWeight(1, 0.5);
  scene.GetWindow()->Render();
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfTransferFunctionBuilds(), 2);
  EXPECT_LT(scene.GetRayCaster()->GetUploadedBytes(), bytes + 48 * 200);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfScalarUpdates(), 1);
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
    const Grid grid = MakeComponents<vtkDoubleArray>(std::vector<int>(item.Components, 0), 1.0);
    // With functions for components beyond the first, with which independent components would be
    // mixed.
    auto property = Combine(MakeParts(2, FunctionKind::Smooth), Weights);
    property->SetIndependentComponents(item.Independent);
    RayCastScene scene(grid, property, Size, Size);
    scene.GetRayCaster()->SetBlendMode(item.BlendMode);
    const auto errors = ObserveErrors(scene.GetRayCaster());
    const FloatImage image = scene.RenderFloat();
    EXPECT_EQ(errors->Errors.size(), 1u) << item.Components;
    EXPECT_EQ(std::count(image.Rgba.begin(), image.Rgba.end(), 0.0f),
      static_cast<std::ptrdiff_t>(image.Rgba.size()));
  }
}

namespace
{

// The same mesh with one component of its scalars as the only one, or with their length for -1.
Grid Extract(vtkUnstructuredGrid* grid, int component, bool ofCells)
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

FloatImage Draw(vtkUnstructuredGrid* grid, vtkVolumeProperty* property, int blendMode,
  const std::function<void(vtkTetrahedraRayCastMapper*)>& prepare = nullptr)
{
  RayCastScene scene(grid, property, 32, 32);
  scene.GetRayCaster()->SetBlendMode(blendMode);
  if (prepare)
  {
    prepare(scene.GetRayCaster());
  }
  const auto errors = ObserveErrors(scene.GetRayCaster());
  const FloatImage image = scene.RenderFloat();
  EXPECT_TRUE(errors->Errors.empty()) << errors->GetText();
  return image;
}

} // anonymous namespace

TEST(TetrahedraRayCastComponents, ColorFunctionChoosesTheComponent)
{
  // As vtkAbstractVolumeMapper documents and vtkProjectedTetrahedraMapper does, for every blend
  // mode, for points and cells, for numbers of components that can be mixed and others.
  const auto property = MakeParts(1, FunctionKind::Smooth)[0];
  // Values that components of up to 0.5 reach, and so does their length.
  property->GetIsoSurfaceValues()->SetValue(0, 0.3);
  property->GetIsoSurfaceValues()->SetValue(1, 0.6);
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  for (const std::vector<int>& ofFields : { std::vector<int>{ 0, 3, 2 }, { 0, 1, 2, 3, 1 } })
  {
    const Grid points = MakeComponents<vtkDoubleArray>(ofFields, 0.5);
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
      for (const auto& [blendMode, chosen] : Product(List(0, 1, 5), List(0, 1, 2, -1)))
      {
        const std::string what = std::to_string(ofFields.size()) + " components, of cells " +
          std::to_string(isOfCells) + ", mode " + std::to_string(blendMode) + ", component " +
          std::to_string(chosen);
        colors->SetVectorModeToComponent();
        colors->SetVectorComponent(0);
        const FloatImage expected = Draw(Extract(grid, chosen, isOfCells), property, blendMode);
        colors->SetVectorComponent(std::max(chosen, 0));
        if (chosen < 0)
        {
          colors->SetVectorModeToMagnitude();
        }
        ExpectSamePicture(Draw(grid, property, blendMode), expected, what);
        if (blendMode != 0)
        {
          continue;
        }
        // The mapper's own choice takes precedence.
        const FloatImage other = Draw(grid, property, blendMode,
          [](vtkTetrahedraRayCastMapper* mapper)
          {
            mapper->SetVectorMode(vtkTetrahedraRayCastMapper::COMPONENT);
            mapper->SetVectorComponent(2);
          });
        EXPECT_EQ(LargestDifference(other, expected) == 0.0, chosen == 2) << what;
      }
    }
  }
}

TEST(TetrahedraRayCastComponents, ChoiceOrMixture)
{
  const Grid grid = MakeComponents<vtkDoubleArray>({ 0, 3 }, 1.0);
  const auto parts = MakeParts(2, FunctionKind::Smooth);
  const auto property = Combine(parts, { 1.0, 1.0 });
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  const FloatImage first = Draw(Extract(grid, 0, false), parts[0], 0);
  const FloatImage second = Draw(Extract(grid, 1, false), parts[0], 0);
  // A function for the second component mixes both, unless the first colour function selects one.
  const FloatImage mixture = Draw(grid, property, 0);
  EXPECT_GT(LargestDifference(mixture, first), 0.1);
  colors->SetVectorComponent(1);
  ExpectSamePicture(Draw(grid, property, 0), second, "chosen in spite of other functions");
  colors->SetVectorComponent(0);
  ExpectSamePicture(Draw(grid, property, 0), mixture, "mixed again");
  // An opacity function alone is enough to mix the second component.
  vtkNew<vtkVolumeProperty> opacityOnly;
  opacityOnly->SetColor(0, parts[0]->GetRGBTransferFunction());
  opacityOnly->SetScalarOpacity(0, parts[0]->GetScalarOpacity());
  opacityOnly->SetScalarOpacityUnitDistance(0, parts[0]->GetScalarOpacityUnitDistance());
  ExpectSamePicture(Draw(grid, opacityOnly, 0), first, "nothing but functions of the first");
  opacityOnly->SetScalarOpacity(1, parts[1]->GetScalarOpacity());
  EXPECT_GT(LargestDifference(Draw(grid, opacityOnly, 0), first), 0.1);
  // Dependent components have their roles whatever the vector mode.
  property->IndependentComponentsOff();
  const FloatImage dependent = Draw(grid, property, 0);
  colors->SetVectorModeToMagnitude();
  ExpectSamePicture(Draw(grid, property, 0), dependent, "dependent");
  // In an array of one component there is nothing to select.
  colors->SetVectorModeToComponent();
  colors->SetVectorComponent(2);
  property->IndependentComponentsOn();
  ExpectSamePicture(Draw(Extract(grid, 0, false), property, 0), first, "a single component");
}

TEST(TetrahedraRayCastComponents, ChosenComponentOutOfRangeIsAnError)
{
  const Grid grid = MakeComponents<vtkDoubleArray>({ 0, 3 }, 1.0);
  const auto property = MakeParts(1, FunctionKind::Smooth)[0];
  property->GetRGBTransferFunction()->SetVectorComponent(2);
  RayCastScene scene(grid, property, Size, Size);
  const auto errors = ObserveErrors(scene.GetRayCaster());
  scene.GetWindow()->Render();
  ASSERT_EQ(errors->Errors.size(), 1u);
  EXPECT_TRUE(HasText(errors->Errors[0], "none of number 2"));
}

TEST(TetrahedraRayCastComponents, DenseBeyondMeasureEnds)
{
  // An attenuation beyond all resolution, and rays without early termination.
  const Grid grid = MakeComponents<vtkDoubleArray>({ 0, 1 }, 1.0);
  auto part = MakeConstantProperty(1.0, 1, 0.5, 0.25, 1e-30);
  const std::vector<double> ones(2, 1.0);
  RayCastScene scene(grid, Combine({ part, part }, ones), Size, Size);
  scene.GetRayCaster()->SetEarlyTerminationOpacity(1.0);
  const FloatImage image = scene.RenderFloat();
  const float* middle = image.GetPixel(Size / 2, Size / 2);
  EXPECT_NEAR(middle[0], 1.0f, 2e-6);
  EXPECT_NEAR(middle[1], 0.5f, 2e-6);
  EXPECT_NEAR(middle[3], 1.0f, 2e-6);
}

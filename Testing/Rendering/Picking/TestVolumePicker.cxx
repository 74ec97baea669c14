// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Closed forms of picks, VTK's convention for pickers, and input that cannot be used. No frame is
// drawn and no display is needed.
#include "RayCastScene.h"

#include <vtkAssembly.h>
#include <vtkAssemblyNode.h>
#include <vtkAssemblyPath.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkTetrahedraRayIntegral.h>
#include <vtkTetrahedraVolumePicker.h>

using namespace meniscus::test;
using Picker = vtkTetrahedraVolumePicker;

namespace
{

constexpr int Size = 40;
/** Pixel whose ray does not go through an edge of a block. */
constexpr int Column = 23;
constexpr int Row = 18;

/** A volume in a window, seen along -z without perspective, the view 3 units high. */
struct PickScene
{
  PickScene(vtkUnstructuredGrid* grid, vtkVolumeProperty* property)
    : Scene(grid, property, Size, Size)
  {
    vtkCamera* camera = this->Scene.GetRenderer()->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetPosition(0.0, 0.0, 5.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetParallelScale(1.5);
    camera->SetClippingRange(0.1, 100.0);
  }
  int Pick() { return this->Chooser->Pick(Column, Row, 0.0, this->Scene.GetRenderer()); }
  vtkTetrahedraRayCastMapper* Mapper() { return this->Scene.GetRayCaster(); }

  RayCastScene Scene;
  vtkNew<Picker> Chooser;
};

double PlaceOf(int pixel)
{
  return 3.0 * (pixel + 0.5) / Size - 1.5;
}

/** Attenuation that is linear in the scalar, from 0 at 0 to `perScalar` at 1. */
vtkSmartPointer<vtkVolumeProperty> MakeRamp(double perScalar)
{
  auto property = MakeConstantProperty(1.0, 1.0, 1.0, 1.0, 1.0 / perScalar);
  property->SetScalarOpacity(MakeOpacity({ { 0.0, 0.0 }, { 1.0, 1.0 } }));
  return property;
}

/** Counts the pick events of a picker. */
struct EventCounter
{
  explicit EventCounter(vtkObject* object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long event, void* data, void*)
      { static_cast<EventCounter*>(data)->Events.push_back(event); });
    for (const auto event :
      { vtkCommand::StartPickEvent, vtkCommand::PickEvent, vtkCommand::EndPickEvent })
    {
      object->AddObserver(event, this->Command);
    }
  }
  std::vector<unsigned long> Events;
  vtkNew<vtkCallbackCommand> Command;
};

}

//------------------------------------------------------------------------------
/** The scalar is (1 - z) / 2 in [-1, 1]^3: attenuation grows as k t with the way t. */
TEST(VolumePicker, LinearFieldInACube)
{
  const double k = 0.8;
  PickScene scene(
    MakeBlock(3, [](double, double, double z) { return 0.5 - 0.5 * z; }), MakeRamp(2.0 * k));
  ASSERT_EQ(scene.Pick(), 1);
  // Opacity 1 - exp(-k t t / 2) is 0.5 at t = sqrt(2 ln 2 / k); k t exp(-k t t / 2) is largest at
  // t = 1 / sqrt(k). The camera is 4 in front of the cube. The bound is 1e-6 of the diagonal.
  const double bound = 1.0e-6 * std::sqrt(12.0);
  EXPECT_NEAR(scene.Chooser->GetDepthOf(Picker::FIRST_VISIBLE), 4.0, bound);
  EXPECT_NEAR(scene.Chooser->GetDepthOf(Picker::OPACITY_REACHED),
    4.0 + std::sqrt(2.0 * std::log(2.0) / k), bound);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 4.0 + 1.0 / std::sqrt(k), bound);
  EXPECT_NEAR(scene.Chooser->GetValue(), 0.5 / std::sqrt(k), 1.0e-6);
  double* position = scene.Chooser->GetPickPosition();
  EXPECT_NEAR(position[0], PlaceOf(Column), bound);
  EXPECT_NEAR(position[1], PlaceOf(Row), bound);
  EXPECT_NEAR(position[2], 1.0 - 1.0 / std::sqrt(k), bound);
  EXPECT_EQ(scene.Chooser->GetSurfaceIndex(), -1);
  EXPECT_EQ(scene.Chooser->GetFlatBlockIndex(), -1);
}

//------------------------------------------------------------------------------
/** Light changes colours, but no place. */
TEST(VolumePicker, LightDoesNotMatter)
{
  const Grid grid = MakeBlock(5, RadialField());
  auto property = MakeRamp(3.0);
  property->GetIsoSurfaceValues()->SetValue(0, 0.7);
  PickScene scene(grid, property);
  for (const int mode : { vtkVolumeMapper::COMPOSITE_BLEND, vtkVolumeMapper::ISOSURFACE_BLEND })
  {
    scene.Mapper()->SetBlendMode(mode);
    property->ShadeOff();
    ASSERT_EQ(scene.Pick(), 1);
    const double depth = scene.Chooser->GetDepth();
    const vtkIdType cell = scene.Chooser->GetCellId();
    property->ShadeOn();
    ASSERT_EQ(scene.Pick(), 1);
    EXPECT_EQ(scene.Chooser->GetDepth(), depth);
    EXPECT_EQ(scene.Chooser->GetCellId(), cell);
  }
}

//------------------------------------------------------------------------------
/** A pane of glass shifts the ray: the true place behind it, and the length of the path. */
TEST(VolumePicker, ThroughAPane)
{
  PickScene scene(MakeBlock(3, ConstantField(0.5)), MakeRamp(2.0));
  vtkCamera* camera = scene.Scene.GetRenderer()->GetActiveCamera();
  camera->ParallelProjectionOff();
  camera->SetViewAngle(40.0);
  const double index = 1.5;
  // Seen from above, rays meet the plane z = 3 first.
  for (const double z : { 3.0, 2.0 })
  {
    const auto plane = MakePlane(9.0, z, 1);
    plane->Update();
    scene.Mapper()->AddMembraneData(plane->GetOutput());
  }
  vtkNew<vtkRefractingInterfaceCollection> interfaces;
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkRefractingInterface> item;
    item->SetExteriorIndexOfRefraction(i == 0 ? 1.0 : index);
    item->SetInteriorIndexOfRefraction(i == 0 ? index : 1.0);
    interfaces->AddItem(item);
  }
  scene.Mapper()->SetInterfaces(interfaces);
  scene.Chooser->SetPlaceToFirstVisible();
  ASSERT_EQ(scene.Pick(), 1);
  const double slope = std::tan(vtkMath::RadiansFromDegrees(20.0));
  const double across[2] = { slope * (2.0 * (Column + 0.5) / Size - 1.0),
    slope * (2.0 * (Row + 0.5) / Size - 1.0) };
  const double tangent = std::hypot(across[0], across[1]);
  const double inside = std::tan(std::asin(std::sin(std::atan(tangent)) / index));
  // From z = 5: three units of depth in air, one in glass.
  const double bound = 1.0e-6 * std::sqrt(12.0);
  for (int axis = 0; axis < 2; ++axis)
  {
    EXPECT_NEAR(
      scene.Chooser->GetPickPosition()[axis], across[axis] * (3.0 + inside / tangent), bound);
  }
  EXPECT_NEAR(scene.Chooser->GetPickPosition()[2], 1.0, bound);
  EXPECT_NEAR(
    scene.Chooser->GetDepth(), 3.0 * std::hypot(1.0, tangent) + std::hypot(1.0, inside), bound);
  // A list that does not fit the surfaces is an error, and nothing is picked.
  const auto observer = ObserveErrors(scene.Mapper());
  scene.Mapper()->RemoveAllMembranes();
  EXPECT_EQ(scene.Pick(), 0);
  EXPECT_EQ(observer->Errors.size(), 1u);
}

//------------------------------------------------------------------------------
TEST(VolumePicker, ViewportAndRenderer)
{
  PickScene scene(MakeBlock(2, ConstantField(0.5)), MakeRamp(2.0));
  vtkRenderer* renderer = scene.Scene.GetRenderer();
  const double none[][2] = { { -1.0, 5.0 }, { 5.0, -0.5 }, { Size, 5.0 }, { 5.0, 1.0e30 },
    { std::nan(""), 5.0 } };
  for (const auto& place : none)
  {
    EXPECT_EQ(scene.Chooser->Pick(place[0], place[1], 0.0, renderer), 0) << place[0];
    EXPECT_EQ(scene.Chooser->GetViewProp(), nullptr);
  }
  // All places of a pixel are one pick.
  double first[3];
  ASSERT_EQ(scene.Chooser->Pick(Column, Row, 0.0, renderer), 1);
  scene.Chooser->GetPickPosition(first);
  ASSERT_EQ(scene.Chooser->Pick(Column + 0.99, Row + 0.5, 0.0, renderer), 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(scene.Chooser->GetPickPosition()[axis], first[axis]);
  }
  // In the right half of the window, the left half is outside.
  renderer->SetViewport(0.5, 0.0, 1.0, 1.0);
  EXPECT_EQ(scene.Chooser->Pick(Size / 2 - 1, Row, 0.0, renderer), 0);
  EXPECT_EQ(scene.Chooser->Pick(3 * Size / 4, Row, 0.0, renderer), 1);

  const auto observer = ObserveErrors(scene.Chooser);
  EXPECT_EQ(scene.Chooser->Pick(1.0, 1.0, 0.0, nullptr), 0);
  vtkNew<vtkRenderer> windowless;
  EXPECT_EQ(scene.Chooser->Pick(1.0, 1.0, 0.0, windowless), 0);
  ASSERT_EQ(observer->Errors.size(), 2u);
  EXPECT_TRUE(HasText(observer->Errors[0], "no renderer"));
  EXPECT_TRUE(HasText(observer->Errors[1], "no render window"));
  EXPECT_EQ(scene.Chooser->GetCellId(), -1);
  EXPECT_TRUE(std::isnan(scene.Chooser->GetDepth()));
}

//------------------------------------------------------------------------------
/** Cells next to a scalar that is not finite are not met; the ray goes on behind them. */
TEST(VolumePicker, NaNOnTheRay)
{
  Grid grid = MakeBlock(4, ConstantField(0.5));
  PickScene scene(grid, MakeRamp(2.0));
  scene.Chooser->SetPlaceToFirstVisible();
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 4.0, 1.0e-6);
  vtkDataArray* scalars = grid->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    if (grid->GetPoint(i)[2] > 0.9)
    {
      scalars->SetTuple1(i, std::nan(""));
    }
  }
  scalars->Modified();
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 4.5, 1.0e-6);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    scalars->SetTuple1(i, std::numeric_limits<double>::infinity());
  }
  scalars->Modified();
  EXPECT_EQ(scene.Pick(), 0);
}

//------------------------------------------------------------------------------
TEST(VolumePicker, NothingToPick)
{
  // Nothing visible.
  PickScene scene(MakeBlock(2, ConstantField(-1.0)), MakeRamp(2.0));
  EXPECT_EQ(scene.Pick(), 0);
  // An empty mesh, one without extent, no input, no mapper.
  vtkNew<vtkUnstructuredGrid> empty;
  scene.Mapper()->SetInputData(empty);
  EXPECT_EQ(scene.Pick(), 0);
  scene.Mapper()->SetInputData(
    MakeGrid({ 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }, { 0, 1, 2, 3 }, ConstantField(1.0)));
  EXPECT_EQ(scene.Pick(), 0);
  scene.Mapper()->RemoveAllInputs();
  EXPECT_EQ(scene.Pick(), 0);
  scene.Scene.GetVolume()->SetMapper(nullptr);
  EXPECT_EQ(scene.Pick(), 0);
  // The volume of another mapper, and a surface.
  vtkNew<vtkFixedPointVolumeRayCastMapper> other;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  other->SetInputData(image);
  scene.Scene.GetVolume()->SetMapper(other);
  vtkNew<vtkActor> actor;
  scene.Scene.GetRenderer()->AddActor(actor);
  EXPECT_EQ(scene.Pick(), 0);
}

//------------------------------------------------------------------------------
TEST(VolumePicker, PropsAndEvents)
{
  PickScene scene(MakeBlock(2, ConstantField(0.5)), MakeRamp(2.0));
  vtkVolume* far = scene.Scene.GetVolume();
  EventCounter counter(scene.Chooser);
  // A nearer copy, as a part of an assembly that moves it.
  vtkNew<vtkTetrahedraRayCastMapper> mapper;
  mapper->SetInputData(MakeBlock(2, ConstantField(0.25)));
  vtkNew<vtkVolume> near;
  near->SetMapper(mapper);
  near->SetProperty(far->GetProperty());
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(near);
  assembly->SetPosition(0.0, 0.0, 1.0);
  scene.Scene.GetRenderer()->AddViewProp(assembly);
  const vtkMTimeType before = far->GetMTime();
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_EQ(far->GetMTime(), before);
  EXPECT_EQ(scene.Chooser->GetMapper(), mapper);
  EXPECT_EQ(scene.Chooser->GetViewProp(), assembly);
  EXPECT_EQ(scene.Chooser->GetAssembly(), assembly);
  EXPECT_EQ(scene.Chooser->GetPath()->GetLastNode()->GetViewProp(), near);
  EXPECT_NEAR(scene.Chooser->GetPickPosition()[2], 2.0, 1.0e-5);
  EXPECT_NEAR(scene.Chooser->GetMapperPosition()[2], 1.0, 1.0e-5);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 3.0, 1.0e-5);
  const std::vector<unsigned long> all{ vtkCommand::StartPickEvent, vtkCommand::PickEvent,
    vtkCommand::EndPickEvent };
  EXPECT_EQ(counter.Events, all);
  // Not pickable, invisible, or not in the list.
  assembly->PickableOff();
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_EQ(scene.Chooser->GetVolume(), far);
  EXPECT_EQ(scene.Chooser->GetMapper(), scene.Mapper());
  far->VisibilityOff();
  counter.Events.clear();
  EXPECT_EQ(scene.Pick(), 0);
  const std::vector<unsigned long> missed{ vtkCommand::StartPickEvent, vtkCommand::EndPickEvent };
  EXPECT_EQ(counter.Events, missed);
  far->VisibilityOn();
  assembly->PickableOn();
  scene.Chooser->PickFromListOn();
  EXPECT_EQ(scene.Pick(), 0);
  scene.Chooser->AddPickList(far);
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_EQ(scene.Chooser->GetVolume(), far);
  EXPECT_EQ(scene.Chooser->GetMapper()->GetDataSetInput(), scene.Chooser->GetDataSet());
}

//------------------------------------------------------------------------------
/** Blocks of different size, one of them a surface: cell, data set and flat index. */
TEST(VolumePicker, CompositeInput)
{
  Grid front = MakeBlock(2, ConstantField(0.01));
  TransformPoints(front, { 0.0, 0.0, 2.5 }, 1.0);
  Grid back = MakeBlock(3, ConstantField(2.0));
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(1, back);
  const auto blocks = MakeBlocks({ vtkNew<vtkPolyData>(), front, inner });
  PickScene scene(front, MakeRamp(2.0));
  scene.Mapper()->SetInputData(blocks);
  ASSERT_EQ(scene.Pick(), 1);
  // Flat indices: 0 the root, 1 the surface, 2 front, 3 inner, 4 its empty block, 5 back.
  EXPECT_EQ(scene.Chooser->GetFlatBlockIndexOf(Picker::FIRST_VISIBLE), 2);
  EXPECT_EQ(scene.Chooser->GetFlatBlockIndex(), 5);
  EXPECT_EQ(scene.Chooser->GetDataSet(), back);
  EXPECT_EQ(scene.Chooser->GetCompositeDataSet(), blocks);
  double* bounds = back->GetCell(scene.Chooser->GetCellId())->GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_GE(scene.Chooser->GetPickPosition()[axis], bounds[2 * axis] - 1.0e-5);
    EXPECT_LE(scene.Chooser->GetPickPosition()[axis], bounds[2 * axis + 1] + 1.0e-5);
  }
  vtkNew<vtkTetrahedraRayIntegral> filter;
  filter->SetInputData(blocks);
  filter->SetImageSize(Size, Size);
  filter->SetCamera(scene.Scene.GetRenderer()->GetActiveCamera());
  filter->SetVolumeProperty(scene.Scene.GetVolume()->GetProperty());
  filter->GetArraySelection()->DisableArray("Integral");
  filter->GetArraySelection()->EnableArray("LargestContribution");
  filter->Update();
  vtkPointData* data = filter->GetOutput()->GetPointData();
  ASSERT_NE(data->GetArray("LargestContributionBlock"), nullptr);
  const vtkIdType pixel = Row * Size + Column;
  EXPECT_EQ(data->GetArray("LargestContributionBlock")->GetTuple1(pixel), 5);
  EXPECT_EQ(
    data->GetArray("LargestContributionCellId")->GetTuple1(pixel), scene.Chooser->GetCellId());
}

//------------------------------------------------------------------------------
/** Cells that are divided: the voxel of an image, and its scalar, as point and as cell data. */
TEST(VolumePicker, VoxelsAndCellData)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 5, 5);
  image->SetOrigin(-1.0, -1.0, -1.0);
  image->SetSpacing(0.5, 0.5, 0.5);
  const auto ofCells = MakeArray("cells", image->GetNumberOfCells(),
    [&](vtkIdType i) { // The third layer from the front is visible.
      return i / 16 == 1 ? 0.5 + 0.001 * static_cast<double>(i) : 0.0;
    });
  image->GetCellData()->SetScalars(ofCells);
  PickScene scene(MakeBlock(1, ConstantField(1.0)), MakeRamp(2.0));
  scene.Mapper()->SetInputData(static_cast<vtkDataSet*>(image.Get()));
  scene.Mapper()->SetScalarModeToUseCellData();
  ASSERT_EQ(scene.Pick(), 1);
  const double position[3] = { PlaceOf(Column), PlaceOf(Row), -0.25 };
  int ijk[3];
  double coordinates[3];
  image->ComputeStructuredCoordinates(position, ijk, coordinates);
  const vtkIdType cell = image->ComputeCellId(ijk);
  EXPECT_EQ(scene.Chooser->GetCellId(), cell);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 5.0, 1.0e-5);
  EXPECT_NEAR(scene.Chooser->GetValue(), ofCells->GetValue(cell), 1.0e-6);
  // The map of cells is that of the mesh for scalars of cells: nothing to look up.
  EXPECT_EQ(scene.Mapper()->GetStatistic("NumberOfCellSearches"), 0);
}

//------------------------------------------------------------------------------
/** Gradient opacity hides all but the steep half; independent components add up. */
TEST(VolumePicker, GradientOpacityAndComponents)
{
  const auto field = [](double, double, double z) { return z > 0.0 ? 0.1 * z : 4.0 * z; };
  auto property = MakeConstantProperty(0.5, 1.0, 1.0, 1.0, 1.0);
  property->SetGradientOpacity(MakeOpacity({ { 1.0, 0.0 }, { 1.001, 1.0 } }));
  PickScene scene(MakeBlock(4, field), property);
  scene.Mapper()->SetGradients(vtkTetrahedraRayCastMapper::CELL_GRADIENTS);
  scene.Chooser->SetPlaceToFirstVisible();
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 5.0, 1.0e-5);

  Grid grid = MakeBlock(2, ConstantField(0.0));
  grid->GetPointData()->SetScalars(
    MakeArray("pair", grid->GetNumberOfPoints(), glm::dvec2(0.3, 0.5)));
  auto both = MakeRamp(2.0);
  both->SetIndependentComponents(1);
  both->SetScalarOpacity(1, MakeOpacity({ { 0.0, 0.0 }, { 1.0, 0.6 } }));
  PickScene mixed(grid, both);
  mixed.Chooser->SetPlaceToOpacityReached();
  ASSERT_EQ(mixed.Pick(), 1);
  // Attenuation 2 * 0.3 + 0.6 * 0.5.
  EXPECT_NEAR(mixed.Chooser->GetDepth(), 4.0 + std::log(2.0) / 0.9, 1.0e-6 * std::sqrt(12.0));
}

//------------------------------------------------------------------------------
TEST(VolumePicker, OtherModesAndThresholds)
{
  PickScene scene(
    MakeBlock(3, [](double, double, double z) { return 0.5 - 0.5 * z; }), MakeRamp(2.0));
  scene.Chooser->SetPlaceToOpacityReached();
  scene.Chooser->SetOpacityThreshold(0.0);
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 4.0, 1.0e-6);
  // A medium never reaches 1, nor 0.9 in this one: 1 - exp(-2).
  for (const double opacity : { 1.0, 0.9 })
  {
    scene.Chooser->SetOpacityThreshold(opacity);
    EXPECT_EQ(scene.Pick(), 0);
  }
  scene.Mapper()->SetBlendMode(vtkVolumeMapper::AVERAGE_INTENSITY_BLEND);
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 4.0, 1.0e-6);
  scene.Mapper()->SetBlendMode(vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND);
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 6.0, 1.0e-6);
  scene.Mapper()->SetBlendMode(vtkVolumeMapper::ADDITIVE_BLEND);
  scene.Chooser->SetOpacityThreshold(0.5);
  ASSERT_EQ(scene.Pick(), 1);
  EXPECT_NEAR(scene.Chooser->GetDepth(), 4.0 + std::sqrt(2.0 * std::log(2.0)), 4.0e-6);
}

//------------------------------------------------------------------------------
/** Picks look up only inputs that changed; results do not depend on the threads. */
TEST(VolumePicker, CountersAndThreads)
{
  Grid grid = MakeBlock(5, WavyField(2.0));
  PickScene scene(grid, MakeRamp(2.0));
  ASSERT_EQ(scene.Pick(), 1);
  const double depth = scene.Chooser->GetDepth();
  const vtkIdType cell = scene.Chooser->GetCellId();
  vtkSMPTools::Initialize(1);
  ASSERT_EQ(scene.Pick(), 1);
  vtkSMPTools::Initialize();
  EXPECT_EQ(scene.Chooser->GetDepth(), depth);
  EXPECT_EQ(scene.Chooser->GetCellId(), cell);
  const double bytes = static_cast<double>(scene.Mapper()->GetStatistic("HostBytes"));
  scene.Scene.GetRenderer()->GetActiveCamera()->Azimuth(10.0);
  scene.Pick();
  EXPECT_EQ(scene.Mapper()->GetNumberOfMeshBuilds(), 1);
  EXPECT_EQ(scene.Mapper()->GetNumberOfScalarUpdates(), 1);
  EXPECT_EQ(scene.Mapper()->GetStatistic("NumberOfCellSearches"), 1);
  EXPECT_EQ(static_cast<double>(scene.Mapper()->GetStatistic("HostBytes")), bytes);
  grid->GetPointData()->GetScalars()->SetTuple1(0, 0.3);
  grid->GetPointData()->GetScalars()->Modified();
  scene.Pick();
  EXPECT_EQ(scene.Mapper()->GetNumberOfScalarUpdates(), 2);
  EXPECT_EQ(scene.Mapper()->GetStatistic("NumberOfCellSearches"), 1);
}

//------------------------------------------------------------------------------
/** One event alone is the same as among all three, and its rays end earlier. */
TEST(VolumePicker, ImageOfOneEvent)
{
  const auto makeImage = [](int wanted)
  {
    auto filter = vtkSmartPointer<vtkTetrahedraRayIntegral>::New();
    filter->SetInputData(MakeBlock(6, WavyField(2.0)));
    filter->SetImageSize(Size, Size);
    filter->SetDirection(-1.0, -2.0, -0.7);
    filter->SetVolumeProperty(MakeRamp(3.0));
    filter->SetEventOpacity(0.2);
    filter->GetArraySelection()->DisableArray("Integral");
    vtkDataArraySelection* arrays = filter->GetArraySelection();
    arrays->SetArraySetting("FirstVisible", wanted & 1);
    arrays->SetArraySetting("OpacityReached", wanted >> 1 & 1);
    arrays->SetArraySetting("LargestContribution", wanted >> 2 & 1);
    filter->Update();
    return filter;
  };
  const auto all = makeImage(7);
  const char* const names[3] = { "FirstVisible", "OpacityReached", "LargestContribution" };
  for (int kind = 0; kind < 3; ++kind)
  {
    const auto one = makeImage(1 << kind);
    EXPECT_EQ(one->GetOutput()->GetPointData()->GetNumberOfArrays(), 4);
    int found = 0;
    for (const char* part : { "Depth", "Value", "CellId" })
    {
      const std::string name = std::string(names[kind]) + part;
      vtkDataArray* alone = one->GetOutput()->GetPointData()->GetArray(name.c_str());
      vtkDataArray* among = all->GetOutput()->GetPointData()->GetArray(name.c_str());
      ASSERT_TRUE(alone && among) << name;
      for (vtkIdType i = 0; i < Size * Size; ++i)
      {
        const double value = alone->GetTuple1(i);
        found += !std::isnan(value) && value >= 0.0;
        EXPECT_TRUE(
          value == among->GetTuple1(i) || (std::isnan(value) && std::isnan(among->GetTuple1(i))))
          << name << " " << i;
      }
    }
    EXPECT_GT(found, Size * Size / 2) << names[kind];
    EXPECT_LE(
      one->GetStatistic("NumberOfTraversalSteps"), all->GetStatistic("NumberOfTraversalSteps"));
  }
  EXPECT_LT(2 * makeImage(1)->GetStatistic("NumberOfTraversalSteps"),
    all->GetStatistic("NumberOfTraversalSteps"));
}

//------------------------------------------------------------------------------
TEST(VolumePicker, ImageBadInput)
{
  vtkNew<vtkTetrahedraRayIntegral> filter;
  filter->SetInputData(MakeBlock(2, ConstantField(0.5)));
  filter->SetImageSize(4, 4);
  filter->GetArraySelection()->DisableArray("Integral");
  filter->GetArraySelection()->EnableArray("FirstVisible");
  const auto observer = ObserveErrors(filter);
  const auto expectError = [&](const char* text)
  {
    observer->Errors.clear();
    filter->Update();
    ASSERT_EQ(observer->Errors.size(), 1u) << text;
    EXPECT_TRUE(HasText(observer->Errors[0], text));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  };
  expectError("Events need a volume property");
  filter->SetVolumeProperty(MakeRamp(1.0));
  filter->SetEventBlendMode(17);
  expectError("no blend mode of number 17");
  filter->SetEventBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
  filter->GetArraySelection()->EnableArray("RGBA");
  expectError("Events of isosurfaces cannot be");
  filter->SetEventOpacity(2.0);
  EXPECT_EQ(filter->GetEventOpacity(), 1.0);
  filter->SetEventBlendMode(vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND);
  filter->GetArraySelection()->DisableArray("RGBA");
  filter->SetVolumeProperty(nullptr);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 16);
}

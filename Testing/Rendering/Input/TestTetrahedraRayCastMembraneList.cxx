// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A mapper with several refracting interfaces: the work after each change, and lists that cannot be
// used.
#include "DeviceTableLimits.h"
#include "MembraneScene.h"
#include "RayCastScene.h"

#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr double Block[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };

using Indices = std::vector<std::array<double, 2>>;

void SetIndices(vtkTetrahedraRayCastMapper* mapper, const Indices& indices)
{
  vtkNew<vtkRefractingInterfaceCollection> list;
  for (const auto& pair : indices)
  {
    vtkNew<vtkRefractingInterface> interface;
    interface->SetExteriorIndexOfRefraction(pair[0]);
    interface->SetInteriorIndexOfRefraction(pair[1]);
    list->AddItem(interface);
  }
  mapper->SetInterfaces(list);
}

/** A block behind a pane of glass. */
struct PaneScene : RayCastScene
{
  vtkSmartPointer<vtkPolyData> Upper = MakePlaneCase(1.4, 4.0, 3).Mesh;
  vtkSmartPointer<vtkPolyData> Lower = MakePlaneCase(1.2, 4.0, 5).Mesh;

  PaneScene()
    : RayCastScene(
        MakeBlock(4, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, Range, 3.4), Size, Size)
  {
    this->GetRayCaster()->SetMembraneData(this->Upper);
    this->GetRayCaster()->AddMembraneData(this->Lower);
    SetIndices(this->GetRayCaster(), { { 1.0, 1.5 }, { 1.5, 1.0 } });
    LookAt(this->GetRenderer(), Block, 30.0, 45.0);
  }
};

/** Renders after a change, and expects one error with the given text and an empty picture. */
void ExpectError(const std::string& part,
  const std::function<void(PaneScene&, vtkTetrahedraRayCastMapper*)>& change)
{
  PaneScene scene;
  change(scene, scene.GetRayCaster());
  const auto told = ObserveErrors(scene.GetRayCaster());
  const FloatImage picture = scene.RenderFloat();
  ASSERT_EQ(told->Errors.size(), 1u) << part << told->GetText();
  EXPECT_TRUE(HasText(told->Errors.front(), part));
  EXPECT_TRUE(HasText(told->Errors.front(), "othing is rendered"));
  EXPECT_TRUE(std::all_of(
    picture.Rgba.begin(), picture.Rgba.end(), [](float value) { return value == 0.0f; }))
    << part;
}

} // anonymous namespace

TEST(TetrahedraRayCastMembraneList, OnlyWhatChangedIsDoneAgain)
{
  PaneScene scene;
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  scene.RenderFloat();
  const bool onDevice = mapper->GetActiveBackend() != vtkTetrahedraRayCastMapper::NATIVE;
  const auto expectWork = [&](const std::string& what, const std::function<void()>& change,
                            int builds, int sights, bool changesPicture, int interfaces = 2)
  {
    const FloatImage before = scene.RenderFloat();
    const vtkTypeInt64 meshes = mapper->GetNumberOfMeshBuilds();
    const double shapes = mapper->GetStatistic("NumberOfMembraneBuilds");
    const double rays = mapper->GetStatistic("NumberOfSightUpdates");
    const double lists = mapper->GetStatistic("NumberOfRefractedEntryLists");
    const vtkTypeInt64 bytes = mapper->GetUploadedBytes();
    change();
    const FloatImage after = scene.RenderFloat();
    EXPECT_EQ(mapper->GetNumberOfMeshBuilds(), meshes) << what;
    EXPECT_EQ(mapper->GetStatistic("NumberOfMembraneBuilds") - shapes, builds) << what;
    EXPECT_EQ(mapper->GetStatistic("NumberOfSightUpdates") - rays, sights) << what;
    EXPECT_EQ(before.Rgba != after.Rgba, changesPicture) << what;
    if (onDevice)
    {
      // A line of 32 bytes per pixel and a list per interface.
      EXPECT_EQ(
        mapper->GetUploadedBytes() - bytes, vtkTypeInt64{ 32 } * Size * Size * interfaces * sights)
        << what;
      EXPECT_EQ(mapper->GetStatistic("NumberOfRefractedEntryLists") - lists, interfaces * sights)
        << what;
    }
  };
  EXPECT_EQ(mapper->GetStatistic("NumberOfMembraneBuilds"), 2);
  EXPECT_EQ(mapper->GetStatistic("NumberOfSightUpdates"), 1);
  expectWork(
    "nothing", [] {}, 0, 0, false);
  expectWork(
    "camera", [&] { scene.GetRenderer()->GetActiveCamera()->Azimuth(5.0); }, 0, 1, true);
  expectWork(
    "second surface touched", [&] { scene.Lower->Modified(); }, 0, 0, false);
  expectWork(
    "second surface",
    [&]
    {
      scene.Lower->GetPoints()->DeepCopy(MakePlaneCase(1.1, 4.0, 5).Mesh->GetPoints());
      scene.Lower->Modified();
    },
    1, 1, true);
  vtkRefractingInterfaceCollection* list = mapper->GetInterfaces();
  expectWork(
    "index behind", [&] { list->GetInterface(1)->SetInteriorIndexOfRefraction(1.2); }, 0, 1, true);
  expectWork(
    "first one without refraction",
    [&]
    {
      list->GetInterface(0)->SetExteriorIndexOfRefraction(1.5);
      list->GetInterface(0)->SetInteriorIndexOfRefraction(1.5);
    },
    0, 1, true, 1);
}

TEST(TetrahedraRayCastMembraneList, OneSurfaceListedTwiceIsReadOnce)
{
  PaneScene scene;
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.6);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(24);
  mapper->SetMembraneConnection(ball->GetOutputPort());
  mapper->AddMembraneConnection(ball->GetOutputPort());
  ASSERT_EQ(mapper->GetNumberOfMembranes(), 2);
  EXPECT_EQ(mapper->GetMembrane(0), mapper->GetMembrane(1));
  SetIndices(mapper, { { 1.0, 1.5 }, { 1.0, 1.5 } });
  scene.RenderFloat();
  EXPECT_EQ(mapper->GetStatistic("NumberOfMembraneBuilds"), 1);
  EXPECT_EQ(mapper->GetStatistic("NumberOfRaysMissingAnInterface"), 0);
  mapper->RemoveAllMembranes();
  EXPECT_EQ(mapper->GetNumberOfMembranes(), 0);
  EXPECT_EQ(mapper->GetMembrane(), nullptr);
}

TEST(TetrahedraRayCastMembraneList, ListsThatCannotBeUsed)
{
  using Mapper = vtkTetrahedraRayCastMapper;
  ExpectError("The list has 2 refracting interfaces, and port 1 has 1 surfaces",
    [](PaneScene& scene, Mapper* mapper) { mapper->SetMembraneData(scene.Upper); });
  ExpectError("The list has 2 refracting interfaces, and port 1 has 3 surfaces",
    [](PaneScene& scene, Mapper* mapper) { mapper->AddMembraneData(scene.Upper); });
  ExpectError("The list has 2 refracting interfaces, and port 1 has 0 surfaces",
    [](PaneScene&, Mapper* mapper) { mapper->RemoveAllMembranes(); });
  ExpectError("The list has 1 refracting interfaces, and port 1 has 2 surfaces",
    [](PaneScene&, Mapper* mapper) { mapper->SetInterfaces(nullptr); });
  ExpectError("Interface 1: The membrane has no usable triangle",
    [](PaneScene& scene, Mapper* mapper)
    {
      mapper->SetMembraneData(scene.Upper);
      mapper->AddMembraneData(vtkNew<vtkPolyData>());
    });
  for (const double index : { 0.0, -1.5, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    ExpectError("Interface 1: Indices of refraction must be positive and finite",
      [&](PaneScene&, Mapper* mapper) {
        SetIndices(mapper, { { 1.0, 1.5 }, { 1.5, index } });
      });
    ExpectError("Interface 0: Indices of refraction must be positive and finite",
      [&](PaneScene&, Mapper* mapper) {
        SetIndices(mapper, { { index, 1.5 }, { 1.5, 1.0 } });
      });
  }
  for (const Indices& indices : { Indices{ { 1.0, 1.5 }, { 1.6, 1.0 } },
         Indices{ { 1.0, 1.5 }, { 1.333, 1.333 } }, Indices{ { 1.0, 1.5 }, { 1.0, 1.0 } } })
  {
    ExpectError("do not match along the list",
      [&](PaneScene&, Mapper* mapper) { SetIndices(mapper, indices); });
  }
  ExpectError("do not match along the list",
    [](PaneScene& scene, Mapper* mapper)
    {
      // Each pair of neighbours has a medium in common, but no ray passes all of them.
      mapper->AddMembraneData(scene.Upper);
      SetIndices(mapper, { { 1.0, 1.5 }, { 1.5, 1.333 }, { 1.5, 1.1 } });
    });
}

/** From behind, rays meet the list in another order: they end at the first interface. */
TEST(TetrahedraRayCastMembraneList, PaneSeenFromTheOtherSide)
{
  for (const double behind : { 1.0, 1.333 })
  {
    PaneScene scene;
    vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
    SetIndices(mapper, { { 1.0, 1.5 }, { 1.5, behind } });
    const auto told = ObserveErrors(mapper);
    LookAt(scene.GetRenderer(), Block, 30.0, -60.0);
    const FloatImage picture = scene.RenderFloat();
    EXPECT_TRUE(told->Errors.empty()) << told->GetText();
    EXPECT_GT(mapper->GetStatistic("NumberOfRaysMissingAnInterface"), Size);
    // The mesh lies in front of the pane.
    mapper->RemoveAllMembranes();
    mapper->SetInterfaces(nullptr);
    ExpectSamePicture(picture, scene.RenderFloat(), "from below");
  }
}

TEST(TetrahedraRayCastMembraneList, ErrorsGoAwayWithTheirCause)
{
  PaneScene scene;
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  const FloatImage before = scene.RenderFloat();
  const auto told = ObserveErrors(mapper);
  mapper->GetInterfaces()->GetInterface(1)->SetExteriorIndexOfRefraction(1.4);
  scene.RenderFloat();
  EXPECT_EQ(told->Errors.size(), 1u);
  mapper->GetInterfaces()->GetInterface(1)->SetExteriorIndexOfRefraction(1.5);
  EXPECT_EQ(scene.RenderFloat().Rgba, before.Rgba);
  EXPECT_EQ(told->Errors.size(), 1u);
}

TEST(TetrahedraRayCastMembraneList, MessagesNameTheInterface)
{
  PaneScene scene;
  scene.Lower->GetPolys()->InsertNextCell({ 0, 0, 1 });
  const auto told = ObserveErrors(scene.GetRayCaster());
  scene.RenderFloat();
  scene.RenderFloat();
  ASSERT_EQ(told->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(told->Warnings.front(), "Interface 1: 1 of 51 membrane triangles skipped"));
}

/** More legs than the graphics device has layers for their lists of entries. */
TEST(TetrahedraRayCastMembraneList, MoreInterfacesThanTheDeviceHasLayers)
{
  constexpr int interfaces = 4000;
  const auto render = [](int backend, vtkSmartPointer<ErrorObserver> told)
  {
    PaneScene scene;
    scene.GetWindow()->SetSize(4, 4);
    vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
    Indices indices;
    mapper->RemoveAllMembranes();
    for (int i = 0; i < interfaces; ++i)
    {
      mapper->AddMembraneData(i % 2 == 0 ? scene.Upper : scene.Lower);
      indices.push_back({ 1.0, 1.5 });
    }
    SetIndices(mapper, indices);
    mapper->SetBackend(backend);
    told->Observe(mapper);
    scene.RenderFloat();
    return mapper->GetActiveBackend();
  };
  auto told = vtkSmartPointer<ErrorObserver>::New();
  EXPECT_EQ(render(vtkTetrahedraRayCastMapper::OPENGL, told), vtkTetrahedraRayCastMapper::NATIVE);
  ASSERT_EQ(told->Warnings.size(), 1u) << told->GetText();
  EXPECT_TRUE(HasText(told->Warnings.front(), "behind 4000 refracting interfaces exceed"));
}

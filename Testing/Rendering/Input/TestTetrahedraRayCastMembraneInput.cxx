// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A mapper with a membrane: the work after each change, and membranes that cannot be used.
#include "DeviceTableLimits.h"
#include "MembraneScene.h"
#include "RayCastScene.h"

#include <vtkRefractingInterfaceCollection.h>
#include <vtkTransformPolyDataFilter.h>

using namespace meniscus::test;

namespace
{

constexpr int Size = 100;
constexpr double Range[2] = { -1.0, 1.0 };
constexpr double Block[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };

vtkSmartPointer<vtkVolumeProperty> Smooth()
{
  return MakeProperty(FunctionKind::Smooth, Range, 3.4);
}

struct Counters
{
  vtkTypeInt64 Mesh;
  vtkTypeInt64 Scalars;
  vtkTypeInt64 Functions;
  vtkTypeInt64 Active;
  vtkTypeInt64 Membranes;
  vtkTypeInt64 Sights;
  vtkTypeInt64 Lists;
  vtkTypeInt64 Bytes;

  explicit Counters(vtkTetrahedraRayCastMapper* mapper)
    : Mesh(mapper->GetNumberOfMeshBuilds())
    , Scalars(mapper->GetNumberOfScalarUpdates())
    , Functions(mapper->GetNumberOfTransferFunctionBuilds())
    , Active(mapper->GetNumberOfActiveSetBuilds())
    , Membranes(mapper->GetStatistic("NumberOfMembraneBuilds"))
    , Sights(mapper->GetStatistic("NumberOfSightUpdates"))
    , Lists(mapper->GetStatistic("NumberOfRefractedEntryLists"))
    , Bytes(mapper->GetUploadedBytes())
  {
  }

  std::vector<vtkTypeInt64> Since(const Counters& before) const
  {
    return { this->Mesh - before.Mesh, this->Scalars - before.Scalars,
      this->Functions - before.Functions, this->Active - before.Active,
      this->Membranes - before.Membranes, this->Sights - before.Sights };
  }
};

using Moves = std::vector<vtkTypeInt64>;

// Counters that a change increments, and whether it changes the image and the active cells.
void ExpectWork(RayCastScene& scene, const std::string& what, const std::function<void()>& change,
  const Moves& moves, bool changesPicture = true, bool changesActive = false)
{
  const FloatImage before = scene.RenderFloat();
  const Counters start(scene.GetRayCaster());
  change();
  const FloatImage after = scene.RenderFloat();
  const Counters end(scene.GetRayCaster());
  EXPECT_EQ(end.Since(start), moves) << what;
  EXPECT_EQ(before.Rgba != after.Rgba, changesPicture) << what;
  if (scene.GetRayCaster()->GetActiveBackend() == vtkTetrahedraRayCastMapper::NATIVE)
  {
    return;
  }
  // The entries behind the membrane are listed for other rays or other active cells. For other rays
  // a line of 32 bytes per pixel is uploaded, otherwise only scalars and functions.
  const bool sight = moves[5] != 0;
  EXPECT_EQ(end.Lists - start.Lists, sight || changesActive ? 1 : 0) << what;
  if (moves[1] == 0 && moves[2] == 0)
  {
    EXPECT_EQ(end.Bytes - start.Bytes, sight ? vtkTypeInt64{ 32 } * Size * Size : 0) << what;
  }
}

struct Outcome
{
  FloatImage Picture;
  vtkSmartPointer<ErrorObserver> Told;
  int Backend = vtkTetrahedraRayCastMapper::AUTOMATIC;
};

Outcome RenderWith(
  vtkPolyData* membrane, const std::function<void(vtkTetrahedraRayCastMapper*)>& prepare = nullptr)
{
  RayCastScene scene(MakeBlock(4, WavyField(3.0)), Smooth(), Size, Size);
  scene.GetRayCaster()->SetMembraneData(membrane);
  if (prepare)
  {
    prepare(scene.GetRayCaster());
  }
  LookAt(scene.GetRenderer(), Block, 30.0, 45.0);
  Outcome outcome;
  outcome.Told = vtkSmartPointer<ErrorObserver>::New();
  outcome.Told->Observe(scene.GetRayCaster());
  outcome.Picture = scene.RenderFloat();
  outcome.Backend = scene.GetRayCaster()->GetActiveBackend();
  return outcome;
}

bool IsEmpty(const FloatImage& image)
{
  return std::all_of(
    image.Rgba.begin(), image.Rgba.end(), [](float value) { return value == 0.0f; });
}

void ExpectError(const Outcome& outcome, const std::string& part)
{
  ASSERT_FALSE(outcome.Told->Errors.empty()) << part;
  EXPECT_TRUE(HasText(outcome.Told->Errors.front(), part));
  EXPECT_TRUE(HasText(outcome.Told->Errors.front(), "nothing is rendered"));
  EXPECT_TRUE(IsEmpty(outcome.Picture)) << part;
}

} // anonymous namespace

TEST(TetrahedraRayCastMembraneInput, OnlyWhatChangedIsDoneAgain)
{
  const Grid grid = MakeBlock(4, WavyField(3.0));
  const MembraneCase waves = MakeWavesCase(1.2, 0.05, 3.0, 3.0, 24);
  const MembraneCase others = MakeWavesCase(1.2, 0.06, 3.0, 3.0, 24);
  RayCastScene scene(grid, Smooth(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetMembraneData(waves.Mesh);
  LookAt(scene.GetRenderer(), Block, 30.0, 45.0);
  scene.RenderFloat();
  EXPECT_EQ(mapper->GetStatistic("NumberOfMembraneBuilds"), 1);
  EXPECT_EQ(mapper->GetStatistic("NumberOfSightUpdates"), 1);

  // Mesh, scalars, functions, active cells, membranes, sights.
  ExpectWork(
    scene, "nothing moves", [] {}, { 0, 0, 0, 0, 0, 0 }, false);
  ExpectWork(scene, "camera", [&] { scene.GetRenderer()->GetActiveCamera()->Azimuth(5.0); },
    { 0, 0, 0, 0, 0, 1 });
  ExpectWork(
    scene, "membrane touched", [&] { waves.Mesh->Modified(); }, { 0, 0, 0, 0, 0, 0 }, false);
  ExpectWork(scene, "wave",
    [&]
    {
      waves.Mesh->GetPoints()->DeepCopy(others.Mesh->GetPoints());
      waves.Mesh->GetPointData()->GetNormals()->DeepCopy(others.Mesh->GetPointData()->GetNormals());
      waves.Mesh->Modified();
    },
    { 0, 0, 0, 0, 1, 1 });
  ExpectWork(
    scene, "index", [&] { mapper->SetInteriorIndexOfRefraction(1.5); }, { 0, 0, 0, 0, 0, 1 });
  ExpectWork(
    scene, "volume's matrix", [&] { scene.GetVolume()->RotateY(3.0); }, { 0, 0, 0, 0, 0, 1 });
  ExpectWork(scene, "scalars",
    [&]
    {
      vtkDataArray* scalars = grid->GetPointData()->GetScalars();
      scalars->SetTuple1(7, 0.77);
      scalars->Modified();
    },
    { 0, 1, 0, 1, 0, 0 });
  ExpectWork(scene, "function",
    [&] { scene.GetVolume()->GetProperty()->SetScalarOpacityUnitDistance(2.0); },
    { 0, 0, 1, 0, 0, 0 });
  ExpectWork(
    scene, "other active cells",
    [&]
    {
      scene.GetVolume()->GetProperty()->SetScalarOpacity(
        MakeOpacity({ { 0.2, 0.0 }, { 0.8, 2.0 } }));
    },
    { 0, 0, 1, 1, 0, 0 }, true, true);
}

// Rays are traced only where they may reach visible geometry: more of them if that grows.
TEST(TetrahedraRayCastMembraneInput, MoreOfTheMeshIsSeen)
{
  const Grid grid = MakeBlock(4, [](double x, double, double) { return x; });
  const MembraneCase plane = MakePlaneCase(1.2, 4.0, 2);
  const auto picture = [&](bool lessFirst)
  {
    RayCastScene scene(grid, Smooth(), Size, Size);
    scene.GetRayCaster()->SetMembraneData(plane.Mesh);
    LookAt(scene.GetRenderer(), Block, 30.0, 45.0);
    if (lessFirst)
    {
      scene.GetVolume()->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.8);
      scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::ISOSURFACE_BLEND);
      scene.RenderFloat();
      EXPECT_LT(scene.GetRayCaster()->GetNumberOfActiveCells(), grid->GetNumberOfCells());
      scene.GetRayCaster()->SetBlendMode(vtkVolumeMapper::COMPOSITE_BLEND);
    }
    return scene.RenderFloat();
  };
  EXPECT_EQ(picture(true).Rgba, picture(false).Rgba);
}

TEST(TetrahedraRayCastMembraneInput, OutOfViewAndTakenAway)
{
  const Grid grid = MakeBlock(4, WavyField(3.0));
  const MembraneCase plane = MakePlaneCase(1.2, 4.0, 2);
  RayCastScene scene(grid, Smooth(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  LookAt(scene.GetRenderer(), Block, 30.0, 45.0);
  const FloatImage without = scene.RenderFloat();
  mapper->SetMembraneData(plane.Mesh);
  EXPECT_EQ(mapper->GetMembrane(), plane.Mesh.Get());
  EXPECT_NE(scene.RenderFloat().Rgba, without.Rgba);
  mapper->SetMembraneData(nullptr);
  EXPECT_EQ(mapper->GetMembrane(), nullptr);
  EXPECT_EQ(scene.RenderFloat().Rgba, without.Rgba);
  // A membrane below the mesh is behind all visible geometry.
  mapper->SetMembraneData(MakePlaneCase(-1.2, 0.01, 1).Mesh);
  EXPECT_EQ(scene.RenderFloat().Rgba, without.Rgba);
}

TEST(TetrahedraRayCastMembraneInput, ByAPipeline)
{
  const auto source = MakePlane(4.0, 0.0, 1); // normals along z
  vtkNew<vtkTransform> turn;
  turn->Translate(0.0, 1.2, 0.0);
  turn->RotateX(-90.0);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetTransform(turn);
  const Outcome data = RenderWith(MakePlaneCase(1.2, 4.0, 2).Mesh);
  const Outcome connected = RenderWith(nullptr,
    [&](vtkTetrahedraRayCastMapper* mapper)
    { mapper->SetMembraneConnection(filter->GetOutputPort()); });
  EXPECT_TRUE(data.Told->Errors.empty()) << data.Told->GetText();
  EXPECT_TRUE(connected.Told->Errors.empty()) << connected.Told->GetText();
  // In this case points are in single precision, and polygons are quads.
  ExpectSamePicture(data.Picture, connected.Picture, "connection");
}

TEST(TetrahedraRayCastMembraneInput, BackendAsAsked)
{
  const MembraneCase plane = MakePlaneCase(1.2, 4.0, 2);
  FloatImage native;
  for (const int backend : { vtkTetrahedraRayCastMapper::NATIVE, vtkTetrahedraRayCastMapper::OPENGL,
         vtkTetrahedraRayCastMapper::COMPUTE, vtkTetrahedraRayCastMapper::AUTOMATIC })
  {
    const Outcome outcome = RenderWith(
      plane.Mesh, [backend](vtkTetrahedraRayCastMapper* mapper) { mapper->SetBackend(backend); });
    EXPECT_TRUE(outcome.Told->Warnings.empty()) << outcome.Told->GetText();
    EXPECT_TRUE(outcome.Told->Errors.empty()) << outcome.Told->GetText();
    native = backend == vtkTetrahedraRayCastMapper::NATIVE ? outcome.Picture : native;
    ExpectSamePicture(outcome.Picture, native, "backend " + std::to_string(backend));
    EXPECT_TRUE(backend == outcome.Backend || backend == vtkTetrahedraRayCastMapper::AUTOMATIC);
  }
}

TEST(TetrahedraRayCastMembraneInput, NativeWhereTheDeviceHasNoRoom)
{
  // 2 texels per pixel and interface: more than the mesh has, which is drawn on the device as
  // before.
  const MembraneCase plane = MakePlaneCase(1.2, 4.0, 2);
  for (const auto& [interfaces, fits] : Product(List(1, 2), List(true, false)))
  {
    const auto prepare = [interfaces = interfaces, fits = fits](vtkTetrahedraRayCastMapper* mapper)
    {
      mapper->SetBackend(vtkTetrahedraRayCastMapper::OPENGL);
      meniscus::DeviceTableLimits::SetLargest(
        mapper, 2 * interfaces * Size * Size - (fits ? 0 : 1));
      if (interfaces == 2 && mapper->GetMembrane())
      {
        mapper->AddMembraneData(MakePlaneCase(1.1, 4.0, 2).Mesh);
        mapper->GetInterfaces()->AddInterface(1.333, 1.5);
      }
    };
    const Outcome straight = RenderWith(nullptr, prepare);
    EXPECT_EQ(straight.Backend, int(vtkTetrahedraRayCastMapper::OPENGL));
    EXPECT_TRUE(straight.Told->Warnings.empty()) << straight.Told->GetText();
    const Outcome refracted = RenderWith(plane.Mesh, prepare);
    EXPECT_EQ(refracted.Backend,
      int(fits ? vtkTetrahedraRayCastMapper::OPENGL : vtkTetrahedraRayCastMapper::NATIVE));
    EXPECT_EQ(refracted.Told->Warnings.size(), fits ? 0u : 1u);
    EXPECT_TRUE(refracted.Told->Errors.empty()) << refracted.Told->GetText();
    EXPECT_FALSE(IsEmpty(refracted.Picture));
  }
}

// Images of another size than the window: all backends draw them alike.
TEST(TetrahedraRayCastMembraneInput, CoarserRaysAndPartOfTheWindow)
{
  RayCastScene scene(MakeBlock(4, WavyField(3.0)), Smooth(), Size, Size);
  vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
  mapper->SetMembraneData(MakePlaneCase(0.1, 4.0, 2).Mesh);
  mapper->AutoAdjustSampleDistancesOff();
  LookAt(scene.GetRenderer(), Block, 30.0, 45.0);
  const int backend = mapper->GetBackend();
  const auto expectAlike = [&](const std::string& what)
  {
    mapper->SetBackend(backend);
    const FloatImage drawn = scene.RenderFloat();
    mapper->SetBackend(vtkTetrahedraRayCastMapper::NATIVE);
    ExpectSamePicture(drawn, scene.RenderFloat(), what);
  };
  for (const float distance : { 1.0f, 1.7f, 3.0f })
  {
    mapper->SetImageSampleDistance(distance);
    expectAlike("distance " + std::to_string(distance));
  }
  mapper->SetImageSampleDistance(1.0f);
  scene.GetRenderer()->SetViewport(0.31, 0.12, 0.93, 0.78);
  expectAlike("part of the window");
}

TEST(TetrahedraRayCastMembraneInput, ReleasedAndResized)
{
  RayCastScene scene(MakeBlock(4, WavyField(3.0)), Smooth(), Size, Size);
  scene.GetRayCaster()->SetMembraneData(MakePlaneCase(0.1, 4.0, 2).Mesh);
  LookAt(scene.GetRenderer(), Block, 30.0, 45.0);
  const FloatImage first = scene.RenderFloat();
  scene.GetRayCaster()->ReleaseGraphicsResources(scene.GetWindow());
  EXPECT_EQ(scene.RenderFloat().Rgba, first.Rgba);
  scene.GetWindow()->SetSize(Size + 7, Size - 13);
  EXPECT_FALSE(IsEmpty(scene.RenderFloat()));
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
  scene.GetWindow()->SetSize(Size, Size);
  EXPECT_EQ(scene.RenderFloat().Rgba, first.Rgba);
}

TEST(TetrahedraRayCastMembraneInput, BoundsHoldTheMembranes)
{
  RayCastScene scene(MakeBlock(2, WavyField(3.0)), Smooth(), Size, Size);
  scene.GetRayCaster()->SetMembraneData(MakePlaneCase(1.2, 4.0, 2).Mesh);
  scene.GetRayCaster()->AddMembraneData(MakePlaneCase(1.1, 5.0, 2).Mesh);
  scene.GetRayCaster()->GetInterfaces()->AddInterface(1.333, 1.5);
  const double wanted[6] = { -5.0, 5.0, -1.0, 1.2, -5.0, 5.0 };
  const double* bounds = scene.GetRayCaster()->GetBounds();
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_DOUBLE_EQ(bounds[i], wanted[i]) << i;
  }
  // Membranes stay where they are when the volume moves.
  scene.GetVolume()->SetPosition(1.0, 0.0, 0.0);
  LookAt(scene.GetRenderer(), Block, 30.0, 45.0);
  scene.RenderFloat();
  EXPECT_DOUBLE_EQ(scene.GetVolume()->GetBounds()[0], -5.0);
  EXPECT_DOUBLE_EQ(scene.GetVolume()->GetBounds()[1], 5.0);
}

TEST(TetrahedraRayCastMembraneInput, UnusableMembranes)
{
  vtkNew<vtkPolyData> empty;
  ExpectError(RenderWith(empty), "no usable triangle");

  const auto nan = MakePlaneCase(1.2, 4.0, 2).Mesh;
  MapPoints(nan, [](const glm::dvec3&) { return glm::dvec3(0.0, std::nan(""), 0.0); });
  ExpectError(RenderWith(nan), "no usable triangle");

  const auto lines = MakePlaneCase(1.2, 4.0, 2).Mesh;
  lines->SetLines(lines->GetPolys());
  lines->SetPolys(vtkNew<vtkCellArray>());
  ExpectError(RenderWith(lines), "no usable triangle");

  const double infinity = std::numeric_limits<double>::infinity();
  for (const double index : { 0.0, -1.3, infinity, std::nan("") })
  {
    for (const bool interior : { false, true })
    {
      const auto set = [&](vtkTetrahedraRayCastMapper* mapper)
      {
        interior ? mapper->SetInteriorIndexOfRefraction(index)
                 : mapper->SetExteriorIndexOfRefraction(index);
      };
      ExpectError(RenderWith(MakePlaneCase(1.2, 4.0, 2).Mesh, set), "Indices of refraction");
      // Without a membrane the indices have no effect.
      EXPECT_TRUE(RenderWith(nullptr, set).Told->Errors.empty());
    }
  }
}

TEST(TetrahedraRayCastMembraneInput, FacetsThatAreSkipped)
{
  const Outcome whole = RenderWith(MakePlaneCase(1.2, 4.0, 2).Mesh);
  ASSERT_FALSE(IsEmpty(whole.Picture));
  const auto bad = MakePlaneCase(1.2, 4.0, 2).Mesh;
  const vtkIdType stray = bad->GetPoints()->InsertNextPoint(0.0, std::nan(""), 0.0);
  bad->GetPointData()->GetNormals()->InsertNextTuple3(0.0, 1.0, 0.0);
  bad->GetPolys()->InsertNextCell({ 0, 1, stray });
  bad->GetPolys()->InsertNextCell({ 0, 0, 1 });
  bad->GetPolys()->InsertNextCell({ 0, 1, 99 });
  bad->GetPolys()->InsertNextCell({ 0, -1, 1 });
  const Outcome skipped = RenderWith(bad);
  EXPECT_TRUE(skipped.Told->Errors.empty()) << skipped.Told->GetText();
  ASSERT_EQ(skipped.Told->Warnings.size(), 1u) << skipped.Told->GetText();
  EXPECT_TRUE(HasText(skipped.Told->Warnings.front(), "4 of 12 membrane triangles skipped"));
  EXPECT_EQ(skipped.Picture.Rgba, whole.Picture.Rgba);
}

TEST(TetrahedraRayCastMembraneInput, EyeOnTheMembrane)
{
  // Rounding decides on which side it is; something must be drawn, and nothing may fail.
  RayCastScene scene(MakeBlock(4, WavyField(3.0)), Smooth(), Size, Size);
  scene.GetRayCaster()->SetMembraneData(MakePlaneCase(2.0, 4.0, 2).Mesh);
  vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
  camera->SetPosition(0.5, 2.0, 2.5);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(0.01, 10.0);
  EXPECT_FALSE(IsEmpty(scene.RenderFloat()));
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfLostRays(), 0);
}

/** A membrane whose normals point away from the eye: told once, until the eye has been in front. */
TEST(TetrahedraRayCastMembraneInput, EyeBehindIsTold)
{
  for (const bool isUpsideDown : { false, true })
  {
    vtkNew<vtkPlaneSource> water;
    water->SetOrigin(-9.0, -9.0, 2.0);
    water->SetPoint1(isUpsideDown ? -9.0 : 9.0, isUpsideDown ? 9.0 : -9.0, 2.0);
    water->SetPoint2(isUpsideDown ? 9.0 : -9.0, isUpsideDown ? -9.0 : 9.0, 2.0);
    const double range[2] = { -1.0, 1.0 };
    RayCastScene scene(
      MakeBlock(2, WavyField(3.0)), MakeProperty(FunctionKind::Smooth, range, 3.4), 16, 16);
    vtkTetrahedraRayCastMapper* mapper = scene.GetRayCaster();
    mapper->SetMembraneConnection(water->GetOutputPort());
    const auto listen = [&scene, mapper](double height)
    {
      vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
      camera->SetFocalPoint(0.0, 0.0, 0.0);
      camera->SetViewUp(0.0, 1.0, 0.0);
      camera->SetPosition(0.0, 0.5, height);
      scene.GetRenderer()->ResetCameraClippingRange();
      const auto observer = ObserveErrors(mapper);
      scene.GetWindow()->Render();
      scene.GetWindow()->Render();
      mapper->RemoveObserver(observer);
      EXPECT_TRUE(observer->Errors.empty()) << observer->GetText();
      return observer->Warnings;
    };
    for (const double height : { 8.0, -8.0, 8.0 })
    {
      const bool isBehind = isUpsideDown == (height > 0.0);
      const std::vector<std::string> warnings = listen(height);
      ASSERT_EQ(warnings.size(), isBehind ? 1u : 0u) << isUpsideDown << ", from " << height;
      if (isBehind)
      {
        EXPECT_TRUE(HasText(warnings[0], "No facet of the membrane faces the eye"));
      }
    }
    EXPECT_TRUE(listen(-9.0).size() == (isUpsideDown ? 0u : 1u));
    EXPECT_TRUE(listen(-10.0).empty());
    // Nothing is refracted.
    mapper->SetInteriorIndexOfRefraction(1.0);
    EXPECT_TRUE(listen(isUpsideDown ? 8.0 : -8.0).empty());
  }
}

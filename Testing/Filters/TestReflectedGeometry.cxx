// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRefractedGeometryFilter in Mode REFLECTION: pictures, cuts, normals, winding and bad input.
#include "BoardScene.h"
#include "ComparisonSheet.h"
#include "ExactStack.h"
#include "RefractedGeometryTestHelpers.h"

#include "VTKTestBasics.h"
#include "vtkStripper.h"
#include "vtkTriangleFilter.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;
using Filter = vtkRefractedGeometryFilter;

const double Pi = std::acos(-1.0);
const glm::dvec3 Eye(20.0, 300.0, 10.0);

vtkSmartPointer<Filter> MakeMirror(vtkPolyData* geometry, vtkPolyData* membrane)
{
  auto filter = MakeAllImages(geometry, membrane);
  filter->SetModeToReflection();
  return filter;
}

/** Twice the area of a polygon of the output, along its normal by the order of its points. */
glm::dvec3 GetAreaVector(vtkPolyData* data, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(cell, ids);
  glm::dvec3 sum(0.0);
  for (vtkIdType k = 2; k < ids->GetNumberOfIds(); ++k)
  {
    const glm::dvec3 first = PointOf(data, ids->GetId(0));
    sum +=
      glm::cross(PointOf(data, ids->GetId(k - 1)) - first, PointOf(data, ids->GetId(k)) - first);
  }
  return sum;
}

/** An upright rectangle in the plane z = `z`, of two quads one above the other. */
vtkSmartPointer<vtkPolyData> MakeScreen(double z, double low, double high)
{
  std::vector<Point> points;
  for (const double y : { low, 0.25 * low + 0.75 * high, high })
  {
    points.push_back({ -20.0, y, z });
    points.push_back({ 20.0, y, z });
  }
  auto screen = MakePoints(points);
  vtkNew<vtkCellArray> quads;
  for (const vtkIdType k : { 0, 2 })
  {
    quads->InsertNextCell({ k, k + 1, k + 3, k + 2 });
  }
  screen->SetPolys(quads);
  return screen;
}

//------------------------------------------------------------------------------
struct MirrorScene
{
  const char* Name;
  HeightField Field;
  PixelCamera Camera;
  BoardScene Object;
};

// A horizontal board above the mirror, with a ring below it.
MirrorScene MakeMirrorScene(const char* name, const HeightField& field, const glm::dvec3& eye,
  double halfTangent, double height, double size)
{
  const Ring ring{ { 0.05 * size, height - 0.25 * size, -0.05 * size },
    glm::normalize(glm::dvec3(0.5, 0.6, 0.6)), 0.22 * size, 0.07 * size };
  return { name, field, { eye, { 0.0, 0.0, 0.0 }, halfTangent },
    { MakeBoard(height, size), ring } };
}

std::vector<MirrorScene> GetMirrorScenes()
{
  const HeightField plane{ HeightField::Shape::Waves, 200.0, 0.0, 1.0, 1.0, 1.0, true };
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 0.8, 0.03 * Pi, 1.0, 1.0, true };
  const HeightField dome{ HeightField::Shape::Dome, 200.0, 8.0, 0.025, 1.0, 1.0, true };
  const HeightField dish{ HeightField::Shape::Dome, 200.0, -8.0, 0.025, 1.0, 1.0, true };
  // A board that stands on the mirror, with a ring in front of it.
  const BoardScene standing{ { { 0.0, 42.0, 55.0 }, { 100.0, 0.0, 0.0 }, { 0.0, 80.0, 25.0 } },
    Ring{ { 5.0, 27.0, 8.0 }, glm::normalize(glm::dvec3(0.4, 0.3, -0.8)), 18.0, 6.0 } };
  return { { "plane", plane, { { 40.0, 110.0, -190.0 }, { 0.0, -25.0, 30.0 }, 0.25 }, standing },
    MakeMirrorScene("waves with caustics", waves, Eye, 0.14, 90.0, 60.0),
    MakeMirrorScene("convex", dome, { 30.0, 400.0, 20.0 }, 0.13, 60.0, 110.0),
    MakeMirrorScene("concave, beyond its focus", dish, { 30.0, 400.0, 20.0 }, 0.12, 120.0, 40.0) };
}

void ExpectSameView(ComparisonSheet& sheet, int column, const char* name, const PixelCamera& camera,
  const BoardScene& object, vtkPolyData* mirror, const RayTracer& rays)
{
  const auto data = object.MakeData();
  const auto filter = MakeMirror(data, mirror);
  const glm::dvec3& eye = camera.GetEye();
  filter->SetEyePosition(eye.x, eye.y, eye.z);
  // A tenth of a pixel.
  const double pixel = 2.0 * std::atan(glm::length(camera.GetUp())) / camera.GetPixels();
  filter->SetAngularTolerance(0.1 * pixel * 180.0 / Pi);
  ExpectQuiet(filter);
  const PlacePicture drawn = DrawPlaces(filter->GetOutput(), camera);
  const PlacePicture traced = TraceRays(camera, rays, MakeMeshTracer(data));
  const PlaceComparison compared = AddComparison(sheet, column, name, camera, drawn, traced,
    [&object](const glm::dvec3& place) { return object.GetColour(place); });
  EXPECT_GT(compared.Covered, camera.GetPixels() * camera.GetPixels() / 20) << name;
  EXPECT_LE(compared.Coverage + compared.Place, compared.Covered / 1000) << name;
}

// Reflection at the sphere around the origin.
RayTracer MakeBallRays(const glm::dvec3& eye, double radius)
{
  return [eye, radius](const glm::dvec3& direction) -> std::optional<LastLeg>
  {
    const double middle = -glm::dot(eye, direction);
    const glm::dvec3 nearest = eye + middle * direction;
    const double squared = radius * radius - glm::dot(nearest, nearest);
    if (squared < 0.0)
    {
      return std::nullopt;
    }
    const glm::dvec3 place = eye + (middle - std::sqrt(squared)) * direction;
    const glm::dvec3 normal = place / radius;
    return LastLeg{ place, direction - 2.0 * glm::dot(direction, normal) * normal };
  };
}

// All images next to traced rays, and their difference: the figure in the documentation. A pixel
// differs as in RefractedGeometryRayTrace.
TEST(MirrorComparison, PlaneBallWavesAndDishAgreeWithTracedRays)
{
  const std::vector<MirrorScene> scenes = GetMirrorScenes();
  ComparisonSheet sheet = MakeSceneSheet(scenes.size() + 1, 256);
  for (std::size_t i = 0; i < scenes.size(); ++i)
  {
    const MirrorScene& scene = scenes[i];
    ExpectSameView(sheet, static_cast<int>(i), scene.Name, scene.Camera, scene.Object,
      MakeMembrane(scene.Field.MakeMesh(192)), MakeFieldRays(scene.Field, scene.Camera.GetEye()));
  }
  // On a table, 5,120 facets.
  constexpr double radius = 40.0;
  const BoardScene table{ MakeBoard(-45.0, 500.0),
    Ring{ { -75.0, -10.0, -75.0 }, glm::normalize(glm::dvec3(0.5, 0.2, 0.6)), 25.0, 9.0 } };
  const PixelCamera camera({ 40.0, 120.0, -220.0 }, glm::dvec3(0.0), 0.17);
  ExpectSameView(sheet, static_cast<int>(scenes.size()), "ball", camera, table,
    MakeMembrane(MakeSphere(glm::dvec3(0.0), radius, 4, true)),
    MakeBallRays(camera.GetEye(), radius));
  sheet.Write(MENISCUS_TEMPORARY_DIR "/mirror-comparison.png");
}

class ReflectedGeometry : public ::testing::TestWithParam<std::size_t>
{
};

// Facets out of the camera's view do not change the part in view.
TEST_P(ReflectedGeometry, CullingKeepsThePicture)
{
  const MirrorScene scene = GetMirrorScenes()[GetParam()];
  const glm::dvec3& eye = scene.Camera.GetEye();
  const PixelCamera camera(eye, { 20.0, 0.0, 20.0 }, 0.05, 256);
  const Board& board = scene.Object.Board;
  const auto grid = MakeGrid(17, glm::length(board.U), board.Centre.y);
  AddPlaces(grid);
  const auto filter = MakeMirror(grid, MakeMembrane(scene.Field.MakeMesh(64)));
  filter->SetEyePosition(eye.x, eye.y, eye.z);
  filter->Update();
  const PlacePicture whole = DrawPlaces(filter->GetOutput(), camera);
  vtkNew<vtkCamera> view;
  view->SetPosition(eye.x, eye.y, eye.z);
  view->SetFocalPoint(20.0, 0.0, 20.0);
  view->SetViewUp(0.0, 0.0, 1.0);
  view->SetViewAngle(2.0 * std::atan(0.05) * 180.0 / Pi);
  filter->SetCamera(view);
  filter->SetViewAspectRatio(1.0);
  filter->Update();
  EXPECT_GT(filter->GetStatistic("NumberOfCulledCells"), 0);
  const PlaceComparison compared =
    ComparePlaces(whole, DrawPlaces(filter->GetOutput(), camera), camera);
  EXPECT_GT(compared.Covered, 1000);
  EXPECT_EQ(compared.Coverage + compared.Place, 0);
}

// The scenes with a horizontal board.
INSTANTIATE_TEST_SUITE_P(Scenes, ReflectedGeometry, ::testing::Range<std::size_t>(1, 4));

//------------------------------------------------------------------------------
// All sources of an output: points, lines, polygons and strips at a plane mirror. Normals are
// mirrored in the type of the input, whose own array is not touched.
TEST(ReflectedGeometryOutput, PlaneMirrorsReverseNormalsAndWinding)
{
  for (const int images : { Filter::FIRST_IMAGE, Filter::ALL_IMAGES })
  {
    const auto grid = MakeGrid(9, 60.0, 40.0);
    AddBumps(grid, 1.0, VTK_FLOAT);
    vtkDataArray* normals = grid->GetPointData()->GetNormals();
    const auto filter = MakeMirror(grid, MakeFlatMembrane());
    filter->SetImages(images);
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    ASSERT_EQ(output->GetNumberOfPoints(), 81);
    ASSERT_EQ(output->GetNumberOfCells(), 64);
    vtkDataArray* mirrored = output->GetPointData()->GetNormals();
    ASSERT_TRUE(mirrored);
    EXPECT_STREQ(mirrored->GetName(), "Bumps");
    EXPECT_EQ(mirrored->GetDataType(), VTK_FLOAT);
    for (vtkIdType i = 0; i < 81; ++i)
    {
      const glm::dvec3 truth = PointOf(grid, i);
      EXPECT_LT(glm::length(PointOf(output, i) - glm::dvec3(truth.x, -truth.y, truth.z)), 1e-10);
      const glm::dvec3 n = TupleOf(normals, i);
      EXPECT_LT(glm::length(TupleOf(mirrored, i) - glm::dvec3(n.x, -n.y, n.z)), 1e-6);
      EXPECT_GT(n.y, 0.0);
    }
    for (vtkIdType cell = 0; cell < 64; ++cell)
    {
      // The front of the grid is its upper side, and that of its image the lower one.
      EXPECT_GT(GetAreaVector(grid, cell).y, 0.0);
      EXPECT_LT(GetAreaVector(output, cell).y, 0.0);
      EXPECT_EQ(output->GetCellData()->GetArray("ImageOrientation")->GetTuple1(cell), 1.0);
    }
  }
}

//------------------------------------------------------------------------------
TEST(ReflectedGeometryOutput, StripsAreReversedToo)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(MakeGrid(6, 60.0, 40.0));
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(triangles->GetOutputPort());
  strips->Update();
  ASSERT_GT(strips->GetOutput()->GetNumberOfStrips(), 0);
  for (const int images : { Filter::FIRST_IMAGE, Filter::ALL_IMAGES })
  {
    const auto filter = MakeMirror(strips->GetOutput(), MakeFlatMembrane());
    filter->SetImages(images);
    filter->Update();
    vtkNew<vtkTriangleFilter> split;
    split->SetInputData(filter->GetOutput());
    split->Update();
    double area = 0.0;
    for (vtkIdType cell = 0; cell < split->GetOutput()->GetNumberOfCells(); ++cell)
    {
      const glm::dvec3 along = GetAreaVector(split->GetOutput(), cell);
      EXPECT_LE(along.y, 0.0); // the doubled point of a strip makes a triangle without area
      area -= 0.5 * along.y;
    }
    EXPECT_NEAR(area, 3600.0, 1e-6);
  }
}

//------------------------------------------------------------------------------
// With VirtualNormals the diffuse light is that of the true normal, for lamps that shine on the
// geometry directly; the highlight's product is kept, too, where a normal has both.
TEST(ReflectedGeometryOutput, VirtualNormalsKeepTheDirectLight)
{
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 0.4, 0.02 * Pi, 1.0, 1.0, true };
  const auto grid = MakeGrid(9, 60.0, 40.0);
  AddBumps(grid, 0.8);
  vtkDataArray* normals = grid->GetPointData()->GetNormals();
  const auto filter = MakeMirror(grid, MakeMembrane(waves.MakeMesh(64)));
  filter->SetImagesToFirstImage();
  filter->VirtualNormalsOn();
  for (const glm::dvec3& light : { glm::dvec3(0.0), glm::normalize(glm::dvec3(1.0, 2.0, -0.5)) })
  {
    filter->SetLightDirection(light.x, light.y, light.z);
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    ASSERT_GT(output->GetNumberOfPoints(), 50);
    vtkDataArray* made = output->GetPointData()->GetArray("VirtualNormals");
    ASSERT_EQ(output->GetPointData()->GetNormals(), made);
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const auto source =
        static_cast<vtkIdType>(output->GetPointData()->GetArray("SourcePointId")->GetTuple1(i));
      const glm::dvec3 truth = TupleOf(normals, source);
      const glm::dvec3 n = TupleOf(made, i);
      EXPECT_NEAR(glm::length(n), 1.0, 1e-12);
      const bool isAtEye = light == glm::dvec3(0.0);
      const glm::dvec3 toLamp = isAtEye ? glm::normalize(Eye - PointOf(grid, source)) : light;
      const glm::dvec3 drawn = isAtEye ? glm::normalize(Eye - PointOf(output, i)) : light;
      EXPECT_NEAR(glm::dot(n, drawn), glm::dot(truth, toLamp), 1e-9);
    }
  }
}

//------------------------------------------------------------------------------
// The part behind the mirror is cut off along it.
TEST(ReflectedGeometryOutput, PiercingObjectsEndAtTheMirror)
{
  const auto filter = MakeMirror(MakeScreen(-5.0, -30.0, 50.0), MakeFlatMembrane());
  ExpectQuiet(filter);
  vtkPolyData* output = filter->GetOutput();
  double area = 0.0;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    area += 0.5 * glm::length(GetAreaVector(output, cell));
  }
  EXPECT_NEAR(area, 40.0 * 50.0, 1e-6);
  double highest = -1e300;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 p = PointOf(output, i);
    highest = std::max(highest, p.y);
    EXPECT_NEAR(p.z, -5.0, 1e-9);
    EXPECT_GE(p.y, -50.0 - 1e-9);
  }
  EXPECT_NEAR(highest, 0.0, 1e-9);
}

// The same at waves: the cut follows the analytic surface.
TEST(ReflectedGeometryOutput, PiercingObjectsEndAtWaves)
{
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 2.0, 0.02 * Pi, 1.0, 1.0, true };
  const auto screen = MakeScreen(-12.0, -30.0, 50.0);
  AddPlaces(screen);
  const auto filter = MakeMirror(screen, MakeMembrane(waves.MakeMesh(96)));
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  vtkDataArray* places = output->GetPointData()->GetArray("Place");
  int onMirror = 0;
  ASSERT_GT(output->GetNumberOfPoints(), 20);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 place = TupleOf(places, i);
    const double above = place.y - waves.GetHeight(place.x, place.z);
    EXPECT_GT(above, -0.01); // chords of the cut, within 0.005 degrees at a distance of 300
    onMirror += above < 0.01;
  }
  EXPECT_GT(onMirror, 10);
}

// Waves so steep that they reflect rays to each other: where such a ray goes on below the surface,
// pieces of the object are dropped.
TEST(ReflectedGeometryOutput, SteepWavesShowNothingBelowThem)
{
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 12.0, 0.03 * Pi, 1.0, 1.0, true };
  const auto screen = MakeScreen(-12.0, -30.0, 50.0);
  AddPlaces(screen);
  const auto filter = MakeMirror(screen, MakeMembrane(waves.MakeMesh(96)));
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  vtkDataArray* places = output->GetPointData()->GetArray("Place");
  vtkNew<vtkIdList> ids;
  ASSERT_GT(output->GetNumberOfCells(), 100);
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    output->GetCellPoints(cell, ids);
    glm::dvec3 middle(0.0);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      middle += TupleOf(places, ids->GetId(k)) / static_cast<double>(ids->GetNumberOfIds());
    }
    // The mesh's own error is of third order in facets of 2, some 0.01.
    EXPECT_GT(middle.y - waves.GetHeight(middle.x, middle.z), -0.05);
  }
}

//------------------------------------------------------------------------------
TEST(ReflectedGeometryBadInput, ObjectsBehindTheMirrorAreReported)
{
  const auto filter = MakeMirror(MakeGrid(5, 60.0, -40.0), MakeFlatMembrane());
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetStatistic("NumberOfVerticesWithoutImage"), 25);
  EXPECT_EQ(filter->GetStatistic("NumberOfSkippedCells"), 16);
  EXPECT_EQ(messages->Warnings, 1);
  EXPECT_TRUE(HasText(messages->Text, "None of the 25 points has an image"));
}

TEST(ReflectedGeometryBadInput, EyesOnTheMirrorAreAnError)
{
  const auto filter = MakeMirror(MakeGrid(5, 60.0, 40.0), MakeFlatMembrane());
  filter->SetEyePosition(10.0, 0.0, 10.0);
  const auto messages = UpdateAndObserve(filter);
  EXPECT_TRUE(HasText(messages->Text, "lies on the membrane"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(ReflectedGeometryBadInput, BacksOfMirrorsAreReported)
{
  const auto open = MakeMirror(MakeGrid(5, 60.0, 40.0), MakeFlatMembrane());
  open->SetEyePosition(10.0, -100.0, 10.0);
  const auto messages = UpdateAndObserve(open);
  EXPECT_EQ(open->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(open->GetStatistic("NumberOfVerticesWithoutImage"), 25);
  EXPECT_EQ(messages->Warnings, 1);
  EXPECT_TRUE(HasText(messages->Text, "No facet of the membrane faces the eye"));
  EXPECT_TRUE(HasText(messages->Text, "sees the back of the mirror only"));

  const auto ball =
    MakeMirror(MakeGrid(5, 0.4, 0.3), MakeMembrane(meniscus::reference::MakeSphere(16, 1.0)));
  ball->SetEyePosition(0.1, -0.2, 0.1);
  const auto told = UpdateAndObserve(ball);
  EXPECT_EQ(ball->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(ball->GetStatistic("IsEyeEnclosed"));
  EXPECT_TRUE(HasText(told->Text, "sees the back of the mirror only"));
}

TEST(ReflectedGeometryBadInput, FlatFacetsAndListsAreErrors)
{
  const auto flat = MakeMirror(MakeGrid(5, 60.0, 40.0), MakeFlatMembrane());
  flat->SetMembraneModelToFlatFacets();
  const auto messages = UpdateAndObserve(flat);
  EXPECT_EQ(flat->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(HasText(messages->Text, "REFLECTION needs the membrane model CURVED"));

  const auto stack = MakeMirror(MakeGrid(5, 60.0, 40.0), MakeFlatMembrane());
  stack->AddInputData(1, MakeFlatMembrane());
  const auto told = UpdateAndObserve(stack);
  EXPECT_EQ(stack->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_GT(told->Errors, 0);
}

//------------------------------------------------------------------------------
// A change of the mode is a change of the eye's rays; going back gives the first result again.
TEST(ReflectedGeometryCache, ModesDoNotMix)
{
  const auto screen = MakeScreen(-5.0, -30.0, 50.0);
  const auto filter = MakeMirror(screen, MakeFlatMembrane());
  filter->SetModeToRefraction();
  filter->Update();
  vtkNew<vtkPolyData> refracted;
  refracted->DeepCopy(filter->GetOutput());
  filter->SetModeToReflection();
  filter->Update();
  EXPECT_NE(filter->GetOutput()->GetNumberOfPoints(), refracted->GetNumberOfPoints());
  filter->SetModeToRefraction();
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), refracted->GetNumberOfPoints());
  for (vtkIdType i = 0; i < refracted->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(PointOf(filter->GetOutput(), i), PointOf(refracted, i));
  }
  EXPECT_EQ(filter->GetNumberOfPatchBuilds(), 1);
  EXPECT_EQ(filter->GetNumberOfEyeUpdates(), 3);
}

}

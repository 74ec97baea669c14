// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The filter's output, drawn, compared with ray tracing of the analytic membrane, pixel by pixel.
#include "RefractedGeometryTestHelpers.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus::test;

vtkSmartPointer<vtkPolyData> MakeObject(const PictureScene& scene)
{
  const auto grid = MakeGrid(scene.Tiles + 1, scene.Size, -scene.Depth);
  AddPlaces(grid);
  return grid;
}

vtkSmartPointer<vtkRefractedGeometryFilter> MakeSceneFilter(const PictureScene& scene)
{
  auto filter = MakeAllImages(MakeObject(scene), MakeMembrane(scene.Field.MakeMesh(scene.Cells)));
  filter->SetEyePosition(scene.Eye.x, scene.Eye.y, scene.Eye.z);
  filter->SetExteriorIndexOfRefraction(scene.Field.Exterior);
  filter->SetInteriorIndexOfRefraction(scene.Field.Interior);
  return filter;
}

class RefractedGeometryRayTrace : public ::testing::TestWithParam<int>
{
};

// A pixel differs if only one of the two images shows the object there, or if their places differ
// by more than half a pixel. Also printed: the number of pixels in another square of a checkerboard
// with 20 squares a side, which a shift of any of its many edges changes.
TEST_P(RefractedGeometryRayTrace, PixelsAgree)
{
  const PictureScene scene = GetPictureScenes()[static_cast<std::size_t>(GetParam())];
  const PixelCamera camera = scene.GetCamera();
  const auto filter = MakeSceneFilter(scene);
  ExpectQuiet(filter);

  const PlacePicture drawn = DrawPlaces(filter->GetOutput(), camera);
  const PlacePicture traced =
    TracePlaces(scene.Field, camera, MakeSquareTracer(-scene.Depth, scene.Size));
  const PlaceComparison compared = ComparePlaces(traced, drawn, camera);
  const auto square = [&scene](const glm::dvec3& place)
  {
    const double unit = scene.Size / 20.0;
    return static_cast<int>(std::floor(place.x / unit) + std::floor(place.z / unit)) & 1;
  };
  int colour = 0;
  for (std::size_t i = 0; i < traced.size(); ++i)
  {
    colour +=
      traced[i].Covered && drawn[i].Covered && square(traced[i].Place) != square(drawn[i].Place);
  }
  std::printf("%s: %d pixels, %d differ in coverage, %d in place, %d in colour, %lld cells\n",
    scene.Name.c_str(), compared.Covered, compared.Coverage, compared.Place, colour,
    static_cast<long long>(filter->GetOutput()->GetNumberOfCells()));
  EXPECT_GT(compared.Covered, camera.GetPixels() * camera.GetPixels() / 20);
  EXPECT_LE(compared.Coverage + compared.Place, compared.Covered / 1000);
}

// With a tolerance of two pixels the image may have an error of two pixels, but there are no
// cracks: each pixel well inside of the visible part is drawn.
TEST_P(RefractedGeometryRayTrace, NoCracksWithACoarseTolerance)
{
  const PictureScene scene = GetPictureScenes()[static_cast<std::size_t>(GetParam())];
  const PixelCamera camera = scene.GetCamera();
  const auto filter = MakeSceneFilter(scene);
  filter->SetAngularTolerance(0.12);
  filter->Update();
  const PlacePicture drawn = DrawPlaces(filter->GetOutput(), camera);
  const PlacePicture traced =
    TracePlaces(scene.Field, camera, MakeSquareTracer(-scene.Depth, scene.Size));
  constexpr int reach = 5;
  const int pixels = camera.GetPixels();
  int inside = 0;
  int cracks = 0;
  for (const auto& [y, x] :
    Product(Numbers<int>(reach, pixels - reach), Numbers<int>(reach, pixels - reach)))
  {
    bool isInside = true;
    for (int dy = -reach; dy <= reach; ++dy)
    {
      for (int dx = -reach; dx <= reach; ++dx)
      {
        isInside = isInside && traced[static_cast<std::size_t>((y + dy) * pixels + x + dx)].Covered;
      }
    }
    inside += isInside;
    cracks += isInside && !drawn[static_cast<std::size_t>(y * pixels + x)].Covered;
  }
  std::printf("%s: %d pixels inside, %d not drawn\n", scene.Name.c_str(), inside, cracks);
  EXPECT_GT(inside, pixels * pixels / 30);
  EXPECT_EQ(cracks, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RefractedGeometryRayTrace, ::testing::Range(0, 5));

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The filter's output, drawn, against ray tracing the analytic membrane pixel by pixel.
#include "RefractedGeometryTestHelpers.h"
#include "RefractionPicture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace
{

using namespace meniscus::testing;

vtkSmartPointer<vtkPolyData> MakeObject(const PictureScene& scene)
{
  const auto grid = MakeGrid(scene.tiles + 1, scene.size, -scene.depth);
  AddPlaces(grid);
  return grid;
}

class RefractedGeometryRayTrace : public ::testing::TestWithParam<int>
{
};

// A pixel differs if only one of the two shows the object there, or if what it shows is more than
// half a pixel away. Printed as well: how many are in another square of a checkerboard with 20
// squares a side, which any shift of its many edges changes.
TEST_P(RefractedGeometryRayTrace, PixelsAgree)
{
  const PictureScene scene = GetPictureScenes()[static_cast<std::size_t>(GetParam())];
  const PixelCamera camera = scene.GetCamera();
  const auto filter =
    MakeFilter(MakeObject(scene), MakeMembrane(scene.field.MakeMesh(scene.cells)));
  filter->SetMembraneModelToCurved();
  filter->SetImagesToAllImages();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetEyePosition(scene.eye.x, scene.eye.y, scene.eye.z);
  filter->SetExteriorIndexOfRefraction(scene.field.exterior);
  filter->SetInteriorIndexOfRefraction(scene.field.interior);
  const auto messages = Observe(filter);
  filter->Update();
  EXPECT_EQ(messages->errors + messages->warnings, 0) << messages->text;

  const PlacePicture drawn = DrawPlaces(filter->GetOutput(), camera);
  const PlacePicture traced =
    TracePlaces(scene.field, camera, MakeSquareTracer(-scene.depth, scene.size));
  const PlaceComparison compared = ComparePlaces(traced, drawn, camera);
  const auto square = [&scene](const glm::dvec3& place)
  {
    const double unit = scene.size / 20.0;
    return static_cast<int>(std::floor(place.x / unit) + std::floor(place.z / unit)) & 1;
  };
  int colour = 0;
  for (std::size_t i = 0; i < traced.size(); ++i)
  {
    colour +=
      traced[i].covered && drawn[i].covered && square(traced[i].place) != square(drawn[i].place);
  }
  std::printf("%s: %d pixels, %d differ in coverage, %d in place, %d in colour, %lld cells\n",
    scene.name.c_str(), compared.covered, compared.coverage, compared.place, colour,
    static_cast<long long>(filter->GetOutput()->GetNumberOfCells()));
  EXPECT_GT(compared.covered, camera.GetPixels() * camera.GetPixels() / 20);
  EXPECT_LE(compared.coverage + compared.place, compared.covered / 1000);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RefractedGeometryRayTrace, ::testing::Range(0, 5));

}

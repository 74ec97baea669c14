// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Textures on objects that are seen through a medium, against VTK's own pictures of them.
#include "Schlieren/MirageScene.h"
#include "VolumeScene.h"

#include <vtkActor.h>
#include <vtkPolyDataMapper.h>
#include <vtkTexture.h>

using namespace meniscus::test;

namespace
{

/** A wall whose texture coordinates go beyond the image on all sides. */
Object MakeWall(bool hasColors)
{
  const Object wall = MakePlane(0.3, 1.0);
  const vtkIdType count = wall->GetNumberOfPoints();
  wall->GetPointData()->SetTCoords(MakeArray<vtkDoubleArray>(nullptr, count,
    [&](vtkIdType point)
    {
      const glm::dvec3 place = glm::make_vec3(wall->GetPoint(point));
      return glm::dvec2(0.453 + 1.87 * place.x - 0.31 * place.y, 0.371 + 0.23 * place.x + place.y);
    }));
  if (hasColors)
  {
    wall->GetPointData()->SetScalars(MakeArray<vtkUnsignedCharArray>(nullptr, count,
      [&](vtkIdType point) { return glm::dvec3(40.0 + 4.0 * double(point), 255.0, 120.0); }));
  }
  return wall;
}

/** Random texels: colours, or numbers that a lookup table maps. */
vtkSmartPointer<vtkImageData> MakeTexels(int width, int height, bool areColors)
{
  std::mt19937 random(7);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(areColors ? VTK_UNSIGNED_CHAR : VTK_FLOAT, areColors ? 3 : 1);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    values->SetVariantValue(i, int(random() % 256));
  }
  return image;
}

/** VTK's picture of the object without light. */
ByteImage DrawByVTK(vtkPolyData* object, vtkTexture* texture, vtkCamera* camera)
{
  VolumeScene scene(Size, Size);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(object);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  actor->GetProperty()->LightingOff();
  scene.GetRenderer()->AddActor(actor);
  scene.GetRenderer()->SetActiveCamera(camera);
  scene.GetRenderer()->ResetCameraClippingRange();
  return scene.RenderBytes();
}

Filter MakeTextured(vtkPolyData* object, vtkTexture* texture)
{
  Filter filter = MakeFilter(MakeBlock(3, ConstantField(1.3)), object);
  filter->SetTexture(texture);
  filter->SetAmbient(1.0);
  return filter;
}

}

// With every way to wrap, with and without interpolation, with colours of points and a lookup
// table: a medium that bends nothing shows the picture that VTK draws.
TEST(MirageTexture, LooksAsVTKDrawsIt)
{
  const vtkSmartPointer<vtkCamera> camera = MakeCamera({ 0.15, -0.1, 4.0 }, { 0.02, 0, 0 }, 0.25);
  for (const auto& [wrap, choice] : Product(int(vtkTexture::NumberOfWrapModes), 4))
  {
    const bool isSmooth = choice % 2 == 1;
    vtkNew<vtkTexture> texture;
    texture->SetInputData(MakeTexels(7, 5, choice < 2));
    texture->SetWrap(wrap);
    texture->SetBorderColor(0.2f, 0.9f, 0.4f, 1.0f);
    texture->SetInterpolate(isSmooth ? 1 : 0);
    const Object wall = MakeWall(choice > 1);
    Filter filter = MakeTextured(wall, texture);
    filter->SetCamera(camera);
    filter->Update();
    const ByteImage expected = DrawByVTK(wall, texture, camera);
    int differing = 0;
    for (vtkIdType pixel = 0; pixel < Size * Size; ++pixel)
    {
      const glm::dvec3 color = VectorAt(filter, "Color", pixel);
      const unsigned char* bytes = expected.GetPixel(int(pixel) % Size, int(pixel) / Size);
      const glm::dvec3 difference = glm::abs(color - glm::dvec3(bytes[0], bytes[1], bytes[2]));
      // OpenGL interpolates with weights of 8 bits: half a weight of 255 levels in both directions
      // is one level, and each side rounds the result.
      differing += std::max({ difference.x, difference.y, difference.z }) > 2.0 ? 1 : 0;
    }
    EXPECT_EQ(differing, 0) << "wrap " << wrap << ", choice " << choice;
  }
}

TEST(MirageTexture, FollowsItsImage)
{
  vtkNew<vtkTexture> texture;
  const vtkSmartPointer<vtkImageData> image = MakeTexels(1, 1, true);
  texture->SetInputData(image);
  Filter filter = MakeTextured(MakeWall(false), texture);
  filter->Update();
  const vtkMTimeType time = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), time);
  for (int k = 0; k < 3; ++k)
  {
    image->GetPointData()->GetScalars()->SetComponent(0, k, 10.0 * k + 5.0);
  }
  image->Modified();
  filter->Update();
  EXPECT_EQ(VectorAt(filter, "Color", Size / 2), glm::dvec3(5.0, 15.0, 25.0));
}

TEST(MirageTexture, OddTexturesAreErrorsOrWarnings)
{
  vtkNew<vtkTexture> none;
  vtkNew<vtkTexture> solid;
  vtkNew<vtkImageData> block;
  block->SetDimensions(2, 2, 2);
  block->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  solid->SetInputData(block);
  vtkNew<vtkTexture> cube;
  cube->CubeMapOn();
  cube->SetInputData(MakeTexels(2, 2, true));
  ExpectError(MakeTextured(MakeWall(false), none), "no image");
  ExpectError(MakeTextured(MakeWall(false), solid), "volume or a cube map");
  ExpectError(MakeTextured(MakeWall(false), cube), "volume or a cube map");

  vtkNew<vtkTexture> texture;
  texture->SetInputData(MakeTexels(3, 3, true));
  const Object plain = MakePlane(0.3, 1.0);
  plain->GetPointData()->SetTCoords(nullptr);
  Filter filter = MakeTextured(plain, texture);
  const auto observer = ObserveErrors(filter);
  filter->Update();
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(observer->Warnings[0], "no texture coordinates"));
  EXPECT_EQ(VectorAt(filter, "Color", Size / 2), glm::dvec3(255.0));

  // Coordinates that are not finite, or too large for a number of a texel.
  const Object wall = MakeWall(false);
  for (const double value : { NaN, 1.0e300, -1.0e300 })
  {
    vtkDataArray* coordinates = wall->GetPointData()->GetTCoords();
    coordinates->FillComponent(0, value);
    coordinates->Modified();
    wall->Modified();
    Filter odd = MakeTextured(wall, texture);
    odd->Update();
    EXPECT_EQ(VectorAt(odd, "Color", 0) == glm::dvec3(255.0), std::isnan(value));
  }
}

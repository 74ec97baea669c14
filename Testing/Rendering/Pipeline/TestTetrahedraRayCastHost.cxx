// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Programs that change the arithmetic of their threads, as OSPRay does when it starts.
#include "HostArithmetic.h"
#include "RayCastScene.h"

using namespace meniscus::test;

namespace
{

vtkSmartPointer<vtkVolumeProperty> MakeLook()
{
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetScalarOpacityUnitDistance(1.0);
  // The number after 0 is not a normal one.
  property->SetScalarOpacity(MakeOpacity({ { -1.0, 0.1 }, { 0.0, 0.9 }, { 1.0, 0.4 } }));
  property->SetColor(MakeColors({ { 0.0, 1.0, 0.2, 0.1 }, { 1.0, 0.1, 0.5, 1.0 } }));
  property->ShadeOn();
  return property;
}

ByteImage Draw(bool flushed)
{
  std::optional<FlushedArithmetic> host;
  if (flushed)
  {
    host.emplace();
  }
  RayCastScene scene(MakeBlock(4, WavyField(2.0)), MakeLook(), 64, 64);
  const ByteImage picture = scene.RenderBytes();
  EXPECT_EQ(FlushesSmallNumbers(), flushed);
  return picture;
}

} // anonymous namespace

TEST(TetrahedraRayCastHost, PicturesDoNotDependOnTheHostsArithmetic)
{
  const ByteImage expected = Draw(false);
  const ByteImage picture = Draw(true);
  EXPECT_TRUE(picture.Rgb == expected.Rgb);
  EXPECT_NE(*std::max_element(expected.Rgb.begin(), expected.Rgb.end()), 0);
}

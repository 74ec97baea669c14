// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MapScene.h"
#include "VolumeRelation.h"

namespace meniscus::test
{

namespace
{

glm::dmat4 RandomRotation(RandomNumbers& random)
{
  const double angle = random.Uniform(0.0, 2.0 * vtkMath::Pi());
  return glm::rotate(glm::dmat4(1.0), angle, random.GetDirection());
}

glm::dmat4 RandomReflection(RandomNumbers& random)
{
  const glm::dvec3 normal = random.GetDirection();
  return glm::dmat4(glm::dmat3(1.0) - 2.0 * glm::outerProduct(normal, normal));
}

//------------------------------------------------------------------------------
void CheckMirror(VolumeTrial& trial)
{
  VolumeCase changed = trial.MakeScene();
  MapScene(changed, RandomReflection(trial.MakeRandom()));
  trial.MakePicture();
  const int last = changed.Size - 1;
  trial.ExpectSame(
    trial.GetStage().Draw(changed),
    [last](int x, int y) {
      return std::array<int, 2>{ last - x, y };
    },
    PlainTolerance(changed.Backend), "mirrored");
}

// Converts points to model coordinates, with an affine matrix that maps them back.
void MoveToMatrix(VolumeCase& test, RandomNumbers& random)
{
  glm::dmat3 linear(1.0);
  for (int column = 0; column < 3; ++column)
  {
    linear[column] += 0.4 * random.GetDirection();
  }
  linear *= std::pow(10.0, random.Uniform(-3.0, 3.0)) * (random.Below(2) ? 1.0 : -1.0);
  test.Matrix = glm::dmat4(linear);
  test.Matrix[3] = glm::dvec4(10.0 * random.GetDirection(), 1.0);
  const glm::dmat4 inverse = glm::inverse(test.Matrix);
  for (glm::dvec3& p : test.MakeMesh().Points)
  {
    p = PointBy(inverse, p);
  }
}

// Planes that keep the whole mesh, some of them touching its bounding sphere.
void AddIdlePlanes(VolumeCase& test, RandomNumbers& random)
{
  double b[6];
  test.MakeMesh().GetBounds(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  const double radius = 0.5 * DiagonalOf(b);
  for (int i = 1 + random.Below(6); i > 0; --i)
  {
    const glm::dvec3 normal = random.GetDirection();
    test.Planes.push_back({ center - random.Uniform(1.001, 2.0) * radius * normal, normal });
  }
}

// A plane that cuts the mesh, given once and several times.
void CheckRepeatedPlane(VolumeTrial& trial)
{
  VolumeCase changed = trial.MakeScene();
  const auto plane = changed.Planes.front();
  changed.Planes.push_back({ plane[0], 3.0 * plane[1] });
  changed.Planes.push_back({ plane[0] - 0.1 * plane[1], plane[1] });
  trial.ExpectSame(changed, "plane repeated");
}

void AddCuttingPlane(VolumeCase& test, RandomNumbers& random)
{
  double b[6];
  test.MakeMesh().GetBounds(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  test.Planes.push_back({ center, random.GetDirection() });
}

// A parallel camera sees the same image from farther away; clipping planes may lie anywhere
// outside.
void MoveClippingRange(VolumeCase& test, RandomNumbers& random)
{
  VolumeView& view = test.View;
  double b[6];
  test.MakeMesh().GetBounds(b);
  const glm::dvec3 center = 0.5 * glm::dvec3(b[0] + b[1], b[2] + b[3], b[4] + b[5]);
  if (view.Parallel)
  {
    const glm::dvec3 back = view.Eye - view.Focus;
    const double more = random.Uniform(0.1, 10.0);
    view.Eye += more * back;
    view.Near += more * glm::length(back);
    view.Far += more * glm::length(back);
  }
  // The near plane affects an eye inside the mesh.
  const bool outside = glm::distance(view.Eye, center) > 0.51 * DiagonalOf(b);
  view.Near *= outside ? random.Uniform(0.9, 1.0) : 1.0;
  view.Far *= random.Uniform(1.0, 2.0);
}

//------------------------------------------------------------------------------
// The quarters of the image, each drawn as a separate image by a camera with a window centre, as
// vtkWindowToImageFilter does for large images.
void CheckTiles(VolumeTrial& trial)
{
  FloatImage whole = trial.MakePicture();
  VolumeCase tile = trial.MakeScene();
  tile.Size /= 2;
  tile.View.HalfHeight /= 2.0;
  for (int i = 0; i < 4; ++i)
  {
    const int column = i % 2;
    const int row = i / 2;
    trial.GetStage().GetPlace(tile);
    vtkCamera* camera = trial.GetStage().MakeScene().GetRenderer()->GetActiveCamera();
    camera->SetWindowCenter(2.0 * column - 1.0, 2.0 * row - 1.0);
    const FloatImage part = trial.GetStage().Render();
    camera->SetWindowCenter(0.0, 0.0);
    for (const auto& [y, x] : Product(tile.Size, tile.Size))
    {
      const auto at =
        std::size_t(row * tile.Size + y) * whole.Width + std::size_t(column * tile.Size + x);
      std::copy_n(part.GetPixel(x, y), 4, &whole.Rgba[4 * at]);
    }
  }
  trial.ExpectSame(whole, "tiles");
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<VolumeRelation> PlaceRelations()
{
  const CaseNeeds any;
  CaseNeeds noMembrane;
  noMembrane.NoMembrane = true;
  return {
    RelationOf("rotation", 4, any,
      [](VolumeCase& test, RandomNumbers& random) { MapScene(test, RandomRotation(random)); }),
    { "mirroring", 4, any, CheckMirror, nullptr },
    RelationOf("translation", 4, any,
      [](VolumeCase& test, RandomNumbers& random)
      {
        const glm::dvec3 offset = std::pow(10.0, random.Uniform(0.0, 6.0)) * random.GetDirection();
        MapScene(test, glm::translate(glm::dmat4(1.0), offset));
      }),
    RelationOf("scaling", 4, any,
      [](VolumeCase& test, RandomNumbers& random)
      {
        const double factor = std::pow(10.0, random.Uniform(-6.0, 6.0));
        MapScene(test, glm::scale(glm::dmat4(1.0), glm::dvec3(factor)));
      }),
    RelationOf("matrix of the volume", 4, any, MoveToMatrix),
    RelationOf("planes that cut nothing", 4, any, AddIdlePlanes),
    { "plane repeated", 3, any, CheckRepeatedPlane, AddCuttingPlane },
    RelationOf("clipping range", 4, noMembrane, MoveClippingRange),
    { "tiles", 3, any, CheckTiles, nullptr },
  };
}

} // namespace meniscus::test

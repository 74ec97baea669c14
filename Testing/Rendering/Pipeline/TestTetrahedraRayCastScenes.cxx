// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// The volume with other objects: camera inside it, opaque geometry, several renderers, resized and
// multisampled windows.
#include "RayCastScene.h"

using namespace meniscus::test;
using namespace meniscus::reference;

namespace
{

constexpr int Size = 100;

struct Block
{
  Grid Mesh = MakeBlock(8, WavyField(3.0));
  vtkSmartPointer<vtkVolumeProperty> Property;

  Block()
  {
    this->Property =
      MakeProperty(FunctionKind::Smooth, this->Mesh, DiagonalOf(this->Mesh->GetBounds()));
  }
};

// An opaque rectangle across the view direction, so that its depth is the same in every pixel and
// does not change with the device's rounding of vertex positions.
class OpaqueRectangle
{
public:
  OpaqueRectangle(vtkRenderer* renderer, double depth, double halfWidth, double halfHeight)
    : Depth(depth)
    , Half{ halfWidth, halfHeight }
  {
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->GetPosition(this->Eye.data());
    camera->GetDirectionOfProjection(this->Forward.data());
    double up[3];
    camera->GetViewUp(up);
    vtkMath::Cross(this->Forward.data(), up, this->Right.data());
    vtkMath::Normalize(this->Right.data());
    vtkMath::Cross(this->Right.data(), this->Forward.data(), this->Up.data());
    vtkNew<vtkPlaneSource> source;
    source->SetOrigin(this->GetCorner(-1, -1).data());
    source->SetPoint1(this->GetCorner(1, -1).data());
    source->SetPoint2(this->GetCorner(-1, 1).data());
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    this->Actor->SetMapper(mapper);
    this->Actor->GetProperty()->SetLighting(false);
    this->Actor->GetProperty()->SetColor(Color[0], Color[1], Color[2]);
    renderer->AddActor(this->Actor);
  }

  // Returns true if a ray hits it, and ends the ray there.
  bool Shorten(Ray& ray) const
  {
    Vector3 fromEye;
    for (int axis = 0; axis < 3; ++axis)
    {
      fromEye[axis] = ray.Origin[axis] - this->Eye[axis];
    }
    const double t = (this->Depth - vtkMath::Dot(fromEye.data(), this->Forward.data())) /
      vtkMath::Dot(ray.Direction.data(), this->Forward.data());
    for (int axis = 0; axis < 3; ++axis)
    {
      fromEye[axis] += t * ray.Direction[axis];
    }
    if (std::fabs(vtkMath::Dot(fromEye.data(), this->Right.data())) > this->Half[0] ||
      std::fabs(vtkMath::Dot(fromEye.data(), this->Up.data())) > this->Half[1])
    {
      return false;
    }
    ray.End = t;
    return true;
  }

  static constexpr double Color[3] = { 0.2, 0.8, 0.4 };

private:
  Vector3 GetCorner(int right, int up) const
  {
    Vector3 x;
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = this->Eye[axis] + this->Depth * this->Forward[axis] +
        right * this->Half[0] * this->Right[axis] + up * this->Half[1] * this->Up[axis];
    }
    return x;
  }

  vtkNew<vtkActor> Actor;
  Vector3 Eye;
  Vector3 Forward;
  Vector3 Right;
  Vector3 Up;
  double Depth;
  double Half[2];
};

// A rasteriser rounds vertices to a grid of 1/256 pixel: a pixel nearer to the rectangle's edge
// than this (in pixels, with a factor of 4) may or may not be covered.
constexpr double EdgeUncertainty = 4.0 / 256.0;

bool NearEdge(const OpaqueRectangle& rectangle, const PixelRays& rays, int x, int y)
{
  int hits = 0;
  for (int i = 0; i < 4; ++i)
  {
    Ray ray = rays.RayAt(
      x + 0.5 + (i % 2 ? 1 : -1) * EdgeUncertainty, y + 0.5 + (i / 2 ? 1 : -1) * EdgeUncertainty);
    hits += rectangle.Shorten(ray);
  }
  return hits != 0 && hits != 4;
}

void ExpectMatchesWithRectangle(RayCastScene& scene, double depth, const std::string& what)
{
  const OpaqueRectangle rectangle(scene.GetRenderer(), depth, 0.55, 0.4);
  scene.GetWindow()->Render();
  const auto integrator = MakeReference(scene.MakeGrid());
  const PixelRays rays(scene.GetRenderer());
  const RayOfPixel rayOf = [&](int x, int y)
  {
    Ray ray = rays.GetRay(x, y);
    rectangle.Shorten(ray);
    return ray;
  };
  ReferenceImage truth = RenderReference(*integrator, rays.GetWidth(), rays.GetHeight(), rayOf,
    { ToReference(scene.GetVolume()->GetProperty()) })[0];
  FloatImage image = scene.RenderFloat();
  std::size_t uncertain = 0;
  for (const auto& [y, x] : Product(truth.Height, truth.Width))
  {
    const std::size_t at = static_cast<std::size_t>(y) * truth.Width + x;
    std::array<double, 4>& rgba = truth.Rgba[at];
    Ray ray = rays.GetRay(x, y);
    if (rectangle.Shorten(ray))
    {
      for (int c = 0; c < 3; ++c)
      {
        rgba[c] += (1.0 - rgba[3]) * OpaqueRectangle::Color[c];
      }
      rgba[3] = 1.0;
      truth.Covered[at] = 1;
    }
    if (NearEdge(rectangle, rays, x, y))
    {
      ++uncertain;
      std::copy(rgba.begin(), rgba.end(), image.Rgba.begin() + 4 * static_cast<long>(at));
    }
  }
  EXPECT_LT(uncertain, 200u) << what;
  ExpectMatch(CompareToReference(image, truth, *integrator, rayOf), what);
}

// Compares the part of a window that a renderer draws, in 8 bits, with the reference.
void ExpectViewportMatches(const RayCastScene& scene, vtkRenderer* renderer,
  const ByteImage& window, const std::string& what)
{
  const PixelRays rays(renderer);
  const auto integrator = MakeReference(scene.MakeGrid());
  const RayOfPixel rayOf = [&rays](int x, int y) { return rays.GetRay(x, y); };
  const ReferenceImage truth = RenderReference(*integrator, rays.GetWidth(), rays.GetHeight(),
    rayOf, { ToReference(scene.GetVolume()->GetProperty()) })[0];
  double background[3];
  renderer->GetBackground(background);
  ExpectMatch(CompareToReference(window, truth, *integrator, rayOf,
                { background[0], background[1], background[2] }, rays.GetLeft(), rays.GetBottom()),
    what);
}

} // anonymous namespace

TEST(TetrahedraRayCastScenes, ColoredBackground)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.Property, Size, Size);
  scene.GetRenderer()->SetBackground(0.2, 0.4, 0.8);
  const SceneTruth truth = [&]
  {
    scene.GetWindow()->Render();
    return MakeTruth(scene);
  }();
  ExpectMatch(CompareToReference(scene.RenderBytes(), truth.Image, *truth.Integrator, truth.RayOf,
                { 0.2, 0.4, 0.8 }),
    "coloured background");
}

// The image is rounded to 8 bits once, not before it is blended over the framebuffer; a bias is
// added only where the volume is.
TEST(TetrahedraRayCastScenes, RoundedOnceToEightBits)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.Property, Size, Size);
  LookAt(scene.GetRenderer(), block.Mesh->GetBounds(), 30.0, 20.0, 0.7);
  const FloatImage volume = scene.RenderFloat();
  constexpr std::array<double, 3> background{ 51.0, 102.0, 204.0 };
  scene.GetRenderer()->SetBackground(0.2, 0.4, 0.8);
  scene.GetRenderer()->SetBackgroundAlpha(1.0);
  for (const double bias : { 0.0, 0.25, 0.5 })
  {
    scene.GetRayCaster()->SetColorBias(bias);
    const ByteImage picture = scene.RenderBytes();
    double worst = 0.0;
    std::size_t empty = 0;
    for (int i = 0; i < Size * Size; ++i)
    {
      const float* rgba = volume.GetPixel(i % Size, i / Size);
      empty += rgba[3] == 0.0f;
      for (int c = 0; c < 3; ++c)
      {
        const double exact = 255.0 * rgba[c] + (1.0 - rgba[3]) * background[c];
        const double expected = std::min(255.0, exact + (rgba[3] > 0.0f ? bias : 0.0));
        worst = std::max(worst, std::fabs(picture.GetPixel(i % Size, i / Size)[c] - expected));
      }
    }
    EXPECT_GT(empty, 100u);
    // Half a step, plus the error of single precision times 255.
    EXPECT_LT(worst, 0.5 + 255.0 * 1.0e-5) << "bias " << bias;
  }
}

TEST(TetrahedraRayCastScenes, CameraInsideTheMesh)
{
  const Block block;
  for (const double x : { 0.0, 0.31 })
  {
    RayCastScene scene(block.Mesh, block.Property, Size, Size);
    vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
    camera->SetPosition(x, 0.12 * (x > 0.0), 0.07 * (x > 0.0));
    camera->SetFocalPoint(1.0, 0.4, -0.3);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(70.0);
    camera->SetClippingRange(0.001, 10.0);
    ExpectMatchesReference(scene, "camera inside at " + std::to_string(x));
  }
}

TEST(TetrahedraRayCastScenes, ClippingRangeThroughTheMesh)
{
  const Block block;
  for (const bool parallel : { false, true })
  {
    RayCastScene scene(block.Mesh, block.Property, Size, Size);
    LookAt(scene.GetRenderer(), block.Mesh->GetBounds(), 30.0, 20.0, 1.0, parallel);
    vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
    const double distance = camera->GetDistance();
    camera->SetClippingRange(distance - 0.4, distance + 0.3);
    ExpectMatchesReference(scene, parallel ? "cut, parallel" : "cut, perspective");
  }
}

// A near plane nearly at the eye, and a far plane at a distance that no float holds, cut nothing
// off and take no digits from anything.
TEST(TetrahedraRayCastScenes, ClippingRangesOfAnyRatio)
{
  // The planes of the truth remove this from rays that begin inside, in units of the mesh's radius;
  // a volume of which 1 / 30 is nearly opaque takes thirty times as much of the light.
  constexpr double removed = 1.0e-6;
  constexpr double ranges[][2] = { { 1.0e-4, 1.0e+9 }, { 1.0e-7, 30.0 }, { 1.0e-12, 30.0 },
    { 1.0e-12, 1.0e+30 }, { 1.0e-30, 30.0 }, { 1.0e-300, 30.0 }, { 1.0e-300, 1.0e+300 } };
  const Block block;
  for (const bool inside : { false, true })
  {
    RayCastScene scene(block.Mesh, block.Property, Size, Size);
    vtkCamera* camera = scene.GetRenderer()->GetActiveCamera();
    if (inside)
    {
      camera->SetPosition(0.31, 0.12, 0.07);
      camera->SetFocalPoint(1.0, 0.4, -0.3);
      camera->SetViewAngle(70.0);
    }
    camera->SetClippingRange(removed, 30.0);
    const FloatImage truth = scene.RenderFloat();
    for (const double(&range)[2] : ranges)
    {
      camera->SetClippingRange(range[0], range[1]);
      const FloatImage picture = scene.RenderFloat();
      double worst = 0.0;
      double most = 0.0;
      for (int i = 0; i < Size * Size; ++i)
      {
        const double opacity = picture.GetPixel(i % Size, i / Size)[3];
        worst = std::max(worst, std::fabs(opacity - truth.GetPixel(i % Size, i / Size)[3]));
        most = std::max(most, opacity);
      }
      EXPECT_GT(most, 0.5);
      EXPECT_LT(worst, 30.0 * (inside ? std::max(removed, range[0]) : removed))
        << range[0] << " to " << range[1];
    }
  }
}

TEST(TetrahedraRayCastScenes, OpaqueGeometryInFrontInsideAndBehind)
{
  const Block block;
  for (const auto& [parallel, offset] :
    Product(List(false, true), List(-1.75, -0.6, 0.1, 0.7, 1.75)))
  {
    RayCastScene scene(block.Mesh, block.Property, Size, Size);
    LookAt(scene.GetRenderer(), block.Mesh->GetBounds(), 30.0, 20.0, 1.0, parallel);
    const double depth = scene.GetRenderer()->GetActiveCamera()->GetDistance() + offset;
    ExpectMatchesWithRectangle(scene, depth,
      "rectangle at " + std::to_string(offset) + (parallel ? ", parallel" : ", perspective"));
  }
}

TEST(TetrahedraRayCastScenes, ViewportInPartOfTheWindow)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.Property, 300, 240);
  scene.GetRenderer()->SetViewport(0.35, 0.2, 0.9, 0.85);
  LookAt(scene.GetRenderer(), block.Mesh->GetBounds(), 30.0, 20.0);
  const ByteImage window = scene.RenderBytes();
  ExpectViewportMatches(scene, scene.GetRenderer(), window, "offset viewport");
  const PixelRays rays(scene.GetRenderer());
  for (const auto& [y, x] : Product(window.Height, window.Width))
  {
    const bool inside = x >= rays.GetLeft() && x < rays.GetLeft() + rays.GetWidth() &&
      y >= rays.GetBottom() && y < rays.GetBottom() + rays.GetHeight();
    ASSERT_TRUE(inside ||
      (window.GetPixel(x, y)[0] | window.GetPixel(x, y)[1] | window.GetPixel(x, y)[2]) == 0)
      << "drawn outside the viewport at " << x << ", " << y;
  }
}

TEST(TetrahedraRayCastScenes, SeveralRenderersShareAMapper)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.Property, 320, 200);
  scene.GetRenderer()->SetViewport(0.0, 0.0, 0.45, 1.0);
  LookAt(scene.GetRenderer(), block.Mesh->GetBounds(), 30.0, 20.0);
  vtkNew<vtkRenderer> second;
  second->SetViewport(0.5, 0.1, 1.0, 0.7);
  second->SetBackground(0.2, 0.4, 0.6);
  second->AddVolume(scene.GetVolume());
  scene.GetWindow()->AddRenderer(second);
  LookAt(second, block.Mesh->GetBounds(), 110.0, -35.0, 1.3, true);
  const ByteImage window = scene.RenderBytes();
  ExpectViewportMatches(scene, scene.GetRenderer(), window, "first renderer");
  ExpectViewportMatches(scene, second, window, "second renderer");
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST(TetrahedraRayCastScenes, ResizedWindow)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.Property, Size, Size);
  const int sizes[4][2] = { { 160, 160 }, { 160, 230 }, { 240, 100 }, { 33, 57 } };
  for (const auto& size : sizes)
  {
    scene.GetWindow()->SetSize(size[0], size[1]);
    ExpectMatchesReference(
      scene, "resized to " + std::to_string(size[0]) + " x " + std::to_string(size[1]));
  }
  EXPECT_EQ(scene.GetRayCaster()->GetNumberOfMeshBuilds(), 1);
}

TEST(TetrahedraRayCastScenes, MultisampledWindow)
{
  const Block block;
  RayCastScene scene(block.Mesh, block.Property, Size, Size, 4);
  ExpectMatchesReference(scene, "four samples");
}

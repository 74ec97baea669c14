// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Several rays per pixel (ImageSampleDistance below 1), compared with the mean of the pixels of a
// larger window with one ray per pixel.
#include "MembraneScene.h"
#include "RayCastScene.h"

using namespace meniscus::test;
using Mapper = vtkTetrahedraRayCastMapper;

namespace
{

constexpr int Size = 60;
constexpr double Level = 1.0 / 255.0;

/** Picture of a mesh whose silhouette is not parallel to the pixels. */
enum class Look
{
  Silhouette,
  Isosurfaces,
  Clipped,
  Peaks,
  Shadows,
  PreIntegrated,
  Membrane
};

/** A scene of the given look in a square window, with one ray per pixel. */
class EdgeScene
{
public:
  explicit EdgeScene(Look look, int backend = BackendUnderTest(), int size = Size)
    : Mesh(MakeBlock(5, WavyField(3.0)))
    , Scene(this->Mesh, MakeLook(look), size, size)
  {
    Mapper* mapper = this->GetMapper();
    mapper->SetBackend(backend);
    mapper->AutoAdjustSampleDistancesOff();
    if (look == Look::Isosurfaces)
    {
      mapper->SetBlendMode(5);
    }
    if (look == Look::Clipped)
    {
      AddClippingPlane(mapper, { { 1.0, 0.3, -0.5 }, {} });
    }
    if (look == Look::Shadows)
    {
      mapper->SetGlobalIlluminationReach(1.0f);
      AddParallelLight(this->Scene.GetRenderer(), 3.0, 2.0, 4.0);
    }
    if (look == Look::PreIntegrated)
    {
      mapper->SetIntegration(Mapper::PRE_INTEGRATED);
    }
    if (look == Look::Membrane)
    {
      mapper->SetMembraneData(MakePlaneCase(0.1, 4.0, 2).Mesh);
    }
    LookAt(this->Scene.GetRenderer(), this->Mesh->GetBounds(), 33.0, 21.0);
  }

  Mapper* GetMapper() const { return this->Scene.GetRayCaster(); }

  /** Image with rays at most `distance` pixels apart where pixels are at edges. */
  FloatImage Draw(double distance)
  {
    this->GetMapper()->SetImageSampleDistance(static_cast<float>(distance));
    return this->Scene.RenderFloat();
  }

  Grid Mesh;
  RayCastScene Scene;

private:
  static vtkSmartPointer<vtkVolumeProperty> MakeLook(Look look)
  {
    const double range[2] = { -1.0, 1.0 };
    const bool isPeaked = look == Look::Peaks;
    auto property =
      MakeProperty(isPeaked ? FunctionKind::Peaked : FunctionKind::Smooth, range, 0.7);
    if (look == Look::Isosurfaces)
    {
      property->GetIsoSurfaceValues()->SetValue(0, 0.1);
      property->GetIsoSurfaceValues()->SetValue(1, 0.6);
    }
    property->SetShade(look == Look::Isosurfaces || look == Look::Shadows);
    return property;
  }
};

/** Mean of the pixels of a window that is `across` times as large. */
FloatImage DrawReference(Look look, int across, int size = Size)
{
  EdgeScene large(look, BackendUnderTest(), across * size);
  const FloatImage rays = large.Draw(1.0);
  FloatImage mean{ size, size, std::vector<float>(std::size_t{ 4 } * size * size, 0.0f) };
  for (const auto& [y, x, i] : Product(across * size, across * size, 4))
  {
    mean.Rgba[static_cast<std::size_t>(4 * (y / across * size + x / across) + i)] +=
      rays.GetPixel(x, y)[i] / static_cast<float>(across * across);
  }
  return mean;
}

struct Difference
{
  double Rms = 0.0;
  double Largest = 0.0;
  /** Quadratic mean over the pixels that another image has wrong by more than 4 levels. */
  double RmsOfEdges = 0.0;
  int Edges = 0;
};

Difference Compare(const FloatImage& image, const FloatImage& truth, const FloatImage& oneRay)
{
  Difference difference;
  const std::size_t pixels = truth.Rgba.size() / 4;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    double square = 0.0;
    double largest = 0.0;
    double before = 0.0;
    for (std::size_t i = 4 * pixel; i < 4 * pixel + 4; ++i)
    {
      const double error = std::fabs(image.Rgba[i] - truth.Rgba[i]);
      square += 0.25 * error * error;
      largest = std::max(largest, error);
      before = std::max(before, double{ std::fabs(oneRay.Rgba[i] - truth.Rgba[i]) });
    }
    difference.Rms += square / static_cast<double>(pixels);
    difference.Largest = std::max(difference.Largest, largest);
    if (before > 4.0 * Level)
    {
      difference.RmsOfEdges += square;
      ++difference.Edges;
    }
  }
  difference.Rms = std::sqrt(difference.Rms);
  difference.RmsOfEdges = std::sqrt(difference.RmsOfEdges / std::max(difference.Edges, 1));
  return difference;
}

class TetrahedraRayCastEdges : public ::testing::TestWithParam<Look>
{
};

} // anonymous namespace

TEST_P(TetrahedraRayCastEdges, AreThoseOfSixteenRays)
{
  EdgeScene scene(GetParam());
  const FloatImage oneRay = scene.Draw(1.0);
  const FloatImage truth = DrawReference(GetParam(), 4);
  const FloatImage image = scene.Draw(0.25);
  EXPECT_EQ(scene.GetMapper()->GetStatistic("UsedImageSampleDistance"), 0.25);
  const Difference before = Compare(oneRay, truth, oneRay);
  const Difference after = Compare(image, truth, oneRay);
  ASSERT_GT(before.Edges, 100);
  EXPECT_LT(after.Rms, 2.0 * Level) << before.Rms / Level;
  EXPECT_LT(after.RmsOfEdges, 0.3 * before.RmsOfEdges);
  // Every ray is drawn, unless pixels without edges have one.
  const bool isAdaptive =
    scene.GetMapper()->GetActiveBackend() == Mapper::NATIVE && GetParam() != Look::Membrane;
  if (isAdaptive)
  {
    EXPECT_GT(scene.GetMapper()->GetStatistic("NumberOfRefinedPixels"), before.Edges / 2);
    EXPECT_LT(scene.GetMapper()->GetStatistic("NumberOfRefinedPixels"), Size * Size);
  }
  else
  {
    EXPECT_LT(after.Rms, 0.25 * Level);
  }
}

INSTANTIATE_TEST_SUITE_P(Looks, TetrahedraRayCastEdges,
  ::testing::Values(Look::Silhouette, Look::Isosurfaces, Look::Clipped, Look::Peaks, Look::Shadows,
    Look::PreIntegrated, Look::Membrane));

// Pictures that consist of edges take a bounded number of steps, with the error of others.
TEST(TetrahedraRayCastAntiAliasing, CostOfManyEdgesIsBounded)
{
  constexpr int size = 480;
  for (const Look look : { Look::Peaks, Look::Isosurfaces, Look::Shadows })
  {
    EdgeScene scene(look, BackendUnderTest(), size);
    const FloatImage oneRay = scene.Draw(1.0);
    if (scene.GetMapper()->GetActiveBackend() != Mapper::NATIVE)
    {
      return; // shaders draw all rays
    }
    const auto steps = static_cast<double>(scene.GetMapper()->GetNumberOfTraversalSteps());
    const FloatImage image = scene.Draw(0.25);
    EXPECT_LT(static_cast<double>(scene.GetMapper()->GetNumberOfTraversalSteps()), 2.5 * steps)
      << int(look);
    EXPECT_LT(Compare(image, DrawReference(look, 4, size), oneRay).Rms, 2.0 * Level) << int(look);
  }
}

TEST(TetrahedraRayCastAntiAliasing, OtherDistances)
{
  for (const int across : { 2, 3, 10 })
  {
    EdgeScene scene(Look::Silhouette);
    const FloatImage oneRay = scene.Draw(1.0);
    const FloatImage truth = DrawReference(Look::Silhouette, across);
    const FloatImage image = scene.Draw(1.0 / across);
    EXPECT_FLOAT_EQ(static_cast<float>(scene.GetMapper()->GetStatistic("UsedImageSampleDistance")),
      1.0f / static_cast<float>(across));
    const Difference after = Compare(image, truth, oneRay);
    EXPECT_LT(after.Rms, 1.0 * Level) << across;
    EXPECT_LT(after.RmsOfEdges, 0.3 * Compare(oneRay, truth, oneRay).RmsOfEdges) << across;
  }
}

TEST(TetrahedraRayCastAntiAliasing, DistancesAreLimited)
{
  vtkNew<Mapper> mapper;
  EXPECT_EQ(mapper->GetImageSampleDistance(), 1.0f);
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<float, float>> cases = { { 0.1f, 0.1f }, { 0.0f, 0.1f },
    { -3.0f, 0.1f }, { -infinite, 0.1f }, { 0.5f, 0.5f }, { 1000.0f, 100.0f }, { infinite, 100.0f },
    { std::numeric_limits<float>::quiet_NaN(), 1.0f } };
  for (const auto& test : cases)
  {
    mapper->SetImageSampleDistance(test.first);
    EXPECT_EQ(mapper->GetImageSampleDistance(), test.second) << test.first;
  }
}

TEST(TetrahedraRayCastAntiAliasing, SmallWindows)
{
  for (const int size : { 1, 2 })
  {
    EdgeScene scene(Look::Silhouette, BackendUnderTest(), size);
    const FloatImage oneRay = scene.Draw(1.0);
    const Difference after =
      Compare(scene.Draw(0.25), DrawReference(Look::Silhouette, 4, size), oneRay);
    EXPECT_LT(after.Largest, 8.0 * Level) << size;
  }
}

TEST(TetrahedraRayCastAntiAliasing, ColoursArePremultiplied)
{
  EdgeScene scene(Look::Silhouette);
  const FloatImage image = scene.Draw(0.25);
  for (std::size_t i = 0; i < image.Rgba.size(); i += 4)
  {
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      ASSERT_GE(image.Rgba[i + channel], 0.0f);
      ASSERT_LE(image.Rgba[i + channel], image.Rgba[i + 3] + 1.0e-6f);
    }
  }
}

TEST(TetrahedraRayCastAntiAliasing, UnmovedFramesAreNotCastAgain)
{
  for (const Look look : { Look::Silhouette, Look::Membrane })
  {
    EdgeScene scene(look);
    const FloatImage oneRay = scene.Draw(1.0);
    scene.Draw(0.25);
    const FloatImage image = scene.Draw(0.25);
    const double casts = scene.GetMapper()->GetStatistic("NumberOfCastImages");
    EXPECT_EQ(scene.Draw(0.25).Rgba, image.Rgba);
    EXPECT_EQ(scene.GetMapper()->GetStatistic("NumberOfCastImages"), casts);
    EXPECT_EQ(scene.Draw(1.0).Rgba, oneRay.Rgba);
    EXPECT_EQ(scene.Draw(0.25).Rgba, image.Rgba);
  }
}

TEST(TetrahedraRayCastAntiAliasing, StillImagesOnly)
{
  EdgeScene scene(Look::Silhouette);
  Mapper* mapper = scene.GetMapper();
  mapper->AutoAdjustSampleDistancesOn();
  const FloatImage oneRay = scene.Draw(1.0);
  const auto used = [mapper] { return mapper->GetStatistic("UsedImageSampleDistance"); };
  const FloatImage still = scene.Draw(0.25);
  EXPECT_EQ(used(), 0.25);
  // Interaction; the frame takes less than an hour.
  vtkRenderWindow* window = scene.Scene.GetWindow();
  window->SetDesiredUpdateRate(15.0);
  scene.Draw(0.25);
  EXPECT_GE(used(), 1.0);
  window->SetDesiredUpdateRate(1.0e6);
  scene.Draw(0.25);
  EXPECT_EQ(used(), mapper->GetMaximumImageSampleDistance());
  window->SetDesiredUpdateRate(0.0001);
  EXPECT_EQ(scene.Draw(0.25).Rgba, still.Rgba);
  // Distances above 1 are ignored.
  EXPECT_EQ(scene.Draw(3.0).Rgba, oneRay.Rgba);
}

TEST(TetrahedraRayCastAntiAliasing, ThreadsDoNotMatter)
{
  std::vector<FloatImage> images;
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::Initialize(threads);
    EdgeScene scene(Look::Isosurfaces);
    images.push_back(scene.Draw(0.25));
  }
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(images[0].Rgba, images[1].Rgba);
}

/** Pixels keep their depth, and a moved ball changes the same pixels as in a new image. */
TEST(TetrahedraRayCastAntiAliasing, OpaqueObjectsInside)
{
  EdgeScene scene(Look::Silhouette);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.5);
  sphere->SetCenter(0.3, 0.4, 0.9);
  const auto ball = MakeActor(sphere->GetOutputPort());
  scene.Scene.GetRenderer()->AddActor(ball);
  scene.Draw(0.25);
  scene.Draw(0.25);
  ball->SetPosition(0.1, -0.1, 0.0);
  const FloatImage moved = scene.Draw(0.25);
  const vtkTypeInt64 steps = scene.GetMapper()->GetNumberOfTraversalSteps();
  scene.GetMapper()->ReleaseGraphicsResources(scene.Scene.GetWindow());
  EXPECT_EQ(scene.Draw(0.25).Rgba, moved.Rgba);
  EXPECT_EQ(scene.GetMapper()->GetNumberOfTraversalSteps(), steps);
}

TEST(TetrahedraRayCastAntiAliasing, DepthsAreThoseOfOneRay)
{
  EdgeScene scene(Look::Silhouette);
  scene.GetMapper()->SetDepthWriting(Mapper::OPACITY_DEPTH);
  std::vector<std::vector<float>> depths;
  for (const float distance : { 1.0f, 0.25f })
  {
    scene.GetMapper()->SetImageSampleDistance(distance);
    scene.Scene.GetWindow()->Render();
    std::vector<float>& read = depths.emplace_back(std::size_t{ Size } * Size);
    scene.Scene.GetWindow()->GetZbufferData(0, 0, Size - 1, Size - 1, read.data());
  }
  EXPECT_EQ(depths[0], depths[1]);
}

/**
 * A plate in front of fog, inside of it and behind it. All samples of a pixel have the colour of
 * the plate or the colour next to it, so that its mean lies between them.
 */
TEST(TetrahedraRayCastAntiAliasing, OutlinesInAMultisampledWindow)
{
  for (const double depth : { 1.5, 0.3, -1.5 })
  {
    SCOPED_TRACE(depth);
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(0.0, 1.2);
    opacity->AddPoint(2.0, 1.2);
    vtkNew<vtkColorTransferFunction> colors;
    colors->AddRGBPoint(0.0, 0.1, 0.2, 0.9);
    colors->AddRGBPoint(2.0, 0.1, 0.2, 0.9);
    vtkNew<vtkVolumeProperty> fog;
    fog->SetScalarOpacity(opacity);
    fog->SetColor(colors);
    RayCastScene scene(MakeBlock(2, ConstantField(1.0)), fog, Size, Size, 4);
    vtkNew<vtkPlaneSource> plate;
    plate->SetOrigin(-0.5, -0.5, 0.0);
    plate->SetPoint1(0.5, -0.5, 0.0);
    plate->SetPoint2(-0.5, 0.5, 0.0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plate->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->RotateZ(20.0);
    actor->SetPosition(0.0, 0.0, depth);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(1.0, 0.7, 0.0);
    vtkRenderer* renderer = scene.GetRenderer();
    renderer->AddActor(actor);
    renderer->SetBackground(1.0, 1.0, 1.0);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.9);
    camera->SetPosition(0.0, 0.0, 5.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetClippingRange(2.0, 8.0);
    const ByteImage image = scene.RenderBytes();
    const auto at = [&image](int x, int y)
    {
      const auto pixel = image.GetPixel(x, y);
      return glm::dvec3(pixel[0], pixel[1], pixel[2]);
    };
    const glm::dvec3 around = at(2, 2);
    const glm::dvec3 step = at(Size / 2, Size / 2) - around;
    int between = 0;
    for (const auto& [y, x] : Product(Numbers<int>(0, Size), Numbers<int>(0, Size)))
    {
      const glm::dvec3 color = at(x, y) - around;
      const double share = glm::dot(color, step) / glm::dot(step, step);
      between += share > 0.1 && share < 0.9 ? 1 : 0;
      // Each sample is rounded to a level, and so is their mean.
      EXPECT_LE(glm::length(color - share * step), 3.0) << x << ", " << y;
    }
    // Nearly all of the pixels along the outline, which is 4 / 1.8 of the picture's width.
    EXPECT_GT(between, Size);
  }
}

/**
 * Depths that a rasteriser on the processor reads anyway, to see whether samples differ, tell that
 * the next frame is the same. Without several samples, they are not read for a first frame.
 */
TEST(TetrahedraRayCastAntiAliasing, DepthsOfAMultisampledWindowAreRead)
{
  for (const int samples : { 0, 4 })
  {
    RayCastScene scene(MakeBlock(2, ConstantField(1.0)), MakeConstantProperty(1.0, 1, 1, 1, 1.0),
      Size, Size, samples);
    scene.GetRayCaster()->SetBackend(Mapper::OPENGL);
    const auto castImages = [&scene]
    {
      scene.GetWindow()->Render();
      return scene.GetRayCaster()->GetStatistic("NumberOfCastImages");
    };
    const double first = castImages();
    const std::string device = scene.GetWindow()->ReportCapabilities();
    const bool reads = samples > 0 && device.find("llvmpipe") != std::string::npos;
    EXPECT_EQ(castImages(), first + (reads ? 0 : 1)) << samples;
  }
}

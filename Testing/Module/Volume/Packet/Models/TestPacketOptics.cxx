// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Optics of packets besides a plain medium: lighting, gradient opacity, components, tables of
// segments.
#include "KernelMeshes.h"
#include "KernelPicture.h"

#include "Simd/InstructionSets.h"
#include "Simd/SimdPortable.h"
#include "Volume/Mesh/ScalarGradients.h"
#include "Volume/Optics/PreIntegration.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketOptics.h"
#include "Volume/Packet/Models/PacketExponential.h"
#include "Volume/Packet/Models/PacketLights.h"
#include "Volume/Packet/Models/PacketSegmentTable.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Size in pixels of an image that the unit cube fills: each ray has a length of 1. */
constexpr int Size = 32;
/** Rounding of some 20 segments, and of gradients in cells with an edge of 1/4. */
constexpr double Tolerance = 3e-6;

/** The cube; scalars are dot(slope, position), normalised by the radius only. */
class OpticsScene
{
public:
  PictureScene Picture;
  SurfaceLighting Lighting;
  std::vector<glm::vec3> Gradients;
  std::vector<glm::vec3> Components;
  PreIntegrationTable Table;

  explicit OpticsScene(const glm::dvec3& slope, double jitter = 0.0)
    : Arrays(KuhnGrid(4))
  {
    if (jitter > 0.0)
    {
      Jitter(this->Arrays, jitter, 7);
    }
    this->Picture.Mesh.Build(this->Arrays.View());
    this->Picture.Frame = FrameAlongZ(this->Picture.Mesh, 0.5, Size);
    this->Picture.Intervals = ConstantFunction(1.0);
    this->Picture.Scalars = this->Evaluate([&](const glm::dvec3& p) { return glm::dot(slope, p); });
    const RayFrame& frame = this->Picture.Frame;
    TileCaster::Scene& optics = this->Picture.Optics;
    optics.GradientToFrame = glm::inverse(glm::dmat3(frame.RowX, frame.RowY, frame.RowDepth));
    // Scalars are those of world coordinates over the radius.
    optics.GradientMagnitude = this->Picture.Mesh.GetRadius() / glm::length(frame.ViewToWorld[0]);
  }

  /** Values of a function of the position relative to the mesh's centre, over the radius. */
  template <typename Function>
  std::vector<float> Evaluate(const Function& function) const
  {
    std::vector<float> values;
    for (const std::int64_t point : this->Picture.Mesh.GetSourcePoints())
    {
      const glm::dvec3 place = this->Arrays.PointAt(point) - this->Picture.Mesh.GetCenter();
      values.push_back(static_cast<float>(function(place) / this->Picture.Mesh.GetRadius()));
    }
    return values;
  }

  /** Adds a light at the viewer, for a material with all terms. */
  void AddHeadlight()
  {
    this->Lighting.Ambient = 0.1;
    this->Lighting.Diffuse = 0.6;
    this->Lighting.Specular = 0.3;
    this->Lighting.SpecularPower = 5.0;
    RayCastLight light;
    light.Position = glm::dvec4(0.0, 0.0, -1.0, 0.0);
    light.Diffuse = { 1.0, 0.5, 0.25 };
    light.Specular = { 0.25, 0.5, 1.0 };
    this->Lighting.Lights.push_back(light);
    this->Picture.Optics.Lighting = &this->Lighting;
  }
  void UseVertexGradients()
  {
    this->Gradients = ComputeVertexGradients(
      this->Picture.Mesh, { this->Picture.Scalars.begin(), this->Picture.Scalars.end() }, 1.0);
    this->Picture.Optics.VertexGradients = this->Gradients.data();
  }
  void SetComponents(ComponentMixture mixture, const std::vector<std::vector<float>>& others)
  {
    this->Components.assign(this->Picture.Scalars.size(), glm::vec3(0.0f));
    for (const auto& [c, v] :
      Product(Below<std::size_t>(others.size()), Below<std::size_t>(this->Components.size())))
    {
      this->Components[v][static_cast<int>(c)] = others[c][v];
    }
    this->Picture.Optics.Mixture = mixture;
    this->Picture.Optics.Components = this->Components.data();
  }

private:
  MeshArrays Arrays;
};

/** Expects a ray of that colour in every pixel. */
void ExpectColor(const Picture& picture, const glm::dvec4& expected)
{
  EXPECT_EQ(picture.Statistics.Lost, 0);
  double largest = 0.0;
  for (std::size_t i = 0; i < picture.Rgba.size(); ++i)
  {
    largest = std::max(largest, std::abs(picture.Rgba[i] - expected[static_cast<int>(i % 4)]));
  }
  EXPECT_LT(largest, Tolerance);
}

std::vector<TransferFunctionInterval> Function(
  double attenuation, const glm::dvec3& from, const glm::dvec3& to)
{
  return BuildIntervals(
    { { -1.0, attenuation, from }, { 1.0, attenuation, to } }, ScalarNormalization());
}

std::vector<TransferFunctionInterval> Bumps(double shift)
{
  return BuildIntervals(
    { { -0.6 + shift, 0.0, { 1.0, 0.2, 0.0 } }, { -0.3 + shift, 3.0, { 0.1, 0.9, 0.3 } },
      { 0.1 + shift, 0.5, { 0.2, 0.1, 1.0 } }, { 0.5 + shift, 9.0, { 1.0, 1.0, 0.2 } } },
    ScalarNormalization());
}

class PacketOpticsTest : public ::testing::TestWithParam<InstructionSet>
{
};

INSTANTIATE_TEST_SUITE_P(
  Sets, PacketOpticsTest, ::testing::ValuesIn(GetInstructionSets()), TestNameOf);

}

TEST_P(PacketOpticsTest, LightOnALinearField)
{
  // The viewer looks along -z, and the gradient is at 60 degrees: cosine 1/2; the reflected light
  // leaves at 120 degrees, behind the surface. Then at 30 degrees, where it is visible.
  for (const double degrees : { 60.0, 30.0 })
  {
    const double angle = degrees * std::acos(-1.0) / 180.0;
    const double facing = std::cos(angle);
    const double glance = std::max(0.0, std::cos(2.0 * angle));
    const double alpha = 1.0 - std::exp(-1.0);
    glm::dvec4 expected(0.0, 0.0, 0.0, alpha);
    for (int c = 0; c < 3; ++c)
    {
      const double reflected = 0.1 + 0.6 * facing * std::pow(0.5, c);
      expected[c] = alpha * (reflected + 0.3 * std::pow(glance, 5.0) * std::pow(0.5, 2 - c));
    }
    for (const bool vertices : { false, true })
    {
      SCOPED_TRACE(degrees);
      OpticsScene scene({ 0.6 * std::sin(angle), 0.0, 0.6 * std::cos(angle) }, 0.03);
      // A constant medium up to the cube's sides, which are jittered: only its inner part is
      // viewed.
      scene.Picture.Frame = FrameAlongZ(scene.Picture.Mesh, 0.4, Size);
      scene.AddHeadlight();
      if (vertices)
      {
        scene.UseVertexGradients();
      }
      // The emission is white: divide by the opacity, which the sides change.
      const Picture picture = CastPicture(scene.Picture, Size, GetParam());
      double largest = 0.0;
      for (std::size_t i = 0; i < picture.Rgba.size(); i += 4)
      {
        const double opacity = picture.Rgba[i + 3];
        ASSERT_GT(opacity, 0.5);
        for (int c = 0; c < 3; ++c)
        {
          largest =
            std::max(largest, std::abs(picture.Rgba[i + c] / opacity - expected[c] / alpha));
        }
      }
      // Gradients of jittered cells, down to a height of 1/8, of scalars rounded to 2^-24.
      EXPECT_LT(largest, 1e-5);
    }
  }
}

TEST_P(PacketOpticsTest, GradientOpacityIsAFunctionOfTheSlope)
{
  for (const auto& [slope, vertices] : Product(List(0.25, 0.5, 0.75), List(false, true)))
  {
    OpticsScene scene({ 0.0, 0.6 * slope, 0.8 * slope });
    if (vertices)
    {
      scene.UseVertexGradients();
    }
    scene.Picture.GradientIntervals = BuildIntervals(
      { { 0.25, 0.5, glm::dvec3(0.0) }, { 0.75, 2.5, glm::dvec3(0.0) } }, ScalarNormalization());
    const double alpha = 1.0 - std::exp(-(0.5 + 4.0 * (slope - 0.25)));
    ExpectColor(CastPicture(scene.Picture, Size, GetParam()), glm::dvec4(alpha));
  }
}

TEST_P(PacketOpticsTest, FieldWithoutSlopeHasAmbientLight)
{
  OpticsScene scene(glm::dvec3(0.0));
  scene.AddHeadlight();
  const double alpha = 1.0 - std::exp(-1.0);
  const glm::dvec4 expected(0.1 * alpha, 0.1 * alpha, 0.1 * alpha, alpha);
  ExpectColor(CastPicture(scene.Picture, Size, GetParam()), expected);
  scene.UseVertexGradients();
  ExpectColor(CastPicture(scene.Picture, Size, GetParam()), expected);
}

TEST_P(PacketOpticsTest, PowersOfCosinesAreAtMostOne)
{
  // The gradient points to the light, which is at the viewer: cosines are 1 up to rounding, and a
  // cone's axis may be longer than 1.
  OpticsScene scene({ 0.36, 0.48, 0.6 });
  scene.Picture.Frame = FrameAlongZ(scene.Picture.Mesh, 0.4, Size);
  scene.AddHeadlight();
  scene.Lighting.SpecularPower = 1.0e9;
  RayCastLight& light = scene.Lighting.Lights.front();
  light.Position = glm::dvec4(1.0e3 * glm::dvec3(0.36, 0.48, -0.6), 0.0);
  light.Cone = glm::dvec4(-1.0e9 * glm::dvec3(0.36, 0.48, -0.6), 0.5);
  light.Falloff = glm::dvec4(1.0, 0.0, 0.0, 8.0);
  for (const float channel : CastPicture(scene.Picture, Size, GetParam()).Rgba)
  {
    EXPECT_GE(channel, 0.0f);
    EXPECT_LE(channel, 1.0f);
  }
}

TEST_P(PacketOpticsTest, LightsWithoutFalloffAreFinite)
{
  OpticsScene scene({ 0.0, 0.0, 0.6 });
  scene.AddHeadlight();
  scene.Lighting.Lights.front().Position = glm::dvec4(0.0, 0.0, -100.0, 1.0);
  scene.Lighting.Lights.front().Falloff = glm::dvec4(0.0);
  const Picture picture = CastPicture(scene.Picture, Size, GetParam());
  for (const float channel : picture.Rgba)
  {
    EXPECT_TRUE(std::isfinite(channel));
  }
  EXPECT_GT(picture.Rgba.front(), 1.0e18f);
}

TEST_P(PacketOpticsTest, IndependentComponentsAddUp)
{
  // Attenuations and emissions of constant media.
  const glm::dvec3 colors[4] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.5 }, { 0.5, 0.5, 0.5 },
    { 0.0, 0.25, 1.0 } };
  const double attenuations[4] = { 0.5, 0.75, 2.0, 4.0 };
  for (const int number : { 2, 3, 4 })
  {
    OpticsScene scene({ 0.3, 0.2, 0.1 });
    const auto other = scene.Evaluate([](const glm::dvec3& p) { return 0.5 * p.z - 0.2 * p.x; });
    scene.SetComponents(
      ComponentMixture::Independent, { static_cast<std::size_t>(number - 1), other });
    scene.Picture.Intervals = Function(attenuations[0], colors[0], colors[0]);
    double sum = attenuations[0];
    glm::dvec3 emission = attenuations[0] * colors[0];
    for (int c = 1; c < number; ++c)
    {
      scene.Picture.OtherIntervals.push_back(Function(attenuations[c], colors[c], colors[c]));
      sum += attenuations[c];
      emission += attenuations[c] * colors[c];
    }
    const double alpha = 1.0 - std::exp(-sum);
    SCOPED_TRACE(number);
    ExpectColor(
      CastPicture(scene.Picture, Size, GetParam()), glm::dvec4(alpha / sum * emission, alpha));
  }
}

TEST_P(PacketOpticsTest, ColorComesFromAnotherScalar)
{
  // Colour linear in depth from c0 = 0 to c1 = 1 over a constant attenuation k = 2 of length 1: the
  // integral of k x exp(-k x) is (1 - exp(-k)) / k - exp(-k). The viewer looks along -z.
  const double alpha = 1.0 - std::exp(-2.0);
  const double red = alpha / 2.0 - std::exp(-2.0);
  OpticsScene scene({ 0.3, 0.2, 0.1 });
  scene.Picture.Intervals = Function(2.0, glm::dvec3(0.0), glm::dvec3(0.0));
  const double radius = scene.Picture.Mesh.GetRadius();
  const auto depth = scene.Evaluate([](const glm::dvec3& p) { return -p.z; });
  scene.SetComponents(ComponentMixture::ColorAndOpacity, { depth });
  scene.Picture.OtherIntervals = { BuildIntervals(
    { { -0.5 / radius, 7.0, { 0.0, 1.0, 0.25 } }, { 0.5 / radius, 9.0, { 1.0, 0.0, 0.25 } } },
    ScalarNormalization()) };
  const glm::dvec4 expected(red, alpha - red, 0.25 * alpha, alpha);
  ExpectColor(CastPicture(scene.Picture, Size, GetParam()), expected);

  // The same colours at the vertices.
  std::vector<float> reds;
  std::vector<float> greens;
  for (const float place : depth)
  {
    reds.push_back(0.5f + place * static_cast<float>(radius));
    greens.push_back(1.0f - reds.back());
  }
  scene.SetComponents(ComponentMixture::RedGreenBlueOpacity,
    { reds, greens, std::vector<float>(depth.size(), 0.25f) });
  scene.Picture.OtherIntervals.clear();
  ExpectColor(CastPicture(scene.Picture, Size, GetParam()), expected);
}

TEST_P(PacketOpticsTest, InstructionSetsShowTheSame)
{
  for (const auto& [lit, vertices, mixture] : Product(List(false, true), List(false, true),
         std::vector<ComponentMixture>{ ComponentMixture::None, ComponentMixture::ColorAndOpacity,
           ComponentMixture::RedGreenBlueOpacity, ComponentMixture::Independent }))
  {
    OpticsScene scene({ 0.3, 0.5, 0.7 }, 0.05);
    scene.Picture.Intervals = Bumps(0.0);
    if (lit && mixture != ComponentMixture::Independent)
    {
      scene.AddHeadlight();
      scene.Lighting.SpecularPower = 3.5;
      scene.Lighting.Lights[0].Position = { 0.5, 0.2, -2.0, 1.0 };
      scene.Picture.GradientIntervals = Bumps(0.3);
    }
    if (vertices)
    {
      scene.UseVertexGradients();
    }
    if (mixture != ComponentMixture::None)
    {
      const auto across = scene.Evaluate([](const glm::dvec3& p) { return p.x * p.y - p.z; });
      const auto round = scene.Evaluate([](const glm::dvec3& p) { return glm::length(p); });
      scene.SetComponents(mixture, { round, across, across });
      scene.Picture.OtherIntervals = { Bumps(0.1), Bumps(-0.2), Bumps(0.4) };
    }
    const Picture plain = CastPicture(scene.Picture, Size, InstructionSet::Portable);
    const Picture wide = CastPicture(scene.Picture, Size, GetParam());
    EXPECT_EQ(plain.Statistics.Steps, wide.Statistics.Steps);
    EXPECT_GT(*std::max_element(plain.Rgba.begin(), plain.Rgba.end()), 0.2f);
    double largest = 0.0;
    for (std::size_t i = 0; i < plain.Rgba.size(); ++i)
    {
      const double difference = std::abs(plain.Rgba[i] - wide.Rgba[i]);
      largest = difference <= largest ? largest : difference;
    }
    // Fused and separate operations differ, most of all in gradients of jittered cells.
    EXPECT_LT(largest, 2e-5) << lit << vertices << static_cast<int>(mixture);
  }
}

TEST_P(PacketOpticsTest, SegmentsAreLookedUp)
{
  // A table is exact where neither colour nor attenuation change.
  OpticsScene scene({ 0.3, 0.2, 0.1 });
  const glm::dvec3 color(0.2, 0.4, 0.8);
  for (const double attenuation : { 0.01, 1.0, 9.0, 1000.0 })
  {
    scene.Table.Build(Function(attenuation, color, color), 1.0, 16, 8);
    scene.Picture.Optics.PreIntegration = &scene.Table;
    const double alpha = 1.0 - std::exp(-attenuation);
    ExpectColor(CastPicture(scene.Picture, Size, GetParam()), glm::dvec4(alpha * color, alpha));
  }
}

TEST(PacketSegmentTable, LinearBetweenTheSamples)
{
  PreIntegrationTable table;
  table.Build(Bumps(0.0), 2.0, 8, 6);
  ASSERT_EQ(table.GetNumberOfLengths(), 6);
  const PacketSegmentTable packed{ table.GetValues().data(), 8, 6,
    static_cast<float>(1.0 / table.GetShortest()), static_cast<float>(table.GetLengthsPerOctave()),
    0.0f, 1.0f };
  const auto scalarOf = [](double at) { return static_cast<float>(2.0 * at / 7.0 - 1.0); };
  const auto valueOf = [&table](int front, int back, int length, int i)
  { return table.GetValues()[4 * (8 * (8 * length + back) + front) + i]; };
  float mean[4];
  for (const int length : { 0, 1, 2, 5 })
  {
    const auto world = static_cast<float>(table.GetLength(length));
    LookUpSegment(packed, scalarOf(3), scalarOf(6), world, mean);
    EXPECT_NEAR(mean[1], valueOf(3, 6, length, 1), 1e-5);
    EXPECT_NEAR(mean[3], valueOf(3, 6, length, 3), 1e-5);
    LookUpSegment(packed, scalarOf(2.5), scalarOf(6), world, mean);
    EXPECT_NEAR(mean[2], 0.5 * (valueOf(2, 6, length, 2) + valueOf(3, 6, length, 2)), 1e-5);
    LookUpSegment(packed, scalarOf(2), scalarOf(6.25), world, mean);
    EXPECT_NEAR(mean[0], 0.75 * valueOf(2, 6, length, 0) + 0.25 * valueOf(2, 7, length, 0), 1e-5);
  }
  const double between = std::sqrt(table.GetLength(2) * table.GetLength(3));
  LookUpSegment(packed, scalarOf(1), scalarOf(5), static_cast<float>(between), mean);
  EXPECT_NEAR(mean[0], 0.5 * (valueOf(1, 5, 2, 0) + valueOf(1, 5, 3, 0)), 1e-5);
  // Outside the table its border values hold, and a NaN reads no memory outside.
  LookUpSegment(packed, -1.5f, 1.5f, 1e9f, mean);
  EXPECT_EQ(mean[0], valueOf(0, 7, 5, 0));
  LookUpSegment(packed, std::numeric_limits<float>::quiet_NaN(), 1.0f, 0.0f, mean);
  EXPECT_EQ(mean[0], valueOf(0, 7, 0, 0));
}

TEST(PacketFunctions, AbsorbedIsOneLessTheExponential)
{
  for (const double x : { 0.0, 1e-6, 0.01, 0.3, 0.999, 1.0, 1.001, 2.5, 7.0, 31.0, 50.0, 1e18 })
  {
    const auto lanes = AbsorbedAll<SimdPortable>(SimdPortable::Splat(static_cast<float>(x)));
    EXPECT_NEAR(lanes.V[1], -std::expm1(-x), 1e-6) << x;
    if (x <= 0.01)
    {
      EXPECT_NEAR(lanes.V[1], -std::expm1(-x), 2e-7 * x) << x;
    }
  }
}

TEST(PacketFunctions, Powers)
{
  for (const float exponent : { 0.0f, 1.0f, 2.0f, 7.0f, 128.0f, 0.5f, 7.25f, 3000.0f })
  {
    const PacketPower<SimdPortable> power(exponent);
    for (const float x : { 0.0f, 1e-3f, 0.5f, 0.97f, 1.0f })
    {
      const double expected = std::pow(double{ x }, double{ exponent });
      EXPECT_NEAR(power(SimdPortable::Splat(x)).V[2], expected, 1e-5 * expected + 1e-30)
        << x << "^" << exponent;
    }
  }
}

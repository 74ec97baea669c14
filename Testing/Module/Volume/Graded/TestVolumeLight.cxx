// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Light that a medium emits and absorbs along bent rays: closed forms, and a reference in double
// precision along known paths.
#include "GradedScene.h"

#include "ReferenceRayIntegrator.h"
#include "TestBasics.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Graded/OpaqueTriangles.h"
#include "Volume/Graded/VolumeLight.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Largest error of a channel of the ray caster's pictures. */
constexpr double PictureError = 2.0e-5;

/**
 * Largest error of the transmittance of smoke, however many segments a ray has. The lengths may be
 * off by 2^-24, the function in single precision by as much, and the model by half of that
 * (AbsorptionFit); the error of a depth t counts exp(-t), so that is 0.37 times 2.5 * 2^-24 at
 * most. Half a unit of the result in single precision is added.
 */
constexpr double SmokeError = 0x1p-23;

using Points = std::vector<TransferFunctionPoint>;
using Path = std::function<glm::dvec3(double)>;

const Points Smoke = { { 0.0, 0.7, glm::dvec3(0.2, 0.5, 0.9) } };

/** Ramps, a jump, and a thin peak that a ray passes in a hundredth of its way. */
const Points Layers = { { -0.8, 0.0, glm::dvec3(1.0, 0.2, 0.1) },
  { -0.4, 1.5, glm::dvec3(0.9, 0.6, 0.1) }, { -0.1, 0.2, glm::dvec3(0.1, 0.8, 0.3) },
  { -0.1, 2.5, glm::dvec3(0.3, 0.3, 1.0) }, { 0.2, 0.3, glm::dvec3(0.2, 0.1, 0.9) },
  { 0.21, 40.0, glm::dvec3(1.0, 1.0, 0.5) }, { 0.22, 0.3, glm::dvec3(0.4, 0.4, 0.4) },
  { 0.9, 3.0, glm::dvec3(0.0, 0.9, 0.9) } };

/** A medium in a graded scene, with a normalised scalar as a function of the place. */
class LitScene : public GradedScene
{
public:
  LitScene(const MeshArrays& arrays, const SquaredIndexField& index,
    const SquaredIndexField& scalar, const Points& points, bool ofCells = false)
    : GradedScene(arrays, index)
    , Intervals(PackIntervals(BuildIntervals(points, ScalarNormalization())))
  {
    for (const std::int32_t point : this->Mesh.GetSourcePoints())
    {
      this->Scalars.push_back(static_cast<float>(scalar(arrays.PointAt(point))));
    }
    if (ofCells)
    {
      this->Scalars.assign(this->Mesh.GetCells().size(), 0.0f);
    }
    this->Light.Mesh = &this->Mesh;
    this->Light.Scalars = &this->Scalars;
    this->Light.HasCellScalars = ofCells;
    this->Light.Intervals = &this->Intervals;
    this->Flags.assign(this->Mesh.GetCells().size(), HasLight);
    this->PrepareLanes();
  }

  GradedRay RayFrom(const glm::dvec3& origin, const glm::dvec3& direction) const
  {
    return { (origin - this->Mesh.GetCenter()) / this->Mesh.GetRadius(), direction };
  }
  std::vector<OpaqueSight> See(
    const std::vector<GradedRay>& rays, const OpaqueTriangles& triangles = OpaqueTriangles())
  {
    std::vector<OpaqueSight> sights(rays.size());
    SeeTriangles(GradedRayWalk(this->Medium), triangles, &this->Flags, rays, this->Statistics,
      sights.data(), nullptr, &this->Light);
    return sights;
  }

  /** Scalar of the cell in which a place is, looked for in a cell first. */
  double ScalarAt(const glm::dvec3& place, std::size_t& cell) const
  {
    const glm::dvec3 p = (place - this->Mesh.GetCenter()) / this->Mesh.GetRadius();
    const auto& cells = this->Mesh.GetCells();
    double best = -1.0;
    double scalar = 0.0;
    for (std::size_t i = 0; i <= cells.size() && best < -1.0e-12; ++i)
    {
      const std::size_t c = i == 0 ? cell : i - 1;
      const auto& v = cells[c].Vertices;
      const glm::dvec3 first = this->Mesh.GetPosition(v[0]);
      const glm::dvec3 rest =
        glm::inverse(glm::dmat3(this->Mesh.GetPosition(v[1]) - first,
          this->Mesh.GetPosition(v[2]) - first, this->Mesh.GetPosition(v[3]) - first)) *
        (p - first);
      const double w0 = 1.0 - rest.x - rest.y - rest.z;
      const double least = std::min(w0, std::min(rest.x, std::min(rest.y, rest.z)));
      if (least > best)
      {
        best = least;
        cell = c;
        scalar = w0 * this->Scalars[v[0]] + rest.x * this->Scalars[v[1]] +
          rest.y * this->Scalars[v[2]] + rest.z * this->Scalars[v[3]];
      }
    }
    return scalar;
  }

  EmittingMedium Light;
  std::vector<float> Scalars;
  std::vector<PacketInterval> Intervals;
  std::vector<std::uint8_t> Flags;
};

/** Integral of |p + f s| over s from 0 to a time: the length of the arc of a parabola. */
double LengthOfParabola(const glm::dvec3& p, const glm::dvec3& f, double time)
{
  const double force = glm::length(f);
  const double along = glm::dot(p, f) / force;
  const double across = std::sqrt(glm::dot(p, p) - along * along);
  const auto primitive = [across](double v)
  {
    return 0.5 *
      (v * std::sqrt(v * v + across * across) + across * across * std::asinh(v / across));
  };
  return (primitive(along + force * time) - primitive(along)) / force;
}

/** Light of a known path with a scalar, in double precision: straight pieces, times in [0, end]. */
std::array<double, 4> ReferenceLight(
  const Path& path, double end, const SquaredIndexField& scalar, const Points& points)
{
  constexpr int pieces = 40000;
  std::vector<reference::RaySegment> segments;
  double length = 0.0;
  for (int i = 0; i < pieces; ++i)
  {
    const glm::dvec3 from = path(end * i / pieces);
    const glm::dvec3 to = path(end * (i + 1) / pieces);
    const double next = length + glm::distance(from, to);
    segments.push_back({ length, next, scalar(from), scalar(to), 0 });
    length = next;
  }
  std::vector<reference::TransferFunctionNode> nodes;
  for (const TransferFunctionPoint& point : points)
  {
    nodes.push_back(
      { point.Scalar, { point.Attenuation, { point.Color.r, point.Color.g, point.Color.b } } });
  }
  const reference::Ray ray{ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  return reference::ReferenceRayIntegrator::Integrate(
    ray, segments, reference::ReferenceTransferFunction(nodes));
}

void ExpectLight(const KeptLight& light, const std::array<double, 4>& truth)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(light.Values[k], truth[k], PictureError) << k;
  }
  EXPECT_NEAR(1.0 - light.Values[3], truth[3], PictureError);
}

constexpr double Base = 1.6;
constexpr double Slope = 0.9;
const glm::dvec3 Force(0.5 * Slope, 0.0, 0.0);

double LinearIndex(const glm::dvec3& p)
{
  return Base + Slope * p.x;
}

double SlantedScalar(const glm::dvec3& p)
{
  return 0.35 * p.x - 0.2 * p.y + 0.6 * p.z;
}

/** A ray that enters the cube [-1, 1]^3 by its upper side, and the time at which it leaves. */
struct ParabolaRay
{
  glm::dvec3 Eye;
  glm::dvec3 Direction;
  glm::dvec3 Momentum;
  double Time;

  explicit ParabolaRay(RandomNumbers& random)
    : Eye(random.Uniform(-0.6, -0.2), random.Uniform(-0.4, 0.4), 1.0)
    , Direction(random.Uniform(-0.3, 0.0), random.Uniform(-0.2, 0.2), -1.0)
    , Momentum(std::sqrt(LinearIndex(Eye)) * glm::normalize(Direction))
    , Time(-2.0 / Momentum.z)
  {
  }
  glm::dvec3 At(double s) const { return this->Eye + s * this->Momentum + 0.5 * s * s * Force; }
};

/** Calls body(ray, sight) for random rays. */
void ForEachParabola(LitScene& scene, RandomNumbers& random, int count,
  const std::function<void(const ParabolaRay&, const OpaqueSight&)>& body,
  const OpaqueTriangles& wall = OpaqueTriangles())
{
  for (int i = 0; i < count; ++i)
  {
    const ParabolaRay ray(random);
    body(ray, scene.See({ scene.RayFrom(ray.Eye, ray.Direction) }, wall).front());
  }
}

/** Expects the light of layers along random parabolas. */
void ExpectLayers(
  LitScene& scene, RandomNumbers& random, int count, const SquaredIndexField& scalar)
{
  ForEachParabola(scene, random, count,
    [&scalar](const ParabolaRay& ray, const OpaqueSight& sight)
    {
      ExpectLight(sight.Light,
        ReferenceLight([&ray](double s) { return ray.At(s); }, ray.Time, scalar, Layers));
    });
}

/** Transmittance of smoke along the arc of a ray. */
double TransmittanceOfArc(const ParabolaRay& ray)
{
  return std::exp(-Smoke[0].Attenuation * LengthOfParabola(ray.Momentum, Force, ray.Time));
}

}

TEST(VolumeLight, SmokeIsAsDenseAsTheArcIsLong)
{
  RandomNumbers random(1);
  // Cells from the whole cube to a twelfth of it.
  for (const int n : { 1, 3, 12 })
  {
    LitScene scene(CenteredGrid(n, 1.0), LinearIndex, SlantedScalar, Smoke);
    ForEachParabola(scene, random, 50,
      [](const ParabolaRay& ray, const OpaqueSight& sight)
      {
        const double share = 1.0 - TransmittanceOfArc(ray);
        EXPECT_NEAR(1.0 - sight.Light.Values[3], share, SmokeError);
        for (int k = 0; k < 3; ++k)
        {
          EXPECT_NEAR(sight.Light.Values[k], share * Smoke[0].Color[k], SmokeError);
        }
        // The test can tell the arc from the straight way.
        const double chord = glm::distance(ray.At(ray.Time), ray.Eye);
        EXPECT_GT(std::abs(share + std::expm1(-Smoke[0].Attenuation * chord)), 1.0e-3);
      });
  }
}

TEST(VolumeLight, LayersAlongParabolas)
{
  RandomNumbers random(2);
  for (const int n : { 1, 4, 9 })
  {
    LitScene scene(CenteredGrid(n, 1.0), LinearIndex, SlantedScalar, Layers);
    ExpectLayers(scene, random, 20, SlantedScalar);
  }
}

// Random scalars at the vertices of cells of random shapes.
TEST(VolumeLight, NoiseAlongParabolas)
{
  RandomNumbers random(9);
  MeshArrays arrays = KuhnGrid(5);
  JitterInside(arrays, 0.06, random);
  arrays = Moved(arrays, [](const glm::dvec3& p) { return 2.0 * p - 1.0; });
  LitScene scene(
    arrays, LinearIndex, [&random](const glm::dvec3&) { return random.Uniform(-1.0, 1.0); },
    Layers);
  std::size_t cell = 0;
  ExpectLayers(scene, random, 10, [&](const glm::dvec3& p) { return scene.ScalarAt(p, cell); });
}

// n^2 = 2 - r^2 is exact in quadratic cells whose vertices have enough neighbours: rays are
// x cos(s) + p sin(s).
TEST(VolumeLight, LayersAlongEllipses)
{
  RandomNumbers random(3);
  const auto index = [](const glm::dvec3& p) { return 2.0 - glm::dot(p, p); };
  for (const int n : { 4, 6, 10 })
  {
    SCOPED_TRACE(n);
    LitScene scene(CenteredGrid(n, 0.5), index, SlantedScalar, Layers);
    for (int i = 0; i < 20; ++i)
    {
      const glm::dvec3 eye(random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), 0.5);
      const glm::dvec3 direction(random.Uniform(-0.1, 0.1), random.Uniform(-0.1, 0.1), -1.0);
      const glm::dvec3 momentum = std::sqrt(index(eye)) * glm::normalize(direction);
      const Path path = [&](double s) { return std::cos(s) * eye + std::sin(s) * momentum; };
      // cos(s) z + sin(s) p = -1/2: s by the angle of the amplitude.
      const double amplitude = std::hypot(eye.z, momentum.z);
      const double end = std::acos(-0.5 / amplitude) - std::atan2(-momentum.z, eye.z);
      ASSERT_NEAR(path(end).z, -0.5, 1.0e-12);
      const OpaqueSight sight = scene.See({ scene.RayFrom(eye, direction) }).front();
      ExpectLight(sight.Light, ReferenceLight(path, end, SlantedScalar, Layers));
    }
  }
}

// A constant index: the segments are those of straight rays.
TEST(VolumeLight, NothingBendsIsTheStraightIntegral)
{
  RandomNumbers random(4);
  LitScene scene(
    CenteredGrid(6, 1.0), [](const glm::dvec3&) { return 1.7; }, SlantedScalar, Layers);
  for (const bool isStraight : { false, true })
  {
    scene.Medium.IsStraight = isStraight;
    ForEachParabola(scene, random, 20,
      [](const ParabolaRay& ray, const OpaqueSight& sight)
      {
        const double end = std::min(2.0, (1.0 + ray.Eye.x) / -ray.Direction.x);
        ExpectLight(sight.Light,
          ReferenceLight(
            [&ray](double s) { return ray.Eye + s * ray.Direction; }, end, SlantedScalar, Layers));
      });
  }
}

// Where cells overlap, the one that the ray entered first counts up to its exit: smoke is as dense
// as the way through the cube is long.
TEST(VolumeLight, FoldsArePassedOnce)
{
  // A vertex within the cube is on the far side of its neighbours.
  const MeshArrays arrays = Moved(CenteredGrid(4, 1.0),
    [](const glm::dvec3& p) { return p == glm::dvec3(0.0) ? glm::dvec3(0.7, 0.1, 0.0) : p; });
  RandomNumbers random(8);
  LitScene scene(
    arrays, [](const glm::dvec3&) { return 1.7; }, [](const glm::dvec3&) { return 0.0; }, Smoke);
  for (const bool isStraight : { false, true })
  {
    scene.Medium.IsStraight = isStraight;
    for (int i = 0; i < 500; ++i)
    {
      const glm::dvec3 target(random.Uniform(-0.3, 0.75), random.Uniform(-0.3, 0.4), 0.0);
      const glm::dvec3 direction = glm::normalize(glm::dvec3(
        random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), random.Uniform() < 0.5 ? -1.0 : 1.0));
      const OpaqueSight sight =
        scene.See({ scene.RayFrom(target - 3.0 * direction, direction) }).front();
      const double transmittance = std::exp(-0.7 * 2.0 / std::abs(direction.z));
      EXPECT_NEAR(sight.Light.Values[3], transmittance, PictureError);
    }
  }
  EXPECT_GT(scene.Statistics.InvertedSteps, 100);
}

// A wall hides the medium behind it, wherever it cuts the arc of a cell.
TEST(VolumeLight, EndsAtAWall)
{
  RandomNumbers random(5);
  LitScene scene(CenteredGrid(3, 1.0), LinearIndex, SlantedScalar, Layers);
  for (const double depth : { 0.9, 0.123, -0.77 })
  {
    const double unit = 1.0 / scene.Mesh.GetRadius();
    OpaqueTriangles wall;
    wall.Build({ unit * glm::dvec3(-9, -9, depth), unit * glm::dvec3(9, -9, depth),
                 unit * glm::dvec3(0, 19, depth) },
      { { 0, 1, 2 } });
    const std::vector<std::uint8_t> cells = wall.FindCells(scene.Mesh);
    for (std::size_t c = 0; c < cells.size(); ++c)
    {
      scene.Flags[c] = HasLight | cells[c];
    }
    ForEachParabola(
      scene, random, 20,
      [depth](const ParabolaRay& ray, const OpaqueSight& sight)
      {
        ASSERT_EQ(sight.Hit.Triangle, 0);
        const double end = (depth - 1.0) / ray.Momentum.z;
        ExpectLight(sight.Light,
          ReferenceLight([&ray](double s) { return ray.At(s); }, end, SlantedScalar, Layers));
      },
      wall);
  }
}

// Many rays, whose arcs come in turn, and one at a time.
TEST(VolumeLight, RaysInTurnAndAlone)
{
  RandomNumbers random(6);
  LitScene scene(CenteredGrid(24, 1.0), LinearIndex, SlantedScalar, Layers);
  std::vector<GradedRay> rays;
  for (int i = 0; i < 3000; ++i)
  {
    const ParabolaRay ray(random);
    rays.push_back(scene.RayFrom(ray.Eye, ray.Direction));
  }
  const std::vector<OpaqueSight> sights = scene.See(rays);
  for (std::size_t i = 0; i < rays.size(); i += 100)
  {
    const OpaqueSight alone = scene.See({ rays[i] }).front();
    for (std::size_t k = 0; k < 4; ++k)
    {
      EXPECT_FLOAT_EQ(sights[i].Light.Values[k], alone.Light.Values[k]);
    }
  }
}

// Narrow bands of colour, for which arcs are divided into hundreds of segments alike.
TEST(VolumeLight, ManySegmentsAreNotRounded)
{
  Points bands;
  for (int i = 0; i <= 64; ++i)
  {
    bands.push_back({ i / 32.0 - 1.0, Smoke[0].Attenuation, glm::dvec3(i % 2) });
  }
  RandomNumbers random(9);
  for (const int n : { 1, 9 })
  {
    LitScene scene(CenteredGrid(n, 1.0), LinearIndex, SlantedScalar, bands);
    ForEachParabola(scene, random, 20,
      [](const ParabolaRay& ray, const OpaqueSight& sight)
      { EXPECT_NEAR(sight.Light.Values[3], TransmittanceOfArc(ray), SmokeError); });
  }
}

// Scalars of cells, and cells that are not seen.
TEST(VolumeLight, ScalarsOfCells)
{
  RandomNumbers random(7);
  // Cells of the cube's size, whose arcs turn by 0.7, and smaller ones.
  for (const int n : { 1, 4 })
  {
    LitScene scene(CenteredGrid(n, 1.0), LinearIndex, SlantedScalar, Smoke, true);
    ForEachParabola(scene, random, 20,
      [](const ParabolaRay& ray, const OpaqueSight& sight)
      { EXPECT_NEAR(sight.Light.Values[3], TransmittanceOfArc(ray), SmokeError); });
    scene.Flags.assign(scene.Flags.size(), 0);
    const ParabolaRay ray(random);
    EXPECT_EQ(scene.See({ scene.RayFrom(ray.Eye, ray.Direction) }).front().Light.Values[3], 1.0f);
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays of three legs: a mesh cut by two planes, as by the faces of a pane of glass. The rays behind
// each plane are computed here, one by one, and handed to the caster as a list.
#include "KernelMeshes.h"
#include "KernelPicture.h"

#include "Simd/InstructionSets.h"
#include "Volume/Caster/RefractedLegEntries.h"
#include "Volume/Optics/SurfaceLighting.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractedRayTexels.h"
#include "Volume/Refracted/RefractionFrames.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr int Size = 64;
constexpr int TileSize = RefractedRayTiles::TileSize;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/**
 * Largest difference of a colour: some 40 segments, of three operations each whose results below 1
 * are rounded to 2^-24, and two ends of three legs, rounded to 2^-24 of the frame's unit.
 */
constexpr float Tolerance = 1e-5f;

/** Perspective rays past the middle of the unit cube; no edge is parallel to the image. */
RayFrame FrameOfCube(const TetrahedralMesh& mesh)
{
  RayFrameInput input;
  input.WorldToView = glm::lookAt(
    glm::dvec3(1.9, 1.4, 3.1), glm::dvec3(0.51, 0.48, 0.53), glm::dvec3(0.1, 1.0, 0.05));
  input.ViewToClip = glm::perspective(0.6, 1.0, 0.5, 20.0);
  input.Center = mesh.GetCenter();
  input.Radius = mesh.GetRadius();
  input.ImageSize = glm::dvec2(Size);
  RayFrame frame;
  EXPECT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::Ok);
  return frame;
}

/** Two parallel planes in the frame of the view, and three indices of refraction. */
struct Pane
{
  /** Against the rays. */
  glm::dvec3 Normal = glm::normalize(glm::dvec3(0.3, -0.2, -1.0));
  /** dot(Normal, place) on the planes, the first one nearer to the viewer. */
  double Heights[2] = { 0.15, -0.25 };
  double Indices[3] = { 1.0, 1.5, 1.0 };
};

/** The unit cube, seen through a pane inside it. */
class PaneScene
{
public:
  explicit PaneScene(const Pane& pane)
    : Glass(pane)
  {
    this->Picture.Mesh.Build(KuhnGrid(6).View());
    this->Tree.Build(this->Picture.Mesh);
    for (std::int64_t v = 0; v < this->Picture.Mesh.GetNumberOfVertices(); ++v)
    {
      const glm::dvec3 place = this->Picture.Mesh.GetPosition(v);
      this->Picture.Scalars.push_back(static_cast<float>(place.x - 0.5 * place.y));
    }
    const RayFrame frame = FrameOfCube(this->Picture.Mesh);
    this->Picture.Frame = frame;
    this->Picture.Intervals = ConstantFunction(1.5);
    this->Picture.Optics.GradientToFrame =
      glm::inverse(glm::dmat3(frame.RowX, frame.RowY, frame.RowDepth));
    for (RefractedRayTiles& tiles : this->Behind)
    {
      tiles.Resize((Size / TileSize) * (Size / TileSize));
    }
    for (const auto& [row, column] : Product(Size, Size))
    {
      this->Trace(column, row);
    }
    this->UseLegs();
  }

  /** Makes a list of the legs; call this after a change of them. */
  void UseLegs()
  {
    // The direction of the frames' axis is not that of any ray.
    this->Frames.Turn(this->GetLegs(), glm::normalize(glm::dvec3(0.3, 0.2, 1.0)), SerialLoop);
    this->Frames.Place(this->Picture.Mesh, this->Picture.Scalars, SerialLoop);
    this->Picture.Optics.Refracted.Legs = { &this->Behind[0], &this->Behind[1] };
    this->Picture.Optics.Refracted.Frames = &this->Frames;
    this->Picture.Optics.Refracted.Tree = &this->Tree;
  }

  RayLegs GetLegs() const
  {
    return RayLegs(this->Picture.Frame, Size, Size, { &this->Behind[0], &this->Behind[1] });
  }

  RefractedRay& Ray(int plane, int column, int row)
  {
    std::vector<RefractedRay>& tile =
      this->Behind[static_cast<std::size_t>(plane)].ChangeTile(TileOf(column, row));
    tile.resize(RefractedRayTiles::RaysOfTile);
    return tile[static_cast<std::size_t>(PixelOf(column, row))];
  }

  static int TileOf(int column, int row)
  {
    return row / TileSize * (Size / TileSize) + column / TileSize;
  }
  static int PixelOf(int column, int row) { return row % TileSize * TileSize + column % TileSize; }

  /** Length of the part of a leg in the cube, in world coordinates; from the box alone. */
  double LengthInCube(int column, int row, int number) const
  {
    RayLeg leg;
    if (!this->GetLegs().Find(TileOf(column, row), PixelOf(column, row), number, leg))
    {
      return 0.0;
    }
    const glm::dmat3& toWorld = this->Picture.Frame.ViewToWorld;
    const glm::dvec3 begin = toWorld * leg.Begin;
    const glm::dvec3 step = toWorld * leg.Step;
    double from = number == 0 ? -10.0 : 0.0;
    double to = leg.End - leg.Depth;
    // ViewToWorld turns to the axes of the world; the frame's origin is the middle of the cube.
    for (int axis = 0; axis < 3; ++axis)
    {
      const double first = (-0.5 - begin[axis]) / step[axis];
      const double second = (0.5 - begin[axis]) / step[axis];
      from = std::max(from, std::min(first, second));
      to = std::min(to, std::max(first, second));
    }
    return std::max(to - from, 0.0) * glm::length(step);
  }

  /** Expects the attenuation of the lengths of the drawn legs in every pixel. */
  void ExpectLengths(const LegRange& drawn, bool beginsInside, InstructionSet set)
  {
    this->Picture.Optics.Refracted.Drawn = drawn;
    this->Picture.Optics.Refracted.BeginsInside = beginsInside;
    const meniscus::test::Picture picture = CastPicture(this->Picture, Size, set);
    EXPECT_EQ(picture.Statistics.Lost, 0);
    double largest = 0.0;
    int seen = 0;
    for (const auto& [row, column] : Product(Size, Size))
    {
      double length = 0.0;
      for (int number = drawn.First; number < std::min(drawn.End, 3); ++number)
      {
        length += this->LengthInCube(column, row, number);
      }
      seen += length > 0.1 ? 1 : 0;
      const double alpha = 1.0 - std::exp(-1.5 * length);
      largest = std::max(largest, std::fabs(alpha - picture.Alpha(column, row)));
    }
    EXPECT_LT(largest, Tolerance) << NameOf(set) << ", legs " << drawn.First << " to " << drawn.End
                                  << ", inside " << beginsInside;
    EXPECT_GT(seen, 500);
  }

  Pane Glass;
  PictureScene Picture;
  std::array<RefractedRayTiles, 2> Behind;
  RefractionFrames Frames;

private:
  /** Snell's law at both planes. */
  void Trace(int column, int row)
  {
    const double i = column + 0.5 - 0.5 * Size;
    const double j = row + 0.5 - 0.5 * Size;
    glm::dvec3 place(this->Picture.Frame.Origin.At(i, j), 0.0);
    glm::dvec3 step(this->Picture.Frame.Slope.At(i, j), 1.0);
    const double sight = glm::length(step);
    const glm::dvec3& normal = this->Glass.Normal;
    double depth = 0.0;
    for (int k = 0; k < 2; ++k)
    {
      const double way =
        (this->Glass.Heights[k] - glm::dot(normal, place)) / glm::dot(normal, step);
      depth += way;
      place += way * step;
      // The component along the plane is kept times the index, the other one follows.
      const glm::dvec3 direction = glm::normalize(step);
      const double ratio = this->Glass.Indices[k] / this->Glass.Indices[k + 1];
      const glm::dvec3 along = ratio * (direction - glm::dot(direction, normal) * normal);
      const glm::dvec3 refracted = along - std::sqrt(1.0 - glm::dot(along, along)) * normal;
      step = this->Glass.Indices[k + 1] / this->Glass.Indices[0] * sight * refracted;
      this->Ray(k, column, row) = { depth, step };
    }
  }

  BoundaryTree Tree;
};

/** Planes with the same medium everywhere. */
Pane NoGlass()
{
  Pane pane;
  pane.Indices[1] = 1.0;
  return pane;
}

/** Window depth of a depth of the frame. */
float WindowDepthOf(const RayFrame& frame, double depth)
{
  double lower = 0.0;
  double upper = 1.0;
  for (int bisection = 0; bisection < 50; ++bisection)
  {
    const double middle = 0.5 * (lower + upper);
    (frame.DepthAt(2.0 * middle - 1.0) < depth ? lower : upper) = middle;
  }
  return static_cast<float>(lower);
}

/** Compares three collinear legs with the straight ray, from the inside and from the boundary. */
void ExpectStraight(PaneScene& scene, InstructionSet set, float windowDepth)
{
  PictureScene& picture = scene.Picture;
  const RefractedScene legs = picture.Optics.Refracted;
  picture.Optics.Refracted = RefractedScene();
  const Picture straight = CastPicture(picture, Size, set, windowDepth);
  for (const bool beginsInside : { false, true })
  {
    picture.Optics.Refracted = legs;
    picture.Optics.Refracted.BeginsInside = beginsInside;
    const Picture joined = CastPicture(picture, Size, set, windowDepth);
    float largest = 0.0f;
    for (std::size_t i = 0; i < joined.Rgba.size(); ++i)
    {
      largest = std::max(largest, std::fabs(joined.Rgba[i] - straight.Rgba[i]));
    }
    EXPECT_LT(largest, Tolerance) << GetBlendModel(picture.Optics.Blending).Label << ", "
                                  << NameOf(set) << ", inside " << beginsInside;
    EXPECT_EQ(joined.Statistics.Rays, straight.Statistics.Rays);
    EXPECT_EQ(joined.Statistics.Lost, 0);
    EXPECT_GT(joined.Statistics.Steps, straight.Statistics.Steps);
    // A leg that begins inside repeats about the cell of its sight point; the mesh has some 20
    // cells along a ray.
    if (beginsInside && windowDepth == 1.0f && picture.Optics.ClippingPlanes.empty())
    {
      EXPECT_LT(joined.Statistics.Steps, straight.Statistics.Steps + 5 * straight.Statistics.Rays);
    }
  }
  EXPECT_GT(*std::max_element(straight.Rgba.begin(), straight.Rgba.end()), 0.3f);
}

}

TEST(RayLegs, PaneDisplacesRaysAndKeepsTheirDirection)
{
  const PaneScene scene{ Pane() };
  const RayLegs legs = scene.GetLegs();
  const double thickness = scene.Glass.Heights[0] - scene.Glass.Heights[1];
  ASSERT_EQ(legs.GetNumberOfLegs(), 3);
  for (const auto& [row, column] : Product(Size, Size))
  {
    const int tile = PaneScene::TileOf(column, row);
    const int pixel = PaneScene::PixelOf(column, row);
    RayLeg sight;
    RayLeg behind;
    ASSERT_TRUE(legs.Find(tile, pixel, 0, sight));
    ASSERT_TRUE(legs.Find(tile, pixel, 2, behind));
    EXPECT_EQ(behind.End, Infinity);
    EXPECT_LE(glm::length(behind.Step - sight.Step), 1e-15 * 8.0);
    // d sin(t1 - t2) / cos(t2)
    const glm::dvec3 direction = glm::normalize(sight.Step);
    const double outside = std::acos(-glm::dot(direction, scene.Glass.Normal));
    const double inside = std::asin(std::sin(outside) / 1.5);
    const glm::dvec3 between = behind.Begin - sight.Begin;
    EXPECT_NEAR(glm::length(between - glm::dot(between, direction) * direction),
      thickness * std::sin(outside - inside) / std::cos(inside), 1e-13);
  }
}

TEST(RayLegs, PaneInsideTheMeshIsTheClosedForm)
{
  PaneScene scene{ Pane() };
  for (const InstructionSet set : GetInstructionSets())
  {
    for (const bool beginsInside : { false, true })
    {
      scene.ExpectLengths({ 0, 3 }, beginsInside, set);
    }
    for (int leg = 0; leg < 3; ++leg)
    {
      scene.ExpectLengths({ leg, leg + 1 }, true, set);
    }
    scene.ExpectLengths(LegsOf(MembranePart::Behind), true, set);
  }
}

TEST(RayLegs, CollinearLegsAreTheStraightRayInEveryMode)
{
  PaneScene scene{ NoGlass() };
  scene.Picture.Surfaces = { { 0.1f, 0.5f, { 1.0f, 0.0f, 0.5f } },
    { 0.4f, 0.6f, { 0.0f, 1.0f, 0.5f } } };
  scene.Picture.Optics.DataRange = { -0.5, 1.0 };
  scene.Picture.Intervals =
    BuildIntervals({ { -0.4, 0.3, { 1.0, 0.2, 0.1 } }, { 0.3, 1.2, { 0.1, 1.0, 0.3 } },
                     { 0.9, 0.8, { 0.3, 0.2, 1.0 } } },
      ScalarNormalization());
  for (const BlendModel& model : BlendModels)
  {
    scene.Picture.Optics.Blending = model.Mode;
    for (const InstructionSet set : GetInstructionSets())
    {
      ExpectStraight(scene, set, 1.0f);
    }
  }
}

TEST(RayLegs, LightIsTurnedToTheFrameOfEveryLeg)
{
  PaneScene scene{ NoGlass() };
  SurfaceLighting lighting;
  lighting.Ambient = 0.2;
  lighting.Diffuse = 0.7;
  lighting.Specular = 0.1;
  lighting.SpecularPower = 3.0;
  RayCastLight light;
  light.Position = glm::dvec4(glm::normalize(glm::dvec3(0.5, 0.6, -1.0)), 0.0);
  light.Diffuse = { 1.0, 0.5, 0.25 };
  light.Specular = { 0.25, 0.5, 1.0 };
  lighting.Lights.push_back(light);
  scene.Picture.Optics.Lighting = &lighting;
  for (const InstructionSet set : GetInstructionSets())
  {
    ExpectStraight(scene, set, 1.0f);
  }
}

TEST(RayLegs, OpaqueDepthsAndClippingPlanesCutEveryLeg)
{
  PaneScene scene{ NoGlass() };
  // In front of the pane, in it, behind it.
  for (const double depth : { -0.3, 0.05, 0.6 })
  {
    ExpectStraight(scene, BestInstructionSet(), WindowDepthOf(scene.Picture.Frame, depth));
  }
  // A cut along the rays' general direction, and the front or the back of the mesh.
  for (const glm::dvec3 normal :
    { glm::dvec3(1.0, -0.7, 0.1), glm::dvec3(0.2, 0.1, 1.0), glm::dvec3(-0.3, 0.2, -1.0) })
  {
    scene.Picture.Optics.ClippingPlanes = { ComputeClippingPlane(
      scene.Picture.Frame, normal, 0.03) };
    ExpectStraight(scene, BestInstructionSet(), 1.0f);
  }
}

TEST(RayLegs, RaysEndWhereTheirLegsEnd)
{
  // A tile without rays behind the second plane, rays that miss it, and rays that are totally
  // reflected there.
  PaneScene scene{ Pane() };
  scene.Behind[1].ChangeTile(0).clear();
  for (const auto& [row, column] : Product(Numbers(TileSize, Size), Size))
  {
    RefractedRay& ray = scene.Ray(1, column, row);
    ray = column % 2 == 0 ? RefractedRay() : RefractedRay{ ray.Depth, glm::dvec3(0.0) };
  }
  scene.UseLegs();
  EXPECT_EQ(scene.GetLegs().GetNumberOfLegs(0), 2);
  EXPECT_EQ(scene.GetLegs().GetNumberOfLegs(1), 3);
  RayLeg leg;
  const RayLegs legs = scene.GetLegs();
  ASSERT_TRUE(legs.Find(0, 5, 1, leg));
  EXPECT_EQ(leg.End, Infinity);
  ASSERT_TRUE(legs.Find(2, 6, 1, leg));
  EXPECT_EQ(leg.End, Infinity);
  ASSERT_TRUE(legs.Find(2, 7, 1, leg));
  EXPECT_LT(leg.End, 1.0);
  for (const int pixel : { 6, 7 })
  {
    EXPECT_FALSE(legs.Find(2, pixel, 2, leg));
  }
  for (const bool beginsInside : { false, true })
  {
    scene.ExpectLengths({ 0, 3 }, beginsInside, BestInstructionSet());
  }
}

TEST(RayLegs, LinesForShadersAreTheLegs)
{
  const PaneScene scene{ Pane() };
  const RayLegs legs = scene.GetLegs();
  std::vector<RefractedRayLine> lines;
  LayOutRefractedRays(legs, scene.Frames, SerialLoop, lines);
  ASSERT_EQ(lines.size(), std::size_t{ 2 } * Size * Size);
  // Offsets are rounded to grid units of about 2^-28 and slopes to a fraction of one; five of these
  // add up. Depths are rounded to 2^-30.
  constexpr double precision = 5.0 / (1 << 28);
  for (const auto& [row, column] : Product(Size, Size))
  {
    glm::dmat3 frameBefore(1.0);
    for (int number = 1; number < 3; ++number)
    {
      RayLeg leg;
      ASSERT_TRUE(
        legs.Find(PaneScene::TileOf(column, row), PaneScene::PixelOf(column, row), number, leg));
      const RefractedRayLine& line =
        lines[static_cast<std::size_t>(((number - 1) * Size + row) * Size + column)];
      const RefractionFrame& frame = scene.Frames.Get(line.GetFrame());
      EXPECT_NEAR(
        FixedPointRays::DepthOf(line.GetGridEndBefore()), (frameBefore * leg.Begin).z, precision);
      frameBefore = frame.FromView;
      const double unit = frame.Rays.GetGridUnit();
      const double slopeUnit = unit * PacketVertex::GridPerDepth * FixedPointRays::ShaderSlopeUnit;
      const glm::dvec3 along(line.Slope[0] * slopeUnit, line.Slope[1] * slopeUnit, 1.0);
      const glm::dvec3 place = glm::dvec3(unit * line.Offset[0], unit * line.Offset[1], 0.0) +
        FixedPointRays::DepthOf(line.GetGridStart()) * along;
      EXPECT_LE(glm::length(place - frame.FromView * leg.Begin), precision);
      // PerDepth is a float.
      EXPECT_LE(glm::length(double{ line.PerDepth } * along - frame.FromView * leg.Step), 2e-7);
    }
  }
}

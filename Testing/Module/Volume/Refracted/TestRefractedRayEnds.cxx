// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays behind interfaces that are traced only as far as the mesh needs them.
#include "RefractionTestRandom.h"
#include "StackedRays.h"

#include "Volume/Refracted/RefractionFrames.h"
#include "Volume/Refracted/StackBlock.h"

using namespace meniscus;
using namespace meniscus::test;
using meniscus::test::Random;

namespace
{

/** A mesh of solid boxes. */
struct SolidMesh
{
  WorldBox Whole;
  std::vector<WorldBox> Solids;
  /** Boxes around its boundary; may be empty. */
  std::vector<WorldBox> Parts{};

  bool Meets(const glm::dvec3& start, const glm::dvec3& along, double end) const
  {
    return std::any_of(this->Solids.begin(), this->Solids.end(),
      [&](const WorldBox& solid) { return solid.Meets(start, along, end); });
  }
};

/** Rays through interfaces to a small mesh, compared with those to a mesh that is everywhere. */
struct EndedRays
{
  int Shown = 0;
  int Ended = 0;
  int Hidden = 0;
  int Wrong = 0;
  std::int64_t Untraced = 0;
  std::int64_t UntracedOfAll = 0;

  void Compare(
    const std::vector<Interface>& list, const RefractedRayStack::View& view, const WorldBox& box)
  {
    this->CompareMesh(list, view, { box, { box } });
  }
  void CompareMesh(
    const std::vector<Interface>& list, RefractedRayStack::View view, const SolidMesh& mesh)
  {
    RefractedRayStack all;
    SetMesh(view, Everywhere);
    all.Build(list, view);
    RefractedRayStack some;
    SetMesh(view, mesh.Whole, mesh.Parts);
    some.Build(list, view);
    EXPECT_EQ(some.GetCounts().Missing, all.GetCounts().Missing);
    EXPECT_EQ(some.GetCounts().Reflected, all.GetCounts().Reflected);
    this->UntracedOfAll += all.GetNumberOfUntracedBlocks();
    this->Untraced += some.GetNumberOfUntracedBlocks();
    const RayLegs legs = LegsOf(all, view);
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const auto rayOf = [pixel](const RefractedRayStack& stack, std::size_t interface)
      { return RayOf(stack.GetRays()[interface], pixel % Size, pixel / Size); };
      bool comes = false;
      for (std::size_t k = list.size(); k > 0; --k)
      {
        const WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, static_cast<int>(k));
        const RefractedRay exact = rayOf(all, k - 1);
        const RefractedRay found = rayOf(some, k - 1);
        const RefractedRay next = k < list.size() ? rayOf(all, k) : RefractedRay();
        comes = comes ||
          (exact.GoesOn() && mesh.Meets(ray.Start, ray.Direction, next.Depth - exact.Depth));
        this->Shown += comes ? 1 : 0;
        this->Ended += exact.GoesOn() && !found.GoesOn() ? 1 : 0;
        this->Wrong += comes && (exact.Depth != found.Depth || exact.Step != found.Step) ? 1 : 0;
      }
      // Rays that do not come to the mesh straight on may miss the first interface. Rays that show
      // nothing of the mesh, since they meet the interface before, may end where they begin.
      const WorldRay sight = LegOf(legs, view, pixel % Size, pixel / Size, 0);
      const glm::dvec3 eye = sight.Start + view.EyeDepth * sight.Direction;
      const double depth = rayOf(all, 0).Depth;
      const double found = rayOf(some, 0).Depth;
      const bool isHidden = depth < 1e30 && found == view.EyeDepth && !comes;
      const double length = isHidden ? depth - view.EyeDepth : 1e30;
      this->Hidden += isHidden ? 1 : 0;
      this->Wrong += depth != found && mesh.Meets(eye, sight.Direction, length) ? 1 : 0;
      // Rays that come to the mesh in front of the interface count for the bound of the tile.
      const int tile = pixel / Size / TileSize * Columns + pixel % Size / TileSize;
      const double farthest = some.GetRays().front().GetFarthest(tile);
      const bool isSeen = mesh.Meets(eye, sight.Direction, depth - view.EyeDepth);
      this->Wrong += isSeen && !(farthest >= depth) ? 1 : 0;
    }
  }
};

/** Three boxes, whose common bounds are mostly empty. */
SolidMesh MakeThreeBoxes(Random& random)
{
  SolidMesh mesh{ { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.2) }, {} };
  for (int i = 0; i < 3; ++i)
  {
    mesh.Solids.push_back({ random.Point(glm::dvec3(-1.0, -1.0, -2.0), glm::dvec3(1.0, 1.0, 0.0)),
      random.Point(glm::dvec3(0.02), glm::dvec3(0.2)) });
  }
  mesh.Parts = mesh.Solids;
  return mesh;
}

/** A solid box with a box around each of its sides. */
SolidMesh MakeBoxWithSides(Random& random)
{
  const WorldBox solid{ random.Point(glm::dvec3(-0.3, -0.3, -0.7), glm::dvec3(0.3, 0.3, 0.1)),
    random.Point(glm::dvec3(0.3), glm::dvec3(2.0)) };
  SolidMesh mesh{ solid, { solid } };
  for (int side = 0; side < 6; ++side)
  {
    WorldBox part = solid;
    part.Center[side / 2] += (side % 2 == 0 ? -1.0 : 1.0) * solid.Half[side / 2];
    part.Half[side / 2] = 1e-6;
    mesh.Parts.push_back(part);
  }
  return mesh;
}

}

/** The same for one surface, of few and of many facets, from both sides. */
TEST(RefractedRayStack, LeavesOutOnlyRaysThatDoNotComeToTheMesh)
{
  Random random(11);
  EndedRays rays;
  for (const auto& shape : Shapes)
  {
    for (const int cells : { 1, 3, 12, 48 })
    {
      const Sheet sheet(shape, cells);
      for (int view = 0; view < 24; ++view)
      {
        const double side = view % 4 == 3 ? -1.0 : 1.0;
        const glm::dvec3 eye(random(-2.0, 2.0), random(-2.0, 2.0), side * random(0.2, 3.0));
        const glm::dvec3 target =
          random.Point(glm::dvec3(-0.8, -0.8, -0.1), glm::dvec3(0.8, 0.8, 0.1));
        const WorldBox box{ random.Point(glm::dvec3(-1.0, -1.0, -1.0), glm::dvec3(1.0, 1.0, 0.5)),
          random.Point(glm::dvec3(0.05), glm::dvec3(0.5)) };
        rays.Compare({ sheet.Between(1.0, 1.333) },
          LookAt(eye, target, random(0.5, 3.0), view % 3 == 0, Size), box);
        ASSERT_EQ(rays.Wrong, 0) << cells << " cells, view " << view;
      }
    }
  }
  EXPECT_GT(rays.Shown, 50000);
  EXPECT_GT(rays.Ended, 100000);
  EXPECT_GT(rays.Hidden, 1000);
}

/** Rays through a pane end early only where they do not come to the mesh. */
TEST(RefractedRayStack, EndsOnlyRaysThatDoNotComeToTheMesh)
{
  Random random(23);
  const Sheet front(Shapes[2], 12);
  const Sheet back([](double x, double y) { return Shapes[1](y, x) - 0.8; }, 9);
  const std::vector<Interface> pane{ front.Between(1.0, 1.5), back.Between(1.5, 1.1) };
  EndedRays rays;
  for (int i = 0; i < 96; ++i)
  {
    const RefractedRayStack::View view =
      LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), random(0.5, 3.0)),
        random.Point(glm::dvec3(-0.5), glm::dvec3(0.5)), random(0.5, 2.0), i % 3 == 0, Size);
    rays.Compare(pane, view,
      { random.Point(glm::dvec3(-1.0, -1.0, -2.0), glm::dvec3(1.0, 1.0, 0.5)),
        random.Point(glm::dvec3(0.05), glm::dvec3(0.5)) });
  }
  EXPECT_EQ(rays.Wrong, 0);
  EXPECT_GT(rays.Shown, 10000);
  EXPECT_GT(rays.Ended, 10000);
  EXPECT_EQ(rays.UntracedOfAll, 0);
  // Half of the blocks of 8 x 8 rays.
  EXPECT_GT(rays.Untraced, 96 * Size * Size / (8 * 8) / 2);
}

/**
 * Bounds of the parts of a mesh end more rays than those of the whole, but none that comes to the
 * mesh: neither between parts of the boundary, nor where legs, or the eye, are inside the mesh.
 */
TEST(RefractedRayStack, EndsRaysThatDoNotComeToThePartsOfTheMesh)
{
  Random random(31);
  const Sheet front(Shapes[2], 12);
  const Sheet back([](double x, double y) { return Shapes[1](y, x) - 0.8; }, 9);
  const std::vector<Interface> pane{ front.Between(1.0, 1.5), back.Between(1.5, 1.1) };
  EndedRays rays;
  EndedRays ofWhole;
  for (int i = 0; i < 96; ++i)
  {
    const RefractedRayStack::View view =
      LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), random(0.5, 3.0)),
        random.Point(glm::dvec3(-0.5), glm::dvec3(0.5)), random(0.5, 2.0), i % 3 == 0, Size);
    SolidMesh mesh = i % 2 == 0 ? MakeThreeBoxes(random) : MakeBoxWithSides(random);
    const std::vector<Interface> one{ i % 4 < 2 ? pane.front() : pane.back() };
    for (const std::vector<Interface>& list : { one, pane })
    {
      rays.CompareMesh(list, view, mesh);
      ASSERT_EQ(rays.Wrong, 0) << "view " << i;
    }
    mesh.Parts.clear();
    ofWhole.CompareMesh(pane, view, mesh);
    ofWhole.CompareMesh(one, view, mesh);
  }
  EXPECT_GT(rays.Shown, 10000);
  EXPECT_GT(rays.Ended, ofWhole.Ended + 10000);
  EXPECT_GT(rays.Untraced, ofWhole.Untraced + 1000);
}

/** The same from behind, at sheets of few and of many facets, through a ball, and into dense media.
 */
TEST(RefractedRayStack, BoundsOfLegsHoldFromEachSide)
{
  Random random(29);
  const Sheet coarse(Shapes[0], 1);
  const Sheet waves([](double x, double y) { return Shapes[2](x, y) - 0.4; }, 48);
  const Sphere sphere(12);
  // Media from above, and from below in the reverse order.
  const std::vector<Interface> above{ coarse.Between(1.0, 2.0), waves.Between(2.0, 1.0) };
  const std::vector<Interface> below{ waves.Between(2.0, 1.0), coarse.Between(1.0, 2.0) };
  const std::vector<Interface> ball{ sphere.Between(1.0, 1.5), sphere.Between(1.0, 1.5) };
  const std::vector<Interface> behind{ coarse.Between(1.0, 1.3), sphere.Between(1.3, 1.0),
    sphere.Between(1.3, 1.0) };
  EndedRays rays;
  for (int i = 0; i < 48; ++i)
  {
    const std::vector<Interface>& list =
      i % 4 == 0 ? above : (i % 4 == 1 ? below : (i % 4 == 2 ? ball : behind));
    const double side = i % 4 == 1 ? -1.0 : 1.0;
    const RefractedRayStack::View view =
      LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), side * random(1.5, 3.0)),
        random.Point(glm::dvec3(-0.5), glm::dvec3(0.5)), random(0.5, 3.0), i % 3 == 0, Size);
    rays.Compare(list, view,
      { random.Point(glm::dvec3(-0.9), glm::dvec3(0.9)),
        random.Point(glm::dvec3(0.05), glm::dvec3(0.4)) });
  }
  EXPECT_EQ(rays.Wrong, 0);
  EXPECT_GT(rays.Shown, 5000);
  EXPECT_GT(rays.Ended, 5000);
  EXPECT_EQ(rays.UntracedOfAll, 0);
  EXPECT_GT(rays.Untraced, 48 * Size * Size / (8 * 8) / 4);
}

/**
 * A prism turns rays away from a mesh that is seen without it, and towards one that is not. Only
 * the latter has to be traced to the second surface.
 */
TEST(RefractedRayStack, StraightRaysToTheMeshDoNotMatter)
{
  const Sheet front([](double, double) { return 0.0; }, 12);
  const Sheet back([](double x, double) { return -0.5 + 0.5 * x; }, 12);
  const std::vector<Interface> prism{ front.Between(1.0, 1.6), back.Between(1.6, 1.0) };
  RefractedRayStack::View view =
    LookAt(glm::dvec3(0.0, 0.0, 20.0), glm::dvec3(0.0), 0.2, false, Size);
  const double depth = 4.0;
  // The angle between the surfaces is atan(1/2); rays come to the first one along its normal.
  const double inside = std::atan(0.5);
  const double turned = std::asin(1.6 * std::sin(inside)) - inside;
  const WorldBox straight{ glm::dvec3(0.0, 0.0, -depth), glm::dvec3(0.2) };
  const WorldBox aside{ glm::dvec3(-std::tan(turned) * (depth - 0.5), 0.0, -depth),
    glm::dvec3(0.2) };
  const auto countShown = [&](const WorldBox& box)
  {
    SetMesh(view, box);
    RefractedRayStack stack;
    stack.Build(prism, view);
    const RayLegs legs = LegsOf(stack, view);
    int shown = 0;
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const WorldRay ray = LegOf(legs, view, pixel % Size, pixel / Size, 2);
      shown += ray.Direction != glm::dvec3(0.0) ? 1 : 0;
    }
    const int blocks = Size * Size / StackBlock::Size;
    EXPECT_EQ(stack.GetNumberOfUntracedBlocks(), shown > 0 ? 0 : blocks);
    return shown;
  };
  EXPECT_EQ(countShown(straight), 0);
  EXPECT_EQ(countShown(aside), Size * Size);
}

/**
 * Blocks of rays that miss a small mesh, both refracted and straight on, are not traced at all. The
 * bound of a tile's ends holds for all rays that reach the mesh.
 */
TEST(RefractedRayStack, BlocksBesideTheMeshAreNotTraced)
{
  constexpr int side = RefractedRayTiles::SquareSize;
  constexpr int blocks = Size / side * (Size / side);
  Random random(37);
  const Sheet waves(Shapes[2], 24);
  const std::vector<Interface> water{ waves.Between(1.0, 1.33) };
  int traced = 0;
  int shown = 0;
  int ends = 0;
  int hidden = 0;
  for (int i = 0; i < 24; ++i)
  {
    RefractedRayStack::View view = LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), 4.0),
      glm::dvec3(0.0, 0.0, -1.0), 1.0, false, Size);
    RefractedRayStack all;
    SetMesh(view, Everywhere);
    all.Build(water, view);
    // Every third box is above the waves, where rays show it before they are refracted.
    const bool isAbove = i % 3 == 0;
    const double height = isAbove ? 1.2 : 0.0;
    const WorldBox box{ random.Point(
                          glm::dvec3(-0.3, -0.3, height - 1.0), glm::dvec3(0.3, 0.3, height - 0.6)),
      random.Point(glm::dvec3(0.1), glm::dvec3(0.2)) };
    RefractedRayStack some;
    SetMesh(view, box);
    some.Build(water, view);
    traced += isAbove ? 0 : blocks - static_cast<int>(some.GetNumberOfUntracedBlocks());
    const RayLegs legs = LegsOf(all, view);
    const RayLegs fewer = LegsOf(some, view);
    std::vector<bool> shows(blocks, false);
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const int column = pixel % Size;
      const int row = pixel / Size;
      const WorldRay ray = LegOf(legs, view, column, row, 1);
      const WorldRay sight = LegOf(legs, view, column, row, 0);
      const double end = RayOf(all.GetRays()[0], column, row).Depth;
      const bool isStraight = box.Meets(sight.Start, sight.Direction, 1e30);
      const bool isBehind = box.Meets(ray.Start, ray.Direction, 1e30);
      const bool isBefore = box.Meets(sight.Start, sight.Direction, end);
      const auto block = static_cast<std::size_t>(row / side * (Size / side) + column / side);
      shows[block] = shows[block] || (!isAbove && (isStraight || isBehind));
      const double farthest = fewer.GetFarthestEnd(row / TileSize * Columns + column / TileSize);
      EXPECT_TRUE(!isBefore || end <= farthest);
      ends += isBefore && farthest < 1e30 ? 1 : 0;
      hidden += isBehind && farthest < -1e30 ? 1 : 0;
    }
    shown += static_cast<int>(std::count(shows.begin(), shows.end(), true));
  }
  EXPECT_GT(ends, 1000);
  EXPECT_GT(hidden, 1000);
  EXPECT_GT(shown, 24);
  EXPECT_GE(traced, shown);
  // Bounds add a ring of blocks: a square of n x n becomes one of (n + 2) x (n + 2), n at least 3.
  EXPECT_LT(traced, shown * 25 / 9);
}

/**
 * Tiles that showed the mesh hold nothing of it after another view, in an image of any size, and
 * nothing is left of a surface that has got another shape.
 */
TEST(RefractedRayStack, BuildsDoNotDependOnEarlierOnes)
{
  Sheet front(Shapes[2], 12);
  const Sheet back([](double x, double y) { return Shapes[2](y, x) - 0.4; }, 9);
  const std::vector<Interface> pane{ front.Between(1.0, 1.5), back.Between(1.5, 1.1) };
  Random random(31);
  RefractedRayStack kept;
  int met = 0;
  for (int i = 0; i < 24; ++i)
  {
    front.SetHeight([i](double x, double y) { return 0.1 * i * Shapes[2](x, y); }, 12);
    RefractedRayStack::View view = LookAt(glm::dvec3(random(-1.0, 1.0), random(-1.0, 1.0), 2.0),
      random.Point(glm::dvec3(-0.5), glm::dvec3(0.5)), random(0.5, 2.0), false, Size);
    view.Width = i % 3 == 0 ? Size - 13 : Size;
    SetMesh(view,
      { random.Point(glm::dvec3(-1.0, -1.0, -1.0), glm::dvec3(1.0, 1.0, 0.0)),
        random.Point(glm::dvec3(0.05), glm::dvec3(0.5)) });
    const std::vector<Interface> list(pane.begin(), pane.end() - (i % 5 == 0 ? 1 : 0));
    kept.Build(list, view);
    RefractedRayStack fresh;
    fresh.Build(list, view);
    ASSERT_EQ(kept.GetRays().size(), fresh.GetRays().size());
    for (std::size_t k = 0; k < list.size(); ++k)
    {
      for (int tile = 0; tile < fresh.GetRays()[k].GetNumberOfTiles(); ++tile)
      {
        const RefractedRay* one = kept.GetRays()[k].GetTile(tile);
        const RefractedRay* other = fresh.GetRays()[k].GetTile(tile);
        ASSERT_EQ(one != nullptr, other != nullptr);
        for (int pixel = 0; other && pixel < RefractedRayTiles::RaysOfTile; ++pixel)
        {
          ASSERT_TRUE(
            one[pixel].Depth == other[pixel].Depth && one[pixel].Step == other[pixel].Step);
          met += other[pixel].GoesOn() ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(met, 10000);
}

/** The bounds of the steps hold, and lead to the frames that the single rays need. */
TEST(RefractedRayStack, StepBoundsChooseTheFramesOfAllRays)
{
  const Sphere sphere(16);
  const std::vector<Interface> ball{ sphere.Between(1.0, 2.0), sphere.Between(1.0, 2.0) };
  int several = 0;
  for (const double width : { 0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 2.5 })
  {
    RefractedRayStack::View view =
      LookAt(glm::dvec3(0.3, 0.2, 2.5), glm::dvec3(0.0), width, false, Size);
    SetMesh(view, Everywhere);
    RefractedRayStack stack;
    stack.Build(ball, view);
    AxisBox steps;
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      for (const RefractedRayTiles& rays : stack.GetRays())
      {
        const RefractedRay ray = RayOf(rays, pixel % Size, pixel / Size);
        steps.Add(ray.GoesOn() ? AxisBox{ ray.Step, ray.Step } : AxisBox());
      }
    }
    EXPECT_EQ(stack.GetStepBounds().Low, steps.Low);
    EXPECT_EQ(stack.GetStepBounds().High, steps.High);
    const RayLegs legs = LegsOf(stack, view);
    RefractionFrames each;
    each.Turn(legs, stack.GetMeanDirection(), SerialLoop);
    RefractionFrames bounded;
    bounded.Turn(legs, stack.GetMeanDirection(), SerialLoop, stack.GetStepBounds());
    int frames = 0;
    for (int index = 0; index < RefractionFrames::Number; ++index)
    {
      // Frames that are not needed are not turned.
      const glm::dmat3& turn = each.Get(index).FromView;
      EXPECT_EQ(bounded.Get(index).FromView, turn) << width;
      frames += turn != glm::dmat3(1.0) ? 1 : 0;
    }
    several += frames > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 0);
  EXPECT_LT(several, 7);
}

TEST(RefractedRayStack, TheOrderOfTilesDoesNotMatter)
{
  const Sheet front(Shapes[2], 12);
  const Sheet back([](double x, double y) { return Shapes[2](y, x) - 0.4; }, 9);
  const std::vector<Interface> pane{ front.Between(1.0, 1.5), back.Between(1.5, 1.1) };
  RefractedRayStack::View view = LookAtAll(glm::dvec3(0.4, 0.2, 2.0), glm::dvec3(0.0), 1.7, false);
  RefractedRayStack forward;
  forward.Build(pane, view);
  RefractedRayStack backward;
  backward.Build(pane, view,
    [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
    {
      for (std::size_t i = count; i > 0; --i)
      {
        body(i - 1, i);
      }
    });
  EXPECT_EQ(forward.GetMeanDirection(), backward.GetMeanDirection());
  EXPECT_EQ(forward.GetCounts().Missing, backward.GetCounts().Missing);
  for (const auto& [pixel, k] :
    Product(Size * Size, std::vector<std::size_t>{ std::size_t{ 0 }, std::size_t{ 1 } }))
  {
    const RefractedRay one = RayOf(forward.GetRays()[k], pixel % Size, pixel / Size);
    const RefractedRay other = RayOf(backward.GetRays()[k], pixel % Size, pixel / Size);
    ASSERT_TRUE(one.Depth == other.Depth && one.Step == other.Step);
  }
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Cells that rays visit, counted by a simple search over cells and neighbours.
#include "KernelMeshes.h"
#include "KernelPicture.h"
#include "Simd/InstructionSets.h"
#include "Volume/Optics/VisibleRanks.h"
#include "Volume/Optics/VisibleScalars.h"

#include <thread>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr float Nan = std::numeric_limits<float>::quiet_NaN();

std::vector<TransferFunctionInterval> Function(const std::vector<std::pair<double, double>>& points)
{
  std::vector<TransferFunctionPoint> list;
  for (const auto& point : points)
  {
    list.push_back({ point.first, point.second, glm::dvec3(1.0, 0.5, 0.25) });
  }
  return BuildIntervals(list, ScalarNormalization());
}

VisibleScalars VisibleThrough(const std::vector<std::pair<double, double>>& points)
{
  VisibleScalars visible;
  visible.AddAttenuation(Function(points));
  return visible;
}

/**
 * A jittered block whose scalar varies as a wave between -1 and 1, so that few cells show a narrow
 * peak.
 */
struct Block
{
  MeshArrays Arrays = KuhnGrid(10);
  TetrahedralMesh Mesh;
  std::vector<float> Scalars;

  Block()
  {
    Jitter(this->Arrays, 0.02, 11);
    this->Mesh.Build(this->Arrays.View());
    for (const std::int64_t point : this->Mesh.GetSourcePoints())
    {
      const glm::dvec3 p = this->Arrays.PointAt(point);
      this->Scalars.push_back(
        static_cast<float>(std::sin(5.0 * p.x) * std::cos(4.0 * p.y) * std::sin(3.0 * p.z + 0.5)));
    }
  }
};

/** Number of flagged cells of each face, by the face's vertices. */
std::map<std::array<std::int32_t, 3>, int> CountFaces(
  const TetrahedralMesh& mesh, const std::vector<bool>& active)
{
  std::map<std::array<std::int32_t, 3>, int> faces;
  for (std::size_t c = 0; c < active.size(); ++c)
  {
    const auto& v = mesh.GetCells()[c].Vertices;
    for (int skip = 0; active[c] && skip < 4; ++skip)
    {
      ++faces[{ v[skip == 0 ? 1 : 0], v[skip <= 1 ? 2 : 1], v[skip == 3 ? 2 : 3] }];
    }
  }
  return faces;
}

/** Expects links and boundary to be those of the flagged cells. */
void ExpectActive(const TetrahedralMesh& mesh, const std::vector<bool>& active)
{
  EXPECT_EQ(mesh.GetNumberOfActiveCells(), std::count(active.begin(), active.end(), true));
  const auto faces = CountFaces(mesh, active);
  std::size_t boundary = 0;
  for (const auto& face : faces)
  {
    boundary += face.second == 1;
  }
  EXPECT_EQ(mesh.GetBoundary().size(), boundary);
  std::int32_t previous = -1;
  for (const BoundaryFace& face : mesh.GetBoundary())
  {
    EXPECT_TRUE(active[face.CellFace / 4]);
    auto vertices = face.Vertices;
    std::sort(vertices.begin(), vertices.end());
    EXPECT_EQ(faces.at(vertices), 1);
    EXPECT_GT(face.CellFace, previous);
    previous = face.CellFace;
  }
  for (const TetrahedralMesh::Cell& cell : mesh.GetCells())
  {
    for (const std::int32_t link : cell.Links)
    {
      const std::int32_t to = link < -1 ? TetrahedralMesh::MarkedLink(link) : link;
      EXPECT_TRUE(link == TetrahedralMesh::NoNeighbor || active[to / 4] == (link >= 0));
    }
  }
}

Picture CastAll(const Block& block, const std::vector<TransferFunctionInterval>& intervals)
{
  const PictureScene scene{ block.Mesh, block.Scalars, intervals,
    FrameAlongZ(block.Mesh, 0.6, 64) };
  return CastPicture(scene, 64, BestInstructionSet());
}

}

TEST(VisibleScalars, RangesOfAPeak)
{
  const VisibleScalars visible = VisibleThrough({ { 0.2, 0.0 }, { 0.3, 1.0 }, { 0.4, 0.0 } });
  EXPECT_TRUE(visible.Meets(0.0f, 1.0f)); // the peak lies within the cell's range
  EXPECT_TRUE(visible.Meets(0.35f, 0.35f));
  EXPECT_TRUE(visible.Meets(0.39f, 0.9f));
  EXPECT_FALSE(visible.Meets(0.4f, 0.9f)); // only touches
  EXPECT_FALSE(visible.Meets(-1.0f, 0.2f));
  EXPECT_FALSE(visible.Meets(0.2f, 0.2f));
  EXPECT_FALSE(visible.Meets(0.4f, 0.4f)); // although float arithmetic may not reach exactly 0
  EXPECT_FALSE(visible.Meets(Nan, Nan));
}

TEST(VisibleScalars, JumpsAtCellValues)
{
  const VisibleScalars visible =
    VisibleThrough({ { 0.25, 0.0 }, { 0.25, 1.0 }, { 0.5, 1.0 }, { 0.5, 0.0 } });
  // A cell of one scalar may count for either side of a jump; a cell that only touches has no
  // length.
  EXPECT_TRUE(visible.Meets(0.25f, 0.25f));
  EXPECT_TRUE(visible.Meets(0.5f, 0.5f));
  EXPECT_FALSE(visible.Meets(0.0f, 0.25f));
  EXPECT_FALSE(visible.Meets(0.5f, 0.75f));
  EXPECT_TRUE(visible.Meets(0.0f, 0.2500001f));
  EXPECT_TRUE(visible.Meets(0.4999999f, 0.75f));
  EXPECT_FALSE(visible.Meets(0.6f, 0.6f));
}

TEST(VisibleScalars, ConstantOutsideOfThePoints)
{
  const VisibleScalars visible = VisibleThrough({ { -0.5, 0.3 }, { 0.0, 0.0 }, { 0.5, 0.3 } });
  EXPECT_TRUE(visible.Meets(-1.0f, -1.0f));
  EXPECT_TRUE(visible.Meets(1.0f, 1.0f));
  EXPECT_FALSE(visible.Meets(0.0f, 0.0f));
  EXPECT_TRUE(visible.Meets(0.0f, 0.1f));
}

TEST(VisibleScalars, NothingAllAndIsovalues)
{
  EXPECT_FALSE(VisibleScalars().Meets(-1.0f, 1.0f));
  EXPECT_FALSE(VisibleThrough({}).Meets(-1.0f, 1.0f));
  EXPECT_FALSE(VisibleThrough({ { 0.0, 0.0 }, { 1.0, 0.0 } }).Meets(-1.0f, 1.0f));
  EXPECT_TRUE(VisibleScalars::All().Meets(0.7f, 0.7f));
  EXPECT_FALSE(VisibleScalars::All().Meets(Nan, Nan));

  VisibleScalars visible = VisibleThrough({ { 0.2, 0.0 }, { 0.3, 1.0 }, { 0.4, 0.0 } });
  for (const float value : { 0.8f, 0.3f, -0.5f, 0.2f })
  {
    visible.AddIsovalue(value);
  }
  EXPECT_TRUE(visible.Meets(0.5f, 0.8f));
  EXPECT_TRUE(visible.Meets(0.8f, 0.8f));
  EXPECT_TRUE(visible.Meets(-0.6f, -0.4f));
  EXPECT_TRUE(visible.Meets(0.0f, 0.2f)); // 0.2 is an isovalue now
  EXPECT_FALSE(visible.Meets(0.4f, 0.79f));
  EXPECT_FALSE(visible.Meets(-0.4f, 0.1f));
  EXPECT_TRUE(visible.Meets(0.25f, 0.26f));
}

TEST(VisibleScalars, AgreesWithSamplingOfManyFunctions)
{
  std::srand(5);
  const auto random = [] { return std::rand() % 21 / 10.0 - 1.0; };
  for (int trial = 0; trial < 300; ++trial)
  {
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < 1 + trial % 7; ++i)
    {
      points.emplace_back(random(), std::max(0.0, random()));
    }
    std::sort(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto intervals = Function(points);
    VisibleScalars visible;
    visible.AddAttenuation(intervals);
    for (int cell = 0; cell < 20; ++cell)
    {
      const double a = random();
      const double b = random();
      if (a == b)
      {
        continue;
      }
      bool seen = false;
      for (int k = 1; k < 400; ++k)
      {
        const auto s = static_cast<float>(a + (b - a) * k / 400.0);
        const auto i = std::find_if(intervals.begin(), intervals.end(),
          [s](const TransferFunctionInterval& interval) { return s <= interval.Upper; });
        seen = seen || i->Attenuation + (s - i->Lower) * i->AttenuationSlope > 1e-6f;
      }
      EXPECT_EQ(
        visible.Meets(static_cast<float>(std::min(a, b)), static_cast<float>(std::max(a, b))), seen)
        << "trial " << trial << " cell " << cell;
    }
  }
}

TEST(VisibleRanks, AgreeWithTheRanges)
{
  std::srand(7);
  const auto random = [] { return std::rand() % 21 / 10.0f - 1.0f; };
  for (int trial = 0; trial < 300; ++trial)
  {
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < trial % 7; ++i)
    {
      points.emplace_back(random(), std::max(0.0f, random()));
    }
    std::sort(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    VisibleScalars visible = trial % 5 == 0 ? VisibleScalars::All() : VisibleThrough(points);
    for (int i = 0; i < trial % 3; ++i)
    {
      visible.AddIsovalue(random());
    }
    const VisibleRanks ranks(visible);
    std::vector<float> scalars{ -std::numeric_limits<float>::infinity(), -1.0f, 1.0f,
      std::numeric_limits<float>::infinity() };
    for (int i = 0; i < 40; ++i)
    {
      scalars.push_back(i % 2 == 0 ? random() : random() + 0.05f);
    }
    bool all = true;
    for (const float a : scalars)
    {
      for (const float b : scalars)
      {
        const float lowest = std::min(a, b);
        const float highest = std::max(a, b);
        const bool seen = visible.Meets(lowest, highest);
        ASSERT_EQ(ranks.Meets(ranks.RankOf(lowest), ranks.RankOf(highest)), seen)
          << "trial " << trial << ": " << lowest << ", " << highest;
        all = all && seen;
      }
    }
    // Between the least and the greatest scalar there may be others that cannot be seen.
    EXPECT_LE(ranks.MeetsAll(scalars, SerialLoop), all) << trial;
    EXPECT_TRUE(trial % 5 != 0 || ranks.MeetsAll({ -1.0f, 1.0f }, SerialLoop)) << trial;
    EXPECT_FALSE(ranks.MeetsAll({ -1.0f, Nan, 1.0f }, SerialLoop)) << trial;
  }
  EXPECT_EQ(VisibleRanks(VisibleScalars()).RankOf(Nan), VisibleRanks::Unknown);
}

TEST(ActiveCells, CellsThatAreAllSeenStaySo)
{
  Block block;
  const VisibleScalars constant = VisibleThrough({ { 0.0, 1.0 } });
  EXPECT_FALSE(block.Mesh.UpdateActiveCells(block.Scalars, constant));
  // Another step, with a scalar that is not known, and one without.
  block.Scalars[100] = Nan;
  EXPECT_TRUE(block.Mesh.UpdateActiveCells(block.Scalars, constant));
  EXPECT_GT(block.Mesh.GetNumberOfUnknownCells(), 0);
  block.Scalars[100] = 0.5f;
  EXPECT_TRUE(block.Mesh.UpdateActiveCells(block.Scalars, constant));
  EXPECT_FALSE(block.Mesh.UpdateActiveCells(block.Scalars, constant));
  EXPECT_EQ(block.Mesh.GetNumberOfUnknownCells(), 0);
  ExpectActive(
    block.Mesh, std::vector<bool>(static_cast<std::size_t>(block.Mesh.GetNumberOfCells()), true));
}

TEST(ActiveCells, LinksAndBoundaryAreThoseOfTheVisibleCells)
{
  Block block;
  const TetrahedralMesh built = block.Mesh;
  block.Scalars[100] = Nan;
  const VisibleScalars visible = VisibleThrough({ { 0.2, 0.0 }, { 0.3, 1.0 }, { 0.4, 0.0 } });
  std::vector<bool> active;
  for (const auto& cell : block.Mesh.GetCells())
  {
    std::array<float, 4> s{};
    std::transform(cell.Vertices.begin(), cell.Vertices.end(), s.begin(),
      [&block](std::int32_t v) { return block.Scalars[v]; });
    const bool known = std::none_of(s.begin(), s.end(), [](float x) { return std::isnan(x); });
    active.push_back(known && *std::min_element(s.begin(), s.end()) < 0.4f &&
      *std::max_element(s.begin(), s.end()) > 0.2f);
  }
  EXPECT_TRUE(block.Mesh.UpdateActiveCells(block.Scalars, visible));
  ExpectActive(block.Mesh, active);
  EXPECT_LT(block.Mesh.GetNumberOfActiveCells(), block.Mesh.GetNumberOfCells() / 2);
  EXPECT_FALSE(block.Mesh.UpdateActiveCells(block.Scalars, visible)); // the same again

  // There and back: the mesh is as it was when built.
  block.Scalars[100] = 0.0f;
  EXPECT_TRUE(block.Mesh.UpdateActiveCells(block.Scalars, VisibleScalars()));
  EXPECT_EQ(block.Mesh.GetNumberOfActiveCells(), 0);
  EXPECT_TRUE(block.Mesh.GetBoundary().empty());
  EXPECT_TRUE(block.Mesh.UpdateActiveCells(block.Scalars, VisibleScalars::All()));
  ExpectActive(block.Mesh, std::vector<bool>(active.size(), true));
  for (std::size_t c = 0; c < active.size(); ++c)
  {
    EXPECT_EQ(block.Mesh.GetCells()[c].Links, built.GetCells()[c].Links);
  }
  ASSERT_EQ(block.Mesh.GetBoundary().size(), built.GetBoundary().size());
  for (std::size_t f = 0; f < built.GetBoundary().size(); ++f)
  {
    EXPECT_EQ(block.Mesh.GetBoundary()[f].CellFace, built.GetBoundary()[f].CellFace);
    EXPECT_EQ(block.Mesh.GetBoundary()[f].Vertices, built.GetBoundary()[f].Vertices);
  }
}

TEST(ActiveCells, SparsePictureIsTheDenseOneInFewerSteps)
{
  const auto function = Function({ { 0.5, 0.0 }, { 0.55, 30.0 }, { 0.6, 0.0 } });
  Block block;
  const auto dense = CastAll(block, function);
  VisibleScalars visible;
  visible.AddAttenuation(function);
  block.Mesh.UpdateActiveCells(block.Scalars, visible);
  const auto sparse = CastAll(block, function);
  EXPECT_EQ(dense.Statistics.Lost + sparse.Statistics.Lost, 0);
  double largest = 0.0;
  for (std::size_t i = 0; i < dense.Rgba.size(); ++i)
  {
    largest = std::max(largest, std::abs(double(dense.Rgba[i]) - sparse.Rgba[i]));
  }
  // Where a walk begins again, depth and scalar are interpolated in another order: 2^-22 each, of
  // which the function's slope of 600 per unit of scalar makes 1.4e-4 in optical density.
  EXPECT_LT(largest, 2e-5);
  EXPECT_LT(sparse.Statistics.Steps, dense.Statistics.Steps / 3);
  EXPECT_GT(sparse.Statistics.Steps, 0);
}

TEST(ActiveCells, DoNotDependOnTheLoop)
{
  MeshArrays arrays = KuhnGrid(20); // several blocks
  TetrahedralMesh serial;
  serial.Build(arrays.View());
  TetrahedralMesh parallel = serial;
  std::vector<float> scalars;
  for (const std::int64_t point : serial.GetSourcePoints())
  {
    scalars.push_back(static_cast<float>(std::sin(9.0 * arrays.PointAt(point).x)));
  }
  const RangeLoop backwards = [](std::size_t count, const RangeBody& body)
  {
    for (std::size_t i = count; i > 0; --i)
    {
      std::thread(body, i - 1, i).join();
    }
  };
  const VisibleScalars visible = VisibleThrough({ { 0.5, 0.0 }, { 0.55, 30.0 }, { 0.6, 0.0 } });
  serial.UpdateActiveCells(scalars, visible);
  parallel.UpdateActiveCells(scalars, visible, backwards);
  EXPECT_EQ(serial.GetNumberOfActiveCells(), parallel.GetNumberOfActiveCells());
  ASSERT_EQ(serial.GetBoundary().size(), parallel.GetBoundary().size());
  for (std::size_t f = 0; f < serial.GetBoundary().size(); ++f)
  {
    EXPECT_EQ(serial.GetBoundary()[f].CellFace, parallel.GetBoundary()[f].CellFace);
    EXPECT_EQ(serial.GetBoundary()[f].Vertices, parallel.GetBoundary()[f].Vertices);
  }
}

TEST(ActiveCells, ScalarsOfCells)
{
  Block block;
  std::vector<float> values;
  for (std::int64_t c = 0; c < block.Mesh.GetNumberOfCells(); ++c)
  {
    values.push_back(c % 11 == 0 ? Nan : std::sin(0.37f * static_cast<float>(c)));
  }
  const VisibleScalars visible = VisibleThrough({ { 0.2, 0.0 }, { 0.3, 1.0 }, { 0.4, 0.0 } });
  std::vector<bool> active;
  for (const float value : values)
  {
    active.push_back(value > 0.2f && value < 0.4f);
  }
  EXPECT_TRUE(block.Mesh.UpdateActiveCells(values, TetrahedralMesh::CellJumps::Hidden, visible));
  ExpectActive(block.Mesh, active);
  EXPECT_EQ(block.Mesh.GetNumberOfUnknownCells(),
    std::count_if(values.begin(), values.end(), [](float v) { return std::isnan(v); }));

  // A value between those of two cells is seen on their common face: both cells are active.
  VisibleScalars isovalue;
  isovalue.AddIsovalue(0.25f);
  const auto below = [&values](std::int64_t c) { return values[c] < 0.25f; };
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    active[c] = false;
    for (const std::int32_t marked : block.Mesh.GetCells()[c].Links)
    {
      const std::int32_t link =
        marked < TetrahedralMesh::NoNeighbor ? TetrahedralMesh::MarkedLink(marked) : marked;
      active[c] = active[c] ||
        (link != TetrahedralMesh::NoNeighbor && !std::isnan(values[c]) &&
          !std::isnan(values[link / 4]) && below(static_cast<std::int64_t>(c)) != below(link / 4));
    }
  }
  block.Mesh.UpdateActiveCells(values, TetrahedralMesh::CellJumps::Visible, isovalue);
  ExpectActive(block.Mesh, active);
}

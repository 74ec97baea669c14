// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Division of curved cells: the pieces fill the cells without cracks, linear interpolation in them
// is as accurate as wanted, and no more pieces are made than that takes.
#include "DivisionBlock.h"
#include "TestBasics.h"
#include "Volume/Division/CellDivision.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Mesh/Tetrahedralizer.h"

#include <thread>

using namespace meniscus::test;
using namespace meniscus;

namespace
{

/** Positions of all points, those of the input and the new ones. */
std::vector<double> PositionsOf(const CellDivision& division, const PointFields& fields)
{
  std::vector<double> positions;
  for (std::int64_t p = 0; p < fields.NumberOfPoints + division.GetPoints().GetSize(); ++p)
  {
    const glm::dvec3 at = division.GetPoints().Interpolate(
      p, [&fields](std::int32_t q) { return fields.Points[static_cast<std::size_t>(q)]; });
    positions.insert(positions.end(), { at.x, at.y, at.z });
  }
  return positions;
}

glm::dvec3 PositionAt(const std::vector<double>& positions, std::int32_t point)
{
  const double* at = positions.data() + 3 * static_cast<std::size_t>(point);
  return { at[0], at[1], at[2] };
}

/** Number of boundary faces of the pieces that do not lie in one side of the unit cube. */
int CountCracks(const CellDivision& division, const PointFields& fields, double& volume)
{
  const std::vector<double> positions = PositionsOf(division, fields);
  std::vector<std::int32_t> cells;
  volume = 0.0;
  for (const CellPiece& piece : division.GetPieces())
  {
    cells.insert(cells.end(), piece.Points.begin(), piece.Points.end());
    const glm::dvec3 origin = PositionAt(positions, piece.Points[0]);
    const glm::dmat3 span(PositionAt(positions, piece.Points[1]) - origin,
      PositionAt(positions, piece.Points[2]) - origin,
      PositionAt(positions, piece.Points[3]) - origin);
    const glm::dmat3 inside(glm::dvec3(piece.Places[1] - piece.Places[0]),
      glm::dvec3(piece.Places[2] - piece.Places[0]), glm::dvec3(piece.Places[3] - piece.Places[0]));
    volume += glm::determinant(span) * (glm::determinant(inside) < 0.0 ? -1.0 : 1.0) / 6.0;
  }
  TetrahedraView view;
  view.Points = positions.data();
  view.NumberOfPoints = static_cast<std::int64_t>(positions.size() / 3);
  view.ShortCells = cells.data();
  view.NumberOfCells = static_cast<std::int64_t>(cells.size() / 4);
  TetrahedralMesh mesh;
  EXPECT_EQ(mesh.Build(view), MeshStatus::Ok);
  EXPECT_EQ(mesh.GetRejectedCells().Total(), 0);
  int cracks = 0;
  for (const BoundaryFace& face : mesh.GetBoundary())
  {
    bool onSide = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double side : { 0.0, 1.0 })
      {
        onSide = onSide ||
          std::all_of(face.Vertices.begin(), face.Vertices.end(),
            [&](std::int32_t v)
            {
              const std::int32_t point = mesh.GetSourcePoints()[static_cast<std::size_t>(v)];
              return std::abs(PositionAt(positions, point)[axis] - side) < 1e-12;
            });
      }
    }
    cracks += !onSide;
  }
  return cracks;
}

/** Largest difference of the value from the trilinear one, at random places in the pieces. */
double LargestError(const CellDivision& division, const Block& block)
{
  std::mt19937 random(5);
  std::exponential_distribution<double> share;
  CellSampler sampler(block.Fields, block.GetFunctions());
  double largest = 0.0;
  for (const CellPiece& piece : division.GetPieces())
  {
    for (int sample = 0; sample < 4; ++sample)
    {
      std::array<double, 4> weights{};
      double sum = 0.0;
      for (double& weight : weights)
      {
        sum += weight = share(random);
      }
      glm::dvec3 place(0.0);
      double drawn = 0.0;
      for (std::size_t i = 0; i < 4; ++i)
      {
        place += weights[i] / sum * glm::dvec3(piece.Places[i]);
        drawn += weights[i] / sum *
          division.GetPoints().Interpolate(piece.Points[i],
            [&block](std::int32_t p)
            { return block.Fields.Values[0][static_cast<std::size_t>(p)]; });
      }
      largest = std::max(largest, std::abs(drawn - sampler.Sample(piece.Cell, place).Values[0]));
    }
  }
  return largest;
}

double Waves(const glm::dvec3& at)
{
  return std::sin(3.0 * at.x) * std::cos(2.0 * at.y) * std::sin(2.0 * at.z + 0.5);
}

/** One tetrahedron with a further point, whose value is added with a weight of its own. */
class Bubble : public ShapeFunctions
{
public:
  using Weight = double (*)(const std::array<double, 4>&);

  explicit Bubble(Weight weight)
    : Added(weight)
  {
  }
  void Weigh(std::int32_t, const glm::dvec3& place, PointWeights& row) override
  {
    const std::array<double, 4> l{ 1.0 - place.x - place.y - place.z, place.x, place.y, place.z };
    for (std::size_t i = 0; i < 4; ++i)
    {
      row.Add(static_cast<std::int32_t>(i), l[i]);
    }
    row.Add(4, this->Added(l));
  }

private:
  Weight Added;
};

/** Divides a tetrahedron with linear shape and the value of a bubble. Returns the counts. */
DivisionCounts DivideBubble(Bubble::Weight weight, std::uint8_t degree)
{
  // The further point adds to the value only.
  const std::vector<double> points{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 };
  PointFields fields;
  fields.Points = points.data();
  fields.NumberOfPoints = 5;
  fields.Values = { { 0.0, 0.0, 0.0, 0.0, 1.0 } };
  CellPiece piece;
  piece.Points = { 0, 1, 2, 3 };
  piece.Places = { Corners[0], Corners[1], Corners[3], Corners[4] };
  piece.Degree = degree;
  CellDivision division;
  EXPECT_EQ(division.Divide(
              { piece }, fields, [weight]() { return std::make_unique<Bubble>(weight); },
              LimitsOf(0.1, 0.05), SerialLoop, GoOn),
    DivisionStatus::Ok);
  return division.GetCounts();
}

}

TEST(CellDivision, NeighboursDoNotCrack)
{
  for (const unsigned int seed : { 1U, 2U, 3U })
  {
    Block block(3, 0.3, seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0.0, 1.0);
    block.SetValues([&](const glm::dvec3&) { return value(random); });
    CellDivision division;
    ASSERT_EQ(block.Divide(division, LimitsOf(5e-3, 0.05)), DivisionStatus::Ok);
    EXPECT_GT(division.GetCounts().Pieces, 5 * 6 * 27);
    EXPECT_EQ(division.GetCounts().UnresolvedEdges, 0);
    EXPECT_EQ(division.GetCounts().FoldedCells, 0);
    double volume = 0.0;
    EXPECT_EQ(CountCracks(division, block.Fields, volume), 0);
    // The sides are plane: the pieces' volumes add up to that of the cube.
    EXPECT_NEAR(volume, 1.0, 1e-12);
  }
}

TEST(CellDivision, TheErrorFollowsTheTolerance)
{
  Block block(3, 0.0, 7);
  block.SetValues(Waves);
  for (const double tolerance : { 3e-2, 1e-2, 3e-3 })
  {
    CellDivision division;
    ASSERT_EQ(block.Divide(division, LimitsOf(1.0, tolerance)), DivisionStatus::Ok);
    const double error = LargestError(division, block);
    // A quadratic function differs from its interpolation by at most 3/2 of the largest difference
    // in an edge (sum of 4 li lj over six edges); the cubic part is small in a small piece.
    EXPECT_LE(error, 1.6 * tolerance);
    // The bound is used: differences are quartered, so that they are between 1/4 and 1 of it.
    EXPECT_GE(error, 0.2 * tolerance);
  }
}

/** Largest distance from the surface x y = value of the points where edges of pieces meet it. */
double LargestDisplacement(const CellDivision& division, const PointFields& fields, double value)
{
  const std::vector<double> positions = PositionsOf(division, fields);
  double most = 0.0;
  for (const CellPiece& piece : division.GetPieces())
  {
    for (std::size_t edge = 0; edge < 12; ++edge)
    {
      const glm::dvec3 from = PositionAt(positions, piece.Points[edge / 3]);
      const glm::dvec3 to = PositionAt(positions, piece.Points[(edge / 3 + 1 + edge % 3) % 4]);
      const double above = from.x * from.y - value;
      const double below = value - to.x * to.y;
      if (above > 0.0 && below > 0.0)
      {
        const glm::dvec3 drawn = from + above / (above + below) * (to - from);
        most = std::max(most, std::fabs(drawn.x * drawn.y - value) / std::hypot(drawn.x, drawn.y));
      }
    }
  }
  return most;
}

// No place where edges are measured needs to be between the surface and its drawn image.
TEST(CellDivision, IsosurfacesAreWhereTheToleranceSays)
{
  Block block(1, 0.0, 5);
  block.SetValues([](const glm::dvec3& at) { return at.x * at.y; });
  for (const auto& [tolerance, value] : Product(List(1e-2, 3e-3, 1e-3), List(0.13, 0.3, 0.62)))
  {
    DivisionLimits limits = LimitsOf(tolerance, 1.0);
    limits.Measure.OfValues.fill(ErrorScale({ { value, 0.0 }, { value, 0.0 }, { value, 10.0 } }));
    limits.Measure.ValuesMayMove = true;
    limits.Measure.HasSurfaces = true;
    CellDivision division;
    ASSERT_EQ(block.Divide(division, limits), DivisionStatus::Ok);
    // The error of an edge is largest in its middle, which is measured, and the surface is not
    // farther away than along the edge. Its slope at the drawn point is that of the value there
    // to the first order; the rest is less than a tenth.
    EXPECT_LE(LargestDisplacement(division, block.Fields, value), 1.1 * tolerance) << value;
    EXPECT_LT(division.GetCounts().Pieces, 50.0 / tolerance) << value;
  }
}

TEST(CellDivision, LinearFieldsAreNotDivided)
{
  Block block(4, 0.0, 3);
  block.SetValues([](const glm::dvec3& at) { return 1.0 + at.x - 2.0 * at.y + 0.5 * at.z; });
  CellDivision division;
  ASSERT_EQ(block.Divide(division, LimitsOf(1e-9, 1e-9)), DivisionStatus::Ok);
  EXPECT_EQ(division.GetCounts().Pieces, 6 * 64);
  EXPECT_TRUE(division.GetPoints().IsEmpty());
}

TEST(CellDivision, FunctionsThatVanishOnEdgesAreSeen)
{
  // Each has its largest value, 1 or so, where no edge of the tetrahedron passes.
  const auto ofCell = [](const std::array<double, 4>& l)
  { return 256.0 * l[0] * l[1] * l[2] * l[3]; };
  const auto ofFace = [](const std::array<double, 4>& l) { return 27.0 * l[0] * l[1] * l[2]; };
  EXPECT_GT(DivideBubble(ofCell, 4).Pieces, 8);
  EXPECT_GT(DivideBubble(ofFace, 3).Pieces, 8);
  // An odd function of an edge vanishes in its middle.
  const auto odd = [](const std::array<double, 4>& l) { return l[0] * l[1] * (l[0] - l[1]); };
  EXPECT_GT(DivideBubble(odd, 3).Pieces, 1);
  // A function that vanishes at 1/4, 1/2 and 3/4 of the edge.
  const auto wave = [](const std::array<double, 4>& l)
  { return 40.0 * l[0] * l[1] * (l[1] - 0.25) * (l[1] - 0.5) * (l[1] - 0.75); };
  EXPECT_GT(DivideBubble(wave, 5).Pieces, 1);
}

TEST(CellDivision, TheResultDoesNotDependOnThreads)
{
  Block block(4, 0.3, 11);
  block.SetValues(Waves);
  CellDivision serial;
  ASSERT_EQ(block.Divide(serial, LimitsOf(3e-3, 2e-3)), DivisionStatus::Ok);
  const RangeLoop threads = [](std::size_t count, const RangeBody& body)
  {
    std::vector<std::thread> all;
    for (std::size_t i = count; i-- > 0;)
    {
      all.emplace_back([&body, i]() { body(i, i + 1); });
    }
    for (std::thread& one : all)
    {
      one.join();
    }
  };
  CellDivision threaded;
  ASSERT_EQ(block.Divide(threaded, LimitsOf(3e-3, 2e-3), threads), DivisionStatus::Ok);
  ASSERT_GT(serial.GetCounts().Pieces, 2 * 8192);
  ASSERT_EQ(serial.GetPieces().size(), threaded.GetPieces().size());
  for (std::size_t p = 0; p < serial.GetPieces().size(); ++p)
  {
    ASSERT_EQ(serial.GetPieces()[p].Points, threaded.GetPieces()[p].Points);
  }
  EXPECT_EQ(PositionsOf(serial, block.Fields), PositionsOf(threaded, block.Fields));
}

TEST(CellDivision, LimitsAreKeptAndReported)
{
  Block block(2, 0.2, 13);
  block.SetValues(Waves);
  DivisionLimits limits = LimitsOf(1e-5, 1e-5);
  limits.MostLevels = 1;
  CellDivision division;
  ASSERT_EQ(block.Divide(division, limits), DivisionStatus::Ok);
  EXPECT_GT(division.GetCounts().UnresolvedEdges, 0);
  EXPECT_LE(division.GetCounts().Pieces, 8 * 6 * 8);
  EXPECT_EQ(division.Divide(block.GetPieces(), block.Fields, block.GetFunctions(),
              LimitsOf(1e-5, 1e-5), SerialLoop, [](double) { return false; }),
    DivisionStatus::Aborted);
}

TEST(CellDivision, TheBudgetIsSpentOnTheLargestErrors)
{
  // Waves of the first value, whose errors differ between cells by orders of magnitude.
  Block block(4, 0.1, 29);
  block.SetValues([](const glm::dvec3& at) { return std::exp(6.0 * (at.x + at.y * at.z)); });
  double last = std::numeric_limits<double>::infinity();
  for (const std::int64_t budget : { 400, 1000, 4000, 16000 })
  {
    DivisionLimits limits = LimitsOf(1.0, 1.0);
    limits.MostPieces = budget;
    CellDivision division;
    ASSERT_EQ(block.Divide(division, limits), DivisionStatus::Ok);
    const DivisionCounts& counts = division.GetCounts();
    EXPECT_FALSE(counts.ReachedTolerance);
    EXPECT_LE(counts.Pieces, budget);
    EXPECT_GE(counts.Pieces, 0.6 * static_cast<double>(budget));
    double volume = 0.0;
    EXPECT_EQ(CountCracks(division, block.Fields, volume), 0);
    EXPECT_NEAR(volume, 1.0, 1e-12);
    // The reported error is that of the edges; a cubic function has up to 1.6 times as much inside.
    const double error = LargestError(division, block);
    EXPECT_LE(error, 1.6 * counts.Error) << budget;
    EXPECT_GE(error, 0.2 * counts.Error) << budget;
    EXPECT_LT(counts.Error, last);
    last = counts.Error;
    // A division to that error, without a budget, takes about as many pieces.
    DivisionLimits same = LimitsOf(1.0, counts.Error);
    CellDivision free;
    ASSERT_EQ(block.Divide(free, same), DivisionStatus::Ok);
    EXPECT_TRUE(free.GetCounts().ReachedTolerance);
    std::printf("budget %lld: error %.3g, without a budget %lld pieces\n",
      static_cast<long long>(budget), counts.Error,
      static_cast<long long>(free.GetCounts().Pieces));
    EXPECT_GE(free.GetCounts().Pieces, 0.7 * static_cast<double>(counts.Pieces));
  }
  // Less than there is at first.
  DivisionLimits limits = LimitsOf(1.0, 1.0);
  limits.MostPieces = 10;
  CellDivision division;
  ASSERT_EQ(block.Divide(division, limits), DivisionStatus::Ok);
  EXPECT_EQ(division.GetCounts().Pieces, 6 * 64);
  EXPECT_FALSE(division.GetCounts().ReachedTolerance);
  EXPECT_GT(division.GetCounts().Error, 1.0);
}

TEST(CellDivision, ProgressAscendsAndEachReportMayAbort)
{
  Block block(2, 0.2, 13);
  block.SetValues(Waves);
  const auto divide = [&block](std::size_t most, std::vector<double>& reports)
  {
    CellDivision division;
    const auto progress = [&reports, most](double done)
    {
      reports.push_back(done);
      return reports.size() <= most;
    };
    return division.Divide(block.GetPieces(), block.Fields, block.GetFunctions(),
      LimitsOf(1e-2, 1e-2), SerialLoop, progress);
  };
  std::vector<double> all;
  ASSERT_EQ(divide(1000, all), DivisionStatus::Ok);
  EXPECT_GE(all.size(), 6u);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  EXPECT_GT(all.front(), 0.0);
  EXPECT_LT(all.back(), 1.0);
  for (std::size_t most = 0; most < all.size(); ++most)
  {
    std::vector<double> some;
    EXPECT_EQ(divide(most, some), DivisionStatus::Aborted);
    EXPECT_EQ(some.size(), most + 1);
  }
}

/** Shape functions that count how often they are evaluated. */
class CountedShape : public Trilinear
{
public:
  CountedShape(const std::vector<std::array<std::int64_t, 8>>& cells, std::size_t& count)
    : Trilinear(cells)
    , Count(count)
  {
  }
  void Weigh(std::int32_t cell, const glm::dvec3& place, PointWeights& row) override
  {
    ++this->Count;
    Trilinear::Weigh(cell, place, row);
  }

private:
  std::size_t& Count;
};

// A round measures half a million edges here: reports come within it, not only at its end.
TEST(CellDivision, ProgressAndAbortActWithinTheStepsOfARound)
{
  Block block(24, 0.2, 7);
  block.SetValues([](const glm::dvec3& at) { return std::sin(40.0 * at.x) * at.y * at.z; });
  std::size_t count = 0;
  std::size_t most = 0;
  std::size_t between = 0;
  const auto divide = [&](std::size_t reports)
  {
    count = 0;
    std::size_t last = 0;
    std::size_t reported = 0;
    double done = 0.0;
    CellDivision division;
    DivisionLimits limits = LimitsOf(1.0, 5e-3);
    limits.MostPieces = 300000;
    return division.Divide(
      block.GetPieces(), block.Fields,
      [&block, &count]() { return std::make_unique<CountedShape>(block.Cells, count); }, limits,
      SerialLoop,
      [&](double now)
      {
        EXPECT_GE(now, done);
        EXPECT_LT(now, 1.0);
        done = now;
        between = count - last;
        most = std::max(most, between);
        last = count;
        return ++reported <= reports;
      });
  };
  ASSERT_EQ(divide(100000), DivisionStatus::Ok);
  const std::size_t all = count;
  // An edge is measured at three places.
  EXPECT_LE(most, 3u * 131072u);
  EXPECT_GT(all, 2 * most);
  // The first report of all comes within the first step, and an abort there ends it.
  EXPECT_EQ(divide(0), DivisionStatus::Aborted);
  EXPECT_LE(count, most);
  EXPECT_EQ(count, between);
}

TEST(CellDivision, FoldedCellsAreCounted)
{
  Block block(2, 0.2, 17);
  CellDivision division;
  // A mirror image has all pieces turned alike.
  Block mirrored = block;
  for (std::size_t p = 0; p < mirrored.Points.size(); p += 3)
  {
    mirrored.Points[p] = 1.0 - mirrored.Points[p];
  }
  mirrored.Fields.Points = mirrored.Points.data();
  ASSERT_EQ(mirrored.Divide(division, LimitsOf(1e-3, 1.0)), DivisionStatus::Ok);
  EXPECT_EQ(division.GetCounts().FoldedCells, 0);
  // One corner of the cube is pushed through the opposite corner of its cell.
  Block folded = block;
  for (std::size_t p = 0; p < folded.Points.size(); p += 3)
  {
    double* at = folded.Points.data() + p;
    if (at[0] + at[1] + at[2] == 0.0)
    {
      at[0] = at[1] = at[2] = 0.8;
    }
  }
  folded.Fields.Points = folded.Points.data();
  ASSERT_EQ(folded.Divide(division, LimitsOf(1e-2, 1.0)), DivisionStatus::Ok);
  EXPECT_EQ(division.GetCounts().FoldedCells, 1);
}

TEST(CellDivision, OtherValuesHoldOrDoNot)
{
  Block block(2, 0.2, 19);
  block.SetValues(Waves);
  const DivisionLimits limits = LimitsOf(1e-2, 1e-2);
  CellDivision division;
  ASSERT_EQ(block.Divide(division, limits), DivisionStatus::Ok);
  EXPECT_TRUE(division.Holds(block.Fields, block.GetFunctions(), limits.Measure, 1.0, SerialLoop));
  division.ForgetPieces();
  block.SetValues([](const glm::dvec3& at) { return 3.0 - 0.5 * Waves(at); });
  EXPECT_TRUE(division.Holds(block.Fields, block.GetFunctions(), limits.Measure, 1.0, SerialLoop));
  block.SetValues([](const glm::dvec3& at) { return 10.0 * Waves(at); });
  EXPECT_FALSE(division.Holds(block.Fields, block.GetFunctions(), limits.Measure, 1.0, SerialLoop));
  // Moved points: a stretched mesh holds for the same values, a bent one does not.
  block.SetValues(Waves);
  for (std::size_t p = 0; p < block.Points.size(); p += 3)
  {
    block.Points[p] *= 0.5;
  }
  EXPECT_TRUE(division.Holds(block.Fields, block.GetFunctions(), limits.Measure, 2.0, SerialLoop));
  for (std::size_t p = 0; p < block.Points.size(); p += 3)
  {
    block.Points[p] += 2.0 * block.Points[p + 1] * block.Points[p + 2];
  }
  EXPECT_FALSE(division.Holds(block.Fields, block.GetFunctions(), limits.Measure, 2.0, SerialLoop));
}

TEST(CellDivision, ValuesThatAreNotFiniteAreNotDivided)
{
  Block block(2, 0.0, 23);
  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    block.SetValues([bad](const glm::dvec3&) { return bad; });
    CellDivision division;
    ASSERT_EQ(block.Divide(division, LimitsOf(1e-6, 1e-6)), DivisionStatus::Ok);
    EXPECT_EQ(division.GetCounts().Pieces, 6 * 8);
  }
}

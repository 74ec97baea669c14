// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays that several sub-cells and primitives ask for.
#include "HeightField.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/KnownMeetings.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;

constexpr int Sides = 2; // of the object

struct Asked
{
  KnownMeetings::Key Key;
  KnownMeetings::Meeting Met;
};

/** A half of an edge of a facet, from one of its ends, and the ray from it that meets a line. */
Asked AskFrom(const CurvedMembraneSolver& geometry, std::int32_t facet, std::size_t edge,
  bool isOther, const ObjectLine& line, std::int64_t side)
{
  const glm::dvec2 places[3] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  const CurvedPatch patch = geometry.GetPatches().GetPatch(facet);
  const Membrane::Facet& vertices =
    geometry.GetMembrane().GetFacets()[static_cast<std::size_t>(facet)];
  const std::size_t i = (edge + 1) % 3;
  const std::size_t j = (edge + 2) % 3;
  const bool isFirst = (vertices[i] < vertices[j]) != isOther;
  const glm::dvec2 end = places[isFirst ? i : j];
  const glm::dvec2 middle = 0.5 * (places[i] + places[j]);
  const auto refract = [&geometry, &patch](const glm::dvec2& b)
  { return RefractAt(patch.Evaluate(b), geometry.GetMedia()); };
  const SubCellSide curve(patch, end, middle);
  Asked asked{ KnownMeetings::Key::Make(geometry.GetMembrane(), facet, curve, side, side + 1), {} };
  asked.Met.From =
    MeetLine(curve, geometry.GetMedia(), line, refract(end), refract(middle), asked.Met.Zero);
  return asked;
}

void ExpectSame(const KnownMeetings::Meeting& a, const KnownMeetings::Meeting& b)
{
  EXPECT_EQ(a.From.At.Position, b.From.At.Position);
  EXPECT_EQ(a.From.At.Normal, b.From.At.Normal);
  EXPECT_EQ(a.From.Ray, b.From.Ray);
  EXPECT_EQ(a.Zero, b.Zero);
}

}

//------------------------------------------------------------------------------
// Every edge of a membrane of waves is divided into halves and cut by two lines. The two patches of
// an edge must have the same key and the same ray for a half and a line. Another half or line must
// have another key. KnownMeetings must return the ray that was stored for a key.
TEST(KnownMeetings, BothPatchesOfAnEdgeHaveTheSame)
{
  reference::HeightField field;
  field.Side = 120.0;
  field.Amplitude = 2.0;
  field.K = 0.12;
  CurvedMembraneSolver geometry;
  ASSERT_EQ(geometry.SetMembrane(field.MakeMesh(12).AsInput()), MembraneStatus::Ready);
  ASSERT_EQ(geometry.SetEye(glm::dvec3(60.0, 260.0, -130.0), 1.0, 1.333), EyeStatus::Ready);
  bool isTurned = false;
  const ObjectLine lines[Sides] = { ObjectLine::Order(
                                      { -41.0, -70.0, -35.0 }, { 42.0, -71.0, 30.0 }, isTurned),
    ObjectLine::Order({ -41.0, -70.0, -35.0 }, { -5.0, -60.0, 45.0 }, isTurned) };
  KnownMeetings known;
  int computed = 0;
  int asked = 0;
  const auto get = [&known, &computed](const Asked& one) -> const KnownMeetings::Meeting&
  {
    return known.Get(one.Key,
      [&one, &computed]()
      {
        ++computed;
        return one.Met;
      });
  };
  const auto facets = static_cast<std::int32_t>(geometry.GetMembrane().GetFacets().size());
  for (std::int32_t facet = 0; facet < facets; ++facet)
  {
    for (std::size_t edge = 0; edge < 3; ++edge)
    {
      const std::int32_t next = geometry.GetPatches().GetNeighbour(facet, static_cast<int>(edge));
      if (next == CurvedPatches::NoFacet)
      {
        continue;
      }
      std::size_t back = 0;
      while (geometry.GetPatches().GetNeighbour(next, static_cast<int>(back)) != facet)
      {
        ++back;
      }
      for (int k = 0; k < 2 * Sides; ++k)
      {
        const ObjectLine& line = lines[k / 2];
        const Asked own = AskFrom(geometry, facet, edge, k % 2 == 1, line, k / 2);
        const Asked other = AskFrom(geometry, next, back, k % 2 == 1, line, k / 2);
        EXPECT_TRUE(own.Key == other.Key);
        EXPECT_FALSE(own.Key == AskFrom(geometry, facet, edge, k % 2 == 0, line, k / 2).Key);
        EXPECT_FALSE(own.Key == AskFrom(geometry, facet, edge, k % 2 == 1, line, k / 2 + 7).Key);
        ExpectSame(own.Met, other.Met);
        ExpectSame(get(own), own.Met);
        ExpectSame(get(other), own.Met);
        asked += 2;
      }
    }
  }
  // The second of two patches, at once, finds the ray of the first; later, it may be gone.
  EXPECT_LE(computed, asked / 2);
  EXPECT_GT(computed, 0);
}

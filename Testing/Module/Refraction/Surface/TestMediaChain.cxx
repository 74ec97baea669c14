// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Sides from which rays pass the interfaces of a list, by their indices of refraction.
#include "Refraction/Surface/MediaChain.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;

bool IsPassage(const InterfacePassage& passage, double before, double behind, bool fromFront)
{
  return passage.Before == before && passage.Behind == behind && passage.FromFront == fromFront;
}

}

TEST(MediaChain, PaneCanBePassedFromBothSides)
{
  const MediaChain chain({ { 1.0, 1.5 }, { 1.5, 1.0 } });
  ASSERT_EQ(chain.Fault, MediaFault::None);
  ASSERT_EQ(chain.Ways.size(), 2u);
  EXPECT_TRUE(IsPassage(chain.Ways[0][0], 1.0, 1.5, true));
  EXPECT_TRUE(IsPassage(chain.Ways[0][1], 1.5, 1.0, true));
  EXPECT_TRUE(IsPassage(chain.Ways[1][0], 1.5, 1.0, false));
  EXPECT_TRUE(IsPassage(chain.Ways[1][1], 1.0, 1.5, false));
}

TEST(MediaChain, ClosedBodyIsEnteredAndLeft)
{
  const MediaChain chain({ { 1.0, 1.5 }, { 1.0, 1.5 } });
  ASSERT_EQ(chain.Fault, MediaFault::None);
  EXPECT_TRUE(IsPassage(chain.Ways[0][0], 1.0, 1.5, true));
  EXPECT_TRUE(IsPassage(chain.Ways[0][1], 1.5, 1.0, false));
}

TEST(MediaChain, NormalsTowardsTheGeometryArePassedFromTheBack)
{
  const MediaChain chain({ { 1.5, 1.0 }, { 1.333, 1.5 } });
  ASSERT_EQ(chain.Fault, MediaFault::None);
  ASSERT_EQ(chain.Ways.size(), 1u);
  EXPECT_TRUE(IsPassage(chain.Ways[0][0], 1.0, 1.5, false));
  EXPECT_TRUE(IsPassage(chain.Ways[0][1], 1.5, 1.333, false));
}

TEST(MediaChain, MediaThatDoNotMatchAreFoundWhereTheyAre)
{
  const MediaChain chain({ { 1.0, 1.5 }, { 1.5, 1.333 }, { 1.4, 1.0 } });
  EXPECT_EQ(chain.Fault, MediaFault::NoMatch);
  EXPECT_EQ(chain.FaultAt, 2u);
  EXPECT_TRUE(chain.Ways.empty());
}

TEST(MediaChain, EqualIndicesMustMatchTheirNeighboursToo)
{
  EXPECT_EQ(MediaChain({ { 1.0, 1.333 }, { 1.2, 1.2 } }).Fault, MediaFault::NoMatch);
  EXPECT_EQ(MediaChain({ { 1.0, 1.333 }, { 1.333, 1.333 } }).Fault, MediaFault::None);
}

TEST(MediaChain, IndicesThatAreNotPositiveAndFiniteAreAFault)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : { 0.0, -1.5, std::nan(""), infinite })
  {
    const MediaChain chain({ { 1.0, 1.5 }, { 1.5, bad } });
    EXPECT_EQ(chain.Fault, MediaFault::BadIndex) << bad;
    EXPECT_EQ(chain.FaultAt, 1u) << bad;
  }
}

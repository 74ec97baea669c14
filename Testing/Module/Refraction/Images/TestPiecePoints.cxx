// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Points that several pieces of a primitive have in common.
#include "Refraction/Images/PiecePoints.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;

/** Adds pieces of one primitive. Each point is identified by one of its coordinates. */
class Pieces
{
public:
  Pieces() { this->Points.Start(); }

  void Add(const std::vector<double>& places, bool turned = false, int orientation = 1)
  {
    const auto pointOf = [&places, orientation](std::size_t i)
    {
      ImagePoint point;
      point.Vertex.Position.x = places[i];
      point.Vertex.Orientation = static_cast<signed char>(orientation);
      return point;
    };
    this->Points.AddCell(places.size(), pointOf, turned, 7, orientation, this->Mesh);
  }

  PiecePoints Points;
  ImageMesh Mesh;
};

using Ids = std::vector<std::int64_t>;

}

//------------------------------------------------------------------------------
TEST(PiecePoints, AreSharedByThePiecesOfAPrimitive)
{
  Pieces pieces;
  pieces.Add({ 1.0, 2.0, 3.0 });
  pieces.Add({ 3.0, 2.0, 4.0, 5.0 });
  EXPECT_EQ(pieces.Mesh.Points.size(), 5u);
  EXPECT_EQ(pieces.Mesh.Connectivity, (Ids{ 0, 1, 2, 2, 1, 3, 4 }));
  EXPECT_EQ(pieces.Mesh.Ends, (Ids{ 3, 7 }));
  EXPECT_EQ(pieces.Mesh.SourceCells, (Ids{ 7, 7 }));
  pieces.Points.Start(); // another primitive
  pieces.Add({ 1.0, 2.0, 3.0 });
  EXPECT_EQ(pieces.Mesh.Points.size(), 8u);
}

//------------------------------------------------------------------------------
TEST(PiecePoints, DifferInAnyOfTheirValues)
{
  Pieces pieces;
  pieces.Add({ 1.0, 2.0, 3.0 });
  pieces.Add({ 1.0, 2.0, 3.0 }, true, -1);
  EXPECT_EQ(pieces.Mesh.Points.size(), 6u);
  EXPECT_EQ(pieces.Mesh.Points[3].Vertex.Position.x, 3.0); // turned round
  ImagePoint point = pieces.Mesh.Points[0];
  point.Vertex.SightPoint.y = 1.0;
  EXPECT_EQ(pieces.Points.Add(point, pieces.Mesh.Points), 6);
  point = pieces.Mesh.Points[0];
  point.Source[0] = 5;
  EXPECT_EQ(pieces.Points.Add(point, pieces.Mesh.Points), 7);
  point.Weight = { 0.75, 0.25, 0.0 };
  EXPECT_EQ(pieces.Points.Add(point, pieces.Mesh.Points), 8);
  EXPECT_EQ(pieces.Points.Add(point, pieces.Mesh.Points), 8);
}

//------------------------------------------------------------------------------
// A corner that repeats the one before is left out, and a piece of fewer than three corners, too.
TEST(PiecePoints, HaveNoRepeatedCorners)
{
  Pieces pieces;
  pieces.Add({ 1.0, 1.0, 2.0, 3.0, 3.0, 1.0 });
  EXPECT_EQ(pieces.Mesh.Connectivity, (Ids{ 0, 1, 2 }));
  pieces.Add({ 4.0, 5.0, 4.0 });
  EXPECT_EQ(pieces.Mesh.Connectivity.size(), 3u);
  EXPECT_EQ(pieces.Mesh.GetNumberOfCells(), 1u);
  EXPECT_EQ(pieces.Mesh.Points.size(), 3u);
  pieces.Add({ 6.0, 4.0, 5.0 });
  EXPECT_EQ(pieces.Mesh.Connectivity, (Ids{ 0, 1, 2, 3, 4, 5 }));
  EXPECT_EQ(pieces.Mesh.Points[4].Vertex.Position.x, 4.0);
}

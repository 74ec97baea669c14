// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Division of triangles that are seen through many facets.
#include "ExactStack.h"
#include "HeightField.h"

#include "Refraction/Images/EdgeSubdivision.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;

/** A triangle whose corners have one image each. */
class ImagedTriangle
{
public:
  ImagedTriangle(const CurvedMembraneSolver& geometry, const std::array<glm::dvec3, 3>& corners)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::vector<VirtualVertex> found;
      EXPECT_EQ(geometry.FindImages(corners[k], found), ImageState::Found);
      EXPECT_EQ(found.size(), 1u);
      this->Images[k] = found.front();
      this->Corners[k] = { static_cast<std::int64_t>(k), corners[k], &this->Images[k] };
    }
  }
  const std::array<ImagedPoint, 3>& Get() const { return this->Corners; }

private:
  std::array<VirtualVertex, 3> Images;
  std::array<ImagedPoint, 3> Corners;
};

}

//------------------------------------------------------------------------------
// Sides pass under dozens of facets of steep waves: from the mean of the ends' sight points,
// Newton's method does not reach that of the middle.
TEST(EdgeSubdivision, LargeTrianglesBelowWavesAreDivided)
{
  reference::HeightField field;
  field.Side = 120.0;
  field.Amplitude = 2.0;
  field.K = 0.12;
  CurvedMembraneSolver geometry;
  const reference::MembraneMesh mesh = field.MakeMesh(96);
  ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
  ASSERT_EQ(geometry.SetEye(glm::dvec3(60.0, 260.0, -130.0), 1.0, 1.333), EyeStatus::Ready);
  const double tolerance = 1e-4; // in radians
  const std::array<glm::dvec3, 3> corners = { glm::dvec3(-40.0, -70.0, -35.0),
    glm::dvec3(42.0, -71.0, -30.0), glm::dvec3(-5.0, -60.0, 45.0) };
  const ImagedTriangle triangle(geometry, corners);
  EdgeSubdivision division(geometry, tolerance);
  ImageMesh images;
  ASSERT_TRUE(division.AddTriangle(triangle.Get(), 0, images));
  EXPECT_GT(images.GetNumberOfCells(), 1000u);
  // Each point is the only image of its place in the triangle.
  std::vector<VirtualVertex> found;
  for (const ImagePoint& point : images.Points)
  {
    glm::dvec3 place(0.0);
    for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
    {
      place += point.Weight[k] * corners[static_cast<std::size_t>(point.Source[k])];
    }
    ASSERT_EQ(geometry.FindImages(place, found), ImageState::Found);
    ASSERT_EQ(found.size(), 1u);
    // Newton's error, 1e-9 of a facet of size 2, and the rounding of the weights.
    EXPECT_LT(glm::length(found.front().SightPoint - point.Vertex.SightPoint), 1e-8);
  }
}

//------------------------------------------------------------------------------
// Places between the tested ones: sides of the parts, in quarters, below waves of 42 facets and of
// four facets, the shortest that a curved membrane shows well.
TEST(EdgeSubdivision, PartsAreDrawnWithinTheTolerance)
{
  const double tolerance = 1e-4; // in radians
  const std::array<glm::dvec3, 3> corners = { glm::dvec3(-10.0, -70.0, -5.0),
    glm::dvec3(12.0, -71.0, -10.0), glm::dvec3(-5.0, -60.0, 15.0) };
  const glm::dvec3 eye(60.0, 260.0, -130.0);
  struct Waves
  {
    double Amplitude;
    double K;
    int Cells;
  };
  for (const Waves& waves : { Waves{ 2.0, 0.12, 96 }, Waves{ 0.02, 0.3142, 24 } })
  {
    SCOPED_TRACE(waves.K);
    reference::HeightField field;
    field.Side = 120.0;
    field.Amplitude = waves.Amplitude;
    field.K = waves.K;
    CurvedMembraneSolver geometry;
    const reference::MembraneMesh mesh = field.MakeMesh(waves.Cells);
    ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
    ASSERT_EQ(geometry.SetEye(eye, 1.0, 1.333), EyeStatus::Ready);
    const ImagedTriangle triangle(geometry, corners);
    EdgeSubdivision division(geometry, tolerance);
    ImageMesh images;
    ASSERT_TRUE(division.AddTriangle(triangle.Get(), 0, images));
    EXPECT_GT(images.GetNumberOfCells(), 30u);
    const auto placeOf = [&corners](const ImagePoint& point)
    {
      glm::dvec3 place(0.0);
      for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
      {
        place += point.Weight[k] * corners[static_cast<std::size_t>(point.Source[k])];
      }
      return place;
    };
    std::size_t places = 0;
    std::size_t beyond = 0;
    double largest = 0.0;
    std::vector<VirtualVertex> found;
    for (std::size_t i = 0; i < images.Connectivity.size(); ++i)
    {
      const auto at = [&images](std::size_t k)
      { return images.Points[static_cast<std::size_t>(images.Connectivity[k])]; };
      const ImagePoint a = at(i);
      const ImagePoint b = at(i % 3 == 2 ? i - 2 : i + 1);
      for (const double s : { 0.25, 0.5, 0.75 })
      {
        ASSERT_EQ(
          geometry.FindImages(glm::mix(placeOf(a), placeOf(b), s), found), ImageState::Found);
        const glm::dvec3 drawn =
          glm::normalize(glm::mix(a.Vertex.Position, b.Vertex.Position, s) - eye);
        const double error =
          glm::length(drawn - glm::normalize(found.front().Position - eye)) / tolerance;
        ++places;
        beyond += error > 1.0;
        largest = std::max(largest, error);
      }
    }
    // Between the tested places the image deviates little more than at them, and rarely.
    EXPECT_LE(largest, 1.2);
    EXPECT_LE(static_cast<double>(beyond), 0.02 * static_cast<double>(places));
  }
}

//------------------------------------------------------------------------------
// A tolerance that would need 2^28 parts: the division ends, and tells it.
TEST(EdgeSubdivision, ATriangleHasSoManyNodesAndIsCounted)
{
  reference::HeightField field;
  field.Side = 120.0;
  field.Amplitude = 2.0;
  field.K = 0.12;
  CurvedMembraneSolver geometry;
  const reference::MembraneMesh mesh = field.MakeMesh(24);
  ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
  ASSERT_EQ(geometry.SetEye(glm::dvec3(60.0, 260.0, -130.0), 1.0, 1.333), EyeStatus::Ready);
  const ImagedTriangle triangle(geometry,
    { glm::dvec3(-40.0, -70.0, -35.0), glm::dvec3(42.0, -71.0, -30.0),
      glm::dvec3(-5.0, -60.0, 45.0) });
  for (const double tolerance : { 1e-3, 1e-11 })
  {
    EdgeSubdivision division(geometry, tolerance);
    ImageMesh images;
    ASSERT_TRUE(division.AddTriangle(triangle.Get(), 0, images));
    const bool isCoarse = tolerance < 1e-10;
    EXPECT_EQ(division.GetNumberOfCoarse(), isCoarse ? 1 : 0);
    if (isCoarse)
    {
      EXPECT_EQ(images.Points.size(), EdgeSubdivision::MostNodes);
    }
    else
    {
      EXPECT_LT(images.Points.size(), EdgeSubdivision::MostNodes);
    }
    // The triangles cover the object's triangle once.
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < images.Connectivity.size(); i += 3)
    {
      glm::dvec3 weight[3];
      for (std::size_t k = 0; k < 3; ++k)
      {
        const ImagePoint& point =
          images.Points[static_cast<std::size_t>(images.Connectivity[i + k])];
        weight[k] = glm::dvec3(0.0);
        for (std::size_t j = 0; j < point.GetNumberOfSources(); ++j)
        {
          weight[k][static_cast<glm::length_t>(point.Source[j])] = point.Weight[j];
        }
      }
      area += glm::dot(weight[0], glm::cross(weight[1], weight[2]));
    }
    EXPECT_NEAR(area, 1.0, 1e-9);
  }
}

//------------------------------------------------------------------------------
// Lines over tens of degrees behind one facet of flat water, whose images are S-shaped: the middle
// of the first one is drawn within the tolerance, and other places 23 tolerances away.
TEST(EdgeSubdivision, LongLinesWithTheirMiddleOnTheChordAreDivided)
{
  CurvedMembraneSolver geometry;
  const reference::MembraneMesh mesh = reference::MakePlane(0.0, 400.0, 1);
  ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), MembraneStatus::Ready);
  const double tolerance = 0.005 * std::acos(-1.0) / 180.0;
  struct Line
  {
    double EyeHeight;
    glm::dvec3 From;
    glm::dvec3 To;
  };
  for (const Line& line :
    { Line{ 3.51045, { 6.08263, -0.923688, 14.5194 }, { -5.79082, -1.5743, 6.90097 } },
      Line{ 0.318739, { 1.53724, -0.500132, -0.423643 }, { 1.44683, -0.704454, 0.259526 } } })
  {
    const glm::dvec3 eye(0.0, line.EyeHeight, 0.0);
    ASSERT_EQ(geometry.SetEye(eye, 1.0, 1.333), EyeStatus::Ready);
    const ImagedTriangle ends(geometry, { line.From, line.To, line.From });
    EdgeSubdivision division(geometry, tolerance);
    ImageMesh images;
    ASSERT_TRUE(division.AddLine(ends.Get()[0], ends.Get()[1], 0, images));
    const auto placeOf = [&line](const ImagePoint& point)
    {
      glm::dvec3 place(0.0);
      for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
      {
        place += point.Weight[k] * (point.Source[k] == 1 ? line.To : line.From);
      }
      return place;
    };
    std::vector<VirtualVertex> found;
    for (std::size_t i = 0; i + 1 < images.Connectivity.size(); i += 2)
    {
      const auto at = [&images](std::size_t k)
      { return images.Points[static_cast<std::size_t>(images.Connectivity[k])]; };
      for (int k = 1; k < 16; ++k)
      {
        const double s = k / 16.0;
        ASSERT_EQ(geometry.FindImages(glm::mix(placeOf(at(i)), placeOf(at(i + 1)), s), found),
          ImageState::Found);
        const glm::dvec3 drawn =
          glm::normalize(glm::mix(at(i).Vertex.Position, at(i + 1).Vertex.Position, s) - eye);
        const glm::dvec3 seen = glm::normalize(found.front().Position - eye);
        // Between the tested places the image deviates little more than at them.
        EXPECT_LE(glm::length(drawn - seen), 1.2 * tolerance);
      }
    }
  }
}

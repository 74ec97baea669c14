// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Division of triangles that are seen through many facets.
#include "HeightField.h"

#include "Refraction/Images/EdgeSubdivision.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <vector>

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

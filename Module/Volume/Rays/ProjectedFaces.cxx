// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Rays/ProjectedFaces.h"
#include "Volume/Packet/Data/PacketRays.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

static_assert(
  4.0 * FixedPointRays::RoundingOfRay * 2147483650.0 < ProjectedFaces::Margin, "rounding of rays");

/**
 * More than the rounding of a pixel's number, which is below 1e9, in double arithmetic: a few times
 * 1e9 * 2^-53. The errors of u and v that it is computed from are far below the errors of rays.
 */
constexpr double RoundingOfPixel = 1.0 / 1024.0;

/** u or v of a vertex as an affine function of the pixel. */
glm::dvec3 Coefficients(
  const AffinePixelMap& offset, const AffinePixelMap& slope, int axis, const PacketVertex& vertex)
{
  const double depth = vertex.Place[2];
  return { vertex.Place[axis] - offset.Base[axis] - depth * slope.Base[axis],
    -offset.PerColumn[axis] - depth * slope.PerColumn[axis],
    -offset.PerRow[axis] - depth * slope.PerRow[axis] };
}

/** The affine function u_p v_q - v_p u_q of the pixel, whose second-order terms vanish. */
glm::dvec3 EdgeFunction(
  const glm::dvec3& up, const glm::dvec3& vp, const glm::dvec3& uq, const glm::dvec3& vq)
{
  return { up[0] * vq[0] - vp[0] * uq[0],
    up[0] * vq[1] + up[1] * vq[0] - vp[0] * uq[1] - vp[1] * uq[0],
    up[0] * vq[2] + up[2] * vq[0] - vp[0] * uq[2] - vp[2] * uq[0] };
}

double At(const glm::dvec3& function, const glm::dvec2& pixel)
{
  return function[0] + pixel.x * function[1] + pixel.y * function[2];
}

/**
 * Bound of the change of the doubled area of a face about the ray through one of its vertices, if u
 * and v of each vertex have an error of `error`: the length of a vertex's displacement, sqrt(2)
 * times that, multiplied by the edges, plus the products of two displacements.
 */
double AreaError(const ProjectedFaces::Vertex& p, const ProjectedFaces::Vertex& q,
  const glm::dvec2& pixel, double error)
{
  const glm::dvec2 toP(At(p.U, pixel), At(p.V, pixel));
  const glm::dvec2 toQ(At(q.U, pixel), At(q.V, pixel));
  const double edges = glm::length(toP) + glm::length(toQ) + glm::length(toP - toQ);
  return 1.42 * error * edges + 6.0 * error * error;
}

}

//------------------------------------------------------------------------------
PacketFace EnteredFace(const BoundaryFace& face, const RayFrame& frame)
{
  PacketFace entered{ { face.Vertices[0], face.Vertices[1], face.Vertices[2] }, face.CellFace };
  if (frame.Handedness < 0)
  {
    std::swap(entered.Vertices[0], entered.Vertices[1]);
  }
  return entered;
}

//------------------------------------------------------------------------------
void ProjectedFaces::Set(const std::vector<PacketVertex>& vertices,
  const std::vector<BoundaryFace>& faces, const FixedPointRays& rays)
{
  this->Vertices = &vertices;
  this->Faces = &faces;
  this->Rays = rays;
}

//------------------------------------------------------------------------------
ProjectedFaces::Vertex ProjectedFaces::ProjectVertex(std::int32_t vertex) const
{
  const PacketVertex& seen = this->GetVertex(vertex);
  const AffinePixelMap& offset = this->Rays.GetOffset();
  const AffinePixelMap& slope = this->Rays.GetSlope();
  return { Coefficients(offset, slope, 0, seen), Coefficients(offset, slope, 1, seen),
    FixedPointRays::DepthOf(seen.Place[2]) };
}

//------------------------------------------------------------------------------
ProjectedFaces::Face ProjectedFaces::Project(std::int32_t index) const
{
  const PacketFace entered = this->GetEntered(index);
  Face seen;
  for (int i = 0; i < 3; ++i)
  {
    seen.Vertices[i] = this->ProjectVertex(entered.Vertices[i]);
  }
  for (int i = 0; i < 3; ++i)
  {
    const Vertex& p = seen.Vertices[i];
    const Vertex& q = seen.Vertices[(i + 1) % 3];
    seen.Edges[i] = EdgeFunction(p.U, p.V, q.U, q.V);
  }
  return seen;
}

//------------------------------------------------------------------------------
ProjectedFaces::Footprint ProjectedFaces::BoundPixels(const Face& face, double error) const
{
  Footprint seen = Nowhere();
  const double rounding = 1.42 * (error > 0.0 ? error : FixedPointRays::RoundingOfRay);
  bool facesAway = true;
  const Vertex& first = face.Vertices[0];
  for (int k = 0; k < 3; ++k)
  {
    // Pixel whose ray passes through the vertex: u = v = 0. The determinant of the change of u and
    // v per pixel is 0 in the plane of the eye and has the opposite sign behind it.
    const Vertex& vertex = face.Vertices[k];
    const double side = vertex.U[1] * vertex.V[2] - vertex.U[2] * vertex.V[1];
    const bool together = vertex.U[1] * first.U[1] + vertex.V[1] * first.V[1] > 0.0;
    const double perSide = 1.0 / side;
    const glm::dvec2 pixel = glm::dvec2(vertex.U[2] * vertex.V[0] - vertex.U[0] * vertex.V[2],
                               vertex.U[0] * vertex.V[1] - vertex.U[1] * vertex.V[0]) *
      perSide;
    if (!together || !(std::abs(pixel.x) < 1.0e9) || !(std::abs(pixel.y) < 1.0e9))
    {
      // Near the plane of the eye, the projection of the face is unbounded.
      return { glm::dvec2(-Everywhere), glm::dvec2(Everywhere),
        std::numeric_limits<double>::infinity() };
    }
    seen.Lower = glm::dvec2(std::min(seen.Lower.x, pixel.x), std::min(seen.Lower.y, pixel.y));
    seen.Upper = glm::dvec2(std::max(seen.Upper.x, pixel.x), std::max(seen.Upper.y, pixel.y));
    const double opposite = At(face.Edges[(k + 1) % 3], pixel);
    const auto margin = [&]()
    {
      const Vertex& next = face.Vertices[(k + 1) % 3];
      const Vertex& last = face.Vertices[(k + 2) % 3];
      return Margin + (error > 0.0 ? AreaError(next, last, pixel, error) : 0.0);
    };
    // (u, v) changes per pixel by at least the smaller singular value, which is the determinant
    // over the larger one. Both u and v have errors, which are many pixels next to the eye.
    const double largest =
      std::abs(vertex.U[1]) + std::abs(vertex.U[2]) + std::abs(vertex.V[1]) + std::abs(vertex.V[2]);
    seen.Error = std::max(seen.Error, rounding * largest * std::abs(perSide));
    // Inside a face that faces away, one edge is below a third of its value at the opposite vertex.
    // The margin, which takes three roots, is of no use for faces towards the eye.
    facesAway = facesAway && opposite < 0.0 && opposite < -3.0 * margin();
  }
  if (facesAway)
  {
    return Nowhere();
  }
  seen.Lower -= seen.Error + RoundingOfPixel;
  seen.Upper += seen.Error + RoundingOfPixel;
  return seen;
}

//------------------------------------------------------------------------------
ProjectedFaces::PixelBox ProjectedFaces::PixelsIn(
  const glm::dvec2& lower, const glm::dvec2& upper) const
{
  const int width = this->Rays.GetWidth();
  const int height = this->Rays.GetHeight();
  // The centre of pixel p is at p + 1/2.
  const glm::dvec2 zero = 0.5 * glm::dvec2(width, height) - 0.5;
  // std::ceil() and std::floor() would be calls.
  const auto from = [](double value, int size)
  {
    const double kept = std::clamp(value, 0.0, double(size));
    const auto whole = static_cast<int>(kept);
    return whole + (whole < kept ? 1 : 0);
  };
  const auto to = [](double value, int size)
  {
    const double kept = std::clamp(value, -1.0, size - 1.0);
    const auto whole = static_cast<int>(kept);
    return whole - (whole > kept ? 1 : 0) + 1;
  };
  return { from(lower.x + zero.x, width), to(upper.x + zero.x, width),
    from(lower.y + zero.y, height), to(upper.y + zero.y, height) };
}

//------------------------------------------------------------------------------
double ProjectedFaces::GetNearestDepth(std::int32_t index) const
{
  std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t vertex : this->GetFace(index).Vertices)
  {
    nearest = std::min(nearest, this->GetVertex(vertex).Place[2]);
  }
  return FixedPointRays::DepthOf(nearest);
}

}

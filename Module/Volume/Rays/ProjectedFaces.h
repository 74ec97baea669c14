// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/FixedPointRays.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace meniscus
{

/** A face for packets: its vertices are counter-clockwise about the rays that enter by it. */
PacketFace EnteredFace(const BoundaryFace& face, const RayFrame& frame);

/** Boundary faces projected along the rays of an image. */
class ProjectedFaces
{
public:
  /**
   * @param vertices vertices of the mesh in the grid of the rays; must outlive this object.
   * @param faces boundary by which rays may enter; must outlive this object.
   */
  void Set(const std::vector<PacketVertex>& vertices, const std::vector<BoundaryFace>& faces,
    const FixedPointRays& rays);

  std::size_t GetNumberOfFaces() const { return this->Faces->size(); }
  const FixedPointRays& GetRays() const { return this->Rays; }
  const std::vector<PacketVertex>& GetVertices() const { return *this->Vertices; }
  const PacketVertex& GetVertex(std::int32_t index) const
  {
    return (*this->Vertices)[static_cast<std::size_t>(index)];
  }
  const BoundaryFace& GetFace(std::int32_t index) const
  {
    return (*this->Faces)[static_cast<std::size_t>(index)];
  }

  /** EnteredFace() of a face. */
  PacketFace GetEntered(std::int32_t index) const
  {
    return EnteredFace(this->GetFace(index), this->Rays.GetFrame());
  }

  /** u and v of a vertex as functions of the pixel: constant, per column, per row. */
  struct Vertex
  {
    glm::dvec3 U;
    glm::dvec3 V;
    double Depth;
  };
  /** A face; its vertices are counter-clockwise about the rays that enter by it. */
  struct Face
  {
    Vertex Vertices[3];
    /**
     * Doubled areas that the edges 01, 12, 20 span with a ray, as affine functions of the pixel.
     */
    glm::dvec3 Edges[3];
  };
  Face Project(std::int32_t index) const;

  struct PixelBox
  {
    int Left = 0;
    int Right = 0; // exclusive
    int Bottom = 0;
    int Top = 0; // exclusive

    bool IsEmpty() const { return this->Left >= this->Right || this->Bottom >= this->Top; }
    bool Overlaps(const PixelBox& other) const
    {
      return std::max(this->Left, other.Left) < std::min(this->Right, other.Right) &&
        std::max(this->Bottom, other.Bottom) < std::min(this->Top, other.Top);
    }
    /** Makes this the smallest box around both; an empty box adds nothing. */
    void Add(const PixelBox& other)
    {
      if (this->IsEmpty())
      {
        *this = other;
      }
      else if (!other.IsEmpty())
      {
        *this = { std::min(this->Left, other.Left), std::max(this->Right, other.Right),
          std::min(this->Bottom, other.Bottom), std::max(this->Top, other.Top) };
      }
    }
  };
  /** Pixels in a rectangle about the image's centre, and the error of a vertex; both in pixels. */
  struct Footprint
  {
    glm::dvec2 Lower;
    glm::dvec2 Upper;
    double Error;
  };
  /** The rectangle from -Everywhere to Everywhere holds all pixels. */
  static constexpr double Everywhere = 1.0e30;
  static Footprint Nowhere() { return { glm::dvec2(Everywhere), glm::dvec2(-Everywhere), 0.0 }; }
  /** The pixels of the image with their centres in a rectangle about the image's centre. */
  PixelBox PixelsIn(const glm::dvec2& lower, const glm::dvec2& upper) const;
  PixelBox PixelsIn(const Footprint& seen) const { return this->PixelsIn(seen.Lower, seen.Upper); }
  /**
   * Pixels whose rays may enter by a face; none if the face certainly faces away. They are those of
   * any image of the same view with vertices in the same grid, if its pixels are no larger.
   * @param error error of u and v of a vertex in the caller's arithmetic, in grid units; 0 for rays
   *   of packets, whose error is FixedPointRays::RoundingOfRay.
   */
  Footprint BoundPixels(const Face& face, double error = 0.0) const;

  /** Smallest depth of a face. */
  double GetNearestDepth(std::int32_t index) const;

  /**
   * Bound of the change of an edge's area by rounding to the grid: FixedPointRays::RoundingOfRay in
   * each of four numbers, each multiplied by another of at most 2^31 + 2, plus the much smaller
   * error of double arithmetic.
   */
  static constexpr double Margin = 4398046511104.0; // 2^42

private:
  Vertex ProjectVertex(std::int32_t vertex) const;

  const std::vector<PacketVertex>* Vertices = nullptr;
  const std::vector<BoundaryFace>* Faces = nullptr;
  FixedPointRays Rays;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A ray through a tetrahedral mesh: entries by the boundary tree, cell to cell by edge signs in the
 * ray-aligned projection. The CPU twin of the shaders in Rendering/glsl, decision for decision.
 *
 * A vertex has coordinates (u, v) about the ray, the same function of vertex and ray wherever it is
 * needed, rounded to whole grid units (2^-22 of the mesh's radius). Their cross products are exact
 * in double. A ray through an edge or a vertex counts as displaced by (e, e^2) for an arbitrarily
 * small e, and edges whose ends coincide are ordered by vertex. So every cell that is entered has
 * exactly one face to leave by, every face and side one way to come there, and a walk that begins
 * on the boundary ends on the boundary.
 */
#ifndef meniscus_Volume_RayWalk_h
#define meniscus_Volume_RayWalk_h

#include "Volume/BoundaryTree.h"
#include "Volume/RayFrame.h"
#include "Volume/RayIntegral.h"
#include "Volume/TetrahedralMesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace meniscus
{

/** What rays are cast through; everything must outlive the walks. */
struct RayCastScene
{
  const TetrahedralMesh* Mesh = nullptr;
  const BoundaryTree* Tree = nullptr;
  /** One normalised scalar per mesh vertex; NaN makes its cells transparent. */
  const std::vector<float>* Scalars = nullptr;
  const std::vector<TransferFunctionInterval>* Intervals = nullptr;
  RayFrame Frame;
  /** Rays end when their transmittance is not above it. */
  float TerminationTransmittance = 0.0f;
};

struct RayResult
{
  /** Premultiplied RGBA. */
  glm::vec4 Color{ 0.0f };
  /** Cells crossed. */
  std::int64_t Steps = 0;
  /** Whether a walk did not end on the boundary: never, if arithmetic is IEEE's. */
  bool Lost = false;
};

class RayWalk
{
public:
  explicit RayWalk(const RayCastScene& scene);

  /**
   * Casts the ray of a pixel.
   * @param pixel     from the image's centre to the pixel's centre, in pixels.
   * @param endDepth  where the ray ends, a depth of the frame (RayFrame::DepthAt).
   */
  RayResult Cast(const glm::vec2& pixel, float endDepth);

private:
  /** A vertex about the ray. */
  struct Vertex
  {
    double U;
    double V;
    float Depth;
    float Scalar;
    std::int32_t Id;
  };
  struct Entry
  {
    float Depth;
    std::int32_t Face;

    bool operator<(const Entry& other) const
    {
      return this->Depth != other.Depth ? this->Depth < other.Depth : this->Face < other.Face;
    }
  };
  /** A face that the ray crosses: ascending vertices and twice the areas their edges span. */
  struct Face
  {
    Vertex Corners[3];
    double Areas[3];
    bool TurnsLeft;
    float Depth;
    float Scalar;
  };

  bool SetUpRay(const glm::vec2& pixel);
  Vertex Project(std::int32_t vertex) const;
  static bool TurnsLeft(const Vertex& p, const Vertex& q, double area);
  static double Area(const Vertex& p, const Vertex& q) { return p.U * q.V - p.V * q.U; }
  static void Interpolate(Face& face, float depth, float scalar);
  bool Enter(const BoundaryFace& boundary, Face& face) const;
  bool MeetsBox(const BoundaryTree::Node& node) const;
  void CollectEntries(float endDepth);
  std::int32_t Step(std::int32_t cellFace, Face& face) const;
  void Advance(const Face& from, const Face& to, float endDepth, RayIntegral& integral);
  bool Walk(
    std::int32_t cellFace, Face& face, float endDepth, RayIntegral& integral, std::int64_t& steps);

  const RayCastScene& Scene;
  glm::vec3 RowX;
  glm::vec3 RowY;
  glm::vec3 RowDepth;
  glm::vec3 U;
  glm::vec3 V;
  glm::vec2 Origin;
  float LengthPerDepth = 0.0f;
  float NearDepth = 0.0f;
  float DepthNow = 0.0f;
  std::vector<Entry> Entries;
};

}

#endif

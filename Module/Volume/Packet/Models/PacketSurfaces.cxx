// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraIsosurfaces.glsl (surfaces that a segment meets)
#include "Volume/Packet/Models/PacketSurfaces.h"
#include "Volume/Optics/RefractionMedium.h"
#include "Volume/Optics/SurfaceLighting.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace meniscus
{
namespace
{

/** A cell in the frame of the rays, in double precision from integer grid units. */
struct SeenCell
{
  const std::int32_t* Ids;
  glm::dvec3 Corners[4];

  /** Columns are the edges from corner 0. */
  glm::dmat3 Edges() const
  {
    return { this->Corners[1] - this->Corners[0], this->Corners[2] - this->Corners[0],
      this->Corners[3] - this->Corners[0] };
  }
};

SeenCell SeeCell(const PacketJob& job, std::int32_t cell)
{
  SeenCell seen;
  seen.Ids = job.Cells + 8 * std::int64_t{ cell };
  for (int k = 0; k < 4; ++k)
  {
    const std::int32_t(&place)[3] = job.Vertices[seen.Ids[k]].Place;
    seen.Corners[k] = { job.GridUnit * place[0], job.GridUnit * place[1],
      double{ PacketVertex::DepthUnit } * place[2] };
  }
  return seen;
}

/** One vector of a table with three numbers each. */
glm::dvec3 TripleAt(const float* table, std::int64_t index)
{
  const float* triple = table + 3 * index;
  return { triple[0], triple[1], triple[2] };
}

/** Weights of the cell's vertices at a point in it. */
glm::dvec4 WeightsAt(const SeenCell& cell, const glm::dvec3& place)
{
  const glm::dmat3 edges = cell.Edges();
  if (glm::determinant(edges) == 0.0)
  {
    return { 1.0, 0.0, 0.0, 0.0 };
  }
  const glm::dvec3 weights = glm::inverse(edges) * (place - cell.Corners[0]);
  return { 1.0 - weights.x - weights.y - weights.z, weights };
}

/** The gradients of the cell's vertices, interpolated. */
glm::dvec3 VertexGradient(const PacketJob& job, const SeenCell& cell, const glm::dvec4& weights)
{
  glm::dvec3 gradient(0.0);
  for (int k = 0; k < 4; ++k)
  {
    gradient += weights[k] * TripleAt(job.VertexGradients, cell.Ids[k]);
  }
  return gradient;
}

/**
 * The numbers of VertexLight before a face that is an isosurface of cell data: those of the cell
 * that the ray has left by it.
 */
glm::dvec3 LightOfCellBefore(const PacketJob& job, std::int32_t cellFace)
{
  const std::int64_t cell = cellFace / 4;
  const std::int32_t before = job.Cells[8 * cell + 4 + cellFace % 4];
  return TripleAt(job.VertexLight, before < 0 ? cell : before / 4);
}

/**
 * The numbers of VertexLight at a point of an isosurface: interpolated between those vertices of
 * the cell that lie on the side from which the ray comes. The surface itself may hide the light
 * from the others.
 */
glm::dvec3 LightBefore(const PacketJob& job, const SeenCell& cell, const glm::dvec4& weights,
  float isovalue, bool fromBelow)
{
  if (!job.VertexLight)
  {
    return glm::dvec3(1.0);
  }
  glm::dvec3 sum(0.0);
  double total = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    if ((job.Vertices[cell.Ids[k]].Scalar < isovalue) == fromBelow)
    {
      // By rounding, a weight may be negative, and all of them 0: the vertices count alike then.
      const double weight = std::max(weights[k], std::numeric_limits<double>::min());
      sum += weight * TripleAt(job.VertexLight, cell.Ids[k]);
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : glm::dvec3(1.0);
}

glm::dvec3 FaceNormal(const SeenCell& cell, int opposite)
{
  const glm::dvec3& p = cell.Corners[opposite == 0 ? 1 : 0];
  return glm::cross(
    cell.Corners[opposite <= 1 ? 2 : 1] - p, cell.Corners[opposite == 3 ? 2 : 3] - p);
}

/** Lit colour of a surface where a ray, from below or above its isovalue, meets it. */
glm::dvec3 LitColor(const PacketJob& job, const PacketSegment& segment,
  const PacketSurface& surface, double at, bool fromBelow)
{
  const glm::dvec3 emitted(surface.Color[0], surface.Color[1], surface.Color[2]);
  if (!job.Lighting)
  {
    return emitted;
  }
  const PacketRay& ray = job.Rays[segment.Ray];
  const glm::dvec2 slope =
    glm::dvec2(ray.Slope[0], ray.Slope[1]) * (job.GridUnit * PacketVertex::GridPerDepth);
  const double fromPivot =
    segment.StartDepth + at * (double{ segment.EndDepth } - segment.StartDepth);
  const glm::dvec2 across = job.GridUnit *
    (glm::dvec2(ray.Offset[0], ray.Offset[1]) + fromPivot * glm::dvec2(ray.Slope[0], ray.Slope[1]));
  const glm::dvec3 place(across, (fromPivot + job.Pivot) / PacketVertex::GridPerDepth);

  const SeenCell cell = SeeCell(job, segment.CellFace / 4);
  const glm::dvec4 weights = job.VertexGradients || (job.VertexLight && !job.CellScalars)
    ? WeightsAt(cell, place)
    : glm::dvec4(0.0);
  glm::dvec3 normal;
  if (job.CellScalars)
  {
    normal = FaceNormal(cell, segment.CellFace % 4);
  }
  else if (job.VertexGradients)
  {
    normal = *job.GradientToFrame * VertexGradient(job, cell, weights);
  }
  else
  {
    normal = *job.GradientToFrame * TripleAt(job.CellGradients, segment.CellFace / 4);
  }
  const glm::dvec3 reached = job.VertexLight && job.CellScalars
    ? LightOfCellBefore(job, segment.CellFace)
    : LightBefore(job, cell, weights, surface.Scalar, fromBelow);
  const ReflectedLight light = Light(*job.Lighting, normal, place, slope, reached);
  return emitted * light.Reflected + light.Highlight;
}

/** Fades a colour that is seen at a fraction of a segment; see PacketFadedMedium. */
glm::dvec3 FadedColor(
  const PacketJob& job, const PacketSegment& segment, const glm::dvec3& color, double at)
{
  if (!job.Fading)
  {
    return color;
  }
  const PacketFading& fading = *job.Fading;
  const double depth = segment.StartDepth + at * (double{ segment.EndDepth } - segment.StartDepth);
  const double path =
    std::max(0.0, job.PathsAtPivot[segment.Ray] + depth * job.Rays[segment.Ray].LengthPerDepth);
  RefractionMedium medium;
  medium.Kind =
    fading.IsLinear ? RefractionMedium::Model::Linear : RefractionMedium::Model::Exponential;
  std::copy_n(fading.Attenuation, 3, medium.Attenuation.begin());
  std::copy_n(fading.Range, 2, medium.Range.begin());
  const std::array<double, 3> seen = medium.SeenFrom(path);
  const glm::dvec3 scattered(fading.Color[0], fading.Color[1], fading.Color[2]);
  return glm::mix(scattered, color, glm::dvec3(seen[0], seen[1], seen[2]));
}

/** Adds a surface at a fraction of the segment, met from below or above its isovalue. */
void AddSurface(const PacketJob& job, const PacketSegment& segment, const PacketSurface& surface,
  double at, bool fromBelow, PacketSurfaceState& state)
{
  const glm::dvec3 color =
    FadedColor(job, segment, LitColor(job, segment, surface, at, fromBelow), at);
  const float weight = state.Transmittance * surface.Opacity;
  for (int channel = 0; channel < 3; ++channel)
  {
    state.Color[channel] += weight * static_cast<float>(color[channel]);
  }
  state.Transmittance -= weight;
}

}

//------------------------------------------------------------------------------
void CrossSurfaces(const PacketJob& job, const PacketSegment& segment, PacketSurfaceState& state)
{
  const PacketSurface* const first = job.Surfaces;
  const PacketSurface* const end = first + job.NumberOfSurfaces;
  const auto firstAbove = [&](float scalar)
  {
    return std::upper_bound(first, end, scalar,
      [](float value, const PacketSurface& surface) { return value < surface.Scalar; });
  };
  const PacketSurface* const atFrom = firstAbove(segment.From);
  const PacketSurface* const last = firstAbove(segment.To);
  const bool isKnown = state.Lower <= state.Upper;
  const PacketSurface* now = isKnown ? firstAbove(state.Lower) : atFrom;
  const auto cross = [&](const PacketSurface* to, bool isAtStart)
  {
    while (now != to && state.Transmittance > job.TerminationTransmittance)
    {
      const bool upward = now < to;
      const PacketSurface& surface = upward ? *now : *(now - 1);
      now += upward ? 1 : -1;
      const double change = double{ segment.To } - segment.From;
      const double at = isAtStart || job.CellScalars
        ? 0.0
        : std::clamp((double{ surface.Scalar } - segment.From) / change, 0.0, 1.0);
      AddSurface(job, segment, surface, at, upward, state);
    }
  };
  cross(atFrom, true);
  cross(last, false);
  constexpr float beyond = std::numeric_limits<float>::max();
  state.Lower = last == first ? -beyond : (last - 1)->Scalar;
  state.Upper = last == end ? beyond : last->Scalar;
}

}

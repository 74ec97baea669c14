// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A ray tracer with one refraction, based on Embree, for comparison with virtual geometry. The
 * membrane consists of triangles with linearly interpolated normals, the object of triangles.
 *
 * Rays are traced in packets of eight. A traced packet is passed to a shader, which computes its
 * colours; the packet contains the data for Fresnel's equations, attenuation along the true path,
 * textures or a reflected environment. A shader may trace further rays with intersect().
 */
#pragma once

#include <glm/vec3.hpp>

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meniscus::benchmark
{

/** Triangles in Embree's layout, with one float of padding behind the last point. */
struct TracedMesh
{
  std::vector<float> Points;
  std::vector<float> Normals; ///< per point; for membranes only
  std::vector<std::uint32_t> Triangles;

  void AddPoint(const double* point);
  void Finish() { this->Points.resize(this->Points.size() + 1, 0.0f); }
  std::size_t GetNumberOfPoints() const { return (this->Points.size() - 1) / 3; }
};

/** Eight neighbouring pixels of a row after tracing, component by component. */
struct TracedPacket
{
  static constexpr int Width = 8;
  static constexpr std::uint32_t None = 0xffffffffu;

  int X = 0;
  int Y = 0;
  int Count = 0; ///< number of pixels inside the image

  /**
   * Unit direction from the eye, and its intersection with the membrane: facet, place, unit normal
   * towards the eye, cosine of the angle of incidence, distance from the eye. There is no facet
   * where the ray misses the membrane or meets its back.
   */
  float Sight[3][Width];
  std::uint32_t Facet[Width];
  float Place[3][Width];
  float Normal[3][Width];
  float Cosine[Width];
  float Distance[Width];

  /**
   * Unit direction behind the membrane, and its intersection: triangle, barycentric coordinates of
   * its second and third corner, length of the path. There is no triangle under total reflection,
   * and where the ray meets nothing.
   */
  float Refracted[3][Width];
  std::uint32_t Triangle[Width];
  float U[Width];
  float V[Width];
  float Depth[Width];
};

/** Computes colours of traced pixels. Called from several threads at once. */
class TracedShader
{
public:
  virtual ~TracedShader() = default;
  /** Four bytes for each of the packet's pixels. */
  virtual void Shade(const TracedPacket& packet, unsigned char* rgba) const = 0;
};

/** One colour for each triangle of the object, and a background colour. */
class TriangleColors : public TracedShader
{
public:
  std::vector<std::uint32_t> Colors; ///< RGBA bytes in memory order
  std::uint32_t Background = 0xff000000u;
  void Shade(const TracedPacket& packet, unsigned char* rgba) const override;
};

/**
 * Ray (x, y) of an image has the direction Forward + x' Right + y' Up, with x' and y' from -1 to 1.
 */
struct TracedView
{
  glm::dvec3 Eye{ 0.0 };
  glm::dvec3 Forward{ 0.0 };
  glm::dvec3 Right{ 0.0 };
  glm::dvec3 Up{ 0.0 };
  int Pixels = 512;
};

class RefractionTracer
{
public:
  RefractionTracer();
  ~RefractionTracer();
  RefractionTracer(const RefractionTracer&) = delete;
  void operator=(const RefractionTracer&) = delete;

  void SetIndices(double exterior, double interior);
  void SetMembrane(const TracedMesh& mesh);
  /** Sets another shape of the same facets: refits instead of building again. */
  void MoveMembrane(const TracedMesh& mesh);
  void SetObject(const TracedMesh& mesh);

  /** Traces all pixels with vtkSMPTools. `rgba` has Pixels x Pixels x 4 bytes, in rows upwards. */
  void Trace(const TracedView& view, const TracedShader& shader, unsigned char* rgba) const;

  /** Traces one packet, for callers that need more than colours. */
  void TracePacket(const TracedView& view, TracedPacket& packet) const;

  /** Traces a shader's own rays against the object. */
  void Intersect(const int* valid, RTCRayHit8& rays) const;

private:
  static RTCGeometry Commit(RTCDevice device, RTCScene scene, RTCGeometry old,
    const TracedMesh& mesh, RTCBuildQuality quality);
  void FindSights(const TracedView& view, TracedPacket& packet) const;
  void Refract(TracedPacket& packet, RTCRayHit8& rays, int* valid) const;

  RTCDevice Device = nullptr;
  RTCScene Membrane = nullptr;
  RTCScene Object = nullptr;
  RTCGeometry MembraneGeometry = nullptr;
  TracedMesh Surface;
  TracedMesh Shape;
  float Ratio = 1.0f;
};

} // namespace meniscus::benchmark

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionTracer.h"

#include <vtkSMPTools.h>
#include <vtkType.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace meniscus::benchmark
{

namespace
{

constexpr int Width = TracedPacket::Width;
constexpr float Far = std::numeric_limits<float>::infinity();

// Refracted rays start at this fraction of their distance from the eye behind the membrane, so that
// an object that touches the membrane is met on its far side only.
constexpr float StartPart = 1e-6f;

void TraceCoherent(RTCScene scene, const int* valid, RTCRayHit8& rays)
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &rays);
}

void ClearHits(RTCRayHit8& rays, float near)
{
  for (int k = 0; k < Width; ++k)
  {
    rays.ray.tnear[k] = near;
    rays.ray.tfar[k] = Far;
    rays.ray.time[k] = 0.0f;
    rays.ray.mask[k] = TracedPacket::None;
    rays.ray.flags[k] = 0;
    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.primID[k] = TracedPacket::None;
    rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
void TracedMesh::AddPoint(const double* point)
{
  for (int i = 0; i < 3; ++i)
  {
    this->Points.push_back(static_cast<float>(point[i]));
  }
}

//------------------------------------------------------------------------------
void TriangleColors::Shade(const TracedPacket& packet, unsigned char* rgba) const
{
  std::uint32_t colors[Width];
  for (int k = 0; k < Width; ++k)
  {
    colors[k] = packet.Triangle[k] == TracedPacket::None ? this->Background
                                                         : this->Colors[packet.Triangle[k]];
  }
  std::memcpy(rgba, colors, sizeof(std::uint32_t) * static_cast<std::size_t>(packet.Count));
}

//------------------------------------------------------------------------------
RefractionTracer::RefractionTracer()
  : Device(rtcNewDevice("threads=2"))
{
}

//------------------------------------------------------------------------------
RefractionTracer::~RefractionTracer()
{
  for (RTCScene scene : { this->Membrane, this->Object })
  {
    if (scene)
    {
      rtcReleaseScene(scene);
    }
  }
  rtcReleaseDevice(this->Device);
}

//------------------------------------------------------------------------------
void RefractionTracer::SetIndices(double exterior, double interior)
{
  this->Ratio = static_cast<float>(exterior / interior);
}

//------------------------------------------------------------------------------
// The arrays are shared with Embree, so `mesh` must stay alive.
RTCGeometry RefractionTracer::Commit(RTCDevice device, RTCScene scene, RTCGeometry old,
  const TracedMesh& mesh, RTCBuildQuality quality)
{
  RTCGeometry geometry = old;
  if (!old)
  {
    geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry); // the scene keeps it
  }
  rtcSetGeometryBuildQuality(geometry, quality);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
    mesh.Points.data(), 0, 3 * sizeof(float), mesh.GetNumberOfPoints());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
    mesh.Triangles.data(), 0, 3 * sizeof(std::uint32_t), mesh.Triangles.size() / 3);
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene);
  return geometry;
}

//------------------------------------------------------------------------------
void RefractionTracer::SetMembrane(const TracedMesh& mesh)
{
  this->Surface = mesh;
  if (this->Membrane)
  {
    rtcReleaseScene(this->Membrane);
  }
  this->Membrane = rtcNewScene(this->Device);
  rtcSetSceneFlags(this->Membrane, RTC_SCENE_FLAG_DYNAMIC);
  this->MembraneGeometry =
    Commit(this->Device, this->Membrane, nullptr, this->Surface, RTC_BUILD_QUALITY_MEDIUM);
}

//------------------------------------------------------------------------------
void RefractionTracer::MoveMembrane(const TracedMesh& mesh)
{
  std::copy(mesh.Points.begin(), mesh.Points.end(), this->Surface.Points.begin());
  std::copy(mesh.Normals.begin(), mesh.Normals.end(), this->Surface.Normals.begin());
  this->MembraneGeometry = Commit(
    this->Device, this->Membrane, this->MembraneGeometry, this->Surface, RTC_BUILD_QUALITY_REFIT);
}

//------------------------------------------------------------------------------
void RefractionTracer::SetObject(const TracedMesh& mesh)
{
  if (this->Object)
  {
    rtcReleaseScene(this->Object);
  }
  this->Shape = mesh;
  this->Object = rtcNewScene(this->Device);
  Commit(this->Device, this->Object, nullptr, this->Shape, RTC_BUILD_QUALITY_HIGH);
}

//------------------------------------------------------------------------------
void RefractionTracer::Intersect(const int* valid, RTCRayHit8& rays) const
{
  TraceCoherent(this->Object, valid, rays);
}

//------------------------------------------------------------------------------
void RefractionTracer::FindSights(const TracedView& view, TracedPacket& packet) const
{
  alignas(32) int valid[Width];
  alignas(32) RTCRayHit8 rays;
  ClearHits(rays, 0.0f);
  const double step = 2.0 / view.Pixels;
  const glm::dvec3 rowStart = view.Forward + (step * (packet.Y + 0.5) - 1.0) * view.Up - view.Right;
  for (int k = 0; k < Width; ++k)
  {
    valid[k] = k < packet.Count ? -1 : 0;
    const glm::vec3 direction(rowStart + step * (packet.X + k + 0.5) * view.Right);
    const float inverse = 1.0f /
      std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
    for (int i = 0; i < 3; ++i)
    {
      packet.Sight[i][k] = direction[i] * inverse;
    }
    rays.ray.org_x[k] = static_cast<float>(view.Eye.x);
    rays.ray.org_y[k] = static_cast<float>(view.Eye.y);
    rays.ray.org_z[k] = static_cast<float>(view.Eye.z);
    rays.ray.dir_x[k] = packet.Sight[0][k];
    rays.ray.dir_y[k] = packet.Sight[1][k];
    rays.ray.dir_z[k] = packet.Sight[2][k];
  }
  TraceCoherent(this->Membrane, valid, rays);
  for (int k = 0; k < Width; ++k)
  {
    packet.Facet[k] = valid[k] ? rays.hit.primID[k] : TracedPacket::None;
    packet.Distance[k] = rays.ray.tfar[k];
    if (packet.Facet[k] == TracedPacket::None)
    {
      continue;
    }
    const std::uint32_t* ids = this->Surface.Triangles.data() + std::size_t(3) * packet.Facet[k];
    const float weights[3] = { 1.0f - rays.hit.u[k] - rays.hit.v[k], rays.hit.u[k], rays.hit.v[k] };
    for (int i = 0; i < 3; ++i)
    {
      float sum = 0.0f;
      for (int c = 0; c < 3; ++c)
      {
        sum +=
          weights[c] * this->Surface.Normals[std::size_t(3) * ids[c] + static_cast<std::size_t>(i)];
      }
      packet.Normal[i][k] = sum;
    }
    const glm::dvec3& e = view.Eye;
    packet.Place[0][k] = static_cast<float>(e.x) + packet.Distance[k] * packet.Sight[0][k];
    packet.Place[1][k] = static_cast<float>(e.y) + packet.Distance[k] * packet.Sight[1][k];
    packet.Place[2][k] = static_cast<float>(e.z) + packet.Distance[k] * packet.Sight[2][k];
  }
}

//------------------------------------------------------------------------------
// Eq. 2.2 for all lanes; lanes without a ray are disabled.
void RefractionTracer::Refract(TracedPacket& packet, RTCRayHit8& rays, int* valid) const
{
  for (int k = 0; k < Width; ++k)
  {
    const bool hit = packet.Facet[k] != TracedPacket::None;
    const float n[3] = { packet.Normal[0][k], packet.Normal[1][k], packet.Normal[2][k] };
    const float inverse = hit ? 1.0f / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) : 0.0f;
    float facing = 0.0f;
    for (int i = 0; i < 3; ++i)
    {
      packet.Normal[i][k] = hit ? n[i] * inverse : 0.0f;
      facing += packet.Normal[i][k] * packet.Sight[i][k];
    }
    const float radicand = 1.0f - this->Ratio * this->Ratio * (1.0f - facing * facing);
    packet.Cosine[k] = -facing;
    if (!(facing < 0.0f))
    {
      packet.Facet[k] = TracedPacket::None;
    }
    valid[k] = facing < 0.0f && radicand > 0.0f ? -1 : 0;
    const float along = -this->Ratio * facing - std::sqrt(std::max(radicand, 0.0f));
    for (int i = 0; i < 3; ++i)
    {
      packet.Refracted[i][k] = this->Ratio * packet.Sight[i][k] + along * packet.Normal[i][k];
    }
    rays.ray.org_x[k] = packet.Place[0][k];
    rays.ray.org_y[k] = packet.Place[1][k];
    rays.ray.org_z[k] = packet.Place[2][k];
    rays.ray.dir_x[k] = packet.Refracted[0][k];
    rays.ray.dir_y[k] = packet.Refracted[1][k];
    rays.ray.dir_z[k] = packet.Refracted[2][k];
    rays.ray.tnear[k] = StartPart * packet.Distance[k];
  }
}

//------------------------------------------------------------------------------
void RefractionTracer::TracePacket(const TracedView& view, TracedPacket& packet) const
{
  this->FindSights(view, packet);
  alignas(32) int valid[Width];
  alignas(32) RTCRayHit8 rays;
  ClearHits(rays, 0.0f);
  this->Refract(packet, rays, valid);
  this->Intersect(valid, rays);
  for (int k = 0; k < Width; ++k)
  {
    packet.Triangle[k] = valid[k] ? rays.hit.primID[k] : TracedPacket::None;
    packet.U[k] = rays.hit.u[k];
    packet.V[k] = rays.hit.v[k];
    packet.Depth[k] = rays.ray.tfar[k];
  }
}

//------------------------------------------------------------------------------
void RefractionTracer::Trace(
  const TracedView& view, const TracedShader& shader, unsigned char* rgba) const
{
  constexpr vtkIdType rowsPerTask = 8;
  vtkSMPTools::For(0, view.Pixels, rowsPerTask,
    [this, &view, &shader, rgba](vtkIdType begin, vtkIdType end)
    {
      TracedPacket packet = {};
      for (vtkIdType y = begin; y < end; ++y)
      {
        packet.Y = static_cast<int>(y);
        for (packet.X = 0; packet.X < view.Pixels; packet.X += Width)
        {
          packet.Count = std::min(Width, view.Pixels - packet.X);
          this->TracePacket(view, packet);
          shader.Shade(packet, rgba + 4 * (y * view.Pixels + packet.X));
        }
      }
    });
}

} // namespace meniscus::benchmark

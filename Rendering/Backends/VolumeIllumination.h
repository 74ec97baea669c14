// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Rendering/Property/RayCastOptics.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Illumination/ShadowStarts.h"
#include "Volume/Rays/RayFrame.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus
{

struct RayCastTables;
struct ShadowScene;

/**
 * Light that reaches the vertices of a volume through its own medium, or past its isosurfaces, and
 * the cells of a volume with isosurfaces of cell data: the numbers of VertexLight of each.
 * Transmittances are computed again when the medium, the reach, the clipping planes or the place of
 * the light in relation to the volume have changed, each light by itself; another camera or colour
 * of a light does not change them.
 */
class VolumeIllumination
{
public:
  /** Number of directions over which the ambient light's transmittance is the mean. */
  static constexpr int NumberOfDirections = 32;

  /** Everything that the light depends on besides the tables of the input. */
  struct Request
  {
    /** Frame of the lights and of the clipping planes that does not depend on the camera. */
    RayFrame Base;
    /** Optics in this frame, with the frame's lights. */
    RayCastOptics Optics;
    /** Fraction, in (0, 1], of the diameter of a sphere about the volume. */
    double Reach = 1.0;
  };

  /**
   * Updates the values. Returns false if it was aborted. The values that it has computed by then
   * are kept, and the next call computes the others.
   * @param progress called with the fraction done before each cast; returns false to abort.
   */
  bool Update(
    RayCastTables& tables, const Request& request, const std::function<bool(double)>& progress);

  /** One entry per vertex or cell of the mesh; vertices without a visible cell have ones. */
  const std::vector<glm::vec3>& GetValues() const { return this->Values; }
  /** Index of the light that has a transmittance of its own. */
  int GetBrightestLight() const { return this->Brightest; }
  /** Changes with the values. */
  TableVersion GetVersion() const { return this->Version; }
  /** Number of directions and places towards which shadows were cast, since construction. */
  std::int64_t GetNumberOfCasts() const { return this->Casts; }
  std::int64_t GetBytes() const;

private:
  /** Everything that the transmittance along a given line depends on. */
  struct MediumKey
  {
    TableVersions Mesh;
    TableVersions Values;
    BlendMode Blending = BlendMode::Composite;
    bool CellScalars = false;
    /** Attenuation of the functions, without colours. */
    std::vector<float> Attenuation;
    /** Isovalues, ascending, and opacities of the isosurfaces. */
    std::vector<float> Isovalues;
    std::vector<float> SurfaceOpacities;
    std::vector<RayClippingPlane> ClippingPlanes;
    bool GradientOpacity = false;
    bool VertexGradients = false;
    double GradientMagnitude = 0.0;
    RayFrame Base;
    double Reach = 0.0;

    bool operator==(const MediumKey& other) const;
  };
  struct KnownLight
  {
    glm::dvec4 Position;
    /** One per vertex or cell. */
    std::vector<float> Transmittance;
  };

  MediumKey KeyOf(const RayCastTables& tables, const Request& request) const;
  void SetMediumOf(RayCastTables& tables, const Request& request);
  void BuildStarts(RayCastTables& tables);
  bool AreInCells() const
  {
    return this->Medium.CellScalars && !GetBlendModel(this->Medium.Blending).IsMedium();
  }
  std::vector<std::size_t> FindUnknown(const std::vector<RayCastLight>& lights);
  void CastLight(const ShadowScene& scene, KnownLight& light);
  void CastDirection(const ShadowScene& scene, int direction);
  void Combine(const Request& request);

  MediumKey Medium;
  PacketTables Packed;
  ShadowStarts Starts;
  /** In the order of the frame's lights. */
  std::vector<KnownLight> Lights;
  /** Sums over the directions cast so far, and their number. */
  std::vector<float> Ambient;
  int AmbientDirections = 0;

  std::vector<glm::vec3> Values;
  int Brightest = 0;
  /** Lights, and number of ambient directions, that the values are of. */
  std::vector<RayCastLight> CombinedLights;
  bool IsCombined = false;
  TableVersion Version;
  std::int64_t Casts = 0;
};

}

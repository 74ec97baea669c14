// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/PacketScene.h"

#include "Rendering/Backends/RayCastTables.h"
#include "Rendering/Property/RayCastOptics.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void PackProperty(const VolumePropertyTables& property, PacketTables& packed)
{
  packed.Intervals = PackIntervals(property.GetIntervals());
  packed.GradientIntervals = PackIntervals(property.GetGradientIntervals());
  packed.OtherIntervals.clear();
  for (const std::vector<TransferFunctionInterval>& intervals : property.GetOtherIntervals())
  {
    packed.OtherIntervals.push_back(PackIntervals(intervals));
  }
  packed.Surfaces.clear();
  for (const Isosurface& surface : property.GetIsosurfaces())
  {
    const glm::vec3& color = surface.Color;
    packed.Surfaces.push_back({ surface.Scalar, surface.Opacity, { color.r, color.g, color.b } });
  }
}

//------------------------------------------------------------------------------
void SetMedium(RayCastTables& tables, const RayCastOptics& optics, TileCaster::Scene& scene)
{
  scene.Mesh = &tables.Input.GetMesh();
  scene.Passages = &tables.Input.GetPassages();
  scene.Boundary = &scene.Mesh->GetBoundary();
  scene.CellScalars = optics.CellScalars ? tables.Input.GetCellScalars().data() : nullptr;
  scene.VertexGradients =
    optics.VertexGradients ? tables.VertexGradients.GetValues().data() : nullptr;
  scene.CellGradients =
    optics.UsesCellGradients() ? tables.CellGradients.GetValues().data() : nullptr;
  scene.GradientToFrame = optics.GradientToFrame;
  scene.GradientOpacity = optics.GradientOpacity;
  scene.GradientMagnitude = optics.GradientMagnitude;
  scene.Blending = optics.Blending;
  scene.Mixture = optics.Components;
  scene.Components = optics.HasComponents() ? tables.Components.GetValues().data() : nullptr;
  scene.ClippingPlanes = optics.ClippingPlanes;
}

}

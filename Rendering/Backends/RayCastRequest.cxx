// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/RayCastBackend.h"

#include "Rendering/Backends/RayCastFrame.h"
#include "Rendering/Backends/RayCastTables.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/TransferFunction.h"

#include <glm/matrix.hpp>

namespace meniscus
{
namespace
{

void Copy(const glm::dvec3& from, double (&to)[3])
{
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

/**
 * The model vectors of an affine map in the frame of the rays.
 * @param toModel  matrix from the frame to the model.
 * @param depth    depth of every vector.
 */
RayCastAffineMap ToModel(const glm::dmat3& toModel, const AffinePixelMap& map, double depth)
{
  RayCastAffineMap result;
  Copy(toModel * glm::dvec3(map.Base, depth), result.Base);
  Copy(toModel * glm::dvec3(map.PerColumn, 0.0), result.PerColumn);
  Copy(toModel * glm::dvec3(map.PerRow, 0.0), result.PerRow);
  return result;
}

}

//------------------------------------------------------------------------------
RayCastRequest::RayCastRequest(
  RayCastTables& tables, const RayCastFrame& frame, vtkOpenGLRenderWindow* window)
  : Tables(tables)
  , Frame(frame)
  , Window(window)
{
}

//------------------------------------------------------------------------------
RayCastMesh RayCastRequest::GetMesh() const
{
  static_assert(sizeof(TetrahedralMesh::Cell) == 8 * sizeof(std::int32_t), "eight numbers");
  static_assert(sizeof(glm::ivec3) == 3 * sizeof(std::int32_t), "three numbers");
  const VolumeInput& input = this->Tables.Input;
  const TetrahedralMesh& mesh = input.GetMesh();
  RayCastMesh view;
  view.Positions = reinterpret_cast<const std::int32_t*>(mesh.GetFixedPositions().data());
  view.NumberOfVertices = mesh.GetNumberOfVertices();
  view.PositionUnit = TetrahedralMesh::PositionUnit * mesh.GetRadius();
  Copy(mesh.GetCenter(), view.Center);
  view.Cells = reinterpret_cast<const std::int32_t*>(mesh.GetCells().data());
  view.NumberOfCells = mesh.GetNumberOfCells();
  const bool ofCells = input.GetFieldAssociation() == FieldAssociation::Cells;
  view.VertexScalars = ofCells ? nullptr : input.GetScalars().data();
  view.CellScalars = ofCells ? input.GetCellScalars().data() : nullptr;
  view.MeshVersion = input.GetMeshVersion();
  view.LinkVersion = input.GetLinkVersion();
  view.ScalarVersion = input.GetScalarVersion();
  return view;
}

//------------------------------------------------------------------------------
RayCastTransferFunction RayCastRequest::GetTransferFunction() const
{
  static_assert(sizeof(TransferFunctionInterval) == 10 * sizeof(float), "ten numbers");
  const auto& intervals = this->Tables.Property.GetIntervals();
  RayCastTransferFunction view;
  view.Intervals = reinterpret_cast<const float*>(intervals.data());
  view.NumberOfIntervals = static_cast<std::int64_t>(intervals.size());
  view.Version = this->Tables.Property.GetVersion();
  return view;
}

//------------------------------------------------------------------------------
RayCastRays RayCastRequest::GetRays() const
{
  const RayFrame& frame = this->Frame.Rays;
  const double radius = this->Tables.Input.GetMesh().GetRadius();
  const glm::dmat3 toFrame =
    glm::transpose(glm::dmat3(frame.RowX, frame.RowY, frame.RowDepth)) * (1.0 / radius);
  const glm::dmat3 toModel = glm::inverse(toFrame);
  const glm::dmat3 toWorld = frame.ViewToWorld * toFrame;
  RayCastRays rays;
  rays.Width = this->Frame.Output.ImageSize[0];
  rays.Height = this->Frame.Output.ImageSize[1];
  rays.Origin = ToModel(toModel, frame.Origin, 0.0);
  rays.Direction = ToModel(toModel, frame.Slope, 1.0);
  rays.NearDepth = frame.NearDepth;
  rays.FarDepth = frame.FarDepth;
  // The shares of both planes are 0.5 (1 + d) and 0.5 (1 - d).
  const auto setLine = [](const glm::dvec2& ends, double(&line)[2])
  {
    line[0] = 0.5 * (ends.x - ends.y);
    line[1] = 0.5 * (ends.x + ends.y);
  };
  setLine(frame.DepthNumerator, rays.DepthNumerator);
  setLine(frame.DepthDenominator, rays.DepthDenominator);
  const glm::dmat3 rows = glm::transpose(toWorld);
  for (int row = 0; row < 3; ++row)
  {
    Copy(rows[row], rays.ModelToWorld[row]);
  }
  return rays;
}

//------------------------------------------------------------------------------
RayCastFeatures RayCastRequest::GetFeatures() const
{
  const RayCastOptics& optics = this->Frame.Optics;
  RayCastFeatures features;
  features.BlendMode = static_cast<int>(optics.Blending);
  features.CellScalars = optics.CellScalars;
  features.SeveralComponents = optics.HasComponents();
  features.Shading = optics.Shading;
  features.GlobalIllumination = optics.Illuminated;
  features.GradientOpacity = optics.GradientOpacity;
  features.PreIntegration = optics.PreIntegrated;
  features.ClippingPlanes = !optics.ClippingPlanes.empty();
  features.Membrane =
    this->Frame.Refracting.Wanted || this->Frame.Refracting.Part != MembranePart::Whole;
  features.Medium = this->Frame.Refracting.Wanted && optics.IsFaded();
  return features;
}

//------------------------------------------------------------------------------
double RayCastRequest::GetEarlyTerminationOpacity() const
{
  return this->Frame.EarlyTerminationOpacity;
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "MembraneScene.h"
#include "MeshArrays.h"
#include "RandomNumbers.h"
#include "VolumeView.h"

namespace meniscus::test
{

/** Opacity and colour of one component, each by its own control points, ascending. */
struct LookFunction
{
  struct OpacityPoint
  {
    double Scalar;
    double Opacity;
  };
  struct ColorPoint
  {
    double Scalar;
    std::array<double, 3> Color;
  };
  std::vector<OpacityPoint> Opacity;
  std::vector<ColorPoint> Color;
  double Weight = 1.0;
};

/** Settings of vtkVolumeProperty and of the mapper's modes. */
struct VolumeLook
{
  /** One of vtkVolumeMapper::BlendModes. */
  int Blend = 0;
  /** One per component. Dependent components have one: colour of the first, opacity of the last. */
  std::vector<LookFunction> Functions;
  bool Independent = true;
  /** ScalarOpacityUnitDistance. */
  double Unit = 1.0;
  std::vector<double> IsoValues;
  bool Shade = false;
  double Ambient = 0.2;
  double Diffuse = 0.6;
  double Specular = 0.4;
  double SpecularPower = 10.0;
  /** Gradient length (scalar per world length) to opacity; empty: no such function. */
  std::vector<LookFunction::OpacityPoint> GradientOpacity;
  /** As in vtkTetrahedraRayCastMapper::SetGradients(). */
  int Gradients = 1;
};

/** A scene of one volume as plain values, which relations rewrite. */
struct VolumeCase
{
  std::string Name;
  /** More than one: blocks of a composite data set. */
  std::vector<MeshArrays> Blocks;
  MeshStorage Storage;
  /** True if any division of the cells into tetrahedra shows the same field. */
  bool Linear = false;
  VolumeLook Look;
  VolumeView View;
  int Size = 48;
  /** Model to world coordinates. */
  glm::dmat4 Matrix{ 1.0 };
  /** No membrane if the mesh is null. */
  MembraneCase Membrane;
  /** Planes as origin and normal; the side to which the normal points is kept. */
  std::vector<std::array<glm::dvec3, 2>> Planes;
  /** As in vtkTetrahedraRayCastMapper::SetBackend(). */
  int Backend = 2;

  const MeshArrays& MakeMesh() const { return this->Blocks.front(); }
  MeshArrays& MakeMesh() { return this->Blocks.front(); }
  bool HasGradients() const { return this->Look.Shade || !this->Look.GradientOpacity.empty(); }
};

/** Requirements of a relation on its scenes; the rest is random. */
struct CaseNeeds
{
  bool Tetrahedra = false;
  bool Linear = false;
  bool Membrane = false;
  bool NoMembrane = false;
  bool Composite = false;
  bool OneComponent = false;
  /**
   * True: no lighting or gradient opacity by gradients of vertices, which are means about each
   * point.
   */
  bool NoVertexGradients = false;
  bool NoCellData = false;
  /** True: no gradients at all. */
  bool NoGradients = false;
  /**
   * True: no mesh with inverted cells. Where a mesh is folded over itself, rays follow shared
   * faces, so that cells that share none are shown in another order.
   */
  bool NoFolds = false;
  /** True: meshes of a few thousand cells at most. */
  bool Small = false;
};

VolumeCase RandomCase(const CaseNeeds& needs, RandomNumbers& random);

/** Volume property of a look. */
vtkSmartPointer<vtkVolumeProperty> ToProperty(const VolumeLook& look);

/**
 * Maps the functions and values of a look to scalars factor * s + offset, factor > 0. Lengths of
 * gradients are scaled by the factor over `lengthFactor`, the unit distance by the latter.
 */
void MapScalars(VolumeLook& look, double factor, double offset, double lengthFactor);

} // namespace meniscus::test

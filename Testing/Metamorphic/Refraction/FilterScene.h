// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Random scenes for the filters of refraction: a membrane, an eye and an object of plane quads. */
#pragma once

#include "RefractionTrial.h"
#include "VTKBasics.h"

class vtkRefractedGeometryFilter;

namespace meniscus::test
{

enum class FilterMode
{
  FlatFacets,
  FirstImage,
  AllImages
};

struct FilterScene
{
  RefractionScene Base; ///< membrane, eye and indices
  FilterMode Mode = FilterMode::AllImages;
  double Tolerance = 0.02; ///< degrees at the eye
  std::vector<glm::dvec3> Points;
  std::vector<std::array<vtkIdType, 4>> Quads; ///< plane; rows of `QuadsPerRow` form strips
  int QuadsPerRow = 1;
};

/** A scene of any family of RandomScene() and of any mode. */
FilterScene MakeFilterScene(RandomNumbers& random);

/** How cells are given. */
enum class CellForm
{
  Quads,
  Triangles,
  Strips
};

/**
 * The object. Point arrays: "Truth" (the true position), "Ones", "Index". `places` are the points'
 * coordinates if they differ from the scene's.
 */
vtkSmartPointer<vtkPolyData> MakeObject(const FilterScene& scene, CellForm form = CellForm::Quads,
  const std::vector<glm::dvec3>* places = nullptr);

/** The membrane's triangles, or pairs of neighbouring triangles as strips or as quads. */
vtkSmartPointer<vtkPolyData> MakeMembraneData(
  const reference::MembraneMesh& mesh, CellForm form = CellForm::Triangles);

/** A copy with coordinates in single or double precision and ids of 32 or 64 bits. */
vtkSmartPointer<vtkPolyData> Convert(vtkPolyData* data, bool isDouble, bool has64Bits);

/** The filter, with the settings of the scene and double output points. */
vtkSmartPointer<vtkRefractedGeometryFilter> MakeSceneFilter(
  const FilterScene& scene, vtkPolyData* object, vtkPolyData* membrane);

/** A copy of the filter's output. */
vtkSmartPointer<vtkPolyData> GetResult(vtkRefractedGeometryFilter* filter);

glm::dvec3 GetTuple(vtkPolyData* data, const char* name, vtkIdType point);

} // namespace meniscus::test

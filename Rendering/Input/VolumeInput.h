// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/TableVersion.h"
#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/CellReader.h"
#include "Rendering/Input/DividedCells.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/InputContent.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/CellPassages.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Optics/VisibleScalars.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace meniscus
{

/**
 * Kernel tables of the drawn volume: mesh, normalised scalars, active cells. Each is remade when
 * its own input changes. Users compare the versions with the versions that they read last.
 */
class VolumeInput
{
public:
  /**
   * Tells whether rays measure depths in single precision, so that the next mesh warns of short
   * edges. Default is true.
   */
  void SetHasSingleDepths(bool has) { this->HasSingleDepths = has; }

  /**
   * Updates the mesh of an input, with all parts in one. An input with equal points and cells
   * counts as the same; if only points have moved, the cells and their links are kept. Scalars of
   * cells need 4 more bytes per cell, which are kept from then on; a mesh without them is built
   * again.
   *
   * With an adaptive division, cells are divided when the mesh is built. The division is kept as
   * long as it holds (see DividedCells::Holds()) for other points, scalars and functions.
   * @param progress called with the fraction done; returns false to abort, which leaves no mesh and
   *   no report.
   */
  InputReport UpdateMesh(const InputBlocks& input, const std::function<bool(double)>& progress,
    const DivisionRequest& division);

  /**
   * Updates the scalars of the mesh, normalised for a function. Another function costs nothing
   * unless its changes are too narrow for the present normalisation; in that case the scalars are
   * normalised again.
   * @param component as in ScalarSelection.
   */
  InputReport UpdateScalars(
    const InputBlocks& input, int component, const FunctionFeatures& features);

  /**
   * Updates the cells that rays visit. It costs nothing if mesh, scalars and visible scalars are
   * unchanged.
   * @param jumps whether jumps of the scalars between cells can be seen.
   */
  void UpdateActiveCells(const VisibleScalars& visible, TetrahedralMesh::CellJumps jumps);

  /** Values besides the scalars, some of which can be seen on their own. */
  struct OtherValues
  {
    /** One entry per vertex; NaN makes its cells transparent. */
    const std::vector<glm::vec3>* Values = nullptr;
    /** Changes with the values. */
    TableVersion Version;
    /** Visible ranges of the first values; other values cannot be seen. */
    std::vector<VisibleScalars> Visible;
  };
  /** As above, with values besides the scalars: a cell is visited if one of them can be seen. */
  void UpdateActiveCells(const VisibleScalars& visible, const OtherValues& others);

  /** Digests of the input, which others may need before UpdateMesh() does. */
  InputDigests& GetDigests() { return this->Digests; }

  const TetrahedralMesh& GetMesh() const { return this->Mesh; }
  /** Number of the input's cells that are left out because they cannot be used. */
  std::int64_t GetNumberOfRejectedCells() const
  {
    return this->Mesh.GetRejectedCells().Total() + this->Unusable.Total();
  }
  FieldAssociation GetFieldAssociation() const { return this->BuiltPlace; }
  /**
   * One normalised scalar per vertex; NaN if the input's is not finite. Empty for scalars of cells.
   */
  const std::vector<float>& GetScalars() const { return this->Scalars; }
  /** One normalised scalar per cell of the mesh; empty for scalars of points. */
  const std::vector<float>& GetCellScalars() const { return this->CellScalars; }
  const ScalarNormalization& GetNormalization() const { return this->Normalization; }
  /** Distribution of the finite scalars of the input. */
  const ScalarDistribution& GetDistribution() const { return this->Distribution; }
  /** The range of the data, normalised. */
  ScalarRange GetNormalizedRange() const;
  /** Points of the mesh whose scalars are interpolated; null if there are none. */
  const WeightedPoints* GetInterpolatedPoints(FieldAssociation place) const
  {
    return place == FieldAssociation::Points && this->Divided.IsUsed() ? &this->Divided.GetPoints()
                                                                       : nullptr;
  }
  /** Cells that are folded inside out in parts. */
  std::int64_t GetNumberOfFoldedCells() const { return this->FoldedCells; }
  /** Division of the cells into tetrahedra; not used unless it is adaptive. */
  const DividedCells& GetDivision() const { return this->Divided; }
  /** Index of the input's scalar for each vertex, or for each cell of the mesh. */
  const std::vector<std::int32_t>& GetSources(FieldAssociation place) const;
  /**
   * Finds the cell of the input that each cell of the mesh is a part of. It is kept until the mesh
   * is built again, and takes 4 bytes per cell.
   * @param input source of the mesh.
   */
  void FindInputCells(const InputBlocks& input);
  /** Running index over all parts for each cell of the mesh, after FindInputCells(). */
  const std::vector<std::int32_t>& GetInputCells() const
  {
    return this->InputCells.empty() ? this->Mesh.GetSourceCells() : this->InputCells;
  }
  /** Times that it was found. */
  std::int64_t GetNumberOfInputCellSearches() const { return this->InputCellSearches; }
  /** Component used as the scalar, as in ScalarSelection. */
  int GetComponent() const { return this->BuiltComponent; }
  /** Tree over the boundary of the active cells; built when first requested. */
  const BoundaryTree& GetBoundaryTree();
  /** Passages of the cells; found when first requested. */
  const std::vector<CellPassages>& GetPassages();

  /**
   * Warning that parts of the mesh overlap; empty if there are no such rays, and after the first
   * warning about this mesh.
   * @param rays number of rays that found it.
   */
  std::string WarnOfOverlaps(std::int64_t rays);

  /** Number of bytes of the tables. */
  std::int64_t GetBytes() const;

  /** Version of the numbering of vertices and cells: changes when the mesh is built. */
  TableVersion GetBuildVersion() const { return this->BuildVersion; }
  /** Version of the mesh without its links and boundary: changes when it is built or moved. */
  TableVersion GetMeshVersion() const { return this->MeshVersion; }
  /** Times that points have moved and the cells were kept. */
  std::int64_t GetNumberOfPointUpdates() const { return this->PointUpdates; }
  TableVersion GetScalarVersion() const { return this->ScalarVersion; }
  /** Times that it was found out which cells are active. */
  std::int64_t GetActiveSetBuilds() const { return this->ActiveSetBuilds; }
  /** Version of the mesh's links. */
  TableVersion GetLinkVersion() const { return this->LinkVersion; }
  /** Versions of the boundary: of its faces and of their positions. */
  TableVersions GetBoundaryVersions() const { return { this->LinkVersion, this->MeshVersion }; }

private:
  InputReport BuildMesh(const std::vector<vtkDataSet*>& grids,
    const std::function<bool(double)>& progress, const DivisionRequest& division);
  InputReport BuildFromCells(
    const std::vector<vtkDataSet*>& grids, const MeshBuildControl& control);
  InputReport BuildDivided(const MeshBuildControl& control);
  void BuildTables(TetrahedraView view, const MeshBuildControl& control, const std::string& omitted,
    InputReport& report);
  std::string DescribeRejected(std::int64_t cells) const;
  std::string DescribeImprecise() const;
  bool HasNewFields(const DivisionRequest& division);
  /** True if cells are divided, or would be for other scalars. */
  bool IsDivided(const DivisionSettings& settings) const
  {
    return settings.IsAdaptive || this->Divided.IsUsed();
  }
  bool IsNewDivision(const DivisionSettings& settings);
  bool MovePoints(const InputBlocks& input);

  TetrahedralMesh Mesh;
  /** Cells that are left out before the mesh is built. */
  UnusableCells Unusable;
  BoundaryTree Tree;
  std::vector<CellPassages> Passages;
  /** Empty until asked for, and if the mesh has them. */
  std::vector<std::int32_t> InputCells;
  std::vector<float> Scalars;
  std::vector<float> CellScalars;
  ScalarDistribution Distribution;
  ScalarNormalization Normalization;
  VisibleScalars Visible;
  TetrahedralMesh::CellJumps Jumps = TetrahedralMesh::CellJumps::Hidden;
  std::vector<VisibleScalars> VisibleOthers;
  /** Version of the values besides the scalars; the default without. */
  TableVersion OthersVersion;

  DividedCells Divided;
  /** Settings and fields that the cells were divided for. */
  DivisionSettings BuiltDivision;
  std::int64_t FoldedCells = 0;
  /** Error of the last build; empty if it succeeded. */
  std::string BuildError;
  FieldAssociation DividedPlace = FieldAssociation::Points;
  int DividedComponent = 0;
  ScalarUse DividedUse = ScalarUse::Values;
  TableVersion DividedFunction;
  ContentWatch FieldWatch;

  InputDigests Digests;
  ContentWatch CellWatch;
  ContentWatch PointWatch;
  ContentWatch ScalarWatch;
  FieldAssociation BuiltPlace = FieldAssociation::Points;
  int BuiltComponent = 0;
  TableVersion BuiltFeatures;
  bool HasSingleDepths = true;
  bool KeepsSourceCells = false;
  /** True if other positions may divide the input's cells into other tetrahedra. */
  bool SplitsByPosition = false;
  bool ActiveSetStale = true;
  /** Mesh whose overlaps were reported. */
  TableVersion OverlapsReported;
  /** Versions of the links and positions that the tree is of. */
  TableVersion LinksOfTree;
  TableVersion MeshOfTree;
  /** Versions of the links and cells that the passages are of. */
  TableVersion LinksOfPassages;
  TableVersion BuildOfPassages;
  std::int64_t InputCellSearches = 0;

  TableVersion BuildVersion;
  TableVersion MeshVersion;
  TableVersion ScalarVersion;
  TableVersion LinkVersion;
  std::int64_t ActiveSetBuilds = 0;
  std::int64_t PointUpdates = 0;
};

}

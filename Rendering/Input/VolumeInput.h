// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_VolumeInput_h
#define meniscus_Rendering_Input_VolumeInput_h

#include "Common/TableVersion.h"
#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/InputBlocks.h"
#include "Volume/Mesh/BoundaryTree.h"
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
 * What is drawn, as the kernel's tables: mesh, normalised scalars, active cells. Each is remade
 * when its own input changed. The versions tell whether what was made of a table is stale.
 */
class VolumeInput
{
public:
  /**
   * The mesh of an input, all parts in one. Another with equal points and cells is the same.
   * For scalars of cells it takes 4 bytes more per cell, which is kept up from then on; a mesh
   * without is made again.
   * @param progress  told the fraction done; false aborts, which leaves no mesh and no report.
   */
  InputReport UpdateMesh(const InputBlocks& input, const std::function<bool(double)>& progress);

  /**
   * The scalars of that mesh, normalised for a function. Another function costs nothing, unless it
   * changes where so normalised scalars are too coarse: then they are made again.
   * @param component  as of ScalarSelection.
   */
  InputReport UpdateScalars(
    const InputBlocks& input, int component, const FunctionFeatures& features);

  /**
   * The cells that rays visit. Costs nothing if mesh, scalars and visible scalars are the same.
   * @param jumps  whether jumps of the scalars of cells can be seen.
   */
  void UpdateActiveCells(const VisibleScalars& visible, TetrahedralMesh::CellJumps jumps);

  /** Values beside the scalars, of which some can be seen by themselves. */
  struct OtherValues
  {
    /** Per vertex; one that is NaN makes its cells transparent. */
    const std::vector<glm::vec3>* Values = nullptr;
    /** Changes with the values. */
    TableVersion Version;
    /** Of the first values; the others cannot be seen. */
    std::vector<VisibleScalars> Visible;
  };
  /** The same with values beside the scalars: a cell is visited if one of them can be seen. */
  void UpdateActiveCells(const VisibleScalars& visible, const OtherValues& others);

  const TetrahedralMesh& GetMesh() const { return this->Mesh; }
  FieldAssociation GetFieldAssociation() const { return this->BuiltPlace; }
  /** One normalised scalar per vertex; NaN where the input's is not finite. Empty if of cells. */
  const std::vector<float>& GetScalars() const { return this->Scalars; }
  /** One per cell of the mesh, likewise; empty if of points. */
  const std::vector<float>& GetCellScalars() const { return this->CellScalars; }
  const ScalarNormalization& GetNormalization() const { return this->Normalization; }
  /** The finite scalars as they are in the input. */
  const ScalarDistribution& GetDistribution() const { return this->Distribution; }
  /** The range of the data, normalised. */
  ScalarRange GetNormalizedRange() const;
  /** Number of the input's scalar per vertex, or per cell of the mesh. */
  const std::vector<std::int32_t>& GetSources(FieldAssociation place) const;
  /** Component that the scalars are, as of ScalarSelection. */
  int GetComponent() const { return this->BuiltComponent; }
  /** Over the boundary of the active cells; built when first asked for. */
  const BoundaryTree& GetBoundaryTree();

  /** Bytes of the tables. */
  std::int64_t GetBytes() const;

  /** Version of the mesh without its links and boundary. */
  TableVersion GetMeshVersion() const { return this->MeshVersion; }
  TableVersion GetScalarVersion() const { return this->ScalarVersion; }
  /** Times that it was found out which cells are active. */
  std::int64_t GetActiveSetBuilds() const { return this->ActiveSetBuilds; }
  /** Version of the mesh's links and boundary. */
  TableVersion GetLinkVersion() const { return this->LinkVersion; }

private:
  InputReport BuildMesh(
    const std::vector<vtkDataSet*>& grids, const std::function<bool(double)>& progress);

  TetrahedralMesh Mesh;
  BoundaryTree Tree;
  std::vector<float> Scalars;
  std::vector<float> CellScalars;
  ScalarDistribution Distribution;
  ScalarNormalization Normalization;
  VisibleScalars Visible;
  TetrahedralMesh::CellJumps Jumps = TetrahedralMesh::CellJumps::Hidden;
  std::vector<VisibleScalars> VisibleOthers;
  /** Version of the values besides the scalars; the default without. */
  TableVersion OthersVersion;

  ContentWatch MeshWatch;
  ContentWatch ScalarWatch;
  FieldAssociation BuiltPlace = FieldAssociation::Points;
  int BuiltComponent = 0;
  TableVersion BuiltFeatures;
  bool KeepsSourceCells = false;
  bool ActiveSetStale = true;
  TableVersion TreeOf;

  TableVersion MeshVersion;
  TableVersion ScalarVersion;
  TableVersion LinkVersion;
  std::int64_t ActiveSetBuilds = 0;
};

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Mesh and index of refraction of a medium that bends light, from VTK data. */
#pragma once

#include "Rendering/Common/ContentWatch.h"
#include "Rendering/Input/InputBlocks.h"
#include "Rendering/Input/InputContent.h"
#include "Rendering/Input/VolumeInput.h"
#include "Volume/Graded/BoundaryCones.h"
#include "Volume/Graded/EntryRaster.h"
#include "Volume/Graded/GradedCellTable.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Graded/RefractiveIndex.h"

#include <functional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkInformation;

namespace meniscus
{

/** Share of a filter's progress that the medium takes. */
constexpr double ShareOfMedium = 0.3;

/** Meaning of an input's values. */
struct MediumQuantity
{
  /** Densities of a gas, n = 1 + GladstoneDale * density; otherwise values of n. */
  bool IsDensity = true;
  double GladstoneDale = GladstoneDaleOfAir;

  bool operator==(const MediumQuantity& other) const
  {
    return this->IsDensity == other.IsDensity &&
      (!this->IsDensity || this->GladstoneDale == other.GladstoneDale);
  }
};

/** The point array of a filter's choice, by default the active scalars; the first component. */
ScalarSelection SelectPointValues(vtkInformation* wanted);

class BentMedium
{
public:
  /**
   * Sets scalars that the next Update() puts into the input besides the indices; null for none.
   * They must exist during it. Other data sets than those of the indices are an error.
   */
  void SetScalars(const InputBlocks* scalars) { this->Scalars = scalars; }

  /**
   * Reads mesh and indices, where they have changed.
   * @param wanted the filter's choice of a point array, by default the active scalars.
   * @param goOn receives the progress, from 0 to 1; if it returns false, the reading is aborted.
   * @return error and warnings; an error if no cell has an index.
   */
  InputReport Update(vtkDataObject* input, vtkInformation* wanted, const MediumQuantity& quantity,
    const std::function<bool(double)>& goOn);

  /** Tables of the input, with a mesh whose vertices and cells have the same numbers. */
  VolumeInput& GetInput() { return this->Input; }
  const VolumeInput& GetInput() const { return this->Input; }
  /** The mesh, in which cells without an index are inactive. */
  const TetrahedralMesh& GetMesh() const { return this->Mesh; }
  /** Is bumped when indices are read. */
  const TableVersion& GetVersion() const { return this->Version; }
  const IndexFaults& GetFaults() const { return this->Faults; }
  /** The boundary in an image of rays. */
  EntryRaster DrawBoundary(const RayImage& image) const;
  /** The field for walks, which refers to this object. */
  GradedMedium MakeField(double outsideIndex, bool isStraight) const;

private:
  std::string ReadIndices(const InputBlocks& blocks, const MediumQuantity& quantity);

  const InputBlocks* Scalars = nullptr;
  VolumeInput Input;
  ContentWatch ValueWatch;
  TableVersions MeshVersions;
  MediumQuantity Quantity;
  TableVersion Version;
  TetrahedralMesh Mesh;
  BoundaryTree Tree;
  BoundaryCones Cones;
  std::vector<double> SquaredIndices;
  std::vector<EdgeTerms> Terms;
  /** Coefficients of the same field, for rays that are bent. */
  GradedCellTable Table;
  IndexFaults Faults;
};

}

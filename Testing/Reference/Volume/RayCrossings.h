// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** The cells that a ray crosses, and their order: see ReferenceRayIntegrator. */
#pragma once

#include "ReferenceCellTree.h"
#include "ReferenceMesh.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace meniscus::reference
{

/** Part of a ray inside one cell; the scalar is linear between its ends. */
struct RaySegment
{
  double Begin;
  double End;
  double ScalarBegin;
  double ScalarEnd;
  std::int64_t Cell;
};

/** A cell that the ray crosses, with the faces at its two ends. */
struct Crossing
{
  RaySegment Segment;
  int NearFace;
  int FarFace;
  bool Inverted;
};

using CellTest = std::function<bool(std::int64_t cell)>;

/**
 * Cells crossed, each found independently, in the order of entry.
 * @param canBeSeen if not null, only cells that pass the test are found.
 */
void FindCrossings(const ReferenceMesh& mesh, const ReferenceCellTree& tree, const Ray& ray,
  const CellTest* canBeSeen, std::vector<Crossing>& crossings);

/**
 * True if the depth of entry does not determine the order.
 * @param negligible overlap that is rounding.
 */
bool NeedsOrder(
  const ReferenceMesh& mesh, const std::vector<Crossing>& crossings, double negligible);

/** All crossings of the whole line, in the order in which paths across shared faces meet them. */
void FindOrderedCrossings(const ReferenceMesh& mesh, const ReferenceCellTree& tree, const Ray& ray,
  const CellTest* canBeSeen, std::vector<Crossing>& crossings);

} // namespace meniscus::reference

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VTKBasics.h"

namespace meniscus::test
{

/** Analytic scalar at a position. */
using Field = std::function<double(double, double, double)>;
using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

/** True if a cube of a structured grid (given by its centre) belongs to the mesh. */
using Region = std::function<bool(double, double, double)>;

Field ConstantField(double value);
/** Linear along a direction, 0 at the origin. */
Field LinearField(double x, double y, double z);
/** Distance from the origin. */
Field RadialField();
/** Smooth and not monotonic, between about -1 and 1. */
Field WavyField(double frequency);

/** Name of the point array of all these meshes. */
extern const char* const ScalarName;

Grid MakeGrid(
  const std::vector<double>& points, const std::vector<vtkIdType>& cells, const Field& field);

/** Corner tetrahedron with legs of length 1. */
Grid MakeSingleTetrahedron(const Field& field);

/** Unit cube [0, 1]^3 in 5 or 6 tetrahedra. */
Grid MakeCubeOfFive(const Field& field);
Grid MakeCubeOfSix(const Field& field);

/**
 * The cube [-1, 1]^3 of n^3 cubes, each split into 6 tetrahedra; only cubes in the region are
 * included (default: all).
 */
Grid MakeBlock(int n, const Field& field, const Region& region = nullptr);

/** Non-convex regions for makeBlock. */
Region LShape();
Region Shell(double inner, double outer);
Region Torus(double ringRadius, double tubeRadius);
Region TwoBlocks(double gap);

/** Corners of a cell of second order whose means are its further points, in VTK's order. */
std::vector<std::vector<int>> FurtherPoints(int type);

/** Moves every point of the mesh by up to amount in each direction (fixed seed). */
void Jitter(vtkUnstructuredGrid* grid, double amount, unsigned int seed);

/** Moves, then scales a mesh about the origin. */
void TransformPoints(vtkUnstructuredGrid* grid, const std::array<double, 3>& offset, double scale);

/**
 * A mesh of the data folder (MENISCUS_DATA_DIR in the environment or at configuration, otherwise
 * ../shared/data next to the project) with its first point array active; null if it does not exist.
 */
Grid ReadDataMesh(const std::string& name);

/** Any .vtu file, its first point array active if none is; null if it cannot be read. */
Grid ReadMesh(const std::string& path);

} // namespace meniscus::test

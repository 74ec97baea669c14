// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Volume/Entries/EntryTiles.h"
#include "Volume/Mesh/BoundaryTree.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/TransferFunction.h"
#include "Volume/Rays/FixedPointRays.h"
#include "Volume/Rays/PlacedVertices.h"

#include "Rendering/Backends/OpenGL/OpenGLPlacedVertices.h"
#include "Rendering/Backends/OpenGL/OpenGLPreIntegration.h"
#include "Rendering/Backends/OpenGL/OpenGLRefractedRays.h"
#include "Rendering/Backends/OpenGL/OpenGLTable.h"
#include "Rendering/Backends/RayCastTables.h"
#include "vtkWeakPointer.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace meniscus
{

struct RayCastFrame;
struct RayCastOptics;

/**
 * Tables of the ray caster's shaders, on the graphics device. All calls require the window's
 * context to be current. Errors are returned as texts, empty if there is none.
 */
class OpenGLTables
{
public:
  OpenGLTables();
  ~OpenGLTables();
  OpenGLTables(const OpenGLTables&) = delete;
  void operator=(const OpenGLTables&) = delete;

  /** Sets the window of the tables. Call this before the first upload. */
  void SetWindow(vtkOpenGLRenderWindow* window);

  /** Sends the tables that a frame reads, unless they are on the device in their versions. */
  std::string Update(RayCastTables& tables, const RayCastFrame& frame);
  /** Lists of entries per tile. Needed for optics with LongLists. */
  std::string UploadEntryTiles(const EntryTiles& tiles);
  bool HasEntryTiles() const { return this->TileFaces.IsFilled(); }

  /**
   * Names the table of a mesh that a limit in texels or the device's own forbids; empty if none.
   * @param frames  number of frames of rays that may be needed: 1, more behind a membrane.
   */
  static std::string DescribeExcess(
    const TetrahedralMesh& mesh, bool compact, int frames, std::int64_t limit);
  /** True if full cells, of 32 bytes, exceed these limits: compact ones take 20 bytes. */
  static bool NeedsCompactCells(const TetrahedralMesh& mesh, std::int64_t limit);
  /**
   * True if the table of cells has four numbers per texel: always for full cells, which are two
   * texels each, and for compact cells if the table exceeds these limits otherwise.
   */
  static bool NeedsWideCells(const TetrahedralMesh& mesh, bool compact, std::int64_t limit);

  /**
   * Places the vertices in the grid of the rays and, for rays of several legs, in the grids of
   * their frames.
   */
  std::string PlaceVertices(const FixedPointRays& rays, bool refracting);

  std::int64_t GetUploadedBytes() const { return this->UploadedBytes; }
  /** Bytes of the tables that are currently on the device. */
  std::int64_t GetTableBytes();

  /**
   * Binds the tables for entries and projections: vertices and faces of the boundary.
   * @param withTree  whether to bind the tree of the boundary, for entries without long lists.
   */
  std::vector<OpenGLTable*> ActivateRays(vtkShaderProgram* program, bool withTree);
  /** Binds the tables of the optical model. */
  std::vector<OpenGLTable*> Activate(vtkShaderProgram* program, const RayCastOptics& optics);
  OpenGLPreIntegration& GetPreIntegration() { return this->PreIntegration; }
  OpenGLRefractedRays& GetRefractedRays() { return this->RefractedRayTexels; }
  /** Binds the refracted rays. */
  void ActivateRefractedRays(vtkShaderProgram* program)
  {
    this->RefractedRayTexels.Activate(program, this->Vertices.GetNumberOfRows());
  }
  void SetUniforms(vtkShaderProgram* program, const RayCastOptics& optics) const;

  /** @param owner window of the tables; null if it no longer exists. */
  void Release(vtkOpenGLRenderWindow* owner);

private:
  std::string Upload(RayCastTable table, RayCastTables& tables, const RayCastFrame& frame);
  /**
   * The cells in 32 bytes each or, compact, in 20: the exclusive or of a cell's vertices in place
   * of those. A ray that comes by a face knows the three others. A texel holds one of these numbers
   * or, wide, four: devices limit the number of texels, but one number is fetched faster.
   */
  std::string UploadCells(const TetrahedralMesh& mesh, const RayCastOptics& optics);
  std::string UploadBoundary(const BoundaryTree& tree);
  std::string UploadBoundaryTree(const BoundaryTree& tree);
  /** @param scalars  one normalised scalar per vertex; none if they belong to cells. */
  std::string UploadVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars);
  std::string UploadCellScalars(const std::vector<float>& scalars);
  std::string UploadPreIntegration(const PreIntegrationTable& table);
  std::string UploadProperty(const VolumePropertyTables& tables);
  /** A line per pixel and refracted leg. */
  std::string UploadRefractedRays(const RayCastMembrane& membrane);
  /** All tables except for pre-integration and refracted lines. */
  std::vector<OpenGLTable*> List();
  std::string Count(OpenGLTable& table, const std::string& error);
  std::string UploadVectors(OpenGLTable& table, const std::vector<glm::vec3>& vectors);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  /** Fixed-point positions and bits of the scalars. */
  OpenGLTable Vertices;
  TableVersion VertexUploads;
  OpenGLPlacedVertices PlacedVertices;
  OpenGLTable Cells;
  bool CellsAreCompact = false;
  bool CellsAreWide = false;
  std::int64_t NumberOfCells = 0;
  OpenGLTable CellScalars;
  OpenGLTable TreeNodes;
  OpenGLTable TreeFaces;
  OpenGLTable TileBegins;
  OpenGLTable TileFaces;
  OpenGLTable NearestDepths;
  int TileColumns = 0;
  OpenGLTable VertexGradients;
  OpenGLTable VertexLight;
  OpenGLTable CellGradients;
  OpenGLTable VertexComponents;
  /**
   * Intervals of the scalar's function, of the functions of its other components, and of gradient
   * opacity.
   */
  OpenGLTable Intervals;
  /** Start of the intervals of each function, gradient opacity last, and their end. */
  std::vector<int> FunctionStarts;
  OpenGLTable Isosurfaces;
  OpenGLPreIntegration PreIntegration;
  OpenGLRefractedRays RefractedRayTexels;
  /** Versions of the tables that are on the device. */
  std::array<std::optional<TableVersions>, static_cast<std::size_t>(RayCastTable::NumberOfTables)>
    Held;
  std::int64_t UploadedBytes = 0;
};

}

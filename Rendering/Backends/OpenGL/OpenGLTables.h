// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Backends_OpenGL_OpenGLTables_h
#define meniscus_Rendering_Backends_OpenGL_OpenGLTables_h

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
#include "Rendering/Property/VolumePropertyTables.h"
#include "vtkWeakPointer.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace meniscus
{

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

  bool HasCells(bool compact) const;
  bool HasBoundary() const;
  bool HasVertices() const;
  bool HasCellScalars() const { return this->CellScalars.IsFilled(); }
  bool HasGradients() const { return this->VertexGradients.IsFilled(); }
  bool HasCellGradients() const { return this->CellGradients.IsFilled(); }
  bool HasComponents() const { return this->VertexComponents.IsFilled(); }
  bool HasPreIntegration() const { return this->PreIntegration.IsFilled(); }
  bool HasProperty() const { return this->Intervals.IsFilled(); }
  bool HasEntryTiles() const { return this->TileFaces.IsFilled(); }
  bool HasRefractedRays() const { return this->RefractedRayTexels.IsFilled(); }

  /**
   * Uploads the cells in 32 bytes each or, compact, in 20: with the exclusive or of a cell's
   * vertices instead of these. A ray that enters by a face knows the three others. The layout must
   * be that of the optics' CompactCells.
   */
  std::string UploadCells(const TetrahedralMesh& mesh, bool compact);
  /**
   * Description of the table of a mesh that exceeds a limit in texels or the device's own; empty if
   * none does.
   * @param frames number of frames of rays that may be needed: 1, more behind a membrane.
   */
  std::string DescribeExcess(
    const TetrahedralMesh& mesh, bool compact, int frames, std::int64_t limit) const;
  std::string UploadBoundary(const BoundaryTree& tree);
  /** @param scalars one normalised scalar per vertex; empty if they belong to cells. */
  std::string UploadVertices(const TetrahedralMesh& mesh, const std::vector<float>& scalars);
  /** One normalised scalar per cell. Required for optics with CellScalars. */
  std::string UploadCellScalars(const std::vector<float>& scalars);
  /** One gradient per vertex. Required for optics with VertexGradients. */
  std::string UploadGradients(const std::vector<glm::vec3>& gradients);
  /** One gradient per cell. Required for optics that use gradients of cells. */
  std::string UploadCellGradients(const std::vector<glm::vec3>& gradients);
  /** Required for optics with PreIntegrated. */
  std::string UploadPreIntegration(const PreIntegrationTable& table);
  /** Up to three further components per vertex. Required for optics with components. */
  std::string UploadComponents(const std::vector<glm::vec3>& components);
  std::string UploadProperty(const VolumePropertyTables& tables);
  /** Lists of entries per tile. Required for optics with LongLists. */
  std::string UploadEntryTiles(const EntryTiles& tiles);
  /** A line per pixel. Required for optics with Refracting. */
  std::string UploadRefractedRays(const std::vector<RefractedRayLine>& lines, int width, int height,
    const RefractionFrames& frames);

  /**
   * Places the vertices in the grid of the rays and, for optics with Refracting, in the grids of
   * their frames.
   */
  std::string PlaceVertices(const FixedPointRays& rays, bool refracting);

  std::int64_t GetUploadedBytes() const { return this->UploadedBytes; }
  /** Bytes of the tables that are currently on the device. */
  std::int64_t GetTableBytes();

  /** Binds the tables for entries and projections: vertices and the tree of the boundary. */
  std::vector<OpenGLTable*> ActivateRays(vtkShaderProgram* program);
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
  /** All tables except those of pre-integration and of refracted rays. */
  std::vector<OpenGLTable*> List();
  std::string Count(OpenGLTable& table, const std::string& error);
  std::string UploadVectors(OpenGLTable& table, const std::vector<glm::vec3>& vectors);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  /** Fixed-point positions and bits of the scalars. */
  OpenGLTable Vertices;
  std::int64_t VertexUploads = 0;
  OpenGLPlacedVertices PlacedVertices;
  OpenGLTable Cells;
  bool CellsAreCompact = false;
  OpenGLTable CellScalars;
  OpenGLTable TreeNodes;
  OpenGLTable TreeFaces;
  OpenGLTable TileBegins;
  OpenGLTable TileFaces;
  OpenGLTable NearestDepths;
  int TileColumns = 0;
  OpenGLTable VertexGradients;
  OpenGLTable CellGradients;
  OpenGLTable VertexComponents;
  /**
   * Intervals of the scalar's function, of those of its other components, and of gradient opacity.
   */
  OpenGLTable Intervals;
  /** Start of the intervals of each function, gradient opacity last, and their end. */
  std::vector<int> FunctionStarts;
  OpenGLTable Isosurfaces;
  OpenGLPreIntegration PreIntegration;
  OpenGLRefractedRays RefractedRayTexels;
  std::int64_t UploadedBytes = 0;
};

}

#endif

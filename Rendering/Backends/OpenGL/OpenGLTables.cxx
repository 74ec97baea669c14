// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLTables.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Backends/RayCastFrame.h"
#include "Volume/Refracted/RefractedRayTexels.h"

#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

namespace meniscus
{
namespace
{

// Numbers of the table of cells per cell, and per texel of the wide table.
constexpr int FullCellSize = 8;
constexpr int CompactCellSize = 5;
constexpr int WideTexelSize = 4;

/** Rows of values in texels of four, made of items on several threads, each value written once. */
template <typename T>
class Rows
{
public:
  /** @param write  write(item, values) writes `size` values of an item. */
  template <typename Item, typename Write>
  Rows(std::size_t size, const std::vector<Item>& items, const Write& write)
    : Count(size * items.size())
    , Values(new T[this->Count]) // not set to 0 first, as in a vector
  {
    ForEachInBlocks(items.size(), ThreadedLoop,
      [&](std::size_t i) { write(items[i], this->Values.get() + size * i); });
  }

  std::string SendTo(OpenGLTable& table, vtkOpenGLRenderWindow* window, int texelsPerRow) const
  {
    return table.Upload(window, this->Values.get(), this->Count, 4, texelsPerRow);
  }

private:
  std::size_t Count;
  std::unique_ptr<T[]> Values;
};

std::vector<std::int32_t> CompactCells(const TetrahedralMesh& mesh)
{
  const auto& cells = mesh.GetCells();
  // Rounded up to whole texels.
  const std::size_t size = CompactCellSize * cells.size();
  std::vector<std::int32_t> values((size + WideTexelSize - 1) / WideTexelSize * WideTexelSize);
  ForEachInBlocks(cells.size(), ThreadedLoop,
    [&cells, &values](std::size_t c)
    {
      const auto& v = cells[c].Vertices;
      std::int32_t* value = &values[CompactCellSize * c];
      *value = v[0] ^ v[1] ^ v[2] ^ v[3];
      std::copy(cells[c].Links.begin(), cells[c].Links.end(), value + 1);
    });
  return values;
}

/** Size of the table of cells in numbers. */
std::int64_t SizeOfCells(const TetrahedralMesh& mesh, bool compact)
{
  return (compact ? CompactCellSize : FullCellSize) * mesh.GetNumberOfCells();
}

/** Largest number of texels of a table: `limit`, or the device's limit if that is smaller. */
std::int64_t LimitOfDevice(std::int64_t limit)
{
  GLint ofDevice = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &ofDevice);
  return std::min(limit, static_cast<std::int64_t>(ofDevice));
}

}

//------------------------------------------------------------------------------
OpenGLTables::OpenGLTables() = default;

//------------------------------------------------------------------------------
OpenGLTables::~OpenGLTables() = default;

//------------------------------------------------------------------------------
void OpenGLTables::SetWindow(vtkOpenGLRenderWindow* window)
{
  this->Window = window;
}

//------------------------------------------------------------------------------
std::string OpenGLTables::Update(RayCastTables& tables, const RayCastFrame& frame)
{
  for (const RayCastTableState& wanted : tables.ListWanted(frame))
  {
    std::optional<TableVersions>& held = this->Held[static_cast<std::size_t>(wanted.Table)];
    const bool isSameLayout = wanted.Table != RayCastTable::Cells ||
      (frame.Optics.CompactCells == this->CellsAreCompact &&
        frame.Optics.WideCells == this->CellsAreWide);
    if (held == wanted.Versions && isSameLayout)
    {
      continue;
    }
    held.reset();
    const std::string error = this->Upload(wanted.Table, tables, frame);
    if (!error.empty())
    {
      return error;
    }
    held = wanted.Versions;
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string OpenGLTables::Upload(
  RayCastTable table, RayCastTables& tables, const RayCastFrame& frame)
{
  VolumeInput& input = tables.Input;
  switch (table)
  {
    case RayCastTable::Cells:
      return this->UploadCells(input.GetMesh(), frame.Optics);
    case RayCastTable::Boundary:
      return this->UploadBoundary(input.GetBoundaryTree());
    case RayCastTable::BoundaryTree:
      return this->UploadBoundaryTree(input.GetBoundaryTree());
    case RayCastTable::Vertices:
      return this->UploadVertices(input.GetMesh(), input.GetScalars());
    case RayCastTable::CellScalars:
      return this->UploadCellScalars(input.GetCellScalars());
    case RayCastTable::VertexGradients:
      return this->UploadVectors(this->VertexGradients, tables.VertexGradients.GetValues());
    case RayCastTable::Illumination:
      return this->UploadVectors(this->VertexLight, tables.Illumination.GetValues());
    case RayCastTable::CellGradients:
      return this->UploadVectors(this->CellGradients, tables.CellGradients.GetValues());
    case RayCastTable::Components:
      return this->UploadVectors(this->VertexComponents, tables.Components.GetValues());
    case RayCastTable::Functions:
      return this->UploadProperty(tables.Property);
    case RayCastTable::PreIntegration:
      return this->UploadPreIntegration(tables.PreIntegration.GetTable());
    case RayCastTable::RefractedRays:
      return this->UploadRefractedRays(tables.Membrane);
    default:
      return "a table is unknown";
  }
}

//------------------------------------------------------------------------------
std::string OpenGLTables::Count(OpenGLTable& table, const std::string& error)
{
  this->UploadedBytes += table.GetBytes();
  return error;
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadCells(const TetrahedralMesh& mesh, const RayCastOptics& optics)
{
  static_assert(sizeof(TetrahedralMesh::Cell) == FullCellSize * sizeof(std::int32_t),
    "a full cell as it is on the host");
  const int perTexel = optics.WideCells ? WideTexelSize : 1;
  std::string error;
  if (optics.CompactCells)
  {
    const std::vector<std::int32_t> values = CompactCells(mesh);
    error = this->Cells.Upload(this->Window, values.data(), values.size(), perTexel, 1);
  }
  else
  {
    const auto* values = reinterpret_cast<const std::int32_t*>(mesh.GetCells().data());
    const auto size = static_cast<std::size_t>(SizeOfCells(mesh, false));
    error = this->Cells.Upload(this->Window, values, size, perTexel, 1);
  }
  this->NumberOfCells = mesh.GetNumberOfCells();
  this->CellsAreCompact = optics.CompactCells;
  this->CellsAreWide = optics.WideCells;
  return this->Count(this->Cells, error);
}

//------------------------------------------------------------------------------
std::string OpenGLTables::DescribeExcess(
  const TetrahedralMesh& mesh, bool compact, int frames, std::int64_t limit)
{
  const std::int64_t largest = LimitOfDevice(limit);
  const std::int64_t texels =
    std::max((SizeOfCells(mesh, compact) + WideTexelSize - 1) / WideTexelSize,
      frames * mesh.GetNumberOfVertices());
  return texels <= largest ? std::string()
                           : "a table of " + std::to_string(texels) + " texels for " +
      std::to_string(mesh.GetNumberOfCells()) +
      " tetrahedra exceeds the graphics device's limit of " + std::to_string(largest);
}

//------------------------------------------------------------------------------
bool OpenGLTables::NeedsCompactCells(const TetrahedralMesh& mesh, std::int64_t limit)
{
  return SizeOfCells(mesh, false) > WideTexelSize * LimitOfDevice(limit);
}

//------------------------------------------------------------------------------
bool OpenGLTables::NeedsWideCells(const TetrahedralMesh& mesh, bool compact, std::int64_t limit)
{
  return !compact || SizeOfCells(mesh, true) > LimitOfDevice(limit);
}

//------------------------------------------------------------------------------
std::vector<OpenGLTable*> OpenGLTables::List()
{
  return { &this->Vertices, &this->Cells, &this->CellScalars, &this->TreeNodes, &this->TreeFaces,
    &this->TileBegins, &this->TileFaces, &this->NearestDepths, &this->VertexGradients,
    &this->VertexLight, &this->CellGradients, &this->VertexComponents, &this->Intervals,
    &this->Isosurfaces };
}

//------------------------------------------------------------------------------
std::int64_t OpenGLTables::GetTableBytes()
{
  std::int64_t bytes = this->PreIntegration.GetBytes() + this->RefractedRayTexels.GetBytes() +
    this->PlacedVertices.GetTable().GetBytes();
  for (const OpenGLTable* table : this->List())
  {
    bytes += table->GetBytes();
  }
  return bytes;
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadBoundaryTree(const BoundaryTree& tree)
{
  // A node's indices are stored as floats, which represent integers up to 2^24 exactly.
  const std::int64_t largestIndex =
    static_cast<std::int64_t>(std::max(tree.GetNodes().size(), tree.GetFaces().size()));
  if (largestIndex > (std::int64_t{ 1 } << 24))
  {
    return "a mesh with " + std::to_string(tree.GetFaces().size()) +
      " boundary faces exceeds the limit of 8388608";
  }
  const Rows<float> nodes(8, tree.GetNodes(),
    [](const BoundaryTree::Node& node, float* value)
    {
      const float values[8] = { node.Center.x, node.Center.y, node.Center.z,
        static_cast<float>(node.Skip), node.Half.x, node.Half.y, node.Half.z,
        static_cast<float>(node.Face) };
      std::copy_n(values, 8, value);
    });
  return this->Count(this->TreeNodes, nodes.SendTo(this->TreeNodes, this->Window, 2));
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadBoundary(const BoundaryTree& tree)
{
  const Rows<std::int32_t> faces(4, tree.GetFaces(),
    [](const BoundaryFace& face, std::int32_t* value)
    {
      const auto& v = face.Vertices;
      // Ascending; the first number tells the order in which the normal points outwards.
      const bool ascending = face.IsAscending();
      value[0] = ascending ? v[0] : ~v[1];
      value[1] = ascending ? v[1] : v[0];
      value[2] = v[2];
      value[3] = face.CellFace;
    });
  return this->Count(this->TreeFaces, faces.SendTo(this->TreeFaces, this->Window, 1));
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadEntryTiles(const EntryTiles& tiles)
{
  const auto& begins = tiles.GetBegins();
  const auto& faces = tiles.GetFaces();
  const auto& depths = tiles.GetNearestDepths();
  this->TileColumns = tiles.GetNumberOfColumns();
  std::string error = this->Count(
    this->TileBegins, this->TileBegins.Upload(this->Window, begins.data(), begins.size(), 1, 1));
  // A texture must not be empty.
  const std::int32_t none = 0;
  error = error.empty()
    ? this->Count(this->TileFaces,
        this->TileFaces.Upload(this->Window, faces.empty() ? &none : faces.data(),
          std::max<std::size_t>(faces.size(), 1), 1, 1))
    : error;
  return error.empty()
    ? this->Count(this->NearestDepths,
        this->NearestDepths.Upload(this->Window, depths.data(), depths.size(), 1, 1))
    : error;
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadVertices(
  const TetrahedralMesh& mesh, const std::vector<float>& scalars)
{
  // Differences of coordinates have to fit in 32 bits.
  constexpr std::int32_t largest = (std::int32_t{ 1 } << 30) - 1;
  const std::vector<glm::ivec3>& positions = mesh.GetFixedPositions();
  const Rows<std::int32_t> values(4, positions,
    [&](const glm::ivec3& position, std::int32_t* value)
    {
      const glm::ivec3 p = glm::clamp(position, -largest, largest);
      const float scalar = scalars.empty() ? 0.0f : scalars[&position - positions.data()];
      value[0] = p.x;
      value[1] = p.y;
      value[2] = p.z;
      std::memcpy(value + 3, &scalar, sizeof(scalar));
    });
  this->VertexUploads.Bump();
  return this->Count(this->Vertices, values.SendTo(this->Vertices, this->Window, 1));
}

//------------------------------------------------------------------------------
std::string OpenGLTables::PlaceVertices(const FixedPointRays& rays, bool refracting)
{
  std::vector<OpenGLPlacedVertices::FrameRows> frames{ rays.GetFixedPointRows() };
  if (refracting)
  {
    const auto& turned = this->RefractedRayTexels.GetFixedPointRows();
    frames.insert(frames.end(), turned.begin(), turned.end());
  }
  return this->PlacedVertices.Update(this->Window, this->Vertices, this->VertexUploads, frames);
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadCellScalars(const std::vector<float>& scalars)
{
  const std::string error =
    this->CellScalars.Upload(this->Window, scalars.data(), scalars.size(), 1, 1);
  return this->Count(this->CellScalars, error);
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadVectors(OpenGLTable& table, const std::vector<glm::vec3>& vectors)
{
  const Rows<float> values(4, vectors,
    [](const glm::vec3& vector, float* value)
    {
      value[0] = vector.x;
      value[1] = vector.y;
      value[2] = vector.z;
      value[3] = 0.0f;
    });
  return this->Count(table, values.SendTo(table, this->Window, 1));
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadPreIntegration(const PreIntegrationTable& table)
{
  const std::string error = this->PreIntegration.Upload(this->Window, table);
  this->UploadedBytes += this->PreIntegration.GetBytes();
  return error;
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadRefractedRays(const RayCastMembrane& membrane)
{
  const RayLegs legs = membrane.GetLegs();
  std::vector<RefractedRayLine> lines;
  LayOutRefractedRays(legs, membrane.GetFrames(), ThreadedLoop, lines);
  const std::string error =
    this->RefractedRayTexels.Upload(this->Window, lines, legs.GetWidth(), membrane.GetFrames());
  this->UploadedBytes += this->RefractedRayTexels.GetBytes();
  return error;
}

//------------------------------------------------------------------------------
std::string OpenGLTables::UploadProperty(const VolumePropertyTables& tables)
{
  std::vector<float> values;
  this->FunctionStarts.assign(1, 0);
  const auto append = [this, &values](const std::vector<TransferFunctionInterval>& intervals)
  {
    const int start = this->FunctionStarts.back();
    this->FunctionStarts.push_back(start + static_cast<int>(intervals.size()));
    for (const auto& i : intervals)
    {
      values.insert(values.end(),
        { i.Lower, i.Upper, i.Attenuation, i.AttenuationSlope, i.Color.r, i.Color.g, i.Color.b,
          0.0f, i.ColorSlope.r, i.ColorSlope.g, i.ColorSlope.b, 0.0f });
    }
  };
  append(tables.GetIntervals());
  for (const auto& intervals : tables.GetOtherIntervals())
  {
    append(intervals);
  }
  append(tables.GetGradientIntervals());
  std::string error = this->Intervals.Upload(this->Window, values.data(), values.size(), 4, 3);
  if (!this->Count(this->Intervals, error).empty())
  {
    return error;
  }

  this->Isosurfaces.Release(this->Window);
  if (tables.GetIsosurfaces().empty())
  {
    return std::string();
  }
  values.clear();
  for (const Isosurface& surface : tables.GetIsosurfaces())
  {
    const glm::vec3& color = surface.Color;
    values.insert(values.end(),
      { surface.Scalar, surface.Opacity, 0.0f, 0.0f, color.r, color.g, color.b, 0.0f });
  }
  error = this->Isosurfaces.Upload(this->Window, values.data(), values.size(), 4, 2);
  return this->Count(this->Isosurfaces, error);
}

//------------------------------------------------------------------------------
std::vector<OpenGLTable*> OpenGLTables::Activate(
  vtkShaderProgram* program, const RayCastOptics& optics)
{
  std::vector<OpenGLTable*> active;
  const auto activate = [&active, program](OpenGLTable& table, const char* name)
  {
    table.Activate(program, name);
    active.push_back(&table);
  };
  activate(this->Cells, "cells");
  if (optics.LongLists)
  {
    activate(this->TileBegins, "tileBegins");
    activate(this->TileFaces, "tileFaces");
    activate(this->NearestDepths, "nearestDepths");
  }
  if (optics.UsesGradients())
  {
    activate(this->Vertices, "modelVertices");
  }
  if (!optics.PreIntegrated)
  {
    activate(this->Intervals, "intervals");
  }
  if (optics.CellScalars)
  {
    activate(this->CellScalars, "cellScalars");
  }
  if (optics.VertexGradients)
  {
    activate(this->VertexGradients, "vertexGradients");
  }
  if (optics.Illuminated)
  {
    activate(this->VertexLight, "vertexLight");
  }
  if (optics.UsesCellGradients())
  {
    activate(this->CellGradients, "cellGradients");
  }
  if (optics.HasComponents())
  {
    activate(this->VertexComponents, "vertexComponents");
  }
  if (this->Isosurfaces.IsFilled())
  {
    activate(this->Isosurfaces, "surfaces");
  }
  return active;
}

//------------------------------------------------------------------------------
void OpenGLTables::SetUniforms(vtkShaderProgram* program, const RayCastOptics& optics) const
{
  program->SetUniformi("numberOfCells", static_cast<int>(this->NumberOfCells));
  program->SetUniformi("tileColumns", this->TileColumns);
  program->SetUniformi("numberOfSurfaces", static_cast<int>(this->Isosurfaces.GetNumberOfRows()));
  const std::vector<int>& starts = this->FunctionStarts;
  const int first = starts[starts.size() - 2];
  program->SetUniformi("firstGradientInterval", first);
  program->SetUniformi("numberOfGradientIntervals", starts.back() - first);
  program->SetUniformi("numberOfIntervals", starts[1]);
  if (optics.HasComponents())
  {
    std::vector<int> sizes(starts.size());
    std::adjacent_difference(starts.begin(), starts.end(), sizes.begin());
    program->SetUniform1iv("functionStart", optics.NumberOfFunctions, starts.data());
    program->SetUniform1iv("functionSize", optics.NumberOfFunctions, sizes.data() + 1);
  }
}

//------------------------------------------------------------------------------
std::vector<OpenGLTable*> OpenGLTables::ActivateRays(vtkShaderProgram* program, bool withTree)
{
  OpenGLTable& placed = this->PlacedVertices.GetTable();
  placed.Activate(program, "vertices");
  this->TreeFaces.Activate(program, "treeFaces");
  if (!withTree)
  {
    return { &placed, &this->TreeFaces };
  }
  this->TreeNodes.Activate(program, "treeNodes");
  program->SetUniformi("numberOfNodes", static_cast<int>(this->TreeNodes.GetNumberOfRows()));
  return { &placed, &this->TreeFaces, &this->TreeNodes };
}

//------------------------------------------------------------------------------
void OpenGLTables::Release(vtkOpenGLRenderWindow* owner)
{
  for (OpenGLTable* table : this->List())
  {
    table->Release(owner);
  }
  this->PlacedVertices.Release(owner);
  this->PreIntegration.Release(owner);
  this->RefractedRayTexels.Release(owner);
  this->Held = {};
}

}

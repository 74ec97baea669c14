// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Filters/Membrane/MembraneExtraction.h"
#include "Filters/Membrane/MembraneMessages.h"
#include "Refraction/Surface/RefractingSurface.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <memory>

class vtkImplicitFunction;
class vtkPolyData;

namespace meniscus
{

/**
 * Objects that a membrane is read from, and their modification times. The objects are compared
 * only: one that is created at the address of a deleted one has a later time.
 */
struct MembraneOrigin
{
  const vtkPolyData* Source = nullptr;
  vtkMTimeType SourceTime = 0;
  const vtkImplicitFunction* Function = nullptr;
  vtkMTimeType FunctionTime = 0;
  bool Curves = false;

  MembraneOrigin() = default;
  MembraneOrigin(vtkPolyData* source, vtkImplicitFunction* function, bool curves);
  bool operator==(const MembraneOrigin& other) const;
};

/**
 * A refracting surface and the objects that it is read from. It is built again only if its values
 * change, whatever the modification times are.
 */
class SourceSurface
{
public:
  /**
   * Object in which a changed shape is built. InPlace keeps the topology of the shape and is
   * faster. NewObject gives each shape an address of its own, and leaves copies of this object
   * unchanged.
   */
  enum class Change
  {
    InPlace,
    NewObject
  };

  explicit SourceSurface(Change change = Change::InPlace)
    : UsedChange(change)
  {
  }

  /**
   * Reads the surface if the objects have changed; with a function, its points are moved onto the
   * function's zero set. Patches are fitted if it `curves`. Returns true if the shape was built.
   */
  bool Update(vtkPolyData* source, vtkImplicitFunction* function, bool curves);
  /** Reverses normals and windings, also of shapes that are read later. */
  void Turn();

  /** Describes how the surface was read. Returns false, with an error, if it cannot be used. */
  bool Report(SceneMessages& messages) const;

  /** The surface that was built last; empty before. */
  const std::shared_ptr<RefractingSurface>& GetSurface() const { return this->Surface; }
  const Membrane& GetMembrane() const { return this->Surface->GetMembrane(); }
  const MembraneOrigin& GetOrigin() const { return this->Origin; }
  /** True if the surface can be used. */
  bool IsReady() const { return this->Status == MembraneStatus::Ready; }
  bool IsTurned() const { return this->Turned; }
  /** Number of shapes that were built. */
  std::int64_t GetNumberOfBuilds() const { return this->Builds; }

private:
  void Build();

  Change UsedChange;
  MembraneOrigin Origin;
  MembraneArrays Arrays; ///< of the turned surface, if it is turned
  std::size_t Lost = 0;  ///< number of points that could not be moved to the exact surface
  bool Turned = false;
  MembraneStatus Status = MembraneStatus::Empty;
  std::shared_ptr<RefractingSurface> Surface = std::make_shared<RefractingSurface>();
  std::int64_t Builds = 0;
};

}

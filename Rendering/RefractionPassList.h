// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Pass/LocalPlaces.h"
#include "Rendering/Pass/ObjectShader.h"
#include "Rendering/Pass/WaveLight.h"

#include "Volume/Optics/RefractionMedium.h"

#include "vtkActor.h"
#include "vtkProp3D.h"
#include "vtkRefractedGeometryFilter.h"
#include "vtkSmartPointer.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkVolume.h"

#include <memory>
#include <string>
#include <vector>

class vtkPolyDataMapper;
class vtkRenderer;

namespace meniscus
{

/** The ray caster that draws a volume; null if another mapper does. */
inline vtkTetrahedraRayCastMapper* RayCasterOf(vtkVolume* volume)
{
  return vtkTetrahedraRayCastMapper::SafeDownCast(volume->GetMapper());
}

/** An object or a volume behind a membrane, or an object that it reflects. */
struct Refraction
{
  vtkSmartPointer<vtkActor> Membrane;
  /** Actor of a filter's virtual geometry, or a volume. */
  vtkSmartPointer<vtkProp3D> Object;
  vtkSmartPointer<vtkRefractedGeometryFilter> Filter;
  /** True if it is seen in the membrane, not through it. */
  bool IsReflection = false;
  bool IsLitInTrueSpace = false;
  /** Last error about its lighting. */
  std::string LightingError{};
  /** Light of lamps in front of a membrane that is not flat. */
  std::shared_ptr<WaveLight> Waves{};
  /** True if its shader reads the light from tables. */
  bool ReadsTables = false;
  /** True if objects cast shadows on it. */
  bool HasShadows = false;
  /** Parts of the way to the object that its shader computes. */
  SeenThrough Seen{};
  /** Array of sight points that its mapper's shader gets. */
  std::string SightArray{};

  vtkVolume* GetVolume() const { return vtkVolume::SafeDownCast(this->Object); }
  /** Mapper of an object; null for others. */
  vtkPolyDataMapper* GetMapper() const;
  /** True for visible, opaque surfaces behind the membrane. */
  bool CastsShadows() const;
  /** Index of refraction behind each interface, relative to the medium in front of the first. */
  std::vector<double> ListRelativeIndices() const;

  /** Parts of the way to an object of the filter. */
  SeenThrough ListSeenThrough(const RefractionMedium& medium) const;

  /**
   * Decides whether the object is lit in true space, and maps the arrays that this needs. Returns
   * the text of a new error; empty if there is none.
   */
  std::string ChooseLighting(bool isWanted);
  /** Prepares the places that the shader of an object gets that is lit in true space. */
  void PreparePlaces(vtkRenderer* renderer, LocalPlaces& places) const;
};

/** Objects and volumes in the order in which they were added. */
class RefractionList
{
public:
  std::vector<Refraction> All;

  /** Membranes in the order in which they were added. */
  std::vector<vtkActor*> ListMembranes() const;
  /** Visible objects, without volumes. */
  std::vector<vtkProp*> ListObjects(vtkActor* membrane, bool areReflections) const;
  /** True if a volume was added behind the membrane. */
  bool HasVolume(vtkActor* membrane) const;
  /** The first of a membrane. @pre there is one */
  const Refraction& FirstOf(vtkActor* membrane) const;
  /** The object or volume as it was added; null if it was not. */
  const Refraction* Find(vtkProp* object) const;
  void Remove(vtkProp3D* object);
  /** Widens the camera's clipping range to the membranes in view and the objects behind them. */
  void AdjustClippingRange(vtkRenderer* renderer) const;
};

}

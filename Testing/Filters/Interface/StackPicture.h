// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Views through surfaces in sequence: the filter's and those of exact rays. */
#pragma once

#include "ComparisonSheet.h"
#include "ExactStack.h"
#include "Refraction/Surface/MediaChain.h"
#include "StackFilterHelpers.h"

namespace meniscus::test
{

struct StackPicture
{
  std::string Name;
  std::vector<reference::MembraneMesh> Meshes; ///< one per interface
  std::vector<InterfaceMedia> Media;
  PixelCamera Camera;
  double Tolerance = 0.005; ///< the filter's default
  /** Largest part of the covered pixels that may differ from traced rays. */
  double Differing = 1e-3;
  bool HasNormals = true; ///< false: the filter computes the normals of the surfaces

  /** Connects the surfaces and the list to a filter; interfaces of one body share a data set. */
  template <typename Filter>
  void SetInterfaces(Filter* filter) const
  {
    filter->SetInterfaces(vtkNew<vtkRefractingInterfaceCollection>());
    vtkSmartPointer<vtkPolyData> surface;
    for (std::size_t i = 0; i < this->Meshes.size(); ++i)
    {
      if (i == 0 || this->Meshes[i].Points != this->Meshes[i - 1].Points)
      {
        surface = MakeMembrane(this->Meshes[i], this->HasNormals);
      }
      AddInterface(filter, surface, this->Media[i].Exterior, this->Media[i].Interior);
    }
  }

  /** The object as the camera's position sees it, with all images or one per point. */
  vtkSmartPointer<vtkRefractedGeometryFilter> MakeFilter(vtkPolyData* object, bool all) const;
};

/** True for points within the outline of the surfaces. */
using Outline = std::function<bool(const glm::dvec3&)>;
/** A square or a circle around the y axis. */
Outline MakeSquareOutline(double side);
Outline MakeRoundOutline(double radius);

/** Path through the surfaces within their outline. */
std::optional<reference::ExactPath> TraceWithin(
  const std::vector<reference::ExactSurface>& surfaces, const Outline& outline,
  const glm::dvec3& eye, const glm::dvec3& direction);

/** Last legs of these paths. */
RayTracer MakeExactRays(const std::vector<reference::ExactSurface>& surfaces, const glm::dvec3& eye,
  const Outline& outline);

/**
 * A column of the sheet: all images of an object, and traced rays. A pixel differs if it shows
 * another place, by more than half a pixel, or is covered in one of the two pictures only.
 */
void ExpectSameView(ComparisonSheet& sheet, int column, const StackPicture& picture,
  vtkPolyData* object, const PlacePicture& traced, const PlaceColour& colour);

}

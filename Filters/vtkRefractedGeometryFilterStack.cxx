// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Several interfaces: checks, and images of points.
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "Filters/Membrane/StackInput.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <vector>

//------------------------------------------------------------------------------
// Text of the error for properties that several interfaces do not support; empty if none.
std::string vtkRefractedGeometryFilter::FindUnsupported()
{
  if (this->Mode == REFLECTION)
  {
    return "Mode REFLECTION mirrors at one interface, and the list has more";
  }
  const std::string model = meniscus::FindModelFault(this->MembraneModel == CURVED);
  if (!model.empty())
  {
    return model;
  }
  const bool isLightAtEye =
    std::all_of(this->LightDirection, this->LightDirection + 3, [](double c) { return c == 0.0; });
  if (this->VirtualNormals && !isLightAtEye)
  {
    return "With several refracting interfaces, VirtualNormals need a light at the eye, "
           "LightDirection (0, 0, 0)";
  }
  return std::string();
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::UpdateStack(vtkInformationVector* membranes)
{
  meniscus::SceneMessages messages;
  messages.Error = this->FindUnsupported();
  const bool isReady = meniscus::UpdateStack(
    this->Internals->Stack, membranes, 1, this->Interfaces, this->GetEye(), messages);
  meniscus::Report(this, messages);
  return isReady;
}

//------------------------------------------------------------------------------
int vtkRefractedGeometryFilter::RequestStack(
  vtkPolyData* input, vtkInformationVector* membranes, vtkPolyData* output)
{
  if (this->UpdateStack(membranes))
  {
    this->WriteImages(input, output);
  }
  return 1;
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::vtkInternals::SolveStack(
  vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block)
{
  if (block.Rays == this->GetRays() && !block.All)
  {
    return true;
  }
  const meniscus::StackSolver& solver = this->Stack.GetSolver();
  const std::size_t count = block.Points.size() / 3;
  block.All = false;
  block.Images.reset();
  block.Rays = -1;
  block.Vertices.assign(count, meniscus::VirtualVertex());
  block.Stack.Points.assign(count, meniscus::StackDetail());
  block.Stack.Interfaces = solver.GetStack().GetNumberOfInterfaces();
  block.Stack.Legs.assign(count * block.Stack.Interfaces, 0.0);
  const bool done = this->Run(self, 0.0, 1.0, static_cast<vtkIdType>(count),
    static_cast<vtkIdType>(meniscus::StackSolver::Chain),
    [&block, &solver](std::size_t begin, std::size_t end)
    {
      solver.Solve(block.Points.data(), begin, end, block.Vertices.data(),
        block.Stack.Points.data(), block.Stack.Legs.data());
    });
  if (!done)
  {
    return false;
  }
  block.Rays = this->GetRays();
  for (const meniscus::VirtualVertex& vertex : block.Vertices)
  {
    this->Count(vertex.State);
  }
  return true;
}

//------------------------------------------------------------------------------
std::vector<double> vtkRefractedGeometryFilter::GetRelativeIndicesOfRefraction()
{
  const auto& links = this->Internals->Stack.GetSolver().GetStack().GetLinks();
  if (this->Interfaces->GetNumberOfItems() < 2 || links.empty())
  {
    return { this->GetInteriorIndexOfRefraction() / this->GetExteriorIndexOfRefraction() };
  }
  std::vector<double> indices;
  for (const auto& link : links)
  {
    indices.push_back(link.Passage.Behind / links.front().Passage.Before);
  }
  return indices;
}

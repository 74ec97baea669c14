// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// RequestData for several interfaces.
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "Filters/Membrane/StackInput.h"
#include "Filters/Output/VirtualPolyData.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterfaceCollection.h"

#include <algorithm>
#include <memory>
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
  vtkInternals& internals = *this->Internals;
  if (!this->UpdateStack(membranes))
  {
    return 1;
  }
  internals.FailedInRun = 0;
  const meniscus::StackScene& scene = internals.Stack;
  const vtkTypeInt64 undecided = this->GetNumberOfUndecidedSearches();
  meniscus::SolvedBlock& block = internals.GetBlock(input);
  const bool all = this->Images == ALL_IMAGES;
  if (!(all ? internals.SolveAllOfStack(this, input, block) : internals.SolveStack(this, block)))
  {
    return 1;
  }
  const meniscus::OutputOptions options = internals.GetStackOptions(this);
  meniscus::OutputOptions plain = options;
  plain.VirtualNormals = false;
  const meniscus::Membrane& first = scene.GetFirstMembrane();
  block.Assembly.IsReady = false;
  const meniscus::VirtualPolyDataReport report = all
    ? meniscus::BuildImagePolyData(input, block.Topology, *block.ImagesOfStack, block.Cells, first,
        plain, block.Assembly, output)
    : meniscus::BuildVirtualPolyData(input, block.Vertices, block.Selection, first, plain, output);
  if (all)
  {
    meniscus::AddStackImageArrays(
      input, *block.ImagesOfStack, block.Cells, scene.GetSolver(), options, output);
  }
  else
  {
    meniscus::AddStackArrays(input, block.Vertices, block.Stack, options, output);
  }
  block.Kept.Reuse(output);
  this->ReportUndecided(this->GetNumberOfUndecidedSearches() - undecided);
  this->ReportPoints(internals.FailedInRun, output->GetNumberOfPoints() > 0, input);
  this->ReportCells(report, input);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::vtkInternals::SolveStack(
  vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block)
{
  const vtkTypeInt64 update = this->Stack.GetNumberOfEyeUpdates();
  if (block.StackUpdate == update && !block.ImagesOfStack)
  {
    return true;
  }
  const meniscus::StackSolver& solver = this->Stack.GetSolver();
  const std::size_t count = block.Points.size() / 3;
  block.ForgetImages();
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
  block.StackUpdate = update;
  for (const meniscus::VirtualVertex& vertex : block.Vertices)
  {
    this->Count(vertex.State);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::vtkInternals::SolveAllOfStack(
  vtkRefractedGeometryFilter* self, vtkPolyData* input, meniscus::SolvedBlock& block)
{
  const double tolerance = self->GetTolerance();
  const vtkTypeInt64 update = this->Stack.GetNumberOfEyeUpdates();
  block.UpdateTopology();
  if (block.StackUpdate != update || !block.ImagesOfStack)
  {
    const std::size_t count = block.Points.size() / 3;
    block.ForgetImages();
    block.CellsReady = false;
    block.Vertices.clear();
    block.ImagesOfStack = std::make_unique<meniscus::StackImages>(this->Stack.GetSolver());
    meniscus::StackImages& images = *block.ImagesOfStack;
    images.SetPoints(block.Points.data(), count);
    if (!this->Run(self, 0.0, 0.5, static_cast<vtkIdType>(count),
          static_cast<vtkIdType>(meniscus::StackImages::Chunk),
          [&images](std::size_t begin, std::size_t end) { images.SolvePoints(begin, end); }))
    {
      return false;
    }
    images.FinishPoints();
    block.StackUpdate = update;
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Count(images.GetState(i));
    }
  }
  if (block.CellsReady && block.Tolerance == tolerance && block.ClosesSeams == self->CloseSeams)
  {
    return true;
  }
  block.CellsReady = false;
  block.Tolerance = tolerance;
  block.ClosesSeams = self->CloseSeams;
  block.Cells = meniscus::AllImages();
  block.ImagesOfStack->SetTolerance(tolerance);
  block.CellsReady = meniscus::MapCells(
    input, block.Topology, *block.ImagesOfStack, self->CloseSeams,
    [this, self](std::size_t parts, const meniscus::RangeBody& body)
    { return this->Run(self, 0.5, 1.0, static_cast<vtkIdType>(parts), 1, body); },
    block.Cells);
  return block.CellsReady;
}

//------------------------------------------------------------------------------
meniscus::OutputOptions vtkRefractedGeometryFilter::vtkInternals::GetStackOptions(
  vtkRefractedGeometryFilter* self) const
{
  meniscus::OutputOptions options = this->GetOptions(self);
  const meniscus::RefractionStack& stack = this->Stack.GetSolver().GetStack();
  options.Eye = stack.GetEye() + stack.GetOrigin();
  if (!stack.GetLinks().empty())
  {
    options.Exterior = stack.GetLinks().front().Passage.Before;
    options.Interior = stack.GetLinks().front().Passage.Behind;
  }
  return options;
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

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/vtkRefractedGeometryFilterInternals.h"

#include "Common/CoherentOrder.h"
#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Filters/Object/ViewSelection.h"
#include "Filters/Output/VirtualPolyData.h"
#include "Refraction/Images/EdgeSubdivision.h"

#include "vtkCamera.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

// Number of points or facets that a thread takes at once: tens of microseconds of work.
constexpr vtkIdType Grain = 128;

// Number of times that progress is reported and abort checked while points are solved. A step has
// enough grains to keep all threads of a large machine busy.
constexpr vtkIdType ProgressSteps = 100;
constexpr vtkIdType SmallestStep = 256;
static_assert(
  Grain % meniscus::CurvedMembraneSolver::Chain == 0 && Grain % meniscus::CellImages::Chunk == 0,
  "Ranges are made of whole chains and chunks");

// Chunks are solved side by side, as long as there are enough for all threads.
vtkIdType GetGrainOfChunks(vtkIdType chunks)
{
  return std::clamp<vtkIdType>(chunks / vtkSMPTools::GetEstimatedNumberOfThreads(), 1,
    meniscus::CurvedMembraneSolver::ChainsAtOnce);
}

}

//------------------------------------------------------------------------------
// The cache of a block lives as long as its data object, so that composite data with any number of
// blocks stays cached and replaced data objects are dropped.
meniscus::SolvedBlock& vtkRefractedGeometryFilter::vtkInternals::GetBlock(vtkPolyData* input)
{
  this->Blocks.remove_if([](const meniscus::SolvedBlock& block) { return !block.Source; });
  auto block = std::find_if(this->Blocks.begin(), this->Blocks.end(),
    [input](const meniscus::SolvedBlock& candidate) { return candidate.Source == input; });
  if (block == this->Blocks.end())
  {
    block = this->Blocks.emplace(this->Blocks.end());
    block->Source = input;
  }
  block->UpdatePoints();
  return *block;
}

//------------------------------------------------------------------------------
// Runs `body` while progress goes from `from` to `to`, and checks for abort in between.
bool vtkRefractedGeometryFilter::vtkInternals::Run(vtkRefractedGeometryFilter* self, double from,
  double to, vtkIdType count, vtkIdType grain, const meniscus::RangeBody& body)
{
  // Smaller grains are of chunks or parts, each of which is as much work as a grain of points.
  const vtkIdType smallest =
    grain < Grain ? (SmallestStep + grain - 1) / grain * grain : SmallestStep * grain;
  const vtkIdType step = std::max((count / ProgressSteps / grain + 1) * grain, smallest);
  for (vtkIdType first = 0; first < count; first += step)
  {
    const vtkIdType last = std::min(first + step, count);
    // Threads take whole grains, so the contents of a grain do not depend on the threads.
    meniscus::ThreadedFor(0, (last - first + grain - 1) / grain, 1,
      [&body, first, last, grain](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          body(static_cast<std::size_t>(first + i * grain),
            static_cast<std::size_t>(std::min(first + (i + 1) * grain, last)));
        }
      });
    self->UpdateProgress(
      from + (to - from) * static_cast<double>(last) / static_cast<double>(count));
    if (self->GetAbortExecute())
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::vtkInternals::Count(meniscus::ImageState state)
{
  ++this->SolvedVertices;
  this->FailedSolves += state == meniscus::ImageState::NotFinite;
  this->FailedInRun += state == meniscus::ImageState::NotFinite;
  this->VerticesWithoutImage += state == meniscus::ImageState::NoImage;
}

//------------------------------------------------------------------------------
meniscus::OutputOptions vtkRefractedGeometryFilter::vtkInternals::GetOptions(
  vtkRefractedGeometryFilter* self) const
{
  meniscus::OutputOptions options;
  options.PointsPrecision = self->OutputPointsPrecision;
  options.Schlick = self->ReflectanceModel == SCHLICK;
  options.VirtualNormals = self->VirtualNormals;
  options.TrueGeometry = self->TrueGeometry;
  options.Reflects = self->Mode == REFLECTION;
  const double* light = self->LightDirection;
  const double length = std::hypot(light[0], light[1], light[2]);
  options.IsLightAtEye = !(length > 0.0);
  if (!options.IsLightAtEye)
  {
    options.Light = glm::dvec3(light[0], light[1], light[2]) / length;
  }
  options.Eye = this->Scene.GetEye();
  const std::vector<meniscus::RefractionStack::Link> links = this->Scene.ListLinks();
  if (!links.empty())
  {
    options.Exterior = links.front().Passage.Before;
    options.Interior = links.front().Passage.Behind;
  }
  return options;
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::vtkInternals::UpdateView(vtkRefractedGeometryFilter* self)
{
  vtkCamera* camera = self->Camera;
  if (!self->ViewCulling || !camera || camera->GetParallelProjection())
  {
    this->IsViewActive = false; // an eye at infinity has no frustum
    this->ViewTime = 0;
    return;
  }
  // The filter's time covers the camera's and does not change between the blocks of composite data.
  const vtkMTimeType time = self->GetMTime();
  const vtkTypeInt64 eye = this->GetRays();
  if (time != this->ViewTime || eye != this->ViewEye)
  {
    this->IsViewActive =
      this->Scene.SetView(meniscus::FindViewPlanes(camera, self->ViewAspectRatio));
    this->ViewTime = time;
    this->ViewEye = eye;
  }
}

//------------------------------------------------------------------------------
// Determines the part of a block that is in view, if anything it depends on has changed.
void vtkRefractedGeometryFilter::vtkInternals::Select(
  vtkPolyData* input, meniscus::SolvedBlock& block)
{
  meniscus::ViewSelection selection;
  if (this->IsViewActive)
  {
    block.UpdateTopology();
    const bool isSolved = block.Rays == this->GetRays();
    if (isSolved && block.Selection.IsActive && block.ViewChange == this->Scene.GetViewChange())
    {
      return;
    }
    selection =
      meniscus::SelectInView(this->Scene, block.Topology, input->GetNumberOfCells(), block.Points);
    block.ViewChange = this->Scene.GetViewChange();
  }
  if (!(selection == block.Selection))
  {
    block.CellsReady = false;
    // Chunks are not kept if the images of all points were solved at once.
    const bool isNew = block.All && selection.IsActive && !block.Selection.IsActive;
    block.Rays = isNew ? -1 : block.Rays;
    block.Selection = std::move(selection);
  }
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::vtkInternals::SolveFirst(
  vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block)
{
  constexpr std::size_t chunkSize = meniscus::CellImages::Chunk;
  const std::size_t count = block.Points.size() / 3;
  if (block.Rays != this->GetRays() || block.All)
  {
    block.All = false;
    block.Images.reset();
    block.Rays = this->GetRays();
    block.Vertices.assign(count, meniscus::VirtualVertex());
    block.SolvedChunks.assign((count + chunkSize - 1) / chunkSize, false);
    block.PrepareFirst(this->Scene);
  }
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < block.SolvedChunks.size(); ++i)
  {
    if (!block.SolvedChunks[i] && block.IsSelected(i))
    {
      open.push_back(i);
    }
  }
  const auto solve = [this, &block](const double* points, std::size_t begin, std::size_t end,
                       meniscus::VirtualVertex* vertices)
  {
    this->Scene.Solve(
      points, begin, end, vertices, block.Stack.Points.data(), block.Stack.Legs.data());
  };
  const auto openChunks = static_cast<vtkIdType>(open.size());
  const bool done = this->Run(self, 0.0, 1.0, openChunks, GetGrainOfChunks(openChunks),
    [&solve, &block, &open, count](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin, next = begin; i < end; i = next)
      {
        while (next < end && open[next] - open[i] == next - i)
        {
          ++next;
        }
        meniscus::SolveInOrder<chunkSize * meniscus::CurvedMembraneSolver::ChainsAtOnce>(
          block.Points.data(), block.Order, open[i] * chunkSize,
          std::min((open[next - 1] + 1) * chunkSize, count), block.Vertices.data(), solve);
      }
    });
  if (!done)
  {
    block.Rays = -1;
    return false;
  }
  for (const std::size_t chunk : open)
  {
    block.SolvedChunks[chunk] = true;
    for (std::size_t i = chunk * chunkSize; i < std::min((chunk + 1) * chunkSize, count); ++i)
    {
      this->Count(block.Vertices[block.Order.empty() ? i : block.Order[i]].State);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// True if all images of the block's cells are known.
bool vtkRefractedGeometryFilter::vtkInternals::AreCellsReady(
  vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block) const
{
  block.UpdateTopology();
  return block.Rays == this->GetRays() && block.All && block.CellsReady &&
    block.Tolerance == self->GetTolerance() && block.ClosesSeams == self->CloseSeams;
}

//------------------------------------------------------------------------------
bool vtkRefractedGeometryFilter::vtkInternals::SolveAll(
  vtkRefractedGeometryFilter* self, vtkPolyData* input, meniscus::SolvedBlock& block)
{
  if (this->AreCellsReady(self, block))
  {
    return true;
  }
  const double tolerance = self->GetTolerance();
  const bool pointsReady = block.Rays == this->GetRays() && block.All;
  block.CellsReady = false;
  block.Assembly.IsReady = false;
  if (!this->SolveAllPoints(self, block, pointsReady))
  {
    return false;
  }
  block.Tolerance = tolerance;
  block.ClosesSeams = self->CloseSeams;
  block.Cells = meniscus::AllImages();
  block.Images->SetTolerance(tolerance);
  block.PrepareCells(this->Scene);
  const auto loop = [this, self](std::size_t parts, const meniscus::RangeBody& body)
  { return this->Run(self, 0.5, 1.0, static_cast<vtkIdType>(parts), 1, body); };
  const meniscus::ObjectTopology* topology = &block.Topology;
  if (block.Selection.IsActive)
  {
    block.Selected = meniscus::SelectCells(block.Topology, block.Selection);
    topology = &block.Selected;
  }
  block.CellsReady =
    meniscus::MapCells(input, *topology, *block.Images, self->CloseSeams, loop, block.Cells);
  return block.CellsReady;
}

//------------------------------------------------------------------------------
// Solves the selected points. With `isReady`, earlier results are valid.
bool vtkRefractedGeometryFilter::vtkInternals::SolveAllPoints(
  vtkRefractedGeometryFilter* self, meniscus::SolvedBlock& block, bool isReady)
{
  const std::size_t count = block.Points.size() / 3;
  if (!isReady)
  {
    block.MakeImages(this->Scene);
  }
  std::vector<bool> known(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    known[i] = block.Images->GetState(i) != meniscus::ImageState::NotAsked;
  }
  const bool same = isReady && block.Images->GetWanted() == block.Selection.Chunks;
  if (same)
  {
    return true; // only cells have changed
  }
  block.Images->SetWanted(block.Selection.Chunks);
  block.Rays = -1;
  constexpr std::size_t chunkSize = meniscus::CellImages::Chunk;
  const auto chunks = static_cast<vtkIdType>((count + chunkSize - 1) / chunkSize);
  if (!this->Run(self, 0.0, 0.5, chunks, GetGrainOfChunks(chunks),
        [&block, count](std::size_t begin, std::size_t end)
        { block.Images->SolvePoints(begin * chunkSize, std::min(end * chunkSize, count)); }))
  {
    return false;
  }
  block.Images->FinishPoints();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!known[i] && block.Selection.HasPoint(i))
    {
      this->Count(block.Images->GetState(i));
    }
  }
  block.Rays = this->GetRays();
  return true;
}

vtkStandardNewMacro(vtkRefractedGeometryFilter);
meniscusInterfacePropertiesMacro(vtkRefractedGeometryFilter);
meniscusExactMembraneMacro(vtkRefractedGeometryFilter);
meniscusMembranePortMacro(vtkRefractedGeometryFilter, 1);

//------------------------------------------------------------------------------
vtkRefractedGeometryFilter::vtkRefractedGeometryFilter()
  : Internals(new vtkInternals)
{
  this->Interfaces = meniscus::MakeInterfaces();
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkRefractedGeometryFilter::~vtkRefractedGeometryFilter() = default;

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::SetCamera(vtkCamera* camera)
{
  if (this->Camera != camera)
  {
    this->Camera = camera;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkCamera* vtkRefractedGeometryFilter::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::SetMembraneData(vtkPolyData* membrane)
{
  this->SetInputData(1, membrane);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkRefractedGeometryFilter::GetOutput()
{
  return this->Internals->Joined.Get(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkMTimeType vtkRefractedGeometryFilter::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  const vtkMTimeType camera = this->Camera ? this->Camera->GetMTime() : 0;
  return std::max({ own, camera, this->Interfaces->GetMTime() });
}

//------------------------------------------------------------------------------
int vtkRefractedGeometryFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return port == 1 ? meniscus::AcceptSurfaces(info) : 1;
}

//------------------------------------------------------------------------------
// The geometry is requested in pieces as the output is, the membranes always whole.
int vtkRefractedGeometryFilter::RequestUpdateExtent(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* output = outputs->GetInformationObject(0);
  if (vtkInformation* geometry = inputs[0]->GetInformationObject(0))
  {
    geometry->CopyEntry(output, Pipeline::UPDATE_PIECE_NUMBER());
    geometry->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_PIECES());
    geometry->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
    geometry->Set(Pipeline::EXACT_EXTENT(), 1);
  }
  meniscus::RequestWhole(inputs[1]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkRefractedGeometryFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkDataSet* geometry = vtkDataSet::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  if (!geometry || !vtkPolyData::GetData(inputs[1]) || !output)
  {
    vtkErrorMacro("The geometry is missing, or the membrane is missing or is not a vtkPolyData; "
                  "the output is empty.");
    return 0;
  }
  const meniscus::ObjectSurface surface = this->Internals->Surfaces.Get(geometry);
  const meniscus::RefractionScene::Loan loan(this->Internals->Scene);
  if (this->UpdateScene(inputs[1]))
  {
    this->WriteImages(surface.Data, output);
    surface.RestoreIds(output);
  }
  return 1;
}

//------------------------------------------------------------------------------
// Solves the images that are not known yet and writes all of them. An abort leaves no output.
void vtkRefractedGeometryFilter::WriteImages(vtkPolyData* input, vtkPolyData* output)
{
  vtkInternals& internals = *this->Internals;
  const meniscus::StackSolver* list = internals.Scene.GetPathSolver();
  internals.FailedInRun = 0;
  const vtkTypeInt64 undecided = internals.Scene.GetNumberOfUndecided();
  internals.UpdateView(this);
  meniscus::SolvedBlock& block = internals.GetBlock(input);
  internals.Select(input, block);
  const bool all = this->Images == ALL_IMAGES && this->MembraneModel == CURVED;
  // While images change in every frame, their assembly is not kept for the next one.
  const bool isKept = all && !list && internals.AreCellsReady(this, block);
  if (!(all ? internals.SolveAll(this, input, block) : internals.SolveFirst(this, block)))
  {
    return;
  }

  const meniscus::Membrane& surface = internals.Scene.GetFirstMembrane();
  const meniscus::OutputOptions options = internals.GetOptions(this);
  meniscus::OutputOptions ofFirst = options;
  ofFirst.VirtualNormals = options.VirtualNormals && !list;
  const meniscus::VirtualPolyDataReport report = all
    ? meniscus::BuildImagePolyData(input,
        block.Selection.IsActive ? block.Selected : block.Topology, *block.Images, block.Cells,
        surface, ofFirst, block.Assembly, output)
    : meniscus::BuildVirtualPolyData(
        input, block.Vertices, block.Selection, surface, ofFirst, output);
  if (list && all)
  {
    meniscus::AddStackImageArrays(
      input, block.GetStackImages(), block.Cells, *list, options, output);
  }
  else if (list)
  {
    meniscus::AddStackArrays(input, block.Vertices, block.Stack, options, output);
  }
  block.Kept.Reuse(output, isKept ? block.Assembly.Geometry.Get() : nullptr);
  block.Assembly.IsReady = isKept;
  internals.CulledVertices += block.Selection.CulledPoints;
  internals.CulledCells += block.Selection.CulledCells;
  this->ReportUndecided(internals.Scene.GetNumberOfUndecided() - undecided);
  // With a view, the solved part does not tell whether the rest has images.
  this->ReportPoints(
    internals.FailedInRun, block.Selection.IsActive || output->GetNumberOfPoints() > 0, input);
  this->ReportCells(report, input);
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::ReportPoints(
  vtkTypeInt64 failed, bool hasImage, vtkPolyData* input)
{
  vtkInternals& internals = *this->Internals;
  const vtkIdType points = input->GetNumberOfPoints();
  if (failed > 0)
  {
    vtkWarningMacro(<< failed << " of " << points
                    << " points are not finite, or too far away to be solved; they have no image.");
  }
  if (points > failed && !hasImage && internals.WarnedOfNoImage != internals.GetShapes())
  {
    internals.WarnedOfNoImage = internals.GetShapes();
    const std::string reason = internals.DescribeNoImage(this);
    if (!reason.empty())
    {
      vtkWarningMacro("None of the " << points << " points has an image. " << reason);
    }
  }
  if (this->VirtualNormals && !internals.WarnedOfNoNormals && points > 0 &&
    !input->GetPointData()->GetNormals())
  {
    internals.WarnedOfNoNormals = true;
    vtkWarningMacro("VirtualNormals need point normals, which the geometry does not have.");
  }
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::ReportCells(
  const meniscus::VirtualPolyDataReport& report, vtkPolyData* input)
{
  this->Internals->SkippedCells += report.SkippedCells + report.BrokenCells;
  if (report.BrokenCells > 0)
  {
    vtkErrorMacro(<< report.BrokenCells << " of " << input->GetNumberOfCells()
                  << " cells refer to points that do not exist; they are left out.");
  }
  if (report.CoarseTriangles > 0 && this->Internals->WarnedOfCoarse != this->Internals->GetShapes())
  {
    this->Internals->WarnedOfCoarse = this->Internals->GetShapes();
    vtkWarningMacro(<< "The images of " << report.CoarseTriangles << " triangles have the largest "
                    << "number of points, " << meniscus::EdgeSubdivision::MostNodes
                    << ", and larger errors than AngularTolerance: raise it, or divide the "
                    << "triangles before.");
  }
  if (report.ArraysOfWrongSize > 0)
  {
    vtkWarningMacro(
      << report.ArraysOfWrongSize
      << " point or cell arrays do not have one tuple per point or cell; they are left out.");
  }
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::ReportUndecided(vtkTypeInt64 searches)
{
  vtkInternals& internals = *this->Internals;
  if (searches > 0 && internals.WarnedOfUndecided != internals.GetShapes())
  {
    internals.WarnedOfUndecided = internals.GetShapes();
    vtkWarningMacro(<< searches << " searches for images, or for the side of a point, ended "
                    << "undecided: at a focus, or within rounding of the membrane. Images may be "
                    << "missing there.");
  }
}

//------------------------------------------------------------------------------
void vtkRefractedGeometryFilter::WarnOfModes()
{
  if (!this->Internals->WarnedOfModes && this->Images == ALL_IMAGES &&
    this->MembraneModel == FLAT_FACETS)
  {
    this->Internals->WarnedOfModes = true;
    vtkWarningMacro("Images ALL_IMAGES needs the membrane model CURVED: flat facets overlap, and "
                    "extrapolated cells show images that do not exist. The result is that of "
                    "FIRST_IMAGE.");
  }
}

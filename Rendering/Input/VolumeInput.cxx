// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/VolumeInput.h"

#include "Common/BlockLoop.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Input/ConcatenatedArray.h"
#include "Rendering/Input/TetrahedraSource.h"
#include "Volume/Mesh/InvertedCells.h"
#include "Volume/Mesh/SourceCells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace meniscus
{
namespace
{

std::string DescribeFolded(std::int64_t cells)
{
  return cells == 0 ? std::string()
                    : std::to_string(cells) +
      " cells are folded inside out in parts, where their pieces overlap; their points may be in "
      "another order than VTK's. ";
}

}

//------------------------------------------------------------------------------
InputReport VolumeInput::UpdateMesh(const InputBlocks& input,
  const std::function<bool(double)>& progress, const DivisionRequest& division)
{
  InputReport report;
  report.Error = division.Settings.DescribeFault();
  if (!report.Error.empty())
  {
    return report;
  }
  const bool newCells =
    this->CellWatch.HasChanged(CellVersions(input), [&]() { return this->Digests.OfCells(input); });
  const bool newPoints = this->PointWatch.HasChanged(
    PointVersions(input), [&]() { return this->Digests.OfPoints(input); });
  const bool newFields = this->HasNewFields(division);
  const bool lacksSources = input.Place == FieldAssociation::Cells && !this->KeepsSourceCells;
  const bool newDivision = this->IsNewDivision(division.Settings);
  if (!newCells && !newPoints && !newFields && !lacksSources && !newDivision)
  {
    report.Error = this->BuildError;
    return report;
  }
  this->KeepsSourceCells = this->KeepsSourceCells || lacksSources;
  const bool sameCells = !newCells && !lacksSources && !newDivision && this->BuildError.empty();
  const bool holds = sameCells &&
    (!this->IsDivided(division.Settings) || this->Divided.Holds(division, ThreadedLoop)) &&
    (!newPoints || this->MovePoints(input));
  if (!holds)
  {
    report = this->BuildMesh(GetGrids(input), progress, division);
    this->BuildError = report.Error;
  }
  return report;
}

//------------------------------------------------------------------------------
/** True if the mesh has to be divided for these settings. */
bool VolumeInput::IsNewDivision(const DivisionSettings& settings)
{
  const DivisionSettings& built = this->BuiltDivision;
  bool same = settings.IsAdaptive == built.IsAdaptive;
  if (this->IsDivided(settings))
  {
    // Another budget makes no difference to a division that kept the tolerance within it.
    const DivisionCounts& counts = this->Divided.GetCounts();
    const bool sameBudget = settings.MostPieces == built.MostPieces ||
      (counts.ReachedTolerance && settings.MostPieces >= counts.Pieces);
    same = same && settings.Tolerance == built.Tolerance && sameBudget;
  }
  this->BuiltDivision = settings;
  return !same;
}

//------------------------------------------------------------------------------
/** True if the scalars, or their function, that an adaptive division depends on have changed. */
bool VolumeInput::HasNewFields(const DivisionRequest& division)
{
  if (!this->IsDivided(division.Settings))
  {
    return false;
  }
  const InputBlocks& fields = division.Fields;
  if (fields.Place == FieldAssociation::Cells && this->DividedPlace == FieldAssociation::Cells)
  {
    return false; // constant in each cell
  }
  const bool sameFunction =
    division.Picture.Use == this->DividedUse && division.Picture.Version == this->DividedFunction;
  this->DividedUse = division.Picture.Use;
  this->DividedFunction = division.Picture.Version;
  const bool changed = this->FieldWatch.HasChanged(
    ScalarVersions(fields), [&fields]() { return DigestScalars(fields); });
  const bool same = !changed && sameFunction && fields.Place == this->DividedPlace &&
    division.Component == this->DividedComponent;
  this->DividedPlace = fields.Place;
  this->DividedComponent = division.Component;
  return !same;
}

//------------------------------------------------------------------------------
/** Moves the vertices. Returns false if the mesh must be built. */
bool VolumeInput::MovePoints(const InputBlocks& input)
{
  if (this->SplitsByPosition)
  {
    return false;
  }
  bool moved = false;
  if (this->Divided.IsUsed())
  {
    const std::vector<double> positions = this->Divided.ComputePositions(input, ThreadedLoop);
    moved = this->Mesh.MovePoints(positions.data(), ThreadedLoop);
  }
  else
  {
    const PointsSource points(GetGrids(input), ThreadedLoop);
    moved = this->Mesh.MovePoints(points.GetView(), ThreadedLoop);
  }
  if (moved)
  {
    this->MeshVersion.Bump();
    ++this->PointUpdates;
  }
  return moved;
}

//------------------------------------------------------------------------------
InputReport VolumeInput::BuildMesh(const std::vector<vtkDataSet*>& grids,
  const std::function<bool(double)>& progress, const DivisionRequest& division)
{
  this->ScalarWatch.Forget();
  this->ActiveSetStale = true;
  this->BuildVersion.Bump();
  this->MeshVersion.Bump();
  this->LinkVersion.Bump();
  this->InputCells = std::vector<std::int32_t>();
  this->Divided.Clear();
  this->Unusable = UnusableCells();

  InputReport report;
  std::ostringstream text;
  const GridSize size = MeasureGrids(grids);
  if (size.Tetrahedra > TetrahedralMesh::MaximumNumberOfCells ||
    size.Points > std::numeric_limits<std::int32_t>::max())
  {
    this->Mesh = TetrahedralMesh();
    text << "A mesh of " << size.Tetrahedra << " tetrahedra and " << size.Points
         << " points exceeds the limit of " << TetrahedralMesh::MaximumNumberOfCells
         << " tetrahedra and 2^31 points";
    report.Error = text.str();
    return report;
  }
  MeshBuildControl control;
  control.Loop = ThreadedLoop;
  control.Progress = progress;
  // Lagrange and Bezier cells above order 1 have no fixed division.
  if (!division.Settings.IsAdaptive && size.HigherOrder == 0)
  {
    return this->BuildFromCells(grids, control);
  }
  const DivisionStatus status = this->Divided.Divide(
    division, ThreadedLoop, [&progress](double done) { return progress(0.5 * done); });
  if (status == DivisionStatus::Ok && !this->Divided.IsUsed())
  {
    return this->BuildFromCells(grids, control);
  }
  if (status == DivisionStatus::Ok)
  {
    control.Progress = [&progress](double done) { return progress(0.5 + 0.5 * done); };
    return this->BuildDivided(control);
  }
  this->Mesh = TetrahedralMesh();
  this->Divided.Clear();
  this->CellWatch.Forget(); // after an abort, the next call starts again
  return report;
}

//------------------------------------------------------------------------------
/** Builds the mesh of cells that are split between their points. */
InputReport VolumeInput::BuildFromCells(
  const std::vector<vtkDataSet*>& grids, const MeshBuildControl& control)
{
  InputReport report;
  const TetrahedraSource source(grids, ThreadedLoop);
  this->Unusable = source.GetUnusable();
  this->FoldedCells = source.GetNumberOfFolded();
  report.Warning = DescribeFolded(this->FoldedCells);
  this->BuildTables(source.GetView(), control, source.DescribeOmitted(), report);
  this->SplitsByPosition = source.SplitsByPosition();
  return report;
}

//------------------------------------------------------------------------------
/** Builds the mesh of the divided cells. */
InputReport VolumeInput::BuildDivided(const MeshBuildControl& control)
{
  // Cells of the input are known for each piece: looking them up would take another division.
  this->KeepsSourceCells = true;
  InputReport report;
  const DivisionCounts& counts = this->Divided.GetCounts();
  std::ostringstream text;
  if (!counts.ReachedTolerance)
  {
    text << "The division of cells has spent its budget of " << this->Divided.GetBudget()
         << " tetrahedra at an error of " << counts.Error << ", above the tolerance of "
         << this->BuiltDivision.Tolerance << "; MaximumNumberOfPieces is the budget. ";
  }
  if (counts.UnresolvedEdges > 0)
  {
    text << counts.UnresolvedEdges << " edges of cells are not divided to the tolerance. ";
  }
  this->FoldedCells = counts.FoldedCells;
  report.Warning = text.str() + DescribeFolded(this->FoldedCells);
  this->Unusable = this->Divided.GetUnusable();
  this->BuildTables(this->Divided.GetView(), control, this->Divided.GetOmitted(), report);
  this->Divided.FreeView();
  this->SplitsByPosition = this->Divided.SplitsByPosition();
  return report;
}

//------------------------------------------------------------------------------
void VolumeInput::BuildTables(TetrahedraView view, const MeshBuildControl& control,
  const std::string& omitted, InputReport& report)
{
  view.KeepSourceCells = this->KeepsSourceCells;
  if (this->Mesh.Build(view, control) == MeshStatus::Aborted)
  {
    this->CellWatch.Forget(); // the next call starts again
  }
  std::ostringstream text;
  text << report.Warning;
  if (!omitted.empty())
  {
    text << "Cells that are not drawn, because of their type: " << omitted << ". ";
  }
  text << this->DescribeRejected(view.NumberOfCells) << this->DescribeImprecise();
  report.Warning = text.str();
  if (!report.Warning.empty() && report.Warning.back() == ' ')
  {
    report.Warning.pop_back();
  }
}

//------------------------------------------------------------------------------
/** Numbers of the cells that are left out, by reason. @param cells number of tetrahedra. */
std::string VolumeInput::DescribeRejected(std::int64_t cells) const
{
  if (this->GetNumberOfRejectedCells() == 0)
  {
    return std::string();
  }
  const RejectedCells& rejected = this->Mesh.GetRejectedCells();
  const std::pair<std::int64_t, const char*> reasons[] = {
    { rejected.IndexOutOfRange + this->Unusable.PointOutOfRange,
      " with a point index out of range" },
    { this->Unusable.WrongNumberOfPoints,
      " with a number of points that their type does not have" },
    { this->Unusable.OutsideOfArray, " with points or faces outside of their array" },
    { this->Unusable.MissingFaces, " polyhedra without usable faces" },
    { rejected.RepeatedVertex, " with a repeated point" },
    { rejected.PointNotFinite, " with a point that is not finite" },
    { rejected.Duplicate, " equal to earlier cells" },
  };
  std::ostringstream text;
  text << this->GetNumberOfRejectedCells() << " of " << cells + this->Unusable.Total()
       << " cells are left out";
  const char* separator = ": ";
  for (const auto& reason : reasons)
  {
    if (reason.first > 0)
    {
      text << separator << reason.first << reason.second;
      separator = ", ";
    }
  }
  text << ". ";
  return text.str();
}

//------------------------------------------------------------------------------
/**
 * A size of the mesh that single precision does not hold, or the number of cells that are too thin
 * or too small for the precision of coordinates.
 */
std::string VolumeInput::DescribeImprecise() const
{
  // Roundings of lengths, 2^-24 of the radius, are to be numbers of full precision, and sums of up
  // to 16 radii to be finite: a ray is at most twice as long, and its eye some radii away.
  constexpr double least = 16777216.0 * std::numeric_limits<float>::min();
  constexpr double most = std::numeric_limits<float>::max() / 16.0;
  // A radius is a root of squares, which may be 0 where half of the size is not.
  const glm::dvec3& half = this->Mesh.GetHalfSize();
  const double radius = std::max({ this->Mesh.GetRadius(), half.x, half.y, half.z });
  const std::int64_t cells = this->Mesh.GetNumberOfImpreciseCells();
  std::ostringstream text;
  if (this->Mesh.GetNumberOfCells() > 0 && radius != 0.0 && !(radius >= least && radius <= most))
  {
    text << "The mesh has a radius of " << radius
         << "; single precision holds lengths in meshes of " << least << " to " << most
         << ", so that this one may be drawn wrongly or not at all. ";
    return text.str();
  }
  if (cells == 0 || !this->HasSingleDepths)
  {
    return std::string();
  }
  text << cells << " of " << this->Mesh.GetNumberOfCells() << " cells have an edge shorter than "
       << TetrahedralMesh::ShortestPreciseEdge * this->Mesh.GetRadius()
       << ", 1/131072 of the mesh's radius: lengths of rays in such layers and small cells may be "
          "off by more than 1 %. ";
  return text.str();
}

//------------------------------------------------------------------------------
InputReport VolumeInput::UpdateScalars(
  const InputBlocks& input, int component, const FunctionFeatures& features)
{
  InputReport report;
  const bool changed = this->ScalarWatch.HasChanged(
    ScalarVersions(input), [&input]() { return DigestScalars(input); });
  const bool same =
    !changed && input.Place == this->BuiltPlace && component == this->BuiltComponent;
  if (same && features.Version == this->BuiltFeatures)
  {
    return report;
  }
  this->BuiltFeatures = features.Version;
  const bool ofCells = input.Place == FieldAssociation::Cells;
  std::vector<double> values;
  if (!same)
  {
    values = GatherValues(
      input, component, this->GetSources(input.Place), this->GetInterpolatedPoints(input.Place));
    const FiniteValues finite(values);
    this->Distribution = finite.Distribution;
    if (finite.NotFinite > 0)
    {
      report.Warning = std::to_string(finite.NotFinite) + " of " + std::to_string(values.size()) +
        " scalars of the " + (ofCells ? "tetrahedra" : "vertices") +
        " are not finite; cells that use them are transparent.";
    }
    report.Warning += DescribeRounding(input, finite.Distribution);
  }
  const ScalarNormalization normalization =
    ChooseNormalization(this->Distribution, features.Of(0), same ? &this->Normalization : nullptr);
  if (same && normalization == this->Normalization)
  {
    return report;
  }
  this->Normalization = normalization;
  if (same)
  {
    values = GatherValues(
      input, component, this->GetSources(input.Place), this->GetInterpolatedPoints(input.Place));
  }
  this->Scalars.clear();
  this->CellScalars.clear();
  std::vector<float>& normalized = ofCells ? this->CellScalars : this->Scalars;
  normalized.resize(values.size());
  ForEachInBlocks(values.size(), ThreadedLoop,
    [&](std::size_t v)
    {
      normalized[v] = std::isfinite(values[v]) ? static_cast<float>(normalization(values[v]))
                                               : std::numeric_limits<float>::quiet_NaN();
    });
  this->BuiltPlace = input.Place;
  this->BuiltComponent = component;
  this->ActiveSetStale = true;
  this->ScalarVersion.Bump();
  return report;
}

//------------------------------------------------------------------------------
const std::vector<std::int32_t>& VolumeInput::GetSources(FieldAssociation place) const
{
  return place == FieldAssociation::Cells ? this->Mesh.GetSourceCells()
                                          : this->Mesh.GetSourcePoints();
}

//------------------------------------------------------------------------------
ScalarRange VolumeInput::GetNormalizedRange() const
{
  if (this->Distribution.IsEmpty())
  {
    return ScalarRange();
  }
  return SampledRange(this->Distribution, {}, this->Normalization);
}

//------------------------------------------------------------------------------
void VolumeInput::UpdateActiveCells(const VisibleScalars& visible, TetrahedralMesh::CellJumps jumps)
{
  if (!this->ActiveSetStale && visible == this->Visible && jumps == this->Jumps &&
    this->OthersVersion == TableVersion())
  {
    return;
  }
  const bool changed = this->BuiltPlace == FieldAssociation::Cells
    ? this->Mesh.UpdateActiveCells(this->CellScalars, jumps, visible, ThreadedLoop)
    : this->Mesh.UpdateActiveCells(this->Scalars, visible, ThreadedLoop);
  if (changed)
  {
    this->LinkVersion.Bump();
  }
  this->Visible = visible;
  this->Jumps = jumps;
  this->VisibleOthers.clear();
  this->OthersVersion = TableVersion();
  this->ActiveSetStale = false;
  ++this->ActiveSetBuilds;
}

//------------------------------------------------------------------------------
void VolumeInput::UpdateActiveCells(const VisibleScalars& visible, const OtherValues& others)
{
  if (!this->ActiveSetStale && visible == this->Visible && others.Visible == this->VisibleOthers &&
    others.Version == this->OthersVersion)
  {
    return;
  }
  const auto& cells = this->Mesh.GetCells();
  const std::vector<glm::vec3>& values = *others.Values;
  std::vector<std::uint8_t> active(cells.size());
  std::vector<std::int64_t> unknown(NumberOfBlocks(cells.size()), 0);
  ForEachBlock(cells.size(), ThreadedLoop,
    [&](std::size_t block, std::size_t first, std::size_t last)
    {
      for (std::size_t c = first; c < last; ++c)
      {
        const auto& v = cells[c].Vertices;
        const auto meets = [](const VisibleScalars& seen, float p, float q, float r, float s) {
          return seen.Meets(std::min({ p, q, r, s }), std::max({ p, q, r, s }));
        };
        const float* s = this->Scalars.data();
        bool seen = meets(visible, s[v[0]], s[v[1]], s[v[2]], s[v[3]]);
        for (std::size_t i = 0; i < others.Visible.size(); ++i)
        {
          const int at = static_cast<int>(i);
          seen = seen ||
            meets(others.Visible[i], values[v[0]][at], values[v[1]][at], values[v[2]][at],
              values[v[3]][at]);
        }
        float sum = 0.0f;
        for (const std::int32_t vertex : v)
        {
          sum += s[vertex] + values[vertex].x;
        }
        active[c] = seen && !std::isnan(sum);
        unknown[block] += std::isnan(sum);
      }
    });
  const std::int64_t unknownCells =
    std::accumulate(unknown.begin(), unknown.end(), std::int64_t{ 0 });
  if (this->Mesh.SetActiveCells(active, unknownCells, ThreadedLoop))
  {
    this->LinkVersion.Bump();
  }
  this->Visible = visible;
  this->VisibleOthers = others.Visible;
  this->OthersVersion = others.Version;
  this->ActiveSetStale = false;
  ++this->ActiveSetBuilds;
}

//------------------------------------------------------------------------------
std::string VolumeInput::WarnOfOverlaps(std::int64_t rays)
{
  // Folded cells overlap, and are reported when they are divided.
  if (rays == 0 || this->OverlapsReported == this->BuildVersion || this->FoldedCells > 0)
  {
    return std::string();
  }
  this->OverlapsReported = this->BuildVersion;
  const std::int64_t inverted = CountInvertedCells(this->Mesh, ThreadedLoop);
  std::ostringstream text;
  text << rays << " rays enter cells before they have left others: ";
  if (inverted == 0)
  {
    text << "parts of the mesh overlap there, and the part that a ray enters first is the only one "
            "to count. Give each part a volume or a ray integral of its own, or remove the cells "
            "of one part that are inside another.";
    return text.str();
  }
  text << inverted << " of " << this->Mesh.GetNumberOfActiveCells()
       << " tetrahedra are inside out and overlap their neighbours, and the cell that a ray enters "
          "first is the only one to count. ";
  if (this->Divided.IsUsed())
  {
    text << "In divided cells they overlap by less than the tolerance of the division. If parts of "
            "the mesh overlap as well, give each part a volume or a ray integral of its own.";
  }
  else
  {
    text << "The points of the mesh may have moved too far. Repair or remove these cells: "
            "vtkMeshQuality finds them by the sign of their volume.";
  }
  return text.str();
}

//------------------------------------------------------------------------------
std::int64_t VolumeInput::GetBytes() const
{
  return this->Mesh.GetBytes() + BytesOf(this->Scalars) + BytesOf(this->CellScalars) +
    BytesOf(this->Tree.GetNodes()) + BytesOf(this->Tree.GetFaces()) + BytesOf(this->Passages) +
    BytesOf(this->InputCells) + this->Divided.GetBytes();
}

//------------------------------------------------------------------------------
void VolumeInput::FindInputCells(const InputBlocks& input)
{
  if (!this->GetInputCells().empty())
  {
    return;
  }
  const TetrahedraSource source(GetGrids(input), ThreadedLoop);
  this->InputCells = FindSourceCells(this->Mesh, source.GetView(), ThreadedLoop);
  ++this->InputCellSearches;
}

//------------------------------------------------------------------------------
const BoundaryTree& VolumeInput::GetBoundaryTree()
{
  const bool sameFaces = this->LinksOfTree == this->LinkVersion;
  if (sameFaces && this->MeshOfTree == this->MeshVersion)
  {
    return this->Tree;
  }
  if (!sameFaces || !this->Tree.Refit(this->Mesh))
  {
    this->Tree.Build(this->Mesh);
  }
  this->LinksOfTree = this->LinkVersion;
  this->MeshOfTree = this->MeshVersion;
  return this->Tree;
}

//------------------------------------------------------------------------------
const std::vector<CellPassages>& VolumeInput::GetPassages()
{
  if (this->BuildOfPassages != this->BuildVersion)
  {
    this->Passages = FindPassages(this->Mesh, ThreadedLoop);
  }
  else if (this->LinksOfPassages != this->LinkVersion)
  {
    UpdateLinks(this->Mesh, this->Passages, ThreadedLoop);
  }
  this->BuildOfPassages = this->BuildVersion;
  this->LinksOfPassages = this->LinkVersion;
  return this->Passages;
}

}

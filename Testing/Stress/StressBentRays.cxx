// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StressBentRays.h"

#include "GradedPathCheck.h"
#include "StressBentLight.h"
#include "Volume/Graded/GradedRayWalk.h"
#include "Volume/Graded/QuadraticIndex.h"
#include "Volume/Graded/RefractiveIndex.h"

namespace meniscus::test
{

namespace
{

/** Rays of a case, by its cells, and the largest number of steps of each that are judged. */
constexpr int RaysOfCase = 32;
constexpr int RaysOfLargeCase = 8;
constexpr std::int64_t LargeCase = 50000;
constexpr int JudgedSteps = 96;
/**
 * Distance from the place that is nearest to the mesh's centre, or from a place near a vertex, at
 * which a ray begins. Such places are at most 1.2 radii from the centre: rays begin outside.
 */
constexpr double Before = 2.5;
/** Steps after which a ray counts as stopped. */
constexpr std::int64_t MostSteps = 4096;

/** Largest change of n^2 on smooth fields, and on fields of random values, per kind. */
struct FieldKind
{
  const char* Name;
  double Smooth;
  double Random;
};
constexpr FieldKind Kinds[] = { { "gas", 6e-4, 0.0 }, { "smooth", 1.0, 0.0 },
  { "rough gas", 0.0, 1e-3 }, { "rough", 0.0, 0.1 }, { "strong", 0.5, 2.0 } };

/** A mesh in a field, and the rays. */
class BentRays
{
public:
  explicit BentRays(const StressCase& stress)
    : Random(0x9e37u + static_cast<std::uint64_t>(stress.Number))
    , Kind(Kinds[stress.Number % 5])
    , InLanes(stress.Number / 5 % 2 == 0)
  {
    BuildKernelMesh(stress.Mesh, this->Mesh);
    this->SetField(stress.Mesh->GetPointData()->GetScalars());
    ActivateCellsWithIndex(this->Mesh, this->Squares);
    this->Tree.Build(this->Mesh);
    this->Medium.Mesh = &this->Mesh;
    this->Medium.Tree = &this->Tree;
    this->Medium.SquaredIndices = &this->Squares;
    this->Medium.OutsideIndex = stress.Number / 10 % 3 == 2 ? 1.0 : 0.0;
    if (stress.Number / 2 % 4 != 3)
    {
      this->Terms = ComputeEdgeTerms(this->Mesh, this->Squares);
      this->Medium.Terms = &this->Terms;
    }
    if (this->InLanes)
    {
      this->Table.Build(this->Mesh, this->Squares, this->Medium.Terms);
      this->Medium.Table = &this->Table;
    }
    if (this->Mesh.GetNumberOfActiveCells() > 0)
    {
      this->MakeRays(stress);
    }
  }

  StressTally Check()
  {
    StressTally tally;
    if (this->Mesh.GetNumberOfActiveCells() == 0)
    {
      return tally;
    }
    tally.Views = 1;
    const std::vector<GradedRayResult> ends = this->Trace();
    tally.Stopped = this->Sums.Trapped;
    tally.StoppedInFolds = this->Sums.TrappedInFolds;
    tally.Lost = this->Sums.Lost;
    tally.Steps = this->Sums.Steps;
    tally.Rays = this->Sums.Rays;
    reference::GradedPathCheck check(this->MakeReference());
    const StressBentLight light(this->Mesh, this->Random);
    for (std::size_t ray = 0; ray < this->Rays.size(); ++ray)
    {
      std::string fault = this->JudgeRay(ray, ends[ray], check);
      if (fault.empty())
      {
        this->Medium.MaximumNumberOfSteps = JudgedSteps;
        fault = light.Judge(this->Medium, this->Rays[ray]);
      }
      if (!fault.empty() && ++tally.Wrong == 1)
      {
        std::ostringstream text;
        text << Kind.Name << (InLanes ? ", lanes" : "") << (Medium.Terms ? "" : ", linear")
             << (Medium.OutsideIndex > 0.0 ? ", in air" : "") << ", ray " << ray << ": " << fault;
        tally.FirstWrong = text.str();
      }
    }
    return tally;
  }

private:
  void SetField(vtkDataArray* scalars)
  {
    double range[2];
    scalars->GetFiniteRange(range);
    const double width = range[1] > range[0] ? range[1] - range[0] : 1.0;
    for (const std::int32_t point : this->Mesh.GetSourcePoints())
    {
      const double share = (scalars->GetComponent(point, 0) - range[0]) / width;
      this->Squares.push_back(
        1.0 + 1e-4 + this->Kind.Smooth * share + this->Kind.Random * this->Random.Uniform());
    }
  }

  void MakeRays(const StressCase& stress)
  {
    const glm::dvec3 center = this->Mesh.GetCenter();
    const int rays = this->Mesh.GetNumberOfCells() < LargeCase ? RaysOfCase : RaysOfLargeCase;
    for (int i = 0; i < rays; ++i)
    {
      if (i % 2 == 0 && !stress.Views.empty())
      {
        // A pixel of the case's views, which may be aligned with the mesh.
        const VolumeView& view =
          stress.Views[static_cast<std::size_t>(i / 2) % stress.Views.size()];
        const reference::Ray pixel = view.GetRay(
          this->Random.Below(stress.Size), this->Random.Below(stress.Size), stress.Size);
        const glm::dvec3 direction =
          glm::normalize(glm::dvec3(pixel.Direction[0], pixel.Direction[1], pixel.Direction[2]));
        const glm::dvec3 origin =
          (glm::dvec3(pixel.Origin[0], pixel.Origin[1], pixel.Origin[2]) - center) /
          this->Mesh.GetRadius();
        this->Rays.push_back(
          { origin - (glm::dot(origin, direction) + Before) * direction, direction });
        continue;
      }
      const auto vertex = static_cast<std::int64_t>(
        this->Random.Below(static_cast<int>(this->Mesh.GetNumberOfVertices())));
      const glm::dvec3 direction = this->Random.GetDirection();
      // In air, a ray to a vertex is refracted by any of its faces.
      const double off = i % 4 == 1 && this->Medium.OutsideIndex == 0.0 ? 0.0 : 0.2;
      this->Rays.push_back({ this->Mesh.GetPosition(vertex) +
          off * this->Random.GetDirection() * this->Mesh.GetHalfSize() / this->Mesh.GetRadius() -
          Before * direction,
        direction });
    }
  }

  std::vector<GradedRayResult> Trace()
  {
    this->Medium.MaximumNumberOfSteps = MostSteps;
    std::vector<GradedRayResult> results(this->Rays.size());
    GradedRayWalk(this->Medium).WalkAll(this->Rays, this->Sums, results.data());
    return results;
  }

  static reference::PlaceOnRay PlaceOf(const GradedRayResult& result)
  {
    reference::PlaceOnRay place;
    for (int axis = 0; axis < 3; ++axis)
    {
      place.Position[axis] = result.Exit[axis];
      place.Direction[axis] = result.Direction[axis];
    }
    place.OpticalPath = result.OpticalPath;
    return place;
  }

  std::string JudgeRay(
    std::size_t number, const GradedRayResult& end, reference::GradedPathCheck& check)
  {
    const GradedRay& ray = this->Rays[number];
    GradedRayResult result;
    result.Exit = ray.Origin;
    result.Direction = glm::normalize(ray.Direction);
    check.Begin(PlaceOf(result));
    std::int64_t glidesBefore = 0;
    if (end.State == GradedRayState::Missed)
    {
      return check.MeetsMesh() ? "missed" : "";
    }
    for (int steps = 1; steps <= JudgedSteps; ++steps)
    {
      this->Medium.MaximumNumberOfSteps = steps;
      GradedRayStatistics statistics;
      GradedRayResult next;
      GradedRayWalk(this->Medium).WalkAll({ ray }, statistics, &next);
      const bool glides = statistics.Glides > glidesBefore;
      glidesBefore = statistics.Glides;
      if (statistics.InvertedSteps > 0)
      {
        check.PassFold();
      }
      if (next.State == GradedRayState::Left && statistics.Steps < steps)
      {
        return check.MeetsMesh() ? "has left too early" : "";
      }
      if (next.State == GradedRayState::Lost)
      {
        return "lost";
      }
      if (!check.GoTo(PlaceOf(next), glides))
      {
        return "no such path at step " + std::to_string(steps);
      }
    }
    return "";
  }

  reference::GradedField MakeReference() const
  {
    reference::GradedField field;
    for (std::int64_t v = 0; v < this->Mesh.GetNumberOfVertices(); ++v)
    {
      const glm::dvec3 p = this->Mesh.GetPosition(v);
      field.Points.push_back({ p.x, p.y, p.z });
    }
    field.SquaredIndices = this->Squares;
    std::vector<std::int64_t> numbers(this->Mesh.GetCells().size(), -1);
    for (std::size_t c = 0; c < numbers.size(); ++c)
    {
      if (!this->Mesh.IsActiveCell(static_cast<std::int64_t>(c)))
      {
        continue;
      }
      numbers[c] = static_cast<std::int64_t>(field.Cells.size());
      const auto& v = this->Mesh.GetCells()[c].Vertices;
      field.Cells.push_back({ v[0], v[1], v[2], v[3] });
      field.EdgeTerms.emplace_back();
      for (std::size_t e = 0; this->Medium.Terms && e < 6; ++e)
      {
        field.EdgeTerms.back()[e] = this->Terms[c][e];
      }
    }
    for (const BoundaryFace& face : this->Mesh.GetBoundary())
    {
      const auto cell = static_cast<std::size_t>(face.CellFace / 4);
      field.Boundary.push_back(
        { face.Vertices[0], face.Vertices[1], face.Vertices[2], numbers[cell] });
    }
    field.OutsideIndex = this->Medium.OutsideIndex;
    return field;
  }

  RandomNumbers Random;
  FieldKind Kind;
  bool InLanes;
  TetrahedralMesh Mesh;
  BoundaryTree Tree;
  std::vector<double> Squares;
  std::vector<EdgeTerms> Terms;
  GradedCellTable Table;
  GradedMedium Medium;
  GradedRayStatistics Sums;
  std::vector<GradedRay> Rays;
};

} // anonymous namespace

//------------------------------------------------------------------------------
StressTally CheckBentRays(const StressCase& stress)
{
  return stress.Mesh ? BentRays(stress).Check() : StressTally();
}

} // namespace meniscus::test

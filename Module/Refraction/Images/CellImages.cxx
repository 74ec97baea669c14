// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/CellImages.h"

#include "Refraction/Images/SeamClosure.h"
#include "Refraction/Stack/PlaneSights.h"

namespace meniscus
{

//------------------------------------------------------------------------------
void CellImages::ResetPoints(const double* points, std::size_t count)
{
  this->Points = points;
  this->Counts.assign(count, 0);
  this->States.assign(count, ImageState::NotAsked);
  this->Images.clear();
}

//------------------------------------------------------------------------------
void CellImages::AddWhole(
  const std::int64_t* ids, std::size_t count, std::int64_t cell, ImageMesh& whole) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    whole.Connectivity.push_back(
      static_cast<std::int64_t>(this->First[static_cast<std::size_t>(ids[i])]));
  }
  whole.EndCell(cell, this->GetFirstImage(ids[0]).Vertex.Orientation);
}

//------------------------------------------------------------------------------
MappedTriangle CellImages::MakeTriangle(const std::array<std::int64_t, 3>& ids) const
{
  MappedTriangle triangle;
  triangle.Ids = ids;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto point = static_cast<std::size_t>(ids[k]);
    triangle.Corners[k] = this->GetPoint(ids[k]);
    triangle.Images[k] = { this->Images.data() + this->First[point],
      this->GetNumberOfImages(point) };
  }
  return triangle;
}

//------------------------------------------------------------------------------
// Number of planes in front of a cell whose points have one image each; 0 if it is not the same for
// all of them.
std::size_t CellImages::CountPlanesBefore(
  const ParallelPlanes& planes, const std::int64_t* ids, std::size_t count) const
{
  int before = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const int own = this->GetNumberOfImages(static_cast<std::size_t>(ids[i])) == 1
      ? planes.CountInFront(this->GetPoint(ids[i]) - planes.GetStack().GetOrigin())
      : 0;
    if (own <= 0 || (i > 0 && own != before))
    {
      return 0;
    }
    before = own;
  }
  return static_cast<std::size_t>(before);
}

//------------------------------------------------------------------------------
void CellImages::AddPlaces(const std::int64_t* ids, std::size_t count, std::size_t number,
  std::size_t planesBefore, const glm::dvec3& eye, PlaneSights& sights) const
{
  glm::dvec3 sum(0.0);
  glm::dvec3 sumOfImages(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int64_t next = ids[(i + 1) % count];
    const glm::dvec3 point = this->GetPoint(ids[i]);
    const glm::dvec3& seen = this->GetFirstImage(ids[i]).Vertex.Position;
    sights.Add(number, planesBefore, 0.5 * (point + this->GetPoint(next)) - eye,
      0.5 * (seen + this->GetFirstImage(next).Vertex.Position) - eye);
    sum += point;
    sumOfImages += seen;
  }
  const double inverse = 1.0 / static_cast<double>(count);
  sights.Add(number, planesBefore, inverse * sum - eye, inverse * sumOfImages - eye);
}

//------------------------------------------------------------------------------
std::vector<bool> CellImages::FindWholeBehind(
  const ParallelPlanes& planes, const ObjectCells& cells, std::size_t begin, std::size_t end) const
{
  std::vector<bool> isWhole(end - begin, false);
  if (planes.IsEmpty())
  {
    return isWhole;
  }
  const glm::dvec3 eye = planes.GetStack().GetEye() + planes.GetStack().GetOrigin();
  std::vector<std::size_t> failed;
  PlaneSights sights(planes, 0.5 * this->Tolerance, failed);
  for (std::size_t i = begin; i < end; ++i)
  {
    const auto [ids, count] = cells.GetCell(i);
    const std::size_t before = this->CountPlanesBefore(planes, ids, count);
    if (before > 0)
    {
      this->AddPlaces(ids, count, i - begin, before, eye, sights);
      isWhole[i - begin] = true;
    }
  }
  sights.Finish();
  for (const std::size_t number : failed)
  {
    isWhole[number] = false;
  }
  return isWhole;
}

//------------------------------------------------------------------------------
void CellImages::MeetNeighbours(const ObjectCells& cells, std::size_t count,
  const unsigned char* isMapped, bool closesSeams, const ImageMesh& whole, ImageMesh& pieces,
  const RangeLoop& loop) const
{
  const std::vector<Seam> seams = FindSeams(cells, count, isMapped);
  if (seams.empty())
  {
    return;
  }
  VisitPointsOnNeighbours(
    seams, cells, count, isMapped, pieces, loop, [this]() { return this->MakeMove(); });
  if (!closesSeams)
  {
    return;
  }
  bool hasDiagonals = false;
  for (std::size_t i = 0; i < count && !hasDiagonals; ++i)
  {
    hasDiagonals = isMapped[i] && cells.GetCell(i).Count > 3;
  }
  SeamClosure closure(seams, hasDiagonals, this->GetEye(), this->Tolerance);
  closure.Collect(pieces, pieces.Points, false);
  closure.Collect(whole, this->Images, true);
  closure.Close(pieces, loop);
}

}

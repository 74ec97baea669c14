// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/CellImages.h"

#include "Refraction/Images/SeamClosure.h"

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
void CellImages::CloseSeams(const std::vector<Seam>& seams, const ObjectCells& cells,
  std::size_t count, const unsigned char* isMapped, const glm::dvec3& eye, const ImageMesh& whole,
  ImageMesh& pieces, const RangeLoop& loop) const
{
  bool hasDiagonals = false;
  for (std::size_t i = 0; i < count && !hasDiagonals; ++i)
  {
    hasDiagonals = isMapped[i] && cells.Offsets[i + 1] - cells.Offsets[i] > 3;
  }
  SeamClosure closure(seams, hasDiagonals, eye, this->Tolerance);
  closure.Collect(pieces, pieces.Points, false);
  closure.Collect(whole, this->Images, true);
  closure.Close(pieces, loop);
}

}

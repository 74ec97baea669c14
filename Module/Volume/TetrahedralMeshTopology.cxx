// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// How the cells of a TetrahedralMesh hang together: links across faces, and orientation.
#include "Volume/BlockLoop.h"
#include "Volume/CellFaces.h"
#include "Volume/TetrahedralMesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>

namespace meniscus
{
namespace
{

/** Six times the signed volume of the ascending vertices. */
double SixfoldVolume(const TetrahedralMesh& mesh, std::size_t cell)
{
  const auto& v = mesh.GetCells()[cell].Vertices;
  const glm::dvec3 origin = mesh.GetPosition(v[0]);
  return glm::dot(glm::cross(mesh.GetPosition(v[1]) - origin, mesh.GetPosition(v[2]) - origin),
    mesh.GetPosition(v[3]) - origin);
}

/** A face filed under its lowest vertex: the two others, and whose it is. */
struct FiledFace
{
  std::uint64_t Others;
  std::int32_t CellFace;

  bool operator<(const FiledFace& other) const
  {
    return this->Others != other.Others ? this->Others < other.Others
                                        : this->CellFace < other.CellFace;
  }
};

/** Sorts few faces: what insertion does best. */
void SortFaces(FiledFace* first, FiledFace* last)
{
  constexpr std::ptrdiff_t Few = 40;
  if (last - first > Few)
  {
    std::sort(first, last);
    return;
  }
  for (FiledFace* next = first; next != last; ++next)
  {
    const FiledFace face = *next;
    FiledFace* to = next;
    for (; to != first && face < to[-1]; --to)
    {
      *to = to[-1];
    }
    *to = face;
  }
}

/**
 * All faces, grouped by lowest vertex. Threads file them in any order, which sorting each group
 * undoes.
 */
class FaceFile
{
public:
  FaceFile(const std::vector<TetrahedralMesh::Cell>& cells, std::size_t numberOfVertices,
    const RangeLoop& loop)
    : Ends(new std::atomic<std::uint32_t>[numberOfVertices])
    , Faces(new FiledFace[4 * cells.size()])
  {
    ForEachBlock(numberOfVertices, loop,
      [this](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t v = first; v < last; ++v)
        {
          this->Ends[v].store(0, std::memory_order_relaxed);
        }
      });
    // Three faces contain the cell's lowest vertex; the fourth begins with the second lowest.
    this->ForEachCell(cells.size(), loop,
      [&](std::size_t c)
      {
        this->Ends[cells[c].Vertices[0]].fetch_add(3, std::memory_order_relaxed);
        this->Ends[cells[c].Vertices[1]].fetch_add(1, std::memory_order_relaxed);
      });
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < numberOfVertices; ++v)
    {
      const std::uint32_t count = this->Ends[v].load(std::memory_order_relaxed);
      this->Ends[v].store(next, std::memory_order_relaxed);
      next += count;
    }
    // Each group's start moves to its end, while it fills.
    this->ForEachCell(cells.size(), loop,
      [&](std::size_t c)
      {
        const auto& v = cells[c].Vertices;
        const std::uint32_t low = this->Ends[v[0]].fetch_add(3, std::memory_order_relaxed);
        const std::uint32_t high = this->Ends[v[1]].fetch_add(1, std::memory_order_relaxed);
        const auto cellFace = static_cast<std::int32_t>(4 * c);
        this->Faces[high] = { Pair(v[2], v[3]), cellFace };
        this->Faces[low] = { Pair(v[2], v[3]), cellFace + 1 };
        this->Faces[low + 1] = { Pair(v[1], v[3]), cellFace + 2 };
        this->Faces[low + 2] = { Pair(v[1], v[2]), cellFace + 3 };
      });
  }

  FiledFace* Begin(std::size_t vertex)
  {
    return this->Faces.get() +
      (vertex == 0 ? 0 : this->Ends[vertex - 1].load(std::memory_order_relaxed));
  }
  FiledFace* End(std::size_t vertex)
  {
    return this->Faces.get() + this->Ends[vertex].load(std::memory_order_relaxed);
  }

private:
  static std::uint64_t Pair(std::int32_t middle, std::int32_t highest)
  {
    return (static_cast<std::uint64_t>(middle) << 32) | static_cast<std::uint32_t>(highest);
  }

  template <typename Body>
  void ForEachCell(std::size_t count, const RangeLoop& loop, Body&& body)
  {
    ForEachBlock(count, loop,
      [&body](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t c = first; c < last; ++c)
        {
          body(c);
        }
      });
  }

  std::unique_ptr<std::atomic<std::uint32_t>[]> Ends;
  std::unique_ptr<FiledFace[]> Faces;
};

/** Sets of patches that are known to be oriented alike or oppositely, joined one by one. */
class SignedSets
{
public:
  explicit SignedSets(std::size_t count)
    : Parents(count)
    , Signs(count, 1)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }

  /** The set of a patch, and the patch's sign in it. */
  std::int32_t Find(std::int32_t patch, int& sign)
  {
    sign = 1;
    std::int32_t root = patch;
    for (; this->Parents[root] != root; root = this->Parents[root])
    {
      sign *= this->Signs[root];
    }
    int remaining = sign;
    while (this->Parents[patch] != root && patch != root)
    {
      const std::int32_t next = this->Parents[patch];
      const int own = this->Signs[patch];
      this->Parents[patch] = root;
      this->Signs[patch] = static_cast<std::int8_t>(remaining);
      remaining *= own;
      patch = next;
    }
    return root;
  }

  /** Notes that sign(a) * sign(b) is `product`; false if the opposite is known. */
  bool Join(std::int32_t a, std::int32_t b, int product)
  {
    int signA = 1;
    int signB = 1;
    const std::int32_t rootA = this->Find(a, signA);
    const std::int32_t rootB = this->Find(b, signB);
    if (rootA == rootB)
    {
      return signA * signB == product;
    }
    const std::int32_t low = std::min(rootA, rootB);
    const std::int32_t high = std::max(rootA, rootB);
    this->Parents[high] = low;
    this->Signs[high] = static_cast<std::int8_t>(signA * signB * product);
    return true;
  }

private:
  std::vector<std::int32_t> Parents;
  /** Relative to the parent. */
  std::vector<std::int8_t> Signs;
};

/**
 * Flood fill in two stages: within blocks of cells, side by side, then from block to block. So the
 * result does not depend on the number of threads.
 */
class Orienter
{
public:
  Orienter(const TetrahedralMesh& mesh, std::vector<TetrahedralMesh::Cell>& cells,
    std::vector<std::int8_t>& orientation, const RangeLoop& loop)
    : Mesh(mesh)
    , Cells(cells)
    , Orientation(orientation)
    , Loop(loop)
    , PatchOf(cells.size())
    , Blocks(NumberOfBlocks(cells.size()))
  {
  }

  /** Returns the number of links cut. */
  std::int64_t Orient()
  {
    this->Orientation.assign(this->Cells.size(), 0);
    ForEachBlock(this->Cells.size(), this->Loop,
      [this](std::size_t block, std::size_t first, std::size_t last)
      { this->FillBlock(this->Blocks[block], first, last); });
    return this->JoinBlocks();
  }

private:
  /** A block's patches (parts connected within it), and its links to later blocks. */
  struct Block
  {
    std::vector<double> Volumes;
    std::vector<std::int32_t> LinksOut;
    std::int64_t CutLinks = 0;
    std::int32_t FirstPatch = 0;
  };

  /** The product of two linked cells' orientations: they see their face from opposite sides. */
  static int Product(int face, std::int32_t link)
  {
    return -FaceParity(face) * FaceParity(link % 4);
  }

  void CutLink(std::int32_t cell, int face)
  {
    std::int32_t& link = this->Cells[cell].Links[face];
    this->Cells[link / 4].Links[link % 4] = TetrahedralMesh::NoNeighbor;
    link = TetrahedralMesh::NoNeighbor;
  }

  void FillBlock(Block& block, std::size_t first, std::size_t last)
  {
    std::vector<std::int32_t> patch;
    for (std::size_t seed = first; seed < last; ++seed)
    {
      if (this->Orientation[seed] != 0)
      {
        continue;
      }
      const auto number = static_cast<std::int32_t>(block.Volumes.size());
      patch.assign(1, static_cast<std::int32_t>(seed));
      this->Orientation[seed] = 1;
      double volume = 0.0;
      for (std::size_t next = 0; next < patch.size(); ++next)
      {
        const std::int32_t cell = patch[next];
        this->PatchOf[cell] = number;
        volume += this->Orientation[cell] * SixfoldVolume(this->Mesh, cell);
        this->VisitNeighbors(block, cell, first, last, patch);
      }
      block.Volumes.push_back(volume);
    }
  }

  void VisitNeighbors(Block& block, std::int32_t cell, std::size_t first, std::size_t last,
    std::vector<std::int32_t>& patch)
  {
    for (int face = 0; face < 4; ++face)
    {
      const std::int32_t link = this->Cells[cell].Links[face];
      const std::int32_t other = link / 4;
      if (link == TetrahedralMesh::NoNeighbor || other < static_cast<std::int64_t>(first))
      {
        continue;
      }
      if (other >= static_cast<std::int64_t>(last))
      {
        block.LinksOut.push_back(4 * cell + face);
        continue;
      }
      const int wanted = this->Orientation[cell] * Product(face, link);
      if (this->Orientation[other] == 0)
      {
        this->Orientation[other] = static_cast<std::int8_t>(wanted);
        patch.push_back(other);
      }
      else if (this->Orientation[other] != wanted)
      {
        this->CutLink(cell, face);
        ++block.CutLinks;
      }
    }
  }

  std::int64_t JoinBlocks()
  {
    std::int32_t numberOfPatches = 0;
    std::int64_t cutLinks = 0;
    std::vector<double> volumes;
    for (Block& block : this->Blocks)
    {
      block.FirstPatch = numberOfPatches;
      numberOfPatches += static_cast<std::int32_t>(block.Volumes.size());
      volumes.insert(volumes.end(), block.Volumes.begin(), block.Volumes.end());
      cutLinks += block.CutLinks;
    }
    SignedSets sets(volumes.size());
    for (const Block& block : this->Blocks)
    {
      for (const std::int32_t from : block.LinksOut)
      {
        const std::int32_t cell = from / 4;
        const std::int32_t link = this->Cells[cell].Links[from % 4];
        const int product =
          Product(from % 4, link) * this->Orientation[cell] * this->Orientation[link / 4];
        if (!sets.Join(this->PatchAt(cell), this->PatchAt(link / 4), product))
        {
          this->CutLink(cell, from % 4);
          ++cutLinks;
        }
      }
    }
    this->ApplySigns(sets, volumes);
    return cutLinks;
  }

  std::int32_t PatchAt(std::int32_t cell) const
  {
    return this->Blocks[cell / BlockSize].FirstPatch + this->PatchOf[cell];
  }

  /** The volume of every component becomes positive. */
  void ApplySigns(SignedSets& sets, const std::vector<double>& volumes)
  {
    std::vector<double> volumeOfSet(volumes.size(), 0.0);
    std::vector<std::int8_t> signs(volumes.size());
    for (std::size_t patch = 0; patch < volumes.size(); ++patch)
    {
      int sign = 1;
      // Not in one expression: the right side of += comes before the left one, which sets the sign.
      const std::int32_t set = sets.Find(static_cast<std::int32_t>(patch), sign);
      volumeOfSet[set] += sign * volumes[patch];
    }
    for (std::size_t patch = 0; patch < volumes.size(); ++patch)
    {
      int sign = 1;
      const std::int32_t set = sets.Find(static_cast<std::int32_t>(patch), sign);
      signs[patch] = static_cast<std::int8_t>(volumeOfSet[set] < 0.0 ? -sign : sign);
    }
    ForEachBlock(this->Cells.size(), this->Loop,
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t c = first; c < last; ++c)
        {
          this->Orientation[c] = static_cast<std::int8_t>(
            this->Orientation[c] * signs[this->PatchAt(static_cast<std::int32_t>(c))]);
        }
      });
  }

  const TetrahedralMesh& Mesh;
  std::vector<TetrahedralMesh::Cell>& Cells;
  std::vector<std::int8_t>& Orientation;
  const RangeLoop& Loop;
  /** Number of each cell's patch within its block. */
  std::vector<std::int32_t> PatchOf;
  std::vector<Block> Blocks;
};

}

//------------------------------------------------------------------------------
void TetrahedralMesh::LinkCells(const RangeLoop& loop)
{
  FaceFile file(this->Cells, this->Positions.size(), loop);
  ForEachBlock(this->Positions.size(), loop,
    [this, &file](std::size_t, std::size_t firstVertex, std::size_t lastVertex)
    {
      for (std::size_t v = firstVertex; v < lastVertex; ++v)
      {
        FiledFace* const last = file.End(v);
        SortFaces(file.Begin(v), last);
        for (FiledFace* group = file.Begin(v); group != last;)
        {
          FiledFace* groupEnd = group + 1;
          while (groupEnd != last && groupEnd->Others == group->Others)
          {
            ++groupEnd;
          }
          if (groupEnd - group == 2)
          {
            const std::int32_t a = group[0].CellFace;
            const std::int32_t b = group[1].CellFace;
            this->Cells[a / 4].Links[a % 4] = b;
            this->Cells[b / 4].Links[b % 4] = a;
          }
          group = groupEnd;
        }
      }
    });
}

//------------------------------------------------------------------------------
void TetrahedralMesh::OrientCells(const RangeLoop& loop)
{
  this->CutLinks = Orienter(*this, this->Cells, this->Orientation, loop).Orient();
}

}

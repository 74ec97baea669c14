// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Topology of the cells of a TetrahedralMesh: links across faces, and orientation.
#include "Common/BitTable.h"
#include "Common/BlockLoop.h"
#include "Volume/Mesh/CellFaces.h"
#include "Volume/Mesh/ComponentVolume.h"
#include "Volume/Mesh/TetrahedralMesh.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <utility>

namespace meniscus
{
namespace
{

/**
 * All faces, grouped by their lowest vertex. Three faces of a cell contain its lowest vertex; the
 * fourth begins with the second lowest. Within a group the order depends on the threads.
 */
class FaceFile
{
public:
  FaceFile(const std::vector<TetrahedralMesh::Cell>& cells, std::size_t numberOfVertices,
    const RangeLoop& loop)
    : Ends(new std::atomic<std::uint32_t>[numberOfVertices])
    , Entries(new std::uint32_t[2 * cells.size()])
  {
    ForEachInBlocks(numberOfVertices, loop,
      [this](std::size_t v) { this->Ends[v].store(0, std::memory_order_relaxed); });
    ForEachInBlocks(cells.size(), loop,
      [&](std::size_t c)
      {
        this->Ends[cells[c].Vertices[0]].fetch_add(1, std::memory_order_relaxed);
        this->Ends[cells[c].Vertices[1]].fetch_add(1, std::memory_order_relaxed);
      });
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < numberOfVertices; ++v)
    {
      const std::uint32_t count = this->Ends[v].load(std::memory_order_relaxed);
      this->Ends[v].store(next, std::memory_order_relaxed);
      next += count;
    }
    // The start of each group moves to its end while the group is filled.
    ForEachInBlocks(cells.size(), loop,
      [&](std::size_t c)
      {
        const auto& v = cells[c].Vertices;
        const auto cell = static_cast<std::uint32_t>(2 * c);
        this->Entries[this->Ends[v[0]].fetch_add(1, std::memory_order_relaxed)] = cell;
        this->Entries[this->Ends[v[1]].fetch_add(1, std::memory_order_relaxed)] = cell + 1;
      });
  }

  /** Entries are 2 * cell, plus 1 if the vertex is the second lowest of the cell. */
  const std::uint32_t* Begin(std::size_t vertex) const
  {
    return this->Entries.get() +
      (vertex == 0 ? 0 : this->Ends[vertex - 1].load(std::memory_order_relaxed));
  }
  const std::uint32_t* End(std::size_t vertex) const
  {
    return this->Entries.get() + this->Ends[vertex].load(std::memory_order_relaxed);
  }

private:
  std::unique_ptr<std::atomic<std::uint32_t>[]> Ends;
  std::unique_ptr<std::uint32_t[]> Entries;
};

/** Links the faces of one group after another, using a hash table of the two other vertices. */
class FaceMatcher
{
public:
  explicit FaceMatcher(std::vector<TetrahedralMesh::Cell>& cells)
    : Cells(cells)
  {
  }

  void MatchGroup(const std::uint32_t* first, const std::uint32_t* last)
  {
    // A cell has up to three faces here; the table has twice as many slots.
    const std::size_t most = 6 * static_cast<std::size_t>(last - first);
    if (most > this->Slots.size())
    {
      std::size_t size = 64;
      while (size < most)
      {
        size *= 2;
      }
      this->Slots.assign(size, Slot());
    }
    ++this->Group;
    for (; first != last; ++first)
    {
      const auto cell = static_cast<std::int32_t>(*first / 2);
      const auto& v = this->Cells[cell].Vertices;
      if (*first % 2 != 0)
      {
        this->Add(v[2], v[3], 4 * cell);
      }
      else
      {
        this->Add(v[2], v[3], 4 * cell + 1);
        this->Add(v[1], v[3], 4 * cell + 2);
        this->Add(v[1], v[2], 4 * cell + 3);
      }
    }
  }

private:
  struct Slot
  {
    std::uint64_t Others = 0;
    std::uint32_t Group = 0;
    /** First face with these vertices, and the second one or NoNeighbor. */
    std::int32_t First = 0;
    std::int32_t Second = 0;
  };

  void Add(std::int32_t middle, std::int32_t highest, std::int32_t cellFace)
  {
    const std::uint64_t others =
      (static_cast<std::uint64_t>(middle) << 32) | static_cast<std::uint32_t>(highest);
    // Fibonacci hashing (D. Knuth, The Art of Computer Programming 3, section 6.4).
    const std::uint64_t hash = (others ^ (others >> 29)) * 0x9E3779B97F4A7C15u;
    const std::size_t mask = this->Slots.size() - 1;
    for (std::size_t at = (hash >> 32) & mask;; at = (at + 1) & mask)
    {
      Slot& slot = this->Slots[at];
      if (slot.Group != this->Group)
      {
        slot = { others, this->Group, cellFace, TetrahedralMesh::NoNeighbor };
        return;
      }
      if (slot.Others == others)
      {
        this->Meet(slot, cellFace);
        return;
      }
    }
  }

  /**
   * Links the face to an earlier one with the same vertices; three or more such faces are not
   * linked.
   */
  void Meet(Slot& slot, std::int32_t cellFace)
  {
    if (slot.Second == TetrahedralMesh::NoNeighbor)
    {
      slot.Second = cellFace;
      this->LinkOf(slot.First) = cellFace;
      this->LinkOf(cellFace) = slot.First;
    }
    else
    {
      this->LinkOf(slot.First) = TetrahedralMesh::NoNeighbor;
      this->LinkOf(slot.Second) = TetrahedralMesh::NoNeighbor;
    }
  }

  std::int32_t& LinkOf(std::int32_t cellFace)
  {
    return this->Cells[cellFace / 4].Links[cellFace % 4];
  }

  std::vector<TetrahedralMesh::Cell>& Cells;
  std::vector<Slot> Slots;
  /** Number of the current group. Slots with another number are empty. */
  std::uint32_t Group = 0;
};

/** Union-find over patches whose relative orientation (equal or opposite) is known. */
class SignedSets
{
public:
  explicit SignedSets(std::size_t count)
    : Parents(count)
    , Signs(count, 1)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }

  /** Adds one patch. */
  std::int32_t Add()
  {
    this->Parents.push_back(static_cast<std::int32_t>(this->Parents.size()));
    this->Signs.push_back(1);
    return this->Parents.back();
  }
  std::size_t GetSize() const { return this->Parents.size(); }

  /** Returns the set of a patch, and the patch's sign in it. */
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

  /**
   * Records that sign(a) * sign(b) is `product`. Returns false if the opposite is known already.
   */
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
  /** Sign relative to the parent. */
  std::vector<std::int8_t> Signs;
};

/**
 * Flood fill in two stages: within blocks of cells in parallel, then from block to block, so that
 * the result does not depend on the number of threads. Within a block, a cell takes the orientation
 * of a neighbour with a smaller index, and patches that meet later are joined, so cells are visited
 * in order.
 */
class Orienter
{
public:
  Orienter(
    const TetrahedralMesh& mesh, std::vector<TetrahedralMesh::Cell>& cells, const RangeLoop& loop)
    : Mesh(mesh)
    , Cells(cells)
    , Loop(loop)
    , Orientation(cells.size(), 0)
    , PatchOf(cells.size())
    , Blocks(NumberOfBlocks(cells.size()))
  {
  }

  /** True if links were cut because volumes cancel. */
  bool HasTakenApart() const { return this->TakenApart; }
  std::int32_t GetNumberOfComponents() const { return this->NumberOfComponents; }
  /** Number of the component of each cell; none if there is one component. */
  std::vector<std::int32_t> TakeComponents() { return std::move(this->Components); }
  /** Marks the cells with a positive orientation. */
  void MarkPositive(BitTable& marks) const
  {
    marks.Assign(this->Orientation.size(), false);
    ForEachInBlocks(this->Orientation.size(), this->Loop,
      [this, &marks](std::size_t c) { marks.Set(c, this->Orientation[c] > 0); });
  }

  /** Returns the number of links cut. */
  std::int64_t Orient()
  {
    ForEachBlock(this->Cells.size(), this->Loop,
      [this](std::size_t block, std::size_t first, std::size_t last)
      { this->FillBlock(this->Blocks[block], first, last); });
    return this->JoinBlocks();
  }

private:
  /** Patches of a block (parts connected within it), and its links to later blocks. */
  struct Block
  {
    std::vector<ComponentVolume> Volumes;
    std::vector<std::int32_t> LinksOut;
    std::int64_t CutLinks = 0;
    std::int32_t FirstPatch = 0;
  };

  /**
   * Product of the orientations of two linked cells, which lie on opposite sides of their common
   * face.
   */
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
    SignedSets sets(0);
    for (std::size_t c = first; c < last; ++c)
    {
      this->TakeOrientation(block, sets, static_cast<std::int32_t>(c), first, last);
    }
    // Joined patches become one.
    std::vector<std::int32_t> numbers(sets.GetSize(), -1);
    std::vector<std::int8_t> signs(sets.GetSize());
    std::int32_t next = 0;
    for (std::size_t patch = 0; patch < numbers.size(); ++patch)
    {
      int sign = 1;
      const std::int32_t root = sets.Find(static_cast<std::int32_t>(patch), sign);
      numbers[root] = numbers[root] < 0 ? next++ : numbers[root];
      numbers[patch] = numbers[root];
      signs[patch] = static_cast<std::int8_t>(sign);
    }
    block.Volumes.assign(static_cast<std::size_t>(next), ComponentVolume());
    for (std::size_t c = first; c < last; ++c)
    {
      const std::int32_t patch = this->PatchOf[c];
      this->Orientation[c] = static_cast<std::int8_t>(this->Orientation[c] * signs[patch]);
      this->PatchOf[c] = numbers[patch];
      block.Volumes[numbers[patch]].Add(
        this->Orientation[c] * SignedVolume(this->Mesh.GetFixedPositions(), this->Cells[c]));
    }
  }

  /** Orients a cell like its earlier neighbours; cuts links that contradict. */
  void TakeOrientation(
    Block& block, SignedSets& sets, std::int32_t cell, std::size_t first, std::size_t last)
  {
    std::int32_t patch = -1;
    for (int face = 0; face < 4; ++face)
    {
      const std::int32_t link = this->Cells[cell].Links[face];
      const std::int32_t other = link / 4;
      if (link != TetrahedralMesh::NoNeighbor && other >= static_cast<std::int64_t>(last))
      {
        block.LinksOut.push_back(4 * cell + face);
      }
      if (link == TetrahedralMesh::NoNeighbor || other > cell ||
        other < static_cast<std::int64_t>(first))
      {
        continue;
      }
      const int wanted = Product(face, link) * this->Orientation[other];
      const std::int32_t patchOfOther = this->PatchOf[other];
      if (patch < 0)
      {
        patch = patchOfOther;
        this->Orientation[cell] = static_cast<std::int8_t>(wanted);
      }
      else if (patchOfOther == patch
          ? this->Orientation[cell] != wanted
          : !sets.Join(patch, patchOfOther, this->Orientation[cell] * wanted))
      {
        this->CutLink(cell, face);
        ++block.CutLinks;
      }
    }
    if (patch < 0)
    {
      patch = sets.Add();
      this->Orientation[cell] = 1;
    }
    this->PatchOf[cell] = patch;
  }

  std::int64_t JoinBlocks()
  {
    std::int32_t numberOfPatches = 0;
    std::int64_t cutLinks = 0;
    std::vector<ComponentVolume> volumes;
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
    this->NumberComponents(sets);
    return cutLinks + this->ApplySigns(sets, volumes);
  }

  std::int32_t PatchAt(std::int32_t cell) const
  {
    return this->Blocks[cell / BlockSize].FirstPatch + this->PatchOf[cell];
  }

  /** Numbers the components in the order of their first cells. */
  void NumberComponents(SignedSets& sets)
  {
    std::vector<std::int32_t> numbers(sets.GetSize(), -1);
    for (std::size_t patch = 0; patch < numbers.size(); ++patch)
    {
      int sign = 1;
      const std::int32_t root = sets.Find(static_cast<std::int32_t>(patch), sign);
      numbers[root] = numbers[root] < 0 ? this->NumberOfComponents++ : numbers[root];
      numbers[patch] = numbers[root];
    }
    if (this->NumberOfComponents == 1)
    {
      return;
    }
    this->Components.resize(this->Cells.size());
    ForEachInBlocks(this->Cells.size(), this->Loop,
      [&](std::size_t c)
      { this->Components[c] = numbers[this->PatchAt(static_cast<std::int32_t>(c))]; });
  }

  /**
   * Makes the volume of every component positive, and takes apart the components whose volumes
   * cancel. Returns the number of links cut.
   */
  std::int64_t ApplySigns(SignedSets& sets, const std::vector<ComponentVolume>& volumes)
  {
    std::vector<ComponentVolume> volumeOfSet(volumes.size());
    std::vector<std::int8_t> signs(volumes.size());
    for (std::size_t patch = 0; patch < volumes.size(); ++patch)
    {
      int sign = 1;
      // Two statements are needed: the call may be evaluated after its argument, which needs the
      // sign.
      const std::int32_t set = sets.Find(static_cast<std::int32_t>(patch), sign);
      volumeOfSet[set].Add(volumes[patch], sign);
    }
    std::vector<std::uint8_t> cancels(volumes.size());
    bool anyCancels = false;
    for (std::size_t patch = 0; patch < volumes.size(); ++patch)
    {
      int sign = 1;
      const std::int32_t set = sets.Find(static_cast<std::int32_t>(patch), sign);
      signs[patch] = static_cast<std::int8_t>(volumeOfSet[set].Sum < 0.0 ? -sign : sign);
      cancels[patch] = volumeOfSet[set].Cancels(NegligibleVolume);
      anyCancels = anyCancels || cancels[patch];
    }
    ForEachInBlocks(this->Cells.size(), this->Loop,
      [&](std::size_t c)
      {
        this->Orientation[c] = static_cast<std::int8_t>(
          this->Orientation[c] * signs[this->PatchAt(static_cast<std::int32_t>(c))]);
      });
    return anyCancels ? this->TakeApart(cancels) : 0;
  }

  /**
   * A part of the mesh that is filled twice, with different cells of the same points, is connected
   * through the faces that both fillings have on the outside. Oriented as one component, half of
   * its cells would be inverted, and it would have no boundary. Its cells are therefore oriented
   * one by one, and links between cells on the same side of their common face are cut. Returns the
   * number of links cut.
   */
  std::int64_t TakeApart(const std::vector<std::uint8_t>& cancels)
  {
    this->TakenApart = true;
    const auto isApart = [&](std::int32_t cell) { return cancels[this->PatchAt(cell)] != 0; };
    const auto size = static_cast<std::int32_t>(this->Cells.size());
    for (std::int32_t c = 0; c < size; ++c)
    {
      const double volume =
        isApart(c) ? SignedVolume(this->Mesh.GetFixedPositions(), this->Cells[c]) : 0.0;
      this->Orientation[c] =
        volume != 0.0 ? static_cast<std::int8_t>(volume > 0.0 ? 1 : -1) : this->Orientation[c];
    }
    std::int64_t cutLinks = 0;
    for (std::int32_t c = 0; c < size; ++c)
    {
      for (int face = 0; isApart(c) && face < 4; ++face)
      {
        const std::int32_t link = this->Cells[c].Links[face];
        if (link != TetrahedralMesh::NoNeighbor &&
          Product(face, link) != this->Orientation[c] * this->Orientation[link / 4])
        {
          this->CutLink(c, face);
          ++cutLinks;
        }
      }
    }
    return cutLinks;
  }

  const TetrahedralMesh& Mesh;
  std::vector<TetrahedralMesh::Cell>& Cells;
  const RangeLoop& Loop;
  /** 1 or -1 per cell; 0 if not known yet. */
  std::vector<std::int8_t> Orientation;
  /** Index of each cell's patch within its block. */
  std::vector<std::int32_t> PatchOf;
  std::vector<Block> Blocks;
  std::vector<std::int32_t> Components;
  std::int32_t NumberOfComponents = 0;
  bool TakenApart = false;
};

}

//------------------------------------------------------------------------------
void TetrahedralMesh::LinkCells(const RangeLoop& loop)
{
  const FaceFile file(this->Cells, this->Positions.size(), loop);
  ForEachBlock(this->Positions.size(), loop,
    [this, &file](std::size_t, std::size_t firstVertex, std::size_t lastVertex)
    {
      FaceMatcher matcher(this->Cells);
      for (std::size_t v = firstVertex; v < lastVertex; ++v)
      {
        matcher.MatchGroup(file.Begin(v), file.End(v));
      }
    });
}

//------------------------------------------------------------------------------
void TetrahedralMesh::OrientCells(const RangeLoop& loop)
{
  Orienter orienter(*this, this->Cells, loop);
  this->CutLinks = orienter.Orient();
  orienter.MarkPositive(this->IsPositive);
  this->Components = orienter.TakeComponents();
  this->NumberOfComponents = orienter.GetNumberOfComponents();
  this->IsMovable = this->IsMovable && !orienter.HasTakenApart();
}

}

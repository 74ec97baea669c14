// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraWalk.glsl (step through a cell)
#ifndef meniscus_Volume_Packet_Walk_PacketWalk_h
#define meniscus_Volume_Packet_Walk_PacketWalk_h

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketLights.h"
#include "Volume/Packet/Models/VertexAttributes.h"
#include "Volume/Rays/ExactEdgeTest.h"

#include <array>

namespace meniscus
{

/**
 * Walks rays from cell to cell by edge signs in the ray-aligned projection, one ray per lane. A
 * lane whose ray has ended takes the next ray of the job.
 *
 * A vertex has coordinates (u, v) relative to a ray: the same function of vertex and ray wherever
 * it is needed, rounded to integer grid units. The sign of an edge, which tells the side on which
 * the ray passes, is that of a cross product; it is computed in float where the rounding error
 * cannot change it, otherwise in 64-bit integers. A ray through an edge or a vertex is treated as
 * displaced by (e, e^2) for an arbitrarily small e, and edges whose ends coincide are ordered by
 * vertex. Therefore every cell that is entered has exactly one face by which to leave, every face
 * and side can be reached in one way only, and a walk that begins on the boundary ends on the
 * boundary.
 */
template <class Simd, class Model>
class PacketWalk
{
public:
  explicit PacketWalk(const PacketJob& job);
  void Run();

private:
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;
  using Grid = ExactEdgeTest<Simd>;
  using VertexValues = VertexAttributes<Simd, Model::NumberOfTriples>;
  using CellValues = VertexAttributes<Simd, Model::UsesCellGradients ? 1 : 0>;
  static constexpr int Width = Simd::Width;

  /** A vertex relative to the ray of each lane. */
  struct Corner
  {
    Float U;
    Float V;
    Float Depth;
    Float Scalar;
    /**
     * Rank of the vertex among those of its face: 0, 1 or 2. Cells and faces order vertices in the
     * same way.
     */
    Int Rank;
    /** Further values that models need. */
    VertexValues Others{};
  };
  /** Offset of one axis of PacketRay, by lane; even and odd lanes are multiplied separately. */
  struct Shift
  {
    std::int32_t Slope[Width];
    std::int64_t Offset[2][Width / 2];

    void Set(int lane, std::int32_t slope, std::int64_t offset)
    {
      this->Slope[lane] = slope;
      this->Offset[lane % 2][lane / 2] = offset;
    }
  };

  void Place(const Float (&vertex)[4], Corner& corner) const;
  void Project(Int id, Corner& corner) const;
  static Float EdgeArea(const Corner& p, const Corner& q, Float& excess);
  void MakeSure(
    unsigned int lanes, const Int (&corners)[4], Float (&areas)[3], Mask (&left)[3]) const;
  /**
   * The cell to be entered next: the face by which it is entered, its links, and the vertex
   * opposite that face.
   */
  struct Ahead
  {
    Int Face;
    Int Links[4];
    Corner X;
    /** Used with scalars of cells only. */
    Float CellScalar;
    CellValues Gradient;
  };
  void Fetch(Ahead& ahead) const;
  void Step(Mask lanes, const Ahead& ahead);
  static void ReplaceCorner(Mask lanes, const Corner& x, Corner& corner);
  void Interpolate(Float& depth, Float& scalar, VertexValues& others) const;
  Int OppositeVertices(Int cellFace) const;
  CellValues GradientsOf(Int cellFace) const;
  void LoadLines();
  /** Place of a segment, for models that need it. */
  struct SegmentPlace
  {
    Float StartDepth;
    Float EndDepth;
    /** 4 * cell + face by which the cell was entered. */
    Int CellFace;
    /** Index of each lane's ray. */
    const std::int32_t (&Rays)[Width];
    /**
     * Lanes that crossed a cell, and lanes whose segment begins behind the face by which the cell
     * was entered.
     */
    Mask Stepped;
    Mask Late;
    const VertexValues& StartValues;
    const VertexValues& EndValues;
    /** Gradient of the scalar in the cell, in normalised model coordinates. */
    const CellValues& CellGradient;
    const PacketLine<Simd>& Ray;
  };
  void Pass(Mask lanes, Int cellFace, const Ahead& crossed);

  unsigned int Replace(unsigned int ended);
  bool NextEntry(int lane);
  bool TakeRay(int lane);
  void Finish(int lane);
  std::int32_t EndOf(int lane) const;
  void StoreLanes();
  void LoadLanes();
  void Enter(Mask lanes);

  const PacketJob& Job;
  const float* VertexTable;
  const float* ValueTables[2];
  std::int32_t NextRay = 0;
  std::int32_t StepLimit;

  Model Integral;
  Shift Axes[2];
  // Vertices of the face just entered by, counter-clockwise about the ray, and twice the areas that
  // its edges AB, BC, CA span with the ray.
  Corner A;
  Corner B;
  Corner C;
  Float AreaAB;
  Float AreaBC;
  Float AreaCA;
  /** 4 * cell + face just entered by; negative outside of the mesh. */
  Int CellFace;
  Float FaceDepth;
  Float FaceScalar;
  VertexValues FaceValues;
  /** Line of each lane's ray, for models that need it. */
  PacketLine<Simd> Line;
  /** Largest depth reached. */
  Float DepthNow;
  Float StartDepth;
  Float EndDepth;
  Float LengthPerDepth;
  Int Steps;
  /** Lanes with a ray, and lanes with a segment that is not yet completely integrated. */
  Mask Busy;
  Mask Pending;

  // By lane, for the scalar code that replaces rays.
  std::int32_t Ray[Width];
  std::int32_t Entry[Width];
  std::int32_t Ids[3][Width];
  std::int32_t CellFaces[Width];
  std::int32_t StepsOf[Width];
  float DepthsNow[Width];
  float StartDepths[Width];
  float EndDepths[Width];
  float LengthsPerDepth[Width];
  float Values[Model::NumberOfValues][Width];
  unsigned int OnBits = 0;
};

//------------------------------------------------------------------------------
template <class Simd, class Model>
PacketWalk<Simd, Model>::PacketWalk(const PacketJob& job)
  : Job(job)
  , VertexTable(&job.Vertices->Scalar - 3)
  , Integral(job)
{
  // A ray crosses a cell at most once through each of its 4 faces, in 2 orientations.
  const std::int64_t limit = 8 * job.NumberOfCells;
  this->StepLimit = static_cast<std::int32_t>(limit < 0x7fffffff ? limit : 0x7fffffff);
  const Int none = Simd::Splat(0);
  const Float zero = Simd::Splat(0.0f);
  this->A = Corner{ zero, zero, zero, zero, none };
  this->A.Others.Clear();
  this->B = this->C = this->A;
  this->AreaAB = this->AreaBC = this->AreaCA = zero;
  this->FaceDepth = this->FaceScalar = zero;
  this->FaceValues.Clear();
  this->Line = { zero, zero, zero, zero };
  // Gradients come first.
  const bool gradients = job.Medium && job.VertexGradients;
  this->ValueTables[0] = gradients ? job.VertexGradients : job.Components;
  this->ValueTables[1] = job.Components;
  this->Steps = none;
  this->Busy = this->Pending = Simd::FromBits(0);
  for (int lane = 0; lane < Width; ++lane)
  {
    this->Ray[lane] = -1;
    this->Ids[0][lane] = this->Ids[1][lane] = this->Ids[2][lane] = 0;
    this->CellFaces[lane] = this->StepsOf[lane] = 0;
    this->DepthsNow[lane] = this->StartDepths[lane] = this->EndDepths[lane] = 0.0f;
    this->LengthsPerDepth[lane] = 0.0f;
    this->Axes[0].Set(lane, 0, 0);
    this->Axes[1].Set(lane, 0, 0);
  }
  this->LoadLanes();
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::Run()
{
  // Replacing rays costs about as much as a step: it is worthwhile once half of the lanes wait.
  constexpr int enough = Width / 2;
  const Int zero = Simd::Splat(0);
  unsigned int busy = this->Replace((1u << Width) - 1u);
  while (busy != 0)
  {
    // The cell ahead is fetched before the segment behind is integrated, which hides the latency.
    // In meshes whose cells share no faces, there is often no cell ahead in any lane.
    Ahead ahead;
    const bool inside = (busy & ~Simd::Bits(this->CellFace < zero)) != 0;
    if (inside)
    {
      this->Fetch(ahead);
    }
    this->Pending = this->Integral.Advance(this->Pending);
    const Mask on =
      Simd::AndNot(this->DepthNow < this->EndDepth, this->CellFace < zero) & this->Integral.IsOn();
    const unsigned int ended = busy &
      ~Simd::Bits((this->Steps < Simd::Splat(this->StepLimit)) & on) & ~Simd::Bits(this->Pending);
    if (ended == busy ||
      (this->NextRay < this->Job.NumberOfRays && __builtin_popcount(ended) >= enough))
    {
      busy = this->Replace(ended);
      continue;
    }
    if (!inside)
    {
      continue; // segments with further pieces are pending
    }
    this->Step(Simd::AndNot(this->Busy & on, this->Pending), ahead);
  }
}

//------------------------------------------------------------------------------
/** Loads a vertex relative to the rays, except for its Rank. */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Place(const Float (&vertex)[4], Corner& corner) const
{
  const Int depth = Simd::AsInt(vertex[2]);
  const auto aboutRay = [&](const Shift& axis, Float place)
  {
    const Int shift = Simd::MultiplyHigh(depth, axis.Slope, axis.Offset[0], axis.Offset[1]);
    return Simd::ToFloat(Simd::AsInt(place) - shift);
  };
  corner.U = aboutRay(this->Axes[0], vertex[0]);
  corner.V = aboutRay(this->Axes[1], vertex[1]);
  corner.Depth = Simd::ToFloat(depth) * Simd::Splat(PacketVertex::DepthUnit);
  corner.Scalar = vertex[3];
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::Project(Int id, Corner& corner) const
{
  Float vertex[4];
  Simd::template GatherQuads<4>(this->VertexTable, id, vertex[0], vertex[1], vertex[2], vertex[3]);
  this->Place(vertex, corner);
  corner.Others.Gather(this->ValueTables, id);
}

//------------------------------------------------------------------------------
/**
 * Twice the area that the edge pq spans with the ray. Each factor has a relative error of 2^-24,
 * and so have their products and difference: the error is less than 2^-22 (|area| + 2 |pv qu|) in
 * all. The sign is therefore certain if |area| - 2^-20 |pv qu| is positive; `excess` is lowered to
 * that value.
 */
template <class Simd, class Model>
inline auto PacketWalk<Simd, Model>::EdgeArea(const Corner& p, const Corner& q, Float& excess)
  -> Float
{
  const Float area = Simd::CrossProduct(p.U, p.V, q.U, q.V);
  const Float bound = Simd::Abs(p.V * q.U) * Simd::Splat(Grid::RoundingOfArea);
  excess = Simd::Min(excess, Simd::Abs(area) - bound);
  return area;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Fetch(Ahead& ahead) const
{
  // Lanes outside of the mesh use cell 0.
  const Int zero = Simd::Splat(0);
  const Int cellFace = Simd::Select(this->CellFace < zero, zero, this->CellFace);
  Float vertex[4];
  ahead.Face = Simd::And(cellFace, Simd::Splat(3));
  Simd::GatherCells(this->Job.Cells, this->VertexTable, cellFace, ahead.Links, vertex);
  this->Place(vertex, ahead.X);
  if constexpr (Model::NumberOfTriples > 0)
  {
    ahead.X.Others.Gather(this->ValueTables, this->OppositeVertices(cellFace));
  }
  if constexpr (Model::UsesCellGradients)
  {
    ahead.Gradient = this->GradientsOf(cellFace);
  }
  ahead.CellScalar = this->Job.CellScalars
    ? Simd::GatherCellScalars(this->Job.CellScalars, cellFace)
    : Simd::Splat(0.0f);
}

//------------------------------------------------------------------------------
/** Crosses the cells of `lanes` and passes the segments to the integral. */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Step(Mask lanes, const Ahead& ahead)
{
  const Corner& x = ahead.X;
  const Float zero = Simd::Splat(0.0f);
  Float excess = Simd::Splat(1.0f);
  Float areas[3] = { EdgeArea(x, this->A, excess), EdgeArea(x, this->B, excess),
    EdgeArea(x, this->C, excess) };
  Mask left[3] = { areas[0] > zero, areas[1] > zero, areas[2] > zero };

  // Positions of the vertices in the cell: the ranks in a face skip the vertex opposite it. In
  // lanes without a step the last position is used for that vertex, which has no effect.
  const Int last = Simd::Splat(3);
  const Int face = Simd::Select(lanes, ahead.Face, last);
  const Int before = face - Simd::Splat(1);
  const auto placeOf = [&](const Corner& corner)
  { return Simd::Increment(corner.Rank > before, corner.Rank); };
  const Int places[4] = { face, placeOf(this->A), placeOf(this->B), placeOf(this->C) };
  const unsigned int unsureBits = Simd::Bits(Simd::AndNot(lanes, excess > zero));
  if (unsureBits != 0)
  {
    this->MakeSure(unsureBits, places, areas, left);
  }

  // The ray leaves between two consecutive edges from x: left of one and right of the next. The
  // third vertex is dropped; the link to follow is across the face opposite it.
  const Mask dropC = Simd::AndNot(left[0], left[1]);
  const Mask dropA = Simd::AndNot(Simd::AndNot(left[1], left[2]), dropC);
  const Mask keepB = dropC | dropA;
  const Int opposite = Simd::Select(dropA, places[1], Simd::Select(dropC, places[3], places[2]));
  const Int link = Simd::Pick(opposite, ahead.Links);
  const Int dropped = Simd::Select(lanes, opposite, last);

  // Exit face: x replaces the dropped vertex, which keeps the sense of rotation.
  const Mask replaceA = dropA & lanes;
  const Mask replaceC = dropC & lanes;
  const Mask replaceB = Simd::AndNot(lanes, keepB);
  for (Float& area : areas)
  {
    area = Simd::Abs(area);
  }
  this->AreaAB = Simd::Select(replaceA, areas[1], Simd::Select(replaceB, areas[0], this->AreaAB));
  this->AreaBC = Simd::Select(replaceB, areas[2], Simd::Select(replaceC, areas[1], this->AreaBC));
  this->AreaCA = Simd::Select(replaceA, areas[2], Simd::Select(replaceC, areas[0], this->AreaCA));
  const auto replace = [&](Mask replaced, Int place, Corner& corner)
  {
    ReplaceCorner(replaced, x, corner);
    const Int kept = Simd::Select(replaced, face, place);
    corner.Rank = Simd::Decrement(kept > dropped, kept);
  };
  replace(replaceA, places[1], this->A);
  replace(replaceB, places[2], this->B);
  replace(replaceC, places[3], this->C);
  const Int crossed = this->CellFace;
  this->CellFace = Simd::Select(lanes, link, this->CellFace);
  this->Steps = this->Steps + Simd::One(lanes);
  this->Pass(lanes, crossed, ahead);
}

//------------------------------------------------------------------------------
/** Replaces all members but Rank. */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::ReplaceCorner(Mask lanes, const Corner& x, Corner& corner)
{
  corner.U = Simd::Select(lanes, x.U, corner.U);
  corner.V = Simd::Select(lanes, x.V, corner.V);
  corner.Depth = Simd::Select(lanes, x.Depth, corner.Depth);
  corner.Scalar = Simd::Select(lanes, x.Scalar, corner.Scalar);
  corner.Others.Replace(lanes, x.Others);
}

//------------------------------------------------------------------------------
/**
 * Values at the ray's intersection with ABC; a face without projected area keeps the given values.
 */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Interpolate(
  Float& depth, Float& scalar, VertexValues& others) const
{
  const Float total = this->AreaAB + this->AreaBC + this->AreaCA;
  const Mask real = total > Simd::Splat(0.0f);
  const Float inverse = Simd::Splat(1.0f) / total;
  const auto mean = [&](Float a, Float b, Float c)
  { return Simd::Fma(Simd::Fma(this->AreaCA, b - a, this->AreaAB * (c - a)), inverse, a); };
  depth = Simd::Select(real, mean(this->A.Depth, this->B.Depth, this->C.Depth), depth);
  scalar = Simd::Select(real, mean(this->A.Scalar, this->B.Scalar, this->C.Scalar), scalar);
  for (int i = 0; i < VertexValues::Size; ++i)
  {
    const Float value = mean(this->A.Others.Of[i], this->B.Others.Of[i], this->C.Others.Of[i]);
    others.Of[i] = Simd::Select(real, value, others.Of[i]);
  }
}

//------------------------------------------------------------------------------
/** Passes the part of the ray between the last face and this one to the integral. */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Pass(Mask lanes, Int cellFace, const Ahead& crossed)
{
  Float depth = this->FaceDepth;
  Float scalar = this->FaceScalar;
  VertexValues exitValues = this->FaceValues;
  this->Interpolate(depth, scalar, exitValues);

  // The part before the largest depth reached has been passed already and is not passed again.
  const Float start = Simd::Max(this->DepthNow, this->StartDepth);
  const Float end = Simd::Min(depth, this->EndDepth);
  Float from = this->FaceScalar;
  Float to = scalar;
  VertexValues fromValues = this->FaceValues;
  VertexValues toValues = exitValues;
  const Mask late = start > this->FaceDepth;
  const Mask early = depth > end;
  if (this->Job.CellScalars)
  {
    // A jump between cells is integrated where the cell is entered, unless the ray begins behind
    // that face.
    to = crossed.CellScalar;
    from = Simd::Select(this->StartDepth > this->FaceDepth, to, this->FaceScalar);
    from = Model::SeesJumps ? from : to;
  }
  else if (Simd::Bits(lanes & (late | early)) != 0)
  {
    const Float perDepth = (scalar - this->FaceScalar) / (depth - this->FaceDepth);
    from = Simd::Select(late, Simd::Fma(start - this->FaceDepth, perDepth, this->FaceScalar), from);
    to = Simd::Select(early, Simd::Fma(end - this->FaceDepth, perDepth, this->FaceScalar), to);
    if constexpr (Model::NumberOfTriples > 0)
    {
      const Float whole = depth - this->FaceDepth;
      const auto at = [&](Float place)
      { return this->FaceValues.Between((place - this->FaceDepth) / whole, exitValues); };
      fromValues.Replace(late, at(start));
      toValues.Replace(early, at(end));
    }
  }
  const Mask segment = lanes & (end > start);
  const SegmentPlace place{ start, end, cellFace, this->Ray, lanes, late, fromValues, toValues,
    crossed.Gradient, this->Line };
  this->Pending = this->Pending |
    this->Integral.Begin(segment, from, to, (end - start) * this->LengthPerDepth, place);
  this->DepthNow = Simd::Select(lanes, Simd::Max(this->DepthNow, depth), this->DepthNow);
  this->FaceDepth = Simd::Select(lanes, depth, this->FaceDepth);
  this->FaceValues.Replace(lanes, exitValues);
  Mask known = lanes;
  if (this->Job.CellScalars)
  {
    // The scalar is that of the last integrated cell.
    known = SegmentsOf<Simd>(segment, from, to, end - start) |
      Simd::AndNot(lanes, depth > this->StartDepth);
    scalar = crossed.CellScalar;
  }
  this->FaceScalar = Simd::Select(known, scalar, this->FaceScalar);
}

//------------------------------------------------------------------------------
/**
 * Assigns the next entry of their ray, or the next ray, to lanes whose walk has ended. Returns the
 * lanes that have a ray.
 */
template <class Simd, class Model>
unsigned int PacketWalk<Simd, Model>::Replace(unsigned int ended)
{
  this->StoreLanes();
  unsigned int busy = Simd::Bits(this->Busy);
  unsigned int entering = 0;
  unsigned int fresh = 0;
  for (int lane = 0; lane < Width; ++lane)
  {
    const unsigned int bit = 1u << lane;
    if ((ended & bit) == 0)
    {
      continue;
    }
    if (this->Ray[lane] >= 0 && this->NextEntry(lane))
    {
      entering |= bit;
      continue;
    }
    if (this->Ray[lane] >= 0)
    {
      this->Finish(lane);
    }
    const bool taken = this->TakeRay(lane);
    entering |= taken ? bit : 0u;
    fresh |= taken ? bit : 0u;
    busy = taken ? busy | bit : busy & ~bit;
  }
  this->Busy = Simd::FromBits(busy);
  this->LoadLanes();
  this->Integral.Reset(Simd::FromBits(fresh));
  this->Enter(Simd::FromBits(entering));
  return busy;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
bool PacketWalk<Simd, Model>::NextEntry(int lane)
{
  const PacketRay& ray = this->Job.Rays[this->Ray[lane]];
  const std::int32_t next = this->Entry[lane] + 1;
  if (next >= ray.EndEntry || this->CellFaces[lane] >= 0 ||
    !(this->DepthsNow[lane] < ray.EndDepth) || !(this->Job.Entries[next].Depth < ray.EndDepth) ||
    (this->OnBits >> lane & 1u) == 0)
  {
    return false;
  }
  this->Entry[lane] = next;
  const PacketEntry& entry = this->Job.Entries[next];
  for (int i = 0; i < 3; ++i)
  {
    this->Ids[i][lane] = entry.Vertices[i];
  }
  this->CellFaces[lane] = entry.CellFace;
  return true;
}

//------------------------------------------------------------------------------
/** Starts the next ray that has an entry before its end. Returns false if there is none. */
template <class Simd, class Model>
bool PacketWalk<Simd, Model>::TakeRay(int lane)
{
  while (this->NextRay < this->Job.NumberOfRays)
  {
    const std::int32_t number = this->NextRay++;
    const PacketRay& ray = this->Job.Rays[number];
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Axes[axis].Set(lane, ray.Slope[axis], ray.Offset[axis]);
    }
    for (int k = 0; k < Model::NumberOfValues; ++k)
    {
      this->Values[k][lane] = Model::Empty[k];
    }
    this->OnBits |= 1u << lane;
    this->LengthsPerDepth[lane] = ray.LengthPerDepth;
    this->StartDepths[lane] = ray.StartDepth;
    this->EndDepths[lane] = ray.EndDepth;
    this->DepthsNow[lane] = -1.0e+30f;
    this->StepsOf[lane] = 0;
    this->CellFaces[lane] = -1;
    this->Ray[lane] = number;
    this->Entry[lane] = ray.FirstEntry - 1;
    if (this->NextEntry(lane))
    {
      return true;
    }
    this->Finish(lane);
  }
  this->Ray[lane] = -1;
  return false;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::Finish(int lane)
{
  PacketResult& result = this->Job.Results[this->Ray[lane]];
  float values[Model::NumberOfValues];
  for (int k = 0; k < Model::NumberOfValues; ++k)
  {
    values[k] = this->Values[k][lane];
  }
  if (this->Job.KeepsValues)
  {
    for (int k = 0; k < Model::NumberOfValues; ++k)
    {
      result.Color[k] = values[k];
    }
  }
  else
  {
    Model::Finish(this->Job, values, result.Color);
  }
  result.End = this->EndOf(lane);
  result.Steps = this->StepsOf[lane];
  result.Lost = this->StepsOf[lane] >= this->StepLimit && this->CellFaces[lane] >= 0 ? 1 : 0;
}

//------------------------------------------------------------------------------
/** PacketResult::End of a finished ray. */
template <class Simd, class Model>
std::int32_t PacketWalk<Simd, Model>::EndOf(int lane) const
{
  const PacketRay& ray = this->Job.Rays[this->Ray[lane]];
  const std::int32_t next = this->Entry[lane] + 1;
  const bool more = next < ray.EndEntry && this->Job.Entries[next].Depth < ray.EndDepth;
  const bool inside = !(this->DepthsNow[lane] < ray.EndDepth);
  if (!inside && !more)
  {
    return PacketResult::Outside;
  }
  return inside && !more && this->CellFaces[lane] >= 0 ? this->CellFaces[lane]
                                                       : PacketResult::Somewhere;
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::StoreLanes()
{
  Simd::Store(this->DepthsNow, this->DepthNow);
  Simd::Store(this->StepsOf, this->Steps);
  Simd::Store(this->CellFaces, this->CellFace);
  this->Integral.Store(this->Values);
  this->OnBits = Simd::Bits(this->Integral.IsOn());
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::LoadLanes()
{
  this->DepthNow = Simd::Load(this->DepthsNow);
  this->Steps = Simd::Load(this->StepsOf);
  this->CellFace = Simd::Load(this->CellFaces);
  this->StartDepth = Simd::Load(this->StartDepths);
  this->EndDepth = Simd::Load(this->EndDepths);
  this->LengthPerDepth = Simd::Load(this->LengthsPerDepth);
  if constexpr (Model::UsesLines)
  {
    this->LoadLines();
  }
}

//------------------------------------------------------------------------------
template <class Simd, class Model>
void PacketWalk<Simd, Model>::Enter(Mask lanes)
{
  Corner* const corners[3] = { &this->A, &this->B, &this->C };
  const Int ids[3] = { Simd::Load(this->Ids[0]), Simd::Load(this->Ids[1]),
    Simd::Load(this->Ids[2]) };
  for (int i = 0; i < 3; ++i)
  {
    Corner x;
    this->Project(ids[i], x);
    ReplaceCorner(lanes, x, *corners[i]);
    Int rank = Simd::Splat(0);
    rank = Simd::Increment(ids[i] > ids[(i + 1) % 3], rank);
    rank = Simd::Increment(ids[i] > ids[(i + 2) % 3], rank);
    corners[i]->Rank = Simd::Select(lanes, rank, corners[i]->Rank);
  }
  const auto area = [lanes](const Corner& p, const Corner& q, Float& kept)
  { kept = Simd::Select(lanes, Simd::Abs(Simd::CrossProduct(p.U, p.V, q.U, q.V)), kept); };
  area(this->A, this->B, this->AreaAB);
  area(this->B, this->C, this->AreaBC);
  area(this->C, this->A, this->AreaCA);
  // A face without projected area is met at its first vertex.
  Float depth = this->A.Depth;
  Float scalar = this->A.Scalar;
  VertexValues others = this->A.Others;
  this->Interpolate(depth, scalar, others);
  if (this->Job.CellScalars)
  {
    const Int zero = Simd::Splat(0);
    scalar = Simd::GatherCellScalars(
      this->Job.CellScalars, Simd::Select(this->CellFace < zero, zero, this->CellFace));
  }
  this->FaceDepth = Simd::Select(lanes, depth, this->FaceDepth);
  this->FaceScalar = Simd::Select(lanes, scalar, this->FaceScalar);
  this->FaceValues.Replace(lanes, others);
  this->DepthNow = Simd::Select(lanes, Simd::Max(this->DepthNow, depth), this->DepthNow);
  this->Integral.Enter(lanes);
}

}

#include "Volume/Packet/Walk/PacketWalkExact.h"
#include "Volume/Packet/Walk/PacketWalkOptics.h"

#endif

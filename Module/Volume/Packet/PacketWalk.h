// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Packet_PacketWalk_h
#define meniscus_Volume_Packet_PacketWalk_h

#include "Volume/Packet/Packet.h"
#include "Volume/Packet/PacketIntegral.h"

namespace meniscus
{

/**
 * Rays from cell to cell by edge signs in the ray-aligned projection, one ray per lane; a lane
 * whose ray has ended takes the next of the job.
 *
 * A vertex has coordinates (u, v) about a ray: the same function of vertex and ray wherever it is
 * needed, rounded to whole grid units. The sign of an edge, which side of it the ray passes, is
 * that of a cross product: taken in float where that is sure, else in 64-bit integers. A ray
 * through an edge or a vertex counts as displaced by (e, e^2) for an arbitrarily small e, and edges
 * whose ends coincide are ordered by vertex. So every cell that is entered has exactly one face to
 * leave by, every face and side one way to come there, and a walk that begins on the boundary ends
 * on the boundary.
 */
template <class Simd>
class PacketWalk
{
public:
  explicit PacketWalk(const PacketJob& job);
  void Run();

private:
  using Float = typename Simd::Float;
  using Int = typename Simd::Int;
  using Mask = typename Simd::Mask;
  static constexpr int Width = Simd::Width;

  /** A vertex about the ray of each lane. */
  struct Corner
  {
    Float U;
    Float V;
    Float Depth;
    Float Scalar;
    Int Id;
  };
  /** The rows of PacketRay by lane. */
  struct Row
  {
    double Of[4][Width];
  };

  typename Simd::Double Transform(const Row& row, Int x, Int y, Int z) const;
  void ProjectOnGrid(Int id, Int& u, Int& v) const;
  void Place(const Float (&vertex)[4], Corner& corner) const;
  void Project(Int id, Corner& corner) const;
  static Float EdgeArea(const Corner& p, const Corner& q, Float& excess);
  static bool TurnsLeft(const std::int32_t (&p)[3], const std::int32_t (&q)[3], float& area);
  void MakeSure(const Corner& x, unsigned int lanes, Float (&areas)[3], Mask (&left)[3]) const;
  /** The cell that is entered next: its vertices, its links and the vertex not seen yet. */
  struct Ahead
  {
    Int Ids[4];
    Int Links[4];
    Corner X;
  };
  void Fetch(Ahead& ahead) const;
  static Int PickByRank(Int rank, const Int (&of)[4]);
  void Step(Mask lanes, const Ahead& ahead);
  static void ReplaceCorner(Mask lanes, const Corner& x, Corner& corner);
  void Interpolate(Float& depth, Float& scalar) const;
  void Pass(Mask lanes);

  unsigned int Replace(unsigned int ended);
  bool NextEntry(int lane);
  bool TakeRay(int lane);
  void Finish(int lane);
  void StoreLanes();
  void LoadLanes();
  void Enter(Mask lanes);

  const PacketJob& Job;
  const float* VertexTable;
  std::int32_t NextRay = 0;
  std::int32_t StepLimit;

  PacketIntegral<Simd> Integral;
  Row U;
  Row V;
  Row Depth;
  // The face just entered by, counter-clockwise about the ray, and twice the areas that its edges
  // AB, BC, CA span with the ray.
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
  /** The largest depth reached. */
  Float DepthNow;
  Float StartDepth;
  Float EndDepth;
  Float LengthPerDepth;
  Int Steps;
  /** Lanes with a ray; with a segment not yet integrated to its end. */
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
  float Colors[4][Width];
};

//------------------------------------------------------------------------------
template <class Simd>
PacketWalk<Simd>::PacketWalk(const PacketJob& job)
  : Job(job)
  , VertexTable(&job.Vertices->Scalar - 3)
  , Integral(job.Intervals, job.NumberOfIntervals, job.TerminationTransmittance)
{
  // A ray crosses a cell once through each of its 4 faces, in 2 orientations, at the most.
  const std::int64_t limit = 8 * job.NumberOfCells;
  this->StepLimit = static_cast<std::int32_t>(limit < 0x7fffffff ? limit : 0x7fffffff);
  const Int none = Simd::Splat(0);
  const Float zero = Simd::Splat(0.0f);
  this->A = this->B = this->C = { zero, zero, zero, zero, none };
  this->AreaAB = this->AreaBC = this->AreaCA = zero;
  this->FaceDepth = this->FaceScalar = zero;
  this->Steps = none;
  this->Busy = this->Pending = Simd::FromBits(0);
  for (int lane = 0; lane < Width; ++lane)
  {
    this->Ray[lane] = -1;
    this->Ids[0][lane] = this->Ids[1][lane] = this->Ids[2][lane] = 0;
    this->CellFaces[lane] = this->StepsOf[lane] = 0;
    this->DepthsNow[lane] = this->StartDepths[lane] = this->EndDepths[lane] = 0.0f;
    this->LengthsPerDepth[lane] = 0.0f;
    for (int k = 0; k < 4; ++k)
    {
      this->U.Of[k][lane] = this->V.Of[k][lane] = this->Depth.Of[k][lane] = 0.0;
    }
  }
  this->LoadLanes();
}

//------------------------------------------------------------------------------
template <class Simd>
void PacketWalk<Simd>::Run()
{
  // Replacing rays costs about as much as a step: worth it once half of the lanes wait.
  constexpr int enough = Width / 2;
  const Int zero = Simd::Splat(0);
  unsigned int busy = this->Replace((1u << Width) - 1u);
  while (busy != 0)
  {
    // The cell ahead is fetched before the segment behind is integrated, which takes as long.
    Ahead ahead;
    this->Fetch(ahead);
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
    this->Step(Simd::AndNot(this->Busy & on, this->Pending), ahead);
  }
}

//------------------------------------------------------------------------------
template <class Simd>
inline auto PacketWalk<Simd>::Transform(const Row& row, Int x, Int y, Int z) const ->
  typename Simd::Double
{
  return Simd::Fma(Simd::ToDouble(x), Simd::Load(row.Of[0]),
    Simd::Fma(Simd::ToDouble(y), Simd::Load(row.Of[1]),
      Simd::Fma(Simd::ToDouble(z), Simd::Load(row.Of[2]), Simd::Load(row.Of[3]))));
}

//------------------------------------------------------------------------------
/** A vertex of the table about the rays; its Id is left. */
template <class Simd>
inline void PacketWalk<Simd>::Place(const Float (&vertex)[4], Corner& corner) const
{
  const Int x = Simd::AsInt(vertex[0]);
  const Int y = Simd::AsInt(vertex[1]);
  const Int z = Simd::AsInt(vertex[2]);
  corner.U = Simd::ToFloat(Simd::Round(this->Transform(this->U, x, y, z)));
  corner.V = Simd::ToFloat(Simd::Round(this->Transform(this->V, x, y, z)));
  corner.Depth = Simd::ToFloat(this->Transform(this->Depth, x, y, z));
  corner.Scalar = vertex[3];
}

//------------------------------------------------------------------------------
template <class Simd>
void PacketWalk<Simd>::Project(Int id, Corner& corner) const
{
  Float vertex[4];
  Simd::template GatherQuads<4>(this->VertexTable, id, vertex[0], vertex[1], vertex[2], vertex[3]);
  this->Place(vertex, corner);
  corner.Id = id;
}

//------------------------------------------------------------------------------
/** As Project, but only (u, v), and exact. */
template <class Simd>
void PacketWalk<Simd>::ProjectOnGrid(Int id, Int& u, Int& v) const
{
  Float x;
  Float y;
  Float z;
  Float scalar;
  Simd::template GatherQuads<4>(this->VertexTable, id, x, y, z, scalar);
  u = Simd::Round(this->Transform(this->U, Simd::AsInt(x), Simd::AsInt(y), Simd::AsInt(z)));
  v = Simd::Round(this->Transform(this->V, Simd::AsInt(x), Simd::AsInt(y), Simd::AsInt(z)));
}

//------------------------------------------------------------------------------
/**
 * Twice the area that the edge pq spans with the ray. Each factor is off by 2^-24 of itself, their
 * products and difference by as much again: by less than 2^-22 (|area| + 2 |pv qu|) in all. So the
 * sign is sure if |area| - 2^-20 |pv qu| is positive; `excess` is lowered to that.
 */
template <class Simd>
inline auto PacketWalk<Simd>::EdgeArea(const Corner& p, const Corner& q, Float& excess) -> Float
{
  const Float area = Simd::CrossProduct(p.U, p.V, q.U, q.V);
  const Float bound = Simd::Abs(p.V * q.U) * Simd::Splat(9.5367431640625e-7f);
  excess = Simd::Min(excess, Simd::Abs(area) - bound);
  return area;
}

//------------------------------------------------------------------------------
/** Whether the ray is left of pq, exactly; each is { u, v, id }. */
template <class Simd>
bool PacketWalk<Simd>::TurnsLeft(
  const std::int32_t (&p)[3], const std::int32_t (&q)[3], float& area)
{
  const std::int64_t exact = std::int64_t{ p[0] } * q[1] - std::int64_t{ p[1] } * q[0];
  area = static_cast<float>(exact);
  if (exact != 0)
  {
    return exact > 0;
  }
  if (p[1] != q[1])
  {
    return q[1] < p[1];
  }
  return p[0] != q[0] ? q[0] > p[0] : p[2] < q[2];
}

//------------------------------------------------------------------------------
/** Exact areas and signs of the edges from x to A, B, C in some lanes. */
template <class Simd>
void PacketWalk<Simd>::MakeSure(
  const Corner& x, unsigned int lanes, Float (&areas)[3], Mask (&left)[3]) const
{
  std::int32_t grid[4][3][Width];
  const Corner* corners[4] = { &x, &this->A, &this->B, &this->C };
  for (int c = 0; c < 4; ++c)
  {
    Int u;
    Int v;
    this->ProjectOnGrid(corners[c]->Id, u, v);
    Simd::Store(grid[c][0], u);
    Simd::Store(grid[c][1], v);
    Simd::Store(grid[c][2], corners[c]->Id);
  }
  for (int edge = 0; edge < 3; ++edge)
  {
    float exact[Width];
    Simd::Store(exact, areas[edge]);
    unsigned int bits = Simd::Bits(left[edge]);
    for (int lane = 0; lane < Width; ++lane)
    {
      if (lanes >> lane & 1u)
      {
        const auto& q = grid[edge + 1];
        const bool turns = TurnsLeft({ grid[0][0][lane], grid[0][1][lane], grid[0][2][lane] },
          { q[0][lane], q[1][lane], q[2][lane] }, exact[lane]);
        bits = turns ? bits | 1u << lane : bits & ~(1u << lane);
      }
    }
    areas[edge] = Simd::Load(exact);
    left[edge] = Simd::FromBits(bits);
  }
}

//------------------------------------------------------------------------------
template <class Simd>
inline void PacketWalk<Simd>::Fetch(Ahead& ahead) const
{
  // Lanes outside of the mesh look at cell 0.
  const Int zero = Simd::Splat(0);
  const Int cellFace = Simd::Select(this->CellFace < zero, zero, this->CellFace);
  Float vertex[4];
  Simd::GatherCells(this->Job.Cells, this->VertexTable, cellFace, ahead.Ids, ahead.Links, vertex);
  this->Place(vertex, ahead.X);
  ahead.X.Id = PickByRank(Simd::And(cellFace, Simd::Splat(3)), ahead.Ids);
}

//------------------------------------------------------------------------------
template <class Simd>
inline auto PacketWalk<Simd>::PickByRank(Int rank, const Int (&of)[4]) -> Int
{
  const Int low = Simd::Select(rank > Simd::Splat(0), of[1], of[0]);
  const Int high = Simd::Select(rank > Simd::Splat(2), of[3], of[2]);
  return Simd::Select(rank > Simd::Splat(1), high, low);
}

//------------------------------------------------------------------------------
/** Crosses the cells of `lanes` and gives the segments passed to the integral. */
template <class Simd>
inline void PacketWalk<Simd>::Step(Mask lanes, const Ahead& ahead)
{
  const Corner& x = ahead.X;
  const Float zero = Simd::Splat(0.0f);
  Float excess = Simd::Splat(1.0f);
  Float areas[3] = { EdgeArea(x, this->A, excess), EdgeArea(x, this->B, excess),
    EdgeArea(x, this->C, excess) };
  Mask left[3] = { areas[0] > zero, areas[1] > zero, areas[2] > zero };
  const unsigned int unsureBits = Simd::Bits(Simd::AndNot(lanes, excess > zero));
  if (unsureBits != 0)
  {
    this->MakeSure(x, unsureBits, areas, left);
  }

  // The ray leaves between two consecutive edges from x, left of one and right of the next. The
  // third vertex drops out; the link to follow is that across the face opposite to it.
  const Mask dropC = Simd::AndNot(left[0], left[1]);
  const Mask dropA = Simd::AndNot(Simd::AndNot(left[1], left[2]), dropC);
  const Mask keepB = dropC | dropA;
  const Int dropped = Simd::Select(dropA, this->A.Id, Simd::Select(dropC, this->C.Id, this->B.Id));
  Int link = ahead.Links[0];
  for (int rank = 1; rank < 4; ++rank)
  {
    link = Simd::Select(Simd::Equal(dropped, ahead.Ids[rank]), ahead.Links[rank], link);
  }

  // The exit face: x takes the dropped vertex's place, which keeps the sense of rotation.
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
  ReplaceCorner(replaceA, x, this->A);
  ReplaceCorner(replaceB, x, this->B);
  ReplaceCorner(replaceC, x, this->C);
  this->CellFace = Simd::Select(lanes, link, this->CellFace);
  this->Steps = this->Steps + Simd::One(lanes);
  this->Pass(lanes);
}

//------------------------------------------------------------------------------
template <class Simd>
inline void PacketWalk<Simd>::ReplaceCorner(Mask lanes, const Corner& x, Corner& corner)
{
  corner.U = Simd::Select(lanes, x.U, corner.U);
  corner.V = Simd::Select(lanes, x.V, corner.V);
  corner.Depth = Simd::Select(lanes, x.Depth, corner.Depth);
  corner.Scalar = Simd::Select(lanes, x.Scalar, corner.Scalar);
  corner.Id = Simd::Select(lanes, x.Id, corner.Id);
}

//------------------------------------------------------------------------------
/** Depth and scalar where the ray meets ABC; a face without projected area keeps what is given. */
template <class Simd>
inline void PacketWalk<Simd>::Interpolate(Float& depth, Float& scalar) const
{
  const Float total = this->AreaAB + this->AreaBC + this->AreaCA;
  const Mask real = total > Simd::Splat(0.0f);
  const Float inverse = Simd::Splat(1.0f) / total;
  const auto mean = [&](Float a, Float b, Float c)
  { return Simd::Fma(Simd::Fma(this->AreaCA, b - a, this->AreaAB * (c - a)), inverse, a); };
  depth = Simd::Select(real, mean(this->A.Depth, this->B.Depth, this->C.Depth), depth);
  scalar = Simd::Select(real, mean(this->A.Scalar, this->B.Scalar, this->C.Scalar), scalar);
}

//------------------------------------------------------------------------------
/** Gives the integral what lies between the last face and this one. */
template <class Simd>
inline void PacketWalk<Simd>::Pass(Mask lanes)
{
  Float depth = this->FaceDepth;
  Float scalar = this->FaceScalar;
  this->Interpolate(depth, scalar);

  // What lies before the largest depth reached has been passed already and does not count again.
  const Float start = Simd::Max(this->DepthNow, this->StartDepth);
  const Float end = Simd::Min(depth, this->EndDepth);
  Float from = this->FaceScalar;
  Float to = scalar;
  const Mask late = start > this->FaceDepth;
  const Mask early = depth > end;
  if (Simd::Bits(lanes & (late | early)) != 0)
  {
    const Float perDepth = (scalar - this->FaceScalar) / (depth - this->FaceDepth);
    from = Simd::Select(late, Simd::Fma(start - this->FaceDepth, perDepth, this->FaceScalar), from);
    to = Simd::Select(early, Simd::Fma(end - this->FaceDepth, perDepth, this->FaceScalar), to);
  }
  const Mask segment = lanes & (end > start);
  this->Pending =
    this->Pending | this->Integral.Begin(segment, from, to, (end - start) * this->LengthPerDepth);
  this->DepthNow = Simd::Select(lanes, Simd::Max(this->DepthNow, depth), this->DepthNow);
  this->FaceDepth = Simd::Select(lanes, depth, this->FaceDepth);
  this->FaceScalar = Simd::Select(lanes, scalar, this->FaceScalar);
}

//------------------------------------------------------------------------------
/**
 * Gives lanes whose walk has ended the next entry of their ray or the next ray. Returns the lanes
 * that have a ray.
 */
template <class Simd>
unsigned int PacketWalk<Simd>::Replace(unsigned int ended)
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
template <class Simd>
bool PacketWalk<Simd>::NextEntry(int lane)
{
  const PacketRay& ray = this->Job.Rays[this->Ray[lane]];
  const std::int32_t next = this->Entry[lane] + 1;
  if (next >= ray.EndEntry || this->CellFaces[lane] >= 0 ||
    !(this->DepthsNow[lane] < ray.EndDepth) || !(this->Job.Entries[next].Depth < ray.EndDepth) ||
    !(this->Colors[3][lane] > this->Job.TerminationTransmittance))
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
/** Starts the next ray that has an entry before its end; false if there is none. */
template <class Simd>
bool PacketWalk<Simd>::TakeRay(int lane)
{
  while (this->NextRay < this->Job.NumberOfRays)
  {
    const std::int32_t number = this->NextRay++;
    const PacketRay& ray = this->Job.Rays[number];
    for (int k = 0; k < 4; ++k)
    {
      this->U.Of[k][lane] = ray.U[k];
      this->V.Of[k][lane] = ray.V[k];
      this->Depth.Of[k][lane] = ray.Depth[k];
      this->Colors[k][lane] = k == 3 ? 1.0f : 0.0f;
    }
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
template <class Simd>
void PacketWalk<Simd>::Finish(int lane)
{
  PacketResult& result = this->Job.Results[this->Ray[lane]];
  for (int channel = 0; channel < 3; ++channel)
  {
    result.Color[channel] = this->Colors[channel][lane];
  }
  result.Color[3] = 1.0f - this->Colors[3][lane];
  result.Steps = this->StepsOf[lane];
  result.Lost = this->StepsOf[lane] >= this->StepLimit && this->CellFaces[lane] >= 0 ? 1 : 0;
}

//------------------------------------------------------------------------------
template <class Simd>
void PacketWalk<Simd>::StoreLanes()
{
  Simd::Store(this->DepthsNow, this->DepthNow);
  Simd::Store(this->StepsOf, this->Steps);
  Simd::Store(this->CellFaces, this->CellFace);
  for (int channel = 0; channel < 3; ++channel)
  {
    Simd::Store(this->Colors[channel], this->Integral.GetColor(channel));
  }
  Simd::Store(this->Colors[3], this->Integral.GetTransmittance());
}

//------------------------------------------------------------------------------
template <class Simd>
void PacketWalk<Simd>::LoadLanes()
{
  this->DepthNow = Simd::Load(this->DepthsNow);
  this->Steps = Simd::Load(this->StepsOf);
  this->CellFace = Simd::Load(this->CellFaces);
  this->StartDepth = Simd::Load(this->StartDepths);
  this->EndDepth = Simd::Load(this->EndDepths);
  this->LengthPerDepth = Simd::Load(this->LengthsPerDepth);
}

//------------------------------------------------------------------------------
template <class Simd>
void PacketWalk<Simd>::Enter(Mask lanes)
{
  Corner* const corners[3] = { &this->A, &this->B, &this->C };
  for (int i = 0; i < 3; ++i)
  {
    Corner x;
    this->Project(Simd::Load(this->Ids[i]), x);
    ReplaceCorner(lanes, x, *corners[i]);
  }
  const auto area = [lanes](const Corner& p, const Corner& q, Float& kept)
  { kept = Simd::Select(lanes, Simd::Abs(Simd::CrossProduct(p.U, p.V, q.U, q.V)), kept); };
  area(this->A, this->B, this->AreaAB);
  area(this->B, this->C, this->AreaBC);
  area(this->C, this->A, this->AreaCA);
  // A face without projected area is met at its first vertex.
  Float depth = this->A.Depth;
  Float scalar = this->A.Scalar;
  this->Interpolate(depth, scalar);
  this->FaceDepth = Simd::Select(lanes, depth, this->FaceDepth);
  this->FaceScalar = Simd::Select(lanes, scalar, this->FaceScalar);
  this->DepthNow = Simd::Select(lanes, Simd::Max(this->DepthNow, depth), this->DepthNow);
}

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Rendering/glsl/vtkTetrahedraWalk.glsl (step through a cell)
#pragma once

#include "Volume/Packet/Data/PacketJob.h"
#include "Volume/Packet/Models/PacketIntervals.h"
#include "Volume/Packet/Models/PacketLanes.h"
#include "Volume/Packet/Models/PacketLights.h"
#include "Volume/Packet/Models/VertexAttributes.h"
#include "Volume/Packet/Walk/PacketCorners.h"

namespace meniscus
{

/**
 * Walks rays from cell to cell by edge signs in the ray-aligned projection, one ray per lane. A
 * lane whose ray has ended takes the next ray of the job.
 *
 * A vertex has coordinates (u, v) relative to a ray (PacketRay). The sign of an edge, which tells
 * the side on which the ray passes, is exact (ExactEdgeTest). A walk that begins on the boundary
 * ends on the boundary: Documentation/volume-method.md, "Why no ray is lost".
 *
 * The order of the face's corners A, B, C, which tells where they are in their cell, is one number
 * of six. Together with the face's number in the cell it indexes a table (FaceTurns) of the link to
 * follow and the next order, for each corner that the next face may lack.
 *
 * Depths count from the pivot of the rays, in grid units. The point in which a ray meets a face is
 * an integer depth and a remainder, so that lengths are as precise in small cells as in large ones
 * ("Backends" in the same page). Only the ends of rays are compared with depths in floats, which
 * are precise to 2^-24 of the distance from the pivot.
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
  using VertexValues = VertexAttributes<Simd, Model::NumberOfTriples>;
  using CellValues = VertexAttributes<Simd, Model::UsesCellGradients ? 1 : 0>;
  static constexpr int Width = Simd::Width;

  /** A vertex relative to the ray of each lane. */
  struct Corner
  {
    Float U;
    Float V;
    /** Grid units from the pivot. */
    Int Depth;
    Float Scalar;
    /** Further values that models need. */
    VertexValues Others{};
  };
  /** Point in which a ray meets a face. */
  struct FacePoint
  {
    /** The depth, in grid units from the pivot: an integer and the remainder, at most 1/2. */
    Int Whole;
    Float Rest;
    Float Scalar;
    VertexValues Values;

    Float GetDepth() const { return Simd::ToFloat(this->Whole); }
    /** Takes over all members in some lanes. */
    void Replace(Mask lanes, const FacePoint& other)
    {
      this->Whole = Simd::Select(lanes, other.Whole, this->Whole);
      this->Rest = Simd::Select(lanes, other.Rest, this->Rest);
      this->Scalar = Simd::Select(lanes, other.Scalar, this->Scalar);
      this->Values.Replace(lanes, other.Values);
    }
  };

  void Place(const Float (&vertex)[4], Corner& corner) const;
  void Project(Int id, Corner& corner) const;
  static Float EdgeArea(const Corner& p, const Corner& q)
  {
    return Simd::CrossProduct(p.U, p.V, q.U, q.V);
  }
  /**
   * The cell to be entered next: the face by which it is entered, its links, and the vertex
   * opposite that face.
   */
  struct Ahead
  {
    Int Face;
    /** Index of the cell's first face in the job's passages. */
    Int Row;
    Corner X;
    /** Used with scalars of cells only. */
    Float CellScalar;
    CellValues Gradient;
  };
  void BreakTies(const Ahead& ahead, const Float (&areas)[3], Mask (&left)[3]) const;
  void Fetch(Ahead& ahead) const;
  void Step(Mask lanes, const Ahead& ahead);
  static void ReplaceCorner(Mask lanes, const Corner& x, Corner& corner);
  Float MoveToFace(Mask lanes, const FacePoint& point, FacePoint& met) const;
  CellValues GradientsOf(Int cellFace) const;
  void LoadLines();
  /** Place of a segment, for models that need it. */
  struct SegmentPlace
  {
    Float StartDepth;
    Float EndDepth;
    /** The segment's length in grid units of depth, not positive if the cell is not crossed. */
    Float Depths;
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
  const float* ValueTables[3];
  std::int32_t NextRay = 0;
  std::int32_t StepLimit;

  Model Integral;
  LaneRays<Simd> Rays;
  Int Pivot;
  // Vertices of the face just entered by, counter-clockwise about the ray, and twice the areas that
  // its edges AB, BC, CA span with the ray.
  Corner A;
  Corner B;
  Corner C;
  Float AreaAB;
  Float AreaBC;
  Float AreaCA;
  /** 4 * the order of A, B, C (FaceTurns). */
  Int Order;
  /** 4 * cell + face just entered by; negative outside of the mesh. */
  Int CellFace;
  /** Vertex opposite that face in the cell; any vertex outside of the mesh. */
  Int Opposite;
  FacePoint Face;
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
  std::int32_t Offsets[2][Width];
  float Slopes[2][Width];
  float Fractions[2][Width];
  float SlopeRests[2][Width];
  std::int32_t Ray[Width];
  std::int32_t Entry[Width];
  std::int32_t Ids[3][Width];
  std::int32_t CellFaces[Width];
  std::int32_t Opposites[Width];
  std::int32_t StepsOf[Width];
  std::int32_t Overlaps[Width];
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
  this->Pivot = Simd::Splat(job.Pivot);
  this->A = Corner{ zero, zero, none, zero };
  this->A.Others.Clear();
  this->B = this->C = this->A;
  this->AreaAB = this->AreaBC = this->AreaCA = zero;
  this->Order = none;
  this->Face = FacePoint{ none, zero, zero, this->A.Others };
  this->Line = { zero, zero, zero, zero, zero, { zero, zero, zero } };
  // Gradients come first, then light.
  int tables = 0;
  for (const float* table : { job.VertexGradients, job.VertexLight })
  {
    if (job.Medium && table)
    {
      this->ValueTables[tables++] = table;
    }
  }
  for (; tables < 3; ++tables)
  {
    this->ValueTables[tables] = job.Components;
  }
  this->Steps = none;
  this->Busy = this->Pending = Simd::FromBits(0);
  for (int lane = 0; lane < Width; ++lane)
  {
    this->Ray[lane] = -1;
    this->Ids[0][lane] = this->Ids[1][lane] = this->Ids[2][lane] = 0;
    this->CellFaces[lane] = this->Opposites[lane] = 0;
    this->StepsOf[lane] = this->Overlaps[lane] = 0;
    this->DepthsNow[lane] = this->StartDepths[lane] = this->EndDepths[lane] = 0.0f;
    this->LengthsPerDepth[lane] = 0.0f;
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Offsets[axis][lane] = 0;
      this->Slopes[axis][lane] = 0.0f;
      this->Fractions[axis][lane] = this->SlopeRests[axis][lane] = 0.0f;
    }
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
  unsigned int busy = this->Replace(AllLanes<Simd>);
  while (busy != 0)
  {
    // The vertex ahead is fetched before the segment behind is integrated, which hides the latency.
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
/** Places a vertex relative to the rays. */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Place(const Float (&vertex)[4], Corner& corner) const
{
  corner.Depth = Simd::AsInt(vertex[2]) - this->Pivot;
  const Float depth = Simd::ToFloat(corner.Depth);
  const Int place[2] = { Simd::AsInt(vertex[0]), Simd::AsInt(vertex[1]) };
  Float coordinates[2];
  if (this->Job.RaysAreFine)
  {
    this->Rays.AboutFineRays(place, corner.Depth, depth, coordinates);
  }
  else
  {
    this->Rays.AboutRays(place, depth, coordinates);
  }
  corner.U = coordinates[0];
  corner.V = coordinates[1];
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
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Fetch(Ahead& ahead) const
{
  // Lanes outside of the mesh use cell 0.
  const Int zero = Simd::Splat(0);
  const Int cellFace = Simd::Select(this->CellFace < zero, zero, this->CellFace);
  Float vertex[4];
  ahead.Face = Simd::And(cellFace, Simd::Splat(3));
  ahead.Row = cellFace - ahead.Face;
  Simd::template GatherQuads<4>(
    this->VertexTable, this->Opposite, vertex[0], vertex[1], vertex[2], vertex[3]);
  this->Place(vertex, ahead.X);
  if constexpr (Model::NumberOfTriples > 0)
  {
    ahead.X.Others.Gather(this->ValueTables, this->Opposite);
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
  Float areas[3] = { EdgeArea(x, this->A), EdgeArea(x, this->B), EdgeArea(x, this->C) };
  Mask left[3] = { areas[0] > zero, areas[1] > zero, areas[2] > zero };
  for (Float& area : areas)
  {
    area = Simd::Abs(area);
  }
  const Float least = Simd::Min(areas[0], Simd::Min(areas[1], areas[2]));
  if (Simd::Bits(Simd::AndNot(lanes, least > zero)) != 0)
  {
    this->BreakTies(ahead, areas, left);
  }

  // The ray leaves between two consecutive edges from x: left of one and right of the next. The
  // third vertex is dropped; the link to follow is across the face opposite it.
  const Mask dropC = Simd::AndNot(left[0], left[1]);
  const Mask dropA = Simd::AndNot(left[1], left[2]);
  const Int shift = Simd::Select(dropA, Simd::Splat(FaceTurns<Simd>::ShiftOfA),
    Simd::Select(
      dropC, Simd::Splat(FaceTurns<Simd>::ShiftOfC), Simd::Splat(FaceTurns<Simd>::ShiftOfB)));
  const Int turn = Simd::ShiftRight(
    Simd::LookupOf24(FaceTurns<Simd>::Table.Words, this->Order + ahead.Face), shift);
  Int link;
  Int opposite;
  Simd::FollowPairs(
    this->Job.Passages, ahead.Row + Simd::And(turn, Simd::Splat(3)), link, opposite);

  // Exit face: x replaces the dropped vertex, which keeps the sense of rotation.
  const Mask replaceA = dropA & lanes;
  const Mask replaceC = dropC & lanes;
  const Mask replaceB = Simd::AndNot(lanes, dropA | dropC);
  this->AreaAB = Simd::Select(replaceA, areas[1], Simd::Select(replaceB, areas[0], this->AreaAB));
  this->AreaBC = Simd::Select(replaceB, areas[2], Simd::Select(replaceC, areas[1], this->AreaBC));
  this->AreaCA = Simd::Select(replaceA, areas[2], Simd::Select(replaceC, areas[0], this->AreaCA));
  ReplaceCorner(replaceA, x, this->A);
  ReplaceCorner(replaceB, x, this->B);
  ReplaceCorner(replaceC, x, this->C);
  this->Order =
    Simd::Select(lanes, Simd::And(turn, Simd::Splat(FaceTurns<Simd>::MaskOfOrder)), this->Order);
  const Int crossed = this->CellFace;
  this->CellFace = Simd::Select(lanes, link, this->CellFace);
  this->Opposite = Simd::Select(lanes, opposite, this->Opposite);
  this->Steps = this->Steps + Simd::One(lanes);
  this->Pass(lanes, crossed, ahead);
}

//------------------------------------------------------------------------------
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
/** Passes the part of the ray between the last face and this one to the integral. */
template <class Simd, class Model>
inline void PacketWalk<Simd, Model>::Pass(Mask lanes, Int cellFace, const Ahead& crossed)
{
  FacePoint exit;
  const Float crossing = this->MoveToFace(lanes, this->Face, exit);
  const Float faceDepth = this->Face.GetDepth();
  const Float depth = exit.GetDepth();
  const Float faceScalar = this->Face.Scalar;

  // The part before the largest depth reached has been passed already and is not passed again.
  const Float start = Simd::Max(this->DepthNow, this->StartDepth);
  const Float end = Simd::Min(depth, this->EndDepth);
  const Mask late = start > faceDepth;
  const Mask early = depth > this->EndDepth;
  const bool isCut = Simd::Bits(lanes & (late | early)) != 0;
  const Float length = isCut ? Simd::Select(late | early, end - start, crossing) : crossing;
  Float from = faceScalar;
  Float to = exit.Scalar;
  // Copies cost as much as the interpolation of the values.
  VertexValues cutValues[2];
  const VertexValues* values[2] = { &this->Face.Values, &exit.Values };
  if (this->Job.CellScalars)
  {
    // A jump between cells is integrated where the cell is entered, unless the ray begins behind
    // that face.
    to = crossed.CellScalar;
    from = Simd::Select(this->StartDepth > faceDepth, to, faceScalar);
    from = Model::SeesJumps ? from : to;
  }
  else if (isCut)
  {
    const Float perDepth = (exit.Scalar - faceScalar) / (depth - faceDepth);
    from = Simd::Select(late, Simd::Fma(start - faceDepth, perDepth, faceScalar), from);
    to = Simd::Select(early, Simd::Fma(end - faceDepth, perDepth, faceScalar), to);
  }
  if constexpr (Model::NumberOfTriples > 0)
  {
    if (isCut)
    {
      const auto cut = [&](int which, Mask replaced, Float place)
      {
        cutValues[which] = *values[which];
        cutValues[which].Replace(replaced,
          this->Face.Values.Between((place - faceDepth) / (depth - faceDepth), exit.Values));
      };
      cut(0, late, start);
      cut(1, early, end);
      values[0] = &cutValues[0];
      values[1] = &cutValues[1];
    }
  }
  const SegmentPlace place{ start, end, length, cellFace, this->Ray, lanes, late, *values[0],
    *values[1], crossed.Gradient, this->Line };
  this->Pending =
    this->Pending | this->Integral.Begin(lanes, from, to, length * this->LengthPerDepth, place);
  this->DepthNow = Simd::Select(lanes, Simd::Max(this->DepthNow, depth), this->DepthNow);
  if (this->Job.CellScalars)
  {
    // The scalar of the last integrated cell.
    const Mask known =
      SegmentsOf<Simd>(lanes, from, to, length) | Simd::AndNot(lanes, depth > this->StartDepth);
    exit.Scalar = Simd::Select(known, crossed.CellScalar, faceScalar);
  }
  this->Face.Replace(lanes, exit);
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
  }
  const Int order = FaceTurns<Simd>::OrderOf(ids[0], ids[1], ids[2]);
  this->Order = Simd::Select(lanes, order, this->Order);
  const auto area = [lanes](const Corner& p, const Corner& q, Float& kept)
  { kept = Simd::Select(lanes, Simd::Abs(EdgeArea(p, q)), kept); };
  area(this->A, this->B, this->AreaAB);
  area(this->B, this->C, this->AreaBC);
  area(this->C, this->A, this->AreaCA);
  // A face without projected area is met at its first vertex.
  // Once more from there, relative to a depth that is close.
  const FacePoint first{ this->A.Depth, Simd::Splat(0.0f), this->A.Scalar, this->A.Others };
  FacePoint near;
  FacePoint entry;
  this->MoveToFace(lanes, first, near);
  this->MoveToFace(lanes, near, entry);
  if (this->Job.CellScalars)
  {
    const Int zero = Simd::Splat(0);
    entry.Scalar = Simd::GatherCellScalars(
      this->Job.CellScalars, Simd::Select(this->CellFace < zero, zero, this->CellFace));
  }
  this->Face.Replace(lanes, entry);
  this->DepthNow = Simd::Select(lanes, Simd::Max(this->DepthNow, entry.GetDepth()), this->DepthNow);
  this->Integral.Enter(lanes);
}

}

#include "Volume/Packet/Walk/PacketWalkFaces.h"
#include "Volume/Packet/Walk/PacketWalkLanes.h"
#include "Volume/Packet/Walk/PacketWalkOptics.h"
#include "Volume/Packet/Walk/PacketWalkTies.h"

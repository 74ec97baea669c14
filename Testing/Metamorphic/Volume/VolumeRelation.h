// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Conditioning.h"
#include "Relation.h"
#include "VolumeStage.h"

namespace meniscus::test
{

/** Pixel of a changed scene's image that corresponds to pixel (x, y) of the original scene. */
using PixelMap = std::function<std::array<int, 2>(int x, int y)>;

/** One random scene of a relation: draws it, draws changed ones, compares. */
class VolumeTrial
{
public:
  VolumeTrial(const VolumeCase& test, RandomNumbers random, VolumeStage& stage);

  const VolumeCase& MakeScene() const { return this->Scene; }
  RandomNumbers& MakeRandom() { return this->Random; }
  VolumeStage& GetStage() { return this->Stage; }

  /** Image of the unchanged scene, drawn once. */
  const FloatImage& MakePicture();

  /** Exact colour of a pixel of the scene. */
  std::array<double, 4> GetExact(int x, int y) { return this->Condition.GetExact(x, y); }

  /** Expects a changed scene to give the same image. */
  void ExpectSame(const VolumeCase& changed, const std::string& words);
  /** Expects an image to equal the scene's. */
  void ExpectSame(const FloatImage& changed, const std::string& words);
  void ExpectSame(const FloatImage& changed, double tolerance, const std::string& words);
  void ExpectSame(
    const FloatImage& changed, const PixelMap& map, double tolerance, const std::string& words);

  /** Counts a failure other than a deviation. */
  void Fail(const std::string& words);

  RelationTally Done();

private:
  VolumeCase Scene;
  RandomNumbers Random;
  VolumeStage& Stage;
  FloatImage Picture;
  Conditioning Condition;
  RelationTally Tally;
};

struct VolumeRelation
{
  std::string Name;
  /** Number of scenes at intensity 1. */
  int Cases;
  CaseNeeds Needs;
  /** Draws changed scenes and compares. */
  std::function<void(VolumeTrial&)> Check;
  /** Adapts a random scene to the relation's needs; may be empty. */
  std::function<void(VolumeCase&, RandomNumbers&)> Prepare;
};

/** A relation with one changed scene. */
VolumeRelation RelationOf(const std::string& name, int cases, const CaseNeeds& needs,
  const std::function<void(VolumeCase&, RandomNumbers&)>& change);

/** Position of the scene: moves of the whole scene, cameras, windows. */
std::vector<VolumeRelation> PlaceRelations();
/** Cells and points that describe the same field. */
std::vector<VolumeRelation> MeshRelations();
/** Types of arrays, units of scalars, functions. */
std::vector<VolumeRelation> ValueRelations();
/** The mapper's state: edits in place, frames, threads, backends. */
std::vector<VolumeRelation> StateRelations();
/** Membranes. */
std::vector<VolumeRelation> MembraneRelations();

} // namespace meniscus::test

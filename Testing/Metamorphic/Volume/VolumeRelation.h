// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_VolumeRelation_h
#define meniscus_VolumeRelation_h

#include "Conditioning.h"
#include "Relation.h"
#include "VolumeCase.h"
#include "VolumeStage.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace meniscus
{
namespace test
{

/** Pixel of a changed scene's picture that shows what pixel (x, y) of the scene's own shows. */
using PixelMap = std::function<std::array<int, 2>(int x, int y)>;

/** One random scene of a relation: draws it, draws changed ones, compares. */
class VolumeTrial
{
public:
  VolumeTrial(const VolumeCase& test, RandomNumbers random, VolumeStage& stage);

  const VolumeCase& scene() const { return this->Scene; }
  RandomNumbers& random() { return this->Random; }
  VolumeStage& stage() { return this->Stage; }

  /** The scene as it is, drawn once. */
  const FloatImage& picture();

  /** Exact colour of a pixel of the scene. */
  std::array<double, 4> exact(int x, int y) { return this->Condition.exact(x, y); }

  /** Expects a changed scene to show the same. */
  void expectSame(const VolumeCase& changed, const std::string& words);
  /** Expects a picture to be that of the scene. */
  void expectSame(const FloatImage& changed, const std::string& words);
  void expectSame(
    const FloatImage& changed, const PixelMap& map, double tolerance, const std::string& words);

  /** Counts a failure that is no deviation. */
  void fail(const std::string& words);

  RelationTally done();

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
  /** Scenes at intensity 1. */
  int Cases;
  CaseNeeds Needs;
  /** Draws changed scenes and compares. */
  std::function<void(VolumeTrial&)> Check;
  /** Gives a random scene what the relation needs; may be empty. */
  std::function<void(VolumeCase&, RandomNumbers&)> Prepare;
};

/** A relation with one changed scene. */
VolumeRelation relationOf(const std::string& name, int cases, const CaseNeeds& needs,
  const std::function<void(VolumeCase&, RandomNumbers&)>& change);

/** Where the scene is: moves of all of it, cameras, windows. */
std::vector<VolumeRelation> placeRelations();
/** Cells and points that describe the same field. */
std::vector<VolumeRelation> meshRelations();
/** Types of arrays, units of scalars, functions. */
std::vector<VolumeRelation> valueRelations();
/** The mapper's state: edits in place, frames, threads, backends. */
std::vector<VolumeRelation> stateRelations();
/** Membranes. */
std::vector<VolumeRelation> membraneRelations();

} // namespace test
} // namespace meniscus

#endif

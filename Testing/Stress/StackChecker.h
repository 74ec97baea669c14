// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PatchTracer.h"
#include "Refraction/Stack/StackSolver.h"
#include "StackCheck.h"

namespace meniscus::test
{

/** A surface of the case, with its patches as the tracer sees them. */
struct TracedSurface
{
  std::shared_ptr<RefractingSurface> Surface = std::make_shared<RefractingSurface>();
  std::unique_ptr<PatchTracer> Tracer;
  glm::dvec3 Shift{ 0.0 }; ///< of its origin from the list's origin
};

/** A sight ray that was traced from patch to patch without the kernel. */
struct TracedPath
{
  std::vector<PatchHit> Points;
  std::vector<glm::dvec3> Directions; ///< behind each interface
  PathEnd End = PathEnd::Passed;
  bool IsCertain = true;
};

/** Solves the points of a case and checks every answer; see CheckStack. */
class StackChecker
{
public:
  explicit StackChecker(const StackCase& test)
    : Test(test)
    , Random(test.Seed)
  {
  }

  RefractionTally Run();

private:
  bool SetUp();
  bool SetSolver(StackSolver& solver, const std::vector<Interface>& list, bool threads);
  std::vector<Interface> MakeList() const;
  std::vector<Interface> MakePaddedList();
  bool HasExpectedLinks() const;

  glm::dvec3 ToWorld(const glm::dvec3& frame) const { return frame + this->Frame; }
  const StackLayer& GetLayer(std::size_t k) const { return *this->Layers[k]; }
  const TracedSurface& GetSurface(std::size_t k) const
  {
    return this->Surfaces[this->Layers[k]->Mesh];
  }
  std::vector<PatchHit> FindCrossings(std::size_t k, const glm::dvec3& origin,
    const glm::dvec3& direction, PatchTracer::Sides sides = PatchTracer::Sides::ByNormals) const;
  PatchHit Evaluate(std::size_t k, std::int32_t facet, const glm::dvec2& b) const;
  TracedPath Trace(const PatchHit& first) const;
  double GetCondition(const TracedPath& path, const glm::dvec3& point) const;

  PatchHit ChoosePlace();
  std::optional<PatchHit> ChooseFront();
  std::optional<PatchHit> ChooseRim();
  void CheckPlanted(int i, const PatchHit& first);
  void CheckElsewhere(int i);
  void CheckPoint(int i, const glm::dvec3& point, const PatchHit* planted, std::size_t count);
  void CheckImage(int i, const glm::dvec3& point, const StackPath& path);
  bool CheckLaw(int i, const glm::dvec3& point, const StackPath& path);
  bool CheckNearest(const glm::dvec3& point, const StackPath& path) const;
  void CheckVertex(
    int i, const glm::dvec3& point, const StackPath& path, const StackVertex& vertex);
  std::optional<glm::dvec3> WalkBack(const TracedPath& path, const glm::dvec3& seen) const;
  void CheckWayBack(
    int i, const glm::dvec3& point, const StackPath& path, const StackVertex& vertex);
  void CheckChains();

  const StackCase& Test;
  StressRandom Random;
  std::vector<TracedSurface> Surfaces;
  std::vector<const StackLayer*> Layers; ///< those in front of the eye that refract
  StackSolver Solver;
  StackSolver Threaded;
  StackSolver Padded;
  glm::dvec3 Frame{ 0.0 }; ///< origin of the list in world coordinates
  glm::dvec3 Eye{ 0.0 };   ///< relative to it
  double Rounding = 0.0;   ///< of a position
  RefractionTally Tally;
  std::vector<glm::dvec3> Points; ///< all points so far, in world coordinates
};

} // namespace meniscus::test

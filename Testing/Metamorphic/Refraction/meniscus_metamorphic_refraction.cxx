// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Random membranes, eyes and points, and changes that must not change the points' images and sides.
 * Reports deviations and failures per relation; the exit status is 0 without a failure.
 */
#include "RefractionTrial.h"
#include "RelationRun.h"

using namespace meniscus;
using namespace meniscus::test;
using meniscus::reference::MembraneMesh;

namespace
{

const char* const Usage =
  "meniscus_metamorphic_refraction [options]\n"
  "  --intensity X      1 (default) takes about half a minute; cases grow with it\n"
  "  --relation TEXT    only relations whose names contain the text\n";

using Check = std::function<void(RefractionTrial&, RandomNumbers&)>;

glm::dmat3 RandomTurn(RandomNumbers& random)
{
  const glm::dvec3 x = random.GetDirection();
  const glm::dvec3 y = glm::normalize(glm::cross(x, random.GetDirection()));
  return { x, y, glm::cross(x, y) };
}

template <typename Item>
void Shuffle(std::vector<Item>& items, RandomNumbers& random)
{
  for (std::size_t i = items.size(); i > 1; --i)
  {
    std::swap(items[i - 1], items[static_cast<std::size_t>(random.Below(static_cast<int>(i)))]);
  }
}

std::vector<std::size_t> RandomOrder(std::size_t count, RandomNumbers& random)
{
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  Shuffle(order, random);
  return order;
}

//------------------------------------------------------------------------------
void Move(RefractionTrial& trial, const Motion& motion)
{
  trial.Compare(motion.Apply(trial.MakeScene()), motion);
}

void Rotate(RefractionTrial& trial, RandomNumbers& random)
{
  Motion motion;
  motion.Turn = RandomTurn(random);
  Move(trial, motion);
}

void Mirror(RefractionTrial& trial, RandomNumbers& random)
{
  Motion motion;
  motion.Turn = -RandomTurn(random);
  Move(trial, motion);
}

void Translate(RefractionTrial& trial, RandomNumbers& random)
{
  Motion motion;
  motion.Offset = std::pow(10.0, random.Uniform(0.0, 6.0)) * random.GetDirection();
  Move(trial, motion);
}

void MakeScale(RefractionTrial& trial, RandomNumbers& random)
{
  Motion motion;
  motion.Scale = std::pow(10.0, random.Uniform(-6.0, 6.0));
  Move(trial, motion);
}

//------------------------------------------------------------------------------
// Facets in another order, each beginning with another corner.
void ReorderFacets(RefractionTrial& trial, RandomNumbers& random)
{
  RefractionScene changed = trial.MakeScene();
  const std::vector<std::int64_t>& from = trial.MakeScene().Mesh.Triangles;
  changed.Mesh.Triangles.clear();
  for (const std::size_t i : RandomOrder(from.size() / 3, random))
  {
    const auto first = static_cast<std::size_t>(random.Below(3));
    changed.Mesh.AddTriangle(
      from[3 * i + first], from[3 * i + (first + 1) % 3], from[3 * i + (first + 2) % 3]);
  }
  trial.Compare(changed, Motion());
}

// Normals define the eye's side; the winding of facets does not.
void TurnFacets(RefractionTrial& trial, RandomNumbers&)
{
  RefractionScene changed = trial.MakeScene();
  for (std::size_t i = 0; i < changed.Mesh.Triangles.size(); i += 3)
  {
    std::swap(changed.Mesh.Triangles[i + 1], changed.Mesh.Triangles[i + 2]);
  }
  trial.Compare(changed, Motion());
}

void ReorderVertices(RefractionTrial& trial, RandomNumbers& random)
{
  const MembraneMesh& from = trial.MakeScene().Mesh;
  RefractionScene changed = trial.MakeScene();
  const std::vector<std::size_t> order = RandomOrder(from.Points.size() / 3, random);
  std::vector<std::int64_t> placeOf(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    placeOf[order[i]] = static_cast<std::int64_t>(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      changed.Mesh.Points[3 * i + axis] = from.Points[3 * order[i] + axis];
      changed.Mesh.Normals[3 * i + axis] = from.Normals[3 * order[i] + axis];
    }
  }
  for (std::int64_t& id : changed.Mesh.Triangles)
  {
    id = placeOf[static_cast<std::size_t>(id)];
  }
  trial.Compare(changed, Motion());
}

//------------------------------------------------------------------------------
// Splits each facet in four at the middles of its patch's edges.
void Divide(RefractionTrial& trial, RandomNumbers&)
{
  const auto geometry = MakeGeometry(trial.MakeScene());
  if (!trial.MakeScene().IsExact || !geometry)
  {
    return; // patches of other surfaces change when they are divided
  }
  RefractionScene changed = trial.MakeScene();
  changed.Mesh = MembraneMesh();
  for (std::size_t i = 0; i < geometry->GetMembrane().GetFacets().size(); ++i)
  {
    const CurvedPatch patch = geometry->GetPatches().GetPatch(static_cast<std::int32_t>(i));
    const glm::dvec2 places[6] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 }, { 0.5, 0.5 },
      { 0.0, 0.5 }, { 0.5, 0.0 } };
    const auto first = static_cast<std::int64_t>(changed.Mesh.Points.size() / 3);
    for (const glm::dvec2& b : places)
    {
      const PatchPoint at = patch.Evaluate(b);
      changed.Mesh.AddPoint(
        at.Position + geometry->GetMembrane().GetOrigin(), glm::normalize(at.Normal));
    }
    changed.Mesh.AddTriangle(first, first + 5, first + 4);
    changed.Mesh.AddTriangle(first + 5, first + 1, first + 3);
    changed.Mesh.AddTriangle(first + 4, first + 3, first + 2);
    changed.Mesh.AddTriangle(first + 3, first + 4, first + 5);
  }
  // Facets do not share points: a body is then open, and points on it are on borders.
  trial.Compare(changed, Motion(), [](const VirtualVertex&) { return true; });
}

// A membrane replaced in place by one with the same facets, and an eye that was elsewhere before.
void EditInPlace(RefractionTrial& trial, RandomNumbers& random)
{
  const RefractionScene& scene = trial.MakeScene();
  Motion motion;
  motion.Scale = random.Uniform(0.5, 2.0);
  motion.Turn = RandomTurn(random);
  const auto geometry = MakeGeometry(motion.Apply(scene));
  if (!geometry || geometry->SetMembrane(scene.Mesh.AsInput()) != MembraneStatus::Ready ||
    geometry->SetEye(scene.Eye, scene.Exterior, scene.Interior) != EyeStatus::Ready)
  {
    return; // an eye on the membrane
  }
  geometry->PrepareSides();
  trial.Compare(*geometry, Motion(), 0.0);
}

// Keeps the part of a closed membrane that the eye sees, with a margin.
void KeepFacingPart(RefractionTrial& trial, RandomNumbers&)
{
  const RefractionScene& scene = trial.MakeScene();
  if (scene.Family != "sphere")
  {
    return;
  }
  RefractionScene changed = scene;
  changed.Mesh.Triangles.clear();
  const auto facing = [&scene](std::int64_t id)
  {
    const auto i = static_cast<std::size_t>(3 * id);
    const glm::dvec3 p(scene.Mesh.Points[i], scene.Mesh.Points[i + 1], scene.Mesh.Points[i + 2]);
    const glm::dvec3 n(scene.Mesh.Normals[i], scene.Mesh.Normals[i + 1], scene.Mesh.Normals[i + 2]);
    return glm::dot(glm::normalize(scene.Eye - p), n);
  };
  for (std::size_t i = 0; i < scene.Mesh.Triangles.size(); i += 3)
  {
    const std::int64_t* ids = scene.Mesh.Triangles.data() + i;
    if (std::max({ facing(ids[0]), facing(ids[1]), facing(ids[2]) }) > 0.0)
    {
      changed.Mesh.AddTriangle(ids[0], ids[1], ids[2]);
    }
  }
  if (!changed.Mesh.Triangles.empty())
  {
    // Compares images on facets that are kept.
    trial.Compare(changed, Motion(), [](const VirtualVertex& image) { return image.Cosine > 0.0; });
  }
}

void TakeFirst(RefractionTrial& trial, RandomNumbers& random)
{
  trial.CompareFirst(RandomOrder(trial.MakeScene().Points.size(), random));
}

struct NamedCheck
{
  const char* Name;
  int Cases;
  Check Run;
};

std::vector<Relation> AllRelations(const ProgrammeOptions& options)
{
  const NamedCheck checks[] = { { "rotation", 60, Rotate }, { "mirroring", 60, Mirror },
    { "translation", 60, Translate }, { "scaling", 60, MakeScale },
    { "facets-reordered", 60, ReorderFacets }, { "facets-turned", 60, TurnFacets },
    { "vertices-reordered", 60, ReorderVertices }, { "facets-divided", 90, Divide },
    { "edit-in-place", 60, EditInPlace }, { "facing-part", 120, KeepFacingPart },
    { "first-of-all", 60, TakeFirst } };
  std::vector<Relation> result;
  for (const NamedCheck& check : checks)
  {
    const std::string name = check.Name;
    const auto start = [&options, name, run = check.Run]() -> RelationWork
    {
      return [&options, name, run](int index)
      {
        RandomNumbers random(SeedOfCase(options.Seed, name, index));
        RefractionTrial trial(RandomScene(random));
        run(trial, random);
        return trial.GetTally();
      };
    };
    result.push_back({ name, CasesAt(options.Intensity, check.Cases), start });
  }
  return result;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  ProgrammeOptions options;
  return RunMetamorphicProgramme(
    argc, argv, Usage, options, [](const std::string&, const std::string&) { return false; },
    [&options]() { return AllRelations(options); });
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Random volume scenes, and changes that must not change their images. Reports deviations and
 * failures per relation; the exit status is 0 if none failed.
 */
#include "RelationRun.h"
#include "VolumeRelation.h"

#include <vtkTetrahedraRayCastMapper.h>

using namespace meniscus::test;

namespace
{

const char* const Usage =
  "meniscus_metamorphic_volume [options]\n"
  "Real meshes are those of the folder in the environment's MENISCUS_DATA_DIR, or ../shared/data\n"
  "beside the sources.\n"
  "  --intensity X      1 (default) takes about half a minute; cases grow with it\n"
  "  --relation TEXT    only relations whose names contain the text\n"
  "  --backend NAME     native, opengl or compute for all scenes (default: all in turn)\n";

// Exit code by which tests are reported as skipped, as in VTK.
constexpr int Skipped = 125;

const std::map<std::string, int> Backends{ { "native", vtkTetrahedraRayCastMapper::NATIVE },
  { "opengl", vtkTetrahedraRayCastMapper::OPENGL },
  { "compute", vtkTetrahedraRayCastMapper::COMPUTE } };

struct Options : ProgrammeOptions
{
  int Backend = vtkTetrahedraRayCastMapper::AUTOMATIC;
};

bool IsBlank(const FloatImage& image)
{
  int drawn = 0;
  for (std::size_t i = 3; i < image.Rgba.size(); i += 4)
  {
    drawn += image.Rgba[i] > 0.02f;
  }
  return drawn < 20;
}

//------------------------------------------------------------------------------
// A trial whose image is not blank: the first of the case's scenes that shows something.
RelationTally RunCase(
  const VolumeRelation& relation, const Options& options, int index, VolumeStage& stage)
{
  RandomNumbers random(SeedOfCase(options.Seed, relation.Name, index));
  constexpr int mostScenes = 50;
  for (int i = 0; i < mostScenes; ++i)
  {
    VolumeCase test = RandomCase(relation.Needs, random);
    if (options.Backend != vtkTetrahedraRayCastMapper::AUTOMATIC)
    {
      test.Backend = options.Backend;
    }
    if (relation.Prepare)
    {
      relation.Prepare(test, random);
    }
    VolumeTrial trial(test, random, stage);
    if (!IsBlank(trial.MakePicture()))
    {
      relation.Check(trial);
      return trial.Done();
    }
  }
  VolumeTrial none(VolumeCase(), random, stage);
  none.Fail("no scene that shows anything");
  return none.Done();
}

// Window of a process, created when first requested: a process is forked without one.
VolumeStage& StageOfProcess()
{
  static VolumeStage stage;
  return stage;
}

Relation ToRelation(const VolumeRelation& relation, const Options& options)
{
  const auto start = [&options, relation]() -> RelationWork
  {
    return [&options, relation](int index)
    { return RunCase(relation, options, index, StageOfProcess()); };
  };
  return { relation.Name, CasesAt(options.Intensity, relation.Cases), start };
}

std::vector<Relation> AllRelations(const Options& options)
{
  std::vector<Relation> result;
  for (const auto& group :
    { PlaceRelations(), MeshRelations(), ValueRelations(), StateRelations(), MembraneRelations() })
  {
    for (const VolumeRelation& relation : group)
    {
      result.push_back(ToRelation(relation, options));
    }
  }
  return result;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  if (!HasDisplay())
  {
    std::cerr << "no display (run under xvfb-run)\n";
    return Skipped;
  }
  Options options;
  return RunMetamorphicProgramme(
    argc, argv, Usage, options,
    [&options](const std::string& key, const std::string& value)
    {
      const auto known = Backends.find(value);
      if (key != "--backend" || known == Backends.end())
      {
        return false;
      }
      options.Backend = known->second;
      return true;
    },
    [&options]() { return AllRelations(options); });
}

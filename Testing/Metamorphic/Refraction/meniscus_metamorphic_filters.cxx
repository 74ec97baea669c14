// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Random membranes, eyes and objects, and changes that must not change the results of the filters
 * of refraction. Reports deviations and failures per relation; the exit status is 0 without a
 * failure.
 */
#include "FilterRelations.h"
#include "RelationRun.h"

using namespace meniscus::test;

namespace
{

const char* const Usage =
  "meniscus_metamorphic_filters [options]\n"
  "  --intensity X      1 (default) takes about a minute; cases grow with it\n"
  "  --relation TEXT    only relations whose names contain the text\n";

std::vector<Relation> MakeRelations(const ProgrammeOptions& options)
{
  std::vector<Relation> result;
  for (const FilterRelation& relation : GetFilterRelations())
  {
    const auto start = [&options, relation]() -> RelationWork
    {
      return [&options, relation](int index)
      {
        RandomNumbers random(SeedOfCase(options.Seed, relation.Name, index));
        return relation.Run(random);
      };
    };
    result.push_back({ relation.Name, CasesAt(options.Intensity, relation.Cases), start });
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
    [&options]() { return MakeRelations(options); });
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomNumbers.h"
#include "Relation.h"

namespace meniscus::test
{

struct FilterRelation
{
  std::string Name;
  int Cases; ///< at intensity 1
  std::function<RelationTally(RandomNumbers&)> Run;
};

/** Relations of vtkRefractedGeometryFilter, vtkRefractedLightFilter, vtkRefractionErrorVolume. */
std::vector<FilterRelation> GetFilterRelations();

/** Those of the light filter and of the error volume. */
std::vector<FilterRelation> GetLightRelations();

} // namespace meniscus::test

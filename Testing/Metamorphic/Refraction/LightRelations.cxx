// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterRelations.h"

namespace meniscus
{
namespace test
{

std::vector<FilterRelation> GetLightRelations()
{
  return {};
}

} // namespace test
} // namespace meniscus

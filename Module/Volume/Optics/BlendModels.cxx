// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Optics/BlendModels.h"

namespace meniscus
{

//------------------------------------------------------------------------------
const BlendModel* FindBlendModel(int number)
{
  for (const BlendModel& model : BlendModels)
  {
    if (static_cast<int>(model.Mode) == number)
    {
      return &model;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
OpacityMeaning OpacityMeaningOf(BlendMode mode, bool perUnitDistance)
{
  const BlendModel& model = GetBlendModel(mode);
  return perUnitDistance && model.IsMedium() ? OpacityMeaning::AlphaPerUnitDistance : model.Opacity;
}

}

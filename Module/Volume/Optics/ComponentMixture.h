// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meniscus
{

/** Use of the components of the scalars for colour and opacity, as defined by vtkVolumeProperty. */
enum class ComponentMixture
{
  /** There is one scalar, which determines both. */
  None,
  /** Each component has its own colour and opacity; attenuations and emissions are added. */
  Independent,
  /** Two components: the first determines the colour and the second the opacity. */
  ColorAndOpacity,
  /** Four components: the first three are the colour and the fourth determines the opacity. */
  RedGreenBlueOpacity
};

}

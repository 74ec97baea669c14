// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_ComponentMixture_h
#define meniscus_Rendering_Input_ComponentMixture_h

namespace meniscus
{

/** How the components of the scalars become colour and opacity, as vtkVolumeProperty has it. */
enum class ComponentMixture
{
  /** There is one scalar, which gives both. */
  None,
  /** Each has a colour and an opacity. */
  Independent,
  /** The first of two gives the colour, the second the opacity. */
  ColorAndOpacity,
  /** The first three are the colour, the fourth gives the opacity. */
  RedGreenBlueOpacity
};

}

#endif

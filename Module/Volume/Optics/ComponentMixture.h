// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Volume_Optics_ComponentMixture_h
#define meniscus_Volume_Optics_ComponentMixture_h

namespace meniscus
{

/** Roles of the components of scalars in colour and opacity, as vtkVolumeProperty has them. */
enum class ComponentMixture
{
  /** There is one scalar, which gives both. */
  None,
  /** Each has a colour and an opacity; attenuations and emissions add up. */
  Independent,
  /** The first of two gives the colour, the second the opacity. */
  ColorAndOpacity,
  /** The first three are the colour, the fourth gives the opacity. */
  RedGreenBlueOpacity
};

}

#endif

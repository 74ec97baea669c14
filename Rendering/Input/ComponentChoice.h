// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkVolumeProperty;

namespace meniscus
{

/**
 * Component of an array of several components that the property's first colour function selects, as
 * in vtkProjectedTetrahedraMapper:
 * - without a colour function, for instance with a grey one: component 0;
 * - if the function's vector mode is COMPONENT: its vector component;
 * - otherwise: the length of the tuple.
 *
 * Component 0 is also the default of a colour function. If component 0 is selected and another
 * component has its own function, independent components are mixed.
 *
 * @param components number of components of the array.
 * @return a component from 0, ScalarSelection::Magnitude, or ScalarSelection::Only if they are
 *   mixed.
 */
int ChooseComponent(vtkVolumeProperty* property, int components);

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_ComponentChoice_h
#define meniscus_Rendering_Input_ComponentChoice_h

class vtkVolumeProperty;

namespace meniscus
{

/**
 * Component, of an array of several components, that a property's first colour function selects, as
 * in vtkProjectedTetrahedraMapper: the length of the tuple unless the function's vector mode is
 * COMPONENT, otherwise its vector component; without a colour function (a grey one has no vector
 * mode) the first component. Component 0 is also the default of a colour function. In that case, if
 * a further component has its own function, independent components are mixed.
 *
 * @param components number of components of the array.
 * @return a component from 0, ScalarSelection::Magnitude, or ScalarSelection::Only if they are
 *   mixed.
 */
int ChooseComponent(vtkVolumeProperty* property, int components);

}

#endif

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Rendering_Input_ComponentChoice_h
#define meniscus_Rendering_Input_ComponentChoice_h

class vtkVolumeProperty;

namespace meniscus
{

/**
 * The component of an array of several that a property's first colour function chooses, as in
 * vtkProjectedTetrahedraMapper: the length of the tuple unless the function's vector mode is
 * COMPONENT, else its vector component; without a colour function (a grey one has no vector mode)
 * the first. The first is also the default of a colour function, and then the property may ask for
 * all: if a further component has a function of its own, independent components mix.
 *
 * @param components  of the array.
 * @return  a component from 0, ScalarSelection::Magnitude, or ScalarSelection::Only if they mix.
 */
int ChooseComponent(vtkVolumeProperty* property, int components);

}

#endif

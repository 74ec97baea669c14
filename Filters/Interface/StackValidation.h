// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_Filters_Interface_StackValidation_h
#define meniscus_Filters_Interface_StackValidation_h

#include <string>

class vtkRefractingInterfaceCollection;

namespace meniscus
{

/**
 * Text of the error for a list that rays cannot pass, one interface after the other: its length is
 * not the number of surfaces, an index is not positive and finite, or the medium behind an
 * interface is not a medium of the next one. Empty if rays can. See FindFault for classes that
 * refract once.
 */
std::string FindStackFault(vtkRefractingInterfaceCollection* interfaces, int surfaces);

}

#endif

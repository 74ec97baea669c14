// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Errors in lists of refracting interfaces. Filters and mapper report the same texts. */
#ifndef meniscus_Filters_Interface_StackValidation_h
#define meniscus_Filters_Interface_StackValidation_h

#include "Refraction/Surface/MediaChain.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkRefractingInterfaceCollection;

namespace meniscus
{

/** Media of the interfaces of a list. */
std::vector<InterfaceMedia> ListMedia(vtkRefractingInterfaceCollection* interfaces);

/** Beginning of a message about an interface; empty if there is one only. */
std::string NameInterface(std::size_t number, std::size_t count);

/** Text of the error for another number of surfaces at a port than of interfaces. */
std::string DescribeCounts(int interfaces, int surfaces, int port);

/** Text of the error for indices of refraction of which one is not positive and finite. */
std::string DescribeBadIndices(double exterior, double interior);

/** Beginning of the text of the error for media that do not match. */
constexpr char MismatchText[] =
  "The indices of refraction do not match along the list of interfaces: ";

/** Text of the error for media that rays cannot pass in the order of the list; empty if none. */
std::string DescribeMediaFault(const std::vector<InterfaceMedia>& media);

/**
 * Text of the error for a list that rays cannot pass, one interface after the other: its length is
 * not the number of surfaces at the port, an index is not positive and finite, or the medium behind
 * an interface is not a medium of the next one. Empty if rays can.
 */
std::string FindStackFault(vtkRefractingInterfaceCollection* interfaces, int surfaces, int port);

}

#endif

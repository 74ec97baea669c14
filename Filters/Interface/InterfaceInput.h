// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Lists of refracting interfaces and the surfaces at a port. Owners report errors alike. */
#pragma once

#include "Refraction/Surface/MediaChain.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkInformation;
class vtkInformationVector;
class vtkPolyData;
class vtkRefractingInterfaceCollection;

namespace meniscus
{

/** Media of the interfaces of a list. */
std::vector<InterfaceMedia> ListMedia(vtkRefractingInterfaceCollection* interfaces);

/** Beginning of a message about an interface; empty if there is one only. */
std::string NameInterface(std::size_t number, std::size_t count);

/** Text of the error for another number of surfaces at a port than of interfaces. */
std::string DescribeCounts(int interfaces, int surfaces, int port);

/** Beginning of the text of the error for media that do not match. */
constexpr char MismatchText[] =
  "The indices of refraction do not match along the list of interfaces: ";

/** Text of the error for media that rays cannot pass in the order of the list; empty if none. */
std::string DescribeMediaFault(const std::vector<InterfaceMedia>& media);

/**
 * Surfaces at the port with this number. Sets `error` if rays cannot pass the list: it has another
 * length than there are surfaces, an index is not positive and finite, or the medium behind an
 * interface is not a medium of the next one. Without any error, also sets it if a surface is
 * missing.
 */
std::vector<vtkPolyData*> ListSurfaces(vtkInformationVector* surfaces, int port,
  vtkRefractingInterfaceCollection* interfaces, std::string& error);

/** Makes a port accept any number of surfaces; without `isOptional`, at least one. Returns 1. */
int AcceptSurfaces(vtkInformation* port, bool isOptional = false);

/** Requests all data of a port whole: every piece of the output needs the whole surfaces. */
void RequestWhole(vtkInformationVector* port);

}

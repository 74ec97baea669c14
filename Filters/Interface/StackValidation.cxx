// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Interface/StackValidation.h"

#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include <sstream>

namespace meniscus
{

//------------------------------------------------------------------------------
std::vector<InterfaceMedia> ListMedia(vtkRefractingInterfaceCollection* interfaces)
{
  std::vector<InterfaceMedia> media;
  for (int i = 0; i < interfaces->GetNumberOfItems(); ++i)
  {
    vtkRefractingInterface* interface = interfaces->GetInterface(i);
    media.push_back(
      { interface->GetExteriorIndexOfRefraction(), interface->GetInteriorIndexOfRefraction() });
  }
  return media;
}

//------------------------------------------------------------------------------
std::string NameInterface(std::size_t number, std::size_t count)
{
  return count > 1 ? "Interface " + std::to_string(number) + ": " : std::string();
}

//------------------------------------------------------------------------------
std::string DescribeCounts(int interfaces, int surfaces, int port)
{
  std::ostringstream text;
  text << "The list has " << interfaces << " refracting interfaces, and port " << port << " has "
       << surfaces << " surfaces; one for each is needed";
  return text.str();
}

//------------------------------------------------------------------------------
std::string DescribeBadIndices(double exterior, double interior)
{
  std::ostringstream text;
  text << "Indices of refraction must be positive and finite, not " << exterior << " and "
       << interior;
  return text.str();
}

//------------------------------------------------------------------------------
std::string DescribeMediaFault(const std::vector<InterfaceMedia>& media)
{
  const MediaChain chain(media);
  if (chain.Fault == MediaFault::None)
  {
    return std::string();
  }
  const InterfaceMedia& fault = media[chain.FaultAt];
  if (chain.Fault == MediaFault::BadIndex)
  {
    return NameInterface(chain.FaultAt, media.size()) +
      DescribeBadIndices(fault.Exterior, fault.Interior);
  }
  std::ostringstream text;
  text << MismatchText << "interface " << chain.FaultAt << " has " << fault.Exterior << " and "
       << fault.Interior << ", and neither is that of the medium behind interface "
       << chain.FaultAt - 1;
  return text.str();
}

//------------------------------------------------------------------------------
std::string FindStackFault(vtkRefractingInterfaceCollection* interfaces, int surfaces, int port)
{
  const int count = interfaces->GetNumberOfItems();
  if (count != surfaces)
  {
    return DescribeCounts(count, surfaces, port);
  }
  return DescribeMediaFault(ListMedia(interfaces));
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Interface/StackValidation.h"

#include "Refraction/Stack/MediaChain.h"

#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include <sstream>
#include <vector>

namespace meniscus
{

//------------------------------------------------------------------------------
std::string FindStackFault(vtkRefractingInterfaceCollection* interfaces, int surfaces)
{
  std::ostringstream text;
  const int count = interfaces->GetNumberOfItems();
  if (count != surfaces)
  {
    text << "There are " << surfaces << " surfaces at the membrane port, and " << count
         << " refracting interfaces in the list; each interface needs its surface";
    return text.str();
  }
  std::vector<InterfaceMedia> media;
  for (int i = 0; i < count; ++i)
  {
    vtkRefractingInterface* interface = interfaces->GetInterface(i);
    media.push_back(
      { interface->GetExteriorIndexOfRefraction(), interface->GetInteriorIndexOfRefraction() });
  }
  const MediaChain chain(media);
  const InterfaceMedia& fault =
    chain.Fault == MediaFault::None ? InterfaceMedia{ 1.0, 1.0 } : media[chain.FaultAt];
  switch (chain.Fault)
  {
    case MediaFault::None:
      break;
    case MediaFault::BadIndex:
      text << "Indices of refraction must be positive and finite, not " << fault.Exterior << " and "
           << fault.Interior << " at interface " << chain.FaultAt;
      break;
    case MediaFault::NoMatch:
      text << "Interface " << chain.FaultAt << " has the indices of refraction " << fault.Exterior
           << " and " << fault.Interior << ", and neither is that of the medium behind interface "
           << chain.FaultAt - 1;
      break;
  }
  return text.str();
}

}

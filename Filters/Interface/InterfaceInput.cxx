// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Interface/InterfaceInput.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"
#include "vtkStreamingDemandDrivenPipeline.h"

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
std::string DescribeMediaFault(const std::vector<InterfaceMedia>& media)
{
  const MediaChain chain(media);
  if (chain.Fault == MediaFault::None)
  {
    return std::string();
  }
  const InterfaceMedia& fault = media[chain.FaultAt];
  std::ostringstream text;
  if (chain.Fault == MediaFault::BadIndex)
  {
    text << NameInterface(chain.FaultAt, media.size())
         << "Indices of refraction must be positive and finite, not " << fault.Exterior << " and "
         << fault.Interior;
    return text.str();
  }
  text << MismatchText << "interface " << chain.FaultAt << " has " << fault.Exterior << " and "
       << fault.Interior << ", and neither is that of the medium behind interface "
       << chain.FaultAt - 1;
  return text.str();
}

//------------------------------------------------------------------------------
std::vector<vtkPolyData*> ListSurfaces(vtkInformationVector* surfaces, int port,
  vtkRefractingInterfaceCollection* interfaces, std::string& error)
{
  const int count = surfaces->GetNumberOfInformationObjects();
  const int items = interfaces->GetNumberOfItems();
  const std::string fault =
    count == items ? DescribeMediaFault(ListMedia(interfaces)) : DescribeCounts(items, count, port);
  error = fault.empty() ? error : fault;
  std::vector<vtkPolyData*> list;
  for (int i = 0; i < count; ++i)
  {
    list.push_back(vtkPolyData::GetData(surfaces, i));
    if (!list.back() && error.empty())
    {
      error = "A surface at the membrane port is missing or is not a vtkPolyData";
    }
  }
  return list;
}

//------------------------------------------------------------------------------
int AcceptSurfaces(vtkInformation* port, bool isOptional)
{
  port->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  port->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  if (isOptional)
  {
    port->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void RequestWhole(vtkInformationVector* port)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* surface = port->GetInformationObject(i);
    surface->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    surface->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    surface->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    // The executive copies the extent of other data, which a surface has only if it comes from an
    // image.
    surface->Remove(Pipeline::UPDATE_EXTENT());
  }
}

}

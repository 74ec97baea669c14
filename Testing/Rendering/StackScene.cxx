// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackScene.h"

#include <vtkRefractingInterface.h>
#include <vtkRefractingInterfaceCollection.h>
#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
{

//------------------------------------------------------------------------------
MembraneCase Between(MembraneCase membrane, double exterior, double interior)
{
  membrane.Surface.Exterior = exterior;
  membrane.Surface.Interior = interior;
  return membrane;
}

//------------------------------------------------------------------------------
void SetStack(vtkTetrahedraRayCastMapper* mapper, const MembraneStack& stack)
{
  vtkNew<vtkRefractingInterfaceCollection> list;
  mapper->RemoveAllMembranes();
  for (const MembraneCase& membrane : stack)
  {
    vtkNew<vtkRefractingInterface> interface;
    interface->SetExteriorIndexOfRefraction(membrane.Surface.Exterior);
    interface->SetInteriorIndexOfRefraction(membrane.Surface.Interior);
    list->AddItem(interface);
    mapper->AddMembraneData(membrane.Mesh);
  }
  mapper->SetInterfaces(list);
}

//------------------------------------------------------------------------------
std::vector<reference::Ray> FindParts(
  const MembraneStack& stack, reference::Ray ray, bool endsOpaque)
{
  std::vector<reference::Ray> parts;
  double eye = 0.0;
  for (const MembraneCase& membrane : stack)
  {
    const reference::RefractedRay refracted = Refract(membrane.Surface, ray, eye, endsOpaque);
    bool meets = false;
    for (const double at : membrane.Surface.Meet(refracted.Straight))
    {
      reference::Vector3 place;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] = ray.Origin[axis] + at * refracted.Straight.Direction[axis];
      }
      meets = meets || (at > eye && membrane.Surface.Has(place));
    }
    if (meets || parts.empty())
    {
      parts.push_back(refracted.Straight);
    }
    ray = refracted.Bent;
    if (!meets || ray.Begin >= ray.End)
    {
      return parts;
    }
    eye = 1e-9; // not the intersection where the part begins
  }
  parts.push_back(ray);
  return parts;
}

//------------------------------------------------------------------------------
std::array<double, 4> ComposeParts(const std::vector<reference::Ray>& parts, const TraceRay& trace)
{
  std::array<double, 4> total{ 0.0, 0.0, 0.0, 0.0 };
  for (const reference::Ray& part : parts)
  {
    if (part.Begin < part.End)
    {
      const std::array<double, 4> behind = trace(part);
      const double left = 1.0 - total[3];
      for (std::size_t c = 0; c < 4; ++c)
      {
        total[c] += left * behind[c];
      }
    }
  }
  return total;
}

//------------------------------------------------------------------------------
MembraneCase MakeBallCase(const reference::Vector3& center, double radius, int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(center.data());
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return { source->GetOutput(), reference::MakeSphere(center, radius) };
}

} // namespace meniscus::test

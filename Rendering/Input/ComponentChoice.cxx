// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Input/ComponentChoice.h"

#include "Rendering/Input/InputBlocks.h"

#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

namespace meniscus
{
namespace
{

bool AreEqual(vtkPiecewiseFunction* a, vtkPiecewiseFunction* b)
{
  bool equal = a->GetSize() == b->GetSize() && a->GetClamping() == b->GetClamping();
  for (int i = 0; equal && i < a->GetSize(); ++i)
  {
    double node[2][4];
    a->GetNodeValue(i, node[0]);
    b->GetNodeValue(i, node[1]);
    equal = std::equal(node[0], node[0] + 4, node[1]);
  }
  return equal;
}

/** True if a component has a function other than the default one that VTK creates on request. */
bool HasOwnFunction(vtkVolumeProperty* property, int component)
{
  vtkNew<vtkVolumeProperty> fresh;
  return property->GetColorChannels(component) != 1 ||
    !AreEqual(
      property->GetGrayTransferFunction(component), fresh->GetGrayTransferFunction(component)) ||
    !AreEqual(property->GetScalarOpacity(component), fresh->GetScalarOpacity(component));
}

}

//------------------------------------------------------------------------------
int ChooseComponent(vtkVolumeProperty* property, int components)
{
  if (property->GetColorChannels(0) != 1)
  {
    vtkColorTransferFunction* colors = property->GetRGBTransferFunction(0);
    if (colors->GetVectorMode() != vtkScalarsToColors::COMPONENT)
    {
      return ScalarSelection::Magnitude;
    }
    if (colors->GetVectorComponent() > 0)
    {
      return colors->GetVectorComponent();
    }
  }
  for (int component = 1; component < std::min(components, VTK_MAX_VRCOMP); ++component)
  {
    if (HasOwnFunction(property, component))
    {
      return ScalarSelection::Only;
    }
  }
  return 0;
}

}

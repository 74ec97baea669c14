// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ValuesOfParts.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/**
 * Length of a tuple, without overflow on the way; a single component as it is, as VTK's colour maps
 * take it, with its sign.
 */
double LengthOf(vtkDataArray* array, vtkIdType tuple)
{
  if (array->GetNumberOfComponents() == 1)
  {
    return array->GetComponent(tuple, 0);
  }
  double length = 0.0;
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    length = std::hypot(length, array->GetComponent(tuple, component));
  }
  return length;
}

}

//------------------------------------------------------------------------------
ValuesOfParts::ValuesOfParts(const InputParts& input, int component)
  : Input(input)
  , Component(component == ScalarSelection::Only ? 0 : component)
{
  std::int64_t next = 0;
  for (const InputPart& part : input.Parts)
  {
    this->Firsts.push_back(next);
    next += part.Scalars->GetNumberOfTuples();
  }
}

//------------------------------------------------------------------------------
double ValuesOfParts::operator()(std::int32_t number) const
{
  const auto after = std::upper_bound(this->Firsts.begin() + 1, this->Firsts.end(), number);
  const auto part = static_cast<std::size_t>(after - this->Firsts.begin()) - 1;
  vtkDataArray* array = this->Input.Parts[part].Scalars;
  const auto tuple = static_cast<vtkIdType>(number - this->Firsts[part]);
  return this->Component == ScalarSelection::Magnitude
    ? LengthOf(array, tuple)
    : array->GetComponent(tuple, array->GetNumberOfComponents() == 1 ? 0 : this->Component);
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Integral/EventArrays.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <limits>
#include <string>

namespace meniscus
{
namespace
{

/** Makes an array whose tuples all have one value. */
void Prepare(
  vtkDataArray* array, const std::string& name, int components, std::int64_t tuples, double value)
{
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(value);
}

}

//------------------------------------------------------------------------------
bool EventChoice::IsAnyWanted() const
{
  return std::count(this->Wanted.begin(), this->Wanted.end(), true) > 0;
}

//------------------------------------------------------------------------------
bool EventChoice::NeedsProperty() const
{
  return this->IsAnyWanted() && GetBlendModel(this->Blending).AccumulatesOpacity();
}

//------------------------------------------------------------------------------
std::int64_t EventChoice::GetNumbersPerPixel() const
{
  const std::int64_t ofEvent = 5 + static_cast<std::int64_t>(sizeof(vtkIdType) / sizeof(float)) +
    (this->HasBlocks ? 1 : 0) + (this->HasSurfaces() ? 1 : 0);
  return ofEvent * std::count(this->Wanted.begin(), this->Wanted.end(), true);
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> IndicesOf(const std::vector<Isosurface>& surfaces)
{
  std::vector<std::int32_t> indices;
  for (const Isosurface& surface : surfaces)
  {
    indices.push_back(surface.Index);
  }
  return indices;
}

//------------------------------------------------------------------------------
InputEvent ConvertEvent(const MeasuredEvent& event, const EventContext& context)
{
  InputEvent result;
  result.Distance = event.Distance;
  result.Position = context.Center + context.ViewToWorld * event.Place;
  result.Value = context.Normalization.Offset + event.Scalar / context.Normalization.Scale;
  result.Cell = context.Cells.Find(context.Sources[static_cast<std::size_t>(event.Cell)]);
  result.Surface =
    event.Surface < 0 ? -1 : context.Surfaces[static_cast<std::size_t>(event.Surface)];
  return result;
}

//------------------------------------------------------------------------------
EventArrays::EventArrays(const EventChoice& choice, std::int64_t pixels)
  : Choice(choice)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t kind = 0; kind < this->Arrays.size(); ++kind)
  {
    if (!choice.Wanted[kind])
    {
      continue;
    }
    OfEvent& arrays = this->Arrays[kind];
    const std::string name = EventNames[kind];
    Prepare(arrays.Depth, name + "Depth", 1, pixels, none);
    Prepare(arrays.Value, name + "Value", 1, pixels, none);
    Prepare(arrays.Position, name + "Position", 3, pixels, none);
    Prepare(arrays.CellId, name + "CellId", 1, pixels, -1.0);
    if (choice.HasBlocks)
    {
      Prepare(arrays.Block, name + "Block", 1, pixels, -1.0);
    }
    if (choice.HasSurfaces())
    {
      Prepare(arrays.Surface, name + "Surface", 1, pixels, -1.0);
    }
  }
}

//------------------------------------------------------------------------------
void EventArrays::Set(
  std::int64_t pixel, const MeasuredEvents& measured, const EventContext& context)
{
  for (std::size_t kind = 0; kind < this->Arrays.size(); ++kind)
  {
    if (!this->Choice.Wanted[kind] || !measured.Events[kind].IsFound())
    {
      continue;
    }
    const InputEvent event = ConvertEvent(measured.Events[kind], context);
    OfEvent& arrays = this->Arrays[kind];
    arrays.Depth->SetValue(pixel, static_cast<float>(event.Distance));
    arrays.Value->SetValue(pixel, static_cast<float>(event.Value));
    for (int axis = 0; axis < 3; ++axis)
    {
      arrays.Position->SetTypedComponent(pixel, axis, static_cast<float>(event.Position[axis]));
    }
    arrays.CellId->SetValue(pixel, static_cast<vtkIdType>(event.Cell.Cell));
    if (this->Choice.HasBlocks)
    {
      arrays.Block->SetValue(pixel, event.Cell.Block);
    }
    if (this->Choice.HasSurfaces())
    {
      arrays.Surface->SetValue(pixel, event.Surface);
    }
  }
}

//------------------------------------------------------------------------------
void EventArrays::AddTo(vtkImageData* image)
{
  vtkPointData* data = image->GetPointData();
  for (std::size_t kind = 0; kind < this->Arrays.size(); ++kind)
  {
    if (!this->Choice.Wanted[kind])
    {
      continue;
    }
    OfEvent& arrays = this->Arrays[kind];
    data->AddArray(arrays.Depth);
    data->AddArray(arrays.Value);
    data->AddArray(arrays.Position);
    data->AddArray(arrays.CellId);
    if (this->Choice.HasBlocks)
    {
      data->AddArray(arrays.Block);
    }
    if (this->Choice.HasSurfaces())
    {
      data->AddArray(arrays.Surface);
    }
    if (!data->GetScalars())
    {
      data->SetActiveScalars(arrays.Depth->GetName());
    }
  }
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraVolumePicker.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Rendering/VolumePick.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>

class vtkTetrahedraVolumePicker::vtkInternals
{
public:
  /** Parameters of the pick, and the places of the volume at hand. */
  meniscus::VolumePick Pick;
  /** Places of the nearest volume. */
  std::array<meniscus::PickedPlace, meniscus::NumberOfRayEvents> Places;
  /** Objects that were picked, kept alive until the next pick. */
  vtkSmartPointer<vtkTetrahedraRayCastMapper> Mapper;
  vtkSmartPointer<vtkDataSet> DataSet;
  vtkSmartPointer<vtkCompositeDataSet> CompositeDataSet;

  /** A place of the picked volume; null if there is none. */
  const meniscus::InputEvent* Find(int place) const
  {
    const auto index = static_cast<std::size_t>(place);
    return place >= 0 && index < this->Places.size() && this->Places[index].IsFound
      ? &this->Places[index].Event
      : nullptr;
  }
};

vtkStandardNewMacro(vtkTetrahedraVolumePicker);
meniscusSetClampMacro(vtkTetrahedraVolumePicker, Place, int, FIRST_VISIBLE, LARGEST_CONTRIBUTION);
meniscusSetClampMacro(vtkTetrahedraVolumePicker, OpacityThreshold, double, 0.0, 1.0);

//------------------------------------------------------------------------------
vtkTetrahedraVolumePicker::vtkTetrahedraVolumePicker()
  : Internals(new vtkInternals)
{
}

//------------------------------------------------------------------------------
vtkTetrahedraVolumePicker::~vtkTetrahedraVolumePicker() = default;

//------------------------------------------------------------------------------
void vtkTetrahedraVolumePicker::Initialize()
{
  this->Superclass::Initialize();
  *this->Internals = vtkInternals();
  this->Mapper = nullptr;
  this->DataSet = nullptr;
  this->CompositeDataSet = nullptr;
  std::fill_n(this->MapperPosition, 3, 0.0);
}

//------------------------------------------------------------------------------
/** Finds the pixel of the viewport. Returns false for places outside. */
bool vtkTetrahedraVolumePicker::FindPixel(double x, double y)
{
  meniscus::VolumePick& pick = this->Internals->Pick;
  int size[2];
  int origin[2];
  this->Renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  const double place[2] = { std::floor(x) - origin[0], std::floor(y) - origin[1] };
  for (int i = 0; i < 2; ++i)
  {
    // False for NaN.
    if (!(place[i] >= 0.0 && place[i] < size[i]))
    {
      return false;
    }
    pick.ViewportSize[i] = size[i];
  }
  pick.Pixel.Column = static_cast<int>(place[0]);
  pick.Pixel.Row = static_cast<int>(place[1]);
  return true;
}

//------------------------------------------------------------------------------
/** Window depth of opaque geometry; 1 if there is none, or if it is not wanted. */
float vtkTetrahedraVolumePicker::ReadOpaqueDepth(double x, double y)
{
  if (!this->UseOpaqueDepth || this->Renderer->GetRenderWindow()->GetNeverRendered())
  {
    return 1.0f;
  }
  return static_cast<float>(
    this->Renderer->GetZ(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))));
}

//------------------------------------------------------------------------------
void vtkTetrahedraVolumePicker::PickProp(vtkProp* prop)
{
  if (!prop->GetPickable() || !prop->GetVisibility())
  {
    return;
  }
  prop->InitPathTraversal();
  while (vtkAssemblyPath* path = prop->GetNextPath())
  {
    this->PickVolume(path);
  }
}

//------------------------------------------------------------------------------
void vtkTetrahedraVolumePicker::PickVolume(vtkAssemblyPath* path)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkVolume* volume = vtkVolume::SafeDownCast(path->GetLastNode()->GetViewProp());
  auto* mapper = volume ? vtkTetrahedraRayCastMapper::SafeDownCast(volume->GetMapper()) : nullptr;
  if (!mapper || !volume->GetPickable() || !volume->GetVisibility())
  {
    return;
  }
  vtkInternals& internals = *this->Internals;
  // As a part of an assembly, the volume has another matrix.
  const bool isPart = path->GetNumberOfItems() > 1;
  if (isPart)
  {
    volume->PokeMatrix(path->GetLastNode()->GetMatrix());
  }
  const bool isAny = mapper->CastPick(this->Renderer, volume, internals.Pick);
  vtkNew<vtkMatrix4x4> worldToModel;
  vtkMatrix4x4::Invert(volume->GetMatrix(), worldToModel);
  if (isPart)
  {
    volume->PokeMatrix(nullptr);
  }
  const meniscus::PickedPlace& place = internals.Pick.Places[static_cast<std::size_t>(this->Place)];
  const meniscus::InputEvent* before = internals.Find(this->Place);
  if (!isAny || !place.IsFound || (before && before->Distance <= place.Event.Distance))
  {
    return;
  }
  internals.Places = internals.Pick.Places;
  internals.Mapper = mapper;
  internals.DataSet = place.DataSet;
  internals.CompositeDataSet = vtkCompositeDataSet::SafeDownCast(mapper->GetInputDataObject(0, 0));
  this->Mapper = internals.Mapper;
  this->DataSet = internals.DataSet;
  this->CompositeDataSet = internals.CompositeDataSet;
  double position[4] = { 0.0, 0.0, 0.0, 1.0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    position[axis] = this->PickPosition[axis] = place.Event.Position[axis];
  }
  worldToModel->MultiplyPoint(position, position);
  std::copy_n(position, 3, this->MapperPosition);
  this->SetPath(path);
}

//------------------------------------------------------------------------------
int vtkTetrahedraVolumePicker::Pick(
  double selectionX, double selectionY, double selectionZ, vtkRenderer* renderer)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  this->Initialize();
  this->Renderer = renderer;
  this->SelectionPoint[0] = selectionX;
  this->SelectionPoint[1] = selectionY;
  this->SelectionPoint[2] = selectionZ;
  this->InvokeEvent(vtkCommand::StartPickEvent, nullptr);
  if (!renderer || !renderer->GetRenderWindow())
  {
    vtkErrorMacro(<< (renderer ? "The renderer has no render window." : "There is no renderer."));
  }
  else if (this->FindPixel(selectionX, selectionY))
  {
    this->Internals->Pick.Pixel.OpaqueDepth = this->ReadOpaqueDepth(selectionX, selectionY);
    this->Internals->Pick.Opacity = this->OpacityThreshold;
    vtkPropCollection* props = this->PickFromList ? this->GetPickList() : renderer->GetViewProps();
    vtkCollectionSimpleIterator it;
    props->InitTraversal(it);
    while (vtkProp* prop = props->GetNextProp(it))
    {
      this->PickProp(prop);
    }
  }
  if (this->Path)
  {
    this->Path->GetFirstNode()->GetViewProp()->Pick();
    this->InvokeEvent(vtkCommand::PickEvent, nullptr);
  }
  this->InvokeEvent(vtkCommand::EndPickEvent, nullptr);
  return this->Path ? 1 : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkTetrahedraVolumePicker::GetCellIdOf(int place)
{
  const meniscus::InputEvent* event = this->Internals->Find(place);
  return event ? static_cast<vtkIdType>(event->Cell.Cell) : -1;
}

//------------------------------------------------------------------------------
vtkIdType vtkTetrahedraVolumePicker::GetFlatBlockIndexOf(int place)
{
  const meniscus::InputEvent* event = this->Internals->Find(place);
  return event ? event->Cell.Block : -1;
}

//------------------------------------------------------------------------------
int vtkTetrahedraVolumePicker::GetSurfaceIndexOf(int place)
{
  const meniscus::InputEvent* event = this->Internals->Find(place);
  return event ? event->Surface : -1;
}

//------------------------------------------------------------------------------
double vtkTetrahedraVolumePicker::GetValueOf(int place)
{
  const meniscus::InputEvent* event = this->Internals->Find(place);
  return event ? event->Value : vtkMath::Nan();
}

//------------------------------------------------------------------------------
double vtkTetrahedraVolumePicker::GetDepthOf(int place)
{
  const meniscus::InputEvent* event = this->Internals->Find(place);
  return event ? event->Distance : vtkMath::Nan();
}

//------------------------------------------------------------------------------
bool vtkTetrahedraVolumePicker::GetPositionOf(int place, double position[3])
{
  const meniscus::InputEvent* event = this->Internals->Find(place);
  for (int axis = 0; axis < 3; ++axis)
  {
    position[axis] = event ? event->Position[axis] : vtkMath::Nan();
  }
  return event != nullptr;
}

//------------------------------------------------------------------------------
void vtkTetrahedraVolumePicker::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const places[] = { "FIRST_VISIBLE", "OPACITY_REACHED", "LARGEST_CONTRIBUTION" };
  os << indent << "Place: " << places[this->Place] << "\n";
  os << indent << "OpacityThreshold: " << this->OpacityThreshold << "\n";
  os << indent << "UseOpaqueDepth: " << this->UseOpaqueDepth << "\n";
  os << indent << "Mapper: " << this->Mapper << "\n";
  os << indent << "DataSet: " << this->DataSet << "\n";
  os << indent << "CompositeDataSet: " << this->CompositeDataSet << "\n";
  os << indent << "MapperPosition: (" << this->MapperPosition[0] << ", " << this->MapperPosition[1]
     << ", " << this->MapperPosition[2] << ")\n";
  os << indent << "CellId: " << this->GetCellId() << "\n";
  os << indent << "FlatBlockIndex: " << this->GetFlatBlockIndex() << "\n";
  os << indent << "SurfaceIndex: " << this->GetSurfaceIndex() << "\n";
  os << indent << "Value: " << this->GetValue() << "\n";
  os << indent << "Depth: " << this->GetDepth() << "\n";
}

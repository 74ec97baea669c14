// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefractedLightFilter.h"

#include "Common/FiniteVector.h"
#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/CellLoop.h"
#include "Filters/Common/NamedArray.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Interface/InterfaceProperties.h"
#include "Filters/Membrane/RefractionScene.h"
#include "Filters/Object/ObjectSurface.h"
#include "Filters/Output/JoinedBlocks.h"
#include "Refraction/Stack/StackLight.h"

#include "vtkRefractedGeometryFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace
{

using meniscus::CellLight;

constexpr char ArrayName[] = "RefractionIrradiance";
constexpr char VectorName[] = "RefractionLightVector";
constexpr char PathName[] = "RefractionLightPath";

// Distance of a light at infinity, in sizes of the scene. Its rays are parallel up to the inverse
// of that, and the tolerance of the view in degrees corresponds to a six-thousandth of the scene.
constexpr double FarAway = 1e4;
constexpr double FarTolerance = 1e-6;
constexpr double NearTolerance = 5e-3; // the view's default

// Rounding error of the mean of interpolated points, in largest coordinates: up to four roundings
// of half an epsilon in each of two means.
constexpr double Rounding = 4.0 * std::numeric_limits<double>::epsilon();

//------------------------------------------------------------------------------
/** Calls `body(cell, number of points, point ids)` for polygons and strips of `data`. */
template <typename Body>
void ForSurfaces(vtkPolyData* data, const Body& body)
{
  vtkIdType cell = data->GetNumberOfVerts() + data->GetNumberOfLines();
  for (vtkCellArray* cells : { data->GetPolys(), data->GetStrips() })
  {
    meniscus::ForEachCell(cells,
      [&](vtkIdType size, const vtkIdType* points)
      { body(cell++, size, points, cells == data->GetStrips()); });
  }
}

//------------------------------------------------------------------------------
/**
 * Area vector: half the sum of the cross products about the first point; for strips, the sum over
 * its triangles.
 */
template <typename Place>
glm::dvec3 AreaOf(vtkIdType size, const vtkIdType* points, bool isStrip, const Place& place)
{
  glm::dvec3 sum(0.0);
  for (vtkIdType i = 2; i < size; ++i)
  {
    const vtkIdType first = isStrip ? i - 2 : 0;
    const glm::dvec3 origin = place(points[first]);
    const double sign = isStrip && i % 2 == 1 ? -1.0 : 1.0;
    sum += 0.5 * sign * glm::cross(place(points[i - 1]) - origin, place(points[i]) - origin);
  }
  return sum;
}

//------------------------------------------------------------------------------
glm::dvec3 TupleOf(vtkDataArray* array, vtkIdType i)
{
  glm::dvec3 tuple;
  array->GetTuple(i, &tuple.x);
  return tuple;
}

//------------------------------------------------------------------------------
/** Area vector of each cell of the input; 0 for lines, vertices and cells with unknown points. */
std::vector<glm::dvec3> ListAreas(vtkPolyData* data)
{
  std::vector<glm::dvec3> areas(static_cast<std::size_t>(data->GetNumberOfCells()));
  const vtkIdType points = data->GetNumberOfPoints();
  ForSurfaces(data,
    [&](vtkIdType cell, vtkIdType size, const vtkIdType* ids, bool isStrip)
    {
      const bool known =
        std::all_of(ids, ids + size, [points](vtkIdType i) { return i >= 0 && i < points; });
      const auto place = [data](vtkIdType point)
      {
        glm::dvec3 position;
        data->GetPoint(point, &position.x);
        return position;
      };
      areas[static_cast<std::size_t>(cell)] =
        known ? AreaOf(size, ids, isStrip, place) : glm::dvec3(0.0);
    });
  return areas;
}

//------------------------------------------------------------------------------
/**
 * Light that each cell of the input receives: (1 - F) A', summed over its images. Vectors and paths
 * are sums as well if the images have true positions.
 */
std::vector<CellLight> GatherLight(
  vtkPolyData* images, const glm::dvec3& light, const std::vector<glm::dvec3>& areas)
{
  std::vector<CellLight> received(areas.size());
  vtkDataArray* sights = images->GetPointData()->GetArray("SightPoint");
  vtkDataArray* places = images->GetPointData()->GetArray("TruePosition");
  vtkDataArray* reflectance = images->GetPointData()->GetArray("Reflectance");
  vtkDataArray* sources = images->GetCellData()->GetArray("SourceCellId");
  if (!sights || !reflectance || !sources)
  {
    return received; // no image at all
  }
  double reach = 0.0;
  for (int i = 0; i < 6; ++i)
  {
    reach = std::max(reach, std::fabs(images->GetBounds()[i]));
  }
  ForSurfaces(images,
    [&](vtkIdType cell, vtkIdType size, const vtkIdType* points, bool isStrip)
    {
      glm::dvec3 middle(0.0);
      glm::dvec3 place(0.0);
      double transmitted = 0.0;
      for (vtkIdType i = 0; i < size; ++i)
      {
        middle += TupleOf(sights, points[i]) / static_cast<double>(size);
        place += TupleOf(places ? places : sights, points[i]) / static_cast<double>(size);
        transmitted += (1.0 - reflectance->GetComponent(points[i], 0)) / static_cast<double>(size);
      }
      const glm::dvec3 area =
        AreaOf(size, points, isStrip, [sights](vtkIdType point) { return TupleOf(sights, point); });
      const double seen = std::fabs(glm::dot(area, glm::normalize(middle - light)));
      const auto source = static_cast<std::size_t>(sources->GetComponent(cell, 0));
      if (source >= areas.size() || !std::isfinite(seen))
      {
        return;
      }
      // In front of the membrane, sight points are the points themselves, within rounding where
      // the membrane cuts a cell.
      const glm::dvec3 behind = middle - place;
      const double length = glm::length(behind);
      const double path = length > Rounding * reach ? length : 0.0;
      const glm::dvec3 toLight = path > 0.0 ? behind / path : glm::normalize(light - place);
      const double own = glm::length(areas[source]);
      const double cosine = own > 0.0 ? glm::dot(areas[source], toLight) / own : 0.0;
      received[source].Add(transmitted * seen, toLight, cosine, path);
    });
  return received;
}

//------------------------------------------------------------------------------
/**
 * Triangles of the polygons and strips of a surface without concave polygons, as AreaOf divides
 * them; without cells that refer to points that do not exist or are not finite.
 */
meniscus::LitTriangles CollectTriangles(const meniscus::ObjectSurface& surface)
{
  vtkPolyData* data = surface.Data;
  meniscus::LitTriangles lit;
  lit.Points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < lit.Points.size(); ++i)
  {
    data->GetPoint(static_cast<vtkIdType>(i), &lit.Points[i].x);
  }
  const auto isPoint = [&lit](vtkIdType id)
  {
    const auto i = static_cast<std::size_t>(id);
    return id >= 0 && i < lit.Points.size() &&
      std::isfinite(lit.Points[i].x + lit.Points[i].y + lit.Points[i].z);
  };
  ForSurfaces(data,
    [&](vtkIdType cell, vtkIdType size, const vtkIdType* points, bool isStrip)
    {
      for (vtkIdType i = 2; i < size && std::all_of(points, points + size, isPoint); ++i)
      {
        const vtkIdType first = points[isStrip ? i - 2 : 0];
        const bool isTurned = isStrip && i % 2 == 1;
        lit.Triangles.push_back(
          { first, points[isTurned ? i : i - 1], points[isTurned ? i - 1 : i] });
        lit.Cells.push_back(surface.Cells ? surface.Cells->GetValue(cell) : cell);
      }
    });
  return lit;
}

//------------------------------------------------------------------------------
/** Light that each cell of the input receives through the interfaces of a stack. */
std::vector<CellLight> GatherThrough(const meniscus::RefractionStack& stack,
  const meniscus::ObjectSurface& surface, std::size_t cells, bool oneSided)
{
  const meniscus::LitTriangles lit = CollectTriangles(surface);
  meniscus::StackLight gathering(stack, lit);
  gathering.SetOneSided(oneSided);
  return gathering.Gather(cells, meniscus::ThreadedLoop);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkFloatArray> MakeZeros(const char* name, int components, vtkIdType tuples)
{
  auto array =
    meniscus::MakeArray<vtkFloatArray>(name, components, static_cast<std::size_t>(tuples));
  array->Fill(0.0);
  return array;
}

//------------------------------------------------------------------------------
/** Arrays of the light of cells, or of points, whose light is a sum over cells. */
class LightArrays
{
public:
  LightArrays(vtkIdType tuples, bool areVectors)
    : Irradiance(MakeZeros(ArrayName, 1, tuples))
  {
    if (areVectors)
    {
      this->Vector = MakeZeros(VectorName, 3, tuples);
      this->Path = MakeZeros(PathName, 1, tuples);
    }
  }

  /** Sets a tuple from sums over an area. */
  void Set(vtkIdType tuple, const CellLight& light, double area)
  {
    this->Irradiance->SetValue(tuple, static_cast<float>(light.Flux / area));
    if (this->Vector)
    {
      const glm::dvec3 vector = light.Vector / area;
      this->Vector->SetTuple(tuple, &vector.x);
      this->Path->SetValue(
        tuple, light.Flux > 0.0 ? static_cast<float>(light.Path / light.Flux) : 0.0f);
    }
  }

  void AddTo(vtkDataSetAttributes* attributes) const
  {
    for (vtkFloatArray* array : { this->Irradiance.Get(), this->Vector.Get(), this->Path.Get() })
    {
      if (array)
      {
        attributes->AddArray(array);
      }
    }
  }

private:
  vtkSmartPointer<vtkFloatArray> Irradiance;
  vtkSmartPointer<vtkFloatArray> Vector;
  vtkSmartPointer<vtkFloatArray> Path;
};

//------------------------------------------------------------------------------
/** @param light position or direction for one-sided lighting, otherwise null. */
void AddIrradiance(vtkPolyData* output, const std::vector<CellLight>& received,
  const std::vector<glm::dvec3>& areas, const glm::dvec3* light, bool areVectors)
{
  LightArrays ofCells(output->GetNumberOfCells(), areVectors);
  const vtkIdType points = output->GetNumberOfPoints();
  std::vector<CellLight> sum(static_cast<std::size_t>(points));
  std::vector<double> weight(static_cast<std::size_t>(points), 0.0);
  ForSurfaces(output,
    [&](vtkIdType cell, vtkIdType size, const vtkIdType* ids, bool)
    {
      const auto number = static_cast<std::size_t>(cell);
      const double length = glm::length(areas[number]);
      if (!(length > 0.0) || !std::isfinite(length))
      {
        return;
      }
      glm::dvec3 first;
      output->GetPoint(ids[0], &first.x);
      const bool turnedAway = light && !(glm::dot(areas[number], *light - first) > 0.0);
      const CellLight own = turnedAway ? CellLight() : received[number];
      ofCells.Set(cell, own, length);
      for (vtkIdType i = 0; i < size; ++i)
      {
        CellLight& total = sum[static_cast<std::size_t>(ids[i])];
        total.Flux += own.Flux;
        total.Vector += own.Vector;
        total.Path += own.Path;
        weight[static_cast<std::size_t>(ids[i])] += length;
      }
    });
  LightArrays ofPoints(points, areVectors);
  for (vtkIdType i = 0; i < points; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    if (weight[at] > 0.0)
    {
      ofPoints.Set(i, sum[at], weight[at]);
    }
  }
  ofCells.AddTo(output->GetCellData());
  ofPoints.AddTo(output->GetPointData());
}

} // anonymous namespace

//------------------------------------------------------------------------------
class vtkRefractedLightFilter::vtkInternals
{
public:
  meniscus::ObjectSurfaces Surfaces;
  meniscus::JoinedBlocks Joined;
  /** Several interfaces, with the light in place of the eye. */
  meniscus::RefractionScene Scene{ meniscus::RefractionScene::Fitting::Exact,
    meniscus::RefractionScene::Use::Rays };
};

vtkStandardNewMacro(vtkRefractedLightFilter);
meniscusInterfacePropertiesMacro(vtkRefractedLightFilter);
meniscusInterfaceTimeMacro(vtkRefractedLightFilter);
meniscusMembranePortMacro(vtkRefractedLightFilter, 1);

//------------------------------------------------------------------------------
vtkRefractedLightFilter::vtkRefractedLightFilter()
  : Internals(std::make_unique<vtkInternals>())
{
  this->Interfaces = meniscus::MakeInterfaces();
  this->SetNumberOfInputPorts(2);
  this->View->SetImagesToAllImages();
  this->View->CloseSeamsOff(); // covered gaps and overlaps would count their light twice
  vtkNew<vtkCallbackCommand> teller;
  teller->SetClientData(this);
  teller->SetCallback(
    [](vtkObject* view, unsigned long event, void* self, void* data)
    {
      auto* filter = static_cast<vtkRefractedLightFilter*>(self);
      if (event == vtkCommand::ProgressEvent)
      {
        filter->UpdateProgress(*static_cast<double*>(data));
        vtkAlgorithm::SafeDownCast(view)->SetAbortExecute(filter->GetAbortExecute());
      }
      else if (view->IsA("vtkExecutive"))
      {
        return; // repeats that there was an error
      }
      else if (event == vtkCommand::ErrorEvent)
      {
        vtkErrorWithObjectMacro(filter, << static_cast<const char*>(data));
      }
      else
      {
        vtkWarningWithObjectMacro(filter, << static_cast<const char*>(data));
      }
    });
  for (const unsigned long event :
    { vtkCommand::ProgressEvent, vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    this->View->AddObserver(event, teller);
  }
  this->View->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, teller);
}

//------------------------------------------------------------------------------
vtkRefractedLightFilter::~vtkRefractedLightFilter() = default;

//------------------------------------------------------------------------------
void vtkRefractedLightFilter::SetMembraneData(vtkPolyData* membrane)
{
  this->SetInputData(1, membrane);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkRefractedLightFilter::GetOutput()
{
  return this->Internals->Joined.Get(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkRefractedGeometryFilter* vtkRefractedLightFilter::GetView()
{
  return this->View;
}

//------------------------------------------------------------------------------
int vtkRefractedLightFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return port == 1 ? meniscus::AcceptSurfaces(info) : 1;
}

//------------------------------------------------------------------------------
// Every piece of the geometry needs the whole membranes.
int vtkRefractedLightFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  meniscus::RequestWhole(inputs[1]);
  return result;
}

//------------------------------------------------------------------------------
/** Returns false after an error. */
bool vtkRefractedLightFilter::PlaceLight(
  vtkPolyData* input, const std::vector<vtkPolyData*>& membranes)
{
  glm::dvec3 light(this->LightPosition[0], this->LightPosition[1], this->LightPosition[2]);
  if (!this->Positional)
  {
    vtkBoundingBox box(input->GetBounds());
    for (vtkPolyData* membrane : membranes)
    {
      box.AddBounds(membrane->GetBounds());
    }
    box.AddBox(this->OtherGeometry);
    double center[3];
    box.GetCenter(center);
    light = glm::dvec3(center[0], center[1], center[2]) +
      FarAway * box.GetDiagonalLength() * glm::normalize(light);
  }
  if (!meniscus::IsFinite(light))
  {
    vtkErrorMacro("LightPosition ("
      << this->LightPosition[0] << ", " << this->LightPosition[1] << ", " << this->LightPosition[2]
      << ") is not a valid position or direction of a light; no irradiance is computed.");
    return false;
  }
  this->View->SetEyePosition(light.x, light.y, light.z);
  this->View->SetAngularTolerance(this->Positional ? NearTolerance : FarTolerance);
  return true;
}

//------------------------------------------------------------------------------
/** Computes the images of the input's surfaces. Returns false after an abort. */
bool vtkRefractedLightFilter::Look(vtkPolyData* input, vtkPolyData* membrane)
{
  // The copy has no arrays, which the images do not need. It is the same object each time, so that
  // the view recognises it.
  this->Surfaces->CopyStructure(input);
  this->Surfaces->Modified();
  this->View->SetInputData(this->Surfaces);
  this->View->SetMembraneData(membrane);
  vtkNew<vtkRefractingInterfaceCollection> first;
  first->AddItem(this->Interfaces->GetFirstInterface());
  this->View->SetInterfaces(
    this->Interfaces->GetNumberOfItems() > 1 ? first.Get() : this->Interfaces.Get());
  this->View->SetTrueGeometry(this->LightVectors);
  this->View->SetAbortExecute(0);
  this->View->Update();
  return this->GetAbortExecute() == 0;
}

//------------------------------------------------------------------------------
int vtkRefractedLightFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkDataSet* geometry = vtkDataSet::GetData(inputs[0]);
  vtkPolyData* membrane = vtkPolyData::GetData(inputs[1]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  if (!geometry || !membrane || !output)
  {
    vtkErrorMacro("The geometry is missing, or the membrane is missing or is not a vtkPolyData; "
                  "the output is empty.");
    return 0;
  }
  // Polygons are not divided: the output has the cells of the input.
  vtkSmartPointer<vtkPolyData> input = vtkPolyData::SafeDownCast(geometry);
  input = input ? input : this->Internals->Surfaces.Get(geometry).Data;
  output->ShallowCopy(input);
  if (input->GetNumberOfPoints() == 0)
  {
    AddIrradiance(output, {}, {}, nullptr, this->LightVectors);
    return 1;
  }
  meniscus::SceneMessages messages;
  const std::vector<vtkPolyData*> surfaces =
    meniscus::ListSurfaces(inputs[1], 1, this->Interfaces, messages.Error);
  meniscus::Report(this, messages);
  if (!messages.Error.empty())
  {
    output->Initialize();
    return 0;
  }
  if (!this->PlaceLight(input, surfaces))
  {
    return 0;
  }
  const std::vector<glm::dvec3> areas = ListAreas(input);
  double place[3];
  this->View->GetEyePosition(place);
  if (surfaces.size() > 1)
  {
    meniscus::RefractionScene& scene = this->Internals->Scene;
    const bool isReady =
      scene.Update({ inputs[1], 1, this->Interfaces }, { place[0], place[1], place[2] }, messages);
    meniscus::Report(this, messages);
    if (!isReady)
    {
      output->Initialize();
      return 0;
    }
    if (!scene.GetStack().GetLinks().empty())
    {
      const std::vector<CellLight> light = GatherThrough(
        scene.GetStack(), this->Internals->Surfaces.Get(input), areas.size(), this->OneSided);
      AddIrradiance(output, light, areas, nullptr, this->LightVectors);
      return 1;
    }
  }
  // Without a refracting interface, the first surface bounds the light.
  if (!this->Look(input, membrane))
  {
    return 1;
  }
  const glm::dvec3 light(place[0], place[1], place[2]);
  AddIrradiance(output, GatherLight(this->View->GetOutput(), light, areas), areas,
    this->OneSided ? &light : nullptr, this->LightVectors);
  return 1;
}

//------------------------------------------------------------------------------
void vtkRefractedLightFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LightPosition: (" << this->LightPosition[0] << ", " << this->LightPosition[1]
     << ", " << this->LightPosition[2] << ")\n";
  os << indent << "Positional: " << (this->Positional ? "on" : "off") << "\n";
  os << indent << "OneSided: " << (this->OneSided ? "on" : "off") << "\n";
  os << indent << "LightVectors: " << (this->LightVectors ? "on" : "off") << "\n";
  os << indent << "ExteriorIndexOfRefraction: " << this->GetExteriorIndexOfRefraction() << "\n";
  os << indent << "InteriorIndexOfRefraction: " << this->GetInteriorIndexOfRefraction() << "\n";
}

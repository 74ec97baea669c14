// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkApparentGeometryFilter.h"

#include "Common/StandardFloatingPoint.h"
#include "Filters/Common/Accessors.h"
#include "Filters/Common/NamedArray.h"
#include "Filters/Common/Statistics.h"
#include "Filters/Common/ThreadedLoop.h"
#include "Rendering/Integral/BentMedium.h"
#include "Volume/Graded/ApparentPlaces.h"
#include "Volume/Graded/GradedRayWalk.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSignedCharArray.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace
{

/** Largest search angle in degrees: its tangent is the size of the grid. */
constexpr double LargestAngle = 89.9;

}

/** Counts of the last points. */
class vtkApparentGeometryFilter::vtkInternals
{
public:
  static const std::vector<meniscus::Statistic<vtkApparentGeometryFilter>>& List();

  std::int64_t OneImage = 0;
  std::int64_t SeveralImages = 0;
  std::int64_t NoImage = 0;
  vtkNew<vtkTable> StatisticsTable;
};

vtkStandardNewMacro(vtkApparentGeometryFilter);
meniscusStatisticsMacro(vtkApparentGeometryFilter);
meniscusSetClampMacro(vtkApparentGeometryFilter, SearchResolution, int, 1, 4096);

//------------------------------------------------------------------------------
vtkApparentGeometryFilter::vtkApparentGeometryFilter()
  : vtkBentMediumAlgorithm(1)
  , Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkApparentGeometryFilter::~vtkApparentGeometryFilter() = default;

//------------------------------------------------------------------------------
const std::vector<meniscus::Statistic<vtkApparentGeometryFilter>>&
vtkApparentGeometryFilter::vtkInternals::List()
{
  using Self = vtkApparentGeometryFilter;
  static const std::vector<meniscus::Statistic<Self>> list = {
    { "NumberOfMediumUpdates", "readings of the index of refraction",
      [](Self& self) { return double(self.Medium->GetVersion().GetChanges()); } },
    { "NumberOfPointsWithOneImage", "points that were seen in one direction",
      [](Self& self) { return double(self.Internals->OneImage); } },
    { "NumberOfPointsWithSeveralImages", "points that were seen in several directions",
      [](Self& self) { return double(self.Internals->SeveralImages); } },
    { "NumberOfPointsWithoutImage", "points for which no image was found",
      [](Self& self) { return double(self.Internals->NoImage); } },
    { "NumberOfUnusablePoints", "points of the mesh whose value cannot be used",
      [](Self& self) { return double(self.Medium->GetFaults().GetNumberOfUnusable()); } },
  };
  return list;
}

//------------------------------------------------------------------------------
vtkPointSet* vtkApparentGeometryFilter::GetOutput()
{
  return vtkPointSet::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
void vtkApparentGeometryFilter::SetMediumData(vtkDataObject* mesh)
{
  this->SetInputDataInternal(1, mesh);
}

//------------------------------------------------------------------------------
int vtkApparentGeometryFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
    return 1;
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

//------------------------------------------------------------------------------
int vtkApparentGeometryFilter::FillOutputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkApparentGeometryFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
    vtkPointSet* output = vtkPointSet::GetData(outputs);
    if (input && (!output || output->GetDataObjectType() != input->GetDataObjectType()))
    {
      outputs->GetInformationObject(0)->Set(
        vtkDataObject::DATA_OBJECT(), vtkSmartPointer<vtkDataObject>::Take(input->NewInstance()));
    }
    return input ? 1 : 0;
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

//------------------------------------------------------------------------------
/** Reason why the settings cannot be used; empty if they can. */
std::string vtkApparentGeometryFilter::FindFault() const
{
  for (const double coordinate : this->EyePosition)
  {
    if (!std::isfinite(coordinate))
    {
      return "The eye is not finite";
    }
  }
  if (!(this->SearchAngle > 0.0 && this->SearchAngle < LargestAngle))
  {
    return "The search angle must be between 0 and 89.9 degrees";
  }
  return {};
}

//------------------------------------------------------------------------------
void vtkApparentGeometryFilter::MovePoints(vtkPointSet* output)
{
  vtkInternals& internals = *this->Internals;
  const meniscus::TetrahedralMesh& mesh = this->Medium->GetMesh();
  const glm::dvec3 eye = glm::make_vec3(this->EyePosition);
  std::vector<glm::dvec3> points(static_cast<std::size_t>(output->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    glm::dvec3 point;
    output->GetPoint(static_cast<vtkIdType>(i), glm::value_ptr(point));
    points[i] = (point - mesh.GetCenter()) / mesh.GetRadius();
  }
  const meniscus::GradedRayWalk walk(this->Medium->MakeField(this->GetOutsideIndex(), false));
  meniscus::ApparentPlaces places(walk, (eye - mesh.GetCenter()) / mesh.GetRadius(),
    std::tan(vtkMath::RadiansFromDegrees(this->SearchAngle)), this->SearchResolution);
  const std::vector<meniscus::ApparentPlace> found = places.Find(points, meniscus::ThreadedLoop);

  vtkNew<vtkPoints> moved;
  moved->SetDataTypeToDouble();
  moved->SetNumberOfPoints(output->GetNumberOfPoints());
  auto* images = meniscus::AddPointArray<vtkIntArray>(output, "NumberOfImages", 1);
  auto* orientations = meniscus::AddPointArray<vtkSignedCharArray>(output, "ImageOrientation", 1);
  internals.OneImage = internals.SeveralImages = internals.NoImage = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const auto number = static_cast<vtkIdType>(i);
    const meniscus::ApparentPlace& place = found[i];
    glm::dvec3 point;
    output->GetPoint(number, glm::value_ptr(point));
    if (place.Images > 0)
    {
      point = eye + glm::length(point - eye) * place.Direction;
    }
    moved->SetPoint(number, glm::value_ptr(point));
    images->SetValue(number, place.Images);
    orientations->SetValue(number, static_cast<signed char>(place.Orientation));
    ++(place.Images == 0 ? internals.NoImage
                         : (place.Images == 1 ? internals.OneImage : internals.SeveralImages));
  }
  output->SetPoints(moved);
  if (internals.NoImage + internals.SeveralImages > 0)
  {
    vtkWarningMacro(<< internals.NoImage << " points have no image and " << internals.SeveralImages
                    << " several; the array NumberOfImages marks them.");
  }
}

//------------------------------------------------------------------------------
int vtkApparentGeometryFilter::RequestData(
  vtkInformation* vtkNotUsed(request), vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const meniscus::StandardFloatingPoint standardFloatingPoint;
  vtkPointSet* output = vtkPointSet::GetData(outputs);
  output->Initialize();
  if (!this->TellError(this->FindFault()) ||
    !this->UpdateMedium(vtkDataObject::GetData(inputs[1]), meniscus::ShareOfMedium))
  {
    return this->GetAbortExecute() ? 1 : 0;
  }
  output->ShallowCopy(vtkPointSet::GetData(inputs[0]));
  if (output->GetNumberOfPoints() > 0)
  {
    this->MovePoints(output);
  }
  this->UpdateProgress(1.0);
  return 1;
}

//------------------------------------------------------------------------------
void vtkApparentGeometryFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EyePosition: (" << this->EyePosition[0] << ", " << this->EyePosition[1] << ", "
     << this->EyePosition[2] << ")\n";
  os << indent << "SearchAngle: " << this->SearchAngle << "\n";
  os << indent << "SearchResolution: " << this->SearchResolution << "\n";
  meniscus::PrintStatistics(meniscus::MeasureStatistics(*this, vtkInternals::List()), os, indent);
}

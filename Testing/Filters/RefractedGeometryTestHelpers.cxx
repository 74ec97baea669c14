// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractedGeometryTestHelpers.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
void MessageCounter::Execute(vtkObject*, unsigned long event, void* message)
{
  ++(event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings);
  this->Text += static_cast<const char*>(message);
}

//------------------------------------------------------------------------------
vtkSmartPointer<MessageCounter> Observe(vtkAlgorithm* filter)
{
  auto counter = vtk::TakeSmartPointer(MessageCounter::New());
  filter->AddObserver(vtkCommand::ErrorEvent, counter);
  filter->AddObserver(vtkCommand::WarningEvent, counter);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, counter);
  return counter;
}

//------------------------------------------------------------------------------
vtkSmartPointer<MessageCounter> UpdateAndObserve(vtkAlgorithm* filter)
{
  auto messages = Observe(filter);
  filter->Update();
  return messages;
}

void ExpectQuiet(vtkAlgorithm* filter)
{
  const auto messages = UpdateAndObserve(filter);
  EXPECT_EQ(messages->Errors + messages->Warnings, 0) << messages->Text;
}

//------------------------------------------------------------------------------
void ProgressWatch::Execute(vtkObject* caller, unsigned long, void*)
{
  auto* algorithm = static_cast<vtkAlgorithm*>(caller);
  this->Falls = this->Falls || algorithm->GetProgress() < this->Last;
  this->Last = algorithm->GetProgress();
  if (this->Last > 0.0 && ++this->Calls == 2 && this->Aborts)
  {
    algorithm->SetAbortExecute(1);
  }
}

//------------------------------------------------------------------------------
double FindLargestLampError(vtkRefractedLightFilter* filter, double height,
  const std::function<double(double)>& radius, const std::function<double(double)>& transmittance)
{
  vtkPolyData* floor = filter->GetOutput();
  vtkDataArray* irradiance = floor->GetPointData()->GetArray("RefractionIrradiance");
  double largest = 0.0;
  for (vtkIdType i = 0; i < floor->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 p = PointOf(floor, i);
    const double r = std::hypot(p[0], p[2]);
    if (r < 5.0 || r > 35.0)
    {
      continue;
    }
    double low = 0.0;
    double high = 1.5;
    for (int step = 0; step < 60; ++step)
    {
      const double middle = 0.5 * (low + high);
      (radius(middle) < r ? low : high) = middle;
    }
    constexpr double small = 1e-5;
    const double slope = (radius(low + small) - radius(low - small)) / (2.0 * small);
    const double onSurface = height * std::tan(low);
    const double surfaceSlope = height / (std::cos(low) * std::cos(low));
    const double expected =
      transmittance(low) * std::cos(low) * onSurface * surfaceSlope / (r * slope);
    largest = std::max(largest, std::fabs(irradiance->GetComponent(i, 0) - expected));
  }
  return largest;
}

//------------------------------------------------------------------------------
void ExpectSameLight(vtkRefractedLightFilter* filter, const std::vector<double>& truth, double size)
{
  vtkPolyData* floor = filter->GetOutput();
  vtkDataArray* irradiance = floor->GetCellData()->GetArray("RefractionIrradiance");
  const double cells = std::sqrt(static_cast<double>(truth.size()));
  double squares = 0.0;
  double signal = 0.0;
  double bounds[6];
  for (vtkIdType i = 0; i < floor->GetNumberOfCells(); ++i)
  {
    floor->GetCellBounds(i, bounds);
    const auto bin = [&](int axis)
    { return std::floor((0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) / size + 0.5) * cells); };
    const double expected = truth[static_cast<std::size_t>(bin(2) * cells + bin(0))];
    squares += std::pow(irradiance->GetTuple1(i) - expected, 2.0);
    signal += expected * expected;
  }
  const double error = std::sqrt(squares / signal);
  EXPECT_LT(error, 0.005) << floor->GetBounds()[2];
  ::testing::Test::RecordProperty(
    "relative_rms_" + std::to_string(static_cast<int>(-floor->GetBounds()[2])),
    std::to_string(error));
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeFlatMembrane()
{
  return MakeMembrane(meniscus::reference::MakeSquare(200.0, 8, 0.0));
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakePoints(const std::vector<Point>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& p : positions)
  {
    points->InsertNextPoint(p.data());
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  return result;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeGrid(int count, double size, double y)
{
  std::vector<Point> positions;
  vtkNew<vtkIdTypeArray> rank;
  rank->SetName("Rank");
  for (int i = 0; i < count * count; ++i)
  {
    positions.push_back({ size * (static_cast<double>(i % count) / (count - 1) - 0.5), y,
      size * (static_cast<double>(i / count) / (count - 1) - 0.5) });
    rank->InsertNextValue(i);
  }
  auto grid = MakePoints(positions);
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkDoubleArray> label;
  label->SetName("Label");
  for (vtkIdType j = 0; j + 1 < count; ++j)
  {
    for (vtkIdType i = 0; i + 1 < count; ++i)
    {
      const vtkIdType a = j * count + i;
      const vtkIdType ids[4] = { a, a + count, a + count + 1, a + 1 };
      label->InsertNextValue(10.0 * static_cast<double>(quads->InsertNextCell(4, ids)));
    }
  }
  grid->SetPolys(quads);
  grid->GetPointData()->AddArray(rank);
  grid->GetCellData()->AddArray(label);
  return grid;
}

//------------------------------------------------------------------------------
void AddBumps(vtkPolyData* data, double up, int type)
{
  auto normals = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  normals->SetName("Bumps");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const auto angle = static_cast<double>(i);
    const glm::dvec3 n =
      glm::normalize(glm::dvec3(0.6 * std::sin(0.7 * angle), up, 0.6 * std::cos(1.3 * angle)));
    normals->InsertNextTuple(&n.x);
  }
  data->GetPointData()->SetNormals(normals);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRefractedGeometryFilter> MakeFilter(vtkPolyData* geometry, vtkPolyData* membrane)
{
  auto filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  filter->SetMembraneModelToFlatFacets();
  filter->SetImagesToFirstImage();
  filter->SetEyePosition(20.0, 300.0, 10.0);
  filter->SetInputData(0, geometry);
  filter->SetInputData(1, membrane);
  return filter;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRefractedGeometryFilter> MakeAllImages(
  vtkPolyData* geometry, vtkPolyData* membrane)
{
  auto filter = MakeFilter(geometry, membrane);
  filter->SetMembraneModelToCurved();
  filter->SetImagesToAllImages();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return filter;
}

//------------------------------------------------------------------------------
void AddTruth(vtkPolyData* data)
{
  data->GetPointData()->AddArray(
    MakeArray("Truth", data->GetNumberOfPoints(), [&](vtkIdType i) { return PointOf(data, i); }));
}

}

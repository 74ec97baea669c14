// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Chart.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace benchmark
{

namespace
{

// Colours that remain distinct in print (Okabe and Ito).
constexpr unsigned char Colors[][3] = { { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 },
  { 213, 94, 0 }, { 204, 121, 167 }, { 120, 120, 120 }, { 0, 114, 178 }, { 0, 0, 0 } };

constexpr int Markers[] = { vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND,
  vtkPlotPoints::CROSS, vtkPlotPoints::PLUS };

struct Range
{
  double Low = 1e300;
  double High = 0.0;
  void Add(double value)
  {
    this->Low = std::min(this->Low, value);
    this->High = std::max(this->High, value);
  }
};

ChartSeries OnlyPositive(const ChartSeries& series)
{
  ChartSeries result;
  result.Label = series.Label;
  for (const auto& point : series.Points)
  {
    if (point.first > 0.0 && point.second > 0.0)
    {
      result.Points.push_back(point);
    }
  }
  return result;
}

void AddPlot(vtkChartXY* chart, const ChartSeries& series, std::size_t number, bool joined)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkFloatArray> x;
  x->SetName("x");
  vtkNew<vtkFloatArray> y;
  y->SetName("y");
  for (const auto& point : series.Points)
  {
    x->InsertNextValue(static_cast<float>(point.first));
    y->InsertNextValue(static_cast<float>(point.second));
  }
  table->AddColumn(x);
  table->AddColumn(y);
  auto* plot =
    vtkPlotPoints::SafeDownCast(chart->AddPlot(joined ? vtkChart::LINE : vtkChart::POINTS));
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(series.Label);
  const auto& color = Colors[number % 8];
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->GetPen()->SetWidth(2.0f);
  plot->SetMarkerStyle(Markers[number % 5]);
  plot->SetMarkerSize(14.0f);
}

// A logarithmic axis over whole decades around the values.
void SetAxis(vtkAxis* axis, const std::string& title, const Range& range)
{
  axis->SetTitle(title);
  axis->GetTitleProperties()->SetFontSize(18);
  axis->GetLabelProperties()->SetFontSize(15);
  axis->SetLogScale(true);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetUnscaledRange(std::pow(10.0, std::floor(std::log10(range.Low))),
    std::pow(10.0, std::ceil(std::log10(range.High))));
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool WriteChart(const std::string& file, const std::string& title, const std::string& xTitle,
  const std::string& yTitle, const std::vector<ChartSeries>& series)
{
  vtkNew<vtkChartXY> chart;
  Range x;
  Range y;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    const ChartSeries positive = OnlyPositive(series[i]);
    if (positive.Points.empty())
    {
      continue;
    }
    AddPlot(chart, positive, i, positive.Points.size() > 1);
    for (const auto& point : positive.Points)
    {
      x.Add(point.first);
      y.Add(point.second);
    }
  }
  if (!(x.High > 0.0))
  {
    return false;
  }
  chart->SetTitle(title);
  chart->GetTitleProperties()->SetFontSize(18);
  SetAxis(chart->GetAxis(vtkAxis::BOTTOM), xTitle, x);
  SetAxis(chart->GetAxis(vtkAxis::LEFT), yTitle, y);
  chart->SetShowLegend(true);
  chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::CENTER);
  chart->GetLegend()->SetInline(false);
  chart->GetLegend()->SetLabelSize(14);

  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(1100, 620);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputConnection(picture->GetOutputPort());
  writer->Write();
  return writer->GetErrorCode() == 0;
}

} // namespace benchmark
} // namespace meniscus

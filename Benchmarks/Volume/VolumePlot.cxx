// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeOutput.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
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

// Colours that stay apart in print (Okabe and Ito).
constexpr unsigned char Colors[][3] = { { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 },
  { 213, 94, 0 }, { 204, 121, 167 }, { 120, 120, 120 }, { 0, 114, 178 }, { 0, 0, 0 } };

constexpr int Markers[] = { vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND,
  vtkPlotPoints::CROSS, vtkPlotPoints::PLUS };

struct Point
{
  std::string Label;
  double Ms;
  double Rms;
};

std::vector<Point> pointsOf(const std::vector<Figures>& all)
{
  std::vector<Point> points;
  for (const Figures& f : all)
  {
    if (f.Survives)
    {
      points.push_back({ f.Name + ", 8 bits", f.SteadyMs, f.Bytes.Rms });
      if (f.HasFloat)
      {
        points.push_back({ f.Name + ", float", f.SteadyMs, f.Float.Rms });
      }
    }
  }
  points.erase(std::remove_if(points.begin(), points.end(),
                 [](const Point& p) { return !(p.Ms > 0.0 && p.Rms > 0.0); }),
    points.end());
  return points;
}

void addPoint(vtkChartXY* chart, const Point& point, std::size_t number)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkFloatArray> x;
  x->SetName("ms");
  x->InsertNextValue(static_cast<float>(point.Ms));
  vtkNew<vtkFloatArray> y;
  y->SetName("RMS");
  y->InsertNextValue(static_cast<float>(point.Rms));
  table->AddColumn(x);
  table->AddColumn(y);
  auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(vtkChart::POINTS));
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(point.Label);
  const auto& color = Colors[number % 8];
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetMarkerStyle(Markers[number % 5]);
  plot->SetMarkerSize(14.0f);
}

// A logarithmic axis over whole decades around the values.
void setAxis(vtkAxis* axis, const std::string& title, double low, double high)
{
  axis->SetTitle(title);
  axis->GetTitleProperties()->SetFontSize(18);
  axis->GetLabelProperties()->SetFontSize(15);
  axis->SetLogScale(true);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetUnscaledRange(
    std::pow(10.0, std::floor(std::log10(low))), std::pow(10.0, std::ceil(std::log10(high))));
}

void drawChart(vtkChartXY* chart, const std::vector<Point>& points)
{
  double ends[4] = { 1e300, 0.0, 1e300, 0.0 };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    addPoint(chart, points[i], i);
    ends[0] = std::min(ends[0], points[i].Ms);
    ends[1] = std::max(ends[1], points[i].Ms);
    ends[2] = std::min(ends[2], points[i].Rms);
    ends[3] = std::max(ends[3], points[i].Rms);
  }
  setAxis(chart->GetAxis(vtkAxis::BOTTOM), "ms per frame", ends[0], ends[1]);
  setAxis(chart->GetAxis(vtkAxis::LEFT), "RMS error", ends[2], ends[3]);
  chart->SetShowLegend(true);
  chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::CENTER);
  chart->GetLegend()->SetInline(false);
  chart->GetLegend()->SetLabelSize(14);
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool writePlot(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all)
{
  const std::vector<Point> points = pointsOf(all);
  if (points.empty())
  {
    return false;
  }
  vtkNew<vtkChartXY> chart;
  chart->SetTitle(description.Mesh + ", " + std::to_string(description.Cells) + " tetrahedra, " +
    std::to_string(options.Size) + " x " + std::to_string(options.Size) + ", " + options.Function);
  chart->GetTitleProperties()->SetFontSize(18);
  drawChart(chart, points);
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
  writer->SetFileName(options.Plot.c_str());
  writer->SetInputConnection(picture->GetOutputPort());
  writer->Write();
  return writer->GetErrorCode() == 0;
}

} // namespace benchmark
} // namespace meniscus

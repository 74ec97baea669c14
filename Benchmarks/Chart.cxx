// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Chart.h"

#include <vtkAxis.h>
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
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscus::benchmark
{

namespace
{

// Colours that remain distinct in print (Okabe and Ito).
constexpr unsigned char Colors[][3] = { { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 },
  { 213, 94, 0 }, { 204, 121, 167 }, { 120, 120, 120 }, { 0, 114, 178 }, { 0, 0, 0 } };

/** Size of the picture in pixels. */
constexpr int Width = 1100;
constexpr int Height = 620;

constexpr int Markers[] = { vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND,
  vtkPlotPoints::CROSS, vtkPlotPoints::PLUS };

/** Curves of more points have no markers, and their names in the middle. */
constexpr std::size_t ManyPoints = 20;

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

/** The points that have a place in the chart. */
ChartSeries OnlyShown(const ChartSeries& series, ChartScale scale)
{
  ChartSeries result;
  result.Label = series.Label;
  for (const auto& point : series.Points)
  {
    if (scale == ChartScale::Linear || (point.first > 0.0 && point.second > 0.0))
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
  plot->SetMarkerStyle(
    series.Points.size() > ManyPoints ? int{ vtkPlotPoints::NONE } : Markers[number % 5]);
  plot->SetMarkerSize(14.0f);
}

// An axis over whole decades around the values, or from zero to a little more than the values.
void SetAxis(vtkAxis* axis, const std::string& title, const Range& range, ChartScale scale)
{
  axis->SetTitle(title);
  axis->GetTitleProperties()->SetFontSize(18);
  // VTK 9.1 draws digits of sizes 15 and 16 with faults at their edges, of 14 and 17 without.
  axis->GetLabelProperties()->SetFontSize(17);
  axis->SetBehavior(vtkAxis::FIXED);
  if (scale == ChartScale::Linear)
  {
    axis->SetUnscaledRange(0.0, 1.1 * range.High);
    return;
  }
  axis->SetLogScale(true);
  axis->SetUnscaledRange(std::pow(10.0, std::floor(std::log10(range.Low))),
    std::pow(10.0, std::ceil(std::log10(range.High))));
}

// Place of a value on an axis, in pixels of the picture.
double PixelOf(vtkAxis* axis, int direction, double value)
{
  double range[2];
  axis->GetUnscaledRange(range);
  const double part = axis->GetLogScale()
    ? std::log(value / range[0]) / std::log(range[1] / range[0])
    : (value - range[0]) / (range[1] - range[0]);
  const double first = axis->GetPoint1()[direction];
  return first + part * (axis->GetPoint2()[direction] - first);
}

/** Left, right, bottom and top in pixels. */
using Box = std::array<double, 4>;

// Markers of a curve, and the line between them in steps of a few pixels.
void TakePlaces(vtkChartXY* chart, const ChartSeries& series, std::vector<Box>& taken)
{
  double last[2] = { 0.0, 0.0 };
  for (std::size_t i = 0; i < series.Points.size(); ++i)
  {
    const double x = PixelOf(chart->GetAxis(vtkAxis::BOTTOM), 0, series.Points[i].first);
    const double y = PixelOf(chart->GetAxis(vtkAxis::LEFT), 1, series.Points[i].second);
    const double length = i ? std::hypot(x - last[0], y - last[1]) : 0.0;
    for (double way = 0.0; way < length; way += 6.0)
    {
      const double u = last[0] + way / length * (x - last[0]);
      const double v = last[1] + way / length * (y - last[1]);
      taken.push_back({ u - 3.0, u + 3.0, v - 3.0, v + 3.0 });
    }
    taken.push_back({ x - 7.0, x + 7.0, y - 7.0, y + 7.0 });
    last[0] = x;
    last[1] = y;
  }
}

// Finds a free place for a name next to a point, within some steps up and down.
bool FindPlace(
  double x, double y, double length, int steps, const std::vector<Box>& taken, Box& box)
{
  constexpr double gap = 12.0;
  for (int step = 0; step < steps; ++step)
  {
    const double middle = y + (step % 2 ? 1.0 : -1.0) * 10.0 * ((step + 1) / 2);
    for (const double left : { x + gap, x - gap - length, x - 0.5 * length })
    {
      box = { left, left + length, middle - 9.0, middle + 9.0 };
      const bool overlaps = std::any_of(taken.begin(), taken.end(),
        [&box](const Box& other) {
          return box[0] < other[1] && other[0] < box[1] && box[2] < other[3] && other[2] < box[3];
        });
      if (!overlaps && left > 0.0 && box[1] < Width && box[2] > 0.0 && box[3] < Height)
      {
        return true;
      }
    }
  }
  return false;
}

// Writes the name of each curve in its colour next to one of its points, where no other name and no
// curve is: the last ones first, or those from the middle on.
void LabelCurves(
  vtkChartXY* chart, const std::vector<ChartSeries>& all, ChartScale scale, vtkRenderer* renderer)
{
  constexpr int few = 4;
  constexpr int many = 40;
  // The numbers of the axes.
  const auto left = static_cast<double>(chart->GetAxis(vtkAxis::LEFT)->GetPoint1()[0]);
  const auto bottom = static_cast<double>(chart->GetAxis(vtkAxis::BOTTOM)->GetPoint1()[1]);
  std::vector<Box> taken{ { 0.0, left, 0.0, Height }, { 0.0, Width, 0.0, bottom } };
  std::vector<ChartSeries> shown;
  for (const ChartSeries& series : all)
  {
    shown.push_back(OnlyShown(series, scale));
    TakePlaces(chart, shown.back(), taken);
  }
  for (std::size_t i = 0; i < shown.size(); ++i)
  {
    std::vector<std::pair<double, double>> points = shown[i].Points;
    if (points.empty())
    {
      continue;
    }
    const auto& color = Colors[i % 8];
    vtkNew<vtkTextActor> label;
    label->SetInput(shown[i].Label.c_str());
    label->GetTextProperty()->SetFontSize(16);
    label->GetTextProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
    label->GetTextProperty()->SetVerticalJustificationToCentered();
    double size[2];
    label->GetSize(renderer, size);
    if (points.size() > ManyPoints)
    {
      std::rotate(points.begin(), points.begin() + points.size() / 2, points.end());
    }
    else
    {
      std::reverse(points.begin(), points.end());
    }
    points.push_back(points.front()); // at last the last point again, with many steps
    Box box{};
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double x = PixelOf(chart->GetAxis(vtkAxis::BOTTOM), 0, points[k].first);
      const double y = PixelOf(chart->GetAxis(vtkAxis::LEFT), 1, points[k].second);
      if (FindPlace(x, y, size[0], k + 1 < points.size() ? few : many, taken, box))
      {
        break;
      }
    }
    taken.push_back(box);
    label->SetDisplayPosition(static_cast<int>(box[0]), static_cast<int>(0.5 * (box[2] + box[3])));
    renderer->AddActor2D(label);
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool WriteChart(const std::string& file, const std::string& title, const std::string& xTitle,
  const std::string& yTitle, const std::vector<ChartSeries>& series, ChartScale scale)
{
  vtkNew<vtkChartXY> chart;
  Range x;
  Range y;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    const ChartSeries shown = OnlyShown(series[i], scale);
    if (shown.Points.empty())
    {
      continue;
    }
    AddPlot(chart, shown, i, shown.Points.size() > 1);
    for (const auto& point : shown.Points)
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
  chart->SetHiddenAxisBorder(40); // half of the last label of the axis below, in pixels
  SetAxis(chart->GetAxis(vtkAxis::BOTTOM), xTitle, x, scale);
  SetAxis(chart->GetAxis(vtkAxis::LEFT), yTitle, y, scale);

  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(Width, Height);
  window->AddRenderer(renderer);
  window->Render(); // places the axes
  LabelCurves(chart, series, scale, renderer);
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

} // namespace meniscus::benchmark

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TracedImage.h"

#include <atomic>
#include <mutex>
#include <thread>

namespace meniscus::test
{

namespace
{

using Color = std::array<double, 4>;

double Difference(const Color& a, const Color& b)
{
  double largest = 0.0;
  for (int c = 0; c < 4; ++c)
  {
    const double d = std::fabs(a[c] - b[c]);
    largest = d <= largest ? largest : d; // passes NaN on
  }
  return largest;
}

// Largest change of the exact result when the ray moves sideways in 8 directions.
double Sensitivity(
  const reference::Ray& ray, const TraceRay& trace, const Color& truth, double distance)
{
  double right[3];
  double up[3];
  vtkMath::Perpendiculars(ray.Direction.data(), right, up, 0.3);
  double largest = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const double angle = vtkMath::RadiansFromDegrees(45.0 * i);
    reference::Ray moved = ray;
    for (int axis = 0; axis < 3; ++axis)
    {
      moved.Origin[axis] += distance * (std::cos(angle) * right[axis] + std::sin(angle) * up[axis]);
    }
    largest = std::max(largest, Difference(trace(moved), truth));
  }
  return largest;
}

// Accumulates the pixels of a row.
class RowComparer
{
public:
  RowComparer(const PixelRays& rays, const TraceRay& trace, double tolerance, double rounding)
    : Rays(rays)
    , Trace(trace)
    , Tolerance(tolerance)
    , Rounding(rounding)
  {
  }

  void Add(int x, int y, const float* drawn)
  {
    const reference::Ray ray = this->Rays.GetRay(x, y);
    const Color truth = this->Trace(ray);
    Color image;
    std::copy(drawn, drawn + 4, image.begin());
    const bool visible = truth[3] > 0.0;
    const double d = Difference(image, truth);
    const bool wrong = !(d <= this->Tolerance);
    this->Sum.Visible += visible;
    if (wrong && d <= 2.0 * Sensitivity(ray, this->Trace, truth, this->Rounding))
    {
      ++this->Sum.Excused;
      return;
    }
    this->Sum.Wrong += wrong;
    this->Squares += visible ? d * d : 0.0;
    if (!(d <= this->Sum.Largest))
    {
      this->Sum.Largest = d;
      this->Sum.WorstPixel[0] = x;
      this->Sum.WorstPixel[1] = y;
      this->Sum.WorstImage = image;
      this->Sum.WorstTruth = truth;
    }
  }

  TracedComparison Sum;
  double Squares = 0.0;

private:
  const PixelRays& Rays;
  const TraceRay& Trace;
  double Tolerance;
  double Rounding;
};

void Merge(const RowComparer& row, TracedComparison& total)
{
  const TracedComparison& sum = row.Sum;
  if (!(sum.Largest <= total.Largest))
  {
    const TracedComparison before = total;
    total = sum;
    total.Visible = before.Visible;
    total.Wrong = before.Wrong;
    total.Excused = before.Excused;
    total.Rms = before.Rms;
  }
  total.Visible += sum.Visible;
  total.Wrong += sum.Wrong;
  total.Excused += sum.Excused;
  total.Rms += row.Squares;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::string TracedComparison::GetText() const
{
  std::ostringstream out;
  out << "visible " << this->Visible << ", wrong " << this->Wrong << ", excused " << this->Excused
      << ", max " << this->Largest << ", rms " << this->Rms << ", worst pixel ("
      << this->WorstPixel[0] << ", " << this->WorstPixel[1] << ") is";
  for (const double value : this->WorstImage)
  {
    out << ' ' << value;
  }
  out << ", truth";
  for (const double value : this->WorstTruth)
  {
    out << ' ' << value;
  }
  return out.str();
}

//------------------------------------------------------------------------------
TracedComparison CompareToTrace(const FloatImage& image, const PixelRays& rays,
  const TraceRay& trace, double tolerance, double rounding)
{
  TracedComparison total;
  std::atomic<int> next{ 0 };
  std::mutex mutex;
  const auto work = [&]()
  {
    for (int y = next++; y < image.Height; y = next++)
    {
      RowComparer row(rays, trace, tolerance, rounding);
      for (int x = 0; x < image.Width; ++x)
      {
        row.Add(x, y, image.GetPixel(x, y));
      }
      const std::lock_guard<std::mutex> lock(mutex);
      Merge(row, total);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned int i = 1; i < std::thread::hardware_concurrency(); ++i)
  {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  total.Rms = total.Visible > 0 ? std::sqrt(total.Rms / static_cast<double>(total.Visible)) : 0.0;
  return total;
}

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StressCheck.h"

#include "ReferenceImage.h"

namespace meniscus::test
{

namespace
{

// Length of a ray's path through a box, by slabs.
double LengthInBox(const reference::Ray& ray, const double bounds[6])
{
  double begin = ray.Begin;
  double end = ray.End;
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double d = ray.Direction[axis];
    square += d * d;
    const double a = (bounds[2 * axis] - ray.Origin[axis]) / d;
    const double b = (bounds[2 * axis + 1] - ray.Origin[axis]) / d;
    if (d == 0.0)
    {
      const bool outside =
        ray.Origin[axis] < bounds[2 * axis] || ray.Origin[axis] > bounds[2 * axis + 1];
      end = outside ? begin : end;
      continue;
    }
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return std::max(0.0, end - begin) * std::sqrt(square);
}

// True if a pixel is possible for some mesh in the box.
bool IsWithinBounds(const float* rgba, double largestDepth, double brightest)
{
  const double alpha = rgba[3];
  const double mostOpaque = -std::expm1(-largestDepth) + FloatTolerance;
  bool good = alpha >= -FloatTolerance && alpha <= std::min(mostOpaque, 1.0 + FloatTolerance);
  for (int c = 0; c < 3; ++c)
  {
    good = good && rgba[c] >= -FloatTolerance && rgba[c] <= alpha * brightest + FloatTolerance;
  }
  return good; // false for NaN
}

// Expected values for the image of one view.
struct View
{
  const StressCase& Stress;
  const VolumeView& Camera;
  RayOfPixel RayOf;
};

std::string NameOf(const View& view, std::size_t number)
{
  return view.Stress.Name + ", view " + std::to_string(number) +
    (view.Camera.Parallel ? " (parallel)" : " (perspective)");
}

void CheckBounds(const StressImage& image, const View& view, StressTally& tally)
{
  double bounds[6];
  view.Stress.Mesh->GetBounds(bounds);
  // Margin for rounding in single precision.
  const double margin = 2.0 * RoundingDistance * DiagonalOf(bounds);
  for (int i = 0; i < 6; ++i)
  {
    bounds[i] += i % 2 ? margin : -margin;
  }
  const double attenuation = LargestAttenuation(view.Stress.Function);
  const double brightest = BrightestColor(view.Stress.Function);
  for (const auto& [y, x] : Product(image.Image.Height, image.Image.Width))
  {
    const double depth = attenuation * LengthInBox(view.RayOf(x, y), bounds);
    const float* rgba = image.Image.GetPixel(x, y);
    if (!IsWithinBounds(rgba, depth, brightest) && ++tally.Wrong == 1)
    {
      std::ostringstream text;
      text << "pixel (" << x << ", " << y << ") is " << rgba[0] << ' ' << rgba[1] << ' ' << rgba[2]
           << ' ' << rgba[3] << ", at most opaque " << -std::expm1(-depth);
      tally.FirstWrong = text.str();
    }
  }
}

void CheckReference(const StressImage& image, const View& view,
  const reference::ReferenceRayIntegrator& integrator, StressTally& tally)
{
  const auto truth = RenderReference(integrator, view.Stress.Size, view.Stress.Size, view.RayOf,
    { reference::ReferenceTransferFunction(view.Stress.Function) });
  const Comparison comparison =
    CompareToReference(image.Image, truth[0], integrator, view.RayOf, FloatTolerance);
  tally.Silhouettes = static_cast<std::int64_t>(comparison.Silhouettes);
  tally.Rounding = static_cast<std::int64_t>(comparison.Wrong - comparison.BeyondRounding);
  tally.Wrong =
    static_cast<std::int64_t>(comparison.BeyondRounding + comparison.CoverageMismatches);
  tally.Largest = comparison.Largest;
  tally.Rms = comparison.Rms;
  const double excused =
    std::max(2.0, view.Stress.SilhouetteShare * static_cast<double>(comparison.Covered));
  if (static_cast<double>(tally.Silhouettes) > excused)
  {
    tally.Wrong += tally.Silhouettes - static_cast<std::int64_t>(excused);
  }
  if (tally.Wrong > 0)
  {
    tally.FirstWrong = comparison.GetText();
  }
}

} // anonymous namespace

//------------------------------------------------------------------------------
void StressTally::Add(const StressTally& other)
{
  this->Views += other.Views;
  this->Rays += other.Rays;
  this->Steps += other.Steps;
  this->Lost += other.Lost;
  this->Stopped += other.Stopped;
  this->StoppedInFolds += other.StoppedInFolds;
  this->Wrong += other.Wrong;
  this->Rounding += other.Rounding;
  this->Silhouettes += other.Silhouettes;
  this->Largest = std::max(this->Largest, other.Largest);
  this->Rms = std::max(this->Rms, other.Rms);
  this->FirstWrong = this->FirstWrong.empty() ? other.FirstWrong : this->FirstWrong;
}

//------------------------------------------------------------------------------
StressTally CheckCase(StressCaster& caster, const StressCase& stress)
{
  StressTally total;
  if (!stress.Mesh)
  {
    return total;
  }
  caster.Take(stress);
  const auto integrator =
    stress.Rule == StressRule::Reference ? MakeReference(stress.Mesh) : nullptr;
  for (std::size_t i = 0; i < stress.Views.size(); ++i)
  {
    const VolumeView& camera = stress.Views[i];
    const View view{ stress, camera,
      [&camera, &stress](int x, int y) { return camera.GetRay(x, y, stress.Size); } };
    const StressImage image = caster.Cast(camera);
    StressTally tally;
    tally.Views = 1;
    tally.Rays = image.Rays;
    tally.Steps = image.Steps;
    tally.Lost = image.Lost;
    if (image.Image.Width != stress.Size || image.Image.Height != stress.Size)
    {
      tally.Wrong = std::int64_t{ stress.Size } * stress.Size;
      tally.FirstWrong = "no image of the requested size";
    }
    else if (integrator)
    {
      CheckReference(image, view, *integrator, tally);
    }
    else
    {
      CheckBounds(image, view, tally);
    }
    if (tally.Lost > 0 && tally.FirstWrong.empty())
    {
      tally.FirstWrong = std::to_string(tally.Lost) + " rays lost";
    }
    if (!tally.FirstWrong.empty())
    {
      tally.FirstWrong = NameOf(view, i) + ": " + tally.FirstWrong;
    }
    total.Add(tally);
  }
  return total;
}

} // namespace meniscus::test

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceImage.h"

#include <atomic>
#include <thread>

namespace meniscus::test
{

namespace
{

// One grey level of an 8-bit image.
constexpr double GreyLevel = 1.0 / 255.0;

// Wrong pixels beyond this number are counted without testing whether they are silhouettes.
constexpr std::size_t MostClassified = 4000;

std::vector<double> WorldPoints(vtkUnstructuredGrid* grid, vtkMatrix4x4* matrix)
{
  std::vector<double> points;
  points.reserve(3 * static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double x[4] = { 0.0, 0.0, 0.0, 1.0 };
    grid->GetPoint(i, x);
    if (matrix)
    {
      matrix->MultiplyPoint(x, x);
    }
    points.insert(points.end(), x, x + 3);
  }
  return points;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::unique_ptr<reference::ReferenceRayIntegrator> MakeReference(
  vtkUnstructuredGrid* grid, vtkMatrix4x4* matrix)
{
  std::vector<std::int64_t> cells;
  cells.reserve(4 * static_cast<std::size_t>(grid->GetNumberOfCells()));
  vtkNew<vtkIdList> ids;
  for (vtkIdType id = 0; id < grid->GetNumberOfCells(); ++id)
  {
    grid->GetCellPoints(id, ids);
    if (ids->GetNumberOfIds() == 4)
    {
      cells.insert(cells.end(), ids->begin(), ids->end());
    }
  }
  vtkDataArray* array = grid->GetPointData()->GetScalars();
  std::vector<double> scalars(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t i = 0; i < scalars.size(); ++i)
  {
    scalars[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
  }
  return std::make_unique<reference::ReferenceRayIntegrator>(
    WorldPoints(grid, matrix), std::move(cells), std::move(scalars));
}

//------------------------------------------------------------------------------
std::vector<ReferenceImage> RenderReference(const reference::ReferenceRayIntegrator& integrator,
  int width, int height, const RayOfPixel& rayOf,
  const std::vector<reference::ReferenceTransferFunction>& functions)
{
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  ReferenceImage blank{ width, height, std::vector<std::array<double, 4>>(pixels),
    std::vector<char>(pixels, 0), {} };
  std::vector<ReferenceImage> images(functions.size(), blank);
  for (std::size_t f = 0; f < functions.size(); ++f)
  {
    images[f].Function = functions[f];
  }

  std::atomic<int> nextRow{ 0 };
  const auto work = [&]()
  {
    std::vector<reference::RaySegment> segments;
    for (int y = nextRow++; y < height; y = nextRow++)
    {
      for (int x = 0; x < width; ++x)
      {
        const reference::Ray ray = rayOf(x, y);
        const reference::RayReport report = integrator.FindSegments(ray, segments);
        const bool overlap = report.Ordered || report.Overlaps > 0;
        const bool covered = !segments.empty();
        const std::size_t at = static_cast<std::size_t>(y) * width + x;
        for (std::size_t f = 0; f < functions.size(); ++f)
        {
          if (overlap)
          {
            integrator.FindVisibleSegments(ray, functions[f], segments);
          }
          images[f].Covered[at] = covered;
          images[f].Rgba[at] = integrator.Integrate(ray, segments, functions[f]);
        }
      }
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
  return images;
}

namespace
{

struct PixelPair
{
  std::array<double, 4> Image;
  std::array<double, 4> Reference;
  bool Covered;
  bool Drawn;
};

double Difference(const PixelPair& pair)
{
  double largest = 0.0;
  for (int c = 0; c < 4; ++c)
  {
    const double d = std::fabs(pair.Image[c] - pair.Reference[c]);
    largest = d <= largest ? largest : d; // passes NaN on
  }
  return largest;
}

// Adds up the pixels of one comparison.
class Comparer
{
public:
  Comparer(const reference::ReferenceRayIntegrator& integrator,
    const reference::ReferenceTransferFunction& function, const RayOfPixel& rayOf, double tolerance)
    : Integrator(integrator)
    , Function(function)
    , RayOf(rayOf)
    , Tolerance(tolerance)
  {
  }

  void Add(int x, int y, const PixelPair& pair)
  {
    Comparison& result = this->Result;
    result.Covered += pair.Covered;
    const double d = Difference(pair);
    const bool wrong = !(d <= this->Tolerance);
    const bool mismatch = pair.Drawn && !pair.Covered;
    if ((wrong || mismatch) && this->IsSilhouette(x, y))
    {
      ++result.Silhouettes;
      return;
    }
    const double sensitivity = wrong ? this->Sensitivity(x, y) : 0.0;
    result.Wrong += wrong;
    result.BeyondRounding += wrong && d > sensitivity;
    result.CoverageMismatches += mismatch;
    if (!(d <= result.Largest))
    {
      result.Largest = d;
      result.WorstSensitivity = sensitivity;
      result.WorstPixel[0] = x;
      result.WorstPixel[1] = y;
      result.WorstImage = pair.Image;
      result.WorstReference = pair.Reference;
    }
    if (pair.Covered)
    {
      this->SumOfSquares += d * d;
      ++this->Counted;
    }
  }

  Comparison GetResult() const
  {
    Comparison done = this->Result;
    done.Rms = this->Counted ? std::sqrt(this->SumOfSquares / this->Counted) : 0.0;
    return done;
  }

private:
  double Sensitivity(int x, int y) const
  {
    return this->Classified >= MostClassified
      ? 0.0
      : this->Integrator.Sensitivity(this->RayOf(x, y),
          RoundingDistance * this->Integrator.MakeMesh().GetDiagonal(), this->Function);
  }

  bool IsSilhouette(int x, int y)
  {
    if (this->Classified >= MostClassified)
    {
      return false;
    }
    ++this->Classified;
    return this->Integrator.Classify(this->RayOf(x, y), this->Integrator.SilhouetteDistance(),
             this->Function) == reference::RayClass::Silhouette;
  }

  const reference::ReferenceRayIntegrator& Integrator;
  const reference::ReferenceTransferFunction& Function;
  const RayOfPixel& RayOf;
  double Tolerance;
  Comparison Result;
  double SumOfSquares = 0.0;
  std::size_t Counted = 0;
  std::size_t Classified = 0;
};

} // anonymous namespace

//------------------------------------------------------------------------------
std::string Comparison::GetText() const
{
  std::ostringstream out;
  out << "covered " << this->Covered << ", wrong " << this->Wrong << " (beyond rounding "
      << this->BeyondRounding << "), coverage mismatches " << this->CoverageMismatches
      << ", silhouettes " << this->Silhouettes << ", max " << this->Largest << ", rms " << this->Rms
      << ", worst pixel (" << this->WorstPixel[0] << ", " << this->WorstPixel[1] << ") is";
  for (const double value : this->WorstImage)
  {
    out << ' ' << value;
  }
  out << ", reference";
  for (const double value : this->WorstReference)
  {
    out << ' ' << value;
  }
  if (this->Wrong > 0)
  {
    out << ", sensitivity " << this->WorstSensitivity;
  }
  return out.str();
}

//------------------------------------------------------------------------------
Comparison CompareToReference(const FloatImage& image, const ReferenceImage& truth,
  const reference::ReferenceRayIntegrator& integrator, const RayOfPixel& rayOf, double tolerance)
{
  Comparer comparer(integrator, truth.Function, rayOf, tolerance);
  for (const auto& [y, x] : Product(truth.Height, truth.Width))
  {
    const float* drawn = image.GetPixel(x, y);
    PixelPair pair;
    std::copy(drawn, drawn + 4, pair.Image.begin());
    pair.Reference = truth.GetPixel(x, y);
    pair.Covered = truth.Covered[static_cast<std::size_t>(y) * truth.Width + x] != 0;
    pair.Drawn = drawn[3] != 0.0f;
    comparer.Add(x, y, pair);
  }
  return comparer.GetResult();
}

//------------------------------------------------------------------------------
Comparison CompareToReference(const ByteImage& image, const ReferenceImage& truth,
  const reference::ReferenceRayIntegrator& integrator, const RayOfPixel& rayOf,
  const std::array<double, 3>& background, int left, int bottom)
{
  // An 8-bit framebuffer rounds the source and the product of blending, and uses the source's alpha
  // in 8 bits: an error of up to half a level each, the last one times the background. At least one
  // level.
  const double brightest = std::max({ background[0], background[1], background[2] });
  const double tolerance = GreyLevel * (1.0 + 0.5 * brightest) * (1.0 + 1e-9);
  Comparer comparer(integrator, truth.Function, rayOf, tolerance);
  for (const auto& [y, x] : Product(truth.Height, truth.Width))
  {
    const unsigned char* drawn = image.GetPixel(left + x, bottom + y);
    const std::array<double, 4>& exact = truth.GetPixel(x, y);
    PixelPair pair;
    pair.Image[3] = pair.Reference[3] = exact[3];
    for (int c = 0; c < 3; ++c)
    {
      const double value = exact[c] + (1.0 - exact[3]) * background[c];
      pair.Image[c] = GreyLevel * drawn[c];
      pair.Reference[c] = std::min(std::max(value, 0.0), 1.0);
    }
    pair.Covered = truth.Covered[static_cast<std::size_t>(y) * truth.Width + x] != 0;
    pair.Drawn = false; // indistinguishable from the background
    comparer.Add(x, y, pair);
  }
  return comparer.GetResult();
}

} // namespace meniscus::test

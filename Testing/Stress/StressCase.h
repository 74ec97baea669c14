// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_StressCase_h
#define meniscus_StressCase_h

#include "ReferenceTransferFunction.h"
#include "StressView.h"
#include "TestMeshes.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

class vtkVolumeProperty;

namespace meniscus
{
namespace test
{

/// What decides whether a picture is right.
enum class StressRule
{
  /// Cells do not overlap: the double reference, pixel by pixel.
  Reference,
  /**
   * There is no truth to the last digit (tangled cells, cells below the resolution of single
   * precision): values are finite, opacities in [0, 1], colours within opacity times the brightest
   * colour, and opacity at most that of the ray's whole way through the mesh's bounding box at the
   * largest attenuation.
   */
  Bounds
};

/// A transfer function as control points of attenuation and colour, ascending.
using StressFunction = std::vector<reference::TransferFunctionNode>;

/// A mesh, a function and views of it.
struct StressCase
{
  std::string Name;
  Grid Mesh; ///< tetrahedra with point scalars; null: not available, the case is skipped
  StressFunction Function;
  std::vector<StressView> Views;
  StressRule Rule = StressRule::Reference;
  int Size = 64; ///< pixels per side
  /// Pixels on silhouettes that are excused, as a share of those covered. Aligned rays run in the
  /// mesh's boundary by design.
  double SilhouetteShare = 0.01;
};

/// Cases of one kind, made one by one.
struct StressFamily
{
  std::string Name;
  int Cases = 0;
  std::function<StressCase(int)> Make;
};

/// Numbers that every standard library draws alike.
class StressRandom
{
public:
  explicit StressRandom(std::uint64_t seed)
    : State(seed)
  {
  }
  /// SplitMix64 (Steele, Lea and Flood 2014).
  std::uint64_t bits()
  {
    std::uint64_t z = (this->State += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double uniform(double low = 0.0, double high = 1.0)
  {
    return low + (high - low) * static_cast<double>(this->bits() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(this->bits() % static_cast<std::uint64_t>(n)); }
  glm::dvec3 direction();

private:
  std::uint64_t State;
};

/**
 * All families.
 * @param intensity  1 takes seconds; random meshes grow with it, repetitions with its square root.
 */
std::vector<StressFamily> stressFamilies(double intensity, std::uint64_t seed);

/// The property that gives a function's attenuation and colour.
vtkSmartPointer<vtkVolumeProperty> toProperty(const StressFunction& function);

} // namespace test
} // namespace meniscus

#endif

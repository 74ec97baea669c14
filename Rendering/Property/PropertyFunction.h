// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Functions of a volume property, evaluated by VTK's tables and reduced to straight pieces.
#pragma once

#include "Volume/Optics/BlendModels.h"
#include "Volume/Optics/TransferFunction.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkColorTransferFunction;
class vtkPiecewiseFunction;

namespace meniscus
{

/** A scalar at which a function has nodes, and their values; several after one another jump. */
struct FunctionNode
{
  double Scalar;
  std::vector<TransferFunctionPoint> Values;
};

/** Colour or attenuation as a function of the scalar. The other one of the two is 0. */
class PropertyFunction
{
public:
  virtual ~PropertyFunction() = default;
  /** Nodes of finite numbers, in ascending order. */
  virtual std::vector<FunctionNode> GetNodes() const = 0;
  /**
   * Scalar of an entry of Sample(): evenly spaced, unless the function has a logarithmic scale.
   * Rounding may put it outside of the range.
   */
  virtual double GetSampledScalar(double first, double last, int count, int i) const;
  /**
   * Values at scalars from first to last. One call costs as much as the function's own table,
   * whatever the number of scalars; a single value may cost nearly as much (0.1 s in VTK's
   * CIEDE2000).
   * @param count at least 1; a single entry is at `first`.
   */
  virtual std::vector<TransferFunctionPoint> Sample(double first, double last, int count) const = 0;
  /** Largest difference of two values in colour, or in alpha over the unit distance. */
  virtual double Difference(const TransferFunctionPoint& a, const TransferFunctionPoint& b) const;
  /** True if each call of Sample() has a high cost of its own. */
  virtual bool HasCostlyCalls() const { return false; }

protected:
  template <typename ColorAt>
  std::vector<TransferFunctionPoint> ListPoints(
    double first, double last, int count, ColorAt&& colorAt) const;
};

/** Opacity as attenuation per world length, or as alpha. */
class OpacityFunction : public PropertyFunction
{
public:
  OpacityFunction(vtkPiecewiseFunction* opacity, OpacityMeaning meaning, double unitDistance);
  std::vector<FunctionNode> GetNodes() const override;
  std::vector<TransferFunctionPoint> Sample(double first, double last, int count) const override;
  double Difference(const TransferFunctionPoint& a, const TransferFunctionPoint& b) const override;

private:
  TransferFunctionPoint MakePoint(double scalar, double opacity) const;

  vtkSmartPointer<vtkPiecewiseFunction> Opacity;
  OpacityMeaning Meaning;
  double Unit;
};

/** Grey levels. */
class GrayFunction : public PropertyFunction
{
public:
  explicit GrayFunction(vtkPiecewiseFunction* gray);
  std::vector<FunctionNode> GetNodes() const override;
  std::vector<TransferFunctionPoint> Sample(double first, double last, int count) const override;

private:
  vtkSmartPointer<vtkPiecewiseFunction> Gray;
};

/** Colours, of a function with discrete colours as well. */
class ColorFunction : public PropertyFunction
{
public:
  explicit ColorFunction(vtkColorTransferFunction* color);
  std::vector<FunctionNode> GetNodes() const override;
  std::vector<TransferFunctionPoint> Sample(double first, double last, int count) const override;
  double GetSampledScalar(double first, double last, int count, int i) const override;
  /** In the space CIEDE2000 each call searches for a path between the colours of two nodes. */
  bool HasCostlyCalls() const override;

private:
  vtkSmartPointer<vtkColorTransferFunction> Color;
  bool IsDiscrete;
  /** True if the scalars of a table are evenly spaced on a logarithmic scale. */
  bool IsLogarithmic;
};

/**
 * The function as points, ascending, with linear interpolation between them: two at a jump. Empty
 * without nodes. Outside of the nodes the first and the last value hold. Between two nodes, the
 * error is less than 1/32768 in colour and in alpha, but for jumps, which take 1/4096 of the
 * distance of the nodes around them.
 */
std::vector<TransferFunctionPoint> ReduceToPoints(const PropertyFunction& function);

}

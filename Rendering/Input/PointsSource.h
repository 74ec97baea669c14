// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Common/RangeLoop.h"
#include "Volume/Mesh/PointsView.h"

#include <cstdint>
#include <vector>

class vtkDataArray;
class vtkDataSet;

namespace meniscus
{

/**
 * Points of data sets, numbered consecutively: a view of the stored coordinates if there is one
 * data set that stores them, otherwise a copy. The data sets must outlive this object.
 */
class PointsSource
{
public:
  PointsSource(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop);
  PointsSource(const PointsSource&) = delete;
  void operator=(const PointsSource&) = delete;

  const PointsView& GetView() const { return this->View; }
  std::int64_t GetNumberOfPoints() const { return this->NumberOfPoints; }

private:
  void LookAt(vtkDataArray* points);
  void Copy(const std::vector<vtkDataSet*>& grids, const RangeLoop& loop);

  PointsView View;
  std::int64_t NumberOfPoints = 0;
  std::vector<double> Copies;
};

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Common/Statistics.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>

namespace meniscus
{

//------------------------------------------------------------------------------
void WriteStatistics(const std::vector<MeasuredStatistic>& statistics, vtkTable* table)
{
  vtkNew<vtkStringArray> names;
  vtkNew<vtkStringArray> meanings;
  vtkNew<vtkDoubleArray> values;
  names->SetName("Name");
  meanings->SetName("Meaning");
  values->SetName("Value");
  for (const MeasuredStatistic& statistic : statistics)
  {
    names->InsertNextValue(statistic.Name);
    meanings->InsertNextValue(statistic.Meaning);
    values->InsertNextValue(statistic.Value);
  }
  table->Initialize();
  table->AddColumn(names);
  table->AddColumn(meanings);
  table->AddColumn(values);
}

//------------------------------------------------------------------------------
void PrintStatistics(
  const std::vector<MeasuredStatistic>& statistics, ostream& os, vtkIndent indent)
{
  // Doubles have all integers up to this number; larger ones are no counters.
  constexpr double exact = 9007199254740992.0;
  for (const MeasuredStatistic& statistic : statistics)
  {
    os << indent << statistic.Name << ": ";
    if (std::abs(statistic.Value) <= exact && statistic.Value == std::floor(statistic.Value))
    {
      os << static_cast<long long>(statistic.Value) << "\n";
    }
    else
    {
      os << statistic.Value << "\n";
    }
  }
}

}

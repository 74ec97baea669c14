// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Statistics of a class by name: GetStatistics() and GetStatistic(). */
#pragma once

#include "vtkIOStream.h"
#include "vtkIndent.h"
#include "vtkMath.h"

#include <functional>
#include <string>
#include <vector>

class vtkTable;

namespace meniscus
{

/** A number that an object reports: a counter, a size or an error. */
template <typename Owner>
struct Statistic
{
  /** As in the getter's name, without Get. */
  const char* Name;
  const char* Meaning;
  std::function<double(Owner& owner)> Measure;
};

/** A statistic and its present value. */
struct MeasuredStatistic
{
  const char* Name;
  const char* Meaning;
  double Value;
};

/** Statistics of a part of an owner, which `get` returns, followed by the owner's own. */
template <typename Owner, typename Part>
std::vector<Statistic<Owner>> JoinStatistics(const std::vector<Statistic<Part>>& ofPart,
  Part& (*get)(Owner& owner), const std::vector<Statistic<Owner>>& own)
{
  std::vector<Statistic<Owner>> joined;
  for (const Statistic<Part>& statistic : ofPart)
  {
    joined.push_back({ statistic.Name, statistic.Meaning,
      [measure = statistic.Measure, get](Owner& owner) { return measure(get(owner)); } });
  }
  joined.insert(joined.end(), own.begin(), own.end());
  return joined;
}

/** All statistics of an owner, measured. */
template <typename Owner>
std::vector<MeasuredStatistic> MeasureStatistics(
  Owner& owner, const std::vector<Statistic<Owner>>& statistics)
{
  std::vector<MeasuredStatistic> measured;
  for (const Statistic<Owner>& statistic : statistics)
  {
    measured.push_back({ statistic.Name, statistic.Meaning, statistic.Measure(owner) });
  }
  return measured;
}

/** The statistic of a name, which alone is to be measured; null if there is none. */
template <typename Owner>
const Statistic<Owner>* FindStatistic(
  const std::vector<Statistic<Owner>>& statistics, const std::string& name)
{
  for (const Statistic<Owner>& statistic : statistics)
  {
    if (name == statistic.Name)
    {
      return &statistic;
    }
  }
  return nullptr;
}

/** Fills a table with one row per statistic and the columns Name, Meaning and Value. */
void WriteStatistics(const std::vector<MeasuredStatistic>& statistics, vtkTable* table);

/** Prints one line per statistic, name and value. */
void PrintStatistics(
  const std::vector<MeasuredStatistic>& statistics, ostream& os, vtkIndent indent);

}

/**
 * Defines GetStatistics() and GetStatistic() of a class whose vtkInternals have a static function
 * List(), a std::vector<meniscus::Statistic<className>>, and the vtkTable StatisticsTable.
 */
#define meniscusStatisticsMacro(className)                                                         \
  vtkTable* className::GetStatistics()                                                             \
  {                                                                                                \
    meniscus::WriteStatistics(                                                                     \
      meniscus::MeasureStatistics(*this, vtkInternals::List()), this->Internals->StatisticsTable); \
    return this->Internals->StatisticsTable;                                                       \
  }                                                                                                \
  double className::GetStatistic(const char* name)                                                 \
  {                                                                                                \
    const auto* found = meniscus::FindStatistic(vtkInternals::List(), name ? name : "");           \
    if (!found)                                                                                    \
    {                                                                                              \
      vtkErrorMacro(<< "There is no statistic '" << (name ? name : "")                             \
                    << "'; GetStatistics() lists all");                                            \
      return vtkMath::Nan();                                                                       \
    }                                                                                              \
    return found->Measure(*this);                                                                  \
  }

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace meniscus::benchmark
{

/** Processor time of all threads of this program, which does not include other programs. */
inline double CpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

inline double WallSeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Seconds
{
  double Wall = 0.0;
  double Cpu = 0.0;
};

template <typename Work>
Seconds TimeOnce(const Work& work)
{
  const double wall = WallSeconds();
  const double cpu = CpuSeconds();
  work();
  return { WallSeconds() - wall, CpuSeconds() - cpu };
}

inline double MedianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Medians of wall and processor times, each separately. */
inline Seconds MedianOf(const std::vector<Seconds>& times)
{
  std::vector<double> wall;
  std::vector<double> cpu;
  for (const Seconds& time : times)
  {
    wall.push_back(time.Wall);
    cpu.push_back(time.Cpu);
  }
  return { MedianOf(wall), MedianOf(cpu) };
}

/**
 * Time of one call of `work`, the mean of as many as take 10 ms together: the processor's clock
 * counts microseconds, and the first calls find other data in the caches.
 */
template <typename Work>
Seconds TimeShort(const Work& work)
{
  constexpr double least = 0.01;
  Seconds sum;
  int calls = 0;
  for (int batch = 1; sum.Cpu < least; batch *= 2)
  {
    const Seconds some = TimeOnce(
      [&work, batch]
      {
        for (int i = 0; i < batch; ++i)
        {
          work();
        }
      });
    sum.Wall += some.Wall;
    sum.Cpu += some.Cpu;
    calls += batch;
  }
  return { sum.Wall / calls, sum.Cpu / calls };
}

/** Median of `runs` times of `work` after one warm-up. */
template <typename Work>
Seconds TimeMedian(const Work& work, int runs = 5)
{
  work();
  std::vector<Seconds> times;
  for (int i = 0; i < runs; ++i)
  {
    times.push_back(TimeShort(work));
  }
  return MedianOf(times);
}

} // namespace meniscus::benchmark

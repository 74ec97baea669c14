// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace meniscus::benchmark
{

struct RefractionOptions
{
  bool Thesis = false;
  bool Growth = false;
  bool Frames = false;
  bool Report = false;
  bool Pass = false;
  bool Help = false;
  std::string Row;
  std::string Json;
  std::string Csv;
  std::string Plot;
  std::string Picture;
  std::string Rivals;
  int Threads = 2;
  std::string Problem;
};

extern const char* const RefractionUsage;

RefractionOptions ParseRefractionOptions(int argc, char* argv[]);

} // namespace meniscus::benchmark

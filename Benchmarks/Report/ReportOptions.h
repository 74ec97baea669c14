// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace meniscus::report
{

struct ReportOptions
{
  bool Quick = false;
  bool Help = false;
  std::string Output = "report";
  std::string Programs; ///< folder of the test and benchmark programs; default: that of this one
  std::string Data;     ///< folder of meshes; may be empty
  std::string About;    ///< file with lines "name: value" to include
  std::string Driver;   ///< sentence on how the graphics driver was chosen
  std::string Problem;
};

extern const char* const ReportUsage;

ReportOptions ParseReportOptions(int argc, char* argv[]);

} // namespace meniscus::report

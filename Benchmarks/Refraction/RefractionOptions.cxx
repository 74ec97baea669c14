// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionOptions.h"

#include <cstdlib>

namespace meniscus::benchmark
{

const char* const RefractionUsage =
  "usage: meniscus_benchmark_refraction [options]\n"
  "\n"
  "  --thesis     error of virtual vertices, thesis Tables 4.1 to 4.5 side by side\n"
  "  --growth     time against error and cost, 98 to 1M facets; cost by vertices; one thread\n"
  "  --frames     frames of 512 x 512: thesis Tables 4.6 to 4.9 side by side, and against Embree;\n"
  "               needs a display\n"
  "  --report     each row of the table of goals; needs a display\n"
  "  --pass       frames of the filter and of vtkRefractionPass, and the pool; needs a display\n"
  "  --row TEXT   only rows of the report whose names contain the text\n"
  "  --threads N  for frames and rows of two threads (default 2)\n"
  "  --json FILE  write what --thesis, --growth and --pass measured\n"
  "  --csv FILE   write time against error\n"
  "  --plot FILE  draw time against error to a PNG file; needs a display\n"
  "  --picture FILE  write the pool, drawn by vtkRefractionPass, to a PNG file; needs a display\n"
  "  --rivals FOLDER  time against error of other methods, charts in the folder; needs a display\n"
  "  --help       this text\n"
  "\n"
  "Without any of the first five and --rivals, --thesis and --growth are run. Times are processor "
  "times where\n"
  "nothing else is said; nothing is judged.\n";

//------------------------------------------------------------------------------
RefractionOptions ParseRefractionOptions(int argc, char* argv[])
{
  RefractionOptions options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string key = argv[i];
    bool* const flag = key == "--thesis" ? &options.Thesis
      : key == "--growth"                ? &options.Growth
      : key == "--frames"                ? &options.Frames
      : key == "--report"                ? &options.Report
      : key == "--pass"                  ? &options.Pass
      : key == "--help" || key == "-h"   ? &options.Help
                                         : nullptr;
    std::string* const text = key == "--json" ? &options.Json
      : key == "--csv"                        ? &options.Csv
      : key == "--plot"                       ? &options.Plot
      : key == "--picture"                    ? &options.Picture
      : key == "--rivals"                     ? &options.Rivals
      : key == "--row"                        ? &options.Row
                                              : nullptr;
    if (flag)
    {
      *flag = true;
    }
    else if (text && i + 1 < argc)
    {
      *text = argv[++i];
    }
    else if (key == "--threads" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
    {
      options.Threads = std::atoi(argv[++i]);
    }
    else
    {
      options.Problem = "unknown option, or bad or missing value: " + key;
      return options;
    }
  }
  if (!options.Thesis && !options.Growth && !options.Frames && !options.Report && !options.Pass &&
    options.Rivals.empty())
  {
    options.Thesis = true;
    options.Growth = true;
  }
  return options;
}

} // namespace meniscus::benchmark

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Rows of Markdown tables, which a report of several runs consists of. */
#include "VolumeOutput.h"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace meniscus::benchmark
{

namespace
{

const char* const TimeHeading =
  "| mesh | tetrahedra | window | mode | mapper | frames/s | ms/frame | views, ms | first frame, "
  "ms "
  "| new mesh, ms | million steps/s | reads, GB/s | of the copies' | tables on device, MB | lost "
  "rays |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
const char* const ErrorHeading =
  "| mesh | window | function | mapper | float, largest | float, RMS | 8 bits, largest | 8 bits, "
  "RMS | over 2/255, % |\n|---|---|---|---|---|---|---|---|---|\n";

//------------------------------------------------------------------------------
std::string MakeCell(double value, int digits, bool known)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return (known ? text.str() : "-") + " | ";
}

//------------------------------------------------------------------------------
std::string MakeErrorCell(double value, bool known)
{
  std::ostringstream text;
  text << std::scientific << std::setprecision(1) << value;
  return (known ? text.str() : "-") + " | ";
}

//------------------------------------------------------------------------------
std::string MeshName(const RunDescription& description)
{
  const std::size_t slash = description.Mesh.rfind('/');
  return slash == std::string::npos ? description.Mesh : description.Mesh.substr(slash + 1);
}

//------------------------------------------------------------------------------
std::string WindowName(const VolumeOptions& options)
{
  return std::to_string(options.Width) + " x " + std::to_string(options.Height);
}

//------------------------------------------------------------------------------
std::string MakeTimeRow(const Figures& f, double copyBandwidth)
{
  if (!f.Survives)
  {
    return f.Name + ": " + f.Fate + " | - | - | - | - | - | - | - | - | - | - |\n";
  }
  const auto ends = std::minmax_element(f.ViewMs.begin(), f.ViewMs.end());
  const double reads = f.StepsPerSecond * f.TableBytesPerStep;
  const bool ours = f.Name.compare(0, 8, "meniscus") == 0;
  std::ostringstream views;
  views << std::fixed << std::setprecision(1) << *ends.first << " - " << *ends.second;
  return f.Name + " | " + MakeCell(1e3 / f.SteadyMs, 2, true) + MakeCell(f.SteadyMs, 1, true) +
    views.str() + " | " + MakeCell(f.ColdMs, 1, true) + MakeCell(f.SetUpMs, 1, f.SetUpMs > 0.0) +
    MakeCell(1e-6 * f.StepsPerSecond, 1, f.StepsPerSecond > 0.0) +
    MakeCell(1e-9 * reads, 2, reads > 0.0) +
    MakeCell(reads / std::max(1.0, copyBandwidth), 3, reads > 0.0 && copyBandwidth > 0.0) +
    MakeCell(1e-6 * f.DeviceBytes, 1, f.DeviceBytes > 0.0) + MakeCell(f.LostRays, 0, ours) + "\n";
}

//------------------------------------------------------------------------------
std::string MakeErrorRow(const Figures& f)
{
  if (!f.Survives)
  {
    return f.Name + ": " + f.Fate + " | - | - | - | - | - |\n";
  }
  const bool hasFloat = f.IsCompared && f.HasFloat;
  return f.Name + " | " + MakeErrorCell(f.Float.Largest, hasFloat) +
    MakeErrorCell(f.Float.Rms, hasFloat) + MakeErrorCell(f.Bytes.Largest, f.IsCompared) +
    MakeErrorCell(f.Bytes.Rms, f.IsCompared) + MakeCell(100.0 * f.Bytes.OffShare, 3, f.IsCompared) +
    "\n";
}

//------------------------------------------------------------------------------
// Opened to append; with the heading if it is new.
std::ofstream OpenTable(const std::string& file, const char* heading)
{
  const bool isNew = !std::ifstream(file).good();
  std::ofstream out(file, std::ios::app);
  if (isNew)
  {
    out << heading;
  }
  return out;
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool AppendTimeRows(const std::string& file, const VolumeOptions& options,
  const RunDescription& description, const std::vector<Figures>& all)
{
  std::ofstream out = OpenTable(file, TimeHeading);
  for (const Figures& figures : all)
  {
    out << "| " << MeshName(description) << " | " << description.Cells << " | "
        << WindowName(options) << " | " << NameOf(options.Mode) << " | "
        << MakeTimeRow(figures, description.CopyBandwidth);
  }
  return out.good();
}

//------------------------------------------------------------------------------
bool AppendErrorRows(const std::string& file, const VolumeOptions& options,
  const RunDescription& description, const std::vector<Figures>& all)
{
  std::ofstream out = OpenTable(file, ErrorHeading);
  for (const Figures& figures : all)
  {
    out << "| " << MeshName(description) << " | " << WindowName(options) << " | "
        << options.Function << " | " << MakeErrorRow(figures);
  }
  return out.good();
}

} // namespace meniscus::benchmark

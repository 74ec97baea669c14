// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeOutput.h"

#include <vtkSMPTools.h>
#include <vtkVersion.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace meniscus::benchmark
{

namespace
{

//------------------------------------------------------------------------------
bool IsOurs(const Figures& figures)
{
  return figures.Name.compare(0, 8, "meniscus") == 0;
}

//------------------------------------------------------------------------------
std::string MakeNumber(double value, int digits, bool known = true)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return known ? text.str() : "-";
}

//------------------------------------------------------------------------------
std::string Scientific(double value, bool known = true)
{
  std::ostringstream text;
  text << std::scientific << std::setprecision(1) << value;
  return known ? text.str() : "-";
}

//------------------------------------------------------------------------------
void PrintRow(std::ostream& out, const std::vector<std::string>& cells)
{
  const int widths[] = { 38, 10, 10, 10, 17, 10, 10, 8, 10, 10, 10, 10, 10 };
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    out << (i ? std::right : std::left) << std::setw(widths[i]) << cells[i];
  }
  out << '\n';
}

//------------------------------------------------------------------------------
void PrintFigures(std::ostream& out, const Figures& f)
{
  if (!f.Survives)
  {
    PrintRow(out, { f.Name, f.Fate });
    return;
  }
  const auto ends = std::minmax_element(f.ViewMs.begin(), f.ViewMs.end());
  const std::string spread =
    f.ViewMs.empty() ? "" : MakeNumber(*ends.first, 1) + " - " + MakeNumber(*ends.second, 1);
  const bool hasFloat = f.IsCompared && f.HasFloat;
  PrintRow(out,
    { f.Name, MakeNumber(f.ColdMs, 1), MakeNumber(f.SetUpMs, 1, f.SetUpMs > 0.0),
      MakeNumber(f.SteadyMs, 1), spread, MakeNumber(f.CpuMs, 1),
      MakeNumber(1e-6 * f.StepsPerSecond, 1, f.StepsPerSecond > 0.0),
      MakeNumber(f.BytesPerCell, 0, f.BytesPerCell > 0.0),
      Scientific(f.Bytes.Largest, f.IsCompared), Scientific(f.Bytes.Rms, f.IsCompared),
      MakeNumber(100.0 * f.Bytes.OffShare, 2, f.IsCompared), Scientific(f.Float.Largest, hasFloat),
      Scientific(f.Float.Rms, hasFloat) });
}

//------------------------------------------------------------------------------
std::string Quoted(const std::string& text)
{
  std::string result = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      result += '\\';
    }
    result += c;
  }
  return result + "\"";
}

//------------------------------------------------------------------------------
void WriteError(std::ostream& out, const char* name, const PictureError& error)
{
  out << ", \"" << name << "\": {\"max\": " << error.Largest << ", \"rms\": " << error.Rms
      << ", \"share_off_by_2\": " << error.OffShare << "}";
}

//------------------------------------------------------------------------------
void WriteIfMeasured(std::ostream& out, const char* name, double value)
{
  if (value > 0.0)
  {
    out << ", \"" << name << "\": " << value;
  }
}

//------------------------------------------------------------------------------
void WriteFigures(std::ostream& out, const Figures& f)
{
  out << "  {\"name\": " << Quoted(f.Name);
  if (!f.Survives)
  {
    out << ", \"fate\": " << Quoted(f.Fate) << "}";
    return;
  }
  out << ", \"cold_ms\": " << f.ColdMs << ", \"ms_per_frame\": " << f.SteadyMs
      << ", \"cpu_ms\": " << f.CpuMs;
  WriteIfMeasured(out, "set_up_ms", f.SetUpMs);
  WriteIfMeasured(out, "steps_per_second", f.StepsPerSecond);
  WriteIfMeasured(out, "bytes_per_cell", f.BytesPerCell);
  WriteIfMeasured(out, "table_bytes_per_step", f.TableBytesPerStep);
  WriteIfMeasured(out, "device_bytes", f.DeviceBytes);
  WriteIfMeasured(out, "host_bytes", f.HostBytes);
  if (IsOurs(f))
  {
    out << ", \"lost_rays\": " << f.LostRays;
  }
  out << ", \"view_ms\": [";
  for (std::size_t i = 0; i < f.ViewMs.size(); ++i)
  {
    out << (i ? ", " : "") << f.ViewMs[i];
  }
  out << "], \"frame_ms\": [";
  for (std::size_t i = 0; i < f.Frames.size(); ++i)
  {
    out << (i ? ", " : "") << f.Frames[i].WallMs;
  }
  out << "]";
  if (f.IsCompared)
  {
    WriteError(out, "error_8_bit", f.Bytes);
  }
  if (f.IsCompared && f.HasFloat)
  {
    WriteError(out, "error_float", f.Float);
  }
  out << "}";
}

} // anonymous namespace

//------------------------------------------------------------------------------
void PrintDescription(
  std::ostream& out, const VolumeOptions& options, const RunDescription& description)
{
  out << description.Mesh << ": " << description.Cells << " tetrahedra, " << options.Width << " x "
      << options.Height << ", " << options.Views << " views, " << options.Repetitions
      << " rounds each, " << options.Function << " function\n"
      << description.Device << "; " << vtkVersion::GetVTKSourceVersion() << "; "
      << vtkSMPTools::GetBackend() << ", " << vtkSMPTools::GetEstimatedNumberOfThreads()
      << " threads\n";
  if (description.EmptyMs > 0.0)
  {
    out << "A frame without the mesh: " << MakeNumber(description.EmptyMs, 2) << " ms\n";
  }
}

//------------------------------------------------------------------------------
void PrintTable(std::ostream& out, const std::vector<Figures>& all)
{
  PrintRow(out,
    { "mapper", "cold ms", "set-up ms", "ms/frame", "views", "CPU ms", "Msteps/s", "B/cell",
      "8 bit max", "RMS", ">2/255 %", "float max", "RMS" });
  for (const Figures& f : all)
  {
    PrintFigures(out, f);
  }
  for (const Figures& mine : all)
  {
    for (const Figures& other : all)
    {
      if (IsOurs(mine) && !IsOurs(other) && mine.Survives && other.Survives &&
        mine.Name.find("/0.99") == std::string::npos)
      {
        const Spread wall = RatioOf(other, mine);
        const Spread cpu = RatioOf(other, mine, true);
        out << mine.Name << " against " << other.Name << ": " << MakeNumber(wall.Median, 2)
            << " x the frame rate (quartiles " << MakeNumber(wall.Low, 2) << ", "
            << MakeNumber(wall.High, 2) << "), " << MakeNumber(cpu.Median, 2)
            << " x less CPU time\n";
      }
    }
  }
  out << "Times: medians over views; ratios: medians over frames drawn next to each other. Errors: "
         "against the double\nreference, largest of three channels; RMS and share over the pixels "
         "that the mesh covers. VTK's ray cast mapper\nsamples at pixel corners: half a pixel of "
         "its error is displacement. Rounding to 8 bits alone gives an RMS of\nabout 0.0015.\n";
}

//------------------------------------------------------------------------------
bool WriteJson(
  const VolumeOptions& options, const RunDescription& description, const std::vector<Figures>& all)
{
  std::ofstream out(options.Json);
  out << "{\"mesh\": " << Quoted(description.Mesh) << ", \"tetrahedra\": " << description.Cells
      << ", \"size\": " << options.Width << ", \"height\": " << options.Height
      << ", \"mode\": " << Quoted(NameOf(options.Mode)) << ", \"views\": " << options.Views
      << ", \"repetitions\": " << options.Repetitions
      << ", \"function\": " << Quoted(options.Function)
      << ", \"gl_renderer\": " << Quoted(description.Device)
      << ", \"vtk\": " << Quoted(vtkVersion::GetVTKVersion())
      << ", \"threads\": " << vtkSMPTools::GetEstimatedNumberOfThreads();
  WriteIfMeasured(out, "copy_bytes_per_second", description.CopyBandwidth);
  WriteIfMeasured(out, "empty_frame_ms", description.EmptyMs);
  out << ", \"mappers\": [";
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    out << (i ? ",\n" : "\n");
    WriteFigures(out, all[i]);
  }
  out << "\n]}\n";
  return out.good();
}

//------------------------------------------------------------------------------
bool WriteTimes(const std::string& file, const NamedTimes& times)
{
  std::ofstream out(file);
  const char* separator = "{";
  for (const auto& [name, time] : times)
  {
    out << separator << "\n  " << Quoted(name) << ": " << time;
    separator = ",";
  }
  out << "\n}\n";
  return out.good();
}

} // namespace meniscus::benchmark

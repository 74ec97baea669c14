// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeReport.h"

#include "VolumeComparison.h"
#include "VolumeMembranes.h"
#include "VolumeProbe.h"

#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>

namespace meniscus::benchmark
{

using test::FunctionKind;

namespace
{

using Mapper = vtkTetrahedraRayCastMapper;

struct NamedMesh
{
  std::string Name;
  test::Grid Mesh;
};

//------------------------------------------------------------------------------
std::string FormatNumber(double value, int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

//------------------------------------------------------------------------------
std::string FormatNumber(const Spread& spread, const char* unit)
{
  return FormatNumber(spread.Median, 3) + unit + " (" + FormatNumber(spread.Low, 3) + " - " +
    FormatNumber(spread.High, 3) + ")";
}

//------------------------------------------------------------------------------
class Report
{
public:
  Report(std::ostream& out, const VolumeOptions& options)
    : Out(out)
    , Options(options)
    , Peers(MakeContestants(options))
  {
    if (!options.Mesh.empty())
    {
      this->Meshes.push_back({ options.Mesh, MakeVolumeMesh(options) });
    }
    for (const char* name : { "blunt_fin", "combustor" })
    {
      const test::Grid mesh = options.Mesh.empty() ? test::ReadDataMesh(name) : nullptr;
      if (mesh)
      {
        this->Meshes.push_back({ name, mesh });
      }
    }
    if (this->Meshes.empty())
    {
      this->Meshes.push_back({ "generated block", MakeVolumeMesh(options) });
    }
  }

  void Print()
  {
    this->Out << "| row | mesh | goal | measured |\n|---|---|---|---|\n";
    this->PrintIf(
      "native", [this]() { this->BackendRow(Mapper::NATIVE, 512, ">= 15 (AVX-512), 11 (AVX2)"); });
    this->PrintIf("native-1024",
      [this]()
      { this->BackendRow(Mapper::NATIVE, 1024, ">= 6 (AVX-512), 5 (AVX2) against projected"); });
    this->PrintIf("opengl", [this]() { this->BackendRow(Mapper::OPENGL, 512, ">= 3.5"); });
    this->PrintIf("sparse", [this]() { this->SparseRow(); });
    this->PrintIf("opaque", [this]() { this->OpaqueRow(); });
    this->PrintIf("setup", [this]() { this->SetUpRow(); });
    this->PrintIf("edit", [this]() { this->EditRow(); });
    this->PrintIf("scalars", [this]() { this->ScalarsRow(); });
    this->PrintIf("memory", [this]() { this->MemoryRow(); });
    this->PrintIf("membrane", [this]() { this->MembraneRow(); });
    this->PrintIf("error", [this]() { this->ErrorRow(); });
    this->PrintIf("growth", [this]() { PrintGrowth(this->Out, this->Options); });
  }

private:
  void PrintIf(const char* row, const std::function<void()>& print)
  {
    if (this->Options.Row.empty() || this->Options.Row == row)
    {
      this->Row = row;
      print();
    }
  }

  void GetLine(const std::string& mesh, const std::string& goal, const std::string& measured)
  {
    this->Out << "| " << this->Row << " | " << mesh << " | " << goal << " | " << measured << " |"
              << std::endl;
  }

  // Alternating frames of contestants.
  std::vector<Figures> RunRace(
    const NamedMesh& mesh, int size, const std::vector<Contestant>& contestants) const
  {
    VolumeOptions options = this->Options;
    options.Width = size;
    options.Height = size;
    VolumeComparison comparison(options, mesh.Mesh);
    comparison.Enter(contestants);
    comparison.MeasureTimes();
    return comparison.GetFigures();
  }

  std::vector<Contestant> GetPeers() const
  {
    // Both peers with their defaults.
    return SelectContestants(this->Peers, { "projected", "raycast/pre-integration" });
  }

  // Both backends, exact, with a given function.
  std::vector<Contestant> BothBackends(FunctionKind kind) const
  {
    std::vector<Contestant> both{ MakeOurs(Mapper::OPENGL, "opengl"),
      MakeOurs(Mapper::NATIVE, "native") };
    for (Contestant& contestant : both)
    {
      contestant.Function = kind;
    }
    return both;
  }

  void BackendRow(int backend, int size, const std::string& goal)
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->GetPeers();
      contestants.push_back(MakeOurs(backend, "ours"));
      const auto all = this->RunRace(mesh, size, contestants);
      std::string measured;
      for (std::size_t i = 0; i + 1 < all.size(); ++i)
      {
        measured += all[i].Name + " " + FormatNumber(RatioOf(all[i], all.back()), " x") + ", ";
      }
      this->GetLine(mesh.Name, goal, measured + FormatNumber(all.back().SteadyMs, 3) + " ms/frame");
    }
  }

  void SparseRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->BothBackends(FunctionKind::Smooth);
      const auto sparse = this->BothBackends(FunctionKind::Sparse);
      contestants.insert(contestants.end(), sparse.begin(), sparse.end());
      VolumeComparison comparison(this->Options, mesh.Mesh);
      comparison.Enter(contestants);
      comparison.MeasureTimes();
      const double active = static_cast<double>(comparison.GetOurs(2)->GetNumberOfActiveCells()) /
        static_cast<double>(mesh.Mesh->GetNumberOfCells());
      const auto& all = comparison.GetFigures();
      this->GetLine(mesh.Name, ">= 5 times the dense function's frame rate",
        "opengl " + FormatNumber(RatioOf(all[0], all[2]), " x") + ", native " +
          FormatNumber(RatioOf(all[1], all[3]), " x") + ", " + FormatNumber(100.0 * active, 3) +
          " % of cells active");
    }
  }

  void OpaqueRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->BothBackends(FunctionKind::Opaque);
      for (int i = 0; i < 4; ++i)
      {
        Contestant other = contestants[i % 2];
        other.Make = [make = other.Make, opacity = i < 2 ? 1.0 : 0.99]()
        {
          const MapperPointer mapper = make();
          Mapper::SafeDownCast(mapper)->SetEarlyTerminationOpacity(opacity);
          return mapper;
        };
        contestants.push_back(other);
      }
      const auto all = this->RunRace(mesh, 512, contestants);
      this->GetLine(mesh.Name, ">= 1.8 times the frame rate without early termination",
        "opengl " + FormatNumber(RatioOf(all[2], all[0]), " x") + ", at 0.99 " +
          FormatNumber(RatioOf(all[2], all[4]), " x") + "; native " +
          FormatNumber(RatioOf(all[3], all[1]), " x") + ", at 0.99 " +
          FormatNumber(RatioOf(all[3], all[5]), " x"));
    }
  }

  // First frame of a new mesh per cell, for every mapper.
  void SetUpRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->GetPeers();
      const auto ours = this->BothBackends(FunctionKind::Smooth);
      contestants.insert(contestants.end(), ours.begin(), ours.end());
      VolumeComparison comparison(this->Options, mesh.Mesh);
      comparison.Enter(contestants);
      std::string measured;
      for (std::size_t i = 0; i < contestants.size(); ++i)
      {
        const double ms = SpreadOf(comparison.MeasureSetUp(i, 5).ChangedMs).Median;
        measured += (i ? ", " : "") + contestants[i].Name + " " +
          FormatNumber(1e3 * ms / static_cast<double>(mesh.Mesh->GetNumberOfCells()), 3);
      }
      this->GetLine(
        mesh.Name, "<= 0.4 us per cell to the first frame, less than peers", measured + " us");
    }
  }

  using Measure = std::function<std::string(VolumeComparison&, std::size_t)>;

  // A measurement of each backend alone.
  void ChangeRow(const std::string& goal, const Measure& measure)
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      VolumeComparison comparison(this->Options, mesh.Mesh);
      comparison.Enter(this->BothBackends(FunctionKind::Smooth));
      this->GetLine(
        mesh.Name, goal, "opengl " + measure(comparison, 0) + ", native " + measure(comparison, 1));
    }
  }

  void EditRow()
  {
    this->ChangeRow("<= 1.1 times a frame, and 60 ns per cell where the active set changes",
      [](VolumeComparison& comparison, std::size_t i)
      {
        const auto change = comparison.MeasureEdit(i, 16);
        std::vector<double> ratios;
        for (std::size_t k = 0; k < change.SteadyMs.size(); ++k)
        {
          ratios.push_back(change.ChangedMs[k] / change.SteadyMs[k]);
        }
        return FormatNumber(SpreadOf(ratios), " x");
      });
  }

  void ScalarsRow()
  {
    this->ChangeRow("<= 20 % of a full set-up, both less the frame itself",
      [](VolumeComparison& comparison, std::size_t i)
      {
        const auto extra = [](const VolumeComparison::Change& change)
        {
          std::vector<double> differences;
          for (std::size_t k = 0; k < change.SteadyMs.size(); ++k)
          {
            differences.push_back(change.ChangedMs[k] - change.SteadyMs[k]);
          }
          return SpreadOf(differences).Median;
        };
        const double scalars = extra(comparison.MeasureScalars(i, 8));
        const double all = extra(comparison.MeasureSetUp(i, 5));
        return FormatNumber(100.0 * scalars / all, 3) + " % (" + FormatNumber(scalars, 3) + " of " +
          FormatNumber(all, 3) + " ms)";
      });
  }

  // Each in a separate process. With a software rasteriser, resident memory contains both copies of
  // the tables.
  void MemoryRow()
  {
    VolumeOptions options = this->Options;
    options.Views = 1;
    for (const char* name :
      { "meniscus/opengl/exact", "meniscus/native/exact", "projected", "raycast/pre-integration" })
    {
      const ProbeResult probe = ProbeContestant(name, options);
      const test::Grid mesh = MakeVolumeMesh(options);
      const double points = static_cast<double>(mesh->GetNumberOfPoints()) /
        static_cast<double>(mesh->GetNumberOfCells());
      this->GetLine(options.Mesh.empty() ? "generated block" : options.Mesh,
        "<= " + FormatNumber(36.0 + 16.0 * points, 3) + " B/cell (36 and 16 per point)",
        std::string(name) + ": " +
          (probe.Survives ? FormatNumber(probe.BytesPerCell, 3) + " B/cell resident" : probe.Fate));
    }
  }

  void MembraneRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      for (const int backend : { Mapper::NATIVE, Mapper::OPENGL })
      {
        for (const MembraneCost& cost : MeasureMembranes(this->Options, mesh.Mesh, backend))
        {
          this->GetLine(
            mesh.Name + (backend == Mapper::NATIVE ? ", native, " : ", opengl, ") + cost.Name,
            "<= 1.5 times the frame without the membrane",
            "camera moves " + FormatNumber(cost.Moving, " x") + ", rests " +
              FormatNumber(cost.Resting, " x"));
        }
      }
    }
  }

  void ErrorRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      for (const char* function : { "smooth", "peaked", "sharp", "opaque", "sparse" })
      {
        VolumeOptions options = this->Options;
        options.Function = function;
        FunctionKind kind = FunctionKind::Smooth;
        FindFunctionKind(function, kind);
        VolumeComparison comparison(options, mesh.Mesh);
        comparison.Enter(this->BothBackends(kind));
        comparison.MeasureErrors();
        std::string measured;
        for (const Figures& f : comparison.GetFigures())
        {
          measured += (measured.empty() ? "" : ", ") + f.Name + " " +
            FormatNumber(f.Float.Largest, 2) + ", " + FormatNumber(f.Float.Rms, 2);
        }
        this->GetLine(mesh.Name + ", " + function, "max 2e-5, RMS 4e-6 in float", measured);
      }
    }
  }

  std::ostream& Out;
  VolumeOptions Options;
  std::vector<Contestant> Peers;
  std::vector<NamedMesh> Meshes;
  std::string Row;
};

} // anonymous namespace

//------------------------------------------------------------------------------
void PrintReport(std::ostream& out, const VolumeOptions& options)
{
  Report(out, options).Print();
}

//------------------------------------------------------------------------------
void PrintGrowth(std::ostream& out, const VolumeOptions& options)
{
  VolumeOptions growing = options;
  growing.Views = std::min(options.Views, 4);
  std::vector<Contestant> contestants = SelectContestants(MakeContestants(options),
    options.Mappers.empty()
      ? std::vector<std::string>{ "opengl/exact", "native/exact", "projected" }
      : options.Mappers);
  contestants.erase(
    std::remove_if(contestants.begin(), contestants.end(),
      [](const Contestant& c) { return c.Name.find("/0.99") != std::string::npos; }),
    contestants.end());
  out << "| tetrahedra |";
  for (const Contestant& contestant : contestants)
  {
    out << ' ' << contestant.Name << ", ms/frame |";
  }
  out << "\n|---|" << std::string(4 * contestants.size(), '-') << "|\n";
  // 6 n^3 cells: 10k, 33k, 98k, 197k, 511k, 998k, 2.96M, 4.98M.
  std::vector<std::pair<double, double>> first(contestants.size());
  std::vector<double> exponents(contestants.size(), 0.0);
  for (const int n : { 12, 18, 25, 32, 44, 55, 79, 94 })
  {
    const test::Grid mesh = test::MakeBlock(n, test::WavyField(3.0));
    const auto cells = static_cast<double>(mesh->GetNumberOfCells());
    if (cells > 1e3 * options.GrowthLimit)
    {
      break;
    }
    VolumeComparison comparison(growing, mesh);
    comparison.Enter(contestants);
    comparison.MeasureTimes();
    out << "| " << mesh->GetNumberOfCells() << " |";
    for (std::size_t i = 0; i < contestants.size(); ++i)
    {
      const double ms = comparison.GetFigures()[i].SteadyMs;
      out << ' ' << FormatNumber(ms, 4) << " |";
      if (n == 32)
      {
        first[i] = { cells, ms };
      }
      if (n > 32 && n <= 79)
      {
        exponents[i] = std::log(ms / first[i].second) / std::log(cells / first[i].first);
      }
    }
    out << std::endl;
  }
  out << "| exponent from 200k up to 3M |";
  for (const double exponent : exponents)
  {
    out << ' ' << FormatNumber(exponent, 2) << " |";
  }
  out << " (goal: below 0.5)\n";
}

} // namespace meniscus::benchmark

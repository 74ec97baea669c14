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

namespace meniscus
{
namespace benchmark
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
std::string format(double value, int digits)
{
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

//------------------------------------------------------------------------------
std::string format(const Spread& spread, const char* unit)
{
  return format(spread.Median, 3) + unit + " (" + format(spread.Low, 3) + " - " +
    format(spread.High, 3) + ")";
}

//------------------------------------------------------------------------------
class Report
{
public:
  Report(std::ostream& out, const VolumeOptions& options)
    : Out(out)
    , Options(options)
    , Peers(makeContestants(options))
  {
    if (!options.Mesh.empty())
    {
      this->Meshes.push_back({ options.Mesh, makeVolumeMesh(options) });
    }
    for (const char* name : { "blunt_fin", "combustor" })
    {
      const test::Grid mesh = options.Mesh.empty() ? test::readDataMesh(name) : nullptr;
      if (mesh)
      {
        this->Meshes.push_back({ name, mesh });
      }
    }
    if (this->Meshes.empty())
    {
      this->Meshes.push_back({ "generated block", makeVolumeMesh(options) });
    }
  }

  void print()
  {
    this->Out << "| row | mesh | goal | measured |\n|---|---|---|---|\n";
    this->printIf(
      "native", [this]() { this->backendRow(Mapper::NATIVE, 512, ">= 15 (AVX-512), 11 (AVX2)"); });
    this->printIf("native-1024",
      [this]()
      { this->backendRow(Mapper::NATIVE, 1024, ">= 6 (AVX-512), 5 (AVX2) against projected"); });
    this->printIf("opengl", [this]() { this->backendRow(Mapper::OPENGL, 512, ">= 3.5"); });
    this->printIf("sparse", [this]() { this->sparseRow(); });
    this->printIf("opaque", [this]() { this->opaqueRow(); });
    this->printIf("setup", [this]() { this->setUpRow(); });
    this->printIf("edit", [this]() { this->editRow(); });
    this->printIf("scalars", [this]() { this->scalarsRow(); });
    this->printIf("memory", [this]() { this->memoryRow(); });
    this->printIf("membrane", [this]() { this->membraneRow(); });
    this->printIf("error", [this]() { this->errorRow(); });
    this->printIf("growth", [this]() { printGrowth(this->Out, this->Options); });
  }

private:
  void printIf(const char* row, const std::function<void()>& print)
  {
    if (this->Options.Row.empty() || this->Options.Row == row)
    {
      this->Row = row;
      print();
    }
  }

  void line(const std::string& mesh, const std::string& goal, const std::string& measured)
  {
    this->Out << "| " << this->Row << " | " << mesh << " | " << goal << " | " << measured << " |"
              << std::endl;
  }

  // Alternating frames of contestants.
  std::vector<Figures> race(
    const NamedMesh& mesh, int size, const std::vector<Contestant>& contestants) const
  {
    VolumeOptions options = this->Options;
    options.Size = size;
    VolumeComparison comparison(options, mesh.Mesh);
    comparison.enter(contestants);
    comparison.measureTimes();
    return comparison.figures();
  }

  std::vector<Contestant> peers() const
  {
    // Both peers with their defaults.
    return selectContestants(this->Peers, { "projected", "raycast/pre-integration" });
  }

  // Both backends, exact, with a given function.
  std::vector<Contestant> bothBackends(FunctionKind kind) const
  {
    std::vector<Contestant> both{ makeOurs(Mapper::OPENGL, "opengl"),
      makeOurs(Mapper::NATIVE, "native") };
    for (Contestant& contestant : both)
    {
      contestant.Function = kind;
    }
    return both;
  }

  void backendRow(int backend, int size, const std::string& goal)
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->peers();
      contestants.push_back(makeOurs(backend, "ours"));
      const auto all = this->race(mesh, size, contestants);
      std::string measured;
      for (std::size_t i = 0; i + 1 < all.size(); ++i)
      {
        measured += all[i].Name + " " + format(ratioOf(all[i], all.back()), " x") + ", ";
      }
      this->line(mesh.Name, goal, measured + format(all.back().SteadyMs, 3) + " ms/frame");
    }
  }

  void sparseRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->bothBackends(FunctionKind::Smooth);
      const auto sparse = this->bothBackends(FunctionKind::Sparse);
      contestants.insert(contestants.end(), sparse.begin(), sparse.end());
      VolumeComparison comparison(this->Options, mesh.Mesh);
      comparison.enter(contestants);
      comparison.measureTimes();
      const double active = static_cast<double>(comparison.ours(2)->GetNumberOfActiveCells()) /
        static_cast<double>(mesh.Mesh->GetNumberOfCells());
      const auto& all = comparison.figures();
      this->line(mesh.Name, ">= 5 times the dense function's frame rate",
        "opengl " + format(ratioOf(all[0], all[2]), " x") + ", native " +
          format(ratioOf(all[1], all[3]), " x") + ", " + format(100.0 * active, 3) +
          " % of cells active");
    }
  }

  void opaqueRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->bothBackends(FunctionKind::Opaque);
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
      const auto all = this->race(mesh, 512, contestants);
      this->line(mesh.Name, ">= 1.8 times the frame rate without early termination",
        "opengl " + format(ratioOf(all[2], all[0]), " x") + ", at 0.99 " +
          format(ratioOf(all[2], all[4]), " x") + "; native " +
          format(ratioOf(all[3], all[1]), " x") + ", at 0.99 " +
          format(ratioOf(all[3], all[5]), " x"));
    }
  }

  // First frame of a new mesh per cell, for every mapper.
  void setUpRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      std::vector<Contestant> contestants = this->peers();
      const auto ours = this->bothBackends(FunctionKind::Smooth);
      contestants.insert(contestants.end(), ours.begin(), ours.end());
      VolumeComparison comparison(this->Options, mesh.Mesh);
      comparison.enter(contestants);
      std::string measured;
      for (std::size_t i = 0; i < contestants.size(); ++i)
      {
        const double ms = spreadOf(comparison.measureSetUp(i, 5).ChangedMs).Median;
        measured += (i ? ", " : "") + contestants[i].Name + " " +
          format(1e3 * ms / static_cast<double>(mesh.Mesh->GetNumberOfCells()), 3);
      }
      this->line(
        mesh.Name, "<= 0.4 us per cell to the first frame, less than peers", measured + " us");
    }
  }

  using Measure = std::function<std::string(VolumeComparison&, std::size_t)>;

  // A measurement of each backend alone.
  void changeRow(const std::string& goal, const Measure& measure)
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      VolumeComparison comparison(this->Options, mesh.Mesh);
      comparison.enter(this->bothBackends(FunctionKind::Smooth));
      this->line(
        mesh.Name, goal, "opengl " + measure(comparison, 0) + ", native " + measure(comparison, 1));
    }
  }

  void editRow()
  {
    this->changeRow("<= 1.1 times a frame, and 60 ns per cell where the active set changes",
      [](VolumeComparison& comparison, std::size_t i)
      {
        const auto change = comparison.measureEdit(i, 16);
        std::vector<double> ratios;
        for (std::size_t k = 0; k < change.SteadyMs.size(); ++k)
        {
          ratios.push_back(change.ChangedMs[k] / change.SteadyMs[k]);
        }
        return format(spreadOf(ratios), " x");
      });
  }

  void scalarsRow()
  {
    this->changeRow("<= 20 % of a full set-up, both less the frame itself",
      [](VolumeComparison& comparison, std::size_t i)
      {
        const auto extra = [](const VolumeComparison::Change& change)
        {
          std::vector<double> differences;
          for (std::size_t k = 0; k < change.SteadyMs.size(); ++k)
          {
            differences.push_back(change.ChangedMs[k] - change.SteadyMs[k]);
          }
          return spreadOf(differences).Median;
        };
        const double scalars = extra(comparison.measureScalars(i, 8));
        const double all = extra(comparison.measureSetUp(i, 5));
        return format(100.0 * scalars / all, 3) + " % (" + format(scalars, 3) + " of " +
          format(all, 3) + " ms)";
      });
  }

  // Each in a separate process. With a software rasteriser, resident memory contains both copies of
  // the tables.
  void memoryRow()
  {
    VolumeOptions options = this->Options;
    options.Views = 1;
    for (const char* name :
      { "meniscus/opengl/exact", "meniscus/native/exact", "projected", "raycast/pre-integration" })
    {
      const ProbeResult probe = probeContestant(name, options);
      const test::Grid mesh = makeVolumeMesh(options);
      const double points = static_cast<double>(mesh->GetNumberOfPoints()) /
        static_cast<double>(mesh->GetNumberOfCells());
      this->line(options.Mesh.empty() ? "generated block" : options.Mesh,
        "<= " + format(36.0 + 16.0 * points, 3) + " B/cell (36 and 16 per point)",
        std::string(name) + ": " +
          (probe.Survives ? format(probe.BytesPerCell, 3) + " B/cell resident" : probe.Fate));
    }
  }

  void membraneRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      for (const int backend : { Mapper::NATIVE, Mapper::OPENGL })
      {
        for (const MembraneCost& cost : measureMembranes(this->Options, mesh.Mesh, backend))
        {
          this->line(
            mesh.Name + (backend == Mapper::NATIVE ? ", native, " : ", opengl, ") + cost.Name,
            "<= 1.5 times the frame without the membrane",
            "camera moves " + format(cost.Moving, " x") + ", rests " + format(cost.Resting, " x"));
        }
      }
    }
  }

  void errorRow()
  {
    for (const NamedMesh& mesh : this->Meshes)
    {
      for (const char* function : { "smooth", "peaked", "sharp", "opaque", "sparse" })
      {
        VolumeOptions options = this->Options;
        options.Function = function;
        FunctionKind kind = FunctionKind::Smooth;
        findFunctionKind(function, kind);
        VolumeComparison comparison(options, mesh.Mesh);
        comparison.enter(this->bothBackends(kind));
        comparison.measureErrors();
        std::string measured;
        for (const Figures& f : comparison.figures())
        {
          measured += (measured.empty() ? "" : ", ") + f.Name + " " + format(f.Float.Largest, 2) +
            ", " + format(f.Float.Rms, 2);
        }
        this->line(mesh.Name + ", " + function, "max 2e-5, RMS 4e-6 in float", measured);
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
void printReport(std::ostream& out, const VolumeOptions& options)
{
  Report(out, options).print();
}

//------------------------------------------------------------------------------
void printGrowth(std::ostream& out, const VolumeOptions& options)
{
  VolumeOptions growing = options;
  growing.Views = std::min(options.Views, 4);
  std::vector<Contestant> contestants = selectContestants(makeContestants(options),
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
    const test::Grid mesh = test::makeBlock(n, test::wavyField(3.0));
    const auto cells = static_cast<double>(mesh->GetNumberOfCells());
    if (cells > 1e3 * options.GrowthLimit)
    {
      break;
    }
    VolumeComparison comparison(growing, mesh);
    comparison.enter(contestants);
    comparison.measureTimes();
    out << "| " << mesh->GetNumberOfCells() << " |";
    for (std::size_t i = 0; i < contestants.size(); ++i)
    {
      const double ms = comparison.figures()[i].SteadyMs;
      out << ' ' << format(ms, 4) << " |";
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
    out << ' ' << format(exponent, 2) << " |";
  }
  out << " (goal: below 0.5)\n";
}

} // namespace benchmark
} // namespace meniscus

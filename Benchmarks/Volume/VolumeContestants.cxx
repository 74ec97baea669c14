// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeContestants.h"

#ifdef MENISCUS_HAS_OPENVKL
#include "OpenVklMapper.h"
#endif
#include "ResampledMapper.h"
#include "TestMeshes.h"
#include "VolumeScene.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkRenderWindow.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridHomogeneousRayIntegrator.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridPartialPreIntegration.h>
#include <vtkUnstructuredGridPreIntegration.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkUnstructuredGridVolumeZSweepMapper.h>

namespace meniscus::benchmark
{

namespace
{

template <typename Integrator>
Contestant MakeRayCast(const std::string& name, int threads)
{
  return { "raycast/" + name,
    [threads]()
    {
      // One ray per pixel, as for our mapper.
      auto mapper = vtkSmartPointer<vtkUnstructuredGridVolumeRayCastMapper>::New();
      mapper->SetImageSampleDistance(1.0);
      mapper->AutoAdjustSampleDistancesOff();
      if (threads > 0)
      {
        mapper->SetNumberOfThreads(threads);
      }
      vtkNew<Integrator> integrator;
      mapper->SetRayIntegrator(integrator);
      return MapperPointer(mapper);
    },
    false };
}

Contestant MakeZSweep()
{
  return { "zsweep",
    []()
    {
      auto mapper = vtkSmartPointer<vtkUnstructuredGridVolumeZSweepMapper>::New();
      mapper->SetImageSampleDistance(1.0);
      mapper->AutoAdjustSampleDistancesOff();
      return MapperPointer(mapper);
    },
    false, test::FunctionKind::Smooth, false };
}

#ifdef MENISCUS_HAS_OPENVKL
// Samples of Open VKL per nominal length of an interval; OSPRay takes 1 by default.
const struct
{
  const char* Name;
  double Rate;
} SamplingRates[] = { { "1:16", 1.0 / 16.0 }, { "1:4", 0.25 }, { "1", 1.0 }, { "4", 4.0 } };
#endif

void AddOpenVkl([[maybe_unused]] int threads, [[maybe_unused]] std::vector<Contestant>& peers)
{
#ifdef MENISCUS_HAS_OPENVKL
  for (const auto& sampling : SamplingRates)
  {
    const double rate = sampling.Rate;
    if (MakeOpenVklMapper(rate, threads))
    {
      peers.push_back({ std::string("openvkl/") + sampling.Name,
        [rate, threads]() { return MakeOpenVklMapper(rate, threads); }, false });
    }
  }
#endif
}

// Points along the longest side of images that the mesh is resampled to.
constexpr int ImageSizes[] = { 64, 128, 256 };

std::vector<Contestant> MakePeers(const VolumeOptions& options)
{
  std::vector<Contestant> peers{ { "projected",
    []() { return MapperPointer(vtkSmartPointer<vtkProjectedTetrahedraMapper>::New()); }, false } };
  const int threads = options.Threads;
  // The first one is the mapper's default for point data.
  peers.push_back(MakeRayCast<vtkUnstructuredGridPreIntegration>("pre-integration", threads));
  peers.push_back(MakeRayCast<vtkUnstructuredGridPartialPreIntegration>("partial", threads));
  peers.push_back(MakeRayCast<vtkUnstructuredGridLinearRayIntegrator>("linear", threads));
  peers.push_back(MakeRayCast<vtkUnstructuredGridHomogeneousRayIntegrator>("homogeneous", threads));
  for (const int size : ImageSizes)
  {
    peers.push_back({ "resampled/" + std::to_string(size),
      [size]() { return MakeResampledMapper(size); }, false });
  }
  AddOpenVkl(threads, peers);
  if (options.ZSweep)
  {
    peers.push_back(MakeZSweep());
  }
  return peers;
}

struct OurSettings
{
  int Backend;
  int Integration;
  double TerminationOpacity; // negative: the default
  int TableScalars = 0;      // of a pre-integration table; 0: the default
  int TableLengths = 0;
};

// Sizes besides the default: coarse, without self-absorption (two dimensions), fine.
constexpr int TableSizes[][2] = { { 64, 16 }, { 256, 1 }, { 512, 64 } };

MapperPointer MakeOurMapper(const OurSettings& settings)
{
  auto mapper = vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
  mapper->SetBackend(settings.Backend);
  mapper->SetIntegration(settings.Integration);
  if (settings.TableScalars > 0)
  {
    mapper->SetPreIntegrationScalarSize(settings.TableScalars);
    mapper->SetPreIntegrationLengthSize(settings.TableLengths);
  }
  if (settings.TerminationOpacity >= 0.0)
  {
    mapper->SetEarlyTerminationOpacity(settings.TerminationOpacity);
  }
  return mapper;
}

// True if a small image can be drawn with these settings, without a message.
bool IsAvailable(const OurSettings& settings)
{
  const test::Grid grid = test::MakeCubeOfFive(test::RadialField());
  const MapperPointer mapper = MakeOurMapper(settings);
  bool complained = false;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&complained);
  listener->SetCallback(
    [](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  mapper->AddObserver(vtkCommand::WarningEvent, listener);
  mapper->AddObserver(vtkCommand::ErrorEvent, listener);
  mapper->SetInputDataObject(grid);
  test::VolumeScene scene(32, 32);
  scene.SetMapper(mapper);
  const double range[2] = { 0.0, 2.0 };
  scene.SetProperty(test::MakeProperty(test::FunctionKind::Smooth, range, 2.0));
  test::LookAt(scene.GetRenderer(), grid->GetBounds(), 20.0, 30.0);
  scene.GetWindow()->Render();
  auto* ours = vtkTetrahedraRayCastMapper::SafeDownCast(mapper);
  return !complained && ours->GetActiveBackend() == settings.Backend;
}

std::string BackendName(int backend)
{
  return backend == vtkTetrahedraRayCastMapper::OPENGL ? "opengl"
    : backend == vtkTetrahedraRayCastMapper::NATIVE    ? "native"
    : backend == vtkTetrahedraRayCastMapper::COMPUTE   ? "compute"
                                                       : "backend-" + std::to_string(backend);
}

} // anonymous namespace

//------------------------------------------------------------------------------
Contestant MakeOurs(int backend, const std::string& name)
{
  return { name,
    [backend]() {
      return MakeOurMapper({ backend, vtkTetrahedraRayCastMapper::EXACT, -1.0 });
    },
    true };
}

//------------------------------------------------------------------------------
std::vector<Contestant> MakeContestants(const VolumeOptions& options)
{
  std::vector<Contestant> all =
    options.Mode == VolumeMode::Composite ? MakePeers(options) : std::vector<Contestant>();
  using Mapper = vtkTetrahedraRayCastMapper;
  for (const int backend : { Mapper::OPENGL, Mapper::NATIVE, Mapper::COMPUTE })
  {
    for (const int integration : { Mapper::EXACT, Mapper::PRE_INTEGRATED })
    {
      const OurSettings settings{ backend, integration, -1.0 };
      if (!IsAvailable(settings))
      {
        continue;
      }
      const std::string integrationName = integration == Mapper::EXACT ? "exact" : "pre-integrated";
      const std::string name = "meniscus/" + BackendName(backend) + "/" + integrationName;
      all.push_back({ name, [settings]() { return MakeOurMapper(settings); }, true });
      const OurSettings early{ backend, integration, 0.99 };
      all.push_back({ name + "/0.99", [early]() { return MakeOurMapper(early); }, true });
      for (const auto& size : TableSizes)
      {
        if (integration == vtkTetrahedraRayCastMapper::PRE_INTEGRATED)
        {
          const OurSettings sized{ backend, integration, -1.0, size[0], size[1] };
          all.push_back({ name + "/" + std::to_string(size[0]) + "x" + std::to_string(size[1]),
            [sized]() { return MakeOurMapper(sized); }, true });
        }
      }
    }
  }
  test::FunctionKind kind = test::FunctionKind::Smooth;
  FindFunctionKind(options.Function, kind);
  for (Contestant& contestant : all)
  {
    contestant.Function = kind;
  }
  return all;
}

//------------------------------------------------------------------------------
bool IsSelected(const std::string& name, const std::string& word)
{
  if (word.empty() || word.back() != '$')
  {
    return name.find(word) != std::string::npos;
  }
  const std::string end = word.substr(0, word.size() - 1);
  return name.size() >= end.size() &&
    name.compare(name.size() - end.size(), std::string::npos, end) == 0;
}

//------------------------------------------------------------------------------
std::vector<Contestant> SelectContestants(
  const std::vector<Contestant>& all, const std::vector<std::string>& words)
{
  std::vector<Contestant> selected;
  for (const Contestant& contestant : all)
  {
    bool wanted = words.empty();
    for (const std::string& word : words)
    {
      wanted = wanted || IsSelected(contestant.Name, word);
    }
    if (wanted)
    {
      selected.push_back(contestant);
    }
  }
  return selected;
}

} // namespace meniscus::benchmark

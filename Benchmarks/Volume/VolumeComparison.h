// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Several mappers on one mesh. Every mapper has its own window; in each round of a view every
 * mapper draws one frame, so that other load of the machine affects all of them alike. Ratios of
 * frames of one round are therefore more reliable than the times.
 */
#pragma once

#include "ReferenceImage.h"
#include "VolumeContestants.h"
#include "VolumeScene.h"

#include <vtkVolumeProperty.h>

#include <memory>
#include <string>
#include <vector>

class vtkTetrahedraRayCastMapper;

namespace meniscus::benchmark
{

struct FrameTime
{
  double WallMs = 0.0;
  double CpuMs = 0.0; // user and system, all threads of the process
};

/** |image - reference|, the largest of three channels. */
struct PictureError
{
  double Largest = 0.0;
  double Rms = 0.0;      // over the pixels that the reference covers
  double OffShare = 0.0; // fraction of these with an error of more than 2/255
};

struct Figures
{
  std::string Name;
  bool Survives = true;
  std::string Fate;              // reason why it did not finish
  double BytesPerCell = 0.0;     // resident memory for the mesh, including the graphics memory of a
                                 // software rasteriser
  double ColdMs = 0.0;           // first frame in a new window, including compilation of shaders
  double SetUpMs = 0.0;          // first frame of a new mesh, with everything else ready
  std::vector<FrameTime> Frames; // by view, then round
  std::vector<double> ViewMs;    // medians of rounds
  double SteadyMs = 0.0;         // median of views
  double CpuMs = 0.0;
  double StepsPerSecond = 0.0;    // 0: unknown
  double TableBytesPerStep = 0.0; // record of a cell and a vertex; 0: no tables on the device
  double DeviceBytes = 0.0;       // tables on the graphics device
  double HostBytes = 0.0;         // and in main memory; 0: unknown
  double LostRays = 0.0;          // over all views, our mapper only
  bool IsCompared = false;        // true if the errors were measured
  PictureError Bytes;
  PictureError Float;
  bool HasFloat = false;
};

/** Middle value, and first and third quartile. */
struct Spread
{
  double Median = 0.0;
  double Low = 0.0;
  double High = 0.0;
};

Spread SpreadOf(std::vector<double> values);

/** Processor time of all threads of the process so far. */
double CpuMilliseconds();

/** Ratio of the times of a frame of `slow` and the frame of `fast` in the same round. */
Spread RatioOf(const Figures& slow, const Figures& fast, bool cpu = false);

class VolumeComparison
{
public:
  VolumeComparison(const VolumeOptions& options, vtkUnstructuredGrid* grid);
  ~VolumeComparison();

  /** Opens a window for each contestant and draws the first frames. */
  void Enter(const std::vector<Contestant>& contestants);

  /** Measures steady frames and set-up of all contestants. */
  void MeasureTimes();
  /** Errors against the reference of the run's function. */
  void MeasureErrors();

  const std::vector<Figures>& GetFigures() const { return this->Results; }
  std::string GetDevice() const { return this->Device; }
  /** Bytes per second of copies on the device; 0 if not measured. */
  double GetCopyBandwidth() const { return this->CopyBandwidth; }
  /** Milliseconds of a frame without the mesh: what VTK and the window take of all frames. */
  double GetEmptyMs() const { return this->EmptyMs; }

  /** Writes the first view of every contestant as START-NAME.png; returns false if that fails. */
  bool WritePictures(const std::string& start);

  /** Frames after a change, each next to a steady frame of the same view. */
  struct Change
  {
    std::vector<double> ChangedMs;
    std::vector<double> SteadyMs;
  };
  /** One opacity node moved. */
  Change MeasureEdit(std::size_t contestant, int times);
  /** A new scalar array on the same points and cells. */
  Change MeasureScalars(std::size_t contestant, int times);
  /** A new mesh: other point and cell objects with the same contents. */
  Change MeasureSetUp(std::size_t contestant, int times);

  /**
   * Frames from above, by contestant: with the camera moved by a fifth of a degree, and not moved.
   */
  struct Moves
  {
    std::vector<Figures> Moving;
    std::vector<Figures> Resting;
  };
  Moves MeasureMoves();

  vtkTetrahedraRayCastMapper* GetOurs(std::size_t contestant) const;

private:
  struct Arena
  {
    Contestant Player;
    MapperPointer Mapper;
    std::unique_ptr<test::VolumeScene> Scene;
    /** Side to which the camera was turned last. */
    bool Turned = false;
  };

  void AddCounters(std::size_t contestant, double& steps);
  /** A new property each time, since some measurements change it. */
  vtkSmartPointer<vtkVolumeProperty> PropertyOf(test::FunctionKind kind) const;
  void LookFrom(test::VolumeScene& scene, int view) const;
  void TimeRound(int view);
  FrameTime TimeFrame(Arena& arena) const;
  FrameTime TimeSteady(Arena& arena, int view) const;
  void FindError(Arena& arena, const std::vector<test::ReferenceImage>& truth, Figures& figures);
  Change MeasureChange(
    std::size_t contestant, int times, const std::function<void(Arena&, int)>& change);

  VolumeOptions Settings;
  vtkUnstructuredGrid* Grid;
  std::vector<Arena> Arenas;
  std::vector<Figures> Results;
  std::string Device;
  double CopyBandwidth = 0.0;
  double EmptyMs = 0.0;
};

} // namespace meniscus::benchmark

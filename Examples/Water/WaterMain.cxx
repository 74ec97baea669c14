// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Moving water above a well, in a window or as a series of images.
#include "WaterWindow.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace
{

const char* const Help = R"(usage: meniscus_water [options]

  --frames N     write N pictures instead of opening a window
  --output DIR   where to, an existing folder (default: the current one)
  --size N       pixels a side, 64 to 4096 (default 512)
  --rays         with the ray-traced twin beside it
  --thesis       the thesis's flat facets
  --help         this text

In the window: the mouse moves the eye; space stops and starts the waves; i and I change the index
of refraction, h and H the height of the waves, a and A the attenuation; m switches between curved
patches and flat facets, o switches refraction off and on, r shows traced rays beside it; q quits.
)";

struct Options
{
  int Frames = 0;
  int Size = 512;
  std::string Output = ".";
  WaterSettings Settings;
  bool IsGood = true;
  bool WantsHelp = false;
};

Options ReadOptions(int argc, char* argv[])
{
  Options options;
  for (int i = 1; i < argc && options.IsGood; ++i)
  {
    const std::string name = argv[i];
    const auto number = [&](int low, int high)
    {
      char* end = nullptr;
      const long value = i + 1 < argc ? std::strtol(argv[++i], &end, 10) : -1;
      options.IsGood = end && *end == '\0' && value >= low && value <= high;
      return static_cast<int>(value);
    };
    if (name == "--frames")
    {
      options.Frames = number(1, 100000);
    }
    else if (name == "--size")
    {
      options.Size = number(64, 4096);
    }
    else if (name == "--output" && i + 1 < argc)
    {
      options.Output = argv[++i];
    }
    else if (name == "--rays")
    {
      options.Settings.ShowsRays = true;
    }
    else if (name == "--thesis")
    {
      options.Settings.Curved = false;
    }
    else
    {
      options.WantsHelp = name == "--help";
      options.IsGood = options.WantsHelp;
    }
  }
  return options;
}

int WriteFrames(WaterWindow& water, const Options& options)
{
  WaterSettings settings = options.Settings;
  for (int i = 0; i < options.Frames; ++i)
  {
    settings.Time = 0.08 * i;
    water.SetEyeAngle(1.5 * i);
    water.Show(settings);
    char name[32];
    std::snprintf(name, sizeof(name), "/water-%03d.png", i);
    if (!water.Write(options.Output + name))
    {
      std::fprintf(stderr, "error: %s%s cannot be written\n", options.Output.c_str(), name);
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}

/** Keyboard control and clock. */
struct Control
{
  WaterWindow& Water;
  WaterSettings Settings;
  bool Moves = true;

  void Press(char key)
  {
    const auto step = [](double& value, bool up, double by, double low, double high)
    { value = std::clamp(value + (up ? by : -by), low, high); };
    switch (key)
    {
      case 'i':
      case 'I':
        step(this->Settings.Index, key == 'i', 0.05, 1.0, 2.5);
        break;
      case 'h':
      case 'H':
        step(this->Settings.WaveHeight, key == 'h', 0.1, 0.0, 2.0);
        break;
      case 'a':
      case 'A':
        step(this->Settings.Attenuation, key == 'a', 0.05, 0.0, 3.0);
        break;
      case 'm':
        this->Settings.Curved = !this->Settings.Curved;
        break;
      case 'o':
        this->Settings.Refracts = !this->Settings.Refracts;
        break;
      case 'r':
        this->Settings.ShowsRays = !this->Settings.ShowsRays;
        break;
      case ' ':
        this->Moves = !this->Moves;
        break;
      default:
        return;
    }
    this->Water.Show(this->Settings);
  }

  void Tick()
  {
    if (this->Moves)
    {
      this->Settings.Time += 0.04;
      this->Water.Show(this->Settings);
    }
  }
};

void OnEvent(vtkObject* caller, unsigned long event, void* data, void*)
{
  auto* control = static_cast<Control*>(data);
  auto* interactor = static_cast<vtkRenderWindowInteractor*>(caller);
  event == vtkCommand::TimerEvent ? control->Tick() : control->Press(interactor->GetKeyCode());
}

int RunWindow(WaterWindow& water, const Options& options)
{
  constexpr int milliseconds = 40;
  Control control{ water, options.Settings };
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(water.GetWindow());
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(OnEvent);
  command->SetClientData(&control);
  water.Show(control.Settings);
  interactor->Initialize();
  // Called before the style's own key handling, which receives only q.
  interactor->AddObserver(vtkCommand::KeyPressEvent, command, 1.0F);
  interactor->AddObserver(vtkCommand::TimerEvent, command);
  interactor->CreateRepeatingTimer(milliseconds);
  interactor->Start();
  return EXIT_SUCCESS;
}

}

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const Options options = ReadOptions(argc, argv);
  if (options.WantsHelp || !options.IsGood)
  {
    std::fputs(Help, options.WantsHelp ? stdout : stderr);
    return options.WantsHelp ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (options.Frames > 0 && !std::getenv("DISPLAY"))
  {
    std::fputs("no display: run under xvfb-run\n", stderr);
    return EXIT_FAILURE;
  }
  WaterWindow water(options.Size);
  if (options.Frames > 0)
  {
    water.GetWindow()->SetOffScreenRendering(1);
    return WriteFrames(water, options);
  }
  return RunWindow(water, options);
}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes the complete source of every variant of the shaders to a folder, one file per source, for
// a validator. Needs no graphics device.
#include "Rendering/Backends/OpenGL/RayCastShader.h"
#include "Rendering/Pass/MembraneComposer.h"
#include "Rendering/Property/RayCastOptics.h"

#include "vtkTetrahedraComposeFS.h"
#include "vtkTetrahedraDepthFS.h"
#include "vtkTetrahedraEntryTilesCS.h"
#include "vtkTetrahedraEntryTilesFS.h"
#include "vtkTetrahedraPlaceFS.h"
#include "vtkTetrahedraRayCastCS.h"
#include "vtkTetrahedraRayCastFS.h"
#include "vtkTetrahedraSelectFS.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <string>
#include <vector>

using namespace meniscus;

namespace
{

void ReplaceAll(std::string& source, const std::string& from, const std::string& to)
{
  for (auto at = source.find(from); at != std::string::npos; at = source.find(from, at + to.size()))
  {
    source.replace(at, from.size(), to);
  }
}

/** The replacements that VTK's shader cache makes for OpenGL 3.2. */
std::string AsVtkCompilesIt(std::string source, const std::string& version)
{
  std::string outputs;
  for (int i = 0; i < 8; ++i)
  {
    const std::string number = std::to_string(i);
    const std::string name = "gl_FragData[" + number + "]";
    if (source.find(name) != std::string::npos)
    {
      ReplaceAll(source, name, "fragOutput" + number);
      outputs += "out vec4 fragOutput" + number + ";\n";
    }
  }
  ReplaceAll(source, "//VTK::System::Dec", "#version " + version + "\n");
  ReplaceAll(source, "//VTK::Output::Dec", outputs);
  return source;
}

/** A source as devices without GL_ARB_gpu_shader5 compile it. */
std::string WithoutGpuShader5(std::string source)
{
  ReplaceAll(source, "#extension GL_ARB_gpu_shader5 : enable", "");
  ReplaceAll(source, "#ifdef GL_ARB_gpu_shader5", "#if 0");
  return source;
}

class ShaderFolder
{
public:
  explicit ShaderFolder(const std::string& folder)
    : Folder(folder)
  {
  }

  /** @param stage  suffix by which glslangValidator knows it. */
  void Add(const std::string& name, const char* stage, const std::string& source)
  {
    if (!this->Written.insert(source).second)
    {
      return;
    }
    const std::string number = std::to_string(this->Written.size());
    std::ofstream file(this->Folder + "/" + name + "-" + number + "." + stage);
    file << source;
    this->IsGood = this->IsGood && file.good();
  }
  /**
   * Adds a source without GL_ARB_gpu_shader5, and with it: as GLSL 4.00, which has all that the
   * extension adds. glslangValidator 12 does not know the extension's `precise` in GLSL 1.50.
   */
  void AddFragment(const std::string& name, const std::string& source)
  {
    this->Add(name, "frag", AsVtkCompilesIt(WithoutGpuShader5(source), "150"));
    if (source.find("GL_ARB_gpu_shader5") != std::string::npos)
    {
      this->Add(name + "-400", "frag", AsVtkCompilesIt(source, "400"));
    }
  }

  std::size_t GetNumberOfFiles() const { return this->Written.size(); }
  bool HasWrittenAll() const { return this->IsGood; }

private:
  std::string Folder;
  std::set<std::string> Written;
  bool IsGood = true;
};

/** Appends, for each of `variants`, copies with each of `values` set by `set`. */
template <typename Value, typename Set>
void Vary(std::vector<RayCastOptics>& variants, const std::vector<Value>& values, const Set& set)
{
  std::vector<RayCastOptics> varied;
  for (const RayCastOptics& optics : variants)
  {
    for (const Value& value : values)
    {
      varied.push_back(optics);
      set(varied.back(), value);
    }
  }
  variants = varied;
}

/** The variants of the optical model that the mapper can ask for, each alone. */
std::vector<RayCastOptics> ListModels()
{
  std::vector<RayCastOptics> models;
  for (const BlendModel& model : BlendModels)
  {
    std::vector<RayCastOptics> variants(1);
    variants[0].Blending = model.Mode;
    Vary(variants, std::vector<bool>{ false, true },
      [](RayCastOptics& optics, bool value) { optics.CellScalars = value; });
    if (model.IsLit())
    {
      Vary(variants, std::vector<int>{ 0, 1, 2 },
        [](RayCastOptics& optics, int lights)
        {
          optics.Shading = lights > 0;
          optics.Lighting.Lights.resize(static_cast<std::size_t>(lights));
        });
      Vary(variants, std::vector<bool>{ false, true },
        [](RayCastOptics& optics, bool value) { optics.VertexGradients = value; });
    }
    if (model.IsMedium())
    {
      Vary(variants, std::vector<bool>{ false, true },
        [](RayCastOptics& optics, bool value) { optics.GradientOpacity = value; });
      Vary(variants,
        std::vector<ComponentMixture>{ ComponentMixture::None, ComponentMixture::Independent,
          ComponentMixture::ColorAndOpacity, ComponentMixture::RedGreenBlueOpacity },
        [](RayCastOptics& optics, ComponentMixture mixture) { optics.Components = mixture; });
      RayCastOptics table = variants[0];
      table.PreIntegrated = true;
      variants.push_back(table);
    }
    models.insert(models.end(), variants.begin(), variants.end());
  }
  // Numbers of functions as the mixtures have them.
  for (std::size_t i = 0, end = models.size(); i < end; ++i)
  {
    if (models[i].Components == ComponentMixture::Independent)
    {
      models[i].NumberOfFunctions = 2;
      models.push_back(models[i]);
      models.back().NumberOfFunctions = 4;
    }
    else if (models[i].Components == ComponentMixture::ColorAndOpacity)
    {
      models[i].NumberOfFunctions = 2;
    }
  }
  return models;
}

/** True if the mapper never asks for this combination. */
bool IsImpossible(const RayCastOptics& optics)
{
  const bool hasGradients =
    !optics.CellScalars && optics.Components != ComponentMixture::Independent;
  const bool usesCommonGradient =
    optics.GradientOpacity || (optics.Shading && optics.Model().IsMedium());
  return (usesCommonGradient && !hasGradients) || (optics.CellScalars && optics.HasComponents()) ||
    (optics.VertexGradients && (optics.CellScalars || !optics.UsesGradients()));
}

/** All variants: each model with each layout of the tables, and with each kind of ray. */
std::vector<RayCastOptics> ListVariants()
{
  std::vector<RayCastOptics> variants;
  for (const RayCastOptics& model : ListModels())
  {
    if (!IsImpossible(model))
    {
      variants.push_back(model);
    }
  }
  // Layouts of the tables and kinds of rays are separate parts of a shader: each layout with plain
  // rays, each kind of ray with full tables, and one pair of others.
  struct Kind
  {
    bool Compact;
    bool Wide;
    bool LongLists;
    int Legs;
    bool Dense;
  };
  Vary(variants,
    std::vector<Kind>{ { false, true, false, 1, false }, { true, false, false, 1, false },
      { true, true, false, 1, false }, { false, true, true, 1, false },
      { false, true, false, 2, false }, { false, true, false, 2, true },
      { false, true, false, 3, false }, { true, false, false, 3, false } },
    [](RayCastOptics& optics, const Kind& kind)
    {
      optics.CompactCells = kind.Compact;
      // Full cells always have four numbers per texel.
      optics.WideCells = kind.Wide;
      optics.LongLists = kind.LongLists;
      optics.NumberOfLegs = kind.Legs;
      optics.Medium.Attenuation[0] = kind.Dense && optics.Model().HidesBehind() ? 1.0 : 0.0;
    });
  // Clipping planes do not depend on the layout of the tables.
  std::vector<RayCastOptics> clipped;
  for (const RayCastOptics& optics : variants)
  {
    if (!optics.CompactCells)
    {
      clipped.push_back(optics);
      clipped.back().ClippingPlanes.resize(2);
    }
  }
  variants.insert(variants.end(), clipped.begin(), clipped.end());
  return variants;
}

void AddAll(ShaderFolder& folder)
{
  for (const RayCastOptics& optics : ListVariants())
  {
    const std::string name = "cast-" + std::string(optics.Model().ShaderPart);
    folder.AddFragment(name, RayCastShaderSource(vtkTetrahedraRayCastFS, optics));
    folder.Add(name, "comp", RayCastShaderSource(vtkTetrahedraRayCastCS, optics));
  }
  for (const int legs : { 1, 2, 3 })
  {
    for (const int behind : { 0, 1 })
    {
      if (legs == 1 && behind == 1)
      {
        continue; // no ray goes on
      }
      folder.AddFragment("tiles", EntryListerSource(vtkTetrahedraEntryTilesFS, legs, behind == 1));
      folder.Add("tiles", "comp", EntryListerSource(vtkTetrahedraEntryTilesCS, legs, behind == 1));
    }
  }
  folder.AddFragment("place", vtkTetrahedraPlaceFS);
  for (const char* variant : { "", "#define HAS_COLOR_BIAS", "#define HAS_SAMPLES" })
  {
    std::string source = vtkTetrahedraComposeFS;
    ReplaceAll(source, "//VTK::ColorBias::Dec", variant);
    ReplaceAll(source, "//VTK::Samples::Dec", "");
    folder.AddFragment("compose", source);
  }
  folder.AddFragment("select", vtkTetrahedraSelectFS);
  folder.AddFragment("depth", vtkTetrahedraDepthFS);
  folder.AddFragment("membrane", MembraneShaderSource(false));
  folder.AddFragment("membrane", MembraneShaderSource(true));
}

}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: meniscus_shader_sources FOLDER\n";
    return EXIT_FAILURE;
  }
  ShaderFolder folder(argv[1]);
  AddAll(folder);
  std::cout << folder.GetNumberOfFiles() << " sources\n";
  return folder.HasWrittenAll() ? EXIT_SUCCESS : EXIT_FAILURE;
}

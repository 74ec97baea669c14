// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkShaderProgram;
class vtkTexture;
class vtkTextureObject;

namespace meniscus
{

/** Images and optics of one membrane. */
struct MembraneLook
{
  /** Models of the reflectance, with vtkRefractionPass's numbers. */
  enum class Reflectances
  {
    Fresnel,
    Schlick,
    None,
    Mirror
  };

  /** Premultiplied image of the scene behind the membrane. */
  vtkTextureObject* Behind = nullptr;
  /** The same of the mirrored scene; null for none. */
  vtkTextureObject* Mirrored = nullptr;
  /** Normals of the membrane in view coordinates, and its window depths. */
  vtkTextureObject* Normal = nullptr;
  vtkTextureObject* Depth = nullptr;
  /** Cube map that the membrane reflects; null for the background. */
  vtkTexture* CubeMap = nullptr;
  /** Colour where nothing lies behind the membrane. */
  std::array<double, 3> Backdrop{ 0.0, 0.0, 0.0 };
  Reflectances Reflectance = Reflectances::None;
  /** Index of refraction behind each interface, relative to the medium in front of the first. */
  std::vector<double> RelativeIndices{ 1.0 };
};

/** The chosen texture, or else the renderer's environment, if it is a cube map; otherwise null. */
vtkTexture* FindCubeMap(vtkRenderer* renderer, vtkTexture* chosen);

/** Fragment shader of membranes, with or without a cube map that they reflect. */
std::string MembraneShaderSource(bool hasCubeMap);

/** Composites the pixels of membranes over the framebuffer: vtkRefractionMembraneFS.glsl. */
class MembraneComposer
{
public:
  MembraneComposer();
  ~MembraneComposer();
  MembraneComposer(const MembraneComposer&) = delete;
  MembraneComposer& operator=(const MembraneComposer&) = delete;

  /** Returns the text of the error; empty if there is none. */
  std::string Compose(
    vtkRenderer* renderer, vtkOpenGLRenderWindow* window, const MembraneLook& look);
  void Release();

private:
  void SetOptics(vtkRenderer* renderer, const MembraneLook& look, vtkShaderProgram* program) const;

  std::unique_ptr<vtkOpenGLQuadHelper> Quads[2]; // without and with a cube map
};

}

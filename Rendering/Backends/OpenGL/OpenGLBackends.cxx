// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLBackends.h"

#include "Rendering/Backends/OpenGL/OpenGLComputeProgram.h"
#include "Rendering/Backends/OpenGL/RayCastOpenGL.h"
#include "Rendering/Present/RayCastPresenter.h"

#include <utility>

namespace meniscus
{
namespace
{

/** Caster and tables are shared, and are counted and released as such. */
class OpenGLBackend : public RayCastBackend
{
public:
  OpenGLBackend(std::shared_ptr<RayCastOpenGL> caster, RayProgram program)
    : Caster(std::move(caster))
    , Program(program)
  {
  }

  std::string CanDraw(const RayCastRequest& request) override
  {
    if (this->Program == RayProgram::Compute && !OpenGLComputeProgram::IsSupported())
    {
      return "the window has no OpenGL 4.3, which compute shaders need";
    }
    return RayCastOpenGL::DescribeExcess(request);
  }

  bool IsAutomatic(const RayCastRequest&) override
  {
    // Devices for data centres have few units for fragments: an NVIDIA H200 casts the same rays 10
    // times faster by compute shaders.
    return !RayCastPresenter::IsSoftware() &&
      (this->Program == RayProgram::Fragment || OpenGLComputeProgram::IsSupported());
  }

  bool IsRepeatable() const override { return true; }

  std::string Update(const RayCastRequest& request) override
  {
    return this->Caster->Update(request);
  }

  std::string Cast(const RayCastRequest&, RayCastTarget& target) override
  {
    return this->Caster->Cast(target, this->Program);
  }

  RayCastStatistics GetStatistics() override { return this->Caster->GetStatistics(); }

private:
  std::shared_ptr<RayCastOpenGL> Caster;
  RayProgram Program;
};

}

//------------------------------------------------------------------------------
std::unique_ptr<RayCastBackend> MakeFragmentBackend(RayCastSharing& sharing)
{
  return std::make_unique<OpenGLBackend>(sharing.Get<RayCastOpenGL>(), RayProgram::Fragment);
}

//------------------------------------------------------------------------------
std::unique_ptr<RayCastBackend> MakeComputeBackend(RayCastSharing& sharing)
{
  return std::make_unique<OpenGLBackend>(sharing.Get<RayCastOpenGL>(), RayProgram::Compute);
}

}

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLComputeProgram.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"

#include <vector>

namespace meniscus
{

vtkStandardNewMacro(OpenGLComputeProgram);

//------------------------------------------------------------------------------
bool OpenGLComputeProgram::IsSupported()
{
  GLint version[2] = { 0, 0 };
  glGetIntegerv(GL_MAJOR_VERSION, &version[0]);
  glGetIntegerv(GL_MINOR_VERSION, &version[1]);
  return version[0] > 4 || (version[0] == 4 && version[1] >= 3);
}

//------------------------------------------------------------------------------
bool OpenGLComputeProgram::Build(const std::string& source)
{
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  const GLuint program = glCreateProgram();
  glAttachShader(program, shader);
  glLinkProgram(program);
  glDetachShader(program, shader);
  glDeleteShader(shader);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE)
  {
    glDeleteProgram(program);
    return false;
  }
  this->Handle = static_cast<int>(program);
  this->Linked = true;
  return true;
}

//------------------------------------------------------------------------------
void OpenGLComputeProgram::Use(vtkOpenGLRenderWindow* window)
{
  window->GetShaderCache()->ReleaseCurrentShader();
  glUseProgram(static_cast<GLuint>(this->Handle));
}

//------------------------------------------------------------------------------
void OpenGLComputeProgram::Dispatch(int groupsX, int groupsY)
{
  glDispatchCompute(static_cast<GLuint>(groupsX), static_cast<GLuint>(groupsY), 1);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  glUseProgram(0);
}

//------------------------------------------------------------------------------
void OpenGLComputeProgram::Free()
{
  if (this->Linked)
  {
    glDeleteProgram(static_cast<GLuint>(this->Handle));
  }
  this->Linked = false;
  this->Handle = 0;
  this->ClearMaps();
}

}

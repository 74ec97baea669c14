// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Rendering/Backends/OpenGL/OpenGLComputeProgram.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"

#include <algorithm>
#include <vector>

namespace meniscus
{
namespace
{

/** The start of a log of the driver, by the functions for shaders or programs. */
template <typename GetValue, typename GetLog>
std::string ReadLog(GLuint object, GetValue&& getValue, GetLog&& getLog)
{
  constexpr GLint longest = 2000; // characters of a message that people read
  GLint length = 0;
  getValue(object, GL_INFO_LOG_LENGTH, &length);
  std::vector<GLchar> text(static_cast<std::size_t>(std::min(std::max(length, 1), longest)), '\0');
  getLog(object, static_cast<GLsizei>(text.size()), nullptr, text.data());
  text.back() = '\0';
  return text.data();
}

}

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
std::string OpenGLComputeProgram::Build(const std::string& source)
{
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  const GLuint program = glCreateProgram();
  glAttachShader(program, shader);
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  std::string error;
  if (linked != GL_TRUE)
  {
    error = ReadLog(shader, glGetShaderiv, glGetShaderInfoLog) +
      ReadLog(program, glGetProgramiv, glGetProgramInfoLog);
    error = error.empty() ? "the driver gives no reason" : error;
  }
  glDetachShader(program, shader);
  glDeleteShader(shader);
  if (!error.empty())
  {
    glDeleteProgram(program);
    return error;
  }
  this->Handle = static_cast<int>(program);
  this->Linked = true;
  return std::string();
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

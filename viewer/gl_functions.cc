// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/gl_functions.h"

#include "scene/error.h"

namespace groundglass {
namespace {

GLuint CompileShader(const GlFunctions& gl, GLenum kind, const std::string& source) {
  const GLuint shader = gl.CreateShader(kind);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (!compiled) {
    char log[1024] = "";
    gl.GetShaderInfoLog(shader, sizeof(log), nullptr, log);
    gl.DeleteShader(shader);
    throw Error(std::string("viewer: this OpenGL refuses a shader: ") + log);
  }
  return shader;
}

}  // namespace

GlFunctions FindGlFunctions(GlContext& context) {
  GlFunctions gl;
#define GROUNDGLASS_GL_FIND(name, type)                               \
  gl.name = reinterpret_cast<type>(context.FindFunction("gl" #name)); \
  if (!gl.name) throw Error("viewer: this OpenGL has no function gl" #name);
  GROUNDGLASS_GL_FUNCTIONS(GROUNDGLASS_GL_FIND)
#undef GROUNDGLASS_GL_FIND
  return gl;
}

GlProgram::GlProgram(const GlFunctions& gl,
                     const std::string& vertex,
                     const std::string& fragment) {
  const GLuint vertex_shader = CompileShader(gl, GL_VERTEX_SHADER, vertex);
  const GLuint fragment_shader = CompileShader(gl, GL_FRAGMENT_SHADER, fragment);
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, vertex_shader);
  gl.AttachShader(program, fragment_shader);
  gl.LinkProgram(program);
  gl.DeleteShader(vertex_shader);
  gl.DeleteShader(fragment_shader);
  GLint linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked) {
    char log[1024] = "";
    gl.GetProgramInfoLog(program, sizeof(log), nullptr, log);
    gl.DeleteProgram(program);
    throw Error(std::string("viewer: this OpenGL cannot link its shaders: ") + log);
  }
  gl_ = &gl;
  name_ = program;
}

}  // namespace groundglass

// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "viewer/gl_context.h"

#include <GL/glcorearb.h>

#include <string>
#include <utility>

namespace groundglass {

// The OpenGL functions that the renderer calls: name in OpenGL without "gl", type.
#define GROUNDGLASS_GL_FUNCTIONS(X)                                          \
  X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                                   \
  X(AttachShader, PFNGLATTACHSHADERPROC)                                     \
  X(BindBuffer, PFNGLBINDBUFFERPROC)                                         \
  X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                               \
  X(BindRenderbuffer, PFNGLBINDRENDERBUFFERPROC)                             \
  X(BindTexture, PFNGLBINDTEXTUREPROC)                                       \
  X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                               \
  X(BlitFramebuffer, PFNGLBLITFRAMEBUFFERPROC)                               \
  X(BlendFunc, PFNGLBLENDFUNCPROC)                                           \
  X(BufferData, PFNGLBUFFERDATAPROC)                                         \
  X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)                 \
  X(ClearBufferfv, PFNGLCLEARBUFFERFVPROC)                                   \
  X(ClearBufferuiv, PFNGLCLEARBUFFERUIVPROC)                                 \
  X(CompileShader, PFNGLCOMPILESHADERPROC)                                   \
  X(CreateProgram, PFNGLCREATEPROGRAMPROC)                                   \
  X(CreateShader, PFNGLCREATESHADERPROC)                                     \
  X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                                   \
  X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)                         \
  X(DeleteProgram, PFNGLDELETEPROGRAMPROC)                                   \
  X(DeleteRenderbuffers, PFNGLDELETERENDERBUFFERSPROC)                       \
  X(DeleteShader, PFNGLDELETESHADERPROC)                                     \
  X(DeleteTextures, PFNGLDELETETEXTURESPROC)                                 \
  X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)                         \
  X(Disable, PFNGLDISABLEPROC)                                               \
  X(DrawArrays, PFNGLDRAWARRAYSPROC)                                         \
  X(Enable, PFNGLENABLEPROC)                                                 \
  X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC)               \
  X(FramebufferRenderbuffer, PFNGLFRAMEBUFFERRENDERBUFFERPROC)               \
  X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)                     \
  X(FrontFace, PFNGLFRONTFACEPROC)                                           \
  X(GenBuffers, PFNGLGENBUFFERSPROC)                                         \
  X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                               \
  X(GenRenderbuffers, PFNGLGENRENDERBUFFERSPROC)                             \
  X(GenTextures, PFNGLGENTEXTURESPROC)                                       \
  X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                               \
  X(GenerateMipmap, PFNGLGENERATEMIPMAPPROC)                                 \
  X(GetIntegerv, PFNGLGETINTEGERVPROC)                                       \
  X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)                           \
  X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                                     \
  X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)                             \
  X(GetShaderiv, PFNGLGETSHADERIVPROC)                                       \
  X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)                         \
  X(LinkProgram, PFNGLLINKPROGRAMPROC)                                       \
  X(PixelStorei, PFNGLPIXELSTOREIPROC)                                       \
  X(ReadPixels, PFNGLREADPIXELSPROC)                                         \
  X(RenderbufferStorageMultisample, PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC) \
  X(ShaderSource, PFNGLSHADERSOURCEPROC)                                     \
  X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                         \
  X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                   \
  X(Uniform1f, PFNGLUNIFORM1FPROC)                                           \
  X(Uniform1i, PFNGLUNIFORM1IPROC)                                           \
  X(Uniform2f, PFNGLUNIFORM2FPROC)                                           \
  X(Uniform3f, PFNGLUNIFORM3FPROC)                                           \
  X(UniformMatrix3fv, PFNGLUNIFORMMATRIX3FVPROC)                             \
  X(UniformMatrix4fv, PFNGLUNIFORMMATRIX4FVPROC)                             \
  X(UseProgram, PFNGLUSEPROGRAMPROC)                                         \
  X(VertexAttribIPointer, PFNGLVERTEXATTRIBIPOINTERPROC)                     \
  X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)                       \
  X(Viewport, PFNGLVIEWPORTPROC)

struct GlFunctions {
#define GROUNDGLASS_GL_MEMBER(name, type) type name = nullptr;
  GROUNDGLASS_GL_FUNCTIONS(GROUNDGLASS_GL_MEMBER)
#undef GROUNDGLASS_GL_MEMBER
};

// Looks all of them up in the current context; Error if one is missing.
GlFunctions FindGlFunctions(GlContext& context);

// One OpenGL object, deleted with its owner while the context is current.
template <auto kGenerate, auto kDelete>
class GlName {
 public:
  GlName() = default;
  explicit GlName(const GlFunctions& gl) : gl_(&gl) { (gl.*kGenerate)(1, &name_); }
  GlName(GlName&& other) noexcept
      : gl_(std::exchange(other.gl_, nullptr)), name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (gl_) (gl_->*kDelete)(1, &name_);
  }
  GLuint Name() const { return name_; }

 private:
  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
};
using GlTexture = GlName<&GlFunctions::GenTextures, &GlFunctions::DeleteTextures>;
using GlBuffer = GlName<&GlFunctions::GenBuffers, &GlFunctions::DeleteBuffers>;
using GlFramebuffer = GlName<&GlFunctions::GenFramebuffers, &GlFunctions::DeleteFramebuffers>;
using GlRenderbuffer = GlName<&GlFunctions::GenRenderbuffers, &GlFunctions::DeleteRenderbuffers>;
using GlVertexArray = GlName<&GlFunctions::GenVertexArrays, &GlFunctions::DeleteVertexArrays>;

// A linked shader program.
class GlProgram {
 public:
  GlProgram() = default;
  // Throws Error with the compiler's message.
  GlProgram(const GlFunctions& gl, const std::string& vertex, const std::string& fragment);
  GlProgram(GlProgram&& other) noexcept
      : gl_(std::exchange(other.gl_, nullptr)), name_(std::exchange(other.name_, 0)) {}
  GlProgram& operator=(GlProgram&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlProgram() {
    if (gl_) gl_->DeleteProgram(name_);
  }
  void Use() const { gl_->UseProgram(name_); }
  GLint Uniform(const char* name) const { return gl_->GetUniformLocation(name_, name); }

 private:
  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
};

}  // namespace groundglass

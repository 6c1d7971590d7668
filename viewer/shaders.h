// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

namespace groundglass {

// All colours inside the shaders are linear light, premultiplied by alpha; OpenGL decodes sRGB
// textures on reading and encodes on writing to sRGB framebuffers.

constexpr char kFaceVertexShader[] = R"(#version 330 core
uniform mat4 clip_from_local;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 on_page_in;
layout(location = 3) in uint face_in;
out vec2 on_page;
flat out vec3 normal;
flat out uint face;
void main() {
  on_page = on_page_in;
  normal = normal_in;
  face = face_in;
  gl_Position = clip_from_local * vec4(position, 1);
}
)";

// The back of a face is plain grey in every mode: it is not part of the picture of the building,
// and a photograph must not seem to be on it.
//
// One program for each way of colouring, by a #define before this text: the software rasteriser
// runs all branches of a shader for every pixel.
constexpr char kFaceFragmentShader[] = R"(
uniform sampler2D page;
uniform int max_taps;
uniform vec3 sun_direction;
in vec2 on_page;
flat in vec3 normal;
flat in uint face;
layout(location = 0) out vec4 colour;

// A soft sun under a bright sky: a wall that the sun misses still shows its form.
float Light(vec3 n) {
  float sun = max(dot(n, sun_direction), 0.0);
  return 0.42 + 0.12 * n.z + 0.16 * dot(n.xy, sun_direction.xy) + 0.38 * sun;
}

#if defined(TEXTURED)
vec3 FrontColour() { return texture(page, on_page).rgb; }
#elif defined(TEXTURED_ALONG_SIGHT)
// Trilinear taps along the longer axis of the pixel's footprint, as many as it is longer than the
// shorter. OpenGL's own anisotropic filter is not used: the software rasteriser's blurs even what
// is seen straight on.
vec3 FrontColour() {
  vec2 along_x = dFdx(on_page);
  vec2 along_y = dFdy(on_page);
  vec2 size = vec2(textureSize(page, 0));
  float texels_x = length(along_x * size);
  float texels_y = length(along_y * size);
  float major = max(texels_x, texels_y);
  float minor = max(min(texels_x, texels_y), 1.0);
  int taps = int(clamp(ceil(major / minor - 0.01), 1.0, float(max_taps)));
  float lod = log2(major / float(taps));
  vec2 tap_step = (texels_x > texels_y ? along_x : along_y) / float(taps);
  vec3 sum = vec3(0.0);
  for (int tap = 0; tap < taps; ++tap) {
    sum += textureLod(page, on_page + (float(tap) - 0.5 * float(taps - 1)) * tap_step, lod).rgb;
  }
  return sum / float(taps);
}
#elif defined(PLAIN)
vec3 FrontColour() { return vec3(0.52 * (0.5 + 0.5 * Light(normal))); }
#elif defined(SHADED)
vec3 FrontColour() { return vec3(0.80, 0.77, 0.72) * Light(normal); }
#elif defined(NUMBERED)
// Neighbouring numbers get hues far apart: steps of the golden ratio.
vec3 FrontColour() {
  float hue = fract(float(face) * 0.61803398875 + 0.1) * 6.0;
  vec3 pure = clamp(abs(mod(hue + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0, 0.0, 1.0);
  float tone = 0.55 + 0.15 * float(face % 3u);
  return tone * mix(vec3(1.0), pure, 0.55);
}
#endif

#if defined(HIDING)
void main() { colour = vec4(0.0); }
#else
void main() { colour = vec4(gl_FrontFacing ? FrontColour() : vec3(0.30), 1.0); }
#endif
)";

constexpr char kLabelFragmentShader[] = R"(#version 330 core
flat in vec3 normal;
flat in uint face;
in vec2 on_page;
layout(location = 0) out uint label;
void main() { label = gl_FrontFacing ? face + 1u : 0u; }
)";

// One triangle over the whole frame, at the far end of the depth range.
constexpr char kFrameVertexShader[] = R"(#version 330 core
uniform mat3 world_from_clip;  // direction seen at clip (x, y, 1)
out vec3 direction;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  direction = world_from_clip * vec3(corner, 1.0);
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";

constexpr char kSkyFragmentShader[] = R"(#version 330 core
in vec3 direction;
layout(location = 0) out vec4 colour;
const vec3 kZenith = vec3(0.16, 0.34, 0.68);
const vec3 kHorizon = vec3(0.78, 0.85, 0.92);
const vec3 kGround = vec3(0.42, 0.40, 0.37);
void main() {
  float up = normalize(direction).z;
  vec3 sky = mix(kHorizon, kZenith, sqrt(clamp(up, 0.0, 1.0)));
  vec3 below = mix(kHorizon, kGround, smoothstep(0.0, 0.06, -up));
  colour = vec4(up > 0.0 ? sky : below, 1.0);
}
)";

// From the drawn frame to the picture: the mean of samples x samples points in each pixel. Without
// distortion these are the drawn frame's own pixels; with it they are sought through the grid.
constexpr char kResolveFragmentShader[] = R"(#version 330 core
uniform sampler2D drawn;
uniform sampler2D grid;   // drawn px at every grid_step px of the picture
uniform vec2 grid_size;   // nodes
uniform float grid_step;
uniform int samples;
uniform int bent;
in vec3 direction;
layout(location = 0) out vec4 colour;
void main() {
  vec4 sum = vec4(0.0);
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      if (bent == 0) {
        sum += texelFetch(drawn, ivec2(gl_FragCoord.xy) * samples + ivec2(column, row), 0);
      } else {
        vec2 px = floor(gl_FragCoord.xy) + (vec2(column, row) + 0.5) / float(samples);
        vec2 node = (px / grid_step + 0.5) / grid_size;
        sum += texture(drawn, texture(grid, node).xy / vec2(textureSize(drawn, 0)));
      }
    }
  }
  colour = sum / float(samples * samples);
}
)";

}  // namespace groundglass

#include "render/programs.h"

#include "base/fault.h"
#include "render/shader_texts.h"

static GLuint compile(const gl_api *gl, GLenum stage, const char *const included[2], const char *text,
    sbf_diagnostic *diagnostic) {
  const GLchar *parts[] = {shader_common_glsl, included[0], included[1], text};
  GLuint shader = gl->CreateShader(stage);
  GLint good = 0;
  char log[256] = "";
  gl->ShaderSource(shader, 4, parts, NULL);
  gl->CompileShader(shader);
  gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  gl->GetShaderInfoLog(shader, (GLsizei)sizeof log, NULL, log);
  fault_set(diagnostic, SBF_CODE_OPENGL_FAILED, "this OpenGL does not take a shader of ours: %s", log);
  gl->DeleteShader(shader);
  return 0;
}

static GLuint link(const gl_api *gl, const char *vertex_text, const char *const included[2],
    const char *fragment_text, sbf_diagnostic *diagnostic) {
  static const char *const none[2] = {"", ""};
  GLuint vertex = compile(gl, GL_VERTEX_SHADER, none, vertex_text, diagnostic);
  GLuint fragment = vertex ? compile(gl, GL_FRAGMENT_SHADER, included, fragment_text, diagnostic) : 0;
  GLuint program = fragment ? gl->CreateProgram() : 0;
  if (program) {
    GLint good = 0;
    char log[256] = "";
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) {
      gl->GetProgramInfoLog(program, (GLsizei)sizeof log, NULL, log);
      fault_set(diagnostic, SBF_CODE_OPENGL_FAILED, "this OpenGL does not link a shader of ours: %s", log);
      gl->DeleteProgram(program);
      program = 0;
    }
  }
  /* Shaders stay alive in the program that they are attached to. */
  if (vertex) gl->DeleteShader(vertex);
  if (fragment) gl->DeleteShader(fragment);
  return program;
}

static void bind_inputs(const gl_api *gl, GLuint program) {
  static const char *const samplers[] = {"shadow_map", "shadow_depths", "ground_light", "ground_heights",
      "lowest_heights", "open_sky", "veil_depths", "line_layer", "base_image"};
  gl->UseProgram(program);
  for (GLint unit = 0; unit < (GLint)(sizeof samplers / sizeof *samplers); unit++) {
    GLint index = gl->GetUniformLocation(program, samplers[unit]);
    if (index >= 0) gl->Uniform1i(index, unit);
  }
  GLuint block = gl->GetUniformBlockIndex(program, "Frame");
  if (block != GL_INVALID_INDEX) gl->UniformBlockBinding(program, block, 0);
}

sbf_status programs_create(program_set *programs, const gl_api *gl, sbf_diagnostic *diagnostic) {
  static const struct {
    const char *vertex, *included[2], *fragment;
  } texts[PROGRAM_COUNT] = {
      [PROGRAM_BACKDROP] = {shader_backdrop_vert, {"", ""}, shader_backdrop_frag},
      [PROGRAM_DEPTH] = {shader_depth_vert, {"", ""}, shader_depth_frag},
      [PROGRAM_DEPTH_MASK] = {shader_depth_vert, {"#define ALPHA\n", ""}, shader_depth_frag},
      [PROGRAM_OPEN_SKY] = {shader_backdrop_vert, {"", ""}, shader_open_sky_frag},
      [PROGRAM_GROUND_LIGHT] = {shader_backdrop_vert, {"#define SHADOW_SAMPLES 24\n", shader_light_glsl},
          shader_ground_light_frag},
      [PROGRAM_SOFTEN] = {shader_backdrop_vert, {"", ""}, shader_soften_frag},
      [PROGRAM_GROUND] = {shader_mesh_vert, {"#define SHADOW_SAMPLES 0\n", shader_light_glsl},
          shader_ground_frag},
      [PROGRAM_MESH] = {shader_mesh_vert, {"#define SHADOW_SAMPLES 20\n", shader_light_glsl},
          shader_mesh_frag},
      [PROGRAM_MESH_IMAGE] = {shader_mesh_vert,
          {"#define SHADOW_SAMPLES 20\n#define BASE_IMAGE\n", shader_light_glsl}, shader_mesh_frag},
      [PROGRAM_MESH_ALPHA] = {shader_mesh_vert,
          {"#define SHADOW_SAMPLES 20\n#define BASE_IMAGE\n#define ALPHA\n", shader_light_glsl},
          shader_mesh_frag},
      [PROGRAM_XRAY] = {shader_mesh_vert, {"#define SHADOW_SAMPLES 0\n", shader_light_glsl},
          shader_mesh_frag},
      [PROGRAM_LINE] = {shader_line_vert, {"", ""}, shader_line_frag},
      [PROGRAM_LAYER] = {shader_backdrop_vert, {"", ""}, shader_layer_frag},
  };
  *programs = (program_set){.opacity = -1};
  for (int i = 0; i < PROGRAM_COUNT; i++) {
    programs->at[i] = link(gl, texts[i].vertex, texts[i].included, texts[i].fragment, diagnostic);
    if (!programs->at[i]) {
      programs_destroy(programs, gl);
      return SBF_FAILED;
    }
    bind_inputs(gl, programs->at[i]);
  }
  programs->opacity = gl->GetUniformLocation(programs->at[PROGRAM_XRAY], "opacity");
  programs->murk = gl->GetUniformLocation(programs->at[PROGRAM_LINE], "murk");
  programs->thinness = gl->GetUniformLocation(programs->at[PROGRAM_LINE], "thinness");
  programs->map_from_world = gl->GetUniformLocation(programs->at[PROGRAM_DEPTH], "map_from_world");
  programs->mask_map_from_world = gl->GetUniformLocation(programs->at[PROGRAM_DEPTH_MASK], "map_from_world");
  programs->mask_cutoff = gl->GetUniformLocation(programs->at[PROGRAM_DEPTH_MASK], "cutoff");
  programs->cutoff = gl->GetUniformLocation(programs->at[PROGRAM_MESH_ALPHA], "cutoff");
  return SBF_OK;
}

void programs_destroy(program_set *programs, const gl_api *gl) {
  for (int i = 0; i < PROGRAM_COUNT; i++)
    if (programs->at[i]) gl->DeleteProgram(programs->at[i]);
  *programs = (program_set){.opacity = -1};
}

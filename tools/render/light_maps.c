#include "render/light_maps.h"

static GLuint make_texture(
    const gl_api *gl, GLsizei width, GLsizei height, GLenum stored, GLenum format, GLenum type) {
  GLuint made = 0;
  gl->GenTextures(1, &made);
  gl->BindTexture(GL_TEXTURE_2D, made);
  gl->TexImage2D(GL_TEXTURE_2D, 0, (GLint)stored, width, height, 0, format, type, NULL);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  return made;
}

static void filter(const gl_api *gl, GLint how) {
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, how);
  gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, how);
}

static bool make_frame(const gl_api *gl, GLenum attachment, GLuint texture, GLuint *frame) {
  gl->GenFramebuffers(1, frame);
  gl->BindFramebuffer(GL_FRAMEBUFFER, *frame);
  gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
  if (attachment == GL_DEPTH_ATTACHMENT) {
    gl->DrawBuffer(GL_NONE);
    gl->ReadBuffer(GL_NONE);
  }
  return gl->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

bool light_maps_make_depth(const gl_api *gl, GLsizei width, GLsizei height, GLuint *texture, GLuint *frame) {
  *texture = make_texture(gl, width, height, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
  filter(gl, GL_NEAREST);
  return make_frame(gl, GL_DEPTH_ATTACHMENT, *texture, frame);
}

static bool make_light(const gl_api *gl, GLsizei side, GLuint *texture, GLuint *frame) {
  *texture = make_texture(gl, side, side, GL_RG8, GL_RG, GL_UNSIGNED_BYTE);
  filter(gl, GL_LINEAR);
  return make_frame(gl, GL_COLOR_ATTACHMENT0, *texture, frame);
}

static GLuint make_sampler(const gl_api *gl, bool compares) {
  GLuint made = 0;
  gl->GenSamplers(1, &made);
  gl->SamplerParameteri(made, GL_TEXTURE_MIN_FILTER, compares ? GL_LINEAR : GL_NEAREST);
  gl->SamplerParameteri(made, GL_TEXTURE_MAG_FILTER, compares ? GL_LINEAR : GL_NEAREST);
  gl->SamplerParameteri(made, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl->SamplerParameteri(made, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl->SamplerParameteri(made, GL_TEXTURE_COMPARE_MODE, compares ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
  gl->SamplerParameteri(made, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return made;
}

bool light_maps_create(light_maps *maps, const gl_api *gl) {
  *maps = (light_maps){0};
  bool good =
      light_maps_make_depth(gl, SHADOW_MAP_SIDE, SHADOW_MAP_SIDE, &maps->shadow_texture, &maps->shadow_frame);
  good = light_maps_make_depth(
             gl, HEIGHT_MAP_SIDE, HEIGHT_MAP_SIDE, &maps->ground_texture, &maps->ground_frame) &&
         good;
  good = light_maps_make_depth(
             gl, HEIGHT_MAP_SIDE, HEIGHT_MAP_SIDE, &maps->lowest_texture, &maps->lowest_frame) &&
         good;
  good = make_light(gl, HEIGHT_MAP_SIDE, &maps->open_texture, &maps->open_frame) && good;
  good = make_light(gl, GROUND_MAP_SIDE, &maps->light_texture, &maps->light_frame) && good;
  good = make_light(gl, GROUND_MAP_SIDE, &maps->softened_texture, &maps->softened_frame) && good;
  maps->compared = make_sampler(gl, true);
  maps->plain = make_sampler(gl, false);
  return good;
}

void light_maps_destroy(light_maps *maps, const gl_api *gl) {
  GLuint textures[] = {maps->shadow_texture, maps->ground_texture, maps->lowest_texture, maps->open_texture,
      maps->light_texture, maps->softened_texture};
  GLuint frames[] = {maps->shadow_frame, maps->ground_frame, maps->lowest_frame, maps->open_frame,
      maps->light_frame, maps->softened_frame};
  GLuint samplers[] = {maps->compared, maps->plain};
  gl->DeleteTextures(6, textures);
  gl->DeleteFramebuffers(6, frames);
  gl->DeleteSamplers(2, samplers);
  *maps = (light_maps){0};
}

/* Grows in steps of a quarter, so that a swinging tail does not change the size in every frame. */
static float grown(float side, float wanted) {
  if (!(side > 0)) side = fmaxf(wanted, 1e-3f);
  while (side < wanted) side *= 1.25f;
  return side;
}

static float to_texel(float x, float texel) {
  return floorf(x / texel) * texel;
}

void light_maps_update_view(light_maps *maps, const box3 *casters, const box3 *ground, float ground_near,
    sbf_vec3 to_key, light_view *projections) {
  box3 box = *casters;
  if (box3_is_empty(&box)) box = (box3){{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}};
  sbf_vec3 middle = v3_scale(v3_add(box.min, box.max), 0.5f);
  float radius = 0.5f * v3_length(v3_sub(box.max, box.min));

  /* A square around the bounding sphere of everything, seen along the light. */
  maps->shadow_side = grown(maps->shadow_side, 2.1f * radius);
  projections->shadow_side = maps->shadow_side;
  float texel = projections->shadow_side / SHADOW_MAP_SIDE, half = 0.5f * projections->shadow_side;
  matrix4 light = matrix4_view(v3(0, 0, 0), to_key, v3(0, 1, 0));
  sbf_vec3 at = {v3_dot(v3(light.at[0], light.at[4], light.at[8]), middle),
      v3_dot(v3(light.at[1], light.at[5], light.at[9]), middle), v3_dot(to_key, middle)};
  at.x = to_texel(at.x, texel), at.y = to_texel(at.y, texel);
  projections->shadow_depth = 2 * projections->shadow_side;
  matrix4 projection = matrix4_orthographic(at.x - half, at.x + half, at.y - half, at.y + half, -at.z - half,
      -at.z - half + projections->shadow_depth);
  projections->shadow_clip_from_world = matrix4_product(&projection, &light);

  /* Seen straight from below: the area of the subject, of its shadow, and around it, where it hides sky. */
  float tall = box.max.y - (box3_is_empty(ground) ? box.min.y : ground_near);
  float cast = fminf(fmaxf(tall, 0) / fmaxf(to_key.y, 0.1f), 4 * radius);
  float around = 0.1f * radius + 0.3f * fmaxf(fminf(tall, radius), 0);
  float left = box.min.x + fminf(-to_key.x * cast, 0) - around,
        right = box.max.x + fmaxf(-to_key.x * cast, 0) + around;
  float back = box.min.z + fminf(-to_key.z * cast, 0) - around,
        front = box.max.z + fmaxf(-to_key.z * cast, 0) + around;
  maps->ground_side = grown(maps->ground_side, fmaxf(right - left, front - back));
  projections->ground_side = maps->ground_side;
  texel = projections->ground_side / GROUND_MAP_SIDE;
  projections->min_x = to_texel(0.5f * (left + right - projections->ground_side), texel);
  projections->min_z = to_texel(0.5f * (back + front - projections->ground_side), texel);
  projections->low =
      fminf(box.min.y, box3_is_empty(ground) ? box.min.y : ground->min.y) - 0.01f * radius - 1e-4f;
  projections->high =
      fmaxf(box.max.y, box3_is_empty(ground) ? box.max.y : ground->max.y) + 0.01f * radius + 1e-4f;
  float across = 2 / projections->ground_side, up = 2 / (projections->high - projections->low);
  projections->heights_clip_from_world = (matrix4){{across, 0, 0, 0, 0, 0, up, 0, 0, across, 0, 0,
      -across * projections->min_x - 1, -across * projections->min_z - 1, -up * projections->low - 1, 1}};
}

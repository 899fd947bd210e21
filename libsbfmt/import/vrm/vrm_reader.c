#include "import/vrm/vrm_reader.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/diagnostic.h"
#include "base/number.h"

void *sbfi_vrm_allocate(sbfi_vrm_reader *r, size_t count, size_t size) {
  void *memory = sbfi_arena_allocate(&r->scene->arena, count ? count : 1, size);
  r->no_memory = r->no_memory || !memory;
  return memory;
}

void sbfi_vrm_warn(sbfi_vrm_reader *r, const char *format, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (!sbfi_scene_warn(r->scene, SBF_CODE_IMPORT_SPRING, 0, "%s", text)) r->no_memory = true;
}

uint32_t sbfi_vrm_count(const sbfi_json *list) {
  return list && list->type == SBFI_JSON_ARRAY ? list->count : 0;
}

int32_t sbfi_vrm_node(const sbfi_vrm_reader *r, const sbfi_json *number) {
  uint32_t index;
  return sbfi_json_u32(number, &index) && index < r->number_count ? r->node_of_number[index] : SBF_NONE;
}

static bool is_number(const sbfi_json *value, float *number) {
  return value && value->type == SBFI_JSON_NUMBER &&
         sbfi_parse_f32(value->text.at, value->text.length, number) == SBFI_NUMBER_READ && isfinite(*number);
}

float sbfi_vrm_number(sbfi_vrm_reader *r, const sbfi_json *object, const char *name, const char *what,
    float fallback, float low, float high) {
  const sbfi_json *value = sbfi_json_get(object, name);
  float number = fallback;
  if (!value) return fallback;
  if (!is_number(value, &number)) {
    sbfi_vrm_warn(
        r, "`%s` of %s is not a number of single precision: %g is used", name, what, (double)fallback);
    return fallback;
  }
  float nearest = fminf(fmaxf(number, low), high);
  if (nearest != number)
    sbfi_vrm_warn(
        r, "`%s` of %s is %g, outside its range: %g is used", name, what, (double)number, (double)nearest);
  return nearest;
}

sbf_vec3 sbfi_vrm_vector(
    sbfi_vrm_reader *r, const sbfi_json *object, const char *name, const char *what, sbf_vec3 fallback) {
  static const char *const names[] = {"x", "y", "z"};
  const sbfi_json *value = sbfi_json_get(object, name);
  float at[3] = {0, 0, 0};
  if (!value) return fallback;
  bool good = value->type == SBFI_JSON_OBJECT || (value->type == SBFI_JSON_ARRAY && value->count == 3);
  for (uint32_t k = 0; k < 3 && good; k++) {
    const sbfi_json *one =
        value->type == SBFI_JSON_OBJECT ? sbfi_json_get(value, names[k]) : sbfi_json_at(value, k);
    good = (!one && value->type == SBFI_JSON_OBJECT) || is_number(one, &at[k]);
  }
  if (good) return (sbf_vec3){at[0], at[1], at[2]};
  sbfi_vrm_warn(r, "`%s` of %s does not have three numbers of single precision: %g %g %g are used", name,
      what, (double)fallback.x, (double)fallback.y, (double)fallback.z);
  return fallback;
}

const char *sbfi_vrm_text(sbfi_vrm_reader *r, const sbfi_json *value) {
  if (!value || value->type != SBFI_JSON_STRING) return "";
  const char *text = sbfi_scene_string(r->scene, value->text);
  r->no_memory = r->no_memory || !text;
  return text ? text : "";
}

void sbfi_vrm_add_indices(sbfi_vrm_reader *r, const sbfi_json *list, uint32_t count, uint8_t *flags,
    const char *what, sbfi_vrm_indices *to) {
  for (uint32_t i = 0; i < sbfi_vrm_count(list); i++) {
    uint32_t index;
    if (!sbfi_json_u32(sbfi_json_at(list, i), &index) || index >= count) {
      sbfi_vrm_warn(r, "%s refers to an item that the file does not have: it is left out", what);
      continue;
    }
    if (!flags[index]) to->at[to->count++] = index;
    flags[index] = 1;
  }
}

void sbfi_vrm_add_spring(sbfi_vrm_reader *r, const sbfi_vrm_spring *spring) {
  if (r->vrm->spring_count == r->spring_capacity) {
    uint32_t capacity = r->spring_capacity ? 2 * r->spring_capacity : 16;
    sbfi_vrm_spring *grown = sbfi_vrm_allocate(r, capacity, sizeof *grown);
    if (!grown) return;
    if (r->springs) memcpy(grown, r->springs, r->vrm->spring_count * sizeof *grown);
    r->vrm->springs = r->springs = grown;
    r->spring_capacity = capacity;
  }
  for (uint32_t i = 0; i < spring->joint_count; i++)
    r->spring_of_node[spring->joints[i].node] = (int32_t)r->vrm->spring_count;
  r->springs[r->vrm->spring_count++] = *spring;
}

#include "recovery_report.h"

#include <stdlib.h>

/* Volume ratios below which an element and a whole body are crushed, strain above which an element is
 * overstretched, and number of frames at the end from which on its body stays so. Springs can fold without an
 * element that tells. No material of a character stretches ten times, except at a corner that strikes. */
static const float CRUSHED_RATIO = 0.2f, CRUSHED_BODY_RATIO = 0.5f, MAX_STRAIN = 9;
static const double STRIKE_S = 0.1; /* longest time that a strike takes */
enum { LASTING_FRAMES = 30 };

bool recovery_report_begin(recovery_report *r, const sbf_asset *asset, double frame_s) {
  r->frame_s = frame_s;
  r->body_count = asset->soft_bodies.count;
  r->bodies = calloc(r->body_count + 1, sizeof *r->bodies);
  for (uint32_t i = 0; r->bodies && i < r->body_count; i++)
    r->bodies[i].min_ratio = r->bodies[i].min_volume_ratio = 1;
  return r->bodies != NULL;
}

void recovery_report_end(recovery_report *r) {
  free(r->bodies);
  r->bodies = NULL;
}

void recovery_report_measure(recovery_report *r, uint32_t body, const sbr_body_health *health) {
  recovery_count *count = &r->bodies[body];
  uint32_t more = health->recoveries > count->last ? health->recoveries - count->last : 0;
  count->last = health->recoveries;
  count->total += more;
  count->rigid += health->rigid;
  count->row = more ? count->row + 1 : 0;
  if (count->row > count->longest) count->longest = count->row;
  bool crushed = health->min_element_ratio < CRUSHED_RATIO || health->volume_ratio < CRUSHED_BODY_RATIO;
  count->crushed += crushed;
  count->crushed_row = crushed ? count->crushed_row + 1 : 0;
  if (health->min_element_ratio < count->min_ratio) count->min_ratio = health->min_element_ratio;
  if (health->volume_ratio < count->min_volume_ratio) count->min_volume_ratio = health->volume_ratio;
  count->inverted += health->inverted;
  bool stretched = health->max_strain > MAX_STRAIN;
  count->stretched += stretched;
  count->stretched_row = stretched ? count->stretched_row + 1 : 0;
  if (count->stretched_row > count->stretched_longest) count->stretched_longest = count->stretched_row;
  if (health->max_strain > count->max_strain) count->max_strain = health->max_strain;
}

bool recovery_report_is_valid(const recovery_report *r) {
  for (uint32_t i = 0; i < r->body_count; i++) {
    const recovery_count *count = &r->bodies[i];
    bool overstretched = count->stretched_longest * r->frame_s > STRIKE_S;
    if (count->total || count->inverted || overstretched) return false;
  }
  return true;
}

uint64_t recovery_report_total(const recovery_report *r) {
  uint64_t total = 0;
  for (uint32_t i = 0; i < r->body_count; i++) total += r->bodies[i].total;
  return total;
}

static json_t *recovery_of(const recovery_count *count) {
  json_t *one = json_object();
  json_object_set_new(one, "recoveries", json_integer(count->total));
  json_object_set_new(one, "frames_in_a_row", json_integer(count->longest));
  json_object_set_new(one, "rigid_frames", json_integer(count->rigid));
  return one;
}

static json_t *crushing_of(const recovery_count *count) {
  json_t *one = json_object();
  json_object_set_new(one, "frames", json_integer(count->crushed));
  json_object_set_new(one, "min_element_ratio", json_real((double)count->min_ratio));
  json_object_set_new(one, "min_volume_ratio", json_real((double)count->min_volume_ratio));
  return one;
}

static json_t *inversion_of(const recovery_count *count) {
  return json_pack("{s:I}", "frames", (json_int_t)count->inverted);
}

static json_t *stretching_of(const recovery_count *count) {
  return json_pack(
      "{s:I, s:f}", "frames", (json_int_t)count->stretched, "max_strain", (double)count->max_strain);
}

/* Names need not be unique: the id tells bodies of one name apart. */
static void add_body(json_t *bodies, const sbf_soft_body *body, json_t *facts) {
  char key[256];
  snprintf(key, sizeof key, json_object_get(bodies, body->name) ? "%.100s (%.100s)" : "%.100s", body->name,
      body->id);
  json_object_set_new(bodies, key, facts);
}

static void add_where_any(json_t *to, const char *key, json_t *bodies) {
  if (json_object_size(bodies) > 0)
    json_object_set_new(to, key, bodies);
  else
    json_decref(bodies);
}

void recovery_report_add(const recovery_report *r, const sbf_asset *asset, json_t *to) {
  json_t *recovered = json_object(), *inverted = json_object(), *stretched = json_object(),
         *crushed = json_object();
  json_object_set_new(to, "recoveries", json_integer((json_int_t)recovery_report_total(r)));
  for (uint32_t i = 0; i < r->body_count; i++) {
    const recovery_count *count = &r->bodies[i];
    const sbf_soft_body *body = &asset->soft_bodies.at[i];
    if (count->total) add_body(recovered, body, recovery_of(count));
    if (count->inverted) add_body(inverted, body, inversion_of(count));
    if (count->stretched) add_body(stretched, body, stretching_of(count));
    if (count->crushed) add_body(crushed, body, crushing_of(count));
  }
  add_where_any(to, "recovered", recovered);
  add_where_any(to, "inverted", inverted);
  add_where_any(to, "stretched", stretched);
  add_where_any(to, "crushed", crushed);
}

void recovery_report_warn(const recovery_report *r, const sbf_asset *asset) {
  for (uint32_t i = 0; i < r->body_count; i++) {
    const recovery_count *count = &r->bodies[i];
    const char *name = asset->soft_bodies.at[i].name;
    if (count->rigid > 0)
      fprintf(stderr,
          "sbfmt run: warning: soft body \"%s\" was reset to its rest shape %u times and moved as a rigid "
          "body in %u frames: look for slivers with `sbfmt validate`, use more substeps or keep its bones "
          "out of the ground\n",
          name, count->total, count->rigid);
    if (count->crushed_row >= LASTING_FRAMES)
      fprintf(stderr,
          "sbfmt run: warning: soft body \"%s\" ends crushed: an element had less than %g or the body less "
          "than %g of its volume in the last %u frames: move its bones more slowly, drop it from less high "
          "or use a stiffer material\n",
          name, (double)CRUSHED_RATIO, (double)CRUSHED_BODY_RATIO, count->crushed_row);
    if (count->stretched_row >= LASTING_FRAMES)
      fprintf(stderr,
          "sbfmt run: warning: soft body \"%s\" ends overstretched: an element had more than %g times its "
          "length in the last %u frames: lower the steps of the ground or the speed, or use a stiffer "
          "material\n",
          name, (double)MAX_STRAIN + 1, count->stretched_row);
  }
}

#include "recovery_report.h"

#include <stdlib.h>

/* Volume ratio below which an element is crushed, and number of frames after which its body counts as
 * crushed. */
static const float CRUSHED_RATIO = 0.2f;
enum { CRUSHED_FRAMES = 30 };

bool recovery_report_begin(recovery_report *r, const sbf_asset *asset) {
  r->body_count = asset->soft_bodies.count;
  r->bodies = calloc(r->body_count + 1, sizeof *r->bodies);
  for (uint32_t i = 0; r->bodies && i < r->body_count; i++) r->bodies[i].min_ratio = 1;
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
  bool crushed = health->min_element_ratio < CRUSHED_RATIO;
  count->crushed += crushed;
  count->crushed_row = crushed ? count->crushed_row + 1 : 0;
  if (health->min_element_ratio < count->min_ratio) count->min_ratio = health->min_element_ratio;
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
  return one;
}

static void add_where_any(json_t *to, const char *key, json_t *bodies) {
  if (json_object_size(bodies) > 0)
    json_object_set_new(to, key, bodies);
  else
    json_decref(bodies);
}

void recovery_report_add(const recovery_report *r, const sbf_asset *asset, json_t *to) {
  json_t *recovered = json_object(), *crushed = json_object();
  json_object_set_new(to, "recoveries", json_integer((json_int_t)recovery_report_total(r)));
  for (uint32_t i = 0; i < r->body_count; i++) {
    const recovery_count *count = &r->bodies[i];
    const char *name = asset->soft_bodies.at[i].name;
    if (count->total) json_object_set_new(recovered, name, recovery_of(count));
    if (count->crushed) json_object_set_new(crushed, name, crushing_of(count));
  }
  add_where_any(to, "recovered", recovered);
  add_where_any(to, "crushed", crushed);
}

void recovery_report_warn(const recovery_report *r, const sbf_asset *asset) {
  for (uint32_t i = 0; i < r->body_count; i++) {
    const recovery_count *count = &r->bodies[i];
    const char *name = asset->soft_bodies.at[i].name;
    if (count->rigid > 0)
      fprintf(stderr,
          "sbfmt run: warning: soft body \"%s\" was reset to its rest shape %u times and moved as a rigid "
          "body in %u frames: look for slivers with `sbfmt validate`, or use more substeps\n",
          name, count->total, count->rigid);
    if (count->crushed_row >= CRUSHED_FRAMES)
      fprintf(stderr,
          "sbfmt run: warning: soft body \"%s\" ends crushed: an element had less than %g of its volume in "
          "the last %u frames: move its bones more slowly, or use a stiffer material\n",
          name, (double)CRUSHED_RATIO, count->crushed_row);
  }
}

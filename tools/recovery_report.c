#include "recovery_report.h"

#include <stdlib.h>

/* A body put back in so many frames in a row stands still where it is. */
enum { STUCK_FRAMES = 3 };

bool recovery_report_begin(recovery_report *r, const sbf_asset *asset) {
  r->body_count = asset->soft_bodies.count;
  r->bodies = calloc(r->body_count + 1, sizeof *r->bodies);
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
  count->row = more ? count->row + 1 : 0;
  if (count->row > count->longest) count->longest = count->row;
}

static uint64_t total_of(const recovery_report *r) {
  uint64_t total = 0;
  for (uint32_t i = 0; i < r->body_count; i++) total += r->bodies[i].total;
  return total;
}

void recovery_report_add(const recovery_report *r, const sbf_asset *asset, json_t *to) {
  json_t *recovered = json_object();
  json_object_set_new(to, "recoveries", json_integer((json_int_t)total_of(r)));
  for (uint32_t i = 0; i < r->body_count; i++) {
    const recovery_count *count = &r->bodies[i];
    if (!count->total) continue;
    json_t *one = json_object();
    json_object_set_new(one, "recoveries", json_integer(count->total));
    json_object_set_new(one, "frames_in_a_row", json_integer(count->longest));
    json_object_set_new(recovered, asset->soft_bodies.at[i].name, one);
  }
  if (total_of(r) > 0)
    json_object_set_new(to, "recovered", recovered);
  else
    json_decref(recovered);
}

void recovery_report_warn(const recovery_report *r, const sbf_asset *asset) {
  for (uint32_t i = 0; i < r->body_count; i++)
    if (r->bodies[i].longest >= STUCK_FRAMES)
      fprintf(stderr,
          "sbfmt run: warning: soft body \"%s\" was put back into its rest shape in %u frames in a row and "
          "does not move: look for slivers with `sbfmt validate`, or take more substeps\n",
          asset->soft_bodies.at[i].name, r->bodies[i].longest);
}

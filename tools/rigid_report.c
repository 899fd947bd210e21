#include "rigid_report.h"

#include <math.h>

#include "sbrun/rigid.h"

static const double REST_M_S = 0.01, DEGREES = 57.29577951308232;

void rigid_report_begin(rigid_report *report, const session *s) {
  *report = (rigid_report){.asked = s->settings.ragdoll || s->settings.driven};
}

void rigid_report_measure(rigid_report *report, const session *s) {
  if (!report->asked) return;
  for (uint32_t j = 0; j < s->asset->joints.count; j++) {
    sbr_joint_state joint = sbr_character_get_joint_state(s->world, s->character, j);
    if (joint.broken) continue;
    report->angle_violation = fmax(report->angle_violation, (double)joint.angle_violation);
    report->separation = fmax(report->separation, (double)joint.separation);
  }
  for (uint32_t b = 0; b < s->asset->rigid_bodies.count; b++) {
    sbf_vec3 v = sbr_character_get_rigid_state(s->world, s->character, b).velocity;
    if (sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z)) > REST_M_S) report->moving_s = s->time_s;
  }
}

void rigid_report_add(const rigid_report *report, const session *s, json_t *o) {
  if (!report->asked) return;
  json_object_set_new(o, "limit_excess", json_real(report->angle_violation * DEGREES));
  json_object_set_new(o, "joint_gap", json_real(report->separation));
  bool rests = report->moving_s < s->time_s;
  json_object_set_new(o, "rest_time", rests ? json_real(report->moving_s) : json_null());
}

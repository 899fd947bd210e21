#include "rigid_report.h"

#include <math.h>

#include "sbrun/rigid.h"

static const double REST_M_S = 0.01;

bool rigid_report_begin(rigid_report *report, session *s, cli_call *call) {
  double strength = 0;
  *report = (rigid_report){.asked = cli_switch(call, "--ragdoll") || cli_value(call, "--strength")};
  if (!cli_number(call, "--strength", 0, 1e6, &strength)) return false;
  if (!report->asked) return true;
  if (s->asset->rigid_bodies.count == 0) {
    cli_wrong(call, "the file has no rigid bodies");
    return false;
  }
  if (cli_value(call, "--strength")) {
    sbr_rigid_drive drive = sbr_default_rigid_drive();
    drive.strength = (float)strength;
    sbr_character_rigid_drive(s->world, s->character, &drive);
    sbr_character_rigid_mode(s->world, s->character, -1, SBR_RIGID_DRIVEN);
  } else {
    sbr_character_rigid_mode(s->world, s->character, -1, SBR_RIGID_PASSIVE);
  }
  return true;
}

void rigid_report_measure(rigid_report *report, const session *s) {
  if (!report->asked) return;
  for (uint32_t j = 0; j < s->asset->joints.count; j++) {
    sbr_joint_state joint = sbr_character_joint_state(s->world, s->character, j);
    if (joint.broken) continue;
    report->beyond_angle = fmax(report->beyond_angle, (double)joint.beyond_angle);
    report->apart = fmax(report->apart, (double)joint.apart);
  }
  for (uint32_t b = 0; b < s->asset->rigid_bodies.count; b++) {
    sbf_vec3 v = sbr_character_rigid_state(s->world, s->character, b).velocity;
    if (sqrt((double)(v.x * v.x + v.y * v.y + v.z * v.z)) > REST_M_S) report->moving_s = s->time_s;
  }
}

void rigid_report_add(const rigid_report *report, const session *s, json_t *o) {
  if (!report->asked) return;
  json_object_set_new(o, "limit_excess", json_real(report->beyond_angle));
  json_object_set_new(o, "joint_gap", json_real(report->apart));
  bool rests = report->moving_s < s->time_s;
  json_object_set_new(o, "rest_time", rests ? json_real(report->moving_s) : json_null());
}

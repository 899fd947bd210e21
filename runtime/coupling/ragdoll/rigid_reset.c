/* Sets positions of a character's rigid bodies at once. */
#include <string.h>

#include "coupling/ragdoll/ragdoll.h"
#include "math/quat.h"
#include "math/vec3.h"

/* Gives a simulated body the velocities of the file, which turn with the body's frame. */
static void set_initial_velocity(const sbri_rigid_body *body, sbri_rigid_body_state *state) {
  const sbf_rigid_body *source = body->source;
  bool moves = sbri_dot(source->velocity, source->velocity) > 0 ||
               sbri_dot(source->angular_velocity, source->angular_velocity) > 0;
  if (!moves || source->motion != SBF_BODY_MOTION_DYNAMIC || state->mode != SBR_RIGID_PASSIVE) return;
  sbf_quat turned = sbri_quat_multiply(state->pose.rotation, sbri_quat_conjugate(body->axes));
  state->velocity = sbri_rotate(turned, source->velocity);
  state->angular_momentum = sbri_angular_momentum_from_velocity(
      body, state->pose.rotation, sbri_rotate(turned, source->angular_velocity));
}

void sbri_rigid_reset(sbri_character *c, bool as_in_file) {
  const sbri_rigid_model *model = &c->model->rigid;
  if (!model->body_count) return;
  const sbr_rigid_drive drive = sbr_default_rigid_drive();
  if (as_in_file) sbri_rigid_set_drive(c, &drive);
  for (uint32_t b = 0; b < model->body_count; b++) {
    sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    sbri_rigid_set_frame(body, sbri_rigid_target(c, sbri_pose(c), b));
    if (as_in_file) {
      bool dynamic = model->bodies[b].source->motion == SBF_BODY_MOTION_DYNAMIC && model->bodies[b].mass > 0;
      body->mode = dynamic ? SBR_RIGID_PASSIVE : SBR_RIGID_KINEMATIC;
      body->fraction = 1;
    }
    set_initial_velocity(&model->bodies[b], body);
  }
  sbri_rigid_drive(c)->last_step_s = 0;
  sbri_rigid_drive(c)->stored_contacts = 0;
  sbri_reflex_end(c);
  memset(sbri_rigid_joints(c), 0, model->joint_count * sizeof *sbri_rigid_joints(c));
  sbri_rigid_wake(c);
}

void sbri_rigid_move_with_pose(sbri_character *c) {
  if (!c->model->rigid.body_count) return;
  sbri_reflex_end(c);
  sbri_rigid_drive(c)->stored_contacts = 0;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    sbri_rigid_set_frame(&sbri_rigid_bodies(c)[b], sbri_rigid_target(c, sbri_pose(c), b));
  sbri_rigid_wake(c);
}

void sbri_rigid_rebase(sbri_character *c, sbf_vec3 shift) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    sbf_vec3 *at = &sbri_rigid_bodies(c)[b].pose.position;
    *at = sbri_sub(*at, shift);
  }
  for (uint32_t i = 0; c->model->rigid.body_count && i < sbri_rigid_drive(c)->stored_contacts; i++) {
    sbri_stored_contact *kept = &sbri_rigid_kept(c)[i];
    kept->offset -= sbri_dot(kept->normal, shift);
  }
}

void sbri_rigid_copy_state(sbri_character *c, const sbri_character *was) {
  const sbri_rigid_model *model = &c->model->rigid;
  size_t bodies = model->body_count, joints = model->joint_count, kept = sbri_rigid_contact_capacity(model);
  memcpy(sbri_rigid_bodies(c), sbri_rigid_bodies(was), bodies * sizeof(sbri_rigid_body_state));
  memcpy(sbri_rigid_joints(c), sbri_rigid_joints(was), joints * sizeof(sbri_rigid_joint_state));
  memcpy(sbri_rigid_drive(c), sbri_rigid_drive(was), bodies ? sizeof(sbri_rigid_drive_state) : 0);
  memcpy(sbri_rigid_kept(c), sbri_rigid_kept(was), kept * sizeof(sbri_stored_contact));
  memcpy(sbri_rigid_touching(c), sbri_rigid_touching(was), bodies * sizeof(sbri_contact_reports));
}

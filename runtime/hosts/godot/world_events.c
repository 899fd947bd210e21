/* Signals of a step. Their handlers may free any node or step the world, which empties the arrays of events:
 * each event is fetched again, and nodes are looked up. */
#include "clip_player.h"
#include "sbrun/events.h"
#include "sbrun/rigid.h"
#include "soft_character.h"

static gd_variant variant_of(sbr_double3 position) {
  return gd_vector3((sbf_vec3){(float)position.x, (float)position.y, (float)position.z});
}

/* ---- Contacts ---- */

typedef enum contact_kind { CONTACT_BEGINS, CONTACT_ENDS, CONTACT_HITS } contact_kind;

static void emit_contact(const gd_variant *node, contact_kind kind, int32_t soft_body,
    const sbr_contact_event *e, float side, gd_variant with) {
  gd_variant normal = gd_vector3((sbf_vec3){side * e->normal.x, side * e->normal.y, side * e->normal.z});
  if (kind == CONTACT_ENDS)
    GD_DO(node, "emit_signal", gd_name("contact_ended"), gd_int(soft_body), with);
  else if (kind == CONTACT_HITS)
    GD_DO(node, "emit_signal", gd_name("struck"), gd_int(soft_body), variant_of(e->position),
        gd_copy(&normal), gd_float((double)e->speed), with);
  else
    GD_DO(node, "emit_signal", gd_name("contact"), gd_int(soft_body), variant_of(e->position),
        gd_copy(&normal), gd_float((double)e->impulse), with);
  gd_free(&normal);
}

/* Both nodes emit the signal. */
static void emit_contacts(shared_world *shared, contact_kind kind, const sbr_contact_event *e) {
  soft_character *one = shared_world_member(shared, e->a.character),
                 *other = shared_world_member(shared, e->b.character);
  if (one && one != other)
    emit_contact(&one->node, kind, e->a.soft_body, e, 1,
        other ? gd_object(gd_as_object(&other->node))
              : physics_bodies_object(shared_world_bodies(shared), e->b.collider));
  one = shared_world_member(shared, e->a.character), other = shared_world_member(shared, e->b.character);
  if (other && one != other)
    emit_contact(&other->node, kind, e->b.soft_body, e, -1, gd_object(one ? gd_as_object(&one->node) : NULL));
}

static void report_contacts(shared_world *shared) {
  const sbr_world *world = shared_world_get(shared);
  for (uint32_t i = 0; i < sbr_world_get_contact_events(world).begin_count; i++) {
    sbr_contact_event e = sbr_world_get_contact_events(world).begin[i];
    emit_contacts(shared, CONTACT_BEGINS, &e);
  }
  for (uint32_t i = 0; i < sbr_world_get_contact_events(world).hit_count; i++) {
    sbr_contact_event e = sbr_world_get_contact_events(world).hit[i];
    emit_contacts(shared, CONTACT_HITS, &e);
  }
  for (uint32_t i = 0; i < sbr_world_get_contact_events(world).end_count; i++) {
    sbr_contact_event e = sbr_world_get_contact_events(world).end[i];
    emit_contacts(shared, CONTACT_ENDS, &e);
  }
}

/* ---- Feet, tears, sleep ---- */

/* A signal with a number and a position; without the number where `index` is negative. */
static void emit_at(shared_world *shared, sbr_character_id character, const char *signal, int64_t index,
    sbr_double3 position) {
  soft_character *one = shared_world_member(shared, character);
  if (!one) return;
  if (index < 0)
    GD_DO(&one->node, "emit_signal", gd_name(signal), variant_of(position));
  else
    GD_DO(&one->node, "emit_signal", gd_name(signal), gd_int(index), variant_of(position));
}

static void report_feet(shared_world *shared) {
  const sbr_world *world = shared_world_get(shared);
  for (uint32_t i = 0; i < sbr_world_get_foot_events(world).down_count; i++) {
    sbr_foot_event e = sbr_world_get_foot_events(world).down[i];
    emit_at(shared, e.character, "foot_down", e.leg, e.position);
  }
  for (uint32_t i = 0; i < sbr_world_get_foot_events(world).up_count; i++) {
    sbr_foot_event e = sbr_world_get_foot_events(world).up[i];
    emit_at(shared, e.character, "foot_up", e.leg, e.position);
  }
  for (uint32_t i = 0; i < sbr_world_get_foot_events(world).landed_count; i++) {
    sbr_foot_event e = sbr_world_get_foot_events(world).landed[i];
    emit_at(shared, e.character, "landed", -1, e.position);
  }
}

static void report_bodies(shared_world *shared) {
  const sbr_world *world = shared_world_get(shared);
  for (uint32_t i = 0; i < sbr_world_get_tear_events(world).torn_count; i++) {
    sbr_soft_body_event e = sbr_world_get_tear_events(world).torn[i];
    emit_at(shared, e.character, "torn", e.soft_body, e.position);
  }
  for (uint32_t i = 0; i < sbr_world_get_sleep_events(world).asleep_count; i++) {
    sbr_soft_body_event e = sbr_world_get_sleep_events(world).asleep[i];
    emit_at(shared, e.character, "fell_asleep", e.soft_body, e.position);
  }
  for (uint32_t i = 0; i < sbr_world_get_sleep_events(world).awake_count; i++) {
    sbr_soft_body_event e = sbr_world_get_sleep_events(world).awake[i];
    emit_at(shared, e.character, "woke", e.soft_body, e.position);
  }
}

/* The runtime has no events of them. */
static void report_postures(shared_world *shared) {
  static const char *const signals[] = {"rose", "fell", "rising"}; /* by sbr_posture */
  for (uint32_t i = 0; i < shared_world_count(shared); i++) {
    soft_character *one = shared_world_at(shared, i);
    sbr_posture posture = sbr_character_get_posture(one->world, one->id);
    if (posture == one->movement.posture) continue;
    one->movement.posture = posture;
    GD_DO(&one->node, "emit_signal", gd_name(signals[posture]));
  }
}

static void report_clips(shared_world *shared) {
  for (uint32_t i = 0; i < shared_world_count(shared); i++) {
    soft_character *one = shared_world_at(shared, i);
    int32_t ended = clip_player_take_ended(one);
    if (ended < 0) continue;
    const sbf_clip *clip = &one->model->asset->clips.at[ended];
    GD_DO(&one->node, "emit_signal", gd_name("animation_finished"),
        gd_string(clip->name[0] ? clip->name : clip->id));
    i = UINT32_MAX; /* from the first again: a handler may have freed any of them */
  }
}

void world_events_report(shared_world *shared) {
  report_feet(shared);
  report_bodies(shared);
  report_contacts(shared);
  report_postures(shared);
  report_clips(shared);
}

/* Checks gaits: legs that reach the ground, feasible steps, connected bones, moving parts. */
#include "mechanics/vector.h"
#include "validate/rules/bone_chain.h"
#include "validate/validation.h"

typedef struct walker {
  sbfi_validation *v;
  const sbf_gait *gait;
  const char *name, *path;
  double shortest; /* m, reach of the shortest leg */
} walker;

static const char *bone_name(const walker *w, int32_t bone) {
  return sbfi_bone_label(w->v->asset, (uint32_t)bone);
}

static void check_bone(const walker *w, int32_t bone, const char *what, const char *path) {
  if (bone >= 0 && !sbfi_bone_is_descendant(w->v->asset, bone, w->gait->body))
    sbfi_found(w->v, SBF_CODE_GAIT_BONE_OUTSIDE, path, -1, "%s '%s' of gait '%s' is not below '%s'", what,
        bone_name(w, bone), w->name, bone_name(w, w->gait->body));
}

static void check_leg(walker *w, uint32_t number) {
  const sbf_leg *leg = &w->gait->legs.at[number];
  const sbf_ik_chain *chain = &w->v->asset->ik_chains.at[leg->ik];
  sbfi_path path = sbfi_path_of("%s/leg[%u]", w->path, number + 1);
  sbfi_bone_run run = sbfi_bone_run_of(w->v->asset, chain->root, chain->end);
  for (uint32_t k = 0; k < number; k++)
    if (w->gait->legs.at[k].ik == leg->ik) {
      sbfi_found(w->v, SBF_CODE_LEG_REPEATED, path.text, -1,
          "legs %u and %u of gait '%s' both move the chain '%s'", k + 1, number + 1, w->name,
          sbfi_label(chain->name, chain->id));
      break;
    }
  check_bone(w, chain->root, "the leg bone", path.text);
  if (!run.whole || run.reach == 0) return; /* reported with the chain */
  if (w->shortest == 0 || run.reach < w->shortest) w->shortest = run.reach;
  sbfi_d3 displacement =
      sbfi_d3_sub(sbfi_d3_of(leg->home), sbfi_d3_of(w->v->asset->bones.at[chain->root].head));
  double distance = sbfi_d3_length(displacement),
         capacity = run.reach * run.reach - displacement.y * displacement.y;
  if (distance > 1.001 * run.reach)
    sbfi_found(w->v, SBF_CODE_LEG_HOME_BEYOND_REACH, path.text, -1,
        "the home of leg '%s' is %.3g m from '%s', but the leg is %.3g m long", leg->name, distance,
        bone_name(w, chain->root), run.reach);
  else if ((double)w->gait->step_trigger > fmax(sqrt(fmax(capacity, 0)), run.reach / 2))
    sbfi_found(w->v, SBF_CODE_LEG_TRIGGER_BEYOND_REACH, path.text, -1,
        "leg '%s' should step at %.3g m from its home, but it is %.3g m long", leg->name,
        (double)w->gait->step_trigger, run.reach);
}

static void check_legs(walker *w) {
  const sbf_leg_list legs = w->gait->legs;
  uint32_t groups = 1;
  double low = INFINITY, high = -INFINITY;
  for (uint32_t l = 0; l < legs.count; l++) {
    check_leg(w, l);
    double ground = (double)legs.at[l].home.y - (double)legs.at[l].sole;
    low = fmin(low, ground);
    high = fmax(high, ground);
    groups += legs.at[l].group != legs.at[0].group;
  }
  if (legs.count == 0 && w->gait->kind == SBF_GAIT_KIND_WALK)
    sbfi_found(w->v, SBF_CODE_GAIT_NO_LEGS, w->path, -1, "gait '%s' has no legs", w->name);
  if (legs.count > 1 && groups == 1)
    sbfi_found(w->v, SBF_CODE_GAIT_ONE_GROUP, w->path, -1, "all %u legs of gait '%s' are in group %u",
        legs.count, w->name, legs.at[0].group);
  if (w->shortest > 0 && high - low > 0.1 * w->shortest)
    sbfi_found(w->v, SBF_CODE_LEG_UNEVEN, w->path, -1,
        "the soles of gait '%s' have heights from %.3g m to %.3g m", w->name, low, high);
}

static void check_steps(const walker *w) {
  double tick = (double)w->v->asset->environment.control_tick;
  if ((double)w->gait->step_duration < 1.999 * tick)
    sbfi_found(w->v, SBF_CODE_GAIT_STEP_TOO_SHORT, w->path, -1,
        "a step of gait '%s' takes %.3g s, a control tick %.3g s", w->name, (double)w->gait->step_duration,
        tick);
  if (w->shortest > 0 && (double)w->gait->step_height > w->shortest)
    sbfi_found(w->v, SBF_CODE_GAIT_STEP_TOO_HIGH, w->path, -1,
        "a step of gait '%s' is %.3g m high, but a leg is %.3g m long", w->name, (double)w->gait->step_height,
        w->shortest);
}

static void check_tails(const walker *w) {
  for (uint32_t t = 0; t < w->gait->tails.count; t++) {
    const sbf_chain *chain = &w->v->asset->chains.at[w->gait->tails.at[t].chain];
    sbfi_path path = sbfi_path_of("%s/tail[%u]", w->path, t + 1);
    if (chain->bones.count) check_bone(w, (int32_t)chain->bones.at[0], "the tail bone", path.text);
    for (uint32_t k = 0; k < t; k++)
      if (w->gait->tails.at[k].chain == w->gait->tails.at[t].chain)
        sbfi_found(w->v, SBF_CODE_FOLLOWER_REPEATED, path.text, -1,
            "tails %u and %u of gait '%s' move the same chain", k + 1, t + 1, w->name);
  }
}

static bool has_length(sbf_vec3 axis) {
  return axis.x != 0 || axis.y != 0 || axis.z != 0;
}

/* Checks the bones of a part: a minimum number, each below the gait's body. */
static void check_bones(
    const walker *w, sbf_u32_list bones, uint32_t fewest, const char *part, uint32_t number) {
  sbfi_path path =
      number ? sbfi_path_of("%s/%s[%u]", w->path, part, number) : sbfi_path_of("%s/%s", w->path, part);
  if (bones.count < fewest)
    sbfi_found(w->v, SBF_CODE_GAIT_CHAIN_SHORT, path.text, -1, "the %s of gait '%s' has %u bones", part,
        w->name, bones.count);
  for (uint32_t b = 0; b < bones.count; b++) {
    for (uint32_t k = 0; k < b; k++)
      if (bones.at[k] == bones.at[b]) {
        sbfi_found(w->v, SBF_CODE_BONE_REPEATED, path.text, (int64_t)b, "'%s' is listed twice",
            bone_name(w, (int32_t)bones.at[b]));
        break;
      }
    check_bone(w, (int32_t)bones.at[b], "the bone", path.text);
  }
}

static void check_axis(const walker *w, sbf_vec3 axis, const char *part, uint32_t number) {
  sbfi_path path = sbfi_path_of("%s/%s[%u]/@axis", w->path, part, number);
  if (!has_length(axis))
    sbfi_found(w->v, SBF_CODE_GAIT_AXIS_ZERO, path.text, -1, "the axis of %s %u of gait '%s' has no length",
        part, number, w->name);
}

/* Checks parts that move a swimmer, a flier, or wheels. */
static void check_parts(const walker *w) {
  const sbf_gait *gait = w->gait;
  const sbf_asset *asset = w->v->asset;
  bool idle = gait->kind == SBF_GAIT_KIND_SWIM      ? !gait->undulation && !gait->fins.count
              : gait->kind == SBF_GAIT_KIND_SLITHER ? !gait->undulation
              : gait->kind == SBF_GAIT_KIND_ROLL    ? !gait->wheels.count && !gait->treads.count
                                                    : false;
  if (idle && gait->move_clip == SBF_NONE)
    sbfi_found(w->v, SBF_CODE_GAIT_NOTHING_MOVES, w->path, -1,
        "gait '%s' should %s, but no bone moves for it", w->name, sbf_gait_kind_name(gait->kind));
  if (gait->rest_pose != SBF_NONE && asset->poses.at[gait->rest_pose].distance != 0)
    sbfi_found(w->v, SBF_CODE_GAIT_POSE_WALKS, w->path, -1,
        "the rest pose of gait '%s' is at %.3g m of a walk", w->name,
        (double)asset->poses.at[gait->rest_pose].distance);
  if (gait->undulation) check_bones(w, gait->undulation->bones, 2, "undulation", 0);
  for (uint32_t f = 0; f < gait->fins.count; f++) {
    check_bones(w, gait->fins.at[f].bones, 1, "fin", f + 1);
    check_axis(w, gait->fins.at[f].axis, "fin", f + 1);
  }
  for (uint32_t k = 0; k < gait->wheels.count; k++) {
    check_bone(w, gait->wheels.at[k].bone, "the wheel", w->path);
    check_axis(w, gait->wheels.at[k].axis, "wheel", k + 1);
  }
  for (uint32_t k = 0; k < gait->treads.count; k++)
    check_bones(w, gait->treads.at[k].bones, 2, "tread", k + 1);
}

void sbfi_check_gaits(sbfi_validation *v) {
  for (uint32_t g = 0; g < v->asset->gaits.count; g++) {
    const sbf_gait *gait = &v->asset->gaits.at[g];
    sbfi_path path = sbfi_path_of("/sbf/gait[%u]", g + 1);
    walker w = {v, gait, sbfi_label(gait->name, gait->id), path.text, 0};
    check_legs(&w);
    check_steps(&w);
    check_bone(&w, gait->hips, "the hip bone", path.text);
    check_bone(&w, gait->chest, "the chest bone", path.text);
    if (gait->head) check_bone(&w, gait->head->bone, "the head bone", path.text);
    check_tails(&w);
    check_parts(&w);
  }
}

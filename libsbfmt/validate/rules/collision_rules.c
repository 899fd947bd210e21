/* Checks collision: layers and masks that allow contacts, sizes that fit the body. */
#include "validate/rules/pose.h"
#include "validate/validation.h"

/* Objects with equal layer and mask are one kind; files have few kinds. */
typedef struct kind {
  uint32_t layer, mask;
  const char *name;
  sbfi_path path; /* of the first object */
} kind;

enum { MAX_KINDS = 64 };

static void add_kind(kind *kinds, uint32_t *count, const kind *one) {
  for (uint32_t i = 0; i < *count; i++)
    if (kinds[i].layer == one->layer && kinds[i].mask == one->mask) return;
  if (*count < MAX_KINDS) kinds[(*count)++] = *one;
}

static void check_pairs(sbfi_validation *v, const kind *kinds, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    for (uint32_t k = 0; k < i; k++) {
      bool a_to_b = kinds[i].mask & kinds[k].layer, b_to_a = kinds[k].mask & kinds[i].layer;
      if (a_to_b == b_to_a) continue;
      const kind *collides = a_to_b ? &kinds[i] : &kinds[k], *other = a_to_b ? &kinds[k] : &kinds[i];
      sbfi_found(v, SBF_CODE_COLLISION_ONE_SIDED, collides->path.text, -1,
          "the mask of '%s' has the layer of '%s', but not the other way round", collides->name, other->name);
    }
}

static void check_body(sbfi_validation *v, const sbf_soft_body *body, const char *path) {
  const sbf_collision *is = &body->collision;
  double size = sbfi_extent(body->surface.positions);
  if (is->self && !(is->layer & is->mask))
    sbfi_found(v, SBF_CODE_COLLISION_SELF_MASKED, path, -1, "'%s' has the layer %u and the mask %u",
        sbfi_label(body->name, body->id), is->layer, is->mask);
  if (size > 0 && (double)is->particle_radius > size)
    sbfi_found(v, SBF_CODE_PARTICLE_TOO_LARGE, path, -1,
        "the particle radius of '%s' is %.3g m, but the body measures %.3g m",
        sbfi_label(body->name, body->id), (double)is->particle_radius, size);
}

void sbfi_check_collisions(sbfi_validation *v) {
  const sbf_soft_body_list soft = v->asset->soft_bodies;
  const sbf_rigid_body_list rigid = v->asset->rigid_bodies;
  uint32_t count = 0;
  kind *kinds = sbfi_scratch(v, MAX_KINDS, sizeof *kinds);
  if (!kinds) return;
  for (uint32_t i = 0; i < soft.count; i++) {
    kind one = {soft.at[i].collision.layer, soft.at[i].collision.mask,
        sbfi_label(soft.at[i].name, soft.at[i].id), sbfi_path_of("/sbf/soft_body[%u]", i + 1)};
    check_body(v, &soft.at[i], sbfi_path_of("%s/collision", one.path.text).text);
    add_kind(kinds, &count, &one);
  }
  for (uint32_t i = 0; i < rigid.count; i++) {
    kind one = {rigid.at[i].layer, rigid.at[i].mask, sbfi_label(rigid.at[i].name, rigid.at[i].id),
        sbfi_path_of("/sbf/rigid_bodies/rigid_body[%u]", i + 1)};
    add_kind(kinds, &count, &one);
  }
  check_pairs(v, kinds, count);
}

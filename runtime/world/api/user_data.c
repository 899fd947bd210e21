/* User pointers of bodies, and checks whether bodies and joints exist. */
#include <string.h>

#include "sbrun/rigid.h"
#include "sbrun/soft_body.h"
#include "world/api/api.h"

static size_t count_bodies(const sbr_model *model) {
  return (size_t)model->asset->soft_bodies.count + model->asset->rigid_bodies.count;
}

bool sbri_body_user_data_create(const sbf_allocator *allocator, const sbr_model *model, void ***data) {
  size_t size = count_bodies(model) * sizeof **data;
  *data = size ? sbfi_allocate(allocator, size) : NULL;
  if (*data) memset(*data, 0, size);
  return *data || !size;
}

void sbri_body_user_data_free(const sbf_allocator *allocator, const sbr_model *model, void **data) {
  if (data) sbfi_free(allocator, data, count_bodies(model) * sizeof *data);
}

static void **soft_data_of(const sbr_world *world, sbr_character_id character, uint32_t soft_body) {
  const sbri_character *c = sbri_character_of(world, character);
  return c && soft_body < c->model->asset->soft_bodies.count ? &c->body_user_data[soft_body] : NULL;
}

static void **rigid_data_of(const sbr_world *world, sbr_character_id character, uint32_t rigid_body) {
  const sbri_character *c = sbri_character_of(world, character);
  if (!c || rigid_body >= c->model->asset->rigid_bodies.count) return NULL;
  return &c->body_user_data[c->model->asset->soft_bodies.count + rigid_body];
}

bool sbr_character_has_soft_body(const sbr_world *world, sbr_character_id character, uint32_t soft_body) {
  return soft_data_of(world, character, soft_body) != NULL;
}

void sbr_character_set_soft_user_data(
    sbr_world *world, sbr_character_id character, uint32_t soft_body, void *user_data) {
  void **data = soft_data_of(world, character, soft_body);
  if (data) *data = user_data;
}

void *sbr_character_get_soft_user_data(
    const sbr_world *world, sbr_character_id character, uint32_t soft_body) {
  void **data = soft_data_of(world, character, soft_body);
  return data ? *data : NULL;
}

bool sbr_character_has_rigid_body(const sbr_world *world, sbr_character_id character, uint32_t rigid_body) {
  return rigid_data_of(world, character, rigid_body) != NULL;
}

bool sbr_character_has_joint(const sbr_world *world, sbr_character_id character, uint32_t joint) {
  const sbri_character *c = sbri_character_of(world, character);
  return c && joint < c->model->asset->joints.count;
}

void sbr_character_set_rigid_user_data(
    sbr_world *world, sbr_character_id character, uint32_t rigid_body, void *user_data) {
  void **data = rigid_data_of(world, character, rigid_body);
  if (data) *data = user_data;
}

void *sbr_character_get_rigid_user_data(
    const sbr_world *world, sbr_character_id character, uint32_t rigid_body) {
  void **data = rigid_data_of(world, character, rigid_body);
  return data ? *data : NULL;
}

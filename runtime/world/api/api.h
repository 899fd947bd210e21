/* Shared parts of public calls. */
#ifndef SBRI_API_H
#define SBRI_API_H

#include "state/world.h"

/* ---- world/api/collider_host.c ---- */

bool sbri_collider_set_make(sbri_collider_set *set, uint32_t capacity, const sbf_allocator *allocator);
void sbri_collider_set_free(sbri_collider_set *set, const sbf_allocator *allocator);

/* ---- world/api/user_data.c ---- */

/* Pointers of the model's bodies, all NULL; false if memory runs out. */
bool sbri_body_user_data_create(const sbf_allocator *allocator, const sbr_model *model, void ***data);
void sbri_body_user_data_free(const sbf_allocator *allocator, const sbr_model *model, void **data);

/* ---- world/api/record.c ---- */

/* Call after a step: records the hash once per second. */
void sbri_record_hash(sbr_world *world);

/* ---- world/api/detail_host.c ---- */

/* Sets the `index`-th of `count` views, as in recordings. */
void sbri_view_set(sbr_world *world, uint32_t index, uint32_t count, const sbr_view *view);
void sbri_detail_free(sbr_world *world);

#endif

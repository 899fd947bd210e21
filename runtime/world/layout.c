/* Offsets of the parts of a character's state and scratch memory. */
#include "collide/host_body.h"
#include "world/state.h"

static size_t position(size_t *end, size_t count, size_t size) {
  size_t at = (*end + 63) & ~(size_t)63;
  *end = at + count * size;
  return at;
}

static size_t padded(size_t count) {
  return (count + SBRI_BLOCK - 1) / SBRI_BLOCK * SBRI_BLOCK;
}

size_t sbri_deltas_size(const sbr_model *model) {
  return model->frame_count * sizeof(sbri_delta) + model->asset->followers.count * sizeof(sbri_squash);
}

/* Sizes that are not counts of the model. */
typedef struct extents {
  size_t vertices, faces, groups;              /* of the largest skin */
  size_t surface, surface_faces;               /* of all bodies' surfaces, padded */
  size_t contacts, contact_blocks, self_faces; /* of all bodies */
} extents;

static size_t larger(size_t a, size_t b) {
  return a > b ? a : b;
}

static void measure_skins(const sbr_model *model, extents *e) {
  for (uint32_t i = 0; i < model->skin_count; i++) {
    const sbri_skin *skin = &model->skins[i];
    e->vertices = larger(e->vertices, skin->vertex_count);
    e->faces = larger(e->faces, skin->face_block_count);
    e->groups = larger(e->groups, larger(skin->split.group_count, skin->smooth.group_count));
  }
}

/* Capacity of contacts: each sample, or point, with the ground and with one collider, a few between several
 * colliders, and self-contacts of points and edges. A quarter of the coarse edges may be in contact with
 * ridges at once. */
static uint32_t max_contacts(const sbri_body *body) {
  uint32_t slots = body->slot_end - body->slot_begin;
  uint32_t own = body->self_face_count ? slots + body->self_face_count : 0;
  uint32_t edges = body->coarse_edge_count / 4 + (body->coarse_edge_count ? 32 : 0);
  return body->level ? 2 * (body->samples ? body->sample_count : slots) + own + edges + 64 : 0;
}

/* Assigns each body its part of the arrays that all bodies share. */
static void distribute(sbr_model *model, extents *e) {
  for (uint32_t i = 0; i < model->asset->soft_bodies.count; i++) {
    sbri_body *body = &model->bodies[i];
    body->first_vertex = (uint32_t)e->surface;
    body->first_face = (uint32_t)e->surface_faces;
    body->first_soft_contact = (uint32_t)e->contacts;
    body->first_self_face = (uint32_t)e->self_faces;
    body->max_contacts = max_contacts(body);
    body->first_contact_block = (uint32_t)e->contact_blocks;
    body->max_contact_blocks = (body->max_contacts + SBRI_BLOCK - 1) / SBRI_BLOCK;
    e->surface += padded(body->surface.vertex_count);
    e->surface_faces += (size_t)body->surface.face_block_count * SBRI_BLOCK;
    e->contacts += body->max_contacts;
    e->contact_blocks += body->max_contact_blocks;
    e->self_faces += body->self_face_count;
  }
}

/* State is copied by snapshots and covered by the hash. */
static void lay_out_state(sbr_model *model) {
  sbri_layout *l = &model->layout;
  size_t slots = model->slot_count, frames = model->frame_count, end = 0;
  position(&end, 1, sizeof(sbri_character_state));
  l->loads = position(&end, SBR_LOAD_CAPACITY, sizeof(sbri_load));
  const sbr_model *base = model->base;
  uint32_t meshes = base->detail_level_count > 1 ? model->asset->render_meshes.count : 0;
  l->faded = position(&end, meshes ? base->first_vertices[meshes] : 0, sizeof(sbri_fading_vertex));
  l->gait = position(&end, 1, sbri_gait_state_size(&model->rig));
  l->pose = position(&end, frames, sizeof(sbr_transform));
  l->previous_pose = position(&end, frames, sizeof(sbr_transform));
  l->islands = position(&end, model->island_count, sizeof(sbri_island_state));
  l->positions = position(&end, slots, sizeof(sbri_point));
  l->previous_positions = position(&end, slots, sizeof(sbri_point));
  l->velocities = position(&end, 3 * slots, sizeof(float));
  l->driver_motions = position(&end, model->asset->soft_bodies.count, sizeof(sbri_driver_motion));
  l->rests = position(&end, model->flow_count, sizeof(float));
  l->strengths = position(&end, model->flow_count, sizeof(float));
  l->rotations = position(&end, 4 * SBRI_BLOCK * (size_t)model->region_block_count, sizeof(float));
  l->solids = position(&end, model->solid_block_count, sizeof(sbri_tetrahedron_block));
  l->torn = position(&end, model->solid_count, sizeof(uint32_t));
  size_t torn_slots = model->splits ? slots : 0;
  l->origins = position(&end, torn_slots, sizeof(uint32_t));
  l->masses = position(&end, torn_slots, sizeof(float));
  l->inverse_masses = position(&end, torn_slots, sizeof(float));
  l->gravity_scales = position(&end, torn_slots, sizeof(float));
  size_t thread_cells = model->thread_cell_count;
  l->thread_ends = position(&end, model->thread_block_count, sizeof(uint32_t));
  l->thread_cells = position(&end, thread_cells, sizeof(sbri_spring_cell));
  l->thread_damping = position(&end, thread_cells * SBRI_BLOCK, sizeof(float));
  l->thread_slack = position(&end, thread_cells * SBRI_BLOCK, sizeof(float));
  l->thread_links = position(&end, thread_cells * SBRI_BLOCK, sizeof(uint32_t));
  l->thread_blocks = position(&end, model->thread_link_count, sizeof(sbri_link_block));
  l->skin_cells = position(&end, model->torn_cell_count, sizeof(sbri_carry_cell));
  l->bound_to = position(&end, model->binding_count, sizeof(uint32_t));
  l->torn_polygons = position(&end, model->torn_polygon_count, sizeof(uint32_t));
  l->rigid_bodies = position(&end, model->rigid.body_count, sizeof(sbri_rigid_body_state));
  l->rigid_joints = position(&end, model->rigid.joint_count, sizeof(sbri_rigid_joint_state));
  l->rigid_drive = position(&end, model->rigid.body_count ? 1 : 0, sizeof(sbri_rigid_drive_state));
  l->rigid_kept = position(&end, sbri_rigid_contact_capacity(&model->rigid), sizeof(sbri_stored_contact));
  l->jiggles = position(&end, model->jiggle_count, sizeof(sbri_position_follower));
  l->used_size = l->state_size = (end + 63) & ~(size_t)63;
}

/* Scratch has no content between calls. */
static void lay_out_scratch(sbr_model *model, const extents *e) {
  sbri_layout *l = &model->layout;
  size_t slots = model->slot_count, frames = model->frame_count, end = 0;
  l->deltas = position(&end, 1, sbri_deltas_size(model));
  l->previous_deltas = position(&end, 1, sbri_deltas_size(model));
  l->animated = position(&end, model->rigid.body_count ? frames : 0, sizeof(sbr_transform));
  l->rigid_targets = position(&end, model->rigid.body_count, sizeof(sbr_transform));
  l->reactions = position(&end, model->rigid.body_count, sizeof(sbri_reaction));
  l->burdens = position(&end, model->rigid.body_count, sizeof(sbri_rigid_burden));
  l->stepped_pose = position(&end, model->rigid.body_count ? frames : 0, sizeof(sbr_transform));
  l->rigid_work_size = sbri_rigid_work_size(&model->rigid);
  l->gait_before = position(&end, 1, sbri_gait_state_size(&model->rig));
  l->targets = position(&end, slots, sizeof(sbri_point));
  l->driver_velocities = position(&end, 3 * slots, sizeof(float));
  l->begins = position(&end, slots, sizeof(sbri_point));
  l->velocity_points = position(&end, slots, sizeof(sbri_point));
  l->external_forces = position(&end, slots, sizeof(sbri_point));
  l->accelerations = position(&end, 3 * slots, sizeof(float));
  l->older_velocities = position(&end, 3 * slots, sizeof(float));
  l->moves = position(&end, slots, sizeof(sbri_point));
  l->edges = position(&end, (size_t)model->link_block_count * 3 * SBRI_BLOCK, sizeof(float));
  l->solid_edges = position(&end, (size_t)model->tetrahedron_block_count * 9 * SBRI_BLOCK, sizeof(float));
  l->tears = position(&end, model->island_count, sizeof(sbri_tears));
  l->element_forces = position(&end, slots, sizeof(sbri_point));
  l->planes = position(&end, 4 * slots, sizeof(float));
  l->pressing = position(&end, 2 * slots, sizeof(float));
  l->near_ground = position(&end, slots / SBRI_BLOCK + 1, 1);
  l->contacts = position(&end, e->contacts, sizeof(sbri_soft_contact));
  l->contact_blocks = position(&end, e->contact_blocks, sizeof(sbri_contact_block));
  l->contact_block_counts = position(&end, model->asset->soft_bodies.count, sizeof(uint32_t));
  l->contact_slots = position(&end, slots / SBRI_BLOCK + 1, 1);
  l->contact_islands = position(&end, model->island_count, 1);
  l->contact_counts = position(&end, model->asset->soft_bodies.count, sizeof(uint32_t));
  l->external_bodies =
      position(&end, model->island_count ? model->asset->soft_bodies.count : 0, sizeof(sbri_external_bodies));
  l->slot_contacts = position(&end, slots, 1);
  l->contact_weights = position(&end, slots, sizeof(float));
  l->self_boxes = position(&end, e->self_faces, sizeof(sbri_box));
  l->self_balls = position(&end, e->self_faces, sizeof(sbri_moving_ball));
  l->self_nodes =
      position(&end, 2 * e->self_faces + model->asset->soft_bodies.count, sizeof(sbri_bounds_node));
  l->self_items = position(&end, e->self_faces, sizeof(uint32_t));
  l->self_edges = position(&end, e->self_faces, 1);
  l->touching = position(&end, model->asset->soft_bodies.count, sizeof(sbri_touching));
  l->rigid_touching = position(&end, model->rigid.body_count, sizeof(sbri_touching));
  l->sampled = position(&end, slots, sizeof(sbri_point));
  l->sampled_deltas = position(&end, 1, sbri_deltas_size(model));
  l->vertices = position(&end, padded(e->vertices), sizeof(sbri_point));
  l->faces = position(&end, e->faces * SBRI_BLOCK, sizeof(sbri_point));
  l->sums = position(&end, padded(larger(e->groups, e->vertices)), sizeof(sbri_point));
  l->loads_now = position(&end, 1, sizeof(sbri_loads_now_list));
  l->visits = position(&end, 2 * (size_t)model->solid_count, sizeof(uint32_t));
  l->queue = position(&end, model->solid_count, sizeof(uint32_t));
  l->touched = position(&end, model->binding_count, 1);
  l->owners = position(&end, model->thread_cell_count ? 2 * slots : 0, sizeof(uint32_t));
  l->frayed = position(&end, model->thread_cell_count ? slots : 0, 1);
  l->surface_vertices = position(&end, e->surface, sizeof(sbri_point));
  bool steps = model->island_count > 0; /* without islands only vertices are queried */
  l->surface_forces = position(&end, steps ? e->surface : 0, sizeof(sbri_point));
  l->surface_velocities = position(&end, steps ? e->surface : 0, sizeof(sbri_point));
  l->surface_faces = position(&end, steps ? e->surface_faces : 0, sizeof(sbri_point));
  if (model->base->detail_level_count > 1) {
    size_t bodies = model->asset->soft_bodies.count;
    l->offsets = l->begins, l->speeds = l->moves; /* these arrays are unused between ticks */
    l->energies = position(&end, bodies, sizeof(double));
    l->fading = position(&end, padded(e->vertices), sizeof(sbri_point));
    l->pulls = position(&end, bodies + 1, sizeof(float));
  }
  l->scratch_size = (end + 63) & ~(size_t)63;
}

static void make_layout(sbr_model *model) {
  extents e = {0};
  measure_skins(model, &e);
  distribute(model, &e);
  lay_out_state(model);
  lay_out_scratch(model, &e);
}

void sbri_layouts_make(sbr_model *model) {
  for (uint32_t r = 0; r < model->detail_level_count; r++) {
    sbr_model *one = model->levels[r];
    make_layout(one);
    model->detail_levels[r].bytes = sbri_character_storage_size(one);
    if (one->layout.state_size > model->max_state_size) model->max_state_size = one->layout.state_size;
  }
}

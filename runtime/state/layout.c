/* Offsets of the parts of a character's state and scratch memory. */
#include "shapes/host_body.h"
#include "state/state.h"

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
  for (uint32_t i = 0; i < model->skins.count; i++) {
    const sbri_skin *skin = &model->skins.at[i];
    e->vertices = larger(e->vertices, skin->vertex_count);
    e->faces = larger(e->faces, skin->face_block_count);
    e->groups = larger(e->groups, larger(skin->normals.split.group_count, skin->normals.smooth.group_count));
  }
}

/* Capacity of contacts: each sample, or point, with the ground and with one collider, a few between several
 * colliders, and self-contacts of points and edges. A quarter of the coarse edges may be in contact with
 * ridges at once. */
static uint32_t max_contacts(const sbri_body *body) {
  uint32_t slots = body->slots.end - body->slots.begin;
  uint32_t own = body->self.face_count ? slots + body->self.face_count : 0;
  uint32_t edges = body->contact.coarse_edge_count / 4 + (body->contact.coarse_edge_count ? 32 : 0);
  return body->level ? 2 * (body->contact.samples ? body->contact.sample_count : slots) + own + edges + 64
                     : 0;
}

/* Assigns each body its part of the arrays that all bodies share. */
static void distribute(sbr_model *model, extents *e) {
  for (uint32_t i = 0; i < model->asset->soft_bodies.count; i++) {
    sbri_body *body = &model->bodies[i];
    body->surface.first_vertex = (uint32_t)e->surface;
    body->surface.first_face = (uint32_t)e->surface_faces;
    body->contact.first = (uint32_t)e->contacts;
    body->self.first_face = (uint32_t)e->self_faces;
    body->contact.max_count = max_contacts(body);
    body->contact.first_block = (uint32_t)e->contact_blocks;
    body->contact.max_blocks = (body->contact.max_count + SBRI_BLOCK - 1) / SBRI_BLOCK;
    e->surface += padded(body->surface.skin.vertex_count);
    e->surface_faces += (size_t)body->surface.skin.face_block_count * SBRI_BLOCK;
    e->contacts += body->contact.max_count;
    e->contact_blocks += body->contact.max_blocks;
    e->self_faces += body->self.face_count;
  }
}

/* State is copied by snapshots and covered by the hash. */
static void lay_out_state(sbr_model *model) {
  sbri_layout *l = &model->layout;
  size_t slots = model->slot_count, frames = model->frame_count, end = 0;
  position(&end, 1, sizeof(sbri_character_state));
  l->loads = position(&end, SBR_LOAD_CAPACITY, sizeof(sbri_load));
  const sbr_model *base = model->detail.base;
  uint32_t meshes = base->detail.level_count > 1 ? model->asset->render_meshes.count : 0;
  l->detail.faded =
      position(&end, meshes ? base->detail.first_vertices[meshes] : 0, sizeof(sbri_fading_vertex));
  l->pose.gait = position(&end, 1, sbri_gait_state_size(&model->rig));
  l->pose.current = position(&end, frames, sizeof(sbr_transform));
  l->pose.previous = position(&end, frames, sizeof(sbr_transform));
  l->islands = position(&end, model->island_count, sizeof(sbri_island_state));
  l->points.positions = position(&end, slots, sizeof(sbri_point));
  l->points.previous_positions = position(&end, slots, sizeof(sbri_point));
  l->points.velocities = position(&end, 3 * slots, sizeof(float));
  l->pose.driver_motions = position(&end, model->asset->soft_bodies.count, sizeof(sbri_driver_motion));
  l->springs.rests = position(&end, model->counts.flows, sizeof(float));
  l->springs.strengths = position(&end, model->counts.flows, sizeof(float));
  l->solids.rotations = position(&end, 4 * SBRI_BLOCK * (size_t)model->counts.region_blocks, sizeof(float));
  l->solids.blocks = position(&end, model->counts.state_tetrahedron_blocks, sizeof(sbri_tetrahedron_block));
  l->solids.torn = position(&end, model->counts.state_tetrahedra, sizeof(uint32_t));
  size_t torn_slots = model->splits ? slots : 0;
  l->split.origins = position(&end, torn_slots, sizeof(uint32_t));
  l->split.masses = position(&end, torn_slots, sizeof(float));
  l->split.inverse_masses = position(&end, torn_slots, sizeof(float));
  l->split.gravity_scales = position(&end, torn_slots, sizeof(float));
  size_t thread_cells = model->counts.torn_cells;
  l->springs.ends = position(&end, model->counts.torn_blocks, sizeof(uint32_t));
  l->springs.cells = position(&end, thread_cells, sizeof(sbri_spring_cell));
  l->springs.damping = position(&end, thread_cells * SBRI_BLOCK, sizeof(float));
  l->springs.slack = position(&end, thread_cells * SBRI_BLOCK, sizeof(float));
  l->springs.links = position(&end, thread_cells * SBRI_BLOCK, sizeof(uint32_t));
  l->springs.blocks = position(&end, model->counts.torn_link_blocks, sizeof(sbri_link_block));
  l->split.skin_cells = position(&end, model->counts.skin_cells, sizeof(sbri_volume_cell));
  l->split.bound_to = position(&end, model->counts.bindings, sizeof(uint32_t));
  l->split.polygons = position(&end, model->counts.polygons, sizeof(uint32_t));
  l->rigid.bodies = position(&end, model->rigid.body_count, sizeof(sbri_rigid_body_state));
  l->rigid.joints = position(&end, model->rigid.joint_count, sizeof(sbri_rigid_joint_state));
  l->rigid.drive = position(&end, model->rigid.body_count ? 1 : 0, sizeof(sbri_rigid_drive_state));
  l->rigid.stored_contacts =
      position(&end, sbri_rigid_contact_capacity(&model->rigid), sizeof(sbri_stored_contact));
  l->pose.jiggles = position(&end, model->jiggle_count, sizeof(sbri_position_follower));
  l->used_size = l->state_size = (end + 63) & ~(size_t)63;
}

/* Scratch has no content between calls. */
static void lay_out_scratch(sbr_model *model, const extents *e) {
  sbri_layout *l = &model->layout;
  size_t slots = model->slot_count, frames = model->frame_count, end = 0;
  l->pose.deltas = position(&end, 1, sbri_deltas_size(model));
  l->pose.previous_deltas = position(&end, 1, sbri_deltas_size(model));
  l->pose.animated = position(&end, model->rigid.body_count ? frames : 0, sizeof(sbr_transform));
  l->rigid.targets = position(&end, model->rigid.body_count, sizeof(sbr_transform));
  l->rigid.reactions = position(&end, model->rigid.body_count, sizeof(sbri_reaction));
  l->rigid.attached_loads = position(&end, model->rigid.body_count, sizeof(sbri_attached_load));
  l->pose.stepped = position(&end, model->rigid.body_count ? frames : 0, sizeof(sbr_transform));
  l->rigid.work_size = sbri_rigid_work_size(&model->rigid);
  l->pose.gait_before = position(&end, 1, sbri_gait_state_size(&model->rig));
  l->points.targets = position(&end, slots, sizeof(sbri_point));
  l->points.driver_velocities = position(&end, 3 * slots, sizeof(float));
  l->points.begins = position(&end, slots, sizeof(sbri_point));
  l->points.velocity_points = position(&end, slots, sizeof(sbri_point));
  l->points.external_forces = position(&end, slots, sizeof(sbri_point));
  l->points.accelerations = position(&end, 3 * slots, sizeof(float));
  l->points.older_velocities = position(&end, 3 * slots, sizeof(float));
  l->points.moves = position(&end, slots, sizeof(sbri_point));
  l->springs.edges = position(&end, (size_t)model->counts.link_blocks * 3 * SBRI_BLOCK, sizeof(float));
  l->solids.edges = position(&end, (size_t)model->counts.tetrahedron_blocks * 9 * SBRI_BLOCK, sizeof(float));
  l->solids.compressed = position(&end, model->counts.tetrahedron_blocks, 1);
  l->solids.tears = position(&end, model->island_count, sizeof(sbri_tears));
  l->points.element_forces = position(&end, slots + model->counts.force_entries, sizeof(sbri_point));
  l->contacts.planes = position(&end, 4 * slots, sizeof(float));
  l->contacts.pressing = position(&end, 2 * slots, sizeof(float));
  l->contacts.near_ground = position(&end, slots / SBRI_BLOCK + 1, 1);
  l->contacts.at = position(&end, e->contacts, sizeof(sbri_soft_contact));
  l->contacts.blocks = position(&end, e->contact_blocks, sizeof(sbri_contact_block));
  l->contacts.block_counts = position(&end, model->asset->soft_bodies.count, sizeof(uint32_t));
  l->contacts.slots = position(&end, slots / SBRI_BLOCK + 1, 1);
  l->contacts.islands = position(&end, model->island_count, 1);
  l->contacts.counts = position(&end, model->asset->soft_bodies.count, sizeof(uint32_t));
  l->contacts.external_bodies =
      position(&end, model->island_count ? model->asset->soft_bodies.count : 0, sizeof(sbri_external_bodies));
  l->contacts.slot_contacts = position(&end, slots, 1);
  l->contacts.points = position(&end, slots, sizeof(sbri_point_contacts));
  l->contacts.weights = position(&end, slots, sizeof(float));
  l->self.boxes = position(&end, e->self_faces, sizeof(sbri_box));
  l->self.balls = position(&end, e->self_faces, sizeof(sbri_moving_ball));
  l->self.nodes =
      position(&end, 2 * e->self_faces + model->asset->soft_bodies.count, sizeof(sbri_bounds_node));
  l->self.items = position(&end, e->self_faces, sizeof(uint32_t));
  l->self.edges = position(&end, e->self_faces, 1);
  l->contacts.touching = position(&end, model->asset->soft_bodies.count, sizeof(sbri_contact_reports));
  l->rigid.touching = position(&end, model->rigid.body_count, sizeof(sbri_contact_reports));
  l->points.sampled = position(&end, slots, sizeof(sbri_point));
  l->pose.sampled_deltas = position(&end, 1, sbri_deltas_size(model));
  l->skin.vertices = position(&end, padded(e->vertices), sizeof(sbri_point));
  l->skin.faces = position(&end, e->faces * SBRI_BLOCK, sizeof(sbri_point));
  l->skin.sums = position(&end, padded(larger(e->groups, e->vertices)), sizeof(sbri_point));
  l->loads_now = position(&end, 1, sizeof(sbri_loads_now_list));
  l->solids.visits = position(&end, 2 * (size_t)model->counts.state_tetrahedra, sizeof(uint32_t));
  l->solids.queue = position(&end, model->counts.state_tetrahedra, sizeof(uint32_t));
  l->split.touched = position(&end, model->counts.bindings, 1);
  l->springs.owners = position(&end, model->counts.torn_cells ? 2 * slots : 0, sizeof(uint32_t));
  l->springs.torn = position(&end, model->counts.torn_cells ? slots : 0, 1);
  l->surfaces.vertices = position(&end, e->surface, sizeof(sbri_point));
  bool steps = model->island_count > 0; /* without islands only vertices are queried */
  l->surfaces.forces = position(&end, steps ? e->surface : 0, sizeof(sbri_point));
  l->surfaces.velocities = position(&end, steps ? e->surface : 0, sizeof(sbri_point));
  l->surfaces.faces = position(&end, steps ? e->surface_faces : 0, sizeof(sbri_point));
  if (model->detail.base->detail.level_count > 1) {
    size_t bodies = model->asset->soft_bodies.count;
    l->detail.offsets = l->points.begins,
    l->detail.speeds = l->points.moves; /* these arrays are unused between ticks */
    l->detail.energies = position(&end, bodies, sizeof(double));
    l->detail.fading = position(&end, padded(e->vertices), sizeof(sbri_point));
    l->detail.pulls = position(&end, bodies + 1, sizeof(float));
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
  for (uint32_t r = 0; r < model->detail.level_count; r++) {
    sbr_model *one = model->detail.levels[r];
    make_layout(one);
    model->detail.definitions[r].bytes = sbri_character_storage_size(one);
    if (one->layout.state_size > model->detail.max_state_size)
      model->detail.max_state_size = one->layout.state_size;
  }
}

/* Builds a model from an asset: each function fills its part of the tables, and is called by prepare_model.c
 * or by another one. Those that return bool return false if memory runs out. */
#ifndef SBRI_PREPARE_H
#define SBRI_PREPARE_H

#include "model/runtime_model.h"

/* Builds all tables except the layout of a character's state; the model has its asset and arena. */
sbf_status sbri_model_prepare(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error);
/* Refuses lengths beyond 1e6 m and other numbers beyond 1e15. */
sbf_status sbri_number_limits_check(const sbf_asset *asset, sbf_diagnostic *error);

/* ---- Bodies and islands ---- */

/* Groups the bodies into islands; gives each body its level. */
sbf_status sbri_islands_group(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error);
/* Whether the level has a model that is stepped, and was loaded. */
bool sbri_level_has_stepped_model(const sbf_level *level);
bool sbri_level_is_stepped(const sbf_level *level);
/* Whether the error that a level states under gravity is too large a fraction of its body's size. An error
 * measured in motion is always accepted. */
bool sbri_level_has_failed(const sbf_level *level, float size_m);
/* Whether a stepped level has a small enough error for a detail level. */
bool sbri_level_is_useful(const sbf_level *level, float size_m);
/* Whether the springs connect simulated levels. */
bool sbri_cross_springs_act(const sbr_model *model, const sbf_cross_springs *cross);
/* Slots, springs, pins and frequencies of one island. */
sbf_status sbri_island_make(
    sbr_model *model, sbri_island *island, const sbr_model_options *options, sbf_diagnostic *error);
/* Distributes the frames of pinned points over the free ones along the springs. */
bool sbri_drivers_make(sbr_model *model, const sbri_island *island, sbri_body *body);
/* The springs as links. */
bool sbri_links_make(sbr_model *model, sbri_island *island, const sbfi_spring_bounds *bounds);
/* Gas, medium, hinges and fields, and their frequency bounds; call after surfaces and rest volumes. */
bool sbri_external_forces_make(sbr_model *model);
/* Springs that may tear along the edges of polygons over the vertices of `full`'s mesh. */
bool sbri_torn_sides_make(sbr_model *model, sbri_skin *skin, const sbri_skin *full, const sbf_u32_list *sizes,
    const sbf_u32_list *points);
/* The rigid bodies of frames; those that islands act on, with the stiffness; and the soft bodies that are
 * attached to one rigid body only, after all others. The first two return false if memory runs out. */
bool sbri_attachments_list(sbr_model *model);
bool sbri_coupling_make(sbr_model *model);
void sbri_attached_mass_join(sbr_model *model);
/* Neighbouring tetrahedra, and those around each point; false if memory runs out. */
bool sbri_tear_table_make(sbr_model *model, sbri_island *island);
/* Division of the element forces of a large island among tasks; call it when the slots of all islands are
 * known. */
bool sbri_force_parts_make(sbr_model *model, sbri_island *island);
/* Contact samples; call it after the surfaces are made. */
bool sbri_samples_make(sbr_model *model, sbri_body *body);
bool sbri_coarse_edges_make(sbr_model *model, sbri_body *body);
/* Triangles for self-contact, if the body has it; also after the surfaces. */
bool sbri_self_faces_make(sbr_model *model, sbri_body *body);
/* Whether these intersect at rest; call after them. */
bool sbri_self_tangles_find(sbr_model *model, sbri_body *body);
/* Table of the volume gradient of a body that keeps its volume. */
bool sbri_volume_table_make(sbr_model *model, sbri_body *body);

/* ---- Skins and surfaces ---- */

/* A skin of render level 0 has all vertices of the mesh. */
bool sbri_skin_make(sbr_model *model, uint32_t render_mesh, uint32_t render_level);
/* Surface of a body: without normals, with faces for its volume. */
bool sbri_surface_make(sbr_model *model, uint32_t soft_body);

/* Normals and faces of `mesh`; `normals` and `corners` as in sbf_render_mesh, `uvs` may be NULL. */
bool sbri_shading_make(
    sbri_skin *skin, const sbf_polygon_mesh *mesh, const sbf_render_mesh *authored, sbfi_arena *arena);
bool sbri_faces_make(sbri_skin *skin, const sbf_polygon_mesh *mesh, sbfi_arena *arena);
/* Fills in rest_volume_m3 of all bodies. */
bool sbri_rest_volumes_find(sbr_model *model);

/* ---- Detail levels ---- */

/* Builds the other detail levels of a model that is complete except for its layout, each as a model of its
 * own; returns SBF_OK and builds none if a body yields or tears. */
sbf_status sbri_detail_levels_make(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error);
void sbri_detail_levels_free(sbr_model *model);
/* Level of a body's jiggle; NULL: none, or the body has several pin frames. */
const sbf_level *sbri_jiggle_of(const sbr_model *model, uint32_t soft_body);
/* The followers of a jiggle level. */
bool sbri_jiggles_make(sbr_model *model);
/* Weights of the points of `to` in those of `from`. */
bool sbri_sources_make(sbr_model *to, const sbr_model *from, const sbri_sources **sources);

/* ---- Rigid parts ---- */

bool sbri_rigid_model_make(sbri_rigid_model *model, const sbf_asset *asset, sbfi_arena *arena);

#endif

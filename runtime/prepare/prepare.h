/* Making a model of an asset: each of these fills its part of the tables, called by prepare_model.c or by one
 * another. Those that answer true or false say false where memory runs out. */
#ifndef SBRI_PREPARE_H
#define SBRI_PREPARE_H

#include "model/runtime_model.h"

/* All tables but the layout of a character's state, into a model that has its asset and arena. */
sbf_status sbri_model_prepare(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error);
/* Lengths beyond 1e6 m and other numbers beyond 1e15 are refused. */
sbf_status sbri_number_limits_check(const sbf_asset *asset, sbf_diagnostic *error);

/* ---- Bodies and islands ---- */

/* Groups the bodies into islands; gives each body its level. */
sbf_status sbri_islands_group(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error);
/* Whether the level is of a model that is stepped; and was loaded. */
bool sbri_level_has_stepped_model(const sbf_level *level);
bool sbri_level_is_stepped(const sbf_level *level);
/* Whether the error that a level states under gravity is too large a fraction of its body's size. An error
 * measured in motion is always accepted. */
bool sbri_level_has_gone_wrong(const sbf_level *level, float size_m);
/* Whether a level that is stepped is near enough to its body to be a detail level. */
bool sbri_level_is_useful(const sbf_level *level, float size_m);
/* Whether the springs join the levels that are simulated. */
bool sbri_cross_springs_act(const sbr_model *model, const sbf_cross_springs *cross);
/* Slots, springs, pins and frequencies of one island. */
sbf_status sbri_island_make(
    sbr_model *model, sbri_island *island, const sbr_model_options *options, sbf_diagnostic *error);
/* Spreads the frames of held points over the free ones along the springs. */
bool sbri_drivers_make(sbr_model *model, const sbri_island *island, sbri_body *body);
/* The springs as links; false where memory runs out. */
bool sbri_links_make(sbr_model *model, sbri_island *island, const sbfi_spring_bounds *bounds);
/* Gas, medium, hinges and fields, and how fast they make the islands; after surfaces and rest volumes. */
bool sbri_external_forces_make(sbr_model *model);
/* Sides along springs that may tear, of polygons over the vertices of the mesh that `full` is of. */
bool sbri_torn_sides_make(sbr_model *model, sbri_skin *skin, const sbri_skin *full, const sbf_u32_list *sizes,
    const sbf_u32_list *points);
/* The rigid bodies that frames belong to; those that islands act on, with the stiffness; and the soft bodies
 * that are attached to one rigid body only, after all that acts on them. The first two return false if memory
 * runs out. */
bool sbri_carriers_list(sbr_model *model);
bool sbri_coupling_make(sbr_model *model);
void sbri_attached_mass_join(sbr_model *model);
/* Neighbouring tetrahedra, and those around each point; false if memory runs out. */
bool sbri_tear_table_make(sbr_model *model, sbri_island *island);
/* Contact samples; call it after the surfaces are made. */
bool sbri_samples_make(sbr_model *model, sbri_body *body);
bool sbri_coarse_edges_make(sbr_model *model, sbri_body *body);
/* Triangles for self-contact, if the body has it; also after the surfaces. */
bool sbri_self_faces_make(sbr_model *model, sbri_body *body);
/* Whether these go through each other at rest; after them. */
bool sbri_self_tangles_find(sbr_model *model, sbri_body *body);
/* The gradient's table of a body that keeps its volume. */
bool sbri_volume_table_make(sbr_model *model, sbri_body *body);

/* ---- Skins and surfaces ---- */

/* Both false where memory runs out. A skin of render level 0 has all vertices of the mesh. */
bool sbri_skin_make(sbr_model *model, uint32_t render_mesh, uint32_t render_level);
/* Of a body's surface: no normals but the faces, for its volume. */
bool sbri_surface_make(sbr_model *model, uint32_t soft_body);

/* Normals and faces of `mesh`; `normals` and `corners` as in sbf_render_mesh, `uvs` may be NULL. */
bool sbri_shading_make(
    sbri_skin *skin, const sbf_polygon_mesh *mesh, const sbf_render_mesh *authored, sbfi_arena *arena);
bool sbri_faces_make(sbri_skin *skin, const sbf_polygon_mesh *mesh, sbfi_arena *arena);
/* Fills in rest_volume_m3 of all bodies; false where memory runs out. */
bool sbri_rest_volumes_find(sbr_model *model);

/* ---- Detail levels ---- */

/* The other detail levels of a model that is made but for its layout, each a model likewise; SBF_OK and none
 * where a body yields or tears. */
sbf_status sbri_detail_levels_make(sbr_model *model, const sbr_model_options *options, sbf_diagnostic *error);
void sbri_detail_levels_free(sbr_model *model);
/* The level by which a body jiggles; NULL: it has none, or what holds it is not one frame. */
const sbf_level *sbri_jiggle_of(const sbr_model *model, uint32_t soft_body);
/* The followers of a model of jiggle. */
bool sbri_jiggles_make(sbr_model *model);
/* Where the points of `to` are in those of `from`. */
bool sbri_sources_make(sbr_model *to, const sbr_model *from, const sbri_sources **sources);

/* ---- Rigid parts ---- */

bool sbri_rigid_model_make(sbri_rigid_model *model, const sbf_asset *asset, sbfi_arena *arena);

#endif

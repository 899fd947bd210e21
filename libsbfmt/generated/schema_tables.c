// clang-format off
/* Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#include <math.h>

#include "model/schema.h"
#include "sbfmt/model.h"

static const char *const alpha_mode_values[] = {"opaque", "mask", "blend"};
static const char *const attachment_rule_values[] = {"explicit", "inside_hull"};
static const char *const mesh_target_values[] = {"rendering", "surface", "collision_detection"};
static const char *const body_motion_values[] = {"kinematic", "dynamic"};
static const char *const joint_kind_values[] = {"prismatic", "revolute", "cylindrical", "spherical", "point_on_line", "point_in_plane", "distance", "pulley", "fixed", "six_dof"};
static const char *const joint_axis_values[] = {"linear_x", "linear_y", "linear_z", "twist", "swing_y", "swing_z", "swing", "distance"};
static const char *const volume_target_values[] = {"volume"};
static const char *const spring_kind_values[] = {"structural", "shear", "flexion", "internal", "cross_body"};
static const char *const elastic_model_values[] = {"springs", "tetrahedra", "shape_matching", "jiggle"};
static const char *const scheme_values[] = {"automatic", "symplectic", "position_based", "relaxation", "explicit_euler", "heun", "block_descent"};
static const char *const pressure_mode_values[] = {"none", "gas", "volume"};
static const char *const weight_property_values[] = {"density", "young_modulus", "bending_stiffness", "mass_damping", "stiffness_damping", "friction", "pressure", "yield_strain", "tear_strain"};
static const char *const ik_solver_values[] = {"two_bone", "ccd", "fabrik", "damped_least_squares", "spline"};
static const char *const gait_kind_values[] = {"walk", "swim", "fly", "slither", "crawl", "roll", "none"};
static const char *const wave_plane_values[] = {"lateral", "vertical"};
static const char *const fin_motion_values[] = {"flap", "trail", "steer"};
static const char *const chain_kind_values[] = {"lag", "distance"};
static const char *const follower_channel_values[] = {"rotation", "position", "both", "squash", "weight"};
static const char *const bone_axis_values[] = {"x", "y", "z"};
static const char *const chain_collider_shape_values[] = {"sphere", "capsule", "plane"};
static const char *const track_property_values[] = {"translation", "rotation", "scale"};
static const char *const interpolation_values[] = {"linear", "step", "cubic"};
static const char *const field_kind_values[] = {"uniform", "radial", "vortex", "drag"};

static const sbfi_field author_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_author, name), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "contact", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_author, contact), .width = 1, .unit = "", .initial.text = ""},
};
static const sbfi_element author_element = {"author", "author", sizeof(sbf_author), 0, 2, author_fields, NULL};

static const sbfi_field source_fields[] = {
  {.name = "path", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_source, path), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "sha256", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_source, sha256), .width = 1, .unit = "", .initial.text = ""},
};
static const sbfi_element source_element = {"source", "source", sizeof(sbf_source), 0, 2, source_fields, NULL};

static const sbfi_field info_fields[] = {
  {.name = "title", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_info, title), .width = 1, .unit = "", .initial.text = ""},
  {.name = "licence", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_info, licence), .width = 1, .unit = "", .initial.text = ""},
  {.name = "copyright", .type = SBFI_STRING, .number = 3, .since_minor = 0, .offset = offsetof(sbf_info, copyright), .width = 1, .unit = "", .initial.text = ""},
  {.name = "tool", .type = SBFI_STRING, .number = 4, .since_minor = 0, .offset = offsetof(sbf_info, tool), .width = 1, .unit = "", .initial.text = ""},
  {.name = "comment", .type = SBFI_STRING, .number = 5, .since_minor = 0, .offset = offsetof(sbf_info, comment), .width = 1, .unit = "", .initial.text = ""},
  {.name = "authors", .type = SBFI_MANY, .number = 6, .since_minor = 0, .offset = offsetof(sbf_info, authors), .width = 1, .unit = "", .element = &author_element, .tag.xml = "author"},
  {.name = "sources", .type = SBFI_MANY, .number = 7, .since_minor = 0, .offset = offsetof(sbf_info, sources), .width = 1, .unit = "", .element = &source_element, .tag.xml = "source"},
  {.name = "mass", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_info, mass), .width = 1, .unit = "kg", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "low", .type = SBFI_VEC3, .number = 9, .since_minor = 0, .offset = offsetof(sbf_info, low), .width = 3, .unit = "m"},
  {.name = "high", .type = SBFI_VEC3, .number = 10, .since_minor = 0, .offset = offsetof(sbf_info, high), .width = 3, .unit = "m"},
};
static const sbfi_element info_element = {"info", "info", sizeof(sbf_info), 0, 10, info_fields, NULL};

static const sbfi_field derivation_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_derivation, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "tool", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_derivation, tool), .width = 1, .unit = "", .initial.text = ""},
  {.name = "settings", .type = SBFI_STRING, .number = 3, .since_minor = 0, .offset = offsetof(sbf_derivation, settings), .width = 1, .unit = "", .initial.text = ""},
  {.name = "source_hash", .type = SBFI_STRING, .number = 4, .since_minor = 0, .offset = offsetof(sbf_derivation, source_hash), .width = 1, .unit = "", .initial.text = ""},
  {.name = "mass", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_derivation, mass), .width = 1, .unit = "kg", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "low", .type = SBFI_VEC3, .number = 6, .since_minor = 0, .offset = offsetof(sbf_derivation, low), .width = 3, .unit = "m"},
  {.name = "high", .type = SBFI_VEC3, .number = 7, .since_minor = 0, .offset = offsetof(sbf_derivation, high), .width = 3, .unit = "m"},
};
static const sbfi_element derivation_element = {"derivation", "derivation", sizeof(sbf_derivation), 0, 7, derivation_fields, NULL};

static const sbfi_field texture_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_texture, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_texture, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "path", .type = SBFI_STRING, .number = 3, .since_minor = 0, .offset = offsetof(sbf_texture, path), .width = 1, .unit = "", .initial.text = ""},
  {.name = "media_type", .type = SBFI_STRING, .number = 4, .since_minor = 0, .offset = offsetof(sbf_texture, media_type), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bytes", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_texture, bytes), .width = 1, .unit = "", .item = SBFI_ITEM_U8},
};
static const sbfi_element texture_element = {"texture", "texture", sizeof(sbf_texture), SBFI_KIND('T', 'X', 'T', 'R'), 5, texture_fields, NULL};

static const sbfi_field uv_transform_fields[] = {
  {.name = "offset", .type = SBFI_VEC2, .number = 1, .since_minor = 0, .offset = offsetof(sbf_uv_transform, offset), .width = 2, .unit = ""},
  {.name = "rotation", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_uv_transform, rotation), .width = 1, .unit = "rad"},
  {.name = "scale", .type = SBFI_VEC2, .number = 3, .since_minor = 0, .offset = offsetof(sbf_uv_transform, scale), .width = 2, .unit = "", .initial.scalars = {1.0f, 1.0f}},
};
static const sbfi_element uv_transform_element = {"uv_transform", "uv_transform", sizeof(sbf_uv_transform), 0, 3, uv_transform_fields, NULL};

static const sbfi_field material_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_material, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_material, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "base_color", .type = SBFI_VEC4, .number = 3, .since_minor = 0, .offset = offsetof(sbf_material, base_color), .width = 4, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f, 1.0f, 1.0f, 1.0f}},
  {.name = "metallic", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_material, metallic), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.0f}},
  {.name = "roughness", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_material, roughness), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
  {.name = "emissive", .type = SBFI_VEC3, .number = 6, .since_minor = 0, .offset = offsetof(sbf_material, emissive), .width = 3, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "alpha_mode", .type = SBFI_ENUM, .number = 7, .since_minor = 0, .offset = offsetof(sbf_material, alpha_mode), .width = 1, .unit = "", .initial.integer = 0, .words.at = alpha_mode_values, .words.count = 3},
  {.name = "alpha_cutoff", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_material, alpha_cutoff), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.5f}},
  {.name = "double_sided", .type = SBFI_BOOL, .number = 9, .since_minor = 0, .offset = offsetof(sbf_material, double_sided), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "base_color_texture", .type = SBFI_REF, .number = 10, .since_minor = 0, .offset = offsetof(sbf_material, base_color_texture), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, textures), .reference.name = "textures"},
  {.name = "metallic_roughness_texture", .type = SBFI_REF, .number = 11, .since_minor = 0, .offset = offsetof(sbf_material, metallic_roughness_texture), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, textures), .reference.name = "textures"},
  {.name = "normal_texture", .type = SBFI_REF, .number = 12, .since_minor = 0, .offset = offsetof(sbf_material, normal_texture), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, textures), .reference.name = "textures"},
  {.name = "base_color_uv", .type = SBFI_OPTIONAL, .number = 13, .since_minor = 1, .offset = offsetof(sbf_material, base_color_uv), .width = 1, .unit = "", .element = &uv_transform_element, .tag.xml = "base_color_uv"},
  {.name = "metallic_roughness_uv", .type = SBFI_OPTIONAL, .number = 14, .since_minor = 1, .offset = offsetof(sbf_material, metallic_roughness_uv), .width = 1, .unit = "", .element = &uv_transform_element, .tag.xml = "metallic_roughness_uv"},
  {.name = "normal_uv", .type = SBFI_OPTIONAL, .number = 15, .since_minor = 1, .offset = offsetof(sbf_material, normal_uv), .width = 1, .unit = "", .element = &uv_transform_element, .tag.xml = "normal_uv"},
};
static const sbfi_element material_element = {"material", "material", sizeof(sbf_material), 0, 15, material_fields, NULL};

static const sbfi_field bone_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_bone, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_bone, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "parent", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_bone, parent), .width = 1, .unit = "", .earlier = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "head", .type = SBFI_VEC3, .number = 4, .since_minor = 0, .offset = offsetof(sbf_bone, head), .width = 3, .unit = "m", .required = true},
  {.name = "rotation", .type = SBFI_QUAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_bone, rotation), .width = 4, .unit = "", .initial.scalars = {0, 0, 0, 1}},
  {.name = "length", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_bone, length), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "inherit_rotation", .type = SBFI_BOOL, .number = 7, .since_minor = 0, .offset = offsetof(sbf_bone, inherit_rotation), .width = 1, .unit = "", .initial.integer = 1},
  {.name = "inherit_scale", .type = SBFI_BOOL, .number = 8, .since_minor = 0, .offset = offsetof(sbf_bone, inherit_scale), .width = 1, .unit = "", .initial.integer = 1},
};
static const sbfi_element bone_element = {"bone", "bone", sizeof(sbf_bone), 0, 8, bone_fields, NULL};

static const sbfi_length polygon_mesh_polygon_points_lengths[] = {{1, {{SBFI_TERM_SUM, 0, offsetof(sbf_polygon_mesh, polygon_sizes)}}, "sum(polygon_sizes)"}};
static const sbfi_length polygon_mesh_polygon_points_index = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_polygon_mesh, positions)}}, "positions"};
static const sbfi_length polygon_mesh_size = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_polygon_mesh, positions)}}, "positions"};
static const sbfi_field polygon_mesh_fields[] = {
  {.name = "target", .type = SBFI_ENUM, .number = 1, .since_minor = 0, .offset = offsetof(sbf_polygon_mesh, target), .width = 1, .unit = "", .required = true, .words.at = mesh_target_values, .words.count = 3},
  {.name = "positions", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_polygon_mesh, positions), .width = 3, .unit = "m", .item = SBFI_ITEM_F32},
  {.name = "polygon_sizes", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_polygon_mesh, polygon_sizes), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .range.is_stated = true, .range.min = 3.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "polygon_points", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_polygon_mesh, polygon_points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 1, .lengths = polygon_mesh_polygon_points_lengths, .index = &polygon_mesh_polygon_points_index},
};
static const sbfi_element polygon_mesh_element = {"polygon_mesh", "polygon_mesh", sizeof(sbf_polygon_mesh), 0, 4, polygon_mesh_fields, &polygon_mesh_size};

static const sbfi_field rigid_body_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_rigid_body, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_rigid_body, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bone", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_rigid_body, bone), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "derived", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_rigid_body, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "proposed", .type = SBFI_BOOL, .number = 5, .since_minor = 0, .offset = offsetof(sbf_rigid_body, proposed), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "motion", .type = SBFI_ENUM, .number = 6, .since_minor = 0, .offset = offsetof(sbf_rigid_body, motion), .width = 1, .unit = "", .initial.integer = 0, .words.at = body_motion_values, .words.count = 2},
  {.name = "mass", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_rigid_body, mass), .width = 1, .unit = "kg", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "density", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_rigid_body, density), .width = 1, .unit = "kg/m^3", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {1000.0f}},
  {.name = "center", .type = SBFI_VEC3, .number = 9, .since_minor = 0, .offset = offsetof(sbf_rigid_body, center), .width = 3, .unit = "m"},
  {.name = "inertia", .type = SBFI_VEC3, .number = 10, .since_minor = 0, .offset = offsetof(sbf_rigid_body, inertia), .width = 3, .unit = "kg*m^2", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "inertia_rotation", .type = SBFI_QUAT, .number = 11, .since_minor = 0, .offset = offsetof(sbf_rigid_body, inertia_rotation), .width = 4, .unit = "", .initial.scalars = {0, 0, 0, 1}},
  {.name = "friction", .type = SBFI_FLOAT, .number = 12, .since_minor = 0, .offset = offsetof(sbf_rigid_body, friction), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.5f}},
  {.name = "restitution", .type = SBFI_FLOAT, .number = 13, .since_minor = 0, .offset = offsetof(sbf_rigid_body, restitution), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.0f}},
  {.name = "gravity_scale", .type = SBFI_FLOAT, .number = 14, .since_minor = 0, .offset = offsetof(sbf_rigid_body, gravity_scale), .width = 1, .unit = "", .initial.scalars = {1.0f}},
  {.name = "layer", .type = SBFI_UINT, .number = 15, .since_minor = 0, .offset = offsetof(sbf_rigid_body, layer), .width = 1, .unit = "", .initial.integer = 1u},
  {.name = "mask", .type = SBFI_UINT, .number = 16, .since_minor = 0, .offset = offsetof(sbf_rigid_body, mask), .width = 1, .unit = "", .initial.integer = 4294967295u},
  {.name = "hull", .type = SBFI_OPTIONAL, .number = 17, .since_minor = 0, .offset = offsetof(sbf_rigid_body, hull), .width = 1, .unit = "", .element = &polygon_mesh_element, .tag.xml = "polygon_mesh", .fixed.name = "target", .fixed.value = 2},
  {.name = "hull_derived", .type = SBFI_REF, .number = 18, .since_minor = 0, .offset = offsetof(sbf_rigid_body, hull_derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "velocity", .type = SBFI_VEC3, .number = 19, .since_minor = 3, .offset = offsetof(sbf_rigid_body, velocity), .width = 3, .unit = "m/s"},
  {.name = "angular_velocity", .type = SBFI_VEC3, .number = 20, .since_minor = 3, .offset = offsetof(sbf_rigid_body, angular_velocity), .width = 3, .unit = "rad/s"},
};
static const sbfi_element rigid_body_element = {"rigid_body", "rigid_body", sizeof(sbf_rigid_body), 0, 20, rigid_body_fields, NULL};

static const sbfi_field frame_fields[] = {
  {.name = "position", .type = SBFI_VEC3, .number = 1, .since_minor = 0, .offset = offsetof(sbf_frame, position), .width = 3, .unit = "m"},
  {.name = "rotation", .type = SBFI_QUAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_frame, rotation), .width = 4, .unit = "", .initial.scalars = {0, 0, 0, 1}},
};
static const sbfi_element frame_element = {"frame", "frame", sizeof(sbf_frame), 0, 2, frame_fields, NULL};

static const sbfi_field limit_fields[] = {
  {.name = "target", .type = SBFI_ENUM, .number = 1, .since_minor = 0, .offset = offsetof(sbf_limit, target), .width = 1, .unit = "", .required = true, .words.at = joint_axis_values, .words.count = 8},
  {.name = "min", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_limit, min), .width = 1, .unit = "", .required = true},
  {.name = "max", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_limit, max), .width = 1, .unit = "", .required = true},
  {.name = "stiffness", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_limit, stiffness), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "damping", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_limit, damping), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "restitution", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_limit, restitution), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false},
};
static const sbfi_element limit_element = {"limit", "limit", sizeof(sbf_limit), 0, 6, limit_fields, NULL};

static const sbfi_field drive_fields[] = {
  {.name = "target", .type = SBFI_ENUM, .number = 1, .since_minor = 0, .offset = offsetof(sbf_drive, target), .width = 1, .unit = "", .required = true, .words.at = joint_axis_values, .words.count = 8},
  {.name = "position", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_drive, position), .width = 1, .unit = ""},
  {.name = "velocity", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_drive, velocity), .width = 1, .unit = ""},
  {.name = "stiffness", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_drive, stiffness), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "damping", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_drive, damping), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "maximum", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_drive, maximum), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
};
static const sbfi_element drive_element = {"drive", "drive", sizeof(sbf_drive), 0, 6, drive_fields, NULL};

static const sbfi_field joint_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_joint, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_joint, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "kind", .type = SBFI_ENUM, .number = 3, .since_minor = 0, .offset = offsetof(sbf_joint, kind), .width = 1, .unit = "", .required = true, .words.at = joint_kind_values, .words.count = 10},
  {.name = "body_a", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_joint, body_a), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, rigid_bodies), .reference.name = "rigid_bodies"},
  {.name = "body_b", .type = SBFI_REF, .number = 5, .since_minor = 0, .offset = offsetof(sbf_joint, body_b), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, rigid_bodies), .reference.name = "rigid_bodies"},
  {.name = "frame_a", .type = SBFI_ONE, .number = 6, .since_minor = 0, .offset = offsetof(sbf_joint, frame_a), .width = 1, .unit = "", .element = &frame_element, .tag.xml = "frame_a"},
  {.name = "frame_b", .type = SBFI_ONE, .number = 7, .since_minor = 0, .offset = offsetof(sbf_joint, frame_b), .width = 1, .unit = "", .element = &frame_element, .tag.xml = "frame_b"},
  {.name = "proposed", .type = SBFI_BOOL, .number = 8, .since_minor = 0, .offset = offsetof(sbf_joint, proposed), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "collide", .type = SBFI_BOOL, .number = 9, .since_minor = 0, .offset = offsetof(sbf_joint, collide), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "limits", .type = SBFI_MANY, .number = 10, .since_minor = 0, .offset = offsetof(sbf_joint, limits), .width = 1, .unit = "", .element = &limit_element, .tag.xml = "limit", .tag.wrapper = "limits"},
  {.name = "drives", .type = SBFI_MANY, .number = 11, .since_minor = 0, .offset = offsetof(sbf_joint, drives), .width = 1, .unit = "", .element = &drive_element, .tag.xml = "drive"},
  {.name = "pulley_a", .type = SBFI_VEC3, .number = 12, .since_minor = 0, .offset = offsetof(sbf_joint, pulley_a), .width = 3, .unit = "m"},
  {.name = "pulley_b", .type = SBFI_VEC3, .number = 13, .since_minor = 0, .offset = offsetof(sbf_joint, pulley_b), .width = 3, .unit = "m"},
  {.name = "pulley_ratio", .type = SBFI_FLOAT, .number = 14, .since_minor = 0, .offset = offsetof(sbf_joint, pulley_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {1.0f}},
  {.name = "break_force", .type = SBFI_FLOAT, .number = 15, .since_minor = 0, .offset = offsetof(sbf_joint, break_force), .width = 1, .unit = "N", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "break_torque", .type = SBFI_FLOAT, .number = 16, .since_minor = 0, .offset = offsetof(sbf_joint, break_torque), .width = 1, .unit = "N*m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "derived", .type = SBFI_REF, .number = 17, .since_minor = 0, .offset = offsetof(sbf_joint, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
};
static const sbfi_element joint_element = {"joint", "joint", sizeof(sbf_joint), 0, 17, joint_fields, NULL};

static const sbfi_length uv_set_corners_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_render_mesh, mesh.polygon_points)}}, "parent.mesh.polygon_points"}};
static const sbfi_length uv_set_corners_index = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_uv_set, coordinates)}}, "coordinates"};
static const sbfi_field uv_set_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_uv_set, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "coordinates", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_uv_set, coordinates), .width = 2, .unit = "", .item = SBFI_ITEM_F32},
  {.name = "corners", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_uv_set, corners), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = uv_set_corners_lengths, .index = &uv_set_corners_index},
};
static const sbfi_element uv_set_element = {"uv_set", "uv_set", sizeof(sbf_uv_set), 0, 3, uv_set_fields, NULL};

static const sbfi_field material_slot_fields[] = {
  {.name = "material", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_material_slot, material), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, materials), .reference.name = "materials"},
};
static const sbfi_element material_slot_element = {"material_slot", "material_slot", sizeof(sbf_material_slot), 0, 1, material_slot_fields, NULL};

static const sbfi_length skin_influence_counts_lengths[] = {{1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_render_mesh, mesh.positions)}}, "parent.mesh.positions"}};
static const sbfi_length skin_bones_lengths[] = {{1, {{SBFI_TERM_SUM, 0, offsetof(sbf_skin, influence_counts)}}, "sum(influence_counts)"}};
static const sbfi_length skin_bones_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, bones)}}, "asset.bones"};
static const sbfi_length skin_weights_lengths[] = {{1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_skin, bones)}}, "bones"}};
static const sbfi_field skin_fields[] = {
  {.name = "influence_counts", .type = SBFI_LIST, .number = 1, .since_minor = 0, .offset = offsetof(sbf_skin, influence_counts), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 1, .lengths = skin_influence_counts_lengths},
  {.name = "bones", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_skin, bones), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 1, .lengths = skin_bones_lengths, .index = &skin_bones_index},
  {.name = "weights", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_skin, weights), .width = 1, .unit = "", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .length_count = 1, .lengths = skin_weights_lengths},
};
static const sbfi_element skin_element = {"skin", "skin", sizeof(sbf_skin), 0, 3, skin_fields, NULL};

static const sbfi_length shape_key_points_index = {1, {{SBFI_TERM_SIZE, 1, 0}}, "parent.size"};
static const sbfi_length shape_key_offsets_lengths[] = {{1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_shape_key, points)}}, "points"}};
static const sbfi_field shape_key_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_shape_key, name), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "points", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_shape_key, points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &shape_key_points_index},
  {.name = "offsets", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_shape_key, offsets), .width = 3, .unit = "m", .item = SBFI_ITEM_F32, .length_count = 1, .lengths = shape_key_offsets_lengths},
};
static const sbfi_element shape_key_element = {"shape_key", "shape_key", sizeof(sbf_shape_key), 0, 3, shape_key_fields, NULL};

static const sbfi_length render_level_polygon_points_lengths[] = {{1, {{SBFI_TERM_SUM, 0, offsetof(sbf_render_level, polygon_sizes)}}, "sum(polygon_sizes)"}};
static const sbfi_length render_level_polygon_points_index = {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_render_mesh, mesh.positions)}}, "parent.mesh.positions"};
static const sbfi_length render_level_polygon_materials_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_level, polygon_sizes)}}, "polygon_sizes"}};
static const sbfi_length render_level_polygon_materials_index = {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_render_mesh, material_slots)}}, "parent.material_slots"};
static const sbfi_length render_level_corners_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_level, polygon_points)}}, "polygon_points"}};
static const sbfi_length render_level_corners_index = {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_render_mesh, mesh.polygon_points)}}, "parent.mesh.polygon_points"};
static const sbfi_field render_level_fields[] = {
  {.name = "error", .type = SBFI_FLOAT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_render_level, error), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "polygon_sizes", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_render_level, polygon_sizes), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .range.is_stated = true, .range.min = 3.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "polygon_points", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_render_level, polygon_points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 1, .lengths = render_level_polygon_points_lengths, .index = &render_level_polygon_points_index},
  {.name = "derived", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_render_level, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "polygon_materials", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_render_level, polygon_materials), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = render_level_polygon_materials_lengths, .index = &render_level_polygon_materials_index},
  {.name = "corners", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_render_level, corners), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = render_level_corners_lengths, .index = &render_level_corners_index},
};
static const sbfi_element render_level_element = {"render_level", "render_level", sizeof(sbf_render_level), 0, 6, render_level_fields, NULL};

static const sbfi_length pin_set_points_index = {1, {{SBFI_TERM_SIZE, 1, 0}}, "parent.size"};
static const sbfi_length pin_set_offsets_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_pin_set, points)}}, "points"}};
static const sbfi_length pin_set_weights_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_pin_set, points)}}, "points"}};
static const sbfi_field pin_set_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_pin_set, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bone", .type = SBFI_REF, .number = 2, .since_minor = 0, .offset = offsetof(sbf_pin_set, bone), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "rigid_body", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_pin_set, rigid_body), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, rigid_bodies), .reference.name = "rigid_bodies"},
  {.name = "derived", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_pin_set, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "points", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_pin_set, points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &pin_set_points_index},
  {.name = "offsets", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_pin_set, offsets), .width = 3, .unit = "m", .item = SBFI_ITEM_F32, .length_count = 2, .lengths = pin_set_offsets_lengths},
  {.name = "weights", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_pin_set, weights), .width = 1, .unit = "", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .length_count = 3, .lengths = pin_set_weights_lengths},
  {.name = "stiffness", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_pin_set, stiffness), .width = 1, .unit = "N/m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "damping", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_pin_set, damping), .width = 1, .unit = "N*s/m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "minimum", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_pin_set, minimum), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false},
  {.name = "maximum", .type = SBFI_FLOAT, .number = 11, .since_minor = 0, .offset = offsetof(sbf_pin_set, maximum), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
};
static const sbfi_element pin_set_element = {"pin_set", "pin_set", sizeof(sbf_pin_set), 0, 11, pin_set_fields, NULL};

static const sbfi_length render_mesh_normal_corners_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, mesh.polygon_points)}}, "mesh.polygon_points"}};
static const sbfi_length render_mesh_normal_corners_index = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, normals)}}, "normals"};
static const sbfi_length render_mesh_polygon_materials_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, mesh.polygon_sizes)}}, "mesh.polygon_sizes"}};
static const sbfi_length render_mesh_polygon_materials_index = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, material_slots)}}, "material_slots"};
static const sbfi_length render_mesh_source_points_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, mesh.positions)}}, "mesh.positions"}};
static const sbfi_length render_mesh_color_corners_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, mesh.polygon_points)}}, "mesh.polygon_points"}};
static const sbfi_length render_mesh_color_corners_index = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, colors)}}, "colors"};
static const sbfi_length render_mesh_size = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_render_mesh, mesh.positions)}}, "mesh.positions"};
static const sbfi_field render_mesh_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_render_mesh, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_render_mesh, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bone", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_render_mesh, bone), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "derived", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_render_mesh, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "mesh", .type = SBFI_ONE, .number = 5, .since_minor = 0, .offset = offsetof(sbf_render_mesh, mesh), .width = 1, .unit = "", .element = &polygon_mesh_element, .tag.xml = "polygon_mesh", .fixed.name = "target", .fixed.value = 0},
  {.name = "normals", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_render_mesh, normals), .width = 3, .unit = "", .item = SBFI_ITEM_F32},
  {.name = "normal_corners", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_render_mesh, normal_corners), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = render_mesh_normal_corners_lengths, .index = &render_mesh_normal_corners_index},
  {.name = "uv_sets", .type = SBFI_MANY, .number = 8, .since_minor = 0, .offset = offsetof(sbf_render_mesh, uv_sets), .width = 1, .unit = "", .element = &uv_set_element, .tag.xml = "uv_set"},
  {.name = "material_slots", .type = SBFI_MANY, .number = 9, .since_minor = 0, .offset = offsetof(sbf_render_mesh, material_slots), .width = 1, .unit = "", .element = &material_slot_element, .tag.xml = "material_slot"},
  {.name = "polygon_materials", .type = SBFI_LIST, .number = 10, .since_minor = 0, .offset = offsetof(sbf_render_mesh, polygon_materials), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = render_mesh_polygon_materials_lengths, .index = &render_mesh_polygon_materials_index},
  {.name = "skin", .type = SBFI_OPTIONAL, .number = 11, .since_minor = 0, .offset = offsetof(sbf_render_mesh, skin), .width = 1, .unit = "", .element = &skin_element, .tag.xml = "skin"},
  {.name = "shape_keys", .type = SBFI_MANY, .number = 12, .since_minor = 0, .offset = offsetof(sbf_render_mesh, shape_keys), .width = 1, .unit = "", .element = &shape_key_element, .tag.xml = "shape_key"},
  {.name = "source_points", .type = SBFI_LIST, .number = 13, .since_minor = 0, .offset = offsetof(sbf_render_mesh, source_points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = render_mesh_source_points_lengths},
  {.name = "levels", .type = SBFI_MANY, .number = 14, .since_minor = 0, .offset = offsetof(sbf_render_mesh, levels), .width = 1, .unit = "", .element = &render_level_element, .tag.xml = "render_level"},
  {.name = "pins", .type = SBFI_MANY, .number = 15, .since_minor = 0, .offset = offsetof(sbf_render_mesh, pins), .width = 1, .unit = "", .element = &pin_set_element, .tag.xml = "pin_set", .tag.wrapper = "pins"},
  {.name = "colors", .type = SBFI_LIST, .number = 16, .since_minor = 1, .offset = offsetof(sbf_render_mesh, colors), .width = 4, .unit = "", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false},
  {.name = "color_corners", .type = SBFI_LIST, .number = 17, .since_minor = 1, .offset = offsetof(sbf_render_mesh, color_corners), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = render_mesh_color_corners_lengths, .index = &render_mesh_color_corners_index},
};
static const sbfi_element render_mesh_element = {"render_mesh", "render_mesh", sizeof(sbf_render_mesh), SBFI_KIND('M', 'E', 'S', 'H'), 17, render_mesh_fields, &render_mesh_size};

static const sbfi_field attributes_fields[] = {
  {.name = "density", .type = SBFI_FLOAT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_attributes, density), .width = 1, .unit = "kg/m^3", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {1000.0f}},
  {.name = "mass", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_attributes, mass), .width = 1, .unit = "kg", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "area_density", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_attributes, area_density), .width = 1, .unit = "kg/m^2", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "thickness", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_attributes, thickness), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.001f}},
  {.name = "young_modulus", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_attributes, young_modulus), .width = 1, .unit = "Pa", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {80000.0f}},
  {.name = "poisson_ratio", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_attributes, poisson_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = -1.0, .range.max = 0.5, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.4f}},
  {.name = "bending_stiffness", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_attributes, bending_stiffness), .width = 1, .unit = "N*m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "mass_damping", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_attributes, mass_damping), .width = 1, .unit = "1/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "stiffness_damping", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_attributes, stiffness_damping), .width = 1, .unit = "s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "damping_ratio", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_attributes, damping_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.2f}},
  {.name = "friction", .type = SBFI_FLOAT, .number = 11, .since_minor = 0, .offset = offsetof(sbf_attributes, friction), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.6f}},
  {.name = "restitution", .type = SBFI_FLOAT, .number = 12, .since_minor = 0, .offset = offsetof(sbf_attributes, restitution), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.0f}},
  {.name = "gravity_scale", .type = SBFI_FLOAT, .number = 13, .since_minor = 0, .offset = offsetof(sbf_attributes, gravity_scale), .width = 1, .unit = "", .initial.scalars = {1.0f}},
  {.name = "media_friction", .type = SBFI_FLOAT, .number = 14, .since_minor = 0, .offset = offsetof(sbf_attributes, media_friction), .width = 1, .unit = "1/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "pressure", .type = SBFI_FLOAT, .number = 15, .since_minor = 0, .offset = offsetof(sbf_attributes, pressure), .width = 1, .unit = "Pa"},
  {.name = "pressure_mode", .type = SBFI_ENUM, .number = 16, .since_minor = 0, .offset = offsetof(sbf_attributes, pressure_mode), .width = 1, .unit = "", .initial.integer = 0, .words.at = pressure_mode_values, .words.count = 3},
  {.name = "strain_min", .type = SBFI_FLOAT, .number = 17, .since_minor = 0, .offset = offsetof(sbf_attributes, strain_min), .width = 1, .unit = "", .range.is_stated = true, .range.min = -1.0, .range.max = 0.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {-1.0f}},
  {.name = "strain_max", .type = SBFI_FLOAT, .number = 18, .since_minor = 0, .offset = offsetof(sbf_attributes, strain_max), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "yield_strain", .type = SBFI_FLOAT, .number = 19, .since_minor = 0, .offset = offsetof(sbf_attributes, yield_strain), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "yield_flow", .type = SBFI_FLOAT, .number = 20, .since_minor = 0, .offset = offsetof(sbf_attributes, yield_flow), .width = 1, .unit = "1/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "tear_strain", .type = SBFI_FLOAT, .number = 21, .since_minor = 0, .offset = offsetof(sbf_attributes, tear_strain), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "sag_free", .type = SBFI_BOOL, .number = 22, .since_minor = 0, .offset = offsetof(sbf_attributes, sag_free), .width = 1, .unit = "", .initial.integer = 0},
};
static const sbfi_element attributes_element = {"attributes", "attributes", sizeof(sbf_attributes), 0, 22, attributes_fields, NULL};

static const sbfi_field collision_fields[] = {
  {.name = "particle_radius", .type = SBFI_FLOAT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_collision, particle_radius), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.01f}},
  {.name = "outer_thickness", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_collision, outer_thickness), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.005f}},
  {.name = "inner_thickness", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_collision, inner_thickness), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.01f}},
  {.name = "self", .type = SBFI_BOOL, .number = 4, .since_minor = 0, .offset = offsetof(sbf_collision, self), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "layer", .type = SBFI_UINT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_collision, layer), .width = 1, .unit = "", .initial.integer = 1u},
  {.name = "mask", .type = SBFI_UINT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_collision, mask), .width = 1, .unit = "", .initial.integer = 4294967295u},
};
static const sbfi_element collision_element = {"collision", "collision", sizeof(sbf_collision), 0, 6, collision_fields, NULL};

static const sbfi_length weight_map_values_lengths[] = {{1, {{SBFI_TERM_SIZE, 1, 0}}, "parent.size"}};
static const sbfi_field weight_map_fields[] = {
  {.name = "property", .type = SBFI_ENUM, .number = 1, .since_minor = 0, .offset = offsetof(sbf_weight_map, property), .width = 1, .unit = "", .required = true, .words.at = weight_property_values, .words.count = 9},
  {.name = "values", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_weight_map, values), .width = 1, .unit = "", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 1, .lengths = weight_map_values_lengths},
};
static const sbfi_element weight_map_element = {"weight_map", "weight_map", sizeof(sbf_weight_map), 0, 2, weight_map_fields, NULL};

static const sbfi_length attachment_points_index = {1, {{SBFI_TERM_SIZE, 1, 0}}, "parent.size"};
static const sbfi_field attachment_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_attachment, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "rule", .type = SBFI_ENUM, .number = 2, .since_minor = 0, .offset = offsetof(sbf_attachment, rule), .width = 1, .unit = "", .required = true, .words.at = attachment_rule_values, .words.count = 2},
  {.name = "rigid_body", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_attachment, rigid_body), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, rigid_bodies), .reference.name = "rigid_bodies"},
  {.name = "points", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_attachment, points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &attachment_points_index},
};
static const sbfi_element attachment_element = {"attachment", "attachment", sizeof(sbf_attachment), 0, 4, attachment_fields, NULL};

static const sbfi_length tetrahedron_mesh_tetrahedra_index = {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_level, positions)}}, "parent.positions"};
static const sbfi_length tetrahedron_mesh_young_modulus_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_tetrahedron_mesh, tetrahedra)}}, "tetrahedra"}};
static const sbfi_length tetrahedron_mesh_reference_modulus_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_tetrahedron_mesh, tetrahedra)}}, "tetrahedra"}};
static const sbfi_length tetrahedron_mesh_densities_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_tetrahedron_mesh, tetrahedra)}}, "tetrahedra"}};
static const sbfi_length tetrahedron_mesh_stiffness_damping_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_tetrahedron_mesh, tetrahedra)}}, "tetrahedra"}};
static const sbfi_field tetrahedron_mesh_fields[] = {
  {.name = "target", .type = SBFI_ENUM, .number = 1, .since_minor = 0, .offset = offsetof(sbf_tetrahedron_mesh, target), .width = 1, .unit = "", .required = true, .words.at = volume_target_values, .words.count = 1},
  {.name = "tetrahedra", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_tetrahedron_mesh, tetrahedra), .width = 4, .unit = "", .item = SBFI_ITEM_U32, .positive = true, .index = &tetrahedron_mesh_tetrahedra_index},
  {.name = "young_modulus", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_tetrahedron_mesh, young_modulus), .width = 1, .unit = "Pa", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .length_count = 3, .lengths = tetrahedron_mesh_young_modulus_lengths},
  {.name = "reference_modulus", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_tetrahedron_mesh, reference_modulus), .width = 1, .unit = "Pa", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .length_count = 3, .lengths = tetrahedron_mesh_reference_modulus_lengths},
  {.name = "densities", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_tetrahedron_mesh, densities), .width = 1, .unit = "kg/m^3", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .length_count = 3, .lengths = tetrahedron_mesh_densities_lengths},
  {.name = "color_counts", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_tetrahedron_mesh, color_counts), .width = 1, .unit = "", .item = SBFI_ITEM_U32},
  {.name = "stiffness_damping", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_tetrahedron_mesh, stiffness_damping), .width = 1, .unit = "s", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = tetrahedron_mesh_stiffness_damping_lengths},
};
static const sbfi_element tetrahedron_mesh_element = {"tetrahedron_mesh", "tetrahedron_mesh", sizeof(sbf_tetrahedron_mesh), 0, 7, tetrahedron_mesh_fields, NULL};

static const sbfi_length spring_set_ends_index = {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_level, positions)}}, "parent.positions"};
static const sbfi_length spring_set_rest_lengths_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_spring_set, ends)}}, "ends"}};
static const sbfi_length spring_set_stiffness_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_spring_set, ends)}}, "ends"}};
static const sbfi_length spring_set_damping_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_spring_set, ends)}}, "ends"}};
static const sbfi_length spring_set_compression_ratio_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_spring_set, ends)}}, "ends"}};
static const sbfi_field spring_set_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_spring_set, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "kind", .type = SBFI_ENUM, .number = 2, .since_minor = 0, .offset = offsetof(sbf_spring_set, kind), .width = 1, .unit = "", .required = true, .words.at = spring_kind_values, .words.count = 5},
  {.name = "derived", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_spring_set, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "extra", .type = SBFI_BOOL, .number = 4, .since_minor = 0, .offset = offsetof(sbf_spring_set, extra), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "ends", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_spring_set, ends), .width = 2, .unit = "", .item = SBFI_ITEM_U32, .index = &spring_set_ends_index},
  {.name = "rest_lengths", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_spring_set, rest_lengths), .width = 1, .unit = "m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 2, .lengths = spring_set_rest_lengths_lengths},
  {.name = "stiffness", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_spring_set, stiffness), .width = 1, .unit = "N/m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = spring_set_stiffness_lengths},
  {.name = "damping", .type = SBFI_LIST, .number = 8, .since_minor = 0, .offset = offsetof(sbf_spring_set, damping), .width = 1, .unit = "N*s/m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = spring_set_damping_lengths},
  {.name = "strain_min", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_spring_set, strain_min), .width = 1, .unit = "", .range.is_stated = true, .range.min = -1.0, .range.max = 0.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {-1.0f}},
  {.name = "strain_max", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_spring_set, strain_max), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "yield_strain", .type = SBFI_FLOAT, .number = 11, .since_minor = 0, .offset = offsetof(sbf_spring_set, yield_strain), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "tear_strain", .type = SBFI_FLOAT, .number = 12, .since_minor = 0, .offset = offsetof(sbf_spring_set, tear_strain), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "inert_count", .type = SBFI_UINT, .number = 13, .since_minor = 0, .offset = offsetof(sbf_spring_set, inert_count), .width = 1, .unit = ""},
  {.name = "color_counts", .type = SBFI_LIST, .number = 14, .since_minor = 0, .offset = offsetof(sbf_spring_set, color_counts), .width = 1, .unit = "", .item = SBFI_ITEM_U32},
  {.name = "compression_ratio", .type = SBFI_LIST, .number = 15, .since_minor = 0, .offset = offsetof(sbf_spring_set, compression_ratio), .width = 1, .unit = "", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = spring_set_compression_ratio_lengths},
};
static const sbfi_element spring_set_element = {"spring_set", "spring_set", sizeof(sbf_spring_set), 0, 15, spring_set_fields, NULL};

static const sbfi_length shape_regions_points_lengths[] = {{1, {{SBFI_TERM_SUM, 0, offsetof(sbf_shape_regions, sizes)}}, "sum(sizes)"}};
static const sbfi_length shape_regions_points_index = {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_level, positions)}}, "parent.positions"};
static const sbfi_field shape_regions_fields[] = {
  {.name = "sizes", .type = SBFI_LIST, .number = 1, .since_minor = 0, .offset = offsetof(sbf_shape_regions, sizes), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .range.is_stated = true, .range.min = 1.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "points", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_shape_regions, points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 1, .lengths = shape_regions_points_lengths, .index = &shape_regions_points_index},
  {.name = "stiffness", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_shape_regions, stiffness), .width = 1, .unit = "1/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {60.0f}},
};
static const sbfi_element shape_regions_element = {"shape_regions", "shape_regions", sizeof(sbf_shape_regions), 0, 3, shape_regions_fields, NULL};

static const sbfi_field jiggle_fields[] = {
  {.name = "frequency", .type = SBFI_FLOAT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_jiggle, frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {3.0f}},
  {.name = "damping_ratio", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_jiggle, damping_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.4f}},
  {.name = "response", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_jiggle, response), .width = 1, .unit = "", .initial.scalars = {0.0f}},
};
static const sbfi_element jiggle_element = {"jiggle", "jiggle", sizeof(sbf_jiggle), 0, 3, jiggle_fields, NULL};

static const sbfi_length embedding_points_index = {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_level, positions)}}, "parent.positions"};
static const sbfi_length embedding_weights_lengths[] = {{1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_embedding, points)}}, "points"}};
static const sbfi_length embedding_blends_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_embedding, points)}}, "points"}};
static const sbfi_field embedding_fields[] = {
  {.name = "render_mesh", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_embedding, render_mesh), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, render_meshes), .reference.name = "render_meshes"},
  {.name = "vertices", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_embedding, vertices), .width = 1, .unit = "", .item = SBFI_ITEM_U32},
  {.name = "points", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_embedding, points), .width = 4, .unit = "", .item = SBFI_ITEM_U32, .index = &embedding_points_index},
  {.name = "weights", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_embedding, weights), .width = 4, .unit = "", .item = SBFI_ITEM_F32, .length_count = 1, .lengths = embedding_weights_lengths},
  {.name = "blends", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_embedding, blends), .width = 1, .unit = "", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .length_count = 2, .lengths = embedding_blends_lengths},
  {.name = "derived", .type = SBFI_REF, .number = 6, .since_minor = 0, .offset = offsetof(sbf_embedding, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
};
static const sbfi_element embedding_element = {"embedding", "embedding", sizeof(sbf_embedding), 0, 6, embedding_fields, NULL};

static const sbfi_field measured_fields[] = {
  {.name = "machine", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_measured, machine), .width = 1, .unit = "", .initial.text = ""},
  {.name = "microseconds", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_measured, microseconds), .width = 1, .unit = "us", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
};
static const sbfi_element measured_element = {"measured", "measured", sizeof(sbf_measured), 0, 2, measured_fields, NULL};

static const sbfi_field simulation_fields[] = {
  {.name = "scheme", .type = SBFI_ENUM, .number = 1, .since_minor = 0, .offset = offsetof(sbf_simulation, scheme), .width = 1, .unit = "", .initial.integer = 0, .words.at = scheme_values, .words.count = 7},
  {.name = "substeps", .type = SBFI_UINT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_simulation, substeps), .width = 1, .unit = ""},
  {.name = "error", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_simulation, error), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "cost", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_simulation, cost), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "measured", .type = SBFI_MANY, .number = 5, .since_minor = 0, .offset = offsetof(sbf_simulation, measured), .width = 1, .unit = "", .volatile_ = true, .element = &measured_element, .tag.xml = "measured"},
  {.name = "step_error", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_simulation, step_error), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "substeps_least", .type = SBFI_UINT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_simulation, substeps_least), .width = 1, .unit = ""},
  {.name = "substeps_most", .type = SBFI_UINT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_simulation, substeps_most), .width = 1, .unit = ""},
  {.name = "motion_error", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_simulation, motion_error), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "motion_error_rms", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_simulation, motion_error_rms), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
};
static const sbfi_element simulation_element = {"simulation", "simulation", sizeof(sbf_simulation), 0, 10, simulation_fields, NULL};

static const sbfi_field calibration_fields[] = {
  {.name = "reference_elements", .type = SBFI_UINT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_calibration, reference_elements), .width = 1, .unit = ""},
  {.name = "factor", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_calibration, factor), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {1.0f}},
  {.name = "surface_factor", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_calibration, surface_factor), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {1.0f}},
  {.name = "residual", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_calibration, residual), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "period_error", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_calibration, period_error), .width = 1, .unit = ""},
  {.name = "load_errors", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_calibration, load_errors), .width = 1, .unit = "", .item = SBFI_ITEM_F32},
  {.name = "twist_errors", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_calibration, twist_errors), .width = 1, .unit = "", .item = SBFI_ITEM_F32},
};
static const sbfi_element calibration_element = {"calibration", "calibration", sizeof(sbf_calibration), 0, 7, calibration_fields, NULL};

static const sbfi_length level_masses_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_level, positions)}}, "positions"}};
static const sbfi_length level_size = {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_level, positions)}}, "positions"};
static const sbfi_field level_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_level, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "model", .type = SBFI_ENUM, .number = 2, .since_minor = 0, .offset = offsetof(sbf_level, model), .width = 1, .unit = "", .initial.integer = 0, .words.at = elastic_model_values, .words.count = 4},
  {.name = "derived", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_level, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "cell", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_level, cell), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "positions", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_level, positions), .width = 3, .unit = "m", .item = SBFI_ITEM_F32},
  {.name = "new_from_old", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_level, new_from_old), .width = 1, .unit = "", .item = SBFI_ITEM_U32},
  {.name = "masses", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_level, masses), .width = 1, .unit = "kg", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 2, .lengths = level_masses_lengths},
  {.name = "lattice", .type = SBFI_ONE, .number = 8, .since_minor = 0, .offset = offsetof(sbf_level, lattice), .width = 1, .unit = "", .element = &tetrahedron_mesh_element, .tag.xml = "tetrahedron_mesh"},
  {.name = "springs", .type = SBFI_MANY, .number = 9, .since_minor = 0, .offset = offsetof(sbf_level, springs), .width = 1, .unit = "", .element = &spring_set_element, .tag.xml = "spring_set"},
  {.name = "regions", .type = SBFI_OPTIONAL, .number = 10, .since_minor = 0, .offset = offsetof(sbf_level, regions), .width = 1, .unit = "", .element = &shape_regions_element, .tag.xml = "shape_regions"},
  {.name = "jiggle", .type = SBFI_OPTIONAL, .number = 11, .since_minor = 0, .offset = offsetof(sbf_level, jiggle), .width = 1, .unit = "", .element = &jiggle_element, .tag.xml = "jiggle"},
  {.name = "pins", .type = SBFI_MANY, .number = 12, .since_minor = 0, .offset = offsetof(sbf_level, pins), .width = 1, .unit = "", .element = &pin_set_element, .tag.xml = "pin_set", .tag.wrapper = "pins"},
  {.name = "embeddings", .type = SBFI_MANY, .number = 13, .since_minor = 0, .offset = offsetof(sbf_level, embeddings), .width = 1, .unit = "", .element = &embedding_element, .tag.xml = "embedding"},
  {.name = "simulation", .type = SBFI_ONE, .number = 14, .since_minor = 0, .offset = offsetof(sbf_level, simulation), .width = 1, .unit = "", .element = &simulation_element, .tag.xml = "simulation"},
  {.name = "calibration", .type = SBFI_OPTIONAL, .number = 15, .since_minor = 0, .offset = offsetof(sbf_level, calibration), .width = 1, .unit = "", .element = &calibration_element, .tag.xml = "calibration"},
};
static const sbfi_element level_element = {"level", "level", sizeof(sbf_level), SBFI_KIND('L', 'E', 'V', 'L'), 15, level_fields, &level_size};

static const sbfi_field legacy_fields[] = {
  {.name = "mass", .type = SBFI_FLOAT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_legacy, mass), .width = 1, .unit = ""},
  {.name = "volume_stiffness", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_legacy, volume_stiffness), .width = 1, .unit = ""},
  {.name = "stretching_stiffness", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_legacy, stretching_stiffness), .width = 1, .unit = ""},
  {.name = "friction", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_legacy, friction), .width = 1, .unit = ""},
  {.name = "particle_radius", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_legacy, particle_radius), .width = 1, .unit = ""},
  {.name = "solver_iterations", .type = SBFI_UINT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_legacy, solver_iterations), .width = 1, .unit = ""},
};
static const sbfi_element legacy_element = {"legacy", "legacy", sizeof(sbf_legacy), 0, 6, legacy_fields, NULL};

static const sbfi_length soft_body_source_points_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_soft_body, surface.positions)}}, "surface.positions"}};
static const sbfi_length soft_body_size = {2, {{SBFI_TERM_COUNT, 0, offsetof(sbf_soft_body, surface.positions)}, {SBFI_TERM_COUNT, 0, offsetof(sbf_soft_body, interior)}}, "surface.positions + interior"};
static const sbfi_field soft_body_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_soft_body, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_soft_body, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bone", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_soft_body, bone), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "derived", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_soft_body, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "surface", .type = SBFI_ONE, .number = 5, .since_minor = 0, .offset = offsetof(sbf_soft_body, surface), .width = 1, .unit = "", .element = &polygon_mesh_element, .tag.xml = "polygon_mesh", .fixed.name = "target", .fixed.value = 1},
  {.name = "interior", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_soft_body, interior), .width = 3, .unit = "m", .item = SBFI_ITEM_F32},
  {.name = "source_points", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_soft_body, source_points), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .length_count = 2, .lengths = soft_body_source_points_lengths},
  {.name = "attributes", .type = SBFI_ONE, .number = 8, .since_minor = 0, .offset = offsetof(sbf_soft_body, attributes), .width = 1, .unit = "", .element = &attributes_element, .tag.xml = "attributes"},
  {.name = "collision", .type = SBFI_ONE, .number = 9, .since_minor = 0, .offset = offsetof(sbf_soft_body, collision), .width = 1, .unit = "", .element = &collision_element, .tag.xml = "collision"},
  {.name = "weight_maps", .type = SBFI_MANY, .number = 10, .since_minor = 0, .offset = offsetof(sbf_soft_body, weight_maps), .width = 1, .unit = "", .element = &weight_map_element, .tag.xml = "weight_map"},
  {.name = "pins", .type = SBFI_MANY, .number = 11, .since_minor = 0, .offset = offsetof(sbf_soft_body, pins), .width = 1, .unit = "", .element = &pin_set_element, .tag.xml = "pin_set", .tag.wrapper = "pins"},
  {.name = "attachments", .type = SBFI_MANY, .number = 12, .since_minor = 0, .offset = offsetof(sbf_soft_body, attachments), .width = 1, .unit = "", .element = &attachment_element, .tag.xml = "attachment", .tag.wrapper = "attachments"},
  {.name = "levels", .type = SBFI_MANY, .number = 13, .since_minor = 0, .offset = offsetof(sbf_soft_body, levels), .width = 1, .unit = "", .element = &level_element, .tag.xml = "level"},
  {.name = "legacy", .type = SBFI_OPTIONAL, .number = 14, .since_minor = 0, .offset = offsetof(sbf_soft_body, legacy), .width = 1, .unit = "", .element = &legacy_element, .tag.xml = "legacy"},
};
static const sbfi_element soft_body_element = {"soft_body", "soft_body", sizeof(sbf_soft_body), SBFI_KIND('B', 'O', 'D', 'Y'), 14, soft_body_fields, &soft_body_size};

static const sbfi_length cross_springs_rest_lengths_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_cross_springs, ends)}}, "ends"}};
static const sbfi_length cross_springs_stiffness_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_cross_springs, ends)}}, "ends"}};
static const sbfi_length cross_springs_damping_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_cross_springs, ends)}}, "ends"}};
static const sbfi_field cross_springs_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_cross_springs, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "derived", .type = SBFI_REF, .number = 2, .since_minor = 0, .offset = offsetof(sbf_cross_springs, derived), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, derivations), .reference.name = "derivations"},
  {.name = "body_a", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_cross_springs, body_a), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, soft_bodies), .reference.name = "soft_bodies"},
  {.name = "level_a", .type = SBFI_UINT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_cross_springs, level_a), .width = 1, .unit = ""},
  {.name = "body_b", .type = SBFI_REF, .number = 5, .since_minor = 0, .offset = offsetof(sbf_cross_springs, body_b), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, soft_bodies), .reference.name = "soft_bodies"},
  {.name = "level_b", .type = SBFI_UINT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_cross_springs, level_b), .width = 1, .unit = ""},
  {.name = "ends", .type = SBFI_LIST, .number = 7, .since_minor = 0, .offset = offsetof(sbf_cross_springs, ends), .width = 2, .unit = "", .item = SBFI_ITEM_U32},
  {.name = "rest_lengths", .type = SBFI_LIST, .number = 8, .since_minor = 0, .offset = offsetof(sbf_cross_springs, rest_lengths), .width = 1, .unit = "m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 2, .lengths = cross_springs_rest_lengths_lengths},
  {.name = "stiffness", .type = SBFI_LIST, .number = 9, .since_minor = 0, .offset = offsetof(sbf_cross_springs, stiffness), .width = 1, .unit = "N/m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = cross_springs_stiffness_lengths},
  {.name = "damping", .type = SBFI_LIST, .number = 10, .since_minor = 0, .offset = offsetof(sbf_cross_springs, damping), .width = 1, .unit = "N*s/m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = cross_springs_damping_lengths},
};
static const sbfi_element cross_springs_element = {"cross_springs", "cross_springs", sizeof(sbf_cross_springs), 0, 10, cross_springs_fields, NULL};

static const sbfi_field comfort_fields[] = {
  {.name = "bone", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_comfort, bone), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "rotation", .type = SBFI_QUAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_comfort, rotation), .width = 4, .unit = "", .initial.scalars = {0, 0, 0, 1}},
  {.name = "weight", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_comfort, weight), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
  {.name = "axes", .type = SBFI_VEC3, .number = 4, .since_minor = 0, .offset = offsetof(sbf_comfort, axes), .width = 3, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f, 1.0f, 1.0f}},
};
static const sbfi_element comfort_element = {"comfort", "comfort", sizeof(sbf_comfort), 0, 4, comfort_fields, NULL};

static const sbfi_field ik_chain_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_ik_chain, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_ik_chain, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "solver", .type = SBFI_ENUM, .number = 3, .since_minor = 0, .offset = offsetof(sbf_ik_chain, solver), .width = 1, .unit = "", .initial.integer = 0, .words.at = ik_solver_values, .words.count = 5},
  {.name = "root", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_ik_chain, root), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "end", .type = SBFI_REF, .number = 5, .since_minor = 0, .offset = offsetof(sbf_ik_chain, end), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "has_pole", .type = SBFI_BOOL, .number = 6, .since_minor = 0, .offset = offsetof(sbf_ik_chain, has_pole), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "pole", .type = SBFI_VEC3, .number = 7, .since_minor = 0, .offset = offsetof(sbf_ik_chain, pole), .width = 3, .unit = "m"},
  {.name = "pole_bone", .type = SBFI_REF, .number = 8, .since_minor = 0, .offset = offsetof(sbf_ik_chain, pole_bone), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "copy_rotation", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_ik_chain, copy_rotation), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
  {.name = "soft_reach", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_ik_chain, soft_reach), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.02f}},
  {.name = "tolerance", .type = SBFI_FLOAT, .number = 11, .since_minor = 0, .offset = offsetof(sbf_ik_chain, tolerance), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.0001f}},
  {.name = "iterations", .type = SBFI_UINT, .number = 12, .since_minor = 0, .offset = offsetof(sbf_ik_chain, iterations), .width = 1, .unit = "", .initial.integer = 32u},
  {.name = "comforts", .type = SBFI_MANY, .number = 13, .since_minor = 0, .offset = offsetof(sbf_ik_chain, comforts), .width = 1, .unit = "", .element = &comfort_element, .tag.xml = "comfort"},
  {.name = "proposed", .type = SBFI_BOOL, .number = 14, .since_minor = 0, .offset = offsetof(sbf_ik_chain, proposed), .width = 1, .unit = "", .initial.integer = 0},
};
static const sbfi_element ik_chain_element = {"ik_chain", "ik_chain", sizeof(sbf_ik_chain), 0, 14, ik_chain_fields, NULL};

static const sbfi_field leg_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_leg, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "ik", .type = SBFI_REF, .number = 2, .since_minor = 0, .offset = offsetof(sbf_leg, ik), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, ik_chains), .reference.name = "ik_chains"},
  {.name = "home", .type = SBFI_VEC3, .number = 3, .since_minor = 0, .offset = offsetof(sbf_leg, home), .width = 3, .unit = "m", .required = true},
  {.name = "sole", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_leg, sole), .width = 1, .unit = "m"},
  {.name = "group", .type = SBFI_UINT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_leg, group), .width = 1, .unit = ""},
  {.name = "jump_margin", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_leg, jump_margin), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.5f}},
};
static const sbfi_element leg_element = {"leg", "leg", sizeof(sbf_leg), 0, 6, leg_fields, NULL};

static const sbfi_field head_turn_fields[] = {
  {.name = "bone", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_head_turn, bone), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "lead", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_head_turn, lead), .width = 1, .unit = "s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.4f}},
  {.name = "limit", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_head_turn, limit), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 3.15, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.7f}},
  {.name = "frequency", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_head_turn, frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {1.5f}},
  {.name = "damping_ratio", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_head_turn, damping_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.8f}},
};
static const sbfi_element head_turn_element = {"head_turn", "head_turn", sizeof(sbf_head_turn), 0, 5, head_turn_fields, NULL};

static const sbfi_field tail_fields[] = {
  {.name = "chain", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_tail, chain), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, chains), .reference.name = "chains"},
  {.name = "frequency", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_tail, frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {1.2f}},
  {.name = "damping_ratio", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_tail, damping_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.25f}},
  {.name = "limit", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_tail, limit), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 3.15, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.6f}},
};
static const sbfi_element tail_element = {"tail", "tail", sizeof(sbf_tail), 0, 4, tail_fields, NULL};

static const sbfi_length undulation_bones_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, bones)}}, "asset.bones"};
static const sbfi_field undulation_fields[] = {
  {.name = "bones", .type = SBFI_LIST, .number = 1, .since_minor = 0, .offset = offsetof(sbf_undulation, bones), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &undulation_bones_index},
  {.name = "plane", .type = SBFI_ENUM, .number = 2, .since_minor = 0, .offset = offsetof(sbf_undulation, plane), .width = 1, .unit = "", .initial.integer = 0, .words.at = wave_plane_values, .words.count = 2},
  {.name = "length", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_undulation, length), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "wavelength", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_undulation, wavelength), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.95f}},
  {.name = "amplitude", .type = SBFI_VEC3, .number = 5, .since_minor = 0, .offset = offsetof(sbf_undulation, amplitude), .width = 3, .unit = "", .initial.scalars = {0.02f, -0.08f, 0.16f}},
  {.name = "exaggeration", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_undulation, exaggeration), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 10.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
  {.name = "strouhal_number", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_undulation, strouhal_number), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.3f}},
  {.name = "idle_frequency", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_undulation, idle_frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.4f}},
  {.name = "max_frequency", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_undulation, max_frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {8.0f}},
  {.name = "heading_amplitude", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_undulation, heading_amplitude), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 1.5, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.7f}},
};
static const sbfi_element undulation_element = {"undulation", "undulation", sizeof(sbf_undulation), 0, 10, undulation_fields, NULL};

static const sbfi_length fin_bones_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, bones)}}, "asset.bones"};
static const sbfi_field fin_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_fin, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bones", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_fin, bones), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &fin_bones_index},
  {.name = "motion", .type = SBFI_ENUM, .number = 3, .since_minor = 0, .offset = offsetof(sbf_fin, motion), .width = 1, .unit = "", .initial.integer = 0, .words.at = fin_motion_values, .words.count = 3},
  {.name = "axis", .type = SBFI_VEC3, .number = 4, .since_minor = 0, .offset = offsetof(sbf_fin, axis), .width = 3, .unit = "", .initial.scalars = {0.0f, 0.0f, 1.0f}},
  {.name = "amplitude", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_fin, amplitude), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 3.15, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.4f}},
  {.name = "mean", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_fin, mean), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = -3.15, .range.max = 3.15, .range.min_open = false, .range.max_open = false},
  {.name = "flex", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_fin, flex), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 3.15, .range.min_open = false, .range.max_open = false},
  {.name = "lag", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_fin, lag), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 6.29, .range.min_open = false, .range.max_open = false},
  {.name = "phase", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_fin, phase), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = -6.29, .range.max = 6.29, .range.min_open = false, .range.max_open = false},
  {.name = "frequency", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_fin, frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = 60.0, .range.min_open = false, .range.max_open = false},
  {.name = "twist", .type = SBFI_FLOAT, .number = 11, .since_minor = 0, .offset = offsetof(sbf_fin, twist), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 3.15, .range.min_open = false, .range.max_open = false},
};
static const sbfi_element fin_element = {"fin", "fin", sizeof(sbf_fin), 0, 11, fin_fields, NULL};

static const sbfi_field wheel_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_wheel, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bone", .type = SBFI_REF, .number = 2, .since_minor = 0, .offset = offsetof(sbf_wheel, bone), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "axis", .type = SBFI_VEC3, .number = 3, .since_minor = 0, .offset = offsetof(sbf_wheel, axis), .width = 3, .unit = "", .initial.scalars = {1.0f, 0.0f, 0.0f}},
  {.name = "radius", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_wheel, radius), .width = 1, .unit = "m", .required = true, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true},
  {.name = "steer_limit", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_wheel, steer_limit), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 1.5, .range.min_open = false, .range.max_open = false},
};
static const sbfi_element wheel_element = {"wheel", "wheel", sizeof(sbf_wheel), 0, 5, wheel_fields, NULL};

static const sbfi_length tread_bones_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, bones)}}, "asset.bones"};
static const sbfi_field tread_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_tread, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bones", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_tread, bones), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &tread_bones_index},
};
static const sbfi_element tread_element = {"tread", "tread", sizeof(sbf_tread), 0, 2, tread_fields, NULL};

static const sbfi_field medium_fields[] = {
  {.name = "buoyancy", .type = SBFI_FLOAT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_medium, buoyancy), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 10.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
  {.name = "drag_length", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_medium, drag_length), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "altitude", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_medium, altitude), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "bank", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_medium, bank), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 4.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
  {.name = "bank_limit", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_medium, bank_limit), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 1.5, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.8f}},
  {.name = "pitch_limit", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_medium, pitch_limit), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 1.5, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.8f}},
  {.name = "tilt", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_medium, tilt), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = -1.5, .range.max = 1.5, .range.min_open = false, .range.max_open = false},
  {.name = "bob", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_medium, bob), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "bob_frequency", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_medium, bob_frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = 8.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.8f}},
  {.name = "glide_ratio", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_medium, glide_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
};
static const sbfi_element medium_element = {"medium", "medium", sizeof(sbf_medium), 0, 10, medium_fields, NULL};

static const sbfi_field gait_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_gait, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_gait, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "proposed", .type = SBFI_BOOL, .number = 3, .since_minor = 0, .offset = offsetof(sbf_gait, proposed), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "body", .type = SBFI_REF, .number = 4, .since_minor = 0, .offset = offsetof(sbf_gait, body), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "hips", .type = SBFI_REF, .number = 5, .since_minor = 0, .offset = offsetof(sbf_gait, hips), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "chest", .type = SBFI_REF, .number = 6, .since_minor = 0, .offset = offsetof(sbf_gait, chest), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "step_height", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_gait, step_height), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.05f}},
  {.name = "step_width", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_gait, step_width), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "step_trigger", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_gait, step_trigger), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.05f}},
  {.name = "step_duration", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_gait, step_duration), .width = 1, .unit = "s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.25f}},
  {.name = "walk_speed", .type = SBFI_FLOAT, .number = 11, .since_minor = 0, .offset = offsetof(sbf_gait, walk_speed), .width = 1, .unit = "m/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.5f}},
  {.name = "hip_tilt", .type = SBFI_FLOAT, .number = 12, .since_minor = 0, .offset = offsetof(sbf_gait, hip_tilt), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.5f}},
  {.name = "body_tilt", .type = SBFI_FLOAT, .number = 13, .since_minor = 0, .offset = offsetof(sbf_gait, body_tilt), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.7f}},
  {.name = "legs", .type = SBFI_MANY, .number = 14, .since_minor = 0, .offset = offsetof(sbf_gait, legs), .width = 1, .unit = "", .element = &leg_element, .tag.xml = "leg"},
  {.name = "head", .type = SBFI_OPTIONAL, .number = 15, .since_minor = 0, .offset = offsetof(sbf_gait, head), .width = 1, .unit = "", .element = &head_turn_element, .tag.xml = "head_turn"},
  {.name = "tails", .type = SBFI_MANY, .number = 16, .since_minor = 0, .offset = offsetof(sbf_gait, tails), .width = 1, .unit = "", .element = &tail_element, .tag.xml = "tail"},
  {.name = "kind", .type = SBFI_ENUM, .number = 17, .since_minor = 2, .offset = offsetof(sbf_gait, kind), .width = 1, .unit = "", .initial.integer = 0, .words.at = gait_kind_values, .words.count = 7},
  {.name = "rest_pose", .type = SBFI_REF, .number = 18, .since_minor = 2, .offset = offsetof(sbf_gait, rest_pose), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, poses), .reference.name = "poses"},
  {.name = "idle_clip", .type = SBFI_REF, .number = 19, .since_minor = 2, .offset = offsetof(sbf_gait, idle_clip), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, clips), .reference.name = "clips"},
  {.name = "move_clip", .type = SBFI_REF, .number = 20, .since_minor = 2, .offset = offsetof(sbf_gait, move_clip), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, clips), .reference.name = "clips"},
  {.name = "undulation", .type = SBFI_OPTIONAL, .number = 21, .since_minor = 2, .offset = offsetof(sbf_gait, undulation), .width = 1, .unit = "", .element = &undulation_element, .tag.xml = "undulation"},
  {.name = "fins", .type = SBFI_MANY, .number = 22, .since_minor = 2, .offset = offsetof(sbf_gait, fins), .width = 1, .unit = "", .element = &fin_element, .tag.xml = "fin"},
  {.name = "wheels", .type = SBFI_MANY, .number = 23, .since_minor = 2, .offset = offsetof(sbf_gait, wheels), .width = 1, .unit = "", .element = &wheel_element, .tag.xml = "wheel"},
  {.name = "treads", .type = SBFI_MANY, .number = 24, .since_minor = 2, .offset = offsetof(sbf_gait, treads), .width = 1, .unit = "", .element = &tread_element, .tag.xml = "tread"},
  {.name = "medium", .type = SBFI_OPTIONAL, .number = 25, .since_minor = 2, .offset = offsetof(sbf_gait, medium), .width = 1, .unit = "", .element = &medium_element, .tag.xml = "medium"},
};
static const sbfi_element gait_element = {"gait", "gait", sizeof(sbf_gait), SBFI_KIND('G', 'A', 'I', 'T'), 25, gait_fields, NULL};

static const sbfi_length chain_spring_stiffness_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_chain, bones)}}, "parent.bones"}};
static const sbfi_length chain_spring_drag_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_chain, bones)}}, "parent.bones"}};
static const sbfi_length chain_spring_gravity_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_chain, bones)}}, "parent.bones"}};
static const sbfi_length chain_spring_radius_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_NUMBER, 0, 1}}, "1"}, {1, {{SBFI_TERM_COUNT, 1, offsetof(sbf_chain, bones)}}, "parent.bones"}};
static const sbfi_length chain_spring_colliders_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, chain_colliders)}}, "asset.chain_colliders"};
static const sbfi_field chain_spring_fields[] = {
  {.name = "stiffness", .type = SBFI_LIST, .number = 1, .since_minor = 0, .offset = offsetof(sbf_chain_spring, stiffness), .width = 1, .unit = "m/s^2", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = chain_spring_stiffness_lengths},
  {.name = "drag", .type = SBFI_LIST, .number = 2, .since_minor = 0, .offset = offsetof(sbf_chain_spring, drag), .width = 1, .unit = "1/s", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = chain_spring_drag_lengths},
  {.name = "gravity", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_chain_spring, gravity), .width = 3, .unit = "m/s^2", .item = SBFI_ITEM_F32, .length_count = 3, .lengths = chain_spring_gravity_lengths},
  {.name = "radius", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_chain_spring, radius), .width = 1, .unit = "m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 3, .lengths = chain_spring_radius_lengths},
  {.name = "center", .type = SBFI_REF, .number = 5, .since_minor = 0, .offset = offsetof(sbf_chain_spring, center), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "colliders", .type = SBFI_LIST, .number = 6, .since_minor = 0, .offset = offsetof(sbf_chain_spring, colliders), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &chain_spring_colliders_index},
};
static const sbfi_element chain_spring_element = {"chain_spring", "chain_spring", sizeof(sbf_chain_spring), 0, 6, chain_spring_fields, NULL};

static const sbfi_length chain_bones_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, bones)}}, "asset.bones"};
static const sbfi_length chain_spacing_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_chain, bones)}}, "bones"}};
static const sbfi_field chain_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_chain, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_chain, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "kind", .type = SBFI_ENUM, .number = 3, .since_minor = 0, .offset = offsetof(sbf_chain, kind), .width = 1, .unit = "", .initial.integer = 0, .words.at = chain_kind_values, .words.count = 2},
  {.name = "bones", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_chain, bones), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &chain_bones_index},
  {.name = "spacing", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_chain, spacing), .width = 1, .unit = "m", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .length_count = 2, .lengths = chain_spacing_lengths},
  {.name = "angle_limit", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_chain, angle_limit), .width = 1, .unit = "rad", .range.is_stated = true, .range.min = 0.0, .range.max = 3.15, .range.min_open = false, .range.max_open = false, .initial.scalars = {1.0f}},
  {.name = "damping", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_chain, damping), .width = 1, .unit = "1/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "proposed", .type = SBFI_BOOL, .number = 8, .since_minor = 0, .offset = offsetof(sbf_chain, proposed), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "spring", .type = SBFI_OPTIONAL, .number = 9, .since_minor = 4, .offset = offsetof(sbf_chain, spring), .width = 1, .unit = "", .element = &chain_spring_element, .tag.xml = "chain_spring"},
};
static const sbfi_element chain_element = {"chain", "chain", sizeof(sbf_chain), 0, 9, chain_fields, NULL};

static const sbfi_field follower_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_follower, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_follower, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bone", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_follower, bone), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "channel", .type = SBFI_ENUM, .number = 4, .since_minor = 0, .offset = offsetof(sbf_follower, channel), .width = 1, .unit = "", .initial.integer = 0, .words.at = follower_channel_values, .words.count = 5},
  {.name = "frequency", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_follower, frequency), .width = 1, .unit = "Hz", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {2.0f}},
  {.name = "damping_ratio", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_follower, damping_ratio), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {0.5f}},
  {.name = "response", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_follower, response), .width = 1, .unit = "", .initial.scalars = {0.0f}},
  {.name = "axis", .type = SBFI_ENUM, .number = 8, .since_minor = 0, .offset = offsetof(sbf_follower, axis), .width = 1, .unit = "", .initial.integer = 1, .words.at = bone_axis_values, .words.count = 3},
  {.name = "strength", .type = SBFI_FLOAT, .number = 9, .since_minor = 0, .offset = offsetof(sbf_follower, strength), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true, .initial.scalars = {1.0f}},
  {.name = "limit", .type = SBFI_FLOAT, .number = 10, .since_minor = 0, .offset = offsetof(sbf_follower, limit), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = true, .range.max_open = true, .initial.scalars = {0.5f}},
};
static const sbfi_element follower_element = {"follower", "follower", sizeof(sbf_follower), 0, 10, follower_fields, NULL};

static const sbfi_field track_fields[] = {
  {.name = "bone", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_track, bone), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "property", .type = SBFI_ENUM, .number = 2, .since_minor = 0, .offset = offsetof(sbf_track, property), .width = 1, .unit = "", .required = true, .words.at = track_property_values, .words.count = 3},
  {.name = "interpolation", .type = SBFI_ENUM, .number = 3, .since_minor = 0, .offset = offsetof(sbf_track, interpolation), .width = 1, .unit = "", .initial.integer = 0, .words.at = interpolation_values, .words.count = 3},
  {.name = "times", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_track, times), .width = 1, .unit = "s", .item = SBFI_ITEM_F32},
  {.name = "values", .type = SBFI_LIST, .number = 5, .since_minor = 0, .offset = offsetof(sbf_track, values), .width = 1, .unit = "", .item = SBFI_ITEM_F32},
};
static const sbfi_element track_element = {"track", "track", sizeof(sbf_track), 0, 5, track_fields, NULL};

static const sbfi_field clip_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_clip, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_clip, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "duration", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_clip, duration), .width = 1, .unit = "s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "loop", .type = SBFI_BOOL, .number = 4, .since_minor = 0, .offset = offsetof(sbf_clip, loop), .width = 1, .unit = "", .initial.integer = 1},
  {.name = "tracks", .type = SBFI_MANY, .number = 5, .since_minor = 0, .offset = offsetof(sbf_clip, tracks), .width = 1, .unit = "", .element = &track_element, .tag.xml = "track"},
};
static const sbfi_element clip_element = {"clip", "clip", sizeof(sbf_clip), SBFI_KIND('C', 'L', 'I', 'P'), 5, clip_fields, NULL};

static const sbfi_field pose_key_fields[] = {
  {.name = "bone", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_pose_key, bone), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "translation", .type = SBFI_VEC3, .number = 2, .since_minor = 0, .offset = offsetof(sbf_pose_key, translation), .width = 3, .unit = "m"},
  {.name = "rotation", .type = SBFI_QUAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_pose_key, rotation), .width = 4, .unit = "", .initial.scalars = {0, 0, 0, 1}},
};
static const sbfi_element pose_key_element = {"pose_key", "pose_key", sizeof(sbf_pose_key), 0, 3, pose_key_fields, NULL};

static const sbfi_field pose_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_pose, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_pose, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "distance", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_pose, distance), .width = 1, .unit = "m"},
  {.name = "keys", .type = SBFI_MANY, .number = 4, .since_minor = 0, .offset = offsetof(sbf_pose, keys), .width = 1, .unit = "", .element = &pose_key_element, .tag.xml = "pose_key"},
  {.name = "speed", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_pose, speed), .width = 1, .unit = "m/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "mirrored", .type = SBFI_BOOL, .number = 6, .since_minor = 0, .offset = offsetof(sbf_pose, mirrored), .width = 1, .unit = "", .initial.integer = 0},
};
static const sbfi_element pose_element = {"pose", "pose", sizeof(sbf_pose), 0, 6, pose_fields, NULL};

static const sbfi_length bone_mask_bones_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, bones)}}, "asset.bones"};
static const sbfi_length bone_mask_weights_lengths[] = {{1, {{SBFI_TERM_NUMBER, 0, 0}}, "0"}, {1, {{SBFI_TERM_COUNT, 0, offsetof(sbf_bone_mask, bones)}}, "bones"}};
static const sbfi_field bone_mask_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_bone_mask, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_bone_mask, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bones", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_bone_mask, bones), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &bone_mask_bones_index},
  {.name = "weights", .type = SBFI_LIST, .number = 4, .since_minor = 0, .offset = offsetof(sbf_bone_mask, weights), .width = 1, .unit = "", .item = SBFI_ITEM_F32, .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .length_count = 2, .lengths = bone_mask_weights_lengths},
};
static const sbfi_element bone_mask_element = {"bone_mask", "bone_mask", sizeof(sbf_bone_mask), 0, 4, bone_mask_fields, NULL};

static const sbfi_length retarget_chain_bones_index = {1, {{SBFI_TERM_COUNT, -1, offsetof(sbf_asset, bones)}}, "asset.bones"};
static const sbfi_field retarget_chain_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_retarget_chain, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_retarget_chain, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bones", .type = SBFI_LIST, .number = 3, .since_minor = 0, .offset = offsetof(sbf_retarget_chain, bones), .width = 1, .unit = "", .item = SBFI_ITEM_U32, .index = &retarget_chain_bones_index},
};
static const sbfi_element retarget_chain_element = {"retarget_chain", "retarget_chain", sizeof(sbf_retarget_chain), 0, 3, retarget_chain_fields, NULL};

static const sbfi_field force_field_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_force_field, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_force_field, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "kind", .type = SBFI_ENUM, .number = 3, .since_minor = 0, .offset = offsetof(sbf_force_field, kind), .width = 1, .unit = "", .required = true, .words.at = field_kind_values, .words.count = 4},
  {.name = "position", .type = SBFI_VEC3, .number = 4, .since_minor = 0, .offset = offsetof(sbf_force_field, position), .width = 3, .unit = "m"},
  {.name = "direction", .type = SBFI_VEC3, .number = 5, .since_minor = 0, .offset = offsetof(sbf_force_field, direction), .width = 3, .unit = ""},
  {.name = "strength", .type = SBFI_FLOAT, .number = 6, .since_minor = 0, .offset = offsetof(sbf_force_field, strength), .width = 1, .unit = "m/s^2"},
  {.name = "radius", .type = SBFI_FLOAT, .number = 7, .since_minor = 0, .offset = offsetof(sbf_force_field, radius), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "falloff", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_force_field, falloff), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
};
static const sbfi_element force_field_element = {"force_field", "force_field", sizeof(sbf_force_field), 0, 8, force_field_fields, NULL};

static const sbfi_field environment_fields[] = {
  {.name = "gravity", .type = SBFI_VEC3, .number = 1, .since_minor = 0, .offset = offsetof(sbf_environment, gravity), .width = 3, .unit = "m/s^2", .initial.scalars = {0.0f, -9.81f, 0.0f}},
  {.name = "wind", .type = SBFI_VEC3, .number = 2, .since_minor = 0, .offset = offsetof(sbf_environment, wind), .width = 3, .unit = "m/s"},
  {.name = "media_density", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_environment, media_density), .width = 1, .unit = "kg/m^3", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "media_friction", .type = SBFI_FLOAT, .number = 4, .since_minor = 0, .offset = offsetof(sbf_environment, media_friction), .width = 1, .unit = "1/s", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "control_tick", .type = SBFI_FLOAT, .number = 5, .since_minor = 0, .offset = offsetof(sbf_environment, control_tick), .width = 1, .unit = "s", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = true, .range.max_open = false, .initial.scalars = {0.016666668f}},
  {.name = "fields", .type = SBFI_MANY, .number = 6, .since_minor = 0, .offset = offsetof(sbf_environment, fields), .width = 1, .unit = "", .element = &force_field_element, .tag.xml = "force_field"},
  {.name = "has_water", .type = SBFI_BOOL, .number = 7, .since_minor = 2, .offset = offsetof(sbf_environment, has_water), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "water_level", .type = SBFI_FLOAT, .number = 8, .since_minor = 2, .offset = offsetof(sbf_environment, water_level), .width = 1, .unit = "m"},
};
static const sbfi_element environment_element = {"environment", "environment", sizeof(sbf_environment), 0, 8, environment_fields, NULL};

static const sbfi_field relaxation_fields[] = {
  {.name = "stiffness", .type = SBFI_FLOAT, .number = 1, .since_minor = 0, .offset = offsetof(sbf_relaxation, stiffness), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.3f}},
  {.name = "damping", .type = SBFI_FLOAT, .number = 2, .since_minor = 0, .offset = offsetof(sbf_relaxation, damping), .width = 1, .unit = "", .range.is_stated = true, .range.min = 0.0, .range.max = 1.0, .range.min_open = false, .range.max_open = false, .initial.scalars = {0.9f}},
  {.name = "gravity", .type = SBFI_FLOAT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_relaxation, gravity), .width = 1, .unit = "m", .initial.scalars = {0.001f}},
};
static const sbfi_element relaxation_element = {"relaxation", "relaxation", sizeof(sbf_relaxation), 0, 3, relaxation_fields, NULL};

static const sbfi_field extension_fields[] = {
  {.name = "name", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_extension, name), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "required", .type = SBFI_BOOL, .number = 2, .since_minor = 0, .offset = offsetof(sbf_extension, required), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "data", .type = SBFI_TEXT, .number = 3, .since_minor = 0, .offset = offsetof(sbf_extension, data), .width = 1, .unit = "", .initial.text = ""},
};
static const sbfi_element extension_element = {"extension", "extension", sizeof(sbf_extension), 0, 3, extension_fields, NULL};

static const sbfi_field section_recipe_fields[] = {
  {.name = "bone", .type = SBFI_REF, .number = 1, .since_minor = 0, .offset = offsetof(sbf_section_recipe, bone), .width = 1, .unit = "", .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "attributes", .type = SBFI_ONE, .number = 2, .since_minor = 0, .offset = offsetof(sbf_section_recipe, attributes), .width = 1, .unit = "", .element = &attributes_element, .tag.xml = "attributes"},
  {.name = "collision", .type = SBFI_ONE, .number = 3, .since_minor = 0, .offset = offsetof(sbf_section_recipe, collision), .width = 1, .unit = "", .element = &collision_element, .tag.xml = "collision"},
  {.name = "rigid", .type = SBFI_BOOL, .number = 4, .since_minor = 2, .offset = offsetof(sbf_section_recipe, rigid), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "proposed", .type = SBFI_BOOL, .number = 5, .since_minor = 2, .offset = offsetof(sbf_section_recipe, proposed), .width = 1, .unit = "", .initial.integer = 0},
  {.name = "elements", .type = SBFI_UINT, .number = 6, .since_minor = 3, .offset = offsetof(sbf_section_recipe, elements), .width = 1, .unit = "", .initial.integer = 0u},
};
static const sbfi_element section_recipe_element = {"section_recipe", "section_recipe", sizeof(sbf_section_recipe), 0, 6, section_recipe_fields, NULL};

static const sbfi_field chain_collider_fields[] = {
  {.name = "id", .type = SBFI_ID, .number = 1, .since_minor = 0, .offset = offsetof(sbf_chain_collider, id), .width = 1, .unit = "", .required = true, .initial.text = ""},
  {.name = "name", .type = SBFI_STRING, .number = 2, .since_minor = 0, .offset = offsetof(sbf_chain_collider, name), .width = 1, .unit = "", .initial.text = ""},
  {.name = "bone", .type = SBFI_REF, .number = 3, .since_minor = 0, .offset = offsetof(sbf_chain_collider, bone), .width = 1, .unit = "", .required = true, .reference.offset = offsetof(sbf_asset, bones), .reference.name = "bones"},
  {.name = "shape", .type = SBFI_ENUM, .number = 4, .since_minor = 0, .offset = offsetof(sbf_chain_collider, shape), .width = 1, .unit = "", .required = true, .words.at = chain_collider_shape_values, .words.count = 3},
  {.name = "position", .type = SBFI_VEC3, .number = 5, .since_minor = 0, .offset = offsetof(sbf_chain_collider, position), .width = 3, .unit = "m"},
  {.name = "end", .type = SBFI_VEC3, .number = 6, .since_minor = 0, .offset = offsetof(sbf_chain_collider, end), .width = 3, .unit = "m"},
  {.name = "normal", .type = SBFI_VEC3, .number = 7, .since_minor = 0, .offset = offsetof(sbf_chain_collider, normal), .width = 3, .unit = "", .initial.scalars = {0.0f, 1.0f, 0.0f}},
  {.name = "radius", .type = SBFI_FLOAT, .number = 8, .since_minor = 0, .offset = offsetof(sbf_chain_collider, radius), .width = 1, .unit = "m", .range.is_stated = true, .range.min = 0.0, .range.max = INFINITY, .range.min_open = false, .range.max_open = true},
  {.name = "inside", .type = SBFI_BOOL, .number = 9, .since_minor = 0, .offset = offsetof(sbf_chain_collider, inside), .width = 1, .unit = "", .initial.integer = 0},
};
static const sbfi_element chain_collider_element = {"chain_collider", "chain_collider", sizeof(sbf_chain_collider), 0, 9, chain_collider_fields, NULL};

static const sbfi_field asset_fields[] = {
  {.name = "version", .type = SBFI_STRING, .number = 1, .since_minor = 0, .offset = offsetof(sbf_asset, version), .width = 1, .unit = "", .required = true, .initial.text = "1.0"},
  {.name = "info", .type = SBFI_ONE, .number = 2, .since_minor = 0, .offset = offsetof(sbf_asset, info), .width = 1, .unit = "", .element = &info_element, .tag.xml = "asset"},
  {.name = "derivations", .type = SBFI_MANY, .number = 3, .since_minor = 0, .offset = offsetof(sbf_asset, derivations), .width = 1, .unit = "", .element = &derivation_element, .tag.xml = "derivation", .tag.wrapper = "derivations"},
  {.name = "textures", .type = SBFI_MANY, .number = 4, .since_minor = 0, .offset = offsetof(sbf_asset, textures), .width = 1, .unit = "", .element = &texture_element, .tag.xml = "texture", .tag.wrapper = "textures"},
  {.name = "materials", .type = SBFI_MANY, .number = 5, .since_minor = 0, .offset = offsetof(sbf_asset, materials), .width = 1, .unit = "", .element = &material_element, .tag.xml = "material", .tag.wrapper = "materials"},
  {.name = "bones", .type = SBFI_MANY, .number = 6, .since_minor = 0, .offset = offsetof(sbf_asset, bones), .width = 1, .unit = "", .element = &bone_element, .tag.xml = "bone", .tag.wrapper = "skeleton"},
  {.name = "rigid_bodies", .type = SBFI_MANY, .number = 7, .since_minor = 0, .offset = offsetof(sbf_asset, rigid_bodies), .width = 1, .unit = "", .element = &rigid_body_element, .tag.xml = "rigid_body", .tag.wrapper = "rigid_bodies"},
  {.name = "joints", .type = SBFI_MANY, .number = 8, .since_minor = 0, .offset = offsetof(sbf_asset, joints), .width = 1, .unit = "", .element = &joint_element, .tag.xml = "joint", .tag.wrapper = "joints", .tag.suffix = "_joint", .tag.by = "kind"},
  {.name = "render_meshes", .type = SBFI_MANY, .number = 9, .since_minor = 0, .offset = offsetof(sbf_asset, render_meshes), .width = 1, .unit = "", .element = &render_mesh_element, .tag.xml = "render_mesh"},
  {.name = "soft_bodies", .type = SBFI_MANY, .number = 10, .since_minor = 0, .offset = offsetof(sbf_asset, soft_bodies), .width = 1, .unit = "", .element = &soft_body_element, .tag.xml = "soft_body"},
  {.name = "cross_springs", .type = SBFI_MANY, .number = 11, .since_minor = 0, .offset = offsetof(sbf_asset, cross_springs), .width = 1, .unit = "", .element = &cross_springs_element, .tag.xml = "cross_springs"},
  {.name = "ik_chains", .type = SBFI_MANY, .number = 12, .since_minor = 0, .offset = offsetof(sbf_asset, ik_chains), .width = 1, .unit = "", .element = &ik_chain_element, .tag.xml = "ik_chain", .tag.wrapper = "ik"},
  {.name = "gaits", .type = SBFI_MANY, .number = 13, .since_minor = 0, .offset = offsetof(sbf_asset, gaits), .width = 1, .unit = "", .element = &gait_element, .tag.xml = "gait"},
  {.name = "chains", .type = SBFI_MANY, .number = 14, .since_minor = 0, .offset = offsetof(sbf_asset, chains), .width = 1, .unit = "", .element = &chain_element, .tag.xml = "chain", .tag.wrapper = "chains"},
  {.name = "followers", .type = SBFI_MANY, .number = 15, .since_minor = 0, .offset = offsetof(sbf_asset, followers), .width = 1, .unit = "", .element = &follower_element, .tag.xml = "follower", .tag.wrapper = "followers"},
  {.name = "clips", .type = SBFI_MANY, .number = 16, .since_minor = 0, .offset = offsetof(sbf_asset, clips), .width = 1, .unit = "", .element = &clip_element, .tag.xml = "clip", .tag.wrapper = "clips"},
  {.name = "poses", .type = SBFI_MANY, .number = 17, .since_minor = 0, .offset = offsetof(sbf_asset, poses), .width = 1, .unit = "", .element = &pose_element, .tag.xml = "pose", .tag.wrapper = "poses"},
  {.name = "bone_masks", .type = SBFI_MANY, .number = 18, .since_minor = 0, .offset = offsetof(sbf_asset, bone_masks), .width = 1, .unit = "", .element = &bone_mask_element, .tag.xml = "bone_mask", .tag.wrapper = "bone_masks"},
  {.name = "retarget_chains", .type = SBFI_MANY, .number = 19, .since_minor = 0, .offset = offsetof(sbf_asset, retarget_chains), .width = 1, .unit = "", .element = &retarget_chain_element, .tag.xml = "retarget_chain", .tag.wrapper = "retarget_chains"},
  {.name = "environment", .type = SBFI_ONE, .number = 20, .since_minor = 0, .offset = offsetof(sbf_asset, environment), .width = 1, .unit = "", .element = &environment_element, .tag.xml = "environment"},
  {.name = "relaxation", .type = SBFI_ONE, .number = 21, .since_minor = 0, .offset = offsetof(sbf_asset, relaxation), .width = 1, .unit = "", .element = &relaxation_element, .tag.xml = "relaxation"},
  {.name = "extensions", .type = SBFI_MANY, .number = 22, .since_minor = 0, .offset = offsetof(sbf_asset, extensions), .width = 1, .unit = "", .element = &extension_element, .tag.xml = "extension", .tag.wrapper = "extensions"},
  {.name = "section_recipes", .type = SBFI_MANY, .number = 23, .since_minor = 0, .offset = offsetof(sbf_asset, section_recipes), .width = 1, .unit = "", .element = &section_recipe_element, .tag.xml = "section_recipe", .tag.wrapper = "section_recipes"},
  {.name = "chain_colliders", .type = SBFI_MANY, .number = 24, .since_minor = 4, .offset = offsetof(sbf_asset, chain_colliders), .width = 1, .unit = "", .element = &chain_collider_element, .tag.xml = "chain_collider", .tag.wrapper = "chain_colliders"},
};
const sbfi_element sbfi_asset_element = {"asset", "sbf", sizeof(sbf_asset), SBFI_KIND('R', 'O', 'O', 'T'), 24, asset_fields, NULL};

void sbf_author_init(sbf_author *author) { sbfi_element_init(&author_element, author); }
void sbf_source_init(sbf_source *source) { sbfi_element_init(&source_element, source); }
void sbf_info_init(sbf_info *info) { sbfi_element_init(&info_element, info); }
void sbf_derivation_init(sbf_derivation *derivation) { sbfi_element_init(&derivation_element, derivation); }
void sbf_texture_init(sbf_texture *texture) { sbfi_element_init(&texture_element, texture); }
void sbf_uv_transform_init(sbf_uv_transform *uv_transform) { sbfi_element_init(&uv_transform_element, uv_transform); }
void sbf_material_init(sbf_material *material) { sbfi_element_init(&material_element, material); }
void sbf_bone_init(sbf_bone *bone) { sbfi_element_init(&bone_element, bone); }
void sbf_polygon_mesh_init(sbf_polygon_mesh *polygon_mesh) { sbfi_element_init(&polygon_mesh_element, polygon_mesh); }
void sbf_rigid_body_init(sbf_rigid_body *rigid_body) { sbfi_element_init(&rigid_body_element, rigid_body); }
void sbf_frame_init(sbf_frame *frame) { sbfi_element_init(&frame_element, frame); }
void sbf_limit_init(sbf_limit *limit) { sbfi_element_init(&limit_element, limit); }
void sbf_drive_init(sbf_drive *drive) { sbfi_element_init(&drive_element, drive); }
void sbf_joint_init(sbf_joint *joint) { sbfi_element_init(&joint_element, joint); }
void sbf_uv_set_init(sbf_uv_set *uv_set) { sbfi_element_init(&uv_set_element, uv_set); }
void sbf_material_slot_init(sbf_material_slot *material_slot) { sbfi_element_init(&material_slot_element, material_slot); }
void sbf_skin_init(sbf_skin *skin) { sbfi_element_init(&skin_element, skin); }
void sbf_shape_key_init(sbf_shape_key *shape_key) { sbfi_element_init(&shape_key_element, shape_key); }
void sbf_render_level_init(sbf_render_level *render_level) { sbfi_element_init(&render_level_element, render_level); }
void sbf_pin_set_init(sbf_pin_set *pin_set) { sbfi_element_init(&pin_set_element, pin_set); }
void sbf_render_mesh_init(sbf_render_mesh *render_mesh) { sbfi_element_init(&render_mesh_element, render_mesh); }
void sbf_attributes_init(sbf_attributes *attributes) { sbfi_element_init(&attributes_element, attributes); }
void sbf_collision_init(sbf_collision *collision) { sbfi_element_init(&collision_element, collision); }
void sbf_weight_map_init(sbf_weight_map *weight_map) { sbfi_element_init(&weight_map_element, weight_map); }
void sbf_attachment_init(sbf_attachment *attachment) { sbfi_element_init(&attachment_element, attachment); }
void sbf_tetrahedron_mesh_init(sbf_tetrahedron_mesh *tetrahedron_mesh) { sbfi_element_init(&tetrahedron_mesh_element, tetrahedron_mesh); }
void sbf_spring_set_init(sbf_spring_set *spring_set) { sbfi_element_init(&spring_set_element, spring_set); }
void sbf_shape_regions_init(sbf_shape_regions *shape_regions) { sbfi_element_init(&shape_regions_element, shape_regions); }
void sbf_jiggle_init(sbf_jiggle *jiggle) { sbfi_element_init(&jiggle_element, jiggle); }
void sbf_embedding_init(sbf_embedding *embedding) { sbfi_element_init(&embedding_element, embedding); }
void sbf_measured_init(sbf_measured *measured) { sbfi_element_init(&measured_element, measured); }
void sbf_simulation_init(sbf_simulation *simulation) { sbfi_element_init(&simulation_element, simulation); }
void sbf_calibration_init(sbf_calibration *calibration) { sbfi_element_init(&calibration_element, calibration); }
void sbf_level_init(sbf_level *level) { sbfi_element_init(&level_element, level); }
void sbf_legacy_init(sbf_legacy *legacy) { sbfi_element_init(&legacy_element, legacy); }
void sbf_soft_body_init(sbf_soft_body *soft_body) { sbfi_element_init(&soft_body_element, soft_body); }
void sbf_cross_springs_init(sbf_cross_springs *cross_springs) { sbfi_element_init(&cross_springs_element, cross_springs); }
void sbf_comfort_init(sbf_comfort *comfort) { sbfi_element_init(&comfort_element, comfort); }
void sbf_ik_chain_init(sbf_ik_chain *ik_chain) { sbfi_element_init(&ik_chain_element, ik_chain); }
void sbf_leg_init(sbf_leg *leg) { sbfi_element_init(&leg_element, leg); }
void sbf_head_turn_init(sbf_head_turn *head_turn) { sbfi_element_init(&head_turn_element, head_turn); }
void sbf_tail_init(sbf_tail *tail) { sbfi_element_init(&tail_element, tail); }
void sbf_undulation_init(sbf_undulation *undulation) { sbfi_element_init(&undulation_element, undulation); }
void sbf_fin_init(sbf_fin *fin) { sbfi_element_init(&fin_element, fin); }
void sbf_wheel_init(sbf_wheel *wheel) { sbfi_element_init(&wheel_element, wheel); }
void sbf_tread_init(sbf_tread *tread) { sbfi_element_init(&tread_element, tread); }
void sbf_medium_init(sbf_medium *medium) { sbfi_element_init(&medium_element, medium); }
void sbf_gait_init(sbf_gait *gait) { sbfi_element_init(&gait_element, gait); }
void sbf_chain_spring_init(sbf_chain_spring *chain_spring) { sbfi_element_init(&chain_spring_element, chain_spring); }
void sbf_chain_init(sbf_chain *chain) { sbfi_element_init(&chain_element, chain); }
void sbf_follower_init(sbf_follower *follower) { sbfi_element_init(&follower_element, follower); }
void sbf_track_init(sbf_track *track) { sbfi_element_init(&track_element, track); }
void sbf_clip_init(sbf_clip *clip) { sbfi_element_init(&clip_element, clip); }
void sbf_pose_key_init(sbf_pose_key *pose_key) { sbfi_element_init(&pose_key_element, pose_key); }
void sbf_pose_init(sbf_pose *pose) { sbfi_element_init(&pose_element, pose); }
void sbf_bone_mask_init(sbf_bone_mask *bone_mask) { sbfi_element_init(&bone_mask_element, bone_mask); }
void sbf_retarget_chain_init(sbf_retarget_chain *retarget_chain) { sbfi_element_init(&retarget_chain_element, retarget_chain); }
void sbf_force_field_init(sbf_force_field *force_field) { sbfi_element_init(&force_field_element, force_field); }
void sbf_environment_init(sbf_environment *environment) { sbfi_element_init(&environment_element, environment); }
void sbf_relaxation_init(sbf_relaxation *relaxation) { sbfi_element_init(&relaxation_element, relaxation); }
void sbf_extension_init(sbf_extension *extension) { sbfi_element_init(&extension_element, extension); }
void sbf_section_recipe_init(sbf_section_recipe *section_recipe) { sbfi_element_init(&section_recipe_element, section_recipe); }
void sbf_chain_collider_init(sbf_chain_collider *chain_collider) { sbfi_element_init(&chain_collider_element, chain_collider); }
void sbf_asset_init(sbf_asset *asset) { sbfi_element_init(&sbfi_asset_element, asset); }

const char *sbf_alpha_mode_name(sbf_alpha_mode value) {
  return (unsigned)value < 3u ? alpha_mode_values[value] : "?";
}

const char *sbf_attachment_rule_name(sbf_attachment_rule value) {
  return (unsigned)value < 2u ? attachment_rule_values[value] : "?";
}

const char *sbf_mesh_target_name(sbf_mesh_target value) {
  return (unsigned)value < 3u ? mesh_target_values[value] : "?";
}

const char *sbf_body_motion_name(sbf_body_motion value) {
  return (unsigned)value < 2u ? body_motion_values[value] : "?";
}

const char *sbf_joint_kind_name(sbf_joint_kind value) {
  return (unsigned)value < 10u ? joint_kind_values[value] : "?";
}

const char *sbf_joint_axis_name(sbf_joint_axis value) {
  return (unsigned)value < 8u ? joint_axis_values[value] : "?";
}

const char *sbf_volume_target_name(sbf_volume_target value) {
  return (unsigned)value < 1u ? volume_target_values[value] : "?";
}

const char *sbf_spring_kind_name(sbf_spring_kind value) {
  return (unsigned)value < 5u ? spring_kind_values[value] : "?";
}

const char *sbf_elastic_model_name(sbf_elastic_model value) {
  return (unsigned)value < 4u ? elastic_model_values[value] : "?";
}

const char *sbf_scheme_name(sbf_scheme value) {
  return (unsigned)value < 7u ? scheme_values[value] : "?";
}

const char *sbf_pressure_mode_name(sbf_pressure_mode value) {
  return (unsigned)value < 3u ? pressure_mode_values[value] : "?";
}

const char *sbf_weight_property_name(sbf_weight_property value) {
  return (unsigned)value < 9u ? weight_property_values[value] : "?";
}

const char *sbf_ik_solver_name(sbf_ik_solver value) {
  return (unsigned)value < 5u ? ik_solver_values[value] : "?";
}

const char *sbf_gait_kind_name(sbf_gait_kind value) {
  return (unsigned)value < 7u ? gait_kind_values[value] : "?";
}

const char *sbf_wave_plane_name(sbf_wave_plane value) {
  return (unsigned)value < 2u ? wave_plane_values[value] : "?";
}

const char *sbf_fin_motion_name(sbf_fin_motion value) {
  return (unsigned)value < 3u ? fin_motion_values[value] : "?";
}

const char *sbf_chain_kind_name(sbf_chain_kind value) {
  return (unsigned)value < 2u ? chain_kind_values[value] : "?";
}

const char *sbf_follower_channel_name(sbf_follower_channel value) {
  return (unsigned)value < 5u ? follower_channel_values[value] : "?";
}

const char *sbf_bone_axis_name(sbf_bone_axis value) {
  return (unsigned)value < 3u ? bone_axis_values[value] : "?";
}

const char *sbf_chain_collider_shape_name(sbf_chain_collider_shape value) {
  return (unsigned)value < 3u ? chain_collider_shape_values[value] : "?";
}

const char *sbf_track_property_name(sbf_track_property value) {
  return (unsigned)value < 3u ? track_property_values[value] : "?";
}

const char *sbf_interpolation_name(sbf_interpolation value) {
  return (unsigned)value < 3u ? interpolation_values[value] : "?";
}

const char *sbf_field_kind_name(sbf_field_kind value) {
  return (unsigned)value < 4u ? field_kind_values[value] : "?";
}

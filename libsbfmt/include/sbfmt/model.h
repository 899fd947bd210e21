/* The asset: plain read-only data, as the format defines it, with a header for each chapter.
 *
 * Units are SI: metres, kilograms, seconds, newtons, pascals, radians. Right-handed, +Y up, +Z forward; all positions
 * are in asset space and in the rest pose unless stated otherwise. A loaded asset owns everything it points to, and any
 * number of threads may read it at once. Strings are UTF-8 and never NULL. References are indices into a list of the
 * asset, or SBF_NONE. Square brackets give unit, range, default, and the length of a list.
 *
 * Made from spec/sbf.schema by spec/generate/generate.py: change the schema, not this file. */
#ifndef SBFMT_MODEL_H
#define SBFMT_MODEL_H

#include "sbfmt/model_info.h"
#include "sbfmt/model_appearance.h"
#include "sbfmt/model_skeleton.h"
#include "sbfmt/model_pins.h"
#include "sbfmt/model_mesh.h"
#include "sbfmt/model_rigid.h"
#include "sbfmt/model_elastic.h"
#include "sbfmt/model_level.h"
#include "sbfmt/model_soft_body.h"
#include "sbfmt/model_ik.h"
#include "sbfmt/model_gait.h"
#include "sbfmt/model_followers.h"
#include "sbfmt/model_animation.h"
#include "sbfmt/model_environment.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off

/* Version of the format that this library writes. */
#define SBF_FORMAT_VERSION "1.4"

/* A whole file: metres, kilograms, seconds, radians; right-handed, +Y up, +Z forward, rest pose. */
typedef struct sbf_asset {
  const char *version;                      /* Version of the format the file is written in, major.minor.
                                             * [default 1.0] */
  sbf_info info;                            /* Title and origin of the asset. */
  sbf_derivation_list derivations;          /* Records of what was computed, with settings and source. */
  sbf_texture_list textures;                /* Images used by materials. */
  sbf_material_list materials;              /* Appearances. */
  sbf_bone_list bones;                      /* The skeleton's bones, parents before children. */
  sbf_rigid_body_list rigid_bodies;         /* Rigid bodies. */
  sbf_joint_list joints;                    /* Constraints between rigid bodies; loops are allowed. */
  sbf_render_mesh_list render_meshes;       /* Visible meshes. */
  sbf_soft_body_list soft_bodies;           /* Deformable bodies; one with a bone is a section. */
  sbf_cross_springs_list cross_springs;     /* Springs between two bodies. */
  sbf_ik_chain_list ik_chains;              /* Chains of bones that reach for a target. */
  sbf_gait_list gaits;                      /* How the character moves. */
  sbf_chain_list chains;                    /* Chains of bones that follow their first bone. */
  sbf_follower_list followers;              /* Bones that follow their own pose as second-order systems. */
  sbf_clip_list clips;                      /* Keyed animation. */
  sbf_pose_list poses;                      /* Pose keys. */
  sbf_bone_mask_list bone_masks;            /* Weights per bone for blending. */
  sbf_retarget_chain_list retarget_chains;  /* Named chains of bones, for motion from other skeletons. */
  sbf_environment environment;              /* Gravity, wind, medium and fields. */
  sbf_relaxation relaxation;                /* Dimensionless settings of the relaxation scheme. */
  sbf_extension_list extensions;            /* Content beyond this specification. */
  sbf_section_recipe_list section_recipes;  /* Settings of sections that `build` cuts. */
  sbf_chain_collider_list chain_colliders;  /* Shapes that swinging chains collide with. */
} sbf_asset;

/* Sets every field to its default, lists to empty, references to SBF_NONE. */
SBF_API void sbf_asset_init(sbf_asset *asset);

// clang-format on

#ifdef __cplusplus
}
#endif
#endif

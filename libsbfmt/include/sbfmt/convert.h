/* Converts other programs' files to assets: OBJ by our own reader, everything else by assimp in a child
 * process.
 *
 * The result holds source parts only; sbf_build (sbfmt/build.h) makes the derived ones. Thread safe. */
#ifndef SBFMT_CONVERT_H
#define SBFMT_CONVERT_H

#include "sbfmt/asset.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Points to pin: those with weights in a vertex group or for a bone. */
typedef struct sbf_convert_pin {
  const char *group; /* a bone of the rig that a skin has weights for, or a vertex group that is not a bone */
  const char *bone;  /* bone to pin to; "": the world; NULL: the bone with the group's name, else the world */
} sbf_convert_pin;

/* Content of one file of a conversion, as read. */
typedef struct sbf_convert_source {
  char form[16];       /* "obj", "fbx", "glb", "vtu", "xml" ... */
  char generator[64];  /* the program that wrote the file; "" if it does not say */
  double unit_m;       /* metres per unit, as used */
  bool unit_stated;    /* by the file; false: by the call, or metres are assumed */
  bool axes_stated;    /* by the file; false: by the call, or +Y up is assumed */
  uint32_t objects;    /* surfaces */
  uint32_t vertices;   /* as stored: the points of an OBJ, otherwise split for drawing */
  uint32_t points;     /* of the surfaces, or of the tetrahedra */
  uint32_t polygons;   /* of the surfaces */
  uint32_t bones;      /* in the node tree */
  uint32_t materials;  /* of the file */
  uint32_t images;     /* named by materials, or embedded */
  uint32_t clips;      /* animations */
  uint32_t tetrahedra; /* of a file of tetrahedra */
} sbf_convert_source;

/* Content of all files read. */
typedef struct sbf_convert_summary {
  uint32_t source_count;         /* number of sources */
  sbf_convert_source sources[2]; /* the input and, if it is another file, the rig */
} sbf_convert_summary;

/* Preset for the limits of joints that the input does not limit. */
typedef enum sbf_convert_limits {
  SBF_CONVERT_LIMITS_NONE = 0,
  SBF_CONVERT_LIMITS_HUMAN = 1,
  SBF_CONVERT_LIMITS_QUADRUPED = 2,
  SBF_CONVERT_LIMITS_REPTILE = 3
} sbf_convert_limits;

/* Attaches the part of a soft body that lies inside a holder. The holder is another object of the input,
 * which becomes a rigid body (its convex hull, on the object's bone) and is no longer soft or drawn; or the
 * rigid body of the bone of that name. */
typedef struct sbf_convert_attachment {
  const char *body;   /* the soft body's name */
  const char *holder; /* name of the object or the bone */
} sbf_convert_attachment;

/* Points of soft bodies to pin. */
typedef struct sbf_convert_pinning {
  /* Each mesh that has one of these groups becomes a soft body as a whole, pinned at the points with weights;
   * its skin, if any, is ignored. Weight 1 pins rigidly, a lower weight pulls with the stiffness
   *
   *     k(w) = goal_stiffness * w / (2 - w),     w cut to goal_minimum ... goal_maximum
   *
   * This is Blender's rule s / (1 - s), s = w * goal spring constant, with its constant 1/2; another constant
   * g is the stiffness times g / (1 - g). */
  const sbf_convert_pin *pins;       /* (pin_count) */
  uint32_t pin_count;                /* number of pins */
  double goal_minimum, goal_maximum; /* 0..1; a maximum of 0 counts as 1 */
  double goal_stiffness;             /* N/m at weight 1; 0: from the body's modulus and the point's mass */
  /* Pins inside sections cut from a skin. They work like `pins`, but the skin stays one mesh. Without a bone,
   * the painted points are pinned to the bone of the section they lie in. */
  const sbf_convert_pin *section_pins; /* (section_pin_count) */
  uint32_t section_pin_count;          /* number of section_pins */
} sbf_convert_pinning;

/* How a rig in another file moves the input. */
typedef struct sbf_convert_rigging {
  /* Source of the bone weights of the input's points: "named" (objects named after nodes of the rig), "match"
   * (points of the rig's own mesh at the same positions), "transfer" (the nearest surface of a similar mesh),
   * "compute" (from the bones only), or the path of a file of weights, .csv or .json with vertex, bone and
   * weight, vertices from 0 as in the OBJ. NULL: the first of these that fits each object. */
  const char *weights;
  /* Objects of the input that one bone moves; this overrides all other weights. `group` is the object's name,
   * or NAME#NUMBER for one of its shells (connected components), ordered by their first points and counted
   * from 1. `bone` moves it. */
  const sbf_convert_pin *shells; /* (shell_count) */
  uint32_t shell_count;          /* number of shells */
  /* If the conversion fails because the rig lies outside the input (IMPORT_RIG_OUTSIDE), receives an asset
   * that shows both in their best alignment: bones and one render mesh. The caller frees it. Otherwise not
   * written. May be NULL. */
  sbf_asset **misfit;
} sbf_convert_rigging;

/* Parts of a skin that become sections. By default these are parts whose motion a viewer would see. The
 * defaults leave out machines (pieces on one bone each), hands, feet, lower limbs, faces, props, hard
 * materials, and parts that are thin or small relative to the whole; there are at most eight. Each part gets
 * a section recipe, marked as proposed. If a character has such a skin, objects on its bones are drawn only
 * and get no bodies, unless `soft` or a pin names them. */
typedef struct sbf_convert_softness {
  double firmness;          /* the modulus is this times 1.5 rho g times the largest extent; 0 counts as 1 */
  const char *const *soft;  /* (soft_count) names or ids of bones that are always soft; "*": all bones */
  uint32_t soft_count;      /* number of soft */
  const char *const *rigid; /* (rigid_count) the same of bones that are never soft; precedes `soft` */
  uint32_t rigid_count;     /* number of rigid */
} sbf_convert_softness;

/* Settings of a conversion. */
typedef struct sbf_convert_options {
  size_t struct_size;             /* sizeof(sbf_convert_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  const char *rig;                /* a file with the skeleton, if the input has none; NULL: none */
  double unit_m;                  /* metres per unit of the input; 0: as the file says, else 1 */
  char up;                        /* 'y' or 'z': the input's upward axis; 0: as the file says, else y */
  /* The axis of the input along which the character looks, perpendicular to the upward one: "x", "-x", "y",
   * "-y", "z" or "-z". It becomes +Z and disables the automatic rotation. NULL: found from the legs. */
  const char *forward;
  bool no_gait; /* do not propose a gait */
  /* Kind of gait: "walk", "swim", "fly", "slither", "crawl", "roll" or "none"; NULL: found from the shape of
   * the rig, its names and its clips (GAIT_KIND). */
  const char *gait;
  const char *import_helper; /* path of the program sbfmt-import; NULL: searched in its usual locations */
  /* Warnings, and errors that did not stop the conversion; may be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user;                   /* for the callback */
  sbf_convert_summary *summary; /* receives the content read; may be NULL */
  /* Proposes limits for joints that have none, from the names and positions of the bones. Bones of skins then
   * get joints too. */
  sbf_convert_limits limits;
  /* Keep the modulus of bodies without pins at its default even if it would not carry their weight, for
   * callers that set the material afterwards (sbfmt/materials.h). */
  bool keep_modulus;
  sbf_convert_pinning pinning; /* points to pin */
  /* Attachments to rigid hulls. They pin every point of a soft body inside the hull, on each level that a
   * build makes. */
  const sbf_convert_attachment *attachments; /* (attachment_count) */
  uint32_t attachment_count;                 /* number of attachments */
  sbf_convert_rigging rigging;               /* for a rig in another file */
  sbf_convert_softness softness;             /* parts of a skin that become soft */
} sbf_convert_options;

/* Reads `input` (and the rig) into a new asset. The rig's node tree assigns sections to bones; names only
 * decide which object of the input corresponds to a node of the rig. `options` may be NULL. */
SBF_API sbf_status sbf_convert(
    const char *input, const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error);

/* Adds the clips of another file to an asset under construction, retargeted to its bones. `file` has any form
 * that holds a skeleton and its animation (BVH, FBX, glTF ...), or is a bundle.
 *
 * Bones correspond by retarget chains of the same name, by equal names, or by names for the same part of the
 * same side (LeftUpLeg, thigh.L, mixamorig:LeftUpLeg). Each bone rotates from its rest pose as its
 * counterpart does in asset space. Thighs, shins, upper and lower arms point in the same direction as their
 * counterparts, whatever the two rest poses are. The hips travel in proportion to their height above the
 * ground, starting from the asset's position; all other bones keep their lengths. Reports the clips
 * (IMPORT_MOTION) and the bones without a counterpart (IMPORT_MOTION_UNMATCHED).
 *
 * Uses only allocator, import_helper, report and user of `options` (may be NULL). On failure the asset keeps
 * the clips it had. IMPORT_MOTION_NONE: the file has no clip, or no bone with a counterpart. */
SBF_API sbf_status sbf_convert_motion(
    sbf_asset *asset, const char *file, const sbf_convert_options *options, sbf_diagnostic *error);

/* Proposes the gait of an asset under construction, as `sbf_convert` does: its kind (GAIT_KIND), legs with
 * their IK chains, head and tail, waves, fins, wheels. It uses the rig's shape, its names and its clips.
 * Every part is marked as proposed. An asset that has a gait, chains or IK chains is not changed. Kind none
 * gets no gait (RIG_NO_LEGS).
 *
 * Uses only allocator, gait, report and user of `options` (may be NULL). On failure (no memory, BAD_CALL) the
 * asset has no gait. */
SBF_API sbf_status sbf_convert_gait(
    sbf_asset *asset, const sbf_convert_options *options, sbf_diagnostic *error);

/* How a character stands relative to the stance that gaits expect: on y = 0, looking along +Z. */
typedef struct sbf_convert_stance {
  size_t struct_size;     /* sizeof(sbf_convert_stance), or 0 for this version's; set by the caller */
  uint32_t quarter_turns; /* 0..3: quarter turns about +Y from +Z to its looking direction; at 1 it looks
                           * along +X */
  double ground_m;        /* y of its lowest foot */
  double height_m;        /* height of the parts that its bones move, from the lowest point */
} sbf_convert_stance;

/* Reports what would have to change in an asset for `sbf_convert_gait` to find its legs as `sbf_convert` does
 * when it reads bones. The asset is not changed.
 *
 * `hangs_on` (asset->bones.count) receives SBF_NONE, or the parent that a bone should have. The second
 * applies to a bone below the root that moves the skin at the end of a limb, as animator-controlled feet do.
 * After reparenting call this again: `stance` is of the skeleton as given.
 *
 * `stance` comes from the legs. Forward and backward are told apart by the names of the legs (foot.L,
 * RightFoot), else by the direction of the feet. Without legs, quarter_turns and ground_m are 0. Uses only
 * the allocator of `options` (may be NULL). Fails if memory runs out, or with BAD_CALL. */
SBF_API sbf_status sbf_convert_stand(const sbf_asset *asset, const sbf_convert_options *options,
    sbf_convert_stance *stance, int32_t *hangs_on, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif

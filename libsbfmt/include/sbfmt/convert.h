/* Other programs' files to assets: OBJ by our own reader, everything else by assimp in a child process.
 *
 * What comes out holds source parts only; sbf_build (sbfmt/build.h) makes the derived ones. Thread safe. */
#ifndef SBFMT_CONVERT_H
#define SBFMT_CONVERT_H

#include "sbfmt/asset.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Points to be held: those that a vertex group, or the weights of a bone, name. */
typedef struct sbf_convert_pin {
  const char *group; /* a bone of the rig that a skin has weights of, or a vertex group that is no bone */
  const char *bone;  /* that is to hold; "": the world; NULL: the bone of the group's name, else the world */
} sbf_convert_pin;

/* What one file of a conversion held, as it came in. */
typedef struct sbf_convert_source {
  char form[16];       /* "obj", "fbx", "glb", "vtu", "xml" ... */
  char generator[64];  /* the program that wrote it, "" where it does not say */
  double unit_m;       /* metres in one of its units, as they were taken */
  bool unit_stated;    /* by the file; else by the call, or metres are assumed */
  bool axes_stated;    /* likewise; +Y up is assumed */
  uint32_t objects;    /* surfaces */
  uint32_t vertices;   /* as stored: of OBJ its points, elsewhere split for drawing */
  uint32_t points;     /* of the surfaces, or of the tetrahedra */
  uint32_t polygons;   /* of the surfaces */
  uint32_t bones;      /* in the node tree */
  uint32_t materials;  /* as the file has them */
  uint32_t images;     /* that materials name, or that are embedded */
  uint32_t clips;      /* animations */
  uint32_t tetrahedra; /* of a file of tetrahedra */
} sbf_convert_source;

/* What came in. */
typedef struct sbf_convert_summary {
  uint32_t source_count;         /* of sources */
  sbf_convert_source sources[2]; /* the input and, where it is a file of its own, the rig */
} sbf_convert_summary;

/* Whose joints they are like, where the input does not say how far they turn. */
typedef enum sbf_convert_limits {
  SBF_CONVERT_LIMITS_NONE = 0,
  SBF_CONVERT_LIMITS_HUMAN = 1,
  SBF_CONVERT_LIMITS_QUADRUPED = 2,
  SBF_CONVERT_LIMITS_REPTILE = 3
} sbf_convert_limits;

/* A soft body, and what holds everything of it that lies inside: another object of the input, which becomes a
 * rigid body of its convex hull on the bone that it hangs on, neither soft nor drawn any more; or the rigid
 * body of the bone of that name. */
typedef struct sbf_convert_attachment {
  const char *body;   /* the soft body's name */
  const char *holder; /* the object's name, or the bone's */
} sbf_convert_attachment;

/* Settings of a conversion. */
typedef struct sbf_convert_options {
  size_t struct_size;             /* sizeof(sbf_convert_options), or 0 for this version's */
  const sbf_allocator *allocator; /* NULL: malloc */
  const char *rig;                /* a file with the skeleton, where the input has none; NULL: none */
  double unit_m;                  /* metres in a unit of the input; 0: what the file says, else 1 */
  char up;                        /* 'y' or 'z': the input's upward axis; 0: what the file says, else y */
  bool no_gait;                   /* do not propose a gait */
  const char *import_helper;      /* path of the program sbfmt-import; NULL: its usual places */
  /* Warnings, and errors that did not stop the conversion; may be NULL. */
  void (*report)(void *user, const sbf_diagnostic *diagnostic);
  void *user; /* for the callback */
  /* Each mesh that has one of these groups becomes a soft body of its own, all of it, pinned where the group
   * has weights; a skin it may have moves nothing then. Weight 1 holds fast, less draws with the stiffness
   *
   *     k(w) = goal_stiffness * w / (2 - w),     w cut to goal_minimum ... goal_maximum
   *
   * which is Blender's rule s / (1 - s), s = w * goal spring constant, for its constant of 1/2; a constant g
   * is the stiffness times g / (1 - g). */
  const sbf_convert_pin *pins;       /* (pin_count) */
  uint32_t pin_count;                /* of pins */
  double goal_minimum, goal_maximum; /* 0..1; a maximum of 0 counts as 1 */
  double goal_stiffness;             /* N/m at weight 1; 0: by the body's modulus and the point's mass */
  sbf_convert_summary *summary;      /* receives what came in; may be NULL */
  /* Limits proposed for joints that have none, by the names of the bones and their places; bones of skins get
   * joints too then. */
  sbf_convert_limits limits;
  /* Leave the modulus of bodies that nothing holds at its default where it would not bear their weight, as
   * where the caller knows what they are made of (sbfmt/materials.h). */
  bool keep_modulus;
  /* What sections cut from a skin hold: like pins, but the skin stays one. Without a bone what is painted
   * goes with the bone of the section that it lies in. */
  const sbf_convert_pin *holds; /* (hold_count) */
  uint32_t hold_count;          /* of holds */
  /* What rigid hulls hold: everything of a soft body inside one, on each level that a build makes. */
  const sbf_convert_attachment *attachments; /* (attachment_count) */
  uint32_t attachment_count;                 /* of attachments */
  /* Where the bones that move each point of the input come from, where the rig is another file: "named"
   * (objects that are called as nodes of the rig), "match" (points of the rig's own mesh, by place),
   * "transfer" (the nearest surface of a mesh like it), "compute" (the bones alone), or the path of a file of
   * weights, .csv or .json with vertex, bone and weight, vertices from 0 as in the OBJ; NULL: the first of
   * these that fits each object.
   */
  const char *weights;
  /* Receives, where the conversion fails because the rig lies outside the input (IMPORT_RIG_OUTSIDE), an
   * asset of both as they were laid over each other at best: bones and one render mesh, to be looked at, and
   * freed by the caller. Else it stays as it is; may be NULL. */
  sbf_asset **misfit;
  /* Objects of the input that one bone of a rig in another file is to move, whatever else says so: `group` is
   * the object's name, or NAME#NUMBER for one of its shells, pieces that share no point, by their first
   * points from 1; `bone` moves it. */
  const sbf_convert_pin *shells; /* (shell_count) */
  uint32_t shell_count;          /* of shells */
  /* The axis of the input along which it looks, perpendicular to its upward one: "x", "-x", "y", "-y", "z" or
   * "-z". It becomes +Z, and nothing is turned afterwards; NULL: found by its legs. */
  const char *forward;
  /* Parts of a skin that become sections. The defaults are those that a viewer would see move: not machines,
   * which are pieces on one bone each; nor hands, feet, lower limbs, faces, props, hard materials, parts that
   * are thin or small against the whole; eight at most. Their modulus is 1.5 rho g times the largest extent,
   * times `firmness`; 0 counts as 1. Each part gets a section recipe, marked as proposed. `soft` and `rigid`
   * are names or ids of bones that are soft or rigid whatever the defaults; "*": all bones; `rigid` goes
   * before `soft`. Objects on bones of a character with such a skin are drawn and no bodies, but for those
   * that `soft` or a pin names. */
  double firmness;
  const char *const *soft;  /* (soft_count) */
  uint32_t soft_count;      /* of soft */
  const char *const *rigid; /* (rigid_count) */
  uint32_t rigid_count;     /* of rigid */
  /* How it moves: "walk", "swim", "fly", "slither", "crawl", "roll" or "none"; NULL: judged by the shape of
   * the rig, its names and its clips (GAIT_KIND). */
  const char *gait;
} sbf_convert_options;

/* Reads `input` (and the rig) into a new asset. Sections are mapped to bones by the rig's node tree; names
 * decide only which object of the input a node of the rig stands for. `options` may be NULL. */
SBF_API sbf_status sbf_convert(
    const char *input, const sbf_convert_options *options, sbf_asset **asset, sbf_diagnostic *error);

/* Adds the clips of another file to an asset that is under construction, carried over to its bones: `file` is
 * of any form that holds a skeleton and its animation (BVH, FBX, glTF ...), or a bundle.
 *
 * Bones stand for each other by retarget chains of one name, by their names, or by names that mean the same
 * part of the same side (LeftUpLeg, thigh.L, mixamorig:LeftUpLeg). Each turns away from its rest pose as its
 * counterpart does in asset space; thighs, shins, upper and lower arms point as their counterparts do,
 * whatever the two rest poses. The hips travel in proportion to their height above the ground, from where the
 * asset stands; all other bones keep their lengths. Said are the clips (IMPORT_MOTION) and the bones without
 * a counterpart (IMPORT_MOTION_UNMATCHED).
 *
 * Of `options` (may be NULL) only allocator, import_helper, report and user are heeded. On failure the asset
 * has the clips it had. IMPORT_MOTION_NONE: the file has no clip, or no bone that stands for one. */
SBF_API sbf_status sbf_convert_motion(
    sbf_asset *asset, const char *file, const sbf_convert_options *options, sbf_diagnostic *error);

/* Proposes how an asset under construction moves, as `sbf_convert` does: its kind (GAIT_KIND), legs with
 * their chains of inverse kinematics, head and tail, waves, fins, wheels, by the rig's shape, its names and
 * its clips. Every part is marked as proposed. An asset that has a gait, chains or chains of inverse
 * kinematics stays as it is. Kind none gets no gait (RIG_NO_LEGS).
 *
 * Of `options` (may be NULL) only allocator, gait, report and user are heeded. On failure (no memory,
 * BAD_CALL) the asset has no gait. */
SBF_API sbf_status sbf_convert_gait(
    sbf_asset *asset, const sbf_convert_options *options, sbf_diagnostic *error);

/* How a character stands, against how one does that walks: on y = 0, looking along +Z. */
typedef struct sbf_convert_stance {
  size_t struct_size;     /* sizeof(sbf_convert_stance), or 0 for this version's: set by the caller */
  uint32_t quarter_turns; /* 0..3 about +Y, by which it is turned away from +Z: at 1 it looks along +X */
  double ground_m;        /* y of its lowest foot */
  double height_m;        /* of what its bones hold, from its lowest point */
} sbf_convert_stance;

/* Says what of an asset would have to change for `sbf_convert_gait` to find its legs, as `sbf_convert` finds
 * them where it reads bones; the asset stays as it is.
 *
 * `hangs_on` (asset->bones.count) receives SBF_NONE, or the bone that one ought to hang on that hangs on the
 * root and holds the skin where a limb ends, as feet do that are moved by hand. Where that is so, hang it
 * there and ask again: `stance` is of the skeleton as it is.
 *
 * `stance` is that of its legs. Which of two ways it looks is told by the names of its legs (foot.L,
 * RightFoot), else by where its feet point; turns are 0 and the ground is 0 where it has no legs. Of
 * `options` (may be NULL) only the allocator is heeded. Fails where memory runs out, or by BAD_CALL. */
SBF_API sbf_status sbf_convert_stand(const sbf_asset *asset, const sbf_convert_options *options,
    sbf_convert_stance *stance, int32_t *hangs_on, sbf_diagnostic *error);

#ifdef __cplusplus
}
#endif
#endif

/* Rigs objects without a skeleton from another file: aligns them with the rig and finds the bones of each
 * point. */
#ifndef SBFI_RIGGING_H
#define SBFI_RIGGING_H

#include "import/convert/conversion.h"

/* Runs after the skeleton pass. If the rig is another file, or the options request weights, replaces the
 * conversion's scene and rig by one scene, as if a single file had the input's objects, with skins, in the
 * rig's node tree. Otherwise does nothing. */
sbf_status sbfi_rig_input(sbfi_conversion *c);

/* --- What the files of this folder share ------------------------------------------------------------- */

/* Maximum number of bones per point; the strongest are kept. */
enum { SBFI_MAX_INFLUENCES = 12 };

typedef struct sbfi_influence {
  uint32_t node; /* of the rig */
  float weight;  /* 0: end of the list */
} sbfi_influence;

/* Weights of one point, ordered by node. They sum to 1, or the list is empty. */
typedef struct sbfi_influences {
  sbfi_influence at[SBFI_MAX_INFLUENCES];
} sbfi_influences;

/* All meshes of a scene, concatenated in one space. */
typedef struct sbfi_scene_surface {
  const sbfi_scene *scene;
  sbf_polygon_mesh mesh;
  const uint32_t *mesh_starts;      /* (scene->mesh_count + 1) first point of each mesh */
  const uint32_t *polygon_starts;   /* (scene->mesh_count + 1) first polygon of each mesh */
  const uint32_t *neighbour_starts; /* (points + 1) first index into neighbours */
  const uint32_t *neighbours;       /* points that share a polygon's edge, with duplicates */
  /* (points) unit normals, means over the surrounding polygons; 0 if there are none or they face opposite
   * directions */
  const sbf_vec3 *normals;
  sbf_vec3 low, high;
  double size; /* diagonal of the bounding box */
} sbfi_scene_surface;

/* Source of a point's weights. */
typedef enum sbfi_weight_source {
  SBFI_WEIGHTS_NONE,
  SBFI_WEIGHTS_NAMED,       /* its object has the name of a node of the rig */
  SBFI_WEIGHTS_MATCHED,     /* a point of the rig's meshes is at this position */
  SBFI_WEIGHTS_TRANSFERRED, /* transferred from the nearest surface of the rig */
  SBFI_WEIGHTS_ATTACHED,    /* attached piece: no surface of the rig near it has a similar normal */
  SBFI_WEIGHTS_COMPUTED,    /* computed from the bones alone */
  SBFI_WEIGHTS_FROM_FILE,   /* read from --weights FILE */
  SBFI_WEIGHTS_SOURCES
} sbfi_weight_source;

/* Alignment of the input with the rig. */
typedef struct sbfi_alignment {
  sbfi_matrix to_asset; /* from the input's own space */
  double matched;       /* fraction of the input's points at a point of the rig */
  double inside;        /* fraction of the bones' length inside the input; 0: not measured */
  bool is_stated;       /* equals what the files and the options state */
  /* Pose of the rig in the alignment: at a time of a clip, or without a clip the saved pose. NULL: the
   * bind pose. */
  const sbfi_matrix *pose_worlds; /* (nodes) */
  const sbfi_scene_clip *pose_clip;
  double pose_s;
} sbfi_alignment;

typedef struct sbfi_rigging {
  sbfi_conversion *c;
  sbfi_scene_surface input;           /* in its own space */
  sbfi_scene_surface rig, bound;      /* in asset space: in the current pose, and in the bind pose */
  const sbfi_influences *rig_weights; /* (rig points) */
  sbfi_alignment alignment;
  /* Mean distance between the input and the rig's weighted meshes as a fraction of the rig's size; 0 if
   * they are similar or the rig has none. */
  double mean_gap;
  sbfi_influences *weights; /* (input points) */
  uint8_t *sources;         /* (input points) sbfi_weight_source */
  /* (input meshes) node of the rig that moves the whole mesh without a skin, or SBF_NONE */
  int32_t *parent_nodes;
  int32_t *matched_nodes; /* (input meshes) node of the rig's unskinned mesh that contains all its points */
  const char **names;     /* (input meshes) */
  bool *separated;        /* (input meshes) whether it was reported as separated from the rig */
  bool *is_reversed;      /* (input meshes) its polygons face away from those of the rig */
} sbfi_rigging;

/* Allocates from the conversion's scratch; false if memory runs out. */
bool sbfi_surface_gather(
    sbfi_scene_surface *surface, const sbfi_scene *scene, const sbfi_matrix *to_space, sbfi_arena *arena);
/* Transforms a surface. */
bool sbfi_surface_move(
    sbfi_scene_surface *to, const sbfi_scene_surface *from, const sbfi_matrix *matrix, sbfi_arena *arena);
/* Replaces the positions, which must outlive the result. */
bool sbfi_surface_with_positions(
    sbfi_scene_surface *to, const sbfi_scene_surface *from, const sbf_vec3 *positions, sbfi_arena *arena);
/* Triangulates its polygons as fans from their first corners; NULL if memory runs out. */
uint32_t (*sbfi_surface_triangles(const sbfi_scene_surface *surface, uint32_t *count, sbfi_arena *arena))[3];
/* Weights of the points of all meshes: from their skins, or from the bone of a mesh without a skin. */
sbfi_influences *sbfi_rig_weights(sbfi_conversion *c, const sbfi_scene_surface *surface);

/* Adds to a list in any order; drops the weakest beyond the capacity. */
void sbfi_influences_add(sbfi_influences *to, uint32_t node, double weight);
/* Sorts by node and normalizes the sum to 1. */
void sbfi_influences_finish(sbfi_influences *of);
bool sbfi_influences_equal(const sbfi_influences *a, const sbfi_influences *b);

#endif

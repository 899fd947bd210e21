/* Objects without a skeleton of their own get the bones of a rig in another file: where they lie in it, and
 * which of its bones move each point. */
#ifndef SBFI_RIGGING_H
#define SBFI_RIGGING_H

#include "import/convert/conversion.h"

/* A pass after the skeleton. Where the rig is another file, or weights are asked for by an option, the
 * conversion's scene and rig become one scene, as if a file had held the input's objects in the rig's node
 * tree, with their skins. Else nothing changes. */
sbf_status sbfi_rig_input(sbfi_conversion *c);

/* --- What the files of this folder share ------------------------------------------------------------- */

/* The most bones that move one point; the strongest stay. */
enum { SBFI_MAX_INFLUENCES = 12 };

typedef struct sbfi_influence {
  uint32_t node; /* of the rig */
  float weight;  /* 0: no more follow */
} sbfi_influence;

/* Of one point: nodes ascending, weights that sum to 1, or none. */
typedef struct sbfi_influences {
  sbfi_influence at[SBFI_MAX_INFLUENCES];
} sbfi_influences;

/* All meshes of a scene, one after another, in one space. */
typedef struct sbfi_scene_surface {
  const sbfi_scene *scene;
  sbf_polygon_mesh mesh;
  const uint32_t *mesh_starts;      /* (scene->mesh_count + 1) first point of each mesh */
  const uint32_t *polygon_starts;   /* (scene->mesh_count + 1) first polygon of each mesh */
  const uint32_t *neighbour_starts; /* (points + 1) into neighbours */
  const uint32_t *neighbours;       /* points that share a polygon's side, with repeats */
  /* (points) of unit length, of the polygons around; 0 where they have none or face opposite ways */
  const sbf_vec3 *normals;
  sbf_vec3 low, high;
  double size; /* diagonal of that box */
} sbfi_scene_surface;

/* How the points of the input came by their weights. */
typedef enum sbfi_weight_source {
  SBFI_WEIGHTS_NONE,
  SBFI_WEIGHTS_NAMED,     /* its object stands for a node of the rig */
  SBFI_WEIGHTS_MATCHED,   /* a point of the rig's meshes lies there */
  SBFI_WEIGHTS_CARRIED,   /* of the nearest surface of the rig */
  SBFI_WEIGHTS_ATTACHED,  /* its piece touches no surface of the rig that faces as it does */
  SBFI_WEIGHTS_COMPUTED,  /* from the bones alone */
  SBFI_WEIGHTS_FROM_FILE, /* of --weights FILE */
  SBFI_WEIGHTS_SOURCES
} sbfi_weight_source;

/* How the input was laid over the rig. */
typedef struct sbfi_alignment {
  sbfi_matrix to_asset; /* the input's own space to asset space */
  double matched;       /* share of the input's points that lie on one of the rig's */
  double inside;        /* share of the bones' length that lies inside the input; 0: not looked at */
  bool is_stated;       /* as the files and the options say */
  /* The rig's pose that it was laid over; NULL: the one that its skins were bound in. A moment of a clip, or
   * without a clip the pose that the rig's file was saved in. */
  const sbfi_matrix *pose_worlds; /* (nodes) */
  const sbfi_scene_clip *pose_clip;
  double pose_s;
} sbfi_alignment;

typedef struct sbfi_rigging {
  sbfi_conversion *c;
  sbfi_scene_surface input;           /* in its own space */
  sbfi_scene_surface rig, bound;      /* in asset space: in the pose at hand, and as its skins were bound */
  const sbfi_influences *rig_weights; /* (rig points) */
  sbfi_alignment alignment;
  /* Mean distance between the input and the rig's weighted meshes where those are not alike, as a share of
   * the rig's size; 0 where they are, or where the rig has none. */
  double unlike;
  sbfi_influences *weights; /* (input points) */
  uint8_t *sources;         /* (input points) sbfi_weight_source */
  int32_t *carriers;  /* (input meshes) node of the rig that carries all of it without a skin, or SBF_NONE */
  int32_t *lies_on;   /* (input meshes) node of the rig's mesh without a skin that has all its points */
  const char **names; /* (input meshes) */
  bool *separated;    /* (input meshes) its message that it lies apart from the rig was sent */
  bool *turned;       /* (input meshes) its polygons face away from those of the rig */
} sbfi_rigging;

/* Memory of the conversion's scratch; false where it runs out. */
bool sbfi_surface_gather(
    sbfi_scene_surface *surface, const sbfi_scene *scene, const sbfi_matrix *to_space, sbfi_arena *arena);
/* The same surface elsewhere. */
bool sbfi_surface_move(
    sbfi_scene_surface *to, const sbfi_scene_surface *from, const sbfi_matrix *matrix, sbfi_arena *arena);
/* The same surface with other positions, which must outlive it. */
bool sbfi_surface_with_positions(
    sbfi_scene_surface *to, const sbfi_scene_surface *from, const sbf_vec3 *positions, sbfi_arena *arena);
/* Its polygons as fans of triangles from their first corners; NULL where memory runs out. */
uint32_t (*sbfi_surface_triangles(const sbfi_scene_surface *surface, uint32_t *count, sbfi_arena *arena))[3];
/* Weights of the points of all meshes: of their skins, or of the bone that a mesh without one hangs on. */
sbfi_influences *sbfi_rig_weights(sbfi_conversion *c, const sbfi_scene_surface *surface);

/* Adds to a list in any order; of more than there is room for the weakest go. */
void sbfi_influences_add(sbfi_influences *to, uint32_t node, double weight);
/* In the order of nodes, summing to 1. */
void sbfi_influences_finish(sbfi_influences *of);
bool sbfi_influences_equal(const sbfi_influences *a, const sbfi_influences *b);

#endif

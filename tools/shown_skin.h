/* The skin of a session's character as triangles for the renderer: by material, at one render level,
 * without torn polygons, with the hard edges of the meshes' normals. */
#ifndef SHOWN_SKIN_H
#define SHOWN_SKIN_H

#include "render/draw_scene.h"
#include "session.h"
#include "skin_material.h"

typedef struct shown_skin shown_skin;

/* `images` must outlive the skin. `render_level` of each mesh: 0 the full one; the last if there are
 * fewer. NULL if memory runs out. */
shown_skin *shown_skin_create(const session *s, const skin_images *images, uint32_t render_level);
void shown_skin_destroy(shown_skin *skin);

/* Adds the current skin, translated by `origin`. */
void shown_skin_add(
    shown_skin *skin, const session *s, sbf_vec3 origin, float transparency, draw_scene *scene);

#endif

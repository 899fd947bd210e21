/* The skin of a character of a session as triangles of the renderer: by material, at one render level,
 * without the polygons that a tear has opened, with the hard edges that the meshes' own normals show. */
#ifndef SHOWN_SKIN_H
#define SHOWN_SKIN_H

#include "render/draw_scene.h"
#include "session.h"
#include "skin_material.h"

typedef struct shown_skin shown_skin;

/* `images` stay with the caller, until the skin is gone. `render_level` of each mesh: 0 the full one; where
 * there are fewer, the last. NULL: no memory. */
shown_skin *shown_skin_create(const session *s, const skin_images *images, uint32_t render_level);
void shown_skin_destroy(shown_skin *skin);

/* Adds the present skin, moved by `origin`. */
void shown_skin_add(
    shown_skin *skin, const session *s, sbf_vec3 origin, float transparency, draw_scene *scene);

#endif

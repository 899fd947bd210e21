/* The texts of shaders/, embedded into the program at build time. */
#ifndef RENDER_SHADER_TEXTS_H
#define RENDER_SHADER_TEXTS_H

extern const char shader_common_glsl[];
extern const char shader_light_glsl[];
extern const char shader_backdrop_vert[];
extern const char shader_backdrop_frag[];
extern const char shader_depth_vert[];
extern const char shader_depth_frag[];
extern const char shader_ground_light_frag[];
extern const char shader_open_sky_frag[];
extern const char shader_soften_frag[];
extern const char shader_mesh_vert[];
extern const char shader_mesh_frag[];
extern const char shader_ground_frag[];
extern const char shader_layer_frag[];
extern const char shader_line_vert[];
extern const char shader_line_frag[];

#endif

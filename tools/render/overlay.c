/* Text and colours in a corner of the picture: letters of a few strokes, drawn as lines. */
#include <string.h>

#include "render/draw_scene_data.h"

/* Strokes of a letter: digit pairs x and y of points, connected; a space lifts the pen. The baseline is y
 * = 2; small letters reach 6, tall ones 8, descenders 0. */
typedef struct letter {
  char name;
  const char *strokes;
} letter;

static const letter letters[] = {
    {'a', "3632 3322120305162635"},
    {'b', "0802 0312223335261605"},
    {'c', "3526160503122233"},
    {'d', "3832 3322120305162635"},
    {'e', "04343526160503122233"},
    {'f', "28181712 0626"},
    {'g', "3631201001 3322120305162635"},
    {'h', "0802 0516263532"},
    {'i', "0602 0808"},
    {'j', "161100 1818"},
    {'k', "0802 360432"},
    {'l', "080312"},
    {'m', "0602 05162522 25364542"},
    {'n', "0602 0516263532"},
    {'o', "120305162635332212"},
    {'p', "0600 0312223335261605"},
    {'q', "3630 3322120305162635"},
    {'r', "0602 051626"},
    {'s', "35261605142433221203"},
    {'t', "181322 0626"},
    {'u', "0603122233 3632"},
    {'v', "062246"},
    {'w', "0612263246"},
    {'x', "0632 0236"},
    {'y', "0622 4610"},
    {'z', "06360232"},
    {'0', "120307182837332212"},
    {'1', "071812"},
    {'2', "07182837360232"},
    {'3', "07182837362515 253433221203"},
    {'4', "22280434"},
    {'5', "38080515253433221203"},
    {'6', "372818070312223334251504"},
    {'7', "083812"},
    {'8', "15060718283736251504031222333425"},
    {'9', "031222333728180706152536"},
    {'+', "0545 2327"},
    {'-', "0535"},
    {'%', "0248 0818170708 3343423233"},
    {'.', "0202"},
    {'/', "0238"},
    {'=', "0434 0636"},
    {'(', "18060412"},
    {')', "08161402"},
    {':', "0303 0606"},
    {',', "1301"},
    {'\'', "0806"},
};

static const float letter_scale = 1.9f, letter_gap = 3.6f, word_gap = 7.0f, stroke = 1.35f; /* units */
static const float left = 22, bottom = 26, row = 23, swatch = 26;
static const draw_colour ink = {52, 58, 68, 255};
/* Rim around text, for contrast with dark backgrounds. */
static const draw_colour halo = {236, 238, 240, 110};
static const float halo_width = 5;

static const char *strokes_of(char c) {
  if (c >= 'A' && c <= 'Z') c = (char)(c - 'A' + 'a');
  for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
    if (letters[i].name == c) return letters[i].strokes;
  return NULL;
}

static void add_overlay_line(draw_scene *scene, sbf_vec2 from, sbf_vec2 to, draw_colour colour, float width) {
  draw_line *stored = draw_scene_list_push(scene, &scene->overlay.lines, 1, sizeof *stored);
  float side = scene->overlay.from_top ? 1 : 0;
  if (stored) *stored = (draw_line){{from.x, from.y, side}, {to.x, to.y, side}, colour, colour, width};
}

/* Draws one letter with its lower left corner at `at`, or only measures it without a scene; returns its
 * width. */
static float add_letter(
    draw_scene *scene, const char *strokes, sbf_vec2 at, draw_colour colour, float width) {
  float wide = 0;
  bool down = false;
  sbf_vec2 before = at;
  for (const char *c = strokes; *c; c += 2) {
    if (*c == ' ') c++, down = false;
    sbf_vec2 here = {(float)(c[0] - '0') * letter_scale, (float)(c[1] - '2') * letter_scale};
    if (here.x > wide) wide = here.x;
    here.x += at.x, here.y += at.y;
    if (scene && (down || c[2] == ' ' || c[2] == 0)) add_overlay_line(scene, before, here, colour, width);
    before = here;
    down = true;
  }
  return wide;
}

static float add_run(draw_scene *scene, const char *words, sbf_vec2 at, draw_colour colour, float width) {
  float start = at.x;
  for (const char *c = words; *c; c++) {
    const char *strokes = strokes_of(*c);
    at.x += strokes ? add_letter(scene, strokes, at, colour, width) + letter_gap : word_gap;
  }
  return at.x > start ? at.x - start - letter_gap : 0;
}

/* Returns its width. */
static float add_words(draw_scene *scene, const char *words, sbf_vec2 at) {
  if (scene) add_run(scene, words, at, halo, halo_width);
  return add_run(scene, words, at, ink, stroke);
}

void draw_scene_add_legend(draw_scene *scene, const char *name, draw_colour colour) {
  sbf_vec2 at = {left, bottom + row * (float)scene->overlay.rows++};
  sbf_vec2 from = {at.x, at.y + 2 * letter_scale}, to = {at.x + swatch, from.y};
  add_overlay_line(scene, from, to, colour, 4);
  add_words(scene, name, (sbf_vec2){at.x + swatch + 10, at.y});
}

void draw_scene_add_note(draw_scene *scene, const char *words, const draw_colour *colour) {
  sbf_vec2 at = {left, -bottom - row * (float)scene->overlay.note_rows++};
  scene->overlay.from_top = true;
  if (colour) {
    sbf_vec2 from = {at.x, at.y + 2 * letter_scale}, to = {at.x + 0.5f * swatch, from.y};
    add_overlay_line(scene, from, to, *colour, 7);
    at.x += 0.5f * swatch + 10;
  }
  add_words(scene, words, at);
  scene->overlay.from_top = false;
}

void draw_scene_add_scale(
    draw_scene *scene, const draw_colour_map *map, const char *low, const char *middle, const char *high) {
  enum { PIECES = 64 };
  const float length = 220;
  const char *const words[3] = {low, middle, high};
  float y = bottom + row * (float)scene->overlay.rows;
  scene->overlay.rows += 2;
  for (int i = 0; i < 3; i++) {
    if (!words[i]) continue;
    float wide = add_words(NULL, words[i], (sbf_vec2){0, 0});
    add_words(scene, words[i], (sbf_vec2){left + 0.5f * (float)i * (length - wide), y});
  }
  y += row * 0.95f;
  for (int i = 0; i < PIECES; i++) {
    sbf_vec2 from = {left + length * (float)i / PIECES, y}, to = {left + length * (float)(i + 1) / PIECES, y};
    add_overlay_line(scene, from, to, draw_colour_map_at(map, (float)i / (PIECES - 1)), 9);
  }
}

void draw_scene_arrange_overlay(
    draw_scene *scene, const draw_camera *camera, uint32_t width, uint32_t height) {
  const draw_line *lines = scene->overlay.lines.at;
  size_t count = scene->overlay.lines.count;
  scene->painted.overlay.count = 0;
  draw_line *placed = draw_scene_list_push(scene, &scene->painted.overlay, count, sizeof *placed);
  if (!placed) return;
  sbf_vec3 back = draw_camera_back(camera);
  sbf_vec3 right = v3_unit(v3_cross(v3(0, 1, 0), back), v3(1, 0, 0)), over = v3_cross(back, right);
  sbf_vec3 middle = v3_sub(draw_camera_eye(camera), v3_scale(back, camera->distance));
  float pixels = fmaxf((float)height / 720, 0.7f);                          /* per unit */
  float metre = 2 * camera->distance * camera->half_height / (float)height; /* per pixel */
  sbf_vec3 corner = v3_sub(v3_sub(middle, v3_scale(right, 0.5f * metre * (float)width)),
      v3_scale(over, 0.5f * metre * (float)height));
  sbf_vec3 top = v3_add(corner, v3_scale(over, metre * (float)height));
  for (size_t i = 0; i < count; i++) {
    sbf_vec3 from = lines[i].from.z > 0 ? top : corner;
    placed[i] = lines[i];
    placed[i].width *=
        pixels * 720 / (float)height; /* compensates for the line's own scaling with the picture */
    sbf_vec3 *ends[2] = {&placed[i].from, &placed[i].to};
    for (int k = 0; k < 2; k++)
      *ends[k] = v3_add(from,
          v3_add(v3_scale(right, ends[k]->x * pixels * metre), v3_scale(over, ends[k]->y * pixels * metre)));
  }
}

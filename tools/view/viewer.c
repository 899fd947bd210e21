#include "view/viewer.h"

#include <math.h>

#include "view/panel.h"
#include "view/viewer_choices.h"

static const float PITCH_MIN = 0.02f, PITCH_MAX = 1.5f;
static const float FRAMING_MARGIN = 1.7f; /* distance relative to the one that fills the picture */

/* Keys that walk while pressed. */
static const struct move {
  SDL_Keycode key;
  float forward, side, turn, up;
} moves[] = {{SDLK_w, 1, 0, 0, 0}, {SDLK_s, -1, 0, 0, 0}, {SDLK_a, 0, 0, 1, 0}, {SDLK_d, 0, 0, -1, 0},
    {SDLK_q, 0, 1, 0, 0}, {SDLK_e, 0, -1, 0, 0}, {SDLK_t, 0, 0, 0, 1}, {SDLK_v, 0, 0, 0, -1}};
enum { MOVE_COUNT = sizeof moves / sizeof *moves };

static const struct turn {
  SDL_Keycode key;
  float yaw, pitch;
} turns[] = {{SDLK_LEFT, -0.06f, 0}, {SDLK_RIGHT, 0.06f, 0}, {SDLK_UP, 0, 0.05f}, {SDLK_DOWN, 0, -0.05f}};
enum { TURN_COUNT = sizeof turns / sizeof *turns };

static const unsigned switches[] = {STAGE_SURFACE, STAGE_SPRINGS, STAGE_LATTICE, STAGE_BONES, STAGE_STRAIN,
    STAGE_HULLS, STAGE_FEET, STAGE_CONTACTS, STAGE_JOINTS, STAGE_BOUNDS};
enum { SWITCH_COUNT = sizeof switches / sizeof *switches };

/* ---- Beginning ---- */

/* Far enough to leave space for walking. */
static void frame_camera(viewer *v) {
  studio *st = &v->st;
  stage_show(st->stage, &st->s, st->scene);
  draw_scene_frame(st->scene, &st->camera, studio_aspect(st), st->yaw, st->pitch);
  st->framed = true;
  v->home = st->camera.distance *= FRAMING_MARGIN;
  box3 box = draw_scene_bounds(st->scene);
  if (box3_is_empty(&box)) box = (box3){{-0.3f, 0, -0.3f}, {0.3f, 0.6f, 0.3f}};
  v->size = fmaxf(v3_length(v3_sub(box.max, box.min)), 1e-3f);
  v->rise = 0.5f * (box.min.y + box.max.y);
}

static void orbit_view(viewer *v) {
  v->st.camera.subject = player_middle(&v->p);
  v->st.camera.subject.y += v->rise;
}

sbf_status viewer_begin(viewer *v, sbf_diagnostic *error) {
  bool first = !v->st.framed;
  float pace = first ? viewer_first_pace() : v->p.pace;
  uint32_t thrown = v->p.thrown, hits = v->p.hits;
  if (first) {
    frame_camera(v);
    v->own_ground = v->st.s.ground;
    v->ground = viewer_ground_find(&v->own_ground);
  }
  sbf_status status = player_open(&v->p, &v->st.s, v->size, error);
  if (status != SBF_OK) return status;
  v->p.pace = pace;
  v->p.thrown = thrown, v->p.hits = hits;
  if (first) v->rise -= player_middle(&v->p).y;
  orbit_view(v);
  return SBF_OK;
}

static sbf_status restart(viewer *v, sbf_diagnostic *error) {
  player gone = v->p;
  v->orbits = v->grabs = false;
  player_close(&v->p);
  v->p.pace = gone.pace, v->p.thrown = gone.thrown, v->p.hits = gone.hits;
  v->st.s.ground = viewer_ground_make(v);
  sbf_status status = session_restart(&v->st.s, v->call, error);
  if (status == SBF_OK) status = viewer_begin(v, error);
  return status == SBF_OK ? studio_set_appearance(&v->st, error) : status;
}

/* ---- The camera ---- */

static sbf_vec3 wait_fraction(const viewer *v, const float fraction[2]) {
  const draw_camera *camera = &v->st.camera;
  sbf_vec3 back = draw_camera_back(camera), right = v3_unit(v3_cross(v3(0, 1, 0), back), v3(1, 0, 0));
  float across = (2 * fraction[0] - 1) * camera->half_height * studio_aspect(&v->st),
        above = (1 - 2 * fraction[1]) * camera->half_height;
  return v3_sub(v3_add(v3_scale(right, across), v3_scale(v3_cross(back, right), above)), back);
}

static void orbit(viewer *v, float yaw, float pitch) {
  draw_camera *camera = &v->st.camera;
  camera->yaw -= yaw;
  camera->pitch = fminf(fmaxf(camera->pitch + pitch, PITCH_MIN), PITCH_MAX);
}

static void zoom(viewer *v, float factor) {
  v->st.camera.distance = fminf(fmaxf(v->st.camera.distance * factor, 0.2f * v->home), 5 * v->home);
}

static void follow(viewer *v, double seconds) {
  sbf_vec3 middle = player_middle(&v->p), *subject = &v->st.camera.subject;
  float fraction = v->grabs ? 0 : 1 - expf(-4 * (float)seconds);
  middle.y += v->rise;
  if (!isfinite(middle.x) || !isfinite(middle.y) || !isfinite(middle.z)) return;
  *subject = v3_add(*subject, v3_scale(v3_sub(middle, *subject), fraction));
}

/* ---- What happens to the window ---- */

static void press(viewer *v, int x, int y) {
  draw_camera *camera = &v->st.camera;
  sbf_vec3 eye = draw_camera_eye(camera), position;
  window_fraction(&v->w, x, y, v->pointer);
  v->grabs = player_grab(&v->p, eye, wait_fraction(v, v->pointer), 8 * camera->distance, &position);
  v->orbits = !v->grabs;
  if (v->grabs) v->depth = -v3_dot(v3_sub(position, eye), draw_camera_back(camera));
}

static void move(viewer *v, const SDL_MouseMotionEvent *event) {
  window_fraction(&v->w, event->x, event->y, v->pointer);
  if (v->grabs)
    player_drag(
        &v->p, v3_add(draw_camera_eye(&v->st.camera), v3_scale(wait_fraction(v, v->pointer), v->depth)));
  else if (v->orbits)
    orbit(v, 0.007f * (float)event->xrel, 0.006f * (float)event->yrel);
}

static void steer(viewer *v) {
  player *p = &v->p;
  p->forward = p->side = p->turn = p->up = 0;
  p->steered = true;
  for (int i = 0; i < MOVE_COUNT; i++) {
    if (!(v->keys & 1u << i)) continue;
    p->forward += moves[i].forward;
    p->side += moves[i].side;
    p->turn += moves[i].turn;
    p->up += moves[i].up;
  }
}

static void throw_ball(viewer *v) {
  const draw_camera *camera = &v->st.camera;
  sbf_vec3 eye = draw_camera_eye(camera), back = draw_camera_back(camera);
  /* From close by, so that its flight is visible. */
  player_throw(&v->p, v3_sub(eye, v3_scale(back, fmaxf(camera->distance - 1.6f * v->size, 0))));
}

static sbf_status next_level(viewer *v, bool of_skin, sbf_diagnostic *error) {
  session *s = &v->st.s;
  if (of_skin) {
    v->st.render_level = (v->st.render_level + 1) % viewer_render_level_count(s->asset);
    return studio_set_appearance(&v->st, error);
  }
  s->settings.model.level = (s->settings.model.level + 1) % viewer_level_count(s->asset);
  return restart(v, error);
}

static sbf_status choose(viewer *v, SDL_Keycode key, sbf_diagnostic *error) {
  switch (key) {
  case SDLK_b:
    throw_ball(v);
    break;
  case SDLK_k:
    player_knock(&v->p);
    break;
  case SDLK_p:
    v->paused = !v->paused;
    break;
  case SDLK_h:
    v->panel = (v->panel + 1) % PANEL_COUNT;
    break;
  case SDLK_f:
    v->p.pace = viewer_next_pace(v);
    break;
  case SDLK_ESCAPE:
    v->quit = true;
    break;
  case SDLK_r:
    return restart(v, error);
  case SDLK_l:
    return next_level(v, false, error);
  case SDLK_m:
    return next_level(v, true, error);
  case SDLK_g:
    v->ground = viewer_next_ground(v);
    return restart(v, error);
  default:
    if (key < SDLK_0 || key > SDLK_9) break;
    v->st.show ^= switches[(key - SDLK_0 + SWITCH_COUNT - 1) % SWITCH_COUNT]; /* 0 is the last */
    return studio_set_appearance(&v->st, error);
  }
  return SBF_OK;
}

static sbf_status handle_key(viewer *v, const SDL_KeyboardEvent *event, sbf_diagnostic *error) {
  SDL_Keycode key = event->keysym.sym;
  bool down = event->state == SDL_PRESSED;
  if (event->keysym.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) return SBF_OK;
  for (int i = 0; i < MOVE_COUNT; i++)
    if (moves[i].key == key) {
      v->keys = down ? v->keys | 1u << i : v->keys & ~(1u << i);
      steer(v);
      return SBF_OK;
    }
  for (int i = 0; down && i < TURN_COUNT; i++)
    if (turns[i].key == key) orbit(v, turns[i].yaw, turns[i].pitch);
  if (down && (key == SDLK_PLUS || key == SDLK_EQUALS || key == SDLK_KP_PLUS)) zoom(v, 0.9f);
  if (down && (key == SDLK_MINUS || key == SDLK_KP_MINUS)) zoom(v, 1.1f);
  return down && !event->repeat ? choose(v, key, error) : SBF_OK;
}

sbf_status viewer_take(viewer *v, const SDL_Event *event, sbf_diagnostic *error) {
  switch (event->type) {
  case SDL_QUIT:
    v->quit = true;
    break;
  case SDL_KEYDOWN:
  case SDL_KEYUP:
    return handle_key(v, &event->key, error);
  case SDL_MOUSEBUTTONDOWN:
    if (event->button.button == SDL_BUTTON_LEFT) press(v, event->button.x, event->button.y);
    break;
  case SDL_MOUSEBUTTONUP:
    player_release(&v->p);
    v->grabs = v->orbits = false;
    break;
  case SDL_MOUSEMOTION:
    move(v, &event->motion);
    break;
  case SDL_MOUSEWHEEL:
    zoom(v, expf(-0.1f * (float)event->wheel.y));
    break;
  case SDL_WINDOWEVENT:
    if (event->window.event == SDL_WINDOWEVENT_FOCUS_LOST && v->keys) {
      v->keys = 0;
      steer(v);
    }
    break;
  default:
    break;
  }
  return SBF_OK;
}

/* ---- Time and picture ---- */

bool viewer_step(viewer *v, double seconds) {
  double before = window_seconds(&v->w);
  bool more = v->paused || player_step(&v->p, seconds);
  v->costs.physics_s += window_seconds(&v->w) - before;
  follow(v, seconds);
  return more;
}

static void report(viewer *v) {
  double now = window_seconds(&v->w);
  if (v->reported.frames && now - v->costs.since_s < 0.5) return;
  v->reported = v->costs;
  v->reported_s = now - v->costs.since_s;
  v->costs = (viewer_costs){.since_s = now};
}

sbf_status viewer_draw(viewer *v, sbf_diagnostic *error) {
  studio *st = &v->st;
  uint32_t width, height;
  double before = window_seconds(&v->w);
  window_pixels(&v->w, &width, &height);
  sbf_status status = draw_canvas_resize(st->canvas, width, height, error);
  if (status != SBF_OK) return status;
  stage_show(st->stage, &st->s, st->scene);
  for (uint32_t i = 0; i < v->p.ball_count; i++)
    draw_scene_add_sphere(
        st->scene, v->p.balls[i].position, player_ball_radius(&v->p), draw_colour_rgb(0xcc291a));
  panel_add(v, st->scene);
  status = draw_painter_paint(st->painter, st->scene, &st->camera, error);
  if (status == SBF_OK) draw_canvas_show(st->canvas);
  v->costs.picture_s += window_seconds(&v->w) - before;
  v->costs.frames++;
  report(v);
  return status;
}

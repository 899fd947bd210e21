#include "soft_character.h"

/* Context of a group of tasks in Godot's pool, one call per element. */
typedef struct group {
  sbr_task *task;
  void *context;
} group;

static void run_element(void *user, uint32_t index) {
  group *all = user;
  all->task(all->context, index);
}

static void run(void *user, sbr_task *task, void *context, uint32_t count) {
  group all = {task, context};
  uint64_t description = 0;
  (void)user;
  if (count < 2) {
    for (uint32_t i = 0; i < count; i++) task(context, i);
    return;
  }
  gd_variant pool = gd_singleton("WorkerThreadPool");
  gd.string_new_with_utf8_chars(&description, "sbfmt");
  int64_t id = gd.worker_thread_pool_add_native_group_task(
      gd_as_object(&pool), run_element, &all, (int32_t)count, -1, true, &description);
  GD_DO(&pool, "wait_for_group_task_completion", gd_int(id));
  gd.variant_get_ptr_destructor(GDEXTENSION_VARIANT_TYPE_STRING)(&description);
  gd_free(&pool);
}

sbr_tasks worker_pool_tasks(void) {
  return (sbr_tasks){run, NULL};
}

/* Prints, among what a test program does, a line for each scene by chance and each file: its name and the
 * state hash that it ends with. Equal everywhere: check_machines.py compares what compilers, optimisations
 * and processors make of it.
 *
 * Usage: state_hashes FIRST COUNT [FILE...]
 * Files, packed ones, are run with the default scheme, walking over uneven ground. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "chance_scene.h"
#include "harness.h"
#include "sbfmt/packed.h"
#include "sbrun/sbrun.h"

enum { WALK_TICKS = 40 };

static bool run_file(const char *path, uint64_t *hash, sbf_diagnostic *error) {
  sbf_asset *asset = NULL;
  sbr_model *model = NULL;
  sbr_world *world = NULL;
  sbr_character_id character;
  sbr_world_definition definition = sbr_default_world_definition();
  sbr_character_definition standing = sbr_default_character_definition();
  definition.ground = sbr_ground_noise(0.1, 5);
  sbf_status status = sbf_packed_load_file(path, NULL, &asset, error);
  if (status == SBF_OK) status = sbr_model_create(asset, NULL, &model, error);
  if (status == SBF_OK) status = sbr_world_create(&definition, &world, error);
  if (status == SBF_OK) status = sbr_character_create(world, model, &standing, &character, error);
  if (status == SBF_OK) {
    sbr_character_set_drive(world, character, 0.3f, 0, 0.2f);
    for (int i = 0; i < WALK_TICKS; i++) sbr_world_tick(world);
    *hash = sbr_world_get_state_hash(world);
  }
  sbr_world_destroy(world);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
  return status == SBF_OK;
}

static int argument_count;
static char **arguments;

START_TEST(print_hashes)
{
  uint32_t first = (uint32_t)strtoul(arguments[1], NULL, 10);
  uint32_t count = (uint32_t)strtoul(arguments[2], NULL, 10);
  for (uint32_t seed = first; seed < first + count; seed++)
    printf("scene %" PRIu32 " %016" PRIx64 "\n", seed, chance_scene_run(seed));
  for (int i = 3; i < argument_count; i++) {
    uint64_t hash = 0;
    sbf_diagnostic error = {0};
    ck_assert_msg(run_file(arguments[i], &hash, &error), "%s: %s", arguments[i], error.message);
    printf("file %d %016" PRIx64 "\n", i - 2, hash);
  }
}
END_TEST

/* A test program, for the scenes assert that their numbers are sound. */
int main(int count, char **all) {
  if (count < 3) {
    fprintf(stderr, "usage: state_hashes FIRST COUNT [FILE...]\n");
    return 2;
  }
  argument_count = count, arguments = all;
  Suite *s = suite_create("state hashes");
  TCase *c = tcase_create("state hashes");
  tcase_set_timeout(c, 3600);
  tcase_add_test(c, print_hashes);
  suite_add_tcase(s, c);
  return harness_run(s);
}

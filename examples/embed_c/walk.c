/* An engine's whole part: load a packed bundle, put the character into a world, step, read its skin.
 * Compiles as C and as C++. */
#include <stdio.h>
#include <stdlib.h>

#include "sbfmt/packed.h"
#include "sbrun/events.h"

static int failed(const sbf_diagnostic *error) {
  fprintf(stderr, "%s: %s\n", error->file, error->message);
  return 1;
}

int main(int argc, char **argv) {
  sbf_diagnostic error;
  sbf_asset *asset;
  sbr_model *model;
  sbr_world *world;
  sbr_character_id character;
  if (argc != 2) return fprintf(stderr, "usage: %s FILE.sbfz\n", argv[0]), 2;

  if (sbf_packed_load_file(argv[1], NULL, &asset, &error) != SBF_OK) return failed(&error);
  if (sbr_model_create(asset, NULL, &model, &error) != SBF_OK) return failed(&error);

  sbr_world_definition of_world = sbr_default_world_definition();
  of_world.ground = sbr_ground_noise(0.1, 1);
  if (sbr_world_create(&of_world, &world, &error) != SBF_OK) return failed(&error);
  sbr_character_definition of_character = sbr_default_character_definition();
  if (sbr_character_create(world, model, &of_character, &character, &error) != SBF_OK) return failed(&error);

  uint32_t count = sbr_character_get_skin(world, character, 0, NULL, NULL, NULL, 0);
  sbf_vec3 *skin = (sbf_vec3 *)calloc(count + 1, sizeof *skin);
  uint32_t steps = 0;
  if (!skin) return 2;

  sbr_character_set_drive(world, character, 0.5f, 0, 0); /* half a metre a second, straight on */
  for (int frame = 1; frame <= 300; frame++) {
    sbr_world_step(world, 1.0 / 60); /* an engine gives its frame time */
    steps += sbr_world_get_foot_events(world).down_count;
    if (frame % 60) continue;
    sbr_double3 origin = sbr_character_get_origin(world, character); /* what follows is relative to it */
    sbr_transform root;
    sbr_character_get_bones(world, character, &root, 1);
    sbr_character_get_skin(world, character, 0, skin, NULL, NULL, count); /* an engine draws it */
    printf("%d s: root at %.2f %.2f %.2f m, %u steps taken, vertex 0 of %u at a height of %.3f m\n",
        frame / 60, origin.x + root.position.x, origin.y + root.position.y, origin.z + root.position.z,
        (unsigned)steps, (unsigned)count, origin.y + (count ? skin[0].y : 0));
  }
  printf("state %016llx\n", (unsigned long long)sbr_world_get_state_hash(world));

  free(skin);
  sbr_world_destroy(world);
  sbr_model_destroy(model);
  sbf_asset_free(asset);
  return 0;
}

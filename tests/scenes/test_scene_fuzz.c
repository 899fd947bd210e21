/* No number that is none is ever read of scenes by chance (chance_scene.h), and the same scene gives the same
 * bits twice.
 *
 * SBFMT_SCENES says how many scenes of 100 frames each (default 600), SBFMT_SEED where to begin. A scene
 * that fails is told by its seed. CK_FORK=no for what takes more than half an hour, which Check cannot count.
 */
#include <stdio.h>
#include <stdlib.h>

#include "chance_scene.h"
#include "harness.h"

static uint32_t number_of(const char *name, uint32_t otherwise) {
  const char *text = getenv(name);
  return text ? (uint32_t)strtoul(text, NULL, 10) : otherwise;
}

START_TEST(no_scene_gives_invalid_numbers)
{
  uint32_t first = number_of("SBFMT_SEED", 1000), count = number_of("SBFMT_SCENES", 600), made = 0;
  for (uint32_t seed = first; seed < first + count; seed++) {
    uint64_t hash = chance_scene_run(seed);
    made += hash != 0;
    if (seed % 16 == 0)
      ck_assert_msg(chance_scene_run(seed) == hash, "seed %u: other bits the second time", seed);
  }
  ck_assert_uint_ge(10 * made, 8 * count); /* and most of them are stepped */
  printf("%u scenes, %u frames\n", made, made * CHANCE_FRAMES);
}
END_TEST

int main(void) {
  Suite *s = suite_create("scene fuzz");
  TCase *c = tcase_create("scene fuzz");
  tcase_set_timeout(c, 3600);
  tcase_add_test(c, no_scene_gives_invalid_numbers);
  suite_add_tcase(s, c);
  return harness_run(s);
}

#include <stdio.h>
#include <string.h>

#include "harness.h"
#include "import/convert/conversion.h"

static void begin(sbfi_conversion *c, const sbf_allocator *allocator) {
  *c = (sbfi_conversion){.asset = sbf_asset_create(NULL)};
  sbfi_array_init(&c->ids.slots, allocator, sizeof(char *));
}

static void end(sbfi_conversion *c) {
  sbfi_array_free(&c->ids.slots);
  sbf_asset_free(c->asset);
}

START_TEST(kind_and_name)
{
  sbfi_conversion c;
  begin(&c, NULL);
  ck_assert_str_eq(sbfi_new_id(&c, "bone", "Leg.001.L"), "bone.Leg.001.L");
  ck_assert_str_eq(sbfi_new_id(&c, "body", "Leg.001.L"), "body.Leg.001.L");
  ck_assert_str_eq(sbfi_new_id(&c, "bone", "left foot\tik\n"), "bone.left_foot_ik_");
  ck_assert_str_eq(sbfi_new_id(&c, "bone", ""), "bone.unnamed");
  ck_assert_str_eq(sbfi_new_id(&c, "bone", "\xC3\xA9"), "bone.\xC3\xA9");
  end(&c);
}
END_TEST

START_TEST(used_names_get_a_number)
{
  sbfi_conversion c;
  begin(&c, NULL);
  ck_assert_str_eq(sbfi_new_id(&c, "bone", "a b"), "bone.a_b");
  ck_assert_str_eq(sbfi_new_id(&c, "bone", "a_b~2"), "bone.a_b~2");
  ck_assert_str_eq(sbfi_new_id(&c, "bone", "a_b"), "bone.a_b~3");
  ck_assert_str_eq(sbfi_new_id(&c, "bone", "a_b~2"), "bone.a_b~2~2");
  end(&c);
}
END_TEST

/* Enough for the table to grow several times, each name twice. */
START_TEST(many_are_all_different)
{
  sbfi_conversion c;
  begin(&c, NULL);
  for (int round = 0; round < 2; round++)
    for (int i = 0; i < 1000; i++) {
      char name[16], expected[32];
      snprintf(name, sizeof name, "n%d", i);
      snprintf(expected, sizeof expected, round ? "mesh.n%d~2" : "mesh.n%d", i);
      ck_assert_str_eq(sbfi_new_id(&c, "mesh", name), expected);
    }
  ck_assert_uint_eq(c.ids.used, 2000);
  end(&c);
}
END_TEST

START_TEST(memory_may_run_out)
{
  for (size_t allowed = 0; allowed < 3; allowed++) {
    harness_memory memory;
    sbfi_conversion c;
    harness_memory_init(&memory, allowed);
    begin(&c, &memory.allocator);
    int made = 0;
    while (made < 1000) {
      char name[16];
      snprintf(name, sizeof name, "n%d", made);
      if (!sbfi_new_id(&c, "bone", name)) break;
      made++;
    }
    ck_assert_int_lt(made, 1000);
    end(&c);
    ck_assert_uint_eq(memory.held_bytes, 0);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("identifier");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, kind_and_name);
  tcase_add_test(tests, used_names_get_a_number);
  tcase_add_test(tests, many_are_all_different);
  tcase_add_test(tests, memory_may_run_out);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}

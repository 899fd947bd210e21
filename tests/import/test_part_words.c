#include "import/convert/part_words.h"

#include "harness.h"

START_TEST(names_tell_what_is_hard)
{
  static const struct {
    const char *name;
    sbfi_name_says says;
  } samples[] = {{"LowerArm.L", SBFI_SAYS_LIMB}, {"lower_leg.R", SBFI_SAYS_LIMB},
      {"UpperLeg.L", SBFI_SAYS_NOTHING}, {"mixamorig:LeftHandThumb2", SBFI_SAYS_LIMB},
      {"b_LeftForeArm_011", SBFI_SAYS_LIMB}, {"Ear2.L", SBFI_SAYS_SOFT}, {"Tail01", SBFI_SAYS_SOFT},
      {"Bear", SBFI_SAYS_NOTHING}, {"spring", SBFI_SAYS_NOTHING}, {"EyeBrow.L", SBFI_SAYS_FACE},
      {"jaw_master", SBFI_SAYS_FACE}, {"GunBarrel", SBFI_SAYS_PROP}, {"wheel_FL", SBFI_SAYS_PROP},
      {"MechBody", SBFI_SAYS_MACHINE}, {"Tank", SBFI_SAYS_MACHINE}, {"bellyButton", SBFI_SAYS_SOFT},
      {"", SBFI_SAYS_NOTHING}, {NULL, SBFI_SAYS_NOTHING}, {"Bone.003", SBFI_SAYS_NOTHING}};
  for (size_t i = 0; i < sizeof samples / sizeof *samples; i++)
    ck_assert_msg(sbfi_words_of_name(samples[i].name) == samples[i].says, "%s",
        samples[i].name ? samples[i].name : "NULL");
}
END_TEST

START_TEST(materials_tell_what_is_hard)
{
  ck_assert(sbfi_material_is_hard("Metal_Dark"));
  ck_assert(sbfi_material_is_hard("LightWood"));
  ck_assert(!sbfi_material_is_hard("Skin"));
  ck_assert(!sbfi_material_is_hard("ironic"));
  ck_assert(!sbfi_material_is_hard(NULL));
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("part_words");
  TCase *c = tcase_create("part_words");
  tcase_add_test(c, names_tell_what_is_hard);
  tcase_add_test(c, materials_tell_what_is_hard);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}

#include "import/convert/part_words.h"

#include "harness.h"

START_TEST(names_identify_rigid_parts)
{
  static const struct {
    const char *name;
    sbfi_name_hint says;
  } samples[] = {{"LowerArm.L", SBFI_NAME_HINT_LIMB}, {"lower_leg.R", SBFI_NAME_HINT_LIMB},
      {"UpperLeg.L", SBFI_NAME_HINT_NONE}, {"mixamorig:LeftHandThumb2", SBFI_NAME_HINT_LIMB},
      {"b_LeftForeArm_011", SBFI_NAME_HINT_LIMB}, {"Ear2.L", SBFI_NAME_HINT_SOFT},
      {"Tail01", SBFI_NAME_HINT_SOFT}, {"Bear", SBFI_NAME_HINT_NONE}, {"spring", SBFI_NAME_HINT_NONE},
      {"EyeBrow.L", SBFI_NAME_HINT_FACE}, {"jaw_master", SBFI_NAME_HINT_FACE},
      {"GunBarrel", SBFI_NAME_HINT_PROP}, {"wheel_FL", SBFI_NAME_HINT_PROP},
      {"MechBody", SBFI_NAME_HINT_MACHINE}, {"Tank", SBFI_NAME_HINT_MACHINE},
      {"bellyButton", SBFI_NAME_HINT_SOFT}, {"", SBFI_NAME_HINT_NONE}, {NULL, SBFI_NAME_HINT_NONE},
      {"Bone.003", SBFI_NAME_HINT_NONE}};
  for (size_t i = 0; i < sizeof samples / sizeof *samples; i++)
    ck_assert_msg(sbfi_words_of_name(samples[i].name) == samples[i].says, "%s",
        samples[i].name ? samples[i].name : "NULL");
}
END_TEST

START_TEST(materials_identify_rigid_parts)
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
  tcase_add_test(c, names_identify_rigid_parts);
  tcase_add_test(c, materials_identify_rigid_parts);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}

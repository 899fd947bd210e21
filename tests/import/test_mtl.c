#include "import/obj/mtl.h"

#include <string.h>

#include "harness.h"

static sbfi_scene scene;
static sbfi_name_table names;
static sbfi_array images;
static sbfi_scene_material materials[3];
static bool described[3];

static void begin(void) {
  ck_assert(sbfi_scene_init(&scene, NULL, 0, "m.obj"));
  sbfi_name_table_init(&names, NULL);
  sbfi_array_init(&images, NULL, sizeof(sbfi_scene_image));
  static const char *const wanted[] = {"skin", "eye left", "scale"};
  for (int i = 0; i < 3; i++) {
    ck_assert_int_eq(sbfi_name_table_add(&names, sbfi_span_of(wanted[i])), i);
    materials[i] = sbfi_mtl_default(wanted[i]);
    described[i] = false;
  }
}

static void end(void) {
  sbfi_scene_free(&scene);
  sbfi_name_table_free(&names);
  sbfi_array_free(&images);
}

static void read(const char *text) {
  ck_assert(sbfi_mtl_read(&scene, text, strlen(text), &names, materials, described, &images));
}

static const char *image_of(int material) {
  int32_t image = materials[material].base_color_image;
  return image == SBF_NONE ? NULL : ((const sbfi_scene_image *)images.at)[image].path;
}

START_TEST(colours_and_surface)
{
  read("# comment\r\nnewmtl skin\r\n\tKd 0.5 0.25 1\r\nKe 2 0 0\r\nPr 0.75\r\nPm 1\r\nNs 900\r\nnewmtl eye "
       "left\r\nKd 0.5\r\n"
       "Ns 225\r\nd 0.5\r\nnewmtl of nobody\r\nKd 1 1 1\r\n");
  ck_assert(described[0] && described[1] && !described[2]);
  ck_assert_float_eq(materials[0].base_color[1], 0.25f);
  ck_assert_float_eq(materials[0].base_color[3], 1);
  ck_assert_float_eq(materials[0].emissive[0], 1);
  ck_assert_float_eq(materials[0].metallic, 1);
  ck_assert_float_eq(materials[0].roughness, 0.75f); /* Pr goes before Ns */
  ck_assert_int_eq(materials[0].alpha_mode, SBFI_ALPHA_OPAQUE);
  ck_assert_float_eq(materials[1].base_color[2], 0.5f);
  ck_assert_float_eq_tol(materials[1].roughness, 0.5f, 1e-6f);
  ck_assert_float_eq(materials[1].base_color[3], 0.5f);
  ck_assert_int_eq(materials[1].alpha_mode, SBFI_ALPHA_BLEND);
  ck_assert_float_eq(materials[2].base_color[0], 0.8f);
}
END_TEST

START_TEST(transparency_is_one_minus_opacity)
{
  read("newmtl skin\nTr 0.25\nnewmtl scale\nTr 0\n");
  ck_assert_float_eq(materials[0].base_color[3], 0.75f);
  ck_assert_float_eq(materials[2].base_color[3], 1);
}
END_TEST

START_TEST(images_after_options)
{
  read("newmtl skin\nmap_Kd -s 1 1 1 -o 0.5 -clamp on -mm 0 1 textures\\my skin.png\n"
       "newmtl eye left\nmap_Kd textures/my skin.png\nnewmtl scale\nmap_Kd -bm\nnorm n.png\n");
  ck_assert_str_eq(image_of(0), "textures/my skin.png");
  ck_assert_int_eq(materials[0].base_color_image, materials[1].base_color_image);
  ck_assert_uint_eq(images.count, 3);
  ck_assert_int_ne(materials[2].normal_image, SBF_NONE);
}
END_TEST

START_TEST(nonsense_stops_nothing)
{
  read("Kd 1 1 1\nnewmtl\nnewmtl skin\nKd red\nKd spectral a.rfl\nKd nan 0 0\nKd 5 -1 "
       "0\nNs\nmap_Kd\nd\n\x01\xFF\nPr x\n");
  ck_assert_float_eq(materials[0].base_color[0], 1);
  ck_assert_float_eq(materials[0].base_color[1], 0);
  ck_assert_float_eq(materials[0].roughness, 1);
  ck_assert_ptr_null(image_of(0));
}
END_TEST

static Suite *mtl_suite(void) {
  Suite *suite = suite_create("mtl");
  TCase *tests = tcase_create("all");
  tcase_add_checked_fixture(tests, begin, end);
  tcase_add_test(tests, colours_and_surface);
  tcase_add_test(tests, transparency_is_one_minus_opacity);
  tcase_add_test(tests, images_after_options);
  tcase_add_test(tests, nonsense_stops_nothing);
  suite_add_tcase(suite, tests);
  return suite;
}

int main(void) {
  return harness_run(mtl_suite());
}

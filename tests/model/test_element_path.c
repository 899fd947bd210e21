#include "model/element_path.h"

#include "fill_asset.h"
#include "harness.h"

static sbfi_element_path child(const sbfi_element_path *up, const char *field, uint32_t index) {
  return sbfi_element_path_child(up, sbfi_element_field(up->element, field), index);
}

static void expect_path(const sbfi_element_path *location, const char *field, const char *expected) {
  char path[256];
  sbfi_element_path_print(
      location, field ? sbfi_element_field(location->element, field) : NULL, path, sizeof path);
  ck_assert_str_eq(path, expected);
}

START_TEST(test_paths)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 1});
  sbfi_element_path root = sbfi_element_path_root(asset);
  expect_path(&root, NULL, "/sbf");
  expect_path(&root, "version", "/sbf/@version");
  expect_path(&root, "bones", "/sbf/skeleton");
  sbfi_element_path bone = child(&root, "bones", 1);
  expect_path(&bone, NULL, "/sbf/skeleton/bone[2]");
  expect_path(&bone, "head", "/sbf/skeleton/bone[2]/@head");
  sbfi_element_path joint = child(&root, "joints", 3);
  expect_path(&joint, NULL, "/sbf/joints/spherical_joint[1]");
  sbfi_element_path frame = child(&joint, "frame_b", 0);
  expect_path(&frame, "rotation", "/sbf/joints/spherical_joint[1]/frame_b/@rotation");
  sbfi_element_path body = child(&root, "soft_bodies", 0), surface = child(&body, "surface", 0);
  expect_path(&surface, "positions", "/sbf/soft_body[1]/polygon_mesh/positions");
  sbfi_element_path pin_set = child(&body, "pins", 1);
  expect_path(&pin_set, "points", "/sbf/soft_body[1]/pins/pin_set[2]/points");
  sbfi_element_path extension = child(&root, "extensions", 0);
  expect_path(&extension, "data", "/sbf/extensions/extension[1]/data");

  char little[12]; /* cut to fit any capacity */
  sbfi_element_path_print(&pin_set, NULL, little, sizeof little);
  ck_assert_str_eq(little, "/sbf/soft_b");
  sbfi_element_path_print(&pin_set, NULL, little, 1);
  ck_assert_str_eq(little, "");
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_siblings_of_the_same_name)
{
  sbf_joint joints[3];
  sbf_asset *asset = sbf_asset_create(NULL);
  for (int i = 0; i < 3; i++) sbf_joint_init(&joints[i]);
  joints[0].kind = joints[2].kind = SBF_JOINT_KIND_FIXED;
  joints[1].kind = SBF_JOINT_KIND_PULLEY;
  asset->joints = (sbf_joint_list){joints, 3};
  sbfi_element_path root = sbfi_element_path_root(asset), path = child(&root, "joints", 2);
  expect_path(&path, NULL, "/sbf/joints/fixed_joint[2]");
  path = child(&root, "joints", 1);
  expect_path(&path, NULL, "/sbf/joints/pulley_joint[1]");
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_lengths)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 1});
  sbfi_element_path root = sbfi_element_path_root(asset), body = child(&root, "soft_bodies", 1);
  const sbf_soft_body *b = &asset->soft_bodies.at[1];
  const uint64_t size = (uint64_t)b->surface.positions.count + b->interior.count;
  ck_assert_uint_eq(sbfi_length_value(body.element->size, &body), size);
  sbfi_element_path map = child(&body, "weight_maps", 0); /* ^size */
  ck_assert_uint_eq(sbfi_length_value(&sbfi_element_field(map.element, "values")->lengths[0], &map), size);
  sbfi_element_path mesh = child(&body, "surface", 0); /* sum(...) */
  ck_assert_uint_eq(sbfi_length_value(&sbfi_element_field(mesh.element, "polygon_points")->lengths[0], &mesh),
      b->surface.polygon_points.count);
  sbfi_element_path render = child(&root, "render_meshes", 0),
                    skin = child(&render, "skin", 0); /* ^one.list, /list */
  ck_assert_uint_eq(
      sbfi_length_value(&sbfi_element_field(skin.element, "influence_counts")->lengths[0], &skin),
      asset->render_meshes.at[0].mesh.positions.count);
  ck_assert_uint_eq(
      sbfi_length_value(sbfi_element_field(skin.element, "bones")->index, &skin), asset->bones.count);
  sbf_asset_free(asset);
}
END_TEST

START_TEST(test_children)
{
  sbf_asset *asset = fill_asset(&(fill_options){.seed = 1});
  sbfi_element_path root = sbfi_element_path_root(asset);
  const sbfi_element *element = root.element;
  ck_assert_uint_eq(sbfi_child_count(asset, sbfi_element_field(element, "version")), 0);
  ck_assert_uint_eq(sbfi_child_count(asset, sbfi_element_field(element, "environment")), 1);
  ck_assert_uint_eq(sbfi_child_count(asset, sbfi_element_field(element, "bones")), 2);
  ck_assert_ptr_eq(child(&root, "bones", 1).object, &asset->bones.at[1]);
  ck_assert_ptr_eq(child(&root, "environment", 0).object, &asset->environment);
  sbfi_element_path mesh = child(&root, "render_meshes", 0);
  ck_assert_ptr_eq(child(&mesh, "skin", 0).object, asset->render_meshes.at[0].skin);
  sbf_asset_free(asset);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("place");
  TCase *all = tcase_create("all");
  tcase_add_test(all, test_paths);
  tcase_add_test(all, test_siblings_of_the_same_name);
  tcase_add_test(all, test_lengths);
  tcase_add_test(all, test_children);
  suite_add_tcase(suite, all);
  return harness_run(suite);
}

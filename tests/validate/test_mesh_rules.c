#include "rules.h"

#define PATH "/sbf/render_mesh[1]"

START_TEST(test_normals)
{
  rules_expect(RENDER("<normals>1 0 0 0 1 0 0 0 1 0.6 0.8 0</normals>"), "");
  rules_expect(RENDER("<normals>1 0 0 0 1 0 0 0 1</normals>"), "NORMALS_LENGTH " PATH "/normals");
  rules_expect(
      RENDER("<normals>1 0 0</normals><normal_corners>0 0 0 0 0 0 0 0 0 0 0 0</normal_corners>"), "");
  rules_expect(RENDER("<normals>1 0 0 0 1 0 0 0 1 0 0 0</normals>"), "NORMAL_NOT_UNIT " PATH "/normals #3");
}
END_TEST

START_TEST(test_uvs)
{
  rules_expect(RENDER("<uv_set><coordinates>0 0 1 0 0 1 1 1</coordinates></uv_set>"), "");
  rules_expect(RENDER("<uv_set name=\"map\"><coordinates>0 0 1 0 0 1</coordinates></uv_set>"),
      "UV_LENGTH " PATH "/uv_set[1]");
  rules_expect(RENDER("<uv_set><coordinates>0 0 1 0 0 1</coordinates><corners>0 1 2 0 1 2 0 1 2 0 1 "
                      "2</corners></uv_set>"),
      "");
}
END_TEST

START_TEST(test_images_need_uvs)
{
#define MATERIALS                                                                                            \
  "<textures><texture id=\"t\" path=\"t.png\"/></textures><materials><material id=\"m\" name=\"M\" "         \
  "base_color_texture=\"t\"/><material id=\"n\" name=\"N\"/></materials>"
  rules_expect(MATERIALS RENDER("<material_slot material=\"n\"/>"), "");
  rules_expect(MATERIALS RENDER("<material_slot material=\"n\"/><material_slot material=\"m\"/>"),
      "MATERIAL_NO_UVS " PATH "/material_slot[2]");
  rules_expect(
      MATERIALS RENDER(
          "<uv_set><coordinates>0 0 1 0 0 1 1 1</coordinates></uv_set><material_slot material=\"m\"/>"),
      "");
}
END_TEST

START_TEST(test_points)
{
#define OF(points, more)                                                                                     \
  "<render_mesh id=\"r\" name=\"R\">" MESH("rendering", points, "3", "0 1 2") more "</render_mesh>"
  rules_expect(OF("0 0 0 1 0 0 0 1 0", ""), "");
  rules_expect(OF("0 0 0 1 0 0 0 1 0 1 1 1", ""), "MESH_POINT_UNUSED " PATH "/polygon_mesh/positions #3");
  rules_expect("<render_mesh id=\"r\" name=\"R\"><polygon_mesh target=\"rendering\"><positions>0 0 0 1 0 "
               "0</positions></polygon_mesh></render_mesh>",
      "MESH_EMPTY " PATH);
}
END_TEST

START_TEST(test_shape_keys)
{
  rules_expect(
      RENDER("<shape_key name=\"a\"><points>1 2</points><offsets>0 1 0 0 1 0</offsets></shape_key><shape_key "
             "name=\"b\"><points>2</points><offsets>0 1 0</offsets></shape_key>"),
      "");
  rules_expect(
      RENDER("<shape_key name=\"a\"><points>2 1 2</points><offsets>0 1 0 0 1 0 0 1 0</offsets></shape_key>"),
      "SHAPE_KEY_REPEATED " PATH "/shape_key[1]/points #2");
}
END_TEST

RULES_MAIN("mesh_rules", test_normals, test_uvs, test_images_need_uvs, test_points, test_shape_keys)

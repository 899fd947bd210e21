/* Checks colours: counts match the elements, elements of one colour share no point. */
#include "validate/validation.h"

/* Elements as runs of `width` points, in colour order. */
typedef struct colored {
  const uint32_t *points;
  uint32_t count, width;
  sbf_u32_list counts;
} colored;

static void check(
    sbfi_validation *v, const colored *c, uint32_t point_count, const char *parent, const char *list) {
  uint64_t sum = 0;
  sbfi_path counts = sbfi_path_of("%s/color_counts", parent), elements = sbfi_path_of("%s/%s", parent, list);
  for (uint32_t i = 0; i < c->counts.count; i++) sum += c->counts.at[i];
  if (c->counts.count == 0) return;
  if (sum != c->count) {
    sbfi_found(v, SBF_CODE_COLORS_COUNT, counts.text, -1,
        "%llu elements have a colour, but there are %u elements", (unsigned long long)sum, c->count);
    return;
  }
  /* number from 1 of the last element with the point */
  uint32_t *last = sbfi_scratch(v, point_count, sizeof *last);
  if (!last) return;
  for (uint32_t color = 0, begin = 0; color < c->counts.count; begin += c->counts.at[color++])
    for (uint32_t i = begin; i < begin + c->counts.at[color]; i++)
      for (uint32_t k = 0; k < c->width; k++) {
        uint32_t point = c->points[(size_t)i * c->width + k];
        if (last[point] > begin && last[point] != i + 1)
          sbfi_found(v, SBF_CODE_COLORS_SHARED, elements.text, i,
              "elements %u and %u of colour %u share point %u", last[point] - 1, i, color, point);
        last[point] = i + 1;
      }
}

static void check_level(sbfi_validation *v, const sbf_level *level, const char *path) {
  const sbf_tetrahedron_mesh *lattice = &level->lattice;
  colored elements = {lattice->tetrahedra.count ? lattice->tetrahedra.at->at : NULL,
      lattice->tetrahedra.count, 4, lattice->color_counts};
  check(v, &elements, level->positions.count, sbfi_path_of("%s/tetrahedron_mesh", path).text, "tetrahedra");
  for (uint32_t s = 0; s < level->springs.count && !v->out_of_memory; s++) {
    const sbf_spring_set *set = &level->springs.at[s];
    elements = (colored){set->ends.count ? set->ends.at->at : NULL, set->ends.count, 2, set->color_counts};
    check(v, &elements, level->positions.count, sbfi_path_of("%s/spring_set[%u]", path, s + 1).text, "ends");
  }
}

void sbfi_check_colors(sbfi_validation *v) {
  for (uint32_t b = 0; b < v->asset->soft_bodies.count; b++)
    for (uint32_t l = 0; l < v->asset->soft_bodies.at[b].levels.count && !v->out_of_memory; l++)
      check_level(v, &v->asset->soft_bodies.at[b].levels.at[l],
          sbfi_path_of("/sbf/soft_body[%u]/level[%u]", b + 1, l + 1).text);
}

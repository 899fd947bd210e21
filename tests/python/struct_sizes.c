/* Prints the structs that the Python module mirrors: name, size, and the offsets of some members. */
#include <stdio.h>

#include "sbfmt/build.h"
#include "sbfmt/convert.h"
#include "sbfmt/export.h"
#include "sbfmt/io.h"
#include "sbfmt/mechanics.h"
#include "sbfmt/validate.h"
#include "sbrun/animation.h"
#include "sbrun/detail.h"
#include "sbrun/soft_body.h"

#define SIZE(type) printf(#type " %zu\n", sizeof(type))
#define OFFSET(type, member) printf(#type "." #member " %zu\n", offsetof(type, member))

int main(void) {
  SIZE(sbf_load_options);
  SIZE(sbf_given_list);
  SIZE(sbf_save_options);
  SIZE(sbf_build_options);
  SIZE(sbf_convert_options);
  SIZE(sbf_convert_stance);
  SIZE(sbf_validate_options);
  SIZE(sbf_export_options);
  SIZE(sbf_diagnostic);
  SIZE(sbf_buffer);
  SIZE(sbf_validate_result);
  SIZE(sbf_asset_measures);
  SIZE(sbf_code_info);
  SIZE(sbf_fix_options);
  SIZE(sbf_fix_result);
  SIZE(sbr_ground);
  SIZE(sbr_model_options);
  SIZE(sbr_world_definition);
  SIZE(sbr_character_definition);
  SIZE(sbr_transform);
  SIZE(sbr_clip_play);
  SIZE(sbr_body_health);
  SIZE(sbr_detail_level);
  SIZE(sbr_detail_definition);
  SIZE(sbr_view);
  SIZE(sbr_soft_motion);
  SIZE(sbr_vertex_grab);
  SIZE(sbr_pin_reaction);
  SIZE(sbr_tetrahedron_state);
  SIZE(sbr_spring_state);
  OFFSET(sbr_vertex_grab, max_force);
  OFFSET(sbr_pin_reaction, torque);
  OFFSET(sbr_tetrahedron_state, torn);
  OFFSET(sbr_spring_state, energy);
  OFFSET(sbf_load_options, check_crc);
  OFFSET(sbf_load_options, extension_count);
  OFFSET(sbf_load_options, copy_file);
  OFFSET(sbf_load_options, repairable);
  OFFSET(sbf_load_options, given_lists);
  OFFSET(sbf_load_options, given_list_count);
  OFFSET(sbf_load_options, report);
  OFFSET(sbf_save_options, level);
  OFFSET(sbf_build_options, interior);
  OFFSET(sbf_build_options, without_hulls);
  OFFSET(sbf_build_options, progress);
  OFFSET(sbf_build_options, report);
  OFFSET(sbf_build_options, elements);
  OFFSET(sbf_build_options, error_m);
  OFFSET(sbf_build_options, render_error_m);
  OFFSET(sbf_convert_options, pinning);
  OFFSET(sbf_convert_options, softness);
  OFFSET(sbf_convert_options, up);
  OFFSET(sbf_convert_options, import_helper);
  OFFSET(sbf_convert_options, report);
  OFFSET(sbf_validate_options, report);
  OFFSET(sbf_validate_options, folder);
  OFFSET(sbf_fix_options, report);
  OFFSET(sbr_model_options, gravity);
  OFFSET(sbr_model_options, instructions);
  OFFSET(sbr_model_options, detail_levels);
  OFFSET(sbr_world_definition, ground);
  OFFSET(sbr_world_definition, gravity);
  OFFSET(sbr_world_definition, sleep_after_s);
  OFFSET(sbr_character_definition, hold_pose);
  OFFSET(sbr_clip_play, bone_mask);
  OFFSET(sbr_detail_level, visits);
  OFFSET(sbr_detail_definition, ns_per_visit);
  OFFSET(sbr_detail_definition, offscreen_after_s);
  OFFSET(sbr_view, forward);
  OFFSET(sbr_view, lines);
  OFFSET(sbr_body_health, elastic_j);
  OFFSET(sbr_body_health, asleep);
  OFFSET(sbr_body_health, min_element_ratio);
  OFFSET(sbf_export_options, report);
  OFFSET(sbf_export_options, render_level);
  OFFSET(sbf_diagnostic, path);
  OFFSET(sbf_diagnostic, line);
  OFFSET(sbf_diagnostic, index);
  OFFSET(sbf_asset_measures, low);
  OFFSET(sbf_code_info, fault);
  return 0;
}

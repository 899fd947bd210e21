/* Chains named by the humanoid of a VRM file: spine, neck, arms and legs. The gait takes its legs and arms
 * from them, and motion of other skeletons finds its bones. */
#include "import/convert/conversion.h"
#include "import/vrm/vrm.h"

typedef struct humanoid_chain {
  const char *name;
  sbfi_vrm_bone first, last;
} humanoid_chain;

enum { TO_RIGHT = SBFI_VRM_RIGHT - SBFI_VRM_LEFT };
static const humanoid_chain chains[] = {{"spine", SBFI_VRM_HIPS, SBFI_VRM_UPPER_CHEST},
    {"neck", SBFI_VRM_NECK, SBFI_VRM_NECK}, {"head", SBFI_VRM_HEAD, SBFI_VRM_HEAD},
    {"leg_left", SBFI_VRM_UPPER_LEG, SBFI_VRM_TOES},
    {"leg_right", SBFI_VRM_UPPER_LEG + TO_RIGHT, SBFI_VRM_TOES + TO_RIGHT},
    {"arm_left", SBFI_VRM_SHOULDER, SBFI_VRM_HAND},
    {"arm_right", SBFI_VRM_SHOULDER + TO_RIGHT, SBFI_VRM_HAND + TO_RIGHT}};

static bool is_below(const sbf_asset *a, int32_t bone, int32_t ancestor) {
  while (bone > ancestor) bone = a->bones.at[bone].parent;
  return bone == ancestor;
}

/* Bones of a chain that are there, each below the one before. */
static bool write_chain(sbfi_conversion *c, const humanoid_chain *from, sbf_retarget_chain *to) {
  uint32_t *bones = sbfi_convert_allocate(c, SBFI_VRM_BONES, sizeof *bones), count = 0;
  sbf_retarget_chain_init(to);
  if (!bones) return false;
  for (int i = (int)from->first; i <= (int)from->last; i++) {
    int32_t node = c->rig->vrm->bones[i], bone = node == SBF_NONE ? SBF_NONE : c->bone_of_node[node];
    if (bone == SBF_NONE || c->node_of_bone[bone] != (uint32_t)node) continue;
    bool follows = count == 0 ||
                   (bone != (int32_t)bones[count - 1] && is_below(c->asset, bone, (int32_t)bones[count - 1]));
    if (follows)
      bones[count++] = (uint32_t)bone;
    else
      sbfi_convert_warn(c, SBF_CODE_IMPORT_SPRING,
          "the humanoid bone \"%.60s\" is not below the one before it in %s: it is left out",
          c->rig->nodes[node].name, from->name);
  }
  to->bones = (sbf_u32_list){bones, count};
  to->name = from->name;
  to->id = count ? sbfi_new_id(c, "humanoid", from->name) : "";
  return to->id != NULL;
}

sbf_status sbfi_convert_humanoid(sbfi_conversion *c) {
  enum { COUNT = sizeof chains / sizeof *chains };
  if (!c->rig || !c->rig->vrm || !c->rig->vrm->is_avatar || !c->asset->bones.count) return SBF_OK;
  sbf_retarget_chain *written = sbfi_convert_allocate(c, COUNT, sizeof *written);
  uint32_t count = 0;
  if (!written) return sbfi_convert_no_memory(c);
  for (int i = 0; i < COUNT; i++) {
    if (!write_chain(c, &chains[i], &written[count])) return sbfi_convert_no_memory(c);
    count += written[count].bones.count > 0;
  }
  c->asset->retarget_chains = (sbf_retarget_chain_list){count ? written : NULL, count};
  return SBF_OK;
}

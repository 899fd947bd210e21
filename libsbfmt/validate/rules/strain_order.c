#include "validate/rules/strain_order.h"

void sbfi_check_strain_order(sbfi_validation *v, const sbfi_strains *s, const char *path) {
  bool yields = s->yield > 0, tears = s->tear > 0, bounded = s->max > 0;
  bool shrinks_enough = s->min == -1 || -s->min > s->yield; /* enough compression for yield */
  if (tears && bounded && s->tear >= s->max)
    sbfi_found(v, SBF_CODE_STRAIN_ORDER, path, -1, "springs tear at the strain %.4g, but are limited to %.4g",
        (double)s->tear, (double)s->max);
  if (yields && bounded && s->yield >= s->max && !shrinks_enough)
    sbfi_found(v, SBF_CODE_STRAIN_ORDER, path, -1,
        "springs yield at the strain %.4g, but are limited to %.4g", (double)s->yield, (double)s->max);
  if (yields && tears && s->yield >= s->tear)
    sbfi_found(v, SBF_CODE_STRAIN_ORDER, path, -1, "springs yield at the strain %.4g, but tear at %.4g",
        (double)s->yield, (double)s->tear);
}

#include "material_options.h"

#include <string.h>

#include "sbfmt/materials.h"

/* The material's name; `*body` receives where the body's begins, NULL for all, and `*length` how long it is.
 */
static const char *divide(const char *value, const char **body, size_t *length) {
  const char *equals = strrchr(value, '=');
  *body = equals ? value : NULL;
  *length = equals ? (size_t)(equals - value) : 0;
  return equals ? equals + 1 : value;
}

bool materials_check(const cli_call *call) {
  const char *value, *body;
  size_t length;
  for (int at = 0; (value = cli_next_value(call, "--material", &at));)
    if (!sbf_material_find(divide(value, &body, &length))) {
      cli_wrong(call, "no material '%s'; sbfmt %s --help lists them", divide(value, &body, &length),
          call->verb->name);
      return false;
    }
  return true;
}

static bool is(const char *text, const char *wanted, size_t length) {
  return strlen(text) == length && memcmp(text, wanted, length) == 0;
}

bool materials_apply(const cli_call *call, sbf_asset *asset) {
  uint32_t count = asset->soft_bodies.count;
  const char *value, *name;
  size_t length;
  int at = 0;
  if (!cli_value(call, "--material")) return true;
  sbf_soft_body *bodies = sbf_asset_allocate(asset, (size_t)count + 1, sizeof *bodies);
  if (!bodies) {
    cli_wrong(call, "out of memory");
    return false;
  }
  if (count) memcpy(bodies, asset->soft_bodies.at, count * sizeof *bodies);
  asset->soft_bodies.at = bodies;
  while ((value = cli_next_value(call, "--material", &at))) {
    const sbf_material_preset *preset = sbf_material_find(divide(value, &name, &length));
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; i++) {
      if (name && !is(bodies[i].name, name, length) && !is(bodies[i].id, name, length)) continue;
      sbf_material_apply(preset, &bodies[i].attributes);
      found++;
    }
    if (name && !found) {
      cli_wrong(call, "no soft body '%.*s' to be made of %s", (int)length, name, preset->name);
      return false;
    }
  }
  return true;
}

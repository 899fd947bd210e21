/* `--material NAME` and `--material BODY=NAME`: applies presets to the bodies of an asset, and to the
 * sections that a build will cut from its skins. */
#ifndef MATERIAL_OPTIONS_H
#define MATERIAL_OPTIONS_H

#include "cli.h"
#include "sbfmt/asset.h"

#define MATERIALS_OPTION                                                                                     \
  {                                                                                                          \
    "--material", "[BODY=]NAME",                                                                             \
        "material of all bodies, or of the body with that name or id, or of the section of that bone; "      \
        "repeatable: cotton, denim, fat, flesh, jelly, leather, muscle, rubber, silk"                        \
  }

/* False, with a message, if a material does not exist. */
bool materials_check(const cli_call *call);

/* Whether the call sets the material of every body. */
bool materials_of_all(const cli_call *call);

/* Sets the attributes of the asset's soft bodies, or its section recipes if sections will be cut, in the
 * order of the options. False, with a message, if the asset has no such body or bone, or memory runs out. */
bool materials_apply(const cli_call *call, sbf_asset *asset);

#endif

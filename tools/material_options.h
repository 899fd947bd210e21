/* `--material NAME` and `--material BODY=NAME`: presets onto the bodies of an asset, and onto the sections
 * that a build will cut from its skins. */
#ifndef MATERIAL_OPTIONS_H
#define MATERIAL_OPTIONS_H

#include "cli.h"
#include "sbfmt/asset.h"

#define MATERIALS_OPTION                                                                                     \
  {                                                                                                          \
    "--material", "[BODY=]NAME",                                                                             \
        "what bodies are made of, all or the one of that name or id, of a skin the section of that bone; "   \
        "may be given again: cotton, denim, fat, flesh, jelly, leather, muscle, rubber, silk"                \
  }

/* False, with a message, where a material is named that there is none of. */
bool materials_check(const cli_call *call);

/* Whether the call says what every body is made of. */
bool materials_of_all(const cli_call *call);

/* Sets the attributes of the asset's soft bodies, or its section recipes where sections are to be cut, in the
 * order of the options. False, with a message, where the asset has no such body or bone, or memory runs out.
 */
bool materials_apply(const cli_call *call, sbf_asset *asset);

#endif

/* SoftAssetLoader: lets ResourceLoader read .sbfz, from the project's folder or from an exported game. */
#ifndef SBFMT_GODOT_ASSET_LOADER_H
#define SBFMT_GODOT_ASSET_LOADER_H

#include "classes.h"

extern const gd_class asset_loader_class;

/* Registers the loader with Godot, until the other function is called. */
void asset_loader_begin(void);
void asset_loader_end(void);

#endif

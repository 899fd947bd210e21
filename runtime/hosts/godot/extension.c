/* Entry point for Godot: sbfmt_godot_begin, as named in addons/sbfmt/sbfmt.gdextension. */
#include "asset_loader.h"
#include "class_help.h"
#include "soft_character.h"

#if defined(_WIN32)
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

static const gd_class *const classes[] = {&soft_asset_class, &asset_loader_class, &soft_character_class};
enum { CLASSES = sizeof classes / sizeof *classes };

static void initialize(void *userdata, GDExtensionInitializationLevel level) {
  (void)userdata;
  if (level == GDEXTENSION_INITIALIZATION_EDITOR) words_set_help();
  if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
  for (int i = 0; i < CLASSES; i++) gd_class_register(classes[i]);
  asset_loader_begin();
}

static void deinitialize(void *userdata, GDExtensionInitializationLevel level) {
  (void)userdata;
  if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
  asset_loader_end();
  for (int i = CLASSES; i-- > 0;) gd_class_unregister(classes[i]);
  gd_free_names();
}

EXPORTED GDExtensionBool sbfmt_godot_begin(GDExtensionInterfaceGetProcAddress get,
    GDExtensionClassLibraryPtr library, GDExtensionInitialization *initialization);
GDExtensionBool sbfmt_godot_begin(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library,
    GDExtensionInitialization *initialization) {
  if (!gd_api_load(get, library)) return false;
  initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
  initialization->userdata = NULL;
  initialization->initialize = initialize;
  initialization->deinitialize = deinitialize;
  return true;
}

#include "godot_api.h"

#include <stdio.h>

gd_api gd;

bool gd_api_load(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library) {
  gd.library = library;
  gd.get = get;
#define X(name, type)                                                                                        \
  if (!(gd.name = (GDExtensionInterface##type)(void (*)(void))get(#name))) {                                 \
    fprintf(stderr, "sbfmt: this Godot has no %s: the extension needs 4.6 or newer\n", #name);               \
    return false;                                                                                            \
  }
  GD_CALLS(X)
#undef X
  return true;
}

GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars gd_editor_help(void) {
  return (GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars)(void (*)(void))gd.get(
      "editor_help_load_xml_from_utf8_chars");
}

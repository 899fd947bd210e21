#include "output_name.h"

#include <string.h>
#include <strings.h>
#include <sys/stat.h>

bool output_name_ends(const char *path, const char *ending) {
  size_t length = strlen(path), tail = strlen(ending);
  return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

bool output_name_check(const cli_call *call, const char *option, const char *const *endings) {
  const char *path = cli_value(call, option);
  struct stat facts;
  char known[160] = "";
  size_t at = 0;
  bool exists = path && stat(path, &facts) == 0;
  if (exists && S_ISDIR(facts.st_mode)) {
    cli_wrong(call, "%s %s is a folder; name a file in it, for example out%s", option, path, endings[0]);
    return false;
  }
  if (!path || (exists && !S_ISREG(facts.st_mode))) return true;
  for (int i = 0; endings[i]; i++) {
    if (output_name_ends(path, endings[i])) return true;
    if (at < sizeof known)
      at += (size_t)snprintf(known + at, sizeof known - at, "%s%s", i ? ", " : "", endings[i]);
  }
  cli_wrong(call, "%s takes a name with %s %s, not '%s'", option,
      endings[1] ? "one of the endings" : "the ending", known, path);
  return false;
}

bool output_name_of_bundle(const cli_call *call, const char *option) {
  static const char *const endings[] = {".sbf", ".sbfz", ".glb", NULL};
  return output_name_check(call, option, endings);
}

/* Gives every file named, and every file of a folder named, to the fuzz target it is linked with: what once
 * broke a reader stays mended, and what fuzzing starts from is always read. */
#define _XOPEN_SOURCE 700
#include <dirent.h>
#include <string.h>
#include <sys/stat.h>

#include "fuzz.h"
#include "harness.h"

static int replayed;

static void replay_file(const char *path) {
  size_t size;
  char *bytes = harness_read(path, &size);
  if (!bytes) {
    fprintf(stderr, "cannot read %s\n", path);
    exit(EXIT_FAILURE);
  }
  /* A block of the exact size, so that reading beyond it is found. */
  uint8_t *exact = malloc(size ? size : 1);
  FUZZ_MUST(exact);
  if (size) memcpy(exact, bytes, size);
  free(bytes);
  LLVMFuzzerTestOneInput(exact, size);
  free(exact);
  replayed++;
}

static void replay(const char *path) {
  struct stat facts;
  DIR *folder = stat(path, &facts) == 0 && S_ISDIR(facts.st_mode) ? opendir(path) : NULL;
  if (!folder) {
    replay_file(path);
    return;
  }
  for (struct dirent *entry; (entry = readdir(folder));) {
    char inside[4096];
    if (entry->d_name[0] == '.') continue;
    snprintf(inside, sizeof inside, "%s/%s", path, entry->d_name);
    replay(inside);
  }
  closedir(folder);
}

int main(int argc, char **argv) {
  for (int i = 1; i < argc; i++) replay(argv[i]);
  printf("%d files\n", replayed);
  return replayed ? EXIT_SUCCESS : EXIT_FAILURE;
}

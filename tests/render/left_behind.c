#define _POSIX_C_SOURCE 200809L

#include "left_behind.h"

#include <dirent.h>
#include <string.h>

#include "harness.h"

int left_behind(const char *beginning) {
  DIR *folder = opendir(harness_scratch("."));
  int count = 0;
  if (!folder) return -1;
  for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
    count += strncmp(entry->d_name, beginning, strlen(beginning)) == 0;
  closedir(folder);
  return count;
}

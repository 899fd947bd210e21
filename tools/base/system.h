/* What the program asks of the system beyond C's library: one implementation per system (system_posix.c,
 * system_windows.c). Paths are UTF-8; where a function fails, errno tells why. */
#ifndef BASE_SYSTEM_H
#define BASE_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* At the start of main. On Windows: UTF-8 on the console, and slashes instead of backslashes in the
 * arguments, so that a path has one form everywhere. */
void system_begin(int argc, char **argv);

bool system_make_folder(const char *path); /* also true if it exists */
/* Makes a folder of a new name: replaces the XXXXXX at the end of `path`. */
bool system_make_unique_folder(char *path);
bool system_can_write_folder(const char *path);
/* A link to a folder counts as one only if it is followed. */
bool system_is_folder(const char *path, bool follow_link);

/* Replaces `to` at once: a reader sees the old or the new content. */
bool system_replace_file(const char *from, const char *to);
bool system_sync_file(FILE *file); /* to the disk, after a flush */
FILE *system_temporary_file(void); /* for reading and writing; it vanishes when it is closed */

/* A stream whose bytes end up in memory. */
typedef struct system_memory_stream {
  FILE *file;
  char *bytes;
  size_t size;
} system_memory_stream;
FILE *system_memory_stream_open(system_memory_stream *stream); /* NULL on failure */
/* Closes it. Returns its bytes, to be freed with free, and their number; NULL if something was not written.
 */
char *system_memory_stream_close(system_memory_stream *stream, size_t *size);

/* Path of this program; false if the system does not tell or `size` is too small. */
bool system_program_path(char *to, size_t size);
uint32_t system_processor_count(void); /* at least 1 */
double system_load(void);              /* processes that wish to run; NAN if not known */

/* A library opened at run time, which stays open: unloading graphics drivers crashes some programs at their
 * end. NULL if it does not exist. */
void *system_open_library(const char *name);
typedef void (*system_function)(void);
system_function system_library_function(void *library, const char *name); /* NULL if it has none */

#endif

/* Files without a name until they are complete; the system removes them if the process ends before. */
#ifndef SBFI_UNNAMED_FILE_H
#define SBFI_UNNAMED_FILE_H

/* Opens such a file in the folder for writing; -1 if the system, or the folder's file system, does not
 * support it. */
int sbfi_unnamed_file_open(const char *folder);
/* Gives the file an unused name in the same folder; 0, or -1 and errno. */
int sbfi_unnamed_file_name(int handle, const char *path);

#endif

/* Files that have no name until they are whole, so that the system drops them with the process that writes
 * them. */
#ifndef SBFI_UNNAMED_FILE_H
#define SBFI_UNNAMED_FILE_H

/* A file in the folder, to write to; -1 where the system, or that folder's file system, has none such. */
int sbfi_unnamed_file_open(const char *folder);
/* Gives it a name that is not taken, in the same folder; 0, or -1 and errno. */
int sbfi_unnamed_file_name(int handle, const char *path);

#endif

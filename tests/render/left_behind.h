/* Files of the scratch folder whose names begin so: to see that nothing half made is left. */
#ifndef TEST_LEFT_BEHIND_H
#define TEST_LEFT_BEHIND_H

int left_behind(const char *beginning); /* how many; -1: the folder cannot be read */

#endif

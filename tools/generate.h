/* Manual pages and shell completion, generated from the table of verbs. */
#ifndef GENERATE_H
#define GENERATE_H

/* `sbfmt --generate man|bash|zsh|fish DIR`: writes sbfmt.1 and sbfmt-VERB.1, sbfmt, _sbfmt or sbfmt.fish into
 * the folder. Returns the exit status. */
int generate_files(const char *what, const char *folder);

#endif

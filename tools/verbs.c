#include "cli.h"

extern const cli_verb verb_diff, verb_info, verb_pack, verb_unpack;

const cli_verb *const cli_verbs[] = {&verb_info, &verb_pack, &verb_unpack, &verb_diff, NULL};

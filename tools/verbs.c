/* The list of verbs. */
#include "cli.h"

extern const cli_verb verb_build, verb_chart, verb_convert, verb_diff, verb_export, verb_info, verb_pack,
    verb_render, verb_run, verb_tune, verb_unpack, verb_validate, verb_view;

const cli_verb *const cli_verbs[] = {&verb_convert, &verb_build, &verb_validate, &verb_info, &verb_pack,
    &verb_unpack, &verb_diff, &verb_export, &verb_run, &verb_render, &verb_view, &verb_chart, &verb_tune,
    NULL};

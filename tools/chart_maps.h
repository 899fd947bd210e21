/* `sbfmt chart --map`: stability maps. */
#ifndef SBFMT_CHART_MAPS_H
#define SBFMT_CHART_MAPS_H

#include "cli.h"

/* Runs the call; returns the exit status. */
int chart_maps_run(cli_call *call);

#endif

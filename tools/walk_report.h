/* Measures the quality of a character's walk: rhythm, knees, balance, body, limits; frame by frame. */
#ifndef WALK_REPORT_H
#define WALK_REPORT_H

#include "sole.h"

typedef struct walk_report walk_report;

/* NULL if the character has no legs, or memory runs out. `feet` must outlive it. */
walk_report *walk_report_create(const session *s, const soles *feet);
void walk_report_destroy(walk_report *r);

/* Measures the current frame: `skin` has the vertices of all render meshes, concatenated. */
void walk_report_measure(walk_report *r, const session *s, const sbf_vec3 *skin);

/* Adds its keys to the report of a run. */
void walk_report_add(const walk_report *r, const session *s, json_t *object);

#endif

/* Reports which of a run's soft bodies lost their shape: reset to their rest shape, inside out, crushed or
 * overstretched. */
#ifndef RECOVERY_REPORT_H
#define RECOVERY_REPORT_H

#include "session.h"

typedef struct recovery_count {
  uint32_t last;         /* sbr_body_health.recoveries of the last frame */
  uint32_t total;        /* total of the run */
  uint32_t rigid;        /* frames in which it moved as a rigid body */
  uint32_t row, longest; /* consecutive frames with a reset, current and maximum */
  uint32_t crushed; /* frames in which an element had less than a fifth, or the body less than half, of its
                       volume */
  uint32_t crushed_row;   /* of these, current consecutive ones */
  float min_ratio;        /* minimum sbr_body_health.min_element_ratio */
  float min_volume_ratio; /* minimum sbr_body_health.volume_ratio */
  uint32_t inverted;      /* frames in which an element or the surface was inside out */
  uint32_t stretched;     /* frames in which an element had more than ten times its rest length */
  uint32_t stretched_row, stretched_longest; /* of these, consecutive ones, current and maximum */
  float max_strain;                          /* maximum sbr_body_health.max_strain */
} recovery_count;

typedef struct recovery_report {
  recovery_count *bodies; /* one per soft body; NULL: none */
  uint32_t body_count;
  double frame_s; /* length of a frame */
} recovery_report;

/* False if memory runs out. */
bool recovery_report_begin(recovery_report *r, const sbf_asset *asset, double frame_s);
void recovery_report_end(recovery_report *r);
/* Once per frame and body. */
void recovery_report_measure(recovery_report *r, uint32_t body, const sbr_body_health *health);
/* Total of all bodies in the run. */
uint64_t recovery_report_total(const recovery_report *r);
/* Whether no body was reset, inside out, or overstretched for longer than a strike takes. */
bool recovery_report_is_valid(const recovery_report *r);
/* Adds `recoveries`, the sum over all bodies, `recovered`, the bodies with one, and `inverted`, `stretched`
 * and `crushed`, the bodies that were so in any frame. */
void recovery_report_add(const recovery_report *r, const sbf_asset *asset, json_t *to);
/* Warns on standard error about each body that was reset so often that it moved as a rigid body, and each
 * that ends crushed. */
void recovery_report_warn(const recovery_report *r, const sbf_asset *asset);

#endif

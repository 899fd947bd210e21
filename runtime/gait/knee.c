/* Limits the angular acceleration of knees.
 *
 * A step is planned with what is known at its beginning; body and ground may then move otherwise. If the
 * foot's path would accelerate the knee too much, the knee lags behind and catches up as fast as it can stop
 * again. */
#include "gait/gait_state.h"
#include "math/trig.h"

static const float PI = 3.14159265f;
static const float ABRUPT =
    285; /* rad/s2, 4.5 degrees a frame of 1/60 s in a frame: a knee's turn changes by no more */
static const float QUICK = 2;       /* rad/s: a knee that turns no faster is not held, */
static const float STRAIGHT = 2.7f; /* rad: unless it is as straight as this */
static const float EXACT = 1e-5f;   /* rad: a knee so near to where it should be is there */

float sbri_knee_angle(const sbri_leg *leg, float scale, float distance) {
  float upper = leg->upper_length * scale, lower = leg->lower_length * scale;
  return sbri_acos((upper * upper + lower * lower - distance * distance) / (2 * upper * lower));
}

float sbri_knee_distance(const sbri_leg *leg, float scale, float angle) {
  float upper = leg->upper_length * scale, lower = leg->lower_length * scale, s, c;
  sbri_sincos(angle, &s, &c);
  float square = upper * upper + lower * lower - 2 * upper * lower * c;
  return square > 0 ? sqrtf(square) : 0;
}

/* How fast to go towards a place so far off, so that it can be stopped at there. */
static float approach(float away, float tick_s) {
  float off = fabsf(away), change = ABRUPT * tick_s;
  float speed = off <= change * tick_s ? off / tick_s
                                       : sqrtf(2 * ABRUPT * off + 0.25f * change * change) - 0.5f * change;
  return away < 0 ? -speed : speed;
}

float sbri_knee_follow(const sbri_foot *foot, float wanted, float tick_s) {
  if (foot->knee_known < 2) return wanted;
  float change = ABRUPT * tick_s, goes = (wanted - foot->knee_wanted) / tick_s;
  float rate = goes + approach(foot->knee_wanted - foot->knee, tick_s);
  float stops = approach(PI - foot->knee, tick_s); /* where the leg is straight */
  if (rate > stops) rate = stops;
  rate = sbri_clamp(rate, foot->knee_rate - change, foot->knee_rate + change);
  float angle = sbri_clamp(foot->knee + rate * tick_s, 0, PI);
  return fabsf(angle - wanted) > EXACT ? angle : wanted;
}

void sbri_knee_keep(sbri_foot *foot, float angle, float wanted, float tick_s) {
  foot->knee_rate = foot->knee_known ? (angle - foot->knee) / tick_s : 0;
  foot->knee = angle;
  foot->knee_wanted = wanted;
  if (foot->knee_known < 2) foot->knee_known++;
}

bool sbri_knee_range(const sbri_leg *leg, const sbri_foot *foot, const sbri_gait_input *input, float full,
    float *shortest, float *longest) {
  if (foot->knee_known < 2 || (foot->knee < STRAIGHT && fabsf(foot->knee_rate) < QUICK)) return false;
  float tick = input->tick_s, change = ABRUPT * tick;
  float ends = sbri_knee_angle(leg, input->scale, sbri_leg_span(leg, input->scale, full)),
        left = ends - foot->knee;
  float max = foot->knee_rate + change, stops = left > 0 ? approach(left, tick) : 0;
  if (stops < max) max = stops > foot->knee_rate - change ? stops : foot->knee_rate - change;
  float straight = foot->knee + max * tick, bent = foot->knee + (foot->knee_rate - change) * tick;
  *longest = *shortest = 0;
  if (straight < ends)
    *longest = sbri_leg_upright(leg, input->scale, sbri_knee_distance(leg, input->scale, straight));
  else
    *longest = full;
  if (bent > 0) *shortest = sbri_leg_upright(leg, input->scale, sbri_knee_distance(leg, input->scale, bent));
  return true;
}

/* Limits the angular acceleration of knees.
 *
 * A step is planned from the state at its beginning; body and ground may move differently later. If the
 * foot's path would accelerate the knee too much, the knee lags and catches up as fast as it can still stop.
 */
#include "animation/gait/gait_state.h"
#include "math/trig.h"

static const float PI = 3.14159265f;
static const float MAX_ACCELERATION =
    285; /* rad/s2, maximum angular acceleration: 4.5 degrees per frame of 1/60 s and frame */
static const float QUICK = 2;       /* rad/s; knees slower than this have no limit, */
static const float STRAIGHT = 2.7f; /* rad; unless they are straighter than this */
static const float EXACT = 1e-5f;   /* rad; tolerance below which a knee is at its target */

float sbri_knee_angle(const sbri_leg *leg, float scale, float distance) {
  float upper = leg->length.upper * scale, lower = leg->length.lower * scale;
  return sbri_acos((upper * upper + lower * lower - distance * distance) / (2 * upper * lower));
}

float sbri_knee_distance(const sbri_leg *leg, float scale, float angle) {
  float upper = leg->length.upper * scale, lower = leg->length.lower * scale, s, c;
  sbri_sincos(angle, &s, &c);
  float square = upper * upper + lower * lower - 2 * upper * lower * c;
  return square > 0 ? sqrtf(square) : 0;
}

/* Maximum angular velocity towards a target at this distance at which it can still stop there. */
static float approach(float distance, float tick_s) {
  float size = fabsf(distance), change = MAX_ACCELERATION * tick_s;
  float speed = size <= change * tick_s
                    ? size / tick_s
                    : sqrtf(2 * MAX_ACCELERATION * size + 0.25f * change * change) - 0.5f * change;
  return distance < 0 ? -speed : speed;
}

float sbri_knee_follow(const sbri_foot *foot, float target, float tick_s) {
  if (foot->knee.known_ticks < 2) return target;
  float change = MAX_ACCELERATION * tick_s, rate_of_target = (target - foot->knee.wanted) / tick_s;
  float rate = rate_of_target + approach(foot->knee.wanted - foot->knee.angle, tick_s);
  float stopping_rate = approach(PI - foot->knee.angle, tick_s); /* must stop when the leg is straight */
  if (rate > stopping_rate) rate = stopping_rate;
  rate = sbri_clamp(rate, foot->knee.rate - change, foot->knee.rate + change);
  float angle = sbri_clamp(foot->knee.angle + rate * tick_s, 0, PI);
  return fabsf(angle - target) > EXACT ? angle : target;
}

void sbri_knee_store(sbri_foot *foot, float angle, float target, float tick_s) {
  foot->knee.rate = foot->knee.known_ticks ? (angle - foot->knee.angle) / tick_s : 0;
  foot->knee.angle = angle;
  foot->knee.wanted = target;
  if (foot->knee.known_ticks < 2) foot->knee.known_ticks++;
}

bool sbri_knee_range(const sbri_leg *leg, const sbri_foot *foot, const sbri_gait_input *input, float full,
    float *shortest, float *longest) {
  if (foot->knee.known_ticks < 2 || (foot->knee.angle < STRAIGHT && fabsf(foot->knee.rate) < QUICK))
    return false;
  float tick = input->tick_s, change = MAX_ACCELERATION * tick;
  float straightest = sbri_knee_angle(leg, input->scale, sbri_leg_span(leg, input->scale, full)),
        remaining = straightest - foot->knee.angle;
  float max = foot->knee.rate + change, stopping_rate = remaining > 0 ? approach(remaining, tick) : 0;
  if (stopping_rate < max)
    max = stopping_rate > foot->knee.rate - change ? stopping_rate : foot->knee.rate - change;
  float straight = foot->knee.angle + max * tick, bent = foot->knee.angle + (foot->knee.rate - change) * tick;
  *longest = *shortest = 0;
  if (straight < straightest)
    *longest = sbri_leg_upright(leg, input->scale, sbri_knee_distance(leg, input->scale, straight));
  else
    *longest = full;
  if (bent > 0) *shortest = sbri_leg_upright(leg, input->scale, sbri_knee_distance(leg, input->scale, bent));
  return true;
}

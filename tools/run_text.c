#include "run_text.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The units of measures that have one. */
static const struct {
  const char *key, *unit;
} units[] = {{"seconds", "s"}, {"us_per_frame", "us"}, {"energy", "J"}, {"distance", "m"},
    {"stance_slip", "m"}, {"penetration", "m"}, {"leg_length", "m"}, {"knee_speed_step", "degrees"},
    {"support_margin", "m"}, {"limit_excess", "degrees"}, {"body_speed_step", "m"},
    {"body_turn_step", "degrees"}, {"joint_gap", "m"}, {"rest_time", "s"}, {"stride", "m"}, {"period", "s"}};

static const char *unit_of(const char *key) {
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    if (strcmp(units[i].key, key) == 0) return units[i].unit;
  return NULL;
}

static void print_value(const char *key, json_t *value) {
  char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_REAL_PRECISION(6));
  const char *unit = unit_of(key);
  size_t length = text ? strlen(text) : 0;
  bool quoted = length > 1 && text[0] == '"', is_null = length == 4 && strcmp(text, "null") == 0;
  if (is_null)
    printf("-");
  else
    printf("%.*s", (int)(quoted ? length - 2 : length), length ? text + quoted : "");
  if (unit && !is_null) printf(" %s", unit);
  free(text);
}

/* Members of an object, as "key value, key value"; returns their number. */
static int print_members(json_t *object) {
  const char *key;
  json_t *value;
  int count = 0;
  json_object_foreach(object, key, value) {
    printf("%s%s ", count++ ? ", " : "", key);
    print_value(key, value);
  }
  return count;
}

static bool has_members(json_t *value) {
  const char *key;
  json_t *inner;
  json_object_foreach(value, key, inner) return true;
  return false;
}

/* A measure of each leg: in one line, or one line per leg if there are several. */
static void print_of_each(const char *key, json_t *each) {
  const char *name;
  json_t *of_one;
  bool several = false;
  json_object_foreach(each, name, of_one) several = several || has_members(of_one);
  if (!several) {
    printf("%-20s ", key);
    print_members(each);
    printf("\n");
    return;
  }
  printf("%s\n", key);
  json_object_foreach(each, name, of_one) {
    printf("  %-18s ", name);
    print_members(of_one);
    printf("\n");
  }
}

void run_text_print(json_t *report) {
  const char *key;
  json_t *value;
  json_object_foreach(report, key, value) {
    if (has_members(value)) {
      print_of_each(key, value);
      continue;
    }
    printf("%-20s ", key);
    print_value(key, value);
    printf("\n");
  }
}

#include "rules.h"

#define CLIP(tracks) ROOT_BONE "<clips><clip id=\"c\" duration=\"1\">" tracks "</clip></clips>"
#define TRACK(property, attributes, times, values)                                                           \
  "<track bone=\"root\" property=\"" property "\" " attributes "><times>" times "</times><values>" values    \
  "</values></track>"
#define PATH "/sbf/clips/clip[1]/track[1]"

START_TEST(test_good_clips)
{
  rules_expect(CLIP(TRACK("translation", "", "0 0.5 1", "0 0 0 0 1 0 0 0 0")
                       TRACK("scale", "interpolation=\"cubic\"", "0", "0 0 0 1 1 1 0 0 0")),
      "");
}
END_TEST

START_TEST(test_times)
{
  rules_expect(
      CLIP(TRACK("translation", "", "0 0.5 0.5", "0 0 0 0 1 0 0 0 0")), "CLIP_TIMES " PATH "/times #2");
  rules_expect(CLIP(TRACK("translation", "", "-0.1 0.5", "0 0 0 0 1 0")), "CLIP_TIMES " PATH "/times #0");
  rules_expect(CLIP(TRACK("translation", "", "0 1.00005", "0 0 0 0 1 0")), ""); /* rounding */
  rules_expect(
      CLIP(TRACK("translation", "", "0 1.1 1.2", "0 0 0 0 1 0 0 0 0")), "CLIP_PAST_END " PATH "/times #1");
}
END_TEST

START_TEST(test_values)
{
  rules_expect(CLIP(TRACK("rotation", "", "0 1", "0 0 0 1 0 0 0")), "CLIP_VALUES " PATH);
  rules_expect(
      CLIP(TRACK("translation", "interpolation=\"cubic\"", "0 1", "0 0 0 0 0 0")), "CLIP_VALUES " PATH);
  rules_expect(CLIP(TRACK("scale", "", "0 1", "1 1 1 1 -1 1")), "CLIP_SCALE " PATH "/values #3");
}
END_TEST

START_TEST(test_empty_and_repeated)
{
  rules_expect(CLIP(""), "CLIP_EMPTY /sbf/clips/clip[1]");
  rules_expect(CLIP("<track bone=\"root\" property=\"scale\"/>"), "CLIP_EMPTY " PATH);
  rules_expect(CLIP(TRACK("scale", "", "0", "1 1 1") TRACK("scale", "", "0", "1 1 1")),
      "CLIP_TRACK_REPEATED /sbf/clips/clip[1]/track[2]");
}
END_TEST

START_TEST(test_poses)
{
#define POSES(inside) ROOT_BONE "<poses>" inside "</poses>"
#define POSE(id, attributes, keys) "<pose id=\"" id "\" " attributes ">" keys "</pose>"
#define KEY "<pose_key bone=\"root\"/>"
  rules_expect(POSES(POSE("a", "", KEY) POSE("b", "", KEY) POSE("c", "distance=\"1\"", KEY)), "");
  rules_expect(POSES(POSE("a", "", "")), "POSE_EMPTY /sbf/poses/pose[1]");
  rules_expect(POSES(POSE("a", "", KEY KEY)), "POSE_REPEATED /sbf/poses/pose[1]/pose_key[2]");
  rules_expect(POSES(POSE("a", "distance=\"-1\"", KEY)), "POSE_DISTANCE /sbf/poses/pose[1]");
  rules_expect(POSES(POSE("a", "distance=\"1\"", KEY) POSE("b", "distance=\"1\"", KEY)),
      "POSE_DISTANCE /sbf/poses/pose[2]");
  rules_expect(
      POSES(POSE("a", "distance=\"1\"", KEY) POSE("b", "distance=\"1\" speed=\"2\"", KEY)), ""); /* a run */
}
END_TEST

RULES_MAIN("clip_rules", test_good_clips, test_times, test_values, test_empty_and_repeated, test_poses)

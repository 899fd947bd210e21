#include "import/convert/part_words.h"

#include <ctype.h>
#include <string.h>

enum { MAX_WORD = 24 };

/* Whole words of a name. A trailing * matches any continuation. */
static const char *const soft_words[] = {"belly", "stomach", "abdomen", "breast*", "boob*", "butt",
    "buttock*", "glute*", "thigh*", "tail*", "ear", "ears", "cheek*", "udder*", "hump*", "jelly", "blob",
    NULL};
static const char *const limb_words[] = {"finger*", "thumb*", "index", "pinky", "pinkie", "ring", "middle",
    "digit*", "toe", "toes", "toebase", "foot*", "feet", "hand*", "palm*", "wrist*", "ankle*", "heel*",
    "paw*", "hoof*", "hooves", "claw*", "talon*", "forearm*", "forelimb*", "elbow*", "shin*", "calf*",
    "knee*", "pincer*", "nail*", NULL};
static const char *const face_words[] = {"eye", "eyes", "eyeball*", "eyelid*", "eyebrow*", "brow*", "pupil*",
    "jaw*", "mouth*", "lip", "lips", "teeth", "tooth", "fang*", "tongue*", "nose*", "snout*", "face*",
    "beak*", "bill", "horn*", "antler*", "tusk*", "skull*", "chin", "glasses", NULL};
static const char *const prop_words[] = {"weapon*", "gun*", "pistol*", "rifle*", "sword*", "blade*", "knife*",
    "dagger*", "shield*", "axe*", "hammer*", "bow", "arrow*", "quiver*", "staff*", "wand*", "spear*",
    "armor*", "armour*", "helm", "helmet*", "visor*", "wheel*", "track", "tracks", "tyre*", "tire", "tires",
    "turret*", "cannon*", "barrel*", "door*", "lid", "prop", "props", "tool*", "bag", "backpack*", "crown*",
    "hat", "hats", "pauldron*", "buckle*", "rocket*", "missile*", "engine*", "thruster*", "antenna*",
    "spike*", "sting*", "shell", NULL};
static const char *const machine_words[] = {"mech", "mecha", "robot*", "android*", "cyborg*", "tank", "tanks",
    "car", "truck*", "drone*", "machine*", "vehicle*", "spaceship*", NULL};
static const char *const hard_words[] = {"metal*", "steel", "iron", "chrome", "copper", "bronze", "brass",
    "armor*", "armour*", "wood*", "stone*", "rock*", "glass*", "bone", "bones", "plastic*", "weapon*", "gun",
    "sword*", "blade*", "eye", "eyes", "teeth", "tooth", "claw*", "horn*", "nail*", NULL};

static bool is_word(const char *word, const char *pattern) {
  size_t length = strlen(pattern);
  bool open = pattern[length - 1] == '*';
  return open ? strncmp(word, pattern, length - 1) == 0 : strcmp(word, pattern) == 0;
}

static bool is_among(const char *word, const char *const *patterns) {
  for (; *patterns; patterns++)
    if (is_word(word, *patterns)) return true;
  return false;
}

/* The next word in lower case; false at the end of the name. */
static bool next_word(const char **name, char word[MAX_WORD]) {
  const unsigned char *at = (const unsigned char *)*name;
  size_t length = 0;
  while (*at && !isalpha(*at)) at++;
  while (isalpha(*at) && !(length && isupper(*at) && islower(at[-1]))) {
    if (length + 1 < MAX_WORD) word[length++] = (char)tolower(*at);
    at++;
  }
  word[length] = 0;
  *name = (const char *)at;
  return length > 0;
}

/* Second word of a limb's name after `lower`: LowerArm, lower_leg. */
static bool is_limb(const char *word) {
  return is_word(word, "arm*") || is_word(word, "leg*");
}

sbfi_name_hint sbfi_words_of_name(const char *name) {
  sbfi_name_hint says = SBFI_NAME_HINT_NONE;
  bool lower = false, fore = false;
  char word[MAX_WORD];
  while (name && next_word(&name, word)) {
    sbfi_name_hint one = is_among(word, machine_words) ? SBFI_NAME_HINT_MACHINE
                         : is_among(word, prop_words)  ? SBFI_NAME_HINT_PROP
                         : is_among(word, face_words)  ? SBFI_NAME_HINT_FACE
                         : is_among(word, limb_words) || (lower && is_limb(word)) ||
                                 is_word(word, "lowerarm*") || is_word(word, "lowerleg*") ||
                                 (fore && is_word(word, "arm*"))
                             ? SBFI_NAME_HINT_LIMB
                         : is_among(word, soft_words) ? SBFI_NAME_HINT_SOFT
                                                      : SBFI_NAME_HINT_NONE;
    if (one > says) says = one;
    fore = is_word(word, "fore");
    lower = is_word(word, "lower") || is_word(word, "low");
  }
  return says;
}

bool sbfi_material_is_hard(const char *name) {
  char word[MAX_WORD];
  while (name && next_word(&name, word))
    if (is_among(word, hard_words)) return true;
  return false;
}

#include "rules.h"

START_TEST(test_names)
{
#define NAMED(kind, id, name) "<" kind " id=\"" id "\" name=\"" name "\"/>"
  rules_expect("<skeleton><bone id=\"a\" name=\"Arm\" head=\"0 0 0\"/><bone id=\"b\" name=\"arm\" head=\"0 0 "
               "0\"/><bone id=\"c\" head=\"0 0 0\"/><bone id=\"d\" head=\"0 0 0\"/></skeleton>",
      "");
  rules_expect("<skeleton><bone id=\"a\" name=\"Arm\" head=\"0 0 0\"/><bone id=\"b\" name=\"Leg\" head=\"0 0 "
               "0\"/><bone id=\"c\" name=\"Arm\" head=\"0 0 0\"/></skeleton>",
      "NAME_REPEATED /sbf/skeleton/bone[3]");
  rules_expect("<soft_body id=\"a\" name=\"A\">" TETRA "</soft_body><soft_body id=\"b\" name=\"A\">" TETRA
               "</soft_body>",
      "NAME_REPEATED /sbf/soft_body[2]");
  /* a section may have its bone's name */
  rules_expect("<skeleton>" BONE("root", "0 0 0",
                   "") "</skeleton><soft_body id=\"b\" name=\"root\" bone=\"root\">" TETRA "</soft_body>",
      "");
}
END_TEST

START_TEST(test_extensions)
{
#define EXTENSION(name) "<extensions><extension name=\"" name "\"/></extensions>"
  rules_expect(EXTENSION("EXAMPLE_soft_2"), "");
  rules_expect(EXTENSION("EXAMPLE"), "EXTENSION_NAME /sbf/extensions/extension[1]");
  rules_expect(EXTENSION("E_what"), "EXTENSION_NAME /sbf/extensions/extension[1]");
  rules_expect(EXTENSION("EXAMPLEXY_what"), "EXTENSION_NAME /sbf/extensions/extension[1]");
  rules_expect(EXTENSION("EXAMPLE_What"), "EXTENSION_NAME /sbf/extensions/extension[1]");
  rules_expect(EXTENSION("EXAMPLE_"), "EXTENSION_NAME /sbf/extensions/extension[1]");
  rules_expect("<extensions><extension name=\"AB_c\"/><extension name=\"AB_c\"/></extensions>",
      "EXTENSION_REPEATED /sbf/extensions/extension[2]");
}
END_TEST

START_TEST(test_hashes)
{
#define SUM "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"
  rules_expect("<asset><source path=\"a\" sha256=\"" SUM "\"/><source path=\"b\"/></asset>", "");
  rules_expect(
      "<asset><source path=\"a\" sha256=\"" SUM "0\"/></asset>", "HASH_MALFORMED /sbf/asset/source[1]");
  rules_expect("<derivations><derivation id=\"d\" source_hash=\"ABCDEF\"/></derivations>",
      "HASH_MALFORMED /sbf/derivations/derivation[1]\nDERIVED_STALE /sbf/derivations/derivation[1]");
}
END_TEST

RULES_MAIN("name_rules", test_names, test_extensions, test_hashes)

#include "harness.h"

#include <stdio.h>
#include <string.h>

#include "base/sha256.h"

static const char *hash_of(const char *bytes, size_t size, size_t step) {
  static char text[SBFI_SHA256_TEXT_SIZE];
  uint8_t digest[SBFI_SHA256_BYTES];
  sbfi_sha256 hash;
  sbfi_sha256_init(&hash);
  for (size_t at = 0; at < size; at += step)
    sbfi_sha256_update(&hash, bytes + at, size - at < step ? size - at : step);
  sbfi_sha256_finish(&hash, digest);
  sbfi_sha256_format(digest, text);
  return text;
}

START_TEST(known_inputs_give_known_hashes)
{
  const struct {
    const char *text, *digest;
  } known[] = {/* the examples of FIPS 180-4, and the empty message */
      {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
      {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
      {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"}};
  for (int i = 0; i < 3; i++)
    for (size_t step = 1; step < 70; step++)
      ck_assert_str_eq(hash_of(known[i].text, strlen(known[i].text), step), known[i].digest);
  static char million[1000000];
  memset(million, 'a', sizeof million);
  const size_t steps[] = {sizeof million, 4096, 1000, 63, 65};
  for (int i = 0; i < 5; i++)
    ck_assert_str_eq(hash_of(million, sizeof million, steps[i]),
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}
END_TEST

/* Of 0..n-1 bytes "x" for every way the padding can fall; the digests of all, hashed, by another program. */
START_TEST(every_length_is_padded_right)
{
  char bytes[200], all[200 * 64];
  memset(bytes, 'x', sizeof bytes);
  for (size_t n = 0; n < 200; n++) memcpy(all + 64 * n, hash_of(bytes, n, 200), 64);
  ck_assert_str_eq(hash_of(all, sizeof all, sizeof all),
      "f61ffcc417e1f0e59eba2da7fa32fbe05b64e478b68c6bacf990455f00248b98");
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("sha256");
  TCase *c = tcase_create("sha256");
  tcase_add_test(c, known_inputs_give_known_hashes);
  tcase_add_test(c, every_length_is_padded_right);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}

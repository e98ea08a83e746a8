/* SPDX-License-Identifier: Apache-2.0 */
/* SHA-256 against the values published with FIPS 180 and its examples. */
#include "suite.h"

#include "sha256.h"

static const char *digest_of(const char *text)
{
    static char hex[SHA256_HEX];
    sha256 s;
    sha256_init(&s);
    sha256_add(&s, text, strlen(text));
    sha256_end(hex, &s);
    return hex;
}

START_TEST(published_values)
{
    ck_assert_str_eq(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    ck_assert_str_eq(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    ck_assert_str_eq(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
                     "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    ck_assert_str_eq(digest_of("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmn"
                               "hijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu"),
                     "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
}
END_TEST

START_TEST(million_letters_in_pieces)
{
    static const char letters[] =
        "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";
    char hex[SHA256_HEX];
    sha256 s;
    size_t left = 1000000;
    size_t piece = 1;
    sha256_init(&s);
    while (left > 0) {
        piece = piece % (sizeof letters - 1) + 1;
        piece = piece < left ? piece : left;
        sha256_add(&s, letters, piece);
        left -= piece;
    }
    sha256_end(hex, &s);
    ck_assert_str_eq(hex, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}
END_TEST

SUITE_MAIN("sha256", published_values, million_letters_in_pieces)

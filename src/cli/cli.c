/* SPDX-License-Identifier: Apache-2.0 */
/* Complaints and the state of standard output. */
#include "cli.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { REASON_BYTES = 8192 }; /* a longer reason, by what was given, is cut */

/* A complaint is one line, whatever a file is called or a value holds. */
static void put_clean(const char *text)
{
    for (; *text != '\0'; text++) {
        fputc((unsigned char)*text < 0x20 || *text == 0x7F ? '?' : *text, stderr);
    }
}

int complain(const char *subject, const char *format, ...)
{
    char reason[REASON_BYTES] = "";
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    fputs("drogue: ", stderr);
    put_clean(subject);
    fputs(": ", stderr);
    put_clean(reason);
    fputc('\n', stderr);
    return EXIT_BAD;
}

int flush_output(void)
{
    /* A full device may show at any write before this one, when errno is no longer its own. */
    int failed_before = ferror(stdout);
    errno = 0;
    if (fflush(stdout) != 0 || failed_before) {
        return complain("standard output", "%s", errno != 0 ? strerror(errno) : "cannot be written");
    }
    return EXIT_MEASURED;
}

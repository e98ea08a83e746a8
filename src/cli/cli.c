/* SPDX-License-Identifier: Apache-2.0 */
/* Complaints and the state of standard output. */
#include "cli.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int complain(const char *subject, const char *format, ...)
{
    va_list arguments;
    fputs("drogue: ", stderr);
    for (; *subject != '\0'; subject++) { /* a complaint is one line, whatever a file is called */
        fputc((unsigned char)*subject < 0x20 ? '?' : *subject, stderr);
    }
    fputs(": ", stderr);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
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

/* SPDX-License-Identifier: Apache-2.0 */
/* What every part of the program shares: exit codes, complaints, output that reports its failure. */
#ifndef CLI_CLI_H
#define CLI_CLI_H

/* Exit codes, a part of the interface. */
enum {
    EXIT_MEASURED = 0, /* something was measured (edges: the map was written) */
    EXIT_NOTHING = 1,  /* read, but nothing measurable: the status says why */
    EXIT_BAD = 2       /* bad usage, unreadable input, unwritable output */
};

/* One line on standard error: "drogue: SUBJECT: REASON", the subject being a file or an option.
 *
 *  return  EXIT_BAD, so that a caller can return the complaint
 */
int complain(const char *subject, const char *format, ...);

/* Send on what was printed: EXIT_MEASURED, or EXIT_BAD with a complaint when standard output takes no more. */
int flush_output(void);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* The text of --help, from which the manual page is made, too. */
#ifndef CLI_HELP_H
#define CLI_HELP_H

/* Print it on standard output. */
void help_print(void);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Row kernels, form of rows_plain.c. */
#define DROGUE_ROWS_PLAIN 1
#include "row_kernels.h"

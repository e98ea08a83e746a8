/* SPDX-License-Identifier: Apache-2.0 */
/* Row kernels, form of rows_lanes.c. */
#define DROGUE_ROWS_PLAIN 0
#include "row_kernels.h"

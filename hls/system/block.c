/* SPDX-License-Identifier: Apache-2.0 */
/* The driver, its registers read and written where it asks for them. */
#include "driver/block.c"
#include "driver/bank.c"

/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the search: what speaks for a result. */
#ifndef DROGUE_SURE_H
#define DROGUE_SURE_H

#include "drogue/measure.h"

/* Does the inner part decide which pose it is, and agree with the outline, in its place and about its size? */
int drogue_result_decided(const drogue_result *r);

#endif

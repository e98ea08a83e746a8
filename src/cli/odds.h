/* SPDX-License-Identifier: Apache-2.0 */
/* Where program and Python package state the log odds of a result. */
#ifndef CLI_ODDS_H
#define CLI_ODDS_H

#include "drogue/search.h"

/* Do they weigh anything: was a pose measured, sure or not, and has the model the inner part that they are about? */
static inline int odds_known(const drogue_result *r, const drogue_model *model)
{
    return model->inner_radius_m_q16 > 0 && (r->status == DROGUE_OK || r->status == DROGUE_E_UNSURE);
}

#endif

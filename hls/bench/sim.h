/* SPDX-License-Identifier: Apache-2.0 */
/* Test benches only: in co-simulation by Bambu the size of every array of a call is told before it. */
#ifndef DROGUE_HLS_SIM_H
#define DROGUE_HLS_SIM_H

#ifdef __BAMBU_SIM__
#include <mdpi/mdpi_user.h>
#define SIM_ARRAY(index, array) m_param_alloc(index, sizeof(array))
#else
#define SIM_ARRAY(index, array) ((void)0)
#endif

#endif

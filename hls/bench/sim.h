/* SPDX-License-Identifier: Apache-2.0 */
/* Test benches only: in co-simulation by Bambu the size of every array of a call is told before it. */
#ifndef DROGUE_HLS_SIM_H
#define DROGUE_HLS_SIM_H

#ifdef __BAMBU_SIM__
#include <mdpi/mdpi_user.h>
#define SIM_BYTES(index, bytes) m_param_alloc(index, bytes)
#else
#define SIM_BYTES(index, bytes) ((void)(bytes))
#endif
#define SIM_ARRAY(index, array) SIM_BYTES(index, sizeof(array))

#endif

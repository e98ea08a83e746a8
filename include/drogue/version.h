/* SPDX-License-Identifier: Apache-2.0 */
/* Which version this is. */
#ifndef DROGUE_VERSION_H
#define DROGUE_VERSION_H

#ifdef __cplusplus
extern "C" {
#endif

/* Version of these headers. */
#define DROGUE_VERSION_MAJOR 0
#define DROGUE_VERSION_MINOR 1
#define DROGUE_VERSION_PATCH 0

/* "MAJOR.MINOR.PATCH" of the library. */
const char *drogue_version(void);

#ifdef __cplusplus
}
#endif
#endif

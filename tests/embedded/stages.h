/* SPDX-License-Identifier: Apache-2.0 */
/* Instructions per stage of drogue_measure(), from the library as it is installed: the linker puts a counting function
 * before each stage's entry (--wrap). A stage's count is without the stages it calls, so that all add up to the frame. */
#ifndef STAGES_H
#define STAGES_H

#include <stdint.h>

typedef enum stage { FRONT_END, CONSTRAINTS, FIT, OUTLINE, INNER, POSE, JOINT, REST, STAGE_COUNT } stage;

extern const char *const stage_names[STAGE_COUNT];

/* Forget what was counted; what runs until the first stage is the rest. */
void stages_begin(void);
/* Instructions per stage since. */
void stages_end(uint32_t instructions[STAGE_COUNT]);

#endif

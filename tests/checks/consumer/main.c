/* SPDX-License-Identifier: Apache-2.0 */
/* Uses the installed library: the package's version, given as argument, must be the library's and the headers'. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <drogue/drogue.h>

#define SIDE_PX 64

int main(int argc, char **argv)
{
    static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(SIDE_PX) / 4 + 1];
    static const uint8_t blank[SIDE_PX * SIDE_PX];
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(SIDE_PX);
    const drogue_camera camera = {
        DROGUE_Q16(100, 1), DROGUE_Q16(100, 1), DROGUE_Q16(32, 1), DROGUE_Q16(32, 1), 0, 0, 0, 0, 0};
    const drogue_model model = {DROGUE_Q16(35, 100), 0, 0};
    const drogue_image image = {blank, SIDE_PX, SIDE_PX, SIDE_PX};
    const drogue_region region = {0, 0, SIDE_PX, SIDE_PX};
    drogue_workspace workspace;
    drogue_config config;
    drogue_result result;
    drogue_track_config tracking;
    drogue_status status;
    char header[32];

    snprintf(header, sizeof header, "%d.%d.%d", DROGUE_VERSION_MAJOR, DROGUE_VERSION_MINOR, DROGUE_VERSION_PATCH);
    if (argc != 2 || strcmp(argv[1], drogue_version()) != 0 || strcmp(argv[1], header) != 0) {
        printf("consumer: package %s, header %s, library %s\n", argc == 2 ? argv[1] : "?", header, drogue_version());
        return 1;
    }
    drogue_track_config_default(&tracking);
    if (!drogue_track_config_valid(&tracking)) {
        return 1;
    }
    status = drogue_workspace_init(&workspace, memory, sizeof memory, &capacity);
    if (status == DROGUE_OK) {
        drogue_config_default(&config);
        status = drogue_measure(&result, &workspace, &(drogue_setup){&camera, &model, &config}, &image, &region);
    }
    printf("consumer: drogue %s says of a blank image: %s\n", drogue_version(), drogue_status_name(status));
    return status == DROGUE_E_NO_EDGES ? 0 : 1;
}

/* SPDX-License-Identifier: Apache-2.0 */
/* A handle holds image, workspace and the last result. */
#include "drogue_dpi.h"

#include <stdlib.h>
#include <string.h>

#include "../words.h"

/* The registers of the thresholds follow one another. */
typedef char
    as_many_registers[DROGUE_HLS_P_MIN_CHI2_GAP - DROGUE_HLS_P_CANNY_LOW + 1 == DROGUE_DPI_THRESHOLDS ? 1 : -1];

typedef struct model {
    drogue_workspace workspace;
    drogue_result result;
    drogue_config config;
    int32_t width_px;
    int32_t height_px;
    uint8_t *pixels;
    void *memory;
} model;

void drogue_dpi_close(void *handle)
{
    model *m = handle;
    if (m != NULL) {
        free(m->pixels);
        free(m->memory);
        free(m);
    }
}

void *drogue_dpi_open(int width, int height)
{
    drogue_capacity capacity;
    size_t bytes;
    model *m;
    if (width < 1 || height < 1 || width > DROGUE_MAX_SIDE || height > DROGUE_MAX_SIDE) {
        return NULL;
    }
    m = calloc(1, sizeof *m);
    if (m == NULL) {
        return NULL;
    }
    m->width_px = width;
    m->height_px = height;
    drogue_config_default(&m->config);
    drogue_capacity_for_any(&capacity, width, height, 1); /* whatever drogue_dpi_thresholds() is given */
    bytes = drogue_workspace_bytes(&capacity);
    m->pixels = calloc((size_t)width, (size_t)height);
    m->memory = malloc(bytes);
    if (m->pixels == NULL || m->memory == NULL ||
        drogue_workspace_init(&m->workspace, m->memory, bytes, &capacity) != DROGUE_OK) {
        drogue_dpi_close(m);
        return NULL;
    }
    return m;
}

void drogue_dpi_put(void *handle, int x, int y, int grey)
{
    model *m = handle;
    if (x >= 0 && y >= 0 && x < m->width_px && y < m->height_px) {
        m->pixels[(size_t)y * (size_t)m->width_px + (size_t)x] = (uint8_t)grey;
    }
}

void drogue_dpi_image(void *handle, const unsigned char *grey)
{
    model *m = handle;
    memcpy(m->pixels, grey, (size_t)m->width_px * (size_t)m->height_px);
}

int drogue_dpi_thresholds(void *handle, const int words[DROGUE_DPI_THRESHOLDS])
{
    model *m = handle;
    int32_t registers[DROGUE_HLS_PARAMETERS];
    drogue_hls_parameters p;
    memset(registers, 0, sizeof registers);
    memcpy(registers + DROGUE_HLS_P_CANNY_LOW, words, DROGUE_DPI_THRESHOLDS * sizeof *registers);
    drogue_hls_unpack_parameters(&p, registers);
    if (!drogue_config_valid(&p.config)) {
        return 0;
    }
    m->config = p.config;
    return 1;
}

int drogue_dpi_measure(void *handle, const int camera[9], const int model_words[3], const int region_words[4])
{
    model *m = handle;
    const drogue_image image = {m->pixels, m->width_px, m->height_px, m->width_px};
    const drogue_camera c = {camera[0], camera[1], camera[2], camera[3], camera[4],
                             camera[5], camera[6], camera[7], camera[8]};
    const drogue_model drogue = {model_words[0], model_words[1], model_words[2]};
    const drogue_region region = {region_words[0], region_words[1], region_words[2], region_words[3]};
    drogue_setup setup;
    setup.camera = &c;
    setup.model = &drogue;
    setup.config = &m->config;
    return (int)drogue_measure(&m->result, &m->workspace, &setup, &image, &region);
}

void drogue_dpi_ellipse(void *handle, int words[5])
{
    const drogue_ellipse *e = &((model *)handle)->result.ellipse;
    words[0] = e->xc_px_q16;
    words[1] = e->yc_px_q16;
    words[2] = e->a_px_q16;
    words[3] = e->b_px_q16;
    words[4] = e->angle_rad_q16;
}

void drogue_dpi_pose(void *handle, int which, int words[8])
{
    const drogue_result *r = &((model *)handle)->result;
    const drogue_pose *p = which == 0 ? &r->pose : &r->alternative;
    int i;
    for (i = 0; i < 3; i++) {
        words[i] = p->position_m_q16[i];
        words[3 + i] = p->axis_q16[i];
    }
    words[6] = p->yaw_rad_q16;
    words[7] = p->pitch_rad_q16;
}

int drogue_dpi_resolved(void *handle) { return ((model *)handle)->result.orientation_resolved; }

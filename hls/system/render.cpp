// SPDX-License-Identifier: Apache-2.0
// render SIDE FRAMES >frames.raw: a drogue that swings and comes nearer, as the accuracy study renders it. The frames say in which
// of them nothing but background is seen, and where the drogue jumps: a track is lost, and found again.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "scene.hpp"

using namespace accuracy;

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: render SIDE FRAMES >frames.raw\n");
        return 2;
    }
    const int side = atoi(argv[1]), frames = atoi(argv[2]);
    for (int i = 0; i < frames; i++) {
        Scene scene;
        const bool gone = frames > 6 && i >= 5 && i < 8;
        const bool other = frames > 6 && i >= 8; // nearer, and elsewhere
        const double scale = 128.0 / side, s = 0.02 * i;
        const double z = (other ? 9 : 12) * scale - 1.5 * s;
        scene.camera = {1465, 1465, (side - 1) / 2.0, (side - 1) / 2.0};
        scene.image_px = {side, side};
        scene.pose.position_m = {other ? 0.1 : 0.05 * std::sin(9 * s) + (i == 3 ? 0.10 * scale : 0),
                                 other ? -0.06 : 0.04, gone ? 4000 : z};
        scene.pose.axis = axis_of(0.1 + 0.05 * std::sin(5 * s), -0.08);
        scene.seed = 1 + (unsigned)i;
        scene.coarse = true;
        const cv::Mat image = render(scene, {0, 0, side, side});
        for (int y = 0; y < side; y++) {
            fwrite(image.ptr(y), 1, (size_t)side, stdout);
        }
    }
    return 0;
}

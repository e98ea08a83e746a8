/* SPDX-License-Identifier: Apache-2.0 */
/* In parts: C99 promises no string of more than 4095 characters. */
#include "help.h"

#include <stddef.h>
#include <stdio.h>

static const char *const PARTS[] = {
    "Usage: drogue measure IMAGE --camera FX,FY,CX,CY|FILE [OPTION]...\n"
    "  or:  drogue track FRAME... --camera FX,FY,CX,CY|FILE [OPTION]...\n"
    "  or:  drogue edges IMAGE OUT.png --low L --high H [--smooth]\n"
    "\n"
    "Measure the pose of a refuelling drogue from one camera's images.\n"
    "\n"
    "measure prints the pose in one image, track a line a frame in the order given, filtered over time; edges writes Canny's\n"
    "edge map, 0 and 255, of at most 2048 pixels a side. An IMAGE is PNG or binary PGM or PPM; \"-\" is standard input, for\n"
    "OUT.png standard output. A FRAME is an image, a folder of images, \"-\" for a stream of them, or with --raw a file of raw\n"
    "video.\n"
    "\n"
    "Options:\n"
    "  --camera FX,FY,CX,CY       focal lengths and principal point, pixels\n"
    "  --camera FILE              a camera file of OpenCV (YAML, XML), ROS (camera_info) or Kalibr (camchain)\n"
    "  --distortion K1,K2,P1,P2,K3\n"
    "                             Brown-Conrady lens distortion in OpenCV's order; all 0 by default\n"
    "  --roi X,Y,W,H              where to look, drogue about its middle, longest side 2 to 3 major semi-axes; may reach past\n"
    "                             the image; what holds no outline of that size is searched for a smaller one. Default: the\n"
    "                             whole image is searched for a dark disc inside a ring. track: of the first frame, and\n"
    "                             whenever the track is lost, before the whole image is searched\n"
    "  --drogue RADIUS[,INNER,DEPTH]\n"
    "                             radius of the rim, of the inner part, and depth of that part behind the rim, metres or\n"
    "                             another unit in which RADIUS is at least 0.01: lengths are multiples of 1/65536.\n"
    "                             Without INNER,DEPTH both poses that an ellipse allows are given and the orientation stays\n"
    "                             unresolved. Without --drogue the radius is 1: positions come out in rim radii\n"
    "  --json                     one JSON object on one line instead of a table (track: unless --csv)\n"
    "  --csv                      a line of names, then a line a frame\n"
    "  --overlay OUT.png          draw what was found; track numbers the files OUT-0001.png, OUT-0002.png ... With\n"
    "                             --overlay - measure writes the picture alone to standard output\n",
    "  --min-reliability R        a reliability below R, 0 to 1, is no measurement but \"unreliable\"\n"
    "  --set NAME=VALUE           change a threshold; --help-config lists them\n"
    "  --raw W,H,FORMAT           track: frames of raw video, FORMAT gray8, nv12 or yuyv\n"
    "  --fps N                    track: frames a second, 0.0005 to 1000000, 30 by default\n"
    "  --max-missed N             track: frames in a row without the drogue that a track survives, 10 by default\n"
    "  --low L, --high H          edges: Canny's thresholds on the L1 Sobel magnitude, 0 <= L <= H\n"
    "  --smooth                   edges: smooth 5x5 before the gradient\n"
    "  --help-config              list the thresholds with default, range and unit\n"
    "  -h, --help                 this text\n"
    "  -V, --version              the version\n"
    "\n"
    "Pixel (0, 0) is the centre of the top-left pixel, x right, y down. Camera frame: x right, y down, z forward. The axis\n"
    "points from the rim into the drogue; yaw = atan2(x, z), pitch = asin(y) of the axis. The part of a region inside the image\n"
    "is at most 2048 pixels a side, an image without --roi 32767. Numbers are decimal, such as 1465.5 or -4.35e-1.\n"
    "\n"
    "How sure a result is say its log_odds, the natural logarithm of the odds that it is right: 0.625 is 65 of a hundred, and what a\n"
    "search takes; 3 is 95. Without an inner part, -3 to -2: a rank and no odds. outside: so many of eight parts of the\n"
    "outline have another edge beside them.\n"
    "\n"
    "Exit code: 0 measured, 1 nothing measurable (the status and a sentence on standard error say why), 2 bad usage, unreadable\n"
    "input or unwritable output.\n"
    "\n"
    "Examples:\n"
    "  drogue measure demo.png --camera 1465.5,1465.5,403.5,143.5 --drogue 0.35,0.12,0.25\n"
    "  ffmpeg -i flight.mp4 -f rawvideo -pix_fmt gray - | drogue track - --raw 1280,720,gray8 --camera camera.yaml\n",
};

void help_print(void)
{
    size_t i;
    for (i = 0; i < sizeof PARTS / sizeof PARTS[0]; i++) {
        fputs(PARTS[i], stdout);
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/* drogue: the library on PNG files from the command line. */
#include <stdio.h>

#include "cli.h"
#include "commands.h"
#include "drogue/drogue.h"
#include "outputs.h"

static const char USAGE[] =
    "drogue measures the pose of a refuelling drogue from one grey image.\n"
    "\n"
    "  drogue measure IMAGE.png --camera FX,FY,CX,CY [options]\n"
    "  drogue track   FRAME.png... --camera FX,FY,CX,CY [options] [--fps N] [--max-missed N]\n"
    "  drogue edges   IMAGE.png OUT.png --low L --high H [--smooth]\n"
    "\n"
    "measure prints the pose in one image, track one JSON line a frame in the order given, filtered over time;\n"
    "edges writes Canny's edge map, 0 and 255.\n"
    "\n"
    "  --camera FX,FY,CX,CY             focal lengths and principal point, pixels\n"
    "  --distortion K1,K2,P1,P2,K3      Brown-Conrady lens distortion in OpenCV's order; all 0 by default\n"
    "  --roi X,Y,W,H                    where to look, drogue about its middle, longest side 2 to 3 major\n"
    "                                   semi-axes; may reach past the image. Default: the whole image is searched\n"
    "                                   for a dark disc inside a ring. track: of the first frame, and whenever\n"
    "                                   the track is lost, before the whole image is searched\n"
    "  --drogue RADIUS[,INNER,DEPTH]    radius of the rim, of the inner part, and depth of that part behind\n"
    "                                   the rim, metres. Without INNER,DEPTH both poses that an ellipse allows\n"
    "                                   are given and the orientation stays unresolved. Without --drogue the\n"
    "                                   radius is 1: positions come out in rim radii\n"
    "  --json                           one JSON object on one line instead of a table (track: always)\n"
    "  --overlay OUT.png                draw what was found; track numbers the files OUT-0001.png, OUT-0002.png ...\n"
    "  --fps N                          frames a second, 30 by default\n"
    "  --max-missed N                   frames in a row without the drogue that a track survives, 10 by default\n"
    "  --low L, --high H                Canny's thresholds on the L1 Sobel magnitude, 0 <= L <= H\n"
    "  --smooth                         smooth 5x5 before the gradient\n"
    "  --help, --version\n"
    "\n"
    "Pixel (0, 0) is the centre of the top-left pixel, x right, y down. Camera frame: x right, y down, z forward.\n"
    "The axis points from the rim into the drogue; yaw = atan2(x, z), pitch = asin(y) of the axis.\n"
    "The part of a region inside the image is at most 2048 pixels a side, an image without --roi 32767. Numbers are\n"
    "decimal, such as 1465.5 or -4.35e-1.\n"
    "\n"
    "Exit code: 0 measured, 1 nothing measurable (the status says why), 2 bad usage, unreadable input or\n"
    "unwritable output.\n";

int main(int argc, char **argv)
{
    options o;
    if (options_parse(&o, argc, argv) || outputs_check(&o)) {
        return EXIT_BAD;
    }
    switch (o.command) {
    case COMMAND_MEASURE: return command_measure(&o);
    case COMMAND_TRACK: return command_track(&o);
    case COMMAND_EDGES: return command_edges(&o);
    case COMMAND_VERSION: printf("drogue %s\n", drogue_version()); return flush_output();
    case COMMAND_HELP:
    default: fputs(USAGE, stdout); return flush_output();
    }
}

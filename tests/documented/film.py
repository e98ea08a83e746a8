# SPDX-License-Identifier: Apache-2.0
"""In place of ffmpeg: three raw frames of 1280 x 720 grey pixels with a dark disc in a ring, on standard output."""
import sys

WIDTH, HEIGHT = 1280, 720


def frame(x0, y0):
    rows = []
    for y in range(HEIGHT):
        row = bytearray([200]) * WIDTH
        for radius, grey in ((110, 90), (36, 15)):
            rest = radius * radius - (y - y0) ** 2
            half = int(rest ** 0.5) if rest > 0 else 0
            row[x0 - half:x0 + half + 1] = bytes([grey]) * (2 * half + 1) if half else row[x0 - half:x0 + half + 1]
        rows.append(bytes(row))
    return b''.join(rows)


for k in range(3):
    sys.stdout.buffer.write(frame(640 + 2 * k, 360))

// SPDX-License-Identifier: Apache-2.0
// Imports of drogue_dpi.h, where each function is explained.
import "DPI-C" function chandle drogue_dpi_open(input int width, input int height);
import "DPI-C" function void drogue_dpi_close(input chandle handle);
import "DPI-C" function void drogue_dpi_put(input chandle handle, input int x, input int y, input int grey);
import "DPI-C" function int drogue_dpi_thresholds(input chandle handle, input int words[42]);
import "DPI-C" function int drogue_dpi_measure(input chandle handle, input int camera[9], input int model[3],
                                               input int region[4]);
import "DPI-C" function void drogue_dpi_ellipse(input chandle handle, output int words[5]);
import "DPI-C" function void drogue_dpi_pose(input chandle handle, input int which, output int words[8]);
import "DPI-C" function int drogue_dpi_resolved(input chandle handle);

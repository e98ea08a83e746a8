// SPDX-License-Identifier: Apache-2.0
// One frame of the golden vectors through the model, every word compared: where hardware under test would stand beside it.
// check.sh builds it with Verilator; the folder of the vectors, name and size of the case are plusargs.
module frame;
    `include "drogue_dpi.svh"

    logic [7:0] pixels[2048 * 2048];
    int camera[9], model[3], region[4], thresholds[42], expected[38], ellipse[5], pose[8], alternative[8];
    string dir, name, image;
    int width, height, status, wrong;
    chandle drogue;

    task automatic compare(input string what, input int found, input int word);
        if (found != expected[word]) begin
            $display("%s: found %08x, expected %08x (word %0d)", what, found, expected[word], word);
            wrong++;
        end
    endtask

    initial begin
        if (!$value$plusargs("dir=%s", dir) || !$value$plusargs("case=%s", name) || !$value$plusargs("image=%s", image) ||
            !$value$plusargs("width=%d", width) || !$value$plusargs("height=%d", height))
            $fatal(1, "frame: +dir +case +image +width +height");
        $readmemh(image, pixels, 0, width * height - 1);
        $readmemh({dir, "/frame/", name, ".camera.hex"}, camera);
        $readmemh({dir, "/frame/", name, ".model.hex"}, model);
        $readmemh({dir, "/frame/", name, ".region.hex"}, region);
        $readmemh({dir, "/frame/", name, ".frame.out.hex"}, expected);
        drogue = drogue_dpi_open(width, height);
        if (drogue == null) $fatal(1, "frame: no model");
        if ($test$plusargs("config")) begin
            $readmemh({dir, "/frame/", name, ".config.hex"}, thresholds);
            if (drogue_dpi_thresholds(drogue, thresholds) != 1) $fatal(1, "frame: thresholds");
        end
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                drogue_dpi_put(drogue, x, y, {24'b0, pixels[y * width + x]});
        status = drogue_dpi_measure(drogue, camera, model, region);
        drogue_dpi_ellipse(drogue, ellipse);
        drogue_dpi_pose(drogue, 0, pose);
        drogue_dpi_pose(drogue, 1, alternative);
        compare("status", status, 0);
        foreach (ellipse[i]) compare("ellipse", ellipse[i], 1 + i);
        foreach (pose[i]) compare("pose", pose[i], 20 + i);
        foreach (alternative[i]) compare("alternative", alternative[i], 28 + i);
        compare("resolved", drogue_dpi_resolved(drogue), 36);
        drogue_dpi_close(drogue);
        $display("frame: %s: position %0d %0d %0d / 65536 m, %0d words wrong", name, pose[0], pose[1], pose[2], wrong);
        if (wrong != 0) $fatal(1, "frame: differs");
        $finish;
    end
endmodule

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Does the firmware of the small system fit its RAM, stack included, at 128 and at 256 px? 77 where the compiler is absent.
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/system/build.sh
command -v riscv64-unknown-elf-gcc >/dev/null || { echo "firmware: SKIPPED: no riscv64-unknown-elf-gcc" && exit 77; }
for side in 128 256; do
    mkdir -p "$made/firmware-$side"
    firmware "$made/firmware-$side" hls/system/firmware.c "-DSIDE=$side"
done
